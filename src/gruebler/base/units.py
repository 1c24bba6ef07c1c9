"""Units of length and of mechanics: how long or how heavy each is, and quantities written with their unit."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from gruebler.base.errors import GrueblerError, nearest
from gruebler.base.text import translate

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0, "in": 25.4, "ft": 304.8}
"""How long each unit is, in millimetres; the only table of units of length."""


class DerivedUnit(NamedTuple):
    """A unit as a product of kilograms, metres and seconds."""

    factor: float
    kilograms: int = 0
    metres: int = 0
    seconds: int = 0

    def times(self, other: DerivedUnit, power: int = 1) -> DerivedUnit:
        """The product with a power of another one.

        >>> UNITS["N"].times(UNITS["m"], -1)
        DerivedUnit(factor=1.0, kilograms=1, metres=0, seconds=-2)
        """
        return DerivedUnit(
            self.factor * other.factor**power,
            *(own + power * more for own, more in zip(self[1:], other[1:], strict=True)),
        )


_POUND = 0.45359237
_GRAVITY = 9.80665
UNITS = {
    **{name: DerivedUnit(size / 1000, metres=1) for name, size in MILLIMETRES.items()},
    "kg": DerivedUnit(1.0, 1),
    "g": DerivedUnit(1e-3, 1),
    "t": DerivedUnit(1e3, 1),
    "lb": DerivedUnit(_POUND, 1),
    "s": DerivedUnit(1.0, 0, 0, 1),
    "ms": DerivedUnit(1e-3, 0, 0, 1),
    "min": DerivedUnit(60.0, 0, 0, 1),
    "N": DerivedUnit(1.0, 1, 1, -2),
    "daN": DerivedUnit(10.0, 1, 1, -2),
    "kN": DerivedUnit(1e3, 1, 1, -2),
    "lbf": DerivedUnit(_POUND * _GRAVITY, 1, 1, -2),
    "Pa": DerivedUnit(1.0, 1, -1, -2),
    "kPa": DerivedUnit(1e3, 1, -1, -2),
    "MPa": DerivedUnit(1e6, 1, -1, -2),
    "bar": DerivedUnit(1e5, 1, -1, -2),
    "rad": DerivedUnit(1.0),
    "deg": DerivedUnit(math.pi / 180),
    "°": DerivedUnit(math.pi / 180),
    "rpm": DerivedUnit(math.pi / 30, 0, 0, -1),
}
"""Units by their names; those of an angle are numbers."""

QUANTITIES = {
    "mass": ("kg", "250 g"),
    "inertia": ("kg {unit}2", "800 kg mm2"),
    "density": ("kg/{unit}3", "7.85 g/cm3"),
    "length": ("{unit}", "35 mm"),
    "force": ("N", "20 N"),
    "moment": ("N {unit}", "3 N m"),
    "stiffness": ("N/{unit}", "2 N/mm"),
    "damping": ("N s/{unit}", "0.1 N s/mm"),
    "torsional stiffness": ("N {unit}/rad", "5 N m/rad"),
    "torsional damping": ("N {unit} s", "0.2 N m s"),
    "speed": ("rad/s", "3000 rpm"),
    "angle": ("rad", "30 deg"),
    "velocity": ("{unit}/s", "0.2 m/s"),
    "acceleration": ("m/s2", "9.81 m/s2"),
}
"""In what each quantity is kept in a linkage whose unit of length is ``unit`` (forces in newtons), and an example."""
_FORM = re.compile(r"\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?)\s*(.*?)\s*")
_FACTOR = re.compile(r"([/*·]?)\s*(°|[A-Za-z]+)(?:\^?([0-9]|[²³]))?\s*")
_SMALL = {"²": 2, "³": 3, None: 1}


def metres_of(unit: str) -> float:
    """How many metres a unit of length is; `GrueblerError` for one that is not known.

    >>> metres_of("mm")
    0.001
    """
    if not unit:
        raise GrueblerError(
            "inertia needs the unit of the lengths: FourBar(25, 70, 40, 70).linkage(unit='mm'), in a file unit = \"mm\""
        )
    if unit not in MILLIMETRES:
        raise GrueblerError(
            "inertia needs to know how long the linkage's unit {unit!r} is; known are {units}",
            unit=unit,
            units=", ".join(MILLIMETRES),
        )
    return MILLIMETRES[unit] / 1000


def moment_unit(unit: str, lang: str = "en") -> str:
    """The unit of moments with forces in newtons and lengths in a unit, or in none.

    >>> moment_unit("mm"), moment_unit("", "de")
    ('N·mm', 'N·Länge')
    """
    return f"N·{unit or translate('length', lang)}"


def quantity_of(name: str, word: str, quantity: str, unit: str) -> float:
    """A quantity written with its unit, in kilograms, newtons, seconds, radians and a unit of length.

    Args:
        name: With which the sentence of an error begins.
        word: Such as ``"2 N/mm"``.
        quantity: A key of `QUANTITIES`.
        unit: The linkage's unit of length.

    Raises `GrueblerError` for a missing unit, or one of another quantity.

    >>> quantity_of("mass", "250 g", "mass", "mm"), quantity_of("c", "2 kN/m", "stiffness", "mm")
    (0.25, 2.0)
    """
    kept_in, example = QUANTITIES[quantity]
    form = _FORM.fullmatch(word)
    if form is None or not form[2]:
        raise GrueblerError(
            "{name}: expected a number with its unit such as {example!r}, but found {found!r}",
            name=name,
            example=example,
            found=word,
        )
    written = _unit_of(name, form[2], word)
    if written[1:] != _unit_of(name, kept_in.format(unit="m"), word)[1:]:
        raise GrueblerError(
            "{name}: {found!r} has the unit of another quantity; expected one such as {example!r}",
            name=name,
            example=example,
            found=word,
        )
    scale = written.factor / _unit_of(name, _kept_in(quantity, unit), word).factor
    number = float(form[1])
    return number if scale == 1.0 else float(f"{number * scale:.15g}")  # what `quantity_text` writes comes back exactly


def quantity_text(value: float, quantity: str, unit: str) -> str:
    """A quantity as a text with its unit, from which `quantity_of` reads the same number.

    >>> quantity_text(2.0, "stiffness", "mm"), quantity_text(0.25, "mass", "mm"), quantity_text(600.0, "inertia", "mm")
    ('2.0 N/mm', '0.25 kg', '600.0 kg mm2')
    """
    return f"{float(value)!r} {_kept_in(quantity, unit)}"


def _kept_in(quantity: str, unit: str) -> str:
    """The unit of a quantity in a linkage with this unit of length, which is known."""
    kept_in, _ = QUANTITIES[quantity]
    if "{unit}" in kept_in:
        metres_of(unit)
    return kept_in.format(unit=unit)


def _unit_of(name: str, text: str, word: str) -> DerivedUnit:
    """A product of units with their powers; what follows a stroke divides."""
    total, at = DerivedUnit(1.0), 0
    while at < len(text):
        factor = _FACTOR.match(text, at)
        if factor is None or factor[2] not in UNITS:
            raise GrueblerError(
                "{name}: there is no unit {unit!r}{suggestion} in {found!r}",
                name=name,
                unit=text[at:] if factor is None else factor[2],
                suggestion="" if factor is None else nearest(factor[2], UNITS),
                found=word,
            )
        power = int(_SMALL.get(factor[3], factor[3]))
        total, at = total.times(UNITS[factor[2]], -power if factor[1] == "/" else power), factor.end()
    return total
