"""The period of a gear train, and the exact displacements of all links in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from gruebler.base.text import message
from gruebler.machines.gears import GearError, Train, Unit, speeds

_MOST = 100  # turns of the fastest link
_TRAVEL = 2  # radii: the largest displacement of a rack or a load
_WHY = {False: message("do not determine all speeds"), True: message("contradict each other")}
_THREADS = 4  # turns of a screw


@dataclass(frozen=True, kw_only=True)
class TrainMotion:
    """Rates of all links, and the shown time."""

    rates: dict[str, Fraction]
    """Turns in a unit of time; for links that slide length per radian or per turn, in the unit of the train."""
    per_radian: frozenset[str]
    slides: frozenset[str]
    drive: str
    cycle: Fraction
    """The time after which every link that turns has made whole turns."""
    time: Fraction
    """The shown time: the cycle, or less; with links that slide a turn of the fastest link, then back."""
    seconds: float
    chosen: tuple[str, ...] = ()
    """The chosen driven and held links, if none were given."""

    def turns(self, link: str) -> float:
        """The number of turns of a link in the shown time; 0 for the frame."""
        return float(self.rates.get(link, Fraction(0)) * self.time)

    def displacement(self, link: str) -> float:
        """The displacement of a link in that time."""
        return self.turns(link) * (math.tau if link in self.per_radian else 1.0)

    @property
    def drive_turns(self) -> Fraction:
        """The number of turns of the drive, for the display of its position."""
        return abs(self.rates[self.drive] * self.time)


def train_motion(train: Train, drives: Mapping[str, object], seconds: float, most: int = _MOST) -> TrainMotion:
    """The motion of a train with given speeds, or with chosen speeds if none are given.

    ``seconds`` are for a turn of the fastest link, or, if links slide, for both directions; the fastest link makes at
    most ``most`` turns.

    >>> from gruebler.machines.gears import read_train
    >>> motion = train_motion(read_train("sun:24 planet:18 ring:-60 on arm").train, {"sun": 7, "ring": 0}, 2.0)
    >>> motion.cycle, motion.seconds, {link: motion.turns(link) for link in ("sun", "arm")}
    (Fraction(3, 1), 42.0, {'sun': 21.0, 'arm': 6.0})
    """
    chosen = dict(drives) or _chosen(train)
    state = speeds(train, chosen)
    if not state.complete:
        wrong = [contradiction.link for contradiction in state.contradictions]
        links = ", ".join(wrong or state.free)
        raise GearError("the drives {why}, so nothing can be shown: {links}", why=_WHY[bool(wrong)], links=links)
    rates = {link: value or Fraction(0) for link, value in state.values.items()}
    units = train.units()
    turning = {link: rate for link, rate in rates.items() if units[link] == Unit.TURNING}
    slides = frozenset(link for link in rates if link not in turning and rates[link])
    fastest = max((abs(rate) for rate in turning.values()), default=Fraction(0))
    if not fastest:
        raise GearError("nothing turns with these drives")
    drive = next((link for link in chosen if turning.get(link)), None) or max(turning, key=lambda k: abs(turning[k]))
    moving = [abs(rate) for rate in turning.values() if rate]
    cycle = Fraction(math.lcm(*(rate.denominator for rate in moving)), math.gcd(*(rate.numerator for rate in moving)))
    turn = 1 / abs(turning[drive])
    if slides:
        time, takes = _there(train, rates, fastest), seconds
    else:
        longest = most / fastest
        time = cycle if cycle <= longest else max(turn, longest // turn * turn)
        takes = float(time * fastest) * seconds
    per_radian = frozenset(link for link in rates if units[link] == Unit.PER_RADIAN)
    return TrainMotion(
        rates=rates,
        per_radian=per_radian,
        slides=slides,
        drive=drive,
        cycle=cycle,
        time=time,
        seconds=takes,
        chosen=() if drives else tuple(chosen),
    )


def _there(train: Train, rates: Mapping[str, Fraction], fastest: Fraction) -> Fraction:
    """The time for which links slide in one direction: a few radii, and a turn of the fastest link at most."""
    times = [1 / fastest]
    for mesh in train.meshes:
        rate = abs(rates.get(mesh.b, Fraction(0)))
        if rate and mesh.traits.wheels == 1:
            times.append((_TRAVEL * abs(mesh.size_a) / rate / Fraction(math.tau)).limit_denominator(360))
        elif rate and mesh.traits.wheels == 0:
            times[0] = _THREADS / fastest
    return min(time for time in times if time > 0)


def _chosen(train: Train) -> dict[str, int]:
    """The first link that can turn drives; others are held, last ones first, until every speed is determined."""
    units = train.units()
    order = [link for link in train.links if units[link] == Unit.TURNING]
    carriers = {mesh.carrier for mesh in train.meshes}
    rings = {link for mesh in train.meshes for link, size in ((mesh.a, mesh.size_a), (mesh.b, mesh.size_b)) if size < 0}
    ends = [link for mesh in train.meshes if mesh.carrier != "frame" for link in (mesh.a, mesh.b)]
    first = next((link for link in order if not speeds(train, {link: 1}).contradictions), None)
    if first is None:
        raise GearError("nothing can turn in this train")
    held_speeds: dict[str, int] = {first: 1}
    candidates = sorted(
        (link for link in reversed(order) if link != first),
        key=lambda link: (link not in rings, ends.count(link) > 1, link in carriers),
    )
    for link in [*candidates, *(link for link in train.links if units[link] != Unit.TURNING)]:
        if not speeds(train, held_speeds).free:
            break
        if link in speeds(train, held_speeds).free:
            held_speeds[link] = 0
    return held_speeds
