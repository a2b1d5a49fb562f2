"""Damage to glTF files that leaves the JSON readable: values changed, removed, doubled, moved."""

from __future__ import annotations

import json
import random
from typing import Any

from files.gltf_builder import glb

WILD = (
    None, True, False, -1, 0, 1, 3, 7, 255, 65535, 2**31 - 1, 2**31, 2**32, 2**63, 2**64, -(2**31),
    0.5, -0.0, 1e-300, 1e300, 1e999, "", "a", "..", "../../x", "\0", "data:,", "é\n",
    [], [[]], {}, [0], [1, 2, 3], {"a": 1},
)  # fmt: skip


def damaged_gltf(data: bytes, chance: random.Random) -> bytes | None:
    """A file with one to four values of its JSON bent; None if it has none that is whole."""
    from eyeline.errors import FileError
    from eyeline.files.gltf.container import opened

    try:
        root, binary = opened(data)
    except FileError:
        return None
    for _ in range(chance.choice((1, 1, 1, 2))):
        bend(root, chance)
    text = json.dumps(root).replace("Infinity", "1e999").encode()
    return glb(text, None if binary is None else binary.tobytes()) if data[:4] == b"glTF" else text


def bend(root: dict[str, Any], chance: random.Random) -> None:
    """Change one value somewhere in a JSON tree."""
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
        thing[key] += chance.choice((-1, 1, 2, 100, 10**6, -2 * thing[key], 0.5))
    else:
        thing[key] = chance.choice(WILD)


def containers(root: Any) -> list[Any]:
    """Every list and object of a JSON tree."""
    found, waiting = [], [root]
    while waiting:
        thing = waiting.pop()
        if isinstance(thing, (dict, list)):
            found.append(thing)
            waiting.extend(thing.values() if isinstance(thing, dict) else thing)
    return found


def keys(thing: Any) -> list[Any]:
    """Where the values of a list or an object stand."""
    return list(thing) if isinstance(thing, dict) else list(range(len(thing)))
