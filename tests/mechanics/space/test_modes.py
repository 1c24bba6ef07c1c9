"""All assembly modes in space: against print, against closed forms, against the motion, against counts by theorem."""

from dataclasses import replace

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import RSSR, Bennett, SphericalFourBar, assembly_modes, move
from gruebler.structure.assur.modes import count_modes
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines
from tests.samples import placed_loop

# P. Dietmaier, The Stewart-Gough platform of general geometry can have 40 real postures, 1998; figures and three of the
# forty places of the platform's first ball as PHCpack prints them (src/Demo/stewgou40).
BASE = [
    (0, 0, 0), (1.107915, 0, 0), (0.549094, 0.756063, 0), (0.735077, -0.223935, 0.525991),
    (0.514188, -0.526063, -0.368418), (0.590473, 0.094733, -0.205018),
]  # fmt: skip
PLATFORM = [
    (0, 0, 0), (0.542805, 0, 0), (0.956919, -0.528915, 0), (0.665885, -0.353482, 1.402538),
    (0.478359, 1.158742, 0.107672), (-0.137087, -0.235121, 0.353913),
]  # fmt: skip
LENGTHS = np.array([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])
PRINTED = [
    (0.534003548614846, 0.00617464537788932, -0.845459687874714),
    (0.863325713770891, 0.00564402867997359, -0.504615553547690),
    (0.458734196042698, -0.373482566386209, -0.806271486527107),
]


def platform(base, body, legs):
    """A platform on legs, S or U below, as a linkage, with the lengths that the legs have in its reference pose."""
    low, high = [np.array(base, float), np.array(body, float)]
    text = " ".join(f"{legs[k]}(base-low{k}) P(low{k}-high{k}) S(high{k}-platform)" for k in range(len(legs)))
    drives = [f"P(low{k}-high{k})" for k in range(len(legs))]
    ways = high - low
    places = {}
    for k, way in enumerate(ways):
        x = np.cross(way, (0.3, 0.2, 1.0))
        places[3 * k] = {"at": low[k], "x": x, "y": np.cross(way, x)} if legs[k] == "U" else {"at": low[k]}
        places[3 * k + 1] = {"at": (low[k] + high[k]) / 2, "x": way}
        places[3 * k + 2] = {"at": high[k]}
    linkage = SpatialLinkage(Mechanism(Chain.parse(f"spatial: {text}"), "base", drives), places)
    return linkage, np.linalg.norm(ways, axis=1)


def platform_on_skew_crosses():
    """Axes of the crosses that are not at right angles to the legs: each leg has two poses of its own."""
    rng = np.random.default_rng(0)
    straight = random_platform(0)
    chain = Chain.parse(straight.mechanism.chain.text().replace("S(base", "U(base"))
    x = rng.normal(size=3)
    places = [
        replace(place, x=tuple(x), y=tuple(np.cross(x, rng.normal(size=3)))) if k % 3 == 0 else place
        for k, place in enumerate(straight.places)
    ]
    return SpatialLinkage(Mechanism(chain, "base", range(1, 18, 3)), tuple(places))


def random_platform(seed):
    rng = np.random.default_rng(seed)
    return platform(rng.normal(size=(6, 3)), rng.normal((0, 0, 2), size=(6, 3)), "SSSSSS")[0]


def is_among(poses, pose, size):
    unit = np.array([1, 1, 1, size])
    return bool((abs((poses - pose)[..., :3, :] / unit).max(axis=tuple(range(1, poses.ndim))) < 1e-6).any())


