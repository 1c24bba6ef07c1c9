"""Realisation: what it finds moves as it says, and where nothing moves it says so."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import Mechanism, Requirements, chains, driven_mechanisms, inversions, variants
from gruebler.base.errors import LinkageError
from gruebler.base.text import number
from gruebler.design.realisation import realise, realise_all, with_drives
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Line
from gruebler.structure.enumeration.worker_pool import ProcessPools

FOUR = "R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)"
TURNING = (
    FOUR,
    "R(0-1) R(1-2) R(2-3) P(3-0); drive=R(0-1)",
    "R(0-1) R(1-2) P(2-3) R(3-0); drive=R(0-1)",
    "R(0-1) R(1-2) P(2-3) P(3-0); drive=R(0-1)",
    "R(0-1) P(1-2) R(2-3) R(3-0); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2); drive=R(0-1)",
    "R(0-1) R(1-2-3) R(2-4) R(3-5) P(0-4) P(0-5); drive=R(0-1)",
    "R(0-1) G(1-2) R(2-0); drive=R(0-1)",
    "P(0-2) R(2-1) R(0-3) R(3-1) R(0-4) R(4-5) R(5-1); frame=5; drive=R(5-1)",
    "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)",
)
SWINGING = (
    "R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)",
    "R(0-1) R(1-2) R(2-3) P(3-0); drive=P(3-0)",
    "R(0-1) R(1-2) P(2-3) P(3-0); drive=P(3-0)",
)
SEVERAL = ("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive=R(0-1); drive=R(4-0)",)


def check(found):
    """What a result claims is true of its linkage."""
    assert found.found, found.explain()
    motion = move(found.linkage, found.path(721), order=1)
    assert motion.complete, motion.message()
    assert motion.closure_error < 1e-12
    least = np.abs(motion.roots).min(initial=1.0)
    assert least > 0.02
    if found.full:
        assert np.allclose(motion.places[0, -1], motion.places[0, 0], atol=1e-6)
        assert np.allclose(motion.turns[-1], motion.turns[0], atol=1e-8)
        for low, high in found.ranges:
            assert high - low == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("text", TURNING)
def test_turning_drives_turn_fully(text):
    found = realise(Mechanism.parse(text), budget=600)
    assert found.full, found.explain()
    check(found)


@pytest.mark.parametrize("text", SWINGING)
def test_sliding_drives_have_a_stroke(text):
    found = realise(Mechanism.parse(text), budget=300)
    check(found)
    (low, high), *_ = found.ranges
    assert high - low > 0.2 * found.linkage.size


@pytest.mark.parametrize("text", SEVERAL)
def test_several_drives_move_at_once(text):
    found = realise(Mechanism.parse(text), budget=300)
    check(found)
    assert found.full


def test_same_seed_same_linkage():
    mechanism = Mechanism.parse(TURNING[5])
    one, other = (realise(mechanism, seed=7, budget=150) for _ in range(2))
    assert one == other
    assert one.linkage != realise(mechanism, seed=8, budget=150).linkage


@settings(max_examples=8)
@given(st.integers(0, 2**32 - 1))
def test_four_bars_are_crank_rockers_or_double_cranks(seed):
    """Rival: Grashof's theorem on the lengths found."""
    found = realise(Mechanism.parse(FOUR), seed=seed, budget=100)
    check(found)
    a, b, c = (
        found.linkage.length(link, 0 if link == "1" else 2, 1 if link == "1" else 1 if link == "2" else 3)
        for link in "123"
    )
    lengths = sorted([a, b, c, found.linkage.length("0", 0, 3)])
    assert lengths[0] + lengths[3] < lengths[1] + lengths[2]
    assert lengths[0] in (a, found.linkage.length("0", 0, 3))


def test_sizes_are_sensible():
    found = realise(Mechanism.parse(TURNING[6]), budget=400)
    numbers = [v for e in found.linkage.elements.values() for v in (e.x, e.y)]
    assert all(abs(v) < 150 and round(v, 3) == v for v in numbers)
    assert found.linkage.size == pytest.approx(100, rel=0.05)
    angles = [np.degrees(e.angle) for e in found.linkage.elements.values() if isinstance(e, Line)]
    assert np.allclose(angles, np.round(angles, 2))
    home = np.degrees(found.linkage.reference_pose["1"].angle)
    assert home == pytest.approx(round(home), abs=1e-6)


