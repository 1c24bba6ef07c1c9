"""The table of a motion in space: drives, outputs and points, row by row."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table
from gruebler.mechanics.space.motion import SpatialMotion
from gruebler.mechanics.space.tree import motions
from gruebler.structure.chain.pairs import Alphabet

_TURNING, _SLIDING = ("", "ω", "α", "j"), ("", "v", "a", "j")
_DEGREES = 180 / np.pi


def spatial_table(
    motion: SpatialMotion,
    outputs: Sequence[str] | None = None,
    points: Sequence[str | tuple[str, float, float, float]] = (),
    lang: str = "en",
) -> Table:
    """Drives, outputs with their rates in time, points with theirs.

    An output that a joint with values ties to the frame shows these values; any other one the vector of its turn from
    the reference pose, about x, y, z, and its angular velocity and acceleration. Angles are in degrees, their rates in
    radians and seconds.
    """
    mechanism = motion.linkage.mechanism
    columns = []
    for k, (name, drive) in enumerate(
        zip(mechanism.drive_names(Alphabet.of_language(lang)), mechanism.drives, strict=True)
    ):
        columns.append(_value(name, drive.turning, motion.linkage.unit, motion.drives[:, k], motion.linkage.size))
    for link in motion.linkage.outputs if outputs is None else outputs:
        motion.link_index(link)
        columns += _output(motion, link, lang)
    for point in points:
        columns += _point(motion, point)
    return Table(tuple(columns))


def _value(name: str, turning: bool, unit: str, values: Reals, size: float) -> Column:
    if turning:
        return Column(name, "°", values * _DEGREES, 180.0)
    return Column(name, unit, values, size)


def _output(motion: SpatialMotion, link: str, lang: str) -> Iterator[Column]:
    mechanism, unit = motion.linkage.mechanism, motion.linkage.unit
    chain = mechanism.chain
    names = chain.joint_names(Alphabet.of_language(lang))
    driven = {(drive.joint, drive.direction) for drive in mechanism.drives}
    tied = False
    for number, joint in enumerate(chain.joints):
        pair = joint.pair
        if {*joint.links} != {link, mechanism.frame} or pair.is_ball or pair.has_contours or pair.has_body_between:
            continue
        tied = True
        freedoms = motions(pair, chain.space)
        sign = 1.0 if joint.links[0] == mechanism.frame else -1.0
        for freedom in freedoms:
            if (number, str(freedom)) in driven:
                continue
            name = names[number] if len(freedoms) == 1 else f"{names[number]}:{freedom}"
            for order in range(motion.order + 1):
                values = sign * motion.joint(number, str(freedom), order)
                if order == 0:
                    yield _value(name, freedom.turns, unit, values, motion.linkage.size)
                elif freedom.turns:
                    yield Column(f"{_TURNING[order]} {name}", f"rad/s{('', '²', '³')[order - 1]}", values, 1.0)
                else:
                    label = f"{unit}/s{('', '²', '³')[order - 1]}"
                    yield Column(f"{_SLIDING[order]} {name}", label, values, motion.linkage.size)
    if tied:
        return
    turn = turn_vector(motion, link) * _DEGREES
    for k, axis in enumerate("xyz"):
        yield Column(f"{link} {axis}", "°", turn[:, k], 180.0)
    for order in range(1, motion.order + 1):
        rate = motion.angular(link, order)
        for k, axis in enumerate("xyz"):
            label = f"rad/s{('', '²', '³')[order - 1]}"
            yield Column(f"{_TURNING[order]}{axis} {link}", label, rate[:, k], 1.0)


def turn_vector(motion: SpatialMotion, link: str) -> Reals:
    """Axis times angle of a link's turn since the reference pose, (rows, 3), radians, below a whole turn."""
    quaternion = motion.quaternion(link)
    size = np.linalg.norm(quaternion[:, 1:], axis=1)
    angle = 2 * np.arctan2(size, quaternion[:, 0])
    scale = np.where(size > 0, angle / np.where(size > 0, size, 1.0), 2.0)
    return np.asarray(quaternion[:, 1:] * scale[:, None])


def _point(motion: SpatialMotion, point: str | tuple[str, float, float, float]) -> Iterator[Column]:
    name = point if isinstance(point, str) else f"{point[0]}:{point[1]:g},{point[2]:g},{point[3]:g}"
    unit, size = motion.linkage.unit, motion.linkage.size
    for order in range(motion.order + 1):
        values = motion.point(point, order)
        label = unit if order == 0 else f"{unit}/s{('', '²', '³')[order - 1]}"
        for k, axis in enumerate("xyz"):
            yield Column(f"{_SLIDING[order]}{axis} {name}", label, values[:, k], size)
