"""Wheels, cams and rollers in structure pictures: each is centred on its bearing and touches the other body.

Two round bodies touch on the line between their bearings, so that their joint is no point of the layout; a round body
touches another one near its bearing. Bearings that lie on one axis are one point.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import product
from typing import NamedTuple

from gruebler.pictures.canvas.shapes import Point
from gruebler.structure.chain import Chain

_TOOTHED = frozenset({"gear", "ring"})
_ROUND = _TOOTHED | {"wheel", "belt", "crossed", "cam", "roller", "geneva-driver", "geneva-wheel", "oval"}
_PARTS = {("cam", "roller"): 0.68, ("roller", "cam"): 0.32, ("oval", "oval"): 0.35}
"""Of the distance of two bearings: the radius of the first body; half of it for all others."""
_PLANET = 0.36  # that of a wheel inside another one, and of a wheel in the place of one that would cover another
_ALONE = {"roller": 0.2}
"""Of the distance of a bearing and a contact in the layout: the radius of a body that touches one without bearing."""
_USUAL = 0.55
_SAME = 1e-6  # of a radius
_CORNERS = 16  # of the outline of a wheel, beside which its name stands
_INSIDE = {"ring": -3.0}
"""Pixels by which that outline lies inside the rim."""
_USUALLY_INSIDE = 2.0
_SEEN = {"cam": 0.7, "oval": 0.55, "belt": 0.6, "crossed": 0.6, "geneva-driver": 0.6}
"""Of the radius to the contact: that of the outline, for bodies that are mostly smaller."""


class RoundBody(NamedTuple):
    """A round body in a picture."""

    centre: Point
    radius: float
    """From the centre to the contact, in pixels."""
    is_new: bool
    """Whether no other joint draws the same wheel."""

    def outline(self, shape: str) -> tuple[Point, ...]:
        """Corners a little inside the rim of a body of this shape."""
        radius = _SEEN.get(shape, 1.0) * self.radius - _INSIDE.get(shape, _USUALLY_INSIDE)
        turns = [math.tau * k / _CORNERS for k in range(_CORNERS)]
        return tuple(self.centre.plus(Point(math.cos(x), math.sin(x)), radius) for x in turns)


class RoundContact(NamedTuple):
    """A joint of a round body; the bearing of a body is a point of the layout, None for one that is not round."""

    joint: int
    links: tuple[str, str]
    shapes: tuple[str, str]
    bearings: tuple[int | None, int | None]


class WheelPoints(NamedTuple):
    """The points of the layout of a chain with round bodies."""

    point_of: tuple[int | None, ...]
    """For each joint its point; None where two round bodies touch between their bearings."""
    contacts: tuple[RoundContact, ...]

    def bodies(self, chain: Chain, frame: str | None) -> dict[str, tuple[int, ...]]:
        """The points of each link that is more than a wheel or a single bearing of the frame."""
        rims = {
            (contact.joint, link)
            for contact in self.contacts
            for link, at in zip(contact.links, contact.bearings, strict=True)
            if at is not None
        }
        small = {link for _, link in rims} | ({frame} if rims else set())
        bodies = {}
        for link in chain.links:
            own = [
                self.point_of[k]
                for k, joint in enumerate(chain.joints)
                if link in joint.links and (k, link) not in rims
            ]
            places = tuple(dict.fromkeys(p for p in own if p is not None))
            if len(places) > 1 or link not in small:
                bodies[link] = places
        return bodies

    def sides(self, bodies: Sequence[tuple[int, ...]]) -> list[tuple[int, int]]:
        """The lines between bearings, or bearing and contact, along which no body lies."""
        lines: list[tuple[int, int]] = []
        for contact in self.contacts:
            a, b = self._ends(contact)
            if not any({a, b} <= set(body) for body in (*bodies, *lines)):
                lines.append((a, b))
        return lines

    def _ends(self, contact: RoundContact) -> tuple[int, int]:
        """The bearings of a contact; for a body that is not round the contact itself."""
        a, b = (self.point_of[contact.joint] if at is None else at for at in contact.bearings)
        assert a is not None  # a contact between two bearings has both
        assert b is not None
        return a, b

    def touching(self, points: list[Point]) -> tuple[list[Point], dict[tuple[int, str], RoundBody]]:
        """The place of every joint and the wheels by joint and link; points of contacts move to their wheels."""
        wheels: dict[tuple[int, str], RoundBody] = {}
        between: dict[int, Point] = {}
        for contact in sorted(self.contacts, key=lambda contact: ("ring" not in contact.shapes, contact.joint)):
            own = self.point_of[contact.joint]
            a, b = self._ends(contact)
            ends = points[a], points[b]
            radii = _radii(contact, ends[0], ends[1], wheels)
            first = 1 if contact.bearings[0] is None or contact.shapes[1] == "ring" else 0
            touch = ends[first].plus(ends[1 - first].minus(ends[first]).unit, radii[first])
            between[contact.joint] = touch
            if own is not None:
                points[own] = touch
            for link, at, centre, radius in zip(contact.links, contact.bearings, ends, radii, strict=True):
                if at is not None:
                    new = not any(_is_same(w, centre, radius) for (_, owner), w in wheels.items() if owner == link)
                    wheels[contact.joint, link] = RoundBody(centre, radius, new)
        return [between.get(k) or points[p or 0] for k, p in enumerate(self.point_of)], wheels


def _is_same(wheel: RoundBody, centre: Point, radius: float) -> bool:
    return wheel.centre == centre and abs(wheel.radius - radius) <= _SAME * radius


def _radii(
    contact: RoundContact, a: Point, b: Point, wheels: Mapping[tuple[int, str], RoundBody]
) -> tuple[float, float]:
    """The radii of two bodies that touch, those of wheels that are there already kept if that is possible."""
    apart = b.minus(a).length
    known = [
        next((w.radius for (_, owner), w in wheels.items() if owner == link and w.centre == centre), None)
        for link, centre in zip(contact.links, (a, b), strict=True)
    ]
    if None in contact.bearings:
        near = [
            _ALONE.get(shape, _USUAL) * apart if r is None else r
            for shape, r in zip(contact.shapes, known, strict=True)
        ]
        return near[0], near[1]
    if "ring" in contact.shapes:
        ring = contact.shapes.index("ring")
        outer, planet = known[ring], known[1 - ring] or _PLANET * apart
        if outer is not None and outer > apart:
            planet = outer - apart
        return (apart + planet, planet) if ring == 0 else (planet, apart + planet)
    part = _PARTS.get(contact.shapes, 0.5)
    choices = [r for r in (known[0], None if known[1] is None else apart - known[1]) if r is not None]
    choices = [r for r in choices if 0.1 * apart < r < 0.9 * apart] + [part * apart, _PLANET * apart]
    for first in choices:
        covers = (
            owner != link and _is_same(wheel, centre, radius)
            for (_, owner), wheel in wheels.items()
            for link, centre, radius in zip(contact.links, (a, b), (first, apart - first), strict=True)
        )
        if not any(covers):
            return first, apart - first
    return choices[0], apart - choices[0]


def wheel_points(chain: Chain, frame: str | None, shapes: Mapping[tuple[int, str], str]) -> WheelPoints:
    """The points of the layout; ``shapes`` says by joint and link what the bodies of higher pairs are."""
    turning = [k for k, joint in enumerate(chain.joints) if joint.pair.is_turning]
    axes = [chain.joints[k].links for k in turning]
    pairs: dict[int, tuple[str, str]] = {}
    for k, joint in enumerate(chain.joints):
        if len(joint.links) == 2 and all((k, link) in shapes for link in joint.links):
            pairs[k] = (shapes[k, joint.links[0]], shapes[k, joint.links[1]])
            if _TOOTHED.issuperset(pairs[k]):
                axes = coaxial(axes, joint.links, frame, chain.degrees)
    if len(axes) == len(turning):
        first = dict(zip(turning, turning, strict=True))
    else:
        own = [set(chain.joints[k].links) for k in turning]
        first = {
            k: next(j for j, a in zip(turning, own, strict=True) if any(a | b <= set(axis) for axis in axes))
            for k, b in zip(turning, own, strict=True)
        }
    contacts = [
        RoundContact(k, (chain.joints[k].links[0], chain.joints[k].links[1]), kinds, bearings)
        for k, kinds in pairs.items()
        if (bearings := _bearings(chain, k, kinds, first, frame)) != (None, None)
    ]
    between = {contact.joint for contact in contacts if None not in contact.bearings}
    kept = [k for k in range(len(chain.joints)) if first.get(k, k) == k and k not in between]
    number: dict[int | None, int] = {k: p for p, k in enumerate(kept)}
    return WheelPoints(
        tuple(None if k in between else number[first.get(k, k)] for k in range(len(chain.joints))),
        tuple(
            contact._replace(bearings=(number.get(contact.bearings[0]), number.get(contact.bearings[1])))
            for contact in contacts
        ),
    )


def _bearings(
    chain: Chain, joint: int, kinds: tuple[str, str], first: Mapping[int, int], frame: str | None
) -> tuple[int | None, int | None]:
    """The bearings of the bodies of a joint, as first joints on their axes; None for a body that is not round.

    Those that one further link has in common come first, those of the frame before others; of a body alone there must
    be one bearing, or one in the frame.
    """
    links = chain.joints[joint].links
    on: dict[int, set[str]] = {}
    for k, begin in first.items():
        on.setdefault(begin, set()).update(chain.joints[k].links)
    options = [
        sorted((k for k in on if link in on[k] and kind in _ROUND), key=lambda k: (frame not in on[k], k))
        for link, kind in zip(links, kinds, strict=True)
    ]
    for a, b in product(*options):
        if a != b and on[a] & on[b] - set(links):
            return a, b
    alone = [own[0] if own and (len(own) == 1 or frame in on[own[0]]) else None for own in options]
    return (alone[0], alone[1]) if alone[0] != alone[1] else (None, None)


def coaxial(
    axes: list[tuple[str, ...]], gears: Sequence[str], frame: str | None, degrees: Mapping[str, int]
) -> list[tuple[str, ...]]:
    """The axes, those of two meshing wheels on different links with the bearing of these links on one of them.

    Both wheels keep their distance while the two links turn against each other only if that bearing is on one of the
    axes: on that of the wheel which the frame holds, else the link with more joints.
    """
    a, b = gears
    central = {link: (link == frame, joints) for link, joints in degrees.items()}
    bearings = []
    for first, second in product(*([axis for axis in axes if wheel in axis] for wheel in (a, b))):
        holders = [(f, c) for f in first for c in second if {f, c}.isdisjoint(gears)]
        if any(f == c for f, c in holders):
            return axes
        bearings += [
            (first if central[f] >= central[c] else second, bearing)
            for f, c in holders
            for bearing in axes
            if bearing not in (first, second) and f in bearing and c in bearing
        ]
    if not bearings:
        return axes
    kept, bearing = bearings[0]
    merged = tuple(dict.fromkeys(kept + bearing))
    return [merged if axis == kept else axis for axis in axes if axis != bearing]
