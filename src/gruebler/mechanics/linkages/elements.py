"""What a joint is on one of its links: a pin, a line along which something slides, a wheel, or a smooth circle.

Each kind of element is one class. What two of them do together stands in `gruebler.mechanics.linkages.contacts` and
`gruebler.mechanics.kinematics.contacts`, files in `gruebler.files.element_records`, pictures in
`gruebler.pictures.linkage.element_pictures`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, replace
from math import cos, hypot, isfinite, radians, sin
from typing import ClassVar, Literal, NamedTuple, Self, TypeVar, final

from gruebler.base.angles import warn_of_degrees
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message

PRESSURE_ANGLE = radians(20)
"""Of teeth for which none is given, as in ISO 53."""
_STEEPEST = radians(60)
Where = str | Message
"""The place of an element in what was given, for messages."""


@dataclass(frozen=True, slots=True)
class Element(ABC):
    """What a joint is on one of its links. The class says what there is to know of its kind."""

    x: float
    y: float

    title: ClassVar[Message]
    """How it is called where one is missing, and how it is written."""
    form: ClassVar[Literal["pin", "line", "round"]]
    """A ``pin`` is a point, something slides or rolls along a ``line``; what is ``round`` has a centre at ``x, y`` and
    touches another element with its outline."""
    lengths: ClassVar[tuple[str, ...]] = ("x", "y")
    """Its numbers that are lengths, or multiply lengths."""
    angles: ClassVar[tuple[str, ...]] = ()
    """Its number that is an angle in the link's coordinates, if there is one."""
    is_smooth: ClassVar[bool] = False
    """Whether it is the same when it turns about its centre."""
    leads: ClassVar[bool] = False
    """Whether it moves another element by a law."""
    own_sizes: ClassVar[Mapping[str, str]] = {}
    """Its sizes that can be changed by themselves, as files call them; a roller's is the cam's, too."""

    @property
    def is_pin(self) -> bool:
        """Whether it is a point and nothing else."""
        return self.form == "pin"

    @property
    def is_line(self) -> bool:
        """Whether something slides or rolls along it."""
        return self.form == "line"

    @property
    def is_round(self) -> bool:
        """Whether it has a centre and touches another element."""
        return self.form == "round"

    @property
    def direction(self) -> float:
        """Its angle on its link; 0 for one that has none."""
        return float(getattr(self, self.angles[0])) if self.angles else 0.0

    @property
    def rim(self) -> float:
        """How far a round outline reaches from the centre; 0 if there is none, or another element decides."""
        return 0.0

    @property
    def disc_radius(self) -> float:
        """Of the disc that it is about its centre, of a cam the base circle; 0 if it is none."""
        return self.rim

    @property
    def closed(self) -> bool:
        """Whether what it touches cannot lift off although it only pushes it: a cam with a groove."""
        return False

    @property
    def place(self) -> tuple[float, ...]:
        """Where it is on its link: x, y, and its angle if it has one.

        >>> Pin(3.0, 4.0).place, Line(3.0, 4.0, 0.5).place
        ((3.0, 4.0), (3.0, 4.0, 0.5))
        """
        return (self.x, self.y, *(getattr(self, name) for name in self.angles))

    def placed(self, x: float, y: float, angle: float = 0.0) -> Self:
        """The same at another place; one without a direction takes no notice of the angle."""
        return replace(self, x=x, y=y, **dict.fromkeys(self.angles, angle))

    def scaled(self, factor: float) -> Self:
        """The same with every length times a factor."""
        return replace(self, **{name: getattr(self, name) * factor for name in self.lengths})

    def mirrored(self) -> Self:
        """The mirror image in the x axis; `LinkageError` if it is an element of another law."""
        self.check_mirrored()
        return replace(self, y=-self.y, **{name: -getattr(self, name) for name in self.angles})

    def check_mirrored(self) -> None:  # noqa: B027  # most have a mirror image
        """`LinkageError` for an element whose mirror image has another law."""

    @abstractmethod
    def checked(self, where: Where) -> Self:
        """The same with its numbers as floats; `LinkageError` names the first that cannot be."""


@final
@dataclass(frozen=True, slots=True)
class Pin(Element):
    """The axis of a turning joint: a point of the link."""

    title = message("a pin [x, y]")
    form = "pin"

    def checked(self, where: Where) -> Pin:
        """See `Element.checked`."""
        return Pin(_number(self.x, where), _number(self.y, where))


@final
@dataclass(frozen=True, slots=True)
class Line(Element):
    """A slide: a line of the link through a point; ways are counted from the point, in the direction of the angle."""

    angle: float

    title = message("a line [x, y, angle]")
    form = "line"
    angles = ("angle",)

    def checked(self, where: Where) -> Line:
        """See `Element.checked`; warns of an angle that looks like degrees."""
        x, y, angle = (_number(value, where) for value in (self.x, self.y, self.angle))
        warn_of_degrees(where, angle)
        return Line(x, y, angle)


