"""Centrodes and the inflection circle of a link against the frame."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.text import translate
from gruebler.mechanics.kinematics import Motion
from gruebler.pictures.canvas.axes import as_text
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, drive_rows, floating_link

_WIDE = 0.3  # of the figure's longer side: the margin in which centrodes and inflection circles are visible
_WHOLE = 1.6  # of it: an inflection circle within this margin is drawn whole
_ARC = 0.4  # of it: half the arc that is visible of another one
_SAMPLES = 1440  # points of a centrode or circle
_TURNING = 1e-6  # for a drive of speed 1: the pole of a link that turns more slowly is far away
_PARTS = (0.1, 0.3, 0.5, 0.7, 0.9)  # of a centrode: where its letter may stand, far from the joints
_POINT = 1e-6  # sizes: a smaller inflection circle is a point


def cross(at: Point) -> Polylines:
    """A small cross."""
    return Polylines(
        tuple((at.plus(d, -5.0), at.plus(d, 5.0)) for d in (Point(1.0, 1.0).unit, Point(1.0, -1.0).unit)), "edge"
    )


class _Box(NamedTuple):
    """The reach of the linkage with a margin."""

    upper: Point
    lower: Point

    @classmethod
    def around(cls, posed: PosedLinkage, factor: float) -> _Box:
        upper, lower = posed.reach
        more = factor * max(lower.x - upper.x, lower.y - upper.y)
        return cls(upper.plus(Point(-more, -more)), lower.plus(Point(more, more)))

    def holds(self, at: Point) -> bool:
        return self.upper.x <= at.x <= self.lower.x and self.upper.y <= at.y <= self.lower.y


def _number(context: LayerContext) -> int:
    """The number of the requested link, by default of a link that is no neighbour of the frame."""
    links, output = context.posed.lower.mechanism.chain.links, context.output
    if output is not None and output not in links:
        known = context.posed.linkage.mechanism.chain.links
        link_names = ", ".join(known)
        raise LinkageError(
            "centrodes and the inflection circle belong to a link{suggestion}; {word!r} is none of {links}",
            links=link_names,
            **unknown(output, known),
        )
    return links.index(floating_link(context.posed.linkage) if output is None else output)


def inflection_lines(context: LayerContext) -> list[Shape]:
    """The inflection circle within the box, with the pole P and the inflection pole W opposite to it.

    Pole and circle: docs/theory/geometry.md.
    """
    posed = context.posed
    posed.driven()
    pose, k = posed.pose, _number(context)
    w, change = (float(pose.rates[order, 0, k]) for order in (0, 1))
    if abs(w) < _TURNING:
        return []
    at, velocity, acceleration = (complex(z) for z in pose.places[:3, 0, k])
    pole = at + 1j * velocity / w
    shift = velocity / w + 1j * (acceleration - velocity * change / w) / w**2
    if abs(shift) < _POINT * posed.lower.size:
        return []
    centre, radius = pole - 0.5j * shift, abs(shift) / 2
    circle = centre + 0.5j * shift * np.exp(2j * np.pi * np.linspace(0, 1, _SAMPLES + 1))
    box, called = _Box.around(posed, _WHOLE), translate("inflection circle", context.lang)
    if not all(box.holds(posed.local(complex(z))) for z in circle[::30]):
        box = _Box.around(posed, _WIDE)
        circle = _near_arc(posed, centre, radius)
        called += f", r = {as_text(float(f'{radius:.3g}'), posed.linkage.unit, context.lang)}"
    lines = _within(posed, circle, box)
    shapes: list[Shape] = []
    if lines:
        shapes.append(Polylines(tuple(lines), "inflection"))
    # The pole tangent t, to both sides of P, and the pole normal n, from P over W.
    for direction, first, last, name in ((shift, -0.5, 0.5, "t"), (-1j * shift, -0.1, 1.15, "n")):
        if not box.holds(posed.local(pole)):
            break  # of two lines through a pole outside nothing is to be read
        along: Complexes = np.asarray(pole + direction * np.linspace(first, last, _SAMPLES), dtype=np.complex128)
        (line, *_) = _within(posed, along, box) or [()]
        if lines and line:
            shapes += [Polylines((line,), "dead"), note_near(line[-1], name, "value", [*context.drawn, *shapes])]
    for z, name in ((pole, "P"), (pole - 1j * shift, "W")):
        point = posed.local(z)
        if lines and box.holds(point):
            shapes.append(cross(point) if name == "P" else CircleShape(point, 3.2, "dot"))
            shapes.append(note_near(point, name, "value", [*context.drawn, *shapes]))
    if lines:
        longest = max(lines, key=len)
        shapes.append(note_near(longest[len(longest) // 4], called, "value", [*context.drawn, *shapes]))
    return shapes


def _near_arc(posed: PosedLinkage, centre: complex, radius: float) -> Complexes:
    """The arc of a circle next to the linkage, about as long as the linkage is."""
    upper, lower = posed.reach
    middle = complex(*upper.plus(lower.minus(upper), 0.5)).conjugate() / posed.scale
    half = _ARC * max(lower.x - upper.x, lower.y - upper.y) / posed.scale / radius
    turns = np.angle(middle - centre) + min(half, np.pi) * np.linspace(-1, 1, _SAMPLES + 1)
    return np.asarray(centre + radius * np.exp(1j * turns), dtype=np.complex128)


def centrode_lines(context: LayerContext) -> list[Shape]:
    """The fixed centrode p and the moving one q in this pose, which roll on each other, within the box."""
    posed, k = context.posed, _number(context)
    cycle = posed.driven()
    drives = posed.path.drives[:, 0]
    between = None if posed.repeats else (float(drives[0]), float(drives[-1]))
    motion = cycle.at(drive_rows(cycle, between, _SAMPLES), 1)
    fixed = _poles_of(motion, k)
    relative = (fixed - motion.places[0, :, k]) * motion.turns[:, k].conj()
    moving = posed.pose.places[0, 0, k] + posed.pose.turns[0, k] * relative
    box = _Box.around(posed, _WIDE)
    shapes: list[Shape] = []
    for z, style, name in ((fixed, "centrode-fixed", "p"), (moving, "centrode-moving", "q")):
        lines = _within(posed, z, box)
        if max((b.minus(line[0]).length for line in lines for b in line), default=0.0) < 1.0:
            return []
        shapes.append(Polylines(tuple(lines), style))
        pins = [shape.at for shape in context.drawn if isinstance(shape, CircleShape)]
        ends = [line[round(part * (len(line) - 1))] for line in lines for part in _PARTS]
        free = max(ends, key=lambda at: min((at.minus(pin).length for pin in pins), default=0.0))
        shapes.append(note_near(free, name, "value", [*context.drawn, *shapes]))
    return shapes


def _poles_of(motion: Motion, k: int) -> Complexes:
    """The poles of a link in all rows; NaN where it does not turn."""
    rate = np.where(np.abs(motion.rates[0, :, k]) < _TURNING, np.nan, motion.rates[0, :, k])
    with np.errstate(invalid="ignore"):
        return np.asarray(motion.places[0, :, k] + 1j * motion.places[1, :, k] / rate)


def _within(posed: PosedLinkage, z: Complexes, box: _Box) -> list[tuple[Point, ...]]:
    """The parts of a line that lie in a box."""
    parts: list[list[Point]] = [[]]
    for place in z:
        at = posed.local(complex(place))
        if np.isfinite(place) and box.holds(at):
            parts[-1].append(at)
        elif parts[-1]:
            parts.append([])
    return [tuple(simplified(part, FINE)) for part in parts if len(part) > 1]
