"""Discs in the complex plane, and with them the proof that a solution is one: an interval Newton step.

A disc holds all that rounding and its own radius leave open. Krawczyk's operator maps a box of discs into its interior
only if there is exactly one solution in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals, compared_by_value

_ROUNDING = 8 * float(np.finfo(float).eps)
"""More than the relative error of any complex product, quotient or sum of doubles."""
_SHARPER = 2.0**-40
"""By how much the bound of rounding shrinks with twice the digits: the same operations with 2^-100 instead of 2^-52."""


@compared_by_value
@dataclass(frozen=True, eq=False)
class Disc:
    """Discs of one centre and radius for each solution."""

    centre: Complexes
    radius: Reals
    __array_priority__ = 100

    @classmethod
    def of(cls, value: Any) -> Disc:
        """A number, or arrays of numbers, as discs without radius."""
        centre = np.asarray(value, np.complex128)
        return cls(centre, np.zeros(centre.shape))

    def __add__(self, other: Any) -> Disc:
        other = other if isinstance(other, Disc) else Disc.of(other)
        centre = self.centre + other.centre
        return Disc(centre, (self.radius + other.radius) * (1 + _ROUNDING) + _ROUNDING * np.abs(centre))

    __radd__ = __add__

    def __neg__(self) -> Disc:
        return Disc(-self.centre, self.radius)

    def __sub__(self, other: Any) -> Disc:
        return self + -(other if isinstance(other, Disc) else Disc.of(other))

    def __rsub__(self, other: Any) -> Disc:
        return -self + (other if isinstance(other, Disc) else Disc.of(other))

    def __mul__(self, other: Any) -> Disc:
        other = other if isinstance(other, Disc) else Disc.of(other)
        centre = self.centre * other.centre
        spread = np.abs(self.centre) * other.radius + np.abs(other.centre) * self.radius + self.radius * other.radius
        return Disc(centre, spread * (1 + _ROUNDING) + _ROUNDING * np.abs(centre))

    __rmul__ = __mul__

    def __truediv__(self, other: Disc | Complexes | complex) -> Disc:
        """By a number that is exact; a disc is only divided by one without radius."""
        divisor = other.centre if isinstance(other, Disc) else np.asarray(other, np.complex128)
        centre = self.centre / divisor
        return Disc(centre, self.radius / np.abs(divisor) * (1 + _ROUNDING) + _ROUNDING * np.abs(centre))

    def __rtruediv__(self, other: Any) -> Disc:
        return Disc.of(other) / self


def certified(poses: int, points: int, z: Complexes, p: Complexes) -> NDArray[np.bool_]:
    """Which solutions of a task are proved: (solutions,).

    For each the discs about it are so large as ten last Newton steps, and Krawczyk's operator maps them into
    themselves; proved solutions whose discs overlap are not counted as different. Where the rounding of double
    precision is too large for that, the residual is computed with twice the digits. Cost: 30 us a solution.
    """
    if not len(z):
        return np.zeros(0, bool)
    good, box = _mapped_into_itself(poses, points, z, p, sharp=False)
    weak = np.flatnonzero(~good)
    if len(weak):
        good[weak], box[weak] = _mapped_into_itself(poses, points, z[weak], p, sharp=True)
    return np.asarray(good & _apart(z, box))


def _mapped_into_itself(
    poses: int, points: int, z: Complexes, p: Complexes, *, sharp: bool
) -> tuple[NDArray[np.bool_], Reals]:
    """Whether Krawczyk's operator maps the box about each solution into itself, and the radii of the boxes."""
    from gruebler._numeric.homotopy import evaluate_system

    count = len(z)
    still = np.zeros((4, 8), np.complex128)

    def evaluated(unknowns: list[Disc]) -> tuple[NDArray[Any], NDArray[Any]]:
        f, jac, ft = np.empty(8, object), np.empty((8, 8), object), np.empty(8, object)
        holder = np.empty(8, object)
        holder[:] = unknowns
        with np.errstate(all="ignore"):
            evaluate_system(holder, p, still, poses, points, f, jac, ft)
        return f, jac

    def numbers(matrix: NDArray[Any]) -> tuple[Complexes, Reals]:
        rows = [entry if isinstance(entry, Disc) else Disc.of(entry) for entry in matrix.ravel()]
        centre = np.stack([np.broadcast_to(d.centre, (count,)) for d in rows], axis=1)
        radius = np.stack([np.broadcast_to(d.radius, (count,)) for d in rows], axis=1)
        return centre.reshape(count, *matrix.shape), radius.reshape(count, *matrix.shape)

    f, jac = evaluated([Disc.of(z[:, k]) for k in range(8)])
    value, slack = numbers(f)
    if sharp:
        value = _sharp_residuals(poses, points, z, p)
        slack = slack * _SHARPER + _ROUNDING * np.abs(value)
    middle, _ = numbers(jac)
    scale = 1 / np.maximum(np.abs(middle).max(axis=2), 1e-300)  # rows to one size
    good = np.asarray(np.isfinite(middle).all(axis=(1, 2)) & np.isfinite(value).all(axis=1))
    safe = np.where(good[:, None, None], middle * scale[:, :, None], np.eye(8))
    try:
        inverse = np.linalg.inv(safe) * scale[:, None, :]
    except np.linalg.LinAlgError:
        inverse = np.linalg.pinv(safe) * scale[:, None, :]
    weights = np.abs(inverse)
    step = np.abs(np.einsum("nij,nj->ni", inverse, value)) + np.einsum("nij,nj->ni", weights, slack)
    box = 10 * step + 1e-14 * np.abs(z)
    _, jac = evaluated([Disc(z[:, k], box[:, k]) for k in range(8)])
    centre, spread = numbers(jac)
    with np.errstate(all="ignore"):
        rest = np.abs(np.eye(8) - np.einsum("nij,njk->nik", inverse, centre)) + np.einsum(
            "nij,njk->nik", weights, spread
        )
        rest += 64 * _ROUNDING * np.einsum("nij,njk->nik", weights, np.abs(centre))
        mapped = step + np.einsum("nik,nk->ni", rest, box)
        good = good & (mapped < box).all(axis=1)
    return good, np.asarray(box)


def _sharp_residuals(poses: int, points: int, z: Complexes, p: Complexes) -> Complexes:
    """The equations at solutions with twice the digits: (solutions, 8)."""
    from gruebler._numeric.compiling import for_work
    from gruebler._numeric.homotopy import sharp_residuals
    from gruebler._numeric.work_estimates import evaluating

    kernel = for_work(sharp_residuals, evaluating(len(z)))
    residuals = np.empty((len(z), 8), np.complex128)
    for row, value in zip(z, residuals, strict=True):
        kernel(row, p, poses, points, value)
    return residuals


def _apart(z: Complexes, box: Reals) -> NDArray[np.bool_]:
    """Which boxes overlap no other."""
    order = np.argsort(z[:, 0].real)
    apart = np.ones(len(z), bool)
    real, reach = z[order, 0].real, box[order, 0]
    widest = float(reach.max(initial=0.0))
    for k, n in enumerate(order):
        for j in range(k + 1, len(order)):
            if real[j] - real[k] > reach[k] + widest:
                break
            m = order[j]
            if (np.abs(z[n] - z[m]) <= box[n] + box[m]).all():
                apart[n] = apart[m] = False
    return apart
