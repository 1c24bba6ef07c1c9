"""A point as a user writes it: its name, a joint, LINK:X,Y, or X,Y on the coupler."""

from __future__ import annotations

import math
import re

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.linkages import LinkPoint

_NUMBERS = re.compile(r"[-+.\deE]+,[-+.\deE]+")


def point_of(text: str) -> str | LinkPoint:
    """A name as it is, or a point of a link in its coordinates; two numbers alone are a point of the link `coupler`.

    >>> point_of("coupler:45,40"), point_of("45,40"), point_of("R(0-1)")
    (LinkPoint(link='coupler', x=45.0, y=40.0), LinkPoint(link='coupler', x=45.0, y=40.0), 'R(0-1)')
    """
    link, colon, place = text.rpartition(":")
    if _NUMBERS.fullmatch(text):
        link, place = "coupler", text
    elif not colon or "(" in place:
        return text
    try:
        x, y = (float(part) for part in place.split(","))
    except ValueError:
        raise GrueblerError(
            "expected a point LINK:X,Y such as coupler:45,40, but found {found!r}", found=text
        ) from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise GrueblerError("a point has finite coordinates, but found {found!r}", found=text)
    return LinkPoint(link, x, y)
