"""The whole circuit: laws of the curve, closed forms of the classical linkages, and `move` as its rival."""

from math import atan2, cos, degrees, hypot, pi, radians, sqrt

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.circuit_ranges import drive_range, motion_roles, rotatability
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.kinematics.circuits import circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.enumeration import chains
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.link_roles import Role

SIX = "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)"
CYLINDER = "R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)"
CRANKS = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-0); frame=0; drive=R(0-1)"
EIGHT = list(chains(links=8, mobility=1))

lengths = st.floats(0.2, 2.0)


def class_three():
    return Linkage.from_drawing(
        Mechanism.parse(SIX),
        {
            "R(0-1)": (0, 0),
            "R(1-2)": (0.5, 0.3),
            "R(2-h)": (2, 2),
            "R(0-3)": (5, 0),
            "R(3-h)": (4, 2.2),
            "R(0-4)": (2, 5.5),
            "R(4-h)": (3, 3.5),
        },
    )


def cylinder():
    places = {"R(0-1)": (0, 0), "R(4-2)": (3, 2), "P(1-2)": (0, 0, atan2(2, 3)), "R(0-4)": (4, 0)}
    return Linkage.from_drawing(Mechanism.parse(CYLINDER), places)


def three_cranks(third):
    """Three parallel cranks (1, 1.5) on one coupler; the third one stands at a given place."""
    x, y = third
    places = {"R(0-1)": (0, 0), "R(1-2)": (1, 1.5), "R(2-3)": (6, 1.5), "R(3-0)": (5, 0)}
    places |= {"R(2-4)": (x + 1, y + 1.5), "R(4-0)": (x, y)}
    return Linkage.from_drawing(Mechanism.parse(CRANKS), places)


def placed(linkage, home):
    """The same linkage with another home."""
    elements = {link: {} for link in linkage.mechanism.chain.links}
    for (number, link), element in linkage.elements.items():
        elements[link][number] = element
    return Linkage(linkage.mechanism, elements, reference_pose=home)


def check_laws(made):
    """The joints are closed everywhere, also between samples; tangents are derivatives; drives turn back in pairs."""
    assert made.closure < 1e-12
    arcs = np.linspace(0, made.length, 19)[:-1] + 0.0123
    poses = made.at(arcs)
    system = made.system
    for row in range(len(arcs)):
        x = np.array([v for link in system.bodies for v in poses.pose(row)[link]])
        x[0::3] /= system.lower.size
        x[1::3] /= system.lower.size
        residual, matrix = system.linearised(x)
        assert np.abs(residual).max() < 1e-12
        assert np.abs(matrix @ poses.tangents(system.bodies)[row]).max() < 1e-9
    assert made.closed
    assert len(made.drive_limits) % 2 == 0
    turns = np.array([made.angle(link)[-1] - made.angle(link)[0] for link in system.bodies]) / (2 * pi)
    assert np.abs(turns - np.round(turns)).max() < 1e-12
    for limit in made.drive_limits:
        near = made.at([limit.at - 1e-3, limit.at + 1e-3]).drive()
        assert (near < limit.value).all() if limit.kind == "maximum" else (near > limit.value).all()


def check_against_move(made, tolerance=1e-9):
    """On every stretch the drive is monotone and `move` finds the same positions."""
    for stretch in made.monotone_pieces:
        middle = (stretch.start + stretch.end) / 2
        arcs = middle + np.linspace(0, 0.9, 8) * (stretch.end - middle)
        poses = made.at(arcs)
        assert (np.diff(poses.drive()) > 0).all() or (np.diff(poses.drive()) < 0).all()
        motion = move(placed(made.linkage, poses.pose(0)), poses.drive())
        assert motion.complete
        for link in made.linkage.mechanism.chain.links:
            assert np.abs(np.exp(1j * motion.angle(link)) - np.exp(1j * poses.angle(link))).max() < tolerance


# --- closed forms --------------------------------------------------------------------------------------


