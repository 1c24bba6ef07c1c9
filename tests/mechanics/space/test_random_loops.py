"""Random RSSR, spherical four-bars and RCCC: closed form, solver and homotopy agree; rates against 50 digits.

The output of higher precision closes the loop by its geometry alone (a distance, an angle, three shifts), by Newton's
method on decimal numbers; its differences over 1e-10 radians are right to some 20 digits.
"""

from dataclasses import replace
from decimal import Decimal, getcontext, localcontext

import numpy as np
import pytest

from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import RSSR, SphericalFourBar, assembly_modes, move
from gruebler.structure.mechanism import Mechanism

RATES = {"speed": 1.3, "acceleration": -0.7, "jerk": 0.4}
STEP = Decimal("1e-10")
SIZES = [pytest.param(range(30)), pytest.param(range(1000), marks=pytest.mark.slow)]


def cosine_and_sine(angle):
    """By their series."""
    sums, term, k = [Decimal(1), Decimal(0)], Decimal(1), 0
    while abs(term) > Decimal(10) ** -getcontext().prec:
        k += 1
        term = term * angle / k
        sums[k % 2] += term if k % 4 < 2 else -term
    return sums


def exact(values):
    return np.array([Decimal(float(value)) for value in values], object)


def turned(vector, axis, angle):
    c, s = cosine_and_sine(angle)
    return vector * c + np.cross(axis, vector) * s + axis * (axis @ vector) * (1 - c)


def unit(vector):
    return vector / (vector @ vector).sqrt()


def root(f, start):
    """Newton's method on a function that returns its value and its derivative."""
    x = Decimal(start)
    for _ in range(4):
        value, slope = f(x)
        x -= value / slope
    return x


def rates_by_differences(output, phi):
    """Velocity, acceleration, jerk of outputs (n,) of the drive's angle, for the drive's rates; (3, n)."""
    far, near, here, after, beyond = (output(Decimal(phi) + k * STEP) for k in range(-2, 3))
    first = (after - near) / (2 * STEP)
    second = (after - 2 * here + near) / STEP**2
    third = (beyond - 2 * after + 2 * near - far) / (2 * STEP**3)
    speed, acceleration, jerk = map(Decimal, RATES.values())
    return np.array(
        [
            first * speed,
            second * speed**2 + first * acceleration,
            third * speed**3 + 3 * second * speed * acceleration + first * jerk,
        ]
    ).astype(float)


def moved(linkage, phi, start):
    return move(linkage, [0.0, phi - start], order=3, **RATES)


def closed_form(four_bar, phi, branch):
    speed, acceleration, jerk = RATES.values()
    return four_bar.motion(phi, omega=speed, alpha=acceleration, jerk=jerk, branch=branch)


def random_in(make, rng):
    """A linkage, its branch, a start and a near angle of its crank, far enough from where the branches meet."""
    while True:
        bar, branch, start = make(rng), "+-"[rng.integers(2)], rng.uniform(-3, 3)
        near = start + rng.uniform(-0.3, 0.3)
        way = bar.motion(np.linspace(start, near, 20), branch=branch)
        if way.complete and way.transmission_angle.min() > 0.15:
            return bar, branch, start, near


def random_rssr(rng):
    lengths = dict(zip("abcd", rng.uniform((10, 30, 30, 20), (60, 150, 120, 120)), strict=True))
    twist, first, second = rng.uniform((-1.5, -50, -50), (1.5, 50, 50))
    return RSSR(**lengths, twist=twist, crank_offset=first, rocker_offset=second)


def random_spherical(rng):
    return SphericalFourBar(*rng.uniform(0.3, 2.8, 4))


def agrees(bar, branch, start, phi, linkage, wanted):
    """The closed form, the solver from another position, and the modes; the differences of the same output."""
    form = closed_form(bar, [start, phi], branch)
    motion = moved(linkage, phi, start)
    scale = 1 + max(float(abs(np.array(form.output)[:, 1]).max()), 1 / form.transmission_angle.min() ** 3)
    seen = motion.joint(3, "Rz")[1] - (form.output.value[1] - form.output.value[0])
    assert abs(np.exp(1j * seen) - 1) < 1e-12 * scale
    for order in (1, 2, 3):
        assert abs(motion.joint(3, "Rz", order=order)[1] - form.output[order][1]) < 1e-11 * scale
    assert abs(wanted - [form.output[order][1] for order in (1, 2, 3)]).max() < 1e-11 * scale
    modes = assembly_modes(linkage, phi - start)
    assert (modes.number, modes.exact) == (2, True)
    both = [bar.motion(phi, branch=side).output.value - form.output.value[0] for side in "+-"]
    assert len(modes) == np.isfinite(both).sum()
    frame = linkage.frames[3][:3, :3]
    turn = frame.T @ modes.pose("rocker")[:, :3, :3] @ frame
    there = np.exp(1j * np.array(both)[np.isfinite(both)])
    apart = abs(turn[:, 0, 0] + 1j * turn[:, 1, 0] - there[:, None])
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-11 * scale
    return motion, scale


