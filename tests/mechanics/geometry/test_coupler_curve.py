"""Coupler curves: what is on them, against constructions, other formulas, dense samples and figures."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry import coupler_curve
from gruebler.mechanics.geometry.relative import relative_motion
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, LinkPoint

from .linkages import CYLINDER, SIX_BAR
from .sextic_oracle import coupler_sextic

CRANK_ROCKER = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
CONCHOID = InvertedSliderCrank(30, 50).linkage({"C": (90, 0)})
DOUBLE_ROCKER = FourBar(60, 30, 30, 70).linkage({"K": (15, 20)})
CURVES = {
    "crank-rocker": (CRANK_ROCKER, "K"),
    "conchoid": (CONCHOID, "C"),
    "double rocker": (DOUBLE_ROCKER, "K"),
    "lambda": (FourBar(20, 50, 50, 40).linkage({"K": (100, 0)}), "K"),
    "slider-crank": (SliderCrank(25, 70, 10).linkage({"K": (30, 20)}), "K"),
    "six-bar": (SIX_BAR, "K"),
    "cylinder": (CYLINDER, "K"),
}


def degrees(values):
    return [math.degrees(one.drive) for one in values]


@pytest.fixture(scope="module", params=CURVES)
def curve(request):
    return coupler_curve(*CURVES[request.param])


def test_e17_literature():
    """E17, conchoid of 30, 50, 90: the figures of the inflections come from samples and are cut off."""
    found = coupler_curve(CONCHOID, "C")
    assert degrees(found.inflections) == pytest.approx([80.55, 147.09, 360 - 147.09, 360 - 80.55], abs=0.01)
    assert degrees(found.inflections) == pytest.approx(
        [80.556160615, 147.098377807, 212.901622193, 279.443839385], abs=1e-8
    )
    ends = {round(math.degrees(one.drive)): abs(one.curvature) for one in found.vertices}
    assert ends[0] == pytest.approx(0.021088, abs=5e-7)
    assert ends[180] == pytest.approx(1.233333, abs=5e-7)
    no_straight_way = coupler_curve(InvertedSliderCrank(30, 50).linkage({"C": (640 / 3, 0)}), "C")
    assert any(math.isclose(one.drive, math.pi, abs_tol=1e-6) for one in no_straight_way.inflections)  # b = 213.333


def test_a_six_point_contact_is_one_flat_point():
    """Document 001: at 180 degrees; four inflections have become one, which is a vertex of curvature 0."""
    lenker = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4)
    found = coupler_curve(lenker.linkage({"K": (8.018753738744802, 2.268046058132576)}), "K")
    (flat,) = found.inflections
    assert flat.drive == pytest.approx(math.pi, abs=1e-10)
    assert (flat.points, flat.flat) == (6, True)
    assert next(one for one in found.vertices if one.drive == flat.drive).curvature == pytest.approx(0, abs=1e-12)
    off = coupler_curve(lenker.linkage({"K": (8.018753738744802, 2.26)}), "K")
    assert all(one.points == 3 for one in off.inflections)


def test_watt_touches_with_five_points():
    """E18: the middle of the coupler, in the middle position; the curve crosses its tangent there."""
    drawn = {
        "R(frame-crank)": (-60, 15),
        "R(crank-coupler)": (0, 15),
        "R(coupler-rocker)": (0, -15),
        "R(frame-rocker)": (60, -15),
    }
    watt = Linkage.from_drawing(FourBar(1, 1, 1, 1).linkage().mechanism, drawn, points={"F": ("coupler", 0.0, 0.0)})
    found = coupler_curve(watt, "F")
    (middle,) = [one for one in found.inflections if abs(one.at) < 1e-6]
    assert (middle.points, middle.flat) == (5, False)
    assert abs(math.cos(middle.direction)) < 1e-9
    assert found.contact(0.0).points == 5


def test_polygon_keeps_its_tolerance(curve):
    """Oracle: dense points of the path, each against the side that belongs to its parameter."""
    trail, samples = curve.point_path, curve._samples
    s = np.linspace(trail.start, trail.end, 5001)[:-1]
    z = trail.at(s, 0)[0]
    side = np.searchsorted(samples.parameters, s, side="right") - 1
    p, q = samples.points[side], samples.points[side + 1]
    part = np.clip((np.conj(q - p) * (z - p)).real / np.maximum(abs(q - p) ** 2, 1e-300), 0, 1)
    assert abs(p + part * (q - p) - z).max() <= 1.2 * curve.tolerance
    finer = coupler_curve(curve.point_path.cycle.linkage, curve.point_path.place, tolerance=curve.tolerance / 16)
    assert 1.8 < len(finer.points) / len(curve.points) < 6  # as the root of the tolerance, but for the first 64


def test_length_and_area_are_those_of_dense_polygons(curve):
    s = np.linspace(curve.point_path.start, curve.point_path.end, 40001)
    z = curve.point_path.at(s, 0)[0]
    steps = np.abs(np.diff(z))
    assert curve.length == pytest.approx(steps.sum(), rel=1e-6)
    assert curve.length_error < 1e-8 * curve.length
    assert curve.arcs[-1] == pytest.approx(curve.length, rel=3e-3)
    if curve.closed:
        assert curve.area == pytest.approx((np.conj(z[:-1]) * z[1:]).imag.sum() / 2, rel=1e-6)
    else:
        assert curve.area is None


def test_events_by_samples(curve):
    """Oracle: turning angles of a dense polygon change sign in inflections; coordinates turn back in turning points."""
    s = np.linspace(curve.point_path.grid[0], curve.point_path.grid[-1], 20001)
    z = curve.point_path.at(s, 0)[0]
    if curve.closed:
        z = np.concatenate([z, z[1:3]])
    bends = np.sign((np.conj(np.diff(z[:-1])) * np.diff(z[1:])).imag)
    if not curve.cusps:  # (the six-bar's K stands still and goes back where crank and coupler are in line)
        assert len(curve.inflections) == (bends[1:] != bends[:-1]).sum()
    for direction in (0.0, math.pi / 2, 1.1):
        ways = np.sign(np.diff((z * np.exp(-1j * direction)).real))
        assert len(curve.turning_points(direction)) == (ways[1:] != ways[:-1])[: len(s) - 1].sum()


def test_inflections_and_vertices_are_what_they_say(curve):
    for one in curve.inflections:
        _, v, a, _ = curve.point_path.at(np.array([one.parameter]))[:, 0]
        assert abs((np.conj(v) * a).imag) < 1e-9 * abs(v) * max(abs(a), abs(v))
        assert math.isclose(math.remainder(np.angle(v) - one.direction, 2 * math.pi), 0, abs_tol=1e-9)
    h = 1e-3
    for one in curve.vertices:
        _, v, a, _ = curve.point_path.at(one.parameter + h * np.array([-1, 0, 1]))
        bends = (np.conj(v) * a).imag / abs(v) ** 3
        assert bends[1] == pytest.approx(one.curvature, rel=1e-9)
        assert (np.argmax if one.kind == "maximum" else np.argmin)(bends) == 1


def test_four_vertices(curve):
    """A simple closed curve has at least four vertices; any closed one without cusps an even number of inflections."""
    simple = curve.closed and not curve.double_points and not curve.cusps
    assert len(curve.vertices) >= (4 if simple else 0)
    assert len(curve.inflections) % 2 == 0 or not curve.closed or curve.cusps


def crosses(z, closed):
    """How often a polygon crosses itself: every pair of sides."""
    p, q = z[:-1], z[1:]
    count = 0
    for i in range(len(p)):
        j = np.arange(i + 2, len(p) - (closed and i == 0))
        first = (np.conj(q[i] - p[i]) * (p[j] - p[i])).imag * (np.conj(q[i] - p[i]) * (q[j] - p[i])).imag
        second = (np.conj(q[j] - p[j]) * (p[i] - p[j])).imag * (np.conj(q[j] - p[j]) * (q[i] - p[j])).imag
        count += ((first < 0) & (second < 0)).sum()
    return count


@given(
    lengths=st.tuples(*[st.floats(1, 6)] * 4),
    u=st.floats(-8, 8),
    v=st.floats(0.5, 8),
)
@settings(max_examples=25, deadline=None)
def test_double_points_of_a_four_bar(lengths, u, v):
    """Law: they lie on the circle through the three pivots, where the sextic's gradient vanishes. Oracle: all sides."""
    bar = FourBar(*lengths)
    try:
        found = coupler_curve(bar.linkage({"K": (u, v)}), "K")
    except LinkageError:
        assume(False)  # it cannot be assembled, or moved
    third = complex(u, v) / bar.b * bar.d
    centre = complex(bar.d / 2, (abs(third) ** 2 - bar.d * third.real) / (2 * third.imag))
    sextic = coupler_sextic(bar, u, v)
    for one in found.double_points:
        assert abs(abs(one.at - centre) - abs(centre)) < 1e-7 * (abs(centre) + 10)
        assert abs(sextic.gradient(one.at)) < 1e-7 * 20**5
        ends = found.point_path.cycle.at(np.array(one.drives), 0).complex_point("K")
        assert abs(ends - one.at).max() < 1e-9
        assert not one.touching or one.angle < 1e-4
    if all(one.angle > 0.05 for one in found.double_points):
        s = np.linspace(found.point_path.start, found.point_path.end, 1201)
        assert len(found.double_points) == crosses(found.point_path.at(s, 0)[0], found.closed)


