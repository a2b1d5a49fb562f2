"""Threads that kernels run on."""

from __future__ import annotations

import os
import signal

import pytest

from eyeline.jit import share

SECONDS = 20  # for what takes milliseconds


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")
def test_work_is_shared_in_a_forked_process_too() -> None:
    assert share(lambda part: part * part, 3) == [0, 1, 4]
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)  # ends the child, if it hangs
        os._exit(7 if share(lambda part: part * part, 3) == [0, 1, 4] else 1)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 7


def test_an_error_in_any_part_is_raised() -> None:
    for wrong in range(3):
        with pytest.raises(ZeroDivisionError):
            share(lambda part, wrong=wrong: 1 // (part - wrong), 3)
