"""Cams, Geneva drives and gear trains as pictures, read back: bodies touch, clear and mesh where the sizes say so."""

import cmath
import io
import math
import re
from dataclasses import astuple, replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.machines.cams import Cam, CamError, Flat, Lift, Roller, read_lift
from gruebler.machines.gears import GearError, read_train
from gruebler.machines.geneva import Geneva, GenevaError
from gruebler.pictures.canvas.moving_files import moving_bytes, moving_page
from gruebler.pictures.canvas.moving_picture import Body, Shift, Turn, at_time, figure_at, moving_svg
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, TextShape
from gruebler.pictures.machines.bevel_views import bevel_shapes
from gruebler.pictures.machines.cam_follower import follower_body
from gruebler.pictures.machines.cam_picture import animate_cam, draw_cam
from gruebler.pictures.machines.geneva_picture import animate_geneva, draw_geneva
from gruebler.pictures.machines.geneva_shape import GenevaShape
from gruebler.pictures.machines.teeth import toothed_outline
from gruebler.pictures.machines.train_layout import gear_stages
from gruebler.pictures.machines.train_motion import train_motion
from gruebler.pictures.machines.train_picture import animate_train, draw_train

SVG = "{http://www.w3.org/2000/svg}"
LIFT = read_lift("rise 20 90; dwell 60; fall 20 90 cycloidal; dwell")
ANGULAR = Lift(replace(one, scale=math.radians(one.scale)) for one in LIFT.segments)
SLOW = Lift(
    replace(one, scale=math.radians(0.7 * one.scale)) for one in read_lift("rise 20 140; fall 20 140; dwell").segments
)
CAMS = {
    "roller": Cam(LIFT, 40, Roller(10, offset=8)),
    "knife": Cam(LIFT, 40, Roller()),
    "flat": Cam(read_lift("rise 20 140; fall 20 140; dwell"), 60, Flat()),
    "swinging roller": Cam(ANGULAR, 40, Roller(10, arm=80, distance=100)),
    "swinging knife": Cam(ANGULAR, 40, Roller(arm=80, distance=-100)),
    "swinging flat": Cam(SLOW, 40, Flat(100, 6)),
    "swinging flat, pivot on the left": Cam(SLOW, 40, Flat(-100, -6)),
}
PLANETARY = "sun:24 planet:18 ring:-60 on arm planets=3; hold ring; sun=7"


