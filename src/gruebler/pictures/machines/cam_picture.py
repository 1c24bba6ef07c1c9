"""Pictures of disc cams with their followers, to scale, and the diagram of the lift beneath: docs/theory/drawing.md."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.text import message, translate
from gruebler.machines.cams import Cam, CamError
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.moving_picture import (
    Body,
    Clock,
    MovingPicture,
    always,
    even_keys,
    key_list,
    moving,
    still_picture,
)
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape, bounds
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.canvas.symbols import arrow_head
from gruebler.pictures.machines.cam_follower import follower_body, ground
from gruebler.pictures.machines.turn_diagram import beneath, running, turn_diagram

_PIXELS = 150.0  # from the axis to the farthest point of the cam
_ROWS = 720  # points of the contour
_KEYS = 180  # of a turn
_HOLE = 56.0  # pixels: cams with a smaller base circle have no mark
_ALPHA = 62.0  # pixels: radius of the arc of the pressure angle
_BESIDE = 0.4  # radians: a smaller pressure angle is written beside the guide
_TITLES = {
    (False, "roller"): message("Cam with a translating roller follower"),
    (False, "knife"): message("Cam with a translating knife-edge follower"),
    (False, "flat"): message("Cam with a translating flat-faced follower"),
    (True, "roller"): message("Cam with a swinging roller follower"),
    (True, "knife"): message("Cam with a swinging knife-edge follower"),
    (True, "flat"): message("Cam with a swinging flat-faced follower"),
}


def draw_cam(cam: Cam, *, at: float | None = None, plot: bool = False, lang: str = "en", name: str = "") -> Figure:
    """A cam with its follower in one position, with base circle, pitch curve and pressure angle.

    Options as for `gruebler.draw`; without ``at`` at its greatest pressure angle.

    Raises `gruebler.CamError` for an angle that is no finite number.

    >>> from gruebler.machines.cams import Roller, read_lift
    >>> cam = Cam(read_lift("rise 20 90; dwell 90; fall 20 90; dwell"), base=40, follower=Roller(10, offset=5))
    >>> draw_cam(cam, at=1.0).title
    'Cam with a translating roller follower'
    """
    if at is None:
        at = max(cam.findings().pressure, key=lambda extreme: abs(extreme.value)).at
    if isinstance(at, bool) or not isinstance(at, int | float) or not math.isfinite(at):
        raise CamError("the cam's angle is a finite number, not {at!r}", at=at)
    scale = _scale(cam)
    shown = [*_machine(cam, scale, np.array([at]), lang), Body(tuple(_pressure(cam, scale, at, lang)))]
    if plot:
        shown += [Body(tuple(beneath(lift_diagram(cam, at, lang), shown)))]
    lift = float(cam.lift.at(at))
    pose = translate(
        "At {angle:g}° the lift is {lift:.4g}°, the pressure angle {pressure:.2f}°."
        if cam.follower.swings
        else "At {angle:g}° the lift is {lift:.4g}, the pressure angle {pressure:.2f}°.",
        lang,
        angle=round(math.degrees(at), 2) + 0.0,
        lift=(math.degrees(lift) if cam.follower.swings else lift) + 0.0,
        pressure=math.degrees(float(cam.pressure_angle(at))) + 0.0,
    )
    return still_picture(shown, name or _title(cam, lang), f"{_about(cam, lang)} {pose}")


def animate_cam(
    cam: Cam, *, plot: bool = True, seconds: float = 4.0, lang: str = "en", name: str = ""
) -> MovingPicture:
    """A turn of the cam with its follower; a cursor moves through the diagram of the lift below.

    Raises `gruebler.GrueblerError` for a time that is no positive number of seconds.

    >>> from gruebler.machines.cams import Flat, read_lift
    >>> from gruebler.pictures.canvas.moving_picture import moving_svg
    >>> cam = Cam(read_lift("rise 20 90; dwell 90; fall 20 90; dwell"), base=60, follower=Flat())
    >>> moving_svg(animate_cam(cam)).count("<animateTransform")
    3
    """
    scale = _scale(cam)
    bodies = _machine(cam, scale, np.linspace(0, math.tau, _KEYS + 1), lang)
    if plot:
        bodies += running(beneath(lift_diagram(cam, None, lang), bodies))
    about = " ".join([_about(cam, lang), translate("It makes a turn in {seconds:g} s.", lang, seconds=seconds)])
    return moving(
        bodies, Clock(seconds=always(seconds), low=0.0, high=360.0, unit="°"), name or _title(cam, lang), about
    )


def _scale(cam: Cam) -> float:
    """Pixels to a unit."""
    turn = np.linspace(0, math.tau, 181)
    return _PIXELS / float(np.hypot(*np.concatenate([cam.profile(turn), cam.pitch(turn)]).T).max())


def _title(cam: Cam, lang: str) -> str:
    kind = "flat" if cam.follower.has_face else "roller" if cam.follower.radius else "knife"
    return _TITLES[cam.follower.swings, kind].in_language(lang)


def _about(cam: Cam, lang: str) -> str:
    about = translate(
        "A disc cam, to scale, base circle {radius:.4g}, turning counter-clockwise.", lang, radius=cam.base
    )
    report = cam.findings()
    if not report.undercut:
        return about
    at = math.degrees(report.room.at)
    undercut = translate("Undercut near {angle:.4g}°: the profile crosses itself.", lang, angle=at)
    return f"{about} {undercut}"


# --- the machine -----------------------------------------------------------------------------------


def _machine(cam: Cam, scale: float, phi: Reals, lang: str) -> list[Body]:
    """Cam and follower at one angle, or at keys evenly through a turn."""
    turn = even_keys(1.0 if len(phi) > 1 else 0.0, float(phi[0]))
    report = cam.findings()
    middle = Point(0.0, 0.0)
    rows = [("dead", translate("base circle", lang))]
    disc: list[Shape] = [Polylines((_line(_contour(cam), scale),), "area", closed=True)]
    if cam.follower.radius:
        disc.append(Polylines((_line(_complex(cam.pitch(_turn())), scale),), "centrode-moving", closed=True))
        rows.append(("centrode-moving", translate("pitch curve", lang)))
    if report.undercut:
        disc.append(Polylines(tuple(_line(part, scale) for part in _undercut(cam)), "drive"))
        rows.append(("drive", translate("undercut", lang)))
    if scale * cam.base > _HOLE:
        disc.append(CircleShape(Point(0.6 * scale * cam.base, 0.0), 3.0, "node"))
    arrow = ArcShape(middle, radius=24.0, begin=math.radians(-30), extent=math.radians(-120), style="drive")
    fixed: list[Shape] = [
        CircleShape(middle, scale * cam.base, "dead"),
        arrow,
        arrow_head(arrow),
        CircleShape(middle, 6.2, "joint"),
    ]
    guide = ground(cam, scale)
    shapes = [*disc, *guide, *follower_body(cam, scale, phi[:1]).shapes]
    corner, size = bounds(shapes, 0.0)
    legend_corner = Point(max(corner.x + size.x, _PIXELS) + 24.0, -_PIXELS)
    return [
        Body(tuple(disc), (turn,)),
        Body((*fixed, *guide, *key_list(rows, legend_corner))),
        follower_body(cam, scale, phi),
    ]


def _turn() -> Reals:
    return np.linspace(0, math.tau, _ROWS + 1)


def _complex(pairs: Reals) -> Complexes:
    points: Complexes = pairs[..., 0] + 1j * pairs[..., 1]
    return points


def _contour(cam: Cam) -> Complexes:
    return _complex(cam.profile(_turn()))


def _line(points: Complexes, scale: float) -> tuple[Point, ...]:
    """In pixels, with fewer points."""
    finite = points[np.isfinite(points)]
    return tuple(simplified([Point(scale * z.real, -scale * z.imag) for z in finite.tolist()], FINE))


def _undercut(cam: Cam) -> Iterator[Complexes]:
    """The undercut parts of the profile: opposite in direction to the pitch curve, or hollow."""
    contour, turn = _contour(cam), _turn()
    if cam.follower.has_face:
        wrong = cam.curvature((turn[1:] + turn[:-1]) / 2) <= 0
    else:
        wrong = (np.conj(np.diff(_complex(cam.pitch(turn)))) * np.diff(contour)).real <= 0
    edges = np.flatnonzero(np.diff(np.concatenate([[False], wrong, [False]]).astype(int)))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        yield contour[first : last + 1]


def _pressure(cam: Cam, scale: float, at: float, lang: str) -> Iterator[Shape]:
    """The normal at the contact, the motion of the follower's point, and the angle between."""
    turn = cmath.exp(1j * at)
    touch, centre = (complex(*pair) * turn for pair in (cam.profile(at), cam.pitch(at)))
    alpha = float(cam.pressure_angle(at))
    if not (cmath.isfinite(touch) and math.isfinite(alpha)):
        return
    motion = 1j
    if cam.follower.swings:
        lever = centre - cam.follower.distance
        motion = -1j * math.copysign(1.0, cam.follower.distance) * lever / abs(lever)
    start, foot = (Point(scale * z.real, -scale * z.imag) for z in (centre, touch))
    ends = [Point(z.real, -z.imag) for z in (motion, motion * cmath.exp(1j * alpha))]
    yield Polylines(((start, start.plus(ends[0], _ALPHA + 26.0)),), "dead")
    yield Polylines(((foot.plus(ends[1], -_ALPHA / 2), start.plus(ends[1], _ALPHA + 26.0)),), "measure")
    yield CircleShape(foot, 3.2, "dot")
    if abs(alpha) > 0.01:
        yield ArcShape(start, radius=_ALPHA, begin=-cmath.phase(motion), extent=-alpha, style="drive")
    beside = ends[1].across if alpha <= 0 else Point(-ends[1].across.x, -ends[1].across.y)
    text = translate("α = {angle:.1f}°", lang, angle=math.degrees(alpha) + 0.0).replace("-", "−")
    anchor = "start" if beside.x >= 0 else "end"
    yield TextShape(
        start.plus(ends[1], _ALPHA + 20.0).plus(beside, 8.0 if abs(alpha) > _BESIDE else 24.0), text, "mark", anchor
    )


# --- the diagram -----------------------------------------------------------------------------------


def lift_diagram(cam: Cam, at: float | None = None, lang: str = "en") -> Figure:
    """Lift, velocity and acceleration over a turn, one below the other, with an angle (radians) marked."""
    unit = math.degrees(1.0) if cam.follower.swings else 1.0
    names = ("ψ in °", "ψ′ = dψ/dφ", "ψ″ = d²ψ/dφ²") if cam.follower.swings else ("s", "s′ = ds/dφ", "s″ = d²s/dφ²")
    spans = [(span, np.linspace(span.start, span.end, 73)) for span in cam.lift.spans()]
    rates = [np.concatenate([span.orders[order](phi) for span, phi in spans]) for order in range(3)]
    rows = [*zip(names, (unit * rates[0], *rates[1:]), strict=True)]
    return turn_diagram(
        np.concatenate([phi for _, phi in spans]), rows, at, translate("Lift over the cam's angle", lang), lang
    )
