"""Rays through a tree against Embree, as Open3D's RaycastingScene has it; and against our own depth buffer.

Primary rays of a 1920x1080 picture, building the tree, and 2 million rays that are not coherent: from places
on the surface to places on a lamp's disk. `python -m benchmarks.raycast [80k 1.3M 5M 9M]`.
"""

from __future__ import annotations

import sys

import numpy as np

from benchmarks import peers, results
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.rays import blocked
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.raycast.casts import tree_of

SIZE = (1920, 1080)
COUNTS = {"80k": 80_000, "1.3M": 1_300_000, "5M": 5_000_000, "9M": 9_000_000}
CAMERA = Camera.look_at((1.2, 0.9, 2.8), (0, 0, 0), near=0.1)
SHADOW_RAYS = 2_000_000
LIFT = 1e-3  # metres above the surface


class Embree:
    """The peer: a scene of one mesh."""

    def __init__(self, points: np.ndarray, faces: np.ndarray) -> None:
        import open3d

        self.tensor = open3d.core.Tensor
        self.name = f"Embree, Open3D {open3d.__version__}"
        self.points, self.faces = self.tensor(points), self.tensor(faces.astype(np.uint32))
        self._scene = open3d.t.geometry.RaycastingScene
        self.one = self.rays(np.zeros((1, 3)), np.ones((1, 3)))
        self.built = self.build()

    def build(self) -> object:
        """A new scene; it is committed by its first ray."""
        scene = self._scene()
        scene.add_triangles(self.points, self.faces)
        scene.cast_rays(self.one)
        return scene

    def rays(self, origins: np.ndarray, directions: np.ndarray) -> object:
        """Rays as it takes them."""
        return self.tensor(np.concatenate([origins, directions], axis=1).astype(np.float32))

    def first(self, rays: object) -> np.ndarray:
        """(K,) the first face of each ray; -1 is nothing."""
        return self.built.cast_rays(rays)["primitive_ids"].numpy().astype(np.int64)

    def blocked(self, rays: object) -> np.ndarray:
        """(K,) whether each ray meets anything."""
        return self.built.test_occlusions(rays).numpy()


def primary_rays() -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions through the pixels' centres."""
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    up = np.tan((CAMERA.fov or 0) / 2)
    through = [(2 * x / SIZE[0] - 1) * up * SIZE[0] / SIZE[1], (1 - 2 * y / SIZE[1]) * up, -np.ones_like(x)]
    directions = np.stack(through, axis=-1).reshape(-1, 3) @ CAMERA.world_from_eye[:3, :3].T
    return np.broadcast_to(CAMERA.world_from_eye[:3, 3], directions.shape), directions


def shadow_rays(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """From faces anywhere on the mesh, in no order, to places on a disk above it."""
    random = np.random.default_rng(1)
    corners = points[faces[random.integers(0, len(faces), SHADOW_RAYS)]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True)) + 1e-30
    origins = (corners.mean(axis=1) + normals * LIFT).astype(np.float32)
    disk = random.uniform(-2, 2, (SHADOW_RAYS, 3)) * (1, 0, 1) + (1, 4, 2)
    return origins, (disk - origins).astype(np.float32)


def measure(label: str) -> list[results.Row]:
    """Every comparison at one size."""
    points, faces = peers.bumpy_sphere(COUNTS[label])
    scene = Scene.of(Mesh(points, faces))
    theirs, method = Embree(points, faces), METHODS["raycast"]
    rounds = 9 if COUNTS[label] < 2e6 else 5
    projected = project(scene, CAMERA, SIZE, "none")
    rays = theirs.rays(*primary_rays())
    agree(method(projected).face.reshape(-1), theirs.first(rays))
    rows = [
        row(
            f"primary rays, 1920x1080, {label} faces",
            peers.alternate(lambda: method(projected), lambda: theirs.first(rays), rounds),
            theirs.name,
            "<= 1/6",
        ),
        row(
            f"tree over {label} faces",
            peers.alternate(lambda: bvh_of(points, faces), theirs.build, rounds),
            theirs.name,
            "<= 1/5",
        ),
    ]
    origins, directions = shadow_rays(points, faces)
    shadow, reach = theirs.rays(origins, directions), np.full(SHADOW_RAYS, np.inf, np.float32)
    tree = tree_of(scene.surfaces[0].mesh)
    agree(blocked(tree, origins, directions, reach), theirs.blocked(shadow))
    duel = peers.alternate(
        lambda: blocked(tree, origins, directions, reach), lambda: theirs.blocked(shadow), rounds
    )
    rows.append(row(f"2M shadow rays, not coherent, {label} faces", duel, theirs.name, "<= 1"))
    duel = peers.alternate(
        lambda: method(project(scene, CAMERA, SIZE, "none")),
        lambda: METHODS["zbuffer"](project(scene, CAMERA, SIZE, "none")),
        rounds,
    )
    rows.append(row(f"raycast, its tree apart, 1920x1080, {label} faces", duel, "our zbuffer", "<= 3"))
    return rows


def row(what: str, duel: peers.Duel, against: str, bar: str) -> results.Row:
    """A duel, told at once and kept."""
    print(f"{what}: {duel}   cores free {peers.free_cores():.2f}", flush=True)
    return results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, against, bar=bar)


def agree(ours: np.ndarray, theirs: np.ndarray) -> None:
    """Stop if the two do not see the same: then there is nothing to compare."""
    theirs = np.where(theirs == 0xFFFFFFFF, -1, theirs)
    same = (ours == theirs).mean()
    if same < 0.99:
        raise SystemExit(f"answers differ: {same:.4f} of the rays alike")


def main(arguments: list[str]) -> None:
    rows = [row for label in arguments or list(COUNTS) for row in measure(label)]
    results.record("raycast", rows)


if __name__ == "__main__":
    main(sys.argv[1:])
