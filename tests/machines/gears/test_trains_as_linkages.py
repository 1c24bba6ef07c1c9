"""Trains as linkages with wheels: the general solver moves them as the rational arithmetic of trains says."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.machines.gears import Train, Unit, read_train, speeds
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, linkage_of_train, train_of

TEETH = st.integers(12, 90)


@st.composite
def trains(draw: st.DrawFn) -> Train:
    """Stages in a row: pairs on the frame, planets on carriers with a ring that is held or free, racks at the end."""
    text, last = [], "s"
    for k in range(draw(st.integers(1, 4))):
        a, b, new = draw(TEETH), draw(TEETH), f"x{k}"
        kind = draw(st.sampled_from(["gear", "friction", "belt", "chain", "crossed", "internal", "planets", "two"]))
        if kind == "planets":
            ring = draw(st.sampled_from([f"ring{k}", "frame"]))
            text.append(f"{last}:{a} p{k}:{b} {ring}:-{a + 2 * b + draw(st.integers(0, 3))} on {new}")
        elif kind == "two":  # two planets, one after another, and a second sun
            text.append(f"{last}:{a} p{k}:{b} q{k}:{draw(TEETH)} sun{k}:{draw(TEETH)} on {new}")
        elif kind == "internal":
            text.append(f"{last}:{a} {new}:-{a + b}")
        elif kind == "friction":
            text.append(f"friction {last}:{a}.5 {new}:{b}.25")
        else:
            text.append(f"{kind} {last}:{a} {new}:{b}")
        last = new
    if draw(st.booleans()):
        text.append(f"rack {last}:{draw(TEETH)} slide")
    return read_train("; ".join(text)).train


def independent_drives(train: Train) -> list[str] | None:
    """Links that the frame bears and that determine all others."""
    links = [link for link in train.links if link[0] not in "pq"]
    chosen: list[str] = []
    for link in links:
        held = speeds(train, dict.fromkeys([*chosen, link], 0))
        if not held.spare and not held.contradictions:
            chosen.append(link)
    return chosen if len(chosen) == train.mobility else None


def check(linkage: Linkage, train: Train, drives: list[str], rates: dict[str, int]) -> None:
    expected = speeds(train, rates).values
    start = np.array([0.0 if d == "slide" else linkage.required_pose[d].angle for d in drives])
    order = [linkage.mechanism.drives[k].between[1] for k in range(len(drives))]
    values = np.array([float(rates[link]) for link in order])
    begin = np.array([start[drives.index(link)] for link in order])
    motion = move(linkage, begin + np.linspace(0, 0.2, 4)[:, None] * values, speed=[values.tolist()], order=1)
    assert motion.complete
    assert motion.closure_error < 1e-9
    largest = max(abs(float(value)) for value in expected.values())
    for link, unit in train.units().items():
        if unit == Unit.TURNING:
            found = motion.angular(link)
        else:
            found = motion.displacement(f"P(frame-{link})", order=1) * (2 * np.pi if unit == Unit.PER_TURN else 1)
        assert found == pytest.approx(float(expected[link]), rel=1e-9, abs=1e-9 * largest)


@settings(max_examples=40, deadline=None)
@given(trains(), st.data())
def test_the_solver_moves_a_train_with_its_speeds(train: Train, data: st.DataObject) -> None:
    drives = independent_drives(train)
    assert drives is not None
    linkage = linkage_of_train(train, drives)
    rates = {link: data.draw(st.integers(-3, 3).filter(bool), label=link) for link in drives}
    check(linkage, train, drives, rates)


@settings(max_examples=40, deadline=None)
@given(trains(), st.data())
def test_there_and_back_the_speeds_are_the_same(train: Train, data: st.DataObject) -> None:
    drives = independent_drives(train)
    assert drives is not None
    again = train_of(linkage_of_train(train, drives))
    rates = {link: data.draw(st.integers(-9, 9), label=link) for link in drives}
    before, after = speeds(train, rates).values, speeds(again, rates).values
    assert {link: float(value) for link, value in after.items()} == pytest.approx(
        {link: float(value) for link, value in before.items()}, rel=1e-12, abs=1e-12
    )
    if all(mesh.kind == "gear" for mesh in train.meshes):
        assert again == train


SINGLE = [
    ("rack pinion:18 frame on car; rack pinion:-18 slide on car", ["car"], {"car": 2}),
    ("rack pinion:18 slide module=2", ["slide"], {"slide": 3}),
    ("rack pinion:18 slide pitch=6", ["pinion"], {"pinion": 1}),
    ("sun:24 p:18 ring:-60 on arm; sun:24 q:18 ring:-60 on arm", ["sun", "ring"], {"sun": 7, "ring": -2}),
    (
        "in:20 sun:40; in2:21 ring:63; sun:20 p:30 ring:-80 on c; c:20 q:30 ring2:-80 on d",
        ["in", "in2", "d"],
        {"in": 1, "in2": 2, "d": 3},
    ),
    ("sun:24 p:17 ring:-60 on arm", ["sun", "arm"], {"sun": 1, "arm": 3}),
    ("sum:20 lay:40; other:30 lay:60; sum:20 p:20 other:-60 on arm", ["lay"], {"lay": 3}),
]


@pytest.mark.parametrize(("text", "drives", "rates"), SINGLE)
def test_single_trains(text: str, drives: list[str], rates: dict[str, int]) -> None:
    train = read_train(text).train
    linkage = linkage_of_train(train, drives)
    check(linkage, train, drives, rates)


@pytest.mark.parametrize(("text", "drives", "rates"), [row for row in SINGLE if "pitch" not in row[0]])
def test_single_trains_come_back(text: str, drives: list[str], rates: dict[str, int]) -> None:
    train = read_train(text).train
    back = train_of(linkage_of_train(train, drives))
    assert speeds(back, rates).values == speeds(train, rates).values


@pytest.mark.parametrize(
    ("text", "drives", "words"),
    [
        ("bevel left:16 star:10 right:-16 on case", ["left", "case"], "no linkage in the plane"),
        ("screw spindle slide lead=5", ["spindle"], "no linkage in the plane"),
        ("sun:24 planet:18 ring:-60 on arm", ["planet", "arm"], "planet is a planet of arm"),
        ("in:20 frame:30", [], "one axis"),
    ],
)
def test_trains_that_have_no_linkage(text: str, drives: list[str], words: str) -> None:
    with pytest.raises(LinkageError, match=words):
        linkage_of_train(read_train(text).train, drives)


def test_linkages_that_are_no_trains() -> None:
    from gruebler.mechanics.fourbar import FourBar
    from tests.mechanics.kinematics.test_wheels import eccentric_pair, rack, rolling_cart

    with pytest.raises(LinkageError, match="no wheels"):
        train_of(FourBar(25, 70, 40, 70).linkage())
    with pytest.raises(LinkageError, match="no link holds the axes"):
        train_of(eccentric_pair())
    with pytest.raises(LinkageError, match="slides along the rack"):
        train_of(rolling_cart())
    (mesh,) = train_of(rack()).meshes
    assert (mesh.kind, mesh.a, mesh.b, mesh.size_a, mesh.carrier) == ("rack", "pinion", "rack", 10, "frame")
