"""Gear trains: Willis, differentials, torques, assembly; exact everywhere."""

import itertools
import math
from fractions import Fraction as Q
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.machines.gears import (
    GearError,
    Mesh,
    Train,
    assembly,
    balance,
    influence,
    ratio,
    read_toml,
    read_train,
    speeds,
)
from gruebler.machines.gears.assemblies import axes
from gruebler.machines.gears.messages import fraction_text
from gruebler.machines.gears.rational import Elimination, rational_echelon
from gruebler.machines.gears.train import exact_number
from gruebler.structure.enumeration.epicyclic import epicyclic_trains
from tests.machines.gears.oracles import fits, rolling, slow_echelon, slow_reduced

PLANETARY = "sun:24 planet:18 ring:-60 on arm"
teeth = st.integers(8, 90)
speed = st.fractions(-100, 100, max_denominator=60)


def differential(planets):
    return Train(
        mesh
        for k in range(planets)
        for mesh in (
            Mesh(a="sun1", b=f"planet{k}", size_a=30, size_b=17, carrier="arm"),
            Mesh(a="sun2", b=f"planet{k}", size_a=-64, size_b=17, carrier="arm"),
        )
    )


def test_a_pair_has_the_ratio_of_its_teeth():
    """Exercise 1 of the seeds: i = 2, psi = phi / 2; against each other outside, together inside."""
    assert ratio(read_train("in:20 out:40").train, "in", "out") == -2
    assert ratio(read_train("in:20 out:-40").train, "in", "out") == 2
    assert ratio(read_train("friction in:12.5 out:25").train, "in", "out") == -2
    for kind, sign in (("belt", 1), ("chain", 1), ("crossed", -1)):
        assert ratio(read_train(f"{kind} in:20 out:40").train, "in", "out") == 2 * sign


@pytest.mark.parametrize("planets", [1, 2, 3])
def test_more_planets_change_nothing(planets):
    """Reference data A3: the differential with one, two, three planets has M = 2; each further one a redundancy more.

    Reference count in the plane: 0, 1, 2 redundant constraints for 1, 2, 3 planets.
    """
    train = differential(planets)
    assert train.mobility == 2
    assert len(train.redundant) == planets - 1
    assert train.relation("sun1", "sun2", "arm") == differential(1).relation("sun1", "sun2", "arm")


@given(teeth, teeth, st.integers(91, 200), speed, speed)
def test_willis(sun, planet, ring, first, second):
    """w1 - i0 w2 = (1 - i0) wc with i0 = -z_ring / z_sun, for any two of the three driven."""
    train = read_train(f"sun:{sun} planet:{planet} ring:-{ring} on arm").train
    i0 = Q(-ring, sun)
    for drives in (("sun", "ring"), ("sun", "arm"), ("ring", "arm")):
        w = speeds(train, dict(zip(drives, (first, second), strict=True))).values
        assert w["sun"] - i0 * w["ring"] == (1 - i0) * w["arm"]
        assert sun * (w["sun"] - w["arm"]) == -planet * (w["planet"] - w["arm"])


def test_bevel_differential_is_a_mean():
    """A bevel differential with equal side gears: the case turns with the mean of both sides."""
    train = read_train("bevel left:16 star:10 right:-16 on case; pinion:11 case:43").train
    assert train.mobility == 2
    assert train.relation("left", "right", "case") == {"left": 1, "right": 1, "case": -2}
    found = speeds(train, {"left": 90, "right": -90}).values
    assert (found["case"], found["pinion"], found["star"]) == (0, 0, -144)
    twice = read_train("bevel left:16 star:10 right:-16 on case; bevel left:16 other:10 right:-16 on case").train
    assert (twice.mobility, len(twice.redundant)) == (2, 1)
    forces = balance(train, {"pinion": 430, "left": 100}, {"right": -50})
    assert forces.torques["left"] == -50
    assert sum(forces.powers.values()) == 0


