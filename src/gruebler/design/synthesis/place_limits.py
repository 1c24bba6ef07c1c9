"""Limits of linkages that are places of joints: a region for fixed pivots, given lengths, the ratio of lengths.

docs/theory/synthesis-any.md. The places are those of a drawing, or of the pins of every link in its own plane.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.demands import Demands, across_direction
from gruebler.design.synthesis.fit_limits import HELD, MARGIN, FitLimits


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

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of numbers (numbers, starts)."""
        del phi  # lengths do not change when the crank turns
        return self._joined([values for values, _ in self._kinds(rows, sloped=False)], rows.shape[1:])

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Exact."""
        del phi
        kinds = [*self._kinds(rows, sloped=True)]
        slopes = self._joined([slopes for _, slopes in kinds], rows.shape)
        slopes[:, [*self.held]] = 0
        return self._joined([values for values, _ in kinds], rows.shape[1:]), slopes

    @staticmethod
    def _joined(blocks: list[Reals], shape: tuple[int, ...]) -> Reals:
        return np.concatenate(blocks) if blocks else np.zeros((0, *shape))

    def _kinds(self, rows: Reals, *, sloped: bool) -> Iterator[tuple[Reals, Reals]]:
        """Of each kind of limit the values (limits, starts), and (limits, numbers, starts) if they are wanted."""
        demands, unit = self.demands, self.unit
        if demands.region is not None:
            x = np.array(self.pins[self.frame])
            for k in range(2):
                for sign, bound in zip((-1, 1), demands.region[k::2], strict=True):
                    slopes = np.zeros((len(x), *rows.shape))
                    slopes[np.arange(len(x)), x + k] = sign / unit
                    yield sign * (rows[x + k] - bound) / unit + MARGIN, slopes
        for link, wanted in demands.lengths:
            if len(self.pins.get(link, ())) > 1:
                lengths, slopes = self._lengths(rows, (self.pins[link],), sloped=sloped)
                yield _both_ways(lengths - wanted / unit, slopes)
        if demands.frame_direction is not None and len(self.pins[self.frame]) > 1:
            p, q = _pairs((self.pins[self.frame],))
            gaps = np.stack([rows[q] - rows[p], rows[q + 1] - rows[p + 1]], axis=-1) / unit
            slopes, every = np.zeros((len(p), *rows.shape)), np.arange(len(p))
            for k, slope in enumerate(across_direction(np.eye(2), demands.frame_direction) / unit):
                slopes[every, q + k], slopes[every, p + k] = slope, -slope
            yield _both_ways(across_direction(gaps, demands.frame_direction), slopes)
        if demands.size_ratio < np.inf and any(len(own) > 1 for own in self.pins.values()):
            lengths, slopes = self._lengths(rows, tuple(self.pins.values()), sloped=sloped)
            longest = np.fmax.reduce(lengths, axis=0) / demands.size_ratio
            if sloped:
                at = np.nan_to_num(lengths, nan=-np.inf).argmax(axis=0)
                slopes = np.moveaxis(slopes[at, :, np.arange(len(at))], 0, -1) / demands.size_ratio - slopes
            yield longest - lengths + MARGIN, slopes

    def _lengths(self, rows: Reals, links: tuple[tuple[int, ...], ...], *, sloped: bool) -> tuple[Reals, Reals]:
        """(pairs, starts) the distances of the pins of each of these links, each with each, and their slopes."""
        p, q = _pairs(links)
        x, y = rows[q] - rows[p], rows[q + 1] - rows[p + 1]
        lengths = np.sqrt(x**2 + y**2)
        slopes = np.zeros((len(p) if sloped else 0, *rows.shape))
        if sloped:
            every = np.arange(len(p))
            for k, along in enumerate((x, y)):
                slopes[every, q + k] = along / (lengths * self.unit)
                slopes[every, p + k] = -slopes[every, q + k]
        return lengths / self.unit, slopes


@cache
def _pairs(links: tuple[tuple[int, ...], ...]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The numbers of the pins of each link, each with each."""
    first, other = np.array([pair for own in links for pair in combinations(own, 2)]).T
    return first, other


def _both_ways(values: Reals, slopes: Reals) -> tuple[Reals, Reals]:
    """That what is nearest to zero of values (pairs, starts) is zero; with slopes (pairs or 0, numbers, starts)."""
    at, starts = np.abs(values).argmin(axis=0), np.arange(values.shape[1])
    nearest, slope = values[at, starts], slopes[at, :, starts].T if len(slopes) else slopes
    return np.stack([nearest - HELD, -nearest - HELD]), np.stack([slope, -slope])
