"""An output that rests while the crank turns on: six-bars with a dwell, by arcs of coupler curves that are circles.

docs/theory/synthesis-dwells.md.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dwell_search import (
    ROCKER,
    SLIDER,
    RestingSixBar,
    circular_arcs,
    coupler_points,
    placed_outputs,
    swing_of,
    with_least_deviation,
    with_swing,
)
from gruebler.design.synthesis.judging import transmission_fault, verdict_at_rest
from gruebler.design.synthesis.results import EXACT, PASSED, Design, Progress, SolutionCount, SynthesisResult
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import DwellTask
from gruebler.design.synthesis.tightest_demands import tightest_sought
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import measure_transmission
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

NEAR = 0.005
"""An output rests if it strays by less than this part of its swing or stroke, unless the demands say otherwise."""
FORM = "six-bar"
_NAMES = (message("rod"), message("output"))  # links that other linkages do not have, for the catalog of texts
_USUAL = pi / 6  # the transmission angle that is kept where none is demanded
_MARGIN = 0.01  # radians: between the places where it is looked at it may fall a little further
_LONGEST = 10.0  # cranks
_ARCS = 200
_ALIKE = 0.05  # designs whose numbers differ less are one
_ROWS = 1440  # of the motion by which a design is judged
_JOINTS = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(rocker-frame) R(coupler-rod) R(rod-output)"


def synthesise_dwells(
    task: DwellTask, demands: Demands | None = None, *, number: int = 12, progress: Progress | None = None
) -> SynthesisResult:
    """Six-bars whose output rests while the crank turns by an angle, those that rest best first.

    A crank-rocker guides a coupler point along an arc that is nearly a circle; a rod as long as its radius drives the
    output. Its arc, rod and output are improved together until the output strays least from its rest.

    Args:
        task: the swing or stroke, and the crank angle of the rest.
        demands: what counts besides. ``tolerance`` is how far the output may stray from its rest, as a part of its
            swing or stroke, by default 0.005. The transmission angles of rocker and output do not fall below what is
            demanded, by default 30 degrees.
        number: of designs, at most.
        progress: called with the designs improved and their number.

    Returns:
        `SynthesisResult`: each design in the position where its rest begins, judged by its motion over a turn; its
        error is the largest deviation from the middle of the rest, as a part of the swing or stroke. The crank of a
        design for a swing is 1; a stroke fixes the size.

    Raises:
        SynthesisError: demands for a place or for given lengths, which a rest does not have.

    Cost:
        2 s, and 1 s for each design.

    Theory:
        docs/theory/synthesis-dwells.md
    """
    wanted = demands or Demands(tolerance=NEAR)
    wanted = replace(wanted, tolerance=NEAR if wanted.tolerance == Demands.tolerance else wanted.tolerance)
    refused: dict[str, object] = {
        "region": wanted.region,
        "lengths": wanted.lengths or None,
        "frame_direction": wanted.frame_direction,
        "near_pivots": wanted.near_pivots or None,
    }
    if key := next((name for name, value in refused.items() if value is not None), None):
        raise SynthesisError("{key}: a rest is designed without given lengths or places of pivots", key=key)
    designs, notes = _sought(task, wanted, wanted, number=number, progress=progress)
    accepted = tuple(sorted((d for d in designs if d.verdict.accepted), key=lambda d: float(f"{d.verdict.error:.6g}")))
    rejected = tuple(d for d in designs if not d.verdict.accepted)
    if not accepted:
        notes += tightest_sought(task, wanted, lambda *asked: _sought(*asked, number=number)[0])
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(designs), real=len(designs))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def _sought(
    task: DwellTask, demands: Demands, limits: Demands, *, number: int, progress: Progress | None = None
) -> tuple[list[Design], list[Message]]:
    """Designs that were sought within limits, judged by the demands, and what is said of the search."""
    least = (limits.transmission or _USUAL) + _MARGIN
    shortest = 0.5 if limits.size_ratio >= 2 * _LONGEST else max(0.5, min(1.0, _LONGEST / limits.size_ratio))
    longest = min(_LONGEST, shortest * limits.size_ratio)
    kind, size = (SLIDER, 1.0) if task.swing is None else (ROCKER, task.swing)
    arcs = circular_arcs(task.dwell, least, longest, _ARCS)
    starts = [start for arc in arcs for start in placed_outputs(arc, kind, size, least)]
    chosen = _apart(starts, 2 * number, 0.15)
    six_bars: list[RestingSixBar] = []
    for done, start in enumerate(chosen, 1):
        six_bar = with_least_deviation(start, task.dwell, size, least, shortest=shortest, longest=longest)
        try:
            six_bars.append(with_swing(six_bar, task.dwell, size) if kind.fixed_size else six_bar)
        except ValueError:  # no such swing nearby
            continue
        finally:
            if progress is not None:
                progress(done, len(chosen))
    six_bars.sort(key=lambda six_bar: round(_strays(six_bar, task.dwell), 12))
    designs = [_judged(task, six_bar, demands) for six_bar in _apart(six_bars, number, _ALIKE)]
    notes = [
        message(
            "{arcs} arcs of coupler curves that are nearly circles were taken, with {starts} places of the output; the "
            "{chosen} best were improved. There may be better ones.",
            arcs=len(arcs),
            starts=len(starts),
            chosen=len(chosen),
        )
    ]
    if not starts and task.swing is not None:
        notes.append(
            message(
                "No output that was tried swings by about {swing:.4g}°; none is longer than {longest:g} cranks.",
                swing=np.degrees(task.swing),
                longest=longest,
            )
        )
    return designs, notes


def _apart(six_bars: list[RestingSixBar], number: int, least: float) -> list[RestingSixBar]:
    """The first ones whose lengths differ by some part from those of each before."""
    chosen: list[RestingSixBar] = []
    lengths: list[Reals] = []
    for six_bar in six_bars:
        own = np.log(six_bar.kind.lengths(six_bar.numbers))
        if all(np.abs(own - other).max() > least for other in lengths):
            chosen.append(six_bar)
            lengths.append(own)
        if len(chosen) == number:
            break
    return chosen


def _strays(six_bar: RestingSixBar, rest: float) -> float:
    values = np.unwrap(six_bar.outputs(six_bar.numbers[5] + np.linspace(0, rest, 181))[0])
    return float(np.ptp(values)) / 2 / swing_of(six_bar)


def _linkage(task: DwellTask, six_bar: RestingSixBar) -> Linkage:
    """The linkage where its rest begins."""
    kind, numbers = six_bar.kind, six_bar.numbers
    b, _, d = numbers[:3]
    start = numbers[5:6]
    pin, point = complex(np.exp(1j * start)[0]), complex(coupler_points(numbers, start)[0])
    along = (point - pin) / complex(numbers[3], numbers[4])
    end = complex(six_bar.pin(start)[0])
    places: dict[str, complex] = {
        "R(frame-crank)": 0j,
        "R(crank-coupler)": pin,
        "R(coupler-rocker)": pin + b * along,
        "R(rocker-frame)": complex(d),
        "R(coupler-rod)": point,
        "R(rod-output)": end,
    }
    drawn: dict[str | int, object] = {name: (z.real, z.imag) for name, z in places.items()}
    slide = (end.real, end.imag, float(numbers[7]))
    drawn[kind.joint] = (numbers[7], numbers[8]) if kind is ROCKER else slide
    points = {"P": ("coupler", point.real, point.imag)}
    mechanism = Mechanism.parse(f"{_JOINTS} {kind.joint}; frame=frame; drive=R(frame-crank)")
    linkage = Linkage.from_drawing(mechanism, drawn, points=points, unit=task.unit, outputs=["output"])
    return linkage if task.stroke is None else linkage.scaled(task.stroke / swing_of(six_bar))


def _judged(task: DwellTask, six_bar: RestingSixBar, demands: Demands) -> Design:
    """The design with its verdict: by its motion through a turn of the crank, not by the formulas of the search."""
    linkage = _linkage(task, six_bar)
    known, output = verdict_at_rest(linkage, demands), find_output(linkage, "output")
    wanted = task.swing or task.stroke or 1.0
    start = linkage.required_pose["crank"].angle
    resting, turning = (
        move_quietly(linkage, start + np.linspace(0, angle, _ROWS + 1)) for angle in (task.dwell, 2 * pi)
    )
    reasons = [*known.reasons]
    error = transmission = float("nan")
    if not (resting.complete and turning.complete):
        reasons.append(message("the drive does not turn fully"))
    else:
        error = float(np.ptp(output.values(resting))) / 2 / wanted
        transmission = float(measure_transmission(drive_cycle(linkage), output).smallest.mu)
        if transmission < demands.transmission * (1 - EXACT):
            reasons.append(transmission_fault(transmission))
        if error > demands.tolerance:
            reasons.append(
                message("the output strays from its rest by {error:.2g} of its swing or stroke", error=error)
            )
    verdict = replace(
        PASSED,
        turns_fully=turning.complete,
        transmission=transmission,
        size_ratio=known.size_ratio,
        error=error,
        reasons=tuple(reasons),
    )
    targets = None
    if resting.complete:
        probe = Probe(link="output") if output.joint is None else Probe(joint=output.joint)
        targets = Targets((probe,), probe.of_motion(resting)[:: _ROWS // 2, None], wanted)
    drives = tuple(start + task.dwell * share for share in (0.0, 0.5, 1.0))
    return Design(linkage=linkage, verdict=verdict, form=FORM, drives=drives, targets=targets)
