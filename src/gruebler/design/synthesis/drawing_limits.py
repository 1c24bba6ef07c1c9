"""Limits of drawn linkages of a crank and dyads: pivots, lengths, a crank that turns, the transmission angle.

docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.fit_limits import MARGIN, FitLimits
from gruebler.design.synthesis.judging import Demands
from gruebler.design.synthesis.place_limits import PlaceLimits
from gruebler.design.synthesis.structure_atlas import DrawnDyad, DyadStructure, LinkMotions, link_motions, link_slopes

_ROUND = np.linspace(0, 2 * np.pi, 40, endpoint=False)  # of the crank
_SAFE = 1e-4  # of a cosine: so far from where a dyad is stretched


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawingLimits(FitLimits):
    """What drawings keep to: numbers are x, y of each joint in turn, then of the point."""

    structure: DyadStructure
    places: PlaceLimits
    turning: bool
    pivots: Mapping[int, complex]
    """Given places of joints at the frame."""

    @property
    def narrow(self) -> bool:
        """Whether most linkages of the atlas, put onto a target, pass a limit."""
        demands = self.places.demands
        return demands.limits_of_size or self.turning

    @property
    def free(self) -> Reals:
        """(numbers,) 1 for each that may change, else 0."""
        return np.array([float(k not in self.places.held) for k in range(2 * self.structure.joints + 2)])

    @property
    def _bounds(self) -> Iterator[tuple[DrawnDyad, float]]:
        """The dyads whose angle is limited, with the largest cosine of it."""
        output = self.structure.output
        for dyad in self.structure.dyads:
            least = self.places.demands.transmission if output in dyad.links else 0.0
            if self.turning or least > 0:
                yield dyad, min(float(np.cos(least)), 1 - _SAFE)

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of a crank that turns fully all round, to the top between places; else at the targets."""
        angles = [self._beyond(rows, *top) for top in self._tops(rows, phi)]
        return np.concatenate([self.places.values(rows, phi), np.reshape(angles, (len(angles), rows.shape[1]))])

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Exact; a top does not move as long as it is one."""
        tops = [*self._tops(rows, phi)]
        angles = [self._beyond(rows, *top) for top in tops]
        slopes = [sign * self._cosine_slopes(dyad, rows, at) for dyad, _, at, sign in tops]
        return (
            np.concatenate([self.places.values(rows, phi), np.reshape(angles, (len(angles), rows.shape[1]))]),
            np.concatenate([self.places.linearised(rows, phi)[1], np.reshape(slopes, (len(slopes), *rows.shape))])
            * self.free[:, None],
        )

    def _beyond(self, rows: Reals, dyad: DrawnDyad, most: float, at: Reals, sign: float) -> Reals:
        cosine = _cosine(dyad, _drawn(rows)[..., None], link_motions(self.structure, _drawn(rows), at))[:, 0]
        return np.nan_to_num(sign * cosine, nan=-1.0) - most + MARGIN

    def _tops(self, rows: Reals, phi: Reals) -> Iterator[tuple[DrawnDyad, float, Reals, float]]:
        """Each limit of an angle: the dyad, the largest cosine, (starts, 1) where it is largest, and its sign."""
        bounds = [*self._bounds]
        if not bounds:
            return
        angles = np.broadcast_to(_ROUND, (rows.shape[1], len(_ROUND))) if self.turning else phi
        motions = link_motions(self.structure, _drawn(rows), angles)
        for dyad, most in bounds:
            cosines = _cosine(dyad, _drawn(rows)[..., None], motions)
            for sign in (1.0, -1.0):
                at = np.nan_to_num(sign * cosines, nan=-np.inf).argmax(axis=1)
                top = np.take_along_axis(angles, at[:, None], axis=1)
                if self.turning:
                    top = top + _beside(sign * cosines, at)[:, None] * (_ROUND[1] - _ROUND[0])
                yield dyad, most, top, sign

    def _cosine_slopes(self, dyad: DrawnDyad, rows: Reals, turned: Reals) -> Reals:
        """(numbers, starts) how the cosine of a dyad's angle changes at one crank angle each."""
        columns = rows.T.copy().view(np.complex128).T[..., None]
        motions = link_motions(self.structure, columns[:-1, :, 0], turned)
        with np.errstate(invalid="ignore", divide="ignore"):  # NaN where a dyad cannot be assembled
            slopes = link_slopes(self.structure, columns, motions, by_places=True)
        count = len(rows)
        gap_slopes = np.zeros((count - 2, *turned.shape), np.complex128)
        for sign, joint, base in zip((-1, 1), dyad.outer, dyad.base, strict=True):
            by_turn, by_shift = slopes[base]
            gap_slopes += sign * (by_turn * columns[joint] + by_shift)[:-1]
            gap_slopes[2 * joint] += sign * motions[base][0]
            gap_slopes[2 * joint + 1] += sign * 1j * motions[base][0]
        gap = _gap(dyad, columns, motions)
        arms = [columns[dyad.inner] - columns[joint] for joint in dyad.outer]
        first, second = np.abs(arms)
        product, cosine = first * second, _cosine(dyad, columns, motions)
        by_number = np.zeros((count, *turned.shape))
        by_number[:-2] = -np.real(np.conj(gap) * gap_slopes) / product
        for arm, own, joint in zip(arms, (first, second), dyad.outer, strict=True):
            by_length = own / product - cosine / own
            for k, part in enumerate((arm.real, arm.imag)):
                by_number[2 * dyad.inner + k] += by_length * part / own
                by_number[2 * joint + k] -= by_length * part / own
        return np.nan_to_num(by_number[..., 0])


