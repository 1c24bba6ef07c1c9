"""What stands in a catalog file: the records, their reading and their checking.

msgspec knows the shape of a record and refuses what does not fit it; a key that no record has is refused with the
nearest one that it has. What the shape cannot say (the chain is sound, the frame is one of its links) is checked
here, so that an entry is sound or does not exist.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import msgspec

from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import CatalogError, naming
from gruebler.base.text import LANGUAGES, Message, Text, message, translate
from gruebler.files.linkage_records import Dimensions, linkage_from_record
from gruebler.files.load_records import LoadsRecord
from gruebler.files.screws import ScrewsRecord, spatial_linkage_from_record
from gruebler.mechanics.linkages import Linkage, has_only_lower_pairs
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.chain.notation import renamed_links
from gruebler.structure.mechanism import Mechanism

if TYPE_CHECKING:
    from gruebler.mechanics.forces.loads import Loads

_SOURCE_WORDS = (
    message("sections"),
    message("section"),
    message("the first of two with this number"),
    message("first exercise"),
    message("second exercise"),
    message("exercise"),
    message("figure"),
    message("chapter"),
    message("variant of"),
    message("variant"),
    message("classification"),
    message("common machine, not in"),
    message("numeric checks, bevel differential"),
    message("and"),
)


def source_text(source: str | Text, lang: str) -> str:
    """Where something stands in the teaching documents.

    >>> source_text("000/003, sections 2.3 and 2.6", "de"), source_text("000, figure 6.12, variant", "de")
    ('000/003, Abschnitte 2.3 und 2.6', '000, Bild 6.12, Variante')
    """
    if isinstance(source, Text):
        return source.in_language(lang)
    for term in _SOURCE_WORDS:
        source = re.sub(rf"\b{term}\b", term.in_language(lang), source)
    return source


class ClaimedGroup(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A smaller group of motions in which the count is right: its b, the count with it, and why."""

    b: int
    counted: int
    reason: Text


MotionKind = Literal["turns", "swings", "slides", "parallel"]
"""It turns fully, swings, slides on the frame, or moves without turning."""


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
    group: ClaimedGroup | None = None
    idle: tuple[str, ...] = ()
    motion: dict[str, MotionKind] = {}
    """How links move against the frame, in a machine with dimensions and one drive."""
    travel: dict[str, float] = {}
    """How far links swing, in degrees, or slide, in the unit."""
    dead_centres: dict[str, tuple[float, ...]] = {}
    """The drive values at which links turn back, in degrees or the unit."""

    @property
    def says_motion(self) -> bool:
        """Whether it says anything of how the machine moves."""
        return bool(self.motion or self.travel or self.dead_centres)


MOTION_NUMBERS: Mapping[str, tuple[str, ...]] = {
    "straight": ("length", "band"),
    "swing": ("degrees",),
    "stroke": ("length",),
    "dwell": ("degrees",),
    "ratio": ("least", "greatest"),
    "turns": ("turns",),
}
"""The numbers that a claim of each kind states (`gruebler.teaching.catalog.motion_quantities` derives them)."""


