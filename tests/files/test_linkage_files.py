"""Files of linkages: what is written is read back to the last bit, and what does not fit is refused in a sentence."""

import cmath
import json
import math
import re
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.base.text import error_in_language
from gruebler.files.angles import in_degrees, in_radians
from gruebler.files.linkages import linkage_from_json, linkage_to_json, linkage_to_toml, read_linkage, write_linkage
from gruebler.files.screws import read_any_linkage
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

HEXAGON = Mechanism.parse("R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)")
CYLINDER = Mechanism.parse('R(0-"arm 1") R(0-4) R(4-2) P("arm 1"-2); frame=0; drive=P("arm 1"-2)')
SLOT = Mechanism.parse("R(wall-lever) R(lever-door) G(wall-door); frame=wall; drive=R(wall-lever)")

number = st.floats(-1e6, 1e6)
place = st.tuples(number, number)


@pytest.mark.parametrize(
    ("machine", "read"), [("wiper", read_linkage), ("wiper", read_any_linkage), ("sarrus", read_any_linkage)]
)
def test_the_file_of_a_catalog_entry_is_called_so(machine, read):
    path = Path(__file__).parents[2] / f"catalogs/machines/{machine}.toml"
    with pytest.raises(LinkageError, match=rf"{machine}\.toml: is a catalog entry; .* \[dimensions\]"):
        read(path)


@given(angle=st.floats(-1e6, 1e6))
def test_every_angle_survives_degrees(angle):
    assert in_radians(in_degrees(angle)) == angle


@given(degrees=st.decimals(-720, 720, places=3).map(float))
def test_short_degrees_stay_short(degrees):
    assert in_degrees(in_radians(degrees)) == degrees


@pytest.mark.parametrize("degrees", [1e-300, 0.1, 33.3, 55.0, 123.456, -719.9, 1e15])
def test_the_nearest_radians(degrees):
    pi = Fraction(31415926535897932384626433832795028841971, 10**40)  # off by less than 1e-40
    exact, found = Fraction(degrees) * pi / 180, in_radians(degrees)
    gap = abs(Fraction(found) - exact)
    for other in (math.nextafter(found, math.inf), math.nextafter(found, -math.inf)):
        assert gap <= abs(Fraction(other) - exact)


def _drawings(draw):
    kind = draw(st.sampled_from(["hexagon", "cylinder", "slot"]))
    angle = draw(st.floats(-math.pi, math.pi))
    if kind == "hexagon":
        mechanism, places = HEXAGON, {name: draw(place) for name in HEXAGON.chain.joint_names()}
    elif kind == "cylinder":
        names = CYLINDER.chain.joint_names()
        mechanism, places = CYLINDER, {name: draw(place) for name in names[:3]} | {names[3]: (*draw(place), angle)}
    else:
        mechanism = SLOT
        places = {
            "R(wall-lever)": draw(place),
            "R(lever-door)": draw(place),
            "G(wall-door)": (*draw(place), angle, "wall"),
        }
    outputs = draw(st.sets(st.sampled_from(mechanism.chain.links)))
    points = {'K, odd "name"\\': (draw(st.sampled_from(mechanism.chain.links)), *draw(place))}
    try:
        return Linkage.from_drawing(
            mechanism, places, points=points, unit=draw(st.sampled_from(["mm", "in", "µm"])), outputs=outputs
        )
    except LinkageError:
        return None  # places that coincide


@given(linkage=st.composite(_drawings)())
def test_round_trips(linkage):
    assume(linkage is not None)
    assert linkage_from_json(linkage_to_json(linkage)) == linkage
    assert linkage_from_json(json.loads(json.dumps(linkage_to_json(linkage)))) == linkage
    again = linkage_from_json(tomllib.loads(linkage_to_toml(linkage)))
    assert again == linkage
    assert again.mechanism.chain.links == linkage.mechanism.chain.links
    assert linkage_to_toml(again) == linkage_to_toml(linkage)


