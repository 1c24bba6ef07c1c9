"""`gruebler coverage`: what does each concept and each machine of the seeds, and whether it does."""

from __future__ import annotations

import argparse
import io
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
from gruebler.errors import CatalogError
from gruebler.text import Message, message

__all__ = ["Outcome", "Row", "add", "coverage_rows", "execute", "find_function", "run"]


class Concept(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A concept of the seeds, and what does it."""

    where: str
    de: str
    en: str
    commands: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    refused: tuple[str, ...] = ()
    """Commands that must be refused (exit status 2)."""


class Machine(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A machine of the catalog, and what does it."""

    id: str
    commands: tuple[str, ...] = ()


class Coverage(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The file."""

    concepts: tuple[Concept, ...]
    machines: tuple[Machine, ...]


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

    @property
    def good(self) -> bool:
        """Whether it ended as it is to."""
        return self.status == self.wanted


@cache
def coverage_rows() -> tuple[Row, ...]:
    """The concepts, then the machines; every machine of the catalog is there, at least with nothing."""
    path: Path = catalog_folder() / "coverage.toml"

    def fail(text: Message) -> CatalogError:
        return CatalogError("{path}: {problem}", path=path, problem=text)

    table = convert_document(load_document(path, fail), Coverage, fail)
    told = {machine.id: machine.commands for machine in table.machines}
    if strange := sorted(set(told) - set(entries())):
        raise fail(message("machines: the catalog has no entry {machine!r}", machine=strange[0]))
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
        Row(entry.id, entry.name.en, entry.name.de, tuple((c, 0) for c in told.get(entry.id, ())), ())
        for entry in entries().values()
    ]
    return (*concepts, *machines)


def find_function(name: str) -> object | None:
    """What stands under a full name such as ``gruebler.Chain.parse``; None if nothing does."""
    parts = name.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found: Any = import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            found = getattr(found, part, None)
        return found  # type: ignore[no-any-return]  # whatever stands there
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
    err.seek(0)
    lines = err.read().strip().splitlines()
    return Outcome(command, wanted, status, monotonic() - begun, lines[-1] if lines else "")


# --- the command -----------------------------------------------------------------------------------

_HEADERS = {
    "en": ("where", "what", "does it"),
    "de": ("wo", "was", "leistet es"),
}
_WORDS = {
    "en": {
        "nothing": "NOTHING DOES IT",
        "absent": "not there",
        "ended": "status {status} instead of {wanted}",
        "sum": "{rows} rows, {commands} commands, {functions} functions; {missing} rows without one.",
        "ran": "{good} of {commands} commands ended as they are to, {there} of {functions} functions are there.",
    },
    "de": {
        "nothing": "NICHTS LEISTET ES",
        "absent": "fehlt",
        "ended": "Status {status} statt {wanted}",
        "sum": "{rows} Zeilen, {commands} Befehle, {functions} Funktionen; {missing} Zeilen ohne.",
        "ran": "{good} von {commands} Befehlen endeten wie gewollt, {there} von {functions} Funktionen sind da.",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A table of all concepts and machines of the seeds with the commands and functions that do them. "
        "With --run every command is executed, every function looked up.",
        epilog="Exit status: 0 nothing is missing, 1 a row has nothing that does it, a command fails or a function is "
        "not there.",
    )
    parser.add_argument("words", nargs="*", metavar="WORD", help="only rows with these words or ids")
    parser.add_argument("--run", dest="execute", action="store_true", help="execute every command, say how it ended")
    parser.add_argument("--json", action="store_true", help="a list of objects")


def run(arguments: argparse.Namespace) -> int:
    """Print the table; with --run execute what is in it."""
    chosen = [row for row in coverage_rows() if all(_has(row, word) for word in arguments.words)]
    outcomes: dict[str, Outcome] = {}
    if arguments.execute:
        wanted = {command: status for row in chosen for command, status in row.commands}
        outcomes = {outcome.command: outcome for outcome in _executed(wanted)}
    absent = {name for row in chosen for name in row.functions if arguments.execute and find_function(name) is None}
    if arguments.json:
        print_json([_document(row, outcomes, absent) for row in chosen])
    else:
        _tell(chosen, outcomes, absent, arguments)
    missing = any(not row.commands and not row.functions for row in chosen)
    return int(missing or bool(absent) or not all(one.good for one in outcomes.values()))


def _has(row: Row, word: str) -> bool:
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
        one: dict[str, Any] = {"command": f"gruebler {command}", "wanted": wanted}
        if (outcome := outcomes.get(command)) is not None:
            one |= {"status": outcome.status, "seconds": round(outcome.seconds, 3), "said": outcome.said}
        commands.append(one)
    functions = [{"function": name} | ({"there": name not in absent} if outcomes else {}) for name in row.functions]
    return {"where": row.where, "en": row.en, "de": row.de, "commands": commands, "functions": functions}


def _tell(chosen: Sequence[Row], outcomes: dict[str, Outcome], absent: set[str], arguments: argparse.Namespace) -> None:
    words = _WORDS[arguments.lang]
    lines = []
    for row in chosen:
        done = [_command_said(command, outcomes.get(command), words) for command, _ in row.commands]
        done += [f"{name}  ({words['absent']})" if name in absent else name for name in row.functions]
        name = row.de if arguments.lang == "de" else row.en
        for k, what in enumerate(done or [words["nothing"]]):
            lines.append((row.where, name, what) if k == 0 else ("", "", what))
    print_table(_HEADERS[arguments.lang], lines)
    commands = {command for row in chosen for command, _ in row.commands}
    functions = {name for row in chosen for name in row.functions}
    missing = sum(not row.commands and not row.functions for row in chosen)
    print()
    print(words["sum"].format(rows=len(chosen), commands=len(commands), functions=len(functions), missing=missing))
    if arguments.execute:
        good = sum(outcome.good for outcome in outcomes.values())
        there = len(functions) - len(absent)
        print(words["ran"].format(good=good, commands=len(commands), there=there, functions=len(functions)))


def _command_said(command: str, outcome: Outcome | None, words: dict[str, str]) -> str:
    text = f"gruebler {command}"
    if outcome is None or outcome.good:
        return text
    return f"{text}  ({words['ended'].format(status=outcome.status, wanted=outcome.wanted)}: {outcome.said})"
