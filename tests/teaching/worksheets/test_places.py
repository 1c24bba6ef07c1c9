"""A machine can be built again from the numbers on its sheet: all of the catalog, from the printed rows alone."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.elements import (
    CamDisc,
    Circle,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
)
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from gruebler.teaching.worksheets import machine_document
from gruebler.teaching.worksheets.blocks import Rows
from gruebler.teaching.worksheets.places import PITCH_RADIUS, SIZES

WITH_SIZES = sorted(id for id, record in entries().items() if record.dimensions is not None)
KEYS = {text.in_language("en"): key for key, text in SIZES.items()} | {PITCH_RADIUS.in_language("en"): "pitch"}
WORDS = re.compile(rf"(?:^|, )({'|'.join(sorted(KEYS, key=len, reverse=True))})(?: |(?=,|$))")


def sizes_of(text):
    """The sizes that a cell prints: by its words, each followed by a number or a law."""
    parts = WORDS.split(text)
    assert not parts[0]
    return {KEYS[word]: value.rstrip(",") for word, value in zip(parts[1::2], parts[2::2], strict=True)}


def element(x, y, angle, text):
    """What a row says; its sizes decide which kind of element it is."""
    sizes = sizes_of(text)
    numbers = {key: float(value) for key, value in sizes.items() if re.fullmatch(r"-?[\d.]+(e[-+]\d+)?", value)}
    if "lift" in sizes:
        return CamDisc(x, y, angle, lift=sizes["lift"], flat="flat" in sizes, **numbers)
    if "transfer" in sizes:
        return NonCircular(x, y, angle, transfer=sizes["transfer"], teeth=int(numbers.get("teeth", 0)))
    if "pins" in sizes or "slots" in sizes:
        driver = GenevaDriver(x, y, angle, int(numbers.get("pins", 1)))
        return driver if "pins" in sizes else GenevaWheel(x, y, angle, slots=int(numbers["slots"]))
    if "pitch" in sizes:
        return Wheel(x, y, numbers["pitch"], teeth=int(numbers.get("teeth", 0)), belt=sizes.get("belt", ""))
    if "radius" in sizes:
        return Circle(x, y, numbers["radius"])
    return Pin(x, y) if angle is None else Line(x, y, angle)


def rebuilt(record, rows):
    """The linkage of the printed rows, on the joints, frame and drives of the entry."""
    chain = record.chain()
    mechanism = Mechanism(chain, record.frame or chain.links[0], record.dimensions.shown_drives or record.drives)
    places, points = {}, {}
    names = [f"{joint.pair.symbol()} {' / '.join(joint.links)}" for joint in chain.joints]
    for name, x, y, angle, text in rows:
        at = float(x), float(y)
        turn = math.radians(float(angle)) if angle else None
        joint, _, link = name.partition(": ")
        if joint not in names:
            point, link = re.fullmatch(r"(.*) \((.*)\)", name).groups()
            points[point] = (link, *at)
        elif link:
            places.setdefault(names.index(joint), {})[link] = element(*at, turn, text)
        else:
            places[names.index(joint)] = at if turn is None else (*at, turn)
    return Linkage.from_drawing(mechanism, places, points=points)


def moved(linkage, start, steps):
    """The places of pins and named points from a position on, over a few steps of all drives."""
    motion = move_quietly(linkage, start + np.outer(steps, np.ones(len(start))))
    assert len(motion) == len(steps), motion.message()
    chain = linkage.mechanism.chain
    found = [motion.complex_point(point) for point in linkage.points.values()]
    for k, joint in enumerate(chain.joints):
        for link in joint.links:
            each = linkage.elements[k, link]
            if each.is_pin:
                turns = motion.turns[:, motion.lower_linkage.mechanism.chain.index(link)]
                places = motion.places[0, :, motion.lower_linkage.mechanism.chain.index(link)]
                found.append(places + turns * complex(each.x, each.y))
    return np.array(found)


@pytest.mark.parametrize("id", WITH_SIZES)
def test_a_sheet_is_enough_to_build_the_machine_again(id):
    record = entries()[id]
    document = machine_document(record)
    (rows,) = [block.rows for block in document.blocks if isinstance(block, Rows) and block.headers[1:3] == ("x", "y")]
    original, copy = record.linkage(), rebuilt(record, rows)
    between = record.dimensions.range
    if between is not None and original.mechanism.drives[0].turning:
        between = tuple(math.radians(value) for value in between)
    start = posed_linkage(original, between=between).pose.drives[0]
    again = posed_linkage(copy).pose.drives[0]
    steps = np.linspace(0, 0.05, 3) * (1 if original.mechanism.drives[0].turning else original.size / 10)
    one, other = moved(original, start, steps), moved(copy, again, steps)
    assert np.abs(one - other).max() < 2e-4 * original.size
