"""Laws of motion: printed peaks, ends, smoothness, boundary values; and the finder of extremes behind them."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.machines.cams import LAWS, Cam, CamError, Roller, boundary_law, motion_law, polynomial_law, read_lift
from gruebler.machines.cams.extremes import extremes

RESTING = ["3-4-5", "4-5-6-7", "5-6-7-8-9", "cycloidal", "modified-sine", "modified-trapezoid", "harmonic", "parabolic"]


@pytest.mark.parametrize(
    ("name", "velocity", "acceleration", "jerk", "torque"),
    [
        ("3-4-5", 1.875, 5.7735, 60, 6.69),
        ("4-5-6-7", 2.1875, 7.5132, 52.5, 10.75),
        ("cycloidal", 2, 6.2832, 39.478, 8.16),
        ("modified-sine", 1.7596, 5.5280, 69.47, 5.46),
        ("modified-trapezoid", 2, 4.8881, 61.43, 8.09),
        ("harmonic", 1.5708, 4.9348, 15.503, 3.88),
        ("parabolic", 2, 4, 0, 8),
    ],
)
def test_printed_peaks(name, velocity, acceleration, jerk, torque):
    """VDI 2143 part 1, table of the normalised laws; Norton, Design of Machinery, table 8-2 and 8-3."""
    peaks = motion_law(name).peaks()
    assert peaks.velocity == pytest.approx(velocity, abs=5e-5)
    assert peaks.acceleration == pytest.approx(acceleration, abs=5e-5)
    assert peaks.jerk == pytest.approx(jerk, abs=5e-3)
    assert peaks.torque == pytest.approx(torque, abs=5e-3)


def test_peaks_in_closed_form():
    pi = math.pi
    assert motion_law("3-4-5").peaks()[:3] == pytest.approx((15 / 8, 10 / math.sqrt(3), 60), rel=1e-12)
    assert motion_law("cycloidal").peaks()[:3] == pytest.approx((2, 2 * pi, 4 * pi**2), rel=1e-12)
    assert motion_law("modified-sine").peaks()[1:3] == pytest.approx(
        (4 * pi**2 / (pi + 4), 16 * pi**3 / (pi + 4)), rel=1e-12
    )
    trapezoid = motion_law("modified-trapezoid").peaks()
    assert trapezoid[1:3] == pytest.approx((8 * pi / (pi + 2), 32 * pi**2 / (pi + 2)), rel=1e-12)


@pytest.mark.parametrize("name", RESTING)
def test_from_rest_to_rest(name):
    one = motion_law(name)
    assert one.at([0.0, 1.0]) == pytest.approx([0, 1], abs=1e-12)
    assert one.at([0.0, 1.0], 1) == pytest.approx([0, 0], abs=1e-12)
    x = np.linspace(0, 1, 501)
    assert one.at(x) + one.at(1 - x) == pytest.approx(1, abs=1e-11)
    assert (np.diff(one.at(x)) > -1e-15).all()


@pytest.mark.parametrize("name", [name for name in RESTING if len(motion_law(name).pieces) > 1])
def test_pieces_join(name):
    """Lift and velocity never jump; the acceleration only where the parabola changes its sign."""
    for before, after in pairwise(motion_law(name).pieces):
        at = np.array(after.start)
        for order in range(2 if name == "parabolic" else 3):
            assert before.at(at, order) == pytest.approx(after.at(at, order), abs=1e-11)


@given(st.sampled_from(RESTING), st.floats(0.001, 0.999), st.integers(0, 2))
def test_derivatives(name, x, order):
    one, h = motion_law(name), 1e-6
    assume(min(abs(x - joint) for joint in one.joints) > 2 * h)
    slope = (one.at(x + h, order) - one.at(x - h, order)) / (2 * h)
    assert slope == pytest.approx(float(one.at(x, order + 1)), abs=1e-6 * 10 ** (order + 1))


values = st.lists(st.floats(-5, 5), min_size=1, max_size=4)


@given(values, values)
def test_boundary_values_are_met(start, end):
    one = boundary_law(start, end)
    scale = 1e-9 * (1 + max(map(abs, one.pieces[0].polynomial))) * 10
    assert [float(one.at(0.0, k)) for k in range(len(start))] == pytest.approx(start, abs=scale)
    assert [one.end(k) for k in range(len(end))] == pytest.approx(end, abs=scale * 100)
    assert len(one.pieces[0].polynomial) == len(start) + len(end)


@pytest.mark.parametrize("powers", [(3, 4, 5), (4, 5, 6, 7), (5, 6, 7, 8, 9)])
def test_two_ways_to_a_polynomial(powers):
    m = len(powers)
    by_ends = boundary_law((0,) * m, (1,) + (0,) * (m - 1)).pieces[0].polynomial
    assert polynomial_law(*powers).pieces[0].polynomial == pytest.approx(by_ends, abs=1e-8)


def test_names():
    assert all(motion_law(name) == motion_law(target) for name, target in LAWS.items())
    assert motion_law("2-3").peaks()[:2] == pytest.approx((1.5, 6))
    assert motion_law("Cycloidal") == motion_law("sine")


@given(st.lists(st.tuples(st.floats(0.1, 3), st.integers(1, 9), st.floats(0, 6)), min_size=1, max_size=4))
def test_no_extreme_is_lost(waves):
    """Oracle: nothing on a fine grid is above the greatest or below the least of the extremes found."""

    def function(x):
        return sum(a * np.sin(k * x + p) for a, k, p in waves)

    found = [value for _, value in extremes(function, 0.3, 5.0)]
    grid = function(np.linspace(0.3, 5.0, 4001))
    size = sum(abs(a) for a, _, _ in waves)
    assert max(found) >= grid.max() - 1e-10 * size
    assert min(found) <= grid.min() + 1e-10 * size


def test_extremes_between_samples_of_constants_and_at_poles():
    inner = [x for x, _ in extremes(lambda x: np.cos(30 * x), 0.01, 3.0)[1:-1]]
    assert inner == pytest.approx(np.arange(1, 29) * math.pi / 30, abs=1e-12)
    assert extremes(np.ones_like, 0, 1) == [(0, 1), (1, 1)]
    assert max(y for _, y in extremes(lambda x: np.sqrt(np.abs(x)), -1, 1)) == pytest.approx(1)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: motion_law("cycloid"), "did you mean 'cycloidal'"),
        (lambda: motion_law(""), "no law is called ''"),
        (lambda: motion_law("3-3-5"), "different"),
        (lambda: motion_law("0-4"), "whole powers from 1 to 15"),
        (lambda: motion_law("99"), "whole powers"),
        (polynomial_law, "whole powers"),
        (lambda: polynomial_law(2.5), "whole powers"),
        (lambda: boundary_law((), (1,)), "boundary values"),
        (lambda: boundary_law((0,), (math.nan,)), "finite"),
        (lambda: boundary_law((0,) * 9, (0,) * 9), "at most 16"),
    ],
)
def test_absurd_laws_are_refused(make, words):
    with pytest.raises(CamError, match=words):
        make()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("rise 1e200 90; fall 1e200 90; dwell", "expected a number below 1e\\+70, not '1e200'"),
        ("rise 1e-200 90; fall 1e-200 90; dwell", "between 1e-70 and 1e\\+70"),
        ("rise 10 1e-30; fall 10 90; dwell", "angle from 1e-09 to 2 pi"),
        ("rise 20 60 v1=1e90; fall 20 90; dwell", "below 1e\\+70"),
    ],
)
def test_lifts_beyond_all_measure_are_refused(text, words):
    with pytest.raises(CamError, match=words):
        read_lift(text)


@pytest.mark.parametrize("lift", [1e12, 1e60])
def test_a_lift_has_to_do_with_its_base_circle(lift):
    with pytest.raises(CamError, match=r"more than 1e9 times the base circle's 20"):
        Cam(read_lift(f"rise {lift} 90; fall {lift} 90; dwell"), base=20, follower=Roller(5))


@pytest.mark.parametrize("size", [1e-60, 1e-6, 1.0, 1e60])
def test_lifts_of_all_other_sizes_are_kept(size):
    lift = read_lift(f"rise {size} 90; fall {size} 90; dwell")
    assert max(value for _, value in lift.extremes(0)) == pytest.approx(size)
