"""What a designer asks for: positions of a body, points of a path, a function, dead centres, a rest.

Every task is a value, checked when it is constructed; lengths are in the task's unit, angles in radians.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from itertools import combinations
from math import isfinite, pi
from typing import Any

import numpy as np

from gruebler.base.angles import warn_of_degrees
from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.immutable import settle
from gruebler.base.text import Message, joined_by_and, message
from gruebler.design.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.design.synthesis.target_orders import Ranks

Pair = tuple[float, float]
_Pairs = tuple[tuple[float, ...], tuple[float, ...], bool, bool]  # inputs, outputs, whether their starts are given

EQUAL_POINTS = message("points {first} and {second} are equal")
SAME = 1e-9
"""Two points nearer than this part of the task's size are one: designs are held to the same bound."""
LARGEST = 1e100
PIVOTS_OF_SIX_BARS = {5: (2, 1), 6: (2, 0), 7: (1, 0), 8: (0, 0)}
"""So many fixed and moving pivots are given where six-bars carry a body through positions exactly."""
MOST_PAIRS = 11
"""Precision pairs that a linkage coordinates exactly, with both starts free."""
_LONGEST_DWELL = 5 * pi / 3  # an output that rests longer has no time to move
MOST_POINTS = 9
"""A coupler curve of a four-bar passes through nine general points; more are met as well as possible."""


def _number(value: object, where: Message | str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | np.number):
        raise SynthesisError("{where}: expected a number, but found {value!r}", where=where, value=str(value)[:40])
    number = float(value)
    if not (isfinite(number) and abs(number) < LARGEST):
        raise SynthesisError("{where}: expected a number below 1e100, but found {value!r}", where=where, value=value)
    return number


def _row(row: object, where: Message, count: int) -> tuple[float, ...]:
    if isinstance(row, str) or not isinstance(row, Sequence | np.ndarray) or len(row) != count:
        raise SynthesisError(
            "{where}: expected {count} numbers, but found {row!r}", where=where, count=count, row=str(row)[:40]
        )
    return tuple(_number(value, where) for value in row)


_ENTRIES = {"points": message("point {number}"), "positions": message("position {number}")}


def numbered_entry(key: str, k: int) -> Message:
    """An entry of a key of a task file, by its number from 0, as messages name it: they count from 1.

    >>> print(numbered_entry("points", 0), numbered_entry("tolerances", 1), sep=", ")
    point 1, tolerances 2
    """
    return _ENTRIES.get(key, message("{key} {number}", key=key)).filled(number=k + 1)


def _entries(task: object, key: str) -> tuple[object, ...]:
    """The entries of a field that is a list; None stands for an empty one."""
    values: Any = getattr(task, key)
    if values is None:
        return ()
    if isinstance(values, str) or not isinstance(values, Iterable) or getattr(values, "ndim", 1) == 0:
        raise SynthesisError("{key}: expected a list, but found {found!r}", key=key, found=str(values)[:40])
    return tuple(values)


def _numbers(task: object, key: str) -> tuple[float, ...]:
    return tuple(_number(value, numbered_entry(key, k)) for k, value in enumerate(_entries(task, key)))


def number_rows(task: object, key: str, count: int) -> tuple[tuple[float, ...], ...]:
    """The entries of a field that is a list of so many numbers each."""
    return tuple(_row(row, numbered_entry(key, k), count) for k, row in enumerate(_entries(task, key)))


def _check_order(task: PositionTask | PathTask, curve: bool) -> None:
    """Each target has a whole number or None as its place in the order; a whole curve has none to choose."""
    ranks: tuple[Any, ...] = _entries(task, "order")
    settle(task, order=ranks)
    if ranks and curve:
        raise SynthesisError("order: the points of a whole curve are passed in the order of the list")
    if ranks and len(ranks) != len(task):
        raise SynthesisError(
            "order: expected one for each of the {targets} targets, but found {count}",
            targets=len(task),
            count=len(ranks),
        )
    for k, rank in enumerate(ranks):
        if rank is not None and (isinstance(rank, bool) or not isinstance(rank, int | np.integer)):
            raise SynthesisError(
                "{where}: expected a whole number, or nothing, but found {found!r}",
                where=numbered_entry("order", k),
                found=str(rank)[:40],
            )
    settle(task, order=tuple(None if rank is None else int(rank) for rank in ranks))


def _size(z: Complexes) -> float:
    """The largest distance from the first point."""
    return float(np.abs(z - z[0]).max(initial=0.0))