@given(st.lists(st.tuples(teeth, teeth), min_size=1, max_size=6))
def test_ordinary_trains_multiply(stages):
    train = read_train("; ".join(f"s{k}:{a} s{k + 1}:{b}" for k, (a, b) in enumerate(stages))).train
    assert train.mobility == 1
    assert ratio(train, "s0", f"s{len(stages)}") == math.prod((Q(-b, a) for a, b in stages), start=Q(1))


@given(teeth, teeth, teeth, st.integers(91, 200), speed, speed)
def test_rolling_circles_agree(sun, first, second, ring, one, other):
    """Oracle: stepped planets as circles whose pitch points have equal velocities; the module follows the distance."""
    module = (sun + first) / (ring - second)
    meshes = [("sun", "planet", sun, first, "arm"), ("ring", "planet", -ring * module, second * module, "arm")]
    expected = rolling(meshes, {"sun": one, "arm": other})
    train = read_train(f"sun:{sun} planet:{first} on arm; planet:{second} ring:-{ring} on arm").train
    found = speeds(train, {"sun": one, "arm": other}).values
    for link, value in expected.items():
        assert float(found[link]) == pytest.approx(value, abs=1e-7 * (1 + abs(value)))


@given(teeth, teeth, st.integers(91, 200), speed, speed, speed)
def test_power_in_is_power_out(sun, planet, ring, first, second, torque):
    train = read_train(f"sun:{sun} planet:{planet} ring:-{ring} on arm; arm:20 out:33").train
    found = balance(train, {"sun": first, "ring": second}, {"out": torque})
    assert sum(found.powers.values()) == 0
    assert found.torques["sun"] * ring == found.torques["ring"] * sun


@given(teeth, teeth, speed)
def test_tooth_forces_give_the_same_torques(sun, planet, torque):
    """Oracle: one tooth force on the sun, the same on the ring (the planet is free), twice that on the pin."""
    train = read_train(f"sun:{sun} planet:{planet} ring:-{sun + 2 * planet} on arm").train
    force = torque / sun
    found = balance(train, {"ring": 0, "arm": 1}, {"sun": torque}).torques
    assert found["ring"] == force * (sun + 2 * planet)
    assert found["arm"] == -2 * force * (sun + planet)


@given(st.permutations(range(5)), speed, speed)
def test_the_order_of_writing_is_nothing(order, first, second):
    meshes = (*differential(2).meshes, Mesh(a="arm", b="out", size_a=20, size_b=31))
    drives = {"sun1": first, "arm": second}
    one, other = speeds(Train(meshes), drives), speeds(Train(meshes[k] for k in order), drives)
    assert one.values == other.values
    assert one.complete


@given(speed, speed, speed)
def test_seen_from_the_arm_it_is_an_ordinary_train(sun, arm, shift):
    """Turning everything, the frame too, changes no relative speed."""
    train = read_train(PLANETARY).train
    still, moved = (speeds(train, {"sun": sun + k, "arm": arm + k}).values for k in (0, shift))
    assert all(moved[link] - still[link] == shift for link in train.links)


def test_free_contradicted_and_spare_drives():
    train = read_train(f"{PLANETARY}; arm:20 out:40").train
    found = speeds(train, {"sun": 7})
    assert found.free == ("planet", "arm", "ring", "out")
    assert not found.complete
    found = speeds(train, {"sun": 7, "ring": 0, "out": 5, "arm": 2})
    assert found.values["out"] == -1
    assert [(one.link, one.wanted, one.follows) for one in found.contradictions] == [("out", 5, -1)]
    assert found.spare == ("arm",)
    locked = read_train("a:10 b:20; b:10 c:10; c:10 a:20").train
    assert locked.mobility == 0
    assert speeds(locked, {}).values == {"a": 0, "b": 0, "c": 0}
    with pytest.raises(GearError, match="stands still"):
        ratio(locked, "a", "b")


def test_a_ring_on_the_frame_is_a_held_ring():
    fixed = read_train("sun:24 planet:18 frame:-60 on arm").train
    assert fixed.mobility == 1
    assert ratio(fixed, "sun", "arm") == Q(7, 2) == 1 + Q(60, 24)


