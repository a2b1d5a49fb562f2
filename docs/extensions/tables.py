"""Directives that write the tables of the site from the code, so that they cannot drift from it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

import eyeline
from extensions import reference
from eyeline.files import READERS
from eyeline.files.gltf.extensions import KNOWN

SIZE = (640, 360)


def setup(app: Sphinx) -> dict[str, bool]:
    for name, write in WRITERS.items():
        app.add_directive(name, type(name, (Written,), {"write": staticmethod(write)}))
    return {"parallel_read_safe": True}


class Written(SphinxDirective):
    """A directive that stands for Markdown written by a function."""

    optional_arguments = 1
    write: ClassVar[Callable[[str], str]]

    def run(self) -> list[nodes.Node]:
        text = self.write(*self.arguments[:1] or [""])
        return self.parse_text_to_nodes(text, allow_section_headings=True)


def methods(_: str) -> str:
    """Every visible-surface method: where it decides and what it answers."""
    lines = ["| method | decides in | answers | |", "|---|---|---|---|"]
    for name, method in eyeline.METHODS.items():
        answer = "what is seen at every pixel" if method.answers else "which faces may be seen"
        lines.append(f"| [{name}](/methods/{name}.md) | {method.space} space | {answer} | {idea(method)} |")
    return "\n".join(lines)


def styles(_: str) -> str:
    """Every style a picture can have."""
    lines = ["| style | |", "|---|---|"]
    lines += [f"| `{name}` | {idea(style)} |" for name, style in eyeline.STYLES.items()]
    return "\n".join(lines)


def readers(_: str) -> str:
    """Every suffix that can be loaded."""
    lines = ["| suffix | format |", "|---|---|"]
    return "\n".join(lines + [f"| `{suffix}` | {reader.name} |" for suffix, reader in READERS.items()])


def extensions(_: str) -> str:
    """Every extension of glTF that is read."""
    return ", ".join(f"`{name}`" for name in KNOWN)


def work(name: str) -> str:
    """What one method counts on the teapot."""
    seen = eyeline.visible(eyeline.samples.teapot(), size=SIZE, method=name)
    return counted({"teapot": seen.work})


def work_culled(_: str) -> str:
    """What the depth buffer counts on a closed body with and without its back faces."""
    torus = eyeline.samples.torus()
    return counted(
        {f'cull="{cull}"': eyeline.visible(torus, size=SIZE, cull=cull).work for cull in ("none", "back")}
    )


def counted(columns: dict[str, Mapping[str, int]]) -> str:
    """A table of counters, a column for each run."""
    lines = [f"| {SIZE[0]}x{SIZE[1]} pixels | {' | '.join(columns)} |", f"|---|{'--:|' * len(columns)}"]
    lines += [
        f"| {counter} | {' | '.join(f'{work[counter]:,}' for work in columns.values())} |"
        for counter in next(iter(columns.values()))
    ]
    return "\n".join(lines)


def idea(thing: Any) -> str:
    """The first line of what speaks for a thing: its own docstring, or its class's."""
    return (inspect.getdoc(thing) or "").partition("\n")[0].replace("|", "\\|")


WRITERS: dict[str, Callable[[str], str]] = {
    "methods-table": methods,
    "styles-table": styles,
    "readers-table": readers,
    "gltf-extensions": extensions,
    "work-of": work,
    "work-culled": work_culled,
    "public-names": reference.public_names,
}
