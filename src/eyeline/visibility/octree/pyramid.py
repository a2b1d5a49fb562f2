"""A pyramid over the keys of one tile: how near the farthest pixel of any square is. [Greene93]

A key is the bits of a depth above those of an inverted face number: the greater is nearer, and of equal
depths has the lower number. The pyramid holds the least key of 8x8 pixels, of four such squares, and so on up
to the whole tile. What has no greater key is hidden wherever it falls within.
"""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper

TILE_BITS, SQUARE_BITS = 8, 3
TILE = 1 << TILE_BITS  # pixels of a tile's side: its keys are 512 kB and stay in the second cache
TOP = TILE_BITS - SQUARE_BITS  # the level of the whole tile; level 0 is of the smallest squares
CELLS = (4 ** (TOP + 1) - 1) // 3  # of all levels
LOW32 = 0xFFFFFFFF
NEAREST = 0x7FFFFFFFFFFFFFFF  # the key of what cannot be told, and of pixels beside the picture


@helper
def key_of(depth, number):
    """The key of a face at a depth; 0 is nothing, and less is farther than that."""
    return (np.int64(np.float32(depth).view(np.int32)) << 32) | (np.int64(number) ^ LOW32)


@helper
def first_cell(level):
    """Where a level begins: the finest first, row after row."""
    return CELLS - ((1 << (2 * (TOP + 1 - level))) - 1) // 3


@helper
def hides(pyramid, keys, key, left, top, right, bottom):
    """Whether all pixels of a rectangle, borders inside, are as near as a key: looked up from coarse to fine.

    A rectangle no larger than a square of the finest level is looked up pixel by pixel at last.
    """
    for up in range(TOP + 1):
        level = TOP - up
        bits, cells = SQUARE_BITS + level, first_cell(level)
        if all_reach(
            pyramid, cells, TOP - level, key, left >> bits, top >> bits, right >> bits, bottom >> bits
        ):
            return True
    if max(right - left, bottom - top) >> SQUARE_BITS > 0:
        return False
    return all_reach(keys, 0, TILE_BITS, key, left, top, right, bottom)


@helper
def all_reach(numbers, begin, pitch_bits, key, left, top, right, bottom):
    """Whether all numbers of a rectangle are a key or more."""
    for row in range(top, bottom + 1):
        at = begin + (row << pitch_bits)
        for column in range(left, right + 1):
            if numbers[at + column] < key:
                return False
    return True


@helper
def refresh(pyramid, keys, left, top, right, bottom):
    """Let the pyramid follow its keys in a rectangle, borders included."""
    changed = False
    for row in range(top >> SQUARE_BITS, (bottom >> SQUARE_BITS) + 1):
        for column in range(left >> SQUARE_BITS, (right >> SQUARE_BITS) + 1):
            least = np.int64(NEAREST)
            first = (row << (TILE_BITS + SQUARE_BITS)) + (column << SQUARE_BITS)
            for y in range(1 << SQUARE_BITS):
                for x in range(1 << SQUARE_BITS):
                    least = min(least, keys[first + (y << TILE_BITS) + x])
            cell = (row << TOP) + column
            changed = changed or pyramid[cell] != least
            pyramid[cell] = least
    level = 1
    while changed and level <= TOP:
        changed = False
        bits, cells, finer = SQUARE_BITS + level, first_cell(level), first_cell(level - 1)
        for row in range(top >> bits, (bottom >> bits) + 1):
            for column in range(left >> bits, (right >> bits) + 1):
                a = finer + (2 * row << (TOP + 1 - level)) + 2 * column
                b = a + (1 << (TOP + 1 - level))
                least = min(min(pyramid[a], pyramid[a + 1]), min(pyramid[b], pyramid[b + 1]))
                cell = cells + (row << (TOP - level)) + column
                changed = changed or pyramid[cell] != least
                pyramid[cell] = least
        level += 1
