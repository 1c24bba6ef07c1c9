"""The whole motion of a linkage with one drive: the drive's range, the poses in it, any further pose on demand.

docs/theory/events.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.mechanics.analysis.courses import Course, course_grid, motion_rows
from gruebler.mechanics.analysis.cycle_spans import CycleSpan
from gruebler.mechanics.analysis.law_joints import law_joints
from gruebler.mechanics.kinematics.change_point_rows import set_change_point_rows
from gruebler.mechanics.kinematics.drive_rows import drive_path
from gruebler.mechanics.kinematics.kernel_calls import follow_path
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose, pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, motion_from_rows, move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch, branch_labels

_MOST_TURNS = 8  # after which a linkage must be back where it was
_MOST_WITH_WHEELS = 720  # the same with wheels, whose tooth numbers make long cycles
_FAR = 20.0  # sizes: a slide that goes as far without a limit has none
_BACK = 1e-7  # how near it is then
_EQUAL = 1e-9  # of the longest step: places that differ by less are one, since the next step cannot be foretold from it
_WELL = 1e-3  # a start with a root below it is near a change point or limit
_NARROW = 2e-6  # radians or sizes: limits are seen at a square of -1e-13, so that a single position is as wide as this


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
        return law_joints(self)

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
        return motion_rows(motion, rows[1 + np.argsort(order_of, kind="stable")])


def part_of_cycle(cycle: DriveCycle, low: float, high: float) -> DriveCycle:
    """The course between two drive values; where they lie within its range, nothing stops it.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> part = part_of_cycle(drive_cycle(FourBar(25, 70, 40, 70).linkage()), -0.5, 0.5)
    >>> part.span.full, part.span.low, part.span.high, part.span.stops
    (False, -0.5, 0.5, (None, None))
    """
    span = cycle.span
    below, above = span.stops
    if span.full or low > span.low:
        below = None
    else:
        low = span.low
    if span.full or high < span.high:
        above = None
    else:
        high = span.high
    part = replace(cycle, span=replace(span, low=low, high=high, full=False, turns=0, stops=(below, above)))
    return replace(part, grid=course_grid(part))


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
        at = f"{round(degrees(middle), 4) + 0:g}°" if _turns(plan) else f"{middle:.9g} {linkage.unit}".rstrip()
        raise LinkageError(
            "the drive cannot move: the linkage can be assembled in one position only, drive = {at}", at=at
        )
    cycle = DriveCycle(plan=plan, start=start, span=span, grid=np.array([span.low, span.high]))
    return replace(cycle, grid=course_grid(cycle))


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
        return motion_rows(motion, 1 + np.argsort(order_of, kind="stable"))


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
    return replace(cycle, grid=course_grid(cycle))


def _turns(plan: Plan) -> bool:
    return plan.lower.mechanism.drives[0].turning


def _run(plan: Plan, places: Reals, order: int, start: Motion) -> tuple[Motion, np.ndarray]:
    """As `move` at speed 1, begun from a pose, by small rows; and the rows of the places, of equal ones the same."""
    steps = np.abs(np.diff(places)) / plan.longest_steps[0]
    parts = np.where(steps > _EQUAL, np.ceil(steps), 0).astype(np.int64)
    rows = np.concatenate([[0], np.cumsum(parts)])
    path = np.interp(np.arange(rows[-1] + 1), rows, places).reshape(-1, 1)
    speeds = np.zeros((order, *path.shape))
    speeds[:1] = 1
    signs = np.where(start.roots[0] < 0, -1.0, 1.0)
    motion = motion_from_rows(plan, path, follow_path(plan, path, speeds, signs, start.unknowns[0]))
    set_change_point_rows(plan, motion, path, speeds, lambda: ReferencePose(path[0], signs, start.unknowns[0]))
    return motion, rows


def _begun(plan: Plan, branch: Branch) -> Motion:
    """One row on the branch, well assembled if there is one."""
    labels = branch_labels(branch)
    branching = plan.branching
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
        above = motion_rows(above, rows[: len(short)])
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
