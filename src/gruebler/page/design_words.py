"""What is said of designs on the page: how complete and exact they are, why others are left out, what cards tell."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, inf, isnan
from typing import Any

from gruebler.base.events import GOOD
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.design.synthesis import (
    DeadCentreTask,
    Design,
    FunctionTask,
    PathTask,
    PositionTask,
    SynthesisResult,
    Task,
)
from gruebler.design.synthesis.demands import WITHOUT
from gruebler.design.synthesis.given_pivots import OFF_CURVE
from gruebler.design.synthesis.judging import ANOTHER_ORDER, MISSED, SEVERAL_MISSED, TOO_FAR
from gruebler.design.synthesis.targets import GuidedCurve

_BALANCED = message("Balanced: {criteria} count alike.")
_ANGLE, _SIZE, _SENSITIVITY = message("transmission angle"), message("longest link"), message("sensitivity")
BALANCED = _BALANCED.filled(criteria=joined_by_and([_ANGLE, _SIZE, _SENSITIVITY]))
BEST = message("The best of {count}.")
_BEST_OF_OTHERS = message("The best {shown} of the other {count}.")
EXACT = message("All meet the targets exactly.")
NONE = message("No linkage meets all demands: ask for less, or try other targets.")
_FEW_DYADS = message("Of the {theorem} dyads of these positions {real:n} are real; a linkage needs two.")
_AT_BEST = message("Rejected ({count}), at best: {reasons}.")
_OFF_CURVE = message(
    "Through four positions a fixed pivot cannot lie anywhere, but on a curve (the centre-point curve): in place of "
    "({x:.4g} | {y:.4g}) mm its nearest point ({u:.4g} | {v:.4g}) mm is taken, {distance:.3g} mm away."
)
_IN_UNITS = {
    MISSED.text: message(
        "target {target} is missed by {missed}, unless the linkage is taken apart and put together the other way"
    ),
    SEVERAL_MISSED.text: message(
        "targets {targets} are missed, the worst by {missed}, unless the linkage is taken apart and put "
        "together the other way"
    ),
    ANOTHER_ORDER.text: message("the targets are met in another order; in theirs one is missed by {missed}"),
    TOO_FAR.text: message("a target is missed by {missed}"),
}
"""What the library tells in parts of the size of a task."""
_TWO = 2  # dyads that a linkage needs
_MOST_REASONS = 3
"""Kinds of rejections that are told."""
SLENDER = 8
"""Where space is limited, too: the longest length by the shortest."""


def is_curve(task: Task) -> bool:
    """Whether all of a curve is wanted, which is approached, and not single points of it."""
    return isinstance(task, PathTask) and GuidedCurve.of(task) is not GuidedCurve.NONE


def notes(
    result: SynthesisResult, items: Sequence[dict[str, Any]], total: int, *, others: bool = False
) -> Iterator[Message]:
    """How complete and how exact the designs are that are shown, of so many (others are left out); why there is none.

    >>> from gruebler.design.synthesis import Demands, synthesise
    >>> five = ((-40, 0, 0.2), (-15, 18, 0.4), (5, 24, 0.6), (22, 20, 0.8), (35, 10, 1.1))
    >>> for text in notes(synthesise(PositionTask(five), demands=Demands(crank=True)), [], 0):
    ...     print(text)
    No linkage meets all demands: ask for less, or try other targets.
    Designs that meet all but the demand of a drive that turns fully: 1.
    Rejected (1): the drive does not turn fully.
    """
    task, count = result.task, result.count
    yield from (_OFF_CURVE.filled(**note.values) for note in result.notes if note.text == OFF_CURVE[False].text)
    if isinstance(task, PositionTask) and len({angle for *_, angle in task.positions}) == 1:
        yield message("All at one angle: the link is shifted and does not turn.")
    if len(items) < total:
        yield (_BEST_OF_OTHERS if others else BEST).filled(count=total, shown=len(items))
    if not total:
        yield NONE
    elif not any(item["error"] for item in items):
        yield EXACT
    elif is_curve(task):
        yield message("Deviation: the largest distance of a point wanted (purple) from the curve reached (blue).")
    elif isinstance(task, FunctionTask):
        yield message("Deviation: the largest difference between the output wanted and that reached.")
    if not total:
        tightest = [note for note in result.notes if note.text == WITHOUT.text]
        yield from tightest
        if isinstance(task, PositionTask) and count.theorem and count.real < _TWO:
            yield _FEW_DYADS.filled(theorem=count.theorem, real=count.real)
        else:
            yield from _rejections(result, 1 if tightest else _MOST_REASONS)


def _rejections(result: SynthesisResult, number: int = _MOST_REASONS) -> Iterator[Message]:
    """So many reasons with how many have them, those that lack the least first."""
    kinds: dict[tuple[str, ...], list[Design]] = {}
    for design in result.rejected:
        kinds.setdefault(tuple(reason.text for reason in design.verdict.reasons), []).append(design)
    for _, some in sorted(kinds.items(), key=lambda kind: (len(kind[0]), -len(kind[1])))[:number]:
        best = min(some, key=_shortfall)
        texts = {joined(design.verdict.reasons).in_language("en") for design in some}
        text = message("Rejected ({count}): {reasons}.") if len(texts) == 1 else _AT_BEST
        yield text.filled(count=len(some), reasons=joined_by_and(_in_units(best, result.task)))


def _shortfall(design: Design) -> tuple[float, float]:
    """By what designs are told, the best first: their transmission angles, else how far they miss a target."""
    angle, error = design.verdict.transmission, design.verdict.error
    return inf if isnan(angle) else -angle, inf if isnan(error) else error


def _in_units(design: Design, task: Task) -> list[Message]:
    """Why a design is rejected; how far it misses targets is told as a length or an angle."""
    reasons = [*design.verdict.reasons]
    angle = isinstance(task, FunctionTask) and task.output == "angle"
    if isinstance(task, DeadCentreTask) or not (design.targets or angle):
        return reasons
    size = design.targets.size if design.targets else 1.0
    for k, reason in enumerate(reasons):
        if text := _IN_UNITS.get(reason.text):
            missed = size * reason.values["error"]
            far = message("{angle:.3g}°", angle=degrees(missed)) if angle else message("{length:.3g} mm", length=missed)
            reasons[k] = text.filled(**reason.values, missed=far)
    return reasons


def words(
    result: SynthesisResult, items: Sequence[dict[str, Any]], relative: bool, longest: float | None
) -> Iterator[Message]:
    """What stands on the cards of designs, explained, and why others are rejected."""
    if not items:
        return
    task = result.task
    sensitive = any(item["shift"] is not None for item in items)
    approached = any(item["error"] for item in items)
    if sensitive or not relative:
        each = [*[message("deviation")] * approached, _ANGLE, *[_SIZE] * (not relative), *[_SENSITIVITY] * sensitive]
        yield _BALANCED.filled(criteria=joined_by_and(each))
    angles = [(item["range"], item["transmission"]) for item in items]
    if not isinstance(task, DeadCentreTask) and any(None not in both and both[0] < both[1] for both in angles):
        yield message("μ: the least transmission angle; between targets: on the way from the first to the last.")
    if len(items) > 1:
        yield message("Bold: the best value. Orange: a transmission angle below {angle:g}°.", angle=degrees(GOOD))
    if longest is not None:
        yield message(
            "No link is longer than {length:.3g} mm, nor {ratio} times as long as another.",
            length=longest,
            ratio=SLENDER,
        )
    if relative:
        yield message("Of lengths only the ratios count; the longest is 100 mm.")
    else:
        yield message("The longest link counts its points, too, and how far a rod slides.")
    if any(item["point"] for item in items):
        yield message(
            "Coupler point: its place on its link from the joint nearer to the drive, x along the line of both "
            "joints, y to its left."
        )
    if sensitive:
        yield message("Sensitivity: how far a target is off at most if lengths are 0.1 % wrong.")
    if result.count.theorem:  # of a family there are as many others as one likes
        yield from _rejections(result)
