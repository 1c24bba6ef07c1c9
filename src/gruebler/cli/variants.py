"""`gruebler variants`: every typed chain or mechanism that answers a set of requirements."""

from __future__ import annotations

import argparse
import sys

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, translate
from gruebler.cli.executors import executor_of
from gruebler.cli.inputs import assortment_of
from gruebler.cli.inversions import item
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_count, print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration import Request
from gruebler.structure.isomorphism import code
from gruebler.structure.mechanism.inversion import DrivenMechanism
from gruebler.structure.type_synthesis import (
    JointRequirement,
    Requirements,
    count_sliding_variants,
    expected_seconds_of_variants,
    variants,
)
from gruebler.structure.type_synthesis.estimates import expected_seconds_of_sliding


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Every typed chain that meets the requirements, each once; mechanisms if a requirement concerns "
        "frame, drive or output. PAIR@PLACE: the symbol or name of a pair (empty for any), and frame, moving or any.",
        epilog="Example: gruebler variants --links 6 --prismatic 1 --drive-joint R@frame --at-frame P --count",
    )
    parser.take(
        """
        --links !
        --mobility
        --prismatic K|any =0  number of sliding joints (default: 0); any, with --count: the numbers for every K
        --rolling K int =0  number of rolling joints (default: 0)
        --roll-slide K int =0  number of gear and cam contacts (default: 0)
        --multiple-joints K int =0  number of multiple joints (default: 0)
        --assortment
        --frame-joints K int  number of joints on the frame
        --at-frame PAIR[:K] ...  at least K such joints (1) on the frame
        --drive-joint PAIR@PLACE ...  a driven joint; once per drive
        --output-joint PAIR@PLACE  a joint of the output link; @moving: not on the frame
        --output-at-drive {yes,no}  whether the output link is next to a driven link
        --count  only the number
        --jobs
        --scheduler
        --yes
        """
    )
    parser.add_printed(help="print an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """List or count the variants."""
    arguments.prismatic = _number_or_any(arguments.prismatic)
    wanted = Requirements(
        links=arguments.links,
        mobility=arguments.mobility,
        prismatic=0 if arguments.prismatic == "any" else arguments.prismatic,
        rolling=arguments.rolling,
        roll_slide=arguments.roll_slide,
        assortment=assortment_of(arguments.assortment),
        multiple_joints=arguments.multiple_joints,
        drives=tuple(JointRequirement.parse(text) for text in arguments.drive_joint),
        at_frame=tuple(_at_frame(text) for text in arguments.at_frame),
        frame_joints=arguments.frame_joints,
        output=None if arguments.output_joint is None else JointRequirement.parse(arguments.output_joint),
        output_at_drive={"yes": True, "no": False, None: None}[arguments.output_at_drive],
    )
    if arguments.count and arguments.prismatic and _only_sliding(wanted):
        return _count_sliding(wanted, arguments)
    if arguments.prismatic == "any":
        raise GrueblerError("--prismatic any goes with --count and with --links, --mobility and --multiple-joints only")
    seconds = expected_seconds_of_variants(wanted, mechanisms=wanted.about_mechanisms, drives=wanted.about_drives)
    ask_before(seconds / max(1, arguments.jobs), arguments.yes)
    quiet = arguments.count or arguments.json or not sys.stdout.isatty()
    words = message("{n} found, {seconds:.0f} s").in_language(arguments.lang) if quiet else ""
    candidates = progress(variants(wanted, executor=executor_of(arguments)), words)
    if arguments.count:
        print_count(arguments, sum(1 for _ in candidates))
    elif arguments.json:
        items = [_item(each) for each in candidates]
        print_json({"count": len(items), "items": items})
    else:
        count = 0
        for count, each in enumerate(candidates, 1):  # noqa: B007  the last count is printed
            print(each)
        print(translate("{count} found.", arguments.lang, count=count), file=sys.stderr)
    return 0


def _number_or_any(text: str) -> int | str:
    """The value of --prismatic."""
    if text == "any":
        return text
    try:
        return int(text)
    except ValueError:
        raise GrueblerError("--prismatic: expected a whole number or any, but found {value!r}", value=text) from None


def _only_sliding(wanted: Requirements) -> bool:
    """Whether nothing is asked of the chains but numbers of links, freedoms, sliding and multiple joints."""
    plain = Requirements(
        links=wanted.links, mobility=wanted.mobility, prismatic=wanted.prismatic, multiple_joints=wanted.multiple_joints
    )
    return wanted == plain and wanted.links >= 3 and wanted.prismatic >= 0


def _count_sliding(wanted: Requirements, arguments: argparse.Namespace) -> int:
    ask_before(expected_seconds_of_sliding(wanted) / max(1, arguments.jobs), arguments.yes)
    request = Request(
        wanted.links,
        mobility=wanted.mobility,
        fractionated="all",
        assortment=None,
        multiple_joints=wanted.multiple_joints,
    )
    numbers = count_sliding_variants(request, executor=executor_of(arguments))
    if arguments.prismatic == "any":
        if arguments.json:
            print_json({"counts": dict(enumerate(numbers))}, indent=None)
        else:
            headers = [translate("sliding joints", arguments.lang), translate("chains", arguments.lang)]
            print_table(headers, [(str(k), str(number)) for k, number in enumerate(numbers)], numbers=(0, 1))
        return 0
    print_count(arguments, numbers[wanted.prismatic] if wanted.prismatic < len(numbers) else 0)
    return 0


def _item(variant: Chain | DrivenMechanism) -> dict[str, object]:
    return item(variant) if isinstance(variant, DrivenMechanism) else {"code": code(variant), "text": str(variant)}


def _at_frame(text: str) -> tuple[JointRequirement, int]:
    symbol, _, count = text.partition(":")
    if count and not count.isdecimal():
        raise GrueblerError(
            "--at-frame: expected a pair, or a pair and a number such as P:2, but found {found!r}", found=text
        )
    return JointRequirement.parse(f"{symbol}@frame"), int(count or 1)
