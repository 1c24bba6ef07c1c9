"""Coulomb friction in the joints of a linkage, in equilibrium with the joint forces that make it."""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Collection, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cached_property

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import LinkageError, expect
from gruebler.base.notebook import brief
from gruebler.mechanics.forces.acting import Rows, Wrench
from gruebler.mechanics.forces.coulomb import Branches, Contacts, continued
from gruebler.mechanics.forces.equilibrium import (
    Reactions,
    joint_connections,
    joint_of_connection,
    link_loads,
    responses,
)
from gruebler.mechanics.forces.motion_rates import with_velocities
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.quantities import as_finite
from gruebler.mechanics.linkages.wheels import round_joints
from gruebler.structure.chain.spaces import Freedom

PerJoint = float | Mapping[str, float]
"""One number for all joints, or numbers by joint, ``"*"`` for all others; without that they have the default."""

_AT_REST = 1e-9  # of the fastest motion, lengths in sizes: a slower one has no direction
_NOISE = 1e-12  # of the loads: a smaller force is none
_LARGEST = 100.0  # coefficient; self-locking is sought up to it
_FACTORS = 1e9  # of the coefficients, at most, in that search
_PROPORTION = 1e6  # of the linkage's size: lengths are smaller; that of a guide is larger than its inverse


@dataclass(frozen=True)
class Friction:
    """Coefficients of friction, radii of pins and guides of slides: for all joints, or by joint.

    Lengths are in the linkage's unit. Without a radius a pin does not rub; without a length a guide is long: then what
    keeps the block from turning rubs no more than the normal force does.

    Raises `LinkageError` for numbers that are negative or not finite and for a length that is not positive.

    >>> Friction(0.1, pin_radius={"R(frame-crank)": 8}, guide_length=40).backward
    False
    """

    coefficient: PerJoint
    _: KW_ONLY
    pin_radius: PerJoint = 0.0
    """The pin of a joint of several links is fixed to the link named first."""
    guide_length: PerJoint = math.inf
    """Between the two edges at which a tilted block bears."""
    guide_height: PerJoint = 0.0
    """Between the two faces on which it slides; matters with a length only."""
    guide_on: Mapping[str, str] = field(default_factory=dict)
    """By slide, the link on whose point the guide is centred, and with which it moves; without it the later link, or
    the other one if that is the frame. A short bush on the frame: ``{"P(frame-rod)": "frame"}``."""
    sleeves: Collection[str] = ()
    """Slides whose later link (not the frame) surrounds the other one, instead of lying in it; matters with a height
    only."""
    backward: bool = False
    """Whether the drive goes backward. Otherwise it goes forward, or as the motion says whose speeds are given."""

    def __post_init__(self) -> None:
        for name in ("coefficient", "pin_radius", "guide_length", "guide_height"):
            given = getattr(self, name)
            for value in given.values() if isinstance(given, Mapping) else (given,):
                if name == "guide_length" and value == math.inf:
                    continue
                if as_finite(name, value) < 0:
                    raise LinkageError("{name} is not negative, but found {found!r}", name=name, found=value)
                if name == "coefficient" and value > _LARGEST:
                    raise LinkageError(
                        "a coefficient of friction is {largest:g} at most, but found {found!r}",
                        largest=_LARGEST,
                        found=value,
                    )
                if name == "guide_length" and not value:
                    raise LinkageError("{name} is positive, but found {found!r}", name=name, found=value)


