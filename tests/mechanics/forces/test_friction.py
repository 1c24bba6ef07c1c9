"""Coulomb friction solved with the joint forces: textbook formulas, other methods, and laws."""

from itertools import product
from math import atan, cos, hypot, inf, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces import Friction, Loads, statics
from gruebler.mechanics.forces.coulomb import Contacts, continued
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.forces.slider_oracle import slider_friction
from tests.mechanics.forces.test_statics import FIVE_BAR, FORKED
from tests.mechanics.geometry.linkages import MOVING

SLIDE = "P(frame-slider)"
PINS = ("R(frame-crank)", "R(crank-coupler)", "R(coupler-slider)")
SLIDER_CRANK = SliderCrank(25, 70).linkage()
PUSHED = Loads({"R(coupler-slider)": (-100, 0)})


# --- the slider-crank in closed form ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("size", "worst", "alpha"),
    [
        (SliderCrank(2, 5), 90, 23.578178478201835),
        (SliderCrank(2, 10), 90, 11.536959032815489),
        (SliderCrank(3, 5, -1), 90, 53.13010235415599),  # e lies so that the crank leans a + e
        (SliderCrank(3, 5, -1), 270, -23.578178478201835),
    ],
)
def test_literature(size, worst, alpha):
    """Documents 000/003, section 3.4: alpha_max, F_K = F/cos(alpha) without friction, F_N = F_K sin(alpha), F_R."""
    found, without = (slider_friction(size, np.radians([worst]), 100.0, mu) for mu in (0.2, 0.0))
    assert np.degrees(found.alpha) == pytest.approx([alpha], rel=1e-12)
    assert without.coupler * np.cos(found.alpha) == pytest.approx([100])
    assert found.side == pytest.approx(found.coupler * np.sin(np.radians(alpha)))
    assert found.friction == pytest.approx(0.2 * np.abs(found.side))
    along = found.coupler * np.cos(found.alpha)  # the slider goes back at 90 degrees, with the load, forth at 270
    assert along == pytest.approx(100 + (found.friction if worst == 270 else -found.friction))


@pytest.mark.parametrize("e", [0.0, 6.0, -6.0])
@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("load", [100.0, -40.0])
def test_rivals(e, backward, load):
    """The closed form and the equilibrium of all links."""
    size, phi = SliderCrank(20, 50, e), np.linspace(0.1, 6.2, 40)
    held = statics(
        move(size.linkage(), phi), Loads({"R(coupler-slider)": (-load, 0)}), friction=Friction(0.7, backward=backward)
    )
    closed = slider_friction(size, phi, load, 0.7, backward=backward)
    assert np.allclose(held.friction.normal[:, 0], np.abs(closed.side))
    assert np.allclose(held.friction.friction[:, 0], closed.friction)
    assert np.allclose(np.hypot(*held.force("R(coupler-slider)").T), np.abs(closed.coupler))
    arm = 20 * np.sin(phi + closed.alpha)
    assert np.allclose(held.drive[:, 0], -closed.coupler * arm)
    assert held.disagreement < 1e-13


def test_a_smaller_ratio_rubs_less():
    """Document 000, 3.4: the smaller the crank-conrod ratio, the smaller the deviation angle and the friction."""
    phi = np.linspace(0, 2 * np.pi, 50)
    worst = [slider_friction(SliderCrank(2, b), phi, 1.0, 0.1).friction.max() for b in (4, 5, 10, 40)]
    assert worst == sorted(worst, reverse=True)


@pytest.mark.parametrize(
    ("size", "coefficient", "phi", "torque"),
    [
        ((20, 50, 0), 0.1, 288, 2248.848),
        ((20, 50, 0), 0.34, 288, 2506.964),
        ((30, 50, 10), 0.1, 295, 4646.805),
        ((30, 50, 10), 0.34, 288, 6749.086),
        ((30, 50, 10), 0.34, 289, 6752.159),
    ],
)
def test_figures(size, coefficient, phi, torque):
    """Torques that another program found with friction put back as a load until it stayed (first-order estimates were
    2245.0, 2457.9, 4589.3 and 5692.2); here also by the textbook formula T = F a sin(phi + alpha)/(cos - mu |sin|)."""
    a, b, e = size
    alpha = np.arcsin((a * sin(radians(phi)) - e) / b)
    formula = -100 * a * sin(radians(phi) + alpha) / (cos(alpha) - coefficient * abs(sin(alpha)))
    held = statics(move(SliderCrank(*size).linkage(), [radians(phi)]), PUSHED, friction=coefficient)
    assert held.drive[0, 0] == pytest.approx(torque, abs=6e-4)
    assert held.drive[0, 0] == pytest.approx(formula, rel=1e-13)


def test_a_compressor():
    """The catalog's, a 30, b 100: the same program found 3225.2 at 288 degrees, the first-order estimate was 3222.3."""
    motion = move(entry("compressor").linkage(), [radians(288)])
    held = statics(motion, Loads({"R(conrod-piston)": (-100, 0)}), friction=0.1)
    assert held.drive[0, 0] == pytest.approx(3225.2, abs=0.05)


