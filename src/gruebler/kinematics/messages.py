"""What is said of a motion."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from gruebler.assur.forms import form_message
from gruebler.chain.pairs import in_alphabets
from gruebler.text import Message, joined, message

if TYPE_CHECKING:
    from gruebler.kinematics.motion import Motion
    from gruebler.mechanism import Mechanism

__all__ = ["drive_value_text", "stop_message"]

_UNBOUNDED = message("At {drives} the drive stands at its limit: there are no finite rates.")
_STOPS = {
    "limit": message("The motion ends at {drives}: there {form} {{{links}}} can no longer be assembled."),
    "singular": message("The motion ends at {drives}: there two assembly modes of {form} {{{links}}} meet."),
    "open": message(
        "The motion ends at {drives}: there {form} is open. The sizes do not let this overconstrained linkage move on; "
        "`gruebler freedoms` says what they allow."
    ),
    "start": message("At the start, {drives}, {form} {{{links}}} cannot be assembled in this way."),
}


def stop_message(motion: Motion) -> Message:
    """See `Motion.message`."""
    parts = []
    if motion.unbounded:
        first = tuple(float(v) for v in motion.drives[motion.unbounded[0]])
        parts.append(_UNBOUNDED.filled(drives=drive_value_text(motion, first)))
    if motion.stop is not None:
        stop = motion.stop
        drives, links = drive_value_text(motion, stop.drives), ", ".join(stop.links)
        parts.append(_STOPS[stop.reason].filled(drives=drives, form=form_message(stop.form), links=links))
    return joined(parts, " ")


def drive_value_text(motion: Motion, values: tuple[float, ...]) -> Message:
    """Drive values with the names of their joints, turning ones in degrees."""
    mechanism = motion.linkage.mechanism
    parts = []
    for k, (drive, value) in enumerate(zip(mechanism.drives, values, strict=True)):
        name = _drive_name(mechanism, k)
        if drive.turning:
            parts.append(message("{name} = {value:.9g}°", name=name, value=degrees(value)))
        else:
            parts.append(message("{name} = {value:.9g} {unit}", name=name, value=value, unit=motion.linkage.unit))
    return joined(parts)


def _drive_name(mechanism: Mechanism, drive: int) -> Message:
    return in_alphabets(lambda alphabet: mechanism.drive_names(alphabet)[drive])
