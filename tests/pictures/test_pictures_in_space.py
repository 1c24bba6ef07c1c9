"""Pictures in space: views by their definition, what covers what by lines of sight, places by closed forms."""

import re
from itertools import combinations
from math import cos, pi, sin, sqrt

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import message
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import Bennett, SphericalFourBar, UniversalJoint
from gruebler.mechanics.space.drive_ranges import spatial_range
from gruebler.pictures.canvas.panels import draw_panels
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.canvas.styles import LINES, STYLES
from gruebler.pictures.canvas.textbook import textbook
from gruebler.pictures.canvas.tikz import tikz
from gruebler.pictures.space import animate_spatial, draw_spatial, plot_point, plots
from gruebler.pictures.space import scene as scenes
from gruebler.pictures.space.painting import covering_order
from gruebler.pictures.space.parts import LOOKS, link_bar, sleeve
from gruebler.pictures.space.scene import scene_of
from gruebler.pictures.space.symbols import SOLIDS
from gruebler.pictures.space.views import VIEWS, View
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines

Z = (0.0, 0.0, 1.0)
RSSR = SpatialLinkage(
    Mechanism.parse("spatial: R(frame-crank) S(crank-rod) S(rod-rocker) R(frame-rocker); drive=R(frame-crank)"),
    {0: {"z": Z}, 1: (1, 0, 0), 2: (3, 1, 2.5), 3: {"at": (4, 1, 0), "z": (0, 1, 0.2)}},
)


def test_views_are_those_of_the_standard():
    """ISO 5456-3: isometric axes alike and 120 degrees apart; cabinet: x and z true, y half at 45 degrees."""
    isometric = VIEWS["isometric"].on_paper(np.eye(3))[:, :2]
    assert np.linalg.norm(isometric, axis=1) == pytest.approx([sqrt(2 / 3)] * 3)
    assert [a @ b for a, b in combinations(isometric, 2)] == pytest.approx([-1 / 3] * 3)  # 2/3 cos 120 degrees
    oblique = VIEWS["oblique"].on_paper(np.eye(3))[:, :2]
    assert oblique == pytest.approx(np.array([[1, 0], [sqrt(2) / 4, -sqrt(2) / 4], [0, -1]]))
    for view in VIEWS.values():
        right, down, near = np.array(view.rows)
        sight = np.cross(down, right)  # moves nothing on paper, towards the eye
        assert view.on_paper(sight)[:2] == pytest.approx([0, 0], abs=1e-15)
        assert near @ sight > 0


def on_top(view, first, second):
    """Which of two segments the eye meets first at their crossing on paper, by the line of sight through both."""
    a, b = first
    c, d = second
    sight = np.cross(view.rows[1], view.rows[0])
    t, u, along = np.linalg.solve(np.stack([b - a, c - d, -sight], axis=1), c - a)
    return (t, u, along) if 0 < t < 1 and 0 < u < 1 else None


@pytest.mark.parametrize("name", VIEWS)
@pytest.mark.parametrize("seed", range(8))
def test_the_nearer_bar_is_painted_later_at_every_crossing(name, seed):
    view = VIEWS[name]
    ends = np.random.default_rng(seed).uniform(-100, 100, (14, 2, 3))
    pieces = covering_order([link_bar(str(k), *view.on_paper(segment)) for k, segment in enumerate(ends)])
    compared = 0
    for i, j in combinations(range(len(ends)), 2):
        found = on_top(view, ends[i], ends[j])
        if found is None or abs(found[2]) < 1e-2:
            continue
        t, u, along = found  # first + t = second + u + along * sight
        places = []
        for k, part in ((i, t), (j, u)):
            place = view.on_paper(ends[k][0] + part * (ends[k][1] - ends[k][0]))
            own = [n for n, piece in enumerate(pieces) if piece.link == str(k)]
            places.append(min(own, key=lambda n: distance(pieces[n].points, place)))
        nearer_second = along < 0
        assert (places[1] > places[0]) == nearer_second
        compared += 1
    assert compared > 5


def distance(ends, place):
    a, b = ends
    t = min(1, max(0, (place - a) @ (b - a) / ((b - a) @ (b - a))))
    return np.linalg.norm(a + t * (b - a) - place)


