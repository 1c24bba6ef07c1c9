"""Linkages of a family sought from random starts, and what such a search may have missed.

Random members of the family climb to better ones nearby, again and again. How many of them end at the best one says
how large a part of the family can be that none has met. docs/theory/synthesis-positions.md, "Random starts".
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, demands_failed
from gruebler.design.synthesis.dyad_cells import FAR
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, DyadKind
from gruebler.design.synthesis.length_search import SPREAD, WIDE, ConditionedRows, pivots_of_rows
from gruebler.design.synthesis.pair_facts import USUAL
from gruebler.design.synthesis.results import MEASURES, NEAR_PIVOTS, form_symbols

_STARTS, _CHOSEN = 256, 128
"""Random linkages that are improved, and the best of all that are drawn."""
DRAWN = 8192
"""Random linkages that are drawn at a time."""
_DRAWS = 8
_CLIMBED = ((_STARTS + _CHOSEN, 80, 12), (16, 240, 64))
"""How many, first all and then the best ends, are moved how often, each to the best of so many neighbours."""
_WIDEST, _NARROWEST = 0.5, 1e-6  # steps, in sizes or by the distance of a pivot
_GROWS, _SHRINKS = 1.5, 0.85  # after a gain, after none
_NEAR = 5e-3  # of the best: ends so near count as the best
_ON_FRAME = {CRANK: [1, 3], SLIDER: [1], BLOCK: [1, 2]}
"""Which pivots of a row lie on the frame, by the kind of the dyad that is not driven."""
_UNLIKELY = 0.05  # how often what is said of all trials may be wrong
_ENDS = message(
    "{starts} {begun} with pivots within {far:g} sizes of the task were improved, too: {ends} of them end at the best "
    "by {measure}, to {near}. Other parts of the family may have a better one: with a confidence of 95 % only parts to "
    "which fewer than {missed:.1g} of such starts lead."
)
_BEGUN = {
    "all": message("random {linkages} that meet all demands"),
    "but the angle": message("random {linkages} that meet all demands but that of the transmission angle"),
    "none": message("random {linkages} of the family"),
}
_OF_BEST, _OF_SIZE = message("0.5 %"), message("0.5 % of the size of the task")
_NO_END = message(
    "{starts} random {linkages} were improved, too: none of them ends at one that meets all demands, so that with a "
    "confidence of 95 % fewer than {missed:.1g} of such starts lead there."
)


class StartFamily(ABC):
    """A family of linkages whose members can be drawn at random, and moved at random within it."""

    family: ConditionedRows
    kind: DyadKind
    """That of the dyad that is not driven."""
    origin: complex
    size: float
    """Pivots are told in sizes about an origin."""

    @abstractmethod
    def drawn(self, rng: np.random.Generator, demands: Demands) -> Reals:
        """(`DRAWN`, numbers) random members, not all of which need be at hand."""

    @abstractmethod
    def neighbours(self, rng: np.random.Generator, demands: Demands, rows: Reals, width: Reals) -> Reals:
        """(linkages, numbers) members beside others, in steps as wide as (linkages,) says, at most."""

    def pivots(self, rng: np.random.Generator, demands: Demands) -> Complexes:
        """(`DRAWN`, points) by Student's distribution; those of the frame evenly in a region that is demanded."""
        pivots = (WIDE * rng.standard_t(SPREAD, (DRAWN, 2 * self.family.points))).view(np.complex128)
        if demands.region is not None:
            x1, y1, x2, y2 = demands.region
            own = _ON_FRAME[self.kind]
            x, y = rng.uniform([x1, y1], [x2, y2], (DRAWN, len(own), 2)).transpose(2, 0, 1)
            pivots[:, own] = (x + 1j * y - self.origin) / self.size
        return pivots

    def within(self, demands: Demands, pivots: Complexes) -> Complexes:
        """(linkages, points) pivots, those of the frame put on the sides of the region that is demanded, if outside."""
        if demands.region is None:
            return pivots
        x1, y1, x2, y2 = demands.region
        low, high = (complex(x, y) - self.origin for x, y in ((x1, y1), (x2, y2)))
        low, high, own = low / self.size, high / self.size, _ON_FRAME[self.kind]
        put, places = pivots.copy(), pivots[:, own]
        put[:, own] = np.clip(places.real, low.real, high.real) + 1j * np.clip(places.imag, low.imag, high.imag)
        return put


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomSearch:
    """What random starts led to."""

    family: ConditionedRows
    demands: Demands
    orders: tuple[str, ...]
    """By what the best is sought."""
    ends: Reals
    """(starts, numbers) the linkages at which they end, the best first."""
    meets: bool
    """Whether all starts meet all demands but that of the transmission angle."""
    costs: Reals
    """(starts, 1 + measures) how many demands these fail in, and what is to be small."""
    at_random: Flags
    """(starts,) which of them begin at one of the random linkages, not at one of the best that were drawn."""

    @property
    def best(self) -> Reals:
        """(0 or 1, numbers) the best end that meets the demands, if there is one."""
        return np.asarray(self.ends[:1][self.costs[:1, 0] == 0])

    def note(self, rows: Reals) -> list[Message]:
        """What the search may have missed, where linkages, those of this search among them, are known."""
        count = int(self.at_random.sum())
        if not (count and len(rows)):
            return []
        costs = _costs(self.family, rows, self.demands, self.orders)
        best = costs[np.lexsort(costs.T[::-1])[0]]
        kind, missed = self.family.kind, 1 - _UNLIKELY ** (1 / count)
        linkages = message("four-bars")
        if kind.slides:
            linkages = message("linkages {form}").filled(form=form_symbols(f"{CRANK.form}-{kind.form}"))
        if best[0]:
            return [_NO_END.filled(starts=count, missed=missed, linkages=linkages)]
        # Of a full turn, which comes first by default, there is no part; the next measure tells ends apart.
        names = (*self.orders, *USUAL)
        k = next(k for k, name in enumerate(names, 1) if name != "full-turn")
        by_size = names[k - 1] == NEAR_PIVOTS
        scale = self.family.size if by_size else abs(best[k])
        same = self.at_random & (self.costs[:, k] <= best[k] + _NEAR * scale)
        same &= (self.costs[:, :k] == best[:k]).all(axis=1)
        begun = _BEGUN["none" if not self.meets else "but the angle" if self.demands.transmission else "all"]
        near = _OF_SIZE if by_size else _OF_BEST
        return [
            _ENDS.filled(
                starts=count,
                begun=begun.filled(linkages=linkages),
                far=FAR,
                ends=int(same.sum()),
                measure=MEASURES[names[k - 1]],
                near=near,
                missed=missed,
            )
        ]


