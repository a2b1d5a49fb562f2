"""A cached property is computed when it is first asked for, and no thread waits for another's."""

from __future__ import annotations

import threading

from eyeline.cached import cached_property


class Word:
    """Computes when all that take part have come, if they can come at once."""

    together: threading.Barrier | None = None

    def __init__(self) -> None:
        self.asked = 0

    @cached_property
    def length(self) -> int:
        """How long it is."""
        self.asked += 1
        if self.together:
            self.together.wait(timeout=10)
        return 4 + self.asked


def test_value_is_computed_once() -> None:
    word = Word()
    assert (word.length, word.length, word.asked) == (5, 5, 1)


def test_class_shows_the_property_and_its_docstring() -> None:
    assert isinstance(Word.length, cached_property)
    assert Word.length.__doc__ == "How long it is."


def test_two_threads_compute_at_once() -> None:
    Word.together, words = threading.Barrier(2), (Word(), Word())
    try:
        other = threading.Thread(target=lambda: words[0].length)
        other.start()
        assert words[1].length == 5
        other.join()
    finally:
        Word.together = None
    assert words[0].length == 5


def test_all_threads_keep_the_same_value() -> None:
    word, kept = Word(), []
    Word.together = threading.Barrier(2)
    try:
        askers = [threading.Thread(target=lambda: kept.append(word.length)) for _ in range(2)]
        for one in askers:
            one.start()
        for one in askers:
            one.join()
    finally:
        Word.together = None
    assert kept == [word.length] * 2
