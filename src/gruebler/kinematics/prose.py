"""What is said of a motion, in English and German."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gruebler.kinematics.motion import Motion

__all__ = ["drive_text", "stopped"]

_SAID = {
    ("limit", "en"): "The motion ends at {drives}: there {form} {{{links}}} can no longer be assembled.",
    ("limit", "de"): "Die Bewegung endet bei {drives}: dort lässt sich {form} {{{links}}} nicht mehr zusammenbauen.",
    ("singular", "en"): "The motion ends at {drives}: there two assembly modes of {form} {{{links}}} meet.",
    ("singular", "de"): "Die Bewegung endet bei {drives}: dort treffen sich zwei Einbaulagen von {form} {{{links}}}.",
    ("start", "en"): "At the start, {drives}, {form} {{{links}}} cannot be assembled in this way.",
    ("start", "de"): "Am Anfang, {drives}, lässt sich {form} {{{links}}} so nicht zusammenbauen.",
}


def stopped(motion: Motion, lang: str) -> str:
    """See `Motion.message`."""
    stop = motion.stop
    if stop is None:
        return ""
    text = _SAID[stop.reason, "de" if lang == "de" else "en"]
    return text.format(drives=drive_text(motion, stop.drives), form=stop.form, links=", ".join(stop.links))


def drive_text(motion: Motion, values: tuple[float, ...]) -> str:
    """Drive values with the names of their joints, turning ones in degrees."""
    mechanism = motion.linkage.mechanism
    out = []
    for name, drive, value in zip(mechanism.drive_names(), mechanism.drives, values, strict=True):
        turning = drive.direction.startswith("R")
        out.append(f"{name} = {degrees(value):.9g}°" if turning else f"{name} = {value:.9g} {motion.linkage.unit}")
    return ", ".join(out)
