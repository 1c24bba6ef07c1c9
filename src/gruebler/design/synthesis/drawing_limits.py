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
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.fit_limits import MARGIN, FitLimits
from gruebler.design.synthesis.place_limits import PlaceLimits
from gruebler.design.synthesis.structure_atlas import (
    DrawnDyad,
    DyadStructure,
    LinkMotions,
    PinPlaces,
    dyad_arms,
    link_motions,
    link_slopes,
    pins_of_drawing,
)

_ROUND = np.linspace(0, 2 * np.pi, 40, endpoint=False)  # of the crank
SIGNS = np.array([1.0, -1.0])  # of a cosine, for an angle that is too small and one that is too large
SAFE = 1e-4  # of a cosine: so far from where a dyad is stretched


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
    def _bounds(self) -> list[tuple[DrawnDyad, float]]:
        """The dyads whose angle is limited, with the largest cosine of it."""
        path, angle = self.structure.force_path, self.places.demands.transmission
        least = [(dyad, angle if dyad in path else 0.0) for dyad in self.structure.dyads]
        return [(dyad, min(float(np.cos(mu)), 1 - SAFE)) for dyad, mu in least if self.turning or mu > 0]

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of a crank that turns fully all round, to the top between places; else at the targets."""
        if not self._bounds:
            return self.places.values(rows, phi)
        motions = link_motions(self.structure, _drawn(rows), self._tops(rows, phi))
        return np.concatenate([self.places.values(rows, phi), *self._beyond(rows, motions)])

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Exact; a top does not move as long as it is one."""
        values, slopes = self.places.linearised(rows, phi)
        if self._bounds:
            motions = link_motions(self.structure, _drawn(rows), self._tops(rows, phi))
            values = np.concatenate([values, *self._beyond(rows, motions)])
            slopes = np.concatenate([slopes, *self._cosine_slopes(rows, motions)])
        return values, slopes * self.free[:, None]

    def _beyond(self, rows: Reals, motions: LinkMotions) -> Iterator[Reals]:
        """(2, starts) of each dyad, by how much its cosine passes both limits at their tops."""
        for n, (dyad, most) in enumerate(self._bounds):
            yield beyond_cosine(cosine(dyad, _pins(rows), at_tops(motions, n)), most)

    def _tops(self, rows: Reals, phi: Reals) -> Reals:
        """(starts, tops) the crank angles where the cosine of each dyad is largest, and where it is least."""
        angles = np.broadcast_to(_ROUND, (rows.shape[1], len(_ROUND))) if self.turning else phi
        motions, tops = link_motions(self.structure, _drawn(rows), angles), []
        for dyad, _ in self._bounds:
            tops += top_angles(cosine(dyad, _pins(rows), motions), angles, between=self.turning)
        return np.concatenate(tops, axis=1)

    def _cosine_slopes(self, rows: Reals, motions: LinkMotions) -> Iterator[Reals]:
        """(2, numbers, starts) of each dyad, how its cosine passes both limits at their tops, as numbers change."""
        columns = rows.T.copy().view(np.complex128).T[..., None]
        with np.errstate(invalid="ignore", divide="ignore"):  # NaN where a dyad cannot be assembled
            slopes = link_slopes(self.structure, columns, motions, by_places=True)
        count = len(rows)
        for n, (dyad, _) in enumerate(self._bounds):
            moved, changed = at_tops(motions, n), at_tops(slopes, n)
            gap_slopes = np.zeros((count - 2, rows.shape[1], len(SIGNS)), np.complex128)
            for sign, joint, base in zip((-1, 1), dyad.outer, dyad.base, strict=True):
                by_turn, by_shift = changed[base]
                gap_slopes += sign * (by_turn * columns[joint] + by_shift)[:-1]
                gap_slopes[2 * joint] += sign * moved[base][0]
                gap_slopes[2 * joint + 1] += sign * 1j * moved[base][0]
            pin = pins_of_drawing(columns)
            gap, arms = _gap(dyad, pin, moved), dyad_arms(dyad, pin)
            first, second = np.abs(arms)
            product, own_cosine = first * second, cosine(dyad, pin, moved)
            by_number = np.zeros((count, *gap.shape))
            by_number[:-2] = -np.real(np.conj(gap) * gap_slopes) / product
            for arm, own, joint in zip(arms, (first, second), dyad.outer, strict=True):
                by_length = own / product - own_cosine / own
                for k, part in enumerate((arm.real, arm.imag)):
                    by_number[2 * dyad.inner + k] += by_length * part / own
                    by_number[2 * joint + k] -= by_length * part / own
            yield np.moveaxis(SIGNS * np.nan_to_num(by_number), 2, 0)


def at_tops(motions: LinkMotions, dyad: int) -> LinkMotions:
    """Motions, or how they change, at both tops of a dyad by its number."""
    own = slice(len(SIGNS) * dyad, len(SIGNS) * (dyad + 1))
    return {link: (turn[..., own], shift[..., own]) for link, (turn, shift) in motions.items()}


def _drawn(rows: Reals) -> Complexes:
    """(joints, starts) the places of the joints."""
    return np.asarray(rows[:-2:2] + 1j * rows[1:-2:2])


def _pins(rows: Reals) -> PinPlaces:
    return pins_of_drawing(_drawn(rows)[..., None])


def _gap(dyad: DrawnDyad, pin: PinPlaces, motions: LinkMotions) -> Complexes:
    """From the outer joint of the first link to that of the second."""
    own, far = (
        motions[base][0] * pin(joint, base) + motions[base][1]
        for joint, base in zip(dyad.outer, dyad.base, strict=True)
    )
    return np.asarray(far - own)


def cosine(dyad: DrawnDyad, pin: PinPlaces, motions: LinkMotions) -> Reals:
    """Of the angle between the links of a dyad; beyond 1 where it cannot be assembled."""
    first, second = (np.abs(arm) for arm in dyad_arms(dyad, pin))
    return np.asarray((first**2 + second**2 - np.abs(_gap(dyad, pin, motions)) ** 2) / (2 * first * second))


def beyond_cosine(cosines: Reals, most: float) -> Reals:
    """(2, ...) by how much cosines (..., 2) at the tops of both signs pass a limit."""
    signed = SIGNS * cosines
    return np.moveaxis(np.where(np.isnan(signed), -1.0, signed) - most + MARGIN, -1, 0)


def top_angles(cosines: Reals, angles: Reals, *, between: bool) -> list[Reals]:
    """(starts, 1) crank angles where cosines (starts, angles) are largest, and where least; between angles, too."""
    tops, rows = [], np.arange(len(cosines))
    for signed in (cosines, -cosines):
        at = np.fmax(signed, -np.inf).argmax(axis=1)
        top = angles[rows, at][:, None]
        tops.append(top + _beside(signed, at)[:, None] * (angles[:, 1:2] - angles[:, :1]) if between else top)
    return tops


def _beside(values: Reals, at: NDArray[np.intp]) -> Reals:
    """(rows,) by which part of a step the top of the parabola through three places lies beside the middle one."""
    rows = np.arange(len(values))
    before, here, after = (values[rows, (at + k) % values.shape[1]] for k in (-1, 0, 1))
    bend = before - 2 * here + after
    with np.errstate(invalid="ignore", divide="ignore"):
        part = np.clip((before - after) / (2 * bend), -0.5, 0.5)
    return np.where(np.isnan(part), 0.0, part)


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