def symmetric(off):
    """BA = BB0 = BK: K is on the axis of its curve at 0 and 180 degrees; without ``off`` both times in one point.

    B0K = 2 r sin((alpha + gamma)/2) with gamma = the angle ABK and sin(alpha/2) = (d -+ a)/(2 r).
    """
    a, r, d = 1.0, 75**0.5 / 2, 4.0
    gamma = math.pi - math.asin((d - a) / (2 * r)) - math.asin((d + a) / (2 * r)) + off
    k = r - r * np.exp(-1j * gamma)
    return coupler_curve(FourBar(a, r, r, d).linkage({"K": (k.real, k.imag)}), "K").double_points


def test_a_curve_that_touches_itself():
    """A touch is one double point; a little to one side there are two crossings, to the other none."""
    (touch,) = symmetric(0)
    assert touch.touching
    assert touch.drives == pytest.approx((0, math.pi), abs=1e-9)
    assert touch.angle < 1e-9
    assert sorted(len(symmetric(off)) for off in (-1e-3, 1e-3)) == [0, 2]
    assert not any(one.touching for off in (-1e-3, 1e-3) for one in symmetric(off))


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank"])
@pytest.mark.parametrize("phi", [0.4, 2.5, 5.0])
def test_a_cusp_on_the_moving_centrode(name, phi):
    """The coupler's point that is the pole stands still: the path has a cusp with the pole normal as its tangent."""
    linkage, _ = CURVES[name]
    motion = move(linkage, [phi], speed=1, order=2)
    seen = relative_motion(motion, "coupler")
    arm = complex(np.conj(seen.turn[0]) * (seen.pole[0] - seen.places[0, 0]))
    found = coupler_curve(linkage, LinkPoint("coupler", arm.real, arm.imag))
    near = [one for one in found.cusps if abs(one.drive - phi) < 1e-6]
    assert len(near) == 1
    assert near[0].drive == pytest.approx(phi, abs=1e-10)
    assert not near[0].flat
    assert abs(near[0].at - seen.pole[0]) < 1e-9 * linkage.size
    ahead = found.point_path.at(np.array([near[0].parameter + 1e-4]), 1)[1, 0]
    assert abs(math.remainder(np.angle(ahead) - near[0].direction, 2 * math.pi)) < 1e-2
    assert all(abs(one.drive - phi) > 1e-3 for one in (*found.inflections, *found.vertices))
    aside = coupler_curve(linkage, LinkPoint("coupler", arm.real + 1e-3, arm.imag + 2e-3))
    assert not [one for one in aside.cusps if abs(one.drive - phi) < 0.1]