def test_a_v_engine_is_two_slider_cranks():
    """The catalog's V-compressor: two pistons on one crank pin, each rubs in its own cylinder; torques add up."""
    phi = from_degrees(0, 360, 7)
    motion = move(entry("vcomp").linkage(), phi)
    axes = np.radians([45, 135])
    loads = {f"R(conrod{k}-piston{k})": (-100 * cos(axis), -100 * sin(axis)) for k, axis in enumerate(axes, 1)}
    held = statics(motion, Loads(loads), friction=0.1)
    size, torque = SliderCrank(30, 110), np.zeros(len(phi))
    for axis in axes:
        rod = slider_friction(size, phi - axis, 100, 0.1)
        torque -= rod.coupler * 30 * np.sin(phi - axis + rod.alpha)
    assert np.allclose(held.drive[:, 0], torque, rtol=1e-12, atol=1e-9)
    assert np.abs(held.drive).max() > 1.01 * np.abs(held.friction.frictionless).max()


# --- self-locking, and more than one equilibrium ---------------------------------------------------


def test_self_locking_rows_have_no_torque():
    """mu |tan(alpha)| >= 1 against the load: NaN, and the message names the joint, the angle and the factor."""
    phi = from_degrees(0, 360, 1)
    size = SliderCrank(30, 50, 10)
    held = statics(move(size.linkage(), phi), PUSHED, friction=1.0)
    alpha = np.arcsin((30 * np.sin(phi) - 10) / 50)
    against = np.sin(phi + alpha) < 0  # the slider goes forth, against its load
    expected = against & (np.abs(np.tan(alpha)) >= 1)
    assert expected.sum() == 65
    assert held.locked.tolist() == expected.tolist()
    for values in (held.drive[:, 0], held.work[:, 0], held.force(SLIDE)[:, 1], held.friction.friction[:, 0]):
        assert np.isnan(values).tolist() == expected.tolist()
    factors = np.where(against & (np.abs(np.sin(phi + alpha)) > 1e-9), 1 / np.abs(np.tan(alpha)), inf)
    factors[factors > 100] = inf
    assert np.allclose(held.friction.locking_factor, factors, rtol=1e-6)
    assert min(held.friction.locking_factor) == pytest.approx(0.75, rel=1e-12)  # tan(alpha) = 4/3 at 270 degrees
    assert {held.friction.locking_joint(row) for row in np.flatnonzero(expected)} == {3}
    text = held.message()
    assert "At the drive values 238°, 239°, " in text
    assert "self-locking" in text
    assert "mainly because of P(frame-slider)" in text
    assert "0.75 times as large (at 270°)" in text
    german = held.message("de")
    assert "selbsthemmend" in german
    assert "S(Gestell-Schieber)" in german or "S(frame-slider)" in german


@pytest.mark.parametrize(
    ("name", "degree", "backward"),
    [("garage_rail", -85, False), ("scottrussell", -85, False), ("scottrussell", 85, True)],
)
def test_isosceles_slider_cranks_lock_near_their_dead_centres(name, degree, backward):
    """a = b: alpha = phi, tan(85 deg) = 11.4, so they lock with mu 0.1 in these rows (of 52 of 5 degrees), in the sense
    in which the slider goes against its load; in the other sense there are two equilibria."""
    linkage = entry(name).linkage()
    slider = linkage.mechanism.chain.joint_names()[2]
    motion = move(linkage, np.radians([degree]))
    loads = Loads({slider: (-100, 0)})
    locked = statics(motion, loads, friction=Friction(0.1, backward=backward))
    free = statics(motion, loads, friction=Friction(0.1, backward=not backward))
    assert locked.locked.all()
    assert np.isnan(locked.drive).all()
    assert locked.friction.locking_factor == pytest.approx([1 / (0.1 * tan(radians(85)))], rel=1e-7)
    assert locked.friction.equilibria.tolist() == [0]
    assert free.friction.equilibria.tolist() == [2]
    assert not free.friction.proved.any()
    # N = F tan(alpha)/(1 + mu tan(alpha)) grows out of that without friction; the other is F tan/(mu tan - 1)
    steep = tan(radians(85))
    assert free.friction.normal[0, 0] == pytest.approx(100 * steep / (1 + 0.1 * steep), rel=1e-12)
    assert "more than one equilibrium" in free.message()
    assert "mehr als ein Gleichgewicht" in free.message("de")


@pytest.mark.parametrize("mu", [1e-300, 1e-12])
def test_hardly_any_friction_locks_nothing(mu):
    held = statics(move(SliderCrank(30, 50, 10).linkage(), [radians(270)]), PUSHED, friction=mu)
    assert held.friction.locking_factor.tolist() == [inf]
    assert held.drive == pytest.approx(held.friction.frictionless)


def test_without_a_load_nothing_locks():
    held = statics(move(SliderCrank(30, 50, 10).linkage(), [radians(270)]), Loads(moments={"crank": 5}), friction=1.0)
    assert held.drive == pytest.approx(np.array([[-5.0]]))
    assert not held.locked.any()


# --- wedges, pins, guides: by hand -----------------------------------------------------------------


def wedge(slope):
    """A wedge on the frame that lifts a follower in a vertical guide, by a pin in its slot of this slope."""
    mechanism = Mechanism.parse("P(0-1) G(1-2) P(0-2); frame=0; drive=P(0-1)")
    return Linkage.from_drawing(mechanism, {0: (0, 0, 0.0), 1: (30, 20, slope, "1"), 2: (30, 20, np.pi / 2)})


