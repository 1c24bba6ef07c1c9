"""The equations of motion: derivatives of the energies against the sums over bodies, units, what loads may be."""

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.units import quantity_of
from gruebler.mechanics.dynamics import reduced_equations
from gruebler.mechanics.forces import Curve, Gas, LoadFormula, Loads, Motor, RigidBody, Spring, TorsionSpring, statics
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move

FOUR_BAR = FourBar(25, 70, 40, 70).linkage({"K": (30, 20)})
BODIES = {
    "crank": RigidBody(1.0, (12, 1), 100),
    "coupler": RigidBody(2.0, (30, 10), 900),
    "rocker": RigidBody(1.5, (20, 3), 400),
}
SPRINGS = {
    "springs": (
        Spring(("frame:20,50", "K"), stiffness=0.3, free_length=20, preload=2),
        Spring(("frame:70,90", "K"), law=Gas(force=8, extended=150, stroke=120, growth=1.3)),
    ),
    "torsion_springs": (TorsionSpring(("frame", "rocker"), stiffness=30.0, free_angle=0.3),),
}
ANGLES = np.linspace(0.1, 6.1, 25)
STEP = 1e-5


def differences(linkage, loads, what):
    """The derivative of a quantity of the equations by the drive, from poses on both sides."""
    behind, before = (reduced_equations(move(linkage, ANGLES + s, speed=10.0), loads) for s in (STEP, -STEP))
    return (what(behind) - what(before)) / (2 * STEP)


@pytest.mark.parametrize("linkage", [FOUR_BAR, FourBar(25, 70, 40, 70).linkage({"K": (30, 20)}).mirrored()])
def test_forces_are_the_slope_of_the_potential_and_bias_that_of_the_mass(linkage):
    loads = Loads(bodies=BODIES, masses={"K": 0.5}, **SPRINGS)
    found = reduced_equations(move(linkage, ANGLES, speed=10.0, acceleration=7.0), loads)
    slope = differences(linkage, loads, lambda equations: equations.mass[:, 0, 0])
    np.testing.assert_allclose(found.slope, slope, atol=1e-8 * np.abs(slope).max())
    np.testing.assert_allclose(found.bias[:, 0], found.slope * 100 / 2, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.kinetic, found.mass[:, 0, 0] * 50, rtol=1e-12)
    force = -differences(linkage, loads, lambda equations: equations.potential)
    np.testing.assert_allclose(found.force[:, 0], force, atol=1e-7 * np.abs(force).max())


