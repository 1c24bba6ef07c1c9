"""Free motion: against exact forms, other formulations and published benchmarks; energy is a witness everywhere."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipk

from gruebler.base.errors import LinkageError
from gruebler.machines.cams import read_lift
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.dynamics import EquationsOfMotion, equilibria, influences_of, linearised, simulate
from gruebler.mechanics.dynamics.charts import Charts
from gruebler.mechanics.dynamics.starts import starting_pose
from gruebler.mechanics.forces import Loads, Motor, RigidBody, Spring
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage, LinkPoint, Wheel
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.kinematics import test_cams_in_linkages as cams


def turned(angle):
    return np.exp(1j * angle)


def xy(z):
    return (z.real, z.imag)


def windows(n):
    """IFToMM benchmark A02: n + 1 cranks and n couplers of 1 m and 1 kg, upright; all cranks stay parallel."""
    pins = [f"k{i}" + (f"-c{i - 1}" if i else "") + (f"-c{i}" if i < n else "") for i in range(n + 1)]
    joints = [f"R(0-k{i})" for i in range(n + 1)] + [f"R({p})" for p in pins]
    mechanism = Mechanism.parse(" ".join(joints) + "; frame=0; drive=R(0-k0)")
    places = {joint: (float(k % (n + 1)), float(k > n)) for k, joint in enumerate(joints)}
    bodies = {link: RigidBody(1.0, (0.5, 0.0), 1 / 12) for link in mechanism.chain.links if link != "0"}
    return Linkage.from_drawing(mechanism, places, unit="m"), Loads(bodies=bodies, gravity=(0, -9.81))


def exact_windows(n, time):
    """Angle from upright and its speed: one pendulum, J = (n + 1)/3 + n, G = 9.81 ((n + 1)/2 + n)."""
    ratio = 9.81 * ((n + 1) / 2 + n) / ((n + 1) / 3 + n)
    return solve_ivp(
        lambda _, y: [y[1], ratio * np.sin(y[0])], (0, time), [0, 1], method="DOP853", rtol=3e-14, atol=1e-15
    ).y[:, -1]


@pytest.mark.parametrize(
    ("n", "time"),
    [
        (2, 2.0),
        pytest.param(2, 10.0, marks=pytest.mark.slow),
        pytest.param(10, 10.0, marks=pytest.mark.slow),
        pytest.param(40, 20.0, marks=pytest.mark.slow),
    ],
)
def test_windows_pass_their_change_points_as_one_pendulum(n, time):
    linkage, loads = windows(n)
    fall = simulate(linkage, loads, speed=-1.0, until=time, times=[0, time], tolerance=1e-12)
    angle, speed = exact_windows(n, time)
    assert fall.complete
    assert fall.drives[-1, 0] == pytest.approx(np.pi / 2 - angle, abs=1e-9)
    assert fall.speeds[-1, 0] == pytest.approx(-speed, abs=1e-9)
    assert fall.defect < 1e-10


SIX_BARS = {
    "Watt": ("3-4", (2, 0), (1.8, 1.3), (3.8, 2.0), (4.2, 0.3)),
    "Stephenson": ("2-4", (1.2, 0.5), (1.2, 1.5), (3.8, 2.0), (4.2, 0.3)),
    "Stephenson, drag link": ("2-4", (1.2, 0.5), (1.2, 1.5), (2.3, 1.7), (1.5, 0.7)),
    "Stephenson, near a limit": ("2-4", (1.2, 0.5), (1.2, 1.5), (2.1751, 1.8063), (0.1491, -1.3172)),
}
"""Which link of a parallelogram drives a dyad, about which pivot the place turns where it does so, and its joints."""
CRANK = RigidBody(1.0, (0.5, 0), 1 / 12)


def dyad_masses(kind):
    """Those of link 5, whose x axis begins at the frame, lies 0.3 m from its joint with link 4."""
    *_, (x, y), (u, v) = SIX_BARS[kind]
    length = np.hypot(u - x, v - y)
    return {"4": RigidBody(0.7, (0.5, 0.1), 0.2), "5": RigidBody(0.8, (length - 0.3, 0), 0.1)}


def six_bar(kind):
    """A parallelogram of 2 m and 1 m, cranks upright, with a dyad."""
    driven, _, *dyad = SIX_BARS[kind]
    joints = f"R(0-1) R(1-2) R(2-3) R(0-3) R({driven}) R(4-5) R(0-5)"
    places = dict(zip(joints.split(), [(0, 0), (0, 1), (2, 1), (2, 0), *dyad], strict=True))
    linkage = Linkage.from_drawing(
        Mechanism.parse(f"{joints}; frame=0; drive=R(0-1)"), places, points={"C": ("2", 1.0, 1.0)}, unit="m"
    )
    return linkage, Loads(bodies={"1": CRANK, "3": CRANK, **dyad_masses(kind)}, masses={"C": 1.0}, gravity=(0, -9.81))


def its_four_bar(kind):
    """The coupler of the parallelogram only shifts: one crank with both inertias, and the coupler's mass at its end."""
    _, pivot, *dyad = SIX_BARS[kind]
    joints = "R(0-3) R(3-4) R(4-5) R(0-5)"
    places = dict(zip(joints.split(), [pivot, *dyad], strict=True))
    end = (pivot[0], pivot[1] + 1.0)
    linkage = Linkage.from_drawing(
        Mechanism.parse(f"{joints}; frame=0; drive=R(0-3)"), places, points={"E": ("3", *end)}, unit="m"
    )
    pose = linkage.required_pose["3"]
    middle = pose.to_local(pivot[0], pivot[1] + 0.5)
    both = RigidBody(2.0, middle, 2 / 12)
    return linkage, Loads(bodies={"3": both, **dyad_masses(kind)}, masses={"E": 1.0}, gravity=(0, -9.81))


