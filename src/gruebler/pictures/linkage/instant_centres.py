"""The instant centres of a linkage in a pose: permanent ones at its joints, the others with their polar rays.

Three links have their three instant centres on one line (theorem of three poles). So a pole lies on the line of the two
that its links have with a third; where both are permanent, that line is a polar ray, and it is drawn.
"""

from __future__ import annotations

import cmath
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.axes import as_text
from gruebler.pictures.canvas.labels import note_near, short_names
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.symbols import arrow
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.poles import cross
from gruebler.pictures.linkage.posed_linkage import PosedLinkage

_AWAY = 1.0  # of the longer side of the linkage's reach: a pole farther outside is shown by its rays only
_RAY = 64.0  # pixels of a ray that leads out of the picture
_ALL = 4  # links: up to this number all poles are shown, for more the permanent ones and those against the frame
_SAME = 1e-6  # sizes: poles closer than that are the same, as at a joint of several links
_TRANSLATING = 1e-6  # a pole farther away than a million sizes counts as at infinity
_RESTING = 1e-9  # of the swiftest velocity: slower links are at rest against each other
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


@dataclass(frozen=True, slots=True)
class Pole:
    """The instant centre of two links in a pose."""

    links: tuple[str, str]
    at: complex
    """Its place; for a pole at infinity a point of a line towards it."""
    direction: complex = 0.0
    """The unit direction of a pole at infinity, else 0; its sign has no meaning."""
    permanent: bool = False
    """Whether it is at the joint of the two links in every pose."""


def instant_centres(posed: PosedLinkage) -> list[Pole]:
    """The poles of a pose by pairs of links, permanent ones first; none for links at rest against each other.

    All pairs of up to four links; of more the permanent poles and those against the frame.
    """
    posed.driven()
    links, frame = posed.linkage.mechanism.chain.links, posed.linkage.mechanism.frame
    poles = {frozenset(pole.links): pole for pole in _permanent(posed)}
    for first, second in itertools.combinations(links, 2):
        if frozenset((first, second)) in poles or (len(links) > _ALL and frame not in (first, second)):
            continue
        if (pole := _moving_pole(posed, first, second)) is not None:
            poles[frozenset((first, second))] = pole
    return list(poles.values())


def _permanent(posed: PosedLinkage) -> Iterator[Pole]:
    """At turning joints the pin; of slides the point at infinity across the guide."""
    links = posed.linkage.mechanism.chain.links
    for number, joint in enumerate(posed.lower.mechanism.chain.joints):
        for first, second in itertools.combinations([link for link in joint.links if link in links], 2):
            element = posed.lower.elements[number, first]
            at = complex(posed.pose.complex_point(LinkPoint(first, element.x, element.y))[0])
            if joint.pair.is_turning:
                yield Pole((first, second), at, permanent=True)
            elif joint.pair.is_sliding and element.is_line:
                across = cmath.rect(1.0, float(posed.pose.angle(first)[0]) + element.direction) * 1j
                pins = [
                    complex(posed.pose.complex_point(LinkPoint(link, e.x, e.y))[0])
                    for link in (second, first)
                    for (k, owner), e in posed.lower.elements.items()
                    if owner == link and k != number and posed.lower.mechanism.chain.joints[k].pair.is_turning
                ]
                yield Pole((first, second), pins[0] if pins else at, across, permanent=True)


def _moving_pole(posed: PosedLinkage, first: str, second: str) -> Pole | None:
    """The pole of two links by their velocities; None if they are at rest against each other."""
    pose, chain, size = posed.pose, posed.lower.mechanism.chain, posed.lower.size
    i, j = chain.index(first), chain.index(second)
    middle = complex(pose.places[0, 0].mean())
    velocities = pose.places[1, 0] + 1j * pose.rates[0, 0] * (middle - pose.places[0, 0])
    apart, turning = complex(velocities[i] - velocities[j]), float(pose.rates[0, 0, i] - pose.rates[0, 0, j])
    swiftest = max(float(abs(velocities).max()), float(abs(pose.rates[0, 0]).max()) * size)
    if max(abs(apart), abs(turning) * size) <= _RESTING * swiftest:
        return None
    if abs(turning) * size <= _TRANSLATING * abs(apart):
        return Pole((first, second), _joint_of(posed, first, middle), 1j * apart / abs(apart))
    return Pole((first, second), middle + 1j * apart / turning)


