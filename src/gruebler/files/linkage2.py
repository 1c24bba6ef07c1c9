"""Files of the program Linkage by D. Rector: XML of connectors and links, ``.linkage2``.

A connector is a pin at x, y (y upwards) in 1/96 inch, whatever unit the program shows; on an anchor it is fixed to the
frame, as an input it is driven. A connector with ``slider`` runs between two others, its limits: it is a pin in the
slot of the link that has both. A link is a list of connectors; an actuator is a link of two connectors that changes its
length. A link with one connector more is a point of it. The speed of the only input goes into its loads. Source:
the program's reader (linkageDoc.cpp, linkageDoc.h: ``GetBaseUnitsPerInch``) and the examples that come with it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from math import atan2, cos, hypot, sin
from xml.etree.ElementTree import Element
from xml.sax.saxutils import quoteattr

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.measured_lengths import in_unit
from gruebler.files.pin_drawings import (
    SENSE,
    DrawnDrive,
    DrawnJoint,
    PinDrawing,
    drawing_in,
    one_drive_a_joint,
    with_slot_ends,
)
from gruebler.files.text_files import parse_xml, read_number

_FRAME = "frame"
_UNITS = {"millimeters": "mm", "inches": "in"}  # another name is millimetres to the program
_PER_INCH = 96.0  # GetBaseUnitsPerInch
_MECHANISM_LAYER = 16
_ON_LINE = 1e-9  # of the length
_LINK_TAGS = ("Link", "element")
_TAG = re.compile(r"""<[A-Za-z](?:[^<>"']|"[^"<]*"|'[^'<]*')*>""")
_VALUE = re.compile(r"""("[^"]*"|'[^']*')""")


def drawing_from_linkage2(text: str, left_out: list[Message]) -> PinDrawing:
    """The drawing of a ``.linkage2`` file; connectors are called by their names or numbers, links L0, L1, ...

    >>> drawing = drawing_from_linkage2('''<linkage2><connector anchor="true" input="true" x="0" y="0" id="3"/>
    ...     <connector x="0" y="9" id="4"/><Link id="7"><connector id="3"/><connector id="4"/></Link></linkage2>''', [])
    >>> [(joint.name, joint.links) for joint in drawing.joints], drawing.drives
    ([('3', ('frame', 'L7')), ('4', ('L7',))], (DrawnDrive(joint='3', fixed='frame', moved='L7'),))
    """
    root = parse_xml(_TAG.sub(_with_blanks, text))
    if root.tag != "linkage2":
        raise GrueblerError("expected the element <linkage2>, but found <{tag}>", tag=root.tag)
    program = root.find("program")
    unit = _UNITS.get((program.get("units", "") if program is not None else "").lower(), "mm")
    connectors: dict[str, Element] = {}
    for connector in root.iterfind("connector"):
        if _drawn_only(connector):
            continue
        number = connector.get("id", "")
        if number in connectors:
            raise GrueblerError("two connectors have the id {id!r}", id=number)
        connectors[number] = connector
    members: dict[str, list[str]] = {}
    actuators: set[str] = set()
    fastened: list[tuple[str, str]] = []
    by_id: dict[str, str] = {}
    for link in [each for each in root if each.tag in _LINK_TAGS]:
        if _drawn_only(link):
            left_out.append(message("the drawing element {id}", id=link.get("id", "")))
            continue
        if link.get("gear") == "true":
            raise GrueblerError("link {id}: gears are not read from this format", id=link.get("id", ""))
        name = _link_name(link, members)
        by_id.setdefault(link.get("id", ""), name)
        members[name] = [each.get("id", "") for each in link.iterfind("connector") if each.get("id") in connectors]
        members[name] += [
            each.get("id", "") for each in link.iterfind("fastenconnector") if each.get("id") in connectors
        ]
        if link.get("actuator") == "true" and len(members[name]) == 2:
            actuators.add(name)
        fastened.append((name, link.get("fastenlink", "")))
    rigid = [(name, by_id[other]) for name, other in fastened if other in by_id]
    return _drawing(connectors, members, actuators, rigid, unit, left_out)


def _with_blanks(tag: re.Match[str]) -> str:
    """A tag with blanks between its attributes: the program's own reader does without, two of its examples too."""
    return _VALUE.sub(r"\1 ", tag[0])


def _drawn_only(element: Element) -> bool:
    """Whether an element lies in the layer of pictures and notes."""
    layer = element.get("layer", "")
    return layer.isdecimal() and int(layer[:9]) > 0 and not int(layer[:9]) & _MECHANISM_LAYER


def _link_name(link: Element, used: Mapping[str, object]) -> str:
    name = link.get("name", "").strip() or f"L{link.get('id', '')}"
    number = 1
    wanted = name
    while wanted in used or wanted == _FRAME:
        number += 1
        wanted = f"{name} ({number})"
    return wanted


def _drawing(
    connectors: Mapping[str, Element],
    members: Mapping[str, list[str]],
    actuators: set[str],
    rigid: list[tuple[str, str]],
    unit: str,
    left_out: list[Message],
) -> PinDrawing:
    links_of: dict[str, list[str]] = {number: [] for number in connectors}
    places: dict[str, tuple[float, float]] = {}
    for number, connector in connectors.items():
        what = message("connector {id}", id=number)
        x, y = (read_number(connector.get(key, "0"), what) for key in ("x", "y"))
        places[number] = (in_unit(x, "in", unit) / _PER_INCH, in_unit(y, "in", unit) / _PER_INCH)
        if connector.get("anchor") == "true":
            links_of[number].append(_FRAME)
    joints, drives = [], []
    for name, numbers in members.items():
        ends = [name, name]
        if name in actuators:
            ends[1] = f"{name} rod"
            (x, y), (to_x, to_y) = places[numbers[0]], places[numbers[1]]
            slide = f"{name} actuator"
            joints.append(
                DrawnJoint(
                    name=slide, x=to_x, y=to_y, links=(name, ends[1]), slot=atan2(to_y - y, to_x - x), turns=False
                )
            )
            drives.append(DrawnDrive(slide, name, ends[1]))
        for k, number in enumerate(dict.fromkeys(numbers)):
            links_of[number].append(ends[min(k, 1)])
    names = _connector_names(connectors)
    for number, connector in connectors.items():
        links = links_of[number]
        if not links:
            continue
        limits = [each.get("id", "") for each in connector.iterfind("slidelimit")]
        slot = None
        if connector.get("slider") == "true":
            if read_number(connector.get("slideradius", "0") or "0", message("connector {id}", id=number)):
                raise GrueblerError("connector {id}: slots along an arc are not read from this format", id=number)
            base, slot = _slot(number, limits, places, links_of)
            links = [base, *(link for link in links if link != base)]
        joint = DrawnJoint(names[number], *places[number], tuple(links), slot=slot)
        joints.append(joint)
        if connector.get("input") == "true" and len(links) > 1 and slot is None:
            drives.append(DrawnDrive(joint.name, links[0], links[1]))
    speeds = [connector.get("rpm", "") for connector in connectors.values() if connector.get("input") == "true"]
    loads = _speed([speed for speed in speeds if speed], len(drives) == 1, left_out)
    return PinDrawing(
        frame=_FRAME, joints=tuple(joints), drives=tuple(drives), unit=unit, rigid=tuple(rigid), loads=loads
    )


def _speed(speeds: list[str], alone: bool, left_out: list[Message]) -> dict[str, str]:
    """The speed of the only drive; of several drives it is left out."""
    what = message("speeds of drives: {speeds} rpm", speeds=", ".join(sorted({*speeds})))
    if not speeds or not alone:
        left_out += [what] if speeds else []
        return {}
    speed = read_number(speeds[0], what)
    left_out += [SENSE] if speed < 0 else []
    return {"speed": f"{abs(speed)!r} rpm"} if speed else {}


def _connector_names(connectors: Mapping[str, Element]) -> dict[str, str]:
    """The names of connectors that have one of their own, else their numbers."""
    named = {number: connector.get("name", "").strip() for number, connector in connectors.items()}
    count = Counter(named.values())
    return {
        number: name if name and count[name] == 1 and name not in connectors else number
        for number, name in named.items()
    }


def _slot(
    number: str, limits: list[str], places: Mapping[str, tuple[float, float]], links_of: Mapping[str, list[str]]
) -> tuple[str, float]:
    """The link with the slot between two limits, and its direction."""
    if len(limits) != 2 or any(limit not in places for limit in limits):
        raise GrueblerError("connector {id}: a slider needs two limits", id=number)
    (x, y), (to_x, to_y) = places[limits[0]], places[limits[1]]
    both = [link for link in links_of[limits[0]] if link in links_of[limits[1]]]
    if not both:
        raise GrueblerError("connector {id}: no link has both limits of the slider", id=number)
    if hypot(to_x - x, to_y - y) == 0:
        raise GrueblerError("connector {id}: the limits of the slider coincide", id=number)
    return both[0], atan2(to_y - y, to_x - x)


def linkage2_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> str:
    """The text of a ``.linkage2`` file; the limits of slots are further points of the links that have them.

    The program shows millimetres or inches; another metric unit becomes millimetres, feet become inches.
    """
    unit = "in" if drawing.unit in ("in", "ft") else "mm"
    drawing = drawing_in(drawing, unit, left_out)
    driven = one_drive_a_joint(drawing, left_out)
    actuators = {
        joint.links[0]: joint.name for joint in drawing.joints if joint.name in driven and _cylinder(drawing, joint)
    }
    joints = tuple(replace(joint, slot=None) if joint.name in actuators.values() else joint for joint in drawing.joints)
    drawing, slots = with_slot_ends(replace(drawing, joints=joints))
    numbers = {joint.name: number for number, joint in enumerate(drawing.joints)}
    members: dict[str, list[str]] = {}
    lines = []
    for joint in drawing.joints:
        links = list(joint.links if joint.slot is None else joint.links[1:])
        drive = driven.get(joint.name)
        turned = drive is not None and joint.slot is None and drive.fixed == drawing.frame
        if drive is not None and (turned or joint.name in actuators.values()):
            del driven[joint.name]
        if drive is not None and turned:
            links.sort(key=lambda link: link != drive.moved)
        for link in links:
            if link != drawing.frame or len(links) == 1:
                members.setdefault(link, []).append(joint.name)
        x, y = (in_unit(value * _PER_INCH, unit, "in") for value in (joint.x, joint.y))
        attributes = [f'id="{numbers[joint.name]}"', f'x="{x!r}"', f'y="{y!r}"']
        attributes += [f"name={quoteattr(joint.name)}"] + ['anchor="true"'] * (drawing.frame in links)
        attributes += ['input="true"'] * turned + ['slider="true"'] * (joint.slot is not None)
        limits = "".join(f'\n\t\t<slidelimit id="{numbers[end]}"/>' for end in slots.get(joint.name, ()))
        end = f">{limits}\n\t</connector>" if limits else "/>"
        lines.append(f"\t<connector {' '.join(attributes)}{end}")
    if len(members.get(drawing.frame, ())) == 1:
        del members[drawing.frame]  # an anchor without link
    for number, (link, names) in enumerate(members.items()):
        actuator = ' actuator="true"' if link in actuators else ""
        lines.append(f'\t<Link id="{number}" name={quoteattr(link)}{actuator}>')
        lines += [f'\t\t<connector id="{numbers[member]}"/>' for member in names]
        lines.append("\t</Link>")
    if driven:
        left_out.append(message("drives of joints {joints}", joints=", ".join(driven)))
    units = {name: word.capitalize() for word, name in _UNITS.items()}[unit]
    program = f'\t<program zoom="1" xoffset="0" yoffset="0" scalefactor="1" units="{units}"/>'
    return "\n".join(["<linkage2>", program, *lines, "</linkage2>"]) + "\n"


def _cylinder(drawing: PinDrawing, joint: DrawnJoint) -> bool:
    """Whether a driven slot is all that its link has, but for a pin on its line: then they are an actuator."""
    base = joint.links[0]
    others = [other for other in drawing.joints if base in other.links and other is not joint]
    if joint.slot is None or not joint.turns or base == drawing.frame or len(others) != 1:
        return False
    pin = others[0]
    across = cos(joint.slot) * (pin.y - joint.y) - sin(joint.slot) * (pin.x - joint.x)
    return pin.slot is None and len(pin.links) > 1 and abs(across) <= _ON_LINE * hypot(pin.x - joint.x, pin.y - joint.y)
