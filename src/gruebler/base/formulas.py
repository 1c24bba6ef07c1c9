"""Formulas as text, such as ``log10(x)`` or ``2*drive + time``: read without ever running them as code."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.immutable import settle
from gruebler.base.text import Message, message

_LONGEST = 500  # characters
_DEEPEST = 40  # operations within one another

_CONSTANTS = {"pi": np.pi, "e": np.e, "deg": np.pi / 180}
_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    function.__name__: function
    for function in (np.sqrt, np.exp, np.log, np.log10, np.log2, np.sin, np.cos, np.tan, np.sinh, np.cosh, np.tanh)
} | {
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "abs": np.abs,
    "sign": np.sign,
    "floor": np.floor,
    "min": np.minimum,
    "max": np.maximum,
    "where": np.where,
}
_COUNTS = {"where": 3, "min": 2, "max": 2, "atan2": 2}
"""How many values a function takes; the others take one."""
_OPERATORS: Mapping[type[ast.AST], Callable[..., Any]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
    ast.Mod: np.mod,
    ast.UAdd: np.positive,
    ast.USub: np.negative,
    ast.Lt: np.less,
    ast.LtE: np.less_equal,
    ast.Gt: np.greater,
    ast.GtE: np.greater_equal,
}


@dataclass(frozen=True)
class Formula:
    """A function of some variables: numbers, + - * / % ** (or ^), < <= > >=, parentheses, and the usual functions.

    These are sqrt, exp, log, log10, log2, abs, sign, floor, the circular and hyperbolic functions with asin, acos, atan
    and atan2, min, max, and where(condition, then, otherwise). The numbers pi, e and deg (a degree) are known. Anything
    else raises ``error``, naming it.

    >>> Formula("log10(x) + 2*x^2", ("x",))(x=1.0)
    array(2.)
    >>> Formula("besselj(x)", ("x",))
    Traceback (most recent call last):
        ...
    gruebler.base.errors.GrueblerError: 'besselj(x)': unknown name 'besselj'; known are x, pi, ...
    """

    text: str
    variables: tuple[str, ...]
    error: Callable[[Message], Exception] = field(default=GrueblerError, repr=False, compare=False)
    tree: ast.expr = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.text, str) or len(self.text) > _LONGEST:
            raise self.error(message("a formula is a text of at most {longest} characters", longest=_LONGEST))
        try:
            tree = ast.parse(self.text.strip().replace("^", "**"), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise self.error(message("the formula {formula!r} cannot be read", formula=self.text)) from None
        self._check(tree, 0)
        settle(self, tree=tree)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The variables on which it depends, sorted."""
        names = {node.id for node in ast.walk(self.tree) if isinstance(node, ast.Name)}
        return tuple(sorted(names & set(self.variables)))

    def _check(self, node: ast.AST, depth: int) -> None:
        if depth > _DEEPEST:
            raise self.error(message("the formula {formula!r} is nested too deeply", formula=self.text[:40]))
        match node:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool) and abs(value) < 1e100:
                return
            case ast.Name(id=name):
                known = (*self.variables, *_CONSTANTS)
                if name not in known:
                    self._unknown(name, known)
                return
            case ast.Call(func=ast.Name(id=name), args=parts, keywords=[]):
                if name not in _FUNCTIONS:
                    self._unknown(name, (*self.variables, *_CONSTANTS, *_FUNCTIONS))
                if len(parts) != (count := _COUNTS.get(name, 1)):
                    raise self.error(
                        message("{formula!r}: {name} takes {count} values", formula=self.text, name=name, count=count)
                    )
            case ast.BinOp(op=op) | ast.UnaryOp(op=op) | ast.Compare(ops=[op]) if type(op) in _OPERATORS:
                pass
            case _:
                raise self.error(
                    message(
                        "{formula!r}: {part!r} is none of numbers, names, + - * / % ^ < > and calls of functions",
                        formula=self.text,
                        part=ast.unparse(node)[:40],
                    )
                )
        for part in _parts(node):
            self._check(part, depth + 1)

    def _unknown(self, name: str, known: tuple[str, ...]) -> None:
        raise self.error(
            message(
                "{formula!r}: unknown name {word!r}{suggestion}; known are {known}",
                formula=self.text,
                **unknown(name, known),
            )
        )

    def __str__(self) -> str:
        return self.text

    @cached_property
    def switches(self) -> tuple[ast.expr, ...]:
        """The comparisons and signs in it: where one of them turns over it may jump."""
        return tuple(
            node
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Compare) or (isinstance(node, ast.Call) and ast.unparse(node.func) == "sign")
        )

    @property
    def at_equality(self) -> list[bool]:
        """For each switch whether it holds where both sides are equal; a sign is taken for positive."""
        return [not (isinstance(s, ast.Compare) and isinstance(s.ops[0], ast.Lt | ast.Gt)) for s in self.switches]

    def gaps(self, **values: ArrayLike) -> list[Reals]:
        """For each switch a difference that is positive where it holds, or where the sign is positive.

        >>> Formula("where(v < 2, 1, 0)*sign(x)", ("v", "x")).gaps(v=1.5, x=-3.0)
        [array(-3.), array(0.5)]
        """
        gaps = []
        for node in self.switches:
            parts = [self._value(part, values, {}) for part in _parts(node)]
            turned = isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Lt | ast.LtE)
            gaps.append(np.asarray((parts[0] - parts[1] if len(parts) > 1 else parts[0]) * (-1.0 if turned else 1.0)))
        return gaps

    def __call__(self, **values: ArrayLike) -> Reals:
        """Its values, in the shape of those of the variables together; NaN or infinity where it has none."""
        return self.on_sides((), **values)

    def on_sides(self, sides: Sequence[bool], **values: ArrayLike) -> Reals:
        """Its values if its switches hold or not as given, whatever the variables are; without sides as it is written.

        >>> float(Formula("where(v < 2, 10, 20) + v", ("v",)).on_sides([False], v=1.5))
        21.5
        """
        with np.errstate(all="ignore"):
            result = np.asarray(
                self._value(self.tree, values, dict(zip(self.switches, sides, strict=False))), np.float64
            )
        return np.array(np.broadcast_to(result, np.broadcast_shapes(*map(np.shape, values.values()))))

    def _value(self, tree: ast.expr, values: Mapping[str, ArrayLike], sides: Mapping[ast.expr, bool]) -> Any:
        def value(node: ast.AST) -> Any:
            match node:
                case ast.Call() if node in sides:
                    return np.float64(1.0 if sides[node] else -1.0)
                case ast.Compare() if node in sides:
                    return np.float64(sides[node])
                case ast.Constant(value=number):
                    return np.float64(number)  # type: ignore[arg-type]
                case ast.Name(id=name):
                    return np.float64(_CONSTANTS[name]) if name in _CONSTANTS else np.asarray(values[name], np.float64)
                case ast.Call(func=ast.Name(id=name)):
                    return _FUNCTIONS[name](*map(value, _parts(node)))
                case ast.BinOp(op=op) | ast.UnaryOp(op=op) | ast.Compare(ops=[op]):
                    # A truth value is a number: numpy has no -True, and takes exp of it to three digits.
                    return np.asarray(_OPERATORS[type(op)](*map(value, _parts(node))), np.float64)
            raise AssertionError(node)

        return value(tree)


def _parts(node: ast.AST) -> list[ast.expr]:
    """What an operation or a call is done to, in order."""
    match node:
        case ast.Call(args=parts):
            return parts
        case ast.BinOp(left=left, right=right) | ast.Compare(left=left, comparators=[right]):
            return [left, right]
        case ast.UnaryOp(operand=operand):
            return [operand]
    raise AssertionError(node)
