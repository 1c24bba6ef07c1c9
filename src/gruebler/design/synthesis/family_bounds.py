"""Proofs for the family of four positions: that no four-bar of it meets the demands, by branch and bound.

Pairs of cells of dyads are excluded where enclosures show that a demand fails for all of their four-bars, else one of
the two cells is halved. docs/theory/synthesis-positions.md, "Proofs in the family of four positions".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum, auto
from math import ceil, degrees, radians
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Flags, Integers, Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, joined, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_cells import FAR, DyadCells, DyadCurve, short_cells
from gruebler.design.synthesis.dyads import CRANK, Displacements
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.pair_lengths import PairLengths, Ranges
from gruebler.design.synthesis.results import EXACT, form_symbols
from gruebler.design.synthesis.tasks import PositionTask
from gruebler.structure.chain.pairs import SymbolText

_BUDGET = 150_000  # pairs of cells that are looked at
_CHUNK = 20_000  # of them at a time
NARROW = 1e-7  # sizes: cells shorter than this are not halved, as rounding is near
MARGINS = (0.05, 1.0, 10.0)  # degrees above the best transmission angle found, tried in turn
_LAP = 2 * np.pi


_NONE = message("Proved: no four-bar of this family with pivots within {far:g} sizes of the task meets all demands.")
_AT_MOST = message(
    "Proved: no four-bar of this family with pivots within {far:g} sizes of the task meets all demands with a "
    "transmission angle above {angle:.1f}°."
)
_UNDECIDED = message(
    "Not decided: whether a four-bar of this family with pivots within {far:g} sizes of the task meets all demands; a "
    "part of {left:.1g} of all pairs of dyads is not excluded, such as that of the fixed pivots ({x:.5g}, {y:.5g}) and "
    "({u:.5g}, {v:.5g})."
)
_BEST = message("The best one here has {best:.1f}°.")
_NEARLY_RIGHT = message(
    "The largest transmission angle of linkages {form} that was found, {best:.1f}°, is a right angle to {margin:g}°: "
    "none can be larger by more."
)
_UNKNOWN = message("No bound of the transmission angle could be proved for this family of four-bars.")


class Exclusion(NamedTuple):
    """How much of a family is excluded."""

    left: float
    """The part of all pairs of dyads, by the parameters of the curve, that is not excluded; 0 is a proof."""
    example: tuple[complex, complex, complex, complex] | None
    """Of a pair that is left: the driven dyad's pivots on the frame and on the body, then those of the other."""
    pairs: int
    """Pairs of cells that were looked at."""


class WayOrder(Enum):
    """In which order the crank meets the positions."""

    LISTED = auto()
    ANY = auto()
    """That with the least travel, as of two positions, which each way meets in order."""
    OWN = auto()
    """One that is given: what is excluded without it is excluded all the more."""

    @classmethod
    def of(cls, task: PositionTask, demands: Demands) -> WayOrder:
        """That of a task."""
        if not demands.in_order or len(task) == 2:
            return cls.ANY
        return cls.OWN if task.order else cls.LISTED


def excluded(task: PositionTask, demands: Demands, budget: int = _BUDGET) -> Exclusion:
    """Whether enclosures exclude every four-bar of four positions, with pivots within 30 sizes, under the demands.

    Tolerances are not asked: what is excluded is so without them. Cost: 0.2 s, with the
    whole budget 0.5 s.
    """
    given, origin, size = Displacements.of(task.origins, task.turns)
    try:
        curve = DyadCurve(given)
    except SynthesisError:  # no point of it is known
        return Exclusion(left=1.0, example=None, pairs=0)
    if not curve.fits:
        return Exclusion(left=1.0, example=None, pairs=0)
    cells, singular = short_cells(curve)
    whole = len(curve.spans) * (1 if curve.cubic.closes else 2) * curve.end
    beyond = float(np.sum(singular[:, 3] - singular[:, 2])) / whole if len(singular) else 0.0
    search = PairTests(demands, WayOrder.of(task, demands), origin, size)
    seen = DyadCells(curve, cells)
    drivers, others = search.kept(seen)
    i, j = (side.ravel() for side in np.meshgrid(np.flatnonzero(drivers), np.flatnonzero(others), indexing="ij"))
    looked = 0
    settled: list[tuple[DyadCells, Integers, Integers]] = []
    while len(i):
        looked += len(i)
        parts = [slice(k, k + _CHUNK) for k in range(0, len(i), _CHUNK)]
        stays = ~np.concatenate([search.fails(seen, i[part], j[part]) for part in parts])
        i, j = i[stays], j[stays]
        narrow = np.maximum(seen.extent[i], seen.extent[j]) < NARROW
        if looked + 2 * len(i) > budget:
            narrow[:] = True
        if narrow.any():
            settled.append((seen, i[narrow], j[narrow]))
        seen, i, j = _halved(curve, seen, i[~narrow], j[~narrow])
        drivers, others = search.kept(seen)
        stays = drivers[i] & others[j]
        i, j = i[stays], j[stays]
    left = sum(float(_widths(some)[i] @ _widths(some)[j]) for some, i, j in settled) / whole**2
    example = None
    for some, i, j in settled[:1]:
        k = int(np.argmax(_widths(some)[i] * _widths(some)[j]))
        pivots = (some.fixed.value[i[k]], some.moving.value[i[k]], some.fixed.value[j[k]], some.moving.value[j[k]])
        first, second, third, fourth = (complex(pivot) * size + origin for pivot in pivots)
        example = first, second, third, fourth
    return Exclusion(left=left + 2 * beyond, example=example, pairs=looked)


