"""JSON of pylinkage, in its two forms.

The mechanism form has joints with an id, a type (ground, revolute, tracker, prismatic: a pin in a slot of the frame)
and a position, and links with the ids of their joints, of type ground, driver, arc_driver or link. The older form has
joints that are placed one by one: Static; Crank at a distance from a joint; Revolute (also Pivot) at two distances from
two joints; Fixed at a distance and an angle against the line of two joints; Prismatic (also Linear) at a distance from
a joint on the line of two others. Each crank, and each distance of a Revolute or Prismatic, is a link. There is no
unit. Source: the serialization modules of the library.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Mapping
from math import atan2, cos, hypot, isfinite, sin
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import NO_UNIT_WRITTEN, DrawnDrive, DrawnJoint, PinDrawing, drawing_in, no_unit

_FRAME = "ground"
_PLACED = {"Static", "Crank", "Revolute", "Pivot", "Fixed", "Prismatic", "Linear"}


def is_pylinkage(document: Any) -> bool:
    """Whether a JSON document has joints and links, or joints placed one by one, as pylinkage writes them."""
    joints = document.get("joints") if isinstance(document, Mapping) else None
    return isinstance(joints, list) and all(isinstance(joint, Mapping) and "type" in joint for joint in joints)


def drawing_from_pylinkage(document: Any, left_out: list[Message]) -> PinDrawing:
    """The drawing of a document in either form.

    >>> crank = {"joints": [{"id": "A", "type": "ground", "position": [0, 0]},
    ...                     {"id": "B", "type": "revolute", "position": [1, 0]}],
    ...          "links": [{"id": "crank", "type": "driver", "joints": ["A", "B"], "motor_joint": "A"}]}
    >>> drawing_from_pylinkage(crank, []).joints[0].links
    ('ground', 'crank')
    """
    joints = document["joints"]
    left_out.append(no_unit())
    if "links" in document:
        return _of_mechanism(joints, document, left_out)
    if not all(joint["type"] in _PLACED for joint in joints):
        raise GrueblerError("joints: expected the types {types}", types=", ".join(sorted(_PLACED)))
    return _Placing(joints).drawing(left_out)


def _number(value: Any, what: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise GrueblerError("{what}: expected a number, but found {text!r}", what=what, text=value)
    return float(value)


def _texts(record: Mapping[str, Any], key: str, default: Any = None) -> list[str]:
    value = record.get(key, default)
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        raise GrueblerError("{key}: expected a list of names", key=key)
    return value


def _name(record: Mapping[str, Any], key: str) -> str:
    value = record.get(key)
    if not isinstance(value, str) or not value:
        raise GrueblerError("{key}: expected a name, but found {text!r}", key=key, text=value)
    return value


def _of_mechanism(joints: list[Any], document: Mapping[str, Any], left_out: list[Message]) -> PinDrawing:
    links = document["links"]
    if not isinstance(links, list) or not all(isinstance(link, Mapping) for link in links):
        raise GrueblerError("links: expected a list of links")
    members = {_name(link, "id"): _texts(link, "joints") for link in links}
    ground = {_name(link, "id") for link in links if link.get("type") == "ground"}
    drawn, speeds = [], False
    for joint in joints:
        name, kind = _name(joint, "id"), joint["type"]
        position = joint.get("position")
        if not isinstance(position, list) or len(position) != 2:
            raise GrueblerError("joint {joint!r}: expected a position [x, y]", joint=name)
        x, y = (_number(value, message("joint {joint}", joint=name)) for value in position)
        joined = [_FRAME if link in ground else link for link, its in members.items() if name in its]
        slot = None
        if kind == "tracker":
            refs = {joint.get("ref_joint1_id"), joint.get("ref_joint2_id")}
            joined = [_FRAME if link in ground else link for link, its in members.items() if refs <= set(its)][:1]
        elif kind == "ground":
            joined = [_FRAME, *joined]
        elif kind == "prismatic":
            axis = joint.get("axis", [1.0, 0.0])
            if not isinstance(axis, list) or len(axis) != 2:
                raise GrueblerError("joint {joint!r}: expected an axis [x, y]", joint=name)
            dx, dy = (_number(value, message("joint {joint}", joint=name)) for value in axis)
            slot = atan2(dy, dx)
            joined = [_FRAME, *joined]
        if joined:
            drawn.append(DrawnJoint(name=name, x=x, y=y, links=tuple(dict.fromkeys(joined)), slot=slot))
    drives = []
    for link in links:
        if link.get("type") in ("driver", "arc_driver"):
            motor = link.get("motor_joint") or next(iter(members[link["id"]]), "")
            drives.append(DrawnDrive(str(motor), _FRAME, link["id"]))
            speeds = True
    if speeds:
        left_out.append(message("speeds and ranges of drives"))
    return PinDrawing(frame=_FRAME, joints=tuple(drawn), drives=tuple(drives))


class _Placing:
    """Joints that are placed one after the other."""

    def __init__(self, joints: list[Any]) -> None:
        self.places: dict[str, complex] = {}
        self.members: dict[str, set[str]] = {_FRAME: set()}
        self.slots: dict[str, tuple[str, float]] = {}
        self.drives: list[DrawnDrive] = []
        waiting = list(joints)
        while waiting:
            ready = [joint for joint in waiting if all(ref in self.places for ref in self._refs(joint))]
            if not ready:
                raise GrueblerError(
                    "joint {joint!r}: a joint that it is placed by is missing", joint=waiting[0].get("name")
                )
            for joint in ready:
                self._place(joint)
            waiting = [joint for joint in waiting if not any(joint is known for known in ready)]

    def _refs(self, joint: Mapping[str, Any]) -> list[str]:
        """The names of the joints that it is placed by; those written within it are placed at once."""
        names = []
        for key in ("joint0", "joint1", "joint2"):
            ref = joint.get(key)
            if ref is None:
                continue
            if not isinstance(ref, Mapping):
                raise GrueblerError("{key}: expected a reference to a joint", key=key)
            if ref.get("inline"):
                name = f"{joint.get('name')} {key}"
                what = message("joint {joint}", joint=name)
                self.places[name] = complex(_number(ref.get("x"), what), _number(ref.get("y"), what))
                self.members[_FRAME].add(name)
                names.append(name)
            else:
                names.append(_name(ref, "ref"))
        return names

    def _place(self, joint: Mapping[str, Any]) -> None:
        name, kind, refs = _name(joint, "name"), joint["type"], self._refs(joint)
        what = message("joint {joint}", joint=name)
        if name in self.places:
            raise GrueblerError("two joints are called {joint!r}", joint=name)
        needed = {"Static": 0, "Crank": 1, "Fixed": 2, "Revolute": 2, "Pivot": 2}.get(kind, 3)
        if len(refs) < needed:
            raise GrueblerError("joint {joint!r}: expected {count} joints that place it", joint=name, count=needed)
        x, y = joint.get("x"), joint.get("y")
        given = None if x is None or y is None else complex(_number(x, what), _number(y, what))
        places = [self.places[ref] for ref in refs]
        if kind == "Static":
            self.places[name] = given or 0j
            self.members[_FRAME].add(name)
            return
        if kind in ("Crank", "Fixed"):
            distance = _number(joint.get("distance"), what)
            turned = joint.get("angle") or 0.0
            if kind == "Crank":
                direction = phase(given - places[0]) if given is not None else 0.0
                self._link(name, refs[0])
                self.drives.append(DrawnDrive(refs[0], _FRAME, self._of(name, refs[0])))
            else:
                direction = phase(places[1] - places[0]) + _number(turned, what)
                self.members[self._of(*refs[:2])].add(name)
            self.places[name] = places[0] + rect(distance, direction)
            return
        if kind in ("Revolute", "Pivot"):
            radii = [_number(joint.get(key), what) for key in ("distance0", "distance1")]
            self.places[name] = _meeting(name, places[0], radii[0], places[1], radii[1], given)
            self._link(name, refs[0])
            self._link(name, refs[1])
            return
        radius = _number(joint.get("revolute_radius"), what)
        self.places[name] = _on_line(name, places[0], radius, places[1], places[2], given)
        self._link(name, refs[0])
        self.slots[name] = (self._of(refs[1], refs[2]), phase(places[2] - places[1]))

    def _link(self, name: str, other: str) -> None:
        """A new link between two joints."""
        self.members[f"{other}-{name}"] = {other, name}

    def _of(self, first: str, second: str) -> str:
        """The link that has both joints."""
        for link, its in self.members.items():
            if first in its and second in its:
                return link
        raise GrueblerError("no link has both joints {first!r} and {second!r}", first=first, second=second)

    def drawing(self, left_out: list[Message]) -> PinDrawing:
        """What was placed."""
        joints = []
        for name, place in self.places.items():
            links = [link for link, its in self.members.items() if name in its]
            base, slot = self.slots.get(name, (None, None))
            joined = tuple(dict.fromkeys(links if base is None else [base, *links]))
            if joined:
                joints.append(DrawnJoint(name=name, x=place.real, y=place.imag, links=joined, slot=slot))
        if self.drives:
            left_out.append(message("speeds and ranges of drives"))
        return PinDrawing(frame=_FRAME, joints=tuple(joints), drives=tuple(self.drives))


def _meeting(
    name: str, first: complex, radius: float, second: complex, radius_of_other: float, near: complex | None
) -> complex:
    """Where two circles meet, next to a place."""
    gap = abs(second - first)
    along = (gap**2 + radius**2 - radius_of_other**2) / (2 * gap) if gap else float("nan")
    height = radius**2 - along**2
    if not height > -1e-9 * radius**2:
        raise GrueblerError("joint {joint!r} cannot be placed: its links do not reach each other", joint=name)
    unit = (second - first) / gap
    both = [first + unit * complex(along, side * max(height, 0.0) ** 0.5) for side in (1, -1)]
    return both[0] if near is None else min(both, key=lambda place: abs(place - near))


def _on_line(name: str, centre: complex, radius: float, start: complex, end: complex, near: complex | None) -> complex:
    """Where a circle meets a line, next to a place."""
    if start == end:
        raise GrueblerError("joint {joint!r}: the two joints of its line coincide", joint=name)
    unit = (end - start) / abs(end - start)
    foot = start + unit * ((centre - start) * unit.conjugate()).real
    height = radius**2 - abs(centre - foot) ** 2
    if not height > -1e-9 * radius**2:
        raise GrueblerError("joint {joint!r} cannot be placed: its link does not reach the line", joint=name)
    both = [foot + unit * complex(side * max(height, 0.0) ** 0.5, 0.0) for side in (1, -1)]
    return both[0] if near is None else min(both, key=lambda place: abs(place - near))


def pylinkage_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> dict[str, Any]:
    """The document of a drawing in the mechanism form.

    Raises `GrueblerError` if something slides other than a pin in a slot of the frame.
    """
    drawing = drawing_in(drawing, "mm", left_out)
    frame = drawing.frame
    if any(joint.slot is not None and not (joint.turns and joint.links[0] == frame) for joint in drawing.joints):
        raise GrueblerError("the only sliding joints that the format can hold are pins in slots of the frame")
    members: dict[str, list[DrawnJoint]] = {}
    for joint in drawing.joints:
        for link in joint.links:
            members.setdefault(link, []).append(joint)
    joints: list[dict[str, Any]] = []
    for joint in drawing.joints:
        record: dict[str, Any] = {"id": joint.name, "type": "revolute", "position": [joint.x, joint.y]}
        if joint.slot is not None:
            axis = [cos(joint.slot), sin(joint.slot)]
            record |= {"type": "prismatic", "axis": axis, "line_point": [joint.x, joint.y], "slide_distance": 0.0}
        elif frame in joint.links:
            record["type"] = "ground"
        elif len(joint.links) == 1:
            pins = [each for each in members[joint.links[0]] if len(each.links) > 1]
            if len(pins) < 2:
                left_out.append(message("the point {point}", point=joint.name))
                continue
            first, second = pins[:2]
            arm, base = complex(joint.x - first.x, joint.y - first.y), complex(second.x - first.x, second.y - first.y)
            record |= {"type": "tracker", "ref_joint1_id": first.name, "ref_joint2_id": second.name}
            record |= {"distance": hypot(arm.real, arm.imag), "angle": phase(arm) - phase(base)}
        joints.append(record)
    drives = {drive.moved: drive for drive in drawing.drives or () if drive.fixed == frame}
    links: list[dict[str, Any]] = []
    for link, its in members.items():
        names = [joint.name for joint in its if len(joint.links) > 1 or frame in joint.links]
        if link == frame:
            names = [joint.name for joint in its if joint.slot is None]
        entry: dict[str, Any] = {"id": link, "type": "ground" if link == frame else "link", "joints": names}
        if link in drives:
            motor = next(joint for joint in its if joint.name == drives[link].joint)
            end = next((joint for joint in its if joint is not motor), motor)
            start = atan2(end.y - motor.y, end.x - motor.x)
            entry |= {"type": "driver", "motor_joint": motor.name, "angular_velocity": 0.1, "initial_angle": start}
        links.append(entry)
    undriven = [drive.joint for drive in drawing.drives or () if drive.fixed != frame]
    if undriven:
        left_out.append(message("drives of joints {joints}", joints=", ".join(undriven)))
    left_out.append(NO_UNIT_WRITTEN)
    return {"name": "mechanism", "joints": joints, "links": links, "ground": frame}
