"""The walk and the sweep against each other, change points, and the laws that every motion keeps."""

from math import pi

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.kinematics.kernel_calls import run_rows
from gruebler.mechanics.kinematics.solve import assembly_modes
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from tests.samples import class_iii, parallel_legs

LINKAGES = {
    "four-bar": FourBar(25, 70, 40, 70).linkage(),
    "double-crank": FourBar(40, 50, 45, 20).linkage(),
    "slider-crank": SliderCrank(20, 70, 8).linkage(),
    "turning block": InvertedSliderCrank(50, 30, 3).linkage(),
    "swinging block": InvertedSliderCrank(30, 50, -4).linkage(),
}
FIVE_BAR = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")


@pytest.mark.parametrize("name", LINKAGES)
@pytest.mark.parametrize("branch", "+-")
def test_a_sweep_finds_what_a_walk_finds(name: str, branch: str) -> None:
    path = from_degrees(-3, 723, 2)
    swept = move(LINKAGES[name], path, branch=branch, speed=3, acceleration=-2, jerk=5, order=3)
    assert swept.closure_error < 1e-13
    for row in range(0, len(path) - 8, 4):
        walked = move(LINKAGES[name], path[row : row + 8], branch=branch, speed=3, acceleration=-2, jerk=5, order=3)
        at = slice(row, row + len(walked))
        assert len(walked) == 8 or len(swept) == row + len(walked)
        assert np.allclose(walked.turns, swept.turns[at], rtol=0, atol=1e-12)
        assert np.allclose(walked.places, swept.places[:, at], rtol=1e-9, atol=1e-8)
        assert np.allclose(walked.rates, swept.rates[:, at], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("far", [0.0, 1e3, 1e7])
def test_the_swept_circle_is_as_good_as_the_library_s(far: float) -> None:
    path = far + np.linspace(-40, 40, 4001)
    crank = move(LINKAGES["four-bar"], path).turns[:, 1]
    assert np.abs(crank - np.exp(1j * path)).max() < 4e-16


def test_the_parallelogram_stays_one_over_ten_turns() -> None:
    motion = move(FourBar(25, 70, 25, 70).linkage(), from_degrees(0, 3600, 0.5), speed=1)
    assert motion.complete
    assert np.abs(motion.turns[:, 2] - 1).max() < 1e-7
    assert np.abs(motion.angle("rocker") - motion.drives[:, 0]).max() < 1e-7


@pytest.mark.parametrize("step", [0.5, 7.0, 30.0, 90.0])
@pytest.mark.parametrize("start", [-90.0, 0.0, 30.0])
def test_a_kite_goes_on_smoothly_where_its_outer_joints_meet(start: float, step: float) -> None:
    """a = d: the crank's end meets the rocker's pivot, where coupler and rocker lie together in a direction of limit.

    With phi the crank angle the line from A to B0 has the direction phi/2 - pi/2 throughout.
    """
    kite = FourBar(30, 50, 50, 30).linkage()
    motion = move(kite, from_degrees(start, start + 1440, step), branch="+")
    assert motion.complete
    phi = motion.drives[:, 0]
    sine = np.sin(phi / 2) * (1 if np.sin(np.radians(start / 2 + 1e-9)) > 0 else -1)
    arm = np.exp(1j * (phi / 2 - pi / 2)) * np.sign(np.sin(np.radians(start / 2 + 1e-9)))
    expected = arm * (30 * np.abs(sine) * np.sign(sine) + 1j * np.sqrt(2500 - 900 * sine**2)) / 50
    assert np.abs(motion.turns[:, 2] - expected).max() < 1e-7
    assert motion.closure_error < 1e-12


def test_a_rhombus_is_a_parallelogram_or_a_kite_as_its_branch_says() -> None:
    for branch in "+-":
        motion = move(FourBar(20, 20, 20, 20).linkage(), from_degrees(10, 730, 1), branch=branch)
        assert motion.complete
        assert motion.closure_error < 1e-12
        assert np.abs(np.diff(motion.turns, axis=0)).max() < 0.05


@pytest.mark.parametrize("high", [0.8, 3.0])
@pytest.mark.parametrize("step", [1.0, 0.37, 11.0, 60.0])
def test_three_parallel_cranks_stay_parallel(step: float, high: float) -> None:
    motion = move(parallel_legs(high), from_degrees(50, 800, step), speed=1)
    assert motion.complete, motion.message()
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8
    assert motion.closure_error < 1e-13
    if step != 1:  # no row lies in a change point
        assert np.abs(motion.angular("h")).max() < 1e-9


@pytest.mark.parametrize("high", [0.8, 3.0])
@pytest.mark.parametrize("degree", [180.0, 360.0])
def test_a_row_may_lie_in_a_change_point(degree: float, high: float) -> None:
    motion = move(parallel_legs(high), np.radians([degree - 60, degree, degree + 60]), order=0)
    assert motion.complete
    assert motion.closure_error < 1e-12
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8


@pytest.mark.parametrize("high", [0.8, 3.0])
@pytest.mark.parametrize("behind", [1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, -1e-9, -1e-6, -1e-5, -1e-3])
def test_a_row_may_lie_next_to_a_change_point(behind: float, high: float) -> None:
    motion = move(parallel_legs(high), np.radians([53.13, 100, 180 + behind, 250]), order=0)
    assert motion.complete, motion.message()
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8


@pytest.mark.parametrize("high", [0.8, 3.0])
@pytest.mark.parametrize("step", np.geomspace(0.05, 60, 9))
def test_change_points_are_crossed_with_any_spacing(step: float, high: float) -> None:
    for start in (50.0, 53.13):
        motion = move(parallel_legs(high), np.radians(np.arange(start, 400, step)), order=0)
        assert motion.complete, motion.message()
        assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8


@pytest.mark.parametrize(
    "rows",
    [(100, 180, 100), (100, 180, 180, 250), (100, 180, 170, 180, 200), (100, 140, 180, 180, 140, 100), (180, 190)],
    ids=str,
)
def test_a_path_may_turn_back_rest_and_start_in_a_change_point(rows: tuple[float, ...]) -> None:
    motion = move(parallel_legs(), np.radians(rows), speed=2.0)
    assert motion.complete, motion.message()
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8
    assert np.abs(motion.angular("h")).max() < 1e-9


@pytest.mark.parametrize("roundings", [-64, -7, -1, 0, 1, 7, 64])
def test_a_start_in_a_change_point_does_not_hang_on_the_last_bits(roundings: int) -> None:
    path = np.pi * (1 + roundings * 2.0**-52) + np.radians([0, 10, 20])
    motion = move(parallel_legs(), path, speed=2.0)
    assert motion.complete, motion.message()
    assert np.abs(motion.angle("h") - motion.angle("h")[0]).max() < 1e-8
    assert np.abs(motion.angular("h")).max() < 1e-9


@pytest.mark.parametrize("high", [0.8, 3.0])
@pytest.mark.parametrize("roundings", [-64, 0, 1])
def test_no_branch_is_guessed_where_two_meet(roundings: int, high: float) -> None:
    legs, path = parallel_legs(high), np.pi * (1 + roundings * 2.0**-52) + np.radians([0, 10])
    motions = [move(legs, path, branch=mode) for mode in assembly_modes(legs, path[0])]
    assert [(len(m), m.stop.row, m.stop.reason) for m in motions if m.stop] == [(1, 0.0, "singular")]


@pytest.mark.parametrize("angle", [1e-3, 1e-5, -1e-5])
def test_a_start_beside_a_change_point_is_not_in_it(angle: float) -> None:
    legs, path = parallel_legs(), np.pi + angle + np.radians([0, np.sign(angle) * 10])
    motions = [move(legs, path, branch=mode) for mode in assembly_modes(legs, path[0])]
    assert len(motions) == 4
    assert all(motion.complete for motion in motions)


def test_a_fold_ends_the_motion() -> None:
    six = class_iii((0, 0), (0.5, 0.3), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5))
    motion = move(six, from_degrees(31, 140, 1))
    assert motion.stop is not None
    assert motion.stop.reason == "singular"
    assert np.degrees(motion.stop.drives[0]) == pytest.approx(97.5252475, abs=1e-7)