def test_bars_that_cover_each_other_in_a_ring_are_cut():
    """Each of three bars passes over the next one, like the flaps of a closed box."""
    bars = []
    for k in range(3):
        c, s = cos(2 * pi * k / 3), sin(2 * pi * k / 3)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        bars.append(link_bar(str(k), turn @ (-100, -30, -20), turn @ (100, -30, 20)))
    pieces = covering_order(bars)
    assert len(pieces) > 3
    for k in range(3):
        own = [piece for piece in pieces if piece.link == str(k)]
        assert sum(np.linalg.norm(p.points[1] - p.points[0]) for p in own) == pytest.approx(sqrt(200**2 + 40**2))
        assert sum(map(sum, (piece.cut for piece in own))) == 2 * (len(own) - 1)
    for i, j in combinations(range(3), 2):
        t, u, _ = on_top(FROM_ABOVE, bars[i].points, bars[j].points)
        places = [
            bar_.points[0] + part * (bar_.points[1] - bar_.points[0]) for bar_, part in ((bars[i], t), (bars[j], u))
        ]
        painted = []
        for k, place in zip((i, j), places, strict=True):
            own = [n for n, piece in enumerate(pieces) if piece.link == str(k)]
            painted.append(min(own, key=lambda n: distance(pieces[n].points, place)))
        assert (painted[1] > painted[0]) == (places[1][2] > places[0][2])


FROM_ABOVE = View(message("from above"), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))


@pytest.mark.parametrize("name", VIEWS)
def test_the_outline_of_a_cylinder_holds_all_its_places(name):
    start, end, radius = np.array([3.0, -20.0, 5.0]), np.array([30.0, 14.0, 60.0]), 17.0
    part = sleeve("a", start, end, radius)
    (outline, cap) = LOOKS["sleeve"](part.at(VIEWS[name].on_paper(part.points)))[1]
    corners = np.array(outline.parts[0])
    axis = (end - start) / np.linalg.norm(end - start)
    u = np.cross(axis, (1, 0, 0)) / np.linalg.norm(np.cross(axis, (1, 0, 0)))
    v = np.cross(axis, u)
    far = 0.0
    for angle in np.linspace(0, 2 * pi, 90):
        for along in (0.0, 0.4, 1.0):
            place = start + along * (end - start) + radius * (cos(angle) * u + sin(angle) * v)
            x = VIEWS[name].on_paper(place)[:2]
            edges = np.roll(corners, -1, axis=0) - corners
            away = (x - corners)[:, 0] * edges[:, 1] - (x - corners)[:, 1] * edges[:, 0]
            far = max(far, (away / np.linalg.norm(edges, axis=1)).max())
    assert -1e-9 < far < 0.4  # the sides of 32 and what is simplified
    nearer = max((start, end), key=lambda p: VIEWS[name].on_paper(p)[2])
    assert np.mean(np.array(cap.parts[0]), axis=0) == pytest.approx(VIEWS[name].on_paper(nearer)[:2], abs=2.0)


def circles(figure):
    return np.array([shape.at for shape in figure.shapes if isinstance(shape, CircleShape)])


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("turn", [0.0, 0.7, 2.5, -1.0])
def test_balls_lie_where_the_closed_form_says(view, turn):
    """The ball of the crank at (cos φ, sin φ, 0); that of the rocker on its circle, at the length of the rod."""
    balls = circles(draw_spatial(RSSR, at=turn, view=view, symbols=False))
    assert len(balls) == 2
    motion = gr.move(RSSR, [0.0, turn])
    places = np.array([motion.point(name)[-1] for name in ("S(crank-rod)", "S(rod-rocker)")])
    assert places[0] == pytest.approx([cos(turn), sin(turn), 0], abs=1e-12)
    assert np.linalg.norm(places[1] - places[0]) == pytest.approx(sqrt(11.25), abs=1e-12)
    seen = balls[1] - balls[0]
    wanted = VIEWS[view].on_paper(places[1] - places[0])[:2]
    cosine = seen @ wanted / np.linalg.norm(seen) / np.linalg.norm(wanted)
    assert abs(cosine) == pytest.approx(1, abs=1e-9)  # which ball is painted first depends on the view


def letters(figure):
    return sorted(shape.text for shape in figure.shapes if isinstance(shape, TextShape) and shape.style == "letter")


def test_letters_are_those_of_the_language():
    """Bild 2.2: S is a Schubgelenk in German texts, a ball joint (D3) in English ones."""
    winch = entry("winch_screw").placed()
    assert letters(draw_spatial(winch)) == ["H", "P", "R"]
    assert letters(draw_spatial(winch, lang="de")) == ["D", "S", "W"]
    assert letters(draw_spatial(RSSR)) == ["R", "R", "S", "S"]
    assert letters(draw_spatial(RSSR, lang="de")) == ["D", "D", "D3", "D3"]
    assert letters(draw_spatial(RSSR, symbols=False)) == []
    assert "Isometrische Ansicht" in draw_spatial(RSSR, lang="de").description


