"""Which links of a four-bar turn fully, and for which values of one length, step by step."""

from __future__ import annotations

from collections.abc import Iterable

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, in_every_language, joined, joined_by_and, message
from gruebler.mechanics.analysis import drive_range
from gruebler.mechanics.fourbar import FourBar, Grashof, turning_ranges
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, SolutionStep, figure, formula_number

_SAYS = {
    "<": message("The shortest link turns fully against all others."),
    "=": message("Limiting case: all four joints can lie on one line, and there the motion can branch (change point)."),
    ">": message("No link turns fully."),
}


def condition(a: float, b: float, c: float, d: float, unit: str = "mm") -> Solution:
    """Grashof's condition for four lengths: type, and whether the crank a turns fully.

    >>> condition(40, 100, 70, 90)["type"].in_language("de")
    'Kurbelschwinge'
    """
    grashof = FourBar(a, b, c, d).grashof
    if not grashof.assemblable:
        raise LinkageError("lengths {a:g}, {b:g}, {c:g}, {d:g} cannot be assembled", a=a, b=b, c=c, d=d)
    builder = SolutionBuilder(unit=unit)
    _add_sums(builder, grashof)
    shortest = ", ".join(grashof.shortest)
    turns = "a" in grashof.turning
    builder.keep("turns", message("the crank a turns fully"), turns)
    kind = in_every_language(grashof.type.name)
    builder.keep("type", message("type"), kind, symbol="")
    builder.parts.append(
        SolutionStep(
            text=message(
                "The place of the shortest link ({shortest}; d is the frame) tells the type:", shortest=shortest
            ),
            value=kind,
        )
    )
    if grashof.condition != "=":
        moved = drive_range(FourBar(a, b, c, d).linkage())
        builder.check(turning_sentence(turns), True, bool(moved.full) == turns, "")
    builder.mistake(
        "turns", not turns, message("Compare l_min + l_max with the two others, and see where the shortest link is.")
    )
    relation = grashof.condition
    for (sign, _), other in FOUR_BAR_TYPES.items():
        builder.mistake("type", in_every_language(other.name), _WRONG_PLACE if sign == relation else _WRONG_SUMS)
    return builder.done()


def turning_sentence(turns: bool) -> Message:
    """What following the motion of a four-bar shows of its crank."""
    if turns:
        return message("By following the motion: the crank turns fully.")
    return message("By following the motion: the crank does not turn fully.")


_WRONG_SUMS = message("s1 < s2: the shortest link turns fully; s1 > s2: none does; s1 = s2: all can lie on one line.")
_NOT_ENOUGH = message("Being shorter than the crank is not enough: the sums decide.")
_WRONG_PLACE = message("The sums allow that; but which link is the shortest, and where is it?")


def _add_sums(builder: SolutionBuilder, grashof: Grashof) -> None:
    """The sums of Grashof's condition and their relation."""
    unit = builder.unit
    low, first, second, high = sorted(grashof.lengths.values())
    shortest = ", ".join(grashof.shortest)
    builder.say(
        "Shortest link: {shortest} with {low} {unit}; longest: {longest} with {high} {unit}.",
        shortest=shortest,
        low=figure(low),
        unit=unit,
        longest=grashof.longest,
        high=figure(high),
    )
    name = message("sum of the shortest and the longest length")
    ends = builder.find("sum_ends", name, "l_min + l_max", low + high, symbol="s1", l_min=low, l_max=high)
    name = message("sum of the two others")
    others = first + second
    builder.parts.append(
        SolutionStep(
            text=name,
            formula="s2 = l' + l''",
            numbers=f"{formula_number(second)} + {formula_number(first)}",
            value=others,
            unit=unit,
        )
    )
    builder.keep("sum_others", name, others, unit=unit, symbol="s2")
    text = message("Grashof's condition: {meaning}", meaning=_SAYS[grashof.condition])
    builder.parts.append(comparison_step(text, grashof.condition, ends, others))
    builder.mistake("sum_ends", low + second, message("This is not the sum with the longest link."))


def comparison_step(text: Message, sign: str, ends: float, others: float, unit: str = "") -> SolutionStep:
    """How both sums of Grashof's condition compare, with their numbers.

    >>> step = comparison_step(message("No link turns fully."), ">", 130.0, 115.0, "°")
    >>> step.formula, step.numbers
    ("l_min + l_max > l' + l''", '130° > 115°')
    """
    first, second = (f"{formula_number(value)}{unit}" for value in (ends, others))
    numbers = first if sign == "=" else f"{first} {sign} {second}"
    return SolutionStep(text=text, formula=f"l_min + l_max {sign} l' + l''", numbers=numbers)


