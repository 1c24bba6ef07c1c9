"""`gruebler assortments`: how many binary, ternary, ... links a chain can have."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator

from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_long_table, print_table
from gruebler.enumeration import (
    assortment_number,
    each_assortment,
    each_joint_assortment,
    joint_assortment_number,
    largest_degree,
)
from gruebler.errors import GrueblerError

__all__ = ["add", "run"]

_LINKS = {
    "en": ("binary", "ternary", "quaternary"),
    "de": ("binär", "ternär", "quaternär"),
}
_MORE = {"en": "{k} joints", "de": "{k} Gelenke"}
_JOINTS = {"en": "joints of {k}", "de": "Gelenke zu {k}"}
_NONE = {
    "en": "No closed chain of {n} links has mobility {f}.",
    "de": "Keine geschlossene Kette aus {n} Gliedern hat den Laufgrad {f}.",
}
_LONG = {
    "en": "{number} assortments; say --yes to list them nevertheless, or --count for their number",
    "de": "{number} Aufteilungen; mit --yes werden sie trotzdem aufgezählt, mit --count nur gezählt",
}
_LONG_COUNT = {
    "en": "counting takes more than a minute with so many links; say --yes to begin it nevertheless",
    "de": "bei so vielen Gliedern dauert das Zählen über eine Minute; mit --yes wird trotzdem begonnen",
}
_MORE_THAN = {"en": "more than 10^{power}", "de": "mehr als 10^{power}"}

_MANY = 1_000_000  # assortments that are listed without being asked again: about a minute
_COUNTED_QUICKLY = 300_000  # links above the mobility: about half a minute and 100 MB
_NUMBERED_AT_ONCE = 2_000  # links: the number of assortments grows with the links, so this one bounds the later ones
_TABLE = 10_000  # rows that a terminal gets as one drawn table

_Row = tuple[tuple[int, ...], tuple[int, ...]]


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Number synthesis: the link assortments of closed chains of revolute joints.",
    )
    parser.add_argument("links", type=int, metavar="N", help="number of links")
    parser.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    parser.add_argument("--fractionated", action="store_true", help="also degrees that only these have")
    parser.add_argument("--multiple-joints", action="store_true", help="with joints of more than two links")
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--yes", action="store_true", help="begin even if it will be long")
    parser.add_argument("--json", action="store_true", help="an object with a list of assortments")


def run(arguments: argparse.Namespace) -> int:
    """Print the link assortments, with the joint assortments if multiple joints are allowed."""
    n, f, lang = arguments.links, arguments.mobility, arguments.lang
    number = joint_assortment_number if arguments.multiple_joints else assortment_number
    if arguments.count:
        if n - f > _COUNTED_QUICKLY and not arguments.yes:
            raise GrueblerError(_LONG_COUNT[lang])
        count = number(n, f, fractionated=arguments.fractionated)
        print(json.dumps({"links": n, "mobility": f, "count": count}) if arguments.json else count)
        return 0
    degree = largest_degree(n, f, fractionated=arguments.fractionated)
    # Two links more are one loop more; so many fewer leave a chain of the same mobility.
    fewer = max(0, n - max(_NUMBERED_AT_ONCE, f + 3)) // 2
    count = number(n - 2 * fewer, f, fractionated=arguments.fractionated)
    if count > _MANY and not arguments.yes:
        told = _MORE_THAN[lang].format(power=len(str(count)) - 1) if fewer else f"{count:,}"
        raise GrueblerError(_LONG[lang].format(number=told))
    if arguments.json:
        _print_json(arguments)
    elif degree is None:
        print(_NONE[lang].format(n=n, f=f))
    else:
        _print(arguments, degree, count)
    return 0


def _rows(arguments: argparse.Namespace) -> Iterator[_Row]:
    n, f, fractionated = arguments.links, arguments.mobility, arguments.fractionated
    if arguments.multiple_joints:
        yield from each_joint_assortment(n, f, fractionated=fractionated)
    else:
        for links in each_assortment(n, f, fractionated=fractionated):
            yield links, ()


def _print_json(arguments: argparse.Namespace) -> None:
    """One object on one line, written as the assortments come."""
    print(f'{{"links": {arguments.links}, "mobility": {arguments.mobility}, "assortments": [', end="")
    for k, (links, joints) in enumerate(_rows(arguments)):
        item = {"links": links, "joints": joints} if arguments.multiple_joints else links
        print(", " * (k > 0) + json.dumps(item), end="")
    print("]}")


def _print(arguments: argparse.Namespace, degree: int, count: int) -> None:
    lang = arguments.lang
    # A link of the largest degree, or a joint of as many links, occurs in some assortment.
    columns = degree - 1
    headers = [_LINKS[lang][i] if i < 3 else _MORE[lang].format(k=i + 2) for i in range(columns)]
    if arguments.multiple_joints:
        headers += [_JOINTS[lang].format(k=k + 2) for k in range(columns)]
    rows = (
        (*_filled(links, columns), *(_filled(joints, columns) if arguments.multiple_joints else ()))
        for links, joints in _rows(arguments)
    )
    if count <= _TABLE:
        print_table(headers, [[str(k) for k in row] for row in rows], numbers=range(len(headers)))
    else:
        print_long_table(headers, rows, 3 * arguments.links)


def _filled(numbers: tuple[int, ...], width: int) -> tuple[int, ...]:
    return numbers + (0,) * (width - len(numbers))
