"""Dyads that guide a body through positions: two links and a joint between body and frame.

All in the coordinates of the frame, points of the body as they lie in the first position. Displacement j carries the
point x to q_j x + t_j. docs/theory/synthesis-positions.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import combinations, product
from math import atan2
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.structure.chain.pairs import Pair, pair

_REAL = 1e-7
"""Two conjugate numbers nearer to real than this are looked at as real: a double root has half the digits of 1e-16."""
_FAR = 1e-9
"""A homogeneous coordinate smaller than this part of the others is at infinity: pivots 1e9 sizes away are no pivots."""
_REMOTE = 1e3  # sizes: a pivot that is farther may be one at infinity, found with rounding
_BENT = 1e-3
"""A link bends the path of its pivot by about path² / length: a dyad that misses by less than this part is no slide."""
_SAME = 1e-2  # sizes: two dyads whose other pivots are nearer are one; remote pivots differ by their inverse distance
_EXACT = 1e-11
"""A polished dyad misses its condition by less, relative to its size."""


class Displacements(NamedTuple):
    """From the first position to each of the others, in units of the task's size about the first origin."""

    q: Complexes
    """(positions - 1,) cosine + i sine of the rotation."""
    t: Complexes
    """(positions - 1,) where the origin goes."""

    @classmethod
    def of(cls, origins: Complexes, turns: Complexes) -> tuple[Displacements, complex, float]:
        """The displacements, with the first origin and the size by which they are reduced."""
        size = float(np.abs(origins - origins[0]).max()) or 1.0
        q = turns[1:] / turns[0]
        return cls(q, (origins[1:] - origins[0]) / size), complex(origins[0]), size

    @property
    def inverse(self) -> Displacements:
        """The displacements of the frame as seen from the body."""
        return Displacements(np.conj(self.q), -np.conj(self.q) * self.t)

    @property
    def with_first(self) -> tuple[Complexes, Complexes]:
        """(positions,) each: q and t, with those of the first position, 1 and 0, before them."""
        return np.append(1, self.q), np.append(0, self.t)

    def images(self, x: complex) -> Complexes:
        """The point in all positions, the first included."""
        return np.concatenate([[x], self.q * x + self.t])


@dataclass(frozen=True, slots=True, kw_only=True)
class DyadKind:
    """A kind of connection of body and frame with two joints."""

    pairs: tuple[Pair, Pair]
    """Of the joint on the frame and of that on the body."""
    sides: tuple[str, str]
    """What the link between frame and coupler is called: the first of its kind, the second."""
    seen: Callable[[Displacements], Displacements] | None = None
    """The displacements in which its pivot stays on a line; None if it stays on a circle."""

    @property
    def slides(self) -> bool:
        """Whether one of its joints slides, so that its pivot stays on a line."""
        return self.seen is not None

    @property
    def form(self) -> str:
        """Its joints in letters, such as PR."""
        return "".join(joint.symbol() for joint in self.pairs)


def _from_the_frame(given: Displacements) -> Displacements:
    return given


def _from_the_body(given: Displacements) -> Displacements:
    return given.inverse


_TURNING, _SLIDING = pair("revolute"), pair("prismatic")
CRANK = DyadKind(pairs=(_TURNING, _TURNING), sides=("crank", "rocker"))
SLIDER = DyadKind(pairs=(_SLIDING, _TURNING), sides=("slider", "second_slider"), seen=_from_the_frame)
BLOCK = DyadKind(pairs=(_TURNING, _SLIDING), sides=("block", "second_block"), seen=_from_the_body)


@dataclass(frozen=True, slots=True)
class GuidingDyad:
    """A connection of body and frame with two joints: a crank (RR), a slider (PR) or a block (RP)."""

    kind: DyadKind
    moving: complex
    """RR and PR: the pivot on the body, as it lies in the first position. RP: the fixed pivot again."""
    fixed: complex
    """RR and RP: the pivot on the frame. PR: the pivot on the body."""
    direction: complex = 0j
    """PR: of the slide on the frame. RP: of the slide on the body, in the first position."""

    @property
    def joints(self) -> tuple[tuple[str, tuple[float, ...]], ...]:
        """The first joint and the one on the body: symbol and place as in a drawing, of a slide with its angle."""
        angle = (atan2(self.direction.imag, self.direction.real),)
        return tuple(
            (joint.symbol(), (at.real, at.imag, *(angle if joint.is_sliding else ())))
            for joint, at in zip(self.kind.pairs, (self.fixed, self.moving), strict=True)
        )

    @property
    def slides(self) -> bool:
        """Whether one of its joints slides, so that its pivot stays on a line."""
        return self.kind.slides

    @property
    def length(self) -> float:
        """The distance of the pivots of an RR dyad; 0 for the others."""
        return abs(self.moving - self.fixed)

    def moved(self, turn: complex, shift: complex) -> GuidingDyad:
        """The dyad turned, scaled (``turn``) and shifted."""
        direction = self.direction * turn / abs(turn)
        return GuidingDyad(self.kind, turn * self.moving + shift, turn * self.fixed + shift, direction)