def test_drives_are_chosen():
    assert with_drives(Mechanism.parse("P(0-1) R(1-2) R(2-3) R(3-0)")).drive_names() == ("R(3-0)",)
    assert len(with_drives(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")).drives) == 2
    check(realise(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), budget=100))


@pytest.mark.parametrize(
    "text",
    [
        "R(0-1) R(1-2) R(2-0)",
        "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive=R(0-1)",
        "R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1); drive=R(3-0)",
        "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-2); drive=R(0-1)",
    ],
)
def test_what_cannot_move_is_said(text):
    found = realise(Mechanism.parse(text))
    assert not found.found
    assert found.tries == 0
    assert found.explain("en")
    assert found.explain("de")
    assert found.explain("en") != found.explain("de")
    with pytest.raises(LinkageError, match="no motion"):
        found.path()


def test_a_spent_budget_is_said():
    """One drawing in each of the three searches, none of which moves; with more drawings it is found."""
    mechanism = Mechanism.parse(TURNING[6])
    found = realise(mechanism, budget=1, seed=15)
    assert not found.found
    assert found.linkage is None
    assert re.search(r"3 layouts tried \(seed 15\)", found.explain())
    assert "3 Entwürfe" in found.explain("de")
    check(realise(mechanism, budget=600, seed=15))


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        ("R(0-1) rolling(1-2) R(2-0); drive=R(0-1)", {}, "rolling"),
        (FOUR, {"seed": -1}, "seed"),
        (FOUR, {"seed": 1.5}, "seed"),
        (FOUR, {"budget": 0}, "budget"),
        (FOUR, {"target_quality": 0}, "target_quality"),
        (FOUR, {"target_quality": float("nan")}, "target_quality"),
    ],
)
def test_wrong_calls(text, options, message):
    with pytest.raises(LinkageError, match=message):
        realise(Mechanism.parse(text), **options)


@pytest.mark.slow
@pytest.mark.parametrize("links", [6, 8])
def test_all_inversions_turn_fully(links):
    mechanisms = [m for chain in chains(links) for m in inversions(chain)]
    assert len(mechanisms) == {6: 5, 8: 71}[links]
    for mechanism in mechanisms:
        found = realise(mechanism)
        check(found)
        assert found.full, mechanism


@pytest.mark.slow
def test_one_slider_variants_move():
    for chain in variants(Requirements(6, prismatic=1)):
        for driven in driven_mechanisms(chain, fixed_only=True):
            found = realise(driven.mechanism)
            check(found)
            assert found.full == driven.mechanism.drives[0].turning


@pytest.mark.parametrize("text", SWINGING)
def test_the_range_is_that_of_the_measures(text):
    found = realise(Mechanism.parse(text), budget=300)
    span = measures(found.linkage).span
    assert (found.span.low, found.span.high) == (span.low, span.high)
    (low, high), *_ = found.ranges
    assert span.low <= low < high <= span.high
    assert f"moves from {span.low:.4g} to {span.high:.4g} mm. It is well conditioned" in found.explain()
    ends = [number(end, "de", ".4g") for end in (span.low, span.high)]
    assert f"von {ends[0]} bis {ends[1]} mm. Gut konditioniert" in found.explain("de")


def test_processes_realise_the_same():
    mechanisms = [Mechanism.parse(text) for text in (FOUR, TURNING[1], "R(0-1) R(1-2) R(2-0)")]
    here = [realise(mechanism, seed=3, budget=40) for mechanism in mechanisms]
    assert [each.found for each in here] == [True, True, False]
    there = list(realise_all(mechanisms, executor=ProcessPools(2), seed=3, budget=40))
    assert [each.linkage for each in there] == [each.linkage for each in here]
    assert [each.explain("de") for each in there] == [each.explain("de") for each in here]
