"""Laws of the three closed forms: loops close, rates are derivatives, extremes are extreme, mirrors mirror."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.slider_crank import SliderCrank
from gruebler.mechanics.linkages.branch import branch_side

length = st.floats(0.5, 10)
offset = st.one_of(st.just(0.0), st.floats(0.01, 6), st.floats(-6, -0.01))
angle = st.floats(0, 2 * math.pi)
branch = st.sampled_from("+-")
OTHER = {"+": "-", "-": "+"}
four_bars = st.builds(FourBar, length, length, length, length)
slider_cranks = st.builds(SliderCrank, length, length, offset)
inverted = st.builds(InvertedSliderCrank, length, length, offset)
linkages = st.one_of(four_bars, slider_cranks, inverted)
DENSE = np.linspace(0, 2 * np.pi, 2881)


def as_complex(points):
    return points[..., 0] + 1j * points[..., 1]


@given(four_bars, branch)
def test_four_bar_loops_close_on_the_right_side(four_bar, branch):
    motion = four_bar.motion(DENSE, branch=branch)
    a, b = as_complex(motion.A.value), as_complex(motion.B.value)
    ok = motion.assembled
    assert np.allclose(np.abs(a), four_bar.a, rtol=1e-12)
    assert np.allclose(b[ok], (a + four_bar.b * np.exp(1j * motion.coupler.value))[ok], atol=1e-7)
    assert np.allclose(np.abs(b - a)[ok], four_bar.b, atol=1e-7)
    assert np.allclose(b[ok], (four_bar.d + four_bar.c * np.exp(1j * motion.output.value))[ok], atol=1e-12)
    side = np.imag((b - a)[ok] * np.conj(four_bar.d - a)[ok])
    assert (side * branch_side(branch) >= -1e-7).all()
    to_a, to_b0 = (a - b)[ok], (four_bar.d - b)[ok]
    cosine = np.real(to_a * np.conj(to_b0)) / (four_bar.b * four_bar.c)
    assert np.allclose(np.cos(motion.mu[ok]), cosine, atol=1e-6)


@given(slider_cranks, branch)
def test_slider_crank_loops_close_on_the_right_side(slider_crank, branch):
    motion = slider_crank.motion(DENSE, branch=branch)
    a, b = as_complex(motion.A.value), as_complex(motion.B.value)
    ok = motion.assembled
    assert np.allclose(np.abs(b - a)[ok], slider_crank.b, atol=1e-7)
    assert np.allclose(b[ok], motion.output.value[ok] + 1j * slider_crank.e, atol=1e-12)
    assert (branch_side(branch) * np.real(b - a)[ok] >= -1e-12).all()
    assert np.allclose(np.cos(motion.mu[ok]), np.imag(a - b)[ok] / slider_crank.b, atol=1e-9)


@given(inverted, branch)
def test_inverted_slider_crank_guides_pass_b0_at_their_offset(linkage, branch):
    motion = linkage.motion(DENSE, branch=branch)
    a, foot, ok = as_complex(motion.A.value), as_complex(motion.B.value), motion.assembled
    unit = np.exp(1j * motion.coupler.value)
    assert np.allclose((foot - a)[ok], (motion.displacement.value * unit)[ok], atol=1e-9)
    assert np.allclose((linkage.d - foot)[ok] / unit[ok], 1j * linkage.e, atol=1e-9)
    assert (motion.displacement.value[ok] * branch_side(branch) >= 0).all()
    assert np.allclose(np.exp(1j * motion.output.value)[ok], -unit[ok], atol=1e-12)


@given(linkages)
def test_limits_tell_exactly_which_poses_are_assembled(linkage):
    arcs = linkage.limits
    phis = np.linspace(0.0, 2 * np.pi, 362)[1:-1]
    assembled = linkage.motion(phis).assembled
    inside = np.array([any(phi in arc for arc in arcs) for phi in phis])
    ends = np.array([end for arc in arcs if not arc.full for end in arc])
    near = (np.abs(np.angle(np.exp(1j * (phis[:, None] - ends)))) < 1e-6).any(axis=1) if ends.size else False
    assert ((inside == assembled) | near).all()
    assert bool(arcs) == (linkage.type.key != "not_assemblable")
    assert (len(arcs) == 1 and arcs[0].full) == ("a" in linkage.turning)
    for end in ends:
        assert linkage.transmission_angle.smallest.mu < 1e-6
        assert not linkage.motion([end - 1e-4, end + 1e-4]).assembled.all()


# Weights of the central difference of eighth order.
STEPS = np.arange(-4, 5)
WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])


@given(linkages, angle, st.floats(-2, 2), st.floats(-2, 2), st.floats(-2, 2), branch, st.tuples(offset, offset))
def test_rates_are_derivatives(linkage, phi, omega, alpha, jerk, branch, point):
    rates = linkage.motion(phi, omega=omega, alpha=alpha, jerk=jerk, branch=branch).coupler[1:]
    assume(np.isfinite(rates).all())
    speed = max(2.0, *(abs(rate) ** (1 / k) for k, rate in enumerate(rates, 1)))
    h = 4e-3 / speed
    t = h * STEPS
    motion = linkage.motion(
        phi + omega * t + alpha * t**2 / 2 + jerk * t**3 / 6,
        omega=omega + alpha * t + jerk * t**2 / 2,
        alpha=alpha + jerk * t,
        jerk=jerk,
        branch=branch,
    )
    assume(motion.complete)
    assume(motion.transmission_angle.min() > 0.25)
    if isinstance(linkage, InvertedSliderCrank):
        assume(np.abs(motion.displacement.value).min() > 0.2)
    tracks = [motion.coupler, motion.output, motion.A, motion.B, motion.point(*point)]
    if isinstance(linkage, InvertedSliderCrank):
        tracks.append(motion.displacement)
    turning = {id(motion.coupler), id(motion.output)}
    for track in tracks:
        for order in range(3):
            values, rates = track[order], track[order + 1]
            if order == 0 and id(track) in turning:
                values = np.unwrap(values)
            difference = np.tensordot(WEIGHTS, values, axes=1) / h
            scale = speed ** (order + 1) * (1 + sum(getattr(linkage, name) for name in linkage.__slots__[:2]))
            assert np.allclose(difference, rates[4], rtol=1e-7, atol=1e-7 * scale)


@given(four_bars, branch)
def test_the_mirror_image_is_the_other_branch(four_bar, branch):
    motion, image = (
        four_bar.motion(DENSE, branch=branch),
        four_bar.motion(-DENSE, omega=-1, branch=OTHER[branch]),
    )
    flip = np.array([1, -1])
    for track, other in ((motion.A, image.A), (motion.B, image.B)):
        for order in range(4):
            assert np.allclose(track[order], other[order] * flip, equal_nan=True, rtol=1e-9)
    assert np.allclose(motion.output.jerk, -image.output.jerk, equal_nan=True, rtol=1e-9)


@given(slider_cranks, branch)
def test_slider_crank_mirrored_in_both_axes(slider_crank, branch):
    motion = slider_crank.motion(DENSE, branch=branch)
    upside = SliderCrank(slider_crank.a, slider_crank.b, -slider_crank.e).motion(-DENSE, omega=-1, branch=branch)
    assert np.allclose(motion.output.value, upside.output.value, equal_nan=True)
    backwards = slider_crank.motion(np.pi - DENSE, omega=-1, branch=OTHER[branch])
    near = np.abs(motion.transmission_angle) < 1e-3
    for order in range(4):
        gap = np.where(near, 0, motion.output[order] + backwards.output[order])
        scale = np.nan_to_num(np.abs(motion.output[order]))
        assert (np.nan_to_num(np.abs(gap)) <= 1e-6 * (1 + scale)).all()


@given(linkages, st.floats(0.1, 10), st.floats(0.2, 5), branch)
def test_scaling_of_lengths_and_of_time(linkage, unit, speed, branch):
    phi = np.linspace(0.05, 6.2, 97)
    sizes = {name: getattr(linkage, name) for name in linkage.__slots__}
    larger = type(linkage)(**{name: unit * size for name, size in sizes.items()})
    motion, other = (
        linkage.motion(phi, branch=branch),
        larger.motion(phi, omega=speed, branch=branch),
    )
    clear = np.nan_to_num(motion.transmission_angle) > 0.1
    factor = unit if isinstance(linkage, SliderCrank) else 1
    for order in range(4):
        expected, found = motion.output[order] * speed**order * factor, other.output[order]
        if order == 0 and not isinstance(linkage, SliderCrank):
            expected, found = np.exp(1j * expected), np.exp(1j * found)
        assert np.allclose(found[clear], expected[clear], rtol=1e-6, atol=1e-7 * (1 + unit))
    assert larger.type == linkage.type


def refined(values, pick):
    """The extreme of a smooth function sampled on DENSE, and where, by a parabola through three samples."""
    k = int(pick(values[1:-1])) + 1
    y0, y1, y2 = values[k - 1 : k + 2]
    curvature = y0 - 2 * y1 + y2
    shift = 0.0 if curvature == 0 else (y0 - y2) / (2 * curvature)
    return y1 - (y0 - y2) ** 2 / (8 * curvature) if curvature else y1, DENSE[k] + shift * (DENSE[1] - DENSE[0])


@settings(max_examples=150)
@given(linkages)
def test_dead_centres_are_the_extremes_of_the_output(linkage):
    centres = linkage.dead_centres
    assume(centres is not None)
    assume(linkage.transmission_angle.smallest.mu > 0.1)
    if isinstance(
        linkage, InvertedSliderCrank
    ):  # with a near d the extremes are too sharp for the parabola of `refined`
        assume(abs(linkage.a - linkage.d) > 0.02 * linkage.d)
    start = (centres.inner.drive + centres.phi_forward / 2) % (2 * np.pi)
    output = linkage.motion(DENSE + start).output.value
    if not isinstance(linkage, SliderCrank):
        output = np.unwrap(output)
    outer_first = isinstance(linkage, SliderCrank)
    for centre, pick in (
        (centres.outer, np.argmax if outer_first else np.argmin),
        (centres.inner, np.argmin if outer_first else np.argmax),
    ):
        best, where = refined(output, pick)
        assert best == pytest.approx(centre.output, abs=1e-6 * (1 + abs(centre.output)))
        assert abs(np.angle(np.exp(1j * (where + start - centre.drive)))) < 2e-3
        at = linkage.motion(centre.drive)
        assert float(at.output.value) == pytest.approx(centre.output, abs=1e-9)
        assert abs(at.output.velocity) < 1e-9
        collinear = np.exp(1j * (at.coupler.value - at.crank.value))
        assert abs(collinear.real if isinstance(linkage, InvertedSliderCrank) else collinear.imag) < 1e-9
    assert np.ptp(output) == pytest.approx(centres.travel, rel=1e-4)
    assert centres.phi_forward + centres.phi_back == pytest.approx(2 * np.pi)
    assert centres.time_ratio >= 1
    times = centres.times(60)
    assert times.period == pytest.approx(1)
    assert times == centres.times(-60)[::-1]


@given(linkages)
def test_transmission_angles_are_extreme(linkage):
    assume(linkage.limits)
    extremes = linkage.transmission_angle
    motion = linkage.motion(DENSE)
    folded = motion.transmission_angle[motion.assembled]
    assume(folded.size > 20)
    assert extremes.smallest.mu <= folded.min() + 1e-6
    assert extremes.largest.mu >= folded.max() - 1e-6
    assert 0 <= extremes.smallest.mu <= extremes.largest.mu <= math.pi / 2
    assert extremes.smallest.mu + extremes.smallest.deviation == pytest.approx(math.pi / 2)
    assert extremes.good == (math.degrees(extremes.smallest.mu) >= 40)
    for extreme in extremes.extremes:
        at = linkage.motion(extreme.drive)
        if at.assembled and not isinstance(linkage, InvertedSliderCrank):
            assert float(at.mu) == pytest.approx(extreme.angle, abs=1e-5)
    if linkage.limits[0].full:
        assert folded.min() == pytest.approx(extremes.smallest.mu, abs=0.02)


@given(slider_cranks, angle)
def test_the_way_leads_back_to_the_crank_angle(slider_crank, phi):
    motion = slider_crank.motion(phi)
    assume(motion.complete)
    assume(motion.transmission_angle > 0.1)
    assume(math.hypot(motion.output.value, slider_crank.e) > 0.1)
    found = np.array(slider_crank.phi_at(motion.output.value))
    gaps = np.abs(np.angle(np.exp(1j * (found - phi))))
    assert gaps.min() < 1e-5
    for back in found:
        ways = [float(slider_crank.motion(back, branch=b).output.value) for b in "+-"]
        assert min(abs(way - float(motion.output.value)) for way in ways) < 1e-4


@given(four_bars)
def test_output_limits_are_the_crank_limits_of_the_reversed_four_bar(four_bar):
    both = [four_bar.motion(DENSE, branch=b) for b in "+-"]
    reached = np.concatenate([m.output.value[m.assembled] for m in both])
    assert all(
        any(
            np.isclose(np.angle(np.exp(1j * (psi - end))), 0, atol=1e-6)
            for arc in four_bar.output_limits
            for end in arc
        )
        or any(psi in arc for arc in four_bar.output_limits)
        for psi in reached[::97]
    )
    assert four_bar.reversed().reversed() == four_bar


def test_poses_that_cannot_be_assembled_are_nan_and_said():
    motion = FourBar(4, 5, 6, 4.5).motion(np.radians([0, 10, 90, 350]))
    assert motion.assembled.tolist() == [False, False, True, False]
    assert np.isnan(motion.B.value[0]).all()
    assert np.isfinite(motion.A.value).all()
    assert motion.message.startswith("3 of 4 poses cannot be assembled: the crank angle must lie in 11.7159..348.284")
    assert FourBar(1, 1, 1, 5).motion(0).message == ("1 of 1 poses cannot be assembled: the linkage is not assemblable")
    (arc,) = FourBar(4, 5, 6, 4.5).limits
    stuck = FourBar(4, 5, 6, 4.5).motion(arc.start)
    assert stuck.assembled
    assert np.isnan(stuck.output.velocity)
    assert "does not determine the rates" in stuck.message
    rhombus = FourBar(2, 2, 2, 2).motion([0, 1, 2 * np.pi])
    assert rhombus.assembled.tolist() == [False, True, False]
    assert rhombus.message == "in 2 of 3 poses A lies on B0 and the position is not determined"
    assert not stuck.complete


def test_a_parallelogram_moves_its_coupler_in_translation():
    motion = FourBar(2, 5, 2, 5).motion(np.linspace(0.1, 3, 50))
    assert np.allclose(motion.coupler.value, 0, atol=1e-12)
    assert np.allclose(motion.output.velocity, 1)
    assert np.allclose(motion.ratio, 1)


def test_scott_russell_draws_a_line_and_shapes_are_kept():
    phi = np.linspace(0.1, 1.4, 12).reshape(3, 4)
    path = SliderCrank(2, 2).motion(phi).point(-2)
    assert path.value.shape == (3, 4, 2)
    assert np.allclose(path.value[..., 0], 0)
    assert np.allclose(path.value[..., 1], 4 * np.sin(phi))
    motion = InvertedSliderCrank(3, 3).motion(phi)
    assert np.allclose(motion.coupler.velocity, 0.5)


@pytest.mark.parametrize("linkage", [FourBar(2, 5, 4, 5), SliderCrank(2, 5), InvertedSliderCrank(2, 5)])
def test_wrong_calls_of_motion(linkage):
    with pytest.raises(LinkageError, match=r"expected \+ or -, but found 0"):
        linkage.motion(0, branch=0)
    for wrong in (math.nan, [0, math.inf], "east", None, 1j):
        with pytest.raises(LinkageError, match="phi must be finite numbers"):
            linkage.motion(wrong)
    with pytest.raises(LinkageError, match="omega must be finite numbers"):
        linkage.motion(0, omega="fast")
    with pytest.raises(LinkageError, match=r"fit each other in shape, not phi \(2,\), omega \(3,\)"):
        linkage.motion([0, 1], omega=[1, 2, 3])
    with pytest.raises(LinkageError, match="omega must be below 1e50"):
        linkage.motion(0, omega=1e200)
    assert linkage.motion([[], []]).output.jerk.shape == (2, 0)
    with pytest.raises(LinkageError, match="rpm must not be 0"):
        linkage.dead_centres.times(0)
    with pytest.raises(LinkageError, match="u must be a finite number"):
        linkage.motion(0).point(math.nan)
