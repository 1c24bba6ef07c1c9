"""The table from which a machine can be built again: where its joints and points lie in the position that is shown."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields

from gruebler.base.text import Message, message, number, number_separator, translate
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Element, Linkage
from gruebler.mechanics.linkages.elements import PRESSURE_ANGLE
from gruebler.structure.chain.pairs import Alphabet

SIZES: Mapping[str, Message] = {
    "radius": message("radius"),
    "teeth": message("teeth"),
    "belt": message("belt"),
    "pressure_angle": message("pressure angle"),
    "lift": message("lift"),
    "base": message("base circle"),
    "roller": message("roller"),
    "offset": message("offset"),
    "flat": message("flat face"),
    "scale": message("lengths times"),
    "arm": message("arm"),
    "distance": message("distance of the axes"),
    "face": message("distance of the face"),
    "closed": message("form-closed"),
    "pins": message("pins"),
    "slots": message("slots"),
    "internal": message("internal"),
    "transfer": message("turn of the other wheel"),
}
"""What an element has besides its place, as the table calls it."""
PITCH_RADIUS = message("pitch radius")
"""The radius of what rolls without slip; a smooth circle has a ``radius``."""
_PARTS = {
    "rise": message("rise {size} over {angle}°"),
    "fall": message("fall {size} over {angle}°"),
    "dwell": message("dwell"),
}
_BELTS = {"open": message("open"), "crossed": message("crossed")}


def headers(lang: str) -> tuple[str, ...]:
    """The heads of the columns."""
    return translate("joint or point", lang), "x", "y", translate("angle", lang), translate("sizes", lang)


def places(linkage: Linkage, pose: Motion, lang: str) -> Iterator[tuple[str, ...]]:
    """A row for each place in the first row of a motion; elements that differ on their links have a row each.

    Angles are in degrees: of a slide, of the direction of a cam, of a pin or slot. A negative radius is a hole or
    internal toothing.
    """
    chain = linkage.mechanism.chain
    alphabet = Alphabet.of_language(lang)
    for k, joint in enumerate(chain.joints):
        name = f"{joint.pair.symbol(alphabet)} {' / '.join(joint.links)}"
        elements = {link: linkage.elements[k, link] for link in joint.links}
        if {element.form for element in elements.values()} in ({"pin"}, {"line"}):  # one place in the plane
            elements = dict([list(elements.items())[-1]])
        for link, element in elements.items():
            at, turn = _placed(pose, link, element.x, element.y)
            angle = math.degrees(math.remainder(element.direction + turn, math.tau)) if element.angles else None
            shown = name if len(elements) == 1 else f"{name}: {link}"
            yield (
                shown,
                *written_numbers((at.real, at.imag, angle), linkage.size, lang),
                number_separator(lang).join(element_sizes(element, lang)),
            )
    for name, point in linkage.points.items():
        at, _ = _placed(pose, point.link, point.x, point.y)
        yield f"{name} ({point.link})", *written_numbers((at.real, at.imag, None), linkage.size, lang), ""


def _placed(pose: Motion, link: str, x: float, y: float) -> tuple[complex, float]:
    """Where a place of a link lies, and the angle of the link."""
    k = pose.lower_linkage.mechanism.chain.index(link)
    turn = complex(pose.turns[0, k])
    return complex(pose.places[0, 0, k]) + turn * complex(x, y), cmath.phase(turn)


def written_numbers(values: Iterable[float | None], size: float, lang: str, digits: int = 6) -> Iterator[str]:
    """Values with so many digits, those of roundings left out."""
    for value in values:
        yield "" if value is None else number(0.0 if abs(value) < 1e-9 * size else value, lang, f".{digits}g")


def element_sizes(element: Element, lang: str, *, in_words: bool = False) -> Iterator[str]:
    """What an element has besides its place: radius and teeth of a wheel, lift and base circle of a cam.

    The lift stands as it is read again, or in words.
    """
    for field in fields(element):
        value = getattr(element, field.name)
        if field.name in ("x", "y", *element.angles) or (value == field.default and field.name != "pins"):
            continue
        rolls = field.name == "radius" and not element.is_smooth
        name = (PITCH_RADIUS if rolls else SIZES[field.name]).in_language(lang)
        if value is True:
            yield name
        elif field.name == "pressure_angle":
            if value != PRESSURE_ANGLE:
                yield f"{name} {number(math.degrees(value), lang, '.6g')}°"
        elif field.name == "belt":
            yield f"{name} {_BELTS[value].in_language(lang)}"
        elif in_words and field.name == "lift":
            parts = _lift_parts(value, lang, "°" if getattr(element, "distance", 0) else "")
            yield f"{name} ({number_separator(lang).join(parts)})"
        else:
            yield f"{name} {value if isinstance(value, str) else number(value, lang, '.6g')}"


def _lift_parts(lift: str, lang: str, unit: str) -> Iterator[str]:
    """The parts of a lift in words; `gruebler.machines.cams.lift.read_lift` says how they are written."""
    for part in lift.replace("\n", ";").split(";"):
        kind, *rest = part.partition("#")[0].split() or [""]
        values = [number(float(value), lang, ".6g") for value in rest[:2]]
        if kind == "dwell":
            yield " ".join([_PARTS[kind].in_language(lang), *(f"{value}°" for value in values)])
        elif kind:
            text = _PARTS[kind].filled(size=values[0] + unit, angle=values[1]).in_language(lang)
            yield " ".join([text, *rest[2:]])
