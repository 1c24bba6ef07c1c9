"""Cams and Geneva drives as joints of linkages, against the lift, against Geneva drives by formula, by the circuit."""

from math import hypot, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import LinkageError
from gruebler.cams import read_lift
from gruebler.geneva import Geneva
from gruebler.kinematics import circuit, degrees, measures, move
from gruebler.kinematics.course import follow
from gruebler.kinematics.events import dead_centres
from gruebler.kinematics.outputs import find_output
from gruebler.linkages import Circle, Cross, Disc, Driver, Linkage, linkage_from_json, to_json
from gruebler.mechanism import Mechanism

LIFT = "rise 20 90; dwell 60; fall 20 120 cycloidal; dwell"
JOINTS = np.radians([0, 90, 150, 270, 360])
TOLERANCES = (1e-11, 1e-9, 1e-6, 1e-3)


def flat_follower(lift=LIFT, base=60.0):
    mechanism = Mechanism.parse("R(0-cam) P(0-valve) G(cam-valve); frame=0; drive=R(0-cam)")
    touch = {"cam": Disc(0, 0, 0, lift, base, flat=True), "valve": (0, base, 0)}
    return Linkage.drawn(mechanism, {"R(0-cam)": (0, 0), "P(0-valve)": (0, base, pi / 2), "G(cam-valve)": touch})


def roller_follower(lift=LIFT, base=40.0, roller=10.0, offset=5.0):
    """The spin of the roller is a freedom of its own."""
    mechanism = Mechanism.parse("R(0-cam) P(0-tappet) R(tappet-roller) G(cam-roller); frame=0; drive=R(0-cam)")
    y = sqrt((base + roller) ** 2 - offset**2)
    touch = {"cam": Disc(0, 0, 0, lift, base, roller, offset), "roller": Circle(offset, y, roller)}
    places = {"R(0-cam)": (0, 0), "P(0-tappet)": (offset, y + 30, pi / 2), "R(tappet-roller)": (offset, y)}
    return Linkage.drawn(mechanism, {**places, "G(cam-roller)": touch})


def rocker_follower():
    """A knife edge on a rocker that drives a four-bar."""
    mechanism = Mechanism.parse(
        "R(0-cam) R(0-rocker) G(cam-rocker) R(rocker-rod) R(rod-slider) P(0-slider); frame=0; drive=R(0-cam)"
    )
    touch = {"cam": Disc(0, 0, 0.4, LIFT, 40), "rocker": (-17.0, 38.0)}
    touch["rocker"] = tuple(40 * x / hypot(-17, 38) for x in (-17.0, 38.0))
    places = {"R(0-cam)": (0, 0), "R(0-rocker)": (-80, 40), "R(rocker-rod)": (-70, 90), "R(rod-slider)": (0, 130)}
    return Linkage.drawn(mechanism, {**places, "P(0-slider)": (0, 130, 0), "G(cam-rocker)": touch})


def geneva(slots=4, pins=1, internal=False):
    mechanism = Mechanism.parse("R(0-driver) R(0-cross) G(driver-cross); frame=0; drive=R(0-driver)")
    touch = {"driver": Driver(0, 0, 0, pins), "cross": Cross(100, 0, pi, slots, internal)}
    return Linkage.drawn(mechanism, {"R(0-driver)": (0, 0), "R(0-cross)": (100, 0), "G(driver-cross)": touch})


@pytest.mark.parametrize(
    ("linkage", "joint"),
    [(flat_follower(), "P(0-valve)"), (roller_follower(), "P(0-tappet)"), (roller_follower(offset=0.0), "P(0-tappet)")],
)
def test_a_cam_gives_the_lift_for_which_it_is_made(linkage, joint):
    motion = move(linkage, degrees(-300, 720, 1), speed=1, order=3)
    assert motion.complete
    assert motion.closure < 1e-11
    angle = motion.drives[:, 0]
    smooth = np.abs(np.mod(angle, 2 * pi)[:, None] - JOINTS).min(axis=1) > 1e-6
    for order, tolerance in enumerate(TOLERANCES):
        found = motion.slide(joint, order)
        found -= found[300] if order == 0 else 0
        assert np.abs(found - read_lift(LIFT).at(angle, order))[smooth].max() < tolerance