def _rows(given: Displacements) -> Complexes:
    """Conditions of RR dyads, bilinear: (displacements, 3, 3) by (x, x*, 1) and (m, m*, 1)."""
    q, t = given
    qc, tc = np.conj(q), np.conj(t)
    rows = np.zeros((len(q), 3, 3), np.complex128)
    rows[:, 0, 1], rows[:, 0, 2] = 1 - q, q * tc
    rows[:, 1, 0], rows[:, 1, 2] = 1 - qc, qc * t
    rows[:, 2, 0], rows[:, 2, 1], rows[:, 2, 2] = -tc, -t, t * tc
    return rows


def misfit(given: Displacements, dyad: GuidingDyad) -> float:
    """How far the dyad is from guiding the body: the largest deviation of its constant length or line."""
    if dyad.kind.seen is None:
        gaps = np.abs(given.images(dyad.moving) - dyad.fixed)
    else:
        gaps = np.imag(np.conj(dyad.direction) * dyad.kind.seen(given).images(dyad.moving))
    return float(gaps.max() - gaps.min())


def guiding_conditions(
    given: Displacements, x: Complexes | np.complex128, m: Complexes | np.complex128
) -> tuple[Reals, Reals]:
    """How far RR dyads are from guiding the body, and the derivatives by the coordinates of both pivots.

    Args:
        given: displacements.
        x: (...,) pivots on the body.
        m: (...,) pivots on the frame.

    Returns:
        (..., displacements) differences of the squares of the length, and (..., displacements, 4) their derivatives.
    """
    x, m = np.asarray(x)[..., None], np.asarray(m)[..., None]
    gap, arm = given.q * x + (given.t - m), x - m
    by_x, by_m = 2 * (np.conj(given.q) * gap - arm), -2 * (gap - arm)
    return np.abs(gap) ** 2 - np.abs(arm) ** 2, np.stack([by_x.real, by_x.imag, by_m.real, by_m.imag], axis=-1)


def line_conditions(seen: Displacements, point: Complexes, angle: Reals) -> tuple[Reals, Reals]:
    """How far points leave lines of some inclination, and the derivatives by x, y and the angle.

    Args:
        seen: displacements.
        point: (...,) the points in the first position.
        angle: (...,) of the lines.

    Returns:
        (..., displacements) distances, and (..., displacements, 3) their derivatives.
    """
    turn = np.exp(-1j * angle)[..., None]
    moved = turn * ((seen.q - 1) * point[..., None] + seen.t)
    by_point = turn * (seen.q - 1)
    return moved.imag, np.stack([by_point.imag, by_point.real, -moved.real], axis=-1)


def dyad_of_moving_pivot(given: Displacements, x: complex, /) -> GuidingDyad:
    """The dyad of two displacements whose pivot on the body is given: RR, or PR where its three places are in line.

    Raises `SynthesisError` if two of the places coincide, so that any centre will do.
    """
    places = given.images(x)
    gaps = np.diff(places)
    if np.abs(gaps).min() < _FAR:
        raise SynthesisError("the chosen pivot lies in the same place in two positions: every fixed pivot serves it")
    area = float(np.imag(np.conj(gaps[0]) * gaps[1])) / float(np.abs(gaps[0]) * np.abs(gaps[1]))
    if abs(area) < _FAR:
        direction = (places[-1] - places[0]) if abs(places[-1] - places[0]) > _FAR else gaps[0]
        return GuidingDyad(SLIDER, x, x, complex(direction / abs(direction)))
    return GuidingDyad(CRANK, x, circle_centre(places))


def dyad_of_fixed_pivot(given: Displacements, m: complex, /) -> GuidingDyad:
    """The dyad of two displacements whose pivot on the frame is given: RR, or RP; errors as above."""
    guiding_dyad = dyad_of_moving_pivot(given.inverse, m)
    if guiding_dyad.slides:
        return GuidingDyad(BLOCK, m, m, guiding_dyad.direction)
    return GuidingDyad(CRANK, guiding_dyad.fixed, m)


def circle_centre(places: Complexes) -> complex:
    """The centre of the circle through three places."""
    u, v = places[1] - places[0], places[2] - places[0]
    cross = 2 * float(np.imag(np.conj(u) * v))
    return complex(places[0] + 1j * (abs(v) ** 2 * u - abs(u) ** 2 * v) / cross)


