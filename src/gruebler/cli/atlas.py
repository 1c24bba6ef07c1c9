"""`gruebler atlas`: chains and mechanisms with their properties in Parquet files, built and queried."""

from __future__ import annotations

import argparse
import csv
import io
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from gruebler.base.columns import FORMULA, harmless_cell
from gruebler.base.errors import GrueblerError, visible
from gruebler.base.text import message, plural
from gruebler.cli.executors import executor_of
from gruebler.cli.long_work import ask_before, run_progress
from gruebler.cli.output import print_json, say_written
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table

if TYPE_CHECKING:
    import pyarrow as pa

_CHAIN = 1e-4  # seconds to describe a chain of simple joints, its files included
_COMPOSED = 1e-2  # one with multiple or sliding joints, or a fractionated one
_BULK = 2e-5  # for each link of a chain with F = 1, and each drive at it
_MECHANISM = 2e-3  # for each link of a chain
_DRIVEN = 1e-2  # for each joint and frame


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="All chains and mechanisms with their properties, in Parquet files. The atlas that comes with the "
        "library has all chains to 10 links. pip install 'gruebler[atlas]' brings what this needs.",
        epilog='Examples: gruebler atlas query "select code from chains where links = 10 and not planar"; '
        "gruebler atlas build --links 4-14 atlas14; gruebler atlas columns",
    )
    build = parser.add_command(
        "build",
        help="write all chains of some sizes with their properties into a folder",
        epilog="A build can be stopped at any time; the same command continues it, and the files are the same.",
    )
    build.take(
        """
        directory DIR path  a folder of its own
        --links N !  number of links, or a range such as 4-10
        --mobility F =1  mobility, or a range (default: 1)
        --fractionated {none,link,joint,all} ? :all =none  as for gruebler enumerate (default: none)
        --multiple-joints K|any ? :any =0  as for gruebler enumerate (default: 0)
        --prismatic K =0  number of sliding joints, or a range (default: 0)
        --inversions  also the mechanisms: each chain with each frame
        --drives {frame,any} ? :frame =none  also the driven mechanisms with their Assur groups: drives at the frame, or
            any drives
        --jobs
        --scheduler
        --yes
        """
    )
    query = parser.add_command("query", help="answer a query in SQL")
    query.add_argument(
        "words", nargs="+", metavar="[DIR] SQL", help="the folder of an atlas (default: the small one), and the query"
    )
    query.take(
        """
        --structures  print each row as a chain or mechanism that other commands read; the query selects code, or chain
            and frame, perhaps drives
        """
    )
    columns = parser.add_command("columns", help="list the columns of all tables, with their units and definitions")
    for action in (query, columns):
        action.add_json(help="print JSON")
        action.add_out(
            help="write into a file instead: .txt, .json, .csv or .parquet", endings=("txt", "json", "csv", "parquet")
        )


def run(arguments: argparse.Namespace) -> int:
    """Build, query or explain."""
    match arguments.action:
        case "build":
            return _build(arguments)
        case "query":
            return _query(arguments)
    return _columns(arguments)


def _build(arguments: argparse.Namespace) -> int:
    from gruebler.structure.atlas import AtlasTask, build

    task = AtlasTask(
        links=arguments.links,
        mobility=arguments.mobility,
        fractionated=arguments.fractionated,
        multiple_joints=str(arguments.multiple_joints),
        prismatic=arguments.prismatic,
        inversions=arguments.inversions,
        drives=arguments.drives,
    )
    chains, seconds = _expected(task)
    ask_before(seconds / max(arguments.jobs, 1), arguments.yes)
    with run_progress(arguments.lang) as draw:
        manifest = build(task, arguments.directory, executor=executor_of(arguments), progress=draw, expected=chains)
    rows = manifest["tables"]["chains"]["rows"]
    say_written(
        arguments.directory, arguments.lang, ", " + plural("{count} chain", "{count} chains", rows, arguments.lang)
    )
    return 0


def _expected(task: Any) -> tuple[int, float]:
    """About how many chains a task has, and how many seconds it takes."""
    from gruebler.structure.enumeration.assortment import joint_count
    from gruebler.structure.enumeration.estimates import expected_chains
    from gruebler.structure.enumeration.pieces import refuse_too_large

    chains, seconds = 0, 0.0
    for request in task.requests():
        refuse_too_large(request.links, request.mobility)
        number = expected_chains(request)[0]
        joints = joint_count(request.links, request.mobility) or 0
        sliding = sum(request.links**k for k in task.sliding if k <= joints)
        chains += number * sliding
        plain = request.only_simple and request.fractionated == "none" and sliding == 1
        each = _CHAIN if plain else _COMPOSED
        if plain and request.mobility == 1 and task.drives != "any":
            each += _BULK * request.links * (1 + 2 * (task.drives == "frame"))
        else:
            each += _MECHANISM * request.links * task.inversions
            drives = {"none": 0, "frame": 2, "any": request.links}[task.drives]
            each += _DRIVEN * request.links * drives**request.mobility
        seconds += number * sliding * each
    return chains, seconds


def _query(arguments: argparse.Namespace) -> int:
    from gruebler.structure.atlas import open as open_atlas

    *folder, sql = arguments.words
    if len(folder) > 1:
        raise GrueblerError("expected a folder and a query; put the query in quotes")
    atlas = open_atlas(*folder)
    if arguments.structures:
        texts = [str(each) for each in atlas.structures(sql)]
        from gruebler.structure.atlas.schema import arrow_library

        _answer(arrow_library().table({"structure": texts}), arguments)
    else:
        _answer(atlas.query(sql), arguments)
    return 0


