"""Wheels in linkages: against Willis' equations, closed forms, the circuit, and the laws of rolling."""

from fractions import Fraction
from math import gcd, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.machines.gears import Mesh, Train, speeds
from gruebler.mechanics.analysis import measures, motion_roles, rotatability
from gruebler.mechanics.kinematics import circuit, from_degrees, move, move_many
from gruebler.mechanics.linkages import Circle, Linkage, LinkPoint, Wheel
from gruebler.structure.mechanism import Mechanism

TEETH = st.integers(12, 90)


def geared_five_bar(first=20.0, second=40.0, belt=""):
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4) G(1-4); frame=0; drive=R(0-1)")
    wheels = {"1": Wheel(0, 0, first, belt=belt), "4": Wheel(60, 0, second, belt=belt)}
    places = {"R(0-1)": (0, 0), "R(0-4)": (60, 0), "R(1-2)": (10, 5), "R(2-3)": (30, 50), "R(3-4)": (75, 10)}
    return Linkage.from_drawing(mechanism, {**places, "G(1-4)": wheels}, points={"C": ("2", 20, 40)})


def planetary(sun, planet, ring, drives=("sun", "ring"), second_planet=False):
    """Sun, planets and ring on a carrier; all coaxial, module 2."""
    text = "R(frame-sun) R(frame-ring) R(frame-carrier) R(carrier-p) G(sun-p) G(p-ring)"
    text += " R(carrier-q) G(sun-q) G(q-ring)" * second_planet
    marks = "".join(f"; drive=R(frame-{link})" for link in drives)
    places = {f"R(frame-{link})": (0, 0) for link in ("sun", "ring", "carrier")}
    for name, side in (("p", 1), ("q", -1))[: 1 + second_planet]:
        x = side * (sun + planet)
        places[f"R(carrier-{name})"] = (x, 0)
        places[f"G(sun-{name})"] = {"sun": Wheel(0, 0, sun, teeth=sun), name: Wheel(x, 0, planet, teeth=planet)}
        places[f"G({name}-ring)"] = {"ring": Wheel(0, 0, -ring, teeth=-ring), name: Wheel(x, 0, planet, teeth=planet)}
    return Linkage.from_drawing(Mechanism.parse(f"{text}; frame=frame{marks}"), places)


def friction(first=20.0, shift=(0.0, 0.0)):
    """A wheel that a lever presses against another, which may turn about a point beside its centre."""
    mechanism = Mechanism.parse("R(0-1) W(1-2) R(2-arm) R(0-arm); frame=0; drive=R(0-1)")
    radius = abs(complex(50, 10) - complex(*shift)) - first
    wheels = {"1": Wheel(*shift, first), "2": Wheel(50, 10, radius)}
    return Linkage.from_drawing(
        mechanism, {"R(0-1)": (0, 0), "R(2-arm)": (50, 10), "R(0-arm)": (60, -30), "W(1-2)": wheels}
    )


def eccentric_pair():
    """Toothed wheels whose centres no link holds: the second wheel sits on a lever that an eccentric pin moves."""
    mechanism = Mechanism.parse("R(0-1) R(0-lever) R(lever-2) R(1-rod) R(rod-lever) G(1-2); frame=0; drive=R(0-1)")
    wheels = {"1": Wheel(2, 1, 20), "2": Wheel(50, 0, 30)}
    places = {"R(0-1)": (0, 0), "R(0-lever)": (50, -60), "R(lever-2)": (50, 0)}
    return Linkage.from_drawing(mechanism, {**places, "R(1-rod)": (0, 6), "R(rod-lever)": (55, 12), "G(1-2)": wheels})