def test_the_platform_of_dietmaier_has_forty_real_modes_those_in_print_among_them():
    shift = (0.5, 0.3, 0.9)
    linkage, lengths = platform(BASE, np.add(PLATFORM, shift), "SSSSSS")
    modes = gr.assembly_modes(linkage, [LENGTHS - lengths])
    assert (len(modes), modes.number, modes.generic, modes.exact) == (40, 40, 40, True)
    pose = modes.pose("platform")
    # The lengths of the legs, from the poses alone.
    balls = np.einsum("mij,kj->mki", pose[:, :3, :3], np.add(PLATFORM, shift)) + pose[:, None, :3, 3]
    np.testing.assert_allclose(np.linalg.norm(balls - BASE, axis=2), np.tile(LENGTHS, (40, 1)), rtol=1e-13)
    # Two of the printed ones are badly conditioned, and the equations in print carry ten digits.
    for place in PRINTED:
        assert abs(balls[:, 0] - place).max(axis=1).min() < 2e-6
    apart = abs(balls[:, None] - balls[None]).max(axis=(2, 3)) + np.eye(40)
    assert apart.min() > 1e-3
    # The legs are in the poses, too: each lower half ends at the base.
    for k in range(6):
        low = modes.pose(f"low{k}") @ [*BASE[k], 1]
        np.testing.assert_allclose(low[:, :3], np.tile(BASE[k], (40, 1)), atol=1e-12)


def test_almost_all_platforms_have_forty_modes():
    linkage = random_platform(0)
    modes = assembly_modes(linkage, [np.zeros(6)])
    assert (modes.number, modes.exact) == (40, True)
    assert len(modes) % 2 == 0
    assert is_among(modes.pose("platform"), np.eye(4), linkage.size)


@pytest.mark.parametrize("turned", [False, True])
def test_legs_with_crosses_are_rods_and_their_crosses_close(turned):
    """Each leg has two poses for one of the platform, 2560 modes in all: the platform's are counted."""
    rng = np.random.default_rng(4)
    base, body = rng.normal(size=(6, 3)), rng.normal((0, 0, 2), size=(6, 3))
    joints, places = [], {}
    for k, way in enumerate(body - base):
        joints.append(f"U(low{k}-base)" if turned else f"U(base-low{k})")
        joints += [f"P(low{k}-high{k})", f"S(high{k}-platform)"]
        y = np.cross(way, rng.normal(size=3))
        x = np.cross(y, rng.normal(size=3))
        places[3 * k] = {"at": base[k], "x": y, "y": -x} if turned else {"at": base[k], "x": x, "y": y}
        places[3 * k + 1], places[3 * k + 2] = {"at": base[k], "x": way}, {"at": body[k]}
    chain = Chain.parse(f"spatial: {' '.join(joints)}")
    linkage = SpatialLinkage(Mechanism(chain, "base", range(1, 18, 3)), places)
    modes = assembly_modes(linkage, [np.zeros(6)])
    assert (modes.number, modes.exact) == (40, True)
    balls = assembly_modes(platform(base, body, "SSSSSS")[0], [np.zeros(6)])
    assert np.sort(modes.pose("platform")[:, 0, 3]) == pytest.approx(np.sort(balls.pose("platform")[:, 0, 3]), abs=1e-9)
    assert is_among(modes.poses, np.tile(np.eye(4), (chain.n, 1, 1)), linkage.size)
    for number in range(0, 18, 3):
        frame = linkage.frames[number]
        first, second = (modes.pose(link) @ frame for link in chain.joints[number].links)
        assert abs((first[:, :3, 0] * second[:, :3, 1]).sum(axis=1)).max() < 1e-12
        assert abs(first[:, :3, 3] - second[:, :3, 3]).max() < 1e-12


def test_planar_bases_have_forty_modes_and_pairs_of_balls_sixteen():
    """P. Nanua, K. J. Waldron, V. Murthy, Direct kinematic solution of a Stewart platform, 1990: 16 of 6-3 platforms.
    The other paths end at infinity."""
    rng = np.random.default_rng(4)
    base, body = rng.normal(size=(6, 3)), rng.normal((0, 0, 2), size=(6, 3))
    flat = platform(base * (1, 1, 0), body * (1, 1, 0) + (0, 0, 2), "SSSSSS")[0]
    assert assembly_modes(flat, [0.1 * np.arange(6)]).number == 40
    modes = assembly_modes(platform(base, body[[2, 0, 0, 1, 1, 2]], "SSSSSS")[0], [np.zeros(6)])
    assert (modes.number, modes.far, modes.generic, modes.exact) == (16, 24, 40, True)


