"""The table of `gruebler analyse`: columns of numbers over the rows of a motion."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from math import pi
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gruebler.analysis.outputs import Output
from gruebler.arrays import Reals
from gruebler.errors import GrueblerError
from gruebler.kinematics import Motion
from gruebler.linkages import CamDisc, GenevaDriver, Linkage, NonCircular

__all__ = ["Column", "as_csv", "check_csv", "columns", "shown"]

_POSE = ("x", "y")
_RATES = (("vx", "vy"), ("ax", "ay"), ("jx", "jy"))
_DEGREES = 180 / pi
# Of derivatives of the orders 0 to 3 where polynomials stand for cams and non-circular wheels: each one multiplies
# rounding. docs/theory/wheels.md has 1e-10, 1e-7, 1e-4 for velocities, accelerations, jerks of up to 24, 45, 310.
_POLYNOMIAL_NOISE = (1e-12, 1e-10, 1e-8, 1e-6)
_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")


class Column(NamedTuple):
    """A quantity over the rows."""

    name: str
    unit: str
    values: Reals
    """(rows,); NaN where it is not defined."""
    natural: float = 0.0
    """What such a quantity usually is."""
    noise: float = 1e-12
    """The part of the largest or usual value that rounding can make."""

    @property
    def header(self) -> str:
        """Name and unit."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    def without(self, rows: int) -> Column:
        """The column without its first rows."""
        return self._replace(values=self.values[rows:])


def columns(
    motion: Motion,
    outputs: Sequence[Output],
    points: Iterable[str],
    rates: Sequence[float] | None = None,
    transmission: Reals | None = None,
    word: str = "",
) -> list[Column]:
    """Drives, outputs with derivatives by the drive and in time, transmission angle, points.

    Args:
        motion: of one drive solved for speed 1, of several for their rates, to the second or third order; or to
            order 0.
        outputs: what is looked at.
        points: names of points or joints.
        rates: velocity, acceleration and jerk of one drive, in radians or units of length and seconds; None: rates by
            the drive only.
        transmission: (rows,) angle in radians, if there is one.
        word: the name of that column.
    """
    linkage, mechanism = motion.linkage, motion.linkage.mechanism
    out = []
    for k, (name, drive) in enumerate(zip(mechanism.drive_names(), mechanism.drives, strict=True)):
        turning = drive.turning
        out.append(_scaled(name, turning, linkage, motion.drives[:, k]))
    turning = mechanism.drives[0].turning
    per, unit = ("rad", 1.0) if turning else (linkage.unit, linkage.size)
    timed = len(mechanism.drives) > 1 or rates is not None
    v, a, j = (1.0, 0.0, 0.0) if rates is None else rates
    orders = range(1, motion.order + 1) if motion.order >= 2 else ()

    def in_time(order: int, track: Callable[[int], Reals]) -> Reals:
        """A derivative in time from those by the drive; of several drives they are in time already."""
        if order == 1:
            return track(1) * v
        if order == 2:
            return track(2) * v**2 + track(1) * a
        return track(3) * v**3 + 3 * track(2) * v * a + track(1) * j

    noise = (1e-12,) * 4
    if any(isinstance(element, CamDisc | GenevaDriver | NonCircular) for element in linkage.elements.values()):
        noise = _POLYNOMIAL_NOISE
    usual = (abs(v), v**2 + abs(a), abs(v) ** 3 + 3 * abs(v * a) + abs(j))
    for output in outputs:
        own, natural = ("rad", 1.0) if output.turning else (linkage.unit, linkage.size)
        out.append(_scaled(output.name, output.turning, linkage, output.values(motion)))
        for order in (1, 2) if orders and len(mechanism.drives) == 1 else ():
            name, usually = f"{output.name}{'′' * order}", natural / unit**order
            out.append(Column(name, _by(own, per, order), output.values(motion, order), usually, noise[order]))
        for order in orders if timed else ():
            name = f"{('ωαj' if output.turning else 'vaj')[order - 1]} {output.name}"
            values = in_time(order, partial(output.values, motion))
            usually = natural * usual[order - 1] / unit**order
            out.append(Column(name, f"{own}/{_seconds(order)}", values, usually, noise[order]))
    if transmission is not None:
        out.append(Column(word, "°", transmission * _DEGREES, _DEGREES))
    for name in points:
        at = motion.point(name)
        out += [Column(f"{name} {axis}", linkage.unit, at[:, k], linkage.size) for k, axis in enumerate(_POSE)]
        for order in orders:
            values = in_time(order, partial(motion.point, name))
            written = f"{linkage.unit}/{_seconds(order)}" if timed else _by(linkage.unit, per, order)
            natural = linkage.size * usual[order - 1] / unit**order
            out += [
                Column(f"{name} {axis}", written, values[:, k], natural, noise[order])
                for k, axis in enumerate(_RATES[order - 1])
            ]
    return out


def _seconds(order: int) -> str:
    return ("s", "s²", "s³")[order - 1]


def _scaled(name: str, turning: bool, linkage: Linkage, values: Reals) -> Column:
    if turning:
        return Column(name, "°", values * _DEGREES, _DEGREES)
    return Column(name, linkage.unit, values, linkage.size)


def _by(own: str, per: str, order: int) -> str:
    """The unit of a derivative by the drive.

    >>> _by("mm", "rad", 2), _by("rad", "rad", 1), _by("mm", "mm", 2)
    ('mm/rad²', '', '1/mm')
    """
    if own == per:
        return "" if order == 1 else f"1/{per}"
    return f"{own}/{per}{'' if order == 1 else '²'}"


def shown(made: Sequence[Column]) -> list[list[str]]:
    """The rows as texts of six digits, rounding noise as 0, a radius without end as ∞."""
    cells = []
    for column in made:
        finite = np.abs(column.values[np.isfinite(column.values)])
        noise = column.noise * max(finite.max(initial=0.0), column.natural)
        values = np.where(np.abs(column.values) <= noise, 0.0, column.values)
        cells.append([_cell(value) for value in values])
    return [list(row) for row in zip(*cells, strict=True)]


def _cell(value: float) -> str:
    if np.isfinite(value):
        return f"{value + 0.0:.6g}"
    return "∞" if np.isinf(value) else "–"


def check_csv(path: Path | None) -> None:
    """`GrueblerError` if the name of the file promises something else than a table."""
    if path is not None and path.suffix.lower() not in ("", ".csv", ".txt"):
        raise GrueblerError("{path}: a table is written as CSV; end the name with .csv", path=path)


def as_csv(made: Sequence[Column]) -> str:
    """A table with the units in its header; an empty cell where a quantity is not defined.

    Headers that begin with = + - @, a tab or a line end get an apostrophe in front, so that no spreadsheet takes the
    name of a point for a formula. Numbers stay as they are.
    """
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(["'" + one if one.startswith(_FORMULA) else one for one in (column.header for column in made)])
    for row in zip(*(column.values for column in made), strict=True):
        writer.writerow([repr(float(value)) if np.isfinite(value) else "" for value in row])
    return text.getvalue()
