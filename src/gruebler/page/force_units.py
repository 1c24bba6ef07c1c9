"""Units in which forces, moments, powers and works of any size have few digits."""

from __future__ import annotations

from math import isfinite

_LARGE, _SMALL, _TINY = 1e4, 0.1, 1e-4


def unit_for(largest: float, unit: str) -> tuple[str, float]:
    """The unit for amounts up to a largest one, and how much it is in the given one.

    >>> [unit_for(amount, "N") for amount in (12300.0, 1230.0, 0.0)]
    [('kN', 1000.0), ('N', 1.0), ('N', 1.0)]
    >>> unit_for(0.0138, "N·m"), unit_for(-7e-05, "W")
    (('N·mm', 0.001), ('µW', 1e-06))
    """
    size = abs(largest)
    if not size or not isfinite(size) or _SMALL <= size < _LARGE:
        return unit, 1.0
    if size >= _LARGE:
        return f"k{unit}", 1e3
    if size < _TINY:
        return f"µ{unit}", 1e-6
    return "N·mm" if unit == "N·m" else f"m{unit}", 1e-3
