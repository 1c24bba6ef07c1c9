"""Alt's construction of a linkage with given dead centres, as a sequence of pictures.

docs/theory/synthesis-dead-centres.md has the construction; B₁ and B₂ are its B_o and B_i.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from math import degrees, pi, sin
from typing import NamedTuple

import numpy as np

from gruebler.drawing.canvas.figure import MARGIN, Figure
from gruebler.drawing.canvas.labels import note_near
from gruebler.drawing.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, bounds, moved_shape
from gruebler.synthesis.dead_centres import FamilyMember, member_places
from gruebler.synthesis.tasks import DeadCentreTask
from gruebler.text import Message, message, number

__all__ = ["STRAIGHT", "AltConstruction", "ConstructionStep", "alt_construction", "construction_steps"]

_WIDE = 300.0  # pixels across the linkage
STRAIGHT = 1e-9
"""Radians: dead centres so nearly half a turn apart have a line for the circle."""
_MOST = 0.9  # the circle is drawn as far as so many sizes of the linkage from its middle


class AltConstruction(NamedTuple):
    """The points of the construction; rocker or stroke have the length 1."""

    crank_pivot: complex
    """A0."""
    outer: complex
    """B₁, the pin of rocker or slider where crank and coupler are stretched."""
    inner: complex
    """B₂, where they overlap."""
    rocker_pivot: complex | None
    """B0; None for a slider."""
    delta: float
    """The angle under which A0 sees B₂ and B₁, with the sign of the rotation from B₁ to B₂, in radians."""
    centre: complex | None
    """The centre of the circle on which A0 lies; None where it is a line."""
    crank: float
    coupler: float

    @property
    def pins(self) -> tuple[complex, complex]:
        """The crank's pin A in the outer and the inner dead centre."""
        outward, inward = self.outer - self.crank_pivot, self.inner - self.crank_pivot
        return (
            self.crank_pivot + self.crank * outward / abs(outward),
            self.crank_pivot - self.crank * inward / abs(inward),
        )


def alt_construction(task: DeadCentreTask, member: FamilyMember) -> AltConstruction:
    """The construction of one member of the family; the rocker swings about the vertical, the slider along the x axis.

    >>> from gruebler.synthesis.dead_centres import dead_centre_family
    >>> task = DeadCentreTask(stroke=1, crank_angle=np.radians(200))
    >>> made = alt_construction(task, dead_centre_family(task).best)
    >>> round(abs(made.crank_pivot - made.centre) - abs(made.outer - made.centre), 9) + 0.0
    0.0
    """
    places = member_places(task, member)
    outer, inner, pivot = places.outer, places.inner, places.rocker_pivot
    middle = (outer + inner) / 2
    if pivot is None:
        origin, turn = middle, abs(outer - inner) / (outer - inner)
    else:
        origin, turn = pivot, 1j * abs(middle - pivot) / (middle - pivot)
    delta = task.angle - pi
    centre = None
    if abs(delta) > STRAIGHT:
        # The chord is seen from the centre under twice the angle: the centre lies at its distance from both ends.
        centre = (inner - cmath.exp(2j * delta) * outer) / (1 - cmath.exp(2j * delta))
    a, b = member.linkage.a, member.linkage.b

    def placed(z: complex) -> complex:
        return (z - origin) * turn

    return AltConstruction(
        placed(0j),
        placed(outer),
        placed(inner),
        None if pivot is None else placed(pivot),
        delta,
        None if centre is None else placed(centre),
        a,
        b,
    )


class ConstructionStep(NamedTuple):
    """One picture of the sequence, and what is done in it."""

    figure: Figure
    caption: Message


def construction_steps(task: DeadCentreTask, member: FamilyMember, *, lang: str = "en") -> tuple[ConstructionStep, ...]:
    """The construction step by step, all pictures of one size: given, circle, angle, points, result.

    Cost: 10 ms.

    >>> from gruebler.synthesis.dead_centres import dead_centre_family
    >>> task = DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(200))
    >>> len(construction_steps(task, dead_centre_family(task).best))
    5
    """
    points = alt_construction(task, member)
    drawn = _Drawn(points, task, lang)
    shapes: list[list[Shape]] = []
    for step in drawn.steps():
        shapes.append([*(shapes[-1] if shapes else []), *step])
    final = [*shapes[-1]]
    corner, size = bounds(final, MARGIN)
    captions = _captions(task, member, points)
    out = []
    for k, (step, caption) in enumerate(zip(shapes, captions, strict=True)):
        moved = tuple(moved_shape(shape, Point(-corner.x, -corner.y)) for shape in [*step, *drawn.names(k, step)])
        title = message("Step {number}", number=k + 1).in_language(lang)
        out.append(ConstructionStep(Figure(moved, size.x, size.y, title, caption.in_language(lang)), caption))
    return tuple(out)


