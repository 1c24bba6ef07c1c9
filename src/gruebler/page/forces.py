"""What the page shows of forces: torque and joint forces over the range of a drive, and how the linkage falls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import degrees, inf, pi
from statistics import median
from typing import Any

import msgspec
import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, joined, message, number, translate
from gruebler.base.units import metres_of
from gruebler.mechanics.dynamics import InverseDynamics, inverse_dynamics, simulate
from gruebler.mechanics.forces.acting import ActingLoads, moving_links
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.page.force_units import unit_for
from gruebler.page.known_loads import all_springs, springs_of
from gruebler.page.model import link_names, spaced
from gruebler.page.params import LoadedLinkage
from gruebler.page.reader_loads import (
    amounts,
    by_law,
    law_text,
    load_acts,
    middle_of,
    origin_of_masses,
    outer_loads,
    point_masses,
    with_loads,
)

_FREE = message(
    "From rest the drive moves from {start} to {end} in {seconds:n} s and stays between {least} and {most}."
)
_RESTS = message("Nothing moves in {seconds:n} s; the drive stays at {start}.")
_FREE_OF = message("{drive}: from {start} to {end}, between {least} and {most}.")
_STRAIGHT_OF = message("{drive}: from {start} to {end}.")
_MOVED = message("Motion from rest in {seconds:n} s:")
_AT_REST = message("The motion has come to rest.")
_AT_STOP = message("After {seconds:n} s the motion ends at a stop: {drive}, {value}.")
_BALANCE = message("The energy balance holds to within {part:n}\u00a0%.")
_BALANCED = message("The energy balance holds to within 0.001\u00a0%.")
_NOTHING = message("Nothing acts yet: enter masses or loads.")
_APART = message("Two ways to compute them differ by {part:.1e} of the largest load: these forces are not certain.")
_TORQUE = (message("Drive torque"), message("Largest drive torque"), message("Drive torque, RMS"))
_FORCE = (message("Drive force"), message("Largest drive force"), message("Drive force, RMS"))
_HELD = (message("Largest holding torque"), message("Largest holding force"))
_TURNED, _SHIFTED = message("{value:n}°"), message("{value:n} {unit}")
_TURNS, _SLIDES = message("Drive speed"), message("Drive velocity")
_BRAKING = message("braking")
_AT, _WHEN = message("at {place}"), message("{seconds:n} s")
_ON = message("{others} on {link}")
_CERTAIN = 1e-6  # of the largest load: how far two ways to compute forces may differ
_ROWS = 720  # of a turn, so that what is read between two has four digits
_MOST_ROWS = 2160
_NO_ENDS = 0.02  # of a range that the joints limit, at either end: no drive keeps its speed up to where it turns back
_AT_END = 1e-9  # of a range: a drive so near to a stop is at it
_USUAL = 2 * pi  # of a drive, rad/s: one turn; of one with limits about its range
_A_SECOND = 240  # poses of a free motion, whose speeds would be plotted with corners by those of a screen
_NOISE = 1e-7  # of the largest power: what is left of a mean that is none
_ENOUGH = 1e-6  # of each of its steps: for the eye
_ENOUGH_BY_LAW = 1e-4  # where loads change by a law, which takes a hundred times as long
_EXACT = 1e-5  # of an energy: what is less is not told in digits
_SEEN = 0.01  # of the unit of the largest: smaller amounts have a unit of their own
_SLOW = 1e-3  # of the largest speed: what is slower in the last tenth of a free motion has come to rest
_ROUNDING = 1e-9  # of a drive: less of it, in rad or sizes of the linkage, is told as 0
_NOTHING_OF = 1e-6  # of the largest joint force: what is left of one that is none
_ALIKE = 1e-6  # of the largest of some values: those which differ by less are as large


def forces_record(asked: LoadedLinkage, lang: str) -> dict[str, Any]:
    """Effort of the drive and forces of the joints over a range of the drive that runs at constant speed.

    Without anything that acts only what is there to be changed. ``kept`` is there if the reader changed something.
    """
    linkage, loads, usual, kept = with_loads(asked, lang)
    rows = outer_loads(linkage, loads)
    record: dict[str, Any] = {
        "masses": [loads.bodies[link].mass if link in loads.bodies else 0.0 for link in linkage.mechanism.chain.links],
        "springs": springs_of(linkage, loads),
        "loads": msgspec.to_builtins(rows),
        "places": [
            (f"place {row.number}", str(name))
            for row, name in zip(rows, loads.forces, strict=False)
            if row.on == "place"
        ],
        "laws": [law_text(amount).in_language(lang) for amount in amounts(loads)],
        "gravity": any(loads.gravity),
        "speed": asked.speed or usual,
    }
    turning = linkage.mechanism.drives[asked.active].turning
    called, unit, factor = (_TURNS, "1/min", pi / 30) if turning else (_SLIDES, f"{linkage.unit}/s", 1)
    record["rate"] = (called.in_language(lang), unit, factor)
    record["origin"] = origin_of_masses(linkage, asked, record["masses"]).in_language(lang)
    if asked.masses or asked.bars or asked.speed or (asked.gravity, asked.loads, asked.springs) != (None, None, None):
        record["kept"] = kept
    lines = [point_masses(linkage, loads, lang)] if loads.masses else []
    pulling = any(each.law or each.stiffness or each.preload or each.damping for each in all_springs(loads))
    if not (loads.bodies or loads.masses or pulling or any(load_acts(amount) for amount in amounts(loads))):
        return record | {"lines": [_NOTHING.in_language(lang)]}
    active, (low, high) = asked.active, asked.range
    speed = record["speed"] or (_USUAL if asked.full else float(f"{(high - low) / factor:.1g}") * factor)
    if not asked.full and not _are_stops(linkage, asked, low, high, lang):
        low, high = low + _NO_ENDS * (high - low), high - _NO_ENDS * (high - low)
    turns = abs(high - low) / (2 * pi) if turning else 1.0
    values = np.linspace(low, high, 1 + min(_MOST_ROWS, max(_ROWS // 2, round(_ROWS * turns))))
    drives, speeds = np.tile(np.array(asked.drives), (len(values), 1)), np.zeros(len(asked.drives))
    drives[:, active], speeds[active] = values, speed
    motion = move_quietly(linkage, drives, speed=speeds, order=2)
    if not len(motion):
        raise GrueblerError("{message}", message=motion.message(lang))
    run = inverse_dynamics(motion, loads, times=(motion.drives[:, active] - values[0]) / speed)
    if run.disagreement > _CERTAIN:
        lines.append(_APART.filled(part=run.disagreement).in_language(lang))
    lines += filter(None, [motion.message(lang), run.statics.message(lang)])
    effort = _effort(run, active)
    forces, acting = _joint_forces(run, lambda row: _drive_text(motion, active, row), lang), _acting(run)
    _give_units([*forces, *acting])
    return record | {
        "speed": speed,
        "drives": motion.drives[:, active].tolist(),
        "title": _named(asked, active, (_TORQUE if turning else _FORCE)[0], lang),
        "effort": effort.tolist(),
        "unit": unit_for(effort[_largest(effort)], "N·m") if turning else forces[0]["unit"],
        "facts": _facts(run, asked, effort, forces, lang),
        "forces": forces,
        "acting": acting,
        "lines": lines,
    }


def _named(asked: LoadedLinkage, drive: int, text: Message, lang: str) -> str:
    """What something of a drive is called, with the name of the drive if there are several."""
    return ", ".join([text.in_language(lang), *asked.called[drive : drive + 1]])


def _effort(run: InverseDynamics, drive: int) -> Reals:
    """Of a drive that turns in newton metres, of one that slides in newtons."""
    linkage = run.motion.linkage
    turning = linkage.mechanism.drives[drive].turning
    return _short((metres_of(linkage.unit) if turning else 1.0) * run.drive[:, drive])


def _joint_forces(run: InverseDynamics, place: Callable[[int], Message], lang: str) -> list[dict[str, Any]]:
    """By joint and link: both parts in each row, what it is called, how large it is at most, and where."""
    chain = run.motion.linkage.mechanism.chain
    driven = {drive.joint for drive in run.motion.linkage.mechanism.drives}
    each = [
        (k, joint, link, run.statics.force(k, link=link))
        for k, joint in enumerate(chain.joints)
        for link in (joint.links if len(joint.links) > 2 else joint.links[1:])
    ]
    least = _NOTHING_OF * max(float(np.nanmax(np.abs(force), initial=0.0)) for *_, force in each)
    records: list[dict[str, Any]] = []
    for k, joint, link, exact in each:
        force = _short(np.where(np.abs(exact) < least, 0.0, exact))
        others = joined(message(spaced(other)) for other in joint.links if other != link)
        if k in driven and joint.pair.is_sliding and not force.any():
            continue  # of a cylinder, which carries nothing across; what pushes it is the effort of the drive
        row = _largest(sizes := np.hypot(*force.T))
        said = {
            "name": _ON.filled(others=others, link=spaced(link)),
            "note": _AT.filled(place=place(row)),
        }
        words = {key: text.in_language(lang) for key, text in said.items()}
        records.append({"joint": k, "parts": force.T.tolist(), "most": float(sizes[row]), **words})
    return records


def _facts(
    run: InverseDynamics, asked: LoadedLinkage, effort: Reals, forces: list[dict[str, Any]], lang: str
) -> list[dict[str, str]]:
    """The figures of the range, as the page shows them: what they are, their amount, and a note."""
    active, drives = asked.active, run.motion.linkage.mechanism.drives
    turning, metre = drives[active].turning, metres_of(run.motion.linkage.unit)
    _, largest, effective = _TORQUE if turning else _FORCE
    unit, row = "N·m" if turning else "N", _largest(effort)
    power, mean = _short(metre * run.power[:, active]), float(metre * run.mean_power[active])
    mean = 0.0 if abs(mean) < _NOISE * np.nanmax(np.abs(power), initial=0.0) else mean
    seconds = float(np.ptp(run.times))
    strongest = max(forces, key=lambda force: force["most"])
    ends = " … ".join(_drive_text(run.motion, active, end).in_language(lang) for end in (0, -1))
    most = float(power[_largest(power)])

    def at(row: int) -> str:
        return _AT.filled(place=_drive_text(run.motion, active, row)).in_language(lang)

    def braking(value: float) -> str:
        """Of a drive that gives way to what pushes it."""
        return _BRAKING.in_language(lang) if value < 0 else ""

    def held(drive: int) -> tuple[str, float, str, str]:
        """Of a drive that stands still meanwhile."""
        still, turns = _effort(run, drive), drives[drive].turning
        row, text = _largest(still), _HELD[0 if turns else 1]
        return _named(asked, drive, text, lang), abs(still[row]), "N·m" if turns else "N", at(row)

    root_mean_square = (metre if turning else 1.0) * run.root_mean_square[active]
    where = ", ".join(filter(None, [at(row), braking(power[row])]))
    rows: list[tuple[str, float, str, str]] = [
        (_named(asked, active, largest, lang), abs(effort[row]), unit, where),
        (effective.in_language(lang), root_mean_square, unit, ""),
        (translate("Largest drive power", lang), abs(most), "W", braking(most)),
        (translate("Mean drive power", lang), mean, "W", ends),
        (translate("Drive work", lang), mean * seconds, "J", ends),
        (
            translate("Largest joint force", lang),
            strongest["most"],
            "N",
            f"{strongest['note']}, {strongest['name']}",
        ),
        *(held(drive) for drive in range(len(asked.called)) if drive != active),
    ]

    def most_in(unit: str) -> tuple[str, float]:
        """The unit of the largest amount of a kind."""
        return unit_for(max(abs(value) for _, value, its, _ in rows if its == unit), unit)

    return [
        {
            "name": name,
            "text": _amount(value, its, strongest["unit"] if its == "N" else most_in(its), lang),
            "note": note,
        }
        for name, value, its, note in rows
    ]


def _amount(value: float, unit: str, shown: tuple[str, float], lang: str) -> str:
    """So much in three digits, in the unit that is shown unless it is far smaller."""
    called, factor = shown
    if abs(value) < _SEEN * factor:
        called, factor = unit_for(value, unit)
    return f"{_figure(value / factor, 3, lang)} {called}"


def _largest(values: Reals) -> int:
    """The first row in which a value is the largest, but for rounding."""
    sizes = np.nan_to_num(np.abs(values))
    return int(np.argmax(sizes >= (1 - _ALIKE) * sizes.max()))


def _figure(value: float, digits: int, lang: str) -> str:
    """A number with so many digits, as the page writes it."""
    return number(float(f"{value:.{digits}g}"), lang, ".12g").replace("-", "\N{MINUS SIGN}")


def _drive_text(motion: Motion, active: int, row: int) -> Message:
    """The value of one drive in a row, with four digits."""
    value, turning = motion.drives[row, active], motion.linkage.mechanism.drives[active].turning
    return _value_text(float(f"{degrees(value) if turning else value:.4g}"), turning, motion.linkage.unit)


def _value_text(value: float, turning: bool, unit: str) -> Message:
    """A drive value, in degrees or a length, with its unit."""
    return _TURNED.filled(value=value) if turning else _SHIFTED.filled(value=value, unit=unit)


def _acting(run: InverseDynamics) -> list[dict[str, Any]]:
    """Where forces and moments of the loads act, a link and a place there, and how much they are in each row."""
    linkage, chain = run.motion.linkage, run.motion.linkage.mechanism.chain
    loads = replace(run.loads, springs=(), torsion_springs=())
    acting, moving = ActingLoads(linkage, run.motion.links, loads), moving_links(run.motion, run.times)
    forces, moments = acting.forces_at(moving), metres_of(linkage.unit) * acting.moments_on(moving)
    records: list[dict[str, Any]] = []
    for force, spot in zip(forces.T, acting.spots[: len(loads.forces)], strict=False):
        parts = _short(np.stack([force.real, force.imag])).tolist()
        records.append({"at": [chain.index(spot.link), spot.x, spot.y], "parts": parts})
    for link in loads.moments:
        middle, moment = middle_of(linkage, link), _short(moments[:, run.motion.links.index(link)])
        records.append({"at": [chain.index(link), middle.real, middle.imag], "parts": [moment.tolist()]})
    return records


def _give_units(records: list[dict[str, Any]]) -> None:
    """Say in which unit forces are shown, and moments, and how much it is in N, or in N·m.

    All in one, but for those that stay below a tenth of it.
    """
    for dimensions, unit in ((2, "N"), (1, "N·m")):
        alike = [record for record in records if len(record["parts"]) == dimensions]
        most = [float(np.nanmax(np.hypot.reduce(np.array(each["parts"], float)), initial=0.0)) for each in alike]
        usual = _usual_unit(most, unit)
        for record, size in zip(alike, most, strict=True):
            record["unit"] = unit_for(size, unit) if 0 < size < usual[1] / 10 else usual


def _usual_unit(sizes: list[float], unit: str) -> tuple[str, float]:
    """The unit of the size in the middle, or of a tenth of the largest, and how much it is in the given one.

    >>> _usual_unit([300.0, 12000.0, 15000.0], "N"), _usual_unit([20.0, 30.0, 12000.0], "N"), _usual_unit([0.0], "N")
    (('kN', 1000.0), ('N', 1.0), ('N', 1.0))
    >>> _usual_unit([300.0, 1600.0, 144000.0], "N")
    ('kN', 1000.0)
    """
    known = [size for size in sizes if size] or [0.0]
    return unit_for(max(median(known), max(known) / 10), unit)


def fall_record(asked: LoadedLinkage, lang: str) -> dict[str, Any]:
    """Poses of all links, values and speeds of the drives, forces of the joints, 240 a second, under all that acts.

    And why they end if they do too soon: a cylinder of the catalog goes no further than its stops.
    """
    linkage, loads, *_ = with_loads(asked, lang)
    free = replace(loads, motors={})
    names = [linkage.mechanism.chain.joint_names()[drive.joint] for drive in linkage.mechanism.drives]
    start, ends = _between_stops(linkage, asked, lang)
    times = np.arange(round(asked.until * _A_SECOND) + 1) / _A_SECOND
    law = any(by_law(amount) for amount in amounts(free))  # friction by a law is far faster than the motion
    tolerance = _ENOUGH_BY_LAW if law else _ENOUGH
    run = simulate(linkage, free, at=start, until=asked.until, times=times, ends=ends, tolerance=tolerance, stiff=law)
    last = run.drives[-1].copy()
    joint = run.reason.values.get("joint") if run.reason else None
    if joint in ends:  # the last pose that is shown may be just before its stop
        k = names.index(joint)
        last[k] = min(ends[joint], key=lambda end: abs(end - last[k]))
    went_to = np.vstack([run.drives, last])
    spans = np.stack([run.drives[0], last, went_to.min(axis=0), went_to.max(axis=0)], axis=-1)
    went = [
        dict(zip(("start", "end", "least", "most"), _drive_texts(linkage, drive, values), strict=True))
        for drive, values in enumerate(spans.tolist())
    ]
    seconds = float(f"{run.times[-1]:.3g}")
    rests = len({text.in_language(lang) for text in went[0].values()}) == 1
    alone = (_RESTS if rests else _FREE).filled(seconds=seconds, **went[0])
    said = [_MOVED.filled(seconds=seconds) if went[1:] else alone]
    called = asked.called or names
    if went[1:]:
        for name, its in zip(called, went, strict=False):
            straight = [its["least"], its["most"]] in ([its["start"], its["end"]], [its["end"], its["start"]])
            text = _STRAIGHT_OF if straight else _FREE_OF
            said.append(text.filled(drive=name[:1].upper() + name[1:], **its))
    why = run.message(lang)
    late = run.speeds[len(run) * 9 // 10 :]
    if not rests and joint not in ends and np.abs(late).max() < _SLOW * np.abs(run.speeds).max():
        said.append(_AT_REST)
    if joint in ends:
        there = {"drive": called[k], "value": _drive_texts(linkage, k, [last[k]])[0]}
        if len(run) < 2:
            raise GrueblerError(
                "Nothing moves: {drive} is at the end of its range, {value}, and is pushed farther. Move it first.",
                **there,
            )
        said.insert(0, _AT_STOP.filled(seconds=seconds, **there))
        why = ""
    part = float(f"{100 * run.defect:.2g}")
    said.append(_BALANCED if run.defect < _EXACT else _BALANCE.filled(part=part))
    places = np.stack([run.places[0].real, run.places[0].imag], axis=-1)
    turns = np.stack([run.turns.real, run.turns.imag], axis=-1)
    carried = inverse_dynamics(run.motion, free, times=run.times)
    forces = _joint_forces(carried, lambda row: _WHEN.filled(seconds=float(f"{run.times[row]:.3g}")), lang)
    acting = _acting(carried)
    _give_units([*forces, *acting])
    return {
        "rate": _A_SECOND,
        "places": _short(places).reshape(len(run), -1).tolist(),
        "turns": _short(turns).reshape(len(run), -1).tolist(),
        "drives": _short(run.drives).tolist(),
        "speeds": _short(run.speeds).tolist(),
        "forces": forces,
        "acting": acting,
        "lines": [*(line.in_language(lang) for line in said), *filter(None, [why])],
    }


def _are_stops(linkage: Linkage, asked: LoadedLinkage, low: float, high: float, lang: str) -> bool:
    """Whether this range of the drive ends at its stops: its joints might go on beyond both ends.

    A range in which the catalog shows a machine may end next to where the joints limit it: forces grow without bound.
    """
    joint = linkage.mechanism.chain.joint_names()[linkage.mechanism.drives[asked.active].joint]
    least, most = _stops(asked.source, lang).get(joint, (-inf, inf))
    return max(abs(least - low), abs(most - high)) < 1e-6 * (high - low)


def _between_stops(
    linkage: Linkage, asked: LoadedLinkage, lang: str
) -> tuple[list[float], dict[str, tuple[float, float]]]:
    """Where the drives start, and by joint between which stops: of those that stand there, in whatever lap."""
    joints, stops = linkage.mechanism.chain.joint_names(), _stops(asked.source, lang)
    start, ends = list(asked.drives), {}
    for k, drive in enumerate(linkage.mechanism.drives):
        if joints[drive.joint] not in stops:
            continue
        low, high = stops[joints[drive.joint]]
        room = _AT_END * (high - low)
        value = low - room + (start[k] - low + room) % (2 * pi) if drive.turning else start[k]
        if low - room <= value <= high + room:
            start[k] = min(max(value, low), high)
            ends[joints[drive.joint]] = (low, high)
    return start, ends


def _stops(source: str, lang: str) -> dict[str, tuple[float, float]]:
    """By driven joint, named in the reader's language, the least and the largest value of an entry of the catalog."""
    from gruebler.teaching.catalog import entries

    record = entries().get(source)
    if record is None or not record.stops:
        return {}
    linkage = record.linkage()
    mechanism = linkage.renamed(link_names(linkage, source, lang)).mechanism
    names = mechanism.chain.joint_names()
    return {names[drive.joint]: ends for drive, ends in zip(mechanism.drives, record.stops, strict=True) if ends}


def _drive_texts(linkage: Linkage, drive: int, values: list[float]) -> list[Message]:
    """Values of a drive with four digits, in degrees if it turns."""
    turning = linkage.mechanism.drives[drive].turning
    least = _ROUNDING * (1.0 if turning else linkage.size)
    values = [0.0 if abs(value) < least else value for value in values]
    shown = [float(f"{degrees(value) if turning else value:.4g}") for value in values]
    return [_value_text(value, turning, linkage.unit) for value in shown]


def _short(values: Reals) -> Reals:
    """Seven digits of the largest: what is plotted and drawn."""
    largest = float(np.nanmax(np.abs(values), initial=0.0)) or 1.0
    digits = int(7 - np.floor(np.log10(largest)))
    return np.asarray(np.round(values, digits))
