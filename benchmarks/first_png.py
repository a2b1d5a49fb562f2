"""From the start of a process to its first PNG, beside PyVista; and with no kernel compiled yet.

Both draw the same model from a file at 1280x720, each as its documentation shows for a script. Ours through
the command line; theirs is `python -c` with four statements. Ours has shadows and four samples a pixel.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

from benchmarks import peers, results

PROJECT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("EYELINE_TEST_DATA", PROJECT.parent / "shared" / "data"))
MODEL = DATA / "mesh" / "spot.obj"
PEER = """
import sys, pyvista
plotter = pyvista.Plotter(off_screen=True, window_size=(1280, 720))
plotter.add_mesh(pyvista.read(sys.argv[1]))
plotter.screenshot(sys.argv[2])
"""


def run(*command: str, **changed: str) -> None:
    """A process, to its end; it keeps its byte code, as an installed package does."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    subprocess.run([sys.executable, *command], check=True, capture_output=True, env=environment | changed)


def main(_: list[str]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        picture = str(Path(folder) / "first.png")
        ours = ["-m", "eyeline", "render", str(MODEL), "-o", picture]
        theirs = ["-c", PEER, str(MODEL), picture]
        duel = peers.alternate(lambda: run(*ours), lambda: run(*theirs), rounds=7)
        rows = [
            results.Row(
                "process start to first PNG, kernels kept", duel.ours, duel.theirs,
                f"PyVista {version('pyvista')}", "s", "<= 1/2",
            )
        ]  # fmt: skip
        run("-c", "import eyeline")
        imported = min(peers.seconds(lambda: run("-c", "import eyeline")) for _ in range(5))
        rows.append(
            results.Row("import eyeline, with the interpreter's start", imported, unit="s", bar="<= 0.3 s")
        )
        first = peers.seconds(lambda: run(*ours, EYELINE_CACHE_DIR=str(Path(folder) / "kernels")))
        rows.append(
            results.Row("process start to first PNG, no kernels kept", first, unit="s", bar="<= 20 s")
        )
    results.record("first_png", rows)


if __name__ == "__main__":
    main(sys.argv[1:])