def words(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def number(line):
    return complex(line.x, -line.y)


def inside(points, polygon):
    """How deep points lie in a closed polygon; 0 outside."""
    after = np.roll(polygon, -1)
    x, y, ax, ay, bx, by = points.real, points.imag, polygon.real, polygon.imag, after.real, after.imag
    cuts = (ay[None] > y[:, None]) != (by[None] > y[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        right = x[:, None] < (bx - ax)[None] * (y[:, None] - ay[None]) / (by - ay)[None] + ax[None]
    hit = (cuts & right).sum(axis=1) % 2 == 1
    way = (after - polygon)[None]
    part = np.clip(np.real((points[:, None] - polygon[None]) * way.conj()) / np.abs(way) ** 2, 0, 1)
    return np.where(hit, np.abs(points[:, None] - polygon[None] - part * way).min(axis=1), 0.0)


# --- cams ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", CAMS)
@pytest.mark.parametrize("degrees", [0, 40, 200])
def test_the_drawn_follower_touches_the_drawn_cam(name, degrees):
    """The follower's shapes do not enter the disc, and come to it within a pixel."""
    cam, phi, scale = CAMS[name], math.radians(degrees), 3.0
    turn = np.linspace(0, math.tau, 721)[:-1]
    disc = scale * (cam.profile(turn) @ [1, 1j]) * cmath.exp(1j * phi)
    gaps, depth = [], 0.0
    for shape in at_time([follower_body(cam, scale, np.array([phi]))], 0.0):
        if isinstance(shape, CircleShape):
            if shape.style == "node":
                gaps.append(abs(disc - number(shape.at)).min() - shape.radius)
        elif shape.style == "block":
            corners = np.array([number(p) for p in shape.parts[0]])
            sides = np.concatenate([np.linspace(a, b, 120) for a, b in zip(corners, np.roll(corners, -1), strict=True)])
            gaps.append(abs(disc[:, None] - sides[None]).min())
            depth = max(depth, inside(sides, disc).max())
    assert min(gaps) > -0.01
    assert min(gaps) < 1.5
    assert depth < 0.05


def test_the_pressure_angle_is_drawn_and_told():
    cam, at = CAMS["roller"], math.radians(40)
    figure = draw_cam(cam, at=at)
    alpha = float(cam.pressure_angle(at))
    assert f"α = {math.degrees(alpha):.1f}°" in words(figure)
    assert f"pressure angle {math.degrees(alpha):.2f}°" in figure.description
    arcs = [shape for shape in figure.shapes if isinstance(shape, ArcShape) and shape.radius > 50]
    assert [arc.extent for arc in arcs] == pytest.approx([-alpha])
    greatest = draw_cam(cam)
    most = max((one.value for one in cam.findings().pressure), key=abs)
    assert f"{math.degrees(most):.2f}°" in greatest.description


def test_base_circle_pitch_curve_and_undercut():
    assert {"base circle", "pitch curve"} <= set(words(draw_cam(CAMS["roller"])))
    assert "pitch curve" not in words(draw_cam(CAMS["knife"]))
    tight = Cam(read_lift("rise 20 45; dwell 60; fall 20 45; dwell"), 20, Roller(18))
    assert tight.findings().undercut
    figure = draw_cam(tight, lang="de")
    assert "Unterschnitt" in words(figure)
    assert "Unterschnitt bei" in figure.description
    marked = [s for s in figure.shapes if isinstance(s, Polylines) and s.style == "drive"]
    assert max(len(shape.parts) for shape in marked) == 2  # at the rise and at the fall
    hollow = Cam(read_lift("rise 20 60; dwell 30; fall 20 90; dwell"), 40, Flat())
    assert "undercut" in words(draw_cam(hollow))
    assert "undercut" not in words(draw_cam(CAMS["flat"]))


def test_the_diagram_is_the_lift():
    figure = draw_cam(CAMS["roller"], at=math.radians(40), plot=True)
    assert {"s", "s′ = ds/dφ", "s″ = d²s/dφ²", "40°"} <= set(words(figure))
    curves = [s.parts[0] for s in figure.shapes if isinstance(s, Polylines) and s.style == "line-1"]
    assert len(curves) == 3
    assert {"ψ in °", "ψ′ = dψ/dφ"} <= set(words(draw_cam(CAMS["swinging knife"], plot=True)))
    first = curves[0]
    left, right = min(p.x for p in first), max(p.x for p in first)
    low, high = max(p.y for p in first), min(p.y for p in first)
    for p in first:
        wanted = float(CAMS["roller"].lift.at((p.x - left) / (right - left) * (math.tau - 1e-9))) / 20
        assert (low - p.y) / (low - high) == pytest.approx(wanted, abs=2e-3)


@pytest.mark.parametrize("at", [math.nan, math.inf, "1", True])
def test_angles_of_machines_are_finite_numbers(at):
    with pytest.raises(CamError, match="finite number"):
        draw_cam(CAMS["knife"], at=at)
    with pytest.raises(GenevaError, match="finite number"):
        draw_geneva(Geneva(4), at=at)


# --- Geneva drives ---------------------------------------------------------------------------------

DRIVES = [
    *(Geneva(n) for n in (3, 4, 5, 6, 8, 12)),
    *(Geneva(n, internal=True) for n in (3, 4, 6, 10)),
    Geneva(3, pins=6),
    Geneva(6, pins=3),
    Geneva(5, pins=2),
]


@pytest.mark.parametrize("drive", DRIVES, ids=str)
def test_pins_stay_in_their_slots_and_the_locking_disc_outside_the_wheel(drive):
    shape = GenevaShape(drive)
    wheel = shape.wheel()
    dense = np.concatenate([np.linspace(a, b, 4)[:-1] for a, b in zip(wheel, np.roll(wheel, -1), strict=True)])
    (disc,) = shape.locking()
    for phi in np.linspace(-math.pi, math.pi, 73):
        placed = shape.axis + dense * cmath.exp(1j * float(drive.move(phi).angle))
        pins = shape.crank * np.exp(1j * (phi + math.tau / drive.pins * np.arange(drive.pins)))
        near = abs(placed[:, None] - pins[None]).min()
        assert near > 0.985 * shape.pin
        seen = placed * cmath.exp(-1j * phi)
        assert inside(seen, disc).max() < 0.3 * shape.pin


def test_a_locked_wheel_is_told_and_the_wheel_turns_as_it_should():
    assert "locked" in draw_geneva(Geneva(4), at=math.pi).description
    assert "gesperrt" in draw_geneva(Geneva(4), at=math.pi, lang="de").description
    assert "locked" not in draw_geneva(Geneva(4), at=0.1).description
    shown = animate_geneva(Geneva(5), plot=False)
    wheel = next(body for body in shown.bodies if any(isinstance(s, Shift) for s in body.steps))
    turn = next(step for step in wheel.steps if isinstance(step, Turn))
    keys = np.linspace(0, math.tau, len(turn.angles))
    assert turn.angles == pytest.approx(Geneva(5).move(keys).angle)
    assert turn.angles[-1] == pytest.approx(-math.tau / 5)


# --- gear trains -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        PLANETARY,
        "a:12 b:24 c:18 d:30; a=1",
        "in:17 ring:-53; in=1",
        "sun:20 a:16 b:18 ring:-80 on arm; sun=1; hold ring",
        "frame:-61 planet:30 on arm; arm=1",
        "in:20 lay:41; lay:19 out:42; in=1",
        "s:30 p:20 on arm planets=5; p:25 r:-75 on arm; s=1; hold r",
    ],
)
def test_teeth_mesh_in_all_positions(text):
    """Outlines of two wheels in mesh overlap by less than a tenth of a module, wherever they have turned."""
    reading = read_train(text)
    course = train_motion(reading.train, reading.drives, 4.0)
    for stage in gear_stages(reading.train, reading.planets):
        for mesh in stage.placed:
            a, b = (
                next(w for w in stage.wheels if w.link == link and abs(w.at - at) < 1e-6 and abs(w.radius - r) < 1e-6)
                for link, at, r in ((mesh.mesh.a, mesh.a, mesh.radii[0]), (mesh.mesh.b, mesh.b, mesh.radii[1]))
            )
            for time in (0.0, 0.1234, 0.777):
                lines = [outline(wheel, stage, course, time) for wheel in (a, b)]
                module = 2 * a.radius / abs(a.size)
                if a.internal or b.internal:
                    hole, pinion = lines if a.internal else lines[::-1]
                    depth = inside(pinion, hole)
                    outside = pinion[depth == 0]
                    deepest = max((abs(hole - p).min() for p in outside), default=0.0)
                else:
                    deepest = max(inside(lines[0], lines[1]).max(), inside(lines[1], lines[0]).max())
                assert deepest < 0.1 * module, (mesh.mesh, time)


def outline(wheel, stage, course, time):
    whole = toothed_outline(
        round(abs(wheel.size)), 2 * wheel.radius / abs(wheel.size), internal=wheel.internal, phase=wheel.phase
    )
    around = cmath.exp(1j * math.tau * time * course.turns(stage.carrier)) if wheel.planet else 1.0
    return wheel.at * around + whole * cmath.exp(1j * math.tau * time * course.turns(wheel.link))


def test_teeth_end_in_points_rather_than_cross():
    for teeth in (4, 5, 7, 12, 200):
        for internal in (False, True):
            line = toothed_outline(teeth, internal=internal)
            assert np.isfinite(line).all()
            assert (np.diff(np.unwrap(np.angle(line))) > -math.pi / teeth).all()


def test_distances_follow_from_sizes():
    (one,) = gear_stages(read_train("sun:20 a:16 b:18 ring:-80 on arm").train, {})
    sun, a, b = (one.axes[link] for link in ("sun", "a", "b"))
    assert [abs(a - sun), abs(b - a), abs(b - sun)] == pytest.approx([18, 17, 31])
    (row,) = gear_stages(read_train("in:20 lay:41; lay:19 out:42").train, {})
    assert [abs(row.axes["lay"] - row.axes["in"]), abs(row.axes["out"] - row.axes["lay"])] == pytest.approx([30.5] * 2)
    (two,) = gear_stages(read_train("sun:24 p:18 ring:-60 on arm; sun:24 q:18 ring:-60 on arm").train, {})
    assert two.central == {"sun", "ring"}
    assert two.axes["p"] == pytest.approx(-two.axes["q"])
    assert len(gear_stages(read_train("s:20 p:30 r:-80 on c; c:20 q:30 r:-80 on d").train, {})) == 2


def test_rates_are_exact_and_the_cycle_closes():
    reading = read_train(PLANETARY)
    course = train_motion(reading.train, reading.drives, 2.0)
    assert {link: course.turns(link) for link in reading.train.links} == {"sun": 21, "planet": -14, "arm": 6, "ring": 0}
    shown = animate_train(reading.train, reading.drives, planets=reading.planets)
    start, end = (at_time(shown.bodies, time) for time in (0.0, 1.0))
    assert len(start) == len(end) > 20
    for one, other in zip(start, end, strict=True):
        points = [
            [p for part in shape.parts for p in part] if isinstance(shape, Polylines) else [shape.at]
            for shape in (one, other)
        ]
        assert np.allclose(points[0], points[1], atol=1e-6)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.integers(8, 90), min_size=2, max_size=5), st.integers(1, 9))
