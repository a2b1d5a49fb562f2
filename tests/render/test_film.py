from __future__ import annotations

import base64
import math
import re
import resource
from dataclasses import replace
from pathlib import Path

import av
import numpy as np
import pytest

import eyeline as el
from eyeline.errors import EyelineError, OptionError, SceneError

SMALL = {"size": (64, 48), "samples": 1, "style": "flat"}


def red(pixels: np.ndarray) -> np.ndarray:
    """Where the sliding square is seen: (H, W) bool; the backdrop is grey."""
    color = pixels.astype(int)
    return np.abs(color[..., 0] - color[..., 2]) + np.abs(color[..., 0] - color[..., 1]) > 40


def test_frames_stand_at_even_steps_of_the_clip(sliding: el.Scene) -> None:
    film = el.film(sliding, fps=8, **SMALL)
    assert len(film) == 8
    assert film.times == pytest.approx(np.arange(8) / 8)
    assert el.film(sliding, fps=8, start=0.5, **SMALL).times == pytest.approx([0.5, 0.625, 0.75, 0.875])
    assert len(el.film(sliding, fps=10, start=0.25, end=3.25, **SMALL)) == 30
    assert len(el.film(sliding, fps=24, end=0, **SMALL)) == 1


def test_frames_are_the_same_in_any_order_and_again(sliding: el.Scene) -> None:
    film = el.film(sliding, fps=4, size=(64, 48), samples=2)
    forward = [image.pixels for image in film]
    for number in (3, 0, 2, 1):
        assert np.array_equal(film[number].pixels, forward[number])
    assert np.array_equal(film[-1].pixels, forward[3])
    assert len({frame.tobytes() for frame in forward}) == 4


def test_a_frame_is_the_still_of_its_time(sliding: el.Scene) -> None:
    camera = el.Camera.look_at((1, 0.5, 4), (1, 0.5, 0))
    film = el.film(sliding, fps=4, camera=camera, **SMALL)
    still = el.render(sliding, camera, time=0.75, **SMALL)
    assert np.array_equal(film[3].pixels, still.pixels)


def test_without_a_camera_the_view_holds_still_and_holds_everything(sliding: el.Scene) -> None:
    columns = [np.flatnonzero(red(image.pixels).any(axis=0)) for image in el.film(sliding, fps=4, **SMALL)]
    middles = [column.mean() for column in columns]
    assert np.diff(middles).min() > 2
    assert all(column[0] > 0 and column[-1] < 63 for column in columns)


def test_a_camera_of_the_scene_moves_with_its_node(sliding: el.Scene) -> None:
    riding = el.Node(name="eye", parent=0, camera=el.Camera(fov=0.8), translation=(0.5, 0.5, 3))
    film = el.film(replace(sliding, nodes=(*sliding.nodes, riding)), fps=2, **SMALL)
    assert np.array_equal(red(film[0].pixels), red(film[1].pixels))
    assert red(film[0].pixels).any()


def test_the_floor_stays_where_the_scene_is_lowest(falling: el.Scene) -> None:
    film = el.film(falling, fps=4, **SMALL)
    assert film._steady_shot.look.ground_height == pytest.approx(-0.75)
    assert el.film(falling, ground_height=-3, **SMALL)._steady_shot.look.ground_height == -3


def test_a_turntable_goes_around_once(sliding: el.Scene) -> None:
    still = replace(sliding, clips=())
    film = el.film(still, fps=4, turntable=2, **SMALL)
    assert len(film) == 8
    assert np.array_equal(film[0].pixels, el.render(still, **SMALL).pixels)
    eyes = [film._camera(still, time).world_from_eye[:3, 3] - still.bounds.centre for time in film.times]
    angles = np.unwrap([math.atan2(eye[0], eye[2]) for eye in eyes])
    assert np.diff(angles) == pytest.approx([math.tau / 8] * 7)


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"fps": 0}, "fps is 0"),
        ({"fps": math.nan}, "fps is nan"),
        ({"fps": 1e9}, "fps is 1e"),
        ({"start": 2, "end": 1}, "from 2 to 1"),
        ({"end": math.inf}, "to inf"),
        ({"end": 1e9}, "more than 10000000 frames"),
        ({"turntable": 0}, "turntable is 0"),
        ({"samples": 3}, "samples is 3"),
        ({"camera": "front"}, "no camera 'front'"),
        ({"clip": "walk"}, "no clip 'walk'; there is 'slide'"),
        ({"stile": "id"}, "no option 'stile'"),
        ({"cull": "front"}, "'front'"),
        ({"size": (0, 4)}, "0"),
    ],
)
def test_a_film_that_cannot_be_is_refused_before_its_first_frame(
    sliding: el.Scene, options: dict[str, object], word: str
) -> None:
    with pytest.raises(EyelineError, match=re.escape(word)):
        el.film(sliding, **options)


