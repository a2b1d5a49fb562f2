"""Numbers out of bytes: sparse, normalized, interleaved, absent."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from eyeline.files import load
from eyeline.scene.mesh import Mesh
from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats


def only_mesh(builder: Builder, folder: Path) -> Mesh:
    builder.node(mesh=0)
    mesh = load(builder.write(folder)).nodes[0].mesh
    assert mesh is not None
    return mesh


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.uint32])
def test_indices_of_every_width_name_the_same_vertices(tmp_path: Path, kind: type) -> None:
    builder = Builder()
    builder.mesh({"POSITION": SQUARE}, SQUARE_FACES.astype(kind))
    assert only_mesh(builder, tmp_path).faces.tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize(
    ("kind", "stored", "meant"),
    [
        (np.int8, [-128, -127, 127], [-1, -1, 1]),
        (np.uint8, [0, 51, 255], [0, 0.2, 1]),
        (np.int16, [-32768, 0, 32767], [-1, 0, 1]),
        (np.uint16, [0, 13107, 65535], [0, 0.2, 1]),
    ],
)
def test_normalized_numbers_reach_from_minus_one_or_zero_to_one(
    tmp_path: Path, kind: type, stored: list[int], meant: list[float]
) -> None:
    builder = Builder()
    points = builder.accessor(np.array([stored] * 3, kind), normalized=True)
    builder.mesh({"POSITION": points})
    np.testing.assert_allclose(only_mesh(builder, tmp_path).points, [meant] * 3, rtol=1e-6)


def test_quantized_positions_are_taken_as_they_are(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": builder.accessor(np.array([[0, 0, 0], [300, 0, 0], [0, 500, 0]], np.uint16))})
    builder.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    assert only_mesh(builder, tmp_path).points.tolist() == [[0, 0, 0], [300, 0, 0], [0, 500, 0]]


def test_interleaved_attributes_come_apart(tmp_path: Path) -> None:
    builder = Builder()
    uv = floats([0, 0], [1, 0], [1, 1], [0, 1])
    both = np.concatenate([SQUARE, uv], axis=1)
    view = builder.view(both.tobytes(), byteStride=20)
    attributes = {
        "POSITION": builder.add("accessors", bufferView=view, componentType=5126, count=4, type="VEC3"),
        "TEXCOORD_0": builder.add(
            "accessors", bufferView=view, byteOffset=12, componentType=5126, count=4, type="VEC2"
        ),
    }
    builder.mesh(attributes, SQUARE_FACES)
    mesh = only_mesh(builder, tmp_path)
    assert mesh.points.tolist() == SQUARE.tolist()
    assert mesh.uv[0].tolist() == uv.tolist()


def sparse(builder: Builder, rows: list[int], values: np.ndarray) -> dict[str, object]:
    return {
        "count": len(rows),
        "indices": {"bufferView": builder.view(np.array(rows, np.uint8).tobytes()), "componentType": 5121},
        "values": {"bufferView": builder.view(values.astype(np.float32).tobytes())},
    }


def test_sparse_values_replace_those_below_them(tmp_path: Path) -> None:
    builder = Builder()
    number = builder.accessor(SQUARE)
    builder.json["accessors"][number]["sparse"] = sparse(builder, [1, 3], floats([9, 9, 9], [8, 8, 8]))
    builder.mesh({"POSITION": number}, SQUARE_FACES)
    assert only_mesh(builder, tmp_path).points.tolist() == [[0, 0, 0], [9, 9, 9], [1, 1, 0], [8, 8, 8]]


def test_an_accessor_without_bytes_is_zeros_under_its_sparse_values(tmp_path: Path) -> None:
    builder = Builder()
    number = builder.add("accessors", componentType=5126, count=3, type="VEC3")
    builder.json["accessors"][number]["sparse"] = sparse(builder, [1, 2], floats([1, 0, 0], [0, 1, 0]))
    builder.mesh({"POSITION": number})
    assert only_mesh(builder, tmp_path).points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_arrays_can_be_written_to_and_lie_in_order(tmp_path: Path) -> None:
    """Kernels are compiled for such arrays once; a read-only one would compile them again."""
    builder = Builder()
    builder.mesh({"POSITION": SQUARE, "NORMAL": np.tile(floats([0, 0, 1]), (4, 1))}, SQUARE_FACES)
    mesh = only_mesh(builder, tmp_path)
    for array in (mesh.points, mesh.faces, mesh.normals):
        assert array.flags.c_contiguous and array.flags.writeable and array.flags.aligned


@pytest.mark.parametrize("name", ["model.gltf", "model.glb"])
def test_both_shells_hold_the_same_model(tmp_path: Path, name: str) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    scene = load(builder.write(tmp_path, name))
    assert scene.face_count == 2


def test_what_the_bytes_are_decides_not_the_suffix(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    path = tmp_path / "model.gltf"
    path.write_bytes(builder.glb())
    assert load(path).face_count == 2


def test_a_buffer_in_a_file_beside_is_found_by_its_percent_encoded_name(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    (tmp_path / "my data").mkdir()
    (tmp_path / "my data" / "räder.bin").write_bytes(builder.data)
    builder.json["buffers"] = [{"byteLength": len(builder.data), "uri": "my%20data/r%C3%A4der.bin"}]
    whole = builder.json
    builder.whole = lambda: whole  # type: ignore[method-assign]
    assert load(builder.write(tmp_path)).face_count == 2
