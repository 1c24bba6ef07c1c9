"""Gear trains: shafts, and meshes between wheels on them; docs/theory/gears.md.

A *link* turns (or slides) as one body: a shaft with all its wheels, a carrier, a rack, a nut. A *mesh* joins
two links; if a carrier bears its axes, it joins the speeds relative to that carrier (Willis).
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from fractions import Fraction
from numbers import Rational

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.immutable import settle
from gruebler.base.notebook import Drawn
from gruebler.base.text import Message, message
from gruebler.machines.gears.mesh_kinds import KINDS, MeshKind, Unit
from gruebler.machines.gears.rational import Elimination, Row, rational_echelon

FRAME = "frame"


MIXED = message("some slide per radian, others per turn, which differ by 2 pi; give racks and winches by pitch=TRAVEL")


class GearError(GrueblerError):
    """An impossible gear train, or a value that it does not determine."""


_UNITS = {
    Unit.TURNING: message("a turning link"),
    Unit.PER_RADIAN: message("sliding per radian"),
    Unit.PER_TURN: message("sliding per turn"),
}


_EXPONENT = re.compile(r"[^eE]*([eE][-+]?0*\d{1,3})?")
"""Exponents of three digits: 1e999999999 is no number of teeth, and its digits would fill the memory."""


def exact_number(value: object, what: str | Message) -> Fraction:
    """A finite number as a fraction; decimals exactly as written.

    >>> exact_number(0.1, "size"), exact_number("7/2", "size"), exact_number("2.5e-3", "size")
    (Fraction(1, 10), Fraction(7, 2), Fraction(1, 400))
    """
    try:
        if isinstance(value, Rational) and not isinstance(value, bool):
            return Fraction(int(value.numerator), int(value.denominator))
        if isinstance(value, float) or (isinstance(value, str) and len(value) <= 40 and _EXPONENT.fullmatch(value)):
            return Fraction(str(value))
    except (ValueError, ZeroDivisionError):
        pass
    raise GearError(
        "{what}: expected a number such as 24, 12.5, 7/2 or 1e6 (up to 1e999), but found {value!r}",
        what=what,
        value=value,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Mesh:
    """Two links that drive each other, with tooth numbers or radii, and the carrier of their axes.

    ``size_a`` is the radius, pitch travel or lead where the second link slides, and ``size_b`` is then not used. In a
    bevel mesh on a moving carrier the second link is the planet, its speed counted about its own axis, relative to the
    carrier.
    """

    a: str
    b: str
    size_a: Fraction
    size_b: Fraction = Fraction(1)
    carrier: str = FRAME
    kind: str = "gear"

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise GearError("no kind of mesh is called {word!r}: {known}{suggestion}", **unknown(self.kind, KINDS))
        if len({self.a, self.b, self.carrier}) < 3 and not (self.carrier == FRAME and self.a != self.b):
            raise GearError("a mesh joins two different links and is carried by a third: {mesh}", mesh=self)
        for name, raw_size in ((self.a, self.size_a), (self.b, self.size_b)):
            if not isinstance(name, str) or not name:
                raise GearError("a link has a name, not {name!r}", name=name)
            size = exact_number(raw_size, message("wheel on {link}", link=name))
            if size == 0 or (size < 0 and not self.traits.signed):
                raise GearError(
                    "wheel on {name}: {kind} takes a positive size, not {size}", name=name, kind=self.kind, size=size
                )
        settle(self, size_a=exact_number(self.size_a, self.a))
        settle(self, size_b=exact_number(self.size_b, self.b))
        if self.traits.touching and min(self.size_a, self.size_b) < 0 <= self.size_a + self.size_b:
            raise GearError("an internal wheel (minus) is larger than the wheel in it: {mesh}", mesh=self)
        if self.traits.touching and max(self.size_a, self.size_b) < 0:
            raise GearError("two internal wheels do not mesh: {mesh}", mesh=self)

    def __str__(self) -> str:
        """The text of the mesh, as `read_train` takes it back.

        >>> str(Mesh(a="planet", b="ring", size_a=18, size_b=-60, carrier="arm"))
        'gear planet:18 ring:-60 on arm'
        """
        return self.traits.form.format_map(asdict(self)) + f" on {self.carrier}" * (self.carrier != FRAME)

    @property
    def traits(self) -> MeshKind:
        """What its kind does."""
        return KINDS[self.kind]

    def row(self) -> Row[str]:
        """The linear form of the speeds that equals zero."""
        form, factors = Row[str](), self.traits.equation(self.size_a, self.size_b)
        for link, value in zip((self.a, self.b, self.carrier), factors, strict=True):
            form[link] = form.get(link, Fraction(0)) + value
        form.pop(FRAME, None)
        return form

    def units(self) -> dict[str, Unit]:
        """The units of the speeds of its links."""
        unit = self.traits.unit
        return {self.a: Unit.TURNING, self.b: unit, self.carrier: unit if self.traits.carries else Unit.TURNING}


@door
@dataclass(frozen=True, slots=True)
class Train(Drawn):
    """Links and meshes; the link ``frame`` is fixed.

    >>> inner = Mesh(a="sun", b="planet", size_a=24, size_b=18, carrier="arm")
    >>> outer = Mesh(a="planet", b="ring", size_a=18, size_b=-60, carrier="arm")
    >>> train = Train((inner, outer))
    >>> train.links, train.mobility
    (('sun', 'planet', 'arm', 'ring'), 2)
    >>> train.relation("sun", "ring", "arm")
    {'sun': 2, 'ring': 5, 'arm': -7}
    >>> print(train)
    gear sun:24 planet:18 on arm; gear planet:18 ring:-60 on arm

    See Also:
        `Cam`, `Geneva`, `draw`, `animate`

    Theory:
        docs/theory/gears.md
    """

    meshes: tuple[Mesh, ...]

    def __init__(self, meshes: Iterable[Mesh]) -> None:
        settle(self, meshes=tuple(meshes))
        if not self.meshes:
            raise GearError("a gear train has at least one mesh")
        self.units()

    def __str__(self) -> str:
        """The text of the train, as `read_train` takes it back."""
        return "; ".join(map(str, self.meshes))

    @property
    def links(self) -> tuple[str, ...]:
        """The moving links in the order in which they are named."""
        named = dict.fromkeys(link for mesh in self.meshes for link in (mesh.a, mesh.b, mesh.carrier))
        return tuple(link for link in named if link != FRAME)

    def units(self) -> dict[str, Unit]:
        """The unit of each link's speed; GearError for a link with two units."""
        units: dict[str, Unit] = {}
        for mesh in self.meshes:
            for link, unit in mesh.units().items():
                if link != FRAME and units.setdefault(link, unit) != unit:
                    raise GearError(
                        "{link} is {first} in one mesh and {second} in '{mesh}'"
                        if Unit.TURNING in (unit, units[link])
                        else "{link} is {first} in one mesh and {second} in '{mesh}'; give the rack by its pitch "
                        "instead",
                        link=link,
                        first=_UNITS[units[link]],
                        second=_UNITS[unit],
                        mesh=mesh,
                    )
        return units

    @property
    def basis(self) -> dict[str, Row[str]]:
        """The speed relations in reduced form: each dependent link with its row."""
        # Last links first: links named first remain free, and the others are expressed in terms of them.
        return rational_echelon((mesh.row() for mesh in self.meshes), self.links[::-1])

    @property
    def mobility(self) -> int:
        """The number of independent speeds."""
        return len(self.links) - len(self.basis)

    @property
    def redundant(self) -> tuple[Mesh, ...]:
        """Redundant meshes, such as those of a second planet; each depends on the ones before it."""
        form = Elimination(self.links)
        return tuple(mesh for mesh in self.meshes if not form.add(mesh.row()))

    def comparable(self, links: Iterable[str]) -> bool:
        """Whether the speeds of these links can be compared: not if some slide per radian and others per turn."""
        units = self.units()
        return comparable(units[link] for link in links)

    def known(self, link: str) -> str:
        """The link, if the train has it; otherwise an error that offers the nearest name."""
        if link not in self.links:
            raise GearError(
                "the train has no moving link {word!r}{suggestion}; its links are {known}", **unknown(link, self.links)
            )
        return link

    def relations(self, *links: str) -> list[dict[str, int]]:
        """All independent relations between the speeds of some links, each in whole numbers."""
        units, chosen = self.units(), dict.fromkeys(links)
        if strangers := [link for link in chosen if link not in units]:
            self.known(strangers[0])
        others = [link for link in self.links if link not in chosen]
        # Sliding links are expressed by turning ones, so that lengths per radian and per turn are not mixed.
        turning = [link for link in chosen if units[link] == Unit.TURNING]
        sliding = [link for link in chosen if units[link] != Unit.TURNING]
        form = rational_echelon((mesh.row() for mesh in self.meshes), [*others, *sliding, *turning])
        place = {link: k for k, link in enumerate(chosen)}
        return [
            _whole({link: row[link] for link in sorted(row, key=place.__getitem__)})
            for pivot, row in form.items()
            if pivot in chosen
        ]

    def relation(self, *links: str) -> dict[str, int]:
        """The one relation between the speeds of some links: the sum of coefficient times speed is zero.

        Raises GearError if their speeds are independent, or joined by more than one relation.
        """
        relations = self.relations(*links)
        if len(relations) != 1:
            raise GearError(
                "there are {count} relations between the speeds of {links}, not one"
                if relations
                else "there is no relation between the speeds of {links}",
                count=len(relations),
                links=", ".join(links),
            )
        if not self.comparable(relations[0]):
            raise GearError("{links}: {mixed}", links=", ".join(relations[0]), mixed=MIXED)
        return relations[0]


def comparable(units: Iterable[Unit]) -> bool:
    """Whether speeds in these units can be compared: per radian and per turn differ by 2 pi."""
    return not {Unit.PER_RADIAN, Unit.PER_TURN} <= set(units)


def _whole(row: Row[str]) -> dict[str, int]:
    from math import gcd, lcm

    scale = lcm(*(value.denominator for value in row.values()))
    whole = {link: int(value * scale) for link, value in row.items()}
    common = gcd(*whole.values())
    sign = 1 if next(iter(whole.values())) > 0 else -1
    return {link: sign * value // common for link, value in whole.items()}
