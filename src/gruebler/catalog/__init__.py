"""The machines and exercises of the seeds as data, and every claim they make checked."""

from gruebler.catalog.claims import Checked, WrongClaim, check
from gruebler.catalog.loader import (
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
    "Checked",
    "Query",
    "WrongClaim",
    "catalog_folder",
    "check",
    "check_all",
    "check_entry",
    "check_exercise",
    "entries",
    "entry",
    "exercises",
    "search",
]
