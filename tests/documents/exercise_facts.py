"""The worked examples of chapter 3 and the 22 exercises, every part and every printed number of them."""

from __future__ import annotations

from math import acos, asin, degrees, radians, sin, sqrt
from typing import Any

import numpy as np

from gruebler.base.text import Readable
from gruebler.mechanics.forces import Loads, statics, statics_table
from gruebler.mechanics.fourbar import SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.teaching.exercises import exercise, solve
from tests.documents import independent as own
from tests.documents.fact import Fact, answer_of, exercise_place, task


def table(id: str, states: str, columns: list[int], value: Any, *, number: int = 0, near: float = 1e-9) -> Fact:
    """Columns of a table of a solution."""

    def derive() -> Any:
        rows = solve(exercise(id)).tables[number].rows
        return np.array([[row[k] for k in columns] for row in rows], float)

    return Fact(place=exercise_place(id), states=states, derive=derive, value=value, near=near, subject=id)


def result(id: str, key: str) -> Any:
    """A result that the exercise does not ask for."""
    value = solve(exercise(id))[key]
    return value.in_language("en") if isinstance(value, Readable) else value


def also(id: str, key: str, states: str, value: Any, *, near: float = 1e-9, printed: str = "") -> Fact:
    """A fact about a result that is not among the questions of the exercise."""
    return Fact(
        place=exercise_place(id),
        states=states,
        derive=lambda: result(id, key),
        value=value,
        near=near,
        printed=printed,
        subject=id,
    )


def vectors(id: str) -> dict[str, complex]:
    """The vectors of a polygon of velocities and accelerations."""
    return {str(row[0]): complex(row[1], row[2]) for row in solve(exercise(id)).tables[0].rows}


STEPS = range(0, 361, 30)
CENTRAL, ECCENTRIC = "example-3.2.1-central", "example-3.2.1-eccentric"
ROCKER, STEG = "example-3.2.2-eccentric", "example-3.4-four-bar"
PHI_I, PHI_A = own.rocker_ends(2, 7, 4.5, 5.5)
DELTA = PHI_I - PHI_A
T_MAX, T_MIN = (180 + DELTA) / 360 * 200, (180 - DELTA) / 360 * 200
MU_I, MU_II = own.enclosed(5, 4, 3), own.enclosed(5, 4, 7)

CHAPTER_2 = [
    *(
        task(id, f"F.{machine}", f"F of {machine}", printed, own.freedoms(n, joints))
        for id, machine, n, joints, printed in (
            ("example-2.3", "tri", 3, {1: 3}, "0"),
            ("example-2.3", "quad", 4, {1: 4}, "1"),
            ("example-2.3", "pent", 5, {1: 5}, "2"),
            ("example-2.6", "quad", 4, {1: 4}, "1"),
            ("example-2.6", "quad_double", 5, {1: 6}, "0"),
            ("example-2.6", "quad_strut", 5, {1: 6}, "0"),
            ("example-2.6", "slidercrank", 4, {1: 4}, "1"),
            ("example-2.6", "kurbelschleife", 4, {1: 4}, "1"),
            ("example-2.6", "friction_rigid", 3, {1: 3}, "0"),
            ("example-2.6", "friction_forced", 4, {1: 4}, "1"),
            ("example-2.6", "geartrain", 3, {1: 2, 2: 1}, "1"),
        )
    ),
    task("example-2.5", "F", "b = 6: two turning and two ball joints", value=own.freedoms(4, {1: 2, 3: 2}, 6)),
    task("example-2.5", "n", "its links", value=4),
    task("example-2.5", "g1", "its turning joints", value=2),
]

