"""Pictures of linkages to scale, in any pose that their drives can reach: docs/theory/drawing.md."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import cos, degrees, inf, pi, sin
from typing import TYPE_CHECKING

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import message, number, number_separator, plural, translate
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.points import PointLike, each_point
from gruebler.pictures.canvas.axes import as_text
from gruebler.pictures.canvas.figure import MARGIN, Figure, figure_of
from gruebler.pictures.canvas.labels import labels_with_names, legend
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape
from gruebler.pictures.linkage.arrows import scale_bars
from gruebler.pictures.linkage.bodies import (
    BLOCKS,
    BODIES,
    FRAME,
    PINS,
    BodyPart,
    CarriedLine,
    barrel,
    body_parts,
    corners_of,
    layered,
    outline_parts,
    room_for,
    shapes_at_pose,
)
from gruebler.pictures.linkage.instant_centres import pole_numbers
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.layers import BELOW, coupler_curve_lines, drive_arrows, ghosts, layer, point_names
from gruebler.pictures.linkage.letters import driven_angle, joint_names
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, posed_linkage
from gruebler.pictures.linkage.slides import Slide, pins_of, slides
from gruebler.pictures.structure.messages import describe, title
from gruebler.pictures.structure.picture import draw_structure

if TYPE_CHECKING:
    from gruebler.mechanics.forces import Loads

_MOST_GHOSTS = 60
_AROUND = 17.0  # pixels from the middle of a block to its name
_ALONG, _BESIDE = 0.75, 12.0  # where the letter of a length on a plate stands: off its middle, where a point may be
_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
_WHEEL, _ROUND = 12.0, 24  # pixels of the radius of a wheel, at least; points around it
_PLAIN = 95.0  # pixels: a smaller perimeter is that of a block between rails, with its name outside of these
_MARKS = ("edge", "dot", "value")  # crosses, points and texts of layers below
_LAST = ("dimensions", "offset", "joints")
"""Layers that give way to all others, and letters of joints to the lines of dimensions."""
_CENTRODES = {"p": message("fixed centrode"), "q": message("moving centrode")}
_POLES = {"P": message("pole P"), "W": message("inflection pole W")}
_INFLECTION = {
    "P": message("pole"),
    "W": message("inflection pole"),
    "t": message("pole tangent"),
    "n": message("pole normal"),
}


@door_that_raises(LinkageError)
def draw_linkage(
    linkage: LinkageLike,
    *,
    loads: Loads | None = None,
    branch: Branch = None,
    at: float | Sequence[float] | None = None,
    between: tuple[float, float] | None = None,
    speed: float | None = None,
    curves: Sequence[PointLike] = (),
    show: Sequence[str] = (),
    output: str | None = None,
    ghost: int | None = None,
    labels: bool = False,
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
    letters: Sequence[str] = (),
    outlines: Sequence[CarriedLine] = (),
    largest: float = inf,
) -> Figure:
    """The picture of a linkage in one pose.

    Options as for `gruebler.draw`; ``outlines`` are lines that links carry, in coordinates of the links; ``largest``
    is the most pixels to a unit.

    Raises `gruebler.LinkageError` for unreachable poses, unknown names, and layers that need a single drive.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> figure = draw_linkage(FourBar(25, 70, 40, 70).linkage({"K": (35, 20)}), at=1.0, curves=["K"])
    >>> len(figure.svg()) < 8000
    True
    """
    linkage = as_linkage(linkage, unit="")
    posed = room_for(posed_linkage(linkage, at, branch=branch, between=between), outlines)
    posed = replace(posed, scale=min(posed.scale, largest))
    layers = {key: layer(key) for key in dict.fromkeys(show)}
    if "joints" in layers:
        layers["joints"] = layers["joints"]._replace(shapes=partial(joint_names, letters=tuple(letters)))
    curve = [shape for point in each_point(curves).values() for shape in coupler_curve_lines(posed, point)]
    pieces = (*body_parts(posed), *outline_parts(posed, outlines))
    frame = layered(posed, pieces, FRAME, FRAME)
    pins = layered(posed, pieces, PINS, PINS)
    bodies = layered(posed, pieces, BODIES, PINS - 1)
    context = LayerContext(posed, output, [*frame, *bodies, *pins], lang)
    layer_shapes = {key: layers[key].shapes(context) for key in layers if key in BELOW}
    below = [shape for shapes in layer_shapes.values() for shape in shapes]
    frame_line = _ends(posed, posed.lower.mechanism.frame, names) if labels else ()
    shapes = [
        *((Polylines((frame_line,), "measure"),) if frame_line else ()),
        *frame,
        *(ghosts(posed, _count(ghost)) if ghost is not None else []),
        *(shape for shape in below if shape.style not in _MARKS),
        *bodies,
        *(line for _, line in (_sides(posed, pieces, names) if labels else ())),
        *curve,
        *pins,
        *drive_arrows(posed, measured=driven_angle(posed) if "angles" in layers else None),
        *(shape for shape in below if shape.style in _MARKS),
        *_of_loads(posed, loads, speed),
    ]
    for key in sorted((key for key in layers if key not in BELOW and key not in _LAST), key="poles".__eq__):
        layer_shapes[key] = layers[key].shapes(context._replace(drawn=shapes))
        shapes += layer_shapes[key]
    shapes += point_names(posed, shapes)
    texts, rows = _named(posed, pieces, shapes, names) if labels else ([], {})
    shapes += texts
    for key in (key for key in _LAST if key in layers):
        layer_shapes[key] = layers[key].shapes(context._replace(drawn=shapes))
        shapes += layer_shapes[key]
    shapes += scale_bars(context._replace(drawn=shapes), tuple(layers))
    if "poles" in layers:
        numbers = pole_numbers(linkage.mechanism.chain.links)
        rows = {(names or {}).get(link, link): number for link, number in numbers.items() if number != link} | rows
    meanings = _CENTRODES if layer_shapes.get("centrodes") else {}
    written = {shape.text for shape in layer_shapes.get("inflection", ()) if isinstance(shape, TextShape)}
    meanings = meanings | {letter: text for letter, text in _INFLECTION.items() if letter in written}
    rows |= {meaning.in_language(lang): letter for letter, meaning in meanings.items()}
    if rows:
        shapes += legend(rows, [Point(0.0, 0.0)], shapes)
    sentences, missing = picture_notes(posed, curves, {key: layer_shapes[key] for key in layers}, lang, ghost or 0)
    described = f"{describe(linkage.mechanism, lang)} {' '.join([*sentences, *missing])}"
    return figure_of(shapes, title(linkage.mechanism, lang, name), described, MARGIN, missing)


def _of_loads(posed: PosedLinkage, loads: Loads | None, speed: float | None) -> list[Shape]:
    if loads is None:
        return []
    from gruebler.pictures.linkage.load_pictures import load_lines, mass_parts  # dynamics, which few pictures need

    masses = [shape for part in mass_parts(posed, loads) for shape in shapes_at_pose(posed, part)]
    return [*masses, *load_lines(posed, posed.pose, loads, speed)[0]]


def shown_linkage(linkage: Linkage) -> Figure:
    """A linkage for notebooks: in a pose; without one the structure of its mechanism, with the reason."""
    try:
        return draw_linkage(linkage, labels=True)
    except GrueblerError as reason:
        figure = draw_structure(linkage.mechanism, labels=True)
        return replace(figure, description=f"{figure.description} {reason}", notes=(str(reason),))


def _named(
    posed: PosedLinkage, pieces: Sequence[BodyPart], shapes: Sequence[Shape], names: Mapping[str, str] | None
) -> tuple[list[Shape], dict[str, str]]:
    """Names beside the bodies, and the entries of the list."""
    joint_slides = slides(posed)
    outlines = {link: _outline(posed, link, pieces, joint_slides) for link in posed.linkage.mechanism.chain.links}
    outlines |= {link: ends for link in outlines if (ends := _ends(posed, link, names))}
    plates = {link: line.parts[0] for link, line in _sides(posed, pieces, names)}
    texts, rows = labels_with_names(
        {link: outline for link, outline in outlines.items() if link not in plates},
        {link: len(outlines[link]) > 2 for link in outlines},
        shapes,
        names,
    )
    for link, (p, q) in plates.items():
        along = q.minus(p)
        beside = Point(along.y, -along.x)
        place = p.plus(along, _ALONG).plus(beside, _BESIDE / beside.length)
        texts.append(TextShape(place, (names or {})[link], "name"))
    return texts, rows


def _ends(posed: PosedLinkage, link: str, names: Mapping[str, str] | None) -> tuple[Point, ...]:
    """The two pins between which a link is a length with a letter, which stands beside their line; else none."""
    pins = dict.fromkeys(pins_of(posed.lower, link))
    if len((names or {}).get(link, "").strip()) != 1 or len(pins) != 2:
        return ()
    return _placed(posed, link, [posed.local(pin) for pin in pins])


def _sides(
    posed: PosedLinkage, pieces: Sequence[BodyPart], names: Mapping[str, str] | None
) -> Iterator[tuple[str, Polylines]]:
    """The links that are plates with a letter for a length, and this as a line on the plate."""
    for link in posed.lower.mechanism.chain.links:
        ends = _ends(posed, link, names)
        if ends and link != posed.lower.mechanism.frame and len(_outline(posed, link, pieces, slides(posed))) > 2:
            yield link, Polylines((ends,), "measure")


def _outline(
    posed: PosedLinkage, link: str, pieces: Sequence[BodyPart], joint_slides: tuple[Slide, ...]
) -> tuple[Point, ...]:
    """Corners for placing the name of a link: those of its body, barrel, rod or block; for the frame of a base."""
    parts = [part for part in pieces if part.link == link]
    lines = [(part.layer, shape) for part in parts for shape in part.shapes if isinstance(shape, Polylines)]
    corners = corners_of(posed, link, joint_slides)
    rod = next((slide for slide in joint_slides if slide.block == link and slide.sign == "cylinder"), None)
    rims = [rim for part in parts for shape in part.shapes if (rim := _rim(shape))]
    if link == posed.lower.mechanism.frame:
        bases = [shape.parts[0][-2:] for _, shape in lines if shape.style == "block-frame"]
        rails = [shape.parts[0] for _, shape in lines if shape.style == "rail"]
        corners = bases[0] if bases else max(rails or [lines[0][1].parts[0]], key=lambda rail: max(p.y for p in rail))
    elif rims and (len(corners) < 2 or max(map(_perimeter, rims)) > _perimeter(corners)):
        corners = max(rims, key=_perimeter)
    elif len(corners) < 2 and rod is not None:
        return _seen_of_rod(posed, rod)
    elif len(corners) < 2:
        long = [shape.parts[0] for layer, shape in lines if layer == BLOCKS]
        middle = corners[0] if corners else Point(0.0, 0.0)
        corners = max(long, key=_perimeter, default=(middle,))
        if _perimeter(corners) < _PLAIN:
            corners = tuple(middle.plus(Point(a * _AROUND, b * _AROUND)) for a, b in _SQUARE)
    return _placed(posed, link, corners)


def _rim(shape: Shape) -> tuple[Point, ...]:
    """Some points around a wheel, a cam or another contour; empty for other shapes."""
    if isinstance(shape, CircleShape) and shape.radius > _WHEEL and shape.style != "dead":
        turns = [2 * pi * k / _ROUND for k in range(_ROUND)]
        return tuple(shape.at.plus(Point(cos(turn), sin(turn)), shape.radius) for turn in turns)
    if isinstance(shape, Polylines) and shape.style == "area" and shape.closed:
        contour = shape.parts[0]
        return contour[:: -(-len(contour) // _ROUND)]
    return ()


def _seen_of_rod(posed: PosedLinkage, rod: Slide) -> tuple[Point, ...]:
    """The part of a rod outside of its barrel: from there to its pin."""
    return *_placed(posed, rod.guide, barrel(posed, rod)[1:]), *_placed(posed, rod.block, [posed.local(rod.middle)])


def _placed(posed: PosedLinkage, link: str, corners: Sequence[Point]) -> tuple[Point, ...]:
    """Points of a link transformed to the pose."""
    (line,) = shapes_at_pose(posed, BodyPart(BODIES, link, (Polylines((tuple(corners),), "edge"),)))
    assert isinstance(line, Polylines)
    return line.parts[0]


def _perimeter(corners: Sequence[Point]) -> float:
    return sum(b.minus(a).length for a, b in pairwise([*corners, corners[0]]))


def _count(number: int) -> int:
    if not 0 < number <= _MOST_GHOSTS:
        raise LinkageError(
            "expected 1 to {most} thin positions, but found {number!r}", most=_MOST_GHOSTS, number=number
        )
    return number


def picture_notes(
    posed: PosedLinkage,
    curves: Sequence[PointLike],
    layer_shapes: Mapping[str, Sequence[Shape]],
    lang: str,
    count: int = 0,
) -> tuple[list[str], list[str]]:
    """The pose and the content of the picture, in sentences; and the requested layers that are missing."""
    drives = posed.linkage.mechanism.drives
    values = [
        number(round(degrees(value), 2) + 0.0, lang, "g") + "°"
        if drive.turning
        else as_text(float(value), posed.linkage.unit, lang)
        for value, drive in zip(posed.pose.drives[0], drives, strict=bool(drives))
    ]
    sentences = [
        translate(
            "To scale. Drive at {values}." if drives else "To scale, in the reference pose; nothing is driven.",
            lang,
            values=number_separator(lang).join(values),
        )
    ]
    if len(curves):
        sentences.append(translate("Curve of {points}.", lang, points=", ".join(each_point(curves))))
    if count:
        sentences.append(plural("{count} position thinly.", "{count} positions thinly.", count, lang))
    shown = [_layer_name(key, shapes, lang) for key, shapes in layer_shapes.items() if shapes or key == "scale"]
    empty = [_layer_name(key, (), lang) for key, shapes in layer_shapes.items() if not shapes and key != "scale"]
    missing = [translate("Missing, or outside the picture: {layers}.", lang, layers=", ".join(empty))] if empty else []
    sentences += [translate("Shown: {layers}.", lang, layers=", ".join(shown))] if shown else []
    return sentences, missing


def _layer_name(key: str, shapes: Sequence[Shape], lang: str) -> str:
    """The name of a layer; for an inflection circle with its poles that lie in the picture."""
    name = layer(key).title.in_language(lang)
    text = {shape.text for shape in shapes if isinstance(shape, TextShape)}
    poles = [pole.in_language(lang) for letter, pole in _POLES.items() if key == "inflection" and letter in text]
    return f"{name} ({', '.join(poles)})" if poles else name
