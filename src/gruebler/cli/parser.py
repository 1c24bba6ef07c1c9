"""The parser of a command: argparse in the reader's language, with wrong usage said in one sentence."""

from __future__ import annotations

import argparse
import gettext
import os
import re
import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any, NoReturn

from gruebler.base.errors import GrueblerError, nearest, shortened
from gruebler.base.text import LANGUAGES, LOCALE, joined_by_or, message, translate
from gruebler.cli.arguments import take
from gruebler.cli.printed_file import TABLES

_PICTURES = (".svg", ".png", ".pdf", ".html", ".gif", ".webp")
_PLACEHOLDERS = {
    str(word): word
    for word in (
        message("FILE"),
        message("LINK"),
        message("JOINT"),
        message("POINT"),
        message("CHAIN"),
        message("MECHANISM"),
        message("LINKAGE"),
        message("LENGTH"),
        message("LENGTHS"),
        message("VALUE"),
        message("FROM"),
        message("TO"),
        message("STEP"),
        message("LABELS"),
        message("WORD"),
        message("TASK"),
        message("EXPRESSION"),
        message("KEY"),
        message("ANSWER"),
        message("TRAIN"),
        message("PAIR"),
        message("PAIRS"),
        message("PLACE"),
        message("LIFT"),
        message("WIDTH"),
        message("INPUT"),
        message("OUTPUT"),
        message("DEG"),
        message("RPM"),
        message("ACTION"),
        message("DIR"),
        message("ADDRESS"),
        message("KIND"),
        message("TYPE"),
        message("RATIO"),
        message("PART"),
        message("HEIGHT"),
    )
}
"""What stands for a value in the list of options."""
_NAMES_A_LINK = re.compile(r"\b(LINK|JOINT|POINT)\b")
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+")
_KINDS = {int: message("a whole number"), float: message("a number")}


_AMERICAN = {"center": "centre", "color": "colour", "analyz": "analys", "synthesiz": "synthesis", "realiz": "realis"}
_AMERICAN_WORD = re.compile("|".join(_AMERICAN))


def british(word: str) -> str:
    """A word of the command line as the commands spell it.

    >>> british("dead-centers"), british("synthesize"), british("--size-ratio")
    ('dead-centres', 'synthesise', '--size-ratio')
    """
    return _AMERICAN_WORD.sub(lambda match: _AMERICAN[match[0]], word)