def test_a_double_ring_gear_reduces_much():
    """Wolfrom: i = (1 + z3/z1) / (1 - z3 z5 / (z2 z4)) with fixed ring 3, turning ring 4; planet wheels 2 and 5."""
    z1, z2, z3, z5, z4 = 21, 24, 69, 23, 68
    train = read_train(f"sun:{z1} planet:{z2} frame:-{z3} on arm; planet:{z5} out:-{z4} on arm").train
    assert ratio(train, "sun", "out") == (1 + Q(z3, z1)) / (1 - Q(z3 * z5, z2 * z4))


@pytest.mark.parametrize(
    "text",
    [
        PLANETARY,
        "bevel left:16 star:10 right:-16 on case; pinion:11 case:43",
        "winch drum:60 load falls=2; drum:80 spindle:20; screw spindle guide lead=-5",
        "rack pinion:18 slide pitch=6; belt pinion:12.5 out:25; chain out:17 far:31; crossed far:10 end:15",
    ],
)
def test_a_printed_train_is_read_again(text):
    train = read_train(text).train
    assert read_train(str(train)).train == train
    assert "\n" not in str(train)


def test_rack_screw_and_winch_move_in_lines():
    train = read_train("winch drum:60 load falls=2; drum:80 spindle:20; screw spindle guide lead=-5").train
    found = influence(train, ["drum"])
    assert [found[link]["drum"] for link in ("load", "spindle", "guide")] == [30, -4, 20]
    assert influence(read_train("rack pinion:18 slide module=2").train, ["pinion"])["slide"] == {"pinion": 18}
    assert influence(read_train("rack pinion:18 slide pitch=6").train, ["pinion"])["slide"] == {"pinion": 108}
    # A pinion on a car between a fixed and a moving rack: the rack goes twice as far.
    car = read_train("rack pinion:18 frame on car; rack pinion:-18 slide on car").train
    assert car.relation("car", "slide") == {"car": 2, "slide": -1}
    # A nut that turns with the spindle does not move.
    nut = read_train("screw spindle slide lead=5 on nut").train
    assert speeds(nut, {"spindle": 3, "nut": 3}).values["slide"] == 0


def test_per_radian_and_per_turn_are_not_mixed():
    """A spooling gear: the guide goes on by a lead in a turn, the rope by a radius in a radian."""
    text = "winch drum:{} load{}; drum:20 spindle:20; screw spindle guide lead=12"
    mixed, turns = read_train(text.format(60, "")).train, read_train(text.format(1, " pitch=377")).train
    assert ratio(mixed, "drum", "load") == Q(1, 60)
    for question in (
        lambda: ratio(mixed, "load", "guide"),
        lambda: mixed.relation("load", "guide"),
        lambda: speeds(mixed, {"load": 5}),
    ):
        with pytest.raises(GearError, match="give racks and winches by pitch"):
            question()
    assert ratio(turns, "load", "guide") == Q(-377, 12)
    assert speeds(turns, {"load": 377}).values["guide"] == -12
    told = read_train(text.format(60, "")).explain().splitlines()
    assert not any("load" in line and "guide" in line for line in told)


def test_a_screw_jack_lifts_by_virtual_work():
    """T = F lead / 2 pi; with a hand wheel on a worm of 1:20 it is a twentieth."""
    found = balance(read_train("screw spindle load lead=6").train, {"spindle": 1}, {"load": -1000})
    assert found.torques["spindle"] == pytest.approx(1000 * 6 / (2 * math.pi))
    assert sum(found.powers.values()) == pytest.approx(0, abs=1e-9)
    back = balance(read_train("screw spindle load lead=6").train, {"load": 6}, {"spindle": 1})
    assert back.torques["load"] == pytest.approx(-2 * math.pi / 6)
    assert sum(back.powers.values()) == pytest.approx(0, abs=1e-12)