def driven_by(linkage, drive):
    mechanism = linkage.mechanism
    return linkage.with_mechanism(Mechanism(mechanism.chain, mechanism.frame, [drive]))


def jets_of(charts, q, names):
    """Turns, speeds and accelerations of links by the drive, (rows, links)."""
    columns = [charts.plan.lower.mechanism.chain.links.index(name) for name in names]
    jets = charts.jets_at(q)
    return jets.turns[:, columns], *jets.rates[:, :, columns]


@pytest.mark.parametrize(
    ("kind", "drive"),
    [
        *(("Watt", drive) for drive in ("R(0-1)", "R(3-4)", "R(0-5)")),
        *(("Stephenson", drive) for drive in ("R(0-1)", "R(0-5)")),
        *(("Stephenson, drag link", drive) for drive in ("R(0-5)", "R(2-4)")),
        *(("Stephenson, near a limit", drive) for drive in ("R(1-2)", "R(4-5)")),
    ],
)
def test_six_bars_pass_the_change_points_of_their_parallelogram_as_a_four_bar(kind, drive):
    """Any joint may be the coordinate; of Stephenson's chain R(0-5) asks for a group of four links, until exchanged."""
    linkage, loads = six_bar(kind)
    driven = driven_by(linkage, drive)
    ratio = simulate(driven, loads, speed=1.0, until=1e-6, times=[0]).angular("1")[0]
    fall = simulate(driven, loads, speed=-1.0 / ratio, until=2.0, times=[0, 0.65, 1.0, 2.0], tolerance=1e-11)
    single, its = its_four_bar(kind)
    wanted = simulate(single, its, speed=-1.0, until=2.0, times=[0, 0.65, 1.0, 2.0], tolerance=1e-11)
    for link in ("4", "5"):
        gaps = [np.diff(run.angle(link)) for run in (fall, wanted)]
        assert gaps[0] == pytest.approx(gaps[1], abs=1e-8)
    turned = fall.angle("1") - fall.angle("1")[0]
    assert turned.min() < (-np.pi / 2 if "limit" in kind else -np.pi)  # past a change point, at 0, or also that at 180°
    assert turned == pytest.approx(wanted.angle("3") - wanted.angle("3")[0], abs=1e-8)
    assert fall.defect < 1e-9


@pytest.mark.parametrize("drive", ["R(0-5)", "R(2-4)"])
@pytest.mark.parametrize("side", [1, -1])
def test_a_group_of_four_links_passes_its_change_points_on_charts_alone(drive, side):
    """A turn of a drag link whose crank is a parallelogram, by triads; its four-bar has dyads and no change point."""
    linkage, _ = six_bar("Stephenson, drag link")
    single, _ = its_four_bar("Stephenson, drag link")
    solving = cached_plan(driven_by(linkage, drive))
    assert [len(group.roots) for group in solving.higher_groups] == [4]
    q, start = starting_pose(solving, None, None)
    charts = Charts(solving, start)
    six = jets_of(charts, q + side * np.linspace(0, 7, 141), "12345")
    assert charts.closed is not None
    four = cached_plan(driven_by(single, "R(0-5)"))
    q, start = starting_pose(four, None, None)
    rocker = np.unwrap(np.angle(six[0][:, 4] / six[0][0, 4]))
    turns, speeds, accelerations = jets_of(Charts(four, start), q + rocker, "345")
    crank = six[0][:, 0] / six[0][0, 0]
    assert crank.real.min() < -0.99  # it went round
    assert six[0][:, 1] == pytest.approx(np.full(141, six[0][0, 1]), abs=1e-10)  # its coupler only shifts
    assert six[0] / six[0][0] == pytest.approx(np.c_[crank, crank**0, turns / turns[0]], abs=1e-10)
    way, bend = (rates[:, [4]] for rates in six[1:])
    assert six[1][:, 2:] == pytest.approx(speeds * way, abs=1e-9)
    assert six[2][:, 2:] == pytest.approx(accelerations * way**2 + speeds * bend, abs=1e-8)


def test_windows_at_ten_seconds_as_printed():
    # the scalar form gives what Exudyn's example prints at h = 1.25e-4: (0.3284573768, 0.9445187937), to its 7e-7
    angle, _ = exact_windows(2, 10.0)
    assert (np.sin(angle), np.cos(angle)) == pytest.approx((0.3284573768, 0.9445187937), abs=1e-6)


