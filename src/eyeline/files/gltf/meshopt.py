"""EXT_meshopt_compression: views packed by meshoptimizer's codecs, unpacked by its binding `meshopt`."""

from __future__ import annotations

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.part import Part
from eyeline.geometry.arrays import ByteArray

MODES = ("ATTRIBUTES", "TRIANGLES", "INDICES")
FILTERS = ("NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL")


def extension(view: Part) -> Part | None:
    """What a view says of its packed twin, checked; None where it has none."""
    packed = view.extension("EXT_meshopt_compression")
    if packed is None:
        return None
    mode = packed.choice("mode", MODES)
    chosen = packed.choice("filter", FILTERS, "NONE")
    count, stride = packed.whole("count", low=1), packed.whole("byteStride", low=1)
    if mode == "ATTRIBUTES":
        if stride % 4 or stride > 256:
            raise packed.refuse("byteStride", "a multiple of 4 up to 256 is needed")
        strides = {"OCTAHEDRAL": (4, 8), "QUATERNION": (8,)}.get(chosen, (stride,))
        if stride not in strides:
            raise packed.refuse("byteStride", f"the filter {chosen} needs {' or '.join(map(str, strides))}")
    elif stride not in (2, 4) or chosen != "NONE":
        raise packed.refuse("byteStride", f"{mode} needs 2 or 4, and no filter")
    if mode == "TRIANGLES" and count % 3:
        raise packed.refuse("count", "triangles come in threes")
    if view.whole("byteLength") != count * stride:
        raise view.refuse("byteLength", f"its packed twin has {count} x {stride} bytes")
    return packed


def size(packed: Part) -> int:
    """Bytes when unpacked."""
    return packed.whole("count") * packed.whole("byteStride")


def unpacked(packed: Part, data: ByteArray) -> ByteArray:
    """The bytes of a packed view."""
    import meshopt

    try:
        rows = meshopt.decode_gltf_buffer(
            data.tobytes(),
            packed.whole("count"),
            packed.whole("byteStride"),
            packed.text("mode"),
            packed.text("filter", "NONE"),
        )
    except (ValueError, RuntimeError) as error:
        raise FileError(f"{packed.place} cannot be unpacked ({error}); the file is damaged") from error
    return np.asarray(rows).reshape(-1).view(np.uint8)
