"""Dyads on the sphere: all of five orientations, samples of the families of three and four.

docs/theory/synthesis-sphere.md has the equations and the counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, product
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.base.text import message

MOST_ORIENTATIONS = 5
COMPLEX_DYADS = 6
"""Complex dyads of five orientations."""
GREAT_CIRCLES = 60
"""That are cut with the curve of four orientations."""
_AXES = 150  # of three orientations
_ROTATION = 1e-9
_RANK = 1e-12  # of the largest singular value: below it conditions depend on one another
_REAL = 1e-7
_EXACT = 1e-12
_SOLVED = 1e-8


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SphericalDyad:
    """A link with two axes through the centre: one of the frame, one of the body."""

    fixed: Reals
    """(3,) the axis on the frame, a unit vector; the opposite one is the same axis."""
    moving: Reals
    """(3,) the axis on the body, as it lies in the first orientation."""


def displacements(orientations: ArrayLike) -> Reals:
    """(targets - 1, 3, 3) the rotations from the first orientation to each of the others, in the frame."""
    try:
        given = np.asarray(orientations, np.float64)
    except (TypeError, ValueError):
        given = np.zeros(0)
    if given.ndim != 3 or given.shape[1:] != (3, 3) or not 3 <= len(given) <= MOST_ORIENTATIONS:
        raise SynthesisError(
            "orientations: expected three to five matrices of 3 x 3 numbers, but found {shape}", shape=given.shape
        )
    for k, matrix in enumerate(given):
        square = matrix @ matrix.T
        if not (np.abs(square - np.eye(3)).max() < _ROTATION and np.linalg.det(matrix) > 0):
            raise SynthesisError("orientation {number} is no rotation", number=k + 1)
    for k, m in combinations(range(len(given)), 2):
        if np.abs(given[k] - given[m]).max() < _ROTATION:
            raise SynthesisError("orientations {first} and {second} are equal", first=k + 1, second=m + 1)
    return np.asarray(given[1:] @ given[0].T)


class SphericalDyads(NamedTuple):
    """The dyads of five orientations."""

    real: tuple[SphericalDyad, ...]
    complex_count: int
    """How many complex ones, of six."""


def five_orientation_dyads(turns: Reals) -> SphericalDyads:
    """The real ones of six dyads of four rotations from the first orientation: (4, 3, 3).

    Four cubics in the axis of the body, the minors of the conditions, leave six of ten monomials; the multiplication
    by one linear form over another has the six solutions as its eigenvalues.

    Raises `SynthesisError` where there are infinitely many.
    """
    cubics = np.stack([_cubic(turns[list(rows)]) for rows in combinations(range(len(turns)), 3)])
    scale = np.abs(cubics).max(initial=0.0)
    _, values, basis = np.linalg.svd(cubics / (scale or 1.0))
    if scale < _RANK or values[-1] < _RANK * values[0]:
        raise SynthesisError(_INFINITELY_MANY)
    kernel = basis[len(values) :].T
    products = np.stack([kernel[[_CUBIC.index(_raised(q, k)) for q in _QUADRATIC]] for k in range(3)])
    first, second = np.tensordot(_FORMS, products, axes=1)
    vectors = np.linalg.eig(np.linalg.solve(second, first))[1]
    ways, exact, dyads = turns - np.eye(3), 0, []
    for k in range(COMPLEX_DYADS):
        axis = np.linalg.svd(products @ vectors[:, k])[0][:, 0]
        exact += int(np.linalg.svd(ways @ axis, compute_uv=False)[-1] < _SOLVED)  # some axis of the frame serves it
        square = complex(np.sum(axis * axis))  # of a real axis times any phase its size is 1
        if abs(abs(square) - 1) > _REAL:
            continue
        moving = np.real(axis / np.sqrt(square))
        dyads.append(_polished(turns, moving / np.linalg.norm(moving)))
    return SphericalDyads(tuple(dyads), exact)


_INFINITELY_MANY = message(
    "there are infinitely many dyads: some of the orientations are repeated, or they belong to a rotation"
)
_CUBIC = [e for e in product(range(4), repeat=3) if sum(e) == 3]
_QUADRATIC = [e for e in product(range(3), repeat=3) if sum(e) == 2]
_FORMS = np.array([[0.61, -0.37, 0.53], [0.23, 0.47, -0.67]])
"""Two linear forms in general position; their ratio tells the solutions apart."""


def _raised(exponents: tuple[int, ...], k: int) -> tuple[int, ...]:
    return tuple(e + (m == k) for m, e in enumerate(exponents))


def _cubic(turns: Reals) -> Reals:
    """The determinant of three conditions as a cubic in the axis of the body: its coefficients by `_CUBIC`."""
    a, b, c = turns - np.eye(3)
    crossed = np.cross(b.T[:, None, :], c.T[None, :, :])  # by the coordinates of the axis in b and in c
    terms = np.einsum("ni,jkn->ijk", a, crossed)
    coefficients = np.zeros(len(_CUBIC))
    for rows in product(range(3), repeat=3):
        coefficients[_CUBIC.index((rows.count(0), rows.count(1), rows.count(2)))] += terms[rows]
    return coefficients


def _fixed_axis(turns: Reals, moving: Reals) -> Reals:
    """The axis of the frame, across the ways of an axis of the body."""
    return np.asarray(np.linalg.svd((turns - np.eye(3)) @ moving)[2][-1])


def _polished(turns: Reals, moving: Reals) -> SphericalDyad:
    """Improved by Newton's method on the four conditions, both axes along their tangent planes."""
    fixed = _fixed_axis(turns, moving)
    ways = turns - np.eye(3)
    for _ in range(8):
        own, other = (np.linalg.svd(axis[None])[2][1:] for axis in (fixed, moving))
        residual = ways @ moving @ fixed
        matrix = np.hstack([ways @ moving @ own.T, np.einsum("i,nij->nj", fixed, ways) @ other.T])
        step = np.linalg.lstsq(matrix, -residual, rcond=1e-14)[0]
        fixed, moving = fixed + step[:2] @ own, moving + step[2:] @ other
        fixed, moving = fixed / np.linalg.norm(fixed), moving / np.linalg.norm(moving)
        if np.abs(step).max() < _EXACT:
            break
    return SphericalDyad(fixed=fixed, moving=moving)