def test_every_link_of_a_row_makes_whole_turns_in_the_shortest_time(teeth, speed):
    text = " ".join(f"w{k}:{z}" for k, z in enumerate(teeth))
    course = train_motion(read_train(text).train, {"w0": speed}, 1.0, most=10**9)
    turns = [rate * course.cycle for rate in course.rates.values()]
    assert all(turn.denominator == 1 for turn in turns)
    assert math.gcd(*(turn.numerator for turn in turns)) == 1
    assert course.time == course.cycle


def test_long_cycles_are_cut_and_said():
    reading = read_train("in:20 lay:41; lay:19 out:42; in=1")
    assert "repeats only after 861 turns of in;" in animate_train(reading.train, reading.drives).page.description
    assert (
        "erst nach 861 Umdrehungen von in;" in animate_train(reading.train, reading.drives, lang="de").page.description
    )
    assert "Turns until everything repeats" in animate_train(reading.train, reading.drives, most=861).page.description


@pytest.mark.parametrize(
    "text",
    [
        "belt motor:100 drum:250; crossed drum:80 out:120; chain out:20 last:40",
        "bevel left:16 star:10 right:-16 on case; left=1; right=0",
        "rack pinion:18 slide; pinion:30 in:12; in=1",
        "rack pinion:18 slide pitch=3; pinion=1",
        "winch drum:60 load falls=2; drum:100 hand:20; hand=1",
        "screw spindle slide lead=-5",
        "rack wheel:10 ground on cart; rack wheel:-10 top on cart; ground=0; wheel=1",
        "friction a:12.5 b:24.25",
        "sun:24 idler:12 last:24 on arm",
        "a:10 b:20; c:10 d:20; a=1; c=1",
        "s:20 p:30 r:-80 on c planets=3; c:20 q:30 r:-80 on d planets=3; s=1; hold r",
    ],
)
@pytest.mark.parametrize("teeth", [False, True])
def test_every_kind_of_train_is_drawn_and_moves(text, teeth):
    reading = read_train(text)
    figure = draw_train(reading.train, planets=reading.planets, teeth=teeth)
    shown = animate_train(reading.train, reading.drives, planets=reading.planets, teeth=teeth)
    listed = " ".join(words(figure))
    assert all(link in listed for link in reading.train.links)
    ElementTree.fromstring(figure.svg())
    assert moving_svg(shown).count("<animateTransform") >= 1
    assert figure.svg() == draw_train(reading.train, planets=reading.planets, teeth=teeth).svg()


