"""The machines and exercises of the teaching documents as data, with a check of every claim."""

from gruebler.teaching.catalog.claims import CheckedEntry, WrongClaim, check_claims
from gruebler.teaching.catalog.loader import (
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
    "CheckedEntry",
    "Query",
    "WrongClaim",
    "catalog_folder",
    "check_all",
    "check_claims",
    "check_entry",
    "check_exercise",
    "entries",
    "entry",
    "exercises",
    "search",
]
