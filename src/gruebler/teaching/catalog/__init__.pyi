from .claims import CheckedEntry, WrongClaim, check_claims
from .loader import (
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
