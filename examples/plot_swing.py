"""
An arm that swings, three ways
==============================

The same two poses, and three ways from one to the other. Where every vertex goes straight, the arm shrinks
on its way (red). As rigid as possible, it keeps its length and its girth, though nobody told it of joints,
but its shoulder drifts (blue). Where there are joints, it is best to go between their angles (grey).
"""

import math
from dataclasses import replace

import numpy as np

import eyeline as el
from eyeline.samples.shapes import lathe

SIZE = (320, 256)
PARTS = np.linspace(0, 1, 5)
START, END = (-0.6, 0.1), (1.1, 2.0)  # shoulder and elbow, radians
LENGTH, ELBOW, BEND = 2.0, 1.05, 0.5  # metres: of the arm, to its elbow, over which the elbow bends
PAINTS = {"linear": (0.75, 0.1, 0.07, 1), "rigid": (0.07, 0.25, 0.7, 1), "joints": (0.3, 0.3, 0.3, 1)}

turn, along = np.linspace(0, math.pi / 2, 9), np.linspace(0, LENGTH, 90)
radius = 0.19 - 0.05 * along
tail = 0.19 * np.stack([np.sin(turn), -np.cos(turn)], axis=1)
tip = 0.09 * np.stack([np.cos(turn), np.sin(turn)], axis=1) + (0, LENGTH)
REST = lathe(np.concatenate([tail, np.stack([radius, along], axis=1)[1:-1], tip]), sides=32)


def arm(shoulder, elbow, paint):
    """The limb along y laid along a line that turns at the shoulder and, softly, at the elbow."""
    s = np.linspace(-0.3, LENGTH + 0.3, 1000)
    soft = np.clip((s - ELBOW) / BEND + 0.5, 0, 1)
    heading = shoulder + elbow * soft * soft * (3 - 2 * soft)
    line = np.cumsum(np.stack([np.cos(heading), np.sin(heading)]), axis=1) * (s[1] - s[0])
    x, y, z = REST.points.T
    angle, left, up = (np.interp(y, s, one) for one in (heading, *(line - line[:, s.searchsorted(0), None])))
    points = np.stack([left - x * np.sin(angle), up + x * np.cos(angle), z], axis=1)
    return el.Scene.of(replace(REST, points=points).mesh(paint, crease=math.pi))


camera = el.Camera.look_at(eye=(0.75, 0.2, 9), target=(0.75, 0.2, 0), fov=0.34)
rows = []
for way, colour in PAINTS.items():
    paint = el.Material(way, colour, roughness=0.45)
    poses = arm(*START, paint), arm(*END, paint)
    pictures = []
    for part in PARTS.tolist():
        if way == "joints":
            scene = arm(*((1 - part) * np.array(START) + part * np.array(END)), paint)
        else:
            scene = el.Scene.of(el.inbetween(*poses, way=way).at(part))
        pictures.append(el.render(scene, camera, size=SIZE, ground="off").pixels)
    rows.append(np.concatenate(pictures, axis=1))
el.Image(np.concatenate(rows)).save("swing.png")
