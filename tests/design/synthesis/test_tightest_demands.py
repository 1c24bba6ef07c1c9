"""Where no design meets all demands, the tightest one is named: curves, mixed targets, rests, finite lists."""

from math import cos, radians, sin

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, DwellTask, PathTask, PositionTask, synthesise, synthesise_structures
from gruebler.structure.mechanism import Mechanism

TEARDROP = [(cos(t), sin(t) * sin(t / 2) ** 3) for t in np.linspace(0, 2 * np.pi, 24, endpoint=False).tolist()]
AGAIN = "No design meets all demands. A second search left them out; these are the numbers of its designs:"
BUT = "Designs that meet all but the demand of {}: {}."
FOUR_BAR = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)")
STEEP = {"transmission": radians(80), "size_ratio": 2.5}


def said(task, **demands):
    found = synthesise(task, demands=Demands(**demands))
    assert not found.designs
    return [str(note) for note in found.notes]


@pytest.mark.parametrize(
    ("task", "demands", "named"),
    [
        (PathTask(TEARDROP, closed=True), STEEP, "a transmission angle of 80°"),
        pytest.param(
            PathTask(TEARDROP, closed=True, fixed_pivots=[(0, -2)]), {}, "the given pivots", marks=pytest.mark.slow
        ),
        pytest.param(
            DwellTask(dwell=radians(90), swing=radians(30)),
            STEEP,
            "a transmission angle of 80° and a size ratio of 2.5",
            marks=pytest.mark.slow,
        ),
        (
            PathTask(
                [(0, 0), (12, 9), None, (38, 10), (50, 0)],
                angles=(0, None, -0.14, None, -0.35),
                crank_angles=(0, None, 1.05, None, None),
                output_angles=(0, None, None, None, 0.44),
                tolerances=(0, 1, 0.02, 1, 0),
            ),
            {**STEEP, "region": (-20, -20, 0, 0)},
            "a transmission angle of 80° and the region of the fixed pivots",
        ),
    ],
)
def test_the_demand_that_is_met_last_is_named_with_a_count(task, demands, named):
    """A second search without the demands has designs, whose verdicts say which of them each fails in."""
    notes = said(task, **demands)
    at = notes.index(AGAIN)
    count = int(notes[at + 1].rpartition(": ")[2].strip(".").replace(",", ""))
    assert (notes[at + 1], count > 0) == (BUT.format(named, f"{count:,}"), True)


def test_of_finitely_many_designs_those_that_fail_in_one_demand_are_counted():
    """The count is that of the designs that are accepted without the demand."""
    # A crank of 1, a coupler of 3, a rocker of 2.5, a frame of 3.5, closed by the law of cosines.
    pins = np.exp(1j * np.array([0.3, 0.8, 1.3, 1.8, 2.4]))
    way = 3.5 - pins
    turns = np.angle(way) + np.arccos((9 + np.abs(way) ** 2 - 2.5**2) / (6 * np.abs(way)))
    task = PositionTask([(float(z.real), float(z.imag), float(t)) for z, t in zip(pins, turns, strict=True)])
    free = synthesise(task, demands=Demands(size_ratio=100))
    assert free.designs
    steepest = max(design.verdict.transmission for design in free.designs)
    steep = {"transmission": min(steepest + 0.01, 1.57), "size_ratio": 100}
    angle = np.degrees(steep["transmission"])
    assert BUT.format(f"a transmission angle of {angle:g}°", len(free.designs)) in said(task, **steep)


def test_points_and_lengths_that_leave_nothing_free_are_said_to():
    """Seven points, a frame's length and its direction are as many equations as a four-bar has numbers."""
    points = [(t * 4, 1.2 * sin(2.2 * t)) for t in np.linspace(0, 1, 7).tolist()]
    given = Demands(crank=True, lengths={"frame": 3}, frame_direction=0.0, transmission=1.5)
    found = synthesise(PathTask(points), demands=given)
    assert found.count.theorem == 0
    assert "leave finitely many linkages, or none" in str(found.notes[0])


def test_improved_initial_designs_are_those_that_were_asked_for():
    """One job of an atlas improves many: it was counted as one."""
    found = synthesise_structures(PathTask(TEARDROP, closed=True), [FOUR_BAR], starts=3)
    assert str(found.notes[0]).startswith("Initial designs improved: 3.")
