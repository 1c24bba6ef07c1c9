"""A collection sheet: the texts of its record, and everything else derived from the mechanism."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gruebler.base.errors import CatalogError
from gruebler.base.notebook import Drawn, brief
from gruebler.base.text import Readable, Text, message
from gruebler.files import Entry
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry.lever_contact import lever_contact, lever_pose
from gruebler.mechanics.geometry.meyer_zur_capellen import symmetric_rocker
from gruebler.mechanics.geometry.roberts import cognates
from gruebler.mechanics.geometry.sizing import RatioCurve, Sizing, Window, ratio_curve, scale_for
from gruebler.mechanics.geometry.straight import Path, linkage_path
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.catalog import entry
from gruebler.teaching.catalog.features import AccessFeatures, access_features
from gruebler.teaching.sheets.expressions import Expression
from gruebler.teaching.sheets.records import CognateLength, Quantity, RockerValue, SheetRecord

_CLOSE = 1e-9  # relative: derived and exact value

_EXAMPLE = {
    "phi_G": message("example: crank angle over the straight line"),
    "phi_A": message("example: where it begins"),
    "ratio": message("example: length by the unit of the sheet"),
    "scale": message("example: unit of the sheet"),
}


def _expression(text: str | None) -> Expression | None:
    return None if text is None else Expression(text)


@dataclass(frozen=True, kw_only=True)
class StatedValue:
    """A value of the sheet: its name, exact value, value derived from the mechanism, and printed value."""

    id: str
    symbol: str
    derived: float
    exact: Expression | None
    printed: Expression | None
    name: Readable | None = None
    reason: Text | None = None
    """The reason for a wrong printed value."""
    remark: Text | None = None
    """A remark about a right printed value."""
    unit: str = ""
    of: tuple[str, ...] = ()
    """The points of a distance."""

    @property
    def is_exact(self) -> bool:
        """Whether the exact value is the derived one."""
        return self.exact is None or math.isclose(self.derived, self.exact.value, rel_tol=_CLOSE, abs_tol=_CLOSE)

    @property
    def is_as_printed(self) -> bool:
        """Whether the source prints the derived value, with the digits it prints."""
        if self.printed is None:
            return True
        if not self.printed.text.replace(".", "").isdigit():
            return math.isclose(self.derived, self.printed.value, rel_tol=_CLOSE, abs_tol=_CLOSE)
        digits = len(self.printed.text.partition(".")[2])
        return abs(self.derived - self.printed.value) <= 0.5 * 10.0**-digits * (1 + _CLOSE)

    @property
    def holds(self) -> bool:
        """Whether it is exact, and printed right or its misprint explained."""
        return self.is_exact and self.is_as_printed is (self.reason is None)


@dataclass(frozen=True)
class SizedMechanism:
    """The mechanism for a straight line of a length within a tolerance."""

    length: float
    tolerance: float
    sizing: Sizing
    lengths: tuple[tuple[str, float], ...]
    """Of the mechanism, by symbol."""

    @property
    def scale(self) -> float:
        """The sheet's unit of length, in the unit of the task."""
        return self.sizing.factor

    @property
    def ratio(self) -> float:
        """L by the sheet's unit."""
        return self.length / self.scale