class Parser(argparse.ArgumentParser):
    """argparse whose help is translated and whose errors are one sentence with the nearest known word.

    Every parser takes ``--lang``; options are written out in full. Help texts are given in English; they are
    translated when they are shown.
    """

    def __init__(self, *, lang: str = LANGUAGES[0], **settings: Any) -> None:
        super().__init__(formatter_class=partial(_HelpFormatter, lang=lang), allow_abbrev=False, **settings)
        self.lang = lang
        self.names_of_links: list[str] | None = None
        """The arguments that name links, joints or points, once some were read."""
        self._commands: Any = None
        self._first = self
        """The parser of the whole command, for one of its actions."""
        self.add_argument(
            "--lang", choices=LANGUAGES, default=lang, help="language of the output (default: GRUEBLER_LANG, else en)"
        )

    def describe(self, *, description: str, epilog: str = "") -> None:
        """The texts before and after the list of options."""
        self.description, self.epilog = description, epilog

    def take(self, table: str) -> None:
        """The arguments of a table (`arguments.take`)."""
        take(self, table)

    def add_command(self, name: str, *, help: str, description: str | None = None, epilog: str = "") -> Parser:
        """A command below this one; its name is kept as `action`, and must be given unless a default is set."""
        if self._commands is None:
            kind: Any = partial(Parser, lang=self.lang)
            default = self.get_default("action")
            required = default is None
            self._commands = self.add_subparsers(dest="action", metavar="ACTION", required=required, parser_class=kind)
            self._commands.default = default
        command: Parser = self._commands.add_parser(name, help=help, description=description or help, epilog=epilog)
        command._first = self
        return command

    def add_out(self, *, help: str, required: bool = False, endings: Sequence[str] = ()) -> None:
        """`-o FILE`, the file to write, kept as `out`.

        Args:
            help: What is written.
            required: Whether it must be given.
            endings: The endings that the name may have, without the dot; others are refused. Empty: any.
        """
        kind = partial(_path_with_ending, endings=endings, lang=self.lang) if endings else Path
        self.add_argument("-o", "--out", type=kind, metavar="FILE", required=required, help=help)

    def add_json(self, *, help: str) -> None:
        """`--json`, and `--all` for tables that are cut otherwise (`tables.cut_tables`)."""
        self.add_argument("--json", action="store_true", help=help)
        self.take("--all  print all rows of long tables")

    def add_printed(self, *, help: str, table: bool = False, pictures: bool = False) -> None:
        """`--json`, and `-o FILE` for what the command prints otherwise (`printed_file.printed_to_file`).

        Args:
            help: What is printed with `--json`.
            table: Whether the command itself writes a table to a .csv or .parquet file.
            pictures: Whether it writes pictures, besides what it prints.
        """
        self.add_json(help=help)
        if pictures:
            self.add_out(
                help="also a picture: .svg, .png or .pdf, with --animate .svg, .html, .gif, .webp or .png (APNG); or "
                "write what is printed: .txt, or .json as with --json"
            )
        elif table:
            self.add_out(
                help="write into a file instead: .txt, .json as with --json, or the columns: .csv, or .parquet (needs "
                "pyarrow)"
            )
            self.take("--decimal-comma  in .csv: decimal commas, semicolons between cells")
        else:
            self.add_out(help="write into a file instead: .txt, or .json as with --json")
        self.set_defaults(written=_PICTURES if pictures else TABLES if table else ())

    def translate_placeholders(self) -> None:
        """Put what stands for values into the reader's language, once all arguments are added."""
        if self.names_of_links is None:
            self.names_of_links = [a.dest for a in self._actions if _NAMES_A_LINK.search(str(a.metavar))]
            for action in self._actions:
                action.metavar = _placeholder(action.metavar, self.lang)

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As argparse; placeholders are translated, and American spellings of options taken for the British ones."""
        self.translate_placeholders()
        words = list(args or ())
        options = words[: words.index("--")] if "--" in words else words
        for k, word in enumerate(options):
            option, equals, value = word.partition("=")
            if option.startswith("--") and (known := british(option)) in self._option_string_actions:
                words[k] = f"{known}{equals}{value}"
        args = words
        if self._commands is None:
            self._refuse_unknown_options(args or ())
        return super().parse_known_args(args, namespace)

    def _refuse_unknown_options(self, words: Sequence[str]) -> None:
        """Complain of the first option that there is not, before argparse complains of what is missing without it."""
        for word in words:
            if word == "--":
                return
            option = word.partition("=")[0]
            if option.startswith("--") and " " not in word and option not in self._known():
                self._complain_of_unknown([word])

    def _known(self) -> Iterable[str]:
        """All options of this parser."""
        return self._option_string_actions

    def _complain_of_unknown(self, unknown: Sequence[str], words: Sequence[str] = ()) -> NoReturn:
        option = unknown[0].partition("=")[0]
        known = [option for parser in self._first._all() for option in parser._known()]
        guess = option.startswith("-") and option not in known  # one of another action is known
        suggestion = nearest(option, self._known()) if guess else self._how_repeated(unknown[0], words)
        self.error(
            translate(
                "unknown arguments: {arguments}{suggestion}",
                self.lang,
                arguments=" ".join(unknown),
                suggestion=suggestion,
            )
        )

    def _how_repeated(self, unknown: str, words: Sequence[str]) -> str:
        """What to do if the word that nobody takes stands behind the value of an option that may be repeated."""
        before = words[: words.index(unknown)] if unknown in words else ()
        actions = [action for parser in self._first._all() for action in parser._actions if action.default == []]
        names = {name for action in actions for name in action.option_strings}
        if len(before) < 2 or before[-2] not in names:
            return ""
        return translate(" (give {option} before each of its values)", self.lang, option=before[-2])

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        """As argparse; numbers are called so, not int and float; choices may be spelt the American way."""
        if action.choices is not None and british(arg_string) in action.choices:
            arg_string = british(arg_string)
        try:
            return super()._get_value(action, arg_string)
        except argparse.ArgumentError:
            kind = _KINDS.get(action.type)  # type: ignore[call-overload]  # whatever the type is
            if kind is None:
                raise
            if action.type is float and _DECIMAL_COMMA.fullmatch(arg_string):
                kind = message("a number with a decimal point")
            text = translate("expected {kind}, but found {found!r}", self.lang, kind=kind, found=arg_string)
            raise argparse.ArgumentError(action, text) from None

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As argparse; an unknown option is answered by the nearest known one."""
        words = sys.argv[1:] if args is None else list(args)
        arguments, unknown = self.parse_known_args(words, namespace)
        if unknown:
            self._complain_of_unknown(unknown, words)
        return arguments

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """As argparse; a value that is none of the choices is answered by the nearest of them."""
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            suggestion = nearest(str(value)[:50], map(str, action.choices or ()))
            text = translate("{problem}{suggestion}", self.lang, problem=error.message, suggestion=suggestion)
            raise argparse.ArgumentError(action, text) from None

    def error(self, message: str) -> NoReturn:
        """Say in one sentence what is wrong and where the help is, and exit with status 2."""
        text = translate("{problem} (see {program} --help)", self.lang, problem=shortened(message), program=self.prog)
        self.exit(2, f"{self.prog}: {text}\n")

    def _all(self) -> Iterator[Parser]:
        yield self
        if self._commands is not None:
            yield from self._commands.choices.values()


