"""Wheels as dimensions: files both ways, sizes from teeth, and refusals that name joint and reason."""

import json
import tomllib

import pytest

from gruebler.base.errors import LinkageError
from gruebler.files import linkage_from_json, linkage_to_json, linkage_to_toml
from gruebler.mechanics.linkages import Circle, Linkage, Wheel, with_lower_pairs
from gruebler.mechanics.linkages.wheels import carriers, redundant_wheels, rolling_factors
from gruebler.structure.mechanism import Mechanism


def pair(first, second, kind="G", distance=50.0):
    mechanism = Mechanism.parse(f"R(f-a) R(f-b) {kind}(a-b); frame=f; drive=R(f-a)")
    return Linkage.from_drawing(
        mechanism, {"R(f-a)": (0, 0), "R(f-b)": (distance, 0), f"{kind}(a-b)": {"a": first, "b": second}}
    )


GIVEN = {
    "unit": "mm",
    "joints": "R(f-a) R(f-b) G(a-b)",
    "frame": "f",
    "drives": ["R(f-a)"],
    "places": {
        "R(f-a)": [0, 0],
        "R(f-b)": [50, 0],
        "G(a-b)": {"a": {"at": [0, 0], "teeth": 20, "module": 2}, "b": {"at": [50, 0], "teeth": 30, "module": 2}},
    },
}


def changed(**wheel):
    document = json.loads(json.dumps(GIVEN))
    document["places"]["G(a-b)"]["a"] = wheel
    return document


@pytest.mark.parametrize(
    "linkage",
    [
        pair(Wheel(0, 0, 20, teeth=20), Wheel(50, 0, 30, teeth=30)),
        pair(Wheel(0, 0, 0, teeth=20), Wheel(50, 0, 0, teeth=30)),
        pair(Wheel(0, 0, 20), Wheel(50, 0, -70), "W"),
        pair(Wheel(0, 0, 1 / 3, belt="open"), Wheel(50, 0, 0.1, belt="open")),
        pair(Circle(7, 1, 20), Circle(50, 0, 30)),
        linkage_from_json(GIVEN),
    ],
)
def test_files_lose_nothing(linkage):
    assert linkage_from_json(json.loads(json.dumps(linkage_to_json(linkage)))) == linkage
    assert linkage_from_json(tomllib.loads(linkage_to_toml(linkage))) == linkage


def test_sizes_from_teeth():
    bare = pair(Wheel(0, 0, 0, teeth=20), Wheel(50, 0, 0, teeth=30))
    assert [bare.element("G(a-b)", link).radius for link in "ab"] == [20, 30]
    internal = pair(Wheel(0, 0, 0, teeth=20), Wheel(50, 0, 0, teeth=-70))
    assert [internal.element("G(a-b)", link).radius for link in "ab"] == [20, -70]
    assert linkage_from_json(GIVEN).element("G(a-b)", "b") == Wheel(0, 0, 30, teeth=30)
    assert bare.size == 50


def test_ratios_are_exact():
    for module in (0.1, 1.25, 3.7, 1e-3):
        a, b = rolling_factors(Wheel(0, 0, 7 * module / 2, teeth=7), Wheel(0, 0, 49 * module / 2, teeth=49))
        assert b / a == 7


