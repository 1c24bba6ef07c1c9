"""Realisation: a search for sensible dimensions of any planar mechanism.

`realise` draws random layouts of a mechanism, shrinks the driven links, and improves the layouts that move;
docs/theory/realisation.md explains why that works.
"""

from gruebler.design.realisation.realising import realise, realise_all, with_drives
from gruebler.design.realisation.result import Realisation

__all__ = ["Realisation", "realise", "realise_all", "with_drives"]
