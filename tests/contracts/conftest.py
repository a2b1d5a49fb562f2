"""What the contracts tell at the end of a run: the pixels that are beyond the oracle's judgement."""

from __future__ import annotations

import pytest


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """A table of the undecidable share of every model's pictures, by their size."""
    rows = {
        report.nodeid: told["undecidable"]
        for report in terminalreporter.getreports("passed") + terminalreporter.getreports("failed")
        if "undecidable" in (told := dict(report.user_properties))
    }
    if not rows:
        return
    sizes = sorted({size for row in rows.values() for size in row})
    terminalreporter.section("pixels that the oracle cannot decide")
    titles = (f"{width}x{height}" for width, height in sizes)
    terminalreporter.line(f"{'model':30}" + "".join(f"{title:>12}" for title in titles))
    for nodeid, row in sorted(rows.items()):
        model = nodeid.partition("[")[2].removesuffix("]")
        shares = (f"{row[size][0] / row[size][1]:.3%}" if size in row else "" for size in sizes)
        terminalreporter.line(f"{model:30}" + "".join(f"{share:>12}" for share in shares))
