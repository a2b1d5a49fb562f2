"""Broken mesh files: what is wrong, the files (the model first), and the sentence that refuses them."""

from __future__ import annotations

import io
import struct
import zipfile

import numpy as np

from files import good_meshes as good

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
PLY = good.ply_text()
OFF = good.off()


def library(name: str, **files: bytes) -> dict[str, bytes]:
    model = {"m.obj": f"mtllib {name}\nusemtl a\n{TRIANGLE}f 1 2 3\n".encode()}
    return model | {one.replace("_", "."): content for one, content in files.items()}


def ply(old: bytes, new: bytes) -> bytes:
    """A good text file with one thing in it changed."""
    assert old in PLY
    return PLY.replace(old, new)


def off(old: bytes, new: bytes) -> bytes:
    """A good file with one thing in it changed."""
    assert old in OFF
    return OFF.replace(old, new)


def bomb_png() -> bytes:
    """A picture whose header says 100000 x 100000 pixels."""
    import zlib

    head = struct.pack(">IIBBBBB", 100_000, 100_000, 8, 2, 0, 0, 0)
    parts = [(b"IHDR", head), (b"IDAT", zlib.compress(b"\0" * 100)), (b"IEND", b"")]
    chunks = [struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d)) for k, d in parts]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def archive_of(name: str, content: str) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, content)
    return packed.getvalue()


def multiplied(levels: int) -> bytes:
    """Each object made twice of the one before: 2 to the power of `levels` pyramids."""
    made = "".join(
        f'<object id="{k + 2}"><components><component objectid="{k + 1}"/><component objectid="{k + 1}"/>'
        "</components></object>"
        for k in range(levels)
    )
    return good.threemf(good.model_3mf(made, f'<item objectid="{levels + 1}"/>'))


BOMB = archive_of("3D/3dmodel.model", " " * 100_000_000)
LOOP = good.model_3mf(
    '<object id="2"><components><component objectid="3"/></components></object>'
    '<object id="3"><components><component objectid="2"/></components></object>',
    '<item objectid="2"/>',
)

OBJ: dict[str, tuple[bytes | str, str]] = {
    "an empty OBJ": ("", r"is empty"),
    "an OBJ that is a picture": (good.png(), r"is not a text file"),
    "an OBJ of points alone": (TRIANGLE, r"has no faces"),
    "a face of two corners": (TRIANGLE + "f 1 2\n", r"face 0 has 2 corners; at least 3"),
    "a face without corners": (TRIANGLE + "f 1 2 3\nf\n", r"face 1 has 0 corners"),
    "a point out of range": (TRIANGLE + "f 1 2 9\n", r"face 0 names point 9; there are 3"),
    "point zero": (TRIANGLE + "f 0 1 2\n", r"face 0 names point 0; there are 3"),
    "a count back too far": (TRIANGLE + "f -1 -2 -4\n", r"face 0 counts back to -4"),
    "a count back to nothing": (TRIANGLE + "f -0 1 2\n", r"face 0 counts back to -0"),
    "a place out of range": (TRIANGLE + "vt 0 0\nf 1/1 2/1 3/7\n", r"names texture place 7"),
    "a normal out of range": (TRIANGLE + "vn 0 0 1\nf 1//1 2//1 3//2\n", r"names normal 2"),
    "a corner of letters": (TRIANGLE + "f 1 2 x\n", r"face 0 has the corner 'x'"),
    "a corner of four numbers": (TRIANGLE + "f 1/1/1/1 2 3\n", r"corner '1/1/1/1'"),
    "a corner beyond 64 bits": (TRIANGLE + f"f 1 2 {9 * 10**30}\n", r"has the corner '9000"),
    "a point that is nan": ("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", r"point 1 is nan 0 0"),
    "a point beyond float32": ("v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n", r"point 2 is 0 1e\+39 0"),
    "a point of two numbers": ("v 0 0 0\nv 1 0\nv 0 1 0 1\nf 1 2 3\n", r"point 1 has 2 numbers"),
    "a point of letters": ("v 0 0 0\nv 1 O 0\nv 0 1 0\nf 1 2 3\n", r"point 1 is '1 O 0'"),
}

LIBRARIES: dict[str, tuple[dict[str, bytes], str]] = {
    "a library above the folder": (library("../../secret.mtl"), r"names '../../secret.mtl', which leads out"),
    "a library by its full path": (library("/etc/passwd"), r"names '/etc/passwd'; only files in the model's"),
    "a library on a drive": (library("C:\\maps\\a.mtl"), r"only files in the model's own folder"),
    "a library on the net": (library("https://example.org/a.mtl"), r"only files in the model's own folder"),
    "a picture by its full path": (
        library("a.mtl", a_mtl=b"newmtl a\nmap_Kd /etc/passwd\n"),
        r"material 'a' names '/etc/passwd'; only",
    ),
    "a picture that is text": (
        library("a.mtl", a_mtl=b"newmtl a\nmap_Kd b.png\n", b_png=b"hello"),
        r"picture 'b.png' is no PNG, .* or TIFF image that can be read",
    ),
    "a picture of ten gigapixels": (
        library("a.mtl", a_mtl=b"newmtl a\nmap_Kd b.png\n", b_png=bomb_png()),
        r"picture 'b.png' has .*pixels",
    ),
    "a colour beyond all lamps": (
        library("a.mtl", a_mtl=b"newmtl a\nKe 1e39 0 0\n"),
        r"has Ke '1e39'; a number of at most",
    ),
    "a colour of letters": (library("a.mtl", a_mtl=b"newmtl a\nKd red\n"), r"material 'a' has Kd 'red'"),
}

