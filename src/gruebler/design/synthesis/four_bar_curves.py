"""Coupler curves of many four-bars and slider-cranks at once, and their exact derivatives by every dimension.

A linkage is a row of nine (or eight) numbers in the plane, see `FOUR_BAR` and `SLIDER_CRANK`. The crank angle is
measured in the plane.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals


@dataclass(frozen=True, slots=True)
class FourBarKind:
    """What the numbers of a row are."""

    name: str
    unknowns: tuple[str, ...]


FOUR_BAR = FourBarKind("four-bar", ("a0x", "a0y", "b0x", "b0y", "a", "b", "c", "u", "v"))
"""The fixed pivots A0, B0, crank a, coupler b, rocker c, coupler point u along AB, v to its left."""
SLIDER_CRANK = FourBarKind("slider-crank", ("a0x", "a0y", "angle", "h", "a", "b", "u", "v"))
"""A0, the direction of the slide, its distance from the origin to its left, crank, coupler, coupler point."""


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
        kind: `FOUR_BAR` or `SLIDER_CRANK`.
        rows: (unknowns, ...) numbers of the linkages, to be spread over the angles by numpy's rules.
        phi: (..., angles).
        side: +1 or -1, for each linkage.
        slopes: whether the derivatives by the sizes are wanted.

    Cost: about 0.1 us a point, 0.5 us with derivatives.
    """
    r = dict(zip(kind.unknowns, rows, strict=True))
    a, b = r["a"], r["b"]
    turned = np.exp(1j * phi)
    pin = r["a0x"] + 1j * r["a0y"] + a * turned
    with np.errstate(invalid="ignore", divide="ignore"):
        if kind is FOUR_BAR:
            far = r["b0x"] + 1j * r["b0y"]
            gap = far - pin
            f = np.abs(gap)
            along = (b * b - r["c"] ** 2 + f * f) / (2 * f)
            across = side * np.sqrt(b * b - along * along)
            theta = gap / f * (along + 1j * across) / b
            rocker = (pin + b * theta - far) / r["c"]
            normal = np.conj(rocker)  # the rocker's pin cannot move along the rocker
        else:
            slide = np.exp(1j * r["angle"])
            height = r["h"] - np.imag(np.conj(slide) * pin)
            along = side * np.sqrt(b * b - height * height)
            theta = slide * (along + 1j * height) / b
            normal = -1j * np.conj(slide)
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
        if kind is FOUR_BAR:
            columns |= {
                "b0x": moved(0 * ones, np.real(normal * ones)),
                "b0y": moved(0 * ones, np.real(normal * 1j * ones)),
                "c": moved(0 * ones, 1.0),
            }
        else:
            far = pin + b * theta
            columns |= {"h": moved(0 * ones, 1.0), "angle": moved(0 * ones, np.real(np.conj(slide) * far))}
    return CurvePoints(z, by_crank, np.stack([np.broadcast_to(columns[name], z.shape) for name in kind.unknowns]))
