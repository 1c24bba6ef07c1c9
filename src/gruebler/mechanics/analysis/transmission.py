"""The transmission angle in the generalised sense, along a motion and at its extremes.

After Alt: the angle between the absolute path of the point at which a group drives its output, and the path of that
point relative to what drives the group; the smallest of those on the way from the drive to the output. Definitions and
proofs: docs/theory/events.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import LinkageError
from gruebler.base.events import Transmission, TransmissionExtremes
from gruebler.base.jets import turn_derivative
from gruebler.mechanics.analysis.cam_contacts import (
    LinkPlace,
    Push,
    bodies_of,
    cam_contacts,
    face_push,
    joint_motion,
    link_place,
    roller_push,
)
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.root_finding import find_zeros
from gruebler.structure.assur import SolvedGroup
from gruebler.structure.chain.pairs import Pair, pair

_SLOW = 1e-7  # of the fastest motion in the same pose: a velocity below it has no direction of its own
_LEAST = 1e-10  # of the natural size: the turning of the force, or the sine of its angle, that is none
_DYAD = 2  # links
_CONSTANT = 1e-8  # radians: an angle that varies by less is constant; next to change points half the digits are lost


class NoTransmissionAngleError(LinkageError):
    """The output has no transmission angle; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PushingLink:
    """A link (or a body of several) that pushes another at one joint."""

    links: tuple[str, ...]
    outer: LinkPlace
    inner: LinkPlace
    pairs: tuple[Pair, Pair]
    """Of the outer joint, on the side of the drive, and of the inner one, on the side of the output."""
    pushed: str
    """The link that it pushes."""
    guide: tuple[Pair, LinkPlace] | None
    """By which one joint the pushed link is held, on the frame or, in a dyad, on a link that moves: its pair, and the
    joint there, else on the pushed link."""
    cam: bool = False
    """Whether it is a cam: ``outer`` is its axis, ``inner`` the roller's centre or the flat face of the follower, and
    the pairs are those of the link that replaces the contact for small motions."""

    @property
    def form(self) -> str:
        """Its joints in letters, such as RP."""
        return "".join(pair.symbol() for pair in self.pairs)

    @property
    def slide(self) -> LinkPlace | None:
        """The joint that slides, across which it pushes; without one it pushes along the line of its pins."""
        outer, inner = self.pairs
        return self.outer if outer.is_sliding else self.inner if inner.is_sliding else None

    @property
    def pin(self) -> LinkPlace:
        """The pin on the line of the push, that nearer to the output."""
        return self.outer if self.pairs[1].is_sliding else self.inner


@dataclass(frozen=True, slots=True)
class ForcePath:
    """How the force of the drive comes to the output."""

    legs: tuple[PushingLink, ...]
    """Those of the output's group, then those of the groups on which that one hangs."""
    undefined: tuple[str, ...]
    """The links of groups on the way in which there is no leg, or one that transmits a couple only."""


def pushing_links(plan: Plan, output: Output) -> tuple[PushingLink, ...]:
    """The legs by which the drive moves the output, as `force_path` finds them."""
    return force_path(plan, output).legs


def force_path(plan: Plan, output: Output) -> ForcePath:
    """Follow the force from the output back to the drive, group by group; what stands still on a body is part of it.

    A leg is a body of a group with one outer and one inner joint. It drives if it hangs on a link that moves, or has
    the drive in itself. The body that is loaded is a leg only if there is no other.

    Raises `NoTransmissionAngleError` with a sentence that says why the group of the output has no leg.
    """
    if plan.released:
        raise NoTransmissionAngleError(
            "there is no transmission angle: the linkage is overconstrained, and how its joints share the force "
            "depends on their stiffness"
        )
    groups = plan.decomposition.groups
    own = next((k for k, group in enumerate(groups) if any(output.link in body for body in bodies_of(group))), None)
    if own is None:
        raise NoTransmissionAngleError(
            "there is no transmission angle: {link!r} is moved by the drive itself", link=output.link
        )
    fixed = _fixed_groups(plan)
    path: list[PushingLink] = []
    undefined: list[str] = []
    loaded = {output.link}
    for k, group in reversed(list(enumerate(groups[: own + 1]))):
        links = [link for body in bodies_of(group) for link in body]
        if loaded.isdisjoint(links):
            continue
        if k in fixed:
            loaded |= fixed[k]
            continue
        legs = _legs(plan, group, loaded)
        couple = next(filter(_is_couple, legs), None)
        if not path and not undefined:
            if not legs:
                raise NoTransmissionAngleError(
                    "there is no transmission angle: no link with two joints drives the output"
                )
            if couple:
                raise NoTransmissionAngleError(
                    "there is no transmission angle: {links} slides at both ends and transmits a couple only",
                    links=", ".join(couple.links),
                )
        if not legs or couple:
            undefined += links
        else:
            path += legs
        loaded |= _holders(plan, group)
    if not path:
        raise NoTransmissionAngleError(
            "there is no transmission angle: {link!r} is moved by the drive itself", link=output.link
        )
    return ForcePath(tuple(path), tuple(undefined))


