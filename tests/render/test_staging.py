"""Scenes and shots are looked at alike; what is neither is refused with the way to one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import eyeline as el

SIZE = (48, 27)
CAMERA = el.Camera.look_at((0, 1, 6), (0, 0, 0))


def moved() -> el.Shot:
    shot = el.Shot(el.Scene.of(el.Node("ball", mesh=el.samples.sphere().nodes[0].mesh)))
    return shot.play(shot["ball"].animate.move_to((1, 0, 0)))


def test_a_shot_is_seen_as_its_scene_is() -> None:
    shot = moved()
    for time in (0.0, 0.7):
        of_shot = el.render(shot, CAMERA, SIZE, time, samples=1).pixels
        assert np.array_equal(of_shot, el.render(shot.scene, CAMERA, SIZE, time, samples=1).pixels)
        of_shot = el.visible(shot, CAMERA, SIZE, time).face
        assert np.array_equal(of_shot, el.visible(shot.scene, CAMERA, SIZE, time).face)
    assert len(el.film(shot, size=SIZE, camera=CAMERA)) == 24
    assert (
        el.draw(shot, CAMERA, size=SIZE)._repr_svg_() == el.draw(shot.scene, CAMERA, size=SIZE)._repr_svg_()
    )


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (el.samples.cube().nodes[0].mesh, "not a Mesh; Scene.of"),
        ("robot.glb", "not a str; eyeline.load reads"),
        (None, "not a NoneType"),
    ],
)
def test_anything_else_is_refused(given: Any, says: str) -> None:
    for look in (el.render, el.film, el.draw, el.visible, el.compare, lambda it: el.explain(it, "zbuffer")):
        with pytest.raises(el.errors.SceneError, match=f"a scene or a shot is needed, {says}"):
            look(given)
