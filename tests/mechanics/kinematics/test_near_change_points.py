"""Crowded rows beside change points that a linkage meets, or misses by little: right, or named."""

import numpy as np
import pytest

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from tests.samples import parallel_legs

KITES = [(1.0, 2.0, 2.0, 1.0), (2.0, 1.0, 1.0, 2.0)]


def kite(sizes, which, excess):
    lengths = list(sizes)
    lengths[which] += excess
    return lengths


def rocker_angle(lengths, phi, branch):
    """The triangle A, B, B0 by its angles, another formula than that of the solver and of the closed form."""
    a, b, c, d = lengths
    gap = d - a * np.exp(1j * phi)
    at_b0 = np.arccos(np.clip((abs(gap) ** 2 + c * c - b * b) / (2 * abs(gap) * c), -1, 1))
    return np.angle(-gap) - branch * at_b0


@pytest.mark.parametrize("sizes", KITES)
@pytest.mark.parametrize("which", [0, 3])
@pytest.mark.parametrize("excess", [1e-3, 1e-4, 1e-5, -1e-5, 3e-6])
@pytest.mark.parametrize("branch", [1, -1])
def test_what_passes_near_a_change_point_keeps_its_own_poses_and_rates(sizes, which, excess, branch):
    """The rocker turns by nearly 180 degrees while the crank turns by some times the excess."""
    lengths = kite(sizes, which, excess)
    phi = np.linspace(-1e-3, 1e-3, 2001)
    motion = move(FourBar(*lengths).linkage(), phi, branch="+" if branch > 0 else "-", order=1)
    assert len(motion) == len(phi)
    assert (motion.taken_for_exact, motion.unbounded, motion.message()) == ((), (), "")
    off = np.exp(1j * (motion.angle("rocker") - rocker_angle(lengths, phi, branch)))
    assert np.abs(off - 1).max() < 1e-7
    step = 1e-9  # of the crank, for differences; the links turn within the excess
    sides = [rocker_angle(lengths, phi + s * step, branch) for s in (-2, -1, 1, 2)]
    turned = [np.angle(np.exp(1j * (x - y))) for x, y in ((sides[3], sides[0]), (sides[2], sides[1]))]
    quotient = (8 * turned[1] - turned[0]) / (12 * step)
    assert motion.angular("rocker") == pytest.approx(quotient, rel=1e-4, abs=3e-4 * np.abs(quotient).max())


@pytest.mark.parametrize("sizes", KITES)
@pytest.mark.parametrize("which", [0, 1, 2, 3])
@pytest.mark.parametrize("excess", [1e-6, -1e-6, 4e-7, -4e-7, 2e-7])
@pytest.mark.parametrize("branch", ["+", "-"])
def test_rates_fit_the_poses_or_their_rows_are_named(sizes, which, excess, branch):
    """A row with the rate 918 had the difference quotient -14,701, and no word said why."""
    phi = np.linspace(-1e-3, 1e-3, 2001)
    motion = move(FourBar(*kite(sizes, which, excess)).linkage(), phi, branch=branch, order=1)
    named = np.zeros(len(motion), bool)
    named[list(motion.taken_for_exact + motion.unbounded)] = True
    assert bool(motion.taken_for_exact) == ("taken for exact" in motion.message())
    rates = motion.angular("rocker")
    quotient = np.diff(motion.angle("rocker")) / np.diff(phi[: len(motion)])
    # A difference quotient is a rate between both rows: it lies within those of the rows around.
    around = np.stack([rates[:-3], rates[1:-2], rates[2:-1], rates[3:]])
    judged = ~(named[1:-2] | named[2:-1])
    room = 0.02 * np.abs(around).max(axis=0) + 1e-3
    fits = (quotient[1:-1] > around.min(axis=0) - room) & (quotient[1:-1] < around.max(axis=0) + room)
    assert judged.sum() > 900
    assert fits[judged].all()


@pytest.mark.parametrize("excess", [1e-8, 1e-10, 1e-12])
def test_a_row_in_a_change_point_that_is_nearly_met_is_named(excess):
    """The true rocker stands at right angles there, in the middle of its quick turn; the exact one goes straight on."""
    motion = move(FourBar(*kite(KITES[0], 0, excess)).linkage(), [-0.1, 0.0, 0.1], branch="+", order=1)
    assert motion.taken_for_exact == (1,)
    assert motion.message().startswith("At R(frame-crank) = 0° the sizes miss a change point")
    assert motion.message("de").endswith("Lage und Ableitungen sind dort die eines Getriebes, das sie trifft.")