@pytest.mark.parametrize("slope", [10, 25, 50])
@pytest.mark.parametrize("mu", [0.05, 0.2, 0.3])
def test_wedge(slope, mu):
    """Textbook: three faces of the friction angle rho, force W tan(beta + 2 rho) to lift, W tan(beta - 2 rho) to lower;
    jams at beta + 2 rho = 90 degrees; below beta = 2 rho it does not come down by itself, and below beta = rho the
    follower leans on the other face of its guide, by hand W sin(beta - 2 rho)/cos(beta)."""
    linkage = wedge(-radians(slope))
    motion = move(linkage, np.array([-1.0, 0.0, 1.0]))
    beta, rho = radians(slope), atan(mu)
    loads = Loads({LinkPoint("2", 0, 0): (0, -100)})
    up, down = (statics(motion, loads, friction=Friction(mu, backward=backward)) for backward in (False, True))
    assert motion.displacement("P(0-2)")[2] > motion.displacement("P(0-2)")[0]
    assert up.drive[:, 0] == pytest.approx(np.full(3, 100 * tan(beta + 2 * rho)), rel=1e-12)
    lowered = tan(beta - 2 * rho) if beta > rho else -sin(2 * rho - beta) / cos(beta)
    assert down.drive[:, 0] == pytest.approx(np.full(3, 100 * lowered), rel=1e-12)
    assert up.friction.locking_factor == pytest.approx(np.full(3, tan((np.pi / 2 - beta) / 2) / mu), rel=1e-9)
    assert up.efficiency == pytest.approx(np.full(3, tan(beta) / tan(beta + 2 * rho)))
    assert down.efficiency == pytest.approx(np.full(3, max(lowered / tan(beta), 0.0)), abs=1e-12)


def test_a_wedge_jams():
    """Two of 25 degrees and rho = 35 degrees: 25 + 70 > 90."""
    motion = move(wedge(-radians(25)), [0.0])
    held = statics(motion, Loads({LinkPoint("2", 0, 0): (0, -100)}), friction=tan(radians(35)))
    assert held.locked.all()
    assert held.message().startswith("At the drive values 0 the linkage is self-locking")
    assert held.friction.equilibria.tolist() == [0]


@pytest.mark.parametrize("phi", [35, 100, 200, 310])
@pytest.mark.parametrize("backward", [False, True])
def test_friction_circles(phi, backward):
    """The force of the rod is tangent to the friction circles of its pins, on the side that resists the turning."""
    a, b, mu, radius = 25.0, 70.0, 0.3, {PINS[0]: 9.0, PINS[1]: 6.0, PINS[2]: 4.0}
    friction = Friction(dict.fromkeys(PINS, mu), pin_radius=radius, backward=backward)
    held = statics(move(SliderCrank(a, b).linkage(), [radians(phi)]), PUSHED, friction=friction)
    way = -1 if backward else 1
    alpha = np.arcsin(a * sin(radians(phi)) / b)  # the rod points to -alpha
    rod = way * -a * cos(radians(phi)) / (b * cos(alpha))  # its angular velocity
    crank_pin, crank = np.array([a * cos(radians(phi)), a * sin(radians(phi))]), float(way)
    piston_pin = crank_pin + b * np.array([cos(alpha), -sin(alpha)])
    # S u on the rod at the crank pin, -S u at the piston pin, moments -mu r S against its turning on both pins:
    # u is turned out of the rod's line by the angle whose sine is the sum of both circles by the length
    circles = -mu * (6.0 * np.sign(rod - crank) + 4.0 * np.sign(rod))
    tilt = -alpha + np.arcsin(circles / b)
    u, lever = np.array([cos(tilt), sin(tilt)]), crank_pin - piston_pin
    assert lever[0] * u[1] - lever[1] * u[0] + circles == pytest.approx(0, abs=1e-12)
    size = 100 / u[0]  # the piston: S cos(tilt) = F
    torque = (crank_pin[0] * u[1] - crank_pin[1] * u[0]) * size
    torque += size * mu * (9.0 * way + 6.0 * np.sign(crank - rod))
    assert held.drive[0, 0] == pytest.approx(torque, rel=1e-12)
    assert np.hypot(*held.force(PINS[2])[0]) == pytest.approx(size, rel=1e-12)
    assert abs(held.couple(PINS[0])[0]) == pytest.approx(mu * 9.0 * size, rel=1e-12)


def scotch_yoke(radius=20.0):
    """The crank pin in a slot of the yoke at right angles to its guide, which lies on the axis of the crank."""
    mechanism = Mechanism.parse("R(0-1) G(1-2) P(0-2); frame=0; drive=R(0-1)")
    return Linkage.from_drawing(mechanism, {0: (0, 0), 1: (radius, 0, np.pi / 2, "2"), 2: (radius, 0, 0.0)})


@pytest.mark.parametrize("mu", [0.1, 0.5, 0.8])
def test_drawer(mu):
    """A drawer of the guide length l pushed at the distance a from its middle needs F/(1 - 2 mu a/l): it jams where
    mu >= l/(2a). Here a = r sin(phi), as the crank pin of a Scotch yoke pushes beside the guide."""
    length, phi = 24.0, np.radians([210, 230, 250, 269])  # the yoke goes to the right, against its load
    motion = move(scotch_yoke(), phi)
    friction = Friction({"P(0-2)": mu}, guide_length=length)
    held = statics(motion, Loads({LinkPoint("2", 0, 0): (-100, 0)}), friction=friction)
    arm = np.abs(20 * np.sin(phi))
    jams = mu >= length / (2 * arm)
    expected = np.where(jams, np.nan, 100 / np.where(jams, 1, 1 - 2 * mu * arm / length) * arm)
    assert held.locked.tolist() == jams.tolist()
    assert held.drive[:, 0] == pytest.approx(expected, rel=1e-12, nan_ok=True)
    assert held.friction.locking_factor == pytest.approx(length / (2 * arm * mu), rel=1e-7)
    long = statics(motion, Loads({LinkPoint("2", 0, 0): (-100, 0)}), friction=Friction({"P(0-2)": mu}))
    assert long.drive[:, 0] == pytest.approx(100 * arm)  # a long guide takes the couple without friction


