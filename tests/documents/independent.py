"""Own computations of what the teaching documents do not print: circles, closed forms, differences, sums of freedoms.

Nothing of gruebler is used here (test_facts.py sees to it). Points are complex; lengths a, b, c, d are crank, coupler,
rocker and frame; A0 = 0, B0 = d; angles in degrees.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable
from math import acos, asin, atan2, cos, degrees, radians, sqrt

SIDE = 1e-4  # step of the differences, in radians: error about 1e-12 in first, 1e-7 in second derivatives


def polar(length: float, angle: float) -> complex:
    """The point at a distance, in a direction."""
    return cmath.rect(length, radians(angle))


def meet(p: complex, r: float, q: complex, s: float, side: int = 1) -> complex:
    """Where two circles meet; +1: to the left of the way from p to q."""
    gap = abs(q - p)
    along = (gap * gap + r * r - s * s) / (2 * gap)
    return p + (q - p) / gap * complex(along, side * sqrt(r * r - along * along))


def four_bar(a: float, b: float, c: float, d: float, phi: float, side: int = 1) -> tuple[complex, complex]:
    """The moving joints A and B of a four-bar."""
    crank = polar(a, phi)
    return crank, meet(crank, b, complex(d), c, side)


def on_coupler(a: complex, b: complex, u: float, v: float) -> complex:
    """The point with coordinates u along AB and v to its left."""
    return a + (b - a) / abs(b - a) * complex(u, v)


def slider(a: float, b: float, e: float, phi: float) -> float:
    """Where the slider stands: along its path, which lies e above the pivot of the crank."""
    crank = polar(a, phi)
    return crank.real + sqrt(b * b - (crank.imag - e) ** 2)


def velocity(value: Callable[[float], float | complex], at: float) -> float | complex:
    """The first derivative by an angle (per radian), by differences of fourth order; the angle itself in degrees."""
    h = degrees(SIDE)
    return (8 * (value(at + h) - value(at - h)) - (value(at + 2 * h) - value(at - 2 * h))) / (12 * SIDE)


def acceleration(value: Callable[[float], float | complex], at: float) -> float | complex:
    """The second derivative by an angle (per radian²), by differences of fourth order with a step of 0.002."""
    step = 0.002
    h = degrees(step)
    near, far = value(at + h) + value(at - h), value(at + 2 * h) + value(at - 2 * h)
    return (16 * near - far - 30 * value(at)) / (12 * step * step)


def direction(point: complex) -> float:
    """The angle of a way."""
    return degrees(cmath.phase(point))


def enclosed(x: float, y: float, opposite: float) -> float:
    """The angle between two sides of a triangle."""
    return degrees(acos((x * x + y * y - opposite * opposite) / (2 * x * y)))


def freedoms(n: int, joints: dict[int, int], b: int = 3) -> int:
    """F = b(n - 1) - sum (b - f), section 2.5."""
    return b * (n - 1) - sum((b - f) * count for f, count in joints.items())


def turns(a: float, b: float, c: float, d: float) -> bool:
    """Whether the crank a can stand in every direction: its end is always within reach of b and c."""
    return abs(b - c) <= abs(d - a) and a + d <= b + c


# --- dead centres ------------------------------------------------------------------------------------


def slider_ends(a: float, b: float, e: float = 0.0) -> tuple[float, float]:
    """l_i and l_a of a slider-crank."""
    return sqrt((b - a) ** 2 - e * e), sqrt((a + b) ** 2 - e * e)


def slider_delta(a: float, b: float, e: float) -> float:
    """How far the crank's turn from one dead centre to the other differs from 180 degrees."""
    return degrees(asin(abs(e) / (b - a)) - asin(abs(e) / (a + b)))


