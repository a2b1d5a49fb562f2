"""The statements of an OBJ file, sorted by kind; faces keep their order. [Wavefront95]"""

from __future__ import annotations

from dataclasses import dataclass, field

from eyeline.errors import FileError
from eyeline.files.meshes.text import shortened


@dataclass(frozen=True)
class Run:
    """Faces from `first` on, up to the next run, that share an object, a group and a material."""

    first: int
    part: str  # the object's name, or the group's where the file has no objects
    material: str


@dataclass
class Statements:
    """What a file says, as text still; every list in the file's order."""

    points: list[str] = field(default_factory=list)
    uv: list[str] = field(default_factory=list)
    normals: list[str] = field(default_factory=list)
    faces: list[str] = field(default_factory=list)  # corners, none counted from the end
    runs: list[Run] = field(default_factory=list)
    libraries: list[str] = field(default_factory=list)
    undrawn: int = 0  # points, lines, curves and surfaces


UNDRAWN = frozenset(["p", "l", "curv", "curv2", "surf"])


def statements(text: str) -> Statements:
    """All statements of a text; those that say nothing about shape or material are passed over."""
    found = Statements()
    lines = text.replace("\\\r\n", " ").replace("\\\n", " ").splitlines()
    by_object = any(line.startswith("o ") for line in lines)
    part = material = ""
    rows = {"v": found.points, "vt": found.uv, "vn": found.normals}
    for line in lines:
        key, _, rest = line.partition("#")[0].strip().replace("\t", " ").partition(" ")
        if key in rows:
            rows[key].append(rest)
        elif key in ("f", "fo"):
            found.faces.append(rest if "-" not in rest else from_start(rest, found))
        elif key == "usemtl":
            material = rest.strip()
        elif key == "o" or (key == "g" and not by_object):
            part = rest.strip()
        elif key == "mtllib":
            found.libraries.append(rest.strip())
        elif key in UNDRAWN:
            found.undrawn += 1
        if key in ("usemtl", "o", "g"):
            run = Run(len(found.faces), part, material)
            if found.runs and found.runs[-1].first == run.first:
                found.runs.pop()
            found.runs.append(run)
    if not found.runs or found.runs[0].first > 0:
        found.runs.insert(0, Run(0, "", ""))
    return found


def from_start(corners: str, found: Statements) -> str:
    """The corners with numbers that count back from here (-1 is the last so far) counted from the start."""
    counts = (len(found.points), len(found.uv), len(found.normals))
    absolute = []
    for corner in corners.split():
        numbers = corner.split("/")
        for k, number in enumerate(numbers[:3]):
            if number.startswith("-"):
                numbers[k] = counted(number, counts[k], len(found.faces))
        absolute.append("/".join(numbers))
    return " ".join(absolute)


def counted(number: str, count: int, face: int) -> str:
    """A number that counts back from the end of `count` rows, counted from their start."""
    if not number[1:].isdecimal() or not 0 < int(number[1:20]) <= count:
        raise FileError(f"face {face} counts back to {shortened(number)}; there are {count} so far")
    return str(count + 1 + int(number))
