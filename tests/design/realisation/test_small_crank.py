"""The theorem of the small crank, and the measure of conditioning."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler import Mechanism
from gruebler.design.realisation.layout_program import layout_program
from gruebler.design.realisation.layout_trial import closed_path_quality, range_path
from gruebler.design.realisation.measures import conditioning
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage

MECHANISMS = (
    "R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) P(3-0); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-3); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) P(0-4) R(4-h); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2-3) R(2-4) R(3-5) P(0-4) P(0-5); drive=R(0-1)",
)
CLASS_THREE = MECHANISMS[4]
DRAWN = {
    "R(0-1)": (0, 0),
    "R(1-2)": (0.5, 0.3),
    "R(2-h)": (2, 2),
    "R(0-3)": (5, 0),
    "R(3-h)": (4, 2.2),
    "R(0-4)": (2, 5.5),
    "R(4-h)": (3, 3.5),
}


def measures(motion):
    plan = motion.plan
    return conditioning(plan, plan.program, motion.places[0], motion.turns, motion.roots)


@pytest.mark.parametrize("text", MECHANISMS)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_small_crank_turns_fully(text, seed):
    """Regular in the drawn position: full with a small crank, and hardly less well conditioned."""
    mechanism = Mechanism.parse(text)
    drawn = layout_program(mechanism)
    drawing = drawn.tied(np.random.default_rng(seed).uniform(0, 1, (len(mechanism.chain.joints), 3)))
    assume(all(np.hypot(*(drawing[a, :2] - drawing[b, :2])) > 0.1 for a, b in drawn.pairs))
    mine = [k for k, joint in enumerate(mechanism.chain.joints) if "1" in joint.links]
    drawing[mine, :2] = drawing[0, :2] + 1e-4 * (drawing[mine, :2] - drawing[0, :2])
    setting = drawn.setting(drawn.tied(drawing))
    still = closed_path_quality(drawn, setting, np.zeros((2, 1)))
    assume(still > 0.4)
    turning = closed_path_quality(drawn, setting, range_path(((0.0, 2 * np.pi),), full=True))
    assert turning == pytest.approx(still, abs=0.1)


def test_a_dyads_measure_is_the_sine_of_its_transmission_angle():
    """Oracle: the angle at the inner joint."""
    quad = Mechanism.parse(MECHANISMS[0])
    linkage = Linkage.from_drawing(quad, {0: (0, 0), 1: (0, 25), 2: (70, 60), 3: (70, 0)})
    motion = move(linkage, np.linspace(np.pi / 2, 5, 50))
    a, b, c = (motion.complex_point(name) for name in ("R(1-2)", "R(2-3)", "R(3-0)"))
    assert np.allclose(measures(motion), np.abs(np.sin(np.angle((a - b) / (c - b)))))


def test_a_larger_groups_measure_vanishes_where_its_motion_ends():
    linkage = Linkage.from_drawing(Mechanism.parse(CLASS_THREE), DRAWN)
    motion = move(linkage, np.linspace(np.arctan2(0.3, 0.5), 2, 400))
    assert motion.stop.reason == "singular"
    near = move(linkage, [np.arctan2(0.3, 0.5), motion.stop.drives[0] - 1e-8])
    values = measures(near)
    assert values[0] > 0.05
    assert values[1] < 1e-3


@given(factor=st.floats(0.01, 100), angle=st.floats(0, 6))
def test_the_measure_knows_no_unit_and_no_direction(factor, angle):
    turn = factor * np.exp(1j * angle)
    moved = {name: ((x + 1j * y) * turn) for name, (x, y) in DRAWN.items()}
    mechanism = Mechanism.parse(CLASS_THREE)
    values = [
        measures(move(linkage, [linkage.reference_pose["1"].angle]))
        for linkage in (
            Linkage.from_drawing(mechanism, DRAWN),
            Linkage.from_drawing(mechanism, {name: (z.real, z.imag) for name, z in moved.items()}),
        )
    ]
    assert np.allclose(*values)
