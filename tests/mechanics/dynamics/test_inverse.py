"""Inverse dynamics: two methods, closed forms by hand, the energy, the whole linkage as one free body."""

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.dynamics import inverse_dynamics, reduced_equations
from gruebler.mechanics.forces import Loads, RigidBody, Spring
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

ANGLES = np.linspace(0, 2 * np.pi, 73)
ROUNDING = 1e-10


def bodies_of(linkage, seed=0):
    """Some mass for each link that moves."""
    dice = np.random.default_rng(seed)
    links = [link for link in linkage.mechanism.chain.links if link != linkage.mechanism.frame]
    size = linkage.size
    return {
        link: RigidBody(*dice.uniform(0.5, 2, 1), tuple(dice.uniform(-0.3, 0.5, 2) * size), dice.uniform(0, size**2))
        for link in links
    }


def five_bar():
    chain = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4)")
    mechanism = Mechanism(chain, "0", ["R(0-1)", "R(0-4)"])
    places = {"R(0-1)": (0, 0), "R(1-2)": (-10, 40), "R(2-3)": (30, 80), "R(3-4)": (70, 45), "R(0-4)": (60, 0)}
    return Linkage.from_drawing(mechanism, places)


def test_a_drive_behind_pins_in_slots():
    """Blocks stand for such pins when the linkage is solved, so that its drive is another joint there."""
    linkage = entry("scissor2_cyl").linkage()
    motion = move(linkage, np.linspace(25, 60, 8), speed=30.0)
    assert inverse_dynamics(motion, Loads(bodies=bodies_of(linkage))).disagreement < ROUNDING


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "wiper", "five-bar"])
def test_two_methods_agree(name):
    linkage = {
        "four-bar": lambda: FourBar(25, 70, 40, 70).linkage(),
        "slider-crank": lambda: SliderCrank(30, 90, 8).linkage(),
        "wiper": lambda: entry("wiper").linkage(),
        "five-bar": five_bar,
    }[name]()
    if len(linkage.mechanism.drives) == 2:
        pose = linkage.required_pose
        start = np.array([pose["1"].angle - pose["0"].angle, pose["4"].angle - pose["0"].angle])
        time = np.linspace(0, 1, 20)[:, None]
        q, v, a = start + 0.2 * np.sin(time * [1, 2]), 0.2 * np.cos(time * [1, 2]) * [1, 2], 0.3 * np.sin(time * [3, 1])
        motion = move(linkage, q, speed=v, acceleration=a)
    else:
        motion = move(linkage, ANGLES, speed=20.0, acceleration=-35.0)
    assert motion.complete
    link = linkage.mechanism.chain.links[2]
    run = inverse_dynamics(motion, Loads(moments={link: "3*omega"}, bodies=bodies_of(linkage)))
    assert np.isfinite(run.drive).all()
    assert run.disagreement < ROUNDING
    reduced, q2 = run.equations, motion.speeds[1]
    effort = np.einsum("rfg,rg->rf", reduced.mass, q2) + reduced.bias - reduced.force
    np.testing.assert_allclose(run.motion_effort, effort, atol=ROUNDING * np.abs(effort).max())


def test_the_foundation_feels_the_shaking_force_and_the_loads():
    """All links as one free body: what the frame's joints exert holds weights, forces of inertia and the load."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (30, 20)})
    motion = move(linkage, ANGLES, speed=20.0, acceleration=5.0)
    bodies = bodies_of(linkage)
    run = inverse_dynamics(motion, Loads(forces={"K": (3, -7)}, bodies=bodies))
    weight = sum(body.mass for body in bodies.values()) * 9.80665
    exerted = run.statics.force("R(frame-crank)") + run.statics.force("R(frame-rocker)")
    left = exerted + run.shaking_force + (3, -7) + (0, -weight)
    assert np.abs(left).max() < ROUNDING * np.abs(exerted).max()
    tips = [motion.complex_point((link, *body.centre), order=2) * body.mass for link, body in bodies.items()]
    wanted = -sum(tips) * 1e-3  # mm/s2 to m/s2
    np.testing.assert_allclose(run.shaking_force @ [1, 1j], wanted, rtol=1e-12)


def test_the_work_of_the_drive_is_the_change_of_energy():
    """Simpson's rule over a smooth power, without loads that lose energy."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (30, 20)})
    loads = Loads(bodies=bodies_of(linkage), springs=(Spring(("frame:20,90", "K"), stiffness=0.2, free_length=30),))
    q = np.linspace(0.3, 2.3, 401)
    motion = move(linkage, q, speed=8.0 + 3 * np.sin(q), acceleration=3 * np.cos(q) * (8 + 3 * np.sin(q)))
    run = inverse_dynamics(motion, loads)
    energy = run.equations.kinetic + run.equations.potential
    weights = np.ones(401)
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    work = (weights * run.drive[:, 0]).sum() * (q[1] - q[0]) / 3
    assert work == pytest.approx(energy[-1] - energy[0], rel=1e-8)


