"""Grashof's condition: the tables of the field, the theorem against a brute-force rotation, ranges of one length."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES, grashof, turning_ranges, types_along

small = st.integers(1, 12)
length = st.floats(0.5, 20)


# Bild 2.3: one chain, shortest a = 2 and c = 4 opposite to it, with each link as frame.
@pytest.mark.parametrize(
    ("lengths", "key", "german"),
    [
        ((2, 4, 5, 5), "crank_rocker", "Kurbelschwinge"),
        ((2, 5, 4, 5), "crank_rocker", "Kurbelschwinge"),
        ((5, 4, 5, 2), "double_crank", "Doppelkurbel"),
        ((5, 2, 5, 4), "grashof_double_rocker", "Doppelschwinge mit umlaufender Koppel"),
        ((40, 100, 70, 90), "crank_rocker", "Kurbelschwinge"),
        ((25, 70, 40, 70), "crank_rocker", "Kurbelschwinge"),
        ((4, 5, 2, 5), "rocker_crank", "Kurbelschwinge mit Antrieb an der Schwinge"),
        ((3, 5, 3, 5), "parallelogram", "Parallelkurbel oder gegenläufige Antiparallelkurbel"),
        ((5, 3, 5, 3), "parallelogram_short_frame", "Parallelkurbel oder gleichläufige Antiparallelkurbel"),
        ((3, 3, 5, 5), "kite_crank_rocker", "gleichschenklige Kurbelschwinge"),
        ((3, 5, 5, 3), "kite_double_crank", "gleichschenklige Doppelkurbel"),
        ((5, 3, 3, 5), "kite_rocker_crank", "gleichschenklige Kurbelschwinge mit Antrieb an der Schwinge"),
        ((5, 5, 3, 3), "kite_double_crank_reversed", "gleichschenklige Doppelkurbel mit Antrieb an der langen Kurbel"),
        ((4, 4, 4, 4), "rhombus", "Rhombus (vier gleiche Glieder)"),
        ((2, 5, 4, 7), "change_point_crank_rocker", "durchschlagende Kurbelschwinge"),
        ((7, 5, 4, 2), "change_point_double_crank", "durchschlagende Doppelkurbel"),
        ((5, 2, 7, 4), "change_point_double_rocker", "durchschlagende Doppelschwinge"),
        ((80, 60, 100, 30), "double_crank", "Doppelkurbel"),
        ((4, 5, 6, 4.5), "triple_rocker", "Totalschwinge (kein Glied umlauffähig)"),
        ((1, 1, 1, 5), "not_assemblable", "nicht montierbar"),
        ((1, 1, 1, 3), "single_position", "gestreckt: nur eine einzige Lage"),
        ((25 / 3, 1.9245008972987525, 25 / 3, 40 / 3 * math.sqrt(3)), "not_assemblable", "nicht montierbar"),
        ((25 / 3, 1.9245008972987525, 25 / 3, 40 / 9 * math.sqrt(3)), "grashof_double_rocker", None),
    ],
)
def test_types_of_the_field(lengths, key, german):
    found = grashof(*lengths)
    assert found.type.key == key
    assert german in (None, found.name("de"))


def test_exercise_7_says_its_sums():
    found = grashof(40, 100, 70, 90)
    assert found.excess == -20
    assert found.turning == ("a",)
    assert found.explain("de") == (
        "l_min + l_max = 40 + 100 = 140 < 160 = 90 + 70: Kurbelschwinge. Gegen das Gestell umlauffähig: a (Kurbel)."
    )


def test_decimal_lengths_are_change_points_though_their_sums_are_rounded():
    assert 0.1 + 0.7 != 0.3 + 0.5
    assert grashof(0.1, 0.5, 0.3, 0.7).type.key == "change_point_crank_rocker"
    assert grashof(0.1, 0.2, 0.3, 0.6).type.key == "single_position"


def test_every_row_of_the_table_is_reached_and_has_its_own_name():
    reached = {grashof(*row).type for row in itertools.product(range(1, 8), repeat=4)}
    assert reached == set(FOUR_BAR_TYPES.values())
    assert len({kind.name("en") for kind in reached}) == len({kind.name("de") for kind in reached}) == len(reached)


def directions(short_open: tuple[float, float], x: float, y: float) -> bool:
    """Whether two links x and y, at every angle between them, can be joined by two others; tried at 720 angles."""
    z, w = short_open
    gap = np.abs(y - x * np.exp(1j * np.radians(np.arange(0, 360, 0.5))))
    return bool(((gap <= z + w + 1e-9) & (gap >= abs(z - w) - 1e-9)).all())


@given(small, small, small, small)
def test_turning_links_agree_with_a_brute_force_rotation(a, b, c, d):
    found = grashof(a, b, c, d)
    expected = [("a", a, (b, c)), ("b", b, (a, c)), ("c", c, (a, b))]
    assert found.turning == tuple(name for name, x, others in expected if directions(others, x, d))
    assert ("a" in found.turning) == bool(FourBar(a, b, c, d).limits and FourBar(a, b, c, d).limits[0].full)


@given(length, length, length, length)
def test_the_motion_itself_turns_the_links_that_are_said_to_turn(a, b, c, d):
    found = grashof(a, b, c, d)
    assume(abs(found.excess) > 0.02)
    four_bar = FourBar(a, b, c, d)
    if found.condition == ">":
        assert found.turning == ()
        return
    driver, motion = "a", four_bar.motion(np.linspace(0, 2 * np.pi, 4001))
    if "a" not in found.turning:
        driver, motion = "c", four_bar.reversed().motion(np.linspace(0, 2 * np.pi, 4001))
    if driver not in found.turning:
        assert found.turning == ("b",)
        return
    assert motion.complete
    turns = {driver}
    for name, track in (("b", motion.coupler), ({"a": "c", "c": "a"}[driver], motion.output)):
        angle = np.unwrap(track.value)
        if abs(angle[-1] - angle[0]) > math.pi:
            turns.add(name)
    assert tuple(sorted(turns)) == found.turning


@given(small, small, small, small, st.floats(1e-3, 1e3))
def test_blind_to_the_unit_and_to_the_side_of_the_drive(a, b, c, d, unit):
    found = grashof(a, b, c, d)
    assert grashof(unit * a, unit * b, unit * c, unit * d).type == found.type
    swapped = {"a": "c", "c": "a"}
    assert set(grashof(c, b, a, d).turning) == {swapped.get(name, name) for name in found.turning}


@given(st.permutations([2, 4, 5, 5.5]))
def test_every_inversion_of_a_grashof_chain_turns_the_shortest_link(lengths):
    found = grashof(*lengths)
    shortest = "abcd"[lengths.index(2)]
    assert found.shortest == (shortest,)
    assert found.turning == (("a", "b", "c") if shortest == "d" else (shortest,))


# Exercises 8 to 10; exercise 9 prints only the crank-rocker.
@pytest.mark.parametrize(
    ("given_lengths", "ranges"),
    [
        ({"a": 25, "b": 40, "c": 70}, [(55, 85, "crank_rocker")]),
        ({"a": 40, "b": 100, "c": 70}, [(0, 10, "double_crank"), (70, 130, "crank_rocker")]),
        ({"a": 30, "b": 110, "d": 80}, [(60, 160, "crank_rocker")]),
    ],
)
def test_exercises_8_to_10(given_lengths, ranges):
    found = turning_ranges("a", **given_lengths)
    assert [(part.lower, part.upper, part.type.key) for part in found] == ranges
    free = next(name for name in "abcd" if name not in given_lengths)
    for part in found:
        assert part.above.key == "triple_rocker"
        assert part.below is None or part.below.key == "triple_rocker"
        assert all(grashof(**given_lengths, **{free: end}).change_point for end in (part.lower, part.upper) if end)


def half_lines(turns: str, free: str, given_lengths: dict[str, float]) -> list[tuple[float, float]]:
    """Rival: the shortest of the link and the frame, each in turn, is to be short enough; three inequalities each."""
    found = []
    for short in (turns, "d"):
        others = [name for name in "abcd" if name != short]
        low, high = 0.0, math.inf
        for x in others:
            rest = [name for name in others if name != x]
            # short + x <= sum of the rest
            if free in rest:
                low = max(low, given_lengths[short] + given_lengths[x] - sum(given_lengths.get(n, 0) for n in rest))
            else:
                high = min(
                    high, sum(given_lengths[n] for n in rest) - given_lengths.get(short, 0) - given_lengths.get(x, 0)
                )
        if low <= high and high > 0:
            found.append((low, high))
    return found


@given(small, small, small, st.sampled_from("abcd"), st.sampled_from("abc"))
def test_ranges_against_the_inequalities(x, y, z, free, turns):
    lengths = dict(zip([name for name in "abcd" if name != free], (x, y, z), strict=True))
    ranges = [(part.lower, part.upper) for part in turning_ranges(turns, **lengths)]
    expected = half_lines(turns, free, lengths)
    for value in np.arange(0.125, 40, 0.125):
        inside = any(low <= value <= high for low, high in ranges)
        assert inside == any(low <= value <= high for low, high in expected)
        assert inside == (turns in grashof(**lengths, **{free: value}).turning)


@given(small, small, small, st.sampled_from("abcd"))
def test_types_along_a_length_leave_no_gap_and_name_their_neighbours(x, y, z, free):
    lengths = dict(zip([name for name in "abcd" if name != free], (x, y, z), strict=True))
    parts = types_along(**lengths)
    assert parts[0].lower == 0
    assert parts[-1].upper == math.inf
    assert parts[-1].type.key == "not_assemblable"
    for left, right in itertools.pairwise(parts):
        assert left.upper == right.lower
        assert (left.above, right.below) == (right.type, left.type)
        assert left.type != right.type
    for part in parts:
        if part.lower < part.upper < math.inf:
            for share in (0.01, 0.3, 0.99):
                value = part.lower + share * (part.upper - part.lower)
                if value not in lengths.values():
                    assert grashof(**lengths, **{free: value}).type == part.type


def test_a_single_value_can_be_a_range():
    double_crank, kite = turning_ranges("b", a=2, b=2, c=3)
    assert ((double_crank.lower, double_crank.upper), double_crank.type.key) == ((0, 1), "double_crank")
    assert ((kite.lower, kite.upper), kite.type.key) == ((3, 3), "kite_crank_rocker")
    assert turning_ranges("c", a=1, c=2, d=9) == ()


@pytest.mark.parametrize("wrong", [0, -1, math.nan, math.inf, "2", None, True, 1 + 2j, 10**400, [3]])
def test_no_length_but_a_positive_number(wrong):
    with pytest.raises(LinkageError, match=r"b .*must"):
        grashof(1, wrong, 2, 3)


def test_wrong_calls_say_what_is_needed():
    with pytest.raises(LinkageError, match="must be a, b or c, not 'd'"):
        turning_ranges("d", a=1, b=2, c=3)
    with pytest.raises(LinkageError, match="exactly one of a, b, c, d must be left out, not none"):
        types_along(a=1, b=2, c=3, d=4)
    with pytest.raises(LinkageError, match="not c, d"):
        types_along(a=1, b=2)
    with pytest.raises(LinkageError, match="factor of 1e9"):
        grashof(1, 1, 1e12, 1e12)
    with pytest.raises(LinkageError, match="another unit"):
        grashof(1e-80, 1, 1, 1)
    with pytest.raises(LinkageError, match="free length must be"):
        FourBar(1, 2, 3, 4).turning_ranges("e")
