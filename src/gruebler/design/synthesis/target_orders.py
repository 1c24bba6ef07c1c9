"""In which order targets are to be passed: one after the other, some in any order, some at any time.

docs/theory/synthesis.md, "The order of the targets", defines it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations

import numpy as np

from gruebler.base.arrays import Integers
from gruebler.base.text import Message, joined, joined_by_and, message

Ranks = tuple[int | None, ...]
"""Of each target its place in the order, the same for a group; None at any time. Empty: as they are listed."""

Groups = tuple[tuple[int, ...], ...]
"""Targets, by their numbers from 0, that are passed one after the other; those of a group in any order."""


def _numbered(targets: Sequence[int]) -> Message:
    return joined_by_and([target + 1 for target in targets])


@dataclass(frozen=True)
class TargetOrder:
    """Groups of targets that are passed one after the other, and targets that are passed at any time.

    >>> order = TargetOrder.of((1, 2, 2, None), 4)
    >>> order.groups, order.free
    (((0,), (1, 2)), (3,))
    >>> len(list(order.sequences()))
    8
    """

    groups: Groups
    free: tuple[int, ...] = ()

    @classmethod
    def of(cls, ranks: Ranks, count: int) -> TargetOrder:
        """The order of so many targets; ranks as of a task."""
        given = ranks or tuple(range(count))
        rising = sorted({rank for rank in given if rank is not None})
        groups = tuple(tuple(k for k, own in enumerate(given) if own == rank) for rank in rising)
        return cls(groups, tuple(k for k, own in enumerate(given) if own is None))

    @property
    def both_ways(self) -> tuple[Groups, Groups]:
        """The groups, and in the other sense of the curve."""
        return self.groups, self.groups[::-1]

    @property
    def demands_nothing(self) -> bool:
        """Whether any order will do."""
        return len(self.groups) < 2

    @property
    def remark(self) -> Message:
        """What it asks, with the numbers of targets from 1.

        >>> print(TargetOrder.of((1, 2, 2, None), 4).remark)
        Order of the targets: 1; 2 and 3. At any time: 4.
        """
        if self.demands_nothing:
            return message("The targets may be met in any order.")
        groups, free = joined(map(_numbered, self.groups), "; "), _numbered(self.free)
        if not self.free:
            return message("Order of the targets: {groups}.", groups=groups)
        return message("Order of the targets: {groups}. At any time: {free}.", groups=groups, free=free)

    @property
    def rows(self) -> list[int]:
        """The targets that have a place in the order."""
        return [target for group in self.groups for target in group]

    @cached_property
    def ranks(self) -> Integers:
        """(targets,) the number of the group of each target; 0 for those at any time."""
        ranks = np.zeros(sum(map(len, self.groups)) + len(self.free), np.int64)
        for rank, group in enumerate(self.groups):
            ranks[list(group)] = rank
        return ranks

    def keeps(self, sequence: Sequence[int]) -> bool:
        """Whether targets in this sequence are in order."""
        free = set(self.free)
        ranks = [int(self.ranks[target]) for target in sequence if target not in free]
        return ranks == sorted(ranks)

    def sequences(self) -> Iterator[tuple[int, ...]]:
        """All that keep the order, each or its reverse. Cost: the factorial of the number of targets."""
        for sequence in permutations(range(len(self.ranks))):
            if self.keeps(sequence) and (sequence[0] <= sequence[-1] or not self.keeps(sequence[::-1])):
                yield sequence

    def drawn(self, rng: np.random.Generator) -> Integers:
        """A sequence that keeps the order, at random."""
        keys = rng.uniform(size=len(self.ranks)) + self.ranks
        if self.free:
            keys[list(self.free)] = rng.uniform(0, len(self.groups), len(self.free))
        return np.asarray(np.argsort(keys))
