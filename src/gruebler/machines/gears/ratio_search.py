"""Tooth numbers of planetary trains for a wanted ratio; docs/theory/gears.md."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.machines.gears.train import GearError

_Ints = NDArray[np.int64]
_MOST_TEETH = 250  # of a wheel: products of four numbers stay exact, all choices take seconds
_ROLES = ("a", "b", "carrier")


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanetaryDesign:
    """Two coaxial central wheels a and b, planets between them on a carrier; one shaft drives, one is held."""

    teeth: tuple[int, int, int, int]
    """Of a, of the planet's wheels that mesh with a and with b, of b; those of rings are negative."""
    driving: str
    """``a``, ``b`` or ``carrier``; likewise the other two."""
    driven: str
    held: str
    ratio: Fraction
    """The speed of the driving shaft by that of the driven one."""
    planets: int

    @property
    def text(self) -> str:
        """The train as `read_train` takes it, with the driving shaft at speed 1."""
        a, p, q, b = self.teeth
        names = dict(zip(_ROLES, (*self._central, "arm"), strict=True))
        planets = f" planets={self.planets}" if self.planets > 1 else ""
        if p == q:
            row = f"{names['a']}:{a} planet:{p} {names['b']}:{b} on arm{planets}"
        else:
            row = f"{names['a']}:{a} planet:{p} on arm{planets}; planet:{q} {names['b']}:{b} on arm"
        return f"{row}; hold {names[self.held]}; drive {names[self.driving]}=1"

    @property
    def _central(self) -> tuple[str, str]:
        kinds = ["sun" if teeth > 0 else "ring" for teeth in (self.teeth[0], self.teeth[3])]
        return (kinds[0], kinds[1]) if kinds[0] != kinds[1] else (kinds[0] + "1", kinds[1] + "2")

    @property
    def size(self) -> int:
        """The largest pitch diameter in modules: of a ring, or of the circle around all planets."""
        a, p, q, b = self.teeth
        return max(-a, -b, a + p + max(p, q) if min(a, b) > 0 else 0)


class _Choices(NamedTuple):
    """Tooth numbers of many trains."""

    a: _Ints
    p: _Ints
    q: _Ints
    b: _Ints

    def where(self, keep: NDArray[np.bool_]) -> _Choices:
        return _Choices(*(row[keep] for row in self))


def search_ratio(
    ratio: Fraction | float,
    teeth: tuple[int, int],
    *,
    planets: int = 3,
    number: int = 10,
    stepped: bool = True,
) -> list[PlanetaryDesign]:
    """The planetary trains whose ratio comes nearest, small and simple ones first among equals.

    All wheels have one module and no profile shift, so that central wheels are coaxial for suitable tooth numbers only;
    the planets can be put in at equal angles and do not touch. Central wheels are sun and ring, two suns or two
    rings; any of the three shafts may be held.

    Args:
        ratio: speed of the driving shaft by that of the driven one; negative if they turn against each other.
        teeth: the least and the largest number of teeth of all wheels.
        planets: how many planets there are.
        number: how many trains are returned at most.
        stepped: also planets with two wheels.

    Raises `GearError` for an impossible range. Cost: 0.5 s for 17 to 90 teeth.

    >>> best = search_ratio(Fraction(7, 2), (16, 60), number=1)[0]
    >>> best.text, str(best.ratio)
    ('sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1', '7/2')
    """
    wanted = Fraction(ratio).limit_denominator(10**9)
    low, high = teeth
    if not (isinstance(low, int) and isinstance(high, int) and 5 <= low <= high <= _MOST_TEETH):
        raise GearError(
            "teeth {low}-{high}: expected two numbers from 5 to {most}, the smaller one first",
            low=low,
            high=high,
            most=_MOST_TEETH,
        )
    if planets < 1:
        raise GearError("planets: expected a whole number, at least 1, not {number!r}", number=planets)
    if number < 1:
        raise GearError("number of trains: expected a whole number, at least 1, not {number!r}", number=number)
    if wanted == 0:
        raise GearError("a ratio of 0 would mean a driving shaft at rest")
    best: list[PlanetaryDesign] = []
    for choices in _choices(low, high, stepped):
        good = choices.where(_can_be_assembled(choices, planets))
        for held, driving, driven in permutations(_ROLES):
            above, below = _ratio(good, driving, driven, held)
            keep = (above != 0) & (below != 0)
            usable, above, below = good.where(keep), above[keep], below[keep]
            error = np.abs(above / below - float(wanted))
            exact = above * wanted.denominator == below * wanted.numerator
            error[exact] = 0.0
            width = np.maximum(np.abs(usable.a), np.abs(usable.b)) + usable.p + usable.q
            for k in np.lexsort((usable.p != usable.q, width, error))[:number]:
                numbers = int(usable.a[k]), int(usable.p[k]), int(usable.q[k]), int(usable.b[k])
                value = Fraction(int(above[k]), int(below[k]))
                best.append(
                    PlanetaryDesign(
                        teeth=numbers, driving=driving, driven=driven, held=held, ratio=value, planets=planets
                    )
                )
    best.sort(
        key=lambda design: (abs(design.ratio - wanted), design.size, design.teeth[1] != design.teeth[2], design.teeth)
    )
    return best[:number]


def _choices(low: int, high: int, stepped: bool) -> Iterator[_Choices]:
    """All coaxial tooth numbers: |a + p| = |q + b|, rings larger than what runs in them."""
    span = np.arange(low, high + 1)
    a, p = (grid.ravel() for grid in np.meshgrid(span, span, indexing="ij"))
    ring = a + 2 * p
    yield _Choices(a, p, p, -ring).where(ring <= high)
    if not stepped:
        return
    for q in span:
        for sign_a, sign_b in ((1, -1), (1, 1), (-1, -1)):
            distance = a + p if sign_a > 0 else a - p
            b = distance - q if sign_b > 0 else distance + q
            keep = ((p != q) if sign_a != sign_b else (p > q)) & (b >= low) & (b <= high) & (distance > 0)
            yield _Choices(sign_a * a, p, np.full_like(p, q), sign_b * b).where(keep)


def _can_be_assembled(choices: _Choices, planets: int) -> NDArray[np.bool_]:
    """Equal spacing and neighbours apart; the conditions of `assembly`."""
    a, p, q, b = choices
    turned = np.abs(a * q - b * p)
    even = turned % (planets * np.gcd(p, q)) == 0
    if planets == 1:
        return np.asarray(even)
    return np.asarray(even & (np.abs(a + p) * np.sin(np.pi / planets) > np.maximum(p, q) + 2))


def _ratio(choices: _Choices, driving: str, driven: str, held: str) -> tuple[_Ints, _Ints]:
    """Numerator and denominator of the ratio, by Willis: w_a - w_c = i (w_b - w_c) with i = p b / (a q)."""
    a, p, q, b = choices
    above, below = p * b, a * q
    # With one shaft at rest the speeds of a, b and the carrier are proportional to these.
    speeds = {
        "carrier": {"a": above, "b": below},
        "b": {"a": below - above, "carrier": below},
        "a": {"b": above - below, "carrier": above},
    }[held]
    return speeds[driving], speeds[driven]
