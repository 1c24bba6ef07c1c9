"""How many assembly modes trusses and Assur groups of turning joints have, complex ones included.

Theorems and recursions: docs/theory/counting-modes.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.doors import door_that_raises
from gruebler.structure.assur.groups import AssurGroup
from gruebler.structure.assur.listing import GroupRow
from gruebler.structure.assur.locking import AssurError
from gruebler.structure.chain import Chain

MOST_LINKS, MOST_JOINTS = 21, 30  # most_mode_links, most_mode_joints of the core


@door_that_raises(AssurError)
def count_modes(group: AssurGroup | Chain, *, spherical: bool = False) -> int:
    """The number of assembly modes of an Assur group or a truss of turning joints, complex ones included.

    Almost all dimensions have this number: no dimensions have more modes, unless infinitely many. Bodies are not
    mirrored. A group has its places outside held; a truss is seen from any of its links.

    Args:
        group: the group, or the truss as a chain; multiple joints are allowed.
        spherical: count on the sphere, where all axes pass through one point.

    Returns:
        The number; 0 for a chain with an overconstrained part, which almost no dimensions assemble.

    Raises:
        AssurError: a joint that does not turn, joints that do not hold the links by count, more than 21 links or 30
            joints.

    Cost:
        Exact; 0.3 ms for 11 links and about twice as much for each further link.

    Example:
        >>> three_rr = AssurGroup.parse("R(a-1) R(1-4) R(b-2) R(2-4) R(c-3) R(3-4)")
        >>> count_modes(three_rr), count_modes(three_rr, spherical=True)
        (6, 8)

    See Also:
        `assur_groups`, `gruebler.assembly_modes`

    Theory:
        docs/theory/counting-modes.md
    """
    chain, places = (group.chain, set(group.places)) if isinstance(group, AssurGroup) else (group, set[str]())
    turning = next((str(joint) for joint in chain.joints if not joint.pair.is_turning), None)
    if turning is not None:
        raise AssurError("assembly modes are counted where all joints turn; {joint} does not", joint=turning)
    own = [link for link in chain.links if link not in places]
    number = {link: k for k, link in enumerate(own, bool(places))}  # all places are link 0
    sets = [sum({1 << number.get(link, 0) for link in joint.links}) for joint in chain.joints]
    links = len(own) + bool(places)
    held = 2 * sum(joint.bit_count() - 1 for joint in sets)
    if held != 3 * (links - 1):
        raise AssurError(
            "{links} links are held by joints that remove {wanted} freedoms; these remove {held}",
            links=links,
            wanted=3 * (links - 1),
            held=held,
        )
    if links > MOST_LINKS or len(sets) > MOST_JOINTS:
        raise AssurError(
            "assembly modes are counted to {most} links and {joints} joints, and there are {links} and {found}",
            most=MOST_LINKS,
            joints=MOST_JOINTS,
            links=links,
            found=len(sets),
        )
    return int(modes_of_trusses(links, np.array([sets], np.int64), spherical=spherical)[0])


def modes_of_groups(groups: Iterable[AssurGroup]) -> int | None:
    """The modes of a mechanism of these groups, None if a joint does not turn or a group is larger than is counted.

    >>> modes_of_groups([AssurGroup.parse("R(a-1) R(1-2) R(b-2)")] * 2)
    4
    """
    shapes = list(groups)
    if not all(joint.pair.is_turning for shape in shapes for joint in shape.chain.joints):
        return None
    try:
        return prod(map(count_modes, shapes))
    except AssurError:
        return None


def modes_of_trusses(links: int, joints: NDArray[np.int64], *, spherical: bool = False) -> NDArray[np.int64]:
    """The modes of many trusses at once: int64[k, joints], each joint the set of its links as bits.

    >>> modes_of_trusses(3, np.array([[0b011, 0b110, 0b101]])).tolist()
    [2]
    """
    return _core.count_modes(links, joints, spherical)


def modes_of_rows(rows: Sequence[GroupRow], *, spherical: bool = False) -> list[int]:
    """The modes of groups of one size from `group_rows`.

    >>> from gruebler.structure.assur.listing import group_rows
    >>> modes_of_rows(list(group_rows(4))), modes_of_rows(list(group_rows(6)))
    ([6, 6], [18, 18, 18, 14, 14, 14, 16, 16, 16, 16])
    """
    if not rows:
        return []
    ends = [[[int(end) if end.isdigit() else 0 for end in joint] for joint in row.joints] for row in rows]
    sets = sets_of_ends(np.array(ends, np.uint8))
    modes: list[int] = modes_of_trusses(int(max(map(max, ends[0]))) + 1, sets, spherical=spherical).tolist()
    return modes


def sets_of_ends(ends: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Simple joints, two links each, as sets of links: int64[k, joints] of uint8[k, joints, 2]."""
    sets: NDArray[np.int64] = np.ascontiguousarray((np.int64(1) << ends.astype(np.int64)).sum(axis=2))
    return sets
