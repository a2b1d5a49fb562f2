"""What builds the site beside Sphinx: tables from code, plain docstrings, pictures that examples save."""
