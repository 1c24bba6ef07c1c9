"""How completely and how fast tasks of dimensional synthesis are solved; beside pylinkage where it is installed."""

import statistics
import time
from collections.abc import Callable
from math import pi

import numpy as np

from gruebler.design.realisation import realise
from gruebler.design.synthesis import Demands, PathTask, PositionTask, synthesise_path, synthesise_structures
from gruebler.design.synthesis.alt_burmester import PROBLEMS, load_generic_solutions, parameters, solutions
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.curve_matching import PLACES, best_matches, resampled
from gruebler.design.synthesis.curves import fit_curve
from gruebler.design.synthesis.dyad_structures import dyad_structure
from gruebler.design.synthesis.dyads import Displacements, all_dyads
from gruebler.design.synthesis.structure_atlas import structure_atlas
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit, move
from gruebler.structure.mechanism import Mechanism


def seconds(run: Callable[[], object], repeat: int = 1) -> float:
    """The median time of a call."""
    times = []
    for _ in range(repeat):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def finite_problems(tasks: int = 5) -> None:
    print(f"{'problem':36}{'by theorem':>11}{'found':>14}{'certified':>11}{'real':>10}{'time':>10}")
    for problem in reversed(PROBLEMS):
        load_generic_solutions(problem)
        rng = np.random.default_rng(7)
        found, good, real, times = [], [], [], []
        for _ in range(tasks):
            count = problem.poses + problem.points
            d = rng.normal(size=count) + 1j * rng.normal(size=count)
            pivots = tuple(complex(*row) for row in rng.normal(size=(2, 2))) if problem.given_pivots else None
            p = parameters(d, np.exp(1j * rng.uniform(-3, 3, problem.poses)), pivots)
            start = time.perf_counter()
            made = solutions(problem, p)
            times.append(time.perf_counter() - start)
            found.append(len(made.z))
            good.append(made.certified.mean())
            real.append(len(made.real))
        some = f"{min(found)}..{max(found)}" if min(found) < max(found) else str(min(found))
        print(
            f"{problem.name:36}{problem.classes:>11}{some:>14}{statistics.mean(good):>11.1%}"
            f"{f'{min(real)}..{max(real)}':>10}{statistics.median(times):>8.2f} s",
            flush=True,
        )


JANSEN = {"m": 15, "a": 38, "l": 7.8, "j": 50, "k": 61.9, "b": 41.5, "c": 39.3, "d": 40.1, "e": 55.8, "f": 39.4}
JANSEN |= {"g": 36.7, "h": 65.7, "i": 49}


def jansens_foot(places: int = 64) -> np.ndarray:
    """The curve of the foot of Jansen's leg (2007), by intersections of circles; lengths as published."""
    s = JANSEN
    pin = s["m"] * np.exp(1j * np.linspace(0, 2 * pi, places, endpoint=False))
    pivot = complex(-s["a"], -s["l"])

    def joint(p: np.ndarray, r: float, q: np.ndarray | complex, t: float, side: int) -> np.ndarray:
        """At distances r from p and t from q, on one side of the line from p to q."""
        gap = q - p
        far = np.abs(gap)
        along = (r * r - t * t + far**2) / (2 * far)
        return p + gap / far * (along + side * 1j * np.sqrt(r * r - along**2))

    upper = joint(pin, s["j"], pivot, s["b"], -1)
    left = joint(upper, s["e"], pivot, s["d"], -1)
    lower = joint(pin, s["k"], pivot, s["c"], 1)
    knee = joint(left, s["f"], lower, s["g"], -1)
    return joint(knee, s["h"], lower, s["i"], -1)


