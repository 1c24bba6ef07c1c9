"""Letters as in a textbook: joints A₀, A, B, B₀, lengths a, b, c, d, and the angles of drive and output."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from string import ascii_lowercase, ascii_uppercase

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import ArcShape, Point, Polylines, Shape
from gruebler.pictures.canvas.symbols import RADIUS, arrow_head
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.structure.chain.pairs import Alphabet

_ARCS = (30.0, 38.0)  # pixels of the radius of an angle of the drive and of the output
_BEYOND = 14.0  # pixels by which the line from which an angle is measured extends beyond its arc
_FAR = 50.0  # pixels from a joint to its letter, at most, where the letter can stand on a plate
_SHORT = 0.15  # radians: a smaller angle has no arrow head


def joint_letters(posed: PosedLinkage) -> dict[int, str]:
    """A letter for each turning joint, by number: X₀ on the frame, X the other joint of the link that turns about it.

    The driven joint is A₀. Names of points are not used again.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> from gruebler.pictures.linkage.posed_linkage import posed_linkage
    >>> sorted(joint_letters(posed_linkage(FourBar(25, 70, 40, 70).linkage())).values())
    ['A', 'A_0', 'B', 'B_0']
    """
    mechanism = posed.lower.mechanism
    joints = mechanism.chain.joints
    turning = [k for k, joint in enumerate(joints) if joint.pair.is_turning]
    driven = [drive.joint for drive in mechanism.drives]
    fixed = sorted((k for k in turning if mechanism.frame in joints[k].links), key=lambda k: k not in driven)
    free = [k for k in turning if k not in fixed]
    spare = iter([*(a for a in ascii_uppercase if a not in posed.lower.points), *(f"G{k}" for k in turning)])
    letters: dict[int, str] = {}
    for k in fixed:
        letter = next(spare)
        letters[k] = f"{letter}_0"
        beside = [other for other in free if other not in letters and set(joints[other].links) & set(joints[k].links)]
        letters |= dict.fromkeys(beside[:1], letter)
    return letters | {k: next(spare) for k in free if k not in letters}


def joint_names(context: LayerContext, letters: Sequence[str] = ()) -> list[Shape]:
    """The letters beside their joints, or the names that are given for them."""
    posed, shapes = context.posed, list(context.drawn)
    outlines = [replace(shape, closed=False) if isinstance(shape, Polylines) else shape for shape in shapes]
    texts: list[Shape] = []
    for number, letter in (_given(context, letters) or joint_letters(posed)).items():
        at = _pin(posed, number)
        text = note_near(at, letter, "name", [*shapes, *texts])
        beyond = text.at.minus(at).length > _FAR  # a large plate, on which it then stands
        texts.append(note_near(at, letter, "name", [*outlines, *texts]) if beyond else text)
    return texts


_INDEX = re.compile(r"([^\W\d_])(\d+)")


def _given(context: LayerContext, letters: Sequence[str]) -> dict[int, str]:
    """A name for each turning joint, in the order of the joints; figures behind a letter become an index."""
    chain = context.posed.lower.mechanism.chain
    turning = [k for k, joint in enumerate(chain.joints) if joint.pair.is_turning]
    if letters and len(letters) != len(turning):
        names = chain.joint_names(Alphabet.of_language(context.lang))
        raise LinkageError(
            "expected {count} names of joints, in the order {joints}, but found {found}",
            count=len(turning),
            joints=", ".join(names[k] for k in turning),
            found=len(letters),
        )
    written = (_INDEX.sub(r"\1_\2", letter) if _INDEX.fullmatch(letter) else letter for letter in letters)
    return dict(zip(turning, written, strict=False))


def length_letters(context: LayerContext) -> list[Shape]:
    """A letter at each link between its pins, the driven link first, the frame last; at its sides with an index."""
    posed, mechanism = context.posed, context.posed.lower.mechanism
    driven = [link for drive in mechanism.drives for link in mechanism.chain.joints[drive.joint].links]
    links = sorted(mechanism.chain.links, key=lambda link: (link == mechanism.frame, link not in driven))
    letters = iter([*ascii_lowercase, *(f"l{k}" for k in range(len(links)))])
    shapes: list[Shape] = []
    for link in links:
        sides = list(_sides(posed, link))
        letter = next(letters) if sides else ""
        if link == mechanism.frame:
            shapes += [Polylines((_between(*side),), "dead") for side in sides if _apart(*side)]
        for k, (p, q) in enumerate(sides, 1):
            text = letter if len(sides) == 1 else f"{letter}_{k}"
            shapes.append(note_near(p.plus(q.minus(p), 0.5), text, "name", [*context.drawn, *shapes]))
    return shapes


def driven_angle(posed: PosedLinkage) -> int | None:
    """The first driven joint that turns at the frame, whose angle is φ."""
    mechanism = posed.linkage.mechanism
    turning = (d.joint for d in mechanism.drives if mechanism.chain.joints[d.joint].pair.is_turning)
    return next((k for k in turning if mechanism.frame in mechanism.chain.joints[k].links), None)


def angle_marks(context: LayerContext) -> list[Shape]:
    """φ of the driven link and ψ of the output at their joints with the frame, measured from its x-axis.

    Where the output slides it is β, the inclination of the coupler from the crank pin on, less than half a turn either
    way.
    """
    posed, mechanism = context.posed, context.posed.lower.mechanism
    joints = mechanism.chain.joints
    turning = [k for k, joint in enumerate(joints) if joint.pair.is_turning and mechanism.frame in joint.links]
    output = find_output(posed.linkage, context.output).link
    driven = driven_angle(posed)
    asked = [("φ", k, link) for k in turning if k == driven for link in joints[k].links if link != mechanism.frame][:1]
    drives = {drive.joint for drive in mechanism.drives}
    asked += [("ψ", k, output) for k in turning if output in joints[k].links and k not in drives][:1]
    if len(asked) == 1 and (coupler := _coupler(posed, asked[0][2], output)):
        asked.append(("β", *coupler))
    shapes: list[Shape] = []
    for (letter, number, link), radius in zip(asked, _ARCS, strict=False):
        at = _pin(posed, number)
        others = [p for side in _sides(posed, link) for p in side if p.minus(at).length > 1.0]
        if not others:
            continue
        along = others[0].minus(at)
        turn = math.atan2(-along.y, along.x)
        if letter != "β":
            turn %= 2 * math.pi
        arc = ArcShape(at, radius=radius, begin=0.0, extent=-turn, style="measure")
        line = Polylines((_between(at, at.plus(Point(1.0, 0.0), radius + _BEYOND + RADIUS)),), "dead")
        head = [arrow_head(arc)] if abs(turn) > _SHORT else []
        shapes += [line, arc, *(Polylines(shape.parts, "dot", closed=True) for shape in head)]
        shapes.append(note_near(arc.place(0.5), letter, "name", [*context.drawn, *shapes]))
    return shapes


def _coupler(posed: PosedLinkage, crank: str, output: str) -> tuple[int, str] | None:
    """The turning joint of the crank with a link that turns in an output that slides, and this link."""
    joints = [(k, joint.links) for k, joint in enumerate(posed.lower.mechanism.chain.joints) if joint.pair.is_turning]
    for number, links in joints:
        if crank in links:
            for link in links:
                if link != crank and any({link, output} <= set(other) for _, other in joints):
                    return number, link
    return None


def _pin(posed: PosedLinkage, number: int) -> Point:
    link = posed.lower.mechanism.chain.joints[number].links[0]
    element = posed.lower.elements[number, link]
    return posed.place(LinkPoint(link, element.x, element.y))


def _apart(p: Point, q: Point) -> bool:
    """Whether there is a line between the circles of two joints."""
    return q.minus(p).length > 2 * RADIUS


def _between(p: Point, q: Point) -> tuple[Point, Point]:
    """The line from one joint to another without what lies in their circles."""
    share = RADIUS / q.minus(p).length
    return p.plus(q.minus(p), share), p.plus(q.minus(p), 1 - share)


def _sides(posed: PosedLinkage, link: str) -> Iterator[tuple[Point, Point]]:
    """From pin to pin of a link, in the order of its joints; once around where there are three or more."""
    pins = [LinkPoint(link, e.x, e.y) for (_, owner), e in posed.lower.elements.items() if owner == link and e.is_pin]
    places = [posed.place(pin) for pin in dict.fromkeys(pins)]
    yield from pairwise(places)
    if len(places) > 2:
        yield places[-1], places[0]
