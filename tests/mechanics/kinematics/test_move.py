"""Poses and rates of any linkage against closed forms, against differences, and against what must hold."""

from math import atan2, pi

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import AssemblyWarning, LinkageError
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.strategies import parallelograms

lengths = st.floats(0.2, 5).map(lambda x: round(x, 3))
branches = st.sampled_from("+-")


def worst(found, wanted):
    return np.max(np.abs(found - wanted)) / max(1, np.max(np.abs(wanted)))


# --- closed forms as judges ------------------------------------------------------------------------


def judged(linkage, closed, output, branch, tolerance):
    """Every pose and rate of the general solver against the closed forms, where they are well conditioned."""
    phi = from_degrees(0, 360, 5)
    motion = move(linkage, phi, speed=3.0, acceleration=-2.0, jerk=5.0, branch=branch, order=3)
    rows = len(motion)
    judge = closed.motion(phi[:rows], omega=3.0, alpha=-2.0, jerk=5.0, branch=branch)
    assume(rows and np.abs(motion.roots).min() > 1e-3)  # closed forms keep their side behind a change point
    sound = np.abs(motion.roots[:, 0]) > 0.05
    assume(sound.any())
    for order, name in enumerate(("value", "velocity", "acceleration", "jerk")):
        found, wanted = output(motion, order)[sound], getattr(judge.output, name)[sound]
        if order == 0:
            found, wanted = np.exp(1j * found), np.exp(1j * wanted)
        assert worst(found, wanted) < tolerance
    assert motion.closure_error < 1e-12


@settings(max_examples=40)
@given(lengths, lengths, lengths, lengths, branches)
def test_four_bars(a, b, c, d, branch):
    four_bar = FourBar(a, b, c, d)
    judged(four_bar.linkage(), four_bar, lambda m, k: m.angular("rocker", order=k), branch, 1e-8)


@settings(max_examples=40)
@given(lengths, lengths, st.floats(-1, 1).map(lambda x: round(x, 3)), branches)
def test_slider_cranks(a, b, e, branch):
    crank = SliderCrank(a, b, e)
    judged(crank.linkage(), crank, lambda m, k: m.displacement("P(frame-slider)", order=k), branch, 1e-8)


@settings(max_examples=40)
@given(lengths, lengths, st.floats(-1, 1).map(lambda x: round(x, 3)), branches)
def test_inverted_slider_cranks(a, d, e, branch):
    inverted = InvertedSliderCrank(a, d, e)
    # the closed form looks from B0 to A, the block's line from A to B0
    judged(inverted.linkage(), inverted, lambda m, k: m.angular("block", order=k) + (pi if k == 0 else 0), branch, 1e-8)


# --- every dyad and larger groups ------------------------------------------------------------------

DRAWN = {
    "RRR": ("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)", [(0, 0), (1, 1), (5, 3), (6, 0)]),
    "RRP": ("R(0-1) R(1-2) R(2-3) P(0-3); drive=R(0-1)", [(0, 0), (1, 1), (5, 0.5), (4, 0.4, 0.1)]),
    "RPR": ("R(0-1) R(1-2) P(2-3) R(0-3); drive=R(0-1)", [(0, 0), (1, 1), (3, 1.5, 0.3), (6, 2)]),
    "PRP": ("R(0-1) P(1-2) R(2-3) P(0-3); drive=R(0-1)", [(0, 0), (2, 1, 0.5), (4, 2), (4, 2.2, 1.4)]),
    "RPP": ("R(0-1) R(1-2) P(2-3) P(0-3); drive=R(0-1)", [(0, 0), (1, 1), (3, 1.5, 1.3), (6, 2, 0.2)]),
    "slot": ("R(0-1) R(1-2) G(0-2); drive=R(0-1)", [(0, 0), (1, 0.5), (4, 1, 0.1, "0")]),
    "double slide": ("R(0-1) R(1-2) double_slide(0-2); drive=R(0-1)", [(0, 0), (1, 1), (2, 2, 0.4)]),
    "two dyads": (
        "R(0-1) R(1-2) R(2-3) R(0-3) R(2-4) R(4-5) P(0-5); drive=R(0-1)",
        [(0, 0), (1, 1), (5, 3), (6, 0), (3, 4), (8, 5), (8, 5, -0.2)],
    ),
    "multiple joint": (
        "R(0-1) R(1-2-3) R(2-4) P(0-4) R(3-5) P(0-5); drive=R(0-1)",
        [(0, 0), (1, 0.5), (4, 4), (4, 4, pi / 4), (-4, 4), (-4, 4, 3 * pi / 4)],
    ),
    "3-RR": (
        "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); drive=R(0-1)",
        [(0, 0), (0.3, 0.2), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5)],
    ),
    "2-RR+RP": (
        "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) P(4-h); drive=R(0-1)",
        [(0, 0), (0.3, 0.2), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5, 1.0)],
    ),
    "cylinder": ("R(0-1) R(0-4) R(4-2) P(1-2); drive=P(1-2)", [(0, 0), (4, 0), (3, 2), (0, 0, atan2(2, 3))]),
    "class IV": (
        "R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(2-5) R(0-4); drive=R(0-1)",
        [(0, 0), (0.1, 0.05), (1, 2), (3, 3.5), (4, 1.5), (2, 0.8), (6, 3)],
    ),
}


