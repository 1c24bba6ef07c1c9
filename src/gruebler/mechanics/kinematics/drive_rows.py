"""Rows of drive values and of their rates, from what a user gives."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.angles import doubt_of_angles, warn_of_degrees
from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.plan import Plan

_ROUNDING = 1e-12  # of a number of steps: its error by two roundings, with room
_LAST = 1e-9  # of a step: an end that is missed by less is reached


@door_that_raises(LinkageError)
def from_degrees(start: float, stop: float, step: float) -> Reals:
    """Angles from start to stop, both included, given in degrees, in radians.

    >>> from_degrees(0, 180, 90).round(4).tolist()
    [0.0, 1.5708, 3.1416]
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


def drive_path(plan: Plan, drives: ArrayLike) -> Reals:
    """(rows, drives) values, checked."""
    wanted = len(plan.linkage.mechanism.drives)
    try:
        path = np.array(drives, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise LinkageError("drive values are numbers, but found {drives!r}", drives=drives) from None
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


def warn_of_path(plan: Plan, path: Reals) -> None:
    """`UnitWarning` if the values of a turning drive, (rows, drives), look like degrees."""
    mechanism = plan.linkage.mechanism
    for k, drive in enumerate(mechanism.drives):
        if drive.turning and doubt_of_angles(path[:, k], path=True) is not None:
            warn_of_degrees(mechanism.drive_names()[k], path[:, k], path=True)


def drive_speeds(path: Reals, given: tuple[ArrayLike, ...], order: int) -> Reals:
    """(order, rows, drives) rates, checked; one value may stand for all rows."""
    speeds = np.zeros((order, *path.shape))
    for k, (name, value) in enumerate(zip(("speed", "acceleration", "jerk"), given, strict=True)):
        if k >= order:
            break
        try:
            numbers = np.asarray(value, np.float64)
        except (TypeError, ValueError, OverflowError):
            numbers = np.array(np.nan)
        if not np.isfinite(numbers).all():
            raise LinkageError("{name}: expected finite numbers, but found {value!r}", name=name, value=value)
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
