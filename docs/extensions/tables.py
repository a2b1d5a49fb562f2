"""Directives that write the tables of the site from the code, so that they cannot drift from it."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

import eyeline

MODULES = ("errors", "samples")


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
    from eyeline.files import READERS

    return ", ".join(f"`{suffix}`" for suffix in sorted(READERS))


def counters(name: str) -> str:
    """What one method counts on a sample scene."""
    seen = eyeline.visible(eyeline.samples.teapot(), size=(640, 360), method=name)
    lines = ["| counter | teapot, 640x360 |", "|---|--:|"]
    lines += [f"| {counter} | {count:,} |" for counter, count in seen.work.items()]
    return "\n".join(lines)


def public_names(_: str) -> str:
    """A reference of everything in `eyeline.__all__`."""
    functions, classes, modules = [], [], []
    for name in eyeline.__all__:
        thing = getattr(eyeline, name)
        if name in MODULES:
            modules.append(f"## eyeline.{name}\n\n{quoted(f'.. automodule:: {thing.__name__}', 'members')}")
        elif inspect.isclass(thing):
            classes.append(f"### {name}\n\n{quoted(f'.. autoclass:: eyeline.{name}', 'members')}")
        elif callable(thing):
            functions.append(f"### {name}\n\n{quoted(f'.. autofunction:: eyeline.{name}')}")
    return "\n\n".join(["## Functions", *functions, "## Classes", *classes, *modules])


def quoted(directive: str, *options: str) -> str:
    """reStructuredText inside Markdown."""
    lines = [directive, *(f"   :{option}:" for option in options)]
    return "\n".join(["```{eval-rst}", *lines, "```"])


def idea(thing: Any) -> str:
    """The first line of what speaks for a thing: its own docstring, or its class's."""
    return (inspect.getdoc(thing) or "").partition("\n")[0].replace("|", "\\|")


WRITERS: dict[str, Callable[[str], str]] = {
    "methods-table": methods,
    "styles-table": styles,
    "readers-list": readers,
    "work-of": counters,
    "public-names": public_names,
}
