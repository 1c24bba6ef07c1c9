"""A linkage in words and in one line: its mechanism, and where on each link its joints and points lie."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from math import degrees, hypot

from gruebler.base.text import Message, joined, message
from gruebler.mechanics.linkages.elements import Element, LinkPoint, Pose2D
from gruebler.structure.mechanism import Mechanism

_LENGTH = message("{link}: {length:n} {unit} from {first} to {second}")
_JOINTS = message("{link}: {joints}")
_JOINT = message("{joint} at ({numbers})")
_POINT = message("{name} at ({numbers})")
_POSE = message("It has a reference pose; {link} is turned by {angle:n}° in it.")


def linkage_lines(
    mechanism: Mechanism,
    elements: Mapping[tuple[int, str], Element],
    points: Mapping[str, LinkPoint],
    *,
    unit: str,
    reference_pose: Mapping[str, Pose2D] | None,
) -> Iterator[Message]:
    """The mechanism, a line for each link with its length or its joints and points, whether there is a pose."""
    yield Message(mechanism.text().replace("{", "{{").replace("}", "}}"))
    names = mechanism.chain.joint_names()
    for link in mechanism.chain.links:
        own = {names[number]: each for (number, owner), each in sorted(elements.items()) if owner == link}
        marked = {name: point for name, point in points.items() if point.link == link}
        if len(own) == 2 and not marked and all(each.is_pin for each in own.values()):
            (first, a), (second, b) = own.items()
            yield _LENGTH.filled(link=link, length=hypot(a.x - b.x, a.y - b.y), unit=unit, first=first, second=second)
        else:
            parts = [_JOINT.filled(joint=joint, numbers=joined(_numbers(each))) for joint, each in own.items()]
            parts += [_POINT.filled(name=name, numbers=_pair(point)) for name, point in marked.items()]
            yield _JOINTS.filled(link=link, joints=joined(parts))
    if reference_pose is not None:
        moved = next(link for link in mechanism.chain.links if link != mechanism.frame)
        yield _POSE.filled(link=moved, angle=degrees(reference_pose[moved].angle))


def _pair(point: LinkPoint) -> Message:
    return message("{x:n}, {y:n}", x=point.x, y=point.y)


def _numbers(element: Element) -> Iterator[Message]:
    """What an element has, in its order; angles in degrees, what is left out is not said."""
    for field in fields(element):
        value = getattr(element, field.name)
        if field.name in ("x", "y"):
            yield message("{value:n}", value=value)
        elif field.name in element.angles:
            yield message("{value:n}°", value=degrees(value))
        elif value != field.default:
            yield message("{name} {value}", name=field.name, value=value)


def sizes_in_a_line(
    elements: Mapping[tuple[int, str], Element],
    points: Mapping[str, LinkPoint],
    reference_pose: Mapping[str, Pose2D] | None,
) -> str:
    """The numbers of every link, joint by joint, to six digits, and the angles of its reference pose."""
    links: dict[str, list[str]] = {}
    for (_, link), element in sorted(elements.items()):
        values = (getattr(element, field.name) for field in fields(element) if field.repr)
        texts = (f"{value:.6g}" if isinstance(value, float) else str(value) for value in values)
        links.setdefault(link, []).append(f"({', '.join(texts)})")
    parts = [f"{link} {' '.join(own)}" for link, own in links.items()]
    parts += [f"{name}: {p.link} ({p.x:.6g}, {p.y:.6g})" for name, p in points.items()]
    if reference_pose is not None:
        parts.append("drawn at " + " ".join(f"{pose.angle:.6g}" for pose in reference_pose.values()))
    return "; ".join(parts)
