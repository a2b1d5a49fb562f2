"""
A mesh of your own
==================

Points and faces from numpy become a picture: here a wave, with a colour for each of its vertices.
"""

import math

import numpy as np

import eyeline as el

SIZE = (960, 540)
CELLS = 160

# --- a grid of points, lifted by a wave
x, z = np.meshgrid(np.linspace(-4, 4, CELLS + 1), np.linspace(-4, 4, CELLS + 1))
distance = np.hypot(x, z)
height = np.cos(2.6 * distance) / (1 + distance)
points = np.stack([x, height, z], axis=-1).reshape(-1, 3)

# --- two faces to a cell, counter-clockwise seen from above
corner = np.arange((CELLS + 1) * CELLS).reshape(CELLS, CELLS + 1)[:, :-1].reshape(-1, 1)
below, right, opposite = corner + CELLS + 1, corner + 1, corner + CELLS + 2
faces = np.concatenate([np.hstack([corner, below, opposite]), np.hstack([corner, opposite, right])])

# --- from deep blue in the valleys to warm white on the crests, linear light
deep, crest = np.array([0.02, 0.10, 0.35, 1]), np.array([1.0, 0.72, 0.45, 1])
part = (height.reshape(-1, 1) - height.min()) / (height.max() - height.min())
colors = deep + (crest - deep) * part

wave = el.Mesh(points, faces, colors=colors, material=el.Material(base_color=(1, 1, 1, 1), roughness=0.35))
camera = el.Camera.look_at(eye=(5.5, 5.4, 10), target=(0, -0.3, 0.5), fov=math.radians(38))
el.render(el.Scene.of(wave), camera, size=SIZE).save("own_mesh.png")
