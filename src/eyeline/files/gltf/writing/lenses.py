"""Cameras and lights. [glTF 2.0, 3.10; KHR_lights_punctual]"""

from __future__ import annotations

import math
from collections.abc import Callable

from eyeline.files.gltf.writing.store import Store, Thing, named, number, numbers
from eyeline.geometry.bounds import Bounds
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light

NARROWEST = 1e-6  # radians between the cones of a spot light: the format has no sharp edge


def camera_of(camera: Camera, bounds: Bounds, note: Callable[[str], None]) -> Thing:
    """A lens; bounds: of what it sees, in which a plane it lacks is found."""
    if camera.near is None or (camera.fov is None and camera.far is None):
        camera = camera.fitted(bounds)
        which = f"camera {camera.name!r}" if camera.name else "the camera"
        note(f"{which} gets the planes of what it sees, as glTF asks for some")
    planes: Thing = {"znear": number(max(camera.near or 0.0, 0.0))}
    if camera.far is not None and math.isfinite(camera.far):
        planes["zfar"] = number(camera.far)
    if camera.fov is not None:
        shape = {} if camera.aspect is None else {"aspectRatio": number(camera.aspect)}
        lens = {"yfov": number(camera.fov), **shape, **planes}
        return named(camera.name, {"type": "perspective", "perspective": lens})
    assert camera.height is not None and camera.near is not None and camera.far is not None
    if camera.near < 0:
        note(f"camera {camera.name!r} sees what is behind it, which glTF has no number for; move it back")
        planes["zfar"] = number(max(camera.far, 1.0))
    half = camera.height / 2
    lens = {"xmag": number(half * (camera.aspect or 1.0)), "ymag": number(half), **planes}
    return named(camera.name, {"type": "orthographic", "orthographic": lens})


def light_of(light: Light) -> Thing:
    """A source; a colour brighter than white goes to its intensity."""
    excess = max(1.0, *light.color)
    thing: Thing = {
        "type": light.kind,
        "color": numbers([channel / excess for channel in light.color]),
        "intensity": number(light.intensity * excess),
    }
    if math.isfinite(light.range) and light.kind != "directional":
        thing["range"] = number(light.range)
    if light.kind == "spot":
        outer = max(light.outer_cone, NARROWEST)
        inner = min(light.inner_cone, outer - NARROWEST)
        thing["spot"] = {"innerConeAngle": number(inner), "outerConeAngle": number(outer)}
    return named(light.name, thing)


def light_number(store: Store, light: Light) -> int:
    """The number of a new light in the file."""
    lights = store.root_extensions.setdefault("KHR_lights_punctual", {"lights": []})["lights"]
    lights.append(light_of(light))
    return len(lights) - 1
