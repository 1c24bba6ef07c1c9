"""The closing conditions of every pair: zero on its motions and on no others, with the right derivatives."""

from math import atan2, cos, hypot, inf, pi, sin, sqrt

import numpy as np
import pytest

from gruebler.mechanics.screws import Closing, JointPlace, exponential
from gruebler.mechanics.screws.closing_rows import joint_rows
from gruebler.mechanics.screws.joint_places import read_place
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Space
from tests.mechanics.screws import machines

RANDOM = np.random.default_rng(7)
EVERY = [(p, s) for p in PAIRS for s in Space if s in p.freedoms]


def place(pair, space, radii=None):
    return JointPlace(pitch=0.3 * pair.has_pitch, radii=radii)


def values(made, e):
    return np.array([row(e)[0] if callable(row) else (row * e).sum() for row in made])


def unit(direction, pitch=0.0):
    twist = np.zeros(6)
    twist["xyz".index(direction[1]) + 3 * (direction[0] == "T")] = 1
    if direction[0] == "H":
        twist[5] = pitch
    return twist


@pytest.mark.parametrize(("pair", "space"), EVERY, ids=lambda v: getattr(v, "name", v))
def test_a_pair_takes_away_what_its_table_says(pair, space):
    radii = (1.0, 0.5) if space is not Space.SPHERICAL else (0.6, 0.4)
    made = joint_rows(pair, space, place(pair, space, radii if pair.has_contours else None))
    assert len(made) == pair.u(space)
    assert abs(values(made, np.eye(4))).max() < 1e-15
    directions = [unit(d) for d in space.directions]
    slopes = np.array(
        [(values(made, exponential(1e-6 * t)) - values(made, exponential(-1e-6 * t))) / 2e-6 for t in directions]
    ).T
    assert np.linalg.matrix_rank(slopes, tol=1e-6) == pair.u(space)
    free = np.array([unit(d, 0.3) for d in pair.freedoms[space]]) @ np.array(directions).T
    assert abs(slopes @ free.T).max() < 1e-9


@pytest.mark.parametrize(
    ("pair", "space"), [(p, s) for p, s in EVERY if not p.has_contours], ids=lambda v: getattr(v, "name", v)
)
def test_finite_motions_of_a_pair_keep_it_closed(pair, space):
    """Shifts first, then the turns in the order of the table: the first link's axis, then the second's."""
    made = joint_rows(pair, space, place(pair, space))
    for _ in range(5):
        amount = RANDOM.uniform(-1, 1, 6)
        e = np.eye(4)
        free = pair.freedoms[space]
        order = free if pair.has_body_between else sorted(free, key=lambda d: d[0] != "T")
        if pair.has_body_between:  # both freedoms of the first link's axis, then both of the second's
            order = sorted(free, key=lambda d: d[1])
        for k, direction in enumerate(order):
            e = e @ exponential(amount[k] * unit(direction, 0.3))
        assert abs(values(made, e)).max() < 1e-12


def test_a_screw_may_turn_more_than_once():
    made = joint_rows(next(p for p in PAIRS if p.name == "helical"), Space.SPATIAL, JointPlace(pitch=0.3))
    assert abs(values(made, exponential(20 * unit("Hz", 0.3)))).max() < 1e-12


LINKAGES = {
    "loco": machines.locomotive(3),
    "slots": machines.two_scissors(3.0),
    "friction": machines.friction_arm(),
    "gears": machines.differential(2),
    "winch": machines.winch(),
    "bevel": machines.bevel(2),
    "cardan": machines.cardan(),
    "bennett": machines.bennett()[0],
}


@pytest.mark.parametrize("name", LINKAGES)
def test_derivatives_by_finite_differences(name):
    closing = Closing.of(LINKAGES[name])
    pose = closing.moved(closing.reference, 0.1 * RANDOM.normal(size=closing.unknowns))
    motion = 0.1 * RANDOM.normal(size=closing.unknowns)
    _, exact = closing.linearised(pose)
    _, along = closing.along(pose, motion)
    h = 1e-6
    for k, step in enumerate(h * np.eye(closing.unknowns)):
        one, other = closing.residual(closing.moved(pose, step)), closing.residual(closing.moved(pose, -step))
        assert exact[:, k] == pytest.approx((one - other) / (2 * h), abs=1e-8)
        one = closing.residual(closing.moved(pose, motion + step))
        other = closing.residual(closing.moved(pose, motion - step))
        assert along[:, k] == pytest.approx((one - other) / (2 * h), abs=1e-8)


# --- round contacts against their own geometry ------------------------------------------------------------------------


def seen(turn, x, y):
    return exponential([0, 0, 0, x, y, 0]) @ exponential([0, 0, turn, 0, 0, 0])


