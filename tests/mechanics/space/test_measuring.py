"""Measures in space against closed forms of the universal joint, RSSR, Bennett and spherical four-bar."""

from math import cos, pi, tau

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import RSSR, Bennett, SphericalFourBar, measures
from gruebler.mechanics.space.drive_ranges import followed
from gruebler.mechanics.space.motion_tables import spatial_table
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines
from tests.samples import placed_loop

WIPER = RSSR(a=30, b=140, c=80, d=100, twist=0.7, rocker_offset=40)


@pytest.mark.parametrize("bend", [0.3, pi / 6])
def test_hookes_joint_has_its_speed_ratio(bend):
    """Its ratio lies between cos δ and 1 / cos δ, a quarter turn apart; it has no dead centre."""
    measured = measures(machines.hooke(bend).with_drives([0]))
    assert measured.range.full
    assert measured.turns == 1
    assert measured.dead_centres == ()
    assert measured.least_ratio.value == pytest.approx(cos(bend), abs=1e-12)
    assert measured.greatest_ratio.value == pytest.approx(1 / cos(bend), abs=1e-12)
    assert abs(cos(measured.greatest_ratio.at - measured.least_ratio.at)) < 1e-8
    cross = [row for row in measured.joints if "cross" in row.joint]
    assert [row.highest - row.lowest for row in cross] == pytest.approx([2 * bend] * 2, abs=1e-9)
    assert f"from {cos(bend):.4g} at" in measured.explain()


def test_two_cross_joints_have_the_ratio_1():
    measured = measures(machines.cardan(0.5, 0.5).with_drives([0]))
    assert [each.value for each in measured.ratios] == pytest.approx([1.0], abs=1e-12)
    assert "1, constant" in measured.explain()
    assert "1, konstant" in measured.explain("de")


def test_dead_centres_of_a_spherical_four_bar_are_those_of_its_closed_form():
    bar = SphericalFourBar(0.5, 1.2, 1.0, 1.3)
    start = 0.8
    measured = measures(bar.linkage(start))
    assert measured.range.full
    assert len(measured.dead_centres) == 2
    closed = bar.dead_centres
    wanted = sorted((each.drive - start) % tau for each in (closed.outer, closed.inner))
    assert sorted(each.drive for each in measured.dead_centres) == pytest.approx(wanted, abs=1e-9)
    assert measured.travel == pytest.approx(bar.swing, abs=1e-10)


def test_an_rssr_swings_as_its_closed_form():
    measured = measures(WIPER.linkage(0.3))
    assert measured.output == "R(frame-rocker)"
    assert measured.travel == pytest.approx(WIPER.swing(), abs=1e-10)
    wanted = sorted((each.drive - 0.3) % tau for each in WIPER.dead_centres())
    assert sorted(each.drive for each in measured.dead_centres) == pytest.approx(wanted, abs=1e-9)


def test_bennetts_ratio_is_the_extreme_one_of_its_closed_form():
    bennett = Bennett(3.0, 0.6, 1.0)
    measured = measures(bennett.linkage())
    assert measured.turns == -1
    first = np.linspace(0, tau, 200_001)
    ratio = abs(bennett.speed_ratio(first))
    assert abs(measured.least_ratio.value) == pytest.approx(ratio.max(), rel=1e-8)
    assert abs(measured.greatest_ratio.value) == pytest.approx(ratio.min(), rel=1e-8)


def test_a_winch_travels_by_its_lead():
    measured = gr.measures(entry("winch_screw").placed())
    assert measured.travel == pytest.approx(12.0, abs=1e-9)
    assert measured.least_ratio.value == pytest.approx(-12 / tau, abs=1e-12)
    assert measured.range.stops == (None, None)


def test_ends_of_a_range_have_their_reasons():
    places = {0: {"z": (0, 0, 1)}, 1: (2, 0, 0), 2: (3.125, 0.5, 0), 3: {"at": (4, 0, 0), "z": (0, 0, 1)}}
    mechanism = gr.Mechanism.parse("spatial: R(0-1) S(1-2) S(2-3) R(0-3); drive=R(0-1)")
    measured = measures(SpatialLinkage(mechanism, places))
    assert not measured.range.full
    assert measured.explain().count("the drive stands at its limit") == 2
    ratios = measured.least_ratio, measured.greatest_ratio  # the rocker moves on where the crank turns back
    assert [each.value for each in ratios] == [-np.inf, np.inf]
    assert sorted(each.at for each in ratios) == [measured.range.lowest, measured.range.highest]
    assert "from -∞ at" in measured.explain()
    assert measured.to_json()["ends"] == [stop.explain() for stop in measured.range.stops]


