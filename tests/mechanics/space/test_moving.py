"""Motion in space against closed forms, against plane motion, and against the solver that moves link poses."""

from math import cos, pi, sin, tan

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage, exponential
from gruebler.mechanics.space import move
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines
from tests.mechanics.screws.following import follow_joint

TURN = np.linspace(0, 2 * pi, 73)
Z = (0, 0, 1)


def driven(linkage, *drives):
    return linkage.with_drives(drives or [0])


def same_angle(a, b, within=1e-12):
    return abs((np.asarray(a) - b + pi) % (2 * pi) - pi).max() < within


def rssr(a=1.0, second=(3, 1, 2.5), foot=(4, 1, 0), axis=(0, 1, 0.2)):
    places = {0: {"z": Z}, 1: (a, 0, 0), 2: second, 3: {"at": foot, "z": axis}}
    return SpatialLinkage(Mechanism.parse("spatial: R(0-1) S(1-2) S(2-3) R(0-3); drive=R(0-1)"), places)


def rocker_of_rssr(linkage, turns):
    """Turns of the rocker from the reference pose: with the ball of the crank at p the distance of the other ball's
    circle c + u cos ψ + v sin ψ from it is A cos ψ + B sin ψ = C. Both solutions, (turns, 2)."""
    crank, one, two, rocker = (np.array(place.at, float) for place in linkage.places)
    axis = np.array(linkage.places[3].z, float) / np.linalg.norm(linkage.places[3].z)
    assert np.array_equal(crank, np.zeros(3))
    centre = rocker + ((two - rocker) @ axis) * axis
    u = two - centre
    v = np.cross(axis, u)
    found = []
    for t in turns:
        p = np.array([cos(t) * one[0] - sin(t) * one[1], sin(t) * one[0] + cos(t) * one[1], one[2]])
        a, b = 2 * u @ (centre - p), 2 * v @ (centre - p)
        c = (two - one) @ (two - one) - u @ u - (centre - p) @ (centre - p)
        middle, half = np.arctan2(b, a), np.arccos(c / np.hypot(a, b) if abs(c) <= np.hypot(a, b) else np.nan)
        found.append((middle + half, middle - half))
    return np.array(found)


def test_rssr_as_its_closed_form():
    motion = move(rssr(), TURN, order=3)
    assert motion.complete
    both = (rocker_of_rssr(rssr(), TURN) - motion.joint(3)[:, None] + pi) % (2 * pi) - pi
    assert abs(both).min(axis=1).max() < 1e-12
    assert motion.rank == motion.conditions == 1  # a distance, nothing else
    rod = motion.pose("2")
    assert abs(np.linalg.norm(motion.point("S(2-3)") - motion.point("S(1-2)"), axis=1) - np.sqrt(11.25)).max() < 1e-12
    assert abs(rod[:, :3, :3] @ np.swapaxes(rod[:, :3, :3], 1, 2) - np.eye(3)).max() < 1e-14
    assert abs(rod @ np.array([1, 0, 0, 1.0]) - np.append(motion.point("S(1-2)"), np.ones((73, 1)), 1)).max() < 1e-12
    assert abs(rod @ np.array([3, 1, 2.5, 1]) - np.append(motion.point("S(2-3)"), np.ones((73, 1)), 1)).max() < 1e-12


