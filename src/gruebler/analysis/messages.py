"""Measures in words, in English and German, and as plain data."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gruebler.analysis.events import Dwell
    from gruebler.analysis.measures import Measures
    from gruebler.analysis.transmission import TransmissionExtremum

__all__ = ["explain_measures", "measures_as_dict"]

_CONSTANT = 1e-9  # radians: transmission angles that vary by less are one

_TEXTS = {
    "full": ("The drive turns fully.", "Der Antrieb läuft voll um."),
    "turns": (
        "The drive turns fully; everything repeats after {turns} turns.",
        "Der Antrieb läuft voll um; alles wiederholt sich nach {turns} Umdrehungen.",
    ),
    "range": ("The drive moves from {low} to {high}.", "Der Antrieb bewegt sich von {low} bis {high}."),
    "turning range": ("The drive turns from {low} to {high}.", "Der Antrieb dreht von {low} bis {high}."),
    "limit": (
        "At {at} the group {form} {{{links}}} can no longer be assembled.",
        "Bei {at} lässt sich die Gruppe {form} {{{links}}} nicht mehr zusammenbauen.",
    ),
    "singular": (
        "At {at} two assembly modes of the group {form} {{{links}}} meet.",
        "Bei {at} treffen sich zwei Einbaulagen der Gruppe {form} {{{links}}}.",
    ),
    "still": ("The output {name} does not move.", "Der Abtrieb {name} steht still."),
    "not turning": ("The output {name} does not turn.", "Der Abtrieb {name} dreht sich nicht."),
    "uniform": (
        "The transmission to {name} is uniform: i = {ratio:.9g}.",
        "Die Übersetzung auf {name} ist gleichförmig: i = {ratio:.9g}.",
    ),
    "goes round once": (
        "The output {name} makes one full turn in each period.",
        "Der Abtrieb {name} läuft in jeder Periode einmal um.",
    ),
    "goes round": (
        "The output {name} makes {turns} full turns in each period.",
        "Der Abtrieb {name} läuft in jeder Periode {turns}-mal um.",
    ),
    "swing": ("The output {name} swings through {travel}.", "Der Abtrieb {name} schwingt um {travel}."),
    "stroke": ("The output {name} has a stroke of {travel}.", "Der Abtrieb {name} hat einen Hub von {travel}."),
    "inner": ("Inner dead centre at {at}: {output}.", "Innere Totlage bei {at}: {output}."),
    "outer": ("Outer dead centre at {at}: {output}.", "Äußere Totlage bei {at}: {output}."),
    "": ("Dead centre at {at}: {output}.", "Totlage bei {at}: {output}."),
    "flat": ("The output pauses at {at}: {output}.", "Der Abtrieb rastet kurz bei {at}: {output}."),
    "dwell inner": (
        "Dwell in the inner position from {begin} to {end}, {duration}: {output}.",
        "Rast in der inneren Lage von {begin} bis {end}, {duration}: {output}.",
    ),
    "dwell outer": (
        "Dwell in the outer position from {begin} to {end}, {duration}: {output}.",
        "Rast in der äußeren Lage von {begin} bis {end}, {duration}: {output}.",
    ),
    "dwell": (
        "Dwell from {begin} to {end}, {duration}: {output}.",
        "Rast von {begin} bis {end}, {duration}: {output}.",
    ),
    "dwells": (
        "The output rests for {share:.9g} % of the drive's motion.",
        "Der Abtrieb rastet während {share:.9g} % der Antriebsbewegung.",
    ),
    "moving": (
        "It moves during {moving} of {whole} of the drive; motion by dwell {ratio:.9g}.",
        "Er bewegt sich während {moving} von {whole} des Antriebs; Bewegung durch Rast {ratio:.9g}.",
    ),
    "strokes": (
        "Drive angles: {forward} from inner to outer, {back} back; time ratio {ratio:.9g}.",
        "Antriebswinkel: {forward} von innen nach außen, {back} zurück; Zeitverhältnis {ratio:.9g}.",
    ),
    "strokes moving": (
        "Drive angles without dwells: {forward} from inner to outer, {back} back; time ratio {ratio:.9g}.",
        "Antriebswinkel ohne Rasten: {forward} von innen nach außen, {back} zurück; Zeitverhältnis {ratio:.9g}.",
    ),
    "slow forward": (
        "In the positive sense the way outward is the slow one.",
        "Im positiven Drehsinn ist der Weg nach außen der langsame.",
    ),
    "slow back": (
        "In the positive sense the way inward is the slow one.",
        "Im positiven Drehsinn ist der Weg nach innen der langsame.",
    ),
    "times": (
        "At {rpm:g} turns a minute: {forward:.6g} s from inner to outer, {back:.6g} s back.",
        "Bei {rpm:g} Umdrehungen je Minute: {forward:.6g} s von innen nach außen, {back:.6g} s zurück.",
    ),
    "dwell time": ("At rest: {time:.6g} s in a period.", "In Rast: {time:.6g} s je Periode."),
    "several": ("More than two curves of positions meet there.", "Dort treffen sich mehr als zwei Lagenkurven."),
    "change": (
        "Change point of {form} {{{links}}} at {at}.",
        "Verzweigungslage (durchschlagend) von {form} {{{links}}} bei {at}.",
    ),
    "unknown changes": (
        "Change points of larger groups are not known: {why}",
        "Verzweigungslagen größerer Gruppen sind nicht bekannt: {why}",
    ),
    "mu": (
        "Transmission angle {small} at {at} (leg {links}) to {large}; deviation angle up to {alpha}.",
        "Übertragungswinkel {small} bei {at} (Glied {links}) bis {large}; Ablenkwinkel bis {alpha}.",
    ),
    "constant": ("Transmission angle {small} throughout.", "Übertragungswinkel durchweg {small}."),
    "good": ("It does not fall below 40°.", "Er unterschreitet 40° nicht."),
    "poor": ("It falls below 40°.", "Er unterschreitet 40°."),
}


def explain_measures(measures: Measures, lang: str) -> Iterator[str]:
    """See `Measures.explain`."""
    column = 1 if lang == "de" else 0

    def say(key: str, **values: Any) -> str:
        return _TEXTS[key][column].format(**values)

    yield from _drive_lines(measures, say)
    name = measures.output.name
    if measures.transfer.still:
        yield say("not turning" if measures.output.turning else "still", name=name)
    elif measures.transfer.uniform:
        yield say("uniform", name=name, ratio=measures.transfer.ratio)
    elif measures.output_turns:
        turns = abs(measures.output_turns)
        yield say("goes round once", name=name) if turns == 1 else say("goes round", name=name, turns=turns)
    elif measures.travel is not None:
        key = "swing" if measures.output.turning else "stroke"
        yield say(key, name=name, travel=_output(measures, measures.travel))
    yield from _stop_lines(measures, say)
    points = measures.change_points
    for k, point in enumerate(points):
        line = say("change", form=point.form, links=", ".join(point.links), at=_drive(measures, point.drive))
        following = (
            points[k + 1] if k + 1 < len(points) else None
        )  # of several groups at one place the last one says it
        again = following is not None and following.several and abs(following.drive - point.drive) <= _CONSTANT
        yield f"{line} {say('several')}" if point.several and not again else line
    if measures.change_points_notes[lang]:
        yield say("unknown changes", why=measures.change_points_notes[lang])
    if measures.transmission is None:
        note = measures.transmission_notes[lang]
        yield note[:1].upper() + note[1:] + "."
        return
    worst, best = measures.transmission.smallest, measures.transmission.largest
    yield say(
        "mu" if best.mu - worst.mu > _CONSTANT else "constant",
        small=_angle(worst.mu),
        at=_drive(measures, worst.drive),
        links=", ".join(worst.links),
        large=_angle(best.mu),
        alpha=_angle(worst.deviation),
    )
    yield say("good" if measures.transmission.good else "poor")


def _stop_lines(measures: Measures, say: Any) -> Iterator[str]:
    """Dead centres, dwells, and the ways between them."""
    for centre in measures.dead_centres:
        key = "flat" if centre.kind == "flat" else centre.side
        yield say(key, at=_drive(measures, centre.drive), output=_output(measures, centre.output))
    for dwell in measures.dwells:
        begin, end, duration = (
            _drive(measures, value) for value in (dwell.begin, _end(measures, dwell), dwell.duration)
        )
        key = f"dwell {dwell.side}".strip()
        yield say(key, begin=begin, end=end, duration=duration, output=_output(measures, dwell.output))
    if measures.dwells:
        yield say("dwells", share=100 * measures.dwell_share)
        if measures.output_turns:
            moving, whole = _drive(measures, measures.moving_span), _drive(measures, measures.span.period)
            yield say("moving", moving=moving, whole=whole, ratio=measures.motion_ratio)
    if measures.phi_forward is not None and measures.phi_back is not None:
        forward, back = (_drive(measures, x) for x in (measures.phi_forward, measures.phi_back))
        yield say(
            "strokes moving" if measures.dwells else "strokes", forward=forward, back=back, ratio=measures.time_ratio
        )
        if abs(measures.phi_forward - measures.phi_back) > _CONSTANT:
            yield say("slow forward" if measures.phi_forward > measures.phi_back else "slow back")
    if measures.times is not None:
        yield say("times", rpm=measures.speed_rpm, forward=measures.times.forward, back=measures.times.back)
    if measures.dwells and measures.dwell_time is not None:
        yield say("dwell time", time=measures.dwell_time)


def _drive_lines(measures: Measures, say: Any) -> Iterator[str]:
    span = measures.span
    if span.full:
        yield say("full") if span.turns == 1 else say("turns", turns=span.turns)
        return
    yield say(
        "turning range" if measures.turning_drive else "range",
        low=_drive(measures, span.low),
        high=_drive(measures, span.high),
    )
    for stop, at in zip(span.stops, (span.low, span.high), strict=True):
        if stop is not None:
            key = "limit" if stop.reason == "limit" else "singular"
            yield say(key, at=_drive(measures, at), form=stop.form, links=", ".join(stop.links))


def _end(measures: Measures, dwell: Dwell) -> float:
    """Where a dwell ends, as it is reported: within the period if it goes over its end."""
    period = measures.span.period
    return dwell.end - period if dwell.end > period * (1 + _CONSTANT) else dwell.end


def _angle(value: float) -> str:
    return f"{round(degrees(value), 7) + 0.0:.7g}°"


def _drive(measures: Measures, value: float) -> str:
    return _angle(value) if measures.turning_drive else f"{value:.7g} {measures.linkage.unit}"


def _output(measures: Measures, value: float) -> str:
    if measures.output.turning:
        return _angle(value)
    return f"{0.0 if abs(value) < 1e-12 * measures.linkage.size else value:.7g} {measures.linkage.unit}"


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
        "moving_span": turn(measures.moving_span),
        "motion_ratio": measures.motion_ratio,
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
        "change_points_note": measures.change_points_notes["en"],
        "transmission_note": measures.transmission_note,
    }
