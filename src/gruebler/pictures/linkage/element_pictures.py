"""Pictures of elements: a row for each kind, with its shapes to scale and its sign in the structure picture."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.kinematics.contours import cam_of
from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.elements import (
    INVERSE,
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    LinkPoint,
    NonCircular,
    Outline,
    Pin,
    Wheel,
)
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.styles import LINE, ROD
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.pictures.linkage.slides import pins_of
from gruebler.pictures.machines.geneva_shape import GenevaShape

_ROD_END = ROD / 2 + LINE  # pixels: the round end of a rod
_RIM = 9.0  # pixels: the thickness of the rim of an internal wheel
_RIM_LINES = 8  # across it, as many as show that it turns
_STEPS = 361  # points of the contour of a cam
_PAST_CONTACT = 1.25  # how far a flat follower reaches, of the way to the last place of contact
_NARROWEST = 0.3  # of the base circle: half a flat follower
_PLATE = 0.3  # its thickness, of that half
_ARM_THICKNESS = 0.055  # of a swinging one, of its length
_BOSS = 1.4  # of what a boss about its pivot covers
_BOSS_STEPS = 37


class RoundPart(NamedTuple):
    """Shapes of a link, in pixels and coordinates of the link."""

    link: str
    shapes: tuple[Shape, ...]
    between: tuple[complex, complex] | None = None
    """Of a belt: the centres of its wheels, in the unit of the linkage; its shapes go with them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ElementPicture:
    """How a kind of element is drawn."""

    sign: Callable[[Any, Element, bool], str]
    """The key of `contacts.CONTACTS` for it, with the other element, if they roll on each other or not."""
    on_line: str = "flat"
    """That of a line with which it makes a joint."""
    part: Callable[[PosedLinkage, int, str, Any], RoundPart] | None = None
    """Of a round element its shapes on its link, for a joint."""
    key: Callable[[Any], tuple[float, ...]] | None = None
    """What elements of one link have in common that are drawn once; None if each is drawn."""
    face: Callable[[PosedLinkage, str, Element, str, Any], tuple[float, float]] | None = None
    """The extent of a face or rack of another link, along its line, that touches it."""
    follower: Callable[[PosedLinkage, str, Element, str, Any], Complexes] | None = None
    """The outline of a body of another link whose face touches it, in coordinates of its line."""
    between: Callable[[PosedLinkage, int, list[Any]], RoundPart | None] | None = None
    """What is drawn between it and another of its kind in a joint."""


def round_parts(posed: PosedLinkage) -> Iterator[RoundPart]:
    """The round parts of a linkage, the larger first, each once for each link and centre."""
    parts: dict[tuple[object, ...], RoundPart] = {}
    elements = posed.linkage.elements
    for link, outlines in posed.linkage.outlines.items():
        parts |= {(link, outline): RoundPart(link, tuple(_drawn(posed, link, outline))) for outline in outlines}
    for (joint, link), element in elements.items():
        picture = PICTURES[type(element)]
        if picture.part is not None:
            key = (joint,) if picture.key is None else picture.key(element)
            parts.setdefault((link, *key), picture.part(posed, joint, link, element))
    parts |= dict(_faces(posed))
    yield from sorted(parts.values(), key=lambda part: -_size(part))
    for number, contact in enumerate(posed.linkage.mechanism.chain.joints):
        members = [elements[number, link] for link in contact.links]
        between = PICTURES[type(members[0])].between
        if between is not None and type(members[-1]) is type(members[0]) and (part := between(posed, number, members)):
            yield part


