"""What every comparison shares: two rivals in turn, how noisy the machine is, and a mesh of any size."""

from __future__ import annotations

import statistics
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Run = Callable[[], Any]


@dataclass(frozen=True)
class Duel:
    """Two rivals measured in turn, so that what else runs on the machine slows both alike."""

    ours: float  # seconds, median
    theirs: float  # seconds, median
    rounds: int

    @property
    def ratio(self) -> float:
        """How many times as fast as theirs ours is."""
        return self.theirs / self.ours

    def __str__(self) -> str:
        return (
            f"ours {self.ours * 1e3:9.1f} ms   theirs {self.theirs * 1e3:9.1f} ms   "
            f"{self.ratio:6.2f}x as fast   median of {self.rounds}"
        )


def alternate(ours: Run, theirs: Run, rounds: int = 7) -> Duel:
    """Medians of both, run in turn after one unmeasured run of each."""
    ours()
    theirs()
    times = [(seconds(ours), seconds(theirs)) for _ in range(rounds)]
    return Duel(
        statistics.median(one for one, _ in times), statistics.median(two for _, two in times), rounds
    )


def seconds(run: Run) -> float:
    """How long one run takes."""
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def free_cores(duration: float = 0.2) -> float:
    """How many cores two spinning threads get, 0..2: 2 on a quiet machine with two real ones."""
    work = np.ones(1 << 12)

    def spin() -> None:
        stop = time.perf_counter() + duration
        while time.perf_counter() < stop:
            np.sort(work)

    threads = [threading.Thread(target=spin) for _ in range(2)]
    before, start = time.process_time(), time.perf_counter()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return (time.process_time() - before) / (time.perf_counter() - start)


def bumpy_sphere(face_count: int, bumps: float = 0.08) -> tuple[np.ndarray, np.ndarray]:
    """A closed, bumpy sphere of radius about 1 with nearly `face_count` faces.

    Points (V, 3) float32 and faces (F, 3) int32, outward sides counter-clockwise: rows of a globe, two faces
    to a cell, one at the poles. Its bumps hide each other, so that depth has something to decide.
    """
    rows = max(3, round((1 + np.sqrt(1 + face_count)) / 2))  # 4 rows (rows - 1) faces
    columns = 2 * rows
    polar = np.linspace(0, np.pi, rows + 1)[1:-1, None]
    turn = np.arange(columns)[None] * (2 * np.pi / columns)
    radius = 1 + bumps * np.sin(9 * polar) * np.cos(11 * turn) + bumps / 2 * np.sin(23 * polar + 17 * turn)
    ring = np.stack(
        [np.sin(polar) * np.sin(turn), np.cos(polar) * np.ones_like(turn), np.sin(polar) * np.cos(turn)],
        axis=-1,
    )
    points = np.concatenate([[[0, 1, 0]], (ring * radius[..., None]).reshape(-1, 3), [[0, -1, 0]]])

    # Corners of a cell: a b above, c d below, going east.
    a = 1 + np.arange((rows - 2) * columns).reshape(rows - 2, columns)
    b, c = np.roll(a, -1, axis=1), a + columns
    d = np.roll(c, -1, axis=1)
    first, last = np.arange(1, columns + 1), len(points) - 1 - columns + np.arange(columns)
    faces = [
        np.stack([np.zeros_like(first), first, np.roll(first, -1)], axis=-1),
        np.stack([a, c, d], axis=-1).reshape(-1, 3),
        np.stack([a, d, b], axis=-1).reshape(-1, 3),
        np.stack([last, np.full_like(last, len(points) - 1), np.roll(last, -1)], axis=-1),
    ]
    return points.astype(np.float32), np.concatenate(faces).astype(np.int32)
