"""What acted on a linkage before it was drawn otherwise, on what is left of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from gruebler.base.errors import LinkageError
from gruebler.base.text import LANGUAGES
from gruebler.files import linkage_from_json
from gruebler.files.load_writing import loads_to_json
from gruebler.mechanics.forces import Loads, RigidBody, Spring
from gruebler.mechanics.forces.springs import check_between_links
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.elements import Pose2D
from gruebler.mechanics.linkages.points import PointLike, points_of
from gruebler.page.known_loads import loads_at_hand
from gruebler.page.model import names_of_points
from gruebler.page.params import DrawnBefore


def with_loads_before(model: dict[str, Any], linkage: Linkage, before: DrawnBefore) -> dict[str, Any]:
    """The model of a linkage that was drawn, with the loads of the one that it was before.

    Loads on links, joints and points that are gone are left out. Joints are the same if they have the same letter and
    a link in common, links if they have the same name and a joint in common, or another name and two joints.
    """
    old = linkage_from_json(before.document)
    loads, speed = loads_at_hand(before.document, before.source, old)
    if loads == Loads():
        return model
    page = model["document"].get("page") or {}
    change = _Change(
        old=old,
        source=before.source,
        new=linkage,
        drawn=before.links,
        letters_before=before.letters,
        letters=str(page.get("letters", "")).split(),
    )
    kept = loads_to_json(change.carried(loads), linkage, speed if change.same_drive else None)
    bars = (before.document.get("page") or {}).get("bars") or []
    if bars != "steel":
        links = linkage.mechanism.chain.links
        names = [change.links.get(old.mechanism.chain.links[number]) for number in bars]
        bars = [links.index(name) for name in names if name]
    document = model["document"] | {"loads": kept} | ({"page": page | {"bars": bars}} if bars else {})
    return model | {"document": document}


@dataclass(frozen=True, kw_only=True)
class _Change:
    """From a linkage to one that was drawn out of it."""

    old: Linkage
    source: str
    """Of which machine of the catalog the old one is, if it is one."""
    new: Linkage
    drawn: Sequence[str]
    """What the drawing called the links of the old one."""
    letters_before: Sequence[str]
    """Of the joints of the old one."""
    letters: Sequence[str]

    @cached_property
    def links(self) -> dict[str, str]:
        """Those that are still there, by their names before."""
        called = dict(zip(self.drawn, self.old.mechanism.chain.links, strict=True))
        before = _ends(self.old, self.letters_before, self.points)
        now = _ends(self.new, self.letters, {name: name for name in self.new.points})
        was = {name: before[called[name]] for name in called}
        same = {name: name for name in now if now[name] & was.get(name, set())}
        for name in now.keys() - called.keys():
            other = max(called.keys() - now.keys(), key=lambda each: len(was[each] & now[name]), default=None)
            if other is not None and len(was[other] & now[name]) > 1:
                same[other] = name
        return {called[name]: now_called for name, now_called in same.items()}

    @cached_property
    def points(self) -> dict[str, str]:
        """Points by their names before; the drawing calls those of the catalog in the language of its reader."""
        words = [{name: name for name in self.old.points}]
        words += [names_of_points(self.old, self.source, lang) for lang in LANGUAGES]
        return {name: called for names in words for name, called in names.items() if called in self.new.points}

    @cached_property
    def joints(self) -> dict[int, int]:
        """Those that are still there, by their numbers before."""
        numbers = {letter: number for number, letter in enumerate(self.letters)}
        joints, others = self.old.mechanism.chain.joints, self.new.mechanism.chain.joints
        pairs = ((k, numbers[letter]) for k, letter in enumerate(self.letters_before) if letter in numbers)
        return {k: m for k, m in pairs if {self.links.get(link) for link in joints[k].links} & {*others[m].links}}

    @property
    def same_drive(self) -> bool:
        """Whether one drive turns, or pushes, as one did before."""
        drives = [[drive.turning for drive in each.mechanism.drives] for each in (self.old, self.new)]
        return len(drives[0]) == 1 and drives[0] == drives[1]

    def spot(self, link: str, x: float, y: float) -> tuple[LinkPoint, float]:
        """Where a place of a link is now, and how much longer the link has become between its first two joints.

        The place goes with these joints, or with the only one.
        """
        name = self.links[link]
        pose, other = _pose(self.old, link), _pose(self.new, name)
        pins = [*self._pins(link, name)][:2]
        stretch = complex(1)
        if len(pins) > 1 and pins[0][0] != pins[1][0]:
            stretch = (pins[1][1] - pins[0][1]) / (pins[1][0] - pins[0][0])
        start, end = pins[0] if pins else (0j, 0j)
        place = end + stretch * (complex(*pose.put(x, y)) - start)
        return LinkPoint(name, *other.to_local(place.real, place.imag)), abs(stretch)

    def _pins(self, link: str, name: str) -> Iterator[tuple[complex, complex]]:
        """Where the joints of a link were, and are."""
        for k, m in self.joints.items():
            pin, other = self.old.elements.get((k, link)), self.new.elements.get((m, name))
            if pin and other and pin.is_pin and other.is_pin:
                yield (
                    complex(*_pose(self.old, link).put(pin.x, pin.y)),
                    complex(*_pose(self.new, name).put(other.x, other.y)),
                )

    def point(self, point: PointLike) -> PointLike | None:
        """The same point; none if it is gone."""
        if isinstance(point, str):
            if (number := self.old.mechanism.chain.find_joint(point)) is not None:
                names = self.new.mechanism.chain.joint_names()
                return names[self.joints[number]] if number in self.joints else None
            if point in self.old.points:
                called = self.points.get(point, point)
                now = self.new.points.get(called)
                return called if now and self.links.get(self.old.points[point].link) == now.link else None
        place = points_of(self.old, point)[0]
        return self.spot(place.link, place.x, place.y)[0] if place.link in self.links else None

    def carried(self, loads: Loads) -> Loads:
        """What still acts."""

        def kept(table: Mapping[Any, Any]) -> dict[Any, Any]:
            return {now: amount for each, amount in table.items() if (now := self.point(each)) is not None}

        bodies = {}
        for link in loads.bodies.keys() & self.links.keys():
            body, (place, factor) = loads.bodies[link], self.spot(link, *loads.bodies[link].centre)
            bodies[self.links[link]] = RigidBody(body.mass, (place.x, place.y), body.inertia * factor**2)
        driven = {self.new.mechanism.chain.joint_names()[drive.joint] for drive in self.new.mechanism.drives}
        return replace(
            loads,
            forces=kept(loads.forces),
            moments={self.links[link]: amount for link, amount in loads.moments.items() if link in self.links},
            masses=kept(loads.masses),
            bodies={link: bodies[link] for link in self.new.mechanism.chain.links if link in bodies},
            springs=tuple(self._springs(loads.springs)),
            torsion_springs=tuple(
                replace(each, between=(self.links[first], self.links[second]))
                for each in loads.torsion_springs
                for first, second in [each.between]
                if {first, second} <= self.links.keys()
            ),
            motors={joint: motor for joint, motor in kept(loads.motors).items() if joint in driven},
        )

    def _springs(self, springs: Sequence[Spring]) -> Iterator[Spring]:
        for each in springs:
            first, second = (self.point(end) for end in each.between)
            if first is None or second is None:
                continue
            spring = replace(each, between=(first, second))
            with suppress(LinkageError):  # both ends are on one link now
                check_between_links(self.new, spring, "springs")
                yield spring


def _ends(linkage: Linkage, letters: Sequence[str], points: Mapping[str, str]) -> dict[str, set[str]]:
    """The letters of the joints of each link, and what its points are called."""
    chain = linkage.mechanism.chain
    joints = list(zip(letters, chain.joints, strict=False))
    return {
        link: {letter for letter, joint in joints if link in joint.links}
        | {points[name] for name, point in linkage.points.items() if point.link == link and name in points}
        for link in chain.links
    }


def _pose(linkage: Linkage, link: str) -> Pose2D:
    return (linkage.reference_pose or {}).get(link) or Pose2D(0.0, 0.0, 0.0)