@dataclass(frozen=True)
class PositionTask:
    """A body that is to be carried through positions: each ``(x, y, angle)``, the angle in radians.

    With two to four positions pivots may be chosen: ``moving_pivots`` where they lie on the body in its first position,
    ``fixed_pivots`` on the frame; beside a single one the best others are sought. With four the nearest points of
    Burmester's curves are taken; ``curve_parameters`` are places along the circle-point curve, from 0 to 1. Of six-bars
    of Watt's first kind both fixed pivots are given with five or six positions, first that of the crank, with seven
    that of the ternary rocker, and with five the pin of the body on the coupler. ``order`` gives each position its
    place in the order in which they are passed, the same to those that may follow in any order, None at any time; by
    default that of the list.

    Raises `SynthesisError` for fewer than two positions and for two equal ones, naming them.

    >>> task = PositionTask([(0, 0, 0), (2, 1, 0.4), (3, 1, 0.9)])
    >>> len(task), task.size
    (3, 3.1622776601683795)
    """

    positions: tuple[tuple[float, float, float], ...]
    _: KW_ONLY
    moving_pivots: tuple[Pair, ...] = ()
    fixed_pivots: tuple[Pair, ...] = ()
    unit: str = "mm"
    curve_parameters: tuple[float, ...] = ()
    order: Ranks = ()

    def __post_init__(self) -> None:
        rows = number_rows(self, "positions", 3)
        settle(self, positions=rows)
        settle(self, **{name: number_rows(self, name, 2) for name in ("moving_pivots", "fixed_pivots")})
        if len(rows) < 2:
            raise SynthesisError("positions: expected at least two, but found {count}", count=len(rows))
        pivots = len(self.fixed_pivots), len(self.moving_pivots)
        if any(pivots) and len(rows) > 4 and pivots != PIVOTS_OF_SIX_BARS.get(len(rows)):
            raise SynthesisError(
                "pivots can be chosen for two to four positions, and those of six-bars for five to seven, but not "
                "these for {count}",
                count=len(rows),
            )
        for key in ("fixed_pivots", "moving_pivots"):
            for first, other in combinations(getattr(self, key), 2):
                if abs(complex(*first) - complex(*other)) <= SAME * self.size:
                    raise SynthesisError("{key}: the two pivots coincide", key=key)
        places = _numbers(self, "curve_parameters")
        settle(self, curve_parameters=places)
        if places and len(rows) != 4:
            raise SynthesisError(
                "{key}: Burmester's curves belong to four positions, not to {count}",
                key="curve_parameters",
                count=len(rows),
            )
        for k, place in enumerate(places):
            if not 0 <= place <= 1:
                raise SynthesisError(
                    "{where}: expected 0 to 1, but found {value:g}",
                    where=numbered_entry("curve_parameters", k),
                    value=place,
                )
        _check_order(self, curve=False)
        warn_of_degrees("positions", self.angles, once=True)
        size = self.size
        for k, (z, turn) in enumerate(zip(self.origins, self.turns, strict=True)):
            for m in range(k):
                if abs(z - self.origins[m]) <= SAME * size and abs(turn - self.turns[m]) <= SAME:
                    raise SynthesisError("positions {m} and {k} are equal", m=m + 1, k=k + 1)

    def __len__(self) -> int:
        return len(self.positions)

    def shifted(self, x: float, y: float) -> PositionTask:
        """The same task at another place of the plane."""
        return replace(
            self,
            positions=tuple((u + x, v + y, angle) for u, v, angle in self.positions),
            moving_pivots=tuple((u + x, v + y) for u, v in self.moving_pivots),
            fixed_pivots=tuple((u + x, v + y) for u, v in self.fixed_pivots),
        )

    @property
    def origins(self) -> Complexes:
        """(positions,) the body's origin as x + iy."""
        return np.array([complex(x, y) for x, y, _ in self.positions])

    @property
    def angles(self) -> Reals:
        """(positions,) the body's angle."""
        return np.array([angle for *_, angle in self.positions])

    @property
    def turns(self) -> Complexes:
        """(positions,) cosine + i sine of the angle."""
        return np.asarray(np.exp(1j * self.angles))

    @property
    def size(self) -> float:
        """The largest distance of an origin from the first; 1 if they all coincide."""
        return _size(self.origins) or 1.0


_FREE_FOR_SOME = ("angles", "crank_angles", "output_angles", "tolerances")
"""What a path gives for each target, or None where it is free."""


