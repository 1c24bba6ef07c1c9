"""Loads in files of linkages: what the table means, that nothing is lost, and that what does not fit is refused."""

import json
import math
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.files import loads_from_json, loads_to_json, read_loads
from gruebler.files.linkages import linkage_to_toml, read_linkage, read_loaded, write_linkage
from gruebler.mechanics.forces import Curve, Gas, LoadFormula, Loads, Motor, RigidBody, Spring, TorsionSpring
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.linkages import LinkPoint
from gruebler.structure.mechanism import Mechanism

FOUR_BAR = FourBar(25, 70, 40, 70).linkage()
DRIVE = "R(frame-crank)"
FILE = """
unit = "mm"
four_bar = { a = 25, b = 70, c = 40, d = 70 }

[loads]
gravity = ["0 m/s2", "-1000 cm/s2"]
springs = [{ between = ["frame:0,40", "R(crank-coupler)"], stiffness = "2 kN/m", preload = "0.5 daN" }]
torsion_springs = [{ between = ["frame", "rocker"], stiffness = "5 N m/rad", free_angle = 90, damping = "0.2 N m s" }]

[loads.bodies]
crank = { mass = "200 g", bar = [[0, 0], [30, 0]] }
coupler = { plate = [[0, 0], [30, 0], [30, 20], [0, 20]], thickness = 10, density = "7.85 g/cm3" }
rocker = { mass = "2 kg", centre = [30, 0], about = [0, 0], inertia = "24 kg cm2" }

[loads.masses]
"coupler:35,10" = "500 g"

[loads.forces]
"R(coupler-rocker)" = [{ formula = "-2*where(vx < 0, 1, 0)", unit = "kN" }, "-3 N"]

[loads.moments]
rocker = { curve = [[0, 0], [3, 1.5]], of = "drive", unit = "N m" }

[loads.motors]
"R(frame-crank)" = { stall = "12 N m", idle_speed = "600 rpm" }
"""


def test_a_file_means_what_its_units_say(tmp_path):
    path = tmp_path / "press.toml"
    path.write_text(FILE)
    assert read_linkage(path) == FOUR_BAR
    loads = read_loads(path)
    assert loads.gravity == (0.0, -10.0)
    assert loads.bodies["crank"] == RigidBody(0.2, (15.0, 0.0), 15.0)  # m l²/12 = 0.2 · 900 / 12
    assert loads.bodies["coupler"].mass == pytest.approx(0.0471, rel=1e-14)  # 7850 · 0.03 · 0.02 · 0.01
    assert loads.bodies["coupler"].inertia == pytest.approx(0.0471 * (30**2 + 20**2) / 12, rel=1e-13)
    assert loads.bodies["rocker"] == RigidBody(2.0, (30.0, 0.0), 600.0)  # 2400 - 2 · 30²
    assert loads.masses == {"coupler:35,10": 0.5}
    across, down = loads.forces["R(coupler-rocker)"]
    assert (across.text, down) == ("1000.0*(-2*where(vx < 0, 1, 0))", -3.0)
    assert loads.moments == {"rocker": Curve([(0, 0), (3, 1500)])}
    assert loads.springs == (Spring(("frame:0,40", "R(crank-coupler)"), stiffness=2.0, preload=5.0),)
    assert loads.torsion_springs == (
        TorsionSpring(("frame", "rocker"), stiffness=5000.0, free_angle=math.pi / 2, damping=200.0),
    )
    assert loads.motors[DRIVE].stall == 12000.0
    assert loads.motors[DRIVE].idle_speed == pytest.approx(20 * math.pi, rel=1e-14)


def test_bodies_of_a_drawing_lie_in_it(tmp_path):
    drawing = """
unit = "mm"
joints = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker)"
frame = "frame"
drives = ["R(frame-crank)"]
places."R(frame-crank)" = [10, 5]
places."R(crank-coupler)" = [10, 35]
places."R(coupler-rocker)" = [90, 65]
places."R(frame-rocker)" = [90, 5]
points.C = { link = "coupler", at = [40, 60] }

[loads.bodies]
frame = { mass = "9 kg", centre = [50, 0] }
crank = { mass = "3 kg", bar = [[10, 5], [10, 35]] }
coupler = { mass = "2 kg", centre = [40, 60], about = [10, 35], inertia = "40 kg cm2" }
rocker = { mass = "1 kg" }
"""
    drawn, written = tmp_path / "drawn.toml", tmp_path / "written.toml"
    drawn.write_text(drawing)
    linkage, loads, _ = read_loaded(drawn)
    poses = linkage.reference_pose
    where = {link: poses[link].put(*body.centre) for link, body in loads.bodies.items()}
    assert where["frame"] == (50, 0)
    assert where["crank"] == pytest.approx((10, 20))
    assert loads.bodies["crank"].inertia == pytest.approx(3 * 30**2 / 12)
    assert loads.bodies["coupler"].centre == pytest.approx((linkage.points["C"].x, linkage.points["C"].y))
    assert loads.bodies["coupler"].inertia == pytest.approx(4000 - 2 * (30**2 + 25**2))
    assert loads.bodies["rocker"].centre == pytest.approx((0, 0))  # without a centre: where the link's axes begin
    write_linkage(written, linkage, loads)
    assert read_loaded(written)[:2] == (linkage, loads)


