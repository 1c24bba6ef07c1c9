"""Every chain, exactly once: assortments, contracted graphs, and the chains as numbers, values or bytes."""

from gruebler.structure.enumeration.assortment import (
    Assortment,
    assortment_number,
    assortments,
    each_assortment,
    largest_degree,
)
from gruebler.structure.enumeration.contracted import ContractedGraph, contracted_graphs
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.epicyclic import (
    EpicyclicCount,
    EpicyclicTrain,
    count_epicyclic_trains,
    epicyclic_trains,
)
from gruebler.structure.enumeration.fractionation_class import fractionation
from gruebler.structure.enumeration.listing import chains, count_chains
from gruebler.structure.enumeration.multiple_assortment import (
    each_joint_assortment,
    joint_assortment_number,
    joint_assortments,
)
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.simple_chains import chains_of, edge_blocks, graph6_blocks

__all__ = [
    "Assortment",
    "ChainCount",
    "ContractedGraph",
    "EpicyclicCount",
    "EpicyclicTrain",
    "Request",
    "assortment_number",
    "assortments",
    "chains",
    "chains_of",
    "contracted_graphs",
    "count_chains",
    "count_epicyclic_trains",
    "each_assortment",
    "each_joint_assortment",
    "edge_blocks",
    "epicyclic_trains",
    "fractionation",
    "graph6_blocks",
    "joint_assortment_number",
    "joint_assortments",
    "largest_degree",
]
