"""Numbers only: arrays, transforms, quaternions, bounds. Knows no scene, no file, no picture."""
