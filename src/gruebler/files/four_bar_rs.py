"""Files of four-bar-rs: a four-bar with a coupler point in RON (``.ron``), curves to reach in CSV without a header.

``p1x, p1y`` is the pivot of the crank, ``a`` the direction of the frame to the other pivot, ``l1`` the frame, ``l2``
the crank, ``l3`` the coupler, ``l4`` the rocker, ``l5`` and ``g`` the coupler point: its distance from the crank pin
and its direction against the coupler. ``stat`` is c1b1, c1b2, c2b1 or c2b2: c1 has the rocker's pin to the left of the
line from the crank pin to the rocker's pivot, b1 and b2 are the two ranges of a crank that has two. Angles are in
radians, the crank's are counted from the frame's direction; lengths have no unit. Source: the program's library
(four-bar/src/mech).
"""

from __future__ import annotations

import re
from cmath import phase, rect
from math import acos, pi, remainder

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import NO_UNIT_WRITTEN, DrawnDrive, DrawnJoint, PinDrawing, drawing_in, no_unit
from gruebler.files.text_files import read_number

_FIELD = re.compile(r"\s*([A-Za-z_]\w*)\s*:\s*([^\s,()]+)\s*(?:,|$)")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_LENGTHS = ("l1", "l2", "l3", "l4")
_DEFAULTS = {"p1x": 0.0, "p1y": 0.0, "a": 0.0, "l2": 1.0, "l5": 0.0, "g": 0.0}
_STATES = ("c1b1", "c1b2", "c2b1", "c2b2")


def drawing_from_ron(text: str, left_out: list[Message]) -> PinDrawing:
    """The drawing of a four-bar in the middle of the crank's range, the crank driven.

    >>> drawing = drawing_from_ron("(l1: 90.0, l2: 35.0, l3: 70.0, l4: 70.0, l5: 45.0, g: 0.5, stat: c1b1)", [])
    >>> [joint.name for joint in drawing.joints]
    ['P1', 'P3', 'P4', 'P2', 'P5']
    """
    body = _COMMENT.sub(" ", text).strip()
    if not (body.startswith("(") and body.endswith(")")):
        raise GrueblerError("expected (p1x: ..., l1: ..., stat: c1b1)")
    fields: dict[str, str] = {}
    place, inner = 0, body[1:-1].strip()
    while place < len(inner):
        match = _FIELD.match(inner, place)
        if match is None:
            raise GrueblerError("expected key: value, but found {text!r}", text=inner[place : place + 40])
        if match[1] in fields:
            raise GrueblerError("the key {key!r} is given twice", key=match[1])
        fields[match[1]] = match[2]
        place = match.end()
    state = fields.pop("stat", _STATES[0]).lower()
    if state not in _STATES:
        raise GrueblerError("stat: expected c1b1, c1b2, c2b1 or c2b2, but found {state!r}", state=state)
    if fields.pop("e", None) is not None:
        left_out.append(message("the direction e of the coupler's motion line"))
    missing = [key for key in _LENGTHS if key not in fields and key not in _DEFAULTS]
    strange = [key for key in fields if key not in (*_DEFAULTS, *_LENGTHS)]
    if missing:
        raise GrueblerError("the key {key!r} is missing", key=missing[0])
    if strange:
        raise GrueblerError("unknown key {key!r}; planar four-bars have p1x, p1y, a, l1 to l5, g, stat", key=strange[0])
    values = _DEFAULTS | {key: read_number(value, key) for key, value in fields.items()}
    for key in _LENGTHS:
        if values[key] <= 0:
            raise GrueblerError("{key}: expected a positive length, but found {value:g}", key=key, value=values[key])
    left_out.append(no_unit())
    return _drawing(values, state)


def _drawing(values: dict[str, float], state: str) -> PinDrawing:
    frame, crank, coupler, rocker = (values[key] for key in _LENGTHS)
    turn = _crank_range(frame, crank, coupler, rocker, state)
    first = complex(values["p1x"], values["p1y"])
    second = first + rect(frame, values["a"])
    pin = first + rect(crank, values["a"] + (turn[0] + turn[1]) / 2)
    reach = abs(second - pin)
    cosine = (coupler**2 + reach**2 - rocker**2) / (2 * reach * coupler)
    bend = acos(min(1.0, max(-1.0, cosine)))
    other = pin + rect(coupler, phase(second - pin) + (bend if state.startswith("c1") else -bend))
    point = pin + rect(values["l5"], phase(other - pin) + values["g"])
    places = {
        "P1": (first, ("frame", "crank")),
        "P3": (pin, ("crank", "coupler")),
        "P4": (other, ("coupler", "rocker")),
        "P2": (second, ("frame", "rocker")),
        "P5": (point, ("coupler",)),
    }
    joints = tuple(
        DrawnJoint(name=name, x=place.real, y=place.imag, links=links) for name, (place, links) in places.items()
    )
    return PinDrawing(frame="frame", joints=joints, drives=(DrawnDrive("P1", "frame", "crank"),))


