"""Registers for many rows of a motion at once: rows of `LANES` numbers at fixed places of one array.

The compiler knows that they do not overlap, and makes loops over them that work on several numbers at a time; but only
if an index cannot be negative (else it would count from the end): loops start at 0, in slices where the place is not a
constant. A pair of registers is a row of points x + iy; the derivatives of a point are four pairs.
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.lanes import choose, complex_number, lanes, tally
from gruebler._numeric.motion.program import PoseBuffer

__all__ = [
    "LANES",
    "PAIR",
    "REGISTERS",
    "ROOT",
    "A",
    "B",
    "D",
    "E",
    "P",
    "Q",
    "T",
    "U",
    "V",
    "W",
    "circle",
    "copy",
    "load_register",
    "point",
    "put",
    "rotate",
]  # fmt: skip

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]

LANES = 128
PAIR = 2 * LANES

# P, Q: jets of the two outer joints; T, U: turns of the two bodies; V, W: their rates; A, B: arms from outer to inner
# joint; D: what all orders are divided by; ROOT: the signed root; E: a turned vector; F: rates of a link
P, Q, T, U, V, W, A, B, D, ROOT, E, F = (k * LANES for k in (0, 8, 16, 18, 20, 23, 26, 28, 30, 31, 32, 34))
REGISTERS = 37 * LANES


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def load_register(source: Complexes, x: Reals, to: int) -> None:
    real, imag = x[to : to + LANES], x[to + LANES : to + PAIR]
    for i in lanes(len(source)):
        real[i], imag[i] = source[i].real, source[i].imag


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def store_register(x: Reals, at: int, target: Complexes) -> None:
    real, imag = x[at : at + LANES], x[at + LANES : at + PAIR]
    for i in lanes(len(target)):
        target[i] = complex_number(real[i], imag[i])


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def copy(source: Reals, target: Reals) -> None:
    for i in lanes(min(len(source), len(target))):
        target[i] = source[i]


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def rotate(x: Reals, turn: int, by: complex, to: int) -> None:
    for i in lanes(LANES):
        a, b = x[turn + i], x[turn + LANES + i]
        x[to + i] = a * by.real - b * by.imag
        x[to + LANES + i] = a * by.imag + b * by.real


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def add_arm(order: int, sign: float, arm: int, rates: int, x: Reals, to: int) -> None:
    """Add a turning vector and its derivatives to a jet."""
    for i in lanes(LANES):
        x[to + i] += sign * x[arm + i]
        x[to + LANES + i] += sign * x[arm + LANES + i]
    if order >= 1:
        for i in lanes(LANES):
            w = sign * x[rates + i]
            x[to + PAIR + i] -= w * x[arm + LANES + i]
            x[to + PAIR + LANES + i] += w * x[arm + i]
    if order >= 2:
        for i in lanes(LANES):
            w, a = x[rates + i], sign * x[rates + LANES + i]
            w *= sign * w
            x[to + 2 * PAIR + i] -= w * x[arm + i] + a * x[arm + LANES + i]
            x[to + 2 * PAIR + LANES + i] += a * x[arm + i] - w * x[arm + LANES + i]
    if order >= 3:
        for i in lanes(LANES):
            w, a, j = x[rates + i], x[rates + LANES + i], x[rates + 2 * LANES + i]
            real, imag = -3 * sign * w * a, sign * (j - w * w * w)
            x[to + 3 * PAIR + i] += real * x[arm + i] - imag * x[arm + LANES + i]
            x[to + 3 * PAIR + LANES + i] += real * x[arm + LANES + i] + imag * x[arm + i]


@njit(cache=True, error_model="numpy", _nrt=False)
def point(
    order: int, link: int, point: complex, fixed: bool, poses: PoseBuffer, row: int, end: int, x: Reals, to: int
) -> None:
    """The jet of a link's point in some rows; of a fixed link, the point."""
    if fixed:
        x[to : to + LANES] = point.real
        x[to + LANES : to + PAIR] = point.imag
        x[to + PAIR : to + (order + 1) * PAIR] = 0
        return
    for k in range(order + 1):
        load_register(poses.places[k, link, row:end], x, to + k * PAIR)
    if point == 0:
        return
    load_register(poses.turns[link, row:end], x, E)
    rotate(x, E, point, E)
    for k in range(order):
        copy(poses.rates[k, link, row:end], x[F + k * LANES : F + (k + 1) * LANES])
    if to == P:
        add_arm(order, 1.0, E, F, x, P)
    else:
        add_arm(order, 1.0, E, F, x, Q)


@njit(cache=True, error_model="numpy", _nrt=False)
def put(order: int, link: int, point: complex, first: bool, poses: PoseBuffer, row: int, end: int, x: Reals) -> None:
    """Write some rows of a link whose point lies where jet P (of the first body) or Q (of the second) says."""
    turn, spin, at = (T, V, P) if first else (U, W, Q)
    store_register(x, turn, poses.turns[link, row:end])
    for k in range(order):
        copy(x[spin + k * LANES : spin + (k + 1) * LANES], poses.rates[k, link, row:end])
    if point != 0:
        if first:
            rotate(x, T, point, E)
            add_arm(order, -1.0, E, V, x, P)
        else:
            rotate(x, U, point, E)
            add_arm(order, -1.0, E, W, x, Q)
    for k in range(order + 1):
        store_register(x, at + k * PAIR, poses.places[k, link, row:end])


_HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
_REDUCED = 1e5  # radians: up to here three parts of pi / 2 leave an error below an ulp
_SHIFT = 6755399441055744.0  # adding it and taking it off again rounds to a whole number


@njit(cache=True, error_model="numpy", _nrt=False)
def circle(x: Reals) -> None:
    """Cosine and sine of register E into the pair A, to an ulp: quarter turns off, then the polynomials of fdlibm."""
    near = 0
    for i in lanes(LANES):
        near += tally(abs(x[E + i]) < _REDUCED)
    if near < LANES:
        for i in range(LANES):
            x[A + i], x[A + LANES + i] = cos(x[E + i]), sin(x[E + i])
        return
    for i in lanes(LANES):
        angle = x[E + i]
        n = (angle * (2 / pi) + _SHIFT) - _SHIFT
        r = ((angle - n * _HALF_PI[0]) - n * _HALF_PI[1]) - n * _HALF_PI[2]
        quarter = n - 4 * ((n * 0.25 + _SHIFT) - _SHIFT)  # -2 to 2
        z = r * r
        s = 1.58969099521155010221e-10 * z - 2.50507602534068634195e-08
        s = (s * z + 2.75573137070700676789e-06) * z - 1.98412698298579493134e-04
        s = (s * z + 8.33333333332248946124e-03) * z - 1.66666666666666324348e-01
        s = r + r * z * s
        c = -1.13596475577881948265e-11 * z + 2.08757232129817482790e-09
        c = (c * z - 2.75573143513906633035e-07) * z + 2.48015872894767294178e-05
        c = (c * z - 1.38888888888741095749e-03) * z + 4.16666666666666019037e-02
        half = 0.5 * z
        high = 1 - half
        c = high + (((1 - high) - half) + z * z * c)
        odd = abs(quarter) == 1
        real, imag, half_turn = choose(odd, s, c), choose(odd, c, s), abs(quarter) == 2
        x[A + i] = choose((quarter == 1) | half_turn, -real, real)
        x[A + LANES + i] = choose((quarter == -1) | half_turn, -imag, imag)
