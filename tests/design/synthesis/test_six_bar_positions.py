"""Six-bars that carry a body through six positions: against six-bars chosen first, and by a motion of its own."""

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PositionTask, SixBarType, synthesise
from gruebler.design.synthesis.alt_burmester import (
    PROBLEMS,
    GenericSolutions,
    load_generic_solutions,
    parameters,
    solutions,
)
from gruebler.design.synthesis.dyads import Displacements, all_dyads
from gruebler.design.synthesis.six_bar_census import EIGHT_POSITIONS, SEVEN_POSITIONS, Census
from gruebler.design.synthesis.six_bar_guidance import random_guides
from gruebler.design.synthesis.six_bar_monodromy import Search, follow, on_special_plane, trace
from gruebler.design.synthesis.six_bar_positions import FIVE_POSITIONS, ONE_ANGLE, SIX_POSITIONS, keeps_sides
from gruebler.mechanics.kinematics import move

PINS = np.array([-1.5, -0.64 + 0.48j, 1.16 - 0.45j, 0, -0.46 - 0.77j, 1.2 - 0.94j, -0.32 - 1.45j])  # A C D B H G F


def crossing(first, r, second, s, near):
    """Where circles meet, the point next to another one. By hand."""
    gap = second - first
    along = (abs(gap) ** 2 + r**2 - s**2) / (2 * abs(gap))
    across = np.sqrt(r**2 - along**2)
    return min((first + gap / abs(gap) * (along + side * across * 1j) for side in (1, -1)), key=lambda z: abs(z - near))


def moved(pins, crank, steps=200):
    """(A, C, D, B, H, G, F) after the crank has turned by an angle, in small steps from circle to circle."""
    a, c0, d0, b, h0, g0, f0 = pins
    c, d, g = c0, d0, g0
    for turn in np.exp(1j * np.linspace(0, crank, steps + 1)):
        c = a + (c0 - a) * turn
        d = crossing(c, abs(d0 - c0), b, abs(d0 - b), d)
        h, f = c + (h0 - c0) * (d - c) / (d0 - c0), b + (f0 - b) * (d - b) / (d0 - b)
        g = crossing(h, abs(g0 - h0), f, abs(g0 - f0), g)
    return np.array([a, c, d, b, h, g, f])


def positions_of(pins, angles):
    """The positions of the body at crank angles, its origin at 0.5 + 0.25i."""
    rows = []
    for angle in angles:
        *_, h, g, _ = moved(pins, angle)
        turn = (g - h) / (pins[5] - pins[4])
        origin = h + turn * (0.5 + 0.25j - pins[4])
        rows.append((origin.real, origin.imag, float(np.angle(turn))))
    return rows


def task_of():
    return PositionTask(positions_of(PINS, np.linspace(0, 2.5, 6)), fixed_pivots=((-1.5, 0), (0, 0)))


def solution_of(wanted):
    """The six-bar of these pins, c, d, f, G, H, B - A, B, and a task of its positions, in the size of the task."""
    origin = wanted.fixed_pivots[-1] if wanted.fixed_pivots else wanted.positions[0][:2]
    a, c, d, b, h, g, f = PINS - complex(*origin)
    origins = wanted.origins - complex(*origin)
    shifts = origins - wanted.turns * origins[0]
    frame = b - a if len(wanted.fixed_pivots) == 2 else 0
    size = max(abs(frame), np.abs(shifts).max())
    numbers = np.array([(c - d) / (h - d), *np.array([d - b, f - b, g, h, b - a, b]) / size])
    z, poses = np.stack([numbers, np.conj(numbers)], axis=1).ravel(), len(wanted) - 1
    task = np.zeros((4, 10 if frame else 14), complex)
    task[0, :poses], task[1, :poses] = wanted.turns[1:], shifts[1:] / size
    task[2] = np.conj(task[1])
    task[3, :4] = z[10:] if frame else 0
    return z[None, : task.shape[1]], task


