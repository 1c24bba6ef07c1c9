"""Cams from a lift: profiles, pressure angles, curvature, undercut, and the way back from the profile to the lift."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.machines.cams import (
    Cam,
    CamError,
    Flat,
    Lift,
    Roller,
    SmoothContour,
    dwell,
    follower_motion,
    motion,
    read_lift,
)

LENGTHS = read_lift("rise 20 80 3-4-5; dwell 40; fall 20 100 cycloidal; dwell")
ANGLES = read_lift("rise 0.1 80 4-5-6-7; dwell 40; fall 0.1 100 modified-sine; dwell")
CAMS = [
    Cam(LENGTHS, 60, Roller(10, offset=5)),
    Cam(LENGTHS, 60, Roller(0, offset=-8)),
    Cam(LENGTHS, 90, Flat()),
    Cam(ANGLES, 40, Roller(8, arm=80, distance=100)),
    Cam(ANGLES, 40, Roller(8, arm=80, distance=-100)),
    Cam(ANGLES, 60, Roller(0, arm=110, distance=90)),
    Cam(ANGLES, 60, Flat(distance=150, face=5)),
    Cam(ANGLES, 60, Flat(distance=-150, face=-5)),
]
everywhere = pytest.mark.parametrize("cam", CAMS, ids=lambda cam: str(cam.follower))
TURN = np.radians(np.arange(0.5, 360, 1.0))


@everywhere
def test_the_profile_gives_the_lift_back(cam):
    """The contact is sought on the profile as on any contour, without knowing the lift."""
    found = follower_motion(SmoothContour.of(cam.profile), cam.follower, TURN)
    wanted = [cam.lift.at(TURN, order) for order in range(3)]
    wanted[0] = wanted[0] + cam.start
    for got, want, most, usual in zip(found, wanted, (1e-8, 1e-4, 1e-2), (1e-10, 1e-7, 1e-4), strict=True):
        scale = np.abs(want).max()
        assert np.abs(got - want).max() < most * scale
        assert np.median(np.abs(got - want)) < usual * scale


@everywhere
def test_pressure_angle_and_curvature_are_those_of_the_profile(cam):
    """Oracle: normal and circle through three neighbouring points of the profile."""
    h = 1e-4
    phi = np.radians(np.array([13.0, 40, 61, 100, 140, 170, 200, 300]))
    a, b, c = (cam.profile(phi + k * h) @ np.array([1, 1j]) for k in (-1, 0, 1))
    area = np.imag(np.conj(b - a) * (c - a)) / 2
    bend = -4 * area / (np.abs(b - a) * np.abs(c - b) * np.abs(c - a))
    assert bend == pytest.approx(cam.curvature(phi), rel=1e-4, abs=1e-6)
    normal = 1j * (c - a) / np.abs(c - a) * np.exp(1j * phi)
    s = cam.start + cam.lift.at(phi)
    if isinstance(cam.follower, Roller):
        way = cam.follower.path(s).first
    elif cam.follower.swings:
        lever = b * np.exp(1j * phi) - cam.follower.distance
        way = -1j * math.copysign(1, cam.follower.distance) * lever
    else:
        way = np.full(phi.shape, 1j)
    assert np.angle(normal / way) == pytest.approx(cam.pressure_angle(phi), abs=1e-6)


def test_the_pressure_angle_of_the_books():
    """tan alpha = (s' - e) / (sqrt(R^2 - e^2) + s), e.g. Volmer, Getriebetechnik - Kurvengetriebe."""
    cam = CAMS[0]
    s, s1 = LENGTHS.at(TURN), LENGTHS.at(TURN, 1)
    assert np.tan(cam.pressure_angle(TURN)) == pytest.approx((s1 - 5) / (math.sqrt(70**2 - 25) + s), abs=1e-12)
    assert (CAMS[2].pressure_angle(TURN) == 0).all()


def test_an_eccentric_circle_is_the_cam_of_a_harmonic_lift():
    """With a flat follower the lift E (1 - cos phi) needs a circle of radius base + E, E beside the axis."""
    cam = Cam(read_lift("rise 24 180 harmonic; fall 24 180 harmonic"), 30, Flat())
    points = cam.profile(TURN) @ np.array([1, 1j])
    # At phi = 180 degrees the face is up; then the centre lies above the axis, so in the cam's frame below it.
    assert np.abs(points + 12j) == pytest.approx(42, abs=1e-12)
    assert cam.curvature(TURN) == pytest.approx(1 / 42, rel=1e-12)
    found = cam.findings()
    assert [one.value for one in found.face] == pytest.approx([-12, 12], abs=1e-12)
    assert found.convex.value == pytest.approx(42)


@everywhere
def test_findings_are_the_extremes(cam):
    """Oracle: a fine table of the turn, never beyond what was found and close to it."""
    fine = np.radians(np.arange(0, 360, 0.02))
    found = cam.findings()
    for low, high, table in [
        (*(one.value for one in found.pressure), cam.pressure_angle(fine)),
        (*(one.value for one in found.face), cam.contact_on_face(fine)),
    ]:
        slack = 1e-6 * (1 + abs(high))
        assert low - 1e-10 <= table.min() <= low + slack
        assert high - slack <= table.max() <= high + 1e-10
    bend = cam.curvature(fine)
    assert not found.undercut
    assert bend.max() == pytest.approx(1 / found.convex.value, rel=1e-3)
    if found.hollow:
        assert bend.min() == pytest.approx(-1 / found.hollow.value, rel=1e-3)
    else:
        assert bend.min() >= -1e-12
    assert float(cam.pressure_angle(found.pressure[1].at)) == pytest.approx(found.pressure[1].value, abs=1e-9)


@pytest.mark.parametrize("margin", [-0.05, 0.05])
def test_a_flat_follower_needs_a_large_base_circle(margin):
    """Undercut begins at base = -min(s + s''), whatever the rest."""
    lift = read_lift("rise 20 90; dwell 30; fall 20 60; dwell")
    fine = np.linspace(0, math.tau, 200001)
    least = -float((lift.at(fine) + lift.at(fine, 2)).min())
    assert Cam(lift, least + margin, Flat()).findings().undercut == (margin < 0)


@pytest.mark.parametrize("margin", [-0.01, 0.01])
def test_a_roller_has_to_be_smaller_than_the_pitch_curve_bends(margin):
    """Undercut begins where the roller is as large as the least radius of the pitch curve."""
    lift = read_lift("rise 25 50; dwell 20; fall 25 50; dwell")
    least = Cam(lift, 50, Roller(0)).findings().convex.value
    assert least < 40
    cam = Cam(lift, 50 - (least - margin), Roller(least - margin))
    assert cam.findings().undercut == (margin < 0)
    if margin < 0:
        assert cam.findings().convex is None


def test_jumps_are_told():
    lift = read_lift("rise 20 60 parabolic; dwell 60; fall 20 60 linear; dwell")
    jumps = lift.jumps()
    assert [(round(math.degrees(one.at)), one.order) for one in jumps] == [(0, 2), (30, 2), (60, 2), (120, 1), (180, 1)]
    angle = math.radians(60)
    assert [one.size for one in jumps] == pytest.approx(
        [80 / angle**2, -160 / angle**2, 80 / angle**2, -20 / angle, 20 / angle]
    )
    assert LENGTHS.jumps() == []
    harmonic = read_lift("rise 24 180 harmonic; fall 24 180 harmonic")
    assert harmonic.jumps() == []


def test_boundary_values_in_a_lift():
    """A rise that leaves with a velocity goes on as a straight lift and comes to rest again."""
    text = (
        "rise 10 40 v0=0 a0=0 v1=20 a1=0; rise 6.981317007977318 20 linear; rise 10 40 v0=20 a0=0 v1=0 a1=0; dwell 60"
    )
    lift = read_lift(f"{text}; fall 26.981317007977318 200")
    assert lift.jumps() == []
    assert lift.at(np.radians([40, 50, 60]), 1) == pytest.approx([20] * 3)


@given(st.lists(st.tuples(st.floats(1, 30), st.floats(0.2, 1.0)), min_size=1, max_size=3), st.data())
def test_lifts_are_continuous(parts, data):
    names = st.sampled_from(["3-4-5", "cycloidal", "modified-trapezoid", "harmonic"])
    rises = [motion(lift, angle, data.draw(names)) for lift, angle in parts]
    used = sum(angle for _, angle in parts)
    fall = motion(-sum(lift for lift, _ in parts), 1.5, data.draw(names))
    lift = Lift([*rises, fall, dwell(math.tau - used - 1.5)])
    for start in lift.starts:
        assert float(lift.at(start - 1e-9)) == pytest.approx(float(lift.at(start + 1e-9)), abs=1e-6)
    assert float(lift.at(-0.5)) == pytest.approx(float(lift.at(math.tau - 0.5)))
    assert max(value for _, value in lift.extremes(0)) == pytest.approx(sum(lift for lift, _ in parts))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "but found nothing"),
        ("rise 20", "a lift and an angle"),
        ("rise 20 60; dwell 300", "left over"),
        ("rise 20 60; fall 20 60", "fill 360 degrees, not 120"),
        ("rise 20 60; fall 20 60; dwell; dwell", "only one dwell"),
        ("rise 20 180; fall 20 180; dwell", "no angle is left"),
        ("raise 20 60", "did you mean 'rise'"),
        ("rise 0 60; dwell", "not zero"),
        ("rise nan 60; dwell", "finite number, not 'nan'"),
        ("rise 20 -60; dwell", "angle from 1e-09 to 2 pi"),
        ("rise 20 400; dwell", "angle from 1e-09 to 2 pi"),
        ("rise 20 1e-308; dwell", "angle from 1e-09 to 2 pi"),
        ("rise 20 60 sinus; dwell", "no law is called 'sinus'"),
        ("rise 20 60 3-4-5 sine; dwell", "nothing after the law"),
        ("rise 20 60 a0=0; dwell", "lower derivatives are missing"),
        ("rise 20 60 v0=0 b=1; dwell", "not 'b=1'"),
        ("dwell 20 30", "nothing else"),
    ],
)
def test_absurd_lifts_are_refused(text, words):
    with pytest.raises(CamError, match=words) as caught:
        read_lift(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Cam(LENGTHS, 0, Flat()), "positive radius below 1e70, not 0"),
        (lambda: Cam(LENGTHS, math.nan, Flat()), "positive radius below 1e70, not nan"),
        (lambda: Cam(LENGTHS, "40", Flat()), "base: expected a number, but found '40'"),
        (lambda: Cam(LENGTHS, 40, Roller(10, offset=60)), "offset 60 must be smaller"),
        (lambda: Cam(LENGTHS, 40, Roller(8, arm=80, distance=100)), "swings from"),
        (lambda: Cam(ANGLES, 40, Roller(8, arm=80, distance=200)), "no triangle"),
        (lambda: Cam(ANGLES, 40, Flat(distance=30)), "reaches no circle"),
        (lambda: Cam(read_lift("fall 50 90; rise 50 90; dwell"), 40, Flat()), "beyond the cam's axis"),
        (lambda: Roller(-1), "not negative"),
        (lambda: Roller(math.inf), "below 1e70"),
        (lambda: Roller(5, arm=30), "an arm and a distance"),
        (lambda: Roller(5, offset=3, arm=30, distance=40), "no offset"),
        (lambda: Flat(face=3), "only a swinging"),
        (lambda: LENGTHS.at([math.inf]), "expected finite numbers"),
        (lambda: CAMS[0].profile(["here"]), "expected finite numbers"),
        (lambda: motion(20, 1.0, 345), "not 345"),
        (lambda: LENGTHS.at(0.0, 4), "derivatives 0 to 3"),
    ],
)
def test_absurd_cams_are_refused(make, words):
    with pytest.raises(CamError, match=words):
        make()