def test_statics_carries_weights_and_springs_as_the_equations_do():
    motion = move(FOUR_BAR, ANGLES)
    loads = Loads(bodies=BODIES, **SPRINGS)
    held = statics(motion, loads)
    np.testing.assert_allclose(held.drive, -reduced_equations(motion, loads).force, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("unit", ["m", "cm", "in"])
def test_the_unit_of_length_does_not_matter(unit):
    factor = {"m": 0.001, "cm": 0.1, "in": 1 / 25.4}[unit]
    other = FourBar(25 * factor, 70 * factor, 40 * factor, 70 * factor).linkage()
    other = other._changed(unit=unit)
    bodies = {
        link: RigidBody(b.mass, (b.centre[0] * factor, b.centre[1] * factor), b.inertia * factor**2)
        for link, b in BODIES.items()
    }
    here = reduced_equations(move(FOUR_BAR, ANGLES, speed=10.0), Loads(bodies=BODIES))
    there = reduced_equations(move(other, ANGLES, speed=10.0), Loads(bodies=bodies))
    np.testing.assert_allclose(there.mass, here.mass * factor, rtol=1e-12)
    np.testing.assert_allclose(there.force, here.force * factor, rtol=1e-11, atol=1e-11)


def test_a_slider_of_two_kilograms_in_newtons():
    """By hand: 2 kg at 100 rad/s on a crank of 50 mm that has no rod's influence at 90 degrees, s' = -r w."""
    motion = move(SliderCrank(50, 1e6).linkage(), [np.pi / 2], speed=100.0)
    found = reduced_equations(motion, Loads(bodies={"slider": RigidBody(2.0)}))
    assert found.kinetic == pytest.approx([0.5 * 2 * 5.0**2 * 1000], rel=1e-9)  # 25 J in N mm


def test_bodies_of_shapes():
    """By integration over squares, and parallel axes."""
    outline = [(0, 0), (40, 0), (40, 10), (10, 10), (10, 30), (0, 30)]
    body = RigidBody.plate(outline, 5, 7850.0)
    x, y = np.meshgrid(np.arange(0.05, 40, 0.1), np.arange(0.05, 30, 0.1))
    inside = (y < 10) | (x < 10)
    mass = inside.sum() * 0.01 * 5 * 7850e-9
    centre = x[inside].mean() + 1j * y[inside].mean()
    assert body.mass == pytest.approx(mass, rel=1e-12)
    assert complex(*body.centre) == pytest.approx(centre, rel=1e-12)
    spread = (np.abs(x + 1j * y - centre) ** 2)[inside].mean() + 0.1**2 / 6
    assert body.inertia == pytest.approx(mass * spread, rel=1e-10)
    assert RigidBody.plate(outline[::-1], 5, 7850.0).inertia == pytest.approx(body.inertia, rel=1e-12)
    parts = RigidBody.plate([(0, 0), (40, 0), (40, 10), (0, 10)], 5, 7850.0)
    parts += RigidBody.plate([(0, 10), (10, 10), (10, 30), (0, 30)], 5, 7850.0)
    assert (parts.mass, parts.inertia) == pytest.approx((body.mass, body.inertia), rel=1e-12)
    with pytest.raises(LinkageError, match="crosses itself: edges 1 and 3"):  # not the difference of two triangles
        RigidBody.plate([(0, 0), (2, 1), (2, 0), (0, 3)], 5, 7850.0)
    hole = [
        (0, 0),
        (4, 0),
        (4, 4),
        (0, 4),
        (0, 0),
        (1, 1),
        (1, 2),
        (2, 2),
        (2, 1),
        (1, 1),
    ]  # reached by an edge passed twice
    assert RigidBody.plate(hole, 5, 7850.0).mass == pytest.approx(15 * 5 * 7850e-9)
    at_corner = body.inertia + body.mass * abs(complex(*body.centre)) ** 2
    assert RigidBody.about((0, 0), body.mass, body.centre, at_corner).inertia == pytest.approx(body.inertia)


def test_a_load_is_a_number_a_text_a_curve_or_a_function():
    motion = move(FOUR_BAR, ANGLES, speed=2.0)
    wanted = 3 * np.sin(ANGLES) + motion.point("K", order=1)[:, 0]
    table = Curve([(x, 3 * np.sin(x)) for x in ANGLES])
    forms = [
        ({"K": (np.stack([wanted, 0 * wanted], axis=1))}, {}),
        ({"K": ("3*sin(drive) + vx", 0.0)}, {}),
        ({"K": (lambda state: 3 * np.sin(state.drive) + state.vx, 0)}, {}),
    ]
    first, *others = [statics(motion, Loads(forces, moments=moments)).work for forces, moments in forms]
    for other in others:
        np.testing.assert_allclose(other, first, rtol=1e-12, atol=1e-12)
    turned = statics(motion, Loads(moments={"rocker": table})).work
    np.testing.assert_allclose(turned, statics(motion, Loads(moments={"rocker": 3 * np.sin(ANGLES)})).work)
    assert Motor(3.0, -10.0).at(-5.0) == pytest.approx(-1.5)
    assert LoadFormula("time*omega").names == ("omega", "time")


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: RigidBody(-1.0), "the mass must be a finite number that is not negative, not -1"),
        (lambda: RigidBody.about((0, 0), 2, (10, 0), 100), "at least mass times distance squared, 200, not 100"),
        (lambda: Spring(("K", "frame:0,0"), free_length=-3), "the free length of a spring is a finite number"),
        (lambda: Loads(moments={"crank": "3*speedy"}), r"unknown name 'speedy' \(did you mean 'speed'\?\)"),
        (lambda: Loads(moments={"crank": "__import__('os')"}), "unknown name '__import__'"),
        (lambda: Curve([(1, 2), (0, 3)]), "whose first numbers increase"),
        (lambda: Motor(0, 3), "a positive torque"),
        (lambda: quantity_of("mass", "250", "mass", "mm"), "expected a number with its unit such as '250 g'"),
        (lambda: quantity_of("mass", "3 N", "mass", "mm"), "another quantity"),
        (lambda: quantity_of("mass", "3 kgs", "mass", "mm"), "there is no unit 'kgs'"),
        (lambda: statics(move(FOUR_BAR, [1.0]), Loads(bodies={"crnk": RigidBody(1)})), "there is no link 'crnk'"),
        (lambda: statics(move(FOUR_BAR, [1.0]), Loads(springs=(Spring(("Q", "K")),))), "there is no point 'Q'"),
        (
            lambda: statics(move(FOUR_BAR, [1.0]), Loads(springs=(Spring(("K", "R(crank-coupler)"), damping=2.0),))),
            r"springs\[0\]: 'K' and 'R\(crank-coupler\)' are points of one link, 'coupler'",
        ),
        (
            lambda: reduced_equations(move(FOUR_BAR._changed(unit="LE"), [1.0]), Loads(bodies=BODIES)),
            "needs to know how long the linkage's unit 'LE' is",
        ),
    ],
)
def test_a_wrong_load_is_one_sentence(make, sentence):
    with pytest.raises(GrueblerError, match=sentence):
        make()


def test_quantities_with_units():
    """By hand: 1 N/mm is 1000 N/m; 1 kg cm2 is 100 kg mm2; 1 lbf ft is 1355.818 N mm (BIPM, NIST SP 811)."""
    assert quantity_of("c", "2.5 N/mm", "stiffness", "m") == 2500
    assert quantity_of("J", "1 kg cm^2", "inertia", "mm") == 100
    assert quantity_of("M", "1 lbf ft", "moment", "mm") == pytest.approx(1355.8179483314)
    assert quantity_of("w", "60 rpm", "speed", "mm") == pytest.approx(2 * np.pi)
