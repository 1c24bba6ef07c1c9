"""How far targets move when lengths change, against linkages whose lengths were changed, and by hand."""

from math import hypot

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.design.synthesis import PositionTask, synthesise
from gruebler.design.synthesis.pair_shifts import farthest_of_all_signs
from gruebler.design.synthesis.sensitivity import farthest_sum, length_sensitivity
from gruebler.design.synthesis.structures import same_machine
from gruebler.design.synthesis.targets import Probe
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

PROBES = (Probe("P"), Probe(link="coupler", length=2.0), Probe(link="rocker"))
STEP = 1e-6


def measured(lengths, point, phi):
    """The probes of a four-bar of lengths and coupler point (along, across) at crank angles."""
    motion = move(FourBar(*lengths).linkage({"P": point}), phi)
    return np.stack([probe.of_motion(motion) for probe in PROBES], axis=1)


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 10**6))
def test_four_bars_against_changed_lengths(seed):
    rng = np.random.default_rng(seed)
    lengths = np.array([1.0, *rng.uniform(2.5, 3.5, 2), 0.0])
    lengths[3] = rng.uniform(abs(lengths[1] - lengths[2]) + 1.2, lengths[1] + lengths[2] - 1.2)
    point = rng.uniform(0.5, 2.0, 2)
    phi = np.linspace(0.3, 4.0, 5) + rng.uniform(0, 2)
    linkage = FourBar(*lengths).linkage({"P": tuple(point)})
    linkage = linkage.with_reference_pose(move(linkage, phi[:1]).pose(0))
    found = length_sensitivity(linkage, PROBES, phi[:, None])
    along = point, np.array([-point[1], point[0]])
    for k, row in enumerate(found.lengths):
        both = []
        for sign in (1, -1):
            changed, moved = lengths.copy(), point.copy()
            if row.other == "P":
                moved = moved + sign * STEP * along[row.across]
            else:
                changed[("crank", "coupler", "rocker", "frame").index(row.link)] *= 1 + sign * STEP
            both.append(measured(changed, moved, phi))
        expected = 1e-3 * (both[0] - both[1]) / (2 * STEP)
        assert np.abs(found.moves[:, :, k] - expected).max() <= 1e-8
    assert sorted((row.link, row.other == "P", row.across) for row in found.lengths) == [
        ("coupler", False, False),
        ("coupler", True, False),
        ("coupler", True, True),
        ("crank", False, False),
        ("frame", False, False),
        ("rocker", False, False),
    ]


def test_slider_crank_by_hand():
    """x = r cos(phi) + sqrt(l^2 - (r sin(phi) - e)^2), differentiated by r, l and e."""
    r, length, e = 1.0, 3.0, 0.5
    linkage = SliderCrank(r, length, e).linkage()
    phi = np.array([0.4, 1.2, 2.1])
    linkage = linkage.with_reference_pose(move(linkage, phi[:1]).pose(0))
    found = length_sensitivity(linkage, (Probe(joint=3),), phi[:, None])
    height = r * np.sin(phi) - e
    root = np.sqrt(length**2 - height**2)
    rates = {"crank": r * (np.cos(phi) - height * np.sin(phi) / root), "coupler": length**2 / root}
    rates["frame"] = e * height / root
    expected = np.stack([rates[row.link] for row in found.lengths], axis=1)
    assert found.moves.shape == (3, 1, 3)
    assert np.abs(np.abs(found.moves[:, 0]) - 1e-3 * np.abs(expected)).max() <= 1e-12
    assert found.worst[:, 0] == pytest.approx(1e-3 * np.abs(expected).sum(axis=1), rel=1e-9)
    assert found.statistical[:, 0] == pytest.approx(1e-3 * np.sqrt((expected**2).sum(axis=1)), rel=1e-9)


