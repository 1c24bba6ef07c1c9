"""Geneva drives: a driver with pins, a wheel with slots, outside or inside; docs/theory/geneva.md.

Angles in radians. The driver's angle is 0 when a pin is on the line of centres, in the middle of a step. Rates are
derivatives by the driver's angle: with a driver that turns at omega the wheel has omega times the first and omega
squared times the second.
"""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.angles import warn_of_degrees
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import GrueblerError
from gruebler.base.notebook import Drawn, explained
from gruebler.base.text import message, plural

_MOST = 2_000


class GenevaError(GrueblerError):
    """An impossible Geneva drive."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class GenevaMotion:
    """The wheel's angle and its first three derivatives by the driver's angle, and whether the wheel rests."""

    angle: Reals
    ratio: Reals
    acceleration: Reals
    jerk: Reals
    dwell: NDArray[np.bool_]


class GenevaSizes(NamedTuple):
    """Lengths that follow from the distance of the centres (before clearances and the size of the pin)."""

    crank: float
    """From the driver's axis to the middle of a pin."""
    wheel: float
    """From the wheel's axis to the mouth of a slot."""
    slot_end: float
    """From the wheel's axis to the pin where it is deepest (external), or farthest out (internal)."""
    locking_arc: float
    """The angle of the locking disc between two pins, in radians."""


def _whole(number: object, least: int) -> bool:
    """Whether a number is whole and in its range."""
    return isinstance(number, int) and not isinstance(number, bool) and least <= number <= _MOST


_STEPS = message(
    "A step turns the wheel by {step:n}° while the driver turns by {engaged:n}°; of a turn of the driver it rests for "
    "{rest:n} %."
)
_FASTEST = message("The wheel turns at most {ratio:n} times as fast as the driver.")


