"""The flywheel that keeps the speed of a drive nearly even."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.units import metres_of
from gruebler.mechanics.dynamics.equations import reduced_equations
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.kinematics import Motion


@dataclass(frozen=True, kw_only=True)
class Flywheel:
    """What a flywheel on the drive must have so that the speed varies by no more than is wanted."""

    inertia: float
    """Moment of inertia to add, kg times the unit squared; 0 if the linkage needs none."""
    torque: float
    """The constant torque of the drive that keeps the turn going, newtons times the unit."""
    swing: float
    """Energy that it must take up and give back, newtons times the unit."""


@door_that_raises(LinkageError)
def flywheel(motion: Motion, loads: Loads, irregularity: float) -> Flywheel:
    """The flywheel for a wanted irregularity (largest - least speed) / mean speed, exactly, after Wittenbauer.

    Args:
        motion: A full turn of one drive, both ends included, at the mean speed: ``move(linkage, rows, speed=...)``.
        loads: What acts, and the masses; loads that depend on the speed are taken at the mean speed.
        irregularity: Such as 0.02.

    Returns:
        `Flywheel`: its moment of inertia, the mean torque of the drive.

    Raises:
        LinkageError: not a full turn, an irregularity that is not between 0 and 2.

    Cost:
        The motion twice. Error: that of the trapezoidal rule over the rows, their distance squared.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> from gruebler.mechanics.kinematics import move
        >>> turn = np.linspace(0, 2 * np.pi, 361)
        >>> load = Loads(moments={"crank": lambda state: -100 * (1 - np.cos(state.drives[:, 0]))})
        >>> wheel = flywheel(move(FourBar(25, 70, 40, 70), turn, speed=10.0), load, 0.02)
        >>> round(wheel.torque, 6), round(wheel.inertia * 1e-3, 2)  # 200 N mm taken up; 200 / (0.02 · 10²)
        (100.0, 100.0)

    See Also:
        `reduced_equations`, `simulate`

    Theory:
        docs/theory/balancing.md
    """
    if not 0 < irregularity < 2:
        raise LinkageError("the irregularity is a number between 0 and 2, not {value!r}", value=irregularity)
    reduced, drive = reduced_equations(motion, loads), motion.drives[:, 0]
    turn = abs(drive[-1] - drive[0]) if len(drive) else 0.0
    if motion.drives.shape[1] != 1 or not abs(turn - 2 * np.pi) < 1e-9 or motion.speeds is None:
        raise LinkageError("a flywheel needs a full turn of one drive, both ends included, with its speed")
    inertia, force = reduced.mass[:, 0, 0], reduced.force[:, 0]
    if not (np.isfinite(inertia).all() and np.isfinite(force).all()):
        raise LinkageError("a flywheel needs a drive that turns fully, without limits")
    mean = float(np.abs(motion.speeds[0]).mean())
    steps = np.diff(drive)
    torque = -float((steps * (force[1:] + force[:-1])).sum() / 2 / (drive[-1] - drive[0]))
    taken = np.concatenate([[0.0], np.cumsum(steps * ((force[1:] + force[:-1]) / 2 + torque))])
    fastest, slowest = (mean * (1 + sign * irregularity / 2) for sign in (1, -1))
    swing = float((taken - fastest**2 / 2 * inertia).max() - (taken - slowest**2 / 2 * inertia).min())
    needed = swing / (irregularity * mean**2)
    return Flywheel(inertia=max(needed, 0.0) / metres_of(motion.linkage.unit), torque=torque, swing=max(swing, 0.0))
