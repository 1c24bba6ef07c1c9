"""Every chain, exactly once: assortments, contracted graphs, and the chains as numbers, values or bytes."""

from gruebler.enumeration.assortment import Assortment, assortments, largest_degree
from gruebler.enumeration.contracted import ContractedGraph, contracted_graphs
from gruebler.enumeration.counting import ChainCount, count_chains
from gruebler.enumeration.kinematic import chains, chains_of, edge_blocks, graph6_blocks

__all__ = [
    "Assortment",
    "ChainCount",
    "ContractedGraph",
    "assortments",
    "chains",
    "chains_of",
    "contracted_graphs",
    "count_chains",
    "edge_blocks",
    "graph6_blocks",
    "largest_degree",
]
