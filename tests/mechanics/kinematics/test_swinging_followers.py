"""Swinging followers as joints of linkages: against the lift, and against the contact of the profile as it is cut."""

from dataclasses import asdict
from math import copysign, pi, radians

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.machines.cams import Cam, Flat, Roller, read_lift
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.kinematics import circuit, from_degrees, move
from gruebler.mechanics.linkages import CamDisc, Circle, Linkage, LinkPoint
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

LIFT = "rise 12 90; dwell 60; fall 12 120 cycloidal; dwell"
JOINTS = np.radians([0, 90, 150, 270, 360])
TOLERANCES = (1e-11, 1e-9, 1e-6, 1e-3)


def roller_rocker(pivot=100.0, arm=80.0, roller=10.0, base=40.0, lift=LIFT, scale=1.0, angle=0.0):
    """An arm with a roller about a pivot on the x axis; the cam's own frame is turned by an angle."""
    mechanism = Mechanism.parse("R(0-cam) R(0-rocker) R(rocker-roller) G(cam-roller); frame=0; drive=R(0-cam)")
    start = Roller(roller, arm=arm, distance=pivot).coordinate(base + roller)
    side = copysign(1, pivot)
    turn = np.exp(1j * angle)
    centre = scale * turn * (pivot - side * arm * np.exp(-1j * side * start))
    at = scale * turn * pivot
    touch = {
        "cam": CamDisc(0, 0, angle, lift=lift, base=base, roller=roller, scale=scale, arm=arm, distance=pivot),
        "roller": Circle(centre.real, centre.imag, roller * scale),
    }
    places = {"R(0-cam)": (0, 0), "R(0-rocker)": (at.real, at.imag), "R(rocker-roller)": (centre.real, centre.imag)}
    return Linkage.from_drawing(mechanism, {**places, "G(cam-roller)": touch})


def face_rocker(pivot=110.0, face=5.0, base=60.0, lift=LIFT):
    mechanism = Mechanism.parse("R(0-cam) R(0-rocker) G(cam-rocker); frame=0; drive=R(0-cam)")
    start = Flat(pivot, face).coordinate(base)
    normal = np.exp(1j * (pi / 2 - copysign(1, pivot) * start))
    foot = base * normal
    touch = {
        "cam": CamDisc(0, 0, 0, lift=lift, base=base, flat=True, distance=pivot, face=face),
        "rocker": (foot.real, foot.imag, float(np.angle(normal)) - pi / 2),
    }
    return Linkage.from_drawing(mechanism, {"R(0-cam)": (0, 0), "R(0-rocker)": (pivot, 0), "G(cam-rocker)": touch})


ROLLERS = [roller_rocker(), roller_rocker(-100.0), roller_rocker(scale=2.5, angle=0.7), roller_rocker(roller=0.5)]
FACES = [face_rocker(), face_rocker(-110.0, -3.0), face_rocker(face=0.0)]


def swing(motion, order=0):
    """The rocker's angle from the line of centres, growing away from the cam."""
    linkage = motion.linkage
    centre = linkage.elements[1, "0"]
    cam = next(element for element in linkage.elements.values() if isinstance(element, CamDisc))
    side = copysign(1, cam.distance)
    assert centre.x or centre.y
    return -side * (motion.angular("rocker", order=order) if order else motion.angle("rocker"))


@pytest.mark.parametrize("linkage", [*ROLLERS, *FACES])
def test_the_cam_gives_the_lift_for_which_it_is_made(linkage):
    motion = move(linkage, from_degrees(-300, 720, 1), speed=1, order=3)
    assert motion.complete
    assert motion.closure_error < 1e-11
    angle = motion.drives[:, 0] - motion.drives[300, 0]
    smooth = np.abs(np.mod(angle, 2 * pi)[:, None] - JOINTS).min(axis=1) > 1e-6
    for order, tolerance in enumerate(TOLERANCES):
        found = swing(motion, order)
        found = found - found[300] if order == 0 else found
        wanted = radians(1) * read_lift(LIFT).at(angle, order)
        assert np.abs(found - wanted)[smooth].max() < tolerance


