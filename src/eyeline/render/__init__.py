"""Frames and films: the whole way from a scene to a picture."""
