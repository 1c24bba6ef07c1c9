"""Constructions of linkages in space by two views that belong together; docs/theory/constructions.md."""

from __future__ import annotations

import cmath
from math import degrees, pi, radians

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.mechanics.space import RSSR
from gruebler.pictures.canvas.construction import (
    Angle,
    Construction,
    Dot,
    DrawnCircle,
    DrawnLine,
    Segment,
    quantity,
)
from gruebler.teaching.constructions.compass import (
    Board,
    coordinates,
    degrees_between,
    line_meets_circle,
    lines_meet,
    meet_left,
    segments,
    turned_angle,
)

_ARM = 40.0  # of the cross
_NAME = 1.45  # arms to the names of the shafts


def universal_joint_in_two_views(beta: float = 40, phi: float = 35) -> Construction:
    """The angle of the output shaft of a universal joint, its input turned by phi from the plane of the shafts."""
    if not (0 < beta < 90 and 0 < phi < 90):
        raise LinkageError("beta and phi must lie between 0 and 90 degrees")
    board = Board(message("Universal joint in two views"))
    plan, o, bend = complex(-3.2 * _ARM), 0j, radians(beta)
    pin = cmath.rect(_ARM, pi / 2 + radians(phi))
    shaft = cmath.rect(1.0, bend)
    board.step(
        "Given: two shafts at β = {beta:g}° in their plane (left), and the view along the input shaft (right). The "
        "arm OA of the cross has turned with the input by φ = {phi:g}° from the plane of the shafts.",
        Segment(plan - _NAME * _ARM, plan, "edge"),
        Segment(plan, plan + _NAME * _ARM * shaft, "edge"),
        Dot(plan, "O′"),
        DrawnCircle(o, _ARM, "edge"),
        Segment(o, pin, "given"),
        Dot(pin, "A"),
        Dot(o, "O"),
        Angle(o, begin=pi / 2, turn=radians(phi), text="φ", radius=30),
        Angle(plan, begin=0.0, turn=bend, text="β", radius=30),
        Segment(o, o + 1j * _ARM, "dead"),
        beta=beta,
        phi=phi,
    )
    direction = 1j * pin / abs(pin)
    board.step(
        "The other arm is at right angles to OA. As OA lies in the picture, the right angle is seen as it is: the "
        "arm lies on the line through O across OA.",
        DrawnLine(o, direction),
    )
    edge = plan + _ARM * 1j * shaft
    low = complex(0.0, -(edge - plan).imag)
    board.step(
        "The ends of that arm go round in a circle across the output shaft, in the plane of the shafts a line with "
        "the ends E′. On the right it has the height of E′ above and below O.",
        Segment(2 * plan - edge, edge),
        Dot(edge, "E′"),
        DrawnLine(edge, 1 + 0j, "dead"),
        DrawnLine(low, 1 + 0j),
    )
    seen = lines_meet(o, direction, low, 1 + 0j)
    true = lines_meet(seen, 1j, complex(0.0, -_ARM), 1 + 0j)
    board.step(
        "Turn the circle into the picture about the level line through O: the height of E′ becomes the radius. The "
        "place T of the arm's line comes to T₀.",
        DrawnLine(complex(0.0, -_ARM), 1 + 0j),
        Segment(seen, true),
        Dot(seen, "T"),
        Dot(true, "T₀"),
    )
    _, end = line_meets_circle(o, true - o, o, _ARM)
    psi = degrees_between(-1 + 0j, end)
    board.step(
        "OT₀ meets the circle in B: the output has turned by ψ = {psi:.4g}° from the level line, "
        "tan ψ = tan φ/cos β. It leads by {lead:.4g}°.",
        Segment(o, true),
        Dot(end, "B"),
        Angle(o, begin=pi, turn=turned_angle(-1 + 0j, end), text="ψ", radius=44),
        psi=psi,
        lead=psi - phi,
    )
    return board.done(psi=psi, lead=psi - phi)


