"""`drive_range` of every linkage: a full turn, or to where the motion ends on both sides."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import degrees, pi
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import explained
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.analysis import circuit_ranges
from gruebler.mechanics.analysis.circuit_ranges import DriveRange
from gruebler.mechanics.kinematics.circuits import Circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, linkage_made
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.circuits import SpatialCircuit
from gruebler.mechanics.space.following import setting
from gruebler.mechanics.space.motion import SpatialMotion, SpatialStop
from gruebler.mechanics.space.moving import moved

RANGE_OF_ONE = message("a range needs one drive, but the mechanism has {count}: {drives}")
_ROWS = 72  # of a turn, or of three sizes of a slide
_STILL = 1e-9  # of the size: a length below is 0

_TURNS = message("The drive {drive} turns fully.")
_BETWEEN = message("The drive {drive} moves from {low} to {high}.")
_OPEN = message("It was followed no farther than three sizes of the linkage.")


@explained
@dataclass(frozen=True, kw_only=True)
class SpatialRange:
    """Between which values the drive moves from the reference pose, and why it ends there."""

    lowest: float
    highest: float
    """Radians or lengths."""
    full: bool
    """Whether the drive turns fully."""
    stops: tuple[SpatialStop | None, SpatialStop | None]
    """Where it ends below and above; None where it was not followed farther: a slide to three sizes of the linkage."""
    linkage: SpatialLinkage = field(repr=False)
    """The linkage that is driven."""
    drive: int = 0
    """The number of the drive; all others rest."""

    def inside(self, count: int, share: float = 1e-3) -> Reals:
        """Values evenly from end to end, ends that are stops left out by a share of the range."""
        gap = share * (self.highest - self.lowest)
        low, high = (0.0 if stop is None else gap for stop in self.stops)
        return np.linspace(self.lowest + low, self.highest - high, count)

    def explain(self, lang: str = "en") -> str:
        """How far the drive goes and why it ends there: lines in English or German (``de``)."""
        return "\n".join(line.in_language(lang) for line in self.lines())

    def lines(self) -> Iterator[Message]:
        """What `explain` says, in any language."""
        mechanism = self.linkage.mechanism
        drive = mechanism.drives[self.drive]
        title = joined([mechanism.chain.joint_title(drive.joint)])
        if self.full:
            yield _TURNS.filled(drive=title)
            return
        low, high = (value_message(self.linkage, value, drive.turning) for value in (self.lowest, self.highest))
        yield _BETWEEN.filled(drive=title, low=low, high=high)
        yield from (_OPEN if stop is None else stop.message for stop in self.stops)


def value_message(linkage: SpatialLinkage, value: float, turns: bool) -> Message:
    """An angle in degrees to four digits, or a length to six with its unit."""
    if turns:
        return message("{angle:n}°", angle=round(degrees(value), 4) + 0.0)
    length = 0.0 if abs(value) < _STILL * linkage.size else float(f"{value:.6g}")
    return message("{length:n} {unit}", length=length, unit=linkage.unit)


@overload
def drive_range(
    linkage: SpatialLike | SpatialCircuit, *, branch: Branch = None, drive: str | int | None = None
) -> SpatialRange: ...


@overload
def drive_range(
    linkage: LinkageLike | Circuit, *, branch: Branch = None, drive: str | int | None = None
) -> DriveRange: ...


@door_that_raises(LinkageError)
def drive_range(
    linkage: LinkageLike | SpatialLike | Circuit | SpatialCircuit,
    *,
    branch: Branch = None,
    drive: str | int | None = None,
) -> DriveRange | SpatialRange:
    """How far the drive can be moved, both ways, without passing a limit.

    Args:
        linkage: with one drive, in the plane or in space, or lengths that make one such as a `FourBar` or an `RSSR`; or
            its `Circuit`. In space the drive is followed from the reference pose.
        branch: the assembly mode, as for `move`; not with a circuit and not in space.
        drive: which one of several drives in space is moved while the others rest, by its joint or its number.

    Returns:
        `DriveRange`: ``full``, or the limits ``lowest`` and ``highest`` in radians or the linkage's unit. In space
        `SpatialRange`, with the reason of each limit.

    Raises:
        LinkageError: a linkage that cannot be assembled, several drives, a circuit together with a branch.

    Cost:
        That of the circuit, 10 to 200 ms; in space some milliseconds.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> drive_range(FourBar(25, 70, 40, 70).linkage()).full
        True
        >>> from gruebler.mechanics.space import SphericalFourBar
        >>> print(drive_range(SphericalFourBar(0.9, 0.8, 0.7, 1.0).linkage(0.5)).explain().splitlines()[0])
        The drive R(frame-crank) moves from ...° to ...°.

    See Also:
        `circuit`, `rotatability`, `measures`

    Theory:
        docs/theory/circuits.md
    """
    placed = without_circuit(linkage, branch)
    if not isinstance(placed, SpatialLinkage):
        if drive is not None:
            raise LinkageError("a drive is chosen of linkages in space only; in the plane a range needs one drive")
        return circuit_ranges.drive_range(placed, branch=branch)
    return spatial_range(placed, None if drive is None else _drive_number(placed, drive))


def without_circuit(
    linkage: LinkageLike | SpatialLike | Circuit | SpatialCircuit, branch: Branch
) -> Linkage | Circuit | SpatialLinkage:
    """What is asked about: the linkage of a circuit in space, without a branch, which its reference pose decides."""
    placed: Linkage | Circuit | SpatialLinkage | SpatialCircuit = linkage_made(linkage)
    if isinstance(placed, SpatialCircuit):
        placed = placed.linkage
    if isinstance(placed, SpatialLinkage) and branch is not None:
        raise LinkageError("a linkage given by its reference pose has no assembly mode to choose")
    return placed


def _drive_number(linkage: SpatialLinkage, drive: str | int) -> int:
    """Of a drive by its joint or its number among the drives."""
    names = linkage.mechanism.drive_names()
    number = drive if isinstance(drive, int) else names.index(drive) if drive in names else -1
    if not 0 <= number < len(names):
        raise LinkageError("there is no drive {drive!r}; the drives are {drives}", drive=drive, drives=", ".join(names))
    return number


def spatial_range(linkage: SpatialLinkage, drive: int | None = None) -> SpatialRange:
    """The range of the one drive of a linkage, or of one of several, followed from its reference pose both ways.

    Raises `LinkageError` for a linkage without drives or with several of which none is given, or whose drives do not
    fix the motion.
    """
    drives = linkage.mechanism.drives
    if not drives or (len(drives) > 1 and drive is None):
        raise LinkageError(RANGE_OF_ONE.filled(count=len(drives), drives=", ".join(linkage.mechanism.drive_names())))
    number = drive or 0
    turning = drives[number].turning
    most = 2 * pi if turning else 3 * linkage.size
    steps = np.zeros((_ROWS + 1, len(drives)))
    steps[:, number] = np.linspace(0.0, most, _ROWS + 1)
    still = np.zeros((0, *steps.shape))
    up = moved(setting(linkage), steps, still)
    if turning and up.complete:
        return SpatialRange(lowest=0.0, highest=2 * pi, full=True, stops=(None, None), linkage=linkage, drive=number)
    if up.stop is not None and up.stop.reason == "isolated":
        raise LinkageError("{reason}", reason=up.stop.message)
    down = moved(setting(linkage), -steps, still)
    low, high = (
        side * most if motion.stop is None else motion.stop.drives[number] for side, motion in ((-1.0, down), (1.0, up))
    )
    return SpatialRange(lowest=low, highest=high, full=False, stops=(down.stop, up.stop), linkage=linkage, drive=number)


def followed(linkage: SpatialLinkage, values: Reals, order: int = 0, speed: ArrayLike = 1.0) -> SpatialMotion:
    """The motion over values of the drives, (rows, drives), reached from the reference pose; only those rows.

    Derivatives up to the order are those by the drives' common time, in which each has the speed, a number for all or
    for each.

    Raises `LinkageError` if one of them cannot be reached.
    """
    path = np.concatenate([np.zeros((1, values.shape[1])), values])
    rates = np.zeros((order, *path.shape))
    rates[:1] = speed
    motion = moved(setting(linkage), path, rates)
    if motion.stop is not None:
        raise LinkageError("{reason}", reason=motion.stop.message)
    return replace(
        motion,
        drives=motion.drives[1:],
        poses=motion.poses[:, 1:],
        unknowns={key: each[:, 1:] for key, each in motion.unknowns.items()},
        derivatives=motion.derivatives[1:],
        passed=tuple(row - 1 for row in motion.passed if row),
        changes=tuple(row - 1 for row in motion.changes if row),
    )