number = st.floats(-1e6, 1e6)
size = st.floats(0, 1e6)
positive = st.floats(1e-6, 1e6)
place = st.tuples(number, number)
curve = st.builds(
    Curve,
    st.lists(place, min_size=2, max_size=4, unique_by=lambda pair: pair[0]).map(sorted),
    st.sampled_from(["drive", "time", "vx"]),
)
amount = number | curve | st.sampled_from(["2*drive + time", "-200*where(vx < 0, 1, 0)"]).map(LoadFormula)
gas = st.builds(lambda f, s, g: Gas(force=f, extended=2 * s, stroke=s, growth=g), positive, positive, st.floats(1.1, 2))
point = st.sampled_from(["R(crank-coupler)", "coupler:3.5,-1", "frame:0,40"])
links = st.sampled_from(["crank", "coupler", "rocker"])
everything = st.builds(
    Loads,
    st.dictionaries(point, st.tuples(amount, amount)),
    moments=st.dictionaries(links, amount),
    masses=st.dictionaries(point, size),
    gravity=place,
    bodies=st.dictionaries(links, st.builds(RigidBody, size, place, size)),
    springs=st.lists(
        st.builds(
            Spring,
            st.sampled_from([("frame:0,40", "R(crank-coupler)"), ("coupler:3.5,-1", "frame:0,40")]),
            stiffness=size,
            free_length=size,
            preload=number,
            damping=size,
            law=st.none() | gas | st.builds(Curve, st.just([(1, 0), (2, 3.1)]), st.just("drive")),
        ),
        max_size=2,
    ),
    torsion_springs=st.lists(
        st.builds(
            TorsionSpring,
            st.lists(links, min_size=2, max_size=2, unique=True).map(tuple),
            stiffness=size,
            free_angle=number,
            preload=number,
            damping=size,
        ),
        max_size=2,
    ),
    motors=st.dictionaries(st.just(DRIVE), st.builds(Motor, positive, positive) | curve),
)


@given(loads=everything, unit=st.sampled_from(["mm", "cm", "m", "in", "ft"]))
def test_nothing_is_lost(loads, unit):
    linkage = FourBar(25, 70, 40, 70).linkage(unit=unit)
    assert loads_from_json(json.loads(json.dumps(loads_to_json(loads, linkage))), linkage) == loads
    assert loads_from_json(tomllib.loads(linkage_to_toml(linkage, loads))["loads"], linkage) == loads


@pytest.mark.parametrize("name", ["a.toml", "a.json"])
def test_written_with_the_linkage(tmp_path, name):
    loads = Loads(
        {LinkPoint("coupler", 1.5, 2.0): (1.0, "2*time")}, bodies={"crank": RigidBody(0.1, (1, 2), 0.1 + 0.2)}
    )
    write_linkage(tmp_path / name, FOUR_BAR, loads)
    again = read_loads(tmp_path / name)
    assert read_linkage(tmp_path / name) == FOUR_BAR
    assert again.forces == {"coupler:1.5,2.0": (1.0, LoadFormula("2*time"))}
    assert again.bodies == loads.bodies


