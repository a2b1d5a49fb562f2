"""Every broken file is refused in one sentence, soon, and without taking memory."""

from __future__ import annotations

import re
import time
import tracemalloc
from pathlib import Path

import pytest

from eyeline.errors import FileError
from eyeline.files import load
from files.bent_gltf import Broken, square
from files.broken_gltf import BROKEN

SECONDS = 5
MEMORY = 400 * 2**20  # bytes; the allowance of a small file is 64 MiB of numbers, copied a few times


@pytest.mark.parametrize("broken", [pytest.param(one, id=one.name) for one in BROKEN])
def test_a_broken_file_is_refused_in_its_sentence(tmp_path: Path, broken: Broken) -> None:
    path = broken.write(tmp_path)
    tracemalloc.start()
    begin = time.monotonic()
    try:
        with pytest.raises(FileError) as caught:
            load(path)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    sentence = str(caught.value)
    assert re.match(rf"{re.escape(path.name)}: {broken.sentence}", sentence), sentence
    assert "\n" not in sentence and len(sentence) < 400
    assert time.monotonic() - begin < SECONDS
    assert peak < MEMORY


def test_names_of_broken_files_are_unique() -> None:
    assert len({one.name for one in BROKEN}) == len(BROKEN)


@pytest.mark.parametrize("inside", [True, False])
def test_a_link_is_followed_only_inside_the_folder(tmp_path: Path, inside: bool) -> None:
    folder = tmp_path / "model"
    folder.mkdir()
    builder = square()
    real = (folder if inside else tmp_path) / "real.bin"
    real.write_bytes(builder.data)
    (folder / "linked.bin").symlink_to(real)
    builder.json["buffers"] = [{"byteLength": len(builder.data), "uri": "linked.bin"}]
    builder.whole = lambda: builder.json  # type: ignore[method-assign]
    path = builder.write(folder)
    if inside:
        assert load(path).face_count == 2
    else:
        with pytest.raises(FileError, match="it leads out of the model's folder, so copy the file there"):
            load(path)


def test_a_link_that_leads_to_itself_is_refused(tmp_path: Path) -> None:
    (tmp_path / "loop.bin").symlink_to("loop.bin")
    builder = square()
    builder.json["buffers"] = [{"byteLength": 60, "uri": "loop.bin"}]
    builder.whole = lambda: builder.json  # type: ignore[method-assign]
    with pytest.raises(FileError, match=r"^model\.gltf: buffers\[0\]\.uri is 'loop\.bin'; "):
        load(builder.write(tmp_path))
