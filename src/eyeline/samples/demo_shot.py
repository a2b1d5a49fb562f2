"""The demo's shot: a lamp watches a ball bounce past, and what it does to a teapot."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from eyeline.geometry import quaternion, transform
from eyeline.motion import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track
from eyeline.samples.bounces import Bounces, carried, tracks
from eyeline.samples.bouncing_ball import RADIUS, ball_nodes
from eyeline.samples.desk_lamp import bends, lamp
from eyeline.samples.keyed import Key, flowing, hermite, moves, swings
from eyeline.samples.stage import cyclorama, sun, together
from eyeline.samples.teapot import teapot
from eyeline.scene.camera import Camera, fov_of
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

SECONDS = 4.8
HIT = 2.2  # seconds; the ball touches the teapot
FRAME = 1 / 24  # seconds between the camera's keys

# Places on the floor: x, z in metres
LAMP, POT = (-0.30, -0.08), (0.40, -0.06)
BALL_START, BALL_END = (-0.95, 0.0, 0.50), (0.312, 0.0, 0.073)
Y = (0.0, 1.0, 0.0)


def demo_shot() -> Scene:
    """A lamp, a ball and a teapot on a stage; camera and clip `shot` of 4.8 s."""
    pot, lid = teapot().nodes
    table = (
        Node("place", translation=(POT[0], 0, POT[1])),
        replace(pot, parent=0, rotation=yaw(-34)),
        replace(lid, parent=1),
    )
    lamp_nodes = lamp()
    lamp_nodes = (replace(lamp_nodes[0], translation=(LAMP[0], 0, LAMP[1])), *lamp_nodes[1:])
    camera = (Node("camera", camera=Camera(fov=fov_of(42))),)
    lights = (
        sun((-1.6, 3.4, 2.6), 2.9, (1.0, 0.95, 0.88), "window"),
        sun((2.5, 1.6, 1.2), 0.70, (0.70, 0.82, 1.0), "sky"),
        sun((1.6, 2.2, -3.0), 0.85, (1.0, 0.88, 0.74), "rim"),
    )
    stage = (Node("backdrop", mesh=cyclorama()),)
    nodes = together(lamp_nodes, ball_nodes(), table, stage, camera, lights)
    clip = shot()
    return replace(clip.pose(Scene(nodes, name="demo shot"), 0.0), clips=(clip,))


def yaw(degrees: float) -> tuple[float, float, float, float]:
    """A turn about y."""
    x, y, z, w = quaternion.from_axis_angle(Y, math.radians(degrees)).tolist()
    return x, y, z, w


def shot() -> Clip:
    """Everything that moves."""
    ball, ball_tracks = ball_way()
    return Clip("shot", [*ball_tracks, *lamp_acts(ball), *teapot_rattles(), *camera_moves()])


# --- the ball ---------------------------------------------------------------------------------------------


def ball_way() -> tuple[Curve, list[Track]]:
    """Where the ball is on the floor, and its tracks: in from the left, a knock, and back a little."""
    bounces = Bounces(RADIUS, 0.44, (0.34, 0.19, 0.085))
    speed = 1 / HIT
    along = hermite(
        np.array([0.0, HIT, 3.2]), np.array([0.0, 1.0, 0.87]),
        np.array([speed, speed, 0.0]), np.array([speed, -0.62 * speed, 0.0]),
    )  # fmt: skip
    return carried(along, BALL_START, np.subtract(BALL_END, BALL_START)), tracks(
        bounces, along, BALL_START, BALL_END
    )


# --- the lamp ---------------------------------------------------------------------------------------------


def lamp_acts(ball: Curve) -> list[Track]:
    """It dreams, hears the ball, follows it, starts at the knock, leans in, is glad, and looks at us."""
    watched = [(time, bearing(ball.at([time - 0.07])[0])) for time in (0.84, 1.1, 1.36, 1.62, 1.88, 2.2)]
    turns: list[Key] = [
        (0.0, -20.0), (0.32, -20.0), (0.44, -12.0), *watched, (2.34, watched[-1][1] + 9),
        (2.9, watched[-1][1] + 2), (3.42, watched[-1][1]), (3.62, watched[-1][1] + 5),
        (4.0, -70.0), (SECONDS, -70.0),
    ]  # fmt: skip
    poses: Mapping[float, tuple[float, float, float]] = {
        0.0: (0, 0, 0), 0.32: (1, -1, -3), 0.46: (-4, 8, 10), 0.84: (3, -2, 16), 1.2: (4, -8, -8),
        1.6: (2, -3, -3), 1.95: (-4, 5, 2), 2.2: (-6, 8, 3),
        2.26: (-7, 9, 4), 2.38: (17, 6, 44), 2.52: (13, 2, 36), 2.78: (14, 3, 38),  # a start
        3.04: (-20, 0, 2), 3.1: (-21, -1, -2), 3.34: (-22, -2, -6),  # a closer look
        3.52: (22, -40, 20), 3.62: (22, -40, 20), 3.72: (-14, 34, -4), 3.86: (4, -6, 4),  # a hop
        4.02: (16, -26, 16),
        4.26: (-5, 10, 24), 4.44: (-2, 4, 14), 4.58: (-3, 6, 22), SECONDS: (-3, 5, 19),  # a look at us
    }  # fmt: skip
    x, z = LAMP
    hop = [(0.0, 0.0), (3.68, 0.0), (3.83, 0.085), (3.98, 0.0), (SECONDS, 0.0)]
    flight = [(time, (x, height, z)) for time, height in hop]
    return [*bends(poses), swings("lamp", turns, Y), moves("lamp", flight)]


def bearing(target: Sequence[float]) -> float:
    """Degrees about y for the lamp to face a place."""
    return math.degrees(math.atan2(-(target[2] - LAMP[1]), target[0] - LAMP[0]))


# --- the teapot and the camera ----------------------------------------------------------------------------


def teapot_rattles() -> list[Track]:
    """The pot rocks, its lid jumps and comes to rest."""
    rock = [
        (0.0, 0.0),
        (HIT, 0.0),
        (HIT + 0.07, -5.0),
        (HIT + 0.19, 2.6),
        (HIT + 0.30, -1.2),
        (HIT + 0.42, 0.0),
    ]
    jumps = [
        (0.0, 0.0),
        (0.02, 0.0),
        (0.12, 0.034),
        (0.22, 0.0),
        (0.28, 0.010),
        (0.34, 0.0),
        (0.37, 0.003),
        (0.40, 0.0),
    ]
    tilt = [(0.0, 0.0), (0.02, 0.0), (0.12, 13.0), (0.22, -4.0), (0.30, 3.0), (0.40, 0.0)]
    lid = "place/teapot/lid"
    return [
        swings("place", rock),
        moves(lid, [(HIT + time if time else 0.0, (0, height, 0)) for time, height in jumps]),
        swings(lid, [(HIT + time if time else 0.0, angle) for time, angle in tilt], (0.8, 0.0, 0.6)),
    ]


def camera_moves() -> list[Track]:
    """In slowly, and a little around."""
    eye = flowing([(0.0, (0.30, 0.30, 1.62)), (2.2, (0.18, 0.27, 1.36)), (SECONDS, (-0.12, 0.25, 1.16))])
    target = flowing([(0.0, (-0.02, 0.17, 0.0)), (2.2, (0.05, 0.165, 0.0)), (SECONDS, (0.0, 0.18, 0.0))])
    times = np.linspace(0, SECONDS, round(SECONDS / FRAME) + 1)
    looks = np.stack([transform.look_at(*pair) for pair in zip(eye.at(times), target.at(times), strict=True)])
    place, turn, _ = transform.decompose(looks)
    return [
        Track("node", "camera", "translation", Curve(times, place)),
        Track("node", "camera", "rotation", Curve(times, turn, rotation=True)),
    ]
