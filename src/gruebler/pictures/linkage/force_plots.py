"""Plots of forces in motion: effort and power over the drive, joint forces in polar form, free motion in its phases."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import number, translate
from gruebler.base.units import metres_of
from gruebler.mechanics.dynamics import InverseDynamics, Simulation
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.axes import Axis, angles, axis_name, decimals, rate_unit
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import Panel, PlottedCurve, PointMarker, draw_panels
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.canvas.styles import LINES
from gruebler.pictures.linkage.curve_plots import square_panel
from gruebler.pictures.structure.messages import title
from gruebler.structure.chain.pairs import Alphabet

_SIZE = Point(520.0, 230.0)
_DOZEN = 12
_NEAR = 0.05  # of the larger side: names of points that are nearer to each other would touch
_THROUGH = 0.04  # of the range: values beyond the curves


@door_that_raises(LinkageError)
def effort_plot(run: InverseDynamics, *, lang: str = "en", name: str = "") -> Figure:
    """The effort of the drive with its mean, and below it the power, over the drive.

    >>> from gruebler.mechanics.dynamics import inverse_dynamics
    >>> from gruebler.mechanics.forces import Loads, RigidBody
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> from gruebler.mechanics.kinematics import from_degrees, move
    >>> engine = move(SliderCrank(30, 50).linkage(), from_degrees(0, 360, 5), speed=100.0)
    >>> effort_plot(inverse_dynamics(engine, Loads(bodies={"slider": RigidBody(2.0)}))).title
    'slider-crank: torque and power of the drive'
    """
    linkage = run.motion.linkage
    across, x = _drive_axis(run.motion)
    turning, metres = linkage.mechanism.drives[0].turning, metres_of(linkage.unit)
    factor = metres if turning else 1.0
    rubbing = run.statics.friction
    effort = factor * run.drive[:, 0]
    lines = [PlottedCurve(x=x, y=effort, name="", style=LINES[0])]
    if rubbing is not None:
        lines[0] = PlottedCurve(x=x, y=effort, name=translate("with friction", lang), style=LINES[0])
        without = factor * rubbing.frictionless[:, 0]
        lines.append(PlottedCurve(x=x, y=without, name=translate("without friction", lang), style=LINES[1]))
    mean = _mean(run.motion.drives[:, 0], effort)
    lines.append(PlottedCurve(x=x[[0, -1]], y=np.full(2, mean), name=translate("mean", lang), style="dead"))
    text = "M in N·m" if turning else "F in N"
    power = metres * run.power[:, 0]
    panels = [
        Panel(across=across, up=_axis(text, [line.y for line in lines]), curves=tuple(lines), size=_SIZE),
        Panel(
            across=across,
            up=_axis("P in W", [power]),
            curves=(PlottedCurve(x=x, y=power, name="", style=LINES[0]),),
            size=_SIZE,
        ),
    ]
    name = title(linkage.mechanism, lang, name)
    called = (
        translate("{name}: torque and power of the drive", lang, name=name)
        if turning
        else translate("{name}: force and power of the drive", lang, name=name)
    )
    return draw_panels(panels, called, run.explain(lang), lang)


@door_that_raises(LinkageError)
def force_plot(
    run: InverseDynamics, points: Sequence[str] | None = None, *, lang: str = "en", name: str = ""
) -> Figure:
    """The forces of joints as curves of the tips of their arrows, with drive values beside the first.

    ``points`` are at most eight joints, by default the pins on the frame. A joint with the frame shows the force on the
    frame, another one that on its last link.
    """
    linkage, motion = run.motion.linkage, run.motion
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    _drive_axis(motion)
    numbers = [
        number
        for number, joint in enumerate(chain.joints)
        if points is None and frame in joint.links and joint.pair.is_turning
    ]
    numbers += [chain.joint_number(joint, error=LinkageError) for joint in points or ()]
    if not 1 <= len(numbers) <= len(LINES):
        raise LinkageError(
            "expected 1 to {most} points or joints, but found {count}", most=len(LINES), count=len(numbers)
        )
    written, paths, names = chain.joint_names(Alphabet.of_language(lang)), list[Complexes](), list[str]()
    for each in numbers:
        link = frame if frame in chain.joints[each].links else chain.joints[each].links[-1]
        x, y = run.statics.force(each, link=link).T
        paths.append(x + 1j * y)
        names.append(translate("{joint} on {link}", lang, joint=written[each], link=link))
    if not any(np.isfinite(path).any() for path in paths):
        raise LinkageError("no row has determined joint forces, so there is nothing to be plotted")
    panel = square_panel(paths, names, ["F_x in N", "F_y in N"], [*_round_values(motion, paths[0], lang), _ORIGIN])
    about = translate("Tips of the forces of {joints}, put at one origin.", lang, joints=", ".join(names))
    called = translate("{name}: joint forces", lang, name=title(linkage.mechanism, lang, name))
    return draw_panels([panel], called, about, lang)


@door_that_raises(LinkageError)
def phase_plot(run: Simulation, *, lang: str = "en", name: str = "") -> Figure:
    """The speed of the drive over its value while a linkage moves by itself; a dot where it starts."""
    _one_drive(run.linkage, len(run))
    turning = run.linkage.mechanism.drives[0].turning
    x, speed = np.degrees(run.drives[:, 0]) if turning else run.drives[:, 0], run.speeds[:, 0]
    across = Axis(
        "φ in °" if turning else axis_name("s₁", run.linkage.unit), (angles if turning else decimals)(*_ends([x]))
    )
    up = _axis("ω in rad/s" if turning else axis_name("v", rate_unit(run.linkage.unit, "s")), [speed])
    start = PointMarker(x=float(x[0]), y=float(speed[0]), text="")
    curve = PlottedCurve(x=x, y=speed, name="", style=LINES[0])
    called = translate("{name}: phase plane", lang, name=title(run.linkage.mechanism, lang, name))
    return draw_panels([Panel(across=across, up=up, curves=(curve,), spots=(start,))], called, run.explain(lang), lang)


_ORIGIN = PointMarker(x=0.0, y=0.0, text="")


def _one_drive(linkage: Linkage, rows: int) -> None:
    if len(linkage.mechanism.drives) != 1 or rows < 2:
        raise LinkageError("a diagram of forces or of free motion has one drive and two rows or more")


def _drive_axis(motion: Motion) -> tuple[Axis, Reals]:
    """The axis of the only drive, and its values in the unit of the axis."""
    linkage, values = motion.linkage, motion.drives[:, 0]
    _one_drive(linkage, len(motion))
    if linkage.mechanism.drives[0].turning:
        return Axis("φ in °", angles(*_ends([np.degrees(values)]), tight=True)), np.degrees(values)
    return Axis(axis_name("s₁", linkage.unit), decimals(*_ends([values]), tight=True)), values


def _axis(text: str, values: Sequence[Reals]) -> Axis:
    low, high = _ends([*values, np.zeros(1)])
    over = _THROUGH * (high - low)
    return Axis(text, decimals(low - over * (low < 0), high + over * (high > 0), few=6))


def _ends(values: Sequence[Reals]) -> tuple[float, float]:
    """The least and the largest value; a range without width gets one."""
    every = np.concatenate(values)
    if not np.isfinite(every).any():
        return 0.0, 1.0
    low, high = float(np.nanmin(every)), float(np.nanmax(every))
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _mean(drive: Reals, effort: Reals) -> float:
    """Over the way of the drive: its work divided by that."""
    good = np.isfinite(effort)
    if good.sum() < 2 or drive[good][-1] == drive[good][0]:
        return math.nan
    return float(np.trapezoid(effort[good], drive[good]) / (drive[good][-1] - drive[good][0]))


def _round_values(motion: Motion, path: Complexes, lang: str) -> list[PointMarker]:
    """Points at round drive values; of points near to each other only the first has a name."""
    linkage, values = motion.linkage, motion.drives[:, 0]
    turning = linkage.mechanism.drives[0].turning
    shown = np.degrees(values) if turning else values
    order = np.argsort(shown)
    good = order[np.isfinite(path[order])]
    low, high = _ends([shown])
    ticks = [
        tick for tick in (angles if turning else decimals)(low, high, few=_DOZEN, tight=True).ticks if tick <= high
    ]
    near = _NEAR * max(np.nanmax(path.real) - np.nanmin(path.real), np.nanmax(path.imag) - np.nanmin(path.imag))
    spots, named = list[PointMarker](), list[complex]()
    for tick in ticks:
        tip = complex(np.interp(tick, shown[good], path[good].real), np.interp(tick, shown[good], path[good].imag))
        apart = all(abs(tip - other) > near for other in named)
        text = number(round(tick, 6) + 0.0, lang, ".4g") + ("°" if turning else f" {linkage.unit}")
        named += [tip] if apart else []
        spots.append(PointMarker(x=tip.real, y=tip.imag, text=text if apart else ""))
    return spots
