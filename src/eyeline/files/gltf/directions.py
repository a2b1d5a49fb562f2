"""Directions as a mesh keeps them: normals and tangents of length one."""

from __future__ import annotations

import numpy as np

from eyeline.files.gltf.blocks import Block
from eyeline.files.gltf.notes import Notes
from eyeline.files.gltf.part import spoken
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.normals import unit, vertex_normals

CLOSE = 1e-3  # how far from one a length may be that is taken as it is: far below what shading shows


def straightened(block: Block, mesh_name: str, notes: Notes) -> Block:
    """The block with unit normals and tangents; what had no length is found from the faces, and reported."""
    made: dict[str, FloatArray] = {}
    stored = block.attributes.get("NORMAL")
    if stored is not None and not is_unit(stored):
        lost = ~stored.any(axis=1)
        made["NORMAL"] = unit(stored.astype(np.float64)).astype(np.float32)
        if lost.any():
            notes.add(
                f"mesh {spoken(mesh_name)} has {lost.sum()} normals of length 0; they are made from its faces"
            )
            made["NORMAL"][lost] = vertex_normals(block.attributes["POSITION"], block.faces)[lost]
    stored = block.attributes.get("TANGENT")
    if stored is not None and "NORMAL" in block.attributes:
        side = np.where(stored[:, 3:] < 0, np.float32(-1), np.float32(1))
        along = stored[:, :3]
        if not is_unit(along):
            along = unit(along.astype(np.float64), (1.0, 0.0, 0.0)).astype(np.float32)
        made["TANGENT"] = np.concatenate([along, side], axis=1)
    if stored is not None and "NORMAL" not in block.attributes:
        attributes = {name: values for name, values in block.attributes.items() if name != "TANGENT"}
        notes.add(f"mesh {spoken(mesh_name)} has tangents without normals; they are left out")
        return Block(attributes, block.targets, block.faces, block.materials)
    return block.with_attributes(made)


def is_unit(vectors: FloatArray) -> bool:
    """Whether all vectors (N, 3) have length one."""
    return bool((np.abs((vectors * vectors).sum(axis=1) - 1) <= 2 * CLOSE).all())
