"""Steps become frames: what is drawn on the picture so far, what is marked on it now, and what is said."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.geometry.arrays import IntArray
from eyeline.geometry.fixedpoint import UNITS
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step

Points = list[tuple[float, float]]


class Mark(NamedTuple):
    """Something to draw over the picture."""

    shape: str  # "polygon" closed, "line" open, or "dots"
    role: str  # what it means: "subject", "rival", "kept", "dropped", "split", "area", or "hidden"
    points: Points  # pixels


@dataclass(frozen=True)
class Frame:
    """One step, or a few that are shown together."""

    number: int  # of the last step shown, from 1
    kind: str
    sentence: str
    work: Mapping[str, int]
    marks: tuple[Mark, ...]
    ink: tuple[Mark, ...]  # marks that stay from here on
    painted: tuple[tuple[int, Sequence[tuple[int, int]]], ...]  # (face, its new pixels (x, y)), in order


@dataclass(frozen=True, eq=False)
class Outlines:
    """Where the faces of a picture are drawn."""

    projected: Projected

    @cached_property
    def _of_source(self) -> dict[int, list[int]]:
        sides = np.broadcast_to(self.projected.sides, len(self.projected.faces))
        rows: dict[int, list[int]] = {}
        for number in np.flatnonzero(sides):
            rows.setdefault(int(self.projected.source[number]), []).append(int(number))
        return rows

    def of(self, face: int) -> list[Points]:
        """The corners of a scene face, or of its pieces, pixels."""
        return [
            points_of(self.projected.xy[self.projected.faces[number]] / UNITS)
            for number in self._of_source.get(face, ())
        ]


def points_of(corners: npt.ArrayLike) -> Points:
    """(N, 2) as pairs, to a hundredth of a pixel."""
    return [(round(float(x), 2), round(float(y), 2)) for x, y in np.asarray(corners, dtype=np.float64)]


def frames_of(steps: Sequence[Step], projected: Projected, most: int) -> Iterator[Frame]:
    """At most `most` frames of all steps; where there are more steps, the last of each group is shown."""
    outlines = Outlines(projected)
    bounds = np.unique(np.linspace(0, len(steps), min(most, len(steps)) + 1).round().astype(int))
    for begin, end in itertools.pairwise(bounds):
        group, last = steps[begin:end], steps[end - 1]
        painted = tuple(one for step in group for one in painted_by(step))
        ink = tuple(mark for step in group for mark in ink_of(step))
        yield Frame(
            int(end), last.kind, last.sentence, last.work, tuple(marks_of(last, outlines)), ink, painted
        )


def painted_by(step: Step) -> Iterator[tuple[int, Sequence[tuple[int, int]]]]:
    """(face, pixels) that a step gives a new nearest face."""
    if step.kind == "done":
        yield from final(step.data.get("face"))
    elif "pixels" in step.data and "face" in step.data:
        yield int(step.data["face"]), [(int(x), int(y)) for x, y in step.data["pixels"]]


def final(face: IntArray | None) -> Iterator[tuple[int, Sequence[tuple[int, int]]]]:
    """The whole answer (H, W), face by face, background too."""
    if face is None:
        return
    rows, columns = np.indices(face.shape)
    order = np.argsort(face, axis=None, kind="stable")
    flat = face.reshape(-1)[order]
    starts = np.flatnonzero(np.diff(flat, prepend=flat[0] - 1))
    pixels = np.stack([columns.reshape(-1)[order], rows.reshape(-1)[order]], axis=1).tolist()
    for begin, end in zip(starts, [*starts[1:], len(flat)], strict=True):
        yield int(flat[begin]), [(x, y) for x, y in pixels[begin:end]]


# --- marks ------------------------------------------------------------------------------------------------


def marks_of(step: Step, outlines: Outlines) -> Iterator[Mark]:
    """What a step's data shows, from behind to before."""
    data = step.data
    if step.kind == "done":
        return
    verdict = str(data.get("verdict", "area"))
    for face in faces_in(data.get("faces")):
        yield from (Mark("polygon", "rival", corners) for corners in outlines.of(face))
    if "face" in data:
        yield from (Mark("polygon", "subject", corners) for corners in outlines.of(int(data["face"])))
    for corners in listed(data, "polygon", "polygons"):
        yield Mark("polygon", verdict, points_of(corners))
    for left, top, right, bottom in listed(data, "rectangle", "rectangles"):
        yield Mark("polygon", verdict, rectangle(left, top, right, bottom))
    won = set(data.get("pixels", ()))
    for role, chosen in (("kept", True), ("dropped", False)):
        centres = [(x + 0.5, y + 0.5) for x, y in data.get("tested", ()) if ((x, y) in won) == chosen]
        if centres:
            yield Mark("dots", role, centres)
    for name, role in (("segments", verdict), ("hidden", "hidden")):
        for ends in data.get(name, ()):
            yield Mark("line", role, points_of(ends))


def ink_of(step: Step) -> Iterator[Mark]:
    """What of a step's marks stays: areas and faces that are settled, and lines that are seen."""
    if step.data.get("settled"):
        for left, top, right, bottom in listed(step.data, "rectangle", "rectangles"):
            yield Mark("polygon", "area", rectangle(left, top, right, bottom))
        for corners in listed(step.data, "polygon", "polygons"):
            yield Mark("polygon", "kept", points_of(corners))
        for ends in step.data.get("segments", ()):
            yield Mark("line", "kept", points_of(ends))


def listed(data: Mapping[str, Any], one: str, many: str) -> Iterable[Any]:
    """What stands under a name, and under its plural."""
    return itertools.chain([data[one]] if one in data else (), data.get(many, ()))


def faces_in(faces: Any) -> list[int]:
    """Face numbers, however they are given."""
    return [] if faces is None else [int(face) for face in faces]


def rectangle(left: float, top: float, right: float, bottom: float) -> Points:
    """Its corners."""
    return points_of([(left, top), (right, top), (right, bottom), (left, bottom)])
