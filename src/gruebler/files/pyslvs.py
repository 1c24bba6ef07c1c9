"""Expressions of Pyslvs: ``M[J[R, P[0, 0], L[ground, crank]], J[RP, A[30], P[9, 4], L[ground, rod]], ...]``.

A joint lists its links, the frame as ``ground``. R turns; P slides, its first link has the slot, A is the direction of
the slot in degrees; RP is a pin in a slot. A joint of one link is a point of it. The expression says neither unit nor
drive. A file may have more than it in comments, so the drives are written as ``# drive JOINT`` and read from there;
without them pins on the frame are driven, as in most examples of the program. Source: the grammar of the program
(pyslvs/expression_parser.py).
"""

from __future__ import annotations

import re
from math import degrees, radians

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import NO_UNIT_WRITTEN, DrawnDrive, DrawnJoint, PinDrawing, drawing_in, no_unit
from gruebler.files.text_files import read_number

_FRAME = "ground"
_SKIPPED = re.compile(r"(?:\s|#\[[\s\S]*?#\]|#[^\n]*)*")
_TOKEN = re.compile(r"[A-Za-z_][A-Za-z_0-9]*|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[\[\],()]|\S")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
_NO_DRIVE = "# no drive"
_DRIVE = re.compile(r"#\s*drive\s+(\d+)\s+(\w+)\s+(\w+)")


def drawing_from_pyslvs(text: str, left_out: list[Message]) -> PinDrawing:
    """The drawing of an expression; joints are called by their numbers, J0, J1, ...

    >>> drawing = drawing_from_pyslvs("M[J[R, P[0, 0], L[ground, a]], J[RP, A[90], color[red], P[1, 2], L[a, b]]]", [])
    >>> drawing.joints[1].links, drawing.joints[1].slot
    (('a', 'b'), 1.5707963267948966)
    """
    reader = _Reader(text)
    reader.take("M", "[")
    joints: list[DrawnJoint] = []
    colours = False
    while reader.peek() != "]":
        reader.take("J", "[")
        kind = reader.next()
        if kind not in ("R", "P", "RP"):
            raise reader.error(message("expected the joint type R, P or RP, but found {found!r}", found=kind))
        reader.take(",")
        slot = 0.0
        if reader.peek() == "A":
            reader.take("A", "[")
            slot = radians(reader.number())
            reader.take("]", ",")
        if reader.peek() == "color":
            reader.skip_brackets()
            reader.take(",")
            colours = True
        reader.take("P", "[")
        x = reader.number()
        reader.take(",")
        y = reader.number()
        reader.take("]", ",", "L", "[")
        links = []
        while reader.peek() != "]":
            links.append(reader.name())
            reader.comma_or("]")
        reader.take("]", "]")
        reader.comma_or("]")
        if len(set(links)) < len(links):
            raise GrueblerError("joint {number} names a link twice", number=len(joints))
        if links:
            turning = kind == "R"
            joints.append(
                DrawnJoint(
                    name=f"J{len(joints)}",
                    x=x,
                    y=y,
                    links=tuple(links),
                    slot=None if turning else slot,
                    turns=kind != "P",
                )
            )
        else:
            left_out.append(message("joint {number}, which has no link", number=len(joints)))
    reader.take("]")
    reader.finish()
    left_out.append(no_unit())
    if colours:
        left_out.append(message("colours"))
    drives = [
        DrawnDrive(f"J{int(joint[:9])}", fixed, moved)
        for joint, fixed, moved in _DRIVE.findall(text)
        if int(joint[:9]) < len(joints) and {fixed, moved} <= set(joints[int(joint[:9])].links)
    ]
    said = drives or _NO_DRIVE in text
    return PinDrawing(frame=_FRAME, joints=tuple(joints), drives=tuple(drives) if said else None)


class _Reader:
    """The tokens of an expression, one after the other."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._place = 0
        self._advance()

    def _advance(self) -> None:
        start = _SKIPPED.match(self._text, self._place)
        assert start is not None  # it matches nothing, too
        self._start = start.end()
        token = _TOKEN.match(self._text, self._start)
        self._token = "" if token is None else token[0]
        self._place = self._start if token is None else token.end()

    def peek(self) -> str:
        return self._token

    def next(self) -> str:
        token = self._token
        self._advance()
        return token

    def take(self, *tokens: str) -> None:
        for wanted in tokens:
            if self._token != wanted:
                raise self.error(message("expected {wanted!r}, but found {found!r}", wanted=wanted, found=self._token))
            self._advance()

    def comma_or(self, end: str) -> None:
        if self._token != end:
            self.take(",")

    def number(self) -> float:
        return read_number(self.next(), message("coordinate"))

    def name(self) -> str:
        if _NAME.fullmatch(self._token) is None:
            raise self.error(message("expected the name of a link, but found {found!r}", found=self._token))
        return self.next()

    def skip_brackets(self) -> None:
        self.next()
        self.take("[")
        while self.peek() not in ("]", ""):
            self.next()
        self.take("]")

    def finish(self) -> None:
        if self._token:
            raise self.error(message("expected the end, but found {found!r}", found=self._token))

    def error(self, problem: Message) -> GrueblerError:
        line = self._text.count("\n", 0, self._start) + 1
        return GrueblerError("line {line}: {problem}", line=line, problem=problem)


def pyslvs_from_drawing(drawing: PinDrawing, left_out: list[Message]) -> str:
    """The expression of a drawing, one joint a line, in millimetres."""
    drawing = drawing_in(drawing, "mm", left_out)
    names = {drawing.frame: _FRAME}
    for link in dict.fromkeys(link for joint in drawing.joints for link in joint.links):
        plain = re.sub(r"\W", "_", link, flags=re.ASCII)
        plain = plain if _NAME.fullmatch(plain) else f"L{plain}"
        while link not in names and plain in names.values():
            plain += "_"
        names.setdefault(link, plain)
    changed = [link for link, name in names.items() if link not in (name, drawing.frame)]
    if changed:
        left_out.append(message("names of links that are no plain words: {links}", links=", ".join(changed)))
    points = [joint.name for joint in drawing.joints if len(joint.links) == 1]
    if points:
        left_out.append(message("names of points: {points}", points=", ".join(points)))
    left_out.append(NO_UNIT_WRITTEN)
    lines = ["M["]
    for joint in drawing.joints:
        kind = "R" if joint.slot is None else "RP" if joint.turns else "P"
        angle = "" if joint.slot is None else f"A[{degrees(joint.slot)!r}], "
        links = ", ".join(names[link] for link in joint.links)
        lines.append(f"    J[{kind}, {angle}P[{joint.x!r}, {joint.y!r}], L[{links}]],")
    lines.append("]")
    numbers = {joint.name: number for number, joint in enumerate(drawing.joints)}
    drives = [f"# drive {numbers[d.joint]} {names[d.fixed]} {names[d.moved]}" for d in drawing.drives or ()]
    lines += drives or [_NO_DRIVE]
    return "\n".join(lines) + "\n"
