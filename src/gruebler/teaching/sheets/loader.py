"""The collection sheets of the library."""

from __future__ import annotations

from functools import cache

from gruebler.base.errors import CatalogError, nearest
from gruebler.teaching.catalog import catalog_folder
from gruebler.teaching.sheets.model import Sheet
from gruebler.teaching.sheets.records import read_sheet


@cache
def sheets() -> dict[str, Sheet]:
    """All sheets by id, in alphabetical order.

    >>> sheets()["mzc"].features.drive_joints
    1
    """
    records = {}
    for path in sorted((catalog_folder() / "sheets").glob("*.toml")):
        record = read_sheet(path)
        if record.id != path.stem:
            raise CatalogError(
                "{path}: id: {id!r} should be the name of the file, {stem!r}", path=path, id=record.id, stem=path.stem
            )
        records[record.id] = Sheet(record)
    return records


def sheet(id: str) -> Sheet:
    """The sheet of this id; `CatalogError` with the nearest one for any other word."""
    if id not in sheets():
        raise CatalogError(
            "there is no sheet {id!r}{suggestion}; known are {sheets}",
            id=id,
            suggestion=nearest(id, sheets()),
            sheets=", ".join(sheets()),
        )
    return sheets()[id]
