"""Pairs of dyads out of a family that do what is demanded: all of a fine sample in closed form, the best made better.

Two to four positions leave families of dyads, every two of which are a four-bar. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Flags
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, demands_failed, tightest
from gruebler.design.synthesis.dyads import GuidingDyad
from gruebler.design.synthesis.pair_facts import PairFacts, pair_facts
from gruebler.design.synthesis.results import form_symbols, resolution
from gruebler.design.synthesis.tasks import PositionTask

Pair = tuple[GuidingDyad, GuidingDyad]
Nearby = Callable[[GuidingDyad, float], list[GuidingDyad]]
"""Dyads of the family near one, within a width: part of the family's own length or size."""

WIDTHS = tuple(0.004 * 0.4**k for k in range(6))
FINE_WIDTHS = tuple(0.004 * 0.4**k for k in range(11))
"""Of the best by what is asked for."""
_ASIDE = 0.3  # sizes of the task: the same in all of their pivots
_APART = 4  # places in the sample: designs nearer to a better one are not listed
_LOOKED_AT = 2000  # pairs for each design that is wanted
_STEPS = tuple(0.04 * 0.4**k for k in range(8))  # widths of a family with one dyad to choose
_MOVES, _DEEP = 8, 8  # to a better pair of each of these widths; pairs that are so improved
_CLIMBS = 16  # moves to a better dyad of each width
_VALLEY = 0.1  # sizes: places from which such searches begin differ by more
_TRIED = 3  # such places for each design that is wanted
_ALIKE = 0.05
"""Of size of the task and shortest link: linkages whose pivots differ by less in sum are nearly the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundPairs:
    """Pairs to be judged, the driven dyad first, and what there is to say of the search."""

    pairs: tuple[Pair, ...]
    notes: tuple[Message, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SoughtPairs:
    """Which pairs of a family are sought."""

    task: PositionTask
    """Two to four positions."""
    dyads: Sequence[GuidingDyad]
    """A sample of the family in the order of the family, RR ones: those that are driven."""
    demands: Demands
    near: Nearby
    second: Sequence[GuidingDyad] = ()
    """A sample of sliding dyads of one kind, in the order of their family, instead of the first ones again."""
    given: Sequence[GuidingDyad] = ()
    """Some of the first ones, all where there are second ones: each pair has just one of them."""
    orders: Sequence[str] = ()
    """What is best, by the names of `results.ORDERS`."""
    number: int = 16
    """Of pairs, at most."""

    @property
    def others(self) -> Sequence[GuidingDyad]:
        """Those that are not driven."""
        return self.second or self.dyads


def best_pairs(sought: SoughtPairs) -> FoundPairs:
    """The best pairs of a sample of a family, each made better within it; those that fail least if none meets all.

    Cost: 2 us for each pair of the sample, 10 ms for each one that is made better.
    """
    dyads, others, demands = sought.dyads, sought.others, sought.demands
    facts = pair_facts(sought.task, dyads, others, demands)
    usable = np.ones((len(dyads), len(others)), bool)
    if sought.given and not sought.second:
        is_given = np.array([dyad in sought.given for dyad in dyads])
        usable = is_given[:, None] != is_given
    elif not sought.second:
        np.fill_diagonal(usable, False)
    (name, first), *rest = facts.met(demands)
    met = [(name, first & usable), *rest]
    fails = demands_failed(met)
    good = fails == 0
    notes = [
        _SEARCHED[bool(sought.given), bool(sought.second)].filled(
            dyads=len(dyads),
            form=form_symbols(others[0].kind.form),
            pairs=int(np.count_nonzero(usable)),
            count=int(np.count_nonzero(good)),
        )
    ]
    asked = sought.orders
    if demands.transmission > 0 and not good.any():
        sought = replace(sought, orders=("transmission", *sought.orders))  # those that are nearly good come first
    ranks = facts.ranks(fails, sought.orders)
    ranks = ranks[usable.ravel()[ranks]]
    ranks = ranks if not good.any() else ranks[good.ravel()[ranks]]
    chosen = _different(sought, ranks[: _LOOKED_AT * sought.number], asked=bool(asked))
    improved = (_improved(sought, pair) for pair in chosen)  # where none of the sample is good, one beside it may be
    pairs: list[Pair] = []
    beside = 0
    for pair, meets in improved:
        beside += meets
        pairs = [*pairs, pair] if asked else distinct_pairs([*pairs, pair], sought.task.size)
        if not asked and len(pairs) == sought.number:
            break
    if asked:
        pairs = _distinct_best(sought, pairs, asked)
        pairs[:_DEEP] = [_improved(sought, pair, FINE_WIDTHS, _MOVES)[0] for pair in pairs[:_DEEP]]
        pairs = _distinct_best(sought, pairs, asked)
    if not good.any():
        notes += [_BESIDE_SAMPLE.filled(count=beside)] if beside else tightest(met)
    return FoundPairs(pairs=tuple(pairs), notes=tuple(notes))


def _distinct_best(sought: SoughtPairs, pairs: Iterable[Pair], orders: Sequence[str]) -> list[Pair]:
    """The best of pairs by what is asked for, as many as are wanted."""
    return distinct_pairs(best_first(sought.task, sought.demands, pairs, orders), sought.task.size)[: sought.number]


def _different(sought: SoughtPairs, ranks: NDArray[np.intp], *, asked: bool) -> list[Pair]:
    """The first pairs that differ: twice as many as are wanted.

    In the sample by their places; by their pivots and by what drives where something is asked for, since some dyads are
    no neighbours there and the drive decides which demands are met.
    """
    dyads, others = sought.dyads, sought.others
    pivots, far_pivots = (np.array([(each.moving, each.fixed) for each in some]) for some in (dyads, others))
    chosen: list[tuple[int, int]] = []
    taken = np.empty((2 * sought.number, 4), np.complex128)
    for rank in ranks:
        i, j = divmod(int(rank), len(others))
        if asked:
            own = np.concatenate([pivots[i], far_pivots[j]])
            apart = bool((np.abs(taken[: len(chosen)] - own).sum(axis=1) > _ASIDE * sought.task.size).all())
        else:
            same = [(i, j)] if sought.second else [(i, j), (j, i)]
            apart = all(abs(p - k) + abs(q - m) > _APART for k, m in chosen for p, q in same)
        if apart:
            taken[len(chosen)] = [*pivots[i], *far_pivots[j]]
            chosen.append((i, j))
        if len(chosen) == 2 * sought.number:
            break
    return [(dyads[i], others[j]) for i, j in chosen]


def best_dyads(
    dyads: Sequence[GuidingDyad],
    facts_of: Callable[[Sequence[GuidingDyad]], PairFacts],
    demands: Demands,
    near: Nearby,
    *,
    orders: Sequence[str] = (),
    number: int = 16,
) -> tuple[list[GuidingDyad], list[Message]]:
    """The best of a family with one dyad to choose, as `best_pairs`, and notes on it; none if none meets all."""

    def ranked(some: Sequence[GuidingDyad]) -> tuple[NDArray[np.intp], Flags, list[tuple[Message, Flags]]]:
        facts = facts_of(some)
        met = facts.met(demands)
        fails = demands_failed(met)
        return facts.ranks(fails, orders), (fails == 0).ravel(), met

    ranks, good, met = ranked(dyads)
    count = int(np.count_nonzero(good))
    notes = [
        message(
            "Linkages of the family that meet all demands: {count:,} of {members:,}.", members=len(dyads), count=count
        ),
        IMPROVED.filled(step=_STEPS[-1]),
        *resolution([name for name in orders if name != "transmission"], _STEPS[-1], OF_EXTENT),
    ]
    places = np.array([(dyad.moving, dyad.fixed) for dyad in dyads])

    def apart(some: NDArray[np.intp], dyad: GuidingDyad) -> NDArray[np.intp]:
        """Those of the sample that differ from a dyad."""
        gaps = np.abs(places[some] - [dyad.moving, dyad.fixed]).sum(axis=1)
        return np.asarray(some[gaps > _VALLEY * _reach(dyad)])

    left = ranks[: np.count_nonzero(good) or number]  # where none of the sample is good, one beside it may be
    best: list[GuidingDyad] = []
    for _ in range(_TRIED * number):
        if not len(left) or len(best) == number:
            break
        dyad = dyads[left[0]]
        left, meets = apart(left, dyad), False
        for width in _STEPS:
            for _ in range(_CLIMBS):
                others = [dyad, *near(dyad, width)]
                order, fine, _ = ranked(others)
                dyad, meets = others[order[0]], bool(fine[order[0]])
                if order[0] == 0:
                    break
        if meets and all(
            abs(dyad.moving - each.moving) + abs(dyad.fixed - each.fixed) > _ALIKE * _reach(each) for each in best
        ):
            best.append(dyad)
    left = ranks[: np.count_nonzero(good)]
    for dyad in best:
        left = apart(left, dyad)
    while len(left) and len(best) < number:  # few searches end at different places: others stand beside them
        best.append(dyads[left[0]])
        left = apart(left, best[-1])
    if not count:
        notes[0] = (_NONE_BESIDE, _SOME_BESIDE)[bool(best)].filled(members=len(dyads), count=len(best))
    return best, notes if best else notes + tightest(met)


def _reach(dyad: GuidingDyad) -> float:
    """The size of a crank and its coupler, seen from the crank's pivot."""
    return abs(dyad.moving) + abs(dyad.fixed)