class MotionQuantity(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What the entry says of its motion, with the numbers that `gruebler check` derives again from its dimensions."""

    kind: Literal["straight", "swing", "stroke", "dwell", "ratio", "turns"]
    of: str
    """A point or joint that runs straight; a link, or the joint of a slide, otherwise. In space a joint; of a link the
    ``swing`` is its largest turn away from the reference pose."""
    range: tuple[float, float] | None = None
    """Drive values in degrees or the unit; without them those of the dimensions, else a full turn."""
    drive: str | None = None
    """The drive that moves, where there are several; the others stand still in the reference pose. In space all move
    alike without it."""
    direction: float | tuple[float, float, float] | None = None
    """``straight``: of the line, ``stroke`` of a point: of the way, in degrees; 0 is level. In space a vector."""
    length: float | None = None
    """The way along the line, or along the slide."""
    band: float | None = None
    """How far the path leaves the line, from side to side: across ``direction``, else the narrowest."""
    degrees: float | None = None
    """``swing``: from one extreme of the link's angle to the other; ``dwell``: of the drive."""
    least: float | None = None
    greatest: float | None = None
    """Of the speed of a link in that of the drive (angles in radians)."""
    turns: float | None = None
    """How often the link turns, with its sign, while the drive runs through the range."""

    @property
    def numbers(self) -> dict[str, float | None]:
        """The numbers that it states."""
        return {key: getattr(self, key) for key in MOTION_NUMBERS[self.kind]}


class Sizes(Dimensions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Dimensions of an entry, as in the file of a linkage (`gruebler.files.linkages`), and where they come from."""

    assumed: bool = False
    """Whether the seeds print none, so that the dimensions are chosen here."""
    source: str | Text = ""
    """Where they are printed."""
    drive: str | tuple[str, ...] | None = None
    """The driven joint of the example, or several, where the machine itself names none."""
    range: tuple[float, float] | None = None
    """Drive values between which it moves, in degrees or in the unit."""
    stops: dict[str, tuple[float, float]] = msgspec.field(default_factory=dict)
    """Of several driven joints the least and the largest value each, such as lengths of cylinders."""

    @property
    def shown_drives(self) -> tuple[str, ...]:
        """The driven joints of the example; empty where the machine names its own."""
        return (self.drive,) if isinstance(self.drive, str) else self.drive or ()


class ReferenceScrews(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The joints of an entry in one position (`gruebler.files.screws`), and where their places come from."""

    unit: str
    joints: dict[str, Any]
    points: dict[str, Any] = {}
    round_bodies: dict[str, Any] = {}
    assumed: bool = False
    source: str = ""
    drive: str | tuple[str, ...] | None = None
    """The driven joints of the example, where the entry's own drives do not fix the motion."""
    range: tuple[float, float] | None = None
    """Drive values between which it moves, in degrees or in the unit."""

    @property
    def shown_drives(self) -> tuple[str, ...]:
        """The driven joints of the example; empty where the machine names its own."""
        return (self.drive,) if isinstance(self.drive, str) else self.drive or ()


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One machine of the catalog."""

    id: str
    name: Text
    source: str
    joints: str
    links: dict[str, str]
    """Every link, the frame first, with its German name."""
    points: dict[str, str] = {}
    """Named points whose name is a word, with the German one; a letter is the same in both languages."""
    letters: dict[str, dict[str, str]] = {}
    """By language what the named points are whose name is a letter."""
    space: Literal["planar", "spherical", "spatial"] = "planar"
    figure_lost: bool = False
    """Whether the seeds' figure is lost, so that the structure is an assumption."""
    frame: str | None = None
    drives: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    remark: Text | None = None
    claims: Claims = Claims()
    quantities: tuple[MotionQuantity, ...] = ()
    """What name and remark say of the motion, in numbers."""
    dimensions: Sizes | None = None
    loads: LoadsRecord | None = None
    """What acts on the machine, and its masses, as in the file of a linkage."""
    screws: ReferenceScrews | None = None
    """Where the joints lie in one position, for machines in space and for contacts: enough for their mobility."""
    picture: Dimensions | None = None
    """Places for a picture alone, of a machine in the plane that stands still or repeats itself."""

    def chain(self) -> Chain:
        """The chain of the entry, its links in the order of the file."""
        return _chain(self.joints, tuple(self.links), self.space)

    def linkage(self) -> Linkage:
        """The machine with its dimensions; `CatalogError` if the entry has none."""
        if self.dimensions is None:
            raise CatalogError("the catalog entry {id!r} has no dimensions", id=self.id)
        chain = self.chain()
        mechanism = Mechanism(chain, self.frame or chain.links[0], self.dimensions.shown_drives or self.drives)
        return linkage_from_record(self.dimensions, mechanism, self.outputs)

    def pictured(self) -> Linkage | None:
        """The machine standing still at the places of its picture, if it has any."""
        if self.picture is None:
            return None
        chain = self.chain()
        return linkage_from_record(self.picture, Mechanism(chain, self.frame or chain.links[0], ()), ())

    @property
    def between(self) -> tuple[float, float] | None:
        """The drive values between which the machine is shown: radians where the drive turns; None for all.

        >>> from gruebler.teaching.catalog import entry
        >>> [round(value, 6) for value in entry("crane").between]  # 60° to 80°
        [1.047198, 1.396263]
        """
        sizes = self.dimensions or self.screws
        linkage = self.placed() if self.dimensions is None else self.linkage()
        if sizes is None or linkage is None or sizes.range is None:
            return None
        low, high = sizes.range
        drives = linkage.mechanism.drives
        return (math.radians(low), math.radians(high)) if drives and drives[0].turning else (low, high)

    @property
    def stops(self) -> list[tuple[float, float] | None]:
        """By drives the least and the largest value of each, radians of what turns; None where none are known.

        Raises `CatalogError` for stops of a joint that is not driven.

        >>> from gruebler.teaching.catalog import entry
        >>> entry("excavator").stops[0]
        (240.0, 330.0)
        """
        if self.dimensions is None or not self.dimensions.stops:
            return []
        stops, drives = self.dimensions.stops, self.linkage().mechanism.drives
        names = self.chain().joint_names()
        if others := stops.keys() - {names[drive.joint] for drive in drives}:
            raise CatalogError("stops: no joint {joint!r} is driven", joint=min(others))
        known = [stops.get(names[drive.joint]) for drive in drives]
        return [
            ends and ((math.radians(ends[0]), math.radians(ends[1])) if drive.turning else ends)
            for drive, ends in zip(drives, known, strict=True)
        ]

    def loaded(self) -> tuple[Linkage, Loads, float | None]:
        """The machine, what acts on it, and the speed of its drive if one is usual.

        Raises `CatalogError` if the entry has no loads.

        >>> from gruebler.teaching.catalog import entry
        >>> linkage, loads, speed = entry("compressor").loaded()
        >>> sorted(loads.bodies)
        ['conrod', 'crank', 'piston']
        """
        if self.loads is None:
            raise CatalogError("the catalog entry {id!r} has no loads", id=self.id)
        from gruebler.files.load_reading import loads_from_json, usual_speed

        linkage, table = self.linkage(), msgspec.to_builtins(self.loads)
        drawn = self.dimensions is not None and self.dimensions.places is not None
        return linkage, loads_from_json(table, linkage, drawn=drawn), usual_speed(table, linkage)

    def in_language(self, lang: str) -> Entry:
        """The same entry, links and points by their names in a language; German links are short where that is clear.

        >>> from gruebler.teaching.catalog import entry
        >>> entry("lambda").in_language("de").drives
        ('R(Gestell-Kurbel)',)
        """
        if lang == LANGUAGES[0]:
            return self
        return _with_names(self, _short_names(self.link_names(lang), lang) | self.points)

    def link_names(self, lang: str) -> dict[str, str]:
        """What each link is called in a language, in full.

        >>> from gruebler.teaching.catalog import entry
        >>> entry("lambda").link_names("de")["coupler"]
        'Koppel mit Punkt C'
        >>> entry("lambda").link_names("en")["coupler"]
        'coupler'
        """
        return {link: link for link in self.links} if lang == LANGUAGES[0] else dict(self.links)

    @property
    def in_space(self) -> bool:
        """Whether it is a machine in space or on the sphere whose joints have places."""
        return self.screws is not None and self.space != "planar"

    def placed(self) -> Linkage | SpatialLinkage | None:
        """The machine with what dimensions it has: the screws of its joints, else the sizes of its links, else None."""
        if self.screws is not None:
            chain = self.chain()
            screws = ScrewsRecord(
                unit=self.screws.unit,
                joints=self.screws.joints,
                points=self.screws.points,
                round_bodies=self.screws.round_bodies,
            )
            drives = self.screws.shown_drives or self.drives
            mechanism = Mechanism(chain, self.frame or chain.links[0], drives)
            return spatial_linkage_from_record(screws, mechanism, self.outputs)
        linkage = None if self.dimensions is None else self.linkage()
        return linkage if linkage is not None and has_only_lower_pairs(linkage) else None


def _short_names(full: Mapping[str, str], lang: str) -> dict[str, str]:
    """Without "link" before a number, brackets, and what follows "with", if the names stay different."""
    left_out = rf"^{translate('link', lang)} (?=\d)| \(.*| {translate('with', lang)} .*"
    short = {link: re.sub(left_out, "", name) for link, name in full.items()}
    return short if len(set(short.values())) == len(short) else dict(full)


_NO_NUMBER = message("none")
_NAME_LINKS: Mapping[str, tuple[str, ...]] = {
    "dimensions": ("elements", "reference_pose", "places", "points", "outlines", "drive"),
    "screws": ("joints", "points", "round_bodies", "drive"),
    "picture": ("places", "outlines"),
    "claims": ("idle", "motion", "travel", "dead_centres"),
    "loads": ("bodies", "masses", "forces", "moments", "springs", "torsion_springs", "motors"),
}


def _renamed(value: Any, names: Mapping[str, str]) -> Any:
    """Plain data with these names of links and points wherever they stand in it."""
    if isinstance(value, str):
        return renamed_links(value, names)
    if isinstance(value, Mapping) and "at" in value:  # a wheel, cam or point with keys of its own
        return {key: _renamed(item, names) if key == "link" else item for key, item in value.items()}
    if isinstance(value, Mapping):
        return {_renamed(key, names): _renamed(item, names) for key, item in value.items()}
    return [_renamed(item, names) for item in value] if isinstance(value, list | tuple) else value


def _with_keys(table: Mapping[str, Any], keys: Iterable[str], names: Mapping[str, str]) -> dict[str, Any]:
    return {key: _renamed(value, names) if key in keys else value for key, value in table.items()}


def renamed_loads(table: Mapping[str, Any], names: Mapping[str, str]) -> dict[str, Any]:
    """The table ``[loads]`` with these names of links.

    >>> renamed_loads({"masses": {"bar:5,0": "1 kg"}, "speed": "60 rpm"}, {"bar": "beam"})
    {'masses': {'beam:5,0': '1 kg'}, 'speed': '60 rpm'}
    """
    return _with_keys(table, _NAME_LINKS["loads"], names)


def _with_names(entry: Entry, names: Mapping[str, str]) -> Entry:
    """The record with these names of its links and points wherever they stand in it."""
    plain = _with_keys(msgspec.to_builtins(entry), ("joints", "frame", "drives", "outputs"), names)
    for part, keys in _NAME_LINKS.items():
        if plain[part] is not None:
            plain[part] = _with_keys(plain[part], keys, names)
    plain["quantities"] = [_with_keys(claim, ("of", "drive"), names) for claim in plain["quantities"]]
    for key in ("links", "points"):
        plain[key] = {names[each]: name for each, name in plain[key].items()}
    return msgspec.convert(plain, Entry)


class Case(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One chain of an exercise: a machine of the catalog, with what the exercise says of it."""

    id: str
    name: Text
    machine: str
    claims: Claims = Claims()


class Question(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One thing that an exercise asks, and what is printed for it."""

    key: str
    """The key of the result in the solution."""
    printed: str | None = None
    """The printed answer digit for digit, such as ``66.4``; its last digit tells how exact it is. Or a word."""
    unit: str = ""
    """The unit of the printed number, where it is not that of the result."""
    reason: Text | None = None
    """Why the printed answer differs from the computed one, where it does."""


class Exercise(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One exercise or worked example, the task in our own words; the answer is computed when it is asked for."""

    id: str
    name: Text
    source: str
    task: Text
    cases: tuple[Case, ...] = ()
    method: str | None = None
    """What solves it, such as ``dead_centres.slider_crank`` (in the exercises); None: the cases are all."""
    given: dict[str, float | str] = {}
    """The given quantities, as the method names them; angles in degrees."""
    asked: tuple[Question, ...] = ()
    remark: Text | None = None


@lru_cache(maxsize=1024)  # each entry of the catalog asks some eight times
def _chain(joints: str, links: tuple[str, ...], space: str) -> Chain:
    return Chain(Chain.parse(joints, space=space).joints, links=links, space=space)


Record = TypeVar("Record", Entry, Exercise)


def read_entry(path: Path) -> Entry:
    """The machine in a TOML file; `CatalogError` names file and key of the first thing that does not fit."""
    entry = _read(path, Entry)
    _check(entry, path)
    return entry


def entry_of_data(data: object, where: str) -> Entry:
    """The machine of plain data, as ``gruebler catalog show --json`` prints it; ``where`` begins a `CatalogError`."""

    def fail(problem: Message) -> CatalogError:
        return CatalogError("{where}: {problem}", where=where, problem=problem)

    entry = convert_document(data, Entry, fail)
    _check(entry, where)
    return entry


def read_exercise(path: Path) -> Exercise:
    """The exercise in a TOML file; `CatalogError` as for `read_entry`."""
    return _read(path, Exercise)


def _read(path: Path, kind: type[Record]) -> Record:
    def fail(problem: Message) -> CatalogError:
        return CatalogError("{path}: {problem}", path=path, problem=problem)

    return convert_document(load_document(path, fail), kind, fail)


def _check(entry: Entry, path: Path | str) -> None:
    """What the shape of a record cannot say."""
    with naming(f"{path}: joints", CatalogError):
        chain = entry.chain()
    for key, names, number_of in (
        ("frame", (entry.frame,) if entry.frame is not None else (), chain.index),
        ("outputs", entry.outputs, chain.index),
        ("claims.idle", entry.claims.idle, chain.index),
        ("claims.motion", entry.claims.motion, chain.index),
        ("claims.travel", entry.claims.travel, chain.index),
        ("claims.dead_centres", entry.claims.dead_centres, chain.index),
        ("drives", entry.drives, chain.joint_number),
    ):
        for name in names:
            with naming(f"{path}: {key}", CatalogError):
                number_of(name)
    if entry.screws is not None:
        if entry.screws.assumed == bool(entry.screws.source):
            raise CatalogError("{path}: screws: either assumed = true, or a source that prints them", path=path)
        with naming(path, CatalogError):
            entry.placed()
            entry.pictured()
    known = {point for sizes in (entry.dimensions, entry.screws) if sizes is not None for point in sizes.points}
    for point in entry.points:
        if point not in known or point in entry.links:
            raise CatalogError("{path}: points: there is no point {point!r}", path=path, point=point)
    _check_loads(entry, path)
    if entry.dimensions is not None:
        _check_dimensions(entry, entry.dimensions, chain, path)
    sizes = entry.dimensions
    if entry.claims.says_motion and (sizes is None or len(sizes.shown_drives or entry.drives) != 1):
        raise CatalogError("{path}: claims.motion: needs dimensions and one drive", path=path)
    for number, claim in enumerate(entry.quantities, 1):
        _check_quantity(entry, claim, f"{path}: quantities {number}")


def _check_loads(entry: Entry, path: Path | str) -> None:
    if entry.loads is None:
        return
    if entry.loads.assumed == bool(entry.loads.source):
        raise CatalogError("{path}: {key}: either assumed = true, or a source that prints them", path=path, key="loads")
    with naming(path, CatalogError):
        entry.loaded()


_ALL_NUMBERS = tuple(dict.fromkeys(key for keys in MOTION_NUMBERS.values() for key in keys))


def _check_quantity(entry: Entry, claim: MotionQuantity, where: str) -> None:
    if entry.dimensions is None and entry.screws is None:
        raise CatalogError("{where}: an entry without dimensions has no motion to state", where=where)
    given = tuple(key for key in _ALL_NUMBERS if getattr(claim, key) is not None)
    if given != tuple(claim.numbers):
        raise CatalogError(
            "{where}: {kind} states {numbers}, but found {given}",
            where=where,
            kind=claim.kind,
            numbers=", ".join(claim.numbers),
            given=", ".join(given) or _NO_NUMBER,
        )
    if claim.range is not None and not -1e9 < claim.range[0] < claim.range[1] < 1e9:
        raise CatalogError("{where}: range: expected two numbers, the smaller first", where=where)


def _check_dimensions(entry: Entry, sizes: Sizes, chain: Chain, path: Path | str) -> None:
    if sizes.assumed == bool(sizes.source):
        raise CatalogError("{path}: dimensions: either assumed = true, or a source that prints them", path=path)
    if sizes.shown_drives and (entry.drives or any(chain.find_joint(drive) is None for drive in sizes.shown_drives)):
        raise CatalogError("{path}: dimensions.drive: for an entry without drives, one of its joints", path=path)
    if sizes.range is not None and not -1e9 < sizes.range[0] < sizes.range[1] < 1e9:
        raise CatalogError("{path}: dimensions.range: expected two numbers, the smaller first", path=path)
    with naming(f"{path}: dimensions", CatalogError):
        entry.linkage()
