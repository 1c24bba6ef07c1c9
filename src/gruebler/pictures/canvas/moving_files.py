"""Moving pictures as bytes of a file: SVG, one HTML page, or a sequence of pictures."""

from __future__ import annotations

import math

from gruebler.pictures.canvas.frames import FRAMES, frames_file
from gruebler.pictures.canvas.moving_frames import FramePicture
from gruebler.pictures.canvas.moving_page import PageSettings, moving_page_html
from gruebler.pictures.canvas.moving_picture import MovingPicture, figure_at, moving_svg

MOVING = ("svg", "html", *FRAMES)
"""Kinds of files; png is APNG."""
_MOST, _RATE = 144, 20  # pictures of a file, and a second


def moving_page(picture: MovingPicture | FramePicture, lang: str = "en") -> str:
    """An HTML page with the picture, a button and a slider for the drive."""
    clock = picture.clock
    places = max(0, 3 - math.floor(math.log10(max(clock.high - clock.low, 1e-9))))
    settings = PageSettings(
        low=clock.low, high=clock.high, seconds=clock.seconds, round=clock.round, places=places, unit=clock.unit
    )
    return moving_page_html(_svg(picture), picture.page, settings, lang)


def moving_bytes(picture: MovingPicture | FramePicture, kind: str, *, dark: bool = False, lang: str = "en") -> bytes:
    """The content of an ``svg``, ``html``, ``gif``, ``webp`` or ``png`` file.

    Pictures are on light or dark ground, twenty a second, 144 at most. Raises `GrueblerError` if matplotlib is needed
    and missing.
    """
    if kind == "svg":
        return _svg(picture).encode("utf-8")
    if kind == "html":
        return moving_page(picture, lang).encode("utf-8")
    count = min(_MOST, max(2, round(_RATE * picture.clock.seconds)))
    if isinstance(picture, FramePicture):
        figures = [picture.figure_at((k + 0.5) / count) for k in range(count)]
    else:
        figures = [figure_at(picture, k / count) for k in range(count)]
    return frames_file(figures, kind, picture.clock.seconds, dark=dark)


def _svg(picture: MovingPicture | FramePicture) -> str:
    return picture.svg() if isinstance(picture, FramePicture) else moving_svg(picture)
