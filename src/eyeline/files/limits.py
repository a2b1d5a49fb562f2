"""What a file may ask of the machine: no more than its real size can back.

A thousand bytes can claim a billion vertices: zeros, sparse values, compressed data and shared views are
all larger in memory than on disk. So every number and every pixel is paid for from an allowance that grows
with the bytes that are really there, before memory is taken.
"""

from __future__ import annotations

from dataclasses import dataclass

from eyeline.errors import FileError

JSON_BYTES = 2**28  # of the JSON text; 256 MiB
NUMBERS, NUMBERS_PER_BYTE = 2**24, 16  # 4-byte numbers in arrays: 64 MiB, and 64 bytes for each byte read
PIXELS, PIXELS_PER_BYTE = 2**27, 64  # of all images together
IMAGE_PIXELS = 2**26  # of one image: 8192 x 8192
INSTANCES = 2**20  # of all nodes together
LARGEST = 1e18  # of any number, so that its square is finite in 32 bits
FACES = 2**31 - 1  # of all nodes and instances: faces are numbered in 32 bits
PATH_CHARACTERS = 2**26  # of all node paths together
NOTES = 100


@dataclass
class Allowance:
    """How many numbers or pixels are left to a file."""

    unit: str
    left: int
    per_byte: int

    def earn(self, size: int) -> None:
        """Count `size` bytes that are really there."""
        self.left += size * self.per_byte

    def spend(self, count: int, place: str) -> None:
        """Pay for what `place` asks, or refuse it."""
        if count > self.left:
            raise FileError(
                f"{place} claims {count:,} {self.unit}, and the file's real size backs {self.left:,} more;"
                " the file is damaged, or must be split"
            )
        self.left -= count
