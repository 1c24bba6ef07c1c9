"""Closed forms in space against the general solver, against places of the joints, against the plane and print."""

from math import acos, cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.space import (
    RSSR,
    Bennett,
    DoubleUniversalJoint,
    SphericalFourBar,
    SwashPlate,
    UniversalJoint,
    measures,
    move,
)

TURN = np.linspace(0, 2 * pi, 721)
ARC = st.floats(0.15, 2.9)
BRANCH = st.sampled_from("+-")


def spherical_places(four_bar, phi, psi):
    """A0, A, B, B0 as unit vectors (…, 3)."""
    one = np.ones_like(phi)
    b0 = np.array([sin(four_bar.d), 0, cos(four_bar.d)])
    along, across = np.array([cos(four_bar.d), 0, -sin(four_bar.d)]), np.array([0.0, 1, 0])
    a = np.stack([sin(four_bar.a) * np.cos(phi), sin(four_bar.a) * np.sin(phi), cos(four_bar.a) * one], -1)
    turned = np.cos(psi)[..., None] * along + np.sin(psi)[..., None] * across
    b = cos(four_bar.c) * b0 + sin(four_bar.c) * turned
    return np.array([0, 0, 1.0]), a, b, b0


@given(ARC, ARC, ARC, ARC, BRANCH)
def test_the_arcs_of_a_spherical_four_bar_are_kept_and_the_branch_is_its_own(a, b, c, d, branch):
    four_bar = SphericalFourBar(a, b, c, d)
    motion = four_bar.motion(TURN, branch=branch)
    inside = np.array([any(phi in arc for arc in four_bar.limits) for phi in TURN])
    determined = (abs(a - d) > 1e-9) | (np.cos(TURN) < 0.9)  # else A lies on B0
    assert (motion.assembled == inside)[determined].all()
    phi, psi = TURN[motion.assembled], motion.output.value[motion.assembled]
    _, at, bt, b0 = spherical_places(four_bar, phi, psi)
    assert np.einsum("ij,ij->i", at, bt) == pytest.approx(cos(b), abs=1e-12)
    left = np.einsum("ij,ij->i", np.cross(at, bt), np.broadcast_to(b0, bt.shape))
    assert (left * (-1 if branch == "+" else 1) > -1e-7).all()


@settings(max_examples=25)
@given(ARC, ARC, ARC, ARC, BRANCH, st.floats(-3, 3))
def test_a_spherical_four_bar_moves_as_the_general_solver_moves_it(a, b, c, d, branch, start):
    four_bar = SphericalFourBar(a, b, c, d)
    motion = four_bar.motion([start, start + 0.02], omega=2.0, alpha=-0.7, jerk=0.4, branch=branch)
    assume(motion.complete and motion.transmission_angle.min() > 0.15)
    same = move(four_bar.linkage(start, branch=branch), [0, 0.02], speed=2.0, acceleration=-0.7, jerk=0.4, order=3)
    assert same.complete
    for order in range(4):
        wanted = np.unwrap(motion.output[0]) - motion.output[0][0] if order == 0 else motion.output[order]
        scale = max(1.0, abs(wanted).max())
        assert same.joint("R(frame-rocker)", order=order) == pytest.approx(wanted, abs=1e-8 * scale)


@given(ARC, ARC, ARC, ARC)
def test_joints_turn_fully_where_the_other_two_arcs_bridge_every_distance(a, b, c, d):
    """By sampling: the ends of two arcs that turn about a common one are everywhere as near as the others can be."""
    four_bar = SphericalFourBar(a, b, c, d)
    pairs = {"A0": (a, d, b, c), "A": (a, b, c, d), "B": (b, c, a, d), "B0": (c, d, a, b)}
    for joint, (x, y, u, v) in pairs.items():
        assume(abs(four_bar.joint_excess[joint]) > 1e-3)
        across = np.arccos(np.clip(cos(x) * cos(y) + sin(x) * sin(y) * np.cos(TURN), -1, 1))
        reach = np.arccos(np.clip(cos(u) * cos(v) + sin(u) * sin(v) * np.cos(TURN), -1, 1))
        inside = reach.min() - 1e-7 <= across.min() and across.max() <= reach.max() + 1e-7
        assert (four_bar.joint_excess[joint] <= 0) == inside, joint


