"""Plots, read back: lines lie where the values are, whatever the axes; what is marked is what the kinematics say."""

import math
import re
from itertools import pairwise
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.mechanics.analysis import drive_cycle
from gruebler.mechanics.analysis.events import transfer_function
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry.straight import coupler_path, piece_of_ratio
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.axes import Axis, decimals
from gruebler.pictures.canvas.panels import (
    AxisMarker,
    Band,
    Panel,
    PlottedCurve,
    PointMarker,
    draw_panels,
    ratio_diagram,
)
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, TextShape
from gruebler.pictures.linkage.curve_plots import coupler_plot, family_of, family_plot, hodograph
from gruebler.pictures.linkage.motion_plots import transfer_plot, transmission_plot
from gruebler.structure.mechanism import Mechanism

CRANK_ROCKER = FourBar(25, 70, 40, 70)
WITH_POINT = CRANK_ROCKER.linkage({"K": (35, 20)})
# Q_G, phi_G in degrees, L/l1 of the Meyer zur Capellen linkage of the collection sheet, computed with 30 digits.
SHEET = [
    (1e-06, 29.41365915, 0.834615432),
    (1e-05, 46.656141647, 1.314814296),
    (1e-04, 74.089500889, 2.050372978),
    (0.001, 117.905805725, 3.099352087),
    (0.005, 163.32477378, 3.907352348),
    (0.01, 187.827377087, 4.164803775),
]


