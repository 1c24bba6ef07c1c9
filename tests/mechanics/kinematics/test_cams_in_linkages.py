"""Cams and Geneva drives as joints of linkages, against the lift, against Geneva drives by formula, by the circuit."""

from dataclasses import replace
from math import degrees as in_degrees
from math import hypot, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.machines.cams import read_lift
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.kinematics import circuit, from_degrees, move
from gruebler.mechanics.kinematics.drive_rows import rpm
from gruebler.mechanics.linkages import CamDisc, Circle, GenevaDriver, GenevaWheel, Linkage
from gruebler.structure.mechanism import Mechanism

LIFT = "rise 20 90; dwell 60; fall 20 120 cycloidal; dwell"
JOINTS = np.radians([0, 90, 150, 270, 360])
TOLERANCES = (1e-11, 1e-9, 1e-6, 1e-3)


def flat_follower(lift=LIFT, base=60.0, *, closed=False):
    mechanism = Mechanism.parse("R(0-cam) P(0-valve) G(cam-valve); frame=0; drive=R(0-cam)")
    touch = {"cam": CamDisc(0, 0, 0, lift=lift, base=base, flat=True, closed=closed), "valve": (0, base, 0)}
    return Linkage.from_drawing(mechanism, {"R(0-cam)": (0, 0), "P(0-valve)": (0, base, pi / 2), "G(cam-valve)": touch})


def roller_follower(lift=LIFT, base=40.0, roller=10.0, offset=5.0, *, closed=False):
    """The spin of the roller is a freedom of its own."""
    mechanism = Mechanism.parse("R(0-cam) P(0-tappet) R(tappet-roller) G(cam-roller); frame=0; drive=R(0-cam)")
    y = sqrt((base + roller) ** 2 - offset**2)
    touch = {
        "cam": CamDisc(0, 0, 0, lift=lift, base=base, roller=roller, offset=offset, closed=closed),
        "roller": Circle(offset, y, roller),
    }
    places = {"R(0-cam)": (0, 0), "P(0-tappet)": (offset, y + 30, pi / 2), "R(tappet-roller)": (offset, y)}
    return Linkage.from_drawing(mechanism, {**places, "G(cam-roller)": touch})


def rocker_follower():
    """A knife edge on a rocker that drives a four-bar."""
    mechanism = Mechanism.parse(
        "R(0-cam) R(0-rocker) G(cam-rocker) R(rocker-rod) R(rod-slider) P(0-slider); frame=0; drive=R(0-cam)"
    )
    touch = {"cam": CamDisc(0, 0, 0.4, lift=LIFT, base=40), "rocker": (-17.0, 38.0)}
    touch["rocker"] = tuple(40 * x / hypot(-17, 38) for x in (-17.0, 38.0))
    places = {"R(0-cam)": (0, 0), "R(0-rocker)": (-80, 40), "R(rocker-rod)": (-70, 90), "R(rod-slider)": (0, 130)}
    return Linkage.from_drawing(mechanism, {**places, "P(0-slider)": (0, 130, 0), "G(cam-rocker)": touch})


def geneva(slots=4, pins=1, internal=False):
    mechanism = Mechanism.parse("R(0-driver) R(0-cross) G(driver-cross); frame=0; drive=R(0-driver)")
    touch = {"driver": GenevaDriver(0, 0, 0, pins), "cross": GenevaWheel(100, 0, pi, slots=slots, internal=internal)}
    return Linkage.from_drawing(mechanism, {"R(0-driver)": (0, 0), "R(0-cross)": (100, 0), "G(driver-cross)": touch})


@pytest.mark.parametrize(
    ("linkage", "joint"),
    [(flat_follower(), "P(0-valve)"), (roller_follower(), "P(0-tappet)"), (roller_follower(offset=0.0), "P(0-tappet)")],
)
def test_a_cam_gives_the_lift_for_which_it_is_made(linkage, joint):
    motion = move(linkage, from_degrees(-300, 720, 1), speed=1, order=3)
    assert motion.complete
    assert motion.closure_error < 1e-11
    angle = motion.drives[:, 0]
    smooth = np.abs(np.mod(angle, 2 * pi)[:, None] - JOINTS).min(axis=1) > 1e-6
    for order, tolerance in enumerate(TOLERANCES):
        found = motion.displacement(joint, order=order)
        found -= found[300] if order == 0 else 0
        assert np.abs(found - read_lift(LIFT).at(angle, order))[smooth].max() < tolerance


