"""Assembly modes of groups of four bodies: figures of the literature, a scan, the search, laws, special dimensions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.assembly_modes import (
    PIN,
    SLIDE,
    AssemblyModes,
    GroupConditions,
    conditions,
    search_modes,
)
from gruebler.mechanics.kinematics.triads import BOUNDS, all_modes, is_triad, triad_modes
from tests.mechanics.kinematics.test_assembly_modes import TRUSSES, assembled, holds, open_by, same

JOINTS = [(0, 2), (2, 1), (0, 3), (3, 1), (0, 4), (4, 1)]  # base 0, hub 1, legs 2 to 4
Points = Sequence[complex]


def of_legs(forms: Sequence[str], seed: int) -> tuple[GroupConditions, np.ndarray]:
    """A triad with legs of these forms, built from a random pose."""
    return assembled(np.random.default_rng(seed), JOINTS, "".join(forms))


def seen_from(group: GroupConditions, pose: np.ndarray, known: int) -> tuple[GroupConditions, np.ndarray]:
    """The same bodies in the same pose, another of them known instead: class IV if that is a leg."""
    poses = np.vstack([pose, np.zeros(3)])
    turn = np.exp(-1j * poses[known, 2])
    places = (poses[:, 0] + 1j * poses[:, 1] - complex(*poses[known, :2])) * turn
    moved = np.stack([places.real, places.imag, poses[:, 2] - poses[known, 2]], axis=1)
    names = np.arange(5)
    names[[known, 4]] = -1, known
    order = np.arange(4)
    order[known] = 4
    return group._replace(owners=names[group.owners]), moved[order]


def three_bars(base: Points, hub: Points, lengths: Sequence[float]) -> GroupConditions:
    rows = []
    for k in range(3):
        rows += [(PIN, -1, k + 1, base[k], 1, 0j, 1), (PIN, k + 1, 0, complex(lengths[k]), 1, hub[k], 1)]
    return conditions(rows)


def three_bars_at(base: Points, hub: Points, place: complex, angle: float) -> GroupConditions:
    return three_bars(base, hub, [abs(place + np.exp(1j * angle) * h - a) for a, h in zip(base, hub, strict=True)])


# literature ----------------------------------------------------------------------------------------------------------


def known_platform() -> GroupConditions:
    """Base 15.91 and 10, platform 17.04, 16.54, 20.84: the example on which many works on 3-RPR robots compute."""
    x = (17.04**2 + 20.84**2 - 16.54**2) / (2 * 17.04)
    platform = (0j, 17.04 + 0j, complex(x, np.sqrt(20.84**2 - x * x)))
    return three_bars((0j, 15.91 + 0j, 10j), platform, (14.98, 15.38, 12.0))


def test_three_bars_can_have_six_real_modes() -> None:
    """Six is the most (Hunt 1983; Gosselin and Sefrioui 1991); with these sizes it is reached."""
    group = known_platform()
    modes = triad_modes(group)
    assert len(modes) == modes.bound == 6
    assert modes.exact
    assert max(open_by(group, pose) for pose in modes.poses) < 1e-12


def test_directly_similar_platforms_have_at_most_four() -> None:
    """Gosselin and Merlet 1994: a quadratic equation for a cosine, two angles for each."""
    base = (0j, 4 + 0j, 1 + 3j)
    counts = set()
    for seed in range(30):
        rng = np.random.default_rng(seed)
        ratio = complex(*rng.uniform(-1, 1, 2))
        place = complex(*rng.uniform(-4, 4, 2))
        counts.add(len(triad_modes(three_bars_at(base, [ratio * a for a in base], place, rng.uniform(-3, 3)))))
    assert counts == {2, 4}


# oracles and rivals --------------------------------------------------------------------------------------------------


def scanned(group: GroupConditions, steps: int = 40_000) -> list[float]:
    """Angles of the hub (body 0) for which the third leg fits where circles of the first two meet; by sign changes."""

    def miss(angle: np.ndarray, side: int) -> np.ndarray:
        ends = {}
        for slot, (body, point, line) in enumerate(zip(group.owners, group.points, group.lines, strict=True)):
            ends[slot // 2, int(body)] = point, line
        turn = np.exp(1j * angle)
        centres, radii = [], []
        for leg in (1, 2):
            (base, _), (near, _) = ends[2 * leg - 2, -1], ends[2 * leg - 2, leg]
            (far, _), (hub, _) = ends[2 * leg - 1, leg], ends[2 * leg - 1, 0]
            centres.append(base - turn * hub)
            radii.append(abs(far - near))
        gap = centres[1] - centres[0]
        along = (abs(gap) ** 2 + radii[0] ** 2 - radii[1] ** 2) / (2 * abs(gap))
        with np.errstate(invalid="ignore"):
            place = centres[0] + gap / abs(gap) * (along + 1j * side * np.sqrt(radii[0] ** 2 - along**2))
        (base, u), (near, outer) = ends[4, -1], ends[4, 3]
        (far, inner), (hub, m) = ends[5, 3], ends[5, 0]
        pin = place + turn * hub
        if group.kinds[4] == SLIDE:
            return (np.conj(u) * (pin - (base + u / outer * (far - near)))).imag
        if group.kinds[5] == SLIDE:
            return (np.conj(turn * m) * (pin - (base + turn * m / inner * (far - near)))).imag
        return abs(pin - base) - abs(far - near)

    grid = np.linspace(-np.pi, np.pi, steps + 1)
    found = []
    for side in (1, -1):
        values = miss(grid, side)
        for k in np.flatnonzero(values[:-1] * values[1:] < 0):
            low, high = grid[k], grid[k + 1]
            for _ in range(50):
                middle = (low + high) / 2
                low, high = (middle, high) if miss(middle, side) * miss(low, side) > 0 else (low, middle)
            found.append(low)
    return sorted(found)


@pytest.mark.parametrize("third", ["RR", "PR", "RP"])
def test_a_scan_of_the_hub_angle_finds_the_same(third: str) -> None:
    for seed in range(5):
        group, _ = of_legs(("RR", "RR", third), seed)
        angles = triad_modes(group).poses[:, 0, 2]
        assert sorted(angles) == pytest.approx(scanned(group), abs=1e-9)


@pytest.mark.parametrize("forms", BOUNDS, ids="+".join)
def test_the_search_finds_the_same(forms: tuple[str, ...]) -> None:
    group, pose = of_legs(forms, 0)
    for known in range(-1, 4):
        turned, _ = (group, pose) if known < 0 else seen_from(group, pose, known)
        assert same(triad_modes(turned), search_modes(turned))


@pytest.mark.parametrize("forms", BOUNDS, ids="+".join)
def test_every_bound_is_reached_by_real_modes(forms: tuple[str, ...]) -> None:
    counts = [len(triad_modes(of_legs(forms, seed)[0])) for seed in range(60)]
    assert max(counts) == BOUNDS[forms]
    if BOUNDS[forms] > 1:
        assert all(count % 2 == 0 for count in counts)


# laws ----------------------------------------------------------------------------------------------------------------

mixes = st.sampled_from(sorted(BOUNDS)).flatmap(st.permutations)
seeds = st.integers(0, 2**32)


@settings(max_examples=40)
@given(forms=mixes, seed=seeds, known=st.integers(-1, 3))
def test_the_pose_it_was_built_from_is_found(forms: list[str], seed: int, known: int) -> None:
    group, pose = of_legs(forms, seed)
    if known >= 0:
        group, pose = seen_from(group, pose, known)
    modes = triad_modes(group)
    assert holds(modes, pose)
    assert modes.bound is not None
    assert sum(modes.multiplicities) <= modes.bound
    reach = 1 + np.abs(modes.poses).max()
    assert max(open_by(group, mode) for mode in modes.poses) < 1e-10 * reach


@settings(max_examples=40)
@given(forms=mixes, seed=seeds, turn=st.floats(-3, 3), x=st.floats(-50, 50), scale=st.floats(1e-3, 1e3))
def test_a_moved_and_enlarged_base_moves_and_enlarges_the_modes(
    forms: list[str], seed: int, turn: float, x: float, scale: float
) -> None:
    group, _ = of_legs(forms, seed)
    factor, shift = np.exp(1j * turn), complex(x, 7)
    known = group.owners == -1
    points = scale * np.where(known, factor * group.points + shift, group.points)
    moved = group._replace(points=points, lines=np.where(known, factor * group.lines, group.lines))
    one, two = triad_modes(group), triad_modes(moved)
    assert len(one) == len(two)
    for pose in one.poses:
        places = scale * (factor * (pose[:, 0] + 1j * pose[:, 1]) + shift)
        wanted = np.stack([places.real / scale, places.imag / scale, pose[:, 2] + turn], axis=1)
        reach = 1 + np.abs(pose[:, :2]).max()
        assert min(np.abs(wanted[:, :2] - p[:, :2] / scale).max() for p in two.poses) < 1e-6 * reach


@settings(max_examples=40)
@given(forms=mixes, seed=seeds, names=st.permutations(range(4)))
def test_the_numbers_of_the_bodies_do_not_matter(forms: list[str], seed: int, names: list[int]) -> None:
    group, _ = of_legs(forms, seed)
    renamed = triad_modes(group._replace(owners=np.array([*names, -1])[group.owners]))
    modes = triad_modes(group)
    assert len(modes) == len(renamed)
    assert all(holds(modes, pose[names]) for pose in renamed.poses)


@settings(max_examples=40)
@given(seed=seeds, known=st.integers(0, 3))
def test_one_truss_has_as_many_modes_whatever_is_known(seed: int, known: int) -> None:
    group, pose = of_legs(("RR", "RR", "RR"), seed)
    turned, seat = seen_from(group, pose, known)
    one, two = triad_modes(group), triad_modes(turned)
    assert len(one) == len(two)
    assert all(holds(two, seen_from(group, mode, known)[1]) for mode in one.poses)
    assert holds(two, seat)


# special dimensions --------------------------------------------------------------------------------------------------

TRIANGLE = (0j, 4 + 0j, 1 + 3j)
LINE = (0j, 1 + 0j, 3 + 0j)


def concurrent(parts: Sequence[float], stretch: float = 0.0) -> GroupConditions:
    """Bars that lie on lines through the point 1 + 2i: a singular pose. The first bar is longer by a ratio."""
    pins = [a + part * (1 + 2j - a) for a, part in zip(TRIANGLE, parts, strict=True)]
    lengths = [abs(p - a) for p, a in zip(pins, TRIANGLE, strict=True)]
    return three_bars(TRIANGLE, pins, [lengths[0] * (1 + stretch), *lengths[1:]])


def test_a_singular_pose_counts_twice() -> None:
    modes = triad_modes(concurrent((0.5, 0.3, 0.4)))
    assert modes.multiplicities == (2,)
    assert modes.exact
    assert np.abs(modes.poses[0, 0]).max() < 1e-6


@pytest.mark.parametrize("stretch", [1e-3, 1e-6, 1e-9])
def test_near_a_singular_pose_there_are_two_modes_or_none(stretch: float) -> None:
    """The two are apart by about the square root of the stretch."""
    two = triad_modes(concurrent((0.5, 0.3, 0.4), stretch))
    assert two.multiplicities == (1, 1)
    assert 0.1 < np.abs(two.poses[0] - two.poses[1]).max() / np.sqrt(stretch) < 10
    assert len(triad_modes(concurrent((0.5, 0.3, 0.4), -stretch))) == 0


def test_multiplicities_are_counted_with_the_bound() -> None:
    modes = triad_modes(concurrent((1.5, 0.3, -0.4)))
    assert sorted(modes.multiplicities) == [1, 1, 2]


SPECIAL = {
    "collinear": three_bars_at(LINE, (0j, 2 + 0j, 3 + 0j), 1 + 1j, 0.5),
    "collinear and similar": three_bars_at(LINE, [0.6 * a for a in LINE], 1 + 1j, 0.5),
    "collinear and congruent": three_bars_at(LINE, LINE, 1 + 1j, 0.5),
    "congruent": three_bars_at(TRIANGLE, TRIANGLE, 1 + 1j, 0.5),
    "mirrored": three_bars_at(TRIANGLE, [a.conjugate() for a in TRIANGLE], 1 + 1j, 0.5),
    "two pins of the hub in one place": three_bars_at(TRIANGLE, (0j, 0j, 2 + 0j), 1 + 1j, 0.5),
    "two pins of the base in one place": three_bars_at((0j, 0j, 2 + 0j), TRIANGLE, 1 + 1j, 0.5),
    "two circles fall together": three_bars(
        (-0.2 - 1j / 15, 0.2 + 1j / 3, -4 / 15 + 0j),
        (-1 / 15 - 0.2j, -1 / 15 + 0.2j, 2 / 15 + 0j),
        (np.sqrt(0.52), np.sqrt(0.2), np.sqrt(0.52)),
    ),
    "modes at one angle": three_bars((0j, -2 + 0j, 2 + 0j), (0j, -1 + 0j, 1 + 0j), (2.0, np.sqrt(5), np.sqrt(5))),
}


@pytest.mark.parametrize("name", SPECIAL)
def test_special_dimensions_against_the_search(name: str) -> None:
    modes = triad_modes(SPECIAL[name])
    assert modes.exact
    assert len(modes) > 0
    assert same(modes, search_modes(SPECIAL[name]), 1e-5)


def sliding(angles: Sequence[float], forms: str) -> GroupConditions:
    """Legs with slides of given directions, at the pose 0.3 + 1i, 0.4 of the hub."""
    turn, rows = np.exp(0.4j), []
    for k, (form, angle) in enumerate(zip(forms.split("+"), angles, strict=True)):
        hub, u = (0j, 2 + 0j, 1 + 1j)[k], np.exp(1j * angle)
        pin = 0.3 + 1j + turn * hub
        if form == "RR":
            rows += [(PIN, -1, k + 1, TRIANGLE[k], 1, 0j, 1), (PIN, k + 1, 0, abs(pin - TRIANGLE[k]), 1, hub, 1)]
        elif form == "PR":
            rows += [(SLIDE, -1, k + 1, pin + 1.3 * u, u, 0j, u), (PIN, k + 1, 0, 0j, 1, hub, 1)]
        elif form == "RP":
            rows += [(PIN, -1, k + 1, TRIANGLE[k], 1, 0j, 1), (SLIDE, k + 1, 0, pin - TRIANGLE[k], u, hub, u / turn)]
        else:
            rows += [(SLIDE, -1, k + 1, pin, u, 0j, u), (SLIDE, k + 1, 0, 0j, 1j * u, hub, 1j * u / turn)]
    return conditions(rows)


@pytest.mark.parametrize(
    ("forms", "angles"),
    [
        ("PR+PR+RR", (0.3, 0.3, 0)),
        ("PR+PR+RR", (0.3, 0.3 + np.pi, 0)),
        ("PR+PR+RP", (0.3, 0.3, 1)),
        ("RP+RP+RR", (0.3, 0.3, 1)),
        ("RP+RP+PR", (0.3, 0.3, 1)),
        ("PP+PR+RR", (0.3, 0.3, 1)),
    ],
)
def test_parallel_slides_against_the_search(forms: str, angles: tuple[float, ...]) -> None:
    modes = triad_modes(sliding(angles, forms))
    assert modes.exact
    assert holds(modes, modes.poses[0])
    assert same(modes, search_modes(sliding(angles, forms)))


@pytest.mark.parametrize(
    "group",
    [
        three_bars(TRIANGLE, TRIANGLE, (2, 2, 2)),
        three_bars(TRIANGLE, TRIANGLE, (2, 0, 2)),
        sliding((0.3, 0.3, 0.3), "PR+PR+PR"),
        sliding((0.3, 0.3, 0.3), "RP+RP+RP"),
        sliding((0.3, 0.7, 0.7), "PP+PR+PR"),
    ],
    ids=["parallelogram", "a bar of no length", "three parallel slides", "three parallel guides", "hub held, parallel"],
)
def test_what_moves_is_called_degenerate(group: GroupConditions) -> None:
    assert triad_modes(group).method == "degenerate"
    assert search_modes(group).method == "degenerate"


def test_beside_its_motion_a_parallelogram_has_two_rigid_modes() -> None:
    modes = triad_modes(three_bars(TRIANGLE, TRIANGLE, (2, 2, 2)))
    assert len(modes) == 2
    assert np.abs(np.sin(modes.poses[:, 0, 2])).min() > 0.1


def test_what_cannot_be_assembled_has_no_mode() -> None:
    modes: AssemblyModes = triad_modes(three_bars(TRIANGLE, (0j, 1 + 0j, 1j), (1, 0.1, 10)))
    assert modes.poses.shape == (0, 4, 3)
    assert modes.exact


# doors ---------------------------------------------------------------------------------------------------------------


def test_other_groups_are_refused_or_searched() -> None:
    group, pose = assembled(np.random.default_rng(0), TRUSSES[0], "RRRRRRRRR")
    assert not is_triad(group)
    with pytest.raises(LinkageError, match="four bodies"):
        triad_modes(group)
    modes = all_modes(group)
    assert modes.method == "search"
    assert holds(modes, pose)
    assert all_modes(known_platform()).method == "exact"


def test_two_legs_that_slide_at_both_ends_are_refused() -> None:
    with pytest.raises(LinkageError, match="angle of the hub twice"):
        triad_modes(sliding((0.3, 0.7, 1), "PP+PP+RR"))


def test_four_bodies_that_are_two_dyads_are_no_triad() -> None:
    group, _ = assembled(np.random.default_rng(1), [(0, 1), (1, 2), (0, 2), (1, 3), (3, 4), (2, 4)], "RRRRRR")
    assert not is_triad(group)
