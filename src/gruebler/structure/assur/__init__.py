"""Assur groups: the decomposition of a mechanism into groups that are solved one after another, and lists of groups.

`decompose` decomposes a mechanism; `drive_choices` does so for each choice of drives. `AssurGroup` is a group without
a mechanism, `assur_groups` lists those of turning joints. Definitions and proofs: docs/theory/assur.md.
"""

from gruebler.structure.assur.choices import drive_choices
from gruebler.structure.assur.decomposition import Decomposition, JointShare, SolvedGroup, decompose
from gruebler.structure.assur.forms import DYADS
from gruebler.structure.assur.groups import AssurGroup
from gruebler.structure.assur.listing import assur_groups, count_assur_groups, group_of_truss
from gruebler.structure.assur.locking import AssurError

__all__ = [
    "DYADS",
    "AssurError",
    "AssurGroup",
    "Decomposition",
    "JointShare",
    "SolvedGroup",
    "assur_groups",
    "count_assur_groups",
    "decompose",
    "drive_choices",
    "group_of_truss",
]
