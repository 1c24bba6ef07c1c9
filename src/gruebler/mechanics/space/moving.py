"""`move` for every linkage: in the plane by the groups of its plan, in space by its closing conditions."""

from __future__ import annotations

from math import factorial
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics import solve
from gruebler.mechanics.kinematics.drive_rows import drive_speeds, path_of_values, warn_of_angles
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, linkage_made
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.change_point_rows import follow_through
from gruebler.mechanics.space.ends import stop_of
from gruebler.mechanics.space.following import Setting, setting
from gruebler.mechanics.space.motion import SpatialMotion

_LONGEST_WAY = 1e9  # radians and sizes from row to row, as the kernel has it


@overload
def move(
    linkage: SpatialLike,
    drives: ArrayLike,
    *,
    branch: Branch = None,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
    order: int | None = None,
) -> SpatialMotion: ...


@overload
def move(
    linkage: LinkageLike | Plan,
    drives: ArrayLike,
    *,
    branch: Branch = None,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
    order: int | None = None,
) -> Motion: ...


@door_that_raises(LinkageError)
def move(
    linkage: LinkageLike | Plan | SpatialLike,
    drives: ArrayLike,
    *,
    branch: Branch = None,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
    order: int | None = None,
) -> Motion | SpatialMotion:
    """Move a linkage along a path of its drives, in the plane or in space.

    Args:
        linkage: a linkage whose drives fix the motion, or a `FourBar`, `SliderCrank`, `InvertedSliderCrank`; a
            `SpatialLinkage`, or an `RSSR`, `Bennett`, `SphericalFourBar`, `SwashPlate` that makes one, moves from its
            reference pose, in which its drives are 0.
        drives: (rows,) for one drive, (rows, drives) for several: angles in radians, displacements in the linkage's
            unit. Between rows the drives move on straight lines.
        branch: in the plane the assembly mode at the first row, such as ``"+-"``; without it the one that leads from
            the linkage's reference pose to the first row, or all ``+`` and 1. In space it is that of the reference
            pose.
        speed: the drives' velocity, one number or like ``drives``; 1 if only an order is given.
        acceleration: likewise.
        jerk: likewise.
        order: 0 positions, 1 with velocities, 2 with accelerations, 3 with jerks; 2 if a speed is given, else 0.

    Returns:
        `Motion`, or in space `SpatialMotion`: (rows, 2) or (rows, 3) places of points, turns and their rates;
        ``stop`` says where and why the path could not be followed to its end. A linkage in the plane that cannot be
        assembled at the first row has a motion without rows, with a warning.

    Raises:
        LinkageError: drives that do not fix the motion, numbers that are not usable, an unknown branch.
        AssemblyWarning: nothing can be assembled at the first row; a warning, since in a search this is an answer.

    Cost:
        In the plane 10 to 30 ns a pose of a dyad where rows are taken in sweeps, 0.1 to 0.3 us where each is walked
        to, 1 to 3 us of a group of four links. In space 0.5 to 10 us a pose, and some milliseconds for the first
        motion of a linkage.

    Example:
        >>> from gruebler.mechanics.kinematics import from_degrees
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> motion = move(FourBar(a=25, b=70, c=40, d=70).linkage(), from_degrees(0, 360, 1), speed=10)
        >>> len(motion), motion.complete, bool(motion.closure_error < 1e-13)
        (361, True, True)

    See Also:
        `Motion`, `SpatialLinkage`, `move_many`, `circuit`, `measures`, `from_degrees`, `rpm`

    Theory:
        docs/theory/space.md
    """
    placed = linkage_made(linkage)
    if not isinstance(placed, SpatialLinkage):
        return solve.move(placed, drives, branch=branch, speed=speed, acceleration=acceleration, jerk=jerk, order=order)
    if branch is not None:
        raise LinkageError("a linkage given by its reference pose has no assembly mode to choose")
    mechanism = placed.mechanism
    path = path_of_values(drives, len(mechanism.drives))
    _check_ways(placed, path)
    warn_of_angles(mechanism, path)
    speeds = drive_speeds(path, speed, acceleration, jerk, order)
    return moved(setting(placed), path, speeds)


def _check_ways(linkage: SpatialLinkage, path: Reals) -> None:
    """A row so far from the one before that the way there would take minutes is refused."""
    ways = abs(np.diff(path, axis=0, prepend=0.0))
    longest = [_LONGEST_WAY * (1.0 if drive.turning else linkage.size) for drive in linkage.mechanism.drives]
    for row, k in np.argwhere(ways > longest)[:1].tolist():
        raise LinkageError(
            "{drive}: row {row} is {way:.4g} {unit} from the row before; expected at most {most:.4g}",
            drive=linkage.mechanism.drive_names()[k],
            row=row,
            way=float(ways[row, k]),
            unit="rad" if linkage.mechanism.drives[k].turning else linkage.unit,
            most=longest[k],
        )


def moved(set_up: Setting, path: Reals, speeds: Reals) -> SpatialMotion:
    """The motion along drive values (rows, drives), with rates (order, rows, drives)."""
    tree = set_up.closure.tree
    unit = set_up.closure.units
    sides = np.array([tree.signs[tree.drives.index(k)] for k in set_up.drives.tolist()])
    order = [tree.drives.index(k) for k in set_up.drives.tolist()]
    scale = sides / unit[set_up.drives]
    own = path[:, order] * scale
    factors = np.array([float(factorial(k)) for k in range(len(speeds) + 1)])
    rates = speeds[:, :, order] * scale / factors[1:, None, None]
    rows, changes = follow_through(set_up, own, rates)
    count = len(rows.derivatives)
    balls = {start + k for start in tree.folds for k in (-1, 0, 1)}
    stop = None if rows.end is None else stop_of(set_up, rows.last, rows.end, own[count] - own[count - 1] * (count > 0))
    return SpatialMotion(
        linkage=tree.linkage,
        drives=path[:count],
        poses=rows.poses,
        unknowns={
            key: rows.series[:, :, k] * factors[:, None] * unit[k] for key, k in tree.unknown.items() if k not in balls
        },
        derivatives=rows.derivatives,
        gap=rows.gap,
        rank=set_up.rank,
        idle=tuple(tree.linkage.mechanism.chain.links[rod.link] for rod in tree.rods),
        held=set_up.held_joints,
        stop=stop,
        passed=tuple(rows.passed),
        changes=changes,
    )
