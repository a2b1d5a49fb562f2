"""The whole scene as one mesh before the eye."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.drawing.grid import Grid
from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from eyeline.projection.sides import sides_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene
from eyeline.scene.surface import Surface
from eyeline.scene.topology import Topology, topology_of


@dataclass(frozen=True, eq=False)
class Model:
    """Every visible surface of a scene in eye space, with its topology, and where it is on the grid."""

    surfaces: tuple[Surface, ...]  # (S,) those that are visible
    points: FloatArray  # (V, 3) float64 eye space
    screen: FloatArray  # (V, 3) grid x, grid y, depth
    outside: BoolArray  # (V,) must be cut away
    faces: IntArray  # (F, 3) int32
    surface: IntArray  # (F,) int32: which of the surfaces
    sides: ByteArray  # (F,) which sides count, COUNTER_CLOCKWISE | CLOCKWISE, as they turn on the screen
    part: IntArray  # (F,) int32: a number that faces share if vertices connect them
    edges: IntArray  # (E, 4) int32: vertex, vertex, face, face or -1
    odd: ByteArray  # (E,) PLAIN, TWISTED or BRANCHING
    face_edges: IntArray  # (F, 3) int32: the edge from each corner to the next, or -1

    @cached_property
    def scene_face(self) -> IntArray:
        """(F,) the number in the scene of each face."""
        counts = [len(surface.mesh.faces) for surface in self.surfaces]
        first = np.array([surface.first_face for surface in self.surfaces], dtype=np.int64)
        own = np.concatenate([[0], np.cumsum(counts)])[:-1].astype(np.int64)
        return np.arange(len(self.faces)) + np.repeat(first - own, counts)

    @cached_property
    def node(self) -> IntArray:
        """(S,) the node of each surface."""
        return np.array([surface.node for surface in self.surfaces], dtype=np.int64)


def model_of(scene: Scene, camera: Camera, grid: Grid) -> Model:
    """A posed scene before a camera."""
    surfaces = tuple(surface for surface in scene.surfaces if surface.visible and len(surface.mesh.faces))
    shapes = [topology_of(surface.mesh) for surface in surfaces]
    eye_from_world = camera.eye_from_world
    placed = [eye_points(surface, eye_from_world) for surface in surfaces]
    points = np.concatenate(placed) if placed else np.empty((0, 3))
    screen, outside = grid.place(points)
    vertex = starts([len(one) for one in placed])
    face = starts([len(shape.faces) for shape in shapes])
    edge = starts([len(shape.edges) for shape in shapes])
    counts = [len(shape.faces) for shape in shapes]
    return Model(
        surfaces, points, screen, outside,
        faces=stacked([shape.faces for shape in shapes], vertex, 3),
        surface=np.repeat(np.arange(len(surfaces), dtype=np.int32), counts),
        sides=np.concatenate([np.empty(0, np.uint8)] + [broad_sides(one) for one in surfaces]),
        part=stacked([shape.part for shape in shapes], vertex),
        edges=numbered_edges(shapes, vertex, face),
        odd=np.concatenate([np.empty(0, np.uint8)] + [shape.odd for shape in shapes]),
        face_edges=numbered_sides(shapes, edge),
    )  # fmt: skip


def eye_points(surface: Surface, eye_from_world: FloatArray) -> FloatArray:
    """(V, 3) float64 the points of a surface before the eye, summed in a fixed order."""
    if not np.isfinite(surface.world_from_mesh).all():
        raise GeometryError(
            f"mesh {surface.mesh.name!r} of node {surface.node} stands at a place that is not finite"
        )
    m = transform.product(eye_from_world, surface.world_from_mesh)
    x, y, z = surface.mesh.points.T.astype(np.float64)
    moved = np.empty((len(x), 3))
    for row in range(3):
        moved[:, row] = m[row, 0] * x + m[row, 1] * y + m[row, 2] * z + m[row, 3]
    return moved


def broad_sides(surface: Surface) -> ByteArray:
    """(F,) the sides of a surface's faces that its materials let be seen."""
    sides = sides_of(surface, "auto")
    return np.full(len(surface.mesh.faces), sides, np.uint8) if isinstance(sides, int) else sides


# --- numbers of a mesh to numbers of the model ------------------------------------------------------------


def starts(counts: list[int]) -> list[int]:
    """Where each of several rows of things begins when they stand end to end."""
    return [0, *np.cumsum(counts, dtype=np.int64).tolist()][: len(counts)]


def stacked(parts: list[IntArray], first: list[int], width: int = 0) -> IntArray:
    """Arrays of numbers end to end, each counted from its own first."""
    shape = (0, width) if width else (0,)
    moved = [part + np.int32(offset) for part, offset in zip(parts, first, strict=True)]
    return np.concatenate([np.empty(shape, np.int32), *moved])


def numbered_edges(shapes: list[Topology], vertex: list[int], face: list[int]) -> IntArray:
    """(E, 4) the edges of all meshes."""
    edges = np.concatenate([np.empty((0, 4), np.int32)] + [shape.edges for shape in shapes])
    begin = 0
    for shape, first_vertex, first_face in zip(shapes, vertex, face, strict=True):
        own = edges[begin : begin + len(shape.edges)]
        own += np.array([first_vertex, first_vertex, first_face, first_face], np.int32)
        own[shape.open_edges, 3] = -1
        begin += len(shape.edges)
    return edges


def numbered_sides(shapes: list[Topology], edge: list[int]) -> IntArray:
    """(F, 3) the edges along the sides of all faces."""
    sides = stacked([shape.face_edges for shape in shapes], edge, 3)
    begin = 0
    for shape in shapes:
        sides[begin : begin + len(shape.faces)][shape.flat_faces] = -1
        begin += len(shape.faces)
    return sides
