"""Whether a method sees what a judge sees: the oracle where it is affordable, the depth buffer elsewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.comparison.oracle import screened, truth
from eyeline.geometry.arrays import BoolArray
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.visibility.method import Visible

MOST_FACES = 200_000  # that the oracle looks at
MOST_DOUBTED = 500  # pixels looked at one by one, where the depth buffer is the judge


@dataclass(frozen=True, eq=False)
class Agreement:
    """How an answer differs from the judge's."""

    different: BoolArray  # (H, W) another face
    wrong: BoolArray  # (H, W) another face, where what is seen is beyond doubt
    unjudged: int = 0  # pixels that differ and were not looked at


@dataclass(frozen=True, eq=False)
class Judge:
    """Who knows what is seen."""

    name: str  # "oracle" or "zbuffer"
    face: np.ndarray  # (H, W)
    decidable: BoolArray | None  # (H, W); None where each pixel is to be asked for
    scene: Scene
    projected: Projected
    cull: str

    def of(self, answer: Visible) -> Agreement:
        """How an answer compares."""
        different = answer.face != self.face
        if self.decidable is not None:
            return Agreement(different, different & self.decidable)
        size = self.projected.width, self.projected.height
        faces = screened(self.scene, self.projected.camera, size, self.cull)
        wrong = np.zeros_like(different)
        places = np.argwhere(different)
        for row, column in places[:MOST_DOUBTED]:
            wrong[row, column] = faces.is_decidable(int(column), int(row))
        return Agreement(different, wrong, max(0, len(places) - MOST_DOUBTED))

    @property
    def share(self) -> float | None:
        """The part of the pixels that is beyond doubt."""
        return None if self.decidable is None else float(self.decidable.mean())


def judge_of(scene: Scene, projected: Projected, cull: str, reference: Visible) -> Judge:
    """The oracle for scenes small enough, else `reference`, the depth buffer's answer."""
    if scene.face_count > MOST_FACES:
        return Judge("zbuffer", reference.face, None, scene, projected, cull)
    found = truth(scene, projected.camera, (projected.width, projected.height), cull)
    return Judge("oracle", found.face, found.decidable, scene, projected, cull)
