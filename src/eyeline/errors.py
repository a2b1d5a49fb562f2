"""Every exception eyeline raises: one sentence that names the value and the way out."""

from collections.abc import Iterable


class EyelineError(Exception):
    """What the caller gave cannot be used; the message is one sentence for people."""


class GeometryError(EyelineError):
    """Arrays that do not make a mesh, a transform or a camera."""


class SceneError(EyelineError):
    """A scene, node, clip or time that does not exist or does not fit."""


class FileError(EyelineError):
    """A file that cannot be read or written; the message starts with its name."""


class OptionError(EyelineError):
    """An option out of its range, or a name that is not in its table."""


def suggestion(name: str, names: Iterable[str]) -> str:
    """The end of a sentence that refuses a name: the nearest ones there are."""
    import difflib

    known = list(names)
    near = difflib.get_close_matches(name, known, n=3, cutoff=0.4) or known[:5]
    return f"; there is {', '.join(map(repr, near))}" if near else "; there is none"
