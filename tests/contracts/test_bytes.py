"""Every method gives the same bytes and counters on any threads, on any processor, and uncompiled."""

from __future__ import annotations

from pathlib import Path

import pytest

from elsewhere import digest_elsewhere
from eyeline.visibility import METHODS

every_method = pytest.mark.parametrize("name", [name for name, method in METHODS.items() if method.answers])


@every_method
def test_one_thread_and_many_give_the_same_bytes_and_counters(name: str) -> None:
    assert len({digest_elsewhere(name, EYELINE_THREADS=count) for count in ("1", "2", "5")}) == 1


@every_method
def test_kernels_that_run_uncompiled_give_the_same_bytes(name: str) -> None:
    assert digest_elsewhere(name, "small", NUMBA_DISABLE_JIT="1") == digest_elsewhere(name, "small")


@pytest.mark.slow
@every_method
def test_any_processor_gives_the_same_bytes(name: str, tmp_path: Path) -> None:
    """Compiled for none of this processor's own instructions."""
    plain = digest_elsewhere(
        name,
        NUMBA_CPU_NAME="generic",
        NUMBA_CPU_FEATURES="",
        OPENBLAS_CORETYPE="Prescott",
        EYELINE_CACHE_DIR=str(tmp_path),
    )
    assert plain == digest_elsewhere(name)
