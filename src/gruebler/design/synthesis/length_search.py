"""Linkages of two dyads with given lengths or pivots: the best members of their family, made better among these.

Guiding dyads and given lengths are equations of second degree in the pivots; from pairs of a sample the nearest pairs
that satisfy all of them are found by Gauss and Newton. docs/theory/synthesis-positions.md, "Given lengths".
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.text import message
from gruebler.design.synthesis.demands import (
    Demands,
    across_direction,
    demands_failed,
    sought_order,
    tightest,
)
from gruebler.design.synthesis.dyad_cells import FAR
from gruebler.design.synthesis.dyads import (
    BLOCK,
    CRANK,
    SLIDER,
    Displacements,
    DyadKind,
    GuidingDyad,
    guiding_conditions,
    line_conditions,
)
from gruebler.design.synthesis.pair_facts import GuidedBody, PairFacts
from gruebler.design.synthesis.pair_search import FoundPairs, Pair, SoughtPairs, best_pairs, distinct_pairs
from gruebler.design.synthesis.results import form_symbols
from gruebler.design.synthesis.tasks import PositionTask

_ENDS = {
    CRANK: {"crank": (0, 1), "coupler": (0, 2), "rocker": (2, 3), "frame": (1, 3)},
    SLIDER: {"crank": (0, 1), "coupler": (0, 2)},
    BLOCK: {"crank": (0, 1), "frame": (1, 2)},
}
"""The links with two pins, and between which points of a row they lie, by the kind of the dyad that is not driven."""
_SAME = 1e-6  # sizes: two linkages that differ by less are one
_STEPS = 40
_LONGEST = 0.5  # of a step, in sizes, or by the largest number of a linkage
_REACHED = 1e-11  # of what is satisfied, by sizes
_BEGUN = 8192  # pairs of a sample from which is begun, those first that need the smallest step
SPREAD, WIDE = 2.5, 1.5
"""Degrees of freedom, and sizes: Student's distribution of random pivots."""
_LOOKED_AT = 400  # members for each linkage that is wanted
_APART = 0.2  # sizes: pivots of two members that are made better differ by more
_EXACT = 1e-14  # of the numbers: smaller steps end the search
_NOTHING = 1e-13  # of the squares of slopes: below it they are dependent
_RANK = 1e-7  # of the largest slope: an equation below it is none
_TURNS = 4  # with each width
_WIDTHS = tuple(0.16 * 0.4**k for k in range(9))  # sizes
FINEST_STEP = _WIDTHS[-1]
_FOUND = {
    True: message("Linkages {form} ({given}) that meet all demands: {count:,} of {pairs:,} that were found."),
    False: message("Linkages {form} ({given}) that meet all demands: {count:,} of a sample of {pairs:,}."),
}
"""By whether there are finitely many."""
_WITH_PIVOTS = message(
    "Linkages {form} with the given pivots that meet all demands: {count:,} of a sample of {pairs:,}."
)
_NONE = message("Linkages {form} ({given}): none was found.")
_WITHOUT = message(
    "Linkages {form} are left out: a link whose length or direction is given has fewer than two pins there."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConditionedRows(ABC):
    """Linkages that satisfy equations, each a row of numbers: first its pivots in sizes of the task, then others."""

    lengths: tuple[tuple[str, float], ...]
    """Links between two pins and their lengths, in the unit of the task."""
    frame_direction: float | None = None
    """The angle of the line through both fixed pivots with the x axis."""
    kind: DyadKind = CRANK
    """Of the dyad that is not driven."""

    @property
    @abstractmethod
    def size(self) -> float:
        """Of the task."""

    @property
    def ends(self) -> Mapping[str, tuple[int, int]]:
        """The links with two pins, and between which of the pivots of a row they lie."""
        return _ENDS[self.kind]

    @property
    def points(self) -> int:
        """How many pivots a row has."""
        return 3 if self.kind.slides else 4

    @abstractmethod
    def conditions(self, rows: Reals) -> tuple[Reals, Reals]:
        """(rows, conditions) zero for linkages that do the task, and (rows, conditions, numbers) slopes."""

    @abstractmethod
    def facts(self, rows: Reals, demands: Demands) -> PairFacts:
        """(rows, 1) what these linkages do."""

    def equations(self, rows: Reals) -> tuple[Reals, Reals]:
        """(rows, equations) zero for linkages of the family with the lengths, and (rows, equations, numbers) slopes."""
        done, by_done = self.conditions(rows)
        places, count = pivots_of_rows(rows, self.points), done.shape[1]
        sizes = len(self.lengths) + (self.frame_direction is not None)
        values, slopes = np.zeros((len(rows), count + sizes)), np.zeros((len(rows), count + sizes, rows.shape[1]))
        values[:, :count], slopes[:, :count] = done, by_done
        for k, (link, length) in enumerate(self.lengths, count):
            begin, end = self.ends[link]
            arm = places[:, end] - places[:, begin]
            values[:, k] = np.abs(arm) ** 2 - (length / self.size) ** 2
            for end_of, sign in ((begin, -2), (end, 2)):
                slopes[:, k, 2 * end_of], slopes[:, k, 2 * end_of + 1] = sign * arm.real, sign * arm.imag
        if self.frame_direction is not None:
            begin, end = self.ends["frame"]
            arm = places[:, end] - places[:, begin]
            values[:, -1] = across_direction(np.stack([arm.real, arm.imag], axis=1), self.frame_direction)
            for end_of, sign in ((begin, -1), (end, 1)):
                slopes[:, -1, 2 * end_of] = -sign * np.sin(self.frame_direction)
                slopes[:, -1, 2 * end_of + 1] = sign * np.cos(self.frame_direction)
        return values, slopes

    def step(self, rows: Reals, held: Flags) -> Reals:
        """The shortest step of numbers that are not held to where the equations hold, as they are linear nearby."""
        values, slopes = self.equations(rows)
        slopes = np.where(held[:, None], 0.0, slopes)
        squares = slopes @ slopes.transpose(0, 2, 1)
        nothing = _NOTHING * np.trace(squares, axis1=1, axis2=2)[:, None, None] + np.finfo(float).tiny
        solved = np.linalg.solve(squares + nothing * np.eye(squares.shape[1]), -values[:, :, None])
        with np.errstate(invalid="ignore", over="ignore"):
            shortest = (slopes.transpose(0, 2, 1) @ solved)[:, :, 0]
        return np.where(np.isfinite(shortest).all(axis=1, keepdims=True), shortest, 0.0)

    def members(self, rows: Reals, held: Flags) -> tuple[Reals, Flags]:
        """The linkages of the family near these, by Gauss and Newton, and whether there is one at hand.

        Args:
            rows: (linkages, numbers).
            held: (linkages, numbers) which numbers do not change.
        """
        rows = rows.copy()
        moving = np.arange(len(rows))
        for _ in range(_STEPS):
            step = self.step(rows[moving], held[moving])
            length = np.linalg.norm(step, axis=1)
            longest = _LONGEST * (1 + np.abs(rows[moving]).max(axis=1))
            step *= np.minimum(1.0, longest / np.maximum(length, longest))[:, None]
            rows[moving] += step
            moving = moving[length > _EXACT * (1 + np.abs(rows[moving]).max(axis=1))]
            if not len(moving):
                break
        far = np.abs(pivots_of_rows(rows, self.points)).max(axis=1)
        misses = np.abs(self.equations(rows)[0]).max(axis=1)
        return rows, np.asarray((misses <= _REACHED * (1 + far * far)) & (far < FAR))

    def about(self, row: Reals, held: Flags) -> Reals:
        """(directions, numbers) in which linkages of the family lie about one: along, and between, all its freedoms."""
        slopes = self.equations(row[None])[1][0]
        matrix = np.concatenate([slopes, np.eye(len(row))[held]])
        *_, sizes, turns = np.linalg.svd(matrix)
        axes = turns[int(np.count_nonzero(sizes > _RANK * sizes[0])) :]
        between = [(a + sign * b) / 2 for a, b in combinations(axes, 2) for sign in (1, -1)]
        return np.array([sign * axis for axis in (*axes, *between) for sign in (1, -1)]).reshape(-1, len(row))


@dataclass(frozen=True, slots=True, kw_only=True)
class PairFamily(ConditionedRows):
    """All linkages of a driven RR dyad and another one that guide a body, with given lengths or direction of the frame.

    Rows are linkages in sizes of the task about its origin: both pivots of the crank, on the body first, then those of
    the other dyad, or the one of a slide and the angle of its line.
    """

    task: PositionTask

    @classmethod
    def of(cls, task: PositionTask, kind: DyadKind, demands: Demands) -> PairFamily:
        """With the lengths and the direction of the frame that are demanded."""
        return cls(task=task, kind=kind, lengths=demands.lengths, frame_direction=demands.frame_direction)

    @property
    def size(self) -> float:
        """Of the task."""
        return Displacements.of(self.task.origins, self.task.turns)[2]

    def rows(self, first: Sequence[GuidingDyad], second: Sequence[GuidingDyad]) -> Reals:
        """(first x second, numbers) each with each, the driven ones first."""
        _, origin, size = Displacements.of(self.task.origins, self.task.turns)
        driven, other = (
            dyad_numbers([dyad.moved(1 / size, -origin / size) for dyad in some]) for some in (first, second)
        )
        return np.concatenate([np.repeat(driven, len(second), axis=0), np.tile(other, (len(first), 1))], axis=1)

    def dyads(self, row: Reals) -> Pair:
        """The linkage of a row, in the unit of the task."""
        _, origin, size = Displacements.of(self.task.origins, self.task.turns)
        x, m, *other = map(complex, pivots_of_rows(row, self.points))
        direction = complex(np.exp(1j * row[-1])) if self.kind.slides else 0j
        pair = GuidingDyad(CRANK, x, m), GuidingDyad(self.kind, other[0], other[-1], direction)
        return pair[0].moved(size, origin), pair[1].moved(size, origin)

    def conditions(self, rows: Reals) -> tuple[Reals, Reals]:
        """That both dyads guide the body."""
        given = Displacements.of(self.task.origins, self.task.turns)[0]
        places = pivots_of_rows(rows, self.points)
        count = len(given.q)
        values = np.zeros((len(rows), 2 * count))
        slopes = np.zeros((*values.shape, rows.shape[1]))
        values[:, :count], slopes[:, :count, :4] = guiding_conditions(given, places[:, 0], places[:, 1])
        if self.kind.seen is None:
            values[:, count:], slopes[:, count:, 4:] = guiding_conditions(given, places[:, 2], places[:, 3])
        else:
            values[:, count:], slopes[:, count:, 4:] = line_conditions(self.kind.seen(given), places[:, 2], rows[:, -1])
        return values, slopes

    def facts(self, rows: Reals, demands: Demands) -> PairFacts:
        """(rows, 1) what these linkages do."""
        given, origin, size = Displacements.of(self.task.origins, self.task.turns)
        q, t = given.with_first
        places = pivots_of_rows(rows, self.points)
        driven, other = (
            (origin + size * (places[:, side, None] * q + t)[:, None], origin + size * places[:, [last]])
            for side, last in ((0, 1), (2, -1))
        )
        angle = rows[:, -1:] if self.kind.slides else np.zeros((len(rows), 1))
        slides = np.exp(1j * angle) * (np.ones_like(q) if self.kind == SLIDER else q)
        guided = GuidedBody(self.task.origins, size, self.kind)
        return guided.facts(driven, other, slides[:, None], demands, sought_order(self.task, demands))


def dyad_numbers(dyads: Sequence[GuidingDyad]) -> Reals:
    """(dyads, numbers) of dyads of one kind: both pivots, or the one of a slide and the angle of its line."""
    pivots = np.array([[dyad.moving, dyad.fixed] for dyad in dyads], np.complex128).view(np.float64)
    if not dyads[0].slides:
        return pivots
    return np.concatenate([pivots[:, :2], np.angle([[dyad.direction] for dyad in dyads])], axis=1)


def pivots_of_rows(rows: Reals, count: int) -> Complexes:
    """(..., count) the pivots of rows, with which they begin."""
    return np.ascontiguousarray(rows[..., : 2 * count]).view(np.complex128)


def has_lengths(kind: DyadKind, demands: Demands) -> bool:
    """Whether linkages of a crank and such a dyad have all links whose lengths or direction are demanded."""
    return set(demands.links_with_sizes) <= set(_ENDS[kind])


def best_linkages(sought: SoughtPairs) -> FoundPairs:
    """As `best_pairs`; with given lengths, which no member of a sample has, the best of those that have them."""
    demands, given, kind = sought.demands, sought.given, sought.others[0].kind
    of_one_end = given and len(sought.task) == 2  # the other one is to choose
    if not (demands.given_sizes or of_one_end):
        return best_pairs(sought)
    if not has_lengths(kind, demands):
        return FoundPairs(pairs=(), notes=(_WITHOUT.filled(form=form_symbols(f"{CRANK.form}-{kind.form}")),))
    firsts, seconds = ([dyad for dyad in some if dyad not in given] for some in (sought.dyads, sought.others))
    groups = [(given, seconds), (firsts, given)] if given else [(sought.dyads, sought.others)]
    groups = [row for row in groups if row[0] and row[1] and (row[0][0].kind, row[1][0].kind) == (CRANK, kind)]
    return best_members(sought.task, groups, demands, orders=sought.orders, number=sought.number)


def best_members(
    task: PositionTask,
    groups: Sequence[tuple[Sequence[GuidingDyad], Sequence[GuidingDyad]]],
    demands: Demands,
    *,
    orders: Sequence[str] = (),
    number: int = 16,
) -> FoundPairs:
    """The best linkages of a family with given lengths and pivots; those that fail least if none meets all demands.

    Args:
        task: two to four positions.
        groups: samples of the dyads that are driven, RR ones, with samples of the other ones, of one kind; a pivot that
            all dyads of a sample share is held.
        demands: what counts, the lengths among it.
        orders: what is best, by the names of `results.ORDERS`.
        number: of linkages, at most.

    Cost: 1 s.
    """
    if not groups:
        return FoundPairs(pairs=(), notes=())
    kind = groups[0][1][0].kind
    form = form_symbols(f"{CRANK.form}-{kind.form}")
    family = PairFamily.of(task, kind, demands)
    rows, held = (np.concatenate(part) for part in zip(*(_begun(family, *group) for group in groups), strict=True))
    slopes = family.equations(rows[:: len(rows) // 32 + 1])[1][:, :, ~held[0]]
    determined = bool(np.count_nonzero(slopes.any(axis=(0, 2))) >= slopes.shape[2])  # equations of what is not held
    if len(rows) > _BEGUN:
        order = np.argsort(np.linalg.norm(family.step(rows, held), axis=1), kind="stable")
        # Half of them nearest to linkages with the lengths, half spread over all others: few linkages may all lie far.
        near, rest = order[: _BEGUN // 2], np.sort(order[_BEGUN // 2 :])
        begun = np.concatenate([near, rest[np.linspace(0, len(rest) - 1, _BEGUN // 2).astype(int)]])
        rows, held = rows[begun], held[begun]
    if determined:  # few linkages are found from places that the family does not fill
        wide = max([WIDE, *(length / task.size for _, length in demands.lengths)])
        anywhere = wide * np.random.default_rng(0).standard_t(SPREAD, (len(rows), rows.shape[1]))
        rows = np.concatenate([rows, np.where(held, rows, anywhere)])
        held = np.concatenate([held, held])
    rows, good = family.members(rows, held)
    _, first = np.unique(np.round(rows[good] / _SAME).astype(np.int64), axis=0, return_index=True)
    rows, held = rows[good][np.sort(first)], held[good][np.sort(first)]
    if not len(rows):
        return FoundPairs(pairs=(), notes=(_NONE.filled(form=form, given=demands.sizes_in_words),))
    facts = family.facts(rows, demands)
    met = facts.met(demands)
    fails = demands_failed(met)
    meets = (fails == 0).ravel()
    said = _FOUND[determined].filled(given=demands.sizes_in_words) if demands.given_sizes else _WITH_PIVOTS
    notes = [said.filled(form=form, pairs=len(rows), count=int(np.count_nonzero(meets)))]
    if demands.transmission > 0 and not meets.any():
        orders = ("transmission", *orders)  # those that are nearly good come first
    ranks = facts.ranks(fails, orders)[: np.count_nonzero(meets) or None][: _LOOKED_AT * number]
    chosen = _different(family, rows[ranks], 100 * _SAME if determined else _APART, 2 * number)
    rows, held = rows[ranks[chosen]], held[ranks[chosen]]
    rows, meets = improved_rows(family, rows, held, demands, orders)
    pairs = [family.dyads(row) for row in rows]
    if not determined:  # of finitely many each is one of its own
        pairs = distinct_pairs(pairs, task.size)
    return FoundPairs(pairs=tuple(pairs[:number]), notes=(*notes, *([] if meets.any() else tightest(met))))


def _begun(family: PairFamily, firsts: Sequence[GuidingDyad], seconds: Sequence[GuidingDyad]) -> tuple[Reals, Flags]:
    """Rows of samples, each with each, and which of their numbers are held."""
    rows = family.rows(firsts, seconds)
    held = np.concatenate([np.ptp(dyad_numbers(some), axis=0) == 0 for some in (firsts, seconds)])
    return rows, np.broadcast_to(held, rows.shape)


def _different(family: PairFamily, rows: Reals, apart: float, number: int) -> list[int]:
    """The first rows whose pivots differ from those before by more than some sizes in sum, whichever dyad drives."""
    places = pivots_of_rows(rows, family.points)
    chosen: list[int] = []
    close = np.zeros(len(rows), bool)
    orders = [[0, 1, 2], [0, 1, 2]] if family.kind.slides else [[0, 1, 2, 3], [2, 3, 0, 1]]
    while len(chosen) < number and not close.all():
        chosen.append(int(np.argmin(close)))
        for order in orders:
            close |= np.abs(places - places[chosen[-1], order]).sum(axis=1) <= apart
    return chosen


def improved_rows(
    family: ConditionedRows, rows: Reals, held: Flags, demands: Demands, orders: Sequence[str]
) -> tuple[Reals, Flags]:
    """Each linkage made better among its neighbours, on finer and finer stars; the best first, and which meet all."""

    def judged(some: Reals) -> tuple[Reals, Flags]:
        facts = family.facts(some, demands)
        fails = demands_failed(facts.met(demands))
        return np.concatenate([fails, *facts.costs(orders, np.ones(fails.shape, bool))], axis=1), (fails == 0).ravel()

    costs, meets = judged(rows)
    for width in _WIDTHS:
        for _ in range(_TURNS):
            changed = False
            stars = [row + width * family.about(row, keeps) for row, keeps in zip(rows, held, strict=True)]
            owner = np.repeat(np.arange(len(rows)), [len(star) for star in stars])
            if not len(owner):
                break
            near, good = family.members(np.concatenate(stars), held[owner])
            near, owner = near[good], owner[good]
            near_costs, near_meets = judged(near)
            for k in range(len(rows)):
                neighbours = np.flatnonzero(owner == k)
                best = min(neighbours, key=lambda n: tuple(near_costs[n]), default=None)
                if best is not None and tuple(near_costs[best]) < tuple(costs[k]):
                    rows[k], costs[k], meets[k], changed = near[best], near_costs[best], near_meets[best], True
            if not changed:
                break
    order = np.lexsort(costs.T[::-1])
    return rows[order], meets[order]
