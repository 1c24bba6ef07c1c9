"""Realisation: dimensions for any planar mechanism, found by a search.

`realise` draws a mechanism at random, makes its driven links small, and improves what moves;
docs/theory/realisation.md says why that works.
"""

from gruebler.realisation.realise import realise, with_drives
from gruebler.realisation.result import Realisation

__all__ = ["Realisation", "realise", "with_drives"]
