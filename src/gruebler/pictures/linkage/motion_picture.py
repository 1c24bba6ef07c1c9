"""The picture of a motion: its first pose, some others as thin lines, and the paths of named points."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain

import numpy as np

from gruebler.base.text import translate
from gruebler.mechanics.kinematics import Motion
from gruebler.pictures.canvas.figure import MARGIN, Figure, figure_of
from gruebler.pictures.linkage.bodies import FRAME, PINS, body_parts, layered
from gruebler.pictures.linkage.layers import curve_of, drive_arrows, ghost, point_names
from gruebler.pictures.linkage.posed_linkage import posed_along_motion
from gruebler.pictures.structure.messages import describe, title
from gruebler.pictures.structure.picture import draw_structure

_GHOSTS = 5


def draw_motion(motion: Motion, *, lang: str = "en", name: str = "") -> Figure:
    """A solved motion; for a motion without a pose the structure of its mechanism, with the reason.

    >>> from gruebler.mechanics.kinematics import from_degrees, move
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> motion = move(FourBar(25, 70, 40, 70).linkage({"K": (35, 20)}), from_degrees(0, 90, 5))
    >>> draw_motion(motion).description[-46:]
    'A motion of 19 poses; 5 of them in thin lines.'
    """
    mechanism = motion.linkage.mechanism
    about = describe(mechanism, lang)
    if not len(motion):
        return replace(
            draw_structure(mechanism, labels=True, lang=lang, name=name), description=f"{about} {motion.message(lang)}"
        )
    posed = posed_along_motion(motion)
    rows = sorted({round(row) for row in np.linspace(0, len(motion) - 1, _GHOSTS + 1)[1:]} - {0})
    pieces = body_parts(posed)
    below, above = layered(posed, pieces, FRAME, PINS - 1), layered(posed, pieces, PINS, PINS)
    shapes = [
        *chain.from_iterable(ghost(posed, motion, row) for row in rows),
        *below,
        *(curve_of(posed, motion.complex_point(point), "curve") for point in posed.lower.points if len(motion) > 1),
        *above,
        *drive_arrows(posed),
    ]
    shapes += point_names(posed, shapes)
    poses = translate(
        "A motion of {poses} poses; {ghosts} of them in thin lines.", lang, poses=len(motion), ghosts=len(rows)
    )
    return figure_of(shapes, title(mechanism, lang, name), f"{about} {poses} {motion.message(lang)}".rstrip(), MARGIN)