@given(st.integers(8, 30), st.integers(8, 30), st.integers(8, 30), st.integers(31, 80), st.integers(1, 7))
def test_planets_fit_where_trying_says_so(sun, first, second, ring, number):
    train = read_train(f"sun:{sun} planet:{first} on arm; planet:{second} ring:-{ring} on arm").train
    one = assembly(train, "planet", number)
    assert one.evenly == fits(Q(sun), Q(first), Q(second), Q(ring), Q(1, number))
    assert fits(Q(sun), Q(first), Q(second), Q(ring), one.spacing)
    assert not fits(Q(sun), Q(first), Q(second), Q(ring), one.spacing / 2)


def test_planets_have_room():
    train = read_train(PLANETARY).train
    assert [n for n in range(1, 9) if assembly(train, "planet", n).evenly] == [1, 2, 3, 4, 6, 7]
    assert [n for n in range(1, 9) if assembly(train, "planet", n).clear] == [1, 2, 3, 4, 5, 6]
    assert not assembly(read_train("sun:24 planet:18 ring:-61 on arm").train, "planet", 5).coaxial


def test_texts_are_taken_back():
    text = (
        f"{PLANETARY}; belt a:7/2 sun:10; rack arm:3 slide pitch=6; screw a s lead=-2; bevel a:5 x:-6; winch x:2 rope"
    )
    meshes = read_train(text).train.meshes
    assert read_train("; ".join(map(str, meshes))).train.meshes == meshes


@pytest.mark.parametrize("mobility", [1, 2])
def test_every_enumerated_train_has_speeds(mobility):
    """Its links turn with one freedom more than relative to one of them; no two of them turn alike for all drives."""
    random = Random(5)
    trains = list(epicyclic_trains(5, mobility))
    for train in trains:
        text = str(train.chain())
        for a, b, _ in train.gears:
            teeth = random.randint(20, 40), random.choice([1, -2]) * random.randint(41, 60)
            assert f"G({a}-{b})" in text
            text = text.replace(f"G({a}-{b})", f"G({a}:{teeth[0]}-{b}:{teeth[1]})")
        reading = read_train(text)
        assert reading.train.mobility == mobility + 1
        carriers = {(mesh.a, mesh.b): mesh.carrier for mesh in reading.train.meshes}
        assert carriers == {(str(a), str(b)): str(carrier) for a, b, carrier in train.gears}
    assert len(trains) == {1: 13, 2: 7}[mobility]


def test_a_chain_with_tooth_numbers_is_the_train_of_its_wheels():
    text = "R(0-1-2) R(0-3) G(1:24-3:18) G(2:-60-3:18); hold 2; 1=1000"
    reading = read_train(text)
    assert reading.train.meshes == read_train("1:24 3:18 on 0; 2:-60 3:18 on 0").train.meshes
    assert speeds(reading.train, reading.drives).values["0"] == Q(2000, 7)
    assert "Speeds: 2 w_1 - 7 w_0 + 5 w_2 = 0" in reading.explain()


def test_toml_says_the_same():
    toml = 'train = """\nsun:24 planet:18 ring:-60 on arm planets=3  # Ravigneaux it is not\n"""\nhold = ["ring"]\n'
    reading = read_toml(toml + "[drive]\nsun = 12.5\n[load]\narm = -50\n")
    assert reading == read_train(f"{PLANETARY} planets=3; hold ring; drive sun=12.5; load arm=-50")


def test_words_in_both_languages():
    reading = read_train(f"{PLANETARY} planets=5; sun=1; sun2:5 sun:6; sun2=9")
    english, german = reading.explain(), reading.explain("de")
    assert "sun2 cannot have 9" in english
    assert "places are 4.28571° or multiples of it apart" in english
    assert "sun2 kann nicht 9 haben" in german
    assert len(english.splitlines()) == len(german.splitlines()) == 6


@given(st.from_regex(r"-?[0-9]{1,6}(\.[0-9]{1,6})?([eE][-+]?[0-9]{1,3})?", fullmatch=True))
def test_decimals_with_an_exponent_are_exact(text):
    assert exact_number(text, "size") == Q(text)


