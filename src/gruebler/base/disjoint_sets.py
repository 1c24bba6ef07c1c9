"""Sets that are united one by one (union-find with path halving)."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Generic, TypeVar

Item = TypeVar("Item", bound=Hashable)


class DisjointSets(Generic[Item]):
    """Items, each at first in a set of its own.

    >>> sets = DisjointSets("abcd")
    >>> sets.unite("a", "c")
    >>> sets.classes()
    [['a', 'c'], ['b'], ['d']]
    """

    def __init__(self, items: Iterable[Item]) -> None:
        self._above = {item: item for item in items}

    def find(self, item: Item) -> Item:
        """The item that stands for the set; nearly constant cost."""
        above = self._above
        while above[item] != item:
            above[item] = item = above[above[item]]
        return item

    def unite(self, first: Item, second: Item) -> None:
        """Make one set of two; that of the first gives the item that stands for it."""
        self._above[self.find(second)] = self.find(first)

    def classes(self) -> list[list[Item]]:
        """The sets, ordered by their first items, each in the order in which its items were given."""
        classes: dict[Item, list[Item]] = {}
        for item in self._above:
            classes.setdefault(self.find(item), []).append(item)
        return list(classes.values())
