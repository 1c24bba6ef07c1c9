"""Pictures of linkages to scale, in any pose that their drives can reach: docs/theory/drawing.md."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from math import degrees

from gruebler.drawing.figure import Figure, Lines, Point, Shape, figure_of
from gruebler.drawing.labels import labelled
from gruebler.drawing.linkage_bodies import BLOCKS, BODIES, FRAME, PINS, Part, at_pose, corners_of, parts, slides
from gruebler.drawing.linkage_layers import BELOW, coupler_curve, drive_arrows, ghosts, layer, point_names
from gruebler.drawing.prose import describe, title
from gruebler.drawing.sheet import Sheet
from gruebler.drawing.stage import Stage, staged
from gruebler.errors import LinkageError
from gruebler.linkages import Linkage

__all__ = ["draw_linkage", "told"]

_MOST_GHOSTS = 60
_MARGIN = 16.0  # pixels; half the width of a link with a slot is less
_AROUND = 17.0  # pixels from the middle of a block to its name
_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
_PLAIN = 95.0  # pixels: what is less around is a block between rails, with its name outside of these
_WORDS = {
    "en": {
        "pose": "To scale. Drive at {values}.",
        "curve": "Curve of {names}.",
        "ghosts": "{count} positions thinly.",
        "shown": "Shown: {names}.",
        "none": "Not there: {names}.",
    },
    "de": {
        "pose": "Maßstäblich. Antrieb bei {values}.",
        "curve": "Bahnkurve von {names}.",
        "ghosts": "{count} Stellungen dünn.",
        "shown": "Eingezeichnet: {names}.",
        "none": "Nicht vorhanden: {names}.",
    },
}
_LAYER_NAMES = {
    "dead-centres": ("dead centres", "Totlagen"),
    "centrodes": ("fixed centrode p, moving centrode q", "Rastpolbahn p, Gangpolbahn q"),
    "inflection": ("inflection circle with pole P, inflection pole W", "Wendekreis mit Pol P, Wendepol W"),
    "transmission": ("transmission angle", "Übertragungswinkel"),
    "velocities": ("velocities", "Geschwindigkeiten"),
    "accelerations": ("accelerations", "Beschleunigungen"),
    "poles": ("instant centres", "Momentanpole"),
    "dimensions": ("dimensions", "Maße"),
    "scale": ("scale", "Maßstab"),
}


def draw_linkage(
    linkage: Linkage,
    drive: float | Sequence[float] | None = None,
    *,
    branch: str | Iterable[str] | None = None,
    between: tuple[float, float] | None = None,
    curves: Sequence[str] = (),
    show: Sequence[str] = (),
    output: str | None = None,
    ghost: int = 0,
    labels: bool = False,
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
) -> Figure:
    """The picture of a linkage in one pose.

    Args:
        linkage: what to draw.
        drive: the drive's value (radians, or a way), one for each drive; a good one without it.
        branch: the assembly mode, as for `gruebler.kinematics.move`.
        between: drive values between which it is used, if not the whole range: for curves and the size of the picture.
        curves: points or joints whose paths are drawn.
        show: ``dead-centres``, ``transmission``, ``velocities``, ``accelerations``, ``poles``, ``centrodes``,
            ``inflection``, ``dimensions``, ``scale``.
        output: the link that dead centres and transmission angle are those of, the linkage's own without it; also
            that of centrodes and inflection circle, without it a link that is no neighbour of the frame.
        ghost: so many positions are drawn thinly, evenly through the range of the drive; at most 60.
        labels: whether to name the links.
        lang: language of title and description, ``en`` or ``de``.
        name: the title, if it is not to be found out.
        names: what to call links in the picture, where that is not their own name.

    Raises `gruebler.LinkageError` for poses out of reach, unknown names, and what several drives have not.

    >>> from gruebler.linkages import FourBar
    >>> figure = draw_linkage(FourBar(25, 70, 40, 70).linkage({"K": (35, 20)}), 1.0, curves=["K"])
    >>> len(figure.svg()) < 8000
    True
    """
    stage = staged(linkage, drive, branch=branch, between=between)
    layers = {key: layer(key) for key in dict.fromkeys(show)}
    curve = [shape for one in dict.fromkeys(curves) for shape in coupler_curve(stage, one)]
    pieces = parts(stage)
    frame = _at(stage, pieces, FRAME, FRAME)
    pins = _at(stage, pieces, PINS, PINS)
    below = {key: layers[key](Sheet(stage, output, [*frame, *pins])) for key in layers if key in BELOW}
    shapes = [
        *frame,
        *(ghosts(stage, _count(ghost)) if ghost else []),
        *(shape for made in below.values() for shape in made),
        *_at(stage, pieces, BODIES, PINS - 1),
        *curve,
        *pins,
        *drive_arrows(stage),
    ]
    empty = [key for key in below if not below[key]]
    for key in (key for key in layers if key not in below):
        made = layers[key](Sheet(stage, output, shapes))
        shapes += made
        empty += [] if made else [key]
    shapes += point_names(stage, shapes)
    if labels:
        shapes = _named(stage, shapes, names)
    described = f"{describe(linkage.mechanism, lang)} {told(stage, curves, tuple(layers), empty, lang, ghost)}"
    return figure_of(shapes, title(linkage.mechanism, lang, name), described, margin=_MARGIN)


def _at(stage: Stage, pieces: Sequence[Part], lowest: int, highest: int) -> list[Shape]:
    """The shapes of some layers in the pose."""
    return [shape for part in pieces if lowest <= part.layer <= highest for shape in at_pose(stage, part)]


def _named(stage: Stage, shapes: list[Shape], names: Mapping[str, str] | None) -> list[Shape]:
    """The shapes with names beside the bodies."""
    outlines = {link: _outline(stage, link) for link in stage.linkage.mechanism.chain.links}
    return labelled(outlines, {link: len(outlines[link]) > 2 for link in outlines}, shapes, names)


def _outline(stage: Stage, link: str) -> tuple[Point, ...]:
    """Corners beside which the name of a link is put: those of its body, barrel, rod or block; for the frame a base."""
    mine = [part for part in parts(stage) if part.link == link]
    lines = [(part.layer, shape) for part in mine for shape in part.shapes if isinstance(shape, Lines)]
    corners = corners_of(stage, link, slides(stage))
    if link == stage.lower.mechanism.frame:
        corners = next((shape for _, shape in lines if shape.style == "block-frame"), lines[0][1]).parts[0][-2:]
    elif len(corners) < 2:
        long = [shape.parts[0] for layer, shape in lines if layer == BLOCKS or shape.style.endswith("-rod")]
        middle = corners[0] if corners else Point(0.0, 0.0)
        corners = max(long, key=_perimeter, default=(middle,))
        if _perimeter(corners) < _PLAIN:
            corners = tuple(middle.plus(Point(a * _AROUND, b * _AROUND)) for a, b in _SQUARE)
    placed = at_pose(stage, Part(BODIES, link, (Lines((corners,), "edge"),)))[0]
    assert isinstance(placed, Lines)
    return placed.parts[0]


def _perimeter(corners: Sequence[Point]) -> float:
    return sum(b.minus(a).length for a, b in pairwise([*corners, corners[0]]))


def _count(number: int) -> int:
    if not 0 < number <= _MOST_GHOSTS:
        raise LinkageError(f"expected 1 to {_MOST_GHOSTS} thin positions, but found {number!r}")
    return number


def told(
    stage: Stage, curves: Sequence[str], layers: Sequence[str], empty: Sequence[str], lang: str, count: int = 0
) -> str:
    """The pose, what is shown, and what was asked for but is not there, in words."""
    words, mechanism = _WORDS[lang], stage.lower.mechanism
    values = [
        f"{round(degrees(value), 2) + 0.0:g}°"
        if drive.direction.startswith("R")
        else f"{value:.4g} {stage.linkage.unit}"
        for value, drive in zip(stage.pose.drives[0], mechanism.drives, strict=True)
    ]
    said = [words["pose"].format(values=", ".join(values))]
    if curves:
        said.append(words["curve"].format(names=", ".join(dict.fromkeys(curves))))
    if count:
        said.append(words["ghosts"].format(count=count))
    for word, keys in (("shown", [key for key in layers if key not in empty]), ("none", empty)):
        if keys:
            said.append(words[word].format(names=", ".join(_LAYER_NAMES[key][lang == "de"] for key in keys)))
    return " ".join(said)
