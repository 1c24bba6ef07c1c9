"""The table of joint kinds: the relative motions that each allows two links, and how it is written.

A pair is described by its *motion*, a list of freedoms in the joint's own axes. ``Rz`` is a turn about the z axis,
``Tx`` a shift along x, ``Hz`` a screw about z (one freedom that turns and shifts at once). What is left of them in a
plane, on a sphere and in space follows from the space. A space has ``b`` motion directions; a pair with ``f``
freedoms takes away ``u = b - f`` of them.

A new kind is a row of `PAIRS`. Whatever the library asks of a pair is a property that follows from its row
(`Pair.is_turning`, `Pair.rolls`, `Pair.keeps_directions`); no code outside compares names of pairs
(`tests/structure/chain/test_kinds.py`). Its elements and its pictures are one row more in each of their tables.

Symbols belong to an alphabet because the same letter means different pairs: ``S`` is the German
*Schubgelenk* (prismatic) and the international spherical pair. A text is therefore read as a whole, in one
alphabet (`gruebler.structure.chain.symbols`); the full name of a pair, English or German, is valid everywhere.

Source: table 2.2 of the teaching documents 000 and 003, reconstructed against ISO 3952; the planar pairs from
their sections 2.5 and 2.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from gruebler.base.errors import PairError, unknown
from gruebler.base.immutable import settle
from gruebler.base.text import LANGUAGES, Text, joined, message
from gruebler.structure.chain.spaces import Freedom, Space


class Alphabet(StrEnum):
    """A set of symbols used together in one text."""

    GERMAN = "german"
    INTERNATIONAL = "international"

    @property
    def language(self) -> str:
        """The language whose readers expect it."""
        return "de" if self is Alphabet.GERMAN else LANGUAGES[0]

    @classmethod
    def of_language(cls, lang: str) -> Alphabet:
        """The symbols that a reader of this language expects.

        >>> Alphabet.of_language("de"), Alphabet.of_language("en")
        (<Alphabet.GERMAN: 'german'>, <Alphabet.INTERNATIONAL: 'international'>)
        """
        return next((each for each in cls if each.language == lang), cls.INTERNATIONAL)


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


@dataclass(frozen=True, slots=True)
class PairTitle:
    """The full name of a pair, in the reader's language."""

    name: str

    def in_language(self, lang: str) -> str:
        """The name in a language."""
        return pair(self.name).full_name(lang)

    def __str__(self) -> str:
        return self.in_language(LANGUAGES[0])


@dataclass(frozen=True, slots=True)
class SymbolText:
    """A text with joint symbols, in the alphabet that the reader expects; constructed by `in_alphabets`."""

    texts: dict[Alphabet, str]

    def in_language(self, lang: str) -> str:
        """The text in the alphabet of a language."""
        return self.texts[Alphabet.of_language(lang)]

    def __str__(self) -> str:
        return self.in_language(LANGUAGES[0])


