"""Tasks far from the origin of the plane, and positions that one joint passes, or no four-bar.

docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import wraps
from inspect import signature
from math import degrees, hypot
from typing import Any, ParamSpec

import numpy as np

from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, joined_by_and, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyads import Displacements, circle_centre
from gruebler.design.synthesis.results import Design, SynthesisResult
from gruebler.design.synthesis.tasks import PathTask, PositionTask

_FAR = 100.0
"""Sizes of a task: farther from the origin coordinates lack digits that a verdict needs."""
ALIKE = 1e-9
"""Sizes and radians: what a position may be off a common turn or shift."""
_ROUNDED = 1e-3
"""Sizes: what is nearer to one joint is said to be nearly its motion, as of coordinates with three digits."""
_P = ParamSpec("_P")


class NoFourBarError(SynthesisError):
    """No four-bar passes the positions; mechanisms with more links may."""


def solved_where_it_lies(method: Callable[_P, SynthesisResult]) -> Callable[_P, SynthesisResult]:
    """The synthesis of a task far from the origin about its first target; its designs are put back to the task."""
    form = signature(method)

    @wraps(method)
    def solved(*args: _P.args, **options: _P.kwargs) -> SynthesisResult:
        given = form.bind(*args, **options)
        task = given.arguments["task"]
        if not isinstance(task, PositionTask | PathTask):
            return method(*args, **options)
        if isinstance(task, PositionTask):
            x, y, _ = task.positions[0]
        else:
            x, y = next(point for point in task.points if point is not None)
        if hypot(x, y) <= _FAR * task.size:
            return method(*args, **options)
        demands = given.arguments.get("demands")
        if demands is not None and demands.region is not None:
            region = tuple(edge - by for edge, by in zip(demands.region, (x, y, x, y), strict=True))
            given.arguments["demands"] = demands = replace(demands, region=region)
        if demands is not None and demands.near_pivots:
            places = [(u - x, v - y) for u, v in demands.near_pivots]
            given.arguments["demands"] = replace(demands, near_pivots=places)
        given.arguments["task"] = task.shifted(-x, -y)
        try:
            result = method(*given.args, **given.kwargs)
        except SynthesisError as error:
            raise type(error)(error.text, **_places_shifted(error.values, x, y)) from None
        designs, rejected = (tuple(_shifted(each, x, y) for each in row) for row in (result.designs, result.rejected))
        notes = tuple(replace(note, values=_places_shifted(note.values, x, y)) for note in result.notes)
        return replace(result, task=task, designs=designs, rejected=rejected, notes=notes)

    return solved


def _places_shifted(values: Mapping[str, Any], x: float, y: float) -> dict[str, Any]:
    """The values of a sentence with its places, x, y and u, v, at another place of the plane."""
    by = {"x": x, "y": y, "u": x, "v": y}
    return {name: value + by[name] if name in by else value for name, value in values.items()}


def _shifted(design: Design, x: float, y: float) -> Design:
    """The design at another place of the plane."""
    changed: dict[str, Any] = {"linkage": design.linkage.shifted(x, y)}
    if design.targets is not None:
        by = [complex(x, y) if probe.point else 0 for probe in design.targets.probes]
        changed["targets"] = replace(design.targets, values=design.targets.values + np.array(by))
    return replace(design, **changed)


def refuse_one_joint(task: PositionTask, demands: Demands | None = None) -> None:
    """Raises `SynthesisError` for three positions or more that one joint passes, and says where it lies.

    A pivot outside the region that is demanded is no answer; no other four-bar passes the positions either.

    >>> refuse_one_joint(PositionTask([(2, 0, 0), (0, 2, 1.5707963267948966), (-2, 0, 3.141592653589793)]))
    Traceback (most recent call last):
    gruebler.base.errors.SynthesisError: all positions are turns about (0, 0): a link on one pivot there passes them
    """
    if len(task) < 3:
        return
    missed, joint = _one_joint(task)
    if missed > ALIKE:
        return
    if isinstance(joint, float):
        raise SynthesisError(
            "the body keeps its angle on a straight line, inclined by {angle:.6g}°: one slide there passes all "
            "positions",
            angle=joint,
        )
    place = {"x": joint.real, "y": joint.imag}
    region = None if demands is None else demands.region
    if region is not None and not (region[0] <= joint.real <= region[2] and region[1] <= joint.imag <= region[3]):
        raise NoFourBarError(
            "all positions are turns about ({x:.6g}, {y:.6g}), outside the region: a link on one pivot there would "
            "pass them; no four-bar does, but a structure with more links may",
            **place,
        )
    raise SynthesisError(
        "all positions are turns about ({x:.6g}, {y:.6g}): a link on one pivot there passes them", **place
    )


def _one_joint(task: PositionTask) -> tuple[float, complex | float]:
    """By how much one joint misses three positions or more at least, by their size; its pivot, or the angle of a slide.

    The angle is in degrees.
    """
    (q, t), origin, size = Displacements.of(task.origins, task.turns)
    turned = np.abs(q - 1)
    if turned.max() <= ALIKE:
        far = t[np.abs(t).argmax()]
        return float(np.abs(np.imag(np.conj(far) * t)).max() / abs(far)), float(degrees(np.angle(far)) % 180)
    pole = t[turned.argmax()] / (1 - q[turned.argmax()])
    missed, place = float(np.abs(t - (1 - q) * pole).max()), complex(origin + size * pole)
    limit = max(ALIKE, missed) * size
    x, y = (part if abs(part) > limit else 0.0 for part in (place.real, place.imag))
    return missed, complex(x, y)


def nearly_one_joint(task: PositionTask) -> Iterator[Message]:
    """That three positions or more are what one joint does but for rounding, such as of their coordinates.

    >>> print(*nearly_one_joint(PositionTask([(2, 0, 0), (1.732, 1, np.pi / 6), (0, 2, np.pi / 2)])))
    All positions are turns about (0, 0) to within 1.8e-05 of the size: a link on one pivot there passes them that
    closely.
    """
    missed, joint = _one_joint(task) if len(task) > 2 else (np.inf, 0j)
    if not ALIKE < missed <= _ROUNDED:
        return
    if isinstance(joint, float):
        yield message(
            "The body keeps its angle on a straight line, inclined by {angle:.6g}°, to within {missed:.2g} of the "
            "size: one slide there passes the positions that closely.",
            missed=missed,
            angle=joint,
        )
    else:
        yield message(
            "All positions are turns about ({x:.6g}, {y:.6g}) to within {missed:.2g} of the size: a link on one pivot "
            "there passes them that closely.",
            missed=missed,
            x=joint.real,
            y=joint.imag,
        )


def refuse_parallelograms(task: PositionTask) -> None:
    """Raises `SynthesisError` for four or five positions, three of them of one angle: at best a parallelogram.

    A pivot of the body has congruent places in the three, hence all dyads have parallel cranks there.
    """
    if len(task) not in (4, 5):
        return
    turns = task.turns / task.turns[0]
    alike = np.abs(turns[:, None] - turns) <= ALIKE
    some = np.flatnonzero(alike[alike.sum(axis=1).argmax()])
    if len(some) < 3:
        return
    if len(some) < len(task):
        raise NoFourBarError(
            "positions {some} have the same angle: a four-bar that passes them is a parallelogram, which does not "
            "turn its coupler",
            some=joined_by_and([str(k + 1) for k in some]),
        )
    for said in nearly_one_joint(task):
        raise SynthesisError(said)
    places = task.origins - task.origins[0]
    centre = circle_centre(places[:3])
    radii = np.abs(places - centre)
    if not np.ptp(radii) <= ALIKE * max(task.size, radii[0]):
        raise NoFourBarError("the body keeps its angle, but its places lie on no circle: no four-bar passes them")
    centre += task.origins[0]
    raise SynthesisError(
        "the body keeps its angle on a circle about ({x:.6g}, {y:.6g}): every parallelogram with cranks of length "
        "{radius:.6g} passes the positions, parallel to the line from that centre to the first place",
        x=centre.real,
        y=centre.imag,
        radius=radii[0],
    )