def drawn(name):
    text, places = DRAWN[name]
    mechanism = Mechanism.parse(text)
    return Linkage.from_drawing(mechanism, dict(zip(mechanism.chain.joint_names(), places, strict=True)))


def around_home(linkage, rows, step):
    """A path through the home position."""
    from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
    from gruebler.mechanics.kinematics.solve import cached_plan

    home = pose_at_reference(cached_plan(linkage), np.zeros(len(linkage.mechanism.drives))).drives
    return home + step * np.arange(rows)[:, None]


@pytest.mark.parametrize("name", DRAWN)
def test_home_is_on_the_motion_and_everything_stays_closed(name):
    linkage = drawn(name)
    motion = move(linkage, around_home(linkage, 200, 0.002))
    assert motion.complete, motion.message()
    assert motion.closure_error < 1e-12
    for link, home in linkage.reference_pose.items():
        k = motion.link_index(link)
        assert abs(motion.places[0, 0, k] - complex(home.x, home.y)) < 1e-12 * linkage.size
        assert abs(motion.turns[0, k] - np.exp(1j * home.angle)) < 1e-12


WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])


@pytest.mark.parametrize("name", DRAWN)
def test_rates_are_derivatives(name):
    """Central differences of eighth order, the drive moving at a speed that is not constant."""
    linkage = drawn(name)
    start = around_home(linkage, 1, 0.0)[0]
    time = 1e-2 * np.arange(-8, 9)[:, None]
    path = start + 0.7 * time - 0.2 * time**2 + 0.3 * time**3
    motion = move(
        linkage,
        path,
        speed=0.7 - 0.4 * time + 0.9 * time**2,
        acceleration=-0.4 + 1.8 * time,
        jerk=np.full_like(time, 1.8),
        order=3,
    )
    middle = slice(4, -4)
    for k in range(3):
        for quantities, rates in (
            (motion.places[k], motion.places[k + 1]),
            (motion.rates[k - 1] if k else np.unwrap(np.angle(motion.turns), axis=0), motion.rates[k]),
        ):
            different = sum(w * quantities[n : len(quantities) - 8 + n] for n, w in enumerate(WEIGHTS)) / (
                time[1, 0] - time[0, 0]
            )
            assert worst(different, rates[middle]) < 1e-7


def test_a_parallelogram_stays_one_over_ten_turns():
    for phi in (
        from_degrees(0, 3600, 1),
        from_degrees(0.5, 3600, 15),
        from_degrees(0, 3600, 90),
        from_degrees(-3600, 0, 7),
    ):
        motion = move(FourBar(1, 2, 1, 2).linkage(), phi, speed=1.0, order=3)
        assert motion.complete
        assert worst(motion.angle("rocker"), motion.angle("crank")) < 1e-7
        assert np.abs(motion.angular("coupler")).max() < 1e-9
        assert np.abs(motion.angular("rocker") - 1).max() < 1e-9
        assert np.abs(motion.angular("rocker", order=2)).max() < 1e-7
        assert motion.closure_error < 1e-12


