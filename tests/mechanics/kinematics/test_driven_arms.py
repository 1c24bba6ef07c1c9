"""Actuators whose length comes through zero or its least value, against closed forms; and no jump in any motion.

The pivot of the actuator lies at the distance h from a straight guide on which its end slides. With the pin of the
rod at the distance p beside the actuator's axis and the drive s, the way along the guide is w = ±√(s² + p² - h²), and
the barrel is turned by the angle of (w, h) minus that of (s, p).
"""

import warnings
from math import hypot, sqrt
from pathlib import Path

import numpy as np
import pytest

from gruebler.files import values as files
from gruebler.files.drawing_linkages import linkage_of_drawing
from gruebler.files.pin_drawings import DrawnDrive, DrawnJoint, PinDrawing
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Line, Linkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.teaching.catalog import entries

FOLDER = Path(__file__).parents[2] / "files" / "samples"


def ram(h, p, s):
    """Drawn at s > 0, the guide along the x axis at the height h, the pivot in the origin."""
    w = sqrt(s**2 + p**2 - h**2)
    angle = np.angle(complex(w, h) / complex(s, p))
    chain = Chain(
        [
            ("prismatic", ["barrel", "rod"]),
            ("revolute", ["frame", "barrel"]),
            ("revolute", ["rod", "block"]),
            ("prismatic", ["frame", "block"]),
        ]
    )
    mechanism = Mechanism(chain, "frame", [Drive(0, "Tx", ("barrel", "rod"))])
    elements = {
        "frame": {1: (0.0, 0.0), 3: Line(0.0, h, 0.0)},
        "barrel": {0: Line(0.0, 0.0, 0.0), 1: (0.0, 0.0)},
        "rod": {0: Line(0.0, 0.0, 0.0), 2: (0.0, p)},
        "block": {2: (0.0, 0.0), 3: Line(0.0, 0.0, 0.0)},
    }
    along = np.exp(1j * angle)
    pose = {
        "frame": (0.0, 0.0, 0.0),
        "barrel": (0.0, 0.0, angle),
        "rod": ((s * along).real, (s * along).imag, angle),
        "block": (w, h, 0.0),
    }
    return Linkage(mechanism, elements, reference_pose=pose)


