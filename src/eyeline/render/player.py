"""A film inside a web page or a notebook."""

from __future__ import annotations

import base64
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from eyeline.render.film import Film

WIDEST = 960  # pixels: what a notebook's column shows
VIDEO_STYLE = "display:block;width:100%;height:auto;border-radius:4px"
CAPTION_STYLE = "font:12px system-ui,sans-serif;opacity:.65;padding:4px 0"
MOST_FRAMES = 720  # so that a page stays a few megabytes


def player(film: Film) -> str:
    """A <video> with the film inside it, made smaller or cut where it is large; it says so."""
    shown = excerpt(film)
    with tempfile.TemporaryDirectory() as folder:
        video = shown.save(Path(folder) / "film.mp4").read_bytes()
    source = base64.b64encode(video).decode()
    width, height = film.shot.size
    caption = f"{width}×{height}, {film.fps:g} fps, {len(film)} frames"
    if len(shown) < len(film):
        caption += f"; the first {len(shown)} are shown"
    return (
        f'<figure style="margin:0;max-width:{shown.shot.size[0]}px">'
        f'<video controls autoplay loop muted playsinline style="{VIDEO_STYLE}"'
        f' src="data:video/mp4;base64,{source}"></video>'
        f'<figcaption style="{CAPTION_STYLE}">{caption}</figcaption>'
        "</figure>"
    )


def excerpt(film: Film) -> Film:
    """As much of a film, and as large, as a page can hold."""
    width, height = film.shot.size
    shrink = min(1.0, WIDEST / max(width, height))
    size = (max(1, round(width * shrink)), max(1, round(height * shrink)))
    end = min(film.end, film.start + MOST_FRAMES / film.fps)
    return replace(film, shot=replace(film.shot, size=size), end=end)
