"""Asks Blender for the values of F-curves: `python make_blender_curves.py`, with bpy from PyPI.

Writes blender_curves.json: for each curve its keys, as Blender takes them, and its values at times. Times are
Blender's frames, read as seconds. Blender reckons in single precision.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

FAMILIES = ("SINE", "QUAD", "CUBIC", "QUART", "QUINT", "EXPO", "CIRC", "BACK", "ELASTIC", "BOUNCE")
WAYS = ("EASE_IN", "EASE_OUT", "EASE_IN_OUT")
SAMPLES = 25

# Handles as (time, value) beside the key: crossing, overshooting, flat, uneven, of no length
HANDLES = {
    "gentle": [(0, 0, (-3, 0), (3, 0)), (10, 4, (-3, 0), (3, 0))],
    "steep": [(0, 1, (-3, -5), (1, 6)), (10, 3, (-0.5, 8), (3, 0)), (14, -2, (-2, 0), (2, 0))],
    "crossing": [(0, 0, (-1, 0), (9, 3)), (10, 4, (-8, -6), (1, 0))],
    "overshooting": [(0, 0, (-1, 0), (25, 5)), (10, 4, (-15, 9), (1, 0))],
    "one too long": [(0, 0, (-1, 0), (14, -5)), (10, 4, (-2, 1), (1, 0))],
    "no length": [(0, 0, (0, 0), (0, 0)), (10, 4, (0, 0), (0, 0))],
    "one handle": [(0, 0, (0, 0), (6, 2)), (10, 4, (0, 0), (0, 0))],
    "standing": [(0, 0, (0, 0), (10, 0)), (10, 4, (-10, 0), (0, 0))],
}


def main() -> None:
    answers = [dict(case, values=values(**case)) for case in cases()]
    lines = ",\n".join(json.dumps(answer) for answer in answers)
    Path(__file__).with_name("blender_curves.json").write_text(f"[\n{lines}\n]\n")


def cases() -> Iterator[dict[str, Any]]:
    for name, keys in HANDLES.items():
        rows = [{"time": t, "value": v, "left": left, "right": right} for t, v, left, right in keys]
        yield case(f"handles, {name}", rows)
        yield case(f"handles, {name}, on in a straight line", rows, extrapolation="LINEAR")
    for family in FAMILIES:
        for way in WAYS:
            yield case(f"{family} {way}", eased(family, way))
    for overshoot in (0.0, 3.0):
        for way in WAYS:
            yield case(f"BACK {way} by {overshoot}", eased("BACK", way, back=overshoot))
    for amplitude, period in ((0.0, 0.0), (1.0, 6.0), (9.0, 8.0), (3.0, 15.0)):
        for way in WAYS:
            row = eased("ELASTIC", way, amplitude=amplitude, period=period)
            yield case(f"ELASTIC {way} {amplitude} {period}", row)
    line = [{"time": t, "value": v, "interpolation": "LINEAR"} for t, v in ((2, 1), (5, 4), (9, 3))]
    yield case("line", line)
    yield case("line, on", line, extrapolation="LINEAR")
    steps = [dict(row, interpolation="CONSTANT") for row in line]
    yield case("steps", steps)
    for mode in ("REPEAT", "REPEAT_OFFSET", "MIRROR"):
        yield case(f"line, {mode}", line, cycles=(mode, mode))
    yield case("line, REPEAT after", line, cycles=("NONE", "REPEAT"))


def case(
    name: str,
    keys: list[dict[str, Any]],
    extrapolation: str = "CONSTANT",
    cycles: tuple[str, str] = ("NONE", "NONE"),
) -> dict[str, Any]:
    first, last = keys[0]["time"], keys[-1]["time"]
    span = last - first
    inside = [first + span * i / SAMPLES for i in range(SAMPLES + 1)]
    outside = [first + span * part for part in (-2.5, -2, -1.3, -1, -0.4, -0.1, 1.1, 1.5, 2, 2.2, 3, 3.7)]
    beyond = outside if extrapolation == "LINEAR" or cycles != ("NONE", "NONE") else []
    return {
        "name": name,
        "keys": keys,
        "extrapolation": extrapolation,
        "cycles": cycles,
        "times": inside + beyond,
    }


def eased(family: str, way: str, **given: float) -> list[dict[str, Any]]:
    options = {"BACK": {"back": 1.70158}, "ELASTIC": {"amplitude": 0.8, "period": 4.1}}.get(
        family, {}
    ) | given
    return [
        {"time": 5, "value": 2, "interpolation": family, "easing": way, **options},
        {"time": 25, "value": 8, "interpolation": "CONSTANT"},
    ]


def values(
    name: str, keys: list[dict[str, Any]], extrapolation: str, cycles: tuple[str, str], times: list[float]
) -> list[float]:
    thing = bpy.data.objects.new(name, None)
    thing.animation_data_create().action = bpy.data.actions.new(name)
    curve = thing.animation_data.action.fcurve_ensure_for_datablock(thing, "location", index=0)
    curve.extrapolation = extrapolation
    for row in keys:
        curve.keyframe_points.insert(row["time"], row["value"])
    for key, row in zip(curve.keyframe_points, keys, strict=True):
        key.interpolation = row.get("interpolation", "BEZIER")
        key.easing = row.get("easing", "AUTO")
        for option in ("back", "amplitude", "period"):
            if option in row:
                setattr(key, option, row[option])
        if "left" in row:
            key.handle_left_type = key.handle_right_type = "FREE"
            key.handle_left = (row["time"] + row["left"][0], row["value"] + row["left"][1])
            key.handle_right = (row["time"] + row["right"][0], row["value"] + row["right"][1])
    if cycles != ("NONE", "NONE"):
        modifier = curve.modifiers.new("CYCLES")
        modifier.mode_before, modifier.mode_after = cycles
    return [curve.evaluate(time) for time in times]


if __name__ == "__main__":
    main()
