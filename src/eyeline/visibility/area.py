"""How much of a node is seen, and what hides the rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry.arrays import BoolArray
from eyeline.visibility.method import Visible, nodes_of


@dataclass(frozen=True)
class Area:
    """How much of a node is seen, in pixels."""

    pixels: int  # where it is seen
    unoccluded_pixels: int  # where it would be seen with nothing else there
    occluders: Mapping[str, int]  # path of a node -> pixels of this one that it hides, the greatest first

    @property
    def fraction(self) -> float:
        """The seen part of what could be seen, 0..1; 0 if it is out of the picture."""
        return self.pixels / self.unoccluded_pixels if self.unoccluded_pixels else 0.0


def area_of(seen: Visible, node: str | int) -> Area:
    """The area of a node and of what hangs from it: the method answers once more, with nothing else there."""
    projected = seen.projected
    wanted = subtree(seen, node)
    of_surface = np.array([wanted[surface.node] for surface in projected.surfaces], dtype=bool)
    alone = seen.method(projected.only(np.repeat(of_surface, np.diff(projected.first_faces)))).face >= 0
    # -1, the background, reads the last place: nothing of ours
    own = np.append(wanted, False)[seen.node]
    hiding, pixels = np.unique(nodes_of(seen.face[alone & ~own], projected), return_counts=True)
    by_pixels = sorted(
        zip(pixels.tolist(), hiding.tolist(), strict=True), key=lambda pair: (-pair[0], pair[1])
    )
    occluders = {path_of(seen, hider): count for count, hider in by_pixels if hider >= 0}
    return Area(int(own.sum()), int(alone.sum()), occluders)


def subtree(seen: Visible, node: str | int) -> BoolArray:
    """(N,) whether each node is this one or hangs from it."""
    if seen.scene is None:
        nodes = {surface.node for surface in seen.projected.surfaces}
        if node not in nodes:
            raise SceneError(
                f"there is no surface of node {node!r}; without a scene, give one of {sorted(nodes)}"
            )
        only: BoolArray = np.arange(max(nodes) + 1) == node
        return only
    root = seen.scene.find(node)
    wanted = np.zeros(len(seen.scene.nodes), dtype=bool)
    for index, one in enumerate(seen.scene.nodes):
        wanted[index] = index == root or (one.parent >= 0 and wanted[one.parent])
    return wanted


def path_of(seen: Visible, node: int) -> str:
    """What people call a node."""
    return seen.scene.paths[node] if seen.scene is not None else f"node {node}"
