"""The Assur groups of a mechanism for each choice of drives."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from gruebler.structure.assur.decomposition import Decomposition, decompose
from gruebler.structure.assur.locking import AssurError
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.structure.mobility import generic_mobility


def drive_choices(
    chain: Chain, frame: str, *, drives: int | None = None, anywhere: bool = False
) -> Iterator[Decomposition]:
    """The decomposition for every choice of drives, in the order of the joints; isomorphic choices are kept.

    Args:
        chain: a planar chain.
        frame: the fixed link.
        drives: how many freedoms are driven; as many as the chain has (generically) if left out.
        anywhere: whether joints between moving links may be driven too, and not only those at the frame.

    Choices that do not fix the motion come with `complete` false. Raises `AssurError` for a chain that does not move.

    >>> chain = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)")
    >>> [choice.class_number for choice in drive_choices(chain, "4", anywhere=True)]
    [2, 2, 2, 2, 3, 4, 4]
    """
    chain.index(frame)
    number = generic_mobility(chain) if drives is None else drives
    if number < 1:
        raise AssurError("the chain does not move: there is nothing to drive")
    freedoms = [
        Drive(k, direction, (a, b))
        for k, joint in enumerate(chain.joints)
        for a, b in combinations(joint.links, 2)
        for direction in joint.pair.freedoms[chain.space]
        if anywhere or frame in (a, b)
    ]
    for chosen in combinations(freedoms, number):
        yield decompose(Mechanism(chain, frame, chosen))
