"""What an answer tells: nodes, metres, and how much of what is seen."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import scenes
from eyeline.errors import OptionError, SceneError
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, Visible, visible_of
from eyeline.visibility.method import nodes_of

SIZE = (scenes.WIDTH, scenes.HEIGHT)


def seen(scene: Scene, camera: Camera) -> Visible:
    return replace(visible_of(project(scene, camera, SIZE)), scene=scene)


def wall(distance: float) -> Mesh:
    """A wall across the view, tilted a little."""
    corners = [
        (-99, -99, -distance - 9.9),
        (99, -99, -distance - 9.9),
        (99, 99, -distance + 9.9),
        (-99, 99, -distance + 9.9),
    ]
    return Mesh(corners, [(0, 1, 2), (0, 2, 3)])


@pytest.mark.parametrize(
    "lens",
    [
        {"fov": 1.0, "near": 0.5},
        {"fov": 1.0, "near": 0.5, "far": 80.0},
        {"height": 9.0, "near": -2.0, "far": 80.0},
    ],
)
def test_distance_is_metres_along_the_view(lens: dict[str, float]) -> None:
    camera = Camera(**lens)
    answer = seen(Scene.of(wall(20)), camera)
    _, y = scenes.centres()
    up = 1 - 2 * y / scenes.HEIGHT
    t = math.tan(0.5)
    # The wall is z = -20 + y / 10; a perspective ray has y = -z t up, a parallel one y = 4.5 up
    distance = 20 / (1 + t * up / 10) if "fov" in lens else 20 - 0.45 * up
    assert np.allclose(answer.distance, distance, rtol=2e-5)


def test_background_is_infinitely_far() -> None:
    answer = seen(Scene(), Camera(fov=1.0, near=0.5))
    assert np.isposinf(answer.distance).all()
    assert (answer.node == -1).all()
    assert (answer.face == -1).all()
    assert (answer.depth == 0).all()


def test_faces_are_looked_up_among_many_surfaces() -> None:
    meshes = [scenes.rectangle(k, k, k + 1, k + 1) for k in range(30)]
    scene = Scene(tuple(Node(str(k), mesh=mesh if k % 3 else None) for k, mesh in enumerate(meshes)))
    projected = project(scene, scenes.page_camera(), SIZE)
    face = np.array([[-1, 0, 1, 2], [38, 39, -1, 20]])
    face = face.astype(np.int32)
    assert nodes_of(face, projected).tolist() == [[-1, 1, 1, 2], [29, 29, -1, 16]]


# --- areas ------------------------------------------------------------------------------------------------


def crowd() -> Visible:
    """A board half behind a box, which belongs to a group, and a leaf before both."""
    nodes = (
        Node("board", mesh=scenes.rectangle(4, 4, 24, 24, 0)),
        Node("group"),
        Node("box", parent=1, mesh=scenes.rectangle(14, 4, 34, 24, 5)),
        Node("leaf", parent=1, mesh=scenes.rectangle(20, 14, 30, 30, 9)),
        Node("far away", mesh=scenes.rectangle(900, 900, 901, 901)),
    )
    return seen(Scene(nodes), scenes.page_camera())


def test_an_area_tells_what_is_seen_and_what_hides_the_rest() -> None:
    area = crowd().area("board")
    assert (area.pixels, area.unoccluded_pixels) == (200, 400)
    assert area.fraction == 0.5
    assert dict(area.occluders) == {"group/box": 160, "group/leaf": 40}
    assert list(area.occluders) == ["group/box", "group/leaf"]


def test_a_node_counts_with_what_hangs_from_it() -> None:
    answer = crowd()
    assert answer.area("group").pixels == 400 + 60
    assert answer.area("group").occluders == {}
    assert answer.area("box").unoccluded_pixels == 400
    assert answer.area("box").pixels == 300


def test_a_node_out_of_the_picture_has_no_area() -> None:
    area = crowd().area("far away")
    assert (area.pixels, area.unoccluded_pixels, area.fraction) == (0, 0, 0.0)


def test_without_a_scene_nodes_go_by_number() -> None:
    answer = replace(crowd(), scene=None)
    assert answer.area(0).occluders == {"node 2": 160, "node 3": 40}
    with pytest.raises(SceneError, match="'board'"):
        answer.area("board")


def test_an_unknown_node_is_refused() -> None:
    with pytest.raises(SceneError, match="'bord'; there is 'board'"):
        crowd().area("bord")


def test_an_unknown_method_is_refused_with_the_nearest() -> None:
    with pytest.raises(OptionError, match=r"'zbufer'.*'zbuffer'"):
        visible_of(crowd().projected, "zbufer")
    with pytest.raises(OptionError, match="'backface' that answers alone"):
        visible_of(crowd().projected, "backface")


def test_every_method_is_listed_under_its_name() -> None:
    assert all(
        method.name == name and method.space in ("object", "image") for name, method in METHODS.items()
    )