@settings(max_examples=10, deadline=None)
@given(st.integers(3, 9), st.integers(1, 2), st.booleans())
def test_geneva_drives(slots, pins, internal):
    pins = 1 if internal else pins
    motion = move(geneva(slots, pins, internal), from_degrees(-500, 900, 1.7), speed=1, order=3)
    assert motion.complete
    drive = Geneva(slots, internal=internal, pins=pins)
    turned = drive.move(motion.drives[:, 0])
    wanted = (turned.angle, turned.ratio, turned.acceleration, turned.jerk)
    local = np.mod(motion.drives[:, 0] + pi / pins, 2 * pi / pins) - pi / pins
    smooth = np.abs(np.abs(local) - drive.engaged) > 1e-9  # the acceleration jumps at entry and exit
    for order, tolerance in enumerate(TOLERANCES):
        found = motion.angular("cross", order=order)
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
    assert motion.closure_error < 1e-11
    for link in linkage.mechanism.chain.links:
        np.testing.assert_allclose(np.exp(1j * motion.angle(link)), np.exp(1j * made.angle(link)), atol=1e-9)
    assert linkage_from_json(linkage_to_json(linkage)) == linkage
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
        (lambda: move(geneva(2), [0]), "from 3 to 2,000"),
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
        joint: replace(e, radius=radius) if isinstance(e, Circle) else e for joint, e in elements["roller"].items()
    }
    return elements


def turning_point(linkage, name=None):
    """Dead centres and dwells in degrees, with kind and side."""
    found = measures(linkage, output=name)
    centres = [(np.degrees(one.drive), one.kind, one.side) for one in found.dead_centres]
    rests = [(np.degrees(one.begin), np.degrees(one.end), one.kind, one.side) for one in found.dwells]
    return found, centres, rests


def near(rows, wanted):
    assert len(rows) == len(wanted)
    for row, want in zip(rows, wanted, strict=True):
        numbers = sum(isinstance(x, int | float) for x in want)
        assert row[:numbers] == pytest.approx(want[:numbers], abs=1e-9)
        assert row[numbers:] == want[numbers:]


def test_dwells_of_a_valve():
    """The valve rises, falls and rests: both ways take 75 degrees."""
    found, centres, rests = turning_point(flat_follower("rise 8 75; fall 8 75; dwell", 40.0))
    near(centres, [(75, "maximum", "outer")])
    near(rests, [(150, 360, "minimum", "inner")])
    assert np.degrees([found.phi_forward, found.phi_back]) == pytest.approx([75, 75], abs=1e-9)
    assert (found.time_ratio, found.dwell_share, found.travel) == pytest.approx((1, 210 / 360, 8))


def test_dwells_on_both_sides():
    found, centres, rests = turning_point(roller_follower())
    assert centres == []
    near(rests, [(90, 150, "maximum", "outer"), (270, 360, "minimum", "inner")])
    assert (found.time_ratio, found.dwell_share, found.travel) == pytest.approx((4 / 3, 150 / 360, 20))
    timed = measures(roller_follower(), speed=rpm(60))
    assert (timed.times.forward, timed.times.back, timed.dwell_time) == pytest.approx((90 / 360, 120 / 360, 150 / 360))


