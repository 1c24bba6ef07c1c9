"""Angles in radians that look as if they were degrees: the law, and the warning.

docs/theory/kinematics.md, "Degrees by mistake".
"""

from __future__ import annotations

from math import pi

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

from gruebler.base.errors import UnitWarning, warn
from gruebler.base.text import Message, message

_TURN = 2 * pi * (1 + 1e-9)
_EVEN = 1e-12  # of the largest: steps that differ by less are equal
_RIGHT = 90.0  # degrees: few ranges in radians are a whole number of these


def doubt_of_angles(values: ArrayLike, *, path: bool = False, once: bool = False) -> Message | None:
    """Why angles given in radians are probably degrees; None if they are probably not.

    Args:
        values: of any shape.
        path: they are taken one after the other, so that a step beyond half a turn leaves the way between open.
        once: they are directions of a body or angles of a function, which a turn exhausts.

    >>> print(doubt_of_angles(np.arange(0, 361)))
    all are whole numbers, up to 360
    >>> print(doubt_of_angles(np.linspace(0, 360, 50), path=True))
    neighbouring values differ by up to 7.347 rad, more than half a turn
    >>> doubt_of_angles(np.linspace(0, 20 * pi, 2000), path=True)
    """
    angles = np.asarray(values, np.float64).ravel()
    largest = float(np.abs(angles).max(initial=0.0))
    step = float(np.abs(np.diff(angles)).max(initial=0.0)) if path and largest > pi / 2 else 0.0
    doubt = None
    if step > _TURN / 2:
        doubt = message("neighbouring values differ by up to {step:.4g} rad, more than half a turn", step=step)
    elif largest > _TURN:
        first, last = float(angles[0]), float(angles[-1])
        if once:
            doubt = message("{value:g} is beyond a turn", value=largest)
        elif (angles == np.rint(angles)).all():
            doubt = message("all are whole numbers, up to {value:g}", value=largest)
        elif first == round(first) and first != last and (last - first) % _RIGHT == 0:
            doubt = message("they go from {first:g} to {last:g}", first=first, last=last)
        elif first == round(first) and (end := _behind(angles)) and abs(end - first) >= _RIGHT:
            doubt = message("they go from {first:g} in equal steps up to {end:g}", first=first, end=end)
    return doubt


def _behind(angles: npt.NDArray[np.float64]) -> float | None:
    """What follows in equal steps (`numpy.arange`), if it lies a whole multiple of 90 from the first."""
    steps = np.diff(angles)
    if len(steps) < 2 or np.abs(steps - steps[0]).max() > _EVEN * np.abs(angles).max():
        return None
    end = float(angles[0] + steps.mean() * len(angles))
    turns = (end - float(angles[0])) / _RIGHT
    return float(round(end)) if turns and abs(turns - round(turns)) < _EVEN * len(angles) else None


def warn_of_degrees(name: str | Message, values: ArrayLike, *, path: bool = False, once: bool = False) -> None:
    """`UnitWarning` at the line of the user if angles in radians look like degrees; see `doubt_of_angles`."""
    doubt = doubt_of_angles(values, path=path, once=once)
    if doubt is None:
        return
    text = message("{name}: angles are in radians, but {doubt}; from_degrees() converts", name=name, doubt=doubt)
    warn(text, UnitWarning)
