"""The rows of the table between gathering and lighting: lanes[row, point], float32.

A row holds one number of many points side by side, so that arithmetic runs over whole vectors.
"""

from __future__ import annotations

TILE = 2048  # points at a time: all rows of a tile stay in a core's own cache
SPARE = 16  # lanes at the end of a row, so that rows do not fall on the same lines of the cache

# Place, from the eye, along the world's axes, metres
X, Y, Z = 0, 1, 2
# Unit normals towards the eye: of the shading, and of the face itself
NX, NY, NZ = 3, 4, 5
GX, GY, GZ = 6, 7, 8
# Base colour, linear, and the alpha that the material's mode makes of the cover it stands for
RED, GREEN, BLUE, ALPHA = 9, 10, 11, 12
COVER = 13
METALLIC, ROUGHNESS = 14, 15
OCCLUSION = 16  # 1 open .. 0 closed: how much of the surroundings a point sees, by its texture
UNLIT = 17  # 1 shows the base colour, whatever the light
EMISSIVE_RED, EMISSIVE_GREEN, EMISSIVE_BLUE = 18, 19, 20
# Unit direction to the eye
VX, VY, VZ = 21, 22, 23
# What arrives of the light at hand, 0..1; how open the surroundings on the screen are; the light for the eye
LIT = 24
OPEN = 25
OUT_RED, OUT_GREEN, OUT_BLUE = 26, 27, 28
COLUMN = 29  # of the pixel, in the picture
ROWS = 30
