"""`python -m gruebler`."""

import sys

from gruebler.cli import main

if __name__ == "__main__":
    sys.exit(main())
