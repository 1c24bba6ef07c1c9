"""The transmission angle of a design in its poses at the targets, with derivatives; docs/theory/synthesis-any.md."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.mechanics.analysis.cam_contacts import LinkPlace
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import NoTransmissionAngleError, pushing_links
from gruebler.mechanics.kinematics.solve import cached_plan

_WEIGHT = 10.0  # against the targets, by their size
_MARGIN = 0.01  # of a cosine: between the targets the angle may be a little less

Pin = tuple[int, str]


class _Line(NamedTuple):
    """A line of a linkage: from one pin to another, or that of a slide."""

    first: Pin
    other: Pin | None
    right: bool
    """Whether it is turned by a right angle."""


class _Turned(NamedTuple):
    """(poses,) the angle of a line; its derivatives by the pose and by the dimensions."""

    angle: Reals
    by_pose: Reals
    by_sizes: Reals


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class LegAngles:
    """Force and way of the legs whose pushed link hangs on the frame, and the cosine that must not be passed."""

    legs: tuple[tuple[_Line, _Line], ...]
    most: float

    @classmethod
    def of(cls, closure: DesignClosure, outputs: tuple[str, ...], least: float) -> LegAngles | None:
        """Those of a design with an output, for the least angle; None if there are none."""
        linkage = closure.linkage.with_outputs(outputs)
        try:
            legs = pushing_links(cached_plan(linkage), find_output(linkage))
        except NoTransmissionAngleError:
            return None
        frame, lines = linkage.mechanism.frame, []

        def key_of(element: LinkPlace, *, line: bool) -> Pin:
            link, place, direction = element
            return next(
                key
                for key, e in closure.linkage.elements.items()
                if (key[1], e.is_line, complex(e.x, e.y)) == (link, line, place)
                and (not line or np.exp(1j * e.place[2]) == direction)
            )

        for leg in legs:
            if leg.guide is None or leg.guide[1][0] != frame:
                continue  # the way of its pin depends on rates, or on the pose of another link
            pushed = key_of(leg.pin, line=False)
            force = _Line(key_of(leg.slide, line=True), None, True) if leg.slide is not None else None
            force = force or _Line(key_of(leg.outer, line=False), pushed, False)
            pair, (_, place, direction) = leg.guide
            fixed = key_of((frame, place, direction), line=pair.is_sliding)
            path = _Line(fixed, None, False) if pair.is_sliding else _Line(fixed, pushed, True)
            lines.append((force, path))
        return cls(legs=tuple(lines), most=float(np.cos(least)) - _MARGIN) if lines else None

    def beyond(self, closure: DesignClosure, q: Reals, p: Reals) -> tuple[Reals, Reals, Reals]:
        """(poses, legs) by how much each passes the limit, else 0, and the derivatives by pose and dimensions."""
        columns = []
        for force, path in self.legs:
            push, gone = (_turned(closure, q, p, line) for line in (force, path))
            apart = gone.angle - push.angle
            cosine = np.sin(apart)
            slope = (_WEIGHT * np.cos(apart) * np.sign(cosine) * (np.abs(cosine) > self.most))[:, None]
            columns.append(
                (
                    _WEIGHT * np.maximum(np.abs(cosine) - self.most, 0),
                    slope * (gone.by_pose - push.by_pose),
                    slope * (gone.by_sizes - push.by_sizes),
                )
            )
        errors, by_pose, by_sizes = (np.stack(each, axis=1) for each in zip(*columns, strict=True))
        return errors, by_pose, by_sizes


def _turned(closure: DesignClosure, q: Reals, p: Reals, line: _Line) -> _Turned:
    """The angle of a line in poses."""
    by_pose, by_sizes = np.zeros((len(q), q.shape[1])), np.zeros((len(q), len(p)))
    right = np.pi / 2 if line.right else 0.0
    if line.other is None:
        at = closure.start[line.first] + 2
        by_sizes[:, at] = 1
        angle = np.full(len(q), p[at] + right)
        if (c := closure.column.get(line.first[1])) is not None:
            by_pose[:, c + 2] = 1
            angle = angle + q[:, c + 2]
        return _Turned(angle, by_pose, by_sizes)
    ends = []
    for pin in (line.first, line.other):
        at, c = closure.start[pin], closure.column.get(pin[1])
        own = complex(p[at], p[at + 1])
        turn = np.ones(len(q), np.complex128) if c is None else np.exp(1j * q[:, c + 2])
        place = turn * own if c is None else turn * own + q[:, c] + 1j * q[:, c + 1]
        ends.append((place, turn, at, c, own))
    gap = ends[1][0] - ends[0][0]
    for sign, (_, turn, at, c, own) in zip((-1, 1), ends, strict=True):
        for k, moved in ((at, turn), (at + 1, 1j * turn)):
            by_sizes[:, k] += sign * np.imag(moved / gap)
        if c is not None:
            for k, moved in ((c, np.ones_like(turn)), (c + 1, 1j * np.ones_like(turn)), (c + 2, 1j * turn * own)):
                by_pose[:, k] += sign * np.imag(moved / gap)
    return _Turned(np.angle(gap) + right, by_pose, by_sizes)