def test_files_round_trip_and_keep_the_order_of_links(tmp_path):
    from gruebler.structure.chain import Chain

    chain = Chain(HEXAGON.chain.joints, links=["h", "4", "3", "2", "1", "0"])
    linkage = Linkage.from_drawing(
        Mechanism(chain, "0", HEXAGON.drives),
        {
            "R(0-1)": (0, 0),
            "R(1-2)": (0.5, 0.3),
            "R(2-h)": (2, 2),
            "R(0-3)": (5, 0),
            "R(3-h)": (4, 2.2),
            "R(0-4)": (2, 5.5),
            "R(4-h)": (3, 3.5),
        },
    )
    for suffix in ("toml", "json"):
        path = tmp_path / f"x.{suffix}"
        write_linkage(path, linkage)
        again = read_linkage(path)
        assert again == linkage
        assert again.mechanism.chain.links == ("h", "4", "3", "2", "1", "0")
    assert sorted(one.name for one in tmp_path.iterdir()) == ["x.json", "x.toml"]  # nothing is left aside
    with pytest.raises(LinkageError, match=r"end the name with \.toml or \.json"):
        write_linkage(tmp_path / "x.yaml", linkage)


# --- the doors --------------------------------------------------------------------------------------

DOORS = [
    ({"four_bar": {"a": 25, "b": 70, "c": 40, "d": 70}}, FourBar(25, 70, 40, 70)),
    ({"slider_crank": {"a": 35, "b": 100, "e": -20}}, SliderCrank(35, 100, -20)),
    ({"inverted_slider_crank": {"a": 30, "d": 50}}, InvertedSliderCrank(30, 50)),
]


@pytest.mark.parametrize(("door", "lengths"), DOORS)
def test_doors_without_joints(door, lengths):
    points = {"K": {"link": "coupler", "at": [1, 2]}}
    assert linkage_from_json({"unit": "cm", **door, "points": points}) == lengths.linkage({"K": (1, 2)}, unit="cm")


TEXTS = [
    "R(box-lever1) R(box-lever2) R(lever1-tray) R(lever2-tray)",
    "R(frame-crank) R(crank-conrod) R(conrod-piston) P(frame-piston)",
    "R(frame-crank) R(crank-block) P(block-lever) R(frame-lever)",
]


@pytest.mark.parametrize("branch", ["+", "-"])
@pytest.mark.parametrize(("door", "lengths", "text"), [(*door, text) for door, text in zip(DOORS, TEXTS, strict=True)])
def test_doors_on_other_names_lie_as_the_closed_form_says(door, lengths, text, branch):
    (way, sizes), joints = next(iter(door.items())), text.split()
    linkage = linkage_from_json({"unit": "mm", "joints": text, "drives": [joints[0]], way: {**sizes, "branch": branch}})
    pose = lengths.motion(1.0, branch=branch)
    assert linkage.reference_pose is not None
    named = linkage.reference_pose
    crank = linkage.mechanism.drives[0].between[1]
    assert named[crank].angle == 1.0
    for joint in joints:  # every joint is closed in the home position
        seen = []
        for link in linkage.mechanism.chain.joints[linkage.mechanism.chain.find_joint(joint)].links:
            element = linkage.element(joint, link)
            x, y = named[link].put(element.x, element.y)
            seen.append((x, y, named[link].angle + element.direction))
        (x, y, angle), (u, v, other) = seen
        if joint.startswith("R"):
            assert math.hypot(x - u, y - v) < 1e-12 * 100
        else:
            assert abs(math.sin(angle - other)) < 1e-12
            assert abs(math.cos(angle) * (v - y) - math.sin(angle) * (u - x)) < 1e-12 * 100
    assert any(math.isclose(place.x, pose.A.value[0]) for place in named.values())


def test_the_driven_link_of_a_four_bar_is_a():
    text = "R(frame-treadle) R(treadle-rod) R(rod-crank) R(frame-crank)"
    for drive, length in (("R(frame-treadle)", "treadle"), ("R(frame-crank)", "crank")):
        made = linkage_from_json({"unit": "mm", "joints": text, "drives": [drive], **DOORS[0][0]})
        other = next(joint for joint in text.split() if length in joint and "frame" not in joint)
        assert made.length(length, drive, other) == 25