def test_a_rod_that_points_back_has_a_pose_and_rates():
    """A rod between the crank's ball and one in its axis: the length holds in every position, and it turns about z."""
    mechanism = Mechanism.parse("spatial: R(0-1) S(1-2) S(2-0); drive=R(0-1)")
    linkage = SpatialLinkage(mechanism, {0: {"z": Z}, 1: (1, 0, 0), 2: (0, 0, 0)})
    turns = np.array([0, pi / 2, pi - 1e-5, pi, pi + 1e-2, 4.0])
    motion = move(linkage, turns, order=3)
    c, s = np.cos(turns), np.sin(turns)
    wanted = np.moveaxis(np.array([[c, -s, 0 * c], [s, c, 0 * c], [0 * c, 0 * c, 1 + 0 * c]]), 2, 0)
    assert motion.pose("2")[:, :3, :3] == pytest.approx(wanted, abs=1e-12)
    assert motion.angular("2") == pytest.approx(np.tile(np.array(Z, float), (6, 1)), abs=1e-10)
    assert abs(motion.angular("2", order=3)).max() < 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_random_rssr_as_its_closed_form(seed):
    random = np.random.default_rng(seed)
    second, foot, axis = random.normal(size=(3, 3)) + np.array([[3, 0, 0], [3, 0, 0], [0, 0, 0]])
    linkage = rssr(0.4, tuple(second), tuple(foot), tuple(axis))
    motion = move(linkage, TURN)
    both = rocker_of_rssr(linkage, TURN)
    assert motion.complete == np.isfinite(both).all()  # complete, or the closed form ends as well
    apart = (both[: len(motion)] - motion.joint(3)[:, None] + pi) % (2 * pi) - pi
    assert abs(apart).min(axis=1).max() < 1e-10


@pytest.mark.parametrize(
    ("second", "foot", "axis"),
    [
        ((2.0, -2.6, 0.4), (-0.6, -0.5, -0.2), (-2.0, -0.2, -0.9)),
        ((1.8, -3.1, 1.0), (0.1, 1.3, 0.4), (1.8, 0.0, -0.5)),
        ((1.4, 0.1, 0.3), (0.9, 0.4, 1.5), (-1.2, 0.9, 0.1)),
    ],
)
def test_a_step_back_from_a_limit_keeps_the_assembly_mode(second, foot, axis):
    """Next to a limit the power series holds for short steps only; whole turns beyond it other modes lie as near."""
    linkage = rssr(1.0, second, foot, axis)
    low, high = gr.drive_range(linkage).lowest, gr.drive_range(linkage).highest
    path = [0.0, low + 0.001 * (high - low), low + 0.04 * (high - low)]
    motion = move(linkage, path)
    wanted = rocker_of_rssr(linkage, path)
    mode = abs(np.sin(wanted[0] / 2)).argmin()  # the one of the reference pose, in which the rocker's angle is 0
    assert motion.complete
    assert not motion.passed
    assert same_angle(motion.joint(3), wanted[:, mode], 1e-10)
    assert abs(motion.joint(3)).max() < pi


@pytest.mark.parametrize("bend", [0.2, pi / 6, 1.2])
def test_hookes_joint(bend):
    """tan β = tan α / cos δ; its speed ratio lies between cos δ and 1 / cos δ."""
    motion = move(driven(machines.hooke(bend)), TURN, order=2)
    assert same_angle(motion.joint(3), np.arctan2(np.sin(TURN), np.cos(TURN) * cos(bend)))
    slope = cos(bend) / (cos(bend) ** 2 * np.cos(TURN) ** 2 + np.sin(TURN) ** 2)
    assert motion.joint(3, order=1) == pytest.approx(slope, abs=1e-12)
    assert motion.joint(3, order=1).min() == pytest.approx(cos(bend), abs=1e-12)
    assert motion.joint(3, order=1).max() == pytest.approx(1 / cos(bend), abs=1e-12)


def test_two_cross_joints_keep_the_speed():
    motion = move(machines.cardan(0.5, 0.5), TURN, order=3)
    assert motion.complete
    assert same_angle(motion.joint(3), TURN)
    assert motion.joint(3, order=1) == pytest.approx(np.ones(73), abs=1e-12)
    assert abs(motion.joint(3, order=2)).max() < 1e-11
    shaft = np.arctan2(np.sin(TURN), np.cos(TURN) * cos(0.5))
    assert same_angle(abs(motion.angular("shaft") @ (1, 0, 0)), np.gradient(np.unwrap(shaft), TURN), 2e-3)