@dataclass(frozen=True, kw_only=True)
class RubbingContact:
    """Where two links of the linkage as it was solved rub on each other."""

    joint: int
    """Of the linkage."""
    link: str
    """That rubs there on the pin, or on the line, of the other link."""
    connection: int
    """In the arrays of `Reactions`."""
    slides: bool
    coefficient: float
    radius: float
    length: float
    height: float
    """Negative where the second link surrounds the first."""
    centred_on_first: bool

    @property
    def lever(self) -> float:
        """Of the friction: 1 for a force, the radius for a moment, times the coefficient."""
        return self.coefficient * (1.0 if self.slides else self.radius)


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class FrictionForces:
    """What rubs, row by row, and where friction locks; the first axis is always that of the rows."""

    contacts: tuple[RubbingContact, ...]
    branches: Branches
    directions: Reals
    """(rows, contacts): the sense in which the second link slides or turns against the first; 0 at rest."""
    rates: Reals
    """(rows, contacts, drives): by how much it does for each drive alone."""
    frictionless: Reals
    """(rows, drives): the drives' efforts by virtual work without friction."""

    @property
    def normal(self) -> Reals:
        """(rows, contacts): the force on a pin, or the sum of the forces on both edges of a block."""
        return self.branches.normal

    @cached_property
    def friction(self) -> Reals:
        """(rows, contacts): the sizes of friction forces of slides and of friction moments of pins."""
        moving: Reals = self._levers * self.normal * np.abs(self.directions)
        return moving

    @cached_property
    def effort(self) -> Reals:
        """(rows, drives): what friction adds to the drives' efforts, by the power that it takes."""
        lost: Reals = np.einsum("rc,rcd->rd", self._levers * self.normal * self.directions, self.rates)
        return lost

    @property
    def locking_factor(self) -> Reals:
        """(rows,): factor on all coefficients at which the equilibrium ends, the safety against self-locking.

        Infinite where there is none up to coefficients of 100, or a factor of 1e9; NaN where there are no forces.
        """
        return self.branches.factor

    @property
    def locked(self) -> Flags:
        """(rows,): where no effort, however large, moves the drive on: it is self-locking, it jams."""
        return np.asarray(np.isnan(self.normal).any(axis=1) & np.isfinite(self.locking_factor))

    @property
    def equilibria(self) -> Rows:
        """(rows,): how many were found; where it locks, apart from the one without friction."""
        return self.branches.equilibria

    @property
    def proved(self) -> Flags:
        """(rows,): whether it is proved that there is one equilibrium and no more."""
        return self.branches.single

    def locking_joint(self, row: int) -> int | None:
        """The joint on whose coefficient self-locking depends most; None if the row has none."""
        culprit = int(self.branches.culprit[row])
        return None if culprit < 0 else self.contacts[culprit].joint

    @cached_property
    def _levers(self) -> Reals:
        return np.array([contact.lever for contact in self.contacts])


def as_friction(given: Friction | PerJoint) -> Friction:
    """A coefficient alone is that of slides."""
    return given if isinstance(given, Friction) else Friction(given)


def with_friction(
    motion: Motion, wrenches: tuple[Wrench, ...], friction: Friction, work: Reals
) -> tuple[Reactions, FrictionForces]:
    """The forces of joints and drives with friction, and what rubs.

    Args:
        motion: The poses.
        wrenches: The loads.
        friction: Coefficients and sizes.
        work: (rows, drives) efforts without friction, by virtual work.

    Raises `LinkageError` for joints that are not there or have no such size, and for drives without a direction.
    """
    expect(friction, Friction)
    contacts = _contacts(motion, friction)
    rates = _rates(motion, contacts)
    directions = _directions(motion, contacts, rates, friction.backward)
    unknown: Flags = np.asarray(np.isnan(directions).any(axis=1))
    directions = np.where(unknown[:, None], 0.0, directions)
    units = [_unit(motion, contact, directions[:, k]) for k, contact in enumerate(contacts)]
    (free, *mutual), pressing = responses(motion, [link_loads(motion, case) for case in (wrenches, *units)])
    branches = _branches(motion, wrenches, contacts, directions, [free, *mutual, *pressing], unknown)
    normal, carried = np.split(branches.normal, [len(contacts)], axis=1)
    branches = branches._replace(normal=normal)
    forces = FrictionForces(contacts=contacts, branches=branches, directions=directions, rates=rates, frictionless=work)
    pressed = free.plus(zip(carried.T, pressing, strict=True))
    return _total(motion, pressed, mutual, forces), forces


# --- what rubs -------------------------------------------------------------------------------------


