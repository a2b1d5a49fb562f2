"""The traced style: shadows where light is hidden, mirrors that show what stands around, always the same."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np

import eyeline as el
from data import PROJECT
from eyeline.shading.ray_aims import disk_pattern, turns_of
from eyeline.shading.styles.traced import Traced
from eyeline.shading.tracing import RayCounts

FLOOR = [(-9, 0, -9), (9, 0, -9), (9, 0, 9), (-9, 0, 9)]
QUAD = [(0, 2, 1), (0, 3, 2)]
SUN = el.Light("directional", intensity=3.0)
DOWN = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], float)  # -z to -y

PROGRAM = """
import hashlib
import eyeline as el
picture = el.render(el.samples.teapot(), size=(96, 54), style="traced", samples=2)
print(hashlib.sha256(picture.pixels.tobytes()).hexdigest())
"""


def lid(height: float, side: float) -> el.Mesh:
    """A square that hangs over the floor."""
    corners = np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]) * side + (0, height, 0)
    return el.Mesh(corners, QUAD)


def light_on_the_floor(*nodes: el.Node, look: float = 4.0) -> np.ndarray:
    """(H, W) green of the floor seen from the side, 0..255; its middle is in the picture's middle."""
    scene = el.Scene((el.Node("floor", mesh=el.Mesh(FLOOR, QUAD)), *nodes))
    camera = el.Camera.look_at((0, 1.0, look), (0, 0, 0), fov=0.4, near=0.1)
    picture = el.render(scene, camera, size=(80, 60), style="traced", samples=1)
    return picture.pixels[..., 1].astype(int)


def test_a_lid_throws_its_shadow_on_the_floor() -> None:
    sun = el.Node("sun", light=SUN, matrix=DOWN)
    open_floor = light_on_the_floor(sun)
    shaded = light_on_the_floor(sun, el.Node("lid", mesh=lid(3.0, 0.3)))
    assert shaded[30, 40] < 0.4 * open_floor[30, 40]
    assert abs(shaded[30, 2] - open_floor[30, 2]) < 12


def test_the_farther_the_lid_the_softer_the_shadow() -> None:
    sun = el.Node("sun", light=SUN, matrix=DOWN)

    def steps(height: float) -> int:
        row = light_on_the_floor(sun, el.Node("lid", mesh=lid(height, 0.3)))[30, 40:]
        between = (row > row.min() + 10) & (row < row.max() - 10)
        return int(between.sum())

    assert steps(8.0) > steps(0.4)


def test_a_corner_is_darker_than_the_open_floor() -> None:
    wall = el.Mesh([(-9, 0, -0.2), (9, 0, -0.2), (9, 9, -0.2), (-9, 9, -0.2)], QUAD)
    glow = el.Node("glow", light=el.Light("directional", intensity=0.0))
    row = light_on_the_floor(glow, el.Node("wall", mesh=wall))[:, 40]
    open_row = light_on_the_floor(glow)[:, 40]
    assert row[30] < open_row[30] - 10


