"""glTF written: a scene as JSON and one buffer, so that what was made here plays elsewhere."""
