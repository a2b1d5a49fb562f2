"""Deformers that Blender has too move points as Blender does; its figures are in references/deform.json."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from eyeline.deform.bend import Bend
from eyeline.deform.deformer import Deformer
from eyeline.deform.lattice import Lattice
from eyeline.deform.stretch import Stretch
from eyeline.deform.taper import Taper
from eyeline.deform.twist import Twist

REFERENCE = json.loads((Path(__file__).parent.parent / "references" / "deform.json").read_text())
SINGLE = 2e-6  # Blender reckons in float32, and its table has six digits
UP = (0.0, 0.0, 1.0)


def ours(case: dict[str, Any]) -> Deformer:
    """The deformer that should do the same to a cube of 2 m around the origin."""
    if case["method"] == "LATTICE":
        return Lattice(np.array(case["offsets"]), (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), "bspline")
    amount, limits = case["amount"], {"lower": 2 * case["limits"][0] - 1, "upper": 2 * case["limits"][1] - 1}
    # Blender measures a stretch by the length between its limits, and takes it from the waist
    gain = amount / (limits["upper"] - limits["lower"])
    match case["method"]:
        case "TWIST":
            return Twist(amount, axis=UP, **limits)
        case "BEND":
            return Bend(amount, axis=(1.0, 0.0, 0.0), towards=math.pi, **limits)
        case "TAPER":
            return Taper(amount, axis=UP, **limits)
        case _:
            return Stretch(gain, volume=0.0, waist=gain, axis=UP, **limits)


@pytest.mark.parametrize("case", REFERENCE["cases"], ids=lambda case: case["method"].lower())
def test_points_go_where_blender_takes_them(case: dict[str, Any]) -> None:
    moved, _, _ = ours(case)(np.array(REFERENCE["points"]))
    assert np.abs(moved - REFERENCE["points"]).max() > 0.1
    assert np.abs(moved - case["points"]).max() <= SINGLE
