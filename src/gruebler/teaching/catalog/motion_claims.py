"""What an entry says of its motion, against what its dimensions give: kinds of motion, travels, dead centres."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, radians
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, Text, in_every_language, message, number, number_separator, numbers, translate
from gruebler.files.catalog_records import Claims, Entry, MotionKind
from gruebler.mechanics.analysis import drive_range
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage

_WORDS: dict[MotionKind, Message] = {
    "turns": message("turns fully"),
    "swings": message("swings"),
    "slides": message("slides"),
    "parallel": message("does not turn"),
}
_ROWS = 73  # every 5 degrees of a turn: wheels that turn 30 times as fast are still followed
_MOST_TURNS = 12  # of the drive, after which wheels in a ratio of small numbers stand as before
_NEAR = 1e-6  # of claimed numbers, relative to 1 or the number


class Disagreement(NamedTuple):
    """A claim on the motion, what it says and what is derived."""

    key: str
    stated: object
    derived: object


def wrong_motions(record: Entry) -> Iterator[Disagreement]:
    """Each claim on the motion of a machine with one drive that its dimensions do not confirm.

    Kinds are those over the range that the entry shows, else over a turn of the drive or all that it can reach: some
    73 poses. Travels and dead centres are those of `measures`, by root finding, over all that the drive can reach.

    >>> from gruebler.teaching.catalog import entry
    >>> list(wrong_motions(entry("vcomp")))
    []
    """
    claims = record.claims
    if not claims.says_motion:
        return
    linkage = record.linkage()
    try:
        if claims.motion:
            yield from _wrong_kinds(record, linkage)
        for link in dict.fromkeys([*claims.travel, *claims.dead_centres]):
            yield from _wrong_measures(record, linkage, link)
    except LinkageError as error:
        yield Disagreement("claims.motion", message("a linkage that moves"), error)


def motion_lines(claims: Claims, lang: str = "en") -> list[str]:
    """What an entry says of its motion, a line for each kind of claim.

    >>> from gruebler.teaching.catalog import entry
    >>> motion_lines(entry("crankrocker").claims)
    ['Stated motion: crank turns fully, rocker swings.', 'Stated travel, in degrees or the unit: rocker 79.8459.']
    """
    separator = number_separator(lang)
    kinds = [f"{link} {_WORDS[kind].in_language(lang)}" for link, kind in claims.motion.items()]
    travels = [f"{link} {number(travel, lang)}" for link, travel in claims.travel.items()]
    centres = [f"{link} {numbers(values, lang)}" for link, values in claims.dead_centres.items()]
    lines = []
    if kinds:
        lines.append(translate("Stated motion: {links}.", lang, links=", ".join(kinds)))
    if travels:
        travel = separator.join(travels)
        lines.append(translate("Stated travel, in degrees or the unit: {links}.", lang, links=travel))
    if centres:
        centre = "; ".join(centres)
        lines.append(translate("Stated dead centres, as values of the drive: {links}.", lang, links=centre))
    return lines


def _wrong_kinds(record: Entry, linkage: Linkage) -> Iterator[Disagreement]:
    values, full = _shown_values(record, linkage)
    moved = move_quietly(linkage, values)
    if not moved.complete:
        yield Disagreement("claims.motion", message("a linkage that moves"), moved.message)
        return
    for link, stated in record.claims.motion.items():
        derived = _kind(moved, link, full)
        if derived != stated:
            yield Disagreement(f"claims.motion.{link}", _WORDS[stated], _WORDS[derived])


def _shown_values(record: Entry, linkage: Linkage) -> tuple[NDArray[np.float64], bool]:
    """Values of the drive over which the machine is shown, and whether they are one full turn."""
    sizes = record.dimensions
    if sizes is not None and sizes.range is not None:
        low, high = sizes.range
        if linkage.mechanism.drives[0].turning:
            low, high = radians(low), radians(high)
        return np.linspace(low, high, _ROWS), False
    reach = drive_range(linkage)
    low, high = (0.0, 2 * np.pi) if reach.full else (reach.lowest, reach.highest)
    return np.linspace(low, high, _ROWS), reach.full


def _kind(moved: Motion, link: str, full: bool) -> MotionKind:
    angle = np.unwrap(moved.angle(link))
    if np.ptp(angle) < 1e-6:
        return "slides" if _slides_on_frame(moved.linkage, link) else "parallel"
    turns = float(angle[-1] - angle[0]) / (2 * np.pi)
    whole = (turns * count for count in range(1, _MOST_TURNS + 1))
    returns = any(abs(each) > 0.5 and abs(each - round(each)) < 1e-6 for each in whole)
    return "turns" if full and returns else "swings"


def _slides_on_frame(linkage: Linkage, link: str) -> bool:
    mechanism = linkage.mechanism
    return any(
        joint.pair.is_sliding and mechanism.frame in joint.links and link in joint.links
        for joint in mechanism.chain.joints
    )


def _wrong_measures(record: Entry, linkage: Linkage, link: str) -> Iterator[Disagreement]:
    claims, measured = record.claims, measures(linkage, output=link)
    travel = measured.travel
    if travel is not None and measured.output.turning:
        travel = degrees(travel)
    if link in claims.travel and (travel is None or not _near(claims.travel[link], travel)):
        derived_travel = () if travel is None else (travel,)
        yield Disagreement(f"claims.travel.{link}", _numbers(claims.travel[link]), _numbers(*derived_travel))
    if link in claims.dead_centres:
        stated = sorted(claims.dead_centres[link])
        factor = degrees(1) if measured.turning_drive else 1.0
        derived = sorted(each.drive * factor for each in measured.dead_centres)
        if len(stated) != len(derived) or not all(map(_near, stated, derived)):
            yield Disagreement(f"claims.dead_centres.{link}", _numbers(*stated), _numbers(*derived))


def _near(stated: float, derived: float) -> bool:
    return abs(stated - derived) <= _NEAR * max(1.0, abs(stated))


def _numbers(*values: float) -> Text | Message:
    return in_every_language(lambda lang: numbers(values, lang, ".9g")) if values else message("none")