def test_a_driven_slide_has_forces_and_velocities():
    slide = SliderCrank(20, 60).linkage()
    driven = slide.with_mechanism(Mechanism(slide.mechanism.chain, "frame", ["P(frame-slider)"]))
    table = {"motors": {"P(frame-slider)": {"stall": "0.2 kN", "idle_speed": "0.5 m/s"}}}
    loads = loads_from_json(table, driven)
    assert loads.motors["P(frame-slider)"] == Motor(200.0, 500.0)
    assert loads_from_json(loads_to_json(loads, driven), driven) == loads


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        (
            {"bodies": {"crank": {"mass": 5}}},
            "loads.bodies.crank.mass: expected a number with its unit such as",
        ),
        ({"bodies": {"crank": {"mass": "5 N"}}}, "loads.bodies.crank.mass: '5 N' has the unit of another quantity"),
        ({"bodies": {"crank": {"mass": "-5 kg"}}}, "loads.bodies.crank: the mass must be a finite number that is not"),
        ({"bodies": {"crank": {"centre": [1, 2]}}}, "loads.bodies.crank.mass: missing"),
        (
            {"bodies": {"krank": {"mass": "5 kg"}}},
            "the chain has no link 'krank' (did you mean 'crank'?)",
        ),
        ({"bodies": {"crank": {"mas": "5 kg"}}}, "unknown key 'loads.bodies.crank.mas'; did you mean 'mass'?"),
        (
            {"bodies": {"crank": {"mass": "2 kg", "centre": [30, 0], "about": [0, 0], "inertia": "1799 kg mm2"}}},
            "loads.bodies.crank: about (0, 0) the moment of inertia is at least mass times distance squared, 1800",
        ),
        ({"bodies": {"crank": {"disc": 3, "bar": []}}}, "loads.bodies.crank: bar and disc exclude each other"),
        (
            {"bodies": {"crank": {"disc": 3, "inertia": "1 kg mm2"}}},
            "loads.bodies.crank.inertia: does not go with",
        ),
        ({"forces": {"nowhere": ["1 N", "2 N"]}}, "loads.forces: "),
        ({"forces": {"R(crank-coupler)": "1 N"}}, "expected two components"),
        ({"forces": {"R(crank-coupler)": ["1e200 N", "0 N"]}}, "expected numbers below 1e100"),
        ({"moments": {"crank": {"formula": "2*spped", "unit": "N m"}}}, "unknown name 'spped' (did you mean 'speed'?)"),
        ({"moments": {"crank": {"unit": "N m"}}}, "loads.moments.crank: expected either formula or curve"),
        (
            {"springs": [{"between": ["frame:0,0", "crank:1,0"], "free_length": -3}]},
            "loads.springs[0]: the free length",
        ),
        ({"springs": [{"between": ["frame:0,0", "crank:1,0"], "stifness": "1 N/m"}]}, "did you mean 'stiffness'?"),
        (
            {"springs": [{"between": ["frame:0,0", "crank:1,0"], "stiffness": "1"}]},
            "loads.springs[0].stiffness: ",
        ),
        (
            {"springs": [{"between": ["R(crank-coupler)", "coupler:9,0"], "damping": "1 N s/m"}]},
            "loads.springs[0]: 'R(crank-coupler)' and 'coupler:9,0' are points of one link, 'coupler'; a spring or "
            "damper is between two links",
        ),
        (
            {"springs": [{"between": [DRIVE, DRIVE], "stiffness": "1 N/mm"}]},
            f"loads.springs[0]: {DRIVE!r} and {DRIVE!r} are points of one link",
        ),
        (
            {"torsion_springs": [{"between": ["frame", "x"]}]},
            "torsion_springs[0].between: the chain has no link 'x'",
        ),
        (
            {"torsion_springs": [{"between": ["crank", "crank"], "stiffness": "1 N m/rad"}]},
            "loads.torsion_springs[0]: a torsion spring is between two links, not from 'crank' to itself",
        ),
        ({"motors": {"R(crank-coupler)": {"stall": "1 N m", "idle_speed": "1 rpm"}}}, "R(crank-coupler) is not driven"),
        ({"motors": {DRIVE: {"stall": "0 N m", "idle_speed": "1 rpm"}}}, "a motor has a positive torque at standstill"),
        (
            {"moments": {"crank": {"unit": "N m", "curve": [[0, 0], [1, 1]], "of": "time", "of_unit": "ms"}}},
            "loads.moments.crank.of_unit: goes with a curve of an angle, a length or a speed",
        ),
        (
            {"moments": {"crank": {"unit": "N m", "curve": [[0, 0], [1, 1]], "of_unit": "mm"}}},
            "loads.moments.crank.of_unit: ",
        ),
        ({"gravity": ["-9.81 m/s2"]}, "loads.gravity: expected two components"),
    ],
)
def test_what_does_not_fit_is_told_by_its_key(table, sentence):
    with pytest.raises(LinkageError) as told:
        loads_from_json(table, FOUR_BAR)
    assert sentence in str(told.value)
    assert "\n" not in str(told.value)


def test_curves_may_be_in_degrees_and_other_units():
    degrees = {"curve": [[0, 0], [90, 3], [180, 0]], "of_unit": "deg", "period": 360, "unit": "N m"}
    spring = {"between": ["frame:0,0", "crank:1,0"], "law": {"curve": [[1, 0], [2, 5]], "of_unit": "cm", "unit": "N"}}
    twisted = {"between": ["frame", "crank"], "law": {"curve": [[0, 0], [60, 7]], "of_unit": "deg", "unit": "N mm"}}
    loads = loads_from_json(
        {"moments": {"crank": degrees}, "springs": [spring], "torsion_springs": [twisted]}, FOUR_BAR
    )
    crank, law, twist = loads.moments["crank"], loads.springs[0].law, loads.torsion_springs[0].law
    assert crank.value(math.radians(45)) == pytest.approx(1500)
    assert crank.period == pytest.approx(2 * math.pi)
    assert law.value(15.0) == pytest.approx(2.5)  # mm
    assert twist.value(math.radians(30)) == pytest.approx(3.5)


@pytest.mark.parametrize(
    "loads",
    [
        Loads(moments={"crank": [1.0, 2.0]}),
        Loads(forces={"R(crank-coupler)": [[1.0, 2.0]]}),
        Loads(moments={"crank": lambda state: state.time}),
    ],
)
def test_what_a_file_cannot_hold_is_refused(loads):
    with pytest.raises(LinkageError, match="a file holds a number, a formula or a curve"):
        loads_to_json(loads, FOUR_BAR)