WAYS = {
    "in steps": np.linspace(2, -2, 41),  # 0 is a row
    "past zero": np.linspace(2, -2, 40),
    "near zero": np.array([2, 1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0, -1e-15, -1e-12, -1e-9, -1e-6, -1e-3, -1, -2]),
    "begun in zero": np.linspace(0, -2, 9),
    "there and back": np.concatenate([np.linspace(2, -1, 31), np.linspace(-1, 2, 31)[1:]]),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("distance", [0.0, 0.3])
def test_an_actuator_comes_through_the_length_zero(way, distance):
    """h = p: the way is s on both sides, and the barrel does not turn."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = move(ram(distance, distance, 2.0), WAYS[way], speed=1)
    assert motion.complete
    block, barrel = motion.link_index("block"), motion.link_index("barrel")
    np.testing.assert_allclose(motion.places[0, :, block], WAYS[way] + 1j * distance, atol=1e-9)
    np.testing.assert_allclose(motion.turns[:, barrel], 1, atol=1e-9)
    np.testing.assert_allclose(motion.rates[0][:, barrel], 0, atol=1e-7)
    np.testing.assert_allclose(motion.places[1, :, block], 1, atol=1e-7)


@pytest.mark.parametrize(("h", "p"), [(0.0, 0.5), (0.2, 0.5), (0.3, 0.3001), (0.0, 1e-3)])
def test_an_actuator_that_stays_long_enough_brings_its_pin_back(h, p):
    """p > h: the way has its least value √(p² - h²) at s = 0, and goes back; the barrel turns fast."""
    s = np.linspace(2, -2, 401)
    motion = move(ram(h, p, 2.0), s)
    assert motion.complete
    w = np.sqrt(s**2 + p**2 - h**2)
    np.testing.assert_allclose(motion.places[0, :, motion.link_index("block")], w + 1j * h, atol=1e-9)
    turn = (w + 1j * h) / np.abs(w + 1j * h) * np.conj(s + 1j * p) / np.abs(s + 1j * p)
    np.testing.assert_allclose(motion.turns[:, motion.link_index("barrel")], turn, atol=1e-9)


@pytest.mark.parametrize(("h", "p"), [(0.5, 0.0), (0.5, 0.3), (0.3, 0.2999), (1e-3, 0.0)])
@pytest.mark.parametrize("rows", [3, 41, 400])
def test_an_actuator_that_is_too_short_stops(h, p, rows):
    """p < h: the guide is out of reach where s² < h² - p²."""
    motion = move(ram(h, p, 2.0), np.linspace(2, -2, rows))
    assert motion.stop is not None
    assert motion.stop.reason == "limit"
    assert motion.stop.drives[0] == pytest.approx(sqrt(h**2 - p**2), abs=1e-9)


def scissors(units, arm):
    """Scissors of equal arms over a guide, pushed by an actuator along the guide; drawn at s = arm."""
    s, height = arm, sqrt(4 * arm**2 - arm**2)
    joints = [DrawnJoint(name="0", x=0.0, y=0.0, links=("frame", "left 0", "barrel"))]
    joints += [DrawnJoint(name="slide", x=s, y=0.0, links=("frame", "right 0", "rod"), slot=0.0)]
    joints += [DrawnJoint(name="push", x=s, y=0.0, links=("barrel", "rod"), slot=0.0, turns=False)]
    for k in range(units):
        y = k * height
        joints.append(DrawnJoint(name=f"middle {k}", x=s / 2, y=y + height / 2, links=(f"left {k}", f"right {k}")))
        ends = ("left", "right") if k + 1 < units else ()
        for side, x, below in (("left", s, "left"), ("right", 0.0, "right")):
            above = {"left": "right", "right": "left"}[side]
            links = (f"{below} {k}", f"{above} {k + 1}") if ends else (f"{below} {k}",)
            joints.append(DrawnJoint(name=f"top {side} {k}", x=x, y=y + height, links=links))
    drive = DrawnDrive("push", "barrel", "rod")
    return linkage_of_drawing(PinDrawing(frame="frame", joints=tuple(joints), drives=(drive,), unit="mm"), [])


@pytest.mark.parametrize("units", [1, 2, 5])
def test_scissors_go_through_their_longest_position(units):
    """At a distance s of their feet each unit is √(4 a² - s²) high: a smooth motion from -2a to 2a."""
    arm = 41.23
    linkage = scissors(units, arm)
    s = np.concatenate([[arm], np.linspace(1.9 * arm, -1.9 * arm, 77), [0.0]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = move(linkage, s)
        found = measures(linkage)
    assert motion.complete
    np.testing.assert_allclose(
        motion.complex_point(f"top right {units - 1}"), 1j * units * np.sqrt(4 * arm**2 - s**2), atol=1e-8 * arm
    )
    assert (found.span.low, found.span.high) == pytest.approx((-2 * arm, 2 * arm), rel=1e-9)


def test_the_scissors_of_linkage_have_one_range():
    """Feet 160 apart, bars √(160² + 40²) long, in 1/96 inch: the range that is said is that which can be moved."""
    linkage = files.read(FOLDER / "scissors.linkage2", left_out=[])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = measures(linkage)
        lines = found.explain().splitlines()
        rows = found.span.high * np.linspace(-0.999, 0.999, 101)
        motion = move(linkage, rows, speed=1)
    assert (found.span.low, found.span.high) == pytest.approx(np.array([-1, 1]) * hypot(160, 40) * 25.4 / 96, rel=1e-9)
    assert motion.complete
    assert np.isfinite(motion.rates).all()
    assert sum(" at 0 mm." in line for line in lines) == 6
    assert not any("e-1" in line for line in lines)


LINKAGES = {path.name: files.read(path, left_out=[]) for path in sorted(FOLDER.iterdir()) if path.suffix != ".md"} | {
    name: each.linkage() for name, each in entries().items() if each.dimensions is not None
}
DRIVEN = [name for name, linkage in LINKAGES.items() if len(linkage.mechanism.drives) == 1]


@pytest.mark.parametrize("name", DRIVEN)
def test_the_range_that_is_said_is_moved_without_a_jump(name):
    """The whole of it from the start both ways, and between two rows no link turns more than its rates say."""
    linkage = LINKAGES[name]
    cycle = drive_cycle(linkage)
    part = np.linspace(1e-3, 1 - 1e-3, 301)
    rows = cycle.span.low + cycle.span.width * (part if cycle.span.full else np.sin(np.pi / 2 * part) ** 2)
    start = int(np.abs(rows - cycle.start.drives[0, 0]).argmin())
    branch = cycle.start.branch if linkage.reference_pose is None else None
    for way in (rows[start:], rows[start::-1]):
        motion = move(linkage, np.concatenate([cycle.start.drives[0], way]), speed=1.0, branch=branch)
        assert motion.complete, motion.reason
        turned = np.abs(np.angle(motion.turns[1:] * np.conj(motion.turns[:-1])))
        rates = np.where(np.isfinite(motion.rates[0]), np.abs(motion.rates[0]), np.inf)
        allowed = 0.1 + 3 * np.maximum(rates[1:], rates[:-1]) * np.abs(np.diff(motion.drives, axis=0))
        assert (turned <= allowed).all()
