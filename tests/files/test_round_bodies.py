"""Round bodies of linkages in space: kept by files and by changes, seen in pictures and models, refused if wrong."""

from math import pi

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import LinkageError
from gruebler.files.link_solids import link_solids, round_solid
from gruebler.files.screws import read_any_linkage, screws_to_json, spatial_from_json
from gruebler.mechanics.screws import SpatialLinkage, exponential
from gruebler.page.space_page import space_model
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry

WHEEL = {"link": "1", "at": (3, 0, 1), "z": (0, 2, 0), "radius": 2, "length": 1}


def wheeled(**changes):
    mechanism = Mechanism.parse("spatial: R(0-1) H(1-2) P(0-2); drive=R(0-1)")
    z = (0, 0, 1)
    places = {0: {"z": z}, 1: {"z": z, "pitch": 0.8}, 2: {"x": z, "at": (0, 5, 0)}}
    return SpatialLinkage(mechanism, places, round_bodies={"wheel": WHEEL | changes})


@pytest.mark.parametrize("suffix", ["toml", "json"])
def test_files_keep_them(tmp_path, suffix):
    linkage = wheeled()
    gr.write(linkage, tmp_path / f"a.{suffix}")
    read = read_any_linkage(tmp_path / f"a.{suffix}")
    assert read == linkage
    assert read.round_bodies["wheel"].radius == 2
    assert "round_bodies" not in screws_to_json(entry("bennett").placed())["screws"]


def test_they_go_with_the_linkage():
    turned = (
        wheeled()
        .moved(exponential([0, 0, pi / 2, 0, 0, 5]))
        .scaled(2)
        .with_drives([])
        .with_points({"P": ("1", 0, 0, 0)})
    )
    body = turned.round_bodies["wheel"]
    assert body.at == pytest.approx((0, 6, 12))  # (3, 0, 1) a quarter round z, 5 up, twice as large
    assert body.z == pytest.approx((-2, 0, 0))
    assert (body.radius, body.length) == (4, 2)
    assert wheeled() == wheeled()
    assert wheeled() != wheeled(radius=3)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"radius": 0}, "wheel: radius: expected a positive number, but found 0"),
        ({"length": float("inf")}, "wheel: length: expected a positive number"),
        ({"at": (1, 2)}, "wheel: at: expected three finite numbers"),
        ({"z": (0, 0, 0)}, "wheel: z: expected a direction"),
        ({"link": "7"}, "7"),
        ({"width": 3}, "wheel: expected the keys link, at, z, radius, length"),
    ],
)
def test_wrong_ones_are_named(changes, said):
    with pytest.raises(LinkageError, match=said):
        wheeled(**changes)


def test_a_link_with_joints_in_no_plane_is_one_body_and_no_bar_goes_to_a_rim():
    """The knuckle of five links: balls on the corners of a body, a spindle to the wheel, none to its contact."""
    linkage = entry("susp_5link_lift").placed()
    knuckle = link_solids(linkage)["knuckle"]
    corners = linkage.frames[7:12, :3, 3]
    body = max(knuckle[:-1], key=lambda solid: solid.volume)  # the last is the wheel
    for corner in corners:
        assert np.linalg.norm(body.vertices - corner, axis=1).min() < 1.1 * linkage.size / 45
    (spindle,) = [solid for solid in knuckle[:-1] if solid.vertices[:, 0].max() > 850]
    assert spindle.vertices[:, 2].min() > 250
    assert all(np.ptp(solid.vertices[:, 2]) < 60 for solid in knuckle[:-1] if solid is not body)


def test_a_file_names_the_key():
    document = screws_to_json(wheeled())
    document["screws"]["round_bodies"]["wheel"]["radius"] = "wide"
    with pytest.raises(LinkageError, match=r"screws\.round_bodies\.wheel.*radius"):
        spatial_from_json(document)


def test_models_and_pages_have_them():
    linkage = wheeled()
    body = link_solids(linkage)["1"][-1]
    assert abs(body.vertices[:, 1]).max() == pytest.approx(0.5)  # half its length, along y
    assert np.hypot(body.vertices[:, 0] - 3, body.vertices[:, 2] - 1).max() == pytest.approx(2)
    whole = pi * 2**2 * 1
    assert 0.7 * whole < round_solid(linkage.round_bodies["wheel"]).volume < whole  # edges and hollows are left out
    (glass,) = space_model(linkage)["glass"]
    assert glass["link"] == 1
    assert len(glass["triangles"]) == body.triangles.size
    assert "wheel" in gr.draw(entry("susp_spatial").placed()).svg()
    assert entry("susp_spatial").in_language("de").placed().round_bodies["wheel"].link == "Radträger"
