"""Arguments of commands as rows of a table, and the rows that several commands share."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent
from typing import Any

_KINDS: dict[str, type] = {"int": int, "float": float, "path": Path}
_COUNTS = ("?", "*", "+")
_VALUES = {"=": "default", ":": "const"}


@dataclass(frozen=True, slots=True)
class Row:
    """One argument: its names, what argparse is told of it, and its help."""

    names: tuple[str, ...]
    settings: dict[str, Any]
    help: str


def rows_of(table: str) -> Iterator[Row]:
    """The rows of a table of arguments.

    A row is NAMES PLACEHOLDERS NOTES and, after two blanks, the help; it goes on in lines that are indented.
    Without a placeholder an option is a flag. Notes: int, float or path; {a,b} for choices; ... for what can be
    repeated; ?, * or + for how many values there may be; =VALUE for the default; :VALUE for what an option means
    without its value; ! for what must be given; >NAME for the name under which it is kept.

    >>> [(row.names, row.settings, row.help) for row in rows_of("--at DEG float  an angle of the crank")]
    [(('--at',), {'metavar': 'DEG', 'type': <class 'float'>}, 'an angle of the crank')]
    """
    blocks: list[list[str]] = []
    for line in dedent(table).strip("\n").splitlines():
        if line[:1].strip():
            blocks.append([line])
        elif line.strip():
            blocks[-1].append(line)
    for lines in blocks:
        spec, _, help = " ".join(map(str.strip, lines)).partition("  ")
        yield _row(spec.split(), help)


def _row(words: list[str], help: str) -> Row:
    names = [word.rstrip(",") for word in words if word.startswith("-")] or words[:1]
    placeholders: list[str] = []
    settings: dict[str, Any] = {}
    for word in words[len(names) :]:
        if word in _KINDS:
            settings["type"] = _KINDS[word]
        elif word in _COUNTS:
            settings["nargs"] = word
        elif word == "...":
            settings |= {"action": "append", "default": []}
        elif word.startswith("{"):
            choices = map(settings.get("type", str), word.strip("{}").split(","))
            settings["choices"] = (*settings.get("choices", ()), *choices)
        elif word == "!":
            settings["required"] = True
        elif word[0] == ">":
            settings["dest"] = word[1:]
        elif word[0] in _VALUES:
            settings[_VALUES[word[0]]] = settings.get("type", str)(word[1:])
        else:
            placeholders.append(word)
    if len(placeholders) > 1:
        settings = {"metavar": tuple(placeholders), "nargs": len(placeholders)} | settings
    elif placeholders:
        settings = {"metavar": placeholders[0]} | settings
    elif names[0].startswith("-") and "choices" not in settings:
        settings["action"] = "store_true"
    return Row(tuple(names), settings, help)


def take(parser: argparse._ActionsContainer, table: str) -> None:
    """Give a parser, or a group of one, the arguments of a table.

    A row without help is the shared one of that name, with what its own notes add.
    """
    for row in rows_of(table):
        shared = row if row.help else _SHARED[row.names[0]]
        notes = {} if row.help else {name: value for name, value in row.settings.items() if name != "action"}
        parser.add_argument(*shared.names, **shared.settings | notes, help=shared.help)


_SHARED = {
    row.names[0]: row
    for row in rows_of(
        """
        --branch LABELS  the assembly mode, such as +- (write --branch=-+)
        --frame LINK  the fixed link (default: the first)
        --drive JOINT ...  a driven joint (repeatable)
        --links N int  number of links
        --mobility F int =1  mobility (default: 1)
        --yes  run even if it takes long or needs much memory
        --count  print only the number
        --assortment N2,N3,...  numbers of binary, ternary, ... links
        --labels  label the links
        --structure  draw the structure of a catalog entry with dimensions
        linkage FILE|ID|LENGTHS  a .toml or .json file or one of another program (`gruebler convert --formats`), a
            catalog entry with dimensions, or lengths: four-bar:A,B,C,D, slider-crank:A,B[,E],
            inverted-slider-crank:A,D[,E]
        chain CHAIN  a chain such as 'R(0-1) R(1-2) R(2-3) R(3-0)', a code, g6:CODE or a catalog entry
        --space {planar,spherical,spatial}  space of the chain (default: planar)
        --range FROM:TO:STEP ...  drive values in degrees or the unit; repeat it for each drive, with the same number of
            steps; a single number keeps a drive at rest (default: the whole motion of one drive)
        --at VALUE[,VALUE] ...  a row at these drive values, one per drive; repeatable
        --loads  draw masses and springs of the file or entry, and the forces at its usual speed as arrows
        --curve POINT ...  the path of a named point, a joint, or LINK:X,Y (repeatable)
        --view {isometric,oblique}  of a linkage in space: the view (default: oblique for bevel wheels, else isometric)
        --jobs N int =1  number of processes (default: 1)
        --scheduler ADDRESS  send the work to a Dask scheduler, such as tcp://host:8786; local: one with a worker for
            each processor of this machine
        --crank  only designs whose drive turns fully
        --transmission DEG float =0  minimum transmission angle on the way through the targets (default: 0; the table
            marks angles below 40 and below 5 degrees)
        --size-ratio R float =20  limit of longest to shortest length
        --rejected  also list the rejected designs with their reasons
        --design K int  with -o: write design K of the list (default: 1)
        """
    )
}
