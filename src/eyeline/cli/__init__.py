"""The command line: parses units, opens files, calls one function, prints."""

from __future__ import annotations

from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> int:
    """Run `eyeline ARGUMENTS` (sys.argv if left out) and give its exit code."""
    from eyeline.cli.outcome import run

    return run(arguments)
