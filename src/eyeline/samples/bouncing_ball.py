"""A ball that bounces across a stage, with squash and stretch, and rolls to rest."""

from __future__ import annotations

import math

import numpy as np

from eyeline.motion import Clip
from eyeline.samples.bounces import Bounces, tracks
from eyeline.samples.keyed import hermite
from eyeline.samples.shapes import mesh_of
from eyeline.samples.solids import ball as sphere_shape
from eyeline.samples.stage import cyclorama, sun
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

CREAM = Material("cream", (0.86, 0.78, 0.62, 1.0), roughness=0.35)
RED = Material("red", (0.70, 0.05, 0.03, 1.0), roughness=0.35)
NAVY = Material("navy", (0.02, 0.05, 0.16, 1.0), roughness=0.35)
PANELS = 6
RADIUS = 0.06  # metres

START, END = (-0.78, 0.0, 0.12), (0.34, 0.0, 0.12)
SECONDS = 4.0


def bouncing_ball() -> Scene:
    """A ball of 12 cm that falls in from the left, bounces five times and rolls out: a clip of 4 s."""
    camera = Camera.look_at((-0.02, 0.30, 1.55), (-0.12, 0.23, 0.0), focal_length=36)
    scene = (
        *ball_nodes(),
        Node("backdrop", mesh=cyclorama()),
        Node("camera", matrix=camera.world_from_eye, camera=camera),
        sun((-2, 5, 3), 2.9, (1.0, 0.96, 0.90), "window"),
        sun((3, 2, 2), 0.5, (0.75, 0.85, 1.0), "sky"),
    )
    return Scene(scene, (bounce(),), name="bouncing ball")


def ball_nodes() -> tuple[Node, ...]:
    """Where it is on the floor; how high and how squashed; how it is turned: none disturbs another."""
    return (Node("ball"), Node("squash", 0), Node("spin", 1, mesh=beach_ball(RADIUS)))


def beach_ball(radius: float) -> Mesh:
    """A sphere of cream and red panels, with navy caps."""
    shape = sphere_shape(radius)
    middles = shape.points[shape.faces].mean(axis=1)
    panel = np.floor(np.arctan2(-middles[:, 2], middles[:, 0]) / (2 * math.pi) * PANELS).astype(int) % 2
    panel[np.abs(middles[:, 1]) > radius * math.cos(math.pi / 12)] = 2
    mesh = mesh_of({CREAM: shape}, "ball")
    return mesh.changed(materials=(CREAM, RED, NAVY), face_material=panel.astype(np.int32))


def bounce() -> Clip:
    """Five bounces and a roll."""
    bounces = Bounces(RADIUS, 0.52, (0.36, 0.21, 0.11, 0.045))
    stop = bounces.landings[-1]
    speed = 0.36
    along = hermite(
        np.array([0.0, stop, SECONDS]), np.array([0.0, speed * stop, 1.0]),
        np.array([speed, speed, 0.0]), np.array([speed, speed, 0.0]),
    )  # fmt: skip
    return Clip("bounce", tracks(bounces, along, START, END))
