"""A linkage as it is drawn in one position: links with coordinates of their own, from the places of the joints."""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2, cos, hypot, sin
from sys import float_info

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.mechanics.linkages.elements import Element, Pin, Pose2D, read_element
from gruebler.structure.mechanism import Mechanism

ByLink = dict[str, dict[str | int, object]]
"""What each joint is on each link."""


def taken_apart(
    mechanism: Mechanism, places: Mapping[str | int, object], points: Mapping[str, tuple[str, float, float]]
) -> tuple[ByLink, dict[str, tuple[str, float, float]], dict[str, Pose2D]]:
    """Elements and points of a drawing in coordinates of their links, and where the links lie.

    See `gruebler.mechanics.linkages.Linkage.from_drawing`.
    """
    drawn = _drawn_elements(mechanism, places)
    reference_pose = {link: _link_coordinates(mechanism, link, drawn) for link in mechanism.chain.links}
    elements: ByLink = {link: {} for link in mechanism.chain.links}
    for (number, link), element in drawn.items():
        x, y = _seen_from(reference_pose[link], element.x, element.y)
        elements[link][number] = element.placed(x, y, element.direction - reference_pose[link].angle)
    seen = {}
    for name, (link, x, y) in points.items():
        if link not in reference_pose:
            raise LinkageError("the point {name!r}: there is no link {link!r}", name=name, link=link)
        pin = read_element([x, y], message("the point {name!r}", name=name))
        seen[name] = (link, *_seen_from(reference_pose[link], pin.x, pin.y))
    return elements, seen, reference_pose


_ROUNDING = 8 * float_info.epsilon
"""How exactly a turned point is known, relative to its coordinates: those of the origin of the link, differences,
products, sine and cosine are each rounded once."""


def _seen_from(pose: Pose2D, x: float, y: float) -> tuple[float, float]:
    """A point of the plane in the coordinates of a link; what is nothing but rounding is 0, as on the link's x axis."""
    limit = _ROUNDING * max(map(abs, (x, y, pose.x, pose.y)))
    along, across = pose.to_local(x, y)
    return 0.0 if abs(along) <= limit else along, 0.0 if abs(across) <= limit else across


def _drawn_elements(mechanism: Mechanism, places: Mapping[str | int, object]) -> dict[tuple[int, str], Element]:
    """The elements in coordinates of the plane."""
    chain, names = mechanism.chain, mechanism.chain.joint_names()
    given = {mechanism.chain.joint_number(joint, error=LinkageError): raw for joint, raw in places.items()}
    drawn: dict[tuple[int, str], Element] = {}
    for number, joint in enumerate(chain.joints):
        if number not in given:
            raise LinkageError("the place of {joint} is missing", joint=chain.joint_title(number))
        raw, slot = given[number], None
        if isinstance(raw, Mapping):
            for link in joint.links:
                if link not in raw:
                    raise LinkageError(
                        "{joint}: the element of {link!r} is missing", joint=chain.joint_title(number), link=link
                    )
                drawn[number, link] = read_element(raw[link], f"{link}, {names[number]}")
            continue
        if isinstance(raw, list | tuple) and len(raw) == 4:
            *raw, slot = raw
            if slot not in joint.links:
                raise LinkageError(
                    "{joint}: the slot is in one of its links, not in {slot!r}",
                    joint=chain.joint_title(number),
                    slot=slot,
                )
        element = read_element(raw, names[number])
        if joint.pair.rolls_and_slides and slot is None:
            raise LinkageError(
                "{joint}: say which link has the slot: [x, y, angle, link]; wheels are given for each link",
                joint=chain.joint_title(number),
            )
        if element.is_round:
            raise LinkageError("{joint}: wheels are given for each of its links", joint=chain.joint_title(number))
        for link in joint.links:
            drawn[number, link] = Pin(element.x, element.y) if slot not in (None, link) else element
    for (number, link), element in list(drawn.items()):
        if element.is_line and link != mechanism.frame:
            drawn[number, link] = _at_the_pin(link, element, drawn)
    return drawn


def _at_the_pin(link: str, line: Element, drawn: Mapping[tuple[int, str], Element]) -> Element:
    """The line with its point where the link's first pin is nearest to it."""
    for (_, owner), element in drawn.items():
        if owner == link and element.is_pin:
            c, s = cos(line.direction), sin(line.direction)
            displacement = c * (element.x - line.x) + s * (element.y - line.y)
            return line.placed(line.x + c * displacement, line.y + s * displacement, line.direction)
    return line


def _link_coordinates(mechanism: Mechanism, link: str, drawn: Mapping[tuple[int, str], Element]) -> Pose2D:
    """The coordinates of a link: origin and x axis in the plane."""
    if link == mechanism.frame:
        return Pose2D(0.0, 0.0, 0.0)
    joints, driven = mechanism.chain.joints, {drive.joint for drive in mechanism.drives}
    own = [number for number, owner in drawn if owner == link]
    own.sort(key=lambda number: (number not in driven, mechanism.frame not in joints[number].links))
    elements = [drawn[number, link] for number in own]
    lines = [e for e in elements if e.is_line]
    pins = [e for e in elements if e.is_pin]
    first = pins[0] if pins else elements[0]
    if lines:
        return Pose2D(first.x, first.y, lines[0].direction)
    far = next((p for p in pins[1:] if hypot(p.x - first.x, p.y - first.y) > 0), None)
    return Pose2D(first.x, first.y, atan2(far.y - first.y, far.x - first.x) if far else 0.0)
