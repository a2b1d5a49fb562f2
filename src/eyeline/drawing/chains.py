"""Pieces that meet end to end become long paths, so that a pen is lifted seldom and dashes run on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import IntArray, read_only
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Chains:
    """Pieces in the order of paths."""

    enter: IntArray  # (N,) int64: 2 * piece + the end it is entered by, path after path
    start: IntArray  # (K + 1,) where each path begins


def chained(group: IntArray, name: IntArray) -> Chains:
    """Pieces (N,) joined where ends of one name meet; only those of one group (N,) join.

    name: (N, 2) of each end, -1 for one that joins nothing. Where more than two meet they are joined two by
    two, as they come.
    """
    count = len(group)
    follower = np.full(2 * count, -1, np.int64)
    half = np.flatnonzero(name.reshape(-1) >= 0)
    its_group, its_name = group[half // 2], name.reshape(-1)[half]
    order = np.lexsort((half, its_name, its_group))
    half, its_group, its_name = half[order], its_group[order], its_name[order]
    new = np.ones(len(half), bool)
    new[1:] = (its_group[1:] != its_group[:-1]) | (its_name[1:] != its_name[:-1])
    rank = np.arange(len(half)) - np.flatnonzero(new)[np.cumsum(new) - 1] if len(half) else half
    second = np.flatnonzero(rank % 2 == 1)
    follower[half[second]], follower[half[second - 1]] = half[second - 1], half[second]
    enter, start = np.empty(count, np.int64), np.empty(count + 1, np.int64)
    paths = _walk(read_only(follower), np.zeros(count, np.bool_), enter, start)
    return Chains(enter, start[: paths + 1])


@kernel
def _walk(follower, done, enter, start):
    """Fill enter and start; how many paths there are."""
    at, paths = 0, 0
    for rings in range(2):  # from free ends first; what is left are rings
        for begin in range(follower.shape[0]):
            if done[begin // 2] or (rings == 0 and follower[begin] >= 0):
                continue
            start[paths] = at
            paths += 1
            half = begin
            while half >= 0 and not done[half // 2]:
                enter[at], done[half // 2] = half, True
                at += 1
                half = follower[half ^ 1]
    start[paths] = at
    return paths
