"""Short work without the garbage collector."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def uncollected() -> Iterator[None]:
    """Collect no garbage in the block.

    Importing makes very many objects that stay; looking through them again and again took 0.1 s of the 1.2 s
    of processor time from start to first picture. For one picture only: a film must give its frames back.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
