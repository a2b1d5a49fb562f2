"""How the site is built: `make docs`."""

import sys
from pathlib import Path

import eyeline

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

project = "eyeline"
author = "the eyeline developers"
project_copyright = author
release = version = eyeline.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx_gallery.gen_gallery",
    "extensions.docstrings",
    "extensions.explained",
    "extensions.tables",
]
exclude_patterns = [
    "_build",
    "gallery/**/*.ipynb",
    "gallery/**/*.py",
    "gallery/**/*.zip",
    "gallery/sg_execution_times.rst",
]
nitpicky = False

# --- text ---------------------------------------------------------------------------------------------------

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
smartquotes = False
myst_heading_anchors = 3
python_use_unqualified_type_names = True
python_display_short_literal_types = True
python_maximum_signature_line_length = 88
autodoc_type_aliases = {
    name: name
    for name in (
        "FloatArray",
        "IntArray",
        "ByteArray",
        "BoolArray",
        "npt.ArrayLike",
        "Colour",
        "CameraChoice",
    )
}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True

# --- the gallery --------------------------------------------------------------------------------------------

sphinx_gallery_conf = {
    "examples_dirs": str(HERE.parent / "examples"),
    "gallery_dirs": "gallery",
    "filename_pattern": r"/plot_",
    "image_scrapers": ("extensions.gallery.saved_pictures",),
    "reset_modules": (),
    "within_subsection_order": "FileNameSortKey",
    "remove_config_comments": True,
    "download_all_examples": False,
    "show_signature": False,
    "write_computation_times": False,
    "min_reported_time": 0,
    "abort_on_example_error": True,
    "capture_repr": (),
    "thumbnail_size": (480, 270),
}

# --- the page -----------------------------------------------------------------------------------------------

html_theme = "furo"
html_title = "eyeline"
html_show_sourcelink = False
html_static_path = ["_static"]
html_css_files = ["site.css"]
