"""What the machines in space state, by other methods: circles, spheres, lengths of cylinders, loops of rotations."""

import numpy as np
import pytest
from scipy.optimize import fsolve, least_squares
from scipy.spatial.transform import Rotation

from gruebler.mechanics.screws import freedoms
from gruebler.mechanics.space import move
from gruebler.teaching.catalog import entry
from gruebler.teaching.catalog.motion_quantities import derived_numbers


def stated(id, number=0):
    return derived_numbers(entry(id), entry(id).quantities[number])


def places(id):
    linkage = entry(id).placed()
    return dict(zip(linkage.mechanism.chain.joint_names(), linkage.places, strict=True))


def axis(place):
    return np.array(place.z) / np.linalg.norm(place.z)


def output_angles(id, first, second, balls, angles):
    """Of a crank and a rocker joined by a rod: a cos + b sin = c for each angle of the crank, without jumps."""
    where = places(id)
    p, q, a, b = (np.array(where[name].at) for name in (first, second, *balls))
    turned = Rotation.from_rotvec(angles[:, None] * axis(where[first])).apply(a - p) + p
    z = axis(where[second])
    along = q + z * (z @ (b - q))
    e = b - along
    g = np.cross(z, e)
    c = (((turned - along) ** 2).sum(axis=1) + e @ e - (a - b) @ (a - b)) / 2
    x, y = (turned - along) @ e, (turned - along) @ g
    both = np.arctan2(y, x) + np.array([[1], [-1]]) * np.arccos(c / np.hypot(x, y))
    side = np.argmin(abs((both[:, 0] + np.pi) % (2 * np.pi) - np.pi))
    return np.degrees(np.unwrap(both[side]))


def test_a_wiper_and_a_bicycle_by_the_rod_of_constant_length():
    turn = np.linspace(0, 2 * np.pi, 4001)
    wiper = output_angles("wiper_rssr", "R(body-crank)", "R(body-rocker)", ("S(crank-rod)", "S(rod-rocker)"), turn)
    assert stated("wiper_rssr")["degrees"] == pytest.approx(np.ptp(wiper), rel=1e-5)
    steered = np.radians([0, 40, 0, -40])
    joints = "R(frame-handlebar)", "R(frame-fork)", ("S(handlebar-rod)", "S(rod-fork)")
    fork = output_angles("cargo_bike", *joints, steered)
    assert stated("cargo_bike")["degrees"] == pytest.approx(np.ptp(fork), rel=1e-9)
    assert fork[1] + fork[3] - 2 * fork[0] > 2  # left and right are not alike


def test_the_strap_of_a_door_by_its_ends():
    where, angle = places("car_door"), np.radians(np.linspace(0, 70, 701))
    (px, py, _), (qx, qy, _) = where["R(pillar-strap)"].at, where["R(door-pocket)"].at
    strap = (qx + 1j * qy) * np.exp(1j * angle) - (px + 1j * py)
    assert stated("car_door")["length"] == pytest.approx(np.ptp(abs(strap)), rel=1e-9)
    assert stated("car_door", 1)["degrees"] == pytest.approx(np.degrees(np.ptp(np.angle(strap))), rel=1e-9)


def test_the_platform_of_sarrus_by_its_arms():
    """Arms of 60, in the reference pose at the angle of a triangle 3, 4, 5."""
    low, high = np.degrees(np.arctan2(4, 3)) + np.array([-40, 30])
    stroke = 120 * (np.sin(np.radians(high)) - np.sin(np.radians(low)))
    assert stated("sarrus", 1) == pytest.approx({"length": stroke, "band": 0}, rel=1e-9, abs=1e-9)


def denavit_hartenberg(theta, a, alpha):
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, 0], [0, 0, 0, 1]])


def test_the_second_shaft_of_schatz_turns_as_behind_a_universal_joint_of_60_degrees():
    """Closed by least squares in Denavit-Hartenberg angles, and against Cardan's tan = cos 60 degrees tan."""
    a, alpha = [0, 1, 1, 1, 0, np.sqrt(3)], [np.pi / 2] * 5 + [0]

    def gap(rest, first):
        loop = np.eye(4)
        for row in zip([first, *rest], a, alpha, strict=True):
            loop = loop @ denavit_hartenberg(*row)
        return (loop - np.eye(4))[:3].ravel()

    rest, firsts, lasts = np.radians([115.66, -112.62, -51.32, -33.69, 163.9]), np.radians(range(60, 421, 5)), []
    for first in firsts:
        found = least_squares(gap, rest, args=(first,), xtol=1e-15, ftol=1e-15, gtol=1e-15)
        assert abs(found.fun).max() < 1e-9
        rest = found.x
        lasts.append(rest[-1])
    motion = move(entry("schatz").placed(), firsts - firsts[0], order=1)
    second = -motion.joint("R(frame-shaft2)")  # the loop turns the frame against the shaft
    assert np.unwrap(lasts) - lasts[0] == pytest.approx(second, abs=1e-6)
    rates = np.gradient(np.unwrap(lasts), firsts, edge_order=2)
    assert stated("schatz")["greatest"] == pytest.approx(-abs(rates).min(), rel=5e-3)
    assert stated("schatz")["least"] == pytest.approx(-abs(rates).max(), rel=2e-2)
    driven, turned = firsts - np.radians(90), second - second[firsts == np.radians(90)]
    assert 2 * np.sin(turned) * np.cos(driven) == pytest.approx(np.cos(turned) * np.sin(driven), abs=1e-9)


