"""Where paths end that cannot be followed to their end: at singular solutions, or at infinity.

Near the end t = 1 of a path z is a power series in s = (1 - t)^(1/c) with finitely many negative powers; c, the winding
number, is how often t has to go round 1 until z comes back. Cauchy's integrals over these turns give its coefficients.
docs/theory/synthesis-points.md.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Integers

_RADII = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
"""Circles about the end. The smallest two neighbours that agree count: a larger one may hold another singular task."""
_CORNERS = 12  # of the polygon that stands for a circle
_MOST_TURNS = 12
_CLOSED = 1e-6  # relative: the path has come back
_POLE = 1e-4  # relative: a negative power of this size is there; rounding and samples leave less
_AGREE = 1e-3  # relative: limits from two circles

Follow = Callable[[Complexes, Complexes, Complexes], tuple[Complexes, NDArray[np.bool_]]]
"""Carries solutions from one task to another: the ends, and which of them arrived."""


class PathEnds(NamedTuple):
    """Where paths end."""

    z: Complexes
    """(paths, 8) the limits of those that are finite."""
    winding: Integers
    """(paths,) the winding number; 0 where none was found."""
    infinite: NDArray[np.bool_]
    """(paths,) whether the path goes to infinity."""


def path_ends(starts: Complexes, begin: Complexes, end: Complexes, follow: Follow) -> PathEnds:
    """The ends of paths from one task to another, without ever solving the equations at the end itself."""
    count = len(starts)
    limits, winding, infinite = starts.copy(), np.zeros(count, np.int64), np.zeros(count, bool)
    here, task, going = starts.copy(), begin, np.arange(count)
    last: dict[int, _End] = {}
    for radius in _RADII:
        corners = 1 - radius * np.exp(2j * np.pi * np.arange(_CORNERS + 1) / _CORNERS)
        tasks = [begin + t * (end - begin) for t in corners]
        moved, good = follow(here[going], task, tasks[0])
        here[going], task, going = moved, tasks[0], going[good]
        for k, samples in zip(going.tolist(), _turns(here[going], tasks, follow), strict=True):
            if samples is None:
                continue
            now = _end(samples)
            if k in last and now.agrees(last[k]):
                limits[k], winding[k], infinite[k] = now
            last[k] = now
    return PathEnds(limits, winding, infinite)


class _End(NamedTuple):
    """What one circle says of one path."""

    limit: Complexes
    winding: int
    infinite: bool

    def agrees(self, other: _End) -> bool:
        """Whether another circle says the same."""
        size = 1e-3 + np.abs(self.limit).max()
        near = self.infinite or bool(np.abs(self.limit - other.limit).max() <= _AGREE * size)
        return self.winding == other.winding and self.infinite == other.infinite and near


def _end(samples: Complexes) -> _End:
    """The series of one path from its samples: the constant term, and whether there are negative powers."""
    modes = np.fft.fft(samples, axis=0) / len(samples)
    poles = np.abs(modes[-(len(samples) // 4) :]).max(axis=0)  # beyond a quarter positive powers look like negative
    infinite = bool((poles > _POLE * (1e-3 + np.abs(samples).max())).any())
    return _End(modes[0], len(samples) // _CORNERS, infinite)


def _turns(z: Complexes, tasks: list[Complexes], follow: Follow) -> list[Complexes | None]:
    """The samples of each path on its turns until it closes; None if it does not."""
    samples: list[list[Complexes]] = [[] for _ in z]
    closed: list[Complexes | None] = [None] * len(z)
    going, at = np.arange(len(z)), z.copy()
    for _ in range(_MOST_TURNS):
        for first, second in pairwise(tasks):
            for row, k in zip(at, going, strict=True):
                samples[k].append(row)
            at, good = follow(at, first, second)
            at, going = at[good], going[good]
        back = np.abs(at - z[going]).max(axis=1) <= _CLOSED * (1e-3 + np.abs(z[going]).max(axis=1))
        for k in going[back]:
            closed[k] = np.array(samples[k])
        at, going = at[~back], going[~back]
        if not len(going):
            break
    return closed
