"""Other sizes of cams and rollers, against the same machines drawn with these sizes, and against the lift."""

from math import pi, sin

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.measuring import measures_of
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import CamDisc, Circle, Linkage
from gruebler.page.round_sizes import with_round_sizes
from gruebler.teaching.catalog import entry

LIFT = "rise 20 90; dwell 60; fall 20 120; dwell"
HIGHER = "rise 30 60; dwell 60; fall 30 120; dwell"
CONTACT = {"cam_roller": ("G(cam-roller)", "cam"), "cam": ("G(cam-valve)", "cam")}


def drawn(base, roller, lift):
    """The roller follower with these sizes, drawn in its low dwell."""
    high = base + roller
    places = {"R(frame-cam)": (0, 0), "P(frame-tappet)": (0, high, pi / 2), "R(tappet-roller)": (0, high)}
    cam = CamDisc(0, 0, 0, lift=lift, base=base, roller=roller)
    contact = {"cam": cam, "roller": Circle(0, base + roller, roller)}
    return Linkage.from_drawing(entry("cam_roller").linkage().mechanism, places | {"G(cam-roller)": contact})


@pytest.mark.parametrize(
    ("link", "sizes", "wanted"),
    [
        ("cam", {"base": 60.0}, (60, 10, LIFT)),
        ("cam", {"base": 21.5}, (21.5, 10, LIFT)),
        ("cam", {"lift": HIGHER}, (40, 10, HIGHER)),
        ("roller", {"circle": 17.0}, (40, 17, LIFT)),
    ],
)
@pytest.mark.parametrize("drive", [0.0, 1.0, 4.0])
def test_the_pose_is_that_of_a_machine_drawn_with_these_sizes(link, sizes, wanted, drive):
    start = entry("cam_roller").linkage()
    start = start.with_reference_pose(move(start, [[drive]]).pose())
    made = with_round_sizes(start, "G(cam-roller)", link, sizes, [drive])
    there = move(drawn(*wanted), [[drive]]).pose()
    assert made.required_pose["tappet"].y == pytest.approx(there["tappet"].y, abs=1e-9)
    assert sin(made.required_pose["cam"].angle) == pytest.approx(sin(drive), abs=1e-12)


@pytest.mark.parametrize(
    ("id", "sizes", "stroke"),
    [
        ("cam_roller", {"base": 60.0}, 20),
        ("cam_roller", {"lift": HIGHER}, 30),
        ("cam", {"lift": "rise 12 75; fall 12 75; dwell"}, 12),
        ("cam", {"base": 25.0}, 8),
    ],
)
def test_the_output_goes_from_nought_to_the_lift(id, sizes, stroke):
    before = entry(id).linkage()
    made = with_round_sizes(before, *CONTACT[id], sizes, [0.0])
    turn = np.linspace(0, 2 * pi, 721)[:, None]
    ways = []
    for linkage in (before, made):
        motion, link = move(linkage, turn), find_output(linkage).link
        place = motion.places[0, :, motion.link_index(link)].imag
        ways.append(place - linkage.element(1, "frame").y)
    assert ways[1].min() == pytest.approx(ways[0].min(), abs=1e-9)  # counted from as far beyond the lowest position
    assert ways[1].max() - ways[1].min() == pytest.approx(stroke, abs=1e-6)
    assert f"{stroke} mm" in measures_of(drive_cycle(made), made, find_output(made)).explain("en")


def test_a_cam_that_cannot_be_is_refused_and_so_is_a_size_that_there_is_not():
    linkage = entry("cam_roller").linkage()
    for link, sizes, said in [
        ("roller", {"circle": 300.0}, None),
        ("cam", {"lift": "rise 20 10; fall 20 10; dwell"}, "crosses itself"),
        ("cam", {"circle": 3.0}, "no such size"),
        ("roller", {"radius": 3.0}, "no such size"),
    ]:
        if said is None:
            assert with_round_sizes(linkage, "G(cam-roller)", link, sizes, [0.0]).element(3, "cam").roller == 300
            continue
        with pytest.raises(LinkageError, match=said):
            with_round_sizes(linkage, "G(cam-roller)", link, sizes, [0.0])


def test_a_swinging_follower_keeps_its_swing_and_touches():
    linkage = entry("cam_rocker").linkage()
    for link, sizes in (("cam", {"base": 50.0}), ("roller", {"circle": 16.0})):
        made = with_round_sizes(linkage, "G(cam-roller)", link, sizes, [0.0])
        cycle = drive_cycle(made)
        assert "20°" in measures_of(cycle, made, find_output(made)).explain("en")
        roller, cam = made.element(3, "roller"), made.element(3, "cam")
        pose = made.required_pose["roller"]
        assert abs(complex(pose.x, pose.y)) == pytest.approx(cam.base + roller.radius, abs=1e-9)