@pytest.mark.slow
def test_structures_with_very_many_modes_are_refused():
    with pytest.raises(LinkageError, match="more than 400 assembly modes"):
        assembly_modes(platform_on_skew_crosses(), [np.zeros(6)])


@pytest.mark.slow
def test_a_hundred_random_platforms_have_forty_modes_each():
    counts = [assembly_modes(random_platform(k), [np.zeros(6)]) for k in range(1, 101)]
    assert [modes.number + modes.far for modes in counts] == [40] * 100
    assert sum(modes.far > 0 for modes in counts) < 3  # a pair with entries beyond 1000, one path to which was lost
    assert all(modes.exact for modes in counts)
    assert all(len(modes) % 2 == 0 and modes.gap < 1e-12 for modes in counts)


def loop(kinds, seed=3, space="spatial"):
    """A closed loop with joints in random places, the first of them driven."""
    rng = np.random.default_rng(seed)
    count = len(kinds)
    text = " ".join(f"{kind}({k}-{(k + 1) % count})" for k, kind in enumerate(kinds))
    places = {}
    for k, kind in enumerate(kinds):
        at = rng.normal(size=3) if space == "spatial" else np.zeros(3)
        x, z = rng.normal(size=(2, 3))
        own = {"R": {"z": z}, "C": {"z": z}, "P": {"x": x}, "S": {}, "U": {"x": x, "y": np.cross(x, z)}}[kind]
        places[k] = {"at": at} | own
    return SpatialLinkage(Mechanism(Chain.parse(f"{space}: {text}"), "0", [0]), places)


def legs(*words, seed=5, space="spatial"):
    """A platform on legs with joints in random places, the first joint of each driven."""
    rng = np.random.default_rng(seed)
    joints, drives, places = [], [], {}
    for number, word in enumerate(words):
        ends = ["base", *(f"{number}.{k}" for k in range(1, len(word))), "platform"]
        drives.append(len(joints))
        for kind, first, second in zip(word, ends, ends[1:], strict=False):
            at = rng.normal(size=3) if space == "spatial" else np.zeros(3)
            own = {"R": "z", "P": "x", "S": ""}[kind]
            places[len(joints)] = {"at": at} | ({own: rng.normal(size=3)} if own else {})
            joints.append(f"{kind}({first}-{second})")
    return SpatialLinkage(Mechanism(Chain.parse(f"{space}: {' '.join(joints)}"), "base", drives), places)


@pytest.mark.parametrize("drive", [0.3, 1.1, -2.0])
def test_the_rssr_has_the_two_modes_of_its_closed_form(drive):
    rssr = RSSR(a=25, b=90, c=60, d=70, crank_offset=10, rocker_offset=15, twist=0.9)
    linkage = rssr.linkage(0.3)
    modes = assembly_modes(linkage, drive - 0.3)
    assert (len(modes), modes.generic, modes.exact) == (2, 2, True)
    axis = np.array(linkage.places[3].z)
    first = rssr.motion([0.3]).output.value[0]
    for branch in "+-":
        turn = rssr.motion([drive], branch=branch).output.value[0] - first
        cross = np.cross(np.eye(3), axis)
        wanted = np.eye(3) + np.sin(turn) * cross + (1 - np.cos(turn)) * cross @ cross
        assert abs(modes.pose("rocker")[:, :3, :3] - wanted).max(axis=(1, 2)).min() < 1e-11


@pytest.mark.parametrize("drive", [0.4, 1.0, 2.0, 3.0, -1.5])
def test_a_spherical_four_bar_has_the_real_modes_of_its_closed_form(drive):
    four_bar = SphericalFourBar(0.9, 0.8, 0.7, 1.0)  # its crank turns part of the way only
    modes = assembly_modes(four_bar.linkage(0.5), drive - 0.5)
    assert (modes.number, modes.exact) == (2, True)
    outputs = [four_bar.motion([drive], branch=branch).output.value[0] for branch in "+-"]
    assert len(modes) == int(np.isfinite(outputs).sum())


