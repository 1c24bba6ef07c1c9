"""Six-bars whose output rests: arcs of coupler curves that are nearly circles, a dyad from there to the output.

While the coupler point runs along an arc about K, a rod as long as the radius leaves its other pin at K at rest. All
numbers are those of a crank of length 1 at the origin with the frame line along x. docs/theory/synthesis-dwells.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals

_TURN = 72  # places over a turn of the crank
_PHI = 2 * np.pi * np.arange(_TURN) / _TURN
_LENGTHS = (1.2, 1.5, 1.8, 2.2, 2.7, 3.3, 4.0, 5.0)
"""Of coupler, rocker and frame of the crank-rockers whose curves are searched; the crank is 1."""
_POINTS = np.array([u + 1j * v for u, v in product(np.linspace(-1, 2, 13), np.linspace(-1.5, 1.5, 13))])
_POINTS = _POINTS[(np.abs(_POINTS) > 0.2) & (np.abs(_POINTS - 1) > 0.2)]
"""Coupler points, in units of the coupler from crank pin to rocker pin: not near a pin, whose path is a circle."""
_PER_FOUR_BAR = 6  # arcs that are kept of one four-bar
_WINDOW = 21  # places over the rest
_PLACES = 24  # directions in which the output is tried about K
_OUTPUTS = np.geomspace(0.5, 8, 14)  # lengths of the output rocker that are tried
_CLOSE = 2881  # places over a turn where the ends of a swing are sought
_STEP = 1e-7  # of a derivative by differences
_ITERATIONS = 80


@dataclass(frozen=True, kw_only=True)
class Arc:
    """A coupler curve and a part of it that is nearly a circle."""

    numbers: tuple[float, float, float, float, float]
    """Coupler, rocker, frame, and the coupler point from the crank pin, along the coupler and to its left."""
    start: float
    """The crank angle where the arc begins."""
    centre: complex
    radius: float
    deviation: float
    """How far the arc is from the circle, root mean square, as a part of the farthest that the curve is from it."""


def coupler_points(numbers: Reals, phi: Reals) -> Complexes:
    """Places of the coupler point: numbers (..., 5 or more) as of an `Arc`, crank angles (..., places)."""
    b, c, d, along, left = (numbers[..., k, None] for k in range(5))
    pin = np.exp(1j * phi)
    line = d - pin
    distance = np.abs(line)
    foot = (b * b - c * c + distance**2) / (2 * distance)
    coupler = line / distance * (foot + 1j * np.sqrt(np.maximum(b * b - foot * foot, 0))) / b
    return np.asarray(pin + coupler * (along + 1j * left))


def circles_through(z: Complexes, places: int) -> tuple[Complexes, Reals, Reals]:
    """Circles fitted to all arcs of so many places in a row of closed curves (..., N), by least squares (Kåsa).

    Returns centres, radii and deviations from the circle, root mean square to first order, each (..., N): entry k is
    the arc that begins at place k. Cost: O(N) for each curve, whatever the length of the arcs.
    """
    middle = z.mean(axis=-1, keepdims=True)
    x, y = (z - middle).real, (z - middle).imag
    s = x * x + y * y
    rows = np.stack([x, y, s, x * x, x * y, y * y, x * s, y * s, s * s])
    sums = np.cumsum(np.concatenate([np.zeros_like(rows[..., :1]), rows, rows[..., : places - 1]], axis=-1), axis=-1)
    x, y, s, xx, xy, yy, xs, ys, ss = (sums[..., places:] - sums[..., :-places]) / places
    xx, xy, yy, xs, ys, ss = xx - x * x, xy - x * y, yy - y * y, xs - x * s, ys - y * s, ss - s * s
    with np.errstate(divide="ignore", invalid="ignore"):
        det = xx * yy - xy * xy
        u, v = (yy * xs - xy * ys) / (2 * det), (xx * ys - xy * xs) / (2 * det)
        radius = np.sqrt(s - 2 * (u * x + v * y) + u * u + v * v)
        rest = ss - 4 * (u * xs + v * ys) + 4 * (u * u * xx + 2 * u * v * xy + v * v * yy)
        return middle + u + 1j * v, radius, np.sqrt(np.maximum(rest, 0)) / (2 * radius)


def circular_arcs(rest: float, least: float, longest: float, number: int) -> list[Arc]:
    """The arcs over a crank angle that are nearest to circles, the best first. Cost: 2 s.

    Args:
        rest: the crank angle, in radians.
        least: the transmission angle that the four-bar keeps, in radians.
        longest: of coupler, rocker and frame.
        number: of arcs.
    """
    places = max(4, round(rest / (2 * np.pi) * _TURN) + 1)
    ranked: list[tuple[float, Arc]] = []
    for b, c, d in product([length for length in _LENGTHS if length <= longest], repeat=3):
        ends = [abs(b * b + c * c - (d - a) ** 2) / (2 * b * c) for a in (1, -1)]
        if 1 + max(b, c, d) >= b + c + d - max(b, c, d) or max(ends) >= np.cos(least):
            continue
        numbers = np.stack([np.broadcast_to(n, _POINTS.shape) for n in (b, c, d)], axis=1)
        numbers = np.column_stack([numbers, b * _POINTS.real, b * _POINTS.imag])
        z = coupler_points(numbers, _PHI)
        centres, radii, misses = circles_through(z, places)
        off = np.abs(np.abs(z[:, None, :] - centres[:, :, None]) - radii[:, :, None]).max(axis=-1)
        share = np.where((radii > 0.5) & (radii < longest) & (off > 0), misses / off, np.inf)
        begin = np.nanargmin(np.where(np.isnan(share), np.inf, share), axis=1)
        own = np.arange(len(_POINTS))
        for k in np.argsort(share[own, begin])[:_PER_FOUR_BAR]:
            at = begin[k]
            if np.isfinite(share[k, at]):
                arc = Arc(
                    numbers=tuple(numbers[k].tolist()),
                    start=float(_PHI[at]),
                    centre=complex(centres[k, at]),
                    radius=float(radii[k, at]),
                    deviation=float(share[k, at]),
                )
                ranked.append((round(float(share[k, at]), 12), arc))
    ranked.sort(key=lambda row: row[0])
    return [arc for _, arc in ranked[:number]]


Followed = tuple[Reals, Reals]
"""Values of the output, angle or travel, and the cosine of the transmission angle at it; each (..., places)."""


@dataclass(frozen=True)
class OutputKind:
    """A kind of output: how the rod moves it, and where it can be put."""

    joint: str
    """Its joint on the frame."""
    _: KW_ONLY
    follow: Callable[[Complexes, Reals, int], Followed]
    """From coupler points, the numbers behind those of the arc (rod, then its own) and the side."""
    own: Callable[[complex], NDArray[np.float64]]
    """Numbers of the output to be tried about a centre, (tries, numbers)."""
    pin: Callable[[Reals, Reals], Complexes]
    """Where the pin of the rod lies, from the numbers behind those of the arc and the value of the output."""
    lengths: Callable[[Reals], Reals]
    """The lengths that it adds to the linkage, from all numbers."""
    fixed_size: bool
    """Whether its range is a part of the task, not a scale."""


def _follow_rocker(z: Complexes, numbers: Reals, side: int) -> Followed:
    rod, x, y, own = (numbers[..., k, None] for k in range(4))
    line = z - (x + 1j * y)
    distance = np.abs(line)
    with np.errstate(divide="ignore", invalid="ignore"):
        opening = (own * own + distance**2 - rod * rod) / (2 * own * distance)
    angle = np.unwrap(np.angle(line), axis=-1) + side * np.arccos(np.clip(opening, -1, 1))
    return angle, (rod * rod + own * own - distance**2) / (2 * rod * own)


def _follow_slider(z: Complexes, numbers: Reals, side: int) -> Followed:
    rod, direction, offset = (numbers[..., k, None] for k in range(3))
    seen = np.exp(-1j * direction) * z
    across = (seen.imag - offset) / rod
    return seen.real + side * rod * np.sqrt(np.maximum(1 - across * across, 0)), across


def _pin_of_rocker(numbers: Reals, value: Reals) -> Complexes:
    _, x, y, own = (numbers[..., k] for k in range(4))
    return np.asarray(x + 1j * y + own * np.exp(1j * value))


def _pin_of_slider(numbers: Reals, value: Reals) -> Complexes:
    _, direction, offset = (numbers[..., k] for k in range(3))
    return np.asarray(np.exp(1j * direction) * (value + 1j * offset))


def _rockers_about(centre: complex) -> Reals:
    turns = 2 * np.pi * np.arange(_PLACES) / _PLACES
    pivots = centre + np.exp(1j * turns)[:, None] * _OUTPUTS
    own = np.broadcast_to(_OUTPUTS, pivots.shape)
    return np.stack([pivots.real.ravel(), pivots.imag.ravel(), own.ravel()], axis=1)


def _slides_about(centre: complex) -> Reals:
    turns = np.pi * np.arange(_PLACES) / _PLACES
    return np.stack([turns, (np.exp(-1j * turns) * centre).imag], axis=1)


def _four_bar_lengths(numbers: Reals) -> list[Reals]:
    b, c, d, along, left = (numbers[..., k] for k in range(5))
    return [b, c, d, np.hypot(along, left), np.hypot(along - b, left), numbers[..., 6]]


def _rocker_lengths(numbers: Reals) -> Reals:
    d, (x, y, own) = numbers[..., 2], (numbers[..., k] for k in (7, 8, 9))
    return np.stack([*_four_bar_lengths(numbers), own, np.hypot(x, y), np.hypot(x - d, y)], axis=-1)


ROCKER = OutputKind(
    "R(output-frame)",
    follow=_follow_rocker,
    own=_rockers_about,
    pin=_pin_of_rocker,
    lengths=_rocker_lengths,
    fixed_size=True,
)
SLIDER = OutputKind(
    "P(output-frame)",
    follow=_follow_slider,
    own=_slides_about,
    pin=_pin_of_slider,
    lengths=lambda numbers: np.stack(_four_bar_lengths(numbers), axis=-1),
    fixed_size=False,
)


class RestingSixBar(NamedTuple):
    """A six-bar by its numbers: coupler, rocker, frame, coupler point, start of the rest, rod, and its output's own."""

    kind: OutputKind
    numbers: Reals
    side: int

    def outputs(self, phi: Reals) -> Followed:
        """Values of the output at crank angles, and the cosine of the transmission angle at it."""
        return self.kind.follow(coupler_points(self.numbers, phi), self.numbers[6:], self.side)

    def pin(self, phi: Reals) -> Complexes:
        """Places of the rod's pin on the output at crank angles."""
        return self.kind.pin(self.numbers[6:], self.outputs(phi)[0])


