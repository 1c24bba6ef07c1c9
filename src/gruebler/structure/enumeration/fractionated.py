"""Chains that fall apart at a link or at a joint, composed of the chains that do not.

Mobility adds up over the blocks of the link graph. The enumeration contains a chain exactly if each of its blocks
is an enumerated chain of mobility at least 1, or a bridge (one joint between two links, F = 1) that does not end in a
link without another joint. So the fractionated chains are trees of blocks. Each is built once, by adding its smallest
leaf block to the remainder: a link of the block is identified with a link of the remainder. Nothing is stored.

Theorems and proofs: docs/theory/fractionation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import code, symmetry

Plain = Callable[[int, int], Iterator[Chain]]
"""The chains of given links and mobility that are not fractionated, each once."""

_Edges = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockAddition:
    """Sizes of the chain and of its last block; different sizes give different chains."""

    links: int
    mobility: int
    bridges: int
    """Number of bridges in the chain."""
    last_links: int
    last_mobility: int
    """The smallest leaf block."""


def block_additions(links: int, mobility: int, kind: str) -> list[BlockAddition]:
    """All sizes of the last block, as independent pieces of work.

    Args:
        links: number of links of the chain.
        mobility: F of the chain.
        kind: ``link``: some link separates the chain and no joint does; ``joint``: some joint does.

    >>> [(p.last_links, p.last_mobility) for p in block_additions(9, 2, "link")]
    [(4, 1)]
    """
    additions = []
    for bridges in [0] if kind == "link" else range(1, mobility - 1):
        for h in range(4, (links + 1) // 2 + 1):
            for f in range(1, min(mobility - bridges - 1, h - 3) + 1):
                # The other leaf is not smaller, and blocks share one link where no bridge is between them.
                if (3 * (h - 1) - f) % 2 == 0:
                    additions.append(
                        BlockAddition(links=links, mobility=mobility, bridges=bridges, last_links=h, last_mobility=f)
                    )
    return additions


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
        shared_links = {}
        for k, block in enumerate(self.blocks):
            shared = [v for v in block if any(v in other for m, other in enumerate(self.blocks) if m != k)]
            if len(shared) == 1:
                shared_links[k] = shared[0]
        return shared_links

    def open_bridges(self) -> int:
        """The number of bridges that end in a link without another joint."""
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
    rooted_blocks = []
    for chain in plain(links, mobility):
        edges = edges_of(chain)
        rooted_blocks += [
            _Rooted(links, edges, chain.index(orbit[0]), code(chain, frame=orbit[0]))
            for orbit in symmetry(chain).link_orbits
        ]
    return rooted_blocks


def edges_of(chain: Chain) -> _Edges:
    """The two links of each joint, by number; all joints simple."""
    return tuple((chain.index(a), chain.index(b)) for a, b in (joint.links for joint in chain.joints))


def _compounds(plain: Plain, links: int, mobility: int, bridges: int, most_open: int) -> Iterator[Compound]:
    """All trees of blocks with this number of bridges, at most `most_open` of them open, each once.

    An open bridge, one that ends in a link without another joint, is the smallest leaf a tree can have.
    """
    if mobility < 1 or links < 4:
        return
    if bridges == 0:
        for chain in plain(links, mobility):
            yield Compound(links, edges_of(chain), (frozenset(range(links)),))
    elif most_open:
        remainders = _compounds(plain, links - 1, mobility - 1, bridges - 1, most_open)
        yield from _attached(remainders, [_BRIDGE], most_open)
    for h in range(4, links - 2):
        for f in range(1, mobility):
            blocks = _rooted(plain, h, f) if (3 * (h - 1) - f) % 2 == 0 else []
            if blocks:
                yield from _attached(_compounds(plain, links - h + 1, mobility - f, bridges, 1), blocks, 0)


def _attached(remainders: Iterator[Compound], blocks: list[_Rooted], most_open: int) -> Iterator[Compound]:
    """The compounds whose smallest leaf is one of these blocks and whose remainder is one of `remainders`."""
    for remainder in remainders:
        for place in remainder.places:
            for block in blocks:
                compound = _joined(remainder, place, block)
                if compound.open_bridges() <= most_open and _is_smallest(compound, block.code):
                    yield compound


def _joined(old: Compound, place: int, block: _Rooted) -> Compound:
    """The remainder with the root of the block on one of its links; the block is the last of the new compound."""
    name = {block.root: place}
    for v in range(block.links):
        if v != block.root:
            name[v] = old.links + len(name) - 1
    edges = tuple((name[a], name[b]) for a, b in block.edges)
    return Compound(old.links + block.links - 1, old.edges + edges, (*old.blocks, frozenset(name.values())))


def _is_smallest(compound: Compound, rooted_code: str) -> bool:
    """Whether no leaf comes before the last block, by size, then rooted code, then the code of the remainder.

    An automorphism exchanges two leaves that are equal in all three, so the smallest leaf is unique up to symmetry.
    """
    last = len(compound.blocks) - 1
    size = _size(compound, last)
    rest_code: str | None = None
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
        if rest_code is None:
            rest_code = _code(compound.outside(last), compound.leaves[last])
        if _code(compound.outside(k), shared) < rest_code:
            return False
    return True


def _size(compound: Compound, k: int) -> tuple[int, int]:
    links = len(compound.blocks[k])
    return links, 3 * (links - 1) - 2 * len(compound.inside(k))


def _code(edges: _Edges, root: int) -> str:
    return code(Chain([("revolute", edge) for edge in edges]), frame=str(root))