def in_alphabets(write: Callable[[Alphabet], str]) -> SymbolText:
    """The text that a function writes in each alphabet, as one message.

    >>> in_alphabets(pair("prismatic").symbol).in_language("de")
    'S'
    """
    return SymbolText({alphabet: write(alphabet) for alphabet in Alphabet})


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pair:
    """One row of the table. Compared and hashed by its name."""

    name: str
    """The English name, also usable in texts: ``revolute``."""
    german: str
    symbols: Mapping[Alphabet, str]
    """The symbol in each alphabet that has one."""
    motion: tuple[Freedom, ...]
    """What the second link can do against the first, in the joint's axes."""
    axes: Mapping[Space, str]
    """For each space in which the pair exists, those of the joint's axes that its place must name."""
    contact: Contact
    closures: tuple[Closure, ...]
    """The closures used in practice, the usual one first."""
    other_names: tuple[str, ...] = ()
    """Further German names."""
    is_group: bool = False
    """Whether relative motions compose to motions of the same kind, so that more than two links can share it."""
    freedoms: Mapping[Space, tuple[Freedom, ...]] = field(init=False)
    """The motion directions, for each space in which the pair exists: what its motion is there."""

    def __post_init__(self) -> None:
        freedoms = {space: tuple(map(space.seen, self.motion)) for space in self.axes}
        settle(self, freedoms=MappingProxyType(freedoms))

    # --- what a pair does; each follows from its motion and its contact ------------------------------------------

    @property
    def is_higher(self) -> bool:
        """Whether its elements touch in a line or a point; in the plane what rolls, or rolls and slides."""
        return self.contact is Contact.HIGHER

    @property
    def is_lower(self) -> bool:
        """Whether its elements touch in a surface."""
        return self.contact is Contact.LOWER

    @property
    def is_turning(self) -> bool:
        """Whether it is a turning pair: a pin or hinge, whose links turn about one axis and do nothing else."""
        return self.is_lower and self.motion == (Freedom.TURN_Z,)

    @property
    def is_sliding(self) -> bool:
        """Whether it is a sliding pair: its links travel along one line and do nothing else."""
        return self.is_lower and self.motion == (Freedom.TRAVEL_X,)

    @property
    def is_basic(self) -> bool:
        """Whether it turns or slides: the pairs of the linkages that are solved; others are replaced by these."""
        return self.is_turning or self.is_sliding

    @property
    def rolls(self) -> bool:
        """Whether two contours roll on each other without slip."""
        return self.is_higher and self.motion == (Freedom.TURN_Z,)

    @property
    def rolls_and_slides(self) -> bool:
        """Whether two contours roll and slide on each other: teeth, cams, pins in slots."""
        return self.is_higher and self.motion == (Freedom.TURN_Z, Freedom.TRAVEL_X)

    @property
    def has_contours(self) -> bool:
        """Whether two contours touch, as wheels and cams do.

        >>> [p.name for p in PAIRS if p.has_contours]
        ['rolling', 'roll_slide']
        """
        return self.rolls or self.rolls_and_slides

    @property
    def slides_two_ways(self) -> bool:
        """Whether it slides along two lines of a plane."""
        return self.is_lower and self.motion == (Freedom.TRAVEL_X, Freedom.TRAVEL_Y)

    @property
    def guides(self) -> bool:
        """Whether it guides a slider: surfaces travel along each other and turn about no other line than they travel.

        >>> [p.name for p in PAIRS if p.guides]
        ['prismatic', 'cylindrical', 'double_slide']
        """
        ways = {freedom.axis for freedom in self.motion if freedom.travels}
        return self.is_lower and bool(ways) and {f.axis for f in self.motion if f.turns} <= ways

    @property
    def has_pitch(self) -> bool:
        """Whether it couples a turn with a travel, as a screw does."""
        return any(freedom.has_pitch for freedom in self.motion)

    @property
    def is_ball(self) -> bool:
        """Whether it turns about every axis through one point, as a ball in a socket does."""
        return self.is_lower and self.motion == (Freedom.TURN_X, Freedom.TURN_Y, Freedom.TURN_Z)

    @property
    def is_cross(self) -> bool:
        """Whether it turns about two axes that meet, as a Hooke's joint does."""
        return self.is_lower and self.motion == (Freedom.TURN_X, Freedom.TURN_Y)

    @property
    def has_body_between(self) -> bool:
        """Whether its links touch a body between them and not each other."""
        return self.contact is Contact.COMPOUND

    @property
    def turns_in_plane(self) -> bool:
        """Whether its links can turn against each other in a plane.

        >>> [p.name for p in PAIRS if p.turns_in_plane]
        ['revolute', 'rolling', 'roll_slide']
        """
        return Freedom.TURN_Z in self.freedoms.get(Space.PLANAR, ())

    @property
    def keeps_directions(self) -> bool:
        """Whether its links do not turn against each other, so that it can carry a moment about every axis.

        >>> [p.name for p in PAIRS if p.keeps_directions]
        ['prismatic', 'double_slide']
        """
        return not any(freedom.turns for freedom in self.motion)

    @property
    def lower_pairs(self) -> tuple[Pair, ...]:
        """The turning and sliding pairs that do the same one after the other, one for each freedom; else none.

        What rolls without slip is not replaced, nor what has screws.

        >>> pair("roll_slide").lower_pairs, pair("rolling").lower_pairs
        ((<pair revolute>, <pair prismatic>), ())
        """
        if self.rolls or self.has_pitch:
            return ()
        return tuple(_TURNING if freedom.turns else _SLIDING for freedom in self.motion)

    def left_without(self, freedom: str) -> Pair:
        """The pair that is left when one freedom is locked; of two that move alike the one that touches alike.

        >>> pair("roll_slide").left_without("Rz"), pair("roll_slide").left_without("Tx")
        (<pair prismatic>, <pair rolling>)

        Raises `PairError` if the table has no such pair.
        """
        left = sorted(f.travels for f in self.motion if f != freedom)
        alike = [p for p in PAIRS if sorted(f.travels for f in p.motion) == left and not p.has_pitch]
        if not alike or freedom not in self.motion:
            raise PairError("no pair is known that is a {name} without {freedom}", name=self.title, freedom=freedom)
        return min(alike, key=lambda p: p.contact is not self.contact)

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
        return Text(en=self.name, de=self.german).in_language(lang)

    def plain_name(self, lang: str) -> str:
        """The name in a sentence, without underscores."""
        return self.full_name(lang).replace("_", "-")

    def symbol(self, alphabet: Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The symbol in this alphabet, or the full name where the alphabet has none."""
        return self.symbols.get(alphabet, self.name if alphabet is Alphabet.INTERNATIONAL else self.german)


_ROWS = """
revolute           Drehgelenk                      D    R Rz             - z  z  lower    form,material       group
prismatic          Schubgelenk,Schleifengelenk     S    P Tx             x .  x  lower    form,force,material group
helical            Schraubgelenk                   W    H Hz             . .  z  lower    form                group
rolling            Wälzgelenk                      W    W Rz             y yz .  higher   force               .
cylindrical        Drehschubgelenk                 DS   C Rz,Tz          . .  z  lower    form                group
roll_slide         Gleitwälzgelenk,Rollgleitgelenk G    G Rz,Tx          y yz yz higher   form,force          .
double_slide       Doppelschubgelenk               S2   . Tx,Ty          - .  z  lower    form,force          group
universal          Kreuzgelenk                     D2   U Rx,Ry          . .  xy lower    form                .
spherical          Kugelgelenk                     D3   S Rx,Ry,Rz       . .  -  lower    form                group
planar             Plattengelenk                   DS2  E Rz,Tx,Ty       . .  z  lower    force,form          group
ball_groove        Kugelrillengelenk               D2S  . Ry,Rz,Tx       . .  yz higher   form                .
ball_cylinder      Kugelrohrgelenk                 D3S  . Rx,Ry,Rz,Tx    . .  x  higher   form                .
cylinder_plane     Zylinderflächengelenk           D2S2 . Ry,Rz,Tx,Tz    . .  yz higher   force               .
double_cylindrical Doppeldrehschubgelenk           D2S2 . Rx,Ry,Tx,Ty    . .  xy compound form                .
ball_plane         Kugelflächengelenk              D3S2 . Rx,Ry,Rz,Tx,Tz . .  y  higher   force               .
"""
"""English name, German names, German and international symbol, motion, the axes that a place names in the plane, on
the sphere and in space (- for none, . where the pair does not exist), contact, closures, and whether it is a group."""


def _pair_of_row(row: str) -> Pair:
    name, german, own, international, motion, *axes, contact, closures, group = row.split()
    symbols = {Alphabet.GERMAN: own, Alphabet.INTERNATIONAL: international}
    return Pair(
        name=name,
        german=german.split(",")[0],
        symbols=MappingProxyType({alphabet: symbol for alphabet, symbol in symbols.items() if symbol != "."}),
        motion=tuple(map(Freedom, motion.split(","))),
        axes={s: named.strip("-") for s, named in zip(_SPACES, axes, strict=True) if named != "."},
        contact=Contact(contact),
        closures=tuple(map(Closure, closures.split(","))),
        other_names=tuple(german.split(",")[1:]),  # a Schleifengelenk is a slide whose direction turns
        is_group=group == "group",
    )


_SPACES = (Space.PLANAR, Space.SPHERICAL, Space.SPATIAL)
PAIRS: tuple[Pair, ...] = tuple(map(_pair_of_row, _ROWS.strip().splitlines()))
_TURNING = next(p for p in PAIRS if p.is_turning)
_SLIDING = next(p for p in PAIRS if p.is_sliding)

_BY_NAME = {p.name: p for p in PAIRS}
BY_FULL_NAME = MappingProxyType(
    {p.name: p for p in PAIRS}
    | {p.german.casefold(): p for p in PAIRS}
    | {name.casefold(): p for p in PAIRS for name in p.other_names}
)
"""The pair of each full name, German ones in lower case."""


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
    row = _BY_NAME.get(name) or BY_FULL_NAME.get(name.replace("-", "_").casefold())
    if row is None:
        if len(name) < 3:
            raise PairError(
                "unknown pair {name!r}: expected a full name such as 'revolute'; Chain.parse() reads letters", name=name
            )
        raise PairError("unknown pair {word!r}{suggestion}", **unknown(name, BY_FULL_NAME))
    return row
