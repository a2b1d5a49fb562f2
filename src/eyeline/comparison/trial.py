"""One method on one scene: how long it takes, how much memory, what it counts."""

from __future__ import annotations

import ctypes
import statistics
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from eyeline.errors import EyelineError
from eyeline.geometry.memory import forget
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.samples import cube
from eyeline.scene.camera import Camera
from eyeline.visibility.method import Method

LEAST_ROUNDS, MOST_ROUNDS = 3, 15
PATIENCE = 1.0  # seconds that further rounds of one method may take
STATUS, CLEAR = Path("/proc/self/status"), Path("/proc/self/clear_refs")
FORGET_PEAK = "5"  # written to CLEAR: the peak is counted anew [proc_pid_clear_refs(5)]


@dataclass(frozen=True, eq=False)
class Trial:
    """What one method did."""

    method: Method
    answer: Any = None  # its Visible, or visible edges; None where it refused
    first: float = 0.0  # seconds of the first run, trees and tables built
    again: float = 0.0  # seconds, the median of the next runs
    memory: int | None = None  # bytes the process grew by at most in the first run; None where unknown
    refusal: str = ""  # why it does not answer this scene
    work: Mapping[str, int] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The method's."""
        return self.method.name


def tried(method: Method, projected: Projected) -> Trial:
    """A method on a projected scene, its kernels compiled before the clock starts."""
    with suppress(EyelineError):
        method(project(cube(), Camera.look_at((2, 2, 3), (0, 0, 0)), (8, 8)))
    give_back_memory()
    begun = time.perf_counter()
    try:
        answer, memory = with_peak(lambda: method(projected))
    except EyelineError as reason:
        return Trial(method, refusal=str(reason))
    first = time.perf_counter() - begun
    rounds: list[float] = []
    while len(rounds) < LEAST_ROUNDS or (sum(rounds) < PATIENCE and len(rounds) < MOST_ROUNDS):
        rounds.append(seconds(lambda: method(projected)))
        if sum(rounds) > LEAST_ROUNDS * PATIENCE:
            break
    return Trial(method, answer, first, statistics.median(rounds), memory, work=dict(answer.work))


def seconds(run: Callable[[], Any]) -> float:
    """How long one run takes."""
    begun = time.perf_counter()
    run()
    return time.perf_counter() - begun


def give_back_memory() -> None:
    """Let no memory that was freed serve again: what a run needs is then seen to grow."""
    forget()
    with suppress(OSError, AttributeError):  # only the GNU library has it
        ctypes.CDLL(None).malloc_trim(0)


def with_peak(run: Callable[[], Any]) -> tuple[Any, int | None]:
    """What a run gives, and the bytes the process grew by at most meanwhile; None where nobody tells."""
    try:
        CLEAR.write_text(FORGET_PEAK)
        before = resident("VmRSS")
    except (OSError, KeyError):
        return run(), None
    answer = run()
    return answer, max(0, resident("VmHWM") - before)


def resident(name: str) -> int:
    """A line of what Linux tells of this process, in bytes."""
    lines = dict(line.split(":", 1) for line in STATUS.read_text().splitlines())
    return 1024 * int(lines[name].split()[0])
