"""A scene: nodes in a tree, with clips that move them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from os import PathLike
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import SceneError, suggestion
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bounds import Bounds
from eyeline.scene.animation import Animation
from eyeline.scene.camera import Camera
from eyeline.scene.constraint import Constraint
from eyeline.scene.light import Light
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.pose import Samples, bends, differences, found, places_of, solved
from eyeline.scene.surface import Surface, surfaces_of


@dataclass(frozen=True, eq=False)
class Scene:
    """Nodes, parents before children; clips; and what its reader had to say.

    Faces are numbered node after node, instance after instance, face after face.
    """

    nodes: tuple[Node, ...] = ()
    clips: tuple[Animation, ...] = ()
    notes: tuple[str, ...] = ()  # one sentence each: what the file held that is not drawn or was repaired
    name: str = ""
    extensions: tuple[str, ...] = ()  # of the format, that its file names
    constraints: tuple[Constraint, ...] = ()  # kept in this order, after the clip has moved the nodes

    def __post_init__(self) -> None:
        """Refuse a tree that is none."""
        for index, node in enumerate(self.nodes):
            if not -1 <= node.parent < index:
                raise SceneError(f"node {index} ({node.name!r}) has parent {node.parent}; parents come first")
        names = [constraint.name for constraint in self.constraints]
        if doubled := {name for name in names if names.count(name) > 1}:
            raise SceneError(f"constraint {min(doubled)!r} is there twice; one of each name is needed")

    def __repr__(self) -> str:
        """What it holds, in a line; its arrays and textures would fill pages."""
        meshes = len({id(node.mesh) for node in self.nodes if node.mesh is not None})
        return f"Scene({self.name!r}, nodes={len(self.nodes)}, meshes={meshes}, clips={len(self.clips)})"

    @classmethod
    def of(
        cls, *things: Mesh | Node | Camera | Light, clips: Iterable[Animation] = (), name: str = ""
    ) -> Scene:
        """A scene of meshes, lights, cameras and ready nodes, side by side in the world."""
        nodes = []
        for index, thing in enumerate(things):
            match thing:
                case Node():
                    nodes.append(thing)
                case Mesh():
                    nodes.append(Node(thing.name or f"mesh {index}", mesh=thing))
                case Camera():
                    nodes.append(
                        Node(thing.name or f"camera {index}", matrix=thing.world_from_eye, camera=thing)
                    )
                case Light():
                    nodes.append(Node(thing.name or f"light {index}", light=thing))
                case _:
                    raise SceneError(
                        f"a scene is made of meshes, nodes, cameras and lights, not {type(thing).__name__}"
                    )
        return cls(tuple(nodes), tuple(clips), name=name)

    def save(
        self, path: str | PathLike[str], *, fps: float = 60.0, tolerance: float = 1e-4
    ) -> tuple[str, ...]:
        """Write it to a file whose suffix decides the format: .glb or .gltf.

        fps: how often constraints and deformers are asked what they do, which the format has no words for.
        tolerance: how far keys may be from what they stand for, as a part of its range. Answers a sentence
        for each thing that is sampled or lost.
        """
        # Files stand above the nouns and know them all; this one name of theirs is found when it is called
        files = import_module("eyeline.files.saving")
        return cast("tuple[str, ...]", files.save(self, path, files.Sampling(fps, tolerance)))

    # --- names ------------------------------------------------------------------------------------------

    @cached_property
    def paths(self) -> tuple[str, ...]:
        """Every node's names from its root down, joined by '/'; a doubled path gets '.1', '.2' ..."""
        paths: list[str] = []
        taken: set[str] = set()
        for index, node in enumerate(self.nodes):
            own = node.name or f"node {index}"
            path = f"{paths[node.parent]}/{own}" if node.parent >= 0 else own
            unique, count = path, 0
            while unique in taken:
                count += 1
                unique = f"{path}.{count}"
            taken.add(unique)
            paths.append(unique)
        return tuple(paths)

    def find(self, path: str | int) -> int:
        """The index of the node with this path, or with this end of a path if only one has it."""
        return found(path, self.paths)

    def __getitem__(self, path: str | int) -> Node:
        return self.nodes[self.find(path)]

    def clip(self, clip: str | int | None) -> Animation | None:
        """The clip of this name or number; the first for None, and None if there is none."""
        if clip is None:
            return self.clips[0] if self.clips else None
        names = [one.name for one in self.clips]
        if isinstance(clip, int) and 0 <= clip < len(self.clips):
            return self.clips[clip]
        if clip in names:
            return self.clips[names.index(str(clip))]
        raise SceneError(f"there is no clip {clip!r}{suggestion(str(clip), names)}")

    # --- the world --------------------------------------------------------------------------------------

    @cached_property
    def world(self) -> FloatArray:
        """(N, 4, 4) world_from_node."""
        world: FloatArray = places_of(self.nodes).world[0]
        return world

    @cached_property
    def surfaces(self) -> tuple[Surface, ...]:
        """Every mesh where it stands, skinned and morphed, in the order that numbers the faces."""
        return surfaces_of(self.nodes, self.world)

    @cached_property
    def bounds(self) -> Bounds:
        """The box around everything visible, world space."""
        bounds = Bounds.empty()
        for surface in (one for one in self.surfaces if one.visible):
            bounds = bounds.union(surface.mesh.bounds.moved(surface.world_from_mesh))
        return bounds

    @cached_property
    def cameras(self) -> tuple[Camera, ...]:
        """Every camera where its node stands; scale does not reach a lens."""
        cameras = []
        for node, path, matrix in zip(self.nodes, self.paths, self.world, strict=True):
            if node.camera is not None:
                cameras.append(replace(node.camera.moved(rigid(matrix)), name=node.camera.name or path))
        return tuple(cameras)

    @cached_property
    def lights(self) -> tuple[tuple[Light, FloatArray], ...]:
        """Every light with its world_from_light (4, 4)."""
        return tuple(
            (node.light, rigid(matrix))
            for node, matrix in zip(self.nodes, self.world, strict=True)
            if node.light
        )

    @property
    def face_count(self) -> int:
        """Faces, instances counted."""
        return sum(len(surface.mesh.faces) for surface in self.surfaces)

    @property
    def duration(self) -> float:
        """Seconds of the first clip; 0 without."""
        return self.clips[0].duration if self.clips else 0.0

    # --- time -------------------------------------------------------------------------------------------

    def at(self, time: float, clip: str | int | None = None) -> Scene:
        """This scene as it stands at `time`, seconds, in a clip (the first if none is named).

        Pure: any order of times gives the same. The answer stands still: it has no clips, so that whoever
        gets it, at whatever time, sees this pose. A scene that nothing moves is its own answer.
        """
        if not np.isfinite(time):
            raise SceneError(f"time is {time}; a finite number of seconds is needed")
        chosen = self.clip(clip)
        return self._settled if chosen is None else chosen.pose(self, float(time))

    def sample(self, times: npt.ArrayLike, clip: str | int | None = None) -> Samples:
        """Node transforms and morph weights at many times (T,) at once; no scene is copied."""
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        if not np.isfinite(seconds).all():
            raise SceneError("times hold a number that is not finite")
        chosen = self.clip(clip)
        if chosen is None:
            return solved(Samples.still(self, len(seconds)), self.constraints, {})
        return chosen.sample(self, seconds)

    @cached_property
    def _settled(self) -> Scene:
        """This scene with its constraints kept, as it stands without a clip."""
        if not self.constraints:
            return self
        rest = Samples.still(self, 1)
        pose = solved(rest, self.constraints, {})
        return self.with_changes(differences(rest, pose)).bent(pose)

    def bent(self, pose: Samples) -> Scene:
        """This scene, posed, with what constraints add to its deformers; pose: of one time (T = 1)."""
        return self.with_changes(bends(pose, self.nodes)) if pose.deforms else self

    def with_changes(self, changes: Mapping[int, Mapping[str, Any]]) -> Scene:
        """This scene posed: with other fields of some nodes, without what moves them."""
        nodes = list(self.nodes)
        for index, values in changes.items():
            nodes[index] = nodes[index].changed(**values)
        return replace(self, nodes=tuple(nodes), clips=(), constraints=())


def rigid(matrix: FloatArray) -> FloatArray:
    """The matrix with its axes made unit and perpendicular, y and then z keeping their places best."""
    back = matrix[:3, 2] / (np.sqrt((matrix[:3, 2] ** 2).sum()) or 1)
    right = np.cross(matrix[:3, 1], back)
    right = right / (np.sqrt((right**2).sum()) or 1)
    straight = np.eye(4)
    straight[:3, :3] = np.stack([right, np.cross(back, right), back], axis=-1)
    straight[:3, 3] = matrix[:3, 3]
    return straight
