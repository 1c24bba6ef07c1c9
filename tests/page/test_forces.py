"""The panel of forces: efforts and joint forces against velocities of the page's own kernel, and a free motion."""

import base64
import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.files import linkage_to_json
from gruebler.files.load_reading import loads_of_document
from gruebler.mechanics.analysis import drive_cycle
from gruebler.mechanics.dynamics import inverse_dynamics, simulate
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.page.requests import answer
from gruebler.teaching.catalog import entries

ROOT = "document.querySelector('.gruebler-explorer').shadowRoot"
PANEL = '[data-panel="forces"]'
RELEASED = """() => {
    gruebler.motion.transport.toggle();
    gruebler.root.querySelector('[data-act="fall"]').click();
    return gruebler.motion.transport.player.playing;
}"""
UNTOLD = f"!{ROOT}.querySelector('.stage .hint').textContent"  # nothing is resized in a free motion
READ = f"{ROOT}.querySelector('{PANEL} .plot .read')?.textContent.split(' ')[0]"
ARROWS = f"{ROOT}.querySelector('.stage path.force').getAttribute('d')"
POSE = "JSON.stringify([...gruebler.motion.linkage.pose.turns])"


def asked(linkage, **more):
    return {"document": linkage_to_json(linkage), "drives": [0.0], **more}


def test_masses_are_offered_before_there_are_any():
    told = answer("forces", asked(FourBar(25, 70, 40, 70).linkage()), "en", print)
    assert (told["masses"], "drives" in told) == ([0, 0, 0, 0], False)
    assert told["origin"].startswith("Assumed masses: steel, bars 20 mm × 5 mm")  # as they would be assumed
    # 7850 kg/m³ · 20 mm · 5 mm · 70 mm
    told = answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), bars="steel"), "en", print)
    assert told["masses"] == [0, pytest.approx(0.0196, abs=1e-4), pytest.approx(0.05495, abs=1e-4), 0.0314]
    assert told["origin"].startswith("Assumed masses: steel, bars 20 mm × 5 mm")
    told = answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), masses=[0, 1.0]), "en", print)
    assert told["origin"] == ""


def test_what_is_read_between_rows_has_four_digits():
    """At one radian of the start machine, a turn in a second: the torque is the rate of the kinetic energy of its steel
    bars by the angle, 3.121 N mm, the largest of a turn 32.37 N mm; the page draws a line from row to row."""
    told = answer("forces", asked(entries()["lambda"].linkage(), bars="steel"), "en", print)
    assert np.interp(1.0, told["drives"], told["effort"]) == pytest.approx(3.121e-3, abs=1e-6)
    assert max(told["effort"], key=abs) == pytest.approx(32.37e-3, abs=5e-6)


def test_what_has_come_to_rest_is_said_to():
    """A crank between two compressed cylinders loses its energy to their valves; bars on pins swing on without end."""
    rest = "The motion has come to rest."
    told = answer("fall", asked(entries()["vcomp"].linkage(), source="vcomp", drives=[1.0], until=2), "en", print)
    assert np.abs(np.array(told["speeds"])[-24:]).max() < 1e-3 * np.abs(told["speeds"]).max()
    assert rest in told["lines"]
    told = answer("fall", asked(entries()["crankrocker"].linkage(), bars="steel", drives=[1.0], until=2), "en", print)
    assert rest not in told["lines"]


def figures(told):
    """Of each fact its amount, with its unit and its note."""
    return [(one["text"], one["note"]) for one in told["facts"]]


def test_what_a_motor_has_to_give():
    """Against a moment of 1 N m at 10 rad/s: 1 N m all the time, 10 W, in 0.2 pi s of a turn 6.28 J."""
    load = {"on": "link", "number": 1, "x": -1.0}
    question = asked(FourBar(25, 70, 40, 70).linkage(), loads=[load], speed=10.0)
    told = answer("forces", question, "en", print)
    assert [one["name"] for one in told["facts"]][:2] == ["Largest drive torque", "Drive torque, RMS"]
    assert [text for text, _ in figures(told)][:5] == ["1 N·m", "1 N·m", "10 W", "10 W", "6.28 J"]
    # masses alone take as much as they give back
    told = answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), bars="steel", speed=10.0), "en", print)
    most = max(told["effort"], key=abs)
    assert most < 0  # the drive brakes there, and an amount has no sign
    row = told["effort"].index(most)
    assert figures(told)[0] == (f"{-1000 * most:.3g} N·mm", f"at {math.degrees(told['drives'][row]):.4g}°, braking")
    assert figures(told)[2:5] == [(f"{-10 * most:.3g} W", "braking"), ("0 W", "0° … 360°"), ("0 J", "0° … 360°")]
    assert not told["lines"]  # what is certain is not said


INERT = {"ends": [[0, -20.0, 5.0], [1, 25.0, 0.0]], "stiffness": 0.0}


@pytest.mark.parametrize(
    "more",
    [
        {"loads": [{"on": "link", "number": 3, "x": 0.0}]},
        {"loads": [{"on": "joint", "number": 2, "x": 5.0}, {"on": "joint", "number": 2, "x": -5.0}]},
        {"springs": [INERT]},
    ],
)
def test_a_load_that_is_not_typed_yet_does_not_act(more):
    """A moment of nothing, two forces that cancel each other, a spring without stiffness."""
    told = answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), **more), "en", print)
    assert ("forces" in told, told["lines"]) == (False, ["Nothing acts yet: enter masses or loads."])
    acting = {"springs": [{**INERT, "damping": 0.1}]}
    assert answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), **acting), "en", print)["forces"]


@pytest.mark.parametrize("unit", ["mm", "cm", "m", "in"])
def test_moments_are_in_newton_metres_whatever_unit_lengths_have(unit):
    """1 N m at the crank, held by the drive and by a torsion spring of 1 N m/rad with its preload of 2 N m."""
    linkage = FourBar(25, 70, 40, 70).linkage(unit=unit)
    load = {"on": "link", "number": 1, "x": -1.0}
    told = answer("forces", asked(linkage, loads=[load], speed=10.0), "en", print)
    assert [text for text, _ in figures(told)][1:4] == ["1 N·m", "10 W", "10 W"]
    ends = [[0, 0.0, 0.0], [1, 0.0, 0.0]]
    spring = {"ends": ends, "turning": True, "stiffness": 1.0, "preload": 2.0, "free": 0.5}
    told = answer("forces", asked(linkage, springs=[spring], speed=10.0), "en", print)
    assert told["effort"] == pytest.approx([2 + drive - 0.5 for drive in told["drives"]], abs=1e-5)
    loaded = asked(linkage, springs=[spring])
    assert answer("forces", loaded, "en", print)["springs"][0]["preload"] == 2.0


def test_efforts_are_of_drives_with_names():
    """Of the two arms of a lamp one turns, the other is held."""
    names = ["arm 1", "arm 2"]
    question = asked(entries()["lamp"].linkage(), drives=[1.8, 1.85], range=[1.1, 2.6], full=False, called=names)
    told = answer("forces", {**question, "bars": "steel"}, "en", print)
    assert told["title"] == "Drive torque, arm 1"
    assert told["facts"][0]["name"] == "Largest drive torque, arm 1"
    assert told["facts"][-1]["name"] == "Largest holding torque, arm 2"


def test_a_bar_reaches_to_the_point_on_its_line():
    """The coupler of Chebyshev's lambda mechanism is a bar of 100 mm: 7850 kg/m³ · 20 mm · 5 mm · 100 mm."""
    told = answer("forces", asked(FourBar(20, 50, 50, 40).linkage({"C": (100, 0)}), bars="steel"), "en", print)
    assert told["masses"][2:] == [0.0785, pytest.approx(0.03925, abs=1e-4)]
    beside = answer("forces", asked(FourBar(20, 50, 50, 40).linkage({"C": (100, 1)}), bars="steel"), "en", print)
    assert beside["masses"][2] == pytest.approx(0.03925, abs=1e-4)  # a point that only draws a curve