def touching(linkage, motion, row, points):
    """The least distance of the profile, as it is cut, from the follower's surface; negative if it cuts into it."""
    number, cam = next((key, e) for key, e in linkage.elements.items() if isinstance(e, CamDisc))
    turned = motion.turns[row, motion.link_index("cam")] * np.exp(1j * cam.angle)
    centre = motion.complex_point(LinkPoint("cam", cam.x, cam.y))[row]
    profile = centre + cam.scale * turned * points
    other = next(link for link in linkage.mechanism.chain.joints[number[0]].links if link != "cam")
    element = linkage.elements[number[0], other]
    at = motion.complex_point(LinkPoint(other, element.x, element.y))[row]
    if isinstance(element, Circle):
        return np.abs(profile - at).min() - element.radius
    normal = 1j * motion.turns[row, motion.link_index(other)] * np.exp(1j * element.angle)
    return -(np.conj(normal) * (profile - at)).real.max()


@pytest.mark.parametrize("linkage", [ROLLERS[0], ROLLERS[1], ROLLERS[2], FACES[0], FACES[1]])
def test_the_cut_profile_touches_and_never_cuts(linkage):
    cam = next(e for e in linkage.elements.values() if isinstance(e, CamDisc))
    follower = Flat(cam.distance, cam.face) if cam.flat else Roller(cam.roller, arm=cam.arm, distance=cam.distance)
    cut = Cam(read_lift(cam.lift).scaled(radians(1)), cam.base, follower).profile(np.linspace(0, 2 * pi, 40_001))
    points = cut[:, 0] + 1j * cut[:, 1]
    motion = move(linkage, from_degrees(0, 360, 15))
    for row in range(len(motion)):
        assert abs(touching(linkage, motion, row, points)) < 2e-6 * linkage.size


@pytest.mark.parametrize("linkage", [ROLLERS[0], ROLLERS[2], FACES[0]])
def test_the_circuit_finds_the_same_and_files_keep_it(linkage):
    made = circuit(linkage)
    assert made.closed
    motion = move(linkage, made.drive)
    assert motion.complete
    np.testing.assert_allclose(np.exp(1j * motion.angle("rocker")), np.exp(1j * made.angle("rocker")), atol=1e-9)
    assert linkage_from_json(linkage_to_json(linkage)) == linkage
    np.testing.assert_allclose(move(linkage.scaled(2.5), made.drive).turns, motion.turns, atol=1e-9)


def test_measures_of_the_catalog_machines():
    for id in ("cam_rocker", "cam_rocker_flat"):
        linkage = entry(id).linkage()
        found = measures(linkage)
        assert found.travel == pytest.approx(radians(20 if id == "cam_rocker" else 12), abs=1e-9)
        assert "<svg" in draw_linkage(linkage).svg()
        angle = linkage.required_pose["rocker"].angle  # told from the pivot to where it touches
        assert radians(90) < angle < radians(180)


@pytest.mark.parametrize(
    ("disc", "words"),
    [
        ({"arm": 80.0}, "a swinging follower has an arm and a distance of its pivot"),
        ({"arm": 80.0, "distance": 100.0, "offset": 3.0}, "and no offset"),
        ({"arm": 20.0, "distance": 100.0}, "form no triangle"),
        ({"face": 3.0}, "only a flat face has a distance from its pivot"),
        (
            {"flat": True, "roller": 0.0, "arm": 3.0, "distance": 100.0},
            "a flat face has no roller, no offset and no arm",
        ),
    ],
)
def test_what_does_not_fit_is_said(disc, words):
    linkage = roller_rocker() if not disc.get("flat") else face_rocker()
    elements = linkage._by_link()
    number = len(linkage.mechanism.chain.joints) - 1
    fields = asdict(elements["cam"][number]) | {"arm": 0.0, "distance": 0.0, "face": 0.0} | disc
    elements["cam"][number] = CamDisc(**fields)
    with pytest.raises(LinkageError, match=words):
        move(Linkage(linkage.mechanism, elements, reference_pose=linkage.reference_pose), [0.0])
