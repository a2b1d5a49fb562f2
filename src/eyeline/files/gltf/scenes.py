"""Scenes: which one of a file is read. [glTF 2.0, 3.5.1]"""

from __future__ import annotations

from eyeline.errors import FileError
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part, spoken


def chosen_scene(document: Document, wanted: str | int | None) -> Part | None:
    """The scene asked for by name or number, else the file's choice, else its first; None without any."""
    scenes = document.all("scenes")
    names = [scene.name(f"scene {index}") for index, scene in enumerate(scenes)]
    known = ", ".join(map(spoken, names[:5])) or "none"
    if isinstance(wanted, str) and wanted in names:
        return scenes[names.index(wanted)]
    if isinstance(wanted, int) and 0 <= wanted < len(scenes):
        return scenes[wanted]
    if wanted is not None:
        raise FileError(f"there is no scene {wanted!r}; the file has {known}")
    if not scenes:
        if document.all("nodes"):
            document.notes.add("the file has no scene; all its nodes are taken")
        return None
    number = document.root.whole("scene", 0)
    scene = document.one("scenes", number, "scene")
    if len(scenes) > 1:
        document.notes.add(f"the file has {len(scenes)} scenes, {known}; {spoken(names[number])} is read")
    return scene
