"""Dyads and couplers: inserted between two places of a chain, and removed.

A dyad (two links, three joints of one freedom) keeps F, a coupler (one link, two such joints) lowers it by one.
docs/theory/transformations.md says when generic mobility follows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gruebler.base.errors import TransformationError
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.structure.assur import DYADS
from gruebler.structure.chain import Chain
from gruebler.structure.transformations.places import (
    Attachment,
    ChainBuilder,
    check_counting,
    check_not_on_one_link,
    letters_of_pairs,
    new_link_names,
    pairs_from_letters,
    without_links,
)
from gruebler.structure.transformations.steps import Step


@dataclass(frozen=True, slots=True)
class Insertion:
    """The insertion that restores a removed dyad or coupler: pairs as letters, places, names of the links."""

    letters: str
    between: tuple[Attachment, Attachment]
    links: tuple[str, ...]
    remainder: Chain
    """The chain without it."""


def insert_dyad(chain: Chain, form: str, between: Sequence[Attachment], links: Sequence[str] | None = None) -> Step:
    """Insert a dyad between two places; F is unchanged.

    Args:
        chain: a planar or spherical chain.
        form: RRR, RRP (or PRR), RPR, PRP, RPP (or PPR), read from the first place to the second.
        between: two places: names of links, or numbers of joints that the dyad's end joins.
        links: names of the two new links; by default the lowest free numbers.

    Raises `TransformationError` for another form, and for places on one link.

    >>> watt = insert_dyad(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "RRR", ["2", "3"])
    >>> print(watt.chain)
    R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)
    """
    check_counting(chain)
    first, middle, last = pairs_from_letters(form, 3, message("dyad"))
    letters = letters_of_pairs((first, middle, last))
    if letters not in DYADS and letters not in {dyad[::-1] for dyad in DYADS}:
        raise TransformationError("{form!r} is not a dyad; the forms are {dyads}", form=form, dyads=", ".join(DYADS))
    start, end = _two(between)
    check_not_on_one_link(chain, [start, end], message("dyad"))
    x, y = new_link_names(chain, 2, links)
    builder = ChainBuilder(chain)
    builder.attach(start, first, [x])
    builder.add(middle, [x, y])
    builder.attach(end, last, [y], last=True)
    where = {"form": letters, "between": [start, end], "links": [x, y]}
    return Step("insert_dyad", where, chain, builder.done([x, y]))


def remove_dyad(chain: Chain, links: Sequence[str]) -> Step:
    """Remove two links that are a dyad: binary, joined to one another, their ends on different links.

    Raises `TransformationError` if they are not, or if the remainder is not a chain.

    >>> print(remove_dyad(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"), ["4", "5"]).chain)
    R(0-1) R(1-2) R(2-3) R(3-0)
    """
    insertion = dyad_at(chain, links)
    return Step("remove_dyad", {"links": list(links)}, chain, insertion.remainder)


def insert_coupler(chain: Chain, between: Sequence[Attachment], pairs: str = "RR", link: str | None = None) -> Step:
    """Insert a binary link between two places; F falls by one.

    Args:
        chain: a planar or spherical chain.
        between: two places: names of links, or numbers of joints that the coupler's end joins.
        pairs: its joints, each R, P or W, read from the first place to the second.
        link: the name of the new link; by default the lowest free number.

    >>> print(insert_coupler(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"), ["1", "4"]).chain)
    R(0-1) R(1-2) R(2-3) R(3-4) R(4-0) R(1-5) R(5-4)
    """
    check_counting(chain)
    first, last = pairs_from_letters(pairs, 2, message("coupler"))
    start, end = _two(between)
    check_not_on_one_link(chain, [start, end], message("coupler"))
    (x,) = new_link_names(chain, 1, None if link is None else [link])
    builder = ChainBuilder(chain)
    builder.attach(start, first, [x])
    builder.attach(end, last, [x], last=True)
    where = {"between": [start, end], "pairs": letters_of_pairs((first, last)), "link": x}
    return Step("insert_coupler", where, chain, builder.done([x]))


def remove_coupler(chain: Chain, link: str) -> Step:
    """Remove a binary link whose joints have one freedom each and lead to different links; F rises by one.

    >>> print(remove_coupler(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-2)"), "4").chain)
    R(0-1) R(1-2) R(2-3) R(3-0)
    """
    return Step("remove_coupler", {"link": link}, chain, coupler_at(chain, link).remainder)


def dyad_at(chain: Chain, links: Sequence[str]) -> Insertion:
    """The insertion that restores the dyad of these two links; `TransformationError` if they are not a dyad."""
    check_counting(chain)
    if len(links) != 2:
        raise TransformationError("a dyad has two links, not {count}", count=len(links))
    x, y = links
    joints = {link: _two_joints(chain, link, "dyad") for link in (x, y)}
    middle = [k for k in joints[x] if k in joints[y]]
    if len(middle) != 1 or chain.joints[middle[0]].count != 1:
        raise TransformationError(
            "{x} and {y} are not a dyad: they must share just one joint, and it must be simple", x=x, y=y
        )
    (first,) = (k for k in joints[x] if k not in middle)
    (last,) = (k for k in joints[y] if k not in middle)
    letters = letters_of_pairs(chain.joints[k].pair for k in (first, middle[0], last))
    if letters not in DYADS and (letters or "")[::-1] not in DYADS:
        kinds = joined(chain.joints[k].pair.title for k in (first, middle[0], last))
        raise TransformationError(
            "{x} and {y} are not a dyad: its forms are {dyads}, these joints are {kinds}",
            x=x,
            y=y,
            dyads=", ".join(DYADS),
            kinds=kinds,
        )
    return _insertion(chain, letters or "", (x, y), (first, last))


def coupler_at(chain: Chain, link: str) -> Insertion:
    """The insertion that restores this coupler; `TransformationError` if it is none."""
    check_counting(chain)
    first, last = _two_joints(chain, link, "coupler")
    letters = letters_of_pairs(chain.joints[k].pair for k in (first, last))
    if letters is None:
        kinds = joined_by_and([chain.joints[k].pair.title for k in (first, last)])
        raise TransformationError(
            "{link} is not a coupler: its joints must have one freedom each, and they are {kinds}",
            link=link,
            kinds=kinds,
        )
    return _insertion(chain, letters, (link,), (first, last))


def _insertion(chain: Chain, letters: str, links: tuple[str, ...], ends: tuple[int, int]) -> Insertion:
    spread_links = [[a for a in chain.joints[k].links if a not in links] for k in ends]
    shared = next((a for a in spread_links[0] if a in spread_links[1]), None)
    if shared is not None:
        raise TransformationError(
            "{links} is not a coupler between different links: both ends are on {shared!r}"
            if len(links) == 1
            else "{links} are not a dyad between different links: both ends are on {shared!r}",
            links=joined_by_and(links),
            shared=shared,
        )
    remainder, number = without_links(chain, links)
    places: list[Attachment] = [
        outside[0] if len(outside) == 1 else number[k] for k, outside in zip(ends, spread_links, strict=True)
    ]
    return Insertion(letters, (places[0], places[1]), links, remainder)


def _two_joints(chain: Chain, link: str, thing: str) -> tuple[int, int]:
    chain.index(link)
    numbers = [k for k, joint in enumerate(chain.joints) if link in joint.links]
    if len(numbers) != 2:
        raise TransformationError(
            "{link} cannot be a coupler: it carries {joints}, not two"
            if thing == "coupler"
            else "{link} cannot belong to a dyad: it carries {joints}, not two",
            link=link,
            joints=_joints(len(numbers)),
        )
    return numbers[0], numbers[1]


def _joints(count: int) -> Message:
    return message("one joint") if count == 1 else message("{count} joints", count=count)


def _two(between: Sequence[Attachment]) -> tuple[Attachment, Attachment]:
    if isinstance(between, str) or len(between) != 2:
        raise TransformationError("expected two places: names of links or numbers of joints")
    return between[0], between[1]
