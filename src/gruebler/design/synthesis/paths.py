"""Path generation: four-bars whose coupler point passes through points, with all solutions where they are finite.

docs/theory/synthesis-points.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.alt_burmester import PROBLEMS, Problem, Solutions, parameters, solutions
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, GuidingDyad
from gruebler.design.synthesis.judging import Demands, best_of, decided_by_path, judge_design, rejected_alike
from gruebler.design.synthesis.pair_search import best_pairs
from gruebler.design.synthesis.positions import (
    four_bar_linkages,
    guiding_dyads,
    near_in_plane,
    ranked,
    sliding_sample,
    synthesise_positions,
)
from gruebler.design.synthesis.results import EXACT, Design, DesignVerdict, Progress, SolutionCount, SynthesisResult
from gruebler.design.synthesis.targets import Probe, Targets, point_targets, position_targets
from gruebler.design.synthesis.tasks import MOST_POINTS, SAME, PathTask, PositionTask
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
MOST_TIMED = 5
TIMED_POSITIONS = 3
_TIMED_SAMPLE = 1600
"""Dyads that are tried with the one crank of three positions with crank angles."""
"""Points that are met with any crank angles."""
_TURNS = (90, 150, 210, 270)
"""Degrees by which the crank turns from the first point to the last, in one sense and the other, where it is free."""
_SHARES = {5: 2, 4: 3}
"""By the number of points: how many dyads are taken, in halves of the number asked for; of four few are accepted."""


def synthesise_path(
    task: PathTask,
    demands: Demands | None = None,
    *,
    number: int = 6,
    threads: int | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """All four-bars whose coupler point passes through the points of a task.

    Nine points, five points and two fixed pivots, five points with crank angles, and the finite mixed tasks have
    finitely many solutions, all of which are found. Fewer points have infinitely many: up to five are met with several
    choices of the crank angles, six to eight by linkages whose curves are similar, and so are fewer where a region, one
    pivot, lengths or a transmission angle is demanded; where both pivots or coupler angles are given, points on a
    smooth curve through them are added until the number is finite. For more points, and for a closed curve, the
    linkages that come nearest are sought, within the demands; of a closed curve with nine points the four-bars that
    pass through all of them come first.

    Args:
        task: points, perhaps with coupler angles, crank angles or fixed pivots.
        demands: what a design has to do besides.
        number: of dyads taken from an infinite family (crank angles), or of designs for a whole curve.
        threads: how many follow paths; as many as there are processors if None.
        progress: called with the paths done and their number, then with the verdicts.

    Raises `SynthesisError` for combinations that no method serves. Cost: nine points about 3 s on one core, the others
    below 1 s, and 10 ms for each verdict.

    >>> task = PathTask([(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1)], fixed_pivots=[(0, -3), (4, -2)])
    >>> count = synthesise_path(task).count
    >>> str(count.what), count.theorem, count.found, count.real
    ('four-bars', 36, 36, 14)
    """
    run = _Run(task=task, demands=demands or Demands(), number=number, threads=threads, progress=progress)
    return next((method.solve for method in _METHODS if method.suits(run)), _finite)(run)


@dataclass(frozen=True, kw_only=True)
class _Run:
    """A task with all that its method may ask."""

    task: PathTask
    demands: Demands
    number: int
    threads: int | None
    progress: Progress | None

    @cached_property
    def oriented(self) -> list[int]:
        """The numbers of the points that have coupler angles."""
        return [k for k, angle in enumerate(self.task.angles) if angle is not None]

    @property
    def points_alone(self) -> bool:
        """Whether nothing but points of an open curve is given."""
        return not (self.oriented or self.task.fixed_pivots or self.task.closed)

    @property
    def sought(self) -> bool:
        """Whether one of infinitely many linkages is sought that keeps to limits: a given pivot, lengths, a region."""
        limited = len(self.task.fixed_pivots) == 1 or (self.points_alone and self.demands.limits_of_size)
        return limited and not (self.oriented or self.task.closed) and free_parameters(self.task, self.demands) > 0

    @property
    def poses(self) -> int:
        """Positions besides the first."""
        return max(0, len(self.oriented) - 1)

    @property
    def too_many(self) -> bool:
        """Whether no linkage meets all that is given."""
        if len(self.task.fixed_pivots) == 1:
            return True
        needed = 4 if self.task.fixed_pivots else MOST_POINTS - 1 - 2 * self.poses
        return self.task.closed or needed < len(self.task) - 1 - self.poses or self.poses > 3


def _with_crank_angles(run: _Run) -> SynthesisResult:
    if len(run.oriented) == len(run.task) == TIMED_POSITIONS and not run.task.fixed_pivots:
        return _timed_positions(run)
    return _timed(run.task, run.demands, run.number)


def _timed_positions(run: _Run) -> SynthesisResult:
    """Three positions with crank angles: one crank does it, with any other dyad of the positions; the best are sought.

    With w from the crank's pivot to its pin and v on to the point, w e^(i phi) + v e^(i theta) moves as the point does.
    """
    task = run.task
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
    region = run.demands.region or (x - far, y - far, x + far, y + far)
    others = [dyad for dyad in guiding_dyads(positions, _TIMED_SAMPLE, region) if not dyad.slides]
    families = [[dyad for dyad in others if dyad != own]]
    families += [sliding_sample(positions, kind, run.demands) for kind in (SLIDER, BLOCK)]
    searches = [
        best_pairs(positions, [own], run.demands, near, second=family, number=2 * run.number) for family in families
    ]
    designs = [
        design
        for search in searches
        for _, other in search.pairs
        for design in _judged_timed(task, run.demands, own, other)
    ]
    accepted, rejected = ranked(designs)
    notes = [note for search in searches for note in search.notes]
    notes.append(message("Three positions with crank angles have one crank; the other dyad is any of the positions."))
    count = SolutionCount(what=message("linkages"), theorem=None, found=len(designs), real=len(designs))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def _open_points(run: _Run) -> SynthesisResult:
    from gruebler.design.synthesis.curves import fit_open_points

    _check_general(run.task)
    return fit_open_points(
        run.task, run.demands, free_parameters(run.task, run.demands), number=run.number, progress=run.progress
    )


def free_parameters(task: PathTask, demands: Demands) -> int:
    """How many numbers of a four-bar points, pivots and lengths leave free; negative if they are too many."""
    return MOST_POINTS - len(task) - 2 * len(task.fixed_pivots) - len(demands.lengths)


def _nearest(run: _Run) -> SynthesisResult:
    """By least squares; of a closed curve through nine points first those that pass through all of them."""
    from gruebler.design.synthesis.curves import fit_path

    task = run.task
    if run.oriented:
        raise SynthesisError("this number of points is met by least squares, without coupler angles")
    through: tuple[Design, ...] = ()
    if len(task) == MOST_POINTS and not task.fixed_pivots and not _crowded(task):
        through = _exact(replace(run, task=replace(task, closed=False)), PROBLEMS[0]).designs
    return _with_exact(fit_path(task, run.demands, number=run.number, progress=run.progress), through, run.number)


def _finite(run: _Run) -> SynthesisResult:
    """All of finitely many solutions."""
    pivots = bool(run.task.fixed_pivots)
    return _exact(run, next(p for p in PROBLEMS if p.poses == run.poses and p.given_pivots == pivots))


def _with_exact(fitted: SynthesisResult, through: Sequence[Design], number: int) -> SynthesisResult:
    """Designs for nine points of a closed curve: first four-bars through all of them, whose cranks turn fully.

    Least squares from similar curves find only some of these: nine points do not tell the curve between them.
    """
    exact = [replace(design, form="four-bar") for design in through if design.verdict.turns_fully]
    if not exact:
        return fitted
    near = [design for design in fitted.designs if design.form != "four-bar" or design.verdict.error >= EXACT]
    note = message(
        "Four-bars through all points whose cranks turn fully: {count}, the first of the list.", count=len(exact)
    )
    designs = (*exact, *near)[: max(number, len(exact))]
    return replace(fitted, designs=designs, notes=(*fitted.notes, note))


def _as_positions(run: _Run) -> SynthesisResult:
    """Every point has its coupler angle: positions."""
    task = run.task
    rows = [(p.real, p.imag, a) for p, a in zip(task.z, task.angles, strict=True) if a is not None]
    result = synthesise_positions(PositionTask(tuple(rows), unit=task.unit), run.demands, progress=run.progress)
    return SynthesisResult(
        task=task, designs=result.designs, rejected=result.rejected, count=result.count, notes=result.notes
    )


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


def _exact(run: _Run, problem: Problem) -> SynthesisResult:
    task, demands, progress = run.task, run.demands, run.progress
    _check_general(task)
    reduced, complete = _best_reference(task, problem, run.oriented, run.threads, progress)
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
        notes=tuple(_notes(problem, complete, reduced.added)),
    )


class _Crowd(NamedTuple):
    points: int
    on_line: bool


def _crowded(task: PathTask) -> _Crowd | None:
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


def _check_general(task: PathTask) -> None:
    """Raise `SynthesisError` for more points on a line or circle than a coupler curve has there."""
    crowd = _crowded(task)
    if crowd is None:
        return
    raise SynthesisError(ON_LINE if crowd.on_line else ON_CIRCLE, count=crowd.points, most=MOST_ON_CIRCLE)


def _notes(problem: Problem, complete: Solutions, added: int) -> Iterator[Message]:
    if added:
        yield message(
            "There are infinitely many solutions: {count} points on a smooth curve through the given ones were added; "
            "with them there are {theorem} solutions.",
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
    places = np.concatenate([z[others], z[free], _between(z, extra)])
    angles = np.array([task.angles[k] for k in [first, *others]] if oriented else [0.0], float)
    rotations = np.exp(1j * (angles[1:] - angles[0]))
    pivots = None
    if task.fixed_pivots:
        a0, b0 = ((complex(*p) - z[first]) / size for p in task.fixed_pivots)
        pivots = complex(a0), complex(b0)
    p = parameters((places - z[first]) / size, rotations, pivots)
    return _Reduced(parameters=p, origin=complex(z[first]), size=size, added=extra, first=first)


def _between(z: Complexes, count: int) -> Complexes:
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
    decided: DesignVerdict | None = None
    for own, other in pairs:
        linkages = four_bar_linkages(own, other, complex(task.z[first]), unit=task.unit)
        try:
            if decided is not None:
                design = rejected_alike(next(linkages), decided, demands, "RR-RR")
            else:
                design = best_of(linkages, partial(_targets, task, first), demands, "RR-RR")
        except LinkageError:
            continue
        if decided_by_path(design.verdict, demands):
            decided = design.verdict
        yield design


def _targets(task: PathTask, first: int, linkage: Linkage) -> Targets:
    if not any(angle is not None for angle in task.angles):
        return point_targets("P", task.z, task.size)
    start = task.angles[first]
    assert start is not None
    start_angle = linkage.required_pose["coupler"].angle
    angles = [None if a is None else start_angle + a - start for a in task.angles]
    return position_targets("P", "coupler", task.z, angles, task.size)


def _timed(task: PathTask, demands: Demands, number: int) -> SynthesisResult:
    """Points with crank angles: twice the problem of guiding a body, first seen from the crank, then the coupler."""
    if len(task) > 5:
        from gruebler.design.synthesis.curves import fit_path

        return fit_path(task, demands, number=number)
    if len(task) < 3:
        raise SynthesisError("crank angles need at least three points: two are met by any crank")
    timing = np.array(task.crank_angles)
    # The body of the crank seen with the coupler point at rest: its point A - A0 goes to exp(i angle) (A - A0) - P.
    within = np.angle(np.exp(1j * timing))  # a body looks the same after a whole turn
    seen = PositionTask(tuple((-z.real, -z.imag, a) for z, a in zip(task.z, within, strict=True)))
    designs: list[Design] = []
    cranks = [d for d in guiding_dyads(seen, number) if not d.slides]
    real = 0
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
            real += 1
            designs += _judged_timed(task, demands, own, other)
    accepted, rejected = ranked(designs)
    theorem = 12 if len(task) == 5 else None
    family = message("There are infinitely many solutions; some dyads of each family were taken.")
    count = SolutionCount(what=message("linkages"), theorem=theorem, found=theorem or real, real=real)
    return SynthesisResult(
        task=task, designs=accepted, rejected=rejected, count=count, notes=() if theorem else (family,)
    )


def _sampled(run: _Run) -> SynthesisResult:
    """At most five points: with every choice of crank angles there are solutions, some of which are taken.

    The crank turns evenly with the way between the points, so that their order and its sense come by themselves.
    """
    task, progress = run.task, run.progress
    z = task.z if len(task) > 2 else np.insert(task.z, 1, _between(task.z, 1))
    points = tuple((float(w.real), float(w.imag)) for w in z)
    lengths = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    turns = [sign * np.radians(turn) for turn in _TURNS for sign in (1, -1)]
    designs: list[Design] = []
    real = 0
    for done, turn in enumerate(turns, 1):
        timing = tuple(float(angle) for angle in turn * lengths / lengths[-1])
        few = max(2, run.number * _SHARES.get(len(task), 1) // 2)
        result = _timed(PathTask(points, crank_angles=timing, unit=task.unit), run.demands, few)
        designs += [*result.designs, *result.rejected]
        real += result.count.real
        if progress is not None:
            progress(done, len(turns))
    note = message(
        "There are infinitely many solutions, a family of {parameters} parameters: for all crank angles at the points "
        "there are linkages. Those for {count} choices were taken; fixed_pivots or crank_angles choose others.",
        parameters=MOST_POINTS - len(task),
        count=len(turns),
    )
    accepted, rejected = ranked(designs)
    return SynthesisResult(
        task=task,
        designs=accepted,
        rejected=rejected,
        count=SolutionCount(what=message("linkages"), theorem=None, found=real, real=real),
        notes=(note,),
    )


def _judged_timed(task: PathTask, demands: Demands, own: GuidingDyad, other: GuidingDyad) -> list[Design]:
    from gruebler.design.synthesis.positions import linkage_of_dyads

    try:
        linkage = linkage_of_dyads(own, other, complex(task.z[0]), task.unit)
    except LinkageError:
        return []
    timing = np.array(task.crank_angles)
    crank = task.size * np.exp(1j * (linkage.required_pose["crank"].angle + timing - timing[0]))
    first = linkage.required_pose["coupler"].angle
    angles: list[float | None] = [None] * len(task)
    if task.angles:
        angles = [first + (a or 0.0) - (task.angles[0] or 0.0) for a in task.angles]
    placed = position_targets("P", "coupler", task.z, angles, task.size)
    probes = (*placed.probes, Probe(link="crank", length=task.size))
    targets = Targets(probes, np.concatenate([placed.values, crank[:, None]], axis=1), task.size)
    return [judge_design(linkage, targets, demands, f"{own.kind.form}-{other.kind.form}")]


class _Method(NamedTuple):
    suits: Callable[[_Run], bool]
    solve: Callable[[_Run], SynthesisResult]


def _mixed(run: _Run) -> SynthesisResult:
    from gruebler.design.synthesis.mixed_targets import synthesise_mixed

    return synthesise_mixed(run.task, run.demands, number=run.number, progress=run.progress)


def _needs_least_squares(run: _Run) -> bool:
    """Whether targets are of several kinds that no exact method takes together."""
    timed = bool(run.task.crank_angles) and bool(run.oriented or run.task.fixed_pivots)
    three = len(run.oriented) == len(run.task) == TIMED_POSITIONS and not run.task.fixed_pivots
    pivots = bool(run.task.fixed_pivots) and len(run.oriented) > 1
    return run.task.mixed or (timed and not three) or pivots


_METHODS = (
    _Method(_needs_least_squares, _mixed),
    _Method(lambda run: bool(run.task.crank_angles), _with_crank_angles),
    _Method(lambda run: len(run.oriented) == len(run.task) > 1 and not run.task.closed, _as_positions),
    _Method(lambda run: run.sought, _open_points),
    _Method(lambda run: run.points_alone and len(run.task) <= MOST_TIMED, _sampled),
    _Method(lambda run: run.points_alone and len(run.task) < MOST_POINTS, _open_points),
    _Method(lambda run: run.too_many, _nearest),
)
"""What solves a task: the first row that suits it, else `_finite`."""