@pytest.mark.parametrize(
    "path",
    [
        (90, 180, 90),
        (90, 180, 180, 90),
        (90, 180, 180, 270),
        (90, 179.999999, 90),
        (5, 0, 15),
        (90, 180, 90, 180, 270, 300),
    ],
)
def test_a_path_that_turns_back_in_a_change_point_is_retraced(path):
    motion = move(FourBar(20, 50, 20, 50).linkage(), np.radians(path), order=2)
    assert motion.complete
    assert worst(motion.angle("rocker"), np.radians(path)) < 1e-7
    assert np.abs(motion.angular("rocker") - 1).max() < 1e-9


def test_rates_at_rest_in_a_change_point():
    motion = move(FourBar(20, 50, 20, 50).linkage(), from_degrees(0, 90, 10), speed=0, acceleration=2.0)
    assert np.abs(motion.angular("rocker")).max() == 0
    assert np.abs(motion.angular("rocker", order=2) - 2).max() < 1e-9


def test_a_rest_has_the_rates_that_are_given_for_it_on_a_way_into_a_change_point_and_back():
    """In a parallelogram the rocker does what the crank does."""
    path, speed = [3.0, 3.1, 3.1, pi, pi, 3.0], np.array([1.0, 2.0, 0.0, 5.0, -1.0, -3.0])
    bend = np.array([0.0, 1.0, 2.0, 3.0, 0.0, -4.0])
    motion = move(FourBar(20, 50, 20, 50).linkage(), path, speed=speed, acceleration=bend)
    assert motion.complete
    assert motion.angular("rocker") == pytest.approx(speed, abs=1e-9)
    assert motion.angular("rocker", order=2) == pytest.approx(bend, abs=1e-9)


def test_a_row_at_a_limit_says_that_rates_are_not_finite():
    four_bar = FourBar(50, 70, 40, 70)
    motion = move(four_bar.linkage(), [1.0, four_bar.limits[0].end], order=2)
    assert motion.unbounded == (1,)
    assert "no finite rates" in motion.message()
    assert "Grenzlage" in motion.message("de")


def test_an_antiparallelogram_stays_one():
    motion = move(FourBar(1, 2, 1, 2).linkage(), from_degrees(10, 730, 1), branch="-", order=1)
    assert motion.complete
    turned = motion.angle("rocker")
    assert turned[-1] - turned[0] == pytest.approx(-4 * pi)


def test_a_near_parallelogram_is_no_parallelogram():
    """One part in a thousand off, the crank passes 180 degrees near a change point and keeps its mode."""
    motion = move(FourBar(1, 2.001, 1.0005, 2).linkage(), from_degrees(90, 270, 1))
    assert motion.complete
    assert (motion.roots > 0).all()


def test_the_end_of_a_range_is_found_exactly():
    four_bar = FourBar(50, 70, 40, 70)
    motion = move(four_bar.linkage(), from_degrees(60, 360, 1))
    assert not motion.complete
    assert motion.stop.reason == "limit"
    assert motion.stop.drives[0] == pytest.approx(np.arccos((50**2 + 70**2 - 110**2) / (2 * 50 * 70)), abs=1e-12)
    assert motion.stop.links == ("coupler", "rocker")
    assert len(motion) == 73
    assert "132.2°" in motion.message()
    assert "nicht mehr zusammenbauen" in motion.message("de")


@pytest.mark.parametrize("lengths", [(40, 70, 25, 70), (40, 25, 40, 60), (1, 1, 1, 2), (2, 0.2, 0.2, 2), (2, 2, 2, 5)])
@pytest.mark.parametrize("branch", "+-")
def test_paths_that_pass_a_limit_end_there(lengths, branch):
    """Once an endless loop: the limit was found again and again from ever nearer."""
    four_bar = FourBar(*lengths)
    paths = (from_degrees(0, 360, 5), from_degrees(40, 400, 1), np.linspace(0, 2 * pi, 7))
    stops = [move(four_bar.linkage(), path, branch=branch).stop for path in paths]
    inside = [stop for stop in stops if stop is not None and stop.reason != "start"]
    edges = np.exp(1j * np.ravel(four_bar.limits))
    assert inside or stops == [None] * 3
    for stop in inside:
        assert np.abs(np.exp(1j * stop.drives[0]) - edges).min() < 1e-9