def squeezer():
    """Andrews' squeezing mechanism, data of the test set for IVP solvers (Mazzia, Magherini), m, kg, s."""
    a, b, c = -0.06934 - 0.00227j, -0.03635 + 0.03273j, 0.014 + 0.072j
    beta, gamma = -0.0617138900142764496358948458001, 0.455279819163070380255912382449
    phi, delta = 0.222668390165885884674473185609, 0.487364979543842550225598953530
    omega, epsilon = -phi, 1.23054744454982119249735015568
    k1 = 0.007 * turned(beta)
    p = k1 - 0.028 * turned(beta)
    g, h = a + 0.04 * turned(delta), a - 0.04j * turned(epsilon)
    centres = {
        "K1": 92e-5 * turned(beta),
        "K2": k1 - 0.0115 * turned(beta),
        "K3": b + (0.01874 - 0.01043j) * turned(gamma),
        "K4": g - 1j * (0.02 - 0.01421) * turned(phi + delta),
        "K5": a + (0.02308 + 0.00916j) * turned(delta),
        "K6": h + (0.02 - 0.01421) * turned(omega + epsilon),
        "K7": a + (-0.01228j + 0.00449) * turned(epsilon),
    }
    mechanism = Mechanism.parse(
        "R(0-K1) R(K1-K2) R(K2-K3-K4-K6) R(0-K3) R(K4-K5) R(K6-K7) R(0-K5-K7); frame=0; drive=R(0-K1)"
    )
    points = {"c" + link: (link, *xy(z)) for link, z in centres.items()}
    points["D"] = ("K3", *xy(b + (0.02 - 0.018j) * turned(gamma)))
    places = [0j, k1, p, b, g, h, a]
    linkage = Linkage.from_drawing(
        mechanism, dict(zip(mechanism.chain.joint_names(), map(xy, places), strict=True)), points=points, unit="m"
    )
    masses = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498]
    inertias = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5]
    at = {link: linkage.points["c" + link] for link in centres}
    bodies = {
        link: RigidBody(m, (at[link].x, at[link].y), j) for link, m, j in zip(centres, masses, inertias, strict=True)
    }
    spring = Spring(("D", LinkPoint("0", *xy(c))), stiffness=4530, free_length=0.07785)
    return linkage, Loads(bodies=bodies, springs=(spring,), moments={"K1": 0.033}, gravity=(0, 0)), beta


def test_andrews_squeezer():
    # at 0.03 s by two methods: these equations, and seven angles with six multipliers (both 1e-12 or better); the
    # values that the test set prints (beta 15.81077119629904) are themselves off by 1.2e-9
    linkage, loads, beta = squeezer()
    run = simulate(linkage, loads, at=beta, until=0.03, times=[0, 0.03], tolerance=1e-12)
    assert run.accelerations[0, 0] == pytest.approx(14222.4439199541138705911625887, rel=1e-12)
    assert run.drives[-1, 0] == pytest.approx(15.81077119515, abs=1e-10)
    assert run.drives[-1, 0] == pytest.approx(15.81077119629904, abs=2e-9)
    assert run.speeds[-1, 0] == pytest.approx(1139.9203022590, rel=1e-10)
    assert run.accelerations[-1, 0] == pytest.approx(-24631.76312, rel=1e-9)
    assert run.rates[1, -1, run.link_index("K5")] == pytest.approx(16743.6354184, rel=1e-9)
    assert run.defect < 1e-11


def double_rocker():
    linkage = FourBar(a=0.4, b=0.35, c=0.45, d=0.9).linkage()
    mechanism = linkage.mechanism
    by_link = {
        link: {k: e for (k, owner), e in linkage.elements.items() if owner == link} for link in mechanism.chain.links
    }
    bodies = {
        "crank": RigidBody(2, (0.2, 0), 0.03),
        "coupler": RigidBody(3, (0.17, 0.05), 0.04),
        "rocker": RigidBody(1.5, (0.22, 0), 0.03),
    }
    return Linkage(mechanism, by_link, unit="m"), Loads(bodies=bodies, gravity=(0, -9.81))


def test_a_double_rocker_swings_through_the_limits_of_every_joint_and_back():
    linkage, loads = double_rocker()
    there = simulate(linkage, loads, branch="+", at=0.6, speed=5.0, until=0.6, times=[0, 0.6], tolerance=1e-11)
    assert len(there.coordinates) > 3
    assert there.defect < 1e-9
    # time reversed: from the end with the other speed back to the start
    pose = {k: tuple(v) for k, v in there.pose(-1).items()}
    back = simulate(
        linkage.with_reference_pose(pose), loads, speed=-there.speeds[-1], until=0.6, times=[0, 0.6], tolerance=1e-11
    )
    assert np.abs(back.turns[-1] - there.turns[0]).max() < 1e-8
    assert back.speeds[-1, 0] == pytest.approx(-5.0, abs=1e-7)


def test_two_freedoms_exchange_their_coordinates_at_stretched_limits():
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")
    places = dict(
        zip(mechanism.chain.joint_names(), [(0, 0), (-0.1, 0.2), (0.15, 0.45), (0.4, 0.2), (0.3, 0)], strict=True)
    )
    linkage = Linkage.from_drawing(mechanism, places, unit="m")
    loads = Loads(bodies={link: RigidBody(1.0, (0.1, 0), 0.01) for link in "1234"}, gravity=(0, -9.81))
    fine, coarse = (
        simulate(linkage, loads, until=0.5, times=[0, 0.5], tolerance=tolerance) for tolerance in (1e-11, 1e-9)
    )
    assert len(fine.coordinates) > 1
    assert fine.defect < 1e-10
    assert np.abs(fine.turns[-1] - coarse.turns[-1]).max() < 1e-6


def test_wheels_turn_freely():
    """Nothing of a pair of gears has second derivatives: J q'' = M with J = J1 + (30/20)² J2, by hand."""
    at = {"R(0-1)": (0, 0), "R(0-2)": (50, 0), "G(1-2)": {"1": Wheel(0, 0, 30.0), "2": Wheel(50, 0, 20.0)}}
    pair = Linkage.from_drawing(Mechanism.parse("R(0-1) R(0-2) G(1-2); frame=0; drive=R(0-1)"), at)
    inertia = 5.0 + 1.5**2 * 3.0
    loads = Loads(moments={"1": 7.0}, bodies={"1": RigidBody(1.0, inertia=5.0), "2": RigidBody(1.0, inertia=3.0)})
    run = simulate(pair, loads, at=0.5, speed=2.0, until=0.1, times=[0.0, 0.05, 0.1])
    found, t = run.drives[:, 0], run.times
    np.testing.assert_allclose(found, 0.5 + 2 * t + 1000 * 7 / inertia * t**2 / 2, rtol=1e-12)  # N mm, kg mm²


