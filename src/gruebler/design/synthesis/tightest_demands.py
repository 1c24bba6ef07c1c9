"""Of a task without a design: the demand without which there are most, counted where nothing is demanded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import BUILDABLE, WITHOUT, Demands, demands_met, tightest
from gruebler.design.synthesis.judging import OTHER_DIRECTION, OTHER_LENGTH
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.tasks import PathTask, PositionTask, Task

_SEARCHED_AGAIN = message(
    "No design meets all demands. A second search left them out; these are the numbers of its designs:"
)


def freed(demands: Demands) -> Demands:
    """Without any limit of the linkage itself: what is asked of the targets stays.

    >>> freed(Demands(crank=True, transmission=0.5)).limits_of_size
    False
    """
    return replace(
        demands, crank=False, transmission=0.0, size_ratio=np.inf, region=None, lengths=(), frame_direction=None
    )


def has_limits(demands: Demands) -> bool:
    """Whether anything is demanded of the linkage itself but the size ratio whose limit there always is.

    >>> has_limits(Demands()), has_limits(Demands(crank=True)), has_limits(Demands(size_ratio=2))
    (False, True, True)
    """
    return freed(demands) != replace(demands, size_ratio=np.inf) or demands.size_ratio < BUILDABLE


def all_but_one(designs: Sequence[Design], demands: Demands) -> list[Message]:
    """How many of the designs are good but for one demand, else but for several; nothing of no good ones."""
    verdicts = [design.verdict for design in designs if design.verdict.one_circuit]
    if not verdicts:
        return []
    columns = [
        np.array([getattr(verdict, name) for verdict in verdicts])
        for name in ("turns_fully", "transmission", "size_ratio", "inside")
    ]
    met = demands_met(demands, *columns)
    of_sizes = (OTHER_LENGTH.text, OTHER_DIRECTION.text)
    wrong = np.array([sum(reason.text in of_sizes for reason in verdict.reasons) for verdict in verdicts])
    said = np.sum([~flags for _, flags in met], axis=0) + wrong
    if demands.given_sizes:
        met.append((demands.sizes_in_words, wrong == 0))
    good = np.array([len(verdict.reasons) for verdict in verdicts]) == said
    good &= np.array([verdict.in_order or not demands.in_order for verdict in verdicts])
    good &= np.array([verdict.one_branch or not demands.one_branch for verdict in verdicts])
    return tightest([(message("the targets"), good), *met]) if good.any() else []


def tightest_sought(task: Task, demands: Demands, search: Callable[..., Sequence[Design]]) -> list[Message]:
    """The demand without which there are most designs, sought once more without any limit; none if the task has none.

    Where no single one is enough, several; given pivots last.

    Args:
        task: for which no design was found.
        demands: that none met.
        search: of a task, judged by demands, within limits.
    """
    pivots = getattr(task, "fixed_pivots", ())
    if not has_limits(demands) and not pivots:
        return []  # how many differ too much in their lengths is said anyway
    notes = all_but_one(search(task, demands, freed(demands)), demands)
    if not notes and pivots and isinstance(task, PositionTask | PathTask):
        anywhere = search(replace(task, fixed_pivots=()), demands, demands)
        if count := sum(design.verdict.accepted for design in anywhere):
            notes = [WITHOUT.filled(demand=message("the given pivots"), count=count)]
    return [_SEARCHED_AGAIN, *notes] if notes else []
