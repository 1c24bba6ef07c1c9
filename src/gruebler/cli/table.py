"""`gruebler table`: teaching tables, and the tables of counts."""

from __future__ import annotations

import argparse

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, number, translate
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table, print_text
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.fourbar.length_texts import size_of
from gruebler.structure.count_tables import CountTable, count_table, count_tables
from gruebler.teaching.exercises import lines_of_table, table_as_dict, teaching_table

_COUNTS = "counts"
_ORIGIN = message(
    "Method: {method}\nSecond method: {second_method}\nMade by {command} (version {version}, {seconds} s)"
)


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Tables for teaching, computed when they are printed: joints by degrees of freedom, links by "
        "joints and motion, the four inversions of a four-bar chain, four-bars by Grashof's condition with the "
        "smallest integer lengths, transfer functions of gears, linkages, cams and Geneva drives. And counts: how "
        "many chains, groups, trains and assembly modes there are, each table with its method and second method.",
        epilog="Examples: gruebler table grashof --lang de; gruebler table inversions 25,70,40,70; gruebler table "
        "counts; gruebler table counts chains -o chains.csv",
    )
    parser.take(
        """
        name NAME {joints,links,inversions,grashof,transfer,counts}  joints, links, inversions, grashof, transfer or
            counts
        what LENGTHS|TABLE ?  of inversions: other lengths a,b,c,d, such as 25,70,40,70; of counts: the name of a table
            (without: all names)
        """
    )
    parser.add_printed(help="print a list of objects with title, headers and rows; of counts the table", table=True)


def run(arguments: argparse.Namespace) -> int:
    """Print the tables of a name."""
    if arguments.name == _COUNTS:
        _counts(arguments)
        return 0
    if is_table(arguments.out):
        raise GrueblerError("only tables of counts are written as .csv or .parquet: gruebler table counts NAME -o FILE")
    lengths: tuple[float, ...] = ()
    if arguments.what is not None:
        size = size_of(arguments.what)
        if not isinstance(size, FourBar):
            raise GrueblerError("expected four lengths such as 25,70,40,70, but found {word!r}", word=arguments.what)
        lengths = tuple(size.named.values())
    tables = teaching_table(arguments.name, lengths)
    if arguments.json:
        print_json([table_as_dict(table) for table in tables])
    else:
        print("\n\n".join("\n".join(lines_of_table(table, arguments.lang)) for table in tables))
    return 0


def _counts(arguments: argparse.Namespace) -> None:
    """A table of counts, or without a name the list of all."""
    lang, path = arguments.lang, arguments.out
    if arguments.what is None:
        tables = count_tables().values()
        if is_table(path):
            raise GrueblerError("a file takes one table of counts; there are {names}", names=", ".join(count_tables()))
        if arguments.json:
            print_json([table.to_json(lang) for table in tables])
        else:
            headers = [translate("table", lang), translate("rows", lang), translate("content", lang)]
            rows = [(t.name, str(len(t.rows)), t.title.in_language(lang)) for t in tables]
            print_table(headers, rows, numbers=[1])
        return
    table = count_table(arguments.what)
    if is_table(path):
        parquet = path.suffix.lower() == ".parquet"
        write_file(path, table.parquet() if parquet else _csv(table, arguments.decimal_comma).encode(), lang)
    elif arguments.json:
        print_json(table.to_json(lang))
    else:
        _print(table, lang)


def _csv(table: CountTable, decimal_comma: bool) -> str:
    if not decimal_comma:
        return table.csv()
    return "".join(";".join(_cell(value, "de") for value in row) + "\n" for row in (table.columns, *table.rows))


def _cell(value: float | str, lang: str) -> str:
    return number(value, lang, ".17g") if isinstance(value, float) else str(value)


def _print(table: CountTable, lang: str) -> None:
    print_text(table.title.in_language(lang) + "\n")
    right = [k for k, column in enumerate(table.columns.values()) if column.type != "text"]
    print_table(list(table.columns), [[_cell(value, lang) for value in row] for row in table.rows], numbers=right)
    meanings = [f"{name}: {column.meaning.in_language(lang)}" for name, column in table.columns.items()]
    print_text("\n".join(["", *meanings, ""]))
    origin = {key: getattr(table, key) for key in ("method", "second_method", "command", "version", "seconds")}
    print_text(_ORIGIN.filled(**origin).in_language(lang))
