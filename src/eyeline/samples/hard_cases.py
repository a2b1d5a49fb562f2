"""Scenes that are hard for one way of finding hidden surfaces or another; each says for which, and why."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.samples.shapes import Shape, sheet
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

RED = Material("red", (0.72, 0.10, 0.07, 1.0))
BLUE = Material("blue", (0.06, 0.22, 0.58, 1.0))
YELLOW = Material("yellow", (0.84, 0.50, 0.05, 1.0))
GREEN = Material("green", (0.10, 0.40, 0.16, 1.0))
PAPER = Material("paper", (0.80, 0.78, 0.74, 1.0))
SOLID = Material("clay", (0.62, 0.30, 0.16, 1.0), double_sided=False)
COLOURS = (RED, BLUE, YELLOW, GREEN)

STACKED = 64  # sheets
VIEW = 2.4  # metres high, of the pages below: one unit is a metre, x right, y up, z towards the eye


@dataclass(frozen=True)
class HardCase:
    """Which methods a scene is hard for, and why, in a sentence."""

    methods: tuple[str, ...]
    why: str


HARD_CASES: Mapping[str, HardCase] = {
    "cyclic_overlap": HardCase(
        ("painter",),
        "four planks lie each over the next in a ring: no order paints them right until one is cut",
    ),
    "piercing_faces": HardCase(
        ("painter", "scanline"),
        "three sheets cut through each other: which is nearer changes inside a face, far from every edge",
    ),
    "coplanar_faces": HardCase(
        ("zbuffer", "raycast", "painter"),
        "sheets share one plane: rounding decides who is nearer, unless a rule does (the lower number wins)",
    ),
    "edge_on_faces": HardCase(
        ("backface", "roberts", "scanline"),
        "sheets turn about one axis, some exactly edge-on: their N . V is 0, and they cover no pixel",
    ),
    "t_junction": HardCase(
        ("zbuffer", "scanline"),
        "a corner lies on an edge that has no corner there: rounded, the two leave a crack to the red behind",
    ),
    "deep_stack": HardCase(
        ("painter", "zbuffer", "warnock"),
        "64 sheets lie behind each other: nearly all work is for what nobody sees, unless it is left out",
    ),
    "convex_body": HardCase(
        (),
        "one convex body: fronts never hide each other, so back-face removal alone is the whole answer",
    ),
    "concave_body": HardCase(
        ("backface", "roberts"),
        "a star: its points hide its own fronts, so the sign of N . V is not enough, nor is one convex body",
    ),
}  # fmt: skip


def cyclic_overlap() -> Scene:
    """Four planks in a ring, each over the next at one end and under the one before at the other."""
    planks = [plank(k * math.pi / 2) for k in range(4)]
    return case("cyclic_overlap", {f"plank {k}": (one, COLOURS[k]) for k, one in enumerate(planks)})


def piercing_faces() -> Scene:
    """Three sheets that cut through each other."""
    sheets = {
        "leaning right": (page(-0.9, -0.7, 0.9, 0.5, slope=(0.7, 0)), RED),
        "leaning left": (page(-0.8, -0.5, 1.0, 0.7, slope=(-0.7, 0)), BLUE),
        "leaning back": (page(-0.5, -0.9, 0.5, 0.9, slope=(0, 0.8)), YELLOW),
    }
    return case("piercing_faces", sheets)


def coplanar_faces() -> Scene:
    """Three sheets in one plane, one over another, and paper behind them."""
    sheets = {
        "first": (page(-0.9, -0.3, 0.3, 0.7), RED),
        "second": (page(-0.5, -0.7, 0.7, 0.3), BLUE),
        "third": (page(-0.1, -0.5, 1.0, 0.5), YELLOW),
        "paper": (page(-1.3, -0.95, 1.3, 0.95, z=-0.5), PAPER),
    }
    return case("coplanar_faces", sheets)


def edge_on_faces() -> Scene:
    """Twelve sheets around an upright axis, every 15 degrees: one faces the eye, one is exactly edge-on."""
    sheets = {}
    for k in range(12):
        # The quarter turn in whole numbers: an edge-on sheet is exactly that
        x, z = (0.0, 1.0) if k == 6 else (math.cos(k * math.pi / 12), math.sin(k * math.pi / 12))
        low, high = np.array([0.25 * x, -0.8, 0.25 * z]), np.array([x, 0.8, z])
        corners = np.array([low, (x, -0.8, z), high, (low[0], 0.8, low[2])])
        sheets[f"{15 * k} degrees"] = (sheet(corners), COLOURS[k % 4])
    return case("edge_on_faces", sheets)


def t_junction() -> Scene:
    """Two sheets meet the long side of a third, slanting, with no corner of its own there; red behind."""
    top, bottom, middle = np.array([0.13, 0.9, 0]), np.array([-0.21, -0.9, 0]), 0.37
    joint = bottom + (top - bottom) * middle
    right_top, right_bottom = np.array([1.1, 0.9, 0]), np.array([1.1, -0.9, 0])
    right_joint = np.array([1.1, 0.07, 0])
    sheets = {
        "whole": (sheet(np.array([(-1.1, -0.9, 0), bottom, top, (-1.1, 0.9, 0)])), BLUE),
        "lower": (sheet([bottom, right_bottom, right_joint, joint]), YELLOW),
        "upper": (sheet([joint, right_joint, right_top, top]), GREEN),
        "behind": (page(-1.05, -0.85, 1.05, 0.85, z=-0.5), RED),
    }
    return case("t_junction", sheets)


def deep_stack() -> Scene:
    """64 sheets, one behind the other, each a little lower and to the right of the one before it."""
    sheets = {}
    for k in range(STACKED):
        part = k / (STACKED - 1)
        colour = Material("", (0.10 + 0.74 * part, 0.16 + 0.30 * part, 0.56 - 0.50 * part, 1.0))
        x, y = -0.25 + 0.5 * part, 0.12 - 0.24 * part
        sheets[f"sheet {k}"] = (page(x - 0.9, y - 0.7, x + 0.9, y + 0.7, z=-part), colour)
    return case("deep_stack", sheets)


def convex_body() -> Scene:
    """A regular dodecahedron, closed, its fronts outside."""
    return case("convex_body", {"dodecahedron": (dodecahedron(), SOLID)}, eye=(1.1, 0.9, 2.6))


def concave_body() -> Scene:
    """A prism over a star with five points, closed, its fronts outside."""
    return case("concave_body", {"star": (star(), SOLID)}, eye=(1.3, 1.1, 2.4))


# --- how they are made --------------------------------------------------------------------------------------


def case(
    name: str, parts: dict[str, tuple[Shape, Material]], eye: tuple[float, float, float] = (0, 0, 4)
) -> Scene:
    """Named shapes before an orthographic camera; the note says what is hard about them."""
    nodes = [Node(part, mesh=mesh(shape, colour)) for part, (shape, colour) in parts.items()]
    camera = Camera.look_at(eye, (0, 0, 0), height=VIEW)
    hard = HARD_CASES[name]
    note = f"hard for {', '.join(hard.methods) or 'no method'}: {hard.why}"
    return replace(Scene.of(*nodes, camera, name=name), notes=(note,))


def mesh(shape: Shape, colour: Material) -> Mesh:
    """A mesh with all its edges sharp."""
    return shape.mesh(colour, crease=0.0)


def page(
    left: float, low: float, right: float, high: float, z: float = 0.0, slope: tuple[float, float] = (0, 0)
) -> Shape:
    """A rectangle on the page at height z in its middle, rising to the right and upwards by `slope`."""
    x, y = (left + right) / 2, (low + high) / 2
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return sheet([(a, b, z + slope[0] * (a - x) + slope[1] * (b - y)) for a, b in corners])


def plank(turn: float) -> Shape:
    """One side of the ring, rising along its length, turned about the view."""
    flat = page(-0.95, 0.32, 0.95, 0.72, slope=(0.3, 0)).points
    c, s = round(math.cos(turn)), round(math.sin(turn))
    return sheet(flat @ np.array([(c, s, 0), (-s, c, 0), (0, 0, 1)]))


def dodecahedron() -> Shape:
    """Twelve pentagons in a ball of radius 0.9, each of three triangles."""
    golden = (1 + math.sqrt(5)) / 2
    signs = [(a, b) for a in (-1, 1) for b in (-1, 1)]
    points: list[tuple[float, ...]] = [(a, b, c) for a, b in signs for c in (-1, 1)]
    normals: list[tuple[float, ...]] = []
    for a, b in signs:
        # Three that differ by a turn about (1, 1, 1)
        point, normal = (0, a / golden, b * golden), (0, a * golden, b)
        points += [point[k:] + point[:k] for k in range(3)]
        normals += [normal[k:] + normal[:k] for k in range(3)]
    corners = np.array(points) * (0.9 / math.sqrt(3))
    return of_polygons(corners, [pentagon(corners, np.array(normal)) for normal in normals])


def pentagon(corners: FloatArray, normal: FloatArray) -> list[int]:
    """The five corners farthest along a normal, counter-clockwise seen from its end."""
    chosen = np.argsort(corners @ normal)[-5:]
    spokes = corners[chosen] - corners[chosen].mean(axis=0)
    right, up = spokes[0], np.cross(normal / np.sqrt(normal @ normal), spokes[0])
    turns = np.arctan2(spokes @ up, spokes @ right)
    return [int(corner) for corner in chosen[np.argsort(turns)]]


def star() -> Shape:
    """A five-pointed star, 0.5 metres thick: two stars of triangles around their middles, ten sides."""
    turn = np.arange(10) * math.pi / 5 + math.pi / 2
    reach = np.where(np.arange(10) % 2 == 0, 1.0, 0.42)
    rim = np.stack([reach * np.cos(turn), reach * np.sin(turn)], axis=1)
    near, far = np.hstack([rim, np.full((10, 1), 0.25)]), np.hstack([rim, np.full((10, 1), -0.25)])
    corners = np.concatenate([near, far, [(0, 0, 0.25), (0, 0, -0.25)]])
    faces = []
    for k in range(10):
        after = (k + 1) % 10
        faces += [[k, after, 20], [10 + after, 10 + k, 21], [k, 10 + k, 10 + after, after]]
    return of_polygons(corners, faces)


def of_polygons(corners: FloatArray, polygons: list[list[int]]) -> Shape:
    """A shape of convex polygons, each cut into triangles around its first corner."""
    faces = np.array([(one[0], one[k], one[k + 1]) for one in polygons for k in range(1, len(one) - 1)])
    uv = np.array([(0.0, 1.0), (1.0, 1.0), (1.0, 0.0)])
    return Shape(corners, faces, np.broadcast_to(uv, (len(faces), 3, 2)).copy())
