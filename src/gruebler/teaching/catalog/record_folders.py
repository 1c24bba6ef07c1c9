"""The records in a folder of the catalog by their ids, each read when it is first asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import wraps
from pathlib import Path
from typing import Protocol, TypeVar, final

from gruebler.base.errors import CatalogError


class _Named(Protocol):
    @property
    def id(self) -> str: ...


Record = TypeVar("Record", bound=_Named)


Told = TypeVar("Told")


def told_once(tell: Callable[[Record], Told]) -> Callable[[Record], Told]:
    """What a function tells of a record, found once: records do not change, and those of a folder are kept."""
    known: dict[int, tuple[Record, Told]] = {}  # with the record, so that its id stays its own

    @wraps(tell)
    def found(record: Record) -> Told:
        if id(record) not in known:
            known[id(record)] = (record, tell(record))
        return known[id(record)][1]

    return found


@final
class RecordFolder(Mapping[str, Record]):
    """The records of the TOML files in a folder, in alphabetical order; each file is named as the id in it.

    Which ids there are is known at once; a file is read when its record is asked for, and only then. Whoever wants
    one machine does not wait for all, nor for an error in another file.
    """

    def __init__(self, folder: Path, read: Callable[[Path], Record]) -> None:
        self._paths = {path.stem: path for path in sorted(folder.glob("*.toml"))}
        self._read = read
        self._records: dict[str, Record] = {}

    def __getitem__(self, id: str) -> Record:
        if id not in self._records:
            path = self._paths[id]
            record = self._read(path)
            if record.id != id:
                raise CatalogError(
                    "{path}: id: {id!r} should be the name of the file, {stem!r}", path=path, id=record.id, stem=id
                )
            self._records[id] = record
        return self._records[id]

    def __contains__(self, id: object) -> bool:
        return id in self._paths

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)
