"""One pivot is given for two to four positions: the best others beside it, simulated, and what is proved of them."""

import re

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PositionTask, synthesise_positions
from gruebler.design.synthesis.dyads import CRANK, Displacements, GuidingDyad
from gruebler.design.synthesis.pair_search import pair_facts

from .test_simulated_verdicts import passes, pivots_of, simulated

ROWS = [(0, 0, 0), (2.1, 0.9, 20), (3.2, 1, 46), (4, 0.2, 86)]
PIVOT = (0.0, -3.0)


def given(count, kind):
    rows = [(x, y, np.radians(angle)) for x, y, angle in ROWS[:count]]
    return PositionTask(rows, **{kind: [PIVOT]})


@pytest.mark.parametrize("kind", ["fixed_pivots", "moving_pivots"])
@pytest.mark.parametrize("count", [2, 3, 4])
def test_others_are_sought_beside_a_single_pivot(count, kind):
    """Each four-bar has the pivot (of four positions the nearest point of its curve), and does it by simulation."""
    task = given(count, kind)
    designs = synthesise_positions(task, number=8).designs
    four_bars = np.array([pivots_of(design) for design in designs if design.form == "RR-RR"])
    assert len(four_bars) >= 4
    assert {design.form for design in designs} - {"RR-RR"}  # slides stand beside the pivot, too
    ends = four_bars[:, [0, 3]] if kind == "fixed_pivots" else four_bars[:, [1, 2]]
    nearest = min(ends[0], key=lambda end: np.abs(ends - end).min(axis=1).max())
    own = complex(*PIVOT) if count < 4 else nearest
    assert np.abs(ends - own).min(axis=1) == pytest.approx(0, abs=1e-9)
    z, turns = task.origins, np.exp(1j * (task.angles - task.angles[0]))
    moved = z + (four_bars[:, 1:3, None] - z[0]) * turns
    reached = zip(*simulated(four_bars.T, moved.transpose(1, 0, 2)), strict=True)
    assert all(passes(*both, tuple(range(count))) for both in reached)


def beside(task, rng, count):
    """Random dyads of three positions: the pivot of the frame is where two bisectors of the body's pivot meet."""
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    for x in rng.normal(size=(count, 2)) * 3:
        places = displacements.images(complex(*x))
        arms = places[1:] - places[0]
        rows = np.stack([arms.real, arms.imag], axis=1)
        if np.linalg.cond(rows) < 1e6:
            m = complex(*np.linalg.solve(rows, (np.abs(places[1:]) ** 2 - np.abs(places[0]) ** 2) / 2))
            if abs(m) < 29:
                yield GuidingDyad(CRANK, complex(*x), m).moved(size, origin)


def test_no_random_four_bar_with_the_pivot_beats_what_is_proved():
    """And the best that is listed comes within the margin of it."""
    task = given(3, "fixed_pivots")
    found = synthesise_positions(task)
    (proved,) = [float(said[1]) for note in found.notes if (said := re.search(r"angle above ([\d.]+)°", str(note)))]
    best = max(d.verdict.transmission for d in found.designs if d.form == "RR-RR")
    assert proved - 0.2 < np.degrees(best) <= proved
    x = np.linalg.lstsq(*_conditions(task, complex(*PIVOT)), rcond=None)[0]
    held = GuidingDyad(CRANK, complex(*x), complex(*PIVOT))
    others = list(beside(task, np.random.default_rng(1), 4000))
    assert len(others) > 2000
    for pair in (([held], others), (others, [held])):
        facts = pair_facts(task, *pair, Demands())
        good = np.logical_and.reduce([flags for _, flags in facts.met(Demands())])
        assert good.any()
        assert np.degrees(facts.transmission[good].max()) <= proved


def _conditions(task, m):
    """The pivot x of the body for one of the frame: |x - m| is that of the inverse images of m, linear in x."""
    seen = task.origins[0] + np.exp(1j * (task.angles[0] - task.angles)) * (m - task.origins)
    arms = seen[1:] - m
    return np.stack([arms.real, arms.imag], axis=1), (np.abs(seen[1:]) ** 2 - np.abs(m) ** 2) / 2


def test_a_pivot_outside_the_region_is_refused():
    with pytest.raises(SynthesisError, match=r"fixed_pivots: \(0, -3\) lies outside the region"):
        synthesise_positions(given(3, "fixed_pivots"), Demands(region=(-1, -1, 1, 1)))


def test_a_pivot_that_moves_in_line_is_that_of_a_slide():
    """Three places on a line; the coupler turns 50 degrees against it, so the angle is 90 - 50/2 at most, by hand."""
    task = PositionTask([(0, 0, 0), (1, 0, np.radians(20)), (2, 0, np.radians(50))], moving_pivots=[(0, 0)])
    found = synthesise_positions(task, number=8)
    assert len(found.designs) == 8
    assert {design.form for design in found.designs} == {"RR-PR"}
    best = max(design.verdict.transmission for design in found.designs)
    assert np.degrees(best) == pytest.approx(65, abs=0.06)


@pytest.mark.parametrize("count", [3, 4])
def test_given_lengths_are_those_of_designs(count):
    """Of crank and frame, and all the way by simulation; no member of a sample has them."""
    task = PositionTask(given(count, "fixed_pivots").positions)
    found = synthesise_positions(
        task, Demands(lengths={"crank": 2.75} | ({} if count > 3 else {"frame": 5.5})), number=6
    )
    four_bars = np.array([pivots_of(design) for design in found.designs if design.form == "RR-RR"])
    assert len(four_bars) >= 2
    assert np.abs(four_bars[:, 1] - four_bars[:, 0]) == pytest.approx(2.75, abs=1e-8)
    if count < 4:
        assert np.abs(four_bars[:, 3] - four_bars[:, 0]) == pytest.approx(5.5, abs=1e-8)
    z, turns = task.origins, np.exp(1j * (task.angles - task.angles[0]))
    moved = z + (four_bars[:, 1:3, None] - z[0]) * turns
    reached = zip(*simulated(four_bars.T, moved.transpose(1, 0, 2)), strict=True)
    assert all(passes(*both, tuple(range(count))) for both in reached)


def test_places_in_sentences_are_those_of_a_task_far_from_the_origin():
    far = [(x + 5000, y + 2000, np.radians(angle)) for x, y, angle in ROWS[:3]]
    with pytest.raises(SynthesisError, match=r"\(5000, 1997\) lies outside the region"):
        synthesise_positions(PositionTask(far, fixed_pivots=[(5000, 1997)]), Demands(region=(5000, 2000, 5003, 2003)))
    turned = [(5003 + 2 * np.cos(a), 2002 + 2 * np.sin(a), a) for a in (0, 0.3, 0.8)]
    with pytest.raises(SynthesisError, match=r"turns about \(5003, 2002\)"):
        synthesise_positions(PositionTask(turned))
