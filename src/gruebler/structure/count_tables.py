"""The tables of docs/tables as data: what was counted, how, and how else.

Their columns, methods and second methods stand in ``schema.json``, command, version and seconds in ``records.json``.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Literal

import msgspec

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import LANGUAGES, Text
from gruebler.structure.atlas.schema import arrow_library

Value = int | float | str
_READERS: dict[str, Callable[[str], Value]] = {"integer": int, "number": float, "text": str}


class CountColumn(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What stands in a column of the tables."""

    type: Literal["integer", "number", "text"]
    meaning: Text

    def read(self, cell: str) -> Value:
        """The value of a cell of the file."""
        return _READERS[self.type](cell)


class _Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    title: Text
    columns: list[str]
    key: list[str]
    method: Text
    second_method: Text


class _Schema(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    columns: dict[str, CountColumn]
    tables: dict[str, _Entry]


class _Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    command: str
    version: str
    seconds: float
    sha256: str


class CountTable(msgspec.Struct, frozen=True, kw_only=True):
    """A table of numbers with what is needed to trust it, or to make it again."""

    name: str
    title: Text
    columns: dict[str, CountColumn]
    key: list[str]
    """The columns whose values no two rows share."""
    method: Text
    second_method: Text
    """What confirmed which of the numbers by another method, and what rests on one."""
    command: str
    """Makes the table again, in a source checkout."""
    version: str
    seconds: float
    """On two shared cores."""
    sha256: str
    """Of the CSV file."""

    @property
    def rows(self) -> list[tuple[Value, ...]]:
        """All rows, a value for each column."""
        _, *lines = csv.reader(io.StringIO(self.csv()))
        return [
            tuple(column.read(cell) for column, cell in zip(self.columns.values(), line, strict=True)) for line in lines
        ]

    def csv(self) -> str:
        """The file, with the names of the columns in its first line."""
        return (_folder() / f"{self.name}.csv").read_text(encoding="utf-8")

    def to_json(self, lang: str = "en") -> dict[str, Any]:
        """Plain data, with the rows as objects and the texts in one language."""
        columns = {n: {"type": c.type, "meaning": c.meaning.in_language(lang)} for n, c in self.columns.items()}
        return {
            "name": self.name,
            "title": self.title.in_language(lang),
            "columns": columns,
            "key": self.key,
            **self._origin(lang),
            "rows": [dict(zip(self.columns, row, strict=True)) for row in self.rows],
        }

    def parquet(self) -> bytes:
        """The content of a Parquet file; methods, command, version and seconds are its metadata.

        Raises `GrueblerError` without pyarrow.
        """
        pa = arrow_library()
        kinds = {"integer": pa.int64(), "number": pa.float64(), "text": pa.string()}
        fields = [pa.field(n, kinds[c.type], False, {"meaning": c.meaning.en}) for n, c in self.columns.items()]
        origin = {key: str(value) for key, value in {"title": self.title.en, **self._origin()}.items()}
        arrays = map(list, zip(*self.rows, strict=True))
        table = pa.Table.from_arrays(
            [pa.array(values, field.type) for values, field in zip(arrays, fields, strict=True)],
            schema=pa.schema(fields, origin),
        )
        stream = io.BytesIO()
        pa.parquet.write_table(table, stream)
        return stream.getvalue()

    def _origin(self, lang: str = LANGUAGES[0]) -> dict[str, str | float]:
        return {
            "method": self.method.in_language(lang),
            "second_method": self.second_method.in_language(lang),
            "command": self.command,
            "version": self.version,
            "seconds": self.seconds,
            "sha256": self.sha256,
        }


@cache
def count_tables() -> dict[str, CountTable]:
    """All tables by name.

    >>> list(count_tables())[:3]
    ['chains', 'fractionated', 'multiple_joints']
    """
    schema = msgspec.json.decode((_folder() / "schema.json").read_bytes(), type=_Schema)
    records = msgspec.json.decode((_folder() / "records.json").read_bytes(), type=dict[str, _Record])
    return {
        name: CountTable(
            name=name,
            title=entry.title,
            columns={column: schema.columns[column] for column in entry.columns},
            key=entry.key,
            method=entry.method,
            second_method=entry.second_method,
            **msgspec.structs.asdict(records[name]),
        )
        for name, entry in schema.tables.items()
    }


@door
def count_table(name: str) -> CountTable:
    """A table by its name.

    Args:
        name: such as ``"chains"``; `count_tables` has all.

    Returns:
        The table, with its method, second method, command, version and seconds.

    Raises:
        GrueblerError: no table has this name.

    Cost:
        Files of together 80 kB are read once.

    Example:
        >>> count_table("assur_groups").rows[:4]
        [(2, 1), (4, 2), (6, 10), (8, 173)]

    See Also:
        `gruebler.count_chains`, `gruebler.structure.atlas.open`

    Theory:
        docs/theory/enumeration.md
    """
    tables = count_tables()
    if name not in tables:
        raise GrueblerError(
            "there is no table of counts {word!r}{suggestion}; there are {known}", **unknown(name, tables)
        )
    return tables[name]


@cache
def _folder() -> Path:
    """Inside the installed package, or in docs of a source checkout."""
    package = Path(__file__).resolve().parents[1]
    for folder in (package / "tables", package.parents[1] / "docs" / "tables"):
        if folder.is_dir():
            return folder
    raise GrueblerError(
        "the tables are missing: neither {package} nor a source checkout has them", package=package / "tables"
    )