class _Drawn:
    """The shapes of every step, in pixels."""

    def __init__(self, points: AltConstruction, task: DeadCentreTask, lang: str) -> None:
        self.points, self.task, self.lang = points, task, lang
        held = [points.crank_pivot, points.outer, points.inner, *points.pins]
        if points.rocker_pivot is not None:
            held.append(points.rocker_pivot)
        z = np.array(held)
        self.middle = complex(np.ptp(z.real) / 2 + z.real.min(), np.ptp(z.imag) / 2 + z.imag.min())
        self.size = max(float(np.ptp(z.real)), float(np.ptp(z.imag)))

    def at(self, z: complex) -> Point:
        return Point(z.real * _WIDE / self.size, -z.imag * _WIDE / self.size)

    def line(self, style: str, *places: complex) -> Polylines:
        return Polylines((tuple(map(self.at, places)),), style)

    def circle(self, z: complex, radius: float, style: str) -> CircleShape:
        return CircleShape(self.at(z), radius * _WIDE / self.size, style)

    def dot(self, z: complex) -> CircleShape:
        return CircleShape(self.at(z), 4.0, "joint")

    def angle(self, z: complex, first: complex, second: complex, pixels: float) -> ArcShape:
        begin, extent = cmath.phase(first - z), cmath.phase((second - z) / (first - z))
        return ArcShape(self.at(z), pixels, -begin, -extent, "measure")

    def steps(self) -> Iterator[list[Shape]]:
        """What each step adds."""
        p = self.points
        a0, far, near = p.crank_pivot, p.outer, p.inner
        sides: list[Shape]
        if p.rocker_pivot is None:
            beyond = 0.15 * (far - near)
            sides = [self.line("rail", near - beyond, far + beyond)]
        else:
            b0 = p.rocker_pivot
            sides = [self.line("edge", far, b0, near), self.angle(b0, far, near, 34), self.dot(b0)]
        yield [*sides, self.dot(far), self.dot(near)]
        yield [*self.locus(), self.line("measure", near, far)]
        yield [self.line("ghost", near, a0, far), self.angle(a0, far, near, 44), self.dot(a0)]
        cut = a0 + abs(near - a0) * (far - a0) / abs(far - a0)
        arc = ArcShape(
            self.at(a0),
            abs(near - a0) * _WIDE / self.size,
            -cmath.phase(near - a0),
            -cmath.phase((far - a0) / (near - a0)),
            "centrode-moving",
        )
        yield [arc, self.dot(cut), self.line("line-2", cut, far)]
        outward, inward = p.pins
        yield [
            self.circle(a0, p.crank, "curve-rest"),
            self.line("edge", a0, outward, far),
            self.line("ghost", a0, inward, near),
            *(self.dot(z) for z in (a0, outward, inward, far, near)),
        ]

    def locus(self) -> list[Shape]:
        """The arc, or the line, on which A0 lies, as far as it is drawn."""
        p = self.points
        reach = _MOST * self.size
        if p.centre is None:
            along = (p.outer - p.inner) / abs(p.outer - p.inner)
            ends = sorted((np.conj(along) * (z - p.outer)).real for z in (p.crank_pivot, p.inner, p.outer))
            return [self.line("curve", p.outer + (ends[0] - 0.2) * along, p.outer + (ends[-1] + 0.2) * along)]
        radius = abs(p.outer - p.centre)
        # From B₁ by A0 to B₂: the other arc sees the chord under the supplement.
        first, turn = p.outer - p.centre, cmath.phase((p.inner - p.centre) / (p.outer - p.centre))
        by_pivot = cmath.phase((p.crank_pivot - p.centre) / first)
        if not (0 < by_pivot / turn < 1):
            turn -= 2 * pi * (1 if turn > 0 else -1)
        z = p.centre + first * np.exp(1j * turn * np.linspace(0, 1, 361))
        seen = np.abs(z - self.middle) <= reach
        lines = [
            tuple(self.at(complex(w)) for w in z[part])
            for part in np.split(np.arange(len(z)), np.flatnonzero(np.diff(seen)) + 1)
            if seen[part[0]] and len(part) > 1
        ]
        centre = [self.dot(p.centre)] if abs(p.centre - self.middle) <= reach and radius < reach else []
        return [Polylines(tuple(lines), "curve"), *centre]

    def names(self, step: int, shapes: list[Shape]) -> list[Shape]:
        """The names of all points that are there after a step, and its measures."""
        p = self.points
        named = [("B₁", p.outer, 0), ("B₂", p.inner, 0), ("A₀", p.crank_pivot, 2)]
        if p.rocker_pivot is not None:
            named.append(("B₀", p.rocker_pivot, 0))
        named += [("A₁", p.pins[0], 4), ("A₂", p.pins[1], 4)]
        out: list[Shape] = []
        for name, z, first in named:
            if step >= first:
                out.append(note_near(self.at(z), name, "name", [*shapes, *out]))
        if self.task.swing is not None and p.rocker_pivot is not None:
            words = f"ψ_H = {number(degrees(self.task.swing), self.lang, '.4g')}°"
            out.append(note_near(self.at(p.rocker_pivot + 0.3j), words, "value", [*shapes, *out]))
        elif self.task.stroke is not None:
            words = f"H = {number(self.task.stroke, self.lang, '.4g')}"
            out.append(note_near(self.at((p.outer + p.inner) / 2), words, "value", [*shapes, *out]))
        if step >= 2 and p.centre is not None:
            towards = (p.outer + p.inner) / 2 - p.crank_pivot
            at = p.crank_pivot + towards / abs(towards) * 50 / _WIDE * self.size
            words = f"δ = {number(degrees(abs(p.delta)), self.lang, '.4g')}°"
            out.append(note_near(self.at(at), words, "value", [*shapes, *out]))
        if step == 3:
            cut = p.crank_pivot + (abs(p.inner - p.crank_pivot) + p.crank) * _direction(p.crank_pivot, p.outer)
            out.append(note_near(self.at(cut), "2a", "value", [*shapes, *out]))
        return out


