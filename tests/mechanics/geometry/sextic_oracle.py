"""The coupler curve of a four-bar as an equation, a tricircular sextic: docs/theory/geometry.md."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class CouplerSextic:
    """f(K) = sum of H[i, j] K^i conj(K)^j for i, j = 0..3, real for every point K = x + iy; zero on the coupler curve.

    H is Hermitian, H[3, 3] = 1.
    """

    hermitian: np.ndarray

    def value(self, points):
        """The values f at points x + iy of any shape."""
        powers = np.asarray(points, np.complex128)[..., None] ** np.arange(4)
        return np.einsum("...i,ij,...j->...", powers, self.hermitian, np.conj(powers)).real

    def gradient(self, points):
        """df/dx + i df/dy at points of any shape; zero in a double point."""
        powers = np.asarray(points, np.complex128)[..., None] ** np.arange(4)
        slopes = np.concatenate([np.zeros_like(powers[..., :1]), powers[..., :3] * [1, 2, 3]], axis=-1)
        return 2 * np.einsum("...i,ij,...j->...", powers, self.hermitian, np.conj(slopes))


def coupler_sextic(four_bar, u, v):
    """The equation of the curve of the coupler point (u from A along AB, v to the left), both branches in one."""
    a, b, c, d = four_bar.a, four_bar.b, four_bar.c, four_bar.d
    s = complex(u, v) / b
    t = 1 - s
    # abs(K - s b e)^2 = a^2 and abs(K - d + t b e)^2 = c^2 are linear in e = exp(i theta) and its conjugate.
    first = np.array([[(abs(s) * b) ** 2 - a**2, 0], [0, 1]], np.complex128)
    second = np.array([[d**2 + (abs(t) * b) ** 2 - c**2, -d], [-d, 1]], np.complex128)
    to_first = np.array([[0, b * s]], np.complex128)  # times e
    to_second = np.array([[b * t * d, -b * t]], np.complex128)
    determinant = _times(to_first, to_second.conj().T) - _times(to_first.conj().T, to_second)
    side = _times(second, to_first) - _times(first, to_second)
    whole = _times(side, side.conj().T)
    whole[:3, :3] += _times(determinant, determinant)  # the determinant is imaginary
    hermitian = (whole + whole.conj().T) / (2 * whole[3, 3].real)
    hermitian[3, 3] = 1
    return CouplerSextic(hermitian)


def _times(p, q):
    """The product of two polynomials in K and its conjugate, as arrays [i, j] of coefficients."""
    product = np.zeros((p.shape[0] + q.shape[0] - 1, p.shape[1] + q.shape[1] - 1), np.complex128)
    for (i, j), factor in np.ndenumerate(p):
        product[i : i + q.shape[0], j : j + q.shape[1]] += factor * q
    return product
