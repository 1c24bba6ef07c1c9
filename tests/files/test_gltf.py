"""Bodies of links: closed, of the right size and where the links are; glTF by a reader of its own, STL by its bytes."""

import json
from collections import Counter
from math import pi

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.files import values as files
from gruebler.files.gltf import moving_solids, stl_of_links
from gruebler.files.link_solids import link_solids
from gruebler.files.solids import ball_solid, box_solid, cylinder_solid
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import RSSR, move
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry

IN_SPACE = [id for id, one in entries().items() if one.screws is not None and one.chain().space is not Space.PLANAR]


def open_edges(triangles):
    """Edges that are not passed once in each direction: none on a closed body whose faces all look outward."""
    edges = Counter((int(t[k]), int(t[(k + 1) % 3])) for t in triangles for k in range(3))
    return [edge for edge, count in edges.items() if count != 1 or edges[edge[::-1]] != 1]


@pytest.mark.parametrize("id", IN_SPACE)
def test_every_body_of_a_machine_is_closed(id):
    solids = link_solids(entry(id).placed())
    assert set(solids) == set(entry(id).links)
    for link, bodies in solids.items():
        assert bodies, link
        for body in bodies:
            assert open_edges(body.triangles) == []
            assert body.volume > 0


@pytest.mark.parametrize(("sun", "planet"), [("sun1", "planet1"), ("sun2", "planet1"), ("sun2", "planet2")])
def test_teeth_of_bevel_gears_meet_gaps(sun, planet):
    """Where two cones of 45 degrees touch, the top of a tooth of one is near; of the other it is half a pitch away."""
    solids = link_solids(entry("diff_bevel2p").placed())
    gears = [max(solids[link], key=lambda body: body.volume).vertices for link in (sun, planet)]
    axes = [gear.mean(axis=0) / np.linalg.norm(gear.mean(axis=0)) for gear in gears]
    across = np.cross(*axes)
    aside = []
    for gear, axis in zip(gears, axes, strict=True):
        tops = gear[(np.linalg.norm(gear, axis=1) > 0.99) & (gear @ axis < np.cos(pi / 4) - 0.01)]
        aside.append(min(abs(tops @ across)))
    pitch = 2 * pi * np.sin(pi / 4) / 24
    assert sorted(aside) == pytest.approx([0.14 * pitch, 0.36 * pitch], rel=0.1)


@pytest.mark.parametrize("id", ["diff_bevel", "diff_bevel2p"])
def test_a_differential_stands_on_ground_beside_its_wheels(id):
    """The frame has plates across the axle, farther out than all that turns."""
    solids = link_solids(entry(id).placed())
    plates = [body for body in solids["frame"] if len(body.vertices) == 8]
    assert plates
    turning = np.concatenate([body.vertices for link, each in solids.items() if link != "frame" for body in each])
    for plate in plates:
        out = plate.vertices.mean(axis=0)
        out = out / np.linalg.norm(out)
        assert min(plate.vertices @ out) > max(turning @ out)


def test_the_frame_of_bennetts_linkage_is_one_body():
    """Its feet stand on no common ground: a bar as long as the frame, 120 mm (its catalog), joins its bearings."""
    linkage = entry("bennett").placed()
    first, second = (
        frame[:3, 3]
        for frame, joint in zip(linkage.frames, linkage.mechanism.chain.joints, strict=True)
        if "frame" in joint.links
    )
    assert np.linalg.norm(second - first) == pytest.approx(120)
    along = (second - first) / 120
    bars = [
        body
        for body in link_solids(linkage)["frame"]
        if max((body.vertices - first) @ along) - min((body.vertices - first) @ along) == pytest.approx(120)
    ]
    assert len(bars) == 1
    assert np.linalg.norm(np.cross(bars[0].vertices - first, along), axis=1).max() < 0.1 * 120


