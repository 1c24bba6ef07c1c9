"""The table of a motion: drives, outputs and points with their derivatives, columns of numbers with units."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import ceil, floor, log10, pi
from typing import TYPE_CHECKING

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.analysis.transmission import transmission_angle
from gruebler.mechanics.kinematics.drive_rows import from_degrees
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.points import PointLike, each_point
from gruebler.structure.chain.pairs import Alphabet

if TYPE_CHECKING:
    from gruebler.mechanics.analysis.cycle_spans import CycleSpan

_POSE = ("x", "y")
_RATES = (("vx", "vy"), ("ax", "ay"), ("jx", "jy"))
_DEGREES = 180 / pi
# Of derivatives of the orders 0 to 3: each one multiplies rounding, most beside poses in which links lie on one line.
_NOISE = (1e-12, 1e-11, 1e-10, 1e-9)
# Where polynomials stand for cams and non-circular wheels, docs/theory/wheels.md has 1e-10, 1e-7, 1e-4 for velocities,
# accelerations, jerks of up to 24, 45, 310.
_POLYNOMIAL_NOISE = (1e-12, 1e-10, 1e-8, 1e-6)
_ROW_STEP = 15.0  # degrees between the rows of a full turn


def motion_table(
    motion: Motion,
    outputs: Sequence[str | Output] | None = None,
    points: Sequence[PointLike] = (),
    *,
    rates: Sequence[float] | None = None,
    transmission: str | None = None,
    lang: str = "en",
) -> Table:
    """What a motion shows row by row: drives, outputs with derivatives by the drive and in time, points.

    Angles are in degrees, their derivatives in radians, lengths in the linkage's unit, times in seconds. The name of
    a derivative by the drive has a prime for each order; rates in time are ω, α, j of angles and v, a, j of lengths.
    Of a motion of one drive that was solved for another speed than 1 both are there.

    Args:
        motion: Solved to any order: the table has as many derivatives, by the drive the first two.
        outputs: Links or sliding joints; without them the linkage's outputs.
        points: Names of points or joints.
        rates: Velocity, acceleration and jerk of one drive, in radians or units of length and seconds, for a motion
            solved for speed 1; without them rates in time are those that the motion was solved for.
        transmission: The output whose transmission angle gets a column.
        lang: Language of the column names and joint symbols.

    Raises `GrueblerError` for unknown names, and for rates of a motion that was solved for others.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> from gruebler.mechanics.kinematics import from_degrees, move
    >>> table = motion_table(move(FourBar(25, 70, 40, 70).linkage(), from_degrees(0, 180, 90), speed=1.0), ["rocker"])
    >>> [column.header for column in table]
    ['R(frame-crank) [°]', 'rocker [°]', 'rocker′', 'rocker′′ [1/rad]']
    >>> table["rocker"].round(3).tolist()
    [69.258, 92.319, 138.876]
    """
    linkage, mechanism = motion.linkage, motion.linkage.mechanism
    asked: Sequence[str | Output | None] = outputs or linkage.outputs or [None]
    seen = [each if isinstance(each, Output) else find_output(linkage, each) for each in asked]
    columns = []
    for k, (name, drive) in enumerate(
        zip(mechanism.drive_names(Alphabet.of_language(lang)), mechanism.drives, strict=True)
    ):
        turning = drive.turning
        columns.append(_scaled(name, turning, linkage, motion.drives[:, k]))
    turning = mechanism.drives[0].turning
    per, unit = ("rad", 1.0) if turning else (linkage.unit, linkage.size)
    orders = range(1, motion.order + 1)
    solved = _drive_rates(motion) if orders and len(mechanism.drives) == 1 else None
    if rates is not None and solved is not None:
        raise LinkageError("rates of the drive need a motion that was solved for speed 1")
    timed = len(mechanism.drives) > 1 or rates is not None or solved is not None
    v, a, j = (1.0, 0.0, 0.0) if rates is None else rates

    def in_time(order: int, track: Callable[[int], Reals]) -> Reals:
        """A derivative in time from those by the drive; of several drives they are in time already."""
        if order == 1:
            return track(1) * v
        if order == 2:
            return track(2) * v**2 + track(1) * a
        return track(3) * v**3 + 3 * track(2) * v * a + track(1) * j

    def by_drive(order: int, track: Callable[[int], Reals]) -> Reals:
        """A derivative by the drive, of the first or second order, from those in time: dx/dt = x' v."""
        if solved is None:
            return track(order)
        speed, acceleration = solved
        with np.errstate(divide="ignore", invalid="ignore"):  # a drive that rests says nothing about them
            slope = track(1) / speed
            derivative = slope if order == 1 else (track(2) - slope * acceleration) / speed**2
        return np.where(speed == 0, np.nan, derivative)

    leads = any(element.leads for element in linkage.elements.values())
    noise = _POLYNOMIAL_NOISE if leads else _NOISE
    usual = _usual_rates(motion, rates)
    for output in seen:
        own, natural = ("rad", 1.0) if output.turning else (linkage.unit, linkage.size)
        columns.append(_scaled(output.name, output.turning, linkage, output.values(motion)))
        for order in orders[:2] if len(mechanism.drives) == 1 else ():
            name, usually = f"{output.name}{'′' * order}", natural / unit**order
            values = by_drive(order, partial(output.values, motion))
            columns.append(Column(name, unit=_by(own, per, order), values=values, natural=usually, noise=noise[order]))
        for order in orders if timed else ():
            name = f"{('ωαj' if output.turning else 'vaj')[order - 1]} {output.name}"
            values = in_time(order, partial(output.values, motion))
            usually = natural * usual[order - 1]
            columns.append(
                Column(name, unit=f"{own or 1}/{_seconds(order)}", values=values, natural=usually, noise=noise[order])
            )
    if transmission is not None:
        angle = transmission_angle(motion, transmission)
        columns.append(
            Column(translate("transmission angle", lang), unit="°", values=angle * _DEGREES, natural=_DEGREES)
        )
    for name, point in each_point(points).items():
        at = motion.point(point)
        columns += [
            Column(f"{name} {axis}", unit=linkage.unit, values=at[:, k], natural=linkage.size)
            for k, axis in enumerate(_POSE)
        ]
        for order in orders:
            values = in_time(order, _rates_of(motion, point))
            written = f"{linkage.unit or 1}/{_seconds(order)}" if timed else _by(linkage.unit, per, order)
            natural = linkage.size * usual[order - 1]
            columns += [
                Column(f"{name} {axis}", unit=written, values=values[:, k], natural=natural, noise=noise[order])
                for k, axis in enumerate(_RATES[order - 1])
            ]
    return Table(tuple(columns))


