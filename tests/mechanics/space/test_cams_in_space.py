"""Disc cams in the plane of a link, anywhere and turned: the closed form of the plane, and drives of loops in space.

An eccentric disc of radius 3 turns about the origin, its centre at 1 from it; the follower slides along y at x = 0.5.
"""

from math import inf, pi

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage, exponential, freedoms
from gruebler.mechanics.space import measures, move
from gruebler.structure.mechanism import Mechanism

R1, R2, E, X = 3.0, 1.0, 1.0, 0.5
HEIGHT = np.sqrt((R1 + R2) ** 2 - (X - E) ** 2)  # of the roller's centre where the cam's centre lies on x
NORMAL = np.array([X - E, HEIGHT]) / (R1 + R2)
TURNS = np.linspace(0.0, 2 * pi, 49)
SPEED = 2.0
SOMEWHERE = exponential([0.4, -0.9, 1.3, 30.0, -20.0, 8.0])
PLACES = {"here": np.eye(4), "somewhere": SOMEWHERE}


def loop(text, joints, motion, points=None):
    """A linkage of joints in the plane (point, direction along which it slides or that is normal, radii), put there."""

    def put(point):
        return tuple((motion @ (*point, 0, 1))[:3])

    def turned(direction):
        return tuple(motion[:3, :2] @ np.array(direction, float))

    z, places = tuple(motion[:3, 2]), {}
    for number, (point, direction, radii) in enumerate(joints):
        places[number] = {"at": put(point)}
        if radii is not None:
            places[number] |= {"y": turned(direction), "z": z, "radii": radii}
        elif direction is not None:
            places[number]["x"] = turned(direction)
        else:
            places[number]["z"] = z
    return SpatialLinkage(Mechanism.parse(f"spatial: {text}; drive=R(frame-cam)"), places)


CENTRE = np.array([E, 0.0])
FOLLOWERS = {
    "roller": (
        "R(frame-cam) G(cam-roller) R(roller-tappet) P(frame-tappet)",
        [
            ((0, 0), None, None),
            (CENTRE + R1 * NORMAL, NORMAL, (R1, R2)),
            ((X, HEIGHT), None, None),
            ((X, 8), (0, 1), None),
        ],
    ),
    "round": (
        "R(frame-cam) G(cam-tappet) P(frame-tappet)",
        [((0, 0), None, None), (CENTRE + R1 * NORMAL, NORMAL, (R1, R2)), ((X, 8), (0, 1), None)],
    ),
    "flat": (
        "R(frame-cam) G(cam-tappet) P(frame-tappet)",
        [((0, 0), None, None), ((E, R1), (0, 1), (R1, inf)), ((X, 8), (0, 1), None)],
    ),
    "flat, named first": (
        "R(frame-cam) G(tappet-cam) P(frame-tappet)",
        [((0, 0), None, None), ((E, R1), (0, -1), (inf, R1)), ((X, 8), (0, 1), None)],
    ),
}


def lift(kind, turn):
    """The lift since the turn 0, its first and second derivative by the turn, by hand."""
    s, c = E * np.sin(turn), E * np.cos(turn)
    if kind.startswith("flat"):
        return s, c, -s
    u, du, ddu = X - c, s, c
    w = np.sqrt((R1 + R2) ** 2 - u**2)
    return s + w - HEIGHT, c - u * du / w, -s - (du**2 + u * ddu) / w - (u * du) ** 2 / w**3


@pytest.mark.parametrize("somewhere", PLACES.values(), ids=PLACES)
@pytest.mark.parametrize("kind", FOLLOWERS)
def test_disc_cams_have_the_answer_of_the_plane_anywhere(kind, somewhere):
    linkage = loop(*FOLLOWERS[kind], somewhere)
    motion = move(linkage, TURNS, speed=SPEED, order=2)
    assert motion.complete
    assert motion.closure_error < 1e-12
    for order, wanted in enumerate(lift(kind, TURNS)):
        found = motion.joint("P(frame-tappet)", order=order)
        assert found == pytest.approx(wanted * SPEED**order, abs=1e-12 * 50)
    fine = lift(kind, np.arange(0, 2 * pi, 1e-3))[0]
    assert measures(linkage, output="P(frame-tappet)").travel == pytest.approx(np.ptp(fine), abs=1e-5)


