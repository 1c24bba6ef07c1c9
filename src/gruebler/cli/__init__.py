"""The command line: the only room that reads files, prints, and knows exit statuses.

0: all is well; 1: something asked about is not so (a claim fails, a drive leaves something undetermined); 2: wrong
usage or unreadable input, said in one sentence on standard error.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from gruebler.base.errors import GrueblerError, shortened
from gruebler.base.text import LANGUAGES, error_in_language, reason_of, translate
from gruebler.cli.commands import command, command_names, overview, welcome
from gruebler.cli.left_out import print_left_out
from gruebler.cli.parser import argparse_in_language, british, wanted_language

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    _prepare_streams()
    words = list(sys.argv[1:] if argv is None else argv)
    lang = LANGUAGES[0]
    done = False
    try:
        lang = wanted_language(words)
        words = _with_command_first(words)
        status = _run(words, lang)
        done = True
        return status
    except GrueblerError as error:
        return _complain(words, error_in_language(error, lang))
    except MemoryError:
        return _complain(words, translate("not enough memory", lang))
    except BrokenPipeError:
        # The reader has gone (| head): what is still buffered has nowhere to go.
        _forget_output()
        return 0
    except OSError as error:
        problem = reason_of(error)
        if error.filename is not None:
            file = shortened(repr(error.filename))
            return _complain(words, translate("{file} cannot be opened: {problem}", lang, file=file, problem=problem))
        _forget_output()
        return _complain(words, translate("cannot write the output: {problem}", lang, problem=problem))
    finally:
        print_left_out(done=done)


def _run(words: list[str], lang: str) -> int:
    if not words:
        print(welcome(lang))
        return 0
    if words == ["--help"]:
        print(overview(lang))
        return 0
    if words[0] in ("--version", "version"):
        from gruebler import __version__

        print(f"gruebler {__version__}")
        return 0
    chosen = command(words[0])
    parser = chosen.parser(lang)
    with argparse_in_language(lang):
        arguments = parser.parse_args(words[1:])
    from gruebler.cli.link_names import spell_links_alike
    from gruebler.cli.printed_file import printed_to_file
    from gruebler.cli.tables import cut_tables

    spell_links_alike(parser, arguments)
    try:
        with _interrupts_raised(), printed_to_file(arguments), cut_tables(arguments):
            status = int(chosen.module().run(arguments))
            sys.stdout.flush()
    except KeyboardInterrupt as stop:
        folder = getattr(arguments, "checkpoint", None) or next(iter(stop.args), None)
        stopped = translate("stopped; run the same command again to continue from {folder}", lang, folder=folder)
        print(f"\ngruebler: {stopped if folder else translate('stopped', lang)}", file=sys.stderr)
        return 130
    return status


@contextmanager
def _interrupts_raised() -> Iterator[None]:
    """Within, an interrupt is raised as Python does it, even if the command ends at once before and behind."""
    before = signal.getsignal(signal.SIGINT)
    if not callable(before) or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _with_command_first(words: list[str]) -> list[str]:
    """The words with the command in front: `help X` is `X --help`, and `--lang de X` is `X --lang de`."""
    before: list[str] = []
    while words and words[0].startswith("--lang"):
        size = 1 if "=" in words[0] else 2
        before, words = before + words[:size], words[size:]
    if words[:1] in (["help"], ["-h"], ["--help"]):
        words = [*words[1:], "--help"] if words[1:] and not words[1].startswith("-") else ["--help"]
    return words if words in ([], ["--help"]) else [words[0], *before, *words[1:]]


def _complain(words: list[str], text: str) -> int:
    """Say what is wrong with a command; returns its exit status."""
    known = [british(word) for word in words[:1] if british(word) in command_names()]
    print(f"{' '.join(['gruebler', *known])}: {text}", file=sys.stderr)
    return 2


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
