"""Whether a fitted linkage has the dead centres that are wanted, and no others: by its motion over the whole turn.

docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.tasks import DeadCentreTask
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.events import stops
from gruebler.mechanics.analysis.outputs import find_output

_NOT_FULLY = message("the drive does not turn fully")
_OTHERS = message("the dead centres and the crank angle between them are others, by {error:.3g} of the size")


def with_dead_centres(design: Design, task: DeadCentreTask, limit: float) -> Design:
    """The design judged by the dead centres that its output has over a turn of the crank.

    A fit knows its output beside two positions only; elsewhere it may go farther, or turn back once more.

    Args:
        design: judged by what it was fitted to.
        task: swing or stroke, and the crank angle between the dead centres.
        limit: how far both may be missed: the angles in radians, a stroke as a part of the wanted one.
    """
    verdict = design.verdict
    if not verdict.turns_fully:  # without a turn there are no two ways that take their times
        more = () if _NOT_FULLY in verdict.reasons else (_NOT_FULLY,)
        return replace(design, targets=None, verdict=replace(verdict, reasons=(*verdict.reasons, *more)))
    try:
        cycle = drive_cycle(design.linkage)
        centres = stops(cycle, find_output(design.linkage))[0]
    except LinkageError as error:
        reason = message("it cannot be followed from its first position: {error}", error=error)
        return replace(design, targets=None, verdict=replace(verdict, reasons=(*verdict.reasons, reason)))
    back = [centre for centre in centres if centre.kind != "flat"]
    if len(back) != 2:
        reason = message("until its motion repeats the output has {count} dead centres, not two", count=len(back))
        return replace(design, targets=None, verdict=replace(verdict, reasons=(*verdict.reasons, reason)))
    low, high = sorted(back, key=lambda centre: centre.output)
    reach = task.reach
    unit = reach if task.swing is None else 1.0
    turned = (high.drive - low.drive) % cycle.span.period
    ways = turned, cycle.span.period - turned
    of_angle = _apart(ways, task.angle)
    if task.stroke is not None:  # a slide has no sense of its own
        of_angle = min(of_angle, _apart(ways[::-1], task.angle))
    missed = max(abs(high.output - low.output - reach) / unit, of_angle)
    reasons = verdict.reasons
    if missed > limit:
        reasons = (*reasons, _OTHERS.filled(error=missed))
    drives = (low.drive, low.drive + turned)
    return replace(
        design, targets=None, reach=reach, drives=drives, verdict=replace(verdict, error=missed, reasons=reasons)
    )


def _apart(ways: tuple[float, float], angle: float) -> float:
    """How far the crank angles of both ways differ from those that are wanted, at most."""
    return max(abs(ways[0] - angle), abs(ways[1] - (2 * pi - angle)))