def rewritten(linkage, rng):
    """The same machine: every link in other coordinates, and the line of every slide beside itself on both links."""
    chain = linkage.mechanism.chain
    pose = {link: np.array(place) for link, place in linkage.required_pose.items()}
    beside = rng.uniform(-2, 2, len(chain.joints))
    elements, moved = {link: {} for link in chain.links}, {}
    for link in chain.links:
        moves = link != linkage.mechanism.frame
        shift, turn = moves * complex(*rng.uniform(-2, 2, 2)), moves * rng.uniform(-3, 3)
        for (joint, owner), e in linkage.elements.items():
            if owner == link:
                z = complex(e.x, e.y) + (1j * np.exp(1j * e.angle) * beside[joint] if e.is_line else 0)
                z = (z + shift) * np.exp(1j * turn)
                elements[link][joint] = (z.real, z.imag, *([e.angle + turn] if e.is_line else []))
        x, y, angle = pose[link]
        origin = complex(x, y) - shift * np.exp(1j * angle)
        moved[link] = (origin.real, origin.imag, angle - turn)
    return Linkage(linkage.mechanism, elements, reference_pose=moved)


@pytest.mark.parametrize(
    ("text", "drawing", "lengths_of_links"),
    [
        ("R(0-1) R(1-2) R(2-3) P(3-0)", [(0, 0), (1, 1), (4, 0.5), (4, 0.5, 0.2)], 3),
        ("R(0-1) R(1-2) P(2-3) R(3-0)", [(0, 0), (1, 1), (2, 1.2, 0.3), (4, 0.5)], 3),
        ("R(0-1) R(1-2) P(2-3) P(3-0)", [(0, 0), (1, 1), (1, 1.5, 1.5), (3, 0.5, 0.2)], 1),
    ],
)
def test_the_coordinates_in_which_links_are_written_do_not_count(text, drawing, lengths_of_links):
    """The offset of a slide was two lengths, each wrong by a thousandth, by how the coordinates divide it."""
    mechanism = Mechanism.parse(f"{text}; frame=0; drive=R(0-1)")
    first = linkage = Linkage.from_drawing(mechanism, dict(enumerate(drawing)))
    rng = np.random.default_rng(3)
    found = []
    for _ in range(3):
        phi = linkage.required_pose["1"].angle
        probes = (Probe(link="2", length=2.0), Probe(link="1"))
        sensitivity = length_sensitivity(linkage, probes, np.array([[phi], [phi + 0.2], [phi + 0.3]]))
        found.append((sensitivity.worst, sorted(row.length for row in sensitivity.lengths)))
        linkage = rewritten(linkage, rng)
    assert len(found[0][1]) == lengths_of_links
    similar = linkage.scaled(3.0)
    other = Linkage.from_drawing(mechanism, {**dict(enumerate(drawing)), 1: (1, 1.0001)})
    seen = [same_machine(first, each, placed=placed) for placed in (True, False) for each in (linkage, similar, other)]
    assert seen == [True, False, False, True, True, False]
    for worst, lengths in found[1:]:
        assert worst == pytest.approx(found[0][0], abs=1e-12)
        assert lengths == pytest.approx(found[0][1], abs=1e-9)


def test_worst_case_is_that_of_all_signs():
    rng = np.random.default_rng(1)
    linkage = FourBar(1.0, 3.0, 2.5, 3.2).linkage({"P": (1.2, 0.8)})
    found = length_sensitivity(linkage, PROBES, rng.uniform(0.5, 0.9, (3, 1)))
    count = len(found.lengths)
    signs = 1 - 2 * (np.arange(2**count)[:, None] >> np.arange(count) & 1)
    every = np.abs(found.moves @ signs.T).max(axis=2)
    assert found.worst == pytest.approx(every, rel=1e-9)


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1, max_size=6), st.floats(0, 7))
def test_farthest_sums_by_directions_and_by_signs_are_those_of_all_signs(sides, turn):
    """Whole numbers, turned: many of them parallel, opposite, equal or 0, some of them by rounding only."""
    moves = np.exp(1j * turn) * np.array([complex(*side) for side in sides])
    signs = 1 - 2 * (np.arange(2 ** len(moves))[:, None] >> np.arange(len(moves)) & 1)
    every = np.abs(signs @ moves).max()
    assert float(farthest_sum(moves)) == pytest.approx(every, rel=1e-12)
    assert float(farthest_of_all_signs(list(moves[:, None]))[0]) == pytest.approx(every, rel=1e-12)


