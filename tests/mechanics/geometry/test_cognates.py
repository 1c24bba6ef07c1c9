"""Cognates of the four-bar and the slider-crank."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.geometry import cognate_sizes, cognates, parallel_motion, slider_cognates
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.linkages.branch import branch_of_side

from .sextic_oracle import coupler_sextic

LENGTHS = st.floats(1, 6)
PLACES = st.floats(-6, 6)
SIDES = st.sampled_from([1, -1])

# Isosceles crank-rocker 1, 5 sqrt(3)/2, 5 sqrt(3)/2, 4 with k = 25/3 at 15.793 degrees.
LENKER = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4)
K = (8.018753738744802, 2.268046058132576)


@st.composite
def four_bars(draw):
    """A four-bar, a coupler point off its joints, crank angles where it is well assembled, a branch."""
    bar = FourBar(*(draw(LENGTHS) for _ in range(4)))
    u, v = draw(PLACES), draw(PLACES)
    assume(bar.limits and min(math.hypot(u, v), math.hypot(u - bar.b, v)) > 0.3)
    start, end = bar.limits[0]
    phi = start + (end - start) * np.linspace(0.1, 0.9, 33)
    side = draw(SIDES)
    assume(bar.motion(phi, branch=branch_of_side(side)).transmission_angle.min() > 0.05)
    return bar, u, v, phi, side


@given(four_bars())
def test_three_cognates_trace_one_curve(drawn):
    """Each moves by its own closed form, its crank turning like the link of the given four-bar that it follows."""
    bar, u, v, phi, side = drawn
    motion = bar.motion(phi, branch=branch_of_side(side))
    first, second, third = cognates(bar, u, v, branch=branch_of_side(side), phi=phi[16])
    curve = first.trace(motion)
    turned = motion.coupler.value - motion.coupler.value[16]
    for other, change in ((second, turned), (third, turned), (third.reversed(), phi - phi[16])):
        branches = [other.trace(other.size.motion(other.phi + change, branch=branch)) for branch in "+-"]
        gaps = np.abs(np.array(branches) - curve)
        assert gaps.min(axis=0).max() < 1e-6
        assert gaps[0 if other.branch == "+" else 1, 16] < 1e-6
        assert abs(other.point - curve[16]) < 1e-11
    reverse = third.reversed()
    driven = reverse.trace(reverse.size.motion(reverse.phi + phi - phi[16], branch=reverse.branch))
    assert np.abs(driven - curve).max() < 1e-6  # driven there, it stays on one branch


def lengths(size):
    return [size.a, size.b, size.c, size.d]


@given(four_bars())
def test_cognates_of_cognates_are_the_three(drawn):
    """The second's second and the third's third are the given one; the other ones are the remaining of the three."""
    bar, u, v, phi, side = drawn
    first, second, third = cognates(bar, u, v, branch=branch_of_side(side), phi=phi[16])
    again = cognates(second.size, second.u, second.v, branch=second.branch, phi=second.phi)
    back, other = again[1], again[2].reversed()
    assert np.allclose(lengths(back.size), lengths(first.size))
    assert np.allclose([back.u, back.v], [first.u, first.v])
    assert np.allclose(sorted(lengths(other.size)), sorted(lengths(third.size)))


@given(four_bars())
def test_one_sextic(drawn):
    """The equations of the three curves are one equation, each in the coordinates of its own frame line."""
    bar, u, v, phi, side = drawn
    given_, second, third = cognates(bar, u, v, branch=branch_of_side(side), phi=phi[16])
    points = np.array([0.3 + 0.2j, -1.0 + 2.0j, 4.0 - 1.5j, 2.0 + 5.0j])
    values = coupler_sextic(bar, u, v).value(points)
    for other in (second, third):
        same = coupler_sextic(other.size, other.u, other.v).value((points - other.pivot) / other.turn)
        assert np.allclose(same, values, rtol=1e-6, atol=1e-9 * np.abs(values).max() + 1e-6)
    assert given_.pivot == 0


def test_isosceles_crank_rocker():
    """Third pivot at 40/9 sqrt 3; a symmetric double rocker; and a crank-rocker with the same lengths, crank at C0."""
    first, star, second = cognates(LENKER, *K)
    assert abs(abs(star.pins[3]) - 40 / 9 * math.sqrt(3)) < 1e-12
    assert abs(star.pins[3] - (7.407407407 + 2.095131204j)) < 1e-9
    lengths = [star.size.a, star.size.b, star.size.c, star.size.d]
    assert np.allclose(
        lengths, [8.333333333333334, 1.9245008972987525, 8.333333333333334, 7.69800358919501], rtol=1e-14
    )
    assert star.size.type.key == "grashof_double_rocker"
    assert abs(math.hypot(star.u, star.v) - 1) < 1e-12
    assert abs(abs(complex(star.u, star.v) - star.size.b) - 1) < 1e-12
    crank = second.reversed()
    assert np.allclose(
        [crank.size.a, crank.size.b, crank.size.c, crank.size.d], [1, 4.330127018922193, 4.330127018922193, 4]
    )
    assert abs(math.hypot(crank.u, crank.v) - 8.333333333333334) < 1e-12
    assert abs(abs(complex(crank.u, crank.v) - crank.size.b) - 4.330127018922193) < 1e-12
    assert abs(crank.pivot - star.pins[3]) < 1e-12
    assert first.size == LENKER


@pytest.mark.parametrize("side", [1, -1])
def test_linkages_that_move(side):
    """Moved by the general solver from their homes, all three stay on the curve."""
    bar = FourBar(25, 70, 40, 70)
    sextic = coupler_sextic(bar, 45, 40)
    for one in cognates(bar, 45, 40, branch=branch_of_side(side), phi=1.0):
        linkage = one.linkage()
        at_home = np.angle(one.pins[1] - one.pivot)
        motion = move(linkage, at_home + np.linspace(0, 0.3, 20), order=1)
        assert motion.complete
        assert abs(motion.complex_point("K")[0] - one.point) < 1e-10
        distance = sextic.value(motion.complex_point("K")) / np.abs(sextic.gradient(motion.complex_point("K")))
        assert np.abs(distance).max() < 1e-9
        for link, like in zip(("crank", "coupler", "rocker"), one.turns_with, strict=True):
            given_ = bar.motion(1.0, branch=branch_of_side(side))
            speeds = dict(
                zip(("crank", "coupler", "rocker"), (given_.crank, given_.coupler, given_.output), strict=True)
            )
            ratio = motion.angular(link)[0] / motion.angular("crank")[0]
            assert math.isclose(ratio, speeds[like].velocity / speeds[one.turns_with[0]].velocity, rel_tol=1e-9)


@given(LENGTHS, LENGTHS, st.floats(-3, 3), PLACES, PLACES, SIDES)
def test_slider_cognates(a, b, e, u, v, side):
    slider = SliderCrank(a, b, e)
    assume(slider.limits and min(math.hypot(u, v), math.hypot(u - b, v)) > 0.3)
    start, end = slider.limits[0]
    phi = start + (end - start) * np.linspace(0.1, 0.9, 17)
    motion = slider.motion(phi, branch=branch_of_side(side))
    assume(motion.transmission_angle.min() > 0.05)
    first, second = slider_cognates(slider, u, v, branch=branch_of_side(side), phi=phi[8])
    curve = first.trace(motion)
    turned = motion.coupler.value - motion.coupler.value[8]
    branches = [second.trace(second.size.motion(second.phi + turned, branch=branch)) for branch in "+-"]
    assert np.abs(np.array(branches) - curve).min(axis=0).max() < 1e-6
    assert abs(branches[0 if second.branch == "+" else 1][8] - curve[8]) < 1e-6


@pytest.mark.parametrize("v", [5e-324, -5e-324, 2.2e-309, 1e-300])
def test_a_point_hardly_off_the_coupler(v):
    """Numbers so small that they underflow in a product or quotient."""
    for one, flat in zip(
        cognates(FourBar(2, 2, 1, 4), -1, v, phi=0.3), cognates(FourBar(2, 2, 1, 4), -1, 0, phi=0.3), strict=True
    ):
        assert math.isclose(math.cos(one.phi), math.cos(flat.phi), abs_tol=1e-12)
        assert one.linkage().mechanism.chain.n == 4
    for one in slider_cognates(SliderCrank(2, 3), -1, v):
        assert math.isfinite(one.phi)


def test_slider_cognate_moves():
    _, second = slider_cognates(SliderCrank(25, 70, 10), 35, 40, phi=1.0)
    motion = move(second.linkage(), np.angle(second.pins[1]))
    assert abs(motion.complex_point("K")[0] - second.point) < 1e-12
    with pytest.raises(LinkageError, match="no second crank"):
        second.reversed()


@pytest.mark.parametrize("bar", [FourBar(25, 70, 40, 70), FourBar(60, 70, 65, 20), LENKER])
def test_parallel_motion(bar):
    """A full turn of the crank: the platform does not turn, its point K draws the coupler curve."""
    u, v = (45, 40) if bar is not LENKER else K
    linkage = parallel_motion(bar, u, v)
    assert linkage.mechanism.chain.n == 6
    motion = move(linkage, from_degrees(180, 540, 5))
    assert motion.complete, motion.message()
    assert np.ptp(motion.angle("platform")) < 1e-8
    expected = bar.motion(from_degrees(180, 540, 5)).point(u, v).value
    assert np.allclose(motion.point("K"), expected, rtol=0, atol=1e-8 * bar.d)


def test_many_at_once():
    """Arrays give what single four-bars give."""
    rng = np.random.default_rng(1)
    a, b, c, d, u, v = rng.uniform(1, 5, (6, 50))
    found = cognate_sizes(a, b, c, d, u, v)
    assert found.a.shape == (3, 50)
    for k in range(50):
        bar = FourBar(a[k], b[k], c[k], d[k])
        if not bar.limits:
            continue
        for n, one in enumerate(cognates(bar, u[k], v[k])):
            lengths = [x[n, k] for x in (found.a, found.b, found.c, found.d)]
            assert np.allclose([one.size.a, one.size.b, one.size.c, one.size.d], lengths)
            end = found.pivot[n, k] + found.turn[n, k] * found.d[n, k]
            assert abs(end - one.pins[3]) < 1e-12


def test_a_point_on_a_joint_has_no_size():
    found = cognate_sizes(2.0, 5.0, 4.0, 5.0, [0.0, 5.0], 0.0)
    assert found.a.tolist() == [[2, 2], [0, 5], [5, 0]]
    assert np.isfinite(found.turn).all()


def test_wrong_calls():
    bar = FourBar(25, 70, 40, 70)
    for u, joint in ((0, "A"), (70, "B")):
        with pytest.raises(LinkageError, match=f"on the joint {joint}: it traces an arc"):
            cognates(bar, u, 0)
    with pytest.raises(LinkageError, match="u must be a finite number, not nan"):
        cognates(bar, math.nan, 0)
    with pytest.raises(LinkageError, match="cannot be assembled in any position"):
        cognates(FourBar(1, 1, 1, 9), 1, 1)
    with pytest.raises(LinkageError, match="crank angle 180 degrees"):
        cognates(FourBar(60, 30, 30, 70), 1, 1, phi=math.pi)
    with pytest.raises(LinkageError, match=r"expected \+ or -"):
        cognates(bar, 1, 1, branch="2")
    with pytest.raises(LinkageError, match="c must be positive, not -1"):
        cognate_sizes(1, 1, [-1, 2], 1, 1, 1)
    with pytest.raises(LinkageError, match="one shape"):
        cognate_sizes([1, 2], 1, [1, 2, 3], 1, 1, 1)
    with pytest.raises(LinkageError, match="a must be finite numbers"):
        cognate_sizes("x", 1, 1, 1, 1, 1)


@pytest.mark.parametrize(
    ("bar", "branch", "still"),
    [
        (FourBar(2, 5, 2, 5), 1, "coupler only translates"),
        (FourBar(2, 2, 5, 5), -1, "rocker stands still"),
    ],
)
def test_linkages_of_which_a_link_does_not_turn(bar, branch, still):
    """The parallelogram, and kites with coincident joints: a cognate could not be driven. The other modes have them."""
    with pytest.raises(LinkageError, match=f"the {still}"):
        cognates(bar, 2, 1, branch=branch_of_side(branch))
    first, second, _ = cognates(bar, 2, 1, branch=branch_of_side(-branch))
    around = bar.motion(first.phi + np.linspace(-0.2, 0.2, 5), branch=branch_of_side(-branch))
    turn = around.coupler.value - around.coupler.value[2]
    other = second.size.motion(second.phi + turn, branch=second.branch)
    assert abs(second.trace(other) - first.trace(around)).max() < 1e-9
    assert np.ptp(turn) > 0.05


def test_the_slider_that_stands_still():
    with pytest.raises(LinkageError, match="the slider stands still"):
        slider_cognates(SliderCrank(2, 2), 2, 1)  # beyond the change point at 90 degrees
    assert slider_cognates(SliderCrank(2, 2), 2, 1, branch="-")[1].size == SliderCrank(5**0.5, 5**0.5)
