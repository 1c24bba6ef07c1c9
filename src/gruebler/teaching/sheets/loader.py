"""The collection sheets of the library."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from gruebler.base.errors import CatalogError, unknown
from gruebler.teaching.catalog import catalog_folder
from gruebler.teaching.catalog.record_folders import RecordFolder
from gruebler.teaching.sheets.model import Sheet
from gruebler.teaching.sheets.records import read_sheet


@cache
def all_sheets() -> Mapping[str, Sheet]:
    """All sheets by id, in alphabetical order.

    >>> all_sheets()["mzc"].features.drive_joints
    1
    """
    return {id: Sheet(record) for id, record in RecordFolder(catalog_folder() / "sheets", read_sheet).items()}


def sheet(id: str) -> Sheet:
    """The sheet of this id; `CatalogError` with the nearest one for any other word."""
    if id not in all_sheets():
        raise CatalogError("there is no sheet {word!r}{suggestion}; known are {known}", **unknown(id, all_sheets()))
    return all_sheets()[id]
