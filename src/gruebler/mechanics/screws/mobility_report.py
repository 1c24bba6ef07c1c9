"""Mobility with dimensions: formula, generic count, instant and finite mobility side by side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np

from gruebler.base.arrays import compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, message
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage, linkage_made
from gruebler.mechanics.screws.closed_poses import closed_pose
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.finite_mobility import FiniteMobility, finite_mobility
from gruebler.mechanics.screws.idle import idle_parts
from gruebler.mechanics.screws.instant_mobility import InstantMobility, instant_mobility
from gruebler.mechanics.screws.joint_geometry import Reason
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.reasons import group_count, reasons
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mobility import MobilityReport, mobility_report
from gruebler.structure.mobility.idle import IdleFreedom

_FINITE = {
    "rigid": message("Finite: 0, for nothing moves even for an instant."),
    "regular": message("Finite: {finite}, proved, for no constraint is redundant (implicit function theorem)."),
    "blurred": message(
        "Finite: not decided, perhaps {finite}. The smallest singular value that counts is no larger than the error "
        "of the pose makes it: there may be one velocity more, and none of them a motion."
    ),
    "followed": message(
        "Finite: {finite}. Every velocity goes on as a motion; the joints stay closed as far as it was followed, up "
        "to {reach:g} (radians; lengths in sizes of the linkage)."
    ),
    "stressed": message(
        "Finite: 0. The linkage is only shaky: along every velocity the redundant constraints open "
        "with the square of the displacement ({open:.1e} of the size after {reach:g})."
    ),
    "shaky": message(
        "Finite: 0. It is only shaky: along every velocity that was followed the joints open, by about the power "
        "{order} of the displacement ({open:.1e} of the size after {reach:g})."
    ),
    "branching": message("Finite: {finite}. Only some of the velocities belong to motions; {branches}."),
    "undecided": message(
        "Finite: not decided. The velocities could not be followed, for the pose is all but singular in another way."
    ),
}
_REASONS = {
    "group_screw": message("all joints have the same screw; with b = {b} the count gives {count}."),
    "group_translations": message("no link ever turns; with b = {b} the count gives {count}."),
    "group_cylinder": message(
        "everything turns about one line and shifts along it; with b = {b} the count gives {count}."
    ),
    "group_plane": message(
        "all turning axes are parallel and all slides at right angles to them: plane motion; with b = {b} the "
        "count gives {count}."
    ),
    "group_screws": message(
        "all axes are parallel and all screws have the same pitch: plane motion with a shift along the axes that "
        "goes with the turn; with b = {b} the count gives {count}."
    ),
    "group_sphere": message("all axes pass through one point: spherical motion; with b = {b} the count gives {count}."),
    "group_parallel": message("all turning axes are parallel; with b = {b} the count gives {count}."),
    "bennett": message(
        "Bennett's linkage: opposite links are equal, and length and sine of the twist have the same ratio on all."
    ),
    "line_symmetric": message("a half-turn takes the loop of six joints to itself: Bricard's line-symmetric linkage."),
    "plane_symmetric": message("a mirror takes the loop of six joints to itself: Bricard's plane-symmetric linkage."),
    "sarrus": message(
        "Sarrus's linkage: three parallel axes and three others, parallel too; each three keep the plate parallel to "
        "itself."
    ),
    "schatz": message(
        "Schatz's linkage: neighbouring axes are at right angles but for two parallel shafts, three links are of one "
        "length, and the shafts are √3 times as far apart."
    ),
    "cardan": message(
        "the centres of both cross joints lie on the axes of their bearings and stand still, so that {links} only "
        "turns about the line through them."
    ),
    "cranks": message(
        "{links} are {number} equal and parallel cranks between {first} and {second}; two of them would suffice."
    ),
    "copies": message(
        "between {first} and {second} the same guidance is there {number} times, joint for joint: {links}."
    ),
    "planets": message(
        "{links} are equal wheels on one carrier that mesh with the same wheels; one of them would suffice."
    ),
    "centres": message(
        "{first} and {second} touch on the line of their centres, where their bearings on {links} already hold the "
        "distance."
    ),
    "locking": message(
        "the normals of {number} contacts of {first} with {second} pass through the bearing of {first} on {links}: "
        "they hold {second} and let {first} turn."
    ),
    "parallel": message(
        "{links} are {number} bars between {first} and {second} that are parallel in this pose, but not equal."
    ),
    "concurrent": message(
        "{links} are {number} bars between {first} and {second} whose lines pass through one point in this pose."
    ),
    "coaxial": message("the axes of {joints} coincide."),
    "line": message("the joints {joints} lie on one line: a stretched or folded position."),
}


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Freedoms:
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
        """What moves for itself alone: whatever the sizes, or with these dimensions (`screws.idle`)."""
        return idle_parts(self.instant, self.report.idle_freedoms)

    @property
    def useful(self) -> int:
        """The finite mobility without idle freedoms; 0 where not even these were found to be motions."""
        return max(self.mobility - self.idle, 0)

    def explain(self, lang: str = "en") -> str:
        """The report as a text of a few lines, in English (``en``) or German (``de``).

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(freedoms(FourBar(25, 70, 40, 70).linkage(), at=1.0).explain())
        Mobility: counted 1, generic 1, instant 1, finite 1.
        Count: F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1
        Instant: 8 constraints of rank 8 on 9 velocities leave 1 at this pose. Singular values against the largest: the
        smallest that counts is 0.12, none counts as zero (tolerance 10⁻⁸).
        No constraint is redundant.
        Finite: 1, proved, for no constraint is redundant (implicit function theorem).
        """
        names = _joint_names(self, lang)
        lines = [_mobilities(self), *_instant(self, names), _finite(self), *_idle(self), *_reasons(self, names)]
        return "\n".join(line.in_language(lang) for line in lines)

    def summary(self, lang: str = "en") -> str:
        """The four numbers in a line, what is idle, and the reasons, a line each.

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> print(freedoms(FourBar(25, 70, 40, 70).linkage()).summary("de"))
        Laufgrad: gezählt 1, generisch 1, momentan 1, endlich 1.
        """
        lines = [_mobilities(self), *_idle(self), *_reasons(self, _joint_names(self, lang))]
        return "\n".join(line.in_language(lang) for line in lines)

    def why(self, lang: str = "en") -> list[str]:
        """The geometric reasons for more mobility than almost all sizes give, a line each.

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> freedoms(FourBar(25, 70, 40, 70).linkage()).why()
        []
        """
        return [line.in_language(lang) for line in _reasons(self, _joint_names(self, lang))]

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`."""
        names, instant = self.report.chain.joint_names(), self.instant
        return {
            "joints": list(names),
            "space": str(self.report.chain.space),
            **plain(self, "counted generic"),
            "instant": plain(instant, "mobility rank constraints redundancy tolerance")
            | {
                "singular_values": instant.values.tolist(),
                "redundant": {names[k]: many for k, many in instant.redundant.items()},
                "immobile_joints": [names[k] for k in instant.immobile],
            },
            "finite": plain(self, "mobility useful") | plain(self.finite, "evidence reach order open ways"),
            "reasons": [plain(r, "kind links joints", units={"joints": names.__getitem__}) for r in self.reasons],
        }


