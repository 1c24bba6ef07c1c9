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

from gruebler import views

__version__ = "0.1.0"

if TYPE_CHECKING:
    from gruebler.assur import assur_groups, decompose
    from gruebler.cams import Cam, CamError
    from gruebler.chain import Chain, Joint
    from gruebler.drawing import draw, gallery_html
    from gruebler.drawing.animation import animated_svg
    from gruebler.drawing.linkage_picture import draw_linkage
    from gruebler.enumeration import chains, count_chains
    from gruebler.errors import CatalogError, ChainError, GrueblerError, LinkageError, NotationError, PairError
    from gruebler.gears import GearError, Train, read_train
    from gruebler.geneva import Geneva, GenevaError
    from gruebler.geometry import (
        centrodes,
        cognates,
        coupler_sextic,
        inflection_circle,
        longest_piece,
        parallel_motion,
        path_curvature,
        piece_of_ratio,
        poles,
        slider_cognates,
    )
    from gruebler.inversion import driven_mechanisms, inversions
    from gruebler.isomorphism import code, decode, find_isomorphism, is_isomorphic, symmetry
    from gruebler.kinematics import (
        Circuit,
        Measures,
        Motion,
        circuit,
        degrees,
        drive_range,
        four_bars,
        measures,
        motion_roles,
        move,
        move_many,
        rotatability,
    )
    from gruebler.linkages import FourBar, InvertedSliderCrank, Linkage, SliderCrank, read_linkage, write_linkage
    from gruebler.mechanism import Mechanism, check_drives
    from gruebler.mobility import counted, generic_mobility, mobility_report
    from gruebler.pairs import PAIRS, Alphabet, Pair, Space, pair
    from gruebler.realisation import Realisation, realise
    from gruebler.specialisation import Requirements, joint_types, variants
    from gruebler.transformation import derive, extend

__all__ = [
    "PAIRS",
    "Alphabet",
    "Cam",
    "CamError",
    "CatalogError",
    "Chain",
    "ChainError",
    "Circuit",
    "FourBar",
    "GearError",
    "Geneva",
    "GenevaError",
    "GrueblerError",
    "InvertedSliderCrank",
    "Joint",
    "Linkage",
    "LinkageError",
    "Measures",
    "Mechanism",
    "Motion",
    "NotationError",
    "Pair",
    "PairError",
    "Realisation",
    "Requirements",
    "SliderCrank",
    "Space",
    "Train",
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
    "coupler_sextic",
    "decode",
    "decompose",
    "degrees",
    "derive",
    "draw",
    "draw_linkage",
    "drive_range",
    "driven_mechanisms",
    "extend",
    "find_isomorphism",
    "four_bars",
    "gallery_html",
    "generic_mobility",
    "inflection_circle",
    "inversions",
    "is_isomorphic",
    "joint_types",
    "longest_piece",
    "measures",
    "mobility_report",
    "motion_roles",
    "move",
    "move_many",
    "pair",
    "parallel_motion",
    "path_curvature",
    "piece_of_ratio",
    "poles",
    "read_linkage",
    "read_train",
    "realise",
    "rotatability",
    "slider_cognates",
    "symmetry",
    "variants",
    "write_linkage",
]

_ROOMS = {
    "assur": ("assur_groups", "decompose"),
    "cams": ("Cam", "CamError"),
    "chain": ("Chain", "Joint"),
    "drawing": ("draw", "gallery_html"),
    "drawing.animation": ("animated_svg",),
    "drawing.linkage_picture": ("draw_linkage",),
    "enumeration": ("chains", "count_chains"),
    "errors": ("CatalogError", "ChainError", "GrueblerError", "LinkageError", "NotationError", "PairError"),
    "gears": ("GearError", "Train", "read_train"),
    "geneva": ("Geneva", "GenevaError"),
    "geometry": (
        "centrodes",
        "cognates",
        "coupler_sextic",
        "inflection_circle",
        "longest_piece",
        "parallel_motion",
        "path_curvature",
        "piece_of_ratio",
        "poles",
        "slider_cognates",
    ),
    "inversion": ("driven_mechanisms", "inversions"),
    "isomorphism": ("code", "decode", "find_isomorphism", "is_isomorphic", "symmetry"),
    "kinematics": (
        "Circuit",
        "Measures",
        "Motion",
        "circuit",
        "degrees",
        "drive_range",
        "four_bars",
        "measures",
        "motion_roles",
        "move",
        "move_many",
        "rotatability",
    ),
    "linkages": ("FourBar", "InvertedSliderCrank", "Linkage", "SliderCrank", "read_linkage", "write_linkage"),
    "mechanism": ("Mechanism", "check_drives"),
    "mobility": ("counted", "generic_mobility", "mobility_report"),
    "pairs": ("PAIRS", "Alphabet", "Pair", "Space", "pair"),
    "realisation": ("Realisation", "realise"),
    "specialisation": ("Requirements", "joint_types", "variants"),
    "transformation": ("derive", "extend"),
}
_HOME = {name: room for room, names in _ROOMS.items() for name in names}


def _picture(thing: Any) -> str:
    from gruebler.linkages import Linkage

    if isinstance(thing, Linkage):
        from gruebler.drawing.linkage_picture import draw_linkage

        return str(draw_linkage(thing, labels=True).svg())
    from gruebler.drawing import draw

    return str(draw(thing, labels=True).svg())


views.picture = _picture


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'gruebler' has no attribute {name!r}")
    value = getattr(import_module(f"gruebler.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOME])
