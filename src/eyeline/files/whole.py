"""Files that appear whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from eyeline.errors import FileError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A name beside `path` to write to, which becomes `path` if the block ends well.

    On any error, or Ctrl-C, the unfinished file is removed and an older `path` stays as it was.
    """
    refuse_place(path)
    unfinished = path.with_name(f".{path.stem}-{os.urandom(4).hex()}{path.suffix}")
    try:
        unfinished.touch(exist_ok=False)
        yield unfinished
        unfinished.replace(path)
    except OSError as reason:
        raise FileError(f"{path}: cannot be written: {reason.strerror or reason}") from reason
    finally:
        unfinished.unlink(missing_ok=True)


def refuse_place(path: Path) -> None:
    """Refuse a place where no file can be put, before long work for it begins."""
    if not path.parent.is_dir():
        raise FileError(f"{path}: there is no folder {str(path.parent)!r}; make it first")
    if path.is_dir():
        raise FileError(f"{path}: is a folder; name a file in it")