@dataclass(frozen=True)
class PathTask:
    """Points through which a point of the coupler is to pass, in this order unless another is given.

    Args of the constructor, all but the first optional: ``angles`` of the coupler, one for each point or None where it
    is free (mixed tasks); ``crank_angles`` for prescribed timing, one for each point, only their differences count;
    ``output_angles`` of the rocker likewise; ``fixed_pivots``, one or two of them; ``closed`` for a whole curve of many
    points. A point is None where only angles are given. ``tolerances`` say how far each target may be missed, angles as
    arcs of the task's size: 0 exactly, None as near as possible, which ``weights`` weigh. ``order`` as of
    `PositionTask`; a whole curve has none.

    Raises `SynthesisError` for two equal points and for angles, pivots or tolerances that do not fit.

    >>> len(PathTask([(0, 0), (1, 2), (3, 3)]))
    3
    """

    points: tuple[Pair | None, ...]
    _: KW_ONLY
    angles: tuple[float | None, ...] = ()
    crank_angles: tuple[float | None, ...] = ()
    fixed_pivots: tuple[Pair, ...] = ()
    closed: bool = False
    unit: str = "mm"
    output_angles: tuple[float | None, ...] = ()
    tolerances: tuple[float | None, ...] = ()
    weights: tuple[float, ...] = ()
    order: Ranks = ()

    def __post_init__(self) -> None:
        given = enumerate(_entries(self, "points"))
        rows = tuple(None if row is None else _row(row, numbered_entry("points", k), 2) for k, row in given)
        settle(self, points=rows)
        pivots = number_rows(self, "fixed_pivots", 2)
        settle(self, fixed_pivots=pivots)
        for name in _FREE_FOR_SOME:
            free = enumerate(_entries(self, name))
            settle(self, **{name: tuple(None if a is None else _number(a, numbered_entry(name, k)) for k, a in free)})
        settle(self, weights=_numbers(self, "weights"))
        placed = sum(row is not None for row in rows)
        if placed < 2:
            raise SynthesisError("points: expected at least two, but found {count}", count=placed)
        for name in (*_FREE_FOR_SOME, "weights"):
            values = getattr(self, name)
            if values and len(values) != len(rows):
                raise SynthesisError(
                    "{name}: expected one for each of the {points} points, but found {count}",
                    name=name,
                    points=len(rows),
                    count=len(values),
                )
        if len(pivots) > 2:
            raise SynthesisError("{key}: expected one or two, but found {count}", key="fixed_pivots", count=len(pivots))
        if len(pivots) == 2 and abs(complex(*pivots[0]) - complex(*pivots[1])) <= SAME * self.size:
            raise SynthesisError("{key}: the two pivots coincide", key="fixed_pivots")
        for name in ("tolerances", "weights"):
            for k, value in enumerate(getattr(self, name)):
                if value is not None and value < 0:
                    raise SynthesisError(
                        "{where}: expected at least 0, but found {value:g}", where=numbered_entry(name, k), value=value
                    )
        if self.weights and not any(self.weights):
            raise SynthesisError("{key}: expected one above 0 at least", key="weights")
        _check_order(self, curve=self.closed or len(rows) > MOST_POINTS)
        self._check_distinct()
        self._check_timing()
        warn_of_degrees("angles", [angle for angle in self.angles if angle is not None], once=True)

    def _check_distinct(self) -> None:
        z = self.z
        limit = SAME * self.size
        curve = self.closed or len(z) > MOST_POINTS  # a whole curve may cross itself
        for k in range(len(z)):
            others = ([k - 1] if k or self.closed else []) if curve else range(k)
            for m in others:
                if abs(z[m] - z[k]) <= limit and not self._turned(m, k):
                    first, second = sorted((m % len(z), k))
                    raise SynthesisError(EQUAL_POINTS, first=first + 1, second=second + 1)

    def _turned(self, m: int, k: int) -> bool:
        """Whether the coupler has different angles at two points, so that these may coincide."""
        if not self.angles:
            return False
        first, second = self.angles[m], self.angles[k]
        return first is not None and second is not None and abs(np.exp(1j * first) - np.exp(1j * second)) > SAME

    def _check_timing(self) -> None:
        timing = [angle for angle in self.crank_angles if angle is not None]
        steps = np.diff(timing)
        if len(steps) and not ((steps > 0).all() or (steps < 0).all()):
            raise SynthesisError("crank_angles: the timing is contradictory, the crank has to turn one way throughout")
        if len(steps) and abs(timing[-1] - timing[0]) >= 2 * pi:
            raise SynthesisError("crank_angles: the timing is contradictory, all points lie within one turn of 2 pi")
        if self.order and len(timing) == len(self.points):
            raise SynthesisError("order: the crank angles of all points give it already")
        pairs = zip(self.order, self.crank_angles, strict=False)
        ranks = [rank for rank, angle in pairs if rank is not None and angle is not None]
        turned = np.diff([*ranks, *ranks[:1]])  # a lap may begin with any of them, and lead either way
        if min((turned > 0).sum(), (turned < 0).sum()) > 1:
            raise SynthesisError("order: the crank angles of some points give them another one")

    def __len__(self) -> int:
        return len(self.points)

    def shifted(self, x: float, y: float) -> PathTask:
        """The same task at another place of the plane."""
        points = tuple(None if point is None else (point[0] + x, point[1] + y) for point in self.points)
        return replace(self, points=points, fixed_pivots=tuple((u + x, v + y) for u, v in self.fixed_pivots))

    @property
    def z(self) -> Complexes:
        """(points,) as x + iy; NaN where no point is given."""
        return np.array([complex(*point) if point else complex(np.nan, np.nan) for point in self.points])

    @property
    def size(self) -> float:
        """The largest distance of a point from the first."""
        return _size(self.z[~np.isnan(self.z)]) or 1.0

    @property
    def mixed(self) -> bool:
        """Whether targets are of several kinds, or not all to be met alike."""
        holes = None in self.points or None in self.crank_angles
        return holes or bool(self.output_angles or self.tolerances or self.weights)


