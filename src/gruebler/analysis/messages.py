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
    "goes round": (
        "The output {name} goes round {turns} time(s) in one period.",
        "Der Abtrieb {name} läuft in einer Periode {turns}-mal um.",
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


def explain_measures(found: Measures, lang: str) -> Iterator[str]:
    """See `Measures.explain`."""
    column = 1 if lang == "de" else 0

    def say(key: str, **values: Any) -> str:
        return _TEXTS[key][column].format(**values)

    yield from _drive_lines(found, say)
    name = found.output.name
    if found.transfer.still:
        yield say("not turning" if found.output.turning else "still", name=name)
    elif found.transfer.uniform:
        yield say("uniform", name=name, ratio=found.transfer.ratio)
    elif found.output_turns:
        yield say("goes round", name=name, turns=abs(found.output_turns))
    elif found.travel is not None:
        key = "swing" if found.output.turning else "stroke"
        yield say(key, name=name, travel=_output(found, found.travel))
    yield from _stop_lines(found, say)
    for point in found.change_points:
        line = say("change", form=point.form, links=", ".join(point.links), at=_drive(found, point.drive))
        yield f"{line} {say('several')}" if point.several else line
    if found.change_points_notes[lang]:
        yield say("unknown changes", why=found.change_points_notes[lang])
    if found.transmission is None:
        note = found.transmission_notes[lang]
        yield note[:1].upper() + note[1:] + "."
        return
    worst, best = found.transmission.smallest, found.transmission.largest
    yield say(
        "mu" if best.mu - worst.mu > _CONSTANT else "constant",
        small=_angle(worst.mu),
        at=_drive(found, worst.drive),
        links=", ".join(worst.links),
        large=_angle(best.mu),
        alpha=_angle(worst.deviation),
    )
    yield say("good" if found.transmission.good else "poor")


def _stop_lines(found: Measures, say: Any) -> Iterator[str]:
    """Dead centres, dwells, and the ways between them."""
    for centre in found.dead_centres:
        key = "flat" if centre.kind == "flat" else centre.side
        yield say(key, at=_drive(found, centre.drive), output=_output(found, centre.output))
    for dwell in found.dwells:
        begin, end, duration = (_drive(found, value) for value in (dwell.begin, _end(found, dwell), dwell.duration))
        key = f"dwell {dwell.side}".strip()
        yield say(key, begin=begin, end=end, duration=duration, output=_output(found, dwell.output))
    if found.dwells:
        yield say("dwells", share=100 * found.dwell_share)
    if found.phi_forward is not None and found.phi_back is not None:
        forward, back = (_drive(found, x) for x in (found.phi_forward, found.phi_back))
        yield say("strokes moving" if found.dwells else "strokes", forward=forward, back=back, ratio=found.time_ratio)
        if abs(found.phi_forward - found.phi_back) > _CONSTANT:
            yield say("slow forward" if found.phi_forward > found.phi_back else "slow back")
    if found.times is not None:
        yield say("times", rpm=found.speed_rpm, forward=found.times.forward, back=found.times.back)
    if found.dwells and found.dwell_time is not None:
        yield say("dwell time", time=found.dwell_time)


def _drive_lines(found: Measures, say: Any) -> Iterator[str]:
    span = found.span
    if span.full:
        yield say("full") if span.turns == 1 else say("turns", turns=span.turns)
        return
    yield say(
        "turning range" if found.turning_drive else "range", low=_drive(found, span.low), high=_drive(found, span.high)
    )
    for stop, at in zip(span.stops, (span.low, span.high), strict=True):
        if stop is not None:
            key = "limit" if stop.reason == "limit" else "singular"
            yield say(key, at=_drive(found, at), form=stop.form, links=", ".join(stop.links))


def _end(found: Measures, dwell: Dwell) -> float:
    """Where a dwell ends, as it is reported: within the period if it goes over its end."""
    period = found.span.period
    return dwell.end - period if dwell.end > period * (1 + _CONSTANT) else dwell.end


def _angle(value: float) -> str:
    return f"{round(degrees(value), 7) + 0.0:.7g}°"


def _drive(found: Measures, value: float) -> str:
    return _angle(value) if found.turning_drive else f"{value:.7g} {found.linkage.unit}"


def _output(found: Measures, value: float) -> str:
    if found.output.turning:
        return _angle(value)
    return f"{0.0 if abs(value) < 1e-12 * found.linkage.size else value:.7g} {found.linkage.unit}"


def measures_as_dict(found: Measures) -> dict[str, Any]:
    """See `Measures.to_json`."""
    turn = degrees if found.turning_drive else float
    out = degrees if found.output.turning else float
    span, transfer, transmission = found.span, found.transfer, found.transmission
    rate = out(1.0) / turn(1.0)

    def angle(value: float | None) -> float | None:
        return None if value is None else degrees(value)

    def crossing(c: Any, scale: float) -> dict[str, Any]:
        return {"drive": turn(c.drive), "value": c.value * scale, "kind": c.kind}

    def extreme(e: TransmissionExtremum) -> dict[str, Any]:
        return {"drive": turn(e.drive), "mu": degrees(e.mu), "deviation": degrees(e.deviation), "links": list(e.links)}

    return {
        "output": {"name": found.output.name, "unit": "deg" if found.output.turning else found.linkage.unit},
        "drive": {
            "unit": "deg" if found.turning_drive else found.linkage.unit,
            "start": turn(found.start),
            "branch": list(found.branch),
            "full": span.full,
            "turns": span.turns,
            "range": None if span.full else [turn(span.low), turn(span.high)],
            "stops": [None if s is None else {"reason": s.reason, "links": list(s.links)} for s in span.stops],
        },
        "ends": None if found.ends is None else [out(value) for value in found.ends],
        "dead_centres": [
            {"drive": turn(c.drive), "output": out(c.output), "kind": c.kind, "flat": c.flat, "side": c.side}
            for c in found.dead_centres
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
            for d in found.dwells
        ],
        "dwell_share": found.dwell_share,
        "dwell_time": found.dwell_time,
        "output_turns": found.output_turns,
        "travel": None if found.travel is None else out(found.travel),
        "phi_forward": angle(found.phi_forward),
        "phi_back": angle(found.phi_back),
        "time_ratio": found.time_ratio,
        "speed_rpm": found.speed_rpm,
        "times": None if found.times is None else {"forward": found.times.forward, "back": found.times.back},
        "change_points": [
            {"drive": turn(c.drive), "links": list(c.links), "form": c.form, "several": c.several}
            for c in found.change_points
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
        "change_points_note": found.change_points_notes["en"],
        "transmission_note": found.transmission_note,
    }
