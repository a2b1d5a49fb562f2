"""How far along: parts of the way from shape to shape."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray


def parts_of(parts: npt.ArrayLike) -> FloatArray:
    """(T,) float64; refused: what is not finite."""
    given = np.asarray(parts, np.float64).reshape(-1)
    if not np.isfinite(given).all():
        raise OptionError(
            f"the part of the way is {given[~np.isfinite(given)][0]}; 0 is the start, 1 the end"
        )
    return given
