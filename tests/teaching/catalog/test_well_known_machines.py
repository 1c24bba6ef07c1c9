"""Well-known machines of the catalog: what they claim of their motion, by circles, triangles and bar lengths alone."""

import numpy as np
import pytest
from scipy.optimize import root

from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entry

DEG = np.pi / 180


def polar(radius, degrees):
    return radius * np.exp(1j * DEG * np.asarray(degrees))


def circles(p, r, q, s, side):
    """Where the circles about p and q of radii r and s meet, on one side of the line p-q."""
    line = q - p
    x = (abs(line) ** 2 + r * r - s * s) / (2 * abs(line))
    return p + line / abs(line) * (x + side * 1j * np.sqrt(r * r - x * x))


def side_of(p, q, x):
    return 1 if ((x - p) / (q - p)).imag > 0 else -1


def follow(p, q, was_p, was_q, was_x):
    """The place of x when p and q have moved, joined to both by bars."""
    return circles(p, abs(was_x - was_p), q, abs(was_x - was_q), side_of(was_p, was_q, was_x))


def carried(p, q, was_p, was_q, was_x):
    """The place of a point of the body through p and q."""
    return p + (was_x - was_p) * (q - p) / (was_q - was_p)


def swing(z):
    return np.ptp(np.unwrap(np.angle(z))) / DEG


def claimed(id):
    return [claim.numbers for claim in entry(id).quantities]


def test_klanns_leg_stands_and_lifts_its_foot():
    pin, low_pivot, low, high_pivot, high = -1.5 - 36.5j, -97.6 - 46.1j, -95.9 + 14.6j, -87.8 + 32.6j, -82 + 123.6j
    knee, foot = -158.4 + 71.6j, -313.7 - 122.5j

    def path(degrees):
        crank = polar(abs(pin), degrees)
        corner = follow(crank, low_pivot, pin, low_pivot, low)
        knees = carried(crank, corner, pin, low, knee)
        return carried(knees, follow(knees, high_pivot, knee, high_pivot, high), knee, high, foot)

    step, whole = path(np.linspace(50, 150, 2001)), path(np.linspace(0, 360, 7201))
    straight, lift = claimed("klann")
    assert straight == pytest.approx({"length": np.ptp(step.real), "band": np.ptp(step.imag)}, rel=1e-4)
    assert lift["length"] == pytest.approx(np.ptp(whole.imag), rel=1e-4)


def test_the_strider_by_its_six_lengths():
    """Crank 1, pivots 2 away at 45 degrees, rocker 1.8, coupler 2.6, arm 1.4 turned by pi + 0.2, leg 2.5, link 1.8."""

    def foot(degrees):
        pin = polar(1, degrees)
        knee, other = circles(polar(2, 45), 1.8, pin, 2.6, 1), circles(polar(2, 135), 1.8, pin, 2.6, -1)
        arm = pin + 1.4 * (knee - pin) / abs(knee - pin) * np.exp(-1j * (np.pi + 0.2))
        return 20 * circles(other, 2.5, arm, 1.8, -1)

    step, whole = foot(np.linspace(-80, -20, 2001)), foot(np.linspace(0, 360, 7201))
    straight, lift = claimed("strider")
    assert straight == pytest.approx({"length": np.ptp(step.real), "band": np.ptp(step.imag)}, rel=1e-4)
    assert lift["length"] == pytest.approx(np.ptp(whole.imag), rel=1e-4)


def test_hoecken_as_printed():
    """Norton, table 3-1, 120 degrees of the crank: way 3.238 cranks (lengths rounded), straight to 0.010 %."""
    (straight,) = claimed("hoecken")
    assert straight["length"] / 20 == pytest.approx(3.238, abs=0.001)
    assert straight["band"] / straight["length"] == pytest.approx(0.00010, abs=0.000005)
    pin = polar(20, np.linspace(120, 240, 4001))
    point = 2 * circles(pin, 68.76, 52.5, 68.76, -1) - pin
    assert straight == pytest.approx({"length": np.ptp(point.real), "band": np.ptp(point.imag)}, rel=1e-3)


