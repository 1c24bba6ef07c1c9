"""A linkage that moves by itself: SVG with SMIL, no script. Viewers without animation show its first pose.

Every link is a group that is shifted and turned on straight lines between poses: docs/theory/drawing.md has the error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

import numpy as np

from gruebler.drawing.figure import Figure, Shape, bounds
from gruebler.drawing.linkage_bodies import PINS, Part, at_pose, parts
from gruebler.drawing.linkage_layers import coupler_curve, drive_arrows
from gruebler.drawing.prose import describe, title
from gruebler.drawing.stage import Stage, staged
from gruebler.drawing.svg import document, element, number
from gruebler.errors import LinkageError
from gruebler.linkages import Linkage

__all__ = ["animated_svg"]

_WORDS = {
    "en": {True: "It moves through {turns} turn(s) of its drive.", False: "It moves to and fro through its range."},
    "de": {
        True: "Es bewegt sich über {turns} Umdrehung(en) seines Antriebs.",
        False: "Es bewegt sich hin und her durch seinen Bereich.",
    },
}
_LONGEST = 3600.0  # seconds
_MARGIN = 16.0


def animated_svg(
    linkage: Linkage,
    *,
    branch: str | Iterable[str] | None = None,
    between: tuple[float, float] | None = None,
    curves: Sequence[str] = (),
    seconds: float = 4.0,
    lang: str = "en",
    name: str = "",
) -> str:
    """A linkage through a full turn of its drive, or to and fro where the drive has limits, over and over.

    Args:
        linkage: with one drive.
        branch: the assembly mode, as for `gruebler.kinematics.move`.
        between: drive values between which it is to move, if not the whole range.
        curves: points or joints whose paths are drawn.
        seconds: for a turn, or for there and back.
        lang: language of title and description, ``en`` or ``de``.
        name: the title, if it is not to be found out.

    Raises `LinkageError` for several drives, unknown points, or a time that is no positive number.

    >>> from gruebler.linkages import FourBar
    >>> text = animated_svg(FourBar(25, 70, 40, 70).linkage())
    >>> text.count("<animateTransform"), "<script" in text
    (10, False)
    """
    if not 0 < seconds <= _LONGEST:
        raise LinkageError(f"the time is a number of seconds up to {_LONGEST:g}, not {seconds!r}")
    stage = staged(linkage, branch=branch, between=between)
    course = stage.driven()
    curve = [shape for one in dict.fromkeys(curves) for shape in coupler_curve(stage, one)]
    pieces = parts(stage)
    rows = range(0, len(stage.path), 2)
    poses = [shape for row in rows for part in pieces for shape in at_pose(stage, part, stage.path, row)]
    still = [*curve, *(_arrows(stage))]
    corner, size = bounds([*poses, *still], _MARGIN)
    words = _WORDS[lang][stage.goes_round].format(turns=course.span.turns)
    described = f"{describe(linkage.mechanism, lang)} {words}"
    page = Figure((), size.x, size.y, title(linkage.mechanism, lang, name), described)
    motion = _Motion(stage, seconds * (course.span.turns if stage.goes_round else 1))
    lines = [
        f'<g transform="translate({number(-corner.x)} {number(-corner.y)})">',
        *motion.groups([part for part in pieces if part.layer < PINS]),
        *map(element, still),
        *motion.groups([part for part in pieces if part.layer == PINS]),
        "</g>",
    ]
    used = [shape.style for shape in still] + [shape.style for part in pieces for shape in part.shapes]
    return document(page, used, lines)


def _arrows(stage: Stage) -> list[Shape]:
    """The arrows of a drive at the frame; others would have to move."""
    frame = stage.lower.mechanism.frame
    turning = stage.driven().turning_drive
    return drive_arrows(stage) if turning and frame in stage.lower.mechanism.drives[0].between else []


class _Motion:
    """Writes parts as groups that move for ever."""

    def __init__(self, stage: Stage, seconds: float) -> None:
        self.stage = stage
        self.rows = [*range(len(stage.path)), *([] if stage.goes_round else range(len(stage.path) - 2, -1, -1))]
        self.timing = f'dur="{seconds:g}s" repeatCount="indefinite"'

    def groups(self, pieces: Sequence[Part]) -> Iterator[str]:
        """A group for parts of the same link that follow each other; what belongs to the frame stands still."""
        for link, mine in groupby(pieces, key=lambda part: part.link):
            shapes = "".join(element(shape) for part in mine for shape in part.shapes)
            if link == self.stage.lower.mechanism.frame:
                yield shapes
                continue
            shifts, turns = self._shifts(link), self._turns(link)
            yield (
                f'<g transform="translate({shifts[0]}) rotate({turns[0]})">'
                f"{self._animated('translate', shifts)}{self._animated('rotate', turns)}"
                f"{shapes}</g>"
            )

    def _shifts(self, link: str) -> list[str]:
        k = self.stage.lower.mechanism.chain.index(link)
        places = [self.stage.local(complex(z)) for z in self.stage.path.places[0, :, k]]
        return [f"{number(places[row].x)} {number(places[row].y)}" for row in self.rows]

    def _turns(self, link: str) -> list[str]:
        angles = np.degrees(self.stage.path.angle(link))
        return [f"{round(-angles[row], 2) + 0.0:g}" for row in self.rows]

    def _animated(self, kind: str, values: list[str]) -> str:
        shown = ";".join(values[:1] * 2 if len(set(values)) == 1 else values)
        how = f'attributeName="transform" type="{kind}" additive="{_ADDITIVE[kind]}"'
        return f'<animateTransform {how} {self.timing} values="{shown}"/>'


_ADDITIVE = {"translate": "replace", "rotate": "sum"}
