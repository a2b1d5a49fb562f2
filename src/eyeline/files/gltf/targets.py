"""Morph targets: the shapes a mesh blends to, their names and weights. [glTF 2.0, 3.7.2.2]"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.attributes import UV_SETS
from eyeline.files.gltf.blocks import Block
from eyeline.files.gltf.part import Part
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import MorphTarget

WIDTHS = {"POSITION": 3, "NORMAL": 3, "TANGENT": 3, "TEXCOORD_0": 2, "TEXCOORD_1": 2, "COLOR_0": 4}


def targets_of(blocks: Sequence[Block], names: Sequence[str]) -> tuple[MorphTarget, ...]:
    """The morph targets of all blocks; no difference where a block says none."""
    count = max(len(block.targets) for block in blocks)
    targets = []
    for number in range(count):
        parts = [block.targets[number] if number < len(block.targets) else {} for block in blocks]
        whole: dict[str, FloatArray] = {}
        for name, width in WIDTHS.items():
            if any(name in part for part in parts):
                pieces = [
                    part[name] if name in part else np.zeros((block.count, width), np.float32)
                    for part, block in zip(parts, blocks, strict=True)
                ]
                whole[name] = np.concatenate(pieces)
        vertices = sum(block.count for block in blocks)
        uv = [whole.get(f"TEXCOORD_{k}") for k in range(UV_SETS)]
        while uv and uv[-1] is None:
            uv.pop()
        targets.append(
            MorphTarget(
                whole.get("POSITION"),
                whole.get("NORMAL"),
                whole.get("TANGENT"),
                tuple(np.zeros((vertices, 2), np.float32) if one is None else one for one in uv),
                whole.get("COLOR_0"),
                names[number] if number < len(names) else f"target {number}",
            )
        )
    return tuple(targets)


def target_names(part: Part) -> list[str]:
    """What the morph targets are called: a custom that most exporters follow, so never refused."""
    extras = part.values.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    if not isinstance(names, list):
        return []
    return [name if isinstance(name, str) else f"target {number}" for number, name in enumerate(names)]


def weights_of(part: Part, count: int) -> tuple[float, ...] | None:
    """The weights of the morph targets that a mesh or a node gives; None where it gives none."""
    if not part.has("weights"):
        return None
    weights = part.listed("weights")
    if len(weights) != count:
        raise FileError(f"{part.at('weights')} has {len(weights)} numbers for {count} morph targets")
    return part.numbers("weights", (0.0,) * count)
