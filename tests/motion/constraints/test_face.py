"""A face's weights are what its controls and its targets' names say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion.constraints.face import DOWN, SIDEWAYS, Face
from eyeline.scene.pose import Samples

TARGETS = ("jawOpen", "jawOpen@0.25", "jawOpen@0.75", "mouthPucker", "jawOpen*mouthPucker")


def head(**controls: float) -> el.Scene:
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    targets = [el.MorphTarget(np.full((3, 3), float(k)), name=name) for k, name in enumerate(TARGETS)]
    mesh = el.Mesh(points, [[0, 1, 2]], targets=targets)
    return el.Scene(
        (el.Node("head", mesh=mesh, controls=controls), el.Node("left", 0), el.Node("right", 0)),
        constraints=(Face("face", "head", TARGETS, "left", "right"),),
    )


def weights(**controls: float) -> dict[str, float]:
    return dict(zip(TARGETS, head(**controls).at(0)["head"].weights or (0.0,) * 5, strict=True))


@pytest.mark.parametrize(
    ("control", "first", "second", "whole"),
    [(0, 0, 0, 0), (0.25, 1, 0, 0), (0.5, 0.5, 0.5, 0), (0.75, 0, 1, 0), (0.875, 0, 0.5, 0.5), (1, 0, 0, 1)],
)
def test_inbetweens_are_whole_at_their_number_and_gone_at_the_next(control, first, second, whole):
    got = weights(jawOpen=control)
    assert (got["jawOpen@0.25"], got["jawOpen@0.75"], got["jawOpen"]) == (first, second, whole)


def test_shapes_of_one_control_add_up_to_one_from_the_first_on():
    values = np.linspace(0.25, 1, 31)
    face = head().constraints[0]
    got = face.weights({"jawOpen": values}, 31)
    np.testing.assert_allclose(got[:, :3].sum(axis=1), 1, atol=1e-12)


def test_a_corrective_is_the_product_of_its_controls():
    assert weights(jawOpen=0.5, mouthPucker=0.4)["jawOpen*mouthPucker"] == pytest.approx(0.2)
    assert weights(jawOpen=0.5, mouthPucker=-1)["jawOpen*mouthPucker"] == 0


def test_beyond_one_a_shape_goes_on_and_below_nought_it_is_none():
    assert weights(mouthPucker=1.5)["mouthPucker"] == 1.5
    assert weights(mouthPucker=-0.5)["mouthPucker"] == 0


def test_eyes_look_where_the_controls_say():
    scene = head(eyeLookOutLeft=1, eyeLookInRight=1).at(0)
    for eye in ("left", "right"):
        ahead = scene.world[scene.find(eye)][:3, :3] @ (0, 0, 1)
        np.testing.assert_allclose(ahead, (np.sin(SIDEWAYS), 0, np.cos(SIDEWAYS)), atol=1e-12)
    low = head(eyeLookDownLeft=1).at(0)
    ahead = low.world[low.find("left")][:3, :3] @ (0, 0, 1)
    np.testing.assert_allclose(ahead, (0, -np.sin(DOWN), np.cos(DOWN)), atol=1e-12)
    assert low["right"].rotation == quaternion.IDENTITY


def test_without_influence_the_weights_stay():
    scene = head(jawOpen=1)
    quiet = replace(scene.constraints[0], influence=0.0)
    pose = quiet(Samples.still(scene, 2), {})
    np.testing.assert_array_equal(pose.weights[0], 0)


def test_what_is_no_face_is_refused():
    with pytest.raises(SceneError, match="needs a number between 0 and 1"):
        Face("face", "head", ("jawOpen", "jawOpen@2"))
    with pytest.raises(SceneError, match="leads to 'jawOpen', which is no target"):
        Face("face", "head", ("jawOpen@0.5",))
    scene = replace(head(), constraints=(Face("face", "head", ("jawOpen",)),))
    with pytest.raises(SceneError, match="names 1 targets; 'head' has 5"):
        scene.at(0)