@pytest.mark.parametrize("error", [1e-3, 1e-6, 1e-9, 1e-12, -1e-3, -1e-6])
def test_a_near_miss_of_a_change_point_is_not_jumped(error: float) -> None:
    """With one base too far away the plate leaves the parallel branch smoothly; with one too near the motion ends."""
    motion = move(parallel_legs(error=error), from_degrees(53, 230, 1))
    assert motion.complete == (error > 0)
    if motion.complete:
        assert abs(motion.angle("h")[-1] - motion.angle("h")[0]) > 0.05
        assert np.abs(np.diff(motion.angle("h"))).max() < 0.1
        back = move(parallel_legs(error=error), np.concatenate([motion.drives[:, 0], motion.drives[::-1, 0]]))
        assert np.abs(back.turns - back.turns[::-1]).max() < 1e-6
    else:
        assert motion.stop is not None
        assert np.degrees(motion.stop.drives[0]) == pytest.approx(180, abs=10)


lengths = st.floats(10, 60)
FOUR = st.tuples(lengths, lengths, lengths, lengths)


@given(FOUR, st.sampled_from("+-"), st.floats(0, 360), st.floats(-400, 400), st.sampled_from([0.5, 3.0, 20.0]))
@settings(max_examples=60)
def test_reversing_the_drive_retraces_the_path(
    sizes: tuple[float, float, float, float], branch: str, start: float, way: float, step: float
) -> None:
    path = np.radians(np.linspace(start, start + way, max(2, int(abs(way) / step))))
    forth = move(FourBar(*sizes).linkage(), path, branch=branch)
    assume(len(forth) > 1 and np.abs(forth.roots[:, 0]).min() > 1e-4)
    both = move(
        FourBar(*sizes).linkage(), np.concatenate([path[: len(forth)], path[: len(forth)][::-1]]), branch=branch
    )
    assert both.complete
    assert np.allclose(both.turns[::-1], both.turns, rtol=0, atol=1e-9)
    angles = np.angle(both.turns) + 2 * pi * both.whole  # a link at pi may count a turn more by a rounding
    assert np.allclose(angles[-1], angles[0], rtol=0, atol=1e-8)


