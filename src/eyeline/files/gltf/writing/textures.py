"""Textures: lossless pictures, how they repeat and filter, and where materials lay them. [glTF 2.0, 3.8]"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from eyeline.files.gltf.textures import LINEAR, MINIFIED, NEAREST, WRAPS
from eyeline.files.gltf.writing.store import Store, Thing, named, number, numbers
from eyeline.files.pictures import encoded
from eyeline.scene.texture import Texture, TextureSlot

CODES = {ours: code for code, ours in WRAPS.items()}


@dataclass(frozen=True, eq=False)
class Textures:
    """Writes each texture once, and each picture that several of them share."""

    store: Store
    place: Callable[[bytes], Thing]  # where the bytes of a picture go: what the file says of it
    _textures: dict[int, int] = field(default_factory=dict)
    _images: dict[int, int] = field(default_factory=dict)
    _samplers: dict[tuple[int, ...], int] = field(default_factory=dict)

    def slot(self, slot: TextureSlot, moves: bool = False) -> Thing:
        """What a material says of a texture; moves: a clip moves how it lies, which must then be there."""
        use: Thing = {"index": self._texture(slot.texture)}
        if slot.uv_set:
            use["texCoord"] = slot.uv_set
        if moves or (slot.offset, slot.rotation, slot.scale) != ((0, 0), 0, (1, 1)):
            lies = {
                "offset": numbers(slot.offset),
                "rotation": number(slot.rotation),
                "scale": numbers(slot.scale),
            }
            use |= self.store.extended("KHR_texture_transform", lies)
        return use

    def _texture(self, texture: Texture) -> int:
        if id(texture) not in self._textures:
            filters = (
                NEAREST if texture.nearest else LINEAR,
                MINIFIED[-1] if texture.mipmaps else LINEAR,
                CODES[texture.wrap[0]],
                CODES[texture.wrap[1]],
            )
            if filters not in self._samplers:
                keys = ("magFilter", "minFilter", "wrapS", "wrapT")
                self._samplers[filters] = self.store.add("samplers", dict(zip(keys, filters, strict=True)))
            thing = {"sampler": self._samplers[filters], "source": self._image(texture)}
            self._textures[id(texture)] = self.store.add("textures", named(texture.name, thing))
        return self._textures[id(texture)]

    def _image(self, texture: Texture) -> int:
        if id(texture.pixels) not in self._images:
            self._images[id(texture.pixels)] = self.store.add("images", self.place(encoded(texture.pixels)))
        return self._images[id(texture.pixels)]