@door_that_raises(LinkageError)
def freedoms(
    linkage: LinkageLike | SpatialLike,
    *,
    branch: Branch = None,
    at: float | Sequence[float] | None = None,
    tolerance: float = 1e-8,
) -> Freedoms:
    """Mobility with dimensions at a pose, and what of it is a motion.

    Args:
        linkage: with its sizes.
        branch: the assembly mode, as for `move`.
        at: drive values, in radians and the unit; of a `SpatialLinkage` from the reference pose. Without them the pose
            is the reference pose, or, where there is none, one that is regular if one is found.
        tolerance: singular values below that times the largest count as zero, and joints that open by less than a
            hundredth of that times the way as closed.

    Returns:
        `Freedoms`: ``counted``, ``generic``, ``instant`` and ``finite`` mobility side by side, ``mobility`` of what
        really moves.

    Raises:
        LinkageError: no such pose, or a tolerance that is not a positive number below 0.01.

    Cost:
        A few milliseconds for ten links; up to a second where motions branch.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> found = freedoms(FourBar(25, 70, 40, 70).linkage())
        >>> found.counted, found.generic, found.instant.mobility, found.mobility
        (1, 1, 1, 1)
        >>> stretched = freedoms(FourBar(2, 5, 2, 5).linkage(), at=0.0)  # a parallelogram with its cranks on one line
        >>> stretched.instant.mobility, stretched.mobility, stretched.finite.ways
        (2, 1, 2)

    See Also:
        `mobility_report`, `circuit`, `SpatialLinkage`

    Theory:
        docs/theory/freedoms.md
    """
    linkage = linkage_made(linkage)
    if not isinstance(linkage, SpatialLinkage):
        linkage = as_linkage(linkage)
    if isinstance(tolerance, bool) or not isinstance(tolerance, int | float) or not 0 < tolerance < 0.01:
        raise LinkageError("the tolerance is a number between 0 and 0.01, not {tolerance!r}", tolerance=tolerance)
    closing, pose = closed_pose(linkage, _values(at), branch)
    instant = instant_mobility(closing, pose, float(tolerance))
    report = mobility_report(linkage.mechanism.chain, frame=linkage.mechanism.frame)
    followed = finite_mobility(instant)
    more = max(instant.mobility, followed.mobility) > report.generic
    return Freedoms(
        linkage=linkage, report=report, instant=instant, finite=followed, reasons=reasons(instant) if more else ()
    )


