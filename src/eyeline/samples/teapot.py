"""The Utah teapot, from Newell's patches, 16 cm high."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.weld import welded
from eyeline.samples import newell
from eyeline.samples.shapes import Shape, grid, joined
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

TALL = 0.16  # metres; the real one in the Computer History Museum is much like it
STEPS = 14  # pieces of a patch's edge

PORCELAIN = Material("porcelain", (0.86, 0.83, 0.76, 1.0), roughness=0.16)


def teapot(material: Material = PORCELAIN) -> Scene:
    """A teapot that stands on y = 0 about the y axis, spout to +x: the body, and the lid as its child."""
    parts = newell.patches()
    body = joined(*(surface(parts[name]) for name in ("body", "handle", "spout")))
    pot = Node("teapot", mesh=body.mesh(material, "teapot"))
    lid: Mesh = surface(parts["lid"]).mesh(material, "lid")
    return Scene((pot, Node("lid", parent=0, mesh=lid)), name="teapot")


def surface(patches: FloatArray, steps: int = STEPS) -> Shape:
    """Bezier patches (P, 4, 4, 3) as triangles, y up and in metres, each patch with the whole texture."""
    t = np.linspace(0, 1, steps + 1)
    basis = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1)
    points = np.einsum("ai,bj,pijk->pabk", basis, basis, patches)
    upright = points[..., [0, 2, 1]] * (1, 1, -1) * (TALL / newell.HEIGHT)
    uv = np.stack(np.meshgrid(t, t, indexing="ij"), axis=-1)
    return welded_shape(joined(*(grid(one, uv) for one in upright)))


def welded_shape(shape: Shape) -> Shape:
    """The shape with the points of neighbouring patches made one."""
    first, index = welded(np.round(shape.points, 9))
    return Shape(shape.points[first], index[shape.faces], shape.corner_uv)
