"""Linkages that guide a segment through two or three positions."""

from __future__ import annotations

import cmath
from math import radians

from gruebler.base.text import message
from gruebler.pictures.canvas.construction import Construction, Dot, DrawnCircle, DrawnLine, Segment
from gruebler.teaching.constructions.compass import Board, circle_through, coordinates, lines_meet, segments


def _segment_given(board: Board, places: tuple[tuple[complex, complex], ...], length: float) -> None:
    board.step(
        "Given: the segment AB = {length:g} of a body in {count} positions.",
        *(
            item
            for k, (pin, joint) in enumerate(places, 1)
            for item in (Dot(pin, f"A_{k}"), Dot(joint, f"B_{k}"), Segment(pin, joint, "given"))
        ),
        length=length,
        count=len(places),
    )


def _position(x: float, y: float, angle: float, length: float) -> tuple[complex, complex]:
    begin = complex(x, y)
    return begin, begin + cmath.rect(length, radians(angle))


def two_positions(
    length: float = 40, x2: float = 50, y2: float = 30, angle2: float = 60, base: float = -40
) -> Construction:
    """Two positions: the pivots lie on the perpendicular bisectors, here where these meet the base line."""
    board = Board(message("Two positions of a body"))
    (a1, b1), (a2, b2) = places = _position(0, 0, 0, length), _position(x2, y2, angle2, length)
    _segment_given(board, places, length)
    ways = 1j * (a2 - a1), 1j * (b2 - b1)
    board.step(
        "The perpendicular bisectors of A₁A₂ and B₁B₂.",
        Segment(a1, a2),
        Segment(b1, b2),
        DrawnLine((a1 + a2) / 2, ways[0], "line-6"),
        DrawnLine((b1 + b2) / 2, ways[1], "line-7"),
    )
    pole = lines_meet((a1 + a2) / 2, ways[0], (b1 + b2) / 2, ways[1])
    board.step(
        "They meet in the pole P₁₂ = ({x:.4g}, {y:.4g}): a turn about it carries A₁B₁ to A₂B₂.",
        Dot(pole, "P₁₂"),
        x=pole.real,
        y=pole.imag,
    )
    level = complex(0, base)
    a0 = lines_meet((a1 + a2) / 2, ways[0], level, 1 + 0j)
    b0 = lines_meet((b1 + b2) / 2, ways[1], level, 1 + 0j)
    board.step(
        "Every point of the bisectors can be a pivot. Here A₀ and B₀ lie on the base line y = {base:g}: crank "
        "{a:.4g}, rocker {c:.4g}, frame {d:.4g}.",
        DrawnLine(level, 1 + 0j, "dead"),
        Dot(a0, "A₀"),
        Dot(b0, "B₀"),
        *segments("edge", a0, a1, b1, b0),
        *segments("ghost", a0, a2, b2, b0),
        base=base,
        a=abs(a1 - a0),
        c=abs(b1 - b0),
        d=abs(b0 - a0),
    )
    measured = coordinates(P=pole, A0=a0, B0=b0)
    return board.done(**measured, a=abs(a1 - a0), c=abs(b1 - b0), d=abs(b0 - a0))


def three_positions(
    length: float = 40,
    x2: float = 40,
    y2: float = 25,
    angle2: float = 25,
    x3: float = 90,
    y3: float = 20,
    angle3: float = 60,
) -> Construction:
    """Three positions: the pivots are the centres of the circles through the positions of A and of B."""
    board = Board(message("Three positions of a body"))
    places = (_position(0, 0, 0, length), _position(x2, y2, angle2, length), _position(x3, y3, angle3, length))
    _segment_given(board, places, length)
    pivots = []
    for name, points, style in (("A", [p[0] for p in places], "line-6"), ("B", [p[1] for p in places], "line-7")):
        pivot = circle_through(*points)
        pivots.append(pivot)
        first, second, third = points
        board.step(
            "The perpendicular bisectors of {name}₁{name}₂ and {name}₂{name}₃ meet in {name}₀ = ({x:.4g}, "
            "{y:.4g}), the "
            "centre of the circle through {name}₁, {name}₂, {name}₃.",
            *segments("help", first, second, third),
            DrawnLine((first + second) / 2, 1j * (second - first), style),
            DrawnLine((second + third) / 2, 1j * (third - second), style),
            DrawnCircle(pivot, abs(first - pivot)),
            Dot(pivot, f"{name}₀"),
            name=name,
            x=pivot.real,
            y=pivot.imag,
        )
    a0, b0 = pivots
    (a1, b1), *others = places
    board.step(
        "The four-bar A₀A₁B₁B₀ guides the body through all three: crank {a:.4g}, coupler {b:g}, rocker {c:.4g}, "
        "frame "
        "{d:.4g}. Whether it does so in one assembly and in this order, its motion must show.",
        *segments("edge", a0, a1, b1, b0),
        *(line for pin, joint in others for line in segments("ghost", a0, pin, joint, b0)),
        a=abs(a1 - a0),
        b=length,
        c=abs(b1 - b0),
        d=abs(b0 - a0),
    )
    return board.done(**coordinates(A0=a0, B0=b0), a=abs(a1 - a0), c=abs(b1 - b0), d=abs(b0 - a0))
