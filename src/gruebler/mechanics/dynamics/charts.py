"""Poses of a linkage with one drive as functions of that drive, piece by piece, through exact change points too.

A chart is a piece of one branch as Chebyshev series of the drive. It is found from poses that the kernel walks to; one
round a change point from poses on both sides, behind it with the other signs. docs/theory/free-motion.md.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev, polynomial

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.mechanics.kinematics.determinants import determinants
from gruebler.mechanics.kinematics.kernel_calls import SolvedRows, run_rows
from gruebler.mechanics.kinematics.law_directions import law_direction
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose
from gruebler.mechanics.kinematics.root_finding import bracketed_root

_DEGREE = 17
_NODES = 24  # of an ordinary chart
_BOTH_SIDES = 48  # of a chart round a change point, less those in its middle
_GAP = 0.25  # of the half width: so near to a change point no pose is taken
_WIDTHS = (0.5, 0.25, 0.12, 0.06, 0.03, 0.015, 0.007, 0.003)  # radians or sizes: of ordinary charts, tried in turn
_WIDE = (4.0, 2.0, 1.0)  # of wheels, which turn many times and never come back
_HALF_WIDTHS = tuple(2.0 ** (-k / 2) for k in range(15))  # likewise of charts round a change point
_USED = 0.7  # the part of a chart round a change point that is used: beyond it ordinary charts go on
_FIT = 1e-11  # of the largest value: an ordinary chart must fit all its poses and derivatives so well
_FIT_OF_LAWS = 1e-9  # likewise with cams and the like, whose accelerations are those of polynomials
_FIT_AT_CHANGE = 1e-10  # likewise round a change point: that both sides lie on one polynomial is the proof
_SOUND = 1e-2  # a pose with a smaller root is not walked on from: signs read next to a change point lose the branch
_READ = 1e-5  # the signs of a pose with a smaller root are not read
_FLIPS = 1e-2  # a root that comes so near to zero in the change point goes through it
_FORETELLING = 9  # the degree by which unknowns of larger groups are foretold behind a change point
_LOOKED = (0.05, 0.015, 0.004)  # radians or sizes between the poses from which a zero is foretold, tried in turn
_FORETOLD = 12  # so many times that far it is
_AT_JOINT = 1e-9  # radians: a law so near to the end of one of its pieces is at it
_SEAM = 1e-7  # charts that differ by more where they meet are not one branch, or there is an impact
_ONWARD = 0.1  # of the half width: so far a chart round a change point leads on at least
_PERIOD = 2 * np.pi
_FAR = 2 * _PERIOD  # radians or sizes: a trial step that leads farther beyond all charts is to be taken shorter
_SAME = 1e-9  # in sizes: poses that differ by less are one

_ORDERS = np.arange(_DEGREE + 1)
_ZEROS = np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)  # where poses of an ordinary chart are taken
_AT_ZEROS: Reals = np.asarray(chebyshev.chebvander(_ZEROS, _DEGREE), np.float64)
_SIGNS = np.where(_ORDERS % 2, -1.0, 1.0)  # T_k(-x) by T_k(x)
_WEIGHTS = np.where(_ORDERS, 2.0, 1.0) / _NODES  # the T_k are orthogonal there, so that least squares are sums


class Blocked(Exception):
    """The drives cannot get there."""


class Jets(NamedTuple):
    """A pose, and for each row of drive speeds (without accelerations) how it moves."""

    places: Complexes
    """(3, rows, links): origins, velocities, accelerations."""
    turns: Complexes
    """(links,)"""
    rates: Reals
    """(2, rows, links): angular velocities and accelerations."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Chart:
    """Poses on a piece of a branch."""

    low: float
    high: float
    """The part of the drive's axis on which it is used."""
    middle: float
    half: float
    """Where its series lie in [-1, 1]."""
    series: Complexes
    """(degree + 1, 6 links): origins and their first two derivatives in sizes; turns, first and second rates."""
    starts: tuple[ReferencePose, ReferencePose]
    """Sound poses at or near both ends, from which the kernel walks on."""


