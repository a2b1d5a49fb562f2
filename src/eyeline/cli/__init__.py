"""The command line: parses units, opens files, calls one function, prints."""
