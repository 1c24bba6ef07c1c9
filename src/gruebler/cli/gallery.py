"""`gruebler gallery`: all chains or mechanisms of a request, of lines of text, or of the catalog, on one page."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from itertools import groupby, islice
from pathlib import Path
from typing import Any

from gruebler.base.errors import GrueblerError, naming
from gruebler.base.text import Message, message, plural, translate
from gruebler.cli.draw import called, subject
from gruebler.cli.inputs import assortment_of, outputs_of
from gruebler.cli.output import write_file
from gruebler.cli.parser import Parser
from gruebler.files.structures import is_structure_text
from gruebler.files.text_files import read_text
from gruebler.pictures.canvas import Item, Section, gallery_html
from gruebler.pictures.canvas.arrangement import gallery_figure
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of
from gruebler.pictures.structure import draw_side_view, draw_structure
from gruebler.pictures.structure.messages import chain_name
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration import Request, chains
from gruebler.structure.enumeration.estimates import estimate
from gruebler.structure.isomorphism import code
from gruebler.structure.mechanism.inversion import family, inversions
from gruebler.teaching.catalog import entries, entry
from gruebler.teaching.catalog.machine_pictures import draw_machine

_MOST = 3000  # chains on a page; a browser still scrolls through them


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Draw all chains or mechanisms with given numbers, or the given ones, on one page; machines of the "
        "catalog to scale, with --structure their mechanisms.",
        epilog="Examples: gruebler gallery --links 8 -o eight.html; gruebler gallery --poster joints -o joints.pdf; "
        "gruebler variants --links 6 --prismatic 1 | "
        "gruebler gallery - -o sliders.html. PDF needs matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.take(
        """
        ids ID|CHAIN|FILE|- *  instead of --links: catalog entries, texts of chains and mechanisms, files with one per
            line, or - for lines on standard input
        --poster {chains,inversions,assur,forms,joints}  a poster instead: all chains by assortment, all inversions or
            all Assur groups up to --links, the forms of four-bars and slider-cranks, or the kinds of joints
        --links
        --mobility F int  mobility (default: 1)
        --fractionated {none,link,joint,all}  as for gruebler enumerate (default: none)
        --assortment
        --multiple-joints K|any  as for gruebler enumerate (default: 0)
        --inversions  each chain with every frame that makes a difference
        --labels
        --structure
        --side  draw gear trains from the side, their axes as lines
        """
    )
    parser.add_out(help="the page: .html or .pdf; or one picture: .svg or .png", required=True)


def run(arguments: argparse.Namespace) -> int:
    """Write the page."""
    suffix = suffix_of(arguments.out, ("html", *SUFFIXES))
    lang = arguments.lang
    if arguments.side and not arguments.ids:
        raise GrueblerError("--side draws gear trains that are given, such as those of gruebler enumerate --trains")
    if arguments.poster is not None:
        title, note, sections = _poster(arguments)
    elif arguments.ids:
        _check(arguments)
        named = [line for word in arguments.ids for line in _lines(word)]
        _fits(len(named))
        written_out = any(map(is_structure_text, named))
        title = translate("Chains and mechanisms" if written_out else "Machines of the catalog", lang)
        sections = [Section("", tuple(_line(word, number, arguments) for number, word in enumerate(named, 1)))]
        note = plural("{count} picture.", "{count} pictures.", len(named), lang)
    elif arguments.links is not None:
        title, note, sections = _request(arguments)
    else:
        raise GrueblerError("give --links N, or the chains, mechanisms or catalog entries to draw")
    if suffix == "html":
        content = gallery_html(title, sections, lang=lang, note=note).encode("utf-8")
    elif suffix == "pdf":
        from gruebler.pictures.canvas.matplotlib_files import gallery_pdf

        content = gallery_pdf(title, sections, note=note)
    else:
        content = picture_bytes(gallery_figure(title, sections), suffix)
    write_file(arguments.out, content, lang)
    return 0


def _poster(arguments: argparse.Namespace) -> tuple[str, str, list[Section]]:
    from gruebler.teaching.worksheets import poster

    if arguments.ids:
        raise GrueblerError("--poster takes no chains, mechanisms or entries")
    title, sections = poster(arguments.poster, arguments.links, arguments.lang)
    pictures = sum(len(section.items) for section in sections)
    return title, plural("{count} picture.", "{count} pictures.", pictures, arguments.lang), list(sections)


_OF_REQUESTS = ("links", "mobility", "fractionated", "assortment", "multiple_joints", "inversions")
_USUAL = {"mobility": 1, "fractionated": "none", "multiple_joints": "0"}


def _check(arguments: argparse.Namespace) -> None:
    """Options that only go with --links are refused beside given items."""
    if arguments.side and arguments.labels:
        raise GrueblerError("--labels does not go with --side, which always labels the links")
    for key in _OF_REQUESTS:
        if getattr(arguments, key) not in (None, False):
            option = f"--{key.replace('_', '-')}"
            raise GrueblerError(
                "a gallery shows either the given items or the chains of --links; {option} goes only with --links",
                option=option,
            )


def _lines(word: str) -> list[str]:
    """The chains, mechanisms and ids of a file, a line each, or of standard input (``-``); else the word itself."""
    path = Path(word)
    if word != "-" and (is_structure_text(word) or word in entries() or path.suffix.lower() in (".toml", ".json")):
        return [word]
    if word != "-" and not path.is_file() and not path.suffix and len(path.parts) == 1:
        return [word]  # an id that the catalog does not have: the caller's error names the nearest ones
    text = sys.stdin.read() if word == "-" else read_text(path)
    lines = [line.strip() for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if path.suffix == ".g6":
        lines = [f"g6:{line}" for line in lines]
    if not lines:
        raise GrueblerError("{source}: no chain in it; expected one per line", source=word)
    return lines


def _line(word: str, number: int, arguments: argparse.Namespace) -> Item:
    """The picture of a chain or mechanism that is written out, or of a machine of the catalog."""
    if not is_structure_text(word) and word in entries():
        return _machine(word, arguments)
    if not is_structure_text(word) and not Path(word).is_file():
        entry(word)  # raises with the nearest ids
    with naming(message("number {number}, {word!r}", number=number, word=word[:40]), GrueblerError):
        shown = subject(word, None, None, [])
        outputs = outputs_of(word)
    name = chain_name(shown, arguments.lang) if isinstance(shown, Chain) else family(shown, arguments.lang)
    words = [str(number), name or "", *(translate("output {link}", arguments.lang, link=link) for link in outputs)]
    if arguments.side:
        figure = draw_side_view(shown, lang=arguments.lang, name=name or "")
    else:
        figure = draw_structure(shown, labels=arguments.labels, lang=arguments.lang, name=name or "")
    return Item(figure, "  ".join(filter(None, words)), code(shown) if isinstance(shown, Chain) else shown.code())


def _fits(number: int) -> None:
    if number > _MOST:
        raise GrueblerError("{number:,} chains are too many for one page (at most {most:,})", number=number, most=_MOST)


def _machine(id: str, arguments: argparse.Namespace) -> Item:
    record = entry(id)
    name, _ = called(record, arguments.lang)
    if arguments.side:
        figure = draw_side_view(subject(id, None, None, []), lang=arguments.lang, name=name)
    else:
        figure = draw_machine(record, labels=arguments.labels, structure=arguments.structure, lang=arguments.lang)
    return Item(figure, name, id)


def _request(arguments: argparse.Namespace) -> tuple[str, str, list[Section]]:
    lang = arguments.lang
    given = {key: getattr(arguments, key) for key in _USUAL}
    usual: dict[str, Any] = _USUAL | {key: value for key, value in given.items() if value is not None}
    mobility = usual.pop("mobility")
    options = usual | {"assortment": assortment_of(arguments.assortment)}
    if options["assortment"] is None:
        size = estimate(Request(arguments.links, mobility=mobility, **options), "text").chains
        if size > _MOST:
            raise GrueblerError(
                "{number:,} chains are too many for one page (at most {most:,}); choose some with --assortment",
                number=size,
                most=_MOST,
            )
    listed = list(islice(chains(arguments.links, mobility, **options), _MOST + 1))
    if len(listed) > _MOST:
        raise GrueblerError(
            "more than {most:,} chains have the assortment {assortment}: too many for one page",
            most=_MOST,
            assortment=arguments.assortment,
        )
    if not listed:
        raise GrueblerError(
            "there are no such chains with {links} links and F = {mobility}", links=arguments.links, mobility=mobility
        )
    sections = []
    pictures = 0
    for (joints, _), group in groupby(sorted(enumerate(listed, 1), key=_section_key), key=_section_key):
        numbered = list(group)
        assortment = ", ".join(map(str, numbered[0][1].assortment))
        items = tuple(item for number, chain in numbered for item in _items(number, chain, arguments))
        extent: Message | int = len(numbered)
        if arguments.inversions:
            extent = message("{pictures} from {chains} chains", pictures=len(items), chains=len(numbered))
        heading = translate(
            "Binary, ternary, ... links: {assortment} ({extent})", lang, assortment=assortment, extent=extent
        )
        if joints:
            heading += "; " + translate("multiple joints: {count}", lang, count=joints)
        sections.append(Section(heading, items))
        pictures += len(items)
    title = translate(
        "Mechanisms with {links} links, F = {mobility}"
        if arguments.inversions
        else "Kinematic chains with {links} links, F = {mobility}",
        lang,
        links=arguments.links,
        mobility=mobility,
    )
    note = translate("{chains} chains, {pictures} pictures.", lang, chains=len(listed), pictures=pictures)
    return title, note, sections


def _section_key(numbered: tuple[int, Chain]) -> tuple[int, tuple[int, ...]]:
    chain = numbered[1]
    return len(chain.multiple_joints), tuple(-k for k in chain.assortment)


def _items(number: int, chain: Chain, arguments: argparse.Namespace) -> Iterator[Item]:
    if not arguments.inversions:
        name = chain_name(chain, arguments.lang)
        figure = draw_structure(chain, labels=arguments.labels, lang=arguments.lang, name=name)
        yield Item(figure, f"{number}  {name}".strip(), code(chain))
        return
    for k, mechanism in enumerate(inversions(chain), 1):
        name = family(mechanism, arguments.lang) or ""
        figure = draw_structure(mechanism, labels=arguments.labels, lang=arguments.lang, name=name)
        yield Item(figure, f"{number}.{k}  {name}".strip(), mechanism.code())