def test_a_class_three_group_over_a_full_turn():
    """Three legs that do not meet in a point, a crank that is short against them."""
    mechanism = Mechanism.parse(DRAWN["3-RR"][0])
    linkage = Linkage.from_drawing(
        mechanism, dict(enumerate([(0, 0), (0.2, 0.132), (1, 3), (5, 0), (3.5, 3), (-2, 4), (2, 4.5)]))
    )
    motion = move(linkage, from_degrees(0, 360, 1) + linkage.reference_pose["1"].angle, order=2)
    assert motion.complete, motion.message()
    assert motion.closure_error < 1e-12
    assert np.abs(motion.places[:, -1] - motion.places[:, 0]).max() < 1e-9
    assert np.abs(np.diff(motion.angle("h"))).max() < 0.05


def test_a_class_three_group_ends_inside_without_a_jump():
    linkage = Linkage.from_drawing(
        Mechanism.parse(DRAWN["3-RR"][0]),
        dict(enumerate([(0, 0), (0.5, 0.3), *DRAWN["3-RR"][1][2:]])),
    )
    motion = move(linkage, from_degrees(30, 200, 1), order=0)
    assert motion.stop.form == "3-RR"
    assert motion.stop.drives[0] == pytest.approx(np.radians(97.5252475), abs=1e-8)
    fine = move(linkage, from_degrees(97, 97.6, 0.001))
    assert fine.stop.drives[0] == pytest.approx(motion.stop.drives[0], abs=1e-9)
    assert np.abs(np.diff(motion.angle("h"))).max() < 0.1


def test_two_drives_draw_a_straight_line():
    five = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); drive=R(0-1); drive=R(0-4)")
    linkage = Linkage.from_drawing(
        five, {0: (0, 0), 1: (-1, 2), 2: (1.5, 4), 3: (4, 2), 4: (3, 0)}, points={"K": ("2", 1.5, 4)}
    )
    time = np.linspace(0, 1, 101)
    home = [linkage.reference_pose["1"].angle, linkage.reference_pose["4"].angle]
    path = np.array(home) + np.outer(time, [0.3, -0.2])
    motion = move(linkage, path, speed=[0.3, -0.2], order=2)
    assert motion.complete
    velocity = motion.point("K", order=1)
    moved = np.trapezoid(velocity, time, axis=0)
    assert moved == pytest.approx(motion.point("K")[-1] - motion.point("K")[0], rel=1e-4)


def test_a_cylinder_pushes_at_its_own_speed():
    linkage = drawn("cylinder")
    motion = move(linkage, np.linspace(3.2, 5, 50), speed=2.0, order=3)
    assert worst(motion.displacement("P(1-2)"), motion.drives[:, 0]) < 1e-13
    assert worst(motion.displacement("P(1-2)", order=1), 2.0) < 1e-12
    assert np.abs(motion.displacement("P(1-2)", order=2)).max() < 1e-11


@pytest.mark.parametrize("path", [np.linspace(50, -200, 100), np.linspace(50, -200, 1001), [50.0, -50.0]])
def test_a_cylinder_does_not_pass_a_narrow_gap(path):
    """The pivots are 60 apart, the lever is 59.97 long: below a way of 0.03 there is no triangle."""
    mechanism = Mechanism.parse("R(0-1) P(1-2) R(2-3) R(0-3); drive=P(1-2)")
    linkage = Linkage(
        mechanism,
        {
            "0": {0: (0, 0), 3: (60, 0)},
            "1": {0: (0, 0), 1: (0, 0, 0)},
            "2": {1: (0, 0, 0), 2: (0, 0)},
            "3": {2: (59.97, 0), 3: (0, 0)},
        },
    )
    motion = move(linkage, path, speed=-1.0)
    assert motion.stop.drives[0] == pytest.approx(0.03, abs=1e-10)
    assert motion.stop.reason == "limit"
    assert motion.closure_error < 1e-12


# --- wrong calls and honest failures ---------------------------------------------------------------


