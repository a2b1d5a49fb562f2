"""Where nodes stand: in three parts, or by a matrix that could be given so. [glTF 2.0, 3.5.3]"""

from __future__ import annotations

import numpy as np

from eyeline.files.gltf.writing.store import Thing, numbers
from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.node import Node

STRAIGHT = 1e-6  # of a matrix's greatest number: how far from one without shear it may be


def parts_of(node: Node, moves: bool) -> Thing:
    """What a file says of a node's place; moves: a clip moves it, which a matrix forbids."""
    if node.matrix is None:
        return told(node.translation, node.rotation, node.scale)
    if moves or abs(np.linalg.det(node.matrix[:3, :3])) == 0:
        return told(*transform.decompose(node.matrix))
    return {"matrix": numbers(node.matrix.T)}


def told(translation: object, rotation: object, scale: object) -> Thing:
    """The three parts, without those that change nothing."""
    parts = {
        "translation": (np.asarray(translation, dtype=np.float64), (0, 0, 0)),
        "rotation": (np.asarray(rotation, dtype=np.float64), quaternion.IDENTITY),
        "scale": (np.asarray(scale, dtype=np.float64), (1, 1, 1)),
    }
    return {name: numbers(value) for name, (value, rest) in parts.items() if (value != rest).any()}


def is_sheared(matrix: FloatArray) -> bool:
    """Whether translation, rotation and scale cannot tell a matrix."""
    again = transform.compose(*transform.decompose(matrix))
    return bool(np.abs(again - matrix).max() > STRAIGHT * np.abs(matrix).max())


def unsheared(matrix: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two matrices without shear whose product is this one: stretched along its own axes, after a turn."""
    left, sizes, right = np.linalg.svd(matrix[:3, :3])
    # Turns have determinant one: a mirror goes to the sizes
    for turn, rows in ((left, False), (right, True)):
        if np.linalg.det(turn) < 0:
            sizes[-1] = -sizes[-1]
            turn[(-1,) if rows else (slice(None), -1)] *= -1
    outer, inner = np.eye(4), np.eye(4)
    outer[:3, :3] = left * sizes
    outer[:3, 3] = matrix[:3, 3]
    inner[:3, :3] = right
    return outer, inner