@settings(max_examples=8, deadline=None)
@given(
    st.lists(st.integers(20, 60), min_size=5, max_size=5),
    st.sampled_from(["3-4-5", "4-5-6-7", "5-6-7-8-9", "cycloidal", "modified-sine", "modified-trapezoid", "harmonic"]),
    st.booleans(),
)
def test_dwells_are_those_of_the_lift(angles, name, flat):
    """A rise in two steps with a dwell between, a dwell above, a fall, a dwell below; flat faces and rollers."""
    a, b, c, d, e = angles
    lift = f"rise 2 {a} {name}; dwell {b}; rise 2 {c} {name}; dwell {d}; fall 4 {e} cycloidal; dwell"
    linkage = flat_follower(lift, 400.0) if flat else roller_follower(lift, 200.0)
    found, centres, rests = turning_point(linkage)
    assert centres == []
    edges = np.cumsum([a, b, c, d, e]).tolist()
    near(
        rests,
        [
            (edges[0], edges[1], "flat", ""),
            (edges[2], edges[3], "maximum", "outer"),
            (edges[4], 360, "minimum", "inner"),
        ],
    )
    assert np.degrees([found.phi_forward, found.phi_back]) == pytest.approx([a + c, e], abs=1e-9)


def test_velocities_in_a_dwell_are_exactly_zero():
    course = drive_cycle(flat_follower("rise 8 75; fall 8 75; dwell", 40.0))
    rates = course.at(np.radians(np.linspace(150.001, 359.999, 500)), 3)
    assert [np.abs(rates.displacement("P(0-valve)", order=order)).max() for order in (1, 2, 3)] == [0, 0, 0]


def test_short_lifts_are_seen_beside_long_dwells():
    """A lift of 1.2 degrees in a turn: nine tenths of the turn say nothing about it."""
    found, centres, rests = turning_point(flat_follower("rise 0.0002 0.6; fall 0.0002 0.6; dwell", 40.0))
    near(centres, [(0.6, "maximum", "outer")])
    near(rests, [(1.2, 360, "minimum", "inner")])
    assert not found.transfer.still


def test_a_blow_turns_back_too():
    """With linear laws the velocity jumps from one sign to the other: a dead centre all the same."""
    found, centres, _ = turning_point(flat_follower("rise 8 75 linear; fall 8 75 linear; dwell", 40.0))
    near(centres, [(75, "maximum", "outer")])
    assert found.time_ratio == pytest.approx(1)


def test_dwells_are_seen_through_linkages():
    """The slider behind rocker and rod rests while the rocker rests; so does the rod's angle."""
    rests = [turning_point(rocker_follower(), name)[2] for name in ("slider", "rocker", "rod")]
    for row in rests[1:]:
        assert [one[:2] for one in row] == [pytest.approx(one[:2], abs=1e-9) for one in rests[0]]
    motion = move(rocker_follower(), np.radians(np.linspace(rests[0][0][0], rests[0][0][1], 50)), speed=1.0)
    assert np.abs(motion.displacement("P(0-slider)", order=1)[1:-1]).max() < 1e-12
    assert np.ptp(motion.displacement("P(0-slider)")) < 1e-12 * 80


@pytest.mark.parametrize(("slots", "pins", "internal"), [(4, 1, False), (6, 2, False), (5, 1, True)])
def test_dwells_of_geneva_drives(slots, pins, internal):
    """The wheel rests while no pin is in a slot; begins of dwells are no dead centres."""
    found, centres, rests = turning_point(geneva(slots, pins, internal))
    drive = Geneva(slots, internal=internal, pins=pins)
    assert centres == []
    assert len(rests) == slots
    assert found.dwell_share == pytest.approx(drive.dwell_fraction)
    assert found.moving_span == pytest.approx(found.span.period * drive.motion_fraction)
    assert found.motion_ratio == pytest.approx(drive.motion_ratio)
    assert f"{in_degrees(found.moving_span):.4g}°" in found.explain()
    ratio = found.motion_ratio
    told = f"1 : {1 / ratio:.4g}" if ratio < 1 else f"{ratio:.4g} : 1"
    assert f"Bewegung zu Rast {told}".replace(".", ",") in found.explain("de")
    for k, (begin, end, kind, side) in enumerate(rests):
        pitch = 360 / pins
        assert begin == pytest.approx(np.degrees(drive.engaged) + k * pitch, abs=1e-9)
        assert end == pytest.approx((k + 1) * pitch - np.degrees(drive.engaged), abs=1e-9)
        assert (kind, side) == ("flat", "")


