"""The threads kernels run on."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import TypeVar

Result = TypeVar("Result")


@cache
def threads() -> int:
    """How many threads kernels run on: EYELINE_THREADS or NUMBA_NUM_THREADS, else the cores we may use."""
    for name in ("EYELINE_THREADS", "NUMBA_NUM_THREADS"):
        if (value := os.environ.get(name, "")).isdigit() and int(value) > 0:
            return int(value)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max(1, threads() - 1), thread_name_prefix="eyeline")


if hasattr(os, "register_at_fork"):
    # Threads do not follow into a forked process: work shared there would wait for them for ever
    os.register_at_fork(after_in_child=_pool.cache_clear)


def share(task: Callable[[int], Result], parts: int) -> list[Result]:
    """[task(0), ... task(parts - 1)], side by side; part 0 on the caller's thread.

    A task must not share again: it would wait for the thread it runs on.
    """
    rest = [_pool().submit(task, part) for part in range(1, parts)]
    first = task(0)
    return [first, *(later.result() for later in rest)]
