"""What is said of measures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import isclose

from gruebler.base.errors import GrueblerError
from gruebler.base.events import ChangePoint, DeadCentre, TransmissionExtremes
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.analysis.cam_contacts import CamContour
from gruebler.mechanics.analysis.events import Dwell
from gruebler.mechanics.analysis.measure_units import MeasureUnits, angle_message
from gruebler.mechanics.fourbar.extremes import StrokeTimes
from gruebler.structure.assur.forms import form_message

_CONSTANT = 1e-9  # radians: transmission angles that vary by less are one

_DEAD_CENTRES = {
    "inner": message("Inner dead centre at {drive}: {output}."),
    "outer": message("Outer dead centre at {drive}: {output}."),
    "": message("Dead centre at {drive}: {output}."),
}
_TURNS_BACK = message("The output turns back at {drive}: {output}.")
_PAUSES = message("The output pauses at {drive}: {output}.")
_LIFTS = {
    "inner": message("Least lift at {drive}: {output}."),
    "outer": message("Greatest lift at {drive}: {output}."),
    "": _TURNS_BACK,
}
_DWELLS = {
    "inner": message("Dwell in the inner position from {begin} to {end}, {duration}: {output}."),
    "outer": message("Dwell in the outer position from {begin} to {end}, {duration}: {output}."),
    "": message("Dwell from {begin} to {end}, {duration}: {output}."),
}
_EQUAL_DWELLS = message("Dwells of {duration} each, from {begins}: at {outputs}.")


def output_lines(
    units: MeasureUnits,
    name: str,
    *,
    still: bool,
    ratio: float | None,
    turns: int,
    travel: float | None,
    shift: float = 0.0,
) -> Iterator[Message]:
    """How the output moves: its ratio if that is constant, else its turns or its travel."""
    if still and shift:
        yield message(
            "The output {name} does not turn; its points travel {shift}.", name=name, shift=units.length(shift)
        )
    elif still and units.turning_output:
        yield message("The output {name} does not turn.", name=name)
    elif still:
        yield message("The output {name} does not move.", name=name)
    elif ratio is not None:
        yield message("The transmission to {name} is uniform: i = {ratio:n}.", name=name, ratio=ratio)
    elif abs(turns) == 1:
        yield message("The output {name} makes one full turn in each period.", name=name)
    elif turns:
        yield message("The output {name} makes {turns} full turns in each period.", name=name, turns=abs(turns))
    elif travel is not None and units.turning_output:
        yield message("The output {name} swings through {travel}.", name=name, travel=units.output(travel))
    elif travel is not None:
        yield message("The output {name} has a stroke of {travel}.", name=name, travel=units.output(travel))


def lift_message(units: MeasureUnits, centre: DeadCentre, least: float) -> Message:
    """Where a follower turns back, or pauses: how far it is lifted above its least output."""
    text = _PAUSES if centre.kind == "flat" else _LIFTS[centre.side]
    return text.filled(drive=units.drive(centre.drive), output=units.output(abs(centre.output - least)))


def dead_centre_message(units: MeasureUnits, centre: DeadCentre, *, in_line: bool) -> Message:
    """Where the output turns back, or pauses; without crank and coupler in line these are no dead centres."""
    text = _PAUSES if centre.kind == "flat" else _DEAD_CENTRES[centre.side] if in_line else _TURNS_BACK
    return text.filled(drive=units.drive(centre.drive), output=units.output(centre.output))


def dwell_lines(units: MeasureUnits, dwells: Sequence[Dwell], period: float) -> Iterator[Message]:
    """Where the output rests; what is as long each time, as in a Geneva drive, is said once."""
    if len(dwells) > 1 and all(not each.side and isclose(each.duration, dwells[0].duration) for each in dwells):
        begins, outputs = [units.drive(each.begin) for each in dwells], [units.output(each.output) for each in dwells]
        yield _EQUAL_DWELLS.filled(
            duration=units.drive(dwells[0].duration), begins=joined(begins, ", "), outputs=joined(outputs, ", ")
        )
    else:
        yield from (_dwell(units, each, period) for each in dwells)


def _dwell(units: MeasureUnits, dwell: Dwell, period: float) -> Message:
    """An end beyond the period is counted from its beginning."""
    end = dwell.end - period if dwell.end > period * (1 + _CONSTANT) else dwell.end
    begin, end_text, duration = (units.drive(value) for value in (dwell.begin, end, dwell.duration))
    return _DWELLS[dwell.side].filled(begin=begin, end=end_text, duration=duration, output=units.output(dwell.output))


def way_message(units: MeasureUnits, start: float, end: float, *, in_line: bool) -> Message:
    """From where to where the output goes: between its dead centres, or what it is at both ends."""
    if in_line:
        return message("from inner to outer dead centre")
    return message("while the output goes from {start} to {end}", start=units.output(start), end=units.output(end))


def stroke_lines(
    units: MeasureUnits, outward: Message, phi_forward: float, phi_back: float, ratio: float | None, *, dwells: bool
) -> Iterator[Message]:
    """The drive angles of both strokes."""
    if dwells:
        text = message("Drive angles without dwells: {forward} {outward}, {back} back; time ratio {ratio:n}.")
    else:
        text = message("Drive angles: {forward} {outward}, {back} back; time ratio {ratio:n}.")
    yield text.filled(outward=outward, forward=units.drive(phi_forward), back=units.drive(phi_back), ratio=ratio)
    if phi_forward - phi_back > _CONSTANT:
        yield message("Turning counter-clockwise, the way back is the quick one.")
    elif phi_back - phi_forward > _CONSTANT:
        yield message("Turning counter-clockwise, the way back is the slow one.")


def time_lines(
    rpm: float | None, outward: Message | None, times: StrokeTimes | None, at_rest: float | None
) -> Iterator[Message]:
    """How long strokes and dwells take at a speed."""
    if times is not None and outward is not None:
        text = message("At {rpm:g} revolutions per minute: {forward:n} s {outward}, {back:n} s back.")
        yield text.filled(rpm=rpm, outward=outward, forward=times.forward, back=times.back)
    if at_rest is not None:
        yield message("At rest: {time:n} s in a period.", time=at_rest)


def dwell_share_message(share: float) -> Message:
    """How much of the drive's motion the output rests."""
    return message("The output rests for {share:n} % of the drive's motion.", share=100 * share)


