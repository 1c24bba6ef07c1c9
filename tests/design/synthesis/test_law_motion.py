"""Functions are followed over their whole interval, or the design is rejected: limits by the cosine rule."""

import numpy as np
import pytest

from gruebler.design.synthesis import Design, DesignVerdict, function_task
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.law_motion import over_interval
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move


def followed(bar, begin, swing, function="x"):
    """What becomes of a four-bar that stands at the first of five pairs of a function; the interval begins there."""
    law = FunctionLaw(function, interval=(0, 1), input_swing=np.radians(swing), output_swing=np.radians(swing))
    task = function_task(law, 5)
    drives = np.radians(begin) + np.array(task.inputs)
    linkage = bar.linkage()
    linkage = linkage.with_reference_pose(move(linkage, drives[:1]).pose(0))
    turned = np.exp(1j * np.array([drives, np.full(5, linkage.required_pose["rocker"].angle)]).T)
    targets = Targets((Probe(link="crank"), Probe(link="rocker")), turned, 1.0)
    verdict = DesignVerdict(error=0)
    design = Design(linkage=linkage, verdict=verdict, form="four-bar", drives=tuple(drives), targets=targets)
    return task, over_interval(design, task).verdict


@pytest.mark.parametrize(("begin", "swing", "end"), [(30, 50, "77.36"), (60, -50, "14.36"), (70, 8, "77.36")])
def test_a_crank_that_jams_in_the_interval_is_said_with_its_angle(begin, swing, end):
    """Crank and frame 2, coupler 1, rocker 1.5: stretched at cos = (8 - 2.5^2) / 8, folded at (8 - 0.5^2) / 8."""
    _, verdict = followed(FourBar(2, 1, 1.5, 2), begin, swing)
    (reason,) = map(str, verdict.reasons)
    assert "the whole interval" in reason
    assert f"R(frame-crank) = {end}°" in reason


def test_the_error_is_the_largest_over_the_interval():
    """Of a parallelogram the output turns as the crank does: u - u0 instead of u^2 - u0^2, from the first pair on."""
    task, verdict = followed(FourBar(1, 3, 1, 3), 40, np.degrees(1), "x^2")
    u, first = np.linspace(0, 1, 1001), task.inputs[0]
    assert verdict.accepted
    assert verdict.error == 0
    assert verdict.over_interval == pytest.approx(np.abs(u - u**2 - first + first**2).max(), abs=1e-5)
    assert followed(FourBar(2, 1, 1.5, 2), 30, 45)[1].accepted
