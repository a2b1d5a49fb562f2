"""What a reader has to say about a file that it could read: one sentence each, each once."""

from __future__ import annotations

from eyeline.files.limits import NOTES


class Notes:
    """Sentences in the order they were added."""

    def __init__(self) -> None:
        self._sentences: dict[str, None] = {}

    def add(self, sentence: str) -> None:
        """Keep a sentence that is not there yet."""
        self._sentences.setdefault(sentence)

    @property
    def sentences(self) -> tuple[str, ...]:
        """The first hundred, and how many more there are."""
        every = tuple(self._sentences)
        rest = len(every) - NOTES
        return every if rest <= 0 else (*every[:NOTES], f"and {rest} more notes like these")