def test_supplements_of_two_arcs_that_meet_are_the_same_linkage():
    """Each axis has two ends; B's other end makes b and c their supplements."""
    four_bar = SphericalFourBar(0.5, 1.4, 1.0, 1.2)
    other = SphericalFourBar(0.5, pi - 1.4, pi - 1.0, 1.2)
    assert four_bar.type is other.type
    turned = four_bar.motion(TURN).output.value - other.motion(TURN, branch="-").output.value
    assert np.cos(turned) == pytest.approx(-1, abs=1e-12)


@given(st.tuples(*[st.floats(10, 100)] * 4), BRANCH)
def test_on_a_small_cap_it_is_the_four_bar_in_the_plane(lengths, branch):
    plane, small = FourBar(*lengths), SphericalFourBar(*(1e-5 * x for x in lengths))
    assume(abs(plane.grashof.excess) > 0.5)
    assert small.type is plane.type
    flat, motion = plane.motion(TURN[::40], branch=branch), small.motion(TURN[::40], branch=branch)
    good = flat.transmission_angle > 0.05
    apart = motion.output.value[good] - flat.output.value[good]
    assert abs(np.exp(1j * apart) - 1).max(initial=0) < 1e-4
    assert motion.output.jerk[good] == pytest.approx(flat.output.jerk[good], rel=1e-3, abs=1e-3)
    if plane.dead_centres:
        assert small.swing == pytest.approx(plane.swing, abs=1e-5)
        assert small.dead_centres.delta_phi == pytest.approx(plane.dead_centres.delta_phi, abs=1e-5)
    if plane.limits:
        ours, theirs = small.transmission_angle, plane.transmission_angle
        assert ours.smallest.mu == pytest.approx(theirs.smallest.mu, abs=1e-5)


@given(st.floats(0.15, 1.0), ARC, ARC, ARC)
def test_dead_centres_and_transmission_angle_are_the_extremes_of_a_dense_motion(a, b, c, d):
    four_bar = SphericalFourBar(a, b, c, d)
    assume(four_bar.type.key == "crank_rocker" and min(map(abs, four_bar.joint_excess.values())) > 0.02)
    motion = four_bar.motion(np.linspace(0, 2 * pi, 20_001))
    psi, centres = np.unwrap(motion.output.value), four_bar.dead_centres
    assert four_bar.swing == pytest.approx(np.ptp(psi), abs=1e-5)
    for centre in (centres.inner, centres.outer):
        there = four_bar.motion(centre.drive).output
        assert np.cos(there.value - centre.output) == pytest.approx(1, abs=1e-12)
        assert there.velocity == pytest.approx(0, abs=1e-6)
    found = four_bar.transmission_angle
    assert found.smallest.mu == pytest.approx(motion.transmission_angle.min(), abs=1e-6)
    assert found.largest.mu == pytest.approx(motion.transmission_angle.max(), abs=1e-3)


def test_the_transmission_angle_is_that_between_the_great_circles_at_b():
    four_bar = SphericalFourBar(*np.radians([30, 80, 60, 70]))
    motion = four_bar.motion(TURN)
    _, a, b, b0 = spherical_places(four_bar, TURN, motion.output.value)
    coupler, rocker = np.cross(b, a), np.cross(b, b0)
    cosine = np.einsum("ij,ij->i", coupler, rocker) / np.linalg.norm(coupler, axis=1) / np.linalg.norm(rocker, axis=1)
    assert motion.transmission_angle == pytest.approx(np.arccos(abs(cosine)), abs=1e-7)


# --- universal joints ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [0, 0.3, radians(30), 1.4])
def test_a_universal_joint(angle):
    """tan psi = tan phi / cos angle and its derivative, with phi from the fork in the plane of the shafts."""
    joint = UniversalJoint(angle)
    motion = joint.motion(TURN, omega=2)
    assert np.sin(motion.output.value) * np.cos(TURN) * cos(angle) == pytest.approx(
        np.cos(motion.output.value) * np.sin(TURN), abs=1e-14
    )
    assert abs(motion.output.value - TURN).max() <= joint.phase_error + 1e-14
    assert joint.motion(joint.phase_error_at).output.value - joint.phase_error_at == pytest.approx(joint.phase_error)
    speed = 2 * cos(angle) / (cos(angle) ** 2 * np.cos(TURN) ** 2 + np.sin(TURN) ** 2)
    assert motion.output.velocity == pytest.approx(speed, rel=1e-14)
    assert (motion.output.velocity.min() / 2, motion.output.velocity.max() / 2) == pytest.approx(
        joint.speed_ratios, rel=1e-14
    )
    assert joint.irregularity == pytest.approx(1 / cos(angle) - cos(angle))
    assert joint.phase_error == pytest.approx(np.arctan((1 - cos(angle)) / (2 * sqrt(cos(angle)))))


