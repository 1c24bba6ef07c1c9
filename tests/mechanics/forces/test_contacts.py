"""Forces between teeth, belts, cams, Geneva drives: by hand, by free bodies, by virtual work, by closed forms."""

from math import cos, inf, sin, sqrt, tan

import numpy as np
import pytest
from scipy.optimize import brentq

from gruebler.base.errors import LinkageError
from gruebler.machines.cams import Cam, Roller, read_lift
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.dynamics import inverse_dynamics
from gruebler.mechanics.forces import Friction, Loads, RigidBody, statics
from gruebler.mechanics.forces.contact_forces import CONTACT_FORCES
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.kinematics.contacts import CONTACT_MOTIONS
from gruebler.mechanics.linkages import Circle, Linkage, LinkPoint, Wheel
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.forces.test_friction import put_back
from tests.mechanics.kinematics import test_cams_in_linkages as cams
from tests.mechanics.kinematics import test_noncircular_wheels as noncircular
from tests.mechanics.kinematics import test_wheels as wheels

ALPHA = np.radians(20)
LINKAGES = {
    **wheels.LINKAGES,
    "planetary": wheels.planetary(24, 18, 60),
    "flat cam": cams.flat_follower(),
    "roller": cams.roller_follower(),
    "knife edge": cams.rocker_follower(),
    "Geneva": cams.geneva(),
    "Geneva, two pins": cams.geneva(6, 2),
    "internal Geneva": cams.geneva(5, 1, True),
    "ellipses": noncircular.pair("ellipse 0.5"),
    "lobes": noncircular.pair(noncircular.WAVES, (30, 20), turned=0.4),
}


def loads_on(linkage):
    """Arbitrary forces on all moving links, and moments but on a roller, which is free to spin."""
    moving = [link for link in linkage.mechanism.chain.links if link != linkage.mechanism.frame]
    forces = {
        (link, *((0.0, 0.0) if link == "roller" else (3.0, 4.0 - k))): (10.0 * k + 3, 7.0)
        for k, link in enumerate(moving)
    }
    return Loads(forces, moments={link: 100.0 * (k + 1) for k, link in enumerate(moving) if link != "roller"})


def test_every_contact_that_moves_has_its_force():
    assert set(CONTACT_FORCES) == set(CONTACT_MOTIONS)


@pytest.mark.parametrize("name", LINKAGES)
def test_equilibrium_is_virtual_work_and_every_link_is_free(name):
    """Oracle: on every link forces and moments about an arbitrary point add up to nothing."""
    linkage = LINKAGES[name]
    mechanism, drives = linkage.mechanism, len(linkage.mechanism.drives)
    given, way = loads_on(linkage), np.outer(np.linspace(0.1, 5.9, 25), np.array([1.0, 0.3])[:drives])
    motion = move(linkage, way, speed=np.array([1.0, 0.3])[:drives])
    held = statics(motion, given)
    assert not held.singular.any()
    assert held.disagreement < 1e-11
    about = 0.3 - 1.7j
    for link in set(mechanism.chain.links) - {mechanism.frame}:
        own = [(place, force) for place, force in given.forces.items() if place[0] == link]
        force, moment = np.zeros(len(motion), complex), np.full(len(motion), given.moments.get(link, 0.0))
        for (_, x, y), vector in own:
            force += complex(*vector)
            moment += (np.conj(motion.complex_point(LinkPoint(link, x, y)) - about) * complex(*vector)).imag
        for number, joint in enumerate(mechanism.chain.joints):
            if link in joint.links:
                end = linkage.element(number, joint.links[1])
                at = motion.complex_point(LinkPoint(joint.links[1], end.x, end.y))
                mine = held.force(number, link=link) @ [1, 1j]
                force += mine
                moment += (np.conj(at - about) * mine).imag + held.couple(number, link=link)
        for k, drive in enumerate(mechanism.drives):
            if link in drive.between or link in mechanism.chain.joints[drive.joint].links:
                moment += (-1 if link == linkage.reference(k)[0] else 1) * held.drive[:, k]
        scale = max(np.abs(held.reactions.forces).max(), 100.0)
        assert np.abs(force).max() < 1e-10 * scale
        assert np.abs(moment).max() < 1e-10 * scale * linkage.size


def two_wheels(first, second, **more):
    """The first in the origin, the second on the x axis, its shaft driven by the first."""
    apart = first + second if not more.get("belt") else 100.0
    mechanism = Mechanism.parse("R(0-1) R(0-2) G(1-2); frame=0; drive=R(0-1)")
    touch = {"1": Wheel(0, 0, first, **more), "2": Wheel(apart, 0, second, **more)}
    return Linkage.from_drawing(mechanism, {"R(0-1)": (0, 0), "R(0-2)": (apart, 0), "G(1-2)": touch})