def sliding_dyads(given: Displacements) -> tuple[GuidingDyad, ...]:
    """The PR and RP dyads of three displacements: one of each in general.

    Raises `SynthesisError` for displacements that have infinitely many.
    """
    if np.abs(given.q - 1).max() < _FAR:
        raise SynthesisError("the body does not turn: every one of its points moves alike (a translation)")
    sliding = []
    for kind, seen in ((SLIDER, given), (BLOCK, given.inverse)):
        # The point x stays on a line of normal n: Re(n* (q - 1) x + n* t) = 0, linear in n* x and n.
        q, t = seen.q - 1, seen.t
        matrix = np.stack([q.real, -q.imag, t.real, t.imag], axis=1)
        scale = np.abs(matrix).max(axis=0)
        scale[scale == 0] = 1.0
        _, values, vectors = np.linalg.svd(matrix / scale)
        x, y, *along = vectors[-1] / scale
        normal = complex(*along)
        if values[2] < _EXACT * values[0] or abs(normal) < _FAR * abs(complex(x, y)):
            continue
        point, direction = complex(x, y) / normal.conjugate(), 1j * normal / abs(normal)
        dyad = GuidingDyad(kind, point, point, direction)
        if misfit(given, dyad) <= 1e-9 * (1 + abs(point)):
            sliding.append(dyad)
    return tuple(sliding)


# Of the ten monomials of a cubic in x, x*, w two are missing, the pure powers of x and x*, since the cubics of four
# positions pass through the circular points: eight are left, by exponents of x and x*.
CUBIC = ((2, 1), (1, 2), (2, 0), (1, 1), (0, 2), (1, 0), (0, 1), (0, 0))
_BASE = ((1, 1), (1, 0), (0, 1), (0, 0))
"""Monomials of degree two whose products with x, x* and w are all among `CUBIC`."""
_FORMS = np.array([[0.61, 0.37 + 0.29j, 0.53], [0.23 - 0.41j, 0.47, -0.67]])
"""Two linear forms in x, x*, w in general position; their ratio tells the solutions apart."""


def circle_point_cubics(given: Displacements) -> Complexes:
    """The cubics on which the pivots on the body lie, for each three displacements: (choices, 8) by `CUBIC`.

    A pivot on the body has a centre for three displacements if three conditions, linear in the centre, are dependent:
    their determinant is zero.
    """
    rows = _rows(given)
    chosen = rows[np.array(list(combinations(range(len(rows)), 3)))]  # (choices, 3 conditions, 3 by x, 3 by m)
    a, b, c = (chosen[:, k] for k in range(3))
    crossed = np.cross(b[:, :, None, :], c[:, None, :, :])
    products = np.einsum("nil,njkl->nijk", a, crossed).reshape(len(chosen), 27)
    return np.asarray(products @ _COLLECTED)


def _collected() -> Reals:
    """(27, 8): to which monomial of `CUBIC` each product of three coordinates belongs; the pure powers vanish."""
    collected = np.zeros((27, len(CUBIC)))
    for row, numbers in enumerate(product(range(3), repeat=3)):
        exponents = numbers.count(0), numbers.count(1)
        if exponents in CUBIC:
            collected[row, CUBIC.index(exponents)] = 1.0
    return collected


_COLLECTED = _collected()


class Dyads(NamedTuple):
    """The dyads of four displacements (five positions)."""

    real: tuple[GuidingDyad, ...]
    found: int
    """How many complex ones, of four."""


def all_dyads(given: Displacements) -> Dyads:
    """All dyads of four displacements: RR, PR and RP, from the four roots of one polynomial.

    Cost: about 0.4 ms. Raises `SynthesisError` where there are infinitely many.
    """
    cubics = circle_point_cubics(given)
    scale = np.abs(cubics).max(initial=0.0)
    # The rank is decided far above rounding and far below what a general task has.
    _, values, basis = np.linalg.svd(cubics / scale if scale > 0 else cubics)
    if scale < 1e-13 or values[3] < 1e-12 * max(values[0], 1e-300):
        raise SynthesisError(
            "there are infinitely many dyads: some of the positions are repeated, or they belong to a motion that "
            "infinitely many dyads guide (such as a rotation or a translation)"
        )
    kernel = np.conj(basis[4:].T)  # (8, 4): evaluations at the four solutions span it
    products = np.stack([_times(kernel, shift) for shift in ((1, 0), (0, 1), (0, 0))])
    first, second = np.tensordot(_FORMS, products, axes=1)
    vectors = np.linalg.eig(np.linalg.solve(second, first))[1]
    points = [_point(products @ vectors[:, k]) for k in range(4)]
    slides = [dyad for dyad in sliding_dyads(given) if misfit(given, dyad) <= 1e-8 * (1 + abs(dyad.moving))]
    turning = [dyad for x in points if (dyad := _turning_dyad(given, x)) is not None]
    turning.sort(key=lambda dyad: -dyad.length)
    for slide in slides:  # its other pivot lies at infinity, and is found somewhere far away
        claimed = next((dyad for dyad in turning if _approaches(given, dyad, slide)), None)
        if claimed is not None:
            turning.remove(claimed)
    real = [*slides, *(dyad for dyad in turning if _is_exact(given, dyad))]
    return Dyads(_different(real), len(points))


