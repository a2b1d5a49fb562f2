"""Roberts' hidden lines: known scenes, chance scenes and real models, each edge judged by brute force."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import data
import edge_oracle
import eyeline as el
import soups
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, VisibleEdges

ROBERTS = METHODS["roberts"]
SIZE = (320, 180)
CORNER = Camera.look_at((3, 2.5, 4), (0, 0, 0), fov=0.5)
CUBE = el.samples.cube().nodes[0].mesh
MODELS = ("stanford-bunny", "spot", "fandisk")


def answer(*things: Mesh | Node, camera: Camera = CORNER, cull: str = "none") -> VisibleEdges:
    return edges_of(Scene.of(*things), camera, cull)


def edges_of(scene: Scene, camera: Camera, cull: str = "none", size: tuple[int, int] = SIZE) -> VisibleEdges:
    found = ROBERTS(project(scene, camera, size, cull))
    assert isinstance(found, VisibleEdges)
    return found


def lengths(segments: np.ndarray) -> np.ndarray:
    return np.hypot(*(segments[:, 1] - segments[:, 0]).T)


def judged(scene: Scene, found: VisibleEdges, count: int = 120) -> edge_oracle.Verdict:
    verdict = edge_oracle.audit(scene, found, count)
    assert verdict.wrong == ()
    return verdict


def sheet(left: float, top: float, right: float, bottom: float, z: float, tilt: float = 0.0) -> Mesh:
    """A sheet across the view, with its right side nearer by `tilt`."""
    points = [(left, bottom, z), (right, bottom, z + tilt), (right, top, z + tilt), (left, top, z)]
    return Mesh(points, [(0, 1, 2), (0, 2, 3)])


PAGE = Camera.look_at((0, 0, 9), (0, 0, 0), height=4.5)  # 40 pixels a metre; (0, 0) is at (160, 90)


# --- known scenes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("cull", ["none", "back"])
def test_a_cube_from_a_corner_shows_nine_edges_and_hides_three(cull: str) -> None:
    found = answer(CUBE, cull=cull)
    assert (len(found.segments), len(found.hidden), len(found.faces)) == (9, 3, 12)
    assert found.work["edges against bodies"] == 0, "its own body hides them"
    # The hidden ones meet at the corner farthest from the eye
    _, count = np.unique(found.hidden.reshape(-1, 2), axis=0, return_counts=True)
    assert sorted(count.tolist()) == [1, 1, 1, 3]


def test_a_closed_convex_mesh_is_one_body_and_a_concave_one_is_its_faces() -> None:
    assert answer(CUBE).work["bodies"] == 1
    star = el.samples.concave_body().nodes[0].mesh
    assert answer(star).work["bodies"] > 10


def test_a_cube_before_a_cube_cuts_its_edges() -> None:
    behind = Node("behind", mesh=CUBE, translation=(-0.7, -1.0, -2.0))
    scene = Scene.of(Node("before", mesh=CUBE), behind)
    found = edges_of(scene, CORNER)
    assert found.work["bodies"] == 2
    assert np.bincount(found.node[found.edge])[0] == 9
    split = np.intersect1d(found.edge, found.hidden_edge)
    assert len(split) > 0 and (found.node[split] == 1).all()
    assert judged(scene, found).decided > 100


def test_what_a_body_hides_ends_at_its_outline() -> None:
    """A line 4 metres long behind a sheet that spans x = -1 .. 0.5 over it."""
    line = sheet(-2, 0.1, 2, 0, -1)
    found = answer(sheet(-1, 1, 0.5, -1, 1), line, camera=PAGE)
    level = [np.sort(one[:, 0]).tolist() for one in found.segments if (one[:, 1] == 90).all()]
    assert sorted(level) == [[80.0, 120.0], [180.0, 240.0]]
    hidden = [np.sort(one[:, 0]).tolist() for one in found.hidden if (one[:, 1] == 90).all()]
    assert hidden == [[120.0, 180.0]]


def test_an_edge_that_pierces_a_face_is_hidden_from_there() -> None:
    """The sheet leans: z = x; edges run along z = 0 from x = -2 to 2."""
    found = answer(sheet(-1, 1, 1, -1, -1, tilt=2), sheet(-2, 0.1, 2, -0.1, 0), camera=PAGE)
    for row in (86, 94):
        level = [np.sort(one[:, 0]) for one in found.segments if (one[:, 1] == row).all()]
        assert len(level) == 2
        (_, pierced), (begin, _) = sorted(level, key=lambda one: one[0])
        assert pierced == pytest.approx(160, abs=3 / 256)
        assert begin == 200


def test_an_edge_on_the_face_of_another_body_is_seen() -> None:
    """A box stands on a floor: its lower edges lie in the floor's plane."""
    floor = Mesh([(-2, -0.5, -2), (-2, -0.5, 2), (2, -0.5, 2), (2, -0.5, -2)], [(0, 1, 2), (0, 2, 3)])
    found = answer(CUBE, floor)
    assert (np.bincount(found.node[found.edge])[0], len(np.intersect1d(found.edge, found.hidden_edge))) == (
        9,
        2,
    )


