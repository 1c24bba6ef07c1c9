"""What an entry says of its motion is a number that is derived again: every claim can turn red, every text has one."""

import re
from dataclasses import replace
from math import cos, isclose, pi, sqrt
from pathlib import Path

import msgspec
import numpy as np
import pytest

from gruebler.base.errors import CatalogError
from gruebler.cli import main
from gruebler.files import read_entry
from gruebler.files.catalog_records import MOTION_NUMBERS, MotionQuantity
from gruebler.teaching.catalog import catalog_folder, check_entry, entries, entry
from gruebler.teaching.catalog.motion_quantities import derived_numbers, wrong_quantities

CLAIMED = [(id, k) for id, one in entries().items() for k in range(len(one.quantities))]


def changed(record, k, **numbers):
    claims = list(record.quantities)
    claims[k] = msgspec.structs.replace(claims[k], **numbers)
    return msgspec.structs.replace(record, quantities=tuple(claims))


@pytest.mark.parametrize(("id", "k"), CLAIMED)
def test_every_claim_can_turn_red(id, k):
    """Each alone, since all claims of an entry are derived whenever one is asked about."""
    claim = entry(id).quantities[k]
    alone = msgspec.structs.replace(entry(id), quantities=(claim,))
    assert list(wrong_quantities(alone)) == []
    for key, printed in claim.numbers.items():
        wrong = list(wrong_quantities(changed(alone, 0, **{key: printed * 1.02 if printed else 0.01})))
        assert [each.key for each in wrong] == [f"quantities 1, {claim.kind} {claim.of}: {key}"]


def test_a_wrong_claim_is_named_by_its_place():
    record = next(one for one in entries().values() if len(one.quantities) > 2)
    claim = record.quantities[2]
    key, printed = next(iter(claim.numbers.items()))
    (wrong,) = wrong_quantities(changed(record, 2, **{key: printed * 1.02 if printed else 0.01}))
    assert wrong.key == f"quantities 3, {claim.kind} {claim.of}: {key}"


# --- what a text says -----------------------------------------------------------------------------------

SAYINGS = {
    r"\blevel\b|\blevel-": {"straight", "swing"},
    r"\bstraight\b": {"straight"},
    r"\bdwell\b|\brests\b": {"dwell"},
    r"\bswings?\b|\btilts?\b|\bswinging\b": {"swing"},
    r"\bturns fully\b": {"turns"},
    r"\bwithout turning\b|\bparallel to\b|\bkeeps its direction\b|\bequal and parallel\b": {"swing"},
    r"\blifts\b|\blifting\b|\blift off\b|\brises\b|\bup and down\b": {"stroke", "straight", "swing"},
    r"\bratio\b|\bsum\b|\bparallel cranks\b": {"ratio"},
    r"\badds the strokes\b|\bfurther than\b": {"stroke", "swing"},
}
SAID_OTHERWISE = {
    ("evans", "turns fully"): "whether it does depends on the lengths",
    ("kurbelschleife", "turns fully"): "what it would do with a longer crank",
    ("diff_lever", "straight"): "the slides have straight guides",
    ("diff_lever", "tilt"): "the links let it, by as much as the slides ask",
    ("stephenson_gear", "straight"): "the shape of its link",
    ("stephenson_gear", "swing"): "how far depends on the reverser",
    ("walschaerts_gear", "straight"): "the shape of its link",
    ("pumpjack_link", "straight"): "of the point of the entry pumpjack",
    ("winch_screw", "parallel to"): "of axes",
}
WITHOUT_SIZES = {"pumpjack_rod", "quad_strut", "scissor_tandem"}


def sayings(record):
    texts = [text.en for text in (record.name, record.remark, record.claims.reason) if text is not None]
    for pattern, kinds in SAYINGS.items():
        for found in re.findall(pattern, " ".join(texts), re.IGNORECASE):
            yield found.lower(), kinds


def test_what_a_text_says_of_a_motion_is_a_claim():
    missing, without = [], set()
    for id, record in entries().items():
        for word, kinds in sayings(record):
            if record.dimensions is None and not record.quantities:
                without.add(id)
            elif not kinds & {claim.kind for claim in record.quantities} and (id, word) not in SAID_OTHERWISE:
                missing.append((id, word))
    assert missing == []
    assert without == WITHOUT_SIZES


