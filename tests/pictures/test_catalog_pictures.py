"""All pictures of the catalog with names: no text lies over a line or another text, no leader ends in the empty."""

from __future__ import annotations

import itertools
import json
import math
from dataclasses import replace

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.cli.draw import linkage_and_range
from gruebler.files.linkages import linkage_from_json, linkage_to_json, linkage_to_toml, read_linkage
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages import Outline
from gruebler.pictures.canvas.arrangement import gallery_figure
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.free_space import distance_between
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, TextShape, bounds, text_width
from gruebler.pictures.canvas.styles import STYLES
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.pictures.linkage.slides import slides
from gruebler.pictures.structure import draw_structure
from gruebler.pictures.values import draw
from gruebler.teaching.catalog import entries, entry
from gruebler.teaching.catalog.feature_query import entry_mechanism

HALF = 4.0  # pixels: half the height of a digit, less the rounding of a place
NEAR = 4.0 + HALF  # from the middle line of a text to the end of its leader
WITH_SIZES = sorted(id for id, record in entries().items() if record.dimensions is not None)


def middle_line(text):
    wide = text_width(text.text, STYLES[text.style].size)
    x = text.at.x + {"start": 0.5, "middle": 0.0, "end": -0.5}[text.anchor] * wide
    half = max(0.0, wide / 2 - HALF)
    return np.array([x - half + 1j * text.at.y, x + half + 1j * text.at.y])


def edges(shape):
    """The lines that are seen of a shape, by their ends; a circle is the line around it."""
    if isinstance(shape, Polylines) and not shape.style.startswith("halo"):
        lines = [[*part, part[0]] if shape.closed else part for part in shape.parts]
    elif isinstance(shape, CircleShape | ArcShape):
        begin, extent = (shape.begin, shape.extent) if isinstance(shape, ArcShape) else (0.0, math.tau)
        turns = begin + extent * np.linspace(0, 1, 33)
        lines = [[(shape.at.x + shape.radius * math.cos(t), shape.at.y + shape.radius * math.sin(t)) for t in turns]]
    else:
        return
    for line in lines:
        yield from ((complex(*a), complex(*b), STYLES[shape.style].width / 2) for a, b in itertools.pairwise(line))


def faults(figure):
    texts = [shape for shape in figure.shapes if isinstance(shape, TextShape)]
    spans = [middle_line(text) for text in texts]
    a, b, half = np.array([edge for shape in figure.shapes for edge in edges(shape)]).T
    for text, span in zip(texts, spans, strict=True):
        if np.min(distance_between(*span, a, b) - half.real) < HALF:
            yield f"{text.text!r} over a line"
    for (text, span), (other, far) in itertools.combinations(zip(texts, spans, strict=True), 2):
        if distance_between(*span, *far) < 2 * HALF:
            yield f"{text.text!r} over {other.text!r}"
    for leader in (shape for shape in figure.shapes if isinstance(shape, Polylines) and shape.style == "measure"):
        end = np.complex128(complex(*leader.parts[0][-1]))
        if min((float(distance_between(*span, end, end)) for span in spans), default=math.inf) > NEAR:
            yield f"a leader ends in the empty at {end}"


def test_no_text_lies_over_a_line_and_no_leader_ends_in_the_empty():
    found = {}
    for id in WITH_SIZES:
        linkage, between = linkage_and_range(id, "de")
        found[id] = list(faults(draw_linkage(linkage, between=between, labels=True, lang="de")))
    assert len(found) > 60
    assert not any(found.values()), {id: fault for id, fault in found.items() if fault}


def test_the_same_holds_for_their_structures():
    found = {}
    for id, record in entries().items():
        shown = record.in_language("de")
        if record.space == "planar":
            contacts = None if shown.dimensions is None else contact_shapes(shown.linkage())
            figure = draw_structure(entry_mechanism(shown), labels=True, contacts=contacts, lang="de")
            found[id] = list(faults(figure))
    assert len(found) > 80
    assert not any(found.values()), found


