"""Axes of diagrams over a drive: their names, values as text, and which values are shown."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import number
from gruebler.pictures.canvas.axes import Axis, angles, as_text, axis_name, decimals, rate_unit

ROWS = 720
"""Poses of a turn, or of the range."""
_TINY = 1e-9  # of the largest value
_BULK = 0.9  # the middle part of all values
_STEEP = {False: 1.5, True: 20.0}  # widths of it beyond which values are cut off; True: full turns


def drive_axis(x: Reals, turning: bool, unit: str) -> Axis:
    """The axis of a drive over values in degrees, or in the unit."""
    scale, text = (angles, "φ in °") if turning else (decimals, axis_name("s₁", unit))
    return Axis(text, scale(float(x.min()), float(x.max()), tight=True))


def drive_text(x: float, turning: bool, unit: str, lang: str) -> str:
    """A value of a drive, in degrees or in the unit, as text.

    >>> drive_text(302.66, True, "mm", "de"), drive_text(40.311, False, "mm", "en")
    ('302,7°', '40.31 mm')
    """
    return number(round(x, 6) + 0.0, lang, ".4g") + "°" if turning else as_text(x, unit, lang)


def bulk(values: Reals, drives: Reals, full: bool) -> tuple[float, float]:
    """The range of values over a drive, cut off where some are far beyond the bulk of them, as near limits.

    >>> bulk(np.array([0.0, 2.0, 1.0]), np.array([0.0, 1.0, 2.0]), full=True)
    (0.0, 2.0)
    """
    finite = np.isfinite(values)
    if not finite.any():
        return 0.0, 1.0
    even = np.interp(np.linspace(drives[0], drives[-1], ROWS), drives[finite], values[finite])
    low, high = float(values[finite].min()), float(values[finite].max())
    first, last = (float(np.quantile(even, q)) for q in ((1 - _BULK) / 2, (1 + _BULK) / 2))
    most, noise = _STEEP[full] * (last - first), _TINY * max(abs(low), abs(high))
    if most > noise:
        low, high = max(low, first - most), min(high, last + most)
    return (low, high) if high - low > noise else ((low + high) / 2 - 0.5, (low + high) / 2 + 0.5)


def order_words(turning: bool, by_turning: bool, unit: str, order: int) -> str:
    """The name of a transfer function with its unit, of an output that turns or slides by a drive that does.

    >>> order_words(True, True, "mm", 0), order_words(False, True, "mm", 2)
    ('ψ in °', 's′′ = d²s/dφ² in mm/rad²')
    >>> order_words(False, True, "", 0), order_words(False, True, "", 1)
    ('s', 's′ = ds/dφ in 1/rad')
    """
    letter, over = "ψ" if turning else "s", "φ" if by_turning else "s₁"
    if order == 0:
        return axis_name(letter, "°" if turning else unit)
    mark = ("", "", "²")[order]
    units = {
        (True, True): "",
        (True, False): rate_unit("rad", unit and f"{unit}{mark}"),
        (False, True): rate_unit(unit, f"rad{mark}"),
        (False, False): rate_unit("", "" if order == 1 else unit),
    }
    of = units[turning, by_turning]
    return axis_name(f"{letter}{'′' * order} = d{mark}{letter}/d{over}{mark}", of)
