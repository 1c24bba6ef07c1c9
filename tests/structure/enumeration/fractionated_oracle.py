"""The number of chains that fall apart at a link or at a joint, without building them: Pólya's theorem on block trees.

The tree of the links and the blocks of a chain has one more vertices than edges, and so have the orbits of its
symmetry, so that chains = (chains with a link marked) + (with a block marked) - (with both, the link in the block).
Each of the three is a sum over the blocks of cycle indices, into which the series of the subtrees at a link is
substituted.
docs/theory/fractionation.md has the equations. Sources: G. Pólya, Acta Math. 68 (1937); R. Otter, Ann. Math. 49
(1948) for the difference; R. Z. Norman and F. Harary for blocks (Harary and Palmer, Graphical Enumeration, 1973).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from math import factorial

from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import symmetry

Types = Mapping[tuple[int, ...], Fraction]
"""Cycle lengths of automorphisms on the links, ascending -> number of automorphisms divided by the group's order,
summed over chains."""


class CountSeries:
    """A polynomial in x (one for each link) and y (one for each freedom), cut off at given powers.

    >>> s = CountSeries({(0, 0): Fraction(1), (1, 1): Fraction(2)}, 3, 2)
    >>> sorted((s * s).terms.items())
    [((0, 0), Fraction(1, 1)), ((1, 1), Fraction(4, 1)), ((2, 2), Fraction(4, 1))]
    """

    def __init__(self, terms: Mapping[tuple[int, int], Fraction], links: int, mobility: int) -> None:
        self.links = links
        self.mobility = mobility
        self.terms = {(n, f): c for (n, f), c in terms.items() if c and n <= links and f <= mobility}

    def __add__(self, other: CountSeries) -> CountSeries:
        total = dict(self.terms)
        for power, c in other.terms.items():
            total[power] = total.get(power, Fraction(0)) + c
        return CountSeries(total, self.links, self.mobility)

    def __sub__(self, other: CountSeries) -> CountSeries:
        return self + other.scaled(Fraction(-1))

    def __mul__(self, other: CountSeries) -> CountSeries:
        total: dict[tuple[int, int], Fraction] = {}
        for (n, f), c in self.terms.items():
            for (m, g), d in other.terms.items():
                if n + m <= self.links and f + g <= self.mobility:
                    total[n + m, f + g] = total.get((n + m, f + g), Fraction(0)) + c * d
        return CountSeries(total, self.links, self.mobility)

    def scaled(self, factor: Fraction) -> CountSeries:
        """The series times a number."""
        return CountSeries({power: factor * c for power, c in self.terms.items()}, self.links, self.mobility)

    def shifted(self, links: int, mobility: int) -> CountSeries:
        """The series times x^links y^mobility."""
        moved = {(n + links, f + mobility): c for (n, f), c in self.terms.items()}
        return CountSeries(moved, self.links, self.mobility)

    def stretched(self, k: int) -> CountSeries:
        """The series with x^k and y^k for x and y: k equal objects instead of one."""
        return CountSeries({(k * n, k * f): c for (n, f), c in self.terms.items()}, self.links, self.mobility)

    def sets(self) -> CountSeries:
        """Multisets of what the series counts, none of which has mobility 0."""
        exponent = CountSeries({}, self.links, self.mobility)
        for k in range(1, self.mobility + 1):
            exponent += self.stretched(k).scaled(Fraction(1, k))
        total = power = unit_series(self.links, self.mobility)
        for k in range(1, self.mobility + 1):
            power *= exponent
            total += power.scaled(Fraction(1, factorial(k)))
        return total


def unit_series(links: int, mobility: int) -> CountSeries:
    """The series 1."""
    return CountSeries({(0, 0): Fraction(1)}, links, mobility)


def cycle_types(chains: Iterable[Chain]) -> Types:
    """The cycle lengths of all automorphisms of these chains on their links. Cost O(order of the groups).

    >>> sorted(cycle_types([Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")]).items())[0]
    ((1, 1, 1, 1), Fraction(1, 8))
    """
    total: dict[tuple[int, ...], Fraction] = {}
    for chain in chains:
        symmetries = symmetry(chain)
        for element in _group(chain.n, [g.links for g in symmetries.generators]):
            kind = _cycles(element)
            total[kind] = total.get(kind, Fraction(0)) + Fraction(1, symmetries.order)
    return total


def _group(n: int, generators: list[tuple[int, ...]]) -> set[tuple[int, ...]]:
    group = {tuple(range(n))}
    fresh = list(group)
    while fresh:
        fresh = list({tuple(g[i] for i in element) for element in fresh for g in generators} - group)
        group.update(fresh)
    return group


def _cycles(element: tuple[int, ...]) -> tuple[int, ...]:
    visited: set[int] = set()
    lengths = []
    for start in range(len(element)):
        length, i = 0, start
        while i not in visited:
            visited.add(i)
            i = element[i]
            length += 1
        if length:
            lengths.append(length)
    return tuple(sorted(lengths))


def count_fractionated(
    links: int,
    mobility: int,
    plain: Callable[[int, int], Iterator[Chain]],
    plain_count: Callable[[int, int], tuple[int, int]],
) -> dict[str, int]:
    """The numbers of chains that fall apart at a link only, and at some joint.

    Args:
        links: number of links.
        mobility: F.
        plain: the chains of given links and mobility that are not fractionated, each once; called up to
            mobility F - 2.
        plain_count: their number and the number of their link orbits (inversions); called for mobility F - 1, for
            which no chain is built.

    Cost: for F = 2 that of `plain_count` up to links - 3 links.
    """
    blocks: dict[tuple[int, int], Types] = {}
    for f in range(1, mobility):
        for h in range(4, links - 2):
            if (3 * (h - 1) - f) % 2:
                continue
            if f < mobility - 1:
                blocks[h, f] = cycle_types(plain(h, f))
            else:
                # One freedom remains for the other blocks: only the number of link orbits matters (see the theory).
                chains, orbits = plain_count(h, f)
                blocks[h, f] = {(): Fraction(chains - orbits), (1,): Fraction(orbits)}
    separate = _composed(links, mobility, blocks, bridges=False)
    together = _composed(links, mobility, blocks, bridges=True)
    return {"link": separate, "joint": together - separate}


def _composed(links: int, mobility: int, blocks: Mapping[tuple[int, int], Types], *, bridges: bool) -> int:
    """The number of trees of two or more blocks, no bridge ending in a link without another joint."""
    unit = unit_series(links, mobility)
    hung = unit  # the subtrees at a link, the link itself not counted
    for _ in range(mobility):
        below = _marked(blocks, hung, root=True)
        if bridges:
            below += (hung - unit).shifted(1, 1)
        hung = below.sets()
    grown = hung - unit
    at_link, at_block, at_both = hung.shifted(1, 0), _whole(blocks, hung), _marked(blocks, hung, root=False)
    if bridges:
        at_link -= grown.shifted(2, 1)
        at_block += (grown * grown + grown.stretched(2)).scaled(Fraction(1, 2)).shifted(2, 1)
        at_both += (grown * grown).shifted(2, 1)
    number = (at_link + at_block - at_both).terms.get((links, mobility), Fraction(0))
    assert number.denominator == 1  # it counts orbits
    return int(number)


def _product(cycles: Iterable[int], hung: CountSeries) -> CountSeries:
    total = unit_series(hung.links, hung.mobility)
    for k, times in Counter(cycles).items():
        factor = hung.stretched(k)
        for _ in range(times):
            total *= factor
    return total


def _whole(blocks: Mapping[tuple[int, int], Types], hung: CountSeries) -> CountSeries:
    """A block with subtrees at each of its links."""
    total = CountSeries({}, hung.links, hung.mobility)
    for (h, f), types in blocks.items():
        for cycles, weight in types.items():
            total += _product(cycles, hung).scaled(weight).shifted(h, f)
    return total


def _marked(blocks: Mapping[tuple[int, int], Types], hung: CountSeries, *, root: bool) -> CountSeries:
    """A block with one link marked; as a root that link is not counted and has no subtrees."""
    total = CountSeries({}, hung.links, hung.mobility)
    for (h, f), types in blocks.items():
        for cycles, weight in types.items():
            fixed = cycles.count(1)
            if fixed:
                unmarked_cycles = list(cycles)
                if root:
                    unmarked_cycles.remove(1)
                total += _product(unmarked_cycles, hung).scaled(fixed * weight).shifted(h - root, f)
    return total
