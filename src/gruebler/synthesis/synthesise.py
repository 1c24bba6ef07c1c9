"""One function for every kind of task."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from gruebler.errors import SynthesisError
from gruebler.mechanism import Mechanism
from gruebler.synthesis.dead_centres import synthesise_dead_centres
from gruebler.synthesis.functions import synthesise_function
from gruebler.synthesis.judging import Demands
from gruebler.synthesis.paths import synthesise_path
from gruebler.synthesis.positions import synthesise_positions
from gruebler.synthesis.results import SynthesisResult
from gruebler.synthesis.structures import synthesise_structures
from gruebler.synthesis.tasks import DeadCentreTask, FunctionTask, PathTask, PositionTask, Task

__all__ = ["synthesise"]


def synthesise(
    task: Task, structures: Iterable[Mechanism] | None = None, demands: Demands | None = None, **options: Any
) -> SynthesisResult:
    """Linkages for a wanted motion, the accepted ones first.

    Args:
        task: positions of a body, points of a path, a function, or dead centres.
        structures: mechanisms that are fitted to a path instead of four-bars.
        demands: what a design must do besides the task, such as a crank or a least transmission angle.
        options: those of `synthesise_positions`, `synthesise_path`, `synthesise_function`, `synthesise_dead_centres`
            or `synthesise_structures`.

    Raises `SynthesisError` for a task that contradicts itself, and for structures with another task than a path.

    >>> from gruebler.synthesis import DeadCentreTask
    >>> result = synthesise(DeadCentreTask(stroke=50, time_ratio=1.2))
    >>> round(result.designs[0].linkage.length("crank", 0, 1), 4)
    23.5237
    """
    if structures is not None:
        if not isinstance(task, PathTask):
            raise SynthesisError("structures are fitted to a path, not to a {kind}", kind=type(task).__name__)
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