CHAPTER_3 = [
    task(CENTRAL, "l_i", "inner dead centre, a = 2, b = 4.5", value=2.5),
    task(CENTRAL, "l_a", "outer dead centre", value=6.5),
    task(CENTRAL, "H", "stroke H = 2a", value=4.0),
    task(ECCENTRIC, "l_i", "l_i = sqrt((b - a)² - e²), a = 1.7, b = 6, e = 1.5", value=own.slider_ends(1.7, 6, 1.5)[0]),
    task(ECCENTRIC, "l_a", "l_a = sqrt((a + b)² - e²)", value=own.slider_ends(1.7, 6, 1.5)[1]),
    task(ECCENTRIC, "H", "H = l_a - l_i", value=sqrt(7.7**2 - 2.25) - sqrt(4.3**2 - 2.25)),
    task(ECCENTRIC, "φ_max", "longer turn of the crank, above 180", value=180 + own.slider_delta(1.7, 6, 1.5)),
    task(ECCENTRIC, "φ_min", "shorter turn of the crank, below 180", value=180 - own.slider_delta(1.7, 6, 1.5)),
    task(
        ECCENTRIC,
        "time_ratio",
        "the eccentricity divides the crank's turn unequally",
        value=(180 + own.slider_delta(1.7, 6, 1.5)) / (180 - own.slider_delta(1.7, 6, 1.5)),
    ),
    task("example-3.2.2-central", "d", "central crank-rocker: d² = b² + c² - a²", value=sqrt(49 + 20.25 - 4)),
    task("example-3.2.2-central", "ψ_H", "its swing", value=own.swing(2, 7, 4.5, sqrt(65.25))),
    task(ROCKER, "φ_i", "φ_i of the crank-rocker 2, 7, 4.5, 5.5", "50.5", PHI_I),
    task(ROCKER, "φ_a", "φ_a", "23.2", PHI_A),
    task(ROCKER, "Δφ", "Δφ", "27.3", DELTA),
    task(ROCKER, "φ_max", "φ_max", "207.3", 180 + DELTA),
    task(ROCKER, "φ_min", "φ_min", "152.7", 180 - DELTA),
    task(ROCKER, "T", "one turn at 300 1/min in ms", "200", 200.0),
    task(ROCKER, "T_max", "time of the longer stroke in ms", "115.2", T_MAX),
    task(
        ROCKER,
        "T_min",
        "time of the shorter stroke in ms, labelled T_max",
        "48.8",
        T_MIN,
        misprint="152.7/360 of 200 ms is 84.8 ms: two digits exchanged; the printed difference 30.4 fits 84.8",
    ),
    task(
        ROCKER,
        "ΔT",
        "difference of the times in ms",
        "30.4",
        T_MAX - T_MIN,
        misprint="the difference of the rounded times 115.2 and 84.8; unrounded it is 30.3",
    ),
    task("example-3.3-large", "b", "b = 2/0.4 in cm", "5", 5.0),
    task("example-3.3-small", "b", "b = 2/0.2 in cm", "10", 10.0),
    *(
        fact
        for id, b in (("example-3.3-large", 5.0), ("example-3.3-small", 10.0))
        for fact in (
            task(id, "s_H2", f"place of half the stroke, b = {b:g}", value=b),
            task(id, "s_T", f"place at half the time of the stroke, b = {b:g}", value=sqrt(b * b - 4)),
            task(id, "offset", f"half the stroke and half the time differ, b = {b:g}", value=b - sqrt(b * b - 4)),
            task(id, "time_part", f"share of the time to half the stroke, b = {b:g}", value=own.middle(2, b) / 180),
        )
    ),
    Fact(
        place="000/003, section 3.3",
        states="the larger λ, the farther half the stroke is from half the time",
        derive=lambda: result("example-3.3-large", "offset_H") > result("example-3.3-small", "offset_H"),
        value=True,
    ),
    task(STEG, "μ_I", "μ_I of the crank-rocker 2, 5, 4, 5", "37", MU_I),
    task(STEG, "μ_II", "μ_II", "101", MU_II, misprint="cut off instead of rounded: 101.54"),
    task(STEG, "μ_II*", "μ_II folded", "79", 180 - MU_II, misprint="follows from the cut-off 101"),
    task(STEG, "α_I", "α_I", "53", 90 - MU_I),
    task(STEG, "α_II", "α_II", "11", MU_II - 90, misprint="follows from the cut-off 101"),
    task(STEG, "μ_min", "μ_min is the smaller one", "37", own.smallest([MU_I, MU_II])),
    Fact(
        place="000/003, section 3.4",
        states="μ_min should be above 40: not so for 2, 5, 4, 5",
        derive=lambda: result(STEG, "good"),
        value=False,
    ),
    task("example-3.4-slider-large", "λ", "λ of a = 2, b = 5", "0.4", 0.4),
    task("example-3.4-slider-large", "α_max", "α_max = arcsin(a/b)", "23.6", degrees(asin(0.4))),
    task("example-3.4-slider-large", "μ_min", "μ_min = arccos(a/b)", "66.4", degrees(acos(0.4))),
    task(
        "example-3.4-slider-small",
        "λ",
        "λ of a = 2, b = 10",
        "0.4",
        0.2,
        misprint="taken over from the line above; the arcsin beside it has 0.2",
    ),
    task("example-3.4-slider-small", "α_max", "arcsin 0.2, labelled α_min", "11.5", degrees(asin(0.2))),
    task("example-3.4-slider-small", "μ_min", "labelled μ_max", "78.5", degrees(acos(0.2))),
    task("example-3.4-slider-eccentric", "α_max", "α_max = arcsin((a + e)/b), 3, 5, 1", "53.1", degrees(asin(0.8))),
    task("example-3.4-slider-eccentric", "μ_min", "μ_min = arccos((a + e)/b)", "36.9", degrees(acos(0.8))),
    task("example-3.5.4-lambda", "h", "height of the line for a = 1, b = c = e = 2.5, d = 2", "4", 4.0),
    task("example-3.5.4-lambda", "length", "C moves 4 units while the crank makes half a turn", value=4.0),
    task(
        "example-3.5.4-lambda",
        "band",
        "nearly straight: how far C leaves the line while the crank makes half a turn",
        value=max(own.lambda_point(1, 90 + k / 100).imag for k in range(18001)) - 4,
        near=1e-7,
    ),
    task("example-3.5.4-scott-russell", "deviation", "a = b = e: exactly straight", value=0.0),
    table(
        "example-3.5.4-scott-russell",
        "C stands 2a sin φ up the line",
        [1, 2],
        [[0.0, 2 * np.sin(radians(phi))] for phi in np.linspace(-60, 60, 9)],
    ),
]


