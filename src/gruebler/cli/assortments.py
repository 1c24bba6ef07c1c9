"""`gruebler enumerate --assortments`: how many binary, ternary, ... links a chain can have."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from typing import NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.base.text import arity, message, translate
from gruebler.cli.tables import print_long_table, print_table
from gruebler.structure.enumeration import (
    assortment_number,
    each_assortment,
    each_joint_assortment,
    joint_assortment_number,
    largest_degree,
)

_MANY = 1_000_000  # assortments that are listed without being asked again: about a minute
_COUNTED_QUICKLY = 300_000  # links above the mobility: about half a minute and 100 MB
_NUMBERED_AT_ONCE = 2_000  # links: the number of assortments grows with the links, so this one bounds the later ones
_NAMED = 4  # joints of the largest link whose header is its name
_TABLE = 10_000  # rows that a terminal gets as one drawn table


class _Wanted(NamedTuple):
    links: int
    mobility: int
    fractionated: bool
    multiple_joints: bool


_Row = tuple[tuple[int, ...], tuple[int, ...]]


def print_assortments(arguments: argparse.Namespace) -> int:
    """Print the link assortments, with the joint assortments if multiple joints are allowed."""
    n, f, lang = arguments.links, arguments.mobility, arguments.lang
    for option in ("assortment", "orbits", "format", "checkpoint"):
        if getattr(arguments, option):
            raise GrueblerError("--{option} does not go with --assortments", option=option)
    wanted = _Wanted(n, f, arguments.fractionated != "none", arguments.multiple_joints != "0")
    number = joint_assortment_number if wanted.multiple_joints else assortment_number
    if arguments.count:
        if n - f > _COUNTED_QUICKLY and not arguments.yes:
            raise GrueblerError("counting them takes more than a minute; use --yes to run it anyway")
        count = number(n, f, fractionated=wanted.fractionated)
        print(json.dumps({"links": n, "mobility": f, "count": count}) if arguments.json else count)
        return 0
    degree = largest_degree(n, f, fractionated=wanted.fractionated)
    # Two links more are one loop more; so many fewer leave a chain of the same mobility.
    fewer = max(0, n - max(_NUMBERED_AT_ONCE, f + 3)) // 2
    count = number(n - 2 * fewer, f, fractionated=wanted.fractionated)
    if count > _MANY and not arguments.yes:
        extent = (
            message("more than 10^{power} assortments", power=len(str(count)) - 1)
            if fewer
            else message("{count:,} assortments", count=count)
        )
        raise GrueblerError("{extent}; use --yes to list them anyway, or --count for their number", extent=extent)
    if arguments.json:
        _print_json(wanted)
    elif degree is None:
        print(translate("No closed chain of {links} links has mobility {mobility}.", lang, links=n, mobility=f))
    else:
        _print(wanted, degree, count, lang)
    return 0


def _rows(wanted: _Wanted) -> Iterator[_Row]:
    n, f, fractionated = wanted.links, wanted.mobility, wanted.fractionated
    if wanted.multiple_joints:
        yield from each_joint_assortment(n, f, fractionated=fractionated)
    else:
        for links in each_assortment(n, f, fractionated=fractionated):
            yield links, ()


def _print_json(wanted: _Wanted) -> None:
    """One object on one line, written as the assortments come."""
    print(f'{{"links": {wanted.links}, "mobility": {wanted.mobility}, "assortments": [', end="")
    for k, (links, joints) in enumerate(_rows(wanted)):
        item = {"links": links, "joints": joints} if wanted.multiple_joints else links
        print(", " * (k > 0) + json.dumps(item), end="")
    print("]}")


def _print(wanted: _Wanted, degree: int, count: int, lang: str) -> None:
    # A link of the largest degree, or a joint of as many links, occurs in some assortment.
    columns = degree - 1
    headers = [_link_header(k, lang) for k in range(2, columns + 2)]
    if wanted.multiple_joints:
        headers += [translate("joints with {links} links", lang, links=k) for k in range(2, columns + 2)]
    rows = (
        (*_filled(links, columns), *(_filled(joints, columns) if wanted.multiple_joints else ()))
        for links, joints in _rows(wanted)
    )
    if count <= _TABLE:
        print_table(headers, [[str(k) for k in row] for row in rows], numbers=range(len(headers)))
    else:
        print_long_table(headers, rows, 3 * wanted.links, count)


def _link_header(joints: int, lang: str) -> str:
    return arity(joints, lang) if joints <= _NAMED else translate("{count} joints", lang, count=joints)


def _filled(numbers: tuple[int, ...], width: int) -> tuple[int, ...]:
    return numbers + (0,) * (width - len(numbers))
