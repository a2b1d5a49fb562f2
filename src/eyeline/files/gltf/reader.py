"""The scene of a glTF file, part by part."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.animations import Animations
from eyeline.files.gltf.buffers import Buffers
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.draco import Draco
from eyeline.files.gltf.extensions import checked_extensions
from eyeline.files.gltf.images import Images
from eyeline.files.gltf.materials import Materials
from eyeline.files.gltf.meshes import Meshes
from eyeline.files.gltf.nodes import Nodes
from eyeline.files.gltf.primitives import Primitives
from eyeline.files.gltf.scenes import chosen_scene
from eyeline.files.gltf.textures import Textures
from eyeline.files.gltf.tree import tree_of
from eyeline.scene.scene import Scene


def read(path: Path, wanted: str | int | None = None) -> Scene:
    """The scene of a glTF file: the one wanted, by name or number, or the file's default."""
    document = Document.open(path)
    extensions = checked_extensions(document)
    buffers = Buffers(document)
    accessors = Accessors(document, buffers)
    materials = Materials(document, Textures(document, Images(document, buffers)))
    meshes = Meshes(document, Primitives(accessors, Draco(document, buffers)), materials)
    # The nodes first: clips move them by their paths
    part = chosen_scene(document, wanted)
    tree = tree_of(document, part)
    still = Scene(Nodes(document, accessors, meshes, tree)(), name=part.name() if part else "")
    clips = Animations(document, accessors, materials.names, tree, still)()
    if not any(node.mesh for node in still.nodes):
        document.notes.add("the scene has no mesh with faces; there is nothing to draw")
    return replace(still, clips=clips, notes=document.notes.sentences, extensions=extensions)
