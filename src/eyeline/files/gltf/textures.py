"""Textures: an image, its sampler, and where a material lays it. [glTF 2.0, 3.8; KHR_texture_transform]"""

from __future__ import annotations

from dataclasses import dataclass, field

from eyeline.files.gltf.attributes import UV_SETS
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.images import Images
from eyeline.files.gltf.part import Part
from eyeline.scene.texture import Texture, TextureSlot, Wrap

WRAPS: dict[int, Wrap] = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
NEAREST, LINEAR = 9728, 9729
MAGNIFIED = (NEAREST, LINEAR)
MINIFIED = (NEAREST, LINEAR, 9984, 9985, 9986, 9987)  # the last four blend or choose halved images


@dataclass(frozen=True, eq=False)
class Textures:
    """The textures of a document, each made once."""

    document: Document
    images: Images
    _textures: dict[int, Texture | None] = field(default_factory=dict)

    def slot(self, material: Part, key: str) -> TextureSlot | None:
        """The texture a material uses under `key`; None where it has none, or none that can be read."""
        if not material.has(key):
            return None
        use = material.part(key)
        texture = self.texture(use.whole("index"), use.at("index"))
        moved = use.extension("KHR_texture_transform") or Part(use.place, {})
        uv_set = moved.whole("texCoord", use.whole("texCoord", 0))
        if uv_set >= UV_SETS:
            self.document.notes.add(
                f"{use.place} uses TEXCOORD_{uv_set}; sets 0 and 1 are read, so it is left out"
            )
            return None
        if texture is None:
            return None
        offset, scale = moved.numbers("offset", (0.0, 0.0)), moved.numbers("scale", (1.0, 1.0))
        rotation = moved.number("rotation", 0.0)
        return TextureSlot(texture, uv_set, (offset[0], offset[1]), rotation, (scale[0], scale[1]))

    def texture(self, index: int, place: str) -> Texture | None:
        """The texture that `place` names; None if it has no image that can be read."""
        if index not in self._textures:
            self._textures[index] = self._made(self.document.one("textures", index, place))
        return self._textures[index]

    def _made(self, part: Part) -> Texture | None:
        webp = part.extension("EXT_texture_webp")
        source = webp if webp is not None and webp.has("source") else part
        if not source.has("source"):
            self.document.notes.add(f"{part.place} has no PNG, JPEG or WebP image; it is left out")
            return None
        index = source.whole("source")
        name = part.name() or self.document.one("images", index, source.at("source")).name()
        pixels = self.images(index, source.at("source"))
        if pixels is None:
            return None
        sampler = Part(part.place, {})
        if part.has("sampler"):
            sampler = self.document.one("samplers", part.whole("sampler"), part.at("sampler"))
        magnified = _code(sampler, "magFilter", LINEAR, MAGNIFIED)
        minified = _code(sampler, "minFilter", MINIFIED[-1], MINIFIED)
        wrap = tuple(WRAPS[_code(sampler, key, 10497, tuple(WRAPS))] for key in ("wrapS", "wrapT"))
        return Texture(pixels, (wrap[0], wrap[1]), magnified == NEAREST, minified not in MAGNIFIED, name)


def _code(sampler: Part, key: str, default: int, known: tuple[int, ...]) -> int:
    value = sampler.whole(key, default)
    if value not in known:
        raise sampler.refuse(key, f"one of {', '.join(map(str, known))} is needed")
    return value