def test_the_same_in_a_linkage_of_the_plane():
    """Chains in the plane with the same places take the same contacts."""
    text, joints = FOLLOWERS["roller"]
    places = {k: {"at": (*point, 0)} for k, (point, _, _) in enumerate(joints)}
    places[1] |= {"y": (*NORMAL, 0), "radii": (R1, R2)}
    places[3] |= {"x": (0, 1, 0)}
    linkage = SpatialLinkage(Mechanism.parse(f"{text}; drive=R(frame-cam)"), places)
    motion = move(linkage, TURNS)
    assert motion.joint("P(frame-tappet)") == pytest.approx(lift("roller", TURNS)[0], abs=1e-12)


def test_a_pin_in_a_slot_turns_the_slotted_link():
    """A crank of length 1, its pin in a slot through the pivot at (3, 0): the angle of the line to the pin."""
    crank, pivot = np.exp(0.7j), 3 + 0j
    along = (crank - pivot) / abs(crank - pivot)
    normal = along * 1j
    joints = [
        ((0, 0), None, None),
        ((crank.real, crank.imag), (normal.real, normal.imag), (0, inf)),
        ((pivot.real, pivot.imag), None, None),
    ]
    linkage = loop("R(frame-cam) G(cam-lever) R(frame-lever)", joints, SOMEWHERE)
    motion = move(linkage, TURNS)
    wanted = np.angle((np.exp(1j * (0.7 + TURNS)) - pivot) / (crank - pivot))
    assert motion.joint("R(frame-lever)") == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize("somewhere", PLACES.values(), ids=PLACES)
def test_a_cam_drives_a_loop_in_space(somewhere):
    """A tappet with a ball, a rod and a rocker about an axis across, as if the lift drove the tappet itself."""
    text, joints = FOLLOWERS["roller"]
    cam = loop(text, joints, somewhere)
    axis = {"at": (4.0, HEIGHT, 5.0), "z": (0.3, 0.2, 1.0)}
    ball, end = (X, HEIGHT + 1, 0.0), (4.0, HEIGHT + 2, 5.0)
    rest = " S(tappet-rod) S(rod-rocker) R(frame-rocker)"

    def there(place):
        moved = {"at": tuple((somewhere @ (*place["at"], 1))[:3])}
        return moved | ({"z": tuple(somewhere[:3, :3] @ place["z"])} if "z" in place else {})

    own = [there(each) for each in ({"at": ball}, {"at": end}, axis)]
    whole = SpatialLinkage(
        Mechanism.parse(f"spatial: {text}{rest}; drive=R(frame-cam)"),
        {**dict(enumerate(cam.places)), **{4 + k: each for k, each in enumerate(own)}},
    )
    driven = SpatialLinkage(
        Mechanism.parse(f"spatial: P(frame-tappet){rest}; drive=P(frame-tappet)"),
        {0: cam.places[3], **{1 + k: each for k, each in enumerate(own)}},
    )
    motion = move(whole, TURNS, speed=SPEED, order=2)
    y, dy, ddy = lift("roller", TURNS)
    alone = move(driven, y, speed=dy * SPEED, acceleration=ddy * SPEED**2, order=2)
    assert motion.complete
    assert alone.complete
    for order in range(3):
        wanted = alone.joint("R(frame-rocker)", order=order)
        assert np.ptp(wanted) > 0.1
        assert motion.joint("R(frame-rocker)", order=order) == pytest.approx(wanted, abs=1e-11)


def test_a_round_roller_spins_for_itself_and_one_beside_its_pin_does_not():
    text, joints = FOLLOWERS["roller"]
    (idle,) = freedoms(loop(text, joints, SOMEWHERE)).idle_parts
    assert (idle.links, idle.freedoms) == (("roller",), 1)
    beside = [*joints[:2], ((X + 0.2, HEIGHT), None, None), joints[3]]
    eccentric = loop(text, beside, SOMEWHERE)
    assert not freedoms(eccentric).idle_parts
    with pytest.raises(LinkageError, match="do not fix the motion"):
        move(eccentric, TURNS)