def test_volumes_by_their_formulas():
    """A prism of 16 sides, a box, and a ball that is a little smaller than the round one."""
    share = 8 * np.sin(pi / 8) / pi  # of the regular polygon in its circle
    start, end = np.array([1.0, 2, 3]), np.array([4.0, 6, 3])
    assert cylinder_solid(start, end, 2.0).volume == pytest.approx(share * pi * 4 * 5)
    assert cylinder_solid(start, end, 2.0, 1.0, 0.3).volume == pytest.approx(share * pi * 5 / 3 * (4 + 2 + 1))
    assert box_solid(end, np.eye(3)[:, [2, 0, 1]], (1.0, 2.0, 3.0)).volume == pytest.approx(48)
    assert 0.9 < ball_solid(start, 3.0).volume / (4 / 3 * pi * 27) < 1


def test_the_wall_on_which_a_ball_slides_is_as_long_as_its_way():
    """Of the wobble plate: 55 from the middle of a plate inclined by 20 degrees it goes from 18.81 up to 18.81 down."""
    moving = moving_solids(entry("wobble_plate").placed())
    wall = next(body for body in moving.solids["housing"] if np.ptp(body.vertices[:, 2]) > 35)
    low, high = wall.vertices[:, 2].min(), wall.vertices[:, 2].max()
    beyond = 3 * moving.linkage.size / 45
    assert [low, high] == pytest.approx([-18.811 - beyond, 18.811 + beyond], abs=0.05)


def glb(path):
    """Document and binary chunk, by the layout that the specification prints."""
    data = path.read_bytes()
    magic, version, length = data[:4], *np.frombuffer(data[4:12], "<u4")
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = int(np.frombuffer(data[12:16], "<u4")[0]), data[16:20]
    assert kind == b"JSON"
    rest = data[20 + size :]
    assert rest[4:8] == b"BIN\0"
    return json.loads(data[20 : 20 + size]), rest[8:]


def rows_of(document, binary, number):
    accessor = document["accessors"][number]
    view = document["bufferViews"][accessor["bufferView"]]
    count = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    values = np.frombuffer(binary, "<f4", accessor["count"] * count, view["byteOffset"])
    rows = values.reshape(-1, count).astype(float)
    if "min" in accessor:
        assert rows.min(axis=0) == pytest.approx(accessor["min"])
        assert rows.max(axis=0) == pytest.approx(accessor["max"])
    return rows


def test_keys_of_the_animation_are_the_poses_of_the_links(tmp_path):
    linkage = entry("wiper_rssr").placed()
    document, binary = glb(files.write(linkage, tmp_path / "a.glb"))
    (animation,) = document["animations"]
    motion = move(linkage, np.linspace(0, 2 * pi, 73))
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        link = document["nodes"][channel["target"]["node"]]["name"]
        values = rows_of(document, binary, sampler["output"])
        assert len(rows_of(document, binary, sampler["input"])) == len(values) == 73
        pose = motion.pose(link)
        if channel["target"]["path"] == "translation":
            assert values == pytest.approx(pose[:, :3, 3] / 1000, abs=1e-6)  # mm in metres
        else:
            x, y, z, w = values.T
            assert 1 - 2 * (y**2 + z**2) == pytest.approx(pose[:, 0, 0], abs=1e-6)
            assert 2 * (x * z + y * w) == pytest.approx(pose[:, 0, 2], abs=1e-6)


