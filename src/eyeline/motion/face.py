"""A face's acting: expressions, gaze, blinks and speech, as numbers of its controls.

Controls are called as in ARKit, and "viseme_aa" and so on for speech. Nothing here knows a head: functions
answer keys, {control: {seconds: value}}, and `perform` writes them on a shot.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from eyeline.errors import SceneError, suggestion
from eyeline.motion.phonemes import VISEMES, viseme
from eyeline.motion.shot import Shot

Keys = dict[str, dict[float, float]]  # control -> seconds -> value

TRANSITION = 0.12  # seconds from one mouth to the next, where there is time
CLOSE, SHUT, OPEN = 0.07, 0.04, 0.14  # seconds of a blink's parts
SHORTEST = 0.6  # seconds between blinks, at least


def _both(**controls: float) -> dict[str, float]:
    """Controls of the left and the right half, from names without a side."""
    return {f"{name}{side}": value for name, value in controls.items() for side in ("Left", "Right")}


EXPRESSIONS: dict[str, dict[str, float]] = {
    "neutral": {},
    "smile": _both(mouthSmile=1, cheekSquint=0.6, eyeSquint=0.35, mouthDimple=0.3),
    "grin": {**_both(mouthSmile=1, mouthUpperUp=0.4, cheekSquint=0.8, eyeSquint=0.4), "jawOpen": 0.35},
    "frown": {**_both(mouthFrown=1, browDown=0.5), "mouthShrugLower": 0.3},
    "sadness": {**_both(mouthFrown=0.8, eyeLookDown=0.5, eyeSquint=0.2), "browInnerUp": 1},
    "surprise": {**_both(eyeWide=1, browOuterUp=0.9), "browInnerUp": 0.9, "jawOpen": 0.6, "mouthFunnel": 0.3},
    "anger": {**_both(browDown=1, eyeSquint=0.4, noseSneer=0.5, mouthPress=0.6, mouthFrown=0.5)},
    "fear": {**_both(eyeWide=0.9, mouthStretch=0.8), "browInnerUp": 1, "jawOpen": 0.25},
    "disgust": {**_both(noseSneer=1, browDown=0.6, mouthUpperUp=0.5, mouthFrown=0.4, eyeSquint=0.4)},
    "blink": _both(eyeBlink=1),
    "wink": {"eyeBlinkLeft": 1, "cheekSquintLeft": 0.7, "mouthSmileLeft": 0.7, "mouthSmileRight": 0.25},
    "kiss": {**_both(eyeSquint=0.2), "mouthPucker": 1},
    "doubt": {"browDownLeft": 0.8, "browOuterUpRight": 1, "mouthLeft": 0.4, **_both(mouthPress=0.4)},
}


def express(name: str, amount: float = 1.0) -> dict[str, float]:
    """The controls of an expression, so strong: `express("smile", 0.7)`. Refused: one that has no name."""
    if name not in EXPRESSIONS:
        raise SceneError(f"there is no expression {name!r}{suggestion(name, EXPRESSIONS)}")
    return {control: amount * value for control, value in EXPRESSIONS[name].items()}


def gaze(sideways: float = 0.0, up: float = 0.0) -> dict[str, float]:
    """The controls that turn both eyes: -1..1, to the face's own left and up where above 0."""
    left, right, high, low = (max(part, 0.0) for part in (sideways, -sideways, up, -up))
    turns = {"eyeLookOutLeft": left, "eyeLookInRight": left, "eyeLookInLeft": right, "eyeLookOutRight": right}
    return {**turns, **_both(eyeLookUp=high, eyeLookDown=low)}


def mixed(*controls: Mapping[str, float]) -> dict[str, float]:
    """Expressions worn together: their controls added, up to 1."""
    names = dict.fromkeys(name for one in controls for name in one)
    return {name: min(1.0, sum(one.get(name, 0.0) for one in controls)) for name in names}


def acted(moments: Mapping[float, Mapping[str, float]]) -> Keys:
    """Keys of controls at moments, {seconds: controls}; what a moment does not name is 0 there."""
    names = dict.fromkeys(name for controls in moments.values() for name in controls)
    return {name: {time: one.get(name, 0.0) for time, one in sorted(moments.items())} for name in names}


def blinks(until: float, *, seed: int = 0, every: float = 4.0) -> Keys:
    """Keys of both eyes' blinks from 0 s on, after random waits of `every` seconds in the mean."""
    if not every > SHORTEST:
        raise SceneError(f"blinks every {every} s; more than {SHORTEST} is needed")
    chance = np.random.default_rng(seed)
    keys = {0.0: 0.0}
    time = 0.0
    while True:
        time += SHORTEST + float(chance.exponential(every - SHORTEST))
        if time + CLOSE + SHUT + OPEN > until:
            return {name: dict(keys) for name in _both(eyeBlink=1)}
        shut = time + CLOSE
        keys |= {time: 0.0, shut: 1.0, shut + SHUT: 1.0, shut + SHUT + OPEN: 0.0}
        time = shut + SHUT + OPEN


def lip_sync(phonemes: Iterable[tuple[float, str]], *, amount: float = 1.0) -> Keys:
    """Keys of the viseme controls for phonemes, (seconds at which it begins, ARPAbet name) each.

    "-" is silence; the last lasts on, so end with one. From mouth to mouth goes TRANSITION seconds, less
    between short ones, so that the visemes add up to `amount` at all times.
    """
    runs = _runs(phonemes)
    times = [time for time, _ in runs]
    lengths = [math.inf, *np.diff(times).tolist(), math.inf]
    halves = [min(TRANSITION, before, after) / 2 for before, after in pairwise(lengths)]
    keys: Keys = {}
    for index, (time, name) in enumerate(runs):
        mouth = keys.setdefault(name, {})
        if index:
            mouth |= {time - halves[index]: 0.0, time + halves[index]: amount}
        else:
            mouth[time] = amount
        if index + 1 < len(runs):
            end, half = runs[index + 1][0], halves[index + 1]
            mouth |= {end - half: amount, end + half: 0.0}
    return keys


def _runs(phonemes: Iterable[tuple[float, str]]) -> list[tuple[float, str]]:
    """When each mouth begins, from silence on; refused: times that do not rise."""
    runs: list[tuple[float, str]] = []
    last = -math.inf
    for time, phoneme in phonemes:
        if not last < time < math.inf:
            raise SceneError(f"phoneme {phoneme!r} is at {time} s, after {last} s; times must rise")
        last = time
        mouth = viseme(phoneme)
        if not runs and time > 0:
            runs.append((0.0, VISEMES[0]))
        if not runs or runs[-1][1] != mouth:
            runs.append((float(time), mouth))
    return runs


def perform(shot: Shot, head: str, *parts: Keys, start: float = 0.0, ease: Any = "ease_in_out_sine") -> Shot:
    """Write keys of a head's controls on a shot, from `start` on; parts that move one control are merged."""
    for part in parts:
        for control, keys in part.items():
            later = {start + time: value for time, value in keys.items()}
            shot.key(f"{head}.controls.{control}", later, ease=ease)
    return shot
