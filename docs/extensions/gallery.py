"""Pictures and films that an example saved become the pictures of its page."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst

SHOWN = {".png", ".gif", ".webp", ".svg"}


def saved_pictures(block: tuple[str, str, int], variables: dict[str, Any], settings: dict[str, Any]) -> str:
    """Move what the last block saved beside its program into the site, and show it."""
    folder = Path(variables["src_file"]).parent
    shown = []
    for saved in sorted(file for file in folder.iterdir() if file.suffix in SHOWN):
        target = Path(next(variables["image_path_iterator"])).with_suffix(saved.suffix)
        target.write_bytes(saved.read_bytes())
        saved.unlink()
        shown.append(str(target))
    return figure_rst(shown, settings["src_dir"])
