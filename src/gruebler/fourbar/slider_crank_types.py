"""Grashof's condition where two links of a four-bar have become endless: two lengths and an eccentricity."""

from __future__ import annotations

from gruebler.fourbar.grashof import LinkageType

__all__ = ["INVERTED_SLIDER_CRANK_TYPES", "SLIDER_CRANK_TYPES", "offset_relation"]

_CLOSE = 1e-12

_SINGLE = ("single_position", "stretched: one single position", "gestreckt: nur eine einzige Lage")
_OPEN = ("not_assemblable", "not assemblable", "nicht montierbar")

# By the relation of l_min + |e| to l_max, and by the links that are the shorter.
_SLIDER_CRANKS = {
    ("<", "a"): ("slider_crank", "slider-crank", "Schubkurbel"),
    ("<", "b"): (
        "slider_rocker_turning_coupler",
        "slider-rocker with turning coupler",
        "Schubschwinge mit umlaufender Koppel",
    ),
    ("=", "a"): ("change_point_slider_crank", "change-point slider-crank", "durchschlagende Schubkurbel"),
    ("=", "b"): ("change_point_slider_rocker", "change-point slider-rocker", "durchschlagende Schubschwinge"),
    ("=", "ab"): ("isosceles_slider_crank", "isosceles slider-crank", "gleichschenklige Schubkurbel"),
    (">", ""): (
        "slider_rocker",
        "slider-rocker (no link turns fully)",
        "Schubschwinge (kein Glied umlauffähig)",
    ),
    ("rigid", ""): _SINGLE,
    ("open", ""): _OPEN,
}
_INVERTED = {
    ("<", "a"): ("swinging_guide", "inverted slider-crank with swinging guide", "schwingende Kurbelschleife"),
    ("<", "d"): ("turning_guide", "inverted slider-crank with turning guide", "umlaufende Kurbelschleife"),
    ("=", "a"): (
        "change_point_swinging_guide",
        "change-point inverted slider-crank with swinging guide",
        "durchschlagende schwingende Kurbelschleife",
    ),
    ("=", "d"): (
        "change_point_turning_guide",
        "change-point inverted slider-crank with turning guide",
        "durchschlagende umlaufende Kurbelschleife",
    ),
    ("=", "ad"): ("isosceles_guide", "isosceles inverted slider-crank", "gleichschenklige Kurbelschleife"),
    (">", ""): (
        "rocking_guide",
        "inverted slider-crank (no link turns fully)",
        "Kurbelschleife (kein Glied umlauffähig)",
    ),
    ("rigid", ""): _SINGLE,
    ("open", ""): _OPEN,
}
SLIDER_CRANK_TYPES = {place: LinkageType(*row) for place, row in _SLIDER_CRANKS.items()}
INVERTED_SLIDER_CRANK_TYPES = {place: LinkageType(*row) for place, row in _INVERTED.items()}


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
