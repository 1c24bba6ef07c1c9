"""Mobility with dimensions in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from gruebler.chain.pairs import Alphabet
from gruebler.screws.joint_geometry import Reason
from gruebler.screws.reasons import group_count
from gruebler.text import Message, message

if TYPE_CHECKING:
    from gruebler.screws.mobility_report import Freedoms

__all__ = ["explain_freedoms", "freedoms_summary", "reason_message"]

_FINITE = {
    "rigid": message("Finite: 0, for nothing moves even for an instant."),
    "regular": message("Finite: {finite}, proved, for no constraint is redundant (theorem of implicit functions)."),
    "blurred": message(
        "Finite: not decided, perhaps {finite}. The smallest singular value that counts is no larger than the error "
        "of the pose makes it: there may be one velocity more, and none of them a motion."
    ),
    "followed": message(
        "Finite: {finite}. Every velocity goes on as a motion; the joints stay closed as far as it was followed, up "
        "to {reach:g} (radians; lengths in sizes of the linkage)."
    ),
    "stressed": message(
        "Finite: 0. It is only shaky: the redundant constraints open by the square of the displacement, whichever "
        "velocity is followed ({open:.1e} of the size after {reach:g})."
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
    "cardan": message(
        "the centres of both cross joints lie on the axes of their bearings and stand still, so that {links} only "
        "turns about the line through them."
    ),
    "cranks": message(
        "{links} are {number} equal and parallel cranks between {first} and {second}; two of them say all."
    ),
    "copies": message(
        "between {first} and {second} the same guidance is there {number} times, joint for joint: {links}."
    ),
    "planets": message("{links} are equal wheels on one carrier that mesh with the same wheels; one of them says all."),
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


def explain_freedoms(freedoms: Freedoms, lang: str = "en") -> str:
    """The whole report as lines of text.

    >>> from gruebler.screws import freedoms
    >>> from gruebler.fourbar import FourBar
    >>> print(explain_freedoms(freedoms(FourBar(25, 70, 40, 70).linkage(), at=1.0)))
    Mobility: counted 1, generic 1, instant 1, finite 1.
    Count: F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1
    Instant: 8 constraints of rank 8 on 9 velocities leave 1 at this pose. Singular values against the largest: the
    smallest that counts is 1.2e-01, none counts as zero (tolerance 1e-08).
    No constraint is redundant.
    Finite: 1, proved, for no constraint is redundant (theorem of implicit functions).
    """
    names = _joint_names(freedoms, lang)
    lines = [_mobilities(freedoms), *_instant(freedoms, names), *_finite(freedoms), *_reasons(freedoms, names)]
    return "\n".join(line.in_language(lang) for line in lines)


def freedoms_summary(freedoms: Freedoms, lang: str = "en") -> str:
    """The four numbers and the reasons.

    >>> from gruebler.screws import freedoms
    >>> from gruebler.fourbar import FourBar
    >>> print(freedoms_summary(freedoms(FourBar(25, 70, 40, 70).linkage()), "de"))
    Laufgrad: gezählt 1, generisch 1, momentan 1, endlich 1.
    """
    lines = [_mobilities(freedoms), *_reasons(freedoms, _joint_names(freedoms, lang))]
    return "\n".join(line.in_language(lang) for line in lines)


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
        "{tolerance:g}).",
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


def _finite(freedoms: Freedoms) -> Iterator[Message]:
    followed = freedoms.finite
    if followed.ways > 1:
        branches = message("{count} branches meet in this pose", count=followed.ways)
    else:
        branches = message("the pose is singular")
    yield _FINITE[followed.evidence].filled(
        finite=followed.mobility,
        reach=followed.reach,
        order=followed.order,
        open=followed.open,
        branches=branches,
    )
    spinning = [" + ".join(idle.links) for idle in freedoms.idle_parts]
    if len(spinning) == 1:
        text = message("Idle: {links} spins for itself alone; without idle freedoms the mobility is {useful}.")
    else:
        text = message("Idle: {links} spin for themselves alone; without idle freedoms the mobility is {useful}.")
    if spinning:
        yield text.filled(links=", ".join(spinning), useful=freedoms.useful)


def _reasons(freedoms: Freedoms, names: Sequence[str]) -> Iterator[Message]:
    for reason in freedoms.reasons:
        yield message("Reason: {reason}", reason=reason_message(freedoms, reason, names))
    if freedoms.mobility > freedoms.generic and not freedoms.reasons:
        yield message("Reason: special dimensions; no known geometric reason was recognised.")


def reason_message(freedoms: Freedoms, reason: Reason, names: Sequence[str]) -> Message:
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