def test_no_step_leaps_over_a_slot_of_a_geneva_drive():
    """Seven turns, by the energy and the ratio of four slots in closed form: dt = sqrt(J(q) / J(pi)) dq / w."""
    bodies = {"driver": RigidBody(1.0, inertia=600.0), "cross": RigidBody(1.0, inertia=900.0)}
    part = np.sin(np.pi / 4)

    def slower(q):
        ratio = part * (np.cos(q) - part) / (1 - 2 * part * np.cos(q) + part**2)
        return np.sqrt(1 + 900 / 600 * ratio**2)

    engaged = quad(slower, -np.pi / 4, np.pi / 4, epsabs=1e-12)[0]
    time = 7 * (engaged + 1.5 * np.pi) / 16
    loads = Loads(bodies=bodies, gravity=(0.0, 0.0))
    run = simulate(entry("geneva").linkage(), loads, at=-2.0, speed=16.0, until=time, times=[0.0, time])
    assert run.drives[-1, 0] == pytest.approx(14 * np.pi - 2, abs=1e-6)


def test_double_pendulum():
    # two unit masses on rods of 1 m: the equations in absolute angles, by hand
    mechanism = Mechanism.parse("R(0-1) R(1-2); frame=0; drive=R(0-1); drive=R(1-2)")
    linkage = Linkage.from_drawing(
        mechanism, {"R(0-1)": (0, 0), "R(1-2)": (1, 0)}, points={"E": ("2", 2.0, 0.0)}, unit="m"
    )
    loads = Loads(masses={LinkPoint("1", 1.0, 0.0): 1.0, "E": 1.0}, gravity=(0, -9.81))

    def by_hand(_, y):
        a, b, w, u = y
        mass = np.array([[2, np.cos(a - b)], [np.cos(a - b), 1]])
        right = -np.array(
            [
                np.sin(a - b) * u**2 + 2 * 9.81 * np.cos(a),
                -np.sin(a - b) * w**2 + 9.81 * np.cos(b),
            ]
        )
        return [w, u, *np.linalg.solve(mass, right)]

    a, b, *_ = solve_ivp(by_hand, (0, 1), [0.3, 0.5, 0, 0], method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    swing = simulate(linkage, loads, at=[0.3, 0.2], until=1.0, times=[0, 1.0], tolerance=1e-12)
    assert swing.drives[-1] == pytest.approx([a, b - a], abs=1e-10)


def test_two_freedoms_pass_a_change_point():
    """A pendulum on the coupler of a parallelogram, which only shifts: a double pendulum, by hand."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(2-4); frame=0; drive=R(0-1); drive=R(2-4)")
    places = [(0, 0), (0, 1), (2, 1), (2, 0), (1, 1)]
    points = {"P": ("2", 1.0, 1.0), "E": ("4", 2.0, 1.0)}
    joints = dict(zip(mechanism.chain.joint_names(), places, strict=True))
    linkage = Linkage.from_drawing(mechanism, joints, points=points, unit="m")
    loads = Loads(masses={"P": 1.0, "E": 1.0}, gravity=(0, -9.81))
    fall = simulate(linkage, loads, speed=[-1.0, 0.0], until=0.75, times=[0, 0.75], tolerance=1e-10)

    def by_hand(_, y):
        a, b, w, u = y
        mass = np.array([[2, np.cos(a - b)], [np.cos(a - b), 1]])
        right = [np.sin(a - b) * u**2 + 2 * 9.81 * np.cos(a), 9.81 * np.cos(b) - np.sin(a - b) * w**2]
        return [w, u, *np.linalg.solve(mass, np.negative(right))]

    a, b, *_ = solve_ivp(by_hand, (0, 0.75), [np.pi / 2, 0, -1, 0], method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert a < -0.2  # at 0 both cranks and the coupler lie on one line
    assert fall.drives[-1] - fall.drives[0] == pytest.approx([a - np.pi / 2, b], abs=1e-7)


@pytest.mark.parametrize("crank", [3.72, 3.706])
def test_a_start_next_to_a_limit_of_the_drive(crank):
    """The rocker as drive; its limit is where the coupler covers the crank, at pi + arccos(5325/6300) = 3.7052."""
    loads = Loads(bodies={"coupler": RigidBody(0.5, (35, 0), 200.0)}, gravity=(0, -9.81))
    linkage, given = FourBar(25, 70, 40, 70).linkage(), {"until": 0.5, "times": [0, 0.5]}
    wanted = simulate(linkage, loads, branch="+", at=crank, speed=2.0, **given)
    links = wanted.plan.lower.mechanism.chain.links
    pose = {
        link: (z.real, z.imag, np.angle(turn))
        for link, z, turn in zip(links, wanted.places[0, 0], wanted.turns[0], strict=True)
    }
    by_rocker = driven_by(linkage.with_reference_pose(pose), "R(frame-rocker)")
    swing = simulate(by_rocker, loads, speed=wanted.angular("rocker")[0], **given)
    assert swing.angle("crank") == pytest.approx(wanted.angle("crank"), abs=1e-8)
    assert swing.drives[:, 0] == pytest.approx(wanted.angle("rocker"), abs=1e-8)


@pytest.mark.parametrize("amplitude", [0.1, 1.5, 3.0])
def test_a_pendulum_of_any_amplitude_has_the_period_of_the_elliptic_integral(amplitude):
    """A quarter of 4 sqrt(l/g) K(sin²(a/2)) leads from rest at the amplitude to the lowest place; there v² = 2gh.

    The pendulum is a crank; the coupler and the rocker that it carries along have no mass.
    """
    loads = Loads(masses={LinkPoint("crank", 20.0, 0.0): 2.0}, gravity=(0, -9.81))
    natural, start = np.sqrt(9.81 / 0.02), amplitude - np.pi / 2  # from the x-axis
    quarter = ellipk(np.sin(amplitude / 2) ** 2) / natural
    times, linkage = [quarter, 2 * quarter], FourBar(25, 70, 40, 70)
    swing = simulate(linkage, loads, branch="+", at=start, until=2 * quarter, times=times, tolerance=1e-12)
    assert swing.drives[:, 0] == pytest.approx([-np.pi / 2, -amplitude - np.pi / 2], abs=1e-9)
    assert swing.speeds[0, 0] == pytest.approx(-2 * natural * np.sin(amplitude / 2), rel=1e-9)
    assert swing.defect < 1e-10


def test_small_motions_of_a_double_pendulum():
    """Masses m, m on rods l, l that hang: w² = (2 ± sqrt 2) g/l (Landau, Lifshitz, Mechanics, §23, problem 2)."""
    mechanism = Mechanism.parse("R(0-1) R(1-2); frame=0; drive=R(0-1); drive=R(1-2)")
    linkage = Linkage.from_drawing(
        mechanism, {"R(0-1)": (0, 0), "R(1-2)": (0.4, 0)}, points={"E": ("2", 0.8, 0)}, unit="m"
    )
    loads = Loads(masses={LinkPoint("1", 0.4, 0.0): 3.0, "E": 3.0}, gravity=(0, -9.81))
    found = linearised(linkage, loads, at=[-np.pi / 2, 0.0])
    wanted = np.sqrt((2 + np.array([-1, 1]) * np.sqrt(2)) * 9.81 / 0.4)
    assert np.sort(found.frequencies) * 2 * np.pi == pytest.approx(wanted, rel=1e-11)
    assert simulate(linkage, loads, at=[-1.0, 0.5], until=1.0, times=[0.5, 1.0], tolerance=1e-12).defect < 1e-10


def test_explicit_and_implicit_agree_and_the_work_of_motor_and_damper_is_kept_account_of():
    rocker = {"rocker": RigidBody(0.1, (20, 0), 20.0)}
    loads = Loads(
        bodies={"crank": RigidBody(0.2, (12, 0), 30.0), **rocker},
        springs=(Spring(("frame:100,60", "R(coupler-rocker)"), stiffness=1.0, free_length=40.0, damping=0.01),),
        motors={"R(frame-crank)": Motor(1000.0, 20.0)},
    )
    explicit, implicit = (
        simulate(FourBar(25, 70, 40, 70), loads, at=0.3, branch="+", until=0.04, times=[0, 0.04], **options)
        for options in ({"tolerance": 1e-11}, {"tolerance": 1e-7, "stiff": True})
    )
    assert explicit.drives[-1, 0] == pytest.approx(implicit.drives[-1, 0], abs=1e-6)
    assert abs(explicit.work[-1]) > 1
    assert explicit.defect < 1e-9
    # forward undoes inverse: the equations hold in the row that was found
    influences = influences_of(explicit.motion)
    terms = EquationsOfMotion(explicit.linkage, explicit.links, loads).terms(
        influences, explicit.times, explicit.drives, explicit.speeds, motors=True
    )
    first = terms.mass[0, 0, 0] * explicit.accelerations[0, 0] + terms.bias[0, 0] - terms.force[0, 0]
    assert abs(first) < 1e-9 * abs(terms.force[0, 0])


def test_a_start_in_a_change_point_needs_its_branch():
    linkage, loads = windows(2)
    with pytest.raises(LinkageError, match="branch"):
        simulate(linkage, loads, at=0.0, until=0.1)
    fall = simulate(linkage, loads, at=0.0, branch="--", until=0.3, times=[0, 0.3])
    cranks = [fall.angle(link)[-1] for link in ("k0", "k1", "k2")]
    assert np.ptp(cranks) < 1e-9  # the parallel branch
    ratio = 9.81 * 3.5 / 3.0  # as in `exact_windows`
    exact = solve_ivp(lambda _, y: [y[1], -ratio * np.cos(y[0])], (0, 0.3), [0, 0], rtol=1e-12, atol=1e-13).y[0, -1]
    assert cranks[0] == pytest.approx(exact, abs=1e-8)


def test_motors_that_do_not_start_and_ends_that_are_reached():
    heavy = {"coupler": RigidBody(2.5, (35, 0), 200.0)}
    stuck = simulate(
        FourBar(25, 70, 40, 70),
        Loads(bodies=heavy, motors={"R(frame-crank)": Motor(1.0, 20.0)}),
        at=0.3,
        branch="+",
        until=1.0,
    )
    assert len(stuck) == 1
    assert "does not start" in stuck.message()
    assert "läuft nicht an" in stuck.message("de")
    swing = simulate(
        FourBar(25, 70, 40, 70),
        Loads(bodies=heavy, motors={"R(frame-crank)": Motor(1000.0, 20.0)}),
        at=0.3,
        branch="+",
        until=1.0,
        ends={"R(frame-rocker)": (0.0, 2.0)},
    )
    assert not swing.complete
    assert swing.times[-1] < 0.2
    assert "end of its range" in swing.message()
    assert swing.explain().splitlines()[0].startswith("From R(frame-crank) = 17.19° at 0 s")


@pytest.mark.parametrize("at", [1.0, 1.003, 1.011])
@pytest.mark.parametrize("follower", [cams.flat_follower, cams.roller_follower])
def test_a_cam_swings_over_the_joints_of_its_lift_as_a_scalar_equation(follower, at):
    """By hand: (J + m s'²) q'²/2 + m g s is constant, and the time is the integral of dq/q'."""
    linkage, lift = follower(closed=True), read_lift(cams.LIFT)
    loads = Loads(
        bodies={"cam": RigidBody(0, (0, 0), 100.0), linkage.mechanism.chain.links[2]: RigidBody(0.5)},
        gravity=(0, -9.81),
    )
    turn = simulate(linkage, loads, at=at, speed=20.0, until=0.25, tolerance=1e-10)

    def speed(q):
        energy = (100 + 0.5 * lift.at(at, 1) ** 2) * 200 + 4905 * (lift.at(at) - lift.at(q))
        return np.sqrt(2 * energy / (100 + 0.5 * lift.at(q, 1) ** 2))

    assert turn.complete
    assert turn.speeds[:, 0] == pytest.approx(speed(turn.drives[:, 0]), rel=5e-8)
    joints = [at, *cams.JOINTS[1:], cams.JOINTS[1] + 2 * np.pi, turn.drives[-1, 0]]
    assert joints == sorted(joints)  # all are passed
    nodes, weights = np.polynomial.legendre.leggauss(40)
    ways = [((a + b) / 2 + (b - a) / 2 * nodes, (b - a) / 2 * weights) for a, b in itertools.pairwise(joints)]
    assert sum(float(w @ (1 / speed(q))) for q, w in ways) == pytest.approx(0.25, rel=1e-8)
    assert turn.defect < 1e-7


def test_a_geneva_wheel_takes_its_energy_and_gives_it_back():
    """By hand: (J1 + J2 u²) q'² is constant, u the ratio of the speeds, 1 + sqrt 2 in the middle of a step."""
    bodies = {"driver": RigidBody(0, (0, 0), 50.0), "cross": RigidBody(0, (0, 0), 30.0)}
    run = simulate(cams.geneva(), Loads(bodies=bodies, gravity=(0, 0)), at=-2.0, speed=10.0, until=1.0, tolerance=1e-9)
    ratio = Geneva(4).move(run.drives[:, 0]).ratio
    assert np.abs(ratio).max() == pytest.approx(1 + np.sqrt(2), rel=1e-2)
    assert run.speeds[:, 0] == pytest.approx(10 / np.sqrt(1 + 0.6 * ratio**2), rel=1e-6)


def test_a_follower_that_lifts_off_ends_the_motion():
    """By hand, at constant speed (a heavy cam): m (g + s'' w²) = 0."""
    loads = Loads(bodies={"cam": RigidBody(0, (0, 0), 1e9), "valve": RigidBody(0.5)}, gravity=(0, -9.81))
    run = simulate(cams.flat_follower(), loads, at=0.1, speed=100.0, until=0.05, tolerance=1e-9)
    lift = read_lift(cams.LIFT)
    there = brentq(lambda q: 9.81 + float(lift.at(q, 2)) * 10, 0.5, 1.0)
    assert "G(cam-valve) lift off" in run.message()
    assert f"At {(there - 0.1) / 100:.4g} s" in run.message()
    assert "heben" in run.message("de")


def test_a_cam_whose_lift_jumps_in_its_speed_ends_the_motion():
    linkage = cams.flat_follower("rise 20 90 v0=10 v1=5; dwell 60; fall 20 120; dwell", closed=True)
    loads = Loads(bodies={"cam": RigidBody(0, (0, 0), 100.0), "valve": RigidBody(0.5)}, gravity=(0, 0))
    run = simulate(linkage, loads, at=1.0, speed=20.0, until=0.2)
    assert "jumps in its speed" in run.message()
    assert run.drives[-1, 0] == pytest.approx(np.pi / 2, abs=0.02)


SLIDE = Linkage.from_drawing(  # with a disc that rests on it
    Mechanism.parse("P(0-1) R(1-2); frame=0; drive=P(0-1); drive=R(1-2)"), {"P(0-1)": (0, 0, 0), "R(1-2)": (0, 0)}
)
ONE_KILOGRAM = {"1": RigidBody(1.0), "2": RigidBody(0.0, (0, 0), 1.0)}


@pytest.mark.parametrize("stiff", [False, True])
@pytest.mark.parametrize("force", ["where(vx < 0, 100, 0) - 50", "-50*sign(vx)", "50 - 100*(vx >= 0)"])
def test_a_motion_that_a_jump_of_a_load_holds_ends_with_the_loads_name(force, stiff):
    """By hand: 1 kg, 1 m/s, braked by 50 N, rests after 20 ms and 10 mm, held from either side."""
    loads = Loads({("1", 0, 0): (force, 0)}, bodies=ONE_KILOGRAM, gravity=(0, 0))
    held = simulate(SLIDE, loads, at=(0, 0), speed=(1000, 0), until=0.1, tolerance=1e-8, stiff=stiff)
    assert "At 0.02 s, P(0-1) = 10 mm" in held.message()
    assert "the force at '1:0,0' jumps" in held.message()
    assert "springt" in held.message("de")
    assert held.times[-1] == pytest.approx(0.02, abs=0.1 / 400)
    at_once = simulate(SLIDE, loads, at=(0, 0), speed=(0, 0), until=0.1)
    assert (len(at_once), at_once.times[-1], "jumps" in at_once.message()) == (1, 0.0, True)


@pytest.mark.parametrize("stiff", [False, True])
@pytest.mark.parametrize(
    ("force", "ways"),
    [
        ("where(vx < 0, -20, -50)", (10.0, 10.0 - 20e3 * 0.08**2 / 2)),  # 10 mm forth, then 20 m/s² back
        ("-50*where(vx > 0, 1, 0)", (10.0, 10.0)),  # and rests
        ("where(time < 0.01, -50, where(x > 9.5, 0, 10))", (None, None)),  # 7.5 mm at 500 mm/s, on with 10 m/s²
    ],
)
def test_a_jump_that_is_passed_ends_nothing(force, ways, stiff):
    """By hand: 1 kg at 1 m/s, braked by 50 N."""
    loads = Loads({("1", 0, 0): (force, 0)}, bodies=ONE_KILOGRAM, gravity=(0, 0))
    passed = simulate(
        SLIDE, loads, at=(0, 0), speed=(1000, 0), until=0.1, times=[0.02, 0.1], stiff=stiff, tolerance=1e-8
    )
    if ways[0] is None:
        fast = np.sqrt(500**2 + 2 * 10e3 * 2)  # at x = 9.5
        reached = 0.01 + (fast - 500) / 10e3
        ways = tuple(9.5 + fast * (t - reached) for t in (0.02, 0.1))
    assert passed.complete
    assert passed.steps < 60
    np.testing.assert_allclose(passed.drives[:, 0], ways, rtol=1e-9)


def test_a_start_on_a_jump_goes_to_the_side_that_leaves_it():
    """By hand: 20 m/s² in the sense that is pushed; where both sides leave it, as it is written."""
    forces = {
        "20 + 10*sign(vx)": 30.0,
        "10*sign(vx) - 20": -30.0,
        "where(vx < 0, -5, 5)": 5.0,
        "5 - 10*(vx <= 0)": -5.0,
    }
    for force, size in forces.items():
        loads = Loads({("1", 0, 0): (force, 0)}, bodies=ONE_KILOGRAM, gravity=(0, 0))
        run = simulate(SLIDE, loads, at=(0, 0), until=0.1, times=[0.1])
        assert run.drives[0, 0] == pytest.approx(size * 1e3 * 0.1**2 / 2)


@pytest.mark.slow
@pytest.mark.parametrize("stiff", [False, True])
def test_jumps_of_functions_that_hold_the_motion_end_it_by_their_steps(stiff):
    loads = Loads({("1", 0, 0): (lambda s: -50 * np.sign(s.vx), 0)}, bodies=ONE_KILOGRAM, gravity=(0, 0))
    held = simulate(SLIDE, loads, at=(0, 0), speed=(1000, 0), until=0.1, tolerance=1e-8, stiff=stiff)
    assert "steps get too short" in held.message()
    assert "Schritte" in held.message("de")


def test_a_joint_between_moving_links_reaches_its_end_where_the_free_motion_passes_it():
    weights = Loads(bodies={"coupler": RigidBody(1.0, (35, 0), 400.0)})
    free = simulate(FourBar(25, 70, 40, 70), weights, at=1.0, branch="+", until=0.1)
    bend = free.angle("coupler") - free.angle("crank")
    ends = {"R(crank-coupler)": (bend[0] - 0.3, bend[0] + 0.4)}
    held = simulate(FourBar(25, 70, 40, 70), weights, at=1.0, branch="+", until=0.1, ends=ends)
    inside = bend < bend[0] + 0.4
    assert 1 < len(held) == np.count_nonzero(inside) < len(free)
    assert inside[: len(held)].all()
    assert held.angle("crank") == pytest.approx(free.angle("crank")[: len(held)], abs=1e-7)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"until": -1.0}, "until"),
        ({"until": 1.0, "tolerance": 1e-20}, "tolerance"),
        ({"until": 1.0, "times": [0.5, 0.1]}, "times"),
        ({"until": 1.0, "speed": "fast"}, "speed"),
        ({"until": 1.0, "at": None}, "at="),
        ({"until": 1.0, "loads": Loads()}, "mass"),
        ({"until": 1.0, "ends": {"R(frame-crank)": (2.0, 3.0)}}, "range"),
        ({"until": 1.0, "ends": {"R(frame-crank)": (1.0, 0.0)}}, "two numbers"),
    ],
)
def test_wrong_calls(changed, words):
    given = {"loads": Loads(bodies={"coupler": RigidBody(1.0)}), "at": 0.3} | changed
    with pytest.raises(LinkageError, match=words):
        simulate(FourBar(25, 70, 40, 70), **given)


