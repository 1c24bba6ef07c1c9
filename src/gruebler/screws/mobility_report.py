"""Mobility with dimensions: formula, generic count, instant and finite mobility side by side."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np

from gruebler.errors import LinkageError
from gruebler.linkages import Linkage
from gruebler.linkages.conversion import LinkageLike, as_linkage
from gruebler.mobility import MobilityReport, mobility_report
from gruebler.mobility.idle import IdleFreedom
from gruebler.notebook import Brief
from gruebler.screws.closed_poses import closed_pose
from gruebler.screws.finite_mobility import FiniteMobility, finite_mobility
from gruebler.screws.idle import idle_parts
from gruebler.screws.instant_mobility import InstantMobility, instant_mobility
from gruebler.screws.joint_geometry import Reason
from gruebler.screws.model import SpatialLinkage
from gruebler.screws.reasons import reasons

__all__ = ["Freedoms", "freedoms"]


@dataclass(frozen=True, eq=False, repr=False)
class Freedoms(Brief):
    """What `freedoms` found. `explain` says it in words."""

    linkage: Linkage | SpatialLinkage
    report: MobilityReport
    """The count and the generic mobility."""
    instant: InstantMobility
    finite: FiniteMobility
    reasons: tuple[Reason, ...]

    @property
    def counted(self) -> int:
        """F by the formula."""
        return self.report.counted

    @property
    def generic(self) -> int:
        """What almost all sizes give."""
        return self.report.generic

    @property
    def mobility(self) -> int:
        """What really moves: the finite mobility."""
        return self.finite.mobility

    @property
    def special(self) -> bool:
        """Whether the dimensions, or the pose, give another mobility than almost all sizes."""
        return not self.generic == self.instant.mobility == self.mobility

    @property
    def idle(self) -> int:
        """Freedoms that belong to one part alone, such as the spin of a rod between two balls."""
        return sum(idle.freedoms for idle in self.idle_parts)

    @cached_property
    def idle_parts(self) -> tuple[IdleFreedom, ...]:
        """What moves for itself alone: whatever the sizes, or with these dimensions (`gruebler.screws.idle`)."""
        return idle_parts(self.instant, self.report.idle_freedoms)

    @property
    def useful(self) -> int:
        """The finite mobility without idle freedoms; 0 where not even these were found to be motions."""
        return max(self.mobility - self.idle, 0)

    def explain(self, lang: str = "en") -> str:
        """The report as a text of a few lines, in English (``en``) or German (``de``)."""
        from gruebler.screws.messages import explain_freedoms

        return explain_freedoms(self, lang)

    def summary(self, lang: str = "en") -> str:
        """The four numbers in a line, and the reasons, a line each."""
        from gruebler.screws.messages import freedoms_summary

        return freedoms_summary(self, lang)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`."""
        names = self.report.chain.joint_names()
        instant, followed = self.instant, self.finite
        return {
            "joints": list(names),
            "space": str(self.report.chain.space),
            "counted": self.counted,
            "generic": self.generic,
            "instant": {
                "mobility": instant.mobility,
                "rank": instant.rank,
                "constraints": instant.constraints,
                "redundancy": instant.redundancy,
                "tolerance": instant.tolerance,
                "singular_values": instant.values.tolist(),
                "redundant": {names[k]: many for k, many in instant.redundant.items()},
                "immobile_joints": [names[k] for k in instant.immobile],
            },
            "finite": {
                "mobility": self.mobility,
                "useful": self.useful,
                "evidence": str(followed.evidence),
                "reach": followed.reach,
                "order": followed.order,
                "open": followed.open,
                "ways": followed.ways,
            },
            "reasons": [
                {"kind": r.kind, "links": list(r.links), "joints": [names[k] for k in r.joints]} for r in self.reasons
            ],
        }


def freedoms(
    linkage: LinkageLike | SpatialLinkage,
    *,
    at: float | Sequence[float] | None = None,
    branch: str | Iterable[str] | None = None,
    tolerance: float = 1e-8,
) -> Freedoms:
    """Mobility with dimensions at a pose, and what of it is a motion.

    Args:
        linkage: with its sizes.
        at: drive values, in radians and the unit; of a `SpatialLinkage` counted from home. Without them the pose is
            the home, or, where there is none, one that is regular if one is found.
        branch: the assembly mode, as for `move`.
        tolerance: singular values below that times the largest count as zero, and joints that open by less than a
            hundredth of that times the way as closed.

    Raises:
        LinkageError: no such pose, or a tolerance that is no positive number below 0.01.

    Cost: a few milliseconds for ten links; up to a second where motions branch.

    >>> from gruebler.fourbar import FourBar
    >>> found = freedoms(FourBar(25, 70, 40, 70).linkage())
    >>> found.counted, found.generic, found.instant.mobility, found.mobility
    (1, 1, 1, 1)
    >>> stretched = freedoms(FourBar(2, 5, 2, 5).linkage(), at=0.0)  # a parallelogram with its cranks on one line
    >>> stretched.instant.mobility, stretched.mobility, stretched.finite.ways
    (2, 1, 2)
    """
    if not isinstance(linkage, SpatialLinkage):
        linkage = as_linkage(linkage)
    if isinstance(tolerance, bool) or not isinstance(tolerance, int | float) or not 0 < tolerance < 0.01:
        raise LinkageError("the tolerance is a number between 0 and 0.01, not {tolerance!r}", tolerance=tolerance)
    closing, pose = closed_pose(linkage, _values(at), branch)
    instant = instant_mobility(closing, pose, float(tolerance))
    report = mobility_report(linkage.mechanism.chain, frame=linkage.mechanism.frame)
    followed = finite_mobility(instant)
    more = max(instant.mobility, followed.mobility) > report.generic
    return Freedoms(linkage, report, instant, followed, reasons(instant) if more else ())


def _values(at: float | Sequence[float] | None) -> list[float] | None:
    if at is None:
        return None
    values = list(at) if isinstance(at, Sequence | np.ndarray) and not isinstance(at, str) else [at]
    for value in values:
        if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not isfinite(value):
            raise LinkageError("a drive value is a finite number, not {value!r}", value=value)
    return [float(value) for value in values]
