"""Small good files that together use everything the reader reads: what the fuzzer bends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import meshopt
import numpy as np

from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats
from files.images import picture, png

RED = (255, 0, 0, 255)
ALONG_Z = np.tile(floats([0, 0, 1]), (4, 1))
TIMES = floats(0, 1, 2)


def shapes() -> Builder:
    """Every mode, several primitives, sparse and normalized numbers, morph targets."""
    builder = Builder()
    parts: list[dict[str, Any]] = []
    for mode in range(7):
        attributes = {"POSITION": builder.accessor(SQUARE), "NORMAL": builder.accessor(ALONG_Z)}
        parts.append({"attributes": attributes, "mode": mode, "indices": builder.accessor(SQUARE_FACES)})
    for part in parts:
        part["targets"] = [{"POSITION": builder.accessor(ALONG_Z)}]
    bent = builder.accessor(SQUARE)
    rows = builder.view(np.array([1, 3], np.uint8).tobytes())
    values = {"bufferView": builder.view(floats([9, 9, 9], [8, 8, 8]).tobytes())}
    indices = {"bufferView": rows, "componentType": 5121}
    builder.json["accessors"][bent]["sparse"] = {"count": 2, "indices": indices, "values": values}
    colors = builder.accessor(np.full((4, 3), 128, np.uint8), normalized=True)
    uv = builder.accessor(SQUARE[:, :2].astype(np.uint16), normalized=True)
    attributes = {"POSITION": bent, "COLOR_0": colors, "TEXCOORD_0": uv, "TEXCOORD_1": uv}
    parts.append({"attributes": attributes, "indices": builder.accessor(SQUARE_FACES)})
    builder.add("meshes", primitives=parts, weights=[0.5], extras={"targetNames": ["up"]}, name="shapes")
    builder.node(
        mesh=0, weights=[0.25], name="root", translation=[1, 2, 3], rotation=[0, 0, 0, 1], scale=[1, 1, 1]
    )
    builder.animation("weights", 0, TIMES, floats(0, 1, 0))
    return builder


def paints() -> Builder:
    """Every texture slot, every kind of image, every extension of materials."""
    builder = Builder()
    images = [png(RED), picture(RED[:3], "JPEG", mode="RGB"), picture(RED, "WEBP")]
    for image in images:
        builder.add("images", bufferView=builder.view(image), mimeType="image/png", name="picture")
    builder.add("samplers", wrapS=33071, wrapT=33648, magFilter=9728, minFilter=9987)
    for source in range(3):
        builder.add("textures", source=source, sampler=0)
    builder.json["textures"][2]["extensions"] = {"EXT_texture_webp": {"source": 2}}
    moved = {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2], "texCoord": 0}}
    builder.add(
        "materials",
        name="paint",
        pbrMetallicRoughness={
            "baseColorFactor": [1, 0.5, 0.25, 1],
            "metallicFactor": 0.5,
            "roughnessFactor": 0.5,
            "baseColorTexture": {"index": 0, "extensions": moved},
            "metallicRoughnessTexture": {"index": 1},
        },
        normalTexture={"index": 1, "scale": 0.5},
        occlusionTexture={"index": 2, "strength": 0.5},
        emissiveTexture={"index": 2},
        emissiveFactor=[1, 1, 1],
        alphaMode="MASK",
        alphaCutoff=0.25,
        doubleSided=True,
        extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 3}, "KHR_materials_unlit": {}},
    )
    attributes = {"POSITION": SQUARE, "NORMAL": ALONG_Z, "TEXCOORD_0": SQUARE[:, :2]}
    builder.node(mesh=builder.mesh(attributes, SQUARE_FACES, material=0))
    builder.pointer("/materials/0/pbrMetallicRoughness/baseColorFactor", TIMES, np.ones((3, 4), np.float32))
    return builder


def puppet() -> Builder:
    """A skin, a tree of joints, cameras, lights, instances, two scenes, clips of every interpolation."""
    builder = Builder()
    joints = np.array([[0, 1, 0, 0]] * 4, np.uint8)
    weights = floats(*[[0.5, 0.5, 0, 0]] * 4)
    mesh = builder.mesh({"POSITION": SQUARE, "JOINTS_0": joints, "WEIGHTS_0": weights}, SQUARE_FACES)
    builder.node(mesh=mesh, skin=0, name="skinned")
    builder.node(name="hip", children=[2])
    builder.add("nodes", name="knee", matrix=np.eye(4).reshape(-1).tolist())
    bind = builder.accessor(np.tile(np.eye(4, dtype=np.float32), (2, 1, 1)))
    builder.add("skins", joints=[1, 2], inverseBindMatrices=bind, skeleton=1)
    builder.add(
        "cameras", type="perspective", perspective={"yfov": 1, "znear": 0.1, "zfar": 9, "aspectRatio": 2}
    )
    builder.add("cameras", type="orthographic", orthographic={"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9})
    lights = [
        {"type": "spot", "range": 3, "color": [1, 1, 1], "intensity": 2, "spot": {"outerConeAngle": 0.5}}
    ]
    builder.json["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    builder.node(camera=0, extensions={"KHR_lights_punctual": {"light": 0}})
    named = {"TRANSLATION": builder.accessor(SQUARE)}
    builder.node(
        mesh=builder.square(), camera=1, extensions={"EXT_mesh_gpu_instancing": {"attributes": named}}
    )
    builder.add("scenes", nodes=[0])
    builder.animation("translation", 2, TIMES, np.ones((3, 3), np.float32), "STEP")
    builder.animation("rotation", 1, TIMES, np.ones((9, 4), np.float32), "CUBICSPLINE")
    builder.pointer("/extensions/KHR_lights_punctual/lights/0/intensity", TIMES, floats(1, 2, 3))
    builder.json["extensionsUsed"] = ["KHR_lights_punctual", "EXT_mesh_gpu_instancing", "VENDOR_other"]
    return builder


def packed() -> Builder:
    """Views packed by meshopt, and a primitive packed by Draco."""
    import DracoPy

    builder = Builder()
    faces = SQUARE_FACES.astype(np.uint32).reshape(-1, 3)
    packet = DracoPy.encode(SQUARE.astype(np.float64), faces, generic_attributes={5: ALONG_Z})
    number = next(one["unique_id"] for one in DracoPy.decode(packet).attributes if one["attribute_type"] == 0)
    unread = [builder.add("accessors", componentType=5126, count=4, type="VEC3") for _ in range(2)]
    named = {"bufferView": builder.view(packet), "attributes": {"POSITION": number, "NORMAL": 5}}
    extension = {"KHR_draco_mesh_compression": named}
    builder.node(mesh=builder.mesh({"POSITION": unread[0], "NORMAL": unread[1]}, extensions=extension))
    data = meshopt.encode_gltf_buffer(SQUARE, "ATTRIBUTES")
    inner = builder.json["bufferViews"][builder.view(data)]
    told = {**inner, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}
    builder.add(
        "bufferViews", buffer=0, byteLength=48, byteStride=12, extensions={"EXT_meshopt_compression": told}
    )
    points = builder.add("accessors", bufferView=2, componentType=5126, count=4, type="VEC3")
    builder.node(mesh=builder.mesh({"POSITION": points}, SQUARE_FACES))
    builder.json["extensionsRequired"] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"]
    return builder


GOOD: dict[str, Callable[[], Builder]] = {
    "shapes": shapes,
    "paints": paints,
    "puppet": puppet,
    "packed": packed,
}
