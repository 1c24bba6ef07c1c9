"""Wheels in pairs: which link holds their centres, and what ties their angles.

Two wheels tie the angles of their links against the direction of the line of centres: ``a (one - line) + b (other -
line)`` stays what it is. docs/theory/wheels.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import atan2, floor, hypot, log2
from typing import NamedTuple, Protocol

from gruebler.base.errors import LinkageError
from gruebler.mechanics.linkages.elements import Element, Wheel
from gruebler.structure.mechanism import Mechanism

Elements = Mapping[tuple[int, str], Element]
_SAME = 1e-9  # of a length: a distance that fits


class _Sized(Protocol):
    """A linkage."""

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def elements(self) -> Elements: ...


class Carrier(NamedTuple):
    """The link that holds the centres of two wheels or circles, and their distance on it."""

    link: str
    distance: float
    direction: float
    """Of the second centre, seen from the first, in the link's coordinates."""


def rolling_factors(first: Wheel, second: Wheel) -> tuple[float, float]:
    """What the turns of two wheels against the line of centres are multiplied by; exact from tooth numbers.

    >>> rolling_factors(Wheel(0, 0, 12.3, teeth=20), Wheel(0, 0, -36.9, teeth=-60))
    (10.0, -30.0)
    >>> rolling_factors(Wheel(0, 0, 20.0, belt="open"), Wheel(0, 0, 30.0, belt="open"))
    (20.0, -30.0)
    """
    a, b = first.radius, second.radius
    if first.teeth and second.teeth:
        scale = 2.0 ** floor(log2(abs(a / first.teeth)))
        a, b = first.teeth * scale, second.teeth * scale
    return a, -b if first.belt == "open" else b


def round_joints(mechanism: Mechanism, elements: Elements) -> dict[int, tuple[str, str]]:
    """The joints with a wheel or another round element, and their links."""
    chain = mechanism.chain
    return {
        number: (joint.links[0], joint.links[1])
        for number, joint in enumerate(chain.joints)
        if any(elements[number, link].is_round for link in joint.links)
    }


def sliding_joint(linkage: _Sized, number: int) -> bool:
    """Whether one link of a joint slides, or rolls, along a line of the other."""
    links = linkage.mechanism.chain.joints[number].links
    return any(linkage.elements[number, link].is_line for link in links)


def carriers(mechanism: Mechanism, elements: Elements) -> dict[int, Carrier]:
    """For each pair of wheels or circles the link that carries both centres by pins, if there is one."""
    wheels = round_joints(mechanism, elements)
    if not wheels:
        return {}
    axis = _axes(mechanism, elements)
    arms = {}
    for number, (a, b) in wheels.items():
        if not all(elements[number, link].is_round for link in (a, b)):
            continue
        for link in mechanism.chain.links:
            ends = [
                next(
                    (e for (n, owner), e in elements.items() if owner == link and axis.get((n, owner)) == wanted), None
                )
                for wanted in (axis[number, a], axis[number, b])
            ]
            if link not in (a, b) and ends[0] is not None and ends[1] is not None:
                x, y = ends[1].x - ends[0].x, ends[1].y - ends[0].y
                arms[number] = Carrier(link, hypot(x, y), atan2(y, x))
                break
    return arms


def _axes(mechanism: Mechanism, elements: Elements) -> dict[tuple[int, str], tuple[int, str]]:
    """For each pin and centre one that stands for all on the same axis."""
    centres = {key: e for key, e in elements.items() if not e.is_line}
    axis = {key: key for key in centres}

    def merge(first: tuple[int, str], second: tuple[int, str]) -> None:
        old, new = axis[first], axis[second]
        for key, at in axis.items():
            if at == old:
                axis[key] = new

    for first, e in centres.items():
        for second, f in centres.items():
            joined = first[0] == second[0] and mechanism.chain.joints[first[0]].pair.is_turning
            near = hypot(e.x - f.x, e.y - f.y) <= _SAME * max(abs(e.x), abs(e.y), abs(f.x), abs(f.y))
            if joined or (first[1] == second[1] and near):
                merge(first, second)
    return axis


def resolve_wheels(mechanism: Mechanism, elements: Elements) -> dict[tuple[int, str], Element]:
    """The elements with a radius for each wheel that has tooth numbers only: from the distance of the centres."""
    resolved = dict(elements)
    bare = {number for (number, _), e in elements.items() if isinstance(e, Wheel) and not e.radius}
    held = carriers(mechanism, elements) if bare else {}
    for number in bare:
        links = mechanism.chain.joints[number].links
        wheels = [e for e in (elements[number, link] for link in links) if isinstance(e, Wheel)]
        teeth = sum(wheel.teeth for wheel in wheels)
        fit = len(wheels) == 2 and all(wheel.teeth and not wheel.radius for wheel in wheels) and teeth
        if number not in held or not fit or wheels[0].belt:
            raise LinkageError(
                "{joint}: tooth numbers without a radius or module need wheels with tooth numbers on both "
                "links, and a link that carries both centres by pins",
                joint=mechanism.chain.joint_title(number),
            )
        for link, wheel in zip(links, wheels, strict=True):
            resolved[number, link] = replace(wheel, radius=held[number].distance * wheel.teeth / abs(teeth))
    return resolved


def redundant_wheels(mechanism: Mechanism, elements: Elements) -> set[int]:
    """The pairs of wheels on common arms that repeat what pairs before them say, such as those of a second planet."""
    known: list[dict[str, Fraction]] = []
    redundant = set()
    for number, arm in carriers(mechanism, elements).items():
        a, b = mechanism.chain.joints[number].links
        first, second = elements[number, a], elements[number, b]
        if not isinstance(first, Wheel) or not isinstance(second, Wheel):
            continue
        size_a, size_b = (Fraction(x) for x in rolling_factors(first, second))
        row = {a: size_a, b: size_b}
        row[arm.link] = row.get(arm.link, Fraction(0)) - size_a - size_b
        row.pop(mechanism.frame, None)
        for other_row in known:
            pivot = next(iter(other_row))
            share = row.get(pivot, Fraction(0)) / other_row[pivot]
            row = {k: row.get(k, Fraction(0)) - share * other_row.get(k, Fraction(0)) for k in {**row, **other_row}}
        row = {k: value for k, value in row.items() if value}
        if row:
            known.append(row)
        else:
            redundant.add(number)
    return redundant
