"""Materials, textures and images: what the file says, and the format's defaults where it is silent."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from eyeline.files import load
from eyeline.scene.material import Material
from eyeline.scene.scene import Scene
from files.gltf_builder import Builder
from files.images import encoded, picture, png

RED = (255, 0, 0, 255)


def loaded(builder: Builder, folder: Path) -> Scene:
    builder.node(mesh=builder.square(material=0))
    return load(builder.write(folder))


def material_of(folder: Path, **values: Any) -> Material:
    builder = Builder()
    builder.add("materials", **values)
    return loaded(builder, folder).nodes[0].mesh.materials[0]


def textured(folder: Path, image: bytes, sampler: dict[str, int] | None = None, **texture: Any) -> Material:
    """A material whose base colour is an image inside the buffer."""
    builder = Builder()
    builder.add("images", bufferView=builder.view(image), mimeType="image/png")
    builder.add(
        "textures", source=0, **({} if sampler is None else {"sampler": builder.add("samplers", **sampler)})
    )
    builder.add("materials", pbrMetallicRoughness={"baseColorTexture": {"index": 0, **texture}})
    return loaded(builder, folder).nodes[0].mesh.materials[0]


def test_an_empty_material_has_the_defaults_of_the_format(tmp_path: Path) -> None:
    material = material_of(tmp_path)
    assert material.base_color == (1, 1, 1, 1)
    assert (material.metallic, material.roughness, material.emissive) == (1, 1, (0, 0, 0))
    assert (material.alpha_mode, material.alpha_cutoff, material.double_sided) == ("opaque", 0.5, False)
    assert (material.normal_scale, material.occlusion_strength, material.unlit) == (1, 1, False)


def test_faces_without_a_material_have_the_formats_default_one(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    (material,) = load(builder.write(tmp_path)).nodes[0].mesh.materials
    assert (material.name, material.base_color, material.metallic) == ("default material", (1, 1, 1, 1), 1)
    assert not material.double_sided


def test_every_number_of_a_material_is_read(tmp_path: Path) -> None:
    material = material_of(
        tmp_path,
        name="glow",
        pbrMetallicRoughness={
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
            "metallicFactor": 0.5,
            "roughnessFactor": 0.6,
        },
        emissiveFactor=[0.25, 0.5, 1],
        alphaMode="MASK",
        alphaCutoff=0.3,
        doubleSided=True,
        extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_unlit": {}},
    )
    assert (material.name, material.base_color) == ("glow", (0.1, 0.2, 0.3, 0.4))
    assert (material.metallic, material.roughness) == (0.5, 0.6)
    assert material.emissive == (1, 2, 4)
    assert (material.alpha_mode, material.alpha_cutoff) == ("mask", 0.3)
    assert material.double_sided and material.unlit


def test_material_names_are_unique(tmp_path: Path) -> None:
    builder = Builder()
    for name in ("skin", "skin", None, "skin.1"):
        builder.add("materials", **({} if name is None else {"name": name}))
        builder.node(mesh=builder.square(material=len(builder.json["materials"]) - 1))
    scene = load(builder.write(tmp_path))
    names = [node.mesh.materials[0].name for node in scene.nodes]
    assert names == ["skin", "skin.1", "material 2", "skin.1.1"]


@pytest.mark.parametrize(
    ("kind", "mode"), [("PNG", "RGBA"), ("PNG", "RGB"), ("WEBP", "RGBA"), ("JPEG", "RGB")]
)
def test_images_of_every_kind_become_rgba(tmp_path: Path, kind: str, mode: str) -> None:
    image = picture(RED[: len(mode)], kind, mode=mode)
    pixels = textured(tmp_path, image).base_color_texture.texture.pixels
    assert (pixels.shape, pixels.dtype) == ((2, 2, 4), np.uint8)
    assert np.abs(pixels.astype(int) - RED).max() <= (2 if kind == "JPEG" else 0)


def test_sixteen_bit_greys_keep_their_high_bits(tmp_path: Path) -> None:
    image = encoded(np.array([[0, 0x4000], [0x8000, 0xFFFF]], np.uint16))
    pixels = textured(tmp_path, image).base_color_texture.texture.pixels
    assert pixels[..., 0].tolist() == [[0, 0x40], [0x80, 0xFF]]
    assert (pixels[..., 3] == 255).all()


def test_rows_of_an_image_run_down(tmp_path: Path) -> None:
    pixels = np.array([[[1, 2, 3, 4], [5, 6, 7, 8]], [[9, 10, 11, 12], [13, 14, 15, 16]]], np.uint8)
    assert textured(tmp_path, encoded(pixels)).base_color_texture.texture.pixels.tolist() == pixels.tolist()


def test_an_image_may_be_a_data_uri_or_a_file_beside(tmp_path: Path) -> None:
    builder = Builder()
    (tmp_path / "red.png").write_bytes(png(RED))
    builder.add("images", uri="red.png")
    builder.add("images", uri="data:image/png;base64," + base64.b64encode(png(RED)).decode())
    slots = {"normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}}
    builder.add("textures", source=0)
    builder.add("textures", source=1)
    builder.add("materials", **slots)
    material = loaded(builder, tmp_path).nodes[0].mesh.materials[0]
    for slot in (material.normal_texture, material.emissive_texture):
        assert (slot.texture.pixels == RED).all()


def test_an_image_used_twice_is_one_array(tmp_path: Path) -> None:
    builder = Builder()
    builder.add("images", bufferView=builder.view(png(RED)))
    builder.add("textures", source=0)
    builder.add("textures", source=0, sampler=builder.add("samplers", magFilter=9728))
    builder.add("materials", emissiveTexture={"index": 0}, occlusionTexture={"index": 1, "strength": 0.5})
    material = loaded(builder, tmp_path).nodes[0].mesh.materials[0]
    assert material.emissive_texture.texture.pixels is material.occlusion_texture.texture.pixels
    assert (material.emissive_texture.texture.nearest, material.occlusion_texture.texture.nearest) == (
        False,
        True,
    )
    assert material.occlusion_strength == 0.5


def test_webp_wins_over_its_fallback(tmp_path: Path) -> None:
    builder = Builder()
    builder.add("images", bufferView=builder.view(png((0, 0, 255, 255))))
    builder.add("images", bufferView=builder.view(picture(RED, "WEBP")), mimeType="image/webp")
    builder.add("textures", source=0, extensions={"EXT_texture_webp": {"source": 1}})
    builder.add("materials", emissiveTexture={"index": 0})
    builder.json["extensionsRequired"] = ["EXT_texture_webp"]
    slot = loaded(builder, tmp_path).nodes[0].mesh.materials[0].emissive_texture
    assert (slot.texture.pixels == RED).all()


@pytest.mark.parametrize(
    ("sampler", "wrap", "nearest", "mipmaps"),
    [
        (None, ("repeat", "repeat"), False, True),
        ({}, ("repeat", "repeat"), False, True),
        (
            {"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9728},
            ("clamp", "mirror"),
            True,
            False,
        ),
        ({"magFilter": 9729, "minFilter": 9729}, ("repeat", "repeat"), False, False),
        ({"minFilter": 9984}, ("repeat", "repeat"), False, True),
        ({"minFilter": 9987}, ("repeat", "repeat"), False, True),
    ],
)
def test_samplers_say_how_a_texture_repeats_and_filters(
    tmp_path: Path, sampler: dict[str, int] | None, wrap: tuple[str, str], nearest: bool, mipmaps: bool
) -> None:
    texture = textured(tmp_path, png(RED), sampler).base_color_texture.texture
    assert (texture.wrap, texture.nearest, texture.mipmaps) == (wrap, nearest, mipmaps)


def test_a_texture_transform_moves_turns_and_chooses_the_uv_set(tmp_path: Path) -> None:
    moved = {"offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 3], "texCoord": 1}
    slot = textured(
        tmp_path, png(RED), texCoord=0, extensions={"KHR_texture_transform": moved}
    ).base_color_texture
    assert (slot.offset, slot.rotation, slot.scale, slot.uv_set) == ((0.25, 0.5), 0.5, (2, 3), 1)


def test_a_third_uv_set_is_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.add("images", bufferView=builder.view(png(RED)))
    builder.add("textures", source=0)
    builder.add("materials", emissiveTexture={"index": 0, "texCoord": 2})
    scene = loaded(builder, tmp_path)
    assert scene.nodes[0].mesh.materials[0].emissive_texture is None
    assert scene.notes == (
        "materials[0].emissiveTexture uses TEXCOORD_2; sets 0 and 1 are read, so it is left out",
    )


def test_a_texture_of_an_unknown_kind_is_left_out_and_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.json["extensionsUsed"] = ["KHR_texture_basisu"]
    builder.add("images", bufferView=builder.view(b"KTX2"))
    builder.add("textures", extensions={"KHR_texture_basisu": {"source": 0}})
    builder.add("materials", emissiveTexture={"index": 0})
    scene = loaded(builder, tmp_path)
    assert scene.nodes[0].mesh.materials[0].emissive_texture is None
    assert scene.notes == (
        "the extension 'KHR_texture_basisu' is not read; the model is drawn without it",
        "textures[0] has no PNG, JPEG or WebP image; it is left out",
    )