def in_line(plan: Plan, output: Output) -> bool:
    """Whether the output turns back where a crank and the coupler that pushes it lie in line: in its dead centres.

    So it is with the rocker of a four-bar and a slider on a rod, be there more loops behind. Other outputs only turn
    back: those that float, behind a second dyad, or pushed across a slide.
    """
    mechanism, drive = plan.lower.mechanism, plan.lower.mechanism.drives[0]
    try:
        path = force_path(plan, output)
    except NoTransmissionAngleError:
        return False
    leg, *others = path.legs
    if others or path.undefined or leg.slide is not None or output.link != leg.pushed:
        return False
    joint = mechanism.chain.joints[drive.joint]
    held = any({mechanism.frame, output.link} <= {*each.links} for each in mechanism.chain.joints)
    return held and joint.pair.is_turning and mechanism.frame in joint.links


def _fixed_groups(plan: Plan) -> dict[int, set[str]]:
    """Groups by number that hang on one body and so stand still on it, and the links of that body that hold them.

    Three bars that form a triangle are such a body: two of them hang on the third.
    """
    mechanism = plan.lower.mechanism
    bodies = DisjointSets(mechanism.chain.links)
    fixed: dict[int, set[str]] = {}
    for k, group in enumerate(plan.decomposition.groups):
        for first, *others in bodies_of(group):
            for other in others:
                bodies.unite(first, other)
        inside = {link for body in bodies_of(group) for link in body}
        if any(set(drive.between) <= inside for drive in mechanism.drives):
            continue
        outer = [
            [link for link in mechanism.chain.joints[number].links if link not in inside] for number in group.outer
        ]
        common = set.intersection(*({bodies.find(link) for link in links} for links in outer))
        if common:
            fixed[k] = {link for links in outer for link in links if bodies.find(link) in common} - {mechanism.frame}
            for link in inside:
                bodies.unite(next(iter(common)), link)
    return fixed


def _is_couple(leg: PushingLink) -> bool:
    return all(pair.is_sliding for pair in leg.pairs)


def _legs(plan: Plan, group: SolvedGroup, loaded: set[str]) -> list[PushingLink]:
    """The legs of a group by which loaded links of it are moved."""
    driven = [k for k in range(len(group.bodies)) if _is_driven(plan, group, k)]
    legs = {k: leg for k in driven if (leg := _leg(plan, group, k)) is not None}
    others = {k: leg for k, leg in legs.items() if loaded.isdisjoint(bodies_of(group)[k])}
    return list((others or legs).values()) or _cams(plan, group)


def _cams(plan: Plan, group: SolvedGroup) -> list[PushingLink]:
    """The cams that push bodies of a group."""
    return [
        PushingLink(
            links=(contact.cam[0],),
            outer=contact.cam,
            inner=contact.follower,
            pairs=(pair("revolute"), pair("prismatic" if contact.flat else "revolute")),
            pushed=contact.follower[0],
            guide=_guide(plan, group, contact.body, but=contact.joint),
            cam=True,
        )
        for contact in cam_contacts(plan, group)
    ]


def _holders(plan: Plan, group: SolvedGroup) -> set[str]:
    """The links that move and on which a group hangs: what acts on the group acts on these."""
    chain, frame = plan.lower.mechanism.chain, plan.lower.mechanism.frame
    inside = {link for body in bodies_of(group) for link in body}
    outer = [number for number, member in group.joints if member.outer]
    return {link for number in outer for link in chain.joints[number].links} - inside - {frame}


def _is_driven(plan: Plan, group: SolvedGroup, body: int) -> bool:
    mechanism, links = plan.lower.mechanism, bodies_of(group)[body]
    if set(mechanism.drives[0].between) <= set(links):
        return True
    inside = {link for b in bodies_of(group) for link in b}
    for number, member in group.joints:
        if member.outer and body in member.links:
            holders = [link for link in mechanism.chain.joints[number].links if link not in inside]
            return mechanism.frame not in holders
    return False


