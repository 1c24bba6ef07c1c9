"""The geometry of motion: poles, curvature, cognates, coupler curves, straight lines.

`poles` and `centrodes`, `inflection_circle` and `path_curvature` take any `Motion`; `cognates`, `slider_cognates` and
`parallel_motion` find other linkages for one coupler curve; `path_piece`, `longest_piece` and `piece_of_ratio` tell how
straight a path is; `coupler_curve` finds length, area, cusps, inflections, vertices and double points,
`tangent_contact` the order of contact, `taylor_series` the Taylor series of a motion. Definitions, theorems and errors:
docs/theory/geometry.md, docs/theory/coupler-curves.md.
"""

from gruebler.mechanics.geometry.contact import TangentContact, tangent_contact
from gruebler.mechanics.geometry.coupler_curves import CouplerCurve, coupler_curve
from gruebler.mechanics.geometry.curvature import InflectionCircle, PathCurvature, inflection_circle, path_curvature
from gruebler.mechanics.geometry.instant_centres import Centrodes, Poles, centrodes, poles
from gruebler.mechanics.geometry.roberts import (
    Cognate,
    CognateSizes,
    cognate_sizes,
    cognates,
    parallel_motion,
    slider_cognates,
)
from gruebler.mechanics.geometry.series import TaylorSeries, taylor_series
from gruebler.mechanics.geometry.straight import (
    Path,
    PathPiece,
    coupler_path,
    linkage_path,
    longest_piece,
    path_piece,
    piece_of_ratio,
)

__all__ = [
    "Centrodes",
    "Cognate",
    "CognateSizes",
    "CouplerCurve",
    "InflectionCircle",
    "Path",
    "PathCurvature",
    "PathPiece",
    "Poles",
    "TangentContact",
    "TaylorSeries",
    "centrodes",
    "cognate_sizes",
    "cognates",
    "coupler_curve",
    "coupler_path",
    "inflection_circle",
    "linkage_path",
    "longest_piece",
    "parallel_motion",
    "path_curvature",
    "path_piece",
    "piece_of_ratio",
    "poles",
    "slider_cognates",
    "tangent_contact",
    "taylor_series",
]