def contact_shapes(linkage: Linkage) -> dict[tuple[int, str], str]:
    """For every joint that rolls or slides in a point, by number and link: a word of `contacts.CONTACTS`.

    >>> from gruebler.structure.mechanism import Mechanism
    >>> pair = Mechanism.parse("R(0-1) R(0-2) G(1-2); drive=R(0-1)")
    >>> wheels = {"1": Wheel(0, 0, 20, teeth=20), "2": Wheel(60, 0, 40, teeth=40)}
    >>> made = Linkage.from_drawing(pair, {"R(0-1)": (0, 0), "R(0-2)": (60, 0), "G(1-2)": wheels})
    >>> sorted(contact_shapes(made).values())
    ['gear', 'gear']
    """
    shapes = {}
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        if not joint.pair.is_higher or len(joint.links) != 2:
            continue
        first, second = (linkage.elements[number, link] for link in joint.links)
        rolls = joint.pair.rolls
        for link, element, other in zip(joint.links, (first, second), (second, first), strict=True):
            shapes[number, link] = PICTURES[type(element)].sign(element, other, rolls)
    return shapes


def _size(part: RoundPart) -> float:
    shape = part.shapes[0]
    if isinstance(shape, CircleShape):
        return shape.radius
    return max(math.hypot(p.x, p.y) for p in shape.parts[0]) if isinstance(shape, Polylines) else 0.0


# --- wheels and circles ---------------------------------------------------------------------------------


def _wheel_sign(wheel: Wheel, _: Element, rolls: bool) -> str:
    if wheel.belt:
        return "crossed" if wheel.belt == "crossed" else "belt"
    return "ring" if wheel.radius < 0 else "wheel" if rolls else "gear"


def _line_sign(_: Line, other: Element, __: bool) -> str:
    return PICTURES[type(other)].on_line


def _always(sign: str) -> Callable[[Element, Element, bool], str]:
    return lambda _, __, ___: sign


def _wheel(posed: PosedLinkage, _: int, link: str, wheel: Wheel) -> RoundPart:
    return _disc(posed, link, wheel, crossed=True)


def _circle(posed: PosedLinkage, _: int, link: str, circle: Circle) -> RoundPart:
    return _disc(posed, link, circle, crossed=posed.scale * abs(circle.radius) > 12)


def _drawn(posed: PosedLinkage, link: str, outline: Outline) -> Iterator[Shape]:
    """An outline of a link: a disc with a cross that shows how it turns, a line, or a polygon."""
    if outline.radius:
        yield from _disc(posed, link, Circle(*outline.places[0], outline.radius), crossed=True).shapes
        return
    corners = tuple(posed.local(complex(*place)) for place in outline.places)
    filled = len(corners) > 2
    yield Polylines((corners,), _area(posed, link) if filled else "edge", closed=filled)


def _area(posed: PosedLinkage, link: str) -> str:
    """The style of a filled shape: that of a moving link or of the frame."""
    return "block-frame" if link == posed.linkage.mechanism.frame else "area"


def _centre_and_radius(disc: Wheel | Circle) -> tuple[float, ...]:
    return disc.x, disc.y, disc.radius


def _disc(posed: PosedLinkage, link: str, element: Wheel | Circle, *, crossed: bool) -> RoundPart:
    """A disc with a cross, or for an internal wheel a ring with lines across; fixed ones in the style of the frame."""
    centre, radius = complex(element.x, element.y), posed.scale * abs(element.radius)
    at, style = posed.local(centre), _area(posed, link)
    if element.radius < 0:
        rings = tuple(_ring(at, r)[:: 1 if r > radius else -1] for r in (radius + _RIM, radius))
        ways = [cmath.rect(1, math.tau * (k + 0.5) / _RIM_LINES) for k in range(_RIM_LINES if crossed else 0)]
        across = tuple(
            tuple(Point(at.x + r * z.real, at.y + r * z.imag) for r in (radius, radius + _RIM)) for z in ways
        )
        return RoundPart(link, (Polylines(rings, style, closed=True), Polylines(across, "hatch")))
    shapes: list[Shape] = [CircleShape(at, radius, style)]
    if crossed:
        arm = radius * math.sqrt(0.5)  # the cross lies beside bearings and bars, which are mostly level or upright
        cross = ((at.x - s * arm, at.y - arm, at.x + s * arm, at.y + arm) for s in (1, -1))
        shapes.append(Polylines(tuple((Point(a, b), Point(c, d)) for a, b, c, d in cross), "hatch"))
    return RoundPart(link, tuple(shapes))


