"""Slow and obviously right: whether samples of segments are seen, by trying every face in unsnapped float64.

A sample is wrong where it claims to be seen and a face surely stands before it, or claims to be hidden and
surely none does. Sure is what stays so wherever all corners are moved by REACH pixels, on the screen and as
much along the sight line: the picture's grid moves them by half of 1/256 pixel, and pieces shorter than a
whole one go to their neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

import line_oracle
from eyeline.scene.scene import Scene
from eyeline.visibility import VisibleEdges

REACH = 3 / 256  # pixels

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Verdict:
    """What an audit found."""

    samples: int
    decided: int  # of the samples: those whose truth is sure
    wrong: tuple[str, ...]  # a sentence for each sample whose claim is surely false


def audit(scene: Scene, answer: VisibleEdges, count: int = 300, seed: int = 0) -> Verdict:
    """Claims of `count` points of seen segments and as many of hidden ones, by chance, against all faces."""
    camera, size = answer.projected.camera, (answer.projected.width, answer.projected.height)
    screen = line_oracle.on_screen(scene, camera, size)
    clip, away = clip_ends(answer), ~np.isin(answer.faces, shown(screen)).any(axis=1)
    random = np.random.default_rng(seed)
    samples, decided, wrong = 0, 0, []
    for claim, pixels, edge in (
        ("seen", answer.segments, answer.edge),
        ("hidden", answer.hidden, answer.hidden_edge),
    ):
        length = np.hypot(*(pixels[:, 1] - pixels[:, 0]).T)
        rows = np.flatnonzero(length > 4 * REACH)
        if len(rows) == 0:
            continue
        # Short pieces are sampled more than their share: there mistakes hide
        weight = np.sqrt(length[rows])
        for row in random.choice(rows, min(count, 4 * len(rows)), p=weight / weight.sum()):
            least = 2 * REACH / length[row]
            along = random.uniform(least, 1 - least)
            place = pixels[row, 0] + along * (pixels[row, 1] - pixels[row, 0])
            x, y, depth = on_edge(clip[edge[row]], place, size, camera.fov is not None)
            samples += 1
            own = answer.faces[edge[row]].astype(np.int64)
            surely, maybe = line_oracle.hidden(screen, (x, y, depth), own, REACH, camera, size)
            surely, maybe = surely | away[edge[row]], maybe | away[edge[row]]
            decided += surely or not maybe
            if surely if claim == "seen" else not maybe:
                wrong.append(f"edge {edge[row]} is not {claim} at ({x:.3f}, {y:.3f}), {along:.3f} along it")
    return Verdict(samples, decided, tuple(wrong))


def specks(scene: Scene, answer: VisibleEdges) -> list[int]:
    """The seen segments shorter than `line_oracle.SPECK` that are hidden in exact arithmetic."""
    camera, size = answer.projected.camera, (answer.projected.width, answer.projected.height)
    screen, clip = line_oracle.on_screen(scene, camera, size), clip_ends(answer)
    length = np.hypot(*(answer.segments[:, 1] - answer.segments[:, 0]).T)
    found = []
    for row in np.flatnonzero(length < line_oracle.SPECK):
        edge = answer.edge[row]
        place = on_edge(clip[edge], answer.segments[row].mean(axis=0), size, camera.fov is not None)
        own = answer.faces[edge].astype(np.int64)
        if line_oracle.hidden(screen, place, own, 0.0, camera, size)[0]:
            found.append(int(row))
    return found


def shown(screen: line_oracle.Screen) -> npt.NDArray[np.int64]:
    """The faces that show a side that counts."""
    a, b, c = (screen.corners[:, k] for k in range(3))
    turn = np.where(line_oracle.cross(b - a, c - a) > 0, 2, 1)
    return screen.face[(screen.sides & turn) != 0]


def clip_ends(answer: VisibleEdges) -> Floats:
    """(E, 2, 4) the ends of all edges: x and y in -1..1 times w, metres along the view, w."""
    projected = answer.projected
    points = [np.empty((0, 4))]
    for surface in projected.surfaces:
        eye = line_oracle.in_eye(line_oracle.world_points(surface), projected.camera)
        matrix = projected.camera.clip_from_eye(projected.width / projected.height)
        clip = np.concatenate([eye, np.ones((len(eye), 1))], axis=1) @ matrix.T
        points.append(np.stack([clip[:, 0], clip[:, 1], -eye[:, 2], clip[:, 3]], axis=1))
    return np.concatenate(points)[answer.vertices]


def on_edge(
    ends: Floats, place: Floats, size: tuple[int, int], perspective: bool
) -> tuple[float, float, float]:
    """The point of an edge (2, 4) behind a place (2,) of the picture: x, y, depth as `line_oracle` has it."""
    screen = np.array([2 * place[0] / size[0] - 1, 1 - 2 * place[1] / size[1]])
    first, change = ends[0], ends[1] - ends[0]
    # x(t) / w(t) = screen, along the axis on which the edge changes more
    over, under = screen * first[3] - first[:2], change[:2] - screen * change[3]
    axis = int(np.argmax(np.abs(under) * size))
    x, y, away, w = first + np.clip(over[axis] / under[axis], 0, 1) * change
    depth = -1 / away if perspective else away
    return (x / w + 1) * size[0] / 2, (1 - y / w) * size[1] / 2, depth
