"""Mesh formats: OBJ, PLY, STL, OFF, 3MF. Each module has a `read(path)`; faces keep the file's order."""
