"""The symmetry of a chain: its automorphisms and their orbits of links, joints and flags."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError
from gruebler.base.notebook import explained
from gruebler.base.text import translate
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism.colouring import ColouredGraph, DriveMark, coloured_graph

T = TypeVar("T", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Permutation:
    """The image of each link and each joint under an automorphism, by number."""

    links: tuple[int, ...]
    joints: tuple[int, ...]


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class Symmetry:
    """The automorphism group of a chain. Orbits are sorted tuples, in the order of their first member."""

    generators: tuple[Permutation, ...]
    order: int
    link_orbits: tuple[tuple[str, ...], ...]
    joint_orbits: tuple[tuple[int, ...], ...]
    flag_orbits: tuple[tuple[tuple[str, int], ...], ...]
    """A flag is a link with a joint that it carries."""

    def explain(self, lang: str = "en") -> str:
        """How many symmetries there are, and which links and joints are alike by them: English or German (``de``).

        >>> print(symmetry(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")))
        Symmetries: 2, the identity among them.
        Links that are alike: {0, 3}, {1, 2}.
        Joints that are alike, by number: {0, 2}, {1}, {3}.
        """
        links, joints = (
            ", ".join(f"{{{', '.join(map(str, each))}}}" for each in orbits)
            for orbits in (self.link_orbits, self.joint_orbits)
        )
        lines = (
            translate("Symmetries: {order}, the identity among them.", lang, order=self.order),
            translate("Links that are alike: {links}.", lang, links=links),
            translate("Joints that are alike, by number: {joints}.", lang, joints=joints),
        )
        return "\n".join(lines)


@door_that_raises(ChainError)
def symmetry(chain: Chain, *, frame: str | None = None, drives: Collection[int | DriveMark] = ()) -> Symmetry:
    """The automorphisms that keep space, pairs, a marked frame and marked joints.

    Args:
        chain: any chain.
        frame: a link that must be kept.
        drives: joints that must be kept as a set, by number or in part.

    Returns:
        `Symmetry`: ``order`` of the group, orbits of links, joints and flags, generators.

    Raises:
        ChainError: a frame or a drive that the chain does not have.

    Cost:
        As for the canonical code, plus O(generators · joint elements).

    Example:
        >>> four_bar = symmetry(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
        >>> four_bar.order, len(four_bar.link_orbits), len(four_bar.flag_orbits)
        (8, 1, 1)

    See Also:
        `code`, `inversions`

    Theory:
        docs/theory/canonical-code.md
    """
    from gruebler.structure.isomorphism.labelling import canonical_form

    graph = coloured_graph(chain, frame, drives)
    canonical_result = canonical_form(len(graph.vertex_colour), graph.vertex_colour, graph.edges, graph.edge_colour)
    generators = tuple(_permutation(chain, graph, [int(v) for v in image]) for image in canonical_result.generators)
    links = range(chain.n)
    joints = range(len(chain.joints))
    flags = sorted((chain.index(link), k) for k, joint in enumerate(chain.joints) for link in joint.links)
    on_flags = [{(i, k): (g.links[i], g.joints[k]) for i, k in flags} for g in generators]
    return Symmetry(
        generators=generators,
        order=canonical_result.order,
        link_orbits=tuple(
            tuple(chain.links[i] for i in orbit)
            for orbit in orbits(links, [dict(enumerate(g.links)) for g in generators])
        ),
        joint_orbits=tuple(orbits(joints, [dict(enumerate(g.joints)) for g in generators])),
        flag_orbits=tuple(tuple((chain.links[i], k) for i, k in orbit) for orbit in orbits(flags, on_flags)),
    )


def _permutation(chain: Chain, graph: ColouredGraph, image: list[int]) -> Permutation:
    joint_of_vertex = {vertex: number for number, vertex in graph.joint_vertex.items()}
    edge_joint = {
        frozenset(map(chain.index, joint.links)): number
        for number, joint in enumerate(chain.joints)
        if number not in graph.joint_vertex
    }
    joints = [
        joint_of_vertex[image[graph.joint_vertex[number]]]
        if number in graph.joint_vertex
        else edge_joint[frozenset(image[chain.index(link)] for link in joint.links)]
        for number, joint in enumerate(chain.joints)
    ]
    return Permutation(tuple(image[: chain.n]), tuple(joints))


def orbits(items: Iterable[T], maps: list[dict[T, T]]) -> list[tuple[T, ...]]:
    """The classes of items that the maps connect, each in the order of the items.

    >>> orbits([1, 2, 3], [{1: 2, 2: 1, 3: 3}])
    [(1, 2), (3,)]
    """
    elements = list(items)
    sets = DisjointSets(elements)
    for image in maps:
        for item in elements:
            sets.unite(item, image[item])
    return [tuple(members) for members in sets.classes()]
