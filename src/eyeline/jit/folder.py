"""Where compiled kernels are kept between processes."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path


@cache
def cache_folder() -> Path | None:
    """The folder of compiled kernels, or None where there can be none.

    EYELINE_CACHE_DIR overrides the user's cache directory. One that cannot be written, as in the image of a
    container, is read nevertheless.
    """
    folder = cache_root() / "kernels"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return folder


def cache_root() -> Path:
    """The user's cache directory for eyeline."""
    if chosen := os.environ.get("EYELINE_CACHE_DIR"):
        return Path(chosen)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "eyeline"


@cache
def announce(line: str) -> None:
    """One line on the terminal, once, and nothing in a pipe."""
    if sys.stderr is not None and sys.stderr.isatty():
        print(line, file=sys.stderr, flush=True)