def test_a_pantograph_doubles_every_drawing():
    linkage = entry("pantograph").linkage()
    arm = np.arctan2(240, 150)
    path = np.array([arm, -2 * arm]) + np.cumsum(np.random.default_rng(31).uniform(-0.1, 0.1, (9, 2)), axis=0)
    motion = move(linkage, path)
    assert motion.complete
    assert motion.point("Z") == pytest.approx(2 * motion.point("S"), abs=1e-9)
    tracer, pen = claimed("pantograph")
    assert pen["length"] == pytest.approx(2 * tracer["length"], rel=1e-5)
    # the tracer lies 150 from the pole while the arms keep their angle
    assert tracer["length"] == pytest.approx(150 * np.ptp(np.cos(DEG * np.linspace(-20, 40, 6001) - arm)), rel=1e-4)


def test_wipers_swing_against_each_other():
    pin, whole = 40j, np.linspace(0, 360, 7201)
    angles = [
        follow(polar(40, whole), pivot, pin, pivot, was) - pivot
        for pivot, was in ((-300, -300 + 60j), (300, 300 - 60j))
    ]
    left, right, *ratios = claimed("wiper_opposed")
    assert left["degrees"] == pytest.approx(swing(angles[0]), rel=1e-4)
    assert right["degrees"] == pytest.approx(swing(angles[1]), rel=1e-4)
    for ratio, angle in zip(ratios, angles, strict=True):
        rate = np.gradient(np.unwrap(np.angle(angle)), DEG * whole)[1200:2401]
        assert ratio == pytest.approx({"least": rate.min(), "greatest": rate.max()}, rel=1e-4)
    assert ratios[0]["least"] > 0 > ratios[1]["greatest"]


def test_an_umbrella_by_two_equal_bars():
    """Rib and stretcher are both 230 long to their pin: the runner hangs 2 * 230 * sin(slope) below the top."""
    slopes = [np.arcsin(down / 460) / DEG for down in (119.0568, 119.0568 + 320)]
    _, right, left = claimed("umbrella")
    assert slopes[0] == pytest.approx(15, abs=1e-3)
    assert right["degrees"] == left["degrees"] == pytest.approx(slopes[1] - slopes[0], rel=1e-5)


def test_a_folding_chair_by_its_triangle():
    cross, hinge, pin = 23.58 + 27.91j, 15 + 42.5j, 38.52 + 42.5j
    seat = cross + polar(abs(pin - cross), np.linspace(44.4, 120.4, 5001)) - hinge
    (swung,) = claimed("folding_chair")
    assert swung["degrees"] == pytest.approx(swing(seat), rel=1e-5)
    assert np.angle(seat[-1] / (-10 + 85j - 40)) / DEG == pytest.approx(0, abs=0.6)  # it lies against the back


def test_the_thigh_bone_rolls_back_as_the_knee_bends():
    front, front_up, rear_up, rear = 10 + 0j, -8 + 28j, 6 + 26j, -15 - 5j
    ends = front + polar(abs(front_up - front), np.linspace(123, 145, 2001))
    others = follow(ends, rear, front_up, rear, rear_up)
    (bent,) = claimed("knee")
    assert bent["degrees"] == pytest.approx(swing(others - ends), rel=1e-5)
    along, across = ends - front, others - rear
    share = ((rear - front) * across.conj()).imag / (along * across.conj()).imag
    pole = front + share * along
    assert (np.diff(pole.real) < 0).all()


def test_bolt_cutter_and_pliers_are_strongest_in_toggle():
    tail, pin, angle = 70 - 20j, 73 + 0j, np.linspace(46, 82, 7201)
    ends = tail + polar(abs(pin - tail), angle)
    upper = follow(ends, 0, pin, 0, tail.conjugate())
    turned, ratio = claimed("bolt_cutter")
    rate = np.gradient(np.unwrap(np.angle(upper)), DEG * angle)
    assert turned["degrees"] == pytest.approx(swing(upper), rel=1e-4)
    assert ratio == pytest.approx({"least": rate.min(), "greatest": rate.max()}, rel=1e-3)
    assert rate.argmin() == len(rate) - 1
    jaw, lever, held = 12 - 20j, 72 - 24j, 108 - 2j
    angle = np.linspace(-172, -148, 7201)
    pins = held + polar(abs(lever - held), angle)
    jaws = follow(pins, 0, lever, 0, jaw)
    (moved,) = claimed("pliers")
    assert moved["degrees"] == pytest.approx(swing(jaws), rel=1e-5)
    shut = np.abs(np.unwrap(np.angle(jaws)) - np.angle(jaws[-1])).argmax()
    assert -172 < angle[shut] < -165  # the knee is stretched within the range
    stretched = (pins[shut] - held) * (jaws[shut] - pins[shut]).conjugate()
    assert np.angle(stretched) / DEG == pytest.approx(0, abs=0.1)


