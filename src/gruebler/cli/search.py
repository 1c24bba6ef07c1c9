"""`gruebler catalog search`: machines, or every structure, with given access features."""

from __future__ import annotations

import argparse
import json
import sys
from itertools import islice
from typing import Any

import msgspec

from gruebler.catalog import Query, search
from gruebler.catalog.feature_query import (
    FeatureQuery,
    entry_features,
    entry_mechanism,
    features_to_json,
    read_pairs,
    structures,
    structures_time,
)
from gruebler.catalog.features import AccessFeatures
from gruebler.chain.pairs import Alphabet
from gruebler.cli.inversions import item
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.formats import Entry
from gruebler.mechanism.inversion import DrivenMechanism, family
from gruebler.mobility import counted, mobility_report

__all__ = ["add", "run"]

_HEADERS = {
    "en": ("id", "name", "n", "F", "moves", "drives (frame)", "outputs (frame)", "links", "joints"),
    "de": ("Kennung", "Name", "n", "F", "beweglich", "Antriebe (Gestell)", "Abtriebe (Gestell)", "Glieder", "Gelenke"),
}
_WORDS = {
    "en": {
        "nothing": "No entry answers.",
        "none": "No mechanism has these features.",
        "found": "{n} found.",
        "more": "{n} told; there are more.",
        "output": "output",
        "progress": "{n} mechanisms, {seconds:.0f} s",
    },
    "de": {
        "nothing": "Kein Eintrag passt.",
        "none": "Kein Getriebe hat diese Merkmale.",
        "found": "{n} gefunden.",
        "more": "{n} genannt; es gibt weitere.",
        "output": "Abtrieb",
        "progress": "{n} Getriebe, {seconds:.0f} s",
    },
}
_NAMED = {"binary": 2, "ternary": 3, "quaternary": 4}


def add(parser: Parser) -> None:
    """Add the arguments of `gruebler catalog search`."""
    parser.add_argument("words", nargs="*", metavar="WORD", help="must occur in a name, remark, source or link")
    parser.add_argument("--text", action="append", default=[], metavar="WORD", help="another such word; repeatable")
    _add_features(parser)
    parser.add_argument("--joints", type=int, metavar="G", help="number of joints, multiple ones counted k - 1 times")
    parser.add_argument("--pair", action="append", default=[], metavar="P", help="symbol or name of a pair; repeatable")
    parser.add_argument("--drive", metavar="P", help="symbol or name of a driven pair")
    parser.add_argument("--claims", action="store_true", help="only where what really moves differs from the count")
    parser.add_argument("--enumerate", action="store_true", help="every structure, not only the machines")
    parser.add_argument("--yes", action="store_true", help="with --enumerate: begin even if it will be long")
    parser.add_argument("--limit", type=int, metavar="N", help="with --enumerate: end after so many")
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--json", action="store_true", help="as JSON")


def _add_features(parser: Parser) -> None:
    parser.add_argument("--links", type=int, metavar="N", help="number of links")
    parser.add_argument(
        "--mobility", "--F", type=int, metavar="F", help="F by the count (with --enumerate 1 if left out)"
    )
    parser.add_argument("--drives", type=int, metavar="N", help="number of drive joints")
    parser.add_argument("--drives-at-frame", type=int, metavar="N", help="so many of them at the frame")
    parser.add_argument("--outputs", type=int, metavar="N", help="number of output links")
    parser.add_argument("--output-links-at-frame", type=int, metavar="N", help="so many of them jointed to the frame")
    parser.add_argument("--pairs", metavar="D:4,S:0", help="exactly so many joints of these kinds, in one alphabet")
    parser.add_argument("--binary", type=int, metavar="N", help="number of binary links")
    parser.add_argument("--ternary", type=int, metavar="N", help="number of ternary links")
    parser.add_argument("--quaternary", type=int, metavar="N", help="number of quaternary links")
    parser.add_argument("--link-kinds", metavar="N2,N3,...", help="numbers of binary, ternary, ... links, no others")
    parser.add_argument("--multiple-joints", type=int, metavar="K", help="exactly so many joints of 3 and more links")


def run(arguments: argparse.Namespace) -> int:
    """Search the catalog, or enumerate."""
    query = _features(arguments)
    if arguments.enumerate:
        _enumerate(query, arguments)
    else:
        if arguments.limit is not None:
            raise GrueblerError("--limit goes with --enumerate: the catalog is told in full")
        _look_up(query, arguments)
    return 0


