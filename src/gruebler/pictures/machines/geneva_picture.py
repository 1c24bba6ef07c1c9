"""Pictures of Geneva drives to scale: wheel with slots, driver with pins and locking disc: docs/theory/drawing.md."""

from __future__ import annotations

import math

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.text import message, translate
from gruebler.machines.geneva import Geneva, GenevaError
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.moving_picture import (
    Body,
    Clock,
    MovingPicture,
    Shift,
    Turn,
    always,
    even_keys,
    moving,
    still_picture,
)
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.canvas.symbols import arrow_head
from gruebler.pictures.machines.geneva_shape import GenevaShape
from gruebler.pictures.machines.turn_diagram import beneath, running, turn_diagram

_PIXELS = 360.0  # the approximate greater extent
_KEYS = 240  # of a turn of the driver
_TITLES = {
    False: message("External Geneva drive with {slots} slots"),
    True: message("Internal Geneva drive with {slots} slots"),
}


def draw_geneva(geneva: Geneva, *, at: float = 0.0, plot: bool = False, lang: str = "en", name: str = "") -> Figure:
    """A Geneva drive in one position of its driver.

    Options as for `gruebler.draw`; pins, walls and locking disc have sensible thicknesses.

    Raises `gruebler.GenevaError` for an angle that is no finite number.

    >>> draw_geneva(Geneva(4), at=0.5).description.partition("clockwise. ")[2]
    'Driver at 28.6479°, wheel at -41.78°, ratio -0.4656.'
    """
    if isinstance(at, bool) or not isinstance(at, int | float):
        raise GenevaError("the driver's angle is a finite number, not {at!r}", at=at)
    moved = geneva.move(at)
    bodies = _machine(geneva, np.array([at], np.float64))
    if plot:
        bodies.append(Body(tuple(beneath(ratio_panels(geneva, at, lang), bodies))))
    pose = translate(
        "Driver at {driver:g}°, wheel at {wheel:.4g}°, ratio {ratio:.4g}.",
        lang,
        driver=round(math.degrees(at), 4),
        wheel=math.degrees(float(moved.angle)) + 0.0,
        ratio=float(moved.ratio) + 0.0,
    )
    locked = [translate("The wheel is locked.", lang)] if moved.dwell else []
    return still_picture(bodies, name or _title(geneva, lang), " ".join([_about(geneva, lang), pose, *locked]))


def animate_geneva(
    geneva: Geneva, *, plot: bool = True, seconds: float = 4.0, lang: str = "en", name: str = ""
) -> MovingPicture:
    """A turn of the driver, after which the picture repeats; a cursor moves through the diagram below.

    Raises `gruebler.GrueblerError` for a time that is no positive number of seconds.
    """
    bodies = _machine(geneva, np.linspace(0.0, math.tau, _KEYS + 1))
    if plot:
        bodies += running(beneath(ratio_panels(geneva, None, lang), bodies))
    about = " ".join([_about(geneva, lang), translate("A turn of the driver in {seconds:g} s.", lang, seconds=seconds)])
    return moving(
        bodies, Clock(seconds=always(seconds), low=0.0, high=360.0, unit="°"), name or _title(geneva, lang), about
    )


def ratio_panels(geneva: Geneva, at: float | None = None, lang: str = "en") -> Figure:
    """The wheel's angle, its ratio and its acceleration over a turn of the driver, with an angle (radians) marked."""
    pitch = math.tau / geneva.pins
    ends = [k * pitch + s * geneva.engaged for k in range(geneva.pins + 1) for s in (-1, 1)]
    beside = [end + tiny for end in ends for tiny in (-1e-9, 1e-9)]
    x = np.unique(np.clip(np.concatenate([np.linspace(0.0, math.tau, 721), beside]), 0.0, math.tau))
    geneva_motion = geneva.move(x)
    rows = [
        ("ψ in °", np.degrees(geneva_motion.angle)),
        ("ψ′ = dψ/dφ", geneva_motion.ratio),
        ("ψ″ = d²ψ/dφ²", geneva_motion.acceleration),
    ]
    return turn_diagram(x, rows, at, translate("Wheel over the driver's angle", lang), lang)


def _title(geneva: Geneva, lang: str) -> str:
    return _TITLES[geneva.internal].filled(slots=geneva.slots).in_language(lang)


def _about(geneva: Geneva, lang: str) -> str:
    return translate(
        "A Geneva drive, to scale: {slots} slots, {pins} pin(s), the driver turning counter-clockwise.",
        lang,
        slots=geneva.slots,
        pins=geneva.pins,
    )


# --- the machine -----------------------------------------------------------------------------------


def _machine(geneva: Geneva, phi: Reals) -> list[Body]:
    """Wheel and driver at one angle, or at keys evenly through a turn."""
    shape = GenevaShape(geneva)
    scale = _PIXELS / (2 * shape.rim if geneva.internal else 1 + shape.mouth + shape.crank)
    axis, middle = Point(scale * shape.axis, 0.0), Point(0.0, 0.0)
    contour = _pixels(shape.wheel(), scale)
    if geneva.internal:
        rim = shape.rim * np.exp(-1j * np.linspace(0, math.tau, 181))
        wheel: tuple[Shape, ...] = (Polylines((contour, _pixels(rim, scale)), "area", closed=True),)
    else:
        wheel = (Polylines((contour,), "area", closed=True),)
    pins = [
        Point(scale * z.real, -scale * z.imag)
        for z in shape.crank * np.exp(2j * math.pi / geneva.pins * np.arange(geneva.pins))
    ]
    ends = [*pins, Point(-scale * shape.lock, 0.0)] if geneva.internal else pins
    arms: list[Shape] = [Polylines(tuple((middle, end) for end in ends), f"{kind}-rod") for kind in ("outline", "body")]
    disc = Polylines(tuple(_pixels(part, scale) for part in shape.locking()), "block", closed=True)
    tips = [CircleShape(pin, scale * shape.pin, "joint") for pin in pins]
    arrow = ArcShape(middle, radius=14.0, begin=math.radians(-30), extent=math.radians(-120), style="drive")
    fixed: list[Shape] = [
        Polylines(((axis, middle),), "dead"),
        CircleShape(axis, 6.2, "joint"),
        CircleShape(middle, 6.2, "joint"),
    ]
    turn = even_keys(1.0 if len(phi) > 1 else 0.0, float(phi[0]))
    steps = (Shift((axis,)), Turn(tuple(geneva.move(phi).angle.tolist())))
    return [
        Body(tuple(arms), (turn,)),
        Body(wheel, steps),
        Body((disc, *tips), (turn,)),
        Body((*fixed, arrow, arrow_head(arrow))),
    ]


def _pixels(points: Complexes, scale: float) -> tuple[Point, ...]:
    line = [Point(scale * z.real, -scale * z.imag) for z in points.tolist()]
    return tuple(simplified(line, FINE))
