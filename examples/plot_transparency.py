"""
Glass and holes
===============

Three panes of tinted glass that pierce each other, and a ball in a shell full of holes. Each sample of each
pixel keeps its own list of what it looks through, sorted by depth, so the order of the nodes makes no
difference and panes may cross. Where a texture's alpha is less than the cutoff there is no surface: light and
eye pass.
"""

import math

import numpy as np

import eyeline as el

SIZE = (960, 540)

# --- panes: two faces each, blended
corners = [(-0.5, 0, 0), (0.5, 0, 0), (0.5, 1, 0), (-0.5, 1, 0)]
tints = {"red": (0.85, 0.08, 0.06), "yellow": (0.95, 0.62, 0.05), "blue": (0.05, 0.22, 0.80)}
panes = []
for number, (name, tint) in enumerate(tints.items()):
    glass = el.Material(name, base_color=(*tint, 0.65), alpha_mode="blend", roughness=0.08)
    pane = el.Mesh(corners, [(0, 1, 2), (0, 2, 3)], material=glass)
    half = math.pi * number / len(tints) / 2
    panes.append(
        el.Node(name, mesh=pane, translation=(-0.75, 0, 0), rotation=(0, math.sin(half), 0, math.cos(half)))
    )

# --- a shell with round holes in rows: its texture is white, and clear inside each circle
rows, columns, texels = 8, 16, 32
v, u = (np.mgrid[: rows * texels, : columns * texels] + 0.5) / texels
beyond = np.hypot(u % 1 - 0.5, v % 1 - 0.5) - 0.34  # a soft rim makes a round cut, not a stair of texels
image = np.full((rows * texels, columns * texels, 4), 255, np.uint8)
image[..., 3] = np.clip(127.5 + 127.5 * beyond * texels / 2, 0, 255)
shell = el.Material(
    "shell",
    base_color=(0.9, 0.9, 0.88, 1),
    base_color_texture=el.TextureSlot(el.Texture(image)),
    alpha_mode="mask",
    roughness=0.35,
)
sphere = el.samples.sphere().surfaces[0].mesh
core = el.Material("core", base_color=(0.9, 0.25, 0.03, 1), roughness=0.3)

scene = el.Scene.of(
    *panes,
    el.Node("shell", mesh=sphere.with_material(shell), translation=(0.75, 0.5, 0)),
    el.Node("core", mesh=sphere.with_material(core), translation=(0.75, 0.5, 0), scale=(0.56, 0.56, 0.56)),
)
camera = el.Camera.look_at(eye=(0.4, 1.6, 4.2), target=(-0.02, 0.44, 0), fov=math.radians(22))
el.render(scene, camera, size=SIZE, samples=8).save("transparency.png")