def by_edges(alpha, way, mu, length, height, offset, sleeve):
    """A slider under 100 N: rod force and both edge forces from three equations, by trying both faces of both edges.

    The edges lie at ±l/2 about a point ``offset`` before the slider's pin, each on the face that its force comes from,
    where its friction acts too.
    """
    found = []
    for signs in product((1, -1), repeat=2):
        rows = np.zeros((3, 3))
        rows[0, 0], rows[1, 0] = cos(alpha), -sin(alpha)
        for k, (sign, end) in enumerate(zip(signs, (1, -1), strict=True), 1):
            face = -sign * height / 2 * (-1 if sleeve else 1)
            at, friction = end * length / 2 - offset, -way * mu * sign  # of a normal force of one, upwards
            rows[0, k], rows[1, k], rows[2, k] = friction, 1, at * 1 - face * friction
        rod, *edges = np.linalg.solve(rows, [100, 0, 0])
        if all(sign * edge >= -1e-12 for sign, edge in zip(signs, edges, strict=True)):
            found.append((rod, abs(edges[0]) + abs(edges[1])))
    return found


@pytest.mark.parametrize("phi", [50, 140, 200, 260, 330])
@pytest.mark.parametrize(("on", "sleeve"), [("slider", False), ("frame", False), ("frame", True), ("slider", True)])
def test_two_edges(phi, on, sleeve):
    """Guides with two edges and two faces, moving with the slider or on the frame, against the edges one by one."""
    linkage = SliderCrank(25, 70, 10).linkage()
    motion = move(linkage, [radians(phi)], order=1)
    mu, length, height = 0.15, 60.0, 18.0
    friction = Friction(
        {SLIDE: mu},
        guide_length=length,
        guide_height=height,
        guide_on={SLIDE: on},
        sleeves=[SLIDE] if sleeve else [],
    )
    held = statics(motion, PUSHED, friction=friction)
    alpha = np.arcsin((25 * sin(radians(phi)) - 10) / 70)
    way = np.sign(motion.displacement(SLIDE, order=1)[0])
    offset = motion.displacement(SLIDE)[0] if on == "frame" else 0.0
    expected = by_edges(alpha, way, mu, length, height, offset, sleeve)
    assert len(expected) == 1
    rod, edges = expected[0]
    assert np.hypot(*held.force("R(coupler-slider)")[0]) == pytest.approx(abs(rod), rel=1e-12)
    assert held.friction.normal[0, 0] == pytest.approx(edges, rel=1e-12)


# --- any linkage, by another method ----------------------------------------------------------------


BASIC = ("four-bar", "slider-crank", "inverted", "six-bar", "cylinder")


def sense(motion, joint, shift=1e-6):
    """The signs of a joint's motion when the only drive goes forward, from differences of positions; (rows,)."""
    linkage = motion.linkage
    first, second = linkage.mechanism.chain.joints[joint].links
    near, far = linkage.elements[joint, first], linkage.elements[joint, second]
    angles, ways = [], []
    for sign in (1, -1):
        moved = move(linkage, motion.drives[:, 0] + sign * shift)
        angles.append(moved.angle(second) - moved.angle(first))
        gap = moved.complex_point(LinkPoint(second, far.x, far.y)) - moved.complex_point(
            LinkPoint(first, near.x, near.y)
        )
        line = moved.turns[:, moved.link_index(first)] * np.exp(1j * getattr(near, "angle", 0.0))
        ways.append((gap / line).real)
    later, sooner = ways if linkage.mechanism.chain.joints[joint].pair.is_sliding else angles
    return np.sign(later - sooner)


def put_back(motion, loads, friction, rounds):
    """Friction as a load of the statics without friction, until it stays: long slides and pins of two links."""
    linkage, chain = motion.linkage, motion.linkage.mechanism.chain
    senses = [sense(motion, number) * joint.pair.is_basic for number, joint in enumerate(chain.joints)]
    held = statics(motion, loads)
    for _ in range(rounds):
        forces, moments = dict(loads.forces), dict(loads.moments)
        for number, joint in enumerate(chain.joints):
            first, second = joint.links
            near, far = linkage.elements[number, first], linkage.elements[number, second]
            along = motion.turns[:, motion.link_index(first)] * np.exp(1j * getattr(near, "angle", 0.0))
            pressed = held.force(number, link=second) @ [1, 1j]
            size = np.abs((np.conj(along) * pressed).imag) if joint.pair.is_sliding else np.abs(pressed)
            rubbing = size * friction.coefficient * senses[number]
            for link, end, sign in ((second, far, -1), (first, near, 1)):
                if joint.pair.is_sliding:
                    force, point = sign * rubbing * along, LinkPoint(link, end.x, end.y)
                    forces[point] = forces.get(point, 0.0) + np.stack([force.real, force.imag], axis=1)
                else:
                    moments[link] = moments.get(link, 0.0) + sign * rubbing * friction.pin_radius
        held = statics(motion, Loads(forces, moments=moments))
    return held


