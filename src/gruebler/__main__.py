"""`python -m gruebler`."""

import sys

from gruebler_command import main

if __name__ == "__main__":
    sys.exit(main())
