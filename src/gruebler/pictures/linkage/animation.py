"""An animated linkage as SVG with SMIL, without script. Viewers without animation show its first pose.

Every link is a group that is shifted and turned with linear interpolation between poses: docs/theory/drawing.md has
the error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import plural, translate
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.points import PointLike, each_point
from gruebler.pictures.canvas.figure import MARGIN, Figure, svg_document
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape, bounds
from gruebler.pictures.canvas.svg import svg_element, svg_number, svg_path
from gruebler.pictures.linkage.bodies import (
    PINS,
    BodyPart,
    CarriedLine,
    body_parts,
    outline_parts,
    room_for,
    shapes_at_pose,
)
from gruebler.pictures.linkage.layers import coupler_curve_lines, drive_parts
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, posed_linkage
from gruebler.pictures.structure.messages import describe, title

if TYPE_CHECKING:
    from gruebler.mechanics.forces import Loads

_LONGEST = 3600.0  # seconds


class AnimationOptions(TypedDict, total=False):
    """Arguments of `scene` besides the linkage."""

    branch: Branch
    between: tuple[float, float] | None
    loads: Loads | None
    speed: float | None
    drives: ArrayLike | None
    curves: Sequence[PointLike]
    seconds: float
    lang: str
    name: str
    outlines: Sequence[CarriedLine]


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A linkage through a full turn of its drive, or to and fro, in pixels."""

    posed: PosedLinkage
    pieces: tuple[BodyPart, ...]
    still: tuple[Shape, ...]
    """Curves."""
    changing: tuple[tuple[Polylines, ...], ...]
    """By row of the path: lines that change their length, as many with as many points in each; or no rows."""
    corner: Point
    """The upper left corner of all that is ever seen."""
    page: Figure
    """Without shapes: size, title and description."""
    seconds: float
    """The time of one period."""

    @property
    def rows(self) -> list[int]:
        """The poses in order, evenly in time; the last equals the first."""
        rows = [*range(len(self.posed.path))]
        return rows if self.posed.repeats else rows + rows[-2::-1]


@door_that_raises(LinkageError)
def scene(
    linkage: LinkageLike,
    *,
    loads: Loads | None = None,
    branch: Branch = None,
    between: tuple[float, float] | None = None,
    speed: float | None = None,
    drives: ArrayLike | None = None,
    curves: Sequence[PointLike] = (),
    seconds: float = 4.0,
    lang: str = "en",
    name: str = "",
    outlines: Sequence[CarriedLine] = (),
) -> Scene:
    """The content of an animation, for all formats.

    Options as for `gruebler.animate`; ``outlines`` are lines that links carry, in coordinates of the links.

    Raises `LinkageError` for several drives, unknown points, or a time that is no positive number.
    """
    linkage = as_linkage(linkage, unit="")
    if not 0 < seconds <= _LONGEST:
        raise LinkageError(
            "the time is a number of seconds up to {longest:g}, not {seconds!r}", longest=_LONGEST, seconds=seconds
        )
    posed = room_for(posed_linkage(linkage, branch=branch, between=between, drives=drives), outlines)
    turns = posed.driven().span.turns
    pieces = (*body_parts(posed), *outline_parts(posed, outlines), *drive_parts(posed))
    changing: tuple[tuple[Polylines, ...], ...] = ()
    if loads is not None:
        from gruebler.pictures.linkage.load_pictures import load_lines, mass_parts  # dynamics, which few pictures need

        pieces = (*pieces, *mass_parts(posed, loads))
        changing = load_lines(posed, posed.path, loads, speed)
    rows = range(0, len(posed.path), 2)
    poses = [shape for row in rows for part in pieces for shape in shapes_at_pose(posed, part, posed.path, row)]
    curve = [shape for point in each_point(curves).values() for shape in coupler_curve_lines(posed, point)]
    still = tuple(curve)
    corner, size = bounds([*poses, *still, *(line for row in changing for line in row)], MARGIN)
    moves = (
        plural(
            "It moves through {count} turn of its drive.", "It moves through {count} turns of its drive.", turns, lang
        )
        if posed.repeats
        else translate("It moves to and fro through its range.", lang)
    )
    described = f"{describe(linkage.mechanism, lang)} {moves}"
    page = Figure((), width=size.x, height=size.y, title=title(linkage.mechanism, lang, name), description=described)
    return Scene(
        posed=posed,
        pieces=pieces,
        still=still,
        changing=changing,
        corner=corner,
        page=page,
        seconds=seconds * (turns if posed.repeats else 1),
    )


