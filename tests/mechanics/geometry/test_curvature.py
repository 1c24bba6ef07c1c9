"""Inflection circle, Euler-Savary, centres of curvature."""

import math

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.geometry import inflection_circle, path_curvature
from gruebler.mechanics.geometry.relative import relative_motion
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, LinkPoint

from .linkages import MOVING, moved

ARMS = [0.4 + 0.3j, -1.1 + 0.8j, 2.0 - 1.7j]  # points of the moving link, in sizes of the linkage


@pytest.mark.parametrize("name", MOVING)
@pytest.mark.parametrize("relative", [False, True])
def test_a_point_on_the_inflection_circle_has_no_normal_acceleration(name, relative):
    motion, one, other = moved(name)
    reference = other if relative else motion.linkage.mechanism.frame
    circle, seen = inflection_circle(motion, one, reference), relative_motion(motion, one, reference, order=2)
    middle = circle.pole - 0.5j * circle.shift
    for angle in (0.3, 2.0, 4.0):
        there = middle + circle.diameter / 2 * np.exp(1j * angle) * circle.normal
        arm = np.conj(seen.turn) * (there - seen.places[0])
        velocity, acceleration = seen.complex_point(arm, order=1), seen.complex_point(arm, order=2)
        known = np.isfinite(velocity)
        normal = (np.conj(velocity) * acceleration).imag[known]
        assert np.all(abs(normal) <= 1e-8 * abs(velocity[known]) * (abs(acceleration[known]) + abs(velocity[known])))


@pytest.mark.parametrize("name", MOVING)
@pytest.mark.parametrize("relative", [False, True])
def test_rivals_for_centres_of_curvature(name, relative):
    """Euler-Savary on the pole and its shift, against velocity and acceleration of the point itself."""
    motion, one, other = moved(name)
    reference = other if relative else motion.linkage.mechanism.frame
    circle = inflection_circle(motion, one, reference)
    for arm in np.array(ARMS) * motion.linkage.size:
        path = path_curvature(motion, LinkPoint(one, arm.real, arm.imag), reference)
        curved = np.isfinite(circle.pole) & (abs(path.curvature) * motion.linkage.size > 1e-3)
        assert np.allclose(circle.centre(path.point)[curved], path.centre[curved], rtol=1e-7)


@pytest.mark.parametrize("name", MOVING)
def test_oracle_three_points(name):
    """The circle through three neighbouring points of the path, and differences of the curvature along it."""
    motion, one, _ = moved(name)
    path = path_curvature(motion, LinkPoint(one, 0.5 * motion.linkage.size, 0.7 * motion.linkage.size))
    a, b, c = path.point[:-2], path.point[1:-1], path.point[2:]
    area = (np.conj(b - a) * (c - a)).imag
    through = 2 * area / (abs(b - a) * abs(c - b) * abs(c - a))
    bend = path.curvature
    assert np.all(abs(through - bend[1:-1]) <= abs(bend[2:] - bend[:-2]) + 1e-4 / motion.linkage.size)
    assert np.median(abs(through / bend[1:-1] - 1)) < 1e-2
    slope, before, after = np.diff(bend) / abs(np.diff(path.point)), path.change[:-1], path.change[1:]
    assert np.all(abs(2 * slope - before - after) <= 0.02 * abs(before + after) + abs(after - before))
    assert np.median(abs(2 * slope / (before + after) - 1)) < 1e-2


@pytest.mark.parametrize("name", MOVING)
def test_geometry_does_not_know_the_time(name):
    """Another speed and acceleration of the drive, the same circles."""
    (slow, one, _), (fast, _, _) = moved(name), moved(name, acceleration=-4.0, jerk=9.0)
    for other in (None, MOVING[name][3]):
        first, second = inflection_circle(slow, one, other), inflection_circle(fast, one, other)
        assert np.allclose(first.inflection_pole, second.inflection_pole, rtol=1e-9, equal_nan=True)
    path, again = (path_curvature(each, LinkPoint(one, 0.5 * slow.linkage.size, 0.7)) for each in (slow, fast))
    scale = np.maximum(abs(path.change), slow.linkage.size**-2)
    assert np.abs((path.change - again.change) / scale).max() < 1e-6


def test_joints_on_the_frame_are_centres():
    motion, _, _ = moved("four-bar")
    assert np.allclose(path_curvature(motion, "R(crank-coupler)").centre, 0, atol=1e-9)
    rocker = path_curvature(motion, "R(coupler-rocker)")
    assert np.allclose(rocker.centre, 70, atol=1e-9)
    assert np.abs(rocker.change).max() < 1e-12
    assert np.allclose(abs(rocker.radius), 40)


def test_euler_savary_as_it_is_written():
    """(1/r - 1/r') sin = 1/D on every ray: PX^2 = XW XX0 with the inflection point W of the ray."""
    motion, one, _ = moved("four-bar")
    circle = inflection_circle(motion, one)
    point = motion.complex_point("K")
    ray = (point - circle.pole) / abs(point - circle.pole)
    on_ray = circle.diameter * (np.conj(ray) * circle.normal).real
    distance = abs(point - circle.pole)
    signed = (np.conj(ray) * (point - circle.centre(point))).real
    assert np.allclose(distance**2, (distance - on_ray) * signed, rtol=1e-9)


