"""The whole motion of a linkage with one drive: the drive's range, the poses in it, any further pose on demand.

docs/theory/events.md.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import degrees, inf, pi
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import Message, message
from gruebler.mechanics.analysis.measure_units import drive_units
from gruebler.mechanics.kinematics.change_point_rows import set_change_point_rows
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.drive_rows import drive_path
from gruebler.mechanics.kinematics.kernel_calls import follow_path
from gruebler.mechanics.kinematics.kernel_records import MESH, POLAR
from gruebler.mechanics.kinematics.motion import Motion, Stop
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose, pose_at_reference
from gruebler.mechanics.kinematics.root_finding import FunctionSamples, bracketed_root
from gruebler.mechanics.kinematics.solve import cached_plan, motion_from_rows, move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch, branch_labels
from gruebler.structure.assur.forms import form_message

_CELLS = 360  # of the first grid
_LEVELS = 16  # how often a cell is halved where the motion bends: to 3e-7 of a turning drive
_LEVELS_OF_SLOW = 5  # the same for slow links: of one that does not turn, all is rounding next to change points
_SLOW = 1e-2  # of the usual rate of the fastest link: a slow one turns less
_STILL = 1e-12  # of the natural size: a rate (of a turn, by the drive) below it is a rounding
_BEND = 1e-3  # by how much a rate may differ from its cubic, of the usual rate
_MOST_TURNS = 8  # after which a linkage must be back where it was
_MOST_WITH_WHEELS = 720  # the same with wheels, whose tooth numbers make long cycles
_FAR = 20.0  # sizes: a slide that goes as far without a limit has none
_BACK = 1e-7  # how near it is then
_WELL = 1e-3  # a start with a root below it is near a change point or limit
_END = 0.3  # how far from an end (of pi for the range) the nodes for values at it lie
_END_OF_GROUP = 2e-4  # radians or sizes: the same for larger groups, whose limits are known to 1e-10 and may be sharp
_END_NEAREST = 1e-10  # radians or sizes: nodes lie no nearer to a limit; one of a larger group is known no better
_END_CLOSE = 1e-9  # of the function's size: values at an end that agree; rounding leaves 1e-10 at dyads, 1e-9 at groups
_NODES = 10
_NEWTON = 5  # steps, from a place that is nearer to the extremum than a hundredth of the nodes' range
_NARROW = 2e-6  # radians or sizes: limits are seen at a square of -1e-13, so that a single position is as wide as this
_ROUND = 1e-11  # radians: a full turn less than that is none
_LAW_NOISE = (
    1e-11,
    1e-9,
    1e-6,
    1e-3,
)  # of the usual size: errors of the pieces of laws and their derivatives, and room
_TOGETHER = 1e-8  # radians or sizes: events that are nearer are at one place; change points are known to 1e-12, some of
# larger groups to 1e-9
_OFFSET = 0.3819660112501051  # of a cell: grids avoid round angles, where the special positions are


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class CycleSpan:
    """The range of a drive: radians, or lengths for a slide."""

    low: float
    high: float
    full: bool
    """Whether the drive goes round, and the linkage is back after ``turns`` turns."""
    turns: int
    """After how many turns of the drive everything repeats; 0 if it does not go round."""
    stops: tuple[Stop | None, Stop | None]
    """What ends it below and above; None where no limit was found (full turns, endless slides)."""
    linkage: Linkage = field(repr=False)
    """The linkage that is driven."""

    @property
    def period(self) -> float:
        """After how much the motion repeats; infinite if the drive does not go round."""
        return 2 * pi * self.turns if self.full else float("inf")

    @property
    def width(self) -> float:
        """How far the drive can go."""
        return self.high - self.low

    def wrapped(self, drive: float) -> float:
        """A drive value as it is reported: of full turns the one in 0 to the period."""
        if not self.full:
            return drive
        value = drive % self.period
        return 0.0 if self.period - value < _ROUND else value

    def lines(self) -> Iterator[Message]:
        """How far the drive moves, and what stops it."""
        if len(self.linkage.mechanism.drives) > 1:
            yield message("A path of {count} drives.", count=len(self.linkage.mechanism.drives))
            return
        units = drive_units(self.linkage)
        if self.full and self.turns > 1:
            yield message("The drive turns fully; everything repeats after {turns} turns.", turns=self.turns)
        else:
            yield units.range(self.full, self.low, self.high)
        for stop, value in zip(self.stops, (self.low, self.high), strict=True):
            if stop is not None:
                text = _LIMIT if stop.reason == "limit" else _MEETING
                links = ", ".join(stop.links)
                yield text.filled(drive=units.drive(value), form=form_message(stop.form), links=links)

    def explain(self, lang: str = "en") -> str:
        """How far the drive moves and what stops it, in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(drive_cycle(FourBar(65, 70, 40, 70).linkage()).span)
        The drive turns from 25.33° to 109.1°.
        At 25.33° the group RRR {coupler, rocker} can no longer be assembled.
        At 109.1° the group RRR {coupler, rocker} can no longer be assembled.
        """
        return "\n".join(line.in_language(lang) for line in self.lines())


_LIMIT = message("At {drive} the group {form} {{{links}}} can no longer be assembled.")
_MEETING = message("At {drive} two assembly modes of the group {form} {{{links}}} meet.")


class _Event(Protocol):
    @property
    def drive(self) -> float: ...

    @property
    def links(self) -> tuple[str, ...]: ...


_AnyEvent = TypeVar("_AnyEvent", bound=_Event)


def by_place(events: Iterable[_AnyEvent], span: CycleSpan, drive_size: float) -> list[list[_AnyEvent]]:
    """Events in the order of the drive, those at one place together and in the order of their links' names.

    Rounding orders nothing: what is nearer than 1e-8 of the drive's size is at one place, just before the period too.
    """
    near = _TOGETHER * drive_size

    def place(event: _AnyEvent) -> float:
        return event.drive - span.period if span.period - event.drive < near else event.drive

    places: list[list[_AnyEvent]] = []
    last = -inf
    for event in sorted(events, key=place):
        if place(event) - last > near:
            places.append([])
        places[-1].append(event)
        last = place(event)
    return [sorted(together, key=lambda event: event.links) for together in places]


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

    def by_place(self, events: Iterable[_AnyEvent]) -> list[list[_AnyEvent]]:
        """`by_place` of the span."""
        return by_place(events, self.span, self.drive_size)

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


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class DriveCycle(Course):
    """A linkage on one branch over the whole range of its drive."""

    @property
    def turning_drive(self) -> bool:
        """Whether the drive turns; else it slides."""
        return _turns(self.plan)

    @cached_property
    def joints(self) -> tuple[float, ...]:
        """Drive values at which the law of a cam or a Geneva drive passes to its next piece, and may not be smooth."""
        return _law_joints(self)

    def at(self, drives: Reals, order: int = 3) -> Motion:
        """The poses at drive values within the span, in any order, reached along the branch; rates for speed 1.

        Raises `LinkageError` if one of them cannot be reached.
        """
        order_of = np.argsort(drives, kind="stable")
        first = self.start.drives[0]
        path = np.concatenate([first, np.asarray(drives, np.float64)[order_of]])
        motion, rows = _run(self.plan, path, order, self.start)
        if not motion.complete:
            raise LinkageError("the branch is lost within its range. {reason}", reason=motion.reason)
        return _rows(motion, rows[1 + np.argsort(order_of, kind="stable")])


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


def drive_cycle(linkage: Linkage, *, branch: Branch = None) -> DriveCycle:
    """The course of a linkage with one drive.

    It is begun at the linkage's reference pose, else at drive value 0 or the first multiple of 5 degrees (for a slide:
    1/40 of the size) at which the branch can be assembled well away from its limits and change points.

    Raises `LinkageError` if it has more drives than one, or cannot be assembled or moved at all.
    """
    plan = cached_plan(linkage)
    count = len(plan.linkage.mechanism.drives)
    if count != 1:
        raise LinkageError("measures need a linkage with one drive; this one has {count}", count=count)
    start = _begun(plan, branch)
    span = _span(plan, start)
    for stop in span.stops:
        if stop is not None and stop.reason == "open":
            motion = replace(start, stop=stop)
            raise LinkageError("{reason}", reason=motion.reason)
    size = 1.0 if _turns(plan) else plan.lower.size
    if span.width < _NARROW * size:
        middle = (span.low + span.high) / 2
        at = f"{round(degrees(middle), 4) + 0:g}°" if _turns(plan) else f"{middle:.9g} {linkage.unit}"
        raise LinkageError(
            "the drive cannot move: the linkage can be assembled in one position only, drive = {at}", at=at
        )
    cycle = DriveCycle(plan=plan, start=start, span=span, grid=np.array([span.low, span.high]))
    return replace(cycle, grid=_grid(cycle))


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class PathCycle(Course):
    """A linkage along a straight path of all its drives; the drive value of the course is the part of it, 0 to 1."""

    ends: Reals
    """(2, drives): where the path begins and ends."""

    @property
    def turning_drive(self) -> bool:
        """The part of a path is no angle."""
        return False

    @property
    def joints(self) -> tuple[float, ...]:
        """None are sought along a path of several drives."""
        return ()

    def values(self, parts: Reals) -> Reals:
        """The drive values at parts of the path; (n, drives)."""
        return np.asarray(self.ends[0] + np.asarray(parts, np.float64)[:, None] * (self.ends[1] - self.ends[0]))

    def at(self, drives: Reals, order: int = 3) -> Motion:
        """The poses at parts of the path, in any order; rates by the part."""
        order_of = np.argsort(drives, kind="stable")
        parts = np.concatenate([[0.0], np.asarray(drives, np.float64)[order_of]])
        motion = move_quietly(
            self.plan, self.values(parts), speed=self.ends[1] - self.ends[0], order=order, branch=self.start.branch
        )
        if not motion.complete:
            raise LinkageError("{reason}", reason=motion.reason)
        return _rows(motion, 1 + np.argsort(order_of, kind="stable"))


def path_cycle(linkage: Linkage, path: ArrayLike, *, branch: Branch = None) -> PathCycle:
    """The course of a linkage along a straight path of its drives, (rows, drives), from the first row to the last.

    Raises `LinkageError` if the drives do not move, or if the linkage cannot be moved to the end of the path.
    """
    plan = cached_plan(linkage)
    rows = drive_path(plan, path)
    ends = np.array([rows[0], rows[-1]])
    if (ends[0] == ends[1]).all():
        raise LinkageError("the path of the drives has no length: its first row is its last")
    start = move_quietly(plan, ends[:1], branch=branch)
    if not start.complete:
        raise LinkageError("{reason}", reason=start.reason)
    cycle = PathCycle(
        plan=plan,
        start=start,
        span=CycleSpan(low=0.0, high=1.0, full=False, turns=0, stops=(None, None), linkage=plan.linkage),
        grid=np.array([0.0, 1.0]),
        ends=ends,
    )
    return replace(cycle, grid=_grid(cycle))


def _turns(plan: Plan) -> bool:
    return plan.lower.mechanism.drives[0].turning


def _run(plan: Plan, places: Reals, order: int, start: Motion) -> tuple[Motion, np.ndarray]:
    """As `move` at speed 1, begun from a pose, by small rows; and the rows of the places."""
    parts = np.maximum(1, np.ceil(np.abs(np.diff(places)) / plan.longest_steps[0])).astype(np.int64)
    rows = np.concatenate([[0], np.cumsum(parts)])
    path = np.interp(np.arange(rows[-1] + 1), rows, places).reshape(-1, 1)
    speeds = np.zeros((order, *path.shape))
    speeds[:1] = 1
    signs = np.where(start.roots[0] < 0, -1.0, 1.0)
    motion = motion_from_rows(plan, path, follow_path(plan, path, speeds, order, signs, start.unknowns[0]))
    set_change_point_rows(plan, motion, path, speeds, ReferencePose(path[0], signs, start.unknowns[0]))
    return motion, rows


def _rows(motion: Motion, rows: np.ndarray) -> Motion:
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


def _begun(plan: Plan, branch: Branch) -> Motion:
    """One row on the branch, well assembled if there is one."""
    labels = branch_labels(branch)
    branching = [dyad.number for dyad in plan.dyads if dyad.branching]
    best, margin = None, 0.0
    for value in _candidates(plan):
        motion = move_quietly(plan, [value], branch=labels)
        root = float(np.abs(motion.roots[:, branching]).min(initial=1.0)) if len(motion) else -1.0
        if best is None or root > margin:
            best, margin = motion, root
        if margin > _WELL:
            break
    assert best is not None
    if not len(best):
        raise LinkageError(
            "the linkage cannot be assembled in this way at any drive value. {reason}", reason=best.reason
        )
    return best


def _candidates(plan: Plan) -> Iterator[float]:
    if plan.lower.reference_pose is not None:
        yield float(pose_at_reference(plan, np.zeros(1)).drives[0])
    step, count = (pi / 36, 36) if _turns(plan) else (plan.lower.size / 40, 120)
    yield 0.0
    for k in range(1, count + 1):
        yield k * step
        yield -k * step


def _span(plan: Plan, start: Motion) -> CycleSpan:
    q = float(start.drives[0, 0])
    turning = _turns(plan)
    most = _MOST_WITH_WHEELS if plan.wheels else _MOST_TURNS
    longest = 2 * pi * most if turning else _FAR * plan.lower.size
    steps = np.linspace(0, longest, (most if turning else 40) + 1)
    for count in _doubled(
        1 if turning else 40, len(steps) - 1
    ):  # most linkages repeat after one turn, some with wheels after hundreds
        above, rows = _run(plan, q + steps[: count + 1], 0, start)
        back = [k for k in range(1, len(rows)) if turning and rows[k] < len(above) and _same(plan, above, int(rows[k]))]
        if back or not above.complete:
            break
    if back:
        return CycleSpan(
            low=q, high=q + 2 * pi * back[0], full=True, turns=back[0], stops=(None, None), linkage=plan.linkage
        )
    short = steps[: _MOST_TURNS + 1] if turning else steps
    if above.complete:
        above = _rows(above, rows[: len(short)])
    below, _ = _run(plan, q - short, 0, start)
    low, high = (motion.stop.drives[0] if motion.stop else float(motion.drives[-1, 0]) for motion in (below, above))
    return CycleSpan(low=low, high=high, full=False, turns=0, stops=(below.stop, above.stop), linkage=plan.linkage)


def _doubled(first: int, last: int) -> Iterator[int]:
    """first, 2 first, 4 first, ... and last."""
    while first < last:
        yield first
        first *= 2
    yield last


def _same(plan: Plan, motion: Motion, row: int) -> bool:
    places = np.abs(motion.places[0, row] - motion.places[0, 0]).max() / plan.lower.size
    return bool(max(places, np.abs(motion.turns[row] - motion.turns[0]).max()) < _BACK)


def _grid(cycle: Course) -> Reals:
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


_SAME = 1e-9  # of the range: joints of two laws that are nearer are one


def _law_joints(cycle: DriveCycle) -> tuple[float, ...]:
    """Drive values at which derivatives may jump, in rising order; of full turns in the period from the grid on."""
    laws = [c for group in cycle.plan.conditions for c in group if c.law.joints]
    if not laws:
        return ()
    grid = cycle.grid
    motion = cycle.at(grid, 0)
    joints: list[float] = []
    for condition in laws:
        seen = _direction(motion, condition)
        for angle in sorted({joint % (2 * pi) for joint in condition.law.joints}):
            against = seen * np.exp(-1j * angle)
            above = against.imag >= 0
            cells = np.flatnonzero((above[:-1] != above[1:]) & (against.real[:-1] > 0))
            low, high = grid[cells], grid[cells + 1]

            def off(drives: Reals, condition: Condition = condition, angle: float = angle) -> Reals:
                return np.asarray((_direction(cycle.at(drives, 0), condition) * np.exp(-1j * angle)).imag)

            joints += bracketed_root(off, low, high).tolist() if len(cells) else []
    return _merged(sorted(joints), _SAME * cycle.span.width, cycle.span.period)


def _merged(places: list[float], near: float, period: float) -> tuple[float, ...]:
    merged: list[float] = []
    for place in places:
        if not merged or place - merged[-1] > near:
            merged.append(place)
    if len(merged) > 1 and merged[0] + period - merged[-1] <= near:
        merged.pop()
    return tuple(merged)


def _direction(motion: Motion, condition: Condition) -> Complexes:
    """The argument of a law as a direction, as in the kernel `closure`."""
    plan, chain = motion.plan, motion.lower_linkage.mechanism.chain
    points, lines = plan.element_arrays(plan.lower)
    turns, places, along = [], [], []
    for side in condition.sides:
        k = chain.index(plan.keys[side][1])
        turns.append(motion.turns[:, k])
        places.append(motion.places[0, :, k] + motion.turns[:, k] * points[side])
        along.append(motion.turns[:, k] * lines[side])
    gap = places[1] - places[0]
    if condition.kind == MESH:
        return np.asarray(along[0] * np.conj(gap) / np.abs(gap))
    if condition.kind == POLAR:
        return np.asarray(np.conj(along[0]) * gap / np.abs(gap))
    return np.asarray(-condition.values[1] * 1j * along[0] * np.conj(along[1]))
