"""Elements in files: a row for each kind that says how it is read and written.

A pin is ``[x, y]``, a line ``[x, y, degrees]``; the others are tables with the centre ``at`` and keys of their kind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import msgspec

from gruebler.base.documents import convert_document
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, joined, joined_by_or, message
from gruebler.files.angles import in_degrees, in_radians
from gruebler.mechanics.linkages.elements import (
    PRESSURE_ANGLE,
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
)


class ElementRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The table of a round element: its centre, and what its kind has."""

    at: list[float]
    radius: float | None = None
    teeth: int = 0
    module: float | None = None
    belt: str = ""
    pressure_angle: Any = None
    """Degrees, of teeth."""
    circle: float | None = None
    angle: Any = 0
    """Degrees, of a cam, pins or slots."""
    cam: str | None = None
    base: float | None = None
    roller: float = 0.0
    offset: float = 0.0
    flat: bool = False
    scale: float = 1.0
    arm: float = 0.0
    distance: float = 0.0
    face: float = 0.0
    closed: bool = False
    pins: int | None = None
    slots: int | None = None
    internal: bool = False
    transfer: str | None = None


@dataclass(frozen=True, slots=True)
class ElementForm:
    """How a kind of element stands in a file."""

    write: Callable[[Any], Any]
    """The list or table."""
    keys: tuple[str, ...] = ()
    """The keys of its table besides ``at``; the first makes it this kind. None if it is a list of numbers."""
    read: Callable[[ElementRecord, str], Element] | None = None
    """The element of a table, whose place is for messages; lists of numbers are read by `Linkage`."""


def _wheel(record: ElementRecord, where: str) -> Wheel:
    x, y = read_numbers(record.at, f"{where}.at", (2,))
    radius = record.radius
    if record.module is not None:
        if radius is not None or not record.teeth or not record.module > 0:
            raise LinkageError(
                "{where}.module: a positive number that goes with teeth, and without a radius", where=where
            )
        radius = record.module * record.teeth / 2
    if radius is None and not record.teeth:
        raise LinkageError("{where}: expected a radius, teeth or a circle", where=where)
    pressure = PRESSURE_ANGLE
    if record.pressure_angle is not None:
        pressure = read_numbers([0.0, 0.0, record.pressure_angle], f"{where}.pressure_angle", (3,))[2]
    return Wheel(x, y, radius or 0.0, teeth=record.teeth, belt=record.belt, pressure_angle=pressure)


def _circle(record: ElementRecord, where: str) -> Circle:
    assert record.circle is not None
    x, y = read_numbers(record.at, f"{where}.at", (2,))
    return Circle(x, y, record.circle)


_CAM_SIZES = ("roller", "offset", "flat", "scale", "arm", "distance", "face", "closed")


def _cam(record: ElementRecord, where: str) -> CamDisc:
    assert record.cam is not None
    place = _directed(record, where)
    if record.base is None:
        raise LinkageError("{where}.base: the radius of the base circle is missing", where=where)
    sizes = {name: getattr(record, name) for name in _CAM_SIZES}
    return CamDisc(*place, lift=record.cam, base=record.base, **sizes)


def _pins(record: ElementRecord, where: str) -> GenevaDriver:
    assert record.pins is not None
    return GenevaDriver(*_directed(record, where), record.pins)


def _slots(record: ElementRecord, where: str) -> GenevaWheel:
    assert record.slots is not None
    return GenevaWheel(*_directed(record, where), slots=record.slots, internal=record.internal)


def _transfer(record: ElementRecord, where: str) -> NonCircular:
    assert record.transfer is not None
    return NonCircular(*_directed(record, where), transfer=record.transfer, teeth=record.teeth)


def _directed(record: ElementRecord, where: str) -> tuple[float, float, float]:
    x, y, angle = read_numbers([*record.at, record.angle], f"{where}.at", (3,))
    return x, y, angle


def _pin(pin: Pin) -> list[Any]:
    return _at(pin)


def _line(line: Line) -> list[Any]:
    return [*_at(line), in_degrees(line.angle + 0.0)]