def rocker_ends(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """The angles phi_i and phi_a of the lines through crank and coupler against the frame."""
    return enclosed(b - a, d, c), enclosed(b + a, d, c)


def swing(a: float, b: float, c: float, d: float) -> float:
    """The swing of the rocker: the difference of its angles in the dead centres."""
    return enclosed(c, d, a + b) - enclosed(c, d, b - a)


def middle(a: float, b: float) -> float:
    """The crank angle from the outer dead centre at which a central slider has half its stroke behind it, s = b."""
    return degrees(acos(a / (2 * b)))


# --- section 3.5 and 001 -----------------------------------------------------------------------------


def lambda_point(unit: float, phi: float) -> complex:
    """C of the crank-rocker 1 : 2.5 : 2.5 : 2 with BC = 2.5 beyond B."""
    a, b = four_bar(unit, 2.5 * unit, 2.5 * unit, 2 * unit, phi)
    return 2 * b - a


def conchoid_point(a: float, d: float, b: float, phi: float) -> complex:
    """C on the ray from A through B0, b from A."""
    crank = polar(a, phi)
    ray = d - crank
    return crank + b * ray / abs(ray)


def watt_point(rocker: float, coupler: float, turn: float) -> complex:
    """The middle of the coupler when the left rocker is turned up from the level position."""
    left, right = complex(-rocker, coupler / 2), complex(rocker, -coupler / 2)
    a = left + polar(rocker, turn)
    return (a + meet(a, coupler, right, rocker, -1)) / 2


def crane_point(phi: float, frame: float) -> complex:
    """C of exercise 19: d = 100 at phi, frame 60 in a direction, b = 80, coupler 30, AC = 60 beyond the joint of d."""
    joint, pivot = polar(100, phi), polar(60, frame)
    a = meet(pivot, 80, joint, 30, -1)
    return a + 2 * (joint - a)


def strip(points: list[complex]) -> tuple[float, float]:
    """The narrowest strip that holds the points, of directions near that of the whole way, and its length."""

    def width(angle: float) -> float:
        across = [(point / cmath.rect(1, angle)).imag for point in points]
        return max(across) - min(across)

    best, step = cmath.phase(points[-1] - points[0]), 0.05
    while step > 1e-12:
        best = min((best - step, best, best + step), key=width)
        step *= 0.9
    along = [(point / cmath.rect(1, best)).real for point in points]
    return width(best), max(along) - min(along)


def replacement_point(phi: float) -> complex:
    """K of the crank-rocker of sheet 001, l1 = 1: AK = 25/3, BK = l2, to the left of AB."""
    long = 2.5 * sqrt(3)
    a, b = four_bar(1, long, long, 4, phi)
    return meet(a, 25 / 3, b, long)


def root(value: Callable[[float], float], low: float, high: float) -> float:
    """Where a function changes its sign, by halving."""
    for _ in range(200):
        mid = (low + high) / 2
        low, high = (mid, high) if (value(low) > 0) == (value(mid) > 0) else (low, mid)
    return (low + high) / 2


def straight_length(half: float) -> tuple[float, float]:
    """Length along the tangent of sheet 001 and deviation from it, for the crank angles 180 - half to 180 + half.

    The tangent leans by kappa = arccos(5 sqrt 3 / 9); the deviation grows from its middle to its ends.
    """
    along = cmath.rect(1, acos(5 * sqrt(3) / 9))
    first, mid, last = (replacement_point(phi) / along for phi in (180 - half, 180, 180 + half))
    return abs(first.real - last.real), abs(first.imag - mid.imag)


def sheet_example(ratio: float = 0.005, length: float = 15.0) -> tuple[float, float, float, float]:
    """phi_G, phi_A, L/l1 and l1 of the example of sheet 001."""

    def excess(half: float) -> float:
        long, deviation = straight_length(half)
        return deviation / long - ratio

    half = root(excess, 40.0, 120.0)
    long = straight_length(half)[0]
    return 2 * half, 180 - half, long, length / long


def lever(ratio: float) -> dict[str, float]:
    """Meyer zur Capellen's double rocker for D = 1 from lambda, with Euler and Savary on the pole ray of A'.

    A' lies on a ray through the pole P under phi0 at the height lambda above the pole tangent; its centre of curvature
    A0' is at the distance PA'^2/(PA' - sin phi0) behind A'; K is the inflection pole, 1 above P.
    """
    sine = sqrt((1 + 2 * ratio) / 4)
    tangent = sine / sqrt(1 - sine * sine)
    reach = ratio / sine
    arm = reach * reach / (reach - sine)
    joint = complex(-ratio / tangent, ratio)
    centre = joint - arm * joint / abs(joint)
    side = abs(complex(0, 1) - joint)
    return {
        "phi0": degrees(asin(sine)),
        "l1": arm,
        "l2": 2 * abs(joint.real),
        "l4": 2 * abs(centre.real),
        "k": side,
        "kappa": degrees(atan2(1 - ratio, abs(joint.real))),
    }


def lambdas(kappa: float) -> list[float]:
    """Both lambda between 0.5 and 1.5 with lambda^2 (3 - 2 lambda) = 1/(1 + tan^2 kappa): it is 1 at most, at 1."""
    wanted = cos(radians(kappa)) ** 2
    return [root(lambda x: x * x * (3 - 2 * x) - wanted, *ends) for ends in ((0.5, 1.0), (1.0, 1.5))]


def smallest(values: Iterable[float]) -> float:
    """The smallest of angles that are at most 90, or are taken from 180."""
    return min(min(value, 180 - value) for value in values)
