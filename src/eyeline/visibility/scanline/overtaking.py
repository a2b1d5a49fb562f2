"""Two faces along a row of pixels: which is nearer, and where the other one overtakes it.

On a row the depth of a face is a line, k + a x, rounded twice. A pixel is decided by the rounded numbers, as
every method decides it; a run of pixels at once only where the lines are farther apart than rounding reaches.
"""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper

DOUBLE = 2.0**-50  # see nearer_throughout
SINGLE = 2.0**-22  # two steps of a float32 of at most 1
SMALLEST = 2.0**-148  # two steps of a float32 near 0


@helper
def nearer_throughout(a, k, other_a, other_k, lower, first, last):
    """Whether a face with the line k + a x is surely seen before another at all columns first..last.

    lower: whether it has the lower number, which wins where both depths are equal.

    In float64 a depth is off by at most 2**-53 (2 |a x| + |k|). The distance of two lines is least at one of
    the ends; there and between it is off by so much, for both faces: together less than DOUBLE times the sum
    of all |k| + |a| last. What is left of the distance may be 0 if equal depths suffice, since rounding to
    float32 keeps order; else it must exceed a step of float32. Lines of one slope keep their order unproved.
    """
    near, other_near = k + a * np.float64(first), other_k + other_a * np.float64(first)
    if first == last:
        own, other = np.float32(near), np.float32(other_near)
        return (own > other) | ((own == other) & lower)
    if lower & (a == other_a) & (k >= other_k):
        return True
    far, other_far = k + a * np.float64(last), other_k + other_a * np.float64(last)
    reach = DOUBLE * (abs(k) + abs(other_k) + (abs(a) + abs(other_a)) * np.float64(last))
    if not lower:
        reach += SINGLE * max(abs(near), abs(far), abs(other_near), abs(other_far)) + SMALLEST
    return min(near - other_near, far - other_far) >= reach


@helper
def overtaken(a, k, other_a, other_k, lower, first, last):
    """The first of the columns first..last at which another face is seen before this one; and the tries.

    last + 1 if there is none. Steps double where this face is nearer, and halve where that is not sure: few
    tries lead to a crossing, and faces that nearly coincide are decided pixel by pixel.
    """
    x, step, tries = first, last - first + 1, 0
    while x <= last:
        reach = min(x + step - 1, last)
        tries += 1
        if nearer_throughout(a, k, other_a, other_k, lower, x, reach):
            x, step = reach + 1, 2 * step
        elif reach == x:
            break
        else:
            step = (reach - x + 1) >> 1
    return x, tries