def _contacts(motion: Motion, friction: Friction) -> tuple[RubbingContact, ...]:
    """The contacts that rub: those with a coefficient and, of pins, a radius."""
    lower, mechanism = motion.lower_linkage.mechanism, motion.linkage.mechanism
    links, number_of = lower.chain.links, joint_of_connection(motion)
    sizes = {
        name: _by_joint(motion, name, getattr(friction, name), default, kind)
        for name, default, kind in (
            ("coefficient", 0.0, None),
            ("pin_radius", 0.0, Freedom.TURN_Z),
            ("guide_length", math.inf, Freedom.TRAVEL_X),
            ("guide_height", 0.0, Freedom.TRAVEL_X),
        )
    }
    centres = {mechanism.chain.joint_number(name, error=LinkageError): link for name, link in friction.guide_on.items()}
    sleeves = {mechanism.chain.joint_number(name, error=LinkageError) for name in friction.sleeves}
    for number in {*centres, *sleeves}:
        if not mechanism.chain.joints[number].pair.is_sliding:
            raise LinkageError("{joint} is not a slide of two links", joint=mechanism.chain.joint_title(number))
    contacts = []
    for k, connection in enumerate(joint_connections(motion)):
        number = number_of[connection.joint]
        coefficient, radius, length, height = (values[number] for values in sizes.values())
        if (
            not coefficient
            or not (connection.slides or radius)
            or not lower.chain.joints[connection.joint].pair.is_basic
        ):
            continue
        first, second = links[connection.first], links[connection.second]
        mover, other = (first, second) if _moves(first, second, motion) else (second, first)
        centre = centres.get(number, mover)
        if centre not in (first, second):
            raise LinkageError(
                "{joint} is not a joint of {link!r}", joint=mechanism.chain.joint_title(number), link=centre
            )
        contacts.append(
            RubbingContact(
                joint=number,
                link=mover if mover in mechanism.chain.links else other,
                connection=k,
                slides=connection.slides,
                coefficient=coefficient,
                radius=radius,
                length=length,
                height=height if (mover == second) != (number in sleeves) else -height,
                centred_on_first=centre == first,
            )
        )
    return tuple(contacts)


def _moves(first: str, second: str, motion: Motion) -> bool:
    """Whether the first link, not the second, is the block: one that was added, or else the one that moves."""
    known = motion.linkage.mechanism.chain.links
    if (first in known) != (second in known):
        return second in known
    return second == motion.linkage.mechanism.frame


def _by_joint(motion: Motion, name: str, given: PerJoint, default: float, rubbing: Freedom | None) -> list[float]:
    """One number for each joint of the linkage; a size only for joints that rub in this freedom."""
    mechanism = motion.linkage.mechanism
    chain = mechanism.chain
    named = given if isinstance(given, Mapping) else {"*": given}
    values = [float(named.get("*", default))] * len(chain.joints)
    for joint, value in named.items():
        if joint == "*":
            continue
        number = chain.joint_number(joint, error=LinkageError)
        pair, touching = chain.joints[number].pair, number in round_joints(mechanism, motion.linkage.elements)
        if rubbing and (touching or pair.rolls or rubbing not in pair.freedoms[chain.space]):
            raise LinkageError(
                "{name}: {joint} does not turn on a pin" if rubbing.turns else "{name}: {joint} does not slide",
                name=name,
                joint=chain.joint_title(number),
            )
        values[number] = float(value)
    least, most = motion.size / _PROPORTION if name == "guide_length" else 0.0, motion.size * _PROPORTION
    for value in values:
        if rubbing and value != default and not least <= value <= most:
            raise LinkageError(
                "{name} = {value:g} is out of all proportion to the linkage, whose size is {size:g}",
                name=name,
                value=value,
                size=motion.size,
            )
    return values


# --- how it moves ----------------------------------------------------------------------------------


