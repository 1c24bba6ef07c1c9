"""Dead centres, change points, limits: closed forms, dense sampling, ranks of the Jacobian."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.base.events import ChangePoint
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.analysis.cycle_spans import CycleSpan, by_place
from gruebler.mechanics.analysis.drive_cycles import DriveCycle, drive_cycle
from gruebler.mechanics.analysis.events import change_points, crossings, dead_centres, transfer_function
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import Motion, move
from gruebler.mechanics.kinematics.root_finding import bracketed_root, find_zeros
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.samples import CLASS_III, CYLINDER, parallel_legs

TURN = 2 * math.pi


def dwell_six_bar() -> tuple[Linkage, float]:
    """Two crank-rockers in a row, both in their outer dead centres at once; and the crank angle of that."""
    size = FourBar(2, 7, 4.5, 5.5)
    outer = size.dead_centres.outer
    arm = 2 * np.exp(1j * (outer.drive - outer.output))
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5); frame=0; drive=R(0-1)")
    linkage = Linkage(
        mechanism,
        {
            "0": {"R(0-1)": (0, 0), "R(0-3)": (5.5, 0), "R(0-5)": (11, 0)},
            "1": {"R(0-1)": (0, 0), "R(1-2)": (2, 0)},
            "2": {"R(1-2)": (0, 0), "R(2-3)": (7, 0)},
            "3": {"R(0-3)": (0, 0), "R(2-3)": (4.5, 0), "R(3-4)": (float(arm.real), float(arm.imag))},
            "4": {"R(3-4)": (0, 0), "R(4-5)": (7, 0)},
            "5": {"R(0-5)": (0, 0), "R(4-5)": (4.5, 0)},
        },
        outputs=["5"],
    )
    return linkage, outer.drive


def locked_rows(motion: Motion, row: int, links: tuple[str, str], joint: int | None) -> np.ndarray:
    """The Jacobian of all closing conditions of a linkage of turning joints and slides, one freedom locked."""
    lower = motion.lower_linkage
    chain, frame = lower.mechanism.chain, lower.mechanism.frame
    moving = [link for link in chain.links if link != frame]
    rows: list[np.ndarray] = []

    def part(link: str, point: complex) -> np.ndarray:
        out = np.zeros((2, 3 * len(moving)))
        if link != frame:
            arm = motion.turns[row, chain.index(link)] * point
            k = 3 * moving.index(link)
            out[0, k], out[1, k + 1], out[0, k + 2], out[1, k + 2] = 1, 1, -arm.imag, arm.real
        return out

    def turn(a: str, b: str) -> np.ndarray:
        out = np.zeros((1, 3 * len(moving)))
        for link, sign in ((a, -1), (b, 1)):
            if link != frame:
                out[0, 3 * moving.index(link) + 2] = sign * lower.size
        return out

    def place(link: str, point: complex) -> complex:
        k = chain.index(link)
        return motion.places[0, row, k] + motion.turns[row, k] * point

    for number, j in enumerate(chain.joints):
        a, b = j.links
        one, two = lower.elements[number, a], lower.elements[number, b]
        p, q = complex(one.x, one.y), complex(two.x, two.y)
        if j.pair.name == "revolute":
            rows.append(part(b, q) - part(a, p))
            continue
        line = motion.turns[row, chain.index(a)] * np.exp(1j * one.angle)
        gap = part(b, q) - part(a, p)
        far = place(b, q) - place(a, p)
        along = line.real * gap[0] + line.imag * gap[1]
        across = -line.imag * gap[0] + line.real * gap[1]
        spin = turn(frame, a)[0] / lower.size if a != frame else np.zeros(3 * len(moving))
        rows += [turn(a, b), (across - (np.conj(line) * far).real * spin)[None]]
        if number == joint:
            rows.append((along + (np.conj(line) * far).imag * spin)[None])
    if joint is None:
        rows.append(turn(*links))
    return np.vstack(rows)


def least_singular(course: DriveCycle, drive: float, links: tuple[str, str], joint: int | None = None) -> float:
    values = np.linalg.svd(locked_rows(course.at(np.array([drive]), 1), 0, links, joint), compute_uv=False)
    return float(values[-1] / values[0])


# --- zeros -------------------------------------------------------------------------------------------


def test_brackets_are_closed_to_rounding() -> None:
    roots = np.linspace(0.1, 5, 50)
    found = bracketed_root(lambda x: np.expm1(x - roots) * (1 + x**2), roots - 0.7, roots + 1.9)
    assert np.abs(found - roots).max() < 4e-15


def test_zeros_know_how_often_they_are_zeros() -> None:
    def jet(x: np.ndarray) -> np.ndarray:
        p = np.polynomial.Polynomial.fromroots([-1.5, 0.3, 0.3, 1.1, 1.1, 1.1, 2.0, 2.001])
        return np.stack([p(x), p.deriv()(x), p.deriv(2)(x)])

    found = find_zeros(jet, np.linspace(-2, 3, 101) + 0.0123)
    assert [zero.multiplicity for zero in found] == [1, 2, 3, 1, 1]
    assert [zero.at for zero in found] == pytest.approx([-1.5, 0.3, 1.1, 2.0, 2.001], abs=1e-9)
    assert [zero.rises for zero in found if zero.multiplicity != 2] == [False, True, False, True]


def test_a_triple_zero_is_known_by_the_digits_of_its_function() -> None:
    """(x - 1/3)^3 with coefficients of nine decimals: by them alone it is a simple zero, 4e-4 beside the triple one."""

    def jet(x: np.ndarray) -> np.ndarray:
        value = x**3 - x**2 + 0.333333333 * x - 0.037037037
        return np.stack([value, 3 * x**2 - 2 * x + 0.333333333, 6 * x - 2])

    (zero,) = find_zeros(jet, np.linspace(-1, 1.5, 20))
    assert (zero.multiplicity, zero.rises) == (3, True)
    assert zero.at == pytest.approx(1 / 3, rel=0, abs=1e-12)


def test_a_jump_is_no_zero() -> None:
    assert find_zeros(lambda x: np.sign(x - 0.501)[None] + 0.1, np.linspace(0, 1, 20)) == ()
    assert find_zeros(lambda x: np.zeros((1, len(x))), np.linspace(0, 1, 20)) == ()


@pytest.mark.parametrize("width", [1e-3, 1e-5, 1e-6])
def test_a_steep_zero_is_no_jump(width: float) -> None:
    """Between two sharp extremes of a function whose places are rounded to 1e-11, so that it is never 0."""

    def steep(x: np.ndarray) -> np.ndarray:
        off = np.floor((x - 0.501) * 1e11) / 1e11 + 5e-12
        return (off / (off**2 + width**2))[None]

    grid = np.sort(np.concatenate([np.linspace(0, 1, 20), 0.501 + width * np.array([-2, -1, 1, 2])]))
    assert [zero.at for zero in find_zeros(steep, grid)] == pytest.approx([0.501], rel=0, abs=1e-11)


# --- against closed forms ----------------------------------------------------------------------------

length = st.floats(0.2, 5)


def check_centres(size: object, closed: object, branch: str) -> None:
    """Both dead centres of the general path against a closed form of branch +1; the other is its mirror image."""
    course = drive_cycle(size.linkage(), branch=branch)
    found = dead_centres(course, find_output(course.linkage))
    assert sorted(centre.side for centre in found) == ["inner", "outer"]
    for side in ("inner", "outer"):
        mine = next(centre for centre in found if centre.side == side)
        wanted = getattr(closed, side)
        phi = wanted.drive if branch == "+" else -wanted.drive
        assert abs(np.exp(1j * (mine.drive - phi)) - 1) < 1e-8
        assert (mine.kind == wanted.kind) == (branch == "+")  # mirrored, a maximum is a minimum
        assert mine.flat == wanted.flat
    top, bottom = max(c.output for c in found), min(c.output for c in found)
    assert top - bottom == pytest.approx(closed.travel, rel=1e-8)


@settings(max_examples=20, deadline=None)
@given(length, length, length, st.sampled_from("+-"))
def test_dead_centres_of_crank_rockers(b: float, c: float, d: float, branch: str) -> None:
    size = FourBar(0.2, b, c, d)
    margin = min(b + c + d - 2 * x - 0.2 for x in (b, c, d))
    assume(min(b, c, d) > 0.21 and margin > 0.02)
    check_centres(size, size.dead_centres, branch)


@settings(max_examples=20, deadline=None)
@given(st.floats(0.3, 5), st.floats(-1, 1))
def test_dead_centres_of_slider_cranks(b: float, share: float) -> None:
    a = 0.25
    size = SliderCrank(a, b, 0.95 * share * (b - a))
    check_centres(size, size.dead_centres, "+")


@settings(max_examples=20, deadline=None)
@given(st.floats(0.3, 5), st.floats(-1, 1))
def test_dead_centres_of_inverted_slider_cranks(d: float, share: float) -> None:
    a = 0.25
    size = InvertedSliderCrank(a, d, 0.9 * share * (d - a))
    check_centres(size, size.dead_centres, "+")


def test_the_left_branch_of_a_slider_crank() -> None:
    size = SliderCrank(1.7, 6, 1.5)
    course = drive_cycle(size.linkage(), branch="-")
    found = dead_centres(course, find_output(course.linkage))
    # turned by half a turn: s(phi, e) on branch - is -s(pi - phi, e) on branch +
    for centre in found:
        wanted = getattr(size.dead_centres, centre.side)
        assert centre.drive == pytest.approx((math.pi - wanted.drive) % TURN, abs=1e-12)
        assert centre.output == pytest.approx(-wanted.output, abs=1e-12)


@pytest.mark.parametrize("size", [FourBar(40, 70, 25, 70), FourBar(5, 4, 6, 7), SliderCrank(7, 5, 1)])
def test_limits_of_the_drive(size: FourBar | SliderCrank) -> None:
    course = drive_cycle(size.linkage())
    middle = (course.span.low + course.span.high) / 2
    arc = next(arc for arc in size.limits if middle in arc)
    assert [np.exp(1j * course.span.low), np.exp(1j * course.span.high)] == pytest.approx(
        [np.exp(1j * arc.start), np.exp(1j * arc.end)], abs=1e-9
    )
    assert all(stop is not None and stop.reason == "limit" for stop in course.span.stops)


def test_outputs_at_the_limits() -> None:
    course = drive_cycle(FourBar(40, 70, 25, 70).linkage())
    output = find_output(course.linkage)
    for upper, sign in ((False, -1), (True, 1)):  # overlapping below, stretched above
        drive = course.span.high if upper else course.span.low
        line = 40 * np.exp(1j * drive) - 70
        value = course.end(output.values, upper)
        assert abs(np.exp(1j * value) - sign * line / abs(line)) < 1e-8


# --- rank of the Jacobian ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("linkage", "links", "joint"),
    [
        (FourBar(40, 70, 25, 70).linkage(), ("frame", "crank"), None),
        (CLASS_III, ("0", "1"), None),
        (CYLINDER, ("1", "2"), 3),
    ],
)
def test_the_rank_falls_at_the_limits(linkage: Linkage, links: tuple[str, str], joint: int | None) -> None:
    course = drive_cycle(linkage)
    low, width = course.span.low, course.span.width
    usual = least_singular(course, low + width / 2, links, joint)
    near = [least_singular(course, course.span.low + width * x, links, joint) for x in (1e-6, 1e-10)]
    near += [least_singular(course, course.span.high - width * x, links, joint) for x in (1e-6, 1e-10)]
    assert max(near[1], near[3]) < 1e-3 * usual
    for far, close in (near[:2], near[2:]):  # it falls with the root of the distance
        assert far / close == pytest.approx(100, rel=0.05)


@pytest.mark.parametrize(
    ("linkage", "frame", "link"),
    [(FourBar(2, 7, 4.5, 5.5).linkage(), "frame", "rocker"), (CLASS_III, "0", "4"), (CLASS_III, "0", "3")],
)
def test_the_rank_with_the_output_locked_falls_at_dead_centres(linkage: Linkage, frame: str, link: str) -> None:
    course = drive_cycle(linkage)
    found = dead_centres(course, find_output(linkage, link))
    assert found
    for centre in found:
        drive = centre.drive if not course.span.full else course.span.low + (centre.drive - course.span.low) % TURN
        here, aside = (least_singular(course, drive - x, (frame, link)) for x in (0.0, 1e-3))
        assert here < 1e-11
        assert aside > 1e-6


def test_a_value_at_an_end_is_not_taken_from_poses_that_have_lost_its_digits() -> None:
    """1 / (t^2 + 0.01), which is 100 at the limit; from poses that all have t below 0.04 it comes with errors of 1."""
    course = drive_cycle(FourBar(50, 70, 40, 70).linkage())
    low, width = course.span.low, course.span.width
    assert course.span.stops[0] is not None
    least: list[float] = []

    def value(motion: Motion) -> np.ndarray:
        t = 2 * np.arcsin(np.sqrt((motion.drives[:, 0] - low) / width))
        least.append(float(t.max()))
        return 1 / (t**2 + 0.01) + (t.max() < 0.04) * (-1.0) ** np.arange(len(t))

    assert complex(course.end(value, False)).real == pytest.approx(100, abs=0.5)
    assert min(least) < 0.04  # poses that near were asked for


# --- dense sampling ----------------------------------------------------------------------------------


@pytest.mark.parametrize("link", ["2", "h", "3", "4"])
def test_a_class_three_linkage_against_sampling(link: str) -> None:
    course = drive_cycle(CLASS_III)
    margin = 1e-4 * course.span.width
    drives = np.linspace(course.span.low + margin, course.span.high - margin, 20_001)
    motion = move(CLASS_III, np.concatenate([[course.start.drives[0, 0]], drives]), order=2)
    track, rate = motion.angle(link)[1:], motion.angular(link, order=1)[1:]
    cells = np.flatnonzero(np.sign(rate[:-1]) * np.sign(rate[1:]) < 0)
    found = dead_centres(course, find_output(CLASS_III, link))
    assert len(found) == len(cells)
    for centre, cell in zip(found, cells, strict=True):
        assert drives[cell] <= centre.drive <= drives[cell + 1]
        best = track[cell : cell + 2].max() if centre.kind == "maximum" else track[cell : cell + 2].min()
        assert centre.output == pytest.approx(best, abs=1e-6)
    rates = motion.angular(link, order=2)[1:]
    inside = [x for x in crossings(course, find_output(CLASS_III, link), 2) if drives[0] < x.drive < drives[-1]]
    assert len(inside) == np.count_nonzero(np.sign(rates[:-1]) * np.sign(rates[1:]) < 0)


def test_a_six_bar_that_dwells() -> None:
    linkage, phi = dwell_six_bar()
    course = drive_cycle(linkage)
    output = find_output(linkage)
    found = dead_centres(course, output)
    flat = [centre for centre in found if centre.flat]
    assert len(flat) == 1
    assert flat[0].kind == "minimum"
    assert flat[0].drive == pytest.approx(phi, abs=1e-9)
    rates = [transfer_function(course, output, np.array([flat[0].drive]), order)[0] for order in (1, 2, 3)]
    assert np.abs(rates).max() < 1e-8
    assert len(found) % 2 == 0


# --- change points and zeros of transfer functions ---------------------------------------------------


@pytest.mark.parametrize("branch", ["+", "-"])
def test_change_points_of_a_parallelogram(branch: str) -> None:
    course = drive_cycle(FourBar(25, 70, 25, 70).linkage(), branch=branch)
    assert [np.exp(1j * point.drive) for point in change_points(course)] == pytest.approx([1, -1], abs=1e-10)
    assert change_points(drive_cycle(FourBar(25, 70, 40, 70).linkage())) == ()


def test_extremes_of_velocity_and_acceleration() -> None:
    course = drive_cycle(FourBar(25, 70, 40, 70).linkage())
    output = find_output(course.linkage)
    phi = np.linspace(0, TURN, 100_001)
    closed = FourBar(25, 70, 40, 70).motion(phi).output
    for order, track in ((1, closed.value), (2, closed.velocity), (3, closed.acceleration)):
        found = crossings(course, output, order)
        assert max(c.value for c in found) == pytest.approx(track.max(), abs=1e-7)
        assert min(c.value for c in found) == pytest.approx(track.min(), abs=1e-7)
        at = np.array([c.drive for c in found])
        assert np.abs(transfer_function(course, output, at, order)).max() < 1e-11


@pytest.mark.parametrize("start", [0.5, 7.1, -6.0, 13.1])
def test_zeros_after_a_full_turn_rise_too(start: float) -> None:
    """The rocker of a parallelogram turns with its crank: it rises through every multiple of a full turn."""
    size = FourBar(25, 70, 25, 70)
    linkage = size.linkage().with_reference_pose(move(size.linkage(), [start]).pose())
    found = crossings(drive_cycle(linkage), find_output(linkage), 0)
    assert [(one.kind, round(one.value, 9)) for one in found] == [("rising", 1.0)]


def test_zeros_of_the_output() -> None:
    size = InvertedSliderCrank(30, 50)
    course = drive_cycle(size.linkage())
    found = crossings(course, find_output(course.linkage), 0)
    assert [np.exp(1j * c.drive) for c in found] == pytest.approx([1, -1], abs=1e-12)
    assert {c.kind for c in found} == {"rising", "falling"}


# --- wrong calls -------------------------------------------------------------------------------------


def test_what_has_no_course() -> None:
    five = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")
    drawn = {"R(0-1)": (0, 0), "R(1-2)": (0, 2), "R(2-3)": (3, 4), "R(3-4)": (6, 2), "R(0-4)": (6, 0)}
    with pytest.raises(LinkageError, match="one drive"):
        drive_cycle(Linkage.from_drawing(five, drawn))
    with pytest.raises(LinkageError, match="cannot be assembled"):
        drive_cycle(FourBar(1, 1, 1, 9).linkage())
    with pytest.raises(LinkageError, match="did you mean 'rocker'"):
        find_output(FourBar(2, 7, 4.5, 5.5).linkage(), "rockr")


def test_change_points_of_larger_groups_are_named() -> None:
    """Three parallel cranks with a plate: where they lie along two of the plate's pins, twice a turn each way."""
    found = measures(parallel_legs()).change_points
    tilt = np.degrees(np.arctan2(3.0 - 0.8, 2.0))
    assert [point.links for point in found] == [("2", "h", "3", "4")] * 4
    assert np.degrees([point.drive for point in found]) == pytest.approx([0, tilt, 180, 180 + tilt], abs=1e-8)
    assert measures(parallel_legs(error=1e-3)).change_points == ()