def test_edges_inside_a_flat_face_are_no_edges() -> None:
    assert len(answer(sheet(-1, 1, 1, -1, 0), camera=PAGE).faces) == 4


def test_edges_are_cut_at_the_picture_s_border() -> None:
    found = answer(sheet(-99, 1, 99, -1, 0), camera=PAGE)
    assert np.sort(found.segments[:, :, 0].reshape(-1)).tolist() == [0, 0, 320, 320]


def test_seen_and_hidden_parts_make_whole_edges() -> None:
    scene = el.samples.piercing_faces()
    found = edges_of(scene, scene.cameras[0].fitted(scene.bounds))
    whole = np.bincount(found.edge, lengths(found.segments), len(found.faces))
    whole += np.bincount(found.hidden_edge, lengths(found.hidden), len(found.faces))
    ends = found.projected.xy[found.vertices] / 256
    np.testing.assert_allclose(whole, lengths(ends), rtol=1e-12)


# --- judged by brute force --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", el.samples.HARD_CASES)
def test_hard_cases_are_right(name: str) -> None:
    scene = el.samples.SAMPLES[name]()
    camera = scene.cameras[0].fitted(scene.bounds)
    verdict = judged(scene, edges_of(scene, camera, cull="auto"))
    assert verdict.decided > 0.5 * verdict.samples


@pytest.mark.parametrize("seed", range(14))
def test_soups_around_the_eye_are_right(seed: int) -> None:
    """Faces pierce each other, pass behind the eye and reach beyond the guard band; half are single-sided."""
    scene, camera = soups.around_the_eye(seed)
    verdict = judged(scene, edges_of(scene, camera, "auto", (96, 64)))
    assert verdict.decided > 0.9 * verdict.samples


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("size", [(120, 90), (1280, 720)])
def test_real_models_are_right(name: str, size: tuple[int, int]) -> None:
    scene = el.load(data.data(f"mesh/{name}.obj"))
    verdict = judged(scene, edges_of(scene, Camera.framing(scene.bounds), size=size), 200)
    assert verdict.decided > 0.5 * verdict.samples


def test_a_model_in_parallel_projection_is_right() -> None:
    scene = el.load(data.data("mesh/fandisk.obj"))
    bounds = scene.bounds
    middle = (np.asarray(bounds.low) + np.asarray(bounds.high)) / 2
    camera = Camera.look_at(middle + bounds.diagonal, middle, height=bounds.diagonal)
    assert judged(scene, edges_of(scene, camera)).decided > 100


@pytest.mark.parametrize("size", [(320, 180), (1280, 720)])
def test_dense_meshes_have_no_specks(size: tuple[int, int]) -> None:
    """An edge that ends at a corner of the face that hides it is hidden from that corner on."""
    for scene in (Scene.of(Mesh(*soups.ball(70))), el.samples.torus()):
        found = edges_of(scene, Camera.framing(scene.bounds, 16 / 9), size=size)
        assert len(found.segments) > 3000
        assert edge_oracle.specks(scene, found) == []


def test_a_scanned_model_has_hardly_a_speck() -> None:
    """One in ten thousand, where snapping itself has changed who is before whom."""
    scene = el.load(data.data("mesh/stanford-bunny.obj"))
    found = edges_of(scene, Camera.framing(scene.bounds, 16 / 9), size=(1280, 720))
    assert len(edge_oracle.specks(scene, found)) < len(found.segments) / 10_000


