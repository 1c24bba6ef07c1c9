"""What linkages of two guiding dyads do, in closed form: branch, order, full turn, transmission angle, which demands.

All follow from the lengths and crank angles of each pair. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, demands_met, distance_of_pivots, inside_region, sought_order
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, DyadKind, GuidingDyad
from gruebler.design.synthesis.pair_shifts import PairPlaces, body_shifts
from gruebler.design.synthesis.results import NEAR_PIVOTS
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.tasks import PositionTask

_SAME_WAY = 1e-9  # radians: of two ways that differ by less the first one is taken
_OVER = 1e-3  # of crank and frame together: so near to the pivot of a block the crank's pin does not pass
_BITS = 30  # costs that differ behind them are equal: a tie is not decided by how a machine rounds
USUAL = ("full-turn", "transmission", "size-ratio")
"""By what designs are sorted unless the caller says otherwise."""
KNOWN = ("transmission", "range-transmission", "size", "size-ratio", "full-turn", "sensitivity", NEAR_PIVOTS)
"""What tells linkages of a family apart."""
Places = tuple[Complexes, Complexes]
"""Pins in all positions, (n, m, positions), and their pivots, (n, m); an axis may have the length 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairFacts:
    """What the linkages of pairs of dyads do: entry (i, j) is driven at dyad i of the first list, an RR one."""

    lengths: Reals
    """(4, n, m) crank, coupler, rocker, frame; NaN where a slide has no such length."""
    branch: Flags
    """All positions lie on one branch."""
    moves: Flags
    """They do, and the crank meets them in order."""
    turns: Flags
    transmission: Reals
    """The least transmission angle on the way through the positions, in radians; where the crank does not meet them in
    order, on the shortest way through all of them."""
    closure: PairClosure
    inside: Flags
    """Both fixed pivots lie in the region."""
    travel: float
    """The size of the task, which counts as a length of linkages that slide: they have few others."""
    places: PairPlaces
    shifts_of: Callable[[PairPlaces], Reals]
    """How far the most sensitive target of linkages moves, as `Design.relative_sensitivity`."""
    pivot_distance: Reals
    """(n, m) from the pivots that are preferred, infinite where there are fewer; NaN without any."""

    @property
    def over_range(self) -> Reals:
        """(n, m) the least transmission angle over the whole range of the crank, in radians."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.nan_to_num(self.closure.over_range)

    @property
    def longest(self) -> Reals:
        """(n, m) the longest length."""
        return np.asarray(np.nanmax(self.lengths, axis=0), np.float64)

    @property
    def size_ratio(self) -> Reals:
        """(n, m) the longest length by the shortest."""
        shortest = np.nanmin(self.lengths, axis=0)
        shortest = np.where(np.isnan(self.lengths).any(axis=0), np.minimum(shortest, self.travel), shortest)
        return np.asarray(self.longest / np.maximum(shortest, 1e-200), np.float64)

    @property
    def targets(self) -> int:
        """How many there are."""
        return int(max(part.shape[-1] for part in self.places))

    def met(self, demands: Demands) -> list[tuple[Message, Flags]]:
        """The demands by their names, each with the pairs that meet it."""
        met = [(message("one branch"), self.branch if demands.one_branch else np.ones_like(self.branch))]
        if demands.one_branch and demands.in_order:
            met.append((message("the order of the targets"), self.moves))
        return met + demands_met(demands, self.turns, self.transmission, self.size_ratio, self.inside)

    def shifts(self, which: Flags) -> Reals:
        """(n, m) how far the most sensitive target moves, infinite where it is not asked for. Cost: 10 us each."""
        shifts = np.full(which.shape, np.inf)
        each = (*which.shape, self.targets)
        some = PairPlaces(*(np.broadcast_to(part, each)[which] for part in self.places))
        shifts[which] = np.nan_to_num(self.shifts_of(some), nan=np.inf)
        return shifts

    def costs(self, orders: Sequence[str], which: Flags) -> list[Reals]:
        """(n, m) what is to be small, the most important first; some only where it is asked for."""
        costs: Sequence[Callable[[], Reals]] = (
            lambda: -self.transmission,
            lambda: -self.over_range,
            lambda: np.maximum(self.longest, self.closure.reach),
            lambda: self.size_ratio,
            lambda: np.asarray(1.0 - self.turns, np.float64),
            lambda: self.shifts(which),
            lambda: self.pivot_distance,
        )
        known = dict(zip(KNOWN, costs, strict=True))
        return [_rounded(known[name]()) for name in (*orders, *USUAL) if name in known]

    def ranks(self, fails: Reals, orders: Sequence[str]) -> NDArray[np.intp]:
        """The pairs in a row, those first that fail in the fewest demands, then what is best."""
        costs = [fails, *self.costs(orders, fails == fails.min())]
        return np.lexsort([cost.ravel() for cost in reversed(costs)])


def _rounded(values: Reals) -> Reals:
    mantissa, power = np.frexp(values)
    return np.asarray(np.ldexp(np.round(np.ldexp(mantissa, _BITS)), power - _BITS), np.float64)


def pair_facts(
    task: PositionTask, first: Sequence[GuidingDyad], second: Sequence[GuidingDyad], demands: Demands
) -> PairFacts:
    """What all pairs of RR dyads with dyads of one kind do, in closed form. Cost: 2 us a pair."""
    (pins, own), (far_pins, far) = (_places(task, dyads) for dyads in (first, second))
    directions = np.array([dyad.direction for dyad in second], np.complex128)
    slides = directions[None, :, None] * (1 if second[0].kind == SLIDER else task.turns / task.turns[0])
    driven, other = (pins[:, None], own[:, None]), (far_pins[None], far[None])
    guided = GuidedBody(task.origins, task.size, second[0].kind)
    return guided.facts(driven, other, slides, demands, sought_order(task, demands))


class GuidedBody(NamedTuple):
    """A body in its positions, guided by a crank and a dyad of some kind."""

    point: Complexes
    """(positions,)"""
    size: float
    """Of the task."""
    kind: DyadKind

    def facts(
        self, driven: Places, other: Places, slides: Complexes, demands: Demands, order: TargetOrder | None
    ) -> PairFacts:
        """As `facts_of_pins`, of pivots in the plane of the task."""
        pivots = [driven[1], *([] if self.kind == SLIDER else [other[1]])]
        inside = np.logical_and.reduce(np.broadcast_arrays(*(inside_region(pivot, demands) for pivot in pivots)))
        return facts_of_pins(
            driven,
            other,
            slides,
            self.kind,
            inside=inside,
            size=self.size if np.ptp(self.point) else np.inf,
            order=order,
            shifts=partial(body_shifts, body=self.point, size=self.size),
            pivot_distance=distance_of_pivots(pivots, demands),
        )


def facts_of_pins(
    driven: Places,
    other: Places,
    slides: Complexes,
    kind: DyadKind,
    *,
    inside: Flags,
    size: float,
    order: TargetOrder | None = None,
    shifts: Callable[[DyadKind, PairPlaces], Reals],
    pivot_distance: Reals,
) -> PairFacts:
    """What cranks do with rockers, sliders or blocks, from the pins of both in all positions and their pivots."""
    places = PairPlaces(driven[0], driven[1][..., None], other[0], other[1][..., None], slides)
    with np.errstate(divide="ignore", invalid="ignore"):
        closure = _CLOSURES[kind](driven, other, slides)
        branch, moves, turns, transmission = motion_of_pairs(closure, order)
    # Two dyads with a common pivot are no linkage.
    lengths = closure.lengths
    usable = np.isfinite(transmission) & (np.nanmin(lengths, axis=0) > 1e-9 * np.nanmax(lengths, axis=0))
    return PairFacts(
        lengths=lengths,
        branch=np.asarray(branch & usable),
        moves=np.asarray(moves & usable),
        turns=np.asarray(turns & usable),
        transmission=np.where(usable, transmission, 0.0),
        closure=closure,
        inside=np.broadcast_to(inside, usable.shape),
        travel=size,
        places=places,
        shifts_of=partial(shifts, kind),
        pivot_distance=np.broadcast_to(pivot_distance, usable.shape),
    )


class PairMotion(NamedTuple):
    """What cranks do, for each pair; see `PairFacts`."""

    branch: Flags
    moves: Flags
    turns: Flags
    transmission: Reals


def motion_of_pairs(closure: PairClosure, order: TargetOrder | None = None) -> PairMotion:
    """Whether all targets lie on one branch, and in order on it; whether the crank turns; its transmission angle.

    The last is at most a right angle and only meant for linkages that meet the targets; that of the shortest way which
    keeps the order, where several do.
    """
    low, high, angle, side, turns = closure.low, closure.high, closure.angle, closure.side, closure.turns
    split = (low >= -1) & (high <= 1)
    passes_back = (low < -1) & ~turns
    angle = np.where(passes_back[..., None], angle % (2 * np.pi), angle)
    begin, travel = shortest_arc(angle, closed=turns)
    order = order or TargetOrder.of((), angle.shape[-1])
    ordered, shortest = np.full(turns.shape, order.demands_nothing), np.full(turns.shape, np.inf)
    for sequence in () if order.demands_nothing else order.sequences():
        along = angle[..., list(sequence)]
        gone = _way(along, turns)
        better = np.abs(gone) < shortest - _SAME_WAY
        ordered |= np.isfinite(gone)
        shortest = np.where(better, np.abs(gone), shortest)
        begin, travel = np.where(better, along[..., 0], begin), np.where(better, gone, travel)
    same_part = ~split | (np.sign(angle) == np.sign(angle[..., :1])).all(axis=2)
    branch = (side == side[..., :1]).all(axis=2) & (side[..., 0] != 0) & same_part
    transmission = closure.least_angle(*(_extreme(begin, travel, at) for at in (0.0, np.pi)))
    return PairMotion(*map(np.asarray, (branch, branch & ordered, turns, transmission)))


def _way(angle: Reals, turns: Flags) -> Reals:
    """How far the crank goes through angles one after the other, within a lap; infinite if it cannot without a turn."""
    steps = np.diff(angle, axis=2)
    onward, back = (steps % (2 * np.pi)).sum(axis=2), ((-steps) % (2 * np.pi)).sum(axis=2)
    ordered = np.where(turns, np.minimum(onward, back) < 2 * np.pi, (steps > 0).all(axis=2) | (steps < 0).all(axis=2))
    travel = np.where(onward <= back, onward, -back)  # of two positions both ways lead there: the shorter is taken
    return np.where(ordered, np.where(turns, travel, angle[..., -1] - angle[..., 0]), np.inf)


def shortest_arc(angles: Reals, *, closed: Flags | bool) -> tuple[Reals, Reals]:
    """Begin and width of the shortest range with all angles of the last axis; beyond a whole turn where it is closed.

    >>> begin, width = shortest_arc(np.radians([0, 170, 200]), closed=True)
    >>> np.degrees([begin, width]).round(9).tolist()
    [170.0, 190.0]
    """
    turned = np.sort(np.where(np.asarray(closed)[..., None], angles % (2 * np.pi), angles), axis=-1)
    widths = np.concatenate(
        [turned[..., -1:] - turned[..., :1], turned[..., :-1] + 2 * np.pi - turned[..., 1:]], axis=-1
    )
    widths[..., 1:] = np.where(np.asarray(closed)[..., None], widths[..., 1:], np.inf)
    first = np.argmin(np.round(widths, 9), axis=-1, keepdims=True)
    begin, width = (np.take_along_axis(part, first, axis=-1)[..., 0] for part in (turned, widths))
    return np.asarray(begin), np.asarray(width)


@dataclass(frozen=True, slots=True, kw_only=True)
class PairClosure:
    """Where the crank can be assembled with the other dyad: its angle from a line of symmetry, with cosines between."""

    lengths: Reals
    low: Reals
    high: Reals
    angle: Reals
    """(n, m, positions)"""
    side: Reals
    """(n, m, positions) the sign of the assembly mode."""
    cosine: Callable[[Reals], Reals]
    """Of the transmission angle, from the cosine of the crank angle."""
    reach: Reals | float = 0.0
    """How far the line of a slide lies from the other joint of its link, as it counts in `Linkage.size`."""

    @property
    def turns(self) -> Flags:
        """Whether the crank turns fully."""
        return np.asarray((self.low < -1) & (self.high > 1))

    @property
    def over_range(self) -> Reals:
        """The least transmission angle over the whole range of the crank; zero where that ends in a dead centre."""
        whole = np.ones(self.turns.shape)
        return np.where(self.turns, self.least_angle(whole, -whole), 0.0)

    def least_angle(self, nearest: Reals, farthest: Reals) -> Reals:
        """The least transmission angle of a range of the crank, from the largest and the least cosine of its angle."""
        cosines = [self.cosine(nearest), self.cosine(farthest)]
        return np.asarray(np.arccos(np.clip(np.maximum(*map(np.abs, cosines)), 0, 1)))


def _by_rocker(driven: Places, other: Places, _: Complexes) -> PairClosure:
    (pins, own), (far_pins, far) = driven, other
    frame = far - own
    a, c = (np.abs(p[..., 0] - m) for p, m in (driven, other))
    a, b, c, d = np.broadcast_arrays(a, np.abs(far_pins[..., 0] - pins[..., 0]), c, np.abs(frame))
    return PairClosure(
        lengths=np.array([a, b, c, d]),
        low=(a * a + d * d - (b + c) ** 2) / (2 * a * d),
        high=(a * a + d * d - (b - c) ** 2) / (2 * a * d),
        angle=np.angle((pins - own[..., None]) / frame[..., None]),
        side=np.sign(np.imag(np.conj(far_pins - pins) * (far[..., None] - pins))),
        cosine=lambda x: (b * b + c * c - a * a - d * d + 2 * a * d * x) / (2 * b * c),
    )


def _by_slider(driven: Places, other: Places, slides: Complexes) -> PairClosure:
    """The pin on a line at e from the crank's pivot: |a sin(phi) - e| <= b, phi from the line."""
    (pins, own), (far_pins, far) = driven, other
    a, b = np.broadcast_arrays(np.abs(pins[..., 0] - own), np.abs(far_pins[..., 0] - pins[..., 0]))
    e = np.imag(np.conj(slides[..., 0]) * (far - own))
    none = np.full(b.shape, np.nan)
    return PairClosure(
        lengths=np.array([a, b, none, none]),
        low=(e - b) / a,
        high=(e + b) / a,
        angle=np.angle((pins - own[..., None]) / (1j * slides)),
        side=np.sign(np.real(np.conj(slides) * (far_pins - pins))),
        cosine=lambda x: (a * x - e) / b,
        reach=np.abs(far_pins[..., 0] - own),
    )


