"""Loads that are not constant: expressions, curves and motors, all of them functions of the state of the linkage."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, final

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.formulas import Formula
from gruebler.base.immutable import settle


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """What a load may depend on, (rows,) each: lengths in the linkage's unit, angles in radians, times in seconds."""

    time: Reals
    drives: Reals
    """(rows, drives)."""
    speeds: Reals
    """(rows, drives)."""
    x: Reals
    """Of the point where a force acts; of a moment the origin of its link."""
    y: Reals
    vx: Reals
    vy: Reals
    angle: Reals
    """Of the link."""
    omega: Reals
    """Its angular velocity."""

    @property
    def drive(self) -> Reals:
        """The first drive's value."""
        return self.drives[:, 0]

    @property
    def speed(self) -> Reals:
        """The first drive's speed."""
        return self.speeds[:, 0]


VARIABLES = ("time", "drive", "speed", "x", "y", "vx", "vy", "angle", "omega")
"""What expressions and curves may depend on, by the names of `State`."""


class Law(Protocol):
    """A load as a function of the state: a function, `LoadFormula`, `Curve`, `Motor`."""

    def __call__(self, state: State, /) -> Any:
        """A number, or one for each row, (rows,)."""


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class LoadFormula:
    """A load as a `Formula` of `VARIABLES`, such as ``-200*where(vx < 0, 1, 0)``; angles are in radians.

    >>> LoadFormula("2*drive + time").names
    ('drive', 'time')
    """

    text: str

    def __post_init__(self) -> None:
        assert self._formula is not None

    @property
    def names(self) -> tuple[str, ...]:
        """What it depends on, sorted."""
        return self._formula.names

    def __call__(self, state: State, /) -> Reals:
        """Its value, (), or one for each row, (rows,)."""
        return self._formula(**{name: getattr(state, name) for name in self.names})

    @cached_property
    def _formula(self) -> Formula:
        return Formula(self.text, VARIABLES, LinkageError)

    def switched(self) -> SwitchedLaw:
        """The same with its comparisons and signs held on one side each."""
        return SwitchedLaw(self._formula)


@final
class SwitchedLaw:
    """A formula whose comparisons and signs stay as they are until they are turned over: smooth between two jumps."""

    def __init__(self, formula: Formula) -> None:
        self._formula = formula
        self.sides = formula.at_equality

    def __call__(self, state: State, /) -> Reals:
        """Its value, (), or one for each row, (rows,)."""
        return self._formula.on_sides(self.sides, **self._of(state))

    def gaps(self, state: State) -> list[float]:
        """For each comparison or sign a difference that is positive where it holds, in the first row."""
        return [float(gap.ravel()[0]) for gap in self._formula.gaps(**self._of(state))]

    def _of(self, state: State) -> dict[str, Reals]:
        return {name: getattr(state, name) for name in self._formula.names}


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class Curve:
    """A load as a table of one of `VARIABLES`, linear between its points, constant outside them; or repeated.

    >>> Curve([(0, 0), (1, 10)]).value(np.array([0.5, 2.0])).tolist()
    [5.0, 10.0]
    >>> Curve([(0, 0), (1, 10)], period=2).value(np.array([2.5])).tolist()
    [5.0]
    """

    points: Sequence[tuple[float, float]]
    """(x, y), x increasing."""
    of: str = "drive"
    period: float | None = None
    """After which the table begins again, as 2 pi for a crank."""

    def __post_init__(self) -> None:
        points = tuple((float(x), float(y)) for x, y in self.points)
        ways = [x for x, _ in points]
        if len(points) < 2 or not np.isfinite(points).all() or any(b <= a for a, b in itertools.pairwise(ways)):
            raise LinkageError("a curve has two points or more, finite, whose first numbers increase")
        if self.of not in (*VARIABLES, "length"):
            raise LinkageError("a curve is one of {known}, not of {word!r}{suggestion}", **unknown(self.of, VARIABLES))
        if self.period is not None and not (
            0 < self.period < 1e100 and ways[-1] - ways[0] <= self.period * (1 + 1e-12)
        ):
            raise LinkageError(
                "the period of a curve is at least as long as its table, not {period:g}", period=self.period
            )
        settle(self, points=points)

    def __call__(self, state: State, /) -> Reals:
        """Its value in each row."""
        return self.value(getattr(state, self.of))

    def value(self, at: Any) -> Reals:
        """The value at numbers of what it is a curve of."""
        x, y = np.array(self.points).T
        return np.asarray(np.interp(at, x, y, period=self.period))

    def area(self, at: Any) -> Reals:
        """The integral from the first point; beyond the last one of a constant."""
        x, y = np.array(self.points).T
        at = np.asarray(at, np.float64)
        sums = np.concatenate([[0.0], np.cumsum(np.diff(x) * (y[1:] + y[:-1]) / 2)])
        k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 1)
        return np.asarray(sums[k] + (at - x[k]) * (self.value(at) + y[k]) / 2)


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class Motor:
    """A motor whose torque falls in a straight line from standstill to the speed at which it idles.

    >>> Motor(12.0, 100.0).at(np.array([0.0, 50.0])).tolist()
    [12.0, 6.0]

    See Also:
        `Loads`, `simulate`

    Theory:
        docs/theory/free-motion.md
    """

    stall: float
    """The torque at standstill: force times the linkage's unit; the force of a driven slide."""
    idle_speed: float
    """Radians a second; of a slide the linkage's unit a second."""

    def __post_init__(self) -> None:
        if not (0 < self.stall < 1e100 and 0 < abs(self.idle_speed) < 1e100):
            raise LinkageError("a motor has a positive torque at standstill and a speed at which it idles, not 0")

    def __call__(self, state: State, /) -> Reals:
        """The torque in each row."""
        return self.at(state.speed)

    def at(self, speed: Any) -> Reals:
        """The torque at a speed, in the sense of the idle speed."""
        sense = math.copysign(1.0, self.idle_speed)
        return np.asarray(self.stall * sense * (1 - np.asarray(speed) / self.idle_speed))
