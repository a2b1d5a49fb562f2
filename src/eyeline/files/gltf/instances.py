"""Instances: one mesh that stands many times at a node. [EXT_mesh_gpu_instancing]"""

from __future__ import annotations

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.part import Part
from eyeline.files.limits import INSTANCES
from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray

WHOLE = {"TRANSLATION": (0.0, 0.0, 0.0), "ROTATION": quaternion.IDENTITY, "SCALE": (1.0, 1.0, 1.0)}


def instances_of(accessors: Accessors, node: Part) -> FloatArray | None:
    """(K, 4, 4) node_from_instance; None where a node's mesh stands once."""
    extension = node.extension("EXT_mesh_gpu_instancing")
    if extension is None:
        return None
    named = extension.part("attributes")
    given = [name for name in WHOLE if named.has(name)]
    if not given:
        raise FileError(f"{named.place} names no TRANSLATION, ROTATION or SCALE; one is needed")
    counts = {name: accessors.count(named.whole(name), named.at(name)) for name in given}
    count = counts[given[0]]
    if set(counts.values()) != {count}:
        raise FileError(f"{named.place} has {counts} instances; all must have as many")
    if count > INSTANCES:
        raise FileError(f"{named.place} has {count:,} instances; at most {INSTANCES:,} are read")
    accessors.document.numbers.spend(32 * count, named.place)
    columns = []
    for name, whole in WHOLE.items():
        kind = ("VEC4",) if name == "ROTATION" else ("VEC3",)
        if name in given:
            columns.append(accessors.floats(named.whole(name), kind, named.at(name)).astype(np.float64))
        else:
            columns.append(np.tile(whole, (count, 1)))
    return transform.compose(columns[0], quaternion.normalized(columns[1]), columns[2])