def test_bennett_keeps_its_rank_over_a_turn():
    """tan(θ1/2) tan(θ2/2) is constant: G. T. Bennett, A new mechanism, Engineering 76 (1903) 777-778."""
    linkage = driven(machines.bennett(alpha=0.7, beta=1.1, turn=1.0)[0])
    motion = move(linkage, TURN, order=3)
    assert motion.complete
    assert motion.gap < 1e-12
    assert motion.rank == 2 < motion.conditions
    assert motion.smallest.min() > 1e-3
    ratio = sin(0.9) / sin(0.2)
    one, other = 1.0 + motion.joint(0), 2 * np.arctan(ratio / tan(0.5)) + motion.joint(1)
    assert np.sin(one / 2) * np.sin(other / 2) == pytest.approx(ratio * np.cos(one / 2) * np.cos(other / 2), abs=1e-11)
    assert abs(motion.poses[0, -1] - motion.poses[0, 0]).max() < 1e-11  # back after a turn


@pytest.mark.parametrize(
    ("make", "drive", "reach", "repeated"),
    [
        (machines.oldham, 0, 2 * pi, 3),
        (lambda: machines.oldham("planar"), 0, 2 * pi, 0),
        (machines.winch, 0, 6.0, 4),
    ],
    ids=["oldham", "oldham in a plane", "winch"],
)
def test_overconstrained_linkages_move_as_link_poses_do(make, drive, reach, repeated):
    """The other solver has the poses of links as unknowns, and closes them all by least squares (`Closing`)."""
    linkage = driven(make(), drive)
    turns = np.linspace(0, reach, 7)[1:]
    motion = move(linkage, turns)
    assert motion.complete
    assert motion.gap < 1e-12
    assert motion.conditions - motion.rank == repeated  # by the count of Grübler and Kutzbach, and F = 1
    poses = follow_joint(linkage, drive, turns)
    poses[..., :3, 3] *= linkage.size
    poses[..., :3, 3] += linkage.centre - poses[..., :3, :3] @ linkage.centre
    assert abs(motion.poses[0] - poses).max() < 1e-9 * linkage.size


def test_rates_against_differences_of_higher_order():
    linkage = driven(machines.bennett()[0])
    h = 1e-3
    middle = move(linkage, [0.9], order=3)
    steps = move(linkage, 0.9 + h * np.arange(-3, 4))
    weights = np.array([[0, 1, -8, 0, 8, -1, 0], [0, -1, 16, -30, 16, -1, 0], [1, -8, 13, 0, -13, 8, -1]])
    below = 12 * h, 12 * h * h, 8 * h**3
    for joint in (1, 3):
        for order in (1, 2, 3):
            difference = weights[order - 1] @ steps.joint(joint) / below[order - 1]
            assert middle.joint(joint, order=order)[0] == pytest.approx(difference, abs=1e-6 / h ** (order - 1) * 1e-2)
    for order in (1, 2):
        difference = weights[order - 1] @ steps.point("R(2-3)") / below[order - 1]
        assert middle.point("R(2-3)", order=order)[0] == pytest.approx(difference, abs=1e-6)
    turn = (steps.pose("2")[4, :3, :3] - steps.pose("2")[2, :3, :3]) / (2 * h) @ steps.pose("2")[3, :3, :3].T
    assert middle.angular("2")[0] == pytest.approx([turn[2, 1], turn[0, 2], turn[1, 0]], abs=1e-5)


@pytest.mark.parametrize("id", ["diff_bevel", "diff_bevel2p"])
def test_a_bevel_differential_by_willis(id):
    """(ω1 - ωc) = -(ω2 - ωc) for equal side gears: their mean is the carrier's speed, for any number of turns."""
    linkage = entry(id).placed().with_drives(["R(frame-sun1)", "R(frame-carrier)"])
    turns = np.outer(np.linspace(0, 1, 41)[1:], [70.0, 20.0])
    motion = move(linkage, turns, order=1, speed=[2.0, 0.5])
    assert motion.joint("R(frame-sun2)") == pytest.approx(2 * turns[:, 1] - turns[:, 0], abs=1e-11)
    assert motion.joint("R(frame-sun2)", order=1) == pytest.approx([-1.0] * 40, abs=1e-12)
    planet = next(name for name in linkage.mechanism.chain.joint_names() if "carrier-planet" in name)
    assert abs(motion.joint(planet)) == pytest.approx(turns[:, 0] - turns[:, 1], abs=1e-11)  # equal wheels


