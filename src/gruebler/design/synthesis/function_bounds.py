"""Proofs for families of functions: that no linkage of two to four pairs with free starts does better.

As seen from the crank the output link takes known positions; the frame is one dyad of them, the coupler any other one.
So what is proved beside a dyad that is held is proved of the whole family. docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from math import ceil, degrees, pi

import numpy as np

from gruebler.base.arrays import Complexes, Flags
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.coordination import pair_arrays
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_cells import FAR, DyadCells, DyadCurve, OneDyad
from gruebler.design.synthesis.dyad_planes import crank_family
from gruebler.design.synthesis.dyads import CRANK, Displacements, GuidingDyad
from gruebler.design.synthesis.family_bounds import PairTests, WayOrder, beside_best
from gruebler.design.synthesis.pair_facts import PairFacts
from gruebler.design.synthesis.partner_bounds import BUDGET, MARGIN, Tried, branch_and_bound, fails_on_slide
from gruebler.design.synthesis.tasks import FunctionTask, PositionTask

FactsOf = Callable[[Complexes, Complexes], PairFacts]
"""What linkages do by the places of the moving pivots in the first position: of the output, and of the crank."""

_NONE = message(
    "Proved: no {kind} of the family meets all demands with its moving pivots within {far:.3g} of the crank's pivot."
)
_AT_MOST = message(
    "Proved: no {kind} of the family that meets all demands has a transmission angle above {angle:.1f}° with its "
    "moving pivots within {far:.3g} of the crank's pivot."
)
_NEARLY_RIGHT = message(
    "The largest transmission angle of a {kind} of the family that was found, {best:.1f}°, is a right angle to "
    "{margin:g}°: none can be larger by more."
)
_NOT_DECIDED = message(
    "Not decided: whether a {kind} of the family has a larger transmission angle. It was sought on a grid of {starts} "
    "starts, the best ones improved; parts of the family narrower than the grid may be missed."
)
_KINDS = {"angle": message("four-bar"), "travel": message("slider-crank")}
_LINKS = {"crank": "frame", "coupler": "rocker", "rocker": "coupler", "frame": "crank"}
"""What the links of a four-bar are, as seen from its crank."""


def seen_from_crank(task: FunctionTask) -> PositionTask:
    """The positions of the output link as seen from the crank, in its first position; frame 0 and 1, or the travel."""
    phi, output = pair_arrays(task)
    turned, moved = np.exp(-1j * (phi - phi[0])), output - output[0]
    if task.output == "angle":
        q, t = turned * np.exp(1j * moved), turned * (1 - np.exp(1j * moved))
    else:
        q, t = turned, turned * moved
    return PositionTask(tuple((z.real, z.imag, a) for z, a in zip(t, np.angle(q), strict=True)))


class FunctionSearch:
    """Branch and bound over the couplers of a family."""

    def __init__(self, task: FunctionTask, demands: Demands, facts_of: FactsOf) -> None:
        self.seen = seen_from_crank(task)
        self.given, self.origin, self.size = Displacements.of(self.seen.origins, self.seen.turns)
        lengths = tuple((_LINKS.get(link, link), length) for link, length in demands.lengths)
        own = lengths if task.output == "travel" else ()  # one length of angles is the scale
        self.demands, self.facts_of = replace(demands, lengths=own), facts_of
        self.turned = np.conj(self.given.with_first[0])
        self.moved = (np.array(task.outputs) - task.outputs[0]) / self.size if task.output == "travel" else None
        try:
            self.family = crank_family(self.given)
        except SynthesisError:  # no point of the curve is known
            self.family = None

    @cached_property
    def held(self) -> DyadCells:
        """Of four-bars the frame, as seen from the crank; of slider-cranks the crank, as seen from the frame."""
        assert self.family is not None
        held = OneDyad(self.family, GuidingDyad(CRANK, 1 / self.size + 0j, 0j))
        if self.moved is not None:
            held.given = Displacements(self.turned[1:], np.zeros(len(self.turned) - 1, np.complex128))
        return DyadCells(held, held.first_cells())

    def tried(self, seen: DyadCells) -> Tried:
        """The linkages in the middle of cells."""
        moving, fixed = (
            np.asarray(part.value * self.size + self.origin, np.complex128) for part in (seen.moving, seen.fixed)
        )
        facts = self.facts_of(moving, fixed)
        good = (np.logical_and.reduce([flags for _, flags in facts.met(self.demands)]) & facts.branch)[:, 0]
        return Tried(np.where(good, facts.transmission[:, 0], -np.inf), moving, fixed)

    def possible(self, seen: DyadCells, angle: float) -> Flags:
        """Cells that may have a linkage with such a transmission angle."""
        wanted = replace(self.demands, transmission=angle)
        tests = PairTests(wanted, WayOrder.of(self.seen, wanted), self.origin, self.size)
        _, others = tests.kept(seen)
        rows, own = np.arange(len(seen.cells)), np.zeros(len(seen.cells), np.int64)
        if self.moved is None:
            return np.asarray(others & ~tests.fails(self.held, own, rows, seen))
        with np.errstate(invalid="ignore"):
            fails = self._slider_fails(seen, tests, 1) & ((seen.weight.low > 0) | self._slider_fails(seen, tests, -1))
        return np.asarray(others & ~fails)

    def _slider_fails(self, seen: DyadCells, tests: PairTests, sign: int) -> Flags:
        """Cells whose slider-cranks certainly fail, where the weight of the links has this sign; all times it."""
        assert self.moved is not None
        weight, arms = seen.weight * sign, seen.arms * sign
        output = weight * seen.moving
        pin = output - arms.at((slice(None), 0))
        phi = (pin.angle.column + np.angle(self.turned)) - pi / 2
        cranks = self.held, np.zeros(len(seen.cells), np.int64)
        lengths = pin.modulus, arms.at((slice(None), 0)).modulus
        shortest = np.minimum.reduce([*(length.high for length in lengths), (weight * np.ptp(self.moved)).high])
        slender = np.maximum(*(length.low for length in lengths)) > self.demands.size_ratio * shortest
        fails = fails_on_slide(arms * -self.turned, lengths[0], output.imaginary, phi, cranks, tests, weight)
        return np.asarray(slender | fails)

    def improved(self, begin: float) -> tuple[GuidingDyad | None, float | None, float]:
        """A coupler with a larger transmission angle, what none exceeds if that is proved, and the largest found."""
        known = begin > -np.inf
        margin = MARGIN[len(self.seen)] if known else 0.0
        begin = max(begin, self.demands.transmission)
        if begin + margin >= pi / 2:
            return None, pi / 2, begin
        if self.family is None or (isinstance(self.family, DyadCurve) and not self.family.fits):
            return None, None, begin
        budget = BUDGET[len(self.seen)]
        left, best, place = branch_and_bound(self.family, self.possible, self.tried, begin, margin, budget)
        dyad = None if place is None else GuidingDyad(CRANK, *place)
        if dyad is not None and not known:
            _, bound, best = self.improved(best)
            return dyad, bound, best
        return dyad, None if left else best + margin, best


def improved_couplers(
    task: FunctionTask, demands: Demands, facts_of: FactsOf, best: Sequence[GuidingDyad], sampled: int
) -> tuple[list[GuidingDyad], list[Message]]:
    """Couplers of two to four pairs better than the best of a sample, and what is proved of all of the family.

    Args:
        task: the pairs, with free starts.
        demands: what a linkage has to do.
        facts_of: what linkages do.
        best: couplers, as dyads between crank and output.
        sampled: so many starts were tried.

    Cost: 0.2 s for four pairs, else 1 to 3 s.
    """
    search = FunctionSearch(task, demands, facts_of)
    begin = -np.inf
    if best:
        facts = facts_of(*(np.array([getattr(dyad, name) for dyad in best]) for name in ("moving", "fixed")))
        good = np.logical_and.reduce([flags for _, flags in facts.met(search.demands)]) & facts.branch
        begin = float(np.where(good, facts.transmission, -np.inf).max())
    better, bound, largest = search.improved(begin)
    kind, known = _KINDS[task.output], better is not None or begin > -np.inf
    if bound is None:
        notes = [_NOT_DECIDED.filled(kind=kind, starts=sampled)]
    elif bound >= pi / 2:
        margin = degrees(MARGIN[len(task)])
        notes = [_NEARLY_RIGHT.filled(kind=kind, best=degrees(largest), margin=margin)] if known else []
    elif not known:
        notes = [_NONE.filled(kind=kind, far=FAR * search.size)]
    else:
        said = _AT_MOST.filled(kind=kind, far=FAR * search.size, angle=ceil(10 * degrees(bound)) / 10)
        notes = [beside_best(said, largest)]
    return ([] if better is None else [better]), notes