PLY_FILES: dict[str, tuple[bytes | str, str]] = {
    "an empty PLY": ("", r"is empty"),
    "a PLY that is an OBJ": (TRIANGLE, r"does not begin with 'ply'"),
    "a PLY that ends in its header": (PLY[:60], r"has no 'end_header'"),
    "a PLY of unknown format": (ply(b"ascii", b"packed"), r"header line 'format packed 1.0'"),
    "a PLY type that is none": (ply(b"float y", b"real y"), r"header line 'property real y'"),
    "a PLY without y": (ply(b"float y", b"float q"), r"has no points with x, y and z"),
    "two billion faces in a thousand bytes": (
        good.ply_binary().replace(b"element face 5", b"element face 2000000000"),
        r"claims 2,000,000,000 of 'face', but \d+ bytes are left",
    ),
    "two billion points in text": (
        ply(b"element vertex 5", b"element vertex 2000000000"),
        r"claims 2,000,000,000 of 'ver",
    ),
    "a binary PLY cut short": (good.ply_binary()[:-9], r"'face'.*cut short"),
    "a text PLY cut short": (PLY[:-12], r"'face'.*cut short"),
    "a PLY list of -1": (
        good.ply_binary()
        .replace(b"list uchar int", b"list char int")
        .replace(b"\x04\0\0\0\0\1", b"\xff\0\0\0\0\1"),
        r"has a list of -1 numbers",
    ),
    "a PLY point out of range": (ply(b"3 0 3 4\n", b"3 0 3 5\n"), r"face 4 names point 5; there"),
    "a PLY point that is nan": (ply(b"0.5 1 0.5", b"0.5 nan 0.5"), r"point 4 is 0.5 nan 0.5"),
    "a PLY with words": (ply(b"0.5 1 0.5", b"0.5 one 0.5"), r"has text among its numbers"),
    "a PLY without faces": (PLY.split(b"element face")[0] + b"end_header\n" + b"1 " * 30, r"has no faces"),
}

STL_FILES: dict[str, tuple[bytes | str, str]] = {
    "an empty STL": ("", r"is empty"),
    "an STL cut short": (good.stl_binary()[:-1], r"claims 6 triangles, 384 bytes, but holds 383"),
    "an STL that claims four billion": (
        b"x" * 80 + b"\xff\xff\xff\xff" + b"\0" * 50,
        r"claims 4,294,967,295 triangles",
    ),
    "an STL without triangles": (b"x" * 80 + b"\0" * 4, r"has no faces"),
    "an STL point that is infinite": (
        good.stl_binary()[:96] + np.float32(np.inf).tobytes() + good.stl_binary()[100:],
        r"point 0 is inf 0 0",
    ),
    "a text STL cut short": (good.stl_text()[:-30], r"ends before its 'endsolid'"),
    "a text STL with words": (good.stl_text().replace(b"0.5 1 0.5", b"here"), r"is no STL text"),
    "a text STL without facets": ("solid a\n facet\nendsolid a\n", r"has no faces"),
}

OFF_FILES: dict[str, tuple[bytes | str, str]] = {
    "an empty OFF": (" \n", r"is empty"),
    "an OFF that is an OBJ": (TRIANGLE, r"does not begin with 'OFF' or 'COFF' but 'v'"),
    "an OFF cut short": (OFF[:40], r"claims 5 points and 5 faces in \d lines; it is cut short"),
    "an OFF without counts": ("OFF\n0 0 0.5\n", r"counts its points and faces as|has no faces"),
    "an OFF of negative counts": ("OFF\n-3 1 0\n", r"counts its points and faces as '-3 1 0'"),
    "an OFF point out of range": (off(b"3 0 3 4", b"3 0 3 9"), r"face 4 names point 9; there are 5"),
    "an OFF face of two corners": (off(b"3 0 3 4", b"2 0 3 4"), r"face 4 has 2 corners; at least 3"),
    "an OFF face that claims more": (
        off(b"3 0 3 4", b"9 0 3 4"),
        r"face 4 is '9 0 3 4'; a count and so many",
    ),
    "an OFF point that is nan": (off(b"0.5 1 0.5", b"0.5 nan 0.5"), r"point 4 is 0.5 nan 0.5"),
    "an OFF point of two numbers": (off(b"0.5 1 0.5", b"0.5 1"), r"point 4 has 2 numbers; 3 are needed"),
    "an OFF without faces": ("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", r"has no faces"),
}

ARCHIVES: dict[str, tuple[bytes | str, str]] = {
    "a 3MF that is no archive": ("hello", r"is no 3MF archive"),
    "a 3MF cut short": (good.threemf()[:-40], r"is no 3MF archive"),
    "an archive without a model": (archive_of("readme.txt", "hello"), r"has no part 3D/3dmodel"),
    "an archive that unpacks to 200 MB": (BOMB, r"unpacks from [\d,]+ to 100,"),
    "a billion pyramids": (multiplied(30), r"places [\d,]+ objects; at most"),
    "objects made of each other": (good.threemf(LOOP), r"more than 64 deep, or of itself"),
    "a 3MF of broken XML": (good.threemf(good.model_3mf()[:-9]), r"has XML that is broken"),
    "a 3MF point out of range": (
        good.threemf(good.model_3mf().replace('v3="4"', 'v3="9"')),
        r"face 2 names point 9; there are 5",
    ),
    "a 3MF that builds nothing": (good.threemf(good.model_3mf(items="")), r"has no faces"),
}

ALONE = {".obj": OBJ, ".ply": PLY_FILES, ".stl": STL_FILES, ".off": OFF_FILES, ".3mf": ARCHIVES}
TABLE: dict[str, tuple[dict[str, bytes], str]] = LIBRARIES | {
    what: ({f"m{suffix}": content.encode() if isinstance(content, str) else content}, sentence)
    for suffix, files in ALONE.items()
    for what, (content, sentence) in files.items()
}