def test_piston_and_crank_of_an_engine():
    """By hand, exact: x = r cos q + sqrt(l² - r² sin² q), F = - m x'' and the torque F dx/dq, at constant speed."""
    r, rod, w, m = 40.0, 140.0, 300.0, 0.6
    run = inverse_dynamics(
        move(SliderCrank(r, rod), ANGLES, speed=w), Loads(bodies={"slider": RigidBody(m)}, gravity=(0, 0))
    )
    c, s = np.cos(ANGLES), np.sin(ANGLES)
    root = np.sqrt(rod**2 - r**2 * s**2)
    slope = -r * s - r**2 * s * c / root
    bend = -r * c - r**2 * (c**2 - s**2) / root - r**4 * s**2 * c**2 / root**3
    torque = m * w**2 * bend * slope * 1e-3
    np.testing.assert_allclose(run.drive[:, 0], torque, atol=1e-11 * np.abs(torque).max())
    assert run.peak == pytest.approx(np.abs(torque).max())
    assert run.root_mean_square == pytest.approx(np.sqrt((torque[:-1] ** 2).mean()))  # the last row is the first


def test_the_effective_effort_is_a_mean_over_time():
    """By hand: a wheel with J = 300 kg mm² starts with 2 rad/s², 0.6 N mm for 1 s, then turns without effort.

    A closed turn of a weight of 1 kg at 10 mm under 10 m/s²: 100 N mm times cos q, so 100 / sqrt 2 for any even rows.
    """
    motion = move(
        FourBar(25, 70, 40, 70), [0.0, 1.0, 3.0, 5.0], speed=[0.0, 2.0, 2.0, 2.0], acceleration=[2.0, 2.0, 0, 0]
    )
    wheel = inverse_dynamics(motion, Loads(bodies={"crank": RigidBody(0.0, (0, 0), 300)}, gravity=(0, 0)))
    # rows at 0, 1, 2, 3 s, so half, one, one, half a second: 0.6 N mm in the first two of the four
    assert wheel.root_mean_square == pytest.approx(0.6 * np.sqrt(1.5 / 3), rel=1e-12)
    assert wheel.mean_power == pytest.approx(0.6 * 2 / 3, rel=1e-12)  # at 2 rad/s in the row at 1 s, at rest before
    for rows in (5, 13):
        motion = move(FourBar(25, 70, 40, 70), np.linspace(0, 2 * np.pi, rows), speed=3.0)
        weight = inverse_dynamics(motion, Loads(bodies={"crank": RigidBody(1.0, (10, 0))}, gravity=(0, -10)))
        assert weight.root_mean_square == pytest.approx(100 / np.sqrt(2), rel=1e-10)
        assert weight.mean_power == pytest.approx(0, abs=1e-10)  # what goes up comes down
        brake = inverse_dynamics(motion, Loads(moments={"crank": -7.0}))
        assert brake.mean_power == pytest.approx(7.0 * 3.0, rel=1e-12)


def test_a_crank_alone_shakes_with_m_r_w2():
    motion = move(FourBar(25, 70, 40, 70), ANGLES, speed=50.0)
    run = inverse_dynamics(motion, Loads(bodies={"crank": RigidBody(2.0, (10, 0), 300)}, gravity=(0, 0)))
    np.testing.assert_allclose(np.hypot(*run.shaking_force.T), 2 * 0.010 * 50**2, rtol=1e-12)
    np.testing.assert_allclose(run.shaking_moment(), 0, atol=1e-9)
    np.testing.assert_allclose(run.drive, 0, atol=1e-9)
    np.testing.assert_allclose(reduced_equations(motion, Loads()).mass, 0)


def test_forces_of_inertia_need_accelerations():
    with pytest.raises(LinkageError, match="solved up to order 0; for order 2"):
        inverse_dynamics(move(FourBar(25, 70, 40, 70), ANGLES), Loads())


def test_a_run_has_a_table_and_says_its_largest_effort():
    """A piston of 2 kg at r/l = 0.6 and 100 rad/s; at 30° by hand: M = m x'' x', as in tests/cli/test_dynamics.py."""
    motion = move(SliderCrank(30, 50).linkage(), np.radians([0.0, 30.0]), speed=100.0)
    run = inverse_dynamics(motion, Loads(bodies={"slider": RigidBody(2.0)}))
    q = np.radians(30)
    root = np.sqrt(2500 - 900 * np.sin(q) ** 2)
    first = -30 * np.sin(q) - 450 * np.sin(2 * q) / root
    second = -30 * np.cos(q) - 900 * np.cos(2 * q) / root - 450**2 * np.sin(2 * q) ** 2 / root**3
    torque = 2 * 100**2 * first * second / 1000
    assert run.table()["torque R(frame-crank)"][1] == pytest.approx(torque, rel=1e-12)
    frame = run.to_dataframe()
    assert frame["power R(frame-crank) [W]"][1] == pytest.approx(torque * 100 / 1000, rel=1e-12)
    assert f"Largest effort: torque R(frame-crank) = {torque:.0f} N·mm at R(frame-crank) = 30°" in str(run)
    assert "Größtwert: Antriebsmoment D(frame-crank)" in run.explain("de")
