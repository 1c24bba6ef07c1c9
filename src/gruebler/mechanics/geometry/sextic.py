"""The coupler curve of a four-bar as an equation: a tricircular sextic."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages.quantities import as_finite


@compared_by_value
@dataclass(frozen=True, eq=False)
class CouplerSextic:
    """f(K) = sum of H[i, j] K^i conj(K)^j for i, j = 0..3, real for every point K = x + iy; zero on the coupler curve.

    No power of K or its conjugate is higher than 3: the curve goes three times through each circular point. H is
    Hermitian, H[3, 3] = 1; the sixteen real numbers in it are the curve's.
    """

    hermitian: Complexes
    """(4, 4)."""

    def value(self, points: npt.ArrayLike) -> Reals:
        """The values f at points x + iy of any shape."""
        at = np.asarray(points, np.complex128)
        powers = at[..., None] ** np.arange(4)
        value: Reals = np.einsum("...i,ij,...j->...", powers, self.hermitian, np.conj(powers)).real
        return value

    def gradient(self, points: npt.ArrayLike) -> Complexes:
        """df/dx + i df/dy at points of any shape; zero in a double point."""
        at = np.asarray(points, np.complex128)
        powers = at[..., None] ** np.arange(4)
        slopes = np.concatenate([np.zeros_like(powers[..., :1]), powers[..., :3] * [1, 2, 3]], axis=-1)
        slope: Complexes = 2 * np.einsum("...i,ij,...j->...", powers, self.hermitian, np.conj(slopes))
        return slope

    @cached_property
    def coefficients(self) -> Reals:
        """(7, 7): the coefficient of x^i y^j in [i, j].

        >>> found = coupler_sextic(FourBar(25, 70, 40, 70), 45, 40).coefficients
        >>> found[6, 0], found[4, 2], found[2, 4], found[0, 6]  # (x^2 + y^2)^3
        (np.float64(1.0), np.float64(3.0), np.float64(3.0), np.float64(1.0))
        """
        coefficients = np.zeros((7, 7), np.complex128)
        for (i, j), factor in np.ndenumerate(self.hermitian):
            for m in range(i + 1):
                for n in range(j + 1):
                    coefficients[i + j - m - n, m + n] += factor * comb(i, m) * comb(j, n) * 1j**m * (-1j) ** n
        return coefficients.real


def coupler_sextic(four_bar: FourBar, u: float, v: float) -> CouplerSextic:
    """The equation of the curve of the coupler point (u from A along AB, v to the left), both branches in one.

    Error: with L the largest of lengths and coordinates, f is right to about 1e-14 L^6.

    Raises `LinkageError` for a point on a joint, where the equation is that of a circle, three times.

    >>> bar = FourBar(25, 70, 40, 70)
    >>> x, y = bar.motion(1.0).point(45, 40).value
    >>> bool(abs(coupler_sextic(bar, 45, 40).value(x + 1j * y)) < 1e-12 * 90**6)
    True
    """
    a, b, c, d = four_bar.a, four_bar.b, four_bar.c, four_bar.d
    arm = complex(as_finite("u", u), as_finite("v", v))
    if not 1e-35 < min(a, b, c, d) <= max(a, b, c, d, abs(arm)) < 1e35:
        raise LinkageError(
            "the sextic has sixth powers of lengths; choose a unit in which they lie between 1e-35 and 1e35"
        )
    s = arm / b
    t = 1 - s
    if min(abs(s), abs(t)) <= 1e-9:
        raise LinkageError("the coupler point lies on a joint: its curve is a circle")
    # abs(K - s b e)^2 = a^2 and abs(K - d + t b e)^2 = c^2 are linear in e = exp(i theta) and its conjugate.
    first = np.array([[(abs(s) * b) ** 2 - a**2, 0], [0, 1]], np.complex128)
    second = np.array([[d**2 + (abs(t) * b) ** 2 - c**2, -d], [-d, 1]], np.complex128)
    to_first = np.array([[0, b * s]], np.complex128)  # times e
    to_second = np.array([[b * t * d, -b * t]], np.complex128)
    determinant = _times(to_first, _conjugate(to_second)) - _times(_conjugate(to_first), to_second)
    side = _times(second, to_first) - _times(first, to_second)
    whole = _times(side, _conjugate(side))
    whole[:3, :3] += _times(determinant, determinant)  # the determinant is imaginary
    hermitian = (whole + whole.conj().T) / (2 * whole[3, 3].real)
    hermitian[3, 3] = 1
    return CouplerSextic(hermitian)


def _times(p: Complexes, q: Complexes) -> Complexes:
    """The product of two polynomials in K and its conjugate, as arrays [i, j] of coefficients."""
    product = np.zeros((p.shape[0] + q.shape[0] - 1, p.shape[1] + q.shape[1] - 1), np.complex128)
    for (i, j), factor in np.ndenumerate(p):
        product[i : i + q.shape[0], j : j + q.shape[1]] += factor * q
    return product


def _conjugate(p: Complexes) -> Complexes:
    return np.conj(p).T
