"""From a chain of revolutes to typed chains and mechanisms that satisfy requirements, each once."""

from gruebler.structure.type_synthesis.assignment import assignments, every_joint_moves, joint_types
from gruebler.structure.type_synthesis.contacts import with_contacts
from gruebler.structure.type_synthesis.estimates import expected_seconds_of_variants
from gruebler.structure.type_synthesis.requirements import JointLocation, JointRequirement, Requirements
from gruebler.structure.type_synthesis.selection import typed_chains, variants
from gruebler.structure.type_synthesis.sliding import count_sliding_variants, sliding_numbers

__all__ = [
    "JointLocation",
    "JointRequirement",
    "Requirements",
    "assignments",
    "count_sliding_variants",
    "every_joint_moves",
    "expected_seconds_of_variants",
    "joint_types",
    "sliding_numbers",
    "typed_chains",
    "variants",
    "with_contacts",
]
