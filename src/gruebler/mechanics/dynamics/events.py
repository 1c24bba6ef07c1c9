"""What happens to a free motion: ends of joints, motors that do not start or stall, jumps of loads."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.dynamics.coordinates import JointFreedom, freedom_of
from gruebler.mechanics.dynamics.free_linkage import FreeLinkage, Instants, motion_of
from gruebler.mechanics.dynamics.inverse import inertia_of
from gruebler.mechanics.forces import Statics
from gruebler.mechanics.forces.acting import MovingLinks, loads_over_rows
from gruebler.mechanics.forces.equilibrium import link_loads, reactions
from gruebler.mechanics.forces.laws import SwitchedLaw
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.law_directions import law_direction
from gruebler.mechanics.kinematics.messages import drive_name, drive_values
from gruebler.structure.chain.pairs import SymbolText
from gruebler.structure.mechanism import Mechanism

_STILL = 1e-9  # of the fastest speed so far: a motor that is slower backwards has rounding

_AT_END = message("{joint} reaches the end of its range at {time:n} s, {values}.")
_NOT_STARTED = message("The motor at {joint} does not start: at {values} it gives {give}, and the loads need {need}.")
_HELD = message(
    "At {time:n} s, {values}, {load} jumps, and on either side of the jump it drives the motion back to it: what it is "
    "there is not given. A steep but continuous law, such as tanh(vx/0.1) for a sign, has an answer."
)
_LIFTED = message(
    "At {time:n} s, {values}, the links of {joint} lift off: they only push each other, and a pull would be needed."
)
_STALLED = message("The motor at {joint} stalls at {time:n} s, {values}: the loads turn it back.")


_PULL = 1e-9  # of the largest force of a joint so far: a smaller pull is rounding
_ON_JUMP = 1e-11  # of the largest value so far of what a load looks at: nearer to its jump it is on it
_TOGETHER = 1e-9  # likewise: what is so near to its own jump turns over with it
_PAST_SEAM = 1e-9  # radians: so far behind a seam of a law a step ends
AT_SEAM = _PAST_SEAM / 2  # radians: so exactly; far more than rounding
_WIDEST = 2.0  # radians: of a piece of a law in which no step ends
_OVER = 0.5  # radians: so far over a seam a step may lead at the speeds at which it begins
_SHORT = 1e-6  # radians: by which the fastest link turns to see how fast laws are passed
_AHEAD = 1e-7  # of the time that is followed: so far it is looked ahead on which side of a jump the motion goes


class Watch(NamedTuple):
    """Something that ends the motion, or changes what acts."""

    gap: Callable[[Instants], float]
    """Negative once it has happened."""
    met: Callable[[Instants], Message | None]
    """What is said then; nothing if the motion goes on."""
    passed: Callable[[Instants], None] = lambda _: None
    """What happens where it goes on."""
    is_seam: bool = False
    """Whether what acts is not smooth there, so that the step must end there."""


def watched_ends(free: FreeLinkage, first: Instants, ends: Mapping[str, tuple[float, float]]) -> Iterator[Watch]:
    """The ranges of joints, by name."""
    linkage = free.plan.linkage
    for name, given in ends.items():
        try:
            low, high = map(float, given)
        except (TypeError, ValueError):
            low = high = np.nan
        if not low < high:
            raise LinkageError("ends of {joint}: expected two numbers, the lower one first", joint=name)
        drive = Mechanism(linkage.mechanism.chain, linkage.mechanism.frame, [name]).drives[0]
        freedom = freedom_of(linkage, drive, free.coordinates.links)
        start = freedom.value(first.jets)
        if drive.turning:
            start += 2 * np.pi * np.ceil((low - start) / (2 * np.pi) - 1e-12)
        if not low <= start <= high:
            raise LinkageError("ends: the motion starts outside the range of {joint}", joint=name)
        yield _watched_end(free, name, freedom, low, high, start - _way(freedom, first))


def _way(freedom: JointFreedom, now: Instants) -> float:
    """The value of a joint, of a turning one continuous and up to a constant."""
    if freedom.line:
        return float(freedom.value(now.jets))
    return float(now.angles[freedom.second] - now.angles[freedom.first])


def _watched_end(free: FreeLinkage, name: str, freedom: JointFreedom, low: float, high: float, shift: float) -> Watch:
    def gap(now: Instants) -> float:
        value = _way(freedom, now) + shift
        return min(value - low, high - value)

    def met(now: Instants) -> Message:
        return _AT_END.filled(joint=name, time=now.time, values=_values(free, now))

    return Watch(gap, met)


def watched_motors(free: FreeLinkage, first: Instants) -> Iterator[Watch]:
    """Motors that may be turned back by the loads, of those that begin at rest."""
    for k, sense in _motors_at_rest(free, first):
        name = drive_name(free.plan.linkage.mechanism, k)
        fastest = [0.0]

        def gap(now: Instants, k: int = k, sense: float = sense, fastest: list[float] = fastest) -> float:
            speed = sense * float(now.moving.speeds[0, k])
            fastest[0] = max(fastest[0], speed)
            return speed + _STILL * fastest[0]

        def met(now: Instants, name: SymbolText = name) -> Message:
            return _STALLED.filled(joint=name, time=now.time, values=_values(free, now))

        yield Watch(gap, met)


def watched_contacts(free: FreeLinkage, first: Instants) -> Iterator[Watch]:
    """Cams and smooth circles, which lift off where they would have to pull."""
    largest = [1e-300]

    def pushes(now: Instants) -> dict[int, Reals]:
        motion = motion_of(free, now)
        wrenches = (*loads_over_rows(motion, free.loads, now.moving.time), *inertia_of(motion, free.loads))
        reaction = reactions(motion, link_loads(motion, wrenches))
        largest[0] = max(largest[0], float(np.nanmax(np.abs(reaction.forces), initial=0.0)))
        return Statics(motion=motion, wrenches=wrenches, reactions=reaction, work=motion.drives).pushes

    def least(now: Instants) -> float:
        return min(float(push[0]) for push in pushes(now).values()) / largest[0] + _PULL

    def met(now: Instants) -> Message:
        parts = pushes(now)
        joint = min(parts, key=lambda number: float(parts[number][0]))
        title = free.plan.linkage.mechanism.chain.joint_title(joint)
        return _LIFTED.filled(joint=title, time=now.time, values=_values(free, now))

    if free.plan.wheels and pushes(first):
        yield Watch(least, met)


def why_not_started(free: FreeLinkage, first: Instants, acceleration: Reals) -> Message | None:
    """The reason if a motor at rest is not accelerated in its own sense."""
    own = free.own_acceleration(first, acceleration)[0]
    for k, sense in _motors_at_rest(free, first):
        if own[k] * sense <= 0:
            mechanism = free.plan.linkage.mechanism
            give = float(free.equations.acting.motor_efforts(first.moving)[0, k])
            need = -float(free.equations.generalised(first.influences, first.moving)[0, k])
            unit = f"N·{free.plan.linkage.unit}" if mechanism.drives[k].turning else "N"
            return _NOT_STARTED.filled(
                joint=drive_name(mechanism, k),
                values=_values(free, first),
                give=message("{value:n} {unit}", value=give, unit=unit),
                need=message("{value:n} {unit}", value=need, unit=unit),
            )
    return None


class Jumps:
    """The comparisons and signs in the loads, each held on one side; turned over where the motion passes its jump."""

    def __init__(self, free: FreeLinkage, first: Instants, until: float) -> None:
        self._free, self._ahead = free, _AHEAD * until
        self._switches = [
            (what, law, k)
            for what, law, _ in free.equations.acting.laws(first.moving)
            if isinstance(law, SwitchedLaw)
            for k in range(len(law.sides))
        ]
        gaps = self._gaps(first.moving)
        self._largest = np.maximum(np.abs(gaps), 1e-300)
        self._turn(self._senses * gaps < 0)
        self.held: Message | None = None
        """The reason why it does not start, on a jump."""
        if (gaps == 0).any():
            here, there = self._ways(first, gaps == 0)
            self.held = self._met(first)
            self._turn((gaps == 0) & (here < 0 <= there))

    def watched(self) -> list[Watch]:
        """What is looked at: the nearest of all jumps, if there are any."""
        return [Watch(self._nearest, self._met, self._turned)] if self._switches else []

    @property
    def _senses(self) -> Reals:
        return np.array([1.0 if law.sides[k] else -1.0 for _, law, k in self._switches])

    def _turn(self, which: Flags) -> None:
        for (_, law, k), turns in zip(self._switches, which.tolist(), strict=True):
            law.sides[k] ^= turns

    def _gaps(self, moving: MovingLinks) -> Reals:
        laws = self._free.equations.acting.laws(moving)
        return np.array([gap for _, law, at in laws if isinstance(law, SwitchedLaw) for gap in law.gaps(at)])

    def _nearest(self, now: Instants) -> float:
        gaps = self._gaps(now.moving)
        self._largest = np.maximum(self._largest, np.abs(gaps))
        return float((self._senses * gaps / self._largest).min()) + _ON_JUMP

    def _touched(self, now: Instants) -> Flags:
        return np.asarray(self._senses * self._gaps(now.moving) / self._largest < _TOGETHER)

    def _met(self, now: Instants) -> Message | None:
        which = self._touched(now)
        here, there = self._ways(now, which)
        if here >= 0 or there >= 0:
            return None
        load = self._switches[int(np.argmax(which))][0]
        return _HELD.filled(time=now.time, values=_values(self._free, now), load=load)

    def _turned(self, now: Instants) -> None:
        self._turn(self._touched(now))

    def _ways(self, now: Instants, which: Flags) -> tuple[float, float]:
        """How fast the motion leaves the jump on its own side, and on the other one; negative: back to it."""
        first, ways = int(np.argmax(which)), []
        for _ in range(2):
            ways.append(float(self._senses[first] * self._slopes(now)[first]))
            self._turn(which)
        return ways[0], ways[1]

    def _slopes(self, now: Instants) -> Reals:
        """How fast what the loads look at grows, by a small step along the motion."""
        acceleration, step, moving = self._free.acceleration(now), self._ahead, now.moving
        places, rates = now.derivatives(acceleration)
        ahead = replace(
            moving,
            places=moving.places + step * moving.velocities,
            turns=moving.turns * np.exp(1j * step * moving.rates),
            angles=moving.angles + step * moving.rates,
            velocities=moving.velocities + step * places[2],
            rates=moving.rates + step * rates[1],
            time=moving.time + step,
            drives=moving.drives + step * moving.speeds,
            speeds=moving.speeds + step * self._free.own_acceleration(now, acceleration),
        )
        return (self._gaps(ahead) - self._gaps(moving)) / step


class Seams:
    """Where the laws of cams and the like pass from one piece to the next.

    Higher derivatives jump there, and a step over them misses more than it tells.
    """

    def __init__(self, free: FreeLinkage) -> None:
        self._plan = free.plan
        laws = [c for group in free.plan.conditions for c in group if c.law.joints]
        self._laws = [(law, _pieces(law.law.joints)) for law in laws]
        self._now = list[Reals]()

    def watched(self) -> list[Watch]:
        """What is looked at: the nearest of all seams, if there are any."""
        return [Watch(self._nearest, lambda _: None, is_seam=True)] if self._laws else []

    def look(self, now: Instants) -> float:
        """The pieces on which a step begins; returns how long a step leads little farther at these speeds."""
        moving, longest = now.moving, np.inf
        self._now = []
        for law, pieces in self._laws:
            seen = self._seen(law, moving.places, moving.turns)
            self._now.append(pieces[[_within(seen, pieces).argmax()]])
            short = _SHORT / max(float(np.abs(moving.rates).max()), 1e-300)
            moved = moving.places + short * moving.velocities, moving.turns * np.exp(1j * short * moving.rates)
            turned = abs(float(np.angle(self._seen(law, *moved) / seen)))
            longest = min(longest, (float(_within(seen, self._now[-1])[0]) + _OVER) * short / max(turned, 1e-12))
        return longest

    def _nearest(self, now: Instants) -> float:
        seen = [self._seen(law, now.moving.places, now.moving.turns) for law, _ in self._laws]
        return min(float(_within(*part)[0]) for part in zip(seen, self._now, strict=True)) + _PAST_SEAM

    def _seen(self, law: Condition, places: Complexes, turns: Complexes) -> complex:
        return complex(law_direction(self._plan, places[:1] / self._plan.lower.size, turns[:1], law)[0])


def _pieces(joints: tuple[float, ...]) -> Reals:
    """(pieces, 2): the middles and half widths of what lies between angles, in parts that are not too wide."""
    ends = np.unique(np.mod(joints, 2 * np.pi))
    parts = list[tuple[float, float]]()
    for low, width in zip(ends, np.diff(ends, append=ends[0] + 2 * np.pi), strict=True):
        count = int(np.ceil(width / _WIDEST))
        parts += [(low + width * (k + 0.5) / count, width / count / 2) for k in range(count)]
    return np.array(parts)


def _within(seen: complex, pieces: Reals) -> Reals:
    """So far within each piece a direction lies; negative outside."""
    return np.asarray(pieces[:, 1] - np.abs(np.angle(seen * np.exp(-1j * pieces[:, 0]))))


def _motors_at_rest(free: FreeLinkage, first: Instants) -> Iterator[tuple[int, float]]:
    """Drives with a motor that stand still, and the sense in which it pulls."""
    efforts = free.equations.acting.motor_efforts(first.moving)[0] if free.loads.motors else np.zeros(0)
    for k, effort in enumerate(efforts.tolist()):
        if effort and first.moving.speeds[0, k] == 0:
            yield k, float(np.sign(effort))


def _values(free: FreeLinkage, now: Instants) -> Message:
    return drive_values(free.plan.linkage, tuple(now.moving.drives[0].tolist()))
