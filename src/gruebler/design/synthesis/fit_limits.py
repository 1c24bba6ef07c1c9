"""Limits that a fitted linkage keeps to while it is improved: a crank that turns, places, lengths, transmission angle.

Each limit is a function of the linkage's numbers that is negative inside. docs/theory/synthesis-curves.md. Those of
larger linkages are in `place_limits` and `drawing_limits`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import permutations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Reals
from gruebler.design.synthesis.demands import across_direction
from gruebler.design.synthesis.four_bar_kinds import FourBarKind

MARGIN = 1e-6
"""Sizes: so far from each limit."""
HELD = 1e-10
"""Sizes: a given length that is no number of a linkage is as near."""
_PUT_BACK = 3  # times, since limits are curved
_PIVOTS = ("a0x", "a0y", "b0x", "b0y")
_STEP = 1e-30  # of a complex difference, which loses no digit


class FitLimits(ABC):
    """What linkages keep to while their numbers are improved, many at once."""

    @abstractmethod
    def values(self, rows: NDArray[Any], phi: Reals) -> NDArray[Any]:
        """(limits, ..., starts) how far each limit is passed; negative inside. Margins are part of them.

        Args:
            rows: (unknowns, ..., starts).
            phi: (starts, points) crank angles.
        """

    @abstractmethod
    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """The values, and (limits, unknowns, starts) how they change with the numbers that are not held."""

    def passed(self, rows: Reals, phi: Reals) -> Reals:
        """(starts,) by how much each start passes the limit that it passes most; 0 inside."""
        values = self.values(rows, phi)
        return np.asarray(np.maximum(np.max(values, axis=0, initial=0.0) - MARGIN / 2, 0.0))

    def kept(self, rows: Reals, phi: Reals, gram: Reals, step: Reals, share: Reals) -> Reals:
        """(starts, numbers) the steps, those beyond a limit changed to the best within all, put back if these bend.

        Curves with corners are drawn by linkages at a limit; a step that is only refused there ends the search.

        Args:
            rows: (unknowns, starts).
            phi: (starts, points) crank angles.
            gram: (starts, numbers, numbers) what a change costs.
            step: (starts, numbers) the unknowns first.
            share: (starts,) of a limit that is passed already, which part is to be made up for.
        """
        values, slopes = self.linearised(rows, phi)
        if not len(values):
            return step
        unknowns, slack = len(rows), MARGIN / 4
        held = np.where(values > 0, share * values, values)
        step, beyond = _core.limit_steps(gram, step, held, np.ascontiguousarray(slopes), slack)
        at = np.flatnonzero(beyond & (share == 1))
        for _ in range(_PUT_BACK):
            moved = rows[:, at] + step[at, :unknowns].T
            passed = (self.values(moved, phi[at]) > 0).any(axis=0)
            at, moved = at[passed], moved[:, passed]
            if not len(at):
                break
            alike = np.ascontiguousarray(np.broadcast_to(np.eye(unknowns), (len(at), unknowns, unknowns)))
            values, slopes = self.linearised(moved, phi[at])
            still = np.zeros((len(at), unknowns))
            back, _ = _core.limit_steps(alike, still, values, np.ascontiguousarray(slopes), slack)
            step[at, :unknowns] += back
        return step


@dataclass(frozen=True, slots=True, kw_only=True)
class FourBarLimits(FitLimits):
    """What a linkage of a kind has to keep to, in the units of its numbers."""

    kind: FourBarKind
    turning: bool = False
    """The crank turns fully."""
    region: tuple[float, float, float, float] | None = None
    """Of the fixed pivots: least x, least y, greatest x, greatest y."""
    size_ratio: float = np.inf
    """The longest length of a link by the shortest."""
    transmission: float = 0.0
    """The least transmission angle: over the whole turn of a crank that turns fully, else at the points."""
    frame: float = 0.0
    """The given length of the frame; 0 where it is free."""
    frame_direction: float | None = None
    """The given angle of the line through both pivots with the x axis."""
    held: Mapping[str, float] = field(default_factory=dict)
    """Numbers that do not change."""

    @property
    def pivots(self) -> tuple[complex | None, complex | None]:
        """The given pivots of crank and rocker; None where free."""
        own, far = (
            complex(self.held[x], self.held[y]) if x in self.held else None for x, y in (_PIVOTS[:2], _PIVOTS[2:])
        )
        return own, far

    @property
    def narrow(self) -> bool:
        """Whether most curves of the atlas, put onto a target, pass a limit."""
        lengths = bool(self.frame) or self.frame_direction is not None or bool(set(self.held) - set(_PIVOTS))
        return self.region is not None or self.transmission > 0 or lengths

    @property
    def free(self) -> Reals:
        """(unknowns,) 1 for each number that may change, else 0."""
        return np.array([float(name not in self.held) for name in self.kind.unknowns])

    def values(self, rows: NDArray[Any], phi: Reals) -> NDArray[Any]:
        """Of numbers that are complex, too: all is analytic but where two parts of a limit are equal."""
        r = self.kind.named(rows)
        limits = []
        if self.turning:
            limits.append(self.kind.turning_excess(r) + MARGIN)
        for name, low, high in self._sides:
            limits += [low - r[name] + MARGIN, r[name] - high + MARGIN]
        if self.size_ratio < np.inf:
            lengths = self.kind.lengths(r)
            limits += [p / self.size_ratio - q + MARGIN for p, q in permutations(lengths, 2)]
        if self.transmission > 0:
            cosines = self.kind.cosines(r, None if self.turning else phi)
            most = np.cos(self.transmission)
            limits += [largest(cosines) - most + MARGIN, largest(-cosines) - most + MARGIN]
        if self.frame:
            frame = self.kind.frame(r)
            limits += [frame - self.frame - HELD, self.frame - frame - HELD]
        if self.frame_direction is not None:
            gap = np.stack([r["b0x"] - r["a0x"], r["b0y"] - r["a0y"]], axis=-1)
            off = across_direction(gap, self.frame_direction)
            limits += [off - HELD, -off - HELD]
        return np.array(limits) if limits else np.zeros((0, *rows.shape[1:]))

    @property
    def _sides(self) -> list[tuple[str, float, float]]:
        """The pivots' coordinates that a region bounds, with their bounds."""
        if self.region is None:
            return []
        bounds = (self.region[::2], self.region[1::2])
        return [(name, *bounds[k % 2]) for k, name in enumerate(_PIVOTS) if name in self.kind.unknowns]

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """By complex differences."""
        return self.values(rows, phi), complex_slopes(self, rows, phi) * self.free[:, None]


def complex_slopes(limits: FitLimits, rows: Reals, phi: Reals) -> Reals:
    """(limits, unknowns, starts) how analytic limits change with all numbers."""
    moved = rows[:, None, :] + 1j * _STEP * np.eye(len(rows))[:, :, None]
    return np.asarray(limits.values(moved, phi).imag / _STEP)


def crank_turns(kind: FourBarKind, rows: Reals) -> NDArray[np.bool_]:
    """(linkages,) whether the crank turns fully, by Grashof."""
    return np.asarray(kind.turning_excess(kind.named(rows)) < 0)


def largest(values: NDArray[Any]) -> NDArray[Any]:
    """The largest along the last axis, by its real part."""
    if values.dtype.kind == "f":
        return np.asarray(np.fmax.reduce(values, axis=-1))
    at = np.asarray(np.fmax(values.real, -np.inf).argmax(axis=-1))[..., None]
    return np.asarray(np.take_along_axis(values, at, axis=-1)[..., 0])
