"""Clay: closed, alike on both sides, and as large as its lumps."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.samples.clay import Ball, Limb, clay, mirrored
from eyeline.scene.topology import PLAIN, topology_of
from eyeline.shapes.winding import volume


def test_a_ball_is_as_large_as_it_is_said_to_be():
    mesh = clay([Ball((0.1, 0, 0), (0.2, 0.3, 0.25))], 0.01)
    assert volume(mesh.points, mesh.faces) == pytest.approx(4 / 3 * np.pi * 0.2 * 0.3 * 0.25, rel=0.01)
    np.testing.assert_allclose(mesh.bounds.low, (-0.1, -0.3, -0.25), atol=0.003)


def test_a_limb_is_the_balls_along_it():
    limb = Limb((0, 0, 0), (0, 1, 0), 0.2, 0.1)
    middles = np.stack([np.zeros(2001), np.linspace(0, 1, 2001), np.zeros(2001)], axis=1)
    radii = np.linspace(0.2, 0.1, 2001)
    points = np.random.default_rng(3).uniform(-1.5, 1.5, (200, 3))
    away = np.sqrt(((points[:, None] - middles) ** 2).sum(axis=2)) - radii
    np.testing.assert_allclose(limb.distance(points), away.min(axis=1), atol=1e-5)


def test_lumps_become_one_closed_body_alike_on_both_sides():
    mesh = clay(
        [
            Ball((0, 0, 0), (0.2, 0.3, 0.1)),
            Limb((0.1, 0.1, 0), (0.5, 0.3, 0.1), 0.08, 0.05, soft=0.05, both_sides=True),
        ],
        0.02,
    )
    topology = topology_of(mesh)
    assert len(topology.open_edges) == 0
    assert (topology.odd == PLAIN).all()
    assert len(np.unique(topology.part)) == 1
    rows = {tuple(row) for row in np.round(mesh.points, 4) + np.float32(0)}
    other = {
        tuple(row) for row in np.round(mesh.points * np.array([-1, 1, 1], np.float32), 4) + np.float32(0)
    }
    assert len(rows & other) > 0.95 * len(rows)


def test_a_mirrored_ball_is_turned_the_other_way():
    half = 0.5**0.5
    ball = Ball((0.3, 0, 0), (0.3, 0.1, 0.1), (0, 0, half * 0.5, (1 - half**2 * 0.25) ** 0.5))
    points = np.random.default_rng(1).uniform(-1, 1, (50, 3))
    np.testing.assert_allclose(
        mirrored(ball).distance(points * (-1, 1, 1)), ball.distance(points), atol=1e-12
    )