@pytest.mark.parametrize("problem", [SIX_POSITIONS, ONE_ANGLE], ids=lambda problem: problem.name)
def test_every_six_bar_is_among_the_generic_solutions(problem):
    """Carried to the generic task each of sixty ends at a stored one: if a tenth were missing, 1 in 500 would pass."""
    base, rng = load_generic_solutions(problem), np.random.default_rng(3)
    assert len(base.z) == problem.classes
    arrived = 0
    for z, task in zip(*random_guides(rng, 60, 5, tilted=False, one_angle=problem.one_angle), strict=True):
        end, good = follow(problem, z[None], task, base.parameters)
        if good[0]:
            arrived += 1
            assert np.abs(base.z - end).max(axis=1).min() < 1e-6 * (1 + np.abs(end).max())
    assert arrived > 55


def test_six_positions_of_a_six_bar_find_it_again(monkeypatch):
    """Beside a few others that start from the same task; what is found is moved once more, from circle to circle."""
    base = load_generic_solutions(SIX_POSITIONS)
    z, task = solution_of(task_of())
    own, good = follow(SIX_POSITIONS, z, task, base.parameters)
    assert good.all()
    few = GenericSolutions(base.parameters, np.concatenate([base.z[:40], own]))
    monkeypatch.setattr("gruebler.design.synthesis.six_bar_positions.load_generic_solutions", lambda _: few)
    wanted = task_of()
    found = synthesise(wanted, six_bars=True, demands=Demands(size_ratio=1e6))
    lengths = [design.linkage.length("crank", 0, 1) for design in found.designs]
    assert min(abs(length - abs(PINS[1] - PINS[0])) for length in lengths) < 1e-8
    for design in found.designs:
        if design.linkage.mechanism.drives[0].between == ("frame", "crank"):
            motion = move(design.linkage, design.drives[:1])
            pins = np.concatenate(
                [motion.complex_point(joint) for joint in design.linkage.mechanism.chain.joint_names()]
            )
            turned = np.array(design.drives) - design.drives[0]
            assert np.array(positions_of(pins, turned)) == pytest.approx(np.array(wanted.positions), abs=1e-7)


@pytest.mark.parametrize(
    ("count", "angle", "pivots"), [(6, 0.0, [(-1.5, -1), (1, -0.5)]), (6, 1.1, [(-1.5, -1), (1, -0.5)]),
                                   (7, 0.4, [(-1.5, -1)]), pytest.param(8, 0.4, [], marks=pytest.mark.slow)]
)  # fmt: skip
def test_positions_of_one_angle_are_passed_without_any_turn(count, angle, pivots):
    """Six took 77 s for one design, seven and eight found none. `move` carries the body; its angle stays."""
    x = np.linspace(-1.2, 1.2, count)
    places = np.stack([x, 0.3 * x + 0.2 * x**2], axis=1)
    task = PositionTask([(*place, angle) for place in places], fixed_pivots=pivots)
    found = synthesise(task, six_bars=True)
    assert len(found.designs) > 10
    for design in found.designs[:10]:
        motion = move(design.linkage, np.linspace(design.drives[0], design.drives[-1], 200))
        assert motion.complete
        assert np.ptp(motion.angle("body")) < 1e-9
        assert move(design.linkage, design.drives).point("P") == pytest.approx(places, abs=1e-9)
        frame = [(e.x, e.y) for (_, link), e in design.linkage.elements.items() if link == "frame"]
        assert np.ravel(frame[2 - len(pivots) :]) == pytest.approx(np.ravel(pivots), abs=1e-12)