# --- sections 3.4 (i) and 3.6: no figures are printed ------------------------------------------------


def _rates(a: float, b: float, c: float, d: float, phi: float, omega: float) -> dict[str, complex | float]:
    """Velocity and acceleration of A, B and B against A, speeds and the instant centre, by differences and lines."""

    def joint(angle: float) -> complex:
        return own.four_bar(a, b, c, d, angle)[1]

    def crank(angle: float) -> complex:
        return own.four_bar(a, b, c, d, angle)[0]

    def rocker(angle: float) -> float:
        return radians(own.direction(joint(angle) - d))

    def coupler(angle: float) -> float:
        return radians(own.direction(joint(angle) - crank(angle)))

    pa, pb = crank(phi), joint(phi)
    va, vb = (complex(own.velocity(each, phi)) * omega for each in (crank, joint))
    aa, ab = (complex(own.acceleration(each, phi)) * omega**2 for each in (crank, joint))
    # P: on the line through A0 and A and on that through B0 and B
    line, other = pa, pb - d
    share = (d * other.imag) / (line.real * other.imag - line.imag * other.real)
    return {
        "v_A": va,
        "v_B": vb,
        "v_BA": vb - va,
        "a_A": aa,
        "a_B": ab,
        "ω_c": float(np.real(own.velocity(rocker, phi))) * omega,
        "ω_b": float(np.real(own.velocity(coupler, phi))) * omega,
        "α_b": float(np.real(own.acceleration(coupler, phi))) * omega**2,
        "P": share * line,
    }


