"""`gruebler variants`: every typed chain or mechanism that answers a set of requirements."""

from __future__ import annotations

import argparse
import json
import sys

from gruebler.chain import Chain
from gruebler.cli.inputs import assortment_of
from gruebler.cli.inversions import item
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.errors import GrueblerError
from gruebler.isomorphism import code
from gruebler.mechanism.inversion import DrivenMechanism
from gruebler.type_synthesis import JointRequirement, Requirements, expected_seconds_of_variants, variants

__all__ = ["add", "run"]

_PROGRESS = {"en": "{n} found, {seconds:.0f} s", "de": "{n} gefunden, {seconds:.0f} s"}
_FOUND = {"en": "{n} found.", "de": "{n} gefunden."}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Every typed chain that answers the requirements, each once; mechanisms where something is asked "
        "of frame, drive or output. PAIR@PLACE is a symbol or name of a pair (or nothing for any), and frame, moving "
        "or any.",
        epilog="Example: gruebler variants --links 6 --prismatic 1 --drive R@frame --at-frame P --count",
    )
    parser.add_argument("--links", type=int, required=True, metavar="N", help="number of links")
    parser.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    parser.add_argument("--prismatic", type=int, default=0, metavar="K", help="exactly so many sliding joints")
    parser.add_argument("--rolling", type=int, default=0, metavar="K", help="exactly so many rolling joints")
    parser.add_argument("--roll-slide", type=int, default=0, metavar="K", help="exactly so many gear or cam contacts")
    parser.add_argument("--multiple-joints", type=int, default=0, metavar="K", help="exactly so many multiple joints")
    parser.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    parser.add_argument("--frame-joints", type=int, metavar="K", help="joints on the frame: 3 for a ternary one")
    parser.add_argument("--at-frame", action="append", default=[], metavar="PAIR[:K]", help="at least K at the frame")
    parser.add_argument("--drive", action="append", default=[], metavar="PAIR@PLACE", help="one for each drive")
    parser.add_argument("--output", metavar="PAIR@PLACE", help="the output link's joint; @moving: not at the frame")
    parser.add_argument(
        "--output-at-drive", choices=("yes", "no"), help="whether the output is a driven link's neighbour"
    )
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--yes", action="store_true", help="begin even if it will be long")
    parser.add_argument("--json", action="store_true", help="an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """List or count the variants."""
    wanted = Requirements(
        links=arguments.links,
        mobility=arguments.mobility,
        prismatic=arguments.prismatic,
        rolling=arguments.rolling,
        roll_slide=arguments.roll_slide,
        assortment=assortment_of(arguments.assortment),
        multiple_joints=arguments.multiple_joints,
        drives=tuple(JointRequirement.parse(text) for text in arguments.drive),
        at_frame=tuple(_at_frame(text) for text in arguments.at_frame),
        frame_joints=arguments.frame_joints,
        output=None if arguments.output is None else JointRequirement.parse(arguments.output),
        output_at_drive={"yes": True, "no": False, None: None}[arguments.output_at_drive],
    )
    seconds = expected_seconds_of_variants(wanted, mechanisms=wanted.about_mechanisms, drives=wanted.about_drives)
    ask_before(seconds, arguments.yes)
    quiet = arguments.count or arguments.json or not sys.stdout.isatty()
    all_found = progress(variants(wanted), _PROGRESS[arguments.lang] if quiet else "")
    if arguments.count:
        number = sum(1 for _ in all_found)
        print(json.dumps({"count": number}) if arguments.json else number)
        return 0
    if arguments.json:
        items = [_item(one) for one in all_found]
        print_json({"count": len(items), "items": items})
        return 0
    number = 0
    for one in all_found:
        print(one)
        number += 1
    print(_FOUND[arguments.lang].format(n=number), file=sys.stderr)
    return 0


def _item(one: Chain | DrivenMechanism) -> dict[str, object]:
    return item(one) if isinstance(one, DrivenMechanism) else {"code": code(one), "text": str(one)}


def _at_frame(text: str) -> tuple[JointRequirement, int]:
    symbol, _, number = text.partition(":")
    if number and not number.isdecimal():
        raise GrueblerError("--at-frame {text_!r}: expected a pair, or a pair and a number such as P:2", text_=text)
    return JointRequirement.parse(f"{symbol}@frame"), int(number or 1)