def _rates(motion: Motion, contacts: Sequence[RubbingContact]) -> Reals:
    """(rows, contacts, drives): how fast the second link slides or turns against the first, for each drive alone."""
    drives = len(motion.linkage.mechanism.drives)
    rates = np.full((len(motion), len(contacts), drives), np.nan)
    for k in range(drives):
        for rows, moved in with_velocities(motion, np.eye(drives)[k]):
            for c, contact in enumerate(contacts):
                rates[rows, c, k] = _rate(moved, contact)
    return rates


def _rate(moved: Motion, contact: RubbingContact) -> Reals:
    connection = joint_connections(moved)[contact.connection]
    turning: Reals = moved.rates[0, :, connection.second] - moved.rates[0, :, connection.first]
    if not contact.slides:
        return turning
    (near, along), far = _line(moved, contact)
    first, second = connection.first, connection.second
    velocity = _velocity(moved, second, far) - _velocity(moved, first, near)
    arm = _place(moved, second, far) - _place(moved, first, near)
    seen: Reals = (np.conj(along) * (velocity - 1j * moved.rates[0, :, first] * arm)).real
    return seen


def _line(motion: Motion, contact: RubbingContact) -> tuple[tuple[complex, Complexes], complex]:
    """Of a slide: the first link's point and the direction of its line; the second link's point."""
    lower, connection = motion.lower_linkage, joint_connections(motion)[contact.connection]
    links = lower.mechanism.chain.links
    near, far = (lower.elements[connection.joint, links[k]] for k in (connection.first, connection.second))
    along = motion.turns[:, connection.first] * rect(1, near.direction)
    return (complex(near.x, near.y), along), complex(far.x, far.y)


def _place(motion: Motion, link: int, arm: complex) -> Complexes:
    return np.asarray(motion.places[0, :, link] + motion.turns[:, link] * arm)


def _velocity(motion: Motion, link: int, arm: complex) -> Complexes:
    return np.asarray(motion.places[1, :, link] + 1j * motion.rates[0, :, link] * motion.turns[:, link] * arm)


def _directions(motion: Motion, contacts: Sequence[RubbingContact], rates: Reals, backward: bool) -> Reals:
    """(rows, contacts): the sense of each contact's motion; 0 where it rests, NaN where velocities are unknown."""
    mechanism = motion.linkage.mechanism
    speeds = motion.speeds[0] if motion.speeds is not None and motion.order else None
    if speeds is None:
        if len(mechanism.drives) > 1:
            raise LinkageError(
                "with {count} drives the direction of friction depends on their speeds: give them to move(..., "
                "speed=...)",
                count=len(mechanism.drives),
            )
        speeds = np.ones((len(motion), 1))
    resting = np.flatnonzero(~speeds.any(axis=1))
    if resting.size:
        raise LinkageError(
            "the drive stands still in row {row}: there is no direction of friction", row=int(resting[0])
        )
    speeds = -speeds if backward else speeds
    by_size = np.array([motion.size if contact.slides else 1.0 for contact in contacts])
    moving = np.einsum("rcd,rd->rc", rates, speeds) / by_size
    turning = np.array([drive.turning for drive in mechanism.drives])
    fastest = np.maximum(
        np.abs(speeds / np.where(turning, 1.0, motion.size)).max(axis=1), np.abs(moving).max(axis=1, initial=0.0)
    )
    return np.where(np.abs(moving) <= _AT_REST * fastest[:, None], 0.0, np.sign(moving))


# --- equilibrium -----------------------------------------------------------------------------------


def _unit(motion: Motion, contact: RubbingContact, directions: Reals) -> tuple[Wrench, ...]:
    """The friction of a contact for a normal force of one, as loads on its two links."""
    connection = joint_connections(motion)[contact.connection]
    links, size = motion.lower_linkage.mechanism.chain.links, -contact.lever * directions
    none = np.zeros(len(motion))
    if not contact.slides:
        return tuple(
            Wrench(LinkPoint(links[k], 0.0, 0.0), none.astype(np.complex128), sign * size)
            for k, sign in ((connection.second, 1), (connection.first, -1))
        )
    (near, along), far = _line(motion, contact)
    return (
        Wrench(LinkPoint(links[connection.second], far.real, far.imag), size * along, none),
        Wrench(LinkPoint(links[connection.first], near.real, near.imag), -size * along, none),
    )


