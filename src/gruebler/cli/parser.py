"""The parser of all commands: what they take, and which module runs them. It imports nothing heavy."""

from __future__ import annotations

import argparse
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NoReturn

from gruebler.cli.catalog_commands import add as add_catalog_commands
from gruebler.cli.coverage_commands import add as add_coverage_commands
from gruebler.cli.curve_commands import add as add_curve_commands
from gruebler.cli.exercise_commands import add as add_exercise_commands
from gruebler.cli.freedoms_commands import add as add_freedoms_commands
from gruebler.cli.guidance_commands import add as add_guidance_commands
from gruebler.cli.linkage_commands import add_linkage_commands
from gruebler.cli.plot_commands import add as add_plot_commands
from gruebler.cli.sheet_commands import add as add_sheet_commands
from gruebler.cli.statics_commands import add as add_statics_commands
from gruebler.cli.synthesis_commands import add as add_synthesis_commands
from gruebler.errors import nearest, shortened

__all__ = ["build_parser"]


class _Parser(argparse.ArgumentParser):
    """argparse, but wrong usage is one sentence, with the nearest known word."""

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            near = nearest(str(value)[:50], map(str, action.choices or ()))
            raise argparse.ArgumentError(action, error.message + near) from None

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        found, rest = super().parse_known_args(args, namespace)
        unknown = next((word.partition("=")[0][2:50] for word in rest if word.startswith("--")), None)
        if unknown is not None:
            names = [option[2:] for option in self._option_string_actions if option.startswith("--")]
            close = get_close_matches(unknown, names, n=1, cutoff=0.5)
            self.error(f"unrecognized arguments: {' '.join(rest)}" + "".join(f"; did you mean '--{c}'?" for c in close))
        return found, rest

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {shortened(message)} (see {self.prog} --help)\n")


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
    add_catalog_commands(commands)
    _add_enumerate(commands)
    _add_assortments(commands)
    _add_inversions(commands)
    _add_variants(commands)
    _add_assur(commands)
    _add_derive(commands)
    _add_extend(commands)
    add_linkage_commands(commands)
    add_plot_commands(commands)
    add_curve_commands(commands)
    add_guidance_commands(commands)
    add_statics_commands(commands)
    add_synthesis_commands(commands)
    add_freedoms_commands(commands)
    add_sheet_commands(commands)
    add_exercise_commands(commands)
    add_coverage_commands(commands)
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
        ".json chain or list of chains, .g6 lines, otherwise one chain a line), or - for lines on standard input",
    )
    check.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where texts live (default: planar)")
    check.add_argument("--b", type=int, metavar="B", help="motions of a free link for the count (2 for a screw group)")
    check.add_argument("--frame", metavar="LINK", help="the link that stands still (default: the first)")
    check.add_argument("--explain", action="store_true", help="say in words, step by step")
    check.add_argument("--yes", action="store_true", help="begin even if it will be long or take much memory")
    check.add_argument("--json", action="store_true", help="a list of objects, one for each chain")
    _add_language(check)
    check.set_defaults(run="gruebler.cli.check")


def _add_enumerate(commands: argparse._SubParsersAction[_Parser]) -> None:
    enumerate_ = commands.add_parser(
        "enumerate",
        help="every chain of so many links, each once",
        description="Planar chains of revolute joints without any rigid part, each once, listed or counted.",
        epilog="Example: gruebler enumerate --links 8 --count --orbits. Killed at any moment, a run with --checkpoint "
        "goes on when the same command is given again.",
    )
    enumerate_.add_argument("--links", type=int, required=True, metavar="N", help="number of links")
    enumerate_.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    enumerate_.add_argument(
        "--fractionated",
        choices=("none", "link", "joint", "all"),
        default="none",
        help="chains that do not fall apart (default), that do at a link only, at some joint, or all of them",
    )
    enumerate_.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    enumerate_.add_argument(
        "--multiple-joints", default="0", metavar="K|any", help="exactly K, K to M (K-M), or any number (default: 0)"
    )
    enumerate_.add_argument("--count", action="store_true", help="only how many, by assortment")
    enumerate_.add_argument("--orbits", action="store_true", help="with --count: inversions and driven mechanisms too")
    enumerate_.add_argument("--format", choices=("text", "graph6", "json"), help="of a list (default: text)")
    enumerate_.add_argument("-o", "--output", type=Path, metavar="FILE", help="it appears whole or not at all")
    enumerate_.add_argument("--jobs", type=int, default=1, metavar="N", help="processes (default: 1)")
    enumerate_.add_argument("--checkpoint", type=Path, metavar="DIR", help="where finished pieces are kept")
    enumerate_.add_argument("--yes", action="store_true", help="begin even if it will be long or large")
    enumerate_.add_argument("--json", action="store_true", help="the count, or the list, as JSON")
    _add_language(enumerate_)
    enumerate_.set_defaults(run="gruebler.cli.enumerate")


