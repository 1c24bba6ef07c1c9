"""Thirty closed and open curves by name: how near four-bars and six-bars come, with the measures of learners.

`python -m benchmarks.yardstick FILE ...` takes curves of others instead: .npy of (curves, points, 2);
`--drawn SEED ...` fits paths that random six-bars drew, `--pivots SEED ...` on two of their own pivots;
`--evolution NAME ...` asks scipy's differential evolution, too;
`--challenge FILE` tells the hypervolume of our four-bars as the challenge of MIT 2.156 (2025) does.
"""

import sys
import time
from itertools import chain, product
from math import pi
from pathlib import Path

import numpy as np
from scipy.optimize import differential_evolution

from benchmarks.synthesis import targets
from gruebler.design.synthesis.curve_matching import resampled
from gruebler.design.synthesis.curves import fit_curve
from gruebler.design.synthesis.drawing_limits import DrawingLimits, limits_of_drawings
from gruebler.design.synthesis.dyad_structures import DyadStructure, dyad_structure, link_motions
from gruebler.design.synthesis.four_bar_curves import curve_points
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR
from gruebler.design.synthesis.judging import Demands
from gruebler.design.synthesis.structure_atlas import structure_atlas
from gruebler.design.synthesis.structure_curves import fit_drawings
from gruebler.structure.mechanism import Mechanism

SIX_BARS = {
    "Stephenson III": ("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(0-1)", "4"),
    "Watt I": ("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); frame=0; drive=R(0-1)", "5"),
    "Watt I, ternary crank": ("R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2); frame=0; drive=R(0-1)", "5"),
    "Stephenson I": ("R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-3); frame=0; drive=R(0-1)", "4"),
}
NEIGHBOURS, NEIGHBOURS_OF_OWN = 400, 1200  # of each kind of drawings; 1,200 without `starts`
MET = 1e-6  # of the longer side: the path is taken as met
LONGER = 1.1  # than the polygon of the points: a path that is, leaves it between them
SIZE_RATIOS = (1.5, 2.0, 3.0, 6.0)  # of four-bars for the challenge
TURN = np.linspace(0, 2 * pi, 2001)
EVEN = 200  # points of curves that are compared, as in LInK and in the challenge of MIT 2.156


def thirty() -> dict[str, tuple[np.ndarray, bool]]:
    """The 22 curves of `benchmarks.synthesis`, and eight of an independent examination."""
    s = np.linspace(0, 2 * pi, 64, endpoint=False)
    power = np.abs(np.cos(s)) ** 0.5 * np.sign(np.cos(s)) + 1j * np.abs(np.sin(s)) ** 0.5 * np.sign(np.sin(s))
    side = np.linspace(-1, 1, 16, endpoint=False)
    bow = np.exp(1j * pi * np.arange(16) / 16)
    cassini = np.sqrt(np.cos(2 * s) + np.sqrt(1.05**4 - np.sin(2 * s) ** 2))
    t = np.linspace(0, 1, 48)
    return targets() | {
        "superellipse n = 4": (power, True),
        "limacon": ((1 + 0.8 * np.cos(s)) * np.exp(1j * s), True),
        "limacon with loop": ((1 + 1.6 * np.cos(s)) * np.exp(1j * s), True),
        "teardrop m = 3": (np.cos(s) + 1j * np.sin(s) * np.sin(s / 2) ** 3, True),
        "stadium": (np.concatenate([side - 1j, 1 - 1j * bow, -side + 1j, -1 + 1j * bow]), True),
        "Cassini oval": (cassini * np.exp(1j * s), True),
        "cycloid arch": (2 * pi * t - np.sin(2 * pi * t) + 1j * (1 - np.cos(2 * pi * t)), False),
        "spiral": ((0.3 + 0.7 * t) * np.exp(1.5j * pi * t), False),
    }


def given(row: np.ndarray) -> tuple[np.ndarray, bool]:
    """64 points evenly along a curve, and whether it is closed: LInK's program asks its ends so."""
    z = row[:, 0] + 1j * row[:, 1]
    closed = bool(np.abs(z[-1] - z[0]) <= 1.1 * np.abs(z[1] - z[0]))
    return resampled(z, 64, closed=closed)[0], closed


