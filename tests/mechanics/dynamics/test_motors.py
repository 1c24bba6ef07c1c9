"""Motors that cannot start, or stall, end a free motion with their reason; figures by hand: a weight on a crank."""

import math

import pytest

from gruebler.mechanics.dynamics import simulate
from gruebler.mechanics.forces import Loads, Motor, RigidBody
from gruebler.mechanics.fourbar import FourBar

FOUR_BAR = FourBar(25, 70, 40, 70).linkage()
WEIGHT = 4 * 9.80665 * 25  # N mm, of 4 kg at the crank pin when the crank is level


def driven(stall, at, until=1.0):
    loads = Loads(bodies={"crank": RigidBody(4.0, (25, 0))}, motors={"R(frame-crank)": Motor(stall, 60.0)})
    return simulate(FOUR_BAR, loads, until=until, branch="+", at=math.radians(at))


def test_a_motor_that_is_too_weak_does_not_start():
    run = driven(900, at=0)
    assert len(run) == 1
    assert not run.complete
    assert run.message() == (
        "The motor at R(frame-crank) does not start: at R(frame-crank) = 0° it gives 900 N·mm, and the loads need "
        f"{WEIGHT:g} N·mm."
    )
    assert "läuft nicht an" in run.message("de")


def test_a_motor_that_starts_may_stall_on_its_way_up():
    """From -60° it has 600 N mm against half the weight; where its work is used up the crank turns back."""
    run = driven(600, at=-60)
    assert not run.complete
    assert "The motor at R(frame-crank) stalls at" in run.message()
    top = run.drives[-1, 0]
    assert math.radians(-60) < top < 0
    lifted = WEIGHT * (math.sin(top) + math.sin(math.radians(60)))
    assert lifted < 600 * (top + math.radians(60))  # the work of a motor that loses torque with its speed
    assert lifted == pytest.approx(run.work[-1], rel=0.05)


def test_a_stronger_motor_starts():
    assert driven(1.01 * WEIGHT, at=0, until=0.05).complete