class Charts:
    """All poses that a drive reaches on one branch from a start, found where they are asked for."""

    def __init__(self, plan: Plan, start: ReferencePose) -> None:
        self.plan = plan
        self.links = len(plan.lower.mechanism.chain.links)
        self.scale = 1.0 if plan.linkage.mechanism.drives[0].turning else plan.lower.size
        self._branching = plan.branching
        self._laws = [c for group in plan.conditions for c in group if c.law.pieces]
        self._joints = [(c, joint) for c in self._laws for joint in c.law.joints]
        self.known: list[Chart] = []
        """Side by side along the drive."""
        self.current: Chart | None = None
        """The one that was asked for last."""
        self.seams = set[float]()
        """Drives at which a law passes from one piece to the next; no chart reaches over one."""
        self.closed: float | None = None
        """The low end of a whole turn, once it is known that it comes back."""
        self._blocked = set[int]()  # the sides, 1 and -1, on which the branch ends
        self._start = start

    def jets(self, q: float) -> Jets:
        """The pose and its derivatives by the drive. Raises `Blocked` where the branch does not lead."""
        chart, x = self.chart(q)
        jets = self.jets_on(chart, np.array([x]))
        return Jets(jets.places, jets.turns[0], jets.rates)

    def chart(self, q: float) -> tuple[Chart, float]:
        """The chart on which the drive lies, and where in [-1, 1]. Raises `Blocked` where the branch does not lead."""
        at, chart = self._reduced(q), self.current
        if chart is None or not chart.low <= at <= chart.high:
            chart = self.current = self._found(q)
            at = self._reduced(q)
        return chart, min(max((at - chart.middle) / chart.half, -1.0), 1.0)

    def walked(self, q: float) -> Jets:
        """The same from the kernel, near the start: next to a limit, too. Raises `Blocked` in a change point."""
        rows = self._rows(np.array([q]), self._start)
        if rows is None or self._least(rows)[0] < _READ:
            raise Blocked
        return Jets(rows.places[:, 1:], rows.turns[1], rows.rates[:, 1:])

    def jets_on(self, chart: Chart, x: Reals) -> Jets:
        """Poses and derivatives by the drive at places of a chart, a row each; turns are (rows, links)."""
        basis = np.cos(np.arccos(x)[:, None] * _ORDERS)
        numbers = np.einsum("rk,kn->rn", basis, chart.series.view(np.float64))  # BLAS would start threads for this
        six = numbers.view(np.complex128).reshape(len(x), 6, self.links).swapaxes(0, 1)
        return Jets(six[:3] * self.plan.lower.size, six[3] / np.abs(six[3]), six[4:].real)

    def jets_at(self, q: Reals) -> Jets:
        """Poses and derivatives by the drive at many values, a row each; turns are (rows, links)."""
        rows = dict[Chart, list[tuple[int, float]]]()
        for row, value in enumerate(q.tolist()):
            chart, x = self.chart(value)
            rows.setdefault(chart, []).append((row, x))
        parts = [self.jets_on(chart, np.array([x for _, x in at])) for chart, at in rows.items()]
        order = np.argsort([row for at in rows.values() for row, _ in at])
        places, turns, rates = (np.concatenate(all_, axis=-2)[..., order, :] for all_ in zip(*parts, strict=True))
        return Jets(places, turns, rates)

    def _reduced(self, q: float) -> float:
        """The drive less whole turns, if a turn leads back to the same pose."""
        return q if self.closed is None else self.closed + (q - self.closed) % _PERIOD

    def _found(self, q: float) -> Chart:
        """The chart on which the drive lies; charts are put beside charts until one reaches there."""
        if not np.isfinite(q):
            raise Blocked
        self.known = self.known or [self._first()]
        while True:
            at = self._reduced(q)
            place = bisect_right(self.known, at, key=lambda chart: chart.low) - 1
            if place >= 0 and at <= self.known[place].high:
                return self.known[place]
            side = 1 if at > self.known[-1].high else -1
            edge = self.known[-1].high if side > 0 else self.known[0].low
            if side in self._blocked or abs(at - edge) > _FAR * self.scale:
                raise Blocked
            self.known.insert(len(self.known) if side > 0 else 0, self._next(side))
            if self.closed is None and self._comes_back():
                self.closed = self.known[0].low

    def _comes_back(self) -> bool:
        """Whether the charts make a whole turn at whose ends the linkage lies alike; then they are all."""
        low, high = self.known[0].low, self.known[-1].high
        if not self.plan.linkage.mechanism.drives[0].turning or self.plan.wheels or high - low < _PERIOD:
            return False
        again = next(chart for chart in self.known if chart.low <= low + _PERIOD <= chart.high)
        gap = _pose_on(self.known[0], low) - _pose_on(again, low + _PERIOD)
        return bool(np.abs(gap).max() < _SAME)

    # --- finding them --------------------------------------------------------------------------------

    def _rows(self, path: Reals, start: ReferencePose) -> SolvedRows | None:
        """Poses along a path of the drive, walked to from a start; None unless all are reached with their rates."""
        whole = np.concatenate([start.drives, path])[:, None]
        speeds = np.zeros((2, *whole.shape))
        speeds[0] = 1.0
        rows = run_rows(self.plan, whole, speeds, start.signs.copy(), start.unknowns.copy())
        good = rows.reached == len(whole) and np.isfinite(rows.rates[:, 1:]).all()
        return rows if good and np.isfinite(rows.places[:, 1:]).all() else None

    def _numbers(self, rows: SolvedRows) -> Complexes:
        size = self.plan.lower.size
        parts = [rows.places[:, 1:] / size, rows.turns[None, 1:], rows.rates[:, 1:] + 0j]
        return np.concatenate(parts).swapaxes(0, 1).reshape(len(rows.turns) - 1, -1)

    def _least(self, rows: SolvedRows) -> Reals:
        return np.asarray(np.abs(rows.roots[1:, self._branching]).min(axis=1, initial=1.0))

    def _state(self, rows: SolvedRows, row: int, q: float) -> ReferencePose:
        return ReferencePose(np.array([q]), np.where(rows.roots[row] < 0, -1.0, 1.0), rows.unknowns[row])

    def _first(self) -> Chart:
        """The chart round the start."""
        start = self._start
        q = float(start.drives[0])
        beside = self._rows(np.array([q]), start)
        if beside is not None and self._least(beside)[0] > _SOUND:
            for width in _WIDTHS:
                high = self._smooth(q, q + width * self.scale / 2, start)
                low = q if self._at_joint(q, start) else self._smooth(q, q - width * self.scale / 2, start)
                chart = self._ordinary(low, high, start)
                if chart is not None:
                    return chart
        chart = self._round_change(start, q, 1.0)  # the signs are those on the way forward
        if chart is None:
            raise Blocked
        return chart

    def _next(self, side: int) -> Chart:
        """The chart beside the last one on a side."""
        last = self.known[-1 if side > 0 else 0]
        edge, start = (last.high, last.starts[1]) if side > 0 else (last.low, last.starts[0])
        for width in _WIDE + _WIDTHS if self.plan.wheels and not self._laws else _WIDTHS:
            low, high = sorted((edge, self._smooth(edge, edge + side * width * self.scale, start)))
            chart = self._ordinary(low, high, start)
            if chart is None and width == _WIDTHS[0]:
                chart = self._beside_change(start, edge, side)
            if chart is not None and _mismatch(last, chart, edge) < _SEAM:
                return chart
        self._blocked.add(side)
        raise Blocked

    def _beside_change(self, start: ReferencePose, edge: float, side: int) -> Chart | None:
        """A chart round a change point that reaches from here to its other side."""
        chart = self._round_change(start, edge, -float(side))
        if chart is None or abs(edge - chart.middle) > chart.half:
            return None
        beyond = chart.high - edge if side > 0 else edge - chart.low
        if beyond < _ONWARD * chart.half:
            return None
        return replace(chart, low=edge) if side > 0 else replace(chart, high=edge)

    def _past_joints(self, path: Reals, start: ReferencePose) -> Complexes | None:
        """(rows, joints of laws): where the laws are looked up, as directions against the ends of their pieces."""
        rows = self._rows(path, start)
        if rows is None:
            return None
        places, turns = rows.places[0, 1:], rows.turns[1:]
        seen = {c: law_direction(self.plan, places, turns, c) for c, _ in self._joints}
        return np.stack([seen[c] * np.exp(-1j * joint) for c, joint in self._joints], axis=1)

    def _at_joint(self, q: float, start: ReferencePose) -> bool:
        """Whether a law passes from one piece to the next there."""
        seen = self._past_joints(np.array([q]), start) if self._joints else None
        if seen is None or not (np.abs(seen - 1) < _AT_JOINT).any():
            return False
        self.seams.add(q)
        return True

    def _smooth(self, edge: float, far: float, start: ReferencePose) -> float:
        """So far towards another value of the drive as no law of a cam passes from one piece to the next."""
        path = np.linspace(edge, far, _NODES)
        seen = self._past_joints(path, start) if self._joints else None
        if seen is None:
            return far
        above = np.where(np.abs(seen - 1) < _AT_JOINT, np.roll(seen, -1, axis=0).imag, seen.imag) >= 0
        passed = (above[:-1] != above[1:]) & (seen.real[:-1] > 0)
        if not passed.any():
            return far
        row = int(passed.any(axis=1).argmax())
        columns = np.flatnonzero(passed[row])

        def off(q: Reals) -> Reals:
            there = [self._past_joints(np.array([value]), start) for value in q]
            return np.array([np.nan if z is None else z[0, k].imag for z, k in zip(there, columns, strict=True)])

        ends = bracketed_root(off, np.full(len(columns), path[row]), np.full(len(columns), path[row + 1]))
        seam = float(ends[np.abs(ends - edge).argmin()])
        self.seams.add(seam)
        return seam

    def _ordinary(self, low: float, high: float, start: ReferencePose) -> Chart | None:
        """A chart of poses that the kernel walks to without passing a change point."""
        middle, half = (low + high) / 2, (high - low) / 2
        down = bool(start.drives[0] > middle)
        nodes = _ZEROS if down else -_ZEROS  # the near end first
        rows = self._rows(middle + half * nodes, start)
        if rows is None or (self._least(rows) < _SOUND).any():
            return None
        signs = np.sign(rows.roots[:, self._branching])
        if (signs != signs[0]).any():
            return None
        values = self._numbers(rows)
        basis: Reals = _AT_ZEROS if down else _AT_ZEROS * _SIGNS
        series = _that_fits(basis, (basis * _WEIGHTS).T @ values, values, _FIT_OF_LAWS if self._laws else _FIT)
        if series is None:
            return None
        ends = [self._state(rows, row, middle + half * nodes[row - 1]) for row in (1, len(nodes))]
        starts = (ends[1], ends[0]) if down else (ends[0], ends[1])
        return Chart(low=low, high=high, middle=middle, half=half, series=series, starts=starts)

    def _round_change(self, start: ReferencePose, edge: float, back: float) -> Chart | None:
        """A chart round an exact change point near a place, if there is one, and one polynomial fits both sides of it.

        It is not walked through: behind it the dyads whose roots go through zero have the other sign, and unknowns of
        larger groups are where a polynomial leads. ``back`` is the way away from it, 1 or -1.
        """
        for looked in _LOOKED:
            change = self._zero(start, edge, back * looked * self.scale)
            if change is None:
                continue
            middle, flips, near = change
            for half in _HALF_WIDTHS:
                chart = self._both_sides(near, middle, half * self.scale, back, flips)
                if chart is not None:
                    return chart
        return None

    def _zero(self, start: ReferencePose, edge: float, step: float) -> tuple[float, Flags, ReferencePose] | None:
        """Where a root or determinant goes through zero near a place, which roots do, and a sound pose beside it."""
        steps: Reals = step * np.arange(8.0)
        origin = edge + 2 * step
        zero = 0.0
        for _ in range(3):  # where it is foretold from afar it is looked for again, from nearer by
            rows = self._rows(origin + steps, start)
            if rows is None or (self._least(rows) < _SOUND).any():
                return None
            seen = determinants(self.plan, rows.places[0, 1:], rows.turns[1:])
            fits = polynomial.polyfit(steps, np.hstack([rows.roots[1:, self._branching], seen]), 7)
            zeros = [
                z.real
                for column in fits.T
                for z in polynomial.polyroots(column)
                if abs(z.imag) < 0.02 * abs(step) and z.real / step < 1
            ]
            zero = min(zeros, key=abs, default=np.inf)
            if not abs(zero) < _FORETOLD * abs(step):
                return None
            start = self._state(rows, 1, float(origin))
            middle = origin + zero
            if abs(zero) < 3.5 * abs(step):
                break
            origin = middle + 3 * step
        flips = np.zeros(len(self.plan.dyads), bool)
        flips[self._branching] = np.abs(polynomial.polyval(zero, fits))[: len(self._branching)] < _FLIPS
        return float(middle), flips, start

    def _both_sides(self, start: ReferencePose, middle: float, half: float, back: float, flips: Flags) -> Chart | None:
        nodes = back * np.cos(np.pi * (np.arange(_BOTH_SIDES) + 0.5) / _BOTH_SIDES)  # from here to the other side
        nodes = nodes[np.abs(nodes) > _GAP]
        count = len(nodes) // 2
        path = middle + half * nodes
        here = self._rows(path[:count], start)
        if here is None:
            return None
        signs = np.where(here.roots[count] < 0, -1.0, 1.0)
        foretold = chebyshev.chebval(nodes[count], chebyshev.chebfit(nodes[:count], here.unknowns[1:], _FORETELLING))
        across = ReferencePose(path[count : count + 1], np.where(flips, -signs, signs), foretold)
        there = self._rows(path[count:], across)
        if there is None:
            return None
        values = np.concatenate([self._numbers(here), self._numbers(there)])
        series = _fitted(nodes, values, _FIT_AT_CHANGE)
        if series is None:
            return None
        ends = [self._state(here, 1, float(path[0])), self._state(there, count, float(path[-1]))]
        first, last = ends if back < 0 else ends[::-1]
        low, high = middle - _USED * half, middle + _USED * half
        return Chart(low=low, high=high, middle=middle, half=half, series=series, starts=(first, last))