@given(FOUR, st.sampled_from("+-"), st.floats(0, 360), st.floats(30, 400))
@settings(max_examples=60)
def test_a_mirrored_linkage_moves_as_the_mirror_image(
    sizes: tuple[float, float, float, float], branch: str, start: float, way: float
) -> None:
    path, linkage = np.radians(np.linspace(start, start + way, 200)), FourBar(*sizes).linkage()
    motion = move(linkage, path, branch=branch, speed=2)
    image = move(linkage.mirrored(), -path, branch="-" if branch == "+" else "+", speed=-2)
    assert len(image) == len(motion)
    assert np.allclose(image.turns, motion.turns.conj(), rtol=0, atol=1e-7)


@pytest.mark.parametrize("factor", [1e-6, 1e6, 3.0])
@pytest.mark.parametrize("name", LINKAGES)
def test_scaling_scales(name: str, factor: float) -> None:
    path = from_degrees(5, 500, 1.5)
    motion = move(LINKAGES[name], path, order=3)
    scaled = move(LINKAGES[name].scaled(factor), path, order=3)
    assert len(scaled) == len(motion)
    assert np.allclose(scaled.places / factor, motion.places, rtol=1e-9, atol=1e-7)
    assert np.allclose(scaled.rates, motion.rates, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("factor", [1e-6, 1e6])
def test_scaling_scales_larger_groups(factor: float) -> None:
    six = class_iii((0, 0), (0.5, 0.3), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5))
    path = from_degrees(31, 140, 3)
    motion, scaled = move(six, path, order=2), move(six.scaled(factor), path, order=2)
    assert len(scaled) == len(motion)
    assert np.allclose(scaled.rates, motion.rates, rtol=1e-7, atol=1e-8)
    assert len(move(parallel_legs().scaled(factor), from_degrees(50, 400, 1))) == 351