def _features(arguments: argparse.Namespace) -> FeatureQuery:
    kinds = {k: number for name, k in _NAMED.items() if (number := getattr(arguments, name)) is not None}
    if arguments.link_kinds is not None:
        if kinds:
            raise GrueblerError("--link-kinds tells all kinds of links; it does not go with --binary, --ternary, ...")
        numbers = _numbers(arguments.link_kinds)
        kinds = dict(enumerate(numbers, 2))
        if arguments.links not in (None, sum(numbers)):
            raise GrueblerError(
                "--link-kinds {link_kinds} are {sum} links, not {links}",
                link_kinds=arguments.link_kinds,
                sum=sum(numbers),
                links=arguments.links,
            )
    return FeatureQuery(
        links=sum(kinds.values()) if arguments.link_kinds is not None else arguments.links,
        mobility=arguments.mobility,
        drive_joints=arguments.drives,
        drive_joints_at_frame=arguments.drives_at_frame,
        output_links=arguments.outputs,
        output_links_at_frame=arguments.output_links_at_frame,
        pairs=() if arguments.pairs is None else read_pairs(arguments.pairs),
        kinds=tuple(kinds.items()),
        multiple_joints=arguments.multiple_joints,
    )


def _numbers(text: str) -> tuple[int, ...]:
    parts = text.split(",")
    if not all(part.strip().isdecimal() for part in parts):
        raise GrueblerError(
            "--link-kinds {text_!r}: expected the numbers of binary, ternary, ... links such as 4,2", text_=text
        )
    return tuple(int(part) for part in parts)


# --- the catalog -----------------------------------------------------------------------------------


def _look_up(query: FeatureQuery, arguments: argparse.Namespace) -> None:
    words = Query(
        words=(*arguments.words, *arguments.text),
        joints=arguments.joints,
        pairs=tuple(arguments.pair),
        drive=arguments.drive,
    )
    found = []
    for entry in search(words):
        features = entry_features(entry)
        if query.fits(entry_mechanism(entry), features) and not (arguments.claims and _moves(entry) == _counted(entry)):
            found.append((entry, features))
    if arguments.count:
        print(json.dumps({"count": len(found)}) if arguments.json else len(found))
    elif arguments.json:
        print_json([_document(*one) for one in found])
    elif found:
        print_table(_HEADERS[arguments.lang], [_row(*one, arguments.lang) for one in found], numbers=(2, 3, 4))
    else:
        print(_WORDS[arguments.lang]["nothing"])


def _moves(entry: Entry) -> int:
    """What really moves: the claim, which `gruebler check` derives, or the generic mobility."""
    claimed = entry.claims.mobility
    return mobility_report(entry.chain()).generic if claimed is None else claimed


def _counted(entry: Entry) -> int:
    return counted(entry.chain())


def _row(entry: Entry, features: AccessFeatures, lang: str) -> tuple[str, ...]:
    alphabet = Alphabet.GERMAN if lang == "de" else Alphabet.INTERNATIONAL
    return (
        entry.id,
        entry.name.in_language(lang),
        str(features.links),
        str(_counted(entry)),
        str(_moves(entry)),
        f"{features.drive_joints} ({features.drive_joints_at_frame})",
        f"{features.output_links} ({features.output_links_at_frame})",
        " ".join(f"n{k}={number}" for k, number in features.links_by_joints),
        " ".join(f"{symbol}:{number}" for symbol, number in features.by_symbol(alphabet)),
    )


def _document(entry: Entry, features: AccessFeatures) -> dict[str, Any]:
    document: dict[str, Any] = msgspec.to_builtins(entry)
    return document | {"features": features_to_json(features), "moves": _moves(entry)}


# --- every structure -------------------------------------------------------------------------------


def _enumerate(query: FeatureQuery, arguments: argparse.Namespace) -> None:
    for option in ("words", "text", "joints", "pair", "drive", "claims"):
        if getattr(arguments, option):
            raise GrueblerError(
                "{option} belongs to the machines of the catalog and does not go with --enumerate", option=option
            )
    if arguments.limit is not None and arguments.limit < 1:
        raise GrueblerError("--limit is 1 or more, not {limit}", limit=arguments.limit)
    words = _WORDS[arguments.lang]
    quiet = arguments.count or arguments.json or not sys.stdout.isatty()
    if arguments.limit is None:
        ask_before(structures_time(query), arguments.yes)
    drivens = progress(structures(query), words["progress"] if quiet else "")
    told = drivens if arguments.limit is None else islice(drivens, arguments.limit)
    items: list[dict[str, object]] = []
    number = 0
    for number, driven in enumerate(told, 1):
        if arguments.json:
            items += [] if arguments.count else [item(driven)]
        elif not arguments.count:
            print(f"{number}  {_text(driven, arguments.lang)}", flush=True)
    more = arguments.limit == number and next(drivens, None) is not None
    if arguments.json:
        document = {"count": number, "complete": not more} | ({} if arguments.count else {"items": items})
        print_json(document)
    elif arguments.count and not more:
        print(number)
    else:
        print(words["more" if more else "found"].format(n=number) if number else words["none"])


def _text(driven: DrivenMechanism, lang: str) -> str:
    text = driven.mechanism.text("german" if lang == "de" else "international")
    if driven.output is not None:
        text += f"; {_WORDS[lang]['output']} {driven.output}"
    name = family(driven.mechanism, lang)
    return text if name is None else f"{text}  ({name})"
