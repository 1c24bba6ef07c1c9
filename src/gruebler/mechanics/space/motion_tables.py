"""Motions in space as tables: drives, outputs, points, and their derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.base.columns import Column, Table
from gruebler.base.text import raised
from gruebler.mechanics.space.motion import SpatialMotion
from gruebler.mechanics.space.outputs import against_frame, output_freedom
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Freedom

_NOISE = 1e-10  # of the largest value in a table: rounding of closed positions, larger in their rates


def spatial_table(
    motion: SpatialMotion,
    outputs: Sequence[str] | None = (),
    points: Sequence[str] = (),
    *,
    by_drive: bool = False,
    lang: str = "en",
) -> Table:
    """A motion as a table: drives, outputs, places of points, and their derivatives in time as far as it has them.

    Derivatives by the drive are those of a motion with a speed of 1. Angles are in degrees, in rates in radians; joints
    have the language's letters.
    """
    linkage, unit, alphabet = motion.linkage, motion.linkage.unit, Alphabet.of_language(lang)
    turning = [drive.turning for drive in linkage.mechanism.drives]
    columns = [
        Column(name, unit="°" if turns else unit, values=np.degrees(values) if turns else values)
        for name, turns, values in zip(linkage.mechanism.drive_names(alphabet), turning, motion.drives.T, strict=True)
    ]
    below = ("rad" if turning[0] else unit) if by_drive else "s"
    most = 2 if by_drive else 3
    for output in outputs or (None,):
        number, freedom = output_freedom(linkage, output)
        name, turns = linkage.mechanism.chain.joint_names(alphabet)[number], Freedom(freedom).turns
        for order in range(min(motion.order, most) + 1):
            values = against_frame(linkage, number) * motion.joint(number, freedom, order)
            degree = turns and not order
            shown = "°" if degree else _unit_of_rate("rad" if turns else unit, below, order)
            columns.append(
                Column(
                    name + "′" * order if by_drive or not order else f"{('ωαj' if turns else 'vaj')[order - 1]} {name}",
                    unit=shown,
                    values=np.degrees(values) if degree else values,
                    natural=1.0 if turns else linkage.size,
                    noise=_NOISE,
                )
            )
    for point in points:
        for order, letter in enumerate(("", "v", "a", "j")[: min(motion.order, most) + 1]):
            for axis, values in zip("xyz", motion.point(point, order=order).T, strict=True):
                shown = _unit_of_rate(unit, below, order)
                columns.append(
                    Column(f"{point} {letter}{axis}", unit=shown, values=values, natural=linkage.size, noise=_NOISE)
                )
    return Table(tuple(columns))


def _unit_of_rate(above: str, below: str, order: int) -> str:
    """Of a derivative of an order; radians by radians are left out.

    >>> _unit_of_rate("rad", "rad", 2), _unit_of_rate("mm", "rad", 2), _unit_of_rate("rad", "mm", 1)
    ('1/rad', 'mm/rad²', 'rad/mm')
    """
    if above == below:
        above, order = ("1" if order > 1 else "" if order else above), order - 1
    return f"{above}/{below}{raised(order) if order > 1 else ''}" if order > 0 else above