def motion_share_message(units: MeasureUnits, moving: float, period: float, ratio: float) -> Message:
    """How far the drive moves in a period while an output that turns fully does."""
    return message(
        "It moves during {moving} of {period} of the drive; ratio of motion to dwell {motion:n} : {rest:n}.",
        moving=units.drive(moving),
        period=units.drive(period),
        motion=max(1.0, ratio),
        rest=max(1.0, 1 / ratio),
    )


def change_point_lines(units: MeasureUnits, places: Iterable[Sequence[ChangePoint]]) -> Iterator[Message]:
    """Where groups may change their assembly modes; that several curves meet is said once of a place."""
    for points in places:
        for point in points:
            yield _change_point(units, point, several=point.several and point is points[-1])


def _change_point(units: MeasureUnits, point: ChangePoint, *, several: bool) -> Message:
    line = message(
        "Change point of {form} {{{links}}} at {drive}.",
        form=form_message(point.form),
        links=", ".join(point.links),
        drive=units.drive(point.drive),
    )
    return joined([line, message("More than two curves of positions meet there.")], " ") if several else line


def unknown_change_points_message(error: GrueblerError) -> Message:
    """Why change points of larger groups are not known."""
    return message("Change points of larger groups are not known: {why}", why=error)


_TRANSMISSION = message(
    "Transmission angle {smallest} at {drive} (link {links}) to {largest}; deviation angle up to {deviation}."
)
_SMALLEST_TRANSMISSION = message(
    "Smallest transmission angle {smallest} at {drive} (link {links}, whose largest is {largest}); deviation angle up "
    "to {deviation}."
)
_CAM_TRANSMISSION = message(
    "Transmission angle {smallest} at {drive} ({links}) to {largest}; pressure angle up to {deviation}."
)
_CAM = message("{cam}: base circle of radius {base}, smallest radius of curvature {convex}.")
_HOLLOW_CAM = message(
    "{cam}: base circle of radius {base}, smallest radius of curvature {convex}, of hollows {hollow}."
)


def cam_message(units: MeasureUnits, contour: CamContour) -> Message:
    """The radii of a cam."""
    base, convex = units.length(contour.base), units.length(contour.convex)
    if contour.hollow is None:
        return _CAM.filled(cam=contour.link, base=base, convex=convex)
    return _HOLLOW_CAM.filled(cam=contour.link, base=base, convex=convex, hollow=units.length(contour.hollow))


def transmission_lines(units: MeasureUnits, transmission: TransmissionExtremes) -> Iterator[Message]:
    """The transmission angle, and whether it is good."""
    worst, best = transmission.smallest, transmission.largest
    if best.mu - worst.mu > _CONSTANT:
        text = _TRANSMISSION if len(transmission.legs) == 1 else _SMALLEST_TRANSMISSION
        text = _CAM_TRANSMISSION if worst.links in transmission.cams else text
        yield text.filled(
            smallest=angle_message(worst.mu),
            drive=units.drive(worst.drive),
            links=", ".join(worst.links),
            largest=angle_message(best.mu),
            deviation=angle_message(worst.deviation),
        )
    elif worst.links in transmission.cams:
        text = message("Transmission angle {angle} throughout, pressure angle {deviation}.")
        yield text.filled(angle=angle_message(worst.mu), deviation=angle_message(worst.deviation))
    else:
        yield message("Transmission angle {angle} throughout.", angle=angle_message(worst.mu))
    yield message("It does not fall below 40°." if transmission.good else "It falls below 40°.")
    if transmission.undefined:
        yield undefined_transmission_message(transmission.undefined)


def undefined_transmission_message(links: Sequence[str]) -> Message:
    """Between which links, on the way of the force, there is no transmission angle."""
    text = message("For {links}, between the drive and the output, no transmission angle is defined.")
    return text.filled(links=", ".join(links))
