"""A desk lamp on two sprung arms, every joint a node: it can nod and hop."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache

import numpy as np

from eyeline.geometry import quaternion
from eyeline.motion import Clip
from eyeline.motion.track import Track
from eyeline.samples.keyed import moves, swings
from eyeline.samples.shapes import Shape, box, joined, lathe, mesh_of, rounded, tube
from eyeline.samples.solids import ball
from eyeline.samples.stage import cyclorama, sun, together
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

ENAMEL = Material("teal enamel", (0.012, 0.14, 0.16, 1.0), roughness=0.28)
STEEL = Material("nickel", (0.66, 0.65, 0.63, 1.0), metallic=0.25, roughness=0.30)
BRASS = Material("brass", (0.78, 0.47, 0.12, 1.0), metallic=0.25, roughness=0.30)
REFLECTOR = Material("reflector", (0.95, 0.90, 0.80, 1.0), roughness=0.6, emissive=(0.75, 0.50, 0.24))
GLASS = Material("glowing glass", (1.0, 0.95, 0.85, 1.0), roughness=0.4, emissive=(7.0, 5.2, 3.0))

LOWER, UPPER = 0.21, 0.19  # metres, the arms from joint to joint
SHOULDER = 0.048  # metres above the table
REST = {"lower arm": 28.0, "upper arm": -82.0, "head": -72.0}  # degrees about z; the lamp looks along +x
Z = (0.0, 0.0, 1.0)


def desk_lamp() -> Scene:
    """A lamp 0.4 m high on a stage, looking along +x; clips `hop` and `nod`."""
    camera = Camera.look_at((0.58, 0.36, 0.92), (0.10, 0.19, 0.0), focal_length=38)
    lights = (
        sun((-2, 5, 3), 2.7, (1.0, 0.95, 0.88), "window"),
        sun((3, 2, 2), 0.5, (0.75, 0.85, 1.0), "sky"),
    )
    surroundings = (
        Node("backdrop", mesh=cyclorama()),
        Node("camera", matrix=camera.world_from_eye, camera=camera),
    )
    return Scene(together(lamp(), surroundings, lights), (hop(), nod()), name="desk lamp")


@cache
def lamp() -> tuple[Node, ...]:
    """The lamp's nodes, from its foot on the table to its light."""
    bend = {
        name: tuple(quaternion.from_axis_angle(Z, math.radians(angle)).tolist())
        for name, angle in REST.items()
    }
    towards_mouth = tuple(quaternion.from_axis_angle((1, 0, 0), math.pi / 2).tolist())
    light = Light(
        "spot", (1.0, 0.80, 0.52), 0.42, inner_cone=math.radians(24), outer_cone=math.radians(54), name="bulb"
    )
    return (
        Node("lamp"),
        Node("base", 0, mesh=base()),
        Node("lower arm", 0, (0, SHOULDER, 0), bend["lower arm"], mesh=arm(LOWER)),
        Node("upper arm", 2, (0, LOWER, 0), bend["upper arm"], mesh=arm(UPPER)),
        Node("head", 3, (0, UPPER, 0), bend["head"], mesh=head()),
        Node("bulb", 4, (0, 0.098, 0), mesh=ball(0.026, 24).mesh(GLASS, "bulb")),
        Node("light", 4, (0, 0.128, 0), towards_mouth, light=light),
    )


# --- its parts --------------------------------------------------------------------------------------------


def base() -> Mesh:
    """A heavy foot, and the fork that holds the shoulder."""
    foot = lathe(rounded([(0, 0), (0.088, 0), (0.088, 0.012), (0.05, 0.024), (0, 0.026)], 0.006, 6), 72)
    cheeks = [box((0.022, 0.040, 0.005), 0.002).moved((0, 0.042, z)) for z in (-0.022, 0.022)]
    return mesh_of({ENAMEL: joined(foot, *cheeks), BRASS: bolt(0.032).moved((0, SHOULDER, 0))}, "base")


def arm(length: float) -> Mesh:
    """Two rods along y with a brace, hinges at both ends, and a spring beside each rod."""
    rods = [
        tube([(0, y, z) for y in (-0.010, 0.2 * length, 0.8 * length, length + 0.010)], 0.0042)
        for z in (-0.014, 0.014)
    ]
    brace = box((0.007, 0.010, 0.028), 0.002).moved((0, 0.72 * length, 0))
    springs = [spring(0.14 * length, 0.70 * length).moved((-0.0125, 0, z)) for z in (-0.014, 0.014)]
    pins = [bolt(0.026, 0.0028).moved((-0.007, part * length, 0)) for part in (0.13, 0.71)]
    hinge = lathe(rounded([(0, -0.009), (0.0105, -0.009), (0.0105, 0.009), (0, 0.009)], 0.003, 4), 32)
    knuckle = hinge.turned(quaternion.from_axis_angle((1, 0, 0), math.pi / 2)).moved((0, length, 0))
    return mesh_of(
        {ENAMEL: joined(*rods, brace, knuckle), STEEL: joined(*springs), BRASS: joined(*pins)}, "arm"
    )


