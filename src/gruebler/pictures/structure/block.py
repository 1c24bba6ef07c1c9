"""The block picture of a mechanism: drive, mechanism and output as boxes, and the motions between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from gruebler.base.text import listed, translate
from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape, TextShape, text_width
from gruebler.pictures.canvas.symbols import arrow
from gruebler.pictures.structure.messages import title
from gruebler.structure.mechanism import Mechanism

_HIGH, _LEAST = 64.0, 96.0  # pixels of a box
_BETWEEN = 124.0
_PADDING = 14.0


def draw_block(
    mechanism: Mechanism,
    *,
    outputs: Sequence[str] = (),
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
) -> Figure:
    """The block picture: which motion goes in, which comes out.

    An output at the frame turns by ψ or slides by s_a; one that is not is guided.

    >>> crank = Mechanism.parse("R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)")
    >>> [shape.text for shape in draw_block(crank, outputs=["3"]).shapes if isinstance(shape, TextShape)][-4:]
    ['φ', 'rotation', 's_a = f(φ)', 'translation']
    """
    called = names or {}
    driven = listed([called.get(link, link) for link in _driven(mechanism)], lang)
    moved = listed([called.get(link, link) for link in outputs], lang)
    boxes = (
        (translate("drive", lang), driven),
        (translate("mechanism", lang), title(mechanism, lang, name)),
        (translate("output", lang), moved),
    )
    shapes: list[Shape] = []
    edges: list[float] = []
    left = 0.0
    for heading, text in boxes:
        wide = max(_LEAST, 2 * _PADDING + max(text_width(heading), text_width(text)))
        corners = Point(left, 0), Point(left + wide, 0), Point(left + wide, _HIGH), Point(left, _HIGH)
        shapes.append(Polylines((corners,), "area", closed=True))
        rows = [(heading, "name"), *([(text, "value")] if text else [])]
        for k, (row, style) in enumerate(rows):
            at = Point(left + wide / 2, _HIGH / 2 + 22.0 * (k - (len(rows) - 1) / 2))
            shapes.append(TextShape(at, row, style))
        edges += [left, left + wide]
        left += wide + _BETWEEN
    motions = _input_motion(mechanism, lang), _output_motion(mechanism, outputs, lang)
    for (begin, end), (symbol, kind) in zip(((edges[1], edges[2]), (edges[3], edges[4])), motions, strict=True):
        middle = (begin + end) / 2
        shapes += arrow(Point(begin + 4, _HIGH / 2), Point(end - 11, _HIGH / 2), "edge", "dot")
        shapes += [
            TextShape(Point(middle, _HIGH / 2 + y), text, "value") for text, y in ((symbol, -14), (kind, 15)) if text
        ]
    about = " – ".join(f"{heading}: {text}" if text else heading for heading, text in boxes)
    return figure_of(shapes, title(mechanism, lang, name), about, margin=14.0)


def _driven(mechanism: Mechanism) -> list[str]:
    """The driven links: of a drive at the frame the other link, else both."""
    every = [link for drive in mechanism.drives for link in drive.between if link != mechanism.frame]
    return [*dict.fromkeys(every)]


def _input_motion(mechanism: Mechanism, lang: str) -> tuple[str, str]:
    symbols = ["φ" if drive.turning else "s_e" for drive in mechanism.drives]
    numbered = len(symbols) > 1
    text = ", ".join(f"{symbol}{chr(0x2080 + k)}" if numbered else symbol for k, symbol in enumerate(symbols, 1))
    kinds = dict.fromkeys(
        translate("rotation", lang) if drive.turning else translate("translation", lang) for drive in mechanism.drives
    )
    return text, ", ".join(kinds)


def _output_motion(mechanism: Mechanism, outputs: Sequence[str], lang: str) -> tuple[str, str]:
    """The motion of the outputs by their joints with the frame."""
    motions: dict[str, str] = {}
    for link in outputs:
        at_frame = [joint.pair for joint in mechanism.chain.joints if {link, mechanism.frame} <= {*joint.links}]
        if any(pair.is_sliding for pair in at_frame):
            motions["s_a"] = translate("translation", lang)
        elif any(pair.turns_in_plane for pair in at_frame):
            motions["ψ"] = translate("rotation", lang)
        else:
            motions[""] = translate("guided motion", lang)
    drive = _input_motion(mechanism, lang)[0]
    symbols = [f"{symbol} = f({drive})" for symbol in motions if symbol and drive]
    return ", ".join(symbols), ", ".join(motions.values())
