"""`rotatability` of every linkage: which links turn fully against each other, in the plane or in space."""

from __future__ import annotations

from typing import overload

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis import circuit_ranges
from gruebler.mechanics.analysis.circuit_ranges import Rotatability
from gruebler.mechanics.kinematics.circuits import Circuit
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.circuits import SpatialCircuit
from gruebler.mechanics.space.drive_ranges import without_circuit
from gruebler.mechanics.space.measuring import JointRange, measures


@overload
def rotatability(linkage: SpatialLike | SpatialCircuit, *, branch: Branch = None) -> tuple[JointRange, ...]: ...


@overload
def rotatability(linkage: LinkageLike | Circuit, *, branch: Branch = None) -> tuple[Rotatability, ...]: ...


@door_that_raises(LinkageError)
def rotatability(
    linkage: LinkageLike | SpatialLike | Circuit | SpatialCircuit, *, branch: Branch = None
) -> tuple[Rotatability, ...] | tuple[JointRange, ...]:
    """Each pair of neighbouring links: whether they turn fully against each other, and how far they move.

    They turn fully if there is a net turn over the closed circuit, or if the relative angle takes all values. The
    answer holds for one circuit: that of the branch, or of the linkage's reference pose.

    Args:
        linkage: with one drive, in the plane or in space, or lengths that make one; or a `Circuit`.
        branch: the assembly mode, as for `move`; not with a circuit and not in space.

    Returns:
        A tuple of `Rotatability`, one for each pair of neighbouring links: ``joint``, ``full``, ``range`` in radians.
        In space a tuple of `JointRange`, one for each freedom of a joint over the range of the drive.

    Raises:
        LinkageError: a linkage that cannot be assembled, several drives, a circuit together with a branch.

    Cost:
        That of the circuit, 10 to 200 ms; in space that of `measures`.

    Example:
        >>> from math import degrees
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> for row in rotatability(FourBar(25, 70, 40, 70).linkage()):
        ...     print(row.joint, row.full, round(degrees(row.range), 3))
        R(frame-crank) True 360.0
        R(crank-coupler) True 360.0
        R(coupler-rocker) False 79.846
        R(frame-rocker) False 79.846

    See Also:
        `circuit`, `motion_roles`, `drive_range`

    Theory:
        docs/theory/circuits.md
    """
    placed = without_circuit(linkage, branch)
    if isinstance(placed, SpatialLinkage):
        return measures(placed).joints
    return circuit_ranges.rotatability(placed, branch=branch)
