"""The text and TOML forms of a gear train with its drives, loads and planets.

Statements are separated by line ends or semicolons; # begins a comment.

    sun:24 planet:18 ring:-60 on arm planets=3    wheels that mesh in a row, LINK:TEETH; minus: internal toothing
    in:20 lay:41; lay:19 out:42                   two wheels on one shaft: the link is named twice
    R(0-1-2) R(0-3) G(1:24-3:18) G(2:-60-3:18)    a chain with tooth numbers: links of each axis, gear pairs; the
                                                  carrier of a pair is the link that both axes have in common
    belt motor:100 drum:250                       also chain, crossed, friction, bevel, gear (the usual kind)
    bevel left:16 star:10 right:-16 on case       central, planet, central; minus: the one that faces the other
    rack pinion:18 slide                          radius 18; or with module=2 or pitch=6.28 and a number of teeth
    screw spindle slide lead=5                    travel in a turn; minus: left-hand; on NUT if the nut turns too
    winch drum:60 load falls=2                    radius; falls: ropes that carry the load; or drum:1 pitch=377
    drive sun=1000                                a speed (drive may be left out); hold ring = drive ring=0
    load arm=-50                                  a torque from outside; a force on links that slide
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise, permutations
from typing import Any

from gruebler.base.errors import nearest, unknown
from gruebler.base.notebook import explained
from gruebler.machines.gears.mesh_kinds import KINDS
from gruebler.machines.gears.messages import explain_train
from gruebler.machines.gears.train import FRAME, GearError, Mesh, Train, exact_number

_STATEMENTS = (*(kind for kind in KINDS if " " not in kind), "drive", "hold", "load")
_OPTIONS = {"rack": {"module", "pitch"}, "screw": {"lead"}, "winch": {"falls", "pitch"}, "gear": {"planets"}}
_NAME = re.compile(r"[^\s:=;#]+\Z")
_JOINT = re.compile(r"[RG]\([^()]*\)")
_AXIS, _GEAR = re.compile(r"R\(([^()]*)\)"), re.compile(r"G\(([^()]*)\)")
_WHEELS = re.compile(r"([^\s:-]+):(-?[^\s:-]+)-([^\s:-]+):(-?[^\s:-]+)")


@explained
@dataclass(frozen=True, slots=True)
class TrainReading:
    """The content of a text: the train, the given speeds and loads, and the number of each kind of planets."""

    train: Train
    drives: dict[str, Fraction] = field(default_factory=dict)
    loads: dict[str, Fraction] = field(default_factory=dict)
    planets: dict[str, int] = field(default_factory=dict)

    def explain(self, lang: str = "en") -> str:
        """A description of the train and its drives, line by line, in English or German (``de``).

        >>> print(read_train("sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=7"))
        4 moving links, 2 independent meshes: mobility 2.
        Speeds: 2 sun - 7 arm + 5 ring = 0
        3 planets (planet) at equal angles can be put in.
        """
        return explain_train(self.train, self.drives, self.planets, lang)


def read_train(text: str) -> TrainReading:
    """Read the text form; the links of drives and loads must be in the train.

    >>> reading = read_train("sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1000")
    >>> [str(mesh) for mesh in reading.train.meshes]
    ['gear sun:24 planet:18 on arm', 'gear planet:18 ring:-60 on arm']
    >>> as_chain = read_train("R(arm-sun-ring) R(arm-planet) G(sun:24-planet:18) G(planet:18-ring:-60)")
    >>> as_chain.train.meshes == reading.train.meshes
    True
    >>> reading.planets, {link: str(speed) for link, speed in reading.drives.items()}
    ({'planet': 3}, {'ring': '0', 'sun': '1000'})
    """
    meshes: list[Mesh] = []
    values: dict[str, dict[str, Any]] = {"drive": {}, "load": {}, "planets": {}}
    for statement in _statements(text):
        tokens = statement.split()
        head = tokens[0] if tokens[0] in _STATEMENTS else ""
        arguments = tokens[1:] if head else tokens
        if head in ("drive", "hold", "load") or (not head and all("=" in token for token in tokens)):
            kind = "load" if head == "load" else "drive"
            for token in arguments:
                link, value = (token, "0") if head == "hold" else _pair(token, "=", statement)
                if link in values[kind]:
                    raise GearError("'{statement}': {link} is given twice", statement=statement, link=link)
                values[kind][link] = exact_number(value, f"'{statement}': {link}")
        elif not head and _JOINT.sub("", statement).isspace():
            meshes += _meshes_of_chain(statement)
        else:
            if not head and ":" not in statement:
                known = ", ".join(_STATEMENTS)
                raise GearError(
                    "'{statement}': expected wheels such as sun:24 planet:18, or one of {known}{suggestion}",
                    statement=statement,
                    known=known,
                    suggestion=nearest(tokens[0], _STATEMENTS),
                )
            meshes += _read_meshes(head or "gear", arguments, statement, values["planets"])
    train = Train(meshes)
    for link in (*values["drive"], *values["load"]):
        train.known(link)
    return TrainReading(train, values["drive"], values["load"], values["planets"])


def read_toml(text: str, name: str = "TOML") -> TrainReading:
    r"""Read the TOML form: ``train`` is the text of the meshes (or a list of such); tables drive, load; list hold.

    >>> reading = read_toml('train = ["sun:24 planet:18 ring:-60 on arm"]\nhold = ["ring"]\ndrive.sun = 1000')
    >>> reading.train.mobility, len(reading.drives)
    (2, 2)
    """
    try:
        document = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise GearError("{name}: is not TOML: {error}", name=name, error=error) from None
    known: dict[str, tuple[type, ...]] = {"train": (str, list), "drive": (dict,), "load": (dict,), "hold": (list,)}
    for key, value in document.items():
        if key not in known:
            raise GearError("{name}: no key is called {word!r}: {known}{suggestion}", name=name, **unknown(key, known))
        if not isinstance(value, known[key]):
            raise GearError(
                "{name}: {key} has the wrong form: train is text, drive and load are tables, hold a list",
                name=name,
                key=key,
            )
    train = document.get("train", "")
    statements = [train] if isinstance(train, str) else [str(line) for line in train]
    statements += [f"hold {link}" for link in document.get("hold", [])]
    statements += [
        f"{key} {link}={value}" for key in ("drive", "load") for link, value in document.get(key, {}).items()
    ]
    return read_train("\n".join(statements))


def _statements(text: str) -> Iterator[str]:
    for line in text.splitlines():
        for statement in line.partition("#")[0].split(";"):
            if statement.strip():
                yield " ".join(statement.split())


def _pair(token: str, sign: str, statement: str) -> tuple[str, str]:
    link, separator, value = token.partition(sign)
    if not separator or not link or not value:
        raise GearError(
            "'{statement}': expected LINK{sign}NUMBER, not {word!r}", statement=statement, sign=sign, word=token
        )
    return link, value


def _read_meshes(kind: str, tokens: list[str], statement: str, planets: dict[str, int]) -> Iterator[Mesh]:
    carrier, tokens = _carrier(tokens, statement)
    options = dict(_pair(token, "=", statement) for token in tokens if "=" in token)
    for option in options:
        if option not in _OPTIONS.get(kind, set()):
            raise GearError(
                "'{statement}': {kind} has no option {option!r}", statement=statement, kind=kind, option=option
            )
    wheels = [token for token in tokens if "=" not in token]
    if KINDS[kind].wheels < 2:
        yield _linear(kind, wheels, options, carrier, statement)
        return
    if len(wheels) < 2:
        raise GearError(
            "'{statement}': expected at least two wheels with blanks between, such as sun:24 planet:18",
            statement=statement,
        )
    sized = [
        (link, exact_number(size, f"'{statement}': {link}"))
        for link, size in (_pair(w, ":", statement) for w in wheels)
    ]
    if "planets" in options:
        planets |= dict.fromkeys(
            [link for link, _ in sized[1:-1]] or [sized[-1][0]], _count(options["planets"], statement)
        )
    for k, ((a, size_a), (b, size_b)) in enumerate(pairwise(sized)):
        # Central and planet wheels of a bevel statement alternate; the central wheel is first in its mesh.
        swap = KINDS[kind].crossing and k % 2 == 1
        yield (
            Mesh(a=b, b=a, size_a=size_b, size_b=size_a, carrier=carrier, kind=kind)
            if swap
            else Mesh(a=a, b=b, size_a=size_a, size_b=size_b, carrier=carrier, kind=kind)
        )


def _meshes_of_chain(statement: str) -> Iterator[Mesh]:
    """The gear pairs of an epicyclic train given as a chain, as `enumerate --trains` prints it, with tooth numbers."""
    axes = [set(text.strip().split("-")) for text in _AXIS.findall(statement)]
    for text in map(str.strip, _GEAR.findall(statement)):
        wheels = _WHEELS.fullmatch(text)
        if wheels is None:
            raise GearError(
                "'{statement}': G({text}) has no tooth numbers; give them as in G(1:24-3:18), negative for internal "
                "teeth",
                statement=statement,
                text=text,
            )
        a, teeth_a, b, teeth_b = wheels.groups()
        pairs_of_axes = [(own, other) for own, other in permutations(axes, 2) if a in own and b in other]
        carriers = sorted({link for own, other in pairs_of_axes for link in own & other} - {a, b})
        if len(carriers) != 1:
            raise GearError(
                "'{statement}': G({text}) needs one link that lies on an axis of {a} and on another axis of {b}",
                statement=statement,
                text=text,
                a=a,
                b=b,
            )
        size_a, size_b = (exact_number(size, f"G({text})") for size in (teeth_a, teeth_b))
        yield Mesh(a=a, b=b, size_a=size_a, size_b=size_b, carrier=carriers[0])


def _linear(kind: str, wheels: list[str], options: dict[str, str], carrier: str, statement: str) -> Mesh:
    if len(wheels) != 2 or ":" in wheels[1]:
        raise GearError(
            "'{statement}': expected a wheel and a link that slides, such as 'rack pinion:18 slide'",
            statement=statement,
        )
    quoted = f"'{statement}'"
    numbers = {option: exact_number(value, f"{quoted}: {option}") for option, value in options.items()}
    if not KINDS[kind].wheels:
        if ":" in wheels[0] or "lead" not in numbers:
            raise GearError("{statement}: expected 'screw SPINDLE SLIDE lead=NUMBER'", statement=quoted)
        return Mesh(a=wheels[0], b=wheels[1], size_a=numbers["lead"], size_b=Fraction(1), carrier=carrier, kind=kind)
    link, text = _pair(wheels[0], ":", statement)
    size = exact_number(text, f"{quoted}: {link}")
    if numbers.get("falls", 1) < 1:
        raise GearError("{statement}: at least one rope carries the load", statement=quoted)
    if "pitch" in numbers:
        travel = size * numbers["pitch"] / numbers.get("falls", 1)
        return Mesh(a=link, b=wheels[1], size_a=travel, size_b=Fraction(1), carrier=carrier, kind="rack by pitch")
    return Mesh(
        a=link,
        b=wheels[1],
        size_a=size * numbers.get("module", 2) / 2 / numbers.get("falls", 1),
        size_b=Fraction(1),
        carrier=carrier,
        kind=kind,
    )


def _carrier(tokens: list[str], statement: str) -> tuple[str, list[str]]:
    if "on" not in tokens:
        return FRAME, tokens
    at = tokens.index("on")
    if at + 1 >= len(tokens) or not _NAME.match(tokens[at + 1]):
        raise GearError("'{statement}': expected the name of a carrier after 'on'", statement=statement)
    return tokens[at + 1], tokens[:at] + tokens[at + 2 :]


def _count(text: str, statement: str) -> int:
    if re.fullmatch("[1-9][0-9]{0,3}", text) is None:
        raise GearError(
            "'{statement}': expected a whole number of planets, not {text!r}", statement=statement, text=text
        )
    return int(text)
