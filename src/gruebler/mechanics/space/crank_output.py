"""A crank and an output that one condition P(phi) cos psi + Q(phi) sin psi = K(phi) joins, solved to the jerk."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.text import Message
from gruebler.mechanics.fourbar.crank_motion import CrankAndOutput, CrankRates, crank_rates, determined_rates
from gruebler.mechanics.fourbar.extremes import TURN, CrankRange, cannot_assemble
from gruebler.mechanics.space.power_series import cosine_and_sine, product

_ROUNDINGS = 64 * float(np.finfo(float).eps)
_ON_CIRCLE = 1e-5  # a double root of rounded coefficients lies some 1e-8 beside the circle
_FACTORIALS = np.array([1.0, 1.0, 2.0, 6.0])

Condition = Callable[[Reals, Reals], tuple[Reals, Reals, Reals]]
"""P, Q and K as power series, from those of the cosine and the sine of the crank's angle."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class OutputMotion(CrankAndOutput):
    """How the output of a linkage in space follows its crank: angles in radians, rates per unit of time.

    A pose that cannot be assembled is NaN, and so are rates that the crank does not determine; ``message`` says so.
    """

    crank: CrankRates
    """The crank's angle phi."""
    output: CrankRates
    """The output's angle psi, in -pi..pi; of shafts with whole turns; of a slider its way."""
    transmission_angle: Reals
    """At most pi/2."""
    side: int = 1
    """1 on the branch ``+``, -1 on ``-``."""
    reason: Message | None = None
    """Why some pose is not assembled or some rate not determined; None if all are."""


def series_of(rates: CrankRates) -> Reals:
    """The power series in time of a quantity, (4, ...)."""
    return np.asarray(np.array(rates) / _FACTORIALS.reshape(4, *[1] * np.ndim(rates.value)))


def rates_of(series: Reals) -> CrankRates:
    """The value and three derivatives of a series; NaN where they are not finite."""
    return determined_rates(list(series * _FACTORIALS.reshape(4, *[1] * (series.ndim - 1))))


def output_motion(
    condition: Condition,
    transmission: Callable[[Reals, Reals], Reals],
    arcs: Sequence[CrankRange],
    side: int,
    crank: Sequence[npt.ArrayLike],
    size: float,
) -> OutputMotion:
    """The motion that a condition gives; ``transmission`` takes the root √(P² + Q² - K²) and cos phi.

    ``size`` is that of the terms in P, Q, K, whose rounding decides what counts as closed.

    The branch ``+`` has psi = χ - β, ``-`` χ + β, with χ = atan2(Q, P) and β = atan2(root, K).
    """
    given = crank_rates(crank[0], crank[1], crank[2], crank[3])
    cosine, sine = cosine_and_sine(series_of(given))
    p, q, k = condition(cosine, sine)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        reach = np.hypot(p[0], q[0])
        inside = (reach - k[0]) * (reach + k[0])
        root = np.sqrt(np.where(abs(inside) < _ROUNDINGS * size * np.maximum(reach, abs(k[0])), 0.0, inside))
        undetermined = (reach < _ROUNDINGS * size) & ~np.isnan(root)
        start = np.arctan2(q[0], p[0]) - side * np.arctan2(root, k[0])
        psi = np.zeros(p.shape)
        psi[0] = np.where(undetermined, np.nan, np.arctan2(np.sin(start), np.cos(start)))
        for order in (1, 2, 3):
            c, s = cosine_and_sine(psi[: order + 1])
            rest = product(p, c, np.multiply)[order] + product(q, s, np.multiply)[order] - k[order]
            psi[order] = -side * rest / root
        angle = np.where(undetermined, np.nan, transmission(root, cosine[0]))
        output = rates_of(psi)
    singular = np.isnan(output.velocity) & ~np.isnan(output.value)
    return OutputMotion(
        crank=given,
        output=output,
        transmission_angle=np.asarray(angle),
        side=side,
        reason=cannot_assemble(arcs, np.isnan(root), undetermined, singular),
    )


def assembly_arcs(condition: Condition) -> tuple[CrankRange, ...]:
    """The crank angles for which P² + Q² - K² is not negative: a polynomial of degree 2 in cos phi and sin phi."""

    def inside(phi: Reals) -> Reals:
        p, q, k = (part[0] for part in condition(np.cos(phi)[None], np.sin(phi)[None]))
        reach = np.hypot(p, q)
        return np.asarray((reach - k) * (reach + k) / max(float(abs(reach).max()), float(abs(k).max())) ** 2)

    values = np.fft.fft(inside(np.arange(8) * TURN / 8)) / 8
    coefficients = np.array([values[2], values[1], values[0], values[-1], values[-2]])
    coefficients[abs(coefficients) < _ROUNDINGS * abs(coefficients).max()] = 0
    roots = np.roots(coefficients)
    cuts = np.sort(np.angle(roots[abs(abs(roots) - 1) < _ON_CIRCLE]))
    if not len(cuts):
        return (CrankRange(0.0, TURN),) if inside(np.zeros(1))[0] >= 0 else ()
    ends = np.append(cuts[1:], cuts[0] + TURN)
    whole = inside((cuts + ends) / 2) >= -_ROUNDINGS
    if whole.all():
        return (CrankRange(0.0, TURN),)
    first = int(np.flatnonzero(~whole)[0]) + 1
    arcs: list[CrankRange] = []
    for k in range(first, first + len(cuts) - 1):
        n, turns = k % len(cuts), k // len(cuts)
        if not whole[n]:
            continue
        start, end = float(cuts[n] + turns * TURN), float(ends[n] + turns * TURN)
        if arcs and math.isclose(arcs[-1].end, start, rel_tol=0, abs_tol=1e-12):
            start = arcs.pop().start
        arcs.append(CrankRange(start, end))
    return tuple(arcs)
