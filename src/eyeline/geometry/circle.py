"""Sine and cosine by arithmetic alone: the same bits on every machine, and a loop over them vectorises."""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper

# A quarter turn in three parts, the first two with zeros at their ends: whole multiples of them are exact
QUARTER = 1.5707963267341256
QUARTER_REST = 6.077100506303966e-11
QUARTER_LAST = 2.0222662487959506e-21
QUARTERS_PER_RADIAN = 2 / math.pi


@helper
def sine_cosine(angle):
    """(sin, cos) of an angle in radians, right to the last bit or the one before it while |angle| < 1e5.

    Taken to the nearest quarter turn, then by the polynomials of FreeBSD's kernel. [Cody80]
    """
    quarters = np.floor(angle * QUARTERS_PER_RADIAN + 0.5)
    r = ((angle - quarters * QUARTER) - quarters * QUARTER_REST) - quarters * QUARTER_LAST
    z = r * r
    s = 2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
    s = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * s)
    s = r + r * z * (-1.66666666666666324348e-01 + z * s)
    c = -2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)
    c = 4.16666666666666019037e-02 + z * (
        -1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 + z * c)
    )
    c = 1.0 - 0.5 * z + z * z * c
    turn = quarters - 4.0 * np.floor(0.25 * quarters)  # 0, 1, 2 or 3
    odd = turn == 1.0 or turn == 3.0
    sine = c if odd else s
    cosine = s if odd else c
    return -sine if turn >= 2.0 else sine, -cosine if turn == 1.0 or turn == 2.0 else cosine