def _values(at: float | Sequence[float] | None) -> list[float] | None:
    if at is None:
        return None
    values = list(at) if isinstance(at, Sequence | np.ndarray) and not isinstance(at, str) else [at]
    for value in values:
        if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not isfinite(value):
            raise LinkageError("a drive value is a finite number, not {value!r}", value=value)
    return [float(value) for value in values]


def _joint_names(freedoms: Freedoms, lang: str) -> tuple[str, ...]:
    return freedoms.report.chain.joint_names(Alphabet.of_language(lang))


def _mobilities(freedoms: Freedoms) -> Message:
    return message(
        "Mobility: counted {counted}, generic {generic}, instant {instant}, finite {finite}.",
        counted=freedoms.counted,
        generic=freedoms.generic,
        instant=freedoms.instant.mobility,
        finite=freedoms.mobility,
    )


def _instant(freedoms: Freedoms, names: Sequence[str]) -> Iterator[Message]:
    yield message("Count: {formula}", formula=freedoms.report.count.formula())
    instant = freedoms.instant
    above, below = instant.gap
    if instant.rank < len(instant.values):
        next_value = message("the next is {below:.1e}", below=below)
    else:
        next_value = message("none counts as zero")
    yield message(
        "Instant: {constraints} constraints of rank {rank} on {unknowns} velocities leave {mobility} at this pose. "
        "Singular values against the largest: the smallest that counts is {above:.1e}, {next_value} (tolerance "
        "{tolerance:.0e}).",
        constraints=instant.constraints,
        rank=instant.rank,
        unknowns=instant.closing.unknowns,
        mobility=instant.mobility,
        above=above,
        next_value=next_value,
        tolerance=instant.tolerance,
    )
    if instant.redundancy:
        joints = ", ".join(f"{names[k]} ({count})" for k, count in instant.redundant.items())
        yield message(
            "Redundant at this pose: {count}. Joints whose constraints repeat others (how many): {joints}.",
            count=instant.redundancy,
            joints=joints,
        )
    else:
        yield message("No constraint is redundant.")
    if instant.mobility and instant.immobile:
        yield message("Joints at rest: {joints}.", joints=", ".join(names[k] for k in instant.immobile))


def _finite(freedoms: Freedoms) -> Message:
    followed = freedoms.finite
    if followed.ways > 1:
        branches = message("{count} branches meet in this pose", count=followed.ways)
    else:
        branches = message("the pose is singular")
    return _FINITE[followed.evidence].filled(
        finite=followed.mobility,
        reach=followed.reach,
        order=followed.order,
        open=followed.open,
        branches=branches,
    )


def _idle(freedoms: Freedoms) -> Iterator[Message]:
    spinning = [" + ".join(idle.links) for idle in freedoms.idle_parts]
    if len(spinning) == 1:
        text = message("Idle: {links} spins for itself alone; without idle freedoms the mobility is {useful}.")
    else:
        text = message("Idle: {links} spin for themselves alone; without idle freedoms the mobility is {useful}.")
    if spinning:
        yield text.filled(links=", ".join(spinning), useful=freedoms.useful)


def _reasons(freedoms: Freedoms, names: Sequence[str]) -> Iterator[Message]:
    for reason in freedoms.reasons:
        yield message("Reason: {reason}", reason=_reason_message(freedoms, reason, names))
    if freedoms.mobility > freedoms.generic and not freedoms.reasons:
        yield message("Reason: special dimensions; no known geometric reason was recognised.")


def _reason_message(freedoms: Freedoms, reason: Reason, names: Sequence[str]) -> Message:
    """A reason as a sentence; joints by these names."""
    ends = 2 if reason.kind in ("cranks", "copies", "parallel", "concurrent", "centres", "locking") else 0
    return _REASONS[reason.kind].filled(
        first=reason.links[0] if ends else "",
        second=reason.links[1] if ends else "",
        links=", ".join(reason.links[ends:]),
        b=reason.number,
        number=reason.number,
        joints=", ".join(names[k] for k in reason.joints),
        count=group_count(reason, freedoms.instant) if reason.kind.startswith("group") else "",
    )
