"""Six-bars of Watt's first kind that carry a body through five to eight positions, each exactly.

Generic solutions are followed to a task and judged by motion: those of five and six positions, listed by monodromy, are
data of the package; of seven and eight some are made at random (`six_bar_census`). docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.alt_burmester import GenericSolutions, Problem, load_generic_solutions
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.judging import best_of
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, ranked
from gruebler.design.synthesis.six_bar_census import (
    EIGHT_POSITIONS,
    SEVEN_POSITIONS,
    START_SOLUTIONS,
    as_start_solutions,
    kept_census,
)
from gruebler.design.synthesis.six_bar_functions import FORM, how_followed, how_many, real_solutions, six_bar_solutions
from gruebler.design.synthesis.six_bar_guidance import unknowns_of_guides
from gruebler.design.synthesis.six_bar_shifts import shifting_six_bars
from gruebler.design.synthesis.special_tasks import ALIKE, refuse_one_joint, solved_where_it_lies
from gruebler.design.synthesis.targets import body_targets
from gruebler.design.synthesis.tasks import PIVOTS_OF_SIX_BARS, PositionTask
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

FIVE_POSITIONS = Problem(name="five positions", poses=4, points=0, classes=108, members=1, family="Watt I")
"""Both pivots of the frame are given, and the pin of the body on the coupler."""
SIX_POSITIONS = Problem(name="six positions", poses=5, points=0, classes=5754, members=1, family="Watt I")
"""Both pivots of the frame are given."""
ONE_ANGLE = Problem(
    name="six positions of one angle", poses=5, points=0, classes=884, members=1, family="Watt I", one_angle=True
)
"""Likewise; six-bars that turn the body between the positions."""
_SENSITIVE = 0.2
"""Of the paths: positions near to each other leave so many solutions that depend on them a billion times."""
_SHIFTING, _JUDGED = 400, 40  # six-bars that shift a body: how many are looked at, and judged at most
DRIVES = ("R(frame-crank)", "R(frame-rocker)")
_BODY = str(message("body"))  # its name, which is translated where it is shown
_JOINTS = (
    "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker) "
    f"R(coupler-{_BODY}) R({_BODY}-link) R(link-rocker)"
)
"""At A, C, D, B, H, G, F."""


@solved_where_it_lies
def synthesise_guiding_six_bars(
    task: PositionTask,
    demands: Demands | None = None,
    *,
    starts: int | None = None,
    threads: int | None = None,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> SynthesisResult:
    """Six-bars of Watt's first kind that carry a body through five to eight positions: all of five and six.

    Args:
        task: five or six positions with both pivots of the frame, first that of the crank, then that of the ternary
            rocker, to which the coupler and a link of the body are attached; with five also the pin of the body on the
            coupler, in the first position; seven with the rocker's pivot; eight.
        demands: what a design has to do besides; by default one branch and the order of the task.
        starts: of seven and eight positions: how many of the generic solutions are followed; 20,000 by default.
        threads: that follow paths.
        executor: of seven and eight positions: what follows random six-bars to know more start solutions; the answer
            is the same.
        progress: called with the paths followed and their number; of the first seven or eight positions at first with
            the start solutions that are known.

    Returns:
        `SynthesisResult`: the designs that keep their assembly mode through all positions, driven at one pivot or the
        other, judged by their motion. The notes say how many there are besides. Positions of one angle have, from six
        on, infinitely many that keep it on the whole way: some of these, of six positions if any is accepted.

    Raises `SynthesisError` for other tasks. Cost: 0.2 s of processor time, of six positions 10 s, and 10 to 60 ms for
    each verdict; of seven and eight 5 ms for each start solution, at first 5 ms more.

    >>> places = [(0.5, 0.25, 0), (-0.18, 1.22, 0.6), (-0.87, 1.43, 0.78), (-1.48, 1.26, 0.93), (-1.86, 0.85, 1.13)]
    >>> task = PositionTask(places, fixed_pivots=[(-1.5, 0), (0, 0)], moving_pivots=[(-0.46, -0.77)])
    >>> found = synthesise_guiding_six_bars(task)
    >>> found.count.found, found.count.real
    (108, 34)
    """
    refuse_one_joint(task, demands)
    if PIVOTS_OF_SIX_BARS.get(len(task)) != (len(task.fixed_pivots), len(task.moving_pivots)):
        raise SynthesisError(
            "six-bars carry a body through five positions with both fixed pivots and the pin of the body on the "
            "coupler given, through six with both fixed pivots, seven with that of the ternary rocker, eight with "
            "none; the task has {positions} positions, {fixed} fixed pivots and {moving} moving ones",
            positions=len(task),
            fixed=len(task.fixed_pivots),
            moving=len(task.moving_pivots),
        )
    wanted = (demands or Demands()).of_task(task, _mechanism(DRIVES[0]).chain.links)
    place = _Place.of(task)
    one_angle = len(task) > 5 and bool(np.abs(place.turns - 1).max() <= ALIKE)
    if one_angle and ((shifted := _shifted(task, place, wanted)).designs or len(task) > 6):
        return shifted
    generic = _generic(len(task), one_angle, starts, threads, executor, progress)
    z = six_bar_solutions(
        generic.problem, generic.base, place.parameters, special=_SENSITIVE, threads=threads, progress=progress
    )
    pins = place.pins(real_solutions(z))
    kept = _kept(place, pins, wanted)
    accepted, rejected = ranked(_judged(task, place, pins, kept, wanted))
    notes = [generic.known, *how_followed(len(generic.base.z), len(z), np.any(kept, axis=1), generic.damaged)]
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(z), real=len(pins))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def _shifted(task: PositionTask, place: _Place, wanted: Demands) -> SynthesisResult:
    """Six-bars that keep the angle of the body on the whole way."""
    crank = -complex(place.given[0]) if len(task) == 6 else None
    pins = shifting_six_bars(crank, None if len(task) == 8 else 0j, place.shifts, _SHIFTING)
    kept = _kept(place, pins, wanted)
    some = np.flatnonzero(kept.any(axis=1))[:_JUDGED]
    accepted, rejected = ranked(_judged(task, place, pins[some], kept[some], wanted))
    note = message(
        "The body keeps its angle on the whole way: infinitely many six-bars shift it along the coupler curve of a "
        "four-bar. Those here are from random starts."
    )
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(pins), real=len(pins))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=(note,))


def _kept(place: _Place, pins: Complexes, wanted: Demands) -> Flags:
    """(six-bars, drives) which of them may keep one branch, if that is wanted."""
    return keeps_sides(pins, place.turns, place.shifts) if wanted.one_branch else np.ones((len(pins), 2), bool)


def _judged(task: PositionTask, place: _Place, pins: Complexes, kept: Flags, wanted: Demands) -> list[Design]:
    """Of each six-bar the better one of the drives that are kept."""
    designs: list[Design] = []
    for row, drives in zip(pins * place.size + place.origin, kept, strict=True):
        linkages = (drawn_guide(task, row, drive) for drive, keeps in zip(DRIVES, drives, strict=True) if keeps)
        if drives.any():
            with suppress(LinkageError):  # pins of a link coincide
                designs.append(best_of(linkages, partial(body_targets, task, link=_BODY), wanted, FORM))
    return designs


class _Generic(NamedTuple):
    """Generic solutions, and what is known of their number."""

    problem: Problem
    base: GenericSolutions
    known: Message
    damaged: Path | None = None


def _generic(
    positions: int,
    one_angle: bool,
    starts: int | None,
    threads: int | None,
    executor: Executor | Callable[[], Executor] | None,
    progress: Progress | None,
) -> _Generic:
    """Those of so many positions."""
    if positions <= 6:
        if idle := "starts" if starts is not None else "executor" if executor is not None else "":
            raise SynthesisError(
                "{name}: only of seven and eight positions; of others all solutions are followed", name=idle
            )
        problem = ONE_ANGLE if one_angle else SIX_POSITIONS if positions == 6 else FIVE_POSITIONS
        text = message("Watt I, {count} general positions with these pivots: {classes:,} complex solutions.")
        if one_angle:
            text = message(
                "No six-bar that keeps the angle of the body on the whole way is accepted. Others, {count} general "
                "positions of one angle with these pivots: {classes:,} complex solutions."
            )
        return _Generic(problem, load_generic_solutions(problem), text.filled(count=positions, classes=problem.classes))
    number = START_SOLUTIONS if starts is None else as_start_solutions(starts)
    problem = SEVEN_POSITIONS if positions == 7 else EIGHT_POSITIONS
    census = kept_census(problem, number, threads=threads, executor=executor, progress=progress)
    targets = message("seven positions") if positions == 7 else message("eight positions")
    return _Generic(
        problem, GenericSolutions(census.task, census.z[:number]), how_many(targets, census), census.damaged
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Place:
    """Where a task lies, in its size and seen from the rocker's pivot, or from its first position if that is free."""

    origin: complex
    size: float
    turns: Complexes
    """(positions,)"""
    shifts: Complexes
    """(positions,) where the origin goes."""
    given: Complexes
    """H, B - A, B as far as they are given."""

    @classmethod
    def of(cls, task: PositionTask) -> _Place:
        fixed, moving = ([complex(*pivot) for pivot in pivots] for pivots in (task.fixed_pivots, task.moving_pivots))
        origin = fixed[-1] if fixed else complex(task.origins[0])
        turns = task.turns / task.turns[0]
        shifts = task.origins - origin - turns * (task.origins[0] - origin)
        frame = [fixed[1] - fixed[0]] if len(fixed) == 2 else []
        size = max(float(np.abs(shifts).max()), *map(abs, frame), 0.0) or 1.0
        given = np.array([pin - origin for pin in moving] + frame + [0.0] * bool(fixed), np.complex128)
        return cls(origin=origin, size=size, turns=turns, shifts=shifts / size, given=given / size)

    @property
    def parameters(self) -> Complexes:
        """complex[4, unknowns] as `_core.track` takes it."""
        poses = len(self.turns) - 1
        p = np.zeros((4, unknowns_of_guides(poses)), np.complex128)
        p[0, :poses], p[1, :poses], p[2, :poses] = self.turns[1:], self.shifts[1:], np.conj(self.shifts[1:])
        given = np.stack([self.given, np.conj(self.given)], axis=1).ravel()
        if poses <= 5:
            p[3, :4], given = given[-4:], given[:-4]
        p[3, 2 * poses : 2 * poses + len(given)] = given
        return p

    def pins(self, real: Complexes) -> Complexes:
        """A, C, D, B, H, G, F of real solutions in the first position; (solutions, 7)."""
        if len(self.turns) <= 6:
            real = np.concatenate([real, np.broadcast_to(self.given[-2:], (len(real), 2))], axis=1)
        c, d, f, g, h, frame, b = real.T
        return np.stack([b - frame, b + d + c * (h - b - d), b + d, b, h, g, b + f], axis=1)


