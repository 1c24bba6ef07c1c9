"""Structural synthesis of mechanisms. Grübler counted; we check the count.

The names below are the front door; each is loaded when it is first used, so that importing the library is
quick. ARCHITECTURE.md shows the rooms behind it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from gruebler.chain import Chain, Joint
    from gruebler.errors import CatalogError, ChainError, GrueblerError, NotationError, PairError
    from gruebler.isomorphism import code, decode, find_isomorphism, is_isomorphic, symmetry
    from gruebler.mobility import counted, generic_mobility, mobility_report
    from gruebler.pairs import PAIRS, Alphabet, Pair, Space, pair

__all__ = [
    "PAIRS",
    "Alphabet",
    "CatalogError",
    "Chain",
    "ChainError",
    "GrueblerError",
    "Joint",
    "NotationError",
    "Pair",
    "PairError",
    "Space",
    "code",
    "counted",
    "decode",
    "find_isomorphism",
    "generic_mobility",
    "is_isomorphic",
    "mobility_report",
    "pair",
    "symmetry",
]

_ROOMS = {
    "chain": ("Chain", "Joint"),
    "errors": ("CatalogError", "ChainError", "GrueblerError", "NotationError", "PairError"),
    "isomorphism": ("code", "decode", "find_isomorphism", "is_isomorphic", "symmetry"),
    "mobility": ("counted", "generic_mobility", "mobility_report"),
    "pairs": ("PAIRS", "Alphabet", "Pair", "Space", "pair"),
}
_HOME = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'gruebler' has no attribute {name!r}")
    value = getattr(import_module(f"gruebler.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOME])
