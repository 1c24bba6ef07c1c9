from . import (
    assur,
    atlas,
    chain,
    count_tables,
    enumeration,
    isomorphism,
    mechanism,
    mobility,
    transformations,
    type_synthesis,
)

__all__ = [
    "assur",
    "atlas",
    "chain",
    "count_tables",
    "enumeration",
    "isomorphism",
    "mechanism",
    "mobility",
    "transformations",
    "type_synthesis",
]
