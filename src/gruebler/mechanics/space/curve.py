"""The curve of all positions of a linkage in space with one drive: the drive is an unknown like the others.

Method, and what may err: docs/theory/space.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, pi, tau
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.kinematics.root_finding import bracketed_root
from gruebler.mechanics.screws.rigid_motions import exponential
from gruebler.mechanics.space.closure import Place
from gruebler.mechanics.space.following import RANK, Setting
from gruebler.mechanics.space.motion import SpatialMotion

_NARROW = 1e-4  # radians and sizes, as in the core: no longer are steps over which the determinant turns over
_LEAST = 1e-6  # radians and sizes: the smallest step
_TURNS = 8  # of Newton's method
_CLOSED = 1e-12  # radians and sizes, as in the core
_SETTLED = 1e-14  # one turn more would only change by rounding
_APART = 0.2  # of a step: a larger correction may lead to another curve
_BENT = 0.9  # the cosine of the angle by which a step may bend
_SAME = 1e-6  # radians and sizes: positions that differ by less are one
_AROUND = 0.01  # radians and sizes: how far apart positions around a crossing are, between which that is found
_OFFSETS = np.array([-4.0, -3, -2, -1, 1, 2, 3, 4])
_CROSSES = 1e-9  # radians and sizes: open by more, a position between others is no crossing
_FOLD = 0.1  # radians and sizes: how far a position in which the drive turns back is looked for


class CurvePoint(NamedTuple):
    """A closed position, and the unit tangent of the curve there (columns,)."""

    place: Place
    tangent: Reals
    derivatives: Reals
    """(conditions, columns)"""


class TracedPoints(NamedTuple):
    """Points in order, where they lie, and how the curve ends."""

    points: list[CurvePoint]
    arcs: Reals
    ended: str
    """Empty if the last is the first again, up to whole turns; ``singular`` or ``long``."""
    crossings: list[tuple[int, CurvePoint]]
    """Positions in which another curve crosses, each with the number of the point before it."""


class ConfigurationCurve:
    """The positions of one drive and of what it moves, around a linkage's reference pose; other drives rest."""

    def __init__(self, set_up: Setting, drive: int = 0) -> None:
        self.set_up, self.closure = set_up, set_up.closure
        self.columns = np.array([set_up.drives[drive], *set_up.passive], np.intp)
        balls = {start + k for start in self.closure.balls for k in range(3)}
        nodes = self.closure.tree.nodes
        self._turning = np.array(
            [nodes[1 + k].turn > 0 and not nodes[1 + k].travel and k not in balls for k in self.columns.tolist()]
        )
        places = {k: column for column, k in enumerate(self.columns.tolist())}
        self._balls = [[places[start + k] for k in range(3)] for start in self.closure.balls]

    # --- one position ----------------------------------------------------------------------------------------------

    def near(self, place: Place, plane: Reals | None = None) -> CurvePoint | None:
        """The position next to a place, across the curve or in the plane through it with that normal; None without."""
        rank, q, last = self.set_up.rank, place.q.copy(), np.inf
        for _ in range(_TURNS):
            gap, by_unknown = self.closure.linearised(Place(q, place.turns))
            opened = float(abs(gap).max(initial=0.0))
            own = by_unknown[:, self.columns]
            left, sizes, right = np.linalg.svd(own)
            if rank and sizes[rank - 1] < RANK * sizes[0]:
                return None
            tangent = right[-1]
            if opened < _SETTLED or (opened < _CLOSED and opened > last / 4):
                return CurvePoint(Place(q, place.turns), tangent, own)
            last = opened
            change = (right[:rank].T / sizes[:rank]) @ (left[:, :rank].T @ gap)
            if plane is not None:
                change -= tangent * (plane @ change) / (plane @ tangent)
            q[self.columns] -= change
        return None

    def moved(self, place: Place, chord: Reals) -> Place:
        """A place whose unknowns differ by a chord (columns,)."""
        q = place.q.copy()
        q[self.columns] += chord
        return Place(q, place.turns)

    def begin(self) -> CurvePoint:
        """The reference pose, with the tangent along which the drive increases."""
        first = self.near(self.closure.reference)
        assert first is not None  # the drive fixes the motion there
        return directed(first, np.eye(len(self.columns))[0] * self.closure.tree.signs[0])

    def counted_anew(self, point: CurvePoint) -> CurvePoint:
        """The same position, the turns of balls counted from there."""
        if not self._balls:
            return point
        q, turns = point.place.q.copy(), point.place.turns.copy()
        for k, start in enumerate(self.closure.balls):
            for node, angle in zip(self.closure.tree.nodes[1 + start :], q[start : start + 3], strict=False):
                turns[k] = turns[k] @ _turn(node.axis, node.sign * angle)
            q[start : start + 3] = 0.0
        again = self.near(Place(q, turns))
        return point if again is None else directed(again, point.tangent)

    def away(self, place: Place) -> Reals:
        """From the reference pose to a place, whole turns left out, (columns,)."""
        chord = place.q[self.columns]
        chord = chord - self.whole_turns(place)
        for columns, turn in zip(self._balls, place.turns, strict=True):
            chord[columns] = _turn_vector(turn)
        return np.asarray(chord)

    # --- along it --------------------------------------------------------------------------------------------------

    def traced(self, first: CurvePoint, longest: float, most: float) -> TracedPoints:
        """Points from the reference pose on in steps of at most `longest`, until it comes back, ends, or `most`."""
        points, arcs, crossings, step = [first], [0.0], list[tuple[int, CurvePoint]](), longest
        while arcs[-1] < most:
            here = points[-1]
            reached = self._next(here, step)
            if reached is None:
                return TracedPoints(points, np.array(arcs), "singular", crossings)
            there, step = reached
            crosses = _mirrored(here, there)
            last = self._last(first, here, there) if len(points) > 2 else None
            there = there if last is None else last
            if crosses and _mirrored(here, there):
                crossings.append((len(points) - 1, self._crossing(here, there)))
            points.append(self.counted_anew(there))
            arcs.append(arcs[-1] + self._distance(here, points[-1]))
            if last is not None:
                return TracedPoints(points, np.array(arcs), "", crossings)
            step = min(1.5 * step, longest)
        return TracedPoints(points, np.array(arcs), "long", crossings)

    def _next(self, here: CurvePoint, step: float) -> tuple[CurvePoint, float] | None:
        while step > _LEAST:
            guess = self.moved(here.place, step * here.tangent)
            near = self.near(guess)
            if near is not None:
                near = directed(near, here.tangent)
                ahead = np.linalg.norm(near.place.q - guess.q) < _APART * step and near.tangent @ here.tangent > _BENT
                if ahead and (step <= _NARROW or not _mirrored(here, near)):  # else it may be a curve beside this one
                    return near, step
            step /= 2
        return None

    def _last(self, first: CurvePoint, here: CurvePoint, there: CurvePoint) -> CurvePoint | None:
        """The reference pose between two points, if it lies there."""
        plane = first.tangent
        before = float(self.away(here.place) @ plane)
        behind = float(self.away(self.counted_anew(there).place) @ plane)
        if not before < 0 <= behind or behind - before > tau / 2:
            return None
        chord = self.way(here, there)
        if np.linalg.norm(self.away(here.place)) > 2 * np.linalg.norm(chord):
            return None
        last = self.near(self.moved(here.place, chord * before / (before - behind)), here.tangent)
        for _ in range(_TURNS):  # in the plane across the tangent of the reference pose
            if last is None:
                return None
            rest = float(self.away(self.counted_anew(last).place) @ plane)
            if abs(rest) < _CLOSED:
                break
            last = self.near(self.moved(last.place, -rest * last.tangent / (plane @ last.tangent)), here.tangent)
        if last is None or np.linalg.norm(self.away(self.counted_anew(last).place)) > _SAME:
            return None
        return directed(last, here.tangent)

    def _crossing(self, here: CurvePoint, there: CurvePoint) -> CurvePoint:
        """Where between two points another curve crosses."""
        chord = self.way(here, there)
        low, high, middle = 0.0, 1.0, here
        while high - low > _SAME:
            share = (low + high) / 2
            reached = self.near(self.moved(here.place, share * chord), chord)
            if reached is None:  # so near that the rank is lost
                break
            middle = directed(reached, chord)
            low, high = (low, share) if _mirrored(here, middle) else (share, high)
        return self._sharper(here, there, (low + high) / 2) or middle

    def _sharper(self, here: CurvePoint, there: CurvePoint, share: float) -> CurvePoint | None:
        """The crossing near a share of the way, by polynomials of degree 7 through eight positions around it.

        Along the curve the determinant of derivatives and tangent is analytic, as all else is; there it vanishes.
        """
        chord = self.way(here, there)
        step = _AROUND / float(np.linalg.norm(chord))
        eight = [self.within(here, there, share + step * offset) for offset in _OFFSETS.tolist()]
        points = [point for point in eight if point is not None]
        if len(points) < len(_OFFSETS):
            return None
        seen = _row_space(here)
        values = np.array([_determinant(seen, point) for point in points])
        coefficients = np.linalg.solve(np.vander(_OFFSETS), values)
        roots = np.roots(coefficients)
        near = roots[np.argmin(abs(roots))]
        if not abs(near) < 1 or near.imag:
            return None
        weights = np.linalg.solve(np.vander(_OFFSETS).T, np.vander([near.real], len(_OFFSETS))[0])
        place = Place(weights @ np.array([point.place.q for point in points]), here.place.turns)
        gap, by_unknown = self.closure.linearised(place)
        tangent = weights @ np.array([point.tangent for point in points])
        if abs(gap).max(initial=0.0) > _CROSSES:
            return None
        return CurvePoint(place, tangent / np.linalg.norm(tangent), by_unknown[:, self.columns])

    def within(self, here: CurvePoint, there: CurvePoint, share: float) -> CurvePoint | None:
        """The position at a share of the way between two neighbouring points, in the plane across that way."""
        chord = self.way(here, there)
        reached = self.near(self.moved(here.place, share * chord), chord)
        return None if reached is None else directed(reached, chord)

    def way(self, here: CurvePoint, there: CurvePoint) -> Reals:
        """From a point to a neighbour, in its own counting of the turns of balls."""
        chord = (there.place.q - here.place.q)[self.columns]
        for k, columns in enumerate(self._balls):
            if (here.place.turns[k] != there.place.turns[k]).any():
                forward = self.closure.tree.nodes[1 + self.closure.balls[k]].sign > 0
                turn = here.place.turns[k].T @ there.place.turns[k]
                chord[columns] += _cardan_angles(turn) if forward else _cardan_angles(turn.T)[::-1]
        return chord

    def _distance(self, here: CurvePoint, there: CurvePoint) -> float:
        """Between neighbours, both with balls counted anew: radians and sizes; of a ball the angle of its turn."""
        chord = (there.place.q - here.place.q)[self.columns]
        for columns, a, b in zip(self._balls, here.place.turns, there.place.turns, strict=True):
            chord[columns] = _turn_vector(a.T @ b)
        return float(np.linalg.norm(chord))

    def whole_turns(self, place: Place) -> Reals:
        """Those of a place against the reference pose, (columns,)."""
        return np.where(self._turning, tau * np.round(place.q[self.columns] / tau), 0.0)

    @staticmethod
    def both_ways(ahead: TracedPoints, behind: TracedPoints) -> tuple[TracedPoints, float]:
        """One curve of what was followed ahead and backwards from a point, and where that point lies."""
        length = float(behind.arcs[-1])
        turned = [point._replace(tangent=-point.tangent) for point in behind.points]
        last = len(turned) - 2
        crossings = [(last - k, point._replace(tangent=-point.tangent)) for k, point in reversed(behind.crossings)]
        return TracedPoints(
            points=[*turned[:0:-1], *ahead.points],
            arcs=np.concatenate([length - behind.arcs[:0:-1], length + ahead.arcs]),
            ended="long" if "long" in (ahead.ended, behind.ended) else ahead.ended,
            crossings=[*crossings, *((len(turned) - 1 + k, point) for k, point in ahead.crossings)],
        ), length

    def fold(self, start: CurvePoint) -> CurvePoint | None:
        """The position at most 0.1 along the tangent in which the drive turns back; None if there is none."""
        length = _LEAST
        while length < _FOLD:
            end = self.near(self.moved(start.place, length * start.tangent), start.tangent)
            if end is None:
                return None
            if directed(end, start.tangent).tangent[0] * start.tangent[0] <= 0:
                return self.between(start, length * start.tangent)
            length *= 2
        return None

    def between(self, start: CurvePoint, chord: Reals) -> CurvePoint | None:
        """The position on a chord (columns,) from a point in which the drive turns back."""

        def at(share: float) -> CurvePoint | None:
            reached = self.near(self.moved(start.place, share * chord), chord)
            return None if reached is None else directed(reached, chord)

        def drives(shares: Reals) -> Reals:
            reached = [at(float(share)) for share in shares]
            return np.array([np.nan if point is None else point.tangent[0] for point in reached])

        return at(float(bracketed_root(drives, np.zeros(1), np.ones(1))[0]))

    # --- what it shows ---------------------------------------------------------------------------------------------

    def motion(self, points: Sequence[CurvePoint]) -> SpatialMotion:
        """The positions as rows, with derivatives up to the second by the length of the curve."""
        tree, units = self.closure.tree, self.closure.units
        orders = 3
        poses = np.zeros((orders, len(points), len(tree.links), 4, 4))
        series = np.zeros((orders, len(points), tree.unknowns))
        derivatives, gap = np.zeros((len(points), self.closure.conditions, len(self.set_up.passive))), 0.0
        rates = np.zeros((orders - 1, 1, 1))
        rates[0] = 1.0
        for row, (place, tangent, _) in enumerate(points):
            leading = int(np.argmax(abs(tangent)))  # by this unknown the curve is a function
            column = self.columns[[leading]]
            others = np.delete(self.columns, leading)
            reached = self.closure.follow(others, column, place.q[column][None], rates, place)
            by_leading = reached.series[1, 0, self.columns], 2 * reached.series[2, 0, self.columns]
            speed = np.sign(tangent[leading]) / np.linalg.norm(by_leading[0])
            bend = -(by_leading[0] @ by_leading[1]) * speed**4
            for given, own in (
                (reached.poses[:, 0], poses[:, row]),
                (reached.series[:, 0] * _FACTORIALS[:, None], series[:, row]),
            ):
                own[0], own[1], own[2] = given[0], speed * given[1], speed**2 * given[2] + bend * given[1]
            derivatives[row] = self.closure.linearised(place)[1][:, self.set_up.passive]
            gap = max(gap, reached.gap)
        balls = {start + k for start in tree.folds for k in (-1, 0, 1)}
        drive = int(self.columns[0])
        return SpatialMotion(
            linkage=tree.linkage,
            drives=series[0, :, [drive]].T * units[drive] * tree.signs[0],
            poses=poses,
            unknowns={key: series[:, :, k] * units[k] for key, k in tree.unknown.items() if k not in balls},
            derivatives=derivatives,
            gap=gap,
            rank=self.set_up.rank,
            idle=tuple(tree.linkage.mechanism.chain.links[rod.link] for rod in tree.rods),
            held=self.set_up.held_joints,
            stop=None,
        )


