"""Lengths as a user writes them, with or without a unit: 15cm, 0.75 mm, 3."""

from __future__ import annotations

import math
import re

from gruebler.base.errors import GrueblerError
from gruebler.base.units import MILLIMETRES

_FORM = re.compile(r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]{1,3})?)\s*([a-zA-Z]*)\s*")


def length_of(name: str, word: str) -> tuple[float, str]:
    """Number and unit; no unit is an empty one. Errors begin with the name.

    >>> length_of("length", "15cm"), length_of("length", "2")
    ((15.0, 'cm'), (2.0, ''))
    """
    form = _FORM.fullmatch(word)
    try:
        value = float(form[1]) if form else math.nan
    except ValueError:
        value = math.nan
    if form is None or not 0 < value < 1e70 or form[2] not in ("", *MILLIMETRES):
        raise GrueblerError(
            "{name}: expected a positive length such as 15cm (units: {units}), but found {found!r}",
            name=name,
            units=", ".join(MILLIMETRES),
            found=word,
        )
    return value, form[2]


def same_unit(value: float, unit: str, wanted: str) -> float:
    """A length in another unit; a missing unit is that of the other one.

    >>> same_unit(0.75, "mm", "cm")
    0.075
    """
    if unit == wanted or not unit:
        return value
    if not wanted:
        raise GrueblerError("one length is in {unit}, the other has no unit: give both, or none", unit=unit)
    return float(f"{in_unit(value, unit, wanted):.15g}")


def in_unit(value: float, unit: str, wanted: str) -> float:
    """A length in another one of the units of `MILLIMETRES`.

    >>> in_unit(3.5, "cm", "mm"), in_unit(2.0, "in", "mm")
    (35.0, 50.8)
    """
    return value if unit == wanted else value * MILLIMETRES[unit] / MILLIMETRES[wanted]
