"""The line through the fixed pivots has a given direction: kept by every search, with random linkages beside it."""

from cmath import phase

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    PathTask,
    PositionTask,
    synthesise,
    synthesise_path,
    synthesise_positions,
)
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.pair_facts import pair_facts
from gruebler.files.specifications import specification_from_json

from .test_simulated_verdicts import passes, pivots_of, simulated
from .test_structure_limits import WATT

ROWS = [(0, 0, 0), (1.5, 0.8, np.radians(12)), (2.5, 1.2, np.radians(25)), (3.2, 1, np.radians(46))]
DIRECTION = np.radians(20)
POINTS = [(0, 0), (1, 0.9), (2.2, 1.2), (3.1, 0.8), (4, 0.1)]


def off(linkage, direction=DIRECTION):
    """The least angle of a line through two pivots of the frame with the direction, in degrees."""
    frame = linkage.mechanism.frame
    pins = [complex(e.x, e.y) for (_, link), e in linkage.elements.items() if link == frame and e.is_pin]
    gaps = [p - q for k, p in enumerate(pins) for q in pins[:k]]
    return min(abs(np.degrees(phase((gap * np.exp(-1j * direction)) ** 2)) / 2) for gap in gaps)


@pytest.mark.parametrize("lengths", [(), (("frame", 4.0),)], ids=["free", "with a length"])
@pytest.mark.parametrize("count", [2, 3, pytest.param(4, marks=pytest.mark.slow)])
def test_designs_have_the_direction_and_pass_by_simulation(count, lengths):
    task = PositionTask(ROWS[:count])
    found = synthesise_positions(task, Demands(frame_direction=DIRECTION, lengths=lengths), number=6)
    four_bars = [design for design in found.designs if design.form == "RR-RR"]
    assert len(four_bars) >= 2
    assert max(off(design.linkage) for design in found.designs) < 1e-6
    assert "RR-PR" not in {design.form for design in found.designs}  # one pivot only
    pivots = np.array([pivots_of(design) for design in four_bars])
    if lengths:
        assert np.abs(pivots[:, 3] - pivots[:, 0]) == pytest.approx(4)
    z, turns = task.origins, np.exp(1j * (task.angles - task.angles[0]))
    moved = z + (pivots[:, 1:3, None] - z[0]) * turns
    reached = zip(*simulated(pivots.T, moved.transpose(1, 0, 2)), strict=True)
    assert all(passes(*both, tuple(range(count))) for both in reached)


def dyads_of(task, fixed, rng):
    """A dyad of three positions for each fixed pivot: seen from the body that pivot lies on a circle about the other.

    A random pivot of the frame where there is none.
    """
    z, turns = task.origins, np.exp(1j * (task.angles - task.angles[0]))
    for m in fixed if fixed is not None else rng.normal(size=(1500, 2)) @ [6, 6j] + np.mean(z):
        seen = (m - z) / turns + z[0]
        arms = np.stack([(seen[1:] - seen[0]).real, (seen[1:] - seen[0]).imag], axis=1)
        x = np.linalg.solve(arms, (np.abs(seen[1:]) ** 2 - np.abs(seen[0]) ** 2) / 2)
        yield GuidingDyad(CRANK, complex(*x), complex(m))


def test_no_random_four_bar_with_the_direction_is_better():
    """Pivots of the frame on a random line of the direction, those of the body from three distances alone."""
    task, rng = PositionTask(ROWS[:3]), np.random.default_rng(5)
    demands = Demands(frame_direction=DIRECTION)
    found = synthesise_positions(task, demands, sort=["transmission"])
    best = max(d.verdict.transmission for d in found.designs if d.form == "RR-RR")
    angles = []
    for own in dyads_of(task, None, rng):
        beside = own.fixed + np.exp(1j * DIRECTION) * rng.normal(size=4) * 8
        facts = pair_facts(task, [own], list(dyads_of(task, beside, rng)), Demands())
        good = np.logical_and.reduce([flags for _, flags in facts.met(Demands())])
        angles += [*facts.transmission[good]]
    assert len(angles) > 200
    assert max(angles) < best + np.radians(0.1)
    assert max(angles) > best - np.radians(15)  # the sample comes near


@pytest.mark.parametrize("closed", [False, True], ids=["points", "curve"])
def test_paths_with_the_direction(closed):
    around = np.exp(1j * np.linspace(0, 2 * np.pi, 40, endpoint=False))
    curve = [(z.real * 3, z.imag + 0.3 * (z * z).real) for z in around]
    task = PathTask(curve, closed=True) if closed else PathTask(POINTS)
    found = synthesise_path(task, Demands(frame_direction=DIRECTION, tolerance=0.05 if closed else 1e-8), number=4)
    assert found.designs
    assert {design.form for design in found.designs} == {"four-bar"}
    assert max(off(design.linkage) for design in found.designs) < 1e-4


def test_larger_linkages_have_the_direction():
    demands = Demands(frame_direction=DIRECTION)
    found = synthesise(PositionTask(ROWS[:3]), structures=[WATT], link="4", demands=demands, starts=3)
    assert found.designs
    assert max(off(design.linkage) for design in found.designs) < 1e-4


def test_both_given_pivots_have_a_direction_of_their_own():
    task = PositionTask(ROWS[:3], fixed_pivots=[(0, -3), (4, -3)])
    found = synthesise_positions(task, Demands(frame_direction=DIRECTION))
    assert not found.designs
    assert all("the direction of the frame is not 20°, but 0°" in str(d.verdict.reasons[0]) for d in found.rejected)
    along = synthesise_positions(task, Demands(frame_direction=np.pi))
    assert not any("direction" in str(reason) for d in along.rejected for reason in d.verdict.reasons)


def test_a_task_without_a_place_and_no_angle_are_refused():
    with pytest.raises(SynthesisError, match="only for tasks with positions or points"):
        synthesise(DeadCentreTask(swing=1.0, time_ratio=1.2), demands=Demands(frame_direction=0.0))
    for wrong in ("30", np.nan, np.inf, True):
        with pytest.raises(SynthesisError, match="frame_direction: expected an angle"):
            Demands(frame_direction=wrong)


def test_files_give_the_direction_in_degrees():
    document = {"positions": [[0, 0, 0], [1, 0, 10], [2, 1, 30]], "demands": {"frame_direction": 30}}
    assert specification_from_json(document).demands.frame_direction == pytest.approx(np.pi / 6)
