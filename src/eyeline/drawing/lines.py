"""The lines of a scene: which are there, and which parts of them are seen."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from eyeline.cached import cached_property
from eyeline.drawing.cells import cells_for, farthest_in
from eyeline.drawing.chains import chained
from eyeline.drawing.choice import chosen_edges, facings
from eyeline.drawing.crossings import crossing_strokes
from eyeline.drawing.doubles import without_doubles
from eyeline.drawing.grid import Grid
from eyeline.drawing.hiders import corners_of, hiders_of
from eyeline.drawing.hiding import Spans, spans_of
from eyeline.drawing.model import Model, model_of
from eyeline.drawing.strokes import Strokes, cut_to, edge_strokes, joined, once
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from eyeline.geometry.cells import passages_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene


@dataclass(frozen=True, eq=False)
class Path:
    """A line without a break, of one kind and one node, all seen or all hidden."""

    points: FloatArray  # (K, 2) pixels, x right, y down
    kind: int  # OUTLINE, BOUNDARY ...
    node: int
    seen: bool


@dataclass(frozen=True, eq=False)
class Lines:
    """Straight pieces within the picture, seen and hidden, each along one edge or crossing of two faces."""

    size: tuple[int, int]  # pixels
    pixels: FloatArray  # (N, 2, 2) ends in the picture
    world: FloatArray  # (N, 2, 3) ends in the world
    kind: ByteArray  # (N,) OUTLINE, BOUNDARY ...
    node: IntArray  # (N,)
    faces: IntArray  # (N, 2) scene faces the piece lies in; -1 is none
    seen: BoolArray  # (N,)
    name: IntArray  # (N, 2) ends of the same name meet; -1 ends where something begins to hide, or is cut

    def only(self, wanted: BoolArray) -> Lines:
        """Some of the pieces (N,)."""
        size, *arrays = (getattr(self, field.name) for field in fields(self))
        return Lines(size, *(array[wanted] for array in arrays))

    @cached_property
    def paths(self) -> tuple[Path, ...]:
        """Pieces joined to long paths, node after node, kind after kind."""
        group = (self.node * 256 + self.kind) * 2 + self.seen
        chains = chained(group, self.name)
        piece = chains.enter // 2
        enter, leave = self.pixels[piece, chains.enter % 2], self.pixels[piece, 1 - chains.enter % 2]
        paths = []
        for begin, end in zip(chains.start[:-1], chains.start[1:], strict=True):
            first = piece[begin]
            points = np.concatenate([enter[begin:end], leave[end - 1 : end]])
            paths.append(Path(points, int(self.kind[first]), int(self.node[first]), bool(self.seen[first])))
        return tuple(sorted(paths, key=lambda path: (path.node, path.kind, path.seen)))


def lines_of(
    scene: Scene, camera: Camera, size: tuple[int, int], kinds: tuple[str, ...], crease: float
) -> Lines:
    """The lines of a posed scene before a camera, in a picture of `size` (width, height) pixels.

    kinds: names in KINDS. crease: radians between the directions of two faces.
    """
    camera = camera.fitted(scene.bounds)
    grid = Grid.of(camera, size)
    model = model_of(scene, camera, grid)
    facing = facings(model, grid.perspective)
    strokes = edge_strokes(model, *chosen_edges(model, facing, kinds, crease))
    if "intersection" in kinds:
        crossings = crossing_strokes(model, np.flatnonzero(facing).astype(np.int32))
        strokes = strokes if crossings is None else joined(strokes, crossings)
    strokes = once(cut_to(strokes, grid))
    corners = corners_of(model, facing, grid)
    cells = cells_for(corners, grid)
    passages = passages_of(np.ascontiguousarray(strokes.screen.reshape(-1, 6)), cells)
    hiders = hiders_of(corners, cells, farthest_in(cells, strokes, passages))
    spans = spans_of(strokes, model, grid, passages, hiders)
    spans = without_doubles(spans, strokes, grid, passages)
    return gathered(strokes, spans, model, grid, camera)


def gathered(strokes: Strokes, spans: Spans, model: Model, grid: Grid, camera: Camera) -> Lines:
    """Pieces of strokes as people want them: pixels, metres, numbers of the scene."""
    row, ends = spans.row, spans.ends
    screen = strokes.screen[row]
    pixels = (screen[:, :1, :2] + ends[..., None] * (screen[:, 1:, :2] - screen[:, :1, :2])) / grid.unit
    along = ends
    if grid.perspective:
        first, last = screen[:, :1, 2], screen[:, 1:, 2]
        along = ends * last / ((1 - ends) * first + ends * last)
    points = strokes.points[row]
    eye = points[:, :1] + along[..., None] * (points[:, 1:] - points[:, :1])
    m = camera.world_from_eye
    world = np.stack(
        [m[k, 0] * eye[..., 0] + m[k, 1] * eye[..., 1] + m[k, 2] * eye[..., 2] + m[k, 3] for k in range(3)],
        axis=-1,
    )
    own = strokes.own[row]
    faces = np.where(own >= 0, model.scene_face[own], -1) if len(own) else own.astype(np.int64)
    name = np.where(ends == np.array([0.0, 1.0]), strokes.name[row], -1)
    node = model.node[strokes.surface[row]] if len(row) else np.empty(0, np.int64)
    # Instances of a node share its number, not its vertices: names are of the whole model
    return Lines(grid.size, pixels, world, strokes.kind[row], node, faces, spans.seen, name)
