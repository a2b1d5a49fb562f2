"""resvg in a process of its own: what breaks it, or keeps it busy for ever, breaks nothing else."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from eyeline.errors import FileError
from eyeline.files.extra import extra

SECONDS = 60.0  # that a drawing may take
# Without Python's own start-up, which would take longer than the drawing
PROGRAM = """
import sys
sys.path.append(sys.argv[1])
import resvg_py
text = sys.stdin.buffer.read().decode()
sys.stdout.buffer.write(bytes(resvg_py.svg_to_bytes(svg_string=text, skip_system_fonts=True)))
"""


def png_of(text: str) -> bytes:
    """A checked drawing as PNG, of the size it says. Refused: what cannot be drawn, or takes too long."""
    with extra("SVG drawings"):
        import resvg_py
    where = str(Path(resvg_py.__file__).parent.parent)
    command = [sys.executable, "-I", "-S", "-c", PROGRAM, where]
    try:
        done = subprocess.run(command, input=text.encode(), capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise FileError(f"takes more than {SECONDS:g} seconds to draw; simplify it") from error
    if done.returncode != 0 or not done.stdout:
        told = done.stderr.decode(errors="replace").strip().splitlines()
        reason = told[-1][:120] if told and done.returncode == 1 else "its numbers may be too large"
        raise FileError(f"cannot be drawn ({reason}); save it again")
    return done.stdout
