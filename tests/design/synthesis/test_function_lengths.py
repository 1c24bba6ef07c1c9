"""Functions with free starts and several given lengths: their ratios are met exactly."""

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, FunctionTask
from gruebler.design.synthesis.functions import synthesise_function

LENGTHS = {"crank": 30.0, "coupler": 80.0, "rocker": 70.0, "frame": 100.0}


def outputs_of(inputs):
    """By hand: where the circle about the crank's pin meets that of the rocker, on one side."""
    a, b, c, d = LENGTHS.values()
    pin = a * np.exp(1j * np.array(inputs))
    gap = d - pin
    along = (b * b - c * c + np.abs(gap) ** 2) / (2 * np.abs(gap))
    end = pin + gap / np.abs(gap) * (along + 1j * np.sqrt(b * b - along**2))
    return np.angle(end - d)


def task_of(inputs):
    outputs = outputs_of(inputs)
    return FunctionTask(
        inputs=tuple(np.subtract(inputs, inputs[0])),
        outputs=tuple(outputs - outputs[0]),
        start_input=False,
        start_output=False,
    )


def lengths_of(design):
    return {
        link: np.ptp([complex(e.x, e.y) for (_, own), e in design.linkage.elements.items() if own == link])
        for link in LENGTHS
    }


@pytest.mark.parametrize(("count", "given"), [(3, ("crank", "rocker", "frame")), (4, ("coupler", "frame"))])
def test_ratios_that_leave_finitely_many_give_the_four_bar_back(count, given):
    task = task_of([0.4, 1.1, 1.9, 2.3][:count])
    found = synthesise_function(task, Demands(lengths={link: LENGTHS[link] for link in given}))
    assert "finitely many" in str(found.notes)
    everyone = [[*map(abs, lengths_of(design).values())] for design in found.designs]
    assert min(np.abs(np.subtract(own, [*LENGTHS.values()])).max() for own in everyone) < 1e-6


def test_a_ratio_is_kept_while_the_family_is_improved():
    task = task_of([0.4, 1.1, 1.9])
    found = synthesise_function(task, Demands(lengths={"crank": 30, "frame": 100}))
    assert len(found.designs) > 3
    for design in found.designs:
        own = {link: abs(length) for link, length in lengths_of(design).items()}
        assert (own["crank"], own["frame"]) == pytest.approx((30, 100), abs=1e-7)
        assert design.verdict.error < 1e-9