def test_the_sizes_and_speeds_of_a_train_may_have_exponents():
    reading = read_train("a:1.2e1 b:240e-1; drive a=1e3")
    assert reading.drives["a"] == 1000
    assert reading.train.meshes[0].size_b == 24


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "at least one mesh"),
        ("sun:0 a:1", "positive size, not 0"),
        ("sun:x a:1", "found 'x'"),
        ("sun:nan a:1", "found 'nan'"),
        ("sun:inf a:1", "found 'inf'"),
        ("sun:1e999999999 a:1", "up to 1e999"),
        ("sun:1e-999999999 a:1", "up to 1e999"),
        ("sun:1e1000 a:1", "up to 1e999"),
        ("sun:1/0 a:1", "up to 1e999"),
        ("a:1", "two wheels"),
        ("belt a:1 b:-2", "positive size, not -2"),
        ("a:5 a:6", "two different links"),
        ("a:1 b:2 on a", "two different links"),
        ("a:10 b:-9", "larger than the wheel in it"),
        ("a:-10 b:-9", "two internal wheels"),
        ("scrw a b lead=2", "did you mean 'screw'"),
        ("screw a b", "expected 'screw SPINDLE"),
        ("rack a:3 b:2", "a link that slides"),
        ("a:1 b:2 on", "after 'on'"),
        ("a:1 b:2; c=1", "no moving link 'c'; its links are a, b"),
        ("a:1 b:2; a=1 a=2", "given twice"),
        ("a:1 b:2 lead=3", "no option 'lead'"),
        ("rack p:3 s; screw q s lead=2", "by its pitch"),
        ("rack p:3 s; s:3 b:4", "per radian"),
        ("a:1 b:1 c:1 on h planets=x", "whole number of planets"),
        ("winch a:1 b falls=0", "at least one rope"),
        ("R(0-1-2) R(0-3) G(1-3) G(2-3)", "no tooth numbers"),
        ("R(0-1-2) R(0-3) G(1:24-2:18)", "on another axis of 2"),
        ("R(0-1-2) R(0-3) G(1:24-9:18)", "on another axis of 9"),
        ("R(0-1-2) R(0-3)", "at least one mesh"),
    ],
)
def test_absurd_texts_are_refused_in_one_sentence(text, words):
    with pytest.raises(GearError, match=words) as caught:
        read_train(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("train = 3", "wrong form"),
        ("trian = 'a:1 b:2'", "did you mean 'train'"),
        ("train = [", "is not TOML"),
        ("train = 'a:1 b:2'\ndrive.a = 'fast'", "found 'fast'"),
    ],
)
def test_absurd_toml_is_refused(text, words):
    with pytest.raises(GearError, match=words):
        read_toml(text)


def test_questions_without_an_answer():
    train = read_train(PLANETARY).train
    with pytest.raises(GearError, match="does not follow from sun"):
        ratio(train, "sun", "arm")
    with pytest.raises(GearError, match="needs as many independent drives"):
        influence(train, ["sun"])
    with pytest.raises(GearError, match="cannot be a load"):
        balance(train, {"sun": 1, "ring": 0}, {"sun": 3})
    with pytest.raises(GearError, match="no relation"):
        train.relation("sun", "ring")
    with pytest.raises(GearError, match="2 relations"):
        train.relation("sun", "ring", "arm", "planet")
    with pytest.raises(GearError, match="did you mean 'planet'"):
        assembly(train, "plant", 3)


@pytest.mark.parametrize(
    ("text", "closed"),
    [
        ("sun:24 planet:18 ring:-60 on arm", {"planet": True}),
        ("sun:24 planet:17 ring:-60 on arm", {"planet": False}),
        ("frame:-60 planet:17 sun:24 on arm", {"planet": False}),
        ("a:20 p:30 on c; p:25 b:25 on c", {"p": True}),  # stepped, both central wheels outside
        ("a:20 p:30 on c; p:25 b:24 on c", {"p": False}),
        ("s:30 p:15 r:-60 on c; s:30 q:15 r:-60 on c", {"p": True, "q": True, "s": True, "r": True}),
        ("s:30 p:15 r:-60 on c; s:30 q:14 r:-60 on c", {"s": False, "r": False, "p": True, "q": False}),
        ("sun:24 p1:10 p2:9 ring:-60 on arm", {}),  # two planets in a row: no condition on the tooth numbers alone
        ("sun:24 planet:18 ring:-60", {}),  # no carrier moves
    ],
)
def test_whether_central_wheels_have_one_axis(text, closed):
    """Against the places of the axes: with half modules as lengths, each partner stands at its distance."""
    reading = read_train(text)
    assert {one.planet: one.coaxial for one in axes(reading.train)} == closed
    for lang, words in (("en", "do not have one axis"), ("de", "haben keine gemeinsame Achse")):
        assert (words in reading.explain(lang)) == (not all(closed.values()))


