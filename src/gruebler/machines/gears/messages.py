"""Texts about a gear train."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction

from gruebler.base.text import joined, message, number, plural, translate
from gruebler.machines.gears.assemblies import Assembly, assembly, axes, even_numbers
from gruebler.machines.gears.motion import speeds
from gruebler.machines.gears.train import FRAME, Train, comparable

_LARGEST_BITS = 13_500  # below the 4,300 digits that Python turns into text


def fraction_text(value: Fraction | float, lang: str = "en") -> str:
    """A number as text: whole, or a fraction with its decimal value.

    >>> fraction_text(Fraction(7, 2)), fraction_text(Fraction(6)), fraction_text(0.25)
    ('7/2 (3.5)', '6', '0.25')
    """
    if isinstance(value, float):
        return number(value, lang)
    if not writable(value):
        return number(decimal(value), lang, "")
    return str(value) if value.denominator == 1 else f"{value} ({number(decimal(value), lang, '')})"


def writable(value: Fraction) -> bool:
    """Whether its digits can be written out: the ratio of many stages can have tens of thousands of digits.

    >>> writable(Fraction(1, 10**4000)), writable(Fraction(1, 10**5000))
    (True, False)
    """
    return max(abs(value.numerator), value.denominator).bit_length() <= _LARGEST_BITS


def decimal(value: Fraction) -> str:
    """Six digits of a number, however large or small.

    >>> decimal(Fraction(7, 2)), decimal(Fraction(10**5000, 3))
    ('3.5', '3.33333e+4999')
    """
    try:
        if value == 0 or float(value) != 0:
            return f"{float(value):.6g}"
    except OverflowError:
        pass
    digits = f"{Decimal(value.numerator) / Decimal(value.denominator):.6g}"
    return str(Decimal(digits).normalize()).lower()


def explain_train(train: Train, drives: Mapping[str, Fraction], planets: Mapping[str, int], lang: str = "en") -> str:
    """A description of a train with its drives and the numbers of its planets, line by line."""
    links, redundant = len(train.links), train.redundant
    independent = len(train.meshes) - len(redundant)
    lines = [
        translate(
            "{links}, {meshes}: mobility {mobility}.",
            lang,
            links=plural("{count} moving link", "{count} moving links", links, lang),
            meshes=plural("{count} independent mesh", "{count} independent meshes", independent, lang),
            mobility=links - independent,
        )
    ]
    if redundant:
        lines.append(translate("Redundant meshes: {meshes}.", lang, meshes="; ".join(map(str, redundant))))
    lines += [
        translate("Speeds: {relation} = 0", lang, relation=relation) for relation in _outer_relations(train, lang)
    ]
    if drives:
        lines += _drive_lines(train, drives, links - independent, lang)
    for planet, count in planets.items():
        lines.append(_planets_line(assembly(train, planet, count), lang))
    for planet_axes in axes(train):
        planet, wheels = planet_axes.planet, planet_axes.meshes
        if not planet_axes.coaxial:
            sums = (f"|{mesh.size_b} {'-' if mesh.size_a < 0 else '+'} {abs(mesh.size_a)}|" for mesh in wheels)
            shown = (f"{total} = {value}" for total, value in zip(sums, planet_axes.distances, strict=True))
            lines.append(
                translate(
                    "{links} do not have one axis: with {planet} the tooth numbers give different distances of the "
                    "axes, {sums} half modules (one module, no profile shift).",
                    lang,
                    links=", ".join(mesh.b for mesh in wheels),
                    planet=planet,
                    sums="; ".join(shown),
                )
            )
        elif planet not in planets and (possible_numbers := even_numbers(train, planet)):
            numbers = ", ".join(map(str, possible_numbers))
            text = message("Equal planets ({planet}) that fit at equal angles: {numbers}.")
            lines.append(text.filled(planet=planet, numbers=numbers).in_language(lang))
    return "\n".join(lines)


def _drive_lines(train: Train, drives: Mapping[str, Fraction], mobility: int, lang: str) -> list[str]:
    """The contradicted and redundant drives, and the undetermined links."""
    state, lines = speeds(train, drives), []
    for link, requested, follows in state.contradictions:
        lines.append(
            translate(
                "{link} cannot have {wanted}: it follows from the other drives as {follows}.",
                lang,
                link=link,
                wanted=fraction_text(requested, lang),
                follows=fraction_text(follows, lang),
            )
        )
    if state.spare:
        lines.append(translate("Drives more than needed: {links}.", lang, links=", ".join(state.spare)))
    if state.free:
        missing = mobility - (len(drives) - len(state.spare) - len(state.contradictions))
        lines.append(
            plural(
                "Not determined: {links}; {count} more drive needed.",
                "Not determined: {links}; {count} more drives needed.",
                missing,
                lang,
                links=", ".join(state.free),
            )
        )
    return lines


def _planets_line(placed: Assembly, lang: str) -> str:
    """Whether this number of equal planets can be assembled, with the reasons if not."""
    reasons = []
    if not placed.coaxial:
        reasons.append(message("the central wheels are not coaxial (wheels of one module without profile shift)"))
    if not placed.evenly:
        degrees = float(placed.spacing * 360)
        reasons.append(message("places are {degrees:.6g}° or multiples of it apart", degrees=degrees))
    if not placed.clear:
        reasons.append(message("neighbours touch"))
    if not reasons:
        return translate(
            "{count} planets ({planet}) at equal angles can be put in.", lang, count=placed.number, planet=placed.planet
        )
    return translate(
        "{count} planets ({planet}) at equal angles cannot be put in: {reasons}.",
        lang,
        count=placed.number,
        planet=placed.planet,
        reasons=joined(reasons, "; "),
    )


def _outer_relations(train: Train, lang: str) -> list[str]:
    """The relations between the links that are not planets, where their speeds can be compared."""
    ends = Counter(link for mesh in train.meshes if mesh.carrier != FRAME for link in (mesh.a, mesh.b))
    outer = [link for link in train.links if ends[link] < 2]
    forms, units = train.relations(*outer), train.units()
    return [_sum(form, lang) for form in forms if comparable(units[link] for link in form)]


def _sum(form: dict[str, int], lang: str) -> str:
    """Links stand for their speeds; one whose name is a number as w_1."""
    terms = "".join(
        f" {'-' if k < 0 else '+'} {'' if abs(k) == 1 else fraction_text(Fraction(abs(k)), lang) + ' '}"
        f"{'w_' if link[0].isdigit() else ''}{link}"
        for link, k in form.items()
    )
    return terms.removeprefix(" + ")
