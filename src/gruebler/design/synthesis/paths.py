"""Path generation: four-bars whose coupler point passes through points, with all solutions where they are finite.

docs/theory/synthesis-points.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import NamedTuple

import numpy as np

from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.alt_burmester import PROBLEMS, Problem
from gruebler.design.synthesis.demands import Demands, sought_order
from gruebler.design.synthesis.finite_points import all_four_bars, check_general, crowded, points_between
from gruebler.design.synthesis.judging import order_notes
from gruebler.design.synthesis.point_families import improved_designs, through_points
from gruebler.design.synthesis.positions import synthesise_positions
from gruebler.design.synthesis.results import (
    EXACT,
    Design,
    Progress,
    SolutionCount,
    SynthesisResult,
    ranked,
    sorted_sample,
)
from gruebler.design.synthesis.special_tasks import solved_where_it_lies
from gruebler.design.synthesis.tasks import MOST_POINTS, PathTask, PositionTask
from gruebler.design.synthesis.tightest_demands import all_but_one
from gruebler.design.synthesis.timed_families import best_timed
from gruebler.design.synthesis.timed_points import (
    MOST_TIMED,
    TIMED_POSITIONS,
    timed_designs,
    timed_points,
    timed_positions,
)

_TURNS = (90, 150, 210, 270)
"""Degrees by which the crank turns from the first point to the last, in one sense and the other, where it is free."""
_SEQUENCES = 6
"""In which points with an order of their own are tried."""
_SHARES = {5: 2, 4: 3}
"""By the number of points: how many dyads are taken, in halves of the number asked for; of four few are accepted."""


@solved_where_it_lies
def synthesise_path(
    task: PathTask,
    demands: Demands | None = None,
    *,
    number: int = 6,
    sliders: bool = True,
    sort: Sequence[str] = (),
    threads: int | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """All four-bars whose coupler point passes through the points of a task.

    Nine points, five points and two fixed pivots, five points with crank angles, and the finite mixed tasks have
    finitely many solutions, all of which are found. Fewer points have infinitely many: up to five are met with several
    choices of the crank angles, six to eight by linkages whose curves are similar, and so are fewer where a region,
    pivots, lengths or a transmission angle are demanded; where coupler angles are given, points on a smooth curve
    through them are added until the number is finite. For more points, and for a closed curve, the
    linkages that come nearest are sought, within the demands; of a closed curve with nine points the four-bars that
    pass through all of them come first.

    Args:
        task: points, perhaps with coupler angles, crank angles or fixed pivots.
        demands: what a design has to do besides.
        number: of dyads taken from an infinite family (crank angles), or of designs for a whole curve.
        sliders: whether slider-cranks are looked for, too, where least squares find the designs.
        sort: by what the best of a family are sought, where points are no whole curve: names as for
            `SynthesisResult.sorted_by`.
        threads: how many follow paths; as many as there are processors if None.
        progress: called with the paths, or the passes through an atlas, that are done, and their number, then with the
            verdicts.

    Raises `SynthesisError` for combinations that no method serves. Cost: nine points about 3 s on one core, the others
    below 1 s, and 10 ms for each verdict.

    >>> task = PathTask([(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1)], fixed_pivots=[(0, -3), (4, -2)])
    >>> count = synthesise_path(task).count
    >>> str(count.what), count.theorem, count.found, count.real
    ('four-bars', 36, 36, 14)
    """
    wanted = (demands or Demands()).of_task(task)
    run = _Run(task=task, demands=wanted, number=number, sliders=sliders, sort=sort, threads=threads, progress=progress)
    return next((method.solve for method in _METHODS if method.suits(run)), _finite)(run)


@dataclass(frozen=True, kw_only=True)
class _Run:
    """A task with all that its method may ask."""

    task: PathTask
    demands: Demands
    number: int
    sliders: bool
    sort: Sequence[str]
    threads: int | None
    progress: Progress | None

    @property
    def orders(self) -> Sequence[str]:
        """By what the best is sought."""
        return self.sort or ("full-turn", "transmission")

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
        limited = bool(self.task.fixed_pivots) or (self.points_alone and self.demands.limits_of_size)
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
        return timed_positions(run.task, run.demands, run.number, run.sort)
    timed = timed_points(run.task, run.demands, run.number, run.sort)
    return _only_sorted(run, timed) if len(run.task) > MOST_TIMED else timed


def _only_sorted(run: _Run, result: SynthesisResult) -> SynthesisResult:
    """With the note that the designs were not sought by what is asked for."""
    return replace(result, notes=(*result.notes, *sorted_sample(run.sort)))


def _open_points(run: _Run) -> SynthesisResult:
    from gruebler.design.synthesis.curves import fit_open_points, tightest_of_points

    check_general(run.task)
    free = free_parameters(run.task, run.demands)
    fitted = fit_open_points(run.task, run.demands, free, number=run.number, sliders=run.sliders, progress=run.progress)
    better, steps = _improved(run, (*fitted.designs, *fitted.rejected))
    designs, _ = ranked([*better, *fitted.designs])
    notes = (*fitted.notes, *(steps or sorted_sample(run.sort)))
    if not designs:
        sought = tightest_of_points(
            run.task, run.demands, number=run.number, sliders=run.sliders, progress=run.progress
        )
        notes = (*notes, *sought)
    return replace(fitted, designs=designs, notes=notes)


def _improved(run: _Run, designs: Sequence[Design]) -> tuple[list[Design], list[Message]]:
    """Better ones of the family, with a slide, too, where something is asked for; three points from random starts."""
    better, notes = improved_designs(run.task, run.demands, designs, run.orders, slides=run.sliders and bool(run.sort))
    free = len(run.task) == 3 and not (run.task.fixed_pivots or run.demands.given_sizes)
    if not free or run.sort[:1] in ((), ("size",), ["size"]):  # the smallest shrink to a point
        return better, notes
    pairs, said = best_timed(run.task, run.demands, run.orders, run.number)
    pairs = [pair for pair in pairs if run.sliders or not pair[1].slides]
    return [*better, *through_points(run.task, run.demands, pairs, designs)], [*said, *notes]


def free_parameters(task: PathTask, demands: Demands) -> int:
    """How many numbers of a four-bar points, pivots and lengths leave free; negative if they are too many."""
    return MOST_POINTS - len(task) - 2 * len(task.fixed_pivots) - demands.given_sizes


def _nearest(run: _Run) -> SynthesisResult:
    """By least squares; of a closed curve through nine points first those that pass through all of them."""
    from gruebler.design.synthesis.curves import fit_path

    task = run.task
    if run.oriented:
        raise SynthesisError("this number of points is met by least squares, without coupler angles")
    through: tuple[Design, ...] = ()
    if len(task) == MOST_POINTS and not task.fixed_pivots and not crowded(task):
        through = _all_four_bars(replace(run, task=replace(task, closed=False)), PROBLEMS[0]).designs
    fitted = fit_path(task, run.demands, number=run.number, sliders=run.sliders, progress=run.progress)
    return _only_sorted(run, _with_exact(fitted, through, run.number))


def _finite(run: _Run) -> SynthesisResult:
    """All of finitely many solutions."""
    pivots = bool(run.task.fixed_pivots)
    return _all_four_bars(run, next(p for p in PROBLEMS if p.poses == run.poses and p.given_pivots == pivots))


def _all_four_bars(run: _Run, problem: Problem) -> SynthesisResult:
    return all_four_bars(run.task, run.demands, problem, run.oriented, threads=run.threads, progress=run.progress)


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
    result = synthesise_positions(
        PositionTask(tuple(rows), unit=task.unit, order=task.order), run.demands, sort=run.sort, progress=run.progress
    )
    return SynthesisResult(
        task=task, designs=result.designs, rejected=result.rejected, count=result.count, notes=result.notes
    )


def _sampled(run: _Run) -> SynthesisResult:
    """At most five points: with every choice of crank angles there are solutions, some of which are taken.

    The crank turns evenly with the way between the points, so that their order and its sense come by themselves. Where
    they are not passed as they are listed, likely sequences are tried until designs enough are found.
    """
    task, progress = run.task, run.progress
    if len(task) < 3:
        z = np.insert(task.z, 1, points_between(task.z, 1))
        task = PathTask(tuple((float(w.real), float(w.imag)) for w in z), unit=task.unit)
    order = sought_order(task, run.demands)
    sequences = order.likely(task.z, _SEQUENCES) if order else [np.arange(len(task))]
    turns = [sign * np.radians(turn) for turn in _TURNS for sign in (1, -1)]
    few = max(2, run.number * _SHARES.get(len(run.task), 1) // 2)
    designs: list[Design] = []
    for done, (sequence, turn) in enumerate(choices := list(product(sequences, turns))):
        if done % len(turns) == 0 and sum(design.verdict.accepted for design in designs) >= run.number:
            choices = choices[:done]
            break
        lengths = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(task.z[sequence])))])
        timing = (turn * lengths / lengths[-1])[np.argsort(sequence)]
        designs += timed_designs(task, timing, run.demands, few)
        if progress is not None:
            progress(done + 1, len(choices))
    note = message(
        "There are infinitely many solutions (free parameters: {parameters}): for all crank angles at the points "
        "there are linkages. Those for {count} choices were taken, in which the crank turns from {least:g}° to "
        "{most:g}° in all, evenly with the way between the points; others may be better: fixed_pivots or crank_angles "
        "choose them.",
        parameters=MOST_POINTS - len(run.task),
        count=len(choices),
        least=min(_TURNS),
        most=max(_TURNS),
    )
    better, steps = _improved(run, designs)
    accepted, rejected = ranked([*better, *designs])
    return SynthesisResult(
        task=run.task,
        designs=accepted,
        rejected=rejected,
        count=SolutionCount(what=message("linkages"), theorem=None, found=len(designs), real=len(designs)),
        notes=(
            note,
            *(steps or sorted_sample(run.sort)),
            *order_notes(accepted or designs, run.demands),
            *([] if accepted else all_but_one(designs, run.demands)),
        ),
    )


class _Method(NamedTuple):
    suits: Callable[[_Run], bool]
    solve: Callable[[_Run], SynthesisResult]


def _mixed(run: _Run) -> SynthesisResult:
    from gruebler.design.synthesis.mixed_targets import synthesise_mixed

    mixed = synthesise_mixed(run.task, run.demands, number=run.number, sliders=run.sliders, progress=run.progress)
    return _only_sorted(run, mixed)


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
