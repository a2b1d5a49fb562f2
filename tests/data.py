"""Where the test data lies: real models and motion that are not part of the project."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parent.parent


def folder() -> Path:
    """EYELINE_TEST_DATA, or shared/data beside the project."""
    return Path(os.environ.get("EYELINE_TEST_DATA", PROJECT.parent / "shared" / "data"))


def data(name: str) -> Path:
    """The file of this name; skips the test where it is absent."""
    path = folder() / name
    if not path.exists():
        pytest.skip(f"test data {name} is not in {folder()}; set EYELINE_TEST_DATA")
    return path


def every(pattern: str) -> list[Path]:
    """All test data of a pattern, sorted; empty where there is none."""
    return sorted(folder().glob(pattern))
