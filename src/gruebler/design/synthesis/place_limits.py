"""Limits of linkages that are places of joints: a region for fixed pivots, given lengths, the ratio of lengths.

docs/theory/synthesis-any.md. The places are those of a drawing, or of the pins of every link in its own plane.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.demands import Demands, across_direction
from gruebler.design.synthesis.fit_limits import HELD, MARGIN, FitLimits, complex_slopes, largest


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceLimits(FitLimits):
    """What pins keep to, of which numbers of a linkage are x and the next ones y.

    >>> limits = PlaceLimits(pins={"0": (0, 2), "1": (0, 4)}, frame="0", demands=Demands(size_ratio=2), unit=1.0)
    >>> rows = np.array([[0.0], [0.0], [1.0], [0.0], [0.0], [3.0]])
    >>> limits.passed(rows, np.zeros((1, 1))).round(3).tolist()
    [0.5]
    """

    pins: dict[str, tuple[int, ...]]
    """Of each link the numbers that are x of its pins."""
    frame: str
    demands: Demands
    unit: float
    """The size by which limits are measured."""
    held: frozenset[int] = frozenset()
    """Numbers that do not change."""

    def values(self, rows: NDArray[Any], phi: Reals) -> NDArray[Any]:
        """Of numbers that are complex, too: all is analytic but where two parts of a limit are equal."""
        del phi  # lengths do not change when the crank turns
        limits = []
        if self.demands.region is not None:
            for x in self.pins[self.frame]:
                for k in range(2):
                    low, high = self.demands.region[k::2]
                    limits += [(low - rows[x + k]) / self.unit + MARGIN, (rows[x + k] - high) / self.unit + MARGIN]
        for link, wanted in self.demands.lengths:
            if len(self.pins.get(link, ())) > 1:
                limits += _both_ways(self._lengths(rows, [self.pins[link]]) - wanted / self.unit)
        if self.demands.frame_direction is not None and len(self.pins[self.frame]) > 1:
            p, q = np.array([*combinations(self.pins[self.frame], 2)]).T
            gaps = np.stack([rows[q] - rows[p], rows[q + 1] - rows[p + 1]], axis=-1) / self.unit
            limits += _both_ways(across_direction(gaps, self.demands.frame_direction))
        if self.demands.size_ratio < np.inf and any(len(own) > 1 for own in self.pins.values()):
            every = self._lengths(rows, self.pins.values())
            limits += [*(largest(np.moveaxis(every, 0, -1)) / self.demands.size_ratio - every + MARGIN)]
        return np.array(limits) if limits else np.zeros((0, *rows.shape[1:]))

    def _lengths(self, rows: NDArray[Any], links: Iterable[tuple[int, ...]]) -> NDArray[Any]:
        """(pairs, ..., starts) the distances of the pins of each of these links, each with each."""
        p, q = np.array([pair for own in links for pair in combinations(own, 2)]).T
        return np.asarray(np.sqrt((rows[p] - rows[q]) ** 2 + (rows[p + 1] - rows[q + 1]) ** 2) / self.unit)

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """By complex differences."""
        slopes = complex_slopes(self, rows, phi)
        slopes[:, [*self.held]] = 0
        return self.values(rows, phi), slopes


def _both_ways(values: NDArray[Any]) -> list[NDArray[Any]]:
    """That what is nearest to zero of values (pairs, ..., starts) is zero."""
    nearest = np.take_along_axis(values, np.abs(values.real).argmin(axis=0)[None], axis=0)[0]
    return [nearest - HELD, -nearest - HELD]
