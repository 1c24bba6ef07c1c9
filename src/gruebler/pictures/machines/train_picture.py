"""Pictures of gear trains: wheels by their pitch circles or with teeth, planets on their carriers, racks, belts, ropes.

Directions, distances of belts and places of stages, which a train does not define, are chosen: docs/theory/drawing.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TypedDict

from gruebler.base.text import number, number_separator, translate
from gruebler.machines.gears import Train
from gruebler.machines.gears.messages import fraction_text
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.moving_picture import (
    Body,
    Clock,
    MovingPicture,
    Shift,
    always,
    at_time,
    moving,
    still_picture,
)
from gruebler.pictures.canvas.shapes import Point, Shape, TextShape, bounds
from gruebler.pictures.machines.bevel_views import bevel_shapes
from gruebler.pictures.machines.train_layout import GearStage, gear_stages
from gruebler.pictures.machines.train_motion import TrainMotion, train_motion
from gruebler.pictures.machines.train_shapes import PaintOptions, stage_bodies

_SIZE = Point(640.0, 360.0)
_LARGEST = 9.0  # pixels to a unit of pitch diameter 2, so that few teeth do not fill the picture
_GAP = 46.0  # between stages
_ROW = 17.0


class TrainPictureOptions(TypedDict, total=False):
    """The common options of pictures and moving pictures of a train."""

    planets: Mapping[str, int]
    teeth: bool
    lang: str
    name: str


def draw_train(
    train: Train, *, planets: Mapping[str, int] | None = None, teeth: bool = False, lang: str = "en", name: str = ""
) -> Figure:
    """A gear train in the reference pose, to scale by its tooth numbers or radii.

    Options as for `gruebler.draw`.

    >>> from gruebler.machines.gears import read_train
    >>> figure = draw_train(read_train("sun:24 planet:18 ring:-60 on arm").train, planets={"planet": 3})
    >>> figure.title, len(figure.svg()) < 12_000
    ('Gear train', True)
    """
    shown = gear_stages(train, planets or {})
    return still_picture(
        _bodies(shown, None, teeth, lang), name or translate("Gear train", lang), _about(train, shown, lang)
    )


def animate_train(
    train: Train,
    drives: Mapping[str, object] | None = None,
    *,
    planets: Mapping[str, int] | None = None,
    teeth: bool = False,
    seconds: float = 4.0,
    most: int = 100,
    lang: str = "en",
    name: str = "",
) -> MovingPicture:
    """A gear train that moves with its exact ratios until every link has its initial position, repeated without end.

    Options as for `gruebler.animate`; without ``drives`` links that determine all others are chosen, the first turning
    and the others held. A cycle of more than ``most`` turns of the fastest link ends after whole turns of the drive.

    Raises `gruebler.GearError` if the drives do not determine all speeds, or nothing moves,
    `gruebler.GrueblerError` for a time that is no positive number of seconds.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> animate_train(train, {"sun": 7, "ring": 0}).page.description.partition("everything ")[2]
    'repeats: sun 21, planet -14, arm 6, ring 0.'
    """
    shown = gear_stages(train, planets or {})
    motion = train_motion(train, drives or {}, always(seconds), most)
    sentences = [_about(train, shown, lang, still=False), _cycle(motion, lang)]
    if motion.chosen:
        sentences.insert(1, translate("Driven: {links}.", lang, links=", ".join(motion.chosen)))
    clock = Clock(
        seconds=motion.seconds, low=0.0, high=360.0 * float(motion.drive_turns), unit="°", round=not motion.slides
    )
    return moving(
        _bodies(shown, motion, teeth, lang), clock, name or translate("Gear train", lang), " ".join(sentences)
    )


def _about(train: Train, shown: list[GearStage], lang: str, *, still: bool = True) -> str:
    sentences = [
        translate(
            "A gear train with {links} moving links, to scale by tooth numbers or radii; directions are chosen.",
            lang,
            links=len(train.links),
        )
    ]
    bevel = [stage for stage in shown if stage.is_bevel]
    in_views = [stage for stage in bevel if still and bevel_shapes(stage)]
    if in_views:
        sentences.append(
            translate(
                "Bevel wheels from the side, and along the axis of the central wheels without the near one; their axes "
                "are drawn at right angles.",
                lang,
            )
        )
    if len(in_views) < len(bevel):
        sentences.append(translate("Bevel wheels are unfolded into the plane, as their carrier sees them.", lang))
    return " ".join(sentences)


def _cycle(motion: TrainMotion, lang: str) -> str:
    """The turns of the links in the shown time."""

    def turns(link: str, time: Fraction) -> str:
        if link in motion.slides:
            return translate("{link} moves", lang, link=link)
        return f"{link} {fraction_text(motion.rates[link] * time, lang)}"

    shown = ", ".join(turns(link, motion.time) for link in motion.rates)
    if motion.slides:
        return translate("Turns to and fro: {turns}.", lang, turns=shown)
    if motion.time != motion.cycle:
        whole = fraction_text(abs(motion.rates[motion.drive]) * motion.cycle, lang)
        return translate(
            "It repeats only after {whole} turns of {link}; turns shown: {turns}.",
            lang,
            whole=whole,
            link=motion.drive,
            turns=shown,
        )
    return translate("Turns until everything repeats: {turns}.", lang, turns=shown)


def _bodies(shown: list[GearStage], motion: TrainMotion | None, teeth: bool, lang: str) -> list[Body]:
    """All stages side by side, each with the list of its links beneath."""
    views = [_views(stage, motion) for stage in shown]
    plain = [
        stage_bodies(stage, PaintOptions(1.0, False), None)
        for stage, view in zip(shown, views, strict=True)
        if not view
    ]
    sizes = [bounds(at_time(part, 0.0), 0.0)[1] for part in plain] or [_SIZE]
    wide, high = sum(size.x for size in sizes), max(size.y for size in sizes)
    scale = min(_SIZE.x / wide, _SIZE.y / high, _LARGEST)
    left, all_bodies = 0.0, []
    for stage, view in zip(shown, views, strict=True):
        bodies = view or stage_bodies(stage, PaintOptions(scale, teeth), motion)
        corner, size = bounds(at_time(bodies, 0.0), 0.0)
        shift = Point(left - corner.x, -(corner.y + size.y / 2))
        texts = _listed(stage, Point(left, size.y / 2 + 22.0), lang)
        all_bodies += [Body(body.shapes, (Shift((shift,)), *body.steps)) for body in bodies]
        all_bodies.append(Body(tuple(texts)))
        text = bounds(texts, 0.0)[1].x
        left += max(size.x, text) + _GAP
    return all_bodies


def _views(stage: GearStage, motion: TrainMotion | None) -> list[Body]:
    """Bevel wheels that stand still, in two views; empty for all others."""
    views = bevel_shapes(stage) if stage.is_bevel and motion is None else None
    return [Body(tuple(views))] if views else []


def _listed(stage: GearStage, at: Point, lang: str) -> list[Shape]:
    """The links of a stage with their sizes."""
    sizes: dict[str, list[str]] = {}
    for wheel in stage.wheels:
        size = number(wheel.size, lang, "g").replace("-", "−")
        link_sizes = sizes.setdefault(wheel.link, [])
        if size not in link_sizes:
            link_sizes.append(size)
    several = {wheel.link for wheel in stage.wheels if wheel.planet and stage.copies > 1}
    rows = [
        f"{link}: {number_separator(lang).join(wheels)}{f' × {stage.copies}' if link in several else ''}"
        for link, wheels in sizes.items()
    ]
    others = [
        link
        for mesh in stage.meshes
        for link in (mesh.a, mesh.b, mesh.carrier)
        if link not in sizes and link != "frame"
    ]
    rows += list(dict.fromkeys(others))
    return [TextShape(at.plus(Point(0.0, _ROW * k)), text, "value", "start") for k, text in enumerate(rows)]
