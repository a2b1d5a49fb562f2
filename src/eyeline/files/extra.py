"""Libraries of the extra `draw`: imported when they are needed, or refused in a sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from eyeline.errors import OptionError


@contextmanager
def extra(reads: str) -> Iterator[None]:
    """Around an import that may fail; reads: what it is needed for, as errors call it."""
    try:
        yield
    except ModuleNotFoundError as error:
        raise OptionError(f"{reads} need what is not installed; pip install eyeline[draw]") from error
