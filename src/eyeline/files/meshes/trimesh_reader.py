"""The formats that trimesh reads for us: called without a file name, a network or a log."""

from __future__ import annotations

import io
import logging
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import Corners, finite_points, indices_below
from eyeline.files.meshes.text import shortened


def asked(load: Callable[..., Any], data: bytes, kind: str) -> Mapping[str, Any]:
    """What one of trimesh's loaders makes of some bytes; whatever it stumbles over becomes a refusal."""
    logging.getLogger("trimesh").addHandler(logging.NullHandler())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found: Mapping[str, Any] = load(io.BytesIO(data))
        except (MemoryError, FileError):
            raise
        except Exception as error:
            # The loaders raise whatever the first odd byte leads to
            reason = shortened((str(error) or type(error).__name__).splitlines()[0], 80)
            raise FileError(f"is no {kind} that can be read ({reason}); export it again") from error
    return found


def corners(found: Mapping[str, Any]) -> Corners:
    """The checked triangles of one of trimesh's meshes."""
    points = finite_points(np.asarray(found["vertices"]).reshape(-1, 3))
    faces = np.asarray(found["faces"], dtype=np.int64).reshape(-1, 3)
    indices_below(faces.reshape(-1), len(points), np.arange(faces.size) // 3)
    return Corners(points, faces)