def rssr_in_two_views(
    a: float = 30,
    b: float = 140,
    c: float = 80,
    d: float = 100,
    twist: float = 40,
    crank_offset: float = 0,
    rocker_offset: float = 40,
    phi: float = 60,
) -> Construction:
    """The rocker of a spatial crank with a rod between two balls: a sphere about A cut by the rocker's plane."""
    board = Board(message("Position of an RSSR linkage in two views"))
    turn = radians(twist)
    pin = cmath.rect(a, radians(phi))
    side = complex(max(a, d + c) + 1.2 * b)
    along, across = cmath.rect(1.0, -turn), cmath.rect(1.0, pi / 2 - turn)
    board.step(
        "Given: the crank a = {a:g} in the view along its axis (left), at φ = {phi:g}°, and the view along the "
        "common normal of the axes (right), in which the crank's plane and the rocker's plane, across its axis, "
        "are lines.",
        DrawnCircle(0j, a, "edge"),
        Segment(0j, pin, "given"),
        Segment(0j, complex(d), "dead"),
        Dot(0j, "A₀"),
        Dot(complex(d), "B₀"),
        Dot(pin, "A"),
        Segment(side + crank_offset - 1.3j * a, side + crank_offset + 1.3j * a, "edge"),
        Segment(side, side + (rocker_offset or 0.4 * c) * along, "dead"),
        Segment(
            side + rocker_offset * along - 1.1 * c * across, side + rocker_offset * along + 1.1 * c * across, "edge"
        ),
        Dot(side, "N"),
        a=a,
        phi=phi,
    )
    seen = lines_meet(pin, 1 + 0j, side + crank_offset, 1j)
    board.step("A stands at the same height in both views.", Segment(pin, seen), Dot(seen, "A″"))
    middle = side + rocker_offset * along
    foot = lines_meet(seen, along, middle, across)
    board.step(
        "A has the distance A″F = {far:.4g} from the rocker's plane.",
        Segment(seen, foot),
        Dot(foot, "F"),
        Dot(middle, "M"),
        far=abs(foot - seen),
    )
    _, cut = line_meets_circle(middle, across, seen, b)
    radius = abs(cut - foot)
    board.step(
        "The sphere about A with the rod b = {b:g} cuts this plane in a circle about F. Its radius is "
        "FG = {radius:.4g}, with G where the circle about A″ with b meets the plane's line.",
        DrawnCircle(seen, b),
        Dot(cut, "G"),
        Segment(foot, cut, "given"),
        b=b,
        radius=radius,
    )
    down = -1j * (a + b + c)
    height = ((foot - middle) / across).real
    centre, pivot = complex(pin.real, height) + down, complex(d) + down
    board.step(
        "The view along the rocker's axis, below: F stands under A, above B₀ by MF = {height:.4g}.",
        Segment(pin, centre),
        Segment(complex(d), pivot),
        Segment(pivot - d - 1.2 * c, pivot + 1.5 * c, "dead"),
        Dot(centre, "F₁"),
        Dot(pivot, "B₁"),
        height=height,
    )
    joint = meet_left(centre, radius, pivot, c)
    psi = degrees(turned_angle(1 + 0j, joint - pivot))
    board.step(
        "B is where the circles about F₁ with FG and about B₁ with c = {c:g} meet: ψ = {psi:.4g}°.",
        DrawnCircle(centre, radius),
        DrawnCircle(pivot, c),
        *segments("given", pivot, joint),
        Dot(joint, "B"),
        Angle(pivot, begin=0.0, turn=radians(psi), text="ψ", radius=30),
        c=c,
        psi=psi,
    )
    return board.done(psi=psi, **coordinates(B=joint - pivot))


def dead_centres_of_rssr(
    a: float = 30, b: float = 110, c: float = 60, d: float = 45, crank_offset: float = 100
) -> Construction:
    """Dead centres where the rocker swings in a plane through the crank's axis."""
    size = RSSR(a=a, b=b, c=c, d=d, twist=pi / 2, crank_offset=crank_offset)
    if size.type.key != "crank_rocker":
        raise LinkageError("these lengths make no crank-rocker: {type}", type=size.type.title)
    board = Board(message("Dead centres of an RSSR linkage in two views"))
    right, left, pivot = complex(a, crank_offset), complex(-a, crank_offset), complex(d)
    plan = 1j * (max(crank_offset, c) + 1.6 * a + 20)
    board.step(
        "Given: the rocker c = {c:g} in its plane, in which the crank's axis lies (below), and the crank a = {a:g} "
        "in the view along its axis (above). The crank's plane is a line below, the rocker's plane one above.",
        DrawnCircle(plan, a, "edge"),
        Segment(plan - 1.5 * a, plan + d + c, "dead"),
        Dot(plan, "A₀"),
        DrawnCircle(pivot, c, "edge"),
        Segment(left - 0.4 * a, right + 0.4 * a, "edge"),
        Segment(0j, 1j * crank_offset, "dead"),
        Dot(pivot, "B₀"),
        a=a,
        c=c,
    )
    board.step(
        "The rocker turns back where its ball is as near to, or as far from, the crank's circle as it can be. The "
        "nearest and the farthest place of that circle lie in the plane through the crank's axis: A₁ and A₂.",
        Segment(plan + a, right),
        Segment(plan - a, left),
        Dot(plan + a, "A₁"),
        Dot(plan - a, "A₂"),
        Dot(right, "A₁′"),
        Dot(left, "A₂′"),
    )
    ends = [meet_left(place, b, pivot, c) for place in (right, left)]
    board.step(
        "Circles with the rod b = {b:g} about A₁′ and A₂′ meet the path of the ball in B₁ and B₂.",
        DrawnCircle(right, b),
        DrawnCircle(left, b),
        *segments("given", right, ends[0], pivot),
        *segments("given", left, ends[1], pivot),
        Dot(ends[0], "B₁"),
        Dot(ends[1], "B₂"),
        b=b,
    )
    first, second = (degrees(turned_angle(1 + 0j, end - pivot)) for end in ends)
    swing = abs(degrees(turned_angle(ends[0] - pivot, ends[1] - pivot)))
    board.step(
        "The rocker swings by {swing}. The dead centres are half a turn of the crank apart: both strokes take the "
        "same time.",
        Angle(
            pivot,
            begin=radians(first),
            turn=turned_angle(ends[0] - pivot, ends[1] - pivot),
            text=quantity("ψ_H", swing, "°"),
            radius=34,
        ),
        swing=quantity("ψ_H", swing, "°"),
    )
    return board.done(swing=swing, psi_0=first, psi_180=second)
