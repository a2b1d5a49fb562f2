"""Spans along a line, from and to a place in 0..1; none of it where the first is not less."""

from __future__ import annotations

from eyeline.jit import helper


@helper
def window(a, d, size):
    """Where a + t d is within 0..size, for t in 0..1; empty if the first is not less than the second."""
    if d == 0.0:
        return (0.0, 1.0) if (a >= 0.0) & (a <= size) else (1.0, 0.0)
    t, u = -a / d, (size - a) / d
    return max(min(t, u), 0.0), min(max(t, u), 1.0)


@helper
def with_span(spans, n, t0, t1, dust):
    """Join t0..t1 to the first n of spans (K, 2), sorted and farther apart than dust; how many they are then.

    There must be room for one more.
    """
    i = 0
    while i < n and spans[i, 1] + dust < t0:
        i += 1
    j = i
    while j < n and spans[j, 0] <= t1 + dust:
        t0, t1 = min(t0, spans[j, 0]), max(t1, spans[j, 1])
        j += 1
    if i == j:
        for k in range(n, i, -1):
            spans[k, 0], spans[k, 1] = spans[k - 1, 0], spans[k - 1, 1]
    else:
        for k in range(j, n):
            spans[k - j + i + 1, 0], spans[k - j + i + 1, 1] = spans[k, 0], spans[k, 1]
    spans[i, 0], spans[i, 1] = t0, t1
    return n + 1 - (j - i)
