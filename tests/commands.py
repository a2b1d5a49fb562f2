"""The command line as people run it: a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import eyeline

LONGEST_WAIT = 180.0  # seconds: kernels may have to be compiled first


def started(folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """`eyeline ARGUMENTS`, running in a folder."""
    return subprocess.Popen(
        [sys.executable, "-m", "eyeline", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(Path(eyeline.__file__).parent.parent)},
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def ended(folder: Path, *arguments: str) -> tuple[int, str, str]:
    """Exit code, output and errors of `eyeline ARGUMENTS`."""
    process = started(folder, *arguments)
    out, error = process.communicate(timeout=LONGEST_WAIT)
    return process.returncode, out, error


def wait_until(truth: Callable[[], bool], process: subprocess.Popen[str]) -> None:
    """Look again and again until `truth` holds; fails if the process ends or the longest wait is over."""
    ends = time.monotonic() + LONGEST_WAIT
    while not truth():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < ends, "waited for too long"
        try:
            process.wait(0.01)
        except subprocess.TimeoutExpired:
            continue
