"""Motion as pure functions of time: curves, tracks, clips."""