def worm(lead):
    """A worm of radius 1 along x under a wheel of radius 4 about z; its thread leads at this angle at (0, 1, 0)."""
    normal = (cos(lead), 0, -sin(lead))
    contact = {"at": (0, 1, 0), "x": normal, "y": (0, 1, 0), "radii": (sin(lead), 4 * cos(lead)), "pressure": 0.35}
    return {0: {"z": (1, 0, 0)}, 1: {"at": (0, 5, 0), "z": Z}, 2: contact}


@pytest.mark.parametrize(
    ("places", "ratio"),
    [
        ({0: {"z": Z}, 1: {"at": (0, 3, 0), "z": Z}, 2: {"at": (0, 1, 0), "z": Z, "radii": (1, 2)}}, -0.5),
        ({0: {"z": Z}, 1: {"z": (0, 1, 0)}, 2: {"at": (0, 2, 1), "z": (0, 2, 1), "radii": (2, 1)}}, -2.0),
        (worm(0.1), -tan(0.1) / 4),  # a turn shifts the thread by its lead, 2 pi tan 0.1, and the wheel by as much
    ],
    ids=["spur", "bevel", "worm"],
)
def test_wheels_on_axes_anywhere(places, ratio):
    mechanism = Mechanism.parse("spatial: R(0-1) R(0-2) G(1-2); drive=R(0-1)")
    places = {**places, 2: {"pressure": 0.35, "x": (1, 0, 0)} | places[2]}
    linkage = SpatialLinkage(mechanism, places).moved(exponential([0.3, -0.5, 1.0, 2.0, 0.1, -3.0]))
    motion = move(linkage, np.linspace(0, 40.5, 41), order=1)
    assert motion.joint(1) == pytest.approx(ratio * motion.drives[:, 0], abs=1e-11)
    assert motion.joint(1, order=1) == pytest.approx([ratio] * 41, abs=1e-12)
    mobility = gr.freedoms(linkage)  # the other model: slip of the teeth as a function of where the wheels are
    assert (mobility.instant.mobility, mobility.finite.mobility) == (1, 1)
    poses = follow_joint(linkage, 0, np.array([0.2, 0.4]))
    poses[..., :3, 3] *= linkage.size
    poses[..., :3, 3] += linkage.centre - poses[..., :3, :3] @ linkage.centre
    assert abs(move(linkage, [0.2, 0.4]).poses[0] - poses).max() < 1e-10


def test_wheels_drive_a_closed_loop_in_space():
    """A bevel pair whose second wheel is the crank of an RSSR: the loop moves as with the crank itself driven."""
    crank = rssr()
    text = "spatial: R(0-9) G(9-1) R(0-1) S(1-2) S(2-3) R(0-3); drive=R(0-9)"
    contact = {"at": (0, 0.6, -0.2), "x": (1, 0, 0), "z": (0, 3, -1), "radii": (0.2, 0.6), "pressure": 0.35}
    places = [{"z": (0, 1, 0)}, contact, *crank.places]
    motion = move(SpatialLinkage(Mechanism.parse(text), dict(enumerate(places))), 3 * TURN, order=1)
    turned = motion.joint("R(0-1)")
    assert abs(turned) == pytest.approx(TURN, abs=1e-12)
    wanted = move(crank, turned, order=1)
    assert motion.joint("R(0-3)") == pytest.approx(wanted.joint("R(0-3)"), abs=1e-11)
    slope = np.sign(turned[-1]) / 3 * wanted.joint("R(0-3)", order=1)
    assert motion.joint("R(0-3)", order=1) == pytest.approx(slope, abs=1e-11)


