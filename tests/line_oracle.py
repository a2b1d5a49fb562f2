"""Slow and obviously right: whether points of lines are seen, by trying every face in unsnapped float64.

A line is wrong where it claims to be seen and a face surely stands before it, or claims to be hidden and
surely none does. Sure is what stays so wherever corners are moved within REACH units of the drawing's grid:
corners of lines and faces are snapped to whole units, and pieces under eight units go to their neighbours.
"""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from eyeline.projection.sides import sides_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene

REACH = 16  # units of the grid
SPECK = 0.1  # pixels: a shorter piece is too short for `audit`, whose samples keep away from its ends
ACROSS = 2**24  # units at least half of which are the longer side of the picture

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Segments:
    """Straight lines in the world, each all seen or all hidden, and the faces of the scene they lie in."""

    world: Floats  # (N, 2, 3)
    faces: npt.NDArray[np.int64]  # (N, 2), -1 is none
    seen: npt.NDArray[np.bool_]  # (N,)


@dataclass(frozen=True, eq=False)
class Verdict:
    """What an audit found."""

    samples: int
    decided: int  # of the samples: those whose truth is sure
    wrong: tuple[str, ...]  # a sentence for each sample whose claim is surely false


@dataclass(frozen=True, eq=False)
class Screen:
    """The faces of a scene in pixels, and depths that are linear there; greater is farther."""

    corners: Floats  # (F, 3, 3) x, y, depth
    face: npt.NDArray[np.int64]  # (F,) the scene face each is cut from
    sides: npt.NDArray[np.int64]  # (F,) which turns are drawn: 1 counter-clockwise, 2 clockwise, 3 both

    @cached_property
    def boxes(self) -> tuple[Floats, ...]:
        """Least x, greatest x, least y, greatest y, (F,) each."""
        x, y = self.corners[..., 0], self.corners[..., 1]
        return x.min(axis=1), x.max(axis=1), y.min(axis=1), y.max(axis=1)

    def around(self, x: float, y: float, reach: float) -> npt.NDArray[np.int64]:
        """Faces whose box comes within reach of a place."""
        left, right, top, bottom = self.boxes
        near = (left - reach <= x) & (right + reach >= x) & (top - reach <= y) & (bottom + reach >= y)
        return np.flatnonzero(near)


def unit(size: tuple[int, int]) -> float:
    """A unit of the grid in pixels."""
    return float(1 / 2 ** math.floor(math.log2(ACROSS / max(size))))


def audit(
    scene: Scene, camera: Camera, size: tuple[int, int], segments: Segments, count: int = 400, seed: int = 0
) -> Verdict:
    """Claims of `count` points of seen segments and as many of hidden ones, by chance, against all faces."""
    camera = camera.fitted(scene.bounds)
    screen, reach = on_screen(scene, camera, size), REACH * unit(size)
    random = np.random.default_rng(seed)
    wrong, samples, decided = [], 0, 0
    ends = projected(segments.world.reshape(-1, 3), camera, size).reshape(-1, 2, 3)
    length = np.hypot(*(ends[:, 1, :2] - ends[:, 0, :2]).T)
    for claim in (True, False):
        rows = np.flatnonzero((segments.seen == claim) & (length > 4 * reach))
        if len(rows) == 0:
            continue
        # Short pieces are sampled more than their share: there mistakes hide
        weight = np.sqrt(length[rows])
        for row in random.choice(rows, min(count, 4 * len(rows)), p=weight / weight.sum()):
            least = 2 * reach / length[row]
            along = random.uniform(least, 1 - least)
            x, y, depth = ends[row, 0] + along * (ends[row, 1] - ends[row, 0])
            samples += 1
            if not (-reach < x < size[0] + reach and -reach < y < size[1] + reach):
                wrong.append(f"segment {row} leaves the picture at ({x:.4f}, {y:.4f})")
                continue
            surely, maybe = hidden(screen, (x, y, depth), segments.faces[row], reach, camera, size)
            decided += surely or not maybe
            if surely if claim else not maybe:
                told = "seen" if claim else "hidden"
                wrong.append(f"segment {row} is not {told} at ({x:.4f}, {y:.4f}), {along:.4f} along it")
    return Verdict(samples, decided, tuple(wrong))


