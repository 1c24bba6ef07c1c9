"""Tables of numbers: named columns with units, as text or CSV."""

from __future__ import annotations

import csv
import io
import re
from abc import ABC
from collections.abc import Iterable, Iterator
from dataclasses import KW_ONLY, dataclass, replace
from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base import notebook
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.notebook import ROWS_SHOWN, brief, html_table, text_table
from gruebler.base.plain_data import plain
from gruebler.base.text import number

FORMULA = r"^([=+\-@\t\r\n])"
"""How a text begins that a spreadsheet takes for a formula."""


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Column:
    """A quantity over the rows of a table."""

    name: str
    _: KW_ONLY
    unit: str
    values: Reals
    """(rows,); NaN where it is not defined."""
    natural: float = 0.0
    """What such a quantity usually is."""
    noise: float = 1e-12
    """The part of the largest or usual value that rounding can make."""

    @property
    def header(self) -> str:
        """Name and unit.

        >>> Column("torque", unit="N·mm", values=np.zeros(1)).header
        'torque [N·mm]'
        """
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    def without(self, rows: int) -> Column:
        """The column without its first rows."""
        return replace(self, values=self.values[rows:])


@brief
@dataclass(frozen=True, repr=False)
class Table:
    """Columns over the same rows."""

    columns: tuple[Column, ...]

    def __iter__(self) -> Iterator[Column]:
        return iter(self.columns)

    def __len__(self) -> int:
        """How many rows there are."""
        return len(self.columns[0].values) if self.columns else 0

    def __getitem__(self, name: str) -> Reals:
        """The values of a column, (rows,); `GrueblerError` with the nearest name if there is none."""
        for column in self.columns:
            if column.name == name:
                return column.values
        names = [column.name for column in self.columns]
        raise GrueblerError("the table has no column {word!r}{suggestion}; it has {known}", **unknown(name, names))

    @property
    def rows(self) -> Reals:
        """All values; (rows, columns)."""
        return np.column_stack([np.empty((len(self), 0)), *(column.values for column in self.columns)])

    def without(self, rows: int) -> Table:
        """The table without its first rows."""
        return Table(tuple(column.without(rows) for column in self.columns))

    def to_json(self) -> dict[str, Any]:
        """Name and unit of the columns, and the rows; null where a quantity is not defined or infinite.

        >>> Table((Column("s", unit="mm", values=np.array([1.5, np.nan])),)).to_json()
        {'columns': [{'name': 's', 'unit': 'mm'}], 'rows': [[1.5], [None]]}
        >>> Table(()).to_json()
        {'columns': [], 'rows': []}
        """
        rows = [[value if np.isfinite(value) else None for value in row] for row in self.rows.tolist()]
        return {"columns": plain([*self.columns], "name unit"), "rows": rows}

    def csv(self, *, decimal_comma: bool = False) -> str:
        """The table as CSV, with units in its header; with decimal commas for spreadsheets, then ; between cells."""
        return as_csv(self.columns, decimal_comma=decimal_comma)

    def structured(self) -> NDArray[np.void]:
        """A structured array, (rows,), of floats; its fields are the headers, with units.

        >>> Table((Column("s", unit="mm", values=np.array([1.0, 2.0])),)).structured()["s [mm]"]
        array([1., 2.])
        """
        headers = self._headers()
        records = np.empty(len(self), [(header, np.float64) for header in headers])
        for header, column in zip(headers, self.columns, strict=True):
            records[header] = column.values
        return records

    def to_dataframe(self) -> Any:
        """A `pandas.DataFrame` whose columns are the headers, with units; `GrueblerError` without pandas."""
        try:
            import pandas
        except ImportError:
            raise GrueblerError("a DataFrame needs pandas: pip install pandas") from None
        return pandas.DataFrame(self.structured())

    def arrow(self) -> Any:
        """A `pyarrow.Table`: columns by their headers, null where a quantity is not defined, name and unit as metadata.

        Raises `GrueblerError` without pyarrow.
        """
        try:
            import pyarrow
        except ImportError:
            raise GrueblerError('Arrow and Parquet need pyarrow: pip install "gruebler[atlas]"') from None
        fields = [
            pyarrow.field(header, pyarrow.float64(), metadata={"name": column.name, "unit": column.unit})
            for header, column in zip(self._headers(), self.columns, strict=True)
        ]
        arrays = [pyarrow.array(column.values, from_pandas=True) for column in self.columns]
        return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields))

    def parquet(self) -> bytes:
        """The content of a Parquet file of the table (`arrow`); `GrueblerError` without pyarrow."""
        table = self.arrow()
        from pyarrow.parquet import write_table

        stream = io.BytesIO()
        write_table(table, stream)
        return stream.getvalue()

    def _headers(self) -> list[str]:
        """The headers, a number behind one that comes again."""
        headers: list[str] = []
        for column in self.columns:
            header = column.header
            for k in count(2):
                if header not in headers:
                    break
                header = f"{column.header} ({k})"
            headers.append(header)
        return headers

    def __str__(self) -> str:
        """The first rows, for readers.

        >>> ways = Column("s", unit="mm", values=np.array([1.0, 2.5]))
        >>> print(Table((ways, Column("F", unit="N", values=np.array([np.nan, 7.0])))))
        s [mm]  F [N]
        1       –
        2.5     7
        """
        return text_table(*self._shown(), len(self))

    def _repr_html_(self) -> str:
        """The first rows, for notebooks."""
        return html_table(*self._shown(), len(self))

    def _shown(self) -> tuple[list[str], list[list[str]]]:
        """Headers and the first rows."""
        rows = shown(
            Column(c.name, unit=c.unit, values=c.values[:ROWS_SHOWN], natural=c.natural, noise=c.noise)
            for c in self.columns
        )
        return [column.header for column in self.columns], rows


