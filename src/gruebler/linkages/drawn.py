"""A linkage from a drawing of one of its positions: coordinates of the links, elements, home."""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2, cos, hypot, sin

from gruebler.errors import LinkageError
from gruebler.linkages.elements import CENTRED, Circle, Element, Line, Pin, Place, Wheel, read_element
from gruebler.linkages.model import Linkage, joint_number
from gruebler.mechanism import Mechanism

__all__ = ["from_drawing"]


def from_drawing(
    mechanism: Mechanism,
    places: Mapping[str | int, object],
    points: Mapping[str, tuple[str, float, float]],
    *,
    unit: str,
    outputs: tuple[str, ...],
) -> Linkage:
    """See `Linkage.drawn`."""
    drawn = _elements(mechanism, places)
    home = {link: _own(mechanism, link, drawn) for link in mechanism.chain.links}
    elements: dict[str, dict[str | int, object]] = {link: {} for link in mechanism.chain.links}
    for (number, link), element in drawn.items():
        x, y = home[link].seen(element.x, element.y)
        seen_there = element._replace(x=x, y=y)
        if not isinstance(seen_there, Pin | Wheel | Circle):
            seen_there = seen_there._replace(angle=seen_there.angle - home[link].angle)
        elements[link][number] = seen_there
    seen = {}
    for name, (link, x, y) in points.items():
        if link not in home:
            raise LinkageError(f"the point {name!r}: there is no link {link!r}")
        pin = read_element([x, y], f"the point {name!r}")
        seen[name] = (link, *home[link].seen(pin.x, pin.y))
    return Linkage(mechanism, elements, seen, unit=unit, home=home, outputs=outputs)


def _elements(mechanism: Mechanism, places: Mapping[str | int, object]) -> dict[tuple[int, str], Element]:
    """The elements in coordinates of the plane."""
    chain, names = mechanism.chain, mechanism.chain.joint_names()
    given = {joint_number(mechanism, joint): raw for joint, raw in places.items()}
    drawn: dict[tuple[int, str], Element] = {}
    for number, joint in enumerate(chain.joints):
        if number not in given:
            raise LinkageError(f"the place of {names[number]} is missing")
        raw, slot = given[number], None
        if isinstance(raw, Mapping):
            for link in joint.links:
                if link not in raw:
                    raise LinkageError(f"{names[number]}: the element of {link!r} is missing")
                drawn[number, link] = read_element(raw[link], f"{link}, {names[number]}")
            continue
        if isinstance(raw, list | tuple) and len(raw) == 4:
            *raw, slot = raw
            if slot not in joint.links:
                raise LinkageError(f"{names[number]}: the slot is in one of its links, not in {slot!r}")
        element = read_element(raw, names[number])
        if joint.pair.name == "roll_slide" and slot is None:
            raise LinkageError(
                f"{names[number]}: say which link has the slot: [x, y, angle, link]; wheels are given for each link"
            )
        if isinstance(element, CENTRED):
            raise LinkageError(f"{names[number]}: wheels are given for each of its links")
        for link in joint.links:
            drawn[number, link] = Pin(element.x, element.y) if slot not in (None, link) else element
    for (number, link), element in list(drawn.items()):
        if isinstance(element, Line) and link != mechanism.frame:
            drawn[number, link] = _at_the_pin(link, element, drawn)
    return drawn


def _at_the_pin(link: str, line: Line, drawn: Mapping[tuple[int, str], Element]) -> Line:
    """The line with its point where the link's first pin is nearest to it."""
    for (_, owner), element in drawn.items():
        if owner == link and isinstance(element, Pin):
            c, s = cos(line.angle), sin(line.angle)
            way = c * (element.x - line.x) + s * (element.y - line.y)
            return Line(line.x + c * way, line.y + s * way, line.angle)
    return line


def _own(mechanism: Mechanism, link: str, drawn: Mapping[tuple[int, str], Element]) -> Place:
    """The coordinates of a link: origin and x axis in the plane."""
    if link == mechanism.frame:
        return Place(0.0, 0.0, 0.0)
    driven = {drive.joint for drive in mechanism.drives}
    mine = sorted((number not in driven, number, e) for (number, owner), e in drawn.items() if owner == link)
    elements = [element for _, _, element in mine]
    lines = [e for e in elements if isinstance(e, Line)]
    pins = [e for e in elements if isinstance(e, Pin)]
    first = pins[0] if pins else elements[0]
    if lines:
        return Place(first.x, first.y, lines[0].angle)
    far = next((p for p in pins[1:] if hypot(p.x - first.x, p.y - first.y) > 0), None)
    return Place(first.x, first.y, atan2(far.y - first.y, far.x - first.x) if far else 0.0)
