"""`eyeline info`: what is in a model file."""

from __future__ import annotations

import json as encoding
from typing import TYPE_CHECKING, Any

from eyeline.cli.values import Debug, Json, SceneName, scene_of

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene

NODES_SHOWN = 24


def info(scene: SceneName, json: Json = False, debug: Debug = False) -> None:
    """Tell what is in a file: counts, clips, cameras, lights, materials, and what is not drawn."""
    found = contents(scene_of(scene))
    if json:
        print(encoding.dumps(found))
    else:
        print("\n".join(lines(scene, found)))


def contents(scene: Scene) -> dict[str, Any]:
    """Everything `info` tells, as plain data."""
    meshes = {id(node.mesh): node.mesh for node in scene.nodes if node.mesh is not None}
    materials = {id(one): one for mesh in meshes.values() for one in mesh.materials}
    textures = {id(one): one for material in materials.values() for one in textures_of(material)}
    bounds = scene.bounds
    return {
        "faces": scene.face_count,
        "points": sum(len(surface.mesh.points) for surface in scene.surfaces),
        "meshes": len(meshes),
        "bounds": None if bounds.is_empty else {"low": bounds.low.tolist(), "high": bounds.high.tolist()},
        "nodes": [
            {"path": path, "parent": node.parent, "holds": holds(node), "visible": node.visible}
            for node, path in zip(scene.nodes, scene.paths, strict=True)
        ],
        "clips": [{"name": clip.name, "duration": clip.duration} for clip in scene.clips],
        "cameras": [
            {"name": camera.name, "fov": camera.fov, "height": camera.height} for camera in scene.cameras
        ],
        "lights": [
            {"name": light.name, "kind": light.kind, "intensity": light.intensity}
            for light, _ in scene.lights
        ],
        "materials": [
            {
                "name": one.name,
                "alpha_mode": one.alpha_mode,
                "double_sided": one.double_sided,
                "unlit": one.unlit,
            }
            for one in materials.values()
        ],
        "textures": [
            {"name": one.name, "size": [one.pixels.shape[1], one.pixels.shape[0]]}
            for one in textures.values()
        ],
        "extensions": list(scene.extensions),
        "notes": list(scene.notes),
    }


def textures_of(material: Any) -> list[Any]:
    """The textures of a material's slots."""
    slots = [value for name, value in vars(material).items() if name.endswith("_texture")]
    return [slot.texture for slot in slots if slot is not None]


def holds(node: Any) -> list[str]:
    """What stands at a node, in words."""
    words = []
    if node.mesh is not None:
        words.append(f"{len(node.mesh.faces)} faces")
        words += [f"{len(node.mesh.targets)} morph targets"] if node.mesh.targets else []
    words += [f"{len(node.instances)} instances"] if node.instances is not None else []
    words += [f"skin of {len(node.skin.joints)} joints"] if node.skin is not None else []
    words += ["camera"] if node.camera is not None else []
    words += [f"{node.light.kind} light"] if node.light is not None else []
    return words


def lines(name: str, found: dict[str, Any]) -> list[str]:
    """`contents` for people."""
    told = [name]
    told.append(f"  faces      {found['faces']:,}   points {found['points']:,}   meshes {found['meshes']}")
    if found["bounds"]:
        low, high = found["bounds"]["low"], found["bounds"]["high"]
        size = " x ".join(f"{b - a:.4g}" for a, b in zip(low, high, strict=True))
        told.append(f"  bounds     {point(low)} to {point(high)}, {size} m")
    else:
        told.append("  bounds     nothing to see")
    told += section(
        "clips", [f"{one['name'] or '(no name)'}, {one['duration']:.3f} s" for one in found["clips"]]
    )
    told += section("cameras", [f"{one['name'] or '(no name)'}, {lens(one)}" for one in found["cameras"]])
    told += section(
        "lights",
        [f"{one['name'] or '(no name)'}, {one['kind']}, {one['intensity']:g}" for one in found["lights"]],
    )
    told += section("materials", [material_line(one) for one in found["materials"]])
    told += section(
        "textures",
        [f"{one['name'] or '(no name)'}, {one['size'][0]}x{one['size'][1]}" for one in found["textures"]],
    )
    told += section("nodes", tree(found["nodes"]))
    return told + section("extensions", found["extensions"]) + section("notes", found["notes"])


def section(title: str, rows: list[str]) -> list[str]:
    """Rows under a title; nothing where there are none."""
    return [f"  {title if index == 0 else '':10} {row}" for index, row in enumerate(rows)]


def point(values: list[float]) -> str:
    """(x, y, z) with few digits."""
    return "(" + ", ".join(f"{value:.4g}" for value in values) + ")"


def lens(camera: dict[str, Any]) -> str:
    """A camera's lens in words."""
    if camera["fov"] is not None:
        return f"{camera['fov'] * 180 / 3.141592653589793:.1f} degrees high"
    return f"orthographic, {camera['height']:g} m high"


def material_line(material: dict[str, Any]) -> str:
    """A material in words."""
    words = [material["name"] or "(no name)"]
    words += [material["alpha_mode"]] if material["alpha_mode"] != "opaque" else []
    words += ["double-sided"] if material["double_sided"] else []
    words += ["unlit"] if material["unlit"] else []
    return ", ".join(words)


def tree(nodes: list[dict[str, Any]]) -> list[str]:
    """The first nodes, indented by depth, each with what it holds."""
    depths: list[int] = []
    for node in nodes:
        depths.append(depths[node["parent"]] + 1 if node["parent"] >= 0 else 0)
    rows = [
        f"{'  ' * depth}{node['path'].rpartition('/')[2]}"
        + (f": {', '.join(node['holds'])}" if node["holds"] else "")
        + ("" if node["visible"] else " (hidden)")
        for node, depth in list(zip(nodes, depths, strict=True))[:NODES_SHOWN]
    ]
    return rows + ([f"... {len(nodes) - NODES_SHOWN} more"] if len(nodes) > NODES_SHOWN else [])