def test_a_scene_that_stands_still_needs_an_end(sliding: el.Scene) -> None:
    with pytest.raises(SceneError, match="turntable"):
        el.film(replace(sliding, clips=()))


def test_there_is_no_frame_beyond_the_last(sliding: el.Scene) -> None:
    film = el.film(sliding, fps=4, **SMALL)
    with pytest.raises(IndexError, match="the film has 4"):
        film[4]


def test_a_saved_film_holds_the_frames(sliding: el.Scene, tmp_path: Path) -> None:
    film = el.film(sliding, fps=6, **SMALL)
    told: list[tuple[int, int]] = []
    path = film.save(tmp_path / "film.mp4", progress=lambda done, total: told.append((done, total)))
    with av.open(str(path)) as container:
        frames = [one.to_ndarray(format="rgb24") for one in container.decode(video=0)]
    assert len(frames) == 6
    for shown, image in zip(frames, film, strict=True):
        assert (red(shown) == red(image.pixels)).mean() > 0.97
    assert told == [(done, 6) for done in range(7)]


@pytest.mark.parametrize("suffix", [".mp4", ".webm", ".gif", ".webp"])
def test_nothing_remains_of_a_film_whose_frames_fail(sliding: el.Scene, tmp_path: Path, suffix: str) -> None:
    def stop(done: int, _: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        el.film(sliding, fps=8, **SMALL).save(tmp_path / f"film{suffix}", progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_frames_are_resumed_where_a_run_was_broken_off(sliding: el.Scene, tmp_path: Path) -> None:
    def stop(done: int, _: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    film, told = el.film(sliding, fps=8, **SMALL), []
    film.save(tmp_path / "whole")
    with pytest.raises(KeyboardInterrupt):
        film.save(tmp_path / "broken", progress=stop)
    left = len(list((tmp_path / "broken").glob("*.png")))
    assert 0 < left < 8
    film.save(tmp_path / "broken", resume=True, progress=lambda done, _: told.append(done))
    assert told == list(range(left, 9))
    for path in (tmp_path / "whole").iterdir():
        assert path.read_bytes() == (tmp_path / "broken" / path.name).read_bytes()


def test_another_film_is_not_resumed(sliding: el.Scene, tmp_path: Path) -> None:
    el.film(sliding, fps=8, **SMALL).save(tmp_path / "frames")
    with pytest.raises(EyelineError, match="start anew without resuming"):
        el.film(sliding, fps=8, exposure=1, **SMALL).save(tmp_path / "frames", resume=True)


def test_a_video_cannot_be_resumed(sliding: el.Scene, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="a folder of frames"):
        el.film(sliding, fps=8, **SMALL).save(tmp_path / "film.mp4", resume=True)


@pytest.mark.parametrize("suffix", [".mp4", ".gif", ".webp"])
def test_a_longer_film_takes_no_more_memory(sliding: el.Scene, tmp_path: Path, suffix: str) -> None:
    def peak(seconds: float) -> int:
        film = el.film(sliding, fps=50, end=seconds, size=(320, 180), samples=1, style="flat")
        film.save(tmp_path / f"film{suffix}")
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024

    frame, short, long = 320 * 180 * 4, peak(1), peak(6)
    assert long - short < 50 * frame, "250 more frames must not be held"


def test_a_notebook_gets_a_player_with_the_film_inside(sliding: el.Scene, tmp_path: Path) -> None:
    page = el.film(sliding, fps=4, **SMALL)._repr_html_()
    found = re.search(r'<video controls[^>]* src="data:video/mp4;base64,([^"]+)"', page)
    assert found
    (tmp_path / "film.mp4").write_bytes(base64.b64decode(found[1]))
    with av.open(str(tmp_path / "film.mp4")) as container:
        assert len(list(container.decode(video=0))) == 4
    assert "64×48, 4 fps, 4 frames" in page


def test_a_player_of_a_long_and_large_film_stays_small(sliding: el.Scene) -> None:
    page = el.film(sliding, fps=200, end=60, size=(1920, 1080), samples=1, style="flat")
    from eyeline.render import player

    shown = player.excerpt(page)
    assert (len(shown), shown.shot.size) == (player.MOST_FRAMES, (960, 540))