def _leg(plan: Plan, group: SolvedGroup, body: int) -> PushingLink | None:
    joints = [(n, m) for n, m in group.joints if body in m.links]
    outer, inner = ([(n, m) for n, m in joints if m.outer == side] for side in (True, False))
    if len(outer) != 1 or len(inner) != 1:
        return None
    if any(not member.pair.is_basic for _, member in joints):
        return None  # a wheel or cam
    links = bodies_of(group)
    other = next(k for k in inner[0][1].links if k != body)
    pushed = link_place(plan, inner[0][0], links[other])[0]
    return PushingLink(
        links=group.bodies[body],
        outer=link_place(plan, outer[0][0], links[body]),
        inner=link_place(plan, inner[0][0], links[body]),
        pairs=(outer[0][1].pair, inner[0][1].pair),
        pushed=pushed,
        guide=_guide(plan, group, other),
    )


def _guide(plan: Plan, group: SolvedGroup, body: int, but: int | None = None) -> tuple[Pair, LinkPlace] | None:
    frame = plan.lower.mechanism.frame
    held = [(n, m) for n, m in group.joints if m.outer and body in m.links and n != but]
    if len(held) != 1:
        return None
    number, member = held[0]
    at_frame = frame in plan.lower.mechanism.chain.joints[number].links
    if not at_frame and (len(group.bodies) != _DYAD or not member.pair.is_basic):
        return None
    return member.pair, link_place(plan, number, (frame,) if at_frame else bodies_of(group)[body])


class ForceAndWay(NamedTuple):
    """The force on the pushed link and the direction in which its point goes, with derivatives; complex, (rows,)."""

    force: Complexes
    force_rate: Complexes
    direction: Complexes
    direction_rate: Complexes


def lines_of(motion: Motion, leg: PushingLink) -> ForceAndWay:
    """Force and way of a leg; the motion is of order 2."""
    force, force_rate, at, velocity = push_of(motion, leg)
    if leg.guide is not None:
        held_by, place = leg.guide
        if held_by.is_sliding:
            across, across_rate = _normal(motion, place)
            return ForceAndWay(force, force_rate, -1j * across, -1j * across_rate)
        held = joint_motion(motion, place)
        return ForceAndWay(force, force_rate, 1j * (at - held[0]), 1j * (velocity - held[1]))
    return ForceAndWay(force, force_rate, *_velocity(motion, leg.pushed, at, velocity))


def push_of(motion: Motion, leg: PushingLink) -> Push:
    """The force of a leg and where it acts; the motion is of order 2."""
    if leg.cam:
        return (roller_push if leg.slide is None else face_push)(motion, leg.outer, leg.inner)
    at, velocity, _ = joint_motion(motion, leg.pin)
    if leg.slide is not None:
        return Push(*_normal(motion, leg.slide), at, velocity)
    outer = joint_motion(motion, leg.outer)
    return Push(at - outer[0], velocity - outer[1], at, velocity)


def _normal(motion: Motion, element: LinkPlace) -> tuple[Complexes, Complexes]:
    k = motion.link_index(element[0])
    normal = 1j * motion.turns[:, k] * element[2]
    return normal, turn_derivative(motion.rates[:, :, k], 1) * normal


def _velocity(motion: Motion, link: str, at: Complexes, moves: Complexes) -> tuple[Complexes, Complexes]:
    """The velocity of the place of a link where a point is, with its rate; at rest the way it leaves."""
    k = motion.link_index(link)
    w, spin = motion.rates[0, :, k], motion.rates[1, :, k]
    origin, speed, change = (motion.places[m, :, k] for m in range(3))
    velocity = speed + 1j * w * (at - origin)
    rate = change + 1j * spin * (at - origin) + 1j * w * (moves - speed)
    fastest = np.maximum(np.abs(motion.places[1]).max(axis=1), motion.size * np.abs(motion.rates[0]).max(axis=1))
    rest = np.abs(velocity) < _SLOW * fastest
    return np.where(rest, rate, velocity), np.where(rest, 0, rate)


def _pace(motion: Motion) -> Reals:
    """How fast the joints move, as points of all their links; (rows,)."""
    elements = motion.lower_linkage.elements.items()
    speeds = [joint_motion(motion, (link, complex(e.x, e.y), 1))[1] for (_, link), e in elements]
    return np.asarray(np.linalg.norm(speeds, axis=0))


def _folded(lines: ForceAndWay) -> Reals:
    product = np.conj(lines.force) * lines.direction
    return np.asarray(np.arctan2(np.abs(product.real), np.abs(product.imag)))


