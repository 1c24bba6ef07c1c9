"""Chains that fall apart at a link or at a joint, composed of the chains that do not.

Mobility adds up over the blocks of the link graph, and a chain is one of the enumeration exactly if each of its blocks
is one, with a mobility of at least 1, or a bridge (one joint between two links, F = 1) that does not end in a link
without another joint. So the fractionated chains are trees of blocks. Each is built once: from the rest by adding
its smallest leaf block, the block at one of its links, the rest at one of its own. Nothing is remembered.

Theorems and proofs: docs/theory/fractionation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

from gruebler.chain import Chain
from gruebler.isomorphism import code, symmetry

__all__ = ["BlockAddition", "Plain", "block_additions", "fractionated_chains"]

Plain = Callable[[int, int], Iterator[Chain]]
"""The chains of so many links and this mobility that do not fall apart, each once."""

_Edges = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class BlockAddition:
    """One way in which the last block can be added; the chains of different ones are different."""

    links: int
    mobility: int
    bridges: int
    """Number of bridges in the whole chain."""
    last_links: int
    last_mobility: int
    """The smallest leaf block."""


def block_additions(links: int, mobility: int, kind: str) -> list[BlockAddition]:
    """All the ways, as independent pieces of work.

    Args:
        links: number of links of the whole chain.
        mobility: F of the whole chain.
        kind: ``link``: some link separates the chain and no joint does; ``joint``: some joint does.

    >>> [(p.last_links, p.last_mobility) for p in block_additions(9, 2, "link")]
    [(4, 1)]
    """
    found = []
    for bridges in [0] if kind == "link" else range(1, mobility - 1):
        for h in range(4, (links + 1) // 2 + 1):
            for f in range(1, min(mobility - bridges - 1, h - 3) + 1):
                # The other leaf is not smaller, and blocks share one link where no bridge is between them.
                if (3 * (h - 1) - f) % 2 == 0:
                    found.append(BlockAddition(links, mobility, bridges, h, f))
    return found


def fractionated_chains(plain: Plain, links: int, mobility: int, kind: str) -> Iterator[Chain]:
    """The chains that fall apart at a link only (kind ``link``) or at some joint (``joint``), each once, lazily.

    `plain` gives the chains they are made of. Cost: about two canonical forms for each link at which a block can
    be added, and two for each chain found.
    """
    for part in block_additions(links, mobility, kind):
        for compound in composed(plain, part):
            yield compound.chain


def composed(plain: Plain, part: BlockAddition) -> Iterator[Compound]:
    """The chains of one piece of work."""
    blocks = _rooted(plain, part.last_links, part.last_mobility)
    links, mobility = part.links - part.last_links + 1, part.mobility - part.last_mobility
    yield from _attached(_compounds(plain, links, mobility, part.bridges, 1), blocks, 0)


@dataclass(frozen=True)
class Compound:
    """A tree of blocks; links are 0, 1, 2, ..."""

    links: int
    edges: _Edges
    blocks: tuple[frozenset[int], ...]

    @cached_property
    def chain(self) -> Chain:
        """The chain itself."""
        return Chain([("revolute", edge) for edge in self.edges], links=range(self.links))

    @cached_property
    def places(self) -> list[int]:
        """One link of each orbit."""
        return [int(orbit[0]) for orbit in symmetry(self.chain).link_orbits]

    @cached_property
    def leaves(self) -> dict[int, int]:
        """The number of each leaf block, and the one link that it shares with others; a block alone has none."""
        found = {}
        for k, block in enumerate(self.blocks):
            shared = [v for v in block if any(v in other for m, other in enumerate(self.blocks) if m != k)]
            if len(shared) == 1:
                found[k] = shared[0]
        return found

    def open_bridges(self) -> int:
        """How many bridges end in a link that carries no other joint."""
        return sum(len(self.blocks[k]) == 2 for k in self.leaves)

    def inside(self, k: int) -> _Edges:
        """The edges of one block; two blocks never share two links."""
        block = self.blocks[k]
        return tuple((a, b) for a, b in self.edges if a in block and b in block)

    def outside(self, k: int) -> _Edges:
        """The edges of all other blocks."""
        block = self.blocks[k]
        return tuple((a, b) for a, b in self.edges if a not in block or b not in block)


@dataclass(frozen=True, slots=True)
class _Rooted:
    """A block with the link at which it is to be attached; links are 0, 1, 2, ..."""

    links: int
    edges: _Edges
    root: int
    code: str


_BRIDGE = _Rooted(2, ((0, 1),), 0, "")


def _rooted(plain: Plain, links: int, mobility: int) -> list[_Rooted]:
    found = []
    for chain in plain(links, mobility):
        edges = _edges(chain)
        found += [
            _Rooted(links, edges, chain.index(orbit[0]), code(chain, frame=orbit[0]))
            for orbit in symmetry(chain).link_orbits
        ]
    return found


def _edges(chain: Chain) -> _Edges:
    return tuple((chain.index(a), chain.index(b)) for a, b in (joint.links for joint in chain.joints))


def _compounds(plain: Plain, links: int, mobility: int, bridges: int, most_open: int) -> Iterator[Compound]:
    """All trees of blocks with so many bridges, at most a few of them open, each once.

    An open bridge, one that ends in a link without another joint, is the smallest leaf a tree can have.
    """
    if mobility < 1 or links < 4:
        return
    if bridges == 0:
        for chain in plain(links, mobility):
            yield Compound(links, _edges(chain), (frozenset(range(links)),))
    elif most_open:
        rest = _compounds(plain, links - 1, mobility - 1, bridges - 1, most_open)
        yield from _attached(rest, [_BRIDGE], most_open)
    for h in range(4, links - 2):
        for f in range(1, mobility):
            blocks = _rooted(plain, h, f) if (3 * (h - 1) - f) % 2 == 0 else []
            if blocks:
                yield from _attached(_compounds(plain, links - h + 1, mobility - f, bridges, 1), blocks, 0)


def _attached(rest: Iterator[Compound], blocks: list[_Rooted], most_open: int) -> Iterator[Compound]:
    """The compounds whose smallest leaf is one of these blocks, what is left without it being one of the rest."""
    for old in rest:
        for place in old.places:
            for block in blocks:
                new = _joined(old, place, block)
                if new.open_bridges() <= most_open and _is_smallest(new, block.code):
                    yield new


def _joined(old: Compound, place: int, block: _Rooted) -> Compound:
    """Both with the root of the block on a link; the block is the last one of the new compound."""
    name = {block.root: place}
    for v in range(block.links):
        if v != block.root:
            name[v] = old.links + len(name) - 1
    edges = tuple((name[a], name[b]) for a, b in block.edges)
    return Compound(old.links + block.links - 1, old.edges + edges, (*old.blocks, frozenset(name.values())))


def _is_smallest(compound: Compound, rooted_code: str) -> bool:
    """Whether no leaf comes before the last block, by size, then rooted code, then the code of the rest.

    Two leaves equal in all three are exchanged by an automorphism, so the compound has one smallest leaf up to that.
    """
    last = len(compound.blocks) - 1
    size = _size(compound, last)
    rest: str | None = None
    for k, shared in compound.leaves.items():
        if k == last or (other := _size(compound, k)) > size:
            continue
        if other < size:
            return False
        other_code = "" if size[0] == 2 else _code(compound.inside(k), shared)
        if other_code > rooted_code:
            continue
        if other_code < rooted_code:
            return False
        if rest is None:
            rest = _code(compound.outside(last), compound.leaves[last])
        if _code(compound.outside(k), shared) < rest:
            return False
    return True


def _size(compound: Compound, k: int) -> tuple[int, int]:
    links = len(compound.blocks[k])
    return links, 3 * (links - 1) - 2 * len(compound.inside(k))


def _code(edges: _Edges, root: int) -> str:
    return code(Chain([("revolute", edge) for edge in edges]), frame=str(root))
