"""A glTF file, opened: its JSON, its binary chunk, and what it may still ask for."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from eyeline.errors import FileError
from eyeline.files.gltf.container import opened
from eyeline.files.gltf.notes import Notes
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.limits import NUMBERS, NUMBERS_PER_BYTE, PIXELS, PIXELS_PER_BYTE, Allowance
from eyeline.geometry.arrays import ByteArray


@dataclass(frozen=True, eq=False)
class Document:
    """What every part of the reader starts from."""

    root: Part
    folder: Path
    binary: ByteArray | None
    notes: Notes = field(default_factory=Notes)
    numbers: Allowance = field(default_factory=lambda: Allowance("numbers", NUMBERS, NUMBERS_PER_BYTE))
    pixels: Allowance = field(default_factory=lambda: Allowance("pixels", PIXELS, PIXELS_PER_BYTE))
    _parts: dict[str, tuple[Part, ...]] = field(default_factory=dict)

    @classmethod
    def open(cls, path: Path) -> Document:
        """Read a .gltf or .glb file."""
        data = path.read_bytes()
        values, binary = opened(data)
        document = cls(Part("", values), path.parent, binary)
        document.count(len(data))
        document.check_version()
        return document

    def count(self, size: int) -> None:
        """Take note of `size` bytes that are really there."""
        self.numbers.earn(size)
        self.pixels.earn(size)

    def check_version(self) -> None:
        """Refuse what is not glTF 2."""
        asset = self.root.part("asset")
        needed = asset.text("minVersion", "") or asset.text("version")
        major = needed.split(".")[0]
        if major != "2":
            raise FileError(
                f"asset.version is {spoken(needed)}; glTF 2 is needed, so export the model as glTF 2.0"
            )

    def all(self, kind: str) -> tuple[Part, ...]:
        """Everything of a kind: accessors, meshes, nodes ..."""
        if kind not in self._parts:
            self._parts[kind] = self.root.parts(kind)
        return self._parts[kind]

    def one(self, kind: str, index: int, place: str) -> Part:
        """The thing of a kind that `place` names by its number."""
        every = self.all(kind)
        if not 0 <= index < len(every):
            raise FileError(f"{place} names {kind}[{index}]; the file has {len(every)} of them")
        return every[index]