def rolling_cart():
    """A crank pulls a wheel to and fro on the ground."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) W(0-3); frame=0; drive=R(0-1)")
    places = {"R(0-1)": (0, 10), "R(1-2)": (10, 12), "R(2-3)": (80, 15)}
    return Linkage.from_drawing(mechanism, {**places, "W(0-3)": {"0": (0, 0, 0), "3": Wheel(80, 15, 15)}})


def rack():
    mechanism = Mechanism.parse("R(0-pinion) P(0-rack) G(pinion-rack); frame=0; drive=R(0-pinion)")
    wheels = {"pinion": Wheel(0, 0, 10), "rack": (0, -10, 0.3)}
    return Linkage.from_drawing(
        mechanism, {"R(0-pinion)": (0, 0), "P(0-rack)": (0, -20, 0.3), "G(pinion-rack)": wheels}
    )


# --- speeds: Willis ----------------------------------------------------------------------------------


@settings(max_examples=15, deadline=None)
@given(TEETH, TEETH, st.sampled_from([("sun", "ring"), ("sun", "carrier"), ("ring", "carrier")]))
def test_planetary_trains_run_as_willis_says(sun, planet, drives):
    ring = sun + 2 * planet
    linkage = planetary(sun, planet, ring, drives, second_planet=True)
    given_speeds = dict(zip(drives, (3, -2), strict=True))
    train = Train(
        (
            Mesh(a="sun", b="p", size_a=sun, size_b=planet, carrier="carrier"),
            Mesh(a="p", b="ring", size_a=planet, size_b=-ring, carrier="carrier"),
        )
    )
    wanted = speeds(train, given_speeds).values
    path = np.linspace(0, 1.5, 10)[:, None] * [list(given_speeds.values())]
    motion = move(linkage, path, speed=[list(given_speeds.values())], order=3)
    assert motion.complete
    assert motion.closure_error < 1e-12
    for link, value in wanted.items():
        np.testing.assert_allclose(motion.angular(link), float(value), rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(motion.angle(link), float(value) * np.linspace(0, 1.5, 10), atol=1e-11)
        assert np.abs(motion.rates[1:, :, motion.link_index(link)]).max() < 1e-9


@settings(max_examples=15, deadline=None)
@given(
    st.lists(
        st.tuples(TEETH, TEETH, st.sampled_from(["external", "internal", "open", "crossed"])), max_size=4, min_size=1
    )
)
def test_trains_on_fixed_axes(pairs):
    ratio, joints, places, x = Fraction(1), ["R(0-1)"], {"R(0-1)": (0, 0)}, 0.0
    for k, (a, b, kind) in enumerate(pairs, 1):
        size = -a - b if kind == "internal" else b
        belt = kind if kind in ("open", "crossed") else ""
        step = 500.0 if belt else float(abs(a + size))
        x, before = x + step, x
        joints += [f"R(0-{k + 1})", f"G({k}-{k + 1})"]
        places[f"R(0-{k + 1})"] = (x, 0)
        places[f"G({k}-{k + 1})"] = {
            str(k): Wheel(before, 0, a, teeth=a, belt=belt),
            str(k + 1): Wheel(x, 0, size, teeth=size, belt=belt),
        }
        ratio *= Fraction(a, size) if kind == "open" else Fraction(-a, size)
    linkage = Linkage.from_drawing(Mechanism.parse(f"{' '.join(joints)}; frame=0; drive=R(0-1)"), places)
    motion = move(linkage, from_degrees(0, 400, 5), speed=1)
    assert motion.complete
    last = str(len(pairs) + 1)
    np.testing.assert_allclose(motion.angular(last), float(ratio), rtol=1e-12)
    np.testing.assert_allclose(motion.angle(last), float(ratio) * motion.drives[:, 0], rtol=1e-12, atol=1e-12)


def test_fergusons_paradox():
    """Three wheels of 99, 100 and 101 teeth on one planet; the middle one stands (Ferguson 1764)."""
    text = "R(0-arm) R(arm-p) G(0-p) R(0-fast) G(p-fast) R(0-slow) G(p-slow); frame=0; drive=R(0-arm)"
    planet = Wheel(120, 0, 20, teeth=20)
    places = {"R(0-arm)": (0, 0), "R(arm-p)": (120, 0), "R(0-fast)": (0, 0), "R(0-slow)": (0, 0)}
    places |= {"G(0-p)": {"0": Wheel(0, 0, 100, teeth=100), "p": planet}}
    for link, teeth in (("fast", 99), ("slow", 101)):  # cut to the same size
        radius = teeth * 120 / (teeth + 20)
        places[f"G(p-{link})"] = {link: Wheel(0, 0, radius, teeth=teeth), "p": Wheel(120, 0, 120 - radius, teeth=20)}
    motion = move(Linkage.from_drawing(Mechanism.parse(text), places), from_degrees(0, 3600, 5))
    assert motion.angle("slow")[-1] / (20 * pi) == pytest.approx(1 / 101, abs=1e-13)
    assert motion.angle("fast")[-1] / (20 * pi) == pytest.approx(-1 / 99, abs=1e-13)


# --- curves with a closed form -----------------------------------------------------------------------


def test_cardan_circles():
    """A point of the rim of a wheel that rolls in a ring of twice its radius moves on a straight line."""
    mechanism = Mechanism.parse("R(0-arm) R(arm-p) G(0-p); frame=0; drive=R(0-arm)")
    wheels = {"0": Wheel(0, 0, -20, teeth=-40), "p": Wheel(10, 0, 10, teeth=20)}
    places = {"R(0-arm)": (0, 0), "R(arm-p)": (10, 0), "G(0-p)": wheels}
    motion = move(
        Linkage.from_drawing(mechanism, places, points={"P": ("p", 20, 0)}), from_degrees(0, 3600, 7), speed=1, order=3
    )
    angle = motion.drives[:, 0]
    rates = np.cos(angle), -np.sin(angle), -np.cos(angle), np.sin(angle)
    for order, wanted in enumerate(rates):
        np.testing.assert_allclose(motion.complex_point("P", order=order), 20 * wanted, atol=1e-11)


def test_a_wheel_on_a_rack_draws_a_cycloid():
    mechanism = Mechanism.parse("P(0-axle) R(axle-wheel) G(0-wheel); frame=0; drive=P(0-axle)")
    wheels = {"0": (0, 0, 0), "wheel": Wheel(0, 5, 5)}
    places = {"P(0-axle)": (0, 5, 0), "R(axle-wheel)": (0, 5), "G(0-wheel)": wheels}
    motion = move(
        Linkage.from_drawing(mechanism, places, points={"P": ("wheel", 0, 0)}), np.linspace(-40, 90, 300), speed=2
    )
    t = motion.drives[:, 0] / 5
    np.testing.assert_allclose(motion.point("P"), 5 * np.stack([t - np.sin(t), 1 - np.cos(t)], 1), atol=1e-12)
    np.testing.assert_allclose(motion.point("P", order=1), 2 * np.stack([1 - np.cos(t), np.sin(t)], 1), atol=1e-12)


def test_an_eccentric_disc_is_a_slider_crank():
    """A flat follower on a smooth eccentric disc moves as the sine."""
    mechanism = Mechanism.parse("R(0-disc) P(0-follower) G(disc-follower); frame=0; drive=R(0-disc)")
    touch = {"disc": Circle(3, 0, 10), "follower": (3, 10, 0)}
    places = {"R(0-disc)": (0, 0), "P(0-follower)": (0, 20, pi / 2), "G(disc-follower)": touch}
    motion = move(Linkage.from_drawing(mechanism, places), from_degrees(0, 360, 5), speed=1, order=3)
    assert motion.complete
    t = motion.drives[:, 0]
    lift = motion.displacement("P(0-follower)")
    np.testing.assert_allclose(lift - lift[0], 3 * np.sin(t), atol=1e-12)
    np.testing.assert_allclose(motion.displacement("P(0-follower)", order=3), -3 * np.cos(t), atol=1e-12)


# --- laws ---------------------------------------------------------------------------------------------

LINKAGES = {
    "five-bar": geared_five_bar(),
    "five-bar with a belt": geared_five_bar(30, 20, "open"),
    "five-bar with a crossed belt": geared_five_bar(24, 36, "crossed"),
    "friction": friction(),
    "eccentric friction": friction(shift=(3.0, 4.0)),
    "eccentric teeth": eccentric_pair(),
    "cart": rolling_cart(),
    "rack": rack(),
}


@pytest.mark.parametrize("linkage", LINKAGES.values(), ids=LINKAGES)
def test_joints_stay_closed_and_the_way_back_is_the_same(linkage):
    there = from_degrees(0, 1000, 5)
    motion = move(linkage, np.concatenate([there, there[-2::-1]]), speed=1)
    assert motion.complete
    assert motion.closure_error < 1e-12
    np.testing.assert_allclose(motion.places[0], motion.places[0][::-1], atol=1e-10)
    np.testing.assert_allclose(motion.turns, motion.turns[::-1], atol=1e-11)


@pytest.mark.parametrize("linkage", LINKAGES.values(), ids=LINKAGES)
def test_rates_are_derivatives(linkage):
    h = 1e-3
    motion = move(linkage, 0.7 + h * np.arange(-4, 5), speed=1, order=3)
    weights = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / (840 * h)
    for order in range(3):
        for link in range(motion.turns.shape[1]):
            values = motion.rates[order - 1, :, link] if order else np.unwrap(np.angle(motion.turns[:, link]))
            assert weights @ values == pytest.approx(motion.rates[order, 4, link], abs=2e-9)
            moved = weights @ motion.places[order, :, link]
            assert moved == pytest.approx(motion.places[order + 1, 4, link], abs=1e-8)


@pytest.mark.parametrize("linkage", LINKAGES.values(), ids=LINKAGES)
def test_the_circuit_finds_the_same(linkage):
    """By arc length, with all joints at once and arms between free centres, angles as they stand in the unknowns."""
    made = circuit(linkage, most=20)
    rows = len(made) // 4
    motion = move(linkage, made.drive[:rows])
    assert motion.complete
    assert made.closure < 1e-10
    for link in linkage.mechanism.chain.links:
        np.testing.assert_allclose(np.exp(1j * motion.angle(link)), np.exp(1j * made.angle(link)[:rows]), atol=1e-10)


def test_no_slip_at_the_contact():
    linkage = friction(shift=(3.0, 4.0))
    motion = move(linkage, from_degrees(0, 720, 3), speed=1)
    assert np.ptp(motion.angular("arm")) > 0.05
    one, two = linkage.element("W(1-2)", "1"), linkage.element("W(1-2)", "2")
    first, second = LinkPoint("1", one.x, one.y), LinkPoint("2", two.x, two.y)
    along = motion.complex_point(second) - motion.complex_point(first)
    np.testing.assert_allclose(np.abs(along), one.radius + two.radius, rtol=1e-13)
    along /= np.abs(along)
    touch = motion.complex_point(first, order=1) + 1j * motion.angular("1") * one.radius * along
    other = motion.complex_point(second, order=1) - 1j * motion.angular("2") * two.radius * along
    np.testing.assert_allclose(touch, other, atol=1e-12)


@settings(max_examples=8, deadline=None)
@given(st.integers(10, 40), st.integers(10, 40))
@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows many turns apart
def test_a_geared_five_bar_closes_after_its_cycle(first, second):
    """The path of a point closes after second / gcd turns of the drive, and not before."""
    linkage = geared_five_bar(float(first), float(second))
    turns = second // gcd(first, second)
    motion = move(linkage, 2 * pi * np.arange(0, turns + 1))
    path = motion.point("C")
    assert np.abs(path[-1] - path[0]).max() < 1e-11
    assert (np.abs(path[1:-1] - path[0]).max(axis=1) > 1e-6).all()
    if turns <= 6:
        made = circuit(linkage)
        assert made.closed
        assert round(float(np.ptp(made.drive[[0, -1]])) / (2 * pi), 9) == turns


def test_measures_know_the_cycle():
    found = measures(geared_five_bar(10.0, 30.0))
    assert found.span.turns == 3
    assert found.span.full
    assert measures(geared_five_bar(7.0, 60.0)).span.turns == 60


def test_measures_of_wheels():
    found = measures(friction())
    assert not found.span.full  # the radii have no common measure
    assert found.span.high - found.span.low == pytest.approx(2 * pi * 16)
    assert motion_roles(geared_five_bar())["4"].value == "crank"
    assert {row.joint for row in rotatability(geared_five_bar())} == {
        "R(0-1)", "R(1-2)", "R(2-3)", "R(3-4)", "R(0-4)"
    }  # fmt: skip
    train = Mechanism.parse("R(0-1) R(0-2) G(1-2); frame=0; drive=R(0-1)")
    wheels = {"1": Wheel(0, 0, 20), "2": Wheel(50, 0, 30)}
    pair = Linkage.from_drawing(train, {"R(0-1)": (0, 0), "R(0-2)": (50, 0), "G(1-2)": wheels})
    assert measures(pair).transmission is None
    assert measures(pair).transfer.uniform


@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows many turns apart
def test_many_turns_do_not_add_up_to_an_error():
    linkage = geared_five_bar(20.0, 30.0)
    motion = move(linkage, 2 * pi * np.array([0, 3, 30, 300, 3000]))
    np.testing.assert_allclose(motion.point("C"), np.tile(motion.point("C")[0], (5, 1)), atol=1e-9)


def test_the_first_row_may_be_far_from_home_and_the_drive_counts_its_turns():
    linkage = geared_five_bar(20.0, 40.0)
    motion = move(linkage, from_degrees(0, 1080, 5))
    late = move(linkage, from_degrees(720, 1080, 5))
    np.testing.assert_allclose(late.places[0], motion.places[0, -len(late) :], atol=1e-11)
    assert np.abs(motion.point("C")[72] - motion.point("C")[0]).max() > 1


def test_branches_of_what_wheels_do_not_depend_on():
    linkage = geared_five_bar()
    up, down = (move(linkage, from_degrees(0, 300, 5), branch=branch) for branch in "+-")
    np.testing.assert_allclose(up.angle("4"), down.angle("4"), atol=1e-12)
    assert np.abs(up.point("C") - down.point("C")).max() > 10
    with pytest.raises(LinkageError, match="a branch of this linkage"):
        move(linkage, [0], branch="++")


def test_two_wheels_with_fixed_bearings_roll_although_the_count_says_no():
    mechanism = Mechanism.parse("R(0-1) R(0-2) W(1-2); frame=0; drive=R(0-1)")
    places = {"R(0-1)": (0, 0), "R(0-2)": (50, 0), "W(1-2)": {"1": Wheel(0, 0, 20), "2": Wheel(50, 0, 30)}}
    motion = move(Linkage.from_drawing(mechanism, places), from_degrees(0, 720, 10), speed=3)
    np.testing.assert_allclose(motion.angular("2"), -2, rtol=1e-13)


def test_wheels_need_a_reference_pose():
    linkage = geared_five_bar()
    bare = Linkage(linkage.mechanism, linkage._by_link())
    with pytest.raises(LinkageError, match="needs a reference pose"):
        move(bare, [0])
    with pytest.raises(LinkageError, match="one by one"):
        move_many([linkage, linkage.scaled(2)], [0, 1])


def test_scaled_and_mirrored():
    linkage = friction(shift=(3.0, 4.0))
    path = from_degrees(0, 300, 5)
    motion = move(linkage, path)
    large, mirror = move(linkage.scaled(3), path), move(linkage.mirrored(), -path)
    np.testing.assert_allclose(large.places[0], 3 * motion.places[0], atol=1e-10)
    np.testing.assert_allclose(mirror.places[0], motion.places[0].conj(), atol=1e-10)
