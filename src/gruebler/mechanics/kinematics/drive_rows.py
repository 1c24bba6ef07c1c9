"""Rows of drive values and of their rates, from what a user gives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.angles import doubt_of_angles, warn_of_degrees
from gruebler.base.arrays import Reals, real_numbers
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.structure.mechanism import Mechanism

if TYPE_CHECKING:
    from gruebler.mechanics.kinematics.plan import Plan

_ROUNDING = 1e-12  # of a number of steps: its error by two roundings, with room
_LAST = 1e-9  # of a step: an end that is missed by less is reached


@door_that_raises(LinkageError)
def from_degrees(start: float, stop: float, step: float) -> Reals:
    """Angles from start to stop, both included, given in degrees, in radians.

    Args:
        start: the first angle in degrees.
        stop: the last one in degrees, included where the steps meet it.
        step: their difference in degrees; negative to go down.

    Returns:
        (rows,) angles in radians.

    Raises:
        LinkageError: steps that do not lead from start to stop, more than 10,000,000 rows.

    Cost:
        5 ns an angle.

    Example:
        >>> from_degrees(0, 180, 90).round(4).tolist()
        [0.0, 1.5708, 3.1416]

    See Also:
        `rpm`, `move`

    Theory:
        docs/theory/kinematics.md
    """
    if not step or not np.isfinite([start, stop, step]).all() or (stop - start) / step < 0:
        raise LinkageError(
            "no angles lead from {start:g} to {stop:g} by steps of {step:g}", start=start, stop=stop, step=step
        )
    count = int(np.floor((stop - start) / step * (1 + _ROUNDING) + _LAST))
    if count > 10_000_000:
        raise LinkageError("{count:,} rows are more than 10,000,000", count=count + 1)
    values: Reals = np.radians(start + step * np.arange(count + 1))
    return values


@door_that_raises(LinkageError)
def rpm(value: float) -> float:
    """A speed given in revolutions per minute, in radians per second.

    Args:
        value: revolutions per minute; negative for the other way round.

    Returns:
        The speed in rad/s.

    Raises:
        LinkageError: something else than a number.

    Cost:
        A microsecond.

    Example:
        >>> round(rpm(60) / np.pi, 12)
        2.0

    See Also:
        `from_degrees`, `move`, `measures`

    Theory:
        docs/theory/kinematics.md
    """
    return value * np.pi / 30


def in_rpm(speed: float) -> float:
    """A speed in rad/s, in revolutions per minute to twelve digits: what `rpm` was given.

    >>> in_rpm(rpm(300))
    300.0
    """
    return float(f"{speed * 30 / np.pi:.12g}")


def drive_path(plan: Plan, drives: ArrayLike) -> Reals:
    """(rows, drives) values, checked."""
    return path_of_values(drives, len(plan.linkage.mechanism.drives))


def path_of_values(drives: ArrayLike, wanted: int) -> Reals:
    """(rows, wanted) values, checked."""
    path = real_numbers(drives)
    if path is None:
        raise LinkageError("drives: expected numbers (radians, or lengths), but found {drives!r}", drives=drives)
    if path.ndim == 0:
        path = path.reshape(1, 1)
    if path.ndim == 1:
        path = path.reshape(-1, 1) if wanted == 1 else path.reshape(1, -1)
    if path.ndim != 2 or path.shape[1] != wanted or not len(path):
        if not path.size:
            raise LinkageError("expected drive values, but found no rows")
        raise LinkageError(
            "the linkage has 1 drive, but found rows of {count}"
            if wanted == 1
            else "the linkage has {wanted} drives, but found rows of {count}",
            wanted=wanted,
            count=path.shape[-1],
        )
    if not np.isfinite(path).all():
        row = int(np.argwhere(~np.isfinite(path))[0, 0])
        raise LinkageError(
            "drive values are finite numbers, but row {row} has {numbers}", row=row, numbers=path[row].tolist()
        )
    return np.ascontiguousarray(path)


def row_of_values(drives: ArrayLike, wanted: int) -> Reals:
    """(1, wanted) values, checked: those of one pose."""
    path = path_of_values(drives, wanted)
    if len(path) > 1:
        raise LinkageError("expected a value for each drive, but found {count} rows of values", count=len(path))
    return path


def warn_of_path(plan: Plan, path: Reals) -> None:
    """`UnitWarning` if the values of a turning drive, (rows, drives), look like degrees."""
    warn_of_angles(plan.linkage.mechanism, path)


def warn_of_angles(mechanism: Mechanism, path: Reals) -> None:
    """`UnitWarning` as of `warn_of_path`."""
    for k, drive in enumerate(mechanism.drives):
        if drive.turning and doubt_of_angles(path[:, k], path=True) is not None:
            warn_of_degrees(mechanism.drive_names()[k], path[:, k], path=True)


def drive_speeds(
    path: Reals, speed: ArrayLike | None, acceleration: ArrayLike, jerk: ArrayLike, order: int | None
) -> Reals:
    """(order, rows, drives) rates, checked; one value may stand for all rows. The usual order is 2 with a speed."""
    order = (0 if speed is None else 2) if order is None else order
    if order not in (0, 1, 2, 3):
        raise LinkageError("the order is 0, 1, 2 or 3, not {order!r}", order=order)
    given = {"speed": 1.0 if speed is None else speed, "acceleration": acceleration, "jerk": jerk}
    speeds = np.zeros((order, *path.shape))
    for k, (name, value) in enumerate(given.items()):
        numbers = real_numbers(value)
        if numbers is None or not np.isfinite(numbers).all():
            raise LinkageError("{name}: expected finite numbers, but found {value!r}", name=name, value=value)
        if k >= order:
            continue
        if numbers.ndim == 1 and path.shape[1] == 1 and len(numbers) == len(path):
            numbers = numbers.reshape(-1, 1)
        try:
            speeds[k] = numbers
        except ValueError:
            raise LinkageError(
                "{name}: expected one number, one for each drive, or one for each row and drive, but found an array "
                "{shape}",
                name=name,
                shape=numbers.shape,
            ) from None
    return speeds
