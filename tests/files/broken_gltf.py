"""Broken glTF files, and the sentence each must be refused with.

A file is a dict, written as .gltf, or bytes; `beside` are other files in its folder.
"""

from __future__ import annotations

import struct

import numpy as np

from files.bent_gltf import (
    Broken,
    bent,
    deep,
    gif,
    growing,
    huge_translation,
    instanced,
    long_paths,
    many_zeros,
    meshopt_bomb,
    png_of,
    square_with_uv,
    unbacked,
    whole_glb,
    with_animation,
    with_camera,
    with_extension,
    with_image,
    with_material,
    with_nodes,
    with_points,
    with_skin,
    with_target,
)
from files.gltf_builder import SQUARE, chunk, floats, glb
from files.images import png

VIEW, FIRST = ("bufferViews", 0), ("accessors", 0)
INFINITE = np.where(np.arange(12).reshape(4, 3) == 3, np.float32(np.inf), SQUARE)
UNKNOWN_NUMBER = np.where(np.arange(12).reshape(4, 3) == 7, np.float32(np.nan), SQUARE)
THREE, ONES = floats(0, 1, 2), np.ones((3, 3), np.float32)
INSTANCING, DRACO, MESHOPT = (
    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
)
PACKED = {"buffer": 0, "byteLength": 48, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}