def _direction(begin: complex, end: complex) -> complex:
    return (end - begin) / abs(end - begin)


def _captions(task: DeadCentreTask, member: FamilyMember, points: AltConstruction) -> Iterator[Message]:
    scale = task.stroke or 1.0
    chord = 1.0 if task.swing is None else 2 * sin(task.swing / 2)
    if task.swing is None:
        yield message("Given: the slider in its dead centres B₁ and B₂, a stroke apart.")
    else:
        yield message("Given: the rocker in its dead centres B₀B₁ and B₀B₂, its swing between them.")
    if points.centre is None:
        yield message("The dead centres are half a turn of the crank apart: A₀ lies on the line through B₂ and B₁.")
    else:
        yield message(
            "From every point of this arc B₂ and B₁ are seen under the angle δ = |φ₀ - 180°| = {delta:.4g}°: A₀ lies "
            "on it. Its radius is {radius:.4g}.",
            delta=degrees(abs(points.delta)),
            radius=scale * chord / (2 * sin(abs(points.delta))),
        )
    chosen = message(
        "A₀ is chosen on it: here so that the minimum transmission angle is as large as possible, {angle:.2f}°.",
        angle=degrees(member.transmission),
    )
    if points.centre is None:
        chosen = message(
            "A₀ is chosen on it: the longer the coupler, the larger the minimum transmission angle, here {angle:.2f}°.",
            angle=degrees(member.transmission),
        )
    yield chosen
    yield message(
        "The circle about A₀ through B₂ leaves 2a of the line A₀B₁: a = (A₀B₁ - A₀B₂)/2 = {a:.4g}, "
        "b = (A₀B₁ + A₀B₂)/2 = {b:.4g}.",
        a=scale * points.crank,
        b=scale * points.coupler,
    )
    if points.rocker_pivot is None:
        offset = abs(points.crank_pivot.imag - points.outer.imag)
        yield message("The result: crank circle, both dead centres, offset e = {e:.4g}.", e=scale * offset)
    else:
        frame = abs(points.rocker_pivot - points.crank_pivot)
        yield message("The result: crank circle, both dead centres, frame A₀B₀ = {d:.4g}, rocker 1.", d=frame)
