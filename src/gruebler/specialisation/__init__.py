"""From a chain of revolutes to typed chains and mechanisms that answer requirements, each once."""

from gruebler.specialisation.assignment import assignments, every_joint_moves, joint_types
from gruebler.specialisation.contacts import with_contacts
from gruebler.specialisation.estimates import expected_seconds
from gruebler.specialisation.requirements import Place, Requirements, Wanted
from gruebler.specialisation.selection import typed_chains, variants

__all__ = [
    "Place",
    "Requirements",
    "Wanted",
    "assignments",
    "every_joint_moves",
    "expected_seconds",
    "joint_types",
    "typed_chains",
    "variants",
    "with_contacts",
]
