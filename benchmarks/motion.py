"""Positions and rates of linkages, side by side with pylinkage (its compiled solver) in one run."""

import time
from collections.abc import Callable
from math import hypot, pi
from typing import NamedTuple

import numpy as np

from gruebler import Mechanism
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.kinematics.batch import four_bars, move_many
from gruebler.mechanics.linkages import Linkage

ROWS = 10_000
A0, B0 = (0.0, 0.0), (-38.0, -7.8)  # Jansen's leg: the crank's pivot and the other
JANSEN = {"crank": 15.0, "j": 50.0, "b": 41.5, "k": 61.9, "c": 39.3, "e": 55.8, "d": 40.1, "f": 39.4}
JANSEN |= {"g": 36.7, "h": 65.7, "i": 49.0}
LEG = "R(0-1) R(1-j-k) R(0-bde-c) R(j-bde) R(k-c-ghi) R(bde-f) R(f-ghi); frame=0; drive=R(0-1)"
LEG_OF_BARS = "R(0-1) R(1-j-k) R(0-b-c-d) R(j-b-e) R(k-c-g-i) R(e-d-f) R(f-g-h) R(h-i); frame=0; drive=R(0-1)"
CLASS_III = "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)"

Point = tuple[float, float]


class Row(NamedTuple):
    """One line of the table: nanoseconds for one pose, ours and theirs (None: it has no such thing)."""

    name: str
    ours: float
    theirs: float | None = None

    def __str__(self) -> str:
        judged = "" if self.theirs is None else f" {self.theirs:12.0f} {self.theirs / self.ours:8.1f}"
        return f"{self.name:46} {self.ours:8.1f}{judged}"


def nanoseconds(call: Callable[[], object], poses: int = ROWS, runs: int = 50) -> float:
    """The least of some runs, for one pose."""
    call()
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times) / poses * 1e9


def meet(one: Point, other: Point, r: float, s: float) -> Point:
    """The point at distances r and s from two points, left of the line from the first to the second."""
    dx, dy = other[0] - one[0], other[1] - one[1]
    d = hypot(dx, dy)
    along = (d * d + r * r - s * s) / (2 * d)
    across = (r * r - along * along) ** 0.5
    return one[0] + (along * dx - across * dy) / d, one[1] + (along * dy + across * dx) / d


def leg_points() -> dict[str, Point]:
    """Jansen's leg with its crank to the right."""
    n = JANSEN
    c = (A0[0] + n["crank"], A0[1])
    upper, lower = meet(B0, c, n["b"], n["j"]), meet(c, B0, n["k"], n["c"])
    left = meet(B0, upper, n["d"], n["e"])
    knee = meet(lower, left, n["g"], n["f"])
    foot = meet(lower, knee, n["i"], n["h"])
    return {"c": c, "upper": upper, "lower": lower, "left": left, "knee": knee, "foot": foot}


def leg(text: str) -> Linkage:
    p = leg_points()
    places = [A0, p["c"], B0, p["upper"], p["lower"], p["left"], p["knee"], p["foot"]]
    mechanism = Mechanism.parse(text)
    joints = {k: places[k] for k in range(len(mechanism.chain.joints))}
    return Linkage.from_drawing(mechanism, joints, points={"foot": ("ghi", *p["foot"])} if "ghi" in text else {})


def theirs(name: str) -> tuple[Callable[[], object], Callable[[], object]] | None:
    """pylinkage's compiled run of a linkage: positions, positions with velocities and accelerations."""
    try:
        from pylinkage.actuators import Crank
        from pylinkage.components import Ground
        from pylinkage.dyads import RRRDyad
        from pylinkage.simulation import Linkage as Simulation
    except ImportError:
        return None
    step = 2 * pi / (ROWS - 1)
    if name == "four-bar":
        a0, b0 = Ground(0.0, 0.0), Ground(70.0, 0.0)
        crank = Crank(anchor=a0, radius=25.0, angular_velocity=step)
        parts = [a0, b0, crank, RRRDyad(crank.output, b0, 70.0, 40.0)]
    else:
        n, p = JANSEN, leg_points()
        a0, b0 = Ground(*A0), Ground(*B0)
        crank = Crank(anchor=a0, radius=n["crank"], angular_velocity=step)
        upper = RRRDyad(crank.output, b0, n["j"], n["b"], *p["upper"])
        lower = RRRDyad(crank.output, b0, n["k"], n["c"], *p["lower"])
        left = RRRDyad(upper, b0, n["e"], n["d"], *p["left"])
        knee = RRRDyad(left, lower, n["f"], n["g"], *p["knee"])
        foot = RRRDyad(knee, lower, n["h"], n["i"], *p["foot"])
        parts = [a0, b0, crank, upper, lower, left, knee, foot]
    linkage = Simulation(parts)
    linkage.set_input_velocity(crank, 10.0)
    linkage.compile()
    return lambda: linkage.step_fast(ROWS), lambda: linkage.step_fast_with_kinematics(ROWS)


def judged(name: str, judge: str, linkage: Linkage) -> list[Row]:
    path, calls = np.linspace(0, 2 * pi, ROWS), theirs(judge)
    times = [nanoseconds(call) for call in calls] if calls else [None, None]
    return [
        Row(f"{name}, position", nanoseconds(lambda: move(linkage, path)), times[0]),
        Row(f"{name}, with velocity and acceleration", nanoseconds(lambda: move(linkage, path, speed=10)), times[1]),
        Row(f"{name}, with jerk", nanoseconds(lambda: move(linkage, path, order=3))),
    ]


def class_three() -> Linkage:
    """A six-bar whose coupler is held by three links."""
    places = {0: (0, 0), 1: (0.5, 0.3), 2: (2, 2), 3: (5, 0), 4: (4, 2.2), 5: (2, 5.5), 6: (3, 3.5)}
    return Linkage.from_drawing(Mechanism.parse(CLASS_III), places)


def run() -> list[Row]:
    four_bar = FourBar(25, 70, 40, 70).linkage()
    rows = judged("four-bar", "four-bar", four_bar)
    rows += judged("Jansen's leg", "leg", leg(LEG))
    rows += judged("Jansen's leg of 12 bars", "leg", leg(LEG_OF_BARS))
    six = class_three()
    way = np.radians(np.linspace(31, 95, ROWS))
    for order, text in ((0, "position"), (2, "with rates")):
        rows.append(Row(f"class III, {text}", nanoseconds(lambda order=order: move(six, way, order=order), runs=5)))
    lengths = np.random.default_rng(0).uniform([20, 65, 35, 65], [25, 70, 40, 70], (20_000, 4)).T
    many, turn = four_bars(*lengths), np.linspace(0, 2 * pi, 360)
    for threads in (1, 2):
        text = f"20,000 four-bars of 360 poses, {threads} thread{'s' * (threads > 1)}"
        call = lambda threads=threads: move_many(many, turn, links=["coupler", "rocker"], threads=threads)  # noqa: E731
        rows.append(Row(text, nanoseconds(call, 7_200_000, 3)))
    rows.append(Row("one call of move, two rows", nanoseconds(lambda: move(four_bar, turn[:2]), 1)))
    return rows


def main() -> None:
    print(f"{'nanoseconds for one pose':46} {'ours':>8} {'pylinkage':>12} {'ratio':>8}")
    for row in run():
        print(row)


if __name__ == "__main__":
    main()
