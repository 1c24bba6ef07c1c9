"""Geneva drives: the closed forms against pin-in-slot geometry, numerical extremes, and printed figures."""

import math
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.machines.geneva import Geneva, GenevaError

DRIVES = [Geneva(n, internal=internal) for n, internal in product((3, 4, 5, 6, 8, 12, 40), (False, True))]
DRIVES += [Geneva(3, pins=6), Geneva(4, pins=3), Geneva(5, pins=3), Geneva(6, pins=2), Geneva(6, pins=3)]


def test_the_figures_of_the_reference():
    """Geneva with 4 slots: reference data to documents 000 and 003, section B4."""
    cross = Geneva(4)
    assert cross.crank_ratio == pytest.approx(0.7071067811865475, abs=1e-15)
    assert cross.greatest_ratio == pytest.approx(2.4142135623730945, rel=1e-14)
    assert (cross.motion_fraction, cross.dwell_fraction) == (0.25, 0.75)
    assert math.degrees(2 * cross.engaged) == pytest.approx(90)
    assert cross.entry_acceleration == pytest.approx(0.9999999999999999)
    assert cross.greatest_acceleration == pytest.approx(5.406981034551917, rel=1e-13)
    assert math.degrees(cross.greatest_acceleration_at) == pytest.approx(11.463744916690658, abs=1e-6)


@pytest.mark.parametrize(
    ("slots", "ratio", "start", "peak", "at"),
    [
        (3, 6.46, 1.732, 31.44, "4°46'"),
        (4, 2.41, 1.000, 5.409, "11°24'"),
        (5, 1.43, 0.7265, 2.299, "17°34'"),
        (6, 1.00, 0.5774, 1.350, "22°54'"),
        (8, 0.620, 0.4142, 0.700, "31°39'"),
    ],
)
def test_the_table_of_external_drives(slots, ratio, start, peak, at):
    """Sclater and Chironis, Mechanisms and Mechanical Devices Sourcebook, external Geneva wheels, to their digits."""
    drive = Geneva(slots)
    assert drive.greatest_ratio == pytest.approx(ratio, rel=5e-3)
    assert drive.entry_acceleration == pytest.approx(start, abs=5e-5 if slots != 3 else 5e-4)
    assert drive.greatest_acceleration == pytest.approx(peak, rel=3e-3)
    if at:
        degrees, minutes = at.rstrip("'").split("°")
        assert math.degrees(drive.greatest_acceleration_at) == pytest.approx(int(degrees) + int(minutes) / 60, abs=0.15)


@pytest.mark.parametrize("drive", DRIVES)
def test_the_pin_lies_in_its_slot(drive):
    """Oracle: the wheel's angle as the direction in which the pin is seen from the wheel's axis."""
    phi = np.linspace(-drive.engaged, drive.engaged, 201)
    lam = drive.crank_ratio
    pin = lam * np.exp(1j * phi)
    wheel = -1 + 0j if drive.internal else 1 + 0j
    seen = np.angle((pin - wheel) / -wheel)
    moved = drive.move(phi)
    assert moved.angle == pytest.approx(seen, abs=1e-14)
    assert not moved.dwell.any()


@pytest.mark.parametrize("drive", DRIVES)
def test_extremes_are_those_of_the_motion(drive):
    phi = np.linspace(-drive.engaged, drive.engaged, 20001)
    moved = drive.move(phi)
    assert np.abs(moved.ratio).max() == pytest.approx(drive.greatest_ratio, rel=1e-12)
    assert np.abs(moved.acceleration).max() == pytest.approx(drive.greatest_acceleration, rel=1e-5)
    assert np.abs(moved.acceleration).max() <= drive.greatest_acceleration * (1 + 1e-12)
    assert np.abs(moved.acceleration[[0, -1]]) == pytest.approx(drive.entry_acceleration, rel=1e-12)
    assert np.abs(moved.ratio[[0, -1]]).max() < 1e-13


@given(st.sampled_from(DRIVES), st.floats(-0.999, 0.999))
def test_rates_are_derivatives(drive, part):
    h = 1e-5
    at = drive.engaged * 0.99 * part + h * np.array([-1.0, 0.0, 1.0])
    moved = drive.move(at)
    for lower, higher in pairwise((moved.angle, moved.ratio, moved.acceleration, moved.jerk)):
        scale = 1 + abs(higher[1])
        assert (lower[2] - lower[0]) / (2 * h) == pytest.approx(
            higher[1], abs=2e-5 * scale * (1 + drive.greatest_ratio)
        )


@given(st.sampled_from(DRIVES), st.floats(-50, 50))
def test_one_pin_is_one_step(drive, phi):
    pitch = 2 * math.pi / drive.pins
    before, after = drive.move([phi, phi + pitch]).angle
    assert after - before == pytest.approx(drive.step if drive.internal else -drive.step, abs=1e-9)


@pytest.mark.parametrize("drive", DRIVES)
def test_motion_and_dwell_fill_a_turn(drive):
    turn = np.linspace(0, 2 * math.pi, 40001)[:-1]
    moved = drive.move(turn)
    assert drive.motion_fraction + drive.dwell_fraction == pytest.approx(1, abs=1e-15)
    assert moved.dwell.mean() == pytest.approx(drive.dwell_fraction, abs=1e-3)
    assert np.abs(np.diff(moved.angle)).max() < 2 * drive.greatest_ratio * turn[1]
    assert (np.diff(moved.angle) * (1 if drive.internal else -1) > -1e-12).all()
    assert (moved.ratio[moved.dwell] == 0).all()


def test_how_many_pins_have_room():
    assert [Geneva(n).most_pins for n in (3, 4, 5, 6, 7, 100)] == [6, 4, 3, 3, 2, 2]
    assert Geneva(4, pins=4).dwell_fraction == 0
    assert Geneva(6, internal=True).most_pins == 1


def test_sizes_close_the_right_angle():
    for drive in DRIVES:
        sizes = drive.sizes(80)
        assert math.hypot(sizes.crank, sizes.wheel) == pytest.approx(80)
        assert sizes.locking_arc * drive.pins / (2 * math.pi) == pytest.approx(drive.dwell_fraction, abs=1e-12)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Geneva(2), "from 3 to 2,000, not 2"),
        (lambda: Geneva(4.0), "whole number of slots"),
        (lambda: Geneva(True), "whole number of slots"),
        (lambda: Geneva("4"), "whole number of slots"),
        (lambda: Geneva(4, pins=0), "whole number of pins"),
        (lambda: Geneva(4, pins=5), "at most 4 pins, not 5"),
        (lambda: Geneva(4, internal=100), "internal is True or False, not 100"),
        (lambda: Geneva(4, internal=True, pins=2), "an internal Geneva drive with 4 slots takes at most 1"),
        (lambda: Geneva(4).move([0.0, math.nan]), "finite"),
        (lambda: Geneva(4).move("now"), "finite"),
        (lambda: Geneva(4).sizes(0), "positive length, not 0"),
        (lambda: Geneva(4).sizes(math.nan), "positive length, not nan"),
        (lambda: Geneva(4).sizes(math.inf), "positive length, not inf"),
    ],
)
def test_absurd_numbers_are_refused(make, words):
    with pytest.raises(GenevaError, match=words):
        make()
