"""The canonical code: one text for each structure, equal if and only if the structures are the same.

    code  = "gr1:" text [ ";frame=" link ] [ ";drives=" drive { "," drive } ]
    drive = joint [ ":" direction ] [ ":" link "-" link ]

The text is the chain's own notation with its links numbered canonically and its joints sorted, without blanks;
links and joints count from 0. A drive names the direction where its joint has several freedoms, and two links where it
has more. The prefix names the version: a code of another version is refused, since its
numbering may differ.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError, NotationError
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.isomorphism.colouring import DriveMark, coloured_graph

CODE_PREFIX = "gr1:"


@dataclass(frozen=True, slots=True)
class MarkedChain:
    """A chain with a marked frame and marked joints or parts of joints, as a code describes it."""

    chain: Chain
    frame: str | None
    drives: tuple[int | DriveMark, ...]


class Order(NamedTuple):
    """The canonical order of a chain's links and joints, as numbers of the chain."""

    links: tuple[int, ...]
    joints: tuple[int, ...]


def canonical_order(chain: Chain, frame: str | None = None, drives: Collection[int | DriveMark] = ()) -> Order:
    """Links and joints in canonical order: for chains of the same structure the k-th ones correspond.

    Exact for every chain. Cost: microseconds for usual chains; see docs/theory/canonical-code.md.
    """
    from gruebler.structure.isomorphism.labelling import canonical_form

    graph = coloured_graph(chain, frame, drives)
    place = canonical_form(len(graph.vertex_colour), graph.vertex_colour, graph.edges, graph.edge_colour).labelling
    links = sorted(range(chain.n), key=lambda link: (graph.vertex_colour[link], place[link]))
    rank = {chain.links[link]: k for k, link in enumerate(links)}

    def key(number: int) -> tuple[list[int], str, bool, int]:
        joint = chain.joints[number]
        vertex = graph.joint_vertex.get(number)
        again = 0 if vertex is None else int(place[vertex])
        return sorted(rank[link] for link in joint.links), joint.pair.name, number in drives, again

    return Order(tuple(links), tuple(sorted(range(len(chain.joints)), key=key)))


@door_that_raises(ChainError)
def code(chain: Chain, *, frame: str | None = None, drives: Collection[int | DriveMark] = ()) -> str:
    """The canonical code of a chain, optionally with a marked frame and marked joints (drives, by number or in part).

    Args:
        chain: any chain.
        frame: a link that is marked.
        drives: joints that are marked, by number or in part.

    Returns:
        A text that two chains share exactly if they are isomorphic, marks included; `decode` reads it.

    Raises:
        ChainError: a frame or a drive that the chain does not have.

    Cost:
        Some milliseconds for ten links; exponential only for highly regular chains of many links.

    Example:
        >>> code(Chain.parse("R(a-b) R(b-c) R(c-d) R(d-a)")) == code(Chain.parse("R(1-3) R(3-2) R(2-4) R(4-1)"))
        True
        >>> code(Chain.parse("R(a-b) R(b-c) P(c-a)"))
        'gr1:R(0-1)R(0-2)P(1-2)'

    See Also:
        `decode`, `is_isomorphic`, `symmetry`

    Theory:
        docs/theory/canonical-code.md
    """
    order = canonical_order(chain, frame, drives)
    rank = {chain.links[link]: str(k) for k, link in enumerate(order.links)}
    joints = [
        Joint(chain.joints[k].pair, tuple(sorted((rank[link] for link in chain.joints[k].links), key=int)))
        for k in order.joints
    ]
    text = Chain(joints, space=chain.space).text().replace(" ", "")
    marks = "" if frame is None else f";frame={rank[frame]}"
    place = {number: k for k, number in enumerate(order.joints)}
    written = sorted(_mark(drive, place, rank) for drive in drives)
    if written:
        marks += f";drives={','.join(mark for _, mark in written)}"
    return CODE_PREFIX + text + marks


def _mark(drive: int | DriveMark, place: Mapping[int, int], rank: Mapping[str, str]) -> tuple[int, str]:
    """A drive's joint in canonical order, and its text."""
    if not isinstance(drive, DriveMark):
        return place[drive], str(place[drive])
    links = "-".join(sorted((rank[link] for link in drive.between), key=int))
    return place[drive.joint], ":".join(part for part in (str(place[drive.joint]), drive.direction, links) if part)


@door_that_raises(ChainError)
def decode(text: str) -> MarkedChain:
    """The chain, frame and marked joints that a code describes; links are named 0, 1, 2, ...

    Any text of the form of a code is read, canonical or not; `NotationError` for anything else.

    Args:
        text: a code, canonical or not.

    Returns:
        `MarkedChain`: ``chain``, ``frame`` and ``drives``.

    Raises:
        NotationError: a text that has not the form of a code.

    Cost:
        Some milliseconds for ten links.

    Example:
        >>> decode("gr1:R(0-1)R(0-2)R(1-3)R(2-3);frame=0").chain.n
        4

    See Also:
        `code`, `Chain`

    Theory:
        docs/theory/canonical-code.md
    """
    prefix = re.match(r"gr(\d+):", text)
    if prefix is None or prefix[0] != CODE_PREFIX:
        raise NotationError("a code begins with {prefix!r}, not with {found!r}", prefix=CODE_PREFIX, found=text[:8])
    body, *marks = text[len(CODE_PREFIX) :].split(";")
    chain = Chain.parse(body)
    ordered = sorted((_number(link), link) for link in chain.links)
    chain = Chain(chain.joints, links=[link for _, link in ordered], space=chain.space)
    frame: str | None = None
    drives: tuple[int | DriveMark, ...] = ()
    for mark in marks:
        if match := re.fullmatch(r"frame=(\d+)", mark):
            frame = match[1]
            chain.index(frame)
        elif re.fullmatch(rf"drives={_DRIVE}(?:,{_DRIVE})*", mark):
            drives = tuple(_drive(chain, text) for text in mark.removeprefix("drives=").split(","))
        else:
            raise NotationError(
                "{mark!r} is not a mark of a code: expected frame=LINK or drives=JOINT,JOINT", mark=mark
            )
    return MarkedChain(chain, frame, drives)


_DRIVE = r"\d+(?::[RTH][xyz])?(?::\d+-\d+)?"


def _drive(chain: Chain, text: str) -> int | DriveMark:
    joint, *parts = text.split(":")
    if int(joint) >= len(chain.joints):
        raise NotationError(
            "'drives={drives}': the code has joints 0 to {count}", drives=text, count=len(chain.joints) - 1
        )
    direction = "".join(part for part in parts if "-" not in part)
    links = tuple(link for part in parts if "-" in part for link in part.split("-"))
    if not set(links) <= set(chain.joints[int(joint)].links):
        raise NotationError(
            "'drives={drives}': joint {number} is {joint}", drives=text, number=joint, joint=chain.joints[int(joint)]
        )
    return DriveMark(int(joint), direction, links) if parts else int(joint)


def _number(link: str) -> int:
    if not link.isascii() or not link.isdigit():
        raise NotationError("the links of a code are numbers, not {link!r}", link=link)
    return int(link)