def test_a_start_that_cannot_be_assembled_is_said():
    with pytest.warns(AssemblyWarning, match="At the start.* cannot be assembled in this way"):
        motion = move(FourBar(1, 1, 1, 10).linkage(), 0.0)
    assert (len(motion), motion.stop.reason) == (0, "start")
    assert "cannot be assembled" in motion.message()


@pytest.mark.parametrize(
    ("arguments", "named", "said"),
    [
        (([[0, 1]],), {}, "has 1 drive, but found rows of 2"),
        (([0, float("nan")],), {}, "row 1"),
        (("crank",), {}, "expected numbers"),
        (([],), {}, "no rows"),
        (([0, 1],), {"order": 4}, "order is 0, 1, 2 or 3"),
        (([0, 1],), {"speed": float("inf")}, "speed: expected finite"),
        (([0, 1],), {"branch": "++"}, "a branch of this linkage is"),
        (([0, 1],), {"branch": "2"}, "expected \\+ or -"),
    ],
)
def test_wrong_calls_say_what_is_expected(arguments, named, said):
    with pytest.raises(LinkageError, match=said):
        move(FourBar(1, 2, 2, 2).linkage(), *arguments, **named)


@pytest.mark.parametrize(("drives", "said"), [("", "free"), ("; drive=R(0-1); drive=R(0-3)", "more")])
def test_drives_that_do_not_fix_the_motion(drives, said):
    quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)" + drives)
    linkage = Linkage.from_drawing(quad, {0: (0, 0), 1: (0, 1), 2: (3, 2), 3: (3, 0)})
    with pytest.raises(LinkageError, match="cannot be moved by its drives"):
        move(linkage, np.zeros((1, len(quad.drives))))


def test_unknown_names_are_answered_with_the_nearest():
    motion = move(FourBar(1, 2, 2, 2).linkage({"K": (1, 1)}), [0.5], order=1)
    with pytest.raises(LinkageError, match="did you mean 'rocker'"):
        motion.angle("roker")
    with pytest.raises(LinkageError, match="known are K, R"):
        motion.point("L")
    with pytest.raises(LinkageError, match="solved up to order 1"):
        motion.point("K", order=2)
    with pytest.raises(LinkageError, match="not a sliding joint"):
        motion.displacement("R(frame-crank)")


@pytest.mark.parametrize("scale", [1, 3, 10, 2.54, 1e-6, 1e6])
def test_a_slide_through_two_pins_that_meet_goes_straight_on(scale: float) -> None:
    """At 90 degrees all arms of the scissor lift are in line and the two pins of its platform coincide."""
    lift = entry("scissor2").linkage().scaled(scale)
    for drives in ([80, 89, 89.9999, 90, 90.0001, 91, 100], np.arange(5.38, 175), [200, 250, 280], [100, 90, 80]):
        motion = move(lift, np.radians(drives), speed=1.0)
        assert motion.complete
        assert motion.closure_error < 1e-9
        assert np.abs(np.sin(motion.angle("platform"))).max() < 1e-7
        assert np.ptp(motion.angle("platform")) < 1e-7


@pytest.mark.parametrize("scale", [1, 2.54, 1e-6, 1e6])
@pytest.mark.parametrize("order", [0, 1])
def test_arms_of_a_scissor_lift_where_they_are_in_line(scale: float, order: int) -> None:
    """There a dyad lies on itself, and any direction closes: it has the one that it comes through, from both sides.

    arm1 and arm3 stand at the drive's angle, arm2 and arm4 at its supplement, also if the motion starts or ends there.
    """
    lift = entry("scissor2").linkage().scaled(scale)
    step = ([60, 90, 120], np.arange(60, 121), np.arange(60, 121, 0.5), [30, 90, 150], [89.99, 90, 90.00001])
    turn = ([80, 90, 80], [80, 90, 90, 100], [89.9999999, 90.0000001])
    end = ([90], [90, 91], [90, 120], [90, 60], [60, 90], [120, 90])
    for drives in (*step, *turn, *end):
        motion = move(lift, np.radians(drives), order=order)
        assert motion.complete
        drive = np.radians(drives)
        for arm, expected in {"arm1": drive, "arm2": pi - drive, "arm3": drive, "arm4": pi - drive}.items():
            np.testing.assert_allclose(motion.angle(arm), expected, rtol=0, atol=1e-9)
        assert motion.closure_error < 1e-9


