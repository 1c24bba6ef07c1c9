from . import (
    cams,
    gears,
    geneva,
)

__all__ = [
    "cams",
    "gears",
    "geneva",
]
