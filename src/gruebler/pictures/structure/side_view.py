"""Gear trains seen from the side, in the usual line symbols: axes, shafts, wheels and carriers as lines.

Each axis is a thin line of its own height. A link's shaft runs along the axis, a dot fixes a wheel or arm on it; a
wheel is a line across the axis with its rim at the end, where it meets the rim of the other one; a carrier is a line
from axis to axis. Rules: docs/theory/drawing.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, text_width
from gruebler.pictures.structure.messages import describe, title
from gruebler.pictures.structure.picture import chain_of
from gruebler.pictures.structure.wheels import coaxial
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

_COLUMN = 38.0  # pixels between wheels along the axis, at least
_BESIDE = 22.0  # of them for the line and the space around the name beside it
_HEIGHT = 92.0  # between axes
_TRACK = 8.0  # between shafts about one axis
_STUB = 8.0  # half the length of a shaft with one wheel
_RIM = 9.0  # half the width of a wheel at its rim
_GAP = 1.8  # half the distance of two rims
_DOT = 3.2


class _Column(NamedTuple):
    """What is drawn at one place along the axes: a pair of wheels, or a carrier."""

    parts: tuple[tuple[str, int], ...]
    """Links with the numbers of their axes: the two wheels, or the carrier on each of its axes."""
    meshes: bool


def draw_side_view(structure: Chain | Mechanism, *, lang: str = "en", name: str = "") -> Figure:
    """A gear train from the side; tooth numbers, external or internal meshing are not part of it.

    Args:
        structure: a planar chain of turning joints without a loop, the axes, and of gear joints, whose links lie on
            axes that one further link, the carrier, has in common. Where two links hold the axes, the joint between
            them must be coaxial with one, and is drawn so. Of a mechanism the frame is hatched.
        lang: language of title and description, ``en`` or ``de``.
        name: the title.

    Raises `GrueblerError` for another chain.

    >>> draw_side_view(Chain.parse("R(sun-ring-arm) R(arm-planet) G(sun-planet) G(planet-ring)")).title
    'Kinematic chain'
    """
    chain = chain_of(structure)
    frame = structure.frame if isinstance(structure, Mechanism) else None
    axes = _axes(chain, frame)
    columns = [_wheels(chain, axes, joint.links) for joint in chain.joints if not joint.pair.is_turning]
    for link in chain.links:
        own = [k for k, axis in enumerate(axes) if link in axis]
        if len(own) > 1:
            columns.append(_Column(tuple((link, k) for k in own), meshes=False))
    height = _places(len(axes), lambda places: _spread(columns, places))
    along = _places(len(columns), lambda places: _shaft_length(columns, places))
    columns = [columns[k] for k in sorted(range(len(columns)), key=along.__getitem__)]
    shapes = _painted(axes, columns, height, frame)
    return figure_of(shapes, title(structure, lang, name), describe(structure, lang), margin=16.0)


def _axes(chain: Chain, frame: str | None) -> list[tuple[str, ...]]:
    axes = [joint.links for joint in chain.joints if joint.pair.is_turning]
    gears = [joint for joint in chain.joints if not joint.pair.is_turning]
    tree = sum(len(axis) - 1 for axis in axes) == chain.n - 1
    wheels = all(joint.pair.rolls_and_slides and joint.count == 1 for joint in gears)
    if not tree or not wheels or chain.space is not Space.PLANAR:
        raise GrueblerError("a side view shows planar gear trains: turning joints without a loop, and gear joints (G)")
    for joint in gears:
        axes = coaxial(axes, joint.links, frame, chain.degrees)
    return axes


def _wheels(chain: Chain, axes: Sequence[tuple[str, ...]], links: Sequence[str]) -> _Column:
    """The two wheels of a gear joint on the axes that their carrier has in common."""
    a, b = links
    for (k, shaft), (m, other_shaft) in combinations(enumerate(axes), 2):
        for first, second in ((a, b), (b, a)):
            if first in shaft and second in other_shaft and set(shaft) & set(other_shaft) - {a, b}:
                return _Column(((first, k), (second, m)), meshes=True)
    raise GrueblerError("the wheels {a} and {b} of {chain} have no common carrier", a=a, b=b, chain=chain)


# --- the order along and across the axes -----------------------------------------------------------------


def _places(count: int, cost: Callable[[Sequence[int]], int]) -> list[int]:
    """A place for each of so many things, such that no move of one thing to another place costs less."""
    order = list(range(count))

    def priced(some: list[int]) -> int:
        places = [0] * count
        for place, k in enumerate(some):
            places[k] = place
        return cost(places)

    least = priced(order)
    better = True
    while better:
        better = False
        for old in range(count):
            for new in range(count):
                changed = order[:old] + order[old + 1 :]
                changed.insert(new, order[old])
                if (price := priced(changed)) < least:
                    order, least, better = changed, price, True
    places = [0] * count
    for place, k in enumerate(order):
        places[k] = place
    return places


def _spread(columns: Sequence[_Column], places: Sequence[int]) -> int:
    """How many heights the wheels and carriers cross, those that mesh counted most."""
    total = 0
    for column in columns:
        heights = [places[axis] for _, axis in column.parts]
        total += (max(heights) - min(heights)) * (3 if column.meshes else 1)
    return total


def _shafts(columns: Sequence[_Column], places: Sequence[int]) -> dict[tuple[str, int], tuple[int, int]]:
    """The first and last place of each link on each axis."""
    ends: dict[tuple[str, int], tuple[int, int]] = {}
    for k, column in enumerate(columns):
        for part in column.parts:
            first, last = ends.get(part, (places[k], places[k]))
            ends[part] = min(first, places[k]), max(last, places[k])
    return ends


def _shaft_length(columns: Sequence[_Column], places: Sequence[int]) -> int:
    return sum(last - first for first, last in _shafts(columns, places).values())


# --- the shapes ------------------------------------------------------------------------------------------


def _painted(
    axes: Sequence[tuple[str, ...]], columns: Sequence[_Column], height: Sequence[int], frame: str | None
) -> list[Shape]:
    ends = _shafts(columns, range(len(columns)))
    tracks = _tracks(len(axes), ends)

    column_width = max(_COLUMN, *(_BESIDE + text_width(link, 11.0) for link, _ in ends))

    def shaft_at(part: tuple[str, int]) -> float:
        return -_HEIGHT * height[part[1]] - _TRACK * tracks[part]

    shapes: list[Shape] = []
    for axis in range(len(axes)):
        own = [ends[part] for part in ends if part[1] == axis]
        left, right = min(first for first, _ in own), max(last for _, last in own)
        y = -_HEIGHT * height[axis]
        line = (Point(left * column_width - 2 * _STUB, y), Point(right * column_width + 2 * _STUB, y))
        shapes.append(Polylines((line,), "pitch"))
    for part, (first, last) in ends.items():
        y = shaft_at(part)
        line = (Point(first * column_width - _STUB, y), Point(last * column_width + _STUB, y))
        shapes.append(Polylines((line,), "rail"))
        if part[0] == frame:
            shapes.append(_hatched(*line))
    for k, column in enumerate(columns):
        x = k * column_width
        at = sorted(((shaft_at(part), part[0]) for part in column.parts), reverse=True)  # the lowest first
        (low, lower), (high, upper) = at[0], at[-1]
        if column.meshes:
            meet = high + _HEIGHT / 2  # between the upper axis and the one below it
            shapes += _wheel(x, low, meet + _GAP, lower) + _wheel(x, high, meet - _GAP, upper)
        else:
            shapes.append(Polylines(((Point(x, low), Point(x, high)),), "edge"))
            shapes.append(TextShape(Point(x + 7.0, high + _HEIGHT / 2), lower, "letter", "start"))
            shapes += [CircleShape(Point(x, y), _DOT, "dot") for y, _ in at]
    return shapes


def _wheel(x: float, shaft: float, rim: float, name: str) -> list[Shape]:
    """A wheel from its shaft to its rim, its name beside it."""
    line = (Point(x, shaft), Point(x, rim)), (Point(x - _RIM, rim), Point(x + _RIM, rim))
    side = 13.0 if rim > shaft else -13.0
    return [
        Polylines(line, "edge"),
        CircleShape(Point(x, shaft), _DOT, "dot"),
        TextShape(Point(x + 6.0, rim - side), name, "letter", "start"),
    ]


def _tracks(axes: int, ends: dict[tuple[str, int], tuple[int, int]]) -> dict[tuple[str, int], int]:
    """For each shaft the least distance from its axis at which no other one is in its way."""
    tracks: dict[tuple[str, int], int] = {}
    for axis in range(axes):
        taken: list[list[tuple[int, int]]] = []
        own = [part for part in ends if part[1] == axis]
        for part in sorted(own, key=lambda part: (ends[part][0] - ends[part][1], ends[part])):  # the longest first
            first, last = ends[part]
            free = (t for t, shafts in enumerate(taken) if all(last < a or b < first for a, b in shafts))
            track = next(free, len(taken))
            if track == len(taken):
                taken.append([])
            taken[track].append((first, last))
            tracks[part] = track
    return tracks


def _hatched(start: Point, end: Point) -> Polylines:
    """Strokes below the shaft of the frame."""
    count = max(2, round((end.x - start.x) / 6.0))
    xs = [start.x + (end.x - start.x) * k / count for k in range(count + 1)]
    return Polylines(tuple((Point(x, start.y), Point(x - 5.0, start.y + 6.0)) for x in xs), "hatch")
