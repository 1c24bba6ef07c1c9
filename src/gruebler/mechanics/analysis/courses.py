"""A linkage on one branch along one number: the poses, where they are looked at, values at the ends of the range."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.cycle_spans import AnyEvent, CycleSpan, by_place
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.root_finding import FunctionSamples
from gruebler.mechanics.linkages import Linkage

_CELLS = 360  # of the first grid
_LEVELS = 16  # how often a cell is halved where the motion bends: to 3e-7 of a turning drive
_LEVELS_OF_SLOW = 5  # the same for slow links: of one that does not turn, all is rounding next to change points
_SLOW = 1e-2  # of the usual rate of the fastest link: a slow one turns less
_STILL = 1e-12  # of the natural size: a rate (of a turn, by the drive) below it is a rounding
_BEND = 1e-3  # by how much a rate may differ from its cubic, of the usual rate
_END = 0.3  # how far from an end (of pi for the range) the nodes for values at it lie
_END_OF_GROUP = 2e-4  # radians or sizes: the same for larger groups, whose limits are known to 1e-10 and may be sharp
_END_NEAREST = 1e-10  # radians or sizes: nodes lie no nearer to a limit; one of a larger group is known no better
_END_CLOSE = 1e-9  # of the function's size: values at an end that agree; rounding leaves 1e-10 at dyads, 1e-9 at groups
_NODES = 10
_NEWTON = 5  # steps, from a place that is nearer to the extremum than a hundredth of the nodes' range
_LAW_NOISE = (
    1e-11,
    1e-9,
    1e-6,
    1e-3,
)  # of the usual size: errors of the pieces of laws and their derivatives, and room
_OFFSET = 0.3819660112501051  # of a cell: grids avoid round angles, where the special positions are


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Course(ABC):
    """A linkage on one branch along one number: the value of its drive, or the part of a path of several drives."""

    plan: Plan
    start: Motion
    """One row: where it was begun."""
    span: CycleSpan
    grid: Reals
    """Drive values, ascending, finer where the motion bends; of a full turn the first comes once more at the end."""

    @property
    def linkage(self) -> Linkage:
        """The linkage."""
        return self.plan.linkage

    @property
    def lower_linkage(self) -> Linkage:
        """The linkage as it is solved: with lower pairs, and the links that replace higher ones."""
        return self.plan.lower

    @property
    def size(self) -> float:
        """A length of the order of the linkage as it is solved."""
        return self.plan.lower.size

    @property
    def drive_size(self) -> float:
        """What counts as much as a radian of a turning drive: 1, or the size for a sliding one."""
        return 1.0 if self.turning_drive else self.size

    @property
    @abstractmethod
    def turning_drive(self) -> bool:
        """Whether the number is the angle of a drive."""

    @property
    @abstractmethod
    def joints(self) -> tuple[float, ...]:
        """Drive values at which the law of a cam or a Geneva drive passes to its next piece, and may not be smooth."""

    @abstractmethod
    def at(self, drives: Reals, order: int = 3) -> Motion:
        """The poses at drive values within the span, in any order, reached along the branch; rates for speed 1.

        Raises `LinkageError` if one of them cannot be reached.
        """

    def by_place(self, events: Iterable[AnyEvent]) -> list[list[AnyEvent]]:
        """`by_place` for the size of the drive."""
        return by_place(events, self.drive_size)

    def samples(self, order: int = 1) -> FunctionSamples:
        """The grid, with the joints of the laws of its cams, for zeros of a derivative of that order by the drive."""
        noise = _LAW_NOISE[order:] if self.joints else ()
        return FunctionSamples(
            grid=self.grid, joints=self.joints, period=self.span.period if self.span.full else None, noise=noise
        )

    def end(self, function: Callable[[Motion], Reals | Complexes], upper: bool, size: float = 1.0) -> complex:
        """The value of a function of that size at an end of the range, where poses themselves are ill-conditioned.

        In t, drive = middle - cos t times half the width, it is analytic: it is extrapolated by a polynomial of degree
        9 through ten poses with t up to 0.3, at the limit of a larger group with drive values within 2e-4 (radians or
        sizes) of it. The interval of t is halved until two such values agree within 1e-9 of the function's size, or as
        long as they come nearer to one another and the poses are known: no nearer than 1e-10 to the limit.
        """
        limit, inward = (self.span.high, -1.0) if upper else (self.span.low, 1.0)
        stop = self.span.stops[int(upper)]
        if stop is None:
            return complex(function(self.at(np.array([limit])))[0])
        most, half = _END, self.span.width / 2
        if stop.reason == "singular":
            most = min(_END, (2 * _END_OF_GROUP * self.drive_size / half) ** 0.5)
            from_end = _from_end(most, half)
            limit += inward * _limit_error(self.at(limit + inward * from_end), from_end)
        others = ~np.eye(_NODES, dtype=bool)
        values: list[complex] = []
        while True:
            from_end = _from_end(most / 2 ** len(values), half)
            if values and from_end[0] < _END_NEAREST * self.drive_size:
                return values[-1]
            try:
                motion = self.at(limit + inward * from_end)
            except LinkageError:
                if not values:
                    raise
                return values[-1]  # In coordinates with large offsets a larger group is lost a little farther away.
            t = 2 * np.arcsin(np.sqrt(from_end / (2 * half)))
            weights = np.prod(-t / np.where(others, t[:, None] - t, 1.0), axis=1, where=others)
            values.append(complex(weights @ function(motion)))
            changes = np.abs(np.diff(values[-3:]))
            if len(changes) and changes[-1] > changes[0]:
                return values[-2]
            if len(changes) and changes[-1] <= _END_CLOSE * size:
                return values[-1]


def _from_end(most: float, half: float) -> Reals:
    """How far from the end of the range Chebyshev's points of t between 0 and a number are."""
    t = most / 2 * (1 - np.cos((2 * np.arange(_NODES) + 1) * pi / (2 * _NODES)))
    return half * 2 * np.asarray(np.sin(t / 2)) ** 2


