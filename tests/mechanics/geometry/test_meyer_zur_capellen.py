"""Symmetric double rockers with contact in four and six points; figures of the document 001, recomputed."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank
from gruebler.mechanics.geometry import cognates, inflection_circle
from gruebler.mechanics.geometry.lever_contact import lever_contact
from gruebler.mechanics.geometry.meyer_zur_capellen import lambdas_for, symmetric_rocker
from gruebler.mechanics.kinematics import move

KAPPA = 15.79316904826399


def test_the_rocker_of_the_sheet():
    """Lambda = 5/6, D = 1."""
    made = symmetric_rocker(5 / 6)
    lever = made.lever
    assert math.isclose(math.degrees(made.phi0), 54.735610317245346)
    assert np.allclose(
        (lever.size.a, lever.size.b, lever.size.c, lever.size.d),
        (5.103103630798287, 1.1785113019775793, 5.103103630798287, 4.714045207910317),
        rtol=1e-13,
    )
    assert math.isclose(lever.k, 0.6123724356957945, rel_tol=1e-13)
    assert math.isclose(lever.l, lever.k, rel_tol=1e-13)
    assert math.isclose(math.degrees(lever.kappa), KAPPA, rel_tol=1e-13)
    assert math.isclose(math.tan(lever.kappa), math.sqrt(2) / 5, rel_tol=1e-13)
    assert lever.size.type.key == "grashof_double_rocker"


def test_similar_to_the_cognate_of_the_sheet():
    """25/3, 10/9 sqrt 3, 25/3, 40/9 sqrt 3 by the lengths for D = 1: one factor, 1/k'."""
    lever, root = symmetric_rocker(5 / 6).lever, math.sqrt(3)
    star = np.array([25 / 3, 10 / 9 * root, 25 / 3, 40 / 9 * root])
    mine = np.array([lever.size.a, lever.size.b, lever.size.c, lever.size.d])
    assert np.allclose(star / mine, 1 / lever.k, rtol=1e-13)
    assert sum(star[:3]) < 40 / 3 * root  # the printed frame is longer than the others together: not assemblable


@pytest.mark.parametrize(("ratio", "coefficient"), [(5 / 6, 0.0018), (0.7, 0.00130154), (1.2, 0.00184613)])
def test_contact_in_six_points(ratio, coefficient):
    made = symmetric_rocker(ratio)
    found = made.contact()
    assert made.is_six_point
    assert found.points == 6
    assert abs(abs(found.coefficient) - coefficient) < 5e-9
    sine = math.sin(made.phi0)
    assert math.isclose(sine**2, (1 + 2 * ratio) / 4, rel_tol=1e-14)
    assert math.isclose(made.lever.k, 1 / math.sqrt(1 + 2 * ratio), rel_tol=1e-12)
    tangent = (1 - ratio) / ratio * math.sqrt((1 + 2 * ratio) / (3 - 2 * ratio))
    assert math.isclose(math.tan(made.lever.kappa), tangent, rel_tol=1e-12)


@pytest.mark.parametrize(("ratio", "phi0", "coefficient"), [(0.8, 50, 0.0105215), (0.9, 45, 0.0493827)])
def test_contact_in_four_points(ratio, phi0, coefficient):
    made = symmetric_rocker(ratio, math.radians(phi0))
    found = made.contact()
    assert not made.is_six_point
    assert found.points == 4
    assert abs(abs(found.coefficient) - coefficient) < 5e-8


@given(st.floats(0.55, 1.45), st.floats(15, 80), st.floats(0.1, 10))
def test_deviation_in_closed_form(ratio, phi0, diameter):
    """c4 = (s^2 - (1 + 2 lambda)/4)(lambda - s^2)/(2 lambda^2 D^3)."""
    square = math.sin(math.radians(phi0)) ** 2
    assume(min(abs(ratio - square), abs(square - (1 + 2 * ratio) / 4)) > 0.02)
    found = symmetric_rocker(ratio, math.radians(phi0), diameter).contact()
    expected = (square - (1 + 2 * ratio) / 4) * (ratio - square) / (2 * ratio**2 * diameter**3)
    assert found.points == 4
    assert math.isclose(abs(found.coefficient), abs(expected), rel_tol=1e-6)