def check_rssr(seed):
    bar, branch, start, phi = random_in(random_rssr, np.random.default_rng(seed))
    near = closed_form(bar, phi, branch).output.value
    with localcontext(prec=50):
        (up, out), zero = cosine_and_sine(Decimal(bar.twist)), Decimal(0)
        axis, across = np.array([zero, -out, up]), np.array([zero, up, out])
        along, a, c = exact([1, 0, 0]), Decimal(bar.a), Decimal(bar.c)
        centre = Decimal(bar.d) * along + Decimal(bar.rocker_offset) * axis

        def output(angle):
            cosine, sine = cosine_and_sine(angle)
            crank = np.array([a * cosine, a * sine, Decimal(bar.crank_offset)])

            def gap(psi):
                (x, y) = cosine_and_sine(psi)
                rod = centre + c * (x * along + y * across) - crank
                return rod @ rod - Decimal(bar.b) ** 2, 2 * c * (rod @ (x * across - y * along))

            return np.array([root(gap, float(near))])

        wanted = rates_by_differences(output, phi)[:, 0]
    agrees(bar, branch, start, phi, bar.linkage(start, branch=branch), wanted)


@pytest.mark.parametrize("seeds", SIZES)
def test_random_rssr(seeds):
    for seed in seeds:
        check_rssr(seed)


def spherical_output(bar, near):
    """The directions of coupler axes, and psi, over the crank's angle."""
    (ca, sa), (cb, _), (cc, sc), (cd, sd) = (cosine_and_sine(Decimal(arc)) for arc in (bar.a, bar.b, bar.c, bar.d))
    zero = Decimal(0)
    along, across, axis = np.array([cd, zero, -sd]), np.array([zero, Decimal(1), zero]), np.array([sd, zero, cd])

    def output(angle):
        cosine, sine = cosine_and_sine(angle)
        first = np.array([sa * cosine, sa * sine, ca])

        def second(psi):
            x, y = cosine_and_sine(psi)
            return cc * axis + sc * (x * along + y * across), sc * (x * across - y * along)

        psi = root(
            lambda psi: tuple(first @ each - rest for each, rest in zip(second(psi), (cb, 0), strict=True)), near
        )
        return first, second(psi)[0], psi

    return output


def check_spherical_and_rccc(seed):
    rng = np.random.default_rng(seed)
    bar, branch, start, phi = random_in(random_spherical, rng)
    sphere = bar.linkage(start, branch=branch)
    points = rng.normal(size=(4, 3)) * [[0], [1], [1], [1]]
    places = tuple(replace(p, at=tuple(at)) for p, at in zip(sphere.places, points.tolist(), strict=True))
    text = "R(frame-crank) C(crank-coupler) C(coupler-rocker) C(frame-rocker); drive=R(frame-crank)"
    screws = SpatialLinkage(Mechanism.parse(f"spatial: {text}"), places)
    first, near = closed_form(bar, [start, phi], branch).output.value.tolist()
    with localcontext(prec=50):
        at_start = spherical_output(bar, first)(Decimal(start))
        crank_axis, axis = exact([0, 0, 1]), unit(exact(sphere.places[3].z))
        _, p2, p3, p4 = (exact(point) for point in points)
        n2, n3 = at_start[:2]
        basis = [n2, n3, np.cross(n2, n3)]
        volume = basis[2] @ basis[2]
        parts = [(p3 - p2) @ np.cross(basis[k - 2], basis[k - 1]) / volume for k in range(3)]
        spherical = spherical_output(bar, near)

        def output(angle):
            """psi, and the shifts at the crank and at the frame, which close the loop of the points."""
            m2, m3, psi = spherical(angle)
            coupler = parts[0] * m2 + parts[1] * m3 + parts[2] * np.cross(m2, m3)
            open_by = p4 + turned(p3 - p4, axis, psi - at_start[2])
            open_by = open_by - turned(p2, crank_axis, angle - Decimal(start)) - coupler
            volume = m2 @ np.cross(m3, axis)  # s2 m2 + s m3 - s4 axis = open_by
            return np.array([psi, open_by @ np.cross(m3, axis) / volume, -(open_by @ np.cross(m2, m3)) / volume])

        wanted = rates_by_differences(output, phi)
        shifts = output(Decimal(phi))[1:].astype(float)
        sine = float(abs(at_start[0] @ np.cross(at_start[1], axis)))
    agrees(bar, branch, start, phi, sphere, wanted[:, 0])
    motion, scale = agrees(bar, branch, start, phi, screws, wanted[:, 0])
    scale *= 1 + max(float(abs(wanted).max()), float(abs(shifts).max()), 1 / sine**3)
    for column, joint in ((1, 1), (2, 3)):
        assert abs(motion.joint(joint, "Tz")[1] - shifts[column - 1]) < 1e-12 * scale
        for order in (1, 2, 3):
            assert abs(motion.joint(joint, "Tz", order=order)[1] - wanted[order - 1, column]) < 1e-11 * scale


@pytest.mark.parametrize("seeds", SIZES)
def test_random_spherical_four_bars_and_rccc_with_their_directions(seeds):
    for seed in seeds:
        check_spherical_and_rccc(seed)
