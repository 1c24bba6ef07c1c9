"""The generalised transmission angle against closed forms, statics and sampling."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import deviation_angle, measure_transmission, transmission_angle
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.samples import CLASS_III, CYLINDER

SIZES = [
    FourBar(2, 5, 4, 5),
    FourBar(5.5, 7, 4.5, 2),
    SliderCrank(3, 5, 1),
    SliderCrank(20, 85, -20),
    InvertedSliderCrank(30, 50, 7),
    InvertedSliderCrank(30, 50, -12),
]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("branch", ["+", "-"])
def test_along_the_motion(size: FourBar | SliderCrank | InvertedSliderCrank, branch: str) -> None:
    phi = from_degrees(0, 360, 1)
    motion = move(size.linkage(), phi, order=2, branch=branch)
    closed = size.motion(phi, branch=branch)
    assert transmission_angle(motion) == pytest.approx(closed.transmission_angle, abs=1e-12)
    assert deviation_angle(motion) == pytest.approx(closed.deviation_angle, abs=1e-12)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("branch", "+-")
def test_extremes(size: FourBar | SliderCrank | InvertedSliderCrank, branch: str) -> None:
    course = drive_cycle(size.linkage(), branch=branch)
    found = measure_transmission(course, find_output(course.linkage))
    assert found.smallest.mu == pytest.approx(size.transmission_angle.smallest.mu, abs=1e-12)
    dense = size.motion(np.linspace(0, 2 * math.pi, 100_001)).transmission_angle
    assert found.largest.mu == pytest.approx(dense.max(), abs=1e-4)
    assert found.largest.mu >= dense.max() - 1e-12
    assert found.good == size.transmission_angle.good


@pytest.mark.parametrize("size", SIZES)
def test_the_closed_form_gives_the_same_values(size: FourBar | SliderCrank | InvertedSliderCrank) -> None:
    closed = size.transmission_angle
    for branch in "+-":
        course = drive_cycle(size.linkage(), branch=branch)
        found = measure_transmission(course, find_output(course.linkage))
        assert found.legs == closed.legs
        assert found.largest.mu == pytest.approx(closed.largest.mu, abs=1e-12)
    by_drive = drive_cycle(size.linkage(), branch="+").at(np.array([extreme.drive for extreme in closed.extremes]), 2)
    assert transmission_angle(by_drive) == pytest.approx([extreme.mu for extreme in closed.extremes], abs=1e-9)


@settings(max_examples=20, deadline=None)
@given(*[st.floats(0.3, 5)] * 4)
def test_extremes_of_any_four_bar(a: float, b: float, c: float, d: float) -> None:
    size = FourBar(a, b, c, d)
    sums = [a + b - c - d, a + c - b - d, a + d - b - c]
    assume(min(map(abs, sums)) > 0.05 and size.limits)
    assume(size.limits[0].width > 0.2)
    course = drive_cycle(size.linkage())
    found = measure_transmission(course, find_output(course.linkage))
    # the closed form at a limit is 0 to the root of a rounding
    assert found.smallest.mu == pytest.approx(size.transmission_angle.smallest.mu, abs=1e-7)


def test_a_cylinder_pushes_along_its_line() -> None:
    course = drive_cycle(CYLINDER)
    motion = course.at(np.linspace(2.0, 6.0, 41), 2)
    point = motion.complex_point("R(4-2)")
    lever, line = point - 4, point
    expected = np.abs(np.angle(line / lever))
    expected = np.minimum(expected, np.pi - expected)
    assert transmission_angle(motion) == pytest.approx(expected, abs=1e-12)


def test_a_scotch_yoke_is_driven_at_right_angles() -> None:
    yoke = Linkage(
        Mechanism.parse("R(0-1) R(1-2) P(2-3) P(0-3); frame=0; drive=R(0-1)"),
        {
            "0": {"R(0-1)": (0, 0), "P(0-3)": (0, 0, 0)},
            "1": {"R(0-1)": (0, 0), "R(1-2)": (2, 0)},
            "2": {"R(1-2)": (0, 0), "P(2-3)": (0, 0, math.pi / 3)},
            "3": {"P(2-3)": (0, 0, math.pi / 3), "P(0-3)": (0, 0, 0)},
        },
    )
    motion = move(yoke, from_degrees(0, 350, 10), order=2)
    assert transmission_angle(motion) == pytest.approx(np.full(36, math.pi / 3), abs=1e-12)


def test_larger_groups_are_measured_at_the_leg_on_the_moving_side() -> None:
    course = drive_cycle(CLASS_III)
    motion = course.at(np.linspace(course.span.low + 0.01, course.span.high - 0.01, 2001), 2)
    mu = transmission_angle(motion, "4")
    force = motion.complex_point("R(2-h)") - motion.complex_point("R(1-2)")
    pin = CLASS_III.elements[CLASS_III.mechanism.chain.find_joint("R(2-h)"), "h"]
    k = CLASS_III.mechanism.chain.index("h")
    velocity = motion.places[1, :, k] + 1j * motion.rates[0, :, k] * motion.turns[:, k] * complex(pin.x, pin.y)
    expected = np.abs(np.angle(force / velocity))
    expected = np.pi / 2 - np.minimum(expected, np.pi - expected)
    assert mu == pytest.approx(expected, abs=1e-9)
    found = measure_transmission(course, find_output(CLASS_III, "4"))
    assert found.legs == (("2",),)
    assert found.smallest.mu == pytest.approx(0, abs=1e-8)  # at the limits
    assert found.largest.mu == pytest.approx(mu.max(), abs=1e-5)
    assert found.largest.mu >= mu.max() - 1e-9


def test_between_two_moving_legs_it_is_the_angle_of_the_dyad() -> None:
    """Law of cosines for Jansen's leg: link and foot meet at 39.4 and 36.7 from the joints that hold them."""
    linkage = entry("jansen").linkage()
    course = drive_cycle(linkage)
    motion = course.at(np.linspace(0, 2 * math.pi, 3601), 2)
    upper, knee, lower = (
        motion.complex_point(name) for name in ("R(triangle-link)", "R(link-foot)", "R(lower_rod-rocker-foot)")
    )
    arms = np.abs(upper - knee), np.abs(lower - knee)
    cosine = (arms[0] ** 2 + arms[1] ** 2 - np.abs(upper - lower) ** 2) / (2 * arms[0] * arms[1])
    expected = np.arccos(np.abs(cosine))
    assert transmission_angle(motion) == pytest.approx(expected, abs=1e-9)
    smallest = measure_transmission(course, find_output(linkage)).smallest
    assert smallest.mu == pytest.approx(expected.min(), abs=1e-5)
    assert smallest.mu <= expected.min()


def test_virtual_work_at_the_driving_leg() -> None:
    """Force in the coupler of a four-bar against an output torque: M = F c sin mu."""
    size = FourBar(25, 70, 40, 70)
    motion = move(size.linkage(), from_degrees(0, 359, 1), order=2)
    rate = motion.angular("rocker", order=1)
    coupler = motion.complex_point("R(coupler-rocker)") - motion.complex_point("R(crank-coupler)")
    pin = motion.complex_point("R(crank-coupler)", order=1)
    power = np.real(np.conj(coupler / np.abs(coupler)) * pin)  # of a unit force, at the crank pin
    assert 40 * np.sin(transmission_angle(motion)) * np.abs(rate) == pytest.approx(np.abs(power), abs=1e-9)


def test_where_there_is_none() -> None:
    course = drive_cycle(FourBar(2, 7, 4.5, 5.5).linkage())
    with pytest.raises(LinkageError, match="moved by the drive itself"):
        measure_transmission(course, find_output(course.linkage, "crank"))
    with pytest.raises(LinkageError, match="order=2"):
        transmission_angle(move(course.linkage, [0.0]))
