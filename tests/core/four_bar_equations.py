"""The equations of four-bars through positions and points in plain Python, for numbers of any kind."""

import numpy as np


def evaluate(z, p, dp, poses, points):
    """Values (8,), derivatives by the unknowns (8, 8) and along the path (8,), as they stand in the theory.

    z: (8,) x, x*, y, y*, a, a*, b, b*; p, dp: (4, 8) t, s, g and fixed unknowns, and how fast they change.
    """
    x, xb, y, yb, a, ab, b, bb = z
    zero = z[0] * 0
    kind = np.asarray(z).dtype
    f, ft, jac = np.full(8, zero, kind), np.full(8, zero, kind), np.full((8, 8), zero, kind)
    for j in range(poses):
        t, s, g, dt, ds, dg = *p[:3, j], *dp[:3, j]
        h, dh = -g / (1 + g), -dg / ((1 + g) * (1 + g))
        for r, (x1, x2, x3, x4), columns in (
            (2 * j, (x, xb, a, ab), [0, 1, 4, 5]),
            (2 * j + 1, (y, yb, b, bb), [2, 3, 6, 7]),
        ):
            f[r] = x1 * (x4 - s) * g + x2 * (x3 - t) * h + t * (x4 - x2) + s * (x3 - x1) - t * s
            jac[r, columns] = (x4 - s) * g - s, (x3 - t) * h - t, x2 * h + s, x1 * g + t
            ft[r] = (-x2 * h + (x4 - x2) - s) * dt + (-x1 * g + (x3 - x1) - t) * ds
            ft[r] = ft[r] + x1 * (x4 - s) * dg + x2 * (x3 - t) * dh
    for q in range(points):
        j, m = poses + q, 2 * poses + q
        t, s, dt, ds = p[0, j], p[1, j], dp[0, j], dp[1, j]
        a1, b1, c1 = x * (ab - s), xb * (a - t), t * (ab - xb) + s * (a - x) - t * s
        a2, b2, c2 = y * (bb - s), yb * (b - t), t * (bb - yb) + s * (b - y) - t * s
        first, second, both = b1 * c2 - b2 * c1, c1 * a2 - c2 * a1, a1 * b2 - a2 * b1
        f[m] = (first + second) * both + first * second
        by_first, by_second, by_both = both + second, both + first, first + second
        by_a1, by_b1, by_c1 = (
            by_both * b2 - by_second * c2,
            by_first * c2 - by_both * a2,
            by_second * a2 - by_first * b2,
        )
        by_a2, by_b2, by_c2 = (
            by_second * c1 - by_both * b1,
            by_both * a1 - by_first * c1,
            by_first * b1 - by_second * a1,
        )
        jac[m] = (
            by_a1 * (ab - s) - by_c1 * s, by_b1 * (a - t) - by_c1 * t, by_a2 * (bb - s) - by_c2 * s,
            by_b2 * (b - t) - by_c2 * t, by_b1 * xb + by_c1 * s, by_a1 * x + by_c1 * t, by_b2 * yb + by_c2 * s,
            by_a2 * y + by_c2 * t,
        )  # fmt: skip
        ft[m] = (by_c1 * (ab - xb - s) - by_b1 * xb + by_c2 * (bb - yb - s) - by_b2 * yb) * dt
        ft[m] = ft[m] + (by_c1 * (a - x - t) - by_a1 * x + by_c2 * (b - y - t) - by_a2 * y) * ds
    for r in range(2 * poses + points, 8):
        f[r] = z[r] - p[3, r]
        jac[r, r] = zero + 1
        ft[r] = -dp[3, r]
    return f, jac, ft
