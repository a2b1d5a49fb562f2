"""Many curves side by side in flat arrays, evaluated together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import helper, kernel, share, threads

if TYPE_CHECKING:
    from eyeline.motion.curve import Curve
    from eyeline.motion.weave import Weave

STEP, LINEAR, CUBIC, ARC, CUBIC_TURN = range(5)  # how a value is made between two keys

# Columns of the table of timelines, and of the table of curves.
FIRST_KEY, END_KEY, FIRST_CURVE, END_CURVE = range(4)
FIRST_VALUE, WIDTH, WAY, COLUMNS_BEFORE, BLOCK_WIDTH, COLUMN = range(6)

BLOCK = 128  # times whose places among the keys are found at once: they fit the nearest cache
SHARED = 4096  # values below which a second thread costs more than it brings


@dataclass(frozen=True, eq=False)
class Bundle:
    """C curves over L timelines; curves with equal key times share one, so that a time is looked up once.

    Values go to blocks of columns: a block stands at `columns before` * T and has one row for each time.
    """

    keys: FloatArray  # all timelines' key times, one after the other
    timelines: IntArray  # (L, 4) first and end key, first and end curve
    values: FloatArray  # all curves' keys, one after the other
    curves: IntArray  # (C, 6) first value, width, way; columns before the block, its width, the column in it
    columns: int  # of all blocks together
    weave: Weave | None = None  # those that are more than glTF's

    @classmethod
    def of(cls, curves: Sequence[Curve], places: IntArray | None = None, columns: int = 0) -> Bundle:
        """Curves, and where their values go: (C, 3) columns before the block, its width, the column in it.

        Without places, every curve gets a block of its own.
        """
        widths = np.array([curve.width for curve in curves], dtype=np.int64)
        if places is None:
            before = np.cumsum(widths) - widths
            places = np.stack([before, widths, np.zeros_like(widths)], axis=1)
            columns = int(widths.sum())
        shared: dict[bytes, list[int]] = {}
        woven = [index for index, curve in enumerate(curves) if not curve.is_plain]
        for index, curve in enumerate(curves):
            if curve.is_plain:
                shared.setdefault(curve.times.tobytes(), []).append(index)
        timelines: list[tuple[int, int, int, int]] = []
        order: list[int] = []
        key = first = 0
        for together in shared.values():
            count = len(curves[together[0]].times)
            timelines.append((key, key + count, len(order), len(order) + len(together)))
            order += together
            key += count
        packed = [_packed(curves[index]) for index in order]
        rows = []
        for index, (way, numbers) in zip(order, packed, strict=True):
            rows.append((first, widths[index], way, *places[index]))
            first += numbers.size
        return cls(
            keys=_joined([curves[together[0]].times for together in shared.values()]),
            timelines=np.array(timelines, dtype=np.int64).reshape(-1, 4),
            values=_joined([numbers.reshape(-1) for _, numbers in packed]),
            curves=np.array(rows, dtype=np.int64).reshape(-1, 6),
            columns=columns,
            weave=_weave(curves, woven, places),
        )

    def at(self, times: FloatArray, state: FloatArray | None = None) -> FloatArray:
        """Every curve at times (T,), written into `state`: flat (T * columns,) float64, block after block."""
        if state is None:
            state = np.empty(len(times) * self.columns)
        times = np.ascontiguousarray(times)
        woven = 0 if self.weave is None else len(self.weave.curves)
        parts = min(threads(), 1 + len(times) * (len(self.curves) + woven) // SHARED)
        ends = [len(times) * part // parts for part in range(parts + 1)]

        def task(part: int) -> None:
            span = times, ends[part], ends[part + 1]
            if len(self.curves):
                interpolate(*span, self.keys, self.timelines, self.values, self.curves, state)
            if self.weave is not None:
                self.weave.follow(*span, state)

        share(task, parts)
        return state


def _weave(curves: Sequence[Curve], woven: Sequence[int], places: IntArray) -> Weave | None:
    if not woven:
        return None
    from eyeline.motion.weave import Weave

    return Weave.of([curves[index] for index in woven], places[list(woven)])


def _joined(arrays: Sequence[FloatArray]) -> FloatArray:
    return np.concatenate([np.empty(0), *arrays])


def _packed(curve: Curve) -> tuple[int, FloatArray]:
    """The way between its keys, and what the kernel reads at each key."""
    if curve.interpolation == "cubic":
        return (CUBIC_TURN if curve.rotation else CUBIC), curve.values
    if curve.interpolation == "linear" and curve.rotation:
        return ARC, np.column_stack([curve.values, *arcs(curve.values)])
    return (STEP if curve.interpolation == "step" else LINEAR), curve.values


def arcs(turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """For each of (K, 4) unit quaternions the angle to the next in four dimensions, and 1 / its sine, or 0.

    Made of sums, products and roots alone, so that every machine finds the same.
    """
    step = np.concatenate([turns[1:] - turns[:-1], np.zeros((1, 4))])
    half_sine = np.sqrt((step * step).sum(axis=1)) / 2
    half_cosine = np.sqrt(1 - half_sine * half_sine)
    # The sine of a quarter of the angle, at most sin(pi / 8), where the series of the arc sine is short.
    x = half_sine / np.sqrt(2 + 2 * half_cosine)
    series = np.zeros_like(x)
    for coefficient in reversed(ARC_SINE):
        series = series * (x * x) + coefficient
    sine = 2 * half_sine * half_cosine
    return 4 * x * series, np.where(sine > 0, 1 / np.where(sine > 0, sine, 1), 0.0)


def _arc_sine(terms: int) -> list[float]:
    """Coefficients of x, x^3, x^5 ... of the arc sine."""
    coefficients, binomial = [], 1.0
    for n in range(terms):
        coefficients.append(binomial / (2 * n + 1))
        binomial *= (2 * n + 1) / (2 * n + 2)
    return coefficients


ARC_SINE = _arc_sine(20)  # the next term is below float64's rounding at sin(pi / 8)


@helper
def sine(x):
    """The sine of 0 <= x <= pi / 2, within two roundings: its series, the same on every machine."""
    s = x * x
    p = 1.9572941063391263e-20
    p = p * s - 8.2206352466243297e-18
    p = p * s + 2.8114572543455206e-15
    p = p * s - 7.6471637318198164e-13
    p = p * s + 1.6059043836821613e-10
    p = p * s - 2.5052108385441720e-08
    p = p * s + 2.7557319223985893e-06
    p = p * s - 1.9841269841269841e-04
    p = p * s + 8.3333333333333333e-03
    p = p * s - 1.6666666666666667e-01
    return x + x * s * p


@kernel
def interpolate(times, begin, end, keys, timelines, values, curves, state):
    """Every curve at times begin to end: one search for each timeline, then its curves."""
    count = len(times)
    index = np.empty(BLOCK, np.int64)
    part = np.empty(BLOCK, np.float64)
    gap = np.empty(BLOCK, np.float64)
    for start in range(begin, end, BLOCK):
        stop = min(start + BLOCK, end)
        for line in range(len(timelines)):
            first_key = timelines[line, FIRST_KEY]
            end_key = timelines[line, END_KEY]

            # Where each time stands among the keys
            for t in range(start, stop):
                time = times[t]
                low = first_key
                high = end_key
                while high - low > 1:
                    middle = (low + high) >> 1
                    if keys[middle] <= time:
                        low = middle
                    else:
                        high = middle
                inside = time > keys[low] and low + 1 < end_key
                index[t - start] = low - first_key
                gap[t - start] = keys[low + 1] - keys[low] if inside else 0.0
                part[t - start] = (time - keys[low]) / (keys[low + 1] - keys[low]) if inside else 0.0

            for curve in range(timelines[line, FIRST_CURVE], timelines[line, END_CURVE]):
                width = curves[curve, WIDTH]
                way = curves[curve, WAY]
                first = curves[curve, FIRST_VALUE]
                stride = curves[curve, BLOCK_WIDTH]
                base = curves[curve, COLUMNS_BEFORE] * count + curves[curve, COLUMN]
                for t in range(start, stop):
                    u = part[t - start]
                    to = base + t * stride
                    if way == ARC:
                        a = first + 6 * index[t - start]
                        angle = values[a + 4]
                        if u == 0.0 or angle == 0.0:
                            for k in range(4):
                                state[to + k] = values[a + k]
                        else:
                            p = sine((1.0 - u) * angle) * values[a + 5]
                            q = sine(u * angle) * values[a + 5]
                            for k in range(4):
                                state[to + k] = p * values[a + k] + q * values[a + 6 + k]
                    elif way == STEP or (u == 0.0 and way == LINEAR):
                        a = first + width * index[t - start]
                        for k in range(width):
                            state[to + k] = values[a + k]
                    elif way == LINEAR:
                        a = first + width * index[t - start]
                        for k in range(width):
                            state[to + k] = (1.0 - u) * values[a + k] + u * values[a + width + k]
                    else:
                        # Hermite's cubic: value, tangent out, next value, next tangent in
                        a = first + 3 * width * index[t - start] + width
                        if u == 0.0:
                            for k in range(width):
                                state[to + k] = values[a + k]
                        else:
                            g = gap[t - start]
                            v = u * u
                            d = v * (3.0 - 2.0 * u)
                            for k in range(width):
                                state[to + k] = (
                                    (1.0 - d) * values[a + k]
                                    + g * (u - 2.0 * v + u * v) * values[a + width + k]
                                    + d * values[a + 3 * width + k]
                                    + g * (u * v - v) * values[a + 2 * width + k]
                                )
                        if way == CUBIC_TURN:
                            length = 0.0
                            for k in range(4):
                                length += state[to + k] * state[to + k]
                            length = np.sqrt(length)
                            for k in range(4):
                                state[to + k] = (
                                    state[to + k] / length if length > 0.0 else (1.0 if k == 3 else 0.0)
                                )
