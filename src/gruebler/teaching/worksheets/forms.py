"""The forms of four links on one page: named by Grashof's condition, each drawn to scale (figures 2.4 and 3.6)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import astuple, fields

from gruebler.base.text import Message, joined, message, translate
from gruebler.mechanics.fourbar import (
    FOUR_BAR_TYPES,
    INVERTED_SLIDER_CRANK_TYPES,
    SLIDER_CRANK_TYPES,
    FourBar,
    InvertedSliderCrank,
    SizedInversion,
    SliderCrank,
    double_slide_inversions,
    sized_inversions,
)
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.teaching.exercises import smallest_lengths

_KINDS = {
    FourBar: FOUR_BAR_TYPES,
    SliderCrank: SLIDER_CRANK_TYPES,
    InvertedSliderCrank: INVERTED_SLIDER_CRANK_TYPES,
}
_OTHER_END = str.maketrans("ac", "ca")  # a four-bar driven at its other end is the same form


def four_bar_forms(lang: str) -> tuple[Section, ...]:
    """The four mechanisms of one chain whose shortest link turns fully, the change points, and what turns nowhere.

    >>> [len(section.items) for section in four_bar_forms("en")]
    [4, 10, 1]
    """
    turning = message("Four-bar, l_min + l_max < l' + l'': the shortest link turns fully; a, b, c, d = 2, 5, 4, 5")
    change = message("Four-bar, l_min + l_max = l' + l'': change points")
    none = message("Four-bar, l_min + l_max > l' + l'': no link turns fully")
    return (
        Section(turning.in_language(lang), tuple(_inversions(sized_inversions(FourBar(2, 5, 4, 5)), lang))),
        Section(change.in_language(lang), tuple(_forms("=", [FourBar], lang))),
        Section(none.in_language(lang), tuple(_forms(">", [FourBar], lang))),
    )


def slider_forms(lang: str) -> tuple[Section, ...]:
    """The same of the chain with one slide, and the mechanisms of the chain with two."""
    kinds: tuple[type[ClosedForm], ...] = (SliderCrank, InvertedSliderCrank)
    turning = message("One slide, l_min + |e| < l_max: the shorter link turns fully; a, b, e = 2, 5, 0")
    change = message("One slide, l_min + |e| = l_max: change points")
    none = message("One slide, l_min + |e| > l_max: no link turns fully")
    return (
        Section(turning.in_language(lang), tuple(_inversions(sized_inversions(SliderCrank(2, 5)), lang))),
        Section(change.in_language(lang), tuple(_forms("=", kinds, lang))),
        Section(none.in_language(lang), tuple(_forms(">", kinds, lang))),
        Section(translate("Two slides", lang), tuple(_inversions(double_slide_inversions(4), lang))),
    )


def _inversions(mechanisms: Iterable[SizedInversion], lang: str) -> Iterator[Item]:
    """The mechanism of each frame, with the first of its drives."""
    for frame, inversion in {each.frame: each for each in reversed(tuple(mechanisms))}.items():
        caption = message("frame {frame}: {name}", frame=frame, name=inversion.type)
        yield _item(inversion.linkage, caption, lang)


def _forms(relation: str, kinds: Iterable[type[ClosedForm]], lang: str) -> Iterator[Item]:
    """The forms of some kinds with smallest whole lengths, those that fold in both positions."""
    for kind in kinds:
        sizes, seen = smallest_lengths(kind), set()
        for (condition, place), form in _KINDS[kind].items():
            turned = "".join(sorted(place.translate(_OTHER_END)))
            if condition != relation or turned in seen:
                continue
            seen.add(place)
            size = sizes[form.key]
            lengths = ",\N{NO-BREAK SPACE}".join(f"{value:g}" for value in astuple(size))
            letters = ", ".join(field.name for field in fields(size))
            for branch in ("+", "-") if place in ("ac", "bd") else (None,):
                yield _item(
                    size.linkage(),
                    joined([form.title, f"{letters}\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}{lengths}"], ": "),
                    lang,
                    branch,
                )


def _item(linkage: Linkage, caption: Message, lang: str, branch: str | None = None) -> Item:
    name = caption.in_language(lang)
    return Item(draw_linkage(linkage, branch=branch, lang=lang, name=name), name)
