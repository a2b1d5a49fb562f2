"""Left becomes right: names swapped, motion reflected in a plane."""

from __future__ import annotations

import re
from dataclasses import replace

from eyeline.errors import SceneError, suggestion
from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track

# What a reflection does to a translation, and to a quaternion, in the plane whose normal is this axis
PLANES = {
    "x": ((-1.0, 1.0, 1.0), (1.0, -1.0, -1.0, 1.0)),
    "y": ((1.0, -1.0, 1.0), (-1.0, 1.0, -1.0, 1.0)),
    "z": ((1.0, 1.0, -1.0), (-1.0, -1.0, 1.0, 1.0)),
}

# arm.L arm_l arm-L L_arm L.arm, with a number after, and LeftArm arm_left
SIDES = re.compile(
    r"(?<=[._\- ])[LRlr](?=$|[._\- ]\d*$)|^[LRlr](?=[._\- ])"
    r"|Left|Right|LEFT|RIGHT|(?<![A-Za-z])(?:left|right)(?![a-z])"
)
OTHER = {"L": "R", "R": "L", "l": "r", "r": "l", "LEFT": "RIGHT", "RIGHT": "LEFT"}
OTHER |= {"left": "right", "right": "left", "Left": "Right", "Right": "Left"}


def other_side(path: str) -> str:
    """A path with left and right swapped in the name of every node: "body/arm.L" is "body/arm.R"."""
    return "/".join(SIDES.sub(lambda found: OTHER[found[0]], name) for name in path.split("/"))


def mirrored(clip: Clip, plane: str = "x") -> Clip:
    """A clip for the other side of what it moves, reflected in the plane whose normal is "x", "y" or "z".

    Each node's track becomes its counterpart's, in its parent's axes: the two must stand as mirror images, as
    rigs are built. What moves no node, and morph weights, stay as they are.
    """
    if plane not in PLANES:
        raise SceneError(f"the plane of a mirror is {plane!r}{suggestion(plane, PLANES)}")
    return Clip(clip.name, [_mirrored(track, plane) for track in clip.tracks])


def _mirrored(track: Track, plane: str) -> Track:
    if track.kind != "node":
        return track
    place, turn = PLANES[plane]
    signs = {"translation": place, "rotation": turn}.get(track.property)
    curve = track.curve if signs is None else _signed(track.curve, signs)
    return replace(track, name=other_side(track.name), curve=curve)


def _signed(curve: Curve, signs: tuple[float, ...]) -> Curve:
    """A curve with every number of its values multiplied."""
    handles = curve.handles
    if handles is not None:
        handles = handles.copy()
        handles[:, :, 1] *= signs
    return replace(curve, values=curve.values * signs, handles=handles)