def length_range(
    free: str,
    a: float | None = None,
    b: float | None = None,
    c: float | None = None,
    d: float | None = None,
    unit: str = "mm",
) -> Solution:
    """The values of the length ``free`` (b, c or d) with which the four-bar is a crank-rocker with crank a.

    A second range, with the frame as the shortest link (double crank), is added if there is one.

    >>> solution = length_range("d", a=40, b=100, c=70)
    >>> solution["d_min"], solution["d_max"]
    (70.0, 130.0)
    """
    lengths = {name: value for name, value in zip("abcd", (a, b, c, d), strict=True) if value is not None}
    if free not in ("b", "c", "d") or set(lengths) != set("abcd") - {free}:
        raise LinkageError(
            "of a, b, c, d all but the free length must be given, and that must be b, c or d: {free!r}", free=free
        )
    crank = lengths["a"]
    (longer, long), (shorter, short) = sorted(
        ((n, v) for n, v in lengths.items() if n != "a"), key=lambda item: -item[1]
    )
    low, high = crank + long - short, long + short - crank
    if crank >= short:
        given_lengths = joined(
            message("{name} = {length:g}", name=name, length=value) for name, value in lengths.items()
        )
        raise LinkageError(
            "no value of {free} makes a crank-rocker with crank a of {lengths}: a is not the shortest",
            free=free,
            lengths=given_lengths,
        )
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "For the crank a to turn fully against the frame and drive a rocker it must be the shortest link, "
        "and with it l_min + l_max must not exceed the sum of the two others."
    )
    text = message(
        "{free} is not the longest link, {longest} is: a + {longest} ≤ {other} + {free}",
        free=free,
        longest=longer,
        other=shorter,
    )
    values = {"a": crank, longer: long, shorter: short}
    name = message("smallest value")
    builder.find(f"{free}_min", name, f"a + {longer} - {shorter}", low, text=text, values=values)
    text = message(
        "{free} is the longest link: a + {free} ≤ {longest} + {other}", free=free, longest=longer, other=shorter
    )
    name = message("largest value")
    builder.find(f"{free}_max", name, f"{longer} + {shorter} - a", high, text=text, values=values)
    builder.say(
        "So {low} {unit} ≤ {free} ≤ {high} {unit}. At both ends the sums are equal: there the linkage is at a "
        "change point; the crank turns fully without doubt only in between.",
        low=figure(low),
        unit=unit,
        free=free,
        high=figure(high),
    )
    _add_shortest(builder, free, crank, long, short, (longer, shorter))
    _check_range(builder, free, lengths, low, high)
    _add_range_mistakes(builder, free, crank, long, short)
    return builder.done()


def _add_shortest(
    builder: SolutionBuilder, free: str, crank: float, long: float, short: float, names: tuple[str, str]
) -> None:
    """The range with the free length as the shortest link: the crank turns fully there only if that is the frame."""
    upper = crank + short - long
    name = message("shortest link {free}, up to", free=free)
    symbol = f"{free}'"
    if free != "d" or upper <= 0:
        builder.keep("shortest_upper", name, upper, unit=builder.unit, symbol=symbol)
        return
    longer, shorter = names
    text = message(
        "Beside that, a turns fully with a frame that is the shortest link (double crank): d + {longest} ≤ a + "
        "{other}, so 0 < d ≤ d'",
        longest=longer,
        other=shorter,
    )
    values = {"a": crank, longer: long, shorter: short}
    builder.find("shortest_upper", name, f"a + {shorter} - {longer}", upper, symbol=symbol, text=text, values=values)
    builder.mistake("shortest_upper", crank, _NOT_ENOUGH)
    builder.mistake(
        "shortest_upper",
        crank + long - short,
        message("That is where a crank-rocker begins; as the shortest link d stands beside the longest in the sum."),
    )


def _check_range(builder: SolutionBuilder, free: str, lengths: dict[str, float], low: float, high: float) -> None:
    (crank_rocker,) = (part for part in turning_ranges("a", **lengths) if part.type.key == "crank_rocker")
    builder.check("Lower end, by going through all types", low, crank_rocker.lower)
    builder.check("Upper end, by going through all types", high, crank_rocker.upper)
    near = 1e-3 * (high - low)
    inside, outside = [low + near, high - near], [low - near, high + near]
    upper = builder.number("shortest_upper")
    cranks = [part.upper for part in turning_ranges("a", **lengths) if part.type.key == "double_crank"]
    if free == "d" and upper > 0:
        double = message("Double crank up to, by going through all types")
        builder.check(double, upper, max(cranks, default=0.0))
        close = 1e-3 * min(upper, low - upper)
        inside, outside = [*inside, upper - close], [*outside, upper + close]

    def lengths_in_words(values: Iterable[float]) -> Message:
        return joined_by_and([message("{value} {unit}", value=figure(v), unit=builder.unit) for v in sorted(values)])

    def turns(value: float) -> bool:
        return bool(drive_range(FourBar(**lengths, **{free: value}).linkage()).full)

    builder.check(
        "By following the motion: the crank turns fully with {free} = {inside}, but not with {outside}.",
        True,
        all(map(turns, inside)) and not any(map(turns, outside)),
        "",
        free=free,
        inside=lengths_in_words(inside),
        outside=lengths_in_words(outside),
    )


def _add_range_mistakes(builder: SolutionBuilder, free: str, crank: float, long: float, short: float) -> None:
    wrong = message("Both cases are needed: once the free link is the longest, once it is not.")
    builder.mistake(f"{free}_min", long - short, message("The crank a was forgotten in the sum l_min + l_max."))
    builder.mistake(
        f"{free}_max", long + short, message("That only closes the chain; for a full turn the crank a is subtracted.")
    )
    builder.mistake(f"{free}_max", long + short + crank, message("l_max stands on the side of l_min: a is subtracted."))
    builder.mistake(f"{free}_max", long, wrong)
    builder.mistake(f"{free}_min", crank, message("To be longer than the crank is not enough: the sums decide."))
