"""Other sizes of links in space: against closed forms, distances that stay, and the way back."""

from itertools import combinations
from math import degrees, radians

import numpy as np
import pytest
from scipy.optimize import minimize

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws.link_sizes import link_sizes
from gruebler.mechanics.screws.resizing import can_be_resized, resized
from gruebler.mechanics.space import RSSR, move
from gruebler.teaching.catalog import entries, entry

LOOP = {"a": 30.0, "b": 140.0, "c": 80.0, "d": 100.0, "twist": radians(40), "rocker_offset": 40.0}
CHANGED = [
    ("crank", (36.0, None), {"a": 36.0}),
    ("rod", (150.0, None), {"b": 150.0}),
    ("rocker", (70.0, None), {"c": 70.0}),
    ("frame", (110.0, None), {"d": 110.0}),
    ("frame", (None, 55.0), {"twist": radians(55)}),
    ("frame", (90.0, 30.0), {"d": 90.0, "twist": radians(30)}),
]


@pytest.mark.parametrize(("link", "size", "fields"), CHANGED)
def test_a_loop_with_two_balls_swings_as_its_closed_form(link, size, fields):
    changed = resized(RSSR(**LOOP).linkage(), {link: size})
    assert degrees(gr.measures(changed).travel) == pytest.approx(degrees(RSSR(**LOOP | fields).swing()), rel=1e-6)


ONE_EACH = {
    "wiper_rssr": {"rod": (310.0, None)},
    "universal_joint": {"frame": (None, 40.0)},
    "sarrus": {"arm1": (66.0, None)},
    "delta": {f"rod{k}": (240.0, None) for k in range(1, 7)},
    "susp_spatial": {"tie_rod": (312.0, None)},
    "susp_5link_lift": {"link1": (355.0, None), "link4": (270.0, None)},
    "wobble_plate": {"shaft": (None, 25.0), "rod2": (63.0, None)},
    "cargo_bike": {"handlebar": (85.0, None)},
    "bennett": {"frame": (100.0, None), "coupler": (100.0, None), "driver": (50.0, None), "follower": (50.0, None)},
}


@pytest.mark.parametrize("id", ONE_EACH)
def test_only_the_wanted_sizes_change_and_it_moves(id):
    """Neither do the distances between the balls of a link: the knuckle of a suspension has up to five."""
    linkage = entry(id).placed()
    changed = resized(linkage, ONE_EACH[id])
    before, after = ({size.link: size for size in link_sizes(each)} for each in (linkage, changed))
    for link, old in before.items():
        distance, angle = ONE_EACH[id].get(link, (None, None))
        assert after[link].distance == pytest.approx(
            old.distance if distance is None else distance, abs=1e-9 * linkage.size
        )
        assert after[link].angle == pytest.approx(old.angle if angle is None else angle, abs=1e-6)
    chain = linkage.mechanism.chain
    for link in set(chain.links) - set(ONE_EACH[id]):
        balls = [k for k, joint in enumerate(chain.joints) if link in joint.links and joint.pair.is_ball]
        for one, other in combinations(balls, 2):
            apart = [np.linalg.norm(each.frames[one, :3, 3] - each.frames[other, :3, 3]) for each in (linkage, changed)]
            assert apart[0] == pytest.approx(apart[1], abs=1e-9 * linkage.size)
    still = [0.0] * len(linkage.mechanism.drives)
    moved = move(changed, [still, [0.02, *still[1:]]])
    assert moved.complete
    back = resized(changed, {link: (before[link].distance, before[link].angle) for link in ONE_EACH[id]})
    for size in link_sizes(back):
        assert size.distance == pytest.approx(before[size.link].distance, abs=1e-9 * linkage.size)


def test_points_go_with_their_links():
    linkage = entry("susp_spatial").placed()
    changed = resized(linkage, {"tie_rod": (312.0, None)})
    chain = linkage.mechanism.chain
    (name, (link, _)), *_ = linkage.points.items()
    ball = next(k for k, joint in enumerate(chain.joints) if link in joint.links and joint.pair.is_ball)
    apart = [np.linalg.norm(np.array(each.points[name][1]) - each.frames[ball, :3, 3]) for each in (linkage, changed)]
    assert apart[0] == pytest.approx(apart[1], rel=1e-9)
    assert changed.points[name] != linkage.points[name]