def words(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def lines(figure, style):
    """The lines of a style, without the samples of the list beside the panels."""
    found = [shape for shape in figure.shapes if isinstance(shape, Polylines) and shape.style == style]
    return [part for shape in found for part in shape.parts if not (len(part) == 2 and part[0].x > 520)]


class Read:
    """The axes of a figure of one or more panels with linear scales, found by their tick marks and numbers."""

    def __init__(self, figure, number=0):
        axis = [shape for shape in figure.shapes if shape.style == "axis"][number]
        frame, marks = axis.parts[0], axis.parts[1:]
        corner = frame[1]
        self.texts = [shape for shape in figure.shapes if shape.style == "tick"]
        below = [mark[0] for mark in marks if mark[0].y == corner.y and mark[1].x == mark[0].x]
        left = [mark[0] for mark in marks if mark[0].x == corner.x and mark[1].x < mark[0].x]
        self.across = self.fit([(at.x, self.named(at.plus(Point(0, 15)))) for at in below])
        self.up = self.fit([(at.y, self.named(at.plus(Point(-9, 0)))) for at in left])

    def named(self, at):
        return next(
            float(t.text.replace("−", "-"))
            for t in self.texts
            if abs(t.at.x - at.x) < 0.01 and abs(t.at.y - at.y) < 0.01
        )

    @staticmethod
    def fit(pairs):
        (a, x), (b, y) = pairs[0], pairs[-1]
        return lambda pixel: x + (pixel - a) / (b - a) * (y - x)

    def values(self, line):
        return np.array([(self.across(p.x), self.up(p.y)) for p in line])


@settings(max_examples=25)
@given(st.lists(st.tuples(st.floats(0, 10), st.floats(-3, 3)), min_size=2, max_size=30))
def test_lines_lie_where_the_values_are(points):
    x, y = np.array(points).T
    panel = Panel(
        across=Axis("x", decimals(0, 10)),
        up=Axis("y", decimals(-3, 3)),
        curves=(PlottedCurve(x=x, y=y, name="", style="line-1"),),
    )
    figure = draw_panels([panel], "", "")
    read = Read(figure)
    for a in np.concatenate([read.values(line) for line in lines(figure, "line-1")] or [np.empty((0, 2))]):
        assert min(math.dist(a, b) for b in points) < 1e-6


def test_lines_are_cut_at_the_rim_and_broken_where_values_lack():
    x = np.linspace(0, 10, 401)
    with np.errstate(divide="ignore", invalid="ignore"):
        y = np.tan(x)
        y[100] = np.nan
    panel = Panel(
        across=Axis("x", decimals(0, 10)),
        up=Axis("y", decimals(-2, 2)),
        curves=(PlottedCurve(x=x, y=y, name="", style="line-1"),),
    )
    drawn = lines(draw_panels([panel], "", ""), "line-1")
    read = Read(draw_panels([panel], "", ""))
    assert len(drawn) > 4
    assert max(abs(read.values(line)[:, 1]).max() for line in drawn) < 2 + 1e-9
    gaps = [(a[-1][0], b[0][0]) for a, b in pairwise(sorted((read.values(p) for p in drawn), key=lambda v: v[0][0]))]
    assert any(a < x[100] < b for a, b in gaps)


def test_what_is_written_stays_clear_and_names_stay_text():
    panel = Panel(
        across=Axis("<b>", decimals(0, 1)),
        up=Axis("&", decimals(0, 1)),
        curves=(PlottedCurve(x=np.array([0.0, 1.0]), y=np.array([0.0, 1.0]), name="<script>", style="line-2"),),
        bands=(Band(0.0, 0.3, "low"),),
        marks=(AxisMarker(0.5, "here"), AxisMarker(0.505, "hidden")),
        spots=(PointMarker(x=0.5, y=0.5, text="</text>"),),
    )
    figure = draw_panels([panel], "<i>", "a & b")
    root = ET.fromstring(figure.svg())
    assert {"<b>", "&", "<script>", "low", "here", "</text>"} <= {e.text for e in root.iter() if e.text}
    assert "hidden" not in words(figure)
    assert not [e for e in root.iter() if e.tag.endswith("script")]


# --- over the drive --------------------------------------------------------------------------------


@pytest.mark.parametrize("linkage", [WITH_POINT, SliderCrank(25, 70, 8).linkage()])
def test_transfer_functions_are_those_of_the_kinematics(linkage):
    figure = transfer_plot(linkage)
    course, output = drive_cycle(linkage), find_output(linkage)
    drawn = lines(figure, "line-1")
    assert len(drawn) == 3
    for order, line in enumerate(drawn):
        read = Read(figure, order).values(line)
        wanted = transfer_function(course, output, np.radians(read[:, 0]), order)
        if order == 0 and output.turning:
            wanted = np.degrees(wanted)
        assert np.allclose(read[:, 1], wanted, atol=3e-3 * np.ptp(wanted))
    dead = [w for w in words(figure) if re.fullmatch(r"[\d.]+°", w)]
    assert len(dead) == 2
    assert all(word in figure.description for word in dead)
    assert len([shape for shape in figure.shapes if shape.style == "dead"]) == 6 + 1  # one in the list of lines


def test_dead_centres_are_marked_in_any_part_of_the_turn():
    figure = transfer_plot(CRANK_ROCKER.linkage(), between=(math.radians(-160), math.radians(40)))
    assert "Dead centres at -147.7°, 22.08°." in figure.description
    figure = transmission_plot(CRANK_ROCKER.linkage(), between=(math.radians(10), math.radians(200)))
    assert "Smallest 37.85° at 10°" in figure.description  # 0 degrees, where it is smaller, is not plotted
    assert "Dead centres at 22.08°." in figure.description


def test_near_limits_the_rest_is_still_seen():
    figure = transfer_plot(FourBar(60, 30, 40, 50).linkage())
    heights = Read(figure, 1).values(lines(figure, "line-1")[1])[:, 1]
    assert heights.max() < 20  # psi' grows without bound at both ends
    assert "drive from -78.46° to 78.46°" in figure.description


@pytest.mark.parametrize(("lang", "dead"), [("en", "Dead centres at"), ("de", "Totlagen bei")])
def test_the_transmission_angle_and_its_band(lang, dead):
    figure = transmission_plot(CRANK_ROCKER.linkage(), lang=lang)
    (line,) = lines(figure, "line-1")
    read = Read(figure).values(line)
    a, b, c, d = CRANK_ROCKER.a, CRANK_ROCKER.b, CRANK_ROCKER.c, CRANK_ROCKER.d
    square = a**2 + d**2 - 2 * a * d * np.cos(np.radians(read[:, 0]))
    mu = np.degrees(np.arccos((b**2 + c**2 - square) / (2 * b * c)))
    assert np.allclose(read[:, 1], np.minimum(mu, 180 - mu), atol=0.3)
    (band,) = [shape for shape in figure.shapes if shape.style == "warning"]
    assert sorted({round(Read(figure).up(p.y), 6) for p in band.parts[0]}) == [0, 40]
    assert {"μ < 40°", "μ_min = 37,0°" if lang == "de" else "μ_min = 37.0°"} <= set(words(figure))
    assert ("Totlage" if lang == "de" else "dead centre") in words(figure)
    assert dead in figure.description


# --- in the plane ----------------------------------------------------------------------------------


def test_the_hodograph_of_a_crank_pin_is_a_circle():
    figure = hodograph(WITH_POINT, ["R(crank-coupler)"], speed=4.0)
    read = Read(figure).values(lines(figure, "line-1")[0])
    assert np.allclose(np.hypot(*read.T), 25 * 4.0, rtol=2e-3)
    assert {"0°", "90°", "330°", "ẋ in mm/s"} <= set(words(figure))
    assert "360°" not in words(figure)


def test_a_hodograph_is_that_of_the_motion():
    read = Read(hodograph(WITH_POINT, ["K", "R(coupler-rocker)"]))
    (line,) = lines(hodograph(WITH_POINT, ["K", "R(coupler-rocker)"]), "line-1")
    path = drive_cycle(WITH_POINT).at(np.linspace(0, 2 * np.pi, 3000), 1).point("K", order=1)
    for point in read.values(line)[::5]:
        assert np.hypot(*(path - point).T).min() < 0.25


def test_both_axes_have_one_scale_and_curves_are_paths():
    figure = coupler_plot(WITH_POINT, ["K"])
    read = Read(figure)
    assert read.across(1) - read.across(0) == pytest.approx(read.up(0) - read.up(1), rel=1e-9)
    path = move(WITH_POINT, np.linspace(0, 2 * np.pi, 3000)).point("K")
    for point in read.values(lines(figure, "line-1")[0])[::5]:
        assert np.hypot(*(path - point).T).min() < 0.4


def test_a_family_of_points_on_a_line():
    figure = family_plot(WITH_POINT, count=3)
    assert {"(−35, 0)", "(35, 0)", "(105, 0)"} <= set(words(figure))
    assert len(lines(figure, "line-1")) == len(lines(figure, "line-2")) == len(lines(figure, "line-3")) == 1
    places = family_of(WITH_POINT, "rocker", 0j, 40 + 0j, 5)
    assert [(p.link, p.x, p.y) for p in places.values()] == [("rocker", 10.0 * k, 0.0) for k in range(5)]
    crank = family_plot(WITH_POINT, "crank", start=5j, end=25 + 5j, count=2)
    read = Read(crank)
    for line, radius in ((lines(crank, "line-1")[0], 5), (lines(crank, "line-2")[0], math.hypot(25, 5))):
        assert np.allclose(np.hypot(*read.values(line).T), radius, atol=0.2)


@pytest.mark.parametrize("linkage", [FourBar(60, 30, 40, 50).linkage(), InvertedSliderCrank(25, 25).linkage()])
def test_hodographs_where_velocities_grow_without_bound(linkage):
    joints = linkage.mechanism.chain.joint_names()[1:3]
    figure = hodograph(linkage, joints)
    for line in [*lines(figure, "line-1"), *lines(figure, "line-2")]:
        assert np.isfinite(Read(figure).values(line)).all()
    assert max(figure.width, figure.height) < 800


def test_rounding_is_no_acceleration():
    figure = transfer_plot(FourBar(25, 70, 25, 70).linkage())
    assert np.ptp([p.y for p in lines(figure, "line-1")[2]]) == 0


FIVE_BAR = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); drive=R(0-1); drive=R(0-4)"),
    {"R(0-1)": (0, 0), "R(1-2)": (-1, 2), "R(2-3)": (2, 4), "R(3-4)": (5, 2), "R(0-4)": (4, 0)},
)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: transfer_plot(FIVE_BAR), "one drive"),
        (lambda: transfer_plot("four-bar"), "expected a linkage"),
        (lambda: transfer_plot(WITH_POINT, "nowhere"), "none of"),
        (lambda: transmission_plot(WITH_POINT, between=(9.0, 9.0)), "nothing of it"),
        (lambda: hodograph(WITH_POINT, []), "1 to 8"),
        (lambda: hodograph(WITH_POINT, ["L"]), "no point"),
        (lambda: family_plot(WITH_POINT, "nowhere"), "no link"),
        (lambda: family_plot(WITH_POINT, count=1), "2 to 8"),
        (lambda: family_plot(WITH_POINT, start=1j, end=1j), "two different"),
        (lambda: family_plot(WITH_POINT, start=1j, end=complex("nan")), "two different"),
    ],
)
def test_wrong_calls_are_told(call, message):
    with pytest.raises(LinkageError, match=message):
        call()


