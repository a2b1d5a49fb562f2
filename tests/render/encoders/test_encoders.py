"""What every encoder promises, decoded again."""

from __future__ import annotations

from pathlib import Path

import av
import numpy as np
import PIL.Image
import pytest

from eyeline.errors import FileError
from eyeline.render.encoders import ENCODERS, encoder_for
from eyeline.render.encoders.encoder import Job

# Half of what chroma at half resolution and a quantiser may change in a flat patch.
TOLERANCE = 4
PATCHES = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255), (0, 0, 0), (128, 128, 128), (200, 90, 40)]
PATCH = 32

FILMS = [suffix for suffix in ENCODERS if suffix]


def frame(number: int, size: tuple[int, int] = (PATCH * len(PATCHES), 2 * PATCH)) -> np.ndarray:
    """Flat patches above; below, a white bar that moves with the frame number."""
    width, height = size
    pixels = np.zeros((height, width, 4), np.uint8)
    pixels[..., 3] = 255
    for index, color in enumerate(PATCHES):
        pixels[:PATCH, index * PATCH : (index + 1) * PATCH, :3] = color
    pixels[PATCH:, 4 * number : 4 * number + 8, :3] = 255
    return pixels


def written(path: Path, job: Job) -> Path:
    with encoder_for(path)(path, job) as sink:
        for number in sink.wanted:
            sink.write(number, frame(number, job.size))
    return path


def decoded(path: Path, job: Job) -> list[np.ndarray]:
    """(H, W, 3) uint8 of every frame."""
    if path.is_dir():
        return [np.asarray(PIL.Image.open(one).convert("RGB")) for one in sorted(path.glob("*.png"))]
    if path.suffix == ".webp":
        with PIL.Image.open(path) as picture:
            frames = []
            for number in range(picture.n_frames):  # type: ignore[attr-defined]
                picture.seek(number)
                frames.append(np.asarray(picture.convert("RGB")))
            return frames
    with av.open(str(path)) as container:
        space = {} if path.suffix == ".gif" else {"src_colorspace": "ITU709"}
        return [
            one.reformat(format="rgb24", **space).to_ndarray()[: job.size[1], : job.size[0]]
            for one in container.decode(video=0)
        ]


@pytest.mark.parametrize("suffix", ENCODERS)
def test_every_frame_comes_back_with_its_colours(tmp_path: Path, suffix: str) -> None:
    job = Job((PATCH * len(PATCHES), 2 * PATCH), 24, 13)
    frames = decoded(written(tmp_path / f"film{suffix}", job), job)
    assert len(frames) == 13
    for number, shown in enumerate(frames):
        for index, color in enumerate(PATCHES):
            middle = (
                shown[8 : PATCH - 8, index * PATCH + 8 : (index + 1) * PATCH - 8].reshape(-1, 3).mean(axis=0)
            )
            assert np.abs(middle - color).max() <= TOLERANCE, (number, color, middle)
        bar = shown[PATCH + 4 : 2 * PATCH - 4].astype(float).mean(axis=(0, 2))
        assert abs((bar * np.arange(len(bar))).sum() / bar.sum() - (4 * number + 3.5)) < 1


@pytest.mark.parametrize("suffix", FILMS)
def test_nothing_remains_of_a_film_that_fails(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"film{suffix}"
    job = Job((32, 32), 24, 9)
    with pytest.raises(KeyboardInterrupt), encoder_for(path)(path, job) as sink:
        sink.write(0, frame(0, job.size))
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [".mp4", ".webm"])
@pytest.mark.parametrize("size", [(33, 32), (32, 33), (1, 1)])
def test_odd_sides_grow_by_one_and_say_so(tmp_path: Path, suffix: str, size: tuple[int, int]) -> None:
    job = Job(size, 24, 2)
    path = tmp_path / f"film{suffix}"
    assert len(encoder_for(path).notes(job)) == 1
    with encoder_for(path)(path, job) as sink:
        for number in sink.wanted:
            sink.write(number, np.full((size[1], size[0], 4), 255, np.uint8))
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        assert (stream.width, stream.height) == (size[0] + size[0] % 2, size[1] + size[1] % 2)


@pytest.mark.parametrize("fps", [24, 23.976, 29.97, 12.5, 0.5, 60])
def test_mp4_keeps_the_frame_rate(tmp_path: Path, fps: float) -> None:
    path = written(tmp_path / "film.mp4", Job((32, 32), fps, 6))
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        assert float(stream.average_rate) == pytest.approx(fps, rel=1e-4)  # type: ignore[arg-type]
        times = [one.time for one in container.decode(stream)]
    assert times == pytest.approx([number / fps for number in range(6)], abs=2e-3)


def test_mp4_says_how_its_colours_are_meant(tmp_path: Path) -> None:
    path = written(tmp_path / "film.mp4", Job((32, 32), 24, 2))
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        context = stream.codec_context
        assert (context.codec.name, context.pix_fmt) == ("h264", "yuv420p")
        assert (context.color_primaries, context.color_trc, context.colorspace, context.color_range) == (
            1,
            1,
            1,
            1,
        )


def test_mp4_begins_with_its_index(tmp_path: Path) -> None:
    content = written(tmp_path / "film.mp4", Job((32, 32), 24, 9)).read_bytes()
    assert content.index(b"moov") < content.index(b"mdat")


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_moving_pictures_loop_for_ever_at_their_speed(tmp_path: Path, suffix: str) -> None:
    path = written(tmp_path / f"film{suffix}", Job((64, 64), 24, 12))
    with PIL.Image.open(path) as picture:
        assert picture.info["loop"] == 0
        told = []
        for number in range(picture.n_frames):  # type: ignore[attr-defined]
            picture.seek(number)
            picture.load()
            told.append(picture.info["duration"])
    assert sum(told) == pytest.approx(500, abs=25)


def test_webp_keeps_transparency(tmp_path: Path) -> None:
    path, job = tmp_path / "film.webp", Job((16, 16), 24, 2)
    pixels = np.zeros((16, 16, 4), np.uint8)
    pixels[:8] = (200, 30, 30, 255)
    with encoder_for(path)(path, job) as sink:
        sink.write(0, pixels)
        sink.write(1, pixels[::-1].copy())
    with PIL.Image.open(path) as picture:
        alpha = np.asarray(picture.convert("RGBA"))[..., 3]
    assert (alpha[:8] == 255).all() and (alpha[8:] == 0).all()


def test_gif_says_when_viewers_cannot_follow() -> None:
    assert encoder_for(Path("a.gif")).notes(Job((8, 8), 60, 2)) != ()
    assert encoder_for(Path("a.gif")).notes(Job((8, 8), 24, 2)) == ()


@pytest.mark.parametrize("name", ["film.avi", "film.mp3", "film.png"])
def test_other_suffixes_are_refused(name: str) -> None:
    with pytest.raises(FileError, match=r"is no film; use \.mp4.* and \.png, .* for one picture"):
        encoder_for(Path(name))
