"""The parser of a command: argparse in the reader's language, with wrong usage said in one sentence."""

from __future__ import annotations

import argparse
import gettext
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from typing import Any, NoReturn

from gruebler.errors import GrueblerError, nearest, shortened
from gruebler.text import LANGUAGES, LOCALE, translate

__all__ = ["Parser", "argparse_in_language", "wanted_language"]


class Parser(argparse.ArgumentParser):
    """argparse whose help is translated and whose errors are one sentence with the nearest known word.

    Every parser takes ``--lang``. Help texts are given in English; they are translated when they are shown.
    """

    def __init__(self, *, lang: str = LANGUAGES[0], **settings: Any) -> None:
        super().__init__(formatter_class=partial(_HelpFormatter, lang=lang), **settings)
        self.lang = lang
        self._commands: Any = None
        self.add_argument("--lang", choices=LANGUAGES, default=lang, help="language of the output (default: en)")

    def describe(self, *, description: str, epilog: str = "") -> None:
        """The texts before and after the list of options."""
        self.description, self.epilog = description, epilog

    def add_command(self, name: str, *, help: str, description: str | None = None, epilog: str = "") -> Parser:
        """A command below this one; its name is kept as `action`."""
        if self._commands is None:
            kind: Any = partial(Parser, lang=self.lang)
            self._commands = self.add_subparsers(dest="action", metavar="ACTION", required=True, parser_class=kind)
        command: Parser = self._commands.add_parser(name, help=help, description=description or help, epilog=epilog)
        return command

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As argparse; an unknown option is answered by the nearest known one."""
        arguments, unknown = self.parse_known_args(args, namespace)
        if unknown:
            known = [option for parser in self._all() for option in parser._option_string_actions]
            suggestion = nearest(unknown[0].partition("=")[0], known) if unknown[0].startswith("-") else ""
            self.error(
                translate(
                    "unknown arguments: {arguments}{suggestion}",
                    self.lang,
                    arguments=" ".join(unknown),
                    suggestion=suggestion,
                )
            )
        return arguments

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """As argparse; a value that is none of the choices is answered by the nearest of them."""
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            suggestion = nearest(str(value)[:50], map(str, action.choices or ()))
            raise argparse.ArgumentError(action, error.message + suggestion) from None

    def error(self, message: str) -> NoReturn:
        """Say in one sentence what is wrong and where the help is, and exit with status 2."""
        text = translate("{problem} (see {program} --help)", self.lang, problem=shortened(message), program=self.prog)
        self.exit(2, f"{self.prog}: {text}\n")

    def _all(self) -> Iterator[Parser]:
        yield self
        if self._commands is not None:
            yield from self._commands.choices.values()


class _HelpFormatter(argparse.HelpFormatter):
    """argparse's formatter with translated texts."""

    def __init__(self, prog: str, lang: str) -> None:
        super().__init__(prog)
        self._lang = lang

    def add_text(self, text: str | None) -> None:
        """A paragraph."""
        super().add_text(text and translate(text, self._lang))

    def _get_help_string(self, action: argparse.Action) -> str | None:
        return action.help and translate(action.help, self._lang)


@contextmanager
def argparse_in_language(lang: str) -> Iterator[None]:
    """Argparse takes its own words from gettext: within this, from our catalog of a language."""
    before, wanted = gettext.textdomain(), os.environ.get("LANGUAGE")
    gettext.bindtextdomain("gruebler", str(LOCALE))
    gettext.textdomain("gruebler")
    os.environ["LANGUAGE"] = lang
    try:
        yield
    finally:
        gettext.textdomain(before)
        if wanted is None:
            del os.environ["LANGUAGE"]
        else:
            os.environ["LANGUAGE"] = wanted


def wanted_language(argv: Sequence[str]) -> str:
    """The language that ``--lang`` asks for, else the environment variable GRUEBLER_LANG, else English.

    Raises `GrueblerError` if GRUEBLER_LANG is none of the languages; a wrong ``--lang`` is refused by the parser.
    """
    default = os.environ.get("GRUEBLER_LANG") or LANGUAGES[0]
    if default not in LANGUAGES:
        raise GrueblerError(
            "GRUEBLER_LANG: expected {languages}, but found {found!r}", languages=" or ".join(LANGUAGES), found=default
        )
    wanted = default
    for word, following in pairwise([*argv, ""]):
        if word == "--":
            break
        option, _, value = word.partition("=")
        if option == "--lang":
            wanted = value or following
    return wanted if wanted in LANGUAGES else default
