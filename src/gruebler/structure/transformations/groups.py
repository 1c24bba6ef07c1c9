"""Assur groups of any size: attached to a chain, or removed; F is unchanged."""

from __future__ import annotations

from collections.abc import Sequence

from gruebler.base.errors import TransformationError, naming
from gruebler.base.text import message
from gruebler.structure.assur import AssurGroup
from gruebler.structure.chain import Chain
from gruebler.structure.transformations.places import (
    Attachment,
    ChainBuilder,
    check_counting,
    check_not_on_one_link,
    new_link_names,
    without_links,
)
from gruebler.structure.transformations.steps import Step


def insert_group(
    chain: Chain, group: AssurGroup | str, at: Sequence[Attachment], links: Sequence[str] | None = None
) -> Step:
    """Attach an Assur group; F is unchanged.

    Args:
        chain: a planar chain.
        group: the group, or its text, code or dyad form.
        at: for each of the group's places, in their order, a link's name or the number of a joint that it joins.
        links: names for the group's links, in their order; by default the lowest free numbers.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> triad = AssurGroup.parse("R(a-1) R(1-2) R(2-3) R(3-b) R(2-4) R(4-c)")
    >>> print(insert_group(four_bar, triad, ["1", "2", "3"]).chain)
    R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-6) R(2-6) R(5-7) R(3-7)
    """
    check_counting(chain)
    if isinstance(group, str):
        group = AssurGroup.parse(group)
    if len(at) != len(group.places):
        raise TransformationError(
            "the group has {count} outer joints; {given} places were given", count=len(group.places), given=len(at)
        )
    check_not_on_one_link(chain, at, message("group"))
    names = new_link_names(chain, len(group.links), links)
    new_names = dict(zip(group.links, names, strict=True))
    outside = dict(zip(group.places, at, strict=True))
    builder = ChainBuilder(chain)
    for joint in group.chain.joints:
        inner = [new_names[link] for link in joint.links if link in new_names]
        place = next((outside[link] for link in joint.links if link in outside), None)
        if place is None:
            builder.add(joint.pair, inner)
        else:
            builder.attach(place, joint.pair, inner)
    where = {"group": str(group), "at": list(at), "links": names}
    return Step("insert_group", where, chain, builder.done(names))


def remove_group(chain: Chain, links: Sequence[str]) -> Step:
    """Remove links that are an Assur group in the chain; F is unchanged.

    Raises `AssurError` if they are none, `TransformationError` if all its places are on one link or the remainder is
    not a chain.
    """
    check_counting(chain)
    if not links or len(set(links)) < len(links):
        raise TransformationError("expected the names of the links of a group, each once")
    for link in links:
        chain.index(link)
    group_links = set(links)
    joints, outside = [], []
    for joint in chain.joints:
        inner = [link for link in joint.links if link in group_links]
        others = [link for link in joint.links if link not in group_links]
        if inner and others:
            outside.append(set(others))
            place = f"place {len(outside)}"
            while place in group_links:
                place += "'"
            inner.append(place)
        if len(inner) > 1:
            joints.append((joint.pair, inner))
    if not outside:
        raise TransformationError("{links} are all the links of the chain", links=", ".join(links))
    with naming(message("{links} are not an Assur group", links=", ".join(links)), TransformationError):
        alone = Chain(joints, space=chain.space)
    AssurGroup(alone)
    shared = set.intersection(*outside)
    if shared:
        raise TransformationError(
            "the group is attached to the link {shared!r} alone: it is rigid against it", shared=min(shared)
        )
    return Step("remove_group", {"links": list(links)}, chain, without_links(chain, links)[0])
