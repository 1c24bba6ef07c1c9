"""What stands in a catalog file: the records, their reading and their checking.

msgspec knows the shape of a record and refuses what does not fit it; a key that no record has is refused with the
nearest one that it has. What the shape cannot say (the chain is sound, the frame is one of its links) is checked
here, so that an entry is sound or does not exist.
"""

from __future__ import annotations

from pathlib import Path
from typing import Literal, TypeVar

import msgspec

from gruebler.chain import Chain
from gruebler.errors import CatalogError, ChainError, GrueblerError, NotationError, PairError
from gruebler.linkages import Linkage
from gruebler.linkages.documents import fitted, load
from gruebler.linkages.records import Dimensions, dimensioned
from gruebler.mechanism import Mechanism

__all__ = ["Case", "Claims", "Entry", "Exercise", "Group", "Sizes", "Text", "read_entry", "read_exercise"]


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


class Sizes(Dimensions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Dimensions of an entry, as in the file of a linkage (`gruebler.linkages.files`), and where they come from."""

    assumed: bool = False
    """Whether the seeds print none, so that the dimensions are chosen here."""
    source: str = ""
    """Where they are printed."""
    drive: str | None = None
    """The driven joint of the example, where the machine itself names none."""
    range: tuple[float, float] | None = None
    """Drive values between which it moves, in degrees or in the unit."""


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
    dimensions: Sizes | None = None

    def chain(self) -> Chain:
        """The chain of the entry, its links in the order of the file."""
        written = Chain.parse(self.joints, self.space)
        return Chain(written.joints, links=self.links, space=self.space)

    def linkage(self) -> Linkage:
        """The machine with its dimensions; `CatalogError` if the entry has none."""
        if self.dimensions is None:
            raise CatalogError(f"the catalog entry {self.id!r} has no dimensions")
        chain = self.chain()
        drives = (self.dimensions.drive,) if self.dimensions.drive is not None else self.drives
        mechanism = Mechanism(chain, self.frame or chain.links[0], drives)
        return dimensioned(self.dimensions, mechanism, self.outputs)


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


def read_entry(path: Path) -> Entry:
    """The machine in a TOML file; `CatalogError` names file and key of the first thing that does not fit."""
    entry = _read(path, Entry)
    _check(entry, path)
    return entry


def read_exercise(path: Path) -> Exercise:
    """The exercise in a TOML file; `CatalogError` as for `read_entry`."""
    return _read(path, Exercise)


def _read(path: Path, kind: type[Record]) -> Record:
    def fail(text: str) -> CatalogError:
        return CatalogError(f"{path}: {text}")

    return fitted(load(path, fail), kind, fail)


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
    if entry.dimensions is not None:
        _check_dimensions(entry, entry.dimensions, chain, path)


def _check_dimensions(entry: Entry, sizes: Sizes, chain: Chain, path: Path) -> None:
    if sizes.assumed == bool(sizes.source):
        raise CatalogError(f"{path}: dimensions: either assumed = true, or a source that prints them")
    if sizes.drive is not None and (entry.drives or chain.find_joint(sizes.drive) is None):
        raise CatalogError(f"{path}: dimensions.drive: for an entry without drives, one of its joints")
    if sizes.range is not None and not -1e9 < sizes.range[0] < sizes.range[1] < 1e9:
        raise CatalogError(f"{path}: dimensions.range: expected two numbers, the smaller first")
    try:
        entry.linkage()
    except GrueblerError as error:
        raise CatalogError(f"{path}: dimensions: {error}") from None
