"""Targets assigned to places along a curve in their order, so that the farthest one is as near as possible.

docs/theory/synthesis-curves.md defines the ordered distance and proves what is used here. The distances of all targets
fall and rise between places that are found once; where a target is nearer than a bound is then a list of intervals,
and whether places in order can be chosen from them is decided by one sweep along the curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from gruebler import _core
from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.design.synthesis.ordered_places import Places, lap_about, with_free
from gruebler.design.synthesis.target_orders import Groups, TargetOrder

_PARTS = 2  # of the curve from sample to sample, in each of which a distance has one extreme at most
_SHARP = 1e-10  # of the natural size: so narrow is the bracket of the ordered distance in the end
_EQUAL = 1e-9  # of the natural size: errors that differ by less are equal
_ENTRIES = 2_000_000  # distances that are looked at together


class SmoothCurve(NamedTuple):
    """A curve by samples with exact derivatives, a cubic polynomial of the arc between two of them."""

    arcs: Reals
    """(samples,) rising from 0; a closed curve has its first sample once more at the end."""
    values: Complexes
    """(samples, parts) what is compared with a target, such as the place of a point."""
    rates: Complexes
    """(samples, parts) its derivative by the arc."""
    closed: bool

    @property
    def length(self) -> float:
        """The arc of the last sample."""
        return float(self.arcs[-1])

    def at(self, arcs: Reals) -> tuple[Complexes, Complexes, Complexes]:
        """Values, first and second derivatives; (k, parts) each. On a closed curve arcs wrap around."""
        place = arcs % self.length if self.closed else np.clip(arcs, 0, self.length)
        row = np.clip(np.searchsorted(self.arcs, place, side="right") - 1, 0, len(self.arcs) - 2)
        h = (self.arcs[row + 1] - self.arcs[row])[:, None]
        t = (place - self.arcs[row])[:, None] / h
        first, second = h * self.rates[row], h * self.rates[row + 1]
        gap = self.values[row + 1] - self.values[row]
        square, cube = 3 * gap - 2 * first - second, first + second - 2 * gap
        value = self.values[row] + t * (first + t * (square + t * cube))
        rate = (first + t * (2 * square + 3 * t * cube)) / h
        return value, rate, (2 * square + 6 * t * cube) / h**2


class OrderedMatch(NamedTuple):
    """A place for each target, in order along the curve; those at any time within the same lap."""

    error: float
    """The largest distance of a target from its place."""
    mean: float
    """The root of the mean square distance."""
    arcs: Reals
    """(targets,) rising or falling from group to group; on a closed curve within one lap, perhaps beyond its ends."""

    @property
    def span(self) -> float:
        """How much of the curve lies between the first place and the last."""
        return float(np.ptp(self.arcs))


def preferred(matches: Sequence[OrderedMatch], size: float) -> OrderedMatch:
    """The one of least error, of equal ones that of least mean error, of these the shortest.

    Errors that differ by less than 1e-9 of a natural size are equal, and so are lengths.
    """
    rest = list(range(len(matches)))
    for column in np.array([(match.error / size, match.mean / size, match.span) for match in matches]).T:
        rest = [k for k in rest if column[k] <= column[rest].min() + _EQUAL]
    return matches[rest[0]]


@dataclass(frozen=True, eq=False)
class TargetDistances:
    """Where the distances of targets from a curve fall and rise."""

    curve: SmoothCurve
    targets: Complexes
    """(targets, parts) NaN where a part is free."""
    size: float
    """The natural size of a distance."""

    @cached_property
    def _free(self) -> Flags:
        return np.isnan(self.targets)

    def _settled(
        self, target: Integers, low: Reals, high: Reals, start: Reals, *, rises: float, levels: Reals | None = None
    ) -> Reals:
        """Where half the squared distances in brackets of arcs have a level, by default where they do not change.

        Args:
            target: (k,) the targets.
            low: (k,) lower ends, where the sign is that of -``rises``.
            high: (k,) upper ends.
            start: (k,) where to begin.
            rises: 1 or -1, the sign of the value at the upper ends.
            levels: (k,)
        """
        curve, none = self.curve, np.zeros(0)
        return _core.settle_arcs(
            np.ascontiguousarray(curve.arcs),
            np.ascontiguousarray(curve.values),
            np.ascontiguousarray(curve.rates),
            curve.closed,
            np.ascontiguousarray(self.targets),
            target,
            low,
            high,
            start,
            none if levels is None else levels,
            rises,
        )

    def _gaps(self, target: Integers, arcs: Reals) -> tuple[Complexes, Complexes, Complexes]:
        """What separates places from targets, with its derivatives; 0 where a part is free."""
        value, rate, bend = self.curve.at(arcs)
        free = self._free[target]
        return np.where(free, 0, value - self.targets[target]), np.where(free, 0, rate), np.where(free, 0, bend)

    def _square(self, target: Integers, arcs: Reals) -> tuple[Reals, Reals, Reals]:
        """Half the squared distance, its first and its second derivative."""
        gap, rate, bend = self._gaps(target, arcs)
        square = np.sum(np.abs(gap) ** 2, axis=1) / 2
        slope = np.sum(np.real(np.conj(gap) * rate), axis=1)
        return square, slope, np.sum(np.abs(rate) ** 2 + np.real(np.conj(gap) * bend), axis=1)

    def of(self, arcs: Reals) -> Reals:
        """(targets,) the distance of each target from its place."""
        return np.sqrt(2 * self._square(np.arange(len(self.targets)), arcs)[0])

    def bend(self, arcs: Reals) -> Reals:
        """(targets,) how fast the slope of half the squared distance of each target grows at its place."""
        return self._square(np.arange(len(self.targets)), arcs)[2]

    @cached_property
    def _valleys(self) -> _Valleys:
        """Where each distance is smallest, and the tops on both sides of it."""
        curve, count = self.curve, len(self.targets)
        parts = np.arange(_PARTS) / _PARTS
        nodes = (curve.arcs[:-1, None] + np.diff(curve.arcs)[:, None] * parts).ravel()
        if not curve.closed:
            nodes = np.append(nodes, curve.length)
        block = max(1, _ENTRIES // len(nodes))
        numbers = [np.arange(k, min(k + block, count)) for k in range(0, count, block)]
        turns = [self._turns(own, nodes) for own in numbers]
        bottoms, tops = (
            self._stationary(*map(np.concatenate, zip(*sides, strict=True)), rises=rises)
            for sides, rises in zip(zip(*turns, strict=True), (1.0, -1.0), strict=True)
        )
        return self._joined(bottoms, tops)

    def _turns(self, targets: Integers, nodes: Reals) -> list[tuple[Integers, Reals, Reals]]:
        """Between which nodes distances turn to rise, and to fall: targets, lower and upper nodes."""
        value, rate, _ = self.curve.at(nodes)
        given = (~self._free[targets]).astype(float)
        middle = self.curve.values[0]  # far from the origin differences would be lost
        value = value - middle
        wanted = np.where(self._free[targets], 0, self.targets[targets] - middle)
        slope = given @ np.real(np.conj(value) * rate).T - np.real(np.conj(wanted) @ rate.T)
        rising = slope > 0
        if self.curve.closed:
            level = np.flatnonzero(rising.all(axis=1) | ~rising.any(axis=1))  # as from the centre of a circle
            for own in level:
                distance = np.sum(given[own] * np.abs(value - wanted[own]) ** 2, axis=1)
                rising[own] = np.arange(len(nodes)) == np.argmin(distance)
            rising = np.concatenate([rising, rising[:, :1]], axis=1)
            borders = np.append(nodes, self.curve.length)
        else:  # both ends are tops, perhaps with a valley at the same place
            ends = np.tile([True, False], (len(targets), 1))
            rising = np.concatenate([ends, rising, ends], axis=1)
            borders = np.concatenate([nodes[[0, 0]], nodes, nodes[[-1, -1]]])
        sides = []
        for before, after in ((~rising[:, :-1], rising[:, 1:]), (rising[:, :-1], ~rising[:, 1:])):
            row, k = np.nonzero(before & after)
            sides.append((targets[row], borders[k], borders[k + 1]))
        return sides

    def _stationary(self, target: Integers, low: Reals, high: Reals, *, rises: float) -> tuple[Integers, Reals, Reals]:
        """Targets, places and half squared distances where these are smallest (``rises`` 1) or largest (-1)."""
        at = self._settled(target, low, high, (low + high) / 2, rises=rises)
        return target, at, self._square(target, at)[0]

    def _joined(self, bottoms: tuple[Integers, Reals, Reals], tops: tuple[Integers, Reals, Reals]) -> _Valleys:
        """Each valley with the tops beside it; between two valleys of a target there is exactly one top."""
        target, at, least = bottoms
        peak, places, highest = tops
        count = len(self.targets)
        first = np.searchsorted(peak, np.arange(count))
        amount = np.searchsorted(peak, np.arange(count), side="right") - first
        nth = np.arange(len(target)) - np.searchsorted(target, target)
        leads = at[np.searchsorted(target, np.arange(count))] < places[first]
        after = nth + ~leads[target]
        sides = []
        for k in (after - 1, after):
            lap, row = np.divmod(k, amount[target])
            sides.append((places[first[target] + row] + lap * self.curve.length, highest[first[target] + row]))
        (left, left_top), (right, right_top) = sides
        return _Valleys(
            target=target, at=at, least=least, left=left, left_top=left_top, right=right, right_top=right_top
        )

    @cached_property
    def nearest(self) -> Reals:
        """(targets,) the distance of each target from the whole curve."""
        squares = np.full(len(self.targets), np.inf)
        np.minimum.at(squares, self._valleys.target, self._valleys.least)
        return np.asarray(np.sqrt(2 * squares))

    def places(self, bound: float | Reals) -> Places:
        """Where the targets are not farther than a bound, or each than its own (targets,)."""
        level = np.broadcast_to(np.asarray(bound) ** 2 / 2, len(self.targets))
        low = self._valleys.below(level)
        before = self._edge(low, low.left, low.left_top, level[low.target], -1.0)
        after = self._edge(low, low.right, low.right_top, level[low.target], 1.0)
        starts = np.searchsorted(low.target, np.arange(len(self.targets) + 1)).tolist()
        curve = self.curve
        return Places(
            starts=starts,
            low=before.tolist(),
            best=low.at.tolist(),
            high=after.tolist(),
            length=curve.length,
            closed=curve.closed,
        )

    def _edge(self, low: _Valleys, far: Reals, top: Reals, level: Reals, rises: float) -> Reals:
        """How far each valley reaches on one side: to the top, or to where half the squared distance has a level."""
        edge = np.where(top <= level, far, low.at)
        own = np.flatnonzero((top > level) & (low.least < level))
        target, at, beyond, level = low.target[own], low.at[own], far[own], level[own]
        part = (level - low.least[own]) / (top[own] - low.least[own])
        guess = at + (beyond - at) * np.arccos(1 - 2 * part) / np.pi  # flat at both ends, as a cosine
        edge[own] = self._settled(
            target, np.minimum(at, beyond), np.maximum(at, beyond), guess, rises=rises, levels=level
        )
        return edge

    def within(self, piece: tuple[float, float] | None, order: TargetOrder, most: Reals) -> bool:
        """Whether there are places in order at which no target is farther than its own bound."""
        places = self.places(most)
        return any(next(places.matches_in(groups, piece, sharp=False), None) is not None for groups in order.both_ways)

    def best_in_order(
        self,
        piece: tuple[float, float] | None = None,
        order: TargetOrder | None = None,
        most: Reals | None = None,
    ) -> OrderedMatch:
        """The places in order whose farthest target is as near as possible.

        Args:
            piece: of the curve, from which arc to which; by default all of it, on a closed curve from any start.
            order: of the targets; by default one after the other.
            most: how far each may be at most, where `within` says that there are such places.

        The error is the ordered distance of the curve to 1e-10 of the natural size, never less. Cost: 1 ms for each
        try of a bound with 300 targets, about 30 tries.
        """
        if piece is None and not self.curve.closed:
            piece = 0.0, self.curve.length
        order = order or TargetOrder.of((), len(self.targets))
        least = float(self.nearest[order.rows].max()) * (1 + 1e-12)
        best: list[tuple[float, Groups]] = []
        own = np.full(len(self.targets), np.inf) if most is None else most
        for groups in order.both_ways:
            highest = best[0][0] + _EQUAL * self.size if best else np.inf
            bound = self._least_bound(groups, piece, (least, highest), own)
            if bound < np.inf:
                best.append((bound, groups))
        smallest = min(bound for bound, _ in best)
        matches = []
        for bound, groups in best:
            if bound <= smallest + _EQUAL * self.size:
                for ordered in self.places(np.minimum(bound, own)).matches_in(groups, piece):
                    arcs = self._with_free(ordered, order.free, piece)
                    distances = self.of(arcs)
                    mean = float(np.sqrt(np.mean(distances**2)))
                    matches.append(OrderedMatch(float(distances.max()), mean, arcs))
        return preferred(matches, self.size)

    def _with_free(self, arcs: Reals, free: Sequence[int], piece: tuple[float, float] | None) -> Reals:
        """Targets at any time where they are nearest, on a closed curve in the same lap."""
        if not free:
            return arcs
        valleys, window = self._valleys, piece or lap_about(arcs, self.curve.length)
        laps = self.curve.length * np.arange(-2, 3) if self.curve.closed else np.zeros(1)
        places = []
        for target in free:
            at = (valleys.at[valleys.target == target][:, None] + laps).ravel()
            at = np.append(at[(at >= window[0]) & (at <= window[1])], [] if piece is None else window)
            gaps = np.sqrt(2 * self._square(np.full(len(at), target), at)[0])
            places.append(np.sort(at[gaps <= gaps.min() + _EQUAL * self.size]))
        whole = with_free(arcs, free, places, window, self.curve.length if piece is None else np.inf)
        assert whole is not None
        return whole

    def _least_bound(
        self, groups: Groups, piece: tuple[float, float] | None, limits: tuple[float, float], own: Reals
    ) -> float:
        """The least bound of all that leaves places in order, in a bracket that is halved; infinite if there is none.

        Args:
            groups: of targets that are passed one after the other.
            piece: of the curve.
            limits: the least and the largest one that is of use.
            own: (targets,) the bound of each, which it keeps to besides.
        """

        def suffices(bound: float) -> bool:
            places = self.places(np.minimum(bound, own))
            return next(places.matches_in(groups, piece, sharp=False), None) is not None

        least, most = limits
        if suffices(least):
            return least
        low, high = least, min(most, float(own.max()))
        if high < np.inf:
            if not suffices(high):
                return np.inf
        else:
            step = max(least, 1e-6 * self.size)
            high = least + step
            while not suffices(high):
                low, step = high, 2 * step
                high += step
        while high - low > _SHARP * self.size:
            middle = (low + high) / 2
            if suffices(middle):
                high = middle
            else:
                low = middle
        return high


@dataclass(frozen=True, slots=True, kw_only=True)
class _Valleys:
    """Places where distances are smallest, target by target along the curve, with the tops beside them."""

    target: Integers
    at: Reals
    least: Reals
    """Half the squared distance there."""
    left: Reals
    """The top before it, on a closed curve perhaps below 0; the ends of an open one are tops."""
    left_top: Reals
    right: Reals
    right_top: Reals

    def below(self, level: Reals) -> _Valleys:
        """Those that are not higher than the levels of their targets."""
        low = self.least <= level[self.target]
        return _Valleys(
            target=self.target[low],
            at=self.at[low],
            least=self.least[low],
            left=self.left[low],
            left_top=self.left_top[low],
            right=self.right[low],
            right_top=self.right_top[low],
        )
