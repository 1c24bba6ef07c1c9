"""Equilibrium against virtual work, against free bodies by hand, against the documents' figures."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.forces import Loads, equilibrium, statics
from gruebler.mechanics.forces.taking_apart import removal_steps
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.linkages import Circle, Linkage, LinkPoint
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.geometry.linkages import MOVING

numbers = st.floats(-100, 100)
FIVE_BAR = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)"),
    {0: (0, 0), 1: (0, 2), 2: (2, 4), 3: (4, 2), 4: (4, 0)},
    points={"K": ("2", 2.0, 4.0)},
)
FORKED = Linkage.from_drawing(  # one pin for the crank and two rods: a V engine
    Mechanism.parse("R(0-1) R(1-2-3) R(2-4) R(3-5) P(0-4) P(0-5); frame=0; drive=R(0-1)"),
    {0: (0, 0), 1: (0, 2), 2: (-3, 6), 3: (3, 6), 4: (-3, 6, np.pi / 2), 5: (3, 6, np.pi / 2)},
)
ELEVATOR = Linkage.from_drawing(  # a slide is driven and hangs on another one; its load leans on a wall
    Mechanism.parse("P(0-1) R(1-2) P(2-3) R(0-3); frame=0; drive=P(0-1)"),
    {0: (1, 0, np.pi / 2), 1: (1, 1), 2: (2, 1.5, 0.4), 3: (4, 0)},
)


def moved(name):
    linkage, rows, one, other = MOVING[name]
    return move(linkage, rows[::20]), one, other


@pytest.mark.parametrize("name", MOVING)
@given(fx=numbers, fy=numbers, one_moment=numbers, other_moment=numbers, mass=st.floats(0, 50))
@settings(max_examples=10, deadline=None)
def test_rivals(name, fx, fy, one_moment, other_moment, mass):
    """Equilibrium of every link and virtual work give one effort of the drive."""
    motion, one, other = moved(name)
    loads = Loads({"K": (fx, fy)}, moments={one: one_moment, other: other_moment}, masses={"K": mass})
    held = statics(motion, loads)
    scale = (abs(fx) + abs(fy) + 10 * mass) * motion.linkage.size + abs(one_moment) + abs(other_moment)
    assert not held.singular.any()
    assert np.abs(held.drive - held.work).max() <= 1e-10 * scale


@pytest.mark.parametrize("name", MOVING)
def test_power_in_is_power_out(name):
    """Without friction the drive's power and that of the loads add up to nothing."""
    linkage, rows, one, _ = MOVING[name]
    motion = move(linkage, rows[::20], speed=2.5)
    force, moment = np.array([3.0, -8.0]), 40.0
    held = statics(motion, Loads({"K": force}, moments={one: moment}))
    out = motion.point("K", order=1) @ force + moment * motion.angular(one)
    assert np.allclose(held.drive[:, 0] * 2.5, -out, rtol=1e-9, atol=1e-9 * np.abs(out).max())


@pytest.mark.parametrize("name", MOVING)
def test_free_bodies(name):
    """Oracle: forces and moments about an arbitrary point add up to zero on every link, and on the whole."""
    motion, one, _ = moved(name)
    linkage, chain = motion.linkage, motion.linkage.mechanism.chain
    held = statics(motion, Loads({"K": (3, -8)}, moments={one: 40}))
    place = linkage.points_named("K")[-1]
    about = 0.3 - 1.7j
    for link in set(chain.links) - {linkage.mechanism.frame}:
        force, moment = np.zeros(len(motion), complex), np.zeros(len(motion))
        for number, joint in enumerate(chain.joints):
            if link not in joint.links:
                continue
            end = linkage.element(number, joint.links[1] if joint.pair.name == "prismatic" else link)
            at = motion.complex_point(
                LinkPoint(joint.links[1] if joint.pair.name == "prismatic" else link, end.x, end.y)
            )
            mine = held.force(number, link=link) @ [1, 1j]
            for k, drive in enumerate(linkage.mechanism.drives):
                if drive.joint == number and joint.pair.name == "prismatic":
                    first, _ = linkage.reference(k)
                    line = linkage.element(number, first)
                    along = motion.turns[:, chain.links.index(first)] * np.exp(1j * line.angle)
                    mine = mine + (-1 if link == first else 1) * held.drive[:, k] * along
                elif drive.joint == number:
                    moment += (-1 if link == linkage.reference(k)[0] else 1) * held.drive[:, k]
            force += mine
            moment += (np.conj(at - about) * mine).imag + held.couple(number, link=link)
        if link == place.link:
            force += 3 - 8j
            moment += (np.conj(motion.complex_point("K") - about) * (3 - 8j)).imag
        moment += 40 * (link == one)
        assert np.abs(force).max() < 1e-9
        assert np.abs(moment).max() < 1e-9 * 100 * linkage.size