def test_every_kind_of_claim_is_used():
    assert {claim.kind for one in entries().values() for claim in one.quantities} == {*MOTION_NUMBERS}


# --- against other hands --------------------------------------------------------------------------------


def circles(p, r, q, s, side):
    """Where the circles about p and q of radii r and s meet, on one side of the line p-q."""
    line = q - p
    x = (abs(line) ** 2 + r * r - s * s) / (2 * abs(line))
    return p + line / abs(line) * (x + side * 1j * np.sqrt(r * r - x * x))


def test_the_crane_by_circles():
    """000/003, exercise 19: coupler 30, rockers 80 and 100, frame 60, C 60 from the joint of the rocker 80."""
    other = 60 * np.exp(1j * np.radians(137))
    d = 100 * np.exp(1j * np.radians(np.linspace(60, 80, 2001)))
    a = circles(d, 30, other, 80, -1)
    c = a + 2 * (d - a)
    wanted = {"length": np.ptp(c.real), "band": np.ptp(c.imag)}
    assert derived_numbers(entry("crane"), entry("crane").quantities[0]) == pytest.approx(wanted, rel=1e-4)
    assert wanted["band"] < 0.0105 * wanted["length"]  # nearly level


KNOWN = [
    # entry, number of the claim, its numbers by hand
    ("lambda", 0, {"length": 80, "band": 0.195075}),  # 000/003, 3.5.4: less than a quarter of a percent
    ("geneva", 0, {"degrees": 270}),  # 360 - (180 - 360/4)
    ("geneva", 1, {"turns": -0.25}),
    ("diff", 0, {"least": 1 / 3, "greatest": 1 / 3}),  # Willis: 30 of 30 + 60 teeth
    ("diff", 1, {"least": 2 / 3, "greatest": 2 / 3}),
    ("elliptic_gears", 0, {"least": -3, "greatest": -1 / 3}),
    ("geartrain", 0, {"least": -1.5, "greatest": -1.5}),
    ("slidercrank", 0, {"length": sqrt(95**2) - sqrt(45**2)}),  # (b + a) - (b - a), a = 25, b = 70
    ("vcomp", 0, {"length": 60, "band": 0}),  # 2 a
    ("scottrussell", 0, {"length": 200 * cos(pi / 36), "band": 0}),  # 2 a sin 85 degrees to either side, a = 50
    ("toolbox", 0, {"degrees": 0}),
    ("wiper", 0, {"degrees": 0}),
    ("cam_roller", 0, {"length": 20}),
    ("cam", 1, {"degrees": 210}),  # rise and fall of 75 degrees each
    ("universal_joint", 0, {"least": sqrt(3) / 2, "greatest": 2 / sqrt(3)}),  # cos 30 degrees and its reciprocal
    ("cardan_shaft", 0, {"least": 1, "greatest": 1}),
    ("bennett", 0, {"least": -sqrt(3), "greatest": -1 / sqrt(3)}),  # tan(x/2) tan(y/2) = sin 60 / sin 30
]


@pytest.mark.parametrize(("id", "k", "numbers"), KNOWN)
def test_numbers_by_hand(id, k, numbers):
    assert derived_numbers(entry(id), entry(id).quantities[k]) == pytest.approx(numbers, rel=1e-5, abs=1e-9)


def test_the_hood_clears_its_seal():
    """By circles: the rear edge lies above its place on the seal all the way, and the lid ends upright."""
    first, second = 17 - 20j, 44 - 19j
    a, b = -4j, 10 - 2j
    arm = np.linspace(0, np.angle(a - first) - np.radians(72), 500)
    a_moved = first + (a - first) * np.exp(-1j * arm)
    b_moved = circles(a_moved, abs(b - a), second, abs(b - second), 1)
    turn = (b_moved - a_moved) / (b - a)
    edge = a_moved - a * turn
    assert edge[0] == pytest.approx(0)
    assert (edge.imag[1:] > 0).all()
    assert (edge.real >= -1e-9).all()
    opened = np.degrees(np.unwrap(np.angle(turn)))
    assert opened[-1] == pytest.approx(89.4, abs=0.1)
    assert (np.diff(opened) > 0).all()


