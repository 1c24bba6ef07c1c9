"""`gruebler gallery`: all chains or mechanisms of a request, or machines of the catalog, on one page."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from itertools import groupby
from typing import Any

from gruebler.catalog import entry
from gruebler.chain import Chain
from gruebler.cli.draw import german, subject
from gruebler.cli.inputs import assortment_of
from gruebler.cli.output import write_file
from gruebler.drawing import Item, Section, draw, gallery_html
from gruebler.drawing.files import suffix_of
from gruebler.drawing.prose import chain_name
from gruebler.enumeration import Request, chains
from gruebler.enumeration.estimates import estimate
from gruebler.errors import GrueblerError
from gruebler.inversion import family, inversions
from gruebler.isomorphism import code

__all__ = ["run"]

_MOST = 3000  # chains on a page; a browser still scrolls through them

_WORDS = {
    "en": {
        "title": "Kinematic chains with {n} links, F = {f}",
        "inversions": "Mechanisms with {n} links, F = {f}",
        "catalog": "Machines of the catalog",
        "note": "{chains} chains, {pictures} pictures.",
        "machines": "{pictures} pictures.",
        "section": "Links binary, ternary, ...: {assortment} ({number})",
        "of": "{pictures} of {chains} chains",
        "joints": "; multiple joints: {k}",
    },
    "de": {
        "title": "Kinematische Ketten mit {n} Gliedern, F = {f}",
        "inversions": "Getriebe mit {n} Gliedern, F = {f}",
        "catalog": "Maschinen des Katalogs",
        "note": "{chains} Ketten, {pictures} Bilder.",
        "machines": "{pictures} Bilder.",
        "section": "Glieder binär, ternär, ...: {assortment} ({number})",
        "of": "{pictures} aus {chains} Ketten",
        "joints": "; Mehrfachgelenke: {k}",
    },
}


def run(arguments: argparse.Namespace) -> int:
    """Write the page."""
    suffix = suffix_of(arguments.output, ("html", "pdf"))
    words = _WORDS[arguments.lang]
    if arguments.ids:
        _check(arguments)
        title = words["catalog"]
        sections = [Section("", tuple(_machine(id, arguments) for id in arguments.ids))]
        note = words["machines"].format(pictures=len(arguments.ids))
    elif arguments.links is not None:
        title, note, sections = _request(arguments)
    else:
        raise GrueblerError(
            "say what to show: --links N, or ids of the catalog",
            "sage, was zu zeigen ist: --links N oder Namen des Katalogs",
        )
    if suffix == "html":
        content = gallery_html(title, sections, lang=arguments.lang, note=note).encode("utf-8")
    else:
        from gruebler.drawing.plotting import gallery_pdf

        content = gallery_pdf(title, sections, note=note)
    write_file(arguments.output, content, arguments.lang)
    return 0


_OF_REQUESTS = ("links", "mobility", "fractionated", "assortment", "multiple_joints", "inversions")
_USUAL = {"mobility": 1, "fractionated": "none", "multiple_joints": "0"}


def _check(arguments: argparse.Namespace) -> None:
    """Machines are shown as they are: an option of requests beside them is an error, not ignored."""
    for key in _OF_REQUESTS:
        if getattr(arguments, key) not in (None, False):
            option = f"--{key.replace('_', '-')}"
            raise GrueblerError(
                f"a gallery shows machines of the catalog or the chains of --links, not both: {option} is for chains",
                f"eine Galerie zeigt Maschinen des Katalogs oder die Ketten von --links, nicht beides: {option} gilt "
                "für Ketten",
            )


def _machine(id: str, arguments: argparse.Namespace) -> Item:
    record = entry(id)
    name = record.name.said(arguments.lang)
    names = german(record, arguments.lang)
    figure = draw(subject(id, None, None, []), labels=arguments.labels, lang=arguments.lang, name=name, names=names)
    return Item(figure, name, id)


def _request(arguments: argparse.Namespace) -> tuple[str, str, list[Section]]:
    words = _WORDS[arguments.lang]
    given = {key: getattr(arguments, key) for key in _USUAL}
    usual: dict[str, Any] = _USUAL | {key: value for key, value in given.items() if value is not None}
    mobility = usual.pop("mobility")
    options = usual | {"assortment": assortment_of(arguments.assortment)}
    size = estimate(Request(arguments.links, mobility, **options), "text").chains
    if size > _MOST:
        raise GrueblerError(
            f"{size:,} chains do not fit on a page of {_MOST:,}; choose some with --assortment",
            f"{size:,} Ketten passen nicht auf eine Seite für {_MOST:,}; wähle mit --assortment aus",
        )
    found = list(chains(arguments.links, mobility, **options))
    if not found:
        raise GrueblerError(
            f"there are no such chains with {arguments.links} links and F = {mobility}: nothing to be drawn",
            f"solche Ketten mit {arguments.links} Gliedern und F = {mobility} gibt es nicht: nichts zu zeichnen",
        )
    sections = []
    pictures = 0
    numbered = sorted(enumerate(found, 1), key=lambda one: (len(one[1].multiple_joints), _large_first(one[1])))
    for (joints, _), group in groupby(numbered, key=lambda one: (len(one[1].multiple_joints), _large_first(one[1]))):
        some = list(group)
        assortment = ", ".join(map(str, some[0][1].assortment))
        items = tuple(item for number, chain in some for item in _items(number, chain, arguments))
        number = words["of"].format(pictures=len(items), chains=len(some)) if arguments.inversions else len(some)
        heading = words["section"].format(assortment=assortment, number=number)
        sections.append(Section(heading + (words["joints"].format(k=joints) if joints else ""), items))
        pictures += len(items)
    title = words["inversions" if arguments.inversions else "title"].format(n=arguments.links, f=mobility)
    return title, words["note"].format(chains=len(found), pictures=pictures), sections


def _large_first(chain: Chain) -> tuple[int, ...]:
    """Chains with large links last."""
    return tuple(-k for k in chain.assortment)


def _items(number: int, chain: Chain, arguments: argparse.Namespace) -> Iterator[Item]:
    if not arguments.inversions:
        name = chain_name(chain, arguments.lang)
        figure = draw(chain, labels=arguments.labels, lang=arguments.lang, name=name)
        yield Item(figure, f"{number}  {name}".strip(), code(chain))
        return
    for k, mechanism in enumerate(inversions(chain), 1):
        name = family(mechanism, arguments.lang) or ""
        figure = draw(mechanism, labels=arguments.labels, lang=arguments.lang, name=name)
        yield Item(figure, f"{number}.{k}  {name}".strip(), mechanism.code())
