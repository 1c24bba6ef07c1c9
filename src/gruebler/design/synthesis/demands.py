"""What an accepted design has to do besides meeting its targets, and which linkages of many do it.

docs/theory/synthesis.md defines the criteria.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations
from math import degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.immutable import settle
from gruebler.base.text import Message, joined_by_and, message
from gruebler.design.synthesis.results import EXACT, NEAR_PIVOTS, in_order_of
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.targets import GuidedCurve
from gruebler.design.synthesis.tasks import PathTask, PositionTask, Task, output_travels

BUILDABLE = 20.0
"""The longest length by the shortest, as a workshop accepts it; other ratios can be demanded."""
EXACT_AT_MOST = 1e-6
"""With larger tolerances targets are approached, not met: the whole curve within the tolerance counts."""
FULL_TURN, LEAST_ANGLE = message("a drive that turns fully"), message("a transmission angle of {angle:g}°")
"""Demands, as they are told."""
WITHOUT = message("Designs that meet all but the demand of {demand}: {count:,}.")
_NOT_EVEN = message("None of the designs that were tried meets the demand of {task}, whatever else is demanded.")


@dataclass(frozen=True, kw_only=True)
class Demands:
    """What an accepted design has to do besides meeting its targets on one branch and in order.

    Raises `SynthesisError` for what no design could be held to: angles beyond a right one, a ratio below 1, a negative
    tolerance, a rectangle whose corners are exchanged.

    >>> Demands(transmission=0.7).crank
    False
    """

    crank: bool = False
    """The drive turns fully."""
    transmission: float = 0.0
    """The transmission angle does not fall below, in radians."""
    size_ratio: float = BUILDABLE
    """The longest length of a link is at most so many times the shortest."""
    region: tuple[float, float, float, float] | None = None
    """Of positions and points: the fixed pivots lie in this rectangle, least x, least y, greatest x, greatest y."""
    lengths: tuple[tuple[str, float], ...] = ()
    """Links with the given distance of their pins: crank, coupler, rocker, frame, or other names of links."""
    frame_direction: float | None = None
    """The angle of the line through two pivots of the frame with the x axis, in radians; half turns do not count."""
    near_pivots: tuple[tuple[float, float], ...] = ()
    """One or two places near which fixed pivots are preferred: no demand, but what designs are sought by."""
    tolerance: float = EXACT
    """How far a target may be missed, relative to the size of the task."""
    one_branch: bool = True
    """The drive never turns back on the way."""
    in_order: bool = True
    """The targets are met in the order of the task."""

    def __post_init__(self) -> None:
        """Refuse what no design could be held to; comparisons with it would fail, or hold, without a word."""
        for name in ("crank", "one_branch", "in_order"):
            if not isinstance(value := getattr(self, name), bool | np.bool_):
                raise SynthesisError("{name}: expected True or False, but found {value!r}", name=name, value=value)
        for name in ("transmission", "size_ratio", "tolerance"):
            if not _is_number(value := getattr(self, name)):
                raise SynthesisError("{name}: expected a number, but found {value!r}", name=name, value=value)
        if not 0 <= self.transmission <= np.pi / 2:
            raise SynthesisError(
                "{key}: expected an angle between {low} and {high} degrees, but found {angle:g} degrees",
                key="transmission",
                low=0,
                high=90,
                angle=np.degrees(self.transmission),
            )
        if self.size_ratio < 1:
            raise SynthesisError(
                "{name}: expected at least 1, but found {value:g}", name="size_ratio", value=self.size_ratio
            )
        if not 0 <= self.tolerance < np.inf:
            raise SynthesisError(
                "{name}: expected a part of the size, at least 0, but found {value:g}",
                name="tolerance",
                value=self.tolerance,
            )
        if self.region is not None and not _is_rectangle(self.region):
            raise SynthesisError(
                "{name}: expected least x, least y, greatest x, greatest y, but found {value!r}",
                name="region",
                value=self.region,
            )
        if self.frame_direction is not None and not (
            _is_number(self.frame_direction) and np.isfinite(self.frame_direction)
        ):
            raise SynthesisError(
                "{name}: expected an angle, but found {value!r}", name="frame_direction", value=self.frame_direction
            )
        settle(self, lengths=_given_lengths(self.lengths), near_pivots=_places(self.near_pivots))
        # The core takes no numbers of NumPy for plain ones, and comparisons with these are no plain bool.
        settle(self, **{name: bool(getattr(self, name)) for name in ("crank", "one_branch", "in_order")})
        settle(self, **{name: float(getattr(self, name)) for name in ("transmission", "size_ratio", "tolerance")})

    @property
    def given_sizes(self) -> int:
        """How many lengths and directions are given, an equation each."""
        return len(self.lengths) + (self.frame_direction is not None)

    @property
    def sizes_in_words(self) -> Message:
        """What of lengths and direction is given."""
        if self.frame_direction is None:
            return message("given lengths")
        if not self.lengths:
            return message("given direction of the frame")
        return message("given lengths and direction of the frame")

    @property
    def links_with_sizes(self) -> tuple[str, ...]:
        """The links of a four-bar whose length or direction is given: these have two pins."""
        links = [link for link, _ in self.lengths]
        return tuple(dict.fromkeys([*links, *([] if self.frame_direction is None else ["frame"])]))

    def orders(self, sort: Sequence[str]) -> tuple[str, ...]:
        """By what designs are sought and sorted: as asked, else by the distance of their pivots from preferred ones.

        >>> Demands(near_pivots=[(0, 0)]).orders(()), Demands().orders(["size"])
        (('near-pivots',), ('size',))
        """
        orders = tuple(sort) or (NEAR_PIVOTS,) * bool(self.near_pivots)
        in_order_of((), orders)  # a wrong name is refused before the work
        if NEAR_PIVOTS in orders and not self.near_pivots:
            raise SynthesisError("{name}: needed to sort by the distance from them", name="near_pivots")
        return orders

    @property
    def limits_of_size(self) -> bool:
        """Whether lengths, the frame's direction, the place of the pivots or the transmission angle are limited."""
        return self.given_sizes > 0 or self.region is not None or self.transmission > 0

    def of_task(self, task: Task, known: Iterable[str] | None = None) -> Demands:
        """These demands, which a task of linkages with such links can meet, by default four-bars or slider-cranks.

        Raises `SynthesisError` for lengths of other links, for a pivot that the task gives outside the region, and for
        the frame's direction where the task has no place.

        >>> from gruebler.design.synthesis.tasks import DeadCentreTask
        >>> Demands(lengths={"frame": 2}).of_task(DeadCentreTask(stroke=1, time_ratio=1))
        Traceback (most recent call last):
        gruebler.base.errors.SynthesisError: the length of a link 'frame' is given, but only crank and coupler have one
        """
        usual = ("crank", "coupler", *(() if output_travels(task) else ("rocker", "frame")))
        links = tuple(dict.fromkeys(usual if known is None else known))
        for link, _ in self.lengths:
            if link not in links:
                raise SynthesisError(
                    "the length of a link {link!r} is given, but only {known} have one",
                    link=link,
                    known=joined_by_and(links),
                )
        if self.frame_direction is not None and not isinstance(task, PositionTask | PathTask):
            raise SynthesisError("{name}: only for tasks with positions or points", name="frame_direction")
        places = {"near_pivots": self.near_pivots, "region": self.region}
        name = next((name for name, given in places.items() if given), None)
        if name is not None and not isinstance(task, PositionTask | PathTask):
            raise SynthesisError(
                "{name}: only for tasks with positions or points; any other linkage can be put there", name=name
            )
        x1, y1, x2, y2 = self.region or (-np.inf, -np.inf, np.inf, np.inf)
        for x, y in getattr(task, "fixed_pivots", ()):
            if not (x1 <= x <= x2 and y1 <= y <= y2):
                raise SynthesisError(
                    "{name}: ({x:g}, {y:g}) lies outside the region that is demanded", name="fixed_pivots", x=x, y=y
                )
        return self