_NONE_BESIDE = message(
    "None of {members:,} linkages taken of the family meets all demands, nor does any beside those that come nearest "
    "to it."
)
_SOME_BESIDE = message(
    "None of {members:,} linkages taken of the family meets all demands; beside those that come nearest to it "
    "{count:,} that differ do."
)
_BESIDE_SAMPLE = message("Beside those that come nearest to the demands {count:,} were found that meet them.")
OF_EXTENT = message(
    "The best by {measure} are improved in steps down to {step:.1g} of the extent of the family; that no other is "
    "better is not proved."
)
IMPROVED = message(
    "The best of these are improved: their pivots are moved within the family, in steps down to {step:.1g} of its "
    "extent; of those that are then nearly the same one is listed."
)
_SEARCHED = {
    (False, False): message(
        "Four-bars that meet all demands: {count:,} of {pairs:,} ({dyads} dyads, each with each, driven at either)."
    ),
    (False, True): message("Linkages of a crank and a dyad {form} that meet all demands: {count:,} of {pairs:,}."),
    (True, False): message(
        "Four-bars with the given pivot, driven there or at the other one, that meet all demands: {count:,} of "
        "{pairs:,}."
    ),
    (True, True): message(
        "Linkages with the given pivot and a dyad {form} that meet all demands: {count:,} of {pairs:,}."
    ),
}
"""By whether a dyad is given and whether the other one slides."""


