"""What the site is built with beside Sphinx: tables from code, plain docstrings, pictures that examples save."""
