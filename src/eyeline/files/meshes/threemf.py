"""3MF, through trimesh: objects placed by a build, in the file's unit. Colours are noted and left aside."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from lxml import etree

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import refuse_empty
from eyeline.files.meshes.text import shortened
from eyeline.files.meshes.trimesh_reader import asked, corners
from eyeline.geometry import transform
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

# [3MF Core Specification 1.3, 3.4]; trimesh writes "millimeters" where the file says nothing
UNITS = {
    "micron": 1e-6,
    "millimeter": 1e-3,
    "millimeters": 1e-3,
    "centimeter": 1e-2,
    "meter": 1.0,
    "inch": 0.0254,
    "foot": 0.3048,
}
UPRIGHT = np.array(
    [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64
)  # z up to y up

UNPACKED, UNPACKED_PER_BYTE = 2**26, 64  # bytes a file may unpack to: 64 MiB, and 64 for each of its own
MOST_INSTANCES = 2**16
MOST_LEVELS = 64  # of objects made of objects
COLORED = ("basematerials", "colorgroup", "texture2d")


@dataclass
class Outline:
    """What a model is made of, without its triangles."""

    parts: dict[str, list[str]] = field(default_factory=dict)  # object -> the objects it is made of
    built: list[str] = field(default_factory=list)
    colored: bool = False


def read(path: Path) -> Scene:
    """The scene of a 3MF file: metres, y up; a node for each placing of an object."""
    from trimesh.exchange.threemf import load_3MF

    data = path.read_bytes()
    outline = Outline()
    for model in models(data):
        add_outline(outline, model)
    refuse_empty(outline.built)
    refuse_many(outline)
    found = asked(lambda file: load_3MF(file, postprocess=False), data, "3MF file")
    meshes: dict[str, Mesh] = {}
    for name, part in found["geometry"].items():
        shape = corners(part)
        if len(shape.faces):
            meshes[name] = shape.mesh(name)
    refuse_empty(list(meshes))
    unit = UNITS.get(found["metadata"]["units"], 1e-3)
    nodes = [Node(path.stem, matrix=UPRIGHT @ np.diag([unit, unit, unit, 1.0]))]
    nodes += [
        Node(placing["frame_to"], 0, matrix=placed(placing), mesh=meshes[placing["geometry"]])
        for placing in found["graph"]
        if placing["geometry"] in meshes
    ]
    refuse_empty(nodes[1:])
    notes = ("colours of 3MF files are not read; all is grey",) if outline.colored else ()
    return Scene(tuple(nodes), notes=notes, name=path.stem)


def placed(placing: Mapping[str, object]) -> np.ndarray:
    """(4, 4) where an object stands."""
    matrix = np.asarray(placing.get("matrix", transform.identity()), dtype=np.float64)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise FileError(f"item {placing['frame_to']!r} is placed by no finite matrix; export it again")
    return matrix


def models(data: bytes) -> list[bytes]:
    """The XML of all model parts; the sizes the archive claims are added up before anything is unpacked."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            size = sum(entry.file_size for entry in archive.infolist())
            if size > UNPACKED + UNPACKED_PER_BYTE * len(data):
                raise FileError(
                    f"unpacks from {len(data):,} to {size:,} bytes; it is no honest model, or must be split"
                )
            names = [name for name in archive.namelist() if name.lower().endswith(".model")]
            if not any("3d/3dmodel.model" in name.lower() for name in names):
                raise FileError("has no part 3D/3dmodel.model; it is no 3MF file")
            return [archive.read(name) for name in names]
    except (MemoryError, FileError):
        raise
    except Exception as error:
        # The archive's own errors, and those of each way to pack it
        reason = shortened((str(error) or type(error).__name__).splitlines()[0], 80)
        raise FileError(f"is no 3MF archive that can be unpacked ({reason}); export it again") from error


def add_outline(outline: Outline, model: bytes) -> None:
    """Which objects a model part defines and builds."""
    inside = ""
    try:
        for event, element in etree.iterparse(
            io.BytesIO(model),
            events=("start", "end"),
            resolve_entities=False,
            no_network=True,
            load_dtd=False,
        ):
            tag = str(element.tag).rpartition("}")[2]
            if event == "end":
                if tag not in ("model", "resources", "build"):
                    element.clear()
                continue
            if tag == "object":
                inside = element.get("id", "")
                outline.parts.setdefault(inside, [])
            elif tag == "component":
                outline.parts[inside] = [*outline.parts.get(inside, []), element.get("objectid", "")]
            elif tag == "item":
                outline.built.append(element.get("objectid", ""))
            outline.colored = outline.colored or tag in COLORED
    except etree.XMLSyntaxError as error:
        raise FileError(
            f"has XML that is broken ({shortened(error.msg.splitlines()[0])}); export it again"
        ) from error


def refuse_many(outline: Outline) -> None:
    """Refuse a model that places objects without end: each made of others may multiply them."""
    counts: dict[str, int] = {}

    def instances(name: str, level: int) -> int:
        if level > MOST_LEVELS:
            raise FileError(f"object {name!r} is made of objects more than {MOST_LEVELS} deep, or of itself")
        if name not in counts:
            parts = outline.parts.get(name, [])
            counts[name] = 1 + sum(instances(part, level + 1) for part in parts)
        return counts[name]

    total = sum(instances(name, 0) for name in outline.built)
    if total > MOST_INSTANCES:
        raise FileError(f"places {total:,} objects; at most {MOST_INSTANCES:,} are read")