_HEADS = (
    message("table"),
    message("name"),
    message("type"),
    message("unit"),
    message("definition"),
    message("origin"),
)


_WORDS = {
    str(word): word
    for word in (
        message("links"),
        message("joints"),
        message("loops"),
        message("freedoms"),
        message("crossings"),
        message("request"),
        message("the chain"),
        message("table chains"),
    )
}
"""Units and origins of columns; other origins are names in the code."""


def _columns(arguments: argparse.Namespace) -> int:
    from gruebler.structure.atlas import columns_of
    from gruebler.structure.atlas.schema import TABLES, arrow_library

    rows = [
        {field.name: getattr(column, field.name) for field in fields(column)}
        | {"definition": column.definition.in_language(arguments.lang)}
        for table in TABLES
        for column in columns_of(table)
    ]
    if arguments.out is None and not arguments.json:
        heads = [head.in_language(arguments.lang) for head in _HEADS]
        spoken = [
            [_in_words(value, arguments.lang) if key in ("unit", "origin") else value for key, value in row.items()]
            for row in rows
        ]
        print_table(heads, spoken)
        return 0
    _answer(arrow_library().Table.from_pylist(rows), arguments)
    return 0


def _in_words(value: str, lang: str) -> str:
    return _WORDS[value].in_language(lang) if value in _WORDS else value


def _answer(table: pa.Table, arguments: argparse.Namespace) -> None:
    """Print a table, or write it into the file of `-o`."""
    from gruebler.base.atomic_files import atomic_file

    if arguments.out is None:
        if arguments.json:
            print_json(table.to_pylist())
        else:
            _print(table)
        return
    with atomic_file(arguments.out, durable=False) as file:
        match arguments.out.suffix.lower():
            case ".parquet":
                from gruebler.structure.atlas.schema import arrow_library

                arrow_library().parquet.write_table(table, file, compression="zstd")
            case ".json":
                import json

                file.write((json.dumps(table.to_pylist(), indent=2, default=str) + "\n").encode())
            case ending:
                sheet = ending == ".csv"
                quoted = sheet or table.num_columns > 1
                if quoted:
                    header = [harmless_cell(name) for name in table.column_names] if sheet else table.column_names
                    file.write(_csv([header]).encode())
                for lines in _lines(table, quoted=quoted, sheet=sheet):
                    file.write(lines.encode())
    rows = plural("{count} row", "{count} rows", table.num_rows, arguments.lang)
    say_written(arguments.out, arguments.lang, f", {rows}")


def _print(table: pa.Table) -> None:
    """A table; a single column without its name, so that other commands read it: gruebler gallery -."""
    if table.num_columns == 1:
        sys.stdout.writelines(visible(lines, keep="\n") for lines in _lines(table, quoted=False))
        return
    from gruebler.structure.atlas.schema import arrow_library

    types = arrow_library().types
    numbers = [
        k for k, field in enumerate(table.schema) if types.is_integer(field.type) or types.is_floating(field.type)
    ]
    print_table(table.column_names, list(zip(*_cells(table), strict=True)), numbers=numbers)


def _lines(table: pa.Table, *, quoted: bool, sheet: bool = False) -> Iterator[str]:
    """The rows as text, many at a time: cells with commas between them, quoted where CSV demands it.

    For a sheet, texts that it would take for formulas are made harmless; numbers are not changed.
    """
    from gruebler.structure.atlas.schema import arrow_library

    pa = arrow_library()
    special = '[",\r\n]' if table.num_columns > 1 else '^$|[",\r\n]'
    for batch in filter(len, table.to_batches(max_chunksize=1 << 18)):
        texts = [_texts(column) for column in batch.columns]
        if sheet:
            numeric = [pa.types.is_integer(c.type) or pa.types.is_floating(c.type) for c in batch.columns]
            texts = [
                each if number else pa.compute.replace_substring_regex(each, FORMULA, r"'\1")
                for each, number in zip(texts, numeric, strict=True)
            ]
        if quoted and any(pa.compute.any(pa.compute.match_substring_regex(each, special)).as_py() for each in texts):
            yield _csv(zip(*(each.to_pylist() for each in texts), strict=True))
            continue
        rows = pa.compute.binary_join_element_wise(*texts, pa.scalar(",", pa.string()))
        whole = pa.ListArray.from_arrays([0, len(rows)], rows)
        yield pa.compute.binary_join(whole, "\n")[0].as_py() + "\n"


def _csv(rows: Iterable[Sequence[str]]) -> str:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def _cells(table: pa.Table) -> list[list[str]]:
    """The values of each column as text."""
    return [[text for chunk in column.chunks for text in _texts(chunk).to_pylist()] for column in table.columns]


def _texts(column: pa.Array) -> pa.Array:
    """The values of a column as text, nothing for null; without Python objects for the types of an atlas."""
    from gruebler.structure.atlas.schema import arrow_library

    pa = arrow_library()
    types, kind = pa.types, column.type
    if types.is_list(kind) and not column.flatten().null_count:
        items = kind.value_type
        if types.is_integer(items) or types.is_string(items):
            column = pa.compute.binary_join(column.cast(pa.list_(pa.string())), " ")
            kind = column.type
    if types.is_integer(kind) or types.is_boolean(kind) or types.is_string(kind):
        return column.cast(pa.string()).fill_null("")
    return pa.array(map(_cell, column.to_pylist()), pa.string())


def _cell(value: Any) -> str:
    if isinstance(value, list):
        return " ".join(map(_cell, value))
    return "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)
