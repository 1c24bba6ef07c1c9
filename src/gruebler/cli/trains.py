"""`gruebler enumerate --trains`: all epicyclic gear trains with a given number of links."""

from __future__ import annotations

import argparse

from gruebler.base.errors import GrueblerError
from gruebler.base.text import translate
from gruebler.cli.output import print_json
from gruebler.cli.printed_file import printed_to_file
from gruebler.cli.tables import print_text
from gruebler.structure.enumeration import count_epicyclic_trains, epicyclic_trains
from gruebler.structure.enumeration.epicyclic import MOST_LINKS

_OTHERS = {
    "--fractionated": ("fractionated", "none"),
    "--assortment": ("assortment", None),
    "--multiple-joints": ("multiple_joints", "0"),
    "--orbits": ("orbits", False),
    "--checkpoint": ("checkpoint", None),
}
_LONG = 9  # links whose trains take more than some seconds


def trains(arguments: argparse.Namespace) -> int:
    """List the trains as chains, or count them."""
    for option, (name, none) in _OTHERS.items():
        if getattr(arguments, name) != none:
            raise GrueblerError("{option} does not go with --trains", option=option)
    if arguments.format == "graph6":
        raise GrueblerError("graph6 describes chains with simple joints only; use --format text or json")
    if _LONG <= arguments.links <= MOST_LINKS and not arguments.yes:  # more are refused, with --yes as well
        raise GrueblerError(
            "{links} links take about a minute or more; use --yes to run it anyway", links=arguments.links
        )
    arguments.json = arguments.json or arguments.format == "json"
    arguments.written = ()
    with printed_to_file(arguments):
        if arguments.count:
            _count(arguments)
        else:
            _list(arguments)
    return 0


def _count(arguments: argparse.Namespace) -> None:
    count = count_epicyclic_trains(arguments.links, arguments.mobility)
    if arguments.json:
        print_json(count._asdict())
        return
    print_text(translate("displacement graphs: {count}", arguments.lang, count=count.displacement))
    print_text(translate("rotation graphs: {count}", arguments.lang, count=count.rotation))


def _list(arguments: argparse.Namespace) -> None:
    if arguments.json:
        keys = ("a", "b", "carrier")
        print_json(
            [
                {
                    "chain": str(train.chain()),
                    "axes": train.axes,
                    "gears": [dict(zip(keys, pair, strict=True)) for pair in train.gears],
                }
                for train in epicyclic_trains(arguments.links, arguments.mobility)
            ]
        )
        return
    for train in epicyclic_trains(arguments.links, arguments.mobility):
        print(train.chain())
