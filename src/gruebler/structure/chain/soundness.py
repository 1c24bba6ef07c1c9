"""Checks of a chain's input: names, joints, links and connectedness. Each fault raises a `ChainError`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from numbers import Integral

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import ChainError, PairError, unknown
from gruebler.base.text import Message, joined, message
from gruebler.structure.chain.joint import Joint
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.chain.spaces import Space

_LONGEST_NAME = 200
_MOST_NAMES = 5


def checked_joints(raw: Iterable[Joint | tuple[str | Pair, Sequence[str | int]]], space: Space) -> tuple[Joint, ...]:
    """The joints of raw input, checked."""
    if isinstance(raw, str | bytes | Mapping) or not isinstance(raw, Iterable):
        raise _no_joint(raw)
    return tuple(_checked_joint(joint, space) for joint in raw)


def checked_edges(edges: Iterable[tuple[str | int, str | int]]) -> list[tuple[str, str]]:
    """The two names of each edge."""
    if isinstance(edges, str | bytes) or not isinstance(edges, Iterable):
        raise _no_edge(edges)
    named = []
    for edge in edges:
        if isinstance(edge, str | bytes) or not isinstance(edge, Iterable):
            raise _no_edge(edge)
        ends = tuple(edge)
        if len(ends) != 2 or not all(_is_name(end) for end in ends):
            raise _no_edge(ends)
        named.append((_name(ends[0]), _name(ends[1])))
    return named


def _no_joint(raw: object) -> ChainError:
    return ChainError(
        "expected joints, each a pair and the names of its links, not {found}; Chain.parse reads a text, "
        "Chain.from_edges takes edges, Chain.from_networkx a graph",
        found=repr(raw),
    )


def _no_edge(raw: object) -> ChainError:
    return ChainError(
        "expected edges, each two names of links, not {found}; Chain.from_networkx takes a graph with its pairs",
        found=repr(raw),
    )


def _checked_joint(raw: Joint | tuple[str | Pair, Sequence[str | int]], space: Space) -> Joint:
    """The joint of raw input, checked."""
    match raw:
        case Joint(Pair() as kind, links) | (str() | Pair() as kind, links) if isinstance(links, Iterable):
            pass
        case _:
            raise _no_joint(raw)
    if isinstance(links, str):
        raise ChainError("the links of a joint are a list of names, not the text {links!r}", links=links)
    joint = Joint(kind if isinstance(kind, Pair) else pair(kind), tuple(_name(link) for link in links))
    if len(joint.links) < 2:
        raise ChainError(
            "the joint {joint} has {links}; a joint joins at least two", joint=joint, links=_links(len(joint.links))
        )
    if len(set(joint.links)) < len(joint.links):
        twice = next(link for link, k in Counter(joint.links).items() if k > 1)
        raise ChainError(
            "the joint {joint} names the link {twice!r} twice; a joint joins different links", joint=joint, twice=twice
        )
    if space not in joint.pair.freedoms:
        try:
            joint.pair.f(space)
        except PairError as error:
            raise PairError("the joint {joint} is not possible: {error}", joint=joint, error=error) from None
    if len(joint.links) > 2 and not joint.pair.is_group:
        raise ChainError(
            "the joint {joint} has {count} links, but a {name} joint ({german}) joins exactly two: such "
            "relative motions do not compose; write one joint for each contact",
            joint=joint,
            count=len(joint.links),
            name=joint.pair.name,
            german=joint.pair.german,
        )
    return joint


def _is_name(raw: object) -> bool:
    """Whether it is a text or a whole number; those of numpy are."""
    return isinstance(raw, str | Integral) and not isinstance(raw, bool)


def _name(raw: str | int) -> str:
    if not _is_name(raw):
        raise ChainError("a link is named by a text or a whole number, not by {name!r}", name=raw)
    name = str(raw)
    if not name.strip() or name != name.strip() or not name.isprintable():
        raise ChainError(
            "{name!r} cannot name a link: a name has visible characters and no blank at its ends", name=name
        )
    if len(name) > _LONGEST_NAME:
        raise ChainError(
            "the link name {name!r}... has {count} characters; at most {most}",
            name=name[:20],
            count=len(name),
            most=_LONGEST_NAME,
        )
    return name


def checked_links(links: Iterable[str | int], named: tuple[str, ...], joints: tuple[Joint, ...]) -> tuple[str, ...]:
    """The names of the links, which must be those that the joints name."""
    if not isinstance(links, Iterable):
        raise ChainError("links: expected a list of names, not {raw}", raw=repr(links))
    declared = tuple(_name(link) for link in links)
    known, joined = set(declared), set(named)
    if len(known) < len(declared):
        twice = next(link for link, k in Counter(declared).items() if k > 1)
        raise ChainError("two links are called {twice!r}; every link needs a name of its own", twice=twice)
    stranger = next((link for link in named if link not in known), None)
    if stranger is not None:
        where = next(j for j in joints if stranger in j.links)
        raise ChainError(
            "the joint {joint} names the link {word!r}, which is not among the links{suggestion}",
            joint=where,
            **unknown(stranger, declared),
        )
    lonely = next((link for link in declared if link not in joined), None)
    if lonely is not None:
        raise ChainError("the link {lonely!r} has no joint; every link of a chain carries at least one", lonely=lonely)
    return declared


def check_connected(links: tuple[str, ...], joints: tuple[Joint, ...]) -> None:
    """Raise `ChainError` for a chain that is too small or has several parts."""
    if len(links) < 3:
        raise ChainError("a kinematic chain has at least three links, this one has {links}", links=_links(len(links)))
    sets = DisjointSets(links)
    for j in joints:
        for other in j.links[1:]:
            sets.unite(j.links[0], other)
    parts = sets.classes()
    if len(parts) > 1:
        sizes = sorted(parts, key=len)
        raise ChainError(
            "the chain falls into {count} parts: no joint connects {links} with the others",
            count=len(parts),
            links=_some(sizes[0]),
        )


def _links(count: int) -> Message:
    if count == 1:
        return message("one link")
    return message("{count} links", count=count) if count else message("no links")


def _some(names: Sequence[str]) -> Message:
    shown = ", ".join(names[:_MOST_NAMES])
    if len(names) <= _MOST_NAMES:
        return joined([shown])
    return message("{names} and {count} more", names=shown, count=len(names) - _MOST_NAMES)
