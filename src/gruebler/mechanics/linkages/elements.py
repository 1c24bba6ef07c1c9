"""What a joint is on one of its links: a pin, a line along which something slides, a wheel, or a smooth circle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, hypot, isfinite, sin
from typing import NamedTuple

from gruebler.base.angles import warn_of_degrees
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, joined_by_or, message
from gruebler.structure.chain.pairs import Pair


@dataclass(frozen=True, slots=True)
class Pin:
    """The axis of a turning joint: a point of the link."""

    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Line:
    """A slide: a line of the link through a point; ways are counted from the point, in the direction of the angle."""

    x: float
    y: float
    angle: float


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel that rolls without slip, on another one or along a line; ``x, y`` is its centre.

    A negative radius is internal toothing. Tooth numbers, with the sign of the radius, make the ratio exact; a wheel of
    a belt or chain is ``open`` or ``crossed`` and touches nothing.
    """

    x: float
    y: float
    radius: float
    teeth: int = 0
    belt: str = ""


@dataclass(frozen=True, slots=True)
class Circle:
    """A smooth circle, on which a contact may slide: an eccentric disc, a roller; a negative radius is a hole."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True, slots=True)
class CamDisc:
    """A disc cam, by the lift that it gives a follower (`gruebler.machines.cams`): a roller or a flat face.

    ``x, y`` is the axis; the cam's own frame is turned by the angle; lengths, those of the lift too, are multiplied by
    ``scale``. The follower slides in a guide, or it swings: then the lift is in degrees, against the line of centres,
    the pivot lies at ``distance`` on the x axis (negative: on the left), the roller's centre on an arm, the flat face
    ``face`` from the pivot.
    """

    x: float
    y: float
    angle: float
    lift: str
    base: float
    roller: float = 0.0
    offset: float = 0.0
    flat: bool = False
    scale: float = 1.0
    arm: float = 0.0
    distance: float = 0.0
    face: float = 0.0


@dataclass(frozen=True, slots=True)
class GenevaDriver:
    """The driver of a Geneva drive: its axis, the direction of a pin, the number of pins."""

    x: float
    y: float
    angle: float
    pins: int = 1


@dataclass(frozen=True, slots=True)
class GenevaWheel:
    """The slotted wheel of a Geneva drive: its axis, the direction of a slot, the number of slots."""

    x: float
    y: float
    angle: float
    slots: int
    internal: bool = False


@dataclass(frozen=True, slots=True)
class NonCircular:
    """A wheel whose curve rolls without slip on that of another one, about fixed centres, in the opposite sense.

    ``x, y`` is the axis; the angle that of a direction of the wheel. The turns of both wheels are counted from the
    position in which their directions point at each other's axis. ``transfer`` says how far the other wheel turns while
    this one turns by a: ``"ellipse E"``, an ellipse of eccentricity E about a focus, the direction through the other
    focus; or the lift, in degrees, that comes to a times the mean ratio (texts as in `gruebler.machines.cams`). The
    other wheel has ``"inverse"``. The mean ratio is that of the tooth numbers, 1 without them.
    """

    x: float
    y: float
    angle: float
    transfer: str
    teeth: int = 0


INVERSE = "inverse"
"""The transfer function of the second of two non-circular wheels."""

Element = Pin | Line | Wheel | Circle | CamDisc | GenevaDriver | GenevaWheel | NonCircular

RoundElement = Wheel | Circle
"""The elements with a centre and a radius."""
LeadingElement = CamDisc | GenevaDriver | NonCircular
"""The elements that lead another one by a law."""
CENTRED = (Wheel, Circle, CamDisc, GenevaDriver, GenevaWheel, NonCircular)
"""The elements that turn about a centre and touch another element."""


def direction(element: Element) -> float:
    """The angle of an element on its link; 0 for one that has none."""
    return element.angle if isinstance(element, Line | CamDisc | GenevaDriver | GenevaWheel | NonCircular) else 0.0


@dataclass(frozen=True, slots=True)
class LinkPoint:
    """A point of a link that has a name, such as a coupler point."""

    link: str
    x: float
    y: float


class Pose2D(NamedTuple):
    """Where a link lies: its origin, and the angle of its x axis."""

    x: float
    y: float
    angle: float

    def put(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the link lies.

        >>> Pose2D(1.0, 0.0, 0.0).put(2.0, 3.0)
        (3.0, 3.0)
        """
        c, s = cos(self.angle), sin(self.angle)
        return self.x + c * x - s * y, self.y + s * x + c * y

    def to_local(self, x: float, y: float) -> tuple[float, float]:
        """The coordinates in the link of a point that lies there."""
        c, s = cos(self.angle), sin(self.angle)
        return c * (x - self.x) + s * (y - self.y), c * (y - self.y) - s * (x - self.x)


