"""Places in order along a curve, one for each target, chosen from intervals by one sweep.

docs/theory/synthesis-curves.md has the theorems that are used here.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import floor

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.target_orders import Groups

_SHIFT = 1e-12  # of the length: a place that lies so little behind another is the same


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Intervals of a curve for each target, from which places in order are chosen.

    >>> places = Places.of_points([[0.1, 0.8], [0.5], [0.2, 0.9]], 1.0, closed=False)
    >>> [match.tolist() for match in places.matches((0.0, 1.0))]
    [[0.1, 0.5, 0.9], [0.8, 0.5, 0.2]]
    """

    starts: list[int]
    """(targets + 1,) where the intervals of each target begin in the lists."""
    low: list[float]
    best: list[float]
    """Where in each interval the target is nearest."""
    high: list[float]
    length: float
    closed: bool

    @classmethod
    def of_points(cls, arcs: Sequence[Sequence[float] | Reals], length: float, *, closed: bool) -> Places:
        """Single places for each target, rising."""
        flat = [float(arc) for own in arcs for arc in own]
        starts = [0, *np.cumsum([len(own) for own in arcs]).tolist()]
        return cls(starts=starts, low=flat, best=flat, high=flat, length=length, closed=closed)

    @property
    def empty(self) -> list[int]:
        """The numbers of the targets that have no place."""
        return [k for k, (low, high) in enumerate(pairwise(self.starts)) if low == high]

    @property
    def best_of_each(self) -> list[Reals]:
        """For each target where it is nearest in its intervals."""
        return [np.array(self.best[low:high]) for low, high in pairwise(self.starts)]

    def matches(
        self, piece: tuple[float, float] | None, *, groups: Groups | None = None, sharp: bool = True
    ) -> Iterator[Reals]:
        """Places of all targets in order, in both senses and from all starts that have to be looked at.

        Args:
            piece: from which arc to which; None for a whole closed curve from any start, within one lap.
            groups: of targets that are passed one after the other; each by itself without them. Others have no place.
            sharp: each target as near its best place as the others leave room for, instead of as early as possible.
        """
        rising = groups or tuple((target,) for target in range(len(self.starts) - 1))
        for order in (rising, rising[::-1]):
            yield from self.matches_in(order, piece, sharp=sharp)

    def matches_in(self, groups: Groups, piece: tuple[float, float] | None, *, sharp: bool = True) -> Iterator[Reals]:
        """Those in which the places rise along the curve when groups of targets are taken one after the other."""
        begins = (lap for first in groups[0] for lap in self._pieces(first)) if piece is None else (piece,)
        for begin, end in begins:
            places = self._swept(groups, begin, end)
            if places is None:
                continue
            if sharp:
                self._sharpen(groups, places, begin, end, around=piece is None)
            arcs = np.full(len(self.starts) - 1, np.nan)
            for target, (at, _) in places.items():
                arcs[target] = at
            yield arcs

    def _pieces(self, first: int) -> Iterator[tuple[float, float]]:
        """Where a lap may begin: the ends of a first target's intervals, and ends of others within these.

        Between such ends the end of the sweep does not fall behind its start (theorem 2).
        """
        ends = np.unique(np.array(self.high) % self.length)
        for k in range(self.starts[first], self.starts[first + 1]):
            low, high = self.low[k], self.high[k]
            within = (ends - low) % self.length
            starts = low + within[within < high - low]
            for start in (high, *starts[::-1].tolist()):
                yield start, start + self.length

    def _next(self, target: int, arc: float) -> tuple[float, float] | None:
        """The first place of a target from an arc on, and the best one of its interval; None if there is none."""
        begin, end = self.starts[target], self.starts[target + 1]
        if begin == end:
            return None
        lap = floor(arc / self.length) * self.length if self.closed else 0.0
        behind = arc - lap - _SHIFT * self.length
        k = bisect_left(self.high, behind, begin, end)
        if self.closed:
            if self.high[end - 1] - self.length >= behind:  # it reaches over the end of the lap before
                k, lap = end - 1, lap - self.length
            elif k == end:
                k, lap = begin, lap + self.length
        elif k == end:
            return None
        return max(arc, self.low[k] + lap), self.best[k] + lap

    def _swept(self, groups: Groups, begin: float, end: float) -> dict[int, tuple[float, float]] | None:
        """The earliest places in order, each with the best one of its interval; None if the end is passed."""
        places: dict[int, tuple[float, float]] = {}
        at, last = begin, end + _SHIFT * self.length
        for group in groups:
            for target in group:
                place = self._next(target, at)
                if place is None or place[0] > last:
                    return None
                places[target] = place
            at = max(places[target][0] for target in group)
        return places

    def _sharpen(
        self, groups: Groups, places: dict[int, tuple[float, float]], begin: float, end: float, *, around: bool
    ) -> None:
        """Move each place towards the best one of its interval, as far as those before and after leave room.

        Distances fall towards the best place, so none grows. First from the end, since places are as early as possible.
        """

        def reach(k: int) -> tuple[float, float]:
            own = [places[target][0] for target in groups[k]]
            return min(own), max(own)

        count = len(groups)
        for k in (*range(count - 1, -1, -1), *range(count)):
            for target in groups[k]:
                low = reach(k - 1)[1] if k else reach(-1)[1] - self.length if around else begin
                high = reach(k + 1)[0] if k + 1 < count else reach(0)[0] + self.length if around else end
                at, best = places[target]
                places[target] = max(low, min(best, high)) if low <= high else at, best


def lap_about(arcs: Reals, length: float) -> tuple[float, float]:
    """From where to where other places lie in one lap with some; NaN are left out."""
    return float(np.nanmax(arcs)) - length, float(np.nanmin(arcs)) + length


def with_free(
    arcs: Reals, free: Sequence[int], places: Sequence[Reals], window: tuple[float, float], most: float = np.inf
) -> Reals | None:
    """Places for targets at any time, too, so that the way through all is the shortest; None if one has no place.

    Args:
        arcs: (targets,) NaN for those at any time.
        free: their numbers.
        places: of each of them those that it may have, rising.
        window: from which arc to which they may lie.
        most: how long the way may be.

    >>> with_free(np.array([2.0, 4.0, np.nan]), [2], [np.array([0.5, 4.5])], (0.0, 5.0)).tolist()
    [2.0, 4.0, 4.5]
    """
    low, high = float(np.nanmin(arcs)), float(np.nanmax(arcs))
    inside = [own[(own >= window[0]) & (own <= window[1])] for own in places]
    best: tuple[float, list[float]] | None = None
    for begin in (low, *(float(at) for own in inside for at in own[own < low])):
        chosen = [float(own[k]) for own in inside if (k := int(np.searchsorted(own, begin))) < len(own)]
        span = max([high, *chosen]) - begin
        if len(chosen) == len(free) and span <= most and (best is None or span < best[0]):
            best = span, chosen
    if best is None:
        return None
    arcs = arcs.copy()
    arcs[list(free)] = best[1]
    return arcs
