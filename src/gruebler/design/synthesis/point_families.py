"""Linkages through two to eight points: the best of some, made better within their family by what is asked for.

Points leave families of one to seven parameters. docs/theory/synthesis-points.md, "The best of a family".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import (
    Demands,
    distance_of_pivots,
    inside_region,
    sought_order,
)
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, DyadKind, GuidingDyad
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.length_search import (
    FINEST_STEP,
    ConditionedRows,
    has_lengths,
    improved_rows,
    pivots_of_rows,
)
from gruebler.design.synthesis.pair_facts import KNOWN, PairFacts, facts_of_pins
from gruebler.design.synthesis.pair_shifts import point_shifts
from gruebler.design.synthesis.results import Design, in_order_of, resolution
from gruebler.design.synthesis.targets import point_targets
from gruebler.design.synthesis.tasks import SAME, PathTask
from gruebler.mechanics.linkages import Linkage

_IMPROVED = 6  # designs
ALIKE = 0.05
"""Sizes: of linkages whose pivots differ by less in sum one is listed."""
_CRANK = (("crank", "coupler"), ("frame", "crank"))
_PINS = {
    CRANK: (*_CRANK, ("rocker", "coupler"), ("frame", "rocker")),
    SLIDER: (*_CRANK, ("slider", "coupler")),
    BLOCK: (*_CRANK, ("frame", "block")),
}
"""Between which links the pivots of a row lie."""
_NAMES = {CRANK: "four-bar", SLIDER: "slider-crank", BLOCK: "inverted-slider-crank"}
IN_STEPS = message(
    "The best linkages by {measure} are improved within the family in steps down to {step:.1g} sizes of the task; "
    "that no other is better is not proved."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PointFamily(ConditionedRows):
    """Linkages of a crank and another dyad whose coupler point passes through points.

    Rows are linkages in sizes of the task about its first point: both pivots of the crank, on the coupler first, those
    of the other dyad, or the one of a slide and the angle of its line, and by how much the crank has turned from the
    first point to each of the others.
    """

    task: PathTask

    @property
    def size(self) -> float:
        """Of the task."""
        return self.task.size

    @property
    def own(self) -> int:
        """How many numbers of a row tell the linkage; behind them stand the turns of the crank."""
        return 2 * self.points + self.kind.slides

    @property
    def places(self) -> Complexes:
        """(points,) of the coupler point, in sizes about the first one."""
        return np.asarray((self.task.z - self.task.z[0]) / self.size)

    def conditions(self, rows: Reals) -> tuple[Reals, Reals]:
        """At every point the coupler point is where it should be, and the other dyad guides the coupler."""
        pin, pivot, *other = pivots_of_rows(rows, self.points).T
        places, own = self.places[1:], self.own
        values, slopes = (
            np.zeros((len(rows), 2 * len(places))),
            np.zeros((len(rows), 2 * len(places), rows.shape[1])),
        )
        for k, place in enumerate(places):
            turn = np.exp(1j * rows[:, own + k])
            moved, by_turn = pivot + (pin - pivot) * turn, 1j * (pin - pivot) * turn
            reach, first = place - moved, -pin
            # The turn of the coupler is turned = reach / first; its changes by pin, pivot and the crank's turn:
            turned = reach / first
            by_pin, by_pivot, turned_by = -turn / first + reach / first**2, (turn - 1) / first, -by_turn / first
            of_point = [(0, reach, -turn), (1, reach, turn - 1), (0, first, 1.0)]
            values[:, 2 * k] = np.abs(reach) ** 2 - np.abs(first) ** 2
            _add_squares(slopes[:, 2 * k], of_point)
            slopes[:, 2 * k, own + k] = -2 * np.real(np.conj(reach) * by_turn)
            row = slopes[:, 2 * k + 1]
            if self.kind == BLOCK:
                (far,) = other
                along, arm = np.exp(-1j * rows[:, own - 1]), far - moved
                seen = along * (np.conj(turned) * arm - (far - pin))
                _add_across(row, [(0, along * (1 - np.conj(turned) * turn)), (1, along * np.conj(turned) * (turn - 1))])
                _add_across(row, [(2, along * (np.conj(turned) - 1))])
                _add_across(row, [(n, along * arm * np.conj(by)) for n, by in ((0, by_pin), (1, by_pivot))], sign=-1)
                row[:, own + k] = np.imag(along * (np.conj(turned_by) * arm - np.conj(turned) * by_turn))
            else:
                arm = other[0] - pin
                gap = moved + arm * turned
                by = turn - turned + arm * by_pin, 1 - turn + arm * by_pivot, by_turn + arm * turned_by
                if self.kind == CRANK:
                    gap, ends = gap - other[1], other[0] - other[1]
                    values[:, 2 * k + 1] = np.abs(gap) ** 2 - np.abs(ends) ** 2
                    _add_squares(row, [(0, gap, by[0]), (1, gap, by[1]), (2, gap, turned), (3, gap, -1.0)])
                    _add_squares(row, [(2, ends, -1.0), (3, ends, 1.0)])
                    row[:, own + k] = 2 * np.real(np.conj(gap) * by[2])
                    continue
                along = np.exp(-1j * rows[:, own - 1])
                seen = along * (gap - other[0])
                _add_across(row, [(0, along * by[0]), (1, along * by[1]), (2, along * (turned - 1))])
                row[:, own + k] = np.imag(along * by[2])
            values[:, 2 * k + 1] = seen.imag
            row[:, own - 1] = -seen.real
        return values, slopes

    def facts(self, rows: Reals, demands: Demands) -> PairFacts:
        """(rows, 1) what these linkages do."""
        z, size = self.task.z, self.size
        pin, pivot, *other = z[0] + size * pivots_of_rows(rows, self.points).T
        turns = np.exp(1j * np.concatenate([np.zeros((len(rows), 1)), rows[:, self.own :]], axis=1))
        pins = pivot[:, None] + (pin - pivot)[:, None] * turns
        with np.errstate(divide="ignore", invalid="ignore"):
            turned = (z - pins) / (z[0] - pin)[:, None]
        far_pins, far = pins + (other[0] - pin)[:, None] * turned, other[-1][:, None]
        slides = np.zeros((len(rows), 1, len(z)), np.complex128)
        if self.kind.slides:
            slides[:, 0] = np.exp(1j * rows[:, self.own - 1, None]) * (1 if self.kind == SLIDER else turned)
        pivots = [pivot[:, None], *([] if self.kind == SLIDER else [far])]
        inside = np.logical_and.reduce([inside_region(each, demands) for each in pivots])
        return facts_of_pins(
            (pins[:, None], pivots[0]),
            (far_pins[:, None], far),
            slides,
            self.kind,
            inside=inside,
            size=size if self.kind.slides else np.inf,
            order=sought_order(self.task, demands),
            shifts=partial(point_shifts, point=z, size=size),
            pivot_distance=distance_of_pivots(pivots, demands),
        )

    def dyads(self, row: Reals) -> tuple[GuidingDyad, GuidingDyad]:
        """The crank and the other dyad of a row, in the unit of the task."""
        pin, pivot, *other = map(complex, self.task.z[0] + self.size * pivots_of_rows(row, self.points))
        direction = complex(np.exp(1j * row[self.own - 1])) if self.kind.slides else 0j
        return GuidingDyad(CRANK, pin, pivot), GuidingDyad(self.kind, other[0], other[-1], direction)

    def row(self, design: Design) -> Reals:
        """That of a linkage of this kind whose pose is that of the first point."""
        places: dict[frozenset[str], complex] = {}
        direction = 0.0
        on_line = {SLIDER: "frame", BLOCK: "coupler"}.get(self.kind)
        for (joint, link), element in design.linkage.elements.items():
            links = frozenset(design.linkage.mechanism.chain.joints[joint].links)
            pose = design.linkage.required_pose[link]
            if element.is_line and link == on_line:
                direction = pose.angle + element.direction
            elif element.is_pin:
                places[links] = complex(*pose.put(element.x, element.y))
        pivots = np.array([places[frozenset(links)] for links in _PINS[self.kind]])
        seen = ((pivots - self.task.z[0]) / self.task.size).view(np.float64)
        drives = np.array(design.drives)[:: 1 if len(design.drives) == len(self.task) else len(design.drives) - 1]
        return np.concatenate([seen, [direction] * self.kind.slides, drives[1:] - drives[0]])


def _add_squares(row: Reals, terms: Sequence[tuple[int, Complexes, Complexes | float]]) -> None:
    """Add the changes of squares of vectors by pivots, each (pivot, vector, change of the vector)."""
    for pivot, vector, factor in terms:
        part = 2 * np.conj(vector) * factor
        row[:, 2 * pivot] += part.real
        row[:, 2 * pivot + 1] -= part.imag


def _add_across(row: Reals, terms: Sequence[tuple[int, Complexes]], sign: int = 1) -> None:
    """Add the changes of imaginary parts by pivots, each (pivot, change), or by their conjugates."""
    for pivot, factor in terms:
        row[:, 2 * pivot] += factor.imag
        row[:, 2 * pivot + 1] += sign * factor.real


def improved_designs(
    task: PathTask, demands: Demands, designs: Sequence[Design], orders: Sequence[str], *, slides: bool = False
) -> tuple[list[Design], list[Message]]:
    """Linkages better than the best of some by what is asked for, and in which steps they were sought. Cost: 0.3 s.

    Args:
        task: two to eight points, perhaps with fixed pivots.
        demands: what counts first; given lengths are kept.
        designs: some of the family; those that are accepted, or reach all points.
        orders: by what the best is sought, the most important first.
        slides: whether linkages with a slide are sought, too, not four-bars alone.
    """
    known = [name for name in orders if name in KNOWN]
    reach = [each for each in designs if each.drives and each.targets is not None]
    better: list[Design] = []
    begun = False
    for kind in (CRANK, SLIDER, BLOCK)[: 3 if slides else 1]:
        some = [each for each in reach if _is_of_kind(each.linkage, kind)] if has_lengths(kind, demands) else []
        some = list(in_order_of([each for each in some if each.verdict.accepted] or some, orders))[:_IMPROVED]
        if known and some:
            begun = True
            better += _improved(task, demands, some, known, kind)
    return better, resolution(orders, FINEST_STEP, IN_STEPS) if begun else []


def _improved(
    task: PathTask, demands: Demands, designs: Sequence[Design], orders: Sequence[str], kind: DyadKind
) -> list[Design]:
    """Accepted linkages beside some of a kind, better by what is asked for."""
    family = PointFamily(task=task, kind=kind, lengths=demands.lengths, frame_direction=demands.frame_direction)
    rows = np.array([family.row(each) for each in designs])
    held = np.zeros(rows.shape, bool)
    on_frame = [k for k, links in enumerate(_PINS[kind]) if "frame" in links]
    for place in task.fixed_pivots:
        at = (complex(*place) - task.z[0]) / task.size
        given = np.abs(pivots_of_rows(rows, family.points)[:, on_frame] - at) < SAME
        for k, own in zip(on_frame, given.T, strict=True):
            held[:, 2 * k : 2 * k + 2] |= own[:, None]
    better, _ = improved_rows(family, rows, held, demands, orders)
    apart = rows_apart(better[:, : family.own], len(better))
    return through_points(task, demands, map(family.dyads, apart), designs)


def rows_apart(rows: Reals, number: int, *, gap: float = ALIKE) -> list[Reals]:
    """The first linkages, so many at most, each of which differs from those before it by more than a gap in sum."""
    chosen: list[Reals] = []
    for row in rows:
        if len(chosen) == number:
            break
        if all(np.abs(row - other).sum() > gap for other in chosen):
            chosen.append(row)
    return chosen


def through_points(
    task: PathTask, demands: Demands, pairs: Iterable[tuple[GuidingDyad, GuidingDyad]], like: Sequence[Design]
) -> list[Design]:
    """Cranks with other dyads as designs, those that are accepted; their forms are named as those of others."""
    named = any(each.form == _NAMES[CRANK] for each in like) or any(each.form == _NAMES[SLIDER] for each in like)
    targets = replace(point_targets("P", task.z, task.size), ranks=task.order)
    designed: list[Design] = []
    for own, other in pairs:
        try:
            linkage = linkage_of_dyads(own, other, complex(task.z[0]), task.unit)
        except LinkageError:
            continue
        form = _NAMES[other.kind] if named else f"{own.kind.form}-{other.kind.form}"
        designed.append(judge_design(linkage, targets, demands, form))
    return [each for each in designed if each.verdict.accepted]


def _is_of_kind(linkage: Linkage, kind: DyadKind) -> bool:
    """Whether a linkage has a crank and another dyad of this kind, and no other links."""
    pins = sum(element.is_pin for element in linkage.elements.values())
    own = {"crank", "coupler", kind.sides[kind == CRANK]}
    return own == {*linkage.mechanism.chain.links} - {linkage.mechanism.frame} and pins == (6 if kind.slides else 8)