def placed_outputs(arc: Arc, kind: OutputKind, swing: float, least: float, number: int = 2) -> list[RestingSixBar]:
    """Outputs on an arc that keep a transmission angle over the whole turn, with a swing near the wanted one."""
    z = coupler_points(np.array(arc.numbers), _PHI)
    tries = kind.own(arc.centre)
    numbers = np.column_stack([np.full(len(tries), arc.radius), tries])
    first = round(arc.start / (2 * np.pi) * _TURN) % _TURN
    placed: list[tuple[float, RestingSixBar]] = []
    for side in (1, -1):
        values, cosine = kind.follow(z, numbers, side)
        good = np.abs(cosine).max(axis=1) < np.cos(least)
        good &= np.abs(values[:, -1] - values[:, 0]) < 3  # it swings, it does not turn
        # The rod reaches two places: the output's pin is to rest at the centre.
        good &= np.abs(kind.pin(numbers, values[:, first]) - arc.centre) < 0.2 * arc.radius
        size = np.ptp(values, axis=1)
        cost = np.abs(np.log(size / swing)) if kind.fixed_size else np.abs(cosine).max(axis=1)
        for k in np.flatnonzero(good):
            own = np.concatenate([arc.numbers, [arc.start], numbers[k]])
            placed.append((round(float(cost[k]), 9), RestingSixBar(kind, own, side)))
    placed.sort(key=lambda row: row[0])
    return [six_bar for cost, six_bar in placed[:number] if cost < 0.5 or not kind.fixed_size]


