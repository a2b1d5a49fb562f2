"""Exact vector drawings: which edges a draughtsman draws, and which parts of them are seen."""
