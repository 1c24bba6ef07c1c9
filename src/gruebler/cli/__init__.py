"""The command line: the only room that reads files, prints, and knows exit statuses.

0: all is well; 1: something asked about is not so (a claim fails, a drive leaves something undetermined); 2: wrong
usage or unreadable input, said in one sentence on standard error.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from gruebler.cli.parser import build_parser
from gruebler.errors import GrueblerError, shortened

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    _prepare_streams()
    arguments = build_parser().parse_args(argv)
    from importlib import import_module

    from gruebler.cli.compiling_progress import show_compiling

    try:
        show_compiling(getattr(arguments, "lang", "en"))
        status = int(import_module(arguments.run).run(arguments))
        sys.stdout.flush()
    except GrueblerError as error:
        print(f"gruebler {arguments.command}: {error.in_language(getattr(arguments, 'lang', 'en'))}", file=sys.stderr)
        return 2
    except MemoryError:
        print(f"gruebler {arguments.command}: this needs more memory than there is", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader has gone (| head): what is still buffered has nowhere to go.
        _forget_output()
        return 0
    except OSError as error:
        if error.filename is None:
            _forget_output()
        what = "cannot write the output" if error.filename is None else f"{error.filename!r} cannot be opened"
        print(f"gruebler {arguments.command}: {shortened(what)}: {error.strerror or error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        kept = getattr(arguments, "checkpoint", None)
        again = f"; the same command goes on from {kept}" if kept else ""
        print(f"\ngruebler: stopped{again}", file=sys.stderr)
        return 130
    return status


def _prepare_streams() -> None:
    """A closed output swallows what is printed; an encoding without a letter shows it as an escape."""
    if sys.stdout is None:
        sys.stdout = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115  open as long as the process lives
    if sys.stderr is None:
        sys.stderr = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")


def _forget_output() -> None:
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        sys.stdout = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