def test_a_gough_platform_by_the_lengths_of_its_cylinders():
    where = places("gough")
    base = np.array([where[f"U(base-cylinder{k})"].at for k in range(1, 7)])
    top = np.array([where[f"S(piston{k}-platform)"].at for k in range(1, 7)])
    centre, lengths = np.array([0, 0, 220]), np.linalg.norm(top - base, axis=1)

    def off(x, wanted):
        moved = Rotation.from_rotvec(x[:3]).apply(top - centre) + centre + 100 * x[3:]
        return np.linalg.norm(moved - base, axis=1) - wanted

    place = np.zeros(6)
    for longer in np.linspace(0, 60, 13):
        place = fsolve(off, place, args=(lengths + longer * np.eye(6)[0],), xtol=1e-13)
    assert stated("gough", 1)["degrees"] == pytest.approx(np.degrees(np.linalg.norm(place[:3])), rel=1e-8)
    aside = np.linalg.norm((top - base)[0, :2])  # all alike: by symmetry the platform goes straight up
    assert stated("gough")["length"] == pytest.approx(np.sqrt((lengths[0] + 60) ** 2 - aside**2) - 220, rel=1e-4)


def test_a_delta_robot_by_three_spheres():
    """A parallelogram holds a point of the platform at the length of its rods from the end of an arm."""
    linkage = entry("delta").placed()
    angles = np.radians([35.0, -20.0, 10.0])
    motion = move(linkage, np.linspace(0, 1, 5)[:, None] * angles)
    turns = 2 * np.pi / 3 * np.arange(3)
    radius, heights = 120 + 100 * np.cos(angles) - 40, -100 * np.sin(angles)
    centres = np.stack([radius * np.cos(turns), radius * np.sin(turns), heights], axis=1)
    at = fsolve(lambda x: ((x - centres) ** 2).sum(axis=1) - 220**2, [0, 0, -150], xtol=1e-12)
    assert motion.point("T")[-1] == pytest.approx(at, abs=1e-8)
    assert motion.pose("platform")[-1, :3, :3] == pytest.approx(np.eye(3), abs=1e-12)
    alike = np.radians(np.linspace(-20, 40, 61))
    height = -100 * np.sin(alike) - np.sqrt(220**2 - (80 + 100 * np.cos(alike)) ** 2)
    assert stated("delta", 1)["length"] == pytest.approx(np.ptp(height), rel=1e-9)


def test_pistons_of_a_wobble_plate_by_its_normal():
    """The plate has the journal as its normal; the ball that guides it stays in the plane x = 0, so its y axis does."""
    turn, tilt = np.linspace(0, 2 * np.pi, 2001), np.radians(20)
    normal = np.stack([-np.sin(turn) * np.sin(tilt), np.cos(turn) * np.sin(tilt), np.cos(tilt) + 0 * turn], axis=1)
    y = np.cross(normal, [1, 0, 0])
    y /= np.linalg.norm(y, axis=1)[:, None]
    x = np.cross(y, normal)
    for number, angle in enumerate((90, 210)):
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        ball = 40 * (c * x + s * y)
        piston = ball[:, 2] + np.sqrt(60**2 - ((ball[:, :2] - 40 * np.array([c, s])) ** 2).sum(axis=1))
        assert stated("wobble_plate", number)["length"] == pytest.approx(np.ptp(piston), rel=1e-6)


@pytest.mark.parametrize("id", ["susp_spatial", "susp_rack", "susp_5link_lift"])
def test_rods_and_wishbones_of_suspensions_keep_their_lengths(id):
    """The place of the wheel alone, against every length and plane that the links hold."""
    linkage = entry(id).placed()
    drives = linkage.mechanism.drives
    goal = np.array([0.15 if drive.turning else 40.0 for drive in drives])
    motion = move(linkage, np.linspace(0, 1, 9)[:, None] * goal)
    chain = linkage.mechanism.chain
    wheel = motion.pose("knuckle")
    for joint, place in zip(chain.joints, linkage.places, strict=True):
        if "knuckle" in joint.links and joint.pair.is_ball:
            (other,) = (link for link in joint.links if link != "knuckle")
            held = next(k for k, j in enumerate(chain.joints) if other in j.links and "knuckle" not in j.links)
            inner = np.array(linkage.places[held].at)
            if chain.joints[held].links[0] == "rack":
                inner = inner + motion.drives[:, [1]] * np.array([1.0, 0, 0])
            outer = wheel[:, :3, :3] @ np.array(place.at) + wheel[:, :3, 3]
            lengths = np.linalg.norm(outer - inner, axis=1)
            assert lengths == pytest.approx(lengths[0], abs=1e-9)
    assert abs(motion.point("C")[-1, 2] - 320) > 30


@pytest.mark.parametrize(("id", "mobility"), [("sarrus", 1), ("schatz", 1), ("car_door", 1)])
def test_overconstrained_machines_move_as_their_dimensions_allow(id, mobility):
    assert freedoms(entry(id).placed()).mobility == mobility