def test_an_engine_shakes_by_the_law_of_its_crank():
    """The piston of a slider-crank, m r w² (1 + r/l) in the outer dead centre (any book on machine dynamics)."""
    question = asked(SliderCrank(30, 50).linkage(), masses=[0, 0, 0, 2.0], gravity=False, speed=100.0)
    told = answer("forces", question, "en", print)
    pin = next(one for one in told["forces"] if one["joint"] == 2)
    assert abs(pin["parts"][0][0]) == pytest.approx(2 * 0.03 * 100**2 * (1 + 30 / 50), rel=1e-6)
    assert told["effort"][0] == pytest.approx(0, abs=1e-3)


def test_a_pendulum_swings_in_its_own_time():
    """A rod that hangs on two parallel cranks swings as a point on a string: T = 2 pi sqrt(l/g)."""
    question = asked(FourBar(40, 70, 40, 70).linkage(), masses=[0, 0, 1.0, 0], until=1.0)
    hanging = {"frame": [0, 0, 0], "crank": [0, 0, -90], "coupler": [0, -40, 0], "rocker": [70, 0, -90]}
    question["document"]["reference_pose"] = hanging
    question["drives"] = [-math.pi / 2 + 0.02]
    told = answer("fall", question, "en", print)
    # -90 + 1.1459 cos(15.66) degrees after 1 s
    assert told["lines"][0].startswith("From rest the drive moves from ")
    # and nothing of rows or coordinates, which nobody sees here
    assert told["lines"][1:] == ["The energy balance holds to within 0.001\u00a0%."]
    start, end, least, most = (float(one) for one in re.findall(r"(\S+)°", told["lines"][0]))
    assert (start, end) == pytest.approx((-88.854, -91.144), abs=6e-3)
    assert (least, most) == pytest.approx((-91.146, -88.854), abs=6e-3)
    crank = [math.atan2(row[3], row[2]) + math.pi / 2 for row in told["turns"]]
    wanted = [0.02 * math.cos(math.sqrt(9.80665 / 0.04) * k / told["rate"]) for k in range(len(crank))]
    assert crank == pytest.approx(wanted, abs=2e-5)
    assert [one + math.pi / 2 for (one,) in told["drives"]] == pytest.approx(wanted, abs=2e-5)


def test_speeds_of_a_free_motion_are_plotted_without_corners():
    """The line from row to row is off by less than a twentieth of the largest speed of a fast fall."""
    linkage = entries()["lambda"].linkage()
    question = asked(linkage, drives=[1.0], bars="steel", until=1.0)
    told = answer("fall", question, "en", print)
    loads, _ = loads_of_document({"loads": answer("forces", question, "en", print)["kept"]["loads"]}, linkage)
    finer = np.linspace(0.0, 1.0, 2001)
    exact = simulate(linkage, loads, at=1.0, until=1.0, times=finer).speeds[:, 0]
    plotted = np.interp(finer, np.arange(len(told["speeds"])) / told["rate"], np.ravel(told["speeds"]))
    assert np.abs(plotted - exact).max() < 0.05 * np.abs(exact).max()


def test_a_released_linkage_falls_under_steady_loads_too():
    """The same pendulum, drawn by a force in place of its weight; of a small swing the speed is a sqrt(g/l)."""
    weight = {"on": "joint", "number": 1, "x": 0.0, "y": -9.80665}
    question = asked(FourBar(40, 70, 40, 70).linkage(), masses=[0, 0, 1.0, 0], gravity=False, loads=[weight], until=1.0)
    question["document"]["reference_pose"] = {
        "frame": [0, 0, 0],
        "crank": [0, 0, -90],
        "coupler": [0, -40, 0],
        "rocker": [70, 0, -90],
    }
    question["drives"] = [-math.pi / 2 + 0.02]
    told = answer("fall", question, "en", print)
    assert math.degrees(told["drives"][-1][0]) == pytest.approx(-91.144, abs=6e-3)
    assert max(speed for (speed,) in told["speeds"]) == pytest.approx(0.02 * math.sqrt(9.80665 / 0.04), rel=1e-3)
    # the force acts on the joint of one crank, which holds all of it: m g cos(0.02)
    crank = next(one for one in told["forces"] if one["name"] == "frame on crank")
    assert math.hypot(*(part[0] for part in crank["parts"])) == pytest.approx(9.80665, rel=1e-3)
    # and one that changes by a law: the weight and steep friction, which hold it still
    law = {"forces": {"R(crank-coupler)": [{"formula": "-500*tanh(vx/0.1)", "unit": "N"}, "-9.80665 N"]}}
    document = question["document"] | {"loads": law}
    question = {**question, "document": document, "loads": None}
    held = answer("fall", question, "en", print)
    assert math.degrees(held["drives"][-1][0]) == pytest.approx(-88.854, abs=1e-3)
    assert len(held["acting"]) == 1


def test_gases_act_in_a_free_motion_and_rounding_is_no_force():
    """The gas of the compressor alone turns the crank; the rods of the cylinders of an excavator carry no moment."""
    told = answer("fall", asked(entries()["compressor"].linkage(), source="compressor", until=0.1), "en", print)
    assert told["drives"][-1][0] > math.radians(90)
    (gas,) = told["acting"]
    assert min(gas["parts"][0]) < -100
    question = asked(entries()["crane_cyl"].linkage(), source="crane_cyl", bars="steel", drives=[40.0], full=False)
    forces = answer("forces", {**question, "range": [28.0, 50.0]}, "en", print)
    assert forces["speed"] == 20  # about its range in a second
    sizes = [one["most"] for one in forces["forces"]]
    assert all(size == 0 or size > 1e-6 * max(sizes) for size in sizes)


def test_cylinders_stop_at_their_ends_and_forces_are_told_up_to_these():
    """An excavator whose valves are opened falls until the first cylinder is at its stop, which the catalog gives.

    Its bars are a 25th of its boom wide. A cylinder has one joint beside that of its rod, and so is a block there, of
    15.7 kg: the weight of the one on the upper structure, which stands still, is the same all the time."""
    called = ["boom cylinder", "stick cylinder", "bucket cylinder"]
    question = asked(entries()["excavator"].linkage(), source="excavator", bars="steel", called=called, until=2.0)
    question["drives"] = [282.0, 220.0, 220.0]
    told = answer("fall", question, "en", print)
    boom, stick, bucket = np.array(told["drives"]).T
    assert 240 <= boom[-1] == boom.min() < 240.5
    assert stick.min() > 160
    assert bucket.max() < 255
    assert re.fullmatch(r"After 0\.\d+ s the motion ends at a stop: boom cylinder, 240 cm\.", told["lines"][0])
    assert told["lines"][2] == "Boom cylinder: from 282 cm to 240 cm."
    assert {one["unit"][0] for one in told["forces"]} == {"N"}  # all have the same
    assert told["forces"][3]["most"] == pytest.approx(15.7 * 9.80665)
    assert told["forces"][3]["note"] == "at 0 s"
    german = answer("fall", question, "de", print)
    assert len(german["drives"]) == len(told["drives"])
    # beside a stop by rounding it stands at it; a drive that the catalog does not limit is not stopped
    above = answer("fall", {**question, "drives": [330.0 + 1e-8, 220.0, 220.0], "until": 0.05}, "en", print)
    assert above["drives"][0][0] == 330
    with pytest.raises(GrueblerError, match="boom cylinder is at the end of its range, 240 cm, and is pushed farther"):
        answer("fall", {**question, "drives": [240.0, 220.0, 220.0]}, "en", print)
    other = answer("fall", {**question, "source": ""}, "en", print)
    assert min(other["drives"])[0] < 240
    forces = answer("forces", {**question, "active": 0, "full": False, "range": [240.0, 330.0]}, "en", print)
    assert forces["origin"].startswith("Assumed masses: steel, bars 200 mm × 50 mm")
    assert [forces["drives"][0], forces["drives"][-1]] == pytest.approx([240, 330])
    # a bonnet is shown up to where its hinges all but stretch; at that end the forces are four hundred times as large
    hood = {**asked(entries()["hood"].linkage(), source="hood", bars="steel"), "active": 0, "full": False}
    low, high = entries()["hood"].between
    inside = answer("forces", {**hood, "drives": [(low + high) / 2], "range": [low, high]}, "en", print)["drives"]
    assert [inside[0], inside[-1]] == pytest.approx([low + 0.02 * (high - low), high - 0.02 * (high - low)])
    assert "boom cylinder on boom piston" not in {one["name"] for one in forces["forces"]}  # nothing across the rod