# --- wrong claims and wrong files -----------------------------------------------------------------------


def test_a_crane_that_stands_turned_is_found_out():
    """The dimensions that lifted the load: the frame of exercise 19 as drawn there, at -47 degrees."""
    record = entry("crane")
    straight = msgspec.structs.replace(record.quantities[0], direction=90.0)
    wrong = list(wrong_quantities(msgspec.structs.replace(record, quantities=(straight,))))
    assert [each.key for each in wrong] == ["quantities 1, straight C: length", "quantities 1, straight C: band"]


def test_check_ends_with_1_and_names_the_claim(tmp_path, capsys):
    path = tmp_path / "crane.toml"
    text = (Path(catalog_folder()) / "machines" / "crane.toml").read_text(encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    assert main(["check", str(path)]) == 0
    path.write_text(text.replace("band = 0.368", "band = 0.1"), encoding="utf-8")
    capsys.readouterr()
    assert main(["check", str(path)]) == 1
    assert "quantities 1, straight C: band: printed 0.1, derived 0.367955" in capsys.readouterr().err
    checked = check_entry(read_entry(path), str(path))
    assert not checked.holds
    assert replace(checked, wrong=()).holds


def test_what_cannot_be_derived_is_wrong():
    record = entry("crane")
    far = changed(record, 0, range=(0.0, 360.0))
    assert [each.key for each in wrong_quantities(far)] == ["quantities 1, straight C"]
    strange = msgspec.structs.replace(record, quantities=(MotionQuantity(kind="swing", of="C", degrees=1.0),))
    assert len(list(wrong_quantities(strange))) == 1


@pytest.mark.parametrize(
    ("right", "wrong", "words"),
    [
        ("band = 0.368\n", "", "quantities 1: straight states length, band, but found length"),
        ("band = 0.368", "degrees = 3", "quantities 1: straight states length, band, but found length, degrees"),
        ('kind = "straight"', 'kind = "curved"', "quantities[0].kind"),
        ("direction = 0", "directio = 0", "unknown key 'quantities.directio'; did you mean 'direction'?"),
        ("direction = 0", "range = [3, 1]", "quantities 1: range: expected two numbers, the smaller first"),
    ],
)
def test_claims_that_say_nothing_are_refused(tmp_path, right, wrong, words):
    path = tmp_path / "crane.toml"
    text = (Path(catalog_folder()) / "machines" / "crane.toml").read_text(encoding="utf-8")
    assert right in text
    path.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(CatalogError) as caught:
        read_entry(path)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("id", "claim", "words"),
    [
        ("bennett", {"kind": "dwell", "of": "R(frame-follower)", "degrees": 1.0}, "dwell is not derived in space"),
        ("bennett", {"kind": "turns", "of": "follower", "turns": 1.0}, "turns is not derived in space"),
        ("sarrus", {"kind": "stroke", "of": "C", "length": 1.0}, "C: the path of a point in space needs a direction"),
        ("sarrus", {"kind": "stroke", "of": "C", "length": 1.0, "direction": 30.0}, "needs a direction of three"),
        ("delta", {"kind": "swing", "of": "platform", "degrees": 0, "drive": "S(arm1-rod1)"}, "is not driven"),
        ("crane", {"kind": "stroke", "of": "C", "length": 1.0, "direction": (1, 0, 0)}, "in the plane a direction is"),
    ],
)
def test_what_cannot_be_derived_says_why(id, claim, words):
    (wrong,) = wrong_quantities(msgspec.structs.replace(entry(id), quantities=(MotionQuantity(**claim),)))
    assert words in str(wrong)


def test_claims_hold_in_german_names():
    for id in ("crane", "vcomp", "diff", "loader_full"):
        assert list(wrong_quantities(entry(id).in_language("de"))) == []
    assert isclose(entry("crane").in_language("de").quantities[0].band, entry("crane").quantities[0].band)