def keeps_sides(pins: Complexes, turns: Complexes, shifts: Complexes) -> Flags:
    """Whether each six-bar has one assembly mode in all positions, driven at the crank or at the rocker.

    Args:
        pins: complex[six-bars, 7]: A, C, D, B, H, G, F in the first position.
        turns: complex[positions] of the body.
        shifts: complex[positions] where its origin goes.

    Returns: bool[six-bars, 2]. The angles at the pins where no drive acts keep their sides: between coupler and rocker,
    or crank and coupler, and between body and link. This is necessary for one branch.
    """
    a, c, d, b, h, g, f = (pins[:, [k]] for k in range(7))
    ratio = (c - d) / (h - d)
    a, d, f, h, g = a - b, d - b, f - b, turns * h + shifts - b, turns * g + shifts - b
    # |h - d U| and |g - f U| stay, U the turn of the rocker: linear in U and its inverse.
    (p, k), (q, m) = (
        (arm * np.conj(pin), np.abs(pin) ** 2 - np.abs(pin[:, :1]) ** 2 + 2 * (arm * np.conj(pin[:, :1])).real)
        for pin, arm in ((h, d), (g, f))
    )
    with np.errstate(all="ignore"):
        turn = (k * np.conj(q) - m * np.conj(p)) / (p * np.conj(q) - np.conj(p) * q)
    turn[:, 0] = 1
    d, f = d * turn, f * turn
    c = d + ratio * (h - d)
    body, coupler, crank = (np.imag(np.conj(x) * y) for x, y in ((h - g, f - g), (c - d, d), (a - c, d - c)))
    kept = [(np.sign(sides) == np.sign(sides[:, :1])).all(axis=1) for sides in (coupler, crank)]
    return np.asarray(np.stack(kept, axis=1) & (np.sign(body) == np.sign(body[:, :1])).all(axis=1)[:, None])


def _mechanism(drive: str) -> Mechanism:
    return Mechanism.parse(f"{_JOINTS}; frame=frame; drive={drive}")


def drawn_guide(task: PositionTask, pins: Complexes, drive: str) -> Linkage:
    """The linkage of pins A, C, D, B, H, G, F in the first position."""
    places: dict[str | int, object] = {k: (z.real, z.imag) for k, z in enumerate(pins)}
    points = {"P": (_BODY, task.origins[0].real, task.origins[0].imag)}
    return Linkage.from_drawing(_mechanism(drive), places, points=points, unit=task.unit, outputs=[_BODY])