def test_what_slides_goes_to_and_fro_as_far_as_its_wheel_turns():
    reading = read_train("rack pinion:18 slide; pinion=1")
    course = train_motion(reading.train, reading.drives, 4.0)
    assert course.displacement("slide") == pytest.approx(18 * math.tau * course.turns("pinion"))
    shown = animate_train(reading.train, reading.drives)
    assert not shown.clock.round
    (rack,) = [
        body
        for body in shown.bodies
        if isinstance(body.steps[-1:] and body.steps[-1], Shift) and len(body.steps[-1].places) > 2
    ]
    xs = [place.x for place in rack.steps[-1].places]
    assert xs == pytest.approx(xs[::-1], abs=1e-9)
    assert max(xs) > 20


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("a:10 b:20; c:10 d:10; a=1", "do not determine"),
        ("a:10 b:20; a=0", "nothing turns"),
        ("a:10 b:20; a:10 b:21", "nothing can turn"),
        ("a:9 b:9; a=1; b=1", "contradict"),
    ],
)
def test_trains_that_cannot_be_moved(text, match):
    reading = read_train(text)
    with pytest.raises(GearError, match=match):
        animate_train(reading.train, reading.drives)


# --- what moves, as files --------------------------------------------------------------------------


def test_the_svg_says_what_at_time_says():
    """Read as a viewer does: the first step replaces the transform, the others follow it."""
    reading = read_train(PLANETARY)
    for shown in (
        animate_train(reading.train, reading.drives, planets={"planet": 3}),
        animate_cam(CAMS["swinging knife"]),
    ):
        root = ElementTree.fromstring(moving_svg(shown))
        groups = [g for g in root.iter(f"{SVG}g") if g.find(f"{SVG}animateTransform") is not None]
        moving = [body for body in shown.bodies if any(len(astuple(step)[0]) > 1 for step in body.steps)]
        assert len(groups) == len(moving)
        for group, body in zip(groups, moving, strict=True):
            steps = group.findall(f"{SVG}animateTransform")
            assert [step.get("additive") for step in steps] == ["replace", *["sum"] * (len(steps) - 1)]
            for time in (0.0, 0.3, 0.8):
                mark = Body((CircleShape(Point(30.0, 10.0), 1.0, "dot"),), body.steps)
                wanted = at_time([mark], time)[0].at
                assert abs(complex(*seen(steps, time, 30 + 10j)) - complex(*wanted)) < 0.6