def test_two_force_members_and_a_joint_of_three_links():
    """Unloaded rods carry along their length; the three forces on one pin add up to zero."""
    motion = move(FORKED, from_degrees(90, 130, 10), branch=None)
    held = statics(motion, Loads({"R(2-4)": (0, -50), "R(3-5)": (0, -20)}))
    pin = sum(held.force("R(1-2-3)", link=link) for link in "123")
    assert np.abs(pin).max() < 1e-12
    foot = FORKED.element("R(1-2-3)", "2")
    rod = motion.point("R(2-4)") - motion.point(LinkPoint("2", foot.x, foot.y))
    pull = held.force("R(1-2-3)", link="2")
    assert np.abs(rod[:, 0] * pull[:, 1] - rod[:, 1] * pull[:, 0]).max() < 1e-10
    assert held.disagreement < 1e-12


def test_two_drives():
    motion = move(FIVE_BAR, np.array([[np.pi / 2, np.pi / 2], [1.6, 1.5]]))
    held = statics(motion, Loads({"K": (1, -2)}, moments={"3": 0.5}))
    assert np.allclose(held.drive, held.work, rtol=1e-12)
    assert held.drive.shape == (2, 2)


@pytest.mark.parametrize("name", [*MOVING, "five-bar", "forked", "elevator"])
def test_link_by_link_is_all_links_at_once(name, monkeypatch):
    """The linear system of all links is the second method, the only one for a triad and for a drive within a dyad."""
    if name in MOVING:
        motion, one, other = moved(name)
    else:
        linkage = {"five-bar": FIVE_BAR, "forked": FORKED, "elevator": ELEVATOR}[name]
        pose = linkage.required_pose
        drives = [pose["1"].angle, *([pose["4"].angle] if name == "five-bar" else [])]
        drives = [[0.5]] if name == "elevator" else [drives]
        (motion, one, other) = move(linkage, drives), "2", "3"
    loads = Loads(forces={f"{one}:3,1": (3, -7)}, moments={one: 5.0, other: -9.0}, masses={f"{other}:1,2": 0.3})
    assert (removal_steps(motion.lower_linkage) is None) == (name in ("cylinder", "six-bar"))
    found = statics(motion, loads).reactions
    monkeypatch.setattr(equilibrium, "removal_steps", lambda _: None)
    wanted = statics(motion, loads).reactions
    assert not wanted.singular.any()
    for kind in ("forces", "couples", "drives"):
        part, other_part = getattr(found, kind), getattr(wanted, kind)
        np.testing.assert_allclose(part, other_part, rtol=1e-10, atol=1e-10 * np.abs(wanted.forces).max())


