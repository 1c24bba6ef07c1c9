"""Columns of `gruebler analyse --poles --curvature`: instant centres, curvature of paths, inflection circles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import pi

import numpy as np

from gruebler.arrays import Complexes, Reals
from gruebler.cli.point_inputs import point_name
from gruebler.columns import Column
from gruebler.geometry import inflection_circle, path_curvature, poles
from gruebler.kinematics import Motion
from gruebler.linkages import Linkage, LinkPoint

__all__ = ["curvature_columns", "pole_columns", "pole_list"]

_WORDS = {
    "en": {
        "pole": "pole",
        "far": "at infinity, direction {angle:.6g}°",
        "none": "none: at rest against one another",
        "towards": "direction",
        "radius": "radius of curvature",
        "centre": "centre of curvature",
        "diameter": "inflection circle",
        "pair": "links",
    },
    "de": {
        "pole": "Pol",
        "far": "im Unendlichen, Richtung {angle:.6g}°",
        "none": "keiner: gegeneinander in Ruhe",
        "towards": "Richtung",
        "radius": "Krümmungsradius",
        "centre": "Krümmungsmittelpunkt",
        "diameter": "Wendekreisdurchmesser",
        "pair": "Glieder",
    },
}


def pole_columns(motion: Motion, lang: str = "en") -> list[Column]:
    """The pole of each pair of links (x, y), and its direction if it lies at infinity in some row."""
    found, words, unit = poles(motion, motion.linkage.mechanism.chain.links), _WORDS[lang], motion.linkage.unit
    out = []
    for one, other in combinations(found.links, 2):
        name, at, towards = f"{words['pole']} {one}/{other}", found.of(one, other), found.towards(one, other)
        known = np.isfinite(at)
        out += [
            Column(f"{name} {axis}", unit, np.where(known, v, np.nan)) for axis, v in zip("xy", _parts(at), strict=True)
        ]
        if np.isfinite(towards).any():
            out.append(Column(f"{name} {words['towards']}", "°", np.degrees(np.angle(towards)) % 180))
    return out


def pole_list(motion: Motion, row: int, lang: str = "en") -> tuple[list[str], list[list[str]]]:
    """Headers and rows of a table of all poles at one row."""
    found, words, unit = poles(motion, motion.linkage.mechanism.chain.links), _WORDS[lang], motion.linkage.unit
    rows = []
    for one, other in combinations(found.links, 2):
        at, towards = found.of(one, other)[row], found.towards(one, other)[row]
        if np.isfinite(at):
            said = ", ".join(f"{value:.6f}" for value in (at.real + 0.0, at.imag + 0.0))
        elif np.isfinite(towards):
            said = words["far"].format(angle=round(np.angle(towards) * 180 / pi % 180, 9) % 180)
        else:
            said = words["none"]
        rows.append([f"{one}/{other}", said])
    return [words["pair"], f"{words['pole']} [{unit}]"], rows


def curvature_columns(
    motion: Motion, points: Sequence[str | LinkPoint], links: Iterable[str] = (), lang: str = "en"
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
    linkage, words = motion.linkage, _WORDS[lang]
    out = []
    frame, moving = linkage.mechanism.frame, list[str]()
    for point in points:
        path, name = path_curvature(motion, point), point_name(point)
        out.append(Column(f"{name} {words['radius']}", linkage.unit, path.radius))
        for axis, values in zip("xy", _parts(path.centre), strict=True):
            known = np.isfinite(path.radius)
            out.append(Column(f"{name} {words['centre']} {axis}", linkage.unit, np.where(known, values, np.nan)))
        places = [point] if isinstance(point, LinkPoint) else reversed(linkage.points_named(point))
        moving.append(next(place.link for place in places if place.link != frame))
    moving += [link for link in links if not _pivoted(linkage, link)]
    for link in dict.fromkeys([*moving, *_floating(linkage)]):
        diameter = inflection_circle(motion, link).diameter
        if np.isfinite(diameter).any():
            out.append(Column(f"{words['diameter']} {link}", linkage.unit, diameter))
    return out


def _floating(linkage: Linkage) -> list[str]:
    """The links that have no joint with the frame."""
    frame, chain = linkage.mechanism.frame, linkage.mechanism.chain
    held = {link for joint in chain.joints if frame in joint.links for link in joint.links}
    return [link for link in chain.links if link not in held]


def _pivoted(linkage: Linkage, link: str) -> bool:
    """Whether a link is the frame, or turns about a point of it."""
    frame, joints = linkage.mechanism.frame, linkage.mechanism.chain.joints
    return link == frame or any(j.pair.name == "revolute" and {link, frame} <= set(j.links) for j in joints)


def _parts(values: Complexes) -> tuple[Reals, Reals]:
    return values.real, values.imag
