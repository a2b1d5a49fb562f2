"""Two kinds of work side by side: the next frames are made while earlier ones are written."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")

AHEAD = 3  # made but not yet written: bounds the memory


def overlapped(items: Iterable[Item], write: Callable[[Item], None]) -> None:
    """Call `write` with each item, in order, on a thread of its own, while `items` makes the next.

    An error on either side ends both and is raised here.
    """
    waiting: deque[Future[None]] = deque()
    with ThreadPoolExecutor(1, thread_name_prefix="eyeline-encoder") as thread:
        try:
            for item in items:
                waiting.append(thread.submit(write, item))
                if len(waiting) > AHEAD:
                    waiting.popleft().result()
            while waiting:
                waiting.popleft().result()
        finally:
            for one in waiting:
                one.cancel()
