"""Assur groups: the decomposition of a mechanism into groups that are solved one after another, and lists of groups.

`decompose` decomposes a mechanism; `drive_choices` does so for each choice of drives. `AssurGroup` is a group without
a mechanism, `assur_groups` lists those of turning joints. Definitions and proofs: docs/theory/assur.md.
"""

from gruebler.assur.choices import drive_choices
from gruebler.assur.decomposition import Decomposition, JointShare, SolvedGroup, decompose
from gruebler.assur.forms import DYADS
from gruebler.assur.groups import AssurGroup
from gruebler.assur.listing import assur_groups, count_assur_groups, group_of_truss
from gruebler.assur.locking import AssurError

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
