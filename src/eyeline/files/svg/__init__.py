"""Drawings in SVG: read as cels, and drawn as pictures. Nothing in them may run, or reach beyond them."""
