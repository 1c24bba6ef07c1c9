"""Camber, toe and track of suspensions, against points of the tyre that are looked for one by one."""

from math import atan2, degrees, pi, radians

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import move
from gruebler.mechanics.space.wheel_alignment import wheel_alignment
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.commands import run_command


def tyre(pose, centre, axle, radius):
    """Places all around the wheel after a rigid motion of its carrier."""
    n = np.subtract(axle, centre) / np.linalg.norm(np.subtract(axle, centre))
    e = np.cross(n, (0, 0, 1)) / np.linalg.norm(np.cross(n, (0, 0, 1)))
    turns = np.linspace(0, 2 * pi, 40_001)[:, None]
    places = centre + radius * (np.cos(turns) * e + np.sin(turns) * np.cross(n, e))
    return places @ pose[:3, :3].T + pose[:3, 3]


@pytest.mark.parametrize(("id", "rows"), [("susp_spatial", [[-0.17], [0.15]]), ("susp_rack", [[0.1, 40], [-0.1, -55]])])
def test_alignment_is_that_of_the_tyre(id, rows):
    linkage = entry(id).placed()
    centre, axle, ground = (np.array(linkage.points[name][1]) for name in ("C", "A", "T"))
    radius = centre[2] - ground[2]
    motion = move(linkage, [np.zeros(len(rows[0])), *rows])
    assert len(motion) == 3
    table = wheel_alignment(motion, "C", "A", "T")
    at_rest = tyre(np.eye(4), centre, axle, radius)
    for row, pose in enumerate(motion.pose("knuckle")):
        around = tyre(pose, centre, axle, radius)
        top, bottom = around[np.argmax(around[:, 2])], around[np.argmin(around[:, 2])]
        side = np.hypot(*(top - bottom)[:2]) * np.sign((top - bottom)[0])
        assert table["camber"][row] == pytest.approx(degrees(atan2(side, (top - bottom)[2])), abs=0.02)
        level = np.argsort(abs(around[:, 2] - (top + bottom)[2] / 2))[
            :8
        ]  # where the plane of the wheel cuts a level one
        front = around[max(level, key=lambda k: around[k, 1])]
        back = around[min(level, key=lambda k: around[k, 1])]
        assert table["toe"][row] == pytest.approx(degrees(atan2(*(back - front)[:1], (front - back)[1])), abs=0.02)
        stood = at_rest[np.argmin(at_rest[:, 2])]
        assert table["half track"][row] == pytest.approx((bottom - stood)[0], abs=0.1)
        assert table["wheelbase"][row] == pytest.approx((bottom - stood)[1], abs=0.1)
        assert table["travel"][row] == pytest.approx(motion.point("C")[row, 2] - centre[2], abs=1e-9)


def swinging(axis, points):
    """A wheel on an arm that turns about an axis through the origin, driven by a parallel crank."""
    arm = Mechanism.parse("spatial: R(body-arm) R(body-crank) R(crank-rod) R(rod-arm); drive=R(body-arm)")
    aside = 50 * np.array((axis[1], axis[2], axis[0]))
    arms = np.cross(axis, aside)
    joints = {k: {"z": axis, "at": at} for k, at in enumerate(((0, 0, 0), aside, aside + arms, arms))}
    return SpatialLinkage(arm, joints, points={name: ("arm", *at) for name, at in points.items()})


WHEEL = {"C": (500, 0, 0), "A": (600, 0, 0), "T": (500, 0, -300)}


def test_signs_are_those_of_the_standard():
    """A swing axle lifts its wheel into negative camber; a right wheel that turns to the left toes in."""
    lift = wheel_alignment(move(swinging((0, -1, 0), WHEEL), [0, radians(5)]), "C", "A", "T")
    assert lift["travel"][1] == pytest.approx(500 * np.sin(radians(5)))
    assert (lift["camber"][1], lift["toe"][1]) == pytest.approx((-5, 0))
    # The lowest point lies at C + 300 (sin 5°, -cos 5°).
    assert lift["half track"][1] == pytest.approx(500 * np.cos(radians(5)) + 300 * np.sin(radians(5)) - 500)
    steer = wheel_alignment(move(swinging((0, 0, 1), WHEEL), [0, radians(5)]), "C", "A")
    assert (steer["camber"][1], steer["toe"][1]) == pytest.approx((0, 5))
    assert [column.name for column in steer] == ["travel", "camber", "toe"]


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ({"C": (5, 0, 0), "A": (5, 0, 0)}, "one place"),
        ({"C": (5, 0, 0), "A": (5, 0, 3)}, "stands upright"),
    ],
)
def test_what_is_no_wheel(points, words):
    with pytest.raises(LinkageError, match=words):
        wheel_alignment(move(swinging((0, 1, 0), points), [0.0]), "C", "A")


def test_points_of_two_links_are_refused():
    suspension = entry("susp_spatial").placed()
    with pytest.raises(LinkageError, match="points of one link"):
        wheel_alignment(move(suspension, [0.0]), "C", "S(body-tie_rod)")


def test_the_command_adds_the_columns(capsys):
    status, text, _ = run_command(capsys, "analyse", "susp_rack", "--at", "0,60", "--wheel", "C,A,T", "--lang", "de")
    assert status == 0
    assert all(word in text for word in ("Sturz [°]", "Vorspur [°]", "halbe Spurweite [mm]", "Radstand [mm]"))
    for arguments, words in (
        (("susp_spatial", "--wheel", "C"), "two or three points such as C,A,T"),
        (("susp_rack", "--wheel", "C,A"), "needs rows"),
        (("four-bar:25,70,40,70", "--wheel", "C,A"), "goes with a linkage in space"),
    ):
        assert words in run_command(capsys, "analyse", *arguments)[2]