def test_a_universal_joint_is_the_four_bar_of_right_angles():
    joint = UniversalJoint(0.6)
    assert joint.four_bar.type.key == "double_crank"
    motion, same = (each.motion(TURN, omega=3, alpha=1, jerk=2) for each in (joint, joint.four_bar))
    assert np.cos(motion.output.value - pi / 2 - same.output.value) == pytest.approx(1, abs=1e-14)
    for order in (1, 2, 3):
        assert motion.output[order] == pytest.approx(same.output[order], abs=1e-12)


@given(st.floats(0, 1.4), st.floats(0, 1.4), st.floats(-3, 3))
def test_two_universal_joints(first, second, phase):
    one, two = UniversalJoint(first), UniversalJoint(second)
    equal = DoubleUniversalJoint(one, one).motion(TURN, omega=2, alpha=3, jerk=4)
    assert equal.output.value == pytest.approx(TURN, abs=1e-13)
    assert (equal.output.velocity, equal.output.acceleration) == (pytest.approx(2.0), pytest.approx(3.0))
    motion = DoubleUniversalJoint(one, two, phase).motion(TURN)
    middle = one.motion(TURN)
    turned = two.motion(middle.output.value + pi / 2 + phase)
    assert motion.output.velocity == pytest.approx(middle.output.velocity * turned.output.velocity, rel=1e-12)


# --- the swash plate ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("radius", "tilt", "start"), [(40, radians(18), 0.4), (25, 1.1, -2.0), (3, 0.01, pi / 2)])
def test_a_swash_plate_moves_as_the_general_solver_moves_it(radius, tilt, start):
    plate = SwashPlate(radius, tilt)
    motion = plate.motion(start + TURN, omega=2.0, alpha=-0.7, jerk=0.4)
    same = move(plate.linkage(start), TURN, speed=2.0, acceleration=-0.7, jerk=0.4, order=3)
    assert same.complete
    for order in range(4):
        shift = motion.output.value[0] if order == 0 else 0.0
        assert same.joint("P(frame-piston)", order=order) == pytest.approx(
            motion.output[order] - shift, abs=1e-11 * plate.stroke
        )
    measured = measures(plate.linkage(start))
    assert measured.travel == pytest.approx(plate.stroke, rel=1e-12)
    centres = sorted(((centre.drive + start) % (2 * pi), centre.kind) for centre in measured.dead_centres)
    assert [kind for _, kind in centres if kind == "minimum"] == ["minimum"]
    for at, kind in centres:
        (own,) = [centre for centre in plate.dead_centres if centre.kind == kind]
        assert cos(at - own.drive) == pytest.approx(1, abs=1e-12)
    normal = plate.linkage(start).places[1].y
    assert np.arccos(normal[2] / np.linalg.norm(normal)) == pytest.approx(pi / 2 - motion.transmission_angle[0])


def test_a_swash_plate_says_what_it_does():
    plate = SwashPlate(radius=50, tilt=pi / 4)
    assert (plate.stroke, plate.amplitude) == pytest.approx((100, 50))
    assert str(plate.explain()) == "stroke: 100\nsmallest transmission angle: 45°"
    assert plate.explain("de") == "Hub: 100\nkleinster Übertragungswinkel: 45°"
    assert SwashPlate(50, 0).dead_centres == ()


# --- the RSSR ---------------------------------------------------------------------------------------------------------

LENGTH = st.floats(20, 150)
RSSRS = st.builds(
    RSSR,
    a=st.floats(10, 60),
    b=LENGTH,
    c=LENGTH,
    d=st.floats(0, 120),
    twist=st.floats(-1.5, 1.5),
    crank_offset=st.floats(-50, 50),
    rocker_offset=st.floats(-50, 50),
)


def balls(linkage, phi, psi):
    """The centres of both balls, (…, 3)."""
    up, out = cos(linkage.twist), sin(linkage.twist)
    a = np.stack([linkage.a * np.cos(phi), linkage.a * np.sin(phi), np.full(np.shape(phi), linkage.crank_offset)], -1)
    axis, across = np.array([0, -out, up]), np.array([0, up, out])
    centre = np.array([linkage.d, 0, 0]) + linkage.rocker_offset * axis
    arm = np.cos(psi)[..., None] * np.array([1.0, 0, 0]) + np.sin(psi)[..., None] * across
    return a, centre + linkage.c * arm


