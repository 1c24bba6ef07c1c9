"""One function for every kind of task."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.dead_centres import synthesise_dead_centres
from gruebler.design.synthesis.functions import synthesise_function
from gruebler.design.synthesis.judging import Demands
from gruebler.design.synthesis.paths import synthesise_path
from gruebler.design.synthesis.positions import synthesise_positions
from gruebler.design.synthesis.results import SynthesisResult, in_order_of
from gruebler.design.synthesis.structures import synthesise_structures
from gruebler.design.synthesis.tasks import DeadCentreTask, FunctionTask, PathTask, PositionTask, Task
from gruebler.structure.mechanism import Mechanism


@door_that_raises(SynthesisError)
def synthesise(
    task: Task,
    structures: Iterable[Mechanism] | None = None,
    demands: Demands | None = None,
    *,
    sort: str | Sequence[str] = (),
    **options: Any,
) -> SynthesisResult:
    """Linkages for a wanted motion, the accepted ones first.

    Args:
        task: positions of a body, points of a path, a function, or dead centres.
        structures: mechanisms that are fitted to the task instead of four-bars and slider-cranks.
        demands: what a design must do besides the task, such as a crank or a least transmission angle.
        sort: one or several of ``error``, ``transmission`` (on the way through the targets), ``range-transmission``
            (over the whole range of the drive), ``size``, ``size-ratio``, ``links``, ``full-turn``; of designs that
            are equal in the first the second decides. By default a full turn comes first, then the transmission angle;
            where targets are only approached, the error.
        options: those of `synthesise_positions`, `synthesise_path`, `synthesise_function`, `synthesise_dead_centres`
            or `synthesise_structures`.

    Raises `SynthesisError` for a task that contradicts itself, and for structures that cannot do it.

    >>> from gruebler.design.synthesis import DeadCentreTask
    >>> result = synthesise(DeadCentreTask(stroke=50, time_ratio=1.2))
    >>> round(result.designs[0].linkage.length("crank", 0, 1), 4)
    23.5237
    """
    orders = (sort,) if isinstance(sort, str) else tuple(sort)
    in_order_of((), orders)  # a wrong name is refused before the work
    result = _solved(task, structures, demands, options)
    return result.sorted_by(*orders) if orders else result


def _solved(
    task: Task, structures: Iterable[Mechanism] | None, demands: Demands | None, options: dict[str, Any]
) -> SynthesisResult:
    if structures is not None:
        return synthesise_structures(task, structures, demands, **options)
    match task:
        case PositionTask():
            return synthesise_positions(task, demands, **options)
        case PathTask():
            return synthesise_path(task, demands, **options)
        case FunctionTask():
            return synthesise_function(task, demands, **options)
        case DeadCentreTask():
            return synthesise_dead_centres(task, demands, **options)
    raise SynthesisError(
        "expected a task of positions, points, a function or dead centres, but found {found!r}", found=task
    )
