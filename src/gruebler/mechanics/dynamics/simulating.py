"""Free motion: a linkage left to its masses, loads, springs and motors."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from contextlib import suppress
from copy import copy
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import DOP853, Radau
from scipy.optimize import brentq

from gruebler._core import free_run, free_step
from gruebler.base.arrays import Reals, whole_turns
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.dynamics.charts import Blocked
from gruebler.mechanics.dynamics.events import (
    AT_SEAM,
    Jumps,
    Seams,
    Watch,
    watched_contacts,
    watched_ends,
    watched_motors,
    why_not_started,
)
from gruebler.mechanics.dynamics.free_linkage import FreeLinkage, Instants, Kept
from gruebler.mechanics.dynamics.simulation import Simulation
from gruebler.mechanics.dynamics.starts import starting_pose
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_ROWS = 401
_ABSOLUTE = 0.1  # of the tolerance: what is allowed of values near zero, in their usual size
_FINEST, _COARSEST = 1e-13, 1e-2
_NEARBY = 1e-8  # of what is usual: steps by which derivatives are taken
_SHORT, _MANY = 2.5e-4, 6000  # of the time that is followed: if so many evaluations lead less far there is no end
_BY_ORDER = ("places", "rates")  # columns whose rows are their second axis
_MOST = 10_000  # steps at once, between which Ctrl-C is heard
_LOOKS = 4  # in each step, at what may end the motion


@door_that_raises(LinkageError)
def simulate(
    linkage: LinkageLike,
    loads: Loads,
    *,
    until: float,
    branch: Branch = None,
    at: ArrayLike | None = None,
    speed: ArrayLike = 0.0,
    times: ArrayLike | None = None,
    ends: Mapping[str, tuple[float, float]] | None = None,
    tolerance: float = 1e-10,
    stiff: bool = False,
) -> Simulation:
    """How a linkage moves by itself under loads, springs, weights and motors.

    Args:
        linkage: Whose drives are coordinates of the start; they are free unless they have a motor.
        loads: What acts, and the masses that are moved.
        until: The time to which the motion is followed, in seconds.
        branch: The assembly mode at the start; without it the one of the reference pose. In a change point it is that
            of the way on which the drive grows.
        at: The drives at the start, in radians or the linkage's unit; without it those of the reference pose.
        speed: Their speeds at the start.
        times: The rows, in seconds; without them 401 evenly spaced ones.
        ends: By joint the range in which it may move; the motion ends where one leaves it.
        tolerance: Of each step, relative.
        stiff: Whether an implicit method is used, for springs or dampers that are far faster than the motion.

    Returns:
        `Simulation`: times (rows,), poses, speeds and accelerations of all links, energies, how far these are from
        being kept, and why it ended if it did before its time.

    Raises:
        LinkageError: Drives that do not fix the motion, nothing that has mass, loads on points that are not there,
            numbers that are not usable, a start that cannot be assembled.

    Cost:
        12 evaluations of the forces a step, 20 to 100 steps a turn of a crank. For one freedom and loads that are
        numbers a step costs 5 us, a row as much, and each half radian, when it is first met, 0.5 ms; else, or where
        ends are watched, an evaluation some 0.2 ms.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> loads = Loads(bodies={"coupler": RigidBody(0.5, (35, 0), 200.0)})
        >>> fall = simulate(FourBar(25, 70, 40, 70), loads, at=1.0, until=0.5)
        >>> len(fall), fall.complete, bool(fall.defect < 1e-6)
        (401, True, True)

    See Also:
        `equilibria`, `linearised`, `inverse_dynamics`, `move`

    Theory:
        docs/theory/free-motion.md
    """
    solving = cached_plan(as_linkage(linkage))
    if not 0 < until < 1e100:
        raise LinkageError("until: expected a time in seconds after 0, but found {until!r}", until=until)
    if not _FINEST <= tolerance <= _COARSEST:
        raise LinkageError("a tolerance lies between 1e-13 and 0.01; this one is {tolerance!r}", tolerance=tolerance)
    drives, start = starting_pose(solving, branch, at)
    free = FreeLinkage(solving, loads.switched(), start)
    run = _Run(free, until, _times(times, until), tolerance, stiff)
    return run.followed(drives, _speeds(solving, speed), ends or {})


def _speeds(plan: Plan, speed: ArrayLike) -> Reals:
    try:
        speeds = np.broadcast_to(np.asarray(speed, np.float64), (len(plan.linkage.mechanism.drives),)).copy()
    except (TypeError, ValueError, OverflowError):
        speeds = np.array([np.nan])
    if not (np.abs(speeds) < 1e100).all():
        raise LinkageError("speed: expected a finite number for each drive, but found {speed!r}", speed=speed)
    return speeds


def _times(times: ArrayLike | None, until: float) -> Reals:
    if times is None:
        return np.linspace(0.0, until, _ROWS)
    try:
        rows = np.array(times, np.float64, ndmin=1)
    except (TypeError, ValueError, OverflowError):
        rows = np.array([np.nan])
    if rows.ndim != 1 or not len(rows) or not (np.diff(rows) > 0).all() or not 0 <= rows[0] <= rows[-1] <= until:
        raise LinkageError("times: expected increasing times between 0 and {until:g} s", until=until)
    return rows


_NO_WAY = message(
    "The motion cannot be followed beyond {time:n} s, {values}: there the linkage branches, the law of a cam jumps in "
    "its speed, whatever has mass stands still at any speed of the drives, or nothing serves as a coordinate."
)


_NO_END = message(
    "At {time:n} s, {values}, steps get too short for an end to come: a load that is given as a function jumps there, "
    "or something changes far faster than the motion."
)


class ChartedSteps(DOP853):  # type: ignore[misc]  # scipy has no types
    """DOP853, whose steps the kernel takes as long as they lie on charts whose series are known."""

    t: float
    h_abs: float
    y: Reals
    f: Reals
    _METHOD = (np.ascontiguousarray(DOP853.A), DOP853.B, DOP853.E3, DOP853.E5)
    _BETWEEN = (DOP853.A_EXTRA, DOP853.D)

    def __init__(self, free: FreeLinkage, *given: Any, **named: Any) -> None:
        self._free = free
        super().__init__(*given, **named)

    def _step_impl(self) -> tuple[bool, str | None]:
        taken = self._by_kernel()
        if taken is None and (series := self._free.series) is not None:
            with suppress(Blocked):
                # The chart at the end of the step is perhaps the one that lacks.
                series.at(self.y[0] + self.h_abs * self.y[1], self.y[1])
                taken = self._by_kernel()
        if taken is None:
            outcome: tuple[bool, str | None] = super()._step_impl()
            return outcome
        time, self.h_abs, state, rates, evaluations = taken
        self._free.evaluations += evaluations
        self.h_previous, self.y_old = time - self.t, self.y
        self.t, self.y, self.f = time, state, rates[-1]
        self.K_extended[: len(rates)] = rates
        return True, None

    def leap(self, stops: Reals) -> tuple[Reals, Reals] | None:
        """Steps on charts that are known: times and states after each (n, 4), states at the stops passed (m, 3).

        The last one ends where others than these steps must be looked for, or coordinates may be exchanged. None if
        there is no such step.
        """
        series = self._free.series
        if series is None:
            return None
        table, calm = series.smooth(float(self.y[0]))
        if not len(table.ends):
            return None
        method, lengths, errors = (*self._METHOD, *self._BETWEEN), (self.h_abs, self.t_bound), (self.rtol, self.atol)
        steps, passed, rate, self.h_abs, evaluations = free_run(
            *table, *method, calm, self.t, self.y, self.f, *lengths, *errors, _MOST, stops
        )
        self._free.evaluations += evaluations
        if not len(steps):
            return None
        self.t_old, self.t, self.y, self.f = self.t, float(steps[-1, 0]), steps[-1, 1:], rate
        if self.t >= self.t_bound:
            self.status = "finished"
        return steps, passed

    def _by_kernel(self) -> tuple[float, float, Reals, Reals, int] | None:
        series = self._free.series
        if series is None or not len(series.table.ends):
            return None
        start, lengths, errors = (self.t, self.y, self.f), (self.h_abs, self.t_bound), (self.rtol, self.atol)
        return free_step(*series.table, *self._METHOD, *start, *lengths, *errors)


class _Run:
    """A free motion while it is followed."""

    def __init__(self, free: FreeLinkage, until: float, times: Reals, tolerance: float, stiff: bool) -> None:
        self.free, self.until, self.times, self.tolerance = free, until, times, tolerance
        self.method = partial(Radau, jac=self._slopes) if stiff else partial(ChartedSteps, free)
        self.usual = np.zeros(0)  # of y: what is usual for each
        self.written = list[dict[str, Any]]()  # the columns of `Simulation`, of rows in the same coordinates
        self.points = list[tuple[float, Reals, bool]]()  # not written yet: time, state, whether it is a row
        self.since: Kept | None = None  # what their angles are counted on from
        self.steps = 0
        self.ahead = (0, 0.0)  # after so many evaluations it was so far
        self.reason: Message | None = None
        self.count = free.coordinates.count
        self.seams = Seams(free)
        self.watched: list[Watch] = []
        self.used = list[tuple[float, tuple[str, ...]]]()

    def followed(self, q: Reals, v: Reals, ends: Mapping[str, tuple[float, float]]) -> Simulation:
        """The motion from values and speeds of the drives."""
        free = self.free
        try:
            q, v, first = free.beginning(q, v)
            self.used = [(0.0, free.coordinates.plan.linkage.mechanism.drive_names())]
        except Blocked:
            values = drive_values(free.plan.linkage, tuple(map(float, q)))
            raise LinkageError(
                "at {values} the linkage branches: say with branch= on which way it moves on", values=values
            ) from None
        free.keep(first)
        free.check(first)
        jumps = Jumps(free, first, self.until)
        self.reason = jumps.held
        self.watched = [
            *watched_ends(free, first, ends),
            *watched_motors(free, first),
            *watched_contacts(free, first),
            *jumps.watched(),
            *self.seams.watched(),
        ]
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # of steps that lead where the linkage cannot be assembled
            self._follow(first, np.concatenate([q, v, [0.0]]))
        return self._simulation()

    def _follow(self, first: Instants, y: Reals) -> None:
        acceleration = self.free.acceleration(first)
        self._note([(0.0, y, bool(self.times[0] == 0))])
        self.reason = self.reason or why_not_started(self.free, first, acceleration)
        if self.reason is not None:
            return
        solver = self._solver(0.0, y, acceleration[0])
        while solver.status == "running":
            solver = self._step(solver)
            self.reason = self.reason or self._no_end(solver)
            if self.reason is not None:
                return
            now = self._at(solver.t, solver.y)
            other = self.free.sets.exchanged(self.free.coordinates, now.jets, self._parts(solver.y)[1])
            if other is not None:
                self._write()
                self.free.coordinates, q, v = other
                self.used.append((solver.t, self.free.coordinates.plan.linkage.mechanism.drive_names()))
                y = np.concatenate([q, v, solver.y[-1:]])
                now = self._at(solver.t, y)
                self._note([(solver.t, y, False)])
                if solver.t < self.until:
                    solver = self._solver(solver.t, y, self.free.acceleration(now)[0], solver.h_abs)
            self.free.keep(now)

    def _step(self, solver: DOP853 | Radau) -> DOP853 | Radau:
        """One step, or many where nothing happens between them; what it passes is noted. Who takes the next one."""
        begin = solver.t
        if isinstance(solver, ChartedSteps) and all(watch.is_seam for watch in self.watched):
            leapt = solver.leap(self._stops(begin, self.until))
            if leapt is not None:
                steps, passed = leapt
                self.steps += len(steps)
                stops = self._stops(begin, solver.t)
                ends = [(t, state, False) for t, state in zip(steps[:, 0].tolist(), steps[:, 1:], strict=True)]
                rows = [(t, state, True) for t, state in zip(stops.tolist(), passed, strict=True)]
                self._note(sorted([*rows, *ends], key=lambda point: point[0]))
                if len(steps) > 1:
                    self.free.keep(self.free.instants(steps[:-1, 0], *self._parts(steps[:-1, 1:])))
                return solver
        if self.watched:
            solver.h_abs = min(solver.h_abs, self.seams.look(self._at(begin, solver.y)))
        before = copy(solver)
        solver.step()
        self.steps += 1
        if solver.status == "failed" or not np.isfinite(solver.y).all():
            steady = solver.status == "failed" and np.isfinite(solver.y).all() and np.isfinite(solver.f).all()
            jumps = steady and not self.free.equations.acting.of_the_pose
            self.reason = self._endless(solver) if jumps else self._no_way(solver.t_old or 0.0)
            return solver
        stops = self._stops(begin, solver.t)
        if len(stops) or self.watched:
            path = solver.dense_output()
            event = self._event(path, begin, solver.t)
            if event is not None and event[1].is_seam:
                solver, event = self._up_to(event[1], event[0], before, solver)
                stops, path = self._stops(begin, solver.t), solver.dense_output()
            if event is not None:
                return self._after(event, path, solver)
            self._note([(t, path(t), True) for t in stops.tolist()])
        self._note([(solver.t, solver.y, False)])
        return solver

    def _up_to(
        self, seam: Watch, near: float, before: DOP853 | Radau, solver: DOP853 | Radau
    ) -> tuple[DOP853 | Radau, tuple[float, Watch] | None]:
        """A step over a seam, taken again to end at it: who takes the next one, and the event if it came so far."""
        taken = solver

        def gap(t: float) -> float:
            nonlocal taken
            taken = copy(before)
            if t > before.t:
                taken.h_abs = taken.max_step = t - before.t
                taken.step()
                taken.max_step = np.inf
            left = seam.gap(self._at(taken.t, taken.y))
            return 0.0 if abs(left) <= AT_SEAM else left

        end = solver.t if seam.gap(self._at(solver.t, solver.y)) < 0 else near
        if gap(end) < 0:
            end = float(brentq(gap, before.t, end, xtol=1e-15 * self.until))
        arrived = gap(end) <= 0
        return taken, (taken.t, seam) if arrived else None

    def _after(
        self, event: tuple[float, Watch], path: Callable[[float], Reals], solver: DOP853 | Radau
    ) -> DOP853 | Radau:
        """What goes on where an event ends a step, if it does not end the motion."""
        (end, watch), begin = event, solver.t_old
        self._note([(t, path(t), True) for t in self._stops(begin, end).tolist()])
        y = path(end)
        self._note([(end, y, False)])
        now = self._at(end, y)
        self.reason = watch.met(now)
        if self.reason is not None or end >= self.until:
            return solver
        self._write()
        watch.passed(now)
        self.free.keep(now)
        self._note([(end, y, False)])
        return self._solver(end, y, self.free.acceleration(now)[0], solver.h_abs)

    def _no_end(self, solver: DOP853 | Radau) -> Message | None:
        """The reason if steps are so short that there is no end of them."""
        if self.free.evaluations - self.ahead[0] < _MANY or self.free.equations.acting.of_the_pose:
            return None
        last, self.ahead = self.ahead[1], (self.free.evaluations, solver.t)
        if solver.t - last > _SHORT * self.until:
            return None
        return self._endless(solver)

    def _endless(self, solver: DOP853 | Radau) -> Message:
        values = drive_values(self.free.plan.linkage, tuple(self._at(solver.t, solver.y).moving.drives[0].tolist()))
        return _NO_END.filled(time=solver.t, values=values)

    def _stops(self, begin: float, end: float) -> Reals:
        """The rows that are asked for after one time and up to another."""
        first, last = np.searchsorted(self.times, [begin, end], side="right")
        return self.times[first:last]

    def _note(self, points: list[tuple[float, Reals, bool]]) -> None:
        if not self.points:
            self.since = self.free.last
        self.points += points

    def _solver(self, t: float, y: Reals, acceleration: Reals, step: float | None = None) -> DOP853 | Radau:
        """An integrator; what is small is measured by the size of the coordinates and the time the motion takes."""
        free, count = self.free, self.count
        usual = free.coordinates.scale
        speeds = np.abs(y[count : 2 * count]) + np.sqrt(np.abs(acceleration) * usual) + usual / self.until
        kinetic, _ = free.energies(self._at(t, y))
        least = np.concatenate([usual, speeds, [float(kinetic[0]) + float(np.abs(acceleration) @ usual) or 1.0]])
        self.usual = least
        options = {} if step is None else {"first_step": min(step, self.until - t)}
        return self.method(
            self._rate, t, y, self.until, rtol=self.tolerance, atol=_ABSOLUTE * self.tolerance * least, **options
        )

    def _parts(self, y: Reals) -> tuple[Reals, Reals]:
        return y[..., : self.count], y[..., self.count : 2 * self.count]

    def _at(self, t: float, y: Reals) -> Instants:
        return self.free.instant(t, *self._parts(y))

    def _rate(self, t: float, y: Reals) -> Reals:
        """Y' of (q, q', work); NaN where the linkage does not go, so that the step is taken shorter."""
        try:
            q, v = self._parts(y)
            acceleration, power = self.free.rates(t, q, v)
            return np.concatenate([v, acceleration, [power]])
        except (Blocked, np.linalg.LinAlgError):
            return np.full(len(y), np.nan)

    def _slopes(self, t: float, y: Reals) -> Reals:
        """The derivatives of y' by y, for the implicit method: by small steps, since large ones may lead nowhere."""
        here, slopes = self._rate(t, y), np.zeros((len(y), len(y)))
        for k in range(2 * self.count):
            for step in _NEARBY * max(abs(y[k]), self.usual[k]) * np.array([1.0, -1.0]):
                moved = y.copy()
                moved[k] += step
                slopes[:, k] = (self._rate(t, moved) - here) / (moved[k] - y[k])
                if np.isfinite(slopes[:, k]).all():
                    break
        return np.nan_to_num(slopes, nan=0.0)

    def _write(self) -> None:
        """What the rows noted are, in the coordinates of the moment."""
        free, points = self.free, self.points
        asked = np.array([is_row for _, _, is_row in points], bool)
        if asked.any():
            now, free.last = free.last, self.since
            states = np.array([y for _, y, _ in points])
            rows = free.instants(np.array([t for t, _, _ in points]), *self._parts(states)).picked(asked)
            self.written.append(self._columns(rows, states[asked, -1]))
            free.last = now
        self.points = []

    def _columns(self, rows: Instants, work: Reals) -> dict[str, Any]:
        free, moving = self.free, rows.moving
        acceleration = free.acceleration(rows)
        places, rates = rows.derivatives(acceleration)
        kinetic, potential = free.energies(rows)
        return {
            "times": moving.time,
            "drives": moving.drives,
            "speeds": moving.speeds,
            "accelerations": free.own_acceleration(rows, acceleration),
            "places": places,
            "turns": moving.turns,
            "rates": rates,
            "whole": whole_turns(moving.angles, moving.turns),
            "kinetic": kinetic,
            "potential": potential,
            "work": work,
        }

    def _simulation(self) -> Simulation:
        """The rows as arrays; at least the last instant."""
        if not self.written and not any(is_row for _, _, is_row in self.points):
            self.points[-1] = (*self.points[-1][:2], True)
        self._write()
        columns = {
            name: np.concatenate([part[name] for part in self.written], axis=int(name in _BY_ORDER))
            for name in self.written[0]
        }
        return Simulation(
            **columns,
            linkage=self.free.plan.linkage,
            plan=self.free.plan,
            coordinates=tuple(self.used),
            steps=self.steps,
            evaluations=self.free.evaluations,
            reason=self.reason,
        )

    def _no_way(self, t: float) -> Message:
        last = self.free.last
        drives = last.drives[0] if last is not None else self.free.coordinates.near
        return _NO_WAY.filled(time=t, values=drive_values(self.free.plan.linkage, tuple(drives.tolist())))

    # --- events --------------------------------------------------------------------------------------

    def _event(self, path: Callable[[float], Reals], begin: float, end: float) -> tuple[float, Watch] | None:
        """The first event in a step: when, and what was looked at."""
        events = []
        for watch in self.watched:

            def gap(t: float, watch: Watch = watch) -> float:
                return watch.gap(self._at(t, path(t)))

            looks = np.linspace(begin, end, _LOOKS + 1)
            gaps = [gap(t) for t in looks]
            if min(gaps) < 0:
                k = int(np.argmax(np.array(gaps) < 0))
                t = float(looks[0]) if k == 0 else float(brentq(gap, looks[k - 1], looks[k], xtol=1e-14 * self.until))
                events.append((t, watch))
        return min(events, key=lambda event: event[0], default=None)
