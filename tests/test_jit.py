"""Kernels kept on disk: loaded by the next process, and compiled again where a file is damaged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from eyeline import jit


@jit.helper
def twice(number):
    return number * np.int64(2)


@jit.kernel
def double(numbers):
    for place in range(len(numbers)):
        numbers[place] = twice(numbers[place])


def run_fresh() -> tuple[int, int]:
    """Run `double` as a new process would; how often it was loaded, and how often compiled."""
    fresh = jit.Kernel(double.function, double.options)
    numbers = np.arange(5)
    fresh(numbers)
    assert numbers.tolist() == [0, 2, 4, 6, 8]
    stats = fresh.compiled().stats
    return len(stats.cache_hits), len(stats.cache_misses)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("EYELINE_CACHE_DIR", str(tmp_path))
    jit.cache_folder.cache_clear()
    yield tmp_path
    jit.cache_folder.cache_clear()


def test_the_second_process_loads_what_the_first_has_compiled(folder: Path) -> None:
    assert run_fresh() == (0, 1)
    assert run_fresh() == (1, 0)


def test_a_kept_kernel_needs_no_dispatcher_of_what_it_calls(folder: Path) -> None:
    run_fresh()
    fresh = jit.Kernel(double.function, double.options)
    fresh(np.arange(5))
    assert isinstance(fresh.compiled().py_func.__globals__["twice"], jit.Helper)


@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
@pytest.mark.parametrize("damage", ["empty", "cut", "other", "bent at the end"])
def test_a_damaged_file_is_compiled_again(folder: Path, suffix: str, damage: str) -> None:
    run_fresh()
    (file,) = folder.rglob(f"*{suffix}")
    whole = file.read_bytes()
    half = len(whole) // 2
    bent = {
        "empty": b"",
        "cut": whole[:half],
        "other": b"not a kernel" * 9,
        "bent at the end": whole[:-2] + bytes([whole[-2] ^ 1]) + whole[-1:],
    }
    file.write_bytes(bent[damage])
    run_fresh()
    assert run_fresh() == (1, 0)


def test_machine_code_with_a_wrong_bit_never_runs(folder: Path) -> None:
    run_fresh()
    (file,) = folder.rglob("*.nbc")
    whole = file.read_bytes()
    for place in np.random.default_rng(3).integers(0, len(whole), 4):
        bent = bytearray(whole)
        bent[place] ^= 16
        file.write_bytes(bytes(bent))
        assert run_fresh() == (0, 1)
