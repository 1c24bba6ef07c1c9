"""`gruebler gears`: speeds, ratios, torques and power of a gear train."""

from __future__ import annotations

import argparse
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import LANGUAGES, message, translate
from gruebler.cli.link_names import language_of_names
from gruebler.cli.machine_pictures import add_picture_options, is_few, is_printed, write_machine_picture
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table, print_text
from gruebler.files.text_files import read_text
from gruebler.machines.gears import (
    Balance,
    Speeds,
    TrainReading,
    Unit,
    assembly,
    balance,
    read_toml,
    read_train,
    search_ratio,
    speeds,
)
from gruebler.machines.gears.assemblies import axes
from gruebler.machines.gears.messages import fraction_text, writable
from gruebler.machines.gears.train import exact_number

_DRAWN = "drawn"
_POWER = message(
    "Power is torque times speed times 2π/60: in W for torques in N m, forces in N, lengths in m, speeds in 1/min."
)
_UNITS = {
    Unit.TURNING: message("{link}"),
    Unit.PER_RADIAN: message("{link} (length, speeds per radian)"),
    Unit.PER_TURN: message("{link} (length, speeds per turn)"),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Exact speeds of all links of a gear train from one linear system (Willis), torques by virtual "
        "work. A wheel is LINK:TEETH (or a radius), negative for internal teeth; wheels in a row mesh in turn; 'on "
        "ARM' names the carrier of their axes. Other kinds: belt, chain, crossed, friction, bevel, rack, screw, "
        "winch. Then drive LINK=SPEED, hold LINK, load LINK=TORQUE; planets=N asks whether N planets can be "
        "assembled.",
        epilog="Example: gruebler gears 'sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1000; "
        "load arm=-50'; with -o train.html --animate --teeth it moves; gruebler gears search --ratio 4.2 --teeth 17-90 "
        "finds tooth numbers. Exit status: 0 determined (or nothing driven), "
        "1 undetermined, contradictory or impossible to assemble, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        train TRAIN|FILE|search  a text, a file of statements (.txt), a table (.toml) or a machine of the catalog, also
            in place of the wheels of a text; search: tooth numbers for --ratio
        --ratio I  search: speed of the driving shaft divided by that of the driven one
        --planets N int  search: number of planets (default: 3)
        --number K int  search: how many trains are listed (default: 10)
        """
    )
    parser.add_printed(help="print an object; numbers as exact fractions and decimals", pictures=True)
    parser.take(
        """
        --teeth A-B ? :drawn  with -o: involute teeth instead of pitch circles; search: fewest and most teeth (default:
            17-90)
        """
    )
    add_picture_options(parser, help="with --animate: seconds for a turn of the fastest link (default: 4)")


def run(arguments: argparse.Namespace) -> int:
    """Print what the train does; 1 if something stays undetermined, is contradicted, or cannot be assembled."""
    if arguments.train == "search":
        return _search(arguments)
    for option in ("ratio", "planets", "number"):
        if getattr(arguments, option) is not None:
            raise GrueblerError("--{option} goes with gears search", option=option)
    if arguments.teeth not in (None, _DRAWN):
        raise GrueblerError("--teeth {range} goes with gears search; --teeth alone draws teeth", range=arguments.teeth)
    reading = _read(arguments.train, language_of_names(arguments))
    solution = speeds(reading.train, reading.drives)
    forces = balance(reading.train, reading.drives, reading.loads) if reading.loads else None
    possible = all(assembly(reading.train, planet, count).possible for planet, count in reading.planets.items())
    _picture(arguments, reading)
    if arguments.json:
        print_json(_document(reading, solution, forces))
    else:
        print_text(reading.explain(arguments.lang))
        if reading.drives:
            print()
            _print_speeds(reading, solution, forces, arguments.lang)
    return int((bool(reading.drives) and not solution.complete) or not possible)


def _search(arguments: argparse.Namespace) -> int:
    """Print the trains with the wanted ratio; 1 if no train can be assembled."""
    if arguments.ratio is None:
        raise GrueblerError("gears search: give the ratio, as in --ratio 4.2 or --ratio=-7/2")
    if not is_printed(arguments.out) or arguments.teeth == _DRAWN:
        raise GrueblerError("gears search lists trains; draw one of them with gears TRAIN -o FILE")
    low, high = _teeth(arguments.teeth or "17-90")
    designs = search_ratio(
        exact_number(arguments.ratio, "--ratio"),
        (low, high),
        planets=3 if arguments.planets is None else arguments.planets,
        number=10 if arguments.number is None else arguments.number,
    )
    if arguments.json:
        print_json(plain([*designs], "text driving driven held planets size ratio", units={"ratio": _value}))
        return int(not designs)
    if not designs:
        print_text(translate("No train with these tooth numbers can be assembled.", arguments.lang))
        return 1
    rows: list[list[Cell]] = [
        [fraction_text(design.ratio, arguments.lang), str(design.size), design.text] for design in designs
    ]
    header = (message("ratio"), message("diameter in modules"), message("train"))
    print_table(header, rows, numbers=(1,), lang=arguments.lang)
    return 0


def _teeth(text: str) -> tuple[int, int]:
    low, dash, high = text.partition("-")
    if not (dash and low.isdigit() and high.isdigit() and len(text) < 12):
        raise GrueblerError("--teeth {range!r}: expected two numbers such as 17-90", range=text[:40])
    return int(low), int(high)


_FEW = 6  # turns of the fastest link in a file of pictures


def _picture(arguments: argparse.Namespace, reading: TrainReading) -> None:
    from gruebler.pictures.machines.train_picture import TrainPictureOptions, animate_train, draw_train

    options = TrainPictureOptions(planets=reading.planets, teeth=arguments.teeth == _DRAWN, lang=arguments.lang)
    most = {"most": _FEW} if is_few(arguments) else {}
    write_machine_picture(
        arguments,
        lambda: draw_train(reading.train, **options),
        lambda seconds: animate_train(reading.train, reading.drives, seconds=seconds, **most, **options),
    )


def _read(word: str, lang: str) -> TrainReading:
    path = Path(word)
    if (known := _of_the_catalog(word, lang)) is not None:
        return known
    if "\n" in word or ";" in word or ":" in word or path.suffix not in (".toml", ".txt"):
        return read_train(word)
    text = read_text(path)
    return read_toml(text, word) if path.suffix == ".toml" else read_train(text)


def _of_the_catalog(word: str, lang: str) -> TrainReading | None:
    """The train of a machine of the catalog, named in place of its wheels; None where the word begins otherwise.

    Links have their names in the language, without blanks; the statements behind may name them in any language.
    """
    from gruebler.teaching.catalog import entries, entry

    first, _, others = word.partition(";")
    if first.strip() not in entries():
        return None
    from gruebler.mechanics.linkages import train_of
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.mechanics.screws.wheels import bevel_train

    record = entry(first.strip())
    if record.dimensions is None and isinstance(placed := record.placed(), SpatialLinkage):
        train = bevel_train(placed)
    else:
        train = train_of(record.linkage())
    meshes = "; ".join(str(mesh) for mesh in train.meshes)
    spelled = {each: [re.sub(r"\W", "", link) for link in record.in_language(each).chain().links] for each in LANGUAGES}
    names = {name: new for each in spelled.values() for name, new in zip(each, spelled[lang], strict=True)}
    text = f"{meshes}; {others}" if others.strip() else meshes
    return read_train(re.sub(r"[^\W\d]\w*", lambda match: names.get(match[0], match[0]), text))


def _driver(reading: TrainReading) -> str | None:
    """The one drive that moves, if there is exactly one."""
    moving = [link for link, speed in reading.drives.items() if speed]
    return moving[0] if len(moving) == 1 else None


def _print_speeds(reading: TrainReading, solution: Speeds, forces: Balance | None, lang: str) -> None:
    driver = _driver(reading)
    units = reading.train.units()
    torques, powers = (forces.torques, forces.watts) if forces else ({}, {})
    rows = []
    for link, speed in solution.values.items():
        ratio = speed / reading.drives[driver] if driver and speed is not None else None
        speed_text = "?" if speed is None else fraction_text(speed, lang)
        cells: list[Cell] = [_UNITS[units[link]].filled(link=link), speed_text]
        values = (ratio, torques.get(link), powers.get(link))
        cells += ["" if value is None else fraction_text(value, lang) for value in values]
        rows.append(cells)
    speed_title = message("speed in 1/min") if forces else message("speed")
    headers: list[Cell] = [message("link"), speed_title, message("per turn of {drive}", drive=driver)]
    headers += [message("torque in N m, force in N"), message("power in W")]
    shown = [k for k, wanted in enumerate((True, True, driver, forces, forces)) if wanted]
    chosen = [[row[k] for k in shown] for row in (headers, *rows)]
    print_table(chosen[0], chosen[1:], numbers=range(1, len(shown)), lang=lang)
    if forces:
        print()
        print_text(_POWER.in_language(lang))


def _document(reading: TrainReading, solution: Speeds, forces: Balance | None) -> dict[str, Any]:
    train, units = reading.train, reading.train.units()
    document: dict[str, Any] = {
        "meshes": [str(mesh) for mesh in train.meshes],
        "mobility": train.mobility,
        "redundant": [str(mesh) for mesh in train.redundant],
        "complete": solution.complete,
        "links": [
            {"link": link, "unit": units[link].value, "speed": _value(solution.values[link])} for link in train.links
        ],
        "contradictions": plain(
            [*solution.contradictions], "link wanted follows", units={"wanted": _value, "follows": _value}
        ),
        "spare": list(solution.spare),
    }
    if forces:
        document["torques"] = {link: _value(value) for link, value in forces.torques.items()}
        document["powers_w"] = forces.watts
        document["units"] = {"speed": "1/min", "torque": "N m", "force": "N", "length": "m", "power": "W"}
    document["axes"] = [
        {
            "planet": axis.planet,
            "carrier": axis.carrier,
            "wheels": [mesh.b for mesh in axis.meshes],
            "coaxial": axis.coaxial,
        }
        | {"distances_in_half_modules": [_value(distance) for distance in axis.distances]}
        for axis in axes(train)
    ]
    if reading.planets:
        tested = [assembly(train, planet, count) for planet, count in reading.planets.items()]
        document["assembly"] = [
            plain(axis, "planet number coaxial evenly clear possible") | {"spacing_turns": _value(axis.spacing)}
            for axis in tested
        ]
    return document


def _value(value: Fraction | float | None) -> dict[str, Any] | None:
    """Both the exact text and a number; neither where there are too many digits for it."""
    if value is None:
        return None
    try:
        plain: float | None = float(value)
    except OverflowError:
        plain = None
    return {"exact": str(value) if isinstance(value, Fraction) and writable(value) else None, "value": plain}
