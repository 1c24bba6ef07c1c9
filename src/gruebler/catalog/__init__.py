"""The machines and exercises of the seeds as data, and every claim they make checked."""

from gruebler.catalog.claims import Checked, WrongClaim, check
from gruebler.catalog.records import Case, Claims, Entry, Exercise, Group, Text, read_entry, read_exercise
from gruebler.catalog.shelf import (
    Query,
    catalog_folder,
    check_all,
    check_entry,
    check_exercise,
    entries,
    entry,
    exercises,
    search,
)

__all__ = [
    "Case",
    "Checked",
    "Claims",
    "Entry",
    "Exercise",
    "Group",
    "Query",
    "Text",
    "WrongClaim",
    "catalog_folder",
    "check",
    "check_all",
    "check_entry",
    "check_exercise",
    "entries",
    "entry",
    "exercises",
    "read_entry",
    "read_exercise",
    "search",
]