@pytest.mark.parametrize("moment", [100.0, -100.0])
@pytest.mark.parametrize(("first", "second"), [(30.0, 20.0), (12.0, -60.0), (-60.0, 12.0)])
def test_a_pair_of_gears_by_hand(first, second, moment):
    """W_t = M/r, W_r = W_t tan 20°, always towards the pinion's own centre (Norton, Design of Machinery, 9.3)."""
    held = statics(move(two_wheels(first, second), [0.4]), Loads(moments={"2": moment}))
    x, y = held.force("G(1-2)", link="2")[0]
    assert y == pytest.approx(moment / second)  # the pitch point lies at -second from the second centre
    assert x == pytest.approx(abs(y) * tan(ALPHA))  # the ring's axis lies at -48
    assert np.hypot(*held.force("R(0-2)", link="2")[0]) == pytest.approx(abs(moment / second) / cos(ALPHA))
    assert held.drive[0, 0] == pytest.approx(moment * first / second)


def test_other_pressure_angles():
    motion = move(two_wheels(30.0, 20.0, pressure_angle=np.radians(14.5)), [0.4])
    x, y = statics(motion, Loads(moments={"2": 100.0})).force("G(1-2)", link="2")[0]
    assert x / abs(y) == pytest.approx(0.258618, rel=1e-5)  # tan 14.5°
    mechanism, places = motion.linkage.mechanism, {"R(0-1)": (0, 0), "R(0-2)": (50, 0)}
    touch = {"1": Wheel(0, 0, 30.0), "2": Wheel(50, 0, 20.0, pressure_angle=0.3)}
    with pytest.raises(LinkageError, match="one pressure angle"):
        Linkage.from_drawing(mechanism, {**places, "G(1-2)": touch})
    with pytest.raises(LinkageError, match="below 60°, not 20"):
        two_wheels(30.0, 20.0, pressure_angle=20)


@pytest.mark.parametrize("moment", [500.0, -500.0])
@pytest.mark.parametrize("belt", ["open", "crossed"])
def test_a_belt_pulls_in_its_taut_strand(belt, moment):
    """By hand: the strand touches both circles; its pull is M/r2, and both shafts feel no more than it."""
    held = statics(move(two_wheels(30.0, 20.0, belt=belt), [0.4]), Loads(moments={"2": moment}))
    x, y = held.force("R(0-2)", link="2")[0]
    assert np.hypot(x, y) == pytest.approx(25.0)
    assert x > 0  # the shaft holds the wheel back from the other one
    across = (30 - 20) / 100 if belt == "open" else (30 + 20) / 100  # sine of the strand against the line of centres
    assert abs(y) == pytest.approx(25 * across)
    assert x == pytest.approx(25 * sqrt(1 - across**2))
    assert held.drive[0, 0] == pytest.approx((1 if belt == "crossed" else -1) * moment * 30 / 20)
    assert "preload" in held.message()


def test_a_cam_presses_under_its_pressure_angle():
    """The guide holds F tan(alpha), alpha by the closed form of the cam (docs/theory/cams.md), and the cam F/cos."""
    motion = move(cams.roller_follower(), from_degrees(5, 355, 7), speed=1.0)
    held = statics(motion, Loads({"R(tappet-roller)": (0, -100)}))
    alpha = Cam(read_lift(cams.LIFT), 40, Roller(10, 5)).pressure_angle(motion.drives[:, 0])
    assert np.abs(alpha).max() > 0.2
    np.testing.assert_allclose(np.abs(held.force("P(0-tappet)")[:, 0]), np.abs(100 * np.tan(alpha)), atol=1e-7)
    contact = held.force("G(cam-roller)", link="roller")
    np.testing.assert_allclose(np.hypot(*contact.T), 100 / np.cos(alpha), rtol=1e-8)
    slope = read_lift(cams.LIFT).at(motion.drives[:, 0], 1)
    np.testing.assert_allclose(held.drive[:, 0], 100 * slope, atol=1e-7)


