"""The command line: the only room that reads files, prints, and knows exit statuses.

0: all is well; 1: something asked about is not so (a claim fails, a drive leaves something undetermined); 2: wrong
usage or unreadable input, said in one sentence on standard error.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from gruebler.cli.parser import build_parser
from gruebler.errors import GrueblerError

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    arguments = build_parser().parse_args(argv)
    from importlib import import_module

    try:
        status = int(import_module(arguments.run).run(arguments))
        sys.stdout.flush()
    except GrueblerError as error:
        print(f"gruebler {arguments.command}: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader has gone (| head): what is still buffered has nowhere to go.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        print("\ngruebler: stopped", file=sys.stderr)
        return 130
    return status