def test_pendulum_equilibria_and_frequencies():
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    # a parallelogram: its coupler only shifts, so that it is a pendulum with J = 2 (1/3) + 1, G = 9.81 (1 + 1)
    linkage = Linkage.from_drawing(
        mechanism, dict(zip(mechanism.chain.joint_names(), [(0, 0), (0, 1), (2, 1), (2, 0)], strict=True)), unit="m"
    )
    rod = RigidBody(1.0, (0.5, 0), 1 / 12)
    loads = Loads(bodies={"1": rod, "2": RigidBody(1.0, (1.0, 0), 0.5), "3": rod}, gravity=(0, -9.81))
    up, down = sorted(equilibria(linkage, loads), key=lambda found: found.stable)
    assert (up.stable, down.stable) == (False, True)
    assert np.cos([up.drives[0], down.drives[0]]) == pytest.approx([0, 0], abs=1e-12)
    assert down.frequencies == pytest.approx([np.sqrt(9.81 * 2 / (5 / 3)) / (2 * np.pi)], rel=1e-10)
    assert up.eigenvalues.real.max() == pytest.approx(np.sqrt(9.81 * 2 / (5 / 3)), rel=1e-10)


@pytest.mark.parametrize(
    ("damping", "value", "digits"),
    [(0.0, 2.14767663837j, 1e-11), (1.0, -0.2423858093 + 2.1339550282j, 1e-10)],
)
def test_four_bar_with_diagonal_spring_as_printed(damping, value, digits):
    """The benchmark of IFToMM of this name: data, equilibrium and eigenvalues as in EoM (B. Minaker, eom_pkg, 2016).

    Rods of 1 m and 1 kg, 9.81 m/s², 25 N/m on the diagonal. EoM needs no free length; that of a square, sqrt(2) m,
    is the one that has the printed equilibrium, by hand: 2 g cos q = k (2 cos(q/2) - sqrt 2) sin(q/2), which the
    printed angle fulfils to 4e-11.
    """
    mechanism, printed = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)"), 2.23433101898
    places = [0j, turned(2.2), 1 + turned(2.2), 1 + 0j]
    linkage = Linkage.from_drawing(
        mechanism, dict(zip(mechanism.chain.joint_names(), map(xy, places), strict=True)), unit="m"
    )
    rod = RigidBody(1.0, (0.5, 0), 1 / 12)
    middle = linkage.element("R(1-2)", "2").place, linkage.element("R(2-3)", "2").place
    coupler = RigidBody(1.0, xy(sum(complex(*place) for place in middle) / 2), 1 / 12)
    spring = Spring(("R(0-1)", "R(2-3)"), stiffness=25.0, free_length=np.sqrt(2), damping=damping)
    loads = Loads(bodies={"1": rod, "2": coupler, "3": rod}, springs=(spring,), gravity=(0, -9.81))
    found = linearised(linkage, loads, at=printed)
    assert sorted(found.eigenvalues, key=np.imag) == pytest.approx([np.conj(value), value], rel=0, abs=digits)
    nearest = min(equilibria(linkage, loads), key=lambda one: abs(one.drives[0] - printed))
    assert nearest.stable
    assert nearest.drives[0] == pytest.approx(printed, rel=0, abs=4e-11)
    exact = brentq(lambda q: 19.62 * np.cos(q) - 25 * (2 * np.cos(q / 2) - np.sqrt(2)) * np.sin(q / 2), 2.2, 2.3)
    assert nearest.drives[0] == pytest.approx(exact, rel=0, abs=1e-11)


