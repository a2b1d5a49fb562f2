"""Curves have the values that Blender's F-curves have."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from eyeline.motion import Curve, Easing, Key, easing

CASES = json.loads((Path(__file__).parents[1] / "references" / "blender_curves.json").read_text())
SINGLE = float(np.finfo(np.float32).eps)
REACH = 40 * SINGLE  # Blender reckons in single precision, here through some tens of roundings

MODES = {"NONE": "hold", "REPEAT": "cycle", "REPEAT_OFFSET": "cycle_offset", "MIRROR": "ping_pong"}


def curve_of(case: dict[str, Any]) -> Curve:
    rows = case["keys"]
    change = rows[-1]["value"] - rows[0]["value"]
    span = rows[-1]["time"] - rows[0]["time"]
    keys = {row["time"]: key_of(row, change, span) for row in rows}
    before, after = (MODES[mode] for mode in case["cycles"])
    if case["extrapolation"] == "LINEAR":
        before = after = "linear"
    return Curve.of(keys, extrapolate=(before, after))


def key_of(row: dict[str, Any], change: float, span: float) -> Key:
    way = row.get("interpolation", "BEZIER")
    if way == "BEZIER":
        return Key(
            row["value"], interpolation="bezier", in_handle=tuple(row["left"]), out_handle=tuple(row["right"])
        )
    if way in ("CONSTANT", "LINEAR"):
        return Key(row["value"], interpolation="step" if way == "CONSTANT" else "linear")
    return Key(row["value"], ease=ease_of(row, change, span))


def ease_of(row: dict[str, Any], change: float, span: float) -> Easing:
    """Blender gives a spring's amplitude as a value and its period as a time; a period of 0 is the usual."""
    named = easing(f"{row['easing'].lower()}_{row['interpolation'].lower()}")
    if "back" in row:
        return named.having(row["back"])
    if "amplitude" in row:
        amplitude = row["amplitude"] / change
        return named.having(amplitude, row["period"] / span) if row["period"] else named.having(amplitude)
    return named


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_values_are_blenders(case: dict[str, Any]) -> None:
    expected = np.array(case["values"])
    found = curve_of(case).at(case["times"])
    assert np.abs(found - expected).max() <= REACH * max(1.0, np.abs(expected).max())
