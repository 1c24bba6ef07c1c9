"""`gruebler coverage`: the command or function for each concept and machine of the teaching documents."""

from __future__ import annotations

import argparse
import io
import math
import re
import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from functools import cache
from importlib import import_module
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

import msgspec

from gruebler.catalog import catalog_folder, entries
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.documents import convert_document, load_document
from gruebler.errors import CatalogError, GrueblerError
from gruebler.text import Message, message, translate

__all__ = [
    "Asked",
    "Outcome",
    "Row",
    "add",
    "asked_things",
    "coverage_rows",
    "execute",
    "expected_parts",
    "find_function",
    "missing_parts",
    "run",
]


class Concept(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A concept of the teaching documents, and what covers it."""

    where: str
    de: str
    en: str
    commands: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    refused: tuple[str, ...] = ()
    """Commands that must be refused (exit status 2)."""


class Machine(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A machine of the catalog, and what covers it."""

    id: str
    commands: tuple[str, ...] = ()


class Coverage(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The file."""

    concepts: tuple[Concept, ...]
    machines: tuple[Machine, ...]
    expected: dict[str, tuple[str, ...]]
    """For each command, parts of what it prints; `missing_parts` compares them."""


class Asked(NamedTuple):
    """One thing that the teaching documents ask, and what does it: commands of the table, or tests."""

    where: str
    en: str
    de: str
    done_by: tuple[str, ...]


class _AskedFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    asked: tuple[Asked, ...]


class Row(NamedTuple):
    """A row of the table."""

    where: str
    en: str
    de: str
    commands: tuple[tuple[str, int], ...]
    """Commands without ``gruebler``, and the exit status that each is to have."""
    functions: tuple[str, ...]


class Outcome(NamedTuple):
    """How a command ended."""

    command: str
    wanted: int
    status: int
    seconds: float
    said: str
    """The last line of its messages."""
    missing: tuple[str, ...]
    """What it should have printed, but did not."""

    @property
    def good(self) -> bool:
        """Whether it ended as it is to, and printed what it is to."""
        return self.status == self.wanted and not self.missing


@cache
def _table() -> Coverage:
    path: Path = catalog_folder() / "coverage.toml"

    def fail(text: Message) -> CatalogError:
        return CatalogError("{path}: {problem}", path=path, problem=text)

    table = convert_document(load_document(path, fail), Coverage, fail)
    if strange := sorted({machine.id for machine in table.machines} - set(entries())):
        raise fail(message("machines: the catalog has no entry {machine!r}", machine=strange[0]))
    return table


@cache
def asked_things() -> tuple[Asked, ...]:
    """Everything that the teaching documents ask, in their order.

    >>> len(asked_things())
    221
    """
    path: Path = catalog_folder() / "asked.toml"

    def fail(text: Message) -> CatalogError:
        return CatalogError("{path}: {problem}", path=path, problem=text)

    return convert_document(load_document(path, fail), _AskedFile, fail).asked


def expected_parts(command: str) -> tuple[str, ...]:
    """Parts of what a command of the table prints."""
    return _table().expected.get(command, ())


def missing_parts(output: str, parts: Sequence[str]) -> list[str]:
    """The parts that an output does not have, word by word; numbers with decimals may differ by a tenth of a per mille.

    >>> missing_parts("It swings through 79.84591°.", ["swings through 79.846°", "It turns"])
    ['It turns']
    """
    words = _WORD.findall(output)
    return [part for part in parts if not _has_part(words, _WORD.findall(part))]


_WORD = re.compile(r"\d+(?:[.,]\d+)?(?:e[-+]\d+)?|[^\s\d]")
_EXACTNESS = 1e-4  # relative: outputs have six digits and more, so that roundings of the last are no matter


def _has_part(words: Sequence[str], part: Sequence[str]) -> bool:
    places = (k for k in range(len(words) - len(part) + 1) if _same(words[k], part[0]))
    return any(all(map(_same, words[k:], part)) for k in places)


def _same(word: str, wanted: str) -> bool:
    if word == wanted or wanted.isdecimal() or not (wanted[0].isdecimal() and word[0].isdecimal()):
        return word == wanted
    numbers = (float(text.replace(",", ".")) for text in (word, wanted))
    return math.isclose(*numbers, rel_tol=_EXACTNESS)


@cache
def coverage_rows() -> tuple[Row, ...]:
    """The concepts, then the machines; every machine of the catalog is there, at least with nothing."""
    table = _table()
    commands_of = {machine.id: machine.commands for machine in table.machines}
    concepts = [
        Row(
            concept.where,
            concept.en,
            concept.de,
            (*((c, 0) for c in concept.commands), *((c, 2) for c in concept.refused)),
            concept.functions,
        )
        for concept in table.concepts
    ]
    machines = [
        Row(entry.id, entry.name.en, entry.name.de, tuple((c, 0) for c in commands_of.get(entry.id, ())), ())
        for entry in entries().values()
    ]
    return (*concepts, *machines)


def find_function(name: str) -> object | None:
    """What stands under a full name such as ``gruebler.Chain.parse``; None if nothing does."""
    parts = name.split(".")
    for k in range(len(parts), 0, -1):
        try:
            value: Any = import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            value = getattr(value, part, None)
        return value  # type: ignore[no-any-return]  # whatever stands there
    return None


def execute(command: str, wanted: int = 0) -> Outcome:
    """Run a command in this process, its output kept."""
    from gruebler.cli import main

    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True) for _ in range(2))
    begun = monotonic()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            status = main(shlex.split(command))
        except SystemExit as stop:
            status = stop.code if isinstance(stop.code, int) else 2
    for stream in (out, err):
        stream.seek(0)
    printed, said = out.read(), err.read()
    lines = said.strip().splitlines()
    missing = missing_parts(printed if wanted == 0 else said, expected_parts(command))
    return Outcome(command, wanted, status, monotonic() - begun, lines[-1] if lines else "", tuple(missing))


# --- the command -----------------------------------------------------------------------------------


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="List all concepts and machines of the teaching documents with the commands and functions that "
        "cover them. With --run, run every command and look up every function.",
        epilog="Exit status: 0 success, 1 a row has no command and no function, a command fails, or a function is "
        "missing.",
    )
    parser.add_argument("words", nargs="*", metavar="WORD", help="list only rows with these words or ids")
    parser.add_argument("--run", dest="execute", action="store_true", help="run every command and report how it ended")
    parser.add_argument("--asked", action="store_true", help="list instead each thing that the documents ask")
    parser.add_printed(help="print a list of objects")


def run(arguments: argparse.Namespace) -> int:
    """Print the table; with --run execute what is in it."""
    if arguments.asked:
        return _print_asked(arguments)
    chosen = [row for row in coverage_rows() if all(_has(row, word) for word in arguments.words)]
    outcomes: dict[str, Outcome] = {}
    if arguments.execute:
        wanted = {command: status for row in chosen for command, status in row.commands}
        outcomes = {outcome.command: outcome for outcome in _executed(wanted)}
    absent = {name for row in chosen for name in row.functions if arguments.execute and find_function(name) is None}
    if arguments.json:
        print_json([_document(row, outcomes, absent) for row in chosen])
    else:
        _print(chosen, outcomes, absent, arguments)
    missing = any(not row.commands and not row.functions for row in chosen)
    return int(missing or bool(absent) or not all(outcome.good for outcome in outcomes.values()))


def _print_asked(arguments: argparse.Namespace) -> int:
    if arguments.execute:
        raise GrueblerError("--asked does not go with --run; every command of that list is in the table")
    chosen = [each for each in asked_things() if all(_has(each, word) for word in arguments.words)]
    if arguments.json:
        print_json([each._asdict() for each in chosen])
        return 0
    lang = arguments.lang
    lines = []
    for each in chosen:
        for k, done_by in enumerate(each.done_by):
            text = done_by if done_by.startswith("tests/") else f"gruebler {done_by}"
            lines.append((each.where, each.de if lang == "de" else each.en, text) if k == 0 else ("", "", text))
    headers = translate("section", lang), translate("asked", lang), translate("done by", lang)
    print_table([*headers], lines)
    print()
    print(translate("{count} things are asked.", lang, count=len(chosen)))
    return 0


def _has(row: Row | Asked, word: str) -> bool:
    return any(word.casefold() in text.casefold() for text in (row.where, row.en, row.de))


def _executed(wanted: dict[str, int]) -> Iterator[Outcome]:
    """One after another; said on a terminal."""
    shown = sys.stderr.isatty()
    for number, (command, status) in enumerate(wanted.items(), 1):
        if shown:
            print(f"\r\033[K{number}/{len(wanted)} {command[:60]}", end="", file=sys.stderr, flush=True)
        yield execute(command, status)
    if shown:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


def _document(row: Row, outcomes: dict[str, Outcome], absent: set[str]) -> dict[str, Any]:
    commands: list[dict[str, Any]] = []
    for command, wanted in row.commands:
        entry: dict[str, Any] = {"command": f"gruebler {command}", "wanted": wanted}
        if (outcome := outcomes.get(command)) is not None:
            entry |= {"status": outcome.status, "seconds": round(outcome.seconds, 3), "said": outcome.said}
            entry["missing"] = list(outcome.missing)
        commands.append(entry)
    functions = [{"function": name} | ({"there": name not in absent} if outcomes else {}) for name in row.functions]
    return {"where": row.where, "en": row.en, "de": row.de, "commands": commands, "functions": functions}


def _print(
    chosen: Sequence[Row], outcomes: dict[str, Outcome], absent: set[str], arguments: argparse.Namespace
) -> None:
    lang = arguments.lang
    lines = []
    for row in chosen:
        covered = [_command_text(command, outcomes.get(command), lang) for command, _ in row.commands]
        covered += [
            translate("{function}  (missing)", lang, function=name) if name in absent else name
            for name in row.functions
        ]
        name = row.de if lang == "de" else row.en
        for k, text in enumerate(covered or [translate("NOT COVERED", lang)]):
            lines.append((row.where, name, text) if k == 0 else ("", "", text))
    print_table([translate("section", lang), translate("concept", lang), translate("covered by", lang)], lines)
    commands = {command for row in chosen for command, _ in row.commands}
    functions = {name for row in chosen for name in row.functions}
    missing = sum(not row.commands and not row.functions for row in chosen)
    print()
    print(
        translate(
            "{rows} rows, {commands} commands, {functions} functions; not covered: {missing} rows.",
            lang,
            rows=len(chosen),
            commands=len(commands),
            functions=len(functions),
            missing=missing,
        )
    )
    if arguments.execute:
        good = sum(outcome.good for outcome in outcomes.values())
        there = len(functions) - len(absent)
        print(
            translate(
                "{good} of {commands} commands ended as expected, {there} of {functions} functions exist.",
                lang,
                good=good,
                commands=len(commands),
                there=there,
                functions=len(functions),
            )
        )


def _command_text(command: str, outcome: Outcome | None, lang: str) -> str:
    if outcome is None or outcome.good:
        return f"gruebler {command}"
    if outcome.status == outcome.wanted:
        return translate(
            "gruebler {command}  (does not print {part!r})", lang, command=command, part=outcome.missing[0]
        )
    return translate(
        "gruebler {command}  (status {status} instead of {wanted}: {output})",
        lang,
        command=command,
        status=outcome.status,
        wanted=outcome.wanted,
        output=outcome.said,
    )