def bound_notes(task: PositionTask, demands: Demands, best: float | None) -> Iterator[Message]:
    """What is proved of the family: of its best transmission angle is known, in radians, or None where none was found.

    Cost: 0.3 s, at most 2 s.
    """
    left = None
    if best is None:
        left = excluded(task, demands)
        if not left.left:
            yield _NONE.filled(far=FAR)
            return
    begin = degrees(demands.transmission if best is None else best)
    for margin in MARGINS:
        angle = ceil(10 * (begin + margin)) / 10
        if best is not None and angle >= 90:
            yield nearly_right(form_symbols(f"{CRANK.form}-{CRANK.form}"), best, radians(margin))
            return
        if angle < 90 and not excluded(task, replace(demands, transmission=radians(angle))).left:
            yield beside_best(_AT_MOST.filled(far=FAR, angle=angle), best)
            return
        if left is not None and left.example is not None:
            first, _, second, _ = left.example
            yield _UNDECIDED.filled(far=FAR, left=left.left, x=first.real, y=first.imag, u=second.real, v=second.imag)
            left = None
    yield _UNKNOWN


def beside_best(bound: Message, best: float | None) -> Message:
    """A bound, and the best angle that is known, in radians, to compare."""
    return bound if best is None else joined([bound, _BEST.filled(best=degrees(best))], " ")


def nearly_right(form: SymbolText, best: float, margin: float) -> Message:
    """That a transmission angle in radians is so near to a right angle that none is larger by more than a margin."""
    return _NEARLY_RIGHT.filled(form=form, best=degrees(best), margin=degrees(margin))


def _widths(cells: DyadCells) -> Reals:
    return np.asarray(cells.cells[:, 3] - cells.cells[:, 2])


def _halved(curve: DyadCurve, seen: DyadCells, i: Integers, j: Integers) -> tuple[DyadCells, Integers, Integers]:
    """The longer cell of each pair in two."""
    first = seen.extent[i] > seen.extent[j]
    split = np.unique(np.concatenate([i[first], j[~first]]))
    same = np.unique(np.concatenate([i[~first], j[first]]))
    at = np.zeros((2, len(seen.cells)), np.int64)
    at[0, split], at[1, same] = 2 * np.arange(len(split)), 2 * len(split) + np.arange(len(same))
    cells = DyadCells(curve, np.concatenate([seen.halves(split), seen.cells[same]]))
    own, other = np.where(first, at[0, i], at[1, i]), np.where(first, at[1, j], at[0, j])
    return cells, np.concatenate([own, own + first]), np.concatenate([other, other + ~first])


class _Side(NamedTuple):
    """Cells of the one dyad of pairs, and rows of them."""

    cells: DyadCells
    rows: Integers
    place: int
    """Of its parameters among those of the pairs, before or behind those of the other dyad."""

    def at(self, enclosed: Enclosure) -> Enclosure:
        return enclosed.at(self.rows).placed(self.place, enclosed.count)

    def some(self, rows: Integers) -> _Side:
        return self._replace(rows=self.rows[rows])


_Sides = tuple[_Side, _Side]
"""The driven dyads first."""


