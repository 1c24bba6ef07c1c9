"""Linkages in space that move by themselves: frames in isometric or oblique view."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import degrees

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.mechanics.kinematics.drive_rows import path_of_values
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space.drive_ranges import followed, spatial_range
from gruebler.pictures.canvas.moving_frames import FramePicture, frame_picture
from gruebler.pictures.canvas.moving_picture import Clock, always
from gruebler.pictures.space.picture import path_on_paper
from gruebler.pictures.space.scene import scene_of
from gruebler.pictures.space.views import usual_view, view_named
from gruebler.pictures.structure.messages import describe, title

_RATE, _MOST = 15, 90  # frames a second, and in all


@door_that_raises(LinkageError)
def animate_spatial(
    linkage: SpatialLinkage,
    *,
    between: tuple[float, float] | None = None,
    drives: ArrayLike | Mapping[str, object] | None = None,
    curves: Sequence[str] = (),
    view: str = "",
    seconds: float = 4.0,
    lang: str = "en",
    name: str = "",
) -> FramePicture:
    """A full turn of the drive, or its range to and fro.

    Options as for `gruebler.animate`; ``between`` are values of the first drive, others stay at 0.

    Raises `LinkageError` for drives that cannot go there.
    """
    count = max(2, min(_MOST, round(_RATE * always(seconds))))
    full = False
    if drives is not None:
        path = path_of_values(np.asarray(drives, float), len(linkage.mechanism.drives))
    elif between is not None:
        path = np.outer(between, np.eye(len(linkage.mechanism.drives))[0])
    else:
        course = spatial_range(linkage)
        full = course.full
        path = course.inside(2)[:, None]
    part = np.arange(count) / count if full else np.sin(np.pi * np.arange(count) / count) ** 2
    rows = np.arange(len(path)) / (len(path) - 1)
    values = np.stack([np.interp(part, rows, column) for column in path.T], axis=1)
    motion = followed(linkage, values)
    scene = scene_of(linkage, view_named(view or usual_view(linkage)), motion.poses[0])
    paths = [path_on_paper(scene, motion, point) for point in curves]
    frames = [[*scene.shapes(poses), *paths] for poses in motion.poses[0]]
    turning = linkage.mechanism.drives[0].turning
    low, high = (degrees(q) if turning else float(q) for q in (path[0, 0], path[-1, 0]))
    unit = "°" if turning else f" {linkage.unit}".rstrip()
    moves = translate("A turn of the drive in {seconds:g} s.", lang, seconds=seconds) if full else ""
    about = " ".join(filter(None, [scene.view.title.in_language(lang), moves, describe(linkage.mechanism, lang)]))
    clock = Clock(seconds=seconds, low=low, high=high, unit=unit, round=full)
    return frame_picture(frames, clock, title(linkage.mechanism, lang, name), about)
