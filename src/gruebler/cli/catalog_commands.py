"""The parsers of `gruebler catalog`: list, show, search. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `catalog` to the parser of all commands."""
    catalog: argparse.ArgumentParser = commands.add_parser(
        "catalog",
        help="list, show and search the machines that come with the library; every structure with given features",
        description="The machines and exercises of the seeds.",
    )
    actions = catalog.add_subparsers(
        dest="action", metavar="list|show|search", required=True, parser_class=type(catalog)
    )
    listing = actions.add_parser("list", help="all entries")
    show = actions.add_parser("show", help="one or several entries in full")
    show.add_argument("ids", nargs="+", metavar="ID")
    show.add_argument(
        "--full",
        action="store_true",
        help="with all that is derived: mobility with its derivation, what really moves, features, measures, paths",
    )
    for action in (listing, show):
        _finish(action, "catalog")
    _add_search(actions)


def _add_search(actions: Any) -> None:
    search: argparse.ArgumentParser = actions.add_parser(
        "search",
        help="machines with given words and access features; or every structure that has them",
        description="Machines of the catalog with given words and access features: drives, output links, links and "
        "joints with their numbers. With --enumerate every planar mechanism with these features, each once.",
        epilog="Example: gruebler catalog search --links 4 --drives 1 --drives-at-frame 1 --output-links-at-frame 0 "
        "--pairs D:4 --binary 4; gruebler catalog search --enumerate --links 6 --pairs S:1 --drives 1 --limit 20. "
        "Exit status: 0, 2 wrong usage or features that contradict each other.",
    )
    search.add_argument("words", nargs="*", metavar="WORD", help="must occur in a name, remark, source or link")
    search.add_argument("--text", action="append", default=[], metavar="WORD", help="another such word; repeatable")
    _add_features(search)
    search.add_argument("--joints", type=int, metavar="G", help="number of joints, multiple ones counted k - 1 times")
    search.add_argument("--pair", action="append", default=[], metavar="P", help="symbol or name of a pair; repeatable")
    search.add_argument("--drive", metavar="P", help="symbol or name of a driven pair")
    search.add_argument("--claims", action="store_true", help="only where what really moves differs from the count")
    search.add_argument("--enumerate", action="store_true", help="every structure, not only the machines")
    search.add_argument("--yes", action="store_true", help="with --enumerate: begin even if it will be long")
    search.add_argument("--limit", type=int, metavar="N", help="with --enumerate: end after so many")
    search.add_argument("--count", action="store_true", help="only how many")
    _finish(search, "search")


def _add_features(search: argparse.ArgumentParser) -> None:
    for options, metavar, told in (
        (("--links",), "N", "number of links"),
        (("--mobility", "--F"), "F", "F by the count (with --enumerate 1 if left out)"),
        (("--drives",), "N", "number of drive joints"),
        (("--drives-at-frame",), "N", "so many of them at the frame"),
        (("--outputs",), "N", "number of output links"),
        (("--output-links-at-frame",), "N", "so many of them jointed to the frame"),
    ):
        search.add_argument(*options, type=int, metavar=metavar, help=told)
    search.add_argument("--pairs", metavar="D:4,S:0", help="exactly so many joints of these kinds, in one alphabet")
    for name in ("binary", "ternary", "quaternary"):
        search.add_argument(f"--{name}", type=int, metavar="N", help=f"number of {name} links")
    search.add_argument("--link-kinds", metavar="N2,N3,...", help="numbers of binary, ternary, ... links, no others")
    search.add_argument("--multiple-joints", type=int, metavar="K", help="exactly so many joints of 3 and more links")


def _finish(parser: argparse.ArgumentParser, module: str) -> None:
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language of the output (default: en)")
    parser.set_defaults(run=f"gruebler.cli.{module}")