@given(RSSRS, BRANCH)
def test_the_rod_of_an_rssr_keeps_its_length_where_it_can(linkage, branch):
    assume(abs(linkage.b - linkage.c) > 1e-6)  # else A may lie on the rocker's centre, and psi is not determined
    turn, arcs = TURN[::6], linkage.limits
    motion = linkage.motion(turn, branch=branch)
    ends = np.array([end for arc in arcs if not arc.full for end in arc])
    sure = (abs(np.exp(1j * turn)[:, None] - np.exp(1j * ends)) > 1e-6).all(axis=1)
    inside = np.array([any(phi in arc for arc in arcs) for phi in turn])
    assert (motion.assembled == inside)[sure].all()
    a, b = balls(linkage, turn[motion.assembled], motion.output.value[motion.assembled])
    assert np.linalg.norm(b - a, axis=1) == pytest.approx(linkage.b, rel=1e-12)


@settings(max_examples=20)
@given(RSSRS, BRANCH, st.floats(-3, 3))
def test_an_rssr_moves_as_the_general_solver_moves_it(linkage, branch, start):
    motion = linkage.motion([start, start + 0.02], omega=2.0, alpha=-0.7, jerk=0.4, branch=branch)
    assume(motion.complete and motion.transmission_angle.min() > 0.2)
    same = move(linkage.linkage(start, branch=branch), [0, 0.02], speed=2.0, acceleration=-0.7, jerk=0.4, order=3)
    for order in range(4):
        wanted = np.unwrap(motion.output[0]) - motion.output[0][0] if order == 0 else motion.output[order]
        scale = max(1.0, abs(wanted).max())
        assert same.joint("R(frame-rocker)", order=order) == pytest.approx(wanted, abs=1e-8 * scale)


@given(RSSRS, BRANCH)
def test_an_rssr_seen_from_its_rocker(linkage, branch):
    motion = linkage.motion(TURN[::30], branch=branch)
    phi, psi = motion.crank.value[motion.assembled], motion.output.value[motion.assembled]
    a, b = balls(linkage.reversed(), pi - psi, pi - phi)
    assert np.linalg.norm(b - a, axis=-1) == pytest.approx(linkage.b, rel=1e-12)


@given(RSSRS.filter(lambda linkage: linkage.type.key == "crank_rocker"), BRANCH)
def test_dead_centres_of_an_rssr_are_the_extremes_of_a_dense_motion(linkage, branch):
    motion = linkage.motion(np.linspace(0, 2 * pi, 20_001), branch=branch)
    assume(motion.transmission_angle.min() > 0.1)
    assert linkage.swing(branch) == pytest.approx(np.ptp(np.unwrap(motion.output.value)), abs=1e-5)
    for centre in linkage.dead_centres(branch):
        there = linkage.motion(centre.drive, branch=branch).output
        assert np.cos(there.value - centre.output) == pytest.approx(1, abs=1e-11)
        assert there.velocity == pytest.approx(0, abs=1e-6)


@given(st.tuples(*[st.floats(10, 100)] * 4), BRANCH)
def test_an_rssr_on_parallel_axes_is_the_four_bar(lengths, branch):
    a, b, c, d = lengths
    plane, linkage = FourBar(*lengths), RSSR(a=a, b=b, c=c, d=d)
    assume(abs(plane.grashof.excess) > 0.1)
    assert linkage.type.key in (plane.type.key, "triple_rocker" if plane.type.key == "grashof_double_rocker" else "")
    flat, motion = plane.motion(TURN[::40], branch=branch), linkage.motion(TURN[::40], branch=branch)
    good = flat.transmission_angle > 0.05
    assert abs(np.exp(1j * (motion.output.value - flat.output.value)[good]) - 1).max(initial=0) < 1e-12
    assert motion.output.jerk[good] == pytest.approx(flat.output.jerk[good], rel=1e-9, abs=1e-9)
    assert motion.transmission_angle[good] == pytest.approx(flat.transmission_angle[good], abs=1e-7)


# --- Bennett's linkage ------------------------------------------------------------------------------------------------