@pytest.mark.parametrize("name", BASIC)
def test_friction_put_back_as_a_load(name):
    """Statics without friction, the friction of its own forces as a load, and so on: the same efforts and forces."""
    linkage, rows, one, _ = MOVING[name]
    motion = move(linkage, rows[::60])
    loads = Loads({"K": (30.0, -80.0)}, moments={one: 4.0 * linkage.size})
    friction = Friction(0.12, pin_radius=0.03 * linkage.size)
    held, rival = statics(motion, loads, friction=friction), put_back(motion, loads, friction, 80)
    assert np.allclose(held.drive, rival.drive, rtol=1e-9)
    assert np.abs(held.drive - held.friction.frictionless).min() > 1e-3 * np.abs(held.drive).max()
    assert held.friction.proved.all()
    for contact in held.friction.contacts:
        if not contact.slides:
            both = (statics_.force(contact.joint, link=contact.link) for statics_ in (held, rival))
            assert np.allclose(*both, rtol=1e-8, atol=1e-8)


def free_bodies(held, loads, point, moment_on):
    """The largest force and moment that is left on any moving link, about an arbitrary point."""
    motion, about = held.motion, 0.3 - 1.7j
    linkage, chain = motion.linkage, motion.linkage.mechanism.chain
    left = []
    for link in set(chain.links) - {linkage.mechanism.frame}:
        force, moment = np.zeros(len(motion), complex), np.zeros(len(motion))
        for number, joint in enumerate(chain.joints):
            if link not in joint.links:
                continue
            later = joint.links[1] if joint.pair.is_sliding else link
            end = linkage.element(number, later)
            at = motion.complex_point(LinkPoint(later, end.x, end.y))
            mine = held.force(number, link=link) @ [1, 1j]
            for k, drive in enumerate(linkage.mechanism.drives):
                sign = -1 if link == linkage.reference(k)[0] else 1
                if drive.joint == number and joint.pair.is_sliding:
                    line = linkage.element(number, linkage.reference(k)[0])
                    along = motion.turns[:, motion.link_index(linkage.reference(k)[0])] * np.exp(1j * line.angle)
                    mine = mine + sign * held.drive[:, k] * along
                elif drive.joint == number and link in linkage.reference(k):
                    moment += sign * held.drive[:, k]
            force += mine
            moment += (np.conj(at - about) * mine).imag + held.couple(number, link=link)
        if link == linkage.points_named(point)[-1].link:
            load = complex(*loads.forces[point])
            force += load
            moment += (np.conj(motion.complex_point(point) - about) * load).imag
        moment += loads.moments[moment_on] * (link == moment_on)
        left += [np.abs(force).max(), np.abs(moment).max() / linkage.size]
    return max(left)


@pytest.mark.parametrize("name", BASIC)
@pytest.mark.parametrize("backward", [False, True])
def test_every_link_is_in_equilibrium_and_power_adds_up(name, backward):
    """With guides of two edges and two faces: free bodies; drive, loads and friction together do no work."""
    linkage, rows, one, _ = MOVING[name]
    motion = move(linkage, rows[::60], speed=1.7)
    size = linkage.size
    loads = Loads({"K": (30.0, -80.0)}, moments={one: 4.0 * size})
    friction = Friction(
        0.15, pin_radius=0.03 * size, guide_length=0.4 * size, guide_height=0.2 * size, backward=backward
    )
    held = statics(motion, loads, friction=friction)
    assert free_bodies(held, loads, "K", one) < 1e-9 * 100
    assert held.disagreement < 1e-12
    way = -1.7 if backward else 1.7
    given = motion.point("K", order=1) @ [30.0, -80.0] + loads.moments[one] * motion.angular(one)
    lost = held.drive[:, 0] * way + given * np.sign(way)
    rates = np.abs(held.friction.rates[..., 0] * 1.7)
    coefficient = [0.15 * (1 if c.slides else 0.03 * size) for c in held.friction.contacts]
    assert np.allclose(lost, (rates * coefficient * held.friction.normal).sum(axis=1), rtol=1e-9)
    assert (lost > 0).all()


# --- laws ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", BASIC)
@given(mu=st.floats(1e-3, 1.0), fx=st.floats(-100, 100), fy=st.floats(-100, 100), radius=st.floats(0.0, 0.1))
@settings(max_examples=4, deadline=None)
def test_efficiency_and_sense(name, mu, fx, fy, radius):
    """Between 0 and 1; friction costs the drive power in both senses, and its sign is that of the sense."""
    linkage, rows, _, _ = MOVING[name]
    motion = move(linkage, rows[::60])
    loads = Loads({"K": (fx, fy)})
    forward, backward = (
        statics(motion, loads, friction=Friction(mu, pin_radius=radius * linkage.size, backward=way))
        for way in (False, True)
    )
    noise = 1e-9 * linkage.size * 100
    for held, way in ((forward, 1), (backward, -1)):
        known = ~held.locked
        assert (way * held.friction.effort[known] >= -noise).all()
        assert np.isnan(held.drive[~known]).all()
        assert np.isfinite(held.drive[known]).all()
        efficiency = held.efficiency[np.isfinite(held.efficiency)]
        assert ((efficiency >= 0) & (efficiency <= 1 + 1e-12)).all()
    assert np.array_equal(forward.friction.directions, -backward.friction.directions)


@pytest.mark.parametrize("name", BASIC)
def test_less_and_less_friction_is_none(name):
    """The efforts differ from those without friction by a part of mu, the slope the friction of the free forces."""
    linkage, rows, _, _ = MOVING[name]
    motion = move(linkage, rows[::60])
    loads = Loads({"K": (30.0, -80.0)})
    free = statics(motion, loads)
    off = []
    for mu in (1e-3, 1e-4, 1e-5):
        held = statics(motion, loads, friction=Friction(mu, pin_radius=0.05 * linkage.size))
        pressed = held.friction.normal * [1 if c.slides else 0.05 * linkage.size for c in held.friction.contacts]
        slope = (pressed * np.abs(held.friction.rates[..., 0])).sum(axis=1)
        off.append(np.abs(held.drive - free.drive).max() / mu)
        assert np.allclose((held.drive - free.drive)[:, 0], mu * slope, rtol=1e-6)
    assert off[1] == pytest.approx(off[2], rel=1e-2)
    none = statics(motion, loads, friction=Friction(0.0, pin_radius=5))
    assert np.array_equal(none.drive, free.drive)
    assert "Nothing rubs" in none.message()