def test_designs_tell_their_sensitivity():
    task = PositionTask(((0, 0, 0), (1, 0.5, 0.3), (1.6, 1.4, 0.8)))
    ranked = synthesise(task, sort="sensitivity").designs
    design = ranked[0]
    found = design.sensitivity
    assert found is not None
    assert found.moves.shape[:2] == (3, 2)
    assert design.relative_sensitivity == pytest.approx(
        max(hypot(*row) for row in found.worst) / design.targets.size, rel=1e-12
    )
    values = [each.relative_sensitivity for each in ranked]
    assert values == pytest.approx(sorted(values), rel=1e-8)
    assert values[0] < values[-1]


def test_play_of_a_slider_crank_by_hand():
    """x = r cos(phi) + sqrt(l^2 - (r sin(phi) - e)^2): a pin beside its hole is a crank of another length and angle.

    Of the crank pin (dx, dy) moves r cos(phi) and r sin(phi); across the guide e changes.
    """
    r, length, e = 1.0, 3.0, 0.5
    phi = np.array([0.4, 1.2, 2.1])
    linkage = SliderCrank(r, length, e).linkage()
    linkage = linkage.with_reference_pose(move(linkage, phi[:1]).pose(0))
    found = length_sensitivity(linkage, (Probe(joint=3),), phi[:, None])
    slope = (r * np.sin(phi) - e) / np.sqrt(length**2 - (r * np.sin(phi) - e) ** 2)
    reach = np.sqrt(1 + slope**2)  # of a pin by 1 in the worst direction: along the coupler, by the cosine of its angle
    sizes = np.linalg.norm(found.plays[:, 0], axis=2)
    expected = np.stack(
        [reach, reach, reach, np.abs(slope)], axis=1
    )  # both ends of the crank, that of the coupler, guide
    assert np.sort(sizes, axis=1) == pytest.approx(np.sort(expected, axis=1), rel=1e-9)
    bound = found.of_errors(1e-3, 0.02)
    assert bound[:, 0] == pytest.approx(found.worst[:, 0] + 0.02 * expected.sum(axis=1), rel=1e-9)


def test_random_errors_stay_within_the_bound_and_come_near_it():
    rng = np.random.default_rng(1)
    linkage = FourBar(1.0, 3.0, 2.5, 3.2).linkage({"P": (1.2, 0.8)})
    found = length_sensitivity(linkage, PROBES, rng.uniform(0.5, 0.9, (3, 1)))
    bound, seen = found.of_errors(2e-3, 1e-3), found.sampled(2e-3, 1e-3, samples=20_000)
    assert (seen <= bound).all()
    assert (seen.max(axis=0) > 0.6 * bound).all()
    spread = found.sampled(1e-3, samples=20_000)
    third = np.sqrt(
        np.mean(spread**2, axis=0)
    )  # of an even distribution the deviation is the half width by the root of 3
    assert third == pytest.approx(found.statistical / np.sqrt(3), rel=0.03)
    assert (found.sampled(1e-3, 1e-3, seed=4) == found.sampled(1e-3, 1e-3, seed=4)).all()


def test_a_random_linkage_misses_the_same_pose_alike():
    """Its pins lie at one place of their holes for all targets."""
    linkage = FourBar(1.0, 3.0, 2.5, 3.2).linkage({"P": (1.2, 0.8)})
    found = length_sensitivity(linkage, PROBES, np.array([[0.6], [0.8], [0.6]]))
    seen = found.sampled(0.0, 1e-3, samples=200)
    assert seen[:, 0] == pytest.approx(seen[:, 2], rel=1e-6)
    assert np.abs(seen[:, 1] - seen[:, 0]).max() > 1e-5
