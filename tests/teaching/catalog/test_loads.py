"""Loads of catalog entries: what their numbers come to, by hand, and by two methods for each of them."""

import math

import msgspec
import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import CatalogError
from gruebler.files.catalog_records import entry_of_data
from gruebler.teaching.catalog import entries, entry

LOADED = sorted(id for id, record in entries().items() if record.loads is not None)
TURN = gr.from_degrees(0, 360, 0.5)[:-1]


def run_of(id, drives=TURN):
    linkage, loads, speed = entry(id).loaded()
    return gr.inverse_dynamics(gr.move(linkage, drives, speed=speed), loads)


def work_of_a_turn(run):
    """The mean torque times 2 pi."""
    return run.drive.mean() * 2 * math.pi


@pytest.mark.parametrize("id", LOADED)
def test_two_methods_agree(id):
    record = entry(id)
    linkage, loads, speed = record.loaded()
    if id == "lamp":
        drives, speed = np.radians([[70, 130], [100, 70]]), [1.0, -2.0]
    else:
        drives = np.radians(np.linspace(*(record.dimensions.range or (0, 360)), 9)[1:-1])
    motion = gr.move(linkage, drives, speed=speed or 1.0)
    assert motion.complete
    assert loads.bodies
    assert gr.inverse_dynamics(motion, loads).disagreement < 1e-10
    german, again, _ = record.in_language("de").loaded()
    assert list(again.bodies.values()) == list(loads.bodies.values())
    assert set(again.bodies) < set(german.mechanism.chain.links)


def test_the_work_of_the_compressor():
    """An ideal compressor with clearance: W = n/(n - 1) p1 (V1 - V4) ((p2/p1)^((n - 1)/n) - 1)."""
    drawn_in = 63 - 3 * 7 ** (1 / 1.3)
    work = 1.3 / 0.3 * 282.7 * drawn_in * (7 ** (0.3 / 1.3) - 1)
    assert work_of_a_turn(run_of("compressor")) == pytest.approx(work, rel=2e-4)
    assert work_of_a_turn(run_of("vcomp")) == pytest.approx(2 * work, rel=2e-4)


def test_machines_start_from_rest_at_half_of_what_turns_with_their_sense():
    """By hand, crank upright: the mean of both lines of the diagram pushes the piston out; no weight has a lever."""
    linkage, loads, _ = entry("compressor").loaded()
    run = gr.simulate(linkage, loads, at=math.pi / 2, until=0.02, times=[0.0, 0.02])
    assert run.complete
    assert run.defect < 1e-8
    pin = math.sqrt(100**2 - 30**2)
    pressure = ((63 / (133 - pin)) ** 1.3 + 1) / 2 - 1  # on its way in and out, less that of the air
    inertia = 2600 + 2.5 * 8**2 + 0.35 * 30**2 + 0.4 * 30**2  # rod and piston only shift, 30 mm a radian
    assert run.accelerations[0, 0] == pytest.approx(1000 * 282.7 * pressure * 30 / inertia, rel=1e-12)
    for id in ("vcomp", "pumpjack", "filmclaw"):
        linkage, loads, _ = entry(id).loaded()
        assert gr.simulate(linkage, loads, at=1.0, until=0.02, times=[0.02]).complete


def test_the_vee_is_balanced_in_the_first_order():
    """Only the second order is left, level: sqrt 2 m r w² (s + s³/4 + 15 s⁵/128 + ...), s = r/l."""
    run = run_of("vcomp")
    x, y = (np.abs(np.fft.rfft(force)) / (len(force) / 2) for force in run.shaking_force.T)
    mass, speed, ratio = 0.395 + 0.35 * 0.3, 1450 * math.pi / 30, 30 / 110
    second = ratio + ratio**3 / 4 + 15 * ratio**5 / 128 + 35 * ratio**7 / 512
    expected = math.sqrt(2) * mass * 0.03 * speed**2 * second
    assert x[2] == pytest.approx(expected, rel=1e-4)
    assert max(x[1], y[1], y[2]) < 1e-9 * expected


def test_the_work_of_the_pumpjack_and_of_the_film_claw():
    """Weights give back what they take: what is left is the fluid, or the film, times its way."""
    for id, point, force in (("pumpjack", "C", 10_000.0), ("filmclaw", "tip", 0.8)):
        run = run_of(id)
        way = np.ptp(run.motion.point(point)[:, 1])
        assert work_of_a_turn(run) == pytest.approx(force * way, rel=1e-3)


def test_the_counterweight_of_the_pumpjack_halves_the_torque():
    linkage, loads, speed = entry("pumpjack").loaded()
    light = gr.Loads(loads.forces, bodies={link: body for link, body in loads.bodies.items() if link != "crank"})
    motion = gr.move(linkage, TURN, speed=speed)
    with_it, without = (gr.inverse_dynamics(motion, each) for each in (loads, light))
    weight = 3000 * 9.80665 * 18 * np.cos(TURN)  # N dm, of a weight on a crank at constant speed
    np.testing.assert_allclose(with_it.drive[:, 0] - without.drive[:, 0], weight, atol=1e-6 * without.peak[0])
    assert with_it.peak[0] < 0.6 * without.peak[0]


