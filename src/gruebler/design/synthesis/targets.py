"""What is to be met: quantities of a pose, and the values that they are to have at each target."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.design.synthesis.target_orders import Ranks, TargetOrder
from gruebler.design.synthesis.tasks import MOST_POINTS, PathTask, PositionTask
from gruebler.mechanics.kinematics import Poses
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.linkages import Linkage


@dataclass(frozen=True, slots=True)
class Probe:
    """A complex quantity of a pose: a point, or the direction of a link times a length."""

    point: str = ""
    """The named point; empty for a direction."""
    link: str = ""
    joint: int = -1
    """A sliding joint whose travel is looked at."""
    length: float = 1.0

    def value(self, poses: Poses, order: int) -> Complexes:
        """It or its derivative by the arc; (rows,)."""
        if self.point:
            return poses.complex_point(self.point, order=order)
        if self.joint >= 0:
            return poses.displacement(self.joint, order=order).astype(np.complex128)
        value: Complexes = self.length * np.exp(1j * poses.angle(self.link)) * (1j * poses.angle(self.link, 1)) ** order
        return value

    def of_motion(self, motion: Motion) -> Complexes:
        """Its value in each row of a motion."""
        if self.point:
            return motion.complex_point(self.point)
        if self.joint >= 0:
            return motion.displacement(self.joint).astype(np.complex128)
        value: Complexes = self.length * np.exp(1j * motion.angle(self.link))
        return value


class GuidedCurve(Enum):
    """Whether targets are places along a curve, so that what lies between two of them counts, too."""

    NONE = "none"
    OPEN = "open"
    """From the first to the last; the first probe is the point that draws it."""
    CLOSED = "closed"
    """From the last on to the first, too."""

    @classmethod
    def of(cls, task: PathTask) -> GuidedCurve:
        """Along a whole curve; points that a four-bar meets exactly tell little of the way between them."""
        return cls.CLOSED if task.closed else cls.OPEN if len(task) > MOST_POINTS else cls.NONE


@compared_by_value
@dataclass(frozen=True, eq=False)
class Targets:
    """What is to be met: for each probe its value at each target; NaN where it is free."""

    probes: tuple[Probe, ...]
    values: Complexes
    """(targets, probes)"""
    size: float
    """The size of the task: errors are relative to it."""
    _: KW_ONLY
    curve: GuidedCurve = GuidedCurve.NONE
    allowed: Reals | None = None
    """(targets,) how far each may be missed, an unlimited one as the demands say; None if this holds for all."""
    ranks: Ranks = ()
    """The order in which they are to be passed, as of a task."""
    travel: float = np.inf
    """About how far slides go, which is compared with lengths; infinite where nothing is known of it."""
    there_and_back: bool = False
    """Whether the way back to the first target belongs to the task, as of dead centres."""

    @property
    def all_round(self) -> bool:
        """Whether the way goes on from the last target to the first one."""
        return self.there_and_back or self.curve is GuidedCurve.CLOSED

    @property
    def in_any_order(self) -> bool:
        """Whether their order is free."""
        return bool(self.ranks) and TargetOrder.of(self.ranks, len(self.values)).demands_nothing

    @property
    def order(self) -> TargetOrder:
        """That of their ranks; as they are listed, where it is free."""
        return TargetOrder.of(() if self.in_any_order else self.ranks, len(self.values))

    def gaps(self, poses: Poses, which: NDArray[np.int64]) -> tuple[Complexes, Complexes]:
        """How far each row is from its target, and the derivatives by the arc; (rows, probes)."""
        values = np.stack([probe.value(poses, 0) for probe in self.probes], axis=1) - self.values[which]
        rates = np.stack([probe.value(poses, 1) for probe in self.probes], axis=1)
        free = np.isnan(values)
        return np.where(free, 0, values), np.where(free, 0, rates)


def position_targets(point: str, link: str, origins: Complexes, angles: Iterable[float | None], size: float) -> Targets:
    """Positions of a link: the places of one of its points, and its angles where they are given."""
    turned = np.array([np.nan if a is None else size * np.exp(1j * a) for a in angles], np.complex128)
    return Targets((Probe(point), Probe(link=link, length=size)), np.stack([origins, turned], axis=1), size)


def body_targets(task: PositionTask, linkage: Linkage, link: str = "coupler") -> Targets:
    """The positions of the link that is the body, with its point P at the origin."""
    first = linkage.required_pose[link].angle
    targets = position_targets("P", link, task.origins, first + task.angles - task.angles[0], task.size)
    return replace(targets, ranks=task.order, travel=task.size if np.ptp(task.origins) else np.inf)


def point_targets(point: str, z: Complexes, size: float) -> Targets:
    """Places of a point."""
    return Targets((Probe(point),), z[:, None], size)
