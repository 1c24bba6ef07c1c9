"""`gruebler extend`: all different chains that one more dyad or coupler gives."""

from __future__ import annotations

import argparse
from typing import Any

from gruebler.chain import Chain
from gruebler.cli.inputs import chain_from_word
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.mobility import mobility_report
from gruebler.transformations import Attachment, Extension, extend

__all__ = ["add", "run"]

_HEADERS = {
    "en": ("chain", "F counted", "generic", "places", "joints that cannot move"),
    "de": ("Kette", "F gezählt", "generisch", "Stellen", "unbewegliche Gelenke"),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Each structure once, with the places that give it.",
    )
    parser.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--dyad", nargs="?", const="RRR", metavar="FORM", help="RRR (default), RRP, RPR, PRP or RPP")
    kind.add_argument("--coupler", nargs="?", const="RR", metavar="PAIRS", help="its two joints (default: RR)")
    parser.add_argument("--at-joints", action="store_true", help="new links may join joints that are there")
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--json", action="store_true", help="an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """List or count the extensions."""
    chain = chain_from_word(arguments.chain)
    extensions = extend(chain, dyad=arguments.dyad, coupler=arguments.coupler, at_joints=arguments.at_joints)
    if arguments.json:
        document: dict[str, Any] = {"count": len(extensions)}
        if not arguments.count:
            document["items"] = [_item(chain, extension) for extension in extensions]
        print_json(document)
    elif arguments.count:
        print(len(extensions))
    else:
        print_table(_HEADERS[arguments.lang], [_row(chain, one, arguments.lang) for one in extensions], numbers=(1, 2))
    return 0


def _item(chain: Chain, one: Extension) -> dict[str, Any]:
    report = mobility_report(one.chain)
    names = one.chain.joint_names()
    return {
        "code": one.code,
        "text": str(one.chain),
        "counted": report.counted,
        "generic": report.generic,
        "immobile_joints": [names[k] for k in report.immobile_joints],
        "places": [_places(chain, pair) for pair in one.places],
    }


def _row(chain: Chain, one: Extension, lang: str) -> tuple[str, str, str, str, str]:
    report = mobility_report(one.chain)
    alphabet = "german" if lang == "de" else "international"
    names = one.chain.joint_names(alphabet)
    return (
        one.chain.text(alphabet),
        str(report.counted),
        str(report.generic),
        ", ".join("/".join(_places(chain, pair, alphabet)) for pair in one.places),
        ", ".join(names[k] for k in report.immobile_joints),
    )


def _places(chain: Chain, pair: tuple[Attachment, Attachment], alphabet: str = "international") -> list[str]:
    names = chain.joint_names(alphabet)
    return [place if isinstance(place, str) else names[place] for place in pair]