@pytest.mark.parametrize(
    ("first", "second", "kind", "said"),
    [
        (Wheel(0, 0, -20), Wheel(50, 0, -30), "G", "two internal wheels"),
        (Wheel(0, 0, 30), Wheel(50, 0, -20), "G", "must be larger"),
        (Wheel(0, 0, 20), Wheel(50, 0, 31), "W", "50 apart on 'f', but the radii make 51"),
        (Wheel(0, 0, 20, teeth=20), Wheel(50, 0, 30, teeth=40), "G", "modules differ: 2 and 1.5"),
        (Wheel(0, 0, 20, teeth=20), Wheel(50, 0, 30), "G", "on both wheels or on none"),
        (Wheel(0, 0, 20, belt="open"), Wheel(50, 0, 30), "G", "both wheels of a belt"),
        (Wheel(0, 0, 20, belt="open"), Wheel(50, 0, 30, belt="open"), "W", "a belt is not a rolling contact"),
        (Wheel(0, 0, 20, teeth=-20), Wheel(50, 0, 30, teeth=30), "G", "both negative"),
        (Wheel(0, 0, 0), Wheel(50, 0, 30), "G", "a radius is positive"),
        (Wheel(0, 0, float("nan")), Wheel(50, 0, 30), "G", "finite"),
        (Wheel(0, 0, 20, teeth=20.5), Wheel(50, 0, 30), "G", "whole number"),
        (Wheel(0, 0, 20, belt="loose"), Wheel(50, 0, 30), "G", "'open' or 'crossed'"),
        (Circle(0, 0, 20), Wheel(50, 0, 30), "G", "needs a line"),
        (Circle(0, 0, 20), Circle(50, 0, 30), "W", "needs a wheel"),
        (Circle(0, 0, 20), Circle(50, 0, 40), "G", "but the radii make 60"),
    ],
)
def test_refusals(first, second, kind, said):
    with pytest.raises(LinkageError, match=said) as error:
        pair(first, second, kind)
    assert "(a-b)" in str(error.value)


@pytest.mark.parametrize(
    ("wheel", "said"),
    [
        ({"at": [0, 0]}, "expected a radius, teeth or a circle"),
        ({"at": [0, 0], "teeth": 20, "modul": 2}, "did you mean 'module'"),
        ({"at": [0, 0], "teeth": 20, "module": -2}, "a positive number"),
        ({"at": [0], "radius": 20}, r"expected \[x, y\]"),
        ({"at": [0, 0], "circle": 20, "teeth": 3}, "teeth: does not go with circle"),
        ({"at": [0, 0], "radius": "20"}, "expected a number without a unit, but found '20'"),
        ({"teeth": 20}, "missing"),
    ],
)
def test_refusals_of_files(wheel, said):
    with pytest.raises(LinkageError, match=said) as error:
        linkage_from_json(changed(**wheel))
    assert "G(a-b).a" in str(error.value)


def test_a_wheel_is_not_driven_and_a_missing_side_is_named():
    mechanism = Mechanism.parse("R(f-a) R(f-b) G(a-b); frame=f")
    with pytest.raises(LinkageError, match="the element of 'b' is missing"):
        Linkage.from_drawing(mechanism, {"R(f-a)": (0, 0), "R(f-b)": (50, 0), "G(a-b)": {"a": Wheel(0, 0, 20)}})
    with pytest.raises(LinkageError, match="wheels are given for each"):
        Linkage.from_drawing(mechanism, {"R(f-a)": (0, 0), "R(f-b)": (50, 0), "G(a-b)": (20, 0)})


def test_arms_and_what_repeats():
    text = "R(f-s) R(f-r) R(f-c) R(c-p) G(s-p) G(p-r) R(c-q) G(s-q) G(q-r)"
    places = {f"R(f-{link})": (0, 0) for link in "src"} | {"R(c-p)": (38, 0), "R(c-q)": (-38, 0)}
    for planet, x in (("p", 38), ("q", -38)):
        places[f"G(s-{planet})"] = {"s": Wheel(0, 0, 20), planet: Wheel(x, 0, 18)}
        places[f"G({planet}-r)"] = {"r": Wheel(0, 0, -56), planet: Wheel(x, 0, 18)}
    linkage = Linkage.from_drawing(Mechanism.parse(f"{text}; frame=f"), places)
    held = carriers(linkage.mechanism, linkage.elements)
    assert {arm.link for arm in held.values()} == {"c"}
    assert redundant_wheels(linkage.mechanism, linkage.elements) == {8}
    assert len(with_lower_pairs(linkage).mechanism.chain.joints) == 8
