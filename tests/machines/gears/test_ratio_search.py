"""Tooth numbers for a ratio against trying all of them by the speeds and the assembly of each train."""

import json
from fractions import Fraction
from itertools import product

import pytest

from gruebler.cli import main
from gruebler.machines.gears import GearError, assembly, read_train, search_ratio, speeds


def ratio_of(text, driven):
    reading = read_train(text)
    return 1 / speeds(reading.train, reading.drives).values[driven]


def tried(low, high, planets):
    """The ratios of all trains whose planets can be put in, by the tooth numbers and the shafts."""
    ratios = {}
    for a, p, q, b in product(range(low, high + 1), repeat=4):
        for sign_a, sign_b in ((1, -1), (-1, 1), (1, 1), (-1, -1)):
            if p == q and sign_a == sign_b:
                continue  # the central wheels would be one
            teeth = (sign_a * a, p, q, sign_b * b)
            if (sign_a < 0 and a <= p) or (sign_b < 0 and b <= q):
                continue
            row = f"a:{teeth[0]} planet:{p} on arm; planet:{q} b:{teeth[3]} on arm"
            if not assembly(read_train(row).train, "planet", planets).possible:
                continue
            for held, driving, driven in (("b", "a", "arm"), ("arm", "a", "b"), ("a", "arm", "b"), ("b", "arm", "a")):
                reading = read_train(f"{row}; hold {held}; drive {driving}=1")
                speed = speeds(reading.train, reading.drives).values[driven]
                if speed:
                    ratios[teeth, driving, driven] = 1 / speed
    return ratios


@pytest.mark.parametrize(("wanted", "planets"), [(Fraction(19, 5), 3), (Fraction(-7, 3), 2), (Fraction(41, 2), 3)])
def test_the_nearest_ratio_of_all(wanted, planets):
    low, high = 8, 15
    best = min(abs(value - wanted) for value in tried_once(low, high, planets).values())
    found = search_ratio(wanted, (low, high), planets=planets)
    assert abs(found[0].ratio - wanted) == best
    errors = [abs(design.ratio - wanted) for design in found]
    assert errors == sorted(errors)


_TRIED: dict = {}


def tried_once(low, high, planets):
    key = low, high, planets
    if key not in _TRIED:
        _TRIED[key] = tried(low, high, planets)
    return _TRIED[key]


@pytest.mark.parametrize("wanted", [4.2, -2.5, Fraction(1, 3), 100, Fraction(-1, 50)])
def test_each_train_has_its_ratio_and_can_be_assembled(wanted):
    for design in search_ratio(wanted, (17, 60), number=20):
        names = [row.split(":")[0] for row in design.text.split(" on arm")[0].split()]
        last = design.text.rpartition(" on arm")[0].split()[-1].split(":")[0]
        shafts = {"carrier": "arm", "a": names[0], "b": last}
        assert ratio_of(design.text, shafts[design.driven]) == design.ratio
        reading = read_train(design.text)
        assert assembly(reading.train, "planet", reading.planets["planet"]).possible
        assert all(17 <= abs(teeth) <= 60 for teeth in design.teeth)


def test_the_simple_train_comes_first_among_equals():
    best = search_ratio(Fraction(7, 2), (16, 60), number=1, stepped=False)[0]
    assert (best.teeth, best.size) == ((24, 18, 18, -60), 60)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("--ratio 0", "at rest"),
        ("--teeth 17-90", "--ratio 4.2"),
        ("--ratio 3 --teeth 90-17", "smaller one first"),
        ("--ratio 3 --teeth 17", "17-90"),
        ("--ratio 3 --planets 0", "at least 1"),
        ("--ratio x", "--ratio"),
        ("--ratio 3 -o x.svg", "gears search lists trains"),
    ],
)
def test_wrong_input_is_one_sentence(words, sentence, capsys):
    assert main(["gears", "search", *words.split()]) == 2
    assert sentence in capsys.readouterr().err


def test_options_of_the_search_belong_to_it(capsys):
    assert main(["gears", "sun:24 planet:18 ring:-60 on arm", "--ratio", "3"]) == 2
    assert "gears search" in capsys.readouterr().err


def test_the_command_prints_trains_that_it_takes(capsys):
    assert main(["gears", "search", "--ratio", "4.2", "--json"]) == 0
    text = json.loads(capsys.readouterr().out)[0]["text"]
    assert main(["gears", text]) == 0
    assert "5/21" in capsys.readouterr().out


def test_ranges_are_checked():
    with pytest.raises(GearError, match="from 5 to 250"):
        search_ratio(3, (2, 400))


def test_at_least_one_train_is_listed(capsys):
    with pytest.raises(GearError, match="number of trains: expected a whole number, at least 1, not 0"):
        search_ratio(3, (17, 20), number=0)
    assert main(["gears", "search", "--ratio", "4.2", "--number", "-1"]) == 2
    assert "No train" not in capsys.readouterr().out
