"""What stands in a catalog file: the records, their reading and their checking.

msgspec knows the shape of a record and refuses what does not fit it; a key that no record has is refused with the
nearest one that it has. What the shape cannot say (the chain is sound, the frame is one of its links) is checked
here, so that an entry is sound or does not exist.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Literal, TypeVar

import msgspec

from gruebler.chain import Chain
from gruebler.errors import CatalogError, ChainError, NotationError, PairError

__all__ = ["Case", "Claims", "Entry", "Exercise", "Group", "Text", "read_entry", "read_exercise"]


class Text(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A text in both languages."""

    en: str
    de: str

    def said(self, lang: str) -> str:
        """The text in one language."""
        return self.de if lang == "de" else self.en


class Group(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A smaller group of motions in which the count is right: its b, the count with it, and why."""

    b: int
    counted: int
    reason: Text


class Claims(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What the entry says of itself; everything but the reasons is derived again by `gruebler check`."""

    n: int | None = None
    g1: int | None = None
    g2: int | None = None
    g3: int | None = None
    g4: int | None = None
    g5: int | None = None
    counted: int | None = None
    mobility: int | None = None
    """What the machine really does where its special dimensions make it differ from the generic mobility."""
    reason: Text | None = None
    group: Group | None = None
    idle: tuple[str, ...] = ()


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One machine of the catalog."""

    id: str
    name: Text
    source: str
    joints: str
    links: dict[str, str]
    """Every link, the frame first, with its German name."""
    space: Literal["planar", "spherical", "spatial"] = "planar"
    figure_lost: bool = False
    """Whether the seeds' figure is lost, so that the structure is an assumption."""
    frame: str | None = None
    drives: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    remark: Text | None = None
    claims: Claims = Claims()

    def chain(self) -> Chain:
        """The chain of the entry, its links in the order of the file."""
        written = Chain.parse(self.joints, self.space)
        return Chain(written.joints, links=self.links, space=self.space)


class Case(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One chain of an exercise: a machine of the catalog, with what the exercise says of it."""

    id: str
    name: Text
    machine: str
    claims: Claims = Claims()


class Exercise(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One exercise of the seeds, the task in our own words."""

    id: str
    name: Text
    source: str
    task: Text
    cases: tuple[Case, ...]


Record = TypeVar("Record", Entry, Exercise)

_LARGEST = 1_000_000  # bytes of a catalog file; a chain of thousands of links fits


def read_entry(path: Path) -> Entry:
    """The machine in a TOML file; `CatalogError` names file and key of the first thing that does not fit."""
    entry = _read(path, Entry)
    _check(entry, path)
    return entry


def read_exercise(path: Path) -> Exercise:
    """The exercise in a TOML file; `CatalogError` as for `read_entry`."""
    return _read(path, Exercise)


def _read(path: Path, kind: type[Record]) -> Record:
    try:
        if path.stat().st_size > _LARGEST:
            raise CatalogError(f"{path}: larger than {_LARGEST:,} bytes; a catalog file holds one entry")
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise CatalogError(f"{path}: cannot be read ({error.strerror or error})") from None
    except UnicodeDecodeError:
        raise CatalogError(f"{path}: is not UTF-8 text") from None
    except RecursionError:
        raise CatalogError(f"{path}: is nested too deeply") from None
    except ValueError as error:  # TOMLDecodeError, or a number of thousands of digits
        raise CatalogError(f"{path}: is not TOML: {error}") from None
    _refuse_strange_keys(data, kind, path, "")
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        raise CatalogError(f"{path}: {_readable(str(error))}") from None


def _readable(message: str) -> str:
    """Msgspec's message with the path of the key in front: ``claims.n: expected int, got str``."""
    match = re.fullmatch(r"(.*?)(?: - at `\$\.?(.*)`)?", message, re.DOTALL)
    assert match is not None  # the second group is optional
    text = match[1].replace("`", "")
    text = text[:1].lower() + text[1:]
    return f"{match[2]}: {text}" if match[2] else text


def _refuse_strange_keys(data: Mapping[str, Any], kind: type[msgspec.Struct], path: Path, prefix: str) -> None:
    fields = {f.name: f.type for f in msgspec.structs.fields(kind)}
    for key, value in data.items():
        if key not in fields:
            close = get_close_matches(key, fields, n=1, cutoff=0.4)
            hint = f"did you mean {close[0]!r}?" if close else f"the keys here are {', '.join(fields)}"
            raise CatalogError(f"{path}: unknown key {prefix + key!r}; {hint}")
        for inner in _records_within(fields[key]):
            values = value if isinstance(value, list) else [value]
            for one in values:
                if isinstance(one, Mapping):
                    _refuse_strange_keys(one, inner, path, f"{prefix}{key}.")


def _records_within(annotation: Any) -> list[type[msgspec.Struct]]:
    if isinstance(annotation, type) and issubclass(annotation, msgspec.Struct):
        return [annotation]
    return [record for part in getattr(annotation, "__args__", ()) for record in _records_within(part)]


def _check(entry: Entry, path: Path) -> None:
    """What the shape of a record cannot say."""
    try:
        chain = entry.chain()
    except (ChainError, NotationError, PairError) as error:
        raise CatalogError(f"{path}: joints: {error}") from None
    for key, links in (
        ("frame", (entry.frame,) if entry.frame is not None else ()),
        ("outputs", entry.outputs),
        ("claims.idle", entry.claims.idle),
    ):
        for link in links:
            try:
                chain.index(link)
            except ChainError as error:
                raise CatalogError(f"{path}: {key}: {error}") from None
    for drive in entry.drives:
        if chain.find_joint(drive) is None:
            raise CatalogError(
                f"{path}: drives: {drive!r} is not one of the joints; they are {', '.join(chain.joint_names())}"
            )
