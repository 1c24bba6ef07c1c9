"""The generalised transmission angle against closed forms, statics and sampling."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.measuring import measures
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


def test_a_parallelogram_is_worst_where_its_turn_begins() -> None:
    """Stretched at 0 and 180 degrees, known to the root of rounding; a place on a closed cycle lies below its end."""
    for crank, frame in ((25, 60), (10, 30), (7, 100), (25, 55), (13, 17), (25, 40)):
        extremes = measures(FourBar(frame, crank, frame, crank).linkage()).transmission
        assert extremes is not None
        assert extremes.smallest.drive == pytest.approx(0, abs=1e-7)
        quarters = [0, math.pi / 2, math.pi, 3 * math.pi / 2]
        assert [each.drive for each in extremes.extremes] == pytest.approx(quarters, abs=1e-7)


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


def between_links(one: Complexes, pin: Complexes, other: Complexes) -> Reals:
    """The angle at a pin, by the law of cosines, at most a right one."""
    a, b, c = abs(one - pin), abs(other - pin), abs(one - other)
    return np.asarray(np.arccos(np.abs(a**2 + b**2 - c**2) / (2 * a * b)))


def test_of_dyads_in_series_the_smallest_angle_counts() -> None:
    """Jansen's leg: its foot hangs on two links that move, each the end of a dyad on the crank."""
    linkage = entry("jansen").linkage()
    course = drive_cycle(linkage)
    motion = course.at(np.linspace(0, 2 * math.pi, 3601), 2)
    names = linkage.mechanism.chain.joint_names()
    place = {name: motion.complex_point(name) for name in names}
    crank = place["R(crank-upper_rod-lower_rod)"]
    expected = np.min(
        [
            between_links(place["R(triangle-link)"], place["R(link-foot)"], place["R(lower_rod-rocker-foot)"]),
            between_links(crank, place["R(upper_rod-triangle)"], place["R(frame-triangle-rocker)"]),
            between_links(crank, place["R(lower_rod-rocker-foot)"], place["R(frame-triangle-rocker)"]),
        ],
        axis=0,
    )
    assert transmission_angle(motion) == pytest.approx(expected, abs=1e-9)
    smallest = measure_transmission(course, find_output(linkage)).smallest
    assert smallest.mu == pytest.approx(expected.min(), abs=1e-5)
    assert smallest.mu <= expected.min()


WATT = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5); frame=0; drive=R(0-1)"),
    dict(
        zip(
            ["R(0-1)", "R(1-2)", "R(2-3)", "R(0-3)", "R(3-4)", "R(4-5)", "R(0-5)"],
            [(-30, -20), (-30, 0), (20, 20), (30, -20), (25, 0), (80, 20), (100, -20)],
            strict=True,
        )
    ),
)


def test_a_watt_linkage_is_as_good_as_the_worse_of_its_four_bars() -> None:
    """By hand: at crank angle 0 the first diagonal is 60 - 20 = 40, and the law of cosines gives 47.5 degrees."""
    coupler, rocker = math.hypot(50, 20), math.hypot(10, 40)
    worst = math.acos((coupler**2 + rocker**2 - 40**2) / (2 * coupler * rocker))
    assert math.degrees(worst) == pytest.approx(47.5, abs=0.05)
    found = measures(WATT)
    assert found.transmission is not None
    smallest = found.transmission.smallest
    assert (smallest.mu, smallest.links) == (pytest.approx(worst, abs=1e-9), ("2",))
    assert smallest.drive % (2 * math.pi) == pytest.approx(0, abs=1e-6)
    assert found.transmission.legs == (("4",), ("2",))
    assert "Smallest transmission angle 47.5° at 0° (link 2, whose largest is " in found.explain()
    first = measures(WATT, output="3").transmission
    assert first is not None
    assert first.legs == (("2",),)


PLACES = {"A": (0, 0), "B": (60, 0), "C": (120, 20), "D": (0, 20), "E": (50, 50), "F": (40, 80), "G": (110, 70)}


def drawn(text: str, places: str) -> Linkage:
    mechanism = Mechanism.parse(text)
    names = mechanism.chain.joint_names()
    return Linkage.from_drawing(mechanism, {n: PLACES[place] for n, place in zip(names, places, strict=True)})


@pytest.mark.parametrize("output", ["3", "6", "7"])
def test_bars_that_form_a_triangle_are_one_link(output: str) -> None:
    """The constant angles within it are none of transmission."""
    plate = drawn("R(0-1) R(1-2) R(2-3) R(0-3) R(2-6) R(6-7) R(0-7); frame=0; drive=R(0-1)", "ADEBFGC")
    bars = drawn("R(0-1) R(1-2-5) R(2-3-4) R(0-3) R(4-5-6) R(6-7) R(0-7); frame=0; drive=R(0-1)", "ADEBFGC")
    expected = measures(plate, output=output).transmission
    found = measures(bars, output=output).transmission
    assert expected is not None
    assert found is not None
    assert found.legs == expected.legs
    assert (found.smallest.mu, found.largest.mu) == pytest.approx((expected.smallest.mu, expected.largest.mu), abs=1e-7)
    drives = np.linspace(0.3, 1.2, 50)
    angles = [transmission_angle(move(linkage, drives, order=2), output) for linkage in (bars, plate)]
    assert angles[0] == pytest.approx(angles[1], abs=1e-9)
    place = {name: move(plate, drives, order=2).complex_point(name) for name in plate.mechanism.chain.joint_names()}
    mu = between_links(place["R(1-2)"], place["R(2-3)"], place["R(0-3)"])
    if output != "3":
        mu = np.minimum(mu, between_links(place["R(2-6)"], place["R(6-7)"], place["R(0-7)"]))
    assert angles[0] == pytest.approx(mu, abs=1e-9)


def test_where_it_is_not_defined_on_the_way_that_is_said() -> None:
    """A link that slides on the crank and in link 3, as Oldham's coupling has it, turns 3 by a couple."""
    chain = "R(0-1) P(1-2) P(2-3) R(0-3) R(3-4) R(4-5) R(0-5); frame=0; drive=R(0-1)"
    places = [(0, 0), (10, 0, 0), (10, 0, math.pi / 2), (3, 1), (10, 10), (40, 30), (50, 0)]
    mechanism = Mechanism.parse(chain)
    oldham = Linkage.from_drawing(mechanism, dict(zip(mechanism.chain.joint_names(), places, strict=True)))
    found = measures(oldham).transmission
    assert found is not None
    assert (found.legs, set(found.undefined)) == ((("4",),), {"2", "3"})
    assert "between the drive and the output, no transmission angle is defined." in measures(oldham).explain()


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
