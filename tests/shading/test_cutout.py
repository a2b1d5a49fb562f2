"""Holes: where a texture says a face ends, what lies behind is seen."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.geometry.arrays import BoolArray
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.material import AlphaMode, Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.scene.texture import Texture, TextureSlot
from eyeline.shading.cutout import see
from eyeline.visibility import METHODS
from eyeline.visibility.method import Visible

SIZE = (32, 32)
CAMERA = Camera(height=2.0, near=0.5, far=100.0)


def sheet(
    distance: float, alpha: BoolArray | None = None, mode: AlphaMode = "mask", cutoff: float = 0.5
) -> Mesh:
    """A square that fills the picture; alpha (rows, columns) from its upper left corner says where it is."""
    slot = None
    if alpha is not None:
        pixels = np.full((*alpha.shape, 4), 255, np.uint8)
        pixels[..., 3] = np.where(alpha, 255, 0)
        slot = TextureSlot(Texture(pixels, wrap=("clamp", "clamp"), nearest=True, mipmaps=False))
    material = Material(
        base_color=(1, 1, 1, 1), base_color_texture=slot, alpha_mode=mode, alpha_cutoff=cutoff, unlit=True
    )
    points = [(-1, -1, -distance), (1, -1, -distance), (1, 1, -distance), (-1, 1, -distance)]
    uv = [(0, 1), (1, 1), (1, 0), (0, 0)]
    return Mesh(points, [(0, 1, 2), (0, 2, 3)], uv=[uv], material=material)


def seen(*meshes: Mesh, shift: tuple[int, int] = (0, 0)) -> Visible:
    scene = Scene.of(*meshes)
    ((visible, _, _),) = see(scene, project(scene, CAMERA, SIZE), METHODS["zbuffer"], [shift])
    return visible


CHECKS = np.indices((8, 8)).sum(axis=0) % 2 == 0
EACH = np.kron(CHECKS, np.ones((4, 4), bool))  # the same for every pixel


def test_hole_shows_what_is_behind() -> None:
    visible = seen(sheet(2.0, CHECKS), sheet(5.0, mode="opaque"))
    assert ((visible.face < 2) == EACH).all()
    assert (visible.face >= 0).all()
    assert np.isclose(visible.distance[EACH], 2.0).all() and np.isclose(visible.distance[~EACH], 5.0).all()


def test_hole_shows_the_background() -> None:
    visible = seen(sheet(2.0, CHECKS))
    assert ((visible.face >= 0) == EACH).all()
    assert (visible.depth[~EACH] == 0).all() and (visible.node[~EACH] == -1).all()


def test_a_hole_in_a_hole_shows_the_next_sheet() -> None:
    upper = np.repeat([[True], [True], [True], [True], [False], [False], [False], [False]], 8, axis=1)
    visible = seen(sheet(5.0, mode="opaque"), sheet(3.0, CHECKS), sheet(2.0, upper))
    top = np.kron(upper, np.ones((4, 4), bool))
    assert (visible.node == np.where(top, 2, np.where(EACH, 1, 0))).all()


def test_a_solid_face_before_a_mask_hides_it() -> None:
    visible = seen(sheet(5.0, CHECKS), sheet(2.0, mode="opaque"))
    assert (visible.node == 1).all()


@pytest.mark.parametrize("masked_first", [True, False])
def test_at_equal_depth_the_lower_face_number_wins(masked_first: bool) -> None:
    both = [sheet(3.0, CHECKS), sheet(3.0, mode="opaque")]
    visible = seen(*(both if masked_first else both[::-1]))
    if masked_first:
        assert (visible.node == np.where(EACH, 0, 1)).all()
    else:
        assert (visible.node == 0).all()


def test_alpha_at_the_cutoff_is_no_hole() -> None:
    opaque_alpha = Material(base_color=(1, 1, 1, 0.25), alpha_mode="mask", alpha_cutoff=0.25)
    less_alpha = Material(base_color=(1, 1, 1, 0.2499), alpha_mode="mask", alpha_cutoff=0.25)
    mesh = sheet(2.0)
    assert (seen(mesh.with_material(opaque_alpha)).face >= 0).all()
    assert (seen(mesh.with_material(less_alpha)).face == -1).all()


def test_vertex_alpha_cuts_too() -> None:
    mesh = sheet(2.0)
    colors = np.ones((4, 4), np.float32)
    colors[[1, 2], 3] = 0  # none at the right border: half of it is the middle
    visible = seen(mesh.changed(colors=colors))
    assert (visible.face[:, :16] >= 0).all() and (visible.face[:, 16:] == -1).all()


def test_holes_move_with_the_sample() -> None:
    left = np.zeros((1, 32), bool)
    left[:, :16] = True
    mesh = sheet(2.0, np.repeat(left, 32, axis=0))
    assert (seen(mesh, shift=(-100, 0)).face[:, 16] == -1).all()
    assert (seen(mesh, shift=(100, 0)).face[:, 15] >= 0).all()
    wider = seen(mesh, shift=(-255, 0))
    assert (wider.face[:, 16] >= 0).all()


def test_blended_faces_are_solid_unless_looked_through() -> None:
    scene = Scene.of(sheet(2.0, mode="blend"), sheet(5.0, mode="opaque"))
    projected = project(scene, CAMERA, SIZE)
    ((solid, _, _),) = see(scene, projected, METHODS["zbuffer"])
    ((through, _, _),) = see(scene, projected, METHODS["zbuffer"], see_through=True)
    assert (solid.node == 0).all() and (through.node == 1).all()


def test_a_scene_without_masks_is_the_method_s_own_answer() -> None:
    scene = Scene.of(sheet(5.0, mode="opaque"))
    projected = project(scene, CAMERA, SIZE)
    ((visible, _, _),) = see(scene, projected, METHODS["zbuffer"])
    own = METHODS["zbuffer"](projected)
    assert visible.face.tobytes() == own.face.tobytes() and visible.depth.tobytes() == own.depth.tobytes()
    assert "alpha tests" not in visible.work


def test_areas_have_holes() -> None:
    """Behind its holes stands another sheet, which does not hide it."""
    masked, solid = sheet(2.0, CHECKS).changed(name="masked"), sheet(5.0, mode="opaque").changed(name="solid")
    seen_both = seen(masked, solid)
    area = seen_both.area("masked")
    assert (area.pixels, area.unoccluded_pixels, dict(area.occluders)) == (512, 512, {})
    behind = seen_both.area("solid")
    assert (behind.pixels, behind.unoccluded_pixels, dict(behind.occluders)) == (512, 1024, {"masked": 512})
    assert seen_both.method.name == "zbuffer"


def test_the_work_of_alpha_tests_is_counted() -> None:
    assert seen(sheet(2.0, CHECKS)).work["alpha tests"] == 32 * 32