def test_a_cam_with_friction_in_its_guide():
    """By hand: cam force N, guide force N sin(alpha), friction mu N |sin(alpha)| against the rise: N (c - mu s) = F."""
    motion = move(cams.roller_follower(offset=0.0), from_degrees(20, 70, 10), speed=1.0)
    loads = Loads({"R(tappet-roller)": (0, -100)})
    held = statics(motion, loads, friction={"P(0-tappet)": 0.2})
    alpha = np.abs(Cam(read_lift(cams.LIFT), 40, Roller(10)).pressure_angle(motion.drives[:, 0]))
    contact = np.hypot(*held.force("G(cam-roller)", link="roller").T)
    np.testing.assert_allclose(contact, 100 / (np.cos(alpha) - 0.2 * np.sin(alpha)), rtol=1e-8)
    assert held.disagreement < 1e-10
    everywhere = statics(motion, loads, friction=Friction(0.2, pin_radius=3.0))
    assert everywhere.disagreement < 1e-10
    with pytest.raises(LinkageError, match="does not turn on a pin"):
        statics(motion, loads, friction=Friction(0.2, pin_radius={"G(cam-roller)": 3.0}))


def test_what_nothing_holds_is_said():
    motion = move(cams.roller_follower(), [0.4])
    with pytest.raises(LinkageError, match="'roller' is free to spin"):
        statics(motion, Loads(moments={"roller": 10.0}))


@pytest.mark.parametrize("internal", [False, True])
def test_a_pin_presses_across_its_slot(internal):
    """By hand: the force is M by the pin's distance from the wheel's axis."""
    drive = Geneva(5, internal=internal)
    middle = 0.7 * drive.engaged
    angles = np.array([-middle, 0.0, middle])
    held = statics(move(cams.geneva(5, 1, internal), angles), Loads(moments={"cross": -1000.0}))
    crank = drive.sizes(100.0).crank
    reach = np.abs(crank * np.exp(1j * angles) + (100 if internal else -100))  # inside it steps on the far side
    sizes = np.hypot(*held.force("G(driver-cross)", link="cross").T)
    np.testing.assert_allclose(sizes, 1000 / reach, rtol=1e-8)
    np.testing.assert_allclose(held.drive[:, 0], 1000 * drive.move(angles).ratio, atol=1e-6)


def test_wheels_whose_distance_nothing_holds_are_pitch_circles():
    held = statics(move(wheels.eccentric_pair(), [0.3, 0.4]), Loads(moments={"2": 100.0}))
    assert "G(1-2) no link holds the distance" in held.message()
    assert "kein Glied" in held.message("de")


@pytest.mark.parametrize("name", ["five-bar", "five-bar with a belt", "rack", "ellipses", "lobes"])
def test_friction_of_pins_beside_teeth_put_back_as_a_load(name):
    linkage = LINKAGES[name]
    loads, motion = loads_on(linkage), move(linkage, np.linspace(0.1, 5.9, 9), speed=1.0)
    friction = Friction(0.12, pin_radius=0.02 * linkage.size)
    held, rival = statics(motion, loads, friction=friction), put_back(motion, loads, friction, 30)
    assert np.allclose(held.drive, rival.drive, rtol=1e-9)
    assert np.abs(held.drive - held.friction.frictionless).max() > 1e-3 * np.abs(held.drive).max()
    assert held.disagreement < 1e-12


@pytest.mark.parametrize("sense", [1, -1])
def test_gears_whose_shafts_rub_by_hand(sense):
    """W_t (r2 ∓ mu rho/cos 20°) = M: the shaft takes W_t/cos 20°, and its friction acts against the turning."""
    held = statics(
        move(two_wheels(30.0, 20.0), [0.4], speed=sense),
        Loads(moments={"2": 100.0}),
        friction=Friction(0.3, pin_radius=4.0),
    )
    circle = sense * 0.3 * 4 / cos(ALPHA)
    tooth = 100 / (20 - circle)
    assert held.force("G(1-2)", link="2")[0] == pytest.approx([tooth * tan(ALPHA), tooth])
    assert held.drive[0, 0] == pytest.approx(tooth * (30 + circle))
    assert held.friction.locking_factor[0] == pytest.approx(20 / circle if sense > 0 else inf, rel=1e-7)


def test_friction_of_a_shaft_may_press_the_other_flank():
    """By hand: 30 N·mm drive the second wheel on, its shaft carries 400 N and rubs with 0.1 · 2 mm · 400 N: the first
    must push it. 20 t = -30 + 0.2 |(400 + t tan 20°, t)|."""
    loads = Loads({("2", 0.0, 0.0): (400.0, 0.0)}, moments={"2": -30.0})
    motion = move(two_wheels(30.0, 20.0), [0.0])
    assert statics(motion, loads).force("G(1-2)", link="2")[0] == pytest.approx([1.5 * tan(ALPHA), -1.5])
    held = statics(motion, loads, friction=Friction({"R(0-2)": 0.1}, pin_radius=2.0))
    tooth = brentq(lambda t: 20 * t + 30 - 0.2 * np.hypot(400 + t * tan(ALPHA), t), 0, 10, xtol=1e-14)
    assert tooth > 2
    assert held.force("G(1-2)", link="2")[0] == pytest.approx([tooth * tan(ALPHA), tooth])
    assert held.drive[0, 0] == pytest.approx(30 * tooth)