def test_weights_are_the_slope_of_the_potential():
    """The torque that holds a weight is d(m g h)/d phi."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    h = 1e-5
    motion = move(linkage, [1.0 - h, 1.0, 1.0 + h])
    held = statics(motion, Loads(masses={"K": 3.0}))
    slope = 3 * 9.80665 * (motion.point("K")[2, 1] - motion.point("K")[0, 1]) / (2 * h)
    assert held.drive[1, 0] == pytest.approx(slope, rel=1e-8)
    upside = statics(motion, Loads(masses={"K": 3.0}, gravity=(0, 9.80665)))
    assert np.allclose(upside.drive, -held.drive)


def test_lever_law_of_the_poles():
    """Four-bar: M_out / M_in = P12P24 / P14P24 by the pole of crank and rocker (55 degrees: -64.233472 from A0)."""
    motion = move(FourBar(25, 70, 40, 70).linkage(), [np.radians(55)])
    held = statics(motion, Loads(moments={"rocker": -1.0}))
    assert held.drive[0, 0] == pytest.approx(64.23347175135778 / (70 + 64.23347175135778), rel=1e-12)


def test_a_toggle_press_lifts_what_it_likes_in_its_dead_centre():
    press = move(SliderCrank(3, 5).linkage(), np.radians([0.0, 1e-3]))
    held = statics(press, Loads({"R(coupler-slider)": (-100, 0)}))
    assert held.drive[0, 0] == pytest.approx(0, abs=1e-12)
    assert held.force("R(coupler-slider)").tolist()[0] == pytest.approx([100, 0])


def test_where_links_are_not_held():
    """In the change point of the parallel crank the torque stays, the joint forces are not determined."""
    motion = move(FourBar(25, 70, 25, 70).linkage(), np.radians([10, 0, -10]), branch="+")
    held = statics(motion, Loads(moments={"rocker": -5}))
    assert held.work[:, 0] == pytest.approx([5, 5, 5])
    assert held.singular.tolist() == [False, True, False]
    assert np.isnan(held.force("R(coupler-rocker)")[1]).all()
    assert "0° the joint forces are not determined" in held.message()
    assert "nicht bestimmt" in held.message("de")
    assert statics(move(motion.linkage, [0.5], branch="+"), Loads(moments={"rocker": -5})).message() == ""


def test_at_its_limits_the_drive_holds_nothing():
    course = drive_cycle(FourBar(60, 30, 30, 70).linkage())
    motion = course.at(np.array([course.span.low, 0.1, course.span.high]), 0)
    held = statics(motion, Loads(moments={"rocker": 1}))
    assert held.singular.tolist() == [True, False, True]
    assert held.disagreement < 1e-12


def test_a_load_on_a_slider_that_its_guide_takes():
    """A moment on the piston is carried by the guide alone; nothing is left for the drive, by both ways."""
    motion = move(SliderCrank(20, 50).linkage(), np.linspace(0, 6, 30))
    held = statics(motion, Loads(moments={"slider": 10.0}))
    assert np.abs(held.work).max() < 1e-12
    assert held.disagreement < 1e-14
    assert held.couple("P(frame-slider)") == pytest.approx(np.full(30, -10.0))
    assert held.couple("P(frame-slider)", link="frame") == pytest.approx(np.full(30, 10.0))
    assert not held.couple("R(crank-coupler)").any()


def test_many_rows_are_the_same_as_few():
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    rows = np.linspace(0, 6, 5000)
    loads = Loads({"K": (1, 2)})
    whole = statics(move(linkage, rows), loads)
    part = statics(move(linkage, rows[2040:2060]), loads)
    assert np.allclose(whole.force("R(coupler-rocker)")[2040:2060], part.force("R(coupler-rocker)"), rtol=1e-12)
    changing = statics(move(linkage, rows), Loads({"K": np.outer(rows, [1, 2])}))
    assert np.allclose(changing.drive[:, 0], rows * whole.drive[:, 0])


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        (Loads({"Q": (1, 2)}), "no point 'Q'"),
        (Loads({"K": 3.0}), "expected x and y"),
        (Loads({"K": (1, float("nan"))}), "expected finite numbers"),
        (Loads({"K": (1, "log(-1)")}), "the law is not finite at a time of 0 s, where the first drive is at"),
        (Loads({"K": "much"}), "expected x and y"),
        (Loads({LinkPoint("roker", 0, 0): (1, 2)}), "no link 'roker'"),
        (Loads(moments={"roker": 1}), "did you mean 'rocker'"),
        (Loads(moments={"rocker": (1, 2, 3, 4)}), "one number for each row"),
        (Loads(moments={"rocker": float("inf")}), "finite"),
        (Loads(masses={"K": -1}), "negative"),
    ],
)
def test_wrong_loads(loads, message):
    motion = move(FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}), [0.1, 0.2])
    with pytest.raises(LinkageError, match=message):
        statics(motion, loads)


@pytest.mark.parametrize("gravity", [(1, 2, 3), 9.81, "down", (0, "x")])
def test_gravity_is_x_and_y(gravity):
    with pytest.raises(LinkageError, match="gravity: expected a list of 2"):
        Loads(masses={"K": 1}, gravity=gravity)


def test_wrong_questions():
    motion = move(FourBar(25, 70, 40, 70).linkage(), [0.1, 0.2])
    held = statics(motion, Loads(moments={"rocker": 1}))
    with pytest.raises(LinkageError, match="is not a joint of 'crank'"):
        held.force("R(frame-rocker)", link="crank")
    with pytest.raises(LinkageError, match="is not one of the joints"):
        held.force("R(frame-rokker)")
    with pytest.raises(LinkageError, match="has no rows"):
        statics(move(FourBar(60, 30, 30, 70).linkage(), [3.0]), Loads(moments={"rocker": 1}))


@pytest.mark.parametrize(("branch", "ratio"), [("+", -1.0), ("-", 7 / 3)])
def test_the_effort_in_a_change_point_is_that_of_its_branch(branch, ratio):
    """A parallelogram 2, 5: the rocker turns like the crank, or crossed -(d + a)/(d - a) times as fast."""
    linkage = FourBar(2, 5, 2, 5).linkage()
    loads = Loads(moments={"rocker": 1.0})
    alone = statics(move(linkage, [0.0], branch=branch, order=1), loads)
    assert alone.singular.all()
    assert alone.work.ravel() == pytest.approx([ratio])
    faster = statics(move(linkage, [0.0], branch=branch, speed=3.0, order=1), loads)
    assert faster.work.ravel() == pytest.approx([ratio])
    on_the_way = statics(move(linkage, [0.3, 0.0, -0.3], branch=branch), loads)
    assert on_the_way.work[1] == pytest.approx([ratio])
    unknown = statics(move(linkage, [0.0], branch=branch), loads)  # no velocities: both branches have this pose
    assert np.isnan(unknown.work).all()
    assert "depends on the branch" in unknown.message()
    assert "Einbaulage" in unknown.message("de")


def test_a_contact_that_was_left_out():
    """Circles about two pins of a four-bar's coupler touch always: they and the coupler press as they like."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) G(1-3) R(2-3) R(0-3); frame=0; drive=R(0-1)")
    places = {0: (0, 0), 1: (10, 20), 3: (40, 60), 4: (60, 0)}
    touching = {2: {"1": Circle(10, 20, 20.0), "3": Circle(40, 60, 30.0)}}
    motion = move(Linkage.from_drawing(mechanism, {**places, **touching}), [1.2])
    assert motion.complete
    with pytest.raises(LinkageError, match="overconstrained"):
        statics(motion, Loads(moments={"3": 10.0}))


def test_nothing_agrees_with_nothing():
    """Where equilibrium has no answer the two ways are not said to agree."""
    held = statics(move(FourBar(2, 5, 2, 5).linkage(), [0.0], order=1), Loads(moments={"rocker": 1.0}))
    assert np.isnan(held.disagreement)


def test_the_order_of_joints_of_a_linkage_before_does_not_count():
    """Chains are equal in whatever order their joints are written; forces are told by the numbers of joints."""
    places = {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (6, 4), "R(0-3)": (6, 0)}
    held = []
    for order in ("R(0-1) R(1-2) R(2-3) R(0-3)", "R(0-1) R(2-3) R(1-2) R(0-3)"):
        mechanism = Mechanism.parse(f"{order}; frame=0; drive=R(0-1)")
        linkage = Linkage.from_drawing(mechanism, {j: places[j] for j in order.split()}, points={"K": ("2", 1, 3)})
        held.append(statics(move(linkage, [1.0, 1.2]), Loads({"K": (3, -7)})))
    first, other = held
    assert first.motion.linkage.mechanism.chain == other.motion.linkage.mechanism.chain
    for joint in places:
        assert other.force(joint) == pytest.approx(first.force(joint))