@dataclass(frozen=True)
class FunctionTask:
    """Two quantities to be coordinated: pairs of an input (crank angle) and an output (angle, or travel of a slider).

    ``inputs`` and ``outputs`` are precision pairs. ``start_input`` and ``start_output`` say whether the values are
    absolute (True) or counted from a start that is free (False). ``output`` is ``angle`` or ``travel``.

    Raises `SynthesisError` for fewer than two pairs, for equal inputs, and for more than the four-bar can answer.

    >>> FunctionTask([0.1, 0.5, 0.9], outputs=[0.2, 0.4, 1.0]).output
    'angle'
    """

    inputs: tuple[float, ...]
    _: KW_ONLY
    outputs: tuple[float, ...]
    output: str = "angle"
    start_input: bool = True
    start_output: bool = True
    unit: str = "mm"
    law: FunctionLaw | None = None
    """The function whose values at Chebyshev's spacing the pairs are; `function_task` makes such a task."""

    def __post_init__(self) -> None:
        settle(self, **{name: _numbers(self, name) for name in ("inputs", "outputs")})
        if len(self.inputs) != len(self.outputs):
            raise SynthesisError(
                "a function task needs as many inputs as outputs, but found {inputs} inputs and {outputs} outputs",
                inputs=len(self.inputs),
                outputs=len(self.outputs),
            )
        if len(self.inputs) < 2:
            raise SynthesisError("inputs: expected at least two, but found {count}", count=len(self.inputs))
        if self.output not in ("angle", "travel"):
            raise SynthesisError("output: expected 'angle' or 'travel', but found {output!r}", output=self.output)
        for k, value in enumerate(self.inputs):
            for m in range(k):
                if abs(value - self.inputs[m]) <= SAME:
                    raise SynthesisError("inputs {m} and {k} are equal", m=m + 1, k=k + 1)
        warn_of_degrees("inputs", self.inputs, path=True)
        if self.output == "angle":
            warn_of_degrees("outputs", self.outputs, once=True)
        if self.law is not None and _pairs_of(self.law, len(self)) != self._pairs:
            raise SynthesisError("the pairs are not those of the function at Chebyshev's spacing")

    @property
    def _pairs(self) -> _Pairs:
        return self.inputs, self.outputs, self.start_input, self.start_output

    def __len__(self) -> int:
        return len(self.inputs)


def _pairs_of(law: FunctionLaw, count: int) -> _Pairs:
    x = chebyshev_spacing(*law.interval, count)
    starts = law.input_start is not None, law.output_start is not None
    return (tuple(law.inputs(x).tolist()), tuple(law.outputs(x).tolist()), *starts)


def function_task(law: FunctionLaw, count: int = 5, *, output: str = "angle", unit: str = "mm") -> FunctionTask:
    """The precision pairs of a function at Chebyshev's spacing.

    >>> swings = {"input_swing": 1.0, "output_swing": 1.0, "input_start": 0.8, "output_start": 0.9}
    >>> function_task(FunctionLaw("log10(x)", interval=(1, 2), **swings), 3).inputs
    (0.866987..., 1.3, 1.733012...)
    """
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_PAIRS:
        raise SynthesisError(
            "{key}: expected 2 to {most} precision points, but found {count!r}",
            key="precision_points",
            most=MOST_PAIRS,
            count=count,
        )
    inputs, outputs, start_input, start_output = _pairs_of(law, count)
    return FunctionTask(
        inputs, outputs=outputs, output=output, start_input=start_input, start_output=start_output, unit=unit, law=law
    )


