"""Kernels kept on disk: loaded by the next process, and compiled again where what they do has changed."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from eyeline import jit
from eyeline.jit import sharing
from eyeline.jit.fingerprint import fingerprint


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


@pytest.mark.parametrize("damage", ["empty", "cut", "other", "bent at the end"])
def test_a_damaged_file_is_compiled_again(folder: Path, damage: str) -> None:
    run_fresh()
    (file,) = folder.rglob("*.kernel")
    whole = file.read_bytes()
    bent = {
        "empty": b"",
        "cut": whole[: len(whole) // 2],
        "other": b"not a kernel" * 9,
        "bent at the end": whole[:-2] + bytes([whole[-2] ^ 1]) + whole[-1:],
    }
    file.write_bytes(bent[damage])
    assert run_fresh() == (0, 1)
    assert run_fresh() == (1, 0)


def test_machine_code_with_a_wrong_bit_never_runs(folder: Path) -> None:
    run_fresh()
    (file,) = folder.rglob("*.kernel")
    whole = file.read_bytes()
    for place in np.random.default_rng(3).integers(0, len(whole), 4):
        bent = bytearray(whole)
        bent[place] ^= 16
        file.write_bytes(bytes(bent))
        assert run_fresh() == (0, 1)


def test_a_folder_that_cannot_be_made_keeps_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("EYELINE_CACHE_DIR", str(tmp_path / "file"))
    jit.cache_folder.cache_clear()
    try:
        assert run_fresh() == (0, 1)
        assert run_fresh() == (0, 1)
    finally:
        jit.cache_folder.cache_clear()


# --- what a kernel is compiled from -------------------------------------------------------------------

MODULE = """
from eyeline.jit import helper, kernel
{constants}

@helper
def shifted(number):
    {helper_says}
    return number {helper_does}

@kernel
def shift(numbers):
    {kernel_says}
    for place in range(len(numbers)):
        numbers[place] = shifted(numbers[place]) * FACTOR
"""
AS_IT_WAS = {
    "constants": "FACTOR = 2",
    "helper_says": '"""As it was."""',
    "helper_does": "+ 1",
    "kernel_says": '"""As it was."""',
}


def fingerprint_of(**changes: str) -> str:
    """The fingerprint of `shift` where some lines of its module have changed."""
    scope: dict[str, object] = {"__name__": "shifting"}
    exec(compile(MODULE.format(**(AS_IT_WAS | changes)), "shifting.py", "exec"), scope)
    shift = scope["shift"]
    return fingerprint(shift.function, shift.options)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "change",
    [
        {"helper_does": "+ 2"},
        {"helper_does": "+ 1.0"},
        {"helper_does": "- 1"},
        {"constants": "FACTOR = 3"},
        {"constants": "FACTOR = 2.0"},
        {"constants": "import numpy\nFACTOR = numpy.int8(2)"},
        {"kernel_says": "numbers[0] = 0"},
    ],
    ids=str,
)
def test_what_changes_a_result_changes_the_fingerprint(change: dict[str, str]) -> None:
    assert fingerprint_of(**change) != fingerprint_of()


@pytest.mark.parametrize(
    "change",
    [
        {"constants": "\n\n# moved down\nFACTOR = 2\nNOT_READ = 7"},
        {"helper_says": '"""In other words."""'},
        {"kernel_says": '"""In other words."""\n    # and with a reason'},
    ],
    ids=str,
)
def test_words_and_places_leave_the_fingerprint(change: dict[str, str]) -> None:
    assert fingerprint_of(**change) == fingerprint_of()


def test_options_are_part_of_the_fingerprint() -> None:
    function = double.function
    assert fingerprint(function, {"fastmath": True}) != fingerprint(function, {})


@pytest.mark.parametrize("value", ["[2]", "{2: 3}", "lambda: 2", "__import__('os')"])
def test_a_kernel_that_reads_what_can_change_unseen_is_refused(value: str) -> None:
    with pytest.raises(TypeError, match="kernels read numbers"):
        fingerprint_of(constants=f"FACTOR = {value}")


def test_every_kernel_of_the_package_has_a_fingerprint() -> None:
    from eyeline.render import warming

    assert warming.errands()
    ours = [one for one in jit.KERNELS if one.function.__module__.startswith("eyeline.")]
    told = [fingerprint(one.function, one.options) for one in ours if one.options.get("cache")]
    assert len(told) == len(set(told))


@pytest.fixture
def pool(monkeypatch: pytest.MonkeyPatch) -> Iterator[sharing.Pool]:
    monkeypatch.setenv("EYELINE_THREADS", "2")
    jit.threads.cache_clear()
    own = sharing.Pool()
    monkeypatch.setattr(sharing, "_pool", lambda: own)
    yield own
    own.executor.shutdown()
    jit.threads.cache_clear()


def test_what_no_thread_has_begun_is_done_by_the_caller(pool: sharing.Pool) -> None:
    gate = threading.Event()
    busy = pool.executor.submit(gate.wait)
    try:
        assert jit.share(lambda part: (part, threading.get_ident()), 3) == [
            (part, threading.get_ident()) for part in range(3)
        ]
    finally:
        gate.set()
    assert busy.result()


def test_threads_stay_off_the_core_of_their_caller(
    pool: sharing.Pool, monkeypatch: pytest.MonkeyPatch
) -> None:
    member = pool.executor.submit(threading.get_native_id).result()
    cores = os.sched_getaffinity(0)
    for core in cores:
        monkeypatch.setattr(pool, "_core", lambda core=core: core)
        pool.step_aside()
        assert os.sched_getaffinity(member) == (cores - {core} or cores)