def test_the_law_of_deviation():
    """Crank-rocker with l1 = 1: eta = 1.55e-4 xi^6 at K_I, its tangent at kappa to the frame."""
    lever = symmetric_rocker(5 / 6).replacement()
    assert np.allclose((lever.size.b, lever.size.c, lever.size.d), (75**0.5 / 2, 75**0.5 / 2, 4), rtol=1e-13)
    assert math.isclose(lever.k, 25 / 3, rel_tol=1e-13)
    found = lever_contact(lever.size, lever.u, lever.v, math.pi)
    assert found.points == 6
    assert math.isclose(abs(found.coefficient), 1.55006772785498e-4, rel_tol=1e-10)
    assert abs(found.place - (1.7777777777777777 + 7.856742013183862j)) < 1e-12
    assert abs(math.degrees(found.direction) % 180 - KAPPA) < 1e-10
    speed = move(lever.size.linkage({"K": (lever.u, lever.v)}), math.pi, speed=1).complex_point("K", order=1)[0]
    assert abs(abs(speed) - 1.63299316) < 5e-9
    assert abs(abs(found.coefficient) * abs(speed) ** 6 - 0.00293938769) < 5e-12


def test_the_other_sign_of_kappa_is_another_curve():
    """Figures that are not those of the sheet: B0K_I = 5.443311, h = 1.557552."""
    lever = symmetric_rocker(5 / 6).replacement()
    near, far = (
        np.linalg.norm(lever.size.motion(phi).point(lever.u, -lever.v).value - [4, 0]) for phi in (math.pi, 0.0)
    )
    assert abs(near - 5.443311) < 5e-7
    assert abs(far - near - 1.557552) < 5e-7


def test_replacement_of_three_quarters():
    """Lambda = 3/4: 1 : 2 sqrt 6 : 2 sqrt 6 : 5, k = 9."""
    lever = symmetric_rocker(0.75).replacement()
    assert np.allclose((lever.size.b**2, lever.size.c**2, lever.size.d, lever.k, lever.l**2), (24, 24, 5, 9, 24))
    assert abs(math.degrees(lever.kappa) - 23.283732) < 5e-7
    assert lever.size.type.key == "crank_rocker"


@pytest.mark.parametrize(
    ("kappa", "both"),
    [
        (5, (0.94879918, 1.049508978)),
        (10, (0.896079766, 1.097158592)),
        (20, (0.786803233, 1.186241638)),
        (30, (0.673648178, 1.266044443)),
        (KAPPA, (5 / 6, 1.149829914)),
    ],
)
def test_ratio_for_an_angle(kappa, both):
    found = lambdas_for(math.radians(kappa))
    assert np.allclose(found, both, rtol=0, atol=1e-9)
    for value, side in zip(found, (1, -1), strict=True):
        assert math.isclose(value**2 * (3 - 2 * value), math.cos(math.radians(kappa)) ** 2, rel_tol=1e-12)
        made = symmetric_rocker(value)
        assert abs(math.degrees(made.lever.kappa) - side * kappa) < 1e-8
        assert abs(math.degrees(made.phi0) - (60 - side * kappa / 3)) < 1e-8


@given(st.floats(0, 88.7))
def test_ratio_for_an_angle_oracle(kappa):
    """Another hand: the roots of the cubic in the open interval, by numpy."""
    roots = np.roots([-2, 3, 0, -(math.cos(math.radians(kappa)) ** 2)])
    real = sorted(r.real for r in roots if abs(r.imag) < 1e-6 and 0.5 < r.real < 1.5)
    found = lambdas_for(math.radians(kappa))
    if kappa > 0.01 and abs(kappa - 45) > 0.1:  # a double root, a root on the bound
        assert np.allclose(found, real, atol=1e-7)
    assert all(0.5 < value < 1.5 for value in found)