def _given_lengths(value: object) -> tuple[tuple[str, float], ...]:
    """Pairs of a link and a positive length, of a table or a sequence, each link once."""
    rows = list(value.items()) if isinstance(value, Mapping) else value
    if not isinstance(rows, Sequence) or isinstance(rows, str):
        raise SynthesisError(
            "{name}: expected links with their lengths, but found {value!r}", name="lengths", value=value
        )
    pairs: dict[str, float] = {}
    for row in rows:
        if isinstance(row, str) or not isinstance(row, Sequence) or len(row) != 2 or not isinstance(row[0], str):
            raise SynthesisError(
                "{name}: expected links with their lengths, but found {value!r}", name="lengths", value=row
            )
        link, length = row
        if link in pairs:
            raise SynthesisError("{name}: the length of {link!r} is given twice", name="lengths", link=link)
        if not (_is_number(length) and 0 < length < np.inf):
            raise SynthesisError(
                "{name}: expected a length above 0 for each link, but found {link} = {value!r}",
                name="lengths",
                link=link,
                value=length,
            )
        pairs[link] = float(length)
    return tuple(pairs.items())


_UNBOUNDED = 1e100
"""Squares of such coordinates leave the numbers of the computer."""


def _places(value: object) -> tuple[tuple[float, float], ...]:
    """At most two places of the plane."""
    rows: list[Any] = list(value) if isinstance(value, Iterable) and not isinstance(value, str) else [None]
    pairs = all(
        isinstance(row, Sequence | np.ndarray)
        and len(row) == 2
        and all(isinstance(x, int | float | np.number) and not isinstance(x, bool) for x in row)
        for row in rows
    )
    if not pairs or len(rows) > 2 or not (np.abs(np.array(rows, np.float64)) < _UNBOUNDED).all():
        raise SynthesisError(
            "{name}: expected one or two places x, y with coordinates below {most:g}, but found {found}",
            name="near_pivots",
            most=_UNBOUNDED,
            found=joined_by_and([Message("({x:g}, {y:g})", {"x": float(x), "y": float(y)}) for x, y in rows])
            if pairs
            else Message("{value!r}", {"value": value}),
        )
    return tuple((float(x), float(y)) for x, y in rows)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | np.number) and not isinstance(value, bool) and not np.isnan(value)


