"""All methods on one scene: how long, how much memory, how much work, and whether they agree."""

from eyeline.comparison.comparison import Comparison, compare

__all__ = ["Comparison", "compare"]
