"""glTF 2.0, .gltf and .glb: the whole format, and the extensions that extensions.py lists."""
