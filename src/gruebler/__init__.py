"""Structural synthesis of mechanisms. Grübler counted; we check the count.

The names below are the front door; each is loaded when it is first used, so that importing the library is
quick. ARCHITECTURE.md shows the rooms behind it.

>>> import gruebler as gr
>>> four_bar = gr.Chain.parse("R(frame-crank) R(crank-coupler) R(coupler-rocker) R(rocker-frame)")
>>> gr.mobility_report(four_bar).generic
1
>>> sum(len(gr.inversions(chain)) for chain in gr.chains(links=8, mobility=1))
71
>>> gr.count_chains(links=12, mobility=1).chains
6856
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from gruebler import notebook

__version__ = "0.1.0"

if TYPE_CHECKING:
    from gruebler.analysis import Measures, drive_range, motion_roles
    from gruebler.analysis.measures import measures
    from gruebler.analysis.rotatability import rotatability
    from gruebler.assur import assur_groups, decompose
    from gruebler.cams import Cam, CamError
    from gruebler.catalog.features import AccessFeatures, access_features
    from gruebler.chain import Chain, Joint
    from gruebler.chain.pairs import PAIRS, Alphabet, Pair, Space, pair
    from gruebler.drawing.canvas import gallery_html
    from gruebler.drawing.canvas.panels import ratio_diagram
    from gruebler.drawing.linkage.animation import animated_svg
    from gruebler.drawing.linkage.animation_frames import animated_frames
    from gruebler.drawing.linkage.animation_page import animated_page
    from gruebler.drawing.linkage.curve_plots import coupler_plot, family_plot, hodograph
    from gruebler.drawing.linkage.motion_picture import draw_motion
    from gruebler.drawing.linkage.motion_plots import transfer_plot, transmission_plot
    from gruebler.drawing.linkage.picture import draw_linkage
    from gruebler.drawing.machines.cam_picture import animate_cam, draw_cam
    from gruebler.drawing.machines.geneva_picture import animate_geneva, draw_geneva
    from gruebler.drawing.machines.train_picture import animate_train, draw_train
    from gruebler.drawing.structure import draw
    from gruebler.enumeration import chains, count_chains
    from gruebler.errors import (
        CatalogError,
        ChainError,
        GrueblerError,
        LinkageError,
        NotationError,
        PairError,
        SynthesisError,
    )
    from gruebler.exercises import exercise, generate, solve, teaching_table
    from gruebler.formats import read_linkage, write_linkage
    from gruebler.fourbar import FourBar, InvertedSliderCrank, SliderCrank
    from gruebler.gears import GearError, Train, read_train
    from gruebler.geneva import Geneva, GenevaError
    from gruebler.geometry import (
        CouplerCurve,
        centrodes,
        cognates,
        coupler_curve,
        coupler_sextic,
        inflection_circle,
        longest_piece,
        parallel_motion,
        path_curvature,
        piece_of_ratio,
        poles,
        slider_cognates,
        tangent_contact,
    )
    from gruebler.geometry.guidance import GUIDANCES, guidance
    from gruebler.geometry.meyer_zur_capellen import lambdas_for, symmetric_rocker
    from gruebler.isomorphism import code, decode, find_isomorphism, is_isomorphic, symmetry
    from gruebler.kinematics import Circuit, Motion, circuit, degrees, four_bars, move, move_many
    from gruebler.linkages import CamDisc, Circle, GenevaDriver, GenevaWheel, Linkage, NonCircular, Wheel
    from gruebler.mechanism import Mechanism, check_drives
    from gruebler.mechanism.inversion import driven_mechanisms, inversions
    from gruebler.mobility import counted, generic_mobility, mobility_report
    from gruebler.realisation import Realisation
    from gruebler.realisation.realise import realise
    from gruebler.screws import Freedoms, JointPlace, SpatialLinkage, freedom_report
    from gruebler.sheets import sheet
    from gruebler.sheets.expressions import Expression
    from gruebler.statics import Loads, Statics, slide_friction, slider_friction
    from gruebler.synthesis import (
        DeadCentreTask,
        Demands,
        FunctionLaw,
        FunctionTask,
        PathTask,
        PositionTask,
        function_task,
        minimax,
        read_task,
        synthesise_dead_centres,
        synthesise_function,
        synthesise_path,
        synthesise_positions,
        synthesise_structures,
    )
    from gruebler.transformations import derive, extend
    from gruebler.type_synthesis import Requirements, joint_types, variants

__all__ = [
    "GUIDANCES",
    "PAIRS",
    "AccessFeatures",
    "Alphabet",
    "Cam",
    "CamDisc",
    "CamError",
    "CatalogError",
    "Chain",
    "ChainError",
    "Circle",
    "Circuit",
    "CouplerCurve",
    "DeadCentreTask",
    "Demands",
    "Expression",
    "FourBar",
    "Freedoms",
    "FunctionLaw",
    "FunctionTask",
    "GearError",
    "Geneva",
    "GenevaDriver",
    "GenevaError",
    "GenevaWheel",
    "GrueblerError",
    "InvertedSliderCrank",
    "Joint",
    "JointPlace",
    "Linkage",
    "LinkageError",
    "Loads",
    "Measures",
    "Mechanism",
    "Motion",
    "NonCircular",
    "NotationError",
    "Pair",
    "PairError",
    "PathTask",
    "PositionTask",
    "Realisation",
    "Requirements",
    "SliderCrank",
    "Space",
    "SpatialLinkage",
    "Statics",
    "SynthesisError",
    "Train",
    "Wheel",
    "access_features",
    "animate_cam",
    "animate_geneva",
    "animate_train",
    "animated_frames",
    "animated_page",
    "animated_svg",
    "assur_groups",
    "centrodes",
    "chains",
    "check_drives",
    "circuit",
    "code",
    "cognates",
    "count_chains",
    "counted",
    "coupler_curve",
    "coupler_plot",
    "coupler_sextic",
    "decode",
    "decompose",
    "degrees",
    "derive",
    "draw",
    "draw_cam",
    "draw_geneva",
    "draw_linkage",
    "draw_motion",
    "draw_train",
    "drive_range",
    "driven_mechanisms",
    "exercise",
    "extend",
    "family_plot",
    "find_isomorphism",
    "four_bars",
    "freedom_report",
    "function_task",
    "gallery_html",
    "generate",
    "generic_mobility",
    "guidance",
    "hodograph",
    "inflection_circle",
    "inversions",
    "is_isomorphic",
    "joint_types",
    "lambdas_for",
    "longest_piece",
    "measures",
    "minimax",
    "mobility_report",
    "motion_roles",
    "move",
    "move_many",
    "pair",
    "parallel_motion",
    "path_curvature",
    "piece_of_ratio",
    "poles",
    "ratio_diagram",
    "read_linkage",
    "read_task",
    "read_train",
    "realise",
    "rotatability",
    "sheet",
    "slide_friction",
    "slider_cognates",
    "slider_friction",
    "solve",
    "symmetric_rocker",
    "symmetry",
    "synthesise_dead_centres",
    "synthesise_function",
    "synthesise_path",
    "synthesise_positions",
    "synthesise_structures",
    "tangent_contact",
    "teaching_table",
    "transfer_plot",
    "transmission_plot",
    "variants",
    "write_linkage",
]

_ROOMS = {
    "analysis": (
        "Measures",
        "drive_range",
        "motion_roles",
    ),
    "analysis.measures": ("measures",),
    "analysis.rotatability": ("rotatability",),
    "assur": (
        "assur_groups",
        "decompose",
    ),
    "cams": (
        "Cam",
        "CamError",
    ),
    "catalog.features": (
        "AccessFeatures",
        "access_features",
    ),
    "chain": (
        "Chain",
        "Joint",
    ),
    "chain.pairs": (
        "Alphabet",
        "PAIRS",
        "Pair",
        "Space",
        "pair",
    ),
    "drawing.canvas": ("gallery_html",),
    "drawing.canvas.panels": ("ratio_diagram",),
    "drawing.linkage.animation": ("animated_svg",),
    "drawing.linkage.animation_frames": ("animated_frames",),
    "drawing.linkage.animation_page": ("animated_page",),
    "drawing.linkage.curve_plots": (
        "coupler_plot",
        "family_plot",
        "hodograph",
    ),
    "drawing.linkage.motion_picture": ("draw_motion",),
    "drawing.linkage.motion_plots": (
        "transfer_plot",
        "transmission_plot",
    ),
    "drawing.linkage.picture": ("draw_linkage",),
    "drawing.machines.cam_picture": (
        "animate_cam",
        "draw_cam",
    ),
    "drawing.machines.geneva_picture": (
        "animate_geneva",
        "draw_geneva",
    ),
    "drawing.machines.train_picture": (
        "animate_train",
        "draw_train",
    ),
    "drawing.structure": ("draw",),
    "enumeration": (
        "chains",
        "count_chains",
    ),
    "errors": (
        "CatalogError",
        "ChainError",
        "GrueblerError",
        "LinkageError",
        "NotationError",
        "PairError",
        "SynthesisError",
    ),
    "exercises": (
        "exercise",
        "generate",
        "solve",
        "teaching_table",
    ),
    "formats": (
        "read_linkage",
        "write_linkage",
    ),
    "fourbar": (
        "FourBar",
        "InvertedSliderCrank",
        "SliderCrank",
    ),
    "gears": (
        "GearError",
        "Train",
        "read_train",
    ),
    "geneva": (
        "Geneva",
        "GenevaError",
    ),
    "geometry": (
        "CouplerCurve",
        "centrodes",
        "cognates",
        "coupler_curve",
        "coupler_sextic",
        "inflection_circle",
        "longest_piece",
        "parallel_motion",
        "path_curvature",
        "piece_of_ratio",
        "poles",
        "slider_cognates",
        "tangent_contact",
    ),
    "geometry.guidance": (
        "GUIDANCES",
        "guidance",
    ),
    "geometry.meyer_zur_capellen": (
        "lambdas_for",
        "symmetric_rocker",
    ),
    "isomorphism": (
        "code",
        "decode",
        "find_isomorphism",
        "is_isomorphic",
        "symmetry",
    ),
    "kinematics": (
        "Circuit",
        "Motion",
        "circuit",
        "degrees",
        "four_bars",
        "move",
        "move_many",
    ),
    "linkages": (
        "Circle",
        "GenevaWheel",
        "CamDisc",
        "GenevaDriver",
        "Linkage",
        "NonCircular",
        "Wheel",
    ),
    "mechanism": (
        "Mechanism",
        "check_drives",
    ),
    "mechanism.inversion": (
        "driven_mechanisms",
        "inversions",
    ),
    "mobility": (
        "counted",
        "generic_mobility",
        "mobility_report",
    ),
    "realisation": ("Realisation",),
    "realisation.realise": ("realise",),
    "screws": (
        "Freedoms",
        "JointPlace",
        "SpatialLinkage",
        "freedom_report",
    ),
    "sheets": ("sheet",),
    "sheets.expressions": ("Expression",),
    "statics": (
        "Loads",
        "Statics",
        "slide_friction",
        "slider_friction",
    ),
    "synthesis": (
        "DeadCentreTask",
        "Demands",
        "FunctionLaw",
        "FunctionTask",
        "PathTask",
        "PositionTask",
        "function_task",
        "minimax",
        "read_task",
        "synthesise_dead_centres",
        "synthesise_function",
        "synthesise_path",
        "synthesise_positions",
        "synthesise_structures",
    ),
    "transformations": (
        "derive",
        "extend",
    ),
    "type_synthesis": (
        "Requirements",
        "joint_types",
        "variants",
    ),
}
_HOME = {name: room for room, names in _ROOMS.items() for name in names}


_DRAWN: dict[str, tuple[str, str, dict[str, Any]]] = {
    "Chain": ("structure.picture", "draw", {"labels": True}),
    "Mechanism": ("structure.picture", "draw", {"labels": True}),
    "Linkage": ("linkage.picture", "shown_linkage", {}),
    "Motion": ("linkage.motion_picture", "draw_motion", {}),
    "Cam": ("machines.cam_picture", "draw_cam", {}),
    "Geneva": ("machines.geneva_picture", "draw_geneva", {}),
    "Train": ("machines.train_picture", "draw_train", {}),
}


def _picture(thing: Any) -> str:
    """The SVG of a value for a notebook; of a linkage that cannot be placed, its structure and the reason."""
    room, name, options = _DRAWN[type(thing).__name__]
    return str(getattr(import_module(f"gruebler.drawing.{room}"), name)(thing, **options).svg())


notebook.svg_of = _picture


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'gruebler' has no attribute {name!r}")
    value = getattr(import_module(f"gruebler.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOME])
