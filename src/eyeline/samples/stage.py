"""A stage for the moving samples: a floor that bends up into a backdrop, and lights."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.samples.shapes import grid, rounded
from eyeline.scene.light import Light
from eyeline.scene.material import Colour, Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node

PEACH = Material("peach paper", (0.93, 0.55, 0.32, 1.0), roughness=0.9)


def paper(name: str, color: Colour) -> Material:
    """Paper of another colour, linear."""
    return Material(name, (*color, 1.0), roughness=0.9)


def cyclorama(material: Material = PEACH, width: float = 8.0, front: float = 3.0, back: float = 1.3) -> Mesh:
    """A sheet of paper: floor from z = front to z = -back, there up to a wall in a wide bend; metres."""
    height = 4.0
    outline = rounded([(front, 0), (-back, 0), (-back, height)], radius=0.9, steps=24)
    x = np.linspace(-width / 2, width / 2, 9)
    z, y = outline[:, :1], outline[:, 1:]
    points = np.stack(np.broadcast_arrays(x[None, :], y, z), axis=-1)
    u, v = np.meshgrid(np.linspace(0, 1, len(x)), np.linspace(1, 0, len(outline)))
    rows_out = np.swapaxes(points, 0, 1)
    return grid(rows_out, np.swapaxes(np.stack([u, v], axis=-1), 0, 1)).mesh(material, "backdrop")


def sun(position: FloatArray | tuple[float, float, float], lux: float, color: Colour, name: str) -> Node:
    """A directional light that shines from a position towards the origin."""
    return Node(
        name, matrix=transform.look_at(position, (0, 0, 0)), light=Light("directional", color, lux, name=name)
    )


def together(*groups: tuple[Node, ...]) -> tuple[Node, ...]:
    """Groups of nodes side by side: each group's parents and joints count from its own first node."""
    nodes: list[Node] = []
    for group in groups:
        start = len(nodes)
        nodes += [beneath(node, start) for node in group]
    return tuple(nodes)


def beneath(node: Node, start: int) -> Node:
    """The node with its parent, and the joints of its skin, counted from `start`."""
    parent = node.parent if node.parent < 0 else node.parent + start
    skin = node.skin
    if skin is not None:
        skin = replace(skin, joints=tuple(joint + start for joint in skin.joints))
    return replace(node, parent=parent, skin=skin)