def test_a_drawing():
    document = {
        "unit": "cm",
        "joints": "R(wall-lever) R(lever-door) G(wall-door)",
        "drives": ["R(wall-lever)"],
        "places": {"R(wall-lever)": [0, 0], "R(lever-door)": [77, -77], "G(wall-door)": [154, 0, 0, "wall"]},
        "points": {"edge": {"link": "door", "at": [0, -154]}},
    }
    made = linkage_from_json(document)
    assert math.isclose(made.length("door", "R(lever-door)", "G(wall-door)"), 77 * math.sqrt(2))
    assert made.reference_pose is not None
    assert math.isclose(made.reference_pose["lever"].angle, -math.pi / 4)
    edge = made.points["edge"]
    assert made.reference_pose["door"].put(edge.x, edge.y) == pytest.approx((0, -154))


# --- what does not fit ------------------------------------------------------------------------------

GOOD = """
unit = "mm"
joints = "R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston)"
frame = "frame"
drives = ["R(frame-crank)"]
outputs = ["piston"]
points.K = { link = "rod", at = [20, 5] }

[elements]
frame = { "R(frame-crank)" = [0, 0], "P(frame-piston)" = [0, 10, 0] }
crank = { "R(frame-crank)" = [0, 0], "R(crank-rod)" = [20, 0] }
rod = { "R(crank-rod)" = [0, 0], "R(rod-piston)" = [50, 0] }
piston = { "R(rod-piston)" = [0, 0], "P(frame-piston)" = [0, 0, 0] }
"""

MISTAKES = [
    ('unit = "mm"', 'unti = "mm"', "unknown key 'unti'; did you mean 'unit'?"),
    ('unit = "mm"', "", "unit"),
    ('unit = "mm"', "unit = 3", "unit: expected a text, but found 3"),
    ('unit = "mm"', 'unit = " "', "unit: expected the name of a unit"),
    ("R(crank-rod) ", "Q(crank-rod) ", "joints: unknown joint symbol 'Q'"),
    ('frame = "frame"\n', 'frame = "fram"\n', "frame: the chain has no link 'fram'"),
    ('drives = ["R(frame-crank)"]', 'drives = ["R(frame-rod)"]', "drives: 'R(frame-rod)' is not one of the joints"),
    ('outputs = ["piston"]', 'outputs = ["pistn"]', "outputs: there is no link 'pistn' (did you mean 'piston'?)"),
    ("link = ", "lnk = ", "unknown key 'points.K.lnk'; did you mean 'link'?"),
    ('"rod", at', '"rid", at', "points.K: there is no link 'rid' (did you mean 'rod'?)"),
    ("at = [20, 5]", "at = [20]", "points.K.at: expected [x, y], but found [20"),
    ("crank = {", "cranc = {", "elements: there is no link 'cranc' (did you mean 'crank'?)"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-pistn)" = [50, 0]', "elements.rod: 'R(rod-pistn)' is not one of the joints"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = 50', "elements.rod.R(rod-piston): expected [x, y] or"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = [50, "0"]', "expected numbers below 1e100, but found '0'"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = [nan, 0]', "expected numbers below 1e100, but found nan"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = [1e400, 0]', "expected numbers below 1e100, but found inf"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = [0, 0]', "'rod' the points of R(crank-rod) and R(rod-piston) coi"),
    ('"R(rod-piston)" = [50, 0]', '"R(rod-piston)" = [5, 0, 0]', "R(rod-piston) needs a pin [x, y] on each"),
    (
        '"R(rod-piston)" = [50, 0]',
        '"R(rod-piston)" = [5, 0], "R(piston-rod)" = [5, 0]',
        "this joint is given twice",
    ),
    (', "R(rod-piston)" = [50, 0]', "", "the place of R(rod-piston) on 'rod' is missing"),
    ("[0, 10, 0]", "[0, 10, true]", "expected an angle in degrees, but found True"),
    ("[0, 10, 0]", '[0, 10, "right"]', "expected an angle in degrees, but found 'right'"),
    ("[0, 10, 0]", f"[0, 10, {'9' * 400}]", "expected an angle in degrees, but found a number of many digits"),
    ("[0, 10, 0]", "[0, 10, inf]", "expected an angle in degrees, but found inf"),
    (
        "[elements]",
        "[reference_pose]\ncrank = [0, 0]\n[elements]",
        "reference_pose.crank: expected [x, y, degrees], but",
    ),
    ("[elements]", "[places]\n[elements]", "expected one of elements, places, four_bar, "),
    ("[elements]", "[four_bar]", "unknown key 'four_bar.frame'"),
]


