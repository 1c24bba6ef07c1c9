"""Limits of linkages by their dimensions: places, lengths, and a crank that turns fully with the dyads that hang on it.

docs/theory/synthesis-any.md. The numbers are those of the pins of every link in its own plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.drawing_limits import SAFE, beyond_cosines
from gruebler.design.synthesis.dyad_structures import NO_LINES, DyadProgram, DyadStructure, dyad_structure, in_rows
from gruebler.design.synthesis.fit_limits import FitLimits
from gruebler.design.synthesis.place_limits import PlaceLimits

_ROUND = np.linspace(0, 2 * np.pi, 240, endpoint=False)  # of the crank: a dyad beside one that is stretched is fast
_STEP = 1e-6  # sizes: of a difference on either side


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class TurningCrank:
    """A crank and the dyads that have to be assembled at each of its angles."""

    program: DyadProgram
    elements: NDArray[np.int64]
    """Of each joint on each link the number that is its x; of a slide the angle of its line is the second after it."""
    lines: NDArray[np.bool_]
    """Which of these are lines."""
    sides: Reals
    """(dyads, 1) on which side each dyad is assembled."""

    def tops(self, rows: Reals) -> Reals:
        """(starts, tops) the crank angles where the cosine of each dyad is largest, and where least."""
        angles = np.tile(_ROUND, (rows.shape[1], 1))
        return _core.find_tops(*self._linkages(rows), angles, np.arange(len(self.sides)), between=True)

    def beyond(self, rows: Reals, tops: Reals) -> Reals:
        """(2 dyads, starts) by how much the cosine of each passes both limits at their tops."""
        return beyond_cosines(_core.find_cosines(*self._linkages(rows), tops, np.arange(len(self.sides))), 1 - SAFE)

    def _linkages(self, rows: Reals) -> tuple[NDArray[np.int64], NDArray[np.int64], Complexes, Complexes, Reals]:
        """What the core takes of numbers (numbers, starts)."""
        lines = NO_LINES
        if self.lines.any():
            angles = np.where(self.lines[:, None], rows[np.where(self.lines, self.elements + 2, 0)], 0.0)
            lines = in_rows(np.exp(1j * angles))
        points = in_rows(rows[self.elements] + 1j * rows[self.elements + 1])
        return *self.program, points, lines, np.tile(self.sides, rows.shape[1])


@dataclass(frozen=True, slots=True, kw_only=True)
class SizeLimits(FitLimits):
    """What the dimensions of a linkage keep to."""

    places: PlaceLimits
    crank: TurningCrank | None

    @property
    def unit(self) -> float:
        """The size by which limits are measured."""
        return self.places.unit

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of numbers (numbers, starts)."""
        values = self.places.values(rows, phi)
        if self.crank is None:
            return values
        return np.concatenate([values, self.crank.beyond(rows, self.crank.tops(rows))])

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Of a crank by differences; a top does not move as long as it is one."""
        values, slopes = self.places.linearised(rows, phi)
        if self.crank is None:
            return values, slopes
        tops, step, count = self.crank.tops(rows), _STEP * self.unit, len(rows)
        aside = step * np.eye(count)[:, :, None]
        moved = np.concatenate([rows[:, None, :] + sign * aside for sign in (1, -1)], axis=1).reshape(count, -1)
        ends = self.crank.beyond(moved, np.tile(tops, (2 * count, 1))).reshape(-1, 2, count, rows.shape[1])
        turning = (ends[:, 0] - ends[:, 1]) / (2 * step)
        turning[:, [*self.places.held]] = 0
        return np.concatenate([values, self.crank.beyond(rows, tops)]), np.concatenate([slopes, turning])


def limits_of_sizes(
    closure: DesignClosure, demands: Demands, pose: Reals, p: Reals, *, held: frozenset[int], unit: float
) -> SizeLimits:
    """What dimensions p keep to; the crank turns fully with dyads on the side on which they are in a pose."""
    linkage = closure.linkage
    mechanism, at = linkage.mechanism, closure.start
    pins = {key: at[key] for key in closure.keys if linkage.elements[key].is_pin}
    places = PlaceLimits(
        pins={link: tuple(x for (_, own), x in pins.items() if own == link) for link in mechanism.chain.links},
        frame=mechanism.frame,
        demands=demands,
        unit=unit,
        held=held,
    )
    structure = dyad_structure(mechanism, sliding=True) if demands.crank else None
    if structure is None:
        return SizeLimits(places=places, crank=None)
    number = {key: k for k, key in enumerate(closure.keys)}
    crank = TurningCrank(
        program=structure.program(lambda joint, link: number[joint, link]),
        elements=np.array([at[key] for key in closure.keys], np.int64),
        lines=np.array([linkage.elements[key].is_line for key in closure.keys]),
        sides=_sides(structure, closure, pose, p)[:, None],
    )
    return SizeLimits(places=places, crank=crank)


def _sides(structure: DyadStructure, closure: DesignClosure, pose: Reals, p: Reals) -> Reals:
    """(dyads,) on which side each is assembled in a pose."""

    def seen(joint: int, link: str) -> tuple[complex, complex]:
        """Where the point of a joint lies, and the direction of its line."""
        x, column = closure.start[joint, link], closure.column.get(link)
        own, angle = complex(p[x], p[x + 1]), p[x + 2] if closure.linkage.elements[joint, link].is_line else 0.0
        if column is None:
            return own, np.exp(1j * angle)
        turn = np.exp(1j * pose[column + 2])
        return complex(pose[column], pose[column + 1]) + turn * own, turn * np.exp(1j * angle)

    sides = []
    for dyad in structure.dyads:
        (end, first), (far, last) = (seen(*key) for key in zip(dyad.outer, dyad.base, strict=True))
        (near, slide), (inner, own) = (seen(dyad.inner, link) for link in dyad.links)
        sines = (
            np.conj(far - end) * (near - end),
            1j * np.conj(last) * (inner - end),
            1j * np.conj(slide) * (far - end),
            np.conj(first) * last,
            np.conj(own) * last,
        )
        sides.append(float(np.sign(sines[dyad.form].imag)))
    return np.array(sides)
