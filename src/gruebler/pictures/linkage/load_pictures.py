"""Masses, springs and forces in the pictures of linkages: docs/theory/drawing.md."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.mechanics.dynamics import inverse_dynamics
from gruebler.mechanics.forces import Gas, Loads, Spring, TorsionSpring
from gruebler.mechanics.forces.acting import ActingLoads, acting_loads, moving_links
from gruebler.mechanics.forces.motion_rates import with_velocities
from gruebler.mechanics.kinematics import Motion
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines
from gruebler.pictures.canvas.symbols import arrow
from gruebler.pictures.linkage.bodies import BodyPart, in_link
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, link_nodes

_MASS = 6.5  # pixels of the radius of a centre of mass
_END = 3.0  # pixels of the radius of an end of a spring
_COILS = 7
_WIDTH = 6.0  # pixels of half a spring's width
_STRAIGHT = 0.18  # the part of a spring's length at both ends that is straight
_BARREL, _FOOT = 0.55, 0.1  # of a gas spring's longest length (a damper's length) its barrel ends, begins there
_INNER, _OUTER, _LEG = 9.0, 24.0, 12.0  # pixels: radii of a spiral, and the leg along its second link
_TURNS = 2.0  # of a spiral at the free angle
_LONGEST = 74.0  # pixels of the longest arrow
_LEAST = 0.03  # of the longest: shorter ones are points

Lines = tuple[Polylines, ...]
"""Of one pose; in all poses of a motion they are as many, with as many points."""


@door_that_raises(LinkageError)
def mass_parts(posed: PosedLinkage, loads: Loads) -> list[BodyPart]:
    """Centres of mass and point masses as the usual circle with two filled quarters, each carried by its link."""
    acting = acting_loads(posed.pose, loads)
    parts = []
    for place in dict.fromkeys(acting.spots[acting.heavy]):
        at = posed.place(place)
        quarters = tuple(
            (at, *(at.plus(Point(math.cos(a), math.sin(a)), _MASS) for a in np.linspace(start, start + math.pi / 2, 7)))
            for start in (0.0, math.pi)
        )
        filled = [Polylines((corners,), "dot", closed=True) for corners in quarters]
        parts.append(in_link(posed, place.link, [CircleShape(at, _MASS, "node"), *filled]))
    return parts


def load_lines(posed: PosedLinkage, motion: Motion, loads: Loads, speed: float | None) -> tuple[Lines, ...]:
    """Springs, and with a speed of the drive forces of joints and loads as arrows, in each row of a motion."""
    acting = acting_loads(motion, loads)
    rows = [[*_springs(posed, motion, row, loads, acting)] for row in range(len(motion))]
    if speed is not None:
        places, forces = _forces(motion, loads, acting, speed)
        longest = float(np.nanmax(np.abs(forces), initial=0.0)) or 1.0
        for row, lines in enumerate(rows):
            for at, force in zip(places[row].tolist(), np.nan_to_num(forces[row] / longest).tolist(), strict=True):
                lines.extend(_arrow(posed.local(at), force))
    return tuple(map(tuple, rows))


def _springs(posed: PosedLinkage, motion: Motion, row: int, loads: Loads, acting: ActingLoads) -> Iterator[Polylines]:
    for k, spring in enumerate(loads.springs):
        first = acting.heavy.stop + 2 * k
        near, far = (
            posed.local(complex(motion.complex_point(place)[row])) for place in acting.spots[first : first + 2]
        )
        yield from _spring(spring, near, far, posed.scale)
        yield from (_end(at) for at in (near, far))
    for turning in loads.torsion_springs:
        yield from _spiral(posed, motion, row, turning)


def _spiral(posed: PosedLinkage, motion: Motion, row: int, spring: TorsionSpring) -> Iterator[Polylines]:
    """About the pin of its links, held by the first, with a leg along the second; nothing where they have no pin."""
    linkage, between = motion.linkage, spring.between
    chain = linkage.mechanism.chain
    pins = [k for k, joint in enumerate(chain.joints) if joint.pair.is_turning and set(joint.links) == set(between)]
    if not pins:
        return
    at = posed.local(complex(motion.complex_point(chain.joint_names()[pins[0]])[row]))
    element = linkage.elements[pins[0], between[1]]
    along = np.mean(link_nodes(linkage, between[1])) - complex(element.x, element.y)
    start, end = (float(motion.angle(link)[row]) for link in between)
    drawn = math.remainder(end - start - spring.free_angle, 4 * math.pi)
    outer = end + float(np.angle(along))
    part = np.linspace(0, 1, 61)
    z = (_INNER + (_OUTER - _INNER) * part) * np.exp(1j * (outer - (1 - part) * (2 * math.pi * _TURNS + drawn)))
    z = np.concatenate([[z[0] / 2], z, [z[-1] * (1 + _LEG / _OUTER)]])
    yield Polylines((tuple(at.plus(Point(w.real, -w.imag)) for w in z.tolist()),), "edge")


def _end(at: Point) -> Polylines:
    """A dot where a spring is fastened, in the frame and in links alike."""
    turn = np.linspace(0, 2 * math.pi, 12, endpoint=False).tolist()
    return Polylines((tuple(at.plus(Point(math.cos(a), math.sin(a)), _END) for a in turn),), "dot", closed=True)


def _spring(spring: Spring, near: Point, far: Point, scale: float) -> Iterator[Polylines]:
    """A zigzag; a gas spring is a barrel with its rod, a damper alone a piston in an open cylinder."""
    along = far.minus(near)
    side = along.unit.across

    def at(part: float, across: float = 0.0) -> Point:
        return near.plus(along, part).plus(side, across)

    gas = spring.law if isinstance(spring.law, Gas) else None
    if gas is not None or (spring.law is None and not spring.stiffness and not spring.preload):
        end = _BARREL if gas is None else min(_BARREL * scale * gas.extended / max(along.length, 1.0), 0.95)
        piston = end if gas is not None else end - 0.15
        rim = (at(end, _WIDTH), at(_FOOT, _WIDTH), at(_FOOT, -_WIDTH), at(end, -_WIDTH))
        yield Polylines(((near, at(_FOOT)), rim, (at(piston, _WIDTH), at(piston, -_WIDTH)), (at(piston), far)), "edge")
        return
    bends = np.linspace(_STRAIGHT, 1 - _STRAIGHT, 2 * _COILS + 1).tolist()
    sides = [0.0, *(_WIDTH * (-1) ** k for k in range(2 * _COILS - 1)), 0.0]
    yield Polylines(((near, *map(at, bends, sides), far),), "edge")


def _arrow(at: Point, force: complex) -> list[Polylines]:
    """From a point in the direction of a force; the longest is 1. A point where there is hardly a force."""
    if abs(force) < _LEAST:
        return [Polylines(((at, at),), "velocity"), Polylines(((at, at, at),), "velocity-head", closed=True)]
    along = Point(force.real, -force.imag)
    tip = at.plus(along.unit, max(_LONGEST * along.length - 7.0, 1.0))
    return [shape for shape in arrow(at, tip, "velocity", "velocity-head") if isinstance(shape, Polylines)]


def _forces(motion: Motion, loads: Loads, acting: ActingLoads, speed: float) -> tuple[Complexes, Complexes]:
    """(rows, forces): where forces act, and how large they are, at an even speed of the drive.

    Those of joints act on the link that `Statics.force` takes; then come those of the loads.
    """
    chain = motion.linkage.mechanism.chain
    joints = range(len(chain.joints))
    shape = len(motion), len(joints) + len(loads.forces)
    places, forces = np.full(shape, np.nan, np.complex128), np.full(shape, np.nan, np.complex128)
    for rows, moved in with_velocities(motion, np.array([speed]), order=2):
        run = inverse_dynamics(moved, loads)
        for joint in joints:
            places[rows, joint] = moved.complex_point(chain.joint_names()[joint])
            forces[rows, joint] = run.statics.force(joint) @ np.array([1, 1j])
        forces[rows, len(joints) :] = acting.forces_at(moving_links(moved))[:, : len(loads.forces)]
        for column, spot in enumerate(acting.spots[: len(loads.forces)], len(joints)):
            places[rows, column] = moved.complex_point(spot)
    return places, forces
