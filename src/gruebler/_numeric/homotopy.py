"""Paths of four-bars from one task of positions and points to another, in isotropic coordinates.

The unknowns z are x, x*, y, y* (moving pivots in the first position) and a, a*, b, b* (fixed pivots), conjugates being
independent of each other; the coupler point of the first position is the origin. docs/theory/synthesis-points.md has
the equations and the control of the steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit

Complexes = NDArray[np.complex128]
Reals = NDArray[np.float64]
Ints = NDArray[np.int64]

ARRIVED, FAILED, INFINITE = 0, 1, 2
"""How a path ended: at a finite solution; steps too small or too many; growing without bound."""

UNKNOWNS = 8
_FAR = 1e8  # a solution so many sizes away is at infinity
_LARGE = 30.0  # sizes: beyond it terms of degree seven cancel, so that residuals are computed with twice the digits
_FINE = 1e-4  # paths followed with finer steps have twice the digits throughout: near singular solutions need them
_SHORTEST = 1e-10
_MOST = 20000


@njit(cache=True, error_model="numpy", nogil=True)
def evaluate_system(
    z: Complexes, p: Complexes, dp: Complexes, poses: int, points: int, f: Complexes, jac: Complexes, ft: Complexes
) -> None:
    """The equations, their derivatives by z and along the path.

    Args:
        z: (8,) the unknowns.
        p: (4, 8) parameters: displacements d and their conjugates of the positions, then of the points; rotations g of
            the positions (exp(i angle) - 1); values that fix the last unknowns.
        dp: (4, 8) how fast the parameters change.
        poses: how many positions besides the first: two equations each.
        points: how many points: one equation each. The rest of the eight equations fixes unknowns of those numbers.
        f: (8,) written.
        jac: (8, 8) written.
        ft: (8,) written.
    """
    x, xb, y, yb, a, ab, b, bb = z[0], z[1], z[2], z[3], z[4], z[5], z[6], z[7]
    for i in range(UNKNOWNS):
        f[i] = z[0] * 0
        ft[i] = z[0] * 0
        for k in range(UNKNOWNS):
            jac[i, k] = z[0] * 0
    for j in range(poses):
        t, s, g = p[0, j], p[1, j], p[2, j]
        dt, ds, dg = dp[0, j], dp[1, j], dp[2, j]
        h = -g / (1 + g)
        dh = -dg / ((1 + g) * (1 + g))
        r = 2 * j
        f[r] = x * (ab - s) * g + xb * (a - t) * h + t * (ab - xb) + s * (a - x) - t * s
        jac[r, 0] = (ab - s) * g - s
        jac[r, 1] = (a - t) * h - t
        jac[r, 4] = xb * h + s
        jac[r, 5] = x * g + t
        ft[r] = (-xb * h + (ab - xb) - s) * dt + (-x * g + (a - x) - t) * ds + x * (ab - s) * dg + xb * (a - t) * dh
        r = 2 * j + 1
        f[r] = y * (bb - s) * g + yb * (b - t) * h + t * (bb - yb) + s * (b - y) - t * s
        jac[r, 2] = (bb - s) * g - s
        jac[r, 3] = (b - t) * h - t
        jac[r, 6] = yb * h + s
        jac[r, 7] = y * g + t
        ft[r] = (-yb * h + (bb - yb) - s) * dt + (-y * g + (b - y) - t) * ds + y * (bb - s) * dg + yb * (b - t) * dh
    for q in range(points):
        j = poses + q
        m = 2 * poses + q
        t, s, dt, ds = p[0, j], p[1, j], dp[0, j], dp[1, j]
        a1 = x * (ab - s)
        b1 = xb * (a - t)
        c1 = t * (ab - xb) + s * (a - x) - t * s
        a2 = y * (bb - s)
        b2 = yb * (b - t)
        c2 = t * (bb - yb) + s * (b - y) - t * s
        first = b1 * c2 - b2 * c1
        second = c1 * a2 - c2 * a1
        both = a1 * b2 - a2 * b1
        by_first = both + second
        by_second = both + first
        by_both = first + second
        by_a1 = -by_second * c2 + by_both * b2
        by_b1 = by_first * c2 - by_both * a2
        by_c1 = -by_first * b2 + by_second * a2
        by_a2 = by_second * c1 - by_both * b1
        by_b2 = -by_first * c1 + by_both * a1
        by_c2 = by_first * b1 - by_second * a1
        f[m] = by_both * both + first * second
        jac[m, 0] = by_a1 * (ab - s) - by_c1 * s
        jac[m, 1] = by_b1 * (a - t) - by_c1 * t
        jac[m, 2] = by_a2 * (bb - s) - by_c2 * s
        jac[m, 3] = by_b2 * (b - t) - by_c2 * t
        jac[m, 4] = by_b1 * xb + by_c1 * s
        jac[m, 5] = by_a1 * x + by_c1 * t
        jac[m, 6] = by_b2 * yb + by_c2 * s
        jac[m, 7] = by_a2 * y + by_c2 * t
        ft[m] = (-by_b1 * xb + by_c1 * (ab - xb - s) - by_b2 * yb + by_c2 * (bb - yb - s)) * dt + (
            -by_a1 * x + by_c1 * (a - x - t) - by_a2 * y + by_c2 * (b - y - t)
        ) * ds
    for r in range(2 * poses + points, UNKNOWNS):
        f[r] = z[r] - p[3, r]
        jac[r, r] = z[0] * 0 + 1
        ft[r] = -dp[3, r]


DoubleDouble = tuple[float, float, float, float]
"""A complex number as unevaluated sums: real part, what rounding left of it, imaginary part, what is left of that."""


@njit(cache=True, error_model="numpy", nogil=True)
def _product(a: float, b: float) -> tuple[float, float]:
    """A product and its rounding error, exact (Dekker)."""
    p = a * b
    t = 134217729.0 * a
    ah = t - (t - a)
    al = a - ah
    t = 134217729.0 * b
    bh = t - (t - b)
    bl = b - bh
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


@njit(cache=True, error_model="numpy", nogil=True)
def _sum(a: float, al: float, b: float, bl: float) -> tuple[float, float]:
    """The sum of two numbers of twice the digits."""
    s = a + b
    t = s - a
    e = ((a - (s - t)) + (b - t)) + (al + bl)
    h = s + e
    return h, e - (h - s)


@njit(cache=True, error_model="numpy", nogil=True)
def _times(a: float, al: float, b: float, bl: float) -> tuple[float, float]:
    """The product of two numbers of twice the digits."""
    p, e = _product(a, b)
    e += a * bl + al * b
    h = p + e
    return h, e - (h - p)


@njit(cache=True, error_model="numpy", nogil=True)
def _exact(z: complex) -> DoubleDouble:
    """A complex number with nothing left of rounding."""
    return z.real, 0.0, z.imag, 0.0


@njit(cache=True, error_model="numpy", nogil=True)
def _add(u: DoubleDouble, v: DoubleDouble) -> DoubleDouble:
    re, rl = _sum(u[0], u[1], v[0], v[1])
    im, il = _sum(u[2], u[3], v[2], v[3])
    return re, rl, im, il


@njit(cache=True, error_model="numpy", nogil=True)
def _subtract(u: DoubleDouble, v: DoubleDouble) -> DoubleDouble:
    re, rl = _sum(u[0], u[1], -v[0], -v[1])
    im, il = _sum(u[2], u[3], -v[2], -v[3])
    return re, rl, im, il


@njit(cache=True, error_model="numpy", nogil=True)
def _multiply(u: DoubleDouble, v: DoubleDouble) -> DoubleDouble:
    a, al = _times(u[0], u[1], v[0], v[1])
    b, bl = _times(u[2], u[3], v[2], v[3])
    c, cl = _times(u[0], u[1], v[2], v[3])
    d, dl = _times(u[2], u[3], v[0], v[1])
    re, rl = _sum(a, al, -b, -bl)
    im, il = _sum(c, cl, d, dl)
    return re, rl, im, il


@njit(cache=True, error_model="numpy", nogil=True)
def sharp_residuals(z: Complexes, p: Complexes, poses: int, points: int, f: Complexes) -> None:
    """The equations of `evaluate_system` with twice the digits: 32 of them, rounded at the end.

    Args:
        z: (8,) the unknowns.
        p: (4, 8) parameters, as in `evaluate_system`.
        poses: as in `evaluate_system`.
        points: as in `evaluate_system`.
        f: (8,) written.
    """
    one = _exact(1.0 + 0.0j)
    for j in range(poses + points):
        t, s = _exact(p[0, j]), _exact(p[1, j])
        ts = _multiply(t, s)
        # The condition of each dyad: A g + B h + C = 0, with h = -g/(1 + g).
        x, xb, a, ab = _exact(z[0]), _exact(z[1]), _exact(z[4]), _exact(z[5])
        a1 = _multiply(x, _subtract(ab, s))
        b1 = _multiply(xb, _subtract(a, t))
        c1 = _subtract(_add(_multiply(t, _subtract(ab, xb)), _multiply(s, _subtract(a, x))), ts)
        y, yb, b, bb = _exact(z[2]), _exact(z[3]), _exact(z[6]), _exact(z[7])
        a2 = _multiply(y, _subtract(bb, s))
        b2 = _multiply(yb, _subtract(b, t))
        c2 = _subtract(_add(_multiply(t, _subtract(bb, yb)), _multiply(s, _subtract(b, y))), ts)
        if j < poses:
            g = _exact(p[2, j])
            turned = _add(one, g)
            near = -p[2, j] / (1 + p[2, j])
            rest = _add(g, _multiply(_exact(near), turned))  # what rounding left of the quotient
            lost = -complex(rest[0], rest[2]) / (1 + p[2, j])
            h = _add(_exact(near), _exact(lost))
            v = _add(_add(_multiply(a1, g), _multiply(b1, h)), c1)
            f[2 * j] = complex(v[0], v[2])
            v = _add(_add(_multiply(a2, g), _multiply(b2, h)), c2)
            f[2 * j + 1] = complex(v[0], v[2])
        else:
            first = _subtract(_multiply(b1, c2), _multiply(b2, c1))
            second = _subtract(_multiply(c1, a2), _multiply(c2, a1))
            both = _subtract(_multiply(a1, b2), _multiply(a2, b1))
            by_both = _add(first, second)
            v = _add(_multiply(by_both, both), _multiply(first, second))
            f[poses + j] = complex(v[0], v[2])
    for r in range(2 * poses + points, UNKNOWNS):
        f[r] = z[r] - p[3, r]


@njit(cache=True, error_model="numpy", nogil=True)
def _solve(matrix: Complexes, right: Complexes) -> bool:
    """Gauss with row scaling and pivoting, in place; False for a singular matrix."""
    n = UNKNOWNS
    for i in range(n):
        largest = 0.0
        for k in range(n):
            v = abs(matrix[i, k].real) + abs(matrix[i, k].imag)
            largest = max(largest, v)
        if not largest > 0.0 or largest > 1e300:
            return False
        scale = 1.0 / largest
        for k in range(n):
            matrix[i, k] *= scale
        right[i] *= scale
    for k in range(n):
        pivot = k
        largest = 0.0
        for i in range(k, n):
            v = abs(matrix[i, k].real) + abs(matrix[i, k].imag)
            if v > largest:
                largest = v
                pivot = i
        if not largest > 0.0:
            return False
        if pivot != k:
            for c in range(k, n):
                swap = matrix[k, c]
                matrix[k, c] = matrix[pivot, c]
                matrix[pivot, c] = swap
            swap = right[k]
            right[k] = right[pivot]
            right[pivot] = swap
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] * inverse
            for c in range(k + 1, n):
                matrix[i, c] -= factor * matrix[k, c]
            right[i] -= factor * right[k]
    for i in range(n - 1, -1, -1):
        v = right[i]
        for c in range(i + 1, n):
            v -= matrix[i, c] * right[c]
        right[i] = v / matrix[i, i]
    return True


@njit(cache=True, error_model="numpy", nogil=True)
def _norm(v: Complexes) -> float:
    largest = 0.0
    for i in range(UNKNOWNS):
        largest = max(largest, abs(v[i]))
    return largest


@njit(cache=True, error_model="numpy", nogil=True)
def _relative(step: Complexes, z: Complexes) -> float:
    """The largest change of an unknown, relative to it; small ones count against the largest of all."""
    size = 1e-3 * _norm(z)
    largest = 0.0
    for i in range(UNKNOWNS):
        largest = max(largest, abs(step[i]) / (abs(z[i]) + size + 1e-300))
    return largest


@njit(cache=True, error_model="numpy", nogil=True)
def refine_solutions(z: Complexes, p: Complexes, poses: int, points: int, steps: Reals) -> None:
    """Newton's method for many solutions of one task; the last relative step of each is written.

    Args:
        z: (solutions, 8) changed.
        p: (4, 8) parameters, as in `evaluate_system`.
        poses: as in `evaluate_system`.
        points: as in `evaluate_system`.
        steps: (solutions,) written; infinite where the matrix is singular.
    """
    f = np.empty(UNKNOWNS, np.complex128)
    ft = np.empty(UNKNOWNS, np.complex128)
    jac = np.empty((UNKNOWNS, UNKNOWNS), np.complex128)
    still = np.zeros((4, UNKNOWNS), np.complex128)
    for n in range(len(z)):
        steps[n] = np.inf
        for _ in range(8):
            evaluate_system(z[n], p, still, poses, points, f, jac, ft)
            sharp_residuals(z[n], p, poses, points, f)  # of ill-conditioned solutions near by, too
            if not _solve(jac, f):
                steps[n] = np.inf
                break
            for i in range(UNKNOWNS):
                z[n, i] -= f[i]
            last = steps[n]
            steps[n] = _relative(f, z[n])
            if steps[n] < 1e-15 or (last < 1e-12 and steps[n] > 0.5 * last):
                break


@njit(cache=True, error_model="numpy", nogil=True)
def track(
    starts: Complexes,
    begin: Complexes,
    end: Complexes,
    poses: int,
    points: int,
    loose: float,
    out: Complexes,
    status: Ints,
    work: Ints,
) -> None:
    """Follow solutions while the parameters go straight from one task to another.

    Predictor of Runge and Kutta, corrector of Newton; a step is taken if the corrector changes the prediction by less
    than ``loose`` and converges at once.

    Args:
        starts: (paths, 8) solutions of the begin.
        begin: (4, 8) parameters.
        end: (4, 8) parameters.
        poses: as in `evaluate_system`.
        points: as in `evaluate_system`.
        loose: 1e-3 is quick; 1e-6 keeps paths apart that come near each other, and computes residuals with twice the
            digits throughout.
        out: (paths, 8) written: where the path ended.
        status: (paths,) written: ARRIVED, FAILED or INFINITE.
        work: (paths,) written: steps taken.
    """
    n = UNKNOWNS
    f = np.empty(n, np.complex128)
    ft = np.empty(n, np.complex128)
    jac = np.empty((n, n), np.complex128)
    dp = end - begin
    p = np.empty((4, n), np.complex128)
    slopes = np.empty((4, n), np.complex128)
    z = np.empty(n, np.complex128)
    w = np.empty(n, np.complex128)
    for path in range(len(starts)):
        for i in range(n):
            z[i] = starts[path, i]
        at = 0.0
        h = 0.02
        good = 0
        steps = 0
        ended = ARRIVED
        while at < 1.0:
            steps += 1
            if steps > _MOST or h < _SHORTEST:
                ended = INFINITE if _norm(z) > 1e4 else FAILED
                break
            h = min(h, 1.0 - at)
            possible = True
            for stage in range(4):
                here = at + h * (0.0 if stage == 0 else (1.0 if stage == 3 else 0.5))
                for k in range(4):
                    for i in range(n):
                        p[k, i] = begin[k, i] + here * dp[k, i]
                for i in range(n):
                    w[i] = z[i]
                    if stage == 3:
                        w[i] += h * slopes[2, i]
                    elif stage > 0:
                        w[i] += 0.5 * h * slopes[stage - 1, i]
                evaluate_system(w, p, dp, poses, points, f, jac, ft)
                if not _solve(jac, ft):
                    possible = False
                    break
                for i in range(n):
                    slopes[stage, i] = -ft[i]
            taken = False
            quick = False
            if possible:
                for i in range(n):
                    w[i] = z[i] + h / 6 * (slopes[0, i] + 2 * slopes[1, i] + 2 * slopes[2, i] + slopes[3, i])
                last = 1e300
                for turn in range(3):
                    evaluate_system(w, p, dp, poses, points, f, jac, ft)
                    if loose < _FINE or _norm(w) > _LARGE:
                        sharp_residuals(w, p, poses, points, f)
                    if not _solve(jac, f):
                        break
                    for i in range(n):
                        w[i] -= f[i]
                    change = _relative(f, w)
                    if not change < loose:
                        break
                    # Far out rounding alone leaves 1e-8; a third correction of that size is as good as it gets.
                    if change < (1e-9 if turn < 2 else 1e-7):
                        taken = True
                        quick = turn == 0
                        break
                    if turn > 0 and change > 0.1 * last:
                        break
                    last = change
            if taken:
                at += h
                for i in range(n):
                    z[i] = w[i]
                if _norm(z) > _FAR:
                    ended = INFINITE
                    break
                good += 1
                if good >= 2:
                    h *= 1.6
                    good = 0
                if quick:
                    h *= 1.5
            else:
                h *= 0.4
                good = 0
        for i in range(n):
            out[path, i] = z[i]
        status[path] = ended
        work[path] = steps