@settings(max_examples=40, deadline=None)
@given(lengths, lengths, lengths, lengths)
def test_a_four_bar_turns_as_grashof_says(a, b, c, d):
    size = FourBar(a, b, c, d)
    assume(size.grashof.assemblable and size.type.key != "single_position")
    assume(abs(size.grashof.excess) > 1e-3 and size.limits[0].width > 0.05)
    made = circuit(size.linkage())
    assert made.closed
    assert not made.change_points
    assert made.closure < 1e-12
    found = {row.links: row for row in rotatability(made)}
    assert found["frame", "crank"].full == ("a" in size.turning)
    assert found["frame", "rocker"].full == ("c" in size.turning)
    full = drive_range(made)
    assert full.full == ("a" in size.turning)
    if not full.full:
        ends = [v for arc in size.limits for v in (arc.start, arc.end)]
        for value in (full.lowest, full.highest):
            assert min(abs(np.exp(1j * value) - np.exp(1j * end)) for end in ends) < 1e-11


def test_roles_come_from_the_motion():
    crank, coupler, rocker = Role.CRANK, Role.COUPLER, Role.ROCKER
    for size, expected in [
        (FourBar(25, 70, 40, 70), (crank, coupler, rocker)),
        (FourBar(40, 70, 25, 70), (rocker, coupler, crank)),
        (FourBar(70, 40, 70, 25), (crank, coupler, crank)),
        (FourBar(40, 25, 40, 60), (rocker, coupler, rocker)),
        (FourBar(30, 30, 50, 60), (rocker, coupler, rocker)),
    ]:
        assert tuple(motion_roles(size.linkage()).values()) == (Role.FRAME, *expected)
    assert motion_roles(SliderCrank(25, 70, 5).linkage())["slider"] is Role.SLIDER
    assert motion_roles(SliderCrank(70, 25, 5).linkage())["crank"] is Role.ROCKER


def test_the_swing_of_a_crank_rocker():
    size = FourBar(2, 7, 4.5, 5.5)
    rows = {row.joint: row for row in rotatability(size.linkage())}
    assert rows["R(frame-rocker)"].range == pytest.approx(size.swing, abs=1e-12)
    made = circuit(size.linkage())
    gap = made.range(lambda poses, order: poses.distance("R(frame-crank)", "R(coupler-rocker)", order))
    assert gap == pytest.approx((5, 9), abs=1e-12)  # b - a, b + a in the dead centres


def test_a_slider_crank_has_its_stroke():
    size = SliderCrank(20, 50, 10)
    made = circuit(size.linkage())
    row = next(row for row in rotatability(made) if row.freedom == "slide")
    assert row.range == pytest.approx(size.stroke, abs=1e-12)
    assert not made.drive_limits
    motion = size.motion(made.drive)
    assert made.point("R(coupler-slider)") == pytest.approx(motion.B.value, abs=1e-11)
    stuck = circuit(SliderCrank(50, 20, 10).linkage())
    values = [limit.value for limit in stuck.drive_limits]
    ends = [v for arc in SliderCrank(50, 20, 10).limits for v in (arc.start, arc.end)]
    for value in values:
        assert min(abs(np.exp(1j * value) - np.exp(1j * end)) for end in ends) < 1e-12


def test_an_inverted_slider_crank():
    swinging, turning = (InvertedSliderCrank(*size).linkage() for size in [(25, 70, 10), (70, 25, 10)])
    for linkage, full in [(swinging, False), (turning, True)]:
        made = circuit(linkage)
        rows = {row.joint: row for row in rotatability(made)}
        assert rows["R(frame-crank)"].full
        assert rows["R(frame-block)"].full == full
        ways = sqrt(45**2 - 10**2), sqrt(95**2 - 10**2)
        found = sorted(abs(end) for end in (rows["P(coupler-block)"].lowest, rows["P(coupler-block)"].highest))
        assert found == pytest.approx(ways, abs=1e-12)


def test_a_double_rocker_passes_both_limits_and_returns():
    size = FourBar(30, 30, 50, 60)
    made = circuit(size.linkage())
    assert made.closed
    reach = np.arccos((30**2 + 60**2 - 80**2) / (2 * 30 * 60))  # coupler and rocker in line: b + c = 80
    assert sorted(limit.value for limit in made.drive_limits) == pytest.approx([-reach, reach], abs=1e-12)
    span = drive_range(made)
    assert not span.full
    assert (span.lowest, span.highest) == pytest.approx((-reach, reach), abs=1e-12)
    assert made.at(made.length + 1.0).point("R(crank-coupler)") == pytest.approx(made.at(1.0).point("R(crank-coupler)"))
    check_against_move(made)


# --- change points -------------------------------------------------------------------------------------


