"""The Assur group as a value, independent of a mechanism."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from gruebler.base.immutable import settle
from gruebler.structure.assur.forms import DYADS, GroupJoint, class_number, form_name
from gruebler.structure.assur.locking import AssurError
from gruebler.structure.assur.splitting import BodyJoint, split_into_groups
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.isomorphism import canonical_order, code, decode
from gruebler.structure.mobility.placement import random_placement
from gruebler.structure.mobility.prime_field import echelon

_SEEDS = (1, 2, 3)


@dataclass(frozen=True)
class AssurGroup:
    """A minimal set of links that is determined when the positions of its outer places are known.

    Args:
        chain: a planar chain in which every link with a single joint represents a place outside to which the group
            is attached; the other links are the group's. Each place outside has a joint of its own, which more than
            one link of the group may share.

    Raises:
        AssurError: a chain that is not such a group: freedoms and constraints differ in number, or a part of it can
            be solved alone, or it is not rigid although the numbers agree (three sliders).

    >>> dyad = AssurGroup.parse("R(a-1) R(1-2) P(2-b)")
    >>> dyad.form, dyad.class_number, dyad.order, dyad.links
    ('RRP', 2, 2, ('1', '2'))
    """

    chain: Chain

    def __post_init__(self) -> None:
        _check(self)

    @classmethod
    def known(cls, chain: Chain) -> AssurGroup:
        """The group of a chain without a check, such as a group's chain with other names."""
        group = object.__new__(cls)
        settle(group, chain=chain)
        return group

    @classmethod
    def parse(cls, text: str) -> AssurGroup:
        """The group that a text, the name of a dyad (RRR, RRP, RPR, PRP, RPP) or a code describes.

        >>> print(AssurGroup.parse("RPR"))
        R(a-1) P(1-2) R(2-b)
        """
        text = text.strip()
        for form in DYADS:
            if text in (form, form[::-1]):
                return cls(Chain.parse(f"{text[0]}(a-1) {text[1]}(1-2) {text[2]}(2-b)"))
        return cls(decode(text).chain if text.startswith("gr") else Chain.parse(text))

    @cached_property
    def places(self) -> tuple[str, ...]:
        """The places outside, in the chain's order."""
        return tuple(link for link, degree in self.chain.degrees.items() if degree == 1)

    @cached_property
    def links(self) -> tuple[str, ...]:
        """The group's own links."""
        return tuple(link for link, degree in self.chain.degrees.items() if degree > 1)

    @cached_property
    def joints(self) -> tuple[GroupJoint, ...]:
        """The joints, with the numbers of the group's links that carry them."""
        number = {link: k for k, link in enumerate(self.links)}
        return tuple(
            GroupJoint(
                joint.pair,
                tuple(number[link] for link in joint.links if link in number),
                any(link not in number for link in joint.links),
            )
            for joint in self.chain.joints
        )

    @property
    def order(self) -> int:
        """The number of outer joints, one that k of the group's links share counted k times."""
        return sum(len(j.links) for j in self.joints if j.outer)

    @cached_property
    def class_number(self) -> int:
        """The class: 2 for dyads, 3 for a link with three inner joints, 4 for a loop of four, and so on."""
        return class_number(len(self.links), self.joints)

    @cached_property
    def code(self) -> str:
        """The canonical code of the chain: equal exactly for groups of one structure."""
        return code(self.chain)

    @property
    def form(self) -> str:
        """The name of the form, such as ``RRP`` or ``3-RR``; the code where the form has no name."""
        return self.named(Alphabet.INTERNATIONAL)

    def named(self, alphabet: str | Alphabet) -> str:
        """The form in one alphabet.

        >>> AssurGroup.parse("RRP").named("german")
        'DDS'
        """
        return form_name(len(self.links), self.joints, Alphabet(alphabet)) or self.code

    def canonical(self) -> AssurGroup:
        """The same structure with its links named 1, 2, ... and its places a, b, ..., in canonical order."""
        ordered = [self.chain.links[i] for i in canonical_order(self.chain).links]
        group_links = set(self.links)
        number = {link: k for k, link in enumerate((x for x in ordered if x in group_links), 1)}
        carriers = {
            place: sorted(number[link] for j in self.chain.joints_of(place) for link in j.links if link != place)
            for place in ordered
            if place not in number
        }
        names = {link: str(k) for link, k in number.items()}
        names |= {place: place_name(k) for k, place in enumerate(sorted(carriers, key=carriers.__getitem__))}
        joints = sorted(
            (Joint(j.pair, tuple(sorted((names[link] for link in j.links), key=_name_key))) for j in self.chain.joints),
            key=lambda j: [_name_key(link) for link in j.links],
        )
        return AssurGroup.known(Chain(joints))

    def __str__(self) -> str:
        return self.chain.text()


def place_name(number: int) -> str:
    """The name of the place of this number in a canonical group: a, b, ..."""
    return chr(ord("a") + number % 26) + (str(number // 26) if number >= 26 else "")


def _name_key(name: str) -> tuple[bool, int, str]:
    return name.isdigit(), int(name) if name.isdigit() else 0, name


def _check(group: AssurGroup) -> None:
    chain = group.chain
    if chain.space is not Space.PLANAR:
        raise AssurError("Assur groups are planar; this chain is {space}", space=chain.space)
    if not group.links or not group.places:
        raise AssurError(
            "{chain} has no outer joints: a group is written with a link of a single joint at each of them, as in "
            "R(a-1) R(1-2) R(2-b)",
            chain=chain,
        )
    shared = next((j for j in chain.joints if sum(link in group.places for link in j.links) > 1), None)
    if shared is not None:
        raise AssurError("the joint {shared} of the group has more than one place outside", shared=shared)
    freedoms = 3 * len(group.links)
    constraints = sum(j.pair.u(Space.PLANAR) * (len(j.links) - 1 + j.outer) for j in group.joints)
    if freedoms != constraints:
        raise AssurError(
            "{chain} is not an Assur group: {count} links have {freedoms} freedoms, but the joints remove "
            "{constraints}",
            chain=chain,
            count=len(group.links),
            freedoms=freedoms,
            constraints=constraints,
        )
    if not _rigid(group):
        raise AssurError(
            "{chain} is not an Assur group: with its outer joints on fixed links it is not rigid", chain=chain
        )
    part = _first_part(group)
    if len(part) < len(group.links):
        raise AssurError(
            "{chain} is not an Assur group: the links {part} can be solved without the others",
            chain=chain,
            part=", ".join(part),
        )


def _first_part(group: AssurGroup) -> list[str]:
    """The links of the first part that can be solved alone: all of them if the group is one."""
    joints = [
        BodyJoint(k, j.pair, (*([0] if j.outer else []), *(link + 1 for link in j.links)))
        for k, j in enumerate(group.joints)
    ]
    bodies = range(len(group.links) + 1)
    first = split_into_groups(joints, bodies, 0, dict(enumerate(bodies)), ()).parts[0]
    return [group.links[element[0] - 1] for element in first.elements]


def _rigid(group: AssurGroup) -> bool:
    """Whether the constraints determine the links when the places are fixed; a True is exact (no rank is too high)."""
    chain = Chain(group.chain.joints, links=[*group.places, *group.links])
    fixed_columns = 3 * (len(group.places) - 1)
    unknowns = 3 * len(group.links)
    for seed in _SEEDS:
        rows = [
            {column - fixed_columns: value for column, value in row.items() if column >= fixed_columns}
            for row in random_placement(chain, seed).rows
        ]
        if echelon(rows, unknowns).rank == unknowns:
            return True
    return False
