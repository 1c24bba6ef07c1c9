"""Assembly modes on the sphere by another decomposition: every body cut into cross-ratios, one degenerates at a time.

A pin of a spherical link is two marks on a conic. A link of k pins fixes 2k - 3 cross-ratios of its 2k marks: those of
three of them with each of the others. The modes are the configurations of all marks with these cross-ratios (a
*cross-ratio degree*; Goldner, Math. Z. 297, 2021; Gallet, Grasegger and Schicho, Electron. J. Combin. 27, 2020). Where
the cross-ratio of a, b, c, d goes to that of a = b, the marks part into I with a, b and J with c, d, and each other
cross-ratio has three of its marks on one side. Nothing is taken from the kernel: no body is kept or united, numbers are
Python's, sides are chosen in another order.
"""

from __future__ import annotations

from functools import cache

__all__ = ["count_by_cross_ratios"]

Quadruples = tuple[int, ...]


def count_by_cross_ratios(ends: list[tuple[int, int]]) -> int:
    """The modes on the sphere of a truss of simple joints, given by their two links."""
    quadruples = []
    for link in range(1 + max(map(max, ends))):
        first, *others = [joint for joint, pair in enumerate(ends) if link in pair]
        marks = [2 * joint + side for joint in others for side in (0, 1)]
        triple = 3 << 2 * first | 1 << marks[0]
        quadruples += [triple | 1 << mark for mark in marks[1:]]
    return _count((1 << 2 * len(ends)) - 1, tuple(sorted(quadruples)))


def _count(marks: int, quadruples: Quadruples) -> int:
    """Configurations of the marks with these cross-ratios, as many as there are freedoms."""
    left = list(quadruples)
    while left:
        once = twice = 0
        for four in left:
            once, twice = once | four, twice | once & four
        if marks & ~once or len(set(left)) < len(left):
            return 0  # a mark is free, or one cross-ratio is given twice
        lone = once & ~twice
        if not lone:
            return _renumbered(marks, tuple(left))
        mark = lone & -lone
        marks &= ~mark
        left = [four for four in left if not four & mark]  # its cross-ratio says where it is
    return int(marks.bit_count() == 3)


def _renumbered(marks: int, quadruples: Quadruples) -> int:
    place = {mark: 1 << k for k, mark in enumerate(_bits(marks))}
    fours = (sum(place[mark] for mark in _bits(four)) for four in quadruples)
    return _split((1 << len(place)) - 1, tuple(sorted(fours)))


@cache
def _split(marks: int, quadruples: Quadruples) -> int:
    """The cross-ratio that degenerates, and how, are such that most other marks have no choice of their side."""
    least = 99
    for four in quadruples:
        a, b, c, d = _bits(four)
        for near in (a | b, a | c, a | d):
            sides = _forced(near, four & ~near, marks & ~four, [other for other in quadruples if other != four])
            if sides is None:
                return 0
            if sides[2].bit_count() < least:
                least, chosen, begun = sides[2].bit_count(), four, sides
    others = [four for four in quadruples if four != chosen]
    star = marks + 1
    total = 0
    for here in _sides(*begun, others):
        there = marks & ~here
        mine = [four for four in others if (four & here).bit_count() >= 3]
        if len(mine) != here.bit_count() - 2:
            continue
        theirs = [four for four in others if (four & here).bit_count() < 3]
        ways = _count(here | star, tuple(sorted(_starred(four, here, star) for four in mine)))
        if ways:
            total += ways * _count(there | star, tuple(sorted(_starred(four, there, star) for four in theirs)))
    return total


def _forced(near: int, far: int, left: int, quadruples: list[int]) -> tuple[int, int, int] | None:
    """The sides with the marks that have no choice, and those that are left; None if a quadruple has two on each."""
    begun = -1
    while begun != left:
        begun = left
        for four in quadruples:
            here, there, own = (four & near).bit_count(), (four & far).bit_count(), four & left
            if here > 1 and there > 1:
                return None
            if own and here == 2 and there == 1:
                near, left = near | own, left & ~own
            elif own and there == 2 and here == 1:
                far, left = far | own, left & ~own
    return near, far, left


def _sides(near: int, far: int, left: int, quadruples: list[int]):
    """All ways to give the marks left to one of two sides so that no quadruple has two on each."""
    sides = _forced(near, far, left, quadruples)
    if sides is None:
        return
    near, far, left = sides
    if not left:
        yield near
        return
    known = near | far
    mark = max(_bits(left), key=lambda m: sum((four & known).bit_count() ** 2 for four in quadruples if four & m))
    yield from _sides(near | mark, far, left & ~mark, quadruples)
    yield from _sides(near, far | mark, left & ~mark, quadruples)


def _starred(four: int, side: int, star: int) -> int:
    return four if not four & ~side else four & side | star


def _bits(word: int) -> list[int]:
    return [1 << k for k in range(word.bit_length()) if word >> k & 1]