@pytest.mark.parametrize(("branch", "turns"), [("+", 1), ("-", -1)])
def test_a_parallelogram_goes_straight_on_in_its_change_points(branch, turns):
    made = circuit(FourBar(25, 70, 25, 70).linkage(), branch=branch, at=radians(50))
    assert made.closed
    assert not made.drive_limits
    assert sorted(abs(np.cos(point.drive)) for point in made.change_points) == pytest.approx([1, 1], abs=1e-12)
    assert round((made.angle("rocker")[-1] - made.angle("rocker")[0]) / (2 * pi)) == turns
    assert made.poses_at_change_points.point("R(coupler-rocker)")[:, 1] == pytest.approx([0, 0], abs=1e-10)


@pytest.mark.parametrize("miss", [1e-2, 1e-5, 1e-8])
def test_a_near_miss_is_no_change_point(miss):
    made = circuit(FourBar(25, 70 + 70 * miss, 25, 70).linkage(), at=1.0)
    assert made.closed
    assert not made.change_points
    assert len(made.drive_limits) == 2
    low, high = sorted(limit.value for limit in made.drive_limits)
    assert high - low < 2 * pi - 1e-6


def test_redundant_cranks_move():
    made = circuit(three_cranks((3, 2)))  # the third crank carries it through: no change point
    assert made.closed
    assert made.closure < 1e-12
    assert not made.change_points
    assert drive_range(made).full
    flat = circuit(three_cranks((3, 0)))
    assert [round(degrees(point.drive), 6) % 180 for point in flat.change_points] == [0, 0]


@pytest.mark.parametrize(("end", "words"), [((3, 4), "joints hold every link"), ((2.5, 1.75), "shaky")])
def test_a_third_crank_that_does_not_fit_holds_the_linkage(end, words):
    places = {
        "R(0-1)": (0, 0),
        "R(1-2)": (1, 1.5),
        "R(2-3)": (6, 1.5),
        "R(3-0)": (5, 0),
        "R(2-4)": end,
        "R(4-0)": (2, 1),
    }
    with pytest.raises(LinkageError, match=words):
        circuit(Linkage.from_drawing(Mechanism.parse(CRANKS), places))


# --- rivals --------------------------------------------------------------------------------------------


def test_the_limit_of_a_class_three_group_is_that_of_move():
    made = circuit(class_three())
    check_laws(made)
    limit = next(limit for limit in made.drive_limits if limit.kind == "maximum")
    assert degrees(limit.value) == pytest.approx(97.5252475, abs=1e-7)
    motion = move(class_three(), np.radians(np.linspace(40, 120, 81)))
    assert motion.stop is not None
    assert limit.value == pytest.approx(motion.stop.drives[0], abs=1e-9)
    check_against_move(made)


def test_a_cylinder_reaches_from_one_dead_centre_to_the_other():
    made = circuit(cylinder())
    check_laws(made)
    assert [limit.value for limit in made.drive_limits] == pytest.approx([4 + sqrt(5), 4 - sqrt(5)], abs=1e-12)
    rows = {row.joint: row for row in rotatability(made)}
    assert rows["R(0-4)"].full
    check_against_move(made)


@settings(max_examples=10, deadline=None)
@given(st.sampled_from(EIGHT), st.integers(0, 2**32 - 1))
def test_eight_links_with_random_dimensions(chain, seed):
    rng = np.random.default_rng(seed)
    frame = chain.links[rng.integers(8)]
    drive = int(rng.choice([k for k, joint in enumerate(chain.joints) if frame in joint.links]))
    places = {k: tuple(rng.uniform(0, 4, 2)) for k in range(len(chain.joints))}
    check_laws(circuit(Linkage.from_drawing(Mechanism(chain, frame, [drive]), places)))


@pytest.mark.parametrize("number", range(len(EIGHT)))
def test_every_eight_link_chain_against_move(number):
    rng, chain = np.random.default_rng(number), EIGHT[number]
    frame = chain.links[rng.integers(8)]
    drive = int(rng.choice([k for k, joint in enumerate(chain.joints) if frame in joint.links]))
    places = {k: tuple(rng.uniform(0, 4, 2)) for k in range(len(chain.joints))}
    made = circuit(Linkage.from_drawing(Mechanism(chain, frame, [drive]), places))
    check_laws(made)
    check_against_move(made, 1e-8)


# --- other linkages ------------------------------------------------------------------------------------


