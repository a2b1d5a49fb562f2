"""Limbs reach what can be reached, keep the lengths of their bones, and say by how much they missed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion import Clip, Curve, Track
from eyeline.motion.constraints import Chain, TwoBone
from eyeline.motion.constraints.limb import between
from eyeline.scene.constraint import Constraint
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

SEEDS = st.integers(0, 2**32 - 1)


def limb(seed: int, bones: int, size: float = 2.0) -> tuple[Node, ...]:
    """A tilted and enlarged body, and below it joints at random turns, with bones of length 0.5 to 1."""
    chance = np.random.default_rng(seed)

    def turn() -> tuple[float, float, float, float]:
        x, y, z, w = quaternion.normalized(chance.normal(size=4)).tolist()
        return x, y, z, w

    nodes = [Node("body", translation=(0.3, 0.2, 0.1), rotation=turn(), scale=(size, size, size))]
    for index in range(bones + 1):
        way = chance.normal(size=3)
        x, y, z = (way / np.linalg.norm(way) * chance.uniform(0.5, 1)).tolist()
        nodes.append(Node(f"joint {index}", parent=index, translation=(x, y, z), rotation=turn()))
    return (*nodes, Node("aim"), Node("pole", translation=(5.0, 9.0, -4.0)))


def posed(nodes: tuple[Node, ...], rule: Constraint, places: FloatArray) -> tuple[FloatArray, Scene]:
    """World matrices (T, N, 4, 4) with the aim at places (T, 3), and the scene."""
    times = np.arange(len(places), dtype=float)
    clip = Clip("aim", [Track("node", "aim", "translation", Curve(times, places))])
    scene = Scene(nodes, (clip,), constraints=(rule,))
    return scene.sample(times).world, scene


def lengths(world: FloatArray, bones: int) -> FloatArray:
    places = world[:, 1 : bones + 2, :3, 3]
    found: FloatArray = np.linalg.norm(np.diff(places, axis=1), axis=2)
    return found


def within(nodes: tuple[Node, ...], bones: int, seed: int, count: int = 8) -> FloatArray:
    """Places that the end can come to: where it is at random turns of its joints."""
    chance = np.random.default_rng(seed + 1)
    world = Scene(nodes).world
    own = np.linalg.norm(np.diff(world[1 : bones + 2, :3, 3], axis=0), axis=1)
    ways = chance.normal(size=(count, bones, 3))
    ways /= np.linalg.norm(ways, axis=2, keepdims=True)
    places: FloatArray = world[1, :3, 3] + (own[:, None] * ways).sum(axis=1)
    return places


@given(SEEDS)
@settings(max_examples=30, deadline=None, derandomize=True)
def test_two_bones_reach_what_they_can(seed: int) -> None:
    nodes = limb(seed, 2)
    places = within(nodes, 2, seed)
    world, _ = posed(nodes, TwoBone("reach", "joint 2", "aim", pole="pole"), places)
    assert np.abs(world[:, 3, :3, 3] - places).max() < 1e-9
    assert np.allclose(lengths(world, 2), lengths(Scene(nodes).world[None], 2), atol=1e-12)


@given(SEEDS)
@settings(max_examples=30, deadline=None, derandomize=True)
def test_the_elbow_is_on_the_side_of_its_pole(seed: int) -> None:
    nodes = limb(seed, 2)
    places = within(nodes, 2, seed)
    world, _ = posed(nodes, TwoBone("reach", "joint 2", "aim", pole="pole"), places)
    a, b = world[:, 1, :3, 3], world[:, 2, :3, 3]
    normal = np.cross(places - a, np.array((5.0, 9.0, -4.0)) - a)
    assert np.abs(((b - a) * normal).sum(axis=1) / np.linalg.norm(normal, axis=1)).max() < 1e-9
    assert (np.sum(np.cross(places - a, b - a) * normal, axis=1) >= -1e-9).all()


def test_without_a_pole_an_arm_bends_as_it_did() -> None:
    straight = (Node("a"), Node("b", 0, (1, 0, 0.1)), Node("c", 1, (1, 0, -0.1)), Node("aim"))
    world, _ = posed(straight, TwoBone("reach", "c", "aim"), np.array([[1.5, 0.0, 0.0], [0.0, 1.5, 0.0]]))
    assert world[0, 1, 2, 3] > 0.5
    assert np.allclose(world[:, 2, :3, 3], [(1.5, 0, 0), (0, 1.5, 0)])


def test_out_of_reach_a_limb_is_stretched_and_says_so() -> None:
    nodes = limb(3, 2)
    rule = TwoBone("reach", "joint 2", "aim")
    places = np.array([[40.0, 0.0, 0.0], [0.0, -40.0, 3.0]])
    world, scene = posed(nodes, rule, places)
    a, b, c = (world[:, joint, :3, 3] for joint in (1, 2, 3))
    assert np.abs(np.cross(b - a, c - a)).max() < 1e-6
    missed = rule.missed(scene.sample([0.0, 1.0]))
    assert np.allclose(missed, np.linalg.norm(places - a, axis=1) - lengths(world, 2).sum(axis=1))


def test_too_near_a_limb_is_folded() -> None:
    nodes = (Node("a"), Node("b", 0, (2, 0, 0)), Node("c", 1, (0.5, 0.1, 0)), Node("aim"))
    world, _ = posed(nodes, TwoBone("reach", "c", "aim"), np.array([[0.1, 0.0, 0.0], [0.0, 0.0, 0.0]]))
    bones = np.linalg.norm(np.diff(world[:, :3, :3, 3], axis=1), axis=2)
    assert np.allclose(bones, (2, np.hypot(0.5, 0.1)))
    assert np.allclose(np.linalg.norm(world[:, 2, :3, 3], axis=1), 2 - np.hypot(0.5, 0.1))


def test_a_foot_keeps_its_turn_or_takes_its_targets() -> None:
    nodes = limb(11, 2, size=1.0)
    place = within(nodes, 2, 11, 1)
    kept, _ = posed(nodes, TwoBone("reach", "joint 2", "aim"), place)
    assert np.allclose(kept[0, 3, :3, :3], Scene(nodes).world[3, :3, :3], atol=1e-9)
    taken, _ = posed(nodes, TwoBone("reach", "joint 2", "aim", turns=True), place)
    assert np.allclose(taken[0, 3, :3, :3], np.eye(3), atol=1e-9)


@given(SEEDS, st.integers(1, 6))
@settings(max_examples=30, deadline=None, derandomize=True)
def test_a_chain_reaches_well_inside_its_reach(seed: int, bones: int) -> None:
    nodes = limb(seed, bones)
    places = within(nodes, bones, seed)
    world, scene = posed(nodes, rule := Chain("tail", f"joint {bones}", "aim", bones), places)
    whole = lengths(world, bones).sum(axis=1)
    assert np.allclose(lengths(world, bones), lengths(Scene(nodes).world[None], bones), atol=1e-9)
    far = np.linalg.norm(places - world[:, 1, :3, 3], axis=1)
    easy = (far < 0.9 * whole) & (far > 0.6 * whole)
    missed = rule.missed(scene.sample(np.arange(len(places), dtype=float)))
    assert (missed[easy] < 2e-3 * whole[easy]).all()


def test_a_straight_chain_can_fold() -> None:
    rope = (Node("0"), *(Node(str(index), index - 1, (0, -1, 0)) for index in range(1, 5)), Node("aim"))
    world, _ = posed(rope, Chain("rope", "4", "aim", 4), np.array([[0.0, -2.5, 0.0]]))
    assert np.allclose(world[0, 4, :3, 3], (0, -2.5, 0), atol=1e-3)


def test_any_batch_of_times_answers_the_same() -> None:
    for rule in (Chain("tail", "joint 4", "aim", 4), TwoBone("reach", "joint 4", "aim", "pole")):
        _, scene = posed(limb(5, 4), rule, within(limb(5, 4), 4, 5))
        times = np.array([0.3, 6.1, 2.2, 2.9])
        batch = scene.sample(times)
        for row, time in enumerate(times):
            assert np.array_equal(batch.rotation[row], scene.sample([time]).rotation[0])


@given(SEEDS)
@settings(max_examples=20, deadline=None, derandomize=True)
def test_the_shortest_turn_goes_from_one_to_the_other(seed: int) -> None:
    start = np.random.default_rng(seed).normal(size=(5, 3))
    for end in (np.roll(start, 1, axis=0), -start, start, 1e-9 * start):
        turned = (quaternion.to_matrix(between(start, end)) @ start[:, :, None])[:, :, 0]
        assert np.allclose(np.cross(turned, end), 0, atol=1e-7)
        assert (np.sum(turned * end, axis=1) > 0).all()


def test_a_limb_without_joints_is_refused() -> None:
    with pytest.raises(SceneError, match="needs 2 joints above 'a'; there are 0"):
        Scene((Node("a"), Node("aim")), constraints=(TwoBone("reach", "a", "aim"),)).at(0)
    with pytest.raises(SceneError, match="has 0 bones"):
        Chain("tail", "a", bones=0)
