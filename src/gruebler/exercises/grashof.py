"""Which links of a four-bar turn fully, and for which values of one length, step by step."""

from __future__ import annotations

from gruebler.analysis import drive_range
from gruebler.errors import LinkageError
from gruebler.exercises.solution import Solution, SolutionBuilder, SolutionStep, number
from gruebler.fourbar import FourBar, Grashof, LinkageType, turning_ranges
from gruebler.text import Text

__all__ = ["condition", "length_range"]

_SAYS = {
    "<": (
        "The shortest link turns fully against all others.",
        "Das kürzeste Glied ist gegenüber allen anderen umlauffähig.",
    ),
    "=": (
        "Limiting case: all four joints can lie on one line, and there the motion can branch (change point).",
        "Grenzfall: Alle vier Gelenke können auf einer Geraden liegen; dort kann das Getriebe durchschlagen.",
    ),
    ">": ("No link turns fully.", "Kein Glied ist umlauffähig."),
}


def _name(kind: LinkageType) -> Text:
    return Text(kind.name("en"), kind.name("de"))


def condition(a: float, b: float, c: float, d: float, unit: str = "mm") -> Solution:
    """Grashof's condition for four lengths: type, and whether the crank a turns fully.

    >>> condition(40, 100, 70, 90)["type"].en
    'crank-rocker'
    """
    grashof = FourBar(a, b, c, d).grashof
    if not grashof.assemblable:
        raise LinkageError("lengths {a:g}, {b:g}, {c:g}, {d:g} cannot be assembled", a=a, b=b, c=c, d=d)
    builder = SolutionBuilder(unit)
    _add_sums(builder, grashof)
    shortest = ", ".join(grashof.shortest)
    turns = "a" in grashof.turning
    builder.keep("turns", Text("the crank a turns fully", "die Kurbel a ist umlauffähig"), turns)
    builder.keep("type", Text("type", "Getriebetyp"), _name(grashof.type), symbol="")
    builder.parts.append(
        SolutionStep(
            Text(
                f"The place of the shortest link ({shortest}; d is the frame) makes it a:",
                f"Mit dem kürzesten Glied an dieser Stelle ({shortest}; d ist das Gestell) ist das Getriebe:",
            ),
            value=_name(grashof.type),
        )
    )
    if grashof.condition != "=":
        moved = drive_range(FourBar(a, b, c, d).linkage())
        builder.check(
            "The crank turns fully (1) or not (0), by following the motion",
            "Kurbel umlauffähig (1) oder nicht (0), durch Verfolgen der Bewegung",
            float(turns),
            float(moved.full),
            "",
        )
    builder.mistake(
        "turns",
        not turns,
        "Compare l_min + l_max with the two others, and see where the shortest link is.",
        "l_min + l_max mit den beiden anderen vergleichen, und auf die Stelle des kürzesten Gliedes achten.",
    )
    return builder.done()


def _add_sums(builder: SolutionBuilder, found: Grashof) -> None:
    """The sums of Grashof's condition and their relation."""
    unit = builder.unit
    low, first, second, high = sorted(found.lengths.values())
    shortest = ", ".join(found.shortest)
    builder.say(
        f"Shortest link: {shortest} with {number(low)} {unit}; longest: {found.longest} with {number(high)} {unit}.",
        f"Kürzestes Glied: {shortest} mit {number(low)} {unit}; längstes: {found.longest} mit {number(high)} {unit}.",
    )
    name = Text("sum of the shortest and the longest length", "Summe aus kürzester und längster Länge")
    ends = builder.find("sum_ends", name, "l_min + l_max", low + high, symbol="s1", l_min=low, l_max=high)
    name = Text("sum of the two others", "Summe der beiden anderen")
    others = first + second
    builder.parts.append(SolutionStep(name, "s2 = l' + l''", f"{number(second)} + {number(first)}", others, unit))
    builder.keep("sum_others", name, others, unit=unit, symbol="s2")
    relation = {"<": "l_min + l_max < l' + l''", "=": "l_min + l_max = l' + l''", ">": "l_min + l_max > l' + l''"}
    builder.parts.append(
        SolutionStep(
            Text("Grashof's condition: " + _SAYS[found.condition][0], "Satz von Grashof: " + _SAYS[found.condition][1]),
            relation[found.condition],
            f"{number(ends)} {found.condition} {number(others)}",
        )
    )
    builder.mistake("sum_ends", low + second, "The longest link was not taken.", "Nicht das längste Glied genommen.")