@final
@dataclass(frozen=True, slots=True)
class Wheel(Element):
    """A wheel that rolls without slip, on another one or along a line; ``x, y`` is its centre.

    A negative radius is internal toothing. Tooth numbers, with the sign of the radius, make the ratio exact; a wheel of
    a belt or chain is ``open`` or ``crossed`` and touches nothing.
    """

    radius: float
    _: KW_ONLY
    teeth: int = 0
    belt: str = ""
    pressure_angle: float = PRESSURE_ANGLE
    """Of its teeth, in radians: between the common normal and the common tangent of the pitch circles."""

    title = message("a wheel (at, radius or teeth)")
    form = "round"
    lengths = ("x", "y", "radius")

    @property
    def rim(self) -> float:
        """See `Element.rim`."""
        return abs(self.radius)

    def checked(self, where: Where) -> Wheel:
        """See `Element.checked`."""
        x, y, radius = (_number(value, where) for value in (self.x, self.y, self.radius))
        if radius or not self.teeth:
            _check_radius(radius, where)
        teeth = _whole(self.teeth, where)
        if teeth * radius < 0:
            raise LinkageError(
                "{where}: radius and teeth are both negative (internal toothing) or both positive", where=where
            )
        if self.belt not in ("", "open", "crossed"):
            raise LinkageError("{where}: a belt is 'open' or 'crossed', not {belt!r}", where=where, belt=self.belt)
        if self.belt and radius < 0:
            raise LinkageError(
                "{where}: a wheel of a belt has a positive radius, not {radius:g}", where=where, radius=radius
            )
        pressure = _number(self.pressure_angle, where)
        if not 0 <= pressure < _STEEPEST:
            raise LinkageError(
                "{where}: the pressure angle of teeth lies from 0° to below 60°, not {pressure!r} rad",
                where=where,
                pressure=self.pressure_angle,
            )
        return Wheel(x, y, radius, teeth=teeth, belt=self.belt, pressure_angle=pressure)


@final
@dataclass(frozen=True, slots=True)
class Circle(Element):
    """A smooth circle, on which a contact may slide: an eccentric disc, a roller; a negative radius is a hole."""

    radius: float

    title = message("a circle (at, circle)")
    form = "round"
    lengths = ("x", "y", "radius")
    is_smooth = True
    own_sizes = {"circle": "radius"}  # noqa: RUF012

    @property
    def rim(self) -> float:
        """See `Element.rim`."""
        return abs(self.radius)

    def checked(self, where: Where) -> Circle:
        """See `Element.checked`."""
        x, y, radius = (_number(value, where) for value in (self.x, self.y, self.radius))
        _check_radius(radius, where)
        return Circle(x, y, radius)


@final
@dataclass(frozen=True, slots=True)
class CamDisc(Element):
    """A disc cam, by the lift that it gives a follower (`gruebler.machines.cams`): a roller or a flat face.

    ``x, y`` is the axis; the cam's own frame is turned by the angle; lengths, those of the lift too, are multiplied by
    ``scale``. The follower slides in a guide, or it swings: then the lift is in degrees, against the line of centres,
    the pivot lies at ``distance`` on the x axis (negative: on the left), the roller's centre on an arm, the flat face
    ``face`` from the pivot.
    """

    angle: float
    _: KW_ONLY
    lift: str
    base: float
    roller: float = 0.0
    offset: float = 0.0
    flat: bool = False
    scale: float = 1.0
    arm: float = 0.0
    distance: float = 0.0
    face: float = 0.0
    closed: bool = False
    """Whether a groove or a second cam keeps the follower, so that it cannot lift off."""

    title = message("a cam (at, cam)")
    form = "round"
    lengths = ("x", "y", "scale")
    angles = ("angle",)
    leads = True
    own_sizes = {"base": "base", "lift": "lift"}  # noqa: RUF012

    @property
    def disc_radius(self) -> float:
        """See `Element.disc_radius`."""
        return abs(self.base * self.scale)

    def check_mirrored(self) -> None:
        """See `Element.check_mirrored`."""
        raise LinkageError("the mirror image of a cam is another cam: give its lift the other way round")

    def checked(self, where: Where) -> CamDisc:
        """See `Element.checked`."""
        return _with_place_checked(self, where)


@final
@dataclass(frozen=True, slots=True)
class GenevaDriver(Element):
    """The driver of a Geneva drive: its axis, the direction of a pin, the number of pins."""

    angle: float
    pins: int = 1

    title = message("pins (at, pins)")
    form = "round"
    angles = ("angle",)
    leads = True

    def checked(self, where: Where) -> GenevaDriver:
        """See `Element.checked`."""
        return _with_place_checked(self, where)


@final
@dataclass(frozen=True, slots=True)
class GenevaWheel(Element):
    """The slotted wheel of a Geneva drive: its axis, the direction of a slot, the number of slots."""

    angle: float
    _: KW_ONLY
    slots: int
    internal: bool = False

    title = message("slots (at, slots)")
    form = "round"
    angles = ("angle",)

    def checked(self, where: Where) -> GenevaWheel:
        """See `Element.checked`."""
        return _with_place_checked(self, where)


