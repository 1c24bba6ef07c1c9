"""`python -m gruebler`."""

import sys

from gruebler.cli import main

sys.exit(main())
