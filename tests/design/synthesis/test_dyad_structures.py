"""A crank and dyads, turning and sliding: planes as `move` places them, and a crank that turns as a limit."""

import numpy as np
import pytest

from gruebler import _core
from gruebler.design.realisation import realise
from gruebler.design.synthesis import Demands, PositionTask
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.dyad_structures import dyad_structure
from gruebler.design.synthesis.size_limits import limits_of_sizes
from gruebler.design.synthesis.structures import fit_structure
from gruebler.mechanics.kinematics import circuit, move
from gruebler.structure.mechanism import Mechanism

DYADS = {
    "RRR": "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)",
    "RRP": "R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)",
    "PRR": "R(0-1) P(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)",
    "RPR": "R(0-1) R(1-2) P(2-3) R(3-0); frame=0; drive=R(0-1)",
    "PRP": "R(0-1) P(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)",
    "RPP": "R(0-1) R(1-2) P(2-3) P(3-0); frame=0; drive=R(0-1)",
    "slider on a four-bar": "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) P(5-0); frame=0; drive=R(0-1)",
}


def turning_crank(linkage, pose):
    closure = DesignClosure(linkage)
    wanted = Demands(crank=True, size_ratio=np.inf)
    return limits_of_sizes(closure, wanted, pose, closure.sizes, held=frozenset(), unit=linkage.size)


@pytest.mark.parametrize("name", DYADS)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_planes_of_all_dyads_are_those_of_move(name, seed):
    linkage = realise(Mechanism.parse(DYADS[name]), seed=seed, budget=300).linkage
    closure, course = DesignClosure(linkage), circuit(linkage)
    motion = move(linkage, course.drive[:20])
    structure = dyad_structure(linkage.mechanism, sliding=True)
    limits = turning_crank(linkage, closure.poses(course.at(np.zeros(1)))[0])
    linkages = limits.crank._linkages(closure.sizes[:, None])
    turns, shifts = _core.move_planes(*linkages, motion.angle(structure.crank)[None])
    for number, link in enumerate(structure.placed_links):
        assert np.abs(turns[number, 0] - np.exp(1j * motion.angle(link))).max() < 1e-9
        assert np.abs(shifts[number, 0] - motion.complex_point((link, 0.0, 0.0))).max() < 1e-9 * linkage.size


@pytest.mark.parametrize("name", DYADS)
def test_a_crank_turns_fully_exactly_within_the_limit(name):
    """By `move` over a whole turn, on the side on which the linkage stands."""
    turning = set()
    for seed in range(1, 13):
        linkage = realise(Mechanism.parse(DYADS[name]), seed=seed, budget=300).linkage
        closure, course = DesignClosure(linkage), circuit(linkage)
        limits = turning_crank(linkage, closure.poses(course.at(np.zeros(1)))[0])
        worst = limits.values(closure.sizes[:, None], np.zeros((1, 0))).max()
        complete = move(linkage, course.drive[0] + np.linspace(0, 2 * np.pi, 721)).complete
        assert (worst < 0) == complete or abs(worst) < 2e-4
        turning.add(complete)
    # A line on the crank is parallel to one on the frame twice a turn.
    assert (True in turning) == (name != "PRP")


SLIDING = {
    "slider on a four-bar": DYADS["slider on a four-bar"],
    "dyad on a slider-crank": "R(0-1) R(1-2) R(2-3) P(3-0) R(0-4) R(4-5) R(5-2); frame=0; drive=R(0-1)",
}


@pytest.mark.parametrize("name", SLIDING)
def test_a_crank_turns_fully_in_structures_with_slides(name):
    """Four positions that were met by a crank that swings; `move` turns the one that is found now."""
    task = PositionTask([(-0.9, 0.0, 0.0), (-0.1, 0.3, 0.0), (-0.1, -0.2, -0.4), (-0.7, 0.2, -0.6)])
    design = fit_structure(task, Mechanism.parse(SLIDING[name]), Demands(crank=True, tolerance=1e-3), seed=1)
    assert design.verdict.accepted
    linkage = design.linkage
    assert move(linkage, circuit(linkage).drive[0] + np.linspace(0, 2 * np.pi, 721)).complete


def test_drawings_have_turning_joints_and_larger_groups_none():
    assert all(dyad_structure(Mechanism.parse(text)) is None for name, text in DYADS.items() if name != "RRR")
    triad = Mechanism.parse("R(0-1) R(1-3) R(3-2) R(2-4) R(2-5) R(4-0) P(5-0); frame=0; drive=R(0-1)")
    assert dyad_structure(triad, sliding=True) is None
