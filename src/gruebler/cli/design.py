"""`gruebler design`: from a specification to machines of several types, the best of them side by side."""

from __future__ import annotations

import argparse
import warnings
from dataclasses import replace
from typing import Any

from gruebler.base.errors import UnitWarning
from gruebler.base.text import Message, message, translate
from gruebler.cli.design_files import check_picture, design_to_write, draw_designs
from gruebler.cli.design_tables import print_notes, print_pareto
from gruebler.cli.executors import executor_of
from gruebler.cli.long_work import count_line
from gruebler.cli.output import print_json, say_written
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table
from gruebler.design.synthesis.proposals import Proposals, TriedType, propose
from gruebler.design.synthesis.tasks import DwellTask
from gruebler.files.designs import result_to_json
from gruebler.files.linkages import write_linkage
from gruebler.files.specifications import read_specification
from gruebler.structure.mechanism.inversion import family

_TYPES = (message("type"), message("links"), message("designs"), message("why none"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="From what a machine has to do to machines: all types of mechanism that can do it are made for the "
        "task and judged by their motion; the designs that no other one beats in error, transmission angle, size and "
        "number of links are listed.",
        epilog="A specification is a task file with more keys: links, sliding_joints, [demands], [[clear]]. Exit "
        "status: 0 there is a design, 1 there is none, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        task TASK  a .toml or .json file; a .csv file has the task alone
        --links N int  largest number of links, 4 or 6 (default: that of the file, else 6)
        --sliding-joints N int  largest number of sliding joints (default: that of the file, else what the output needs)
        --initial-designs N int =2  improve N initial designs of each mechanism of more than four links (default: 2)
        --jobs N int =1  number of processes (default: 1)
        --scheduler
        """
    )
    parser.add_json(help="print an object with all linkages")
    parser.add_out(help="write the best linkage to a file: .toml or .json", endings=("toml", "json"))
    parser.take(
        """
        --design =1
        --draw FILE path  draw the designs: .html all, moving; .svg, .png or .pdf the best six
        """
    )


def run(arguments: argparse.Namespace) -> int:
    """Try all types, print what came of them, write and draw the best. Status 1: no design was accepted."""
    with warnings.catch_warnings(action="ignore", category=UnitWarning):  # angles of files are degrees
        return _run(arguments)


def _run(arguments: argparse.Namespace) -> int:
    if arguments.draw is not None:
        check_picture(arguments.draw)
    specification = read_specification(arguments.task)
    given = {"links": arguments.links, "sliding_joints": arguments.sliding_joints}
    specification = replace(specification, **{name: value for name, value in given.items() if value is not None})
    proposals = propose(
        specification,
        starts=arguments.initial_designs,
        executor=executor_of(arguments),
        progress=count_line(message("types tried: {done:,} of {count:,}"), arguments.lang),
    )
    best = proposals.result
    if (written := design_to_write(arguments, best)) is not None:
        write_linkage(arguments.out, written.linkage)
        say_written(arguments.out, arguments.lang)
    if arguments.draw is not None and best.designs:
        draw_designs(arguments.draw, best, arguments.lang, clear=specification.clear)
    if arguments.json:
        print_json(_document(proposals))
    else:
        _print(proposals, arguments.lang)
    return 0 if best.designs else 1


def _document(proposals: Proposals) -> dict[str, Any]:
    types = [
        {
            "mechanism": None if each.mechanism is None else each.mechanism.text(),
            "designs": len(each.result.designs),
            "rejected": len(each.result.rejected),
            "reason": None if each.reason is None else str(each.reason),
        }
        for each in proposals.tried
    ]
    return {"types": types, **result_to_json(proposals.result)}


def _print(proposals: Proposals, lang: str) -> None:
    print_table(_TYPES, [_type_row(each, lang) for each in proposals.tried], numbers=[1, 2], lang=lang)
    if proposals.best:
        print_pareto(proposals.result, lang)
        print_notes(proposals.result, lang)
    else:
        print(translate("None of the designs examined meets the task.", lang))


def _type_row(each: TriedType, lang: str) -> list[Cell]:
    name: Message | str
    if each.mechanism is not None:
        known = family(each.mechanism, lang)
        name = f"{known}: {each.mechanism.text()}" if known else each.mechanism.text()
        links = len(each.mechanism.chain.links)
    elif isinstance(each.result.task, DwellTask):
        name, links = message("four-bars with a rod to the output"), 6
    else:
        name, links = message("four-bars and slider-cranks"), 4
    return [name, str(links), str(len(each.result.designs)), each.reason or ""]
