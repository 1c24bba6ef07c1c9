"""The mobility of a chain with all its evidence: the count, whether it is true, and what is wrong where."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from gruebler.chain import Chain
from gruebler.mobility.circuits import Overconstrained, overconstrained
from gruebler.mobility.counting import Count, count_freedoms
from gruebler.mobility.idle import IdleFreedom, idle_freedoms
from gruebler.mobility.rank import generic
from gruebler.notebook import Brief

__all__ = ["MobilityReport", "Verdict", "mobility_report"]


class Verdict(StrEnum):
    """What the evidence amounts to. The first that fits, from the top."""

    OVERCONSTRAINED = "overconstrained"
    """Some subchain holds more constraints than it needs, whatever the count of the whole says."""
    RIGID = "rigid"
    """Nothing moves, and nothing is redundant: F = 0."""
    PARTLY_RIGID = "partly_rigid"
    """The chain moves, but some of its links do not move against each other."""
    CONSTRAINED = "constrained"
    """F = 1: one drive moves everything."""
    MOVABLE = "movable"
    """F > 1: as many drives are needed."""


@dataclass(frozen=True, repr=False)
class MobilityReport(Brief):
    """What `mobility_report` found. `explain` says it in words."""

    chain: Chain
    frame: str
    count: Count
    generic: int
    """Mobility that almost all sizes give."""
    redundancy: int
    """Redundant constraints in all: generic mobility minus the count with the space's own b."""
    exact: bool
    """Whether the generic mobility is proved; otherwise `error_bound` says how unlikely an error is."""
    error_bound: float
    overconstrained: tuple[Overconstrained, ...]
    rigid_clusters: tuple[tuple[str, ...], ...]
    """The maximal sets of two or more links that do not move against each other."""
    immobile_joints: tuple[int, ...]
    idle_freedoms: tuple[IdleFreedom, ...]

    @property
    def counted(self) -> int:
        """F by the formula."""
        return self.count.value

    @property
    def verdict(self) -> Verdict:
        """What the evidence amounts to."""
        if self.redundancy:
            return Verdict.OVERCONSTRAINED
        if self.generic == 0:
            return Verdict.RIGID
        if self.rigid_clusters:
            return Verdict.PARTLY_RIGID
        return Verdict.CONSTRAINED if self.generic == 1 else Verdict.MOVABLE

    def explain(self, lang: str = "en") -> str:
        """The report as a text of a few lines, in English (``en``) or German (``de``)."""
        from gruebler.mobility.messages import explain_mobility

        return explain_mobility(self, lang)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`; the joints as texts that tell one from another."""
        names = self.chain.joint_names()
        return {
            "links": list(self.chain.links),
            "joints": list(names),
            "space": str(self.chain.space),
            "counted": self.counted,
            "generic": self.generic,
            "verdict": str(self.verdict),
            "exact": self.exact,
            "overconstrained": [
                {
                    "links": list(part.links),
                    "joints": [names[k] for k in part.joints],
                    "redundancy": part.redundancy,
                    "minimal": part.minimal,
                    "mended_by_removing": [names[k] for k in part.mended_by_removing],
                    "mended_by_freeing": [names[k] for k in part.mended_by_freeing],
                }
                for part in self.overconstrained
            ],
            "rigid_clusters": [list(cluster) for cluster in self.rigid_clusters],
            "immobile_joints": [names[k] for k in self.immobile_joints],
            "idle_freedoms": [
                {"links": list(idle.links), "freedoms": idle.freedoms, "when": str(idle.when)}
                for idle in self.idle_freedoms
            ],
        }


def mobility_report(
    chain: Chain, *, b: int | None = None, frame: str | None = None, large: bool = False
) -> MobilityReport:
    """Count the freedoms of a chain and check the count.

    Args:
        chain: any chain.
        b: the motions of a free link for the count, if the chain moves in a smaller group than its space.
        frame: the link that stands still; the first one if left out. It matters only for rollers
            (`gruebler.mobility.idle`): mobility does not depend on it.
        large: begin even what takes more than about a minute or 1 GB, instead of raising `TooLargeError`.

    Cost: see `gruebler.mobility.rank.generic`.

    >>> vee = Chain.parse("R(frame-crank) R(crank-conrod1-conrod2) R(conrod1-piston1) R(conrod2-piston2) "
    ...                   "P(frame-piston1) P(frame-piston2)")
    >>> report = mobility_report(vee)
    >>> report.counted, report.generic, str(report.verdict)
    (1, 1, 'constrained')
    """
    still = chain.links[0] if frame is None else frame
    chain.index(still)
    number = count_freedoms(chain, b)
    rank = generic(chain, large=large)
    clusters = rank.clusters
    member = {link: k for k, cluster in enumerate(clusters) for link in cluster}
    immobile = tuple(k for k, joint in enumerate(chain.joints) if len({member[link] for link in joint.links}) == 1)
    return MobilityReport(
        chain,
        still,
        number,
        rank.mobility,
        rank.redundancy,
        rank.exact,
        rank.error_bound,
        overconstrained(rank),
        tuple(cluster for cluster in clusters if len(cluster) > 1),
        immobile,
        idle_freedoms(rank, still),
    )