_KINDS = {
    Pin: message("a pin [x, y]"),
    Line: message("a line [x, y, angle]"),
    Wheel: message("a wheel (at, radius or teeth)"),
    Circle: message("a circle (at, circle)"),
    CamDisc: message("a cam (at, cam)"),
    GenevaDriver: message("pins (at, pins)"),
    GenevaWheel: message("slots (at, slots)"),
    NonCircular: message("a non-circular wheel (at, transfer)"),
}

_WANTED: dict[str, tuple[tuple[type, type], ...]] = {
    "revolute": ((Pin, Pin),),
    "prismatic": ((Line, Line),),
    "roll_slide": (
        (Line, Pin),
        (Wheel, Wheel),
        (Wheel, Line),
        (Circle, Circle),
        (Circle, Line),
        (CamDisc, Circle),
        (CamDisc, Pin),
        (CamDisc, Line),
        (GenevaDriver, GenevaWheel),
        (NonCircular, NonCircular),
    ),
    "double_slide": ((Line, Line),),
    "rolling": ((Wheel, Wheel), (Wheel, Line), (NonCircular, NonCircular)),
}


def check_elements_fit(pair: Pair, name: str, elements: dict[str, Element]) -> None:
    """Check that a joint has the elements of its pair; `LinkageError` names the joint."""
    if pair.name not in _WANTED:
        raise LinkageError(
            "{name}: dimensions of this kind of joint ({pair}) are not known here", name=name, pair=pair.title
        )
    given = {type(e) for e in elements.values()}
    if any(given == set(kinds) for kinds in _WANTED[pair.name]):
        return
    wanted = [
        message("{element} on each of its links", element=_KINDS[first])
        if first is second
        else message("{one} on one of its links and {other} on the other", one=_KINDS[first], other=_KINDS[second])
        for first, second in _WANTED[pair.name]
    ]
    raise LinkageError("{name} needs {elements}", name=name, elements=joined_by_or(wanted))


def read_element(raw: object, where: str | Message) -> Element:
    """The element that two or three numbers stand for; angles in radians.

    >>> read_element([3, 4], "crank")
    Pin(x=3.0, y=4.0)
    """
    if isinstance(raw, RoundElement):
        return _round(raw, where)
    if isinstance(raw, CamDisc | GenevaDriver | GenevaWheel | NonCircular):
        if isinstance(raw, NonCircular) and _whole(raw.teeth, where) < 0:
            raise LinkageError(
                "{where}: teeth: expected a positive number, but found {teeth}", where=where, teeth=raw.teeth
            )
        x, y, angle = (_number(value, where) for value in (raw.x, raw.y, raw.angle))
        return replace(raw, x=x, y=y, angle=angle)
    if isinstance(raw, Pin):
        numbers: tuple[object, ...] = (raw.x, raw.y)
    elif isinstance(raw, Line):
        numbers = (raw.x, raw.y, raw.angle)
    elif isinstance(raw, list | tuple):
        numbers = tuple(raw)
    else:
        raise LinkageError("{where}: expected [x, y] or [x, y, angle], but found {raw!r}", where=where, raw=raw)
    if len(numbers) not in (2, 3):
        raise LinkageError("{where}: expected two or three numbers, but found {count}", where=where, count=len(numbers))
    values = [_number(value, where) for value in numbers]
    if len(values) == 2:
        return Pin(*values)
    warn_of_degrees(str(where), values[2])
    return Line(*values)


def _round(raw: RoundElement, where: str | Message) -> RoundElement:
    x, y, radius = (_number(value, where) for value in (raw.x, raw.y, raw.radius))
    if not abs(radius) > 1e-100 and not (isinstance(raw, Wheel) and radius == 0 and raw.teeth):
        raise LinkageError(
            "{where}: a radius is positive, or negative for internal toothing, not {radius!r}",
            where=where,
            radius=radius,
        )
    if isinstance(raw, Circle):
        return Circle(x, y, radius)
    teeth = _whole(raw.teeth, where)
    if teeth * radius < 0:
        raise LinkageError(
            "{where}: radius and teeth are both negative (internal toothing) or both positive", where=where
        )
    if raw.belt not in ("", "open", "crossed"):
        raise LinkageError("{where}: a belt is 'open' or 'crossed', not {belt!r}", where=where, belt=raw.belt)
    if raw.belt and radius < 0:
        raise LinkageError(
            "{where}: a wheel of a belt has a positive radius, not {radius:g}", where=where, radius=radius
        )
    return Wheel(x, y, radius, teeth, raw.belt)


def _whole(teeth: object, where: str | Message) -> int:
    if isinstance(teeth, bool) or not isinstance(teeth, int) or not -(10**6) < teeth < 10**6:
        raise LinkageError(
            "{where}: teeth: expected a whole number below 1,000,000, but found {teeth!r}", where=where, teeth=teeth
        )
    return teeth


def _number(value: object, where: str | Message) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not _usable(value):
        raise LinkageError("{where}: expected finite numbers, but found {value!r}", where=where, value=value)
    return float(value)


def _usable(value: float) -> bool:
    try:
        return isfinite(value) and hypot(value) < 1e100
    except OverflowError:
        return False
