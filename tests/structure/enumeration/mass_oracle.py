"""How many contracted graphs there are by another method: the sums of 1/|Aut| over those of the same degrees.

Generating functions only; no graph is made. Aut is the group of a multigraph with all permutations of its parallel
strings. docs/theory/enumeration.md, "The sums of 1/|Aut|", has the equations.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import zip_longest
from math import comb, factorial, prod

__all__ = ["contracted_masses"]

Degrees = tuple[int, ...]
"""How many vertices of degree 3, 4, ... there are."""
Series = Mapping[Degrees, Fraction]
"""A power series in t_3, t_4, ..., a variable for each vertex, cut off behind some number of loops."""

_ONE: Series = {(): Fraction(1)}


def contracted_masses(most: int) -> dict[Degrees, Fraction]:
    """The sum of 1/|Aut| over the contracted graphs of each sequence of degrees, for 2 to so many loops.

    >>> contracted_masses(3)
    {(2,): Fraction(1, 12), (0, 2): Fraction(1, 48), (2, 1): Fraction(1, 8), (4,): Fraction(5, 48)}
    """
    masses: dict[Degrees, Fraction] = {}
    connected = _logarithm(_all_multigraphs(2 * most - 2), 2 * most - 2)
    for loops in range(2, most + 1):
        grade = 2 * loops - 2
        separable = _from_blocks(masses, grade)
        for degrees in sorted(connected):
            mass = connected[degrees] - separable.get(degrees, 0)
            if _grade(degrees) == grade and mass:
                masses[degrees] = mass
    return masses


def _grade(degrees: Degrees) -> int:
    """The sum of degree - 2 over the vertices: 2 loops - 2 for a connected graph."""
    return sum(k * number for k, number in enumerate(degrees, 1))


def _sum(*terms: tuple[Fraction | int, Series]) -> Series:
    total: defaultdict[Degrees, Fraction] = defaultdict(Fraction)
    for factor, series in terms:
        for degrees, value in series.items():
            total[degrees] += factor * value
    return {degrees: value for degrees, value in total.items() if value}


def _product(first: Series, second: Series, most: int) -> Series:
    total: defaultdict[Degrees, Fraction] = defaultdict(Fraction)
    graded = [(_grade(degrees), degrees, value) for degrees, value in second.items()]
    for degrees, value in first.items():
        room = most - _grade(degrees)
        for grade, others, factor in graded:
            if grade <= room:
                total[tuple(a + b for a, b in zip_longest(degrees, others, fillvalue=0))] += value * factor
    return total


def _vertex(degree: int) -> Series:
    return {(*(0,) * (degree - 3), 1): Fraction(1)}


def _logarithm(series: Series, most: int) -> Series:
    rest = _sum((1, series), (-1, _ONE))
    terms, power, k = [], _ONE, 0
    while power := _product(power, rest, most):
        k += 1
        terms.append((Fraction((-1) ** (k + 1), k), power))
    return _sum(*terms)


def _all_multigraphs(most: int) -> Series:
    """All multigraphs without loops, connected or not, least degree 3: from exp(sum of x_i x_j over i < j)."""
    series = {}
    for grade in range(most + 1):
        for parts in _partitions(grade, grade):
            degrees = tuple(parts.count(k) for k in range(1, max(parts, default=0) + 1))
            if value := _labelled(k + 2 for k in parts):
                series[degrees] = value / prod(map(factorial, degrees))
    return series


def _partitions(total: int, largest: int) -> Iterator[Degrees]:
    if total == 0:
        yield ()
    for k in range(min(total, largest), 0, -1):
        yield from ((k, *rest) for rest in _partitions(total - k, k))


def _labelled(degrees: Iterator[int]) -> Fraction:
    """The coefficient of prod x_i^d_i in exp(sum of x_i x_j over i < j) = exp((p_1^2 - p_2)/2)."""
    ends: Mapping[int, Fraction] = {0: Fraction(1)}  # half strings that are no loop -> coefficient
    for d in degrees:
        more: defaultdict[int, Fraction] = defaultdict(Fraction)
        for number, value in ends.items():
            for loops in range(d // 2 + 1):
                rest = d - 2 * loops
                more[number + rest] += value * Fraction((-1) ** loops, 2**loops * factorial(loops) * factorial(rest))
        ends = more
    return sum(
        (v * Fraction(factorial(k), 2 ** (k // 2) * factorial(k // 2)) for k, v in ends.items() if k % 2 == 0),
        Fraction(0),
    )


def _from_blocks(masses: Series, most: int) -> Series:
    """The connected graphs of least degree 3 whose blocks are bridges, circuits, and contracted graphs of these masses.

    Strings of the latter may have vertices of degree 2. w[j] is the series of what a vertex of degree j in a block may
    be in the whole graph, b[j] that of the blocks at a vertex in which it has degree j.
    """

    def times(first: Series, second: Series) -> Series:
        return _product(first, second, most)

    degrees = range(1, most + 3)
    b: dict[int, Series] = {j: {} for j in degrees}
    while True:
        groups = [_ONE]  # of blocks at a vertex, by the sum of its degrees in them
        for k in degrees:
            groups.append(_sum(*((Fraction(j, k), times(b[j], groups[k - j])) for j in range(1, k + 1))))
        w = {j: _sum(*((1, times(_vertex(d), groups[d - j])) for d in degrees[2:] if d >= j)) for j in degrees}
        powers = [_ONE]
        while power := times(powers[-1], w[2]):
            powers.append(power)
        rooted = {j: [] for j in degrees}
        rooted[1].append((1, w[1]))
        rooted[2] += [(Fraction(1, 2), power) for power in powers[1:]]
        whole = [(Fraction(1, 2), times(w[1], w[1]))]
        whole += [(Fraction(1, 2 * k), power) for k, power in enumerate(powers) if k >= 2]
        for core, mass in masses.items():
            strings = sum(k * number for k, number in enumerate(core, 3)) // 2
            on_strings = _sum(*((comb(strings + k - 1, k), power) for k, power in enumerate(powers)))
            one_marked = _sum(*((comb(strings + k, k), power) for k, power in enumerate(powers)))
            nodes = _nodes(core, w, most)
            whole.append((mass, times(nodes, on_strings)))
            rooted[2].append((mass * strings, times(nodes, one_marked)))
            for k, number in enumerate(core, 3):
                if number:
                    fewer = tuple(other - (j == k) for j, other in enumerate(core, 3))
                    rooted[k].append((mass * number, times(_nodes(fewer, w, most), on_strings)))
        after = {j: _sum(*terms) for j, terms in rooted.items()}
        if after == b:
            break
        b = after
    vertices = [(1, times(_vertex(d), groups[d])) for d in degrees[2:]]
    incidences = [(-1, times(w[j], b[j])) for j in degrees]
    return _sum(*vertices, *whole, *incidences)


def _nodes(core: Degrees, w: Mapping[int, Series], most: int) -> Series:
    product = _ONE
    for degree, number in enumerate(core, 3):
        for _ in range(number):
            product = _product(product, w[degree], most)
    return product
