"""Quadratic forms: their common zeros, and whether a combination of them is definite."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.closing import TINY

_DIFFERENT = 1e-4  # 1 less the cosine: directions that differ by less (0.8 degrees) are one
_RANK = 1e-10  # of the largest singular value: slopes of exact forms that are smaller are rounding
_ROUNDING = 1e-14  # of a unit vector: a shorter step changes nothing
_ZERO = 1e-5  # of the largest coefficient: at a double zero, known to the root of the rounding, forms are smaller
_CLEAR = 1e-3  # an eigenvalue smaller than that times the largest is none


def is_definite(forms: Reals) -> bool:
    """Whether some combination of the forms (s, m, m) was found that is definite.

    Then they have no common zero but 0. For several forms the search may miss a combination.

    >>> is_definite(np.array([[[1.0, 0.0], [0.0, 2.0]]])), is_definite(np.array([[[1.0, 0.0], [0.0, -2.0]]]))
    (True, False)
    """
    random = np.random.default_rng(1)
    several = len(forms) > 1
    for start in [*np.eye(len(forms)), *random.normal(size=(30 * several, len(forms)))]:
        weights = start
        for _ in range(20 if several else 1):
            values, vectors = np.linalg.eigh(np.tensordot(weights, forms, 1))
            if min(abs(values)) > _CLEAR * max(abs(values)) and (values[0] > 0 or values[-1] < 0):
                return True
            # the vector that spoils it gains with the forms' values there
            weights = weights / max(np.linalg.norm(weights), TINY) + 0.5 * _values(forms, vectors[:, 0])
    return False


def _values(forms: Reals, k: Reals) -> Reals:
    values = np.einsum("sij,i,j->s", forms, k, k)
    unit: Reals = values / max(np.linalg.norm(values), TINY)
    return unit


def directions(forms: Reals, random: np.random.Generator, many: int) -> list[Reals]:
    """Unit vectors (m,) at which all forms (s, m, m) are zero, by Newton's method from many starts.

    Where the forms are all zero these are random directions.
    """
    size = float(abs(forms).max())
    zeros: list[Reals] = []
    for start in _starts(random, forms.shape[1], many):
        k = _zero(forms / size, start) if size > 0 else start
        if k is not None and all(abs(abs(k @ other) - 1) > _DIFFERENT for other in zeros):
            zeros.append(k)
    return zeros


def _zero(forms: Reals, k: Reals) -> Reals | None:
    """A common zero of the forms on the unit sphere, or None."""
    for _ in range(60):
        value, slope = np.einsum("sij,i,j->s", forms, k, k), 2 * np.einsum("sij,j->si", forms, k)
        step = np.linalg.lstsq(np.vstack([slope, k]), -np.append(value, 0.0), rcond=_RANK)[0]
        k = (k + step) / np.linalg.norm(k + step)
        if np.linalg.norm(step) < _ROUNDING:
            break
    return k if abs(np.einsum("sij,i,j->s", forms, k, k)).max() < _ZERO else None


def _starts(random: np.random.Generator, size: int, many: int) -> Reals:
    vectors = np.vstack([np.eye(size), random.normal(size=(many, size))])
    unit: Reals = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    return unit