def head() -> Mesh:
    """A neck, a housing and a bell-shaped shade that opens along y, white inside."""
    outside = [
        (0, 0.006),
        (0.020, 0.010),
        (0.027, 0.022),
        (0.0275, 0.060),
        (0.036, 0.074),
        (0.062, 0.104),
        (0.079, 0.148),
    ]
    inside = [(0.0765, 0.148), (0.060, 0.106), (0.034, 0.078), (0.020, 0.070), (0, 0.068)]
    shell = lathe(rounded(outside, 0.014, 6), 72)
    lip = lathe([outside[-1], (0.0788, 0.1495), (0.0770, 0.1495), inside[0]], 72)
    bowl = lathe(rounded(inside, 0.012, 6), 72)
    ring = lathe(
        rounded(
            [(0.0270, 0.050), (0.0295, 0.051), (0.0295, 0.056), (0.0270, 0.057), (0.0270, 0.050)], 0.001, 3
        ),
        48,
    )
    return mesh_of(
        {ENAMEL: joined(shell, lip), REFLECTOR: bowl, BRASS: joined(bolt(0.030, 0.005), ring)}, "head"
    )


def bolt(length: float, radius: float = 0.006) -> Shape:
    """A round bolt along z through the origin."""
    profile = rounded([(0, -length), (radius, -length), (radius, length), (0, length)], 0.2 * radius, 3)
    half = lathe(np.asarray(profile) * (1, 0.9), 24)
    return half.turned(quaternion.from_axis_angle((1, 0, 0), math.pi / 2))


def spring(low: float, high: float, turns: int = 22) -> Shape:
    """A coil about y, with straight wires to both ends."""
    part = np.linspace(0, 1, 12 * turns + 1)
    angle = 2 * math.pi * turns * part
    coil = np.stack(
        [0.0042 * np.cos(angle), low + (high - low) * (0.06 + 0.88 * part), 0.0042 * np.sin(angle)], axis=1
    )
    return tube(np.concatenate([[(0, low, 0)], coil, [(0, high, 0)]]), 0.00095, 6)


# --- its clips --------------------------------------------------------------------------------------------


def bends(keys: Mapping[float, tuple[float, float, float]], root: str = "lamp") -> list[Track]:
    """Tracks of the three joints, from time -> degrees that lower arm, upper arm and head turn from rest."""
    paths = {"lower arm": f"{root}/lower arm", "upper arm": f"{root}/lower arm/upper arm"}
    paths["head"] = f"{paths['upper arm']}/head"
    return [
        swings(path, [(time, REST[name] + angles[k]) for time, angles in keys.items()])
        for k, (name, path) in enumerate(paths.items())
    ]


def hop() -> Clip:
    """Crouch, spring off, fly a short arc, land softly and settle: 1.9 s, 0.2 m along +x."""
    poses = {
        0.0: (0, 0, 0), 0.42: (30, -48, 26), 0.52: (30, -48, 24), 0.64: (-18, 42, -8), 0.84: (12, -22, 14),
        0.98: (-4, 12, 0), 1.14: (26, -42, 18), 1.42: (-5, 8, -6), 1.64: (2, -3, 2), 1.9: (0, 0, 0),
    }  # fmt: skip
    flight = [
        (0.0, (0, 0, 0)),
        (0.60, (0, 0, 0)),
        (0.80, (0.1, 0.11, 0)),
        (1.0, (0.2, 0, 0)),
        (1.9, (0.2, 0, 0)),
    ]
    return Clip("hop", [*bends(poses), moves("lamp", flight)])


def nod() -> Clip:
    """Yes, and once more: 1.4 s."""
    poses = {
        0.0: (0, 0, 0), 0.14: (-1, 3, 8), 0.34: (4, -6, -26), 0.56: (0, 1, 6),
        0.76: (3, -4, -20), 1.0: (-1, 1, 4), 1.4: (0, 0, 0),
    }  # fmt: skip
    return Clip("nod", bends(poses))
