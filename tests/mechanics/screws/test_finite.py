"""What moves only for an instant is told from what moves; ways that meet are counted."""

from dataclasses import astuple
from math import cos, inf, pi, sin
from types import SimpleNamespace

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import Evidence, freedoms
from gruebler.mechanics.screws.finite_mobility import _zeros
from gruebler.mechanics.screws.obstruction import NearbyPose
from gruebler.mechanics.screws.quadratic_forms import directions, is_definite
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.screws import machines as m

PLATFORM = "R(0-1) R(0-2) R(0-3) R(1-p) R(2-p) R(3-p)"


def platform(feet, heads):
    return m.planar(PLATFORM, dict(enumerate([*feet, *heads])))


@pytest.mark.parametrize("error", [1e-2, 1e-4, 1e-6])
def test_a_third_crank_bored_wrong_is_only_shaky(error):
    found = freedoms(m.locomotive(3, error=error))
    assert (found.instant.mobility, found.mobility) == (1, 0)
    assert found.finite.evidence in (Evidence.STRESSED, Evidence.SHAKY)
    assert found.finite.order == 2
    exact = freedoms(m.locomotive(3, error=1e-2)).finite.open
    assert found.finite.open == pytest.approx(exact * error / 1e-2, rel=0.02)  # the gap grows with the error


def test_bars_on_lines_through_a_point_are_shaky():
    rays = [np.array([cos(t), sin(t)]) for t in (0.0, 2.0, 4.0)]
    found = freedoms(platform(rays, [3 * ray for ray in rays]))
    assert (found.instant.mobility, found.mobility, found.finite.evidence) == (1, 0, Evidence.STRESSED)
    assert [r.kind for r in found.reasons] == ["concurrent"]


def test_parallel_unequal_bars_are_shaky():
    found = freedoms(platform([(0, 0), (2, 0), (5, 1)], [(0, 1), (2, 2), (5, 2.5)]))
    assert (found.instant.mobility, found.mobility) == (1, 0)
    assert [r.kind for r in found.reasons] == ["parallel"]


def test_a_stretched_triangle_is_shaky():
    found = freedoms(m.planar("R(0-1) R(1-2) R(0-2)", dict(enumerate([(0, 0), (1, 0), (3, 0)]))))
    assert (found.instant.mobility, found.mobility, found.finite.evidence) == (1, 0, Evidence.STRESSED)


def test_a_stretched_four_bar_whose_frame_is_as_long_as_the_rest_is_isolated():
    """One equation fewer than unknowns, and yet no other position is near."""
    found = freedoms(m.planar("R(0-1) R(1-2) R(2-3) R(0-3)", dict(enumerate([(0, 0), (1, 0), (3, 0), (4, 0)]))))
    assert (found.counted, found.generic, found.instant.mobility, found.mobility) == (1, 1, 2, 0)
    assert found.finite.evidence is Evidence.STRESSED


def test_a_motion_all_of_whose_positions_are_singular():
    """A pin at its dead centre in a slot along which the slide goes: the slide is free, the crank only shaky."""
    places = {0: (2, 0), 1: {"at": (2, 0), "x": (0, 1)}, 2: {"at": (4, 0), "x": (0, 1), "radii": (0, inf)}}
    found = freedoms(m.planar("R(0-1) P(0-2) G(1-2)", places))
    assert (found.counted, found.instant.mobility, found.mobility) == (1, 2, 1)
    twice = m.planar("R(0-1) P(0-2) G(1-2) P(0-3) G(1-3)", places | {3: places[1], 4: places[2]})
    assert (freedoms(twice).instant.mobility, freedoms(twice).mobility) == (3, 2)


def test_a_pose_that_is_all_but_singular():
    """A parallelogram opened by 1e-6 radians: regular by the tolerance, or singular by a coarser one."""
    almost = m.locomotive(2, angle=1e-6)
    assert (freedoms(almost).instant.mobility, freedoms(almost).mobility) == (1, 1)
    for coarse in (1e-5, 1e-4):
        assert freedoms(almost, tolerance=coarse).instant.mobility == 2
        assert freedoms(almost, tolerance=coarse).mobility == 1
    three = m.locomotive(3, angle=1e-6)
    assert (freedoms(three).instant.mobility, freedoms(three).mobility) == (1, 1)


