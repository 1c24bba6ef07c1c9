"""How the values of a sheet are derived from its mechanism: a row for each way."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from gruebler.errors import CatalogError
from gruebler.geometry.lever_contact import lever_contact, lever_pose
from gruebler.geometry.meyer_zur_capellen import symmetric_rocker
from gruebler.geometry.roberts import cognates
from gruebler.linkages import FourBar
from gruebler.linkages.expressions import Expression
from gruebler.sheets.records import CognateLength, Quantity, RockerValue

if TYPE_CHECKING:
    from gruebler.sheets.model import Sheet

__all__ = ["derive"]


def derive(sheet: Sheet, row: Quantity) -> float:
    """The value of a quantity; lengths in the sheet's unit, angles in degrees."""
    way, at = next((make, getattr(row, key)) for key, make in _WAYS.items() if getattr(row, key) is not None)
    value = way(sheet, at, row.at)
    return value if row.less_at is None else value - way(sheet, at, row.less_at)


def _angle(sheet: Sheet, names: tuple[str, str, str], at: float) -> float:
    motion = sheet.motion(at)
    first, apex, last = (sheet.place(motion, name) for name in names)
    return math.degrees(cmath.phase((last - apex) / (first - apex)))


def _cosine(sheet: Sheet, names: tuple[str, str, str], at: float) -> float:
    return math.cos(math.radians(_angle(sheet, names, at)))


def _distance(sheet: Sheet, names: tuple[str, str], at: float) -> float:
    motion = sheet.motion(at)
    first, second = (sheet.place(motion, name) for name in names)
    return abs(first - second) / sheet.unit_length


def _contact(sheet: Sheet, at: float, _: float) -> float:
    size, u, v, phi, branch = lever_pose(sheet.linkage, sheet.record.names[sheet.record.point], math.radians(at))
    return lever_contact(size, u, v, phi, branch=branch).points


def _cognate(sheet: Sheet, wanted: CognateLength, at: float) -> float:
    size, u, v, phi, branch = lever_pose(sheet.linkage, sheet.record.names[sheet.record.point], math.radians(at))
    if not isinstance(size, FourBar):
        raise CatalogError(f"sheet {sheet.id}: cognates are those of four-bars")
    length = getattr(cognates(size, u, v, branch=branch, phi=phi)[wanted.number - 1].size, wanted.length)
    return float(length) / sheet.unit_length


def _rocker(sheet: Sheet, wanted: RockerValue, _: float) -> float:
    made = symmetric_rocker(Expression(wanted.ratio).value)
    lever = made.lever
    if wanted.value == "k_by_cognate":  # in the size in which it draws the sheet's own curve
        return lever.k * _cognate(sheet, CognateLength(number=2, length="a"), 0.0) / lever.size.a
    return {
        "phi0": math.degrees(made.phi0),
        "sin_phi0": math.sin(made.phi0),
        "l1": lever.size.a,
        "l2": lever.size.b,
        "l4": lever.size.d,
        "k": lever.k,
        "tan_kappa": math.tan(lever.kappa),
    }[wanted.value]


_WAYS: dict[str, Callable[..., float]] = {
    "angle": _angle,
    "cosine": _cosine,
    "distance": _distance,
    "contact_at": _contact,
    "cognate": _cognate,
    "rocker": _rocker,
}
