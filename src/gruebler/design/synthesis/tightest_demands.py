"""Of a task without a design: the demand without which there are most, counted where nothing is demanded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, demands_met, tightest
from gruebler.design.synthesis.judging import OTHER_DIRECTION, OTHER_LENGTH
from gruebler.design.synthesis.results import Design


def freed(demands: Demands) -> Demands:
    """Without any limit of the linkage itself: what is asked of the targets stays.

    >>> freed(Demands(crank=True, transmission=0.5)).limits_of_size
    False
    """
    return replace(
        demands, crank=False, transmission=0.0, size_ratio=np.inf, region=None, lengths=(), frame_direction=None
    )


def has_limits(demands: Demands) -> bool:
    """Whether anything is demanded of the linkage itself but a size ratio, whose limit there always is.

    >>> has_limits(Demands()), has_limits(Demands(crank=True))
    (False, True)
    """
    return freed(demands) != replace(demands, size_ratio=np.inf)


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