def watt(x, half, side):
    """The joints of Watt's linkage about (x, 0), rockers of length side at right angles to the coupler."""
    return [(x - side, -half), (x, -half), (x, half), (x + side, half)]


@pytest.mark.parametrize("half", [0.3, 0.5, 1.0])
def test_a_guided_point_that_leaves_its_tangent_by_the_fifth_power(half):
    """Watt's curve has contact of the fifth order with its tangent in the middle; a slide there holds the linkage."""
    places = [*watt(0, half, 1), (0, 0), {"at": (0, 0), "x": (0, 1)}]
    found = freedoms(m.planar("R(0-1) R(1-2) R(2-3) R(0-3) R(2-4) P(0-4)", dict(enumerate(places))))
    assert (found.counted, found.generic, found.instant.mobility, found.mobility) == (0, 0, 1, 0)
    assert (found.finite.evidence, found.finite.order) == (Evidence.SHAKY, 5)


def test_a_cusp_is_a_motion():
    """The middles of two of Watt's linkages, joined by a bar: the set of positions is a curve with a cusp at home.

    After R. Connelly and H. Servatius, Higher-order rigidity - what is the proper definition?, Discrete and
    Computational Geometry 11 (1994) 193-200.
    """
    text = "R(0-1) R(1-2) R(2-3) R(0-3) R(0-4) R(4-5) R(5-6) R(0-6) R(2-7) R(5-7)"
    places = [*watt(0, 0.4, 1), *watt(2, 0.9, -1), (0, 0), (2, 0)]
    found = freedoms(m.planar(text, dict(enumerate(places))))
    assert (found.counted, found.instant.mobility, found.mobility) == (1, 2, 1)
    assert found.finite.evidence is Evidence.BRANCHING


@pytest.mark.parametrize(
    ("lengths", "at", "ways"), [((2, 5, 2, 5), 0.0, 2), ((2, 5, 2, 5), pi, 2), ((2, 2, 5, 5), 0.0, 2)]
)
def test_two_ways_meet_in_change_points(lengths, at, ways):
    found = freedoms(FourBar(*lengths).linkage(), at=at)
    assert (found.instant.mobility, found.mobility, found.finite.ways) == (2, 1, ways)
    assert found.finite.evidence is Evidence.BRANCHING


def test_three_cranks_on_one_line_have_one_way():
    found = freedoms(m.locomotive(3, angle=0.0))
    assert (found.instant.mobility, found.mobility, found.finite.ways) == (2, 1, 1)


def test_a_stretched_five_bar_keeps_its_two_freedoms():
    found = freedoms(
        m.planar("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4)", dict(enumerate([(0, 0), (1, 0), (3, 0), (2, 0), (6, 0)])))
    )
    assert (found.instant.mobility, found.mobility) == (3, 2)


def test_dead_centres_are_regular_positions():
    """A dead centre is singular for the drive, not for the linkage."""
    crank = SliderCrank(25, 70).linkage()
    for at in (0.0, pi):
        found = freedoms(crank, at=at)
        assert (found.instant.mobility, found.mobility, found.finite.evidence) == (1, 1, Evidence.REGULAR)


