"""The decomposition of a mechanism: its drives, and the Assur groups in the order in which they can be solved.

Lock the drives. A set of links that contains the frame is *tight* if the constraints within it are as many as its
freedoms. Tight sets are closed under union and intersection, so the differences of neighbouring ones are unique:
the groups. Where some bodies of a group are rigid among themselves (because of a drive between moving links), they
are solved first relative to one of them, and then count as one body. docs/theory/assur.md has the theorems.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from gruebler.base.doors import door
from gruebler.base.notebook import brief
from gruebler.base.text import Message, joined, message, plural, translate
from gruebler.structure.assur.forms import GroupJoint, class_number, form_name, roman
from gruebler.structure.assur.groups import AssurGroup
from gruebler.structure.assur.locking import LockedMechanism, independent, lock_drives, whole_joint_locks
from gruebler.structure.assur.splitting import BodyGroup, split_into_groups
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet, Pair
from gruebler.structure.mechanism import DriveReport, Mechanism, check_drives
from gruebler.structure.mobility import generic, overconstrained


@dataclass(frozen=True, kw_only=True)
class SolvedGroup:
    """An Assur group in its mechanism."""

    bodies: tuple[tuple[str, ...], ...]
    """The bodies that it determines: a link, or several links that a drive locks together."""
    carried: tuple[tuple[str, ...], ...]
    """For each body the links that earlier groups have fixed to it, and that move with it."""
    base: tuple[str, ...]
    """The body relative to which it is solved: the frame's, or one that a later group places with its carried links."""
    joints: tuple[tuple[int, GroupJoint], ...]
    """Its joints: the number of the chain's joint, the pair with its drives locked, the bodies that carry it."""
    after: tuple[int, ...]
    """The groups (by place in the decomposition) on which it depends directly."""

    @property
    def links(self) -> tuple[str, ...]:
        """Its own links."""
        return tuple(link for body in self.bodies for link in body)

    @property
    def inner(self) -> tuple[int, ...]:
        """The joints among its own bodies, by number."""
        return tuple(number for number, member in self.joints if not member.outer)

    @property
    def outer(self) -> tuple[int, ...]:
        """The joints with bodies that are known before it, by number."""
        return tuple(number for number, member in self.joints if member.outer)

    @property
    def members(self) -> tuple[GroupJoint, ...]:
        """The joints without their numbers."""
        return tuple(member for _, member in self.joints)

    @property
    def order(self) -> int:
        """The number of outer joints, one that k of its links share counted k times."""
        return sum(len(j.links) for j in self.members if j.outer)

    @cached_property
    def class_number(self) -> int:
        """The class: 2 for dyads, 3 for a link with three inner joints, 4 for a loop of four, and so on."""
        return class_number(len(self.bodies), self.members)

    @cached_property
    def shape(self) -> AssurGroup:
        """The group without its mechanism; bodies of several links are named ``a+b``."""
        names = ["+".join(body) for body in self.bodies]
        used_names = set(names)
        joints: list[tuple[Pair, list[str]]] = []
        for member in self.members:
            links = [names[k] for k in member.links]
            if member.outer:
                place = f"place{len(joints) + 1}"
                while place in used_names:
                    place += "'"
                links.insert(0, place)
            joints.append((member.pair, links))
        return AssurGroup(Chain(joints))

    def form(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The name of its form, or its code where the form has no name."""
        return form_name(len(self.bodies), self.members, Alphabet(alphabet)) or self.shape.code


@dataclass(frozen=True, slots=True)
class JointShare:
    """The count of a joint in one part: the shares of a joint of k links add up to k - 1."""

    joint: int
    part: int | None
    """The place of the group; None for the drives."""
    count: int


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Decomposition:
    """Drives, groups in solving order, and the links that the drives leave undetermined."""

    mechanism: Mechanism
    driven: tuple[str, ...]
    """The links that the drives move directly against the frame."""
    groups: tuple[SolvedGroup, ...]
    rest: tuple[str, ...]
    """The links in no group; empty exactly if the decomposition is complete."""
    report: DriveReport | None
    """If it is not complete, the report of `check_drives`."""
    overconstrained: bool
    """Whether constraints or drives work against one another; then nothing is decomposed."""

    @property
    def complete(self) -> bool:
        """Whether every link is determined: the drives fix the motion, and nothing is redundant."""
        return self.report is None

    @property
    def class_number(self) -> int:
        """The highest class of its groups; 1 if there are only drives."""
        return max((group.class_number for group in self.groups), default=1)

    @cached_property
    def shares(self) -> tuple[JointShare, ...]:
        """The part of each joint, drives first; none for joints of links that are not determined.

        A joint that a drive locks only in part (a roll-slide joint) belongs to its group.
        """
        driven_joints = Counter(drive.joint for drive in whole_joint_locks(self.mechanism, {}))
        shares = [JointShare(number, None, count) for number, count in sorted(driven_joints.items())]
        for part, group in enumerate(self.groups):
            for number, member in group.joints:
                shares.append(JointShare(number, part, len(member.links) - (not member.outer)))
        return tuple(shares)

    def formula(self, lang: str = "en") -> str:
        """The structural formula, such as ``drive R(frame-crank) -> RRR{coupler, rocker}``."""
        alphabet, frame = Alphabet.of_language(lang), self.mechanism.frame
        drives = self.mechanism.drive_names(alphabet)
        formula = [translate("drive {joints}", lang, joints=_names(drives)) if drives else translate("no drive", lang)]
        for group in self.groups:
            base = "" if frame in group.base else f"; {_base(group, lang)}"
            formula.append(f"{group.form(alphabet)}{{{_bodies(group)}{base}}}")
        if self.rest:
            formula.append(f"?{{{_names(self.rest)}}}")
        return " -> ".join(formula)

    def message(self, lang: str = "en") -> str:
        """The reason why it is not complete: undetermined links, redundant drives or constraints; else empty."""
        return self.reason.in_language(lang)

    @property
    def reason(self) -> Message:
        """The text of `message`, for any language."""
        return joined(_open_groups_message(self), " ")

    def explain(self, lang: str = "en") -> str:
        """The decomposition as a text of a few lines, in English (``en``) or German (``de``)."""
        mechanism, alphabet = self.mechanism, Alphabet.of_language(lang)
        names = mechanism.chain.joint_names(alphabet)
        lines = [self.formula(lang)]
        if self.driven:
            drives, links = mechanism.drive_names(alphabet), _names(self.driven)
            lines.append(
                plural(
                    "Drive {joints}: moves {links} directly.",
                    "Drives {joints}: moves {links} directly.",
                    len(drives),
                    lang,
                    joints=_names(drives),
                    links=links,
                )
            )
        for k, group in enumerate(self.groups, 1):
            values = {
                "k": k,
                "form": group.form(alphabet),
                "links": _bodies(group) + ("" if mechanism.frame in group.base else f" ({_base(group, lang)})"),
                "outer": _names([names[j] for j in group.outer]),
                "group_class": roman(group.class_number),
                "order": group.order,
            }
            if group.inner:
                inner = _names([names[j] for j in group.inner])
                lines.append(
                    translate(
                        "{k}. {form}: links {links}; outer joints {outer}; inner joints {inner}. Class {group_class}, "
                        "order {order}.",
                        lang,
                        inner=inner,
                        **values,
                    )
                )
            else:
                lines.append(
                    translate(
                        "{k}. {form}: links {links}; outer joints {outer}. Class {group_class}, order {order}.",
                        lang,
                        **values,
                    )
                )
        if self.complete and self.groups:
            highest = roman(self.class_number)
            lines.append(translate("The mechanism has class {group_class}.", lang, group_class=highest))
        elif self.complete:
            lines.append(translate("There are only drives.", lang))
        lines += [line.in_language(lang) for line in _open_groups_message(self)]
        return "\n".join(lines)


@door
def decompose(mechanism: Mechanism) -> Decomposition:
    """The Assur groups of a planar mechanism, in solving order.

    If the drives do not fix the motion, the links that they fix are decomposed and the others listed; if constraints or
    drives conflict there are no groups (see `Decomposition.complete`). Among groups that may be solved
    in any order the one with the earliest link of the chain comes first.

    Args:
        mechanism: planar, with drives.

    Returns:
        `Decomposition`: ``groups`` in solving order, ``formula()``, ``complete``; if the drives do not fix the motion,
        the links that they fix are decomposed and the others listed.

    Raises:
        AssurError: a chain that is not planar.

    Cost:
        O(links · joints) for simple turning, rolling and roll-slide joints; others need one exact rank.

    Example:
        >>> decompose(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); drive=R(0-1)")).formula()
        'drive R(0-1) -> RRR{2, 3} -> RRR{4, 5}'

    See Also:
        `assur_groups`, `driven_mechanisms`, `move`

    Theory:
        docs/theory/assur.md
    """
    locked = lock_drives(mechanism)
    if locked.counted < 0 or not independent(mechanism, locked):
        links = tuple(link for body in locked.bodies[1:] for link in body)
        return Decomposition(
            mechanism=mechanism,
            driven=locked.bodies[0][:0],
            groups=(),
            rest=links,
            report=check_drives(mechanism),
            overconstrained=True,
        )
    bodies = range(len(locked.bodies))
    first = {k: mechanism.chain.index(locked.bodies[k][0]) for k in bodies}
    parts, loose = split_into_groups(locked.joints, bodies, 0, first, [k for k in bodies if len(locked.bodies[k]) > 1])
    return Decomposition(
        mechanism=mechanism,
        driven=tuple(link for link in locked.bodies[0] if link != mechanism.frame),
        groups=tuple(_group(locked, part) for part in parts),
        rest=tuple(link for body in loose for link in locked.bodies[body]),
        report=check_drives(mechanism) if loose else None,
        overconstrained=False,
    )


def _group(locked: LockedMechanism, part: BodyGroup) -> SolvedGroup:
    return SolvedGroup(
        bodies=tuple(locked.bodies[element[0]] for element in part.elements),
        carried=tuple(tuple(link for body in element[1:] for link in locked.bodies[body]) for element in part.elements),
        base=locked.bodies[part.base],
        joints=part.members,
        after=part.after,
    )


def _open_groups_message(decomposition: Decomposition) -> list[Message]:
    """The reasons why the decomposition is not complete, one or two sentences a line; empty if it is."""
    if decomposition.report is None:
        return []
    lines = [message("Not determined: {links}.", links=_names(decomposition.rest))]
    if decomposition.overconstrained:
        lines = [message("Constraints or drives conflict: there are no Assur groups.")]
        text = message("Overconstrained: {links} (redundant constraints: {count}).")
        lines += [
            text.filled(links=_names(part.links), count=part.redundancy)
            for part in overconstrained(generic(decomposition.mechanism.chain))
        ]
    if decomposition.report.remaining or decomposition.report.redundant_drives:
        lines.append(decomposition.report.message)
    return lines


def _bodies(group: SolvedGroup) -> str:
    """The bodies of a group, each with its carried links in square brackets."""
    return ", ".join(
        "+".join(body) + (f"[{_names(carried)}]" if carried else "")
        for body, carried in zip(group.bodies, group.carried, strict=True)
    )


def _base(group: SolvedGroup, lang: str) -> str:
    return translate("on {base}", lang, base="+".join(group.base))


def _names(names: Sequence[str]) -> str:
    return ", ".join(names)