def _times(kernel: Complexes, shift: tuple[int, int]) -> Complexes:
    return kernel[[CUBIC.index((i + shift[0], j + shift[1])) for i, j in _BASE]]


def _point(products: Complexes) -> Complexes:
    """Homogeneous x, x*, w from the products of the base with each of them: (3, 4) of rank one."""
    u, *_ = np.linalg.svd(products)
    return np.asarray(u[:, 0])


def _turning_dyad(given: Displacements, x: Complexes) -> GuidingDyad | None:
    """The RR dyad of a solution in homogeneous isotropic coordinates, pivots at infinity far away; None if not real."""
    # Real points: the conjugate of the point, its first two coordinates exchanged, is the same point.
    mirrored = np.conj(x[[1, 0, 2]])
    phase = np.vdot(x, mirrored)
    if abs(abs(phase) - 1) > _REAL:
        return None
    x = x * np.sqrt(phase / abs(phase))
    centre = np.conj(np.linalg.svd(np.einsum("i,jik->jk", x, _rows(given)))[2][-1])
    start = GuidingDyad(CRANK, *(complex(p[0] / (p[2] if abs(p[2]) > _FAR**2 else _FAR**2)) for p in (x, centre)))
    if min(abs(x[2]), abs(centre[2])) < _FAR:
        return start
    polished = _polished(given, start)
    return polished if _is_exact(given, polished) else start


def _approaches(given: Displacements, dyad: GuidingDyad, slide: GuidingDyad) -> bool:
    """Whether a long RR dyad is this slide, its far pivot found with rounding."""
    near, kind = (dyad.moving, SLIDER) if abs(dyad.moving) < abs(dyad.fixed) else (dyad.fixed, BLOCK)
    if kind != slide.kind or abs(near - slide.moving) > _SAME * (1 + abs(near)):
        return False
    return dyad.length > _REMOTE or not _bends(given, dyad)


def _is_exact(given: Displacements, dyad: GuidingDyad) -> bool:
    """Whether an RR dyad guides the body to the last digits; a long one must do so as no slide does."""
    if dyad.length > _REMOTE:
        return _bends(given, dyad)
    return dyad.length > _FAR and misfit(given, dyad) <= _EXACT * max(abs(dyad.moving), abs(dyad.fixed), 1.0)


def _bends(given: Displacements, dyad: GuidingDyad) -> bool:
    """Whether a long RR dyad fits the bend of its path, not just the path, which a slide would fit too."""
    near_moving = abs(dyad.moving) < abs(dyad.fixed)
    path = given.images(dyad.moving) if near_moving else given.inverse.images(dyad.fixed)
    bend = float(np.abs(path - path[0]).max()) ** 2 / dyad.length
    return misfit(given, dyad) + 4 * float(np.spacing(dyad.length)) < _BENT * bend


def _polished(given: Displacements, start: GuidingDyad) -> GuidingDyad:
    """An RR dyad near a solution, improved by Newton's method."""
    x, m = start.moving, start.fixed
    scale = max(abs(x), abs(m), 1.0)
    q, t = given
    for _ in range(12):
        gap = q * x + t - m
        residual = (np.abs(gap) ** 2 - abs(x - m) ** 2) / scale
        by_x, by_m = 2 * (np.conj(q) * gap - (x - m)) / scale, -2 * (gap - (x - m)) / scale
        matrix = np.stack([by_x.real, by_x.imag, by_m.real, by_m.imag], axis=1)
        step, *_ = np.linalg.lstsq(matrix, -residual, rcond=1e-15)
        x, m = x + complex(step[0], step[1]), m + complex(step[2], step[3])
        if np.abs(step).max() < 1e-15 * scale:
            break
    return GuidingDyad(CRANK, x, m)


def _different(dyads: Iterable[GuidingDyad]) -> tuple[GuidingDyad, ...]:
    different: list[GuidingDyad] = []
    for dyad in dyads:
        near = [
            abs(dyad.moving - o.moving) + abs(dyad.fixed - o.fixed) < 1e-9 * (1 + abs(o.moving) + abs(o.fixed))
            for o in different
            if o.kind == dyad.kind
        ]
        if not any(near):
            different.append(dyad)
    return tuple(sorted(different, key=lambda d: (d.slides, d.length, d.moving.real)))
