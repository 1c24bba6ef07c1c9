"""Values as plain data for JSON: their attributes by name, each in its unit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from fractions import Fraction
from math import degrees, isnan
from typing import Any

from gruebler.base.errors import GrueblerError

Units = Mapping[str, Callable[[Any], Any]]
"""What makes of an attribute's numbers those that are written, such as degrees, by the name of the attribute."""
Shown = Mapping[type, str]
"""Which attributes of a class are written; without a row all fields of a dataclass are."""


def plain(
    value: Any,
    keys: str = "",
    *,
    units: Units | None = None,
    shown: Shown | None = None,
    text: Callable[[Any], Any] = str,
) -> Any:
    """A value as plain data: records as objects, tuples and arrays as lists, texts and errors as text, NaN as null.

    A key that ends in ``_deg`` without an attribute of this name stands for the attribute without this ending, an
    angle in radians. Complex numbers are written as places, [x, y].

    Args:
        value: what is written, with all that it holds.
        keys: its attributes that are written, or those of each value of a list; by default those of its class.
        units: conversions of numbers by the names of their attributes, in records within records too.
        shown: the attributes of other classes that it holds.
        text: what becomes of a text that is readable in several languages.

    >>> from dataclasses import dataclass
    >>> from math import degrees, nan, pi
    >>> @dataclass
    ... class Turn:
    ...     angles: tuple[float, ...]
    ...     error: float
    >>> plain(Turn((pi, pi / 2), nan), units={"angles": degrees})
    {'angles': [180.0, 90.0], 'error': None}
    >>> plain([Turn((pi,), 1.0)], "angles_deg")
    [{'angles_deg': [180.0]}]
    """
    units, shown = units or {}, shown or {}

    def converted(value: Any, unit: Callable[[Any], Any] | None = None) -> Any:
        cls = type(value)
        if isinstance(value, Enum | GrueblerError):
            return str(value)
        if hasattr(value, "in_language"):
            return text(value)
        if value is None or isinstance(value, bool | int | float | str | Fraction):
            number = None if isinstance(value, float) and isnan(value) else value
            return number if unit is None or number is None else unit(number)
        if isinstance(value, Mapping):
            return {str(key): converted(item, unit) for key, item in value.items()}
        if is_dataclass(value) or cls in shown or hasattr(value, "to_json"):
            return value.to_json() if hasattr(value, "to_json") else record(value, shown.get(cls, ""))
        if isinstance(value, complex):
            value = [value.real, value.imag]
        return [converted(item, unit) for item in (value if isinstance(value, Sequence) else value.tolist())]

    def record(value: Any, keys: str) -> dict[str, Any]:
        names = keys.split() or [field.name for field in fields(value)]
        return dict(attribute(value, name) for name in names)

    def attribute(value: Any, name: str) -> tuple[str, Any]:
        if name.endswith("_deg") and not hasattr(value, name):
            return name, converted(getattr(value, name.removesuffix("_deg")), degrees)
        return name, converted(getattr(value, name), units.get(name))

    if not keys or value is None:
        return converted(value)
    return [record(each, keys) for each in value] if isinstance(value, list) else record(value, keys)
