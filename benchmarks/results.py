"""What was measured, ours beside a peer, kept in results.json; the README's table is made from it."""

from __future__ import annotations

import json
import os
import platform
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path

from benchmarks import peers

FILE = Path(__file__).with_name("results.json")


@dataclass(frozen=True)
class Row:
    """One thing measured, in turn with a peer in one run, or alone."""

    what: str  # ids and depth, 1920x1080, 80k faces
    ours: float  # in `unit`
    theirs: float | None = None  # in `unit`; None where there is no peer
    against: str = ""  # the peer, with its version
    unit: str = "ms"
    bar: str = ""  # what it is held to: "<= 1/4", "<= 20 s"

    def __str__(self) -> str:
        mine = f"{self.what:58} {self.ours:10.4g} {self.unit}"
        if self.theirs is None:
            return f"{mine}   {'':34} bar {self.bar}"
        return f"{mine}   {self.against} {self.theirs:.4g} {self.unit}: {ratio(self)}   bar {self.bar}"


def ratio(row: Row) -> str:
    """Ours as a part of theirs: '1/5.3', or '1.2' where ours is more."""
    if row.theirs is None:
        return ""
    return f"1/{row.theirs / row.ours:.1f}" if row.ours <= row.theirs else f"{row.ours / row.theirs:.1f}"


def record(program: str, rows: list[Row]) -> None:
    """Print the rows of one program and keep them, in place of those it measured before."""
    kept = load()
    kept[program] = rows
    machine = {
        "processor": processor(),
        "cores": len(os.sched_getaffinity(0)),
        "free_cores": round(peers.free_cores(), 2),
    }
    machine |= {name: version(name) for name in ("numpy", "numba")} | {"python": platform.python_version()}
    data = {"machine": machine, "rows": {name: [asdict(row) for row in kept[name]] for name in sorted(kept)}}
    FILE.write_text(json.dumps(data, indent=1) + "\n")
    for row in rows:
        print(row, flush=True)


def load() -> dict[str, list[Row]]:
    """All rows measured so far, by program."""
    if not FILE.exists():
        return {}
    return {name: [Row(**row) for row in rows] for name, rows in json.loads(FILE.read_text())["rows"].items()}


def machine() -> dict[str, str | float]:
    """What the rows were measured on."""
    described: dict[str, str | float] = json.loads(FILE.read_text())["machine"]
    return described


def processor() -> str:
    """The processor's name as the system tells it."""
    listing = Path("/proc/cpuinfo")
    for line in listing.read_text().splitlines() if listing.exists() else ():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
