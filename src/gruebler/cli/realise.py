"""`gruebler realise`: dimensions for a mechanism, found by a search."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace

from gruebler.base.errors import GrueblerError
from gruebler.cli.inputs import mechanism_of, outputs_of
from gruebler.cli.link_names import language_of_names
from gruebler.cli.output import print_json, say_written
from gruebler.cli.parser import Parser
from gruebler.design.realisation import Realisation, realise
from gruebler.files.linkages import linkage_to_json, linkage_to_toml, write_linkage


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Find dimensions with which a mechanism can be assembled and its drives turn fully or move over a "
        "wide range. Without --drive, revolute joints on the frame are driven if possible.",
        epilog="Exit status: 0 found, 1 none found or nothing can move, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        chain
        --frame
        --drive
        --seed S int =0  seed of the random numbers (default: 0)
        --tries N int =1500  number of layouts the search tries (default: 1500)
        """
    )
    parser.add_out(help="write the linkage to a file: .toml or .json", endings=("toml", "json"))
    parser.add_json(help="print an object with the linkage, ranges and quality")


def run(arguments: argparse.Namespace) -> int:
    """Find dimensions and print or write them. Status 1: none were found."""
    if arguments.tries < 1:
        raise GrueblerError("--tries: expected a whole number of at least 1, but found {found}", found=arguments.tries)
    mechanism = mechanism_of(arguments.chain, arguments.frame, arguments.drive, language_of_names(arguments))
    realisation = realise(mechanism, seed=arguments.seed, budget=arguments.tries)
    if realisation.linkage is not None and (outputs := outputs_of(arguments.chain, language_of_names(arguments))):
        realisation = replace(realisation, linkage=realisation.linkage.with_outputs(outputs))
    if realisation.linkage is not None and arguments.out is not None:
        write_linkage(arguments.out, realisation.linkage)
        say_written(arguments.out, arguments.lang)
    if arguments.json:
        print_json(_document(realisation, arguments.lang))
        return 0 if realisation.found else 1
    print(realisation.explain(arguments.lang))
    if realisation.linkage is not None and arguments.out is None:
        print("\n" + linkage_to_toml(realisation.linkage).rstrip())
    return 0 if realisation.found else 1


def _document(realisation: Realisation, lang: str) -> dict[str, object]:
    document: dict[str, object] = {
        "found": realisation.found,
        "mechanism": realisation.mechanism.text(),
        "message": realisation.explain(lang),
        "seed": realisation.seed,
        "tries": realisation.tries,
    }
    if realisation.linkage is not None:
        span = realisation.span
        document |= {
            "full": realisation.full,
            "quality": realisation.quality,
            "drives": [
                {"joint": name}
                | _range("range", None if span is None else (span.low, span.high), turns)
                | _range("well_conditioned", ends, turns)
                for name, ends, turns in zip(
                    realisation.mechanism.drive_names(),
                    realisation.ranges,
                    [drive.turning for drive in realisation.mechanism.drives],
                    strict=True,
                )
            ],
            "linkage": linkage_to_json(realisation.linkage),
        }
    return document


def _range(key: str, ends: tuple[float, float] | None, turns: bool) -> dict[str, object]:
    """A range under its key; angles in degrees, None if it is not known."""
    return {f"{key}_deg" if turns else key: ends and [math.degrees(v) if turns else v for v in ends]}
