"""One function for every kind of task."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from inspect import signature
from typing import Any

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.dead_centres import synthesise_dead_centres
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dwells import synthesise_dwells
from gruebler.design.synthesis.functions import synthesise_function
from gruebler.design.synthesis.paths import synthesise_path
from gruebler.design.synthesis.positions import synthesise_positions
from gruebler.design.synthesis.results import MOST_DESIGNS, Progress, SynthesisResult, sorted_sample
from gruebler.design.synthesis.six_bar_functions import SixBarType, synthesise_six_bars
from gruebler.design.synthesis.six_bar_positions import synthesise_guiding_six_bars
from gruebler.design.synthesis.structures import synthesise_structures
from gruebler.design.synthesis.tasks import DeadCentreTask, DwellTask, FunctionTask, PathTask, PositionTask, Task
from gruebler.design.synthesis.tightest_demands import all_but_one, has_limits
from gruebler.structure.mechanism import Mechanism


@door_that_raises(SynthesisError)
def synthesise(
    task: Task,
    *,
    structures: Iterable[Mechanism] | None = None,
    demands: Demands | None = None,
    sort: str | Sequence[str] = (),
    number: int | None = None,
    minimax: bool | None = None,
    six_bars: bool | SixBarType = False,
    starts: int | None = None,
    link: str | None = None,
    threads: int | None = None,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """Linkages for a wanted motion, the accepted ones first.

    Args:
        task: positions of a body, points of a path, a function, dead centres, or a rest; angles in radians.
        structures: mechanisms that are fitted to the task instead of four-bars and slider-cranks.
        demands: what a design must do besides the task, such as a crank or a least transmission angle.
        sort: one or several of ``error``, ``transmission`` (on the way through the targets), ``range-transmission``
            (over the whole range of the drive), ``size``, ``size-ratio``, ``sensitivity`` (to wrong lengths),
            ``near-pivots`` (distance from `Demands.near_pivots`), ``links``, ``full-turn``; of designs that are equal
            in the first the second decides. By default ``near-pivots`` where such are given, else a full turn comes
            first, then the transmission angle; where targets are only approached, the error. Families of two to four
            positions or pairs, two to eight points, and of dead centres, are searched for the best by these.
        number: without structures: how many dyads or designs are taken from each infinite family.
        minimax: of a function: the linkages whose largest structural error is as small as possible.
        six_bars: of a function: all six-bars that meet nine pairs of angles with free starts, of Watt's second kind, or
            eight; of eight pairs a `SixBarType` says which, and the length of one arm. Some of those that meet eleven.
            Of positions those of Watt's first kind: all of five and six, some of seven and eight.
        starts: of structures: how many are improved of each mechanism; of six-bars through seven and eight positions:
            how many generic solutions are followed.
        link: of structures: that is guided, or whose motion is the output.
        threads: of a path: how many follow it; as many as there are processors by default.
        executor: of structures, and of six-bars whose start solutions are made at random (eleven pairs, seven and eight
            positions): what runs the work; the answer is the same with any.
        progress: of positions, a path, a rest, six-bars or structures: called with the work done and its amount.

    Returns:
        A `SynthesisResult`: ``designs``, ``rejected`` with reasons, ``count`` with its theorem, ``notes``.

    Raises:
        SynthesisError: a task that contradicts itself, structures that cannot do it, an option that this task does
            not take.

    Cost:
        1 ms to 3 s (nine points), two and three positions 2 to 7 s, and 10 ms for each verdict; a rest 20 s; six-bars
        10 to 100 s, at the first eight pairs of a type 150 to 600 s more, of eleven pairs 80 and at first
        80 s more; a structure 1 to 3 s a start, by its atlas 5 s.

    Example:
        >>> from gruebler.design.synthesis import DeadCentreTask
        >>> result = synthesise(DeadCentreTask(stroke=50, time_ratio=1.2))
        >>> round(result.designs[0].linkage.length("crank", 0, 1), 4)
        23.5237

    See Also:
        `realise`, `measures`, `variants`

    Theory:
        docs/theory/synthesis.md
    """
    orders = (demands or Demands()).orders((sort,) if isinstance(sort, str) else tuple(sort))
    if number is not None and not 1 <= number <= MOST_DESIGNS:
        raise SynthesisError(
            "{key}: expected a whole number from 1 to {most:,}, but found {found}",
            key="number",
            most=MOST_DESIGNS,
            found=number,
        )
    options = {
        "number": number,
        "minimax": minimax,
        "starts": starts,
        "link": link,
        "threads": threads,
        "executor": executor,
        "progress": progress,
    }
    given: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    if six_bars and (structures is not None or not isinstance(task, FunctionTask | PositionTask)):
        raise SynthesisError("six_bars: only of functions and positions, and without structures")
    if six_bars:
        if isinstance(six_bars, SixBarType):
            given["kind"] = six_bars
        method = synthesise_six_bars if isinstance(task, FunctionTask) else synthesise_guiding_six_bars
        listed = _called(method, task, message("with six_bars"), demands, given)
        return _sorted(_with_tightest(listed, demands), orders)
    if orders and structures is None:
        given["sort"] = orders
    result = _solved(task, structures, demands, given)
    if structures is not None:
        result = replace(result, notes=(*result.notes, *sorted_sample(orders)))
    elif result.count.theorem:
        result = _with_tightest(result, demands)
    return _sorted(result, orders)


def _with_tightest(result: SynthesisResult, demands: Demands | None) -> SynthesisResult:
    """With the demand without which there are most, where none of finitely many solutions is a design."""
    if result.designs or demands is None or not has_limits(demands):
        return result
    return replace(result, notes=(*result.notes, *all_but_one(result.rejected, demands)))


def _sorted(result: SynthesisResult, orders: Sequence[str]) -> SynthesisResult:
    return result.sorted_by(*orders) if orders else result


_METHODS: dict[type[Task], Callable[..., SynthesisResult]] = {
    PositionTask: synthesise_positions,
    PathTask: synthesise_path,
    FunctionTask: synthesise_function,
    DeadCentreTask: synthesise_dead_centres,
    DwellTask: synthesise_dwells,
}


def _solved(
    task: Task, structures: Iterable[Mechanism] | None, demands: Demands | None, options: dict[str, Any]
) -> SynthesisResult:
    """The answer of the function for such a task."""
    if structures is None:
        return _called(_METHODS[type(task)], task, message("without structures"), demands, options)
    return _called(
        partial(synthesise_structures, structures=structures), task, message("with structures"), demands, options
    )


def _called(
    function: Callable[..., SynthesisResult], task: Task, how: Message, demands: Demands | None, options: dict[str, Any]
) -> SynthesisResult:
    """Options that the function does not take are refused."""
    known = [name for name in signature(function).parameters if name not in ("task", "structures", "demands")]
    other = next((name for name in options if name not in known), None)
    if other is not None:
        raise SynthesisError(
            "a {task} {structures} has no option {option!r}; it has {known}",
            task=type(task).__name__,
            structures=how,
            option=other,
            known=", ".join(known),
        )
    return function(task, demands=demands, **options)
