"""`compare`: every method on one scene, side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from eyeline.comparison.agreement import Agreement, Judge, judge_of
from eyeline.comparison.ladder import Ladder, ladder_of_faces, ladder_of_pixels
from eyeline.comparison.trial import Trial, tried
from eyeline.errors import FileError, OptionError, suggestion
from eyeline.jit import threads
from eyeline.projection import project
from eyeline.projection.project import checked_size
from eyeline.projection.projected import Projected
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import CameraChoice, chosen_camera
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, visible_of
from eyeline.visibility.method import Visible

SIZE = (1280, 720)


def compare(
    scene: Staged,
    methods: Sequence[str] | None = None,
    camera: CameraChoice = None,
    size: tuple[int, int] = SIZE,
    time: float = 0.0,
    *,
    clip: str | int | None = None,
    cull: str = "auto",
    ladder: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Comparison:
    """Time, memory, counted work and agreement of methods on a scene at a time (seconds).

    methods: names in METHODS; all if left out. ladder: also how each grows with faces and with pixels, on the
    scene with its faces cut in four again and again, and in larger pictures; takes some minutes.
    """
    names = list(METHODS if methods is None else methods)
    for name in names:
        if name not in METHODS:
            raise OptionError(f"there is no method {name!r}{suggestion(name, METHODS)}")
    width, height = checked_size(size)
    posed = staged(scene).at(time, clip)
    view = chosen_camera(posed, camera, width / height).fitted(posed.bounds)
    projected = project(posed, view, (width, height), cull)
    steps = len(names) + 2 * ladder
    trials = []
    for done, name in enumerate(names):
        trials.append(tried(METHODS[name], projected))
        if progress:
            progress(done + 1, steps)
    judge = judge_of(posed, projected, cull, visible_of(projected))
    ladders: list[Ladder] = []
    if ladder:
        answering = [trial.method for trial in trials if not trial.refusal]
        for climb in (ladder_of_faces, ladder_of_pixels):
            ladders.append(climb(posed, view, (width, height), cull, answering))
            if progress:
                progress(len(names) + len(ladders), steps)
    return Comparison(posed, projected, tuple(trials), judge, tuple(ladders))


@dataclass(frozen=True, eq=False)
class Comparison:
    """What every method did on one scene."""

    scene: Scene
    projected: Projected
    trials: tuple[Trial, ...]
    judge: Judge
    ladders: tuple[Ladder, ...] = ()
    agreements: Mapping[str, Agreement] = field(init=False)  # of methods that answer every pixel

    def __post_init__(self) -> None:
        """Judge every answer."""
        answers = {trial.name: trial.answer for trial in self.trials if isinstance(trial.answer, Visible)}
        agreements = {name: self.judge.of(answer) for name, answer in answers.items()}
        object.__setattr__(self, "agreements", agreements)

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the picture, pixels."""
        return self.projected.width, self.projected.height

    @property
    def title(self) -> str:
        """What was compared, in a line."""
        name = self.scene.name or "scene"
        width, height = self.size
        count = threads()
        on = f"{count} thread{'s' * (count != 1)}"
        return f"{name}: {self.scene.face_count:,} faces, {width}x{height} pixels, {on}"

    def data(self) -> dict[str, Any]:
        """Everything, as plain data."""
        rows = []
        for trial in self.trials:
            row: dict[str, Any] = {"method": trial.name, "space": trial.method.space}
            if trial.refusal:
                rows.append(row | {"refusal": trial.refusal})
                continue
            row |= {"seconds": trial.again, "first_seconds": trial.first, "peak_bytes": trial.memory}
            row["work"] = dict(trial.work)
            if agreement := self.agreements.get(trial.name):
                row["different_pixels"] = int(agreement.different.sum())
                row["wrong_pixels"] = int(agreement.wrong.sum())
            rows.append(row)
        return {
            "scene": self.scene.name,
            "faces": self.scene.face_count,
            "size": list(self.size),
            "threads": threads(),
            "judge": self.judge.name,
            "decidable_share": self.judge.share,
            "methods": rows,
            "ladders": [one.data() for one in self.ladders],
        }  # fmt: skip

    def save(self, path: str | Path) -> Path:
        """Write a sheet (.png), a page (.html) or data (.json); the file appears whole or not at all."""
        path = Path(path)
        suffix = path.suffix.lower()
        if suffix not in WRITERS:
            raise FileError(f"{path}: {suffix or 'no suffix'} is no comparison; use {', '.join(WRITERS)}")
        WRITERS[suffix](self, path)
        return path

    def _repr_html_(self) -> str:
        from eyeline.comparison.page import body

        return body(self)


def write_sheet(comparison: Comparison, path: Path) -> None:
    """One picture of everything."""
    from eyeline.comparison.sheet import sheet

    sheet(comparison).save(path)


def write_page(comparison: Comparison, path: Path) -> None:
    """A page that needs nothing beside it."""
    from eyeline.comparison.page import page
    from eyeline.files.whole import whole_file

    with whole_file(path) as unfinished:
        unfinished.write_text(page(comparison), encoding="utf-8")


def write_data(comparison: Comparison, path: Path) -> None:
    """For programs."""
    import json

    from eyeline.files.whole import whole_file

    with whole_file(path) as unfinished:
        unfinished.write_text(json.dumps(comparison.data(), indent=1) + "\n", encoding="utf-8")


WRITERS: dict[str, Callable[[Comparison, Path], None]] = {
    ".png": write_sheet,
    ".html": write_page,
    ".json": write_data,
}
