"""STL, binary and text: triangles with corners of their own. Points at one place become one.

The file's normals are left aside: they are one a face, and often wrong.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import Corners, finite_points, refuse_empty, scene_of
from eyeline.files.meshes.trimesh_reader import asked
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.weld import welded
from eyeline.scene.scene import Scene

HEADER = 84  # bytes: 80 of text, and the number of triangles
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(path: Path) -> Scene:
    """The scene of an STL file. Lengths are taken for metres; text may hold several solids."""
    data = path.read_bytes()
    if not data.strip():
        raise FileError("is empty; export the model again")
    claimed = int.from_bytes(data[80:HEADER], "little") if len(data) >= HEADER else 0
    needed = HEADER + claimed * TRIANGLE.itemsize
    text = data.lstrip()[:5].lower() == b"solid" and b"facet" in data[:4096].lower()
    if text and len(data) != needed:
        return text_scene(data, path.stem)
    if len(data) < needed or len(data) < HEADER:
        raise FileError(
            f"claims {claimed:,} triangles, {needed:,} bytes, but holds {len(data):,}; it is cut short"
        )
    triangles = np.frombuffer(data, TRIANGLE, claimed, HEADER)
    rest = len(data) - needed
    notes = (f"{rest:,} bytes after the last triangle are left out",) if rest else ()
    mesh = soup(triangles["corners"].reshape(-1, 3)).mesh(path.stem)
    return scene_of(path.stem, [mesh], notes)


def soup(points: FloatArray) -> Corners:
    """Every three points a triangle; those at one place become one."""
    refuse_empty(points)
    first, index = welded(finite_points(points))
    return Corners(finite_points(points)[first], index.reshape(-1, 3))


def text_scene(data: bytes, name: str) -> Scene:
    """The solids of a text file, a node each."""
    from trimesh.exchange.stl import load_stl_ascii

    if b"endsolid" not in data.lower():
        raise FileError("ends before its 'endsolid'; it is cut short, so export it again")
    found = asked(load_stl_ascii, data, "STL text")
    solids = found.get("geometry", {name: found})
    refuse_empty(list(solids))
    return scene_of(name, (soup(solid["vertices"]).mesh(key or name) for key, solid in solids.items()))
