"""The loads of a linkage from the table ``[loads]`` of its file.

Lengths and places are in the unit of the file, angles in degrees, as everywhere in it; variables of formulas and curves
are those of the library. docs/theory/linkage-files.md has every key.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import msgspec

from gruebler.base.documents import convert_document
from gruebler.base.errors import GrueblerError, LinkageError, naming
from gruebler.base.units import quantity_of
from gruebler.files.element_records import in_short, read_numbers
from gruebler.files.load_records import (
    SPRING,
    TORSION_SPRING,
    BodyRecord,
    LawRecord,
    LoadsRecord,
    MotorRecord,
    SpringRecord,
    TorsionSpringRecord,
)
from gruebler.mechanics.forces.bodies import RigidBody
from gruebler.mechanics.forces.laws import Curve, Law, LoadFormula, Motor
from gruebler.mechanics.forces.loads import STANDARD_GRAVITY, Loads
from gruebler.mechanics.forces.springs import Gas, Spring, TorsionSpring, check_between_links
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.points import points_of

_LARGEST = 1e100


@dataclass(frozen=True, slots=True)
class _Reader:
    """Reads the tables of a linkage's loads."""

    linkage: Linkage
    drawn: bool = False
    """Whether bodies lie in the coordinates of the drawing."""

    def quantity(self, where: str, raw: Any, quantity: str, default: float | None = None) -> float:
        if raw is None and default is not None:
            return default
        if raw is None:
            raise LinkageError("{where}: missing", where=where)
        unit = "m" if quantity in ("acceleration", "density") else self.linkage.unit
        try:
            value = quantity_of(where, raw if isinstance(raw, str) else str(in_short(raw)), quantity, unit)
        except GrueblerError as error:
            raise LinkageError(error.text, **error.values) from None
        if not abs(value) < _LARGEST:
            raise LinkageError(
                "{where}: expected numbers below 1e100, but found {found}", where=where, found=in_short(raw)
            )
        return value

    def link(self, where: str, link: str) -> str:
        """The link as it is called; `LinkageError` if there is none."""
        return _told(where, lambda: self.linkage.mechanism.chain.links[self.linkage.mechanism.chain.index(link)])

    def point(self, where: str, point: str) -> str:
        _told(where, lambda: points_of(self.linkage, point))
        return point

    def body(self, link: str, raw: Any) -> RigidBody:
        """The body of a link, in the link's coordinates."""
        self.link("loads.bodies", link)
        pose = (self.linkage.reference_pose or {}).get(link) if self.drawn else None
        if pose is None:
            return self.body_there(link, raw, (0.0, 0.0))
        body = self.body_there(link, raw, (pose.x, pose.y))
        return replace(body, centre=pose.to_local(*body.centre))

    def body_there(self, link: str, raw: Any, origin: tuple[float, float]) -> RigidBody:
        """The body in the coordinates of the file, where the link's origin lies so."""
        where = f"loads.bodies.{link}"
        record = convert_document(raw, BodyRecord, LinkageError, where)
        shapes = [shape for shape in ("bar", "disc", "plate") if getattr(record, shape) is not None]
        if len(shapes) > 1:
            raise LinkageError(
                "{where}: {one} and {other} exclude each other", where=where, one=shapes[0], other=shapes[1]
            )
        shape = shapes[0] if shapes else "mass"
        wrong = next(
            (
                key
                for key in msgspec.structs.asdict(record)
                if getattr(record, key) is not None and key not in _KEYS[shape]
            ),
            None,
        )
        if wrong is not None:
            raise LinkageError("{where}.{wrong}: does not go with {kind}", where=where, wrong=wrong, kind=shape)
        centre = _place(record.centre, f"{where}.centre", origin)
        if shape == "plate":
            assert record.plate is not None
            outline = [_place(corner, f"{where}.plate") for corner in record.plate]
            density = self.quantity(f"{where}.density", record.density, "density")
            thickness = record.thickness or 0.0
            return _told(where, lambda: RigidBody.plate(outline, thickness, density, unit=self.linkage.unit))
        mass = self.quantity(f"{where}.mass", record.mass, "mass")
        if shape == "bar":
            if not isinstance(record.bar, list) or len(record.bar) != 2:
                raise LinkageError("{where}.bar: expected two places [[x, y], [x, y]]", where=where)
            start, end = (_place(each, f"{where}.bar") for each in record.bar)
            return _told(where, lambda: RigidBody.bar(mass, start, end))
        if record.disc is not None:
            radius = record.disc
            return _told(where, lambda: RigidBody.disc(mass, radius, centre=centre))
        inertia = self.quantity(f"{where}.inertia", record.inertia, "inertia", 0.0)
        if record.about is None:
            return _told(where, lambda: RigidBody(mass, centre, inertia))
        about = _place(record.about, f"{where}.about")
        return _told(where, lambda: RigidBody.about(about, mass, centre, inertia))

    def amount(self, where: str, raw: Any, quantity: str) -> float | Law:
        """A quantity, or a formula or curve in a unit."""
        if not isinstance(raw, Mapping):
            return self.quantity(where, raw, quantity)
        record = convert_document(raw, LawRecord, LinkageError, where)
        return self.law(where, record, quantity)

    def law(self, where: str, record: LawRecord, quantity: str, of: str | None = None) -> Law:
        """The law of a record; a curve without ``of`` is one of the drive, or of a spring's length or angle."""
        if (record.formula is None) == (record.curve is None):
            raise LinkageError("{where}: expected either formula or curve", where=where)
        factor = self.quantity(f"{where}.unit", f"1 {record.unit}", quantity)
        if (formula := record.formula) is not None:
            if record.of is not None or record.of_unit is not None or record.period is not None:
                raise LinkageError("{where}: of, of_unit and period go with curve", where=where)
            text = formula if factor == 1 else f"{factor!r}*({formula})"
            return _told(f"{where}.formula", lambda: (LoadFormula(formula), LoadFormula(text))[1])
        assert record.curve is not None
        of = record.of or ("drive" if of is None else of)
        step = self.step(f"{where}.of_unit", of, record.of_unit)
        points = [(step * x, factor * y) for x, y in record.curve]
        period = None if record.period is None else step * record.period
        return _told(f"{where}.curve", lambda: Curve(points, record.of or "drive", period))

    def step(self, where: str, of: str, unit: str | None) -> float:
        """What 1 is, in radians, seconds and the unit of length, of a variable written in a unit."""
        drives = self.linkage.mechanism.drives
        turning = bool(drives) and drives[0].turning
        quantity = {"drive": "angle" if turning else "length", "speed": "speed" if turning else "velocity"} | _VARIABLES
        if unit is None:
            return 1.0
        if of not in quantity:
            raise LinkageError("{where}: goes with a curve of an angle, a length or a speed", where=where)
        return self.quantity(where, f"1 {unit}", quantity[of])

    def force(self, point: str, raw: Any) -> tuple[Any, Any]:
        where = f"loads.forces.{point}"
        self.point("loads.forces", point)
        if not isinstance(raw, list) or len(raw) != 2:
            raise LinkageError(
                '{where}: expected two components such as ["0 N", "-20 N"], but found {found}',
                where=where,
                found=in_short(raw),
            )
        return (self.amount(where, raw[0], "force"), self.amount(where, raw[1], "force"))

    def spring(self, number: int, record: SpringRecord) -> Spring:
        where = f"loads.springs[{number}]"
        between = tuple(self.point(f"{where}.between", point) for point in record.between)
        if record.gas is not None and record.law is not None:
            raise LinkageError("{where}: {one} and {other} exclude each other", where=where, one="gas", other="law")
        law: Any = None
        if (gas := record.gas) is not None:
            force = self.quantity(f"{where}.gas.force", gas.force, "force")
            law = _told(
                f"{where}.gas", lambda: Gas(force=force, extended=gas.extended, stroke=gas.stroke, growth=gas.growth)
            )
        elif record.law is not None:
            law = self.characteristic(f"{where}.law", record.law, "force")
        numbers = self.numbers(where, record, SPRING)
        spring = _told(
            where, lambda: Spring((between[0], between[1]), free_length=record.free_length, law=law, **numbers)
        )
        check_between_links(self.linkage, spring, where)
        return spring

    def torsion_spring(self, number: int, record: TorsionSpringRecord) -> TorsionSpring:
        where = f"loads.torsion_springs[{number}]"
        between = tuple(self.link(f"{where}.between", link) for link in record.between)
        law = None if record.law is None else self.characteristic(f"{where}.law", record.law, "moment")
        numbers = self.numbers(where, record, TORSION_SPRING)
        angle = read_numbers([0, 0, record.free_angle], f"{where}.free_angle", (3,))[2]
        return _told(where, lambda: TorsionSpring((between[0], between[1]), free_angle=angle, law=law, **numbers))

    def numbers(
        self, where: str, record: SpringRecord | TorsionSpringRecord, quantities: Mapping[str, str]
    ) -> dict[str, float]:
        """The numbers of a spring by their keys."""
        return {key: self.quantity(f"{where}.{key}", getattr(record, key), of, 0.0) for key, of in quantities.items()}

    def characteristic(self, where: str, record: LawRecord, quantity: str) -> Curve:
        """The law of a spring: a curve of its length or angle."""
        if record.curve is None or record.of is not None:
            raise LinkageError(
                "{where}: the law of a spring is a curve of its length or angle, without of", where=where
            )
        law = self.law(where, record, quantity, "length" if quantity == "force" else "angle")
        assert isinstance(law, Curve)
        return law

    def motor(self, joint: str, raw: Any) -> Law:
        where, mechanism = f"loads.motors.{joint}", self.linkage.mechanism
        number = _told("loads.motors", lambda: mechanism.chain.joint_number(joint, error=LinkageError))
        drive = next((drive for drive in mechanism.drives if drive.joint == number), None)
        if drive is None:
            raise LinkageError("loads.motors: {joint} is not driven", joint=joint)
        effort, speed = ("moment", "speed") if drive.turning else ("force", "velocity")
        if isinstance(raw, Mapping) and "unit" in raw:
            return self.law(where, convert_document(raw, LawRecord, LinkageError, where), effort)
        record = convert_document(raw, MotorRecord, LinkageError, where)
        stall = self.quantity(f"{where}.stall", record.stall, effort)
        idle = self.quantity(f"{where}.idle_speed", record.idle_speed, speed)
        return _told(where, lambda: Motor(stall, idle))


