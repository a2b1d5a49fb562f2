"""Where in the file a property stands that a track moves. [glTF 2.0 Asset Object Model]"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from eyeline.files.gltf.pointers import STRENGTH, TABLES
from eyeline.geometry.arrays import FloatArray

Change = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Address:
    """A path of a node, which every player knows, or a pointer."""

    path: str = ""  # translation, rotation, scale or weights; empty: the pointer counts
    node: int = -1
    pointer: str = ""
    change: Change | None = None  # from our values to the file's


def pointer_to(owner: str, index: int, property_name: str, lens: str = "") -> list[str]:
    """The pointer to a property of one thing in the file, if the format has it; lens: a camera's kind."""
    ours = "camera.fov" if property_name == "camera.focal_length" else property_name
    for root, name, table in TABLES:
        if name == owner:
            return [
                f"/{root}/{index}/{place}"
                for place, known in table.items()
                if known == ours and place != STRENGTH and place.startswith(lens)
            ]
    return []