def length_range(
    free: str,
    a: float | None = None,
    b: float | None = None,
    c: float | None = None,
    d: float | None = None,
    unit: str = "mm",
) -> Solution:
    """The values of the length ``free`` (b, c or d) with which the four-bar is a crank-rocker with crank a.

    A second range, with the frame as the shortest link (double crank), is told if there is one.

    >>> found = length_range("d", a=40, b=100, c=70)
    >>> found["d_min"], found["d_max"]
    (70.0, 130.0)
    """
    lengths = {name: value for name, value in zip("abcd", (a, b, c, d), strict=True) if value is not None}
    if free not in ("b", "c", "d") or set(lengths) != set("abcd") - {free}:
        raise LinkageError(
            "of a, b, c, d all but the free length must be given, and that must be b, c or d: {free!r}", free=free
        )
    crank = lengths["a"]
    (one, long), (other, short) = sorted(((n, v) for n, v in lengths.items() if n != "a"), key=lambda item: -item[1])
    low, high = crank + long - short, long + short - crank
    if crank >= short:
        told = ", ".join(f"{name} = {value:g}" for name, value in lengths.items())
        raise LinkageError(
            "no value of {free} makes a crank-rocker with crank a of {told}: a is not the shortest",
            free=free,
            told=told,
        )
    builder = SolutionBuilder(unit)
    builder.say(
        "For the crank a to turn fully against the frame and drive a rocker it must be the shortest link, and with "
        "it l_min + l_max must not exceed the sum of the two others.",
        "Damit die Kurbel a umläuft und eine Schwinge antreibt, muss sie das kürzeste Glied sein, und mit ihr darf "
        "l_min + l_max die Summe der beiden anderen nicht überschreiten.",
    )
    text = Text(
        f"{free} is not the longest link, {one} is: a + {one} ≤ {other} + {free}",
        f"{free} ist nicht das längste Glied, sondern {one}: a + {one} ≤ {other} + {free}",
    )
    values = {"a": crank, one: long, other: short}
    name = Text("smallest value", "Kleinstmaß")
    builder.find(f"{free}_min", name, f"a + {one} - {other}", low, text=text, values=values)
    text = Text(
        f"{free} is the longest link: a + {free} ≤ {one} + {other}",
        f"{free} ist das längste Glied: a + {free} ≤ {one} + {other}",
    )
    name = Text("largest value", "Größtmaß")
    builder.find(f"{free}_max", name, f"{one} + {other} - a", high, text=text, values=values)
    builder.say(
        f"So {number(low)} {unit} ≤ {free} ≤ {number(high)} {unit}. At both ends the sums are equal: the linkage is "
        "then at a change point, safely rotatable it is only in between.",
        f"Also {number(low)} {unit} ≤ {free} ≤ {number(high)} {unit}. An beiden Grenzen sind die Summen gleich: Dort "
        "ist das Getriebe durchschlagend, sicher umlauffähig ist es nur dazwischen.",
    )
    _add_shortest(builder, free, crank, long, short, (one, other))
    _check_range(builder, free, lengths, low, high)
    _add_range_mistakes(builder, free, crank, long, short)
    return builder.done()


def _add_shortest(
    builder: SolutionBuilder, free: str, crank: float, long: float, short: float, names: tuple[str, str]
) -> None:
    """The range with the free length as the shortest link: the crank turns there only if that is the frame."""
    upper = crank + short - long
    name = Text(f"{free} as the shortest link, up to", f"{free} als kürzestes Glied, bis")
    symbol = f"{free}'"
    if free != "d" or upper <= 0:
        builder.keep("shortest_upper", name, upper, unit=builder.unit, symbol=symbol)
        return
    one, other = names
    text = Text(
        f"Beside that, a turns fully with a frame that is the shortest link (double crank): d + {one} ≤ a + {other}, "
        "so 0 < d ≤ d'",
        f"Außerdem läuft a um, wenn das Gestell selbst das kürzeste Glied ist (Doppelkurbel): d + {one} ≤ a + {other}, "
        "also 0 < d ≤ d'",
    )
    values = {"a": crank, one: long, other: short}
    builder.find("shortest_upper", name, f"a + {other} - {one}", upper, symbol=symbol, text=text, values=values)


def _check_range(builder: SolutionBuilder, free: str, lengths: dict[str, float], low: float, high: float) -> None:
    (found,) = (part for part in turning_ranges("a", **lengths) if part.type.key == "crank_rocker")
    builder.check("Lower end, by going through all types", "Untere Grenze, aus der Folge aller Typen", low, found.lower)
    builder.check("Upper end, by going through all types", "Obere Grenze, aus der Folge aller Typen", high, found.upper)
    near = 1e-3 * (high - low)
    tried = [(low + near, True), (low - near, False), (high - near, True), (high + near, False)]
    upper = builder.number("shortest_upper")
    cranks = [part.upper for part in turning_ranges("a", **lengths) if part.type.key == "double_crank"]
    if free == "d" and upper > 0:
        en, de = "Double crank up to, by going through all types", "Doppelkurbel bis, aus der Folge aller Typen"
        builder.check(en, de, upper, max(cranks, default=0.0))
        close = 1e-3 * min(upper, low - upper)
        tried += [(upper - close, True), (upper + close, False)]
    for value, full in tried:
        moved = drive_range(FourBar(**lengths, **{free: value}).linkage()).full
        builder.check(
            f"{free} = {number(value)}: the crank turns fully (1) or not (0), by following the motion",
            f"{free} = {number(value)}: Kurbel umlauffähig (1) oder nicht (0), durch Verfolgen der Bewegung",
            float(full),
            float(moved),
            "",
        )


def _add_range_mistakes(builder: SolutionBuilder, free: str, crank: float, long: float, short: float) -> None:
    wrong = (
        "Both cases are needed: once the free link is the longest, once it is not.",
        "Beide Fälle sind nötig: einmal ist das gesuchte Glied das längste, einmal nicht.",
    )
    builder.mistake(
        f"{free}_min",
        long - short,
        "The crank a was forgotten in the sum l_min + l_max.",
        "In l_min + l_max wurde die Kurbel a vergessen.",
    )
    builder.mistake(
        f"{free}_max",
        long + short,
        "That only closes the chain; for a full turn the crank a is taken off.",
        "So schließt sich nur die Kette; für den vollen Umlauf wird die Kurbel a abgezogen.",
    )
    builder.mistake(
        f"{free}_max",
        long + short + crank,
        "l_max stands on the side of l_min: a is taken off.",
        "l_max steht auf der Seite von l_min: a wird abgezogen.",
    )
    builder.mistake(f"{free}_max", long, *wrong)
    builder.mistake(
        f"{free}_min",
        crank,
        "To be longer than the crank is not enough: the sums decide.",
        "Länger als die Kurbel zu sein reicht nicht: Die Summen entscheiden.",
    )