def test_dwells_are_reported():
    found = measures(roller_follower(), speed=rpm(60))
    assert "Dwell in the outer position from 90° to 150°, 60°: -10" in found.explain()
    assert "Rast in der inneren Lage von 270° bis 360°, 90°" in found.explain("de")
    assert "In Rast: 0,4167 s je Periode." in found.explain("de")
    told = found.to_json()
    assert [one["begin"] for one in told["dwells"]] == pytest.approx([90, 270], abs=1e-9)
    assert told["dwell_share"] == pytest.approx(150 / 360)
    assert measures(geneva()).to_json()["dead_centres"] == []


def test_a_range_of_the_drive_may_end_in_a_dwell():
    """A crank-driven cam that only swings: the dwells at the ends of its range, and none beyond."""
    found = measures(swinging_cam())
    assert not found.span.full
    assert len(found.dwells) >= 1
    for dwell in found.dwells:
        assert found.span.low <= dwell.begin < dwell.end <= found.span.high
        inside = move(swinging_cam(), np.linspace(dwell.begin, dwell.end, 9)[1:-1], speed=1.0)
        assert np.abs(inside.displacement("P(0-valve)", order=1)).max() < 1e-10


SWING = "rise 8 60; dwell 60; fall 8 60; dwell"
STEPS = "rise 2 60; dwell 30; rise 2 60; dwell 30; fall 4 60; dwell"


@pytest.mark.parametrize(
    ("arguments", "kinds", "sides"),
    [
        ((), ["minimum", "maximum", "minimum"], ["inner", "outer", ""]),
        ((SWING, 2.5), ["maximum", "minimum", "maximum"], ["outer", "inner", ""]),
        ((STEPS, 0.9, 100), ["flat", "flat", "minimum"], ["", "", "inner"]),  # begins in the rise
    ],
)
def test_the_kind_of_dwells_at_and_after_the_begin_of_a_range(arguments, kinds, sides):
    """As the valve lies lower or higher a little before and behind; of two as far out the first one is named."""
    linkage = swinging_cam(*arguments)
    found = measures(linkage)
    assert [dwell.kind for dwell in found.dwells] == kinds
    assert [dwell.side for dwell in found.dwells] == sides
    low, high = found.span.low, found.span.high
    assert max(abs(found.dwells[0].begin - low) * ("flat" not in kinds), abs(found.dwells[-1].end - high)) < 1e-9
    for dwell in found.dwells:
        beside = [drive for drive in (dwell.begin - 0.05, dwell.end + 0.05) if low < drive < high]
        lift = move(linkage, [dwell.drive, *beside]).displacement("P(0-valve)")
        higher = {bool(other > lift[0]) for other in lift[1:]}
        assert higher == {"minimum": {True}, "maximum": {False}, "flat": {False, True}}[dwell.kind]


def test_of_equal_extremes_the_first_is_named():
    """Two lifts of 8 in a turn and two rests between them."""
    lift = "rise 8 60; fall 8 60; dwell 30; rise 8 60; fall 8 60; dwell"
    _, centres, rests = turning_point(flat_follower(lift, 40.0))
    near(centres, [(60, "maximum", "outer"), (210, "maximum", "")])
    near(rests, [(120, 150, "minimum", "inner"), (270, 360, "minimum", "")])


def swinging_cam(lift=SWING, angle=0.3, base=40.0):
    """The rocker of a double rocker carries a cam with a flat follower."""
    mechanism = Mechanism.parse(
        "R(0-arm) R(arm-rod) R(rod-cam) R(0-cam) P(0-valve) G(cam-valve); frame=0; drive=R(0-arm)"
    )
    touch = {"cam": CamDisc(0, 0, angle, lift=lift, base=base, flat=True), "valve": (0, base, 0)}
    places = {"R(0-arm)": (150, 0), "R(arm-rod)": (150, 60), "R(rod-cam)": (30, 45), "R(0-cam)": (0, 0)}
    return Linkage.from_drawing(mechanism, {**places, "P(0-valve)": (0, base, pi / 2), "G(cam-valve)": touch})
