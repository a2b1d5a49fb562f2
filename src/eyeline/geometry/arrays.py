"""The array types of the house, and how arrays that come from outside are checked."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.errors import GeometryError

FloatArray = npt.NDArray[np.floating[Any]]
IntArray = npt.NDArray[np.integer[Any]]
ByteArray = npt.NDArray[np.uint8]
BoolArray = npt.NDArray[np.bool_]


def float_rows(values: npt.ArrayLike, width: int, name: str) -> FloatArray:
    """`values` as a finite, C-contiguous (N, width) float32 array; `name` is what errors call it."""
    rows = np.ascontiguousarray(values, dtype=np.float32)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise GeometryError(f"{name} has shape {rows.shape}; (N, {width}) is needed")
    if not np.isfinite(rows).all():
        row = int(np.flatnonzero(~np.isfinite(rows).all(axis=1))[0])
        raise GeometryError(f"{name} {row} is {rows[row].tolist()}; every number must be finite")
    return rows


def index_rows(values: npt.ArrayLike, width: int, count: int, name: str) -> IntArray:
    """`values` as a C-contiguous (N, width) int32 array of indices below `count`."""
    given = np.asarray(values)
    if given.dtype.kind not in "iu" and given.size:
        raise GeometryError(f"{name} has {given.dtype} numbers; indices must be whole numbers")
    if given.size and (given.min() < 0 or given.max() >= count):
        row = int(np.flatnonzero(((given < 0) | (given >= count)).reshape(len(given), -1).any(axis=1))[0])
        raise GeometryError(f"{name} {row} names {given[row].tolist()}; indices must be below {count}")
    rows = np.ascontiguousarray(given, dtype=np.int32)
    if given.size == 0:
        return rows.reshape(0, width)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise GeometryError(f"{name} has shape {rows.shape}; (N, {width}) is needed")
    return rows


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """`array`, not to be written: a kernel that reads it then has one signature, whoever made the array."""
    view = array.view() if array.flags.aligned else array.copy()
    view.flags.writeable = False
    return view