AT_55 = _rates(25, 70, 40, 70, 55, 10)
AT_90 = _rates(25, 70, 40, 70, 90, 10)
AT_60 = _rates(20, 50, 40, 50, 60, 10)
DIFFERENCES = 1e-7  # relative: what differences of fourth order leave


def _side_force() -> list[float]:
    """Normal force on the guide and force in the rod of 20, 50 at 60°, 100 on the piston."""
    pose = move(SliderCrank(20, 50).linkage(), np.radians([60.0]))
    table = statics_table(statics(pose, Loads(forces={"R(coupler-slider)": (-100, 0)})))
    return [float(table[f"force of {joint} on slider"][0]) for joint in ("P(frame-slider)", "R(coupler-slider)")]


SINE = 20 * sin(radians(60)) / 50
VELOCITIES = [
    Fact(
        place="000/003, section 3.4",
        states="side force of the piston: F_N = sin α F, F that in the rod",
        derive=_side_force,
        value=[100 * SINE / sqrt(1 - SINE**2), 100 / sqrt(1 - SINE**2)],
    ),
    task("example-3.4-ratio", "ω_c", "speed of the rocker of 20, 50, 40, 50 at 60°", value=AT_60["ω_c"], near=1e-8),
    task("example-3.4-ratio", "i", "i = ω/ω_ψ there", value=10 / AT_60["ω_c"], near=1e-8),
    task("example-3.6.1", "P_x", "instant centre of the coupler, crank upright", value=AT_90["P"].real),
    task("example-3.6.1", "P_y", "its height", value=AT_90["P"].imag),
    task("example-3.6.1", "ω_b", "speed of the coupler", value=AT_90["ω_b"], near=1e-8),
    task("example-3.6.1", "v_BA", "v_BA = ω × r", value=abs(AT_90["v_BA"]), near=1e-8),
    task("example-3.6.1", "v_B", "v_B = v_A + ω × r", value=abs(AT_90["v_B"]), near=1e-8),
    also(
        "example-3.6.1",
        "v_B",
        "v_B = ω · PB about the instant centre",
        abs(AT_90["ω_b"] * (own.four_bar(25, 70, 40, 70, 90)[1] - AT_90["P"])),
        near=1e-8,
    ),
    task("example-3.6.2", "v_B", "velocity of B, 25, 70, 40, 70 at 55°, 10 1/s", value=abs(AT_55["v_B"]), near=1e-8),
    task("example-3.6.2", "i", "ratio in this position", value=10 / AT_55["ω_c"], near=1e-8),
    task("example-3.6.2", "a_B", "acceleration of B", value=abs(AT_55["a_B"]), near=DIFFERENCES),
    *(
        Fact(
            place=exercise_place("example-3.6.2"),
            states=f"polygon: {key}",
            derive=lambda key=key: vectors("example-3.6.2")[key],
            value=AT_55[key],
            near=DIFFERENCES,
            subject="example-3.6.2",
        )
        for key in ("v_A", "v_BA", "v_B", "a_A", "a_B")
    ),
    also(
        "example-3.6.2",
        "α_b",
        "the coupler has an angular acceleration although the crank has none (3.6.1 prints α = 0 of the crank)",
        AT_55["α_b"],
        near=1e-6,
    ),
    task(
        "exercise-21",
        "v_B",
        "velocity of the piston, 25, 70 at 55°, 10 1/s",
        value=np.real(own.velocity(lambda phi: own.slider(25, 70, 0, phi), 55)) * 10,
        near=1e-8,
    ),
    task(
        "exercise-21",
        "a_B",
        "its acceleration",
        value=np.real(own.acceleration(lambda phi: own.slider(25, 70, 0, phi), 55)) * 100,
        near=DIFFERENCES,
    ),
]


