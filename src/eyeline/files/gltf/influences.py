"""Which joints move a vertex, and how much. [glTF 2.0, 3.7.3.3]"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.files.gltf.blocks import Block
from eyeline.files.gltf.notes import Notes
from eyeline.files.gltf.part import spoken
from eyeline.geometry.arrays import FloatArray, IntArray

OFF = 1e-2  # how far from one the weights of a vertex may add up before it is reported


def influences_of(
    blocks: Sequence[Block], mesh_name: str, notes: Notes
) -> tuple[IntArray, FloatArray] | tuple[None, None]:
    """Joints (V, K) and influences (V, K) of all blocks, adding up to one; (None, None) without."""
    pairs = [_pair(block) for block in blocks]
    width = max(joints.shape[1] for joints, _ in pairs)
    if width == 0:
        return None, None
    joints = np.concatenate([_filled(one, width) for one, _ in pairs]).astype(np.int32)
    influences = np.concatenate([_filled(one, width) for _, one in pairs]).astype(np.float32)
    if (influences < 0).any():
        notes.add(f"mesh {spoken(mesh_name)} has weights below 0; they are taken as 0")
        influences = np.maximum(influences, 0)
    sums = influences.sum(axis=1)
    lost = sums == 0
    if lost.any():
        notes.add(
            f"mesh {spoken(mesh_name)} has {lost.sum()} vertices without weights; the first joint moves them"
        )
        joints[lost, 0], influences[lost, 0] = 0, 1
    if (np.abs(sums[~lost] - 1) > OFF).any():
        notes.add(f"mesh {spoken(mesh_name)} has weights that do not add up to 1; they are scaled to")
    joints[influences == 0] = 0
    return joints, influences / np.where(lost, 1, sums)[:, None]


def _pair(block: Block) -> tuple[FloatArray, FloatArray]:
    """The joints and weights of one block: sets 0, 1, ... side by side."""
    sets = sorted(name[6:] for name in block.attributes if name.startswith("JOINTS_"))
    both = [name for name in sets if f"WEIGHTS{name}" in block.attributes]
    if not both:
        return np.zeros((block.count, 0)), np.zeros((block.count, 0))
    return tuple(  # type: ignore[return-value]
        np.concatenate([block.attributes[f"{kind}{name}"] for name in both], axis=1)
        for kind in ("JOINTS", "WEIGHTS")
    )


def _filled(values: FloatArray, width: int) -> FloatArray:
    return np.pad(values, ((0, 0), (0, width - values.shape[1])))
