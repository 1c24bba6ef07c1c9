"""Columns of a table of a motion: instant centres, curvature of paths, inflection circles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import pi

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.columns import Column
from gruebler.base.text import numbers, translate
from gruebler.mechanics.geometry.curvature import inflection_circle, path_curvature
from gruebler.mechanics.geometry.instant_centres import poles
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.points import PointLike, point_name


def pole_columns(motion: Motion, lang: str = "en") -> list[Column]:
    """The pole of each pair of links (x, y), and its direction if it lies at infinity in some row."""
    centres, unit = poles(motion, motion.linkage.mechanism.chain.links), motion.linkage.unit
    columns = []
    for first, second in combinations(centres.links, 2):
        name = translate("pole {links}", lang, links=f"{first}/{second}")
        at, towards = centres.of(first, second), centres.towards(first, second)
        columns += _place_columns(name, unit, at)
        if np.isfinite(towards).any():
            direction = translate("{name} direction", lang, name=name)
            columns.append(Column(direction, unit="°", values=np.degrees(np.angle(towards)) % 180))
    return columns


def pole_list(motion: Motion, row: int, lang: str = "en") -> tuple[list[str], list[list[str]]]:
    """Headers and rows of a table of all poles at one row."""
    centres, unit = poles(motion, motion.linkage.mechanism.chain.links), motion.linkage.unit
    rows = []
    for first, second in combinations(centres.links, 2):
        at, towards = centres.of(first, second)[row], centres.towards(first, second)[row]
        if np.isfinite(at):
            place = numbers((at.real, at.imag), lang, "z.6f")
        elif np.isfinite(towards):
            angle = round(np.angle(towards) * 180 / pi % 180, 9) % 180
            place = translate("at infinity, direction {angle:n}°", lang, angle=angle)
        else:
            place = translate("none: no relative motion", lang)
        rows.append([f"{first}/{second}", place])
    return [translate("links", lang), translate("pole [{unit}]", lang, unit=unit)], rows


def curvature_columns(
    motion: Motion, points: Sequence[PointLike], links: Iterable[str] = (), lang: str = "en"
) -> list[Column]:
    """Signed radius and centre of curvature of the points' paths; diameters of inflection circles.

    These are of the points' links, the further links and all floating links: those without a joint with the frame. A
    link that only translates has no inflection circle and no column, nor has a further link that turns about a pivot.

    Args:
        motion: solved to the second order.
        points: names of points or joints that move, or points of links.
        links: further links whose inflection circle is asked for.
        lang: of the names of columns.
    """
    linkage, columns = motion.linkage, list[Column]()
    frame, moving = linkage.mechanism.frame, list[str]()
    for point in points:
        path, name = path_curvature(motion, point), point_name(point)
        columns.append(
            Column(translate("{point} radius of curvature", lang, point=name), unit=linkage.unit, values=path.radius)
        )
        centre = np.where(np.isfinite(path.radius), path.centre, np.nan)
        columns += _place_columns(translate("{point} centre of curvature", lang, point=name), linkage.unit, centre)
        places = reversed(linkage.points_named(point))
        moving.append(next(place.link for place in places if place.link != frame))
    moving += [link for link in links if not _pivoted(linkage, link)]
    for link in dict.fromkeys([*moving, *_floating(linkage)]):
        diameter = inflection_circle(motion, link).diameter
        if np.isfinite(diameter).any():
            columns.append(
                Column(translate("inflection circle {link}", lang, link=link), unit=linkage.unit, values=diameter)
            )
    return columns


def _place_columns(name: str, unit: str, places: Complexes) -> list[Column]:
    known = np.isfinite(places)
    parts = (("x", places.real), ("y", places.imag))
    return [Column(f"{name} {axis}", unit=unit, values=np.where(known, values, np.nan)) for axis, values in parts]


def _floating(linkage: Linkage) -> list[str]:
    """The links that have no joint with the frame."""
    frame, chain = linkage.mechanism.frame, linkage.mechanism.chain
    held = {link for joint in chain.joints if frame in joint.links for link in joint.links}
    return [link for link in chain.links if link not in held]


def _pivoted(linkage: Linkage, link: str) -> bool:
    """Whether a link is the frame, or turns about a point of it."""
    frame, joints = linkage.mechanism.frame, linkage.mechanism.chain.joints
    return link == frame or any(j.pair.is_turning and {link, frame} <= set(j.links) for j in joints)
