"""Constraints are kept after the tracks, at one time and at many, and with numbers that tracks move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion import Clip, Curve, Track
from eyeline.scene.node import Node
from eyeline.scene.pose import Samples
from eyeline.scene.scene import Scene


@dataclass(frozen=True)
class Above:
    """Keeps a node over another by a height, and by what the other's control says."""

    name: str
    node: str
    base: str
    height: float = 1.0

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The node over its base."""
        node, base = pose.find(self.node), pose.find(self.base)
        place = pose.translation[:, base].copy()
        place[:, 1] += moved.get("height", np.float64(self.height)) + pose.controls[base]["lift"]
        return pose.placed(node, translation=place)


def scene(*tracks: Track) -> Scene:
    nodes = (Node("base", controls={"lift": 0.5}), Node("hat", matrix=np.diag([2.0, 2.0, 2.0, 1.0])))
    return Scene(nodes, (Clip("move", tracks),) if tracks else (), constraints=(Above("on", "hat", "base"),))


def line(*values: object) -> Curve:
    return Curve(np.arange(len(values), dtype=float), np.array(values, dtype=float))


ALL = (
    Track("node", "base", "translation", line((0, 0, 0), (4, 0, 0))),
    Track("node", "base", "controls.lift", line(0, 1)),
    Track("constraint", "on", "height", line(2, 4)),
)


def test_a_scene_without_a_clip_keeps_its_constraints() -> None:
    posed = scene().at(3.0)
    assert posed["hat"].translation == (0, 1.5, 0)
    assert posed["hat"].matrix is None
    assert posed["hat"].scale == (2, 2, 2)
    assert posed.constraints == ()


def test_constraints_follow_tracks_controls_and_their_own_numbers() -> None:
    assert scene(*ALL).at(0.5)["hat"].translation == (2, 3.5, 0)


def test_many_times_at_once_are_the_same_as_each_alone() -> None:
    whole = scene(*ALL)
    times = [0.75, 0.0, 1.0, 0.25, 0.25]
    batch = whole.sample(times)
    for row, time in enumerate(times):
        posed = whole.at(time)
        assert tuple(batch.translation[row, 1]) == posed["hat"].translation
        assert np.array_equal(batch.world[row], posed.world)


def test_a_scene_at_rest_is_sampled_with_its_constraints() -> None:
    assert scene().sample([0.0, 1.0]).translation[:, 1].tolist() == [[0, 1.5, 0]] * 2


@pytest.mark.parametrize(
    ("track", "sentence"),
    [
        (Track("constraint", "no", "height", line(1, 2)), "there is no constraint 'no'; there is 'on'"),
        (Track("constraint", "on", "width", line(1, 2)), "leads nowhere; there is 'height'"),
        (Track("constraint", "on", "height", line((1, 2), (3, 4))), "has values of shape"),
        (Track("node", "base", "controls.lid", line(1, 2)), "leads nowhere; there is 'lift'"),
        (Track("node", "base", "deform.twist.angle", line(1, 2)), "there is no deform to move"),
    ],
)
def test_what_is_not_there_does_not_move(track: Track, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        scene(track).at(0.0)


def test_a_doubled_name_is_refused() -> None:
    with pytest.raises(SceneError, match="constraint 'on' is there twice"):
        Scene((Node("a"),), constraints=(Above("on", "a", "a"), Above("on", "a", "a")))
