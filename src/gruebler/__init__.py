"""Structural synthesis of mechanisms. Grübler counted; we check the count.

`__init__.pyi` lists the names of the front door; each is loaded when it is first used, so that importing the library
is quick. Everything else lies in the wings: `gr.base`, `gr.structure`, `gr.machines`, `gr.mechanics`, `gr.design`,
`gr.files`, `gr.pictures`, `gr.teaching`, `gr.page`, each with its rooms, such as `gr.mechanics.geometry`. Angles are in
radians and lengths in the unit of the linkage, unless a name says otherwise.

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

from typing import TYPE_CHECKING, Any

from lazy_loader import attach_stub

from gruebler.base import notebook

if TYPE_CHECKING:
    from gruebler.base.columns import Table

__version__ = "0.2.0"
_opened, __dir__, __all__ = attach_stub(__name__, __file__)

_MEANT = {
    "analyse": "measures",
    "analyze": "measures",
    "assur": "decompose",
    "atlas": "structure.atlas",
    "balance": "mechanics.dynamics",
    "catalog": "teaching.catalog",
    "check": "mobility_report",
    "construct": "teaching.constructions",
    "convert": "files.convert",
    "curve": "coupler_curve",
    "dynamics": "inverse_dynamics",
    "enumerate": "chains",
    "exercise": "teaching.exercise",
    "gears": "Train",
    "grashof": "FourBar",
    "load": "read",
    "motion": "move",
    "open": "read",
    "save": "write",
    "sheet": "teaching.sheet",
    "solve": "move",
    "table": "teaching.teaching_table",
}
"""What commands, and likely names that no name is like, are called here."""


def __getattr__(name: str) -> Any:
    """A name of the front door, loaded; of another one it is said which was meant."""
    if name in __all__:
        return _opened(name)
    from gruebler.base.errors import nearest

    meant = _MEANT.get(name, name)
    suggestion = "" if name.startswith("_") else nearest(meant, [*__all__, *_MEANT.values()])
    # Without `obj`: with it Python would suggest the name a second time.
    raise AttributeError(f"gruebler has no attribute {name!r}{suggestion}", name=name)


def _picture(value: object) -> str:
    """The SVG of a value for a notebook."""
    if type(value).__name__ == "Sheet":
        from gruebler.teaching.sheets.layout import page

        return page(value).svg()
    from gruebler.pictures.values import picture_of

    return picture_of(value)


notebook.svg_of = _picture


_TABLES = {
    "Motion": ("analysis.table", "motion_table"),
    "SpatialMotion": ("space.motion_tables", "spatial_table"),
    "Statics": ("forces.tables", "statics_table"),
    "InverseDynamics": ("dynamics.tables", "dynamics_table"),
    "Simulation": ("dynamics.tables", "simulation_table"),
}


def _table(value: object, *options: Any, **named: Any) -> Table:
    """The table of a motion, of what is computed along it, or of a free motion."""
    from importlib import import_module

    room, name = _TABLES[type(value).__name__]
    table: Table = getattr(import_module(f"gruebler.mechanics.{room}"), name)(value, *options, **named)
    return table


notebook.table_of = _table