def with_least_deviation(
    start: RestingSixBar, rest: float, swing: float, least: float, *, shortest: float, longest: float
) -> RestingSixBar:
    """The six-bar nearby whose output strays least from a value during the rest, by sequential quadratic programming.

    Its range stays that of the task, transmission angles and lengths keep their limits. Cost: 0.3 s.
    """
    from scipy.optimize import minimize

    kind, side, count = start.kind, start.side, len(start.numbers)
    window = np.linspace(0, rest, _WINDOW)
    bound = np.cos(least)

    def followed(rows: Reals) -> tuple[Reals, Reals, Reals]:
        phi = np.concatenate([rows[:, 5:6] + window, np.broadcast_to(_PHI, (len(rows), _TURN))], axis=1)
        values, cosine = kind.follow(coupler_points(rows, phi), rows[:, 6:], side)
        resting, turning = (np.unwrap(part, axis=1) for part in (values[:, :_WINDOW], values[:, _WINDOW:]))
        return resting, turning, cosine[:, _WINDOW:]

    def limits(rows: Reals) -> Reals:
        resting, turning, cosine = followed(rows[:, :count])
        size = swing if kind.fixed_size else np.ptp(turning, axis=1)[:, None]
        band, middle = rows[:, count, None], rows[:, count + 1, None]
        off = (resting - middle) / size
        b, c, d = (rows[:, k] for k in range(3))
        ends = np.stack([(b * b + c * c - (d - a) ** 2) / (2 * b * c) for a in (1, -1)], axis=1)
        cosines = np.concatenate([cosine, ends], axis=1)
        lengths = kind.lengths(rows)
        parts = [band - off, band + off, bound - cosines, bound + cosines]
        return np.concatenate([*parts, np.log(lengths / shortest), np.log(longest / lengths)], axis=1)

    def sizes(rows: Reals) -> Reals:
        return np.asarray(np.ptp(followed(rows[:, :count])[1], axis=1) / swing - 1)[:, None]

    def constraint(function: Callable[[Reals], Reals], kind_of: str) -> dict[str, object]:
        def derivative(x: Reals) -> Reals:
            rows = function(np.vstack([x, x + _STEP * np.eye(len(x))]))
            return np.asarray((rows[1:] - rows[0]).T / _STEP)

        return {"type": kind_of, "fun": lambda x: function(x[None])[0], "jac": derivative}

    resting, turning, _ = followed(start.numbers[None])
    size = swing if kind.fixed_size else float(np.ptp(turning))
    begin = np.concatenate([start.numbers, [np.ptp(resting) / 2 / size, (resting.max() + resting.min()) / 2]])
    cost = np.eye(count + 2)[count] * 100
    constraints = [constraint(limits, "ineq"), *([constraint(sizes, "eq")] if kind.fixed_size else [])]
    with np.errstate(all="ignore"):
        answer = minimize(
            lambda x: float(cost @ x),
            begin,
            jac=lambda _: cost,
            constraints=constraints,
            method="SLSQP",
            options={"maxiter": _ITERATIONS, "ftol": 1e-10},
        )
    return RestingSixBar(kind, np.asarray(answer.x[:count]), side)


