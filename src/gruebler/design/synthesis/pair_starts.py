"""Random linkages of a crank and another dyad that carry a body through two or three positions.

docs/theory/synthesis-positions.md, "Random starts".
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyads import Displacements, DyadKind
from gruebler.design.synthesis.length_search import PairFamily, pivots_of_rows
from gruebler.design.synthesis.random_starts import DRAWN, StartFamily
from gruebler.design.synthesis.tasks import PositionTask


class PairStarts(StartFamily):
    """The linkages of two or three positions whose pivots are at hand, and how they move in their family at random."""

    family: PairFamily

    def __init__(self, task: PositionTask, kind: DyadKind) -> None:
        self.family = PairFamily(task=task, kind=kind, lengths=())
        self.kind = kind
        self.given, self.origin, self.size = Displacements.of(task.origins, task.turns)

    def drawn(self, rng: np.random.Generator, demands: Demands) -> Reals:
        """Slides in any direction."""
        pivots = self.pivots(rng, demands)
        fixed = (rng.random((DRAWN, 2)) < 0.5) | (demands.region is not None)
        return self._members(pivots, np.pi * rng.random(DRAWN), fixed)

    def neighbours(self, rng: np.random.Generator, demands: Demands, rows: Reals, width: Reals) -> Reals:
        """One dyad or both are moved, at either pivot."""
        pivots = pivots_of_rows(rows, self.family.points)
        steps = rng.normal(size=(*pivots.shape, 2)).view(np.complex128)[..., 0] * (1 + np.abs(pivots))
        wide = width * np.exp(-2 * rng.random(len(pivots)))
        alone = rng.random((len(pivots), 1)) < 0.5
        side = (rng.random((len(pivots), 1)) < 0.5) == (np.arange(self.family.points) < 2)
        steps = np.where(alone & side, 0, steps * wide[:, None])
        fixed = (rng.random((len(pivots), 2)) < 0.5) | (demands.region is not None)
        angles = rows[:, -1]
        if self.kind.slides:
            angles = angles + np.where(steps[:, 2] == 0, 0, wide * rng.normal(size=len(rows)))
        return self._members(self.within(demands, pivots + steps), angles, fixed)

    def _members(self, pivots: Complexes, angles: Reals, fixed: Flags) -> Reals:
        first = cranks_of_pivots(self.given, pivots[:, :2], fixed[:, 0])
        if self.kind.seen is None:
            return np.concatenate([first, cranks_of_pivots(self.given, pivots[:, 2:], fixed[:, 1])], axis=1)
        return np.concatenate([first, slides_of_places(self.kind.seen(self.given), pivots[:, 2], angles)], axis=1)


def cranks_of_pivots(given: Displacements, pivots: Complexes, fixed: Flags) -> Reals:
    """(dyads, 4) the RR dyads with these pivots on the body, or on the frame where they are chosen.

    The other pivot of each dyad is that of three positions, or, of two, the nearest place on the bisector.

    Args:
        given: displacements, the same for all dyads or (dyads, displacements).
        pivots: (dyads, 2) on the body and on the frame.
        fixed: (dyads,) whether the one on the frame is chosen.
    """
    ends = []
    for seen, (first, second) in ((given, (0, 1)), (given.inverse, (1, 0))):
        own = pivots[:, first]
        gaps = (seen.q - 1) * own[:, None] + seen.t
        gap, last = gaps[:, 0], gaps[:, -1]
        with np.errstate(divide="ignore", invalid="ignore"):
            if gaps.shape[1] == 1:
                along, middle = 1j * gap, own + gap / 2
                other = middle + along * np.real(np.conj(along) * (pivots[:, second] - middle)) / np.abs(gap) ** 2
            else:
                bend = 1j * (np.abs(last) ** 2 * gap - np.abs(gap) ** 2 * last)
                other = own - bend / (2 * np.imag(np.conj(last) * gap))
        ends.append(other)
    on_body, on_frame = np.where(fixed, ends[1], pivots[:, 0]), np.where(fixed, pivots[:, 1], ends[0])
    return np.stack([on_body, on_frame], axis=1).view(np.float64)


def slides_of_places(seen: Displacements, points: Complexes, angles: Reals) -> Reals:
    """(dyads, 3) sliding dyads: of two positions with these pivots, of three with lines at these angles.

    Args:
        seen: displacements of the side on which the pivot lies, the same for all dyads or (dyads, displacements).
        points: (dyads,)
        angles: (dyads,)
    """
    q = seen.q - 1
    if seen.q.shape[-1] == 1:
        angles = np.angle(q[..., 0] * points + seen.t[..., 0])
    else:  # Re(n* (q x + t)) = 0 with the normal n and q less 1: linear in x
        across = -1j * np.exp(-1j * angles)[:, None]
        (first, second), (a, b) = (across * q).T, -np.real(across * seen.t).T
        with np.errstate(divide="ignore", invalid="ignore"):
            points = 1j * (b * np.conj(first) - a * np.conj(second)) / np.imag(first * np.conj(second))
    return np.stack([points.real, points.imag, angles], axis=1)
