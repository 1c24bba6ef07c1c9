"""Lengths as texts: four-bar:25,70,40,70."""

from __future__ import annotations

import re
from collections.abc import Callable

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.slider_crank import SliderCrank

_BARE = re.compile(r"[-+.\deE]+(,[-+.\deE]+){3}")

ClosedForm = FourBar | SliderCrank | InvertedSliderCrank
"""A linkage of a few lengths in closed form."""

LENGTH_KINDS: dict[str, tuple[str, int, Callable[..., ClosedForm]]] = {
    "four-bar": ("a,b,c,d", 4, FourBar),
    "slider-crank": ("a,b[,e]", 2, SliderCrank),
    "inverted-slider-crank": ("a,d[,e]", 2, InvertedSliderCrank),
}
LENGTH_FORMS = ", ".join(f"{kind}:{names}" for kind, (names, _, _) in LENGTH_KINDS.items())


def is_lengths(word: str) -> bool:
    """Whether a word gives a kind of linkage and its lengths, or only the lengths of a four-bar."""
    kind, colon, _ = word.partition(":")
    return kind in LENGTH_KINDS if colon else _BARE.fullmatch(word) is not None


def size_of(word: str) -> ClosedForm | None:
    """The linkage of a kind and its lengths, or of the four lengths of a four-bar; None for any other word.

    >>> size_of("slider-crank:25,70"), size_of("25,70,40,70"), size_of("lambda")
    (SliderCrank(a=25.0, b=70.0, e=0.0), FourBar(a=25.0, b=70.0, c=40.0, d=70.0), None)
    """
    if not is_lengths(word):
        return None
    kind, _, text = word.partition(":") if ":" in word else ("", "", word)
    names, least, make = LENGTH_KINDS[kind or "four-bar"]
    most = names.replace("[", "").replace("]", "").count(",") + 1
    try:
        lengths = [float(part) for part in text.split(",")]
    except ValueError:
        raise GrueblerError(
            "{kind}: expected numbers {names}, but found {text!r}", kind=kind, names=names, text=text
        ) from None
    if not least <= len(lengths) <= most:
        raise GrueblerError(
            "{kind}: expected {names}, but found {count} numbers", kind=kind, names=names, count=len(lengths)
        )
    return make(*lengths)
