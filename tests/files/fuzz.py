"""Mutations of good files: a reader either reads what comes or refuses it in a sentence, soon.

`fuzz(reader, files, runs, seed)` works in this process; run as a program it limits the memory of its process first:

    python tests/files/fuzz.py gltf 20000 [seed]
"""

from __future__ import annotations

import json
import random
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from eyeline.errors import EyelineError
from eyeline.files.gltf.container import opened

SECONDS = 5.0  # a run may take
MEMORY = 6 * 2**30  # bytes of address space a fuzzing process may take, libraries counted
WILD = (
    None, True, False, -1, 0, 1, 3, 7, 255, 65535, 2**31 - 1, 2**31, 2**32, 2**63, 2**64, -(2**31), 0.5, -0.0,
    1e-300, 1e300, 1e999, "", "a", "..", "../../x", "\0", "data:,", "é\n", [], [[]], {}, [0], [1, 2, 3], {"a": 1},
)  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """What came of all runs."""

    read: int
    refused: int
    sentences: Counter[str]  # by their first words
    slowest: float  # seconds
    defects: tuple[str, ...]  # everything that is not a scene or a sentence


def fuzz(reader: Callable[[Path], object], files: Sequence[Path], runs: int, seed: int) -> Outcome:
    """Read mutations of good files, each a function of the seed and its number alone."""
    read, defects, slowest = 0, [], 0.0
    sentences: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for run in range(runs):
            chance = random.Random(f"{seed} {run}")
            original = files[run % len(files)]
            path = Path(folder) / f"run{original.suffix}"
            path.write_bytes(mutated(original.read_bytes(), chance))
            begin = time.monotonic()
            try:
                reader(path)
                read += 1
            except EyelineError as error:
                sentences[first_words(str(error))] += 1
                if "\n" in str(error) or not str(error).startswith(path.name):
                    defects.append(f"run {run} of {original.name}: {error}")
            except Exception:
                defects.append(f"run {run} of {original.name}: {traceback.format_exc()}")
            seconds = time.monotonic() - begin
            slowest = max(slowest, seconds)
            if seconds > SECONDS:
                defects.append(f"run {run} of {original.name} took {seconds:.1f} s")
    return Outcome(read, sum(sentences.values()), sentences, slowest, tuple(defects))


def first_words(sentence: str) -> str:
    """A sentence without its names and numbers."""
    return "".join("#" if letter.isdigit() else letter for letter in sentence)[:60]


def mutated(data: bytes, chance: random.Random) -> bytes:
    """A file with its bytes or, where it has any, its JSON bent in one to four places."""
    times = chance.choice((1, 1, 1, 2, 4))
    if chance.random() < 0.7 and (parts := gltf_parts(data)) is not None:
        root, binary = parts
        for _ in range(times):
            bend_json(root, chance)
        text = json.dumps(root).replace("Infinity", "1e999").encode("utf-8", "surrogatepass")
        return text if binary is None else gltf_of(text, binary)
    for _ in range(times):
        data = bend_bytes(data, chance)
    return data


def gltf_parts(data: bytes) -> tuple[dict[str, Any], bytes | None] | None:
    """The JSON and the binary chunk of a good glTF file; None of any other file."""
    if data[:4] != b"glTF" and not data.lstrip().startswith(b"{"):
        return None
    root, binary = opened(data)
    return root, None if binary is None else binary.tobytes()


def gltf_of(text: bytes, binary: bytes) -> bytes:
    from files.gltf_builder import glb

    return glb(text, binary)


def bend_json(root: Any, chance: random.Random) -> None:
    """Change, remove, double or move one value somewhere in a JSON tree."""
    spots = [(thing, key) for thing in containers(root) for key in keys(thing)]
    if not spots:
        return
    thing, key = chance.choice(spots)
    kind = chance.random()
    if kind < 0.2:
        del thing[key]
    elif kind < 0.3 and isinstance(thing, list):
        thing.insert(chance.randrange(len(thing) + 1), thing[key])
    elif kind < 0.45:
        other, other_key = chance.choice(spots)
        thing[key] = json.loads(json.dumps(other[other_key]))
    elif kind < 0.7 and isinstance(thing[key], (int, float)):
        thing[key] = thing[key] + chance.choice((-1, 1, 2, 100, 10**6, -thing[key] * 2, 0.5))
    else:
        thing[key] = chance.choice(WILD)


def containers(root: Any) -> list[Any]:
    """Every list and object of a JSON tree; of long lists of numbers only the list."""
    found, waiting = [], [root]
    while waiting:
        thing = waiting.pop()
        if isinstance(thing, (dict, list)):
            found.append(thing)
            waiting.extend(thing.values() if isinstance(thing, dict) else thing)
    return found


def keys(thing: Any) -> list[Any]:
    return list(thing) if isinstance(thing, dict) else list(range(len(thing)))


def bend_bytes(data: bytes, chance: random.Random) -> bytes:
    """Overwrite, cut, insert, double or swap bytes; near the beginning as often as anywhere."""
    if not data:
        return bytes(chance.randrange(256) for _ in range(chance.randrange(1, 9)))
    reach = len(data) if chance.random() < 0.5 else min(len(data), 256)
    start = chance.randrange(reach)
    length = chance.choice((1, 1, 2, 4, 8, 64))
    kind = chance.random()
    if kind < 0.5:
        noise = chance.choice((chance.randbytes(length), b"\xff" * length, b"\0" * length))
        return data[:start] + noise + data[start + length :]
    if kind < 0.65:
        return data[:start]
    if kind < 0.8:
        return data[:start] + data[start + length :]
    if kind < 0.9:
        return data[:start] + chance.randbytes(length) + data[start:]
    other = chance.randrange(len(data))
    return data[:start] + data[other : other + length] + data[start + length :]


def good_gltf(folder: Path) -> list[Path]:
    """Small good files that together use everything the reader reads, and the real models at hand."""
    from data import every
    from files.good_gltf import GOOD

    made = [make().write(folder, f"{name}.glb") for name, make in GOOD.items()]
    made += [make().write(folder, f"{name}.gltf") for name, make in GOOD.items()]
    real = [path for path in [*every("gltf/*.gltf"), *every("gltf/*.glb")] if path.stat().st_size < 200_000]
    return made + real


def good_meshes(folder: Path) -> list[Path]:
    """The real meshes at hand that are small."""
    from data import every

    return [path for path in every("mesh/*") if path.stat().st_size < 200_000]


def limit_memory() -> None:
    """Let no allocation of this process pass MEMORY."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def main(kind: str, runs: str, seed: str = "1") -> int:
    """Fuzz one family of readers, print what came of it, and fail where there is a defect."""
    from eyeline.files import load

    limit_memory()
    with tempfile.TemporaryDirectory() as folder:
        files = {"gltf": good_gltf, "meshes": good_meshes}[kind](Path(folder))
        outcome = fuzz(load, files, int(runs), int(seed))
    for defect in outcome.defects:
        print(defect)
    print(
        f"{runs} runs over {len(files)} files, seed {seed}: {outcome.read} read, {outcome.refused} refused in"
        f" {len(outcome.sentences)} kinds of sentence, {len(outcome.defects)} defects;"
        f" slowest {outcome.slowest:.2f} s"
    )
    return 1 if outcome.defects else 0


if __name__ == "__main__":
    import warnings

    warnings.simplefilter("error")
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    sys.exit(main(*sys.argv[1:]))