@given(scale=st.floats(0.01, 100), turn=st.floats(-4, 4), mirrored=st.booleans(), mu=st.floats(0.05, 0.5))
@settings(max_examples=8, deadline=None)
def test_scale_rotation_mirror(scale, turn, mirrored, mu):
    """Of a crosshead with a cylinder: the same force of the drive, the same safety, moments times the scale."""
    mechanism = Mechanism.parse("R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)")
    places = {"R(0-1)": 0j, "R(4-2)": 3 + 2j, "R(0-4)": 4 + 0j}

    def held(factor, conjugated):
        def put(z):
            return factor * (np.conj(z) if conjugated else z)

        drawn = {name: (put(z).real, put(z).imag) for name, z in places.items()}
        linkage = Linkage.from_drawing(
            mechanism,
            {**drawn, "P(1-2)": (0, 0, float(np.angle(put(3 + 2j))))},
            points={"K": ("4", put(2 + 3j).real, put(2 + 3j).imag)},
        )
        force = put(30 - 80j) / abs(factor)
        friction = Friction(
            mu, pin_radius=0.2 * abs(factor), guide_length=2 * abs(factor), guide_height=0.5 * abs(factor)
        )
        motion = move(linkage, abs(factor) * np.array([3.1, 3.4]))
        return statics(motion, Loads({"K": (force.real, force.imag)}), friction=friction)

    one, other = held(1 + 0j, False), held(scale * np.exp(1j * turn), mirrored)
    assert np.array_equal(one.locked, other.locked)
    assert np.allclose(one.drive, other.drive, rtol=1e-8, equal_nan=True)
    assert np.allclose(one.friction.locking_factor, other.friction.locking_factor, rtol=1e-5)
    lengths = [1 if contact.slides else scale for contact in one.friction.contacts]
    assert np.allclose(one.friction.friction * lengths, other.friction.friction, rtol=1e-8, equal_nan=True)


# --- continuation against all linear pieces ---------------------------------------------------------


