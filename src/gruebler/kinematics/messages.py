"""What is said of a motion, in English and German."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gruebler.kinematics.motion import Motion

__all__ = ["drive_value_text", "stop_message"]

_SAID = {
    ("unbounded", "en"): "At {drives} the drive stands at its limit: there are no finite rates.",
    (
        "unbounded",
        "de",
    ): "Bei {drives} steht der Antrieb in seiner Grenzlage: endliche Geschwindigkeiten gibt es dort nicht.",
    ("limit", "en"): "The motion ends at {drives}: there {form} {{{links}}} can no longer be assembled.",
    ("limit", "de"): "Die Bewegung endet bei {drives}: dort lässt sich {form} {{{links}}} nicht mehr zusammenbauen.",
    ("singular", "en"): "The motion ends at {drives}: there two assembly modes of {form} {{{links}}} meet.",
    ("singular", "de"): "Die Bewegung endet bei {drives}: dort treffen sich zwei Einbaulagen von {form} {{{links}}}.",
    ("open", "en"): (
        "The motion ends at {drives}: there {form} is open. The sizes do not let this overconstrained linkage move on; "
        "`gruebler freedoms` says what they allow."
    ),
    ("open", "de"): (
        "Die Bewegung endet bei {drives}: dort klafft {form}. Die Abmessungen lassen das übergeschlossene Getriebe "
        "nicht weiter laufen; `gruebler freedoms` sagt, was sie zulassen."
    ),
    ("start", "en"): "At the start, {drives}, {form} {{{links}}} cannot be assembled in this way.",
    ("start", "de"): "Am Anfang, {drives}, lässt sich {form} {{{links}}} so nicht zusammenbauen.",
}


def stop_message(motion: Motion, lang: str) -> str:
    """See `Motion.message`."""
    stop, said = motion.stop, "de" if lang == "de" else "en"
    out = []
    if motion.unbounded:
        first = tuple(float(v) for v in motion.drives[motion.unbounded[0]])
        out.append(_SAID["unbounded", said].format(drives=drive_value_text(motion, first)))
    if stop is not None:
        links = ", ".join(stop.links)
        out.append(
            _SAID[stop.reason, said].format(drives=drive_value_text(motion, stop.drives), form=stop.form, links=links)
        )
    return " ".join(out)


def drive_value_text(motion: Motion, values: tuple[float, ...]) -> str:
    """Drive values with the names of their joints, turning ones in degrees."""
    mechanism = motion.linkage.mechanism
    out = []
    for name, drive, value in zip(mechanism.drive_names(), mechanism.drives, values, strict=True):
        turning = drive.direction.startswith("R")
        out.append(f"{name} = {degrees(value):.9g}°" if turning else f"{name} = {value:.9g} {motion.linkage.unit}")
    return ", ".join(out)