def _drawn(rows: Reals) -> Complexes:
    """(joints, starts) the places of the joints."""
    return np.asarray(rows[:-2:2] + 1j * rows[1:-2:2])


def _gap(dyad: DrawnDyad, places: Complexes, motions: LinkMotions) -> Complexes:
    """From the outer joint of the first link to that of the second."""
    own, far = (
        motions[base][0] * places[joint] + motions[base][1] for joint, base in zip(dyad.outer, dyad.base, strict=True)
    )
    return np.asarray(far - own)


def _cosine(dyad: DrawnDyad, places: Complexes, motions: LinkMotions) -> Reals:
    """Of the angle between the links of a dyad; beyond 1 where it cannot be assembled."""
    first, second = (np.abs(places[dyad.inner] - places[joint]) for joint in dyad.outer)
    gap = _gap(dyad, places, motions)
    return np.asarray((first**2 + second**2 - np.abs(gap) ** 2) / (2 * first * second))


def _beside(values: Reals, at: NDArray[np.intp]) -> Reals:
    """(rows,) by which part of a step the top of the parabola through three places lies beside the middle one."""
    before, here, after = (
        np.take_along_axis(values, ((at + k) % values.shape[1])[:, None], 1)[:, 0] for k in (-1, 0, 1)
    )
    bend = before - 2 * here + after
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.clip(np.nan_to_num((before - after) / (2 * bend)), -0.5, 0.5)


def limits_of_drawings(
    structure: DyadStructure, demands: Demands, pivots: Sequence[complex], *, closed: bool, unit: float
) -> Iterator[DrawingLimits]:
    """What linkages of a structure keep to; for each way in which given pivots can be its joints at the frame."""
    chain, frame = structure.mechanism.chain, structure.mechanism.frame
    pins = {link: tuple(2 * n for n, joint in enumerate(chain.joints) if link in joint.links) for link in chain.links}
    for joints in permutations([x // 2 for x in pins[frame]], len(pivots)):
        yield DrawingLimits(
            structure=structure,
            places=PlaceLimits(
                pins=pins,
                frame=frame,
                demands=demands,
                unit=unit,
                held=frozenset(2 * joint + k for joint in joints for k in range(2)),
            ),
            turning=demands.crank or (closed and demands.transmission > 0),
            pivots=dict(zip(joints, pivots, strict=True)),
        )