@settings(max_examples=10)
@given(st.floats(0.2, 2.9), st.floats(0.2, 2.9))
def test_bennett_moves_over_a_turn(alpha, beta):
    """That it closes is checked by `from_dh`; the solver, which knows nothing of it, follows the same angles."""
    assume(abs(alpha - beta) > 0.2)
    linkage = Bennett(2.0, alpha, beta)
    motion = move(linkage.linkage(1.0), np.linspace(0, 2 * pi, 25), speed=1.0)
    assert motion.complete
    # each joint turns a link against the one before
    first = 1.0 + motion.joint(0)
    second = linkage.second_angle(1.0) + motion.joint(1)
    assert np.cos(second - linkage.second_angle(first)) == pytest.approx(1, abs=1e-12)
    assert motion.joint(1, order=1) == pytest.approx(linkage.speed_ratio(first), rel=1e-9)
    assert np.tan(first / 2) * np.tan(second / 2) == pytest.approx(linkage.product, rel=1e-7)


# --- what is refused --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SphericalFourBar(1, 1, 1, 4), "d must lie between 0 and pi, not 4"),
        (lambda: SphericalFourBar(1, -1, 1, 1), "b must be positive"),
        (lambda: SphericalFourBar(0.2, 0.2, 0.2, 2).linkage(0.0), "cannot be assembled at phi = 0 degrees"),
        (lambda: SphericalFourBar(0.2, 0.2, 0.2, 2).transmission_angle, "not assemblable"),
        (lambda: UniversalJoint(pi / 2), "below pi/2"),
        (lambda: SwashPlate(10, pi / 2), "the tilt must be at least 0 and below pi/2"),
        (lambda: SwashPlate(0, 0.3), "radius must be positive"),
        (lambda: DoubleUniversalJoint(UniversalJoint(0.1), 0.1), "second must be a UniversalJoint"),
        (lambda: RSSR(a=1, b=1, c=0, d=1), "c must be positive"),
        (lambda: RSSR(a=1, b=1, c=1, d=-1), "d must not be negative"),
        (lambda: RSSR(a=1, b=1, c=1, d=9).linkage(0), "cannot be assembled"),
        (lambda: Bennett(1, 0.5, 0.5), "alpha and beta must differ"),
        (lambda: Bennett(1, 0.5, 4), "beta must lie between 0 and pi"),
    ],
)
def test_what_is_no_linkage_is_refused(make, words):
    with pytest.raises(LinkageError, match=words):
        make()


def test_types_by_hand():
    """An octant closes everywhere; a rhombus of equal arcs is a change point; too long a frame closes nowhere."""
    assert SphericalFourBar(*[pi / 2] * 3, 0.5).type.key == "double_crank"
    assert SphericalFourBar(1, 1, 1, 1).type.key == "change_point"
    assert SphericalFourBar(0.2, 0.2, 0.2, 2).type.key == "not_assemblable"
    assert SphericalFourBar(0.5, 0.4, 0.3, 1.2).type.key == "single_position"
    assert str(RSSR(a=30, b=140, c=80, d=100).type) == str(FourBar(30, 140, 80, 100).type)
    assert UniversalJoint(acos(0.8)).speed_ratios == pytest.approx((0.8, 1.25))
    assert tan(UniversalJoint(0.7).phase_error_at) ** 2 == pytest.approx(cos(0.7))


def test_a_dead_centre_of_an_rssr_may_lie_at_the_start():
    """The rocker's plane holds the crank's axis: dead centres at 0 and half a turn; by rounding beyond the arcs."""
    size = RSSR(
        a=27.109852694106195,
        b=123.22329955787785,
        c=79.02023159299641,
        d=24.956176900171034,
        twist=np.pi / 2,
        crank_offset=104.74179584111512,
    )
    drives = [centre.drive for centre in size.dead_centres()]
    assert np.cos(drives) == pytest.approx([1, -1], abs=1e-9) or np.cos(drives) == pytest.approx([-1, 1], abs=1e-9)
    psi = size.motion([0.0, np.pi]).output.value
    assert size.swing() == pytest.approx(abs(psi[1] - psi[0]))


@pytest.mark.parametrize(
    "lengths", [RSSR(a=1, b=4, c=2.5, d=3, twist=1.2), SphericalFourBar(0.5, 1.2, 1.0, 1.4), SwashPlate(30, 0.3)]
)
def test_lengths_stand_for_the_linkage_whose_drive_is_their_angle(lengths):
    motion = move(lengths, TURN[:30], speed=1.0)
    value = lengths.motion(TURN[:30]).output.value
    output = len(motion.linkage.places) - 1
    assert motion.joint(output) == pytest.approx(value - value[0], abs=1e-9)
