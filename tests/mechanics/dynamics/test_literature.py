"""Worked examples of a textbook, to their printed digits.

R. S. Khurmi, J. K. Gupta, *Theory of Machines*; data and printed results as in the companion of FOSSEE (IIT Bombay),
github.com/FOSSEE/Python-Textbook-Companions, folder Theory_Of_Machines, chapters 15 and 16. The book takes the piston's
acceleration as r w² (cos q + cos 2q / n), n = l/r. What that neglects is put back by hand (`of_exact`).
"""

import numpy as np
import pytest

from gruebler.mechanics.dynamics import equilibria, flywheel, inverse_dynamics
from gruebler.mechanics.forces import Loads, RigidBody
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move

PISTON, GUIDE, MAIN = "R(coupler-slider)", "P(frame-slider)", "R(frame-crank)"


def engine(*, r, rod, rpm, degrees, push, bodies, gravity=(0.0, 0.0)):
    """Lengths in metres; gas pushes the piston toward the shaft, angles count from the inner dead centre."""
    linkage = SliderCrank(r, rod).linkage(unit="m")
    motion = move(linkage, np.radians([degrees]), speed=rpm * np.pi / 30)
    return inverse_dynamics(motion, Loads(forces={PISTON: (-push, 0.0)}, bodies=bodies, gravity=gravity))


def of_exact(printed, *, n, degrees, inertia, force):
    """What is proportional to the force on the piston: printed for `force`, corrected for m r w² = `inertia`."""
    q = np.radians(degrees)
    exact = (n**2 * np.cos(2 * q) + np.sin(q) ** 4) / (n**2 - np.sin(q) ** 2) ** 1.5
    return printed * (1 - inertia * (exact - np.cos(2 * q) / n) / force)


def along_and_across_the_crank(force, degrees):
    return np.conj(np.exp(1j * np.radians(degrees))) * (force @ [1, 1j])[0]


def test_horizontal_steam_engine():
    """Example 15.7: 10.97 kN on the slide bars, 50.65 kN in the rod, 48.30 kN at the crank pin, 14.491 kN m."""
    push = 0.35e6 * np.pi / 4 * 0.5**2
    run = engine(r=0.3, rod=1.2, rpm=250, degrees=60, push=push, bodies={"slider": RigidBody(250.0)})
    inertia = 250 * 0.3 * (250 * np.pi / 30) ** 2
    terms = {"n": 4, "degrees": 60, "inertia": inertia, "force": push - inertia * (0.5 - 0.125)}
    across = along_and_across_the_crank(run.statics.force("R(crank-coupler)"), 60).imag
    assert abs(run.statics.force(GUIDE)[0, 1]) == pytest.approx(of_exact(10.97e3, **terms), abs=5)
    assert np.hypot(*run.statics.force(PISTON)[0]) == pytest.approx(of_exact(50.65e3, **terms), abs=5)
    assert abs(across) == pytest.approx(of_exact(48.30e3, **terms), abs=5)
    assert run.drive[0, 0] == pytest.approx(of_exact(-14.491e3, **terms), abs=0.5)


def test_vertical_petrol_engine():
    """Example 15.11: with the weight of the piston 2255.6 N on it and 185.4 N on the cylinder wall."""
    push = 700e3 * np.pi / 4 * 0.1**2
    bodies = {"slider": RigidBody(1.1)}
    run = engine(r=0.06, rod=0.25, rpm=2000, degrees=20, push=push, bodies=bodies, gravity=(-9.81, 0.0))
    terms = {"n": 25 / 6, "degrees": 20, "inertia": 1.1 * 0.06 * (2000 * np.pi / 30) ** 2, "force": 2255.6}
    assert abs(run.statics.force(PISTON)[0, 0]) == pytest.approx(of_exact(2255.6, **terms), abs=0.5)
    wall = 185.4 * np.tan(np.arcsin(np.sin(np.radians(20)) * 6 / 25)) / np.tan(np.radians(4.7))  # rounded in the book
    assert abs(run.statics.force(GUIDE)[0, 1]) == pytest.approx(of_exact(wall, **terms), abs=0.1)


def test_double_acting_engine():
    """Example 15.12: turning moment 3929.0 N m, thrust on the main bearing along the crank 11.98 kN."""
    area, rod = np.pi / 4 * 0.25**2, np.pi / 4 * 0.05**2
    push = 550e3 * area - 70e3 * (area - rod)
    run = engine(r=0.2, rod=0.6, rpm=120, degrees=45, push=push, bodies={"slider": RigidBody(60.0)})
    inertia = 60 * 0.2 * (120 * np.pi / 30) ** 2
    terms = {"n": 3, "degrees": 45, "inertia": inertia, "force": push - inertia * np.sqrt(0.5)}
    assert run.drive[0, 0] == pytest.approx(of_exact(-3929.03, **terms), abs=0.01)
    thrust = along_and_across_the_crank(run.statics.force(MAIN), 45).real
    assert abs(thrust) == pytest.approx(of_exact(11.98e3, **terms), abs=5)


def test_connecting_rod_with_mass_and_inertia():
    """Example 15.20: 3840 N m (three digits) turn piston and rod of 250 kg, its weight included, at 125 rpm and 30°."""
    bodies = {"slider": RigidBody(300.0), "coupler": RigidBody(250.0, (0.5, 0.0), 250.0 * 0.65**2)}
    run = engine(r=0.3, rod=1.5, rpm=125, degrees=30, push=0.0, bodies=bodies, gravity=(0.0, -9.81))
    assert run.drive[0, 0] == pytest.approx(3840, abs=10)


def test_connecting_rod_as_a_pendulum():
    """Example 15.16: 10 kg at 625 mm and 27.5 kg at 228 mm from the centre swing as the rod does, 1.87 s at 650 mm."""
    rod = RigidBody(10.0, (25, 0)) + RigidBody(27.5, (878, 0))
    assert rod.centre[0] == pytest.approx(650, rel=2e-3)
    loads = Loads(bodies={"crank": rod}, gravity=(0, -9.81))
    (hanging,) = (rest for rest in equilibria(FourBar(1000, 3000, 3000, 3000), loads) if rest.stable)
    assert 1 / hanging.frequencies[0] == pytest.approx(1.87, rel=2e-3)


def test_a_flywheel_between_an_engine_and_a_machine():
    """Example 16.12: 500 kg at 0.4 m, moments 5000 + 600 sin 2q - (5000 + 500 sin q): 1204 N m, 6.1 % at 150 rpm."""
    speed = 150 * np.pi / 30
    linkage = FourBar(1, 3, 3, 3).linkage(unit="m")
    motion = move(linkage, np.linspace(0, 2 * np.pi, 2001), speed=speed)
    loads = Loads(moments={"crank": "600*sin(2*drive) - 500*sin(drive)"})
    wheel = flywheel(motion, loads, 0.061)
    assert wheel.inertia * 0.061 * speed**2 == pytest.approx(1204, abs=1)
    assert wheel.inertia == pytest.approx(500 * 0.4**2, rel=0.01)
