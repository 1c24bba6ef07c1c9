"""Alt's construction of a linkage with given dead centres, as a sequence of pictures.

docs/theory/synthesis-dead-centres.md has the construction; B₁ and B₂ are its B_o and B_i.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, pi, sin

from gruebler.base.text import Message, message
from gruebler.design.synthesis.dead_centres import FamilyMember, member_places
from gruebler.design.synthesis.tasks import DeadCentreTask
from gruebler.pictures.canvas.construction import (
    Angle,
    Construction,
    ConstructionStep,
    Dot,
    Drawn,
    DrawnCircle,
    DrawnLine,
    Segment,
    quantity,
)

STRAIGHT = 1e-9
"""Radians: dead centres so nearly half a turn apart have a line for the circle."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AltConstruction:
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

    >>> from gruebler.design.synthesis.dead_centres import dead_centre_family
    >>> task = DeadCentreTask(stroke=1, crank_angle=200 * pi / 180)
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
        crank_pivot=placed(0j),
        outer=placed(outer),
        inner=placed(inner),
        rocker_pivot=None if pivot is None else placed(pivot),
        delta=delta,
        centre=None if centre is None else placed(centre),
        crank=a,
        coupler=b,
    )


def alt_steps(task: DeadCentreTask, member: FamilyMember) -> Construction:
    """The construction step by step: given, circle, angle, points, result; rocker or stroke have their own size.

    >>> from gruebler.design.synthesis.dead_centres import dead_centre_family
    >>> task = DeadCentreTask(swing=pi / 3, crank_angle=200 * pi / 180)
    >>> whole = alt_steps(task, dead_centre_family(task).best)
    >>> len(whole.steps), round(whole.values["crank_angle"], 9)
    (5, 200.0)
    """
    points = alt_construction(task, member)
    scale = task.stroke or 1.0
    steps = zip(_captions(task, member, points), _drawn(task, points), strict=True)
    a0, outer, inner = points.crank_pivot, points.outer, points.inner
    near, far = abs(inner - a0), abs(outer - a0)
    values = {
        "a": scale * (far - near) / 2,
        "b": scale * (far + near) / 2,
        "crank_angle": 180 + degrees(abs(cmath.phase((inner - a0) / (outer - a0)))),
    }
    if points.rocker_pivot is not None:
        values |= {"c": abs(outer - points.rocker_pivot), "d": abs(points.rocker_pivot - a0)}
    return Construction(
        message("Alt's construction"), tuple(ConstructionStep(text, drawn) for text, drawn in steps), values
    )


def _drawn(task: DeadCentreTask, points: AltConstruction) -> Iterator[tuple[Drawn, ...]]:
    """What each step adds."""
    a0, far, near = points.crank_pivot, points.outer, points.inner
    sides: list[Drawn]
    if points.rocker_pivot is None:
        beyond = 0.15 * (far - near)
        stroke = quantity("H", task.stroke or 1.0)
        sides = [Segment(near - beyond, far + beyond, "given"), Segment(near, far, "given", stroke)]
    else:
        b0 = points.rocker_pivot
        swing = cmath.phase((near - b0) / (far - b0))
        sides = [
            Segment(far, b0, "edge"),
            Segment(b0, near, "edge"),
            Angle(b0, begin=cmath.phase(far - b0), turn=swing, text=quantity("ψ_H", degrees(abs(swing)), "°")),
            Dot(b0, "B₀"),
        ]
    yield (*sides, Dot(far, "B₁"), Dot(near, "B₂"))
    if points.centre is None:
        yield (DrawnLine(far, far - near, "curve"),)
    else:
        yield (
            Segment(near, far),
            Segment(points.centre, far),
            Segment(points.centre, near),
            Dot(points.centre, "M"),
            DrawnCircle(points.centre, abs(far - points.centre), "help"),
        )
    seen = cmath.phase((far - a0) / (near - a0))
    yield (
        Segment(near, a0),
        Segment(a0, far),
        Angle(
            a0,
            begin=cmath.phase(near - a0),
            turn=seen,
            text=quantity("δ", degrees(abs(seen)), "°") if abs(seen) > STRAIGHT else "",
        ),
        Dot(a0, "A₀"),
    )
    cut = a0 + abs(near - a0) * (far - a0) / abs(far - a0)
    yield DrawnCircle(a0, abs(near - a0)), Dot(cut), Segment(cut, far, "line-2", "2a")
    outward, inward = points.pins
    yield (
        DrawnCircle(a0, points.crank, "curve-rest"),
        Segment(a0, outward, "edge"),
        Segment(outward, far, "edge"),
        Segment(a0, inward, "ghost"),
        Segment(inward, near, "ghost"),
        Dot(outward, "A₁"),
        Dot(inward, "A₂"),
    )


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
