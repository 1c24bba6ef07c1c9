"""The tables in an address of PMKS-Refactor, the newer PMKS+: ``?data=`` and a compressed JSON document.

The document has lists of rows: ``j`` joints (id, name, x, y, type, angle, grounded, input, speed, welded, ...), ``l``
links (id, name, mass, colour, x, y, joints, forces, ...), ``c`` welded links (id, name, mass, x, y, links, ...), ``f``
forces, ``p`` positions to be reached. Whole numbers are texts of hexadecimal digits except within ``0|1|2``, angles are
in degrees, ``y`` and ``n`` are truth values. Before compression ``","`` becomes ``~``, then ``,`` becomes ``_``, then
``"]_["`` becomes ``--``. Source: the program's encoder and decoder.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message
from gruebler.files.lz_string import decompressed
from gruebler.files.text_files import read_number

_LONGEST = 2_000_000  # characters; the program's undo steps are in the document, too
_WHOLE = re.compile(r"-?[0-9a-fA-F]{1,30}")


@dataclass(frozen=True, slots=True, kw_only=True)
class TableJoint:
    """A pin, or a pin on a block that slides on the frame."""

    name: str
    x: float
    y: float
    slides: bool
    angle: float
    """Of the slot, in degrees."""
    grounded: bool
    driven: bool


class TableLink(NamedTuple):
    """A bar or plate."""

    name: str
    joints: tuple[str, ...]
    """Names of joints."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tables:
    """What an address holds that is or concerns a linkage."""

    joints: tuple[TableJoint, ...]
    links: tuple[TableLink, ...]
    welded: tuple[tuple[str, ...], ...]
    """Names of links that are welded to each other."""
    forces: tuple[str, ...]
    positions: int
    """How many positions of a synthesis the document has."""


def tables_of_address(compressed: str) -> Tables:
    """The joints and links of what follows ``data=``, names made different where two are equal.

    Raises `GrueblerError` for an address that is cut off, rows that are too short, and joints that are not there.
    """
    document = _document(decompressed(compressed.replace(" ", "+"), _LONGEST))
    joints: dict[int, TableJoint] = {}
    for row in _rows(document, "j", 8):
        name = _new_name(row, [joint.name for joint in joints.values()])
        what = message("joint {joint}", joint=name)
        x, y, angle = (_number(row[k], what) for k in (2, 3, 5))
        slides = _number(row[4], what) == 0
        joints[_id(row)] = TableJoint(
            name=name, x=x, y=y, slides=slides, angle=angle, grounded=row[6] == "y", driven=row[7] == "y"
        )
    links: dict[int, TableLink] = {}
    for row in _rows(document, "l", 7):
        name = _new_name(row, [link.name for link in links.values()])
        members = []
        for number in _listed(row[6]):
            if number not in joints:
                raise GrueblerError(
                    "link {link!r} has the joint {joint!r}, which is not there", link=name, joint=str(number)
                )
            members.append(joints[number].name)
        links[_id(row)] = TableLink(name, tuple(members))
    welded = []
    for row in _rows(document, "c", 6):
        parts = [links[number].name for number in _listed(row[5]) if number in links]
        welded.append(tuple(parts))
    forces = tuple(str(row[1]) for row in _rows(document, "f", 2))
    return Tables(
        joints=tuple(joints.values()),
        links=tuple(links.values()),
        welded=tuple(welded),
        forces=forces,
        positions=len(document.get("p") or ()),
    )


def _document(text: str) -> dict[str, Any]:
    spelled = text.replace("--", '"]_["').replace("_", ",").replace("~", '","')
    try:
        document = json.loads(spelled)
    except (ValueError, RecursionError):
        document = None
    if not isinstance(document, dict) or not isinstance(document.get("j"), list):
        raise GrueblerError("the address has no tables of joints and links of PMKS+")
    return document


def _rows(document: dict[str, Any], key: str, least: int) -> Iterator[list[Any]]:
    rows = document.get(key) or []
    for row in rows if isinstance(rows, list) else []:
        if not isinstance(row, list) or len(row) < least:
            raise GrueblerError("table {key!r} of the address: expected rows of {least} values", key=key, least=least)
        yield row


def _new_name(row: list[Any], taken: list[str]) -> str:
    name = str(row[1]).strip()
    return name if name and name not in taken else f"{name or 'J'}{_id(row)}"


def _id(row: list[Any]) -> int:
    return int(_number(row[0], message("the number of {name}", name=str(row[1]))))


def _listed(text: Any) -> list[int]:
    """The decimal numbers in ``0|1|12``."""
    numbers = [part for part in str(text).split("|") if part]
    if not all(re.fullmatch(r"-?\d{1,9}", number, re.ASCII) for number in numbers):
        raise GrueblerError("{text!r} is not a list of numbers", text=str(text)[:60])
    return [int(number) for number in numbers]


def _number(value: Any, what: Any) -> float:
    """A number: whole ones are texts of hexadecimal digits."""
    if isinstance(value, str) and _WHOLE.fullmatch(value):
        return float(int(value, 16))
    return read_number(str(value), what)
