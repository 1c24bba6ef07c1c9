"""All Assur groups of turning joints with a given number of links, from the trusses with one link more.

With its places outside merged to one link, a group becomes a Baranov truss: a chain with F = 0 in which no smaller part
is rigid. Without any one of its links, a truss is an Assur group whose outer joints are that link's. Links that an
automorphism exchanges give the same group, others different ones.
"""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.assur.groups import AssurGroup
from gruebler.assur.locking import AssurError
from gruebler.chain import Chain
from gruebler.isomorphism import symmetry

__all__ = ["assur_groups", "expected_seconds_of_groups", "group_of_truss"]

_GROUP = 1e-3  # seconds on one core


def assur_groups(links: int) -> Iterator[AssurGroup]:
    """Every Assur group with this many links and simple turning joints, each once, in canonical form.

    Raises `AssurError` unless the number is even and positive: each link brings three constraints, each joint two.

    >>> [group.form for group in assur_groups(2)]
    ['RRR']
    """
    if links < 2 or links % 2:
        raise AssurError("an Assur group of turning joints has 2, 4, 6, ... links, not {links}", links=links)
    from gruebler.enumeration import chains  # imported only here: it compiles kernels

    for truss in chains(links + 1, 0):
        for orbit in symmetry(truss).link_orbits:
            yield AssurGroup.known(_without(truss, orbit[0])).canonical()


def expected_seconds_of_groups(links: int) -> float:
    """The estimated time of `assur_groups` for all groups, to a factor of three.

    >>> expected_seconds_of_groups(8) < 5, expected_seconds_of_groups(12) > 100
    (True, True)
    """
    from gruebler.enumeration.estimates import expected_chains
    from gruebler.enumeration.request import Request

    if links < 2 or links % 2:
        return 0.0
    trusses, _ = expected_chains(Request(links + 1, 0))
    return trusses * (links + 1) * _GROUP


def group_of_truss(truss: Chain, link: str) -> AssurGroup:
    """The group of a truss without this link; each of the link's joints gets a place of its own.

    >>> print(group_of_truss(Chain.parse("R(0-1) R(1-2) R(2-0)"), "0"))
    R(place1-1) R(1-2) R(2-place2)
    """
    return AssurGroup(_without(truss, link))


def _without(truss: Chain, link: str) -> Chain:
    truss.index(link)
    joints, place = [], 0
    for joint in truss.joints:
        place += link in joint.links
        joints.append((joint.pair, [f"place{place}" if other == link else other for other in joint.links]))
    return Chain(joints, space=truss.space)
