"""`python -m eyeline` is `eyeline`."""

import sys

from eyeline.cli import main

if __name__ == "__main__":
    sys.exit(main())