@pytest.mark.parametrize(
    ("linkage", "number"),
    [(loop("RCCC"), 2), (loop("RSSP"), 2), (loop("RRSS"), 2), (loop("RRRR", space="spherical"), 2),
     (loop("RRRRRRR"), 16), (legs("PRS", "PRS", "PRS"), 16), (legs("RRR", "RRR", "RRR", space="spherical"), 8)],
    ids=["RCCC", "RSSP", "RRSS", "spherical 4R", "7R", "3-PRS", "spherical 3-RRR"],
)  # fmt: skip
def test_the_numbers_of_theorems_are_reached_and_the_motion_is_in_one_of_the_modes(linkage, number):
    drives = np.zeros(len(linkage.mechanism.drives))
    modes = assembly_modes(linkage, [drives])
    assert (modes.number, modes.generic, modes.exact) == (number, number, True)
    assert is_among(modes.poses, np.tile(np.eye(4), (linkage.mechanism.chain.n, 1, 1)), linkage.size)
    motion = move(linkage, [drives, drives + 0.02])
    assert motion.complete
    there = assembly_modes(linkage, [drives + 0.02])
    assert there.exact
    assert there.gap < 1e-12
    assert is_among(there.poses, motion.poses[0, -1], linkage.size)


def test_each_mode_is_a_reference_pose_from_which_the_linkage_moves():
    linkage = loop("RRRRRRR")
    modes = assembly_modes(linkage, 0.0)
    assert len(modes) in {2, 4, 6, 8, 10, 12, 14, 16}
    for k in range(len(modes)):
        other = modes.linkage_in(k)
        assert move(other, [0.0, 0.01]).complete
        assert len(assembly_modes(other, 0.0)) == len(modes)
    with pytest.raises(LinkageError, match=f"there is no mode {len(modes)}: counted from 0, {len(modes)} are real"):
        modes.linkage_in(len(modes))


def test_the_count_on_the_sphere_is_that_of_the_recursion():
    truss = Chain.parse("R(0-1) R(1-2) R(0-3) R(3-2) R(0-4) R(4-2)")
    assert (
        count_modes(truss, spherical=True)
        == assembly_modes(legs("RRR", "RRR", "RRR", space="spherical"), [np.zeros(3)]).number
    )


def test_without_a_theorem_the_answer_says_so():
    modes = assembly_modes(loop("RSCR"), 0.0)
    assert modes.number == modes.generic
    assert (modes.known, modes.exact) == (False, False)
    assert "no theorem" in modes.explain()
    assert "kein Satz" in modes.explain("de")


def test_special_dimensions_are_told_from_general_ones():
    # Three axes that meet in a point: a wrist; then there are 8 at most (D. L. Pieper, 1968).
    general = loop("RRRRRRR")
    places = [place if k < 4 else replace(place, at=general.places[4].at) for k, place in enumerate(general.places)]
    modes = assembly_modes(SpatialLinkage(general.mechanism, tuple(places)), 0.0)
    assert (modes.number, modes.far, modes.generic, modes.exact) == (8, 8, 16, True)
    assert "8 assembly modes" in modes.explain()
    assert "the others of the 16 that almost all dimensions have lie at infinity" in modes.explain()


@pytest.mark.slow
@pytest.mark.parametrize("id", ["gough", "delta"])
def test_twelve_of_forty_modes_of_machines_with_planes_of_symmetry_lie_far_out(id):
    """In other poses, too: it is their dimensions that send them there, or (eight of the Delta robot's) nearly so."""
    linkage = entry(id).placed()
    for values in (np.zeros(len(linkage.mechanism.drives)), 0.1 * np.arange(len(linkage.mechanism.drives))):
        modes = assembly_modes(linkage, [values])
        assert (modes.number, modes.far, modes.exact) == (28, 12, True)