@pytest.mark.parametrize("name", LINKAGES)
def test_rows_may_coincide_and_be_far_apart(name: str) -> None:
    path = np.radians([3, 3, 3, 93, 183, 183, 273, 363, 273, 93, 3, 3, 3.5, 4, 4.5, 4.5, 5, 5, 5, 5.5, 6, 6, 90])
    motion = move(LINKAGES[name], path, order=1)
    fine = move(LINKAGES[name], from_degrees(3, 363, 0.5))
    assert motion.complete
    for row, angle in enumerate(np.degrees(path)):
        assert np.allclose(motion.turns[row], fine.turns[round((angle - 3) * 2)], rtol=0, atol=1e-10)


@pytest.mark.parametrize("sizes", [(20, 20, 20, 20), (25, 70, 25, 70), (30, 50, 50, 30)])
@pytest.mark.parametrize("step", [0.1, 0.2, 0.7, 3, 40])
@pytest.mark.parametrize("rests", [0, 1, 3])
def test_a_drive_may_turn_back_just_behind_a_change_point(
    sizes: tuple[float, float, float, float], step: float, rests: int
) -> None:
    for place in (180, 360):
        forth = place + np.array([-2.9, -1.9, -0.9, 0.1]) * step
        path = np.radians([*forth, *[forth[-1]] * rests, *forth[::-1]])
        motion = move(FourBar(*sizes).linkage(), path)
        assert motion.complete
        assert np.abs(motion.turns - motion.turns[::-1]).max() < 1e-7


def test_two_drives_sweep_as_one() -> None:
    """A five-bar whose second drive runs along with the first at twice its speed."""
    five = Linkage.from_drawing(FIVE_BAR, {0: (0, 0), 1: (1, 0.5), 2: (2.5, 7), 3: (4, 0.6), 4: (5, 0)})
    turn = np.linspace(0.5, 6.7, 700)
    path = np.stack([turn, 2 * turn + 1.5], axis=1)
    motion = move(five, path, speed=[1, 2])
    assert motion.complete
    assert motion.closure_error < 1e-13
    seen = motion.point("R(2-3)")
    middle = (seen[2:] - seen[:-2]) / (turn[2] - turn[0])
    assert np.abs(middle - motion.point("R(2-3)", order=1)[1:-1]).max() < 1e-3 * np.abs(middle).max()


def test_drives_may_move_one_after_the_other_and_rest() -> None:
    five = Linkage.from_drawing(FIVE_BAR, {0: (0, 0), 1: (1, 0.5), 2: (2.5, 7), 3: (4, 0.6), 4: (5, 0)})
    first, second = np.linspace(0.5, 6.9, 300), np.linspace(2.5, 14.9, 700)
    one = np.concatenate([first, np.full(len(second) + 5, first[-1]), first[::-1]])
    other = np.concatenate([np.full(len(first), second[0]), second, np.full(len(first) + 5, second[-1])])
    path = np.stack([one, other], axis=1)
    motion = move(five, path)
    assert motion.complete
    for row in range(0, len(path), 7):
        alone = move(five, path[row : row + 1], branch=motion.branch)
        assert np.allclose(alone.turns[0], motion.turns[row], rtol=0, atol=1e-12)
    for link in motion.plan.lower.mechanism.chain.links:
        assert np.abs(np.diff(motion.angle(link))).max() < 0.1
    assert np.allclose(motion.angle("1") - motion.angle("1")[0], one - one[0], rtol=0, atol=1e-12)


@given(st.floats(-3, 3), st.floats(0.2, 3))
@settings(max_examples=20)
def test_a_pose_fed_back_goes_on_alike(start: float, way: float) -> None:
    six = class_iii((0, 0), (0.5, 0.3), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5))
    path = np.linspace(0.54 + start / 10, 0.54 + start / 10 + way, 30)
    whole = move(six, path)
    assume(len(whole) >= 12)
    plan = whole.plan
    again = run_rows(plan, path[10:].reshape(-1, 1), None, np.ones(0), whole.unknowns[10])
    assert np.allclose(again.turns, whole.turns[10:], rtol=0, atol=1e-11)
    assert again.reached == len(whole) - 10
