"""Transformations of chains: dyads, couplers and Assur groups inserted and removed, links merged and split.

Each transformation is a function of a chain that returns a `Step`; a `Derivation` records steps and can replay them.
"""

from gruebler.structure.transformations.contacts import replace_roll_slide, restore_roll_slide
from gruebler.structure.transformations.contraction import contract, expand
from gruebler.structure.transformations.derivations import OPERATIONS, Derivation, replay
from gruebler.structure.transformations.dyads import insert_coupler, insert_dyad, remove_coupler, remove_dyad
from gruebler.structure.transformations.extension import Extension, extend
from gruebler.structure.transformations.groups import insert_group, remove_group
from gruebler.structure.transformations.growth import Growth, derive
from gruebler.structure.transformations.places import Attachment
from gruebler.structure.transformations.steps import Step

__all__ = [
    "OPERATIONS",
    "Attachment",
    "Derivation",
    "Extension",
    "Growth",
    "Step",
    "contract",
    "derive",
    "expand",
    "extend",
    "insert_coupler",
    "insert_dyad",
    "insert_group",
    "remove_coupler",
    "remove_dyad",
    "remove_group",
    "replace_roll_slide",
    "replay",
    "restore_roll_slide",
]
