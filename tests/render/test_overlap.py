from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from eyeline.render.overlap import AHEAD, overlapped


def test_items_are_written_in_order_on_another_thread() -> None:
    written: list[tuple[int, bool]] = []
    overlapped(
        range(20), lambda item: written.append((item, threading.current_thread() is threading.main_thread()))
    )
    assert written == [(item, False) for item in range(20)]


def test_making_runs_ahead_of_writing_but_not_far() -> None:
    may_write, furthest = threading.Semaphore(0), 0
    written = 0

    def write(_: int) -> None:
        nonlocal written
        may_write.acquire()
        written += 1

    def made() -> Iterator[int]:
        nonlocal furthest
        for item in range(30):
            furthest = max(furthest, item - written)
            may_write.release()
            yield item

    overlapped(made(), write)
    assert written == 30
    assert furthest <= AHEAD + 1


def test_a_failure_of_the_writer_stops_the_maker() -> None:
    made = 0

    def items() -> Iterator[int]:
        nonlocal made
        for item in range(10_000):
            made = item
            yield item

    def write(item: int) -> None:
        if item == 5:
            raise OSError("full")

    with pytest.raises(OSError, match="full"):
        overlapped(items(), write)
    assert made <= 5 + AHEAD + 1


def test_a_failure_of_the_maker_reaches_the_caller() -> None:
    def items() -> Iterator[int]:
        yield 1
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        overlapped(items(), lambda _: None)
