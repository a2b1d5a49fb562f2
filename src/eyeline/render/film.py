"""A film: pictures of a scene at even steps of time, made one by one when they are asked for."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import OptionError, SceneError
from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.geometry.bounds import Bounds
from eyeline.render.frame import picture
from eyeline.render.overlap import overlapped
from eyeline.render.shot import Shot, shot_of
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import chosen_camera, orbited

if TYPE_CHECKING:
    from eyeline.render.encoders.encoder import Job
    from eyeline.render.image import Image
    from eyeline.scene.camera import Camera
    from eyeline.scene.scene import Scene

Progress = Callable[[int, int], None]  # frames done, frames in all

MOST_FRAMES = 10_000_000
FRAMING_POSES = 49  # at how many frames a film looks where the scene moves, to frame all of it


def film(
    scene: Staged,
    fps: float = 24,
    start: float | None = None,
    end: float | None = None,
    *,
    turntable: float | None = None,
    **options: Any,
) -> Film:
    """The film of a scene from `start` to `end`, seconds: the whole clip if left out.

    turntable: seconds in which the camera goes once around the scene, also the film's length if `end` is left
    out. options: those of `render`, but the time.
    """
    shot, scene = shot_of(**options), staged(scene)
    clip = scene.clip(shot.clip)
    begin = 0.0 if start is None else float(start)
    turn = None if turntable is None else float(turntable)
    if end is not None:
        stop = float(end)
    elif turn is not None:
        stop = begin + turn
    elif clip is not None:
        stop = clip.duration
    else:
        raise SceneError(
            "the scene has no clip, so a film of it needs an end, or a turntable (--turntable SECONDS)"
        )
    return Film(scene, float(fps), begin, stop, turn, shot)


@dataclass(frozen=True, eq=False)
class Film:
    """Pictures at start, start + 1/fps, ... before end; each follows from the scene and its time alone."""

    scene: Scene
    fps: float
    start: float  # seconds
    end: float  # seconds; a film of a clip that loops shows its last moment as its first
    turntable: float | None  # seconds a turn
    shot: Shot

    def __post_init__(self) -> None:
        """Refuse films of nothing, and of everything."""
        if not 0 < self.fps <= 1000:
            raise OptionError(f"fps is {self.fps:g}; more than 0 and at most 1000 frames a second are needed")
        if self.turntable is not None and not 0 < self.turntable < math.inf:
            raise OptionError(f"turntable is {self.turntable:g} seconds; more than 0 is needed")
        if not (math.isfinite(self.start) and math.isfinite(self.end) and self.start <= self.end):
            raise OptionError(
                f"a film from {self.start:g} to {self.end:g} seconds cannot be; start must come first"
            )
        if (self.end - self.start) * self.fps > MOST_FRAMES:
            raise OptionError(
                f"{self.end - self.start:g} seconds at {self.fps:g} fps are more than {MOST_FRAMES} frames"
            )
        self._steady_camera  # noqa: B018  refuses an unknown camera before long work begins

    def __len__(self) -> int:
        return max(1, round((self.end - self.start) * self.fps))

    def __getitem__(self, number: int) -> Image:
        if not -len(self) <= number < len(self):
            raise IndexError(f"there is no frame {number}; the film has {len(self)}")
        time = self.times[number]
        posed = self.scene.at(float(time), self.shot.clip)
        return picture(posed, self._camera(posed, float(time)), self._steady_shot)

    def __iter__(self) -> Iterator[Image]:
        return (self[number] for number in range(len(self)))

    @cached_property
    def times(self) -> FloatArray:
        """(T,) seconds: when each frame is taken."""
        return self.start + np.arange(len(self)) / self.fps

    def save(self, path: str | Path, *, resume: bool = False, progress: Progress | None = None) -> Path:
        """Write .mp4, .webm, .gif or animated .webp, or a folder of PNG frames if there is no suffix.

        A file appears whole or not at all. A folder keeps its frames when a run is killed; resume=True
        continues it where the frames are whole and of the same film, and refuses others.
        """
        from eyeline.render.encoders import encoder_for

        path = Path(path)
        encoder = encoder_for(path)
        if resume and not encoder.resumes:
            raise OptionError(f"{path}: {encoder.name} films cannot be resumed; write a folder of frames")
        with encoder(path, self.job(encoder.resumes), resume) as sink:
            done = len(self) - len(sink.wanted)

            def made() -> Iterator[tuple[int, ByteArray]]:
                for count, number in enumerate(sink.wanted, done + 1):
                    yield number, self[number].pixels
                    if progress:
                        progress(count, len(self))

            if progress:
                progress(done, len(self))
            overlapped(made(), lambda item: sink.write(*item))
        return path

    def job(self, fingerprinted: bool = False) -> Job:
        """What an encoder must know; with everything the pictures follow from, hashed, if asked."""
        from eyeline.render.encoders.encoder import Job
        from eyeline.render.fingerprint import fingerprint

        told = (self.scene, self.fps, self.start, self.end, self.turntable, self.shot)
        return Job(self.shot.size, self.fps, len(self), fingerprint(told) if fingerprinted else "")

    def _repr_html_(self) -> str:
        from eyeline.render.player import player

        return player(self)

    # --- what holds still -------------------------------------------------------------------------------

    def _camera(self, posed: Scene, time: float) -> Camera:
        camera = self._steady_camera or chosen_camera(posed, self.shot.camera, self._aspect)
        if self.turntable is None:
            return camera
        return orbited(camera, self._bounds, 2 * math.pi * (time - self.start) / self.turntable)

    @cached_property
    def _steady_camera(self) -> Camera | None:
        """The camera of all frames; None where it stands in the scene and may move with it."""
        if self.scene.cameras:
            chosen_camera(self.scene, self.shot.camera, self._aspect)
            return None
        return chosen_camera(self.scene, self.shot.camera, self._aspect, self._bounds)

    @cached_property
    def _steady_shot(self) -> Shot:
        """The shot with the studio floor where the scene is lowest in the whole film."""
        look = self.shot.look
        if look.ground == "off" or look.ground_height is not None or self._bounds.is_empty:
            return self.shot
        return replace(self.shot, look=replace(look, ground_height=float(self._bounds.low[1])))

    @cached_property
    def _bounds(self) -> Bounds:
        """The box around the scene over the whole film, so that its frame does not move with it."""
        bounds = Bounds.empty()
        for number in np.unique(np.linspace(0, len(self) - 1, FRAMING_POSES).round().astype(int)):
            bounds = bounds.union(self.scene.at(float(self.times[number]), self.shot.clip).bounds)
        return bounds

    @property
    def _aspect(self) -> float:
        return self.shot.size[0] / self.shot.size[1]
