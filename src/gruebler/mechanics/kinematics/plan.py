"""What the kernel has to do for a linkage: drives, groups in solving order, and which links go along with which."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from math import radians

import numpy as np

from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.mechanics.kinematics.contacts import Condition, contact_conditions, law_tables
from gruebler.mechanics.kinematics.dyad_forms import DYADS, DyadForm
from gruebler.mechanics.kinematics.kernel_records import (
    CARRY,
    GROUP,
    PIN,
    PUSH,
    RRR,
    SLIDE,
    TURN,
    Program,
)
from gruebler.mechanics.kinematics.redundancy import independent_part
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.wheels import round_joints
from gruebler.structure.assur import Decomposition, SolvedGroup, decompose

_DYAD_CODES = {form.code for form in DYADS.values()}
# Between two checks a drive moves no further: within that a pose is predicted so well that Newton's method stays on its
# branch. A slide moves a third of the way that 5 degrees move a point at the distance of one size.
_LONGEST_TURN = radians(5)
_LONGEST_PUSH = 0.03  # of the linkage's size
_ONE = 1e-9  # of the linkage's size: shortest ways of a slide that differ by less are one


@dataclass(frozen=True, kw_only=True)
class Dyad:
    """A dyad of the plan."""

    group: int
    """Its number in the decomposition."""
    form: DyadForm
    first: str
    second: str
    number: int
    """Its number among the dyads."""

    @property
    def branching(self) -> bool:
        """Whether it has two assembly modes."""
        return self.form.side is not None


@dataclass(frozen=True, kw_only=True)
class HigherGroup:
    """A group that is solved by Newton's method."""

    group: int
    roots: tuple[str, ...]
    """The links that stand for its bodies."""
    number: int
    """Its number among the larger groups."""
    base: str
    """The link that stands for what it is found against."""
    contacts: bool = False
    """Whether wheels or circles are in it: its modes are not searched for, it is followed from the reference pose."""


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Plan:
    """The order of solving, in names and as arrays for the kernel."""

    linkage: Linkage
    """The linkage as it was given."""
    lower: Linkage
    """The same with turning and sliding joints only, and without redundant conditions."""
    decomposition: Decomposition
    parts: tuple[Dyad | HigherGroup, ...]
    """Dyads and larger groups in solving order."""
    operations: tuple[tuple[int, ...], ...]
    conditions: tuple[tuple[Condition, ...], ...]
    """For each larger group its closing conditions."""
    keys: tuple[tuple[int, str], ...]
    """The joint and link of each element by number."""
    released: tuple[int, ...] = ()
    """The joints, by number in `linkage`, that are closed only if its sizes are right: redundant conditions."""

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """The dyads in solving order."""
        return tuple(part for part in self.parts if isinstance(part, Dyad))

    @cached_property
    def branching(self) -> list[int]:
        """The numbers of the dyads with two assembly modes."""
        return [dyad.number for dyad in self.dyads if dyad.branching]

    @property
    def higher_groups(self) -> tuple[HigherGroup, ...]:
        """The larger groups in solving order."""
        return tuple(part for part in self.parts if isinstance(part, HigherGroup))

    @property
    def wheels(self) -> bool:
        """Whether wheels or circles are in it, so that every motion is followed from the reference pose."""
        return any(part.contacts for part in self.higher_groups)

    @cached_property
    def held(self) -> np.ndarray:
        """The values of the drives that hold idle rollers; they stand behind the others."""
        reference, drives = (
            self.lower.reference_pose,
            range(len(self.linkage.mechanism.drives), len(self.lower.mechanism.drives)),
        )
        links = [self.lower.reference(k) for k in drives]
        return np.array([reference[b].angle - reference[a].angle if reference is not None else 0.0 for a, b in links])

    @cached_property
    def windings(self) -> tuple[Condition, ...]:
        """The closing conditions that count whole turns."""
        return tuple(c for group in self.conditions for c in group if c.winds)

    @property
    def unknowns(self) -> int:
        """How many numbers describe a pose of the larger groups: 3 for each body, 2 for each of `windings`."""
        return 3 * sum(len(part.roots) for part in self.higher_groups) + 2 * len(self.windings)

    def operation(self, dyad: Dyad) -> tuple[int, ...]:
        """The operation that places a dyad: kind, six elements, two links, its number."""
        return next(o for o in self.operations if o[0] in _DYAD_CODES and o[9] == dyad.number)

    @cached_property
    def program(self) -> Program:
        """The arrays."""
        chain = self.lower.mechanism.chain
        points, lines = self.element_arrays(self.lower)
        flat = [c for group in self.conditions for c in group]
        laws, pieces = law_tables([c.law for c in flat])
        roots = [root for part in self.higher_groups for root in part.roots]
        return Program(
            _table(self.operations, 10),
            np.array([chain.index(link) for _, link in self.keys], np.int64),
            points,
            lines,
            _starts(len(group) for group in self.conditions),
            np.array([c.kind for c in flat], np.int64),
            np.array([side for c in flat for side in c.sides], np.int64),
            np.array([owner for c in flat for owner in c.owners], np.int64),
            _starts(len(part.roots) for part in self.higher_groups),
            np.array([chain.index(root) for root in roots], np.int64),
            self.longest_steps,
            self.lower.size,
            np.array([(*c.values, *law) for c, law in zip(flat, laws, strict=True)]).reshape(-1, 6),
            np.array([3 * len(roots) + 2 * self.windings.index(c) if c.winds else -1 for c in flat], np.int64),
            pieces,
        )

    @property
    def longest_steps(self) -> np.ndarray:
        """How far each drive may move between two checks."""
        turning = [d.turning for d in self.lower.mechanism.drives]
        return np.array([_LONGEST_TURN if turns else _LONGEST_PUSH * self.lower.size for turns in turning])

    @cached_property
    def shortest(self) -> tuple[tuple[int, float], ...]:
        """Drive values where a driven slide brings the two joints of its body nearest: number of the drive, way.

        There a dyad may be impossible for so short a way that steps would pass it unseen.
        """
        program = self.program
        values: list[tuple[int, float]] = []
        for _, k, near, far, sign in (o for o in self.operations if o[0] == PUSH):
            line = program.lines[near]
            turn = line * np.conj(program.lines[far])
            for operation in self.operations:
                for first, second in (operation[2:4], operation[4:6]) if operation[0] == RRR else ():
                    if {program.links[first], program.links[second]} != {program.links[near], program.links[far]}:
                        continue
                    if program.links[first] != program.links[near]:
                        first, second = second, first  # noqa: PLW2901
                    gap = (
                        program.points[near]
                        + turn * (program.points[second] - program.points[far])
                        - program.points[first]
                    )
                    value = float(-sign * (np.conj(line) * gap).real)
                    if not any(
                        k == number and abs(value - known) <= _ONE * self.lower.size for number, known in values
                    ):
                        values.append((k, value))
        return tuple(values)

    def element_arrays(self, lower: Linkage) -> tuple[np.ndarray, np.ndarray]:
        """Points and directions (complex) of the elements of a linkage of this structure, with lower pairs."""
        elements = [lower.elements[key] for key in self.keys]
        points = np.array([complex(e.x, e.y) for e in elements], np.complex128)
        lines = np.array([rect(1, e.direction) for e in elements], np.complex128)
        return points, lines


