"""Contraction merges the two links of a joint into one. Expansion, its inverse, splits a link."""

from __future__ import annotations

from collections.abc import Sequence

from gruebler.base.errors import TransformationError, naming
from gruebler.base.text import message
from gruebler.structure.chain import Chain, pairs
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.transformations.places import ChainBuilder, links_at, new_link_names
from gruebler.structure.transformations.steps import Step


def contract(chain: Chain, joint: int, links: Sequence[str] | None = None) -> Step:
    """Merge two links of a joint into one, which keeps the first name; F falls by the joint's freedoms.

    Args:
        chain: any chain.
        joint: the number of the joint. It is removed, or loses a link if it has more than two.
        links: the two links of a multiple joint; else the joint's own, in either order.

    Raises `TransformationError` if the two links share a second joint, which would connect the merged link to itself.

    >>> print(contract(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"), 0).chain)
    R(0-2) R(2-3) R(3-4) R(4-0)
    """
    carriers = links_at(chain, joint)
    chosen = list(carriers if links is None else links)
    if len(chosen) != 2 or len(set(chosen)) != 2 or not set(chosen) <= set(carriers):
        raise TransformationError("say which two links of {joints} become one", joints=chain.joints[joint])
    keeper, merged = chosen
    again = next(
        (j for k, j in enumerate(chain.joints) if k != joint and keeper in j.links and merged in j.links), None
    )
    if again is not None:
        raise TransformationError(
            "{kept} and {gone} cannot become one: they meet in {again} too", kept=keeper, gone=merged, again=again
        )
    joints = []
    for number, old in enumerate(chain.joints):
        remaining = [keeper if link == merged else link for link in old.links if number != joint or link != merged]
        if len(remaining) > 1:
            joints.append((old.pair, remaining))
    with naming(
        message("with {kept} and {gone} as one link there is no chain left", kept=keeper, gone=merged),
        TransformationError,
    ):
        contracted = Chain(joints, links=[link for link in chain.links if link != merged], space=chain.space)
    return Step("contract", {"joint": joint, "links": [keeper, merged]}, chain, contracted)


def expand(
    chain: Chain,
    link: str,
    joints: Sequence[int],
    *,
    pair: str | Pair | None = None,
    at: int | None = None,
    new: str | None = None,
) -> Step:
    """Split a link: a new one takes some of its joints and is joined to it; F rises by the joint's freedoms.

    Args:
        chain: any chain.
        link: the link to split.
        joints: the numbers of its joints that go to the new link.
        pair: the pair of the new joint between the two (revolute if neither this nor `at` is given), or
        at: the number of a joint of the link that the new link joins too.
        new: the name of the new link; by default the lowest free number.

    >>> print(expand(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "0", [0], new="4").chain)
    R(4-1) R(1-2) R(2-3) R(3-0) R(0-4)
    """
    chain.index(link)
    strange = next((k for k in joints if link not in links_at(chain, k)), None)
    if strange is not None:
        raise TransformationError(
            "the joint {joints} is not one of {link}'s and cannot go to the new link",
            joints=chain.joints[strange],
            link=link,
        )
    if at is not None and (pair is not None or at in joints or link not in links_at(chain, at)):
        raise TransformationError(
            "the two parts are joined by a new joint of a given pair, or at a joint of the link that does not move"
        )
    (name,) = new_link_names(chain, 1, None if new is None else [new])
    builder = ChainBuilder(chain)
    for number in joints:
        carriers = builder.joints[number][1]
        carriers[carriers.index(link)] = name
    where: dict[str, object] = {"link": link, "joints": list(joints), "new": name}
    if at is None:
        joining = pair if isinstance(pair, Pair) else pairs.pair(pair or "revolute")
        builder.add(joining, [link, name])
        where["pair"] = joining.name
    else:
        builder.attach(at, chain.joints[at].pair, [name])
        where["at"] = at
    return Step("expand", where, chain, builder.done([name]))