def test_six_positions_of_one_angle_of_a_six_bar_that_turns_find_it_again(monkeypatch):
    """Where no six-bar that keeps the angle is accepted. It has six such positions, as the theory says it may have.

    They are sought by changes of sign as its rocker turns, with the coupler on either side.
    """
    monkeypatch.setattr("gruebler.design.synthesis.six_bar_positions._SHIFTING", 0)
    a, d, f, h, g = -0.574 + 0.129j, -0.742 - 0.137j, -0.357 - 0.924j, -0.341 + 0.098j, 0.058 - 0.119j
    c = d + (-1.891 + 0.253j) * (h - d)
    crank = abs(c - a)

    def pin_and_miss(turn, side):
        """H, and by how much the link F-G would be longer if the body had its first angle."""
        pin = d * turn
        gap = a - pin
        along = (abs(gap) ** 2 + abs(c - d) ** 2 - crank**2) / (2 * abs(gap))
        across = np.emath.sqrt(abs(c - d) ** 2 - along**2)
        if isinstance(across, complex):
            return np.nan, np.nan
        end = pin + (h - d) / (c - d) * gap / abs(gap) * (along + side * across * 1j)
        return end, abs(end + g - h - f * turn) - abs(g - f)

    places = []
    for side in (1, -1):
        angles = np.linspace(1e-3, 2 * np.pi + 1e-3, 4001)
        misses = np.array([pin_and_miss(np.exp(1j * angle), side)[1] for angle in angles])
        for k in np.flatnonzero(misses[:-1] * misses[1:] < 0):
            low, high = angles[k], angles[k + 1]
            for _ in range(60):
                middle = (low + high) / 2
                same = pin_and_miss(np.exp(1j * middle), side)[1] * misses[k] > 0
                low, high = (middle, high) if same else (low, middle)
            places.append(pin_and_miss(np.exp(1j * low), side)[0])
    assert len(places) == 6
    places.sort(key=lambda place: abs(place - h))
    task = PositionTask([(z.real, z.imag, 0.0) for z in places], fixed_pivots=((a.real, a.imag), (0, 0)))
    found = synthesise(task, six_bars=True, demands=Demands(size_ratio=1e6, one_branch=False, in_order=False))
    assert found.count.found > 860
    lengths = [design.linkage.length("crank", 0, 1) for design in (*found.designs, *found.rejected)]
    assert min(abs(length - crank) for length in lengths) < 1e-6


def test_five_positions_have_as_many_as_two_theorems_say():
    """36 four-bars lead the pin through five points; each rocker carries four dyads of Burmester's, one the pin's own.

    The four-bars from the solved problem of five points and two pivots, the dyads in closed form.
    """
    positions = positions_of(PINS, np.linspace(0, 2.5, 5))
    pin = PINS[4].real, PINS[4].imag
    wanted = PositionTask(positions, fixed_pivots=((-1.5, 0), (0, 0)), moving_pivots=(pin,))
    found = synthesise(wanted, six_bars=True, demands=Demands(size_ratio=1e6))
    assert found.count.found == FIVE_POSITIONS.classes == 36 * 3
    turns, shifts = wanted.turns[1:], (wanted.origins - wanted.turns * wanted.origins[0])[1:]
    places = turns * PINS[4] + shifts
    number = 0
    for z in solutions(PROBLEMS[-1], parameters(places - PINS[4], turns[:0], (-1.5 - PINS[4], -PINS[4]))).real:
        c, d = z[[0, 2]] + PINS[4]
        # From the crank's and the coupler's length, both linear in the rocker's turn and its conjugate.
        ratio, rows = (c - d) / (PINS[4] - d), []
        for w, arm, first in ((places, -d, PINS[4] - d), (1.5 + ratio * places, (1 - ratio) * d, c + 1.5)):
            rows.append((arm * np.conj(w), abs(first) ** 2 - abs(arm) ** 2 - np.abs(w) ** 2))
        (p, k), (q, m) = rows
        rocker = (k * np.conj(q) - m * np.conj(p)) / (p * np.conj(q) - np.conj(p) * q)
        assert np.abs(rocker) == pytest.approx(1, abs=1e-6)
        dyads = all_dyads(Displacements(turns / rocker, shifts / rocker)).real
        own = [abs(dyad.moving - PINS[4]) + abs(dyad.fixed - d) for dyad in dyads]
        assert min(own) < 1e-6
        number += len(dyads) - 1
    assert found.count.real == number > 3