def family_dyads(turns: Reals, *, times: int = 1) -> tuple[SphericalDyad, ...]:
    """A sample of the dyads of three or four orientations, or so many times as many."""
    if np.linalg.svd(np.concatenate(turns - np.eye(3)), compute_uv=False)[-1] < _REAL:  # an axis that stays
        raise SynthesisError(_INFINITELY_MANY)
    if len(turns) == 2:
        count = times * _AXES
        k = np.arange(count) + 0.5
        height, around = 1 - k / count, pi * (1 + 5**0.5) * k  # a spiral over half the sphere
        across = np.sqrt(1 - height**2)
        axes = np.stack([across * np.cos(around), across * np.sin(around), height], axis=1)
    else:
        axes = _curve(_cubic(turns), times * GREAT_CIRCLES)
    dyads = _serving(turns, axes)
    if not dyads:
        raise SynthesisError(_INFINITELY_MANY)
    return tuple(dyads)


def near_dyads(turns: Reals, dyad: SphericalDyad, width: float) -> list[SphericalDyad]:
    """Dyads of three or four orientations beside one of them: their axes on the body are about so many radians away."""
    first, second = np.linalg.svd(dyad.moving[None])[2][1:]
    if len(turns) == 2:
        around = 2 * pi * np.arange(8) / 8
        moves = width * np.concatenate([np.exp(1j * around), 0.5 * np.exp(1j * around)])
        return _serving(turns, dyad.moving + moves.real[:, None] * first + moves.imag[:, None] * second)
    cubic = _cubic(turns)
    _, slope = _cubic_at(cubic, dyad.moving)
    along = np.cross(slope, dyad.moving)
    if not along.any():  # a double point, where the curve has two directions
        return []
    axes = dyad.moving + width * np.array([[-1.0], [-0.5], [0.5], [1.0]]) * along / np.linalg.norm(along)
    for _ in range(4):
        values, slopes = _cubic_at(cubic, axes)
        axes = axes - (values / np.maximum((slopes**2).sum(axis=1), 1e-300))[:, None] * slopes
        axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    onto = np.abs(_cubic_at(cubic, axes)[0]) < _EXACT * np.abs(cubic).max()
    return _serving(turns, axes[onto])


def _serving(turns: Reals, axes: Reals) -> list[SphericalDyad]:
    """The dyads of axes of the body, less those on a pole, which any axis of the frame serves."""
    axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    _, singular, fixed = np.linalg.svd(np.einsum("kij,nj->nki", turns - np.eye(3), axes))
    several = singular[:, 1] > _REAL
    return [SphericalDyad(fixed=own[-1], moving=axis) for axis, own in zip(axes[several], fixed[several], strict=True)]


def _cubic_at(cubic: Reals, axes: Reals) -> tuple[Reals, Reals]:
    """The value of a cubic and its slope at axes, (..., 3)."""
    powers = np.array(_CUBIC)
    value = np.prod(axes[..., None, :] ** powers, axis=-1) @ cubic
    slopes = []
    for k in range(3):
        lowered = np.maximum(powers - np.eye(3, dtype=int)[k], 0)
        slopes.append(np.prod(axes[..., None, :] ** lowered, axis=-1) @ (cubic * powers[:, k]))
    return value, np.stack(slopes, axis=-1)


def _curve(cubic: Reals, circles: int) -> Reals:
    """(points, 3) of a cubic cone, where so many great circles through one point cut it."""
    if np.abs(cubic).max() < _RANK:
        raise SynthesisError(_INFINITELY_MANY)
    pole = np.array([0.48, 0.6, 0.64])
    first, second = np.linalg.svd(pole[None])[2][1:]
    t = np.array([-1.0, -1 / 3, 1 / 3, 1.0])
    points = []
    for angle in pi * (np.arange(circles) + 0.5) / circles:
        across = cos(angle) * first + sin(angle) * second
        places = pole + t[:, None] * across
        values = np.prod(places[:, None, :] ** np.array(_CUBIC), axis=2) @ cubic
        roots = np.roots(np.polyfit(t, values, 3))
        points += [pole + root * across for root in roots.real[np.abs(roots.imag) < _REAL * (1 + np.abs(roots))]]
    axes = np.array(points)
    return np.asarray(axes / np.linalg.norm(axes, axis=1, keepdims=True))
