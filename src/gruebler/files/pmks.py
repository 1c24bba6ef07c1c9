"""Addresses of PMKS+: a mechanism in the part of the address behind the question mark.

Version 2: ``flags.decimals.integers.units.joints..links..forces..selected`` and a checking character; newer addresses
have a digest of the whole behind an asterisk. Numbers are thousandths in base 64, a leading 0 for the minus; those of
more digits follow behind the selected object, ``PJ`` and id``~0~``x, ``~1~``y, ``~2~``angle (older versions of the
program refuse such an address). A joint is
``flags id,name,x,y,angle[,link,joint,joint]``: bits 1 slider, 2 input, 4 ground, 8 welded, 16 traced; a slider turns
about its pin unless it is welded, its slot is fixed, or runs through two joints of a link. A link is
``flag kind id,name,mass,inertia,x,y,colour,joints,,parts``; parts of a welded link follow it and are not links.

Version 1: ``j=id,x,y,links|,type,ground,angle,friction,input`` in lines, and ``l=id,mass,inertia,x,y,joints|,...``.
PMKS-Refactor: ``data=`` and compressed tables (`pmks_tables`) without a unit, cm when the program starts; a slider is
a block on the frame with a pin.

Of version 2 the speed of the only drive, the masses of links, unless they are the program's own, and forces go into the
loads; colours are left out. A force is ``flags id,link,name,start x,y,end x,y,magnitude``: bits 1 it turns with its
link, 2 it points from start to end, in lbf if lengths are in inches, else in N. Without bit 2 the head is drawn at the
start, while the program's own analysis goes on from start to end; of version 1 its writer calls a force local that its
reader does not: which is meant is not known, such forces are left out, and named. Sources: the programs' transcoders,
force analysis, units and published addresses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import repeat
from math import atan2, cos, hypot, pi, radians, sin, ulp
from typing import Any, NamedTuple
from urllib.parse import parse_qs, unquote

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import (
    SENSE,
    DrawnDrive,
    DrawnForce,
    DrawnJoint,
    PinDrawing,
    drawing_in,
    no_unit,
    one_drive_a_joint,
)
from gruebler.files.pmks_tables import tables_of_address
from gruebler.files.text_files import read_number

_ADDRESS = "https://app.pmksplus.com/?"
_FRAME = "ground"
_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
_CHECKS = _DIGITS[:62]
_UNITS = ("in", "cm", "m")
_SLIDER, _INPUT, _GROUND, _WELDED, _TRACED = 1, 2, 4, 8, 16
_ROOTS = "YAMG0123"  # flags of links that are not parts of another one
_LONGEST = 200_000  # characters of an address
_DIGEST = 6
_EXACT = "P"
_EXACT_FIELDS = {"0": "x", "1": "y", "2": "angle", "3": "", "4": ""}  # speed and mass are not of a linkage
_EXACT_OTHERS = ("L", "F", "D", "I")  # links, forces, settings
_CLOCKWISE = 1  # of the settings
_TURNS, _OUTWARD = 1, 2  # of forces
_MASSES = {"in": ("lb", "lb in2"), "cm": ("g", "kg cm2"), "m": ("kg", "kg m2")}  # siUnitFactors of the program
_NO_LOADS = message("masses, colours and speeds")
_ULPS = 4  # within which thousandths are the number


def drawing_from_pmks(text: str, left_out: list[Message]) -> PinDrawing:
    """The drawing of an address, or of the part behind its question mark.

    >>> left_out = []
    >>> slider_crank = drawing_from_pmks("2v.Ay,1E8.5,0.1011.6A,A,0,VG,0.0B,B,Fe,VG,0.5C,C,oa,0,0..YRAB,AB,Fe,Fe,7q,VG,"
    ...     "c5cae9,A,B,,.YRBC,BC,Fe,Fe,X6,Fe,303e9f,B,C,,...N_3*3QLfN7", left_out)
    >>> [(joint.name, joint.x, joint.y, joint.links) for joint in slider_crank.joints][-1]
    ('C', 3.236, 0.0, ('ground', 'BC'))
    """
    address = text.strip()
    if len(address) > _LONGEST:
        raise GrueblerError(
            "an address of {count:,} characters is longer than {most:,}", count=len(address), most=_LONGEST
        )
    if len(address.split("\n", 1)) > 1:
        raise GrueblerError("expected one line with an address of PMKS+")
    query = address.partition("?")[2] if "?" in address else address
    if query.startswith("j="):
        return _version_1(query, left_out)
    if query.startswith("data="):
        return _tables(unquote(query.removeprefix("data=")), left_out)
    return _version_2(unquote(query), left_out)


def _version_2(query: str, left_out: list[Message]) -> PinDrawing:
    body = _checked(query)
    sections = body.split(".")
    if len(sections) < 8:
        raise GrueblerError("is not an address of PMKS+: the parts between dots are missing")
    units = sections[3]
    unit = dict(enumerate(_UNITS)).get(_DIGITS.find(units[:1] or "-"), "")
    records, rest = _groups(sections[4:])
    joints = [_joint(record) for record in records[0]]
    links = [_link(record) for record in records[1] if record[:1] in _ROOTS]
    entries = [entry for entry in ".".join(rest).split(",") if entry]
    exact = [entry for entry in entries if entry[0] == _EXACT]
    joints = _with_exact_numbers(joints, exact)
    if len(entries) > len(exact):
        left_out.append(message("locks and notes of the drawing"))
    drawing = _drawing(joints, links, unit, left_out)
    left_out[left_out.index(_NO_LOADS)] = message("colours")
    clockwise = _integer(sections[0]) & _CLOCKWISE
    speeds = _integer(sections[2].split(",")[0]), _integer(f"{sections[1]},".split(",")[1]) / 1000
    loads = _loads(drawing, links, speeds, bool(clockwise), left_out)
    forces = _forces(records[2], drawing, left_out)
    return replace(drawing, loads={**loads, **({"forces": forces} if forces else {})})


def _forces(records: list[str], drawing: PinDrawing, left_out: list[Message]) -> list[DrawnForce]:
    """The forces that point away from where they act, on links that are drawn; one in each place."""
    unit = "lbf" if drawing.unit == "in" else "N"
    links = {link for joint in drawing.joints for link in joint.links}
    forces: list[DrawnForce] = []
    others: list[str] = []
    inward: list[str] = []
    for record in records:
        flags, fields = _DIGITS.find(record[0]), record[1:].split(",")
        if len(fields) < 8:
            raise GrueblerError("force {record!r}: expected id, link, name, two places and a magnitude", record=record)
        x, y, u, v, size = (_integer(field) / 1000 for field in fields[3:8])
        long = hypot(u - x, v - y)
        there = any((force.link, force.at) == (fields[1], (x, y)) for force in forces)
        if fields[1] not in links or not flags & _OUTWARD or not long or there:
            (others if flags & _OUTWARD else inward).append(fields[0])
            continue
        force = (size * (u - x) / long, size * (v - y) / long)
        forces.append(DrawnForce(link=fields[1], at=(x, y), force=force, unit=unit, turns=bool(flags & _TURNS)))
    left_out += [message("forces {names}", names=", ".join(others))] if others else []
    if inward:
        left_out.append(message("forces {names}: whether they push or pull is not known", names=", ".join(inward)))
    return forces


def _loads(
    drawing: PinDrawing, links: list[_Link], speeds: tuple[float, float], clockwise: bool, left_out: list[Message]
) -> dict[str, Any]:
    """The speed of the only drive, in turns a minute or lengths a second, and the masses of links.

    Mass 1 with inertia 1 (of a piston 0) is what every link has until somebody changes it: it is no mass.
    """
    mass_unit, inertia_unit = _MASSES[drawing.unit]
    bodies = {
        link.id: {"mass": f"{mass!r} {mass_unit}", "centre": [x, y], "inertia": f"{inertia!r} {inertia_unit}"}
        for link in links
        for mass, inertia, x, y in [link.body]
        if mass > 0 and inertia >= 0 and (mass, inertia) != (1.0, 0.0 if link.piston else 1.0)
    }
    loads: dict[str, Any] = {"bodies": bodies} if bodies else {}
    drives = drawing.drives or ()
    if len(drives) == 1:
        slides = {joint.name for joint in drawing.joints if joint.slot is not None}
        speed, unit = (speeds[1], f"{drawing.unit}/s") if drives[0].joint in slides else (speeds[0], "rpm")
        if speed > 0:
            loads["speed"] = f"{speed!r} {unit}"
            left_out += [SENSE] if clockwise and unit == "rpm" else []
    elif drives:
        left_out.append(message("speeds of drives: {speeds} rpm", speeds=str(speeds[0])))
    return loads


def _checked(query: str) -> str:
    """The address without its checks; `GrueblerError` if a character was changed or lost."""
    body, mark, digest = query.rpartition("*")
    if mark and len(digest) == _DIGEST:
        if digest != _digest(body):
            raise GrueblerError("the digest at the end of the address does not match: it was changed or cut off")
        query = body
    if not query or query[-1] != _CHECKS[(len(query) - 1) % 62]:
        raise GrueblerError("the check character at the end of the address does not match: it was changed or cut off")
    return query[:-1]


def _digest(body: str) -> str:
    """FNV-1a of 32 bits in six characters of base 62."""
    value = 0x811C9DC5
    for letter in body:
        value = ((value ^ ord(letter)) * 0x01000193) % 2**32
    digest = ""
    for _ in range(_DIGEST):
        value, digit = divmod(value, 62)
        digest = _CHECKS[digit] + digest
    return digest


def _groups(sections: list[str]) -> tuple[list[list[str]], list[str]]:
    """Joints, links and forces, each ended by an empty part, and what follows the selected object."""
    records: list[list[str]] = [[]]
    while sections and len(records) <= 3:
        part, *sections = sections
        if part:
            records[-1].append(part)
        else:
            records.append([])
    while len(records) < 3:
        records.append([])
    return records, sections[1:]


def _integer(text: str) -> int:
    digits = text[1:] if text[:1] == "0" else text
    value = 0
    for letter in digits[:_LONGEST_NUMBER]:
        place = _DIGITS.find(letter)
        if place < 0:
            raise GrueblerError("{text!r} is not a number of base 64", text=text)
        value = value * 64 + place
    return -value if text[:1] == "0" else value


_LONGEST_NUMBER = 12  # digits: thousandths up to 1e18


@dataclass(frozen=True, slots=True, kw_only=True)
class _Joint:
    flags: int
    id: str
    x: float
    y: float
    angle: float
    carrier: str
    slot: tuple[str, str]


class _Link(NamedTuple):
    id: str
    joints: tuple[str, ...]
    piston: bool = False
    body: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """Mass, moment of inertia and centre of mass, in the units of the address."""


def _joint(record: str) -> _Joint:
    fields = record[1:].split(",")
    if len(fields) < 5:
        raise GrueblerError("joint {record!r}: expected id, name, x, y and angle", record=record)
    fields += [""] * (8 - len(fields))
    flags = _DIGITS.find(record[0])
    x, y, angle = (_integer(field) / 1000 for field in fields[2:5])
    return _Joint(flags=flags, id=fields[0], x=x, y=y, angle=angle, carrier=fields[5], slot=(fields[6], fields[7]))


def _link(record: str) -> _Link:
    fields = record[2:].split(",")
    if len(fields) < 8:
        raise GrueblerError(
            "link {record!r}: expected id, name, mass, inertia, centre, colour and joints", record=record
        )
    joints = fields[7:]
    end = joints.index("") if "" in joints else len(joints)
    mass, inertia, x, y = (_integer(field) / 1000 for field in fields[2:6])
    return _Link(fields[0], tuple(joints[:end]), record[1] == "P", (mass, inertia, x, y))


def _with_exact_numbers(joints: list[_Joint], entries: list[str]) -> list[_Joint]:
    """The joints with what thousandths do not hold, such as ``PJB~0~1.2345``; other numbers are not of a linkage."""
    by_id = {joint.id: joint for joint in joints}
    for entry in entries:
        tag, *values = entry.split("~")
        if tag[1:2] in _EXACT_OTHERS:
            continue
        joint = by_id.get(tag[2:])
        if tag[1:2] != "J" or joint is None or len(values) != 2 or values[0] not in _EXACT_FIELDS:
            raise GrueblerError("{text!r} is no exact number of a joint of the address", text=entry[:60])
        numbers = {_EXACT_FIELDS[values[0]]: read_number(values[1], message("joint {joint}", joint=joint.id))}
        by_id[joint.id] = replace(
            joint, x=numbers.get("x", joint.x), y=numbers.get("y", joint.y), angle=numbers.get("angle", joint.angle)
        )
    return [by_id[joint.id] for joint in joints]


def _version_1(query: str, left_out: list[Message]) -> PinDrawing:
    parts = parse_qs(query, keep_blank_values=True, max_num_fields=20)
    joints: list[_Joint] = []
    for line in parts.get("j", [""])[0].splitlines():
        fields = line.split(",")
        if not line.strip():
            continue
        if len(fields) < 9:
            raise GrueblerError("joint {record!r}: expected nine values", record=line)
        what = message("joint {joint}", joint=fields[0])
        x, y, angle = (read_number(fields[k], what) for k in (1, 2, 6))
        flags = _SLIDER * (fields[4] == "P") + _INPUT * (fields[8] == "t") + _GROUND * (fields[5] == "t")
        joints.append(_Joint(flags=flags, id=fields[0], x=x, y=y, angle=angle, carrier="", slot=("", "")))
    links = []
    for line in parts.get("l", [""])[0].splitlines():
        fields = line.split(",")
        if len(fields) > 5:
            links.append(_Link(fields[0], tuple(fields[5].split("|"))))
    for line in parts.get("f", [""])[0].splitlines():
        if line.strip():
            left_out.append(message("the force {name}", name=line.split(",")[0]))
    settings = parts.get("s", [""])[0].split(",")
    return _drawing(joints, links, settings[-1] if settings[-1] in _UNITS else "", left_out)


def _tables(compressed: str, left_out: list[Message]) -> PinDrawing:
    tables = tables_of_address(compressed)
    joints = []
    for row in tables.joints:
        flags = _SLIDER * row.slides + _INPUT * row.driven + _GROUND * row.grounded
        joints.append(
            _Joint(flags=flags, id=row.name, x=row.x, y=row.y, angle=radians(row.angle), carrier="", slot=("", ""))
        )
    left_out += (message("the force {name}", name=force) for force in tables.forces)
    if tables.positions:
        left_out.append(message("positions of a synthesis"))
    links = [_Link(name, members) for name, members in tables.links]
    rigid = tuple((first, other) for first, *others in tables.welded for other in others)
    return replace(_drawing(joints, links, "", left_out), rigid=rigid)


def _drawing(joints: list[_Joint], links: list[_Link], unit: str, left_out: list[Message]) -> PinDrawing:
    by_id = {joint.id: joint for joint in joints}
    links_of: dict[str, list[str]] = {joint.id: [] for joint in joints}
    for link in links:
        for member in link.joints:
            if member not in by_id:
                raise GrueblerError(
                    "link {link!r} has the joint {joint!r}, which is not there", link=link.id, joint=member
                )
            links_of[member].append(link.id)
    drawn, drives = [], []
    for joint in joints:
        own_links = links_of[joint.id]
        slot: float | None = None
        turns = True
        if joint.flags & _SLIDER:
            base, slot = _slot(joint, links, by_id)
            own_links = [base, *(link for link in own_links if link != base)]
            pistons = {link.id for link in links if link.piston}
            turns = not joint.flags & _WELDED and pistons.isdisjoint(own_links)
        elif joint.flags & _GROUND:
            own_links = [_FRAME, *own_links]
        if not own_links:
            continue
        drawn.append(
            DrawnJoint(
                name=joint.id, x=joint.x, y=joint.y, links=tuple(dict.fromkeys(own_links)), slot=slot, turns=turns
            )
        )
        if joint.flags & _INPUT and len(own_links) > 1:
            drives.append(DrawnDrive(joint.id, own_links[0], own_links[1]))
    if any(link.joints for link in links):
        left_out.append(_NO_LOADS)
    if not unit:
        left_out.append(no_unit("cm"))
    return PinDrawing(frame=_FRAME, joints=tuple(drawn), drives=tuple(drives), unit=unit or "cm")


def _slot(joint: _Joint, links: list[_Link], by_id: dict[str, _Joint]) -> tuple[str, float]:
    """The link that has the slot of a slider, and its direction."""
    if not joint.carrier:
        return _FRAME, joint.angle
    carriers = [link.id for link in links if set(joint.slot) <= set(link.joints)]
    if joint.carrier in [link.id for link in links]:
        carriers.insert(0, joint.carrier)
    start, end = (by_id.get(each) for each in joint.slot)
    if not carriers or start is None or end is None:
        raise GrueblerError("slider {joint!r}: the slot is in no link", joint=joint.id)
    return carriers[0], atan2(end.y - start.y, end.x - start.x)


def pmks_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> str:
    """The address that opens a drawing in PMKS+, with all digits; units that it does not have become cm or in.

    The slot of a link that moves runs through two further joints of the link. Raises `GrueblerError` for a pin of the
    frame in the slot of another link.
    """
    unit = drawing.unit if drawing.unit in _UNITS else "in" if drawing.unit == "ft" else "cm"
    drawing = drawing_in(drawing, unit, left_out)
    driven = one_drive_a_joint(drawing, left_out)
    moved = [drive.moved for drive in driven.values()]
    links = sorted(
        dict.fromkeys(link for joint in drawing.joints for link in joint.links), key=lambda k: k not in moved
    )
    ids = {link: f"L{number}" for number, link in enumerate(link for link in links if link != drawing.frame)}
    members: dict[str, list[str]] = {link: [] for link in ids}
    xs, ys = [joint.x for joint in drawing.joints], [joint.y for joint in drawing.joints]
    reach = max(max(xs) - min(xs), max(ys) - min(ys)) / 2 or 1.0
    records: list[str] = []
    exact: list[str] = []

    def put(flags: int, name: str, x: float, y: float, angle: float, links: Sequence[str], slot: str = "") -> str:
        number = f"J{len(records)}"
        for link in links:
            if link in members:
                members[link].append(number)
        for field, value in enumerate((x, y, angle)):
            if abs(round(value * 1000) / 1000 - value) > _ULPS * ulp(max(abs(value), reach)):
                exact.append(f"{_EXACT}J{number}~{field}~{value!r}")
        values = ",".join(_base_64(round(value * 1000)) for value in (x, y, angle))
        records.append(f"{_DIGITS[flags]}{number},{_plain(name) or number},{values}{slot}")
        return number

    undriven = set(driven)
    for joint in map(_slot_on_the_frame, drawing.joints, repeat(drawing.frame)):
        flags, slot, angle = 0, "", 0.0
        base = joint.links[0]
        drive = driven.get(joint.name)
        if joint.slot is not None:
            flags = (
                _SLIDER + _WELDED * (not joint.turns) + _GROUND * (base == drawing.frame) + _INPUT * (drive is not None)
            )
            undriven.discard(joint.name)
            if base == drawing.frame:
                angle = joint.slot % pi
            else:
                dx, dy = reach * cos(joint.slot), reach * sin(joint.slot)
                ends = [put(0, "", joint.x + side * dx, joint.y + side * dy, 0.0, (base,)) for side in (-1, 1)]
                slot = f",{ids[base]},{','.join(ends)}"
        elif drawing.frame in joint.links:
            flags = _GROUND
            if drive is not None and drive.fixed == drawing.frame:
                flags += _INPUT
                undriven.discard(joint.name)
        put(flags, joint.name, joint.x, joint.y, angle, joint.links[joint.slot is not None :], slot)
    if undriven:
        left_out.append(message("drives of joints {joints}", joints=", ".join(sorted(undriven))))
    if exact:
        left_out.append(message("older versions of PMKS+: they refuse an address with more digits than 0.001"))
    bodies = [
        f"YR{number},{_plain(link)},Fe,Fe,0,0,c5cae9,{''.join(f'{member},' for member in members[link])},"
        for link, number in ids.items()
    ]
    head = f"2v.Ay,1E8.A,0.{_UNITS.index(unit)}011."
    body = f"{head}{''.join(f'{record}.' for record in records)}.{''.join(f'{each}.' for each in bodies)}..N_"
    body += f".{','.join(exact)}" if exact else ""
    checked = body + _CHECKS[len(body) % 62]
    return f"{_ADDRESS}{checked}*{_digest(checked)}\n"


def _slot_on_the_frame(joint: DrawnJoint, frame: str) -> DrawnJoint:
    """A slide on the frame with the slot in the frame; `GrueblerError` for a pin of the frame in a slot that moves."""
    if joint.slot is None or frame not in joint.links[1:]:
        return joint
    if joint.turns:
        raise GrueblerError("the format holds no pin of the frame in the slot of another link")
    return replace(joint, links=(frame, joint.links[0]))


def _base_64(value: int) -> str:
    digits, rest = "", abs(value)
    while True:
        rest, digit = divmod(rest, 64)
        digits = _DIGITS[digit] + digits
        if not rest:
            return f"0{digits}" if value < 0 else digits


def _plain(name: str) -> str:
    """A name without the signs that have a meaning in an address."""
    return "".join(letter if letter.isalnum() or letter in " -_" else " " for letter in name).strip()
