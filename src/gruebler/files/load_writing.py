"""Loads as plain data for the table ``[loads]`` of a linkage's file, from which they are read again exactly."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gruebler.base.errors import LinkageError
from gruebler.base.units import quantity_text
from gruebler.files.angles import in_degrees
from gruebler.files.load_records import SPRING, TORSION_SPRING
from gruebler.mechanics.forces.bodies import RigidBody
from gruebler.mechanics.forces.laws import Curve, LoadFormula, Motor
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.springs import Gas, Spring, TorsionSpring
from gruebler.mechanics.linkages.elements import LinkPoint
from gruebler.mechanics.linkages.model import Linkage


def loads_to_json(loads: Loads, linkage: Linkage, speed: float | None = None) -> dict[str, Any]:
    """Plain data for ``[loads]``, with the usual speed of the only drive; `loads_from_json` takes it back exactly.

    Raises `LinkageError` for what a file cannot hold: one value for each row, functions of Python.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> loads_to_json(Loads(moments={"rocker": 5.0}), FourBar(25, 70, 40, 70).linkage())["moments"]
    {'rocker': '5.0 N mm'}
    """

    def text(value: float, quantity: str) -> str:
        return quantity_text(value, quantity, linkage.unit)

    def amount(where: str, value: Any, quantity: str) -> Any:
        return _amount(where, value, quantity, text)

    turning = {name: drive.turning for name, drive in _drives(linkage).items()}
    tables: dict[str, Any] = {
        "speed": None if speed is None else text(speed, "speed" if all(turning.values()) else "velocity"),
        "gravity": [text(each, "acceleration") for each in loads.gravity],
        "bodies": {link: _body(body, text) for link, body in loads.bodies.items()},
        "masses": {_point(point): text(_number(f"masses.{point}", m), "mass") for point, m in loads.masses.items()},
        "forces": {_point(point): _force(_point(point), pair, amount) for point, pair in loads.forces.items()},
        "moments": {link: amount(f"moments.{link}", moment, "moment") for link, moment in loads.moments.items()},
        "springs": [_spring(spring, text) for spring in loads.springs],
        "torsion_springs": [_torsion_spring(spring, text) for spring in loads.torsion_springs],
        "motors": {
            joint: _motor(joint, motor, turning.get(joint, True), text) for joint, motor in loads.motors.items()
        },
    }
    return {key: table for key, table in tables.items() if table}


_Text = Callable[[float, str], str]


def _drives(linkage: Linkage) -> dict[str, Any]:
    mechanism = linkage.mechanism
    return dict(zip(mechanism.drive_names(), mechanism.drives, strict=True))


def _point(point: Any) -> str:
    match point:
        case str():
            return point
        case LinkPoint(link, x, y) | (link, x, y):
            return f"{link}:{float(x)!r},{float(y)!r}"
        case (x, y):
            return f"{float(x)!r},{float(y)!r}"
    raise LinkageError("loads: {point!r} names no point", point=point)


def _number(where: str, value: Any) -> float:
    if not isinstance(value, int | float | np.ndarray | np.generic) or np.ndim(value):
        raise LinkageError(
            "loads.{where}: a file holds a number, a formula or a curve, not one value for each row or a function",
            where=where,
        )
    return float(value)


def _amount(where: str, value: Any, quantity: str, text: _Text) -> Any:
    match value:
        case str() | LoadFormula():
            formula = value if isinstance(value, str) else value.text
            return {"formula": formula, "unit": _unit(quantity, text)}
        case Curve():
            return {**_curve(value, quantity, text), "of": value.of}
    return text(_number(where, value), quantity)


def _unit(quantity: str, text: _Text) -> str:
    return text(1.0, quantity).partition(" ")[2]


def _curve(curve: Curve, quantity: str, text: _Text) -> dict[str, Any]:
    table = {"curve": [list(point) for point in curve.points], "unit": _unit(quantity, text)}
    return table if curve.period is None else {**table, "period": float(curve.period)}


def _force(point: str, pair: Any, amount: Callable[[str, Any, str], Any]) -> list[Any]:
    where = f"forces.{point}"
    if np.ndim(np.asarray(pair, dtype=object)) != 1 or len(pair) != 2:
        _number(where, np.zeros(1))
    return [amount(where, part, "force") for part in pair]


def _body(body: RigidBody, text: _Text) -> dict[str, Any]:
    table = {"mass": text(body.mass, "mass"), "centre": list(body.centre)}
    return {**table, "inertia": text(body.inertia, "inertia")} if body.inertia else table


def _spring(spring: Spring, text: _Text) -> dict[str, Any]:
    table: dict[str, Any] = {"between": [_point(point) for point in spring.between]}
    if spring.free_length:
        table["free_length"] = float(spring.free_length)
    table |= _numbers(spring, SPRING, text)
    match spring.law:
        case Gas(force=force, extended=extended, stroke=stroke, growth=growth):
            sizes = {"extended": float(extended), "stroke": float(stroke), "growth": float(growth)}
            table["gas"] = {"force": text(force, "force"), **sizes}
        case _:
            table |= _law("springs", spring.law, "force", text)
    return table


def _torsion_spring(spring: TorsionSpring, text: _Text) -> dict[str, Any]:
    table: dict[str, Any] = {"between": list(spring.between)}
    if spring.free_angle:
        table["free_angle"] = in_degrees(float(spring.free_angle))
    return table | _numbers(spring, TORSION_SPRING, text) | _law("torsion_springs", spring.law, "moment", text)


def _numbers(spring: Spring | TorsionSpring, quantities: Mapping[str, str], text: _Text) -> dict[str, str]:
    """Those that are not 0."""
    return {key: text(number, kind) for key, kind in quantities.items() if (number := getattr(spring, key))}


def _law(where: str, law: Any, quantity: str, text: _Text) -> dict[str, Any]:
    """The further force of a spring: a curve, or none."""
    if law is None:
        return {}
    if not isinstance(law, Curve):
        _number(where, law)
    return {"law": _curve(law, quantity, text)}


def _motor(joint: str, motor: Any, turning: bool, text: _Text) -> dict[str, Any]:
    effort, speed = ("moment", "speed") if turning else ("force", "velocity")
    if isinstance(motor, Motor):
        return {"stall": text(motor.stall, effort), "idle_speed": text(motor.idle_speed, speed)}
    table = _amount(f"motors.{joint}", motor, effort, text)
    if isinstance(table, str):
        return {"formula": repr(float(motor)), "unit": _unit(effort, text)}
    return dict(table)