def test_inertia_behind_gears_and_cams():
    """J1 + J2 (r1/r2)² is what the first shaft feels; a tappet of mass m asks for (m s'' + F) s' of the cam."""
    pair = move(two_wheels(30.0, 20.0), [0.0], speed=2.0, acceleration=5.0)
    bodies = {"1": RigidBody(0.0, (0, 0), 400.0), "2": RigidBody(0.0, (0, 0), 300.0)}
    run = inverse_dynamics(pair, Loads(bodies=bodies))
    assert run.drive[0, 0] == pytest.approx((400 + 300 * 1.5**2) * 5e-3)
    cam = move(cams.flat_follower(), from_degrees(10, 80, 10), speed=30.0)
    lift, angles = read_lift(cams.LIFT), cam.drives[:, 0]
    lifted = inverse_dynamics(cam, Loads(bodies={"valve": RigidBody(0.5)}, gravity=(0, 0)))
    np.testing.assert_allclose(
        lifted.drive[:, 0], 0.5e-3 * 900 * lift.at(angles, 2) * lift.at(angles, 1), rtol=1e-5, atol=1e-5
    )


def test_a_follower_lifts_off_where_its_spring_is_too_weak():
    """By hand: m (g + s'' w²) + F is what the cam must push with; m = 0.5 kg, w = 100 rad/s."""
    motion = move(cams.flat_follower(), from_degrees(0, 360, 1), speed=100.0)
    bend = read_lift(cams.LIFT).at(motion.drives[:, 0], 2) * 10
    smooth = np.abs(np.mod(motion.drives, 2 * np.pi) - cams.JOINTS).min(axis=1) > 1e-6
    for force in (0.0, 400.0):
        loads = Loads({("valve", 0, 0): (0, -force)}, bodies={"valve": RigidBody(0.5)}, gravity=(0, -9.81))
        held = inverse_dynamics(motion, loads).statics
        wanted = 0.5 * (9.81 + bend) + force
        np.testing.assert_allclose(held.pushes[2][smooth], wanted[smooth], rtol=1e-4, atol=1e-3)
        assert ("lift off" in held.message()) == (wanted < 0).any() == (force == 0)
        assert ("hebt" in held.message("de")) == (force == 0)
    assert "46° to 89°" in inverse_dynamics(motion, Loads(bodies={"valve": RigidBody(0.5)})).statics.message()
    grooved = move(cams.flat_follower(closed=True), motion.drives, speed=100.0)
    assert inverse_dynamics(grooved, Loads(bodies={"valve": RigidBody(0.5)})).statics.message() == ""


@pytest.mark.parametrize("follower", [Circle(3.0, 18.0, 8.0), Circle(3.0, -20.0, -30.0), (3.0, 10.0, 0.0)])
def test_an_eccentric_disc_pushes_what_lies_on_it(follower):
    """A roller above it, a ring that hangs on it, a flat face: up; what is drawn upwards lifts off."""
    mechanism = Mechanism.parse("R(0-disc) P(0-tappet) G(disc-tappet); frame=0; drive=R(0-disc)")
    places = {"R(0-disc)": (0, 0), "P(0-tappet)": (3, 40, np.pi / 2)}
    touch = {"disc": Circle(3, 0, 10.0), "tappet": follower}
    motion = move(Linkage.from_drawing(mechanism, {**places, "G(disc-tappet)": touch}), [0.0, 0.1])
    for force in (-5.0, 5.0):
        held = statics(motion, Loads({("tappet", 0.0, 0.0): (0.0, force)}))
        assert held.pushes[2][0] == pytest.approx(-force)
        assert ("lift off" in held.message()) == (force > 0)


def test_a_load_turns_a_rack_by_its_radius():
    held = statics(move(wheels.rack(), [0.2]), Loads({("rack", 0.0, 0.0): (10 * cos(0.3), 10 * sin(0.3))}))
    assert abs(held.drive[0, 0]) == pytest.approx(100.0)
    force = held.force("G(pinion-rack)", link="rack")[0] @ [1, 1j] * np.exp(-0.3j)
    assert force.real == pytest.approx(-10)
    assert force.imag == pytest.approx(-10 * tan(ALPHA))  # the rack lies below the pinion and is pushed down
