"""The nouns: mesh, material, texture, light, camera, node, scene. Frozen data, pure functions."""
