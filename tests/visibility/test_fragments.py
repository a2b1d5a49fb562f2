"""Per-pixel lists: every surface, once, far to near."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest

from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.scene.camera import Camera
from eyeline.visibility import METHODS
from eyeline.visibility import fragments as room
from eyeline.visibility.fragments import Fragments, fragments

BOTH = COUNTER_CLOCKWISE | CLOCKWISE
WIDTH, HEIGHT = 40, 33


def picture_of(
    xy: npt.ArrayLike,
    depth: npt.ArrayLike,
    sides: npt.ArrayLike = BOTH,
    pieces: Sequence[int] = (),
    width: int = WIDTH,
    height: int = HEIGHT,
) -> Projected:
    """Faces of their own corners: xy (F, 3, 2) in 1/256 pixel, depth (F, 3); the last are `pieces`."""
    xy = np.asarray(xy, np.int32)
    count = len(xy)
    sides = np.atleast_1d(np.asarray(sides, np.uint8))
    return Projected(
        xy=xy.reshape(-1, 2),
        depth=np.asarray(depth, np.float32).reshape(-1),
        faces=np.arange(3 * count, dtype=np.int32).reshape(count, 3),
        sides=sides,
        face_count=count - len(pieces),
        piece_source=np.asarray(pieces, np.int32),
        first_faces=np.array([0, count - len(pieces)]),
        surfaces=(),
        camera=Camera(fov=1.0, near=0.1),
        width=width,
        height=height,
    )


def soup(
    seed: int, count: int = 300, reach: float = 12.0, coarse: bool = False, sides: npt.ArrayLike = BOTH
) -> Projected:
    random = np.random.default_rng(seed)
    middle = random.uniform(-5, (WIDTH + 5, HEIGHT + 5), (count, 1, 2))
    xy = (middle + random.uniform(-1, 1, (count, 3, 2)) * reach) * 256
    if coarse:  # corners on pixels' corners and centres, so that every tie rule is used
        xy = np.round(xy / 128) * 128
    depth = random.uniform(-0.1, 1, (count, 3))
    if coarse:
        depth = np.round(depth[:, :1] * 4) / 4 * np.ones(3)
    return picture_of(np.round(xy), depth, sides)


def brute_force(projected: Projected, behind: FloatArray) -> list[list[tuple[float, int]]]:
    """The sorted list of every pixel, one face and one pixel at a time, in whole numbers."""
    lists: list[list[tuple[float, int]]] = [[] for _ in range(projected.width * projected.height)]
    sides = np.broadcast_to(projected.sides, len(projected.faces))
    rows, columns = np.mgrid[: projected.height, : projected.width]
    for face, corners in enumerate(projected.faces):
        p = projected.xy[corners].astype(np.int64)
        z = projected.depth[corners].astype(np.float64)
        area = (p[1, 0] - p[0, 0]) * (p[2, 1] - p[0, 1]) - (p[2, 0] - p[0, 0]) * (p[1, 1] - p[0, 1])
        if area == 0 or not sides[face] & (COUNTER_CLOCKWISE if area < 0 else CLOCKWISE):
            continue
        if area < 0:
            p, z = p[[0, 2, 1]], z[[0, 2, 1]]
        inside = np.ones(rows.shape, bool)
        for (ax, ay), (bx, by) in ((p[0], p[1]), (p[1], p[2]), (p[2], p[0])):
            a, b = ay - by, bx - ax
            edge = a * (columns * 256 + 128 - ax) + b * (rows * 256 + 128 - ay)
            inside &= (edge > 0) | ((edge == 0) & (a > 0 or (a == 0 and b > 0)))
        first = int(np.lexsort((p[:, 0], p[:, 1]))[0])
        p, z = np.roll(p, -first, axis=0), np.roll(z, -first)
        # Depth is the plane through the corners, in the order of operations all methods share
        u, v = (p[1] - p[0]).astype(float), (p[2] - p[0]).astype(float)
        scale = 256.0 / (u[0] * v[1] - v[0] * u[1])
        along_x = ((z[1] - z[0]) * v[1] - (z[2] - z[0]) * u[1]) * scale
        along_y = ((z[2] - z[0]) * u[0] - (z[1] - z[0]) * v[0]) * scale
        start = z[0] - along_x * (float(p[0, 0] - 128) / 256.0) - along_y * (float(p[0, 1] - 128) / 256.0)
        depth = ((start + along_y * rows) + along_x * columns).astype(np.float32)
        source = int(projected.source[face])
        for pixel in np.flatnonzero(inside & (depth > behind) & (depth > 0)):
            lists[pixel].append((float(depth.flat[pixel]), source))
    return [sorted(one, key=lambda pair: (pair[0], -pair[1])) for one in lists]


def lists_of(found: Fragments) -> list[list[tuple[float, int]]]:
    pairs = list(zip(found.depth.tolist(), found.face.tolist(), strict=True))
    return [pairs[a:b] for a, b in zip(found.first[:-1], found.first[1:], strict=True)]


def nothing(projected: Projected) -> FloatArray:
    return np.zeros((projected.height, projected.width), np.float32)


@pytest.mark.parametrize("sides", [BOTH, COUNTER_CLOCKWISE, CLOCKWISE])
@pytest.mark.parametrize("coarse", [False, True])
@pytest.mark.parametrize("reach", [1.0, 12.0, 4000.0])
def test_lists_equal_brute_force(reach: float, coarse: bool, sides: int) -> None:
    projected = soup(7, 150, reach, coarse, sides)
    behind = np.random.default_rng(3).uniform(0, 0.3, (HEIGHT, WIDTH)).astype(np.float32)
    assert lists_of(fragments(projected, behind)) == brute_force(projected, behind)


def test_a_face_at_the_opaque_depth_is_hidden() -> None:
    projected = picture_of([[(0, 0), (0, 9000), (9000, 0)]], [[0.5, 0.5, 0.5]])
    assert len(fragments(projected, np.full((HEIGHT, WIDTH), 0.5, np.float32))) == 0
    assert (
        len(fragments(projected, np.full((HEIGHT, WIDTH), np.nextafter(np.float32(0.5), np.float32(0))))) > 0
    )


def test_each_side_of_a_face_can_be_left_out_on_its_own() -> None:
    projected = soup(1, 40)
    sides = np.random.default_rng(2).integers(0, 4, 40).astype(np.uint8)
    some = picture_of(projected.xy.reshape(-1, 3, 2), projected.depth.reshape(-1, 3), sides)
    assert lists_of(fragments(some, nothing(some))) == brute_force(some, nothing(some))


def test_pieces_are_named_after_the_face_they_were_cut_from() -> None:
    projected = soup(5, 30)
    cut = picture_of(
        projected.xy.reshape(-1, 3, 2),
        projected.depth.reshape(-1, 3),
        [0] * 10 + [BOTH] * 20,
        pieces=[4] * 10 + [9] * 10,
    )
    found = fragments(cut, nothing(cut))
    assert set(found.face) == {4, 9}
    assert lists_of(found) == brute_force(cut, nothing(cut))


def test_a_thousand_layers_in_one_pixel_are_sorted() -> None:
    random = np.random.default_rng(11)
    depth = random.permutation(np.repeat(np.linspace(0.1, 0.9, 250), 4)).astype(np.float32)
    everywhere = np.tile(np.array([(-9000, -9000), (-9000, 30000), (30000, -9000)]), (1000, 1, 1))
    projected = picture_of(everywhere, np.repeat(depth[:, None], 3, axis=1), width=3, height=2)
    found = fragments(projected, nothing(projected))
    assert np.diff(found.first).tolist() == [1000] * 6
    assert lists_of(found) == brute_force(projected, nothing(projected))


def test_the_order_of_faces_shows_in_their_numbers_only() -> None:
    projected = soup(21)
    order = np.random.default_rng(4).permutation(len(projected.faces))
    shuffled = picture_of(projected.xy.reshape(-1, 3, 2)[order], projected.depth.reshape(-1, 3)[order])
    first, second = fragments(projected, nothing(projected)), fragments(shuffled, nothing(projected))
    assert first.depth.tobytes() == second.depth.tobytes()
    assert first.face.tobytes() == order[second.face].astype(np.int32).tobytes()


def test_the_number_of_threads_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    projected = soup(8)
    answers = []
    for count in (1, 2, 5):
        monkeypatch.setattr(room, "threads", lambda count=count: count)
        found = fragments(projected, nothing(projected))
        answers.append((found.first.tobytes(), found.face.tobytes(), found.depth.tobytes()))
    assert answers[0] == answers[1] == answers[2]


def test_wanted_fragments_keep_their_order() -> None:
    projected = soup(13)
    found = fragments(projected, nothing(projected))
    even = found.only(found.face % 2 == 0)
    assert lists_of(even) == [[pair for pair in one if pair[1] % 2 == 0] for one in lists_of(found)]
    assert even.pixel.tolist() == [p for p, one in enumerate(lists_of(even)) for _ in one]


def test_nearest_is_the_last_of_each_list() -> None:
    projected = soup(14, 60)
    face, depth = fragments(projected, nothing(projected)).nearest()
    for pixel, one in enumerate(brute_force(projected, nothing(projected))):
        assert (float(depth.flat[pixel]), int(face.flat[pixel])) == (one[-1] if one else (0.0, -1))


@pytest.mark.parametrize("coarse", [False, True])
@pytest.mark.parametrize("reach", [2.0, 12.0, 4000.0])
@pytest.mark.parametrize("seed", range(3))
def test_nearest_fragment_is_what_the_depth_buffer_sees(seed: int, reach: float, coarse: bool) -> None:
    projected = soup(seed, 400, reach, coarse)
    visible = METHODS["zbuffer"](projected)
    face, depth = fragments(projected, nothing(projected)).nearest()
    assert face.tobytes() == np.where(visible.depth > 0, visible.face, -1).astype(np.int32).tobytes()
    assert depth.tobytes() == np.maximum(visible.depth, 0).tobytes()


def test_too_many_layers_are_refused_before_memory_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "LIMIT", 100)
    projected = soup(3)
    with pytest.raises(OptionError, match=r"\d+ transparent samples .* at most 100"):
        fragments(projected, nothing(projected))


def test_no_face_no_fragment() -> None:
    projected = picture_of(np.zeros((0, 3, 2)), np.zeros((0, 3)))
    found = fragments(projected, nothing(projected))
    assert len(found) == 0 and found.first.tolist() == [0] * (WIDTH * HEIGHT + 1)
