"""Grashof's condition where two links of a four-bar have become endless: two lengths and an eccentricity."""

from __future__ import annotations

from collections.abc import Collection

from gruebler.base.text import joined, message, number, number_separator, translate
from gruebler.mechanics.fourbar.four_bar_types import NOT_ASSEMBLABLE, SINGLE_POSITION, LinkageType

_CLOSE = 1e-12

# By the relation of l_min + |e| to l_max, and by the links that are the shorter.
SLIDER_CRANK_TYPES = {
    ("<", "a"): LinkageType("slider_crank", message("slider-crank")),
    ("<", "b"): LinkageType("slider_rocker_turning_coupler", message("slider-rocker with turning coupler")),
    ("=", "a"): LinkageType("change_point_slider_crank", message("change-point slider-crank")),
    ("=", "b"): LinkageType("change_point_slider_rocker", message("change-point slider-rocker")),
    ("=", "ab"): LinkageType("isosceles_slider_crank", message("isosceles slider-crank")),
    (">", ""): LinkageType("slider_rocker", message("slider-rocker (no link turns fully)")),
    ("rigid", ""): SINGLE_POSITION,
    ("open", ""): NOT_ASSEMBLABLE,
}
INVERTED_SLIDER_CRANK_TYPES = {
    ("<", "a"): LinkageType("swinging_guide", message("inverted slider-crank with swinging guide")),
    ("<", "d"): LinkageType("turning_guide", message("inverted slider-crank with turning guide")),
    ("=", "a"): LinkageType(
        "change_point_swinging_guide", message("change-point inverted slider-crank with swinging guide")
    ),
    ("=", "d"): LinkageType(
        "change_point_turning_guide", message("change-point inverted slider-crank with turning guide")
    ),
    ("=", "ad"): LinkageType("isosceles_guide", message("isosceles inverted slider-crank")),
    (">", ""): LinkageType("rocking_guide", message("inverted slider-crank (no link turns fully)")),
    ("rigid", ""): SINGLE_POSITION,
    ("open", ""): NOT_ASSEMBLABLE,
}


def offset_sentence(kind: LinkageType, turning: Collection[str], lang: str = "en", **lengths: float) -> str:
    """The lengths, the type and the links that turn fully.

    >>> offset_sentence(SLIDER_CRANK_TYPES["<", "a"], ["a"], a=20, b=50, e=0)
    'a = 20, b = 50, e = 0: slider-crank. Turns fully against the frame: a.'
    """
    sizes = number_separator(lang).join(f"{name} = {number(value, lang, 'n')}" for name, value in lengths.items())
    links = joined(turning)
    about = translate("Turns fully against the frame: {links}.", lang, links=links) if turning else ""
    return f"{sizes}: {kind.name(lang)}. {about}".rstrip()


def offset_relation(e: float, **lengths: float) -> tuple[str, str]:
    """The relation of l_min + |e| to l_max, and the links that go round fully by it.

    >>> offset_relation(1, a=3, b=5), offset_relation(-1, a=5, b=4.5), offset_relation(0, a=2, d=2)
    (('<', 'a'), ('>', ''), ('=', 'ad'))
    """
    (shorter, low), (_, high) = sorted(lengths.items(), key=lambda item: item[1])
    close = _CLOSE * max(high, abs(e))
    excess = abs(e) - (high - low)
    beyond = abs(e) - (high + low)
    if beyond >= -close:
        return ("open" if beyond > close else "rigid"), ""
    if excess > close:
        return ">", ""
    if excess < -close:
        return "<", shorter
    return "=", "".join(lengths) if high - low <= close else shorter
