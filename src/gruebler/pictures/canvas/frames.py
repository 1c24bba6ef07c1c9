"""Sequences of pictures as GIF, WebP and APNG, painted by matplotlib and combined by pillow."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.matplotlib_files import matplotlib_figure

FRAMES = ("gif", "webp", "png")
"""Kinds of files; png is APNG."""


_COLOURS = 64  # of a file: those of the styles and the most frequent mixtures at edges


_ALIKE = 14.0  # between two colours, of 255 in each of three parts


_TICK = {"gif": 10}  # milliseconds: the times of a GIF are multiples of it


def check_kind(kind: str) -> None:
    """Raise `GrueblerError` for a kind of file that is not in `FRAMES`."""
    if kind not in FRAMES:
        raise GrueblerError(
            "expected a kind of file among {frames}, but found {kind!r}", frames=", ".join(FRAMES), kind=kind
        )


def frames_file(
    figures: Sequence[Figure], kind: str, seconds: float, *, dark: bool = False, zoom: float = 1.25
) -> bytes:
    """The content of a file that shows figures of one size in sequence, at an even rate, repeated without end.

    The same figure object is painted only once. ``seconds`` is the time of all; the other arguments are those of
    `animated_frames`.
    """
    check_kind(kind)
    distinct = {id(figure): figure for figure in figures}
    pictures = {key: _picture(figure, zoom, dark) for key, figure in distinct.items()}
    palette = _palette(pictures[id(figures[0])])
    pictures = {key: picture.quantize(palette=palette, dither=0) for key, picture in pictures.items()}
    tick = _TICK.get(kind, 1)
    ends = [tick * round(1000 * seconds * k / len(figures) / tick) for k in range(len(figures) + 1)]
    memory = io.BytesIO()
    first, *others = (pictures[id(figure)] for figure in figures)
    first.save(
        memory,
        kind,
        save_all=True,
        append_images=others,
        duration=[max(b - a, tick) for a, b in pairwise(ends)],
        loop=0,
        **_SAVED[kind],
    )
    return memory.getvalue()


_SAVED: dict[str, dict[str, Any]] = {"gif": {"optimize": True}, "webp": {"lossless": True, "method": 4}, "png": {}}


def _picture(figure: Figure, zoom: float, dark: bool) -> Any:
    """The pixels of a figure."""
    canvas = matplotlib_figure(figure, dark=dark)
    canvas.set_dpi(96 * zoom)
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    agg: Any = FigureCanvasAgg(canvas)
    agg.draw()
    return Image.fromarray(np.asarray(agg.buffer_rgba())[:, :, :3])


def _palette(picture: Any) -> Any:
    """The most frequent colours of a picture, without near duplicates."""
    from PIL import Image

    counted = picture.getcolors(picture.width * picture.height)
    often: list[tuple[int, int, int]] = []
    for _, colour in sorted(counted, key=lambda pair: (-pair[0], pair[1])):
        if len(often) < _COLOURS and all(math.dist(colour, other) > _ALIKE for other in often):
            often.append(colour)
    palette = Image.new("P", (1, 1))
    palette.putpalette([part for colour in often for part in colour])
    return palette
