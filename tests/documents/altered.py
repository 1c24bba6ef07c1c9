"""A copy of the catalog with something else in it, used by all loaders while a test lasts."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

from gruebler.teaching.catalog import catalog_folder, entries, exercises
from gruebler.teaching.exercises import all_exercises, solving
from gruebler.teaching.sheets import all_sheets

_LOADERS = ("gruebler.teaching.catalog.loader", "gruebler.teaching.exercises.loader", "gruebler.teaching.sheets.loader")
_CACHES = (entries, exercises, all_exercises, all_sheets, solving._solve)


@contextmanager
def altered_catalog(folder: Path, file: str, *changes: tuple[str, str]) -> Iterator[Path]:
    """The catalog copied into a folder, with other texts in one of its files; yields that file."""
    copied = folder / "catalogs"
    shutil.copytree(catalog_folder(), copied)
    path = copied / file
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, f"{file} has no {old!r}"
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    patches = [patch(f"{module}.catalog_folder", lambda: copied) for module in _LOADERS]
    for each in patches:
        each.start()
    _forget()
    try:
        yield path
    finally:
        for each in patches:
            each.stop()
        _forget()


def _forget() -> None:
    for each in _CACHES:
        each.cache_clear()
