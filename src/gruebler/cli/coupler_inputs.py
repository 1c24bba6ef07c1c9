"""Linkages given by lengths, with a coupler point and an assembly mode."""

from __future__ import annotations

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import LANGUAGES, translate
from gruebler.cli.linkage_inputs import linkage_of_lengths
from gruebler.cli.point_inputs import point_of
from gruebler.mechanics.fourbar.length_texts import ClosedForm


def coupler_point(size: ClosedForm, text: str) -> tuple[float, float]:
    """The coordinates of a point of the coupler: U along it from the crank, V to its left; links in any language.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> coupler_point(FourBar(25, 70, 40, 70), "45,40"), coupler_point(FourBar(25, 70, 40, 70), "R(coupler-rocker)")
    ((45.0, 40.0), (70.0, 0.0))
    >>> coupler_point(FourBar(25, 70, 40, 70), "Koppel:45,40")
    (45.0, 40.0)
    """
    point = point_of(text)
    for lang in LANGUAGES:
        linkage, coupler = linkage_of_lengths(size, lang), translate("coupler", lang)
        try:
            places = linkage.points_named(point) if isinstance(point, str) else (point,)
        except LinkageError:
            if lang == LANGUAGES[-1]:
                raise
            continue
        for place in places:
            if place.link == coupler:
                return place.x, place.y
    raise GrueblerError("expected a point of the coupler such as coupler:45,40, but found {found!r}", found=text)
