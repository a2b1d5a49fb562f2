"""Drive: a control moves what it is told to, by as much as it is told, and several add up."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite
from eyeline.deform.lattice import Lattice
from eyeline.errors import EyelineError
from eyeline.geometry import quaternion
from eyeline.motion import Clip, Curve, Track
from eyeline.motion.constraints import Drive
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

TILT = tuple(quaternion.from_axis_angle((0.6, 0.0, 0.8), 1.1).tolist())
POINTS = np.random.default_rng(3).uniform(-1, 1, (30, 3))
BENDS = Composite.of(Bend(angle=0.2, lower=-1.0), Lattice.of((2, 2, 2)))
WHEEL = Node("wheel", 0, (1, 2, 3), TILT, mesh=Mesh(POINTS, np.arange(30).reshape(-1, 3)), deform=BENDS)
NODES = (Node("cart", controls={"way": 0.5, "tip": 0.25}), WHEEL)
GO = Clip("go", [Track("node", "cart", "controls.way", Curve([0, 2], [0.0, 8.0]))])


def driven(*drives: Drive) -> Scene:
    return Scene(NODES, (GO,), constraints=drives)


def drive(name: str, moves: str, by: str = "cart.way", **values: Any) -> Drive:
    return Drive(name, "wheel", moves, by, **values)


@pytest.mark.parametrize("time", [0.0, 0.3, 2.0])
def test_a_wheel_turns_about_its_own_axle(time: float) -> None:
    wheel = driven(drive("roll", "rotation", rate=(0.0, 0.0, -3.0))).at(time)["wheel"]
    turn = quaternion.from_axis_angle((0, 0, 1), -3.0 * 4 * time)
    wanted = quaternion.multiply(TILT, turn)
    assert abs(np.dot(wheel.rotation, wanted)) == pytest.approx(1)


def test_what_two_controls_move_adds_up() -> None:
    scene = driven(
        drive("along", "translation", rate=(1.0, 0, 0)),
        drive("up", "translation", "cart.tip", rate=(4.0, 1, 0)),
    )
    assert scene.at(1.0)["wheel"].translation == (1 + 4 + 1, 2 + 0.25, 3)
    samples = scene.sample([0.0, 1.0])
    assert samples.translation[:, 1, 0].tolist() == [2, 6]


def test_numbers_of_a_deformer_are_added_to() -> None:
    offsets = np.zeros((2, 2, 2, 3))
    offsets[1, 0, 1] = (0, 3, 1)
    scene = driven(
        drive("bow", "deform.bend.angle", rate=0.5),
        drive("bow more", "deform.bend.angle", "cart.tip", rate=2.0),
        drive("corner", "deform.lattice.offsets", rate=offsets),
    )
    found = scene.at(1.0)["wheel"].deform.parameters
    assert found["bend.angle"] == pytest.approx(0.2 + 0.5 * 4 + 2 * 0.25)
    np.testing.assert_allclose(found["lattice.offsets"], 4 * offsets)
    still = Scene(NODES, constraints=scene.constraints).at(0)["wheel"].deform.parameters
    assert still["bend.angle"] == pytest.approx(0.2 + 0.5 * 0.5 + 2 * 0.25)


def test_driven_keys_stand_between_the_control_and_the_number() -> None:
    keys = Curve.of({0.0: 0.0, 4.0: math.pi, 8.0: 0.0})
    scene = driven(drive("there and back", "scale", rate=(1.0, 0, 0), curve=keys))
    assert scene.at(1.0)["wheel"].scale[0] == pytest.approx(1 + math.pi)
    assert scene.at(2.0)["wheel"].scale[0] == pytest.approx(1)


def test_rates_can_be_keyed() -> None:
    rate = Track("constraint", "roll", "rate", Curve([0, 2], [(0.0, 0, 0), (2.0, 0, 0)]))
    scene = Scene(
        NODES, (Clip("go", [*GO.tracks, rate]),), constraints=(drive("roll", "scale", rate=(0.0,) * 3),)
    )
    assert scene.at(1.0)["wheel"].scale[0] == pytest.approx(1 + 4 * 1.0)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"moves": "visible"}, "translation, rotation, scale"),
        ({"moves": "scale", "rate": 2.0}, r"shape \(\); \(3,\)"),
        ({"moves": "scale", "rate": (1, 1, 1), "by": "way"}, "NODE.CONTROL"),
        ({"moves": "scale", "rate": (1, 1, 1), "by": "cart.wey"}, "no control 'wey'.*way"),
        ({"moves": "deform.bend.angel"}, "bend"),
    ],
)
def test_what_cannot_be_driven_is_refused(values: dict[str, Any], words: str) -> None:
    with pytest.raises(EyelineError, match=words):
        driven(Drive(**{"name": "bad", "node": "wheel", "by": "cart.way", **values})).at(1.0)