def all_equilibria(loads, mutual):
    """Oracle: of slides with edges, by trying every linear piece of every contact."""
    count, found = len(loads), []
    pieces = [np.array(p) for p in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    for chosen in product(pieces, repeat=count):
        matrix = np.eye(count) - np.array([[p @ mutual[i, j] for j in range(count)] for i, p in enumerate(chosen)])
        normal = np.linalg.solve(matrix, [p @ loads[i] for i, p in enumerate(chosen)])
        inside = loads + np.einsum("ijk,j->ik", mutual, normal)
        balanced = np.allclose(np.abs(inside).max(axis=1), normal, rtol=0, atol=1e-9 * np.abs(normal).max())
        if balanced and all(np.abs(normal - other).max() > 1e-7 * np.abs(normal).max() for other in found):
            found.append(normal)
    return found


def long_slides(loads, mutual):
    shapes = {"leaning": np.zeros((1, 2)), "round": np.zeros(2, bool), "rubs": np.ones(2, bool)}
    return Contacts(loads=loads[None], mutual=mutual[None], **shapes)


@pytest.mark.parametrize("seed", range(30))
def test_continuation_against_all_pieces(seed):
    """The equilibria at factor 1 are all; the branch is followed by small steps among all, to where it ends."""
    draws = np.random.default_rng(seed)
    loads, mutual = draws.normal(size=(2, 2)), draws.normal(size=(2, 2, 2)) * 0.8
    contacts = long_slides(loads, mutual)
    found = continued(contacts, 8.0)
    assert found.equilibria[0] == len(all_equilibria(loads, mutual))
    assert not found.single[0] or found.equilibria[0] == 1
    branch, end, at_one, step = np.abs(loads).max(axis=1), inf, None, 1 / 64
    for k in range(1, 8 * 64 + 1):
        choices = all_equilibria(loads, mutual * k * step)
        gaps = [np.abs(choice - branch).max() / max(np.abs(branch).max(), np.abs(choice).max()) for choice in choices]
        if not gaps or min(gaps) > 0.3:
            end = k * step
            break
        branch = choices[int(np.argmin(gaps))]
        at_one = branch if k == 64 else at_one
    assert found.factor[0] == pytest.approx(end, abs=4 * step)
    assert np.isnan(found.normal[0]).all() == (found.factor[0] <= 1)
    assert np.allclose(found.normal[0], np.nan if at_one is None else at_one, rtol=1e-8, equal_nan=True)


@pytest.mark.parametrize(
    ("seed", "count", "number", "end", "step", "gap"),
    [
        (7, 2000, 434, 1.636, 1e-3, 0.02),
        (7, 2000, 947, 0.838, 1e-3, 0.02),
        (7, 2000, 1110, 1.923, 1e-3, 0.02),
        (11, 3000, 1268, 1.8243, 1e-4, 1e-3),  # needs the sign of the determinant
        (11, 3000, 1048, 1.3464, 1e-3, 0.5),  # a pole; needs the limit of a step's growth
    ],
)
def test_the_way_does_not_leave_its_branch(seed, count, number, end, step, gap):
    """Ends that another branch passes nearby, found among random systems. Oracle: small steps among all equilibria, to
    where none lies within a gap that is small against the distance of the branches."""
    draws = np.random.default_rng(seed)
    loads = draws.normal(size=(count, 2, 2))[number]
    mutual = (draws.normal(size=(count, 2, 2, 2)) * 0.8)[number]
    found = continued(long_slides(loads, mutual), 8.0)
    last = end - 100 * step
    start = long_slides(loads, mutual * last)
    branch = continued(start, 2.0).normal[0]
    while last < 8:
        choices = all_equilibria(loads, mutual * (last + step))
        gaps = [np.abs(choice - branch).max() / np.abs(branch).max() for choice in choices]
        if min(gaps) > gap:
            break
        branch, last = choices[int(np.argmin(gaps))], last + step
    assert last == pytest.approx(end, abs=4 * step)
    assert found.factor[0] == pytest.approx(end, abs=4 * step)


@pytest.mark.parametrize("phi", [240, 270, 315, 345])
@pytest.mark.parametrize("radius", [3.0, 30.0])
def test_the_joint_named_is_the_one_that_matters_most(phi, radius):
    """By differences: a hundredth more of which coefficient lowers the factor most."""
    names = SLIDER_CRANK.mechanism.chain.joint_names()
    motion = move(SliderCrank(30, 50, 10).linkage(), [radians(phi)])

    def factor(more=""):
        mu = {name: 0.3 * (1.01 if name == more else 1.0) for name in names}
        found = statics(motion, PUSHED, friction=Friction(mu, pin_radius=radius)).friction
        return found.locking_factor[0], found.locking_joint(0)

    plain, named = factor()
    falls = [plain - factor(name)[0] for name in names]
    assert max(falls) > 1e-4 * plain
    assert falls[named] == pytest.approx(max(falls), rel=1e-2)


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.1])
def test_rounding_locks_nothing(turn):
    """Two opposite forces at the rod ends press nothing else but by rounding, where a pressed slide locks."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) P(0-3); frame=0; drive=R(0-1)")
    places = np.array([0, 30 * np.exp(-1.4j), 45 + 10j]) * np.exp(1j * turn) + (3.3 - 1.7j)
    drawn = {k: (z.real, z.imag) for k, z in enumerate(places)}
    linkage = Linkage.from_drawing(mechanism, {**drawn, 3: (*drawn[2], turn)})
    motion = move(linkage, -1.4 + turn + np.linspace(-0.3, 0.3, 7))
    pressed = statics(motion, Loads({"R(2-3)": tuple(-100 * np.array([cos(turn), sin(turn)]))}), friction=1.2)
    ends = [LinkPoint("2", *(getattr(linkage.elements[k, "2"], axis) for axis in "xy")) for k in (1, 2)]
    along = motion.complex_point(ends[1]) - motion.complex_point(ends[0])
    pull = 1000 * np.stack([along.real, along.imag], axis=1) / np.abs(along)[:, None]
    held = statics(
        motion, Loads({ends[0]: pull, ends[1]: -pull}), friction=Friction(1.2, guide_length=10, pin_radius=4)
    )
    assert pressed.locked.any()
    assert not held.locked.any()
    pins = [contact.joint in (0, 3) for contact in held.friction.contacts]  # the others carry the forces
    assert not held.friction.normal[:, pins].any()


# --- kinds of joints, wrong calls ------------------------------------------------------------------


def test_a_joint_of_three_links_has_two_pins():
    motion = move(FORKED, from_degrees(90, 130, 10))
    loads = Loads({"R(2-4)": (0, -50), "R(3-5)": (0, -20)})
    held = statics(motion, loads, friction=Friction({"R(1-2-3)": 0.2}, pin_radius=0.5))
    assert [(contact.joint, contact.link) for contact in held.friction.contacts] == [(1, "2"), (1, "3")]
    pressed = [np.hypot(*held.force("R(1-2-3)", link=link).T) for link in "23"]
    assert np.allclose(held.friction.friction, 0.2 * 0.5 * np.stack(pressed, axis=1))
    assert held.disagreement < 1e-13


def test_a_block_in_a_guide():
    """The inverted slider-crank: the normal force is what friction acts on, and the pin of its block rubs too."""
    guide = InvertedSliderCrank(25, 60).linkage()
    chain = guide.mechanism.chain
    number = next(k for k, joint in enumerate(chain.joints) if joint.pair.is_sliding)
    motion, loads = move(guide, [0.7, 0.9]), Loads(moments={chain.links[-1]: 100})
    held = statics(motion, loads, friction=0.3)
    line = motion.turns[:, motion.link_index(chain.joints[number].links[0])]
    force = held.force(number) @ [1, 1j]
    along, across = (np.conj(line) * force).real, (np.conj(line) * force).imag
    assert np.allclose(np.abs(along), 0.3 * np.abs(across), rtol=1e-12)
    assert np.allclose(held.friction.friction[:, 0], np.abs(along))


def test_two_drives_need_speeds():
    loads, friction = Loads({"K": (1, -2)}, moments={"3": 0.5}), Friction(0.2, pin_radius=0.3)
    rows = np.array([[np.pi / 2, np.pi / 2], [1.6, 1.5]])
    with pytest.raises(LinkageError, match="with 2 drives the direction of friction depends on their speeds"):
        statics(move(FIVE_BAR, rows), loads, friction=friction)
    motion = move(FIVE_BAR, rows, speed=(1.0, -0.4), order=1)
    held = statics(motion, loads, friction=friction)
    assert held.disagreement < 1e-13
    power = held.drive @ [1.0, -0.4] + motion.point("K", order=1) @ [1, -2] + 0.5 * motion.angular("3")
    turning = [motion.angular(b) - motion.angular(a) for a, b in ("01", "12", "23", "34", "04")]
    assert np.allclose(power, (held.friction.friction * np.abs(np.stack(turning, axis=1))).sum(axis=1))
    with pytest.raises(LinkageError, match="efficiency is that of one drive"):
        _ = held.efficiency


def test_a_driven_slide_rubs():
    """The slider itself is driven against a torque on the crank: its force grows by its own friction too."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) P(0-3); frame=0; drive=P(0-3)")
    engine = Linkage.from_drawing(mechanism, {0: (0, 0), 1: (0, 20), 2: (45, 0), 3: (45, 0, 0.0)})
    motion = move(engine, [0.0], order=1)
    held = statics(motion, Loads(moments={"1": 100.0}), friction=Friction({"P(0-3)": 0.25}))
    rod = np.hypot(*held.force("R(2-3)")[0])
    assert held.friction.normal[0, 0] == pytest.approx(rod * 20 / hypot(45, 20), rel=1e-12)
    assert held.drive[0, 0] - held.friction.frictionless[0, 0] == pytest.approx(0.25 * held.friction.normal[0, 0])


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_the_motion_says_in_which_sense(speed):
    size, phi = SliderCrank(20, 50), np.radians([60.0])
    held = statics(move(size.linkage(), phi, speed=speed), PUSHED, friction=0.3)
    other = statics(move(size.linkage(), phi), PUSHED, friction=Friction(0.3, backward=speed < 0))
    assert held.drive == pytest.approx(other.drive, rel=1e-14)


