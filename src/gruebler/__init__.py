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
    from gruebler.pairs import PAIRS, Alphabet, Pair, Space, pair

_HOME = {
    "Chain": "chain",
    "Joint": "chain",
    "CatalogError": "errors",
    "ChainError": "errors",
    "GrueblerError": "errors",
    "NotationError": "errors",
    "PairError": "errors",
    "PAIRS": "pairs",
    "Alphabet": "pairs",
    "Pair": "pairs",
    "Space": "pairs",
    "pair": "pairs",
}

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
    "pair",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'gruebler' has no attribute {name!r}")
    return getattr(import_module(f"gruebler.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOME])