def test_the_wiper_rubs():
    """6 N over the way of the blade, which is guided on circles: radius 121.66 mm, 59.1 degrees to and fro."""
    way = 2 * math.radians(59.1) * math.hypot(20, 120)
    assert 0.95 < work_of_a_turn(run_of("wiper")) / (6 * way) < 1


def test_the_garage_door_stays_everywhere():
    """Weight: (36 + 4/2) · 110 kg cm; a spring without free length: k h r. Both times the cosine of the lever."""
    linkage, loads, _ = entry("garage_rail").loaded()
    (spring,) = loads.springs
    assert spring.stiffness * 76 * 55 == pytest.approx((36 * 110 + 4 * 55) * 9.80665, rel=1e-14)
    assert gr.equilibria(linkage, loads, at=math.radians(-40)).everywhere
    rest = gr.simulate(linkage, loads, at=math.radians(-40), until=1.0, times=[0.0, 0.5, 1.0])
    assert abs(rest.drives[-1, 0] - rest.drives[0, 0]) < 1e-9
    assert rest.defect == 0  # what is rounded of 400 J is no part of what is exchanged


def test_the_springs_hold_the_lamp_to_a_hundredth():
    """By hand for each arm alone, q level: (g C - k h p (1 - s/l)) cos q, l² = h² + p² - 2 h p sin q, s = 4 mm.

    The drive of the upper arm counts from the line down to the lower one.
    """
    linkage, loads, _ = entry("lamp").loaded()
    lower, upper = (np.radians(np.linspace(*ends, 19)) for ends in ((60, 150), (-40, 60)))
    held = gr.statics(gr.move(linkage, np.stack([lower, upper + np.pi / 2], axis=1)), loads).drive.T
    for effort, q, carried, height, spring in zip(
        held, (lower, upper), (0.670 * 250, 0.430 * 250), (50, 40), loads.springs, strict=True
    ):
        assert spring.free_length - spring.preload / spring.stiffness == pytest.approx(4)
        length = np.sqrt(height**2 + 100**2 - 200 * height * np.sin(q))
        pulled = spring.stiffness * height * 100 * (1 - 4 / length)
        expected = (9.80665 * carried - pulled) * np.cos(q)
        np.testing.assert_allclose(effort, expected, atol=1e-9)
        assert np.abs(effort).max() < 0.01 * (9.80665 * carried * np.abs(np.cos(q)).max())


def test_the_hood_stays_shut_and_opens_by_itself():
    """Virtual work from points alone: gas force · change of its length = weight · change of its height."""
    linkage, loads, _ = entry("hood").loaded()
    (spring,) = loads.springs
    low, high = (math.radians(value) for value in entry("hood").dimensions.range)

    def surplus(drive):
        """Of the gas spring over the weight, when the drive falls: the hood opens."""
        motion = gr.move(linkage, [drive + 1e-5, drive, drive - 1e-5])
        length = np.hypot(*(motion.point("hood:25,-4") - [55, -40]).T)
        height = (motion.point("E")[:, 1] + motion.point("F")[:, 1]) / 2
        gas = 335 / (1 - (75 - length[1]) * (1 - 1 / 1.25) / 28)
        return float(gas * (length[2] - length[0]) - 16 * 9.80665 * (height[2] - height[0]))

    assert spring.damping > 0
    assert surplus(high) < 0 < surplus(low)
    (rest,) = (each for each in gr.equilibria(linkage, loads, at=math.radians(130)) if not each.stable)
    assert low < rest.drives[0] < high  # the stable one lies behind the end of the range
    assert surplus(rest.drives[0] + 1e-3) < 0 < surplus(rest.drives[0] - 1e-3)


@pytest.mark.slow
def test_the_treadle_turns_the_flywheel():
    """Over a turn the foot gives 4 N m times the swing, the machine takes 0.05 N m s w 2 pi."""
    linkage, loads, _ = entry("sewing").loaded()
    run = gr.simulate(linkage, loads, until=12, branch="+", at=math.radians(85), speed=-1.0, tolerance=1e-7)
    assert run.complete
    late = run.times > 8
    swing = np.ptp(run.drives[late])
    speed = 4 * swing / (0.05 * 2 * math.pi)
    assert abs(run.angular("crank")[late].mean()) == pytest.approx(speed, rel=0.05)


def test_loads_say_where_they_come_from():
    data = {key: value for key, value in msgspec.to_builtins(entry("compressor")).items() if key != "loads"}
    masses = {"bodies": {"crank": {"mass": "2 kg"}}}
    assert entry_of_data(data | {"loads": masses | {"assumed": True}}, "x").loaded()[1].bodies["crank"].mass == 2
    for loads, words in (
        (masses, "x: loads: either assumed = true, or a source that prints them"),
        (masses | {"assumed": True, "speed": "3 mm"}, "loads.speed"),
        ({"assumed": True, "bodies": {"crnk": {"mass": "2 kg"}}}, "crnk"),
    ):
        with pytest.raises(CatalogError, match=words):
            entry_of_data(data | {"loads": loads}, "x")
    with pytest.raises(CatalogError, match="has no loads"):
        entry("lambda").loaded()
