"""The motion of a train with given drives: speeds, ratios, torques and power, all exact; docs/theory/gears.md."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from gruebler.base.text import message
from gruebler.machines.gears.mesh_kinds import Unit
from gruebler.machines.gears.rational import Elimination, Row
from gruebler.machines.gears.train import MIXED, GearError, Train, exact_number

_GIVEN = ""  # the column of the constants: a drive is the row "link - speed * constant"; no link has an empty name


class Contradiction(NamedTuple):
    """A drive whose speed follows from the drives before it."""

    link: str
    wanted: Fraction
    follows: Fraction


@dataclass(frozen=True, slots=True)
class Speeds:
    """The speed of every link that the drives determine, None for the others."""

    values: dict[str, Fraction | None]
    contradictions: tuple[Contradiction, ...]
    spare: tuple[str, ...]
    """Drives that follow from others, without contradiction."""

    @property
    def free(self) -> tuple[str, ...]:
        """The links with an undetermined speed."""
        return tuple(link for link, value in self.values.items() if value is None)

    @property
    def complete(self) -> bool:
        """Whether every speed is determined and no drive is contradicted."""
        return not self.free and not self.contradictions


def speeds(train: Train, drives: Mapping[str, object]) -> Speeds:
    """The speeds of all links from given ones (0 fixes a link); a contradicted drive is left out and reported.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> {link: str(value) for link, value in speeds(train, {"sun": 7, "ring": 0}).values.items()}
    {'sun': '7', 'planet': '-14/3', 'arm': '2', 'ring': '0'}
    """
    links = train.links
    form = _relations(train, [*links, _GIVEN])
    wrong: list[Contradiction] = []
    spare: list[str] = []
    units, comparable = train.units(), train.comparable(links)
    for link, value in drives.items():
        requested = exact_number(value, message("speed of {link}", link=train.known(link)))
        if requested and units[link] != Unit.TURNING and not comparable:
            raise GearError("{link} is driven, but {mixed}", link=link, mixed=MIXED)
        remainder = form.left({link: Fraction(1)})
        if remainder.keys() - {_GIVEN}:
            form.add({link: Fraction(1), _GIVEN: -requested})
            continue
        follows = remainder.get(_GIVEN, Fraction(0))
        spare.append(link) if follows == requested else wrong.append(Contradiction(link, requested, follows))
    determined = form.full()
    values = {
        link: -row.get(_GIVEN, Fraction(0)) if (row := determined.get(link)) and row.keys() <= {link, _GIVEN} else None
        for link in links
    }
    return Speeds(values, tuple(wrong), tuple(spare))


def influence(train: Train, drives: Iterable[str]) -> dict[str, Row[str]]:
    """Each link's speed as a combination of the drives' speeds: link to drive to factor, zeros left out.

    Raises GearError if the drives do not determine every link, or depend on one another.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> {drive: str(factor) for drive, factor in influence(train, ["sun", "ring"])["arm"].items()}
    {'sun': '2/7', 'ring': '5/7'}
    """
    names = [train.known(link) for link in drives]
    form = _relations(train, train.links)
    free = len(train.links) - len(form.rows)
    if not all(form.add({link: Fraction(1)}) for link in names) or len(names) != free:
        raise GearError(
            "the train has {free} freedoms and needs as many independent drives; given: {drives}",
            free=free,
            drives=", ".join(names) or message("none"),
        )
    chosen = set(names)
    reduced = _relations(train, [*(link for link in train.links if link not in chosen), *names]).full()
    factors = {}
    for link in train.links:
        row = reduced.get(link, {link: Fraction(-1)})  # a drive is no pivot: it is itself
        factors[link] = {drive: -row[drive] for drive in names if drive in row}
    return factors


def ratio(train: Train, a: str, b: str, held: Iterable[str] = ()) -> Fraction:
    """The transmission ratio i = w_a / w_b while the held links are fixed.

    >>> from gruebler.machines.gears import read_train
    >>> str(ratio(read_train("sun:24 planet:18 ring:-60 on arm").train, "sun", "arm", held=["ring"]))
    '7/2'
    """
    state = speeds(train, {**dict.fromkeys(held, 0), a: 1})
    if a in (contradiction.link for contradiction in state.contradictions) or state.values[train.known(b)] == 0:
        raise GearError("{a} or {b} stands still: there is no ratio of {a} to {b}", a=a, b=b)
    value = state.values[b]
    if value is None:
        raise GearError("the speed of {b} does not follow from {a}", b=b, a=", ".join((a, *held)))
    if not train.comparable((a, b)):
        raise GearError("{a}, {b}: {mixed}", a=a, b=b, mixed=MIXED)
    return 1 / value


@dataclass(frozen=True, slots=True)
class Balance:
    """External torques (forces on links that slide) and the power of each; the powers sum to zero."""

    torques: dict[str, Fraction | float]
    powers: dict[str, Fraction | float]
    """Torque times speed: watts for torques in N m, forces in N, lengths in m and speeds in rad/s."""

    @property
    def watts(self) -> dict[str, float]:
        """The powers in W for speeds in 1/min, with torques in N m, forces in N and lengths in m.

        >>> from gruebler.machines.gears import read_train
        >>> state = balance(read_train("in:20 out:40").train, {"in": 1500}, {"out": 20})
        >>> {link: round(power, 1) for link, power in state.watts.items()}
        {'in': 1570.8, 'out': -1570.8}
        """
        try:
            return {link: float(power) * math.tau / 60 for link, power in self.powers.items()}
        except OverflowError:
            raise GearError("the powers are too large to be told as numbers") from None


def balance(train: Train, drives: Mapping[str, object], loads: Mapping[str, object]) -> Balance:
    """The torques at drives and held links that balance the loads, by virtual work.

    For every motion that the train allows the sum of the work is zero: T_d = -sum of T_l * (dw_l / dw_d). Exact,
    except where a force acts on a link moved by a screw (a float, because of 2 pi).

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> state = balance(train, {"sun": 7, "ring": 0}, {"arm": -70})
    >>> {link: str(torque) for link, torque in state.torques.items()}
    {'sun': '20', 'ring': '50', 'arm': '-70'}
    """
    factors = influence(train, drives)
    load_values = {
        train.known(link): exact_number(value, message("load on {link}", link=link)) for link, value in loads.items()
    }
    if conflicting := set(load_values) & set(drives):
        raise GearError(
            "{links}: driven or held, so its torque is an answer and cannot be a load",
            links=", ".join(sorted(conflicting)),
        )
    units = train.units()
    torques: dict[str, Fraction | float] = {}
    for drive in drives:
        terms = [(link, -factors[link].get(drive, Fraction(0)) * load) for link, load in load_values.items()]
        torques[drive] = _per_radian(terms, units, drive)
    torques |= load_values
    moving = speeds(train, drives).values
    powers = {
        link: (
            torque * (moving[link] or 0)
            if units[link] != Unit.PER_TURN
            else float(torque * (moving[link] or 0)) / math.tau
        )
        for link, torque in torques.items()
    }
    return Balance(torques, powers)


def _per_radian(terms: list[tuple[str, Fraction]], units: Mapping[str, Unit], drive: str) -> Fraction | float:
    """The sum, with forces at screws multiplied by lead / 2 pi."""
    scale = math.tau if units[drive] == Unit.PER_TURN else 1
    plain = sum((value for link, value in terms if units[link] != Unit.PER_TURN), Fraction(0))
    screwed = sum((value for link, value in terms if units[link] == Unit.PER_TURN), Fraction(0))
    if scale == 1:
        return plain + float(screwed) / math.tau if screwed else plain
    return screwed + float(plain) * scale if plain else screwed


def _relations(train: Train, columns: Iterable[str]) -> Elimination[str]:
    """The speed relations, the columns in this order."""
    form = Elimination(columns)
    for mesh in train.meshes:
        form.add(mesh.row())
    return form