def test_a_spring_pulls_by_its_law_and_a_torsion_spring_turns_by_its_own():
    """A spring of 2 N/mm from the frame to B, and one of 50 N mm about A: the torque by the way of B."""
    linkage = FourBar(25, 70, 40, 70).linkage()
    spring = {"ends": [[0, -20.0, 5.0], [1, 25.0, 0.0]], "stiffness": 2.0, "free": 10.0, "preload": 3.0}
    turning = {"ends": [[0, 0.0, 0.0], [1, 0.0, 0.0]], "turning": True, "stiffness": 0.05, "free": 0.5}
    told = answer("forces", asked(linkage, springs=[spring, turning], speed=1e-3), "en", print)
    assert [one["turning"] for one in told["springs"]] == [False, True]
    assert told["springs"][0]["ends"][0] == (0, -20, 5)
    for drive, effort in list(zip(told["drives"], told["effort"], strict=True))[::20]:
        x, y = 25 * math.cos(drive) + 20, 25 * math.sin(drive) - 5
        long = math.hypot(x, y)
        pull = 3 + 2 * (long - 10)
        own = pull / long * 25 * (x * -math.sin(drive) + y * math.cos(drive))  # the torque that moves B away
        assert effort == pytest.approx((own + 50 * (drive - 0.5)) / 1000, abs=1e-6)


def test_the_springs_of_the_catalog_are_told_and_changed():
    hood = entries()["hood"]
    cycle = drive_cycle(hood.linkage())
    low, high = cycle.span.low, cycle.span.high
    question = asked(hood.linkage(), source="hood", drives=[(low + high) / 2], range=[low, high], full=False)
    told = answer("forces", question, "en", print)
    a_second = (high - low) * 30 / math.pi  # through its range, in turns per minute
    assert told["speed"] * 30 / math.pi == pytest.approx(a_second, rel=0.4)
    (gas,) = told["springs"]
    assert (gas["known"], gas["damping"], [end[1:] for end in gas["ends"]]) == (0, 4.0, [(55, -40), (25, -4)])
    again = answer("forces", {**question, "springs": [gas]}, "en", print)
    assert again["effort"] == told["effort"]
    assert [tuple(again["springs"][0][key]) for key in ("ends",)] == [tuple(gas["ends"])]
    without = answer("forces", {**question, "springs": []}, "en", print)
    assert without["effort"] != told["effort"]


ENGINE = Path(__file__).parents[1] / "cli" / "engine.toml"
PRESS = """
unit = "cm"
joints = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker)"
drives = ["R(frame-crank)"]
points.P = { link = "coupler", at = [4, 3] }

[places]
"R(frame-crank)" = [0, 0]
"R(crank-coupler)" = [0, 2.5]
"R(coupler-rocker)" = [6, 5]
"R(frame-rocker)" = [7, 0]

[loads]
speed = "60 rpm"
bodies = { coupler = { mass = "300 g", bar = [[0, 2.5], [6, 5]] } }
masses = { "rocker:1,0" = "50 g" }
forces = { P = ["0 N", { formula = "-20*cos(drive)", unit = "N" }] }
springs = [{ between = ["frame:0,5", "P"], stiffness = "1 N/cm", free_length = 2 }]
"""


@pytest.mark.parametrize("lang", ["en", "de"])
def test_loads_of_a_file_act_on_the_page(lang, tmp_path):
    """As `dynamics` has them, whatever the links are called; places of the drawing become those of links."""
    from gruebler.cli.explore import _model
    from gruebler.files.linkages import read_loaded

    file = tmp_path / "press.toml"
    file.write_text(PRESS)
    document = _model(str(file), lang)["document"]
    told = answer("forces", {"document": document, "drives": [0.0], "source": str(file)}, lang, print)
    linkage, loads, speed = read_loaded(file)
    assert told["speed"] == speed == pytest.approx(2 * math.pi)
    assert (told["masses"], len(told["springs"])) == ([0, 0, pytest.approx(0.3), 0], 1)
    motion = move(linkage, told["drives"], speed=speed, order=2)
    wanted = inverse_dynamics(motion, loads).drive[:, 0] / 100  # from N·cm to N·m
    assert told["effort"] == pytest.approx(wanted.tolist(), abs=1e-6 * abs(wanted).max())
    assert ("rocker:1,0" if lang == "en" else "Schwinge:1,0") in told["lines"][0]
    # the reader's masses and springs stand in their place
    more = {"masses": [0, 0, 0, 0], "springs": []}
    other = answer("forces", {"document": document, "drives": [0.0], **more}, lang, print)
    rest = replace(loads, bodies={}, springs=())
    assert other["effort"] == pytest.approx((inverse_dynamics(motion, rest).drive[:, 0] / 100).tolist(), abs=1e-6)
    assert answer("fall", {"document": document, "drives": [1.0], "until": 0.1}, lang, print)["lines"]


@pytest.mark.parametrize("kind", ["toml", "json", "pmks"])
def test_the_loads_of_a_file_that_is_opened_are_saved_with_it(kind):
    content = base64.b64encode(ENGINE.read_bytes()).decode()
    opened = answer("open_file", {"name": "engine.toml", "base64": content}, "en", print)
    assert opened["note"] == ""
    document = opened["model"]["document"]
    saved = answer("export", {"document": document, "kind": kind}, "en", print)
    assert ("masses" in saved["note"]) == (kind == "pmks")
    again = answer("open_file", {"name": f"x{saved['ending']}", "base64": saved["base64"]}, "en", print)
    loads = again["model"]["document"]["loads"]
    if kind == "pmks":  # the program's own speed, and no masses
        assert {**loads, "gravity": None} == {"speed": "1.0471975511966 rad/s", "gravity": None}
    else:
        assert loads == document["loads"]


def test_assumed_wheels_are_discs_so_that_they_can_be_let_go():
    """Gears, cams and rollers with one place were points on their own axes, which no free motion moves."""
    pair = asked(entries()["geartrain"].linkage(), source="geartrain", bars="steel", until=0.5)
    masses = answer("forces", {**pair, "active": 0, "full": True, "range": [0, 2 * math.pi]}, "en", print)["masses"]
    assert masses[1] == pytest.approx(7850 * math.pi * 0.03**2 * 0.005, rel=1e-2)
    still = answer("fall", pair, "en", print)["lines"][0]
    assert still == "Nothing moves in 0.5 s; the drive stays at 0°."
    with pytest.raises(GrueblerError, match="needs masses that each drive moves"):
        answer("fall", asked(entries()["geneva"].linkage(), source="geneva", bars="steel", until=0.5), "en", print)


