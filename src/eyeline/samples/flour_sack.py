"""A flour sack, the animator's exercise: no face, no arms, and yet it thinks before it jumps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite
from eyeline.deform.lattice import Lattice
from eyeline.deform.stretch import Stretch
from eyeline.deform.twist import Twist
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion import Clip
from eyeline.motion.constraints import Drive
from eyeline.motion.track import Track
from eyeline.samples.cloth import sackcloth
from eyeline.samples.keyed import hermite, moves
from eyeline.samples.shapes import grid, sewn
from eyeline.samples.stage import cyclorama, paper, sun
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

WIDTH, HEIGHT, DEPTH = 0.30, 0.42, 0.20  # metres, before the corners are drawn out
CELLS = 40  # of each of its two cloths, both ways
CORNERS = {
    "left_foot": (1, 0),
    "right_foot": (-1, 0),
    "left_ear": (1, 1),
    "right_ear": (-1, 1),
}  # side, end; it looks along z, so that its left is at x > 0
CONTROLS = (
    "lean", "sway", "twist", "squash", *(f"{corner}_{way}" for corner in CORNERS for way in ("lift", "step")),
)  # fmt: skip


def flour_sack() -> Scene:
    """A sack 0.45 m high on a stage, looking along z; clip `hop`.

    Controls of the node "sack": lean (radians, forwards), sway (radians, to its left), twist (radians about
    y), squash (its height gains so much: -0.3 is a third shorter, and wider for it); and of each corner,
    left_foot, right_foot, left_ear, right_ear: lift and step (metres, up and forwards).
    """
    camera = Camera.look_at((-0.30, 0.40, 1.62), (-0.06, 0.31, 0.0), focal_length=43)
    nodes = (
        *sack(),
        Node("backdrop", mesh=cyclorama(paper("blue paper", (0.30, 0.50, 0.56)))),
        Node("camera", matrix=camera.world_from_eye, camera=camera),
        sun((-2, 4, 3.4), 2.8, (1.0, 0.95, 0.87), "window"),
        sun((3, 2, 1.5), 0.6, (0.75, 0.85, 1.0), "sky"),
        sun((1.5, 2.5, -3), 0.7, (1.0, 0.88, 0.74), "rim"),
    )
    return Scene(nodes, (hop(),), name="flour sack", constraints=drives())


def sack() -> tuple[Node, ...]:
    """Where it stands, with its controls; and the cloth that they bend."""
    x, y, z, w = quaternion.from_axis_angle((0, 1, 0), YAW).tolist()
    facing = (x, y, z, w)
    return (
        Node("sack", rotation=facing, controls=dict.fromkeys(CONTROLS, 0.0)),
        Node("cloth", 0, mesh=body(), deform=bends()),
    )


# --- the cloth --------------------------------------------------------------------------------------------


def body() -> Mesh:
    """Two cloths sewn along their rims, filled: wide at the floor, with four corners drawn out."""
    s = np.sin(np.linspace(-1, 1, CELLS + 1) * math.pi / 2)  # close at the seams, where it is round
    u, v = np.meshgrid(s, s, indexing="ij")
    down = 0.5 - v / 2
    front = grid(_cloth(u, v, 1.0), np.stack([0.25 + u / 4, down], axis=-1))
    back = grid(_cloth(u[::-1], v, -1.0), np.stack([0.75 - u[::-1] / 4, down], axis=-1))
    return sewn(front, back).mesh(sackcloth(), "sack", crease=math.pi)


def _cloth(u: FloatArray, v: FloatArray, side: float) -> FloatArray:
    """Points (..., 3) of the front (side 1) or the back (-1); u, v: -1..1 to its left and up."""
    up, top = (v + 1) / 2, v > 0
    # A pillow's rim is drawn in between its corners, most at the neck; the flour sinks and makes a belly
    neck = 1 - 0.10 * np.exp(-(((up - 0.86) / 0.10) ** 2))
    x = u * WIDTH / 2 * (0.86 + 0.16 * v * v + 0.12 * (1 - up)) * neck
    y = HEIGHT * up - v * np.where(top, 0.05, 0.008) * (1 - u * u)
    fill = np.sqrt((1 - u * u) * (1 - np.abs(v) ** np.where(top, 2.0, 6.0)))
    z = side * DEPTH / 2 * fill**0.9 * (1.15 - 0.45 * up**1.4) * neck
    # Corners are drawn out along their diagonals, with folds that run into them
    gap = np.hypot(1 - np.abs(u), 1 - np.abs(v))
    pull = np.exp(-((gap / 0.42) ** 2))
    x = x + np.sign(u) * np.where(top, 0.026, 0.020) * pull
    y = y + np.where(top, 0.034, 0.0) * pull
    angle = np.arctan2(1 - np.abs(v), 1 - np.abs(u))
    z = z + side * 0.004 * np.cos(8 * angle) * np.exp(-(((gap - 0.34) / 0.2) ** 2)) * fill
    return np.stack([x, y, z], axis=-1)


# --- what bends it ----------------------------------------------------------------------------------------


def bends() -> Composite:
    """Corners first, then its length, then turns: each keeps what the one before made."""
    low, high = (-WIDTH / 2, 0.0, -DEPTH / 2), (WIDTH / 2, HEIGHT, DEPTH / 2)
    return Composite.of(
        Lattice.of((3, 4, 2), lower=low, upper=high, name="corners"),
        Stretch(upper=HEIGHT, name="squash"),
        Twist(upper=HEIGHT, name="twist"),
        Bend(upper=HEIGHT, name="sway"),
        Bend(upper=HEIGHT, towards=-math.pi / 2, name="lean"),
    )


def drives() -> tuple[Drive, ...]:
    """Which control moves which number of the bends."""
    numbers = {"lean": "angle", "sway": "angle", "twist": "angle", "squash": "amount"}
    made = [
        Drive(name, "cloth", f"deform.{name}.{number}", f"sack.{name}") for name, number in numbers.items()
    ]
    for corner, (side, end) in CORNERS.items():
        for way, axis in (("lift", 1), ("step", 2)):
            offsets = np.zeros((3, 4, 2, 3))
            offsets[1 + side, 3 * end, :, axis] = 1
            name = f"{corner}_{way}"
            made.append(Drive(name, "cloth", "deform.corners.offsets", f"sack.{name}", offsets))
    return tuple(made)


# --- its clip ---------------------------------------------------------------------------------------------

YAW = math.radians(48)  # it hops to the right of the picture, and a little towards us
OFF, DOWN = 0.68, 1.12  # seconds: the feet leave the floor, and touch it again
FROM, REACH = -0.36, 0.50  # metres along its way: where it begins, and how far it jumps
GRAVITY = 9.81

ACTS: Mapping[str, Sequence[tuple[float, float]]] = {
    # Anticipation, a stretch that leaves the floor, a soft landing that settles
    "squash": [
        (0.0, 0.0), (0.14, 0.03), (0.46, -0.36), (0.54, -0.37), (OFF, 0.26), (0.86, 0.02), (1.02, 0.06),
        (DOWN, 0.14), (1.20, -0.40), (1.40, 0.13), (1.58, -0.06), (1.76, 0.02), (1.94, 0.0), (2.86, 0.0),
        (3.06, -0.12), (3.24, 0.10), (3.50, 0.0),
    ],
    "lean": [
        (0.0, 0.0), (0.20, -0.16), (0.50, 0.42), (OFF, 0.46), (0.88, -0.05), (DOWN, -0.30), (1.22, 0.34),
        (1.44, -0.16), (1.64, 0.07), (1.86, 0.0), (3.5, 0.0),
    ],
    # Then it looks about: was that seen?
    "twist": [
        (0.0, 0.0), (1.94, 0.0), (2.14, -0.62), (2.40, -0.66), (2.64, 0.62), (2.92, 0.66),
        (3.2, 0.0), (3.5, 0.0),
    ],
    "sway": [
        (0.0, 0.0), (1.94, 0.0), (2.16, 0.10), (2.42, 0.11), (2.66, -0.12), (2.92, -0.13),
        (3.2, 0.0), (3.5, 0.0),
    ],
    "foot_step": [(0.0, 0.0), (OFF, 0.0), (0.76, -0.05), (0.98, 0.07), (DOWN, 0.05), (1.24, 0.0), (3.5, 0.0)],
    "foot_lift": [(0.0, 0.0), (OFF, 0.0), (0.86, 0.035), (DOWN, 0.0), (3.5, 0.0)],
    # Ears come late
    "ear_lift": [
        (0.0, 0.0), (0.22, -0.01), (0.50, 0.05), (0.62, 0.05), (0.76, -0.07), (0.98, 0.04), (1.14, 0.07),
        (1.30, -0.08), (1.50, 0.05), (1.70, -0.03), (1.90, 0.01), (2.10, 0.0), (2.90, 0.0), (3.10, 0.03),
        (3.30, -0.02), (3.5, 0.0),
    ],
    "ear_step": [
        (0.0, 0.0), (0.24, 0.03), (0.54, -0.04), (0.78, -0.09), (1.0, 0.03), (1.16, 0.06), (1.34, -0.05),
        (1.54, 0.04), (1.76, -0.02), (2.0, 0.0), (3.5, 0.0),
    ],
}  # fmt: skip


def hop() -> Clip:
    """It gathers itself, leaps, lands and settles, and looks whether anyone saw: 3.5 s."""
    tracks: list[Track] = [leap()]
    for name, keys in ACTS.items():
        late = {"left": 0.0, "right": 0.03} if name.startswith(("foot", "ear")) else {"": 0.0}
        for side, delay in late.items():
            later = [(time + delay if 0 < time < 3.5 else time, value) for time, value in keys]
            tracks.append(moves("sack", later, f"controls.{side}_{name}" if side else f"controls.{name}"))
    return Clip("hop", tracks)


def leap() -> Track:
    """Along a parabola while it is in the air."""
    flight = DOWN - OFF
    ahead = np.array([math.sin(YAW), 0.0, math.cos(YAW)])
    forth, rise = ahead * REACH / flight, np.array([0.0, GRAVITY * flight / 2, 0.0])
    still = np.zeros(3)
    places = np.array([FROM, FROM, FROM + REACH, FROM + REACH])[:, None] * ahead
    return Track(
        "node", "sack", "translation",
        hermite(
            np.array([0.0, OFF, DOWN, 3.5]), places,
            np.array([still, still, forth - rise, still]), np.array([still, forth + rise, still, still]),
        ),
    )  # fmt: skip
