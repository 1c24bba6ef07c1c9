"""A construction with compass and ruler as a value: steps, each with a text and with what it adds to the drawing.

Places are complex numbers x + iy in the unit of the drawing, y upward. What a step adds is drawn in the accent colour
while the step is shown; names keep their places from step to step.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import GrueblerError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, message, translate
from gruebler.pictures.canvas.figure import MARGIN, Figure
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import (
    ArcShape,
    CircleShape,
    Point,
    Polylines,
    Shape,
    TextShape,
    moved_shape,
    text_width,
    wrapped_text,
)
from gruebler.pictures.canvas.styles import STYLES
from gruebler.pictures.canvas.symbols import arrow

_WIDE, _HIGH = 560.0, 400.0  # pixels of the drawing
_TEXT = 13.0  # pixels, of the caption
_LEAD = 18.0
_FAR = 2.8  # sizes of what is given: the drawing reaches at most so far beyond it
_NEAR = 22.0  # pixels: a text that would be farther from its place may lie on faint lines
_NEAR_AN_ANGLE = 44.0  # pixels: its text names it, and would cross its legs
_FAINT = ("help", "curve-rest", "dead", "measure", "ghost")
_LARGE = 12.0  # pixels: within larger circles there is space for texts
_LEAST = 2.0  # pixels: shorter arrows are dots
_NEW = {"help": "new", "given": "given", "dead": "new"}  # what is drawn otherwise while its step is shown


@dataclass(frozen=True, slots=True)
class Segment:
    """A line between two places, with a text beside its middle."""

    begin: complex
    end: complex
    style: str = "help"
    text: str | Message = ""


@dataclass(frozen=True, slots=True)
class DrawnLine:
    """The line through a place in a direction, as far as the drawing reaches."""

    at: complex
    along: complex
    style: str = "help"


@dataclass(frozen=True, slots=True)
class DrawnCircle:
    """A circle, as far as the drawing reaches."""

    centre: complex
    radius: float
    style: str = "help"


@dataclass(frozen=True, slots=True)
class Dot:
    """A place with its name."""

    at: complex
    name: str = ""


@dataclass(frozen=True, slots=True)
class Angle:
    """An angle at a place, from one direction by a turn, in radians; positive counter-clockwise."""

    apex: complex
    _: KW_ONLY
    begin: float
    turn: float
    text: str | Message = ""
    radius: float = 40.0
    """In pixels."""


@dataclass(frozen=True, slots=True)
class Arrow:
    """A vector with its name."""

    begin: complex
    end: complex
    name: str | Message = ""
    style: str = "velocity"
    """``velocity`` or ``acceleration``."""


@dataclass(frozen=True, slots=True)
class DrawnCurve:
    """A line through places."""

    places: tuple[complex, ...]
    style: str = "curve"


Drawn = Segment | DrawnLine | DrawnCircle | Dot | Angle | Arrow | DrawnCurve


@dataclass(frozen=True, slots=True)
class ConstructionStep:
    """What is done, and what it adds to the drawing."""

    text: Message
    drawn: tuple[Drawn, ...]


@brief
@dataclass(frozen=True, repr=False)
class Construction:
    """A construction: its steps, and the values measured in the last one.

    >>> whole = Construction(message("A middle"), (
    ...     ConstructionStep(message("Two points are given."), (Dot(0j, "A"), Dot(4 + 0j, "B"))),
    ...     ConstructionStep(message("The circles about them meet above and below the middle."),
    ...                      (DrawnCircle(0j, 3), DrawnCircle(4 + 0j, 3)))), {"middle": 2.0})
    >>> len(whole.figures()), whole.values["middle"]
    (2, 2.0)
    """

    title: Message
    steps: tuple[ConstructionStep, ...]
    values: Mapping[str, float]

    def figures(self, lang: str = "en", *, captions: bool = True) -> tuple[Figure, ...]:
        """One picture for each step, all of one size; with title and text unless ``captions`` is False.

        Cost: some 10 ms for each step.
        """
        view = _View(self.steps)
        names = list(_names(self.steps, view, lang))
        texts = [wrapped_text(step.text.in_language(lang), _WIDE, _TEXT) for step in self.steps]
        lines = max(map(len, texts)) if captions else 0
        title = self.title.in_language(lang)
        pictures = []
        for last, step in enumerate(self.steps):
            items = [(item, k == last) for k, each in enumerate(self.steps[: last + 1]) for item in each.drawn]
            items.sort(key=lambda pair: isinstance(pair[0], Dot))  # points above lines
            shapes = [shape for item, new in items for shape in view.shapes(item, new=new)]
            shapes += [text for k, text in names if k <= last]
            top = 2 * MARGIN if captions else 0.0
            moved = [moved_shape(shape, Point(MARGIN, MARGIN + top)) for shape in shapes]
            bottom = 2 * MARGIN + top + view.high
            about = translate("step {number} of {count}", lang, number=last + 1, count=len(self.steps))
            if captions:
                moved.append(TextShape(Point(MARGIN, 1.2 * MARGIN), f"{title}, {about}", "name", "start"))
                for row, line in enumerate(texts[last]):
                    at = Point(MARGIN, bottom + row * _LEAD)
                    moved.append(TextShape(at, line, "name", "start"))
            pictures.append(
                Figure(
                    tuple(moved),
                    width=view.wide + 2 * MARGIN,
                    height=bottom + lines * _LEAD,
                    title=f"{title}, {about}",
                    description=step.text.in_language(lang),
                )
            )
        return tuple(pictures)

    def figure(self, step: int = -1, lang: str = "en") -> Figure:
        """The picture of one step, counted from 1; -1 is the last one. `GrueblerError` if there is no such step."""
        if step != -1 and not 1 <= step <= len(self.steps):
            raise GrueblerError("expected a step from 1 to {count}, but found {step}", count=len(self.steps), step=step)
        return self.figures(lang)[step if step == -1 else step - 1]

    def _repr_svg_(self) -> str:
        return self.figure().svg()


def quantity(name: str, value: float, unit: str = "") -> Message:
    """A quantity with four digits, for a text in the drawing.

    >>> quantity("a", 12.3456).in_language("de"), str(quantity("φ", 55, "°"))
    ('a = 12,35', 'φ = 55°')
    """
    return message("{name} = {value:.4g}{unit}", name=name, value=value, unit=unit)


# --- from places to pixels ---------------------------------------------------------------------------


class _View:
    """The part of the plane that is drawn: what the first step gives, and what else lies near it."""

    def __init__(self, steps: Sequence[ConstructionStep]) -> None:
        given = np.array([z for item in steps[0].drawn for z in _places(item)])
        if not len(given):
            given = np.array([z for step in steps for item in step.drawn for z in _places(item)])
        low, high = _corner(given, min), _corner(given, max)
        size = max(high.real - low.real, high.imag - low.imag)
        reach = _FAR * size * (1 + 1j)
        every = np.array([z for step in steps for item in step.drawn for z in _places(item)])
        seen = every[
            (every.real >= (low - reach).real)
            & (every.real <= (high + reach).real)
            & (every.imag >= (low - reach).imag)
            & (every.imag <= (high + reach).imag)
        ]
        self.low, self.top = _corner(seen, min), _corner(seen, max)
        least = 0.25 * max((self.top - self.low).real, (self.top - self.low).imag)
        for part in (1, 1j):
            extent = (self.top - self.low).real if part == 1 else (self.top - self.low).imag
            if extent < least:
                self.low, self.top = self.low - (least - extent) / 2 * part, self.top + (least - extent) / 2 * part
        more = 0.06 * max((self.top - self.low).real, (self.top - self.low).imag) * (1 + 1j)
        self.low, self.top = self.low - more, self.top + more
        across = self.top - self.low
        self.scale = min(_WIDE / across.real, _HIGH / across.imag)
        self.wide, self.high = _WIDE, self.scale * across.imag
        self.left = (_WIDE - self.scale * across.real) / 2

    def at(self, z: complex) -> Point:
        """A place in pixels."""
        return Point(self.left + self.scale * (z.real - self.low.real), self.scale * (self.top.imag - z.imag))

    def holds(self, z: complex) -> bool:
        """Whether a place is in the picture."""
        near = 1e-9 * abs(self.top - self.low)
        return (
            self.low.real - near <= z.real <= self.top.real + near
            and self.low.imag - near <= z.imag <= self.top.imag + near
        )

    def shapes(self, item: Drawn, *, new: bool) -> Iterator[Shape]:
        """What an item looks like in its own step, and in later ones."""

        def look(style: str) -> str:
            return _NEW.get(style, style) if new else style

        match item:
            case Segment(begin, end, style, _):
                yield from self._straight(begin, end - begin, 0.0, look(style))
            case DrawnLine(at, along, style):
                far = 4 * abs(self.top - self.low) + abs(at - self.low)
                yield from self._straight(at, along / abs(along) * far, -1.0, look(style))
            case DrawnCircle(_, _, style):
                yield from self._circle(item, look(style))
            case DrawnCurve(places, style):
                yield from self._curve(np.array(places), look(style))
            case Dot(at) if self.holds(at):
                yield CircleShape(self.at(at), 3.6, "joint")
            case Angle(apex, begin=begin, turn=turn, radius=radius) if self.holds(apex) and abs(turn) * radius > _LEAST:
                yield ArcShape(self.at(apex), radius=radius, begin=-begin, extent=-turn, style=look("measure"))
            case Arrow(begin, end, _, style):
                if (ends := self._clipped(begin, end - begin, 0.0, 1.0)) is not None:
                    yield from self._arrow(self.at(ends[0]), self.at(ends[1]), style)

    def _arrow(self, tail: Point, tip: Point, style: str) -> Iterator[Shape]:
        shaft = tip.minus(tail)
        if shaft.length > _LEAST:
            yield from arrow(tail, tip.plus(shaft.unit, -min(7.0, shaft.length / 2)), style, f"{style}-head")

    def _circle(self, circle: DrawnCircle, style: str) -> Iterator[Shape]:
        z = circle.centre + circle.radius * np.exp(2j * math.pi * np.arange(721) / 720)
        if all(self.holds(complex(w)) for w in z[::30]):
            yield CircleShape(self.at(circle.centre), circle.radius * self.scale, style)
        else:
            yield from self._curve(z, style)

    def _straight(self, at: complex, along: complex, first: float, style: str) -> Iterator[Shape]:
        if (ends := self._clipped(at, along, first, 1.0)) is not None:
            yield Polylines((tuple(map(self.at, ends)),), style)

    def _curve(self, z: Complexes, style: str) -> Iterator[Shape]:
        seen = np.array([self.holds(complex(w)) for w in z])
        parts = np.split(np.arange(len(z)), np.flatnonzero(np.diff(seen)) + 1)
        lines = [tuple(self.at(complex(w)) for w in z[part]) for part in parts if seen[part[0]] and len(part) > 1]
        if lines:
            yield Polylines(tuple(lines), style)

    def _clipped(self, at: complex, along: complex, first: float, last: float) -> tuple[complex, complex] | None:
        """The part of a line in the picture; None if there is none."""
        for low, high, start, step in (
            (self.low.real, self.top.real, at.real, along.real),
            (self.low.imag, self.top.imag, at.imag, along.imag),
        ):
            if step == 0:
                if not low <= start <= high:
                    return None
                continue
            ends = sorted(((low - start) / step, (high - start) / step))
            first, last = max(first, ends[0]), min(last, ends[1])
        return (at + first * along, at + last * along) if first < last else None


def _corner(z: Complexes, pick: Callable[[Iterable[float]], float]) -> complex:
    return complex(pick(z.real), pick(z.imag))


def _places(item: Drawn) -> Iterator[complex]:
    """The places that an item needs in the picture."""
    match item:
        case Segment(begin, end) | Arrow(begin, end):
            yield from (begin, end)
        case Dot(at) | Angle(at):
            yield at
        case DrawnCurve(places):
            yield from places
        case DrawnCircle(centre, radius, style) if style != "help":
            yield from (centre + radius, centre - radius, centre + 1j * radius, centre - 1j * radius)


def _names(steps: Sequence[ConstructionStep], view: _View, lang: str) -> Iterator[tuple[int, TextShape]]:
    """Every text with the step that writes it, at a place that all shapes leave free."""
    every: list[Shape] = [
        _rim(shape) for step in steps for item in step.drawn for shape in view.shapes(item, new=False)
    ]
    written: set[tuple[str, int, int]] = set()
    for k, step in enumerate(steps):
        for item in step.drawn:
            match item:
                case Dot(at, text):
                    style = "name"
                case Segment(begin, end, _, text):
                    at, style = (begin + end) / 2, "value"
                case Arrow(begin, end, text):
                    at, style = begin + 0.6 * (end - begin), "value"
                case Angle(apex, begin=begin, turn=turn, text=text, radius=radius):
                    at, style = apex + radius / view.scale * cmath.exp(1j * (begin + turn / 2)), "value"
                case _:
                    continue
            text = text if isinstance(text, str) else text.in_language(lang)
            spot = view.at(at)
            mark = (text, round(spot.x), round(spot.y))
            if not text or not view.holds(at) or mark in written:
                continue
            written.add(mark)
            note = note_near(spot, text, style, every)
            near = _NEAR_AN_ANGLE if isinstance(item, Angle) else _NEAR
            if note.at.minus(spot).length > near + text_width(text, STYLES[style].size) / 2:
                note = note_near(spot, text, style, [shape for shape in every if shape.style not in _FAINT])
            every.append(note)
            yield k, note


def _rim(shape: Shape) -> Shape:
    """A large circle, or an arc, as a line, whose inside is free for texts."""
    if isinstance(shape, ArcShape):
        return Polylines((tuple(shape.place(k / 24) for k in range(25)),), shape.style)
    if not isinstance(shape, CircleShape) or shape.radius < _LARGE:
        return shape
    turns = (2 * math.pi * k / 72 for k in range(72))
    places = (shape.at.plus(Point(math.cos(x), math.sin(x)), shape.radius) for x in turns)
    return Polylines((tuple(places),), shape.style, closed=True)
