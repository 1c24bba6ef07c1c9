"""What is said of pivots that are given for three or four positions: which ones are taken, and where they turn.

docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, inside_region
from gruebler.design.synthesis.dyads import GuidingDyad
from gruebler.design.synthesis.tasks import SAME, PositionTask

OFF_CURVE = {
    True: message(
        "The given pivot ({x:.6g}, {y:.6g}) is not on the circle-point curve of the four positions: its nearest point "
        "({u:.6g}, {v:.6g}), at a distance of {distance:.4g}, was taken."
    ),
    False: message(
        "The given pivot ({x:.6g}, {y:.6g}) is not on the centre-point curve of the four positions: its nearest point "
        "({u:.6g}, {v:.6g}), at a distance of {distance:.4g}, was taken."
    ),
}
"""By whether it is a pivot of the body."""
_OUTSIDE = message(
    "With the given pivot ({x:.6g}, {y:.6g}) a pivot of the frame is at ({u:.6g}, {v:.6g}), outside the region: no "
    "design with it meets all demands."
)


def notes_on_pivots(task: PositionTask, dyads: Sequence[GuidingDyad], demands: Demands) -> Iterator[Message]:
    """Which points of their curves are taken for given pivots, and which lead to a pivot of the frame that is excluded.

    Args:
        task: three or four positions.
        dyads: those of the given pivots, first of the body, then of the frame.
        demands: with the region.
    """
    given = [(True, pivot) for pivot in task.moving_pivots] + [(False, pivot) for pivot in task.fixed_pivots]
    for (moving, (x, y)), dyad in zip(given, dyads, strict=False):
        taken = dyad.moving if moving else dyad.fixed
        distance = abs(taken - complex(x, y))
        if distance > SAME * max(task.size, abs(taken)):
            yield OFF_CURVE[moving].filled(x=x, y=y, u=taken.real, v=taken.imag, distance=distance)
        if not dyad.slides and not inside_region(np.array([dyad.fixed]), demands)[0]:
            yield _OUTSIDE.filled(x=x, y=y, u=dyad.fixed.real, v=dyad.fixed.imag)