def test_arcs_circles_and_straight_lines():
    rocker = coupler_curve(CRANK_ROCKER, "R(coupler-rocker)")
    swing = FourBar(25, 70, 40, 70).swing
    assert rocker.length == pytest.approx(2 * 40 * swing)
    assert [one.flat for one in rocker.cusps] == [True, True]
    assert rocker.retraced
    assert rocker.double_points == rocker.inflections == rocker.vertices == ()
    crank = coupler_curve(CRANK_ROCKER, "R(crank-coupler)")
    assert crank.length == pytest.approx(50 * math.pi)
    assert crank.area == pytest.approx(625 * math.pi)
    assert (crank.vertices, crank.inflections, crank.cusps, crank.double_points) == ((), (), (), ())
    assert not crank.retraced
    slider = coupler_curve(SliderCrank(2, 5).linkage(), "R(coupler-slider)")
    assert slider.length == pytest.approx(8)
    assert degrees(slider.cusps) == pytest.approx([0, 180], abs=1e-9)
    assert [one.kind for one in slider.turning_points()] == ["maximum", "minimum"]
    assert slider.turning_points(math.pi / 2) == ()


def test_a_coupler_that_goes_back():
    """Class III: where crank and coupler are in line the other links stand still and go back on their ways."""
    found = coupler_curve(SIX_BAR, "K")
    assert [one.flat for one in found.cusps] == [True]
    assert found.retraced
    assert found.double_points == ()