_VARIABLES = {
    **dict.fromkeys(("x", "y", "length"), "length"),
    **dict.fromkeys(("vx", "vy"), "velocity"),
    "angle": "angle",
    "omega": "speed",
}
"""The quantities of variables, beside those of the drive."""

Value = TypeVar("Value")

_KEYS = {
    "mass": ("mass", "centre", "inertia", "about"),
    "bar": ("bar", "mass"),
    "disc": ("disc", "mass", "centre"),
    "plate": ("plate", "thickness", "density"),
}


def _told(where: str, make: Callable[[], Value]) -> Value:
    """What is made; errors have the key in front."""
    with naming(where, LinkageError):
        return make()


def _place(raw: Any, where: str, default: tuple[float, float] | None = None) -> tuple[float, float]:
    if raw is None and default is not None:
        return default
    x, y = read_numbers(raw, where, (2,))
    return x, y


def loads_from_json(data: Any, linkage: Linkage, *, drawn: bool = False) -> Loads:
    """The loads of plain data: the content of ``[loads]``; of a file with ``[places]`` bodies lie in the drawing.

    Raises `LinkageError` with the key of the first thing that does not fit.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> crank = {"bodies": {"crank": {"mass": "250 g", "bar": [[0, 0], [25, 0]]}}}
    >>> loads_from_json(crank, FourBar(25, 70, 40, 70).linkage()).bodies["crank"]
    RigidBody(mass=0.25, centre=(12.5, 0.0), inertia=13.020833333333334)
    """
    record, reader = convert_document(data, LoadsRecord, LinkageError, "loads"), _Reader(linkage, drawn)
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    if record.gravity is not None:
        if len(record.gravity) != 2:
            raise LinkageError('loads.gravity: expected two components such as ["0 m/s2", "-9.81 m/s2"]')
        x, y = (reader.quantity("loads.gravity", each, "acceleration") for each in record.gravity)
        gravity = (x, y)
    return Loads(
        {point: reader.force(point, raw) for point, raw in record.forces.items()},
        moments={
            reader.link("loads.moments", link): reader.amount(f"loads.moments.{link}", raw, "moment")
            for link, raw in record.moments.items()
        },
        masses={
            reader.point("loads.masses", point): reader.quantity(f"loads.masses.{point}", raw, "mass")
            for point, raw in record.masses.items()
        },
        gravity=gravity,
        bodies={link: reader.body(link, raw) for link, raw in record.bodies.items()},
        springs=tuple(reader.spring(number, each) for number, each in enumerate(record.springs)),
        torsion_springs=tuple(
            reader.torsion_spring(number, each) for number, each in enumerate(record.torsion_springs)
        ),
        motors={joint: reader.motor(joint, raw) for joint, raw in record.motors.items()},
    )


def loads_of_document(document: Mapping[str, Any], linkage: Linkage) -> tuple[Loads, float | None]:
    """The loads in the document of a linkage, none without ``loads``, and the speed at which its drive usually runs."""
    table = document.get("loads", {})
    return loads_from_json(table, linkage, drawn="places" in document), usual_speed(table, linkage)


def usual_speed(data: Any, linkage: Linkage) -> float | None:
    """The speed in ``[loads]`` of the only drive, in radians or the linkage's unit a second; None without one.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> round(usual_speed({"speed": "30 rpm"}, FourBar(25, 70, 40, 70).linkage()), 9)
    3.141592654
    """
    speed, drives = convert_document(data, LoadsRecord, LinkageError, "loads").speed, linkage.mechanism.drives
    if speed is None:
        return None
    if len(drives) != 1:
        raise LinkageError("loads.speed: goes with one drive; the linkage has {count}", count=len(drives))
    return _Reader(linkage).quantity("loads.speed", speed, "speed" if drives[0].turning else "velocity")
