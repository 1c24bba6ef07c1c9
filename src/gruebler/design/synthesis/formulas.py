"""Functions of one variable as text, such as ``log10(x)``: read without ever running them as code."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError, nearest
from gruebler.base.immutable import settle

_LONGEST = 300  # characters
_DEEPEST = 40  # operations within one another

_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    name: getattr(np, name)
    for name in ("sqrt", "exp", "log", "log10", "log2", "sin", "cos", "tan", "sinh", "cosh", "tanh", "abs")
} | {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan}
_CONSTANTS = {"pi": np.pi, "e": np.e}
_OPERATORS: Mapping[type, Callable[..., Any]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
    ast.UAdd: np.positive,
    ast.USub: np.negative,
}


@dataclass(frozen=True)
class Formula:
    """A function of x: numbers, ``+ - * / **``, ``^`` for a power, parentheses, pi, e, and the usual functions.

    Raises `SynthesisError` for anything else, naming it.

    >>> Formula("log10(x) + 2*x^2")(1.0)
    array(2.)
    >>> Formula("besselj(x)")
    Traceback (most recent call last):
        ...
    gruebler.base.errors.SynthesisError: the function 'besselj(x)': unknown name 'besselj'; known are x, pi, ...
    """

    text: str
    tree: ast.expr = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.text, str) or len(self.text) > _LONGEST:
            raise SynthesisError("a function is a text of at most {longest} characters", longest=_LONGEST)
        try:
            tree = ast.parse(self.text.strip().replace("^", "**"), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise SynthesisError(
                "the function {function!r} cannot be read; write for example log10(x)", function=self.text
            ) from None
        self._check(tree, 0)
        settle(self, tree=tree)

    def _check(self, node: ast.AST, depth: int) -> None:
        if depth > _DEEPEST:
            raise SynthesisError("the function {function!r} is nested too deeply", function=self.text[:40])
        match node:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool) and abs(value) < 1e100:
                return
            case ast.Name(id=name):
                if name != "x" and name not in _CONSTANTS:
                    self._unknown(name)
            case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]):
                if name not in _FUNCTIONS:
                    self._unknown(name)
                self._check(argument, depth + 1)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
                self._check(left, depth + 1)
                self._check(right, depth + 1)
            case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
                self._check(operand, depth + 1)
            case _:
                part = ast.unparse(node)[:40]
                raise SynthesisError(
                    "the function {function!r}: {part!r} is none of numbers, x, + - * / ^ and calls",
                    function=self.text,
                    part=part,
                )

    def _unknown(self, name: str) -> None:
        known = ["x", *_CONSTANTS, *_FUNCTIONS]
        close = nearest(name, known)
        raise SynthesisError(
            "the function {function!r}: unknown name {name!r}{close}; known are {known}",
            function=self.text,
            name=name,
            close=close,
            known=", ".join(known),
        )

    def __str__(self) -> str:
        return self.text

    def __call__(self, x: ArrayLike) -> Reals:
        """Its values; NaN or infinity where it has none."""
        values = np.asarray(x, np.float64)

        def value(node: ast.AST) -> Any:
            match node:
                case ast.Constant(value=number):
                    return np.float64(number)  # type: ignore[arg-type]
                case ast.Name(id=name):
                    return values if name == "x" else np.float64(_CONSTANTS[name])
                case ast.Call(func=ast.Name(id=name), args=[argument]):
                    return _FUNCTIONS[name](value(argument))
                case ast.BinOp(left=left, op=op, right=right):
                    return _OPERATORS[type(op)](value(left), value(right))
                case ast.UnaryOp(op=op, operand=operand):
                    return _OPERATORS[type(op)](value(operand))
            raise AssertionError(node)

        with np.errstate(all="ignore"):
            return np.asarray(value(self.tree) + 0.0 * values)


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
        formula = Formula(self.function)
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
        values = formula(np.linspace(low, high, 1001))
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

    def inputs(self, x: ArrayLike) -> Reals:
        """The input at x, from its start, or from 0."""
        low, high = self.interval
        return np.asarray((self.input_start or 0.0) + self.input_swing * (np.asarray(x) - low) / (high - low))

    def outputs(self, x: ArrayLike) -> Reals:
        """The output at x, from its start, or from 0."""
        formula = Formula(self.function)
        low, high = formula(self.interval)
        return np.asarray((self.output_start or 0.0) + self.output_swing * (formula(x) - low) / (high - low))
