"""All four-bars through points that leave finitely many: the task as a problem whose solutions are followed.

docs/theory/synthesis-points.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.alt_burmester import Problem, Solutions, parameters, solutions
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_linkages import four_bar_linkages
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.judging import best_of, decided_by_path, order_notes, rejected_alike
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, ranked
from gruebler.design.synthesis.targets import Targets, point_targets, position_targets
from gruebler.design.synthesis.tasks import SAME, PathTask
from gruebler.mechanics.linkages import Linkage

MOST_ON_CIRCLE = 6
ON_LINE = message(
    "{count} of the points lie on one line, which a coupler curve meets in at most {most} points "
    "unless it contains it: give closed = true for the curves that come nearest"
)
ON_CIRCLE = message(
    "{count} of the points lie on one circle, which a coupler curve meets in at most {most} points "
    "unless it contains it: give closed = true for the curves that come nearest"
)
UNRESOLVED = message("{count} solutions are not resolved: where their paths end could not be decided.")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Reduced:
    """A task in its own units: the first position (or point) at the origin, the size 1."""

    parameters: Complexes
    origin: complex
    size: float
    added: int
    """How many points were added to make the problem finite."""
    first: int
    """The number of the point that is the origin."""


def all_four_bars(
    task: PathTask,
    demands: Demands,
    problem: Problem,
    oriented: list[int],
    *,
    threads: int | None,
    progress: Progress | None,
) -> SynthesisResult:
    """All solutions of a problem with a task's targets; ``oriented`` are the numbers of the points with angles."""
    check_general(task)
    reduced, complete = _best_reference(task, problem, oriented, threads, progress)
    designs: list[Design] = []
    for done, alike in enumerate(classes := list(_classes(problem, complete)), 1):
        if progress is not None:
            progress(done, len(classes))
        pairs = [[dyad.moved(reduced.size, reduced.origin) for dyad in pair] for pair in alike]
        designs += _judged(task, demands, pairs, reduced.first)
    cognate = problem.poses == 0 and not problem.given_pivots
    what = message("cognate triples") if cognate else message("four-bars")
    accepted, rejected = ranked(designs)
    theorem = None if reduced.added else problem.classes
    resolved = problem.classes - complete.missing
    count = SolutionCount(
        what=what, theorem=theorem, found=resolved, real=len(complete.real), infinite=complete.infinite
    )
    return SynthesisResult(
        task=task,
        designs=accepted,
        rejected=rejected,
        count=count,
        notes=(*_notes(problem, complete, reduced.added), *order_notes(designs, demands)),
    )


class _Crowd(NamedTuple):
    points: int
    on_line: bool


def crowded(task: PathTask) -> _Crowd | None:
    """More points on a line or circle than a coupler curve has there, if there are so many.

    A coupler curve is of degree six and passes three times through each circular point: it meets a line in six points,
    a circle in 12 - 2 * 3 = 6.
    """
    z = (task.z - task.z.mean()) / task.size
    rows = np.stack([np.abs(z) ** 2, z.real, z.imag, np.ones(len(z))], axis=1)
    for three in combinations(range(len(z)), 3):
        circle = np.linalg.svd(rows[list(three)])[2][-1]
        # The distance from the circle a |z|^2 + ... = 0 (a line where a = 0), by its gradient.
        slope = np.abs(2 * circle[0] * z + circle[1] + 1j * circle[2])
        count = int(np.count_nonzero(np.abs(rows @ circle) <= SAME * np.maximum(slope, 1e-3)))
        if count > MOST_ON_CIRCLE:
            return _Crowd(count, bool(abs(circle[0]) < SAME))
    return None


def check_general(task: PathTask) -> None:
    """Raise `SynthesisError` for more points on a line or circle than a coupler curve has there."""
    crowd = crowded(task)
    if crowd is None:
        return
    raise SynthesisError(ON_LINE if crowd.on_line else ON_CIRCLE, count=crowd.points, most=MOST_ON_CIRCLE)


def _notes(problem: Problem, complete: Solutions, added: int) -> Iterator[Message]:
    if added:
        yield message(
            "There are infinitely many solutions: points on a smooth curve through the given ones were added "
            "({count}); with them there are {theorem} solutions.",
            count=added,
            theorem=problem.classes,
        )
    if complete.infinite:
        yield message("{count} solutions lie at infinity: the task is a special one.", count=complete.infinite)
    if complete.singular:
        yield message(
            "{count} solutions are singular, since some coincide or have coinciding pivots: the task is a special one.",
            count=complete.singular,
        )
    if complete.missing:
        yield UNRESOLVED.filled(count=complete.missing)
    doubtful = int(np.count_nonzero(~complete.certified))
    if doubtful:
        yield message("{count} solutions are not certified: they are singular or nearly so.", count=doubtful)


