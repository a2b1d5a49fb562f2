"""Every method at work, drawn for its page when the site is built."""

from __future__ import annotations

from pathlib import Path

from sphinx.application import Sphinx

import eyeline
from eyeline.explanation.sheet import sheet

FOLDER = Path("methods") / "steps"
FRAMES = 6
SCENES = {"backface": "convex_body", "roberts": "cyclic_overlap", "octree": "deep_stack"}
USUAL = "piercing_faces"


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("builder-inited", draw)
    return {"parallel_read_safe": True}


def draw(app: Sphinx) -> None:
    """An SVG for each method: six of its steps on a scene that shows what it is about."""
    folder = Path(app.srcdir) / FOLDER
    folder.mkdir(exist_ok=True)
    for name in eyeline.METHODS:
        scene = eyeline.samples.SAMPLES[SCENES.get(name, USUAL)]()
        drawn = sheet(eyeline.explain(scene, name, size=(64, 36)), FRAMES)
        (folder / f"{name}.svg").write_text(drawn, encoding="utf-8")
