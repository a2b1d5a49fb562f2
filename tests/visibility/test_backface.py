"""What turns its back is not seen."""

from __future__ import annotations

import re

import numpy as np
import pytest

import soups
from eyeline.errors import SceneError
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.backface import is_convex, kept, without_backs

SIZE = (64, 48)
CAMERA = Camera.look_at((1, 2, 4), (0, 0, 0), fov=0.8)
POINTS, FACES = soups.ball(8)
BALL = Mesh(POINTS, FACES, material=Material(double_sided=False))
BACKFACE, ZBUFFER = METHODS["backface"], METHODS["zbuffer"]


def projected(*things: Mesh | Node, cull: str = "auto") -> Projected:
    return project(Scene.of(*things), CAMERA, SIZE, cull)


def test_about_half_of_a_ball_turns_its_back() -> None:
    assert 0.3 < kept(projected(BALL)).mean() < 0.5


def test_faces_are_kept_by_where_their_normals_point() -> None:
    """N . V, in the world: the same faces, but for those nearly edge-on."""
    a, b, c = (POINTS[FACES[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    towards = (normal * (np.array([1, 2, 4]) - (a + b + c) / 3)).sum(axis=1) / np.linalg.norm(normal, axis=1)
    clear = np.abs(towards) > 1e-2
    assert np.array_equal(kept(projected(BALL))[clear], towards[clear] > 0)


def test_double_sided_faces_stay() -> None:
    assert kept(projected(BALL, cull="none")).mean() > 0.99


def test_the_mirror_image_of_a_ball_keeps_its_other_half() -> None:
    """x changes its sign in space: what is kept are the images of what an eye at the other side keeps."""
    mirrored = projected(Node("ball", mesh=BALL, scale=(-1, 1, 1)))
    other = project(Scene.of(BALL), Camera.look_at((-1, 2, 4), (0, 0, 0), fov=0.8), SIZE)
    assert (kept(mirrored) == kept(other)).mean() > 0.99


def test_an_edge_on_face_is_dropped() -> None:
    flat = soups.picture([(0, 0), (600, 300), (1200, 600)], np.ones(3), [[0, 1, 2]], np.array([3]), SIZE, 0)
    assert not kept(flat).any()


def test_nothing_changes_when_backs_are_removed_first() -> None:
    for seed in range(5):
        scene, camera = soups.around_the_eye(seed)
        picture = project(scene, camera, SIZE)
        assert np.array_equal(ZBUFFER(without_backs(picture)).face, ZBUFFER(picture).face)


def test_alone_it_shows_one_convex_body() -> None:
    for node in (Node("ball", mesh=BALL), Node("mirrored", mesh=BALL, scale=(-1, 0.3, 2))):
        for cull in ("auto", "none"):
            picture = projected(node, cull=cull)
            alone, wanted = BACKFACE(picture), ZBUFFER(picture)
            assert np.array_equal(alone.face, wanted.face)
            assert np.array_equal(alone.depth, wanted.depth)
            assert alone.work["depth tests"] == 0


def test_any_other_scene_is_refused_alone() -> None:
    dented = POINTS.copy()
    dented[0] *= 0.7
    for things, words in [
        ((BALL, BALL), "not 2"),
        ((), "not 0"),
        ((Mesh(dented, FACES),), "not convex"),
        ((Mesh(POINTS, FACES[1:]),), "not convex"),
        ((Mesh(POINTS, FACES[:, ::-1]),), "not convex"),
        ((Mesh(POINTS * 5, FACES),), "near plane"),
    ]:
        with pytest.raises(SceneError, match=words):
            BACKFACE(projected(*things))


def test_a_flat_face_is_no_body() -> None:
    assert not is_convex(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], float), np.array([(0, 1, 2)]))


def test_steps_keep_what_is_kept() -> None:
    picture = projected(BALL)
    *steps, last = BACKFACE.steps(picture)
    assert [step.data["stays"] for step in steps] == kept(picture).tolist()
    assert last.work == {"faces": len(FACES), "faces turned away": int((~kept(picture)).sum())}
    assert np.array_equal(last.data["face"], BACKFACE(picture).face)


def test_steps_say_which_way_a_face_turns() -> None:
    first, *_, last = BACKFACE.steps(projected(BALL, BALL))
    assert re.fullmatch(r"face 0 turns (counter-)?clockwise around \d+\.\d pixels: its .*", first.sentence)
    assert ("stays" in first.sentence) == ("front" in first.sentence) == first.data["stays"]
    assert "not 2" in last.sentence
    edge_on = soups.picture(
        [(0, 0), (600, 300), (1200, 600)], np.ones(3), [[0, 1, 2]], np.array([1]), SIZE, 0
    )
    assert next(BACKFACE.steps(edge_on)).sentence == "face 0 is edge-on, N . V is 0: it goes"