# --- valve gears: six unknowns at once -------------------------------------------------------------------


def traced(start, equations, path):
    """The unknowns along a path of the drives, by Newton's method from each row to the next."""
    rows = [np.array(start, float)]
    for drives in path:
        found = root(equations, rows[-1], args=(drives,), tol=1e-12)
        assert found.success
        rows.append(found.x)
    return np.array(rows[1:])


def stephenson_stroke(lifted):
    """Two eccentrics of 60 at 110 degrees to either side, rods of 800, a link of 300 on a hanger, its arm turned."""
    fore, back = polar(60, 110), polar(60, -110)
    x = fore.real + np.sqrt(800**2 - (150 - fore.imag) ** 2)
    top, shaft, arm = x + 150j, x + 210 + 350j, x + 10 + 350j

    def equations(ends, drives):
        (a, b), (turn, lift) = ends.view(complex), np.exp(1j * DEG * np.array(drives))
        hung = shaft + (arm - shaft) * lift
        return abs(a - fore * turn) - 800, abs(b - back * turn) - 800, abs(a - b) - 300, abs(a - hung) - abs(top - arm)

    path = [(0.0, part) for part in np.linspace(0, lifted, 9)] + [(turn, lifted) for turn in range(361)]
    start = np.array([top, top.conjugate()]).view(float)
    a, b = traced(start, equations, path)[9:].view(complex).T
    return np.ptp((a + a.imag / (a - b).imag * (b - a)).real)


def test_stephensons_gear_opens_least_in_mid_gear():
    (middle,) = claimed("stephenson_gear")
    strokes = [stephenson_stroke(lifted) for lifted in (-30, -15, 0, 15, 30)]
    assert middle["length"] == pytest.approx(strokes[2], rel=1e-3)
    assert strokes[0] > strokes[1] > strokes[2] < strokes[3] < strokes[4]


def test_walschaerts_gear_by_the_lengths_of_its_bars():
    """The lever is parted 80 : 620; the slot passes through the pivot of the link."""
    pin, foot, pivot, was_block, hanger, arm = -90j, 780 + 220j, 800 + 480j, 800 + 370j, 1000 + 375j, 1000 + 600j
    top = 1910 + 480j
    low = top + 700 * (3 / 7 - 1j * np.sqrt(40) / 7)
    joined = top + (low - top) * 80 / 700

    def equations(x, turn):
        block, bottom, valve = complex(x[0], x[1]), complex(x[2], x[3]), complex(x[4], 480)
        crank = polar(300, turn)
        cross = crank.real + np.sqrt(1500**2 - crank.imag**2)
        feet = follow(polar(90, turn - 90), pivot, pin, pivot, foot)
        slot = (pivot - feet) / (pivot - foot)
        end = valve + (bottom - valve) * 80 / 700
        hung = carried(block, end, was_block, joined, hanger)
        return (
            ((block - pivot) / slot).real,
            abs(end - block) - abs(joined - was_block),
            abs(hung - arm) - abs(hanger - arm),
            abs(bottom - valve) - 700,
            abs(bottom - (cross + 10 - 170j)) - abs(low - (1810 - 170j)),
        )

    valve = traced([800, 370, low.real, low.imag, 1910], equations, range(0, 361))[:, 4]
    assert valve[0] == pytest.approx(1910)
    stroke, piston = claimed("walschaerts_gear")
    assert stroke["length"] == pytest.approx(np.ptp(valve), rel=1e-3)
    assert piston["length"] == 2 * 300
