"""Projected, visible and scene to pixels. Never decides visibility."""