@pytest.mark.parametrize("by_command", [True, False])
def test_a_machine_moves_over_its_range(by_command, tmp_path):
    path = tmp_path / "suspension.glb"
    if by_command:
        assert main(["convert", "susp_spatial", str(path)]) == 0
    else:
        files.write(entry("susp_spatial").placed(), path, between=(-pi / 18, pi / 18))
    document, binary = glb(path)
    (animation,) = document["animations"]
    node = next(k for k, each in enumerate(document["nodes"]) if each["name"] == "lower_wishbone")
    channel = next(
        each
        for each in animation["channels"]
        if each["target"]["node"] == node and each["target"]["path"] == "rotation"
    )
    accessor = document["accessors"][animation["samplers"][channel["sampler"]]["output"]]
    view = document["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    turns = np.frombuffer(binary, "<f4", 4 * accessor["count"], start).reshape(-1, 4)
    assert 2 * np.degrees(np.arccos(abs(turns[:, 3]))).max() == pytest.approx(10, abs=0.01)  # -10 to 10 degrees


def test_a_machine_with_several_drives_has_an_animation_for_each(tmp_path):
    document, _ = glb(files.write(entry("delta").placed(), tmp_path / "a.glb"))
    assert [each["name"] for each in document["animations"]] == list(entry("delta").drives)
    nodes = [each["name"] for each in document["nodes"]]
    assert nodes == ["linkage", *entry("delta").links]


def test_a_drive_that_cannot_go_far_is_shown_as_far_as_it_goes():
    """The crank goes over its whole arc, which the closed form has; the fan, which nothing else moves, turns round."""
    form = RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9)
    (arc,) = form.limits
    linkage = form.linkage(arc.start + 0.2)
    text = f"{linkage.mechanism.chain} R(frame-fan); frame=frame"
    places = dict(enumerate(linkage.places)) | {4: {"at": (0, 200, 0), "z": (0, 0, 1)}}
    both = SpatialLinkage(Mechanism.parse(text), places).with_drives(["R(frame-crank)", "R(frame-fan)"])
    first, second = moving_solids(both).motions
    assert first.drives[:, 0].min() == pytest.approx(-0.2, abs=2e-3 * (arc.end - arc.start))
    assert first.drives[:, 0].max() == pytest.approx(arc.end - arc.start - 0.2, abs=2e-3 * (arc.end - arc.start))
    assert np.ptp(second.drives[:, 1]) == pytest.approx(2 * pi, abs=1e-12)
    assert moving_solids(both).round == (False, True)


def test_a_range_is_of_all_drives_of_one_kind():
    """The wishbone of a suspension turns, its rack slides: the angles are the wishbone's."""
    wishbone, rack = moving_solids(entry("susp_rack").placed(), between=(-0.1, 0.2)).motions
    assert wishbone.drives[[0, -1], 0].tolist() == pytest.approx([-0.1, 0.2])
    assert np.ptp(rack.drives[:, 1]) > 10
    for motion in moving_solids(entry("delta").placed(), between=(-0.1, 0.2)).motions:
        assert np.ptp(motion.drives, axis=0).max() == pytest.approx(0.3)


def test_a_thread_winds_by_its_lead():
    """Of the right-handed spindle, with 12 mm a turn: how far it is from its axis x is a wave over x/12 - turns."""
    solids = moving_solids(entry("winch_screw").placed()).solids["spindle"]
    (rod,) = (solid.vertices[1:-1] for solid in solids if len(solid.vertices) > 99)
    x, y, z = rod.T
    phase = 2 * np.pi * x / 12 - np.arctan2(z, y)
    waves = np.stack([np.ones(len(x)), np.cos(phase), np.sin(phase)], axis=1)
    found, *_ = np.linalg.lstsq(waves, np.hypot(y, z))
    assert waves @ found == pytest.approx(np.hypot(y, z), abs=1e-9)
    assert np.hypot(*found[1:]) > 0.2 * found[0]


@pytest.mark.parametrize(("id", "joint"), [("winch_screw", "P(frame-nut)"), ("gough", "P(cylinder1-piston1)")])
def test_a_sleeve_stays_on_its_rod(id, joint):
    """The rod is as long as its sleeve goes, and on that side: the nut of a winch goes one way only, by its lead."""
    linkage = entry(id).placed()
    moving = moving_solids(linkage)
    number = linkage.mechanism.chain.joint_number(joint)
    shaft, sleeve = ("nut", "frame") if id == "winch_screw" else ("cylinder1", "piston1")
    axis, at = linkage.frames[number, :3, 0], linkage.frames[number, :3, 3]
    ends = np.concatenate([solid.vertices - at for solid in moving.solids[shaft]])
    near = np.linalg.norm(ends - np.outer(ends @ axis, axis), axis=1) < linkage.size / 45  # about the axis
    low, high = (ends[near] @ axis).min(), (ends[near] @ axis).max()
    for motion in moving.motions:
        back = np.linalg.inv(motion.pose(shaft)) @ motion.pose(sleeve)
        along = (back @ np.append(at, 1.0))[:, :3] @ axis - at @ axis
        assert low <= along.min()
        assert along.max() <= high


