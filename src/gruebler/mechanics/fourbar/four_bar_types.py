"""Grashof's condition: which links of a four-bar turn fully, and for which values of one length."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field

from gruebler.base.errors import LinkageError
from gruebler.base.notebook import explained
from gruebler.base.text import Message, message, number, translate
from gruebler.mechanics.linkages.quantities import as_lengths, given_and_missing

_LINKS = {"a": message("crank"), "b": message("coupler"), "c": message("output")}
_CLOSE = 1e-12


@dataclass(frozen=True, slots=True)
class LinkageType:
    """What a linkage is called for the way it moves."""

    key: str
    title: Message = field(compare=False)

    def name(self, lang: str = "en") -> str:
        """The name in English (``en``) or German (``de``)."""
        return self.title.in_language(lang)

    def __str__(self) -> str:
        return self.name()


SINGLE_POSITION = LinkageType("single_position", message("stretched: one single position"))
NOT_ASSEMBLABLE = LinkageType("not_assemblable", message("not assemblable"))

# By the relation of l_min + l_max to the sum of the other two, and by the links that are the shortest.
FOUR_BAR_TYPES = {
    ("<", "a"): LinkageType("crank_rocker", message("crank-rocker")),
    ("<", "b"): LinkageType("grashof_double_rocker", message("Grashof double rocker (the coupler turns fully)")),
    ("<", "c"): LinkageType("rocker_crank", message("crank-rocker driven at the rocker")),
    ("<", "d"): LinkageType("double_crank", message("double crank")),
    ("=", "a"): LinkageType("change_point_crank_rocker", message("change-point crank-rocker")),
    ("=", "b"): LinkageType("change_point_double_rocker", message("change-point double rocker")),
    ("=", "c"): LinkageType("change_point_rocker_crank", message("change-point crank-rocker driven at the rocker")),
    ("=", "d"): LinkageType("change_point_double_crank", message("change-point double crank")),
    ("=", "ac"): LinkageType("parallelogram", message("parallelogram or antiparallelogram, short cranks")),
    ("=", "bd"): LinkageType("parallelogram_short_frame", message("parallelogram or antiparallelogram, short frame")),
    ("=", "ab"): LinkageType("kite_crank_rocker", message("isosceles crank-rocker (kite)")),
    ("=", "bc"): LinkageType("kite_rocker_crank", message("isosceles crank-rocker (kite) driven at the rocker")),
    ("=", "ad"): LinkageType("kite_double_crank", message("isosceles double crank (kite)")),
    ("=", "cd"): LinkageType(
        "kite_double_crank_reversed", message("isosceles double crank (kite) driven at the long crank")
    ),
    ("=", "abcd"): LinkageType("rhombus", message("rhombus (four equal links)")),
    (">", ""): LinkageType("triple_rocker", message("triple rocker (no link turns fully)")),
    ("rigid", ""): SINGLE_POSITION,
    ("open", ""): NOT_ASSEMBLABLE,
}


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class Grashof:
    """What the lengths of a four-bar say about the way it moves."""

    lengths: dict[str, float]
    type: LinkageType
    shortest: tuple[str, ...]
    """The shortest link; more than one if they are equal."""
    longest: str
    excess: float
    """l_min + l_max less the sum of the other two: negative if Grashof's condition holds strictly."""
    turning: tuple[str, ...]
    """The links (a, b, c) that turn fully against the frame; at a change point: that can, past it."""

    @property
    def condition(self) -> str:
        """The relation of l_min + l_max to the sum of the other two: ``<``, ``=`` or ``>``."""
        if abs(self.excess) <= _CLOSE * self.lengths[self.longest]:
            return "="
        return "<" if self.excess < 0 else ">"

    @property
    def holds(self) -> bool:
        """Whether the shortest link turns fully against all others."""
        return self.condition != ">"

    @property
    def change_point(self) -> bool:
        """Whether there is a position with all joints on one line, where the motion may branch."""
        return self.condition == "="

    @property
    def assemblable(self) -> bool:
        """Whether there is any position at all."""
        return self.type.key != "not_assemblable"

    def name(self, lang: str = "en") -> str:
        """The name of the type in English (``en``) or German (``de``)."""
        return self.type.name(lang)

    def explain(self, lang: str = "en") -> str:
        """The condition with its figures, the type and the links that turn, in English (``en``) or German (``de``).

        >>> grashof(40, 100, 70, 90).explain()
        'l_min + l_max = 40 + 100 = 140 < 160 = 90 + 70: crank-rocker. Turns fully against the frame: a (crank).'
        """
        lengths = sorted(self.lengths.values())
        low, first, second, high = (number(length, lang, "g") for length in lengths)
        outer, inner, others = (number(sum(some), lang, "g") for some in (lengths[::3], lengths[1:3], lengths[:3]))
        line = f"l_min + l_max = {low} + {high} = {outer} {self.condition} {inner} = {second} + {first}"
        if self.type.key in {"not_assemblable", "single_position"}:
            sign = "=" if self.type.key == "single_position" else ">"
            line = f"l_max = {high} {sign} {others} = {low} + {first} + {second}"
        line += f": {self.name(lang)}."
        if not self.turning:
            return line
        links = ", ".join(f"{link} ({_LINKS[link].in_language(lang)})" for link in self.turning)
        return f"{line} {translate('Turns fully against the frame: {links}.', lang, links=links)}"