def test_the_good_file_is_good(tmp_path):
    path = tmp_path / "it.toml"
    path.write_text(GOOD, encoding="utf-8")
    expected = SliderCrank(20, 50, 10).linkage()
    made = read_linkage(path)
    assert made.elements[0, "frame"] == expected.elements[0, "frame"]
    assert made.length("rod", 1, 2) == expected.length("coupler", 1, 2)


@pytest.mark.parametrize(("right", "wrong", "words"), MISTAKES, ids=[words[:40] for _, _, words in MISTAKES])
def test_mistakes_one_by_one(tmp_path, right, wrong, words):
    path = tmp_path / "it.toml"
    assert right in GOOD
    path.write_text(GOOD.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(LinkageError) as caught:
        read_linkage(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert words in message
    assert "\n" not in message
    assert len(message) < 400


BAD_DOORS = [
    ({"four_bar": {"a": 0, "b": 70, "c": 40, "d": 70}}, "four_bar: a must be positive, not 0"),
    ({"four_bar": {"a": math.nan, "b": 70, "c": 40, "d": 70}}, "four_bar: a must be a finite number"),
    ({"four_bar": {"a": 1, "b": 70, "c": 40}}, "four_bar: the key 'd' is missing"),
    ({"four_bar": {"a": 1, "b": 2, "c": 2, "d": 2, "branch": "2"}}, "four_bar.branch: expected + or -, but found '2'"),
    ({"slider_crank": {"a": "2", "b": 3}}, "slider_crank.a: expected a number without a unit, but found '2'"),
    ({"slider_crank": {"a": 10**400, "b": 3}}, "slider_crank.a: number out of range"),
    ({"four_bar": 3}, "four_bar: expected a table of keys"),
    ({}, "expected one of elements, places, four_bar, slider_crank, inverted_slider_crank, but found none"),
    ({"places": {}}, "joints: missing"),
    ({"four_bar": {"a": 1, "b": 2, "c": 2, "d": 2}, "frame": "x"}, "frame: goes with joints"),
    (
        {"four_bar": {"a": 1, "b": 2, "c": 2, "d": 2}, "joints": "R(0-1) R(1-2) R(2-0)"},
        "four_bar needs four links in a l",
    ),
    ({"slider_crank": {"a": 1, "b": 2}, "joints": TEXTS[0]}, "with joints RRRP"),
    ({"four_bar": {"a": 1, "b": 2, "c": 2, "d": 2}, "drives": ["R(a-b)"]}, "drives: 'R(a-b)' is not one of the joints"),
]


@pytest.mark.parametrize(("document", "words"), BAD_DOORS)
def test_wrong_doors(document, words):
    with pytest.raises(LinkageError) as caught:
        linkage_from_json({"unit": "mm", **document})
    assert words in str(caught.value)


HOSTILE = {
    "big.toml": b"#" * 1_000_001,
    "latin.toml": b'unit = "\xe9"',
    "deep.toml": b"a = " + b"[" * 50_000 + b"]" * 50_000,
    "dots.toml": b".".join([b"a"] * 200_000) + b" = 1",
    "deep.json": b"[" * 200_000,
    "digits.json": b'{"unit": ' + b"9" * 10_000 + b"}",
    "nan.json": b'{"unit": NaN}',
    "twice.json": b'{"unit": "mm", "unit": "cm"}',
    "twice-in-many.json": b"{" + b",".join(b'"k%d": 1' % k for k in range(60_000)) + b', "k59999": 2}',
    "list.json": b"[1, 2]",
    "empty.json": b"",
    "links.toml": b'unit = "mm"\njoints = "'
    + b" ".join(b"R(%d-%d)" % (k, k + 1) for k in range(20_000))
    + b'"\n[places]\n',
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(HOSTILE[name])
    with pytest.raises(LinkageError) as caught:
        read_linkage(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert len(str(caught.value)) < 400


def test_the_first_key_that_comes_again_is_named(tmp_path):
    path = tmp_path / "keys.json"
    path.write_text("{" + ", ".join(f'"{key}": 1' for key in "abcdbca") + "}")
    with pytest.raises(LinkageError, match="the key 'b' stands twice"):
        read_linkage(path)


def test_what_is_no_file(tmp_path):
    with pytest.raises(LinkageError, match=r"cannot be read"):
        read_linkage(tmp_path / "none.toml")
    (tmp_path / "folder.json").mkdir()
    with pytest.raises(LinkageError, match=r"cannot be read"):
        read_linkage(tmp_path / "folder.json")
    with pytest.raises(LinkageError, match=r"is in a \.toml or \.json file"):
        read_linkage(tmp_path / "x.txt")


@pytest.mark.parametrize(
    ("text", "english", "german"),
    [
        ('unit = "mm"\nfour_baar = {}', "unknown key 'four_baar'; did you mean", "unbekannter Schlüssel 'four_baar'"),
        (
            "unit = 3\nfour_bar = {a=1, b=1, c=1, d=1}",
            "unit: expected a text, but found 3",
            "unit: erwartet wird ein Text, nicht 3",
        ),
        ('unit = "mm"\nfour_bar = {a=1, b=1, c=1}', "the key 'd' is missing", "der Schlüssel 'd' fehlt"),
        ('unit = "mm"\nfour_bar = [', "is not TOML", "kein gültiges TOML"),
        ('unit = "mm"\npoints.K = {link="x", at=[0]}\nfour_bar = {a=1, b=1, c=1, d=1}', "no link 'x'", "Glied 'x'"),
    ],
)
def test_refusals_can_be_read_in_german(tmp_path, text, english, german):
    path = tmp_path / "linkage.toml"
    path.write_text(text)
    with pytest.raises(LinkageError) as refused:
        read_linkage(path)
    assert english in str(refused.value)
    assert german in error_in_language(refused.value, "de")


@given(st.floats(0.1, 6), st.floats(-50, 50), st.floats(0.01, 100))
def test_a_turned_drawing_is_written_without_rounding(turn, shift, scale):
    """On its own x axis a link has no y of 4e-16, and no file has -0.0; the drawing comes back all the same."""
    pins = [complex(*p) * scale * cmath.exp(1j * turn) + shift for p in ((0, 0), (1, 2), (4, 3), (5, 0))]
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)")
    linkage = Linkage.from_drawing(mechanism, {k: (p.real, p.imag) for k, p in enumerate(pins)})
    for link in ("1", "2", "3"):
        pins_of_link = [e for (_, owner), e in linkage.elements.items() if owner == link]
        rows = sorted((e.x, e.y) for e in pins_of_link)
        assert [y for _, y in rows] == [0.0, 0.0]
        assert rows[0][0] == 0.0
        assert rows[1][0] == pytest.approx(abs(pins[int(link)] - pins[int(link) - 1]), rel=1e-12)
    assert not re.search(r"-0\.0\b", linkage_to_toml(linkage))
    for (number, link), pin in linkage.elements.items():
        assert linkage.required_pose[link].put(pin.x, pin.y) == pytest.approx(
            (pins[number].real, pins[number].imag), abs=1e-13 * (abs(shift) + 10 * scale)
        )


def test_minus_zero_is_written_as_zero():
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (-0.0, 5)}).with_reference_pose(None)
    assert not re.search(r"-0\.0\b", linkage_to_toml(linkage))
    assert not re.search(r"-0\.0\b", json.dumps(linkage_to_json(linkage)))
