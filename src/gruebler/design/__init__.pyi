from . import (
    realisation,
    synthesis,
)

__all__ = [
    "realisation",
    "synthesis",
]
