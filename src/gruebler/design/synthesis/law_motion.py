"""Whether a design that meets pairs of a function follows it over the whole interval: by its motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gruebler.base.text import message
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.kinematics.solve import move_quietly

_PLACES = 400  # where the error of a function is looked at


def over_interval(design: Design, task: FunctionTask, output: str = "") -> Design:
    """An accepted design, rejected if its drive cannot go through the interval of the function; others as they are.

    Args:
        design: with the values of its one drive at the pairs.
        task: pairs of a function, or of a table, which has no interval.
        output: the link whose angle is the output: then the error of the verdict is the largest over the interval, in
            radians, seen at 400 places.

    Cost: 1 ms.
    """
    law = task.law
    if law is None or not (design.verdict.accepted and design.drives):
        return design
    x = np.linspace(*law.interval, _PLACES)
    turned = np.concatenate([[0.0], law.inputs(x) - task.inputs[0]])  # from the first pair, where the design stands
    sense = np.sign((task.inputs[-1] - task.inputs[0]) * (design.drives[-1] - design.drives[0]))
    motion = move_quietly(design.linkage, design.drives[0] + sense * turned)
    verdict = design.verdict
    if motion.stop is not None:
        reason = message("it does not go through the whole interval of the function: {stop}", stop=motion.stop.message)
        return replace(design, verdict=replace(verdict, reasons=(reason,)))
    if output:
        angle = motion.angle(output)
        gaps = angle[1:] - angle[0] - (law.outputs(x) - task.outputs[0])
        verdict = replace(verdict, error=float(np.abs(gaps).max()))
    return replace(design, verdict=verdict)