@pytest.mark.parametrize(("lam", "phi0"), [(5 / 6, math.atan(math.sqrt(2))), (0.7, math.asin(math.sqrt(0.6)))])
def test_meyer_zur_capellen(lam, phi0):
    """The symmetric double rocker in its middle: D = 1, and the coupler point is the inflection pole W = (0, D).

    From the pole P = 0 with tangent x and normal y: A' = (-lambda cot phi0, lambda), PA'^2 = A'W A'A0'.
    """
    joint = complex(-lam / math.tan(phi0), lam)
    from_pole = abs(joint)
    length = from_pole**2 / (from_pole - math.sin(phi0))
    pivot = joint - length * joint / from_pole
    drawn = {
        "R(frame-crank)": (pivot.real, pivot.imag),
        "R(crank-coupler)": (joint.real, joint.imag),
        "R(coupler-rocker)": (-joint.real, joint.imag),
        "R(frame-rocker)": (-pivot.real, pivot.imag),
    }
    if lam == 5 / 6:
        assert abs(length - 5.103103630798287) < 1e-12
        assert abs(2 * pivot.real - 4.714045207910317) < 1e-12
    linkage = Linkage.from_drawing(FourBar(1, 1, 1, 1).linkage().mechanism, drawn, points={"K": ("coupler", 0.0, 1.0)})
    motion = move(linkage, np.angle(joint - pivot), speed=1, order=3)
    circle, path = inflection_circle(motion, "coupler"), path_curvature(motion, "K")
    assert abs(circle.pole[0]) < 1e-12
    assert abs(circle.diameter[0] - 1) < 1e-12
    assert abs(circle.inflection_pole[0] - 1j) < 1e-12
    assert abs(circle.normal[0] - 1j) < 1e-12
    assert abs(circle.tangent[0] - 1) < 1e-12
    assert abs(path.point[0] - 1j) < 1e-12
    assert abs(path.curvature[0]) < 1e-12
    assert abs(path.change[0]) < 1e-11


def test_isosceles_crank_rocker_has_a_straight_point():
    """The replacing crank-rocker: curvature and its change vanish at 180 degrees, of the order (phi - 180 deg)^4."""
    bar = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4).linkage({"K": (8.018753738744802, 2.268046058132576)})
    path = path_curvature(move(bar, np.radians([180, 185, 190]), speed=1, order=3, branch="+"), "K")
    assert abs(path.curvature[0]) < 1e-12
    assert abs(path.change[0]) < 1e-10
    assert 14 < path.curvature[2] / path.curvature[1] < 18


def test_cardan_circles():
    """Slider-crank a = b: every point of the inflection circle moves on a straight line through A0."""
    motion = move(SliderCrank(1, 1).linkage(), np.radians(np.arange(10, 80, 5)), speed=1, order=3)
    circle = inflection_circle(motion, "coupler")
    assert np.allclose(circle.diameter, 2)
    assert np.allclose(circle.inflection_pole, 0)
    opposite = path_curvature(motion, LinkPoint("coupler", -1.0, 0.0))
    assert np.abs(opposite.point.real).max() < 1e-12
    assert np.abs(opposite.curvature).max() < 1e-12


def test_a_link_that_turns_about_a_fixed_pivot():
    motion, _, _ = moved("four-bar")
    circle = inflection_circle(motion, "rocker")
    assert not circle.diameter.any()
    assert np.isnan(circle.tangent).all()
    assert np.allclose(circle.centre(motion.complex_point("R(coupler-rocker)")), 70)


def test_translation_and_cusp():
    motion = move(FourBar(25, 70, 25, 70).linkage({"K": (10, 5)}), np.radians([40, 80]), speed=1, branch="+")
    assert np.isnan(inflection_circle(motion, "coupler").pole).all()
    assert np.allclose(abs(path_curvature(motion, "K").radius), 25)
    moving, one, _ = moved("four-bar")
    pole = relative_motion(moving, one).pole
    seen = relative_motion(moving, one)
    arm = (np.conj(seen.turn) * (pole - seen.places[0]))[40]
    cusp = path_curvature(moving, LinkPoint(one, arm.real, arm.imag))
    assert np.isnan(cusp.curvature[40])
    assert np.isfinite(cusp.curvature[30])


def test_wrong_calls():
    motion = move(FourBar(25, 70, 40, 70).linkage(), [0.1, 0.2], speed=1, order=1)
    with pytest.raises(LinkageError, match=r"needs accelerations.*order=2"):
        inflection_circle(motion, "coupler")
    motion = move(FourBar(25, 70, 40, 70).linkage(), [0.1, 0.2], speed=1)
    with pytest.raises(LinkageError, match="lies on 'frame'"):
        path_curvature(_with_frame_point(), "Q")
    with pytest.raises(LinkageError, match="no link 'copler'"):
        inflection_circle(motion, "copler")
    assert path_curvature(motion, "R(coupler-rocker)").change is None


def _with_frame_point():
    linkage = FourBar(25, 70, 40, 70).linkage().with_points({"Q": ("frame", 1, 1)})
    return move(linkage, [0.1, 0.2], speed=1)
