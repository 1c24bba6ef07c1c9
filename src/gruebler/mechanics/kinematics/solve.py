"""Moving a linkage: from rows of drive values to a `Motion`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import product
from operator import attrgetter

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import AssemblyWarning, LinkageError, unwarned, warn
from gruebler.mechanics.kinematics.branches import (
    Unassembled,
    labelled_groups,
    modes_of_group,
    part_at_fault,
    read_branch,
    starting_state,
)
from gruebler.mechanics.kinematics.change_point_rows import set_change_point_rows
from gruebler.mechanics.kinematics.drive_rows import drive_path, drive_speeds, row_of_values, warn_of_path
from gruebler.mechanics.kinematics.kernel_calls import SolvedRows, follow_path, run_rows, without_first
from gruebler.mechanics.kinematics.motion import Motion, Stop
from gruebler.mechanics.kinematics.openings import joint_openings
from gruebler.mechanics.kinematics.plan import Dyad, HigherGroup, Plan, plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose, check_reference, pose_at_reference
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch, branch_text
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.structure.assur import decompose
from gruebler.structure.assur.modes import modes_of_groups

_OPEN = 1e-9  # sizes and radians: redundant conditions that are open by more are not met
_DOUBTFUL = 1e-6  # a root below it may be wrong by as much as 1e-16 over it, and so may the pose
_REASONS = {1: "limit", 2: "singular", 3: "start"}


@lru_cache(maxsize=64)
def cached_plan(linkage: Linkage) -> Plan:
    """The plan of a linkage, kept for the next call."""
    return plan(linkage)


@door_that_raises(LinkageError)
def move(
    linkage: LinkageLike | Plan,
    drives: ArrayLike,
    *,
    branch: Branch = None,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
    order: int | None = None,
) -> Motion:
    """Move a linkage of the plane along a path of its drives: `gruebler.move`, which has the arguments, for the plane.

    >>> from gruebler.mechanics.kinematics import from_degrees
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> motion = move(FourBar(a=25, b=70, c=40, d=70).linkage(), from_degrees(0, 360, 1), speed=10)
    >>> len(motion), motion.complete, bool(motion.closure_error < 1e-13)
    (361, True, True)
    """
    plan = linkage if isinstance(linkage, Plan) else cached_plan(as_linkage(linkage))
    path = drive_path(plan, drives)
    warn_of_path(plan, path)
    speeds = drive_speeds(path, speed, acceleration, jerk, order)
    try:
        signs, unknowns = starting_configuration(plan, path[0], branch)
    except Unassembled as found:
        return _with_warning(_never(plan, path, len(speeds), found))
    from_reference = branch is None and plan.lower.reference_pose is not None
    rows = follow_path(plan, path, speeds, signs, unknowns)
    if from_reference and _is_doubtful_start(plan, rows):
        rows = max(_from_reference(plan, path, speeds), rows, key=attrgetter("reached"))
    motion = motion_from_rows(plan, path, rows)
    if motion.stop is not None and motion.stop.reason == "open" and from_reference:
        # the start may be a change point of the independent part: the way from the reference pose tells the way on
        motion = motion_from_rows(plan, path, _from_reference(plan, path, speeds))

    def start() -> ReferencePose:
        return _way_to(plan, path[0])[0] if from_reference else ReferencePose(path[0], signs, unknowns)

    at_change = set_change_point_rows(plan, motion, path, speeds, start)
    return _with_warning(replace(motion, **at_change._asdict(), speeds=speeds[:, : len(motion)]))


def _with_warning(motion: Motion) -> Motion:
    if not len(motion):
        warn(motion.reason, AssemblyWarning)
    return motion


move_quietly = unwarned(move)
"""`move` for the library itself: what it computes are radians, and a motion without rows is looked at."""


def starting_configuration(plan: Plan, first: Reals, branch: Branch) -> tuple[Reals, Reals]:
    """Signs of dyads and unknowns of larger groups at the first row."""
    if not plan.wheels and (branch is not None or plan.lower.reference_pose is None or not labelled_groups(plan)):
        return starting_state(plan, read_branch(plan, branch), first)
    _, rows = _way_to(plan, first, branch)
    if rows.reached and branch is None:
        check_reference(plan, rows.places[0, 0], rows.turns[0])
    if rows.reached < 2:
        raise Unassembled(part_at_fault(plan, rows.fault))
    return np.where(rows.roots[1] < 0, -1.0, 1.0), rows.unknowns[1]


def _way_to(plan: Plan, first: Reals, branch: Branch = None) -> tuple[ReferencePose, SolvedRows]:
    """The reference pose and the way from it to the first row: the shortest of those that drives can go.

    A drive that does not turn fully may have a range of more than half a turn; then the shorter way leads out of it.
    """
    begin = pose_at_reference(plan, first)
    if branch is not None:
        begin = begin._replace(signs=_other_signs(plan, begin.signs, read_branch(plan, branch)))

    def gone(start: Reals) -> SolvedRows:
        return run_rows(plan, np.array([start, first]), None, begin.signs, begin.unknowns)

    rows = gone(begin.drives)
    if rows.reached < 2 and not plan.wheels:
        turning = [drive.turning for drive in plan.linkage.mechanism.drives]
        behind = 2 * np.pi * np.where(first >= begin.drives, 1.0, -1.0)
        for others in sorted(product(*((0, 1) if turns else (0,) for turns in turning)), key=sum)[1:]:
            start = begin.drives + behind * np.array(others)
            other = gone(start)
            if other.reached == 2:
                return begin._replace(drives=start), other
    return begin, rows


def _other_signs(plan: Plan, signs: Reals, labels: tuple[str, ...]) -> Reals:
    """The signs of these labels, in a linkage with wheels: they may be new behind the last wheel."""
    changed = signs.copy()
    for part, label in zip(labelled_groups(plan), labels, strict=True):
        if isinstance(part, HigherGroup):
            raise LinkageError(
                "branch: a linkage with wheels and a larger group can be assembled as in its reference pose only"
            )
        changed[part.number] = -1.0 if label == "-" else 1.0
        behind = plan.parts[plan.parts.index(part) :]
        if changed[part.number] != signs[part.number] and any(
            isinstance(p, HigherGroup) and p.contacts for p in behind
        ):
            raise LinkageError(
                "branch: what wheels depend on is assembled as in the reference pose, where their teeth are known"
            )
    return changed


def _is_doubtful_start(plan: Plan, rows: SolvedRows) -> bool:
    """Whether the first row does not tell the way on: a change point of a dyad, a singular pose of a larger group."""
    if not rows.reached:
        return bool(plan.higher_groups)
    branching = plan.branching
    stuck = _REASONS.get(rows.status) == "singular" and rows.at == 0
    return stuck or bool((np.abs(rows.roots[0, branching]) < _DOUBTFUL).any())


def _from_reference(plan: Plan, path: Reals, speeds: Reals) -> SolvedRows:
    """A path that starts in a change point: what is placed there, and the way on, is known from the way to it."""
    begin, _ = _way_to(plan, path[0])
    path, speeds = np.concatenate([[begin.drives], path]), np.concatenate([speeds[:, :1], speeds], axis=1)
    return without_first(follow_path(plan, path, speeds, begin.signs, begin.unknowns))


def _never(plan: Plan, path: Reals, order: int, failure: Unassembled) -> Motion:
    """A motion without rows."""
    links = len(plan.lower.mechanism.chain.links)
    return Motion(
        linkage=plan.linkage,
        plan=plan,
        drives=path[:0],
        places=np.empty((order + 1, 0, links), np.complex128),
        turns=np.empty((0, links), np.complex128),
        rates=np.empty((order, 0, links)),
        whole=np.empty((0, links), np.int32),
        roots=np.empty((0, len(plan.dyads))),
        unknowns=np.empty((0, plan.unknowns)),
        stop=_stop(plan, 0.0, path[0], failure.part, "start"),
    )


def motion_from_rows(plan: Plan, path: Reals, rows: SolvedRows) -> Motion:
    """What the kernel wrote, as a motion."""
    stop = None
    if rows.status:
        last = min(int(rows.at), max(len(path) - 2, 0))
        drives = path[last]
        if len(path) > 1:
            drives = drives + (rows.at - last) * (path[last + 1] - drives)
        stop = _stop(plan, rows.at, drives, part_at_fault(plan, rows.fault), _REASONS[rows.status])
    motion = Motion(
        linkage=plan.linkage,
        plan=plan,
        drives=path[: rows.reached],
        places=rows.places,
        turns=rows.turns,
        rates=rows.rates,
        whole=rows.whole,
        roots=rows.roots,
        unknowns=rows.unknowns,
        stop=stop,
    )
    return _while_closed(motion) if plan.released else motion


def _while_closed(motion: Motion) -> Motion:
    """The rows up to the first one in which a redundant condition is not met.

    Next to a change point of the independent part its poses have lost digits; such rows are not judged.
    """
    plan = motion.plan
    branching = plan.branching
    sure = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) > _DOUBTFUL
    opens = {number: sure & (joint_openings(motion, motion.linkage, number) > _OPEN) for number in plan.released}
    first = [(int(np.argmax(rows)), number) for number, rows in opens.items() if rows.any()]
    if not first:
        return motion
    row, number = min(first)
    chain = motion.linkage.mechanism.chain
    stop = Stop(
        row=float(row),
        drives=tuple(motion.drives[row].tolist()),
        links=chain.joints[number].links,
        form=chain.joint_names()[number],
        reason="open",
        linkage=motion.linkage,
    )
    return replace(
        motion,
        drives=motion.drives[:row],
        places=motion.places[:, :row],
        turns=motion.turns[:row],
        rates=motion.rates[:, :row],
        whole=motion.whole[:row],
        roots=motion.roots[:row],
        unknowns=motion.unknowns[:row],
        stop=stop,
    )


def _stop(plan: Plan, at: float, drives: Reals, part: Dyad | HigherGroup, reason: str) -> Stop:
    group = plan.decomposition.groups[part.group]
    return Stop(
        row=at,
        drives=tuple(float(v) for v in drives),
        links=group.links,
        form=group.form(),
        reason=reason,
        linkage=plan.linkage,
    )


@door_that_raises(LinkageError)
def assembly_modes(linkage: LinkageLike, drives: float | ArrayLike) -> list[str]:
    """Every assembly mode that a linkage of the plane has at a drive value: `gruebler.assembly_modes` for the plane.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> assembly_modes(FourBar(25, 70, 40, 70), 1.0)
    ['+', '-']
    """
    plan = cached_plan(as_linkage(linkage))
    row = row_of_values(drives, len(plan.linkage.mechanism.drives))
    warn_of_path(plan, row)
    modes = all_branches(plan, row[0])
    return [branch_text(labels) for labels in modes]


def possible_modes(linkage: Linkage) -> int | None:
    """How many assembly modes almost all linkages of this structure have, complex ones included.

    No dimensions have more that are isolated, so no more are real. None if a joint does not turn, if the drives leave
    something undetermined, or if a group is larger than what is counted: there the number is not known.

    Theory: docs/theory/counting-modes.md

    >>> from gruebler.mechanics.fourbar import FourBar, SliderCrank
    >>> possible_modes(FourBar(25, 70, 40, 70).linkage()), possible_modes(SliderCrank(20, 50).linkage())
    (2, None)
    """
    decomposition = decompose(linkage.mechanism)
    return modes_of_groups(group.shape for group in decomposition.groups) if decomposition.complete else None


def all_branches(plan: Plan, drives: Reals) -> Iterator[tuple[str, ...]]:
    """Every branch that can be assembled at these drive values."""
    yield from _extended(plan, drives, labelled_groups(plan), ())


def _extended(
    plan: Plan, drives: Reals, parts: tuple[Dyad | HigherGroup, ...], labels: tuple[str, ...]
) -> Iterator[tuple[str, ...]]:
    if len(labels) == len(parts):
        if len(move_quietly(plan, drives.reshape(1, -1), branch=labels)):
            yield labels
        return
    part = parts[len(labels)]
    if isinstance(part, Dyad):
        for label in "+-":
            yield from _extended(plan, drives, parts, (*labels, label))
        return
    try:
        modes = modes_of_group(plan, part, drives, *starting_state(plan, labels, drives, part))
    except Unassembled:
        return
    for number in range(len(modes)):
        yield from _extended(plan, drives, parts, (*labels, str(number + 1)))