@pytest.mark.parametrize("problem", [SEVEN_POSITIONS, EIGHT_POSITIONS], ids=lambda problem: problem.name)
def test_more_positions_of_a_six_bar_find_it_again(problem, tmp_path, monkeypatch):
    """With a census of a few six-bars, it among them."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    (tmp_path / "gruebler").mkdir(mode=0o700)
    count = problem.poses + 1
    pivots = ((0, 0),) if count == 7 else ()
    wanted = PositionTask(positions_of(PINS, np.linspace(0, 2.5, count)), fixed_pivots=pivots)
    census = Census(problem, 1)
    end, good = follow(problem, *solution_of(wanted), census.task)
    assert good.all()
    others, tasks = random_guides(np.random.default_rng(4), 4, problem.poses, tilted=False)
    ends = [follow(problem, z[None], begin, census.task)[0] for z, begin in zip(others, tasks, strict=True)]
    census.z, census.met = np.concatenate([end, *ends]), np.array([1, 2, 1, 1, 1])
    census.save(tmp_path / "gruebler" / f"six_bars_Watt_I_{problem.name.split()[0]}.npz")
    found = synthesise(wanted, six_bars=True, starts=5, demands=Demands(size_ratio=1e6))
    all_of_them = "35,618 that were listed" if count == 7 else "an estimated 15"
    assert f"Watt I, {problem.name}: 5 complex solutions are known, of {all_of_them}" in found.explain()
    lengths = [design.linkage.length("crank", 0, 1) for design in found.designs]
    assert min(abs(length - abs(PINS[1] - PINS[0])) for length in lengths) < 1e-8


def test_one_assembly_mode_is_told_from_two():
    wanted = task_of()
    shifts = wanted.origins - wanted.turns * wanted.origins[0]
    assert keeps_sides(PINS[None], wanted.turns, shifts).tolist() == [[True, True]]
    # The body's dyad folded over in the last position alone: its turn is another one, and so is its place.
    *_, h, g, f = moved(PINS, 2.5)
    folded = h + (f - h) * np.conj((g - h) / (f - h))
    turn = (folded - h) / (PINS[5] - PINS[4])
    turns, shifts = np.append(wanted.turns[:5], turn), np.append(shifts[:5], h - turn * PINS[4])
    assert keeps_sides(PINS[None], turns, shifts).tolist() == [[False, False]]


def test_a_part_of_a_list_has_a_sum_that_is_not_linear():
    """And solutions of a general plane are led to given positions, where they are six-bars again."""
    search = Search(SIX_POSITIONS, 3)
    while len(search.found[0]) < 12:
        search.step()
    assert trace(search).residual > 1e-3
    task, z = on_special_plane(search)
    assert len(z) > 1
    assert task[0, 9] == 0
    ends, good = follow(SIX_POSITIONS, z, task, load_generic_solutions(SIX_POSITIONS).parameters)
    assert good.all()
    gaps = np.abs(load_generic_solutions(SIX_POSITIONS).z[:, None] - ends).max(axis=2).min(axis=0)
    assert (gaps < 1e-6 * (1 + np.abs(ends).max(axis=1))).all()


@pytest.mark.parametrize(
    ("pivots", "count", "options", "sentence"),
    [
        ((), 6, {}, "the task has 6 positions, 0 fixed pivots and 0 moving ones"),
        (((0, 0), (0, 0)), 6, {}, "the two pivots coincide"),
        (((0, 0), (1, 0)), 6, {"six_bars": SixBarType()}, "has no option 'kind'"),
        (((0, 0), (1, 0)), 6, {"six_bars": False}, "six-bars have some"),
        (((0, 0), (1, 0)), 6, {"starts": 5}, "only of seven and eight"),
        (((0, 0), (1, 0)), 5, {}, "not these for 5"),
        (((0, 0),), 7, {"starts": 0}, "a whole number from 1 to 500,000"),
        ((), 9, {}, "the task has 9 positions"),
    ],
)
def test_other_tasks_are_refused(pivots, count, options, sentence):
    positions = positions_of(PINS, np.linspace(0, 2.5, count))
    with pytest.raises(SynthesisError, match=sentence):
        synthesise(PositionTask(positions, fixed_pivots=pivots), **({"six_bars": True} | options))