def _crank_range(frame: float, crank: float, coupler: float, rocker: float, state: str) -> tuple[float, float]:
    """The crank angles between which the four-bar closes, from the frame's direction."""
    longest, rest = max(frame, crank, coupler, rocker), frame + crank + coupler + rocker
    if 2 * longest > rest:
        raise GrueblerError("the lengths close in no position: one is longer than the others together")

    def angle(reach: float) -> float:
        return acos(min(1.0, max(-1.0, (frame**2 + crank**2 - reach**2) / (2 * frame * crank))))

    near, far = abs(coupler - rocker), coupler + rocker
    stretched, folded = frame + crank > far, abs(frame - crank) < near
    if not stretched and not folded:
        return pi / 2, pi / 2
    if not stretched:
        return angle(near), 2 * pi - angle(near)
    if not folded:
        return -angle(far), angle(far)
    return (2 * pi - angle(far), 2 * pi - angle(near)) if state.endswith("b1") else (angle(near), angle(far))


def curve_from_csv(text: str) -> list[tuple[float, ...]] | None:
    r"""The rows of a curve that four-bar-rs takes as a target: x, y, or x, y and a unit vector; None for another table.

    >>> curve_from_csv("# a circle\n1,0\n0.,1\n-1,0\n"), curve_from_csv("x,y\n1,0\n")
    ([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)], None)
    """
    rows = [line.split(",") for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not rows or re.match(r"\s*[-+.\d]", rows[0][0]) is None:
        return None
    if any(len(row) != len(rows[0]) for row in rows) or len(rows[0]) not in (2, 4):
        raise GrueblerError("expected rows of two or four numbers")
    return [tuple(read_number(cell.strip(), message("coordinate")) for cell in row) for row in rows]


def ron_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> str:
    """The RON of a four-bar of turning joints whose crank is driven, with one coupler point at most, in millimetres.

    Raises `GrueblerError` for any other linkage.
    """
    drawing = drawing_in(drawing, "mm", left_out)
    frame = drawing.frame
    pins = [joint for joint in drawing.joints if len(joint.links) > 1]
    drives = drawing.drives or ()
    links = {link for joint in pins for link in joint.links}
    simple = all(joint.slot is None and len(joint.links) == 2 for joint in pins)
    if len(links) != 4 or len(pins) != 4 or not simple or len(drives) != 1 or drives[0].fixed != frame:
        raise GrueblerError("the format holds a four-bar of turning joints with a driven crank, and nothing else")
    crank = drives[0].moved
    (first,) = [joint for joint in pins if set(joint.links) == {frame, crank}]
    second = next(joint for joint in pins if frame in joint.links and joint is not first)
    pin = next(joint for joint in pins if crank in joint.links and joint is not first)
    coupler = next(link for link in pin.links if link != crank)
    other = next(joint for joint in pins if coupler in joint.links and joint is not pin)
    points = [joint for joint in drawing.joints if joint.links == (coupler,)]
    dropped = [joint.name for joint in drawing.joints if len(joint.links) == 1 and joint not in points[:1]]
    if dropped:
        left_out.append(message("points other than one of the coupler: {points}", points=", ".join(dropped)))
    left_out += [message("names of links and points"), NO_UNIT_WRITTEN]
    at = {joint.name: complex(joint.x, joint.y) for joint in drawing.joints}
    base, bar = at[second.name] - at[first.name], at[other.name] - at[pin.name]
    arm = at[points[0].name] - at[pin.name] if points else 0j
    side = ((at[second.name] - at[pin.name]).conjugate() * bar).imag
    turn = remainder(phase(at[pin.name] - at[first.name]) - phase(base), 2 * pi)
    rocker = abs(at[second.name] - at[other.name])
    length = abs(at[pin.name] - at[first.name])
    both = abs(base) + length > abs(bar) + rocker and abs(abs(base) - length) < abs(abs(bar) - rocker)
    values = {
        "p1x": at[first.name].real,
        "p1y": at[first.name].imag,
        "a": phase(base),
        "l1": abs(base),
        "l2": length,
        "l3": abs(bar),
        "l4": rocker,
        "l5": abs(arm),
        "g": remainder(phase(arm) - phase(bar), 2 * pi) if points else 0.0,
    }
    state = f"c{1 if side >= 0 else 2}b{2 if both and turn > 0 else 1}"
    return "(\n" + "".join(f"    {key}: {value!r},\n" for key, value in values.items()) + f"    stat: {state},\n)\n"