def test_a_table_has_rates_by_the_drive():
    linkage = machines.hooke(0.5).with_drives([0])
    h = 1e-4
    motion = followed(linkage, np.array([[0.7 - h], [0.7], [0.7 + h]]), order=2)
    table = spatial_table(motion, points=["R(in-cross)"], by_drive=True)
    output = np.radians(table["R(0-out)"])
    assert table["R(0-out)′"][1] == pytest.approx((output[2] - output[0]) / (2 * h), abs=1e-7)
    assert [column.unit for column in table][:4] == ["°", "°", "", "1/rad"]
    german = [column.name for column in spatial_table(motion, by_drive=True, lang="de")]
    assert german == ["D(0-in)", "D(0-out)", "D(0-out)′", "D(0-out)′′"]
    assert table["R(in-cross) vx"][1] == pytest.approx(0, abs=1e-12)  # the middle of the cross stays
    with pytest.raises(LinkageError, match="without branch and speed"):
        measures(linkage, speed=3.0)
    with pytest.raises(LinkageError, match="expected a joint of two links that is no ball"):
        measures(WIPER.linkage(0.3), output="S(crank-rod)")


def test_a_motion_has_its_table_with_rates_in_time():
    """A joint bent by 30 degrees, driven at 5 rad/s: 5 cos δ / (1 - sin² δ cos² φ), and the derivative of that."""
    motion = gr.move(entry("universal_joint").placed(), [0.0, 0.4], speed=5.0)
    table = motion.table(points=["R(frame-input)"])
    phi, delta = motion.drives[:, 0], pi / 6
    below = 1 - (np.sin(delta) * np.cos(phi)) ** 2
    assert table["ω R(frame-output)"] == pytest.approx(5 * cos(delta) / below, rel=1e-12)
    slope = -5 * cos(delta) * np.sin(delta) ** 2 * np.sin(2 * phi) / below**2
    assert table["α R(frame-output)"] == pytest.approx(5 * slope, rel=1e-9, abs=1e-9)
    assert [column.unit for column in table][:4] == ["°", "°", "rad/s", "rad/s²"]
    assert table["R(frame-input) vz"] == pytest.approx(0, abs=1e-12)
    assert motion.table(lang="de").columns[0].name == "D(frame-input)"
    assert len(motion.to_dataframe()) == 2


def test_a_piston_begins_at_zero_and_not_at_its_rounding():
    assert "from 0 mm to 27.3616 mm" in measures(entry("wobble_plate").placed()).explain()


def test_links_of_a_spherical_crank_rocker_turn_as_grashof_says():
    lengths = SphericalFourBar(0.5, 1.2, 1.0, 1.4)  # the shortest arc is the crank
    assert [row.full for row in gr.rotatability(lengths)] == [True, True, False, False]
    with pytest.raises(LinkageError, match="no assembly mode to choose"):
        gr.rotatability(lengths, branch="+")


def limits_of_directions(*axes):
    """Where the directions of four axes close a spherical four-bar no longer: three of them, the first of which the
    drive turns, have the Gram determinant 0. It is C + A cos φ + B sin φ in squares of c = u(φ) · w, so that zeros are
    those of a quadratic in c: 1 + 2 a b c - a² - b² - c² = 0."""
    first, second, third, fourth = (np.array(axis) / np.linalg.norm(axis) for axis in axes)
    a, b = second @ third, third @ fourth
    along = (first @ second) * (first @ fourth)
    even, odd = second @ fourth - along, np.cross(first, second) @ fourth
    found = []
    for c in (a * b + side * np.sqrt((1 - a * a) * (1 - b * b)) for side in (-1, 1)):
        share = (c - along) / np.hypot(even, odd)
        if abs(share) <= 1:
            found += [np.arctan2(odd, even) + side * np.arccos(share) for side in (-1, 1)]
    return np.sort(np.array(found) % tau)