def _disc_face(_: PosedLinkage, __: str, ___: Element, ____: str, disc: Wheel | Circle) -> tuple[float, float]:
    return -1.5 * abs(disc.radius), 1.5 * abs(disc.radius)


def _cam_follower(posed: PosedLinkage, link: str, line: Element, owner: str, cam: CamDisc) -> Complexes:
    """The outline of a flat follower in coordinates of its face: as long as the contact travels, the cam below."""
    k = posed.pose.link_index(link)
    axis = complex(posed.pose.complex_point(LinkPoint(owner, cam.x, cam.y))[0])
    axis = _on_face(line, complex((axis - posed.pose.places[0, 0, k]) / posed.pose.turns[0, k]))
    away = -math.copysign(1.0, axis.imag)
    near, far = (cam.scale * end.value for end in cam_of(cam).findings().face)
    pivot = next((_on_face(line, z) for z in pins_of(posed.lower, link)), None)
    if pivot is None or not cam.distance:
        wide = _PAST_CONTACT * max(-near, far, _NARROWEST * cam.scale * cam.base)
        thick = _PLATE * wide
        corners = [complex(x, y) for x, y in ((-wide, 0), (wide, 0), (wide, thick), (-wide, thick))]
        return np.array([axis.real + z.real + 1j * away * z.imag for z in corners])
    return _arm(pivot.imag * away, _PAST_CONTACT * far, math.copysign(1.0, axis.real - pivot.real), away) + pivot.real


def _arm(face: float, reach: float, side: float, away: float) -> Complexes:
    """That of a swinging one: of one thickness from the boss about its pivot, which stands off the face."""
    thick = _ARM_THICKNESS * reach
    boss = _BOSS * max(abs(face), abs(thick - face))
    low, high = (math.asin(height / boss) for height in (-face, thick - face))
    round_pivot = boss * np.exp(1j * np.linspace(low, high - math.tau, _BOSS_STEPS)) + 1j * face
    outline = np.concatenate([[complex(reach, thick), complex(reach, 0)], round_pivot])
    turned: Complexes = side * outline.real + 1j * away * outline.imag
    return turned


def _on_face(line: Element, place: complex) -> complex:
    """A place of a link in coordinates of a line of it."""
    return (place - complex(line.x, line.y)) * cmath.rect(1, -line.direction)


def _faces(posed: PosedLinkage) -> Iterator[tuple[tuple[str, int], RoundPart]]:
    """The flat followers and racks, by link and joint."""
    elements = posed.linkage.elements
    for (joint, link), line in elements.items():
        if not line.is_line:
            continue
        for (number, owner), element in elements.items():
            picture = PICTURES[type(element)]
            if number != joint:
                continue
            if picture.follower is not None:
                outline = picture.follower(posed, link, line, owner, element)
                yield (link, joint), RoundPart(link, tuple(_flat_follower(posed, link, line, outline)))
            elif picture.face is not None:
                ends = picture.face(posed, link, line, owner, element)
                yield (link, joint), RoundPart(link, tuple(_flat(posed, link, line, ends)))


def _flat(posed: PosedLinkage, link: str, line: Element, ends: tuple[float, float]) -> Iterator[Shape]:
    """A face or rack, and the rods that support it."""
    foot, along = complex(line.x, line.y), cmath.rect(1, line.direction)
    if link != posed.linkage.mechanism.frame:
        for start, end in _rods(posed, link, foot):
            yield Polylines(((start, end),), "rail")
            if (rod := end.minus(start)).length > _ROD_END:  # its round end stays on its side of the face
                ends_of_rod = (start.plus(rod.unit, _ROD_END), end)
                yield from (Polylines((ends_of_rod,), style) for style in ("outline-rod", "body-rod"))
    yield Polylines((tuple(posed.local(foot + offset * along) for offset in ends),), "rail")