def drawn_pair(pair):
    space = Space.SPATIAL if Space.SPATIAL in pair.freedoms else Space.SPHERICAL
    frame = {"z": Z} if "z" in pair.axes[space] or not pair.axes[space] else {}
    frame |= {axis: v for axis, v in zip("xy", ((1, 0, 0), (0, 1, 0)), strict=True) if axis in pair.axes[space]}
    frame |= {"radii": (0.7, 0.5)} if pair.has_contours else {}
    frame |= {} if space is Space.SPHERICAL else {"at": (1, 1, 1)}
    other = {"z": (0.0, 1.0, 0.3)} | ({} if space is Space.SPHERICAL else {"at": (3, 0, 0)})
    mechanism = Mechanism.parse(f"{space}: {pair.name}(a-b) revolute(b-c) revolute(a-c)")
    return SpatialLinkage(mechanism, {0: frame, 1: other, 2: {"z": (1, 0, 0)}})


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: pair.name)
@pytest.mark.parametrize("view", VIEWS)
def test_every_pair_has_a_picture(pair, view):
    figure = draw_spatial(drawn_pair(pair), view=view, labels=True)
    without = draw_spatial(drawn_pair(PAIRS[0]), view=view, labels=True)
    assert pair.name in SOLIDS
    assert figure.svg().startswith("<svg")
    assert pair is PAIRS[0] or figure.shapes != without.shapes
    assert all(np.isfinite(part).all() for s in figure.shapes if isinstance(s, Polylines) for part in s.parts)


def test_wheels_of_a_bevel_differential_lie_on_their_pitch_cones():
    scene = scene_of(entry("diff_bevel").placed(), VIEWS["oblique"])
    cones = [part for part in scene.parts if part.look == "wheel"]
    assert sorted(cone.link for cone in cones) == ["planet", "sun1", "sun2"]  # the planet once, though it meshes twice
    for cone in cones:
        rim = cone.points[2:].reshape(2, -1, 3)[1]
        assert np.linalg.norm(rim, axis=1) == pytest.approx(130.0)  # on the sphere
        axis = cone.points[1] / np.linalg.norm(cone.points[1])
        assert rim @ axis / 130 == pytest.approx(cos(pi / 4))


def test_drives_about_one_axis_are_apart():
    """A differential drives a sun and the cage: one on each side."""
    scene = scene_of(entry("diff_bevel").placed(), VIEWS["oblique"])
    first, second = (places.mean(axis=0) for _, style, places in scene.lines if style == "drive")
    assert first[0] * second[0] < 0


def test_a_thread_reaches_to_the_bearing_of_its_screw():
    """In pixels of the scene: 40 mm between bearing and nut."""
    linkage = entry("winch_screw").placed()
    scene = scene_of(linkage, VIEWS["oblique"])
    (rod,) = [rod for rod in scene.rods if rod.thread]
    places = np.concatenate([part.points[2:] for part in rod.parts() if part.look == "thread"])
    along = (places / scene.scale + scene.middle)[:, 0]
    assert along.min() * scene.scale < 25.0  # of the bearing's symbol
    assert along.max() > 40.0


def test_a_plate_that_wobbles_is_a_disc_around_all_its_balls():
    """Its ball between the walls is farthest out: 55 mm from the journal, by the catalog entry's places."""
    scene = scene_of(entry("wobble_plate").placed(), VIEWS["isometric"])
    (disc,) = [part for part in scene.parts if part.look == "wheel"]
    rim = disc.points[2:].reshape(2, -1, 3)[0] - disc.points[0]
    assert disc.link == "plate"
    assert np.linalg.norm(rim, axis=1) / scene.scale == pytest.approx(np.hypot(51.683094143, 18.811107883))


def test_platforms_are_shaded_and_bodies_in_no_plane_are_not():
    shaded = {id: scene_of(entry(id).placed(), VIEWS["isometric"]).solids for id in ("gough", "susp_5link_lift")}
    assert shaded["gough"] == ("platform",)
    assert shaded["susp_5link_lift"] == ()
    figure = draw_spatial(entry("gough").placed())
    assert figure.shapes[0].style == "solid"


