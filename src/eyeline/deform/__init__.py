"""Deformers: points in, points out; one a file."""
