"""Styles: each pixel of a known scene has the colour its style promises."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import ByteArray
from eyeline.projection import project
from eyeline.samples import cube, teapot
from eyeline.scene.camera import Camera
from eyeline.scene.colour import srgb_from_linear
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.shading.cutout import see
from eyeline.shading.frame import Frame
from eyeline.shading.look import Look
from eyeline.shading.resolve import Layers
from eyeline.shading.style import Style
from eyeline.shading.styles import STYLES
from eyeline.shading.styles.depth import Depth
from eyeline.shading.styles.id import Id, id_colours
from eyeline.shading.styles.normal import Normal
from eyeline.shading.styles.toon import Toon, beneath
from eyeline.shading.styles.wire import Wire
from eyeline.shading.styles.xray import XRay
from eyeline.visibility import METHODS
from eyeline.visibility.method import Visible

SIZE = (48, 32)
FLAT = Camera(height=2.0, near=0.5, far=100.0)  # the picture is 3 wide, 16 pixels a metre
FOUR = ((-64, -96), (96, -64), (64, 96), (-96, 64))
BACKDROP = (0.1, 0.1, 0.1)


def frame_of(
    scene: Scene,
    style: Style,
    camera: Camera = FLAT,
    shifts: Sequence[tuple[int, int]] = ((0, 0),),
    size: tuple[int, int] = SIZE,
    **look: object,
) -> Frame:
    projected = project(scene, camera, size)
    visibles = see(scene, projected, METHODS["zbuffer"], shifts, see_through=style.see_through)
    return Frame(scene, projected, visibles, Look(**look))  # type: ignore[arg-type]


def drawn(scene: Scene, style: Style, **options: object) -> ByteArray:
    return style(frame_of(scene, style, **options))  # type: ignore[arg-type]


def square(distance: float, half: float = 0.5, x: float = 0.0, tilt: float = 0.0, name: str = "") -> Mesh:
    """A square around (x, 0, -distance), leaning back by `tilt` metres at its upper edge."""
    corners = [(x - half, -half, 0), (x + half, -half, 0), (x + half, half, -tilt), (x - half, half, -tilt)]
    return Mesh(np.array(corners) - (0, 0, distance), [(0, 1, 2), (0, 2, 3)], name=name)


def visible(frame: Frame) -> Visible:
    return frame.visibles[0][0]


# --- all of them ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", STYLES)
def test_a_style_is_known_by_its_name(name: str) -> None:
    assert STYLES[name].name == name


@pytest.mark.parametrize("name", STYLES)
def test_a_picture_is_the_same_every_time(name: str) -> None:
    scene = teapot()
    camera = Camera.framing(scene.bounds, 1.5)
    pictures = [drawn(scene, STYLES[name], camera=camera, shifts=FOUR, size=(96, 64)) for _ in range(2)]
    assert pictures[0].tobytes() == pictures[1].tobytes()
    assert pictures[0].shape == (64, 96, 4)


@pytest.mark.parametrize("name", STYLES)
def test_nothing_stands_before_the_backdrop_of_an_empty_scene(name: str) -> None:
    picture = drawn(Scene(), STYLES[name], background="transparent")
    assert not picture.any()


@pytest.mark.parametrize("name", [name for name in STYLES if name != "toon"])
def test_only_what_stands_there_is_drawn(name: str) -> None:
    frame = frame_of(Scene.of(square(3.0)), STYLES[name], background="transparent", ground="off")
    alpha = STYLES[name](frame)[..., 3]
    assert ((alpha > 0) == (visible(frame).face >= 0)).all() or name == "xray"
    assert (alpha[visible(frame).face < 0] == 0).all()


# --- depth ------------------------------------------------------------------------------------------------


def test_depth_goes_from_light_to_dark_in_even_steps_of_distance() -> None:
    style = Depth()
    frame = frame_of(Scene.of(square(2.0, x=-0.8), square(5.0, x=0.0, half=0.2), square(10.0, x=0.8)), style)
    picture, seen = style(frame), visible(frame)
    for node, part in ((0, 0.0), (1, 3 / 8), (2, 1.0)):
        grey = np.rint(255 * (style.nearest + (style.farthest - style.nearest) * part))
        assert (picture[seen.node == node] == [grey, grey, grey, 255]).all()
    assert (picture[seen.node < 0] == [0, 0, 0, 255]).all()


def test_depth_falls_monotonically_with_distance() -> None:
    style = Depth()
    camera = Camera.look_at((0, 1.5, 4), (0, 0, 0), fov=0.7)
    frame = frame_of(teapot(), style, camera=camera)
    picture, seen = style(frame), visible(frame)
    order = np.argsort(seen.distance[seen.face >= 0], kind="stable")
    assert (np.diff(picture[seen.face >= 0][order, 0].astype(int)) <= 0).all()


def test_all_at_one_distance_is_drawn_as_nearest() -> None:
    picture = drawn(Scene.of(square(3.0)), Depth())
    assert (picture[16, 24] == [245, 245, 245, 255]).all()


# --- normal -----------------------------------------------------------------------------------------------


def test_a_plane_that_faces_the_camera_is_128_128_255() -> None:
    picture = drawn(Scene.of(square(3.0)), Normal())
    assert (picture[16, 24] == [128, 128, 255, 255]).all()


def test_a_leaning_plane_shows_its_normal() -> None:
    leaning = square(3.0, half=0.5, tilt=1.0)  # 45 degrees: its normal is up and to the eye
    picture = drawn(Scene.of(leaning), Normal())
    half = np.rint(128 + 127 * np.sqrt(0.5))
    assert (picture[16, 24] == [128, half, half, 255]).all()


@pytest.mark.parametrize("space", ["view", "world"])
def test_normals_are_of_the_camera_or_of_the_world(space: str) -> None:
    turn = quaternion.from_axis_angle((0, 1, 0), np.pi / 2)
    wall = Node("wall", rotation=tuple(turn), mesh=square(3.0))  # now at x = -3, its front along +x
    camera = Camera.look_at((0, 0, 0), (-1, 0, 0), height=2.0, near=0.5, far=9.0)
    picture = drawn(Scene.of(wall), Normal(space=space), camera=camera)  # type: ignore[arg-type]
    expected = [128, 128, 255, 255] if space == "view" else [255, 128, 128, 255]
    assert (picture[16, 24] == expected).all()


def test_a_face_seen_from_behind_shows_the_side_that_is_seen() -> None:
    mesh = square(3.0)
    picture = drawn(Scene.of(mesh.changed(faces=mesh.faces[:, ::-1].copy())), Normal())
    assert (picture[16, 24] == [128, 128, 255, 255]).all()


# --- id ---------------------------------------------------------------------------------------------------


def test_the_first_thousand_colours_are_distinct() -> None:
    shown = np.rint(255 * srgb_from_linear(id_colours(np.arange(1000))[:, :3])).astype(int)
    assert len(np.unique(shown, axis=0)) == 1000


def test_neighbouring_numbers_have_far_colours() -> None:
    shown = 255 * srgb_from_linear(id_colours(np.arange(64))[:, :3])
    for apart in (1, 2, 3):
        assert np.abs(shown[apart:] - shown[:-apart]).max(axis=1).min() > 40


def test_every_pixel_has_the_colour_of_its_node() -> None:
    scene = Scene.of(square(3.0, x=-0.6), square(4.0, x=0.6), square(5.0, half=0.9))
    frame = frame_of(scene, Id())
    picture, seen = Id()(frame), visible(frame)
    colours = np.rint(255 * srgb_from_linear(id_colours(np.arange(3))[:, :3])).astype(np.uint8)
    assert len(np.unique(seen.node)) == 4
    for node in range(3):
        assert (picture[seen.node == node, :3] == colours[node]).all()


def test_faces_can_have_colours_of_their_own() -> None:
    frame = frame_of(Scene.of(square(3.0)), Id(of="face"))
    picture, seen = Id(of="face")(frame), visible(frame)
    first, second = (np.unique(picture[seen.face == face], axis=0) for face in (0, 1))
    assert len(first) == len(second) == 1 and (first != second).any()


# --- wire -------------------------------------------------------------------------------------------------


def test_lines_follow_edges_and_leave_the_middle_of_faces_as_paper() -> None:
    style = Wire(width=1.0)
    picture = drawn(Scene.of(square(3.0, half=0.75)), style).astype(int)
    paper = 255 * srgb_from_linear(np.array(style.paper))
    # The square covers columns 12 to 35 and rows 4 to 27; its diagonal leads from lower left to upper right
    assert np.abs(picture[9, 17, :3] - paper).max() <= 1
    assert np.abs(picture[22, 30, :3] - paper).max() <= 1
    assert (picture[4, 14:34, 0] < picture[9, 17, 0] - 60).all()
    assert (picture[6:26, 12, 0] < picture[9, 17, 0] - 60).all()
    assert all(picture[27 - k, 12 + k, 0] < picture[9, 17, 0] - 60 for k in range(4, 20))


def test_lines_are_as_wide_on_the_screen_however_far_the_face() -> None:
    camera = Camera(fov=1.0, near=0.5, far=100.0)
    near, far = (drawn(Scene.of(square(3.0 * k, half=0.9 * k)), Wire(), camera=camera) for k in (1, 4))
    assert near.tobytes() == far.tobytes()
    assert (near[..., 0] < 120).any()


def test_hidden_lines_are_removed() -> None:
    style = Wire()
    alone = drawn(Scene.of(square(3.0, half=0.9)), style)
    before_another = drawn(Scene.of(square(3.0, half=0.9), square(5.0, half=0.5)), style)
    assert alone.tobytes() == before_another.tobytes()


def test_a_dense_mesh_stays_a_surface() -> None:
    ticks = np.linspace(-0.9, 0.9, 121)  # a quarter of a pixel apart
    x, y = np.meshgrid(ticks, ticks)
    corner = np.arange(120)[:, None] * 121 + np.arange(120)
    faces = np.stack([corner, corner + 1, corner + 122], axis=-1).reshape(-1, 3)
    style = Wire()
    picture = drawn(Scene.of(Mesh(np.stack([x, y, 0 * x - 3], axis=-1).reshape(-1, 3), faces)), style)
    paper = 255 * srgb_from_linear(np.array(style.paper))
    assert np.abs(picture[16, 24, :3] - paper).max() < 12


# --- xray -------------------------------------------------------------------------------------------------


def shown_through(style: XRay, veils: int, color: Sequence[float]) -> np.ndarray:  # type: ignore[type-arg]
    passing = (1 - style.veil) ** veils
    return 255 * srgb_from_linear((1 - passing) * np.array(color) + passing * np.array(BACKDROP))


@pytest.mark.parametrize("count", [1, 2, 7])
def test_every_surface_adds_its_veil_seen_or_hidden(count: int) -> None:
    style = XRay()
    scene = Scene.of(*[square(2.0 + k) for k in range(count)])
    picture = drawn(scene, style, background=BACKDROP)
    assert np.abs(picture[16, 24, :3] - shown_through(style, count, style.on_dark)).max() <= 1.001


def test_glass_has_a_far_wall() -> None:
    """A single-sided face seen from behind is culled in other styles."""
    mesh = square(3.0).with_material(Material(double_sided=False))
    away = Scene.of(mesh.changed(faces=mesh.faces[:, ::-1].copy()))
    assert drawn(away, XRay(), background="transparent")[16, 24, 3] == round(255 * XRay().veil)
    assert drawn(away, Normal(), background="transparent")[16, 24, 3] == 0


def test_a_surface_seen_edge_on_is_denser() -> None:
    style = XRay()
    flat = drawn(Scene.of(square(3.0)), style, background="transparent")[16, 24, 3]
    steep = drawn(Scene.of(square(3.0, tilt=6.0)), style, background="transparent")[16, 24, 3]
    edge_on = 1 - 1 / np.sqrt(37)
    assert flat == round(255 * style.veil)
    assert abs(steep - 255 * (style.veil + (style.rim - style.veil) * edge_on**style.sharpness)) <= 1


def test_glass_is_dark_before_a_light_backdrop_and_light_before_a_dark_one() -> None:
    scene = Scene.of(square(3.0))
    light, dark = (drawn(scene, XRay(), background=(c, c, c)) for c in (0.9, 0.01))
    assert light[16, 24].sum() < light[0, 0].sum()
    assert dark[16, 24].sum() > dark[0, 0].sum()


# --- toon -------------------------------------------------------------------------------------------------

SUN = Light("directional", intensity=3.0)  # along -z: straight at what faces the camera
CHALK = Material(base_color=(0.5, 0.25, 0.125, 1.0), roughness=1.0)


@pytest.mark.parametrize(("tilt", "tone"), [(0.0, 2), (1.6, 2), (3.0, 1), (40.0, 0)])
def test_light_has_a_few_tones(tilt: float, tone: int) -> None:
    """A square of height 1 that leans by `tilt` has the cosine 1 / sqrt(1 + tilt squared) to the light."""
    style = Toon()
    scene = Scene.of(square(3.0, tilt=tilt).with_material(CHALK), SUN)
    picture = drawn(scene, style, background=BACKDROP, shadows=False)
    expected = 255 * srgb_from_linear(np.array(style.tones[tone]) * CHALK.base_color[:3])
    assert np.abs(picture[16, 24, :3] - expected).max() <= 1.001


def test_unlit_materials_keep_their_colour_in_any_light() -> None:
    sign = Material(base_color=(0.5, 0.25, 0.125, 1.0), unlit=True)
    scene = Scene.of(square(3.0, tilt=40.0).with_material(sign), SUN)
    picture = drawn(scene, Toon(), background=BACKDROP)
    assert np.abs(picture[16, 24, :3] - 255 * srgb_from_linear(np.array(sign.base_color[:3]))).max() <= 1.001


def test_what_lies_in_shadow_has_the_darkest_tone() -> None:
    style = Toon()
    blocker = Node("blocker", translation=(-1.0, 0.0, 0.0), mesh=square(2.0, half=0.3).with_material(CHALK))
    sun = Node("sun", rotation=tuple(quaternion.from_axis_angle((0, 1, 0), -np.pi / 4)), light=SUN)
    scene = Scene.of(square(3.0, half=0.9).with_material(CHALK), blocker, sun)
    picture = drawn(scene, style, background=BACKDROP)
    darkest, lightest = (
        255 * srgb_from_linear(np.array(style.tones[k]) * CHALK.base_color[:3]) for k in (0, 2)
    )
    assert np.abs(picture[16, 24, :3] - darkest).max() <= 1.001
    assert np.abs(picture[16, 33, :3] - lightest).max() <= 1.001


def inked(scene: Scene, **options: object) -> np.ndarray:  # type: ignore[type-arg]
    """(H, W) where the picture is as dark as an outline."""
    picture = drawn(scene, Toon(), background=(0.8, 0.8, 0.8), shadows=False, **options)
    return picture[..., :3].max(axis=-1) < 60


def test_ink_runs_around_a_silhouette_on_both_sides_and_nowhere_else() -> None:
    lines = inked(Scene.of(square(3.0, half=0.5).with_material(CHALK), SUN))
    expected = np.zeros((32, 48), bool)
    expected[7:25, 16:32] = expected[8:24, 15:33] = True
    expected[9:23, 17:31] = False
    assert (lines == expected).all()


def test_ink_parts_nodes_that_touch() -> None:
    lines = inked(
        Scene.of(square(3.0, x=-0.5).with_material(CHALK), square(3.0, x=0.5).with_material(CHALK), SUN)
    )
    assert lines[16, 23] and lines[16, 24] and not lines[16, 20]


def test_no_ink_between_the_faces_of_a_plane() -> None:
    lines = inked(Scene.of(square(3.0, half=0.8, tilt=1.0).with_material(CHALK), SUN))
    assert not lines[8:24, 15:33].any()


def test_ink_marks_creases_and_steps_of_one_node() -> None:
    step = np.concatenate([square(3.0, x=-0.5).points, square(5.0, x=0.5).points])
    both = Mesh(step, [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)], material=CHALK)
    picture = drawn(Scene.of(both, SUN), Toon(), background=(0.8, 0.8, 0.8), shadows=False)
    assert picture[16, 23, 0] < 0.75 * picture[16, 18, 0] and picture[16, 24, 0] < 0.75 * picture[16, 30, 0]
    camera = Camera.look_at((3, 2.5, 4), (0, 0, 0), fov=0.6)
    boxed = drawn(cube(), Toon(), camera=camera, size=(96, 64), background=(0.8, 0.8, 0.8))
    assert np.unique(boxed[..., 0][10:54, 20:76]).size > 3


def test_ink_does_not_depend_on_how_the_picture_is_cut_into_strips(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = teapot()
    camera = Camera.framing(scene.bounds, 1.5)
    whole = drawn(scene, Toon(), camera=camera, shifts=FOUR, size=(96, 64))
    monkeypatch.setattr("eyeline.shading.frame.STRIP_PIXELS", 96 * 8)
    assert drawn(scene, Toon(), camera=camera, shifts=FOUR, size=(96, 64)).tobytes() == whole.tobytes()


def test_layers_beneath_others_keep_every_list() -> None:
    random = np.random.default_rng(4)
    both = []
    for mark in (1.0, 2.0):
        counts = random.integers(0, 3, (2, 5))
        ends = np.cumsum(counts.reshape(-1)).reshape(2, 5)
        first = np.concatenate([ends[:, :1] - counts[:, :1], ends], axis=1)
        colour = np.stack(
            [np.full(counts.sum(), mark), np.arange(counts.sum()), *np.zeros((2, counts.sum()))]
        )
        both.append(Layers(first, np.ascontiguousarray(colour.T, np.float32)))
    made = beneath(*both)
    for sample in range(2):
        for pixel in range(5):
            lists = [
                one.colour[one.first[sample, pixel] : one.first[sample, pixel + 1], :2]
                for one in (made, *both)
            ]
            assert lists[0].tolist() == [*lists[1].tolist(), *lists[2].tolist()]
