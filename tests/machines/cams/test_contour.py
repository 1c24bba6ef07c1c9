"""Given contours: eccentric and tangent cam in closed form, rates as derivatives, two kinds of contour as rivals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.machines.cams import (
    ArcContour,
    CamError,
    ContourArc,
    Flat,
    Roller,
    SmoothContour,
    follower_motion,
    tangent_cam,
)

FOLLOWERS = [
    Flat(),
    Flat(distance=120, face=4),
    Flat(distance=-120),
    Roller(0),
    Roller(9, offset=6),
    Roller(9, arm=90, distance=110),
    Roller(9, arm=90, distance=-110),
]
each = pytest.mark.parametrize("follower", FOLLOWERS, ids=str)
TURN = np.radians(np.arange(0.25, 360, 1.5))
EGG = ArcContour.hull([(0j, 25.0), (18 + 10j, 12.0), (-6 + 14j, 15.0)])


def circle(samples=1440):
    return SmoothContour.of(lambda u: np.stack([10 + 30 * np.cos(u), 4 + 30 * np.sin(u)], axis=-1), samples)


@given(st.floats(0, 20), st.floats(31, 60), st.floats(0, 15), st.floats(-8, 8), st.floats(0, 6))
def test_the_eccentric_in_closed_form(eccentricity, radius, roller, offset, phi):
    contour = ArcContour([ContourArc(0.0, complex(eccentricity), radius)])
    x, y, reach = eccentricity * math.cos(phi), eccentricity * math.sin(phi), radius + roller
    flat, guided = follower_motion(contour, Flat(), phi), follower_motion(contour, Roller(roller, offset=offset), phi)
    assert [float(one) for one in flat] == pytest.approx([radius + y, x, -y], abs=1e-9)
    # s = y + w with w^2 = reach^2 - (offset - x)^2, x' = -y, y' = x
    u = offset - x
    w = math.sqrt(reach**2 - u**2)
    w1 = -u * y / w
    w2 = -(y * y + u * x + w1 * w1) / w
    assert [float(one) for one in guided] == pytest.approx([y + w, x + w1, -y + w2], abs=1e-7)


def test_a_tangent_cam_of_the_books():
    """On the flank (R + r)(sec phi - 1) of lift, on the nose a slider-crank; e.g. Bevan, Theory of Machines, ch. 9."""
    base, nose, distance, roller = 25.0, 8.0, 30.0, 12.0
    contour = tangent_cam(base, nose, distance)
    half = math.acos((base - nose) / distance)
    # The nose is up when the cam has turned by 90 degrees; theta from there.
    flank_end = half - math.atan2(math.sqrt(distance**2 - (base - nose) ** 2), base + roller)
    theta = np.linspace(0, half, 400)[1:-1]
    found = follower_motion(contour, Roller(roller), math.pi / 2 - theta)
    flank = half - theta
    on_flank = flank < half - flank_end - 1e-9
    lift = (base + roller) / np.cos(flank)
    across = np.maximum((nose + roller) ** 2 - (distance * np.sin(theta)) ** 2, 0)
    crank = distance * np.cos(theta) + np.sqrt(across)
    assert on_flank.any()
    assert not on_flank.all()
    assert found.coordinate == pytest.approx(np.where(on_flank, lift, crank), abs=1e-9)
    tangent = np.tan(flank)
    assert found.velocity[on_flank] == pytest.approx((lift * tangent)[on_flank], abs=1e-8)
    assert found.acceleration[on_flank] == pytest.approx((lift * (1 + 2 * tangent**2))[on_flank], abs=1e-7)


@each
@pytest.mark.parametrize("contour", [EGG, circle()], ids=["arcs", "spline"])
def test_rates_are_derivatives(contour, follower):
    """Away from the jumps of curvature; there the median counts."""
    h = 1e-5
    before, here, after = (follower_motion(contour, follower, TURN + k * h) for k in (-1, 0, 1))
    for order in (0, 1):
        slope = (after[order] - before[order]) / (2 * h)
        scale = np.abs(here[order + 1]).max()
        wrong = np.abs(slope - here[order + 1]) / scale
        assert np.quantile(wrong, 0.97) < 2e-5
        assert order or wrong.max() < 1e-3


@each
def test_arcs_and_splines_are_rivals(follower):
    exact = follower_motion(ArcContour([ContourArc(0.0, 10 + 4j, 30.0)]), follower, TURN)
    for got, want, slack in zip(follower_motion(circle(), follower, TURN), exact, (1e-9, 1e-7, 1e-5), strict=True):
        assert np.abs(got - want).max() < slack * max(1.0, np.abs(want).max())


@pytest.mark.parametrize("follower", [one for one in FOLLOWERS if one != Roller(0)], ids=str)
def test_the_follower_touches_and_does_not_cut(follower):
    """Oracle: many points of the contour, none of them inside the roller or beyond the face, one nearly on it."""
    parts = []
    for arc, after in zip(EGG.arcs, (*EGG.arcs[1:], EGG.arcs[0]), strict=True):
        span = (after.start - arc.start) % math.tau
        parts.append(arc.centre + arc.radius * np.exp(1j * np.linspace(arc.start, arc.start + span, 4000)))
    points = np.concatenate(parts)
    phi = TURN[::5]
    s = follower_motion(EGG, follower, phi).coordinate
    turned = points[None, :] * np.exp(1j * phi)[:, None]
    if isinstance(follower, Roller):
        room = np.abs(turned - follower.path(s).at[:, None]) - follower.radius
    else:
        line = follower.line(s)
        room = line.distance[:, None] - np.real(turned * np.exp(-1j * line.angle)[:, None])
    assert room.min() > -1e-9
    touching = room.min(axis=1) < 1e-4
    # On straight lines, which have no points in the table, the roller stays away from both ends.
    assert touching.mean() > (0.5 if isinstance(follower, Roller) else 0.999)


def test_a_hollow_contour_is_bridged_by_a_flat_face():
    """A face rests on both sides of a hollow: the motion is that of the convex hull."""
    hollow = SmoothContour.of(lambda u: (30 + 4 * np.cos(2 * u))[:, None] * np.stack([np.cos(u), np.sin(u)], axis=-1))
    r = 30 + 4 * np.cos(2 * np.linspace(0, math.tau, 20001))
    points = r * np.exp(1j * np.linspace(0, math.tau, 20001))
    found = follower_motion(hollow, Flat(), TURN).coordinate
    highest = np.imag(points[None, :] * np.exp(1j * TURN)[:, None]).max(axis=1)
    assert found == pytest.approx(highest, abs=1e-5)


def test_points_in_either_sense_and_closed_or_not():
    u = np.linspace(0, math.tau, 241)
    table = np.stack([10 + 30 * np.cos(u), 30 * np.sin(u)], axis=1)
    table[-1] = table[0]
    results = [follower_motion(SmoothContour.through(t), Flat(), TURN) for t in (table, table[:-1], table[::-1])]
    for one in results:
        assert one.coordinate == pytest.approx(30 + 10 * np.sin(TURN), abs=1e-5)
        assert one.acceleration == pytest.approx(-10 * np.sin(TURN), abs=0.05)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ArcContour([]), "at least one arc"),
        (lambda: ArcContour([ContourArc(0, 0j, -1)]), "no negative radius"),
        (lambda: ArcContour([ContourArc(0, 0j, math.nan)]), "finite"),
        (lambda: ArcContour([ContourArc(1, 0j, 5), ContourArc(0, 1 + 0j, 5)]), "counter-clockwise"),
        (lambda: ArcContour([ContourArc(0, 0j, 5), ContourArc(1, 9 + 0j, 5)]), "no common tangent"),
        (lambda: SmoothContour.through([[0, 1], [1, 0]]), "at least four points"),
        (lambda: SmoothContour.through([[1, 2, 3]] * 5), "two finite numbers"),
        (lambda: SmoothContour.through([[1, 2]] * 5), "neighbours different"),
        (lambda: SmoothContour.through([[5, 5], [6, 5], [6, 6], [5, 6]]), "once around the cam's axis"),
        (lambda: SmoothContour.of(lambda u: u), "points x, y for 1440 angles"),
        (lambda: follower_motion(EGG, Roller(2, offset=200), 0.0), "does not meet the contour at 0 degrees"),
        (lambda: follower_motion(circle(), Roller(2, offset=200), 0.0), "does not meet the contour"),
        (lambda: follower_motion(EGG, Flat(), math.nan), "expected finite numbers, not nan"),
        (lambda: follower_motion(EGG, Flat(), "now"), "expected finite numbers, not 'now'"),
        (lambda: ArcContour.hull([]), "at least one circle"),
        (lambda: ArcContour.hull([(0j, math.inf)]), "finite"),
        (lambda: tangent_cam(20, -3, 30), "no negative radius"),
        (
            lambda: follower_motion(ArcContour([ContourArc(0.0, 19 + 0j, 21.0)]), Roller(offset=-2), 0.0),
            "jams at 0 degrees",
        ),
    ],
)
def test_absurd_contours_are_refused(make, words):
    with pytest.raises(CamError, match=words):
        make()


@pytest.mark.parametrize("value", [1e70, -1e308])
def test_contours_without_measure_are_refused(value):
    points = [(40, 0), (0, 40), (-40, 0), (0, -40), (value, -1)]
    with pytest.raises(CamError, match="coordinates below 1e"):
        SmoothContour.through(points)