def seen(steps, time, z):
    for step in reversed(steps):
        values = np.array([[float(one) for one in value.split()] for value in step.get("values").split(";")])
        keys = np.linspace(0, 1, len(values))
        now = [np.interp(time, keys, column) for column in values.T]
        z = z + complex(*now) if step.get("type") == "translate" else z * cmath.exp(1j * math.radians(now[0]))
    return z.real, z.imag


@pytest.mark.parametrize("seconds", [0, -1, math.nan, math.inf])
def test_a_time_is_positive(seconds):
    reading = read_train(PLANETARY)
    for moving in (
        lambda: animate_cam(CAMS["knife"], seconds=seconds),
        lambda: animate_geneva(Geneva(4), seconds=seconds),
        lambda: animate_train(reading.train, reading.drives, seconds=seconds),
    ):
        with pytest.raises(GrueblerError, match="number of seconds"):
            moving()


def test_files_are_small_the_same_each_time_and_words_stay_words():
    assert len(draw_cam(CAMS["roller"]).svg()) < 8_000
    assert len(moving_svg(animate_cam(CAMS["roller"]))) < 20_000
    assert len(moving_svg(animate_geneva(Geneva(6)))) < 20_000
    assert moving_svg(animate_geneva(Geneva(6))) == moving_svg(animate_geneva(Geneva(6)))
    named = draw_cam(CAMS["knife"], name="<script>").svg()
    assert "<script" not in named
    page = moving_page(animate_geneva(Geneva(4), name="</script><b>"), "de")
    assert page.count("<script") == page.count("</script>") == 1
    assert "Abspielen" in page
    train = read_train("<b>:20 </script>:30; <b>=1")
    page = moving_page(animate_train(train.train, train.drives))
    assert page.count("</script>") == 1
    assert "<b>" not in page