def _flat_follower(posed: PosedLinkage, link: str, line: Element, outline: Complexes) -> Iterator[Shape]:
    """A body with a face, and the stems by which it slides."""
    plate = Polylines((_contour(posed, complex(line.x, line.y), line.direction, outline),), "block", closed=True)
    stems = () if pins_of(posed.lower, link) else _rods(posed, link, complex(line.x, line.y))
    stems = tuple((start.plus(end.minus(start).unit, _ROD_END), end) for start, end in stems if start != end)
    yield from (Polylines((stem,), "outline-rod") for stem in stems)
    yield plate
    yield from (Polylines((stem,), "body-rod") for stem in stems)


def _rods(posed: PosedLinkage, link: str, foot: complex) -> tuple[tuple[Point, Point], ...]:
    """From a face to the other joints of its link."""
    others = (e for (_, owner), e in posed.lower.elements.items() if owner == link and not e.is_round)
    return tuple((posed.local(foot), posed.local(complex(e.x, e.y))) for e in others)


def _ring(at: Point, radius: float) -> tuple[Point, ...]:
    count = max(36, min(144, round(radius)))
    turns = np.linspace(0, math.tau, count + 1)[:-1]
    return tuple(Point(at.x + radius * math.cos(t), at.y - radius * math.sin(t)) for t in turns)


def _contour(posed: PosedLinkage, centre: complex, angle: float, points: np.ndarray) -> tuple[Point, ...]:
    turn = cmath.rect(1, angle)
    return tuple(posed.local(centre + turn * complex(z)) for z in points)


def _cam(posed: PosedLinkage, _: int, link: str, disc: CamDisc) -> RoundPart:
    """The profile of a cam, its base circle dashed."""
    points = cam_of(disc).profile(np.linspace(0, math.tau, _STEPS)[:-1])
    centre, scaled = complex(disc.x, disc.y), disc.scale * (points[:, 0] + 1j * points[:, 1])
    profile = Polylines((_contour(posed, centre, disc.angle, scaled),), "area", closed=True)
    return RoundPart(link, (profile, CircleShape(posed.local(centre), posed.scale * disc.scale * disc.base, "dead")))


