"""Directives that write the tables of the site from the code, so that they cannot drift from it."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

import eyeline
from extensions import reference
from eyeline.deform.deformer import Deformer
from eyeline.deform.table import DEFORMERS
from eyeline.files import READERS
from eyeline.files.gltf.extensions import KNOWN

SIZE = (640, 360)
RESULTS = Path(__file__).resolve().parents[2] / "benchmarks" / "results.json"


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


OTHERS = {"backface": "which faces may be seen", "roberts": "which parts of edges are seen"}


def methods(_: str) -> str:
    """Every visible-surface method: where it decides and what it answers."""
    lines = ["| method | decides in | answers | |", "|---|---|---|---|"]
    for name, method in eyeline.METHODS.items():
        answer = "what is seen at every pixel" if method.answers else OTHERS[name]
        lines.append(f"| [{name}](/methods/{name}.md) | {method.space} space | {answer} | {idea(method)} |")
    return "\n".join(lines)


def styles(_: str) -> str:
    """Every style a picture can have."""
    lines = ["| style | |", "|---|---|"]
    lines += [f"| `{name}` | {idea(style)} |" for name, style in eyeline.STYLES.items()]
    return "\n".join(lines)


def easings(_: str) -> str:
    """Every easing, written as it can be given."""
    lines = ["| easing | |", "|---|---|"]
    lines += [f"| `{one}` | {one.idea} |" for one in eyeline.EASINGS.values()]
    return "\n".join(lines)


def deformers(_: str) -> str:
    """Every deformer, and the numbers of its own that can be keyed."""
    common = {field.name for field in fields(Deformer)}
    lines = ["| deformer | | its own numbers |", "|---|---|---|"]
    for name, deformer in DEFORMERS.items():
        own = ", ".join(f"`{one}`" for one in deformer().parameters if one not in common)
        lines.append(f"| `{name}` | {idea(deformer)} | {own} |")
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


COMPARED = {
    "backface": ("each face with the eye", "none: every face alone"),
    "painter": ("faces with faces", "depth: few neighbours in the sorted list overlap"),
    "roberts": ("edges with bodies", "object: a body is one, however many faces it has"),
    "zbuffer": ("faces with a pixel's depth", "none: faces come in any order"),
    "warnock": ("faces with areas", "area: neighbouring pixels see the same face"),
    "octree": ("cubes of faces with areas' depths", "object and frame: what was hidden stays hidden"),
    "scanline": ("spans on a row", "scan line and span: the next row, the next pixel see nearly the same"),
    "raycast": ("a ray with boxes and faces", "area: neighbouring rays walk the tree together"),
}  # a method -> what it compares, and the coherence it uses


def spaces(_: str) -> str:
    """The textbook's table of object-space and image-space methods, with what was measured."""
    kept = json.loads(RESULTS.read_text())["rows"]
    lines = [
        "| method | decides in | compares | coherence | time, 1M faces | grows with faces | with pixels |",
        "|---|---|---|---|--:|--:|--:|",
    ]
    for name, method in eyeline.METHODS.items():
        time = "1" if name == "zbuffer" else ""
        for row in kept.get("methods", ()):
            if row["what"].startswith(f"{name},"):
                time = f"{row['ours'] / row['theirs']:.1f}" + (" (100k)" if "0.1M" in row["what"] else "")
        exponents = {row["what"]: f"n^{row['ours']:.2f}" for row in kept.get("growth", ())}
        cells = [f"[{name}](/methods/{name}.md)", f"{method.space} space", *COMPARED[name], time]
        cells += [exponents.get(f"{name}, exponent of {unit}", "") for unit in ("faces", "pixels")]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


WRITERS: dict[str, Callable[[str], str]] = {
    "methods-table": methods,
    "methods-in-both-spaces": spaces,
    "styles-table": styles,
    "easings-table": easings,
    "deformers-table": deformers,
    "readers-table": readers,
    "gltf-extensions": extensions,
    "work-of": work,
    "work-culled": work_culled,
    "public-names": reference.public_names,
}