class Tabled(ABC):  # noqa: B024 -- what it has is the same for all
    """A value over rows that has a table."""

    def table(self, *, lang: str = "en") -> Table:
        """All its columns with their units, the headers in English or German (``de``)."""
        assert notebook.table_of is not None  # set by the front door
        table: Table = notebook.table_of(self, lang=lang)
        return table

    def to_dataframe(self) -> Any:
        """The `table` as a `pandas.DataFrame`; needs pandas."""
        return self.table().to_dataframe()


def shown(columns: Iterable[Column], lang: str = "en") -> list[list[str]]:
    """The rows as texts of four digits (`text.number`), noise as 0, an infinite value as ∞, a missing one as –.

    >>> shown([Column("x", unit="", values=np.array([1.5, 1e-15, np.nan]))], "de")
    [['1,5'], ['0'], ['–']]
    """
    cells = []
    for column in columns:
        finite = np.abs(column.values[np.isfinite(column.values)])
        noise = column.noise * max(finite.max(initial=0.0), column.natural)
        values = np.where(np.abs(column.values) <= noise, 0.0, column.values)
        cells.append([_cell(value, lang) for value in values])
    return [list(row) for row in zip(*cells, strict=True)]


def _cell(value: float, lang: str) -> str:
    if np.isfinite(value):
        return number(value + 0.0, lang, "n")
    return "∞" if np.isinf(value) else "–"


def harmless_cell(text: str) -> str:
    """A text with an apostrophe in front if a spreadsheet would take it for a formula.

    >>> harmless_cell("=1+1"), harmless_cell("crank")
    ("'=1+1", 'crank')
    """
    return "'" + text if re.match(FORMULA, text) else text


def as_csv(columns: Iterable[Column], *, decimal_comma: bool = False) -> str:
    r"""A table with the units in its header; an empty cell where a quantity is not defined.

    Headers that begin with = + - @, a tab or a line end get an apostrophe in front, so that no spreadsheet takes the
    name of a point for a formula. Numbers stay as they are.

    Args:
        columns: Of the same rows.
        decimal_comma: Numbers with decimal commas and cells between semicolons, as spreadsheets expect them where the
            comma is the decimal sign.

    >>> x = Column("x", unit="mm", values=np.array([1.5]))
    >>> as_csv([x, Column("y", unit="mm", values=np.array([np.nan]))], decimal_comma=True)
    'x [mm];y [mm]\r\n1,5;\r\n'
    """
    columns = list(columns)
    text = io.StringIO()
    writer = csv.writer(text, delimiter=";" if decimal_comma else ",")
    headers = [column.header for column in columns]
    writer.writerow([harmless_cell(header) for header in headers])
    for row in zip(*(column.values for column in columns), strict=True):
        cells = [repr(float(value)) if np.isfinite(value) else "" for value in row]
        writer.writerow([cell.replace(".", ",") for cell in cells] if decimal_comma else cells)
    return text.getvalue()