def test_a_spring_on_one_link_is_refused():
    spring = {"ends": [[1, 0.0, 0.0], [1, 5.0, 0.0]], "stiffness": 1.0}
    with pytest.raises(GrueblerError, match=r"springs\[0\]"):
        answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), springs=[spring]), "en", print)
    spring["ends"] = [[1, 0.0, 0.0], [9, 5.0, 0.0]]
    with pytest.raises(GrueblerError, match="there is no link 9"):
        answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), springs=[spring]), "en", print)


def test_a_load_that_is_nowhere_is_refused():
    load = {"on": "point", "number": 3, "x": 1.0}
    with pytest.raises(GrueblerError, match="there is no point 3"):
        answer("forces", asked(FourBar(25, 70, 40, 70).linkage(), loads=[load]), "en", print)


def read_number(text: str) -> float:
    """A number as it is written on the page, in either language."""
    return float(text.replace(",", ".").replace("\N{MINUS SIGN}", "-"))


@pytest.mark.parametrize("locale", [pytest.param("en-US", marks=pytest.mark.slow), "de-DE"])
def test_torque_arrows_and_the_way_it_falls(tab, server, locale):
    page = tab(locale=locale).open(server.address)
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator(f"{PANEL} .words summary").first.click()
    page.page.locator("#force-load-0").select_option("link 3")
    # nothing has a speed yet
    assert (page.page.evaluate(ARROWS), page.page.locator('[data-icon="play"]').count()) == ("", 0)
    page.until(f"!{ROOT}.querySelector('{PANEL} .waiting')")  # an answer lays the rows out anew
    for typed, wrong in (("1e99", 1), ("1", 0)):
        page.page.locator("#force-x-0").fill(typed)
        page.page.locator("#force-x-0").press("Tab")
        assert page.page.locator(f"{PANEL} .rows .error", has_text="−10⁹").count() == wrong
    # virtual work: the powers of drive and load cancel
    read = f"Number({READ}?.replace(',', '.').replace('\N{MINUS SIGN}', '-'))"
    speed = "gruebler.motion.linkage.pose.rates[3]"
    for drive in (1.0, 2.5):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        page.until(f"Math.abs({read} + {speed}) < 2e-3 * Math.abs({speed})", 60)
        assert page.page.evaluate(ARROWS).count("L") == 12  # three strokes a joint
    page.page.locator("#force-load-0").select_option("")
    page.page.locator('[data-act="assume"]').click()
    page.until(f"!{ROOT}.querySelector('[data-act=\"assume\"]') && {ROOT}.querySelector('[data-act=\"fall\"]')")
    before = page.page.evaluate(POSE)
    joint = page.page.locator(f"{PANEL} .facts").nth(1).locator("dd").first
    marked = f"{ROOT}.querySelector('{PANEL} .plot .cursor').getAttribute('d')"
    driven = joint.inner_text(), page.page.evaluate(marked)
    assert not page.page.evaluate(RELEASED)  # it waits for the answer where it is
    page.until(f"gruebler.motion.transport.player.playing && {POSE} !== '{before}' && {UNTOLD}", 90)
    seconds = "Number.parseFloat(gruebler.root.querySelector('.transport .value').value.replace(',', '.'))"
    for part in ("> 1.7", "< 0.5", "> 1.7"):  # again and again, until it is paused
        page.until(f"{seconds} {part}", 90)
    slider, drives = (page.page.locator(one) for one in (".track", ".motion .driven"))
    assert [slider.get_attribute(f"aria-value{end}") for end in ("min", "max")] == ["2e-7", "1.9999998"]
    # what is known of the drive only is not said of these poses; their forces are those of the fall
    panels = page.page.locator(".side > details:visible")
    assert panels.first.locator("> summary").inner_text() in ("Free motion", "Freie Bewegung")
    assert (
        not page.page.locator('[data-panel="measures"], [data-panel="plots"], [data-icon="play"]')
        .filter(visible=True)
        .count()
    )
    assert re.fullmatch(r"[\d.,]+ N\s+max.\s[\d.,]+\sN (at|bei)\s[\d.,]+\ss", joint.inner_text())
    assert page.page.evaluate(ARROWS).count("L") == 12
    assert not drives.first.is_visible()  # nothing drives it
    page.page.locator("button.play").click()  # it stands still, until it is ended
    paused = page.page.evaluate(POSE)
    page.page.wait_for_timeout(100)
    assert before != page.page.evaluate(POSE) == paused
    slider.press("PageDown")
    turned = "((turns) => Math.atan2(turns[3], turns[2]) * 180 / Math.PI)(gruebler.motion.linkage.pose.turns)"
    told = page.page.locator(f"{PANEL} .words[open] .plot .read").first
    assert (page.page.evaluate(turned) - read_number(told.text_content()) + 180) % 360 - 180 == pytest.approx(
        0, abs=0.06
    )
    page.page.locator('[data-act="end"]').click()
    # the plots of the way have no cursor any more
    assert (drives.first.is_visible(), page.page.evaluate(POSE), told.is_visible()) == (True, before, False)
    assert (joint.inner_text(), page.page.evaluate(marked)) == driven
    assert panels.first.get_attribute("data-panel") == "measures"
    assert "12/min" in page.page.locator(".transport .speed").inner_text()
    page.page.locator('[data-icon="play"]').click()
    assert "60/min" in page.page.locator(".transport .speed").inner_text()
    assert page.page.evaluate("gruebler.motion.transport.player.playing")


def test_a_speed_of_loads_is_none_of_another_machine(tab, server):
    """A compressor at its 1450 turns a minute."""
    page = tab().open(server.address).machine("vcomp")
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator('[data-icon="play"]').click()
    speed = page.page.locator(".transport .speed")
    assert "1450/min" in speed.inner_text()
    page.machine("slidercrank")
    assert "12/min" in speed.inner_text()


def test_springs_are_chosen_drawn_and_turn_the_drive(tab, server):
    """A coil from the left bearing to C and a spiral about A: energies that the drive stores in them."""
    page = tab().open(server.address)
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator(f"{PANEL} .words summary").first.click()
    page.page.locator("#spring-0").select_option(label="straight")
    # at first it spans two joints that come nearer to each other, as no two joints of one link do
    chosen = f"{ROOT}.querySelector('#spring-0-1').selectedOptions[0].textContent"
    assert page.page.evaluate(chosen) == "coupler – rocker"
    path = f"{ROOT}.querySelector('.stage path.spring-path').getAttribute('d')"
    page.page.evaluate("gruebler.motion.redraw()")
    assert not page.page.evaluate(path)  # it pulls nothing yet
    page.page.locator("#force-stiffness-0").fill("2")
    page.page.locator("#force-stiffness-0").press("Tab")
    drawn = page.until(path)
    assert drawn.count("M") == 3  # a coil with a ring at each end
    assert 6 <= drawn.count("L") - 3 <= 40  # turns of one coil, and what leads to them
    page.until(f"![undefined, '0'].includes({READ})", 60)
    read = float(page.page.evaluate(READ).replace("\N{MINUS SIGN}", "-"))
    square = "((c) => c[0] ** 2 + c[1] ** 2)(gruebler.motion.linkage.jointAt(2))"  # A lies at the origin
    stored = []
    for drive in (1.001, 0.999):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        stored.append(page.page.evaluate(square) / 1000)  # 2/2 r², in joules
    assert read == pytest.approx((stored[0] - stored[1]) / 0.002, rel=5e-3)
    page.page.locator("#spring-1").select_option(label="torsion")
    page.page.locator("#force-stiffness-1").fill("1")
    page.page.locator("#force-stiffness-1").press("Tab")
    page.until(f"{path}.split('M').length === 7")
    page.page.locator("#spring-0").select_option(label="none")
    page.until(f"{path}.split('M').length === 4")


