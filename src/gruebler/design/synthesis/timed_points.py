"""Points, or three positions, that the coupler reaches at given crank angles.

docs/theory/synthesis-points.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_families import PLANE, SLIDES_BESIDE, guiding_dyads, near_in_plane, sliding_sample
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, GuidingDyad
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.length_search import best_linkages
from gruebler.design.synthesis.pair_facts import USUAL
from gruebler.design.synthesis.pair_search import FINE_WIDTHS, SoughtPairs, distinct_pairs
from gruebler.design.synthesis.partner_bounds import best_beside
from gruebler.design.synthesis.results import Design, SolutionCount, SynthesisResult, ranked, resolution, sorted_sample
from gruebler.design.synthesis.targets import Probe, Targets, position_targets
from gruebler.design.synthesis.tasks import SAME, PathTask, PositionTask
from gruebler.design.synthesis.tightest_demands import all_but_one, has_limits
from gruebler.design.synthesis.timed_families import best_timed

TIMED_POSITIONS = 3
MOST_TIMED = 5
"""Points that are met with any crank angles."""
_TIMED_SAMPLE = 1600
"""Dyads that are tried with the one crank of three positions with crank angles."""


def timed_positions(task: PathTask, demands: Demands, number: int, sort: Sequence[str] = ()) -> SynthesisResult:
    """Three positions with crank angles: one crank does it, with any other dyad of the positions; the best are sought.

    With w from the crank's pivot to its pin and v on to the point, w e^(i phi) + v e^(i theta) moves as the point does.
    """
    turned, carried = (np.exp(1j * (np.array(a) - a[0])) for a in (task.crank_angles, [a or 0.0 for a in task.angles]))
    matrix = np.stack([turned[1:] - 1, carried[1:] - 1], axis=1)
    if abs(np.linalg.det(matrix)) < SAME:
        raise SynthesisError("the crank turns as the coupler does: no crank has these angles, or any has")
    w, v = np.linalg.solve(matrix, task.z[1:] - task.z[0])
    pin = complex(task.z[0] - v)
    own = GuidingDyad(CRANK, pin, complex(pin - w))
    if own.length < SAME * task.size:
        raise SynthesisError("the crank with these angles has no length")
    positions = PositionTask(tuple((z.real, z.imag, a or 0.0) for z, a in zip(task.z, task.angles, strict=True)))

    def near(dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
        return [] if dyad == own else near_in_plane(positions, dyad, width)

    # One crank leaves time for a wide plane: five sizes about the first point.
    x, y, far = task.z[0].real, task.z[0].imag, 5 * task.size
    region = demands.region or (x - far, y - far, x + far, y + far)
    others = [dyad for dyad in guiding_dyads(positions, _TIMED_SAMPLE, region) if not dyad.slides]
    families = [[dyad for dyad in others if dyad != own]]
    families += [sliding_sample(positions, kind, demands, SLIDES_BESIDE) for kind in (SLIDER, BLOCK)]
    turning, *sliding = (
        best_linkages(
            SoughtPairs(
                task=positions, dyads=[own], demands=demands, near=near, second=family, orders=sort, number=2 * number
            )
        )
        for family in families
    )
    better, proved = best_beside(positions, demands, own, turning.pairs, drives=True)
    pairs = distinct_pairs([*better, *turning.pairs, *(pair for search in sliding for pair in search.pairs)], task.size)
    designs = [
        design for _, other in pairs for design in _judged_timed(task, np.array(task.crank_angles), demands, own, other)
    ]
    accepted, rejected = ranked(designs)
    notes = [*turning.notes, *proved, *(note for search in sliding for note in search.notes)]
    notes += resolution([name for name in sort if name != "transmission"], PLANE * FINE_WIDTHS[-1])
    notes.append(message("Three positions with crank angles have one crank; the other dyad is any of the positions."))
    count = SolutionCount(what=message("linkages"), theorem=None, found=len(designs), real=len(designs))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def timed_points(task: PathTask, demands: Demands, number: int, sort: Sequence[str] = ()) -> SynthesisResult:
    """Points with crank angles: twice the problem of guiding a body, first seen from the crank, then the coupler.

    Of three and four points the families are searched where a measure is asked for, something is demanded, or none of a
    few linkages will do.
    """
    if len(task) > MOST_TIMED:
        from gruebler.design.synthesis.curves import fit_path

        return fit_path(task, demands, number=number)
    if len(task) < 3:
        raise SynthesisError("crank angles need at least three points: two are met by any crank")
    timing = np.array(task.crank_angles)
    designs = timed_designs(task, timing, demands, number)
    theorem = 12 if len(task) == MOST_TIMED else None
    notes: list[Message] = []
    accepted, rejected = ranked(designs)
    if theorem is None:
        notes.append(message("There are infinitely many solutions; some dyads of each family were taken."))
        shrink = sort[:1] == ("size",) and len(task) == 3  # the smallest have no size
        notes += sorted_sample(sort) if shrink else []
        if not shrink and (sort or has_limits(demands) or not accepted):
            pairs, said = best_timed(task, demands, sort or USUAL, number)
            better = [each for pair in pairs for each in _judged_timed(task, timing, demands, *pair)]
            accepted, rejected = ranked([*better, *designs])
            notes += said if accepted else [*said, *all_but_one([*better, *designs], demands)]
    count = SolutionCount(what=message("linkages"), theorem=theorem, found=theorem or len(designs), real=len(designs))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def timed_designs(task: PathTask, timing: Reals, demands: Demands, number: int) -> list[Design]:
    """The designs whose crank has angles, (points,), at the points of a task."""
    # The body of the crank seen with the coupler point at rest: its point A - A0 goes to exp(i angle) (A - A0) - P.
    within = np.angle(np.exp(1j * timing))  # a body looks the same after a whole turn
    seen = PositionTask(tuple((-z.real, -z.imag, a) for z, a in zip(task.z, within, strict=True)))
    designs: list[Design] = []
    cranks = [d for d in guiding_dyads(seen, number) if not d.slides]
    for crank in cranks:
        # Placed in the first position: fixed = -A0, moving = (A - A0) - P1 as the place of the body's point.
        pivot, pin = -crank.fixed, crank.moving + task.z[0] - crank.fixed
        turned = np.exp(1j * (timing - timing[0]))
        pins = pivot + (pin - pivot) * turned
        coupler = np.angle((task.z - pins) / (task.z[0] - pin))
        carried = PositionTask(tuple((z.real, z.imag, a) for z, a in zip(task.z, coupler, strict=True)))
        own = GuidingDyad(CRANK, complex(pin), complex(pivot))
        for other in guiding_dyads(carried, number):
            same = abs(other.moving - own.moving) + abs(other.fixed - own.fixed)
            if not other.slides and same < 1e-6 * (task.size + abs(own.moving) + abs(own.fixed)):
                continue
            designs += _judged_timed(task, timing, demands, own, other)
    return designs


def _judged_timed(
    task: PathTask, timing: Reals, demands: Demands, own: GuidingDyad, other: GuidingDyad
) -> list[Design]:
    try:
        linkage = linkage_of_dyads(own, other, complex(task.z[0]), task.unit)
    except LinkageError:
        return []
    crank = task.size * np.exp(1j * (linkage.required_pose["crank"].angle + timing - timing[0]))
    first = linkage.required_pose["coupler"].angle
    angles: list[float | None] = [None] * len(task)
    if task.angles:
        angles = [first + (a or 0.0) - (task.angles[0] or 0.0) for a in task.angles]
    placed = position_targets("P", "coupler", task.z, angles, task.size)
    probes = (*placed.probes, Probe(link="crank", length=task.size))
    values = np.concatenate([placed.values, crank[:, None]], axis=1)
    targets = Targets(probes, values, task.size, ranks=task.order, travel=task.size)
    return [judge_design(linkage, targets, demands, f"{own.kind.form}-{other.kind.form}")]