def test_a_rod_that_is_too_short_says_how_short_it_can_be():
    """The least distance between the circles of the two balls, by minimisation over both angles."""
    loop = RSSR(**LOOP)
    c, s = np.cos(LOOP["twist"]), np.sin(LOOP["twist"])

    def apart(angles):
        phi, psi = angles
        one = LOOP["a"] * np.array([np.cos(phi), np.sin(phi), 0])
        # the rocker's axis is (0, -s, c) through (d, 0, 0)
        axis = np.array([0, -s, c])
        other = np.array([LOOP["d"], 0, 0]) + LOOP["rocker_offset"] * axis
        other = other + LOOP["c"] * (np.cos(psi) * np.array([1, 0, 0]) + np.sin(psi) * np.array([0, c, s]))
        return float(np.linalg.norm(one - other))

    starts = [(x, y) for x in np.linspace(0, 6, 7) for y in np.linspace(0, 6, 7)]
    least = min(minimize(apart, start).fun for start in starts)
    with pytest.raises(LinkageError, match="rod: the joints can be closed as far as") as told:
        resized(loop.linkage(), {"rod": (0.5 * least, None)})
    step = (LOOP["b"] - 0.5 * least) / 256
    assert least - 1e-6 * least <= told.value.values["last"] <= least + step


def test_what_cannot_be_is_said():
    bennett = entry("bennett").placed()
    with pytest.raises(LinkageError, match=r"frame: with 100 mm the joints cannot be closed unless other sizes"):
        resized(bennett, {"frame": (100.0, None)})
    with pytest.raises(LinkageError, match=r"frame: with 80° the joints cannot be closed unless other sizes"):
        resized(bennett, {"frame": (None, 80.0)})
    with pytest.raises(LinkageError, match=r"shaft: with 324 mm the joints cannot be closed unless other sizes"):
        resized(entry("cardan_shaft").placed(), {"shaft": (324.0, None)}, in_proportion=True)  # see its bearings
    for size, reason in (((-1.0, None), "from 0 on"), ((None, 190.0), "0° to 180°"), ((float("nan"), None), "from 0")):
        with pytest.raises(LinkageError, match=reason):
            resized(bennett, {"frame": size})
    with pytest.raises(LinkageError, match="wheel has no such size"):
        resized(bennett, {"wheel": (1.0, None)})
    with pytest.raises(LinkageError, match="input: its joints lie on one axis or in one point"):
        resized(entry("cardan_shaft").placed(), {"input": (10.0, None)})
    with pytest.raises(LinkageError, match="beside wheels"):
        resized(entry("diff_bevel").placed(), {"carrier": (None, 80.0)})


def test_a_length_that_fits_nowhere_alone_takes_the_others_along_if_wanted():
    """Lengths of Bennett's linkage are as the sines of its twists, which stay."""
    changed = resized(entry("bennett").placed(), {"frame": (100.0, None)}, in_proportion=True)
    assert [value for size in link_sizes(changed) for value in size[1:]] == pytest.approx([100, 90, 50, 30] * 2)
    assert move(changed, [[0.0], [0.1]]).complete


def test_a_joint_is_not_put_together_the_other_way_round():
    """With the opposite twist of two of its links Bennett's linkage closes if a joint is turned over: not the same."""
    with pytest.raises(LinkageError, match="smaller steps"):
        resized(entry("bennett").placed(), {"driver": (60.0, 150.0), "follower": (60.0, 150.0)})


IN_SPACE = [id for id, record in entries().items() if record.in_space and can_be_resized(record.placed())]


@pytest.mark.parametrize("id", IN_SPACE)
def test_the_same_sizes_change_nothing(id):
    linkage = entry(id).placed()
    same = resized(linkage, {size.link: (size.distance, size.angle) for size in link_sizes(linkage)})
    assert same.frames[:, :3, 3] == pytest.approx(linkage.frames[:, :3, 3], abs=1e-9 * linkage.size)
