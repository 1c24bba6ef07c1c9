"""Scales of a plot: the position of a value, and ticks at round numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from gruebler.base.text import decimal_sign_in, raised

_FEW = 7  # approximate number of ticks of an axis
_ANGLES = (1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720)  # degrees
_TINY = 1e-9  # steps: the tolerance for a value beyond a tick
_PLAIN = (-4, 5)  # powers of ten between which an axis shows plain numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """From a lowest to a highest value, with ticks between."""

    low: float
    high: float
    ticks: tuple[float, ...]
    logarithmic: bool = False
    names: tuple[str, ...] = ()
    """The labels of the ticks; empty for ticks without one."""

    def part(self, value: float) -> float:
        """The relative position of a value: 0 at the lowest, 1 at the highest."""
        if self.logarithmic:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


@dataclass(frozen=True, slots=True)
class Axis:
    """A scale and the name of its quantity, unit included."""

    text: str
    scale: Scale


def decimals(low: float, high: float, *, few: int = _FEW, tight: bool = False) -> Scale:
    """Round steps of 1, 2, 5 times a power of ten; the ends are round as well unless the scale is tight.

    >>> decimals(-0.13, 1.92).ticks
    (-0.5, 0.0, 0.5, 1.0, 1.5, 2.0)
    """
    low, high = _apart(low, high)
    power = 10.0 ** math.floor(math.log10((high - low) / few))
    step = next(k * power for k in (1, 2, 5, 10) if k * power * few >= (high - low) * (1 - 1e-9))
    return _stepped(low, high, step, tight)


def angles(low: float, high: float, *, few: int = 9, tight: bool = False) -> Scale:
    """Steps that divide a right angle, a full turn or turns; in degrees.

    >>> angles(0, 360).ticks
    (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0)
    """
    low, high = _apart(low, high)
    if high - low < few:
        return decimals(low, high, few=few, tight=tight)
    step = next((float(k) for k in _ANGLES if k * few >= (high - low) * (1 - 1e-9)), 0.0)
    return _stepped(low, high, step, tight) if step else decimals(low, high, few=few, tight=tight)


def decades(low: float, high: float) -> Scale:
    """Powers of ten, with unnamed ticks at 2 to 9 times each; for positive values.

    >>> scale = decades(0.002, 0.3)
    >>> (scale.low, scale.high), [name for name in scale.names if name]
    ((0.001, 1.0), ['0.001', '0.01', '0.1', '1'])
    >>> [name for name in decades(2e-5, 0.03).names if name]  # all of an axis alike
    ['10⁻⁵', '10⁻⁴', '10⁻³', '10⁻²', '10⁻¹']
    """
    first, last = math.floor(math.log10(low) + 1e-9), math.ceil(math.log10(high) - 1e-9)
    last = max(last, first + 1)
    ticks = [(float(f"{k}e{n}"), k) for n in range(first, last + 1) for k in range(1, 10 if n < last else 2)]
    plain = first > _PLAIN[0] and last < _PLAIN[1]
    return Scale(
        low=ticks[0][0],
        high=ticks[-1][0],
        ticks=tuple(value for value, _ in ticks),
        logarithmic=True,
        names=tuple(_power(value, plain) if k == 1 else "" for value, k in ticks),
    )


def tick_labels(values: Sequence[float], step: float) -> tuple[str, ...]:
    """Numbers with the decimals of the step between them; with a power of ten if they are huge or tiny.

    >>> tick_labels((-0.5, 0.0, 0.5), 0.5), tick_labels((0.0, 2e7), 1e7)
    (('−0.5', '0.0', '0.5'), ('0', '2×10⁷'))
    """
    largest = max(map(abs, values), default=0.0)
    if largest >= 1e6 or step < 1e-4:
        return tuple(_with_power(value) for value in values)
    places = max(0, -math.floor(math.log10(step) + 1e-9))
    return tuple(f"{value + 0.0:.{places}f}".replace("-", "−") for value in values)


def axis_name(symbol: str, unit: str) -> str:
    """The name of an axis, with its unit if there is one.

    >>> axis_name("s", "mm"), axis_name("s", "")
    ('s in mm', 's')
    """
    return f"{symbol} in {unit}" if unit else symbol


def rate_unit(unit: str, per: str) -> str:
    """The unit of a rate; either may be missing.

    >>> rate_unit("mm", "rad"), rate_unit("", "rad"), rate_unit("rad", ""), rate_unit("", "")
    ('mm/rad', '1/rad', 'rad', '')
    """
    return f"{unit or '1'}/{per}" if per else unit


def as_text(value: float, unit: str, lang: str = "en") -> str:
    """A size with four digits and its unit; with a power of ten where it is huge or tiny.

    >>> as_text(70.0, "mm"), as_text(40.311, "mm", "de"), as_text(3e7, "mm"), as_text(1e-6, "mm")
    ('70 mm', '40,31 mm', '3×10⁷ mm', '10⁻⁶ mm')
    >>> as_text(3e7, "mm", "de"), as_text(20.0, "1/rad")
    ('3·10⁷ mm', '20/rad')
    """
    plain = not value or 1e-3 <= abs(float(f"{value:.4g}")) < 1e5
    number = f"{float(f'{value:.4g}'):.10g}".replace("-", "−") if plain else _with_power(value).removeprefix("1×")
    return decimal_sign_in(f"{number}{unit[1:]}" if unit.startswith("1/") else f"{number} {unit}".rstrip(), lang)


def _with_power(value: float) -> str:
    if not value:
        return "0"
    digits, power = f"{value:.3e}".split("e")
    return f"{float(digits):g}×10{raised(int(power))}".replace("-", "−")


def _power(value: float, plain: bool) -> str:
    return f"{value:g}" if plain else f"10{raised(round(math.log10(value)))}"


def _apart(low: float, high: float) -> tuple[float, float]:
    """The two values, moved apart if they are equal."""
    least = max(abs(low), abs(high)) * 1e-9
    if high - low > least:
        return low, high
    half = max(abs(low) / 10, 0.5 if not low else 0.0)
    return low - half, high + half


def _stepped(low: float, high: float, step: float, tight: bool) -> Scale:
    inner = math.ceil(low / step - _TINY), math.floor(high / step + _TINY)
    first, last = inner if tight else (math.floor(low / step + _TINY), math.ceil(high / step - _TINY))
    ticks = tuple(float(f"{k * step:.12g}") for k in range(first, last + 1))
    low, high = (low, high) if tight else (ticks[0], ticks[-1])
    return Scale(low=low, high=high, ticks=ticks, logarithmic=False, names=tick_labels(ticks, step))
