"""Dimensions that make many assembly modes of a Baranov truss real: `python -m benchmarks.real_modes LINKS [SEED]`.

They change step by step, and all complex modes are followed. Each step brings one pair of conjugate modes nearer to
being real, while real modes that are close to one another do not come closer: the way on which Dietmaier (1998) found
40 real poses of Gough's platform. What is found is a lower bound. docs/tables/real_modes.csv keeps the best dimensions;
`python -m benchmarks.tables real_modes` solves them again, from other starts.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from tests.structure.assur.monodromy_oracle import Truss, newton_step, noise

TABLE = Path(__file__).parents[1] / "docs" / "tables" / "real_modes.csv"
Complexes = NDArray[np.complex128]
Reals = NDArray[np.float64]

_REAL = 1e-8  # modes whose |log |z|| is smaller are real
_SAME = 1e-7  # relative: modes nearer than that may be one
_SHORTEST = 1e-5  # step of a path
_LONGEST = 0.2  # step of the dimensions, in their own size


class Place(NamedTuple):
    """Dimensions, (joints, 2) points each, for z and for 1/z, and all modes: the turns of links 1, 2, ..."""

    points: Complexes
    conjugates: Complexes
    turns: Complexes

    @property
    def real(self) -> NDArray[np.bool_]:
        """Which modes are real, if the dimensions are."""
        return self.defects < _REAL

    @property
    def defects(self) -> Reals:
        """How far each mode is from being real."""
        return np.linalg.norm(np.log(np.abs(self.turns)), axis=1)


class Modes:
    """All complex modes of a truss, known at random complex dimensions, followed to any others."""

    def __init__(self, links: int, joints: Sequence[tuple[int, int]], possible: int, seed: int = 1) -> None:
        self.truss, self.rng, self.joints = Truss(links, list(joints)), np.random.default_rng(seed), len(joints)
        turns = np.exp(noise(self.rng, links) / 2)
        turns[0] = 1
        points, conjugates = (self.truss.closed_points(z, self.rng) for z in (turns, 1 / turns))
        self.home = Place(points, conjugates, turns[None, 1:])
        while len(self.home.turns) < possible:
            self._round_trip()

    def _round_trip(self) -> None:
        away = [self.random() for _ in range(2)]
        place: Place | None = self.home
        for target in (*away, (self.home.points, self.home.conjugates)):
            if place is not None:
                place = self.follow(place, *target)
        for turns in () if place is None else place.turns:
            known = self.home.turns
            if np.max(np.abs(known - turns) / np.abs(turns), axis=1).min() > _SAME:
                self.home = self.home._replace(turns=np.concatenate([known, turns[None]]))

    def random(self) -> tuple[Complexes, Complexes]:
        """Random complex dimensions."""
        return noise(self.rng, self.joints, 2), noise(self.rng, self.joints, 2)

    def at(self, points: Complexes) -> Place | None:
        """All modes of real dimensions, followed from the random ones; None if that fails four times."""
        tries = (self.follow(self.home, points, points.conj(), bend=0.5) for _ in range(4))
        return next((place for place in tries if place is not None), None)

    def follow(
        self, start: Place, points: Complexes, conjugates: Complexes, *, bend: float = 0.0, step: float = 0.05
    ) -> Place | None:
        """All modes carried to other dimensions, by a bend round the singular ones between; None if that fails."""
        close = self.truss.closing
        ends = [(close(a), close(b)) for a, b in ((start.points, points), (start.conjugates, conjugates))]
        size = bend * float(np.abs(points - start.points).mean())
        bends = [close(noise(self.rng, self.joints, 2) * size) for _ in range(2)]
        curve = [(a, b - a + c, -c) for (a, b), c in zip(ends, bends, strict=True)]
        with np.errstate(all="ignore"):
            try:
                turns = _followed(curve, start.turns, step)
            except np.linalg.LinAlgError:
                return None
        return None if turns is None or not _are_distinct(turns) else Place(points, conjugates, turns)


def _followed(curve: list[tuple[Complexes, ...]], turns: Complexes, step: float) -> Complexes | None:
    """By steps of Runge and Kutta, each corrected by Newton's method; the curve as polynomials of t, 0 to 1."""

    def at(t: float) -> list[Complexes]:
        return [a + t * (b + t * c) for a, b, c in curve]

    def slope(t: float, turns: Complexes) -> Complexes:
        change: Complexes = newton_step(*at(t), turns, [b + 2 * t * c for _, b, c in curve])[0]
        return -change

    t = 0.0
    while t < 1:
        step = min(step, 1 - t)
        k1 = slope(t, turns)
        k2 = slope(t + step / 2, turns + step / 2 * k1)
        k3 = slope(t + step / 2, turns + step / 2 * k2)
        trial = turns + step / 6 * (k1 + 2 * k2 + 2 * k3 + slope(t + step, turns + step * k3))
        misses = []
        for _ in range(2):
            change = newton_step(*at(t + step), trial)[0]
            misses.append(float((np.abs(change) / np.abs(trial)).max()))
            trial = trial - change
        if misses[0] < 1e-3 and misses[1] < 1e-5:
            t, turns = t + step, trial
            step *= 2 if misses[0] < 1e-5 else 1.3 if misses[0] < 1e-4 else 1
        elif (step := step / 2) < _SHORTEST:
            return None
    for _ in range(2):
        turns = turns - newton_step(*at(1.0), turns)[0]
    return turns if np.isfinite(turns).all() else None


