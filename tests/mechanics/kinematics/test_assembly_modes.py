"""The search for assembly modes: closed forms of dyads, groups built from a pose, honesty about what it found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.assembly_modes import (
    PIN,
    SLIDE,
    AssemblyModes,
    GroupConditions,
    conditions,
    search_modes,
)

DYAD = [(0, 1), (1, 2), (0, 2)]
# the three trusses of seven links (0 is what is known), two with a contour of four inner joints
TRUSSES = [
    [(3, 6), (0, 6), (4, 6), (2, 4), (2, 5), (0, 5), (1, 3), (1, 2), (3, 5)],
    [(0, 1), (0, 5), (0, 6), (3, 5), (2, 6), (2, 4), (3, 4), (1, 3), (1, 2)],
    [(0, 2), (2, 5), (3, 6), (3, 4), (1, 3), (1, 5), (2, 6), (4, 5), (0, 3)],
]


def assembled(
    rng: np.random.Generator, joints: Sequence[tuple[int, int]], kinds: str
) -> tuple[GroupConditions, np.ndarray]:
    """A group whose bodies 1, 2, ... (0 is what is known) lie at random, and that pose of bodies 0, 1, ..."""
    count = max(max(pair) for pair in joints)
    places = np.array([0, *(rng.uniform(-1, 1, count) + 1j * rng.uniform(-1, 1, count))])
    turns = np.exp(1j * np.array([0, *rng.uniform(-3, 3, count)]))
    rows = []
    for (one, two), kind in zip(joints, kinds, strict=True):
        point, line = complex(*rng.uniform(-1, 1, 2)), np.exp(1j * rng.uniform(-3, 3))
        far = point + (rng.uniform(-1, 1) * line if kind == "P" else 0)
        seen = [((p - places[b]) / turns[b], line / turns[b]) for b, p in ((one, point), (two, far))]
        rows.append((SLIDE if kind == "P" else PIN, one - 1, two - 1, *seen[0], *seen[1]))
    return conditions(rows), np.stack([places.real, places.imag, np.angle(turns)], axis=1)[1:]


def open_by(group: GroupConditions, pose: np.ndarray) -> float:
    """By how much the worst joint is open; 2 or more where a slide points the wrong way."""
    places, turns = np.append(pose[:, 0] + 1j * pose[:, 1], 0), np.append(np.exp(1j * pose[:, 2]), 1)
    at = places[group.owners] + turns[group.owners] * group.points
    way = turns[group.owners] * group.lines
    worst = 0.0
    for c, kind in enumerate(group.kinds):
        gap = at[2 * c + 1] - at[2 * c]
        if kind == SLIDE:
            worst = max(worst, abs(way[2 * c + 1] - way[2 * c]), abs((way[2 * c].conj() * gap).imag))
        else:
            worst = max(worst, abs(gap))
    return worst


def same(one: AssemblyModes, two: AssemblyModes, tolerance: float = 1e-7) -> bool:
    """Whether two answers hold the same poses, in the same order."""
    if one.poses.shape != two.poses.shape:
        return False
    gap = np.abs(one.poses - two.poses)
    gap[:, :, 2] = np.abs(np.exp(1j * one.poses[:, :, 2]) - np.exp(1j * two.poses[:, :, 2]))
    return bool((gap < tolerance * (1 + np.abs(one.poses).max(initial=0))).all())


def holds(modes: AssemblyModes, pose: np.ndarray) -> bool:
    """Whether a pose is among the modes."""
    turned = np.abs(np.exp(1j * modes.poses[:, :, 2]) - np.exp(1j * pose[:, 2])).max(axis=1)
    moved = np.abs(modes.poses[:, :, :2] - pose[:, :2]).max(axis=(1, 2))
    return bool(((turned < 1e-6) & (moved < 1e-6)).any())


def test_a_dyad_of_three_pins_is_the_meeting_of_two_circles() -> None:
    """Oracle: circles of radius 5 and 4 about points 6 apart meet where x = 15/4."""
    group = conditions([(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 5 + 0j, 1, 4 + 0j, 1), (PIN, 1, -1, 0j, 1, 6 + 0j, 1)])
    modes = search_modes(group)
    knee = np.exp(1j * modes.poses[:, 0, 2]) * 5
    assert knee == pytest.approx([15 / 4 - 1j * np.sqrt(25 - 225 / 16), 15 / 4 + 1j * np.sqrt(25 - 225 / 16)])
    assert modes.method == "search"
    assert not modes.exact
    assert modes.multiplicities == (1, 1)


@pytest.mark.parametrize(("kinds", "count"), [("RRP", 2), ("RPR", 2), ("PRP", 1), ("RPP", 1)])
def test_dyads_have_as_many_modes_as_their_closed_forms(kinds: str, count: int) -> None:
    """Slides do not turn around: with them allowed to, RPR would have four modes and PRP four."""
    for seed in range(5):
        order = [(0, 1), (1, 2), (0, 2)]
        group, pose = assembled(np.random.default_rng(seed), order, kinds)
        modes = search_modes(group)
        assert len(modes) == count
        assert holds(modes, pose)
        assert max(open_by(group, mode) for mode in modes.poses) < 1e-10


@pytest.mark.parametrize("truss", range(3))
@pytest.mark.parametrize("kinds", ["RRRRRRRRR", "RRPRRRPRR"])
def test_groups_of_six_bodies(truss: int, kinds: str) -> None:
    """The pose it was built from is found; modes come in pairs (real roots of a real polynomial of even degree).

    With pins only there are at most 18 (Rojas and Thomas 2011: 14, 16, 18 for the three trusses).
    """
    for seed in range(2):
        group, pose = assembled(np.random.default_rng(seed), TRUSSES[truss], kinds)
        modes = search_modes(group)
        assert holds(modes, pose)
        assert max(open_by(group, mode) for mode in modes.poses) < 1e-9
        assert len(modes) % 2 == 0
        assert len(modes) <= 18
        assert set(modes.multiplicities) == {1}


def test_another_seed_and_more_patience_find_the_same() -> None:
    group, _ = assembled(np.random.default_rng(0), TRUSSES[0], "RRRRRRRRR")
    modes = search_modes(group)
    assert len(modes) > 2
    assert same(modes, search_modes(group, seed=1, patience=60))


def test_the_same_seed_gives_the_same_answer() -> None:
    group, _ = assembled(np.random.default_rng(3), TRUSSES[1], "RRRRRRRRR")
    one, two = search_modes(group, seed=5), search_modes(group, seed=5)
    assert (one.poses == two.poses).all()
    assert (one.starts, one.hits) == (two.starts, two.hits)


def test_the_record_of_a_search() -> None:
    group, _ = assembled(np.random.default_rng(0), DYAD, "RRR")
    modes = search_modes(group, patience=10)
    assert len(modes.hits) == len(modes) == 2
    assert min(modes.hits) > 0
    assert 30 <= sum(modes.hits) <= modes.starts
    assert modes.risk == pytest.approx((2 / 3) ** sum(modes.hits))
    assert search_modes(group, most=1).starts == 1


def test_what_cannot_be_assembled_has_no_mode() -> None:
    apart = conditions([(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 1 + 0j, 1, 1 + 0j, 1), (PIN, 1, -1, 0j, 1, 6 + 0j, 1)])
    modes = search_modes(apart)
    assert modes.poses.shape == (0, 2, 3)
    assert modes.multiplicities == modes.hits == ()
    assert modes.risk == 1


def test_a_stretched_dyad_counts_twice() -> None:
    stretched = conditions([(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 2 + 0j, 1, 1 + 0j, 1), (PIN, 1, -1, 0j, 1, 3j, 1)])
    modes = search_modes(stretched)
    assert modes.multiplicities == (2,)
    assert modes.poses[0, 0, 2] == pytest.approx(np.pi / 2, abs=1e-6)


def test_what_moves_is_called_degenerate() -> None:
    """Two bars of one length on one point turn freely while they lie on one another; slides side by side always."""
    folded = conditions([(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 1 + 0j, 1, 1 + 0j, 1), (PIN, 1, -1, 0j, 1, 0j, 1)])
    assert search_modes(folded).method == "degenerate"
    parallel = conditions([(SLIDE, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 1j, 1, 1 + 0j, 1), (SLIDE, 1, -1, 0j, 1, 1j, 1)])
    assert search_modes(parallel).method == "degenerate"


GOOD = [(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, 0, 1, 2 + 0j, 1, 0j, 1), (PIN, 1, -1, 2 + 0j, 1, 2j, 1)]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ((2, -1, 0, 0j, 1, 0j, 1), "PIN"),
        ((PIN, 0, 0, 0j, 1, 0j, 1), "between two bodies"),
        ((PIN, -2, 0, 0j, 1, 0j, 1), "between two bodies"),
        ((PIN, -1, 0.5, 0j, 1, 0j, 1), "between two bodies"),
        ((PIN, -1, 0, "0", 1, 0j, 1), "finite"),
        ((PIN, -1, 0), "a point and a direction"),
        ((PIN, -1, 7, 0j, 1, 0j, 1), "without gaps"),
        ((PIN, -1, 0, complex("nan"), 1, 0j, 1), "finite"),
        ((PIN, -1, 0, 0j, 1, complex("inf"), 1), "finite"),
        ((SLIDE, -1, 0, 0j, 0j, 0j, 1), "other than 0"),
    ],
)
def test_unsound_conditions_are_refused(change: tuple, words: str) -> None:
    with pytest.raises(LinkageError, match=words):
        conditions([change, *GOOD[1:]])


def test_other_wrong_calls_are_refused() -> None:
    with pytest.raises(LinkageError, match="joints of one freedom, not 2"):
        conditions(GOOD[:2])
    with pytest.raises(LinkageError, match="there is one"):
        conditions([])
    with pytest.raises(LinkageError, match="at least 1"):
        search_modes(conditions(GOOD), patience=0)