def distinct_pairs(pairs: Iterable[Pair], size: float) -> list[Pair]:
    """Those that are not nearly the same as one before.

    >>> from gruebler.design.synthesis.dyads import CRANK
    >>> crank, rocker = GuidingDyad(CRANK, 1j, 0j), GuidingDyad(CRANK, 3 + 2j, 4 + 0j)
    >>> len(distinct_pairs([(crank, rocker), (crank, GuidingDyad(CRANK, 3 + 2.05j, 4.02 + 0j))], 1.0))
    1
    """
    kept: list[Pair] = []
    for pair in pairs:
        first, second = pair
        turning = [dyad.length for dyad in pair if not dyad.slides]
        between = abs(first.moving - second.moving), abs(first.fixed - second.fixed)
        if all(_gap(pair, other) > _ALIKE * (size + min(*turning, *between)) for other in kept):
            kept.append(pair)
    return kept


def best_first(task: PositionTask, demands: Demands, pairs: Iterable[Pair], orders: Sequence[str]) -> list[Pair]:
    """Pairs in their order: those first that meet the demands, then what is best."""

    def cost(pair: Pair) -> list[float]:
        facts = pair_facts(task, pair[:1], pair[1:], demands)
        costs = facts.costs(orders, np.ones((1, 1), bool))
        return [float(part[0, 0]) for part in (demands_failed(facts.met(demands)), *costs)]

    return sorted(pairs, key=cost)


def _gap(first: Pair, second: Pair) -> float:
    """The sum of the distances of the pivots of two linkages, whichever dyad drives; infinite for two kinds."""
    if {dyad.kind.form for dyad in first} != {dyad.kind.form for dyad in second}:
        return np.inf
    return min(
        sum(abs(a.moving - b.moving) + abs(a.fixed - b.fixed) for a, b in zip(first, other, strict=True))
        for other in (second, second[::-1])
    )


def _improved(sought: SoughtPairs, pair: Pair, widths: Sequence[float] = WIDTHS, moves: int = 1) -> tuple[Pair, bool]:
    """The best pair nearby, on finer and finer grids about the best so far, and whether it meets all demands."""
    meets = False
    for width in widths:
        for _ in range(moves):
            first, second = ([dyad, *sought.near(dyad, width)] for dyad in pair)
            facts = pair_facts(sought.task, first, second, sought.demands)
            fails = demands_failed(facts.met(sought.demands))
            i, j = divmod(int(facts.ranks(fails, sought.orders)[0]), len(second))
            pair, meets = (first[i], second[j]), bool(fails[i, j] == 0)
            if i == j == 0:
                break
    return pair, meets