def distance(z: np.ndarray, path: np.ndarray, *, closed: bool) -> float:
    """The root mean square distance of points from a path of places, by the longer side of the points."""
    first, second = path, np.roll(path, -1)
    if not closed:
        first, second = path[:-1], path[1:]
    along = second - first
    part = np.real((z[:, None] - first) * np.conj(along)) / (np.abs(along) ** 2 + 1e-300)
    gaps = np.abs(z[:, None] - first - np.clip(part, 0, 1) * along).min(axis=1)
    return float(np.sqrt(np.mean(gaps**2)) / max(np.ptp(z.real), np.ptp(z.imag)))


def learners_measures(z: np.ndarray, path: np.ndarray, *, closed: bool = True) -> tuple[float, float]:
    """Chamfer distance as LInK computes it, and the ordered distance of the challenge.

    Both of 200 points evenly along each curve, in units of the target's root mean square radius: the mean distance to
    the nearest point, both ways added; and 2 pi times the mean distance of points in order, in the better sense, of
    closed curves the best of all beginnings.
    """
    target, own = resampled(z, EVEN, closed=closed)[0], resampled(path, EVEN, closed=closed)[0]
    size = np.sqrt(np.mean(np.abs(target - target.mean()) ** 2))
    gaps = np.abs(target[:, None] - own) / size
    chamfer = gaps.min(axis=0).mean() + gaps.min(axis=1).mean()
    ordered = [
        gaps[np.arange(EVEN), (begin + sense * np.arange(EVEN)) % EVEN].mean()
        for sense in (1, -1)
        for begin in (range(EVEN) if closed else [0 if sense == 1 else -1])
    ]
    return float(chamfer), 2 * pi * min(ordered)


def four_bar(z: np.ndarray, *, closed: bool) -> tuple[str, np.ndarray]:
    """The best four-bar or slider-crank and its path past the points."""
    best = fit_curve(z, closed=closed)[0]
    turned = TURN if closed else np.linspace(best.phi[0], best.phi[-1], len(TURN))
    return best.kind.name, curve_points(best.kind, best.row[:, None], turned, best.side).z


def unlimited(
    structure: DyadStructure, link: str, z: np.ndarray, pivots: dict[int, complex]
) -> tuple[DrawingLimits, int]:
    """No limits but given pivots of joints, and in how many ways these can be joints at the frame."""
    unit = float(max(np.ptp(z.real), np.ptp(z.imag)))
    demands = Demands(size_ratio=np.inf)
    every = [*limits_of_drawings(structure, link, demands, [*pivots.values()], closed=True, unit=unit)]
    return next(limits for limits in every if [*limits.pivots] == [*pivots]), len(every)


def six_bar(structure: DyadStructure, link: str, z: np.ndarray, *, closed: bool) -> np.ndarray:
    """The path of the best six-bar of a kind whose crank passes all points in order, and no others far from them."""
    fits = fit_drawings(unlimited(structure, link, z, {})[0], link, z, closed=closed, number=NEIGHBOURS)
    polygon = np.abs(np.diff(np.append(z, z[0]) if closed else z)).sum()
    for places, turned in zip(fits.places, fits.turned, strict=True):
        sense = np.sign(turned[-1] - turned[0])
        end = turned[0] + 2 * pi * sense if closed else turned[-1]
        if not np.all(np.diff(np.append(turned, end) if closed else turned) * sense > 0):
            continue  # the points are met in another order
        rotation, shift = link_motions(structure, places[:-1], np.linspace(turned[0], end, len(TURN)))[link]
        path = rotation * places[-1] + shift
        if np.isfinite(path).all() and np.abs(np.diff(path)).sum() < LONGER * polygon:
            return path
    return np.full(len(TURN), np.nan + 0j)


