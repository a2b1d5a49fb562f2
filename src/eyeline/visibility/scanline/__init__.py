"""Scan line: answers every scene, a row at a time, and compares faces where they begin, not at pixels."""

from eyeline.visibility.scanline.scanline import ScanLine as ScanLine