def test_radii_of_wheels_in_space_fit_their_axes():
    mechanism = Mechanism.parse("spatial: R(0-1) R(0-2) G(1-2); drive=R(0-1)")
    contact = {"at": (0, 2, 1), "x": (1, 0, 0), "z": (0, 2, 1), "radii": (2, 1.1), "pressure": 0.35}
    linkage = SpatialLinkage(mechanism, {0: {"z": Z}, 1: {"z": (0, 1, 0)}, 2: contact})
    with pytest.raises(LinkageError, match=r"the radii 2 and 1.1 are not in the ratio of 2 and 1"):
        move(linkage, [0.0, 1.0])


def test_a_differential_with_one_drive_says_what_still_moves():
    with pytest.raises(LinkageError, match=r"F = 1 is left, in R\(frame-sun1\), R\(frame-sun2\), R\(carrier-planet\)"):
        move(entry("diff_bevel").placed().with_drives(["R(frame-carrier)"]), [0.0, 1.0])


def test_a_motion_ends_at_its_limit_with_the_joint_that_turns_back():
    linkage = rssr(3.0, (3.0, 1.0, 2.0), (4.0, 1.0, 0.0), (0, 1, 0.2))
    motion = move(linkage, np.linspace(0, 2 * pi, 361))
    assert not motion.complete
    assert motion.stop.reason == "limit"
    assert motion.stop.joints == ("R(0-3)",)
    turns = motion.stop.drives[0] + np.array([-1e-6, 1e-5])
    closed = np.isfinite(rocker_of_rssr(linkage, turns)).all(axis=1)
    assert closed.tolist() == [True, False]  # the closed form has no solution beyond it
    assert "dead" not in motion.message()
    assert "the drive stands at its limit and has to turn back, while R(0-3) could go on" in motion.message()
    assert "Grenz" in motion.message("de")


def test_a_ball_may_be_written_from_either_link():
    """On the way it turns by more than half a radian, where its turns are counted anew."""
    motions = [
        move(machines.tied_body(text)[0], np.linspace(0, 0.75, 16))
        for text in ("R(frame-crank) S(crank-body)", "S(body-crank) R(crank-frame)")
    ]
    assert all(motion.complete for motion in motions)
    assert abs(motions[0].pose("body") - motions[1].pose("body")).max() < 1e-12
    assert np.arccos((np.trace(motions[0].pose("body")[-1, :3, :3]) - 1) / 2) > 0.5


