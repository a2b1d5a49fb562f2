"""Arrays of many meshes as one flat array, kept for as long as the meshes live."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

_kept: dict[tuple[int, ...], tuple[tuple[weakref.ref[Array], ...], Array]] = {}
_keeping = threading.Lock()


def joined(arrays: Sequence[Array], dtype: type) -> Array:
    """All of them flat, one after the other, as C-contiguous writable `dtype`; (1,) zero for none.

    A single array that fits already is taken as it is, without a copy; others are copied once and
    kept, known by identity, until one of them dies.
    """
    if not arrays:
        return np.zeros(1, dtype)
    only = arrays[0]
    fits = only.dtype == dtype and only.flags.c_contiguous and only.flags.writeable and only.size > 0
    if len(arrays) == 1 and fits:
        return only.reshape(-1)
    key = tuple(map(id, arrays))
    with _keeping:
        for old in [
            old for old, (references, _) in _kept.items() if any(one() is None for one in references)
        ]:
            del _kept[old]
        if key not in _kept:
            flat = np.concatenate(
                [*(np.asarray(one, dtype).reshape(-1) for one in arrays), np.zeros(1, dtype)]
            )
            _kept[key] = tuple(weakref.ref(one) for one in arrays), flat
        return _kept[key][1]