def specks(scene: Scene, camera: Camera, size: tuple[int, int], segments: Segments) -> list[int]:
    """The seen segments shorter than SPECK, that are hidden in exact arithmetic."""
    camera = camera.fitted(scene.bounds)
    screen = on_screen(scene, camera, size)
    ends = projected(segments.world.reshape(-1, 3), camera, size).reshape(-1, 2, 3)
    length = np.hypot(*(ends[:, 1, :2] - ends[:, 0, :2]).T)
    middle = ends.mean(axis=1)
    return [
        int(row)
        for row in np.flatnonzero(segments.seen & (length < SPECK))
        if hidden(screen, tuple(middle[row]), segments.faces[row], 0.0, camera, size)[0]
    ]


def hidden(
    screen: Screen,
    sample: tuple[float, float, float],
    own: npt.NDArray[np.int64],
    reach: float,
    camera: Camera,
    size: tuple[int, int],
) -> tuple[bool, bool]:
    """Whether a face surely stands before a sample, and whether one may, if all moves by `reach` pixels."""
    x, y, depth = sample
    near = screen.around(x, y, reach)
    near = near[~np.isin(screen.face[near], own[own >= 0])]
    c, sides = screen.corners[near], screen.sides[near]
    ahead = depth_step(depth, camera, size)
    a, b, d = c[:, 0], c[:, 1], c[:, 2]
    area = cross(b - a, d - a)
    widths = np.stack([np.hypot(*(q - p)[:, :2].T) for p, q in ((b, d), (d, a), (a, b))])
    place = np.array([[x, y, 0.0]])
    parts = np.stack([cross(b - place, d - place), cross(d - place, a - place), cross(a - place, b - place)])
    with np.errstate(divide="ignore", invalid="ignore"):
        margin = (np.sign(area) * parts / widths).min(axis=0)
        plane = (parts * c[:, :, 2].T).sum(axis=0) / area
        slope_x = ((b - a)[:, 2] * (d - a)[:, 1] - (d - a)[:, 2] * (b - a)[:, 1]) / area
        slope_y = ((d - a)[:, 2] * (b - a)[:, 0] - (b - a)[:, 2] * (d - a)[:, 0]) / area
        doubt = reach * (np.abs(slope_x) + np.abs(slope_y) + ahead)
        # A face that is thinner than the reach may show either side
        thin = np.abs(area) <= 2 * reach * widths.max(axis=0)
        drawn = (sides & np.where(area > 0, 2, 1)) > 0
        surely = drawn & ~thin & (margin > reach) & (depth > plane + doubt)
        least = np.minimum(plane, c[:, :, 2].max(axis=1))
        maybe = (drawn | thin) & ((margin > -reach) | thin) & ~(depth < least - doubt)
    return bool(surely.any()), bool(maybe.any())


def depth_step(depth: float, camera: Camera, size: tuple[int, int]) -> float:
    """How much depth changes with a pixel along the view, at this depth."""
    focal = float(camera.clip_from_eye(size[0] / size[1])[1, 1]) * size[1] / 2
    return abs(depth) / focal if camera.fov is not None else 1 / focal


def cross(a: Floats, b: Floats) -> Floats:
    """Twice the signed area between rows, on the screen; positive for clockwise turns, y down."""
    area: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return area


# --- the scene on the screen ------------------------------------------------------------------------------


