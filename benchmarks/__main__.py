"""All benchmarks, one process each: `python -m benchmarks [name ...]`.

A benchmark is a module here with a `main()` that measures and calls `results.record`.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from benchmarks import peers

SHARED = {"__init__", "__main__", "peers", "results", "table"}


def main(names: list[str]) -> int:
    known = sorted(file.stem for file in Path(__file__).parent.glob("*.py") if file.stem not in SHARED)
    unknown = set(names) - set(known)
    if unknown:
        print(
            f"there is no benchmark {', '.join(sorted(unknown))}; there is {', '.join(known)}",
            file=sys.stderr,
        )
        return 2
    failed = []
    for name in names or known:
        print(f"--- {name}: two spinning threads get {peers.free_cores():.2f} cores", flush=True)
        if subprocess.run([sys.executable, "-m", f"benchmarks.{name}"], check=False).returncode:
            failed.append(name)
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return len(failed) > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