def square(space, crossed=False):
    """A parallelogram with its cranks upright, or crossed: then one pin is mirrored at the line of its neighbours."""
    end = np.array([3.0, 1.0])
    if crossed:
        across = np.array([1.0, 3.0]) / np.sqrt(10)
        end = end - 2 * across * (across @ (end - (3, 0)))
    mechanism = Mechanism.parse(f"{space}R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    points = [(0, 0), (0, 1), tuple(map(float, end)), (3, 0)]
    if not space:
        return SpatialLinkage(mechanism, dict(enumerate(points)))
    return SpatialLinkage(mechanism, {k: {"at": (*point, 0.0), "z": Z} for k, point in enumerate(points)})


@pytest.mark.parametrize("space", ["", "spatial: "], ids=["plane", "space"])
def test_rows_in_which_two_modes_meet_are_passed(space):
    """A parallelogram meets its crossed mode where its cranks lie on one line; it stays one, its rocker as fast."""
    rows = np.radians(np.arange(0, 721, 15))
    motion = move(square(space), rows, speed=2.0, acceleration=3.0, jerk=5.0, order=3)
    assert motion.complete
    assert motion.changes == (6, 18, 30, 42)
    assert motion.passed == ()
    assert motion.gap < 1e-12
    assert motion.joint(3) == pytest.approx(rows, abs=1e-11)
    for order, rate, near in ((1, 2.0, 1e-10), (2, 3.0, 1e-8), (3, 5.0, 1e-6)):
        assert motion.joint(3, order=order) == pytest.approx(rate, abs=near)
    assert motion.smallest[6] < 1e-12 < motion.smallest[5]
    assert "At R(0-1) = 90° two assembly modes meet; it goes straight on" in motion.message()
    assert "Bei D(0-1) = 90° treffen sich zwei Einbaulagen" in motion.message("de")


@pytest.mark.parametrize("space", ["", "spatial: "], ids=["plane", "space"])
def test_a_crossed_parallelogram_passes_its_change_points_by_its_closed_form(space):
    """tan(psi / 2) = -tan(phi / 2) (d + a) / (d - a) for cranks a on a frame d: it is folded at 0 and at pi."""
    linkage = square(space, crossed=True)
    rows = np.radians(np.arange(0, 361, 10))
    motion = move(linkage, rows)
    assert motion.complete
    assert motion.changes == (9, 27)
    phi = pi / 2 + rows
    psi = np.pi + 2 * np.arctan2(np.cos(phi / 2) * (3 - 1), np.sin(phi / 2) * (3 + 1))
    turned = motion.joint(3)
    assert abs(np.exp(1j * (turned - turned[0])) - np.exp(1j * (psi - psi[0]))).max() < 1e-10


def test_a_path_that_turns_in_a_change_point_passes_it_once():
    motion = move(square(""), [0.0, pi / 2, 0.3, pi / 2, pi / 2, 2.0])
    assert motion.changes == (1, 3, 4)
    assert motion.passed == ()
    assert motion.joint(3)[:5] == pytest.approx([0.0, pi / 2, 0.3, pi / 2, pi / 2], abs=1e-11)


def test_a_change_of_mode_is_no_limit():
    """A parallelogram meets its crossed mode where its cranks lie on one line."""
    linkage = square("")
    through = move(linkage, np.linspace(0, 3.0, 8))
    assert through.complete
    assert through.passed == (4,)  # 3 / 7 times 4 is the first one beyond a quarter turn
    assert through.joint(3) == pytest.approx(np.linspace(0, 3.0, 8), abs=1e-11)  # a parallelogram still
    assert "goes straight on" in through.message()


def test_nothing_depends_on_place_unit_or_order():
    linkage = driven(machines.bennett()[0])
    motion = move(linkage, TURN, order=2)
    there = exponential([0.3, -0.5, 1.0, 2.0, 0.1, -3.0])
    for other in (linkage.moved(there), linkage.scaled(1e3), linkage.scaled(1e-3)):
        again = move(other, TURN, order=2)
        assert again.joint(1) == pytest.approx(motion.joint(1), abs=1e-11)
        assert again.joint(3, order=2) == pytest.approx(motion.joint(3, order=2), abs=1e-9)


def test_screws_and_cut_joints():
    """Two screws on one axis: the nut advances by the difference of the leads, whichever joint is cut."""
    text = "spatial: R(0-1) H(1-2) P(0-2); drive=H(1-2)"
    places = {0: {"z": Z}, 1: {"z": Z, "pitch": 2.0}, 2: {"at": (0, 5, 0), "x": Z}}
    motion = move(SpatialLinkage(Mechanism.parse(text), places), np.linspace(0.5, 30.0, 16), order=1)
    assert motion.joint(2) == pytest.approx(np.linspace(1.0, 60.0, 16), abs=1e-10)
    assert motion.joint(0) == pytest.approx(-np.linspace(0.5, 30.0, 16), abs=1e-10)
    text = "spatial: H(0-1) H(1-2) P(0-2); drive=H(0-1)"
    places[0] = {"z": Z, "pitch": 2.5}
    motion = move(SpatialLinkage(Mechanism.parse(text), places), [0.5, 3.0])
    assert motion.joint(2) == pytest.approx([0.25, 1.5], abs=1e-10)
    text = "spatial: H(0-1) H(1-2) H(0-2); drive=H(0-1)"  # one screw must be cut
    places[2] = {"z": Z, "pitch": 1.0}
    motion = move(SpatialLinkage(Mechanism.parse(text), places), [0.5, 2.0])
    # a + b = c in turns, 2.5 a + 2 b = c in ways: b = -1.5 a, c = -0.5 a
    assert motion.joint(2) == pytest.approx([-0.25, -1.0], abs=1e-10)


def test_every_joint_seen_in_the_tree_or_from_poses_has_the_same_value():
    motion = move(machines.cardan(0.5, 0.4), TURN, order=3)
    linkage = motion.linkage
    for number, direction in [(1, "Rx"), (1, "Ry"), (2, "Rx"), (2, "Ry"), (3, "Rz"), (0, "Rz")]:
        seen = motion._seen(number, direction)
        for order in range(4):
            own = motion.joint(number, direction, order)
            assert seen[order] - seen[order][0] == pytest.approx(own - own[0], abs=1e-9), (number, direction, order)
    assert linkage.mechanism.chain.joints[1].pair.is_cross


def test_quaternions_turn_as_the_matrices_do():
    motion = move(driven(machines.bennett()[0]), TURN)
    w, x, y, z = motion.quaternion("2").T
    a, b, c = np.array([0.3, -0.4, 0.8])
    t = 2 * np.array([y * c - z * b, z * a - x * c, x * b - y * a])  # v + w t + q x t
    turned = np.array([a, b, c])[:, None] + w * t + np.cross(np.array([x, y, z]).T, t.T).T
    assert abs(turned.T - motion.pose("2")[:, :3, :3] @ (a, b, c)).max() < 1e-13
    assert np.linalg.norm(np.diff(motion.quaternion("2"), axis=0), axis=1).max() < 0.2


def test_from_denavit_and_hartenberg():
    rows = [(1.0, 0, 2.0, 0.7), (1.2, 0, 1.0, 1.1), (0.3, 0, 2.0, 0.7), (0.2, 0, 1.0, 1.1)]
    with pytest.raises(LinkageError, match="the loop is open by"):
        SpatialLinkage.from_dh(rows)
    made, _ = machines.bennett()
    alpha, beta = 0.7, 1.1
    other = 2 * np.arctan2(sin((beta + alpha) / 2), sin((beta - alpha) / 2) * tan(0.5))
    b = 2.0 * sin(beta) / sin(alpha)
    rows = [(1.0, 0, 2.0, alpha), (other, 0, b, beta), (-1.0, 0, 2.0, alpha), (-other, 0, b, beta)]
    linkage = SpatialLinkage.from_dh(rows)
    assert np.array([p.at for p in linkage.places]) == pytest.approx(np.array([p.at for p in made.places]), abs=1e-14)
    assert move(linkage, [0.5]).joint(1) == pytest.approx(move(driven(made), [0.5]).joint(1), abs=1e-12)


def test_rows_too_far_apart_are_refused():
    with pytest.raises(
        LinkageError, match=r"R\(0-1\): row 1 is 1e\+12 rad from the row before; expected at most 1e\+09"
    ):
        move(rssr(), [0, 1e12])


def test_points_outputs_and_files(tmp_path):
    linkage = SpatialLinkage(rssr().mechanism, rssr().places, points={"K": ("3", 3, 1, 2.5)}, outputs=["3"])
    for name in ("a.toml", "a.json"):
        assert gr.read(gr.write(linkage, tmp_path / name)) == linkage
    assert move(linkage, [0.7]).point("K") == pytest.approx(move(linkage, [0.7]).point("S(2-3)"), abs=1e-12)
    moved = linkage.moved(exponential([0, 0, pi / 2, 1, 0, 0])).points["K"]
    assert moved[0] == "3"
    assert linkage.scaled(2).points["K"] == ("3", (6, 2, 5))
    with pytest.raises(LinkageError, match="there is no point 'L'"):
        move(linkage, [0.7]).point("L")
    with pytest.raises(LinkageError, match="there is no link '9'"):
        SpatialLinkage(rssr().mechanism, rssr().places, points={"K": ("9", 0, 0, 0)})
    with pytest.raises(LinkageError, match="solved up to order 0"):
        move(linkage, [0.7]).velocity("K")


def test_suspensions_move_and_their_rods_keep_their_lengths():
    linkage = entry("susp_spatial").placed().with_drives(["R(body-lower_wishbone)"])
    motion = move(linkage, np.linspace(0, 0.25, 11), order=1)
    assert motion.complete
    assert motion.idle == ("tie_rod",)
    rod = motion.point(("knuckle", 690, -130, 255)) - np.array([380, -120, 260])
    assert np.linalg.norm(rod, axis=1) == pytest.approx(np.linalg.norm([310, -10, -5]), abs=1e-9)
    ball = motion.point(("knuckle", 670, 0, 470)) - np.array([420, 20, 480])
    assert np.linalg.norm(ball, axis=1) == pytest.approx(np.linalg.norm([250, -20, -10]), abs=1e-9)


def test_an_idle_freedom_that_is_no_rod_is_fixed_and_said():
    """A ram between two balls on its axis: besides the whole, its rod spins in the barrel; the cranks are driven."""
    chain = Chain.parse("spatial: R(frame-a) S(a-b) C(b-c) S(c-d) R(d-frame)")
    places = {0: {"z": (0, 0, 1)}, 1: (1, 0, 0), 2: {"at": (1.5, 0.5, 0.5), "z": (1, 1, 1)}, 3: (2, 1, 1)}
    places[4] = {"at": (4, 0, 0), "z": (0, 1, 0)}
    motion = gr.move(SpatialLinkage(Mechanism(chain, "frame", [0, 4]), places), [[0, 0], [0.1, 0.1]])
    assert motion.complete
    assert motion.held
    assert f"a turn or shift is held in {', '.join(motion.held)}" in motion.explain()
    first, second = (motion.pose(link)[1] @ (*ball, 1) for link, ball in (("a", (1, 0, 0)), ("d", (2, 1, 1))))
    own = motion.joint(2, "Tz")[1]
    assert np.linalg.norm(first - second) == pytest.approx(np.sqrt(3) + own, abs=1e-12)


@pytest.mark.parametrize("longer", [-1e-4, -1e-6, 1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("degrees", [3, 40, 90])
def test_a_mode_that_comes_near_is_not_taken_for_its_own(longer, degrees):
    """A parallelogram with a rocker that is a little longer turns over where its cranks lie on the frame, and back; one
    with a shorter rocker cannot pass there. By two circles, of whose intersections it is always that on one side."""
    crank, rod, rocker = 1.0, 2.0, 1.0 + longer

    def angle(turn):
        arm = crank * np.exp(1j * turn) - rod
        return np.angle(arm) - np.arccos((abs(arm) ** 2 + rocker**2 - rod**2) / (2 * abs(arm) * rocker))

    first, second = np.exp(1j), rod + rocker * np.exp(1j * angle(1.0))
    places = [(0, 0, 0), (first.real, first.imag, 0), (second.real, second.imag, 0), (rod, 0, 0)]
    linkage = SpatialLinkage(
        Mechanism.parse("spatial: R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)"),
        {k: {"at": at, "z": Z} for k, at in enumerate(places)},
    )
    turns = np.radians(np.arange(0, 361, degrees))
    motion = move(linkage, turns)
    reached = turns[1.0 + turns < pi] if longer < 0 else turns
    assert len(motion) == len(reached)
    assert motion.complete == (longer > 0)
    assert same_angle(-motion.joint(3), angle(1.0 + reached) - angle(1.0), 1e-9)  # R(3-0): of the frame in the rocker


def test_what_is_left_is_said_of_one_joint_and_of_several():
    """A four-bar with a link that hangs on it: its joint is left, or those of the loop."""
    places = {k: {"z": Z, "at": (k, k % 2, 0)} for k in range(5)}
    hanging = SpatialLinkage(Mechanism.parse("spatial: R(0-1) R(1-2) R(2-3) R(0-3) R(3-4)"), places)
    for drive, left in ((0, r"in R\(3-4\); drive more"), (4, r"in R\(0-1\), R\(1-2\), R\(\d-3\); drive more")):
        with pytest.raises(LinkageError, match="F = 1 is left, " + left):
            move(driven(hanging, drive), [0.0, 0.1])
