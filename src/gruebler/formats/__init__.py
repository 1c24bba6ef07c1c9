"""Everything that is read from TOML and JSON files or written to them: linkages, screws, catalog entries."""

from gruebler.formats.catalog_records import Case, ClaimedGroup, Claims, Entry, Exercise, read_entry, read_exercise
from gruebler.formats.linkages import linkage_from_json, linkage_to_json, linkage_to_toml, read_linkage, write_linkage

__all__ = [
    "Case",
    "ClaimedGroup",
    "Claims",
    "Entry",
    "Exercise",
    "linkage_from_json",
    "linkage_to_json",
    "linkage_to_toml",
    "read_entry",
    "read_exercise",
    "read_linkage",
    "write_linkage",
]