def test_four_bar_with_diagonal_spring_by_two_ways():
    loads = Loads(
        bodies={"crank": RigidBody(1.0, (12, 0), 60.0), "coupler": RigidBody(2.0, (35, 5), 800.0)},
        springs=(Spring(("R(frame-crank)", "R(coupler-rocker)"), stiffness=0.5, free_length=60.0, damping=0.002),),
    )
    found = equilibria(FourBar(25, 70, 40, 70), loads)
    assert len(found) >= 2
    for one in found:
        other = linearised(FourBar(25, 70, 40, 70), loads, branch="+", at=one.drives)
        gaps = np.abs(np.sort_complex(one.eigenvalues) - np.sort_complex(other.eigenvalues))
        assert gaps.max() < 1e-9 * np.abs(one.eigenvalues).max()
        assert np.abs(other.force).max() < 1e-10 * np.abs(other.stiffness).max()


def test_a_balanced_slider_crank_rests_everywhere():
    assert equilibria(SliderCrank(20, 50), Loads(bodies={"slider": RigidBody(1.0)})).everywhere


@pytest.mark.parametrize("times", [None, [0.0, 3.0], [0.7, 0.701, 2.9]])
def test_many_steps_at_once_are_the_single_ones(times):
    """A range that is never left is looked at in each step, so that the kernel does not take several at once."""
    weights = Loads(bodies={"coupler": RigidBody(1.0, (35, 0), 400.0)})
    fall = {"at": 1.0, "speed": 60.0, "branch": "+", "until": 3.0, "times": times}
    at_once = simulate(FourBar(25, 70, 40, 70), weights, **fall)
    singly = simulate(FourBar(25, 70, 40, 70), weights, **fall, ends={"R(frame-crank)": (0.9, 1e6)})
    assert at_once.steps == singly.steps
    for name in ("times", "drives", "speeds", "accelerations", "places", "rates", "kinetic", "potential"):
        values = getattr(singly, name)
        np.testing.assert_allclose(getattr(at_once, name), values, rtol=1e-8, atol=1e-8 * np.abs(values).max())
    assert (at_once.whole == singly.whole).all()
    assert at_once.whole.max() > 1


def test_a_turn_of_minus_one_has_one_angle():
    """Of a turn of exactly -1 the zero may have either sign: simulation and motion count on from the same angle."""
    linkage, loads = windows(2)
    fall = simulate(linkage, loads, until=0.1)
    for zero in (0.0, -0.0):
        turns, whole = fall.turns.copy(), fall.whole.copy()
        turns[-1], whole[-1] = complex(-1.0, zero), 1
        after = replace(fall, turns=turns, whole=whole)
        assert after.angle("k0")[-1] == pytest.approx(3 * np.pi)
        assert (after.motion.angle("k0") == after.angle("k0")).all()
