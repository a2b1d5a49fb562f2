"""The header of a PLY file: which elements follow, and what each has. [Turk94]"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.text import shortened

TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8", "int64": "i8", "uint64": "u8",
}  # fmt: skip
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
LONGEST = 2**16  # bytes of a header
MOST_PROPERTIES = 256


@dataclass(frozen=True)
class Property:
    """One number of an element, or a list of them."""

    name: str
    dtype: str
    count_dtype: str = ""  # of a list's length; empty for one number


@dataclass(frozen=True)
class Element:
    """`count` rows of the same properties."""

    name: str
    count: int
    properties: tuple[Property, ...]

    @property
    def least_size(self) -> int:
        """Bytes that a row has at least, in a binary file."""
        return sum(np.dtype(one.count_dtype or one.dtype).itemsize for one in self.properties)


@dataclass(frozen=True)
class Header:
    """Elements in the file's order, and where their data begin."""

    order: str  # "" text, "<" or ">"
    elements: tuple[Element, ...]
    size: int  # bytes

    @classmethod
    def of(cls, data: bytes) -> Header:
        """The header at the start of a file's bytes; refuses counts that the file is too small for."""
        if data[:3].lower() != b"ply":
            raise FileError("does not begin with 'ply'; it is no PLY file")
        end = data.find(b"end_header", 0, LONGEST)
        line_end = data.find(b"\n", end) if end >= 0 else -1
        if line_end < 0:
            raise FileError("has no 'end_header'; it is cut short or no PLY file")
        order, elements = None, list[Element]()
        for line in data[:end].decode("latin-1").splitlines()[1:]:
            words = line.split()
            if not words or words[0] in ("comment", "obj_info"):
                continue
            if words[0] == "format" and len(words) > 1 and words[1] in ORDERS:
                order = ORDERS[words[1]]
            elif words[0] == "element" and len(words) == 3 and words[2].isdecimal() and len(words[2]) < 19:
                elements.append(Element(words[1], int(words[2]), ()))
            elif words[0] == "property" and elements:
                last = elements.pop()
                elements.append(
                    Element(last.name, last.count, (*last.properties, property_of(words, order or "")))
                )
            else:
                raise FileError(f"has the header line {shortened(line)!r}, which PLY does not know")
        if order is None:
            raise FileError("does not say in its header whether it is ascii or binary; it is no PLY file")
        header = cls(order, tuple(one for one in elements if one.properties), line_end + 1)
        header.refuse_overclaim(len(data))
        return header

    def refuse_overclaim(self, size: int) -> None:
        """Refuse more rows than the bytes that follow can hold, before memory is taken for them."""
        left = size - self.size
        for element in self.elements:
            if len(element.properties) > MOST_PROPERTIES:
                raise FileError(
                    f"element {element.name!r} has {len(element.properties)} properties; it is damaged"
                )
            # A row of text needs a sign and a blank for each number
            least = element.count * (element.least_size if self.order else 2 * len(element.properties))
            if least > left + 1:
                raise FileError(
                    f"claims {element.count:,} of {shortened(element.name)!r}, but {left:,} bytes are left;"
                    " it is cut short"
                )
            left -= least


def property_of(words: list[str], order: str) -> Property:
    """The property that a header line defines."""
    known = [TYPES.get(word, "") for word in words[1:-1] if word != "list"]
    is_list = len(words) > 1 and words[1] == "list"
    if len(known) != 1 + is_list or not all(known):
        raise FileError(f"has the header line {shortened(' '.join(words))!r}, which PLY does not know")
    prefix = order if order else "<"
    return Property(words[-1], prefix + known[-1], prefix + known[0] if is_list else "")
