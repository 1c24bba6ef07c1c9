"""Functions that crank and output are to follow, and the usual first choice of precision points."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.formulas import Formula


def chebyshev_spacing(low: float, high: float, count: int) -> Reals:
    """The zeros of Chebyshev's polynomial over an interval: the usual first choice of precision points.

    >>> chebyshev_spacing(1, 2, 3).round(6).tolist()
    [1.066987, 1.5, 1.933013]
    """
    k = np.arange(count, 0, -1)
    return np.asarray((low + high) / 2 + (high - low) / 2 * np.cos((2 * k - 1) * np.pi / (2 * count)))


@dataclass(frozen=True)
class FunctionLaw:
    """A function that crank and output are to follow over an interval.

    The input turns from ``input_start`` by ``input_swing`` while x goes through the interval, the output from
    ``output_start`` by ``output_swing`` (angles in radians, or a travel) while y = f(x) goes from its value at the
    begin to that at the end. A start that is None is free.

    Raises `SynthesisError` where the function has no values or does not change from begin to end.

    >>> law = FunctionLaw("log10(x)", interval=(1, 2), input_swing=1.0, output_swing=0.5)
    >>> float(law.outputs(1.5).round(6))
    0.292481
    """

    function: str
    _: KW_ONLY
    interval: tuple[float, float]
    input_swing: float
    output_swing: float
    input_start: float | None = None
    output_start: float | None = None

    def __post_init__(self) -> None:
        low, high = self.interval
        if not (np.isfinite([low, high]).all() and low < high):
            raise SynthesisError(
                "{key}: expected its begin before its end, but found {low:g} and {high:g}",
                key="interval",
                low=low,
                high=high,
            )
        for name in ("input_swing", "output_swing"):
            if not np.isfinite(getattr(self, name)) or getattr(self, name) == 0:
                raise SynthesisError(
                    "{name}: expected a number that is not 0, but found {value:g}",
                    name=name,
                    value=getattr(self, name),
                )
        values = self.formula(x=np.linspace(low, high, 1001))
        if not np.isfinite(values).all():
            raise SynthesisError(
                "the function {function!r} is not defined everywhere from {low:g} to {high:g}",
                function=self.function,
                low=low,
                high=high,
            )
        if abs(values[-1] - values[0]) <= 1e-12 * np.abs(values).max():
            raise SynthesisError(
                "the function {function!r} has the same value at {low:g} and {high:g}",
                function=self.function,
                low=low,
                high=high,
            )

    @cached_property
    def formula(self) -> Formula:
        """The function, read."""
        return Formula(self.function, ("x",), SynthesisError)

    def inputs(self, x: ArrayLike) -> Reals:
        """The input at x, from its start, or from 0."""
        low, high = self.interval
        return np.asarray((self.input_start or 0.0) + self.input_swing * (np.asarray(x) - low) / (high - low))

    def outputs(self, x: ArrayLike) -> Reals:
        """The output at x, from its start, or from 0."""
        low, high = self.formula(x=self.interval)
        return np.asarray((self.output_start or 0.0) + self.output_swing * (self.formula(x=x) - low) / (high - low))