def test_the_same_holds_for_machines_that_stand_still():
    """Of the two scissors one repeats the other: it is drawn, too, each end of an arm at its place."""
    found = {}
    for id, record in entries().items():
        still = record.in_language("de").pictured()
        if still is not None:
            figure = draw_linkage(still, labels=True, lang="de")
            found[id] = list(faults(figure))
            circles = np.array([complex(*shape.at) for shape in figure.shapes if isinstance(shape, CircleShape)])
            wanted = [complex(x, -y) for x, y, *_ in record.picture.places.values()]
            wanted = posed_linkage(still).scale * np.array(wanted[: 8 if id == "pumpjack_rod" else 10])  # no guide
            shifted = circles[:, None] + wanted - wanted[0]
            assert np.abs(shifted[..., None] - circles).min(axis=2).max(axis=1).min() < 0.5
    assert set(found) == {"pumpjack_rod", "scissor_lr", "scissor_tandem"}
    assert not any(found.values()), found


def test_the_same_holds_in_space():
    found = {}
    for id, record in entries().items():
        if record.space != "planar" and record.screws is not None:
            figure = draw(record.in_language("de").placed(), labels=True, lang="de").figure
            found[id] = list(faults(figure))
    assert len(found) > 15
    assert not any(found.values()), found


def test_nothing_is_drawn_outside_the_window():
    """Every corner, circle and text of the structures lies within the figure; gear trains have wide rings."""
    outside = set()
    for id, record in entries().items():
        if record.space == "planar" and record.dimensions is not None:
            figure = draw_structure(entry_mechanism(record), labels=True, contacts=contact_shapes(record.linkage()))
            corner, size = bounds(figure.shapes, 0.0)
            far = corner.plus(size)
            if min(corner) < 0 or far.x > figure.width + 1e-9 or far.y > figure.height + 1e-9:
                outside.add(id)
    assert outside == set()


def test_an_angle_takes_the_place_of_the_arrow_of_its_drive():
    """Two arcs with arrows about one joint cannot be told apart."""
    drawn = 0
    for id in ("crankrocker", "quad", "slidercrank", "compressor", "whitworth", "pent"):
        linkage, between = linkage_and_range(id, "en")
        figure = draw_linkage(linkage, between=between, show=["angles", "lengths", "joints"])
        arcs = [shape for shape in figure.shapes if isinstance(shape, ArcShape)]
        angles = [arc.at for arc in arcs if arc.style == "measure"]
        drives = [arc.at for arc in arcs if arc.style == "drive"]
        drawn += len(angles)
        assert all(math.dist(a, b) > 1 for a in angles for b in drives), id
    assert drawn > 6


def test_a_roller_has_no_arrow_of_a_drive():
    """Its drive is an idle turn: the arrow of the cam alone is drawn."""
    for id in ("cam_roller", "cam_rocker"):
        linkage, between = linkage_and_range(id, "en")
        figure = draw_linkage(linkage, between=between)
        assert [shape.style for shape in figure.shapes if isinstance(shape, ArcShape)] == ["drive"]


def test_the_check_itself_notices():
    figure = draw_linkage(FourBar(25, 70, 40, 70).linkage(), labels=True)
    joint = next(shape for shape in figure.shapes if isinstance(shape, CircleShape))
    lost = Polylines(((joint.at, joint.at.plus(Point(-70.0, -100.0), 5.0)),), "measure")
    worse = replace(figure, shapes=(*figure.shapes, TextShape(joint.at, "here", "name"), lost))
    assert list(faults(figure)) == []
    assert [fault.split(" at ")[0] for fault in faults(worse)] == ["'here' over a line", "a leader ends in the empty"]


# --- outlines ------------------------------------------------------------------------------------


