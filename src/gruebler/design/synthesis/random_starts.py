"""Four-bars of two or three positions sought from random starts, and what such a search may have missed.

Random members of the family climb to better ones nearby, again and again. How many of them end at the best one says
how large a part of the family can be that none has met. docs/theory/synthesis-positions.md, "Random starts".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, demands_failed
from gruebler.design.synthesis.dyad_cells import FAR
from gruebler.design.synthesis.dyads import CRANK, Displacements
from gruebler.design.synthesis.length_search import PairFamily
from gruebler.design.synthesis.pair_facts import USUAL
from gruebler.design.synthesis.pair_search import Pair
from gruebler.design.synthesis.results import MEASURES, NEAR_PIVOTS
from gruebler.design.synthesis.tasks import PositionTask

_STARTS, _CHOSEN = 256, 128
"""Random four-bars that are improved, and the best of all that are drawn."""
_DRAWN, _DRAWS = 8192, 8  # random four-bars at a time, and how often
_SPREAD, _WIDE = 2.5, 1.5  # degrees of freedom, and sizes: Student's distribution of random pivots
_CLIMBED = ((_STARTS + _CHOSEN, 80, 12), (16, 240, 64))
"""How many, first all and then the best ends, are moved how often, each to the best of so many neighbours."""
_WIDEST, _NARROWEST = 0.5, 1e-6  # steps, in sizes or by the distance of a pivot
_GROWS, _SHRINKS = 1.5, 0.85  # after a gain, after none
_NEAR = 5e-3  # of the best: ends so near count as the best
_UNLIKELY = 0.05  # how often what is said of all trials may be wrong
_ENDS = message(
    "{starts} {begun} with pivots within {far:g} sizes of the task were improved, too: {ends} of them end at the best "
    "by {measure}, to {near}. Other parts of the family may have a better one: with a confidence of 95 % only parts to "
    "which fewer than {missed:.1g} of such starts lead."
)
_BEGUN = {
    "all": message("random four-bars that meet all demands"),
    "but the angle": message("random four-bars that meet all demands but that of the transmission angle"),
    "none": message("random four-bars of the family"),
}
_OF_BEST, _OF_SIZE = message("0.5 %"), message("0.5 % of the size of the task")
_NO_END = message(
    "{starts} random four-bars were improved, too: none of them ends at one that meets all demands, so that with a "
    "confidence of 95 % fewer than {missed:.1g} of such starts lead there."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomSearch:
    """What random starts led to."""

    task: PositionTask
    demands: Demands
    orders: tuple[str, ...]
    """By what the best is sought."""
    ends: Reals
    """(starts, numbers) the four-bars at which they end, as rows of a `PairFamily`, the best first."""
    meets: bool
    """Whether all starts meet all demands but that of the transmission angle."""
    costs: Reals
    """(starts, 1 + measures) how many demands these fail in, and what is to be small."""
    at_random: Flags
    """(starts,) which of them begin at one of the random four-bars, not at one of the best that were drawn."""

    @property
    def best(self) -> list[Pair]:
        """The best end that meets the demands, if there is one."""
        family = PairFamily.of(self.task, CRANK, self.demands)
        return [family.dyads(row) for row in self.ends[:1] if len(self.ends) and not self.costs[0, 0]]

    def note(self, pairs: Sequence[Pair]) -> list[Message]:
        """What the search may have missed, where four-bars, those of this search among them, are known."""
        count = int(self.at_random.sum())
        family = PairFamily.of(self.task, CRANK, self.demands)
        if not (count and pairs):
            return []
        rows = np.concatenate([family.rows(pair[:1], pair[1:]) for pair in pairs])
        costs = _costs(family, rows, self.demands, self.orders)
        best = costs[np.lexsort(costs.T[::-1])[0]]
        missed = 1 - _UNLIKELY ** (1 / count)
        if best[0]:
            return [_NO_END.filled(starts=count, missed=missed)]
        # Of a full turn, which comes first by default, there is no part; the next measure tells ends apart.
        names = (*self.orders, *USUAL)
        k = next(k for k, name in enumerate(names, 1) if name != "full-turn")
        by_size = names[k - 1] == NEAR_PIVOTS
        scale = self.task.size if by_size else abs(best[k])
        same = (
            (self.costs[:, :k] == best[:k]).all(axis=1) & (self.costs[:, k] <= best[k] + _NEAR * scale) & self.at_random
        )
        begun = _BEGUN["none" if not self.meets else "but the angle" if self.demands.transmission else "all"]
        near = _OF_SIZE if by_size else _OF_BEST
        measure = MEASURES.get(names[k - 1], MEASURES["transmission"])
        return [
            _ENDS.filled(
                starts=count,
                begun=begun,
                far=FAR,
                ends=int(same.sum()),
                measure=measure,
                near=near,
                missed=missed,
            )
        ]


def random_search(task: PositionTask, demands: Demands, orders: Sequence[str]) -> RandomSearch:
    """Random four-bars of two or three positions, each improved as far as that goes. Cost: 1 to 3 s.

    Args:
        task: without given pivots.
        demands: without given lengths.
        orders: by what the best is sought, the most important first.
    """
    space = _Space(task, demands, tuple(orders))
    rows, at_random, meets = space.starts()
    costs = space.costs(rows)
    for count, climbs, tries in _CLIMBED:
        rows[:count], costs[:count] = space.climbed(rows[:count], costs[:count], climbs, tries)
        order = np.lexsort(costs.T[::-1])
        rows, costs, at_random = rows[order], costs[order], at_random[order]
    return RandomSearch(
        task=task, demands=demands, orders=tuple(orders), ends=rows, costs=costs, at_random=at_random, meets=meets
    )


class _Space:
    """The four-bars of a family whose pivots are at hand, and how they move in it at random."""

    def __init__(self, task: PositionTask, demands: Demands, orders: tuple[str, ...]) -> None:
        self.demands, self.orders = demands, orders
        self.family = PairFamily.of(task, CRANK, demands)
        self.given, self.origin, self.size = Displacements.of(task.origins, task.turns)
        region = demands.region
        corners = np.zeros(2) if region is None else np.array([complex(*region[:2]), complex(*region[2:])])
        self.corners = None if region is None else (corners - self.origin) / self.size
        self.rng = np.random.default_rng(0)

    def costs(self, rows: Reals) -> Reals:
        """(four-bars, 1 + measures) how many demands they fail in, and what is to be small; infinite beyond reach."""
        costs = _costs(self.family, rows, self.demands, self.orders)
        return np.where(_at_hand(rows)[:, None], costs, np.inf)

    def starts(self) -> tuple[Reals, Flags, bool]:
        """(starts, 8) random four-bars that meet all demands but that of the transmission angle, or else any.

        After them the best of all that were drawn; which are random, and whether these meet the demands.
        """
        freed = replace(self.demands, transmission=0.0)
        drawn = np.concatenate([self._drawn() for _ in range(_DRAWS)])
        costs = _costs(self.family, drawn, freed, self.orders)
        meets = costs[:, 0] == 0
        some = drawn[meets] if meets.any() else drawn
        some = some[:_STARTS]
        best = drawn[np.lexsort(costs.T[::-1])[: _STARTS + _CHOSEN - len(some)]]
        at_random = np.arange(len(some) + len(best)) < len(some)
        return np.concatenate([some, best]), at_random, bool(meets.any())

    def _drawn(self) -> Reals:
        """(four-bars, 8) at random, as far as their pivots are at hand: those of the frame in the region, if any."""
        pivots = (_WIDE * self.rng.standard_t(_SPREAD, (_DRAWN, 8))).view(np.complex128)
        if self.corners is not None:
            low, high = self.corners
            x, y = self.rng.random((2, _DRAWN, 2))
            pivots[:, 1::2] = low + (high - low).real * x + 1j * (high - low).imag * y
        drawn = self._placed(pivots)
        return drawn[_at_hand(drawn)]

    def climbed(self, rows: Reals, costs: Reals, climbs: int, tries: int) -> tuple[Reals, Reals]:
        """Each exchanged for the best of some neighbours, as long as that helps, in steps that shrink where not."""
        width, each = np.full(len(rows), _WIDEST), np.arange(len(rows))
        for _ in range(climbs):
            near = self._neighbours(np.repeat(rows, tries, axis=0), np.repeat(width, tries))
            tried = self.costs(near).reshape(len(rows), tries, -1)
            chosen = _least(tried)
            gained = _less(tried[each, chosen], costs)
            rows = np.where(gained[:, None], near.reshape(len(rows), tries, 8)[each, chosen], rows)
            costs = np.where(gained[:, None], tried[each, chosen], costs)
            width = np.clip(width * np.where(gained, _GROWS, _SHRINKS), _NARROWEST, _WIDEST)
        return rows, costs

    def _neighbours(self, rows: Reals, width: Reals) -> Reals:
        """Four-bars beside others: one dyad or both are moved, at either pivot."""
        rng, pivots = self.rng, rows.view(np.complex128)
        steps = rng.normal(size=(*pivots.shape, 2)).view(np.complex128)[..., 0] * (1 + np.abs(pivots))
        steps *= width[:, None] * np.exp(-2 * rng.random((len(pivots), 1)))
        alone = rng.random((len(pivots), 1)) < 0.5
        side = (rng.random((len(pivots), 1)) < 0.5) == (np.arange(4) < 2)
        return self._placed(pivots + np.where(alone & side, 0, steps))

    def _placed(self, pivots: Complexes) -> Reals:
        """Four-bars with these pivots on the body or on the frame; in a region, if any, those of the frame."""
        on_frame = self.rng.random((len(pivots), 2)) < 0.5
        if self.corners is not None:
            low, high = self.corners
            own = pivots[:, 1::2]
            pivots[:, 1::2] = np.clip(own.real, low.real, high.real) + 1j * np.clip(own.imag, low.imag, high.imag)
            on_frame[:] = True
        return _on_family(self.given, pivots, on_frame)


def _at_hand(rows: Reals) -> Flags:
    """Whether all pivots are."""
    return np.asarray((np.abs(rows.view(np.complex128)) < FAR).all(axis=1))


def _on_family(given: Displacements, pivots: Complexes, fixed: Flags) -> Reals:
    """(four-bars, 8) rows of a `PairFamily` with these pivots on the body, or on the frame where they are chosen.

    The other pivot of each dyad is that of three positions, or, of two, the nearest place on the bisector.
    """
    dyads = pivots.reshape(-1, 2)
    ends = []
    for seen, (first, second) in ((given, (0, 1)), (given.inverse, (1, 0))):
        q, t = seen.with_first
        places = dyads[:, [first]] * q + t
        gap = places[:, 1] - places[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            if len(q) == 2:
                along, middle = 1j * gap, (places[:, 0] + places[:, 1]) / 2
                other = middle + along * np.real(np.conj(along) * (dyads[:, second] - middle)) / np.abs(gap) ** 2
            else:
                last = places[:, 2] - places[:, 0]
                bend = 1j * (np.abs(last) ** 2 * gap - np.abs(gap) ** 2 * last)
                other = places[:, 0] - bend / (2 * np.imag(np.conj(last) * gap))
        ends.append(other)
    own = fixed.ravel()
    on_body = np.where(own, ends[1], dyads[:, 0])
    on_frame = np.where(own, dyads[:, 1], ends[0])
    return np.stack([on_body, on_frame], axis=1).reshape(-1, 4).view(np.float64)


def _costs(family: PairFamily, rows: Reals, demands: Demands, orders: Sequence[str]) -> Reals:
    """(four-bars, 1 + measures) how many demands they fail in, and what is to be small."""
    facts = family.facts(rows, demands)
    fails = demands_failed(facts.met(demands))
    fails = np.where(facts.branch, fails, 99.0)
    every = np.concatenate([fails, *facts.costs(orders, fails == 0)], axis=1)
    return np.asarray(np.nan_to_num(every, nan=np.inf))


def _least(costs: Reals) -> Integers:
    """(starts,) which of the tries (starts, tries, measures) is the best: by the first measure, then the next."""
    left = np.ones(costs.shape[:2], bool)
    for cost in np.moveaxis(costs, 2, 0):
        own = np.where(left, cost, np.inf)
        left &= own == own.min(axis=1, keepdims=True)
    return np.asarray(np.argmax(left, axis=1))


def _less(first: Reals, second: Reals) -> Flags:
    """(starts,) whether the first costs, (starts, measures), come before the second ones."""
    less, equal = np.zeros(len(first), bool), np.ones(len(first), bool)
    for own, other in zip(first.T, second.T, strict=True):
        less |= equal & (own < other)
        equal &= own == other
    return less
