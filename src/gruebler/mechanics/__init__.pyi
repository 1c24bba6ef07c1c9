from . import (
    analysis,
    forces,
    fourbar,
    geometry,
    kinematics,
    linkages,
    screws,
)

__all__ = [
    "analysis",
    "forces",
    "fourbar",
    "geometry",
    "kinematics",
    "linkages",
    "screws",
]
