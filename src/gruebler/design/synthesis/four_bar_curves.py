"""Coupler curves of many four-bars and slider-cranks at once, and their exact derivatives by every dimension.

A linkage is a row of numbers in the plane, whose meaning its kind tells (`four_bar_kinds`). The crank angle is measured
in the plane.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.four_bar_kinds import FourBarKind


class CurvePoints(NamedTuple):
    """Places of the coupler point, and its derivatives."""

    z: Complexes
    """(..., angles); NaN where the linkage cannot be assembled."""
    by_crank: Complexes
    """(..., angles) by the crank angle."""
    by_sizes: Complexes
    """(unknowns, ..., angles) by each number of the row; empty if not asked for."""


def curve_points(
    kind: FourBarKind, rows: Reals, phi: Reals, side: Reals | float, *, slopes: bool = False
) -> CurvePoints:
    """Coupler points of linkages at crank angles.

    Args:
        kind: of the linkages.
        rows: (unknowns, ...) numbers of the linkages, to be spread over the angles by numpy's rules.
        phi: (..., angles).
        side: +1 or -1, for each linkage.
        slopes: whether the derivatives by the sizes are wanted.

    Cost: about 0.1 us a point, 0.5 us with derivatives.
    """
    r = kind.named(rows)
    a, b = r["a"], r["b"]
    turned = np.exp(1j * phi)
    pin = r["a0x"] + 1j * r["a0y"] + a * turned
    with np.errstate(invalid="ignore", divide="ignore"):
        theta, normal = kind.coupler(r, pin, side)
        w = r["u"] + 1j * r["v"]
        z = pin + w * theta
        # The coupler's rate follows from what the far pin may not do: Re(normal (d pin + i b theta d angle)) = given.
        divisor = -np.real(normal * 1j * b * theta)

        def moved(d_pin: Complexes | complex, given: Reals | float) -> Complexes:
            rate = (np.real(normal * d_pin) - given) / divisor
            return np.asarray(d_pin + 1j * w * theta * rate)

        by_crank = moved(1j * a * turned, 0.0)
        if not slopes:
            return CurvePoints(z, by_crank, np.zeros((0, *np.shape(z)), np.complex128))
        ones = np.ones_like(turned)
        columns = {
            "a0x": moved(ones, 0.0),
            "a0y": moved(1j * ones, 0.0),
            "a": moved(turned, 0.0),
            "b": moved(0 * ones, -np.real(normal * theta)),
            "u": theta,
            "v": 1j * theta,
        }
        carried = kind.carried(pin + b * theta, normal)
        columns |= {name: moved(0 * ones, given) for name, given in carried.items()}
    return CurvePoints(z, by_crank, np.stack([np.broadcast_to(columns[name], z.shape) for name in kind.unknowns]))