def test_on_a_phone_results_stand_next_to_the_stage_and_a_finger_meets_all_fields(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address).page
    panel = page.locator(PANEL)
    panel.locator("summary").first.click()
    offer = panel.locator('[data-act="assume"]')
    offer.wait_for()
    offer.click()
    panel.locator(".plot.polar").wait_for()
    folded = panel.locator(".words").first  # what acts, above its results
    assert folded.bounding_box()["y"] < panel.locator(".facts").first.bounding_box()["y"]
    folded.locator("summary").click()
    result = panel.locator(".facts").first
    assert result.bounding_box()["y"] < panel.locator(".plot").first.bounding_box()["y"]
    told = answer("forces", asked(entries()["crankrocker"].linkage(), bars="steel"), "en", print)
    read = [" ".join(text.split()) for text in result.first.locator("dd").all_text_contents()]
    assert read == [f"{text} {note}".strip() for text, note in figures(told)]
    force = read[-1]
    assert panel.get_by_label("Drive speed", exact=True).input_value() == "60"
    assert panel.get_by_text("Assumed masses: steel, bars 20 mm × 5 mm").count() == 1

    forces = [
        (math.hypot(x, y), k) for one in told["forces"] for k, (x, y) in enumerate(zip(*one["parts"], strict=True))
    ]
    strongest, row = max(forces)
    assert force == f"{strongest:.3g} N at {math.degrees(told['drives'][row]):.4g}°, frame on rocker"
    rings = [float(text.split()[0]) for text in panel.locator(".polar text:not([data-axis])").all_text_contents()]
    assert len(rings) >= 3
    assert rings == pytest.approx([rings[0] * (k + 1) for k in range(len(rings))])
    assert rings[-2] < strongest <= rings[-1]  # the curve ends within them
    size = "parseFloat(getComputedStyle(gruebler.root.querySelector('.stage text[data-arrow]')).fontSize)"
    assert page.evaluate(size) >= 12
    assert panel.locator('label:has([type="checkbox"])').bounding_box()["height"] >= 44
    for drive in (0.5, 1.5, 3.0, 5.0):  # what is read stands above the lines of the plot, wherever the drive is
        page.evaluate(f"gruebler.motion.transport.pick({drive})")
        read, curve = (panel.locator(f".plot {part}").first.bounding_box() for part in (".read", ".curve"))
        assert read["y"] + read["height"] <= curve["y"] + 1
    # a low picture and the bar stay in sight, and at the top of the page nothing is covered by them
    for gone in (0, 1e5):
        page.evaluate(f"scrollTo(0, {gone})")
        page.wait_for_function(
            f"() => gruebler.root.querySelector('.stage').matches('.low') === {str(gone > 0).lower()}"
        )
        stage, bar, side = (
            page.locator(f".motion > {part}").bounding_box() for part in (".stage", ".transport", ".side")
        )
        assert bar["y"] == pytest.approx(stage["y"] + stage["height"], abs=1)
        if not gone:
            assert side["y"] == pytest.approx(bar["y"] + bar["height"], abs=1)
    assert stage["y"] == pytest.approx(0, abs=1)
    assert stage["height"] == pytest.approx(0.26 * 844, abs=1)


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1024, 768), (390, 844)])
def test_the_figures_that_a_button_brings_are_in_sight(tab, server, width, height):
    """They stand below all other panels; on a phone below the picture and its bar."""
    page = tab(width=width, height=height, touch=width < 500).open(server.address).page
    panel = page.locator(PANEL)
    panel.locator("summary").first.click()
    folded = panel.locator(".words summary")
    assert folded.inner_text() == "Masses, loads"  # before there is an answer, too
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    page.wait_for_timeout(100)
    top = page.locator(".motion > .transport").bounding_box() if width < 500 else None
    for part in (".facts", ".plot"):
        box = panel.locator(part).first.bounding_box()
        assert box["y"] >= (top["y"] + top["height"] if top else 0)
        assert box["y"] + box["height"] <= height


def test_each_joint_has_its_force_where_the_drive_is_and_masses_their_source(tab, server):
    """As the library has them; steel goes with the sizes, until a mass is typed."""
    page = tab().open(server.address)
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    linkage = entries()["crankrocker"].linkage()
    told = answer("forces", asked(linkage, bars="steel"), "en", print)
    read = panel.locator(".facts").nth(1).locator("div")
    row = 37
    page.page.evaluate(f"gruebler.motion.transport.pick({told['drives'][row]})")
    for k, one in enumerate(told["forces"]):
        sizes = [math.hypot(x, y) for x, y in zip(*one["parts"], strict=True)]
        value, most = re.fullmatch(
            r"(\S+) N max\.\s(\S+)\sN at\s\S+°", read.nth(k).locator("dd").inner_text().replace("\n", " ")
        ).groups()
        assert float(value) == pytest.approx(sizes[row], rel=6e-3)
        assert float(most) == pytest.approx(max(sizes), rel=6e-3)
    assert read.locator("dt").all_inner_texts()[0] == "F₁ frame on crank"
    # the arrows have the signs of the rows, that of the chosen one how much it is
    signs = [text.split()[0] for text in read.locator("dt").all_inner_texts()]
    for row in (None, 2, 0):
        if row is not None:
            read.nth(row).click()
            assert panel.get_by_label("Force vector").input_value() == str(row)
            marks = read.evaluate_all("rows => rows.map((row) => getComputedStyle(row).boxShadow !== 'none')")
            assert marks == [k == row for k in range(len(signs))]
        chosen = int(panel.get_by_label("Force vector").input_value())
        value = read.nth(chosen).locator("dd").inner_text().split("max.")[0].strip()
        expected = [f"{sign} {value}" if k == chosen else sign for k, sign in enumerate(signs)]
        assert sorted(page.page.locator(".stage text[data-arrow]").all_text_contents()) == sorted(expected)
    plot = panel.locator(".plot:not(.polar)")
    assert plot.locator(".title").text_content() == "Drive torque [N·mm]"
    assert plot.get_by_text("Drive [°]").count() == 1

    panel.locator(".words summary").click()
    mass = panel.get_by_label("Mass crank")
    length = page.page.get_by_role("textbox", name="crank", exact=True)
    length.fill("26")
    length.press("Enter")
    page.until(f"{ROOT}.querySelector('#force-mass-1').value === '0.0204'")  # 7850 kg/m³ · 20 mm · 5 mm · 26 mm
    assert panel.get_by_text("Assumed masses").count() == 1
    mass.fill("0.5")
    mass.press("Tab")
    page.until(f"!{ROOT}.querySelector('{PANEL}').textContent.includes('Assumed')")
    assert mass.input_value() == "0.5"
    assert panel.get_by_label("Mass coupler").input_value() == "0.055"


def test_another_machine_has_its_own_force_vector(tab, server):
    """The seventh joint of the excavator was kept for a four-bar, which has four: no name, and the plot of before."""
    page = tab().open(server.address)
    panel = page.page.locator(PANEL)
    for machine, joints in (("excavator", 13), ("crankrocker", 4)):
        page.machine(machine)
        if machine == "excavator":
            panel.locator("summary").first.click()
        panel.locator('[data-act="assume"]').click()
        rows = panel.locator(".listed > div")
        rows.nth(joints - 1).wait_for()
        sizes = panel.get_by_label("Force vector")
        largest = max(range(joints), key=lambda k: largest_of(rows.nth(k).inner_text()))
        assert sizes.input_value() == str(largest)
        assert page.page.evaluate(f"{ROOT}.querySelector('.plot.polar .curve').getAttribute('d')")
        rows.nth(joints - 1).click()
        assert sizes.input_value() == str(joints - 1)