def _drive_rates(motion: Motion) -> tuple[Reals, Reals] | None:
    """Velocity and acceleration of the only drive, (rows,) each; None if it was solved for speed 1 throughout."""
    if motion.speeds is None:
        return None
    velocity, *higher = motion.speeds[:, :, 0]
    plain = (velocity == 1.0).all() and not any(each.any() for each in higher)
    return None if plain else (velocity, higher[0] if higher else np.zeros_like(velocity))


def _usual_rates(motion: Motion, rates: Sequence[float] | None) -> tuple[float, float, float]:
    """How fast angles, and lengths by the size, usually change in each order, after the rates of the drives."""
    size = motion.linkage.size
    units = [1.0 if drive.turning else size for drive in motion.linkage.mechanism.drives]
    if rates is not None:
        largest = np.abs(rates) / units[0]
    else:
        speeds = np.ones((1, 1, 1)) if motion.speeds is None else motion.speeds
        largest = (np.abs(speeds) / units).max(axis=(1, 2), initial=0.0)
    v, a, j = [*largest.tolist(), 0.0, 0.0, 0.0][:3]
    return v, v**2 + a, v**3 + 3 * v * a + j


def _rates_of(motion: Motion, point: PointLike) -> Callable[[int], Reals]:
    return lambda order: motion.point(point, order=order)


def _seconds(order: int) -> str:
    return ("s", "s²", "s³")[order - 1]


def _scaled(name: str, turning: bool, linkage: Linkage, values: Reals) -> Column:
    if turning:
        return Column(name, unit="°", values=values * _DEGREES, natural=_DEGREES)
    return Column(name, unit=linkage.unit, values=values, natural=linkage.size)


def _by(own: str, per: str, order: int) -> str:
    """The unit of a derivative by the drive.

    >>> _by("mm", "rad", 2), _by("rad", "rad", 1), _by("mm", "mm", 2), _by("", "rad", 1), _by("rad", "", 1)
    ('mm/rad²', '', '1/mm', '1/rad', 'rad')
    """
    if own == per:
        return "" if order == 1 or not per else f"1/{per}"
    return f"{own or 1}/{per}{'' if order == 1 else '²'}" if per else own


def default_rows(span: CycleSpan, between: tuple[float, float] | None, turning: bool) -> Reals:
    """Drive values for a table: a full turn by 15 degrees, or about 20 round numbers in the range; (rows, 1).

    Args:
        span: The range of the drive.
        between: A smaller range, in degrees or the unit.
        turning: Whether the drive turns.
    """
    if between is None and span.full:
        return from_degrees(0, 360 * span.turns, _ROW_STEP).reshape(-1, 1)
    scale = 180 / pi if turning else 1.0
    low, high = between or (span.low * scale, span.high * scale)
    step = _round_step((high - low) / 20)
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return np.array([[k * step / scale] for k in range(first, last + 1)])


def _round_step(step: float) -> float:
    """The next number of 1, 2, 5 times a power of ten.

    >>> _round_step(0.03), _round_step(3.4)
    (0.05, 5.0)
    """
    power = floor(log10(step))
    return next(float(f"{k}e{power}") for k in (1, 2, 5, 10) if k * 10.0**power >= step * (1 - 1e-9))