def _are_distinct(turns: Complexes) -> bool:
    gaps = np.abs(turns[:, None] - turns) / (np.abs(turns[:, None]) + np.abs(turns))
    return bool((gaps.max(axis=2) + np.eye(len(turns))).min() > _SAME)


class Search:
    """Steps of the dimensions that make modes real."""

    def __init__(self, modes: Modes) -> None:
        self.modes, self.rng = modes, modes.rng

    def start(self, tries: int = 10) -> Place:
        """Of some random dimensions those with most real modes."""
        places = (self.modes.at(noise(self.rng, self.modes.joints, 2)) for _ in range(tries))
        return max((place for place in places if place is not None), key=lambda place: place.real.sum())

    def climbed(self, place: Place, steps: int = 400) -> Place:
        """The best of so many steps, fewer if all modes are real or nothing goes on."""
        best, reach, failures, idle = place, 0.05, 0, 0
        for _ in range(steps):
            if place.real.sum() > best.real.sum():
                best, idle = place, 0
            if place.real.all() or (idle := idle + 1) > 300:
                break
            chosen, points = self._step(place, reach, failures)
            fresh = self.modes.follow(place, points, points.conj(), bend=0.5, step=0.25)
            if fresh is not None and (_is_better(fresh, place, chosen) or self.rng.random() < 0.02):
                place, reach, failures = fresh, min(1.3 * reach, _LONGEST), 0
            else:
                reach, failures = 0.6 * reach, failures + 1
            if reach < 1e-4 or failures > 25:
                reach, failures = 0.05, 0
        return max(best, place, key=lambda place: place.real.sum())

    def _step(self, place: Place, reach: float, failures: int) -> tuple[int, Complexes]:
        """The mode that is to become real, one of the nearest, and the dimensions to try."""
        order = np.argsort(np.where(place.real, np.inf, place.defects))[: int((~place.real).sum())][::2]
        chosen = int(order[min(int(self.rng.exponential(0.7 + failures)), len(order) - 1)])
        turns = place.turns[[chosen]]
        downhill = -self._gradients(place, np.array([chosen]), 2 * np.log(np.abs(turns)) / turns)[0]
        fall = float(np.linalg.norm(downhill))
        step = downhill / fall
        if len(walls := self._walls(place)):
            step = step + walls.T @ nnls(walls.T, -step, maxiter=200)[0]
        random = self.rng.normal(size=len(step)) / np.sqrt(len(step))
        size = float(np.linalg.norm(step))
        step = random if size < 1e-3 else step / size + random * (0.25 + failures / 12)
        length, rate = reach * np.sqrt(len(step) / 2), float(step @ downhill)
        if rate > 0:
            length = min(length, 1.5 * place.defects[chosen] ** 2 / rate + 1e-4)
        points = place.points + length * step.reshape(2, -1, 2)[0] + 1j * length * step.reshape(2, -1, 2)[1]
        return chosen, points / np.abs(points).mean()

    def _walls(self, place: Place) -> Reals:
        """Directions of the dimensions in which the closest real modes part, of length 1."""
        real = np.flatnonzero(place.real)
        angles = np.angle(place.turns[real])
        gaps = np.angle(np.exp(1j * (angles[:, None] - angles)))
        rows, columns = np.triu_indices(len(real), 1)
        distances = np.linalg.norm(gaps[rows, columns], axis=1)
        nearest = np.argsort(distances)[:6]
        nearest = nearest[distances[nearest] < 0.6 * np.sqrt(place.turns.shape[1] + 1)]
        first, second, gap = rows[nearest], columns[nearest], -1j * gaps[rows, columns][nearest]
        ends = [self._gradients(place, real[k], gap / place.turns[real[k]]) for k in (first, second)]
        walls: Reals = ends[0] - ends[1]
        return walls / np.linalg.norm(walls, axis=1, keepdims=True)

    def _gradients(self, place: Place, modes: NDArray[np.int64], weights: Complexes) -> Reals:
        """The gradient of Re(weights · turns) by all x and y of the points, a row for each mode."""
        truss, turns = self.modes.truss, place.turns[modes]
        rows = len(truss.signs)
        first, second = truss.closing(place.points), truss.closing(place.conjugates)
        slopes = np.concatenate(
            [np.broadcast_to(first[:, 1:], (len(turns), rows, turns.shape[1])), -second[:, 1:] / turns[:, None] ** 2],
            axis=1,
        )
        dual = np.linalg.solve(slopes.transpose(0, 2, 1), weights[:, :, None])[:, :, 0]
        whole = np.concatenate([np.ones((len(turns), 1)), turns], axis=1)[:, np.array(truss.joints)]
        sign = np.array([-1, 1])
        ahead, behind = ((dual[:, half] @ truss.signs)[:, :, None] * sign for half in (slice(rows), slice(rows, None)))
        ahead, behind = ahead * whole, behind / whole
        parts = np.stack([(ahead + behind).real, (behind - ahead).imag], axis=1)
        return parts.reshape(len(turns), 4 * self.modes.joints)


