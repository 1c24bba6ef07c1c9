"""A program of its own that judges linkages of a crank and another dyad: the way is sampled, no class is told apart."""

from itertools import pairwise, permutations

import numpy as np

SAMPLES = 160


def circle_centre(places):
    """Of three places."""
    u, v = places[1] - places[0], places[2] - places[0]
    return places[0] + 1j * (abs(v) ** 2 * u - abs(u) ** 2 * v) / (2 * np.imag(np.conj(u) * v))


class Crank:
    """A crank by its pivot and its pin at the targets."""

    def __init__(self, pivot, pins):
        self.pivot, self.pins, self.length = pivot, pins, abs(pins[0] - pivot)

    def ways(self, in_line):
        """The pin on the ways through all targets in their order, within a lap, the shorter first, and on the circle.

        Args:
            in_line: the direction in which, or against which, the crank points where a transmission angle is extreme.
        """
        angles = np.angle((self.pins - self.pivot) / self.length)
        marks = np.angle(in_line) + np.pi * np.arange(-8, 9)
        ways = []
        for sense in (1, -1):
            travel = np.mod(sense * np.diff(angles), 2 * np.pi).sum()
            low, high = sorted((angles[0], angles[0] + sense * travel))
            if travel < 2 * np.pi:
                passed = marks[(marks > low) & (marks < high)]
                ways.append((travel, np.append(np.linspace(low, high, SAMPLES), passed)))
        circle = marks[0] + np.linspace(0, 2 * np.pi, 2 * SAMPLES + 1)
        shortest = [angle for _, angle in sorted(ways, key=lambda way: way[0])]
        return [self.pivot + self.length * np.exp(1j * angle) for angle in (*shortest, circle)]


class Rocker:
    """A pin on a circle about a pivot of the frame."""

    def __init__(self, pivot, pins, crank):
        self.pivot, self.length, self.coupler = pivot, abs(pins[0] - pivot), abs(pins[0] - crank.pins[0])
        self.lengths = [self.coupler, self.length, abs(pivot - crank.pivot)]
        self.pivots, self.in_line, self.reach = [pivot], pivot - crank.pivot, 0.0
        self.sides = np.imag(np.conj(pins - crank.pins) * (pivot - crank.pins))

    def closing(self, pins):
        """Above zero where a pin of the crank has a pose, and the cosine of the transmission angle there."""
        reach, b, c = abs(self.pivot - pins), self.coupler, self.length
        along = (b * b - c * c + reach**2) / (2 * reach)
        return b * b - along**2, (b * b + c * c - reach**2) / (2 * b * c)


class Slider:
    """A pin on a line of the frame."""

    def __init__(self, direction, pins, crank):
        self.along, self.place, self.coupler = direction, pins[0], abs(pins[0] - crank.pins[0])
        self.lengths, self.pivots, self.in_line = [self.coupler], [], 1j * direction
        self.reach = abs(pins[0] - crank.pivot)
        self.sides = np.real(np.conj(direction) * (pins - crank.pins))

    def closing(self, pins):
        """As of a rocker."""
        across = np.imag(np.conj(self.along) * (self.place - pins))
        return self.coupler**2 - across**2, across / self.coupler


class Block:
    """A line of the body, in directions at the targets, through a pivot of the frame."""

    def __init__(self, pivot, directions, crank):
        self.pivot, self.across = pivot, np.imag(np.conj(directions[0]) * (pivot - crank.pins[0]))
        self.lengths, self.pivots, self.in_line = [abs(pivot - crank.pivot)], [pivot], pivot - crank.pivot
        self.reach = abs(self.across)
        self.sides = np.real(np.conj(directions) * (pivot - crank.pins))

    def closing(self, pins):
        """As of a rocker."""
        reach = abs(self.pivot - pins)
        return reach**2 - self.across**2, self.across / reach