def _best_reference(
    task: PathTask, problem: Problem, oriented: list[int], threads: int | None, progress: Progress | None
) -> tuple[_Reduced, Solutions]:
    """The solutions with the most central point as origin, where the equations cancel least; else with the next."""
    candidates = list(oriented) or list(range(len(task)))
    z = task.z
    candidates.sort(key=lambda k: float(np.abs(z - z[k]).mean()))
    best: tuple[_Reduced, Solutions] | None = None
    for first in candidates[:2]:
        reduced = _reduced(task, problem, oriented, first)
        complete = solutions(problem, reduced.parameters, threads=threads, progress=progress)
        if best is None or complete.missing < best[1].missing:
            best = reduced, complete
        if not complete.missing:
            break
    assert best is not None
    return best


def _reduced(task: PathTask, problem: Problem, oriented: list[int], first: int) -> _Reduced:
    z = task.z
    others = [k for k in oriented if k != first]
    free = [k for k in range(len(z)) if k != first and k not in others]
    size = float(np.abs(z - z[first]).mean())
    extra = problem.points - len(free)
    places = np.concatenate([z[others], z[free], points_between(z, extra)])
    angles = np.array([task.angles[k] for k in [first, *others]] if oriented else [0.0], float)
    rotations = np.exp(1j * (angles[1:] - angles[0]))
    pivots = None
    if task.fixed_pivots:
        a0, b0 = ((complex(*p) - z[first]) / size for p in task.fixed_pivots)
        pivots = complex(a0), complex(b0)
    p = parameters((places - z[first]) / size, rotations, pivots)
    return _Reduced(parameters=p, origin=complex(z[first]), size=size, added=extra, first=first)


def points_between(z: Complexes, count: int) -> Complexes:
    """Points on a smooth curve through the given ones, between those furthest apart; a little off, to be general."""
    if count == 0:
        return np.zeros(0, np.complex128)
    if len(z) < 3:
        t = np.arange(1, count + 1) / (count + 1)
        gap = z[-1] - z[0]
        return np.asarray(z[0] + gap * t + 0.3j * gap * t * (1 - t) * (1 + 0.1 * np.cos(7 * t)))
    from scipy.interpolate import PchipInterpolator

    arc = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    curve = PchipInterpolator(arc, np.stack([z.real, z.imag], axis=1))
    knots = list(arc)
    points = []
    for k in range(count):
        gaps = np.diff(knots)
        widest = int(np.argmax(gaps))
        at = knots[widest] + gaps[widest] * (0.5 + 0.03 * np.cos(3.0 * k))
        knots.insert(widest + 1, at)
        x, y = curve(at)
        points.append(complex(x, y))
    return np.array(points)


def _classes(problem: Problem, complete: Solutions) -> Iterator[list[tuple[GuidingDyad, GuidingDyad]]]:
    """The real linkages of each real class: with Roberts' cognates where only points are given."""
    for row in complete.real:
        x, y, a, b = (complex(row[k] + np.conj(row[k + 1])) / 2 for k in (0, 2, 4, 6))
        alike = [(GuidingDyad(CRANK, x, a), GuidingDyad(CRANK, y, b))]
        if not (problem.poses or problem.given_pivots or abs(y - x) < 1e-12):
            # The coupler triangle: the point, at the origin, lies at the part k of the way from x to y.
            k = -x / (y - x)
            c = a + k * (b - a)
            alike.append((GuidingDyad(CRANK, a - x, a), GuidingDyad(CRANK, (a - x) * (1 - k), c)))
            alike.append((GuidingDyad(CRANK, b - y, b), GuidingDyad(CRANK, k * (b - y), c)))
        yield alike


def _judged(task: PathTask, demands: Demands, pairs: Iterable[Sequence[GuidingDyad]], first: int) -> Iterator[Design]:
    """The designs of a class: cognates have the same path, so that where it decides for one, it does for the others."""
    decided: Design | None = None
    for own, other in pairs:
        linkages = four_bar_linkages(own, other, complex(task.z[first]), unit=task.unit)
        try:
            if decided is not None:
                design = rejected_alike(next(linkages), decided, demands)
            else:
                design = best_of(linkages, partial(_targets, task, first), demands, "RR-RR")
        except LinkageError:
            continue
        if decided_by_path(design.verdict, demands):
            decided = design
        yield design


def _targets(task: PathTask, first: int, linkage: Linkage) -> Targets:
    if not any(angle is not None for angle in task.angles):
        return replace(point_targets("P", task.z, task.size), ranks=task.order)
    start = task.angles[first]
    assert start is not None
    start_angle = linkage.required_pose["coupler"].angle
    angles = [None if a is None else start_angle + a - start for a in task.angles]
    return replace(position_targets("P", "coupler", task.z, angles, task.size), ranks=task.order)
