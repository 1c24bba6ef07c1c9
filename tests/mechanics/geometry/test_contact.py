"""Taylor series of linkages, and the order in which a path touches its tangent."""

import math
from math import factorial

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry import coupler_curve, tangent_contact, taylor_series
from gruebler.mechanics.geometry.curvature import inflection_circle, path_curvature
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, LinkPoint

from .linkages import CYLINDER, MOVING

LENKER = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4).linkage({"K": (8.018753738744802, 2.268046058132576)})


@pytest.mark.parametrize("name", MOVING)
def test_rivals_up_to_the_third_order(name):
    """The kernels' velocities, accelerations and jerks."""
    linkage, rows, one, _ = MOVING[name]
    motion = move(linkage, rows[::25], speed=1, order=3)
    found = taylor_series(motion, 3)
    for k in range(4):
        exact = motion.complex_point("K", order=k)
        assert abs(found.complex_point("K")[k] * factorial(k) - exact).max() < 1e-12 * abs(exact).max()
    assert found.order == 3
    k = motion.link_index(one)
    assert np.allclose(found.turns[1, :, k], 1j * motion.angular(one) * motion.turns[:, k], atol=1e-13)


@pytest.mark.parametrize("name", MOVING)
def test_oracle_the_sum_of_the_series(name):
    """A little further on the polynomial is the motion itself."""
    linkage, rows, *_ = MOVING[name]
    step = 0.02 * (rows[-1] - rows[0])
    motion = move(linkage, [rows[30], rows[30] + step])
    sum_of = np.polynomial.polynomial.polyval(step, taylor_series(motion, 14).complex_point("K")[:, 0])
    assert abs(sum_of - motion.complex_point("K")[1]) < 1e-11 * linkage.size


def test_oracle_closed_form():
    """The slider of a central slider-crank: s = a cos + sqrt(b^2 - a^2 sin^2), expanded at 0 by hand."""
    found = taylor_series(move(SliderCrank(1, 2).linkage(), [0.0]), 6).complex_point("R(coupler-slider)")[:, 0]
    # sqrt(4 - sin^2) = 2 - sin^2/4 - sin^4/64 - sin^6/512, sin^2 = x^2 - x^4/3 + 2 x^6/45, sin^4 = x^4 - 2 x^6/3
    expected = [3, 0, -1 / 2 - 1 / 4, 0, 1 / 24 + 1 / 12 - 1 / 64, 0, -1 / 720 - 1 / 90 + 1 / 96 - 1 / 512]
    assert found.real == pytest.approx(expected, abs=1e-14)


def test_six_points_literature():
    """Document 001: y = 1.55006772785498e-4 x^6 for l1 = 1, six points, the curve wholly on the far side of g."""
    found = tangent_contact(move(LENKER, math.pi), "K")
    assert (found.points, found.order) == (6, 5)
    assert abs(found.coefficient) == pytest.approx(1.55006772785498e-4, rel=1e-12)
    assert found.remainder < 1e-12
    assert math.degrees(found.direction) % 180 == pytest.approx(15.79316904826399)
    scaled = tangent_contact(move(LENKER.scaled(10), math.pi), "K")
    assert scaled.coefficient == pytest.approx(found.coefficient * 1e-5)
    z = taylor_series(move(LENKER, math.pi), 6).complex_point("K")[:, 0] * np.exp(-1j * (found.direction + math.pi))
    # xi = -1.63299316 t + 0.10886621 t^3, eta = 0.00293938769 t^6, as printed in the series of the reference
    assert abs(z[1]) == pytest.approx(7.07630370, rel=1e-8) or abs(z[1]) == pytest.approx(1.63299316, rel=1e-8)
    assert abs(z[6].imag) == pytest.approx(0.00293938769, abs=1e-11)


def meyer_zur_capellen(lam, phi0):
    """The symmetric double rocker in its middle, D = 1: the coupler point K = (0, D), pole 0."""
    joint = complex(-lam / math.tan(phi0), lam)
    length = abs(joint) ** 2 / (abs(joint) - math.sin(phi0))
    pivot = joint - length * joint / abs(joint)
    drawn = {
        "R(frame-crank)": (pivot.real, pivot.imag),
        "R(crank-coupler)": (joint.real, joint.imag),
        "R(coupler-rocker)": (-joint.real, joint.imag),
        "R(frame-rocker)": (-pivot.real, pivot.imag),
    }
    linkage = Linkage.from_drawing(FourBar(1, 1, 1, 1).linkage().mechanism, drawn, points={"K": ("coupler", 0.0, 1.0)})
    return move(linkage, np.angle(joint - pivot))


