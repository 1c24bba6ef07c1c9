"""Lengths and a coupler point as a user writes them: 25,70,40,70 45,40."""

from __future__ import annotations

from collections.abc import Callable

from gruebler.cli.parser import Parser
from gruebler.errors import GrueblerError, nearest
from gruebler.fourbar import FourBar, InvertedSliderCrank, SliderCrank

__all__ = ["add_coupler_point", "coupler_point", "numbers", "sizes"]

_KINDS: dict[str, tuple[Callable[..., FourBar | SliderCrank | InvertedSliderCrank], str, tuple[int, ...]]] = {
    "four-bar": (FourBar, "A,B,C,D", (4,)),
    "slider-crank": (SliderCrank, "A,B[,E]", (2, 3)),
    "inverted-slider-crank": (InvertedSliderCrank, "A,D[,E]", (2, 3)),
}


def add_coupler_point(command: Parser) -> None:
    """Arguments for a coupler point of a linkage given by its lengths."""
    command.add_argument("lengths", metavar="A,B,C,D", help="a four-bar; or slider-crank:A,B[,E]")
    command.add_argument("point", metavar="U,V", help="the coupler point: U along the coupler, V to its left")
    command.add_argument("--branch", type=int, choices=(1, -1), default=1, help="assembly branch (default: 1)")


def sizes(word: str) -> FourBar | SliderCrank | InvertedSliderCrank:
    """The linkage of four lengths, or of a kind and its lengths.

    >>> sizes("25,70,40,70"), sizes("slider-crank:25,70")
    (FourBar(a=25.0, b=70.0, c=40.0, d=70.0), SliderCrank(a=25.0, b=70.0, e=0.0))
    """
    kind, colon, lengths = word.rpartition(":")
    if colon and kind not in _KINDS:
        raise GrueblerError(
            "{word!r}: expected one of {kinds} before the colon{suggestion}",
            word=word,
            kinds=", ".join(_KINDS),
            suggestion=nearest(kind, _KINDS),
        )
    make, names, counts = _KINDS[kind or "four-bar"]
    given = numbers(lengths, names)
    if len(given) not in counts:
        raise GrueblerError(
            "expected the lengths {names}, but found {count} numbers in {lengths!r}",
            names=names,
            count=len(given),
            lengths=lengths,
        )
    return make(*given)


def coupler_point(text: str) -> tuple[float, float]:
    """The coupler point U,V."""
    given = numbers(text, "U,V")
    if len(given) != 2:
        raise GrueblerError(
            "expected the coupler point U,V, but found {count} numbers in {text_!r}", count=len(given), text_=text
        )
    return given[0], given[1]


def numbers(text: str, names: str) -> list[float]:
    """Numbers between commas."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise GrueblerError("expected numbers {names}, but found {text_!r}", names=names, text_=text) from None