def targets() -> dict[str, tuple[np.ndarray, bool]]:
    """Drawn curves: closed ones and open ones."""
    s = np.linspace(0, 2 * pi, 64, endpoint=False)
    t = np.linspace(0, 1, 48)
    half = np.exp(1j * np.linspace(-pi / 2, pi / 2, 40))
    flat = 1j * np.linspace(1, -1, 26)[1:-1]
    leg = np.concatenate([np.linspace(-2, 2, 32) + 0j, 2 * np.exp(1j * np.linspace(0, pi, 32)[1:-1])])
    triangle = np.concatenate(
        [a + (b - a) * np.linspace(0, 1, 22, endpoint=False) for a, b in ((0, 3), (3, 1.5 + 2.6j), (1.5 + 2.6j, 0))]
    )
    egg = (1 + 0.25 * np.cos(s)) * np.exp(1j * s)
    return {
        "circle": (np.exp(1j * s), True),
        "ellipse 2:1": (2 * np.cos(s) + 1j * np.sin(s), True),
        "ellipse 4:1": (4 * np.cos(s) + 1j * np.sin(s), True),
        "egg": (egg, True),
        "D": (np.concatenate([half, flat]), True),
        "figure eight": (np.sin(s) + 0.5j * np.sin(2 * s), True),
        "leg, flat foot": (leg, True),
        "Jansen's foot": (jansens_foot(), True),
        "leg, low": (leg.real + 0.4j * leg.imag, True),
        "triangle": (triangle, True),
        "rounded triangle": (np.exp(1j * s) + 0.12 * np.exp(-2j * s), True),
        "rounded square": (np.exp(1j * s) + 0.06 * np.exp(-3j * s), True),
        "bean": (np.exp(1j * s) + 0.3 * np.exp(2j * s), True),
        "heart": (16 * np.sin(s) ** 3 + 1j * (13 * np.cos(s) - 5 * np.cos(2 * s) - 2 * np.cos(3 * s)), True),
        "drop": (np.sin(s) * np.sin(s / 2) ** 2 + 1.2j * np.cos(s), True),
        "straight line": (t + 0j, False),
        "quarter circle": (np.exp(0.5j * pi * t), False),
        "parabola": (t - 0.5 + 2j * (t - 0.5) ** 2, False),
        "letter S": (np.cos(1.5 * pi * t + pi / 4) * 0.6 + 1j * (1 - 2 * t), False),
        "letter C": (np.exp(1j * (pi / 4 + 1.5 * pi * t)), False),
        "letter U": (
            np.concatenate(
                [
                    -1 + 1j * np.linspace(2, 0, 12),
                    np.exp(1j * np.linspace(pi, 2 * pi, 20))[1:-1],
                    1 + 1j * np.linspace(0, 2, 12),
                ]
            ),
            False,
        ),
        "sine": (6 * t + 1j * np.sin(6 * t), False),
    }


def curves() -> None:
    fit_curve(np.exp(1j * np.linspace(0, 6, 20)), closed=True)  # the atlas
    print(f"\n{'curve':22}{'best':>14}{'error':>10}{'time':>10}")
    errors, times = [], []
    for name, (z, closed) in targets().items():
        start = time.perf_counter()
        best = fit_curve(z, closed=closed)[0]
        times.append(time.perf_counter() - start)
        errors.append(best.error)
        print(f"{name:22}{best.kind.name:>14}{best.error:>10.3%}{times[-1]:>8.2f} s", flush=True)
    print(f"{'median':22}{'':>14}{statistics.median(errors):>10.3%}{statistics.median(times):>8.2f} s")


STEPHENSON = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(0-1)"


def six_bars() -> None:
    mechanism = Mechanism.parse(STEPHENSON)
    structure = dyad_structure(mechanism)
    assert structure is not None
    print(f"\natlas of the six-bar: {seconds(lambda: structure_atlas(structure)):.2f} s")
    print(f"{'curve':22}{'accepted':>14}{'largest':>10}{'time':>10}")
    errors, times = [], []
    for name, (z, closed) in targets().items():
        task = PathTask([(w.real, w.imag) for w in z], closed=closed)
        start = time.perf_counter()
        found = synthesise_structures(task, [mechanism], Demands(tolerance=0.2))
        times.append(time.perf_counter() - start)
        errors.append(found.designs[0].verdict.error if found.designs else float("nan"))
        print(f"{name:22}{len(found.designs):>14}{errors[-1]:>10.3%}{times[-1]:>8.2f} s", flush=True)
    print(f"{'median':22}{'':>14}{statistics.median(errors):>10.3%}{statistics.median(times):>8.2f} s")


def six_bar_gradient(poses: int = 64) -> None:
    """One quantity of each pose by all dimensions, beside the pose itself by both solvers."""
    linkage = realise(Mechanism.parse(STEPHENSON), seed=0).linkage
    assert linkage is not None
    closure, course = DesignClosure(linkage), circuit(linkage)
    q, p = closure.poses(course.at(np.linspace(0, course.length, poses))), closure.sizes
    near = q + 1e-2 * np.random.default_rng(0).normal(size=q.shape) * np.tile([linkage.size] * 2 + [1.0], 5)
    quantity = np.zeros((poses, 1, closure.unknowns))
    quantity[:, :, closure.column["4"]] = 1.0
    drives = np.linspace(course.drive[0], course.drive[0] + np.ptp(course.drive) / 2, poses)
    for name, run in (
        ("pose by Newton's method", lambda: closure.closed(near, p, size=linkage.size)),
        ("pose by move", lambda: move(linkage, drives)),
        (f"gradient by {len(p)} numbers", lambda: closure.derivatives(q, p, size=linkage.size).gradient(quantity)),
    ):
        run()
        print(f"six-bar, {poses} poses: {name:24}{1e6 * seconds(run, 9) / poses:>8.1f} us a pose")