@pytest.mark.parametrize(
    ("lam", "phi0", "points", "coefficient"),
    [
        (5 / 6, math.asin(math.sqrt((1 + 10 / 6) / 4)), 6, 0.0018),
        (0.7, math.asin(math.sqrt(2.4 / 4)), 6, 0.00130154),
        (1.2, math.asin(math.sqrt(3.4 / 4)), 6, 0.00184613),
        (0.8, math.radians(50), 4, -0.0105215),
        (0.9, math.radians(45), 4, -0.0493827),
    ],
)
def test_contact_of_the_guidance_literature(lam, phi0, points, coefficient):
    """Meyer zur Capellen's construction: six points if sin^2 phi0 = (1 + 2 lambda)/4, else four (cycloid guide)."""
    found = tangent_contact(meyer_zur_capellen(lam, phi0), "K")
    left = -1 if math.cos(found.direction) < 0 else 1  # y up, whichever way the point goes
    assert found.points == points
    assert left * found.coefficient == pytest.approx(coefficient, rel=5e-6)


@given(st.floats(0.1, 6.1))
def test_two_points_are_half_the_curvature(phi):
    """Rival: y = kappa/2 x^2."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    bend = path_curvature(move(linkage, [phi], speed=1), "K").curvature[0]
    found = tangent_contact(move(linkage, [phi]), "K")
    assume(abs(bend) > 1e-5)
    assert found.points == 2
    assert found.coefficient == pytest.approx(bend / 2, rel=1e-9, abs=1e-15)


def test_inflections_and_vertices():
    curve = coupler_curve(FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}), "K")
    assert [curve.contact(one.drive).points for one in curve.inflections] == [3, 3]
    assert {curve.contact(one.drive).points for one in curve.vertices} == {2}


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "six-bar"])
def test_no_normal_acceleration_on_the_inflection_circle(name):
    """Law: a point of the inflection circle goes straight on to the second order, so its tangent touches threefold."""
    linkage, rows, one, _ = MOVING[name]
    motion = move(linkage, rows[::60], speed=1.3, acceleration=0.7, order=2)
    circle = inflection_circle(motion, one)
    k = motion.link_index(one)
    for row in range(len(motion)):
        for angle in (0.3, 1.4, 2.6, 4.0, 5.5):
            on = circle.pole[row] - 0.5j * circle.shift[row] * (1 - np.exp(1j * angle))
            arm = complex(np.conj(motion.turns[row, k]) * (on - motion.places[0, row, k]))
            point = LinkPoint(one, arm.real, arm.imag)
            velocity, acceleration = (motion.complex_point(point, order=order)[row] for order in (1, 2))
            normal = (np.conj(velocity) * acceleration).imag / abs(velocity)
            assert abs(normal) < 1e-9 * max(abs(acceleration), abs(velocity))
            assert tangent_contact(motion, point, row, tolerance=1e-7).points in (3, 4, None)


def test_a_straight_line_has_no_order():
    found = tangent_contact(move(SliderCrank(25, 70, 10).linkage(), [0.7]), "R(coupler-slider)")
    assert (found.points, found.order, found.coefficient) == (None, None, 0.0)
    assert found.remainder < 1e-13
    cardan = SliderCrank(1, 1).linkage({"W": (-1.0, 0.0)})
    assert tangent_contact(move(cardan, [0.7]), "W", highest=20).points is None


def test_wrong_calls():
    motion = move(LENKER, math.pi)
    with pytest.raises(LinkageError, match="has 1 rows, but row 1"):
        tangent_contact(motion, "K", 1)
    with pytest.raises(LinkageError, match="highest"):
        tangent_contact(motion, "K", highest=1)
    with pytest.raises(LinkageError, match="cusp"):
        tangent_contact(move(SliderCrank(2, 5).linkage(), [0.0]), "R(coupler-slider)")
    for order in (0, 41, 2.0, True, "3"):
        with pytest.raises(LinkageError, match="order of a series"):
            taylor_series(motion, order)
    with pytest.raises(LinkageError, match="assembly modes meet"):
        taylor_series(move(FourBar(25, 70, 25, 70).linkage(), [0.0], branch="+"), 3)
    assert taylor_series(move(CYLINDER, [3.2]), 2).order == 2
    assert taylor_series(move(InvertedSliderCrank(25, 60, 5).linkage(), [1.0, 2.0]), 4).places.shape[:2] == (5, 2)
