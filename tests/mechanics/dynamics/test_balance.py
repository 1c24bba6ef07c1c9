"""Balance: laws over motions that the method never solves, closed forms by hand, another way to each answer."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize

from gruebler.base.errors import LinkageError
from gruebler.files.linkages import linkage_from_json
from gruebler.mechanics.dynamics import (
    balance_forces,
    balance_moments,
    balance_partly,
    balance_weights,
    equilibria,
    fit_springs,
    flywheel,
    inverse_dynamics,
    reduced_equations,
    shaking_harmonics,
)
from gruebler.mechanics.forces import Loads, RigidBody, Spring, statics
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

TURN = np.linspace(0, 2 * np.pi, 73)
CRANK_ROCKER = FourBar(25, 70, 40, 70).linkage()


def bodies_of(linkage, seed=0):
    """Some mass for each link that moves."""
    dice = np.random.default_rng(seed)
    size = linkage.size
    return {
        link: RigidBody(dice.uniform(0.5, 2), tuple(dice.uniform(-0.3, 0.5, 2) * size), dice.uniform(0, size**2))
        for link in linkage.mechanism.chain.links
        if link != linkage.mechanism.frame
    }


def centre_moves(motion, loads):
    """How far the common centre of mass moves, by the size of the linkage."""
    points = [((link, *body.centre), body.mass) for link, body in loads.bodies.items()] + list(loads.masses.items())
    total = sum(mass * motion.complex_point(point) for point, mass in points) / sum(mass for _, mass in points)
    return np.abs(total - total.mean()).max() / motion.linkage.size


MACHINES = {
    "four-bar": CRANK_ROCKER,
    "slider-crank": SliderCrank(30, 90, 8).linkage(),
    "inverted slider-crank": InvertedSliderCrank(30, 50, 7).linkage(),
    "six-bar": entry("wiper").linkage(),
    "pin in a slot": entry("filmclaw_slot").linkage(),
    "two pistons": entry("vcomp").linkage(),
    "pins whose sums are rounded": linkage_from_json(
        {
            "unit": "mm",
            "joints": "R(frame-crank) R(crank-rod) R(rod-lever) R(frame-lever) R(lever-link) R(link-ram) P(frame-ram)",
            "frame": "frame",
            "drives": ["R(frame-crank)"],
            "places": {
                "R(frame-crank)": [0, 0],
                "R(crank-rod)": [15, 20],
                "R(rod-lever)": [80, 45],
                "R(frame-lever)": [70, 0],
                "R(lever-link)": [85, 60],
                "R(link-ram)": [160, 60],
                "P(frame-ram)": [160, 60, 0],
            },
        }
    ),
}


@pytest.mark.parametrize("name", MACHINES)
def test_the_centre_of_a_balanced_linkage_stays_still(name):
    linkage = MACHINES[name]
    motion = move(linkage, TURN)
    assert motion.complete
    loads = Loads(bodies=bodies_of(linkage))
    found = balance_forces(linkage, loads)
    assert found.possible, found
    assert centre_moves(motion, loads) > 1e-2
    assert centre_moves(motion, found.balanced) < 1e-13


@given(st.tuples(*[st.floats(20, 80)] * 4), st.integers(0, 1000))
def test_any_four_bar_is_balanced_by_two_weights(lengths, seed):
    """Poses by hand, two circles: also those of dimensions whose crank does not turn."""
    a, b, c, d = lengths
    bodies = bodies_of(FourBar(a, b, c, d).linkage(), seed)
    found = balance_forces(FourBar(a, b, c, d), Loads(bodies=bodies))
    assert [each.link for each in found.counterweights] == ["crank", "rocker"]
    crank = np.exp(1j * np.linspace(0.1, 6.1, 61))
    gap = d - a * crank
    cosine = (np.abs(gap) ** 2 + b**2 - c**2) / (2 * b * np.abs(gap))
    held = np.abs(cosine) < 1
    if not held.any():
        return
    coupler = (gap / np.abs(gap) * np.exp(1j * np.arccos(np.clip(cosine, -1, 1))))[held]
    rocker = (a * crank[held] + b * coupler - d) / c
    poses = {"crank": (0, crank[held]), "coupler": (a * crank[held], coupler), "rocker": (d, rocker)}
    everything = [(k, complex(*body.centre), body.mass) for k, body in bodies.items()]
    everything += [(each.link, complex(*each.place), each.mass) for each in found.counterweights]
    mass = sum(m for _, _, m in everything)
    centre = sum(m * (poses[k][0] + poses[k][1] * arm) for k, arm, m in everything) / mass
    assert np.abs(centre - centre[0]).max() < 1e-13 * sum(lengths)


def test_berkof_and_lowen_by_hand():
    """Their conditions for a four-bar: m1 r1 = m2 r2' a1/a2 at t2', m3 r3 = m2 r2 a3/a2 at t2 + pi (JEI 91, 1969).

    r2, t2 is the centre of the coupler from the crank's pin, r2', t2' from the rocker's pin, both against the line
    from the first to the second. The crank and the rocker themselves have no mass here.
    """
    mass, centre = 3.0, 20 + 10j
    found = balance_forces(CRANK_ROCKER, Loads(bodies={"coupler": RigidBody(mass, (20.0, 10.0))}))
    crank, rocker = found.counterweights
    far = centre - 70
    assert crank.product == pytest.approx(mass * abs(far) * 25 / 70, rel=1e-13)
    assert np.angle(complex(*crank.place)) == pytest.approx(np.angle(far), abs=1e-13)
    assert rocker.product == pytest.approx(mass * abs(centre) * 40 / 70, rel=1e-13)
    pin = complex(*CRANK_ROCKER.element("R(frame-rocker)", "rocker").place)
    tip = complex(*CRANK_ROCKER.element("R(coupler-rocker)", "rocker").place)
    turned = (complex(*rocker.place) - pin) / (tip - pin)
    assert np.exp(1j * np.angle(turned)) == pytest.approx(-centre / abs(centre), abs=1e-13)


def test_a_slide_to_the_frame_alone_cannot_be_balanced():
    scotch = Mechanism.parse(
        "R(frame-crank) R(crank-block) P(block-yoke) P(yoke-frame); frame=frame; drive=R(frame-crank)"
    )
    places = {
        "R(frame-crank)": (0, 0),
        "R(crank-block)": (30, 0),
        "P(block-yoke)": (30, 0, np.pi / 2),
        "P(yoke-frame)": (60, 0, 0),
    }
    linkage = Linkage.from_drawing(scotch, places)
    found = balance_forces(linkage, Loads(bodies={"crank": RigidBody(1.0, (9, 0)), "yoke": RigidBody(2.0)}))
    assert not found.possible
    assert found.blocked == ("yoke",)
    assert str(found) == (
        "A complete balance of forces is impossible: no path of turning joints leads from yoke to the frame, only over "
        "P(block-yoke), P(yoke-frame)."
    )
    assert balance_forces(linkage, Loads(bodies={"crank": RigidBody(1.0, (9, 0))})).possible
    with pytest.raises(LinkageError, match="springs cannot hold yoke"):
        balance_weights(linkage, Loads(bodies={"yoke": RigidBody(2.0)}), height=10)


def test_links_that_cannot_carry_the_balance_are_named():
    loads = Loads(bodies=bodies_of(CRANK_ROCKER))
    found = balance_forces(CRANK_ROCKER, loads, on=["crank"])
    assert str(found) == "Counterweights on crank alone cannot balance the forces; on crank, rocker they can."
    other = balance_forces(CRANK_ROCKER, loads, on=["crank", "coupler"], radius={"coupler": 30})
    assert centre_moves(move(CRANK_ROCKER, TURN), other.balanced) < 1e-13
    with pytest.raises(LinkageError, match="not 'frame'"):
        balance_forces(CRANK_ROCKER, loads, on=["frame"])
    with pytest.raises(LinkageError, match="positive length, not -1"):
        balance_forces(CRANK_ROCKER, loads, radius=-1)
    with pytest.raises(LinkageError, match="nothing has mass"):
        balance_forces(CRANK_ROCKER, Loads())


def test_half_of_the_piston_is_the_best_first_order():
    """By hand, long rod: the force m r w² cos q leaves half of itself, turning backwards."""
    run = inverse_dynamics(move(SliderCrank(30, 3e6), TURN[:-1], speed=100.0), Loads(bodies={"slider": RigidBody(2.0)}))
    half = 2.0 * 0.030 * 100**2 / 2
    for minimax in (False, True):
        best = balance_partly(run, ["crank"], minimax=minimax)
        assert best.products["crank"] == pytest.approx((-30, 0), abs=1e-3)
        assert best.largest == pytest.approx((2 * half, half), rel=1e-4)
    np.testing.assert_allclose(shaking_harmonics(run, 1), [half, 0, half], atol=1e-4 * half)


def test_second_order_of_an_engine():
    """x'' to the second order of r/l, any text: F = m r w² (cos q + (r/l) cos 2q); each half forward, half backward."""
    r, rod = 1.0, 100.0
    run = inverse_dynamics(move(SliderCrank(r, rod), TURN[:-1], speed=10.0), Loads(bodies={"slider": RigidBody(1.0)}))
    size = 1e-3 * r * 10.0**2
    harmonics = shaking_harmonics(run, 2).real / size
    np.testing.assert_allclose(harmonics, [r / rod / 2, 0.5, 0, 0.5, r / rod / 2], atol=(r / rod) ** 3)


def test_minimax_against_a_general_optimiser():
    run = inverse_dynamics(
        move(SliderCrank(30, 80, 10), TURN[:-1], speed=100.0),
        Loads(bodies=bodies_of(SliderCrank(30, 80, 10).linkage())),
    )
    best = balance_partly(run, ["crank"], minimax=True)
    turned = run.motion.turns[:, run.motion.links.index("crank")]

    def largest(product):
        force = run.shaking_force @ [1, 1j] + 1e-3 * 100**2 * turned * (product[0] + 1j * product[1])
        return np.abs(force).max()

    start = balance_partly(run, ["crank"]).products["crank"]
    other = minimize(largest, start, method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-10, "maxiter": 4000})
    assert best.largest[1] == pytest.approx(other.fun, rel=1e-7)
    assert best.bound == pytest.approx(best.largest[1], rel=1e-6)
    assert best.bound <= best.largest[1]
    with pytest.raises(LinkageError, match="'coupler' is not pinned to the frame"):
        balance_partly(run, ["coupler"])


def test_counter_rotation_makes_a_balanced_four_bar_still():
    """By hand: a coupler like two point masses at its pins, J = m s (b - s), leaves the moments of crank and rocker.

    Their moments of inertia about their pins, counterweights and point masses included, are those of the wheels.
    """
    mass, s = 2.0, 30.0
    bodies = {"crank": RigidBody(1.0, (5, 0), 90.0), "coupler": RigidBody(mass, (s, 0), mass * s * (70 - s))}
    balanced = balance_forces(CRANK_ROCKER, Loads(bodies=bodies)).balanced
    run = inverse_dynamics(move(CRANK_ROCKER, TURN, speed=40.0, acceleration=300.0), balanced)
    best = balance_moments(run, ["crank", "rocker"])
    assert np.abs(best.after).max() < 1e-10 * np.abs(best.before).max()
    pins = {link: complex(*CRANK_ROCKER.element(f"R(frame-{link})", link).place) for link in best.inertias}
    wanted = {"crank": 90 + 1.0 * 5**2 + mass * (1 - s / 70) * 25**2, "rocker": mass * s / 70 * 40**2}
    for point, weight in balanced.masses.items():
        wanted[point.link] += weight * abs(complex(point.x, point.y) - pins[point.link]) ** 2
    assert best.inertias == pytest.approx(wanted, rel=1e-10)


def test_a_flywheel_keeps_the_wanted_irregularity():
    """Against the speed by time: (J + m x'²) w w' + m x' x'' w² = T - 3 x x' - 2000 sin² q, x of the slider by hand."""
    linkage, irregularity, mean, mass = SliderCrank(30, 90).linkage(), 0.08, 40.0, 2.0
    loads = Loads(
        forces={"R(coupler-slider)": ("-3*x", 0)},
        moments={"crank": "-2000*sin(angle)**2"},
        bodies={"slider": RigidBody(mass)},
    )
    motion = move(linkage, np.linspace(0, 2 * np.pi, 2001), speed=mean)
    wheel = flywheel(motion, loads, irregularity)
    assert wheel.torque == pytest.approx(1000, rel=1e-9)  # sin² is 1/2 in the mean, and the spring takes nothing

    def slope(q, w):
        root = np.sqrt(90**2 - 900 * np.sin(q) ** 2)
        x, first = 30 * np.cos(q) + root, -30 * np.sin(q) - 450 * np.sin(2 * q) / root
        second = -30 * np.cos(q) - 900 * np.cos(2 * q) / root - 450**2 * np.sin(2 * q) ** 2 / root**3
        torque = wheel.torque - 3 * x * first - 2000 * np.sin(q) ** 2
        return (torque * 1e3 / w - mass * first * second * w) / (wheel.inertia + mass * first**2)

    def speeds(start):
        return solve_ivp(slope, (0, 2 * np.pi), [start], t_eval=motion.drives[:, 0], rtol=1e-10, atol=1e-10).y[0]

    start = brentq(lambda w: speeds(w).max() + speeds(w).min() - 2 * mean, 0.9 * mean, 1.1 * mean, xtol=1e-9)
    assert np.ptp(speeds(start)) / mean == pytest.approx(irregularity, rel=2e-5)
    with pytest.raises(LinkageError, match="a full turn of one drive"):
        flywheel(move(linkage, [0.0, 1.0], speed=1.0), loads, 0.1)
    with pytest.raises(LinkageError, match="between 0 and 2, not 0"):
        flywheel(move(linkage, TURN, speed=1.0), loads, 0)


@pytest.mark.parametrize("name", ["four-bar", "six-bar"])
def test_springs_hold_the_weights_everywhere(name):
    linkage = MACHINES[name]
    bodies = {"crank": RigidBody(1.0, (5, 3)), "coupler": RigidBody(2.0, (25, 9)), "rocker": RigidBody(1.5, (10, -4))}
    bodies = bodies if name == "four-bar" else {"crank": RigidBody(1.0, (5, 3)), "rocker2": RigidBody(0.5, (40, -4))}
    loads = Loads(bodies=bodies, gravity=(3.0, -9.0))
    springs = balance_weights(linkage, loads, height=40.0, radius=20.0)
    held = Loads(bodies=bodies, gravity=(3.0, -9.0), springs=springs)
    motion = move(linkage, TURN, speed=1.0)
    before, after = (reduced_equations(motion, each).force for each in (loads, held))
    assert np.abs(after).max() < 1e-12 * np.abs(before).max()
    assert all(isinstance(each, Spring) and each.free_length == 0 for each in springs)
    if name == "four-bar":
        assert str(equilibria(linkage, held)) == "Every position is an equilibrium."


def test_fitted_springs_of_free_length_zero_are_those_that_hold_exactly():
    linkage, loads = FourBar(25, 70, 40, 70).linkage(), Loads(bodies={"crank": RigidBody(2.0, (15, 0))})
    exact = balance_weights(linkage, loads, height=20, radius=10)
    fit = fit_springs(move(linkage, np.linspace(0, 6, 40)), loads, [replace(s, stiffness=0.0) for s in exact])
    assert [s.stiffness for s in fit.springs] == pytest.approx([s.stiffness for s in exact], rel=1e-12)
    assert np.abs(fit.after).max() < 1e-12 * np.abs(fit.before).max()


@pytest.mark.parametrize("minimax", [False, True])
def test_fitted_real_springs_against_a_general_optimiser(minimax):
    """Free lengths and a preload; the effort with springs is that of equilibrium, by another road."""
    linkage = FourBar(25, 70, 40, 70).linkage()
    loads = Loads(bodies={"crank": RigidBody(2.0, (15, 3)), "coupler": RigidBody(1.5, (30, 5))})
    motion = move(linkage, np.linspace(0.3, 2.0, 35))
    springs = [
        Spring(("frame:0,40", "crank:12,0"), free_length=15.0, preload=2.0),
        Spring(("frame:60,90", "coupler:40,0"), free_length=25.0),
        Spring(("frame:0,-60", "crank:10,0"), free_length=5.0),  # it pulls down: of no use
    ]
    fit = fit_springs(motion, loads, springs, minimax=minimax)

    def size(stiffness):
        pulling = tuple(replace(s, stiffness=float(k)) for s, k in zip(springs, stiffness, strict=True))
        effort = statics(motion, replace(loads, springs=pulling)).drive[:, 0]
        return np.abs(effort).max() if minimax else np.sqrt((effort**2).mean())

    found = [s.stiffness for s in fit.springs]
    assert size(found) == pytest.approx(fit.bound, rel=1e-10)
    assert size(found) == pytest.approx(np.abs(fit.after).max() if minimax else np.sqrt((fit.after**2).mean()))
    assert fit.springs[2].stiffness == 0
    other = minimize(size, [1.0, 1.0, 1.0], method="Nelder-Mead", bounds=[(0, None)] * 3, options={"maxiter": 50})
    assert other.fun >= fit.bound * (1 - 1e-9)
    assert size(found) < 0.3 * np.abs(fit.before).max()


def test_fitted_springs_of_two_drives():
    """The arms of the lamp by hand, with springs of free length 0: g C / (h p) each."""
    linkage, loads, _ = entry("lamp").loaded()
    motion = move(linkage, np.radians([(q, q + s) for q in range(60, 151, 10) for s in (-20, 0, 10)]))
    exact = [replace(spring, free_length=0.0, preload=0.0) for spring in loads.springs]
    fit = fit_springs(motion, replace(loads, springs=()), exact)
    by_hand = [9.80665 * 0.670 * 250 / (50 * 100), 9.80665 * 0.430 * 250 / (40 * 100)]
    assert [s.stiffness for s in fit.springs] == pytest.approx(by_hand, rel=1e-12)
    assert fit.before.shape == fit.after.shape == (30, 2)
    assert np.abs(fit.after).max() < 1e-11 * np.abs(fit.before).max()


def test_wrong_springs_to_be_fitted():
    motion = move(FourBar(25, 70, 40, 70), [0.5, 1.0])
    with pytest.raises(LinkageError, match="springs, one at least, are fitted"):
        fit_springs(motion, Loads(), [])
