"""Proofs for cranks with one sliding dyad of four positions: that no linkage of this family meets the demands.

Four positions have finitely many sliding dyads, so that the family has one parameter: the place of the crank on
Burmester's curve. docs/theory/synthesis-positions.md, "Proofs in the family of four positions".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import ceil, cos, degrees, radians

import numpy as np

from gruebler.base.arrays import Flags
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.dyad_cells import FAR, DyadCells, DyadCurve, halves, short_cells
from gruebler.design.synthesis.dyads import SLIDER, Displacements, GuidingDyad
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.family_bounds import MARGINS, NARROW, Ranges, no_way
from gruebler.design.synthesis.judging import Demands
from gruebler.design.synthesis.results import form_symbols
from gruebler.design.synthesis.tasks import PositionTask

_BUDGET = 20_000  # cells that are looked at
_SLACK = 1e-9  # of what is measured from the slide: far above the rounding of a dyad
_NONE = message(
    "Proved: no linkage {form} of this family with a crank within {far:g} sizes of the task meets all demands."
)
_AT_MOST = message(
    "Proved: no linkage {form} of this family with a crank within {far:g} sizes of the task meets all demands with a "
    "transmission angle above {angle:.1f}°."
)
_UNKNOWN = message("Not decided: whether a linkage {form} of this family meets all demands.")


def left_of_cranks(task: PositionTask, demands: Demands, dyad: GuidingDyad, budget: int = _BUDGET) -> float:
    """The part of all cranks, by the parameter of their curve, that is not excluded beside a slide; 0 is a proof.

    Ratios and sizes of lengths that are demanded are not asked: what is excluded is so without them. Cost: 0.1 s.
    """
    given, origin, size = Displacements.of(task.origins, task.turns)
    try:
        curve = DyadCurve(given)
    except SynthesisError:  # no point of it is known
        return 1.0
    if not curve.fits:
        return 1.0
    cells, singular = short_cells(curve)
    whole = len(curve.spans) * (1 if curve.cubic.closes else 2) * curve.end
    left = float(np.sum(singular[:, 3] - singular[:, 2])) if len(singular) else 0.0
    corner = np.array([origin.real, origin.imag, origin.real, origin.imag])
    region = None if demands.region is None else (np.array(demands.region) - corner) / size
    slide = dyad.moved(1 / size, -origin / size)
    looked = 0
    while len(cells):
        looked += len(cells)
        seen = DyadCells(curve, cells)
        stays = ~seen.far & ~_fails(seen, given, slide, demands)
        if region is not None:
            stays &= ~seen.outside(region)
        done = stays & ((seen.extent < NARROW) | (looked + 2 * np.count_nonzero(stays) > budget))
        left += float(np.sum(cells[done, 3] - cells[done, 2]))
        cells = halves(cells[stays & ~done])
    return left / whole


def _fails(seen: DyadCells, given: Displacements, slide: GuidingDyad, demands: Demands) -> Flags:
    """Cells all of whose cranks certainly fail with the slide."""
    q, t = np.append(1, given.q), np.append(0, given.t)
    pins = seen.moving.column * q + t
    a, least = seen.length, cos(demands.transmission)
    if slide.kind == SLIDER:
        # From B to A, along the slide and across; the crank angle is counted from the normal of the slide.
        arms = _slack((pins - given.images(slide.moving)) * np.conj(slide.direction))
        across = _slack((slide.moving - seen.fixed) * np.conj(slide.direction))
        b, e = _first(arms).modulus, across.imaginary
        flat = _beyond(arms.imaginary, least * b.column)
        at_zero, at_pi = _beyond(a - e, least * b), _beyond(a + e, least * b)
        to_zero, to_pi = b - a + e, b - a - e
        pi_free, pi_shut = to_pi.low > 0, to_pi.high <= 0
        phi = seen.angle - float(np.angle(1j * slide.direction))
    else:
        frame = slide.fixed - seen.fixed
        arms = _slack((slide.fixed - pins) * np.conj(slide.direction * q))
        d, e = frame.modulus, _first(arms).imaginary
        flat = _beyond(e.column, least * arms.modulus)
        at_zero, at_pi = _beyond(e, least * (a - d)) & _beyond(e, least * (d - a)), _beyond(e, least * (a + d))
        to_zero = (a - d) * (a - d) - e * e
        pi_free, pi_shut = np.ones(len(seen.cells), bool), np.zeros(len(seen.cells), bool)
        phi = seen.angle - frame.angle.column
    zero_free, zero_shut = to_zero.low > 0, to_zero.high <= 0
    along = arms.real
    fails: Flags = np.zeros(len(seen.cells), bool)
    if demands.crank:
        fails |= pi_shut | zero_shut
        if demands.one_branch and demands.in_order:
            fails |= seen.keeps_no_order
    if demands.transmission:
        fails |= flat.any(axis=1)
    else:
        at_zero, at_pi = np.zeros((2, len(seen.cells)), bool)
    if demands.one_branch or demands.transmission:
        fails |= (along.low > 0).any(axis=1) & (along.high < 0).any(axis=1)
    if not demands.one_branch:
        return fails
    ranges = Ranges(pi_free=pi_free, pi_shut=pi_shut, zero_free=zero_free, zero_shut=zero_shut)
    closed = no_way(phi, seen, np.arange(len(seen.cells)), ranges, (at_zero, at_pi), demands)
    return np.asarray(fails | closed)


def _slack(measured: Enclosure) -> Enclosure:
    return measured.widened(_SLACK * (1 + np.abs(measured.value)))


def _first(row: Enclosure) -> Enclosure:
    return Enclosure(row.value[:, 0], tuple(slope[:, 0] for slope in row.slopes), row.rest[:, 0])


def _beyond(value: Enclosure, most: Enclosure) -> Flags:
    """Whether it is certainly larger in size than something that is positive, or than both where it may be negative."""
    return np.asarray(((value - most).low > 0) | ((value + most).high < 0))


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
        if angle >= 90:
            break
        bound = replace(demands, transmission=radians(angle))
        if not any(left_of_cranks(task, bound, dyad) for dyad in dyads):
            yield _AT_MOST.filled(form=symbols, far=FAR, angle=angle)
            return
    if best is None:
        yield _UNKNOWN.filled(form=symbols)
