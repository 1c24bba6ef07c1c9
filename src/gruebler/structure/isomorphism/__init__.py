"""Isomorphism of chains: canonical codes, correspondences and symmetry. Exact for every chain."""

from gruebler.structure.isomorphism.automorphisms import Permutation, Symmetry, orbits, symmetry
from gruebler.structure.isomorphism.codes import CODE_PREFIX, MarkedChain, canonical_order, code, decode
from gruebler.structure.isomorphism.colouring import DriveMark
from gruebler.structure.isomorphism.matching import Isomorphism, find_isomorphism, is_isomorphic

__all__ = [
    "CODE_PREFIX",
    "DriveMark",
    "Isomorphism",
    "MarkedChain",
    "Permutation",
    "Symmetry",
    "canonical_order",
    "code",
    "decode",
    "find_isomorphism",
    "is_isomorphic",
    "orbits",
    "symmetry",
]