RCCC = [
    ((0, 0, 0), (0, 0, 1)),
    ((1, 0.3, 0), (0.2, 0.5, 1)),
    ((1, 2, 0.3), (-0.3, 0.9, 1)),
    ((3, 0, 0), (0.9, -0.3, 1)),
]


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e6])
def test_an_rccc_whose_shifts_grow_without_end_says_so(size):
    """Its drive goes as far as the directions do, and the shifts with the inverse root of the distance from there."""
    linkage = placed_loop("RCCC", *((tuple(size * x for x in at), axis) for at, axis in RCCC))
    limits = limits_of_directions(*(axis for _, axis in RCCC))
    measured = measures(linkage)
    span = measured.range
    for found in (span.lowest, span.highest):
        assert min(abs(np.exp(1j * found) - np.exp(1j * limits))) < 1e-12
    assert [stop.reason for stop in span.stops] == ["endless", "endless"]
    assert "the shifts in C(a-b), C(b-c), C(c-frame) grow without end" in span.explain()
    assert measured.travel == np.inf
    assert "Output C(c-frame): unbounded, from " in measured.explain()
    near = followed(linkage, span.highest - np.array([[1e-4], [1e-6]]))
    far, nearer = (near.joint(1, "Tz") / size).tolist()
    assert nearer / far == pytest.approx(10, rel=0.05)
    sides = [
        np.sign(followed(linkage, np.array([[end]])).joint(3, "Tz")[0])
        for end in (span.lowest + 1e-6, span.highest - 1e-6)
    ]
    (row,) = (row for row in measured.joints if (row.joint, row.freedom) == ("C(c-frame)", "Tz"))
    assert (row.lowest == -np.inf, row.highest == np.inf) == (-1 in sides, 1 in sides)


def test_random_rccc_reach_the_limits_of_their_directions():
    rng = np.random.default_rng(5)
    bounded = 0
    for _ in range(40):
        places = [(tuple(rng.normal(size=3)), tuple(rng.normal(size=3))) for _ in range(4)]
        limits = limits_of_directions(*(axis for _, axis in places))
        span = gr.drive_range(placed_loop("RCCC", *places))
        assert span.full == (not len(limits))
        if span.full:
            continue
        bounded += 1
        below, above = (limits - tau).max() if limits.size else 0, limits.min()
        assert [span.lowest, span.highest] == pytest.approx([below, above], abs=1e-11)
        assert [stop.reason for stop in span.stops] == ["endless", "endless"]
    assert bounded > 10


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_slide_across_a_turning_slot_goes_to_infinity(space):
    """The slot stands at right angles to its slide after a quarter turn: x = h tan φ."""
    chain = Chain.parse(f"{space}: R(frame-slot) P(slot-block) R(block-slide) P(slide-frame)")
    places = [
        {"at": (0, 0, 0)},
        {"at": (0, 0, 0), "x": (0, 1, 0)},
        {"at": (0, 2, 0)},
        {"at": (0, 2, 0), "x": (1, 0, 0)},
    ]
    for number in (0, 2):
        places[number] |= {"z": (0, 0, 1)} if space == "spatial" else {}
    linkage = SpatialLinkage(Mechanism(chain, "frame", [0]), dict(enumerate(places)))
    span = gr.drive_range(linkage)
    assert [span.lowest, span.highest] == pytest.approx([-pi / 2, pi / 2], abs=1e-12)
    measured = measures(linkage)
    (row,) = (row for row in measured.joints if row.joint == "P(slide-frame)")
    assert (row.lowest, row.highest, measured.travel) == (-np.inf, np.inf, np.inf)
    assert abs(followed(linkage, np.array([[1.2]])).joint(3, "Tx")[0]) == pytest.approx(2 * np.tan(1.2), abs=1e-12)


@pytest.mark.parametrize(
    "second",
    [
        pytest.param([((1, 0, 0), None), ((2, 0, 0), (0, 0, 1))], id="cranks touch"),
        pytest.param([((2, 0, 3), None), ((2, 0, 0), (0, 0, 1))], id="the rocker's ball is on its axis"),
    ],
)
def test_an_isolated_position_is_no_range(second):
    """Two circles that touch; a rod that is shortest to a point that rests: next to the position nothing closes."""
    linkage = placed_loop("RSSR", ((0, 0, 0), (0, 0, 1)), ((1, 0, 0), None), *second)
    for ask in (gr.drive_range, measures):
        with pytest.raises(LinkageError, match=r"isolated, S\(a-b\), S\(b-c\), R\(c-frame\) close there"):
            ask(linkage)
    motion = gr.move(linkage, [0.0, 1.0])
    assert (len(motion), motion.stop.reason, motion.stop.drives) == (1, "isolated", (0.0,))


