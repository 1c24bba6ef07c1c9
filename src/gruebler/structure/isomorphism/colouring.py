"""A chain as a coloured graph, such that chains of the same structure are isomorphic graphs and the other way round.

Every link is a vertex. A joint of two links is an edge, coloured by its pair and by whether it is driven; a
joint of more links, or one that repeats between the same two links, is a vertex of its own with an edge to each
of its links, so that automorphisms can exchange such joints. A marked frame is a link of another colour. A mark on a
part of a joint (one of its freedoms, two of its links) is a vertex too, with an edge to the joint's vertex and to those
links.
docs/theory/canonical-code.md has the definition.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import compared_by_value
from gruebler.base.errors import expect
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Freedom

_FRAME, _LINK, _FIRST_JOINT = 0, 1, 2
_INCIDENCE = 0
_PLACE = {pair: k for k, pair in enumerate(PAIRS)}
_FIRST_MARK = _FIRST_JOINT + 2 * len(PAIRS)
_DIRECTIONS = ("", *Freedom)


@dataclass(frozen=True, slots=True)
class DriveMark:
    """A mark on a part of a joint: one of several freedoms, between two of more links."""

    joint: int
    """The joint's number."""
    direction: str = ""
    """The freedom, such as ``Tz``; empty where the joint has one only."""
    between: tuple[str, ...] = ()
    """The two links, in any order; empty where the joint has no others."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True)
class ColouredGraph:
    """Vertices 0 to n - 1 are the links, the others joints, then marks on parts of joints."""

    vertex_colour: NDArray[np.int64]
    edges: NDArray[np.int32]
    edge_colour: NDArray[np.int32]
    joint_vertex: dict[int, int]
    """Joint number -> vertex, for the joints that are vertices."""


def coloured_graph(chain: Chain, frame: str | None = None, drives: Collection[int | DriveMark] = ()) -> ColouredGraph:
    """The coloured graph of a chain with a marked frame and marked (driven) joints or parts of joints.

    Raises `ChainError` for a frame or a joint number that the chain does not have. Cost O(joint elements).
    """
    expect(chain, Chain)
    marks = [mark for mark in drives if isinstance(mark, DriveMark)]
    partly = {mark.joint for mark in marks}
    for number in (*partly, *(number for number in drives if isinstance(number, int))):
        chain.joint_number(number)
    repeats = Counter(frozenset(joint.links) for joint in chain.joints)
    colours = [_LINK] * chain.n
    if frame is not None:
        colours[chain.index(frame)] = _FRAME
    edges: list[tuple[int, int]] = []
    edge_colours: list[int] = []
    joint_vertex: dict[int, int] = {}
    for number, joint in enumerate(chain.joints):
        kind = 2 * _PLACE[joint.pair] + (number in drives)
        links = [chain.index(link) for link in joint.links]
        if len(links) == 2 and repeats[frozenset(joint.links)] == 1 and number not in partly:
            edges.append((links[0], links[1]))
            edge_colours.append(1 + kind)
        else:
            joint_vertex[number] = len(colours)
            edges += [(link, len(colours)) for link in links]
            edge_colours += [_INCIDENCE] * len(links)
            colours.append(_FIRST_JOINT + kind)
    for mark in marks:
        ends = (joint_vertex[mark.joint], *map(chain.index, mark.between))
        edges += [(end, len(colours)) for end in ends]
        edge_colours += [_INCIDENCE] * len(ends)
        colours.append(_FIRST_MARK + _DIRECTIONS.index(mark.direction))
    return ColouredGraph(
        np.array(colours, np.int64),
        np.array(edges, np.int32).reshape(-1, 2),
        np.array(edge_colours, np.int32),
        joint_vertex,
    )
