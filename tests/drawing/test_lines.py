"""Lines of scenes whose drawing is known."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest

import eyeline as el
import line_oracle
import scenes
from eyeline.drawing.kinds import BOUNDARY, CREASE, INTERSECTION, KINDS, OUTLINE, USUAL
from eyeline.drawing.lines import Lines, lines_of
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

PAGE = (scenes.WIDTH, scenes.HEIGHT)
CORNER = Camera.look_at((3, 2.5, 4), (0, 0, 0), fov=math.radians(40))
FINE = 1e-3  # pixels: more than the drawing's grid and its dust
RIGHT_ANGLE = math.radians(30)


def on_page(scene: Scene, kinds: tuple[str, ...] = USUAL) -> Lines:
    return lines_of(scene, scenes.page_camera(), PAGE, kinds, RIGHT_ANGLE)


def drawn(lines: Lines, seen: bool = True) -> set[tuple[tuple[float, float], ...]]:
    """Ends of pieces in whole hundredths of a pixel, the lower one first."""
    ends = np.round(lines.pixels[lines.seen == seen], 2) + 0.0
    return {tuple(sorted((tuple(a), tuple(b)))) for a, b in ends.tolist()}


def length(lines: Lines, chosen: npt.NDArray[np.bool_]) -> float:
    """Pixels of some pieces together."""
    return float(np.hypot(*(lines.pixels[chosen, 1] - lines.pixels[chosen, 0]).T).sum())


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Mesh:
    """A closed box, fronts outside."""
    cube = el.samples.cube().surfaces[0].mesh
    points = (cube.points - cube.bounds.low) / (cube.bounds.high - cube.bounds.low)
    return Mesh(np.array(low) + points * np.subtract(high, low), cube.faces)


# --- what is seen -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("height", [None, 4.0], ids=["perspective", "orthographic"])
def test_a_cube_seen_from_a_corner_shows_nine_edges_and_hides_three(height: float | None) -> None:
    camera = Camera.look_at((3, 2.5, 4), (0, 0, 0), height=height)
    lines = lines_of(Scene.of(box((-1, -1, -1), (1, 1, 1))), camera, (320, 240), USUAL, RIGHT_ANGLE)
    assert sorted(lines.kind[lines.seen].tolist()) == [OUTLINE] * 6 + [CREASE] * 3
    assert lines.kind[~lines.seen].tolist() == [CREASE] * 3
    assert sorted(len(path.points) for path in lines.paths if path.seen) == [2, 3, 7]


def test_a_nearer_square_hides_part_of_two_edges() -> None:
    """The squares of `nearer hides farther`, to the hundredth of a pixel."""
    lines = on_page(Scene.of(scenes.rectangle(4, 4, 30, 20, 0), scenes.rectangle(20, 10, 44, 28, 5)))
    assert drawn(lines) == {
        ((20, 10), (44, 10)), ((44, 10), (44, 28)), ((20, 28), (44, 28)), ((20, 10), (20, 28)),
        ((4, 4), (30, 4)), ((4, 4), (4, 20)), ((30, 4), (30, 10)), ((4, 20), (20, 20)),
    }  # fmt: skip
    assert drawn(lines, seen=False) == {((30, 10), (30, 20)), ((20, 20), (30, 20))}
    assert set(lines.kind.tolist()) == {BOUNDARY}


def test_through_a_hole_one_sees_what_is_behind() -> None:
    frame = [
        scenes.rectangle(4, 4, 44, 10, 5), scenes.rectangle(4, 22, 44, 28, 5),
        scenes.rectangle(4, 10, 16, 22, 5), scenes.rectangle(32, 10, 44, 22, 5),
    ]  # fmt: skip
    points = np.concatenate([one.points for one in frame])
    faces = np.concatenate([one.faces + 4 * k for k, one in enumerate(frame)])
    bar = scenes.rectangle(10, 14, 38, 18)
    lines = on_page(Scene.of(Mesh(points, faces), bar))
    of_bar = lines.node == 1
    assert length(lines, of_bar & lines.seen) == pytest.approx(2 * (32 - 16), abs=FINE)
    assert length(lines, of_bar & ~lines.seen) == pytest.approx(2 * 12 + 2 * 4, abs=FINE)
    assert lines.seen[~of_bar].all()


def test_faces_that_pierce_each_other_meet_in_a_line() -> None:
    """The slopes of `piercing`: they cross along x = 24, and each is hidden beyond it."""
    lines = on_page(
        Scene.of(scenes.rectangle(4, 4, 44, 20, (-10, 10)), scenes.rectangle(4, 10, 44, 28, (10, -10)))
    )
    crossing = lines.kind == INTERSECTION
    assert lines.seen[crossing].all()
    assert lines.pixels[crossing, :, 0] == pytest.approx(24, abs=FINE)
    assert length(lines, crossing) == pytest.approx(10, abs=FINE)
    assert ((4, 20), (24, 20)) in drawn(lines, seen=False) and ((24, 20), (44, 20)) in drawn(lines)


def test_the_lines_of_a_cycle_are_hidden_by_turns() -> None:
    """Four planks, each over the next: each goes under it for six pixels or more."""
    lines = on_page(scenes.cyclic().scene)
    for node in range(4):
        assert length(lines, (lines.node == node) & ~lines.seen) > 6 - FINE
    verdict = line_oracle.audit(
        scenes.cyclic().scene, scenes.page_camera(), PAGE,
        line_oracle.Segments(lines.world, lines.faces, lines.seen),
    )  # fmt: skip
    assert verdict.wrong == ()


def test_a_line_before_the_near_plane_begins_there() -> None:
    known = scenes.between_near_and_far()
    lines = lines_of(known.scene, known.camera, PAGE, USUAL, RIGHT_ANGLE)
    assert drawn(lines) == {((12, 4), (36, 4)), ((12, 28), (36, 28))}


def test_what_lies_outside_the_picture_is_not_drawn() -> None:
    lines = on_page(Scene.of(scenes.rectangle(-10, 5, 60, 40)))
    assert drawn(lines) == {((0, 5), (48, 5))}
    assert drawn(lines, seen=False) == set()


def test_single_sided_faces_hide_nothing_from_behind() -> None:
    known = scenes.backs_are_dropped()
    lines = lines_of(known.scene, known.camera, PAGE, USUAL, RIGHT_ANGLE)
    assert set(lines.node.tolist()) == {0, 2}  # behind, mirrored; but not turned
    assert lines.seen.all()


def test_instances_are_drawn_where_they_stand() -> None:
    known = scenes.staircase()
    lines = lines_of(known.scene, known.camera, PAGE, USUAL, RIGHT_ANGLE)
    steps = lines.node == 0
    assert length(lines, steps) == pytest.approx(5 * 2 * (12 + 8), abs=5 * FINE)
    # Each but the last is under the next by 6 by 4 pixels
    assert length(lines, steps & ~lines.seen) == pytest.approx(4 * (6 + 4), abs=5 * FINE)


def test_hidden_nodes_and_empty_scenes_have_no_lines() -> None:
    for known in (scenes.hidden_node(), scenes.nothing()):
        lines = lines_of(known.scene, known.camera, PAGE, KINDS, RIGHT_ANGLE)
        assert set(lines.node.tolist()) <= {1}
    assert len(lines.kind) == 0 and lines.paths == ()


# --- which edges ------------------------------------------------------------------------------------------


def test_edges_of_a_mesh_have_the_kind_that_the_oracle_gives_them() -> None:
    scene = Scene.of(*el.samples.torus().nodes)
    camera = Camera.look_at((2, 3, 4), (0, 0, 0))
    lines = lines_of(scene, camera, (640, 480), KINDS, 0.12)
    expected = line_oracle.edges_of(scene, camera, 0.12)
    assert len(expected["crease"]) > 0
    for number, kind in enumerate(KINDS, 1):
        found = length_in_world(lines, lines.kind == number)
        edges = [np.array([*edge]) for edge in expected[kind]]
        wanted = sum(float(np.linalg.norm(ends[1] - ends[0])) for ends in edges)
        assert found == pytest.approx(wanted, rel=1e-6), kind


def length_in_world(lines: Lines, chosen: npt.NDArray[np.bool_]) -> float:
    """Metres of some pieces together."""
    return float(np.linalg.norm(lines.world[chosen, 1] - lines.world[chosen, 0], axis=1).sum())


def test_crease_angle_decides_what_is_a_crease() -> None:
    scene = Scene.of(box((-1, -1, -1), (1, 1, 1)))
    for angle, creases in ((math.radians(89), 6), (math.radians(91), 0)):
        lines = lines_of(scene, CORNER, (320, 240), USUAL, angle)
        assert (lines.kind == CREASE).sum() == creases


def test_an_edge_that_two_boxes_share_is_drawn_once() -> None:
    """Two boxes side by side, flush: the four edges around their common side would be drawn twice."""
    both = Scene.of(box((-1, -1, -1), (0, 1, 1)), box((0, -1, -1), (1, 1, 1)))
    lines = lines_of(both, CORNER, (320, 240), USUAL, RIGHT_ANGLE)
    pieces = [tuple(sorted(map(tuple, np.round(ends, 3).tolist()))) for ends in lines.pixels]
    assert len(pieces) == len(set(pieces))


@pytest.mark.parametrize("height", [None, 5.0], ids=["perspective", "orthographic"])
def test_where_edges_of_two_boxes_overlap_one_is_drawn(height: float | None) -> None:
    """A small box flush on the front and the left of a large one: their edges overlap in part."""
    camera = Camera.look_at((-3, 2.5, 4), (0, 0, 0), height=height)
    large, small = box((-1, -1, -1), (1, 1, 1)), box((-1, -0.4, 0.3), (-0.2, 0.5, 1))
    alone, both = (
        lines_of(Scene.of(*meshes), camera, (320, 240), USUAL, RIGHT_ANGLE)
        for meshes in ((large,), (large, small))
    )
    corner = [np.array([-1, y, 1.0]) for y in (-1, 1)]

    def on_corner(lines: Lines) -> float:
        """Metres of pieces along the large box's corner, however often."""
        along = (np.abs(lines.world - corner[0])[:, :, [0, 2]] < 1e-4).all(axis=(1, 2))
        return length_in_world(lines, along)

    assert on_corner(alone) == pytest.approx(2, abs=1e-3)
    assert on_corner(both) == pytest.approx(2, abs=1e-3)


