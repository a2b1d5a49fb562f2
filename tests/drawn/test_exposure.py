"""What is written in a sheet, and what each frame then shows."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.drawn.exposure import Exposure, exposures
from eyeline.drawn.tables import from_csv, from_yaml
from eyeline.errors import FileError


def shown(words: str) -> list[str]:
    """The frames of a column of cells, written in one line; . is empty."""
    cells = {frame: "" if cell == "." else cell for frame, cell in enumerate(words.split("|"), 1)}
    return [
        "-" if one is None else one.drawing + (f">{one.towards}@{one.part:g}" if one.towards else "")
        for one in exposures(cells, len(cells))
    ]


def test_a_drawing_is_held_until_the_next() -> None:
    assert shown("a|.|.|b|.") == ["a", "a", "a", "b", "b"]


def test_nothing_is_shown_before_the_first_and_after_x() -> None:
    assert shown(".|a|x|.|b") == ["-", "a", "-", "-", "b"]


def test_in_betweens_are_spread_evenly_over_time() -> None:
    assert shown("a|inbetween|inbetween|.|b") == ["a", "a>b@0.25", "a>b@0.5", "a>b@0.5", "b"]


def test_an_in_between_may_say_how_far_it_is() -> None:
    assert shown("a|inbetween 10%|in-between 90%|b") == ["a", "a>b@0.1", "a>b@0.9", "b"]


def test_frames_are_repeated_until_something_else_is_written() -> None:
    assert shown("a|b|repeat 1-2|.|.|c") == ["a", "b", "a", "b", "a", "c"]


def test_a_repeat_repeats_what_was_shown() -> None:
    assert shown("a|inbetween|b|repeat 2-3|.") == ["a", "a>b@0.5", "b", "a>b@0.5", "b"]


@pytest.mark.parametrize(
    "words", ["inbetween|a", "a|inbetween", "a|x|inbetween|b", "a|inbetween|repeat 1-1|b"]
)
def test_an_in_between_of_nothing_is_refused(words: str) -> None:
    with pytest.raises(FileError, match="is an in-between, but not between two drawings"):
        shown(words)


@pytest.mark.parametrize("words", ["repeat 1-2|a", "a|repeat 2-3", "a|b|repeat 2-1", "a|repeat 0-1"])
def test_a_repeat_of_what_is_not_before_it_is_refused(words: str) -> None:
    with pytest.raises(FileError, match="what is repeated must come before it"):
        shown(words)


def test_rows_are_exposed_on_twos() -> None:
    table = from_csv("sky,ball\npaper,a\n,b\n", on=2)
    assert (table.frames, dict(table.layers)) == (4, {"sky": {1: "paper", 3: ""}, "ball": {1: "a", 3: "b"}})


def test_a_frame_column_says_where_rows_begin() -> None:
    table = from_csv("frame,ball\n1,a\n4,b\n9,\n", on=None)
    assert (table.frames, table.layers["ball"]) == (9, {1: "a", 4: "b", 9: ""})


def test_yaml_says_the_same() -> None:
    text = "on: 2\nfps: 12\nsize: [64, 36]\nlayers:\n  sky: [paper]\n  ball: {1: a, 4: b}\n"
    table = from_yaml(text, None)
    assert (table.frames, table.fps, table.size) == (5, 12, (64, 36))
    assert table.layers["ball"] == {1: "a", 4: "b"}
    assert from_yaml("layers: {a: [x, ~, 7]}\nframes: 9", None).layers["a"] == {1: "x", 2: "", 3: "7"}


GOOD = (
    "frame,sky,ball\n1,sky,a\n3,,inbetween\n5,,b\n9,,repeat 1-4\n",
    "on: 2\nfps: 12\nsize: [64, 36]\nlayers:\n  sky: [paper]\n  ball: {1: a, 4: inbetween, 6: b}\n",
)
DAMAGE = [*"0123456789,:[]{}-\n \"'x&*!é#|>", "\0", "", "1e9", "~", "<<", "!!set"]

BROKEN = {
    "": (from_csv, "has no frames"),
    "a,b\n": (from_csv, "has no frames"),
    "a,b\n\n\n": (from_csv, "has no frames"),
    'a\n"b\n': (from_csv, "is no CSV that can be read"),
    "frame,a,b,c,d,e,f,g,h,i,j,k\n1000000,x\n": (from_csv, "has 1,000,000 frames of 11 layers"),
    "a,a\n1,2\n": (from_csv, "names layer 'a' twice or not at all"),
    "frame,\n1,2\n": (from_csv, "names layer '' twice"),
    "a\nb,c\n": (from_csv, "line 2 has 2 cells for 1 columns"),
    "frame,a\n3,x\n2,y\n": (from_csv, "line 3 begins at frame 2, after frame 3; frames must rise"),
    "frame,a\none,x\n": (from_csv, "line 2 is 'one'; a whole number from 1"),
    "frame,a\n9999999,x\n": (from_csv, "a whole number from 1 to 1,000,000"),
    "layers: [": (from_yaml, "is no YAML that can be read"),
    "- a": (from_yaml, "the sheet is list; name: value is needed"),
    "layers: {}": (from_yaml, "has no frames"),
    "lairs: {a: [b]}": (from_yaml, "has a field 'lairs'; there is fps, frames, layers, on, size"),
    "layers: {a: [[1]]}": (from_yaml, r"layer 'a' has a cell \[1\]"),
    "layers: {a: [yes]}": (from_yaml, "layer 'a' has a cell True"),
    "layers: {a: {x: b}}": (from_yaml, "layer 'a': a frame is 'x'"),
    "layers: {a: [b]}\nsize: 3": (from_yaml, "size is 3"),
    "layers: {a: [b]}\nsize: [3, -1]": (from_yaml, "size is '-1'"),
    "layers: {a: [b]}\nfps: fast": (from_yaml, "fps is 'fast'; a number is needed"),
    "layers: !!python/object:os.system {}": (from_yaml, "is no YAML that can be read"),
}


@pytest.mark.parametrize("text", BROKEN)
def test_a_sheet_that_means_nothing_is_refused(text: str) -> None:
    reader, sentence = BROKEN[text]
    with pytest.raises(FileError, match=sentence):
        reader(text, None)


@settings(derandomize=True, deadline=None, max_examples=400)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0, 1]))
def test_a_damaged_sheet_is_read_or_refused(seed: int, which: int) -> None:
    """One sentence, whatever happens to a sheet on its way."""
    reader = (from_csv, from_yaml)[which]
    random, letters = np.random.default_rng(seed), list(GOOD[which])
    for _ in range(random.integers(1, 5)):
        place = int(random.integers(len(letters)))
        letters[place : place + int(random.integers(0, 5))] = str(random.choice(DAMAGE))
    with suppress(FileError):
        table = reader("".join(letters), None)
        for cells in table.layers.values():
            assert len(exposures(cells, table.frames)) == table.frames


def test_an_exposure_of_a_drawing_is_no_in_between() -> None:
    assert Exposure("a") == ("a", "", 0.0)