def judged(crank, other, size, places=()):
    """What such a linkage does, by the names of the measures, each to be small; None if it does not reach its targets.

    Args:
        crank: what is driven.
        other: a `Rocker`, `Slider` or `Block`.
        size: of the task, which counts as a length where something slides.
        places: near which pivots are preferred.
    """
    lengths = [crank.length, *other.lengths]
    shortest = min(lengths) if len(lengths) == 4 else min(*lengths, size)
    signs = np.sign(other.sides)
    if min(lengths) < 1e-9 * max(lengths) or not signs[0] or (signs != signs[0]).any():
        return None
    *ways, circle = (other.closing(pins) for pins in crank.ways(other.in_line))
    way = next((cosines for room, cosines in ways if (room >= 0).all()), None)
    if way is None:
        return None
    turns = (circle[0] > 0).all()
    least, over_range = (np.arccos(np.clip(np.abs(each).max(), 0, 1)) for each in (way, circle[1]))
    pivots = [crank.pivot, *other.pivots]
    gaps = [np.linalg.norm(np.subtract(some, places)) for some in permutations(pivots, len(places))]
    return {
        "transmission": -least,
        "range-transmission": -over_range if turns else 0.0,
        "size": max(*lengths, other.reach),
        "size-ratio": max(lengths) / shortest,
        "near-pivots": min(gaps, default=np.inf),
    }


class Body:
    """A body in two or three positions, and the dyads that guide it."""

    def __init__(self, positions):
        x, y, angles = np.array(positions).T
        self.origins, self.turns = x + 1j * y, np.exp(1j * (angles - angles[0]))
        self.size = np.abs(self.origins - self.origins[0]).max()

    def places(self, point):
        """Of a point of the body."""
        return self.origins + self.turns * (point - self.origins[0])

    def pins(self, pivot, along):
        """The pin of an RR dyad by its fixed pivot; of two positions how far along the bisector it lies, too."""
        seen = self.origins[0] + (pivot - self.origins) / self.turns
        if len(seen) == 3:
            return self.places(circle_centre(seen))
        (first, second) = seen
        return self.places((first + second) / 2 + 1j * (second - first) * along)

    def slider(self, numbers, crank):
        """By the angle of its line, of two positions by its pin."""
        pin, direction = on_a_line(self.places(0), self.turns, numbers)
        return Slider(direction, self.places(pin), crank)

    def block(self, numbers, crank):
        """By the angle of its line in the first position, of two positions by its pivot."""
        first = self.origins[0]
        seen = first - self.origins / self.turns  # a place of the frame, here 0, as the body sees it
        pivot, direction = on_a_line(seen, 1 / self.turns, numbers)
        return Block(pivot, direction * self.turns, crank)


def on_a_line(origins, turns, numbers):
    """The point whose places origins + turns point are in line, and the line's direction."""
    if len(turns) == 2:
        point = complex(*numbers)
        first, second = origins + turns * point
        return point, (second - first) / abs(second - first)
    direction = np.exp(1j * numbers[0])
    rows = np.array([(b - a) / direction for a, b in pairwise(turns)])
    gaps = np.array([(b - a) / direction for a, b in pairwise(origins)])
    x, y = np.linalg.solve(np.stack([rows.imag, rows.real], axis=1), -gaps.imag)
    return complex(x, y), direction


def concyclic(origins, turns, about, direction):
    """Where on a line the places (origins - place) / turns of four lie on a circle: roots of a cubic."""
    steps = np.arange(4.0)
    determinants = []
    for step in steps:
        seen = (origins - about - step * direction) / turns
        determinants.append(np.linalg.det(np.stack([abs(seen) ** 2, seen.real, seen.imag, np.ones(4)], axis=1)))
    roots = np.roots(np.polyfit(steps, determinants, 3))
    return [about + root.real * direction for root in roots if abs(root.imag) < 1e-9 * (1 + abs(root))]


class TimedCoupler:
    """Three or four points that a coupler reaches at crank angles."""

    def __init__(self, points, angles):
        self.points = np.array([complex(*point) for point in points])
        self.turns = np.exp(1j * (np.array(angles) - angles[0]))
        self.size = np.abs(self.points - self.points[0]).max()

    def crank(self, pivot):
        """With this pivot, and how the coupler turns."""
        arm = circle_centre((self.points - pivot) / self.turns)
        crank = Crank(pivot, pivot + arm * self.turns)
        return crank, (self.points - crank.pins) / (self.points[0] - crank.pins[0])

    def rocker(self, pivot, crank, turned):
        """With this pivot."""
        pin = circle_centre(crank.pins[0] + (pivot - crank.pins) / turned)
        return Rocker(pivot, crank.pins + turned * (pin - crank.pins[0]), crank)

    def slider(self, angle, crank, turned):
        """With a line at this angle."""
        origins = crank.pins - turned * crank.pins[0]
        pin, direction = on_a_line(origins, turned, [angle])
        return Slider(direction, origins + turned * pin, crank)
