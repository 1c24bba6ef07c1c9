"""Limits of drawn linkages of a crank and dyads: pivots, lengths, a crank that turns, the transmission angle.

docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyad_structures import NO_LINES, DyadStructure, assembled_sides
from gruebler.design.synthesis.fit_limits import MARGIN, FitLimits
from gruebler.design.synthesis.place_limits import PlaceLimits

_ROUND = np.linspace(0, 2 * np.pi, 40, endpoint=False)  # of the crank
_CLOSE = _ROUND[1] / 4  # to a top that was found between these: where it is measured again
SIGNS = np.array([1.0, -1.0])  # of a cosine, for an angle that is too small and one that is too large
SAFE = 1e-4  # of a cosine: so far from where a dyad is stretched


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawingLimits(FitLimits):
    """What drawings keep to: numbers are x, y of each joint in turn, then of the point."""

    structure: DyadStructure
    link: str
    """The link that carries the point."""
    places: PlaceLimits
    turning: bool
    pivots: Mapping[int, complex]
    """Given places of joints at the frame."""

    @property
    def narrow(self) -> bool:
        """Whether most linkages of the atlas, put onto a target, pass a limit."""
        demands = self.places.demands
        return demands.limits_of_size or self.turning

    @cached_property
    def free(self) -> Reals:
        """(numbers,) 1 for each that may change, else 0."""
        return np.array([float(k not in self.places.held) for k in range(2 * self.structure.joints + 2)])

    @cached_property
    def _bounds(self) -> dict[int, float]:
        """The dyads by their numbers whose angle is limited, with the largest cosine of it."""
        path, angle = self.structure.force_path(self.link), self.places.demands.transmission
        least = [angle if dyad in path else 0.0 for dyad in self.structure.dyads]
        return {n: min(float(np.cos(mu)), 1 - SAFE) for n, mu in enumerate(least) if self.turning or mu > 0}

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of a crank that turns fully all round, to the top between places; else at the targets."""
        values = self.places.values(rows, phi)
        return np.concatenate([values, self._cosines(rows, phi).beyond()]) if self._bounds else values

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Exact; a top does not move as long as it is one."""
        values, slopes = self.places.linearised(rows, phi)
        if self._bounds:
            cosines = self._cosines(rows, phi)
            values, slopes = np.concatenate([values, cosines.beyond()]), np.concatenate([slopes, cosines.slopes()])
        return values, slopes * self.free[:, None]

    def _cosines(self, rows: Reals, phi: Reals) -> _TopCosines:
        """The cosines of the limited dyads at the crank angles where each is largest, and where it is least."""
        bounds, places = self._bounds, rows.T.copy().view(np.complex128)
        watched, most = np.array([*bounds], np.int64), np.array([*bounds.values()])
        sides = assembled_sides(self.structure, places.T[:-1])
        angles = np.tile(_ROUND, (len(places), 1)) if self.turning else np.ascontiguousarray(phi)
        own = *self.structure.drawn_program, places
        tops = _core.find_tops(*own, NO_LINES, sides, angles, watched, self.turning)
        if self.turning:
            tops = _measured_again(own, sides, tops, watched)
        return _TopCosines(program=own, sides=sides, tops=tops, watched=watched, most=most)


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class _TopCosines:
    """Cosines of dyads of drawings at two crank angles each."""

    program: tuple[NDArray[np.int64], NDArray[np.int64], Complexes]
    sides: Reals
    tops: Reals
    """(starts, 2 dyads)"""
    watched: NDArray[np.int64]
    most: Reals

    def beyond(self) -> Reals:
        """(2 dyads, starts) by how much each passes its limit."""
        cosines = _core.find_cosines(*self.program, NO_LINES, self.sides, self.tops, self.watched)
        return beyond_cosines(cosines, self.most)

    def slopes(self) -> Reals:
        """(2 dyads, numbers, starts) how this changes with the numbers; 0 where a dyad cannot be assembled."""
        slopes = _core.cosine_slopes(*self.program, self.sides, self.tops, self.watched)
        slopes[np.isnan(slopes)] = 0.0
        return np.concatenate(SIGNS[:, None, None] * slopes)


def _measured_again(
    program: tuple[NDArray[np.int64], NDArray[np.int64], Complexes],
    sides: Reals,
    tops: Reals,
    watched: NDArray[np.int64],
) -> Reals:
    """Tops by a second parabola, close to them: the first one misses a cosine by up to 1e-4 where a dyad is fast."""
    near = np.concatenate([tops - _CLOSE, tops, tops + _CLOSE], axis=1)
    cosines = _core.find_cosines(*program, NO_LINES, sides, near, np.tile(watched, 3))
    before, here, after = cosines.reshape(3, tops.shape[1], len(tops))
    with np.errstate(invalid="ignore", divide="ignore"):
        part = (before - after) / (2 * (before - 2 * here + after))
    return np.asarray(tops + _CLOSE * np.clip(np.nan_to_num(part.T), -1, 1))


def beyond_cosines(cosines: Reals, most: Reals | float) -> Reals:
    """(2 dyads, linkages) by how much cosines (dyads, 2, linkages) at the tops of both signs pass limits."""
    signed = SIGNS[:, None] * cosines
    return np.concatenate(np.where(np.isnan(signed), -1.0, signed) - np.reshape(most, (-1, 1, 1)) + MARGIN)


def limits_of_drawings(
    structure: DyadStructure, link: str, demands: Demands, pivots: Sequence[complex], *, closed: bool, unit: float
) -> Iterator[DrawingLimits]:
    """What linkages of a structure keep to; for each way in which given pivots can be its joints at the frame."""
    chain, frame = structure.mechanism.chain, structure.mechanism.frame
    pins = {link: tuple(2 * n for n, joint in enumerate(chain.joints) if link in joint.links) for link in chain.links}
    for joints in permutations([x // 2 for x in pins[frame]], len(pivots)):
        yield DrawingLimits(
            structure=structure,
            link=link,
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
