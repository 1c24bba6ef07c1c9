"""The input of a layout: points in the plane and the bodies that connect them.

For a structure picture the points are the joints and the bodies the links; for a graph it is the other way round. The
layout is the same for both. A body of one point gets a free end, and a body that shares two points with another one
gets an elbow, so that straight bars do not lie on each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise


@dataclass(frozen=True, slots=True)
class LayoutBodies:
    """Points 0, 1, ... with colours, and bodies as the points they connect.

    The first ``given`` points are the requested ones; free ends and elbows follow.
    """

    given: int
    point_colours: tuple[int, ...]
    bodies: tuple[tuple[int, ...], ...]
    paths: tuple[tuple[int, ...], ...]
    """For each body the points in drawing order, if it is a bar or a string with elbows."""

    @classmethod
    def of(cls, colours: Sequence[int], bodies: Sequence[Sequence[int]]) -> LayoutBodies:
        """Add free ends and elbows where they are needed.

        >>> LayoutBodies.of([0, 0], [[0, 1], [0, 1], [1]]).paths
        ((0, 1), (0, 2, 1), (1, 3))
        """
        points = list(colours)
        paths = []
        connected: set[frozenset[int]] = set()
        for body in bodies:
            if len(body) > 2:
                connected |= {frozenset(pair) for pair in combinations(body, 2)}
        for body in bodies:
            path = list(body)
            if len(path) == 1:
                path.append(len(points))
                points.append(_END)
            elif len(path) == 2:
                if path[0] == path[1]:
                    path[1:1] = [len(points), len(points) + 1]
                    points += [_ELBOW, _ELBOW]
                elif frozenset(path) in connected:
                    path.insert(1, len(points))
                    points.append(_ELBOW)
                connected.add(frozenset(body))
            paths.append(tuple(path))
        return cls(len(colours), tuple(points), tuple(tuple(b) for b in bodies), tuple(paths))

    @property
    def size(self) -> int:
        """The number of points."""
        return len(self.point_colours)

    @property
    def bars(self) -> list[tuple[int, int]]:
        """The straight pieces of bars."""
        return [(a, b) for body, path in self._drawn() if len(body) < 3 for a, b in pairwise(path)]

    @property
    def polygons(self) -> list[tuple[int, ...]]:
        """The bodies of three points or more."""
        return [body for body in self.bodies if len(body) > 2]

    def _drawn(self) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
        return list(zip(self.bodies, self.paths, strict=True))


_END, _ELBOW = -1, -2
