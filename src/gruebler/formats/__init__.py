"""Everything that is read from TOML and JSON files or written to them: linkages, screws, catalog entries."""

from gruebler.formats.catalog_records import Case, Claims, Entry, Exercise, Group, read_entry, read_exercise
from gruebler.formats.linkages import linkage_from_json, read_linkage, to_json, to_toml, write_linkage

__all__ = [
    "Case",
    "Claims",
    "Entry",
    "Exercise",
    "Group",
    "linkage_from_json",
    "read_entry",
    "read_exercise",
    "read_linkage",
    "to_json",
    "to_toml",
    "write_linkage",
]
