"""A method at work: its steps on the user's own scene, as a film, a page or a drawing."""

from eyeline.explanation.explanation import Explanation, explain

__all__ = ["Explanation", "explain"]
