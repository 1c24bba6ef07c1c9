"""The command line: the only room that reads files, prints, and knows exit statuses.

0: all is well; 1: something asked about is not so (a claim fails); 2: wrong usage or unreadable input, said in one
sentence on standard error.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from gruebler.errors import GrueblerError

__all__ = ["main"]


class _Parser(argparse.ArgumentParser):
    """argparse, but wrong usage is one sentence."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands; it imports nothing heavy, so that --help comes at once."""
    from gruebler import __version__

    parser = _Parser(
        prog="gruebler",
        description="Structural synthesis of mechanisms: count degrees of freedom and check the count.",
    )
    parser.add_argument("--version", action="version", version=f"gruebler {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=_Parser)
    _add_check(commands)
    _add_catalog(commands)
    _add_inversions(commands)
    _add_variants(commands)
    _add_demo(commands)
    return parser


def _add_check(commands: argparse._SubParsersAction[_Parser]) -> None:
    check = commands.add_parser(
        "check",
        help="count the freedoms of chains and check the count",
        description="Count the freedoms of chains, check the count and name what is wrong. Without an argument: "
        "every machine and exercise of the catalog.",
        epilog="Exit status: 0 all good, 1 a claim of an entry fails, 2 wrong usage or unreadable input.",
    )
    check.add_argument(
        "chains",
        nargs="*",
        metavar="CHAIN|ID|FILE",
        help="a text such as 'R(0-1) R(1-2) R(2-3) R(3-0)', g6:CODE, the id of a catalog entry, a file (.toml entry, "
        ".json chain or list of chains, otherwise one chain a line), or - for lines on standard input",
    )
    check.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where texts live (default: planar)")
    check.add_argument("--b", type=int, metavar="B", help="motions of a free link for the count (2 for a screw group)")
    check.add_argument("--frame", metavar="LINK", help="the link that stands still (default: the first)")
    check.add_argument("--explain", action="store_true", help="say in words, step by step")
    check.add_argument("--json", action="store_true", help="a list of objects, one for each chain")
    _add_language(check)
    check.set_defaults(run="gruebler.cli.check")


def _add_catalog(commands: argparse._SubParsersAction[_Parser]) -> None:
    catalog = commands.add_parser(
        "catalog",
        help="list, show and search the machines that come with the library",
        description="The machines and exercises of the seeds.",
    )
    catalog.set_defaults(run="gruebler.cli.catalog")
    actions = catalog.add_subparsers(dest="action", metavar="list|show|search", required=True, parser_class=_Parser)
    listing = actions.add_parser("list", help="all entries")
    show = actions.add_parser("show", help="one or several entries in full")
    show.add_argument("ids", nargs="+", metavar="ID")
    search = actions.add_parser("search", help="entries with given words and numbers")
    search.add_argument("words", nargs="*", metavar="WORD", help="must occur in a name, remark, source or link")
    search.add_argument("--links", type=int, metavar="N", help="number of links")
    search.add_argument("--joints", type=int, metavar="G", help="number of joints, multiple ones counted k - 1 times")
    search.add_argument("--mobility", type=int, metavar="F", help="F by the count")
    search.add_argument("--pair", action="append", default=[], metavar="P", help="symbol or name of a pair; repeatable")
    search.add_argument("--drive", metavar="P", help="symbol or name of a driven pair")
    for action in (listing, show, search):
        action.add_argument("--json", action="store_true", help="as JSON")
        _add_language(action)


def _add_inversions(commands: argparse._SubParsersAction[_Parser]) -> None:
    inversions = commands.add_parser(
        "inversions",
        help="the mechanisms that a chain gives with another frame or drive",
        description="One mechanism for each orbit of frames, or of frames and drives, under the chain's symmetry.",
    )
    inversions.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    inversions.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where a text lives")
    inversions.add_argument("--drives", action="store_true", help="driven mechanisms: frame and drive")
    inversions.add_argument("--anywhere", action="store_true", help="drives between moving links too")
    inversions.add_argument("--number", type=int, default=1, metavar="D", help="so many drives (default: 1)")
    inversions.add_argument("--output", action="store_true", help="choose an output link too")
    inversions.add_argument("--count", action="store_true", help="only how many")
    inversions.add_argument("--json", action="store_true", help="an object with count and items")
    _add_language(inversions)
    inversions.set_defaults(run="gruebler.cli.inversions")


def _add_variants(commands: argparse._SubParsersAction[_Parser]) -> None:
    variants = commands.add_parser(
        "variants",
        help="every typed chain or mechanism that answers requirements",
        description="Every typed chain that answers the requirements, each once; mechanisms where something is asked "
        "of frame, drive or output. PAIR@PLACE is a symbol or name of a pair (or nothing for any), and frame, moving "
        "or any.",
        epilog="Example: gruebler variants --links 6 --prismatic 1 --drive R@frame --at-frame P --count",
    )
    variants.add_argument("--links", type=int, required=True, metavar="N", help="number of links")
    variants.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    variants.add_argument("--prismatic", type=int, default=0, metavar="K", help="exactly so many sliding joints")
    variants.add_argument("--rolling", type=int, default=0, metavar="K", help="exactly so many rolling joints")
    variants.add_argument("--roll-slide", type=int, default=0, metavar="K", help="exactly so many gear or cam contacts")
    variants.add_argument("--multiple-joints", type=int, default=0, metavar="K", help="exactly so many multiple joints")
    variants.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    variants.add_argument("--frame-joints", type=int, metavar="K", help="joints on the frame: 3 for a ternary one")
    variants.add_argument("--at-frame", action="append", default=[], metavar="PAIR[:K]", help="at least K at the frame")
    variants.add_argument("--drive", action="append", default=[], metavar="PAIR@PLACE", help="one for each drive")
    variants.add_argument("--output", metavar="PAIR@PLACE", help="the output link's joint; @moving: not at the frame")
    variants.add_argument(
        "--output-at-drive", choices=("yes", "no"), help="whether the output is a driven link's neighbour"
    )
    variants.add_argument("--count", action="store_true", help="only how many")
    variants.add_argument("--json", action="store_true", help="an object with count and items")
    _add_language(variants)
    variants.set_defaults(run="gruebler.cli.variants")


def _add_demo(commands: argparse._SubParsersAction[_Parser]) -> None:
    demo = commands.add_parser(
        "demo",
        help="check the whole catalog and explain four machines",
        description="Check the whole catalog and explain a V-compressor, a differential, a locomotive and a braced "
        "four-bar.",
    )
    _add_language(demo)
    demo.set_defaults(run="gruebler.cli.demo")


def _add_language(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language of the output (default: en)")


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    arguments = build_parser().parse_args(argv)
    from importlib import import_module

    try:
        status = int(import_module(arguments.run).run(arguments))
        sys.stdout.flush()
    except GrueblerError as error:
        print(f"gruebler {arguments.command}: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader has gone (| head): what is still buffered has nowhere to go.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        print("\ngruebler: stopped", file=sys.stderr)
        return 130
    return status
