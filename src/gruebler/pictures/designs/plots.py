"""Plots of a synthesis: Burmester's curves of four positions, the structural error of a function."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import degrees, pi

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.design.synthesis.burmester import BurmesterCurves, burmester_curves
from gruebler.design.synthesis.coordination import Coordination
from gruebler.design.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.structural_errors import error_extremes, structural_error
from gruebler.design.synthesis.tasks import FunctionTask, PositionTask
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.pictures.canvas.axes import Axis, angles, decimals
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import Panel, PlottedCurve, PointMarker, draw_panels
from gruebler.pictures.canvas.shapes import Point

_LONGER_SIDE = 560.0  # pixels
_FAR = 2.5  # sizes of the task from its middle: poles and pivots that are farther do not enlarge the picture
_SAMPLES = 201
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def finite_poles(task: PositionTask) -> dict[str, complex]:
    """The poles of all pairs of positions, by names such as ``P₁₂``; without those at infinity."""
    named_poles = {}
    for j, k in combinations(range(len(task)), 2):
        turn = task.turns[k] / task.turns[j]
        if abs(turn - 1) > 1e-9:
            name = "P" + f"{j + 1}{k + 1}".translate(_SUBSCRIPTS)
            named_poles[name] = complex((task.origins[k] - turn * task.origins[j]) / (1 - turn))
    return named_poles


def burmester_plot(task: PositionTask, design: Design | None = None, *, lang: str = "en") -> Figure:
    """Circle-point and centre-point curve of four positions, with poles, positions and the pivots of a design.

    Along the circle-point curve tenths of its parameter are marked: what `PositionTask.curve_parameters` picks.
    Raises `SynthesisError` as `burmester_curves`.

    >>> task = PositionTask([(0, 0, 0), (2.1, 0.9, 0.35), (3.2, 1.0, 0.8), (4.0, 0.2, 1.5)])
    >>> burmester_plot(task).title
    "Burmester's curves"
    """
    curves = burmester_curves(task)
    middle, size = complex(task.origins.mean()), task.size
    lines = [] if design is None else _link_lines(design)
    shown = [*task.origins, *finite_poles(task).values(), *(complex(z) for line in lines for _, z in line)]
    shown = [z for z in shown if abs(z - middle) < _FAR * size]
    low = complex(min(z.real for z in shown), min(z.imag for z in shown))
    high = complex(max(z.real for z in shown), max(z.imag for z in shown))
    margin = 0.15 * max(high.real - low.real, high.imag - low.imag, size)
    x, y = (
        decimals(getattr(low, side) - margin, getattr(high, side) + margin, few=6, tight=True)
        for side in ("real", "imag")
    )
    scale = _LONGER_SIDE / max(x.high - x.low, y.high - y.low)
    spots = [PointMarker(x=z.real, y=z.imag, text=name, style="node") for name, z in finite_poles(task).items()]
    spots += [PointMarker(x=z.real, y=z.imag, text=str(k), style="ring") for k, z in enumerate(task.origins, 1)]
    spots += [PointMarker(x=z.real, y=z.imag, text=name) for line in lines for name, z in line]
    spots += _tenths(curves)
    named = {
        "line-1": (translate("circle-point curve, tenths marked", lang), [piece.moving for piece in curves.pieces]),
        "line-2": (translate("centre-point curve", lang), [piece.fixed for piece in curves.pieces]),
        "edge": (translate("links between frame and body", lang), [np.array([z for _, z in line]) for line in lines]),
        "dead": (translate("positions", lang), _frames(task)),
    }
    drawn = [
        PlottedCurve(x=piece.real, y=piece.imag, name=name, style=style)
        for style, (name, pieces) in named.items()
        for piece in pieces
    ]
    panel = Panel(
        across=Axis(f"x in {task.unit}", x),
        up=Axis(f"y in {task.unit}", y),
        curves=tuple(drawn),
        spots=tuple(s for s in spots if x.low <= s.x <= x.high and y.low <= s.y <= y.high),
        size=Point(scale * (x.high - x.low), scale * (y.high - y.low)),
    )
    about = translate(
        "Circle-point curve (pivots on the body, in its first position) and centre-point curve (pivots on the frame) "
        "of four positions; P: poles of two positions; dots: pivots of the design.",
        lang,
    )
    return draw_panels([panel], translate("Burmester's curves", lang), about, lang)


def _link_lines(design: Design) -> list[list[tuple[str, complex]]]:
    """Of both links between frame and coupler the pivots with their names; of a slide the pivot that it has."""
    linkage = design.linkage
    poses = linkage.required_pose
    lines = []
    names = iter((("A₀", "A"), ("B₀", "B")))
    chain = linkage.mechanism.chain
    for side in [link for link in chain.links if link not in (linkage.mechanism.frame, "coupler")]:
        own = [(n, joint) for n, joint in enumerate(chain.joints) if side in joint.links and joint.pair.is_turning]
        fixed_name, moving_name = next(names)
        line = []
        for number, joint in own:
            e = linkage.elements[number, side]
            name = fixed_name if linkage.mechanism.frame in joint.links else moving_name
            line.append((name, complex(*poses[side].put(e.x, e.y))))
        lines.append(line)
    return lines


def _frames(task: PositionTask) -> list[Complexes]:
    """An angle of two short lines at each position."""
    arm = 0.12 * task.size
    return [z + arm * turn * np.array([1.0, 0.0, 0.6j]) for z, turn in zip(task.origins, task.turns, strict=True)]


def _tenths(curves: BurmesterCurves) -> list[PointMarker]:
    """Points of the circle-point curve at tenths of its parameter."""
    marks = []
    for piece, places in zip(curves.pieces, curves.parameters(), strict=True):
        for tenth in range(10):
            if places[0] <= tenth / 10 <= places[-1]:
                a, b = (float(np.interp(tenth / 10, places, part)) for part in (piece.moving.real, piece.moving.imag))
                marks.append(PointMarker(x=a, y=b, text=f"{tenth / 10:g}", style="velocity-head"))
    return marks


def output_of(design: Design, inputs: Reals) -> Reals:
    """The output of a design of a function task at inputs that are counted from its first pair; NaN where it has none.

    The output, too, is counted from the first pair.
    """
    linkage = design.linkage
    link = linkage.outputs[0]
    slides = [
        number
        for number, joint in enumerate(linkage.mechanism.chain.joints)
        if joint.pair.is_sliding and {link, linkage.mechanism.frame} <= set(joint.links)
    ]
    outputs = np.full(len(inputs), np.nan)
    order = np.argsort(inputs)
    for sign in (1, -1):
        rows = order[::sign]
        rows = rows[sign * inputs[rows] >= 0]
        drives = design.drives[0] + np.concatenate([[0.0], inputs[rows]])
        try:
            motion = move_quietly(linkage, drives)
        except LinkageError:
            continue
        value = motion.displacement(slides[0]) if slides else np.unwrap(motion.angle(link))
        done = rows[: len(value) - 1]
        outputs[done] = value[1:] - value[0]
    return outputs


def function_plot(task: FunctionTask, design: Design, *, lang: str = "en") -> Figure:
    """Output over input with the precision pairs; of an expression the structural error below, pairs marked.

    >>> from gruebler.design.synthesis import FunctionLaw, function_task, synthesise
    >>> task = function_task(FunctionLaw("log10(x)", interval=(1, 2), input_swing=pi / 3, output_swing=pi / 3), 3)
    >>> len(function_plot(task, synthesise(task).designs[0]).shapes) > 10
    True
    """
    turning = task.output == "angle"
    unit = 180 / pi if turning else 1.0
    pairs = np.array(task.inputs) - task.inputs[0], (np.array(task.outputs) - task.outputs[0]) * unit
    low, high = float(pairs[0].min()), float(pairs[0].max())
    x: Reals
    if task.law is not None:
        free = replace(task.law, input_start=0.0, output_start=0.0)
        x = np.linspace(*task.law.interval, _SAMPLES)
        inputs = free.inputs(x) - _first(task)[0]
        wanted = (free.outputs(x) - _first(task)[1]) * unit
    else:
        room = 0.1 * (high - low)
        inputs = np.linspace(low - room, high + room, _SAMPLES)
        wanted = np.full(_SAMPLES, np.nan)
    if task.law is not None and design.optimum is not None:
        output = wanted + structural_error(design.optimum.solution, task.law, x) * unit
    else:
        output = output_of(design, inputs) * unit
    across = np.degrees(inputs)
    measure = "°" if turning else task.unit
    scale = angles(float(across.min()), float(across.max()), tight=True)
    across_name = translate("input from the first pair in °", lang)
    spots = tuple(PointMarker(x=degrees(a), y=b, text=str(k)) for k, (a, b) in enumerate(zip(*pairs, strict=True), 1))
    everything = np.concatenate([output[np.isfinite(output)], wanted[np.isfinite(wanted)], pairs[1]])
    curves = [PlottedCurve(x=across, y=output, name=translate("output of the design", lang), style="line-1")]
    if task.law is not None:
        curves.append(PlottedCurve(x=across, y=wanted, name=translate("wanted", lang), style="line-2"))
    panels = [
        Panel(
            across=Axis(across_name, scale),
            up=Axis(
                translate("output in {unit}", lang, unit=measure),
                decimals(float(everything.min()), float(everything.max())),
            ),
            curves=tuple(curves),
            spots=spots,
        )
    ]
    error = output - wanted
    if np.isfinite(error).any():
        marked = tuple(PointMarker(x=degrees(a), y=0.0, text=str(k)) for k, a in enumerate(pairs[0], 1))
        if task.law is not None and design.optimum is not None:
            marked = _extremes(task, task.law, design.optimum.solution, unit)
        panels.append(
            Panel(
                across=Axis(across_name, scale),
                up=Axis(
                    translate("structural error in {unit}", lang, unit=measure),
                    decimals(min(0.0, float(np.nanmin(error))), max(0.0, float(np.nanmax(error)))),
                ),
                curves=(PlottedCurve(x=across, y=error, name=translate("structural error", lang), style="line-3"),),
                spots=marked,
            )
        )
    if design.optimum is None:
        about = translate("The output over the input; dots are the precision pairs.", lang)
    else:
        about = translate(
            "The output over the input and the structural error; dots are the precision pairs from which the search "
            "began, and the extremes of the error.",
            lang,
        )
    return draw_panels(panels, translate("Function and structural error", lang), about, lang)


def _extremes(task: FunctionTask, law: FunctionLaw, solution: Coordination, unit: float) -> tuple[PointMarker, ...]:
    """The extremes of the structural error, in the coordinates of its plot."""
    x = error_extremes(solution, law)
    inputs = replace(law, input_start=0.0).inputs(x) - _first(task)[0]
    errors = structural_error(solution, law, x) * unit
    return tuple(PointMarker(x=degrees(a), y=b, text="") for a, b in zip(inputs, errors, strict=True))


def _first(task: FunctionTask) -> tuple[float, float]:
    """Input and output of the first pair, counted from the begin of the interval."""
    assert task.law is not None
    free = replace(task.law, input_start=0.0, output_start=0.0)
    x = chebyshev_spacing(*task.law.interval, len(task))[:1]
    return float(free.inputs(x)[0]), float(free.outputs(x)[0])
