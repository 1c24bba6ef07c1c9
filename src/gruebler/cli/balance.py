"""`gruebler balance`: counterweights, counter-rotating shafts, springs and flywheels for a linkage with masses."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import Shown, plain
from gruebler.base.text import message, number, translate
from gruebler.cli.drive_rows import given_speeds, turning_drives
from gruebler.cli.driven_motion import driven_motion
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import add_loaded, loaded_linkage
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.mechanics.dynamics.balancing import Counterweight, ForceBalance, balance_forces
from gruebler.mechanics.dynamics.flywheels import flywheel
from gruebler.mechanics.dynamics.inverse import inverse_dynamics
from gruebler.mechanics.dynamics.partial_balance import PartialBalance, balance_partly, shaking_harmonics
from gruebler.mechanics.dynamics.spring_balance import SpringFit, balance_weights, fit_springs
from gruebler.mechanics.forces import Loads, Spring
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage

_PRODUCT = message("{link}: mass times radius {product:n} kg·{unit} at {angle:n}° on the link")
_LARGEST = message("Largest shaking force: {before:n} N without, {after:n} N with them.")
_SPRING = message("from {first} to {second}: {stiffness:n} N/{unit}")
_EFFORT = message(
    "Effort of the drives in {effort}: without springs root mean square {mean_before:n}, largest {largest_before:n}; "
    "with them {mean_after:n} and {largest_after:n}."
)
_FLYWHEEL = message(
    "Flywheel on the drive: moment of inertia {inertia:n} kg·{unit}²; mean torque of the drive {torque:n} N·{unit}."
)

_ROWS = 360
_HIGHEST = 4
_ROUNDING = 1e-12  # of the largest force, or of a product


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Counterweights with which the forces of inertia of a linkage balance each other in every motion, "
        "or why there are none. Further: the best counterweights where a complete balance is impossible or too heavy, "
        "shaking forces by multiples of the speed, springs that hold the weights, a flywheel. Masses and loads stand "
        "in the table [loads] of the file or the catalog entry.",
        epilog="Examples: gruebler balance wiper; gruebler balance compressor --partly crank; gruebler balance "
        "press.toml --speed 60 --irregularity 0.02. Exit status: 0 success, 1 a complete balance is impossible, 2 "
        "wrong usage or unreadable input.",
    )
    add_loaded(parser)
    parser.take(
        """
        --on LINK ...  a link that carries a counterweight; repeatable (default: as few as are needed)
        --radius R float  distance of the counterweights from the pins of their links, in the linkage's unit
        --partly LINK ...  only the best counterweights on this link, which is pinned to the frame; repeatable
        --minimax  with --partly or --fit-springs the least largest force or effort, in place of the least mean square
        --springs HEIGHT float  also springs of free length 0 that hold the weights, hung HEIGHT above the pins
        --fit-springs  also the stiffnesses with which the springs of the loads leave the drives the least effort; their
            places, free lengths and preloads stay
        --range FROM:TO:STEP ...  with --fit-springs drive values that count, in degrees or the unit, once per drive
            and in all combinations (default: a full turn, or the whole range)
        --irregularity D float  also the flywheel with which the speed varies by no more than D of its mean
        --speed N float  speed of the drive in rpm (default: that of the loads)
        --branch
        """
    )
    parser.add_printed(help="print an object with counterweights and what else was asked for")


def run(arguments: argparse.Namespace) -> int:
    """The balance that was asked for; 1 if it is impossible."""
    linkage, loads, usual, shown = loaded_linkage(arguments.linkage, language_of_names(arguments))
    lang = arguments.lang
    if arguments.minimax and not (arguments.partly or arguments.fit_springs):
        raise GrueblerError("--minimax needs --partly or --fit-springs")
    if arguments.range and not arguments.fit_springs:
        raise GrueblerError("--range needs --fit-springs")
    if arguments.partly and (arguments.on or arguments.radius is not None):
        raise GrueblerError("--partly has its own links and no radius: leave out --on and --radius")
    document: dict[str, Any] = {}
    if arguments.partly:
        forces = inverse_dynamics(_turn(linkage, _speed(arguments, linkage, usual), arguments.branch), loads)
        document |= _part_document(
            balance_partly(forces, arguments.partly, minimax=arguments.minimax), shaking_harmonics(forces, _HIGHEST)
        )
    else:
        document |= _balance_document(balance_forces(linkage, loads, on=arguments.on or None, radius=arguments.radius))
    if arguments.springs is not None:
        document["springs"] = [
            _spring(each, linkage) for each in balance_weights(linkage, loads, height=arguments.springs)
        ]
    if arguments.fit_springs:
        motion = driven_motion(linkage, shown, spans=arguments.range, branch=arguments.branch, grid=True)
        fit = _fit(motion, loads, minimax=arguments.minimax)
        document["fitted"] = _fit_document(fit, linkage)
    if arguments.irregularity is not None:
        motion = _turn(linkage, _speed(arguments, linkage, usual), arguments.branch, closed=True)
        document["flywheel"] = plain(flywheel(motion, loads, arguments.irregularity))
    if arguments.json:
        print_json(document | ({} if arguments.partly else {"message": document["message"].explain(lang)}))
    else:
        _print(document, linkage, lang)
    return 0 if document.get("possible", True) else 1


def _speed(arguments: argparse.Namespace, linkage: Linkage, usual: float | None) -> float:
    given = given_speeds([arguments.speed] if arguments.speed is not None else [], turning_drives(linkage))
    if not given and usual is None:
        raise GrueblerError("--speed is missing: the forces of inertia grow with its square")
    return given[0] if given else float(usual or 0.0)


def _turn(linkage: Linkage, speed: float, branch: str | None, *, closed: bool = False) -> Motion:
    """A full turn of the drive at even speed."""
    if turning_drives(linkage) != [True]:
        raise GrueblerError("this needs one drive that turns")
    rows = np.linspace(0, 2 * math.pi, _ROWS + 1)
    motion = move_quietly(linkage, rows if closed else rows[:-1], branch=branch, speed=speed, order=2)
    if not motion.complete:
        raise GrueblerError("the drive does not turn fully, so that its speed cannot be even")
    return motion


def _fit(motion: Motion, loads: Loads, *, minimax: bool) -> SpringFit:
    """The springs of the loads, but for gas springs and dampers, fitted to hold what else acts."""
    if not motion.complete:
        raise GrueblerError("the drives do not reach all values of --range")
    fitted = tuple(s for s in loads.springs if s.law is None and (s.stiffness or s.preload or not s.damping))
    if not fitted:
        raise GrueblerError(
            "--fit-springs: the loads have no spring; {example} gives one its places",
            example='[[loads.springs]] between = ["frame:0,40", "crank:10,0"]',
        )
    others = tuple(spring for spring in loads.springs if spring not in fitted)
    return fit_springs(motion, replace(loads, springs=others), fitted, minimax=minimax)


# --- output ----------------------------------------------------------------------------------------


def _balance_document(balance: ForceBalance) -> dict[str, Any]:
    shown: Shown = {Counterweight: "link mass place product"}
    return {**plain(balance, "possible blocked counterweights", shown=shown), "message": balance}


def _part_document(part: PartialBalance, harmonics: Complexes) -> dict[str, Any]:
    before, after = part.largest
    parts = np.array([harmonics.real, harmonics.imag])
    exact = np.where(np.abs(parts) < _ROUNDING * before, 0.0, parts)
    return {
        **plain(part, "products"),
        "largest_before": before,
        "largest_after": after,
        **plain(part, "bound"),
        "harmonics": {str(k - _HIGHEST): pair for k, pair in enumerate(exact.T.tolist())},
    }


def _spring(spring: Spring, linkage: Linkage) -> dict[str, Any]:
    ends = [linkage.points_named(end)[0] for end in spring.between]
    places = [{"link": end.link, "place": [end.x, end.y]} for end in ends]
    return {"between": places, **plain(spring, "stiffness free_length")}


def _fit_document(fit: SpringFit, linkage: Linkage) -> dict[str, Any]:
    sizes: dict[str, float] = {}
    none = _ROUNDING * np.abs(fit.before).max()
    for name, effort in (("before", fit.before), ("after", fit.after)):
        exact = np.where(np.abs(effort) < none, 0.0, effort)
        sizes |= {f"mean_{name}": math.sqrt((exact**2).mean()), f"largest_{name}": float(np.abs(exact).max())}
    return {"springs": [_spring(each, linkage) for each in fit.springs], **sizes, **plain(fit, "bound")}


def _print(document: dict[str, Any], linkage: Linkage, lang: str) -> None:
    unit = linkage.unit
    if "message" in document:
        print_text(document["message"].explain(lang))
    else:
        _print_part(document, unit, lang)
    if "springs" in document:
        print()
        print(translate("Springs of free length 0 that hold the weights in every position:", lang))
        _print_springs(document["springs"], unit, lang)
    if "fitted" in document:
        print()
        print(translate("Stiffnesses with which the springs of the loads leave the drives the least effort:", lang))
        _print_springs(document["fitted"]["springs"], unit, lang)
        effort = f"N·{unit}" if turning_drives(linkage)[0] else "N"
        print(_EFFORT.filled(**document["fitted"], effort=effort).in_language(lang))
        if all(
            document["fitted"][f"{size}_after"] > document["fitted"][f"{size}_before"] for size in ("mean", "largest")
        ):
            print(translate("They are no help at any stiffness: their preloads alone load the drive more.", lang))
    if "flywheel" in document:
        print()
        print(_FLYWHEEL.filled(**document["flywheel"], unit=unit).in_language(lang))


def _print_springs(springs: list[dict[str, Any]], unit: str, lang: str) -> None:
    for each in springs:
        first, second = (
            f"{end['link']}:{','.join(number(x, form='n') for x in end['place'])}" for end in each["between"]
        )
        text = _SPRING.filled(first=first, second=second, stiffness=each["stiffness"], unit=unit)
        print(text.in_language(lang))


def _print_part(document: dict[str, Any], unit: str, lang: str) -> None:
    for link, (x, y) in document["products"].items():
        size = math.hypot(x, y)
        angle = math.degrees(math.atan2(0.0 if abs(y) < _ROUNDING * size else y, x))
        print(_PRODUCT.filled(link=link, product=size, unit=unit, angle=angle).in_language(lang))
    before, after = document["largest_before"], document["largest_after"]
    print(_LARGEST.filled(before=before, after=after).in_language(lang))
    print()
    print(translate("Shaking force without them, as forces that turn with multiples of the speed:", lang))
    rows = [
        [n, *(number(value, lang, "n") for value in (x, y, math.hypot(x, y)))]
        for n, (x, y) in document["harmonics"].items()
    ]
    print_table([translate("multiple", lang), "x [N]", "y [N]", translate("size [N]", lang)], rows, numbers=range(4))
