"""Small good files of every mesh format, written by hand or by another program's rules: name -> bytes."""

from __future__ import annotations

import io
import struct
import zipfile

import numpy as np
from PIL import Image

# A square pyramid of one metre: four sides and a square ground, outside counter-clockwise
POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1], [0.5, 1, 0.5]], dtype=np.float32)
POLYGONS = [[0, 1, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]])


def rows(values: object) -> str:
    return "\n".join(" ".join(f"{number:g}" for number in row) for row in values) + "\n"


def obj() -> dict[str, bytes]:
    text = "# a pyramid\nmtllib pyramid.mtl\no pyramid\n"
    text += "".join(f"v {line}\n" for line in rows(POINTS).splitlines())
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 -1 0\n"
    text += "usemtl stone\ns off\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl sand\ng sides\n"
    text += "f 2/1 1/2 5/5\nf 3/1 2/2 5/5\nf -2/1 -3/2 -1/5\nf 1/1 4/2 5/5\nl 1 5\n"
    mtl = "newmtl stone\nKd 0.5 0.5 0.5\nNs 90\nKs 0.2 0.2 0.2\n\n"
    mtl += "newmtl sand\nKd 1 1 1\nd 0.5\nmap_Kd -s 2 2 sand.png\n"
    return {"pyramid.obj": text.encode(), "pyramid.mtl": mtl.encode(), "sand.png": png()}


def png() -> bytes:
    pixels = np.zeros((4, 4, 4), np.uint8)
    pixels[:2] = (200, 150, 50, 255)
    pixels[2:] = (100, 75, 25, 255)
    packed = io.BytesIO()
    Image.fromarray(pixels).save(packed, "PNG")
    return packed.getvalue()


def ply_text() -> bytes:
    head = "ply\nformat ascii 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\nproperty float y\n"
    head += "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    head += f"element face {len(POLYGONS)}\nproperty list uchar int vertex_indices\nend_header\n"
    colored = [[*point, 255, 128, 0] for point in POINTS.tolist()]
    return (head + rows(colored) + rows([[len(corners), *corners] for corners in POLYGONS])).encode()


def ply_binary(order: str = "<") -> bytes:
    name = {"<": "little", ">": "big"}[order]
    head = f"ply\nformat binary_{name}_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
    head += "property float z\nproperty float s\nproperty float t\n"
    head += f"element face {len(POLYGONS)}\nproperty list uchar int vertex_index\n"
    head += "property uchar flag\nend_header\n"
    body = np.column_stack([POINTS, POINTS[:, [0, 2]]]).astype(f"{order}f4").tobytes()
    body += b"".join(struct.pack(f"{order}B{len(one)}iB", len(one), *one, 7) for one in POLYGONS)
    return head.encode() + body


def stl_binary() -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *POINTS[face].reshape(-1), 0) for face in TRIANGLES)
    return b"solid by chance".ljust(80) + struct.pack("<I", len(TRIANGLES)) + body


def stl_text() -> bytes:
    facets = ""
    for face in TRIANGLES:
        corners = "".join(f"   vertex {line}\n" for line in rows(POINTS[face]).splitlines())
        facets += f" facet normal 0 0 0\n  outer loop\n{corners}  endloop\n endfacet\n"
    return f"solid Pyramid\n{facets}endsolid Pyramid\n".encode()


def off() -> bytes:
    return (
        f"OFF\n# a pyramid\n5 {len(POLYGONS)} 0\n"
        + rows(POINTS)
        + rows([[len(one), *one] for one in POLYGONS])
    ).encode()


def model_3mf(components: str = "", items: str = '<item objectid="1"/>') -> str:
    points = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in POINTS * 1000)
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in TRIANGLES)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>'
        '<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
        f'<object id="1" type="model" name="pyramid"><mesh><vertices>{points}</vertices>'
        f"<triangles>{faces}</triangles></mesh></object>{components}</resources><build>{items}</build></model>"
    )


def threemf(model: str | None = None) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", model_3mf() if model is None else model)
    return packed.getvalue()


def every() -> dict[str, dict[str, bytes]]:
    """Model name -> the files of its folder."""
    return {
        "pyramid.obj": obj(),
        "text.ply": {"text.ply": ply_text()},
        "little.ply": {"little.ply": ply_binary("<")},
        "big.ply": {"big.ply": ply_binary(">")},
        "binary.stl": {"binary.stl": stl_binary()},
        "text.stl": {"text.stl": stl_text()},
        "pyramid.off": {"pyramid.off": off()},
        "pyramid.3mf": {"pyramid.3mf": threemf()},
    }
