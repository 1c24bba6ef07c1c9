"""Rigid motions and twists: 4 x 4 matrices, and (ω, v) with v the velocity of the point at the origin.

Source: R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic Manipulation, 1994, chapter 2; there
the twist is written (v, ω).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals

_SMALL = 1e-2  # radians: below, four terms of the series are exact to rounding, and 1 - cos has lost digits
_TERMS = 16  # of the series of the rate of an exponential; twists below 1 leave an error below 1e-16


def twist_matrix(twists: ArrayLike) -> Reals:
    """The matrices of twists: (..., 6) to (..., 4, 4).

    >>> twist_matrix([0, 0, 1, 2, 0, 0])[0].tolist()
    [0.0, -1.0, 0.0, 2.0]
    """
    t = np.asarray(twists, float)
    matrix = np.zeros((*t.shape[:-1], 4, 4))
    matrix[..., 2, 1], matrix[..., 0, 2], matrix[..., 1, 0] = t[..., 0], t[..., 1], t[..., 2]
    matrix[..., :3, :3] -= np.swapaxes(matrix[..., :3, :3], -1, -2)
    matrix[..., :3, 3] = t[..., 3:]
    return matrix


def exponential(twists: ArrayLike) -> Reals:
    """The motions that twists make in a unit of time: (..., 6) to (..., 4, 4), to rounding.

    >>> exponential(np.array([0, 0, 1, 0, -1, 0]) * np.pi / 2).round(9)[:2, 3].tolist()  # a quarter turn about (1, 0)
    [1.0, -1.0]
    """
    t = np.asarray(twists, float)
    x = twist_matrix(t)
    angle = np.linalg.norm(t[..., :3], axis=-1)[..., None, None]
    small = angle < _SMALL
    safe = np.where(small, 1.0, angle)
    square = angle * angle
    second = np.where(small, 1 / 2 - square / 24 + square**2 / 720 - square**3 / 40320, (1 - np.cos(safe)) / safe**2)
    third = np.where(
        small, 1 / 6 - square / 120 + square**2 / 5040 - square**3 / 362880, (safe - np.sin(safe)) / safe**3
    )
    x2 = x @ x
    motion: Reals = np.eye(4) + x + second * x2 + third * (x2 @ x)
    return motion


def lie_bracket(twists: ArrayLike) -> Reals:
    """The matrices (..., 6, 6) that take another twist to its Lie bracket with these."""
    t = np.asarray(twists, float)
    bracket = np.zeros((*t.shape[:-1], 6, 6))
    turn = twist_matrix(t)[..., :3, :3]
    shift = twist_matrix(np.concatenate([t[..., 3:], t[..., :3]], axis=-1))[..., :3, :3]
    bracket[..., :3, :3] = bracket[..., 3:, 3:] = turn
    bracket[..., 3:, :3] = shift
    return bracket


def exponential_rate(twists: ArrayLike) -> Reals:
    """The matrices D (..., 6, 6) with d exp(ξ) exp(ξ)⁻¹ = D dξ: the sum of bracket(ξ)^k / (k + 1)!."""
    ad = lie_bracket(twists)
    rate = np.broadcast_to(np.eye(6), ad.shape).copy()
    power = rate.copy()
    for k in range(1, _TERMS + 1):
        power = power @ ad / (k + 1)
        rate += power
    return rate


def adjoint(motion: ArrayLike) -> Reals:
    """The matrices (..., 6, 6) that take twists along with motions (..., 4, 4)."""
    m = np.asarray(motion, float)
    turn = m[..., :3, :3]
    matrix = np.zeros((*m.shape[:-2], 6, 6))
    matrix[..., :3, :3] = matrix[..., 3:, 3:] = turn
    shift = np.concatenate([m[..., :3, 3], np.zeros_like(m[..., :3, 3])], axis=-1)
    matrix[..., 3:, :3] = twist_matrix(shift)[..., :3, :3] @ turn
    return matrix


def inverse_motion(motion: Reals) -> Reals:
    """The inverse motions (..., 4, 4)."""
    inverse = np.zeros_like(motion)
    turn = np.swapaxes(motion[..., :3, :3], -1, -2)
    inverse[..., :3, :3] = turn
    inverse[..., :3, 3] = -(turn @ motion[..., :3, 3, None])[..., 0]
    inverse[..., 3, 3] = 1
    return inverse
