from . import (
    assur,
    atlas,
    chain,
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
    "enumeration",
    "isomorphism",
    "mechanism",
    "mobility",
    "transformations",
    "type_synthesis",
]