def test_a_mirror_shows_what_stands_before_it() -> None:
    mirror = el.Material(base_color=(1, 1, 1, 1), metallic=1.0, roughness=0.0)
    red = el.Material(base_color=(1, 0, 0, 1), roughness=1.0, unlit=True)
    wall = el.Mesh([(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], QUAD, material=mirror)
    # Behind the eye, and to its right
    ball = el.Mesh([(2, -1, 8), (4, -1, 8), (4, 1, 8), (2, 1, 8)], QUAD, material=red)
    scene = el.Scene.of(wall, ball)
    camera = el.Camera.look_at((0, 0, 4), (0, 0, 0), fov=math.radians(50), near=0.1)
    pixels = el.render(scene, camera, size=(90, 60), style="traced", samples=1).pixels.astype(int)
    # Mirrored it stands at z = -8, seen from z = 4: x 2..4 over 12 metres
    column = 45 + round(3 / 12 / math.tan(math.radians(25)) * 30)
    assert pixels[30, column, 0] > 200
    assert pixels[30, column, 1] < 60
    assert pixels[30, 90 - column, 1] > 100


def test_a_mirror_shows_the_back_of_what_the_eye_sees_from_the_front() -> None:
    """The light on the hidden side of a ball is that of its hidden side."""
    mirror = el.Material(base_color=(1, 1, 1, 1), metallic=1.0, roughness=0.0)
    wall = el.Mesh([(-4, -2, -2), (4, -2, -2), (4, 2, -2), (-4, 2, -2)], QUAD, material=mirror)
    board = el.Mesh([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], QUAD)
    # The light shines from behind the board, along +z
    turn = np.diag([-1.0, 1, -1, 1])
    turn[:3, 3] = 0, 0, -1.0
    scene = el.Scene(
        (
            el.Node("wall", mesh=wall),
            el.Node("board", mesh=board),
            el.Node("lamp", light=el.Light("spot", intensity=9.0, outer_cone=1.2), matrix=turn),
        )
    )
    camera = el.Camera.look_at((2.0, 0, 4), (0.2, 0, 0), fov=0.9, near=0.1)
    pixels = el.render(scene, camera, size=(120, 80), style="traced", samples=1).pixels[..., 1].astype(int)
    seen = el.visible(scene, camera, size=(120, 80))
    front = pixels[seen.node == 1]
    assert front.mean() < 100  # lit from behind, it is dark
    assert pixels[seen.node == 0].max() > front.max() + 60  # in the mirror its bright side shows


def test_glass_throws_no_shadow() -> None:
    sun = el.Node("sun", light=SUN, matrix=DOWN)
    glass = el.Material(base_color=(1, 1, 1, 0.0), alpha_mode="blend")
    mesh = lid(3.0, 0.3)
    clear = el.Node("lid", mesh=el.Mesh(mesh.points, mesh.faces, material=glass))
    assert abs(light_on_the_floor(sun, clear) - light_on_the_floor(sun)).max() <= 1


def test_the_seed_chooses_the_grain_and_nothing_else() -> None:
    scene = el.samples.teapot()
    posed = [Traced(seed=seed) for seed in (0, 0, 1)]
    pictures = [drawn(scene, style) for style in posed]
    assert np.array_equal(pictures[0], pictures[1])
    assert not np.array_equal(pictures[0], pictures[2])
    assert abs(pictures[0].astype(int) - pictures[2]).mean() < 2


def drawn(scene: el.Scene, style: Traced) -> np.ndarray:
    from eyeline.projection import project
    from eyeline.shading.cutout import see
    from eyeline.shading.frame import Frame
    from eyeline.shading.look import Look
    from eyeline.visibility import METHODS

    projected = project(scene, el.Camera.framing(scene.bounds), (64, 48))
    return style(Frame(scene, projected, see(scene, projected, METHODS["zbuffer"]), Look()))


def test_fewer_rays_for_what_is_seen_in_mirrors() -> None:
    counts = RayCounts()
    assert counts.after(0) == counts
    assert counts.after(1).sky < counts.sky
    assert counts.after(1).mirror == 1


def test_patterns_are_even_over_the_disk() -> None:
    for count in (32, 64):
        pattern = disk_pattern(count)
        radius = (pattern**2).sum(axis=1)
        assert radius.max() <= 1
        assert abs(radius.mean() - 0.5) < 0.1
        assert np.abs(pattern.mean(axis=0)).max() < 0.15
    turns = turns_of(np.arange(5000), 100, 3)
    assert np.abs(turns.mean(axis=0)).max() < 0.02


def test_one_thread_and_many_draw_the_same_picture() -> None:
    def digest(count: str) -> str:
        run = subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env=os.environ | {"PYTHONPATH": str(PROJECT / "src"), "EYELINE_THREADS": count},
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stderr
        return run.stdout.strip()

    assert len({digest(count) for count in ("1", "2", "5")}) == 1
