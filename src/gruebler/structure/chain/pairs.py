"""The table of joint kinds: the relative motions that each allows two links, and how it is written.

A pair is described by its *freedoms*: motion directions in the joint's own axes. ``Rz`` is a turn about
the z axis, ``Tx`` a shift along x, ``Hz`` a screw about z (one freedom that turns and shifts at once).
A space has ``b`` motion directions; a pair with ``f`` freedoms takes away ``u = b - f`` of them.

Symbols belong to an alphabet because the same letter means different pairs: ``S`` is the German
*Schubgelenk* (prismatic) and the international spherical pair. A text is therefore read as a whole, in one
alphabet (`read_symbols`); the full name of a pair, English or German, is valid everywhere.

Source: table 2.2 of the teaching documents 000 and 003, reconstructed against ISO 3952; the planar pairs from
their sections 2.5 and 2.6.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from gruebler.base.errors import PairError, nearest
from gruebler.base.text import Message, joined, joined_by_or, message


class Space(StrEnum):
    """The space in which the links move: a plane, a sphere about a fixed point, or three-dimensional space."""

    PLANAR = "planar"
    SPHERICAL = "spherical"
    SPATIAL = "spatial"

    @property
    def b(self) -> int:
        """The number of motion directions of a free link: 3, 3 or 6."""
        return len(self.directions)

    @property
    def directions(self) -> tuple[str, ...]:
        """The motion directions of a free link, in the order used for twists everywhere."""
        return _DIRECTIONS[self]

    @property
    def adjective(self) -> Message:
        """The adjective for a chain in this space, for messages."""
        return _ADJECTIVES[self]

    @property
    def greatest_freedom(self) -> int:
        """The most freedoms that still make a joint: b - 1."""
        return self.b - 1


_DIRECTIONS = {
    Space.PLANAR: ("Rz", "Tx", "Ty"),
    Space.SPHERICAL: ("Rx", "Ry", "Rz"),
    Space.SPATIAL: ("Rx", "Ry", "Rz", "Tx", "Ty", "Tz"),
}


_ADJECTIVES = {
    Space.PLANAR: message("planar"),
    Space.SPHERICAL: message("spherical"),
    Space.SPATIAL: message("spatial"),
}


class Alphabet(StrEnum):
    """A set of symbols used together in one text."""

    GERMAN = "german"
    INTERNATIONAL = "international"

    @classmethod
    def of_language(cls, lang: str) -> Alphabet:
        """The symbols that a reader of this language expects.

        >>> Alphabet.of_language("de"), Alphabet.of_language("en")
        (<Alphabet.GERMAN: 'german'>, <Alphabet.INTERNATIONAL: 'international'>)
        """
        return cls.GERMAN if lang == "de" else cls.INTERNATIONAL


class Contact(StrEnum):
    """How the two elements touch: in a surface (lower), in a line or point (higher), or through a body between."""

    LOWER = "lower"
    HIGHER = "higher"
    COMPOUND = "compound"


class Closure(StrEnum):
    """The means that holds the two elements together: their form, a force, or the material itself (a flexure)."""

    FORM = "form"
    FORCE = "force"
    MATERIAL = "material"


@dataclass(frozen=True)
class PairTitle(Message):
    """The full name of a pair, in the reader's language."""

    def in_language(self, lang: str) -> str:
        """The name in a language."""
        return pair(self.text).full_name(lang)


@dataclass(frozen=True)
class SymbolText(Message):
    """A text with joint symbols, in the alphabet that the reader expects; constructed by `in_alphabets`."""

    def in_language(self, lang: str) -> str:
        """The text in the alphabet of a language."""
        return str(self.values[Alphabet.of_language(lang)])


def in_alphabets(write: Callable[[Alphabet], str]) -> SymbolText:
    """The text that a function writes in each alphabet, as one message.

    >>> in_alphabets(pair("prismatic").symbol).in_language("de")
    'S'
    """
    return SymbolText("", {alphabet: write(alphabet) for alphabet in Alphabet})