class PairTests:
    """The demands as tests of pairs of cells: true where all four-bars of a pair certainly fail."""

    def __init__(self, demands: Demands, order: WayOrder, origin: complex, size: float) -> None:
        self.demands, self.order = demands, order
        least = demands.transmission
        # Without one branch there is no way on which a transmission angle could be kept.
        self.on_a_branch = demands.one_branch or least > 0
        self.ordered = demands.one_branch and order is WayOrder.LISTED
        self.cosine = float(np.cos(least))
        turns = [complex(np.exp(1j * least)), complex(np.exp(-1j * least))]
        self.sides = turns if least > 0 else turns[:1]
        """Factors of the product of coupler and rocker whose imaginary parts have one sign where the angle is kept."""
        corner = np.array([origin.real, origin.imag, origin.real, origin.imag])
        self.region = None if demands.region is None else (np.array(demands.region) - corner) / size
        self.lengths = [(link, length / size) for link, length in demands.lengths]

    def kept(self, seen: DyadCells) -> tuple[Flags, Flags]:
        """Cells whose dyads may be driven, and those that may be the other dyad."""
        kept = ~seen.far
        if self.region is not None:
            kept &= ~seen.outside(self.region)
        return (kept & ~seen.keeps_no_order if self.ordered and self.demands.crank else kept), kept

    def fails(
        self, seen: DyadCells, i: Integers, j: Integers, seconds: DyadCells | None = None, *, far: int = 1
    ) -> Flags:
        """Pairs of cells, the driven one first; the other ones out of `seconds`, where they are given.

        The fixed pivots of the second cells may be infinitely far, or with `far` 0 those of the first ones.
        """
        sides = _Side(seen, i, 0), _Side(seconds or seen, j, 1)
        with np.errstate(invalid="ignore"):  # what is not bounded excludes nothing
            fails = self._fail(sides, far, 1)
            own = sides[far]
            unsure = np.flatnonzero(fails & (own.cells.weight.low[own.rows] <= 0))
            if len(unsure):
                fails[unsure] = self._fail((sides[0].some(unsure), sides[1].some(unsure)), far, -1)
        return fails

    def _fail(self, sides: _Sides, far: int, sign: int) -> Flags:
        """The same, where the weight of the far link has this sign."""
        (driven, other), (near, own) = sides, (sides[1 - far], sides[far])
        coupler = other.at(other.cells.moving) - driven.at(driven.cells.moving)
        away = own.at(own.cells.moving) - near.at(near.cells.fixed)
        link, weight = own.at(own.cells.first_arm) * sign, own.at(own.cells.weight) * sign
        lengths = PairLengths.of(coupler, near.at(near.cells.length), link, away, weight, crank_far=not far)
        fails = lengths.too_slender(self.demands.size_ratio) | lengths.have_others(self.lengths)
        frame = weight * away - link if far else (link - weight * away) * sign
        fails |= self.has_other_direction(frame)
        ranges = lengths.ranges
        if self.demands.crank:
            fails |= ranges.pi_shut | ranges.zero_shut
        if self.on_a_branch:
            fails |= self._leaves_branch(coupler, other.at(other.cells.back))
        if not self.demands.one_branch:
            return fails
        none = np.zeros(len(fails), bool)
        flat = lengths.too_flat(self.cosine) if self.demands.transmission else (none, none)
        # Of a crank with negative weight the arms are turned by half a turn, and so is the frame.
        phi = driven.at(driven.cells.angle) - frame.angle.column
        return np.asarray(fails | no_way(phi, driven.cells, driven.rows, ranges, flat, self.order))

    def has_other_direction(self, frame: Enclosure) -> Flags:
        """Whether the frame, from one pivot to the other, certainly has another direction than that demanded."""
        if self.demands.frame_direction is None:
            return np.zeros(len(frame.value), bool)
        across = (frame * complex(np.exp(-1j * self.demands.frame_direction))).imaginary
        slack = EXACT * frame.modulus.high
        return np.asarray((across.low > slack) | (across.high < -slack))

    def _leaves_branch(self, moving: Enclosure, back: Enclosure) -> Flags:
        """Whether some position certainly has its coupler on one side of the rocker, and some on the other.

        With a transmission angle: certainly not far enough on that side. The product of coupler, seen from the crank's
        pin and by the body, and rocker has the argument by which they turn against each other.
        """
        product = moving.conjugate.column * back
        turned = [(product * factor).imaginary for factor in self.sides]
        right = np.any([(part.high < 0).any(axis=1) for part in turned], axis=0)
        left = np.any([(part.low > 0).any(axis=1) for part in turned], axis=0)
        return np.asarray(right & left)


