"""`gruebler freedoms`: mobility with dimensions."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from gruebler.catalog import entries
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_text
from gruebler.errors import GrueblerError
from gruebler.formats import read_entry
from gruebler.linkages import Linkage
from gruebler.screws import SpatialLinkage, freedoms

__all__ = ["add", "run"]


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Mobility of a linkage with its dimensions, in a plane, on a sphere or in space: by formula, for "
        "almost all sizes, at a pose (rank, redundant joints) and finite (velocities followed), with the geometric "
        "reason where it is known.",
        epilog="Examples: gruebler freedoms winch_screw; gruebler freedoms four-bar:2,5,2,5 --at 0. Exit status: 0 it "
        "moves, 1 it does not (rigid, or only shaky), 2 wrong usage or unreadable input.",
    )
    parser.add_argument(
        "linkage",
        metavar="FILE|ID|LENGTHS",
        help="a .toml or .json file with sizes or joint screws, a catalog entry that has either, or "
        "four-bar:A,B,C,D, slider-crank:A,B[,E], inverted-slider-crank:A,D[,E]",
    )
    parser.add_argument(
        "--at",
        action="append",
        type=float,
        metavar="VALUE",
        help="the pose at this drive value, in degrees or the unit, of joint screws counted from home; for several "
        "drives once each (default: home, else a regular pose)",
    )
    parser.add_argument("--branch", metavar="B", help="the assembly mode, such as +-; write --branch=- for minus")
    parser.add_argument(
        "--tolerance",
        type=float,
        default=1e-8,
        metavar="T",
        help="singular values below that times the largest count as zero (default: 1e-8)",
    )
    parser.add_argument("--json", action="store_true", help="as JSON, with all singular values")


def run(arguments: argparse.Namespace) -> int:
    """Print the report; 1 if nothing moves."""
    linkage = _linkage(arguments.linkage)
    found = freedoms(linkage, at=_pose(linkage, arguments.at), branch=arguments.branch, tolerance=arguments.tolerance)
    if arguments.json:
        print_json({"linkage": arguments.linkage, **found.to_json()})
    else:
        print_text(found.explain(arguments.lang))
    return int(found.mobility == 0)


def _linkage(word: str) -> Linkage | SpatialLinkage:
    path = Path(word)
    if word in entries() and not path.is_file():
        record = entries()[word]
    elif path.suffix.lower() in (".toml", ".json") and path.is_file():
        from gruebler.documents import load_document
        from gruebler.formats.screws import read_any_linkage

        document = load_document(path, lambda text: GrueblerError("{path}: {text_}", path=path, text_=text))
        if not (isinstance(document, dict) and "id" in document):
            return read_any_linkage(path)
        record = read_entry(path)
    else:
        return linkage_of(word)[0]
    made = record.placed()
    if made is None and record.dimensions is not None:
        raise GrueblerError(
            "the belts, cams and non-circular wheels of {word!r} have no place in this report; its joints "
            "may be given by screws ([screws] in its file), and gruebler check counts it",
            word=word,
        )
    if made is None:
        placed = [entry.id for entry in entries().values() if entry.dimensions is not None or entry.screws is not None]
        raise GrueblerError(
            "the catalog entry {word!r} has no dimensions; these have: {placed}", word=word, placed=", ".join(placed)
        )
    return made


def _pose(linkage: Linkage | SpatialLinkage, at: list[float] | None) -> list[float] | None:
    """The drive values in radians where they are angles."""
    if at is None:
        return None
    turns = [drive.turning for drive in linkage.mechanism.drives]
    turns += [False] * (len(at) - len(turns))
    return [math.radians(value) if angle else value for value, angle in zip(at, turns, strict=False)]