# --- the diagram of Q_G ----------------------------------------------------------------------------


def sheet(**options):
    q, phi, length = zip(*SHEET, strict=True)
    return ratio_diagram(np.radians(phi), q, length, **options)


def test_the_diagram_of_the_collection_sheet():
    figure = sheet(at=(math.radians(163.32477378), 0.005, 3.907352348), lang="de")
    assert {"Q_G", "L/l₁", "φ_G in °", "P₁", "P₂", "10⁻⁶", "10⁻³", "10⁻²"} <= set(words(figure))
    assert "φ_G = 163,3°: Q_G = 0,005, L/l₁ = 3,907" in figure.description
    (ratio,), (length,) = lines(figure, "line-1"), lines(figure, "line-2")
    bottom, top = ratio[0].y, min(p.y for p in ratio)
    assert (bottom - ratio[-3].y) / (bottom - top) == pytest.approx(3 / 4, abs=1e-9)  # 0.001, in four decades
    assert ratio[0].x == pytest.approx(length[0].x)
    first, second = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape)]
    assert first.x == second.x
    assert (bottom - first.y) / (bottom - top) == pytest.approx(math.log10(0.005 / 1e-6) / 4)


def test_the_figures_of_the_sheet_are_those_of_the_linkage():
    path = coupler_path(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576)
    for ratio, phi, length in SHEET[2:]:
        found = piece_of_ratio(path, math.pi, ratio)
        assert math.degrees(found.end - found.start) == pytest.approx(phi, abs=1e-5)
        assert found.length == pytest.approx(length, abs=1e-7)


@pytest.mark.parametrize(
    "lists", [([1], [1], [1]), ([1, 2], [1, 2], [1]), ([1, 2], [0, 1], [1, 2]), ([1, 2], [1, math.inf], [1, 2])]
)
def test_a_diagram_needs_values(lists):
    with pytest.raises(GrueblerError, match="expected"):
        ratio_diagram(*lists)


def test_plots_are_small_and_the_same_from_run_to_run():
    for make in (transfer_plot, transmission_plot, family_plot):
        one = make(WITH_POINT).svg()
        assert one == make(WITH_POINT).svg()
        assert len(one) < 12_000
        assert re.search("stroke-dasharray", one)
