"""The five dyads as rows: how the kernel solves each, and by which side of what its assembly modes are told apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from gruebler.mechanics.kinematics.kernel_records import PRP, RPP, RPR, RRP, RRR


class DyadJoint(NamedTuple):
    """A joint of a dyad in a position: its point, and the direction of its line."""

    point: complex
    line: complex


Side = Callable[[DyadJoint, DyadJoint, DyadJoint], float]
"""Of the first outer, the inner and the second outer joint: positive in one assembly mode, negative in the other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DyadForm:
    """A kind of dyad."""

    code: int
    """What the kernel calls it."""
    side: Side | None = None
    """What tells its two assembly modes apart; None if it has one only."""
    root_is_distance: bool = False
    """Whether what the kernel takes a root of is a distance in parts of the size, and no sine."""


def _side_of_line(first: DyadJoint, inner: DyadJoint, second: DyadJoint) -> float:
    return ((second.point - first.point).conjugate() * (inner.point - first.point)).imag


def _along_outer_slide(first: DyadJoint, inner: DyadJoint, second: DyadJoint) -> float:
    return (second.line.conjugate() * (inner.point - first.point)).real


def _along_inner_slide(first: DyadJoint, inner: DyadJoint, second: DyadJoint) -> float:
    return (inner.line.conjugate() * (second.point - first.point)).real


DYADS: dict[tuple[bool, ...], DyadForm] = {
    (False, False, False): DyadForm(code=RRR, side=_side_of_line),
    (False, False, True): DyadForm(code=RRP, side=_along_outer_slide),
    (False, True, False): DyadForm(code=RPR, side=_along_inner_slide, root_is_distance=True),
    (True, False, True): DyadForm(code=PRP),
    (False, True, True): DyadForm(code=RPP),
}
"""By whether the first outer, the inner and the second outer joint slide; three that slide are not rigid."""