# --- the exercises ----------------------------------------------------------------------------------


def _strip_of_watt() -> float:
    """How far F moves while it stays within 0.1 of the line."""

    def sideways(turn: float) -> float:
        return abs(own.watt_point(60, 30, turn).real) - 0.1

    low, high = own.root(sideways, -30.0, -5.0), own.root(sideways, 5.0, 25.0)
    return own.watt_point(60, 30, high).imag - own.watt_point(60, 30, low).imag


def _exercise_15() -> list[list[float]]:
    """Crank angle from the overlapping position, where the crank stands, s and way from there; path 20 below."""
    start = 180 + own.direction(complex(own.slider_ends(35, 100, 20)[0], -20))
    near = own.slider_ends(35, 100, 20)[0]
    rows = [[step, start + step, own.slider(35, 100, -20, start + step)] for step in STEPS]
    return [[*row, row[2] - near] for row in rows]


def _coupler_points(points: list[tuple[float, float]]) -> list[list[float]]:
    rows = []
    for phi in range(0, 361, 15):
        a, b = own.four_bar(30, 90, 100, 120, phi)
        places = [own.on_coupler(a, b, *point) for point in points]
        rows.append([phi, *(part for place in places for part in (place.real, place.imag))])
    return rows


_K_AT_90 = _coupler_points([(45, 40)])[6]  # φ, x, y: every 15°


def _double_rocker_lengths() -> Any:
    """Lengths of exercise 19 in the table of its solution, and the angle of d."""
    rows = np.array(solve(exercise("exercise-19")).tables[0].rows, float)
    phi, (a, d, c) = rows[:, 0], (rows[:, k] + 1j * rows[:, k + 1] for k in (1, 3, 5))
    return np.stack([phi, abs(a - d), abs(d), np.degrees(np.angle(d)), abs(a - c)], axis=1)


def _other_pivot() -> list[float]:
    """The pivot of b: 80 from A in all five positions; its distance from the pivot of d is the frame c."""
    rows = np.array(solve(exercise("exercise-19")).tables[0].rows, float)
    a = rows[:, 1] + 1j * rows[:, 2]
    first = a[0], a[2], a[4]
    # the centre of the circle through three positions of A
    p, q, r = first
    w = (r - p) / (q - p)
    centre = p + (q - p) * (w - abs(w) ** 2) / (2j * w.imag)
    return [abs(centre), *abs(a - centre)]


def _against_strip() -> tuple[float, float]:
    """How far band and length are from those of the own computation with the frame that the exercise assumes."""
    frame = float(exercise("exercise-19").given["frame"])
    band, way = own.strip([own.crane_point(10 + k / 50, frame) for k in range(1001)])
    return answer_of("exercise-19", "band", "", False) - band, answer_of("exercise-19", "length", "", False) - way


