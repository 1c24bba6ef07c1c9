from . import (
    analysis,
    dynamics,
    forces,
    fourbar,
    geometry,
    kinematics,
    linkages,
    screws,
    space,
)

__all__ = [
    "analysis",
    "dynamics",
    "forces",
    "fourbar",
    "geometry",
    "kinematics",
    "linkages",
    "screws",
    "space",
]
