"""Assur groups: the decomposition of a mechanism into groups that are solved one after another, and lists of groups.

`decompose` decomposes a mechanism; `drive_choices` does so for each choice of drives. `AssurGroup` is a group without
a mechanism, `assur_groups` lists those of turning joints, `count_modes` counts their assembly modes. Definitions and
proofs: docs/theory/assur.md, docs/theory/counting-modes.md.
"""

from gruebler.structure.assur.choices import drive_choices
from gruebler.structure.assur.decomposition import Decomposition, JointShare, SolvedGroup, decompose
from gruebler.structure.assur.forms import DYADS
from gruebler.structure.assur.groups import AssurGroup
from gruebler.structure.assur.listing import assur_groups, count_assur_groups
from gruebler.structure.assur.locking import AssurError
from gruebler.structure.assur.modes import count_modes

__all__ = [
    "DYADS",
    "AssurError",
    "AssurGroup",
    "Decomposition",
    "JointShare",
    "SolvedGroup",
    "assur_groups",
    "count_assur_groups",
    "count_modes",
    "decompose",
    "drive_choices",
]
