"""Four-bars through two to eight points: the best of some, made better within their family by what is asked for.

Points leave families of one to seven parameters. docs/theory/synthesis-points.md, "The best of a family".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import (
    Demands,
    distance_of_pivots,
    inside_region,
    sought_order,
)
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.length_search import (
    FINEST_STEP,
    ConditionedRows,
    improved_rows,
)
from gruebler.design.synthesis.pair_facts import KNOWN, PairFacts, facts_of_pins
from gruebler.design.synthesis.pair_shifts import point_shifts
from gruebler.design.synthesis.results import Design, in_order_of, resolution
from gruebler.design.synthesis.targets import point_targets
from gruebler.design.synthesis.tasks import SAME, PathTask
from gruebler.mechanics.linkages import Linkage

_IMPROVED = 6  # designs
_ALIKE = 0.05  # sizes: of linkages whose pivots differ by less in sum one is listed
_STEPS = message(
    "The best four-bars by {measure} are improved within the family in steps down to {step:.1g} sizes of the task; "
    "that no other is better is not proved."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PointFamily(ConditionedRows):
    """Four-bars whose coupler point passes through points.

    Rows are linkages in sizes of the task about its first point: both pivots of the crank, on the coupler first, those
    of the rocker, and by how much the crank has turned from the first point to each of the others.
    """

    task: PathTask

    @property
    def size(self) -> float:
        """Of the task."""
        return self.task.size

    def conditions(self, rows: Reals) -> tuple[Reals, Reals]:
        """The pin of the crank, and that of the rocker, keep their distances at every point."""
        pin, pivot, far_pin, far = np.ascontiguousarray(rows[:, :8]).view(np.complex128).T
        places = (self.task.z[1:] - self.task.z[0]) / self.task.size
        values, slopes = (
            np.zeros((len(rows), 2 * len(places))),
            np.zeros((len(rows), 2 * len(places), rows.shape[1])),
        )
        first, arm = -pin, far_pin - pin
        for k, place in enumerate(places):
            turn = np.exp(1j * rows[:, 8 + k])
            moved = pivot + (pin - pivot) * turn
            by_angle = 1j * (pin - pivot) * turn
            reach = place - moved
            turned = reach / first
            # The change of turned is (-d moved first + reach d pin) / first².
            gap = moved + arm * turned - far
            own = turn, 1 - turn
            by_pin = own[0] * (1 - arm / first) + arm * reach / first**2 - turned
            by_pivot = own[1] * (1 - arm / first)
            values[:, 2 * k] = np.abs(reach) ** 2 - np.abs(first) ** 2
            values[:, 2 * k + 1] = np.abs(gap) ** 2 - np.abs(far_pin - far) ** 2
            ends = far_pin - far
            of_crank = [(0, reach, -own[0]), (1, reach, -own[1]), (0, first, 1.0)]
            of_rocker = [(0, gap, by_pin), (1, gap, by_pivot), (2, gap, turned), (3, gap, -1.0)]
            of_rocker += [(2, ends, -1.0), (3, ends, 1.0)]
            for row, terms in ((2 * k, of_crank), (2 * k + 1, of_rocker)):
                for place_of, vector, factor in terms:
                    part = 2 * np.conj(vector) * factor
                    slopes[:, row, 2 * place_of] += part.real
                    slopes[:, row, 2 * place_of + 1] -= part.imag
            slopes[:, 2 * k, 8 + k] = -2 * np.real(np.conj(reach) * by_angle)
            slopes[:, 2 * k + 1, 8 + k] = 2 * np.real(np.conj(gap) * by_angle * (1 - arm / first))
        return values, slopes

    def facts(self, rows: Reals, demands: Demands) -> PairFacts:
        """(rows, 1) what these linkages do."""
        z, size = self.task.z, self.task.size
        pin, pivot, far_pin, far = (
            z[0] + size * part for part in np.ascontiguousarray(rows[:, :8]).view(np.complex128).T
        )
        turns = np.exp(1j * np.concatenate([np.zeros((len(rows), 1)), rows[:, 8:]], axis=1))
        pins = pivot[:, None] + (pin - pivot)[:, None] * turns
        with np.errstate(divide="ignore", invalid="ignore"):
            turned = (z - pins) / (z[0] - pin)[:, None]
        far_pins = pins + (far_pin - pin)[:, None] * turned
        pivots = [pivot[:, None], far[:, None]]
        inside = np.logical_and.reduce([inside_region(each, demands) for each in pivots])
        return facts_of_pins(
            (pins[:, None], pivots[0]),
            (far_pins[:, None], pivots[1]),
            np.zeros((len(rows), 1, len(z)), np.complex128),
            CRANK,
            inside=inside,
            size=size,
            order=sought_order(self.task, demands),
            shifts=partial(point_shifts, point=z, size=size),
            pivot_distance=distance_of_pivots(pivots, demands),
        )

    def row(self, design: Design) -> Reals:
        """That of a four-bar whose pose is that of the first point."""
        places: dict[frozenset[str], complex] = {}
        for (joint, link), element in design.linkage.elements.items():
            links = frozenset(design.linkage.mechanism.chain.joints[joint].links)
            places[links] = complex(*design.linkage.required_pose[link].put(element.x, element.y))
        ends = (("crank", "coupler"), ("frame", "crank"), ("rocker", "coupler"), ("frame", "rocker"))
        pivots = np.array([places[frozenset(links)] for links in ends])
        seen = ((pivots - self.task.z[0]) / self.task.size).view(np.float64)
        drives = np.array(design.drives)[:: 1 if len(design.drives) == len(self.task) else len(design.drives) - 1]
        return np.concatenate([seen, drives[1:] - drives[0]])


def improved_designs(
    task: PathTask, demands: Demands, designs: Sequence[Design], orders: Sequence[str]
) -> tuple[list[Design], list[Message]]:
    """Four-bars better than the best of some by what is asked for, and in which steps they were sought. Cost: 0.3 s.

    Args:
        task: two to eight points, perhaps with fixed pivots.
        demands: what counts first; given lengths are kept.
        designs: some of the family; those that are accepted, or reach all points.
        orders: by what the best is sought, the most important first.
    """
    known = [name for name in orders if name in KNOWN]
    reach = [each for each in designs if each.drives and each.targets is not None and _is_four_bar(each.linkage)]
    begun = in_order_of([each for each in reach if each.verdict.accepted] or reach, orders)[:_IMPROVED]
    if not known or not begun:
        return [], []
    family = PointFamily(task=task, lengths=demands.lengths, frame_direction=demands.frame_direction)
    rows = np.array([family.row(each) for each in begun])
    held = np.zeros(rows.shape, bool)
    for place in task.fixed_pivots:
        at = (complex(*place) - task.z[0]) / task.size
        given = np.abs(rows[:, :8].view(np.complex128)[:, 1::2] - at) < SAME
        held[:, 2:8:4] |= given
        held[:, 3:8:4] |= given
    better, _ = improved_rows(family, rows, held, demands, known)
    designed: list[Design] = []
    assert begun[0].targets is not None
    targets = replace(point_targets("P", task.z, begun[0].targets.size), ranks=task.order)
    for k, row in enumerate(better):
        if any(np.abs(row[:8] - other[:8]).sum() < _ALIKE for other in better[:k]):
            continue
        pin, pivot, far_pin, far = map(complex, task.z[0] + task.size * row[:8].view(np.complex128))
        try:
            linkage = linkage_of_dyads(
                GuidingDyad(CRANK, pin, pivot), GuidingDyad(CRANK, far_pin, far), complex(task.z[0]), task.unit
            )
        except LinkageError:
            continue
        designed.append(judge_design(linkage, targets, demands, begun[0].form))
    return [each for each in designed if each.verdict.accepted], resolution(orders, FINEST_STEP, _STEPS)


def _is_four_bar(linkage: Linkage) -> bool:
    return {"crank", "rocker", "coupler"} < {*linkage.mechanism.chain.links} and all(
        e.is_pin for e in linkage.elements.values()
    )