def _table(rows: Iterable[tuple[int, ...]], width: int) -> np.ndarray:
    rows = list(rows)
    table = np.full((len(rows), width), -1, np.int64)
    for k, row in enumerate(rows):
        table[k, : len(row)] = row
    return table


def _starts(lengths: Iterable[int]) -> np.ndarray:
    return np.cumsum([0, *lengths]).astype(np.int64)


def plan(linkage: Linkage) -> Plan:
    """The plan of a linkage; `LinkageError` says what its drives leave free or hold twice."""
    lower = with_lower_pairs(linkage)
    if lower.reference_pose is None and round_joints(lower.mechanism, lower.elements):
        raise LinkageError(
            "wheels roll from a known position: the linkage needs a reference pose or a drawing "
            "(Linkage.from_drawing, places)"
        )
    parts = decompose(lower.mechanism)
    released: tuple[int, ...] = ()
    if parts.overconstrained:
        try:
            part, released = independent_part(linkage)
        except LinkageError as error:
            assert parts.report is not None
            raise LinkageError(
                "the linkage cannot be moved by its drives: constraints or drives conflict. Mobility {mobility}, "
                "drives {drives}, at almost all sizes. {error}",
                mobility=parts.report.mobility,
                drives=parts.report.drives,
                error=error,
            ) from None
        lower = with_lower_pairs(part)
        parts = decompose(lower.mechanism)
    if not parts.complete:
        raise LinkageError("the linkage cannot be moved by its drives. {reason}", reason=parts.reason)
    return replace(_Planner(linkage, lower, parts).made(), released=released)


