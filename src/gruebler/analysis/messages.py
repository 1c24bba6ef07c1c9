"""What is said of measures, and measures as plain data."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING, Any

from gruebler.assur.forms import form_message
from gruebler.text import Message, joined, message

if TYPE_CHECKING:
    from gruebler.analysis.events import Dwell
    from gruebler.analysis.measures import Measures
    from gruebler.analysis.transmission import TransmissionExtremum

__all__ = ["explain_measures", "measures_as_dict"]

_CONSTANT = 1e-9  # radians: transmission angles that vary by less are one

_DEAD_CENTRES = {
    "inner": message("Inner dead centre at {drive}: {output}."),
    "outer": message("Outer dead centre at {drive}: {output}."),
    "": message("Dead centre at {drive}: {output}."),
    "flat": message("The output pauses at {drive}: {output}."),
}
_DWELLS = {
    "inner": message("Dwell in the inner position from {begin} to {end}, {duration}: {output}."),
    "outer": message("Dwell in the outer position from {begin} to {end}, {duration}: {output}."),
    "": message("Dwell from {begin} to {end}, {duration}: {output}."),
}


def explain_measures(measures: Measures) -> Iterator[Message]:
    """The lines of `Measures.explain`; their first letter may be a small one."""
    yield from _drive_lines(measures)
    name = measures.output.name
    if measures.transfer.still:
        if measures.output.turning:
            yield message("The output {name} does not turn.", name=name)
        else:
            yield message("The output {name} does not move.", name=name)
    elif measures.transfer.uniform:
        yield message(
            "The transmission to {name} is uniform: i = {ratio:.9g}.", name=name, ratio=measures.transfer.ratio
        )
    elif abs(measures.output_turns) == 1:
        yield message("The output {name} makes one full turn in each period.", name=name)
    elif measures.output_turns:
        turns = abs(measures.output_turns)
        yield message("The output {name} makes {turns} full turns in each period.", name=name, turns=turns)
    elif measures.travel is not None:
        travel = _output(measures, measures.travel)
        if measures.output.turning:
            yield message("The output {name} swings through {travel}.", name=name, travel=travel)
        else:
            yield message("The output {name} has a stroke of {travel}.", name=name, travel=travel)
    yield from _stop_lines(measures)
    for point in measures.change_points:
        form, links, drive = form_message(point.form), ", ".join(point.links), _drive(measures, point.drive)
        line = message("Change point of {form} {{{links}}} at {drive}.", form=form, links=links, drive=drive)
        yield joined([line, message("More than two curves of positions meet there.")], " ") if point.several else line
    if measures.change_points_error is not None:
        yield message("Change points of larger groups are not known: {why}", why=measures.change_points_error)
    yield from _transmission_lines(measures)


def _transmission_lines(measures: Measures) -> Iterator[Message]:
    if measures.transmission is None:
        yield message("{why}.", why=measures.transmission_error)
        return
    worst, best = measures.transmission.smallest, measures.transmission.largest
    if best.mu - worst.mu > _CONSTANT:
        yield message(
            "Transmission angle {smallest} at {drive} (leg {links}) to {largest}; deviation angle up to {deviation}.",
            smallest=_angle(worst.mu),
            drive=_drive(measures, worst.drive),
            links=", ".join(worst.links),
            largest=_angle(best.mu),
            deviation=_angle(worst.deviation),
        )
    else:
        yield message("Transmission angle {angle} throughout.", angle=_angle(worst.mu))
    if measures.transmission.good:
        yield message("It does not fall below 40°.")
    else:
        yield message("It falls below 40°.")


def _stop_lines(measures: Measures) -> Iterator[Message]:
    """Dead centres, dwells, and the strokes between them."""
    for centre in measures.dead_centres:
        text = _DEAD_CENTRES["flat" if centre.kind == "flat" else centre.side]
        yield text.filled(drive=_drive(measures, centre.drive), output=_output(measures, centre.output))
    for dwell in measures.dwells:
        begin, end, duration = (
            _drive(measures, value) for value in (dwell.begin, _end(measures, dwell), dwell.duration)
        )
        output = _output(measures, dwell.output)
        yield _DWELLS[dwell.side].filled(begin=begin, end=end, duration=duration, output=output)
    if measures.dwells:
        yield message("The output rests for {share:.9g} % of the drive's motion.", share=100 * measures.dwell_share)
    if measures.phi_forward is not None and measures.phi_back is not None:
        yield from _stroke_lines(measures, measures.phi_forward, measures.phi_back)
    if measures.times is not None:
        yield message(
            "At {rpm:g} turns a minute: {forward:.6g} s from inner to outer, {back:.6g} s back.",
            rpm=measures.speed_rpm,
            forward=measures.times.forward,
            back=measures.times.back,
        )
    if measures.dwells and measures.dwell_time is not None:
        yield message("At rest: {time:.6g} s in a period.", time=measures.dwell_time)


def _stroke_lines(measures: Measures, phi_forward: float, phi_back: float) -> Iterator[Message]:
    if measures.dwells:
        text = message(
            "Drive angles without dwells: {forward} from inner to outer, {back} back; time ratio {ratio:.9g}."
        )
    else:
        text = message("Drive angles: {forward} from inner to outer, {back} back; time ratio {ratio:.9g}.")
    forward, back = _drive(measures, phi_forward), _drive(measures, phi_back)
    yield text.filled(forward=forward, back=back, ratio=measures.time_ratio)
    if phi_forward - phi_back > _CONSTANT:
        yield message("In the positive sense the way outward is the slow one.")
    elif phi_back - phi_forward > _CONSTANT:
        yield message("In the positive sense the way inward is the slow one.")


def _drive_lines(measures: Measures) -> Iterator[Message]:
    span = measures.span
    if span.full:
        if span.turns == 1:
            yield message("The drive turns fully.")
        else:
            yield message("The drive turns fully; everything repeats after {turns} turns.", turns=span.turns)
        return
    low, high = _drive(measures, span.low), _drive(measures, span.high)
    if measures.turning_drive:
        yield message("The drive turns from {low} to {high}.", low=low, high=high)
    else:
        yield message("The drive moves from {low} to {high}.", low=low, high=high)
    for stop, drive in zip(span.stops, (low, high), strict=True):
        if stop is None:
            continue
        if stop.reason == "limit":
            text = message("At {drive} the group {form} {{{links}}} can no longer be assembled.")
        else:
            text = message("At {drive} two assembly modes of the group {form} {{{links}}} meet.")
        yield text.filled(drive=drive, form=form_message(stop.form), links=", ".join(stop.links))


def _end(measures: Measures, dwell: Dwell) -> float:
    """Where a dwell ends, as it is reported: within the period if it goes over its end."""
    period = measures.span.period
    return dwell.end - period if dwell.end > period * (1 + _CONSTANT) else dwell.end


def _angle(value: float) -> Message:
    return message("{degrees:.7g}°", degrees=round(degrees(value), 7) + 0.0)


def _length(measures: Measures, value: float) -> Message:
    return message("{length:.7g} {unit}", length=value, unit=measures.linkage.unit)


def _drive(measures: Measures, value: float) -> Message:
    return _angle(value) if measures.turning_drive else _length(measures, value)


def _output(measures: Measures, value: float) -> Message:
    if measures.output.turning:
        return _angle(value)
    return _length(measures, 0.0 if abs(value) < 1e-12 * measures.linkage.size else value)


def measures_as_dict(measures: Measures) -> dict[str, Any]:
    """See `Measures.to_json`."""
    turn = degrees if measures.turning_drive else float
    out = degrees if measures.output.turning else float
    span, transfer, transmission = measures.span, measures.transfer, measures.transmission
    rate = out(1.0) / turn(1.0)

    def angle(value: float | None) -> float | None:
        return None if value is None else degrees(value)

    def crossing(c: Any, scale: float) -> dict[str, Any]:
        return {"drive": turn(c.drive), "value": c.value * scale, "kind": c.kind}

    def extreme(e: TransmissionExtremum) -> dict[str, Any]:
        return {"drive": turn(e.drive), "mu": degrees(e.mu), "deviation": degrees(e.deviation), "links": list(e.links)}

    return {
        "output": {"name": measures.output.name, "unit": "deg" if measures.output.turning else measures.linkage.unit},
        "drive": {
            "unit": "deg" if measures.turning_drive else measures.linkage.unit,
            "start": turn(measures.start),
            "branch": list(measures.branch),
            "full": span.full,
            "turns": span.turns,
            "range": None if span.full else [turn(span.low), turn(span.high)],
            "stops": [None if s is None else {"reason": s.reason, "links": list(s.links)} for s in span.stops],
        },
        "ends": None if measures.ends is None else [out(value) for value in measures.ends],
        "dead_centres": [
            {"drive": turn(c.drive), "output": out(c.output), "kind": c.kind, "flat": c.flat, "side": c.side}
            for c in measures.dead_centres
        ],
        "dwells": [
            {
                "begin": turn(d.begin),
                "end": turn(d.end),
                "duration": turn(d.duration),
                "output": out(d.output),
                "kind": d.kind,
                "side": d.side,
            }
            for d in measures.dwells
        ],
        "dwell_share": measures.dwell_share,
        "dwell_time": measures.dwell_time,
        "output_turns": measures.output_turns,
        "travel": None if measures.travel is None else out(measures.travel),
        "phi_forward": angle(measures.phi_forward),
        "phi_back": angle(measures.phi_back),
        "time_ratio": measures.time_ratio,
        "speed_rpm": measures.speed_rpm,
        "times": None if measures.times is None else {"forward": measures.times.forward, "back": measures.times.back},
        "change_points": [
            {"drive": turn(c.drive), "links": list(c.links), "form": c.form, "several": c.several}
            for c in measures.change_points
        ],
        "transfer": {
            "still": transfer.still,
            "uniform": transfer.uniform,
            "ratio": None if transfer.ratio is None else transfer.ratio / rate,
            "smallest": transfer.smallest * rate,
            "largest": transfer.largest * rate,
            "zeros": [crossing(c, rate) for c in transfer.zeros],
            "velocity": [crossing(c, rate) for c in transfer.velocity],
            "acceleration": [crossing(c, rate / turn(1.0)) for c in transfer.acceleration],
        },
        "transmission": None
        if transmission is None
        else {
            "smallest": extreme(transmission.smallest),
            "largest": extreme(transmission.largest),
            "good": transmission.good,
            "extremes": [extreme(e) for e in transmission.extremes],
        },
        "change_points_note": str(measures.change_points_error or ""),
        "transmission_note": measures.transmission_note,
    }