def rival(task: PositionTask, points: np.ndarray) -> None:
    """The four-bar 1, 3, 2.5, 3.5 from five of its positions and points."""
    try:
        from pylinkage.synthesis import Pose, motion_generation, path_generation
    except ImportError:
        print("pylinkage is not installed")
        return
    for name, run in (
        ("pylinkage, five positions", lambda: motion_generation([Pose(*row) for row in task.positions])),
        ("pylinkage, five points", lambda: path_generation([(z.real, z.imag) for z in points])),
    ):
        start = time.perf_counter()
        try:
            found = run()
            told = f"{len(getattr(found, 'solutions', found))} solutions"
        except Exception as error:  # another program's errors are its own
            told = f"{type(error).__name__}: {error}"
        print(f"{name:36}{told:>40}{time.perf_counter() - start:>8.2f} s", flush=True)


def rival_curves(generations: int = 1000) -> None:
    """Curves by pylinkage's differential evolution with its default settings: one crank, dyad, coupler point.

    What it minimises is what the best similarity leaves of places evenly along its curve and the target, over all
    starts and both senses; for an open target over pieces of an eighth to three quarters of its curve as well. The
    error is that of `curves`: the root mean square distance of points from the curve, by the longer side of the target.
    """
    try:
        from pylinkage.actuators import Crank
        from pylinkage.components import Ground
        from pylinkage.dyads import FixedDyad, RRRDyad
        from pylinkage.optimization import differential_evolution_optimization, kinematic_minimization
        from pylinkage.simulation import Linkage
    except ImportError:
        print("pylinkage is not installed")
        return

    ground, far = Ground(0, 0, name="A"), Ground(1, 0, name="D")
    crank = Crank(anchor=ground, radius=0.3, angular_velocity=2 * pi / 96, initial_angle=0.1, name="B")
    rocker = RRRDyad(anchor1=crank.output, anchor2=far, distance1=0.9, distance2=0.8, name="C")
    point = FixedDyad(anchor1=crank.output, anchor2=rocker, distance=0.5, angle=0.4, name="P")
    linkage = Linkage([ground, far, crank, rocker, point], name="four-bar")
    errors, times = [], []
    print(f"\n{'pylinkage':22}{'error':>10}{'time':>10}")
    for name, (z, closed) in targets().items():
        best: list = [float("inf"), z]

        @kinematic_minimization
        def score(loci, z=z, closed=closed, best=best, **_: object) -> float:
            own = np.array([complex(*row[-1]) for row in loci])
            if not np.ptp(own.real) + np.ptp(own.imag) > 1e-9:
                return float("inf")
            match = best_matches(resampled(own, PLACES, closed=True)[0][None], z, 1, closed=closed)[0]
            if match.gap < best[0]:
                placed = match.turn * own + match.shift
                best[:] = match.gap, np.conj(placed) if match.mirrored else placed
            return match.gap

        start = time.perf_counter()
        bounds = ([0.05, 0.1, 0.1, 0.05, -pi], [0.9, 3.0, 3.0, 3.0, pi])
        differential_evolution_optimization(
            score, linkage, bounds=bounds, order_relation=min, seed=1, maxiter=generations, verbose=False
        )
        times.append(time.perf_counter() - start)
        dense = resampled(best[1], 4096, closed=True)[0]
        gaps = np.abs(z[:, None] - dense).min(axis=1)
        errors.append(float(np.sqrt(np.mean(gaps**2)) / max(np.ptp(z.real), np.ptp(z.imag))))
        print(f"{name:22}{errors[-1]:>10.3%}{times[-1]:>8.2f} s", flush=True)
    print(f"{'median':22}{statistics.median(errors):>10.3%}{statistics.median(times):>8.2f} s")


def main() -> None:
    finite_problems()
    drives = np.radians([10.0, 35.0, 60.0, 85.0, 110.0])
    motion = move(FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)}), drives)
    rows = [(*p, a) for p, a in zip(motion.point("P"), motion.angle("coupler"), strict=True)]
    task = PositionTask(tuple(rows))
    given, *_ = Displacements.of(task.origins, task.turns)
    print(f"five positions, all dyads: {1000 * seconds(lambda: all_dyads(given), 50):.2f} ms")
    points = PathTask(motion.point("P"), crank_angles=tuple(drives))
    print(f"five points with crank angles, with verdicts: {seconds(lambda: synthesise_path(points), 3):.2f} s")
    rival(task, motion.complex_point("P"))
    rival_curves()
    six_bar_gradient()
    curves()
    six_bars()


if __name__ == "__main__":
    main()