def test_in_a_dead_centre_the_slide_has_no_direction():
    held = statics(move(SliderCrank(20, 50).linkage(), [0.0, np.pi]), PUSHED, friction=Friction(0.3, pin_radius=4))
    slide = [contact.slides for contact in held.friction.contacts].index(True)
    assert held.friction.directions[:, slide].tolist() == [0, 0]
    assert not held.friction.friction[:, slide].any()
    assert (held.friction.effort > 0).all()


def test_where_links_are_not_held_nothing_is_known():
    motion = move(FourBar(25, 70, 25, 70).linkage(), np.radians([10, 0, -10]), branch="+")
    held = statics(motion, Loads(moments={"rocker": -5}), friction=Friction(0.1, pin_radius=2))
    assert np.isnan(held.drive[:, 0]).tolist() == [False, True, False]
    assert not held.locked.any()
    assert "not determined" in held.message()
    assert "self-locking" not in held.message()


def test_friction_in_the_middle_of_many_rows():
    linkage, rows = SliderCrank(20, 50).linkage(), np.linspace(0, 6, 5000)
    whole = statics(move(linkage, rows), PUSHED, friction=0.1)
    part = statics(move(linkage, rows[2040:2060]), PUSHED, friction=0.1)
    assert np.allclose(whole.drive[2040:2060], part.drive, rtol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Friction(-0.1), "coefficient is not negative, but found -0.1"),
        (lambda: Friction({SLIDE: -0.1}), "coefficient is not negative, but found -0.1"),
        (lambda: Friction(float("nan")), "coefficient must be a finite number"),
        (lambda: Friction("much"), "coefficient must be a finite number, not 'much'"),
        (lambda: Friction(1e300), "a coefficient of friction is 100 at most, but found 1e\\+300"),
        (lambda: Friction(0.1, pin_radius=1e300), "pin_radius = 1e\\+300 is out of all proportion to the linkage"),
        (lambda: Friction(0.1, guide_length={SLIDE: 1e-300}), "guide_length = 1e-300 is out of all proportion"),
        (lambda: Friction(0.1, pin_radius=-1), "pin_radius is not negative, but found -1"),
        (lambda: Friction(0.1, guide_length=0), "guide_length is positive, but found 0"),
        (lambda: Friction(0.1, guide_length=-3), "guide_length is not negative, but found -3"),
        (lambda: Friction(0.1, guide_height=inf), "guide_height must be a finite number"),
        (lambda: Friction({"P(frame-slidder)": 0.1}), "did you mean 'P\\(frame-slider\\)'"),
        (lambda: Friction(0.1, pin_radius={SLIDE: 3}), r"pin_radius: P\(frame-slider\) does not turn on a pin"),
        (lambda: Friction(0.1, guide_length={PINS[0]: 3}), r"guide_length: R\(frame-crank\) does not slide"),
        (lambda: Friction(0.1, guide_on={SLIDE: "crank"}), r"P\(frame-slider\) is not a joint of 'crank'"),
        (lambda: Friction(0.1, guide_on={PINS[0]: "crank"}), "is not a slide of two links"),
        (lambda: Friction(0.1, sleeves=[PINS[0]]), "is not a slide of two links"),
    ],
)
def test_wrong_friction(make, message):
    with pytest.raises(LinkageError, match=message):
        statics(move(SLIDER_CRANK, [0.5]), PUSHED, friction=make())


def test_wrong_calls():
    with pytest.raises(LinkageError, match="stands still in row 1"):
        statics(move(SLIDER_CRANK, [0.5, 0.6], speed=[1.0, 0.0]), PUSHED, friction=0.1)


def test_all_others_have_a_star():
    held = statics(
        move(SLIDER_CRANK, [0.5]), PUSHED, friction=Friction({"*": 0.1, SLIDE: 0.2}, pin_radius={PINS[1]: 3})
    )
    assert [(c.joint, c.coefficient, c.radius) for c in held.friction.contacts] == [(1, 0.1, 3.0), (3, 0.2, 0.0)]