def animated_svg(linkage: Linkage, **options: Unpack[AnimationOptions]) -> str:
    """A linkage through a full turn of its drive, or to and fro where the drive has limits, repeated without end.

    Options and errors are those of `scene`.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> text = animated_svg(FourBar(25, 70, 40, 70).linkage())
    >>> text.count("<animateTransform"), "<script" in text
    (10, False)
    """
    return svg_of(scene(linkage, **options))


def svg_of(shown: Scene, *, styled: bool = True) -> str:
    """The scene as animated SVG, with the rules of its styles or without."""
    motion = _Motion(shown)
    lines = [
        f'<g transform="translate({svg_number(-shown.corner.x)} {svg_number(-shown.corner.y)})">',
        *motion.groups([part for part in shown.pieces if part.layer < PINS]),
        *map(svg_element, shown.still),
        *motion.groups([part for part in shown.pieces if part.layer >= PINS]),
        *motion.changing(shown.changing),
        "</g>",
    ]
    used = [shape.style for shape in (*shown.still, *(line for row in shown.changing[:1] for line in row))] + [
        shape.style for part in shown.pieces for shape in part.shapes
    ]
    return svg_document(shown.page, used if styled else None, lines)


class _Motion:
    """Writes parts as animated groups."""

    def __init__(self, shown: Scene) -> None:
        self.posed = shown.posed
        self.rows = shown.rows
        self.timing = f'dur="{shown.seconds:g}s" repeatCount="indefinite"'

    def groups(self, pieces: Sequence[BodyPart]) -> Iterator[str]:
        """A group for successive parts of the same link; parts of the frame are not animated."""
        for link, parts in groupby(pieces, key=lambda part: part.link):
            shapes = "".join(svg_element(shape) for part in parts for shape in part.shapes)
            if link == self.posed.lower.mechanism.frame:
                yield shapes
                continue
            shifts, turns = self._shifts(link), self._turns(link)
            yield (
                f'<g transform="translate({shifts[0]}) rotate({turns[0]})">'
                f"{self._animated('translate', shifts)}{self._animated('rotate', turns)}"
                f"{shapes}</g>"
            )

    def changing(self, rows: Sequence[Sequence[Polylines]]) -> Iterator[str]:
        """Lines that change their length: the same points at other places."""
        for lines in zip(*rows, strict=True):
            paths = [svg_path(line) for line in lines]
            shown = ";".join(paths[row] for row in self.rows)
            animated = f'<animate attributeName="d" {self.timing} values="{shown}"/>'
            yield f'<path class="gr-{lines[0].style}" d="{paths[0]}">{animated}</path>'

    def _shifts(self, link: str) -> list[str]:
        k = self.posed.lower.mechanism.chain.index(link)
        places = [self.posed.local(complex(z)) for z in self.posed.path.places[0, :, k]]
        return [f"{svg_number(places[row].x)} {svg_number(places[row].y)}" for row in self.rows]

    def _turns(self, link: str) -> list[str]:
        angles = np.degrees(self.posed.path.angle(link))
        return [f"{round(-angles[row], 2) + 0.0:g}" for row in self.rows]

    def _animated(self, kind: str, values: list[str]) -> str:
        shown = ";".join(values[:1] * 2 if len(set(values)) == 1 else values)
        attributes = f'attributeName="transform" type="{kind}" additive="{_ADDITIVE[kind]}"'
        return f'<animateTransform {attributes} {self.timing} values="{shown}"/>'


_ADDITIVE = {"translate": "replace", "rotate": "sum"}