def test_what_is_behind_a_wheel_is_seen_through_it():
    """All bearings of the cage lie behind some wheel in one view or the other; in the file the wheels hide nothing."""
    figure = draw_spatial(entry("diff_bevel2p").placed())
    assert sum(shape.style == "wheel" for shape in figure.shapes) == 4
    assert STYLES["wheel"].opacity < 0.5
    assert ".gr-wheel{" in figure.svg()
    rule = figure.svg().split(".gr-wheel{")[1].split("}")[0]
    assert "fill-opacity:0.4" in rule
    assert tikz(figure).count("fill opacity=0.4") == 4


def test_bars_of_an_arc_meet_without_gaps_as_textbooks_have_them():
    """On the sphere the links are arcs of short bars, whose lines are the links in textbooks, also where they cross."""
    linkage = SphericalFourBar(*np.radians([30, 80, 60, 70])).linkage(0.5)
    shapes = textbook(draw_spatial(linkage)).shapes
    ends = [[complex(*end) for end in shape.parts[0]] for shape in shapes if shape.style == "textbook-body-rod"]
    gaps = [min(abs(a[1] - b[0]) for b in ends if b is not a) for a in ends]
    assert len(ends) >= 3 * 24  # three moving links; bars in a ring are cut
    assert sum(gap > 1e-6 for gap in gaps) <= 3  # the last bars of the links
    assert not any(shape.style == "textbook-outline-rod" for shape in shapes)


def test_a_moving_picture_goes_round_or_to_and_fro():
    bennett = Bennett(3.0, 0.6, 1.0).linkage()
    assert spatial_range(bennett).full
    shown = animate_spatial(bennett, seconds=1.0)
    assert len(shown.frames) == 15
    assert shown.clock.round
    assert (shown.clock.low, shown.clock.high) == (0.0, 360.0)
    svg = shown.svg()
    assert svg.count("<animate ") == 15
    assert svg.count('visibility="visible"') == 1
    assert shown.figure_at(0.0).shapes == shown.frames[0]
    winch = animate_spatial(entry("winch_screw").placed(), between=(0.0, 2.0), seconds=1.0, lang="de")
    assert not winch.clock.round
    there, back, first = (winch.figure_at((k + 0.5) / 15).svg() for k in (3, 12, 0))
    assert there == back != first
    page = gr.animate(bennett, seconds=0.5, view="oblique").html()
    assert "Oblique view" in page


def test_the_range_of_a_drive_ends_where_the_distance_is_too_long():
    """Crank of 2, rod of 2 and rocker of 1 on a base of 4 in one plane: cos φ = (4 + 16 - 9) / 16 at most."""
    places = {0: {"z": Z}, 1: (2, 0, 0), 2: (4 - 0.875 / 1, 0, 0), 3: {"at": (4, 0, 0), "z": Z}}
    height = sqrt(1 - 0.875**2 / 1)
    places[2] = (4 - 0.875, height, 0)
    rod = sqrt((2 - places[2][0]) ** 2 + height**2)
    linkage = SpatialLinkage(RSSR.mechanism, places)
    course = spatial_range(linkage)
    most = np.arccos((4 + 16 - (rod + 1) ** 2) / 16)
    assert not course.full
    assert (course.lowest, course.highest) == pytest.approx((-most, most), abs=1e-5)
    assert [stop.reason for stop in course.stops] == ["limit", "limit"]


def test_what_cannot_be_drawn_is_said():
    with pytest.raises(GrueblerError, match=r"there is no view 'isometrc' \(did you mean 'isometric'"):
        gr.draw(RSSR, view="isometrc")
    with pytest.raises(GrueblerError, match="has no option 'ghost'"):
        gr.draw(RSSR, ghost=3)
    with pytest.raises(LinkageError, match="a range needs one drive, but the mechanism has 0"):
        gr.animate(entry("susp_5link").placed()).svg()
    places = {0: {"z": Z}, 1: (2, 0, 0), 2: (3.125, 0.48, 0), 3: {"at": (4, 0, 0), "z": Z}}
    short = SpatialLinkage(RSSR.mechanism, places)
    with pytest.raises(LinkageError, match="The motion ends at"):
        gr.draw(short, at=3.0)


def test_paths_of_points_are_drawn_over_the_range():
    figure = gr.draw(RSSR, curves=["S(crank-rod)"], symbols=False).figure
    (curve,) = [np.array(shape.parts[0]) for shape in figure.shapes if shape.style == "curve"]
    ellipse = VIEWS["isometric"].on_paper(np.array([(1, 0, 0), (0, 1, 0)]))[:, :2]
    seen = np.linalg.solve(ellipse.T, (curve - (curve.max(axis=0) + curve.min(axis=0)) / 2).T)
    radii = np.linalg.norm(seen, axis=0)
    assert radii / radii.mean() == pytest.approx(np.ones(len(radii)), abs=0.02)  # a circle in space
    assert not re.search(r"curve", gr.draw(RSSR).svg())