@pytest.mark.parametrize("sizes", [*KITES, (1.0, 2.0, 1.0, 2.0), (1.0, 1.0, 2.0, 2.0), (3.0, 2.0, 1.5, 0.5)])
@pytest.mark.parametrize("factor", [1.0, 1e-3 / 3, 7e5 / 9])
def test_exact_change_points_are_not_named(sizes, factor):
    bar = FourBar(*(factor * v for v in sizes)).linkage()
    for branch in "+-":
        motion = move(bar, np.linspace(-0.3, 2 * np.pi, 400), branch=branch, order=1)
        crowded = move(bar, np.linspace(-1e-4, 1e-4, 201) + (np.pi if sizes[0] == 3 else 0), branch=branch, order=1)
        assert (motion.taken_for_exact, crowded.taken_for_exact) == ((), ())
        assert np.abs(np.diff(crowded.angular("rocker"))).max() < 1e-3


@pytest.mark.parametrize("which", [1, 2])
def test_rows_beside_a_limit_have_the_rates_of_the_closed_form(which):
    """Five rows before the limit were said to stand at it, without finite rates."""
    four_bar = FourBar(*kite(KITES[1], which, -1e-6))
    phi = np.linspace(-1e-3, 1e-3, 2001)
    motion = move(four_bar.linkage(), phi, branch="+", order=1)
    assert motion.stop.reason == "limit"
    assert motion.unbounded == ()
    rates = four_bar.motion(phi[: len(motion)], branch="+").output.velocity
    assert motion.angular("rocker") == pytest.approx(rates, rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("behind", [6e-7, 3e-6, 6.1e-6, 1e-5])
@pytest.mark.parametrize("gap", [1e-4, 5e-4, 2e-3])
@pytest.mark.parametrize("before", [0.01, 0.04, 0.07])
def test_rows_close_behind_a_change_point_of_a_larger_group(behind, gap, before):
    """All cranks are equal and parallel, so that the plate only shifts."""
    row = np.pi + behind
    path = [*np.linspace(0.93, np.pi - before, 40), row, row + gap, row + 3 * gap, 4.0]
    motion = move(parallel_legs(), path, order=0)
    assert motion.complete
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8


@pytest.mark.parametrize("seed", range(20))
def test_crowded_rows_about_change_points_of_a_larger_group(seed):
    """Forth, and back again; the plate only shifts, and no row is left out."""
    random = np.random.default_rng(seed)
    tilt = np.arctan2(3.0 - 0.8, 2.0)  # two of the plate's pins in line with a crank
    rows = [0.93, 2.0, 5.0, *random.uniform(0.93, 7, 4)]
    for change in (np.pi, np.pi + tilt, 2 * np.pi, 2 * np.pi + tilt):
        rows += [change + sign * 10**power for sign, power in zip((-1, 1, 1), random.uniform(-9, -2, 3), strict=True)]
    rows = np.unique([*rows, np.pi] if seed % 4 == 0 else rows)
    path = np.concatenate([rows, rows[::-1][1:]]) if seed % 2 else rows
    motion = move(parallel_legs(), path, order=0)
    assert motion.complete
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-7


# A pose that is one of the last three stands on the way, but not as far as another one on the other side.
TURNS = [-7.501e-9, 9.099e-9, -4.988e-5, -2.12e-8, 1.395e-10, 1.715e-9, -2.745e-9, 0.01977, -2.605e-4, -6.058e-12]
TURNS += [-8.247e-5, -5.104e-5, -6.728e-13, -2.681e-7, -0.007544, -2.296e-4, 1.096e-10]


@pytest.mark.parametrize(
    ("high", "start", "rows"),
    [
        # very short steps before a change point, whose differences were rounding
        (
            3,
            0.93,
            [(0, -2e-9), (0, 0.012), (1, -6.6e-5), (1, 1.5e-6), (1, 1e-4), (2, -0.018), (2, -1.3e-6), (2, 5.6e-7)],
        ),
        # back beside one and forth over it, from a pose that is not the last one
        (3, 0.93, [(1, 1e-6), (2, -3.7e-5), (1, 2.5e-8), (1, 2.1e-6), (1, -1.3e-6)]),
        # back over the first one and forth: went on in the other mode
        (3, 0.93, [(1, 6.4e-8), (0, 0.017), (0, -1.2e-5), (2, -3.2e-4)]),
        (1.2, np.pi - 2.212, [(1, behind) for behind in TURNS]),
    ],
)
def test_short_rows_after_long_ones_and_turns_about_change_points(high, start, rows):
    """The plate only shifts; all rows were found by trying many paths."""
    tilt = np.arctan2(high - 0.8, 2.0)
    changes = (np.pi, np.pi + tilt, 2 * np.pi)
    path = [start, *(changes[number] + behind for number, behind in rows)]
    motion = move(parallel_legs(high), path, order=0)
    assert motion.complete
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-7
