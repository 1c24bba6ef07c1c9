"""All extremes of a smooth function on an interval, from the roots of its Chebyshev interpolant's derivative.

The interpolant has pieces so short that their last coefficients vanish relative to the first; its derivative's roots
are eigenvalues of a colleague matrix (Boyd, Solving Transcendental Equations, SIAM 2014, chapters 2 and 3). No root is
missed between samples, as long as the function is resolved, which is checked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

Function = Callable[[NDArray[np.float64]], NDArray[np.float64]]

_DEGREE = 24
_HALVINGS = 12
_NODES = chebyshev.chebpts1(_DEGREE + 1)
_FIT = np.linalg.inv(chebyshev.chebvander(_NODES, _DEGREE))
"""Values at the Chebyshev points to coefficients; the inverse of a matrix with orthogonal columns."""


def extremes(function: Function, a: float, b: float, scale: float = 0.0) -> list[tuple[float, float]]:
    """The ends of [a, b] and all places between them where the derivative vanishes, with the values there.

    The function takes an array and is smooth on the interval. Values are good to about 1e-12 of the greatest, or of
    ``scale``; smaller differences are noise.

    >>> [(round(x, 9), round(y, 9)) for x, y in extremes(np.sin, 0.0, 6.0)]
    [(0.0, 0.0), (1.570796327, 1.0), (4.71238898, -1.0), (6.0, -0.279415498)]
    """
    inner = [
        x
        for low, high, c in _proxies(function, a, b, scale)
        for x in _real(np.asarray(chebyshev.chebder(c), dtype=np.float64), low, high)
    ]
    places = np.array([a, *sorted(inner), b])
    return list(zip(places.tolist(), np.asarray(function(places)).tolist(), strict=True))


def _proxies(
    function: Function, a: float, b: float, size: float = 0.0, halvings: int = _HALVINGS
) -> Iterator[tuple[float, float, NDArray[np.float64]]]:
    """Intervals that cover [a, b] with the coefficients of the function on each; ``size`` is the greatest around."""
    middle, half = (a + b) / 2, (b - a) / 2
    c = np.asarray(_FIT @ function(middle + half * _NODES), dtype=np.float64)
    finite = bool(np.isfinite(c).all())
    size = max(size, float(np.abs(c).max())) if finite else size
    if finite and (np.abs(c[-3:]).max() <= 1e-12 * size or not halvings):
        yield a, b, np.where(np.abs(c) > 1e-14 * size, c, 0.0)
    elif halvings:  # the last, tiny interval around a pole is left out
        yield from _proxies(function, a, middle, size, halvings - 1)
        yield from _proxies(function, middle, b, size, halvings - 1)


def _real(c: NDArray[np.float64], a: float, b: float) -> list[float]:
    c = np.asarray(chebyshev.chebtrim(c, 1e-13 * max(np.abs(c).max(), 1e-300)), dtype=np.float64)
    if len(c) < 2:
        return []
    zeros = chebyshev.chebroots(c)
    inside = zeros.real[(np.abs(zeros.imag) < 1e-7) & (np.abs(zeros.real) <= 1)]
    return [float((a + b) / 2 + (b - a) / 2 * t) for t in inside]