def test_a_pin_in_a_slot_and_a_double_slide():
    slotted = Mechanism.parse("R(0-1) G(1-2) R(0-2); frame=0; drive=R(0-1)")
    drawn = Linkage.from_drawing(slotted, {"R(0-1)": (0, 0), "G(1-2)": (1, 0, 0.3, "2"), "R(0-2)": (3, -1)})
    rows = {(row.joint, row.freedom): row for row in rotatability(drawn)}
    assert rows["R(0-1)", "turn"].full
    assert not rows["R(0-2)", "turn"].full
    off = abs((1 - 3) * np.sin(0.3) - (0 + 1) * np.cos(0.3))  # the slot's line from the pivot of 2
    ways = np.sqrt((hypot(3, 1) + np.array([-1, 1])) ** 2 - off**2)
    assert rows["G(1-2)", "slide"].range == pytest.approx(ways[1] - ways[0], abs=1e-12)


def test_without_a_drive_there_are_no_limits_but_a_circuit():
    free = class_three().with_mechanism(Mechanism.parse(SIX.removesuffix("; drive=R(0-1)")))
    made, driven = circuit(free), circuit(class_three())
    assert made.length == pytest.approx(driven.length, rel=1e-6)
    with pytest.raises(LinkageError, match="no drive"):
        assert made.drive is None


def test_the_arc_is_a_length():
    made = circuit(FourBar(25, 70, 40, 70).linkage())
    arcs = np.linspace(0, made.length, 4001)
    poses = made.at(arcs)
    size = made.linkage.size
    columns = [poses.angle(link) for link in made.system.bodies]
    columns += [poses.places[0, :, made.system.lower.mechanism.chain.index(link)] / size for link in made.system.bodies]
    steps = np.sqrt(sum(np.abs(np.diff(column)) ** 2 for column in columns))
    assert steps.sum() == pytest.approx(made.length, rel=1e-6)
    assert steps == pytest.approx(np.diff(arcs), rel=1e-3)


def test_roots_and_touches():
    made = circuit(FourBar(25, 70, 40, 70).linkage())
    top = max(made.point("R(crank-coupler)")[:, 1])
    assert top <= 25
    touches = made.roots(lambda poses, order: poses.point("R(crank-coupler)", order=order)[:, 1] - 25 * (order == 0))
    assert np.cos(made.at(touches).angle("crank")) == pytest.approx([0], abs=1e-6)
    with pytest.raises(LinkageError, match="finite positions"):
        made.at(float("nan"))


def test_an_open_circuit_says_so():
    made = circuit(FourBar(30, 30, 50, 60).linkage(), most=2.0)
    assert not made.closed
    assert "longer" in made.message()
    assert "länger" in made.message("de")
    assert made.start == pytest.approx(2.0, abs=0.2)
    assert made.closure < 1e-12
    with pytest.raises(LinkageError, match="not closed"):
        made.at(made.length + 1)
    assert cos(made.at(made.start).drive()[0]) == pytest.approx(
        cos(circuit(FourBar(30, 30, 50, 60).linkage()).drive[0])
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"at": float("inf")}, "finite number"),
        ({"at": "1"}, "at: expected a number, but found '1'"),
        ({"at": 3.0}, "cannot be assembled at 3"),
        ({"step": 0.0}, "between"),
        ({"most": -1}, "above 0"),
        ({"branch": "++"}, "branch"),
    ],
)
def test_wrong_calls(change, words):
    with pytest.raises(LinkageError, match=words):
        circuit(FourBar(30, 30, 50, 60).linkage(), **change)


def test_what_has_no_circuit():
    with pytest.raises(LinkageError, match="cannot be assembled at any"):
        circuit(FourBar(1, 1, 1, 5).linkage())
    with pytest.raises(LinkageError, match="singular position"):
        circuit(FourBar(25, 70, 25, 70).linkage(), at=0)
    five = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); frame=0; drive=R(0-1)")
    corners = {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (2, 3), "R(3-4)": (4, 2), "R(4-0)": (4, 0)}
    with pytest.raises(LinkageError, match="one freedom, but this one has 2"):
        circuit(Linkage.from_drawing(five, corners))
    with pytest.raises(LinkageError, match="expected a linkage"):
        circuit("R(0-1)")
    stiff = Mechanism.parse("R(0-1) R(1-2) R(2-0); frame=0")
    with pytest.raises(LinkageError, match="cannot move"):
        circuit(Linkage.from_drawing(stiff, {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-0)": (2, 3)}))
