"""Kernels kept on disk: loaded by the next process, and compiled again where what they do has changed."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from eyeline import jit
from eyeline.jit import sharing
from eyeline.jit.fingerprint import fingerprint
from eyeline.jit.forms import form_of, told


@jit.helper
def twice(number):
    return number * np.int64(2)


@jit.kernel
def double(numbers):
    for place in range(len(numbers)):
        numbers[place] = twice(numbers[place])


@dataclass
class Compiler:
    """Counts what is compiled."""

    count: int = 0


@pytest.fixture
def compiler(monkeypatch: pytest.MonkeyPatch) -> Compiler:
    from eyeline.jit import compiler

    counted, compiled = Compiler(), compiler.compiled

    def count(function: Any, options: Any, form: Any) -> Any:
        counted.count += 1
        return compiled(function, options, form)

    monkeypatch.setattr(compiler, "compiled", count)
    return counted


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("EYELINE_CACHE_DIR", str(tmp_path))
    jit.cache_folder.cache_clear()
    yield tmp_path
    jit.cache_folder.cache_clear()


def run_fresh() -> None:
    """Run `double` as a new process would."""
    numbers = np.arange(5)
    jit.Kernel(double.function, double.options)(numbers)  # type: ignore[attr-defined]
    assert numbers.tolist() == [0, 2, 4, 6, 8]


def test_the_second_process_loads_what_the_first_has_compiled(folder: Path, compiler: Compiler) -> None:
    run_fresh()
    run_fresh()
    assert compiler.count == 1


@pytest.mark.parametrize("damage", ["empty", "cut", "other", "bent at the end"])
def test_a_damaged_file_is_compiled_again(folder: Path, compiler: Compiler, damage: str) -> None:
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
    run_fresh()
    assert compiler.count == 2
    run_fresh()
    assert compiler.count == 2


def test_machine_code_with_a_wrong_bit_never_runs(folder: Path, compiler: Compiler) -> None:
    run_fresh()
    (file,) = folder.rglob("*.kernel")
    whole = file.read_bytes()
    for before, place in enumerate(np.random.default_rng(3).integers(0, len(whole), 4), 1):
        bent = bytearray(whole)
        bent[place] ^= 16
        file.write_bytes(bytes(bent))
        run_fresh()
        assert compiler.count == 1 + before


def test_a_folder_that_cannot_be_made_keeps_nothing(
    tmp_path: Path, compiler: Compiler, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("EYELINE_CACHE_DIR", str(tmp_path / "file"))
    jit.cache_folder.cache_clear()
    try:
        run_fresh()
        run_fresh()
    finally:
        jit.cache_folder.cache_clear()
    assert compiler.count == 2


def test_a_folder_that_cannot_be_written_keeps_nothing(folder: Path, compiler: Compiler) -> None:
    kernels = jit.cache_folder()
    assert kernels is not None
    kernels.rmdir()
    run_fresh()
    run_fresh()
    assert compiler.count == 2


# --- arguments and results ------------------------------------------------------------------------------


class Pair(NamedTuple):
    first: np.ndarray
    rest: tuple[int, float]


@jit.kernel
def gathered(pair, weights, sign, scale):
    total = 0.0
    for row in range(pair.first.shape[0]):
        for column in range(pair.first.shape[1]):
            total += pair.first[row, column] * weights[column]
    room = np.empty(3, np.float64)
    room[:] = total * scale + pair.rest[0] - pair.rest[1]
    return room.sum() if sign else -room.sum()


@jit.kernel
def count_of(numbers, least):
    count = 0
    for number in numbers:
        if number >= least:
            count += 1
    return count


GRID = np.arange(12.0).reshape(3, 4)


EVERY_SECOND = np.arange(48.0).reshape(6, 8)[::2, ::2]


@pytest.mark.parametrize(
    ("grid", "sign", "scale"),
    [
        (GRID, True, 2),
        (GRID.T.copy().T, np.bool(False), np.int64(2)),
        (EVERY_SECOND, True, 2.5),
        (GRID, True, np.float32(2.5)),
        (GRID, False, np.int32(2)),
        (GRID, False, True),
    ],
    ids=["C order", "Fortran order", "no order", "float32", "int32", "bool"],
)
def test_a_kernel_computes_what_its_python_does(grid: np.ndarray, sign: Any, scale: Any) -> None:
    arguments = (Pair(grid, (3, 0.5)), np.arange(4, dtype=np.float32), sign, scale)
    expected = gathered.function(*arguments)  # type: ignore[attr-defined]
    found = gathered(*arguments)
    assert type(found) is float
    assert found == expected


@pytest.mark.parametrize("dtype", [np.uint8, np.int32, np.int64, np.float32, np.float64])
def test_arrays_of_every_type_are_read(folder: Path, dtype: type) -> None:
    numbers = np.array([1, 5, 2, 9, 5], dtype)
    assert count_of(numbers, 5) == 3
    numbers.flags.writeable = False
    assert count_of(numbers, 5) == 3


def test_a_number_too_large_for_a_kernel_is_refused(folder: Path) -> None:
    with pytest.raises(OverflowError):
        count_of(np.arange(3), 2**63)


def test_a_kernel_gives_nothing_when_it_returns_nothing(folder: Path) -> None:
    assert double(np.arange(3)) is None  # type: ignore[func-returns-value]


def test_no_reference_is_lost_or_kept(folder: Path) -> None:
    numbers, grid, rest = np.arange(3000), np.arange(4.0).reshape(2, 2), (70000, 0.5)
    calls = 1000

    def references() -> list[int]:
        return [sys.getrefcount(one) for one in (numbers, grid, rest, None)]

    def call() -> None:
        count_of(numbers, 70000)
        gathered(Pair(grid, rest), np.ones(2, np.float32), True, 2)
        double(numbers)

    call()
    before = references()
    for _ in range(calls):
        call()
    assert np.abs(np.subtract(references(), before)).max() < calls // 10


class Shuffled:
    """Where a class of another version of the package stands."""

    class Pair(NamedTuple):
        rest: tuple[int, float]
        first: np.ndarray


def test_fields_of_a_named_tuple_are_found_by_name() -> None:
    Shuffled.Pair.__qualname__ = Pair.__qualname__
    ours, theirs = Pair(GRID, GRID), Shuffled.Pair(GRID, GRID)  # type: ignore[arg-type]
    assert told(form_of((ours,))) != told(form_of((theirs,)))


@jit.kernel
def halves(numbers):
    first = numbers[: len(numbers) // 2]
    doubled = np.empty((len(numbers), 2), np.float64)
    for place in range(len(numbers)):
        doubled[place, 0] = numbers[place]
        doubled[place, 1] = 2 * numbers[place]
    return first, doubled, doubled[1:, 1], (len(first), numbers[0] > 0)


def test_a_kernel_returns_arrays_and_tuples_of_them(folder: Path) -> None:
    numbers = np.arange(1, 8, dtype=np.float32)
    first, doubled, column, (count, positive) = halves(numbers)
    assert (count, positive) == (3, True)
    np.testing.assert_array_equal(first, numbers[:3])
    np.testing.assert_array_equal(doubled, np.stack([numbers, 2 * numbers], axis=1))
    np.testing.assert_array_equal(column, 2 * numbers[1:])
    assert np.shares_memory(first, numbers)
    assert np.shares_memory(column, doubled)
    assert (first.dtype, doubled.dtype) == (np.float32, np.float64)


def test_what_a_kernel_returns_lives_as_long_as_it_is_held(folder: Path) -> None:
    column = halves(np.arange(1.0, 4000.0))[2]
    for _ in range(100):
        halves(np.zeros(3999))
    np.testing.assert_array_equal(column, 2 * np.arange(2.0, 4000.0))


def test_what_a_kernel_returns_is_freed(folder: Path) -> None:
    """Each call makes 8 MB; a thousand would not fit."""
    resource = pytest.importorskip("resource")
    numbers = np.zeros(500_000)
    halves(numbers)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(100):
        halves(numbers)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # kB


def test_forms_may_alternate(folder: Path) -> None:
    """The guard in the machine code tells every difference that a form does."""
    numbers = np.arange(6, dtype=np.float32)
    frozen = numbers.copy()
    frozen.flags.writeable = False
    odd = np.zeros(25, np.uint8)[1:].view(np.float32)
    odd[:] = numbers
    swapped = numbers.astype(">f4").astype(np.float64)
    for _ in range(2):
        for one in (numbers, frozen, odd, swapped, numbers[::2], numbers.astype(np.int16)):
            for least in (2, np.int64(2), 2.0, np.float32(2), np.float64(2), True):
                assert count_of(one, least) == (one >= least).sum()


def test_an_array_of_one_row_has_the_form_of_others() -> None:
    assert form_of((np.ones((1, 4)), np.ones((3, 4))))[0] == form_of((np.ones((3, 4)),))[0]


def test_too_few_arguments_are_refused_and_too_many(folder: Path) -> None:
    count_of(np.arange(3), 1)
    for arguments in ((np.arange(3),), (np.arange(3), 1, 2)):
        with pytest.raises(TypeError):
            count_of(*arguments)


def test_other_arguments_are_refused(folder: Path) -> None:
    with pytest.raises(TypeError, match="a kernel takes no str"):
        count_of("words", 5)


# --- processes ------------------------------------------------------------------------------------------

PICTURE = """
import sys
import eyeline as el
seen = el.visible(el.samples.cornell_box(), size=(32, 24))
sys.stdout.buffer.write(seen.face.tobytes() + seen.depth.tobytes())
sys.stderr.write(str("numba" in sys.modules))
"""


def processes(count: int, **changes: str) -> list[tuple[bytes, bytes]]:
    """What `PICTURE` gives in processes side by side: what is seen, and whether Numba was imported."""
    running = [
        subprocess.Popen(
            [sys.executable, "-c", PICTURE],
            env=os.environ | changes,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        for _ in range(count)
    ]
    return [process.communicate(timeout=300) for process in running]


def test_a_warm_process_sees_the_same_without_numba(tmp_path: Path) -> None:
    """Two processes fill one empty folder side by side, one reads it, one cannot keep anything."""
    first = processes(2, EYELINE_CACHE_DIR=str(tmp_path))
    warm = processes(1, EYELINE_CACHE_DIR=str(tmp_path))
    (tmp_path / "file").touch()
    homeless = processes(1, EYELINE_CACHE_DIR=str(tmp_path / "file"))
    assert {seen for seen, _ in first + warm + homeless} == {first[0][0]}
    assert len(first[0][0]) == 32 * 24 * (4 + 4)
    assert [told for _, told in warm + homeless] == [b"False", b"True"]
    assert [
        path for path in tmp_path.rglob("*") if path.is_file() and path.suffix not in (".kernel", "")
    ] == []


def test_a_forked_process_runs_what_its_parent_has_loaded(folder: Path) -> None:
    run_fresh()
    child = os.fork() if hasattr(os, "fork") else None
    if child == 0:
        try:
            run_fresh()
            assert count_of(np.arange(3), 1) == 2
        except BaseException:
            os._exit(1)
        os._exit(0)
    if child is not None:
        assert os.waitpid(child, 0)[1] == 0


def test_threads_that_call_a_kernel_first_compile_it_once(folder: Path, compiler: Compiler) -> None:
    fresh = jit.Kernel(double.function, double.options)  # type: ignore[attr-defined]
    rows = np.ones((8, 1000), np.int64)
    jit.share(lambda part: fresh(rows[part]), len(rows))
    assert compiler.count == 1
    assert (rows == 2).all()


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
    prints = [fingerprint(one.function, one.options) for one in ours]
    assert len(prints) == len(set(prints))


@pytest.fixture
def pool(monkeypatch: pytest.MonkeyPatch) -> Iterator[sharing.Pool]:
    monkeypatch.setenv("EYELINE_THREADS", "2")
    jit.threads.cache_clear()
    own = sharing.Pool()
    monkeypatch.setattr(sharing, "_pool", lambda: own)
    yield own
    jit.threads.cache_clear()


def test_what_no_thread_has_begun_is_done_by_the_caller(pool: sharing.Pool) -> None:
    gate = threading.Event()
    busy = pool.submit(lambda _: gate.wait(), 0)
    try:
        assert jit.share(lambda part: (part, threading.get_ident()), 3) == [
            (part, threading.get_ident()) for part in range(3)
        ]
    finally:
        gate.set()
    assert busy.result()


def test_an_error_on_a_thread_reaches_its_caller(pool: sharing.Pool) -> None:
    begun = threading.Event()

    def fail(part: int) -> None:
        begun.set()
        raise ValueError(f"part {part}")

    failing = pool.submit(fail, 7)
    assert begun.wait(10)
    with pytest.raises(ValueError, match="part 7"):
        failing.result()
    assert pool.submit(lambda part: part, 8).result() == 8


def test_a_process_ends_though_its_threads_wait() -> None:
    """Also where a signal struck while they were made: nothing waits for them."""
    program = "from eyeline.jit import share; share(id, 3); import threading; print(threading.active_count())"
    environment = os.environ | {"EYELINE_THREADS": "3"}
    run = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=60
    )
    assert (run.returncode, run.stdout, run.stderr) == (0, "3\n", "")
    assert all(one.daemon for one in threading.enumerate() if one.name.startswith("eyeline-"))


def test_threads_stay_off_the_core_of_their_caller(
    pool: sharing.Pool, monkeypatch: pytest.MonkeyPatch
) -> None:
    member = pool.submit(lambda _: threading.get_native_id(), 0).result()
    cores = os.sched_getaffinity(0)
    for core in cores:
        monkeypatch.setattr(pool, "_core", lambda core=core: core)
        pool.step_aside()
        assert os.sched_getaffinity(member) == (cores - {core} or cores)


def test_kernels_see_the_same_as_the_python_they_are_written_in() -> None:
    program = (
        "import eyeline as el; "
        "print(el.visible(el.samples.cyclic_overlap(), size=(32, 18)).face.tobytes().hex()); "
        "print(el.draw(el.samples.cube(), size=(320, 180), hidden='dashed')._repr_svg_())"
    )
    told = [
        subprocess.run(
            [sys.executable, "-c", program], env=os.environ | {"NUMBA_DISABLE_JIT": off},
            capture_output=True, text=True, timeout=120, check=True,
        ).stdout
        for off in ("0", "1")
    ]  # fmt: skip
    assert told[0] == told[1]