def test_where_two_modes_meet_it_says_that_some_may_lie_together():
    rssr = RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9)
    start, end = rssr.limits[0]
    modes = assembly_modes(rssr.linkage((start + end) / 2), (end - start) / 2)
    assert (modes.far, modes.generic, modes.exact) == (0, 2, False)
    assert (
        "0 lie at infinity or beyond a thousand sizes, the others together, or they were not found" in modes.explain()
    )


@pytest.mark.parametrize("drive", [0.0, 0.3])
def test_an_rccc_with_parallel_axes_has_modes_that_are_not_isolated(drive):
    """It is a four-bar of the plane whose shifts along the axes are free; in space no mode is isolated."""
    axis = (0, 0, 1)
    linkage = placed_loop("RCCC", ((0, 0, 0), axis), ((1, 0.3, 0), axis), ((1, 2, 0.3), axis), ((3, 0, 0), axis))
    modes = assembly_modes(linkage, drive)
    assert (modes.reached, modes.exact) == (False, False)
    assert "the position in which the linkage stands is none of them" in modes.explain()
    assert "These are not all." in modes.explain()
    assert "das sind nicht alle" in modes.explain("de").lower()


def test_these_are_all_is_said_only_with_the_reference_pose_among_them():
    """Random special dimensions: points on a grid, axes along its lines; of the sizes 1e-3 to 1e3.

    Of an RSSR the modes are the angles with A cos + B sin = C of the circle of the rocker's ball and the rod's sphere:
    two if the rod's other end is not on the rocker's axis and its ball is not either; else all angles or none.
    """
    rng = np.random.default_rng(3)
    counted = loose = 0
    for seed in range(90):
        kinds = ("RSSR", "RSSP", "RRSS", "RCCC", "PSSP", "RRRRRRR")[seed % 6]
        size, axes = 10.0 ** rng.integers(-3, 4), np.eye(3)[rng.integers(3, size=len(kinds))]
        points = size * rng.integers(-1, 2, (len(kinds), 3))
        try:
            linkage = placed_loop(kinds, *zip(points.tolist(), axes.tolist(), strict=True))
            modes = assembly_modes(linkage, 0.0)
        except LinkageError:
            continue
        stands = is_among(modes.poses, np.tile(np.eye(4), (len(linkage.mechanism.chain.links), 1, 1)), linkage.size)
        assert stands == modes.reached
        assert stands or not modes.exact
        counted, loose = counted + modes.exact, loose + (not modes.exact)
        if kinds == "RSSR" and (points[1] != points[2]).any():
            crank, ball = ((point - points[3]) / size for point in points[1:3])
            across = [vector - axes[3] * (axes[3] @ vector) for vector in (crank, ball)]
            fixed = min(np.linalg.norm(each) for each in across) > 0.5
            meet = np.linalg.norm(np.cross(*across)) < 0.5  # the sine of the rocker's angle from there: a double root
            assert modes.exact == (fixed and not meet)
    assert counted > 30
    assert loose > 3


@pytest.mark.parametrize(
    ("linkage", "reason"),
    [
        (Bennett(50, 0.5, 1.1).linkage(0.7), "overconstrained"),
        (
            SpatialLinkage(
                Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut); drive=R(frame-spindle)"),
                {0: {"z": (0, 0, 1)}, 1: {"z": (0, 0, 1), "pitch": 2}, 2: {"x": (0, 0, 1), "at": (0, 60, 0)}},
            ),
            "infinitely many complex",
        ),
    ],
    ids=["Bennett", "screw"],
)
def test_what_cannot_be_counted_is_refused_with_the_reason(linkage, reason):
    with pytest.raises(LinkageError, match=reason):
        assembly_modes(linkage, 0.0)


def test_modes_do_not_depend_on_the_link_from_which_a_ball_is_written():
    """A body with a fixed point on three rods: three quadrics in the four numbers of its turn, up to a sign, have 8."""
    for text in ("R(frame-crank) S(crank-body)", "S(body-crank) R(crank-frame)"):
        modes = assembly_modes(machines.tied_body(text)[0], [np.array([0.5])])
        assert modes.number == 8
        assert len(modes) == 6
