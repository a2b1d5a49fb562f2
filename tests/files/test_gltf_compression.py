"""Draco and meshopt: what was packed comes back."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import DracoPy
import meshopt
import numpy as np
import pytest

from eyeline.files import load
from eyeline.scene.mesh import Mesh
from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats

GRID = np.stack([*np.meshgrid(np.arange(9), np.arange(9)), np.zeros((9, 9))], axis=-1).reshape(-1, 3)
CELLS = np.arange(80).reshape(-1)[np.arange(80) % 9 != 8][:64]
GRID_FACES = np.concatenate(
    [np.stack([CELLS, CELLS + 1, CELLS + 10], axis=1), np.stack([CELLS, CELLS + 10, CELLS + 9], axis=1)]
)


def only_mesh(builder: Builder, folder: Path) -> Mesh:
    builder.node(mesh=0)
    mesh = load(builder.write(folder)).nodes[0].mesh
    assert mesh is not None
    return mesh


def corners(mesh: Mesh) -> np.ndarray:
    """Faces as places, in an order that no packing changes."""
    places = mesh.points[mesh.faces].round(4).reshape(len(mesh.faces), 9)
    return places[np.lexsort(places.T)]


# --- Draco ----------------------------------------------------------------------------------------------


def unread(builder: Builder, count: int, kind: str, component: int = 5126, **values: Any) -> int:
    return builder.add("accessors", count=count, type=kind, componentType=component, **values)


def draco_builder(preserve_order: bool) -> Builder:
    colors = np.tile(np.array([255, 51, 0, 255], np.uint8), (81, 1))
    packet = DracoPy.encode(
        GRID, GRID_FACES.astype(np.uint32), quantization_bits=16, preserve_order=preserve_order,
        generic_attributes={
            1: np.tile(floats([0, 0, 1]), (81, 1)),
            2: colors,
            3: np.tile(np.array([4, 5, 0, 0], np.uint8), (81, 1)),
            4: np.tile(floats([0.5, 0.5, 0, 0]), (81, 1)),
        },
    )  # fmt: skip
    point_id = next(
        one["unique_id"] for one in DracoPy.decode(packet).attributes if one["attribute_type"] == 0
    )
    builder = Builder()
    attributes = {
        "POSITION": unread(builder, 81, "VEC3"),
        "NORMAL": unread(builder, 81, "VEC3"),
        "COLOR_0": unread(builder, 81, "VEC4", 5121, normalized=True),
        "JOINTS_0": unread(builder, 81, "VEC4", 5121),
        "WEIGHTS_0": unread(builder, 81, "VEC4"),
    }
    named = {"POSITION": point_id, "NORMAL": 1, "COLOR_0": 2, "JOINTS_0": 3, "WEIGHTS_0": 4}
    extension = {"bufferView": builder.view(packet), "attributes": named}
    indices = unread(builder, GRID_FACES.size, "SCALAR", 5123)
    builder.mesh(attributes, indices, extensions={"KHR_draco_mesh_compression": extension})
    builder.json["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return builder


@pytest.mark.parametrize("preserve_order", [True, False])
def test_draco_gives_back_faces_and_all_attributes(tmp_path: Path, preserve_order: bool) -> None:
    mesh = only_mesh(draco_builder(preserve_order), tmp_path)
    expected = corners(Mesh(GRID, GRID_FACES))
    places = np.sort(mesh.points[mesh.faces].round(2).reshape(-1, 3), axis=0)
    np.testing.assert_allclose(places, np.sort(expected.reshape(-1, 3), axis=0), atol=1e-2)
    assert len(mesh.faces) == len(GRID_FACES)
    assert (mesh.normals == (0, 0, 1)).all()
    np.testing.assert_allclose(mesh.colors, [[1, 0.2, 0, 1]] * len(mesh.points), rtol=1e-6)
    assert (mesh.joints[:, :2] == (4, 5)).all() and (mesh.influences[:, :2] == 0.5).all()


def test_an_attribute_outside_the_packet_is_read_from_its_accessor(tmp_path: Path) -> None:
    builder = draco_builder(preserve_order=True)
    uv = (GRID[:, :2] / 8).astype(np.float32)
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = builder.accessor(uv)
    assert only_mesh(builder, tmp_path).uv[0].tolist() == uv.tolist()


# --- meshopt --------------------------------------------------------------------------------------------


def packed(builder: Builder, array: np.ndarray, mode: str, kind: str = "NONE") -> int:
    """A view that exists only packed; its own buffer is not there."""
    data = meshopt.encode_gltf_buffer(array, mode)
    stride = array.nbytes // len(array)
    inner = builder.view(data)
    told = builder.json["bufferViews"].pop(inner)
    extension = {
        "buffer": 0, "byteOffset": told["byteOffset"], "byteLength": len(data),
        "byteStride": stride, "count": len(array), "mode": mode, "filter": kind,
    }  # fmt: skip
    own = {"byteStride": stride} if mode == "ATTRIBUTES" else {}
    if len(builder.json.setdefault("buffers", [{}])) == 1:
        builder.json["buffers"].append(
            {"byteLength": 1 << 20, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}
        )
    return builder.add(
        "bufferViews",
        buffer=1,
        byteLength=array.nbytes,
        **own,
        extensions={"EXT_meshopt_compression": extension},
    )


@pytest.mark.parametrize(
    ("mode", "kind"), [("TRIANGLES", np.uint16), ("TRIANGLES", np.uint32), ("INDICES", np.uint16)]
)
def test_meshopt_gives_back_vertices_and_indices(tmp_path: Path, mode: str, kind: type) -> None:
    builder = Builder()
    points = packed(builder, GRID.astype(np.float32), "ATTRIBUTES")
    indices = packed(builder, GRID_FACES.astype(kind).reshape(-1), mode)
    position = builder.add("accessors", bufferView=points, componentType=5126, count=81, type="VEC3")
    component = 5123 if kind is np.uint16 else 5125
    count = GRID_FACES.size
    corner = builder.add("accessors", bufferView=indices, componentType=component, count=count, type="SCALAR")
    builder.mesh({"POSITION": position}, corner)
    builder.json["extensionsRequired"] = ["EXT_meshopt_compression"]
    mesh = only_mesh(builder, tmp_path)
    assert mesh.points.tolist() == GRID.tolist()
    # The codec may turn a face's corners round, never its side
    assert (
        corners(Mesh(mesh.points, np.sort(mesh.faces))).tolist()
        == corners(Mesh(GRID, np.sort(GRID_FACES))).tolist()
    )
    a, b, c = (mesh.points[mesh.faces[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_meshopts_octahedral_filter_gives_back_directions(tmp_path: Path) -> None:
    directions = np.random.default_rng(1).normal(size=(4, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    rows = meshopt.encode_filter_oct(np.column_stack([directions, np.ones(4)]).astype(np.float32), 8, 16)
    builder = Builder()
    view = packed(builder, rows, "ATTRIBUTES", "OCTAHEDRAL")
    number = builder.add(
        "accessors", bufferView=view, componentType=5122, normalized=True, count=4, type="VEC3"
    )
    builder.mesh({"POSITION": SQUARE, "NORMAL": number}, SQUARE_FACES)
    np.testing.assert_allclose(only_mesh(builder, tmp_path).normals, directions, atol=1e-4)


def test_meshopts_exponential_filter_gives_back_floats(tmp_path: Path) -> None:
    points = np.random.default_rng(2).normal(size=(4, 3)).astype(np.float32)
    builder = Builder()
    view = packed(builder, meshopt.encode_filter_exp(points, 20), "ATTRIBUTES", "EXPONENTIAL")
    number = builder.add("accessors", bufferView=view, componentType=5126, count=4, type="VEC3")
    builder.mesh({"POSITION": number}, SQUARE_FACES)
    np.testing.assert_allclose(only_mesh(builder, tmp_path).points, points, atol=1e-5)


def test_meshopts_quaternion_filter_gives_back_turns(tmp_path: Path) -> None:
    turns = np.random.default_rng(3).normal(size=(5, 4))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    builder = Builder()
    view = packed(
        builder, meshopt.encode_filter_quat(turns.astype(np.float32), 8, 16), "ATTRIBUTES", "QUATERNION"
    )
    values = builder.add(
        "accessors", bufferView=view, componentType=5122, normalized=True, count=5, type="VEC4"
    )
    builder.node(mesh=builder.square())
    builder.animation("rotation", 0, floats(0, 1, 2, 3, 4), values, "STEP")
    (track,) = load(builder.write(tmp_path)).clips[0].tracks
    # A turn and its negative are one
    cosines = np.abs((track.curve.values * turns).sum(axis=1))
    np.testing.assert_allclose(cosines, 1, atol=1e-7)
