"""What a machine has to do, in one value: a task, demands, which mechanisms may do it, and what is to be kept clear of.

docs/theory/synthesis-types.md.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import SynthesisError
from gruebler.base.immutable import settle
from gruebler.base.text import message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.tasks import DwellTask, Pair, PathTask, PositionTask, Task, number_rows, output_travels

LINKS = (4, 6)
"""Numbers of links of the mechanisms with one drive that are made: an even number, by Grübler's equation."""
COMMON_LINKS = ("crank", "frame")
"""Links that all mechanisms driven at the frame have."""
_USUAL = Demands()


@dataclass(frozen=True)
class Clearance:
    """An outline that the guided body carries, and one that stands still, which it has to stay clear of.

    Outlines are lines through points of the plane of the task; one that ends where it begins is closed. ``body`` is
    given as it lies at the first target. Only the lines count: an outline that encloses the other from the start does
    not touch it.

    >>> Clearance([(0, 0), (1, 0)], obstacle=[(0, 2), (1, 2)], distance=0.5).distance
    0.5
    """

    body: tuple[Pair, ...]
    _: KW_ONLY
    obstacle: tuple[Pair, ...]
    distance: float = 0.0
    """The least distance on the way through the targets."""

    def __post_init__(self) -> None:
        for name in ("body", "obstacle"):
            rows = number_rows(self, name, 2)
            if len(rows) < 2:
                raise SynthesisError(
                    "{name}: expected at least two points, but found {count}", name=name, count=len(rows)
                )
            settle(self, **{name: rows})
        if not 0 <= self.distance < np.inf:
            raise SynthesisError(
                "{key}: expected a length, at least 0, but found {found:g}", key="distance", found=self.distance
            )

    @property
    def outlines(self) -> tuple[Complexes, Complexes]:
        """Both as x + iy: that of the body at the first target, and the obstacle."""
        body, obstacle = (np.array([complex(*p) for p in line]) for line in (self.body, self.obstacle))
        return body, obstacle


@dataclass(frozen=True)
class Specification:
    """A task, what a design has to do besides, and which mechanisms are tried for it.

    ``links`` is the largest number of links, 4 or 6; ``sliding_joints`` the largest number of sliding joints, by
    default as many as the output needs: one for a travel, else none. Unless ``demands`` say otherwise, no length is
    more than 20 times another.

    >>> from gruebler.design.synthesis import DeadCentreTask
    >>> Specification(DeadCentreTask(stroke=50, time_ratio=1.2)).slides
    1
    """

    task: Task
    _: KW_ONLY
    demands: Demands = _USUAL
    links: int = 6
    sliding_joints: int | None = None
    clear: tuple[Clearance, ...] = ()

    def __post_init__(self) -> None:
        if isinstance(self.links, bool) or self.links not in LINKS:
            raise SynthesisError("{key}: expected 4 or 6, but found {found!r}", key="links", found=self.links)
        if isinstance(self.task, DwellTask) and self.links < max(LINKS):
            raise SynthesisError("{key}: an output rests by six links: links = 6", key="links")
        most = self.sliding_joints
        if most is not None and (isinstance(most, bool) or not isinstance(most, int) or most < self._needed):
            raise SynthesisError(
                "{key}: expected a whole number of at least {least}, but found {found!r}",
                key="sliding_joints",
                least=self._needed,
                found=most,
            )
        known = () if isinstance(self.task, DwellTask) else COMMON_LINKS
        own = [link for link, _ in self.demands.lengths if link not in known]
        if own and self.links > min(LINKS):
            raise SynthesisError(
                "{key}: only four-bars have a {link} of a given length: links = 4",
                key="lengths",
                link=message(own[0]),
            )
        settle(self, clear=tuple(self.clear))
        if self.clear and not self.guides:
            raise SynthesisError("{key}: only a body on positions or a path can keep clear of something", key="clear")

    @property
    def guides(self) -> bool:
        """Whether a body or a point is guided, rather than an output coordinated."""
        return isinstance(self.task, PositionTask | PathTask)

    @property
    def _needed(self) -> int:
        return int(output_travels(self.task))

    @property
    def slides(self) -> int:
        """The largest number of sliding joints."""
        return self._needed if self.sliding_joints is None else self.sliding_joints