def _branches(
    motion: Motion,
    wrenches: Sequence[Wrench],
    contacts: Sequence[RubbingContact],
    directions: Reals,
    cases: Sequence[Reactions],
    unknown: Flags,
) -> Branches:
    """The normal forces of all rows, then the sizes of what teeth and belts transmit that press.

    NaN where the links are not held, or their velocities are not known.
    """
    rubbing, count = len(contacts), len(cases) - 1
    brought = np.zeros((len(motion), count, len(cases), 2))
    for k, contact in enumerate(contacts):
        brought[:, k] = _components(motion, contact, cases)
    brought[:, rubbing:, :, 0] = np.stack([case.carried for case in cases], axis=2)
    total = sum((np.abs(w.force) + np.abs(w.moment) / motion.size for w in wrenches), np.zeros(len(motion)))
    levers = [c.coefficient * (1.0 if c.slides else c.radius / motion.size) for c in contacts]
    each = np.array(levers + [1.0] * (count - rubbing))
    scales = np.concatenate([total[:, None], np.broadcast_to(each, (len(motion), count))], axis=1)
    brought = np.where(np.abs(brought) <= _NOISE * scales[:, None, :, None], 0.0, brought)
    halves = [2 * motion.size / c.length if c.slides else 1.0 for c in contacts]
    brought[:, :rubbing, :, 1] *= np.array(halves)[:, None]
    leaning = np.zeros((len(motion), count))
    leaning[:, :rubbing] = directions * [c.coefficient * c.height / c.length if c.slides else 0.0 for c in contacts]
    held = np.flatnonzero(~cases[0].singular & ~unknown)
    many = Contacts(
        loads=brought[:, :, 0],
        mutual=brought[:, :, 1:],
        leaning=leaning,
        round=np.array([k < rubbing and not contacts[k].slides for k in range(count)], bool),
        rubs=np.arange(count) < rubbing,
    ).at(held)
    largest = max((contact.coefficient for contact in contacts), default=_LARGEST)
    limit = max(2.0, min(_LARGEST / largest, _FACTORS))
    followed, rows = continued(many, limit), len(motion)
    filled = Branches(
        np.full((rows, count), np.nan),
        np.full(rows, np.nan),
        np.full(rows, -1),
        np.zeros(rows, np.int64),
        np.zeros(rows, bool),
    )
    for whole, part in zip(filled, followed, strict=True):
        whole[held] = part
    return filled


def _components(motion: Motion, contact: RubbingContact, cases: Sequence[Reactions]) -> Reals:
    """(rows, cases, 2): a pin's force; the normal force of a slide and its couple by the linkage's size."""
    forces = np.stack([case.forces[:, contact.connection] for case in cases], axis=1)
    if not contact.slides:
        return np.stack([forces.real, forces.imag], axis=2)
    connection = joint_connections(motion)[contact.connection]
    (near, along), far = _line(motion, contact)
    normal = (np.conj(1j * along)[:, None] * forces).real
    couple = np.stack([case.couples[:, contact.connection] for case in cases], axis=1)
    if contact.centred_on_first:
        arm = _place(motion, connection.second, far) - _place(motion, connection.first, near)
        couple = couple + (np.conj(along) * arm).real[:, None] * normal
    return np.stack([normal, couple / motion.size], axis=2)


def _total(motion: Motion, free: Reactions, mutual: Sequence[Reactions], forces: FrictionForces) -> Reactions:
    """Forces, couples and efforts with friction; those of joints contain it."""
    total = free.plus(zip(forces.normal.T, mutual, strict=True))
    joints, couples = total.forces.copy(), total.couples.copy()
    for k, contact in enumerate(forces.contacts):
        rubbing = -contact.lever * forces.directions[:, k] * forces.normal[:, k]
        if contact.slides:
            joints[:, contact.connection] += rubbing * _line(motion, contact)[0][1]
        else:
            couples[:, contact.connection] += rubbing
    return replace(total, forces=joints, couples=couples)