_FACTORIALS = np.array([1.0, 1.0, 2.0])


def directed(point: CurvePoint, along: Reals) -> CurvePoint:
    """The point with that one of its two tangents that points along a direction."""
    return point if point.tangent @ along > 0 else point._replace(tangent=-point.tangent)


def _mirrored(a: CurvePoint, b: CurvePoint) -> bool:
    """Whether a crossing lies between two points: derivatives and tangent together change their orientation there."""
    seen = _row_space(a)
    return bool(_determinant(seen, a) * _determinant(seen, b) < 0)


def _row_space(point: CurvePoint) -> Reals:
    """The combinations of rows (rank, conditions) that count in a position."""
    return np.linalg.svd(point.derivatives)[0][:, : len(point.tangent) - 1].T


def _determinant(seen: Reals, point: CurvePoint) -> float:
    """Of the rows that count and the tangent."""
    return float(np.linalg.det(np.vstack([seen @ point.derivatives, point.tangent])))


def _turn(axis: int, angle: float) -> Reals:
    return np.asarray(exponential(np.concatenate([angle * np.eye(3)[axis], np.zeros(3)]))[:3, :3])


def _cardan_angles(turn: Reals) -> Reals:
    """The turns about x, y, z that one after the other make a rotation."""
    a, c = np.arctan2(-turn[1, 2], turn[2, 2]), np.arctan2(-turn[0, 1], turn[0, 0])
    return np.array([a, np.arcsin(np.clip(turn[0, 2], -1.0, 1.0)), c])


def _turn_vector(turn: Reals) -> Reals:
    """The axis of a rotation times its angle, (3,); of a half turn nothing but that it is large."""
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    sine, cosine = float(np.linalg.norm(skew)), float(np.trace(turn) - 1) / 2
    if sine < _CLOSED:
        return skew if cosine > 0 else np.full(3, pi)
    return np.asarray(skew * (atan2(sine, cosine) / sine))
