"""Animated WebP: a moving picture, with transparency, in an <img>."""

from eyeline.render.encoders.video import Video

# The whole animation is one packet: memory grows with its compressed bytes.
WEBP = Video(
    name=".webp",
    container="webp",
    codec="libwebp_anim",
    pixel_format="bgra",
    options={"quality": "85", "compression_level": "2"},
    container_options={"loop": "0"},
    even=False,
)
