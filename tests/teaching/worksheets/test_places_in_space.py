"""A machine in space can be built again from the rows that its sheet prints, and what else the sheet says of it."""

import math
import re

import numpy as np
import pytest

from gruebler.mechanics.screws import JointPlace, SpatialLinkage
from gruebler.mechanics.space import Bennett, move
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from gruebler.teaching.worksheets import machine_document
from gruebler.teaching.worksheets.blocks import Heading, Paragraph, Pictures, Rows
from gruebler.teaching.worksheets.places_in_space import lengths_in_space, places_in_space

IN_SPACE = sorted(
    id
    for id, record in entries().items()
    if record.screws and record.chain().space is not Space.PLANAR and (record.drives or record.screws.drive)
)
AXIS = re.compile(r"([xyz]) = \(([^)]*)\)")


def at_right_angles(axes):
    """Six digits leave axes not quite at right angles: the second one is turned back."""
    if len(axes) == 2:
        (_, first), (name, second) = axes.items()
        axes[name] = second - (second @ first) / (first @ first) * first
    return {name: tuple(axis) for name, axis in axes.items()}


def sizes_of(text):
    """Keys of a joint's place, from the words of its cell."""
    found = {}
    for part in filter(None, text.split(", ")):
        word, values = re.fullmatch(r"(lead|radii|pressure angle) (.*)", part).groups()
        turned = [math.radians(float(v[:-1])) if v.endswith("°") else float(v) for v in values.split(" / ")]
        match word:
            case "lead":
                found["pitch"] = turned[0] / math.tau
            case "radii":
                found["radii"] = tuple(turned)
            case _:
                found["pressure"] = turned[0]
    return found


def rebuilt(linkage, rows):
    """The linkage of the printed rows, on the joints, frame and drives of another."""
    chain, places, points = linkage.mechanism.chain, [], {}
    for name, x, y, z, axes, sizes in rows:
        at = float(x), float(y), float(z)
        if len(places) == len(chain.joints):
            point, link = re.fullmatch(r"(.*) \((.*)\)", name).groups()
            points[point] = (link, *at)
            continue
        read = {axis: np.array([float(v) for v in text.split(", ")]) for axis, text in AXIS.findall(axes)}
        places.append(JointPlace(at, **at_right_angles(read), **sizes_of(sizes)))
    return SpatialLinkage(linkage.mechanism, tuple(places), unit=linkage.unit, points=points)


@pytest.mark.parametrize("id", IN_SPACE)
def test_a_sheet_in_space_is_enough_to_build_the_machine_again(id):
    linkage = entries()[id].placed()
    copy = rebuilt(linkage, places_in_space(linkage, "en"))
    steps = np.array([0.05 if drive.turning else 0.02 * linkage.size for drive in linkage.mechanism.drives])
    path = np.array([0 * steps, steps])
    one, other = move(linkage, path), move(copy, path)
    assert len(one) == len(other) == 2
    assert abs(one.poses[0, 1, :, :3, :3] - other.poses[0, 1, :, :3, :3]).max() < 2e-4
    for point in linkage.points:
        assert abs(one.point(point) - other.point(point)).max() < 2e-4 * linkage.size


def test_lengths_of_the_wiper_drive_are_those_worked_out_by_hand():
    rows = list(lengths_in_space(entries()["wiper_rssr"].placed(), "en"))
    # The axes meet at atan(4/6); the rod from (45, 0, 0) to (310, 90, 115); the ball (10, 50, 35) from the rocker's
    # point, of which 10/√52 lies along the axis (0, -4, 6).
    assert [(row[0], row[2], row[3]) for row in rows] == [
        ("body", "300", f"{math.degrees(math.atan2(4, 6)):.6g}°"),
        ("crank", "45", ""),
        ("rod", f"{math.sqrt(265**2 + 90**2 + 115**2):.6g}", ""),
        ("rocker", f"{math.sqrt(10**2 + 50**2 + 35**2 - 100 / 52):.6g}", ""),
    ]


def test_lengths_of_bennett_are_its_own():
    rows = list(lengths_in_space(Bennett(2, 1, 0.5).linkage(), "en"))
    # Sides of length 2 twisted by 1 radian, and by Bennett's condition of length 2 sin(0.5)/sin(1), twisted by 0.5.
    sides = [(f"{2 * math.sin(0.5) / math.sin(1):.6g}", "28.6479°"), ("2", "57.2958°")]
    assert [row[2:] for row in rows] == [*sides, *sides]


def test_slides_have_directions_and_contacts_nothing():
    z = {"z": (0, 0, 1)}
    winch = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut); drive=R(frame-spindle)")
    linkage = SpatialLinkage(winch, {0: z, 1: {**z, "pitch": 1 / math.tau}, 2: {"x": (0, 3, 4), "at": (0, 60, 0)}})
    assert [row[2:] for row in lengths_in_space(linkage, "de")] == [
        ("", "36,8699°"),
        ("0", "0°"),
        ("", "36,8699°"),
    ]
    assert [row[5] for row in places_in_space(linkage, "de")] == ["", "Steigung 1", ""]
    gears = entries()["diff_bevel"].placed()
    assert all("G" not in row[1].split() for row in lengths_in_space(gears, "en"))
    assert [row[5] for row in places_in_space(gears, "en")][-1] == "radii 45° / 45°, pressure angle 0°"


def test_the_sheet_of_a_universal_joint_has_its_motion():
    document = machine_document(entries()["universal_joint"], lang="de")
    heads = [block.text for block in document.blocks if isinstance(block, Heading)]
    assert heads[-3:] == [
        "Abmessungen in mm und Grad",
        "Orte und Achsen in der Bezugslage, in mm und Grad",
        "Hauptdiagramm",
    ]
    said = "\n".join(block.text for block in document.blocks if isinstance(block, Paragraph))
    assert "läuft um" in said
    assert "von 0,866 bei" in said  # cos 30°
    assert "bis 1,155 bei" in said  # 1/cos 30°
    pictures = [block for block in document.blocks if isinstance(block, Pictures)]
    assert [len(block.figures) for block in pictures] == [2, 1]


def test_the_sheet_of_a_differential_has_a_diagram_for_each_drive():
    document = machine_document(entries()["diff_bevel"])
    captions = [block.captions for block in document.blocks if isinstance(block, Pictures)][1:]
    assert captions == [
        ("R(frame-carrier) moves; the other drives stay at 0",),  # in the order of the file
        ("R(frame-sun1) moves; the other drives stay at 0",),
    ]
    assert all(block.rows for block in document.blocks if isinstance(block, Rows))