def _is_rectangle(value: object) -> bool:
    if not isinstance(value, Sequence | np.ndarray) or len(value) != 4 or not all(map(_is_number, value)):
        return False
    return bool(value[0] <= value[2] and value[1] <= value[3])


def sought_order(task: PositionTask | PathTask, demands: Demands) -> TargetOrder | None:
    """The order in which targets are sought; None if it is that of the list, as of a whole curve."""
    curve = isinstance(task, PathTask) and GuidedCurve.of(task) is not GuidedCurve.NONE
    if not demands.in_order and not curve:
        return TargetOrder((tuple(range(len(task))),))
    return TargetOrder.of(task.order, len(task)) if task.order else None


def inside_region(pivots: Complexes, demands: Demands) -> Flags:
    """Whether pivots lie in the region that is demanded, all if there is none."""
    if demands.region is None:
        return np.ones(np.shape(pivots), bool)
    x1, y1, x2, y2 = demands.region
    return np.asarray((x1 <= pivots.real) & (pivots.real <= x2) & (y1 <= pivots.imag) & (pivots.imag <= y2))


def distance_of_pivots(pivots: Sequence[Complexes], demands: Demands) -> Reals:
    """How far fixed pivots lie from those that are preferred: the root of the sum of squares, each taken by its own.

    Args:
        pivots: each of one linkage, or of many.
        demands: with one or two places; of two assignments the nearer one counts.

    Infinite where there are fewer pivots than places, NaN where none are preferred.

    >>> float(distance_of_pivots([np.array(4 + 3j), np.array(0j)], Demands(near_pivots=[(0, 0), (4, 0)])))
    3.0
    """
    places = [complex(*place) for place in demands.near_pivots]
    if not places:
        return np.full(np.broadcast_shapes(*(np.shape(pivot) for pivot in pivots)), np.nan)
    squares = [
        np.asarray(sum(np.abs(pivot - place) ** 2 for pivot, place in zip(some, places, strict=True)))
        for some in permutations(pivots, len(places))
    ]
    return np.sqrt(np.minimum.reduce(np.broadcast_arrays(*squares))) if squares else np.asarray(np.inf)


def across_direction(gaps: NDArray[Any], direction: float) -> NDArray[Any]:
    """How far gaps (..., 2), x and y, lead off a direction: zero along it, both ways; analytic.

    >>> across_direction(np.array([[3.0, 0.0], [0.0, 2.0]]), np.pi / 4).round(6).tolist()
    [-2.12132, 1.414214]
    """
    return np.asarray(gaps[..., 1] * np.cos(direction) - gaps[..., 0] * np.sin(direction))


def demands_met(
    demands: Demands, turns: Flags, transmission: Reals, size_ratio: Reals, inside: Flags
) -> list[tuple[Message, Flags]]:
    """What is demanded besides the targets by its names, each with the linkages that meet it."""
    met = []
    if demands.crank:
        met.append((FULL_TURN, turns))
    if demands.transmission > 0:
        angle = LEAST_ANGLE.filled(angle=degrees(demands.transmission))
        met.append((angle, transmission >= demands.transmission))
    met.append((message("a size ratio of {ratio:g}", ratio=demands.size_ratio), size_ratio <= demands.size_ratio))
    if demands.region is not None:
        met.append((message("the region of the fixed pivots"), inside))
    return met


def demands_failed(met: Sequence[tuple[Message, Flags]]) -> Reals:
    """How many demands each linkage does not meet."""
    return np.asarray(np.sum([~flags for _, flags in met], axis=0), np.float64)


def tightest(met: Sequence[tuple[Message, Flags]]) -> list[Message]:
    """The demand without which the most remain, or the fewest demands; the first is the task itself and stays.

    >>> flags = [np.array(row, bool) for row in ([1, 1, 1, 0], [0, 0, 1, 1], [0, 1, 0, 1], [0, 1, 0, 1])]
    >>> met = [(Message(name), each) for name, each in zip("abcd", flags)]
    >>> print(*tightest(met), tightest(met[:1]), sep=" ")
    Designs that meet all but the demand of b: 1. []
    """
    (_, first), *others = met
    for count in range(1, len(others) + 1):
        tried = []
        for left in combinations(range(len(others)), count):
            kept = [first, *(flags for k, (_, flags) in enumerate(others) if k not in left)]
            tried.append((int(np.count_nonzero(np.logical_and.reduce(kept))), left))
        most, left = max(tried, key=lambda row: row[0])
        if most:
            return [WITHOUT.filled(demand=joined_by_and([others[k][0] for k in left]), count=most)]
    return [] if first.any() else [_NOT_EVEN.filled(task=met[0][0])]