def no_way(
    phi: Enclosure, seen: DyadCells, i: Integers, ranges: Ranges, flat: tuple[Flags, Flags], order: WayOrder
) -> Flags:
    """Whether no range of the crank has a way through the positions: one about 0, about pi, both, or a full turn.

    Args:
        phi: (rows, positions) the crank angles.
        seen: the cells of the cranks.
        i: (rows,) which of them.
        ranges: what ends the ranges.
        flat: whether the transmission angle is certainly too small where the crank passes 0, and where it passes pi.
        order: in which the crank meets the positions.
    """
    at_zero, at_pi = flat
    pi_free, pi_shut, zero_free, zero_shut = ranges
    turns_not = pi_shut | zero_shut
    front = _Angles.cut(phi, -np.pi, 0.0)
    behind = _Angles.cut(phi, 0.0, np.pi)
    steps = seen.steps[1][i]
    listed, none = order is WayOrder.LISTED, np.zeros(len(i), bool)
    no_front, no_behind = (angles.keep_no_order(steps) if listed else none for angles in (front, behind))
    split = front.both_sides | no_front | pi_free | zero_free
    about_zero = no_front | (front.both_sides & at_zero) | pi_free | zero_shut
    about_pi = no_behind | (behind.both_sides & at_pi) | pi_shut | zero_free
    if listed:
        onward, back = (least[i] for least in seen.ways)
        begin, reach = phi.value[:, 0], phi.reach[:, 0]
        turns_not |= _way_fails(begin, reach, onward, at_zero, at_pi) & _way_fails(-begin, reach, back, at_zero, at_pi)
    elif order is WayOrder.ANY:
        turns_not |= _shortest_way_fails(phi, at_zero, at_pi)
    return np.asarray(split & about_zero & about_pi & turns_not)


class _Angles(NamedTuple):
    """Crank angles at the positions in a range of one turn that the crank does not leave."""

    middle: Reals
    sure: Flags
    """Whether it certainly lies within the range; nothing is said of the others."""
    both_sides: Flags
    """Whether some certainly lie on one side of the middle of the range and some on the other."""

    @classmethod
    def cut(cls, phi: Enclosure, begin: float, at: float) -> _Angles:
        middle = (phi.value - begin) % _LAP + begin
        low, high = middle - phi.reach, middle + phi.reach
        sure = (low >= begin) & (high <= begin + _LAP)
        both = ((low > at) & sure).any(axis=1) & ((high < at) & sure).any(axis=1)
        return cls(middle, sure, np.asarray(both))

    def keep_no_order(self, reach: Reals) -> Flags:
        """Whether they certainly neither rise nor fall; steps are wrong by so much at most."""
        steps, sure = np.diff(self.middle, axis=1), self.sure[:, 1:] & self.sure[:, :-1]
        rises, falls = ((steps - reach > 0) & sure).any(axis=1), ((steps + reach < 0) & sure).any(axis=1)
        return np.asarray(rises & falls)


def _way_fails(begin: Reals, reach: Reals, travel: Reals, at_zero: Flags, at_pi: Flags) -> Flags:
    """Whether an angle that rises through a way from about its begin takes a lap, or passes where it must not."""
    fails = travel >= _LAP
    for at, flat in ((0.0, at_zero), (np.pi, at_pi)):
        passed = np.floor((begin - reach + travel - at) / _LAP) > np.floor((begin + reach - at) / _LAP)
        fails |= passed & flat
    return fails


def _shortest_way_fails(phi: Enclosure, at_zero: Flags, at_pi: Flags) -> Flags:
    """Whether the shortest way of a crank that turns fully, around the largest gap, passes where it must not."""
    angles, reach = np.sort(phi.value % _LAP, axis=1), np.fmin(phi.reach.max(axis=1), _LAP)[:, None]
    gaps = np.roll(angles, -1, axis=1) - angles
    gaps[:, -1] += _LAP
    fails = gaps + 2 * reach < (gaps - 2 * reach).max(axis=1)[:, None]  # that is not the largest gap
    for at, flat in ((0.0, at_zero), (np.pi, at_pi)):
        within = (at - angles + reach) % _LAP < gaps + 2 * reach
        fails |= ~within & flat[:, None]
    return np.asarray(fails.all(axis=1))
