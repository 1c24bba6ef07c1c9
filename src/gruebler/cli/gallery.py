"""`gruebler gallery`: all chains or mechanisms of a request, of lines of text, or of the catalog, on one page."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from itertools import groupby, islice
from pathlib import Path
from typing import Any

from gruebler.catalog import entries, entry
from gruebler.chain import Chain
from gruebler.cli.draw import german, subject
from gruebler.cli.inputs import assortment_of, is_text, outputs_of
from gruebler.cli.output import write_file
from gruebler.cli.parser import Parser
from gruebler.drawing.canvas import Item, Section, gallery_html
from gruebler.drawing.canvas.files import suffix_of
from gruebler.drawing.structure import draw
from gruebler.drawing.structure.messages import chain_name
from gruebler.enumeration import Request, chains
from gruebler.enumeration.estimates import estimate
from gruebler.errors import GrueblerError
from gruebler.isomorphism import code
from gruebler.mechanism.inversion import family, inversions

__all__ = ["add", "run"]

_MOST = 3000  # chains on a page; a browser still scrolls through them

_WORDS = {
    "en": {
        "title": "Kinematic chains with {n} links, F = {f}",
        "inversions": "Mechanisms with {n} links, F = {f}",
        "catalog": "Machines of the catalog",
        "lines": "Chains and mechanisms",
        "output": "output {link}",
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
        "lines": "Ketten und Getriebe",
        "output": "Abtrieb {link}",
        "note": "{chains} Ketten, {pictures} Bilder.",
        "machines": "{pictures} Bilder.",
        "section": "Glieder binär, ternär, ...: {assortment} ({number})",
        "of": "{pictures} aus {chains} Ketten",
        "joints": "; Mehrfachgelenke: {k}",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="All chains of a request, or machines of the catalog, on one page.",
        epilog="Examples: gruebler gallery --links 8 -o eight.html; gruebler variants --links 6 --prismatic 1 | "
        "gruebler gallery - -o sliders.html. PDF needs matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.add_argument(
        "ids",
        nargs="*",
        metavar="ID|CHAIN|FILE|-",
        help="instead of a request: entries of the catalog, texts of chains and mechanisms, files with one a line, or "
        "- for lines on standard input",
    )
    parser.add_argument("--links", type=int, metavar="N", help="number of links")
    parser.add_argument("--mobility", type=int, metavar="F", help="mobility (default: 1)")
    parser.add_argument(
        "--fractionated", choices=("none", "link", "joint", "all"), help="as for enumerate (default: none)"
    )
    parser.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    parser.add_argument("--multiple-joints", metavar="K|any", help="as for enumerate (default: 0)")
    parser.add_argument("--inversions", action="store_true", help="each chain with every frame that matters")
    parser.add_argument("--labels", action="store_true", help="name the links")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="a file .html or .pdf")


def run(arguments: argparse.Namespace) -> int:
    """Write the page."""
    suffix = suffix_of(arguments.output, ("html", "pdf"))
    words = _WORDS[arguments.lang]
    if arguments.ids:
        _check(arguments)
        named = [one for word in arguments.ids for one in _lines(word)]
        _fits(len(named))
        title = words["catalog" if not any(map(is_text, named)) else "lines"]
        sections = [Section("", tuple(_line(word, number, arguments) for number, word in enumerate(named, 1)))]
        note = words["machines"].format(pictures=len(named))
    elif arguments.links is not None:
        title, note, sections = _request(arguments)
    else:
        raise GrueblerError("say what to show: --links N, or ids of the catalog")
    if suffix == "html":
        content = gallery_html(title, sections, lang=arguments.lang, note=note).encode("utf-8")
    else:
        from gruebler.drawing.canvas.matplotlib_files import gallery_pdf

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
                "a gallery shows machines of the catalog or the chains of --links, not both: {option} is for chains",
                option=option,
            )


def _lines(word: str) -> list[str]:
    """The chains, mechanisms and ids of a file, a line each, or of standard input (``-``); else the word itself."""
    path = Path(word)
    if word != "-" and (is_text(word) or word in entries() or path.suffix.lower() in (".toml", ".json")):
        return [word]
    if word != "-" and not path.is_file() and not path.suffix and len(path.parts) == 1:
        return [word]  # an id that the catalog does not have: it says so
    try:
        text = sys.stdin.read() if word == "-" else path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise GrueblerError("{word}: cannot be read ({value})", word=word, value=error.strerror or error) from None
    except UnicodeDecodeError:
        raise GrueblerError("{word}: is not UTF-8 text", word=word) from None
    found = [line.strip() for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if path.suffix == ".g6":
        found = [f"g6:{line}" for line in found]
    if not found:
        raise GrueblerError("{word}: no chain in it; expected one a line", word=word)
    return found


def _line(word: str, number: int, arguments: argparse.Namespace) -> Item:
    """The picture of a chain or mechanism that is written out, or of a machine of the catalog."""
    if not is_text(word) and word in entries():
        return _machine(word, arguments)
    if not is_text(word) and not Path(word).is_file():
        entry(word)  # raises with the nearest ids
    try:
        shown = subject(word, None, None, [])
        outputs = outputs_of(word)
    except GrueblerError as error:
        raise GrueblerError("number {number}, {word!r}: {error}", number=number, word=word[:40], error=error) from None
    name = chain_name(shown, arguments.lang) if isinstance(shown, Chain) else family(shown, arguments.lang)
    words = [str(number), name or "", *(_WORDS[arguments.lang]["output"].format(link=link) for link in outputs)]
    figure = draw(shown, labels=arguments.labels, lang=arguments.lang, name=name or "")
    return Item(figure, "  ".join(filter(None, words)), code(shown) if isinstance(shown, Chain) else shown.code())


def _fits(number: int) -> None:
    if number > _MOST:
        raise GrueblerError("{number:,} chains do not fit on a page of {most:,}", number=number, most=_MOST)


def _machine(id: str, arguments: argparse.Namespace) -> Item:
    record = entry(id)
    name = record.name.in_language(arguments.lang)
    names = german(record, arguments.lang)
    figure = draw(subject(id, None, None, []), labels=arguments.labels, lang=arguments.lang, name=name, names=names)
    return Item(figure, name, id)


def _request(arguments: argparse.Namespace) -> tuple[str, str, list[Section]]:
    words = _WORDS[arguments.lang]
    given = {key: getattr(arguments, key) for key in _USUAL}
    usual: dict[str, Any] = _USUAL | {key: value for key, value in given.items() if value is not None}
    mobility = usual.pop("mobility")
    options = usual | {"assortment": assortment_of(arguments.assortment)}
    if options["assortment"] is None:
        size = estimate(Request(arguments.links, mobility, **options), "text").chains
        if size > _MOST:
            raise GrueblerError(
                "{size:,} chains do not fit on a page of {most:,}; choose some with --assortment", size=size, most=_MOST
            )
    found = list(islice(chains(arguments.links, mobility, **options), _MOST + 1))
    if len(found) > _MOST:
        raise GrueblerError(
            "more than {most:,} chains have the assortment {assortment}: they do not fit on a page",
            most=_MOST,
            assortment=arguments.assortment,
        )
    if not found:
        raise GrueblerError(
            "there are no such chains with {links} links and F = {mobility}: nothing to be drawn",
            links=arguments.links,
            mobility=mobility,
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