def random_search(start_family: StartFamily, demands: Demands, orders: Sequence[str]) -> RandomSearch:
    """Random linkages of a family, each improved as far as that goes. Cost: 1 to 3 s.

    Args:
        start_family: where they are drawn and moved.
        demands: without given lengths.
        orders: by what the best is sought, the most important first.
    """
    family, rng = start_family.family, np.random.default_rng(0)

    def costs_of(some: Reals) -> Reals:
        own = _costs(family, some, demands, tuple(orders))
        return np.where(_at_hand(family, some)[:, None], own, np.inf)

    rows, at_random, meets = _starts(start_family, rng, demands, orders)
    costs = costs_of(rows)
    for count, climbs, tries in _CLIMBED:
        own, gains = rows[:count], costs[:count]
        width, each = np.full(len(own), _WIDEST), np.arange(len(own))
        for _ in range(climbs):  # each exchanged for the best of some neighbours, in steps that shrink where none is
            near = start_family.neighbours(rng, demands, np.repeat(own, tries, axis=0), np.repeat(width, tries))
            tried = costs_of(near).reshape(len(own), tries, -1)
            chosen = _least(tried)
            gained = _less(tried[each, chosen], gains)
            own = np.where(gained[:, None], near.reshape(len(own), tries, -1)[each, chosen], own)
            gains = np.where(gained[:, None], tried[each, chosen], gains)
            width = np.clip(width * np.where(gained, _GROWS, _SHRINKS), _NARROWEST, _WIDEST)
        rows[:count], costs[:count] = own, gains
        order = np.lexsort(costs.T[::-1])
        rows, costs, at_random = rows[order], costs[order], at_random[order]
    return RandomSearch(
        family=family,
        demands=demands,
        orders=tuple(orders),
        ends=rows,
        costs=costs,
        at_random=at_random,
        meets=meets,
    )


def _starts(
    start_family: StartFamily, rng: np.random.Generator, demands: Demands, orders: Sequence[str]
) -> tuple[Reals, Flags, bool]:
    """(starts, numbers) random linkages that meet all demands but that of the transmission angle, or else any.

    After them the best of all that were drawn; which are random, and whether these meet the demands.
    """
    family, freed = start_family.family, replace(demands, transmission=0.0)
    drawn = np.concatenate([start_family.drawn(rng, demands) for _ in range(_DRAWS)])
    drawn = drawn[_at_hand(family, drawn)]
    costs = _costs(family, drawn, freed, orders)
    meets = costs[:, 0] == 0
    some = (drawn[meets] if meets.any() else drawn)[:_STARTS]
    best = drawn[np.lexsort(costs.T[::-1])[: _STARTS + _CHOSEN - len(some)]]
    at_random = np.arange(len(some) + len(best)) < len(some)
    return np.concatenate([some, best]), at_random, bool(meets.any())


def _at_hand(family: ConditionedRows, rows: Reals) -> Flags:
    """Whether all pivots are."""
    return np.asarray((np.abs(pivots_of_rows(rows, family.points)) < FAR).all(axis=1))


def _costs(family: ConditionedRows, rows: Reals, demands: Demands, orders: Sequence[str]) -> Reals:
    """(linkages, 1 + measures) how many demands they fail in, and what is to be small."""
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