def _by_block(driven: Places, other: Places, slides: Complexes) -> PairClosure:
    """A line of the coupler, at e from the crank's pin, through the other pivot: their distance is at least |e|."""
    (pins, own), (_, far) = driven, other
    frame = far - own
    a, d = np.broadcast_arrays(np.abs(pins[..., 0] - own), np.abs(frame))
    seen = np.conj(slides) * (far[..., None] - pins)
    along, e = np.real(seen), np.imag(seen[..., 0])
    none = np.full(d.shape, np.nan)
    return PairClosure(
        lengths=np.array([a, none, none, d]),
        low=np.full(d.shape, -np.inf),
        high=(a * a + d * d - e * e) / (2 * a * d),
        angle=np.angle((pins - own[..., None]) / frame[..., None]),
        side=np.where(np.abs(along) > 1e-9 * (a + d)[..., None], np.sign(along), 0.0),
        cosine=lambda x: _across_block(e, a * a + d * d - 2 * a * d * x, _OVER * (a + d)),
        reach=np.abs(e),
    )


def _across_block(e: Reals, square: Reals, least: Reals) -> Reals:
    """The cosine of the transmission angle; 1 where the crank's pin passes over the pivot of the block."""
    return np.where(square < least**2, 1.0, e / np.sqrt(np.maximum(square, 0)))


_CLOSURES = {CRANK: _by_rocker, SLIDER: _by_slider, BLOCK: _by_block}


def _places(task: PositionTask, dyads: Sequence[GuidingDyad]) -> tuple[Complexes, Complexes]:
    """The moving pivots in all positions, (dyads, positions), and the fixed ones."""
    moving = np.array([dyad.moving for dyad in dyads], np.complex128)
    seen = (moving - task.origins[0]) / task.turns[0]
    return task.origins + seen[:, None] * task.turns, np.array([dyad.fixed for dyad in dyads], np.complex128)


def _extreme(begin: Reals, travel: Reals, at: float) -> Reals:
    """The cosine nearest to that of an angle, over a travel from a begin: its own if the angle is passed."""
    low, high = np.minimum(begin, begin + travel), np.maximum(begin, begin + travel)
    passed = np.floor((high - at) / (2 * np.pi)) > np.floor((low - at) / (2 * np.pi))
    ends = np.cos(low), np.cos(high)
    nearest = np.maximum(*ends) if at == 0 else np.minimum(*ends)
    return np.where(passed, np.cos(at), nearest)