INVERSE = "inverse"
"""The transfer function of the second of two non-circular wheels."""


@final
@dataclass(frozen=True, slots=True)
class NonCircular(Element):
    """A wheel whose curve rolls without slip on that of another one, about fixed centres, in the opposite sense.

    ``x, y`` is the axis; the angle that of a direction of the wheel. The turns of both wheels are counted from the
    position in which their directions point at each other's axis. ``transfer`` says how far the other wheel turns while
    this one turns by a: ``"ellipse E"``, an ellipse of eccentricity E about a focus, the direction through the other
    focus; or the lift, in degrees, that comes to a times the mean ratio (texts as in `gruebler.machines.cams`). The
    other wheel has ``"inverse"``. The mean ratio is that of the tooth numbers, 1 without them.
    """

    angle: float
    _: KW_ONLY
    transfer: str
    teeth: int = 0

    title = message("a non-circular wheel (at, transfer)")
    form = "round"
    angles = ("angle",)
    leads = True

    def check_mirrored(self) -> None:
        """See `Element.check_mirrored`."""
        if self.transfer != INVERSE and not self.transfer.lstrip().startswith("ellipse"):
            raise LinkageError("the mirror image of a non-circular wheel is another one: reverse its lift")

    def checked(self, where: Where) -> NonCircular:
        """See `Element.checked`."""
        if _whole(self.teeth, where) < 0:
            raise LinkageError(
                "{where}: teeth: expected a positive number, but found {teeth}", where=where, teeth=self.teeth
            )
        return _with_place_checked(self, where)


@dataclass(frozen=True, slots=True)
class LinkPoint:
    """A point of a link that has a name, such as a coupler point."""

    link: str
    x: float
    y: float


@final
@dataclass(frozen=True, slots=True)
class Outline:
    """What a link looks like besides its joints, in its coordinates: drawn, and nothing else.

    One place with a radius is a disc (the wheel of a locomotive, a flywheel), two places are a line (a rope), more are
    the corners of a polygon.
    """

    places: tuple[tuple[float, float], ...]
    radius: float = 0.0

    def scaled(self, factor: float) -> Outline:
        """The same with every length times a factor."""
        return Outline(tuple((x * factor, y * factor) for x, y in self.places), self.radius * factor)

    def mirrored(self) -> Outline:
        """The mirror image in the x axis."""
        return Outline(tuple((x, -y) for x, y in self.places), self.radius)

    def seen_from(self, pose: Pose2D) -> Outline:
        """The same in coordinates of a link that lies there."""
        return Outline(tuple(pose.to_local(x, y) for x, y in self.places), self.radius)

    def checked(self, where: Where) -> Outline:
        """The same with its numbers as floats; `LinkageError` for neither a disc nor two places or more."""
        places = tuple((_number(x, where), _number(y, where)) for x, y in self.places)
        radius = _number(self.radius, where)
        if radius < 0 or (len(places) < 2) != (radius > 0) or not places:
            raise LinkageError("{where}: an outline is a place with a radius, or two places or more", where=where)
        return Outline(places, radius)


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


_E = TypeVar("_E", bound=Element)


def read_element(raw: object, where: Where) -> Element:
    """The element that two or three numbers stand for; angles in radians.

    >>> read_element([3, 4], "crank")
    Pin(x=3.0, y=4.0)
    """
    if isinstance(raw, Element):
        return raw.checked(where)
    if not isinstance(raw, list | tuple):
        raise LinkageError("{where}: expected [x, y] or [x, y, angle], but found {raw!r}", where=where, raw=raw)
    if len(raw) not in (2, 3):
        raise LinkageError("{where}: expected two or three numbers, but found {count}", where=where, count=len(raw))
    return (Pin(*raw) if len(raw) == 2 else Line(*raw)).checked(where)


def _with_place_checked(element: _E, where: Where) -> _E:
    return element.placed(*(_number(value, where) for value in element.place))


def _check_radius(radius: float, where: Where) -> None:
    if not abs(radius) > 1e-100:
        raise LinkageError(
            "{where}: a radius is positive, or negative for internal toothing, not {radius!r}",
            where=where,
            radius=radius,
        )


def _whole(teeth: object, where: Where) -> int:
    if isinstance(teeth, bool) or not isinstance(teeth, int) or not -(10**6) < teeth < 10**6:
        raise LinkageError(
            "{where}: teeth: expected a whole number below 1,000,000, but found {teeth!r}", where=where, teeth=teeth
        )
    return teeth


def _number(value: object, where: Where) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not _usable(value):
        raise LinkageError("{where}: expected finite numbers, but found {value!r}", where=where, value=value)
    return float(value)


def _usable(value: float) -> bool:
    try:
        return isfinite(value) and hypot(value) < 1e100
    except OverflowError:
        return False