class _Planner:
    """Builds a plan; knows for each link the link against which it is placed so far."""

    def __init__(self, linkage: Linkage, lower: Linkage, parts: Decomposition) -> None:
        self.linkage, self.lower, self.decomposition = linkage, lower, parts
        self.chain = lower.mechanism.chain
        self.keys = tuple(sorted(lower.elements, key=lambda key: (key[0], self.chain.index(key[1]))))
        self.number = {key: k for k, key in enumerate(self.keys)}
        self.operations: list[tuple[int, ...]] = []
        self.conditions: list[tuple[Condition, ...]] = []
        self.parts: list[Dyad | HigherGroup] = []
        self.against: dict[str, str] = {}

    def made(self) -> Plan:
        frame = self.lower.mechanism.frame
        self._drives(frame, (frame, *self.decomposition.driven))
        for group in self.decomposition.groups:
            for body in group.bodies:
                self._drives(body[0], body)
        for number, group in enumerate(self.decomposition.groups):
            self._group(number, group)
        return Plan(
            linkage=self.linkage,
            lower=self.lower,
            decomposition=self.decomposition,
            parts=tuple(self.parts),
            operations=tuple(self.operations),
            conditions=tuple(self.conditions),
            keys=self.keys,
        )

    def _drives(self, root: str, links: tuple[str, ...]) -> None:
        """Place the links of a body against its root, drive by drive."""
        self.against[root] = root
        drives = self.lower.mechanism.drives
        waiting = {k for k, drive in enumerate(drives) if set(drive.between) <= set(links)}
        while waiting:
            k = min(k for k in waiting if any(self.against.get(link) == root for link in drives[k].between))
            waiting.remove(k)
            first, other = self.lower.reference(k)
            sign = 1
            if self.against.get(first) != root:
                first, other, sign = other, first, -1
            kind = TURN if drives[k].turning else PUSH
            joint = drives[k].joint
            self.operations.append((kind, k, self.number[joint, first], self.number[joint, other], sign))
            self.against[other] = root

    def _group(self, number: int, group: SolvedGroup) -> None:
        base = self.lower.mechanism.frame if self.lower.mechanism.frame in group.base else group.base[0]
        roots = tuple(body[0] for body in group.bodies)
        dyad = self._dyad(group, base)
        if dyad is not None:
            form, elements, first, second = dyad
            count = len([part for part in self.parts if isinstance(part, Dyad)])
            index = self.chain.index
            self.operations.append((form.code, *elements, index(first), index(second), count))
            self.parts.append(Dyad(group=number, form=form, first=first, second=second, number=count))
        else:
            count = len(self.conditions)
            self.operations.append((GROUP, count))
            self.conditions.append(self._conditions(group, base, roots))
            contacts = any(not member.pair.is_basic for _, member in group.joints)
            self.parts.append(HigherGroup(group=number, roots=roots, number=count, base=base, contacts=contacts))
        for root in roots:
            for link in [link for link, at in self.against.items() if at == root and link != root]:
                self.operations.append((CARRY, self.chain.index(link), self.chain.index(root)))
                self.against[link] = base
            self.against[root] = base

    def _element(self, joint: int, root: str) -> int:
        """The element by which something placed against `root` carries a joint."""
        link = next(link for link in self.chain.joints[joint].links if self.against.get(link) == root)
        return self.number[joint, link]

    def _dyad(self, group: SolvedGroup, base: str) -> tuple[DyadForm, list[int], str, str] | None:
        if (
            len(group.bodies) != 2
            or len(group.joints) != 3
            or any(len(m.links) + m.outer != 2 or not m.pair.is_basic for _, m in group.joints)
        ):
            return None
        outer: dict[int, tuple[int, bool]] = {}
        inner = (-1, False)
        for joint, member in group.joints:
            if member.outer:
                outer[member.links[0]] = joint, member.pair.is_sliding
            else:
                inner = joint, member.pair.is_sliding
        body_a, body_b = 0, 1
        slides: tuple[bool, ...] = (outer[0][1], inner[1], outer[1][1])
        if slides not in DYADS:
            slides, body_a, body_b = slides[::-1], 1, 0
        first, second = group.bodies[body_a][0], group.bodies[body_b][0]
        elements = [
            self._element(outer[body_a][0], base),
            self._element(outer[body_a][0], first),
            self._element(inner[0], first),
            self._element(inner[0], second),
            self._element(outer[body_b][0], second),
            self._element(outer[body_b][0], base),
        ]
        return DYADS[slides], elements, first, second

    def _conditions(self, group: SolvedGroup, base: str, roots: tuple[str, ...]) -> tuple[Condition, ...]:
        conditions: list[Condition] = []
        for joint, member in group.joints:
            sides = [(self._element(joint, base), -1)] if member.outer else []
            sides += [(self._element(joint, roots[body]), body) for body in member.links]
            for element, body in sides[1:]:
                both, owners = (sides[0][0], element), (sides[0][1], body)
                if member.pair.is_basic:
                    conditions.append(
                        Condition(kind=PIN if member.pair.is_turning else SLIDE, sides=both, owners=owners)
                    )
                else:
                    try:
                        conditions += contact_conditions(self.lower, member.pair, self.keys, both, owners)
                    except LinkageError as error:
                        raise LinkageError(
                            "{joint}: {error}", joint=self.chain.joint_title(joint), error=error
                        ) from None
        return tuple(conditions)
