"""The flour sack: it keeps its volume, obeys its controls, and its leap is one that could be."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from eyeline.samples import flour_sack
from eyeline.samples.flour_sack import CORNERS, DOWN, GRAVITY, HEIGHT, OFF
from eyeline.scene.mesh import Mesh

SACK = flour_sack()
CLOTH = SACK.find("sack/cloth")


def posed(**controls: float) -> Mesh:
    """The cloth in its own space with controls set."""
    nodes = list(SACK.nodes)
    nodes[0] = replace(nodes[0], rotation=(0.0, 0.0, 0.0, 1.0), controls={**nodes[0].controls, **controls})
    scene = replace(SACK, nodes=tuple(nodes), clips=()).at(0.0)
    return next(surface.mesh for surface in scene.surfaces if surface.node == CLOTH)


def volume(mesh: Mesh) -> float:
    a, b, c = (mesh.points[mesh.faces[:, k]].astype(np.float64) for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)


def corner(mesh: Mesh, name: str) -> np.ndarray:
    """Where the corner is: the vertex farthest out in the cloth at rest."""
    side, end = CORNERS[name]
    rest = posed().points
    return mesh.points[np.argmax(side * rest[:, 0] + (2 * end - 1) * rest[:, 1])].astype(np.float64)


@pytest.mark.parametrize("squash", [-0.4, -0.2, 0.15, 0.3])
def test_squash_and_stretch_keep_the_volume(squash: float) -> None:
    rest, mesh = posed(), posed(squash=squash)
    assert volume(mesh) == pytest.approx(volume(rest), rel=0.01)
    belly = [np.ptp(one.points[:, 0]) for one in (rest, mesh)]
    assert belly[1] / belly[0] == pytest.approx((1 + squash) ** -0.5, rel=0.01)


def test_every_pose_of_the_clip_keeps_most_of_the_volume() -> None:
    rest = volume(posed())
    times = np.linspace(0, SACK.duration, 30).tolist()
    meshes = [next(s.mesh for s in SACK.at(time).surfaces if s.node == CLOTH) for time in times]
    np.testing.assert_allclose([volume(mesh) / rest for mesh in meshes], 1, atol=0.13)


def test_lean_goes_forwards_and_sway_to_its_left() -> None:
    ears = [(corner(mesh, "left_ear") + corner(mesh, "right_ear")) / 2 for mesh in (posed(), posed(lean=0.5))]
    assert ears[1][2] - ears[0][2] == pytest.approx(HEIGHT * (1 - math.cos(0.5)) / 0.5, rel=0.25)
    assert corner(posed(sway=0.5), "left_ear")[0] > corner(posed(), "left_ear")[0] + 0.05


def test_twist_turns_the_top_and_leaves_the_feet() -> None:
    mesh = posed(twist=0.6)
    way = corner(mesh, "left_ear") - corner(mesh, "right_ear")
    assert math.atan2(-way[2], way[0]) == pytest.approx(0.6, abs=0.01)
    feet = corner(mesh, "left_foot") - corner(mesh, "right_foot")
    assert math.atan2(-feet[2], feet[0]) == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize("name", CORNERS)
def test_a_corner_steps_alone(name: str) -> None:
    mesh, rest = posed(**{f"{name}_lift": 0.05, f"{name}_step": 0.08}), posed()
    moved = {one: corner(mesh, one) - corner(rest, one) for one in CORNERS}
    np.testing.assert_allclose(moved.pop(name), (0, 0.05, 0.08), atol=0.012)
    assert max(np.linalg.norm(one) for one in moved.values()) < 0.004


def test_it_flies_in_a_parabola_and_stands_on_the_floor_else() -> None:
    times = np.linspace(OFF, DOWN, 23)
    height = SACK.sample(times).translation[:, 0, 1]
    np.testing.assert_allclose(np.diff(height, 2) / (times[1] - times[0]) ** 2, -GRAVITY, rtol=1e-6)
    standing = SACK.sample([0.0, 0.4, OFF, DOWN, 1.5, 3.5]).translation[:, 0, 1]
    np.testing.assert_allclose(standing, 0, atol=1e-12)


def test_it_gathers_before_it_leaps_and_stretches_as_it_leaves() -> None:
    squash = SACK.sample([0.5, OFF, DOWN, DOWN + 0.08]).controls[0]["squash"]
    assert squash[0] < -0.3 and squash[1] > 0.2 and squash[3] < -0.3


def test_it_ends_as_it_began_but_for_where_it_stands() -> None:
    ends = SACK.sample([0.0, SACK.duration])
    assert all(np.allclose(values, 0, atol=1e-9) for values in ends.controls[0].values())


def test_nothing_sinks_into_the_floor() -> None:
    for time in np.linspace(0, SACK.duration, 36).tolist():
        surface = next(s for s in SACK.at(time).surfaces if s.node == CLOTH)
        low = (surface.mesh.points @ surface.world_from_mesh[1, :3] + surface.world_from_mesh[1, 3]).min()
        assert low > -0.03, time
