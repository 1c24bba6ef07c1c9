"""Assembly modes: labels that a caller sees and chooses.

A branch has one label for each group that can be assembled in more than one way, in solving order: ``+`` or ``-`` for a
dyad, the number of the mode (from 1) for a larger group.

- RRR: ``+`` if the inner joint lies left of the line from the first link's outer joint to the second link's; the first
  link is the one that the chain names first.
- RRP: ``+`` if the inner joint lies towards the end of the slide's line, seen from the foot of the outer joint.
- RPR: ``+`` if the second outer joint lies in the direction of the slide's line, seen from the first.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.kinematics.kernel_records import GROUP
from gruebler.mechanics.kinematics.plan import Dyad, HigherGroup, Plan
from gruebler.mechanics.linkages.branch import Branch, branch_labels, branch_text
from gruebler.structure.chain.pairs import in_alphabets

_SAME = 1e-6  # sizes and radians: a pose so near to an assembly mode is in it, as modes that are nearer count as one


def part_at_fault(plan: Plan, number: int) -> Dyad | HigherGroup:
    """What the kernel's number of a dyad (from 0) or larger group (-1, -2, ...) stands for."""
    return plan.dyads[number] if number >= 0 else plan.higher_groups[-1 - number]


def labelled_groups(plan: Plan) -> tuple[Dyad | HigherGroup, ...]:
    """The groups that have a label; one with wheels has none."""
    return tuple(part for part in plan.parts if (part.branching if isinstance(part, Dyad) else not part.contacts))


def read_branch(plan: Plan, branch: Branch) -> tuple[str, ...]:
    """The labels of a text such as ``+-`` or ``+,2,-``; `LinkageError` says what is expected."""
    parts = labelled_groups(plan)
    labels = branch_labels(branch)
    if labels is None:
        return tuple("+" if isinstance(part, Dyad) else "1" for part in parts)
    if len(labels) != len(parts):
        text = branch_text(labels)
        if not parts:
            raise LinkageError("this linkage has one assembly mode and an empty branch; found {branch!r}", branch=text)
        labels_of = [
            message("+ or - for {group}" if isinstance(part, Dyad) else "a number for {group}", group=_name(plan, part))
            for part in parts
        ]
        raise LinkageError(
            "a branch of this linkage is {labels}; found {branch!r}", labels=joined(labels_of), branch=text
        )
    for part, label in zip(parts, labels, strict=True):
        if isinstance(part, Dyad) != (label in "+-") or label == "0":
            raise LinkageError(
                "branch: expected + or - for {group}, but found {label!r}"
                if isinstance(part, Dyad)
                else "branch: expected a number from 1 for {group}, but found {label!r}",
                group=_name(plan, part),
                label=label,
            )
    return labels


def _name(plan: Plan, part: Dyad | HigherGroup) -> Message:
    group = plan.decomposition.groups[part.group]
    return message("{form} {{{links}}}", form=in_alphabets(group.form), links=", ".join(group.links))


def starting_state(
    plan: Plan, labels: tuple[str, ...], drives: Reals, last: HigherGroup | None = None
) -> tuple[Reals, Reals]:
    """The signs of the dyads and the unknowns of larger groups (before the last) at a start.

    Raises `Unassembled` for a group that has no such mode there.
    """
    signs = np.ones(len(plan.dyads))
    unknowns = np.zeros(plan.unknowns)
    filled = 0
    for part, label in zip(labelled_groups(plan), labels, strict=False):
        if part == last:
            break
        if isinstance(part, Dyad):
            signs[part.number] = -1 if label == "-" else 1
            continue
        modes = modes_of_group(plan, part, drives, signs, unknowns)
        if len(modes) < int(label):
            raise Unassembled(part)
        count = 3 * len(part.roots)
        unknowns[filled : filled + count] = modes[int(label) - 1].ravel()
        filled += count
    return signs, unknowns


class Unassembled(Exception):
    """A group that cannot be assembled at a start."""

    def __init__(self, part: Dyad | HigherGroup) -> None:
        super().__init__(part)
        self.part = part


def branch_of(plan: Plan, roots: Reals, unknowns: Reals, drives: Reals) -> tuple[str, ...]:
    """The labels of a pose."""
    labels, first = [], 0
    signs = np.where(roots < 0, -1.0, 1.0)
    for part in labelled_groups(plan):
        if isinstance(part, Dyad):
            labels.append("-" if roots[part.number] < 0 else "+")
            continue
        count = 3 * len(part.roots)
        current = unknowns[first : first + count].reshape(-1, 3)
        modes = modes_of_group(plan, part, drives, signs, unknowns)
        far = [_distance(mode, current, plan.lower.size) for mode in modes]
        labels.append(str(1 + int(np.argmin(far))) if far and min(far) < _SAME else "0")
        first += count
    return tuple(labels)


def _distance(first: Reals, second: Reals, size: float) -> float:
    gap = first - second
    angles = np.abs(np.exp(1j * gap[:, 2]) - 1)
    return float(max(np.abs(gap[:, :2]).max() / size, angles.max()))


def modes_of_group(plan: Plan, part: HigherGroup, drives: Reals, signs: Reals, unknowns: Reals) -> Reals:
    """All assembly modes of a larger group with everything before it placed: (modes, bodies, 3)."""
    from gruebler.mechanics.kinematics.assembly_modes import conditions as closing_conditions
    from gruebler.mechanics.kinematics.triads import all_modes

    places, turns = pose_before(plan, part, drives, signs, unknowns)
    program = plan.program
    rows = []
    for condition in plan.conditions[part.number]:
        (a, b), (body_a, body_b) = condition.sides, condition.owners
        (point_a, line_a), (point_b, line_b) = (
            (places[k] + turns[k] * program.points[e], turns[k] * program.lines[e])
            for e, k in ((a, program.links[a]), (b, program.links[b]))
        )
        rows.append((condition.kind, body_a, body_b, point_a, line_a, point_b, line_b))
    return all_modes(closing_conditions(rows)).poses


def pose_before(
    plan: Plan, part: HigherGroup, drives: Reals, signs: Reals, unknowns: Reals
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Where the links lie before a group is placed: against the frame, or against the root of their body."""
    from gruebler.mechanics.kinematics.kernel_calls import run_rows

    stop = next(k for k, operation in enumerate(plan.operations) if operation[:2] == (GROUP, part.number))
    program = plan.program._replace(operations=plan.program.operations[:stop])
    rows = run_rows(plan, np.asarray(drives).reshape(1, -1), None, signs, unknowns, program)
    if rows.reached == 0:
        raise Unassembled(part_at_fault(plan, rows.fault))
    return rows.places[0, 0], rows.turns[0]