def test_a_reference_pose_in_a_limit_is_not_called_isolated():
    """The rocker's ball moves across the rod: the drive turns back there, and the linkage moves on to one side.

    With q from the centre of the rocker's circle to the crank's ball the rod closes at an angle x of the rocker if
    A cos x + B sin x = C: while A² + B² - C² is not negative.
    """
    rng = np.random.default_rng(3)
    for size in np.resize([1e-6, 1.0, 1e6], 12):
        axis, own, middle, arm, at = rng.normal(size=(5, 3))
        axis, own = axis / np.linalg.norm(axis), own / np.linalg.norm(own)
        arm = arm - axis * (axis @ arm)
        across = np.cross(axis, arm)
        rod = np.cross(across, rng.normal(size=3))

        def excess(angle, own=own, middle=middle, arm=arm, across=across, at=at, rod=rod):
            crank = middle + arm - rod - at
            turned = crank * cos(angle) + np.cross(own, crank) * np.sin(angle) + own * (own @ crank) * (1 - cos(angle))
            q = at + turned - middle
            return (q @ arm) ** 2 + (q @ across) ** 2 - ((q @ q + arm @ arm - rod @ rod) / 2) ** 2

        assert excess(0.0) == pytest.approx(0, abs=1e-9)
        assert excess(1e-3) * excess(-1e-3) < 0
        joints = [(at, tuple(own)), (middle + arm - rod, None), (middle + arm, None), (middle, tuple(axis))]
        linkage = placed_loop("RSSR", *((tuple(size * place), z) for place, z in joints))
        for ask in (gr.drive_range, measures):
            with pytest.raises(LinkageError, match="another reference pose if this one is singular"):
                ask(linkage)


def test_a_ball_on_the_crank_axis_drives_nothing():
    """The ball of the crank rests, so that the rocker does: its ratio is 0, not a number of rounding."""
    linkage = placed_loop("RSSR", ((0, 0, 0), (0, 0, 1)), ((0, 0, 1), None), ((2, 1, 2), None), ((2, 0, 0), (0, 1, 0)))
    assert "output by drive: 0, constant" in measures(linkage).explain()


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_the_speed_ratio_grows_as_shifts_without_end_do(size):
    """A slot on a line in the distance 2 of the crank's axis: its shift is 2 tan x, the ratio 2 / cos² x."""
    places = {0: {"z": (0, 0, 1)}, 1: {"x": (1, 0, 0)}, 2: {"at": (2, 0, 0), "z": (0, 0, 1)}}
    places[3] = {"at": (2, 0, 0), "x": (0, 1, 0)}
    scaled = {k: each | {"at": tuple(size * np.array(each.get("at", (0, 0, 0))))} for k, each in places.items()}
    mechanism = gr.Mechanism.parse("spatial: R(frame-a) P(a-b) R(b-c) P(c-frame); drive=R(frame-a)")
    measured = measures(SpatialLinkage(mechanism, scaled))
    assert sorted(abs(each.value) / size for each in measured.ratios) == pytest.approx([2.0, np.inf, np.inf], abs=1e-9)


def test_a_narrow_gap_ends_the_range():
    """Between the two limits, zeros of A² + B² - C² (see above) by bisection, nothing closes for half a degree."""
    places = [
        ((0.71288735, 0.76993652, -0.29845955), (0.56529511, 0.34706549, 0.31314966)),
        ((-0.34179643, -0.46297793, 0.11862428), None),
        ((1.43171786, 2.32598542, -0.36980575), None),
        ((-1.05434709, -0.34156053, -0.83514309), (-0.4170599, 0.39678218, -0.91425153)),
    ]
    linkage = placed_loop("RSSR", *places)
    span = gr.drive_range(linkage)
    assert np.degrees([span.lowest, span.highest]) == pytest.approx([1.8035932294 - 360, 1.1679069974], abs=1e-8)
    over = gr.move(linkage, [[0.0], [1.0]])
    assert (len(over), over.passed) == (1, ())


def test_two_cranks_on_one_axis_with_one_ball_turn_together():
    linkage = placed_loop(
        "RSSR", ((0, 0, 0), (0, 0, 1)), ((1, 0, 0), None), ((1, 1e-12, 0), None), ((0, 0, 2), (0, 0, 1))
    )
    measured = measures(linkage)
    assert (measured.range.full, measured.turns) == (True, 1)