def on_screen(scene: Scene, camera: Camera, size: tuple[int, int]) -> Screen:
    """All faces that can be drawn, cut at the near plane and at the far one."""
    corners, faces, sides = [np.empty((0, 3, 3))], [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    planes = [(camera.near, 1.0)] + ([(camera.far, -1.0)] if camera.far not in (None, math.inf) else [])
    for surface in (one for one in scene.surfaces if one.visible):
        eye = in_eye(world_points(surface), camera)[surface.mesh.faces]
        kept, number = [eye], [np.arange(len(eye))]
        for distance, sign in planes:
            assert distance is not None
            inside = sign * (-kept[0][..., 2] - distance) >= 0
            whole = inside.all(axis=1)
            cut, of = [kept[0][whole]], [number[0][whole]]
            for row in np.flatnonzero(inside.any(axis=1) & ~whole):
                polygon = clipped(kept[0][row], sign, distance)
                fan = [(polygon[0], polygon[k], polygon[k + 1]) for k in range(1, len(polygon) - 1)]
                cut.append(np.array(fan).reshape(-1, 3, 3))
                of.append(np.full(len(fan), number[0][row]))
            kept, number = [np.concatenate(cut)], [np.concatenate(of)]
        allowed = np.broadcast_to(sides_of(surface, "auto"), len(eye)).astype(np.int64)
        corners.append(to_pixels(kept[0].reshape(-1, 3), camera, size).reshape(-1, 3, 3))
        faces.append(surface.first_face + number[0])
        sides.append(allowed[number[0]])
    return Screen(np.concatenate(corners), np.concatenate(faces), np.concatenate(sides))


def clipped(polygon: Floats, sign: float, distance: float) -> list[Floats]:
    """The corners of a polygon before (sign 1) or behind (-1) a plane across the view."""
    found = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = sign * (-p[2] - distance), sign * (-q[2] - distance)
        if at_p >= 0:
            found.append(p)
        if (at_p >= 0) != (at_q >= 0):
            found.append(p + (q - p) * at_p / (at_p - at_q))
    return found


def world_points(surface) -> Floats:
    """(V, 3) the points of a surface where they stand."""
    m = surface.world_from_mesh
    return surface.mesh.points.astype(np.float64) @ m[:3, :3].T + m[:3, 3]


def in_eye(points: Floats, camera: Camera) -> Floats:
    """World points (..., 3) before the eye."""
    m = np.linalg.inv(camera.world_from_eye)
    return points @ m[:3, :3].T + m[:3, 3]


def to_pixels(eye: Floats, camera: Camera, size: tuple[int, int]) -> Floats:
    """(N, 3) x, y, depth of points (N, 3) before the eye."""
    focal = float(camera.clip_from_eye(size[0] / size[1])[1, 1]) * size[1] / 2
    away = -eye[:, 2] if camera.fov is not None else np.ones(len(eye))
    depth = -1 / away if camera.fov is not None else -eye[:, 2]
    return np.stack(
        [size[0] / 2 + focal * eye[:, 0] / away, size[1] / 2 - focal * eye[:, 1] / away, depth], 1
    )


def projected(points: Floats, camera: Camera, size: tuple[int, int]) -> Floats:
    """(N, 3) x, y, depth of world points (N, 3)."""
    return to_pixels(in_eye(points, camera), camera, size)


# --- which edges are to be drawn --------------------------------------------------------------------------


def edges_of(scene: Scene, camera: Camera, crease: float) -> dict[str, set[frozenset[tuple[float, ...]]]]:
    """Each kind's edges as pairs of world points, for meshes of proper edges with both sides shown.

    Edges are known by where their ends are; two faces that share one run along it in opposite ways.
    """
    found: dict[str, set[frozenset[tuple[float, ...]]]] = defaultdict(set)
    camera = camera.fitted(scene.bounds)
    for surface in (one for one in scene.surfaces if one.visible):
        points = world_points(surface)
        around: dict[frozenset[tuple[float, ...]], list[int]] = defaultdict(list)
        for number, face in enumerate(surface.mesh.faces.tolist()):
            for k in range(3):
                pair = (face[k], face[(k + 1) % 3])
                around[frozenset(tuple(points[one].tolist()) for one in pair)].append(number)
        triangles = points[surface.mesh.faces]
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        eye = camera.world_from_eye[:3, 3]
        view = triangles[:, 0] - eye if camera.fov is not None else -camera.world_from_eye[:3, 2]
        front = (normals * view).sum(axis=1) < 0
        for edge, faces in around.items():
            if len(faces) != 2:
                found["boundary"].add(edge)
            elif front[faces[0]] != front[faces[1]]:
                found["outline"].add(edge)
            else:
                m, n = normals[faces]
                bend = math.acos(min(1.0, max(-1.0, m @ n / math.sqrt((m @ m) * (n @ n)))))
                found["crease" if bend > crease else "mesh"].add(edge)
    return found
