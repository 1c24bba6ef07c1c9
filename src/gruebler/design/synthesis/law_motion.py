"""Whether a design that meets pairs of a function follows it over the whole interval: by its motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import message
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.targets import Probe
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.solve import move_quietly

_PLACES = 400  # where the error of a function is looked at


def over_interval(design: Design, task: FunctionTask) -> Design:
    """An accepted design with its largest error over the interval of the function, seen at 400 places.

    It is rejected if its drive cannot go through the interval; a table of pairs has none.

    Args:
        design: with the values of its one drive at the pairs and its targets, of the crank, then of the output.
        task: pairs of a function.

    Cost: 1 ms.
    """
    law, targets = task.law, design.targets
    if law is None or targets is None or not (design.verdict.accepted and design.drives):
        return design
    x = np.linspace(*law.interval, _PLACES)
    turned = np.concatenate([[0.0], law.inputs(x) - task.inputs[0]])  # from the first pair, where the design stands
    sense = np.sign((task.inputs[-1] - task.inputs[0]) * (design.drives[-1] - design.drives[0]))
    motion = move_quietly(design.linkage, design.drives[0] + sense * turned)
    verdict = design.verdict
    if motion.stop is not None:
        reason = message("it does not go through the whole interval of the function: {stop}", stop=motion.stop.message)
        return replace(design, verdict=replace(verdict, reasons=(reason,)))
    crank, output = (_beyond_first(probe, motion, targets.values[0, k]) for k, probe in enumerate(targets.probes))
    begin, rate = law.inputs(x[:1])[0], (law.inputs(x[-1:])[0] - law.inputs(x[:1])[0]) / (x[-1] - x[0])
    own = np.clip(x[0] + (task.inputs[0] + crank - begin) / rate, *law.interval)  # where the first pair is nearly met
    gaps = output - (law.outputs(own) - task.outputs[0])
    return replace(design, verdict=replace(verdict, over_interval=float(np.abs(gaps[1:]).max())))


def _beyond_first(probe: Probe, motion: Motion, first: complex) -> Reals:
    """(rows,) by how much an angle or a travel exceeds that of the first target."""
    if not probe.link:
        return np.asarray(probe.of_motion(motion).real - first.real)
    angle = motion.angle(probe.link)
    return np.asarray(angle - angle[0] + np.angle(np.exp(1j * angle[0]) / first))