def test_the_condition_of_the_textbook():
    """z_ring = z_sun + 2 z_planet, for all small tooth numbers."""
    closed = set()
    for sun, planet, ring in itertools.product(range(18, 24), range(12, 18), range(48, 60)):
        (place,) = axes(read_train(f"sun:{sun} planet:{planet} ring:-{ring} on arm").train)
        if place.coaxial:
            closed.add((sun, planet, ring))
    both = itertools.product(range(18, 24), range(12, 18))
    assert closed == {(sun, planet, sun + 2 * planet) for sun, planet in both if 48 <= sun + 2 * planet < 60}
    assert len(closed) == 24


def test_numbers_of_planets():
    told = read_train("sun:24 planet:18 ring:-60 on arm").explain()
    assert "Equal planets (planet) that fit at equal angles: 2, 3, 4, 6." in told
    for many in range(2, 13):
        fits = assembly(read_train("sun:24 planet:18 ring:-60 on arm").train, "planet", many).possible
        assert fits == (84 % many == 0 and 42 * math.sin(math.pi / many) > 20)


ROWS = st.lists(
    st.dictionaries(st.integers(0, 7), st.builds(Q, st.integers(-3, 3), st.integers(1, 3)), max_size=4), max_size=9
)


@given(ROWS, st.permutations(range(8)))
def test_elimination_gives_the_form_and_the_order_of_gauss_and_jordan(rows, columns):
    slow = slow_echelon(rows, columns)
    form = rational_echelon(rows, columns)
    assert list(form.items()) == list(slow.items())
    growing = Elimination(columns)
    for k, row in enumerate(rows):
        before = slow_echelon(rows[:k], columns)
        assert growing.left(row) == slow_reduced(row, before)
        assert growing.add(row) == bool(slow_reduced(row, before))


@pytest.mark.parametrize("driven", [0, 1999])
def test_a_row_of_two_thousand_wheels(driven):
    """w_k z_k = (-1)^(k - j) w_j z_j for wheels in a row, whichever is driven."""
    teeth = [17 + k % 40 for k in range(2000)]
    reading = read_train(" ".join(f"w{k}:{z}" for k, z in enumerate(teeth)) + f"; drive w{driven}=1")
    found = speeds(reading.train, reading.drives)
    assert found.values == {f"w{k}": Q((-1) ** abs(k - driven) * teeth[driven], z) for k, z in enumerate(teeth)}
    assert reading.train.redundant == ()
    assert reading.explain().startswith("2000 moving links, 1999 independent meshes: mobility 1.")


def test_ratios_with_thousands_of_digits_are_said_in_six():
    """5,000 stages of 100:10, whose ratio 10^5000 has more digits than Python writes."""
    reading = read_train("; ".join(f"w{k}:100 w{k + 1}:10" for k in range(5000)) + "; drive w0=1")
    found = speeds(reading.train, reading.drives).values["w5000"]
    assert found == Q(10) ** 5000
    assert fraction_text(found) == "1e+5000"
    assert fraction_text(1 / found) == "1e-5000"
    assert "Speeds: 1e+5000 w0 - w5000 = 0" in reading.explain()


def test_one_mesh_is_not_several():
    assert read_train("sun:24 planet:18").explain().startswith("2 moving links, 1 independent mesh: mobility 1.")


def test_powers_beyond_all_numbers_are_refused():
    state = balance(read_train("in:20 out:40").train, {"in": 10**200}, {"out": 10**200})
    with pytest.raises(GearError, match="too large"):
        state.watts  # noqa: B018  it is computed when it is asked for