def test_a_linkage_with_redundant_cranks_and_sizes_alone():
    text = "R(0-1) R(0-2) R(0-3) R(1-p) R(2-p) R(3-p); drive=R(0-1)"
    heads = [(3.0 * k + cos(0.7), sin(0.7)) for k in range(3)]
    names = ["R(0-1)", "R(0-2)", "R(0-3)", "R(1-p)", "R(2-p)", "R(3-p)"]
    drawn = Linkage.from_drawing(Mechanism.parse(text), dict(zip(names, [(0, 0), (3, 0), (6, 0), *heads], strict=True)))
    for at in (None, 0.2, 2.0, -1.0):
        found = freedoms(drawn, at=at)
        assert (found.instant.mobility, found.mobility, found.instant.rank) == (1, 1, 11)
    elements = {link: {n: astuple(e) for (n, owner), e in drawn.elements.items() if owner == link} for link in "0123p"}
    homeless = Linkage(drawn.mechanism, elements)
    assert freedoms(homeless).mobility == 1
    elements["3"][5] = (1.01, 0.0)  # the third crank 1 % longer, its pin on the rod spaced like the axles
    wrong = Linkage(
        drawn.mechanism, elements, reference_pose={link: tuple(p) for link, p in drawn.reference_pose.items()}
    )
    with pytest.raises(LinkageError, match=r"they are open by [0-9.e-]+ of the linkage's size"):
        freedoms(wrong)
    assert freedoms(Linkage(drawn.mechanism, elements)).mobility == 0  # only where it is rigid


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"at": 5.0, "branch": "+"}, "no assembly mode|cannot"),
        ({"tolerance": 0}, "between 0 and 0.01"),
        ({"tolerance": True}, "tolerance: expected a number"),
        ({"at": "x"}, "at: expected a number"),
        ({"at": float("inf")}, "finite number"),
        ({"at": [1.0, 2.0]}, "expected 1 drive value"),
    ],
)
def test_refusals(arguments, words):
    with pytest.raises(LinkageError, match=words):
        freedoms(m.hooke(), **arguments)


def test_a_branch_needs_a_drive_value():
    with pytest.raises(LinkageError, match="drive value, which is missing"):
        freedoms(FourBar(25, 70, 40, 70).linkage(), branch="-")
    both = [freedoms(FourBar(25, 70, 40, 70).linkage(), at=1.0, branch=branch).instant.pose for branch in "+-"]
    assert abs(both[0] - both[1]).max() > 0.1


def test_only_linkages_have_freedoms():
    bar = FourBar(25, 70, 40, 70).linkage()
    driveless = bar.with_mechanism(Mechanism(bar.mechanism.chain, "frame"))
    with pytest.raises(LinkageError, match="expected a linkage"):
        freedoms("R(0-1)")
    with pytest.raises(LinkageError, match="no drive"):
        freedoms(driveless, at=1.0)


class FlatExcess:
    """F = 1e4 (x - y)^7 (x + y): all but flat about its zero along x = y, so that Newton stops anywhere beside it."""

    instant = SimpleNamespace(tolerance=1e-8)

    def __call__(self, k):
        flat, steep = k[0] - k[1], k[0] + k[1]
        slope = 1e4 * flat**6 * np.array([7 * steep + flat, -7 * steep + flat])
        return NearbyPose(k, np.array([1e4 * flat**7 * steep]), slope[None])


def test_zeros_that_are_not_told_apart_are_one_way():
    found = _zeros(FlatExcess(), np.zeros((1, 2, 2)), np.eye(2), 0.02, np.random.default_rng(0))
    ways = sorted(float(np.degrees(np.arctan2(k[1], k[0])) % 180) for k in found)
    assert len(ways) == 2
    assert abs(ways[0] - 45) < 25
    assert ways[1] == pytest.approx(135, abs=0.01)


def test_forms():
    plane = np.diag([1.0, 1.0, -1.0])[None]
    assert not is_definite(plane)
    found = directions(plane, np.random.default_rng(0), 10)
    assert all(abs(np.einsum("sij,i,j->s", plane, k, k)).max() < 1e-9 for k in found)
    assert len(found) >= 8
    pair = np.array([np.diag([1.0, 0.0]), np.diag([0.0, 1.0])])  # neither is definite, their sum is
    assert is_definite(pair)
    cross = np.array([[[0.0, 1.0], [1.0, 0.0]]])
    assert not is_definite(cross)
    assert len(directions(cross, np.random.default_rng(0), 10)) == 2
    assert directions(np.array([np.diag([1.0, -1.0]), np.diag([0.0, 1.0])]), np.random.default_rng(0), 10) == []
