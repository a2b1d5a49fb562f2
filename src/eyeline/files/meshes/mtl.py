"""MTL: the materials of an OBJ file, as metallic-roughness, with the PBR additions. [Wavefront95]"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from eyeline.errors import FileError
from eyeline.files.limits import LARGEST, PIXELS, PIXELS_PER_BYTE, Allowance
from eyeline.files.meshes.assembly import linear_from_bytes
from eyeline.files.meshes.beside import beside, picture
from eyeline.files.meshes.text import shortened, text_of
from eyeline.geometry.arrays import ByteArray
from eyeline.scene.material import Material
from eyeline.scene.texture import Texture, TextureSlot, Wrap

ARGUMENTS = {
    "-blendu": 1,
    "-blendv": 1,
    "-boost": 1,
    "-mm": 2,
    "-texres": 1,
    "-clamp": 1,
    "-bm": 1,
    "-imfchan": 1,
    "-type": 1,
}
NUMBERS = ("-s", "-o", "-t")  # with one to three numbers
UNDRAWN_MAPS = (
    "map_ka",
    "map_ks",
    "map_ns",
    "map_bump",
    "bump",
    "disp",
    "decal",
    "refl",
    "map_pr",
    "map_pm",
    "map_ps",
)


@dataclass
class Library:
    """Materials by name, pictures by path, and what could not be used."""

    folder: Path
    materials: dict[str, Material] = field(default_factory=dict)
    pictures: dict[Path, ByteArray] = field(default_factory=dict)
    pixels: Allowance = field(default_factory=lambda: Allowance("pixels", PIXELS, PIXELS_PER_BYTE))
    notes: list[str] = field(default_factory=list)

    def texture(self, words: Sequence[str], key: str) -> TextureSlot | None:
        """The texture that a map statement names, with its options; None, and a note, where there is none."""
        options, name = options_of(words)
        path = beside(self.folder, name)
        if path is None:
            self.notes.append(
                f"{key} names {shortened(name)!r}, which is not beside the model; it is left out"
            )
            return None
        if path not in self.pictures:
            self.pictures[path] = picture(path, self.pixels)
        wrap: Wrap = "clamp" if options.get("-clamp") == ["on"] else "repeat"
        across, up = vector(options.get("-s"), 1.0)
        right, high = vector(options.get("-o"), 0.0)
        # v runs down here and up in the file
        offset = (right, 1 - up - high)
        texture = Texture(self.pictures[path], (wrap, wrap), name=path.name)
        return TextureSlot(texture, offset=offset, scale=(across, up))


def materials_of(folder: Path, names: Sequence[str]) -> tuple[dict[str, Material], list[str]]:
    """All materials of some libraries in a folder, and notes about what is missing."""
    library = Library(folder)
    for name in dict.fromkeys(names):
        path = beside(folder, name)
        if path is not None:
            paths = [path]
        else:
            paths = [one for one in (beside(folder, word) for word in name.split()) if one is not None]
        if not paths:
            library.notes.append(f"material library {shortened(name)!r} is not beside the model; all is grey")
        for one in paths:
            add_materials(library, one)
    return library.materials, list(dict.fromkeys(library.notes))


def add_materials(library: Library, path: Path) -> None:
    """Read one library file."""
    name, words_of = "", dict[str, list[str]]()
    for line in text_of(path).splitlines():
        words = line.partition("#")[0].split()
        if not words:
            continue
        if words[0] == "newmtl":
            finish(library, name, words_of)
            name, words_of = " ".join(words[1:]), {}
        else:
            words_of[words[0].lower()] = words[1:]
    finish(library, name, words_of)


def finish(library: Library, name: str, words_of: dict[str, list[str]]) -> None:
    """Add one material, from its statements."""
    if not name:
        return
    try:
        library.materials[name] = material_of(library, name, words_of)
    except FileError as error:
        raise FileError(f"material {shortened(name)!r} {error}") from error


def material_of(library: Library, name: str, words_of: dict[str, list[str]]) -> Material:
    """A material, from its statements."""
    values: dict[str, Any] = {"name": name}
    alpha = 1.0
    if "d" in words_of:
        alpha = number([word for word in words_of["d"] if word != "-halo"], "d")
    elif "tr" in words_of:
        alpha = 1 - number(words_of["tr"], "Tr")
    alpha = min(max(alpha, 0.0), 1.0)
    values["base_color"] = (*color(words_of.get("kd"), "Kd", 0.8), alpha)
    values["emissive"] = color(words_of.get("ke"), "Ke", 0.0)
    values["roughness"] = roughness(words_of)
    if "pm" in words_of:
        values["metallic"] = min(max(number(words_of["pm"], "Pm"), 0.0), 1.0)
    for key, slot in (
        ("map_kd", "base_color_texture"),
        ("map_ke", "emissive_texture"),
        ("norm", "normal_texture"),
    ):
        if words_of.get(key):
            values[slot] = library.texture(words_of[key], key)
    if values.get("emissive_texture") and not any(values["emissive"]):
        values["emissive"] = (1.0, 1.0, 1.0)
    if words_of.get("map_d") and words_of["map_d"][-1:] == words_of.get("map_kd", [])[-1:]:
        values["alpha_mode"] = "blend"
    elif words_of.get("map_d"):
        library.notes.append(f"map_d of material {shortened(name)!r} is not drawn")
    if alpha < 1:
        values["alpha_mode"] = "blend"
    library.notes.extend(f"{key} is not drawn" for key in UNDRAWN_MAPS if key in words_of)
    return Material(**values)


def roughness(words_of: dict[str, list[str]]) -> float:
    """Pr, or the width of the Blinn-Phong highlight of Ns, or dull where nothing shines. [Walter07, 5]"""
    if "pr" in words_of:
        return min(max(number(words_of["pr"], "Pr"), 0.0), 1.0)
    if "ns" in words_of and any(color(words_of.get("ks"), "Ks", 1.0)):
        return math.pow(2 / (max(number(words_of["ns"], "Ns"), 0.0) + 2), 0.25)
    return 1.0 if "ks" in words_of else 0.6


# --- words ------------------------------------------------------------------------------------------------


def number(words: Sequence[str], key: str) -> float:
    """The first word as a finite number."""
    try:
        value = float(words[0])
    except (ValueError, IndexError):
        value = math.nan
    if not abs(value) <= LARGEST:
        raise FileError(
            f"has {key} {shortened(' '.join(words))!r}; a number of at most {LARGEST:g} is needed"
        )
    return value


def color(words: Sequence[str] | None, key: str, otherwise: float) -> tuple[float, float, float]:
    """An sRGB colour as linear numbers; one number is a grey, a spectrum is left aside."""
    if not words or words[0] in ("spectral", "xyz"):
        return (otherwise, otherwise, otherwise)
    values = [max(number([word], key), 0.0) for word in words[:3]]
    values = values if len(values) == 3 else values[:1] * 3
    over = max(1.0, *values)
    red, green, blue = (linear_from_bytes(np.array(values) / over) * over).tolist()
    return (red, green, blue)


def vector(words: Sequence[str] | None, otherwise: float) -> tuple[float, float]:
    """The first two numbers of an option."""
    values = [number([word], "an option") for word in words or []]
    values += [otherwise] * (2 - len(values))
    return values[0], values[1]


def options_of(words: Sequence[str]) -> tuple[dict[str, list[str]], str]:
    """The options of a map statement, and the name of its picture, which may hold blanks."""
    options: dict[str, list[str]] = {}
    at = 0
    while at < len(words) and (words[at] in ARGUMENTS or words[at] in NUMBERS):
        key = words[at]
        end = at + 1
        if key in NUMBERS:
            while end < min(at + 4, len(words)) and is_number(words[end]):
                end += 1
        else:
            end += ARGUMENTS[key]
        options[key] = list(words[at + 1 : end])
        at = end
    return options, " ".join(words[at:])


def is_number(word: str) -> bool:
    """Whether a word is a number."""
    try:
        float(word)
    except ValueError:
        return False
    return True