def with_swing(six_bar: RestingSixBar, rest: float, swing: float) -> RestingSixBar:
    """The six-bar with exactly this swing: its output rocker longer or shorter, its pin at rest in the same place.

    Raises `ValueError` where no length nearby has it.
    """
    from scipy.optimize import brentq

    numbers = six_bar.numbers
    pivot, own = complex(numbers[7], numbers[8]), numbers[9]
    pin = six_bar.pin(numbers[5] + np.array([0, rest / 2]))[1]

    def scaled(share: float) -> RestingSixBar:
        moved = pin + share * (pivot - pin)
        return six_bar._replace(numbers=np.concatenate([numbers[:7], [moved.real, moved.imag, share * own]]))

    share = brentq(lambda s: swing_of(scaled(s)) - swing, 0.9, 1.1, xtol=1e-15, rtol=1e-14)
    return scaled(float(share))


def swing_of(six_bar: RestingSixBar) -> float:
    """The range of the output over a turn of the crank, to rounding: extremes of a sample, looked at more closely."""
    phi = np.linspace(0, 2 * np.pi, _CLOSE)  # fine: a rest has several extremes that hardly differ
    values = np.unwrap(six_bar.outputs(phi)[0])
    ends = []
    for sign in (1, -1):
        at, width = float(phi[np.argmax(sign * values)]), float(phi[1])
        best = -np.inf
        for _ in range(8):
            near = at + np.linspace(-width, width, 33)
            seen = sign * np.unwrap(six_bar.outputs(near)[0])
            k = int(np.argmax(seen))
            at, width, best = float(near[k]), width / 10, float(seen[k])
        turns = 2 * np.pi * round((best - np.max(sign * values)) / (2 * np.pi)) if six_bar.kind.fixed_size else 0.0
        ends.append(best - turns)
    return ends[0] + ends[1]