@dataclass(frozen=True)
class DeadCentreTask:
    """A crank that drives a rocker or slider to and fro: its swing or stroke, and the crank angle between dead centres.

    Exactly one of ``swing`` (of a rocker) and ``stroke`` (of a slider), exactly one of ``crank_angle`` and
    ``time_ratio`` (slow to quick travel, at least 1). The crank angle of a rocker is that in which rocker and crank
    turn the same way; with a time ratio this is the slower travel.

    >>> DeadCentreTask(swing=1.0, time_ratio=1.2).angle
    3.4271...
    """

    _: KW_ONLY
    swing: float | None = None
    stroke: float | None = None
    crank_angle: float | None = None
    time_ratio: float | None = None
    unit: str = "mm"

    def __post_init__(self) -> None:
        _check_reach(self)
        _check_one(self, ("crank_angle", "time_ratio"))
        _check_angle(self, "crank_angle", 2 * pi)
        if self.time_ratio is not None and not self.time_ratio >= 1:
            raise SynthesisError(
                "{key}: expected slow to quick, at least 1, but found {time_ratio:g}",
                key="time_ratio",
                time_ratio=self.time_ratio,
            )

    @property
    def reach(self) -> float:
        """The swing in radians, or the stroke."""
        reach = self.stroke if self.swing is None else self.swing
        assert reach is not None
        return reach

    @property
    def angle(self) -> float:
        """The crank angle between the dead centres, in radians."""
        if self.crank_angle is not None:
            return self.crank_angle
        assert self.time_ratio is not None
        return 2 * pi * self.time_ratio / (1 + self.time_ratio)


@dataclass(frozen=True)
class DwellTask:
    """An output that rests while the crank turns on by ``dwell``, and swings or travels in the rest of its turn.

    Exactly one of ``swing`` (of a rocker, below half a turn) and ``stroke`` (of a slider). Angles in radians.

    >>> DwellTask(dwell=2.0, swing=0.5).stroke is None
    True
    """

    _: KW_ONLY
    dwell: float
    swing: float | None = None
    stroke: float | None = None
    unit: str = "mm"

    def __post_init__(self) -> None:
        settle(self, dwell=_number(self.dwell, "dwell"))
        _check_reach(self)
        _check_angle(self, "dwell", _LONGEST_DWELL)


def _check_one(task: DeadCentreTask | DwellTask, names: tuple[str, str]) -> None:
    """Exactly one of two fields is given, and it is a number."""
    present = [name for name in names if getattr(task, name) is not None]
    if len(present) != 1:
        raise SynthesisError(
            "expected exactly one of {names}, but found {present}",
            names=joined_by_and(names),
            present=joined_by_and(present) if present else message("none"),
        )
    settle(task, **{present[0]: _number(getattr(task, present[0]), present[0])})


def _check_reach(task: DeadCentreTask | DwellTask) -> None:
    """The output has a swing below half a turn or a stroke."""
    _check_one(task, ("swing", "stroke"))
    _check_angle(task, "swing", pi)
    if task.stroke is not None and not task.stroke > 0:
        raise SynthesisError(
            "{key}: expected a positive length, but found {stroke:g}", key="stroke", stroke=task.stroke
        )


def _check_angle(task: DeadCentreTask | DwellTask, key: str, most: float) -> None:
    """An angle, if it is given, lies between 0 and the most, both excluded."""
    angle = getattr(task, key)
    if angle is not None and not 0 < angle < most:
        raise SynthesisError(
            "{key}: expected an angle between {low} and {high} degrees, but found {angle:g} degrees",
            key=key,
            low=0,
            high=round(np.degrees(most)),
            angle=np.degrees(angle),
        )


Task = PositionTask | PathTask | FunctionTask | DeadCentreTask | DwellTask


def output_travels(task: Task) -> bool:
    """Whether the output of a task slides."""
    if isinstance(task, DeadCentreTask | DwellTask):
        return task.swing is None
    return isinstance(task, FunctionTask) and task.output == "travel"


def gives_lengths(task: Task) -> bool:
    """Whether a task has lengths; angles alone are met by linkages of any size."""
    return output_travels(task) or not isinstance(task, DeadCentreTask | DwellTask | FunctionTask)
