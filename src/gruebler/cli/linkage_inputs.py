"""What a word stands for: the file of a linkage, an entry of the catalog, or lengths such as four-bar:25,70,40,70."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from gruebler.errors import GrueblerError
from gruebler.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.linkages import Linkage

__all__ = ["linkage_of"]

_DOORS: dict[str, tuple[str, int, Callable[..., FourBar | SliderCrank | InvertedSliderCrank]]] = {
    "four-bar": ("a,b,c,d", 4, FourBar),
    "slider-crank": ("a,b[,e]", 2, SliderCrank),
    "inverted-slider-crank": ("a,d[,e]", 2, InvertedSliderCrank),
}


def linkage_of(word: str) -> tuple[Linkage, tuple[float, float] | None]:
    """The linkage of a word, and the drive values between which a catalog entry shows it.

    >>> linkage_of("slider-crank:25,70")[0].length("coupler", 1, 2)
    70.0
    """
    kind, colon, lengths = word.partition(":")
    if colon and kind in _DOORS:
        return _door(kind, lengths), None
    path = Path(word)
    if path.suffix.lower() in (".toml", ".json") or len(path.parts) > 1 or path.is_file():
        from gruebler.formats.linkages import read_linkage

        return read_linkage(path), None
    if "(" in word:
        raise GrueblerError(
            "{word!r} has no dimensions; give a file, a catalog entry or {forms}", word=word[:40], forms=_forms()
        )
    from gruebler.catalog import entries, entry
    from gruebler.errors import nearest

    if word not in entries() and colon:
        raise GrueblerError(
            "{word!r}: expected {forms}{suggestion}", word=word, forms=_forms(), suggestion=nearest(kind, _DOORS)
        )
    record = entry(word)
    if record.dimensions is None:
        sized = ", ".join(one.id for one in entries().values() if one.dimensions is not None)
        if record.screws is None:
            raise GrueblerError(
                "the catalog entry {word!r} has no dimensions; these have: {sized}", word=word, sized=sized
            )
        raise GrueblerError(
            "the catalog entry {word!r} has the places of its joints in one position, not the sizes of its "
            "links: `gruebler freedoms {word}` says how it moves; sizes have: {sized}",
            word=word,
            sized=sized,
        )
    return record.linkage(), record.dimensions.range


def _door(kind: str, text: str) -> Linkage:
    names, least, make = _DOORS[kind]
    most = names.replace("[", "").replace("]", "").count(",") + 1
    try:
        lengths = [float(part) for part in text.split(",")]
    except ValueError:
        raise GrueblerError(
            "{kind}: expected numbers {names}, but found {text_!r}", kind=kind, names=names, text_=text
        ) from None
    if not least <= len(lengths) <= most:
        raise GrueblerError(
            "{kind}: expected {names}, but found {count} numbers", kind=kind, names=names, count=len(lengths)
        )
    return make(*lengths).linkage()


def _forms() -> str:
    return ", ".join(f"{kind}:{names}" for kind, (names, _, _) in _DOORS.items())
