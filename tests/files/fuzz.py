"""Readers under fire: good files, damaged at random, in a process of their own with little memory and time.

    fuzz([path, ...], runs=400, seed=1) -> findings

Each run damages one file of a model's folder, mostly the model, and reads it with `eyeline.files.load`. It
may answer, or raise an EyelineError in one line; whatever else happens is a finding, and so is a process
that dies.
As a program: python fuzz.py RUNS SEED MODEL...
"""

from __future__ import annotations

import io
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import zipfile
from collections.abc import Sequence
from pathlib import Path

from files.damaged_gltf import damaged_gltf

MEMORY = 3 * 2**30  # bytes of address space: libraries take the first one
SECONDS = 5.0  # for one file
NUMBERS = (
    b"0", b"-1", b"1", b"2", b"7", b"255", b"65536", b"2147483647", b"-2147483648", b"4294967295",
    b"99999999999999999999", b"1e38", b"1e39", b"-1e308", b"nan", b"inf", b"1e-45", b"0.5",
    b"", b"x", b"1/2", b"../x", b"//",
)  # fmt: skip
WORDS = (0, 1, 2, 255, 0x7F, 0x80, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000)


def fuzz(models: Sequence[Path], runs: int, seed: int) -> list[str]:
    """What went wrong in `runs` readings of damaged models, one line each."""
    command = [sys.executable, "-W", "error", __file__, str(runs), str(seed), *map(str, models)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            timeout=60 + runs * SECONDS,
            cwd=folder,
            env=os.environ | {"PYTHONPATH": os.pathsep.join(str(Path(one).resolve()) for one in sys.path)},
            check=False,
        )
    lines = done.stdout.splitlines()
    if done.returncode != 0 or not lines:
        return [f"the process ended with {done.returncode} after {lines[-1:]}: {done.stderr[-800:]}"]
    findings: list[str] = json.loads(lines[-1])
    return findings


# --- damage -----------------------------------------------------------------------------------------------


def damaged(data: bytes, chance: random.Random) -> bytes:
    """Some bytes, changed in one to three ways."""
    if data[:2] == b"PK" and chance.random() < 0.7:
        return damaged_archive(data, chance)
    if data[:4] == b"glTF" or data[:1] == b"{":
        bent = damaged_gltf(data, chance) if chance.random() < 0.7 else None
        if bent is not None:
            return bent
    for _ in range(chance.choice((1, 1, 2, 3))):
        if data:
            data = chance.choice((flipped, cut, spliced, renumbered, renumbered, overwritten))(data, chance)
    return data


def flipped(data: bytes, chance: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 4, 16))):
        changed[chance.randrange(len(changed))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def cut(data: bytes, chance: random.Random) -> bytes:
    return data[: chance.randrange(len(data))]


def spliced(data: bytes, chance: random.Random) -> bytes:
    """A piece left out, doubled, or put elsewhere."""
    begin, end, to = sorted(chance.randrange(len(data) + 1) for _ in range(3))
    end = min(end, begin + chance.choice((1, 4, 64, 4096)))
    piece = data[begin:end]
    return chance.choice(
        (data[:begin] + data[end:], data[:end] + piece + data[end:], data[:to] + piece + data[to:])
    )


def renumbered(data: bytes, chance: random.Random) -> bytes:
    """A number of a text in place of which another stands."""
    found = list(re.finditer(rb"-?\d+(\.\d+)?(e[-+]?\d+)?", data[:200_000]))
    if not found:
        return overwritten(data, chance)
    one = chance.choice(found)
    return data[: one.start()] + chance.choice(NUMBERS) + data[one.end() :]


def overwritten(data: bytes, chance: random.Random) -> bytes:
    """Four bytes in place of which a telling number stands."""
    at = chance.randrange(min(len(data), 2048) if chance.random() < 0.5 else len(data))
    return data[:at] + chance.choice(WORDS).to_bytes(4, chance.choice(("little", "big"))) + data[at + 4 :]


def damaged_archive(data: bytes, chance: random.Random) -> bytes:
    """A zip archive packed again, one of its files damaged."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    name = chance.choice([name for name in files if files[name]])
    files[name] = damaged(files[name], chance)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for one, content in files.items():
            archive.writestr(one, content)
    return packed.getvalue()


# --- the process ------------------------------------------------------------------------------------------


class TooSlowError(Exception):
    """A file that took longer than it may."""


def too_slow(*_: object) -> None:
    raise TooSlowError(f"took more than {SECONDS} s")


def attempt(model: Path) -> str:
    """What was wrong with reading a model; nothing if it was read or refused rightly."""
    from eyeline.errors import EyelineError
    from eyeline.files import load

    begin = time.monotonic()
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        scene = load(model)
        assert scene.face_count > 0 or scene.notes or model.suffix in (".gltf", ".glb"), (
            "nothing to see, nothing said"
        )
    except EyelineError as error:
        text = str(error)
        if "\n" in text or len(text) > 400 or not text.startswith(model.name):
            return f"refused in no good sentence: {text[:300]!r}"
    except BaseException as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        return f"{type(error).__name__}: {str(error)[:200]} ({Path(last.filename).name}:{last.lineno})"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    took = time.monotonic() - begin
    return f"took {took:.1f} s" if took > SECONDS else ""


def run(runs: int, seed: int, models: Sequence[Path]) -> list[str]:
    """Every run's finding; the damaged model of the first few is kept beside this process's folder."""
    findings = []
    for number in range(runs):
        chance = random.Random(f"{seed} {number}")
        model = chance.choice(models)
        folder = Path("work")
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(model.parent, folder)
        files = [path for path in sorted(folder.rglob("*")) if path.is_file() and path.stat().st_size]
        victim = folder / model.name if chance.random() < 0.75 else chance.choice(files)
        victim.write_bytes(damaged(victim.read_bytes(), chance))
        print(number, model.name, victim.name, flush=True)
        if finding := attempt(folder / model.name):
            kept = Path(tempfile.gettempdir()) / f"fuzz-{seed}-{number}"
            shutil.copytree(folder, kept, dirs_exist_ok=True)
            findings.append(f"run {number} ({kept / model.name}): {finding}")
    return findings


def main() -> None:
    """Read damaged models under limits and print the findings as JSON."""
    from eyeline.files import load

    models = [Path(name).resolve() for name in sys.argv[3:]]
    # Libraries and kernels are loaded before the limits
    for model in models:
        if load(model).face_count == 0:
            raise SystemExit(f"{model.name} is no good model: it has no faces")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, too_slow)
    print(json.dumps(run(int(sys.argv[1]), int(sys.argv[2]), models)))


if __name__ == "__main__":
    main()
