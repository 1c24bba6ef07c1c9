"""The one way of being immutable: a frozen dataclass, compared by what it is, its hash computed once."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import fields
from functools import cached_property
from types import MappingProxyType
from typing import Any, Self


def settle(value: object, /, **given: object) -> None:
    """Set fields of a frozen value, in its own constructor and nowhere else."""
    for name, content in given.items():
        object.__setattr__(value, name, content)


class Immutable(ABC):
    """A frozen dataclass (with ``eq=False``) that equals the values of its class that are the same.

    A copy is the value itself. What is kept of it in a file of `pickle` are its fields; nothing derived from them goes
    along, for the hash of a text differs from process to process.

    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, eq=False)
    ... class Team(Immutable):
    ...     members: tuple[str, ...]
    ...     def _identity(self) -> tuple[object, ...]:
    ...         return (frozenset(self.members),)
    >>> Team(("a", "b")) == Team(("b", "a"))
    True
    """

    @abstractmethod
    def _identity(self) -> tuple[object, ...]:
        """What values that are equal have in common, all of it hashable."""

    @cached_property
    def _key(self) -> tuple[object, ...]:
        return self._identity()

    @cached_property
    def _hash(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        if other is self:
            return True
        return self._key == other._key if isinstance(other, Immutable) and other.__class__ is self.__class__ else False

    def __hash__(self) -> int:
        return self._hash

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self

    def __getstate__(self) -> dict[str, Any]:
        contents = ((field.name, getattr(self, field.name)) for field in fields(self))  # type: ignore[arg-type]
        return {name: dict(each) if isinstance(each, MappingProxyType) else each for name, each in contents}

    def __setstate__(self, state: dict[str, Any]) -> None:
        settle(self, **{name: MappingProxyType(x) if isinstance(x, dict) else x for name, x in state.items()})