def test_turning_points_are_the_bounding_box():
    found = coupler_curve(CRANK_ROCKER, "K")
    z = found.point_path.at(np.linspace(0, 2 * math.pi, 3600), 0)[0]
    for direction in (0.0, math.pi / 2, 2.0):
        ends = [(one.at * np.exp(-1j * direction)).real for one in found.turning_points(direction)]
        seen = (z * np.exp(-1j * direction)).real
        assert max(ends) == pytest.approx(seen.max(), abs=1e-4)
        assert min(ends) == pytest.approx(seen.min(), abs=1e-4)


@given(st.floats(0, 6.28), st.floats(0.01, 100))
@settings(max_examples=10, deadline=None)
def test_laws_of_scale_and_mirror(turn, factor):
    """Another unit; the mirror image, which is gone through the other way: the same events, lengths, areas."""
    one = coupler_curve(CRANK_ROCKER, "K")
    scaled = coupler_curve(CRANK_ROCKER.scaled(factor), "K")
    assert scaled.length == pytest.approx(factor * one.length, rel=1e-9)
    assert scaled.area == pytest.approx(factor**2 * one.area, rel=1e-9)
    assert degrees(scaled.vertices) == pytest.approx(degrees(one.vertices), abs=1e-6)
    mirrored = coupler_curve(CRANK_ROCKER.mirrored(), "K", branch="-")
    assert mirrored.area == pytest.approx(one.area, rel=1e-9)
    assert degrees(mirrored.inflections) == pytest.approx(sorted(360 - v for v in degrees(one.inflections)), abs=1e-6)
    assert len(mirrored.turning_points(turn)) == len(one.turning_points(-turn))


def test_wrong_calls():
    with pytest.raises(LinkageError, match="lies on the frame"):
        coupler_curve(CRANK_ROCKER.with_points({"Q": ("frame", 1, 1)}), "Q")
    with pytest.raises(LinkageError, match=r"'R\(frame-rocker\)' does not move"):
        coupler_curve(CRANK_ROCKER, "R(frame-rocker)")
    with pytest.raises(LinkageError, match="no point 'Kk'"):
        coupler_curve(CRANK_ROCKER, "Kk")
    for tolerance in (0, -1, math.nan, "x"):
        with pytest.raises(LinkageError, match="tolerance"):
            _ = coupler_curve(CRANK_ROCKER, "K", tolerance=tolerance).points
    with pytest.raises(LinkageError, match="tolerance must lie between"):
        _ = coupler_curve(CRANK_ROCKER, "K", tolerance=1e-12).points
    with pytest.raises(LinkageError, match="direction"):
        coupler_curve(CRANK_ROCKER, "K").turning_points(math.inf)


def test_a_far_point_is_sampled_by_its_own_path():
    """The polygon's tolerance goes with the path where that is larger than the linkage."""
    near, far = (coupler_curve(CRANK_ROCKER, LinkPoint("coupler", x, 40.0)) for x in (45.0, 1e10))
    assert near.tolerance == pytest.approx(1e-4 * near.point_path.size)
    assert len(far.points) < 10 * len(near.points)
    assert far.length == pytest.approx(np.hypot(*np.diff([far.points.real, far.points.imag], axis=1)).sum(), rel=1e-3)
    with pytest.raises(LinkageError, match="tolerance must lie between"):
        _ = coupler_curve(CRANK_ROCKER, "K", tolerance=1e9).points


def test_contact_at_any_turn_of_the_drive():
    curve = coupler_curve(CRANK_ROCKER, "K")
    turns = [curve.contact(0.7 + 2 * np.pi * k).coefficient for k in (-1, 0, 3)]
    assert turns == pytest.approx([turns[1]] * 3, rel=1e-9)
    assert curve.contact(1e9).points == 2
    rocking = coupler_curve(FourBar(40, 70, 25, 70).linkage({"K": (45, 40)}), "K")
    assert rocking.contact(1.0 + 2 * np.pi).coefficient == pytest.approx(rocking.contact(1.0).coefficient)
    with pytest.raises(LinkageError, match=r"the drive goes from 36\.9551° to 116\.801°, not to 179°"):
        rocking.contact(np.radians(179))