EXERCISES = [
    task("exercise-1", "slope", "i = 2: ψ = φ/2", value=0.5),
    table("exercise-1", "the line ψ(φ)", [0, 1], [[k, k / 2] for k in range(0, 721, 90)]),
    task("exercise-2", "H", "stroke of 20, 50", value=40.0),
    table("exercise-2", "s(φ) every 30°", [0, 2], [[phi, own.slider(20, 50, 0, phi)] for phi in STEPS]),
    task("exercise-3", "F_before", "F of the four-bar chain", value=own.freedoms(4, {1: 4})),
    task("exercise-3", "F_after", "F with a dyad", value=own.freedoms(6, {1: 7})),
    task("exercise-3", "change", "a dyad leaves F unchanged", "unchanged", "unchanged"),
    task(
        "exercise-3", "chains", "two chains: the dyad at neighbours (Watt) or at opposite links (Stephenson)", value=2
    ),
    task("exercise-4", "F_before", "F of the five-bar chain", value=own.freedoms(5, {1: 5})),
    task("exercise-4", "F_after", "F with a coupler", value=own.freedoms(6, {1: 7})),
    task("exercise-4", "change", "a coupler lowers F by one", "lowered by one", "lowered by one"),
    task("exercise-4", "chains", "one chain: all links of the five-bar that are not neighbours are alike", value=1),
    *(
        task("exercise-5", f"F.{id}", f"F of {id}", value=own.freedoms(n, joints))
        for id, n, joints in (
            ("garage_norail", 4, {1: 4}),
            ("garage_rail", 4, {1: 4}),
            ("hubpodium", 4, {1: 3, 2: 2}),
            ("filmclaw", 4, {1: 4}),
            ("wiper", 6, {1: 7}),
        )
    ),
    also("exercise-5b", "g1", "pairs with f = 1 of the differential: four bearings", 4),
    also("exercise-5b", "g2", "pairs with f = 2: two meshes", 2),
    task("exercise-5b", "F", "F = 2", "2", own.freedoms(5, {1: 4, 2: 2})),
    also("exercise-6", "g1", "joints of the V-compressor, the shared crank pin counted twice", 7),
    task("exercise-6", "F", "F = 1", "1", own.freedoms(6, {1: 7})),
    task("exercise-7", "turns", "the crank of 40, 100, 70, 90 turns", "yes", own.turns(40, 100, 70, 90)),
    task("exercise-7", "type", "it is a crank-rocker", value="crank-rocker"),
    task("exercise-8", "d_min", "d of 25, 40, 70, least", "55", 25.0 + 70 - 40),
    task("exercise-8", "d_max", "greatest", "85", 40.0 + 70 - 25),
    task("exercise-9", "d_min", "d of 40, 100, 70, least", "70", 40.0 + 100 - 70),
    task("exercise-9", "d_max", "greatest", "130", 100.0 + 70 - 40),
    task("exercise-9", "shortest_upper", "the print leaves out the double crank, d up to b", value=70.0 + 40 - 100),
    task("exercise-10", "c_min", "c of 30, 110, d = 80, least", "60", 30.0 + 110 - 80),
    task("exercise-10", "c_max", "greatest", "160", 110.0 + 80 - 30),
    task("exercise-11", "H", "stroke of 20, 50", "40", 40.0),
    task("exercise-11", "φ_H2", "crank in the middle of the stroke, both signs", "78.5", own.middle(20, 50)),
    task("exercise-11", "φ_iH2", "crank from the inner dead centre to there", "101.5", 180 - own.middle(20, 50)),
    task(
        "exercise-11",
        "μ_H2",
        "transmission angle there",
        "66.9",
        90 - degrees(asin(20 * sqrt(1 - 0.04) / 50)),
    ),
    task("exercise-12", "d", "frame of the central crank-rocker 30, 75, 60", "91.2", sqrt(75**2 + 60**2 - 30**2)),
    task("exercise-12", "λ", "λ", "0.4", 0.4),
    task(
        "exercise-12",
        "μ_min",
        "worst transmission angle",
        "52.5",
        own.smallest(own.enclosed(75, 60, sqrt(8325) + sign * 30) for sign in (-1, 1)),
    ),
    task("exercise-13", "μ_min1", "μ_min of 15, 37.5", "66.4", degrees(acos(0.4))),
    task(
        "exercise-13",
        "μ_min2",
        "μ_min of 15, 75",
        "78.2",
        degrees(acos(0.2)),
        misprint="arccos 0.2 is 78.46: 78.5, as section 3.4 prints it",
    ),
    task("exercise-13", "longer", "the longer rod has the larger μ_min", value=acos(0.2) > acos(0.4)),
    task("exercise-14", "μ_min", "μ_min of 20, 85, e = 20", "62", degrees(acos(40 / 85))),
    task("exercise-14", "μ_max", "μ_max, reached because e = a", "90", 90.0),
    table("exercise-15", "s(φ) every 30° from the overlapping position", [0, 1, 2, 3], _exercise_15()),
    task("exercise-15", "H", "stroke of 35, 100, e = 20 in cm", "7.2", (sqrt(135**2 - 400) - sqrt(65**2 - 400)) / 10),
    task(
        "exercise-15",
        "difference",
        "difference of the crank angles of both strokes",
        "18.4",
        2 * (degrees(asin(20 / 65) - asin(20 / 135))),
        misprint="18.8; 18.4 is the value of the eccentric example of 3.2.1, a = 1.7, b = 6, e = 1.5",
    ),
    Fact(
        place="000/003, exercise 15",
        states="the printed 18.4 is the value of the example of 3.2.1",
        derive=lambda: result(ECCENTRIC, "difference"),
        printed="18.4",
        value=2 * own.slider_delta(1.7, 6, 1.5),
    ),
    table(
        "exercise-16",
        "the path every 15°, for four points K since the figure is lost",
        list(range(9)),
        _coupler_points([(45, 40), (45, 0), (135, 0), (45, -40)]),
    ),
    task("exercise-16", "K1_x", "x of K = (45, 40) at 90°, asked since its path is a drawing", value=_K_AT_90[1]),
    task("exercise-16", "K1_y", "y of the same", value=_K_AT_90[2]),
    table(
        "exercise-17",
        "the path of C every 30°, a = 30, b = 90, A0B0 = 50",
        [0, 1, 2],
        [[phi, (c := own.conchoid_point(30, 50, 90, phi)).real, c.imag] for phi in STEPS],
    ),
    task("exercise-17", "swing", "swing of the block", value=2 * degrees(asin(30 / 50))),
    task("exercise-17", "φ_T", "its dead centres", value=degrees(acos(30 / 50))),
    task(
        "exercise-17",
        "time_ratio",
        "time ratio",
        value=(180 - degrees(acos(0.6))) / degrees(acos(0.6)),
    ),
    table(
        "exercise-18",
        "the path of F, rockers 60, coupler 30",
        [1, 2],
        [[(f := own.watt_point(60, 30, turn)).real, f.imag] for turn in range(-35, 26, 5)],
    ),
    task("exercise-18", "stroke", "how far F moves within 0.1 of a straight line", value=_strip_of_watt()),
    Fact(
        place="000/003, exercise 19",
        states="coupler a = 30, d = 100 at 10° to 30°, AC = 60 in every position",
        derive=_double_rocker_lengths,
        value=[[phi, 30, 100, phi, 60] for phi in (10, 15, 20, 25, 30)],
        subject="exercise-19",
    ),
    Fact(
        place="000/003, exercise 19",
        states="frame c = 60, rocker b = 80 in every position",
        derive=_other_pivot,
        value=[60, 80, 80, 80, 80, 80],
        subject="exercise-19",
    ),
    *(
        Fact(
            place="000/003, exercise 19",
            states=f"C runs nearly straight: {key}, for the frame that is assumed",
            derive=lambda k=k: _against_strip()[k],
            value=0.0,
            near=1e-5,
            subject="exercise-19",
            key=key,
        )
        for k, key in enumerate(("band", "length"))
    ),
    table(
        "exercise-20",
        "the path of C every 30°",
        [0, 1, 2],
        [[phi, (c := own.lambda_point(20, phi)).real, c.imag] for phi in STEPS],
    ),
    task("exercise-20", "h", "h of a = 20, b = c = e = 50, d = 40: 4 units of 3.5.4", value=80.0),
    task("exercise-20", "length", "C moves 4 units while the crank makes half a turn", value=80.0),
    task(
        "exercise-20",
        "band",
        "how far it leaves the line there",
        value=max(own.lambda_point(20, 90 + k / 100).imag for k in range(18001)) - 80,
        near=1e-6,
    ),
]


FACTS = [*CHAPTER_2, *CHAPTER_3, *VELOCITIES, *EXERCISES]