@brief
@dataclass(frozen=True, repr=False)
class Sheet(Drawn):
    """A mechanism on one page.

    >>> from gruebler.teaching.sheets import sheet
    >>> found = sheet("mzc").sized(15, 0.075)
    >>> round(found.scale, 4), round(found.ratio, 6)
    (3.8389, 3.907352)
    """

    record: SheetRecord

    @property
    def id(self) -> str:
        """Its name."""
        return self.record.id

    @cached_property
    def entry(self) -> Entry:
        """The machine in the catalog."""
        return entry(self.record.machine)

    @cached_property
    def linkage(self) -> Linkage:
        """The machine with its dimensions."""
        return self.entry.linkage()

    @cached_property
    def features(self) -> AccessFeatures:
        """The access features."""
        return access_features(self.linkage.mechanism, self.entry.outputs)

    def motion(self, *degrees: float) -> Motion:
        """The linkage at drive values in degrees, with velocities."""
        return move_quietly(self.linkage, np.radians(degrees), speed=1.0)

    def place(self, motion: Motion, name: str, row: int = 0) -> complex:
        """The position of one of the sheet's points."""
        if name not in self.record.names:
            known = ", ".join(self.record.names)
            raise CatalogError("sheet {id}: {name!r} is none of the names {known}", id=self.id, name=name, known=known)
        return complex(motion.complex_point(self.record.names[name])[row])

    @cached_property
    def unit_length(self) -> float:
        """The sheet's unit of length, in that of the linkage."""
        motion = self.motion(self.record.guide.centre)
        first, second = (self.place(motion, name) for name in self.record.scale)
        return abs(first - second)

    @cached_property
    def dimensions(self) -> tuple[StatedValue, ...]:
        """The lengths of the mechanism, exact and derived from its dimensions."""
        motion = self.motion(self.record.guide.centre)
        values = []
        for row in self.record.dimensions:
            first, second = (self.place(motion, name) for name in row.of)
            exact = Expression(row.value)
            derived = abs(first - second) / self.unit_length
            values.append(
                StatedValue(id=row.symbol, symbol=row.symbol, derived=derived, exact=exact, printed=exact, of=row.of)
            )
        return tuple(values)

    @cached_property
    def quantities(self) -> tuple[StatedValue, ...]:
        """All other values of the sheet."""
        return tuple(
            StatedValue(
                id=row.id,
                symbol=row.symbol,
                derived=_derived_value(self, row),
                exact=_expression(row.value),
                printed=_expression(row.printed),
                name=row.name,
                reason=row.reason,
                remark=row.remark,
                unit=row.unit,
            )
            for row in self.record.quantities
        )

    @property
    def wrong(self) -> tuple[StatedValue, ...]:
        """Values that do not hold: not exact, or neither printed right nor explained."""
        return tuple(value for value in (*self.dimensions, *self.quantities, *self.example_values) if not value.holds)

    @property
    def path(self) -> Path:
        """The path of the point over the drive's values, in the sheet's unit."""
        path = linkage_path(self.linkage, self.record.names[self.record.point])
        return lambda values: path(values) / self.unit_length

    @cached_property
    def window(self) -> Window:
        """The drive values about the point of contact, and the direction of the tangent there."""
        guide = self.record.guide
        motion = self.motion(guide.centre)
        slope = complex(motion.complex_point(self.record.names[self.record.point], order=1)[0])
        start, centre, end = (math.radians(angle) for angle in (guide.start, guide.centre, guide.end))
        return Window(start, centre, end, math.atan2(slope.imag, slope.real) % math.pi)

    @cached_property
    def curve(self) -> RatioCurve:
        """Q_G and L over the window."""
        return ratio_curve(self.path, self.window)

    def sized(self, length: float, tolerance: float) -> SizedMechanism:
        """The smallest mechanism whose point is straight over a length within a tolerance, both in one unit.

        Raises `LinkageError` if no window is straight enough.
        """
        sizing = scale_for(self.path, self.window, length, tolerance)
        lengths = tuple((value.symbol, value.derived * sizing.factor) for value in self.dimensions)
        return SizedMechanism(length, tolerance, sizing, lengths)

    @cached_property
    def example(self) -> SizedMechanism:
        """The task of the sheet."""
        return self.sized(self.record.guide.length, self.record.guide.tolerance)

    @cached_property
    def example_values(self) -> tuple[StatedValue, ...]:
        """The results of the task, with the printed ones of the source."""
        piece = self.example.sizing.piece
        sized_mechanism, guide, scale = self.example, self.record.guide, self.record.dimensions[0].symbol
        start, end = (math.degrees(angle) for angle in (piece.start, piece.end))
        rows = (
            ("phi_G", "φ_G", end - start, "°", _EXAMPLE["phi_G"]),
            ("phi_A", "φ_A", start, "°", _EXAMPLE["phi_A"]),
            ("ratio", f"L/{scale}", sized_mechanism.ratio, "", _EXAMPLE["ratio"]),
            ("scale", scale, sized_mechanism.scale, f" {guide.unit}", _EXAMPLE["scale"]),
        )
        return tuple(
            StatedValue(
                id=key,
                symbol=symbol,
                derived=value,
                exact=None,
                printed=_expression(guide.printed.get(key)),
                name=name,
                unit=unit,
            )
            for key, symbol, value, unit, name in rows
        )


def _derived_value(sheet: Sheet, row: Quantity) -> float:
    """The value of a quantity; lengths in the sheet's unit, angles in degrees."""
    derive, at = next((make, getattr(row, key)) for key, make in _DERIVATIONS.items() if getattr(row, key) is not None)
    value = derive(sheet, at, row.at)
    return value if row.less_at is None else value - derive(sheet, at, row.less_at)


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


def _cognate(sheet: Sheet, cognate: CognateLength, at: float) -> float:
    size, u, v, phi, branch = lever_pose(sheet.linkage, sheet.record.names[sheet.record.point], math.radians(at))
    if not isinstance(size, FourBar):
        raise CatalogError("sheet {id}: only four-bars have cognates", id=sheet.id)
    length = getattr(cognates(size, u, v, branch=branch, phi=phi)[cognate.number - 1].size, cognate.length)
    return float(length) / sheet.unit_length


def _rocker(sheet: Sheet, request: RockerValue, _: float) -> float:
    rocker = symmetric_rocker(Expression(request.ratio).value)
    lever = rocker.lever
    if request.value == "k_by_cognate":  # in the size in which it draws the sheet's own curve
        return lever.k * _cognate(sheet, CognateLength(number=2, length="a"), 0.0) / lever.size.a
    return {
        "phi0": math.degrees(rocker.phi0),
        "sin_phi0": math.sin(rocker.phi0),
        "l1": lever.size.a,
        "l2": lever.size.b,
        "l4": lever.size.d,
        "k": lever.k,
        "tan_kappa": math.tan(lever.kappa),
    }[request.value]


_DERIVATIONS: dict[str, Callable[..., float]] = {
    "angle": _angle,
    "cosine": _cosine,
    "distance": _distance,
    "contact_at": _contact,
    "cognate": _cognate,
    "rocker": _rocker,
}