@pytest.mark.parametrize("scale", [1, 3, 1e-6])
def test_the_change_points_of_a_scissor_lift_in_any_unit(scale: float) -> None:
    found = measures(entry("scissor2").linkage().scaled(scale))
    assert (found.travel, found.output_turns, found.transfer.still) == (0, 0, True)
    at = sorted((round(float(np.degrees(one.drive)), 6), one.form) for one in found.change_points)
    both = [(90.0, "RPR"), (90.0, "RRP"), (90.0, "RRR"), (270.0, "RPR"), (270.0, "RRP"), (270.0, "RRR")]
    assert at == [(0.0, "RRR"), *both[:3], (180.0, "RRR"), *both[3:]]


def test_rows_of_very_different_lengths_do_not_jump_at_a_change_point():
    random = np.random.default_rng(20_261_122)
    made = cached_plan(FourBar(20, 80.62257748298549, 20, 80.62257748298549).linkage())
    for _ in range(400):
        before = -np.sort(10 ** random.uniform(-3, 0.7, 3))[::-1]
        after = np.sort(10 ** random.uniform(-3, 0.7, 2))
        path = np.radians(np.concatenate([[-20, -15, -10, -6], before, after, [10, 15]]))
        motion = move(made, path, branch="-")
        assert motion.complete
        assert np.abs(np.exp(1j * (motion.angle("rocker") - path)) - 1).max() < 1e-6


@pytest.mark.parametrize("bends", [(0, 0, 0), (1e-3, 0, 1e-3), (1e-2, 1.5, 0), (pi / 2, pi, 0.5)], ids=str)
@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows many turns apart
def test_parallelograms_in_a_row_pass_their_change_points_together(bends: tuple[float, ...]) -> None:
    """Whether the change points are at the same drive value, near one another or apart, and the rows long or short."""
    random = np.random.default_rng(20_261_123)
    for _ in range(25):
        linkage = parallelograms(random.uniform(0.5, 2, 4).tolist(), random.uniform(2.1, 4, 3).tolist(), list(bends))
        before, behind = 10 ** random.uniform(-6, -1, 2)
        path = np.array([1, 2.5, 3, pi - before, pi + behind, pi + behind + 0.1, 5.5, 2 * pi + before, 7.5, 4, 1])
        motion = move(linkage, path)
        assert motion.complete
        for k in range(1, 4):
            turned = motion.angle(str(k)) - motion.angle(str(k))[0]
            assert turned == pytest.approx(path - path[0], rel=0, abs=1e-6)


def test_a_long_row_behind_short_ones_is_walked_in_small_steps() -> None:
    linkage = parallelograms([1, 1.3, 0.7], [2.5, 2], [1.5, 0])
    path = [1.0, 2.5, 3.0, 3.15, 3.25, 5.5]
    motion = move(linkage, path)
    assert motion.angle("2") - motion.angle("2")[0] == pytest.approx(np.array(path) - 1, rel=0, abs=1e-9)


@pytest.mark.parametrize("branch", ["+", "-"])
@pytest.mark.parametrize("turned", [0.0, 2.0])
def test_a_start_more_than_half_a_turn_from_the_reference_pose(branch, turned):
    """A drive with a range of 283 degrees: the shorter way to the other end leads out of it, the longer one is gone.

    cos phi_max = (a^2 + d^2 - (b + c)^2)/2ad = -0.782; the pose is that of the way in small steps.
    """
    bar = FourBar(63.447, 156.019, 90.951, 194.187).linkage()
    start = move(bar, [2.3], branch=branch)
    posed = bar.with_reference_pose(start.pose(0))
    whole = turned * np.pi
    direct = move(posed, [whole - 2.3])
    walked = move(posed, np.linspace(2.3, -2.3, 400))
    assert direct.complete
    assert walked.complete
    for link in bar.mechanism.chain.links:
        gap = np.exp(1j * direct.angle(link)[0]) - np.exp(1j * walked.angle(link)[-1])
        assert abs(gap) < 1e-9