def test_a_piston_rod_is_thin_and_stays_in_its_barrel():
    """Over the stroke of a Gough platform, -40 to 60 mm, it begins within the barrel and its ball stays outside."""
    record = entry("gough")
    linkage = record.placed()
    solids = moving_solids(linkage, between=record.between).solids
    axis, at = linkage.frames[1, :3, 0], linkage.frames[1, :3, 3]
    along, radii = {}, {}
    for link in ("cylinder1", "piston1"):
        body = max(solids[link], key=lambda each: np.ptp(each.vertices @ axis)).vertices - at
        along[link] = body @ axis
        radii[link] = np.linalg.norm(body - np.outer(along[link], axis), axis=1).max()
    barrel, rod = along["cylinder1"], along["piston1"]
    assert radii["piston1"] < radii["cylinder1"] / 2
    assert barrel.min() < rod.min() - 40
    assert rod.min() + 60 < barrel.max() < rod.max() - 40


def test_a_range_is_of_a_format_with_motion(tmp_path):
    with pytest.raises(GrueblerError, match="only glTF has a motion between values of the drive"):
        files.write(FourBar(25, 70, 40, 70), tmp_path / "a.toml", between=(0, 1))


def test_a_machine_without_drives_says_that_it_stands_still(tmp_path):
    left_out = []
    document, _ = glb(files.write(entry("susp_5link").placed(), tmp_path / "a.glb", left_out=left_out))
    assert "animations" not in document
    assert [str(each) for each in left_out] == ["a motion: the drives do not move the linkage"]


def test_a_linkage_without_a_unit_leaves_none_out(tmp_path):
    placed, left_out = entry("sarrus").placed(), []
    files.write(SpatialLinkage(placed.mechanism, placed.places, unit=""), tmp_path / "a.glb", left_out=left_out)
    files.write(SpatialLinkage(placed.mechanism, placed.places, unit="pt"), tmp_path / "b.glb", left_out=left_out)
    assert [str(each) for each in left_out] == ["the unit pt"]


def test_stl_has_a_file_for_each_link(tmp_path, capsys):
    assert main(["convert", "sarrus", str(tmp_path / "bodies"), "--to", "stl"]) == 0
    assert "motion, colours and the unit" in capsys.readouterr().err
    assert {path.stem for path in (tmp_path / "bodies").iterdir()} == set(entry("sarrus").links)
    for path in (tmp_path / "bodies").iterdir():
        data = path.read_bytes()
        (count,) = np.frombuffer(data[80:84], "<u4")
        assert len(data) == 84 + 50 * count
        rows = np.frombuffer(data[84:], np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]))
        corners = rows["c"].astype(float)
        assert (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() > 0
        places, numbers = np.unique(corners.reshape(-1, 3).round(3), axis=0, return_inverse=True)
        assert open_edges(numbers.reshape(-1, 3)) == []  # joined as a reader joins corners, over all bodies of the link
        assert len(places) > 20


@pytest.mark.parametrize("id", IN_SPACE)
def test_bodies_of_one_link_share_no_edge(id):
    for content in stl_of_links(entry(id).placed(), []).values():
        rows = np.frombuffer(content[84:], np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]))
        _, numbers = np.unique(rows["c"].reshape(-1, 3), axis=0, return_inverse=True)
        assert open_edges(numbers.reshape(-1, 3)) == []


def test_bodies_are_of_linkages_in_space(tmp_path):
    with pytest.raises(GrueblerError, match="bodies are written of linkages in space only"):
        files.write(FourBar(25, 70, 40, 70), tmp_path / "a.glb")


@pytest.mark.parametrize(("name", "hint"), [("x.stl", "--to stl"), ("x.gltf", ".glb")])
def test_an_ending_that_is_no_format_by_itself_is_told_how_to_be_had(name: str, hint: str):
    with pytest.raises(GrueblerError, match=hint):
        files.format_of(name)
