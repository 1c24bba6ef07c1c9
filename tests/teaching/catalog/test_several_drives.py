"""Machines with several drives move with each of them, and with all at once; the rigid ones of the catalog stay so."""

import numpy as np
import pytest

from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import check_entry, entries, entry

# machine, unit of the drives in radians or lengths, rows between which the drives move on straight lines
PATHS = {
    "pent": (np.pi / 180, [(120, 60), (150, 60), (150, 30), (90, 90), (120, 60)]),
    "drafting": (np.pi / 180, [(60, -162), (90, -162), (90, -130), (40, -200), (60, -162)]),
    "drafting3": (np.pi / 180, [(60, -162, 74), (90, -162, 160), (90, -130, -10), (40, -200, 74), (60, -162, 74)]),
    "lamp": (np.pi / 180, [(60, 110), (150, 110), (150, 150), (90, 50), (60, 110)]),
    "pantograph": (np.pi / 180, [(58, -116), (30, -116), (30, -90), (80, -140), (58, -116)]),
    "stephenson_gear": (np.pi / 180, [(110, 180), (470, 180), (470, 205), (110, 205), (110, 155)]),
    "walschaerts_gear": (np.pi / 180, [(0, -173.66), (360, -173.66), (360, -200), (0, -200), (0, -173.66)]),
    "diff": (np.pi / 180, [(0, 0), (90, 0), (90, 200), (-300, 500), (0, 0)]),
    "diff2p": (np.pi / 180, [(0, 0), (90, 0), (90, 200), (-300, 500), (0, 0)]),
    "diff_lever": (1.0, [(60, 20), (80, 20), (80, 50), (40, 0), (60, 20)]),
    "loader_full": (1.0, [(60, 75), (80, 75), (80, 85), (45, 85), (45, 75), (60, 62)]),
    "excavator": (1.0, [(278, 200, 214), (330, 200, 214), (330, 160, 214), (300, 270, 190), (240, 180, 250)]),
}


def test_every_machine_with_several_drives_stands_here():
    sized = [one for one in entries().values() if one.dimensions is not None]
    assert {one.id for one in sized if len(one.linkage().mechanism.drives) > 1} == set(PATHS)


@pytest.mark.parametrize("id", PATHS)
def test_it_moves(id):
    linkage = entry(id).linkage()
    scale, corners = PATHS[id]
    times = np.linspace(0, len(corners) - 1, 81)
    path = np.column_stack([np.interp(times, range(len(corners)), drive) for drive in zip(*corners, strict=True)])
    motion = move(linkage, path * scale)
    assert motion.complete, motion.message()
    assert motion.closure_error < 1e-12
    frame = linkage.mechanism.chain.index(linkage.mechanism.frame)
    travel = abs(motion.places[0] - motion.places[0, 0]).max(0) + abs(motion.turns - motion.turns[0]).max(0)
    assert (np.delete(travel, frame) > 0.1).all()  # every link


def test_the_drafting_head_never_turns():
    motion = move(entry("drafting").linkage(), np.radians([(60, -162), (90, -162), (80, -120), (45, -200)]))
    assert np.ptp(motion.angle("head")) < 1e-12
    assert abs(np.diff(motion.point("ruler"), axis=0)).max() > 50


def test_the_lever_adds():
    """The beam is 80 to either side of slide 1: near home slide 3 goes 2 s1 - s2."""
    motion = move(entry("diff_lever").linkage(), [(60.0, 20.0), (60.01, 20.0), (60.0, 20.01)])
    ways = motion.displacement("P(frame-slider3)") - motion.displacement("P(frame-slider3)")[0]
    assert abs(ways) == pytest.approx([0, 0.02, 0.01], abs=1e-5)
    assert ways[1] * ways[2] < 0


@pytest.mark.parametrize("id", ["tri", "quad_double", "quad_strut", "pumpjack_rod"])
def test_what_is_rigid_stays_rigid(id):
    found = check_entry(entry(id)).freedoms
    assert (found.counted, found.generic, found.mobility) == (0, 0, 0)
    assert found.instant.mobility == (id == "pumpjack_rod")  # its rod runs along the path there: it only shakes