def _pose_on(chart: Chart, q: float) -> Complexes:
    """Origins and turns."""
    six = chebyshev.chebval((q - chart.middle) / chart.half, chart.series).reshape(6, -1)
    return np.concatenate([six[0], six[3]])


def _mismatch(before: Chart, behind: Chart, q: float) -> float:
    """By how much two charts differ where they meet: places in sizes, turns, and speeds by the largest."""
    first, second = (
        chebyshev.chebval((q - chart.middle) / chart.half, chart.series).reshape(6, -1)[[0, 3, 1, 4]]
        for chart in (before, behind)
    )
    gaps = np.abs(first - second).max(axis=1)
    return float(max(gaps[0], gaps[1], *(gaps[2:] / np.abs(second[2:]).max())))


def _fitted(nodes: Reals, values: Complexes, within: float) -> Complexes | None:
    """Chebyshev series through values by least squares; None if they do not fit.

    What each order of derivatives misses is compared with the largest of that order.
    """
    basis = np.asarray(chebyshev.chebvander(nodes, _DEGREE), np.float64)
    return _that_fits(basis, np.linalg.lstsq(basis, values)[0].astype(np.complex128), values, within)


def _that_fits(basis: Reals, series: Complexes, values: Complexes, within: float) -> Complexes | None:
    gaps, sizes = (
        np.abs(array).reshape(len(basis), 2, 3, -1).max(axis=(0, 1, 3)) for array in (basis @ series - values, values)
    )
    sizes[2] = max(sizes[2], sizes[1] ** 2)  # what turns evenly, as wheels do, has no second derivatives but this part
    return series if (gaps <= within * sizes).all() else None
