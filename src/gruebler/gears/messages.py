"""A gear train in words, English and German."""

from __future__ import annotations

from collections import Counter
from decimal import Decimal
from fractions import Fraction

from gruebler.gears.assembly import Assembly, assembly, axes, even_numbers
from gruebler.gears.motion import speeds
from gruebler.gears.reading import TrainReading
from gruebler.gears.train import FRAME, Train, comparable

__all__ = ["decimal", "explain_train", "fraction_text", "writable"]

_LARGEST_BITS = 13_500  # below the 4,300 digits that Python turns into text

# sentence: (English, German)
SENTENCES = {
    "mobility": (
        "{links} moving links, {meshes} independent meshes: mobility {freedoms}.",
        "{links} bewegte Glieder, {meshes} unabhängige Eingriffe: Laufgrad {freedoms}.",
    ),
    "redundant": (
        "Says nothing new: {meshes}.",
        "Sagt nichts Neues: {meshes}.",
    ),
    "relation": ("Speeds: {relation} = 0", "Drehzahlen: {relation} = 0"),
    "contradiction": (
        "{link} cannot have {wanted}: it follows from the other drives as {follows}.",
        "{link} kann nicht {wanted} haben: Aus den anderen Antrieben folgt {follows}.",
    ),
    "spare": ("Drives more than needed: {links}.", "Überzählige Antriebe: {links}."),
    "free": (
        "Not determined: {links}; {missing} more drive(s) needed.",
        "Nicht bestimmt: {links}; {missing} Antrieb(e) fehlen.",
    ),
    "possible": (
        "{number} planets ({planet}) at equal angles can be put in.",
        "{number} Planeten ({planet}) lassen sich gleichmäßig verteilt einbauen.",
    ),
    "impossible": (
        "{number} planets ({planet}) at equal angles cannot be put in: {reasons}.",
        "{number} Planeten ({planet}) lassen sich nicht gleichmäßig verteilt einbauen: {reasons}.",
    ),
    "axes": (
        "{links} do not have one axis: with {planet} the tooth numbers give different distances of the axes, {sums} "
        "half modules (one module, no profile shift).",
        "{links} haben keine gemeinsame Achse: Mit {planet} ergeben die Zähnezahlen verschiedene Achsabstände, {sums} "
        "halbe Moduln (gleicher Modul, keine Profilverschiebung).",
    ),
    "numbers": (
        "Equal planets ({planet}) that fit at equal angles: {numbers}.",
        "Gleiche Planeten ({planet}), die sich gleichmäßig verteilt einbauen lassen: {numbers}.",
    ),
    "coaxial": (
        "the central wheels are not coaxial (wheels of one module without profile shift)",
        "die Zentralräder sind nicht gleichachsig (gleicher Modul, keine Profilverschiebung)",
    ),
    "evenly": (
        "places are {degrees}° or multiples of it apart",
        "die Plätze liegen um {degrees}° oder Vielfache davon auseinander",
    ),
    "clear": ("neighbours touch", "Nachbarn berühren sich"),
}


def fraction_text(value: Fraction | float) -> str:
    """A number for people: whole, or a fraction with its decimal value.

    >>> fraction_text(Fraction(7, 2)), fraction_text(Fraction(6)), fraction_text(0.25)
    ('7/2 (3.5)', '6', '0.25')
    """
    if isinstance(value, float):
        return f"{value:.6g}"
    if not writable(value):
        return decimal(value)
    return str(value) if value.denominator == 1 else f"{value} ({decimal(value)})"


def writable(value: Fraction) -> bool:
    """Whether its digits can be written out: a long row of stages has ratios of tens of thousands of digits.

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


def explain_train(reading: TrainReading, lang: str = "en") -> str:
    """What can be said of a train and its drives, line by line.

    >>> from gruebler.gears import read_train
    >>> print(explain_train(read_train("sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=7")))
    4 moving links, 2 independent meshes: mobility 2.
    Speeds: 2 sun - 7 arm + 5 ring = 0
    3 planets (planet) at equal angles can be put in.
    """
    train, column = reading.train, int(lang == "de")

    def say(key: str, **words: object) -> str:
        return SENTENCES[key][column].format(**words)

    links, redundant = len(train.links), train.redundant
    independent = len(train.meshes) - len(redundant)
    lines = [say("mobility", links=links, meshes=independent, freedoms=links - independent)]
    if redundant:
        lines.append(say("redundant", meshes="; ".join(map(str, redundant))))
    lines += [say("relation", relation=relation) for relation in _outer_relations(train)]
    if reading.drives:
        found = speeds(train, reading.drives)
        for link, wanted, follows in found.contradictions:
            lines.append(say("contradiction", link=link, wanted=fraction_text(wanted), follows=fraction_text(follows)))
        if found.spare:
            lines.append(say("spare", links=", ".join(found.spare)))
        if found.free:
            used = len(reading.drives) - len(found.spare) - len(found.contradictions)
            lines.append(say("free", links=", ".join(found.free), missing=links - independent - used))
    for planet, count in reading.planets.items():
        one = assembly(train, planet, count)
        reasons = _reasons(one, column)
        key = "impossible" if reasons else "possible"
        lines.append(say(key, number=count, planet=planet, reasons="; ".join(reasons)))
    for found_axes in axes(train):
        wheels = found_axes.meshes
        if not found_axes.coaxial:
            sums = (f"|{mesh.size_b} {'-' if mesh.size_a < 0 else '+'} {abs(mesh.size_a)}|" for mesh in wheels)
            shown = (f"{total} = {value}" for total, value in zip(sums, found_axes.distances, strict=True))
            lines.append(
                say("axes", links=", ".join(m.b for m in wheels), planet=found_axes.planet, sums="; ".join(shown))
            )
        elif found_axes.planet not in reading.planets and (fits := even_numbers(train, found_axes.planet)):
            lines.append(say("numbers", planet=found_axes.planet, numbers=", ".join(map(str, fits))))
    return "\n".join(lines)


def _reasons(one: Assembly, column: int) -> list[str]:
    degrees = f"{float(one.spacing * 360):.6g}"
    wrong = [key for key in ("coaxial", "evenly", "clear") if not getattr(one, key)]
    return [SENTENCES[key][column].format(degrees=degrees) for key in wrong]


def _outer_relations(train: Train) -> list[str]:
    """The relations between the links that are not planets, where their speeds can be compared."""
    ends = Counter(link for mesh in train.meshes if mesh.carrier != FRAME for link in (mesh.a, mesh.b))
    outer = [link for link in train.links if ends[link] < 2]
    forms, units = train.relations(*outer), train.units()
    return [_sum(form) for form in forms if comparable(units[link] for link in form)]


def _sum(form: dict[str, int]) -> str:
    terms = "".join(
        f" {'-' if k < 0 else '+'} {'' if abs(k) == 1 else fraction_text(Fraction(abs(k))) + ' '}{link}"
        for link, k in form.items()
    )
    return terms.removeprefix(" + ")
