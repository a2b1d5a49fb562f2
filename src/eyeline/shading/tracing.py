"""Light found by rays: shadows as soft as their lamps are wide, a sky open or closed, mirrors. [Whitted80]

The materials, the lights and the surroundings are those of every other picture; only what stands between is
found by rays instead of maps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.rays import Hits, cast, first_hits
from eyeline.shading.attributes import gather
from eyeline.shading.encoding import DECODED
from eyeline.shading.environment import add_environment
from eyeline.shading.lanes import (
    EMISSIVE_RED,
    LIT,
    OPEN,
    OUT_RED,
    RED,
    ROUGHNESS,
    ROWS,
    SPARE,
    TILE,
    UNLIT,
)
from eyeline.shading.light_table import light_table
from eyeline.shading.ray_aims import aim_at_light, aim_at_mirror, aim_at_sky, disk_pattern, turns_of
from eyeline.shading.ray_gathering import face_ray, mirrors, take_light, take_mirror, take_sky
from eyeline.shading.ray_world import RayWorld, ray_world
from eyeline.shading.reflectance import add_light, prepare
from eyeline.shading.studio import lighting_of
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.texturing import lay_textures
from eyeline.shading.tone import show

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame

SMOOTH = 0.05  # roughness up to which all rays of a mirror go one way


@dataclass(frozen=True)
class RayCounts:
    """How many rays a point casts."""

    sky: int = 32
    light: int = 48  # for each light, where its shadow has an outline
    light_first: int = 8  # that find out whether it has
    mirror: int = 6  # of a mirror that is not smooth
    bounces: int = 3  # of what is seen in mirrors in mirrors

    def after(self, bounce: int) -> RayCounts:
        """Fewer for what is seen in a mirror."""
        return (
            self if bounce == 0 else RayCounts(max(self.sky // 4, 1), self.light_first, self.light_first, 1)
        )


@dataclass(frozen=True, eq=False)
class Tracer:
    """The light of one frame."""

    frame: Frame
    world: RayWorld
    lights: FloatArray  # (L, 14)
    environment: FloatArray  # (12,)
    reach: float  # metres: what is farther leaves the sky open
    rays: RayCounts
    seed: int

    def colours(self, points: SurfacePoints) -> FloatArray:
        """(K, 4) float32: what the screen shows of each point, linear 0..1, alpha last and not multiplied."""
        look = self.frame.look
        colours = np.empty((len(points), 4), np.float32)
        gain, neutral = np.float32(2.0**look.exposure), np.float32(look.tone == "neutral")
        for begin in range(0, len(points), TILE):
            end = min(begin + TILE, len(points))
            lanes = self.gathered(points, begin, end)
            prepare(lanes, end - begin, self.frame.sight)
            self.light(lanes, points.pixel[begin:end], 0)
            show(lanes, end - begin, gain, neutral, colours, begin)
        return colours

    def gathered(self, points: SurfacePoints, begin: int, end: int) -> FloatArray:
        """The lanes of some points, not lit yet."""
        lanes, painted = np.empty((ROWS, TILE + SPARE), np.float32), np.full(TILE, -1)
        frame, where = self.frame, (points.face, points.x, points.y)
        gather(frame.geometry, frame.materials, where, begin, end, False, lanes, painted)
        if frame.textured:
            lay_textures(frame.geometry, frame.materials, DECODED, where, begin, end, lanes)
        return lanes

    def light(self, lanes: FloatArray, pixel: IntArray, bounce: int) -> None:
        """Fill what leaves the points of lanes towards the eye."""
        count, rays = len(pixel), self.rays.after(bounce)
        turns = turns_of(pixel, self.frame.size[0], self.seed + bounce)
        self.open_sky(lanes, turns, rays)
        add_environment(lanes, count, self.environment)
        for row in range(len(self.lights)):
            self.arrive(lanes, row, turns, rays)
            add_light(lanes, count, self.lights, row)
        if bounce < self.rays.bounces:
            self.mirror(lanes, pixel, turns, bounce)

    def light_floor(self, lanes: FloatArray, pixel: IntArray) -> None:
        """Fill what arrives at places on the studio floor, of the sky and of the key."""
        turns = turns_of(pixel, self.frame.size[0], self.seed)
        self.open_sky(lanes, turns, self.rays)
        self.arrive(lanes, 0, turns, self.rays)

    def open_sky(self, lanes: FloatArray, turns: FloatArray, rays: RayCounts) -> None:
        """Fill OPEN."""
        amount, count = self.frame.look.occlusion, len(turns)
        lanes[OPEN, :count] = 1
        if amount > 0:
            every = np.arange(count)
            origins, directions = np.empty((2, count * rays.sky, 3), np.float32)
            lift, floor = np.float32(self.world.lift), self.frame.floor
            aim_at_sky(lanes, every, disk_pattern(rays.sky), turns, lift, origins, directions)
            reach = np.full(len(origins), self.reach, np.float32)
            hits = cast(self.world.tree, (origins, directions), reach, False, 1)
            below = float("-inf") if floor is None else floor.below_eye
            numbers = below, np.float32(self.reach), np.float32(amount)
            take_sky(lanes, every, origins, directions, hits.length, *numbers)

    def arrive(self, lanes: FloatArray, row: int, turns: FloatArray, rays: RayCounts) -> None:
        """Fill LIT with the part of a light that arrives: a few rays tell where its shadow has an outline."""
        lanes[LIT, : len(turns)] = 1
        if not self.frame.look.shadows:
            return
        pattern, first = disk_pattern(rays.light), rays.light_first
        self.shadow(lanes, np.arange(len(turns)), row, pattern[:first], turns, 0)
        lit = lanes[LIT, : len(turns)]
        unsure = np.flatnonzero((lit > 0) & (lit < 1))
        if rays.light > first:
            self.shadow(lanes, unsure, row, pattern[first:], turns, first)

    def shadow(
        self,
        lanes: FloatArray,
        chosen: IntArray,
        row: int,
        pattern: FloatArray,
        turns: FloatArray,
        begun: int,
    ) -> None:
        """Cast some rays of chosen lanes to a light, beside those that were cast before."""
        count = len(chosen) * len(pattern)
        origins, directions = np.empty((2, count, 3), np.float32)
        reach, lift = np.empty(count, np.float32), np.float32(self.world.lift)
        aim_at_light(lanes, chosen, self.lights, row, pattern, turns, lift, origins, directions, reach)
        hits = cast(self.world.tree, (origins, directions), reach, True, 1)
        take_light(lanes, chosen, hits.face, reach, begun, begun + len(pattern))

    def mirror(self, lanes: FloatArray, pixel: IntArray, turns: FloatArray, bounce: int) -> None:
        """Put what mirrors show in place of the surroundings."""
        weight, seen = np.empty((2, 3, len(pixel)), np.float32)
        mirrors(lanes, len(pixel), self.environment, weight, seen)
        shows, smooth = weight.max(axis=0) > 0, lanes[ROUGHNESS, : len(pixel)] <= SMOOTH
        for chosen, count in ((shows & smooth, 1), (shows & ~smooth, self.rays.after(bounce).mirror)):
            found = np.flatnonzero(chosen)
            pattern = disk_pattern(count) if count > 1 else np.zeros((1, 2), np.float32)
            origins, directions = np.empty((2, len(found) * count, 3), np.float32)
            lift = np.float32(self.world.lift)
            aim_at_mirror(lanes, found, pattern, turns, lift, origins, directions)
            hits = first_hits(self.world.tree, origins, directions, parts=1)
            met = np.flatnonzero(hits.face >= 0)
            row = np.full(len(origins), -1)
            row[met] = np.arange(len(met))
            rays = origins[met], directions[met], np.repeat(pixel[found], count)[met]
            light = self.seen_along(*rays, Hits(hits.face[met], hits.length[met]), bounce)
            take_mirror(lanes, found, weight, seen, row, light)

    def seen_along(
        self, origins: FloatArray, directions: FloatArray, pixel: IntArray, hits: Hits, bounce: int
    ) -> FloatArray:
        """(M, 3) the light that comes back along rays that have all met something."""
        count = len(pixel)
        places = origins + directions * hits.length[:, None]
        unit = directions / np.sqrt((directions**2).sum(axis=1, keepdims=True))
        picture = self.world.picture
        x, y, w = transform.product(picture[:, :3], places.T.astype(np.float64)) + picture[:, 3:]
        # A face has one place on each line through the eye, also behind it and beside the picture
        face = self.world.face[hits.face]
        points = SurfacePoints(pixel, face, (x / w).astype(np.float32), (y / w).astype(np.float32))
        light = np.zeros((count, 3), np.float32)
        for begin in range(0, count, TILE):
            end = min(begin + TILE, count)
            lanes = self.gathered(points, begin, end)
            prepare(lanes, end - begin, self.frame.sight)
            face_ray(lanes, end - begin, places[begin:end], unit[begin:end])
            self.light(lanes, pixel[begin:end], bounce + 1)
            lanes = lanes[:, : end - begin]
            leaving = lanes[OUT_RED : OUT_RED + 3] + lanes[EMISSIVE_RED : EMISSIVE_RED + 3]
            light[begin:end] = np.where(lanes[UNLIT] > 0, lanes[RED : RED + 3], leaving).T
        return np.nan_to_num(light, nan=0.0, posinf=0.0)


def tracer_of(frame: Frame, rays: RayCounts, seed: int, reach_part: float) -> Tracer:
    """The tracer of a frame; uses all threads, so call it before the strips are drawn."""
    camera, diagonal = frame.projected.camera, frame.scene.bounds.diagonal or 1.0
    lighting = lighting_of(frame.scene, camera)
    lights = light_table(lighting.lights, camera.world_from_eye[:3, 3])
    world = ray_world(frame.projected, diagonal)
    return Tracer(frame, world, lights, lighting.environment, reach_part * diagonal, rays, seed)