@dataclass(frozen=True, slots=True)
class Pair:
    """One row of the table. Compared and hashed by its name."""

    name: str
    """The English name, also usable in texts: ``revolute``."""
    german: str
    symbols: Mapping[Alphabet, str]
    """The symbol in each alphabet that has one."""
    freedoms: Mapping[Space, tuple[str, ...]]
    """The motion directions, for each space in which the pair exists."""
    contact: Contact
    closures: tuple[Closure, ...]
    """The closures used in practice, the usual one first."""
    is_group: bool
    """Whether relative motions compose to motions of the same kind, so that more than two links can share it."""

    @property
    def is_revolute(self) -> bool:
        """Whether it is the turning pair."""
        return self.name == "revolute"

    @property
    def is_prismatic(self) -> bool:
        """Whether it is the sliding pair."""
        return self.name == "prismatic"

    @property
    def is_basic(self) -> bool:
        """Whether it turns or slides: the pairs of the linkages that are solved; others are replaced by these."""
        return self.is_revolute or self.is_prismatic

    @property
    def is_rolling(self) -> bool:
        """Whether it rolls without slip."""
        return self.name == "rolling"

    @property
    def is_roll_slide(self) -> bool:
        """Whether it rolls and slides, as a pin in a slot does."""
        return self.name == "roll_slide"

    @property
    def is_double_slide(self) -> bool:
        """Whether it slides along two lines of a plane."""
        return self.name == "double_slide"

    @property
    def is_helical(self) -> bool:
        """Whether it is a screw."""
        return self.name == "helical"

    @property
    def is_spherical(self) -> bool:
        """Whether it is a ball in a socket."""
        return self.name == "spherical"

    @property
    def is_higher(self) -> bool:
        """Whether its elements touch in a line or a point; in the plane what rolls, or rolls and slides."""
        return self.contact is Contact.HIGHER

    @property
    def keeps_directions(self) -> bool:
        """Whether its links do not turn against each other, so that it can carry a moment about every axis.

        >>> [p.name for p in PAIRS if p.keeps_directions]
        ['prismatic', 'double_slide']
        """
        return all(direction.startswith("T") for freedoms in self.freedoms.values() for direction in freedoms)

    @property
    def slides_along_one_line(self) -> bool:
        """Whether it slides along one line, and along none across it.

        >>> [p.name for p in PAIRS if p.slides_along_one_line and Space.PLANAR in p.freedoms]
        ['prismatic', 'roll_slide']
        """
        return {d for freedoms in self.freedoms.values() for d in freedoms if not d.startswith("R")} == {"Tx"}

    @property
    def title(self) -> PairTitle:
        """Its full name, for messages."""
        return PairTitle(self.name)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pair) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return pair, (self.name,)

    def __repr__(self) -> str:
        return f"<pair {self.name}>"

    def f(self, space: Space) -> int:
        """Freedoms in this space; `PairError` where the pair does not exist."""
        try:
            return len(self.freedoms[space])
        except KeyError:
            raise PairError(
                "the {name} pair ({german}) does not exist in {space} chains; it exists in {others}",
                name=self.name,
                german=self.german,
                space=space.adjective,
                others=joined(
                    (
                        message("{space} ones with f = {f}", space=s.adjective, f=len(d))
                        for s, d in self.freedoms.items()
                    ),
                    ", ",
                ),
            ) from None

    def u(self, space: Space) -> int:
        """Motions taken away in this space, u = b - f."""
        return space.b - self.f(space)

    def full_name(self, lang: str = "en") -> str:
        """The name in a language, as a text may write it.

        >>> pair("revolute").full_name("de")
        'Drehgelenk'
        """
        return self.german if lang == "de" else self.name

    def symbol(self, alphabet: Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The symbol in this alphabet, or the full name where the alphabet has none."""
        return self.symbols.get(alphabet, self.name if alphabet is Alphabet.INTERNATIONAL else self.german)


def _row(
    name: str,
    german: str,
    symbols: tuple[str, str],
    freedoms: dict[Space, str],
    contact: Contact,
    closures: tuple[Closure, ...],
    is_group: bool = False,
) -> Pair:
    letters = {a: s for a, s in zip((Alphabet.GERMAN, Alphabet.INTERNATIONAL), symbols, strict=True) if s}
    return Pair(
        name,
        german,
        MappingProxyType(letters),
        MappingProxyType({space: tuple(d.split()) for space, d in freedoms.items()}),
        contact,
        closures,
        is_group,
    )


_PLANE, _SPHERE, _SPACE = Space.PLANAR, Space.SPHERICAL, Space.SPATIAL
_LOWER, _HIGHER = Contact.LOWER, Contact.HIGHER
_FORM, _FORCE, _MATERIAL = Closure.FORM, Closure.FORCE, Closure.MATERIAL

# name, German name, (German symbol, international symbol), freedoms by space, contact, closures, group?
PAIRS: tuple[Pair, ...] = (
    _row(
        "revolute",
        "Drehgelenk",
        ("D", "R"),
        {_PLANE: "Rz", _SPHERE: "Rz", _SPACE: "Rz"},
        _LOWER,
        (_FORM, _MATERIAL),
        is_group=True,
    ),
    _row(
        "prismatic",
        "Schubgelenk",
        ("S", "P"),
        {_PLANE: "Tx", _SPACE: "Tx"},
        _LOWER,
        (_FORM, _FORCE, _MATERIAL),
        is_group=True,
    ),
    _row("helical", "Schraubgelenk", ("W", "H"), {_SPACE: "Hz"}, _LOWER, (_FORM,), is_group=True),
    _row("rolling", "Wälzgelenk", ("W", "W"), {_PLANE: "Rz", _SPHERE: "Rz"}, _HIGHER, (_FORCE,)),
    _row("cylindrical", "Drehschubgelenk", ("DS", "C"), {_SPACE: "Rz Tz"}, _LOWER, (_FORM,), is_group=True),
    _row(
        "roll_slide",
        "Gleitwälzgelenk",
        ("G", "G"),
        {_PLANE: "Rz Tx", _SPHERE: "Rz Rx", _SPACE: "Rz Tx"},
        _HIGHER,
        (_FORM, _FORCE),
    ),
    _row(
        "double_slide",
        "Doppelschubgelenk",
        ("S2", ""),
        {_PLANE: "Tx Ty", _SPACE: "Tx Ty"},
        _LOWER,
        (_FORM, _FORCE),
        is_group=True,
    ),
    _row("universal", "Kreuzgelenk", ("D2", "U"), {_SPACE: "Rx Ry"}, _LOWER, (_FORM,)),
    _row("spherical", "Kugelgelenk", ("D3", "S"), {_SPACE: "Rx Ry Rz"}, _LOWER, (_FORM,), is_group=True),
    _row("planar", "Plattengelenk", ("DS2", "E"), {_SPACE: "Rz Tx Ty"}, _LOWER, (_FORCE, _FORM), is_group=True),
    _row("ball_groove", "Kugelrillengelenk", ("D2S", ""), {_SPACE: "Ry Rz Tx"}, _HIGHER, (_FORM,)),
    _row("ball_cylinder", "Kugelrohrgelenk", ("D3S", ""), {_SPACE: "Rx Ry Rz Tx"}, _HIGHER, (_FORM,)),
    _row(
        "cylinder_plane",
        "Zylinderflächengelenk",
        ("D2S2", ""),
        {_SPACE: "Ry Rz Tx Tz"},
        _HIGHER,
        (_FORCE,),
    ),
    _row(
        "double_cylindrical",
        "Doppeldrehschubgelenk",
        ("D2S2", ""),
        {_SPACE: "Rx Ry Tx Ty"},
        Contact.COMPOUND,
        (_FORM,),
    ),
    _row("ball_plane", "Kugelflächengelenk", ("D3S2", ""), {_SPACE: "Rx Ry Rz Tx Tz"}, _HIGHER, (_FORCE,)),
)

_BY_NAME = {p.name: p for p in PAIRS}
OTHER_NAMES = MappingProxyType({"Rollgleitgelenk": "roll_slide", "Schleifengelenk": "prismatic"})
"""Further German names that table 2.2 and section 2.6 use; a *Schleifengelenk* is a slide whose direction turns."""
_BY_FULL_NAME = (
    {p.name: p for p in PAIRS}
    | {p.german.casefold(): p for p in PAIRS}
    | {name.casefold(): _BY_NAME[other] for name, other in OTHER_NAMES.items()}
)


def pair(name: str) -> Pair:
    """The pair of this full name, English or German.

    >>> pair("revolute").f(Space.PLANAR)
    1
    >>> pair("Gleitwälzgelenk").u(Space.PLANAR)
    1
    >>> pair("Rollgleitgelenk"), pair("Schleifengelenk")
    (<pair roll_slide>, <pair prismatic>)

    Raises `PairError` for any other name, with the nearest known name.
    """
    row = _BY_NAME.get(name) or _BY_FULL_NAME.get(name.replace("-", "_").casefold())
    if row is None:
        raise PairError("unknown pair {name!r}{suggestion}", name=name, suggestion=nearest(name, _BY_FULL_NAME))
    return row


def read_symbols(symbols: Iterable[str], space: Space) -> dict[str, Pair]:
    """The pair that each symbol of one text means, with all symbols read in one alphabet.

    Full names, English or German, are valid in either alphabet. A set of symbols is accepted if only one
    alphabet has it, or if both give it the same meaning; a set that mixes alphabets, or that has two valid
    readings, raises an error that states both readings.

    >>> read_symbols(["D", "S"], Space.PLANAR)
    {'D': <pair revolute>, 'S': <pair prismatic>}
    >>> read_symbols(["S"], Space.SPATIAL)
    Traceback (most recent call last):
        ...
    gruebler.base.errors.PairError: 'S' is ambiguous: prismatic in the German alphabet, spherical in the
    international one; write the full name (prismatic or spherical) or add a joint that only one alphabet has
    """
    distinct_symbols = list(dict.fromkeys(symbols))
    named = {s: _BY_FULL_NAME[s.casefold()] for s in distinct_symbols if s.casefold() in _BY_FULL_NAME}
    letters = [s for s in distinct_symbols if s not in named]
    _refuse_unknown(letters)
    readings = {a: r for a in Alphabet if (r := _reading(letters, a, space)) is not None}
    if not readings:
        raise _mixed(letters)
    sound = {a: r for a, r in readings.items() if all(len(meanings) > 0 for meanings in r.values())}
    if not sound:
        raise _impossible(readings, space)
    distinct: list[dict[str, tuple[Pair, ...]]] = []
    for reading in sound.values():
        if reading not in distinct:
            distinct.append(reading)
    if len(distinct) > 1:
        raise _two_alphabets(*distinct)
    for symbol, meanings in distinct[0].items():
        if len(meanings) > 1:
            raise PairError(
                "{symbol!r} is ambiguous: {meanings}; write the full name",
                symbol=symbol,
                meanings=joined_by_or([f"{p.name} ({p.german})" for p in meanings]),
            )
    return named | {symbol: meanings[0] for symbol, meanings in distinct[0].items()}


def _meanings(symbol: str, alphabet: Alphabet) -> tuple[Pair, ...]:
    return tuple(p for p in PAIRS if p.symbols.get(alphabet) == symbol)


def _reading(letters: list[str], alphabet: Alphabet, space: Space) -> dict[str, tuple[Pair, ...]] | None:
    """The pairs of this space that each symbol may mean; None if the alphabet lacks one of the symbols."""
    if not all(_meanings(s, alphabet) for s in letters):
        return None
    return {s: tuple(p for p in _meanings(s, alphabet) if space in p.freedoms) for s in letters}


def _refuse_unknown(letters: list[str]) -> None:
    known = {s for p in PAIRS for s in p.symbols.values()}
    for symbol in letters:
        if symbol not in known:
            raise PairError(
                "unknown joint symbol {symbol!r}{suggestion}; the symbols are {international} (international) and "
                "{german} (German), or the full name of a pair",
                symbol=symbol,
                suggestion=nearest(symbol, (*known, *_BY_FULL_NAME)),
                international=", ".join(sorted({p.symbol() for p in PAIRS if Alphabet.INTERNATIONAL in p.symbols})),
                german=", ".join(dict.fromkeys(p.symbols[Alphabet.GERMAN] for p in PAIRS)),
            )


def _mixed(letters: list[str]) -> PairError:
    german, international = (
        joined(_symbol_meaning(s, _meanings(s, alphabet)) for s in letters)
        for alphabet in (Alphabet.GERMAN, Alphabet.INTERNATIONAL)
    )
    return PairError(
        "the symbols mix two alphabets (German: {german}; international: {international}); write all joints in one of "
        "them",
        german=german,
        international=international,
    )


def _symbol_meaning(symbol: str, pairs: tuple[Pair, ...]) -> Message:
    if not pairs:
        return message("{symbol} is unknown", symbol=symbol)
    return message("{symbol} = {pairs}", symbol=symbol, pairs=joined_by_or([p.title for p in pairs]))


def _impossible(readings: dict[Alphabet, dict[str, tuple[Pair, ...]]], space: Space) -> PairError:
    alphabet, reading = next(iter(readings.items()))
    symbol = next(s for s, meanings in reading.items() if not meanings)
    meaning = _meanings(symbol, alphabet)[0]
    others = {
        p.name: p.symbol(alphabet)
        for a in Alphabet
        if a not in readings
        for p in _meanings(symbol, a)
        if space in p.freedoms
    }
    other_alphabet = message("; if {name} is meant, as {symbol!r} means in the other alphabet, write {right!r}")
    hints = [
        other_alphabet.filled(name=pair(name).title, symbol=symbol, right=replacement)
        for name, replacement in others.items()
    ]
    freedom = len(next(iter(meaning.freedoms.values())))
    return PairError(
        "{symbol!r} is the {name} pair ({german}, f = {freedom}), which {space} chains do not have: "
        "their joints have at most f = {greatest_freedom} and are {pairs}{hints}",
        symbol=symbol,
        name=meaning.name,
        german=meaning.german,
        freedom=freedom,
        space=space.adjective,
        greatest_freedom=space.greatest_freedom,
        pairs=", ".join(
            p.name if p.symbol(alphabet) == p.name else f"{p.symbol(alphabet)} ({p.name})"
            for p in PAIRS
            if space in p.freedoms
        ),
        hints=joined(hints, ""),
    )


def _two_alphabets(german: dict[str, tuple[Pair, ...]], international: dict[str, tuple[Pair, ...]]) -> PairError:
    symbol = next(s for s in german if german[s] != international[s])
    return PairError(
        "{symbol!r} is ambiguous: {german} in the German alphabet, {international} in the international one; write "
        "the full name ({german} or {international}) or add a joint that only one alphabet has",
        symbol=symbol,
        german=joined_by_or([p.title for p in german[symbol]]),
        international=joined_by_or([p.title for p in international[symbol]]),
    )