def _add_assortments(commands: argparse._SubParsersAction[_Parser]) -> None:
    assortments = commands.add_parser(
        "assortments",
        help="how many binary, ternary, ... links a chain can have",
        description="Number synthesis: the link assortments of closed chains of revolute joints.",
    )
    assortments.add_argument("links", type=int, metavar="N", help="number of links")
    assortments.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    assortments.add_argument("--fractionated", action="store_true", help="also degrees that only these have")
    assortments.add_argument("--multiple-joints", action="store_true", help="with joints of more than two links")
    assortments.add_argument("--count", action="store_true", help="only how many")
    assortments.add_argument("--yes", action="store_true", help="begin even if it will be long")
    assortments.add_argument("--json", action="store_true", help="an object with a list of assortments")
    _add_language(assortments)
    assortments.set_defaults(run="gruebler.cli.assortments")


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
    inversions.add_argument("--text", action="store_true", help="a mechanism a line, as other commands read it")
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
    variants.add_argument("--yes", action="store_true", help="begin even if it will be long")
    variants.add_argument("--json", action="store_true", help="an object with count and items")
    _add_language(variants)
    variants.set_defaults(run="gruebler.cli.variants")


def _add_assur(commands: argparse._SubParsersAction[_Parser]) -> None:
    assur = commands.add_parser(
        "assur",
        help="take a mechanism apart into Assur groups, or list all groups",
        description="Drives and Assur groups in solving order, with form, class and order; without a drive: how they "
        "change with it.",
        epilog="Exit status: 0 determined, 1 something stays undetermined, 2 wrong usage or unreadable input.",
    )
    assur.add_argument(
        "mechanism",
        nargs="?",
        metavar="MECHANISM",
        help="a text with '; frame=..; drive=..', a code, g6:CODE or the id of a catalog entry",
    )
    assur.add_argument("--frame", metavar="LINK", help="the link that stands still")
    assur.add_argument("--drive", action="append", default=[], metavar="JOINT", help="a driven joint; repeatable")
    assur.add_argument("--anywhere", action="store_true", help="without a drive: drives between moving links too")
    assur.add_argument("--list", type=int, metavar="N", help="all groups with N links instead")
    assur.add_argument("--count", action="store_true", help="only how many")
    assur.add_argument("--yes", action="store_true", help="with --list: begin even if it will be long")
    assur.add_argument("--json", action="store_true", help="an object with count and items")
    _add_language(assur)
    assur.set_defaults(run="gruebler.cli.assur")


def _add_derive(commands: argparse._SubParsersAction[_Parser]) -> None:
    derive = commands.add_parser(
        "derive",
        help="how a chain grows from a closed loop by dyads, or why not",
        description="The dyads in order, or the core that is left when no dyad can be taken away.",
    )
    derive.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    derive.add_argument("--json", action="store_true", help="an object with core, count, items and the derivation")
    _add_language(derive)
    derive.set_defaults(run="gruebler.cli.derive")


def _add_extend(commands: argparse._SubParsersAction[_Parser]) -> None:
    extend = commands.add_parser(
        "extend",
        help="all different chains that one more dyad or coupler gives",
        description="Each structure once, with the places that give it.",
    )
    extend.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    kind = extend.add_mutually_exclusive_group(required=True)
    kind.add_argument("--dyad", nargs="?", const="RRR", metavar="FORM", help="RRR (default), RRP, RPR, PRP or RPP")
    kind.add_argument("--coupler", nargs="?", const="RR", metavar="PAIRS", help="its two joints (default: RR)")
    extend.add_argument("--at-joints", action="store_true", help="new links may join joints that are there")
    extend.add_argument("--count", action="store_true", help="only how many")
    extend.add_argument("--json", action="store_true", help="an object with count and items")
    _add_language(extend)
    extend.set_defaults(run="gruebler.cli.extend")


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
