"""`gruebler inversions`: the mechanisms that a chain gives with another frame, or with another frame and drive."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from gruebler.cli.inputs import chain_from_word
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.mechanism.inversion import DrivenMechanism, driven_mechanisms, family, inversions

__all__ = ["add", "item", "run"]

_HEADERS = {
    "en": {"frame": "frame", "drive": "drive", "output": "output", "family": "family"},
    "de": {"frame": "Gestell", "drive": "Antrieb", "output": "Abtrieb", "family": "Familie"},
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="One mechanism for each orbit of frames, or of frames and drives, under the chain's symmetry.",
    )
    parser.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    parser.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where a text lives")
    parser.add_argument("--drives", action="store_true", help="driven mechanisms: frame and drive")
    parser.add_argument("--anywhere", action="store_true", help="drives between moving links too")
    parser.add_argument("--number", type=int, default=1, metavar="D", help="so many drives (default: 1)")
    parser.add_argument("--output", action="store_true", help="choose an output link too")
    parser.add_argument("--text", action="store_true", help="a mechanism a line, as other commands read it")
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--json", action="store_true", help="an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """List or count the inversions of one chain."""
    chain = chain_from_word(arguments.chain, arguments.space)
    if not arguments.drives:
        for option, given in (
            ("--output", arguments.output),
            ("--anywhere", arguments.anywhere),
            ("--number", arguments.number != 1),
        ):
            if given:
                raise GrueblerError("{option} goes with --drives: it is said of a driven mechanism", option=option)
    if arguments.drives:
        drivens = list(
            driven_mechanisms(chain, drives=arguments.number, at_frame=not arguments.anywhere, output=arguments.output)
        )
    else:
        drivens = [DrivenMechanism(mechanism) for mechanism in inversions(chain)]
    if arguments.json:
        document: dict[str, object] = {"count": len(drivens)}
        if not arguments.count:
            document["items"] = [item(driven) for driven in drivens]
        print_json(document)
    elif arguments.count:
        print(len(drivens))
    elif arguments.text:
        for driven in drivens:
            print(driven)
    else:
        _print(drivens, arguments.lang)
    return 0


def item(driven: DrivenMechanism) -> dict[str, object]:
    """One item of a JSON list: code, text, and family and output if there are any."""
    mechanism = driven.mechanism
    out: dict[str, object] = {"code": mechanism.code(), "text": driven.text()}
    if (name := family(mechanism)) is not None:
        out["family"] = name
    if driven.output is not None:
        out["output"] = driven.output
    return out


def _row(driven: DrivenMechanism, lang: str) -> dict[str, str]:
    mechanism = driven.mechanism
    return {
        "frame": mechanism.frame,
        "drive": ", ".join(mechanism.drive_names()),
        "output": driven.output or "",
        "family": family(mechanism, lang) or "",
    }


def _print(found: Sequence[DrivenMechanism], lang: str) -> None:
    """The table, without a column that is empty in every row."""
    rows = [_row(driven, lang) for driven in found]
    keys = [key for key in _HEADERS[lang] if key == "frame" or any(row[key] for row in rows)]
    print_table([_HEADERS[lang][key] for key in keys], [[row[key] for key in keys] for row in rows])