def largest_of(row):
    """The largest force of a row of the list, in newtons."""
    value, unit = re.search(r"max\.\s(\S+)\s(k?N)", row).groups()
    return float(value) * (1000 if unit == "kN" else 1)


def test_arrows_of_a_low_picture_are_shorter_and_their_value_is_not_under_a_button(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator('[data-act="assume"]').click()
    page.page.locator(f"{PANEL} .plot.polar").wait_for()
    page.until(f"{ROOT}.querySelector('.stage.low')")
    high = page.page.locator(".stage").bounding_box()["height"]
    value = page.page.locator(".stage text[data-arrow]").first
    for drive in range(0, 360, 20):
        page.page.evaluate(f"gruebler.motion.transport.pick({math.radians(drive)})")
        strokes = re.findall(r"M([^ML]+) ([^ML]+)L([^ML]+) ([^ML]+)", page.page.evaluate(ARROWS))
        lengths = [math.dist((float(x), float(y)), (float(u), float(v))) for x, y, u, v in strokes]
        assert max(lengths) <= 0.3 * high + 0.2
        button, text = (one.bounding_box() for one in (page.page.locator(".stage .tools button").last, value))
        apart = (button["x"] - text["x"] - text["width"], text["y"] - button["y"] - button["height"])
        assert max(apart) >= 0, drive


TEXTS = f"""[...{ROOT}.querySelectorAll('.stage text:is(.name, .mark, [data-arrow])')]
  .map((one) => one.getBoundingClientRect()).map(({{x, y, width, height}}) => [x, y, x + width, y + height])"""
SPRINGS = f"""((path) => {{ const {{x, y}} = path.ownerSVGElement.getBoundingClientRect();
  return Array.from({{length: 400}}, (_, k) => path.getPointAtLength(k / 399 * path.getTotalLength()))
    .map((at) => [x + at.x, y + at.y]) }})({ROOT}.querySelector('.stage path.spring-path'))"""


def test_springs_pass_through_no_name_and_no_number(tab, server):
    """The name of the elbow of the desk lamp stood on the spring of its upper arm; long words stay in their panel."""
    page = tab(width=1440, height=900, locale="de-DE").open(server.address)
    page.machine("lamp")
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator(f"{PANEL} .plot.polar").wait_for()
    for drive in range(65, 150, 10):
        page.page.evaluate(f"gruebler.motion.transport.pick({math.radians(drive)})")
        texts, springs = page.page.evaluate(TEXTS), page.page.evaluate(SPRINGS)
        assert len(texts) >= 7
        for left, top, right, bottom in texts:
            # the box of a text has some room above and below its letters
            assert not [p for p in springs if left < p[0] < right and top + 3 < p[1] < bottom - 3], drive
    panel = page.page.locator('[data-field="force-joint"]').bounding_box()
    assert panel["x"] + panel["width"] <= 1440 - 16
    its = '.plot[aria-label*="Birne"]'
    title, plot = (page.page.locator(f'[data-panel="plots"] {one}').first for one in (its + " text.title", its))
    assert title.text_content().endswith("[mm/rad]")
    ends = [box["x"] + box["width"] for box in (title.bounding_box(), plot.bounding_box())]
    assert ends[0] <= ends[1]
    read, curve = (plot.locator(part).first.bounding_box() for part in (".read", ".mesh"))
    assert read["y"] + read["height"] <= curve["y"] + 1
    panel = page.page.locator(f"{PANEL} label:has(select)")
    assert panel.locator("select").bounding_box()["width"] == pytest.approx(panel.bounding_box()["width"], abs=1)


def test_numbers_of_a_low_picture_keep_clear_of_names_and_arrows_of_its_edges(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.machine("vcomp")
    page.page.locator(f"{PANEL} summary").first.click()
    page.page.locator(f"{PANEL} .plot.polar").wait_for()
    page.page.locator(f"{PANEL} .plot.polar").scroll_into_view_if_needed()
    page.until(f"{ROOT}.querySelector('.stage.low')")
    page.page.evaluate(f"{ROOT}.querySelector('{PANEL} .words').open = true")
    label = page.page.locator(f"{PANEL} .rows label").nth(1).bounding_box()
    assert label["width"] >= 110  # also beside names of joints that are longer than it is
    page.page.locator(f"{PANEL} .words summary").click()
    stage = page.page.locator(".stage").bounding_box()
    for drive in range(0, 360, 20):
        page.page.evaluate(f"gruebler.motion.transport.pick({math.radians(drive)})")
        for kind in ("force", "force.load"):
            drawn = page.page.evaluate(f"{ROOT}.querySelector('.stage path.{kind}').getAttribute('d')")
            assert drawn or kind == "force.load", drive
            rows = [float(y) for y in re.findall(r"[ML]\S+ (\S+?)(?=[ML]|$)", drawn)]
            assert all(4 < y < stage["height"] - 4 for y in rows), drive
        texts = page.page.evaluate(TEXTS)
        for left, top, right, bottom in page.page.evaluate(
            TEXTS.replace(":is(.name, .mark, [data-arrow])", "[data-arrow]")
        ):
            assert 0 <= left < right <= 390, drive
            assert -1 <= top - stage["y"] < bottom - stage["y"] <= stage["height"] + 1, drive
        for k, (left, top, right, bottom) in enumerate(texts):
            for x, y, u, v in texts[:k]:
                over = min(right, u) - max(left, x), min(bottom, v) - max(top, y)
                assert min(over) <= 3, drive  # letters do not fill their boxes


def test_arrows_of_forces_stay_in_the_picture(tab, server):
    """They go out from fixed pivots, which lie at its edges; the linkage is as large as without them."""
    page = tab(width=1440, height=900).open(server.address)
    before = page.page.evaluate("gruebler.motion.stage.viewport.scale")
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    stage = page.page.locator(".stage").bounding_box()
    for drive in range(0, 360, 10):
        page.page.evaluate(f"gruebler.motion.transport.pick({math.radians(drive)})")
        places = [float(one) for one in re.findall(r"[-\d.]+", page.page.evaluate(ARROWS))]
        assert 0 < min(places[::2]) <= max(places[::2]) < stage["width"]
        assert 0 < min(places[1::2]) <= max(places[1::2]) < stage["height"]
    assert page.page.evaluate("gruebler.motion.stage.viewport.scale") == before


@pytest.mark.parametrize("width", [1440, 390])
def test_the_picture_shows_the_whole_of_a_free_motion(tab, server, width):
    """The bucket of the excavator left it, as the stick went where its cylinders do not drive it."""
    page = tab(width=width, height=900, touch=width < 500).open(server.address).machine("excavator")
    scale = "gruebler.motion.stage.viewport.scale"
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    for drive in (250, 276, 321, 300):  # each arrow has the sign with which it is listed
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        told = page.page.locator(".stage text[data-arrow]").all_text_contents()
        assert page.page.evaluate(ARROWS).count("L") / 3 >= len(told) == len(set(told)) >= 8, drive
        assert sorted(re.sub("F[₀-₉]+", "", one) for one in told)[:-1] == [""] * (len(told) - 1), drive
    release = panel.locator('[data-act="fall"]')
    release.scroll_into_view_if_needed()
    page.page.wait_for_timeout(200)
    before, listed = release.bounding_box()["y"], panel.locator(".listed")
    assert before > listed.bounding_box()["y"]  # what the drive does comes first
    assert release.inner_text() == "Release the drives"  # all three
    release.click()
    page.page.locator('[data-act="end"]').wait_for()
    assert release.inner_text() == "Release again"
    assert release.bounding_box()["y"] < listed.bounding_box()["y"]  # while it falls, how it does
    # it is played slower, the drive later as fast as before
    speed = page.page.evaluate("gruebler.motion.transport.speed")
    page.page.get_by_label("Speed", exact=True).fill("0.5")
    assert page.page.locator(".speed").inner_text() == "×\u20090.5"
    assert page.page.evaluate("gruebler.motion.transport.speed") == speed
    # a force that stays below a tenth of the usual unit has a smaller one
    most = [
        re.search(r"max\. (\S+) k?N", " ".join(one.split())) for one in panel.locator(".listed dd").all_inner_texts()
    ]
    assert all(float(one[1].replace(",", "")) >= 0.1 for one in most)
    page.page.locator("button.play").click()
    for key in ("Home", "End"):
        page.page.locator(".track").press(key)
        stage = page.page.locator(".stage").bounding_box()
        for pin in page.page.locator(".stage .pin .joint, .stage .coupler-point .dot").all():
            box = pin.bounding_box()
            assert stage["x"] < box["x"] < box["x"] + box["width"] < stage["x"] + stage["width"]
            assert stage["y"] < box["y"] < box["y"] + box["height"] < stage["y"] + stage["height"]
    assert page.page.evaluate("gruebler.motion.linkage.cycle.rows.order") == 0  # curves are those of the fall
    during = page.page.evaluate(scale)
    page.page.locator('[data-act="end"]').click()
    page.until(f"{scale} !== {during}")
    assert page.page.evaluate("gruebler.motion.linkage.cycle.rows.order") > 0
    assert abs(release.bounding_box()["y"] - before) < 20  # what was read before is in sight again


def test_guides_stay_as_long_in_a_free_motion(tab, server):
    """Pistons of a compressor that is let go swing about their lowest place; their cylinders are no shorter for it."""
    page = tab().open(server.address).machine("vcomp")
    longest = """() => {
        const rails = [...gruebler.root.querySelectorAll(".ground .rail")];
        return Math.max(...rails.map((rail) => rail.getTotalLength())) / gruebler.motion.stage.viewport.scale;
    }"""
    before = page.page.evaluate(longest)
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="fall"]').click()
    page.page.locator('[data-act="end"]').wait_for()
    assert page.page.evaluate(longest) == pytest.approx(before, rel=1e-3)
    page.page.locator('[data-act="end"]').click()
    # an answer that comes after another machine was opened is given up
    page.hold()
    page.page.locator(f'{PANEL} [data-act="fall"]').click()
    page.until("held.some((one) => one.method === 'fall')")
    page.page.evaluate(
        """() => {
            [window.asked, window.said] = [held.find((one) => one.method === "fall"), false];
            delete gruebler.model.send;
            gruebler.model.on("msg:custom", (one) => { said ||= one.id === asked.id && !!one.result; });
        }"""
    )
    page.machine("crankrocker")
    page.page.evaluate("gruebler.model.send(asked)")
    page.until("said")
    assert not page.page.locator('[data-act="end"]').count()


def test_without_the_library_it_says_so(tab, tmp_path):
    from gruebler.cli import main

    path = tmp_path / "page.html"
    assert main(["explore", "crankrocker", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    page.page.locator(f"{PANEL} summary").first.click()
    assert page.page.locator(f"{PANEL} .note").inner_text().endswith("gruebler explore crankrocker")


def test_loads_of_the_catalog_are_rows_of_which_each_can_be_taken_away():
    """As the library has them without the force that was chosen away; opening them changes no document."""
    entry = entries()["vcomp"]
    question = asked(entry.linkage(), source="vcomp")
    told = answer("forces", question, "de", print)
    assert [(one["on"], one["number"], one["known"]) for one in told["loads"]] == [("joint", 2, 0), ("joint", 3, 1)]
    assert told["laws"][0] == "ändert sich nach einer Formel aus Geschwindigkeit und Ort"
    assert "kept" not in told
    kept = answer("forces", {**question, "loads": told["loads"][1:]}, "de", print)["kept"]["loads"]
    assert list(kept["forces"]) == ["R(conrod2-piston2)"]  # as the document has it, whatever the reader's language
    linkage, loads, speed = entry.loaded()
    loads = replace(loads, forces={"R(conrod2-piston2)": loads.forces["R(conrod2-piston2)"]})
    again = answer("forces", {**question, "document": {**question["document"], "loads": kept}}, "de", print)
    wanted = inverse_dynamics(move(linkage, again["drives"], speed=speed, order=2), loads).drive[:, 0] / 1000
    assert again["effort"] == pytest.approx(wanted.tolist(), abs=1e-6 * abs(wanted).max())


def test_acting_loads_are_told_for_each_pose():
    """A constant force, one by a formula of the drive, and a moment, each where it acts."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (40, 30)})
    document = linkage_to_json(linkage) | {
        "loads": {
            "forces": {"K": ["0 N", {"formula": "-20*cos(drive)", "unit": "N"}], "rocker:10,0": ["3 N", "0 N"]},
            "moments": {"rocker": "2 N m"},
        }
    }
    told = answer("forces", {"document": document, "drives": [0.0]}, "en", print)
    formula, constant, moment = told["acting"]
    assert formula["at"] == [2, 40, 30]
    assert formula["parts"][1] == pytest.approx([-20 * math.cos(drive) for drive in told["drives"]], abs=1e-5)
    assert (constant["at"], set(constant["parts"][0])) == ([3, 10, 0], {3})
    assert (moment["at"], {round(one, 9) for one in moment["parts"][0]}) == ([3, 20, 0], {2})
    rows = [(one["on"], one["number"], one["x"], one["known"]) for one in told["loads"]]
    assert rows == [("point", 0, 0, 0), ("place", 1, 3, None), ("link", 3, pytest.approx(2), None)]
    assert [told["laws"][k] for k in (0, 1)] == ["changes by a formula of drive", ""]
    again = answer("forces", {"document": document, "drives": [0.0], "loads": told["loads"]}, "en", print)
    assert again["effort"] == told["effort"]
    # the force of the formula on the other side of the coupler
    moved = [{**told["loads"][0], "on": "joint", "number": 2}, *told["loads"][1:]]
    forces = answer("forces", {"document": document, "drives": [0.0], "loads": moved}, "en", print)["kept"]["loads"]
    assert forces["forces"]["R(coupler-rocker)"][1] == {"formula": "-20*cos(drive)", "unit": "N"}


def test_typed_masses_lie_along_their_bars_however_long_these_are():
    """A bar has its centre in the middle and m l²/12; that of a file stays where it is, and so does its radius."""
    short, long = FourBar(25, 70, 40, 70).linkage(), FourBar(25, 80, 40, 70).linkage()
    kept = answer("forces", asked(short, masses=[0, 0, 0.6, 0]), "en", print)["kept"]
    assert kept["bars"] == [2]
    document = linkage_to_json(long) | {"loads": kept["loads"]}
    body = answer("forces", {"document": document, "drives": [0.0], "bars": [2]}, "en", print)["kept"]["loads"][
        "bodies"
    ]
    assert body == {"coupler": {"mass": "0.6 kg", "centre": [40, 0], "inertia": "320.0 kg mm2"}}
    document["loads"]["bodies"] = {"coupler": {"mass": "2 kg", "centre": [10, 5], "inertia": "400 kg mm2"}}
    told = answer("forces", {"document": document, "drives": [0.0], "masses": [0, 0, 1, 0]}, "en", print)["kept"]
    assert told["loads"]["bodies"]["coupler"] == {"mass": "1.0 kg", "centre": [10, 5], "inertia": "200.0 kg mm2"}
    assert told["bars"] == []


LOADS = "JSON.stringify(gruebler.motion.linkage.loads ?? null)"


def test_loads_are_kept_in_the_document_and_undone(tab, server, tmp_path):
    """A force on a coupler point, a mass and a spring are in the saved file, for the command line and for the page."""
    from gruebler.files.linkages import read_loaded

    tab_ = tab().open(server.address)
    page = tab_.page
    page.locator('[data-panel="points"] summary').click()
    page.locator('[data-act="add-point"]').click()
    panel = page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator(".words summary").first.click()
    panel.locator("#force-mass-2").wait_for()
    assert page.evaluate(LOADS) == "null"

    def typed(key, value, says):
        page.locator(f"#force-{key}").fill(value)
        page.locator(f"#force-{key}").press("Tab")
        tab_.until(f"{LOADS}.includes({says!r})", 60)

    page.locator("#force-load-0").select_option("point 0")
    typed("y-0", "-100", "-100.0 N")
    typed("mass-2", "0.25", "0.25 kg")
    page.locator("#spring-0").select_option(label="straight")
    tab_.until(f"{LOADS}.includes('between')", 60)
    typed("stiffness-0", "2", "2.0 N/mm")
    page.evaluate("gruebler.motion.transport.pick(1)")
    read = page.evaluate(READ)
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save").click()
        page.locator('[data-panel="export"] button').get_by_text("JSON", exact=True).click()
    file = tmp_path / "loaded.json"
    saved.value.save_as(file)
    linkage, loads, speed = read_loaded(file)
    assert (loads.forces, loads.bodies["coupler"].mass, len(loads.springs)) == ({"K1": (0.0, -100.0)}, 0.25, 1)
    assert speed is None  # nobody chose one: a turn a second
    effort = inverse_dynamics(move(linkage, [1.0], speed=2 * math.pi, order=2), loads).drive[0, 0] / 1000
    assert float(read.replace("\N{MINUS SIGN}", "-")) == pytest.approx(effort, rel=2e-3)

    other = tab().open(server.address)
    other.page.locator("header input[type=file]").set_input_files(file)
    other.until(f"{LOADS}.includes('K1')")
    other.page.evaluate("gruebler.motion.transport.pick(1)")  # what is opened moves
    other.page.locator(f"{PANEL} summary").first.click()
    other.until(f"{READ} === {read!r}", 60)
    assert other.page.locator("#force-mass-2").input_value() == "0.25"

    page.keyboard.press("Escape")
    undo, redo = (page.get_by_role("button", name=name) for name in ("Undo", "Redo"))
    while "K1" in page.evaluate(LOADS):
        undo.click()
    assert page.evaluate("gruebler.motion.linkage.sizes.points.length") == 1  # that was before
    tab_.until(
        f"{ROOT}.querySelector('#force-load-0').value === '' && {ROOT}.querySelector('#force-mass-2').value === ''"
    )
    redo.click()
    redo.click()
    tab_.until(f"{ROOT}.querySelector('#force-y-0')?.value === '\N{MINUS SIGN}100'", 60)


def test_what_was_typed_just_before_is_saved(tab, server):
    """By keys from the field itself, and by the button."""
    page = tab().open(server.address)
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    panel.locator(".words summary").click()
    page.page.locator("#force-mass-1").fill("0.5")
    with page.page.expect_download() as saved:
        page.page.locator("#force-mass-1").press("Control+s")
    assert json.loads(Path(saved.value.path()).read_text())["loads"]["bodies"]["crank"]["mass"] == "0.5 kg"
    page.page.locator("#force-mass-1").fill("0.75")
    page.page.click('[data-icon="save"]')
    with page.page.expect_download() as saved:
        page.page.get_by_role("button", name="JSON", exact=True).click()
    assert json.loads(Path(saved.value.path()).read_text())["loads"]["bodies"]["crank"]["mass"] == "0.75 kg"


def test_what_was_typed_just_before_the_page_is_loaded_again_is_kept(tab, server):
    """Left at once, and still in its field."""
    page = tab().open(server.address)
    panel = page.page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator('[data-act="assume"]').click()
    panel.locator(".plot.polar").wait_for()
    panel.locator(".words summary").click()
    mass = "gruebler.motion?.linkage.loads?.bodies?.{}?.mass"
    page.until(mass.format("crank"))
    page.until("gruebler.hash && location.hash === gruebler.hash")
    page.page.locator("#force-mass-1").fill("0.5")
    page.page.locator("#force-mass-1").press("Tab")
    page.page.locator("#force-mass-2").fill("0.25")
    page.page.reload()
    kept = mass.replace("gruebler", "window.gruebler?", 1)
    assert page.until(f"{kept.format('crank')} === '0.5 kg' && {kept.format('coupler')}") == "0.25 kg"


def test_loads_are_drawn_where_they_act_and_go_with_the_point(tab, server):
    tab_ = tab().open(server.address)
    page = tab_.page
    page.evaluate("gruebler.motion.transport.pick(1)")
    page.locator('[data-panel="points"] summary').click()
    page.locator('[data-act="add-point"]').click()
    panel = page.locator(PANEL)
    panel.locator("summary").first.click()
    panel.locator(".words summary").first.click()
    page.locator("#force-load-0").select_option("point 0")
    page.locator("#force-y-0").fill("-100")
    page.locator("#force-y-0").press("Tab")
    drawn = f"{ROOT}.querySelector('.stage path.load').getAttribute('d')"
    (path,) = re.findall(r"M([^ML]+) ([^ML]+)L([^ML]+) ([^ML]+)M", tab_.until(drawn))
    x, y, u, v = map(float, path)
    mark = page.locator(".stage .coupler-point .dot").bounding_box()
    stage = page.locator(".stage").bounding_box()
    assert (x + stage["x"], y + stage["y"]) == pytest.approx(
        (mark["x"] + mark["width"] / 2, mark["y"] + mark["height"] / 2), abs=1
    )
    assert (u, v > y) == (x, True)  # downward
    said = page.locator(".stage text[data-arrow]").all_text_contents()
    assert "100 N" in said
    assert len(said) >= 4  # joint forces have theirs, too
    # a moment turns counter-clockwise if it is positive: its arc has the flag 0
    page.locator("#force-load-1").select_option("link 3")
    page.locator("#force-x-1").fill("2")
    page.locator("#force-x-1").press("Tab")
    assert re.search(r"A\S+ \S+ 0 1 0 ", tab_.until(f"{drawn}.includes('A') && {drawn}"))
    page.locator("#force-x-1").fill("-2")
    page.locator("#force-x-1").press("Tab")
    tab_.until(f"/A\\S+ \\S+ 0 1 1 /.test({drawn})")
    # what acts on a point is called as the point is, and stays where it was when that is gone
    name = page.locator('[data-field="point-name-0"]')
    name.fill("Tip")
    name.press("Enter")
    tab_.until(f"{LOADS}.includes('Tip')")
    page.locator('[data-panel="points"] .point-row button').click()
    tab_.until(f"{LOADS}.includes('coupler:')")
    tab_.until(f"{ROOT}.querySelector('#force-load-0').selectedOptions[0].textContent.startsWith('coupler:')", 60)
    assert page.locator("#force-y-0").input_value() == "\N{MINUS SIGN}100"


def test_the_law_of_a_load_stands_below_its_row(tab, tmp_path):
    """As wide as all columns: in one of them it would take their room from the labels."""
    from tests.page.conftest import Server

    running = Server(tmp_path, "vcomp")
    try:
        page = tab().open(running.address).page
        page.locator(f"{PANEL} summary").first.click()
        page.locator(f"{PANEL} .words summary").first.click()
        law = page.locator(f"{PANEL} .rows .note").nth(1)  # below the heading of the masses
        law.wait_for()
        assert law.inner_text() == "changes by a formula of velocity and position"
        rows = page.locator(f"{PANEL} .words .rows").bounding_box()
        assert law.bounding_box()["width"] == pytest.approx(rows["width"], abs=1)
    finally:
        running.kill()
