"""The parser of `gruebler coverage`. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `coverage` to the parser of all commands."""
    coverage: argparse.ArgumentParser = commands.add_parser(
        "coverage",
        help="what does each concept and each machine of the seeds: commands and functions",
        description="A table of all concepts and machines of the seeds with the commands and functions that do them. "
        "With --run every command is executed, every function looked up.",
        epilog="Exit status: 0 nothing is missing, 1 a row has nothing that does it, a command fails or a function is "
        "not there.",
    )
    coverage.add_argument("words", nargs="*", metavar="WORD", help="only rows with these words or ids")
    coverage.add_argument("--run", dest="execute", action="store_true", help="execute every command, say how it ended")
    coverage.add_argument("--json", action="store_true", help="a list of objects")
    coverage.add_argument("--lang", choices=("en", "de"), default="en", help="language of the output (default: en)")
    coverage.set_defaults(run="gruebler.cli.coverage")
