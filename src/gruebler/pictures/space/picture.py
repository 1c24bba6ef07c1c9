"""Pictures of linkages in space: docs/theory/pictures-in-space.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import SpatialMotion, move
from gruebler.mechanics.space.drive_ranges import followed, spatial_range
from gruebler.pictures.canvas.figure import MARGIN, Figure, figure_of
from gruebler.pictures.canvas.labels import labels_or_numbers, note_near
from gruebler.pictures.canvas.shapes import Polylines, Shape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.space.parts import points_on_paper
from gruebler.pictures.space.scene import SpatialScene, scene_of
from gruebler.pictures.space.views import usual_view, view_named
from gruebler.pictures.structure.messages import describe, title
from gruebler.structure.chain.pairs import Alphabet


@door_that_raises(LinkageError)
def draw_spatial(
    linkage: SpatialLinkage,
    *,
    at: float | Sequence[float] | None = None,
    between: tuple[float, float] | None = None,
    curves: Sequence[str] = (),
    view: str = "",
    labels: bool = False,
    symbols: bool = True,
    names: Mapping[str, str] | None = None,
    lang: str = "en",
    name: str = "",
) -> Figure:
    """A linkage in space, or on the sphere, to scale.

    Options as for `gruebler.draw`.

    Raises `LinkageError` for drive values that cannot be reached.
    """
    poses = None if at is None else poses_at(linkage, at)
    course = course_of(linkage, between) if curves else None
    seen = [each for each in (None if course is None else course.poses[0], poses) if each is not None]
    all_poses = np.concatenate([each.reshape(-1, *each.shape[-3:]) for each in seen]) if seen else None
    scene = scene_of(linkage, view_named(view or usual_view(linkage)), all_poses)
    shapes = scene.shapes(poses)
    if course is not None:
        shapes += [path_on_paper(scene, course, point) for point in curves]
    if labels:
        shapes = _with_names(scene, shapes, poses, names)
    if symbols:
        shapes = _with_letters(scene, shapes, poses, lang)
    about = f"{scene.view.title.in_language(lang)} {describe(linkage.mechanism, lang)}"
    return figure_of(shapes, title(linkage.mechanism, lang, name), about, margin=MARGIN)


def poses_at(linkage: SpatialLinkage, at: ArrayLike) -> Reals:
    """The poses of the links at drive values, (links, 4, 4); `LinkageError` if they cannot be reached."""
    end = np.atleast_1d(np.asarray(at, float))
    motion: SpatialMotion = move(linkage, np.array([np.zeros(len(end)), end]))
    if motion.stop is not None:
        raise LinkageError("{reason}", reason=motion.stop.message)
    return np.asarray(motion.poses[0, -1])


def course_of(linkage: SpatialLinkage, between: tuple[float, float] | None, rows: int = 181) -> SpatialMotion:
    """The motion over the range of its drive, or between two of its values; `LinkageError` if it has several drives."""
    values = spatial_range(linkage).inside(rows) if between is None else np.linspace(*between, rows)
    return followed(linkage, values[:, None])


def path_on_paper(scene: SpatialScene, course: SpatialMotion, point: str) -> Polylines:
    """The path of a point on paper."""
    return Polylines((tuple(simplified(points_on_paper(scene.on_paper(course.point(point))), FINE)),), "curve")


def _pose(scene: SpatialScene, poses: Reals | None, link: str) -> Reals:
    return np.eye(4) if poses is None else np.asarray(poses[scene.linkage.mechanism.chain.index(link)])


def _with_letters(scene: SpatialScene, shapes: list[Shape], poses: Reals | None, lang: str) -> list[Shape]:
    """The letter of each joint beside it, in the alphabet of the language."""
    chain = scene.linkage.mechanism.chain
    alphabet = Alphabet.of_language(lang)
    written = list(shapes)
    for joint, place in zip(chain.joints, scene.joints, strict=True):
        at = points_on_paper(scene.placed(place[None], _pose(scene, poses, joint.links[-1])))[0]
        written.append(note_near(at, joint.pair.symbol(alphabet).replace("_", " "), "letter", written))
    return written


def _with_names(
    scene: SpatialScene, shapes: list[Shape], poses: Reals | None, names: Mapping[str, str] | None
) -> list[Shape]:
    outlines = {
        link: points_on_paper(scene.placed(scene.beside(link), _pose(scene, poses, link)))
        for link, corners in scene.outlines.items()
        if len(corners) > 1
    }
    closed = {link: len(scene.outlines[link]) > 2 for link in outlines}
    frame, arc = scene.linkage.mechanism.frame, scene.frame_arc
    if len(arc) and len((names or {}).get(frame, "")) == 1:  # the letter of a length stands beside it
        line = points_on_paper(scene.placed(arc, _pose(scene, poses, frame)))
        shapes = [Polylines((tuple(line),), "measure"), *shapes]
        outlines[frame], closed[frame] = line[len(line) // 2 - 2 : len(line) // 2 + 3], False
    return labels_or_numbers(outlines, closed, shapes, names)