def _noncircular(posed: PosedLinkage, joint: int, link: str, wheel: NonCircular) -> RoundPart:
    """The curve of a non-circular wheel, with the line through it and its axis: the long axis of an ellipse."""
    pair: list[Any] = [(owner, e) for (number, owner), e in posed.linkage.elements.items() if number == joint]
    (near, non_circular), (far, other) = sorted(pair, key=lambda end: end[1].transfer == INVERSE)
    near_axis, far_axis = (
        posed.pose.complex_point(LinkPoint(owner, e.x, e.y))[0] for owner, e in ((near, non_circular), (far, other))
    )
    curve = transfer_of(non_circular, other).curves()[wheel is other] * abs(far_axis - near_axis)
    contour = _contour(posed, complex(wheel.x, wheel.y), wheel.angle, curve)
    ends = _contour(posed, complex(wheel.x, wheel.y), wheel.angle, np.array([curve[0], curve[len(curve) // 2]]))
    return RoundPart(link, (Polylines((contour,), _area(posed, link), closed=True), Polylines((ends,), "pitch")))


def _geneva_axes(posed: PosedLinkage, joint: int) -> tuple[GenevaShape, GenevaDriver, GenevaWheel, float]:
    """The shape of a Geneva drive, its two elements, and the distance of their axes."""
    of_joint: dict[type, Any] = {
        type(e): (owner, e) for (number, owner), e in posed.linkage.elements.items() if number == joint
    }
    (near, driver), (far, cross) = of_joint[GenevaDriver], of_joint[GenevaWheel]
    geneva = Geneva(cross.slots, internal=cross.internal, pins=driver.pins)
    ends = (LinkPoint(owner, e.x, e.y) for owner, e in ((near, driver), (far, cross)))
    driver_axis, wheel_axis = (posed.pose.complex_point(end)[0] for end in ends)
    return GenevaShape(geneva), driver, cross, float(abs(wheel_axis - driver_axis))


def _geneva_wheel(posed: PosedLinkage, joint: int, link: str, element: GenevaWheel) -> RoundPart:
    """The wheel with its slots."""
    shape, _, cross, size = _geneva_axes(posed, joint)
    centre = complex(element.x, element.y)
    contour = _contour(posed, centre, element.angle, shape.sign * size * shape.wheel())
    outer = (_ring(posed.local(centre), posed.scale * size * shape.rim), contour[::-1])
    return RoundPart(link, (Polylines(outer if cross.internal else (contour,), "area", closed=True),))


def _geneva_driver(posed: PosedLinkage, joint: int, link: str, element: GenevaDriver) -> RoundPart:
    """The arm with its pins and the locking disc."""
    shape, driver, _, size = _geneva_axes(posed, joint)
    centre = complex(element.x, element.y)
    shapes: list[Shape] = [
        Polylines((_contour(posed, centre, element.angle, size * lock),), "area", closed=True)
        for lock in shape.locking()
    ]
    pins = [
        centre + size * shape.crank * cmath.rect(1, element.angle + math.tau * k / driver.pins)
        for k in range(driver.pins)
    ]
    for pin in pins:
        bar = (posed.local(centre), posed.local(pin))
        shapes += [Polylines((bar,), "outline-bar"), Polylines((bar,), "body-bar")]
    shapes += [CircleShape(posed.local(pin), posed.scale * size * shape.pin, "node") for pin in pins]
    return RoundPart(link, tuple(shapes))


def _belt(posed: PosedLinkage, number: int, wheels: list[Wheel]) -> RoundPart | None:
    """The two straight runs of a belt whose wheels turn about points of the frame."""
    mechanism = posed.linkage.mechanism
    fixed = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    links = mechanism.chain.joints[number].links
    if not wheels[0].belt or not fixed.issuperset(links):
        return None
    (a, r), (b, s) = (
        (complex(posed.pose.complex_point(LinkPoint(link, e.x, e.y))[0]), abs(e.radius))
        for link, e in zip(links, wheels, strict=True)
    )
    crossed = wheels[0].belt == "crossed"
    along, gap = (b - a) / abs(b - a), abs(b - a)
    lean = math.acos(max(-1.0, min(1.0, (r + s if crossed else r - s) / gap)))
    runs = []
    for side in (1, -1):
        touch = along * cmath.rect(1, side * lean)
        runs.append((posed.local(a + r * touch), posed.local(b + (-s if crossed else s) * touch)))
    return RoundPart(mechanism.frame, (Polylines(tuple(runs), "rail"),), (a, b))


PICTURES: dict[type[Element], ElementPicture] = {
    Pin: ElementPicture(sign=_always("pin"), on_line="slot"),
    Line: ElementPicture(sign=_line_sign),
    Wheel: ElementPicture(
        sign=_wheel_sign, on_line="rack", part=_wheel, key=_centre_and_radius, face=_disc_face, between=_belt
    ),
    Circle: ElementPicture(sign=_always("roller"), part=_circle, key=_centre_and_radius, face=_disc_face),
    CamDisc: ElementPicture(sign=_always("cam"), part=_cam, follower=_cam_follower),
    GenevaDriver: ElementPicture(sign=_always("geneva-driver"), part=_geneva_driver),
    GenevaWheel: ElementPicture(sign=_always("geneva-wheel"), part=_geneva_wheel),
    NonCircular: ElementPicture(sign=_always("oval"), part=_noncircular),
}
"""Every kind of element."""
