"""Transparency is exact: it follows from depth alone, at every sample."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from eyeline.errors import OptionError
from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.colour import srgb_from_linear
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shading import transparency
from eyeline.shading.attributes import attributes_of
from eyeline.shading.cutout import see
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.lanes import ALPHA
from eyeline.shading.lanes import BLUE as BLUE_ROW
from eyeline.shading.lanes import GREEN as GREEN_ROW
from eyeline.shading.lanes import RED as RED_ROW
from eyeline.shading.look import Look
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.transparency import drawn_through, layers, stacked
from eyeline.visibility import METHODS

SIZE = (24, 16)
CAMERA = Camera(height=2.0, near=0.5, far=100.0)  # looks along -z from the origin; the picture is 3 wide
FOUR = ((-64, -96), (96, -64), (64, 96), (-96, 64))
RED, GREEN, BLUE = (0.9, 0.1, 0.1), (0.1, 0.8, 0.2), (0.1, 0.2, 0.9)


def square(
    color: tuple[float, float, float], alpha: float, distance: float, half: float = 0.75, x: float = 0.0
) -> Mesh:
    """A square across the view, blended where its alpha is below 1; unlit, so its colour is known."""
    corners = [(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)]
    material = Material(base_color=(*color, alpha), alpha_mode="blend" if alpha < 1 else "opaque", unlit=True)
    return Mesh([(u, v, -distance) for u, v in corners], [(0, 1, 2), (0, 2, 3)], material=material)


def frame_of(
    *meshes: Mesh, shifts: Sequence[tuple[int, int]] = ((0, 0),), background: object = (0.5, 0.25, 0.0)
) -> Frame:
    scene = Scene.of(*meshes)
    projected = project(scene, CAMERA, SIZE)
    visibles = see(scene, projected, METHODS["zbuffer"], shifts, see_through=True)
    return Frame(scene, projected, visibles, Look(background=background))  # type: ignore[arg-type]


def drawn(*meshes: Mesh, **options: object) -> ByteArray:
    frame = frame_of(*meshes, **options)  # type: ignore[arg-type]
    return drawn_through(frame, lambda points: base_colours(frame, points))


def base_colours(frame: Frame, points: SurfacePoints) -> FloatArray:
    """Unlit: what the material says."""
    return np.ascontiguousarray(
        attributes_of(frame, points)[[RED_ROW, GREEN_ROW, BLUE_ROW, ALPHA]].T[: len(points)]
    )


def over(*layers_far_to_near: tuple[tuple[float, float, float], float]) -> FloatArray:
    """The definition of "over", in linear light."""
    colour = np.array([0.5, 0.25, 0.0])
    for top, alpha in layers_far_to_near:
        colour = alpha * np.array(top) + (1 - alpha) * colour
    return colour


def assert_shows(pixel: ByteArray, linear: FloatArray) -> None:
    """Equal but for the dither, which is less than one step."""
    assert np.abs(pixel[:3] - 255 * srgb_from_linear(linear)).max() <= 1.001
    assert pixel[3] == 255


MIDDLE = (SIZE[1] // 2, SIZE[0] // 2)


def test_two_half_transparent_squares_blend_in_depth_order_whatever_their_order() -> None:
    near, far = square(RED, 0.5, 2.0), square(BLUE, 0.5, 5.0)
    first, second = drawn(near, far), drawn(far, near)
    assert first.tobytes() == second.tobytes()
    assert_shows(first[MIDDLE], over((BLUE, 0.5), (RED, 0.5)))


def test_a_solid_square_hides_glass_behind_it_and_shows_through_glass_before_it() -> None:
    solid = square(GREEN, 1.0, 4.0)
    assert_shows(drawn(square(RED, 0.5, 6.0), solid)[MIDDLE], over((GREEN, 1.0)))
    assert_shows(drawn(square(RED, 0.5, 3.0), solid)[MIDDLE], over((GREEN, 1.0), (RED, 0.5)))


def test_many_layers_follow_the_closed_form() -> None:
    alphas = np.random.default_rng(5).uniform(0.05, 0.6, 12)
    panes = [square((0.9, 0.9, 0.9), float(alpha), 1.0 + k) for k, alpha in enumerate(alphas)]
    passing = np.prod(1 - alphas)
    order = np.random.default_rng(6).permutation(len(panes))
    picture = drawn(*[panes[k] for k in order])
    assert_shows(picture[MIDDLE], 0.9 * (1 - passing) + passing * np.array([0.5, 0.25, 0.0]))


def test_a_thousand_layers_in_one_pixel_are_composited() -> None:
    distances = 1 + np.random.default_rng(7).permutation(1000) / 50
    nearest, alpha = distances.argmin(), 0.2
    panes = [square(BLUE if k == nearest else RED, alpha, float(d)) for k, d in enumerate(distances)]
    passing = (1 - alpha) ** 999
    behind = np.array(RED) * (1 - passing) + passing * np.array([0.5, 0.25, 0.0])
    assert_shows(drawn(*panes)[MIDDLE], alpha * np.array(BLUE) + (1 - alpha) * behind)


def test_where_two_panes_pierce_each_other_each_side_has_its_own_order() -> None:
    a, b = square(RED, 0.5, 5.0), square(BLUE, 0.5, 5.0)
    slope = np.array([[0, 0, -1], [0, 0, 1], [0, 0, 1], [0, 0, -1]], np.float32)
    a, b = a.changed(points=a.points + slope), b.changed(points=b.points - slope)
    picture = drawn(a, b)
    assert_shows(picture[8, 8], over((RED, 0.5), (BLUE, 0.5)))
    assert_shows(picture[8, 15], over((BLUE, 0.5), (RED, 0.5)))


def test_a_transparent_backdrop_keeps_the_alpha_of_what_covers_it() -> None:
    picture = drawn(square(RED, 0.5, 2.0), square(RED, 0.5, 3.0), background="transparent")
    assert picture[MIDDLE][3] == round(255 * 0.75)
    assert np.abs(picture[MIDDLE][:3] - 255 * srgb_from_linear(np.array(RED))).max() <= 1.001
    assert picture[0, 0].tolist() == [0, 0, 0, 0]


def test_edges_of_glass_are_antialiased_by_the_samples_that_meet_it() -> None:
    edge = 0.75 + 0.5 * 2 / SIZE[1]  # in the middle of a pixel
    picture = drawn(square((1.0, 1.0, 1.0), 0.5, 2.0, half=edge), shifts=FOUR)
    column = int(np.floor((edge + 1.5) / 3 * SIZE[0]))
    inside = over(((1.0, 1.0, 1.0), 0.5))
    covered = sum(dx < 0 for dx, _ in FOUR) / len(FOUR)
    assert_shows(picture[8, column], covered * inside + (1 - covered) * over())


def test_a_face_is_shaded_once_in_a_pixel_however_many_samples_see_it() -> None:
    frame = frame_of(square(RED, 0.5, 2.0), square(BLUE, 0.5, 3.0), shifts=FOUR)
    stack = stacked(frame, np.ones(4, bool))
    strip = Strip(frame, 3, 9)
    asked = []

    def shader(points: SurfacePoints) -> FloatArray:
        asked.append(points)
        return np.zeros((len(points), 4), np.float32)

    made = layers(strip, stack, shader)
    (points,) = asked
    pairs = list(zip(points.pixel.tolist(), points.face.tolist(), strict=True))
    assert len(set(pairs)) == len(pairs) < len(made.colour)
    assert made.first.shape == (4, 6 * SIZE[0] + 1)
    assert made.first[0, 0] == 0 and made.first[-1, -1] == len(made.colour)
    assert (made.first[1:, 0] == made.first[:-1, -1]).all()


def test_every_fragment_gets_the_colour_of_its_own_face() -> None:
    random = np.random.default_rng(2)
    panes = [
        square(RED, 0.5, float(d), float(h), float(x))
        for d, h, x in random.uniform((1, 0.1, -1), (9, 0.9, 1), (30, 3))
    ]
    frame = frame_of(*panes, shifts=FOUR)
    stack = stacked(frame, np.ones(60, bool))
    strip = Strip(frame, 2, 14)

    def face_number(points: SurfacePoints) -> FloatArray:
        return np.repeat(points.face[:, None], 4, axis=1).astype(np.float32)

    made = layers(strip, stack, face_number)
    begin, end = 2 * SIZE[0], 14 * SIZE[0]
    expected = np.concatenate([one.face[one.first[begin] : one.first[end]] for one in stack])
    assert made.colour[:, 0].tolist() == expected.tolist()
    assert len(expected) > 1000


def test_points_lie_in_the_middle_of_the_samples_that_see_them() -> None:
    frame = frame_of(square(RED, 0.5, 2.0, half=5.0), shifts=((64, 32), (-32, 96)))
    strip = Strip(frame, 4, 5)
    seen = []

    def shader(points: SurfacePoints) -> FloatArray:
        seen.append(points)
        return np.zeros((len(points), 4), np.float32)

    layers(strip, stacked(frame, np.ones(2, bool)), shader)
    points = seen[0]
    both = np.flatnonzero(np.bincount(points.pixel - 4 * SIZE[0]) == 1)[3:6]
    for point in np.flatnonzero(np.isin(points.pixel - 4 * SIZE[0], both)):
        column = points.pixel[point] - 4 * SIZE[0]
        assert (points.x[point] - column - 0.5, points.y[point] - 4.5) == (16 / 256, 64 / 256)


def test_no_glass_no_layers() -> None:
    solid = square(GREEN, 1.0, 4.0)
    frame = frame_of(solid)
    assert drawn(solid).tobytes() == frame.drawn(lambda strip: base_colours(frame, strip.points)).tobytes()


def test_too_many_layers_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transparency, "LIMIT", 500)
    with pytest.raises(OptionError, match="more than 500 transparent samples"):
        drawn(square(RED, 0.5, 2.0), shifts=FOUR)
