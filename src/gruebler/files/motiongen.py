"""Mechanisms of MotionGen: JSON of the matrices B, S, I, of the places p and of the coupler points c.

``B[body][joint]`` is 1 where a body has a joint, body 0 is the frame; ``S`` has ``[end, pin, end, body]`` for a
pin in a slot between two joints of a body; ``I`` has ``[a, pivot, b, 0]`` for a driven angle and
``[end, pin, end, 1]`` for a pin that is driven along a slot; ``p`` are the places, ``c`` is 1 for points to look at.
Source: the program's structures for path synthesis (BSIdict_468.json, datasetProcess.py).
"""

from __future__ import annotations

from math import atan2
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import (
    NO_UNIT_WRITTEN,
    DrawnDrive,
    DrawnJoint,
    PinDrawing,
    drawing_in,
    no_unit,
    with_slot_ends,
)

_FRAME = "frame"


class _Record(msgspec.Struct, frozen=True):
    B: list[list[int]]
    p: list[tuple[float, float]]
    S: list[tuple[int, int, int, int]] = []
    I: list[tuple[int, int, int, int]] = []  # noqa: E741
    c: list[int] = []


def is_motiongen(document: Any) -> bool:
    """Whether a JSON document is a mechanism of MotionGen, or its list of solutions."""
    return isinstance(document, dict) and ({"B", "p"} <= document.keys() or "solutions" in document)


def drawing_from_motiongen(document: Any, left_out: list[Message]) -> PinDrawing:
    """The drawing of a document, or of its first solution.

    >>> four_bar = {"B": [[1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 0, 1, 1], [0, 0, 1, 1, 0]], "S": [],
    ...             "I": [[2, 0, 1, 0]], "p": [[0, 0], [0.5, 1], [3, 0], [3.1, 1.8], [1.35, 3]], "c": [0, 0, 0, 0, 1]}
    >>> drawing = drawing_from_motiongen(four_bar, [])
    >>> [joint.links for joint in drawing.joints][:2], drawing.drives[0].moved
    ([('frame', 'body 1'), ('body 1', 'body 2')], 'body 1')
    """
    if "solutions" in document:
        solutions = document["solutions"]
        if not isinstance(solutions, list) or not solutions:
            raise GrueblerError("solutions: expected at least one mechanism")
        if len(solutions) > 1:
            left_out.append(message("the solutions behind the first: {count}", count=len(solutions) - 1))
        document = solutions[0]
    try:
        record = msgspec.convert(document, _Record)
    except msgspec.ValidationError as error:
        raise GrueblerError("is not a mechanism of MotionGen: {reason}", reason=error) from None
    count = len(record.p)
    if not record.B or any(len(row) != count or not set(row) <= {0, 1} for row in record.B):
        raise GrueblerError("B: expected rows of 0 and 1, as many in each as places p: {count}", count=count)
    bodies = [_FRAME, *(f"body {number}" for number in range(1, len(record.B)))]
    for name, rows in (("S", record.S), ("I", record.I)):
        for row in rows:
            if not all(0 <= number < count for number in row[:3]) or row[3] < 0 or row[3] >= max(2, len(bodies)):
                raise GrueblerError("{name}: {row} names a joint or body that is not there", name=name, row=list(row))
    joints, slots = [], {pin: (start, end, body) for start, pin, end, body in record.S}
    for number, (x, y) in enumerate(record.p):
        links = [body for body, row in zip(bodies, record.B, strict=True) if row[number]]
        slot = None
        if number in slots:
            start, end, body = slots[number]
            (from_x, from_y), (to_x, to_y) = record.p[start], record.p[end]
            slot = atan2(to_y - from_y, to_x - from_x)
            links = [bodies[body], *(link for link in links if link != bodies[body])]
        if links:
            joints.append(DrawnJoint(name=f"P{number}", x=x, y=y, links=tuple(links), slot=slot))
    drives = [_drive(row, record, bodies, slots) for row in record.I]
    left_out.append(no_unit())
    return PinDrawing(frame=_FRAME, joints=tuple(joints), drives=tuple(drive for drive in drives if drive is not None))


def _drive(
    row: tuple[int, int, int, int], record: _Record, bodies: list[str], slots: dict[int, tuple[int, int, int]]
) -> DrawnDrive | None:
    first, pivot, second, sliding = row
    if sliding:
        base = bodies[slots[pivot][2]] if pivot in slots else _FRAME
        return DrawnDrive(f"P{pivot}", base, "")
    fixed = [body for body, members in zip(bodies, record.B, strict=True) if members[first] and members[pivot]]
    moved = [body for body, members in zip(bodies, record.B, strict=True) if members[second] and members[pivot]]
    return DrawnDrive(f"P{pivot}", fixed[0], moved[0]) if fixed and moved else None


def motiongen_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> dict[str, Any]:
    """The document of a drawing in millimetres; slots run between further joints of their links."""
    drawing = drawing_in(drawing, "mm", left_out)
    looked_at = {joint.name for joint in drawing.joints if len(joint.links) == 1}
    drawing, ends = with_slot_ends(drawing)
    numbers = {joint.name: number for number, joint in enumerate(drawing.joints)}
    bodies = list(dict.fromkeys([drawing.frame, *(link for joint in drawing.joints for link in joint.links)]))
    members = {joint.name: joint.links if joint.slot is None else joint.links[1:] for joint in drawing.joints}
    inputs, undriven = [], []
    for drive in drawing.drives or ():
        if drive.joint in ends:
            start, end = ends[drive.joint]
            inputs.append([numbers[start], numbers[drive.joint], numbers[end], 1])
            continue
        arms = [
            next((name for name, links in members.items() if body in links and name != drive.joint), None)
            for body in (drive.fixed, drive.moved)
        ]
        if None in arms:
            undriven.append(drive.joint)
        else:
            inputs.append([numbers[str(arms[0])], numbers[drive.joint], numbers[str(arms[1])], 0])
    if undriven:
        left_out.append(message("drives of joints {joints}", joints=", ".join(undriven)))
    left_out += [message("names of links and points"), NO_UNIT_WRITTEN]
    return {
        "B": [[int(body in members[joint.name]) for joint in drawing.joints] for body in bodies],
        "S": [
            [numbers[start], numbers[pin], numbers[end], bodies.index(drawing.joints[numbers[pin]].links[0])]
            for pin, (start, end) in ends.items()
        ],
        "I": inputs,
        "p": [[joint.x, joint.y] for joint in drawing.joints],
        "c": [int(joint.name in looked_at) for joint in drawing.joints],
    }