@pytest.mark.parametrize(("r", "s"), [(2.0, 1.0), (1.0, 3.0), (-3.0, 1.0), (5.0, -2.0)])
def test_wheels_roll_without_slip(r, s):
    """The second wheel on the first: its centre goes round by t, and it turns by t (1 + r / s)."""
    made = joint_rows(next(p for p in PAIRS if p.name == "rolling"), Space.PLANAR, JointPlace(radii=(r, s)))
    for t in (0.1, -0.4, 1.0):
        centre = np.array([-(r + s) * sin(t), (r + s) * cos(t) - r])  # from the contact at home

        def turned(turn, centre=centre):
            return seen(turn, *(centre - s * np.array([-sin(turn), cos(turn)])))

        assert abs(values(made, turned(t * (1 + r / s)))).max() < 1e-12
        assert abs(values(made, turned(t * (1 + r / s) + 0.1))).max() > 0.01


@pytest.mark.parametrize("away", [0.0, 0.05, -0.02])
def test_teeth_keep_in_touch_on_the_common_tangent_of_the_base_circles(away):
    """Involutes are drawn by a thread from base circle to base circle: what it unwinds from both is its length."""
    r, s, alpha = 2.0, 1.5, 0.35
    row = joint_rows(
        next(p for p in PAIRS if p.name == "roll_slide"), Space.PLANAR, JointPlace(radii=(r, s), pressure=alpha)
    )
    one, other = r * cos(alpha), s * cos(alpha)

    def unwound(distance):  # with the line of centres and the first wheel at rest
        angle = np.arccos((one + other) / distance)
        return sqrt(distance**2 - (one + other) ** 2) - (one + other) * angle

    turn = -(unwound(r + s + away) - unwound(r + s)) / other
    e = seen(turn, s * sin(turn), s + away - s * cos(turn))
    assert abs(row[0](e)[0]) < 1e-12
    assert abs(row[0](seen(turn, s * sin(turn), s + away + 0.01 - s * cos(turn)))[0]) > 1e-3


@pytest.mark.parametrize("radii", [(0.0, inf), (inf, 0.0), (inf, 0.7), (0.7, inf)])
def test_a_pin_in_a_slot_and_a_disc_on_a_face(radii):
    made = joint_rows(next(p for p in PAIRS if p.name == "roll_slide"), Space.PLANAR, JointPlace(radii=radii))
    round_first = radii[0] < inf
    radius = min(radii)
    for turn, way in ((0.3, 0.5), (-1.0, -0.2)):
        if round_first:  # the face lies in the second link: y = 0 there, the centre at (0, -radius) in the first
            spot = np.array([0.0, -radius]) + radius * np.array([-sin(turn), cos(turn)])
            at = spot + way * np.array([cos(turn), sin(turn)])
        else:  # the centre is (0, radius) in the second link
            at = np.array([way, radius]) - radius * np.array([-sin(turn), cos(turn)])
        assert abs(values(made, seen(turn, *at))).max() < 1e-12
    assert abs(values(made, seen(0.2, 0.1, 0.3))).max() > 0.1


@pytest.mark.parametrize(("r", "s"), [(0.5, 0.7), (1.0, 0.3), (pi / 4, pi / 4)])
def test_cones_roll_without_slip(r, s):
    made = joint_rows(next(p for p in PAIRS if p.name == "rolling"), Space.SPHERICAL, JointPlace(radii=(r, s)))
    one, other = np.array([0, -sin(r), cos(r)]), np.array([0, sin(s), cos(s)])
    for t in (0.3, -0.8):
        e = exponential([*(t * one), 0, 0, 0]) @ exponential([*(t * sin(r) / sin(s) * other), 0, 0, 0])
        assert abs(values(made, e)).max() < 1e-12
        wrong = exponential([*(t * one), 0, 0, 0]) @ exponential([*(-t * sin(r) / sin(s) * other), 0, 0, 0])
        assert abs(values(made, wrong)).max() > 0.01


def test_exponentials():
    for _ in range(20):
        a = RANDOM.normal(size=6)
        assert exponential(a) @ exponential(-a) == pytest.approx(np.eye(4), abs=1e-12)
        assert exponential(a) == pytest.approx(np.linalg.matrix_power(exponential(a / 64), 64), abs=1e-11)
    tiny = [exponential(s * np.array([1, 2, 2, 0.5, 0, 1])) for s in (0.00333, 0.00334)]  # either side of the series
    assert hypot(*(tiny[1] - tiny[0]).ravel()) == pytest.approx(1e-5 * sqrt(18 + 1.25), rel=1e-2)


def test_places_of_wheels_are_checked():
    pair = next(p for p in PAIRS if p.name == "roll_slide")
    made = read_place({"at": (1, 2), "y": (0, 2), "radii": (1, inf)}, pair, Space.PLANAR, "G")
    assert made.at == (1, 2, 0)
    assert atan2(made.y[1], made.y[0]) == pi / 2
