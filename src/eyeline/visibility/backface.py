"""Back-face removal: what turns its back is not seen. [Roberts63]

A face shows its front when its corners turn counter-clockwise on the screen: the sign of N . V, read off
whole numbers after projection, so that an edge-on face is exactly that. It removes about half of a closed
scene's faces before another method decides; alone it answers for one convex body, whose fronts never hide
each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from eyeline.geometry.fixedpoint import UNITS
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.visibility.fragments import fragments
from eyeline.visibility.method import Step, Visible, counted

CONVEX = 1e-5  # the part of its hull's volume and area that a body may lack; float32 corners cost it 1e-7


@dataclass(frozen=True)
class BackFace:
    """Back-face removal: a filter for any scene, and the answer for one convex body seen from outside."""

    name: str = "backface"
    space: str = "object"
    answers: bool = False
    exact: bool = True

    def __call__(self, projected: Projected) -> Visible:
        """What is seen of one convex body: its fronts, whatever their order. Refused: any other scene."""
        fronts = fronts_of(projected)
        seen = fragments(fronts, np.zeros((projected.height, projected.width), dtype=np.float32))
        face, depth = seen.nearest()
        removed = len(projected.faces) - int(kept(fronts).sum())
        work = {"faces": len(projected.faces), "faces turned away": removed, "depth tests": 0}
        return Visible(face, depth, projected, self, work)

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Face by face: which way it turns, and whether it stays; then whether what is left is the answer."""
        stays, areas, removed = kept(projected), signed_areas(projected), 0
        sides = np.broadcast_to(projected.sides, len(stays)).tolist()
        corners, work = projected.xy[projected.faces] / UNITS, {"faces": 0, "faces turned away": 0}
        for number, (stay, area) in enumerate(zip(stays.tolist(), areas.tolist(), strict=True)):
            removed += not stay
            face, work = int(projected.source[number]), {"faces": number + 1, "faces turned away": removed}
            data = {
                "face": face, "area": area, "stays": stay, "settled": stay,
                "polygon": corners[number], "verdict": "kept" if stay else "dropped",
            }  # fmt: skip
            yield Step("face", f"face {face} {turn_of(area, sides[number])}", data, work)
        left = f"{counted(len(stays) - removed, 'face')} of {len(stays)} left"
        try:
            answer = self(projected)
        except SceneError as reason:
            yield Step("done", f"{left}, for another method to choose from: {reason}", {}, work)
        else:
            data = {"face": answer.face, "depth": answer.depth}
            yield Step("done", f"{left}, and of one convex body they are the whole answer", data, work)


def turn_of(area: int, sides: int) -> str:
    """What twice a face's signed area tells, and what follows where these sides count, in words."""
    if not sides:
        return "is hidden: it goes"
    if not area:
        return "is edge-on, N . V is 0: it goes"
    around = f"turns {'' if area > 0 else 'counter-'}clockwise around {abs(area) / (2 * UNITS**2):.1f} pixels"
    if sides == CLOCKWISE | COUNTER_CLOCKWISE:
        return f"{around}; both its sides count: it stays"
    is_front = bool(sides & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE))
    return f"{around}: {'its front, N . V > 0: it stays' if is_front else 'its back, N . V < 0: it goes'}"


def kept(projected: Projected) -> BoolArray:
    """(F,) the faces, pieces too, that show a side that counts; edge-on they show none."""
    area = signed_areas(projected)
    shown = np.where(area < 0, np.uint8(COUNTER_CLOCKWISE), np.uint8(CLOCKWISE))
    stays: BoolArray = (area != 0) & ((shown & projected.sides) != 0)
    return stays


def without_backs(projected: Projected) -> Projected:
    """The same picture without the faces that show no side that counts; all keep their numbers.

    A double-sided face stays whichever side it shows, a mirrored one by the side that became its front.
    """
    return replace(projected, sides=np.where(kept(projected), projected.sides, np.uint8(0)))


def signed_areas(projected: Projected) -> IntArray:
    """(F,) int64, twice the area in square units: positive where a face turns clockwise on the screen."""
    x, y = (projected.xy[:, k][projected.faces].astype(np.int64) for k in range(2))
    return (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])


# --- one convex body --------------------------------------------------------------------------------------


def fronts_of(projected: Projected) -> Projected:
    """The fronts of a scene that is one convex body, seen from outside; refuses every other scene."""
    shown = [surface for surface in projected.surfaces if surface.visible and len(surface.mesh.faces)]
    if len(shown) != 1:
        raise SceneError(
            f"back-face removal alone shows one convex body, not {len(shown)}; use another method"
        )
    surface = shown[0]
    if len(projected.piece_source):
        raise SceneError("the convex body reaches behind the near plane; move the camera back, out of it")
    if not is_convex(surface.mesh.points.astype(np.float64), surface.mesh.faces):
        raise SceneError("the body is not convex and closed with its fronts outside; use another method")
    front: ByteArray = np.array([CLOCKWISE if surface.mirrored else COUNTER_CLOCKWISE], dtype=np.uint8)
    return replace(projected, sides=projected.sides & front)


def is_convex(points: FloatArray, faces: IntArray) -> bool:
    """Whether faces are all of a convex body, fronts outside: as large as their hull, in volume and area."""
    from scipy.spatial import ConvexHull, QhullError

    a, b, c = (points[faces[:, k]] - points.mean(axis=0) for k in range(3))
    cross = np.cross(b - a, c - a)
    try:
        hull = ConvexHull(points[np.unique(faces)])
    except QhullError:
        return False
    volume, area = float((a * cross).sum()) / 6, float(np.sqrt((cross**2).sum(axis=1)).sum()) / 2
    return abs(volume - hull.volume) <= CONVEX * hull.volume and abs(area - hull.area) <= CONVEX * hull.area
