"""Model files by suffix: `load` opens one as a Scene. Readers are imported when their first file comes."""

from __future__ import annotations

import os
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from eyeline.errors import EyelineError, FileError

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene


@dataclass(frozen=True)
class Reader:
    """A file format, and the module whose `read` opens it.

    `read(path)` answers a Scene or raises an EyelineError; `load` puts the file's name before the sentence.
    """

    name: str
    module: str
    several_scenes: bool = False  # then it is read(path, scene), and scene may name or number one

    def __call__(self, path: Path, scene: str | int | None = None) -> Scene:
        """The scene of a file; of several, the one asked for."""
        read = import_module(self.module).read
        if self.several_scenes:
            return cast("Scene", read(path, scene))
        if scene is not None:
            raise FileError(f"scene is {scene!r}, but {self.name} files hold one scene; leave it out")
        return cast("Scene", read(path))


GLTF = Reader("glTF 2.0", "eyeline.files.gltf.reader", several_scenes=True)

READERS: dict[str, Reader] = {
    ".gltf": GLTF,
    ".glb": GLTF,
    ".obj": Reader("OBJ", "eyeline.files.meshes.obj"),
    ".ply": Reader("PLY", "eyeline.files.meshes.ply"),
    ".stl": Reader("STL", "eyeline.files.meshes.stl"),
    ".off": Reader("OFF", "eyeline.files.meshes.off"),
    ".3mf": Reader("3MF", "eyeline.files.meshes.threemf"),
}


def load(path: str | os.PathLike[str], scene: str | int | None = None) -> Scene:
    """The scene in a model file; its suffix decides the reader, in capitals or not.

    scene: the name or number of one, where a file holds several; otherwise the file's own default.
    Everything that cannot be read is refused in one sentence that starts with the file's name.
    """
    path = Path(path)
    try:
        return reader_of(path)(path, scene)
    except EyelineError as error:
        raise FileError(f"{path.name}: {error}") from error
    except OSError as error:
        raise FileError(
            f"{path.name}: {error.strerror or error}; check the path and its permissions"
        ) from error
    except MemoryError as error:
        raise FileError(f"{path.name}: needs more memory than there is; use a smaller model") from error


def reader_of(path: Path) -> Reader:
    """The reader of an existing file, by its suffix."""
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        known = ", ".join(sorted(READERS))
        raise FileError(f"the suffix {path.suffix!r} is not known; eyeline reads {known}")
    if not path.exists():
        raise FileError(f"there is no such file in {str(path.parent)!r}; check the path")
    if not path.is_file():
        raise FileError("is not a regular file; give the path of a model file")
    return reader