@given(st.floats(0.55, 1.45), st.floats(15, 80), st.floats(0.1, 10))
def test_construction_laws(ratio, phi0, diameter):
    """Rival: the inflection circle of the moved linkage, with its pole in K; Euler-Savary; the cognates' lengths."""
    angle = math.radians(phi0)
    assume(abs(ratio - math.sin(angle) ** 2) > 0.05)
    made = symmetric_rocker(ratio, angle, diameter)
    lever = made.lever
    a0, a, _, b0 = made.pins
    foot = diameter * math.sin(angle)  # where the ray meets the inflection circle
    assert math.isclose(abs(a) ** 2, abs(abs(a) - foot) * lever.size.a, rel_tol=1e-9)
    linkage = lever.size.linkage({"K": (lever.u, lever.v)})
    motion = move(linkage, made.phi, speed=1, branch=lever.branch)
    circle = inflection_circle(motion, "coupler")
    k = motion.complex_point("K")[0]
    turned = (b0 - a0) / abs(b0 - a0)
    assert abs(k - (made.point - a0) / turned) < 1e-9 * (diameter + lever.size.a)
    assert math.isclose(abs(circle.diameter[0]), diameter, rel_tol=1e-6)
    assert made.contact().points >= 4
    other = made.replacement(2.0)
    _, second, third = cognates(lever.size, lever.u, lever.v, branch=lever.branch, phi=made.phi)
    for cognate in (second, third):
        mine, theirs = (np.sort((size.a, size.b, size.c)) / size.d for size in (other.size, cognate.size))
        assert np.allclose(mine, theirs, rtol=1e-9)


@given(st.floats(0.6, 1.4))
def test_the_replacement_draws_the_same_curve(ratio):
    """A law of similarity: the coefficient of contact goes with the fifth power of the size."""
    made = symmetric_rocker(ratio)
    lever = made.replacement()
    scale = 1 / made.lever.k
    rocker, crank = made.contact(), lever_contact(lever.size, lever.u, lever.v, math.pi)
    assert (rocker.points, crank.points) == (6, 6)
    assert math.isclose(abs(crank.coefficient), abs(rocker.coefficient) / scale**5, rel_tol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((0.5,), "between 0.5 and 1.5"),
        ((1.5,), "between 0.5 and 1.5"),
        ((math.nan,), "lambda must be a finite number"),
        (("x",), "lambda must be a finite number"),
        ((0.8, math.pi / 2), "between 0 and 90 degrees"),
        ((0.8, -0.1), "between 0 and 90 degrees"),
        ((-1, 0.5), "lambda must be positive"),
        ((0.25, math.radians(30)), "no finite length"),
        ((0.8, None, 0), "D must be positive"),
        ((math.nextafter(0.5, 1),), "no finite length"),
        ((0.5 + 1e-7,), "2000-fold in length"),
        ((0.8, math.radians(89.9999999)), "2000-fold in length"),
    ],
)
def test_what_gives_no_rocker(arguments, words):
    with pytest.raises(LinkageError, match=words):
        symmetric_rocker(*arguments)


@pytest.mark.parametrize("kappa", [-0.1, math.pi / 2, math.inf, math.radians(89.9999999)])
def test_angles_without_ratio(kappa):
    with pytest.raises(LinkageError, match="kappa must"):
        lambdas_for(kappa)


@pytest.mark.parametrize(("kappa", "count"), [(44.9, 2), (44.9999999, 1), (45, 1), (45.0000001, 1), (88.7, 1)])
def test_around_45_degrees_the_first_ratio_ends(kappa, count):
    found = lambdas_for(math.radians(kappa))
    assert len(found) == count
    for ratio in found:
        assert symmetric_rocker(ratio).contact().points == 6


def test_contact_with_rockers_of_a_hundred_couplers():
    """Roundings grow with the length of the rockers; the order is still told."""
    assert symmetric_rocker(0.51).contact().points == 6


def test_contact_elsewhere():
    """E17: curvature 0.021088 and 1.233333 at 0 and 180 degrees; zero at 180 for AK = 213.333."""
    conchoid = InvertedSliderCrank(30, 50)
    assert abs(abs(2 * lever_contact(conchoid, 90, 0, 0).coefficient) - 0.021088) < 5e-7
    assert abs(abs(2 * lever_contact(conchoid, 90, 0, math.pi).coefficient) - 1.233333) < 5e-7
    assert lever_contact(conchoid, 640 / 3, 0, math.pi).points == 4
    with pytest.raises(LinkageError, match="dead centre or out of reach"):
        lever_contact(FourBar(40, 70, 25, 70), 45, 40, 0.0)
    with pytest.raises(LinkageError, match="cusp"):
        lever_contact(FourBar(3, 4, 5, 6), *_at_pole(), 1.0)


def _at_pole():
    """The coupler point that is the pole at the crank angle 1, where its path has a cusp."""
    motion = FourBar(3, 4, 5, 6).motion(1.0)
    a, theta = complex(*motion.A.value), float(motion.coupler.value)
    pole = a + 1j * complex(*motion.A.velocity) / float(motion.coupler.velocity)
    arm = (pole - a) * np.exp(-1j * theta)
    return arm.real, arm.imag