# --- diagrams over the drive -------------------------------------------------------------------------


@pytest.fixture
def plotted(monkeypatch):
    """The panels of a diagram."""

    def panels_of(linkage, **options):
        seen = []
        monkeypatch.setattr(
            plots, "draw_panels", lambda panels, *rest: seen.append(panels) or draw_panels(panels, *rest)
        )
        return gr.plot(linkage, **options), *seen

    return panels_of


@pytest.mark.parametrize("between", [None, (0.3, 2.0)])
def test_the_diagram_of_a_universal_joint_is_its_closed_form(plotted, between):
    _, panels = plotted(machines.hooke(0.5), between=between)
    (curves,) = zip(*(panel.curves for panel in panels), strict=True)
    phi = np.radians(curves[0].x)
    assert phi[[0, -1]] == pytest.approx(between or (0, 2 * pi))
    expected = UniversalJoint(0.5).motion(phi).output
    assert np.radians(curves[0].y) == pytest.approx(expected.value, abs=1e-10)
    assert curves[1].y == pytest.approx(expected.velocity, abs=1e-10)
    assert curves[2].y == pytest.approx(expected.acceleration, abs=1e-9)


def test_dead_centres_in_a_diagram_are_where_the_rate_changes_sign(plotted):
    picture, panels = plotted(RSSR, between=(-7.0, 7.0))
    rate = panels[1].curves[0]
    crossings = [(a + b) / 2 for a, b, p, q in zip(rate.x, rate.x[1:], rate.y, rate.y[1:], strict=False) if p * q < 0]
    assert [mark.x for mark in panels[1].marks] == pytest.approx(crossings, abs=float(rate.x[1] - rate.x[0]))
    assert len(crossings) == 5  # two a turn; the first comes three times from -401 to 401 degrees
    assert "18.06°, 216.4°, 378.1°." in picture.figure.description


@pytest.mark.parametrize(("drive", "rate"), [("R(frame-carrier)", 2), ("R(frame-sun1)", -1)])
def test_one_of_several_drives_moves_in_a_diagram(plotted, drive, rate):
    """Willis: sun1 + sun2 = 2 carrier."""
    _, panels = plotted(entry("diff_bevel").placed(), output="R(frame-sun2)", drive=drive)
    value, first, second = (panel.curves[0].y for panel in panels)
    assert value[[0, -1]] == pytest.approx([0, 360 * rate])
    assert first == pytest.approx(rate, abs=1e-9)
    assert second == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    ("id", "drive", "words"),
    [
        ("diff_bevel", "R(frame-sun2)", "is not driven"),
        ("gough", None, "needs values between which it moves"),
        ("susp_5link", None, "needs a driven joint"),
    ],
)
def test_why_there_is_no_diagram(id, drive, words):
    with pytest.raises(LinkageError, match=words):
        gr.plot(entry(id).placed(), drive=drive)


def test_a_place_inside_a_ring_does_not_bend_it():
    angles = np.radians([10, 60, 130, 190, 250, 310])
    rim = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    ring, spurs = scenes._round_trip(np.vstack([rim[:2], [[0.05, 0.02, 0.0]], rim[2:]]))
    assert ring[0] == ring[-1]
    assert sorted(ring[:-1]) == [0, 1, 3, 4, 5, 6]
    assert spurs in ([(2, 0)], [(2, 1)])
    steps = np.diff([ring.index(k) for k in (0, 1, 3, 4, 5, 6)])
    assert {abs(step) for step in steps} <= {1, 5}  # in their order round the middle
    assert scenes._round_trip(np.eye(3)) == ([*scenes._round_trip(np.eye(3))[0]], [])


def test_a_point_over_the_drive_stays_in_the_plane_of_its_arm():
    """The Delta robot is alike on both sides of its first arm's plane: y stays 0; x and z move."""
    figure = plot_point(entry("delta").placed(), "T", (-0.3, 0.6))
    lines = [(s.style, np.array(s.parts[0])) for s in figure.shapes if isinstance(s, Polylines) and s.style in LINES]
    curves = {style: line for style, line in lines if np.ptp(line[:, 0]) > 500}  # no samples of the list
    x, y, z = (np.ptp(curves[style][:, 1]) for style in LINES[:3])
    assert y < 1e-6
    assert min(x, z) > 10