def transmission_angle(motion: Motion, output: str | None = None) -> Reals:
    """The transmission angle mu in each pose, at most pi/2; on the way from the drive the smallest; (rows,).

    Raises `LinkageError` if the motion has no accelerations (``order=2``), or there is no transmission angle.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> motion = move(FourBar(2, 5, 4, 5).linkage(), [0.0, pi], order=2)
    >>> np.degrees(transmission_angle(motion)).round(4).tolist()
    [36.8699, 78.463]
    """
    if motion.order < 2:
        raise LinkageError("the transmission angle needs a motion with accelerations: move(..., order=2)")
    legs = pushing_links(motion.plan, find_output(motion.linkage, output))
    return np.asarray(np.min([_folded(lines_of(motion, leg)) for leg in legs], axis=0))


def deviation_angle(motion: Motion, output: str | None = None) -> Reals:
    """The deviation angle alpha, pi/2 less the transmission angle; (rows,)."""
    return pi / 2 - transmission_angle(motion, output)


def measure_transmission(cycle: Course, output: Output) -> TransmissionExtremes:
    """The extremes of the transmission angle over the whole range of the drive.

    They are zeros of three functions: of the turning of the force against the way, of their sine (mu = 90 degrees)
    and of their cosine (mu = 0); and the ends of the range.

    Raises `LinkageError` if there is no transmission angle, with the reason.
    """
    path = force_path(cycle.plan, output)
    legs = path.legs
    extremes = []
    for leg in legs:
        places, ends = _stationary(cycle, leg)
        values = _folded(lines_of(cycle.at(places, 2), leg)) if len(places) else places
        extremes += [
            Transmission(cycle.span.wrapped(float(x)), float(mu), leg.links)
            for x, mu in zip(places, values, strict=True)
        ]
        extremes += [Transmission(x, mu, leg.links) for x, mu in ends]
    ordered = [extreme for together in cycle.by_place(extremes) for extreme in together]
    smallest = _first(ordered, min(extreme.mu for extreme in ordered))
    extrema = [extreme for extreme in ordered if extreme.links == smallest.links]
    largest = _first(extrema, max(extreme.mu for extreme in extrema))
    return TransmissionExtremes(
        extremes=tuple(ordered),
        smallest=smallest,
        largest=largest,
        legs=tuple(leg.links for leg in legs),
        cams=tuple(leg.links for leg in legs if leg.cam),
        undefined=path.undefined,
    )


def _first(extremes: list[Transmission], mu: float) -> Transmission:
    """The first extreme with a transmission angle: of equal ones rounding chooses none."""
    return next(extreme for extreme in extremes if abs(extreme.mu - mu) <= _CONSTANT)


def _stationary(cycle: Course, leg: PushingLink) -> tuple[Reals, list[tuple[float, float]]]:
    """Where the folded angle has a local extreme, and its values at the ends of a range."""

    def product(motion: Motion) -> Complexes:
        lines = lines_of(motion, leg)
        normed: Complexes = np.conj(lines.force) * lines.direction / (np.abs(lines.force) * np.abs(lines.direction))
        return normed

    def turning(drives: Reals) -> Reals:
        lines = lines_of(cycle.at(drives, 2), leg)
        return np.imag(lines.force_rate / lines.force - lines.direction_rate / lines.direction)[None]

    def sine(drives: Reals) -> Reals:
        return product(cycle.at(drives, 2)).imag[None]

    def cosine(drives: Reals) -> Reals:
        return product(cycle.at(drives, 2)).real[None]

    def unnormed(motion: Motion) -> Complexes:
        """As `product`, but smooth where the driven point is slow next to a limit: of a speed by that of all joints."""
        lines = lines_of(motion, leg)
        pace = np.abs(lines.direction) if leg.guide is not None else _pace(motion)
        return np.asarray(np.conj(lines.force) * lines.direction / (np.abs(lines.force) * pace))

    slow = _LEAST / cycle.drive_size
    angles = _folded(lines_of(cycle.at(cycle.grid, 2), leg))
    constant = not cycle.joints and np.quantile(np.abs(angles - np.median(angles)), 0.9) <= _CONSTANT
    places = [
        zero.at
        for jet, floor in ((turning, slow), (sine, _LEAST), (cosine, _LEAST))
        for zero in (() if constant else find_zeros(jet, cycle.samples(2), floor))
    ]
    if leg.cam:  # where its law passes to the next piece, the angle may have a corner
        places += cycle.joints
    if cycle.span.full:
        return np.array(places or [cycle.span.low]), []
    ends = []
    for upper, at in ((False, cycle.span.low), (True, cycle.span.high)):
        z = cycle.end(unnormed, upper)
        ends.append((at, float(np.arctan2(abs(z.real), abs(z.imag)))))
    return np.array(places), ends
