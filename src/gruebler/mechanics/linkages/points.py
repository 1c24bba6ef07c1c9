"""A point as a user gives it, found in a linkage: the one place where the forms of a point are known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from numbers import Real
from typing import Annotated, Protocol

import numpy as np

from gruebler.base.errors import LinkageError, unknown
from gruebler.mechanics.linkages.elements import Element, LinkPoint
from gruebler.structure.chain.pairs import in_alphabets
from gruebler.structure.mechanism import Mechanism

PointLike = Annotated[str | LinkPoint | tuple[str, float, float] | tuple[float, float], "checked by points_of"]
"""A name of a point or joint, ``LINK:X,Y`` or ``X,Y`` as a text, ``(link, x, y)``, or ``(x, y)`` on the coupler."""
_COUPLER = "coupler"


class Dimensioned(Protocol):
    """What has points: a `Linkage`."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""

    @property
    def elements(self) -> Mapping[tuple[int, str], Element]:
        """What each joint is on each of its links."""

    @property
    def points(self) -> Mapping[str, LinkPoint]:
        """The named points."""


def points_of(linkage: Dimensioned, point: PointLike) -> tuple[LinkPoint, ...]:
    """The point of a linkage: of a named point or a place one, of a joint one on each of its links, the frame's first.

    Raises `LinkageError` for what names no point, with the nearest name that does.
    """
    chain = linkage.mechanism.chain
    if isinstance(point, str):
        if point in linkage.points:
            return (linkage.points[point],)
        number = chain.find_joint(point)
        if number is not None:
            links = sorted(chain.joints[number].links, key=lambda link: link != linkage.mechanism.frame)
            placed = ((link, linkage.elements[number, link]) for link in links)
            return tuple(LinkPoint(link, element.x, element.y) for link, element in placed)
    if isinstance(point, np.ndarray):
        point = tuple(point.tolist())
    match text_as_point(point) if isinstance(point, str) else point:
        case LinkPoint(link, x, y):
            pass
        case (str() as link, Real() as x, Real() as y):
            pass
        case (Real() as x, Real() as y):
            link = _coupler(linkage)
        case str(name):
            known = [*linkage.points, *chain.joint_names()]
            names = in_alphabets(lambda alphabet: ", ".join([*linkage.points, *chain.joint_names(alphabet)]))
            raise LinkageError(
                "there is no point {word!r}{suggestion}; known are {known}", **unknown(name, known) | {"known": names}
            )
        case _:
            raise LinkageError(
                "expected a point: its name, (link, x, y), or (x, y) on the coupler of a four-bar, not {raw}",
                raw=repr(point),
            )
    link_number(link, chain.links)
    if not (isfinite(x) and isfinite(y)):
        raise LinkageError("a point has finite coordinates, not {x}, {y}", x=x, y=y)
    return (LinkPoint(link, float(x), float(y)),)


def link_number(link: str, links: Sequence[str]) -> int:
    """Where a link is among those of a linkage; `LinkageError` offers the nearest name.

    >>> link_number("coupler", ("frame", "crank", "coupler"))
    2
    """
    if link not in links:
        raise LinkageError("there is no link {word!r}{suggestion}; the links are {known}", **unknown(link, links))
    return links.index(link)


def place_of(linkage: Dimensioned, point: PointLike) -> LinkPoint:
    """The point of a linkage, that of a joint on a link that is not the frame."""
    return point if isinstance(point, LinkPoint) else points_of(linkage, point)[-1]


def point_name(point: PointLike) -> str:
    """The text of a point, for messages and columns: its name, or ``LINK:X,Y``.

    >>> point_name("K"), point_name(("coupler", 45, 40)), point_name((45, 40))
    ('K', 'coupler:45,40', '45,40')
    """
    match point:
        case LinkPoint(link, x, y):
            return f"{link}:{x:g},{y:g}"
        case (str() as link, Real() as x, Real() as y):
            return f"{link}:{x:g},{y:g}"
        case (Real(), Real()):
            return f"{point[0]:g},{point[1]:g}"
        case _:
            return point if isinstance(point, str) else repr(point)


def each_point(points: Iterable[PointLike]) -> dict[str, PointLike]:
    """Points by their texts, each once; a text alone is one point."""
    if isinstance(points, str):
        return {points: points}
    if not isinstance(points, Iterable):
        raise LinkageError("expected a list of points, not {raw}", raw=repr(points))
    return {point_name(point): point for point in points}


def text_as_point(text: str) -> str | LinkPoint | tuple[float, float]:
    """A point of a link, as in ``coupler:45,40``, or two numbers alone; another text as it is.

    >>> text_as_point("coupler:45,40"), text_as_point("45,40"), text_as_point("K")
    (LinkPoint(link='coupler', x=45.0, y=40.0), (45.0, 40.0), 'K')
    """
    link, colon, place = text.rpartition(":")
    try:
        x, y = (float(part) for part in place.split(","))
    except ValueError:
        return text
    return LinkPoint(link, x, y) if colon else (x, y)


def _coupler(linkage: Dimensioned) -> str:
    """The link on which two numbers alone lie: ``coupler``, else the only link of four that is not at the frame."""
    mechanism = linkage.mechanism
    links = mechanism.chain.links
    if _COUPLER in links:
        return _COUPLER
    at_frame = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    floating = [link for link in links if link not in at_frame]
    if len(links) != 4 or len(floating) != 1:
        raise LinkageError("(x, y) alone is a point of the coupler of a four-bar; here a point is (link, x, y)")
    return floating[0]