def _joint_of(posed: PosedLinkage, link: str, near: complex) -> complex:
    """The joint of a link that is nearest to a place."""
    joints = [LinkPoint(link, e.x, e.y) for (_, holder), e in posed.lower.elements.items() if holder == link]
    places = [complex(posed.pose.complex_point(place)[0]) for place in joints]
    return min(places, key=lambda z: abs(z - near))


def pole_numbers(links: Sequence[str]) -> dict[str, str]:
    """The names of links in the names of poles: short names unchanged, numbers for others.

    >>> pole_numbers(["frame", "crank", "coupler"])
    {'frame': '1', 'crank': '2', 'coupler': '3'}
    """
    return short_names(list(links))


def _name(pole: Pole, numbers: Mapping[str, str]) -> str:
    first, second = sorted((numbers[link] for link in pole.links), key=lambda number: (len(number), number))
    if len(first) == len(second) == 1 and (first + second).isdigit():
        return "P" + (first + second).translate(_SUBSCRIPTS)
    return f"P({first}, {second})"


def pole_marks(context: LayerContext) -> list[Shape]:
    """Crosses and names of the poles, with polar rays; poles far away by arrows on their rays, with the distance."""
    posed = context.posed
    poles = instant_centres(posed)
    numbers = pole_numbers(posed.linkage.mechanism.chain.links)
    shapes: list[Shape] = []
    groups: list[tuple[complex, list[Pole]]] = []
    for pole in poles:
        if not pole.direction and _near(posed, pole.at):
            nearby = next((group for z, group in groups if abs(z - pole.at) < _SAME * posed.lower.size), None)
            if nearby is None:
                groups.append((pole.at, [pole]))
            else:
                nearby.append(pole)
        if not pole.permanent and not pole.direction and _near(posed, pole.at):
            rays = (ends[-1] for ends in _rays(posed, pole, poles))
            shapes += [Polylines(((posed.local(start), posed.local(pole.at)),), "dead") for start in rays]
    for z, group in groups:
        at = posed.local(z)
        shapes.append(CircleShape(at, 3.0, "dot") if any(pole.permanent for pole in group) else cross(at))
    labels: list[tuple[Point, str]] = [
        (posed.local(z), ", ".join(_name(pole, numbers) for pole in group)) for z, group in groups
    ]
    for pole in poles:
        if pole.direction or not _near(posed, pole.at):
            for start, text in _far(context, pole, poles, _name(pole, numbers)):
                tip = _tip(posed, pole, start)
                shapes += arrow(posed.local(start), tip, "dead", "dot")
                labels.append((tip, text))
    for at, text in labels:
        shapes.append(note_near(at, text, "value", [*context.drawn, *shapes]))
    return shapes


def _near(posed: PosedLinkage, z: complex) -> bool:
    upper, lower = posed.reach
    at, away = posed.local(z), _AWAY * max(lower.x - upper.x, lower.y - upper.y)
    return max(upper.x - at.x, at.x - lower.x, upper.y - at.y, at.y - lower.y) <= away


def _rays(posed: PosedLinkage, pole: Pole, poles: Sequence[Pole]) -> Iterator[tuple[complex, ...]]:
    """The finite permanent poles on each polar ray of a pole, the nearest to it first."""
    permanent = {frozenset(candidate.links): candidate for candidate in poles if candidate.permanent}

    def away(z: complex) -> float:
        return -(z * pole.direction.conjugate()).real if pole.direction else abs(z - pole.at)

    for third in posed.linkage.mechanism.chain.links:
        pair = [permanent.get(frozenset((link, third))) for link in pole.links]
        ends = [end.at for end in pair if end is not None and not end.direction]
        if third not in pole.links and None not in pair and ends:
            yield tuple(sorted(ends, key=away))


def _far(context: LayerContext, pole: Pole, poles: Sequence[Pole], name: str) -> Iterator[tuple[complex, str]]:
    """The starts of arrows to a pole outside, with their texts: its name, and its distance from there."""
    posed = context.posed
    nearest = [ends[0] for ends in _rays(posed, pole, poles)] if not pole.permanent else []
    if pole.direction:
        yield from ((start, f"{name} ∞") for start in nearest or [pole.at])
        return
    for start in nearest or [_joint_of(posed, pole.links[1], pole.at)]:
        yield start, f"{name} {as_text(abs(pole.at - start), posed.linkage.unit, context.lang)}"


def _tip(posed: PosedLinkage, pole: Pole, start: complex) -> Point:
    direction = posed.local(pole.direction or pole.at - start).unit
    return posed.local(start).plus(direction, _RAY)
