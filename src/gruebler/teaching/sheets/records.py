"""The file of a collection sheet: texts, exact dimensions, printed values, and the derivation of each."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import msgspec

from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import CatalogError, GrueblerError
from gruebler.base.text import Message, Text, message
from gruebler.teaching.catalog import entry
from gruebler.teaching.sheets.expressions import Expression


class Dimension(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A length of the mechanism."""

    symbol: str
    of: tuple[str, str]
    """Two of the sheet's names, on one link."""
    value: str
    """An exact expression, with the sheet's scale as unit."""


class CognateLength(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A length of a cognate: of the second or the third, a to d."""

    number: Literal[2, 3]
    length: Literal["a", "b", "c", "d"]


class RockerValue(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A value of the double rocker with contact in six points that has this lambda, the diameter D being 1."""

    ratio: str
    """Lambda, an exact expression."""
    value: Literal["phi0", "sin_phi0", "l1", "l2", "l4", "k", "tan_kappa", "k_by_cognate"]


class Quantity(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A value of the sheet, with one of six derivations."""

    id: str
    symbol: str
    name: Text
    angle: tuple[str, str, str] | None = None
    """The angle at the second of three names, from the first to the third, in degrees."""
    cosine: tuple[str, str, str] | None = None
    """Its cosine."""
    distance: tuple[str, str] | None = None
    contact_at: float | None = None
    """Points in common with the tangent, at this drive value."""
    cognate: CognateLength | None = None
    rocker: RockerValue | None = None
    at: float = 0.0
    """The drive value, in degrees."""
    less_at: float | None = None
    """A drive value whose value of the quantity is subtracted."""
    value: str | None = None
    """The exact expression."""
    printed: str | None = None
    """The printed value of the source: an expression, or a decimal number."""
    reason: Text | None = None
    """The reason for a wrong printed value."""
    remark: Text | None = None
    """A remark about a right printed value."""
    unit: str = ""


class Guide(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The straight part of the path (drive values in degrees), and a sizing task."""

    centre: float
    start: float
    end: float
    length: float
    tolerance: float
    unit: str
    printed: dict[str, str] = {}
    """The printed values of phi_G, phi_A, ratio and scale."""


class SheetPicture(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The picture to scale."""

    pose: float
    """The drive value, in degrees."""
    axis_through: str | None = None
    """A frame joint on the axis of symmetry of the path, if it has one."""
    marks: dict[str, float] = {}
    """Names for the point at drive values in degrees."""


class SheetRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One collection sheet."""

    id: str
    machine: str
    """The catalog entry that has structure and dimensions."""
    source: Text
    title: Text
    tasks: tuple[Text, ...]
    point: str
    scale: tuple[str, str]
    """The length that is the sheet's unit."""
    names: dict[str, str]
    """The sheet's names of joints and points."""
    picture: SheetPicture
    guide: Guide
    dimensions: tuple[Dimension, ...]
    quantities: tuple[Quantity, ...] = ()
    explanation: tuple[Text, ...] = ()
    """Text with ``{id:.3f}`` for derived values, and ``{id}`` for exact ones."""
    literature: tuple[str, ...] = ()


_LONGEST = 1e9
_TURNS = 3600.0
_PRINTED = ("phi_G", "phi_A", "ratio", "scale")
_DERIVATIONS = ("angle", "cosine", "distance", "contact_at", "cognate", "rocker")


def read_sheet(path: Path) -> SheetRecord:
    """The sheet in a TOML file; `CatalogError` names file and key of the first fault."""

    def fail(problem: Message) -> CatalogError:
        return CatalogError("{path}: {problem}", path=path, problem=problem)

    record = convert_document(load_document(path, fail), SheetRecord, fail)
    for wrong in _faults(record):
        raise fail(wrong)
    return record


def _faults(record: SheetRecord) -> Iterator[Message]:
    """The faults that the types of a record do not detect."""
    named: list[tuple[str, tuple[str, ...]]] = [
        ("scale", record.scale),
        *((f"dimensions {d.symbol}", d.of) for d in record.dimensions),
    ]
    if record.picture.axis_through is not None:
        named.append(("picture.axis_through", (record.picture.axis_through,)))
    for quantity in record.quantities:
        derivations = [derivation for derivation in _DERIVATIONS if getattr(quantity, derivation) is not None]
        if len(derivations) != 1:
            yield message(
                "quantities {quantity}: expected one of {known}, but found {count}",
                quantity=quantity.id,
                known=", ".join(_DERIVATIONS),
                count=len(derivations),
            )
        if derivations[0] in ("angle", "cosine", "distance"):
            named.append((f"quantities {quantity.id}", getattr(quantity, derivations[0])))
    named.append(("point", (record.point,)))
    for where, names in named:
        for name in names:
            if name not in record.names:
                yield message(
                    "{where}: {name!r} is none of the names {known}",
                    where=where,
                    name=name,
                    known=", ".join(record.names),
                )
        if len(set(names)) < len(names):
            yield message("{where}: expected different names, but found {names}", where=where, names=", ".join(names))
    ids = [quantity.id for quantity in record.quantities]
    yield from (message("quantities {id}: this id is given twice", id=id) for id in ids if ids.count(id) > 1)
    yield from _wrong_numbers(record)
    yield from _wrong_places(record)
    for where, text in _expressions(record):
        try:
            Expression(text)
        except GrueblerError as error:
            yield message("{where}: {error}", where=where, error=error)
    for key in record.guide.printed:
        if key not in _PRINTED:
            yield message("guide.printed: {key!r} is none of {known}", key=key, known=", ".join(_PRINTED))
    yield from _wrong_words(record)


def _wrong_numbers(record: SheetRecord) -> Iterator[Message]:
    """Lengths are positive, drive values some turns at most, and those of the guide in order."""
    guide, picture = record.guide, record.picture
    if not guide.start < guide.centre < guide.end <= guide.start + 360:
        yield message("guide: expected start < centre < end, at most a turn apart")
    for key in ("length", "tolerance"):
        length = getattr(guide, key)
        if not 0 < length < _LONGEST:
            yield message("guide.{key}: expected a positive length, but found {length!r}", key=key, length=length)
    angles = [(f"guide.{key}", getattr(guide, key)) for key in ("centre", "start", "end")]
    angles += [("picture.pose", picture.pose), *((f"picture.marks.{k}", at) for k, at in picture.marks.items())]
    for quantity in record.quantities:
        keys = ("at", "less_at", "contact_at")
        angles += [(f"quantities {quantity.id}: {key}", getattr(quantity, key) or 0.0) for key in keys]
    for where, angle in angles:
        if not abs(angle) <= _TURNS:
            yield message(
                "{where}: expected a drive value from -{limit:g} to {limit:g} degrees, but found {angle!r}",
                where=where,
                limit=_TURNS,
                angle=angle,
            )


def _wrong_places(record: SheetRecord) -> Iterator[Message]:
    """Names are those of points of the machine, dimensions lie on one link, the axis contains a joint of the frame."""
    try:
        machine = entry(record.machine).linkage()
    except GrueblerError as error:
        yield message("machine: {error}", error=error)
        return
    chain = machine.mechanism.chain
    joints = dict(zip(chain.joint_names(), chain.joints, strict=True))
    links: dict[str, set[str]] = {}
    for name, stands in record.names.items():
        if stands in machine.points:
            links[name] = {machine.points[stands].link}
        elif stands in joints:
            links[name] = set(joints[stands].links)
        else:
            yield message(
                "names.{name}: {place!r} is none of {known} of {machine}",
                name=name,
                place=stands,
                known=", ".join([*joints, *machine.points]),
                machine=record.machine,
            )
            return
    for where, (first, second) in [
        ("scale", record.scale),
        *((f"dimensions {d.symbol}", d.of) for d in record.dimensions),
    ]:
        if not links[first] & links[second]:
            apart = message("{where}: {first} and {second} are on no common link")
            yield apart.filled(where=where, first=first, second=second)
    axis = record.picture.axis_through
    if axis is not None and machine.mechanism.frame not in links[axis]:
        yield message("picture.axis_through: {joint} is not a joint of the frame", joint=axis)


def _expressions(record: SheetRecord) -> Iterator[tuple[str, str]]:
    for dimension in record.dimensions:
        yield f"dimensions {dimension.symbol}", dimension.value
    for quantity in record.quantities:
        for text in (quantity.value, quantity.printed):
            if text is not None:
                yield f"quantities {quantity.id}", text
        if quantity.rocker is not None:
            yield f"quantities {quantity.id}: rocker", quantity.rocker.ratio
    for text in record.guide.printed.values():
        yield "guide.printed", text


def _wrong_words(record: SheetRecord) -> Iterator[Message]:
    """Places in the explanation are those of quantities, with a number of digits."""
    known = [quantity.id for quantity in record.quantities]
    for text in (translation for paragraph in record.explanation for translation in (paragraph.en, paragraph.de)):
        for place in re.findall(r"\{[^}]*\}?|\}", text):
            form = re.fullmatch(r"\{(\w+)(?::\.\df)?\}", place)
            if form is None or form[1] not in known:
                yield message(
                    "explanation: {place!r} is not a place such as {{id:.3f}} with one of {known}",
                    place=place,
                    known=", ".join(known),
                )
