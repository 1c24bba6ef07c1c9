"""Non-circular wheels in pairs: transfer function, ratio, the curves that roll; docs/theory/wheels.md."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import degrees, pi, sqrt, tau

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError, naming
from gruebler.machines.cams import Lift, read_lift
from gruebler.mechanics.linkages import NonCircular

_RATIOS = (1e-3, 1e3)  # beyond them a radius is less than a thousandth of the centre distance
_FLATTEST = 0.8  # eccentricity: the ratio goes from 1/9 to 9; beyond, pieces of 0.04 rad are not exact
_CLOSED = 1e-9  # radians, as the parts of a lift fill a turn
_STEPS, _MOST = 360, 3600  # points of a lobe, and of a curve, at most
_LOBES = 100  # equal parts of a curve: each has 36 points or more


@dataclass(frozen=True, slots=True)
class WheelTransfer:
    """The turn of the second wheel by that of the first, in opposite senses, both from the line of centres.

    >>> pair = WheelTransfer(Fraction(1), kappa=0.5)
    >>> pair.ratio([0.0, pi]).round(12).tolist()
    [3.0, 0.333333333333]
    """

    mean: Fraction
    """Turns of the second wheel in one of the first."""
    kappa: float = 0.0
    """Of the ellipse: the ratio is mean (1 - kappa^2) / (1 - 2 kappa cos a + kappa^2)."""
    lift: Lift | None = None
    """What comes to the mean, in radians; None for an ellipse."""

    def at(self, angle: ArrayLike) -> Reals:
        """The second wheel's turn at turns of the first, of any shape; radians."""
        a = np.asarray(angle, dtype=np.float64)
        if self.lift is not None:
            return float(self.mean) * a + self.lift.at(a)
        k = self.kappa
        return np.asarray(float(self.mean) * (a + 2 * np.arctan2(k * np.sin(a), 1 - k * np.cos(a))))

    def ratio(self, angle: ArrayLike) -> Reals:
        """The derivative of `at`: the second speed by the first."""
        a = np.asarray(angle, dtype=np.float64)
        if self.lift is not None:
            return float(self.mean) + self.lift.at(a, 1)
        k = self.kappa
        return np.asarray(float(self.mean) * (1 - k * k) / (1 - 2 * k * np.cos(a) + k * k))

    @property
    def breaks(self) -> tuple[float, ...]:
        """Angles of the first wheel in [0, 2 pi) at which derivatives may jump."""
        return () if self.lift is None else tuple(span.start for span in self.lift.spans())

    def curves(self) -> tuple[Complexes, Complexes]:
        """The closed curves of both wheels, centre distance 1, each in a frame whose x axis is the wheel's direction.

        They touch where the first wheel has turned by a and the second by ``at(a)``: in the point of the first at the
        angle -a, and in that of the second at the angle ``at(a)``; points at equal steps of a, the same for both.
        """
        lobes = self.mean.numerator, self.mean.denominator
        fine = min(_STEPS, _MOST // max(lobes))
        first, second = (tau / (fine * lobes[0]) * np.arange(fine * count) for count in lobes)
        ratio, other = self.ratio(first), self.ratio(second)
        return np.exp(-1j * first) * ratio / (1 + ratio), np.exp(1j * self.at(second)) / (1 + other)


@lru_cache(maxsize=64)
def transfer_of(wheel: NonCircular, other: NonCircular) -> WheelTransfer:
    """The transfer function of a wheel and the one that is its inverse; `LinkageError` for one that cannot be."""
    mean = Fraction(wheel.teeth, other.teeth) if wheel.teeth else Fraction(1)
    with naming("transfer", LinkageError):
        transfer = _read(wheel.transfer, mean)
    if max(mean.numerator, mean.denominator) > _LOBES:
        raise LinkageError(
            "transfer: the mean ratio is one of numbers up to {lobes}, not {mean}", lobes=_LOBES, mean=mean
        )
    _check_ratio(transfer)
    _check_closed(transfer)
    return transfer


def _read(text: str, mean: Fraction) -> WheelTransfer:
    word, *rest = text.split()
    if word != "ellipse":
        return WheelTransfer(mean, lift=read_lift(text).scaled(pi / 180))
    try:
        (e,) = (float(value) for value in rest)
    except ValueError:
        e = float("nan")
    if not 0 <= e <= _FLATTEST:
        raise LinkageError(
            "expected 'ellipse' and an eccentricity from 0 to {flattest}, but found {law!r}",
            flattest=_FLATTEST,
            law=text[:40],
        )
    m = float(mean)
    parameter = (1 - e * e) * m / (m + sqrt(1 - e * e + m * m * e * e))  # docs/theory/wheels.md
    reach = 1 - parameter
    return WheelTransfer(mean, e / (reach + sqrt((reach - e) * (reach + e))))


def _check_ratio(transfer: WheelTransfer) -> None:
    if transfer.lift is None:
        extremes = [(float(a), float(transfer.ratio(a))) for a in (0.0, pi)]
    else:
        if jump := next((jump for jump in transfer.lift.jumps() if jump.order == 1), None):
            raise LinkageError(
                "transfer: the ratio jumps by {size:.4g} at {at:.6g}°: no closed curve; take a law that starts "
                "and ends at rest, such as 3-4-5",
                size=jump.size,
                at=degrees(jump.at),
            )
        extremes = [(a, float(transfer.mean) + slope) for a, slope in transfer.lift.extremes(1)]
    for at, ratio in (min(extremes, key=lambda place: place[1]), max(extremes, key=lambda place: place[1])):
        if not _RATIOS[0] <= ratio <= _RATIOS[1]:
            raise LinkageError(
                "transfer: the ratio is {ratio:.4g} at {at:.6g}°; it must be positive everywhere, from "
                "{least:g} to {greatest:g}",
                ratio=ratio,
                at=degrees(at),
                least=_RATIOS[0],
                greatest=_RATIOS[1],
            )


def _check_closed(transfer: WheelTransfer) -> None:
    """The second curve is closed after one turn if the ratio repeats as often as the numerator of the mean says."""
    times = transfer.mean.numerator
    ends = np.array([*transfer.breaks, tau])
    places = np.concatenate([np.linspace(0, tau, 721), ends, (ends[1:] + ends[:-1]) / 2])
    off = transfer.at(places + tau / times) - transfer.at(places) - tau / transfer.mean.denominator
    if np.abs(off).max() > _CLOSED:
        raise LinkageError(
            "transfer: the second wheel's curve does not close: with a mean ratio of {mean} the ratio must "
            "repeat every {times:.6g}° of the first wheel",
            mean=transfer.mean,
            times=360 / times,
        )
