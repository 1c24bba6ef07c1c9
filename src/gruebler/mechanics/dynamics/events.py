"""What ends a free motion before its time: ends of joints, motors that do not start or stall."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.dynamics.coordinates import JointFreedom, freedom_of
from gruebler.mechanics.dynamics.free_linkage import FreeLinkage, Instants
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.structure.mechanism import Mechanism

_STILL = 1e-9  # of the fastest speed so far: a motor that is slower backwards has rounding

_AT_END = message("{joint} reaches the end of its range at {time:n} s, {values}.")
_NOT_STARTED = message("The motor at {joint} does not start: at {values} it gives {give}, and the loads need {need}.")
_HELD = message(
    "At {time:n} s, {values}, {load} jumps, and on either side of the jump it drives the motion back to it: what it is "
    "there is not given. A steep but continuous law, such as tanh(vx/0.1) for a sign, has an answer."
)
_STALLED = message("The motor at {joint} stalls at {time:n} s, {values}: the loads turn it back.")


_JUMPS = 1e-3  # of all loads: what changes by more while the state does not is a jump
_TO_AND_FRO = 8  # such changes from one step to the next: an oscillation is resolved by more steps than that


class Watch(NamedTuple):
    """Something that ends the motion."""

    gap: Callable[[Instants], float]
    """Negative once it has happened."""
    met: Callable[[Instants], Message]
    """What is said then."""


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
        name = free.plan.linkage.mechanism.drive_names()[k]
        fastest = [0.0]

        def gap(now: Instants, k: int = k, sense: float = sense, fastest: list[float] = fastest) -> float:
            speed = sense * float(now.moving.speeds[0, k])
            fastest[0] = max(fastest[0], speed)
            return speed + _STILL * fastest[0]

        def met(now: Instants, name: str = name) -> Message:
            return _STALLED.filled(joint=name, time=now.time, values=_values(free, now))

        yield Watch(gap, met)


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
                joint=mechanism.drive_names()[k],
                values=_values(free, first),
                give=message("{value:n} {unit}", value=give, unit=unit),
                need=message("{value:n} {unit}", value=need, unit=unit),
            )
    return None


def held_on_a_jump(free: FreeLinkage, recent: Sequence[Instants]) -> Message | None:
    """The reason if a load jumps to and fro among instants that are one place, one speed and one time."""
    named = list[tuple[Message, Complexes]]()
    for now in recent:
        named += free.equations.acting.named_values(now.moving)
    loads = len(named) // len(recent)
    values = np.array([value[0] for _, value in named]).reshape(len(recent), loads)
    ranges = np.abs(values - values[0]).max(axis=0, initial=0.0)
    turns = (np.abs(np.diff(values, axis=0)) > ranges / 2).sum(axis=0)
    held = (ranges > _JUMPS * np.abs(values).max(initial=0.0)) & (turns > _TO_AND_FRO)
    if not held.any():
        return None
    return _HELD.filled(time=recent[0].time, values=_values(free, recent[0]), load=named[int(held.argmax())][0])


def _motors_at_rest(free: FreeLinkage, first: Instants) -> Iterator[tuple[int, float]]:
    """Drives with a motor that stand still, and the sense in which it pulls."""
    efforts = free.equations.acting.motor_efforts(first.moving)[0] if free.loads.motors else np.zeros(0)
    for k, effort in enumerate(efforts.tolist()):
        if effort and first.moving.speeds[0, k] == 0:
            yield k, float(np.sign(effort))


def _values(free: FreeLinkage, now: Instants) -> Message:
    return drive_values(free.plan.linkage, tuple(now.moving.drives[0].tolist()))
