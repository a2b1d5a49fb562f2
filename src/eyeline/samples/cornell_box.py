"""The Cornell box, as measured: lengths, reflectances, camera. [Goral84, Cornell98]"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from eyeline.geometry import quaternion
from eyeline.samples.shapes import Shape, joined, mesh_of, sheet
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

MILLIMETRE = 1e-3

# The measured spectra as linear Rec. 709 colours
WHITE = Material("white paint", (0.725, 0.71, 0.68, 1.0), roughness=1.0)
RED = Material("red paint", (0.63, 0.065, 0.05, 1.0), roughness=1.0)
GREEN = Material("green paint", (0.14, 0.45, 0.091, 1.0), roughness=1.0)
LAMP = Material("ceiling lamp", (0.78, 0.78, 0.78, 1.0), emissive=(3.4, 2.4, 0.8))

FLOOR = ((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
CEILING = ((556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0))
BACK = ((549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2))
RIGHT = ((0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))
LEFT = ((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))
OPENING = (
    (343, 548.7, 227),
    (343, 548.7, 332),
    (213, 548.7, 332),
    (213, 548.7, 227),
)  # 0.1 below the ceiling
SHORT_TOP = ((130, 165, 65), (82, 165, 225), (240, 165, 272), (290, 165, 114))
TALL_TOP = ((423, 330, 247), (265, 330, 296), (314, 330, 456), (472, 330, 406))

EYE, AHEAD = (278, 273, -800), (278, 273, 0)
WIDE = math.radians(80)  # half the cone of the lamp's light: nearly all that is below it
GLOW = (0.278, 0.40, -0.75)  # metres; a light in place of all that goes from wall to wall
FOCAL_LENGTH, SENSOR = 35.0, 25.0  # millimetres


def cornell_box() -> Scene:
    """A room of half a metre, one wall red and one green, two blocks, a lamp; for a square picture."""
    walls = mesh_of(
        {WHITE: joined(*map(quad, (FLOOR, CEILING, BACK))), RED: quad(LEFT), GREEN: quad(RIGHT)}, "walls"
    )
    camera = Camera.look_at(metres(EYE), metres(AHEAD), fov=2 * math.atan(SENSOR / (2 * FOCAL_LENGTH)))
    light = Light("spot", (1.0, 0.82, 0.56), 1.5, inner_cone=0.0, outer_cone=WIDE, name="lamp")
    walls_glow = Light("point", (1.0, 0.78, 0.60), 0.62, name="what the walls send back")
    downwards = tuple(quaternion.from_axis_angle((1, 0, 0), -math.pi / 2).tolist())
    return Scene.of(
        Node("walls", mesh=walls),
        Node("short block", mesh=block(SHORT_TOP).mesh(WHITE)),
        Node("tall block", mesh=block(TALL_TOP).mesh(WHITE)),
        Node("lamp", mesh=quad(OPENING).mesh(LAMP)),
        Node("light", translation=middle(OPENING), rotation=downwards, light=light),
        Node("glow", translation=GLOW, light=walls_glow),
        Node("camera", matrix=camera.world_from_eye, camera=camera),
        name="cornell box",
    )


def metres(millimetres: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """(..., 3) as published, in metres."""
    return np.asarray(millimetres, dtype=np.float64) * MILLIMETRE


def middle(corners: npt.ArrayLike) -> tuple[float, float, float]:
    """The middle of four measured corners, a millimetre below it: a light there lies in front of it."""
    x, y, z = metres(corners).mean(axis=0) - (0, MILLIMETRE, 0)
    return float(x), float(y), float(z)


def quad(corners: npt.ArrayLike) -> Shape:
    """Four measured corners as two triangles that face into the room."""
    return sheet(metres(corners))


def block(top: npt.ArrayLike) -> Shape:
    """A block on the floor under a measured top, without an underside."""
    upper = np.asarray(top, dtype=np.float64)
    lower = upper * (1, 0, 1)
    sides = [quad([upper[k], lower[k], lower[k - 3], upper[k - 3]]) for k in range(4)]
    return joined(quad(upper), *sides)