def test_pictures_one_after_another():
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("matplotlib")
    shown = animate_geneva(Geneva(4), plot=False, seconds=0.4)
    with image.open(io.BytesIO(moving_bytes(shown, "gif"))) as picture:
        assert picture.n_frames == 8
    quarter = figure_at(shown, 0.25)
    assert (quarter.width, quarter.height) == (shown.page.width, shown.page.height)


def test_values_show_themselves_in_notebooks():
    for value, title in (
        (CAMS["flat"], "Cam with a translating flat-faced follower"),
        (Geneva(4), "External Geneva drive with 4 slots"),
        (read_train(PLANETARY).train, "Gear train"),
    ):
        assert f"<title>{title}</title>" in value._repr_svg_()
    assert "<animateTransform" in animate_geneva(Geneva(4))._repr_svg_()


GERMAN = {
    "cam": lambda: draw_cam(CAMS["roller"], at=1.03, plot=True, lang="de"),
    "Geneva drive": lambda: draw_geneva(Geneva(4), at=0.5, plot=True, lang="de"),
    "gear train": lambda: draw_train(read_train("a:20 b:1.5").train, lang="de"),
}


@pytest.mark.parametrize("machine", GERMAN)
def test_numbers_in_german_pictures_have_a_decimal_comma(machine):
    figure = GERMAN[machine]()
    words = [figure.description, *(shape.text for shape in figure.shapes if isinstance(shape, TextShape))]
    assert any(re.search(r"\d,\d", text) for text in words)
    assert [text for text in words if re.search(r"\d\.\d", text)] == []


def trapezoids(shapes):
    """The wheels of a view, by their corners, in half the size of a wheel with so many teeth."""
    return [shape.parts[0] for shape in shapes if isinstance(shape, Polylines) and shape.style == "area"]


@pytest.mark.parametrize(("copies", "above", "before"), [(1, 1, 1), (2, 2, 2), (3, 1, 3)])
def test_bevel_wheels_touch_along_their_pitch_cones(copies, above, before):
    train = read_train("bevel left:16 star:10 right:-16 on case").train
    (stage,) = gear_stages(train, {"star": copies})
    shapes = bevel_shapes(stage)
    left, right, *planets = trapezoids(shapes)[: 2 + above]
    assert len(trapezoids(shapes)) == 2 + above + before
    assert min(p.x for p in left) > 0 > max(p.x for p in right)  # by the sign of their teeth
    for planet in planets:
        for central in (left, right):
            common = {(round(p.x, 6), round(p.y, 6)) for p in planet} & {
                (round(p.x, 6), round(p.y, 6)) for p in central
            }
            assert len(common) == 2  # the ends of the teeth
            for x, y in common:  # on the line through the tips: radii and distances are as the teeth
                assert abs(y / x) == pytest.approx(16 / 10, abs=1e-5)
    circles = [shape.radius for shape in shapes if isinstance(shape, CircleShape) and shape.style == "area"]
    assert max(circles) == pytest.approx(max(p.y for p in right))


def test_which_bevel_wheels_are_unfolded():
    figure = draw_train(read_train("bevel a:20 b:40; bevel b:30 c:10").train)
    assert "unfolded" in figure.description
    assert "unfolded" not in draw_train(read_train("bevel a:20 b:40").train).description
    assert "unfolded" in animate_train(read_train("bevel a:20 b:40; a=1").train).page.description


def test_differentials_of_the_catalog_from_the_side(capsys):
    assert main(["draw", "diff_bevel2p", "--side", "--lang", "de"]) == 0
    svg = capsys.readouterr().out
    assert "Kegelräder von der Seite" in svg
    assert all(link in svg for link in ("Achswellenrad 1", "Ausgleichskegelrad 2", "Steg"))
    assert main(["draw", "wiper_rssr", "--side"]) == 2
    assert "no wheels" in capsys.readouterr().err
