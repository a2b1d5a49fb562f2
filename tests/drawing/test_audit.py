"""Lines of chance and of real models, judged by brute force; and whether the judge sees planted faults."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import eyeline as el
import line_oracle
import soups
from data import data
from eyeline.drawing.kinds import INTERSECTION, KINDS, USUAL
from eyeline.drawing.lines import Lines, lines_of
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene

SIZES = ((48, 32), (33, 17), (1280, 720), (1, 1), (7, 500))
MODELS = ("stanford-bunny", "teapot", "spot", "fandisk", "suzanne")
BEND = math.radians(30)

by_chance = settings(
    max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
seeds = st.integers(0, 10**6)


def segments(lines: Lines) -> line_oracle.Segments:
    return line_oracle.Segments(lines.world, lines.faces, lines.seen)


def wrong(
    scene: Scene, camera: Camera, size: tuple[int, int], kinds: tuple[str, ...] = KINDS, count: int = 100
) -> tuple[str, ...]:
    lines = lines_of(scene, camera, size, kinds, BEND)
    return line_oracle.audit(scene, camera, size, segments(lines), count).wrong


# --- chance -----------------------------------------------------------------------------------------------


@by_chance
@given(seed=seeds, size=st.sampled_from(SIZES))
def test_faces_around_the_eye(seed: int, size: tuple[int, int]) -> None:
    """Near plane, guard band, faces of one side, both kinds of camera."""
    assert wrong(*soups.around_the_eye(seed), size) == ()


@by_chance
@given(seed=seeds)
def test_many_faces_that_pierce_each_other(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = int(random.integers(2, 60))
    points = random.uniform(-1, 1, (count, 1, 3)) + random.uniform(-1, 1, (count, 3, 3))
    scene = Scene.of(Mesh(points.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)))
    height = float(random.uniform(0.2, 4)) if seed % 2 else None
    camera = Camera.look_at(random.normal(size=3) * 3, random.uniform(-1, 1, 3), height=height)
    assert wrong(scene, camera, (320, 240)) == ()


@by_chance
@given(seed=seeds)
def test_closed_bodies_that_pierce_each_other(seed: int) -> None:
    """Balls and boxes on whole coordinates: sides lie in each other, edges on sides, corners on edges."""
    random = np.random.default_rng(seed)
    cube = el.samples.cube().surfaces[0].mesh
    meshes = []
    for _ in range(int(random.integers(2, 7))):
        points, faces = soups.ball(4) if random.random() < 0.3 else (cube.points * 2, cube.faces)
        meshes.append(Mesh(points * random.integers(1, 4, 3) + random.integers(-3, 4, 3), faces))
    eye = random.integers(-12, 13, 3) + np.array([0, 0, 20])
    camera = Camera.look_at(eye, (0, 0, 0), height=float(random.choice([9, 16])) if seed % 2 else None)
    assert wrong(Scene.of(*meshes), camera, (320, 240)) == ()


@by_chance
@given(seed=seeds)
def test_a_sheet_that_folds_over_itself(seed: int) -> None:
    """A net whose corners are shaken in all directions: what meets at a corner never hides it."""
    random = np.random.default_rng(seed)
    cells = int(random.integers(1, 9))
    column, row = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1))
    points = np.stack([column, row, 0 * row], axis=-1).reshape(-1, 3) / cells - 0.5
    points = points + random.normal(size=points.shape) * random.uniform(0, 1.5) / cells
    at = (row * (cells + 1) + column)[:-1, :-1].reshape(-1)
    faces = [np.stack([at, at + 1, at + cells + 2], 1), np.stack([at, at + cells + 2, at + cells + 1], 1)]
    camera = Camera.look_at(random.normal(size=3) * 2, (0, 0, 0), fov=float(random.uniform(0.1, 2)))
    assert wrong(Scene.of(Mesh(points, np.concatenate(faces))), camera, (320, 240)) == ()


@by_chance
@given(seed=seeds)
def test_every_two_faces_that_pierce_each_other_have_their_line(seed: int) -> None:
    random = np.random.default_rng(seed)
    points = random.uniform(-1, 1, (12, 3, 3)).astype(np.float32)
    scene = Scene.of(Mesh(points.reshape(-1, 3), np.arange(36).reshape(-1, 3)))
    lines = lines_of(scene, Camera.look_at((0, 0, 9), (0, 0, 0)), (400, 400), ("intersection",), BEND)
    found = {frozenset(pair) for pair in lines.faces[lines.kind == INTERSECTION].tolist()}
    wanted = {
        frozenset((f, g)) for f in range(12) for g in range(f) if pierces(points[f].astype(float), points[g])
    }
    assert found == wanted


def pierces(f: np.ndarray, g: np.ndarray) -> bool:
    """Whether an edge of one of two triangles in general position goes through the other."""

    def volume(*corners: np.ndarray) -> float:
        return float(np.linalg.det(np.array(corners[1:], float) - corners[0]))

    def through(p: np.ndarray, q: np.ndarray, t: np.ndarray) -> bool:
        turns = [volume(p, q, t[k], t[(k + 1) % 3]) > 0 for k in range(3)]
        return (volume(*t, p) > 0) != (volume(*t, q) > 0) and len(set(turns)) == 1

    return any(through(one[k], one[(k + 1) % 3], other) for one, other in ((f, g), (g, f)) for k in range(3))


# --- real models ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
def test_real_models_from_all_around(name: str) -> None:
    scene = el.load(data(f"mesh/{name}.obj"))
    whole, close = scene.bounds.diagonal, scene.bounds.diagonal / 4
    for turn in range(4):
        direction = np.array([math.cos(1.6 * turn + 0.3), 0.2 * turn - 0.3, math.sin(1.6 * turn + 0.3)])
        eye = scene.bounds.centre + direction * (close if turn == 3 else whole)
        camera = Camera.look_at(eye, scene.bounds.centre, height=whole if turn == 2 else None)
        lines = lines_of(scene, camera, (640, 480), USUAL, BEND)
        verdict = line_oracle.audit(scene, camera, (640, 480), segments(lines), 250, turn)
        assert verdict.wrong == ()
        assert verdict.decided > 0.9 * verdict.samples > 200


@pytest.mark.parametrize("name", ["ball", "torus", "bunny"])
def test_dense_meshes_have_no_specks(name: str) -> None:
    """A line that ends at a corner of the face that hides it is hidden from that corner on."""
    scene = {
        "ball": lambda: Scene.of(Mesh(*soups.ball(70))),
        "torus": el.samples.torus,
        "bunny": lambda: el.load(data("mesh/stanford-bunny.obj")),
    }[name]()
    camera = Camera.framing(scene.bounds, 16 / 9)
    lines = lines_of(scene, camera, (1280, 720), ("outline", "boundary", "crease", "mesh"), BEND)
    assert lines.seen.sum() > 4000
    assert line_oracle.specks(scene, camera, (1280, 720), segments(lines)) == []


@pytest.mark.parametrize("name", el.samples.SAMPLES)
def test_built_in_scenes(name: str) -> None:
    scene = el.samples.SAMPLES[name]().at(0.7)
    camera = scene.cameras[0] if scene.cameras else Camera.framing(scene.bounds, 16 / 9)
    assert wrong(scene, camera, (640, 360), USUAL, 200) == ()


# --- the judge --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("fault", ["seen", "hidden"])
def test_the_judge_sees_one_false_claim_in_twenty(fault: str) -> None:
    scene = el.samples.teapot()
    camera = Camera.framing(scene.bounds, 4 / 3)
    lines = lines_of(scene, camera, (640, 480), USUAL, BEND)
    random = np.random.default_rng(1)
    turned = (lines.seen == (fault == "seen")) & (random.random(len(lines.seen)) < 0.05)
    claims = replace(segments(lines), seen=lines.seen ^ turned)
    accused = line_oracle.audit(scene, camera, (640, 480), claims, 600).wrong
    assert len(accused) > 0
    rows = {int(sentence.split()[1]) for sentence in accused}
    assert rows <= set(np.flatnonzero(turned).tolist())


def test_the_judge_sees_a_line_that_runs_on_too_far() -> None:
    """A hundredth of a pixel too long, behind the square that hides the rest."""
    near = Mesh([(0, -1, 1), (3, -1, 1), (3, 1, 1), (0, 1, 1)], [(0, 1, 2), (0, 2, 3)])
    camera = Camera.look_at((0, 0, 9), (0, 0, 0), height=4)
    hundredth = 4 / 480 / 100

    def accused(end: float) -> int:
        line = line_oracle.Segments(
            np.array([[(end - hundredth, 0.0, 0.0), (end, 0.0, 0.0)]]), np.array([[-1, -1]]), np.array([True])
        )
        return len(line_oracle.audit(Scene.of(near), camera, (640, 480), line, 50).wrong)

    assert accused(0.0) == 0
    assert accused(hundredth) > 0