def test_corners_at_one_place_are_one() -> None:
    """A box whose faces share no vertices, as a file with normals has it, has the same lines."""
    mesh = box((-1, -1, -1), (1, 1, 1))
    split = Mesh(mesh.points[mesh.faces.reshape(-1)], np.arange(36).reshape(-1, 3))
    one, other = (lines_of(Scene.of(each), CORNER, (320, 240), USUAL, RIGHT_ANGLE) for each in (mesh, split))
    assert drawn(one) == drawn(other) and drawn(one, seen=False) == drawn(other, seen=False)


def test_a_mirrored_node_has_the_same_lines() -> None:
    mesh = box((-1, -1, -1), (1, 1, 1)).with_material(Material(double_sided=False))
    plain = lines_of(Scene.of(mesh), CORNER, (320, 240), USUAL, RIGHT_ANGLE)
    mirrored = Scene.of(Node("mirrored", mesh=mesh, scale=(-1.0, 1.0, 1.0)))
    assert drawn(lines_of(mirrored, CORNER, (320, 240), USUAL, RIGHT_ANGLE)) == drawn(plain)


def test_the_order_of_faces_does_not_matter() -> None:
    random = np.random.default_rng(3)
    scene = el.samples.teapot()
    shuffled = []
    for node in scene.nodes:
        assert node.mesh is not None
        order = random.permutation(len(node.mesh.faces))
        shuffled.append(node.changed(mesh=Mesh(node.mesh.points, node.mesh.faces[order])))
    camera = Camera.look_at((0.4, 0.35, 0.8), (0, 0.08, 0))
    one, other = (
        lines_of(each, camera, (640, 480), ("outline", "boundary", "crease"), RIGHT_ANGLE)
        for each in (scene, Scene(tuple(shuffled)))
    )
    assert drawn(one) == drawn(other) and drawn(one, seen=False) == drawn(other, seen=False)


# --- paths ------------------------------------------------------------------------------------------------


def test_paths_hold_every_piece_once() -> None:
    lines = lines_of(el.samples.desk_lamp(), *framed(el.samples.desk_lamp()), USUAL, RIGHT_ANGLE)
    for seen in (True, False):
        paths = [path.points for path in lines.paths if path.seen == seen]
        steps = np.concatenate([np.diff(points, axis=0) for points in paths])
        assert np.hypot(*steps.T).sum() == pytest.approx(length(lines, lines.seen == seen))


def test_an_outline_is_one_path() -> None:
    ball = el.samples.sphere()
    lines = lines_of(ball, *framed(ball), ("outline",), RIGHT_ANGLE)
    (path,) = [path for path in lines.paths if path.seen]
    assert (path.points[0] == path.points[-1]).all()


def framed(scene: Scene) -> tuple[Camera, tuple[int, int]]:
    """A view that frames a scene, and a size of its shape."""
    return Camera.framing(scene.bounds, 4 / 3), (640, 480)
