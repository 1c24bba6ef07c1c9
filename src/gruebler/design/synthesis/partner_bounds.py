"""Proofs beside a dyad that is held: that no crank of the family with it, or no other dyad with a crank, does better.

Four positions have finitely many sliding dyads, so that the cranks beside each are all there is. Of two and three
positions a dyad of the best linkage is held. docs/theory/synthesis-positions.md, "Proofs for two and three positions".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, cos, degrees, pi, radians
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, inside_region
from gruebler.design.synthesis.dyad_cells import FAR, DyadCells, DyadCurve, DyadFamily, OneDyad
from gruebler.design.synthesis.dyad_planes import crank_family
from gruebler.design.synthesis.dyads import CRANK, SLIDER, Displacements, GuidingDyad
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.family_bounds import (
    MARGINS,
    NARROW,
    PairTests,
    WayOrder,
    beside_best,
    nearly_right,
    no_way,
)
from gruebler.design.synthesis.length_search import PairFamily, best_members, dyad_numbers
from gruebler.design.synthesis.pair_facts import pair_facts
from gruebler.design.synthesis.pair_lengths import Ranges, is_other, off
from gruebler.design.synthesis.pair_search import Pair
from gruebler.design.synthesis.results import form_symbols
from gruebler.design.synthesis.tasks import PositionTask
from gruebler.structure.chain.pairs import SymbolText

BUDGET = {2: 400_000, 3: 80_000, 4: 80_000}
"""Cells that are looked at, by the number of positions."""
_ON_A_CURVE = 20_000  # those of four positions beside a slide
_HALVINGS = 60  # of each parameter
_TURNS = 6  # in which one dyad is held
_WIDER = 10.0  # by what the margin grows where it was too narrow for a proof
MARGIN = {2: radians(0.5), 3: radians(0.05), 4: radians(0.05)}
"""Above the best transmission angle, by the number of positions: none beyond is proved."""
_CRANKS = 4  # or slides that are tried where none is known to meet the demands
_FOUR_BAR = f"{CRANK.form}-{CRANK.form}"
_SLACK = 1e-9  # of what is measured from the slide: far above the rounding of a dyad
_NONE = message(
    "Proved: no linkage {form} of this family with a crank within {far:g} sizes of the task meets all demands."
)
_AT_MOST = message(
    "Proved: no linkage {form} of this family with a crank within {far:g} sizes of the task meets all demands with a "
    "transmission angle above {angle:.1f}°."
)
_UNKNOWN = message("Not decided: whether a linkage {form} of this family meets all demands.")
_UNBOUNDED = message(
    "No bound of the transmission angle could be proved for linkages {form} of this family; the best one here has "
    "{best:.1f}°."
)
_BESIDE = message(
    "Proved: no other dyad beside the crank of the best four-bar, and no other crank beside its second dyad, meets all "
    "demands with a transmission angle above {angle:.1f}° and pivots within {far:g} sizes of the task. Four-bars that "
    "share neither dyad with it were sampled."
)
_BESIDE_SLIDE = message(
    "Proved: no other crank beside the slide of the best linkage {form} meets all demands with a transmission angle "
    "above {angle:.1f}° and pivots within {far:g} sizes of the task. Other slides were sampled."
)
_BESIDE_NONE = {
    False: message(
        "Proved: the {count} cranks that came nearest to the demands meet them with no other dyad whose pivots lie "
        "within {far:g} sizes of the task. Other cranks were sampled."
    ),
    True: message(
        "Proved: the {count} slides of linkages {form} that came nearest to the demands meet them with no crank whose "
        "pivots lie within {far:g} sizes of the task. Other slides were sampled."
    ),
}
"""By whether the dyad that is held slides."""
_TURNING = message("Of those whose crank turns fully: {said}")
_GIVEN_PIVOT, _GIVEN_CRANK = message("the given pivot"), message("this crank")
_NONE_BESIDE = message(
    "Proved: no four-bar with {held} and the other pivots within {far:g} sizes of the task meets all demands."
)
_MOST_BESIDE = message(
    "Proved: no four-bar with {held} and the other pivots within {far:g} sizes of the task meets all demands with a "
    "transmission angle above {angle:.1f}°."
)
_BESIDE_UNKNOWN = message(
    "Not decided for linkages {form}: whether exchanging one dyad of the best one gives a larger transmission angle "
    "than its {best:.1f}°; it is at most {most:.1f}° more."
)
_GIVEN_UNKNOWN = (
    message("Not decided: whether a four-bar with {held} meets all demands."),
    message("Not decided: whether a four-bar with {held} has a larger transmission angle than the best here."),
)
"""By whether one that meets the demands is known."""


class Partner(NamedTuple):
    """What is known of all dyads of a family beside one that is held."""

    left: float
    """The part of them, by their parameters, that is not excluded; 0 is a proof."""
    angle: float
    """The largest transmission angle that was found, or that with which the search began, in radians."""
    dyad: GuidingDyad | None
    """With which it was found."""


Tests = Callable[[DyadCells, float], Flags]
"""Which cells may have linkages with such a transmission angle."""


class Tried(NamedTuple):
    """Dyads in the middle of cells, or nearby with the lengths that are demanded."""

    angles: Reals
    """The transmission angles of their linkages; minus infinity where these fail."""
    moving: Complexes
    fixed: Complexes


Tries = Callable[[DyadCells], Tried]


def branch_and_bound(
    family: DyadFamily, possible: Tests, tries: Tries | None, begin: float, margin: float, budget: int
) -> tuple[float, float, tuple[complex, complex] | None]:
    """Branch and bound over the cells of a family.

    Returns the part that is not excluded under a transmission angle that is a margin larger than the best one, that
    best one, or `begin` if it is larger, and its pivots. Without `tries` nothing but `begin` is asked.
    """
    cells = family.first_cells()
    whole, left, looked, best, place = _content(cells), 0.0, 0, begin, None
    for _ in range(_HALVINGS * (cells.shape[1] // 2 - 1)):
        looked += len(cells)
        seen = DyadCells(family, cells)
        if tries is not None:
            tried = tries(seen)
            reached = np.where(seen.known & ~seen.far, tried.angles, -np.inf)
            if reached.max() > best:
                k = int(np.argmax(reached))
                best, place = float(reached[k]), (complex(tried.moving[k]), complex(tried.fixed[k]))
        if best + margin >= pi / 2:
            return left / whole, best, place
        stays = ~seen.far & possible(seen, best + margin)
        done = stays & ((seen.extent < NARROW) | (looked + 2 * np.count_nonzero(stays) > budget))
        left += _content(cells[done])
        cells = seen.halves(stays & ~done)
        if not len(cells):
            break
    return (left + _content(cells)) / whole, best, place


def _content(cells: Reals) -> float:
    """Of their parameters."""
    return float(np.prod(cells[:, 3::2] - cells[:, 2::2], axis=1).sum())


class PartnerSearch:
    """Branch and bound over all cranks beside a dyad, or over all RR dyads beside a crank that is driven."""

    def __init__(self, task: PositionTask, demands: Demands, held: GuidingDyad, *, driven: bool) -> None:
        self.given, self.origin, self.size = Displacements.of(task.origins, task.turns)
        self.task, self.demands, self.driven = task, demands, driven
        self.family: DyadFamily | None
        try:
            self.family = crank_family(self.given)
        except SynthesisError:  # no point of the curve is known
            self.family = None
        self.held = held.moved(1 / self.size, -self.origin / self.size)
        at = np.array([held.fixed], np.complex128)
        self.inside = held.kind.pairs[0].is_sliding or bool(inside_region(at, demands)[0])

    def possible(self, seen: DyadCells, angle: float) -> Flags:
        """Cells that may have a linkage with such a transmission angle."""
        wanted = replace(self.demands, transmission=angle)
        tests = PairTests(wanted, WayOrder.of(self.task, wanted), self.origin, self.size)
        drivers, others = tests.kept(seen)
        if self.held.slides:
            return self.inside & drivers & ~(seen.known & _fails(seen, self.given, self.held, tests))
        varied, own = np.arange(len(seen.cells)), np.zeros(len(seen.cells), np.int64)
        if self.driven:
            fails = tests.fails(self.cell, own, varied, seen)
        else:
            fails = tests.fails(seen, varied, own, self.cell, far=0)
        return np.asarray(self.inside & (others if self.driven else drivers) & ~fails)

    @cached_property
    def cell(self) -> DyadCells:
        """That of the dyad that is held."""
        assert self.family is not None
        held = OneDyad(self.family, self.held)
        return DyadCells(held, held.first_cells())

    def tried(self, seen: DyadCells) -> Tried:
        """The linkages in the middle of cells, or those with the given lengths and direction nearby."""
        kind = self.held.kind
        family = PairFamily.of(self.task, kind, self.demands)
        side = 0 if self.driven else 4
        row = dyad_numbers([self.held])
        middle = np.stack([seen.moving.value, seen.fixed.value], axis=1).view(np.float64)
        own = np.repeat(row, len(middle), axis=0)
        rows = np.concatenate([own, middle] if self.driven else [middle, own], axis=1)
        good = np.ones(len(rows), bool)
        if self.demands.given_sizes:
            held = np.zeros(rows.shape, bool)
            held[:, side : side + row.shape[1]] = True
            good = seen.known & ~seen.far
            rows[good], good[good] = family.members(rows[good], held[good])
        facts = family.facts(rows, self.demands)
        good &= (np.logical_and.reduce([flags for _, flags in facts.met(self.demands)]) & facts.branch)[:, 0]
        pivots = np.ascontiguousarray(rows[:, 4 - side : 8 - side]).view(np.complex128)
        return Tried(np.where(good, facts.transmission[:, 0], -np.inf), pivots[:, 0], pivots[:, 1])

    def partner(self, begin: float, margin: float, budget: int | None = None, *, improves: bool = True) -> Partner:
        """What is left of the family above the best transmission angle, or `begin`, and a margin."""
        if self.family is None or (isinstance(self.family, DyadCurve) and not self.family.fits):
            return Partner(left=1.0, angle=begin, dyad=None)
        tries, most = self.tried if improves else None, budget or BUDGET[len(self.task)]
        left, best, place = branch_and_bound(self.family, self.possible, tries, begin, margin, most)
        dyad = None if place is None else GuidingDyad(CRANK, *place).moved(self.size, self.origin)
        return Partner(left=left, angle=best, dyad=dyad)


def left_of_cranks(task: PositionTask, demands: Demands, dyad: GuidingDyad, budget: int = _ON_A_CURVE) -> float:
    """The part of all cranks, by the parameters of their family, that is not excluded beside a dyad; 0 is a proof.

    Ratios and sizes of lengths are not asked beside a slide: what is excluded is so without them. Cost: 0.1 s for four
    positions, else 1 s.
    """
    search = PartnerSearch(task, demands, dyad, driven=False)
    return search.partner(demands.transmission, 0.0, budget, improves=False).left


def _fails(seen: DyadCells, given: Displacements, slide: GuidingDyad, tests: PairTests) -> Flags:
    """Cells all of whose cranks certainly fail with the slide."""
    q, t = given.with_first
    pins = seen.moving.column * q + t
    a, cranks = seen.length, (seen, np.arange(len(seen.cells)))
    if slide.kind == SLIDER:
        arms = _slack((pins - given.images(slide.moving)) * np.conj(slide.direction))
        across = _slack((slide.moving - seen.fixed) * np.conj(slide.direction))
        phi = seen.angle - float(np.angle(1j * slide.direction))
        return fails_on_slide(arms, a, across.imaginary, phi, cranks, tests)
    least = cos(tests.demands.transmission)
    frame = slide.fixed - seen.fixed
    arms = _slack((slide.fixed - pins) * np.conj(slide.direction * q))
    d, e = frame.modulus, _first(arms).imaginary
    flat = off(e.column, least * arms.modulus)
    at_zero, at_pi = off(e, least * (a - d)) & off(e, least * (d - a)), off(e, least * (a + d))
    to_zero = (a - d) * (a - d) - e * e
    ranges = Ranges(
        pi_free=np.ones(len(seen.cells), bool),
        pi_shut=np.zeros(len(seen.cells), bool),
        zero_free=to_zero.low > 0,
        zero_shut=to_zero.high <= 0,
    )
    motion = _SlideMotion(
        along=arms.real, flat=flat, flat_at=(at_zero, at_pi), ranges=ranges, phi=seen.angle - frame.angle.column
    )
    fails = _moves_not(motion, {"crank": a, "frame": d}, cranks, tests)
    return np.asarray(fails | tests.has_other_direction(frame))


@dataclass(frozen=True, slots=True, kw_only=True)
class _SlideMotion:
    """What is known of linkages with a slide."""

    along: Enclosure
    """(cells, positions) of the slide."""
    flat: Flags
    """Whether the transmission angle at a position is certainly too small."""
    flat_at: tuple[Flags, Flags]
    """The same where the crank passes 0, and pi."""
    ranges: Ranges
    phi: Enclosure


def fails_on_slide(
    arms: Enclosure,
    a: Enclosure,
    e: Enclosure,
    phi: Enclosure,
    cranks: tuple[DyadCells, Integers],
    tests: PairTests,
    weight: Enclosure | float = 1.0,
) -> Flags:
    """Cells all of whose cranks certainly fail with a slider.

    Args:
        arms: (cells, positions) from the slider's pin to that of the crank, along the slide and across.
        a: the lengths of the cranks.
        e: how far the line of the slide lies from the crank's pivot.
        phi: (cells, positions) the crank angles, counted from the normal of the slide.
        cranks: the cells of the cranks, and which of them.
        tests: the demands.
        weight: above zero, times which all lengths are taken.
    """
    least, b = cos(tests.demands.transmission), _first(arms).modulus
    to_zero, to_pi = b - a + e, b - a - e
    motion = _SlideMotion(
        along=arms.real,
        flat=off(arms.imaginary, least * b.column),
        flat_at=(off(a - e, least * b), off(a + e, least * b)),
        ranges=Ranges(
            pi_free=to_pi.low > 0,
            pi_shut=to_pi.high <= 0,
            zero_free=to_zero.low > 0,
            zero_shut=to_zero.high <= 0,
        ),
        phi=phi,
    )
    return _moves_not(motion, {"crank": a, "coupler": b}, cranks, tests, weight)


def _moves_not(
    motion: _SlideMotion,
    links: dict[str, Enclosure],
    cranks: tuple[DyadCells, Integers],
    tests: PairTests,
    weight: Enclosure | float = 1.0,
) -> Flags:
    """Whether lengths are others than demanded, or no way leads through the positions as is demanded."""
    demands, ranges, (cells, rows) = tests.demands, motion.ranges, cranks
    fails = np.zeros(len(rows), bool)
    for link, length in tests.lengths:
        fails |= is_other(links[link], weight, length)
    if demands.crank:
        fails |= ranges.pi_shut | ranges.zero_shut
        if tests.ordered:
            fails |= cells.keeps_no_order[rows]
    flat_at = motion.flat_at
    if demands.transmission:
        fails |= motion.flat.any(axis=1)
    else:
        flat_at = np.zeros(len(rows), bool), np.zeros(len(rows), bool)
    if demands.one_branch or demands.transmission:
        fails |= (motion.along.low > 0).any(axis=1) & (motion.along.high < 0).any(axis=1)
    if not demands.one_branch:
        return fails
    return np.asarray(fails | no_way(motion.phi, cells, rows, ranges, flat_at, tests.order))


def _slack(measured: Enclosure) -> Enclosure:
    return measured.widened(_SLACK * (1 + np.abs(measured.value)))


def _first(row: Enclosure) -> Enclosure:
    return Enclosure(row.value[:, 0], tuple(slope[:, 0] for slope in row.slopes), row.rest[:, 0])


def slide_notes(
    task: PositionTask, demands: Demands, dyads: Sequence[GuidingDyad], best: float | None, form: str
) -> Iterator[Message]:
    """What is proved of cranks with these sliding dyads of one kind; see `family_bounds.bound_notes`. Cost: 0.1 s."""
    symbols = form_symbols(form)
    if best is None and not any(left_of_cranks(task, demands, dyad) for dyad in dyads):
        yield _NONE.filled(form=symbols, far=FAR)
        return
    begin = degrees(demands.transmission if best is None else best)
    for margin in MARGINS:
        angle = ceil(10 * (begin + margin)) / 10
        if best is not None and angle >= 90:
            yield nearly_right(symbols, best, radians(margin))
            return
        if angle >= 90:
            break
        bound = replace(demands, transmission=radians(angle))
        if not any(left_of_cranks(task, bound, dyad) for dyad in dyads):
            yield beside_best(_AT_MOST.filled(form=symbols, far=FAR, angle=angle), best)
            return
    yield _UNKNOWN.filled(form=symbols) if best is None else _UNBOUNDED.filled(form=symbols, best=degrees(best))


def improved_pair(task: PositionTask, demands: Demands, pairs: Sequence[Pair]) -> tuple[Pair | None, list[Message]]:
    """A better linkage than the best of pairs of two or three positions, and what is proved beside its dyads.

    One of its dyads is held while the whole family of the other is searched, then the other way round. Where no pair
    meets the demands, the cranks of the first ones are held in turn. Cost: 1 s each time.
    """
    best, pair = max(((angle_of_pair(task, demands, pair), pair) for pair in pairs), key=lambda row: row[0])
    form, margin = form_symbols(f"{CRANK.form}-{pair[1].kind.form}"), MARGIN[len(task)]
    if best + margin >= pi / 2:
        return None, [nearly_right(form, best, margin)]
    if best == -np.inf:
        return _first_found(task, demands, pairs)
    improved, proved = None, [False, pair[1].slides]
    for turn in range(_TURNS):
        side = 1 if pair[1].slides else turn % 2
        proved[1 - side] |= pair[1].slides
        partner = PartnerSearch(task, demands, pair[side], driven=side == 0).partner(best, margin)
        if partner.dyad is not None and partner.angle > best + margin:
            improved = (pair[0], partner.dyad) if side == 0 else (partner.dyad, pair[1])
            pair, proved[1 - side] = improved, pair[1].slides
        best = max(best, partner.angle)  # a gain within the margin is no reason to begin anew
        proved[side] = not partner.left
        if all(proved):
            if best + margin >= pi / 2:  # no angle is larger, or the margin has become too wide to say so
                close = best + MARGIN[len(task)] >= pi / 2
                said = nearly_right(form, best, MARGIN[len(task)]) if close else _beside_unknown(form, best)
                return improved, [said]
            note = _BESIDE_SLIDE if pair[1].slides else _BESIDE
            return improved, [beside_best(note.filled(form=form, far=FAR, angle=_upward(best + margin)), best)]
        if partner.left and partner.dyad is None:
            margin *= _WIDER
    return improved, [_beside_unknown(form, best)]


def improved_pairs(
    task: PositionTask, demands: Demands, pairs: Sequence[Pair], *, turning_first: bool
) -> tuple[list[Pair], list[Message]]:
    """As `improved_pair`; first among those whose crank turns fully, if designs are sorted by that and some do."""
    better: list[Pair] = []
    notes: list[Message] = []
    turning = replace(demands, crank=True)
    if turning_first and not demands.crank and any(angle_of_pair(task, turning, pair) > -np.inf for pair in pairs):
        improved, said = improved_pair(task, turning, pairs)
        better += [improved] if improved else []
        notes += of_turning(said)
    improved, said = improved_pair(task, demands, [*better, *pairs])
    return better + ([improved] if improved else []), [*notes, *said]


def of_turning(notes: Iterable[Message]) -> list[Message]:
    """What is said of linkages whose crank turns fully."""
    return [_TURNING.filled(said=note) for note in notes]


def _beside_unknown(form: SymbolText, best: float) -> Message:
    return _BESIDE_UNKNOWN.filled(form=form, best=degrees(best), most=90 - degrees(best))


def best_beside(
    task: PositionTask, demands: Demands, held: GuidingDyad, pairs: Sequence[Pair], *, drives: bool = False
) -> tuple[list[Pair], list[Message]]:
    """Four-bars with a dyad of three or four positions, better than pairs with it, and what is proved of all others.

    The dyad drives or is driven, or it only drives. Cost: 1 to 4 s.
    """
    said = _GIVEN_CRANK if drives else _GIVEN_PIVOT
    begin = max((angle_of_pair(task, demands, pair) for pair in pairs), default=-np.inf)
    known, left = begin > -np.inf, 0.0
    better: list[Pair] = []
    margin = MARGIN[len(task)] if known else 0.0
    begin = max(begin, demands.transmission)
    for driven in (True,) if drives else (True, False):
        partner = PartnerSearch(task, demands, held, driven=driven).partner(begin, margin)
        left += partner.left
        begin = max(begin, partner.angle)
        if partner.dyad is not None:
            better.insert(0, (held, partner.dyad) if driven else (partner.dyad, held))
    if better and not known:
        others, notes = best_beside(task, demands, held, better, drives=drives)
        return others + better, notes
    if left:
        return better, [_GIVEN_UNKNOWN[known].filled(held=said)]
    if not known:
        return [], [_NONE_BESIDE.filled(held=said, far=FAR)]
    if begin + margin >= pi / 2:
        return better, [nearly_right(form_symbols(_FOUR_BAR), begin, margin)]
    return better, [beside_best(_MOST_BESIDE.filled(held=said, far=FAR, angle=_upward(begin + margin)), begin)]


def best_beside_ends(
    task: PositionTask, demands: Demands, given: Sequence[GuidingDyad], pairs: Sequence[Pair]
) -> tuple[list[Pair], list[Message]]:
    """Four-bars of two positions with one of dyads that share a pivot, better than pairs with such a dyad.

    The other dyad is sought beside a given one, then the other end of this one is improved, and so on. Cost: 1 to 6 s.
    """

    def angle(pair: Pair) -> float:
        return angle_of_pair(task, demands, pair)

    better: list[Pair] = []
    for begun in sorted(pairs, key=angle, reverse=True)[:_CRANKS]:
        pair = begun
        for _ in range(_TURNS):
            side = min((0, 1), key=lambda k: min(_apart(pair[k], dyad) for dyad in given))
            begin = max(demands.transmission, angle(pair))
            if begin + MARGIN[2] >= pi / 2:
                break
            partner = PartnerSearch(task, demands, pair[side], driven=side == 0).partner(begin, MARGIN[2])
            if partner.dyad is None:
                break
            group = (given, [partner.dyad]) if side == 0 else ([partner.dyad], given)
            ended = best_members(task, [group], demands, orders=["transmission"], number=1).pairs
            beside = (pair[0], partner.dyad) if side == 0 else (partner.dyad, pair[1])
            pair = max([beside, *ended], key=angle)
            better.insert(0, pair)
        if angle(pair) > -np.inf:
            break
    known = max(map(angle, [*better, *pairs]), default=-np.inf) > -np.inf
    return better, [_GIVEN_UNKNOWN[known].filled(held=_GIVEN_PIVOT)]


def _apart(first: GuidingDyad, second: GuidingDyad) -> float:
    """How far the pivots lie apart that two dyads have nearest to each other."""
    return min(abs(first.moving - second.moving), abs(first.fixed - second.fixed))


def _first_found(task: PositionTask, demands: Demands, pairs: Sequence[Pair]) -> tuple[Pair | None, list[Message]]:
    """A pair that meets the demands beside the cranks, or the slides, of these, which do not, or that there is none."""
    slides = pairs[0][1].slides
    form = form_symbols(f"{CRANK.form}-{pairs[0][1].kind.form}")
    held = list(dict.fromkeys(pair[slides] for pair in pairs))[:_CRANKS]
    for dyad in held:
        partner = PartnerSearch(task, demands, dyad, driven=not slides).partner(demands.transmission, 0.0)
        if partner.dyad is not None:
            pair = (partner.dyad, dyad) if slides else (dyad, partner.dyad)
            improved, notes = improved_pair(task, demands, [pair])
            return improved or pair, notes
        if partner.left:
            return None, [_UNKNOWN.filled(form=form)]
    return None, [_BESIDE_NONE[slides].filled(count=len(held), form=form, far=FAR)]


def angle_of_pair(task: PositionTask, demands: Demands, pair: Pair) -> float:
    """The transmission angle of a pair that meets the demands, minus infinity of others."""
    facts = pair_facts(task, pair[:1], pair[1:], demands)
    good = all(flags[0, 0] for _, flags in facts.met(demands)) and facts.branch[0, 0]
    return float(facts.transmission[0, 0]) if good else -np.inf


def _upward(angle: float) -> float:
    """In degrees, to a tenth."""
    return ceil(10 * degrees(angle)) / 10
