"""Scene and camera to Projected: transformed, clipped and snapped once, for every method."""