def test_the_judge_finds_planted_faults() -> None:
    """Without this, a judge that never says no would do."""
    scene = el.samples.torus()
    found = edges_of(scene, Camera.framing(scene.bounds))
    swapped = replace(
        found, segments=found.hidden, edge=found.hidden_edge, hidden=found.segments, hidden_edge=found.edge
    )
    assert len(edge_oracle.audit(scene, swapped, 50).wrong) > 50
    longer = found.segments.copy()
    split = np.isin(found.edge, found.hidden_edge)
    xy = found.projected.xy[found.vertices] / 256
    longer[split] = xy[found.edge[split]]
    stretched = replace(found, segments=longer[split], edge=found.edge[split])
    assert len(edge_oracle.audit(scene, stretched, 200).wrong) > 10


# --- the same for everybody -------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*el.samples.HARD_CASES, "cube", "torus"])
def test_steps_and_kernel_give_the_same(name: str) -> None:
    scene = el.samples.SAMPLES[name]()
    camera = scene.cameras[0].fitted(scene.bounds) if scene.cameras else Camera.framing(scene.bounds)
    assert_steps_agree(edges_of(scene, camera, "auto", (96, 54)))


@pytest.mark.parametrize("seed", range(7))
def test_steps_and_kernel_give_the_same_of_soups(seed: int) -> None:
    assert_steps_agree(edges_of(*soups.around_the_eye(seed), "auto", (96, 64)))


def assert_steps_agree(found: VisibleEdges) -> None:
    *rest, last = ROBERTS.steps(found.projected)
    assert np.array_equal(last.data["segments"], found.segments)
    assert np.array_equal(last.data["hidden"], found.hidden)
    assert last.work == found.work
    settled = [one for step in rest if step.data.get("settled") for one in step.data["segments"]]
    assert np.array_equal(np.reshape(settled, (-1, 2, 2)), found.segments)


def test_any_number_of_threads_gives_the_same_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    from eyeline.geometry import cells
    from eyeline.visibility.roberts import bodies, convex_groups, edge_cells, hidden_spans

    scene = el.samples.teapot()
    answers = []
    for count in (1, 2, 5):
        for module in (cells, bodies, convex_groups, edge_cells, hidden_spans):
            monkeypatch.setattr(module, "threads", lambda count=count: count)
            monkeypatch.setattr(module, "SMALL", 0, raising=False)
        found = edges_of(scene, Camera.framing(scene.bounds))
        arrays = (found.segments, found.edge, found.hidden, found.hidden_edge)
        answers.append((b"".join(array.tobytes() for array in arrays), dict(found.work)))
    assert answers[0] == answers[1] == answers[2]


# --- hardly anything to see -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "scene",
    [
        Scene(),
        Scene.of(Mesh([(0, 0, 0)] * 3, [(0, 1, 2)])),
        Scene.of(Mesh([(0, 0, 99), (1, 0, 99), (0, 1, 99)], [(0, 1, 2)])),
        Scene((Node("hidden", mesh=CUBE, visible=False),)),
    ],
    ids=["empty", "a point", "behind the eye", "hidden"],
)
def test_nothing_has_no_edges_to_see(scene: Scene) -> None:
    found = edges_of(scene, CORNER.fitted(Scene.of(CUBE).bounds))
    assert (found.segments.shape, found.hidden.shape) == ((0, 2, 2), (0, 2, 2))
    assert_steps_agree(found)


def test_the_smallest_picture_has_edges() -> None:
    assert len(edges_of(Scene.of(CUBE), CORNER, size=(1, 1)).segments) > 0


def test_inside_a_cube_all_edges_before_the_eye_are_seen() -> None:
    inside = Camera.look_at((0, 0, 0.45), (0, 0, -1), fov=math.radians(80), near=0.01)
    found = answer(CUBE, camera=inside)
    assert len(found.hidden) == 0 and len(found.segments) == 8


def test_a_mirrored_cube_is_a_body_too() -> None:
    found = answer(Node("mirrored", mesh=CUBE, scale=(-1, 1, 1)), cull="back")
    assert (found.work["bodies"], len(found.segments), len(found.hidden)) == (1, 9, 3)


def test_many_copies_at_one_place_all_show_their_edges() -> None:
    found = answer(*(Node(str(k), mesh=CUBE) for k in range(20)))
    assert (len(found.segments), len(found.hidden)) == (180, 60)
