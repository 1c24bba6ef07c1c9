"""Chains made from chains: dyads, couplers and Assur groups put in and taken out, links merged and split.

Each transformation is a function of a chain that returns a `Step`; steps make a `Derivation` that can be done again.
"""

from gruebler.transformation.contacts import replace_roll_slide, restore_roll_slide
from gruebler.transformation.contraction import contract, expand
from gruebler.transformation.derivations import OPERATIONS, Derivation, replay
from gruebler.transformation.dyads import insert_coupler, insert_dyad, remove_coupler, remove_dyad
from gruebler.transformation.extension import Extension, extend, grown
from gruebler.transformation.groups import insert_group, remove_group
from gruebler.transformation.growth import Growth, derive
from gruebler.transformation.places import Place
from gruebler.transformation.steps import Step, TransformationError

__all__ = [
    "OPERATIONS",
    "Derivation",
    "Extension",
    "Growth",
    "Place",
    "Step",
    "TransformationError",
    "contract",
    "derive",
    "expand",
    "extend",
    "grown",
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
