"""What several drives do to the output: the relation of the speeds where it is linear, else one drive at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import nan, pi, tau

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import Message, Text, joined, joined_by_and, message
from gruebler.mechanics.analysis.measure_units import MeasureUnits
from gruebler.mechanics.analysis.messages import output_lines
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import Alphabet

_ALIKE = 1e-9  # of the largest: speeds that vary by less are constant
_STILL = 1e-9  # radians, or sizes: what moves less stands still
_INSIDE = 1e-6  # of a range: so far from its limits, where poses are ill-conditioned, the output is taken
_STEPS = 72  # of a full turn, or of the way of a slide
_ROWS = 361  # in which the output is looked at
_FAR = 3.0  # sizes: a slide that goes on beyond has no limit
_SAMPLES = 8
_UNITS = {False: message("v({link})"), True: message("ω({link})")}

Stops = tuple[float, float] | None


def several_drives_lines(linkage: Linkage, given: Sequence[Stops] = ()) -> Iterator[Message]:
    """The mobility, and how the drives move the output; what a drive is used for lies between its stops, if given."""
    plan = cached_plan(linkage)
    count, output = len(linkage.mechanism.drives), find_output(linkage)
    yield message("{count} drives fix the motion: mobility {count}.", count=count)
    relation = speed_relation(plan, output)
    if relation is not None:
        yield _relation_message(linkage, output, relation)
        return
    for k in range(count):
        yield from _one_drive(plan, output, k, given[k] if k < len(given) else None)


def speed_relation(plan: Plan, output: Output) -> tuple[float, ...] | None:
    """The factors of the speeds of the drives in that of the output; None where they change with the pose.

    The relation is linear if the partial derivatives are the same in poses that were chosen at random (with a seed).
    """
    home, speeds = _home(plan), []
    size = np.array([1.0 if drive.turning else plan.lower.size / 20 for drive in plan.linkage.mechanism.drives])
    away = np.random.default_rng(0).uniform(-1, 1, (_SAMPLES, len(home))) * size
    path = np.concatenate([home[None], home + away])
    for k in range(len(home)):
        motion = move_quietly(plan, path, speed=np.eye(len(home))[k], order=1)
        if not motion.complete:
            return None
        speeds.append(output.values(motion, 1))
    if np.ptp(speeds, axis=1).max() > _ALIKE * np.abs(speeds).max():
        return None
    return tuple(map(float, np.median(speeds, axis=1)))


def _names(linkage: Linkage) -> list[Text]:
    """The joints of the drives, in the symbols of each language."""

    def named(lang: str) -> list[str]:
        return [name.replace('"', "") for name in linkage.mechanism.drive_names(Alphabet.of_language(lang))]

    return [Text(en=en, de=de) for en, de in zip(named("en"), named("de"), strict=True)]


def _relation_message(linkage: Linkage, output: Output, factors: Sequence[float]) -> Message:
    terms: list[object] = []
    for drive, name, factor in zip(linkage.mechanism.drives, _names(linkage), factors, strict=True):
        moved = [link for link in drive.between if link != linkage.mechanism.frame]
        own = _UNITS[drive.turning].filled(link=moved[0] if len(moved) == 1 else name)
        size = abs(round(factor, 9))
        sign = "−" if factor < 0 else "+" if terms else ""
        if size:
            term = own if size == 1 else message("{factor:n} {speed}", factor=size, speed=own)
            terms += [sign, term] if sign else [term]
    speed = _UNITS[output.turning].filled(link=output.link)
    return message("{speed} = {terms}.", speed=speed, terms=joined(terms or [0], " "))


def _one_drive(plan: Plan, output: Output, k: int, given: Stops) -> Iterator[Message]:
    """The range of one drive while the others stay as they are in the reference pose, and how far the output goes."""
    linkage, home = plan.linkage, _home(plan)
    names = _names(linkage)
    low, high, full = (*given, False) if given else _range(plan, home, k)
    units = _units(linkage, output, linkage.mechanism.drives[k].turning)
    others = [
        message("{drive} at {value}", drive=name, value=_units(linkage, output, drive.turning).drive(value))
        for n, (drive, name, value) in enumerate(zip(linkage.mechanism.drives, names, home.tolist(), strict=True))
        if n != k
    ]
    said = [message("With {held} held, {drive} drives.", held=joined_by_and(others), drive=names[k])]
    if np.isfinite([low, high]).all():
        said.append(units.range(full, low, high))
        said += _travel_lines(plan, output, units, home, k, (low, high), full)
    yield joined(said, " ")


def _units(linkage: Linkage, output: Output, turning_drive: bool) -> MeasureUnits:
    return MeasureUnits(
        turning_drive=turning_drive, turning_output=output.turning, unit=linkage.unit, size=linkage.size
    )


def _travel_lines(
    plan: Plan, output: Output, units: MeasureUnits, home: Reals, k: int, ends: tuple[float, float], full: bool
) -> list[Message]:
    inset = 0.0 if full else _INSIDE * (ends[1] - ends[0])
    path = np.repeat(home[None], _ROWS, axis=0)
    path[:, k] = np.linspace(ends[0] + inset, ends[1] - inset, _ROWS)
    motion = move_quietly(plan, path, speed=(path[-1] - path[0]) / (_ROWS - 1), order=1)
    if not motion.complete:
        return []
    places, speeds = output.values(motion), output.values(motion, 1)
    turns = round(float(places[-1] - places[0]) / tau) if full and output.turning else 0
    travel = float(np.ptp(np.concatenate([places, _turning_values(places, speeds)])))
    still = travel <= _STILL * (1.0 if output.turning else plan.lower.size)
    shift = output.shift(motion) if still and output.turning else 0.0
    if shift <= _STILL * plan.lower.size:
        shift = 0.0
    return list(output_lines(units, output.name, still=still, ratio=None, turns=turns, travel=travel, shift=shift))


def _turning_values(values: Reals, rates: Reals) -> Reals:
    """(turns,) the values where a function turns back between rows, from values and rates by the row.

    They are those of the cubics between rows: of 361 of a full turn the error is about 1e-9 of the travel.
    """
    (rows,) = np.nonzero(rates[:-1] * rates[1:] < 0)
    y, z, u, v = values[rows], values[rows + 1], rates[rows], rates[rows + 1]
    t = u / (u - v)
    return y + t * u + t**2 * (3 * (z - y) - 2 * u - v) + t**3 * (u + v - 2 * (z - y))


def _home(plan: Plan) -> Reals:
    """The drive values of the reference pose, else 0."""
    zeros = np.zeros(len(plan.linkage.mechanism.drives))
    return zeros if plan.lower.reference_pose is None else pose_at_reference(plan, zeros).drives


def _range(plan: Plan, home: Reals, k: int) -> tuple[float, float, bool]:
    """From where to where a drive goes, and whether it turns fully; NaN for an end that it does not reach."""
    turning = plan.linkage.mechanism.drives[k].turning
    ends = []
    for sense in (1, -1):
        far = tau if turning else _FAR * plan.lower.size
        path = np.repeat(home[None], _STEPS + 1, axis=0)
        path[:, k] += sense * np.linspace(0, far, _STEPS + 1)
        motion = move_quietly(plan, path)
        if motion.complete and turning:
            return float(home[k]), float(home[k]) + 2 * pi, True
        ends.append(nan if motion.stop is None else float(motion.stop.drives[k]))
    return ends[1], ends[0], False
