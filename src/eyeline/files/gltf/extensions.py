"""Which extensions are read, and what is said about the others."""

from __future__ import annotations

from eyeline.errors import FileError
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import spoken

KNOWN = (
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
)


def checked_extensions(document: Document) -> tuple[str, ...]:
    """All that a file names; a required one that is not known is refused, an optional one reported."""
    for name in document.root.listed("extensionsRequired"):
        if name not in KNOWN:
            raise FileError(
                f"requires the extension {spoken(name)}, which eyeline does not read;"
                " export the model without it"
            )
    used = document.root.listed("extensionsUsed")
    for name in used:
        if name not in KNOWN:
            document.notes.add(f"the extension {spoken(name)} is not read; the model is drawn without it")
    return tuple(dict.fromkeys(name for name in used if isinstance(name, str)))
