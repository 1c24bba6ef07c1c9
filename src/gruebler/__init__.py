"""Structural synthesis of mechanisms. Grübler counted; we check the count.

The names below are the front door; each is loaded when it is first used, so that importing the library is
quick. ARCHITECTURE.md shows the rooms behind it.

>>> import gruebler as gr
>>> four_bar = gr.Chain.parse("R(frame-crank) R(crank-coupler) R(coupler-rocker) R(rocker-frame)")
>>> gr.mobility_report(four_bar).generic
1
>>> sum(len(gr.inversions(chain)) for chain in gr.chains(links=8, mobility=1))
71
>>> gr.count_chains(links=12, mobility=1).chains
6856
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from gruebler.assur import assur_groups, decompose
    from gruebler.chain import Chain, Joint
    from gruebler.enumeration import chains, count_chains
    from gruebler.errors import CatalogError, ChainError, GrueblerError, NotationError, PairError
    from gruebler.inversion import driven_mechanisms, inversions
    from gruebler.isomorphism import code, decode, find_isomorphism, is_isomorphic, symmetry
    from gruebler.mechanism import Mechanism, check_drives
    from gruebler.mobility import counted, generic_mobility, mobility_report
    from gruebler.pairs import PAIRS, Alphabet, Pair, Space, pair
    from gruebler.specialisation import Requirements, joint_types, variants
    from gruebler.transformation import derive, extend

__all__ = [
    "PAIRS",
    "Alphabet",
    "CatalogError",
    "Chain",
    "ChainError",
    "GrueblerError",
    "Joint",
    "Mechanism",
    "NotationError",
    "Pair",
    "PairError",
    "Requirements",
    "Space",
    "assur_groups",
    "chains",
    "check_drives",
    "code",
    "count_chains",
    "counted",
    "decode",
    "decompose",
    "derive",
    "driven_mechanisms",
    "extend",
    "find_isomorphism",
    "generic_mobility",
    "inversions",
    "is_isomorphic",
    "joint_types",
    "mobility_report",
    "pair",
    "symmetry",
    "variants",
]

_ROOMS = {
    "assur": ("assur_groups", "decompose"),
    "chain": ("Chain", "Joint"),
    "enumeration": ("chains", "count_chains"),
    "errors": ("CatalogError", "ChainError", "GrueblerError", "NotationError", "PairError"),
    "inversion": ("driven_mechanisms", "inversions"),
    "isomorphism": ("code", "decode", "find_isomorphism", "is_isomorphic", "symmetry"),
    "mechanism": ("Mechanism", "check_drives"),
    "mobility": ("counted", "generic_mobility", "mobility_report"),
    "pairs": ("PAIRS", "Alphabet", "Pair", "Space", "pair"),
    "specialisation": ("Requirements", "joint_types", "variants"),
    "transformation": ("derive", "extend"),
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