def _wheel_table(wheel: Wheel) -> dict[str, Any]:
    more: dict[str, Any] = {"teeth": wheel.teeth, "belt": wheel.belt}
    if wheel.pressure_angle != PRESSURE_ANGLE:
        return _wheel_table(replace(wheel, pressure_angle=PRESSURE_ANGLE)) | {
            "pressure_angle": in_degrees(wheel.pressure_angle)
        }
    return {"at": _at(wheel), "radius": wheel.radius} | {key: value for key, value in more.items() if value}


def _circle_table(circle: Circle) -> dict[str, Any]:
    return {"at": _at(circle), "circle": circle.radius}


def _table(element: CamDisc | GenevaDriver | GenevaWheel | NonCircular) -> dict[str, Any]:
    table = {"at": _at(element), **asdict(element), "angle": in_degrees(element.angle)}
    renamed = {{"lift": "cam"}.get(key, key): value for key, value in table.items() if key not in "xy"}
    return {key: value for key, value in renamed.items() if value not in (False, 0.0) or key in ("base", "angle")}


def _at(element: Element) -> list[Any]:
    return [element.x + 0.0, element.y + 0.0]  # -0.0 + 0.0 is 0.0


FORMS: dict[type[Element], ElementForm] = {
    Pin: ElementForm(_pin),
    Line: ElementForm(_line),
    Circle: ElementForm(_circle_table, ("circle",), _circle),
    CamDisc: ElementForm(_table, ("cam", "angle", "base", *_CAM_SIZES), _cam),
    GenevaDriver: ElementForm(_table, ("pins", "angle"), _pins),
    GenevaWheel: ElementForm(_table, ("slots", "angle", "internal"), _slots),
    NonCircular: ElementForm(_table, ("transfer", "angle", "teeth"), _transfer),
    Wheel: ElementForm(_wheel_table, ("radius", "teeth", "module", "belt", "pressure_angle"), _wheel),
}
"""Every kind of element; a table without a key that comes first in its row is a wheel."""


def read_element_table(table: Mapping[str, Any], where: str) -> Element:
    """The element of a table in a file; `LinkageError` names the key that does not fit."""
    record = convert_document(table, ElementRecord, LinkageError, where)
    given = (form for form in FORMS.values() if form.keys and table.get(form.keys[0]) is not None)
    wheel = FORMS[Wheel]
    form = next(given, wheel)
    wrong = next((key for key in table if key not in ("at", *form.keys)), None)
    if wrong is not None:
        kind = message("a wheel") if form is wheel else form.keys[0]
        raise LinkageError("{where}.{wrong}: does not go with {kind}", where=where, wrong=wrong, kind=kind)
    assert form.read is not None
    return form.read(record, where)


def write_element(element: Element) -> Any:
    """An element as plain data, from which it is read again exactly; angles in degrees."""
    return FORMS[type(element)].write(element)


def read_numbers(raw: Any, where: str, counts: tuple[int, ...]) -> tuple[float, ...]:
    """x, y and perhaps an angle, which comes in degrees and goes in radians."""
    if not isinstance(raw, list) or len(raw) not in counts:
        wanted = joined_by_or([message("[x, y]" if count == 2 else "[x, y, degrees]") for count in counts])
        raise LinkageError(
            "{where}: expected {wanted}, but found {found}", where=where, wanted=wanted, found=in_short(raw)
        )
    for value in raw[:2]:
        if isinstance(value, bool) or not isinstance(value, int | float) or not -1e100 < value < 1e100:
            raise LinkageError(
                "{where}: expected numbers below 1e100, but found {found}", where=where, found=in_short(value)
            )
    try:
        return (float(raw[0]), float(raw[1]), *(in_radians(angle) for angle in raw[2:]))
    except ValueError:
        raise LinkageError(
            "{where}: expected an angle in degrees, but found {found}", where=where, found=in_short(raw[2])
        ) from None


def in_short(value: object) -> Message:
    """What was found, for a message, however long it is."""
    match value:
        case list() if len(value) > 4:
            return message("a list of {count}", count=len(value))
        case list():
            return message("[{items}]", items=joined(map(in_short, value)))
        case Mapping():
            return message("a table")
        case int() if not -(10**20) < value < 10**20:
            return message("a number of many digits")
    shown = repr(value)
    return message("{value}", value=shown if len(shown) < 40 else shown[:37] + "...")