def _is_better(fresh: Place, place: Place, chosen: int) -> bool:
    here, there = int(place.real.sum()), int(fresh.real.sum())
    return there > here or (there == here and fresh.defects[chosen] < place.defects[chosen])


def points_as_text(joints: Sequence[tuple[int, int]], points: Complexes, size: int = 1000) -> str:
    """Whole coordinates, link by link: the first joint of a link at its origin, the second one on its x axis.

    >>> points_as_text([(0, 1), (1, 2), (2, 0)], np.array([[0, 1], [2j, 0], [0.5, 1j]]), 10)
    '0,0 10,0; 0,0 22,0; 0,0 5,0'
    """
    links = []
    for link in range(1 + max(map(max, joints))):
        own = [points[k, joint.index(link)] for k, joint in enumerate(joints) if link in joint]
        turned = (np.array(own) - own[0]) * abs(own[1] - own[0]) / (own[1] - own[0]) * size
        links.append(" ".join(f"{round(z.real)},{round(z.imag)}" for z in turned))
    return "; ".join(links)


def points_of_text(joints: Sequence[tuple[int, int]], text: str) -> Complexes:
    """(joints, 2): the point of each joint on its first and on its second link.

    >>> points_of_text([(0, 1), (1, 2), (2, 0)], "0,0 10,0; 0,0 22,0; 0,0 5,0").tolist()
    [[0j, 0j], [(22+0j), 0j], [(5+0j), (10+0j)]]
    """
    own = [iter(link.split()) for link in text.split(";")]
    return np.array([[complex(*map(float, next(own[link]).split(","))) for link in joint] for joint in joints])


def joints_of_text(text: str) -> list[tuple[int, int]]:
    """Joints as pairs of links.

    >>> joints_of_text("0-1 1-2 2-0")
    [(0, 1), (1, 2), (2, 0)]
    """
    return [(int(a), int(b)) for a, b in (joint.split("-") for joint in text.split())]


def real_modes_of(joints: str, points: str, possible: int, seed: int = 1) -> int:
    """How many modes are real, all being followed from random complex dimensions.

    Raises ValueError if the paths fail.
    """
    pairs = joints_of_text(joints)
    dimensions = points_of_text(pairs, points)
    place = Modes(1 + max(map(max, pairs)), pairs, possible, seed).at(dimensions / np.abs(dimensions).mean())
    if place is None:
        raise ValueError(f"the modes of {joints} with {points} could not be followed")
    return int(place.real.sum())


def stored_rows() -> list[list[str]]:
    """The rows of the table as they are: links, joints, modes, real modes, points."""
    return list(csv.reader(TABLE.read_text(encoding="utf-8").splitlines()))[1:]


def main(links: int, seed: int = 0) -> None:
    """Look for better dimensions of each truss, and keep them in the table, with no more digits than are wanted."""
    for number, (size, joints, possible, real, _) in enumerate(stored_rows(), 1):
        if int(size) != links or real == possible:
            continue
        pairs = joints_of_text(joints)
        search = Search(Modes(links, pairs, int(possible), seed))
        best = search.climbed(search.start())
        texts = [points_as_text(pairs, best.points, 10**digits) for digits in (3, 4, 5)]
        found = [real_modes_of(joints, text, int(possible)) for text in texts]
        if max(found) > int(real):
            lines = TABLE.read_text(encoding="utf-8").splitlines()
            lines[number] = f'{links},{joints},{possible},{max(found)},"{texts[found.index(max(found))]}"'
            TABLE.write_text("\n".join([*lines, ""]), encoding="utf-8")
        print(joints, possible, max(*found, int(real)), flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