def _path_with_ending(text: str, endings: Sequence[str], lang: str) -> Path:
    path = Path(text)
    if path.suffix.lower().removeprefix(".") not in endings:
        known = joined_by_or([f".{ending}" for ending in endings])
        raise argparse.ArgumentTypeError(
            translate(
                "expected a file name that ends with {endings}, but found {found!r}", lang, endings=known, found=text
            )
        )
    return path


def _placeholder(metavar: Any, lang: str) -> Any:
    """A placeholder such as LINK:X,Y, or several, with the words translated."""

    def word(match: re.Match[str]) -> str:
        return _PLACEHOLDERS[match[0]].in_language(lang) if match[0] in _PLACEHOLDERS else match[0]

    if isinstance(metavar, tuple):
        return tuple(_placeholder(each, lang) for each in metavar)
    return re.sub(r"[A-Z]{2,}", word, metavar) if metavar else metavar


class _HelpFormatter(argparse.HelpFormatter):
    """argparse's formatter with translated texts."""

    def __init__(self, prog: str, lang: str) -> None:
        super().__init__(prog)
        self._lang = lang

    def add_text(self, text: str | None) -> None:
        """A paragraph."""
        super().add_text(text and translate(text, self._lang))

    def start_section(self, heading: str | None) -> None:
        """The title of a group of options."""
        super().start_section(heading and translate(heading, self._lang))

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(indent + line for line in self._split_lines(text, width))

    def _split_lines(self, text: str, width: int) -> list[str]:
        """Lines that keep options and commands with hyphens in one piece."""
        return textwrap.wrap(" ".join(text.split()), width, break_on_hyphens=False)

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
            "GRUEBLER_LANG: expected {languages}, but found {found!r}", languages=joined_by_or(LANGUAGES), found=default
        )
    wanted = default
    for word, following in pairwise([*argv, ""]):
        if word == "--":
            break
        option, _, value = word.partition("=")
        if option == "--lang":
            wanted = value or following
    return wanted if wanted in LANGUAGES else default