def test_wheels_of_a_locomotive_are_drawn_and_turn_with_their_link():
    """In the file 750 mm about the axle; the rail below is hatched, the axles need no pedestals in the frame."""
    linkage = entry("loco2").linkage()
    figure = draw_linkage(linkage)
    wheels = [shape for shape in figure.shapes if isinstance(shape, CircleShape) and shape.style == "area"]
    apart = math.dist(wheels[0].at, wheels[1].at)
    assert len(wheels) == 2
    assert wheels[0].radius / apart == pytest.approx(750 / 2000)
    assert [shape.style for shape in figure.shapes].count("block-frame") == 1  # the frame itself, no pedestal


def test_outlines_come_back_from_files_and_follow_the_linkage(tmp_path):
    rocker = (
        FourBar(25, 70, 40, 70).linkage().with_outlines({"crank": [Outline(((0, 0),), 30), Outline(((0, 0), (0, 9)))]})
    )
    (tmp_path / "wheel.toml").write_text(linkage_to_toml(rocker))
    assert read_linkage(tmp_path / "wheel.toml") == rocker
    assert linkage_from_json(json.loads(json.dumps(linkage_to_json(rocker)))) == rocker
    assert rocker != FourBar(25, 70, 40, 70).linkage()
    assert rocker.scaled(2.0).outlines["crank"][0] == Outline(((0, 0),), 60)
    assert rocker.mirrored().outlines["crank"][1] == Outline(((0, 0), (0, -9)))
    assert list(rocker.renamed({"crank": "wheel"}).outlines) == ["wheel"]


def test_an_outline_of_a_drawing_lies_where_it_is_drawn():
    """The jackshaft of loco3 lies turned in its own coordinates; the wheels' middles are those of the axles."""
    linkage = entry("loco3").linkage()
    for link, x in (("jackshaft", 0), ("wheel1", 1400), ("wheel2", 3200)):
        (disc,) = linkage.outlines[link]
        assert linkage.required_pose[link].put(*disc.places[0]) == pytest.approx((x, 0), abs=1e-9)


@pytest.mark.parametrize(
    "outline", [Outline(()), Outline(((0, 0),)), Outline(((0, 0), (1, 0)), 2), Outline(((0, 0),), -1)]
)
def test_neither_a_disc_nor_a_line_is_refused(outline):
    with pytest.raises(LinkageError, match=r"outlines\.crank: an outline is a place with a radius"):
        FourBar(25, 70, 40, 70).linkage().with_outlines({"crank": [outline]})


def test_of_a_drive_without_end_one_turn_is_shown():
    """The rope guide of the winch goes on with the spindle: 2 pi times the radius of 30, not eight turns each way."""
    posed = posed_linkage(entry("winch_plane").linkage())
    assert np.ptp(posed.path.drives) == pytest.approx(math.tau, rel=1e-5)
    assert np.ptp(posed.path.displacement("P(frame-rope_guide)")) == pytest.approx(30 * math.tau, rel=1e-5)


def test_the_guide_of_a_tappet_ends_above_its_roller():
    """In the highest position too: the roller of 10 stands 70 above the axis of the cam there."""
    posed = posed_linkage(entry("cam_roller").linkage())
    (tappet,) = slides(posed)
    lowest = tappet.low.imag - (14 + 5) / posed.scale  # half a block and the guide's end below the lowest middle
    assert lowest > 70 + 10
    assert tappet.high.imag - tappet.low.imag == pytest.approx(20, rel=1e-3)


def test_pictures_of_unlike_width_fill_the_rows_of_a_poster():
    """Four pictures, one of them wide: with columns as wide as that one the fourth would stand alone below."""
    wide, narrow = (
        Figure((CircleShape(Point(size / 2, 50.0), 9.0, "joint"),), width=size, height=100.0, title="", description="")
        for size in (450.0, 300.0)
    )
    page = gallery_figure("", [Section("", tuple(Item(figure, "") for figure in (wide, narrow, narrow, narrow)))])
    circles = [shape.at for shape in page.shapes if isinstance(shape, CircleShape)]
    assert len({at.y for at in circles}) == 1
    assert [round(b.x - a.x) for a, b in itertools.pairwise(circles)] == [375, 300, 300]
    assert page.width == 450 + 3 * 300