def drawn_path(structure: DyadStructure, link: str, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """40 places evenly along the path of a random six-bar whose crank turns fully, and where its joints lie."""
    while True:
        joints = rng.normal(size=structure.joints) + 1j * rng.normal(size=structure.joints)
        point = complex(*rng.normal(size=2))
        motions = link_motions(structure, joints[:, None], TURN[None])
        path = (motions[link][0] * point + motions[link][1])[0]
        steps = np.abs(np.diff(path))
        if (
            all(np.isfinite(rotation).all() for rotation, _ in motions.values())
            and steps.max() < np.ptp(path.real) / 20
        ):
            arcs = np.append(0, np.cumsum(steps))
            at = np.interp(np.arange(40) / 40 * arcs[-1], arcs, TURN)
            rotation, shift = link_motions(structure, joints[:, None], at[None])[link]
            return (rotation * point + shift)[0], joints


def drawn_again(seeds: tuple[int, ...], each: int, *, pivots: bool) -> None:
    """Paths that six-bars drew, fitted by six-bars of the same kind, with two of their own pivots if wanted.

    Of the ways in which these can be joints at the frame, which share the neighbours, the right one is taken.
    """
    met = 0
    for seed, (name, (text, link)) in product(seeds, SIX_BARS.items()):
        if name == next(iter(SIX_BARS)):
            rng = np.random.default_rng(seed)
        structure = dyad_structure(Mechanism.parse(text))
        assert structure is not None
        structure_atlas(structure)
        frame, chain = structure.mechanism.frame, structure.mechanism.chain
        fixed = [n for n, joint in enumerate(chain.joints) if frame in joint.links][: 2 * pivots]
        for _ in range(each):
            (z, joints), start = drawn_path(structure, link, rng), time.process_time()
            limits, ways = unlimited(structure, link, z, {n: complex(joints[n]) for n in fixed})
            number = -(-NEIGHBOURS_OF_OWN // ways)
            cost = fit_drawings(limits, link, z, closed=True, number=number).cost.min(initial=np.inf)
            error = np.sqrt(cost / len(z)) / max(np.ptp(z.real), np.ptp(z.imag))
            met += error < MET
            print(f"{seed} {name:22}{error:>9.1e}{time.process_time() - start:>6.1f} s", flush=True)
    print(f"{met} of {len(seeds) * len(SIX_BARS) * each} are met to {MET:.0e}")


def evolved(z: np.ndarray, seed: int = 1) -> tuple[float, float]:
    """The best four-bar by scipy's differential evolution, to a closed curve: its distance, the processor seconds.

    Its nine numbers: the crank's pivot, the length and direction of the frame by the target's size; crank, coupler and
    rocker by the frame; the coupler point by the coupler. The limits are those of `four_bar`: the crank turns fully, no
    link is more than 20 times as long as another. Default settings: 15 times 9 members, at most 1,000 generations.
    """
    middle, size = z.mean(), max(np.ptp(z.real), np.ptp(z.imag))
    target, phi = (z - middle) / size, np.linspace(0, 2 * pi, 400, endpoint=False)
    spin = np.exp(1j * phi)

    def miss(rows: np.ndarray) -> np.ndarray:
        x, y, frame, angle, crank, coupler, rocker, u, v = rows
        lengths = np.exp([0 * crank, crank, coupler, rocker])
        turning = 2 * (lengths.max(axis=0) + np.minimum(1, lengths[1])) - lengths.sum(axis=0)
        over = np.maximum(turning, 0) + np.maximum(np.log(lengths.max(axis=0) / lengths.min(axis=0) / 20), 0)
        errors = 10 + over
        for k in np.flatnonzero(over == 0):
            _, a, b, c = lengths[:, k]
            gap = 1 - a * spin
            along = (b**2 - c**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
            across = np.sqrt(np.maximum(b**2 - along**2, 0))
            path = a * spin + gap / np.abs(gap) * (along + 1j * across) * complex(u[k], v[k])
            path = complex(x[k], y[k]) + np.exp(frame[k] + 1j * angle[k]) * path
            errors[k] = distance(target, path, closed=True)
        return errors

    def vectorized(rows: np.ndarray) -> np.ndarray | float:
        return miss(rows) if rows.ndim == 2 else float(miss(rows[:, None])[0])

    bounds = [(-3, 3), (-3, 3), (-2.5, 2), (-pi, pi), (-3, 0.5), (-2, 3), (-2, 3), (-3, 3), (-3, 3)]
    start = time.process_time()
    found = differential_evolution(vectorized, bounds, seed=seed, vectorized=True, updating="deferred")
    return float(found.fun), time.process_time() - start


def evolution(names: tuple[str, ...]) -> None:
    """Four-bars for closed curves of these names, here and by differential evolution."""
    fit_curve(np.exp(1j * np.linspace(0, 6, 20)), closed=True)  # the atlas
    curves = thirty()
    print(f"{'curve':22}{'here':>10}{'time':>8}{'evolution':>12}{'time':>8}")
    for name in names:
        z, start = curves[name][0], time.process_time()
        best = fit_curve(z, closed=True, kinds=(FOUR_BAR,))[0]
        path = curve_points(best.kind, best.row[:, None], TURN, best.side).z
        own, first = distance(z, path, closed=True), time.process_time() - start
        other, second = evolved(z)
        print(f"{name:22}{own:>10.4%}{first:>6.1f} s{other:>12.4%}{second:>6.1f} s", flush=True)


def hypervolume(points: list[tuple[float, float]], farthest: float = 0.75, most: float = 10.0) -> float:
    """The area that is worse than one of the points (distance, material) and better than (farthest, most)."""
    area = 0.0
    for far, material in sorted(points):
        if far < farthest and material < most:
            area += (farthest - far) * (most - material)
            most = material
    return area


def challenge(file: str) -> None:
    """The hypervolume of four-bars for each curve of a file, and the mean of all.

    Compact ones are asked for by limits of the size ratio. Material is all sides of links, crank, rocker and the
    triangle of the coupler, each twice, as the challenge's program adds them. It lets curves be turned before they are
    compared, too, which only brings them nearer.
    """
    volumes = []
    for curve in np.load(file).astype(float) @ (1, 1j):
        z, points = resampled(curve, 64, closed=True)[0], []
        limits = [Demands(size_ratio=ratio) for ratio in SIZE_RATIOS]
        fits = [fit_curve(z, closed=True, kinds=(FOUR_BAR,), number=24, starts=120, demands=each) for each in limits]
        for fit in chain.from_iterable(fits):
            r = {name: float(value) for name, value in fit.kind.named(fit.row).items()}
            w = complex(r["u"], r["v"])
            path = curve_points(fit.kind, fit.row[:, None], TURN[:-1], fit.side).z
            material = 2 * (r["a"] + r["b"] + r["c"] + abs(w) + abs(w - r["b"]))
            points.append((learners_measures(curve, path)[1], material))
        volumes.append(hypervolume(points))
        print(f"{volumes[-1]:.2f} by {len(points)} four-bars", flush=True)
    print(f"mean {np.mean(volumes):.2f}")


def main(files: tuple[str, ...] = ()) -> None:
    fit_curve(np.exp(1j * np.linspace(0, 6, 20)), closed=True)  # the atlas
    structures = {}
    for name, (text, link) in SIX_BARS.items():
        structure = dyad_structure(Mechanism.parse(text))
        assert structure is not None
        structure_atlas(structure)
        structures[name] = structure, link
    curves = thirty()
    if files:
        curves = {f"{Path(file).stem} {k + 1}": given(row) for file in files for k, row in enumerate(np.load(file))}
    heads = f"{'six links':>9}{'time':>8}{'chamfer':>10}{'ordered':>10}"
    print(f"{'curve':22}{'':>14}{'four links':>11}{'time':>8}  {'':22}{heads}")
    for name, (z, closed) in curves.items():
        start = time.process_time()
        kind, path = four_bar(z, closed=closed)
        four, first = distance(z, path, closed=closed), time.process_time() - start
        best, six, own = "", np.inf, path
        for each, (structure, link) in structures.items():
            found = six_bar(structure, link, z, closed=closed)
            if (error := distance(z, found, closed=closed)) < six:
                best, six, own = each, error, found
        second = time.process_time() - start - first
        near = path if four < six else own
        told = "".join(f"{value:>10.4f}" for value in learners_measures(z, near, closed=closed))
        print(
            f"{name:22}{kind:>14}{four:>11.4%}{first:>6.1f} s  {best:22}{six:>9.4%}{second:>6.1f} s{told}", flush=True
        )


if __name__ == "__main__":
    if sys.argv[1:2] == ["--challenge"]:
        challenge(sys.argv[2])
    elif sys.argv[1:2] == ["--evolution"]:
        evolution(tuple(sys.argv[2:]))
    elif sys.argv[1:2] == ["--drawn"]:
        drawn_again(tuple(map(int, sys.argv[2:])) or (1,), 3, pivots=False)
    elif sys.argv[1:2] == ["--pivots"]:
        drawn_again(tuple(map(int, sys.argv[2:])) or (5, 6, 7), 2, pivots=True)
    else:
        main(tuple(sys.argv[1:]))