BROKEN: tuple[Broken, ...] = (
    # The shell
    Broken(
        "empty", lambda: b"", r"begins with b'', which is neither JSON nor 'glTF'; export the model again"
    ),
    Broken("of zeros", lambda: bytes(64), r"begins with b'\\x00\\x00\\x00\\x00', which is neither", ".glb"),
    Broken(
        "of another format", lambda: b"ply\nformat ascii 1.0\n", r"begins with b'ply\\n', which is neither"
    ),
    Broken(
        "cut in the header",
        lambda: whole_glb()[:15],
        r"has 15 bytes; a GLB has at least 20, so it is cut",
        ".glb",
    ),
    Broken(
        "cut in the middle",
        lambda: whole_glb()[:-9],
        r"claims [\d,]+ bytes and has [\d,]+; it is cut off",
        ".glb",
    ),
    Broken(
        "GLB 1", lambda: b"glTF\1\0\0\0" + whole_glb()[8:], r"is GLB version 1; version 2 is needed", ".glb"
    ),
    Broken(
        "chunk beyond the end",
        lambda: struct.pack("<4sIIII", b"glTF", 2, 20, 2**31, 0x4E4F534A),
        r"a chunk claims 2,147,483,648 bytes where 0 are left; the file is damaged",
        ".glb",
    ),
    Broken(
        "binary first",
        lambda: struct.pack("<4sII", b"glTF", 2, 24) + chunk(0x004E4942, b"abcd"),
        r"its first chunk has type 0x4e4942; JSON is needed there",
        ".glb",
    ),
    Broken(
        "length of its own header",
        lambda: whole_glb()[:8] + struct.pack("<I", 16) + whole_glb()[12:],
        r"claims 16 bytes, which hold no JSON; the file is damaged",
        ".glb",
    ),
    # The JSON
    Broken(
        "JSON cut off",
        lambda: b'{"asset": {"version": "2.0"',
        r"its JSON breaks at line 1 column \d+: .*; export it again",
    ),
    Broken("a list", lambda: glb(b"[]"), r"its JSON is a list; an object is needed", ".glb"),
    Broken(
        "not UTF-8",
        lambda: b'{"asset": "\xff\xfe"}',
        r"its JSON is not UTF-8 at byte 11; export the model again",
    ),
    Broken("nested deep", lambda: deep(100_000), r"its JSON is nested too deep; the file is damaged"),
    Broken("NaN in the JSON", lambda: b'{"asset": NaN}', r"its JSON holds NaN, which is no JSON number"),
    Broken(
        "endless number",
        lambda: b'{"a": ' + b"9" * 9999 + b"}",
        r"its JSON holds a number of thousands of digits",
    ),
    Broken("no version", bent("asset", to=...), r"asset\.version is missing; a text is needed"),
    Broken("glTF 1", bent("asset", "version", to="1.0"), r"asset\.version is '1\.0'; glTF 2 is needed"),
    Broken(
        "unknown required extension",
        bent("extensionsRequired", to=["VENDOR_magic"]),
        r"requires the extension 'VENDOR_magic', which eyeline does not read; export the model without it",
    ),
    Broken("nodes no list", bent("nodes", to={"0": {}}), r"nodes is \{'0': \{\}\}; a list is needed"),
    Broken("node no object", bent("nodes", to=[3]), r"nodes\[0\] is 3; an object is needed"),
    # Buffers and files
    Broken(
        "no buffer",
        bent("buffers", to=[]),
        r"bufferViews\[0\]\.buffer names buffers\[0\]; the file has 0 of them",
    ),
    Broken(
        "buffer without bytes",
        bent("buffers", 0, "uri", to=...),
        r"buffers\[0\]\.uri is missing; only the first buffer of a GLB",
    ),
    Broken(
        "missing file",
        bent("buffers", 0, "uri", to="gone.bin"),
        r"buffers\[0\]\.uri is 'gone\.bin'; there is no such file in the model's folder",
    ),
    Broken(
        "path above the folder",
        bent("buffers", 0, "uri", to="../secret.bin"),
        r"buffers\[0\]\.uri is '\.\./secret\.bin'; it leads out of the model's folder",
    ),
    Broken(
        "path above, encoded",
        bent("buffers", 0, "uri", to="%2e%2e/secret.bin"),
        r"buffers\[0\]\.uri is '%2e%2e/secret\.bin'; it leads out",
    ),
    Broken(
        "absolute path",
        bent("buffers", 0, "uri", to="/etc/passwd"),
        r"buffers\[0\]\.uri is '/etc/passwd'; only files in the model's own folder",
    ),
    Broken(
        "drive letter",
        bent("buffers", 0, "uri", to="C:\\data.bin"),
        r"buffers\[0\]\.uri is .*; only files in the model's own folder are read",
    ),
    Broken(
        "address",
        bent("buffers", 0, "uri", to="http://example.org/a.bin"),
        r"buffers\[0\]\.uri is 'http://example\.org/a\.bin'; only files in",
    ),
    Broken(
        "file scheme",
        bent("buffers", 0, "uri", to="file:///etc/passwd"),
        r"buffers\[0\]\.uri is 'file:///etc/passwd'; only files in the model's own",
    ),
    Broken(
        "name with a zero byte",
        bent("buffers", 0, "uri", to="a%00b"),
        r"buffers\[0\]\.uri is 'a%00b'; the name of a file is needed",
    ),
    Broken(
        "name too long", bent("buffers", 0, "uri", to="a" * 5000), r"buffers\[0\]\.uri is 'a+\.\.\.a+'; it .*"
    ),
    Broken(
        "folder for a buffer",
        bent("buffers", 0, "uri", to="."),
        r"buffers\[0\]\.uri is '\.'; there is no such file in the model's folder",
    ),
    Broken(
        "bad base64",
        bent("buffers", 0, "uri", to="data:;base64,@@@"),
        r"buffers\[0\]\.uri is not base64: .*; export the model again",
    ),
    Broken(
        "data without comma",
        bent("buffers", 0, "uri", to="data:;base64"),
        r"buffers\[0\]\.uri is 'data:;base64'; a data URI has a comma",
    ),
    Broken(
        "2 GB claimed",
        bent("buffers", 0, "byteLength", to=2**31),
        r"buffers\[0\]\.byteLength is 2,147,483,648, and there are 60 bytes; it is cut off",
    ),
    Broken(
        "2 GB claimed of a file",
        bent("buffers", 0, to={"uri": "small.bin", "byteLength": 2**31}),
        r"buffers\[0\]\.byteLength is 2,147,483,648, and there are 9 bytes; it is cut off",
        beside={"small.bin": b"123456789"},
    ),
    Broken(
        "view beyond the buffer",
        bent(*VIEW, "byteOffset", to=32),
        r"bufferViews\[0\] wants bytes 32 to 80 of 60; the file is damaged",
    ),
    Broken(
        "negative offset",
        bent(*VIEW, "byteOffset", to=-4),
        r"bufferViews\[0\]\.byteOffset is -4; a whole number from 0 is needed",
    ),
    Broken(
        "stride of 3",
        bent(*VIEW, "byteStride", to=3),
        r"bufferViews\[0\]\.byteStride is 3; 4 to 252 is needed",
    ),
    Broken(
        "stride below the element",
        bent(*VIEW, "byteStride", to=8),
        r"accessors\[0\] has elements of 12 bytes in a view of stride 8",
    ),
    # Accessors
    Broken(
        "no such accessor",
        bent("meshes", 0, "primitives", 0, "indices", to=7),
        r"meshes\[0\]\.primitives\[0\]\.indices names accessors\[7\]; the file has 2",
    ),
    Broken(
        "accessor beyond its view",
        bent(*FIRST, "count", to=5),
        r"accessors\[0\] ends at byte 60 of a view of 48; the file is damaged",
    ),
    Broken(
        "count of 0",
        bent(*FIRST, "count", to=0),
        r"accessors\[0\]\.count is 0; a whole number from 1 is needed",
    ),
    Broken(
        "count of half",
        bent(*FIRST, "count", to=3.5),
        r"accessors\[0\]\.count is 3\.5; a whole number from 1 is needed",
    ),
    Broken(
        "count a text",
        bent(*FIRST, "count", to="4"),
        r"accessors\[0\]\.count is '4'; a whole number from 1 is needed",
    ),
    Broken(
        "count true",
        bent(*FIRST, "count", to=True),
        r"accessors\[0\]\.count is True; a whole number from 1 is needed",
    ),
    Broken(
        "unknown component",
        bent(*FIRST, "componentType", to=5124),
        r"accessors\[0\]\.componentType is 5124; one of 5120, 5121",
    ),
    Broken(
        "wrong type",
        bent(*FIRST, "type", to="VEC2"),
        r"accessors\[0\]\.type is 'VEC2'; meshes\[0\]\.primitives\[0\]\.attributes\.POSITION needs VEC3",
    ),
    Broken(
        "2 G zeros claimed",
        lambda: unbacked(2**31),
        r"accessors\[0\] claims 6,442,450,944 numbers, and the file's real size backs [\d,]+ more",
    ),
    Broken(
        "many millions of zeros",
        lambda: many_zeros(50),
        r"accessors\[\d+\] claims 3,000,000 numbers, and the file's real size backs",
    ),
    Broken(
        "sparse count claimed",
        bent(
            *FIRST,
            "sparse",
            to={
                "count": 2**31,
                "indices": {"bufferView": 0, "componentType": 5121},
                "values": {"bufferView": 0},
            },
        ),
        r"accessors\[0\]\.sparse\.count is 2147483648; at most the accessor's own count, 4, is needed",
    ),
    Broken(
        "sparse index out of range",
        bent(
            *FIRST,
            "sparse",
            to={
                "count": 2,
                "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5121},
                "values": {"bufferView": 0},
            },
        ),
        r"accessors\[0\]\.sparse\.indices must rise and stay below 4; the file is damaged",
    ),
    Broken(
        "position not a number",
        with_points(UNKNOWN_NUMBER),
        r"accessors\[0\] holds \[1\.0, nan, 0\.0\] at 2; numbers of at most 1e\+18 are needed",
    ),
    Broken(
        "position infinite",
        with_points(INFINITE),
        r"accessors\[0\] holds \[inf, 0\.0, 0\.0\] at 1; numbers of at most 1e\+18 are needed",
    ),
    # Meshes
    Broken(
        "index out of range",
        with_points(SQUARE[:3]),
        r"meshes\[0\]\.primitives\[0\]\.indices names vertex 3 at 5, and there are 3; the file is damaged",
    ),
    Broken(
        "attributes of two lengths",
        lambda: square_with_uv(3),
        r"meshes\[0\]\.primitives\[0\]\.attributes has attributes of \{'POSITION': 4, 'TEXCOORD_0': 3\}",
    ),
    Broken(
        "mode 7",
        bent("meshes", 0, "primitives", 0, "mode", to=7),
        r"meshes\[0\]\.primitives\[0\]\.mode is 7; 0 to 6 is needed",
    ),
    Broken(
        "target of another length",
        lambda: with_target(5),
        r"meshes\[0\]\.primitives\[0\]\.targets\[0\]\.POSITION has 5 differences for 4 vertices",
    ),
    Broken(
        "weights without targets",
        bent("meshes", 0, "weights", to=[1, 2]),
        r"meshes\[0\]\.weights has 2 numbers for 0 morph targets",
    ),
    Broken(
        "no such material",
        bent("meshes", 0, "primitives", 0, "material", to=0),
        r"meshes\[0\] names materials\[0\]; the file has 0 of them",
    ),
    Broken(
        "no such mesh",
        bent("nodes", 0, "mesh", to=9),
        r"nodes\[0\]\.mesh names meshes\[9\]; the file has 1 of them",
    ),
    Broken(
        "Draco of noise",
        with_extension("primitives", **{DRACO: {"bufferView": 0, "attributes": {"POSITION": 0}}}),
        r"meshes\[0\]\.primitives\[0\]\.extensions\.KHR_draco_mesh_compression is no mesh that Draco can",
    ),
    Broken(
        "meshopt of noise",
        with_extension("bufferViews", **{MESHOPT: PACKED}),
        r"bufferViews\[0\]\.extensions\.EXT_meshopt_compression cannot be unpacked \(.*\); the file",
    ),
    Broken(
        "meshopt bomb",
        meshopt_bomb,
        r"bufferViews\[1\]\.extensions\.EXT_meshopt_compression claims [\d,]+ numbers, and",
    ),
    Broken(
        "meshopt of another size",
        with_extension("bufferViews", **{MESHOPT: {**PACKED, "count": 5}}),
        r"bufferViews\[0\]\.byteLength is 48; its packed twin has 5 x 12 bytes",
    ),
    # Materials and images
    Broken(
        "metallic of 2",
        lambda: with_material({"pbrMetallicRoughness": {"metallicFactor": 2}}),
        r"materials\[0\]\.pbrMetallicRoughness\.metallicFactor is 2; a number from 0 to 1 is needed",
    ),
    Broken(
        "colour of three",
        lambda: with_material({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1]}}),
        r"materials\[0\]\.pbrMetallicRoughness\.baseColorFactor is \[1, 1, 1\]; 4 numbers",
    ),
    Broken(
        "unknown alpha mode",
        lambda: with_material({"alphaMode": "GLASS"}),
        r"materials\[0\]\.alphaMode is 'GLASS'; OPAQUE or MASK or BLEND is needed",
    ),
    Broken(
        "image bomb",
        with_image(png_of(60_000, 60_000)),
        r"images\[0\] has (60000 x 60000|too many) pixels; at most 67,108,864 are read",
    ),
    Broken(
        "image of another kind",
        with_image(gif()),
        r"images\[0\] is no PNG, JPEG or WebP image that can be read",
    ),
    Broken(
        "image cut off",
        with_image(png((1, 2, 3, 4))[:-30]),
        r"images\[0\] is no PNG, JPEG or WebP image that can be read \(\w+\); save it again",
    ),
    # Nodes
    Broken(
        "node under itself",
        with_nodes([[0]], [0]),
        r"node 0 is among its own children; a tree of nodes is needed",
    ),
    Broken(
        "circle of nodes",
        with_nodes([[1], [2], [0]], [0]),
        r"node \d is among its own children; a tree of nodes is needed",
    ),
    Broken(
        "two parents",
        with_nodes([[2], [2], []], [0, 1]),
        r"node 2 has two parents, nodes 0 and 1; one is needed",
    ),
    Broken(
        "root with a parent",
        with_nodes([[1], []], [1]),
        r"scenes\[0\]\.nodes names node 1, which is a child of node 0; name a root",
    ),
    Broken(
        "no such child",
        with_nodes([[5]], [0]),
        r"nodes\[0\]\.children names nodes\[5\]; the file has 1 of them",
    ),
    Broken(
        "paths of gigabytes",
        long_paths,
        r"the names of nodes down to 'n+' make paths of more than 67,108,864 characters",
    ),
    Broken(
        "matrix of 15",
        bent("nodes", 0, "matrix", to=[0] * 15),
        r"nodes\[0\]\.matrix is \[0, .*\]; 16 numbers of at most 1e\+18",
    ),
    Broken(
        "matrix with a perspective",
        bent("nodes", 0, "matrix", to=[1] * 16),
        r"nodes\[0\]\.matrix has last row \[1\.0, 1\.0, 1\.0, 1\.0\]; 0 0 0 1 is needed",
    ),
    Broken(
        "translation too large",
        huge_translation,
        r"nodes\[0\]\.translation is \[inf, 0, 0\]; 3 numbers of at most 1e\+18",
    ),
    Broken(
        "a chain of growing nodes",
        growing,
        r"node 'node 2' is moved or scaled beyond 1e\+18 metres; shrink it",
    ),
    Broken(
        "rotation too long",
        bent("nodes", 0, "rotation", to=[1e300, 0, 0, 1]),
        r"nodes\[0\]\.rotation is \[1e\+300, 0, 0, 1\]; 4 numbers of at most 1e\+18 are needed",
    ),
    Broken(
        "2 G instances",
        lambda: instanced(2**31),
        r"nodes\[0\]\.extensions\.EXT_mesh_gpu_instancing\.attributes has 2,147,483,648 instances; at most",
    ),
    Broken("no such scene", bent("scene", to=4), r"scene names scenes\[4\]; the file has 1 of them"),
    # Skins and cameras
    Broken(
        "joint beyond the skin",
        with_skin(joint=3),
        r"nodes\[0\]: vertex 0 of mesh 'mesh 0' names joint 3, and its skin has 1; the file is damaged",
    ),
    Broken(
        "skin of no node",
        with_skin(joints=[8]),
        r"skins\[0\]\.joints names nodes\[8\]; the file has 1 of them",
    ),
    Broken(
        "skin without joints",
        with_skin(joints=[]),
        r"skins\[0\]\.joints is \[\]; one joint or more is needed",
    ),
    Broken(
        "too few bind matrices",
        with_skin(joints=[0, 0]),
        r"skins\[0\]\.inverseBindMatrices has 1 matrices for 2 joints",
    ),
    Broken(
        "camera that sees nothing",
        lambda: with_camera({"yfov": 0, "znear": 1}),
        r"cameras\[0\]\.perspective\.yfov is 0; an angle between 0 and pi, in radians",
    ),
    Broken(
        "camera with far before near",
        lambda: with_camera({"yfov": 1, "znear": 2, "zfar": 1}),
        r"cameras\[0\]\.perspective\.zfar is 1; more than znear, 2, is needed",
    ),
    # Animations
    Broken(
        "times that fall",
        with_animation(floats(0, 2, 1), ONES),
        r"animations\[0\]\.samplers\[0\]\.input has times that fall or lie before 0",
    ),
    Broken(
        "time not a number",
        with_animation(floats(0, np.nan, 1), ONES),
        r"accessors\[2\] holds \[nan\] at 1; numbers of at most 1e\+18 are needed",
    ),
    Broken(
        "value infinite",
        with_animation(THREE, np.full((3, 3), np.inf, np.float32)),
        r"accessors\[3\] holds \[inf, inf, inf\] at 0",
    ),
    Broken(
        "too few values",
        with_animation(THREE, ONES[:2]),
        r"animations\[0\]\.samplers\[0\]\.output has values of 2 numbers; 3 are needed",
    ),
    Broken(
        "cubic without tangents",
        with_animation(THREE, ONES[:2], "CUBICSPLINE"),
        r"animations\[0\]\.samplers\[0\]\.output has 2 values for 3 keys; 3 for each are needed",
    ),
    Broken(
        "rotation of no length",
        with_animation(THREE, np.zeros((3, 4), np.float32), path="rotation"),
        r"animations\[0\]\.samplers\[0\]\.output: the rotation of key 0 is 0 0 0 0; a turn is needed",
    ),
    Broken(
        "unknown interpolation",
        with_animation(THREE, ONES, "SMOOTH"),
        r"animations\[0\]\.samplers\[0\]\.interpolation is 'SMOOTH'; STEP or LINEAR or CUBICSPLINE",
    ),
)
