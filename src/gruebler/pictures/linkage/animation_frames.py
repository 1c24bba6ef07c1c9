"""Animations as sequences of pictures: GIF, WebP and APNG, painted by matplotlib and combined by pillow."""

from __future__ import annotations

from typing import Unpack

from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.frames import check_kind, frames_file
from gruebler.pictures.canvas.shapes import Point, moved_shape
from gruebler.pictures.linkage.animation import AnimationOptions, Scene, scene
from gruebler.pictures.linkage.bodies import PINS, shapes_at_pose

_MOST = 144  # pictures of a file


def animated_frames(
    linkage: Linkage, kind: str, *, dark: bool = False, zoom: float = 1.25, **options: Unpack[AnimationOptions]
) -> bytes:
    """The content of a ``gif``, ``webp`` or ``png`` file of the moving linkage, repeated without end.

    Args:
        linkage: with one drive.
        kind: of the file; a png is an APNG, of which other viewers show the first picture.
        dark: whether the ground is dark.
        zoom: pixels of the file for a pixel of the picture.
        options: those of `gruebler.pictures.linkage.animation.scene`.

    Cost: some 40 ms a picture. Raises `GrueblerError` if matplotlib is not installed, `LinkageError` as `scene` does.
    """
    check_kind(kind)
    shown = scene(linkage, **options)
    rows = shown.rows[:-1]
    rows = rows[:: -(-len(rows) // _MOST)]
    figures = {row: _figure(shown, row) for row in dict.fromkeys(rows)}
    return frames_file([figures[row] for row in rows], kind, shown.seconds, dark=dark, zoom=zoom)


def _figure(shown: Scene, row: int) -> Figure:
    """The scene in one pose."""
    posed, by = shown.posed, Point(-shown.corner.x, -shown.corner.y)
    below, above = (
        [
            shape
            for part in shown.pieces
            if (part.layer >= PINS) == pins
            for shape in shapes_at_pose(posed, part, posed.path, row)
        ]
        for pins in (False, True)
    )
    changing = shown.changing[row] if shown.changing else ()
    page = shown.page
    shapes = tuple(moved_shape(shape, by) for shape in (*below, *shown.still, *above, *changing))
    return Figure(shapes, width=page.width, height=page.height, title=page.title, description=page.description)