@settings(max_examples=10, deadline=None)
@given(st.integers(3, 9), st.integers(1, 2), st.booleans())
def test_geneva_drives(slots, pins, internal):
    pins = 1 if internal else pins
    motion = move(geneva(slots, pins, internal), degrees(-500, 900, 1.7), speed=1, order=3)
    assert motion.complete
    drive = Geneva(slots, internal, pins)
    wanted = drive.move(motion.drives[:, 0])
    local = np.mod(motion.drives[:, 0] + pi / pins, 2 * pi / pins) - pi / pins
    smooth = np.abs(np.abs(local) - drive.engaged) > 1e-9  # the acceleration jumps at entry and exit
    for order, tolerance in enumerate(TOLERANCES):
        found = motion.angular("cross", order)
        found -= found[0] - wanted[0][0] if order == 0 else 0
        assert np.abs(found - wanted[order])[smooth].max() < tolerance * max(1, np.abs(wanted[order]).max())


@pytest.mark.parametrize(
    "linkage", [flat_follower(), roller_follower(), rocker_follower(), geneva(), geneva(6, 2), geneva(5, 1, True)]
)
def test_the_circuit_finds_the_same_and_files_keep_it(linkage):
    made = circuit(linkage)
    assert made.closed
    motion = move(linkage, made.drive)
    assert motion.complete
    assert motion.closure < 1e-11
    for link in linkage.mechanism.chain.links:
        np.testing.assert_allclose(np.exp(1j * motion.angle(link)), np.exp(1j * made.angle(link)), atol=1e-9)
    assert linkage_from_json(to_json(linkage)) == linkage
    large = move(linkage.scaled(2.5), made.drive)
    np.testing.assert_allclose(large.places[0], 2.5 * motion.places[0], atol=1e-9)


def test_rates_behind_a_cam_are_derivatives():
    h = 1e-3
    motion = move(rocker_follower(), 0.9 + h * np.arange(-4, 5), speed=1, order=3)
    weights = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / (840 * h)
    for order, tolerance in ((0, 1e-8), (1, 1e-6), (2, 1e-3)):
        moved = weights @ motion.places[order]
        assert np.abs(moved - motion.places[order + 1, 4]).max() < tolerance


def test_measures_of_a_geneva_drive():
    assert measures(geneva()).span.turns == 4
    assert measures(geneva(6, 2)).span.turns == 3


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: move(flat_follower("rise 20 90; dwell"), [0]), "it began"),
        (lambda: move(flat_follower("rise 20 20; fall 20 20; dwell", 20.0), [0]), "crosses itself"),
        (lambda: move(geneva(2), [0]), "at least 3"),
        (lambda: move(geneva(4, 9), [0]), "at most 4 pins"),
        (lambda: flat_follower().mirrored(), "mirror image of a cam"),
        (lambda: roller_follower()._changed(elements=_with_roller(7.0)), "made for a roller of 10, not 7"),
    ],
)
def test_refusals(make, said):
    with pytest.raises(LinkageError, match=said):
        make()


def _with_roller(radius):
    elements = roller_follower()._by_link()
    elements["roller"] = {
        joint: e._replace(radius=radius) if isinstance(e, Circle) else e for joint, e in elements["roller"].items()
    }
    return elements


def test_a_dwell_has_no_dead_centres_inside():
    course = follow(roller_follower())
    places = [np.degrees(one.drive) for one in dead_centres(course, find_output(course.plan.linkage, "tappet"))]
    assert places
    assert not [at for at in places if 91 < at < 149 or 271 < at < 359]
    single = follow(flat_follower("rise 8 75; fall 8 75; dwell", 40.0))
    outer = [one for one in dead_centres(single, find_output(single.plan.linkage, "valve")) if one.kind == "maximum"]
    assert [np.degrees(one.drive) for one in outer] == pytest.approx([75])
