"""Posters of the systematics: chains by assortment, inversions, forms, Assur groups, kinds of joints."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby

from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import translate
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.structure import draw_structure
from gruebler.pictures.structure.messages import chain_name
from gruebler.structure.assur import AssurGroup, assur_groups
from gruebler.structure.assur.forms import form_message
from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration import chains
from gruebler.structure.mechanism.inversion import family, inversions
from gruebler.teaching.worksheets.forms import four_bar_forms, slider_forms
from gruebler.teaching.worksheets.joint_pictures import joint_pictures

_MOST = {"chains": 10, "inversions": 8, "assur": 8}
_USUAL = {"chains": 8, "inversions": 6, "assur": 6}


def poster(name: str, links: int | None = None, lang: str = "en") -> tuple[str, tuple[Section, ...]]:
    """Title and sections: ``chains``, ``inversions``, ``assur`` (up to so many links), ``forms`` or ``joints``.

    Cost: 20 ms a picture. Raises `GrueblerError` for another name, and for more links than fit on a poster.

    >>> title, sections = poster("chains", 6)
    >>> [len(section.items) for section in sections]
    [1, 2]
    """
    if name not in POSTERS:
        raise GrueblerError("there is no poster {word!r}{suggestion}; there are {known}", **unknown(name, POSTERS))
    if name not in _MOST:
        if links is not None:
            raise GrueblerError("the poster {name} has no number of links", name=name)
        return POSTERS[name](0, lang)
    count = _USUAL[name] if links is None else links
    if not 2 <= count <= _MOST[name]:
        raise GrueblerError(
            "the poster {name} shows up to {most} links, not {links}", name=name, most=_MOST[name], links=count
        )
    return POSTERS[name](count, lang)


def _chains(links: int, lang: str) -> tuple[str, tuple[Section, ...]]:
    sections = []
    for count in range(4, links + 1, 2):
        ranked = sorted(chains(count, 1), key=lambda chain: [-k for k in chain.assortment])
        number = 0
        for assortment, group in groupby(ranked, key=lambda chain: chain.assortment):
            items = []
            for chain in group:
                number += 1
                name = chain_name(chain, lang)
                items.append(Item(draw_structure(chain, lang=lang), f"{count}.{number} {name}".strip()))
            heading = translate(
                "{count} links; binary, ternary, ...: {assortment}",
                lang,
                count=count,
                assortment=", ".join(map(str, assortment)),
            )
            sections.append(Section(heading, tuple(items)))
    return translate("Kinematic chains with F = 1 up to {links} links", lang, links=links), tuple(sections)


def _forms(_: int, lang: str) -> tuple[str, tuple[Section, ...]]:
    return translate("Forms of four-bars and slider-cranks", lang), (*four_bar_forms(lang), *slider_forms(lang))


def _inversions(links: int, lang: str) -> tuple[str, tuple[Section, ...]]:
    sections = list(four_bar_forms(lang)) if links >= 4 else []
    for count in range(6, links + 1, 2):
        for number, chain in enumerate(chains(count, 1), 1):
            items = [
                Item(
                    draw_structure(mechanism, lang=lang),
                    f"{count}.{number}.{k} {family(mechanism, lang) or ''}".strip(),
                )
                for k, mechanism in enumerate(inversions(chain), 1)
            ]
            heading = translate("{count} links, chain {number}", lang, count=count, number=number)
            sections.append(Section(heading, tuple(items)))
    return translate("Mechanisms by inversion, up to {links} links", lang, links=links), tuple(sections)


def _assur(links: int, lang: str) -> tuple[str, tuple[Section, ...]]:
    sections = []
    for count in range(2, links + 1, 2):
        items = [
            Item(draw_structure(group.chain, lang=lang), f"{count}.{k} {_group_name(group, lang)}")
            for k, group in enumerate(assur_groups(count), 1)
        ]
        sections.append(Section(translate("{count} links", lang, count=count), tuple(items)))
    return translate("Assur groups up to {links} links", lang, links=links), tuple(sections)


def _group_name(group: AssurGroup, lang: str) -> str:
    """Its form, if that has a short name, else class and order."""
    if "(" not in group.form:
        return form_message(group.form).in_language(lang)
    return translate("class {number}, order {order}", lang, number=group.class_number, order=group.order)


def _joints(_: int, lang: str) -> tuple[str, tuple[Section, ...]]:
    sections = []
    for freedoms, group in groupby(joint_pictures(lang), key=lambda pair: pair[0].f(Space.SPATIAL)):
        items = tuple(Item(figure, pair.full_name(lang).replace("_", " ")) for pair, figure in group)
        sections.append(Section(f"f = {freedoms}", items))
    return translate("Joints by their degree of freedom f", lang), tuple(sections)


POSTERS: dict[str, Callable[[int, str], tuple[str, tuple[Section, ...]]]] = {
    "chains": _chains,
    "forms": _forms,
    "inversions": _inversions,
    "assur": _assur,
    "joints": _joints,
}
"""The posters by name."""
