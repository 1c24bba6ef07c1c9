"""What a sheet prints of a machine in space: distances and angles on its links, places and axes of its joints."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import number, number_separator, translate
from gruebler.mechanics.screws import JointPlace, SpatialLinkage, freedoms
from gruebler.structure.chain import Joint
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.teaching.worksheets.places import SIZES, written_numbers

_PARALLEL = 1e-9  # sine of the angle between directions that are parallel


class _Place(NamedTuple):
    """A joint or a point on a link."""

    name: str
    at: Reals | None
    """A point of it that the link holds; None of a slide, which has a direction only."""
    along: Reals | None
    """The direction of its axis, of length 1."""


def headers_in_space(lang: str) -> tuple[str, ...]:
    """The heads of the columns of `places_in_space`."""
    return translate("joint or point", lang), "x", "y", "z", translate("axes", lang), translate("sizes", lang)


def places_in_space(linkage: SpatialLinkage, lang: str) -> Iterator[tuple[str, ...]]:
    """A row for each joint and each named point in the reference pose: place, directions of axes, sizes.

    Six digits are enough, except for a linkage with more constraints than it needs, which moves only if they fit.
    """
    chain = linkage.mechanism.chain
    digits = 12 if freedoms(linkage).instant.redundancy else 6
    separator = number_separator(lang)
    for name, joint, place in zip(_names(linkage, lang), chain.joints, linkage.places, strict=True):
        given = {axis: getattr(place, axis) for axis in "xyz"}
        axes = (
            f"{a} = ({separator.join(written_numbers(v, 1.0, lang, digits))})"
            for a, v in given.items()
            if v is not None
        )
        x_y_z = written_numbers(place.at, linkage.size, lang, digits)
        yield name, *x_y_z, ", ".join(axes), separator.join(_sizes(joint, place, chain.space, lang))
    for name, (link, at) in linkage.points.items():
        yield f"{name} ({link})", *written_numbers(at, linkage.size, lang, digits), "", ""


def _names(linkage: SpatialLinkage, lang: str) -> list[str]:
    alphabet = Alphabet.of_language(lang)
    return [f"{joint.pair.symbol(alphabet)} {' / '.join(joint.links)}" for joint in linkage.mechanism.chain.joints]


def _sizes(joint: Joint, place: JointPlace, space: Space, lang: str) -> Iterator[str]:
    """Lead of a screw, radii of a contact, pressure angle; on a sphere radii are angles of cones."""
    if joint.pair.has_pitch:
        yield f"{translate('lead', lang)} {number(math.tau * place.pitch, lang, '.6g')}"
    if place.radii is not None:
        angles = space is Space.SPHERICAL
        radii = (f"{number(math.degrees(r), lang, '.6g')}°" if angles else number(r, lang, ".6g") for r in place.radii)
        yield f"{translate('radii', lang)} {' / '.join(radii)}"
    if place.pressure is not None:
        yield f"{SIZES['pressure_angle'].in_language(lang)} {number(math.degrees(place.pressure), lang, '.6g')}°"


def lengths_in_space(linkage: SpatialLinkage, lang: str) -> Iterator[tuple[str, str, str, str]]:
    """Of every link the distances and angles between its joints, and the distances of its points from them.

    An axis that turns is a line; distances from it are the shortest. Slides have a direction, balls and the crosses of
    universal joints a point.
    """
    chain = linkage.mechanism.chain
    names = _names(linkage, lang)
    spherical = chain.space is Space.SPHERICAL
    for link in chain.links:
        on_link = (_place(linkage, k, names[k]) for k, joint in enumerate(chain.joints) if link in joint.links)
        holds = [each for each in on_link if each is not None]
        points = [_Place(name, np.array(at), None) for name, (of, at) in linkage.points.items() if of == link]
        pairs = [*combinations(holds, 2), *((joint, point) for joint in holds for point in points)]
        for first, second in pairs:
            distance = None if spherical else _distance(first, second)
            angle = _angle(first, second)
            if distance is not None or angle is not None:
                (far,), (turned,) = (
                    written_numbers((distance,), linkage.size, lang),
                    written_numbers((angle,), 1.0, lang),
                )
                yield link, f"{first.name} – {second.name}", far, turned and turned + "°"


def _place(linkage: SpatialLinkage, number: int, name: str) -> _Place | None:
    """Where a joint lies on its links; None where the place wanders on them, as that of a contact does."""
    pair, frame = linkage.mechanism.chain.joints[number].pair, linkage.frames[number]
    turns = [freedom.axis for freedom in pair.motion if freedom.turns]
    slides = {freedom.axis for freedom in pair.motion if freedom.travels}
    if pair.has_contours or pair.has_body_between or (len(turns) > 1 and slides):
        return None
    if len(turns) > 1:
        return _Place(name, frame[:3, 3], None)
    axis = turns[0] if turns else slides.pop() if len(slides) == 1 else "z"  # a plane has its normal
    fixed = bool(turns) and slides <= {axis}
    return _Place(name, frame[:3, 3] if fixed else None, frame[:3, "xyz".index(axis)])


def _distance(first: _Place, second: _Place) -> float | None:
    """The shortest one between points and axes; None where a slide has none."""
    if first.at is None or second.at is None:
        return None
    apart = second.at - first.at
    lines = [each.along for each in (first, second) if each.along is not None]
    if len(lines) == 2:
        across = np.cross(lines[0], lines[1])
        sine = float(np.linalg.norm(across))
        if sine > _PARALLEL:
            return abs(float(apart @ across)) / sine
    for along in lines[:1]:
        apart = apart - (apart @ along) * along
    return float(np.linalg.norm(apart))


def _angle(first: _Place, second: _Place) -> float | None:
    """Between two axes or directions, 0 to 90 degrees."""
    if first.along is None or second.along is None:
        return None
    sine = float(np.linalg.norm(np.cross(first.along, second.along)))
    return math.degrees(math.atan2(sine, abs(float(first.along @ second.along))))