def _limit_error(motion: Motion, from_end: Reals) -> float:
    """How far within the range, as it was found, the limit of a larger group lies, given poses near it.

    Steps of larger groups come as near to a limit as rounding lets them: in coordinates with large offsets some 1e-10,
    which changes what goes with the square root by 1e-5. As a function of a coordinate that does not stand still there,
    the drive value is analytic, and the limit is its extremum: rounding enters it by its square.
    """
    coordinates = np.concatenate(
        [np.unwrap(np.angle(motion.turns), axis=0), motion.places[0].real, motion.places[0].imag], axis=1
    )
    coordinates[:, motion.turns.shape[1] :] /= motion.linkage.size
    moving = coordinates[:, np.abs(coordinates[-1] - coordinates[0]).argmax()]
    from_limit = np.polynomial.Chebyshev.fit(moving, from_end, len(from_end) - 1)
    slope, bend, extremum = from_limit.deriv(), from_limit.deriv(2), float(moving[0])
    for _ in range(_NEWTON):
        extremum -= float(slope(extremum) / bend(extremum))
    error = float(from_limit(extremum))
    return error if abs(error) < from_end[0] else 0.0


def motion_rows(motion: Motion, rows: np.ndarray) -> Motion:
    """Some rows of a motion, in the order that is given."""
    return replace(
        motion,
        drives=motion.drives[rows],
        places=motion.places[:, rows],
        turns=motion.turns[rows],
        rates=motion.rates[:, rows],
        whole=motion.whole[rows],
        roots=motion.roots[rows],
        unknowns=motion.unknowns[rows],
    )


def course_grid(cycle: Course) -> Reals:
    """Places in the span between which the rates are near to their cubics."""
    span = cycle.span
    if span.full:
        first = span.low + _OFFSET * 2 * pi / _CELLS
        s = first + np.linspace(0, span.width, _CELLS * span.turns + 1)
    else:
        s = pi * (np.arange(_CELLS) + 0.5) / _CELLS

    def drive(s: Reals) -> Reals:
        return s if span.full else span.low + span.width * np.sin(s / 2) ** 2

    least = _STILL / cycle.drive_size
    suspect = np.ones(len(s) - 1, bool)
    for level in range(_LEVELS):
        middles = (s[:-1] + s[1:])[suspect] / 2
        rates = cycle.at(drive(np.concatenate([s, middles])), 2).rates
        speed, change, between = rates[0, : len(s)], rates[1, : len(s)], rates[0, len(s) :]
        usual = np.quantile(np.abs(speed), 0.9, axis=0)
        if level >= _LEVELS_OF_SLOW:
            usual = np.maximum(usual, _SLOW * usual.max())
        width = np.diff(drive(s))[:, None]
        cubic = (speed[:-1] + speed[1:]) / 2 + width / 8 * (change[:-1] - change[1:])
        off = np.abs(between - cubic[suspect]) > _BEND * (usual + np.abs(between)) + least
        bent = np.zeros(len(s) - 1, bool)
        bent[suspect] = off.any(axis=1)
        order = np.argsort(np.concatenate([s, middles]), kind="stable")
        halved = np.flatnonzero(suspect)
        parts = np.ones(len(s) - 1, int)
        parts[halved] = 2
        s = np.concatenate([s, middles])[order]
        suspect = np.repeat(bent, parts)
        if not suspect.any():
            break
    return drive(s)
