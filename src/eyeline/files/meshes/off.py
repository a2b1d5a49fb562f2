"""OFF, through trimesh: points, and polygons over them. Colours of faces are left aside."""

from __future__ import annotations

from pathlib import Path

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import refuse_empty, scene_of
from eyeline.files.meshes.text import text_of
from eyeline.files.meshes.trimesh_reader import asked, corners
from eyeline.scene.scene import Scene


def read(path: Path) -> Scene:
    """The scene of an OFF file. Lengths are taken for metres."""
    from trimesh.exchange.off import load_off

    text = text_of(path)
    if "OFF" not in text[:4096]:
        raise FileError("does not begin with 'OFF'; it is no OFF file")
    found = corners(asked(load_off, text.encode(), "OFF file"))
    refuse_empty(found.faces)
    return scene_of(path.stem, [found.mesh(path.stem)])