def grashof(a: float, b: float, c: float, d: float) -> Grashof:
    """The type of the four-bar with crank a, coupler b, rocker c and frame d.

    Sums that differ by less than 1e-12 of the longest link count as equal (a change point). Lengths that close
    in no position are a result, not an error; anything but four positive numbers raises LinkageError.

    >>> grashof(2, 5, 4, 5).name("de")
    'Kurbelschwinge'
    >>> grashof(3, 5, 3, 5).turning
    ('a', 'c')
    """
    lengths = as_lengths(a=a, b=b, c=c, d=d)
    ranked = sorted(lengths, key=lengths.__getitem__)
    low, first, second, high = (lengths[link] for link in ranked)
    close = _CLOSE * high
    excess = (low - first) + (high - second)
    ties = 1
    if abs(excess) <= close and first - low <= close:
        ties = 4 if second - low <= close else 2
    shortest = tuple(sorted(ranked[:ties]))
    beyond = high - low - first - second
    if beyond > close:
        place = ("open", "")
    elif beyond >= -close:
        place = ("rigid", "")
    elif abs(excess) <= close:
        place = ("=", "".join(shortest))
    else:
        place = (">", "") if excess > 0 else ("<", ranked[0])
    turning = tuple(link for link in "abc" if _turns(lengths, link, close))
    return Grashof(
        lengths=lengths,
        type=FOUR_BAR_TYPES[place],
        shortest=shortest,
        longest=ranked[-1],
        excess=excess,
        turning=turning,
    )


def _turns(lengths: dict[str, float], link: str, close: float) -> bool:
    """Whether a link takes every direction against the frame (docs/theory/four-bar.md, theorem 1)."""
    short, second = sorted((lengths[link], lengths["d"]))
    first, two = (length for name, length in lengths.items() if name not in {link, "d"})
    return (short - first) + (second - two) <= close and (short - second) + abs(first - two) <= close


@dataclass(frozen=True, slots=True, kw_only=True)
class LengthRange:
    """The values of one length, from lower to upper, for which a four-bar is of one type.

    A lower end of 0 is not reached; an upper end may be infinite. At any other end the four-bar is at a change point
    or stretched, or two links are equally short.
    """

    lower: float
    upper: float
    grashof: Grashof
    """The four-bar in the middle of the range."""
    below: LinkageType | None
    """What lies beyond the lower end; None if that is 0."""
    above: LinkageType | None
    """What lies beyond the upper end; None if that is infinite."""

    @property
    def type(self) -> LinkageType:
        """The type within the range."""
        return self.grashof.type


def types_along(
    *, a: float | None = None, b: float | None = None, c: float | None = None, d: float | None = None
) -> tuple[LengthRange, ...]:
    """The types that a four-bar runs through as the one length that is left out grows from 0.

    A value that is of another type than both sides (a parallelogram among triple rockers) is a range of its own.

    >>> for range in types_along(a=25, b=40, c=70):
    ...     print(range.lower, range.upper, range.type)
    0.0 5.0 not assemblable
    5.0 55.0 triple rocker (no link turns fully)
    55.0 85.0 crank-rocker
    85.0 135.0 triple rocker (no link turns fully)
    135.0 inf not assemblable
    """
    given, free = given_and_missing(a=a, b=b, c=c, d=d)
    close = _CLOSE * max(given.values())
    signs = itertools.product((1, -1), repeat=3)
    sums = [sum(s * x for s, x in zip(row, given.values(), strict=True)) for row in signs]
    ends = [0.0]
    for value in sorted([*sums, *given.values()]):
        if value > ends[-1] + close:
            ends.append(value)
    ranges: list[tuple[float, float, Grashof]] = []
    for lower, upper in itertools.pairwise([*ends, math.inf]):
        middle = grashof(**given, **{free: (lower + upper) / 2 if upper < math.inf else 2 * lower})
        before = ranges[-1][2] if ranges else None
        at = grashof(**given, **{free: lower}) if lower else None
        if at and before and at.turning and not set(at.turning) <= {*before.turning, *middle.turning}:
            ranges.append((lower, lower, at))
            before = None
        if before and before.type == middle.type:
            ranges[-1] = (ranges[-1][0], upper, before)
        else:
            ranges.append((lower, upper, middle))
    types = [None, *(part[2].type for part in ranges), None]
    return tuple(
        LengthRange(lower=lower, upper=upper, grashof=middle, below=types[k], above=types[k + 2])
        for k, (lower, upper, middle) in enumerate(ranges)
    )


def turning_ranges(
    turns: str, *, a: float | None = None, b: float | None = None, c: float | None = None, d: float | None = None
) -> tuple[LengthRange, ...]:
    """The values of the one length that is left out for which the link ``turns`` goes round fully.

    Against the frame, that is; empty if there are none. The ends belong to the range: there the four-bar is at a
    change point, or the link shares the place of the shortest.

    >>> [(r.lower, r.upper, str(r.type)) for r in turning_ranges("a", a=40, b=100, c=70)]
    [(0.0, 10.0, 'double crank'), (70.0, 130.0, 'crank-rocker')]
    """
    if turns not in ("a", "b", "c"):
        raise LinkageError("the link that is to turn against the frame must be a, b or c, not {turns!r}", turns=turns)
    return tuple(part for part in types_along(a=a, b=b, c=c, d=d) if turns in part.grashof.turning)
