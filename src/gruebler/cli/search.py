"""`gruebler catalog search`: machines, or all structures, with given access features."""

from __future__ import annotations

import argparse
import sys
from itertools import islice
from typing import TYPE_CHECKING, Any

import msgspec

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, translate
from gruebler.cli.inversions import item
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_count, print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.files import Entry
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism.inversion import DrivenMechanism, family
from gruebler.structure.mobility import counted, mobility_report
from gruebler.teaching.catalog import Query, search
from gruebler.teaching.catalog.feature_query import (
    FeatureQuery,
    entry_features,
    entry_mechanism,
    features_to_json,
    read_pairs,
    structures,
    structures_time,
)
from gruebler.teaching.catalog.features import AccessFeatures

if TYPE_CHECKING:
    from gruebler.structure.atlas import Atlas

_PROGRESS = message("{n} mechanisms, {seconds:.0f} s")
_NAMED = {"binary": 2, "ternary": 3, "quaternary": 4}


def add(parser: Parser) -> None:
    """Add the arguments of `gruebler catalog search`."""
    parser.take(
        """
        words WORD *  a word in a name, remark, source or link name
        --text WORD ...  another such word (repeatable)
        """
    )
    _add_features(parser)
    parser.take(
        """
        --joints G int  number of joints; a joint of k links counts k - 1 times
        --pair P ...  symbol or name of a joint type (repeatable)
        --drive-pair P  symbol or name of the type of a driven joint
        --claims  only machines whose mobility differs from the count
        --enumerate  list all structures, not only those of the catalog
        --atlas DIR ? :  with --enumerate: take the chains from an atlas (default: the one that comes with the library)
        --where SQL  with --enumerate: a condition on the columns of the atlas, such as "not planar and dyads_only";
            gruebler atlas columns lists them
        --yes
        --limit N int  with --enumerate: stop after N structures
        --count
        """
    )
    parser.add_printed(help="print JSON")


def _add_features(parser: Parser) -> None:
    parser.take(
        """
        --links
        --mobility, --F F int  mobility by the count (with --enumerate default: 1)
        --drives N int  number of drive joints
        --drives-at-frame N int  number of drive joints at the frame
        --outputs N int  number of output links
        --output-links-at-frame N int  number of output links jointed to the frame
        --pairs D:4,S:0  numbers of joints by type, in one alphabet
        --binary N int  number of binary links
        --ternary N int  number of ternary links
        --quaternary N int  number of quaternary links
        --link-kinds N2,N3,...  numbers of all binary, ternary, ... links
        --multiple-joints K int  number of joints of three or more links
        """
    )


def run(arguments: argparse.Namespace) -> int:
    """Search the catalog, or enumerate."""
    query = _features(arguments)
    if arguments.enumerate:
        _enumerate(query, arguments)
    else:
        for option in ("limit", "atlas", "where"):
            if getattr(arguments, option) is not None:
                raise GrueblerError("--{option} needs --enumerate", option=option)
        _look_up(query, arguments)
    return 0


def _features(arguments: argparse.Namespace) -> FeatureQuery:
    kinds = {k: number for name, k in _NAMED.items() if (number := getattr(arguments, name)) is not None}
    if arguments.link_kinds is not None:
        if kinds:
            raise GrueblerError(
                "--link-kinds gives the numbers of all links; it does not go with --binary, --ternary and --quaternary"
            )
        numbers = _numbers(arguments.link_kinds)
        kinds = dict(enumerate(numbers, 2))
        if arguments.links not in (None, sum(numbers)):
            raise GrueblerError(
                "--link-kinds {numbers} are {count} links, not {links}",
                numbers=arguments.link_kinds,
                count=sum(numbers),
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
            "--link-kinds {text!r}: expected the numbers of binary, ternary, ... links such as 4,2", text=text
        )
    return tuple(int(part) for part in parts)


# --- the catalog -----------------------------------------------------------------------------------


def _look_up(query: FeatureQuery, arguments: argparse.Namespace) -> None:
    words = Query(
        words=(*arguments.words, *arguments.text),
        joints=arguments.joints,
        pairs=tuple(arguments.pair),
        drive=arguments.drive_pair,
    )
    matches = []
    for entry in search(words):
        features = entry_features(entry)
        if query.fits(entry_mechanism(entry), features) and not (arguments.claims and _moves(entry) == _counted(entry)):
            matches.append((entry, features))
    if arguments.count:
        print_count(arguments, len(matches))
    elif arguments.json:
        print_json([_document(*match) for match in matches])
    elif matches:
        print_table(_headers(arguments.lang), [_row(*match, arguments.lang) for match in matches], numbers=(2, 3, 4))
    else:
        print(translate("No entry of the catalog matches.", arguments.lang))


def _headers(lang: str) -> list[str]:
    return [
        translate("id", lang),
        translate("name", lang),
        "n",
        "F",
        translate("finite mobility", lang),
        translate("drives (at the frame)", lang),
        translate("outputs (at the frame)", lang),
        translate("links", lang),
        translate("joints", lang),
    ]


def _moves(entry: Entry) -> int:
    """What really moves: the claim, which `gruebler check` derives, or the generic mobility."""
    claimed = entry.claims.mobility
    return mobility_report(entry.chain()).generic if claimed is None else claimed


def _counted(entry: Entry) -> int:
    return counted(entry.chain())


def _row(entry: Entry, features: AccessFeatures, lang: str) -> tuple[str, ...]:
    alphabet = Alphabet.of_language(lang)
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
    for key in ("words", "text", "joints", "pair", "drive_pair", "claims"):
        if getattr(arguments, key):
            option = "WORD" if key == "words" else f"--{key.replace('_', '-')}"
            raise GrueblerError("{option} searches the catalog and does not go with --enumerate", option=option)
    if arguments.limit is not None and arguments.limit < 1:
        raise GrueblerError("--limit: expected a number from 1, but found {limit}", limit=arguments.limit)
    quiet = arguments.count or arguments.json or not sys.stdout.isatty()
    if arguments.limit is None and not arguments.where:
        ask_before(structures_time(query), arguments.yes)
    candidates = structures(query, _atlas(arguments), arguments.where or "")
    drivens = progress(candidates, _PROGRESS.in_language(arguments.lang) if quiet else "")
    listed = drivens if arguments.limit is None else islice(drivens, arguments.limit)
    items: list[dict[str, object]] = []
    number = 0
    for number, driven in enumerate(listed, 1):
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
    elif more:
        print(translate("{count} listed; there are more.", arguments.lang, count=number))
    elif number:
        print(translate("{count} found.", arguments.lang, count=number))
    else:
        print(translate("No mechanism has these features.", arguments.lang))


def _atlas(arguments: argparse.Namespace) -> Atlas | None:
    """The atlas to search in: the one named, else for a condition the one that comes with the library."""
    if arguments.atlas is None and not arguments.where:
        return None
    from gruebler.structure.atlas import open as open_atlas

    return open_atlas(arguments.atlas or None)


def _text(driven: DrivenMechanism, lang: str) -> str:
    text = driven.mechanism.text(Alphabet.of_language(lang))
    if driven.output is not None:
        text += "; " + translate("output {link}", lang, link=driven.output)
    name = family(driven.mechanism, lang)
    return text if name is None else f"{text}  ({name})"
