"""Structure pictures of chains and mechanisms in textbook style: links as bodies, joints as signs.

The places depend on the structure alone: isomorphic chains have the same picture, and the inversions of a chain the
same layout, turned so that the frame is low.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.shapes import Point, Shape, TextShape
from gruebler.pictures.canvas.symbols import (
    SIGNS,
    JointMember,
    JointSign,
    arrow,
    bar,
    foot,
    joint_sign,
    pedestal,
    polygon,
    straight_drive,
    turning_drive,
    widest_gap,
)
from gruebler.pictures.structure.bodies import LayoutBodies
from gruebler.pictures.structure.layout import Layout, lay_out
from gruebler.pictures.structure.messages import describe, title
from gruebler.pictures.structure.orientation import upright
from gruebler.pictures.structure.wheels import RoundBody, wheel_points
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet, Pair
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.isomorphism import canonical_order
from gruebler.structure.mechanism import Mechanism

_LENGTH = 78.0  # pixels from joint to joint, on average
_ASIDE = 17.0  # pixels between the middle of a link and its output arrow
_RING_DRIVE = 14.0  # pixels outside a driven ring
_NARROW = 30.0  # pixels between a joint and another link, at least, unless the picture becomes too large


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedChain:
    """A chain with places for its joints, in pixels: the input for drawing links, joints and drives."""

    chain: Chain
    joints: tuple[Point, ...]
    outlines: dict[str, tuple[Point, ...]]
    """For each link its corners in drawing order, free ends and elbows included."""
    frame: str | None = None
    drives: tuple[tuple[int, str], ...] = ()
    """Driven joints with the direction of the freedom."""
    crossing: frozenset[str] = frozenset()
    """Links drawn with a halo above others."""
    faces: tuple[tuple[int, ...], ...] = ()
    contacts: Mapping[tuple[int, str], str] = field(default_factory=dict)
    """What the bodies of higher pairs are, by joint and link."""
    wheels: Mapping[tuple[int, str], RoundBody] = field(default_factory=dict)
    """Round bodies on their bearings, by joint and link."""
    closed: Mapping[str, bool]
    """For each link whether its outline is closed: that of a polygon or a wheel."""
    bare: frozenset[str] = frozenset()
    """Links without a bar or polygon: wheels, and a frame that is the support of one bearing."""


def draw_structure(
    structure: Chain | Mechanism,
    *,
    labels: bool = False,
    symbols: bool = False,
    contacts: Mapping[tuple[int, str], str] | None = None,
    outputs: Collection[str] = (),
    lang: str = "en",
    name: str = "",
    names: Mapping[str, str] | None = None,
) -> Figure:
    """The structure picture of a chain or a mechanism.

    Options as for `gruebler.draw`; ``contacts`` in the words of `gruebler.pictures.canvas.contacts.CONTACTS`.

    Raises `gruebler.base.errors.ChainError` for an output that is no link.

    >>> picture = draw_structure(Chain.parse("R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston)"))
    >>> len(picture.svg()) < 5000
    True
    """
    from gruebler.pictures.canvas.labels import labels_or_numbers, note_near

    placed = place_joints(structure, contacts)
    shapes = paint(placed, lang)
    for link in outputs:
        shapes += _output(placed, link, shapes)
    if symbols:
        signed = {shape.at for shape in shapes if isinstance(shape, TextShape)}
        for joint, at in zip(placed.chain.joints, placed.joints, strict=True):
            if at not in signed:
                symbol = joint.pair.symbol(Alphabet.of_language(lang))
                shapes.append(note_near(at, symbol, "letter", shapes))
    if labels:
        held = held_outlines(placed)
        outlines = {link: held[link] for link in chain_of(structure).links}
        shapes = labels_or_numbers(outlines, placed.closed, shapes, names)
    return figure_of(shapes, title(structure, lang, name), describe(structure, lang))


def chain_of(structure: Chain | Mechanism) -> Chain:
    """The chain itself, or that of the mechanism."""
    return structure if isinstance(structure, Chain) else structure.chain


def place_joints(
    structure: Chain | Mechanism,
    contacts: Mapping[tuple[int, str], str] | None = None,
    *,
    like: Chain | Mechanism | None = None,
) -> PlacedChain:
    """Places for the joints of a chain or a mechanism, links and joints in canonical order: one for each structure.

    ``contacts`` are those of `draw`. With ``like``, the chain or another mechanism of it, each joint is where it is
    in a picture of that one: so all frames of a chain are told apart by their hatching alone.
    """
    frame, drives = (None, ()) if isinstance(structure, Chain) else (structure.frame, structure.drives)
    low, held = (frame, None) if like is None else _base(like)
    marked = {drive.joint for drive in drives} if like is None else ()
    chain, number = _ordered(chain_of(structure), low if held is None else held, marked)
    plain, places = _ordered(chain)
    touching = _renumbered(chain_of(structure), plain, contacts or {})
    spots = wheel_points(plain, frame, touching)
    bodies = spots.bodies(plain, frame)
    kinds: dict[int, str] = {}
    for joint, p in zip(plain.joints, spots.point_of, strict=True):
        if p is not None:
            kinds.setdefault(p, joint.pair.name)
    inner = tuple(bodies.values())
    layout = _layout_of(tuple(kinds[p] for p in range(len(kinds))), (*inner, *spots.sides(inner)))
    number_of = {link: k for k, link in enumerate(bodies)}
    scale = mean_scale(layout)
    turned = upright(layout, *(None if link is None else number_of.get(link) for link in (low, held)))
    points = [Point(scale * x, -scale * y) for x, y in turned.tolist()]
    at, wheels = spots.touching(points)
    outlines = {link: tuple(points[p] for p in layout.outlines[number_of[link]]) for link in bodies}
    for (contact, link), wheel in sorted(wheels.items(), key=lambda item: item[1].radius):
        if link not in bodies:
            outlines[link] = wheel.outline(touching[contact, link])
    if frame is not None and frame not in outlines:
        outlines[frame] = foot(next(p for p, joint in zip(at, plain.joints, strict=True) if frame in joint.links))
    back = {p: k for k, p in places.items()}
    return PlacedChain(
        chain=chain,
        joints=tuple(at[places[k]] for k in range(len(chain.joints))),
        outlines={link: outlines[link] for link in chain.links},
        frame=frame,
        drives=tuple(sorted((number[drive.joint], drive.direction) for drive in drives)),
        crossing=frozenset(list(bodies)[max(pair)] for pair in layout.crossings if max(pair) < len(bodies)),
        faces=() if wheels else tuple(tuple(back[p] for p in face if p in back) for face in layout.faces),
        contacts=_renumbered(chain_of(structure), chain, contacts or {}),
        wheels={(back[joint], link): wheel for (joint, link), wheel in wheels.items()},
        closed={link: len(bodies[link]) > 2 if link in bodies else link != frame for link in chain.links},
        bare=frozenset({*chain.links} - {*bodies}),
    )


def _base(like: Chain | Mechanism) -> tuple[str | None, str | None]:
    """The link that lies low, and the one that is as low as it may be where the picture stands as that of a chain."""
    return (None, like.links[0]) if isinstance(like, Chain) else (like.frame, None)


def _renumbered(chain: Chain, placed: Chain, contacts: Mapping[tuple[int, str], str]) -> dict[tuple[int, str], str]:
    """The same with the joint numbers of the placed chain, whose joints stand in another order."""
    where = {(joint.pair.name, frozenset(joint.links)): number for number, joint in enumerate(placed.joints)}
    return {
        (where[chain.joints[number].pair.name, frozenset(chain.joints[number].links)], link): shape
        for (number, link), shape in contacts.items()
    }


def _ordered(chain: Chain, frame: str | None = None, drives: Collection[int] = ()) -> tuple[Chain, dict[int, int]]:
    """The chain with links and joints in canonical order, and the new number of each joint."""
    order = canonical_order(chain, frame, drives)
    moved = Chain(
        [chain.joints[k] for k in order.joints], links=[chain.links[i] for i in order.links], space=chain.space
    )
    return moved, {k: place for place, k in enumerate(order.joints)}


@lru_cache(maxsize=4096)
def _layout_of(kinds: tuple[str, ...], bodies: tuple[tuple[int, ...], ...]) -> Layout:
    different = list(dict.fromkeys(kinds))
    return lay_out(LayoutBodies.of([different.index(kind) for kind in kinds], bodies))


def mean_scale(layout: Layout) -> float:
    """Pixels for the longer side: for bars of usual length, more where points would be too near to others."""
    sides = [math.dist(layout.points[a], layout.points[b]) for outline in layout.outlines for a, b in pairwise(outline)]
    usual = _LENGTH / max(float(np.mean(sides)), 1e-9)
    return min(max(usual, _NARROW / max(layout.clearance, 1e-9)), 1.8 * usual)


def paint(placed: PlacedChain, lang: str = "en") -> list[Shape]:
    """Links, joints and drives, in the order of painting; letters of joints in the alphabet of the language."""
    signs = [_sign(placed, number, lang) for number in range(len(placed.chain.joints))]
    discs = sorted((disc for sign, _ in signs for disc in sign.wheels), key=lambda disc: -disc[0])
    corners = _held(placed, signs)
    own = sorted(placed.chain.links, key=lambda link: (link in placed.crossing, -placed.chain.degrees[link]))
    bodies = {link: _link(placed, link, corners[link]) for link in own if link not in placed.bare}
    under = _under_geneva_drives(placed)
    shapes = [shape for link, parts in bodies.items() if link in under for shape in parts]
    shapes += [shape for _, parts in discs for shape in parts]
    shapes += [shape for sign, _ in signs for shape in sign.below]
    shapes += [shape for link, parts in bodies.items() if link not in under for shape in parts]
    if placed.frame in placed.bare:
        shapes += pedestal(next(placed.joints[k] for k, j in enumerate(placed.chain.joints) if placed.frame in j.links))
    shapes += [shape for sign, _ in signs for shape in sign.above]
    for number, direction in placed.drives:
        shapes += _drive(placed, number, direction, signs[number][0])
    return shapes


def _under_geneva_drives(placed: PlacedChain) -> set[str]:
    """The links that bear both bodies of a Geneva drive: over these they would hide the pin in its slot."""
    drives = [
        set(placed.chain.joints[number].links)
        for (number, _), shape in placed.contacts.items()
        if shape == "geneva-driver"
    ]
    joints = [set(joint.links) for joint in placed.chain.joints]
    return {
        link
        for link in placed.chain.links
        for pair in drives
        if all({link, other} in joints for other in pair - {link})
    }


def held_outlines(placed: PlacedChain) -> dict[str, list[Point]]:
    """The corners of each link where it is drawn: at its points of attachment at the joints."""
    return _held(placed, [_sign(placed, number, "en") for number in range(len(placed.chain.joints))])


def _held(placed: PlacedChain, signs: Sequence[tuple[JointSign, list[str]]]) -> dict[str, list[Point]]:
    moved: dict[str, dict[Point, Point]] = {link: {} for link in placed.chain.links}
    for joint, at, (sign, members) in zip(placed.chain.joints, placed.joints, signs, strict=True):
        for link, hold in zip(members, sign.holds, strict=True):
            if link in joint.links:
                moved[link][at] = hold
    return {link: [moved[link].get(corner, corner) for corner in placed.outlines[link]] for link in placed.chain.links}


def _link(placed: PlacedChain, link: str, corners: Sequence[Point]) -> list[Shape]:
    """The body of a link between its corners."""
    shape = polygon if placed.closed[link] else bar
    return shape(corners, is_frame=link == placed.frame, halo=link in placed.crossing)


def towards(placed: PlacedChain, link: str, number: int) -> Point:
    """The direction from a joint to the link."""
    at = placed.joints[number]
    corners = placed.outlines[link]
    if not placed.closed[link] and at in corners:
        k = corners.index(at)
        return corners[k + 1 if k == 0 else k - 1].minus(at)
    middle = Point(sum(p.x for p in corners) / len(corners), sum(p.y for p in corners) / len(corners))
    return middle.minus(at)


def _sign(placed: PlacedChain, number: int, lang: str) -> tuple[JointSign, list[str]]:
    """The sign of a joint and its links in the order of the sign: the frame first, then the larger ones.

    Bearings on one axis have one sign, which the first of them draws.
    """
    joint, at = placed.chain.joints[number], placed.joints[number]
    together = [k for k in range(len(placed.joints)) if placed.joints[k] == at and joint.pair.is_turning]
    on_axis = {link for k in together for link in placed.chain.joints[k].links} or {*joint.links}
    links = sorted(on_axis, key=lambda link: _precedence(placed, link))
    members = []
    for link in links:
        wheel = placed.wheels.get((number, link))
        centre, is_new = (None, True) if wheel is None else (wheel.centre, wheel.is_new)
        members.append(JointMember(towards(placed, link, number), link == placed.frame, centre, is_new))
    has_sign = placed.chain.space is Space.PLANAR and joint.pair.name in SIGNS
    letter = "" if has_sign else letters(joint.pair, lang)
    known = [placed.contacts[number, link] for link in links if (number, link) in placed.contacts]
    sign = joint_sign(joint.pair, at, members, letter=letter, shapes=known)
    return (sign if number == min([*together, number]) else replace(sign, below=(), above=())), links


def _precedence(placed: PlacedChain, link: str) -> tuple[bool, int, int]:
    return link != placed.frame, -placed.chain.degrees[link], placed.chain.index(link)


def letters(pair: Pair, lang: str) -> str:
    """The symbol of a pair that a reader of the language expects, or the German one where there is no other."""
    return pair.symbols.get(Alphabet.of_language(lang)) or pair.symbols[Alphabet.GERMAN]


def _output(placed: PlacedChain, link: str, shapes: list[Shape]) -> list[Shape]:
    """A double arrow along the longest side of a link, on the side where there is more space."""
    from gruebler.pictures.canvas.free_space import Obstacles, complexes

    placed.chain.index(link)  # raises ChainError for an unknown link
    corners = placed.outlines[link]
    first, last = max(pairwise([*corners, corners[0]]), key=lambda side: side[1].minus(side[0]).length)
    along = last.minus(first).unit
    middle = first.plus(last.minus(first), 0.5)
    sides = [middle.plus(along.across, side) for side in (_ASIDE, -_ASIDE)]
    free = Obstacles(shapes).free(complexes(sides), 2 * _ASIDE)
    at = sides[0] if free[0] >= free[1] else sides[1]
    return [shape for sign in (1, -1) for shape in arrow(at, at.plus(along, sign * 11.0), "velocity", "velocity-head")]


def _drive(placed: PlacedChain, number: int, direction: str, sign: JointSign) -> list[Shape]:
    at = placed.joints[number]
    members = placed.chain.joints[number].links
    directions = [towards(placed, link, number) for link in members]
    if Freedom(direction).travels:
        side = sign.axis.across
        lean = sum(side.dot(d.unit) for d in directions)
        return straight_drive(at, sign.axis, Point(-side.x, -side.y) if lean > 0 else side)
    on_axis = [each for each, _ in placed.drives if placed.joints[each] == at]
    rings = [
        wheel.radius
        for (contact, link), wheel in placed.wheels.items()
        if link in members and placed.contacts[contact, link] == "ring" and wheel.centre == at
    ]
    if len(on_axis) > 1 and rings:  # the arrow stands outside the ring
        return turning_drive(at, max(rings) + _RING_DRIVE, -math.pi / 4, math.radians(-50))
    away = widest_gap([math.atan2(d.y, d.x) for d in directions if d.length > 1.0] or [math.pi / 2])
    return turning_drive(at, sign.reach + 9.0 + 9.0 * on_axis.index(number), away)