@explained
@dataclass(frozen=True, slots=True)
class Geneva(Drawn):
    """A Geneva drive whose pins enter and leave the slots without a jump of speed.

    >>> cross = Geneva(4)
    >>> round(cross.greatest_ratio, 6), round(cross.greatest_acceleration, 6)
    (2.414214, 5.406981)
    >>> cross.motion_fraction, cross.dwell_fraction
    (0.25, 0.75)

    See Also:
        `Cam`, `Train`, `draw`, `animate`

    Theory:
        docs/theory/geneva.md
    """

    slots: int
    _: KW_ONLY
    internal: bool = False
    pins: int = 1

    def __post_init__(self) -> None:
        if not _whole(self.slots, 3):
            raise GenevaError(
                "a Geneva drive has a whole number of slots from 3 to {most:,}, not {slots!r}",
                most=_MOST,
                slots=self.slots,
            )
        if not isinstance(self.internal, bool):
            raise GenevaError("internal is True or False, not {internal!r}", internal=self.internal)
        if not _whole(self.pins, 1):
            raise GenevaError(
                "a Geneva drive has a whole number of pins from 1 to {most:,}, not {pins!r}", most=_MOST, pins=self.pins
            )
        if self.pins > self.most_pins:
            raise GenevaError(
                "an internal Geneva drive with {slots} slots takes at most {most_pins} pins, not {pins}: the next "
                "pin would enter before the last has left"
                if self.internal
                else "an external Geneva drive with {slots} slots takes at most {most_pins} pins, not {pins}: the next "
                "pin would enter before the last has left",
                slots=self.slots,
                most_pins=self.most_pins,
                pins=self.pins,
            )

    def explain(self, lang: str = "en") -> str:
        """What it is and how it steps and rests, in English or German (``de``).

        >>> print(Geneva(4))
        External Geneva drive: 4 slots, 1 pin.
        A step turns the wheel by 90° while the driver turns by 90°; of a turn of the driver it rests for 75 %.
        The wheel turns at most 2.414 times as fast as the driver.
        """
        kind = message("Internal Geneva drive") if self.internal else message("External Geneva drive")
        parts = (
            plural("{count} slot", "{count} slots", self.slots, lang),
            plural("{count} pin", "{count} pins", self.pins, lang),
        )
        step, engaged, rest = math.degrees(self.step), 2 * math.degrees(self.engaged), 100 * self.dwell_fraction
        return "\n".join(
            (
                f"{kind.in_language(lang)}: {', '.join(parts)}.",
                _STEPS.filled(step=step, engaged=engaged, rest=rest).in_language(lang),
                _FASTEST.filled(ratio=self.greatest_ratio).in_language(lang),
            )
        )

    @property
    def crank_ratio(self) -> float:
        """Crank length by distance of the centres, sin(pi/n): the pin enters along the slot."""
        return math.sin(math.pi / self.slots)

    @property
    def most_pins(self) -> int:
        """The largest number of equally spaced pins: a whole number not above 2n/(n - 2), or 1 inside."""
        return 1 if self.internal else 2 * self.slots // (self.slots - 2)

    @property
    def engaged(self) -> float:
        """Half the driver's angle during which a pin moves the wheel, in radians."""
        return math.pi / 2 + self._side * math.pi / self.slots

    @property
    def step(self) -> float:
        """The wheel's angle of one step, in radians."""
        return 2 * math.pi / self.slots

    @property
    def motion_fraction(self) -> float:
        """The part of a driver's turn in which the wheel moves: k (n - 2) / 2n outside, (n + 2) / 2n inside."""
        return self.pins * (self.slots + 2 * self._side) / (2 * self.slots)

    @property
    def dwell_fraction(self) -> float:
        """The part of a driver's turn in which the wheel rests."""
        return (2 * self.slots - self.pins * (self.slots + 2 * self._side)) / (2 * self.slots)

    @property
    def motion_ratio(self) -> float:
        """The time in which the wheel moves by the time in which it rests, at constant speed; infinite without a dwell.

        >>> Geneva(4).motion_ratio, Geneva(4, internal=True).motion_ratio
        (0.3333333333333333, 3.0)
        """
        return self.motion_fraction / self.dwell_fraction if self.dwell_fraction else math.inf

    @property
    def greatest_ratio(self) -> float:
        """The greatest angular speed of the wheel by that of the driver, on the line of centres."""
        return self.crank_ratio / (1 + self._side * self.crank_ratio)

    @property
    def entry_acceleration(self) -> float:
        """The jump of acceleration when a pin enters or leaves, by omega squared: tan(pi/n). The jerk is infinite."""
        return math.tan(math.pi / self.slots)

    @property
    def greatest_acceleration_at(self) -> float:
        """The driver's angle of the greatest acceleration (in magnitude; it comes at plus and minus this angle)."""
        # Zero of the third derivative: -side 2 lam c^2 + (1 + lam^2) c + side 4 lam = 0 for c = cos(phi). Inside, the
        # zero lies beyond the engagement for every n, and the ends have it.
        if self.internal:
            return self.engaged
        lam = self.crank_ratio
        return math.acos((math.hypot(1 + lam**2, math.sqrt(32) * lam) - (1 + lam**2)) / (4 * lam))

    @property
    def greatest_acceleration(self) -> float:
        """The greatest magnitude of the wheel's angular acceleration by the square of the driver's speed."""
        lam, at = self.crank_ratio, self.greatest_acceleration_at
        return lam * (1 - lam**2) * math.sin(at) / (1 + 2 * self._side * lam * math.cos(at) + lam**2) ** 2

    def sizes(self, distance: float) -> GenevaSizes:
        """The lengths for a distance of the centres, in its unit.

        >>> [round(size, 3) for size in Geneva(4).sizes(100)]
        [70.711, 70.711, 29.289, 4.712]
        """
        if not isinstance(distance, int | float) or not 0 < distance < math.inf:
            raise GenevaError("the distance of the centres is a positive length, not {distance!r}", distance=distance)
        lam = self.crank_ratio
        return GenevaSizes(
            crank=distance * lam,
            wheel=distance * math.cos(math.pi / self.slots),
            slot_end=distance * (1 + self._side * lam),
            locking_arc=2 * math.pi / self.pins - 2 * self.engaged,
        )

    def move(self, driver: ArrayLike) -> GenevaMotion:
        """The wheel at driver's angles of any shape (radians, any number of turns), dwells included.

        External wheels turn against the driver, internal ones with it. At the very entry and exit the rates are those
        of the moving side.

        >>> motion = Geneva(4).move([0.0, 1.0, 2 * math.pi])
        >>> motion.angle.round(6).tolist(), motion.dwell.tolist()
        ([-0.0, -0.785398, -1.570796], [False, True, False])
        """
        try:
            phi = np.asarray(driver, dtype=np.float64)
        except (TypeError, ValueError):
            phi = np.array(np.nan)
        if not np.isfinite(phi).all():
            raise GenevaError("the driver's angles are finite numbers")
        warn_of_degrees("driver", phi)
        lam, side, pitch = self.crank_ratio, self._side, 2 * math.pi / self.pins
        index = np.floor(phi / pitch + 0.5)
        local = phi - index * pitch
        dwell = np.abs(local) > self.engaged * (1 + 1e-15)
        at = np.clip(local, -self.engaged, self.engaged)
        sine, cosine = np.sin(at), np.cos(at)
        square = 1 + 2 * side * lam * cosine + lam**2
        moved = np.arctan2(lam * sine, 1 + side * lam * cosine)
        rate = lam * (cosine + side * lam) / square
        second = -lam * (1 - lam**2) * sine / square**2
        third = -lam * (1 - lam**2) * (cosine * square + 4 * side * lam * sine**2) / square**3
        ratio, acceleration, jerk = (np.where(dwell, 0.0, side * rates) for rates in (rate, second, third))
        return GenevaMotion(
            angle=side * (index * self.step + moved), ratio=ratio, acceleration=acceleration, jerk=jerk, dwell=dwell
        )

    @property
    def _side(self) -> int:
        return 1 if self.internal else -1
