"""Poles, centrodes, cognates, coupler curves, statics: beside loops over rows that do the same one by one."""

import time
from collections.abc import Callable
from itertools import combinations
from typing import NamedTuple

import numpy as np

from benchmarks.motion import LEG, leg
from gruebler.mechanics.forces import Loads, statics
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry import (
    CouplerCurve,
    centrodes,
    cognate_sizes,
    cognates,
    coupler_curve,
    poles,
    taylor_series,
)
from gruebler.mechanics.kinematics import Motion, move

ROWS = 10_000


class Row(NamedTuple):
    """One line of the table: seconds of ours and of the plain way (None: not tried)."""

    name: str
    ours: float
    plain: float | None = None

    def __str__(self) -> str:
        judged = "" if self.plain is None else f" {self.plain:10.4f} {self.plain / self.ours:8.1f}"
        return f"{self.name:58} {self.ours:10.4f}{judged}"


def seconds(call: Callable[[], object], runs: int = 7) -> float:
    """The least of some runs, after one that is not counted."""
    call()
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def poles_row_by_row(motion: Motion) -> list[list[complex]]:
    """Every pair at every row from two velocities, as one would write it down."""
    links = range(motion.turns.shape[1])
    out = []
    for z, v, w in zip(motion.places[0].tolist(), motion.places[1].tolist(), motion.rates[0].tolist(), strict=True):
        there = [v[k] - 1j * w[k] * z[k] for k in links]
        out.append(
            [1j * (there[j] - there[k]) / (w[j] - w[k]) if w[j] != w[k] else 0j for j, k in combinations(links, 2)]
        )
    return out


def statics_row_by_row(motion: Motion, force: complex) -> list[float]:
    """Newton's equations of a four-bar at every row: nine equations set up by hand, solved one after another."""
    out = []
    pins = [motion.complex_point(name).tolist() for name in motion.linkage.mechanism.chain.joint_names()]
    for a0, a, b, b0, k in zip(*pins, motion.complex_point("K").tolist(), strict=True):
        matrix, right = np.zeros((9, 9)), np.zeros(9)
        for body, (first, last) in enumerate(((0, 1), (1, 2), (2, 3))):
            for pin, sign in ((first, 1), (last, -1)):
                arm = (a0, a, b, b0)[pin] - a0
                matrix[3 * body, 2 * pin] = matrix[3 * body + 1, 2 * pin + 1] = sign
                matrix[3 * body + 2, 2 * pin : 2 * pin + 2] = -sign * arm.imag, sign * arm.real
        matrix[2, 8] = 1
        right[3:6] = -force.real, -force.imag, -((k - a0).conjugate() * force).imag
        out.append(float(np.linalg.solve(matrix, right)[8]))
    return out


def run() -> list[Row]:
    path = np.linspace(0, 2 * np.pi, ROWS)
    eight_bar = leg(LEG)
    motion = move(eight_bar, path, speed=1)
    links = eight_bar.mechanism.chain.links
    four_bar = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    simple = move(four_bar, path, order=1)
    a, b, c, d, u, v = np.random.default_rng(0).uniform([20, 65, 35, 65, 10, 10], [25, 70, 40, 70, 60, 60], (ROWS, 6)).T
    many = list(zip(a, b, c, d, u, v, strict=True))[:200]
    loads = Loads({"K": (3.0, -8.0)})
    curve = coupler_curve(four_bar, "K")
    return [
        Row(
            f"eight-bar, {ROWS:,} poses: all 28 poles",
            seconds(lambda: poles(motion)),
            seconds(lambda: poles_row_by_row(motion), 2),
        ),
        Row("the same, moved as well", seconds(lambda: poles(move(eight_bar, path, speed=1)))),
        Row("the same, centrodes of all links", seconds(lambda: [centrodes(motion, link) for link in links[1:]])),
        Row(
            f"all cognates of {ROWS:,} four-bars",
            seconds(lambda: cognate_sizes(a, b, c, d, u, v)),
            seconds(lambda: [cognates(FourBar(*one[:4]), *one[4:]) for one in many], 2) * ROWS / len(many),
        ),
        Row(
            f"four-bar, {ROWS:,} poses: statics",
            seconds(lambda: statics(simple, loads), 3),
            seconds(lambda: statics_row_by_row(simple, 3 - 8j), 2),
        ),
        Row(f"eight-bar, {ROWS:,} poses: statics", seconds(lambda: statics(motion, Loads({"foot": (3.0, -8.0)})), 3)),
        Row(f"four-bar, {ROWS:,} poses: Taylor series to order 6", seconds(lambda: taylor_series(simple, 6), 3)),
        Row("coupler curve: polygon, length, area", seconds(lambda: _drawn(coupler_curve(four_bar, "K")))),
        Row("coupler curve: all events on it", seconds(lambda: _events(coupler_curve(four_bar, "K")))),
        Row(
            "coupler curve as 10,000 points at equal steps of the crank", seconds(lambda: curve.point_path.at(path, 0))
        ),
    ]


def _drawn(curve: CouplerCurve) -> object:
    return curve.length, curve.area


def _events(curve: CouplerCurve) -> object:
    return curve.inflections, curve.vertices, curve.turning_points(), curve.double_points


def main() -> None:
    print(f"{'seconds':58} {'ours':>10} {'row by row':>10} {'ratio':>8}")
    for row in run():
        print(row)


if __name__ == "__main__":
    main()