@pytest.mark.parametrize("error", [-1e-10, -1e-12, 0.0, 1e-12, 1e-10])
@pytest.mark.parametrize("size", [1.0, 1e-6, 1e6])
def test_events_at_one_place_are_in_the_order_of_their_links(error: float, size: float) -> None:
    first, other = ChangePoint(drive=(2 + error) * size, links=("b",)), ChangePoint(drive=2 * size, links=("a",))
    later = ChangePoint(drive=(2 + 1e-6) * size, links=("a",))
    assert by_place([first, later, other], size) == by_place([other, first, later], size)
    assert by_place([first, later, other], size) == [[other, first], [later]]


@pytest.mark.parametrize("error", [0.0, 1e-12, 1e-10, 1.3e-8])
def test_the_end_of_a_period_is_its_beginning(error: float) -> None:
    full = CycleSpan(low=1.0, high=1 + 2 * math.pi, full=True, turns=1, stops=(None, None), linkage=parallel_legs())
    last, first, between = (
        ChangePoint(drive=full.wrapped(2 * math.pi - error), links=("a",)),
        ChangePoint(drive=0.0, links=("b",)),
        ChangePoint(drive=3.0, links=("b",)),
    )
    assert last.drive == 0
    assert by_place([first, between, last], 1.0) == [[last, first], [between]]


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 0.7, 1, 2.54, 1e6])
def test_a_lift_whose_groups_change_at_once(scale: float) -> None:
    found = measures(entry("hubpodium_blocks").linkage().scaled(scale))
    assert [point.links for point in found.change_points] == [("arm2", "block1"), ("platform", "block2")]
    assert [point.several for point in found.change_points] == [True, True]
    assert found.explain().count("More than two curves of positions meet there.") == 1


@pytest.mark.parametrize("long", [30, 100, 1000])
def test_slim_parallelograms_turn_fully(long: float) -> None:
    """The limit of a dyad is seen to the rounding of its lengths, however different they are."""
    found = measures(FourBar(1, long, 1, long).linkage())
    assert found.span.full
    assert [point.drive for point in found.change_points] == pytest.approx([0, math.pi], abs=1e-9)
