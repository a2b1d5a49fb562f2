"""The threads kernels run on."""

from __future__ import annotations

import ctypes
import os
import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from functools import cache
from queue import SimpleQueue
from typing import Any, TypeVar

Result = TypeVar("Result")


@cache
def threads() -> int:
    """How many threads kernels run on: EYELINE_THREADS or NUMBA_NUM_THREADS, else the cores we may use."""
    for name in ("EYELINE_THREADS", "NUMBA_NUM_THREADS"):
        if (value := os.environ.get(name, "")).isdigit() and int(value) > 0:
            return int(value)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Pool:
    """The threads that work beside their caller's."""

    def __init__(self) -> None:
        self._members: list[int] = []  # native numbers of the threads
        self._clear_of = -1  # the core they are kept off
        self._core = ctypes.CDLL(None).sched_getcpu if hasattr(os, "sched_setaffinity") else lambda: -1
        self._waiting: SimpleQueue[tuple[Future[Any], Callable[[int], Any], int]] = SimpleQueue()
        for number in range(max(1, threads() - 1)):
            # Python's own pool waits for its threads at exit, for ever if a signal struck while it made one
            threading.Thread(target=self._serve, name=f"eyeline-{number}", daemon=True).start()

    def submit(self, task: Callable[[int], Result], part: int) -> Future[Result]:
        """Have task(part) done by the next thread that is free."""
        future: Future[Result] = Future()
        self._waiting.put((future, task, part))
        return future

    def _serve(self) -> None:
        self._members.append(threading.get_native_id())
        self._clear_of = -1
        while True:
            self._do(*self._waiting.get())

    def _do(self, future: Future[Result], task: Callable[[int], Result], part: int) -> None:
        if not future.set_running_or_notify_cancel():
            return
        try:
            future.set_result(task(part))
        except BaseException as reason:
            future.set_exception(reason)

    def step_aside(self) -> None:
        """Keep the threads off the core their caller runs on, if there is another one for each.

        A virtual machine's core that has slept a while does not count as idle: Linux then wakes a thread on
        its caller's core, where it waits until the caller is done.
        """
        core = self._core()
        if core == self._clear_of:
            return
        self._clear_of = core
        others = os.sched_getaffinity(0) - {core}
        if len(self._members) <= len(others):
            with suppress(OSError):  # a sandbox may forbid it; the threads then stay where they are
                for member in self._members:
                    os.sched_setaffinity(member, others)


@cache
def _pool() -> Pool:
    return Pool()


if hasattr(os, "register_at_fork"):
    # Threads do not follow into a forked process: work shared there would wait for them for ever
    os.register_at_fork(after_in_child=_pool.cache_clear)


def share(task: Callable[[int], Result], parts: int) -> list[Result]:
    """[task(0), ... task(parts - 1)], side by side; part 0 on the caller's thread.

    A task must not share again: it would wait for the thread it runs on.
    """
    if parts == 1:
        return [task(0)]
    pool = _pool()
    pool.step_aside()
    rest = [pool.submit(task, part) for part in range(1, parts)]
    first = task(0)
    # A part that no thread has begun yet is done here: nobody waits for a core that is busy otherwise.
    # The threads take the first of them, so the caller begins with the last, and they meet.
    later = [
        task(part) if rest[part - 1].cancel() else rest[part - 1].result() for part in range(parts - 1, 0, -1)
    ]
    return [first, *reversed(later)]


def in_parts(parts: int, kernel: Callable[..., Result], *arguments: object) -> list[Result]:
    """`kernel(part, parts, *arguments)` of every part, side by side."""
    return share(lambda part: kernel(part, parts, *arguments), parts)
