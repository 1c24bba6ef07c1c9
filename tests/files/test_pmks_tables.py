"""Addresses of PMKS-Refactor: the compression and its inverse, the tables, addresses that do not fit."""

import json
import tracemalloc
from math import degrees, pi
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.files.lz_string import decompressed
from gruebler.files.pmks import drawing_from_pmks
from gruebler.mechanics.kinematics import move

FOLDER = Path(__file__).parent / "samples"
DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$"


def compressed(text):
    """The inverse of `decompressed`, by the definition: longest known texts, their numbers in growing widths."""
    numbers = {}
    entries = 3  # 0 and 1 announce characters, 2 is the end
    bits = []

    def put(value, count):
        bits.extend(value >> place & 1 for place in range(count))

    position = 0
    entered = ""  # the last phrase and the character after it: the reader enters it with the next phrase
    while position < len(text):
        if entered:
            numbers[entered] = entries
        end = position + 1
        while end < len(text) and text[position : end + 1] in numbers:
            end += 1
        phrase = text[position:end]
        width = entries.bit_length()
        if phrase in numbers:
            put(numbers[phrase], width)
        else:
            wide = ord(phrase) > 255
            put(int(wide), width)
            put(ord(phrase), 16 if wide else 8)
            numbers[phrase] = entries
            entries += 1
        if entered:
            numbers[entered] = entries
            entries += 1
        entered = text[position : end + 1]
        position = end
    put(2, entries.bit_length())
    bits += [0] * (6 - len(bits) % 6)
    return "".join(DIGITS[int("".join(map(str, bits[k : k + 6])), 2)] for k in range(0, len(bits), 6))


def address(joints, links, **tables):
    """An address as the program spells it."""
    text = json.dumps({"j": joints, "l": links, **tables}, separators=(",", ":"))
    return "https://app.pmksplus.com/?data=" + compressed(
        text.replace('","', "~").replace(",", "_").replace('"]_["', "--")
    )


def joint(number, name, x, y, *, slides=False, angle=0, grounded=False, driven=False):
    truth = ("n", "y")
    return [number, name, x, y, "01"[not slides], angle, truth[grounded], truth[driven], "a", "n"]


PINS = [
    joint("0", "A", "0", "0", grounded=True, driven=True),
    joint("1", "B", "0", "2"),
    joint("2", "C", 6.5, "4"),
    joint("3", "D", "6", "0", grounded=True),
]
BARS = [["0", "AB", "0", "#1", 0.5, 1.5, "0|1"], ["1", "BC", "0", "#1", 1.5, 1.5, "1|2"]]
BARS += [["2", "CD", "0", "#1", 0.5, 1.5, "2|3"]]


@given(st.text(st.characters(max_codepoint=0xFFFF), max_size=300) | st.text("ab~_", max_size=300))
@example("a" * 300)
@example("")
def test_what_is_compressed_is_decompressed(text):
    assert decompressed(compressed(text), 300) == text


def test_the_package_lzstring_compresses_alike():
    """These two by the Python package lzstring 1.0.4, as the files `refactor-*.pmks`."""
    assert compressed("gears mesh") == "OYUwhgTgzgBAtiKALIA"
    assert compressed("") == "Q"


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "watt-1", "welded"])
def test_files_are_compressed_alike(name):
    text = (FOLDER / f"refactor-{name}.pmks").read_text().strip().partition("data=")[2]
    assert compressed(decompressed(text, 10_000)) == text


def test_whole_numbers_are_hexadecimal_and_angles_degrees():
    """The coupler of (0, 10), (20, 26), its point (6.5, 30), the slot at 30 degrees: as the file's maker wrote them."""
    left_out = []
    drawing = drawing_from_pmks((FOLDER / "refactor-welded.pmks").read_text(), left_out)
    places = {each.name: (each.x, each.y) for each in drawing.joints}
    assert places == {"A": (0, 0), "B": (0, 10), "C": (20, 26), "E": (6.5, 30)}
    slot = next(each for each in drawing.joints if each.slot is not None)
    assert (slot.name, slot.links, round(degrees(slot.slot), 9)) == ("C", ("ground", "BC", "CE"), 30)
    assert [str(note) for note in left_out] == [
        "the force F1",
        "positions of a synthesis",
        "masses, colours and speeds",
        "a unit, which the file does not have: its numbers are taken for cm",
    ]
    linkage = files.read(FOLDER / "refactor-welded.pmks", left_out=[])
    assert linkage.mechanism.chain.n == 4  # the welded bars are one link
    assert linkage.unit == "cm"
    motion = move(linkage, [pi / 2, pi / 2 + 0.5])
    x, y = motion.point("R(AB-BC)")[1]
    bar = 20**2 + 16**2
    run = (motion.point('R("block C"-BC)')[1] - (20, 26)) @ (np.cos(pi / 6), np.sin(pi / 6))
    end = np.array((20, 26)) + run * np.array((np.cos(pi / 6), np.sin(pi / 6)))
    assert (end[0] - x) ** 2 + (end[1] - y) ** 2 == pytest.approx(bar)  # it slides along the slot


def test_names_that_are_equal_or_missing_are_made_different(tmp_path):
    path = tmp_path / "a.pmks"
    path.write_text(address([[*row[:1], "", *row[2:]] for row in PINS], [[row[0], "x", *row[2:]] for row in BARS]))
    linkage = files.read(path, left_out=[])
    assert linkage.mechanism.chain.n == 4
    assert linkage.length("x1", 1, 2) == pytest.approx((6.5**2 + 2**2) ** 0.5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("?data=", "is damaged"),
        ("?data=!", "is damaged"),
        ("?data=OYUwhgTgzgBAtiK", "is damaged"),
        ("?data=" + compressed("gears"), "no tables of joints"),
        ("?data=" + compressed("[" * 5000), "no tables of joints"),
        ("?data=" + compressed('{"l":[]}'), "no tables of joints"),
        (address([["0", "A"]], []), "expected rows of 8 values"),
        (address([joint("0", "A", "x", "0")], []), "joint A: expected a number, but found 'x'"),
        (address(PINS, [["0", "AB", "0", "#1", 1, 1, "0|9"]]), "has the joint '9', which is not there"),
        (address(PINS, [["0", "AB", "0", "#1", 1, 1, "0|b"]]), "not a list of numbers"),
        (address(PINS, []), "no mechanism on the frame"),
        (address({}, []), "no tables of joints"),
    ],
    ids=lambda text: text[:30],
)
def test_addresses_that_do_not_fit_are_one_sentence(text, words, tmp_path):
    address_is_refused(text, words, tmp_path)


def address_is_refused(text, words, tmp_path):
    path = tmp_path / "a.pmks"
    path.write_text(text)
    tracemalloc.start()
    with pytest.raises(GrueblerError) as caught:
        files.read(path, left_out=[])
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert peak < 50_000_000


def test_an_address_of_too_many_characters_is_refused(tmp_path):
    address_is_refused("?data=" + compressed("a" * 2_000_001), "more than 2,000,000 characters", tmp_path)


def test_links_that_are_not_there_are_not_welded(tmp_path):
    path = tmp_path / "a.pmks"
    path.write_text(address(PINS, BARS, c=[["3", "ABX", "0", 1, 1, "0|7"]], t=""))
    assert files.read(path, left_out=[]).mechanism.chain.n == 4
