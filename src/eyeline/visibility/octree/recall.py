"""What another frame saw, as leaves to draw first: they hide the rest before it is looked at.

A film's next frame sees nearly what this one saw. The answer does not depend on what is recalled, nor on
whether it is of the same scene: a leaf that is drawn early is a leaf that is drawn.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import IntArray, read_only
from eyeline.geometry.octree import BEGIN, CHILDREN, END, WIDTH
from eyeline.jit import kernel
from eyeline.visibility.octree.forest import Forest


def recalled(forest: Forest, face: IntArray) -> IntArray:
    """Which leaves of a forest of meshes hold faces of a picture (H, W): standing * nodes + leaf, rising."""
    if not len(forest.nodes):
        return np.empty(0, np.int64)
    leaves, of_row = np.empty(len(forest.numbers), np.int32), np.empty(len(forest.numbers), np.int32)
    above, found = np.full(face.shape[1], -1, np.int64), np.empty(face.size, np.int64)
    count = _recall(forest, read_only(face), leaves, of_row, above, found)
    return np.unique(found[:count])


@kernel
def _recall(forest, face, leaves, of_row, above, found):
    """List standing * nodes + leaf of the faces in a picture, few of them twice; how many that is."""
    nodes, count = forest.nodes.shape[0] // WIDTH, 0
    for node in range(nodes):
        if forest.nodes[node * WIDTH + CHILDREN] == 0:
            for slot in range(forest.nodes[node * WIDTH + BEGIN], forest.nodes[node * WIDTH + END]):
                leaves[slot] = node
    # A tree's faces stand in its slots, in another order
    for k in range(forest.roots.shape[0]):
        root = forest.roots[k] * WIDTH
        if k > 0 and root == forest.roots[k - 1] * WIDTH:
            continue
        for slot in range(forest.nodes[root + BEGIN], forest.nodes[root + END]):
            of_row[forest.nodes[root + BEGIN] + forest.numbers[slot]] = leaves[slot]
    for y in range(face.shape[0]):
        last = np.int64(-1)
        for x in range(face.shape[1]):
            number = face[y, x]
            if number < 0:
                continue
            low, high = 0, forest.firsts.shape[0]
            while high - low > 1:
                middle = (low + high) >> 1
                if forest.firsts[middle] <= number:
                    low = middle
                else:
                    high = middle
            begin, end = (
                forest.nodes[forest.roots[low] * WIDTH + BEGIN],
                forest.nodes[forest.roots[low] * WIDTH + END],
            )
            row = number - forest.firsts[low]
            if not 0 <= row < end - begin:
                continue
            place = np.int64(low) * nodes + of_row[begin + row]
            if place != last and place != above[x]:
                found[count] = place
                count += 1
            last = above[x] = place
    return count
